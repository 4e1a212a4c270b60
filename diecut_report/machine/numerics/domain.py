"""An abscissa with its breakpoints, for all variants: the smooth pieces that curves are taken over."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from hashlib import blake2b
from typing import Any, Generic, Protocol, TypeVar

import numpy as np
from numpy.polynomial.legendre import leggauss

from diecut_report.formulas import Array
from diecut_report.mechanics import numerics
from diecut_report.mechanism.steps import Step

INTERVALS = 64  # of the search grid in each smooth piece, where an abscissa declares none

SAME = 1e-13  # share of the period within which two breakpoints are one


@cache
def shares(intervals: int) -> Array:
    """Return the search grid in a piece from 0 to 1: Chebyshev–Lobatto points, ends included."""
    return (1 - np.cos(np.pi * np.arange(intervals + 1) / intervals)) / 2


@cache
def grid_weights(intervals: int) -> Array:
    """Return weights of the Clenshaw–Curtis rule on the search grid, for a piece of the width 1."""
    k, even = np.arange(intervals + 1), np.arange(2, intervals, 2)
    inner = 1 - (2 / (even**2 - 1) * np.cos(np.pi * k[:, None] * even / intervals)).sum(axis=1)
    inner = (inner - np.cos(np.pi * k) / (intervals**2 - 1)) / intervals
    inner[[0, -1]] /= 2
    found: Array = inner
    return found


@cache
def nodes_of(order: int) -> tuple[Array, Array]:
    """Return Gauss–Legendre points in [-1, 1] and their weights."""
    node, weight = leggauss(order)
    return node, weight


SMALLEST = float(np.finfo(float).tiny / np.finfo(float).eps)  # a number below it is not known to full precision

FEW_EDGES = 40  # up to which edges are compared with all places at once
FEW_PLACES = 64  # of a row, up to which all rows are halved together: a search for each one costs more than it finds


Inside = tuple[Array, Array]  # the middles of all pieces (rows, pieces), and which of them each place lies in


def piece_of(edges: Array, x: Array) -> Array:
    """Return the piece that each x (rows, points) lies in, of pieces with these edges (rows, pieces + 1), or (1, pieces + 1) for all rows."""
    inner = edges[:, 1:-1]
    if len(inner) == 1:
        return np.searchsorted(inner[0], x, side="right")
    if inner.shape[1] <= FEW_EDGES:
        return np.asarray((x[:, :, None] >= inner[:, None, :]).sum(axis=2))
    if x.shape[1] <= FEW_PLACES:
        return _halved(inner, x)
    return np.stack([np.searchsorted(row, places, side="right") for row, places in zip(inner, x, strict=True)])


def _halved(ascending: Array, x: Array) -> Array:
    """As ``searchsorted`` from the right, for each row of places (rows, points) in its own row of numbers."""
    count, rows = ascending.shape[1], np.arange(len(x))[:, None]
    found = np.zeros(x.shape, dtype=np.intp)
    for step in (1 << bit for bit in reversed(range(count.bit_length()))):
        next_ = found + step
        is_beyond = x < ascending[rows, np.minimum(next_, count) - 1]  # a NaN is beyond nothing, and comes last
        found = np.where((next_ <= count) & ~is_beyond, next_, found)
    return found


def _of(table: Array, rows: Array | None) -> Array:
    """The rows of some variants (default all) of a table with a row for each variant, or with one for all."""
    return table if rows is None or len(table) == 1 else table[rows]


def _all_near(edges: Array, places: Array, within: Array) -> bool:
    """Whether each place is an edge already (each row having its own), so that it cuts nothing."""
    if places.shape[1] > FEW_EDGES:
        return False
    near = (np.abs(places[:, :, None] - edges[:, None, :]) < within[:, :, None]).any(axis=2)
    return bool((near | np.isnan(within)).all())


def _without_doubles(edges: Array) -> Array:
    """Edges each once: those that came twice are moved to the end of the period, as far as no other variant has more."""
    last = edges[:, -1:]
    inner = np.where(np.diff(edges[:, :-1], axis=1) > 0, edges[:, 1:-1], last)
    most = int((inner < last).sum(axis=1).max())
    return np.concatenate([edges[:, :1], np.sort(inner, axis=1)[:, :most], last], axis=1)


@dataclass
class Domain:
    """Hold the range [0, period) of an abscissa, cut at breakpoints; ``edges`` has shape (variants, pieces + 1), ascending.

    ``period`` has shape (variants, 1). Variants may have fewer pieces than others: the missing ones have no width and lie at
    the end of the period. ``joints`` are the edges where curves jump or have a corner; more edges serve the search alone.
    """

    period: Array
    samples: Array
    intervals: int = INTERVALS
    edges: Array = field(init=False)
    joints: Array = field(init=False)
    _made: tuple[Array, Array, Array] | None = field(init=False, default=None, repr=False, compare=False)

    def __post_init__(self) -> None:
        self.edges = self.joints = np.concatenate([np.zeros_like(self.period), self.period], axis=1)

    def of_rows(self, rows: Array) -> Domain:
        """Return the range of machines each of which is one of these variants."""
        found = replace(self, period=self.period[rows], samples=self.samples[rows])
        found.edges, found.joints = self.edges[rows], self.joints[rows]
        return found

    def cut(self, places: Array) -> None:
        """Add breakpoints, shape (variants, any number); NaN stands for none."""
        same = self.edges is self.joints
        self.edges = self._with(self.edges, places)
        self.joints = self.edges if same else self._with(self.joints, places)

    def cut_every(self, length: Array) -> None:
        """Let no piece be longer than a length, shape (variants, 1), for the search of extremes and for integrals.

        A length that is NaN or not above zero cuts nothing.
        """
        length = np.where(length > 0, length, np.nan)
        count = int(np.nan_to_num(self.period / length).max())
        places = length * np.arange(1, count + 1)
        self.cut_finer(np.where(places < self.period, places, np.nan))

    def cut_finer(self, places: Array) -> None:
        """Add edges, as ``cut`` does, where no curve jumps or has a corner."""
        self.edges = self._with(self.edges, places)

    def _with(self, known: Array, places: Array) -> Array:
        is_place = np.isfinite(places)
        inside = np.where(is_place, np.mod(places, self.period), self.period)
        inside = np.where(self.period - inside < SAME * self.period, self.period, inside)
        if not places.shape[1] or (is_place.any() and _all_near(known, inside, SAME * self.period)):
            return known
        edges = np.sort(np.concatenate([known, inside], axis=1), axis=1)
        steps = np.diff(edges[:, :-1], axis=1)
        is_twice = ((steps > 0) & (steps < SAME * self.period)).any()
        for i in range(1, edges.shape[1] - 1 if is_twice else 1):  # one place that came with other rounding stays one
            close = edges[:, i] - edges[:, i - 1] < SAME * self.period[:, 0]
            edges[:, i] = np.where(close, edges[:, i - 1], edges[:, i])
        return _without_doubles(edges)

    @property
    def proof_order(self) -> int:
        """Return the order of the Gauss–Legendre points at which what the search grid gives is proved; fewer, as they serve nothing else."""
        return self.intervals // 4 + 8

    def is_joint(self, places: Array) -> Array:
        """Return which places (variants, any number) are breakpoints of curves."""
        last = self.joints.shape[1] - 1
        rows = zip(self.joints, places, strict=True)
        above = np.stack([np.searchsorted(joints, row) for joints, row in rows]).reshape(places.shape)
        beside = (np.take_along_axis(self.joints, np.clip(above - before, 0, last), axis=1) for before in (0, 1))
        near: Array = np.logical_or(*(np.abs(places - joint) <= SAME * self.period for joint in beside))
        return near

    def period_of(self, rows: Array | None) -> Array:
        """Return the period of variants (default all), shape (rows, 1)."""
        return _of(self.period, rows)

    def middle_of(self, x: Array, rows: Array | None = None) -> Array:
        """Return the middle of the piece that each x (rows, points) lies in; at a breakpoint the piece that begins there.

        At the end of the period it is the last piece that has a width.
        """
        return np.take_along_axis(self.middles_of(rows), self.middle_piece_of(x, rows), axis=1)

    def middle_piece_of(self, x: Array, rows: Array | None = None) -> Array:
        """Return which piece that is, (rows, points)."""
        return np.minimum(piece_of(_of(self.edges, rows), x), _of(self._pieces[2], rows))

    def placed(self, share: Array, middle: Array, rows: Array | None) -> tuple[Array, Array, Inside | None]:
        """Return places and the middles of their pieces for shares of the period (rows, points), each in the piece of its middle.

        Where each place has a middle of its own, and pieces are fewer than places, it is also told which piece it is.
        """
        period, middles = self.period_of(rows), self.middles_of(rows)
        piece = self.middle_piece_of(middle * period, rows)
        is_each = np.shape(middle) == np.shape(share) and middles.shape[1] < share.shape[1]
        own = middles[0].take(piece) if len(middles) == 1 else np.take_along_axis(middles, piece, axis=1)
        return share * period, own, (middles, piece) if is_each else None

    def middles_of(self, rows: Array | None) -> Array:
        """Return the middle of each piece of variants (default all), shape (rows, pieces)."""
        return _of(self.middles, rows)

    @property
    def middles(self) -> Array:
        """Return the middle of each piece, shape (variants, pieces)."""
        return self._pieces[1]

    @property
    def _pieces(self) -> tuple[Array, Array, Array]:
        """The edges with the middles of the pieces between them, and the number of the last piece that has a width: made once for edges."""
        if self._made is None or self._made[0] is not self.edges:
            edges = self.edges
            last = np.sum(edges < edges[:, -1:], axis=1, keepdims=True) - 1
            self._made = edges, (edges[:, 1:] + edges[:, :-1]) / 2, last
        return self._made

    @property
    def widths(self) -> Array:
        """Return the width of each piece, shape (variants, pieces)."""
        return np.diff(self.edges, axis=1)


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
        return numerics.at_places(terms, variant * self.series.shape[2] + piece, place)


class CalculatedMachines(Protocol):
    """Hold what curves are evaluated of: the calculation of one machine or of many."""

    count: int
    curves: dict[str, Step]
    domains: dict[str, Domain]
    inputs: dict[str, Any]
    series: dict[str, PieceSeries]
    ahead: dict[str, tuple[str, ...]]

    def __getitem__(self, name: str) -> Array: ...
    def sampler_of(
        self, axis: str, x: Array, middle: Array, rows: Array | None, inside: Inside | None = None
    ) -> Any: ...
    def of_pieces(self, axis: str) -> Any: ...


# The places at which curves were asked for last: who takes several curves of a machine asks for each at the same places.


Sampler = TypeVar("Sampler")


class RecentPlaces(Generic[Sampler]):
    """Keep what gives the curves at certain places, so that what they have in common is computed once."""

    def __init__(self, most: int) -> None:
        """Keep as many places."""
        self.most = most
        self._known: dict[tuple[object, ...], Sampler] = {}

    def at(self, axis: str, places: Iterable[Array | None], make: Callable[[], Sampler]) -> Sampler:
        """Return what gives the curves over an abscissa at places (x, the middles of their pieces, the variants); made where it is not known."""
        key = (axis, *(None if each is None else (each.shape, each.tobytes()) for each in places))
        found = self._known.pop(key) if key in self._known else make()
        self._known[key] = found
        if len(self._known) > self.most:
            del self._known[next(iter(self._known))]
        return found

    def forget(self) -> None:
        """Forget all places."""
        self._known.clear()


# Curves of many machines at the places at which others asked for them: several mechanisms that take the same curves ask alike.


MOST = 32 * 2**20  # bytes of values that are kept
Evaluate = Callable[[Sequence[str]], Sequence[Array]]


class SharedPlaces:
    """Keep the values of curves at the places that were asked for last.

    Who asks for a curve and then for others at the same places gets all of these at once the next time: what they have in common
    is computed once.
    """

    def __init__(self, most: int = MOST) -> None:
        """Keep so many bytes of values."""
        self.most, self._bytes = most, 0
        self._known: dict[bytes, dict[str, Array]] = {}
        self._followers: dict[str, list[str]] = defaultdict(list)

    def at(self, name: str, axis: str, places: Iterable[Array | None], evaluate: Evaluate) -> Array:
        """Return a curve over an abscissa at places (x, the middles of their pieces, the variants); evaluated where it is not known."""
        key = _digest(axis, places)
        found = self._known.pop(key, {})
        self._known[key] = found
        if name not in found:
            leader = next(iter(found), name)
            wanted = [name, *self._followers[name]] if leader == name else [name]
            if leader != name and name not in self._followers[leader]:
                self._followers[leader].append(name)
            self._keep(found, wanted, evaluate(wanted))
        return found[name]

    def _keep(self, found: dict[str, Array], names: Sequence[str], values: Sequence[Array]) -> None:
        for name, each in zip(names, values, strict=True):
            each.flags.writeable = False  # others will read it
            found[name] = each
            self._bytes += each.nbytes
        while self._bytes > self.most and len(self._known) > 1:
            oldest = self._known.pop(next(iter(self._known)))
            self._bytes -= sum(each.nbytes for each in oldest.values())

    def forget(self) -> None:
        """Forget all places."""
        self._known.clear()
        self._bytes = 0


def _digest(axis: str, places: Iterable[Array | None]) -> bytes:
    found = blake2b(axis.encode(), digest_size=16)
    for each in places:
        found.update(repr(None if each is None else (each.shape, each.dtype.str)).encode())
        if each is not None:
            found.update(np.ascontiguousarray(each).data if each.size else b"")
    return found.digest()
