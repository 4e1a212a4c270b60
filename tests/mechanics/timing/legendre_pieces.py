"""A curve of one machine as Legendre series: means, extremes, roots and integrals follow from their roots, another way than the program's."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import legendre

from diecut_report.formulas import Array

COUNT = 20  # Gauss–Legendre places in a piece
NODES, WEIGHTS = legendre.leggauss(COUNT)
_DEGREES = np.arange(COUNT)
_VALUES = legendre.legvander(NODES, COUNT - 1)  # of each Legendre polynomial at the places
TO_SERIES = (_VALUES * WEIGHTS[:, None]).T * (_DEGREES[:, None] + 0.5)  # coefficients from values at the places
LOOK = np.linspace(-1, 1, 41)  # where a piece is looked at before its extremes and roots are taken from its series
_LOOK_VALUES = legendre.legvander(LOOK, COUNT - 1)
NEAR = 1e-12  # of the abscissa's length, below which two edges are one
ROUNDING = 1e-14  # of the greatest coefficient of a series, below which one is nothing
REAL = 1e-7  # size of an imaginary part that rounding gives to a double root

Function = Callable[[Array, Array], Array]  # of places and, as many, the middles of the pieces that they are in


def unique_edges(places: Array, start: float, end: float) -> Array:
    """Return the ends and all places between them, sorted, each once."""
    inner = np.sort(places[(places > start) & (places < end)])
    found = np.concatenate([[start], inner, [end]])
    near = NEAR * (end - start)
    keep = np.concatenate([[True], np.diff(found) > near])
    kept: Array = found[keep]
    kept[-1] = end
    return kept


def split(edges: Array, widest: float) -> Array:
    """Return the edges with more between them, so that no piece is wider."""
    parts = np.maximum(np.ceil(np.diff(edges) / widest - NEAR), 1).astype(int)
    steps = (a + (b - a) * np.arange(n) / n for a, b, n in zip(edges[:-1], edges[1:], parts, strict=True))
    return np.concatenate([*steps, edges[-1:]])


@dataclass(frozen=True, eq=False)
class LegendrePieces:
    """Hold edges, shape (pieces + 1,), and coefficients, shape (pieces, 20), of the Legendre series over each piece's [−1, 1]."""

    edges: Array
    coefficients: Array

    @classmethod
    def of(cls, function: Function, edges: Array) -> LegendrePieces:
        """Return a function between edges, which is smooth inside each piece; it is evaluated once, inside the pieces."""
        middle = np.repeat((edges[1:] + edges[:-1]) / 2, COUNT)
        values = function(nodes(edges).ravel(), middle)
        return cls.through(edges, np.broadcast_to(values, middle.shape).reshape(-1, COUNT))

    @classmethod
    def through(cls, edges: Array, values: Array) -> LegendrePieces:
        """Return the pieces through values at the places of ``nodes``, shape (pieces, 20)."""
        return cls(edges, values @ TO_SERIES.T)

    @cached_property
    def widths(self) -> Array:
        """Return the width of each piece."""
        return np.diff(self.edges)

    @cached_property
    def values(self) -> Array:
        """Return the values at the places of ``nodes``, shape (pieces, 20)."""
        return self.coefficients @ _VALUES.T

    def at(self, places: Array, middles: Array | None = None) -> Array:
        """Return values at places of any shape; at an edge of the piece that ``middles`` lie in, by default the one behind it."""
        piece = np.searchsorted(self.edges, places if middles is None else middles, side="right") - 1
        piece = np.clip(piece, 0, len(self.edges) - 2)
        share = 2 * (places - self.edges[piece]) / self.widths[piece] - 1
        found: Array = np.einsum("...k,...k->...", self.coefficients[piece], legendre.legvander(share, COUNT - 1))
        return found

    def between(self, edges: Array, change: Callable[[Array], Array] = np.positive) -> LegendrePieces:
        """Return the curve on other edges (all of its own among them), its values changed by a function."""
        return LegendrePieces.of(lambda places, middles: change(self.at(places, middles)), edges)

    def scaled(self, abscissa: float, factor: float = 1.0) -> LegendrePieces:
        """Return the curve over a stretched abscissa, times a factor."""
        return LegendrePieces(self.edges * abscissa, self.coefficients * factor)

    def __add__(self, other: LegendrePieces) -> LegendrePieces:
        """Return the sum of two curves on the same edges."""
        return LegendrePieces(self.edges, self.coefficients + other.coefficients)

    @property
    def mean(self) -> float:
        """Return the mean over the whole abscissa."""
        return float(self.coefficients[:, 0] @ self.widths / self.widths.sum())

    @property
    def rms(self) -> float:
        """Return the root mean square over the whole abscissa (Gauss–Legendre)."""
        return float(np.sqrt((self.values**2 @ WEIGHTS / 2) @ self.widths / self.widths.sum()))

    @property
    def largest(self) -> tuple[float, float]:
        """Return the greatest value, one-sided limits at the edges included, and its place."""
        looks = self.coefficients @ _LOOK_VALUES.T
        tops = looks.max(axis=1)
        near = np.flatnonzero(tops >= tops.max() - 1e-2 * (looks.max() - looks.min()))
        return max((self._largest_of(int(piece)) for piece in near), key=lambda found: found[0])

    @property
    def least(self) -> tuple[float, float]:
        """Return the least value, as ``largest``."""
        value, place = self.scaled(1.0, -1.0).largest
        return -value, place

    def _largest_of(self, piece: int) -> tuple[float, float]:
        series = self.coefficients[piece]
        turns = _real_roots(legendre.legder(series))
        places = np.concatenate([[-1.0, 1.0], turns])
        values = legendre.legval(places, series)
        best = int(np.argmax(values))
        return float(values[best]), float(self.edges[piece] + (places[best] + 1) / 2 * self.widths[piece])

    def crossings(self, level: float = 0.0) -> Array:
        """Return all places where the curve crosses a level inside its pieces, sorted."""
        above = self.coefficients @ _LOOK_VALUES.T - level
        changes = ((above[:, 1:] > 0) != (above[:, :-1] > 0)).any(axis=1)
        found = [self._crossings_of(int(piece), level) for piece in np.flatnonzero(changes)]
        return np.concatenate([np.empty(0), *found])

    def _crossings_of(self, piece: int, level: float) -> Array:
        series = self.coefficients[piece].copy()
        series[0] -= level
        found: Array = self.edges[piece] + (np.sort(_real_roots(series)) + 1) / 2 * self.widths[piece]
        return found

    def running(self) -> RunningIntegral:
        """Return the integral from the start."""
        return RunningIntegral(self)


class RunningIntegral:
    """Give the integral of a curve from its start to any place."""

    def __init__(self, of: LegendrePieces) -> None:
        self.of = of
        pieces = of.coefficients[:, 0] * of.widths
        self.at_edges = np.concatenate([[0.0], np.cumsum(pieces)])
        self._series = legendre.legint(of.coefficients, lbnd=-1, axis=1) * of.widths[:, None] / 2

    def at(self, places: Array) -> Array:
        """Return the integral up to places of any shape."""
        edges = self.of.edges
        piece = np.clip(np.searchsorted(edges, places, side="right") - 1, 0, len(edges) - 2)
        share = 2 * (places - edges[piece]) / self.of.widths[piece] - 1
        inside = np.einsum("...k,...k->...", self._series[piece], legendre.legvander(share, COUNT))
        found: Array = self.at_edges[piece] + inside
        return found


def nodes(edges: Array) -> Array:
    """Return the Gauss–Legendre places between edges, shape (pieces, 20)."""
    return edges[:-1, None] + np.diff(edges)[:, None] * (NODES + 1) / 2


def _real_roots(series: Array) -> Array:
    """Roots of a series inside [−1, 1]; coefficients that are nothing but rounding are left out."""
    size = np.abs(series).max()
    significant = np.flatnonzero(np.abs(series) > ROUNDING * size)
    if len(significant) == 0 or significant[-1] == 0:
        return np.empty(0)
    roots = legendre.legroots(series[: significant[-1] + 1])
    real = np.real(roots[np.abs(np.imag(roots)) < REAL])
    return np.clip(real[np.abs(real) <= 1 + 1e-9], -1, 1)
