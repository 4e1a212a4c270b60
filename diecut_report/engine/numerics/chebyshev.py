"""Running integrals and derivatives of curves, as Chebyshev series of their smooth pieces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from diecut_report.engine.numerics.domain import piece_of
from diecut_report.expressions import Array
from diecut_report.mechanics import chebyshev_sums


@dataclass(frozen=True)
class PieceSeries:
    """Hold a curve as Chebyshev series: for each variant and smooth piece one over [-1, 1]."""

    edges: Array  # (variants, pieces + 1)
    series: Array  # (order, variants, pieces)

    def values(self, x: Array, middle: Array, rows: Array | None) -> Array:
        """Return values at x (rows, points), each in the piece that its middle lies in; rows are variants (default all)."""
        known = np.arange(len(self.edges)) if rows is None else rows
        edges = self.edges if len(self.edges) == 1 else self.edges[known]
        piece = piece_of(edges, np.broadcast_to(middle, (len(x), np.shape(middle)[-1])))  # one a row, or one a place
        variant = np.broadcast_to(known[:, None] if len(self.edges) > 1 else 0, piece.shape)
        start, end = self.edges[variant, piece], self.edges[variant, piece + 1]
        place = (2 * x - start - end) / np.where(end > start, end - start, 1)
        terms = self.series.reshape(len(self.series), -1)
        return chebyshev_sums.at_places(terms, variant * self.series.shape[2] + piece, place)
