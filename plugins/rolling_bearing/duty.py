"""A bearing over one cycle: its forces, and how much its rings turn, at places of the cycle that integrate exactly what is smooth."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from diecut_report.api import Curve
from diecut_report.mechanics.numerics import in_rows, narrowed
from diecut_report.plugins.rolling_bearing.ratings import Ratings

Array = NDArray[Any]
ORDER = 8  # places within a piece: polynomials up to twice that less one are integrated exactly
STILL = 1e-9  # share of the greatest value that is none


def _places() -> tuple[Array, Array, Array, Array]:
    """Places in [0, 1] with both ends, their weights (Gauss; the ends have none), barycentric ones, and the matrix that differentiates."""
    x, weights = leggauss(ORDER)
    places = np.concatenate([[0.0], (x + 1) / 2, [1.0]])
    gaps = places[:, None] - places + np.eye(len(places))
    barycentric = 1 / np.prod(gaps, axis=1)
    matrix = barycentric / barycentric[:, None] / gaps
    np.fill_diagonal(matrix, 0.0)
    np.fill_diagonal(matrix, -np.sum(matrix, axis=1))
    return places, np.concatenate([[0.0], weights / 2, [0.0]]), barycentric, matrix


PLACES, WEIGHTS, BARYCENTRIC, DERIVATIVE = _places()


@dataclass(frozen=True)
class Nodes:
    """Hold places of the cycle, (variants, pieces, places) each: both forces, and by how much each place counts."""

    share: Array
    radial: Array
    axial: Array
    turned: Array  # signed speed (or angle by share of a piece)
    weight: Array


def flat(values: Array) -> Array:
    """Return what stands at the places of all pieces, (variants, places)."""
    return values.reshape(len(values), -1)


def edges_of(nodes: Nodes) -> Array:
    """Return the edges of the pieces."""
    return np.concatenate([nodes.share[:, :, 0], nodes.share[:, -1:, -1]], axis=1)


def in_order(*places: Array) -> Array:
    """Return edges in their order, (variants, places); what is missing lies at 0."""
    return np.asarray(np.sort(np.clip(np.nan_to_num(np.concatenate(places, axis=1)), 0.0, 1.0), axis=1))


def crossings(nodes: Nodes, values: Array) -> Array:
    """Return where values change their sign, or begin or cease to be zero, (variants, most of them), NaN where there are fewer."""
    scale = np.max(np.abs(flat(values)), axis=1)[:, None, None]
    known = np.where(np.abs(values) <= STILL * scale, 0.0, values)
    variant, piece, place = np.nonzero(np.sign(known[:, :, :-1]) != np.sign(known[:, :, 1:]))
    start, width = nodes.share[variant, piece, 0], nodes.share[variant, piece, -1] - nodes.share[variant, piece, 0]
    return in_rows(start + width * _zeros(known[variant, piece], place), variant, len(values))


def _zeros(values: Array, place: Array) -> Array:
    """Where the polynomial through values (rows, places) is zero, in [0, 1] and from a place to the next."""
    rows = np.arange(len(values))
    ends, heights = PLACES[[place, place + 1]], np.stack([values[rows, place], values[rows, place + 1]])
    found: Array = np.where(heights[0] == 0, ends[0], ends[1])
    rows = rows[(heights != 0).all(axis=0)]

    def polynomial(x: Array, row: Array) -> Array:
        terms = BARYCENTRIC / (x[:, None] - PLACES)
        return np.asarray(np.sum(terms * values[rows[row]], axis=1) / np.sum(terms, axis=1))

    found[rows], _ = narrowed(polynomial, ends[0, rows], ends[1, rows], heights[:, rows])
    return found


Load = Callable[[Array, Array], Array]  # of both forces
# of shares of the cycle (rows, places), the middles of their pieces (rows, 1), and variants
Over = Callable[[Array, Array, Array], Array]

GRID = 24  # least number of pieces of the cycle
STEP = 1e-5  # share of the cycle, to either side, by which an angle is differentiated at any place
PEAKS = 4  # highest places about which the greatest value is sought
SCANNED, ZOOMS = 17, 3  # places between its neighbours, and how often they are drawn nearer about the highest


@dataclass(frozen=True)
class Duty:
    """Hold what loads and turns a bearing, for so many variants: numbers (variants, 1) or curves."""

    radial: Any
    axial: Any
    speed: Any
    angle: Any
    factor: Array
    variants: int

    @property
    def curves(self) -> list[Curve]:
        """Return what is given as a curve."""
        return [each for each in (self.radial, self.axial, self.speed, self.angle) if is_curve(each)]

    def at(self, given: Any, share: Array, middle: Array, rows: Array | None = None) -> Array:
        """Return what is given at shares of the cycle (rows, places); rows are variants (default all)."""
        own = np.arange(self.variants) if rows is None else rows
        if not is_curve(given):
            return np.broadcast_to(given[own], (len(own), share.shape[1]))
        return np.broadcast_to(given.values(share, middle, own if self.variants > 1 else None), share.shape)

    def forces(self, share: Array, middle: Array, rows: Array | None = None) -> tuple[Array, Array]:
        """Return the sizes of both forces, with the service factor."""
        factor = self.factor if rows is None else self.factor[rows]
        radial, axial = (np.abs(self.at(each, share, middle, rows)) * factor for each in (self.radial, self.axial))
        return radial, axial

    def motion(self, share: Array, middle: Array, rows: Array | None = None) -> Array:
        """Return the speed, or what the relative angle gains by share of the cycle."""
        if self.angle is None:
            return self.at(self.speed, share, middle, rows)
        return (self.at(self.angle, share + STEP, middle, rows) - self.at(self.angle, share - STEP, middle, rows)) / (
            2 * STEP
        )

    @cached_property
    def joints(self) -> Array:
        """Return the places where a force or the motion jumps or has a corner, (variants, places), as shares."""
        found = [np.broadcast_to(each.joints, (self.variants, each.joints.shape[1])) for each in self.curves]
        return np.concatenate([np.empty((self.variants, 0)), *found], axis=1)

    @cached_property
    def edges(self) -> Array:
        """Return the edges of the pieces, (variants, pieces + 1), ascending."""
        if not self.curves:
            return np.tile([0.0, 1.0], (self.variants, 1))
        even = np.tile(np.linspace(0, 1, GRID + 1), (self.variants, 1))
        inner = [np.broadcast_to(each.breakpoints, (self.variants, each.breakpoints.shape[1])) for each in self.curves]
        return in_order(even, *inner)

    def nodes(self, edges: Array) -> Nodes:
        """Return the places in pieces of these edges."""
        width = np.diff(edges, axis=1)[:, :, None]
        share = edges[:, :-1, None] + width * PLACES
        radial, axial = self._in_pieces(self.radial, edges, share), self._in_pieces(self.axial, edges, share)
        factor = self.factor[:, :, None]
        if self.angle is None:
            turned = self._in_pieces(self.speed, edges, share)
            weight = np.abs(turned) * width * WEIGHTS
        else:
            turned = self._in_pieces(self.angle, edges, share) @ DERIVATIVE.T
            weight = np.abs(turned) * WEIGHTS
        return Nodes(share, np.abs(radial) * factor, np.abs(axial) * factor, turned, weight)

    def _in_pieces(self, given: Any, edges: Array, share: Array) -> Array:
        """What is given at places (variants, pieces, places), a piece at a time."""
        if not is_curve(given):
            return np.broadcast_to(np.asarray(given, dtype=float)[:, :, None], share.shape)
        pieces = edges.shape[1] - 1
        middle = ((edges[:, :-1] + edges[:, 1:]) / 2).reshape(-1, 1)
        rows = np.repeat(np.arange(self.variants), pieces) if self.variants > 1 else None
        flat = share.reshape(-1, share.shape[2])
        return np.asarray(np.broadcast_to(given.values(flat, middle, rows), flat.shape).reshape(share.shape))

    @cached_property
    def first(self) -> Nodes:
        """Return the places where nothing is known of the bearing yet: pieces end where the motion turns round."""
        nodes = self.nodes(self.edges)
        kinks = crossings(nodes, nodes.turned)
        if self.has_axial:
            signed = (self._in_pieces(each, self.edges, nodes.share) for each in (self.radial, self.axial))
            kinks = np.concatenate([kinks, *(crossings(nodes, each) for each in signed)], axis=1)
        return self.nodes(in_order(self.edges, kinks)) if kinks.shape[1] else nodes

    @cached_property
    def has_axial(self) -> bool:
        """Return whether an axial force acts, on any variant."""
        given = self.axial
        values = self._in_pieces(given, self.edges, self._share) if is_curve(given) else given
        return bool(np.any(values != 0))

    @cached_property
    def _share(self) -> Array:
        return np.asarray(self.edges[:, :-1, None] + np.diff(self.edges, axis=1)[:, :, None] * PLACES)

    def weighed(self, ratings: Ratings) -> Nodes:
        """Return the places for a bearing: pieces end also where its axial force begins to count."""
        first = self.first
        if not self.has_axial:
            return first
        cut = self._cut(first, ratings.bends_of_factors(flat(first.axial)))
        return self._cut(cut, ratings.bends(flat(cut.radial), flat(cut.axial)))

    def _cut(self, nodes: Nodes, bends: Iterable[Array]) -> Nodes:
        """The places where pieces end also where one of these changes its sign."""
        kinks = [crossings(nodes, np.reshape(each, nodes.share.shape)) for each in bends]
        return self.nodes(in_order(edges_of(nodes), *kinks)) if any(each.shape[1] for each in kinks) else nodes

    # --- numbers of all variants, (variants, 1) ---------------------------------------------------------------------------

    def equivalent(self, ratings: Ratings, exponent: float, nodes: Nodes | None = None) -> Array:
        """Return the mean of the equivalent load by its power, weighed by the turned way; 0 where the rings do not turn."""
        nodes = nodes or self.weighed(ratings)
        load = ratings.equivalent(flat(nodes.radial), flat(nodes.axial))
        top = np.maximum(np.max(load, axis=1, keepdims=True), np.finfo(float).tiny)
        weight = flat(nodes.weight)
        whole = np.sum(weight, axis=1, keepdims=True)
        mean = np.sum((load / top) ** exponent * weight, axis=1, keepdims=True) / np.where(whole > 0, whole, 1.0)
        return np.asarray(top * mean ** (1 / exponent))

    def greatest(self, load: Load, nodes: Nodes | None = None) -> tuple[Array, Array]:
        """Return both forces where a load of them is greatest; it is known best at nodes that end where it has corners."""
        known = nodes or self.first

        def loads(share: Array, middle: Array, rows: Array) -> Array:
            of_each = (each.reshape(self.variants, -1) for each in self.forces(share, middle, rows))
            return load(*of_each).reshape(share.shape)

        place, middle = self._extreme(loads, load(flat(known.radial), flat(known.axial)), known.share)
        return self.forces(place, middle)

    def _extreme(self, function: Over, known: Array, share: Array) -> tuple[Array, Array]:
        """Where a function that is known at shares (variants, pieces, places) is greatest: the share, and the middle of its piece."""
        beside = np.pad(known, ((0, 0), (1, 1)), mode="edge")
        is_peak = (known >= beside[:, :-2]) & (known >= beside[:, 2:])
        order = np.argsort(np.where(is_peak, known, -np.inf), axis=1)[:, ::-1]
        rows = np.arange(self.variants)
        if not self.curves:
            place, _, _, middle = self._about(rows, order[:, 0], share)
            return place, middle
        peaks = order[:, :PEAKS]
        every = np.repeat(rows, peaks.shape[1])  # all peaks at once: one look at the curves costs hardly less than many
        *found, heights = self._scan(function, every, *self._about(every, peaks.ravel(), share))
        first = np.argmax(heights.reshape(peaks.shape), axis=1) + rows * peaks.shape[1]
        best, low, high, middle = (each[first] for each in found)
        for _ in range(ZOOMS):
            best, low, high, middle, _ = self._scan(function, rows, best, low, high, middle)
        return best, middle

    def _about(self, rows: Array, index: Array, share: Array) -> tuple[Array, Array, Array, Array]:
        """A place, its neighbours within its piece, and the middle of that; a row each."""
        last = share.shape[2] - 1
        piece, place = np.divmod(index, share.shape[2])
        found = (share[rows, piece, at] for at in (place, np.maximum(place - 1, 0), np.minimum(place + 1, last)))
        best, low, high = (each[:, None] for each in found)
        return best, low, high, ((share[rows, piece, 0] + share[rows, piece, -1]) / 2)[:, None]

    def _scan(
        self, function: Over, rows: Array, best: Array, low: Array, high: Array, middle: Array
    ) -> tuple[Array, Array, Array, Array, Array]:
        """The greatest of places between two, of which one is known, with its neighbours, the middle of its piece, and its height."""
        step = (high - low) / (SCANNED - 1)
        tried = np.concatenate([best, low + step * np.arange(SCANNED)], axis=1)
        heights = function(tried, middle, rows)
        top = np.argmax(heights, axis=1)[:, None]
        found, height = (np.take_along_axis(each, top, axis=1) for each in (tried, heights))
        return found, np.maximum(found - step, low), np.minimum(found + step, high), middle, height

    @cached_property
    def travel(self) -> Array:
        """Return the way that the relative angle goes in a cycle, there and back."""
        return np.asarray(np.sum(self.first.weight, axis=(1, 2))[:, None])

    @cached_property
    def swing(self) -> Array:
        """Return the width of the swing; NaN where the relative angle does not return, or goes a whole turn in all."""
        ends = [self._angle_at(np.full((self.variants, 1), share)) for share in (0.0, 1.0)]
        returns = np.abs(ends[1] - ends[0]) <= STILL * np.maximum(self.travel, 1.0)
        known = flat(self._in_pieces(self.angle, edges_of(self.first), self.first.share))
        most, least = (self._reached(sign, known) for sign in (1.0, -1.0))
        return np.where(returns & (self.travel < 2 * np.pi), most - least, np.nan)

    def _angle_at(self, share: Array) -> Array:
        """The relative angle at the start (share 0) or the end (1) of the cycle."""
        return self.at(self.angle, share, np.abs(share - STILL))

    def _reached(self, sign: float, known: Array) -> Array:
        """Return the greatest angle (sign 1) or the least (sign -1)."""
        place, middle = self._extreme(
            lambda share, middle, rows: sign * self.at(self.angle, share, middle, rows),
            sign * known,
            self.first.share,
        )
        return self.at(self.angle, place, middle)

    @cached_property
    def mean_speed(self) -> Array:
        """Return the mean size of the speed."""
        return np.asarray(np.sum(self.first.weight, axis=(1, 2))[:, None])

    @cached_property
    def greatest_axial(self) -> Array:
        """Return the greatest size of the axial force."""
        if not is_curve(self.axial):
            return np.asarray(np.abs(self.axial) * self.factor)
        return self.greatest(lambda _, axial: axial)[1]

    @cached_property
    def greatest_speed(self) -> Array:
        """Return the greatest size of the speed; of a relative angle by share of the cycle."""
        nodes = self.first
        turned = np.abs(nodes.turned)
        if self.angle is not None:
            width = nodes.share[:, :, -1:] - nodes.share[:, :, :1]
            turned = np.where(width > STILL, turned / np.where(width > STILL, width, 1.0), 0.0)
        return np.asarray(np.max(flat(turned), axis=1, keepdims=True))


def is_curve(given: Any) -> bool:
    """Return whether a curve is given."""
    return hasattr(given, "values")


def of_one_cycle(duties: Sequence[tuple[str, Curve]]) -> str | None:
    """Return the key of the first curve that runs over another cycle than those before it."""
    known = [(key, curve.cycle) for key, curve in duties if curve.cycle != "list"]
    return next((key for key, cycle in known if cycle != known[0][1]), None)
