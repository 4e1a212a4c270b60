"""Curves of many machines as Legendre series on their smooth pieces: means, extremes and values anywhere follow from them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.polynomial import legendre

from diecut_report.expressions import Array
from diecut_report.mechanics import chebyshev_sums

COUNT = 20  # Gauss–Legendre places in a piece
NODES, WEIGHTS = legendre.leggauss(COUNT)
_VALUES = legendre.legvander(NODES, COUNT - 1)  # of each Legendre polynomial at the places
TO_SERIES = (_VALUES * WEIGHTS[:, None]).T * (np.arange(COUNT)[:, None] + 0.5)  # coefficients from values at the places
LOOK = np.linspace(-1, 1, 41)  # where a piece is looked at before its greatest value is looked at closer
_LOOK_VALUES = legendre.legvander(LOOK, COUNT)
NARROW = 1e-12  # a piece that is no wider holds nothing
BESIDE = 1e-11  # as near as a place is to an edge that it is taken to be on
CLOSER = np.linspace(-1, 1, 17)
TO_CHEBYSHEV = chebyshev_sums.of_legendre(COUNT + 1)
RESOLVED = 1e-12  # of the greatest coefficient, below which a term is nothing
LOOKS = 3  # each makes the place of an extreme closer by 1/8; a parabola through the last ones does the rest

Function = Callable[[Array, Array, Array], Array]
"""Of places (rows, points), the middles (rows, 1) of the smooth pieces that they lie in, and the machine (rows,) of each row."""


@dataclass(frozen=True, eq=False)
class PieceRows:
    """Hold pieces (pieces,) of the curves of ``count`` machines over [0, 1]: machine, start and width, and the series (pieces, 20).

    They stand in the order of their machines and starts.
    """

    count: int
    machine: Array
    low: Array
    width: Array
    series: Array

    @classmethod
    def of(cls, function: Function, breakpoints: Array, pieces: int) -> PieceRows:
        """Return a function of many machines that is smooth between its breakpoints (machines, places), in at least so many pieces."""
        count = len(breakpoints)
        even = np.broadcast_to(np.linspace(0, 1, pieces + 1), (count, pieces + 1))
        edges = np.sort(np.concatenate([np.nan_to_num(breakpoints, nan=1.0), even], axis=1), axis=1)
        machine, piece = np.nonzero(np.diff(edges, axis=1) > NARROW)
        low, width = edges[machine, piece], np.diff(edges, axis=1)[machine, piece]
        places = low[:, None] + width[:, None] * (NODES + 1) / 2
        values = function(places, (low + width / 2)[:, None], machine)
        return cls(count, machine, low, width, np.broadcast_to(values, places.shape) @ TO_SERIES.T)

    @cached_property
    def values(self) -> Array:
        """Return the values at the Gauss–Legendre places of each piece."""
        return self.series @ _VALUES.T

    @cached_property
    def _keys(self) -> Array:
        return self.machine + self.low

    def at(self, places: Array, machine: Array, middles: Array | None = None) -> Array:
        """Return values at places (rows, points) in [0, 1] of the machine (rows,) of each row.

        At an edge it is that of the piece on the side of ``middles`` (rows, points or 1), by default of the piece behind it.
        """
        towards = 0.0 if middles is None else np.clip(middles - places, -BESIDE, BESIDE)
        inside = np.minimum(places + towards, 1 - NARROW)
        if not places.size:
            return np.zeros(places.shape)
        if places.shape[1] == 1:  # as a search for a root or an extreme asks, again and again
            return self._in_pieces(piece := self._piece_of(inside, machine), self._shares(places, piece))
        found = np.empty(places.shape)
        ends = self._piece_of(np.stack([inside.min(axis=1), inside.max(axis=1)], axis=1), machine)
        alike = (ends[:, 0] == ends[:, 1]) & np.isfinite(inside).all(axis=1)
        for rows in filter(len, (np.flatnonzero(alike), np.flatnonzero(~alike))):
            piece = ends[rows, :1] if alike[rows].all() else self._piece_of(inside[rows], machine[rows])
            found[rows] = self._in_pieces(piece, self._shares(places[rows], piece))
        return found

    def _shares(self, places: Array, piece: Array) -> Array:
        """Where places lie in their pieces, from -1 to 1."""
        return 2 * (places - self.low[piece]) / self.width[piece] - 1

    def _piece_of(self, inside: Array, machine: Array) -> Array:
        """The piece that each place (rows, points) lies in."""
        return np.searchsorted(self._keys, machine[:, None] + inside, side="right") - 1

    @cached_property
    def _terms(self) -> Array:
        """The Chebyshev coefficients of the pieces, (degrees, pieces): their recurrence is the shorter one."""
        count = self.series.shape[1]
        return np.ascontiguousarray(TO_CHEBYSHEV[:count, :count] @ self.series.T)

    def _in_pieces(self, piece: Array, x: Array) -> Array:
        """Values at places x of pieces, from -1 to 1: (rows, points), the pieces (rows, points) or (rows, 1)."""
        return chebyshev_sums.at_places(self._terms, piece, x)

    @property
    def is_resolved(self) -> bool:
        """Return whether the series follow the curves to rounding: their last terms are nothing beside the greatest value."""
        size = np.zeros(self.count)
        np.fmax.at(size, self.machine, np.abs(self.series).max(axis=1))
        last = np.abs(self.series[:, -3:]).max(axis=1)
        return not (last > RESOLVED * size[self.machine]).any()

    def split(self, parts: Array) -> PieceRows:
        """Return the same with each piece in so many parts."""
        if (parts == 1).all():
            return self
        piece = np.repeat(np.arange(len(parts)), parts)
        number = np.arange(len(piece)) - np.repeat(np.cumsum(parts) - parts, parts)
        width = self.width[piece] / parts[piece]
        shares = (2 * number[:, None] + 1 + NODES) / parts[piece][:, None] - 1
        series = self._in_pieces(piece[:, None], shares) @ TO_SERIES.T
        return PieceRows(self.count, self.machine[piece], self.low[piece] + number * width, width, series)

    def through(self, values: Array) -> PieceRows:
        """Return curves on the same pieces through values at their places."""
        return replace(self, series=values @ TO_SERIES.T)

    @property
    def mean(self) -> Array:
        """Return the mean of each machine's curve."""
        return self._added(self.series[:, 0])

    @property
    def rms(self) -> Array:
        """Return the root mean square of each machine's curve (Gauss–Legendre)."""
        found: Array = np.sqrt(self._added(self.values**2 @ WEIGHTS / 2))
        return found

    def _added(self, means: Array) -> Array:
        found: Array = np.bincount(self.machine, means * self.width, self.count)
        return found

    @property
    def excess(self) -> PieceRows:
        """Return the integral of each machine's curve above its mean, from the start on."""
        above = self.series.copy()
        above[:, 0] -= self.mean[self.machine]
        inside = legendre.legint(above, lbnd=-1, axis=1) * self.width[:, None] / 2
        whole = above[:, 0] * self.width
        known = np.where(np.isfinite(whole), whole, 0.0)  # a machine without values leaves nothing to those behind it
        passed = np.cumsum(known) - known  # of the machines before nothing is left
        inside[:, 0] += passed
        return replace(self, series=inside)

    @property
    def range(self) -> Array:
        """Return the greatest less the least value of each machine's curve."""
        found: Array = self.largest - self.least
        return found

    @property
    def largest(self) -> Array:
        """Return the greatest value of each machine's curve, one-sided limits at the edges included."""
        return self._largest(1.0)

    @property
    def least(self) -> Array:
        """Return the least value of each machine's curve."""
        return -self._largest(-1.0)

    def _largest(self, sign: float) -> Array:
        looks = sign * self.series @ _LOOK_VALUES[:, : self.series.shape[1]].T
        tops = np.full(self.count, -np.inf)
        np.maximum.at(tops, self.machine, looks.max(axis=1))
        lows = np.full(self.count, np.inf)
        np.minimum.at(lows, self.machine, looks.min(axis=1))
        near = tops - 1e-2 * (tops - lows)
        piece = np.flatnonzero(looks.max(axis=1) >= near[self.machine])
        place, width = LOOK[np.argmax(looks[piece], axis=1)], 2 / (len(LOOK) - 1)
        for _ in range(LOOKS):
            around = np.clip(place, width - 1, 1 - width)[:, None] + width * CLOSER
            found = sign * self._in_pieces(piece[:, None], around)
            best = np.argmax(found, axis=1)[:, None]
            place, width = np.take_along_axis(around, best, axis=1)[:, 0], width / 8
            np.maximum.at(tops, self.machine[piece], np.take_along_axis(found, best, axis=1)[:, 0])
        vertex = place + width * vertices(found)
        np.maximum.at(tops, self.machine[piece], sign * self._in_pieces(piece[:, None], vertex[:, None])[:, 0])
        return tops


def vertices(heights: Array) -> Array:
    """Return where a parabola through the greatest of equally spaced values (rows, places) and its neighbours is highest.

    It is counted in their spacing from the greatest, at most half of it; 0 where the greatest is the first or the last.
    """
    best = np.argmax(heights, axis=1)
    inner = np.clip(best, 1, heights.shape[1] - 2)
    before, here, after = (heights[np.arange(len(heights)), inner + step] for step in (-1, 0, 1))
    bend = before - 2 * here + after
    found = np.where((bend < 0) & (best == inner), (before - after) / (2 * np.where(bend < 0, bend, -1.0)), 0.0)
    return np.clip(found, -0.5, 0.5)
