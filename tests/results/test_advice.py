"""Advice that the engine finds, typed in as it is printed, makes its check hold and breaks no other unsaid; which values it names."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from diecut_report.api import Chapter, Check, Inputs, Mechanism, Quantity, Text, Vary, lookup, m, number, value
from diecut_report.machine.calculation import Calculation, Impossible, Unproven
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.checks import AdviceWay
from diecut_report.results.advice import FACTORS
from diecut_report.results.checks import check_results, checks_of, holds, is_of_machine
from diecut_report.results.mechanism_record import KeyChangeRecord
from tests.examples import few
from tests.plugins.cases import OF_KINDS, Case, case, example, names

Given = Mapping[str, Any]
WIDELY = 0.5  # decades by which numbers are changed at most
CHANGED = 4  # numbers of a machine that are changed at most
BROKEN = "this check then fails"
COUNT, MANY = 20, 200  # machines of a kind in CI and at night
SLOW = {"elastic_follower": 4, "rolling_bearing": 6}  # machines in CI of kinds of which one takes a second


def drawn(machine: Case, draw: np.random.Generator) -> Given:
    """The inputs of a machine beside this one."""
    known, inputs = Calculation(machine.mechanism, machine.values, 1).meta, dict(machine.values)
    numbers = [name for name, value in inputs.items() if isinstance(known.get(name), Quantity) and _is_number(value)]
    for name in draw.choice(numbers, min(len(numbers), int(draw.integers(1, CHANGED + 1))), replace=False):
        row = inputs[name] if isinstance(inputs[name], tuple) else (inputs[name],)
        meta = known[name]
        assert isinstance(meta, Quantity)
        low, high = machine.widely.get(name, (10**-WIDELY, 10**WIDELY))
        values = [float(draw.uniform(low, high)) * (1 if name in machine.widely else each or 0.0) for each in row]
        values = [round(value) if meta.integer else value for value in values]
        if meta.holds(np.array(values)).all():
            inputs[name] = tuple(values) if isinstance(inputs[name], tuple) else values[0]
    return inputs


def _is_number(value: Any) -> bool:
    parts = value if isinstance(value, tuple) else (value,)
    return all(isinstance(part, float | int) and not isinstance(part, bool) for part in parts)


def typed(mechanism: Mechanism, inputs: Given, change: KeyChangeRecord) -> Iterator[Given]:
    """The inputs with each value of an advice typed in."""
    parts = change.key.split(".")
    key = ".".join(part for part in parts if not part.isdigit())
    meta = Calculation(mechanism, inputs, 1).meta[key]
    for given in change.value if isinstance(change.value, list) else [change.value]:
        number = given
        if isinstance(meta, Quantity):
            number = meta.validate(given if change.unit == "1" else f"{given!r} {change.unit}")
        for part in filter(str.isdigit, parts):
            row = inputs[key]
            number = (*row[: int(part)], number, *row[int(part) + 1 :])
        yield {**inputs, key: number}


def all_typed(mechanism: Mechanism, inputs: Given, way: list[KeyChangeRecord]) -> list[Given]:
    """The inputs with the changes of a way."""
    found = [inputs]
    for change in way:
        found = [after for before in found for after in typed(mechanism, before, change)]
    return found


def machines(kind: str) -> list[Case]:
    """The machines of a kind, but for those of the examples that cannot be calculated."""
    return [case(kind, name) for name in names(kind) if _is_calculated(*name.split("-"))]


def _is_calculated(stem: str, instance: str = "") -> bool:
    return not instance or instance in example(stem).calculations


def require_advice_holds(mechanism: Mechanism, inputs: Given) -> int:
    """Follow all advice of a machine, each value by itself; return how many ways there were."""
    before = calculate(mechanism, inputs)
    passing = [name for name, is_held in verdicts(before).items() if is_held]
    ways = [(check, way) for check in check_results(before) for way in check.advice]
    for check, way in ways:
        for changed in all_typed(mechanism, inputs, way):
            after = verdicts(calculate(mechanism, changed))
            assert after[check.id], (check.message, way, inputs)
            broken = [name for name in passing if not after.get(name, True)]
            assert not broken or BROKEN in check.message, (check.message, way, broken, inputs)
    return len(ways)


def verdicts(calc: Calculation) -> dict[str, bool]:
    """Whether each check of a machine holds that is made."""
    found = [(check.id, holds(calc, check)) for check in checks_of(calc) if is_of_machine(check)]
    return {name: bool(is_held[0]) for name, (is_made, is_held) in found if is_made[0]}


def follow_advice_of_random_machines(kind: str, count: int, seed: int) -> int:
    """Follow the advice of machines that are drawn at random; return how many ways there were."""
    draw, known = np.random.default_rng(seed), machines(kind)
    found, ways = 0, 0
    while found < count:
        machine = known[int(draw.integers(len(known)))]
        inputs = drawn(machine, draw)
        try:
            calculate(machine.mechanism, inputs)
        except (Impossible, Unproven):
            continue
        found += 1
        ways += require_advice_holds(machine.mechanism, inputs)
    return ways


@pytest.mark.parametrize("kind", few(OF_KINDS, keep=lambda kind: [*OF_KINDS].index(kind) % 4 == 2))
def test_advice_of_the_examples_makes_its_check_hold(kind: str) -> None:
    for machine in machines(kind):
        require_advice_holds(machine.mechanism, machine.values)


ADVISED = [kind for kind, mechanism in OF_KINDS.items() if any(check.advise for check in mechanism.checks)]


@pytest.mark.parametrize("kind", few(ADVISED, keep=lambda kind: kind == "clutch"))
def test_advice_of_random_machines_makes_its_check_hold(kind: str) -> None:
    assert follow_advice_of_random_machines(kind, SLOW.get(kind, COUNT), seed=1) > 0


@pytest.mark.nightly
@pytest.mark.parametrize("kind", ADVISED)
def test_advice_of_many_random_machines_makes_its_check_hold(kind: str) -> None:
    follow_advice_of_random_machines(kind, MANY, seed=2)


# Small machines, whose limits are known by hand.


class Pin(Inputs):
    grade = Text("Grade", ("soft", "hard"), default="soft")
    bore = Quantity("d", "mm", "Bore", gt=0, default=10)


def pin(*checks: Check, advise: tuple[AdviceWay, ...]) -> Mechanism:
    """A pin that gives way when it is soft, and breaks when it is hard."""
    chapter = Chapter("Pin")
    chapter.strength = lookup({"soft": 1.0, "hard": 4.0}, by="grade"), "σ", "MPa", "Strength"
    chapter.notch = value(1, needs=("grade=soft",)), "k", "1", "Notch sensitivity"
    chapter.notch = value(3, needs=("grade=hard",)), "k", "1", "Notch sensitivity"
    chapter.pressure = number(2e6) * 0.01 / m.bore, "p", "MPa", "Pressure"
    strong = check("strong", "pressure", "strength", unit="MPa", advise=advise)
    return Mechanism(
        kind="pin", version="1", title="", summary="", inputs=Pin, chapters=(chapter,), checks=(strong, *checks)
    )


def check(id: str, demand: str, limit: str | float, **more: Any) -> Check:
    """A check that something holds."""
    sound = {"check_class": "strength", "title": id, "demand_label": "", "limit_label": "", "consequence": "it breaks."}
    return Check(**{"id": id, "unit": "1", "demand": demand, "limit": limit, **sound, **more})


def message(mechanism: Mechanism, **inputs: Any) -> str:
    """What the first check of a machine says."""
    return str(check_results(calculate(mechanism, inputs))[0].message)


def test_a_text_that_makes_another_check_fail_says_so() -> None:
    machine = pin(check("tough", "notch", 2.0), advise=("grade",))
    assert "Set grade to hard (this check then fails: “tough”)." in message(machine, grade="soft", bore=0.01)


class Spring(Inputs):
    width = Quantity("b", "mm", "Width", gt=0)
    room = Quantity("B", "mm", "Room for it", gt=0, default=100_000)
    damping = Quantity("d", "1", "Damping", ge=0, default=1)


def spring(advise: tuple[AdviceWay, ...]) -> Mechanism:
    """A spring that bears from 20 mm on, and without damping swings too far within 10 % of 100 mm squared."""
    chapter = Chapter("Spring")
    chapter.load = 0.02 / m.width, "p", "1", "Load"
    chapter.swing = 1 / (m.damping + abs(1 - (m.width / 0.1) ** 2)), "s", "1", "Swing"
    checks = (
        check("load", "load", 1.0, advise=advise),
        check("swing", "swing", 10.0),
        check("room", "width", "room", unit="mm"),
    )
    return Mechanism(
        kind="spring", version="1", title="", summary="", inputs=Spring, chapters=(chapter,), checks=checks
    )


@pytest.mark.parametrize(
    ("machine", "told"),
    [
        ({}, "at least 20 mm"),
        ({"damping": 0.0}, "between 20 mm and 94.86 mm"),  # √0.9 · 100 mm, between two values of the grid
        ({"room": 5.0}, "between 20 mm and 5000 mm"),  # beyond the grid
    ],
)
def test_one_side_is_advised_as_far_as_all_holds_that_is_tried(machine: dict[str, float], told: str) -> None:
    grid = 11 * FACTORS
    assert not ((grid > 94.8) & (grid < 104.9)).any() and grid[-1] < 5000
    assert f"Set width to {told}." in message(
        spring(("width",)), width=0.011, **{"damping": 1.0, "room": 100.0} | machine
    )


@pytest.mark.parametrize(
    ("series", "told"),
    [((10, 15, 25, 30, 35), "at least 25 mm"), ((10, 15, 20, 30, 90, 95), "20 mm or 30 mm or 90 mm")],
)
def test_of_a_series_the_values_nearest_to_the_present_one_are_named(series: tuple[float, ...], told: str) -> None:
    machine = spring((Vary("width", series=series),))
    assert f"Set width to {told}." in message(machine, width=0.011, damping=0.0, room=100.0)


def test_of_a_series_the_greatest_that_is_small_enough_is_named() -> None:
    machine = spring((Vary("width", "down", (1, 2, 5, 8)),))
    small = replace(
        machine, checks=(replace(check("room", "width", "room", unit="mm"), advise=machine.checks[0].advise),)
    )
    assert "Set width to at most 5 mm." in message(small, width=0.011, damping=1.0, room=0.006)
