"""Examples of which some given numbers are changed at random, by the laws by which people change numbers, and what then breaks."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from diecut_report.config.loader import Config, load_config
from diecut_report.config.plugins import Discovery
from diecut_report.design.inputs import DesignInput, given_numbers
from diecut_report.errors import UserError
from diecut_report.mechanism.names import SI
from diecut_report.quantities.units import unit
from diecut_report.results.checks import checks_of
from diecut_report.results.warm_press import WarmPress, WarmRun
from diecut_report.study.definition.base_inputs import Input, with_values
from diecut_report.study.execution.variant_rows import calculate_rows
from tests.configs import EXAMPLES, GOOD

REPOSITORIES = Path(__file__).parents[2] / "examples"
BESIDE = {"catcher": "machine-builder/plugins", "cutter": "machine-builder/plugins", "sheet_transport": "gripper-chain"}
FILES = [*EXAMPLES, *(path for path in sorted(REPOSITORIES.glob("*/configs/*.yaml")) if path.stem in BESIDE)]
PRINTED = 8  # of so many machines one is printed, too: that takes longer than to calculate it
CHANGED = (1, 3)  # numbers of a machine
Changes = dict[DesignInput, float]


class Fault(NamedTuple):
    """One kind of failure: what is told of it without its numbers, the whole text of one, and what was changed there."""

    kind: str
    told: str
    changes: str


def discovery(file: Path) -> Discovery:
    """The kinds of the program, and those that lie beside an example."""
    return Discovery([REPOSITORIES / BESIDE[file.stem]] if file.stem in BESIDE else [GOOD])


class Drawn:
    """Draw changes of an example: each number by a law of its own."""

    def __init__(self, base: Config, run: WarmRun, seed: int) -> None:
        self.random, self.numbers = np.random.default_rng(seed), given_numbers(base)
        self.alike = dict[
            str, list[float]
        ]()  # sizes of the machine by their units: those that are given, and those that follow
        for each in self.numbers:
            self.alike.setdefault(each.meta.parsed_unit.si, []).append(float(each.present or 0.0))
        for calc in run.calculations.values():
            for name, values in calc.values.items():
                if name in calc.steps and values.dtype != object and np.isfinite(values[0]).all():
                    self.alike.setdefault(unit(calc.steps[name].unit).si, []).extend(map(float, values[0]))

    def changes(self) -> Changes:
        """What one machine differs in."""
        count = min(int(self.random.choice(CHANGED)), len(self.numbers))
        chosen = self.random.choice(len(self.numbers), count, replace=False)
        return {self.numbers[i]: self._value(self.numbers[i]) for i in chosen}

    def _value(self, number: DesignInput) -> float:
        law = self.random.choice([self._slightly, self._widely, self._typed, self._coinciding])
        value = law(number)
        if number.is_whole:
            value = float(round(value))
        allowed = number.allows(np.array([value]))[0]
        return value if allowed and np.isfinite(value) else float(number.present or 0.0)

    def _slightly(self, number: DesignInput) -> float:
        return float((number.present or 0.0) * self.random.uniform(0.99, 1.01))

    def _widely(self, number: DesignInput) -> float:
        return float((number.present or self._coinciding(number)) * 10 ** self.random.uniform(-1, 1))

    def _typed(self, number: DesignInput) -> float:
        law = self.random.choice([self._slightly, self._widely])
        shown = unit(number.unit)
        return shown.to_si(float(f"{shown.from_si(law(number)):.{self.random.integers(1, 3)}g}"))

    def _coinciding(self, number: DesignInput) -> float:
        """Nothing, a size of the machine, or its half or double: lengths are equal, places lie on a breakpoint."""
        sizes = self.alike[number.meta.parsed_unit.si]
        factor = self.random.choice([0.0, 1.0, 1.0, 1.0, 0.5, 2.0, -1.0])
        return float(factor * sizes[self.random.integers(len(sizes))])


def told(changes: Changes) -> str:
    """The changes as somebody types them."""
    return ", ".join(f"{each.name}: {each.typed(value, 17)}" for each, value in changes.items())


def faults(file: Path, count: int, seed: int, alone: int = 1) -> tuple[list[Fault], int]:
    """What breaks, is not proved, is no number or vanishes: one of each kind of failure; and how many machines exist.

    All are calculated together, as by a study; alone are calculated those that cannot exist there, and of the others one of so many.
    Among few machines advice is found for that one alone which is printed: tests/results/test_advice.py follows it.
    """
    base, press = load_config(file, discovery(file)), WarmPress(is_advised=count > PRINTED)
    found = dict[str, Fault]()
    first = press.calculate(base)
    drawn, expected = Drawn(base, first, seed), _checks(first)
    changes = [drawn.changes() for _ in range(count)]
    rows = calculate_rows(base, _columns(drawn.numbers, changes), count)
    for words in (*rows.slow.values(), *rows.broken.values()):
        found[_kind(words)] = Fault(_kind(words), f"among many: {words}", "")
    exists = rows.status != "error"
    for i in np.flatnonzero(~exists | (np.arange(count) % alone == 0)):
        for words in _wrong_alone(
            press, _changed(base, changes[i]), expected, rows.errors[i], printed=i % PRINTED == 0
        ):
            found.setdefault(_kind(words), Fault(_kind(words), words, told(changes[i])))
    return [*found.values()], int(exists.sum())


def _columns(numbers: list[DesignInput], changes: list[Changes]) -> dict[Input, np.ndarray]:
    return {
        each.asked: np.array([change.get(each, each.present) for change in changes], dtype=float) for each in numbers
    }


def _changed(base: Config, changes: Changes) -> Config:
    values = {each.asked: SI(value, each.meta.parsed_unit.si, each.name) for each, value in changes.items()}
    config, problems = with_values(base, values)
    assert not problems
    return config


def _wrong_alone(
    press: WarmPress, config: Config, expected: set[str], among: str | None, *, printed: bool
) -> Iterator[str]:
    """What is wrong with a machine alone, and where it exists though it does not ``among`` others, or the other way round."""
    try:
        run = press.calculate(config)
    except UserError as refused:  # it cannot exist, and words say why
        if among is None:
            yield f"calculated among others, and refused alone: {refused}"
        return
    yield from _wrong(run, expected, printed=printed)
    if among is not None and not run.errors:
        yield f"refused among others ({among}), and calculated alone"


def _wrong(run: WarmRun, expected: set[str], *, printed: bool) -> Iterator[str]:
    yield from map(str, run.errors.values())
    if run.errors:
        return
    yield from (f"{name} is skipped: {why}" for name, why in run.skipped.items())
    yield from (f"{each} vanishes" for each in sorted(expected - _checks(run)) if not _may_be_absent(run, each))
    if printed:
        document = run.document()
        yield from (each.error for each in document.mechanisms.values() if each.error)
        try:
            json.dumps(document.data(), allow_nan=False)
        except ValueError as fault:
            yield f"results: {fault}"


def _checks(run: WarmRun) -> set[str]:
    """The checks of a machine, made or told as not checked."""
    return {f"{name}.{check.id}" for name, checks in run.checks.items() for check in checks}


def _may_be_absent(run: WarmRun, name: str) -> bool:
    """Whether a check judges what its mechanism says that some machines do not have: no step has no fillet."""
    home, _, own = name.partition(".")
    calc = run.calculations[home]
    check = next(each for each in checks_of(calc) if each.id == own)
    return any(
        isinstance(side, str) and getattr(calc.steps.get(side), "exists", None) for side in (check.demand, check.limit)
    )


def _kind(words: str) -> str:
    """What is told without its numbers."""
    return re.sub(r"-?\d[\d.e+-]*", "#", words)
