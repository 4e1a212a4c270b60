"""Jumps of curves inside their smooth pieces: where the conditions in their formulas change, and what the curves do there.

A condition is held as its gap, which changes its sign where the condition changes. Where that happens between two points of the search
grid, or the gap comes near to zero between them, the place is found; a condition on the abscissa itself has a straight gap, so that no
window is too narrow. Here the flags of pieces are taken at each place, not at the middle of its piece: a curve is sound where it does
not move as a condition changes, and is the same with the flags of the very place. A change at the end of a piece is no fault.

Zeros of what a formula divides by, and the like, are found in the same way; there a curve is looked at nearer and nearer: it may jump, as an
angle that wraps, or go on without an end, as a pole, which is a fault at the end of a piece as well.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from functools import cache
from itertools import pairwise
from typing import NamedTuple
from weakref import proxy

import numpy as np

from diecut_report.formulas import Array
from diecut_report.formulas.tree import Node
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.numerics.conditions import (
    BranchCondition,
    CurveConditions,
    Singularity,
    conditions_of,
    is_flag,
)
from diecut_report.machine.numerics.curves import BLOCK, MANY, CurveSampler, flags_of
from diecut_report.machine.numerics.domain import shares
from diecut_report.mechanics import numerics

BESIDE = 1e-6  # share of the period within which a place is the end of its piece: what only touches there is decided by the root of rounding
INSET = 1e-9  # share of the period by which the search begins inside a piece, so that rounding decides no condition
JUMP = 1e-9  # share of a curve's greatest value by which it moves at a jump
FLAT = 0.1  # of a gap: where it moves by less about its least value, it does not reach zero
NEAR = 5  # points of the grid that tell how a gap runs from the end of its piece to the next point
BETWEEN = np.array([1 / 16, 1 / 4, 1 / 2])  # places from the end to the next point where it is looked at
ALIKE = 0.01  # of a gap: where the points beside the end tell it by so much, there is no bend between

# shares of its piece by which a curve is looked at beside a zero of what it is divided by, nearer by a tenth each time
LOOKS = np.array([1e-3, 1e-4, 1e-5, 1e-6])
INSIDE = 500.0  # times the way to the end of the piece: so far it may be wide for both sides of a jump
# times what was seen before: a jump keeps its height, and a logarithm or a pole moves by as much or more; a slope by a tenth of it, but for
# once, beside where it turns: it is seen twice
STAYS, GOES_ON = 0.85, 0.9
TORN = 1e-6  # of the size of a curve beside a place: what is no rounding of what cancels there
# of the greatest size of a gap: what comes so near to zero is zero, or may be so at the end of its piece, and is so there
TOUCHES, NEAR_END, AT_END = 1e-14, 1e-7, 1e-12

Brackets = tuple[Array, Array, Array]  # rows, and the two places (rows,) between which a condition changes


class JumpFault(NamedTuple):
    """Hold a curve that jumps: the condition that changes there (None where a flag of the piece varies without a jump), and the place (SI).

    ``is_pole``: it does not jump there, but has no end.
    """

    curve: str
    condition: BranchCondition | None
    place: float
    is_pole: bool = False


def faults(calc: Calculation, curve: str) -> Iterator[tuple[int, JumpFault]]:
    """Give the first jump of a curve inside a smooth piece of each machine (its variant) that has one and is not impossible already."""
    axis = calc.axis[curve]
    search = calc.searches.get(axis)
    if search is None or not search.holds():
        search = calc.searches[axis] = _Search(calc, axis)
    if curve not in search.searched:
        search.searched.add(curve)
        yield from ((variant, found) for variant, found in search.faults(curve) if variant not in calc.flaws)


def without_value(calc: Calculation, curve: str) -> list[int]:
    """Return the machines (variants) of which a curve has no value at some place of the search grid, and that are not impossible already."""
    table = calc.table(calc.axis[curve])
    values = table.on_grid([curve])[0]
    if np.isfinite(values.sum()):  # as nearly always
        return []
    lacks = ~np.isfinite(values).all(axis=1)
    return [int(each) for each in np.unique(table.pieces().variant[lacks]) if each not in calc.flaws]


class _Search:
    """What is known of the jumps of curves over an abscissa with its present pieces."""

    def __init__(self, calc: Calculation, axis: str) -> None:
        self.calc: Calculation = proxy(calc)
        self.axis = axis
        self.searched: set[str] = set()
        self.beside_ends: dict[str, Array] = {}  # curves at the first and last places of the search
        self.pieces = pieces = calc.table(axis).pieces()
        own = np.flatnonzero(~np.isin(pieces.variant, list(calc.flaws)))
        size = max(1, BLOCK // (pieces.intervals + 1))
        starts = np.flatnonzero(np.diff(pieces.variant[own], prepend=-1))
        cuts = starts[np.diff(starts // size, prepend=0) > 0]  # no machine in two parts, each of which fits a cache
        inset = np.minimum(INSET * pieces.period, pieces.width * shares(pieces.intervals)[1] / 2)
        self.ends = np.stack([pieces.left + inset, pieces.right - inset], axis=1)
        self.machines = [_Machines(self, rows) for rows in np.split(own, cuts) if len(rows)]

    def holds(self) -> bool:
        """Return whether the smooth pieces are still the same: a cut beside an edge leaves them."""
        return self.pieces.is_same(self.calc.table(self.axis).pieces())

    def conditions(self, curve: str) -> CurveConditions:
        """Return the conditions that a curve follows from."""
        return conditions_of(tuple(self.calc.curves.items()), self.axis, curve)

    def varies(self, name: str) -> bool:
        """Return whether a quantity varies within a piece."""
        return name == self.axis or (name in self.calc.curves and not is_flag(self.calc.curves[name]))

    def faults(self, curve: str) -> Iterator[tuple[int, JumpFault]]:
        """Give the first jump of a curve of each machine that has one."""
        known = self.conditions(curve)
        if known.direct or known.of_flags or known.varies_by_flag or known.singular:
            self._prepare(curve)
            for machines in self.machines:
                yield from machines.faults(curve, known).items()

    def coming(self, curve: str) -> list[str]:
        """Return the curve, and those that will be asked for."""
        ahead = self.calc.ahead.get(self.axis, ())
        return [curve, *(each for each in ahead if each in self.calc.curves and each != curve)]

    def _prepare(self, curve: str) -> None:
        """Compute what the conditions of this curve and of the coming ones take, all together, as most of it is a part of them."""
        names = dict.fromkeys(name for each in self.coming(curve) for name in self.conditions(each).names)
        if new := [name for name in names if name not in self.beside_ends]:
            table = self.calc.table(self.axis)
            table.on_grid([*new, curve])
            self.beside_ends |= zip(new, table.curves(new).at(self.ends), strict=True)


class _Machines:
    """The smooth pieces of some machines, a row each, and the search grid in them."""

    def __init__(self, search: _Search, own: Array) -> None:
        self.search: _Search = proxy(search)
        self.calc, self.axis, self.own, pieces = search.calc, search.axis, own, search.pieces
        self.variant, self.left, self.right = pieces.variant[own], pieces.left[own], pieces.right[own]
        self.near = BESIDE * np.broadcast_to(pieces.period, pieces.variant.shape)[own]
        self.x = pieces.grid(own)
        self.x[:, [0, -1]] = search.ends[own]
        self.changes: dict[Hashable, Brackets] = {}
        self.zeros: dict[Hashable, tuple[Array, Array, Array]] = {}
        self.ends_of: dict[
            Hashable, tuple[Array, Array]
        ] = {}  # of what is divided by: sizes at both ends, and greatest
        self.by_own_flags: dict[bytes, dict[str, Array]] = {}  # for rows, curves at the inner points of the grid
        self.on_grid = _GridSampler(self)

    def faults(self, curve: str, known: CurveConditions) -> dict[int, JumpFault]:
        """Return the first jump of a curve of each machine that has one."""
        changes = {condition: self.where_changes(condition) for condition in (*known.direct, *known.of_flags)}
        changes = {condition: brackets for condition, brackets in changes.items() if len(brackets[0])}
        varying = self.varying(known)
        found: dict[int, JumpFault] = {}
        if changes or len(varying):
            heights = self.calc.table(self.axis).on_grid([curve])[0][self.own]
            for row, condition, place in self._moved(curve, changes, varying, heights):
                found.setdefault(int(self.variant[row]), JumpFault(curve, condition, place))
        for singular in known.singular:
            for row, place, is_pole in self._torn(curve, singular):
                found.setdefault(int(self.variant[row]), JumpFault(curve, singular, place, is_pole))
        return found

    def _moved(
        self, curve: str, changes: Mapping[BranchCondition, Brackets], varying: Array, heights: Array
    ) -> Iterator[tuple[int, BranchCondition | None, float]]:
        """Give where a curve moves as a condition changes, and where it is another one with the flags of the very place."""
        greatest = np.zeros(self.calc.count)
        np.fmax.at(greatest, self.variant, np.fmax.reduce(np.abs(heights), axis=1))
        moves = JUMP * greatest[self.variant]  # by how much the curve of each piece's machine moves at a jump
        for condition, (row, low, high) in changes.items():
            before, after = (self.at(x[:, None], row, [curve]).over(curve)[:, 0] for x in (low, high))
            reported = condition if any(map(self.search.varies, condition.names)) else None
            for i in np.flatnonzero(np.abs(after - before) > moves[row]):
                yield row[i], reported, float(high[i])
        if len(varying):
            x, near = self.x[varying, 1:-1], self.near[varying, None]
            apart = np.abs(self._with_own_flags(curve, x, varying) - heights[varying, 1:-1]) > moves[varying, None]
            apart &= (x - self.left[varying, None] > near) & (self.right[varying, None] - x > near)
            for i, k in np.argwhere(apart):
                yield varying[i], None, float(x[i, k])

    def _torn(self, curve: str, zero: Singularity) -> Iterator[tuple[int, float, bool]]:
        """Give where a curve stays apart on both sides of a zero, and where it goes on without an end towards one: there alone at the ends
        of pieces, too."""
        row, place, is_inside = self._zeros(zero)
        if not len(row):
            return
        width, room = (self.right - self.left)[row], np.minimum(place - self.left[row], self.right[row] - place)
        both, each = self._beside(curve, row, place, [np.minimum(width, INSIDE * room), width])
        least = TORN * np.abs(both[0]).max(axis=1)
        apart = [np.abs(np.diff(sides, axis=1)[:, 0]) for sides in both[1:]]
        stays = [(b > least) & (b > STAYS * a) & (a > STAYS * b) for a, b in pairwise(apart)]
        yield from ((row[i], float(place[i]), False) for i in np.flatnonzero(is_inside & np.all(stays, axis=0)))
        is_there = np.stack([place - self.left[row], self.right[row] - place], axis=1) > LOOKS[0] * width[:, None]
        looks = [np.where(is_there, sides, 0.0) for sides in each]
        moved = [np.abs(b - a) for a, b in pairwise(looks)]
        goes_on = np.all([(b > TORN * np.abs(looks[0])) & (b > GOES_ON * a) for a, b in pairwise(moved)], axis=0)
        is_pole = (goes_on | ~np.isfinite(looks[-1])).any(axis=1)
        yield from ((row[i], float(place[i]), True) for i in np.flatnonzero(is_pole))

    def _zeros(self, zero: Singularity) -> tuple[Array, Array, Array]:
        """Rows and places where what curves are divided by is zero, and which of them lie inside their pieces, not at an end."""
        if zero.meaning not in self.zeros:
            row, _, place = self.where_changes(zero)
            at_end, end = self._zero_at_ends(zero)
            is_inside = np.arange(len(row) + len(at_end)) < len(row)
            self.zeros[zero.meaning] = np.concatenate([row, at_end]), np.concatenate([place, end]), is_inside
        return self.zeros[zero.meaning]

    def _beside(self, curve: str, row: Array, place: Array, widths: Sequence[Array]) -> list[list[Array]]:
        """A curve before and behind places, nearer each time, shape (rows, 2), by shares of each of some widths; within the pieces."""
        sides = np.repeat(LOOKS, 2) * np.tile([-1, 1], len(LOOKS))
        x = place[:, None] + np.concatenate([width[:, None] * sides for width in widths], axis=1)
        x = np.clip(x, self.left[row, None], self.right[row, None])
        with np.errstate(all="ignore"):
            values = self.at(x, row, [curve]).over(curve)
        return [np.split(each, len(LOOKS), axis=1) for each in np.split(values, len(widths), axis=1)]

    def _zero_at_ends(self, zero: Singularity) -> tuple[Array, Array]:
        """Rows, and the end of the piece, where what a curve is divided by is zero there."""
        ends, greatest = self.ends_of[zero.meaning]
        row, end = np.nonzero(ends <= NEAR_END * greatest[:, None])
        place = np.where(end == 0, self.left[row], self.right[row])
        if not len(row):
            return row, place
        is_zero = np.abs(self._sides(zero, place[:, None], row)[1][:, 0]) <= AT_END * greatest[row]
        return row[is_zero], place[is_zero]

    def _with_own_flags(self, curve: str, x: Array, row: Array) -> Array:
        """A curve at places with the flags of the very places, computed together with those that will be asked for."""
        known = self.by_own_flags.setdefault(row.tobytes(), {})
        if curve not in known:
            names = [each for each in self.search.coming(curve) if self.varying(self.search.conditions(each)).size]
            sampler = self.at(x, row, names)
            known |= {name: sampler.over(name) for name in names}
        return known[curve]

    def varying(self, known: CurveConditions) -> Array:
        """Return in which pieces flags may vary that a curve follows from."""
        if known.varies_by_flag:
            return np.arange(len(self.own))
        rows = [self.where_changes(condition)[0] for condition in known.of_flags]
        return np.unique(np.concatenate(rows)) if rows else np.arange(0)

    def where_changes(self, condition: BranchCondition) -> Brackets:
        """Return where a condition changes inside a piece: neighbouring places before and after."""
        if condition.meaning not in self.changes:
            side, gap = condition.sides(self.on_grid.__getitem__, self.x)
            if isinstance(condition, Singularity):
                self.ends_of[condition.meaning] = np.abs(gap[:, [0, -1]]), np.abs(gap).max(axis=1)
            row, k = _nonzero(side[:, 1:] != side[:, :-1])
            found = [(row, self.x[row, k], self.x[row, k + 1]), *self._hidden(condition, side, gap)]
            row, low, high = (np.concatenate(columns) for columns in zip(*found, strict=True))
            if len(row):
                before = self._side(condition, low[:, None], row)
                low, high = numerics.first(lambda x, own: self._side(condition, x, row[own]) != before[own], low, high)
                inner = (high - self.left[row] > self.near[row]) & (self.right[row] - low > self.near[row])
                row, low, high = row[inner], low[inner], high[inner]
            self.changes[condition.meaning] = row, low, high
        return self.changes[condition.meaning]

    def _hidden(self, condition: BranchCondition, side: Array, gap: Array) -> Iterator[Brackets]:
        """Where a condition changes and changes back between two points of the grid: it is asked where that may be."""
        for row, k, place in filter(lambda asked: len(asked[0]), self._asked(condition, side, gap)):
            here, least = (each[:, 0] for each in self._sides(condition, place[:, None], row))
            for beside in self._neighbours(k):
                other = np.flatnonzero(here != side[row, beside])
                ends = np.sort([place[other], self.x[row[other], beside[other]]], axis=0)
                yield row[other], ends[0], ends[1]
            if isinstance(condition, Singularity):  # which touches zero and turns
                touches = np.abs(least) <= TOUCHES * np.abs(gap[row]).max(axis=1)
                yield row[touches], place[touches], place[touches]

    def _asked(self, condition: BranchCondition, side: Array, gap: Array) -> Iterator[tuple[Array, Array, Array]]:
        """Rows, points of the grid and a place near each: where the gap is nearest to zero, and the arguments of functions that level off
        are least, greatest or nearest to zero."""
        row, k = _dips(gap, side, self.search.pieces.intervals)
        sign = np.sign(gap[row, k])[:, None]
        yield self._least(condition, condition.gap, row, k, lambda values: sign * values, _may_reach)
        for part in condition.arguments(self.search.varies):
            values = condition.value(part, self.on_grid.__getitem__, self.x)
            for size in (np.abs, np.positive, np.negative):
                yield self._least(condition, part, *_lowest(size(values)), size)

    def _least(
        self, condition: BranchCondition, part: Node, row: Array, k: Array, size: Callable[[Array], Array],
        goes_on: Callable[[Array], bool] | None = None,
    ) -> tuple[Array, Array, Array]:  # fmt: skip
        """Where the size of a part of a condition is least near points of the grid."""
        if not len(row):
            return row, k, np.zeros(0)
        low, high = (self.x[row, each] for each in self._neighbours(k))

        def sizes(x: Array, own: Array) -> Array:
            return size(condition.value(part, self._known(condition, x, row[own]), x))

        return row, k, numerics.least(sizes, low, high, goes_on=goes_on)[0]

    def _neighbours(self, k: Array) -> tuple[Array, Array]:
        return np.maximum(k - 1, 0), np.minimum(k + 1, self.x.shape[1] - 1)

    def _side(self, condition: BranchCondition, x: Array, row: Array) -> Array:
        return self._sides(condition, x, row)[0]

    def _sides(self, condition: BranchCondition, x: Array, row: Array) -> tuple[Array, Array]:
        return condition.sides(self._known(condition, x, row), x)

    def _known(self, condition: BranchCondition, x: Array, row: Array) -> Callable[[str], Array]:
        return self.at(x, row, [name for name in condition.names if name in self.calc.curves]).__getitem__

    def at(self, x: Array, row: Array, curves: Sequence[str]) -> CurveSampler:
        """Return curves at places (rows, points) of these pieces, with the flags of the very places; of many machines they are compiled."""
        found = self.calc.sampler_of(self.axis, x, x, self.variant[row])
        if self.calc.count >= MANY and x.size:
            values = flags_of(self.calc, self.axis, tuple(curves), x.ravel(), self.variant[row].repeat(x.shape[1]))
            found.known |= {name: each.reshape(x.shape) for name, each in zip(curves, values, strict=True)}
        return found


class _GridSampler(CurveSampler):
    """Curves on the search grid of some machines, where most are known, with the flags of the very places."""

    def __init__(self, machines: _Machines) -> None:
        super().__init__(machines.calc, machines.axis, machines.x, machines.x, machines.variant)
        self.machines: _Machines = proxy(machines)

    def _compute(self, name: str) -> Array:
        machines, step = self.machines, self.owner.curves.get(name)
        if step is None or is_flag(step):
            return super()._compute(name)
        search = machines.search
        found: Array = machines.calc.table(self.axis).on_grid([name])[0][machines.own]
        found[:, [0, -1]] = search.beside_ends[name][machines.own]
        row = machines.varying(search.conditions(name))
        if len(row):
            found[row] = machines.at(self.x[row], row, [name]).over(name)
        return found


def _nonzero(marks: Array) -> tuple[Array, Array]:
    """Rows and columns of marks (rows, columns) of which few are set."""
    row, k = np.divmod(np.flatnonzero(marks), marks.shape[1])
    return row, k


def _lowest(values: Array) -> tuple[Array, Array]:
    """Points of the grid, by row and number, that are no higher than those beside them, and lower than one of them."""
    falls, rises = values[:, 1:] <= values[:, :-1], values[:, :-1] <= values[:, 1:]
    is_low = np.concatenate([rises[:, :1], falls[:, :-1] & rises[:, 1:], falls[:, -1:]], axis=1)
    row, k = _nonzero(is_low)
    last = values.shape[1] - 1
    beside = values[row, np.where(k > 0, k - 1, 1)], values[row, np.where(k < last, k + 1, last - 1)]
    is_lower = values[row, k] < np.maximum(*beside)
    return row[is_lower], k[is_lower]


def _dips(gap: Array, side: Array, intervals: int) -> tuple[Array, Array]:
    """Such points where the size of a gap is lower than beside it by as much as itself, without a change of the condition beside it."""
    size, last = np.abs(gap), gap.shape[1] - 1
    is_half = np.zeros(size.shape, dtype=bool)
    np.less_equal(2 * size[:, 1:], size[:, :-1], out=is_half[:, 1:])
    is_half[:, :-1] |= 2 * size[:, :-1] <= size[:, 1:]
    row, k = _nonzero(is_half)  # few, so that the rest is asked of these alone
    before, after = np.where(k > 0, k - 1, 1), np.where(k < last, k + 1, last - 1)
    here, *beside = size[row, k], size[row, before], size[row, after]
    found = (here <= np.minimum(*beside)) & (here < np.maximum(*beside))
    found &= (side[row, before] == side[row, after]) & (side[row, k] == side[row, after])
    row, k = row[found], k[found]
    for end, inwards in ((0, gap), (last, gap[:, ::-1])):
        if len(at_end := np.flatnonzero(k == end)):
            rising = at_end[_rises(inwards[row[at_end], :NEAR], intervals)]
            row, k = np.delete(row, rising), np.delete(k, rising)
    return row, k


def _rises(gap: Array, intervals: int) -> Array:
    """Whether gaps (rows, NEAR) at the first points of pieces are least at the end, by the polynomial through them.

    The points without the end must tell the gap there: no bend hides between the end and the next point.
    """
    at_end, between = (gap @ each.T for each in _beside_end(intervals))
    tells = np.abs(at_end - gap[:, :1]) <= ALIKE * np.abs(gap[:, 1:2])
    rising = (np.abs(between) >= np.abs(gap[:, :1])) & ((between > 0) == (gap[:, 1:2] > 0))
    found: Array = (tells & rising).all(axis=1)
    return found


@cache
def _beside_end(intervals: int) -> tuple[Array, Array]:
    """What points of the grid count at the end of a piece, without that, and between the end and the next point."""
    points = shares(intervals)[:NEAR] / shares(intervals)[1]
    inner, every = (np.linalg.inv(np.vander(known)) for known in (points[1:], points))
    return np.hstack([np.zeros((1, 1)), np.vander([0.0], NEAR - 1) @ inner]), np.vander(BETWEEN, NEAR) @ every


def _may_reach(gap: Array) -> bool:
    """Whether any of gaps (rows, places), above zero at their ends, may come down to zero between their places and has not yet."""
    least = gap.min(axis=1)
    turns = (least < gap[:, 0]) & (least < gap[:, -1]) & (least > 0)
    return bool((turns & (np.ptp(gap, axis=1) > FLAT * least)).any())
