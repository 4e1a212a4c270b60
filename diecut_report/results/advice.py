"""Advice: to which values the keys that an author names are to be changed so that a failing check holds.

The values are found on the mechanism itself: many values of a key are calculated in one run, the limit of those that hold is narrowed
down, rounded to the side that holds, and calculated again as it is printed. No formula is inverted.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import with_sampled_curves
from diecut_report.mechanism.checks import AdviceWay, Check, Vary
from diecut_report.mechanism.inputs import Quantity
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.steps import Require
from diecut_report.mechanism.steps.table_steps import si_values
from diecut_report.quantities.formatting import number_text, outward, with_unit
from diecut_report.results.mechanism_record import KeyChangeRecord
from diecut_report.results.record import Relation, Value
from diecut_report.results.trials import LEVELS, Judge, Trials, VariedNumber
from diecut_report.text.phrases import Phrase, joined, named, phrase

LARGEST_FACTOR = 50.0  # by which an input is changed at most
GRID_POINTS = 24  # values of an input in each direction
FACTORS = np.geomspace(1, LARGEST_FACTOR, GRID_POINTS + 1)[1:]
DIFFERENCES = np.geomspace(0.01, 10, GRID_POINTS)  # in the unit of an input
SECTIONS, ROUNDS = 10, 4  # into which the interval around a limit is cut at once, and how often
DIGITS = (4, 5, 6)  # significant digits of an advised number: the first with which the check holds
ROUNDING = 1e-9  # relative: by how much a limit is surely missed that was met but for the rounding of its last place
FEW_OPTIONS = 3  # that an advice names
NEAR = 6  # values of a grid on each side of today's that are tried before all others


@dataclass(frozen=True)
class Way:
    """Hold changes that together make a check hold, and how much holds with them (LEVELS); ``broken`` are titles of checks that then fail."""

    changes: Sequence[KeyChangeRecord]
    level: int
    broken: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """Return the way in words."""
        changes = joined(map(_told, self.changes), " and ")
        if not self.broken:
            return changes
        titles = joined([Phrase("“{title}”", title=phrase(title)) for title in self.broken], ", ")
        return Phrase("{changes} (this check then fails: {checks})", changes=changes, checks=titles)


def advice_text(ways: Sequence[Way]) -> Phrase:
    """Return the ways as one sentence."""
    return Phrase("{ways:capital}.", {"ways:capital": joined([way.text for way in ways], ", or ")})


@dataclass(frozen=True)
class AdvisedCheck:
    """Hold what was found of a failing check, the ways in which it is made to hold, and how others are found: with some numbers kept."""

    finding: Phrase
    ways: Sequence[Way]
    again: Callable[[frozenset[str]], Sequence[Way]] = field(default=lambda _: (), compare=False)

    @property
    def fields(self) -> dict[str, Any]:
        """Return the fields of its record that say so."""
        advice = [list(way.changes) for way in self.ways]
        return {
            "advice": advice,
            "message": joined([self.finding, advice_text(self.ways)], " ") if advice else self.finding,
        }


def _told(change: KeyChangeRecord) -> Phrase:
    values = [
        printed(each, change.unit) for each in (change.value if isinstance(change.value, list) else [change.value])
    ]
    match change.relation:
        case "at_least":
            return Phrase("set {key} to at least {value}", key=change.told, value=values[0])
        case "at_most":
            return Phrase("set {key} to at most {value}", key=change.told, value=values[0])
        case "between":
            return Phrase("set {key} to between {low} and {high}", key=change.told, low=values[0], high=values[1])
        case "one_of":
            return Phrase("set {key} to {values}", key=change.told, values=named(values, " or "))
    return Phrase("set {key} to {value}", key=change.told, value=values[0])


def printed(value: Value, unit: str) -> str:
    """Return an advised value as it is told, and typed."""
    if isinstance(value, bool):
        return str(value).lower()
    return value if isinstance(value, str) else with_unit(number_text(value, 6), unit)


def _changed(key: str, unit: str, relation: Relation, *values: Value) -> KeyChangeRecord:
    return KeyChangeRecord(key=key, relation=relation, value=values[0] if len(values) == 1 else list(values), unit=unit)


class Advisor:
    """Find advice for the failing checks of one machine."""

    def __init__(self, calc: Calculation, held: Sequence[Check], failing: Sequence[Check], judge: Judge) -> None:
        self.calc, self.held, self.failing, self.judge = calc, held, failing, judge
        self._common: dict[tuple[AdviceWay, ...], list[Way]] = {}

    def ways(self, check: Check, kept: frozenset[str] = frozenset()) -> list[Way]:
        """Return the ways in which a failing check is made to hold; those that break none that held, if there are such.

        The numbers that are ``kept`` stay as they are. Of several failing checks with the same keys those values are taken with which all
        of them hold, if there are such.
        """
        if check.advise in self._common and not kept:
            return self._common[check.advise]
        alike = [each for each in self.failing if each.advise == check.advise]
        trials = Trials(self.calc, self.judge, check, self.held, alike, kept)
        found = _ways(trials, check.advise)
        found = [way for way in found if not way.broken] or found[:1]
        if check.index is None and not kept and all(way.level == LEVELS - 1 for way in found):
            self._common[check.advise] = found
        return found


def possible_ways(mechanism: Mechanism, inputs: Mapping[str, Any], key: str, judge: Judge) -> list[Way]:
    """Return the ways in which a machine that is impossible for a key of its inputs is made possible."""
    calc = Calculation(mechanism, with_sampled_curves(mechanism, inputs), 1)
    required = (step for _, step in mechanism.active(calc.given) if isinstance(step, Require) and step.key == key)
    wanted = dict.fromkeys(way for step in required for way in step.advise)
    return _ways(Trials(calc, judge, held=mechanism.checks), wanted)


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


# A text: each of its options is tried.


def _level(held: Array) -> int | None:
    """The highest level that holds with some of the values; None where the check itself holds with none."""
    return next((level for level in reversed(range(LEVELS)) if held[level].any()), None)


def _text(trials: Trials, key: str, texts: Sequence[str]) -> Way | None:
    present = trials.calc.inputs.get(key)
    typed = str(present).lower() if isinstance(present, bool) else present
    options = [text == "true" if isinstance(present, bool) else text for text in texts if text != typed]
    held = np.hstack([np.zeros((LEVELS, 0)), *(trials.with_text(key, option) for option in options)])
    level = _level(held)
    if level is None:
        return None
    found = [option for option, is_held in zip(options, held[level], strict=True) if is_held][:FEW_OPTIONS]
    change = _changed(key, "1", "one_of" if len(found) > 1 else "equal", *found)
    return Way([change], level, trials.broken({key: found[0]}) if level == 0 else ())


# A number: the values with which the check holds lie between limits, which are narrowed down and rounded to the side that holds.


@dataclass(frozen=True)
class Ray:
    """Values of some numbers by one parameter, of which ``present`` gives today's values: origin + parameter · direction, SI."""

    places: Sequence[VariedNumber]
    origin: Array
    direction: Array
    grid: Array
    present: float | None

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

    def holds(self, parameters: Array) -> Array:
        """Return whether what is asked holds with each of some parameters."""
        found: Array = self.trials.with_numbers(self.ray.places, self.ray.at(parameters))[self.level]
        return found

    @cached_property
    def run(self) -> tuple[float, float]:
        """Return the ends of the values that hold one beside the other, of several such runs of that nearest to today's value."""
        edges, grid = np.flatnonzero(np.diff(np.concatenate([[False], self.held, [False]]).astype(int))), self.ray.grid
        runs = [(float(grid[i]), float(grid[j - 1])) for i, j in zip(edges[::2], edges[1::2], strict=True)]
        present = self.ray.present
        if present is None:
            return max(runs, key=lambda run: run[1] - run[0])

        def distance(run: tuple[float, float]) -> float:
            nearest = min(run, key=lambda end: abs(end - present))
            if nearest * present > 0:
                return abs(math.log(nearest / present))
            return abs(nearest - present) / max(abs(nearest), abs(present))

        return min(runs, key=distance)

    @property
    def rises(self) -> bool:
        """Return whether the values that hold lie above the present one."""
        return bool(self.run[1] == self.ray.grid[-1] if self.ray.present is None else self.run[0] > self.ray.present)

    @property
    def relation(self) -> Relation:
        """Return how the run bounds the parameter: on one side where all that was tried beyond it holds."""
        if self.rises:
            return "at_least" if self.run[1] == self.ray.grid[-1] else "between"
        return "at_most" if self.run[0] == self.ray.grid[0] else "between"

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
        middles = (self.ray.grid[1:] + self.ray.grid[:-1]) / 2
        values = np.concatenate([[near, far], np.linspace(low, high, GRID_POINTS), middles, *decades])
        values = np.unique(np.rint(values) if meta.integer else values)
        return _allowed(meta, values[(low <= values) & (values <= high)])[:: 1 if near <= far else -1]

    def low(self) -> float:
        """Return the lower end of the run, moved as far as it holds."""
        end = self.run[0]
        return self._moved(end, max((each for each in self._tried() if each < end), default=end))

    def high(self) -> float:
        """Return the upper end of the run, moved as far as it holds."""
        end = self.run[1]
        return self._moved(end, min((each for each in self._tried() if each > end), default=end))

    def _tried(self) -> list[float]:
        return [*self.ray.grid.tolist(), *([] if self.ray.present is None else [self.ray.present])]

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
    grid = np.sort([each for each in grid if _is_towards(each, place.present, wanted.to)])
    line = TriedLine.of(trials, Ray([place], np.zeros(1), np.ones(1), grid, place.present))
    if line is None:
        return None
    ends = line.run if line.rises else line.run[::-1]
    relation, near, far = (line.relation, *ends) if listed.size else line.region(place.meta)
    change = (_listed_change if is_listed else _change)(line, place, relation, near, far)
    if change is None:
        return None
    typed = change.value if isinstance(change.value, list) else [change.value]
    values = [np.array([[place.si(float(each))]]) for each in typed] if line.level == 0 else []
    broken = [title for value in values for title in trials.broken(trials.changed([place], value))]
    return Way([change], line.level, tuple(dict.fromkeys(broken)))


def _is_towards(value: float, present: float | None, to: str) -> bool:
    if present is None or not to:
        return value != present
    return value > present if to == "up" else value < present


def _grid(place: VariedNumber) -> Array:
    """Values of an input that are tried at first, in their order, SI."""
    meta, present = place.meta, place.present
    if meta.integer:
        start = int(present or 0)
        return _allowed(meta, np.arange(start - 2 * GRID_POINTS, start + 4 * GRID_POINTS + 1, dtype=float))
    low, high = _bounds(meta)
    found = [np.array([each for each in (low, high) if each is not None])]
    if low is not None and high is not None:
        found.append(np.linspace(low, high, GRID_POINTS + 1))
    if present:
        found += [present / FACTORS, present * FACTORS]
    else:
        found.append(np.geomspace(*meta.sizes.ends, 4 * GRID_POINTS))
    return _allowed(meta, np.unique(np.concatenate(found)))


def _allowed(meta: Quantity, values: Array) -> Array:
    found: Array = values[meta.holds(values)]
    return found


def _bounds(meta: Quantity) -> list[float | None]:
    """The least and the greatest number that are allowed, SI, where there are such."""
    ends = (meta.gt if meta.ge is None else meta.ge, meta.lt if meta.le is None else meta.le)
    return [None if end is None else end * meta.parsed_unit.factor for end in ends]


def _ends(meta: Quantity) -> tuple[float, float]:
    """The ends of what a machine may have, SI: the bounds, else the plausible sizes."""
    (low, high), (least, most) = _bounds(meta), meta.sizes.ends
    return (-most if low is None else low or least, most if high is None else high)


def _listed_change(
    line: TriedLine, place: VariedNumber, relation: Relation, near: float, far: float
) -> KeyChangeRecord:
    """The change to a value of a series, or a whole number."""
    low, high = sorted((near, far))
    if relation in ("at_least", "at_most") and line.run[0] != line.run[1]:
        return _changed(place.path, place.meta.unit, relation, _typed(place, near))
    inside = [each for each in line.ray.grid if low <= each <= high]
    near_ones = sorted(sorted(inside, key=lambda each: abs(each - (line.ray.present or 0.0)))[:FEW_OPTIONS])
    values = [_typed(place, each) for each in near_ones]
    return _changed(place.path, place.meta.unit, "one_of" if len(values) > 1 else "equal", *values)


def _typed(place: VariedNumber, value: float) -> float:
    return round(place.shown(value)) if place.meta.integer else place.shown(value)


def _change(
    line: TriedLine, place: VariedNumber, relation: Relation, near: float, far: float
) -> KeyChangeRecord | None:
    """The change to values that hold as they are printed; None where none that is printed does."""
    first = _shortest(line, place, near, up=line.rises)
    if first is None:
        return None
    if relation == "between":
        last = _shortest(line, place, far, up=not line.rises)
        if last is not None and first != last and (last > first) == line.rises:
            return _changed(place.path, place.meta.unit, "between", *sorted((first, last)))
        relation = "equal"
    return _changed(place.path, place.meta.unit, relation, first)


def _shortest(line: TriedLine, place: VariedNumber, value: float, *, up: bool) -> float | None:
    """The shortest number at a limit that holds as it is printed: the nearest may hold, the next one on the safe side does.

    A limit that is such a number itself may fail by the rounding of its last place: the next one lies beyond it.
    """
    limit = place.shown(value)
    beyond = limit + (ROUNDING if up else -ROUNDING) * abs(limit)
    tried = [each for digits in DIGITS for each in (float(f"{limit:.{digits}g}"), outward(beyond, up, digits))]
    held = line.holds(np.array([place.si(each) for each in tried]))
    return next((each for each, is_held in zip(tried, held, strict=True) if is_held), None)


# Several numbers that are changed together; those that need not be changed are left as they are.


def _together(trials: Trials, keys: Sequence[str]) -> Way | None:
    given = [place for key in keys for place in trials.places(key) if place.present is not None]
    # nothing of what is never below zero, such as a bore, does not grow with the others
    places = [place for place in given if not place.present == place.meta.ge == 0] or given
    if not places:
        return None
    ray = _common_ray(places)
    parameter = _nearest(trials, ray)
    if parameter is None:
        return None
    needed = _needed(trials, ray, parameter)
    if len(needed.places) == 1:
        rises = bool(needed.at(np.array([parameter]))[0, 0] > (needed.places[0].present or 0.0))
        return _number(trials, Vary(needed.places[0].key, "up" if rises else "down"), needed.places[0])
    nearest = parameter if needed is ray else _nearest(trials, needed)
    return None if nearest is None else _way_to(trials, needed, nearest)


def _common_ray(places: Sequence[VariedNumber]) -> Ray:
    """All numbers in one proportion, or, where one of them is zero, by the same difference in their units."""
    present = np.array([place.present for place in places], dtype=float)
    if present.all():
        return Ray(places, np.zeros(len(places)), present, np.concatenate([1 / FACTORS[::-1], FACTORS]), 1.0)
    units = np.array([place.meta.parsed_unit.factor for place in places])
    return Ray(places, present, units, np.concatenate([-DIFFERENCES[::-1], DIFFERENCES]), 0.0)


def _nearest(trials: Trials, ray: Ray) -> float | None:
    """The parameter nearest to today's with which the check holds."""
    if ray.present is None:
        return None
    start = int(np.searchsorted(ray.grid, ray.present))
    line = TriedLine.of(trials, replace(ray, grid=ray.grid[max(start - NEAR, 0) : start + NEAR]))
    if line is None or line.level < LEVELS - 1:  # further away more may hold
        line = TriedLine.of(trials, ray)
    if line is None:
        return None
    return line.low() if line.run[0] > ray.present else line.high()


def _needed(trials: Trials, ray: Ray, parameter: float) -> Ray:
    """The ray without the numbers that may stay as they are: what holds with all of them, holds without these."""
    at = np.array([parameter])
    level = _level(trials.with_numbers(ray.places, ray.at(at))) if len(ray.places) > 1 else None
    if level is None:
        return ray
    for place in ray.places:
        left = ray.without(place)
        if left.places and trials.with_numbers(left.places, left.at(at))[min(level, 1), 0]:
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
            changes = [
                _changed(place.path, place.meta.unit, "equal", each)
                for each, place in zip(typed, ray.places, strict=True)
            ]
            broken = () if held[1, 0] else trials.broken(trials.changed(ray.places, values))
            return Way(changes, _level(held) or 0, broken)
    return None


def _safe(place: VariedNumber, value: float, digits: int) -> float:
    """A value as it is printed, rounded away from today's."""
    shown = place.shown(value)
    return round(shown) if place.meta.integer else outward(shown, value > (place.present or 0.0), digits)
