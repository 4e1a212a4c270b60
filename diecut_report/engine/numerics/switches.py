"""Where a curve jumps inside a smooth piece: each condition of its formula is followed through the piece to where it changes.

A condition is held as the difference of its sides. Where that changes its sign between two points of the search grid, or comes near
to zero between them, the very place is found; a condition on the abscissa itself has a straight difference, so that no window is
too narrow. A place at an end of the piece, or one where the curve that is asked for does not jump, is not a fault.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from typing import Any, NamedTuple
from weakref import proxy

import numpy as np

from diecut_report.contract.binding import Bound, bound
from diecut_report.contract.sections import taken
from diecut_report.contract.steps import Choice, Value
from diecut_report.engine.calculation import Calculation, CurveSampler
from diecut_report.engine.numerics.curve_evaluation import BLOCK, MANY
from diecut_report.engine.numerics.discontinuities import STEPWISE, expanded
from diecut_report.engine.numerics.sample_cache import CachedPieces
from diecut_report.expressions import Array, Node, evaluate, symbols, walk

APART = 1e-6  # share of the period within which a place is the end of its piece: what only touches there is decided by the root of rounding
JUMP = 1e-9  # share of a curve's greatest value by which it moves at a jump
ZOOMS, PARTS = 12, 16  # how often the place where a difference is least is looked at in so many parts of what is left
FLAT = 0.1  # of a gap: where it moves by less about its least value that is not nothing
SOME = 5  # points of a piece at which a curve is held against its flag that varies in it
HALVINGS = 60  # of an interval of the grid: down to the rounding of a place


class Decision(NamedTuple):
    """Hold a part of a formula that decides: a comparison, or a function that takes steps."""

    step: Value | Choice
    link: Bound
    node: Node


class JumpFault(NamedTuple):
    """Hold a curve that jumps: what decides there (None where a flag of the piece varies in it without a jump), and the place (SI)."""

    curve: str
    decision: Decision | None
    place: float


Brackets = tuple[Array, Array, Array]  # rows, and the two places (rows,) between which a decision changes


def faults(calc: Calculation, curve: str) -> Iterator[tuple[int, JumpFault]]:
    """Give the first jump of a curve inside a smooth piece of each machine (its variant) that has one and is not impossible already."""
    axis = calc.axis[curve]
    edges = calc.domains[axis].edges
    search = calc.searches.get(axis)
    if search is None or search.edges is not edges:
        search = calc.searches[axis] = _Search(calc, axis, edges)
    if curve in search.sound:
        return
    search.sound.add(curve)
    followed = list(_followed(calc, curve))
    deciding = [decision for step in followed for decision in _open(calc, axis, step)]
    flags = [step.id for step in followed if step.per_piece]
    for machines in search.machines if deciding or flags else ():
        for variant, found in machines.faults(curve, deciding, flags).items():
            if variant not in calc.flaws:
                yield variant, found


def _followed(calc: Calculation, curve: str) -> Iterator[Value | Choice]:
    """The formulas that a curve follows from, its own included."""
    pending, seen = [curve], set[str]()
    while pending:
        name = pending.pop()
        if name in calc.curves and name not in seen:
            seen.add(name)
            step = calc.curves[name]
            pending += sorted(taken(step), reverse=True)
            if isinstance(step, Value | Choice):
                yield step


def varies(calc: Calculation, axis: str, name: str | float) -> bool:
    """Return whether a quantity varies within a piece: flags of pieces and numbers do not."""
    return name == axis or (name in calc.curves and not getattr(calc.curves[str(name)], "per_piece", False))


def _open(calc: Calculation, axis: str, step: Value | Choice) -> Iterator[Decision]:
    """The decisions of a step that may change within a piece."""
    for decision in _decisions(step):
        names = decision.link.names
        if any(varies(calc, axis, names.get(symbol, 0.0)) for symbol in symbols(decision.node)):
            yield decision


@lru_cache(maxsize=4096)
def _decisions(step: Value | Choice) -> tuple[Decision, ...]:
    parts = [step.formula] if isinstance(step, Value) else [p for c in step.cases for p in (c.condition, c.value)]
    links = [bound(part) for part in parts if part is not None and not isinstance(part, str)]
    return tuple(
        Decision(step, link, node)
        for link in links
        for node in walk(expanded(link.formula.tree))
        if node.op == "cmp" or (node.op == "call" and node.args[0] in STEPWISE)
    )


class _Search:
    """What is known of the jumps of curves over an abscissa with these pieces, of so many machines at once as fit a cache."""

    def __init__(self, calc: Calculation, axis: str, edges: Array) -> None:
        self.edges = edges
        self.sound: set[str] = set()  # curves that were searched
        pieces = calc.table(axis).pieces()
        own = np.flatnonzero(~np.isin(pieces.variant, list(calc.flaws)))
        size = max(1, BLOCK // (pieces.intervals + 1))
        starts = np.flatnonzero(np.diff(pieces.variant[own], prepend=-1))
        cuts = starts[np.diff(starts // size, prepend=0) > 0]  # no machine in two parts
        self.machines = [_Machines(calc, axis, pieces, rows) for rows in np.split(own, cuts) if len(rows)]


class _Machines:
    """The smooth pieces of some machines, a row each, and the search grid in them; here flags of pieces are taken at each place."""

    def __init__(self, calc: Calculation, axis: str, pieces: CachedPieces, own: Array) -> None:
        self.calc: Calculation = proxy(calc)
        self.axis, self.own = axis, own
        self.variant, self.middle = pieces.variant[own], pieces.middle[own]
        self.left, self.right = pieces.left[own], pieces.right[own]
        self.near = APART * np.broadcast_to(calc.domains[axis].period_of(self.variant)[:, 0], len(own))
        self.x = pieces.inside(pieces.grid(own), own)
        self.row = np.arange(len(own))
        self.changes: dict[Decision, Brackets] = {}
        self.varying: dict[str, tuple[Array, Array]] = {}  # for each flag

    def faults(self, curve: str, deciding: Sequence[Decision], flags: Sequence[str]) -> dict[int, JumpFault]:
        """Return the first jump of a curve of each machine that has one."""
        on_grid = _OnGrid(self)
        changing = {decision: self._changes(decision, on_grid) for decision in deciding}
        varying = list({id(where): where for where in (self._varying(flag, on_grid) for flag in flags)}.values())
        found: dict[int, JumpFault] = {}
        if any(len(row) for row, *_ in (*changing.values(), *varying)):
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
                before, after = (_over(self._sampler(x, row)[curve], x)[:, 0] for x in (low[:, None], high[:, None]))
                for i in np.flatnonzero(np.abs(after - before) > size[row]):
                    yield row[i], decision, float(high[i])

    def _flagged(
        self, curve: str, varying: Sequence[tuple[Array, Array]], heights: Array, size: Array
    ) -> Iterator[tuple[int, None, float]]:
        """Give where a curve would be another one with a flag of that very place."""
        for row, k in varying:
            x = self.x[row[:, None], k]
            places = x.reshape(-1, 1)
            here = self.calc.sample(curve, places, places, self.variant[row].repeat(SOME)).reshape(x.shape)
            apart = np.abs(here - heights[row[:, None], k])
            for i, j in np.argwhere(apart > size[row][:, None]):
                yield row[i], None, float(x[i, j])

    def _varying(self, flag: str, on_grid: _OnGrid) -> tuple[Array, Array]:
        """In which pieces a flag is not constant, and at which points of the grid, some of all, it is not that of the middle."""
        if flag not in self.varying:
            middle, near = self.middle[:, None], self.near[:, None]
            inner = (self.x - self.left[:, None] > near) & (self.right[:, None] - self.x > near)
            apart = inner & (on_grid[flag] != self._sampler(middle, self.row)[flag])
            row = np.flatnonzero(apart.any(axis=1))
            rank = np.round(np.linspace(0, 1, SOME) * (apart[row].sum(axis=1, keepdims=True) - 1)).astype(int)
            k = np.argsort(~apart[row], axis=1, kind="stable")  # the points that are apart come first, in their order
            k = np.take_along_axis(k, rank, axis=1)
            alike = (each for each in self.varying.values() if all(map(np.array_equal, each, (row, k))))
            self.varying[flag] = next(alike, (row, k))  # one for the flags that vary in the same places
        return self.varying[flag]

    def _changes(self, decision: Decision, on_grid: _OnGrid) -> Brackets:
        """Where a decision changes inside a piece: neighbouring places before and after."""
        if decision not in self.changes:
            truth, gap = self._decided(decision, on_grid)
            is_change = truth[:, 1:] != truth[:, :-1]
            row, k = np.nonzero(is_change)
            found = [(row, self.x[row, k], self.x[row, k + 1])]
            found += self._dips(decision, np.abs(gap), is_change)
            row, low, high = (np.concatenate(columns) for columns in zip(*found, strict=True))
            low, high = self._halved(decision, row, low, high)
            inner = (high - self.left[row] > self.near[row]) & (self.right[row] - low > self.near[row])
            self.changes[decision] = row[inner], low[inner], high[inner]
        return self.changes[decision]

    def _halved(self, decision: Decision, row: Array, low: Array, high: Array) -> tuple[Array, Array]:
        if not len(row):
            return low, high
        first, _ = self._decided(decision, self._sampler(low[:, None], row))
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            here, _ = self._decided(decision, self._sampler(middle[:, None], row))
            same = (here == first)[:, 0]
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        return low, high

    def _dips(self, decision: Decision, gap: Array, is_change: Array) -> Iterator[Brackets]:
        """Where a decision changes and changes back between two points of the grid: its gap dips to nothing there."""
        last = gap.shape[1] - 1
        before = np.concatenate([gap[:, [1]], gap[:, :-1]], axis=1)
        after = np.concatenate([gap[:, 1:], gap[:, [-2]]], axis=1)
        lowest = (gap <= before) & (gap <= after) & (2 * gap <= np.maximum(before, after)) & (gap > 0)
        changed = np.zeros_like(lowest)
        changed[:, 1:] |= is_change
        changed[:, :-1] |= is_change
        row, k = np.nonzero(lowest & ~changed)
        low, high = self.x[row, np.maximum(k - 1, 0)], self.x[row, np.minimum(k + 1, last)]
        for _ in range(ZOOMS):
            if not len(row):
                return
            places = low[:, None] + (high - low)[:, None] * np.linspace(0, 1, PARTS + 1)
            truth, gap = self._decided(decision, self._sampler(places, row))
            i, j = np.nonzero(truth[:, 1:] != truth[:, :-1])
            yield row[i], places[i, j], places[i, j + 1]
            least = np.abs(gap).argmin(axis=1)
            still = _may_reach(np.abs(gap), least)
            still[i] = False
            row, places, least = row[still], places[still], least[still]
            low = places[np.arange(len(row)), np.maximum(least - 1, 0)]
            high = places[np.arange(len(row)), np.minimum(least + 1, PARTS)]

    def _sampler(self, x: Array, row: Array) -> CurveSampler:
        """All curves at places (rows, points) of these pieces."""
        return self.calc.sampler_of(self.axis, x, x, self.variant[row])

    def _decided(self, decision: Decision, sampler: CurveSampler | _OnGrid) -> tuple[Array, Array]:
        """What is decided at places, and how far the decision is from changing there."""
        _, link, node = decision

        def value(leaf: Node) -> Any:
            name = link.names.get(leaf.args[0])
            if name is None:
                return float(link.formula.constants[leaf.args[0]])
            return sampler[name] if isinstance(name, str) else float(name)

        def over(part: Node) -> Array:
            return _over(evaluate(part, value), sampler.x)

        if node.op == "cmp":
            return over(node), over(node.args[1]) - over(node.args[2])
        decided, inner = over(node), over(node.args[1])
        waves = {"sign": inner, "round": np.cos(np.pi * inner)}
        return decided, waves.get(node.args[0], np.sin(np.pi * inner))


class _OnGrid:
    """Curves on the search grid of some machines; of many those that follow no flag are taken from what is known of them there."""

    def __init__(self, machines: _Machines) -> None:
        self.calc, self.axis, self.own, self.x = machines.calc, machines.axis, machines.own, machines.x
        self.plain = self.calc.sampler_of(self.axis, self.x, self.x, machines.variant)
        ends = self.x[:, [0, -1]]
        self.ends = self.calc.sampler_of(self.axis, ends, ends, machines.variant)

    def __getitem__(self, name: str) -> Array:
        calc = self.calc
        if calc.count < MANY or name not in calc.curves or any(step.per_piece for step in _followed(calc, name)):
            return self.plain[name]
        found: Array = calc.table(self.axis).on_grid([name])[0][self.own]
        found[:, [0, -1]] = self.ends[name]  # just inside of the piece, where rounding decides nothing
        return found


def _may_reach(gap: Array, least: Array) -> Array:
    """Whether gaps (rows, places) may come down to nothing between their places: they turn back, and are not flat yet."""
    turns = (least > 0) & (least < gap.shape[1] - 1)
    found: Array = turns & (np.ptp(gap, axis=1) > FLAT * gap.min(axis=1))
    return found


def _over(values: Any, x: Array) -> Array:
    """Values as numbers, one for each place."""
    found: Array = np.broadcast_to(values, x.shape).astype(float)
    return found
