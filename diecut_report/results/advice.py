"""Advice: to which values the keys that an author names are to be changed so that a failing check holds.

The values are found on the mechanism itself: many values of a key are calculated in one run, the limit of those that hold is narrowed
down, rounded to the side that holds, and calculated again as it is printed. No formula is inverted.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from diecut_report.declaration.names import world
from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import needed, recalculated
from diecut_report.mechanism.chapters import taken
from diecut_report.mechanism.checks import AdviceWay, Check, Vary
from diecut_report.mechanism.inputs import Quantity, list_inputs
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.steps import Clash, Require
from diecut_report.mechanism.steps.table_steps import si_values
from diecut_report.quantities.formatting import outward
from diecut_report.results.advised_ways import Change, Number, Way
from diecut_report.results.record import Relation

Judge = Callable[[Calculation, Check], tuple[Array, Array]]
"""Where a check is made, and where it holds, each of shape (variants,)."""

LARGEST_FACTOR = 50.0  # by which an input is changed at most
GRID_POINTS = 24  # values of an input in each direction
FACTORS = np.geomspace(1, LARGEST_FACTOR, GRID_POINTS + 1)[1:]
DIFFERENCES = np.geomspace(0.01, 10, GRID_POINTS)  # in the unit of an input
LEVELS = 3  # of what holds: the check itself; the checks that held, too; the failing ones with the same keys, too
SECTIONS, ROUNDS = 10, 4  # into which the interval around a limit is cut at once, and how often
DIGITS = (4, 5, 6)  # significant digits of an advised number: the first with which the check holds
ROUNDING = 1e-9  # relative: by how much a limit is surely missed that was met but for the rounding of its last place
FEW_OPTIONS = 3  # that an advice names
SMALLEST_BATCH = 4  # machines; a larger batch that cannot be calculated as a whole is halved


class Advisor:
    """Find advice for the failing checks of one machine."""

    def __init__(self, calc: Calculation, held: Sequence[Check], failing: Sequence[Check], judge: Judge) -> None:
        self.calc, self.held, self.failing, self.judge = calc, held, failing, judge
        self._common: dict[tuple[AdviceWay, ...], list[Way]] = {}

    def ways(self, check: Check) -> list[Way]:
        """Return the ways in which a failing check is made to hold; those that break none that held, if there are such.

        Of several failing checks with the same keys those values are taken with which all of them hold, if there are such.
        """
        if check.advise in self._common:
            return self._common[check.advise]
        alike = [each for each in self.failing if each.advise == check.advise]
        trials = CheckTrials(self.calc, check.index, self.judge, check, self.held, alike)
        found = _ways(trials, check.advise)
        found = [way for way in found if not way.broken] or found[:1]
        if check.index is None and all(way.level == LEVELS - 1 for way in found):
            self._common[check.advise] = found
        return found


def possible_ways(mechanism: Mechanism, inputs: Mapping[str, Any], key: str, judge: Judge) -> list[Way]:
    """Return the ways in which a machine that is impossible for a key of its inputs is made possible."""
    calc = Calculation(mechanism, inputs, 1)
    required = (step for _, step in mechanism.active(calc.given) if isinstance(step, Require) and step.key == key)
    wanted = dict.fromkeys(way for step in required for way in step.advise)
    return _ways(PossibleTrials(calc, None, judge), wanted)


def _ways(trials: Trials, wanted: Iterable[AdviceWay]) -> list[Way]:
    """The ways that are found, of several that change the same keys the first."""
    found: dict[tuple[str, ...], Way] = {}
    for each in wanted:
        way = _way(trials, each)
        if way is not None:
            found.setdefault(tuple(change.key for change in way.changes), way)
    return list(found.values())


def _way(trials: Trials, way: AdviceWay) -> Way | None:
    if isinstance(way, tuple):
        return _together(trials, way)
    wanted = way if isinstance(way, Vary) else Vary(way)
    if not trials.may_be_given(wanted.key):
        return None
    if texts := trials.texts(wanted.key):
        return _text(trials, wanted.key, [text for text in texts if text in (wanted.values or texts)])
    places = trials.places(wanted.key)
    return _number(trials, wanted, places[0]) if len(places) == 1 else _together(trials, (wanted.key,))


# What is tried: a place of an input, and machines with other values there.


@dataclass(frozen=True)
class VariedNumber:
    """A number of the inputs: a key, and of a list the part; ``today`` is its value, SI, None where it is not given."""

    key: str
    meta: Quantity
    part: int | None
    today: float | None
    path: str

    @property
    def is_absent(self) -> bool:
        """Return whether there is nothing of what is never below zero, such as a bore: it does not grow with the others."""
        return self.today == 0 and self.meta.ge == 0

    def shown(self, value: float) -> float:
        """Return an SI value in the unit of the input."""
        return float(f"{self.meta.parsed_unit.from_si(value):.12g}")

    def si(self, shown: float) -> float:
        """Return the SI value of a number that is typed in the unit of the input."""
        return self.meta.parsed_unit.to_si(shown)


@dataclass(frozen=True)
class Trials(ABC):
    """Try other inputs on the machine of a calculation; ``part`` is the only part of a list whose inputs are changed, None for all."""

    calc: Calculation
    part: int | None
    judge: Judge

    @abstractmethod
    def hold(self, changed: Mapping[str, Any], count: int) -> Array | None:
        """Return for so many machines whether what is asked holds, by level: shape (LEVELS, machines).

        None where a machine is among these that cannot be proved, or none is possible.
        """

    @abstractmethod
    def broken(self, changed: Mapping[str, Any]) -> tuple[str, ...]:
        """Return the titles of the checks that held and fail on a single machine with other inputs."""

    def none_fails(self, made: Calculation, checks: Sequence[Check]) -> Array:
        """Return the machines of which no check fails."""
        judged = (self.judge(made, check) for check in checks)
        found: Array = np.logical_and.reduce(
            [np.ones(made.count, dtype=bool), *(~there | holds for there, holds in judged)]
        )
        return found

    @cached_property
    def _lists(self) -> Mapping[str, str]:
        return list_inputs(self.calc.mechanism.inputs)

    def may_be_given(self, key: str) -> bool:
        """Return whether an input is given, or may be given beside what is: not in place of what else was chosen."""
        rules = self.calc.mechanism.inputs.one_of
        return key in self.calc.inputs or not any(key in group for rule in rules for group in rule.groups)

    def texts(self, key: str) -> tuple[str, ...]:
        """Return the texts that an input may have; none for a number."""
        known = world(self.calc.mechanism.inputs).keys.get(key)
        return () if known is None or isinstance(known.meta, Quantity) else tuple(known.texts)

    def places(self, key: str) -> list[VariedNumber]:
        """Return the numbers of an input: one, or one for each part of a list that has it; only that of the part that is judged."""
        meta, value = self.calc.meta.get(key), self.calc.inputs.get(key)
        if not isinstance(meta, Quantity) or not isinstance(value, np.ndarray | tuple | None):
            return []
        home = self._lists.get(key)
        if home is None:
            today = None if value is None else float(np.ravel(value)[0])
            return [VariedNumber(key, meta, None, today, key)]
        parts = [] if value is None else list(value[0] if isinstance(value, np.ndarray) else value)
        return [
            VariedNumber(key, meta, i, float(part), f"{home}.{i}.{key.removeprefix(f'{home}.')}")
            for i, part in enumerate(parts)
            if isinstance(part, int | float | np.number) and self.part in (None, i)
        ]

    def with_text(self, key: str, text: str | bool) -> Array:
        """Return whether checks hold with a text, by level, shape (LEVELS, 1)."""
        found = self.hold({key: text}, 1)
        return np.zeros((LEVELS, 1), dtype=bool) if found is None else found

    def with_numbers(self, places: Sequence[VariedNumber], values: Array) -> Array:
        """Return whether checks hold with each row of values, shape (machines, places), by level: shape (LEVELS, machines)."""
        whole = [place.meta.integer for place in places]
        values = np.where(whole, np.rint(values), values)
        found = np.zeros((LEVELS, len(values)), dtype=bool)
        allowed = np.logical_and.reduce([place.meta.holds(values[:, i]) for i, place in enumerate(places)])
        if allowed.any():
            found[:, allowed] = self._with_numbers(places, values[allowed])
        return found

    def _with_numbers(self, places: Sequence[VariedNumber], values: Array) -> Array:
        found = self.hold(self.changed(places, values), len(values))
        if found is not None:
            return found
        if len(values) <= SMALLEST_BATCH:
            return np.zeros((LEVELS, len(values)), dtype=bool)
        return np.hstack([self._with_numbers(places, half) for half in np.array_split(values, 2)])

    def changed(self, places: Sequence[VariedNumber], values: Array) -> dict[str, Any]:
        """Return the inputs of machines with other values, shape (machines, places)."""
        found: dict[str, Any] = {}
        for column, place in enumerate(places):
            if place.part is None:
                found[place.key] = values[:, column]
                continue
            row = found.get(place.key) or _parts(self.calc.inputs[place.key])
            found[place.key] = (*row[: place.part], values[:, column], *row[place.part + 1 :])
        return found


def _parts(value: Any) -> tuple[Any, ...]:
    """The parts of a list's input, each a number, or None where a part does not have it."""
    return tuple(float(part) for part in value[0]) if isinstance(value, np.ndarray) else tuple(value)


@lru_cache(maxsize=1024)
def _required(mechanism: Mechanism, given: frozenset[str], keys: tuple[str, ...]) -> frozenset[str]:
    """What conditions take that follow from some inputs: without it they are not judged."""
    conditions = (taken(step) for _, step in mechanism.active(given) if isinstance(step, Require | Clash))
    return frozenset().union(
        *(names for names in conditions if not inputs_of(mechanism, given, tuple(sorted(names))).isdisjoint(keys))
    )


@lru_cache(maxsize=4096)
def inputs_of(mechanism: Mechanism, given: frozenset[str], names: tuple[str, ...]) -> frozenset[str]:
    """Return the inputs that quantities follow from, with what stands between."""
    ids = needed(mechanism, given, names)
    steps = [step for _, step in mechanism.active(given) if step.id in ids]
    found = set(names).union(*(taken(step) | {*getattr(step, "holds", ())} for step in steps))
    return frozenset(name.removeprefix("inputs.") for name in found)


def _level(held: Array) -> int | None:
    """The highest level that holds with some of the values; None where the check itself holds with none."""
    return next((level for level in reversed(range(LEVELS)) if held[level].any()), None)


@dataclass(frozen=True)
class CheckTrials(Trials):
    """Try inputs with which a failing check holds, and others of its mechanism."""

    check: Check
    held: Sequence[Check]
    failing: Sequence[Check]

    def hold(self, changed: Mapping[str, Any], count: int) -> Array | None:
        """Return whether the check holds; the checks that held, too; the failing ones with the same keys, too."""
        held, failing = (self._affected(tuple(changed), checks) for checks in (self.held, self.failing))
        made = recalculated(self.calc, changed, count, self._names(changed, [*held, *failing]))
        if made is None:
            return None
        there, holds = self.judge(made, self.check)
        own = there & holds
        own[list(made.flaws)] = False
        sound = own & self.none_fails(made, held)
        return np.array([own, sound, sound & self.none_fails(made, failing)])

    def broken(self, changed: Mapping[str, Any]) -> tuple[str, ...]:
        """Return the titles of the checks that held and fail on a single machine with other inputs."""
        checks = self._affected(tuple(changed), self.held)
        made = recalculated(self.calc, changed, 1, self._names(changed, checks))
        if made is None:
            return ()
        judged = [(check, self.judge(made, check)) for check in checks]
        return tuple(check.title for check, (there, holds) in judged if there[0] and not holds[0])

    def _affected(self, keys: tuple[str, ...], checks: Sequence[Check]) -> list[Check]:
        """The checks that follow from one of these inputs; all where other steps may be made."""
        if self._switches(keys):
            return list(checks)
        mechanism, given = self.calc.mechanism, self.calc.given
        return [each for each in checks if not inputs_of(mechanism, given, (*each.named, *each.needs)).isdisjoint(keys)]

    def _names(self, changed: Mapping[str, Any], checks: Sequence[Check]) -> list[str] | None:
        """What must be calculated to judge the checks; None for all, as curves are judged when all is known."""
        names = {name for each in (self.check, *checks) for name in each.named}
        names |= _required(self.calc.mechanism, self.calc.given, tuple(changed))
        is_whole = self._switches(changed) or names & self.calc.curves.keys()
        return None if is_whole else sorted(names)

    def _switches(self, keys: Iterable[str]) -> bool:
        """Whether steps may be switched on or off: by what was not given, or by a text."""
        return any(key not in self.calc.inputs or self.texts(key) for key in keys)


@dataclass(frozen=True)
class PossibleTrials(Trials):
    """Try inputs with which a machine is possible that is not."""

    def hold(self, changed: Mapping[str, Any], count: int) -> Array | None:
        """Return whether the machine is possible; none of its checks fails, too."""
        made = recalculated(self.calc, changed, count)
        if made is None:
            return None
        is_possible = np.ones(count, dtype=bool)
        is_possible[list(made.flaws)] = False
        sound = is_possible & self.none_fails(made, self.calc.mechanism.checks)
        return np.array([is_possible, sound, sound])

    def broken(self, changed: Mapping[str, Any]) -> tuple[str, ...]:
        """Return nothing: what was not possible had no checks that held."""
        return ()


# A text: each of its options is tried.


def _text(trials: Trials, key: str, texts: Sequence[str]) -> Way | None:
    today = trials.calc.inputs.get(key)
    typed = str(today).lower() if isinstance(today, bool) else today
    options = [text == "true" if isinstance(today, bool) else text for text in texts if text != typed]
    held = np.hstack([np.zeros((LEVELS, 0)), *(trials.with_text(key, option) for option in options)])
    level = _level(held)
    if level is None:
        return None
    found = tuple(option for option, is_held in zip(options, held[level], strict=True) if is_held)[:FEW_OPTIONS]
    change = Change(key, "one_of", found) if len(found) > 1 else Change(key, "equal", found[0])
    return Way((change,), level, trials.broken({key: found[0]}) if level == 0 else ())


# A number: the values with which the check holds lie between limits, which are narrowed down and rounded to the side that holds.


@dataclass(frozen=True)
class Ray:
    """Values of some numbers by one parameter, of which ``today`` gives today's values: origin + parameter · direction, SI."""

    places: Sequence[VariedNumber]
    origin: Array
    direction: Array
    grid: Array
    today: float | None

    def at(self, parameters: Array) -> Array:
        """Return the values for some parameters, shape (parameters, places)."""
        found: Array = self.origin + parameters[:, None] * self.direction
        return found

    def without(self, place: VariedNumber) -> Ray:
        """Return the ray on which one of the numbers stays as it is."""
        kept = [i for i, each in enumerate(self.places) if each is not place]
        return replace(
            self, places=[self.places[i] for i in kept], origin=self.origin[kept], direction=self.direction[kept]
        )


@dataclass(frozen=True)
class TriedLine:
    """Machines on a ray, and which of those on its grid hold, at a level."""

    trials: Trials
    ray: Ray
    held: Array
    level: int

    @classmethod
    def of(cls, trials: Trials, ray: Ray) -> TriedLine | None:
        """Try the grid of a ray; None where the check holds nowhere."""
        if not len(ray.grid):
            return None
        held = trials.with_numbers(ray.places, ray.at(ray.grid))
        level = _level(held)
        return None if level is None else cls(trials, ray, held[level], level)

    @property
    def grid(self) -> Array:
        """Return the parameters that were tried."""
        return self.ray.grid

    @property
    def today(self) -> float | None:
        """Return the parameter of today's machine."""
        return self.ray.today

    def holds(self, parameters: Array) -> Array:
        """Return whether what is asked holds with each of some parameters."""
        found: Array = self.trials.with_numbers(self.ray.places, self.ray.at(parameters))[self.level]
        return found

    @cached_property
    def run(self) -> tuple[float, float]:
        """Return the ends of the values that hold one beside the other, of several such runs of that nearest to today's value."""
        edges = np.flatnonzero(np.diff(np.concatenate([[False], self.held, [False]]).astype(int)))
        runs = [(float(self.grid[i]), float(self.grid[j - 1])) for i, j in zip(edges[::2], edges[1::2], strict=True)]
        if self.today is None:
            return max(runs, key=lambda run: run[1] - run[0])
        return min(runs, key=self._distance)

    def _distance(self, run: tuple[float, float]) -> float:
        assert self.today is not None
        nearest = min(run, key=lambda end: abs(end - (self.today or 0.0)))
        if nearest * self.today > 0:
            return abs(math.log(nearest / self.today))
        return abs(nearest - self.today) / max(abs(nearest), abs(self.today))

    @property
    def rises(self) -> bool:
        """Return whether the values that hold lie above the present one."""
        return bool(self.run[1] == self.grid[-1] if self.today is None else self.run[0] > self.today)

    @property
    def relation(self) -> Relation:
        """Return how the run bounds the parameter: on one side where all that was tried beyond it holds."""
        if self.rises:
            return "at_least" if self.run[1] == self.grid[-1] else "between"
        return "at_most" if self.run[0] == self.grid[0] else "between"

    def region(self, meta: Quantity) -> tuple[Relation, float, float]:
        """Return where all that is tried holds, of a number alone: how it is bounded, its end at the present value, and the other one."""
        relation = self.relation
        near, far = (self.low(), self.high()) if self.rises else (self.high(), self.low())
        if relation != "between":
            far = _ends(meta)[self.rises]
        for _ in range(ROUNDS):
            tried = self._within(meta, near, far)
            failing = np.flatnonzero(~self.holds(tried))
            if not len(failing):
                return relation, near, far
            relation, far = "between", self._moved(float(tried[max(failing[0] - 1, 0)]), float(tried[failing[0]]))
        return "equal", near, near

    def _within(self, meta: Quantity, near: float, far: float) -> Array:
        """Values from one to another: between those of the grid, as many to each part, and as many to each decade."""
        low, high = sorted((near, far))
        decades = [np.geomspace(np.copysign(meta.sizes.ends[0], end), end, GRID_POINTS) for end in (low, high) if end]
        middles = (self.grid[1:] + self.grid[:-1]) / 2
        values = np.concatenate([[near, far], np.linspace(low, high, GRID_POINTS), middles, *decades])
        values = np.unique(np.rint(values) if meta.integer else values)
        return _allowed(meta, values[(low <= values) & (values <= high)])[:: 1 if near <= far else -1]

    def low(self) -> float:
        """Return the lower end of the run, moved as far as it holds."""
        below = [*self.grid[self.grid < self.run[0]], *([self.today] if self.today is not None else [])]
        return self._moved(self.run[0], max((each for each in below if each < self.run[0]), default=self.run[0]))

    def high(self) -> float:
        """Return the upper end of the run, moved as far as it holds."""
        above = [*self.grid[self.grid > self.run[1]], *([self.today] if self.today is not None else [])]
        return self._moved(self.run[1], min((each for each in above if each > self.run[1]), default=self.run[1]))

    def _moved(self, inner: float, outer: float) -> float:
        """The last value that holds on the way from one that does to one that does not."""
        for _ in range(ROUNDS if inner != outer else 0):
            places = np.linspace(inner, outer, SECTIONS + 1)
            failing = np.flatnonzero(~self.holds(places[1:-1]))
            last = int(failing[0]) if len(failing) else SECTIONS - 1
            inner, outer = float(places[last]), float(places[last + 1])
        return inner


def _number(trials: Trials, wanted: Vary, place: VariedNumber) -> Way | None:
    listed = si_values(wanted.values or place.meta.listed, getattr(wanted.series, "unit", place.meta.unit))
    grid, is_listed = (listed, True) if listed.size else (_grid(place), place.meta.integer)
    grid = np.sort([each for each in grid if _is_towards(each, place.today, wanted.to)])
    line = TriedLine.of(trials, Ray([place], np.zeros(1), np.ones(1), grid, place.today))
    if line is None:
        return None
    relation, near, far = (line.relation, *line.run) if listed.size else line.region(place.meta)
    change = (_listed_change if is_listed else _change)(line, place, relation, near, far)
    if change is None:
        return None
    typed = change.value if isinstance(change.value, tuple) else (change.value,)
    values = [np.array([[place.si(float(each))]]) for each in typed] if line.level == 0 else []
    broken = [title for value in values for title in trials.broken(trials.changed([place], value))]
    return Way((change,), line.level, tuple(dict.fromkeys(broken)))


def _is_towards(value: float, today: float | None, to: str) -> bool:
    if today is None or not to:
        return value != today
    return value > today if to == "up" else value < today


def _grid(place: VariedNumber) -> Array:
    """Values of an input that are tried at first, in their order, SI."""
    meta, today = place.meta, place.today
    if meta.integer:
        start = int(today or 0)
        return _allowed(meta, np.arange(start - 2 * GRID_POINTS, start + 4 * GRID_POINTS + 1, dtype=float))
    low, high = _bounds(meta)
    found = [np.array([each for each in (low, high) if each is not None])]
    if low is not None and high is not None:
        found.append(np.linspace(low, high, GRID_POINTS + 1))
    if today:
        found += [today / FACTORS, today * FACTORS]
    else:
        found.append(np.geomspace(*meta.sizes.ends, 4 * GRID_POINTS))
    return _allowed(meta, np.unique(np.concatenate(found)))


def _allowed(meta: Quantity, values: Array) -> Array:
    found: Array = values[meta.holds(values)]
    return found


def _bounds(meta: Quantity) -> list[float | None]:
    """The least and the greatest number that are allowed, SI, where there are such."""
    pairs = ((meta.ge, meta.gt), (meta.le, meta.lt))
    ends = [next((each for each in pair if each is not None), None) for pair in pairs]
    return [None if end is None else end * meta.parsed_unit.factor for end in ends]


def _ends(meta: Quantity) -> tuple[float, float]:
    """The ends of what a machine may have, SI: the bounds, else the plausible sizes."""
    low, high = _bounds(meta)
    least, most = meta.sizes.ends
    return (-most if low is None else low or least, most if high is None else high)


def _listed_change(line: TriedLine, place: VariedNumber, relation: Relation, near: float, far: float) -> Change:
    """The change to a value of a series, or a whole number."""
    low, high = sorted((near, far))
    if relation in ("at_least", "at_most") and line.run[0] != line.run[1]:
        return Change(place.path, relation, _typed(place, near), place.meta.unit)
    inside = [each for each in line.grid if low <= each <= high]
    near_ones = sorted(sorted(inside, key=lambda each: abs(each - (line.today or 0.0)))[:FEW_OPTIONS])
    values = tuple(_typed(place, each) for each in near_ones)
    relation, value = ("one_of", values) if len(values) > 1 else ("equal", values[0])
    return Change(place.path, relation, value, place.meta.unit)


def _typed(place: VariedNumber, value: float) -> Number:
    return round(place.shown(value)) if place.meta.integer else place.shown(value)


def _change(line: TriedLine, place: VariedNumber, relation: Relation, near: float, far: float) -> Change | None:
    """The change to values that hold as they are printed; None where none that is printed does."""
    first = _shortest(line, place, near, up=line.rises)
    if first is None:
        return None
    if relation == "between":
        last = _shortest(line, place, far, up=not line.rises)
        if last is not None and first != last and (last > first) == line.rises:
            return Change(place.path, "between", (min(first, last), max(first, last)), place.meta.unit)
        relation = "equal"
    return Change(place.path, relation, first, place.meta.unit)


def _shortest(line: TriedLine, place: VariedNumber, value: float, *, up: bool) -> float | None:
    """The shortest number at a limit that holds as it is printed."""
    tried = _rounded(place.shown(value), up=up)
    held = line.holds(np.array([place.si(each) for each in tried]))
    return next((each for each, is_held in zip(tried, held, strict=True) if is_held), None)


def _rounded(value: float, *, up: bool) -> list[float]:
    """A limit as it may be printed, the shortest first: the nearest number may hold, the next one on the safe side does.

    A limit that is such a number itself may fail by the rounding of its last place: the next one lies beyond it.
    """
    beyond = value + (ROUNDING if up else -ROUNDING) * abs(value)
    return [each for digits in DIGITS for each in (float(f"{value:.{digits}g}"), outward(beyond, up, digits))]


# Several numbers that are changed together; those that need not be changed are left as they are.


def _together(trials: Trials, keys: Sequence[str]) -> Way | None:
    given = [place for key in keys for place in trials.places(key) if place.today is not None]
    places = [place for place in given if not place.is_absent] or given
    if not places:
        return None
    ray = _common_ray(places)
    parameter = _nearest(trials, ray)
    if parameter is None:
        return None
    ray = _needed(trials, ray, parameter)
    if len(ray.places) == 1:
        rises = bool(ray.at(np.array([parameter]))[0, 0] > (ray.places[0].today or 0.0))
        return _number(trials, Vary(ray.places[0].key, "up" if rises else "down"), ray.places[0])
    parameter = _nearest(trials, ray)
    return None if parameter is None else _way_to(trials, ray, parameter)


def _common_ray(places: Sequence[VariedNumber]) -> Ray:
    """All numbers in one proportion, or, where one of them is zero, by the same difference in their units."""
    today = np.array([place.today for place in places], dtype=float)
    if today.all():
        return Ray(places, np.zeros(len(places)), today, np.concatenate([1 / FACTORS[::-1], FACTORS]), 1.0)
    units = np.array([place.meta.parsed_unit.factor for place in places])
    return Ray(places, today, units, np.concatenate([-DIFFERENCES[::-1], DIFFERENCES]), 0.0)


def _nearest(trials: Trials, ray: Ray) -> float | None:
    """The parameter nearest to today's with which the check holds."""
    line = TriedLine.of(trials, ray)
    if line is None or ray.today is None:
        return None
    return line.low() if line.run[0] > ray.today else line.high()


def _needed(trials: Trials, ray: Ray, parameter: float) -> Ray:
    """The ray without the numbers that may stay as they are."""
    for place in ray.places if len(ray.places) > 1 else ():
        left = ray.without(place)
        if left.places and trials.with_numbers(left.places, left.at(np.array([parameter])))[1, 0]:
            ray = left
    return ray


def _way_to(trials: Trials, ray: Ray, parameter: float) -> Way | None:
    """The changes to the values of a parameter, as they are printed."""
    exact = ray.at(np.array([parameter]))[0]
    for digits in DIGITS:
        typed = [_safe(place, value, digits) for place, value in zip(ray.places, exact, strict=True)]
        values = np.array([[place.si(each) for each, place in zip(typed, ray.places, strict=True)]])
        held = trials.with_numbers(ray.places, values)
        if held[0, 0]:
            changes = [Change(p.path, "equal", each, p.meta.unit) for each, p in zip(typed, ray.places, strict=True)]
            broken = () if held[1, 0] else trials.broken(trials.changed(ray.places, values))
            return Way(tuple(changes), _level(held) or 0, broken)
    return None


def _safe(place: VariedNumber, value: float, digits: int) -> Number:
    """A value as it is printed, rounded away from today's."""
    shown = place.shown(value)
    return round(shown) if place.meta.integer else outward(shown, value > (place.today or 0.0), digits)
