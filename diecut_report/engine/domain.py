"""An abscissa with its breakpoints, for all variants: the smooth pieces that curves are taken over."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cache

import numpy as np
from numpy.polynomial.legendre import leggauss

from diecut_report.expressions import Array

LOBATTO = 64  # intervals of the search grid in each smooth piece; it does not depend on n_points

SAME = 1e-13  # share of the period within which two breakpoints are one


_legendre = cache(leggauss)

FEW_EDGES = 40  # up to which edges are compared with all places at once


def piece_of(edges: Array, x: Array) -> Array:
    """The piece that each x (rows, points) lies in, of pieces with these edges (rows, pieces + 1)."""
    inner = edges[:, 1:-1]
    if inner.shape[1] <= FEW_EDGES:
        return np.asarray((x[:, :, None] >= inner[:, None, :]).sum(axis=2))
    return np.stack([np.searchsorted(row, places, side="right") for row, places in zip(inner, x, strict=True)])


@dataclass
class Domain:
    """The range [0, period) of an abscissa, cut at breakpoints; ``edges`` has shape (variants, pieces + 1), ascending.

    Variants may have fewer pieces than others: the missing ones have no width and lie at the end of the period.
    """

    period: float
    samples: Array
    edges: Array = field(init=False)

    def __post_init__(self) -> None:
        self.edges = np.tile([0.0, self.period], (len(self.samples), 1))

    def cut(self, places: Array) -> None:
        """Add breakpoints, shape (variants, any number); NaN stands for none."""
        inside = np.where(np.isfinite(places), np.mod(places, self.period), self.period)
        edges = np.sort(np.concatenate([self.edges, inside], axis=1), axis=1)
        for i in range(1, edges.shape[1] - 1):  # one place that came twice, with other rounding, stays one
            close = edges[:, i] - edges[:, i - 1] < SAME * self.period
            edges[:, i] = np.where(close, edges[:, i - 1], edges[:, i])
        self.edges = edges

    def middle_of(self, x: Array, rows: Array | None = None) -> Array:
        """The middle of the piece that each x (rows, points) lies in; at a breakpoint the piece that begins there."""
        edges, middles = (self.edges, self.middles) if rows is None else (self.edges[rows], self.middles[rows])
        return np.take_along_axis(middles, piece_of(edges, x), axis=1)

    @property
    def middles(self) -> Array:
        """The middle of each piece, shape (variants, pieces)."""
        return (self.edges[:, 1:] + self.edges[:, :-1]) / 2

    @property
    def widths(self) -> Array:
        """The width of each piece, shape (variants, pieces)."""
        return np.diff(self.edges, axis=1)

    def search_grid(self) -> Array:
        """Chebyshev–Lobatto points of each piece, ends included, shape (variants, pieces, points)."""
        share = (1 - np.cos(np.pi * np.arange(LOBATTO + 1) / LOBATTO)) / 2
        grid: Array = self.edges[:, :-1, None] + self.widths[:, :, None] * share
        grid[:, :, -1] = self.edges[:, 1:]
        return grid

    def flat_grid(self) -> tuple[Array, Array]:
        """The search grid and the middle of each point's piece, each of shape (variants, pieces · points)."""
        grid = self.search_grid()
        middle = np.broadcast_to(self.middles[:, :, None], grid.shape)
        return grid.reshape(len(grid), -1), middle.reshape(len(grid), -1)

    def flat_gauss(self, order: int) -> tuple[Array, Array]:
        """The Gauss–Legendre points and the middle of each point's piece, each of shape (variants, pieces · order)."""
        x, _ = self.gauss(order)
        return x.reshape(len(x), -1), np.broadcast_to(self.middles[:, :, None], x.shape).reshape(len(x), -1)

    def gauss(self, order: int) -> tuple[Array, Array]:
        """Gauss–Legendre points and weights in each piece, each of shape (variants, pieces, order)."""
        node, weight = _legendre(order)
        return (
            self.middles[:, :, None] + self.widths[:, :, None] * node / 2,
            self.widths[:, :, None] * weight / 2,
        )
