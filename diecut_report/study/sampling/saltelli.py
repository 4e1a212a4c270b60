"""Rows from which first and total Sobol indices can be calculated."""

from __future__ import annotations

from dataclasses import dataclass

from diecut_report.expressions import Array


@dataclass(frozen=True)
class Saltelli:
    """Describe how the rows of a sample for Sobol indices belong together.

    Each of `points` has `size` rows in turn: the first from the matrix A, the second from B, then for each of `paths`
    the row of A with this path's value from B. So a row's point is ``row // size`` and its place ``row % size``.
    """

    points: int
    paths: tuple[str, ...]

    @property
    def size(self) -> int:
        """Return rows of a point."""
        return len(self.paths) + 2

    @property
    def matrices(self) -> tuple[str, ...]:
        """Return the names of the matrices by place: A, B, then ``AB PATH``."""
        return ("A", "B", *(f"AB {path}" for path in self.paths))

    def point(self, row: Array) -> Array:
        """Return the points to which rows belong."""
        return row // self.size

    def place(self, row: Array) -> Array:
        """Return the places of rows in their points: 0 is of A, 1 of B, 2 + i of A with the i-th path from B."""
        return row % self.size
