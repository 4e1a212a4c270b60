"""What matters: how far each input moves the governing checks, and how probable it is that the checks hold within tolerances."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.design.design_inputs import DesignInput, given_numbers, numbers_at_default
from diecut_report.design.questions import AskedNumber, quantity
from diecut_report.design.varied_machines import CHECKS, NO_RESERVE, UTILISATION, VariedMachines, varied
from diecut_report.errors import Problem, UserError
from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.results.summary import may_govern, weight

Distribution = Literal["normal", "uniform"]
MOST_CHECKS = 5  # governing checks that are looked at where nothing is asked
IN_TOLERANCE = 3.0  # standard deviations that a tolerance is of a normal distribution
SURE = 0.95  # that the probability lies within its interval
STILL = 1e-9  # share of its size by which a number is moved by rounding alone


@dataclass(frozen=True)
class InputEffect:
    """Hold what an input does to a number: the number with the input lowered and raised, NaN where there is no machine."""

    design: DesignInput
    lowered: float
    raised: float
    low: float
    high: float

    def reach(self, today: float) -> float:
        """Return how far the number moves at most; infinite where a machine cannot be."""
        moved = np.abs(np.array([self.low, self.high]) - today)
        return float("inf") if np.isnan(moved).any() else float(moved.max())


@dataclass(frozen=True)
class Tornado:
    """Hold the inputs by what they do to a number, the greatest first.

    Those that do nothing are counted (``still``), and those that stand at their default and were not changed (``at_default``).
    """

    asked: AskedNumber
    today: float
    bars: tuple[InputEffect, ...]
    still: int
    at_default: int = 0


@dataclass(frozen=True)
class Chance:
    """Hold how probable it is that a check holds, with its interval (Clopper and Pearson), and how many of how many machines hold."""

    check: str
    held: int
    count: int
    probability: float
    low: float
    high: float


@dataclass(frozen=True)
class Tolerances:
    """Hold what was drawn: tolerances (SI) by input, their distribution, the seed, and what came out for each check and for all."""

    by_input: Mapping[DesignInput, float]
    distribution: Distribution
    seed: int
    count: int
    whole: Chance
    chances: tuple[Chance, ...]


def tornados(
    config: Config,
    names: Sequence[str],
    share: float,
    tolerances: Mapping[DesignInput, float],
    *,
    defaults: bool = False,
) -> list[Tornado]:
    """Return for each number that is asked for what each input does to it: changed by its tolerance, else by a share of its value.

    With ``defaults`` inputs that stand at their default are changed too. Without names these are the utilisations of the checks that
    govern. UserError where there is nothing to look at.
    """
    for each in tolerances:
        require_scatter(each)
    own = {each.asked.path for each in tolerances}
    standing = numbers_at_default(config)
    numbers = [*given_numbers(config), *(standing if defaults else ())]
    inputs = [*tolerances, *(each for each in numbers if each.today and each.asked.path not in own)]
    if not inputs:
        words = phrase("nothing is given as a number that is not zero, so nothing has an influence.")
        raise UserError(Problem(words, config.tree.file))
    ends = [_ends(each, tolerances.get(each) or _step(each, share)) for each in inputs]
    asked = list({each.column: each for each in (quantity(config, name) for name in names)}.values())
    made = _beside(config, inputs, ends, asked)
    if not made.exists[0]:
        raise UserError(Problem(made.reasons[0], config.tree.file))
    asked = asked or [quantity(config, name) for name in _governing(made)]
    for number in asked:
        _require_value(config, made, number)
    left = 0 if defaults else sum(1 for each in standing if each.today and each.asked.path not in own)
    return [replace(_tornado(made, each, inputs, ends), at_default=left) for each in asked]


def by_input(sizes: Iterable[tuple[DesignInput, float]]) -> dict[DesignInput, float]:
    """Return tolerances by their inputs; UserError in words where one is given twice, maybe by another name that refers to it."""
    found: dict[str, tuple[DesignInput, float]] = {}
    for design, size in sizes:
        if design.asked.path in found:
            words = "{input} is given more than one tolerance; leave one of them."
            raise UserError(Problem(Phrase(words, input=design.name), path="--tolerance"))
        found[design.asked.path] = design, size
    return dict(found.values())


def require_scatter(design: DesignInput) -> None:
    """Refuse a tolerance of what does not scatter: a whole number, or one without a value today."""
    if design.is_whole or design.today is None:
        words = "{input} is a whole number or has no value today, so that it has no tolerance."
        raise UserError(Problem(Phrase(words, input=design.name), path="--tolerance"))


def _require_value(config: Config, made: VariedMachines, asked: AskedNumber) -> None:
    if not np.isfinite(made.values(asked.column)[0]):
        words = "{asked} has no value today: an input that it needs is not given, or the check is not made."
        raise UserError(Problem(Phrase(words, asked=asked.name), config.tree.file, path="--of"))


def _step(design: DesignInput, share: float) -> float:
    size = abs(design.today or 0.0) * share
    return max(1.0, float(round(size))) if design.is_whole else size


def _ends(design: DesignInput, step: float) -> tuple[float, float]:
    """The input lowered and raised, not beyond the range that its declaration has: no machine there says anything of this one.

    Towards an end that does not belong to the range it goes half the way; of listed numbers the next ones are taken.
    """
    today = design.today or 0.0
    if listed := [value * design.meta.parsed_unit.factor for value in design.meta.listed]:
        near = STILL * abs(today)
        return (max((each for each in listed if each < today - near), default=today),
                min((each for each in listed if each > today + near), default=today))  # fmt: skip
    low, high = design.bounds
    found = np.array([max(today - step, low), min(today + step, high)])
    lowered, raised = np.where(design.allows(found), found, (found + today) / 2)
    return float(lowered), float(raised)


def _beside(
    config: Config, inputs: Sequence[DesignInput], ends: Sequence[tuple[float, float]], asked: Sequence[AskedNumber]
) -> VariedMachines:
    """Today's machine, then for each input the one with less and the one with more of it."""
    count = 1 + 2 * len(inputs)
    given = {}
    for index, (design, pair) in enumerate(zip(inputs, ends, strict=True)):
        column = np.full(count, design.today)
        column[1 + 2 * index : 3 + 2 * index] = pair
        given[design.asked] = column
    return varied(config, given, count, [each.asked for each in asked if each.asked is not None])


def _governing(made: VariedMachines) -> list[str]:
    """The check that governs each mechanism today, by the rules of the results; the one that governs the machine first."""
    checks: dict[str, list[dict[str, Any]]] = {}
    for name in made.checks:
        home, _, own = name.partition(".")
        if np.isfinite(ratio := float(made.check(name, UTILISATION)[0])):
            known = {"id": f"{home}{CHECKS}{own}", "class": "", "status": made.check(name)[0], "utilisation": ratio}
            checks.setdefault(home, []).append(known | {"presumed": bool(made.check(name, NO_RESERVE)[0])})
    used = [max(filter(may_govern, own), key=weight, default=None) for own in checks.values()]
    return [found["id"] for found in sorted(filter(None, used), key=weight, reverse=True)[:MOST_CHECKS]]


def _tornado(
    made: VariedMachines, asked: AskedNumber, inputs: Sequence[DesignInput], ends: Sequence[tuple[float, float]]
) -> Tornado:
    values = made.values(asked.column)
    today = float(values[0])
    bars = [
        InputEffect(each, lowered, raised, float(values[1 + 2 * i]), float(values[2 + 2 * i]))
        for i, (each, (lowered, raised)) in enumerate(zip(inputs, ends, strict=True))
    ]
    moving = [each for each in bars if each.reach(today) > STILL * abs(today)]
    return Tornado(asked, today, tuple(sorted(moving, key=lambda each: -each.reach(today))), len(bars) - len(moving))


def within_tolerances(
    config: Config, tolerances: Mapping[DesignInput, float], distribution: Distribution, count: int, seed: int
) -> Tolerances:
    """Return how probable it is that each check holds where the inputs scatter within their tolerances, drawn with a fixed seed.

    A tolerance is half the width of a uniform distribution, or three standard deviations of a normal one. A machine that cannot be
    holds no check.
    """
    draws = np.random.default_rng(seed)
    given = {}
    for design, tolerance in tolerances.items():
        require_scatter(design)
        assert design.today is not None
        off = (
            draws.normal(0.0, tolerance / IN_TOLERANCE, count)
            if distribution == "normal"
            else draws.uniform(-tolerance, tolerance, count)
        )
        given[design.asked] = design.today + off
    made = varied(config, given, count)
    chances = [_chance(name, made.check(name) == "pass", _judged(made, name)) for name in made.checks]
    whole = _chance(
        phrase("all checks"), np.isin(made.status.astype(str), ["pass", "warn"]), np.ones(count, dtype=bool)
    )
    found = sorted((each for each in chances if each.count), key=lambda each: (each.probability, each.check))
    return Tolerances(tolerances, distribution, seed, count, whole, tuple(found))


def _judged(made: VariedMachines, name: str) -> Array:
    """The machines for which a check is made, or that cannot be."""
    return np.asarray(~made.exists | np.array([status is not None for status in made.check(name)]))


def _chance(name: str, held: Array, judged: Array) -> Chance:
    from scipy.stats import binomtest

    count, good = int(judged.sum()), int((held & judged).sum())
    if not count:
        return Chance(name, 0, 0, 0.0, 0.0, 1.0)
    interval = binomtest(good, count).proportion_ci(SURE, method="exact")
    return Chance(name, good, count, good / count, float(interval.low), float(interval.high))
