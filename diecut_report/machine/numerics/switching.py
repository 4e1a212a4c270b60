"""Where curves jump inside the smooth pieces of some machines: their decisions and the flags of pieces, on the search grid and between its points."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple, Protocol
from weakref import proxy

import numpy as np

from diecut_report.formulas import Array
from diecut_report.formulas.tree import symbols
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.curve_samples import CurveSampler
from diecut_report.machine.numerics.curves import BLOCK, MANY, Curves
from diecut_report.machine.numerics.decisions import (
    Deciding,
    Decision,
    asked,
    decided,
    is_decided,
    key,
    over,
    side,
    value,
)
from diecut_report.machine.numerics.domain import shares
from diecut_report.machine.numerics.extremes import arguments, places
from diecut_report.machine.numerics.jumps import NEAR, SOME, lowest, may_reach, nonzero, rises, some
from diecut_report.machine.numerics.samples import PIECE, CachedPieces
from diecut_report.mechanism.chapters import taken

APART = 1e-6  # share of the period within which a place is the end of its piece: what only touches there is decided by the root of rounding
JUMP = 1e-9  # share of a curve's greatest value by which it moves at a jump
ZOOMS, PARTS = 12, 16  # how often the place where a difference is least is looked at in so many parts of what is left
HALVINGS = 60  # of an interval of the grid: down to the rounding of a place


class JumpFault(NamedTuple):
    """Hold a curve that jumps: what decides there (None where a flag of the piece varies in it without a jump), and the place (SI)."""

    curve: str
    decision: Decision | None
    place: float


Brackets = tuple[Array, Array, Array]  # rows, and the two places (rows,) between which a decision changes
Varying = tuple[Array, Array]  # rows, and points of the grid where something is not what it is in the middle


class JumpSearch(Protocol):
    """Hold what is known of all machines."""

    calc: Calculation
    axis: str
    pieces: CachedPieces
    ends: dict[str, Array]

    def asked(self, curve: str) -> Deciding:
        """Return what makes a curve jump."""

    def coming(self, curve: str) -> list[str]:
        """Return the curve, and those that will be asked for."""

    def is_curve(self, name: str) -> bool:
        """Return whether a quantity varies within a piece and is computed."""


class SearchedMachines:
    """The smooth pieces of some machines, a row each, and the search grid in them; here flags of pieces are taken at each place."""

    def __init__(self, search: JumpSearch, own: Array) -> None:
        self.search: JumpSearch = proxy(search)
        self.calc, self.axis, self.own, pieces = search.calc, search.axis, own, search.pieces
        self.variant, self.middle = pieces.variant[own], pieces.middle[own]
        self.left, self.right = pieces.left[own], pieces.right[own]
        self.near = APART * np.broadcast_to(self.calc.domains[self.axis].period_of(self.variant)[:, 0], len(own))
        self.x = pieces.grid(own)
        self.x[:, [0, -1]] = pieces.inside(self.x[:, [0, -1]], own)
        self.row = np.arange(len(own))
        self.changes: dict[Decision, Brackets] = {}
        self.apart: dict[Any, Varying] = {}  # for what flags decide, and flags: rows, and points (rows, all)
        self.varying: dict[Any, tuple[Varying, dict[str, Array]] | None] = {}  # for these, with curves there

    def faults(self, curve: str, question: Deciding) -> dict[int, JumpFault]:
        """Return the first jump of a curve of each machine that has one."""
        on_grid = GridSampler(self)
        changing = {decision: self._changes(decision, on_grid) for decision in question.changing}
        varying = self._varying(question, on_grid)
        found: dict[int, JumpFault] = {}
        if varying or any(len(row) for row, *_ in changing.values()):
            heights = self.calc.table(self.axis).on_grid([curve])[0][self.own]
            size = self._size(heights)
            for row, decision, place in (
                *self._jumps(curve, changing, size),
                *self._flagged(curve, varying, heights, size),
            ):
                found.setdefault(int(self.variant[row]), JumpFault(curve, decision, place))
        return found

    def _size(self, heights: Array) -> Array:
        """By how much a curve moves at a jump in the machine of each piece."""
        greatest = np.zeros(self.calc.count)
        np.fmax.at(greatest, self.variant, np.fmax.reduce(np.abs(heights), axis=1))
        found: Array = JUMP * greatest[self.variant]
        return found

    def _jumps(
        self, curve: str, changing: Mapping[Decision, Brackets], size: Array
    ) -> Iterator[tuple[int, Decision, float]]:
        """Give where a curve jumps as a decision changes."""
        for decision, (row, low, high) in changing.items():
            if len(row):
                before, after = (over(self.sampler(x, row)[curve], x)[:, 0] for x in (low[:, None], high[:, None]))
                for i in np.flatnonzero(np.abs(after - before) > size[row]):
                    yield row[i], decision, float(high[i])

    # --- flags of pieces -----------------------------------------------------------------------------------------------

    def _flagged(
        self, curve: str, varying: Sequence[tuple[Varying, dict[str, Array]]], heights: Array, size: Array
    ) -> Iterator[tuple[int, None, float]]:
        """Give where a curve would be another one with a flag of that very place."""
        for (row, k), known in varying:
            x = self.x[row[:, None], k]
            if curve not in known:
                curves = [
                    each for each in self.search.coming(curve) if each == curve or _by_flags(self.search.asked(each))
                ]
                places = x.reshape(-1, 1)
                found = Curves(self.calc, self.axis, curves, places[:, 0], self.variant[row].repeat(SOME)).at(places)
                known |= {name: values.reshape(x.shape) for name, values in zip(curves, found, strict=True)}
            apart = np.abs(known[curve] - heights[row[:, None], k])
            for i, j in np.argwhere(apart > size[row][:, None]):
                yield row[i], None, float(x[i, j])

    def _varying(self, question: Deciding, on_grid: GridSampler) -> list[tuple[Varying, dict[str, Array]]]:
        """Return in which pieces something is not constant that a curve takes of flags, and some points of the grid where it is not."""
        for what in _by_flags(question):
            if key(what) not in self.varying:
                row, apart = self._apart(what, on_grid)
                self.varying[key(what)] = self._once((row, some(apart))) if len(row) else None
        found = (self.varying[key(what)] for what in _by_flags(question))
        return list({id(each): each for each in found if each is not None}.values())

    def _once(self, where: Varying) -> tuple[Varying, dict[str, Array]]:
        """Return one for all that varies in the same places."""
        known = (each for each in self.varying.values() if each is not None)
        return next((each for each in known if all(map(np.array_equal, each[0], where))), (where, {}))

    def varying_rows(self, curve: str, on_grid: GridSampler) -> Array:
        """Return in which pieces something is not constant that a curve takes of flags."""
        rows = [self._apart(what, on_grid)[0] for what in _by_flags(self.search.asked(curve))]
        return np.unique(np.concatenate(rows)) if rows else self.row[:0]

    def _apart(self, what: Decision | str, on_grid: GridSampler) -> Varying:
        """In which pieces a flag, or what flags decide, is not constant, and at which points of the grid it is not as in the middle."""
        own = key(what)
        if own not in self.apart:
            row = self._open(what, on_grid)
            apart = self._is_apart(what, row, on_grid) if len(row) else np.empty((0, self.x.shape[1]), dtype=bool)
            some_rows = np.flatnonzero(apart.any(axis=1))
            self.apart[own] = row[some_rows], apart[some_rows]
        return self.apart[own]

    def _is_apart(self, what: Decision | str, row: Array, on_grid: GridSampler) -> Array:
        places = on_grid if len(row) == len(self.row) else self.sampler(self.x[row], row)
        here, there = (value(what, at) for at in (places, self.sampler(self.middle[row, None], row)))
        x, near = self.x[row], self.near[row, None]
        found: Array = (here != there) & (x - self.left[row, None] > near) & (self.right[row, None] - x > near)
        return found

    def _open(self, what: Decision | str, on_grid: GridSampler) -> Array:
        """The pieces in which a flag, or what flags decide, may vary."""
        curves = self.calc.curves
        if isinstance(what, Decision):
            flags = [name for name in what.names if name in curves]
            rows = [self._apart(flag, on_grid)[0] for flag in flags]
        elif is_decided(tuple(curves.items()), self.axis, what):
            rows = [self._changes(decision, on_grid)[0] for decision in self.search.asked(what).changing]
        else:
            return self.row
        return np.unique(np.concatenate(rows)) if rows else self.row[:0]

    # --- decisions -----------------------------------------------------------------------------------------------------

    def _changes(self, decision: Decision, on_grid: GridSampler) -> Brackets:
        """Where a decision changes inside a piece: neighbouring places before and after."""
        if decision not in self.changes:
            truth, gap = decided(decision, on_grid)
            is_change = truth[:, 1:] != truth[:, :-1]
            row, k = nonzero(is_change)
            found = [(row, self.x[row, k], self.x[row, k + 1])]
            found += self._dips(decision, gap, is_change, on_grid)
            found += self._narrow(decision, truth, on_grid)
            row, low, high = (np.concatenate(columns) for columns in zip(*found, strict=True))
            low, high = self._halved(decision, row, low, high, on_grid)
            inner = (high - self.left[row] > self.near[row]) & (self.right[row] - low > self.near[row])
            self.changes[decision] = row[inner], low[inner], high[inner]
        return self.changes[decision]

    def _halved(
        self, decision: Decision, row: Array, low: Array, high: Array, on_grid: GridSampler
    ) -> tuple[Array, Array]:
        if not len(row):
            return low, high
        at, every = self._looker(decision, row, on_grid), np.arange(len(row))
        first, _ = decided(decision, at(low[:, None], every))
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            here, _ = decided(decision, at(middle[:, None], every))
            same = (here == first)[:, 0]
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        return low, high

    def _dips(self, decision: Decision, gap: Array, is_change: Array, on_grid: GridSampler) -> Iterator[Brackets]:
        """Where a decision changes and changes back between two points of the grid: its gap dips to nothing there."""
        row, k = lowest(np.abs(gap), is_change)
        last = gap.shape[1] - 1
        for end, inwards in ((0, gap), (last, gap[:, ::-1])):
            at_end = np.flatnonzero(k == end)
            rising = rises(inwards[row[at_end], :NEAR], shares(last)[:NEAR])
            row, k = np.delete(row, at_end[rising]), np.delete(k, at_end[rising])
        if not len(row):
            return
        low, high = self.x[row, np.maximum(k - 1, 0)], self.x[row, np.minimum(k + 1, last)]
        seen = np.arange(len(row))
        at = self._looker(decision, row, on_grid)
        for _ in range(ZOOMS):
            if not len(seen):
                return
            places = low[:, None] + (high - low)[:, None] * np.linspace(0, 1, PARTS + 1)
            truth, gap = decided(decision, at(places, seen))
            i, j = np.nonzero(truth[:, 1:] != truth[:, :-1])
            yield row[seen[i]], places[i, j], places[i, j + 1]
            least = np.abs(gap).argmin(axis=1)
            still = may_reach(np.abs(gap), least)
            still[i] = False
            seen, places, least = seen[still], places[still], least[still]
            low = places[np.arange(len(seen)), np.maximum(least - 1, 0)]
            high = places[np.arange(len(seen)), np.minimum(least + 1, PARTS)]

    def _narrow(self, decision: Decision, truth: Array, on_grid: GridSampler) -> Iterator[Brackets]:
        """Where it changes and changes back without a dip: it is asked where what goes into its functions is least, greatest or nothing."""
        names = decision.link.names
        varying = (
            each
            for each in symbols(decision.node)
            if names.get(each) == self.axis or self.search.is_curve(str(names.get(each)))
        )
        if not (taken := arguments(decision.node, frozenset(varying))):
            return
        at = self._looker(decision, self.row, on_grid)
        last = self.x.shape[1] - 1
        for row, k, place in places(taken, self.x, lambda node, x, own: side(decision, node, at(x, own))):
            here = decided(decision, at(place[:, None], row))[0][:, 0]
            for beside in (np.maximum(k - 1, 0), np.minimum(k + 1, last)):
                other = np.flatnonzero(here != truth[row, beside])
                ends = np.sort([place[other], self.x[row[other], beside[other]]], axis=0)
                yield row[other], ends[0], ends[1]

    def sampler(self, x: Array, row: Array) -> CurveSampler:
        """Return all curves at places (rows, points) of these pieces."""
        return self.calc.sampler_of(self.axis, x, x, self.variant[row])

    def _looker(self, decision: Decision, row: Array, on_grid: GridSampler) -> Callable[[Array, Array], CurveSampler]:
        """What gives the curves of a decision at places (rows, points) of some of these pieces; of many machines they are compiled."""
        names = [name for name in decision.names if self.search.is_curve(name)]
        is_steady = not any(np.isin(self.varying_rows(name, on_grid), row).any() for name in names)
        if not names or self.calc.count < MANY or not is_steady:
            return lambda x, own: self.sampler(x, row[own])
        curves = Curves(self.calc, self.axis, names, self.middle[row], self.variant[row])

        def at(x: Array, own: Array) -> CurveSampler:
            found = self.sampler(x, row[own])
            found.known |= zip(names, curves.at(x, own), strict=True)
            return found

        return at


class GridSampler(CurveSampler):
    """Curves on the search grid of some machines, where most are known; flags of pieces are taken at each place."""

    def __init__(self, machines: SearchedMachines) -> None:
        super().__init__(machines.calc, machines.axis, machines.x, machines.x, machines.variant)
        self.machines = machines

    def _compute(self, name: str) -> Array:
        machines = self.machines
        if not machines.search.is_curve(name):
            return super()._compute(name)
        found: Array = machines.calc.table(self.axis).on_grid([name])[0][machines.own]
        if name in machines.search.ends:
            found[:, [0, -1]] = machines.search.ends[name][machines.own]
        row = machines.varying_rows(name, self)
        if len(row):
            found[row] = machines.sampler(self.x[row], row)[name]
        return found


def _by_flags(question: Deciding) -> tuple[Decision | str, ...]:
    """What a curve takes of flags."""
    return (*question.flags, *question.by_flags)


# Where a curve jumps inside a smooth piece: each condition of its formula is followed through the piece to where it changes.
#
# A condition is held as the difference of its sides. Where that changes its sign between two points of the search grid, or comes near
# to zero between them, the very place is found; a condition on the abscissa itself has a straight difference, so that no window is
# too narrow. A place at an end of the piece, or one where the curve that is asked for does not jump, is not a fault.
#
# What decides is mostly a term of the curve itself, so that it is computed with it on the search grid, of all machines at once.


def faults(calc: Calculation, curve: str) -> Iterator[tuple[int, JumpFault]]:
    """Give the first jump of a curve inside a smooth piece of each machine (its variant) that has one and is not impossible already."""
    axis = calc.axis[curve]
    edges = calc.domains[axis].edges
    search = calc.searches.get(axis)
    if search is None or not search.holds(edges):
        search = calc.searches[axis] = _Search(calc, axis, edges)
    if curve in search.sound:
        return
    search.sound.add(curve)
    for variant, found in search.faults(curve):
        if variant not in calc.flaws:
            yield variant, found


class _Search:
    """What is known of the jumps of curves over an abscissa with these pieces, of so many machines at once as fit a cache."""

    def __init__(self, calc: Calculation, axis: str, edges: Array) -> None:
        self.calc: Calculation = proxy(calc)
        self.axis, self.edges = axis, edges
        self.sound: set[str] = set()  # curves that were searched
        self.ends: dict[str, Array] = {}  # of quantities, just inside of each piece, where rounding decides nothing
        self._asked: dict[str, Deciding] = {}
        self._names: dict[str, list[str]] = {}  # for each curve, what decides in it
        self.pieces = calc.table(axis).pieces()
        own = np.flatnonzero(~np.isin(self.pieces.variant, list(calc.flaws)))
        size = max(1, BLOCK // (self.pieces.intervals + 1))
        starts = np.flatnonzero(np.diff(self.pieces.variant[own], prepend=-1))
        cuts = starts[np.diff(starts // size, prepend=0) > 0]  # no machine in two parts
        self.machines = [SearchedMachines(self, rows) for rows in np.split(own, cuts) if len(rows)]

    def holds(self, edges: Array) -> bool:
        """Return whether the smooth pieces are still the same: a cut beside an edge leaves them."""
        if edges is not self.edges:
            now = self.calc.table(self.axis).pieces()
            if not all(np.array_equal(getattr(now, name), getattr(self.pieces, name)) for name in PIECE):
                return False
            self.edges = edges
        return True

    def faults(self, curve: str) -> Iterator[tuple[int, JumpFault]]:
        """Give the first jump of a curve of each machine that has one."""
        question = self.asked(curve)
        if any(question) and self.machines:
            self._prepare(curve)
            for machines in self.machines:
                yield from machines.faults(curve, question).items()

    def asked(self, curve: str) -> Deciding:
        """Return what makes a curve jump."""
        if curve not in self._asked:
            self._asked[curve] = asked(tuple(self.calc.curves.items()), self.axis, curve)
        return self._asked[curve]

    def coming(self, curve: str) -> list[str]:
        """Return the curve, and those that will be asked for."""
        known = self.calc.curves
        return [curve, *(each for each in self.calc.ahead.get(self.axis, ()) if each in known and each != curve)]

    def _prepare(self, curve: str) -> None:
        """Compute what decides in this curve and the coming ones on the grid, with them, as it is a part of them."""
        names = dict.fromkeys(name for each in self.coming(curve) for name in self._deciding_in(each))
        new = [name for name in names if name not in self.ends and self.is_curve(name)]
        if new:
            table = self.calc.table(self.axis)
            table.on_grid([*new, curve])
            ends = np.stack([self.pieces.left, self.pieces.right], axis=1)
            found = table.curves(new).at(self.pieces.inside(ends, slice(None)))
            self.ends |= zip(new, found, strict=True)

    def _deciding_in(self, curve: str) -> list[str]:
        if curve not in self._names:
            self._names[curve] = list(self._deciding(self.asked(curve)))
        return self._names[curve]

    def _deciding(self, question: Deciding) -> Iterator[str]:
        """The quantities that decide, and that flags follow from."""
        flags = [name for decision in question.by_flags for name in decision.names]
        for decision in question.changing:
            yield from decision.names
        for flag in (*question.flags, *flags):
            yield from sorted(taken(self.calc.curves[flag])) if flag in self.calc.curves else ()

    def is_curve(self, name: str) -> bool:
        """Return whether a quantity varies within a piece and is computed, as the abscissa, flags of pieces and numbers are not."""
        return name in self.calc.curves and not getattr(self.calc.curves[name], "per_piece", False)
