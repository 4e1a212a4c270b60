"""Curves of a calculation at given places of their abscissa, each computed once from those that it takes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from diecut_report.formulas import Array
from diecut_report.machine.numerics.domain import CalculatedMachines, Inside
from diecut_report.mechanism.names import Bound, Written, bound


class CurveSampler:
    """Give curves at given places of their abscissa; each is computed once.

    ``inside`` are the middles of all pieces (rows, pieces) and which of them each place lies in, where there are more places than pieces.
    """

    def __init__(
        self,
        owner: CalculatedMachines,
        axis: str,
        x: Array,
        middle: Array,
        rows: Array | None,
        inside: Inside | None = None,
    ) -> None:
        self.owner, self.axis, self.x, self.mid, self.inside = owner, axis, x, middle, inside
        self.rows = rows if owner.count > 1 else None  # a single machine's numbers broadcast to all rows
        self.known: dict[str, Array] = {axis: x}

    def __getitem__(self, name: str) -> Array:
        found = self.known.get(name)
        if found is None:
            found = self.known[name] = self._compute(name)
        return found

    def over(self, name: str) -> Array:
        """Return a curve, or a number, at each of the places."""
        found = self[name]
        if np.shape(found) == self.x.shape:
            return found
        return np.broadcast_to(found, np.broadcast_shapes(np.shape(found), np.shape(self.x)))

    def _compute(self, name: str) -> Array:
        step = self.owner.curves.get(name)
        if step is None:
            number = self.owner[name]
            return number if self.rows is None else number[self.rows]
        return step.curve(self)

    def of_pieces(self, name: str) -> Array:
        """Return a flag of the pieces, at their middles."""
        if self._present is not None:
            pieces, own = self._present
            found: Array = pieces.over(name)[0].take(own)
            return found
        if self.inside is None:
            return self._at_middles[name]
        return np.take_along_axis(self._at_middles.over(name), self.inside[1], axis=1)

    @cached_property
    def _present(self) -> tuple[CurveSampler, Array] | None:
        """What gives the flags of all present pieces of a single machine, each computed once, and which of these each place lies in.

        None of many machines, and where a place lies in a piece that is not there any more.
        """
        if self.owner.count > 1:
            return None
        pieces = self.owner.of_pieces(self.axis)
        own = pieces.mid[0].searchsorted(self.mid)
        return (pieces, own) if np.array_equal(pieces.mid[0].take(own, mode="clip"), self.mid) else None

    @cached_property
    def _at_middles(self) -> CurveSampler:
        middles = self.mid if self.inside is None else self.inside[0]
        return CurveSampler(self.owner, self.axis, middles, middles, self.rows)

    def apply(self, part: Written) -> Array:
        """Return what a formula gives at the places."""
        link = part if type(part) is Bound else bound(part)
        known = self.known
        taken = [n if isinstance(n, float) else known[n] if n in known else self[n] for n in link.takes]
        found: Array = link.formula.function(*taken)
        return found


# A curve that is given as a list of values.


@dataclass(frozen=True)
class SampledCurve:
    """Hold a curve given as equally spaced values over one period; between them it runs straight."""

    numbers: tuple[float, ...]

    def values(self, share: Array, middle: Array, rows: Array | None) -> Array:
        """Return values at shares of the period, of any shape (all variants have the same curve, which has no jumps)."""
        places = np.arange(len(self.numbers) + 1) / len(self.numbers)
        found: Array = np.interp(share % 1, places, [*self.numbers, self.numbers[0]])
        return found

    @property
    def breakpoints(self) -> Array:
        return np.arange(len(self.numbers))[None, :] / len(self.numbers)

    joints = breakpoints
    cycle = "list"  # of values, over whatever takes it
    rate = np.zeros((1, 1))  # which nothing tells

    def gain(self, rows: Array | None) -> Array:
        """Return nothing: the curve closes."""
        return np.zeros((1, 1))
