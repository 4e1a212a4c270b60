"""Advice that the engine finds: each change, typed in as it is printed, makes its check hold and breaks no other that held without saying so."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pytest

from diecut_report.machine.calculation import Calculation, Impossible, Unproven
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.inputs import Quantity
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.results.checks import check_results, checks_of, holds, is_of_machine
from diecut_report.results.mechanism_record import KeyChangeRecord
from tests.examples import few
from tests.plugins.cases import OF_KINDS, Case, case, example, names

Inputs = Mapping[str, Any]
WIDELY = 0.5  # decades by which numbers are changed at most
CHANGED = 4  # numbers of a machine that are changed at most
BROKEN = "this check then fails"
COUNT, MANY = 20, 200  # machines of a kind in CI and at night
SLOW = {"elastic_follower": 4, "rolling_bearing": 6}  # machines in CI of kinds of which one takes a second


def drawn(machine: Case, draw: np.random.Generator) -> Inputs:
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


def typed(mechanism: Mechanism, inputs: Inputs, change: KeyChangeRecord) -> Iterator[Inputs]:
    """The inputs with each value of an advice typed in."""
    parts = change.key.split(".")
    key = ".".join(part for part in parts if not part.isdigit())
    meta = Calculation(mechanism, inputs, 1).meta[key]
    for value in change.value if isinstance(change.value, list) else [change.value]:
        number = value
        if isinstance(meta, Quantity):
            number = meta.validate(value if change.unit == "1" else f"{value!r} {change.unit}")
        for part in filter(str.isdigit, parts):
            row = inputs[key]
            number = (*row[: int(part)], number, *row[int(part) + 1 :])
        yield {**inputs, key: number}


def all_typed(mechanism: Mechanism, inputs: Inputs, way: list[KeyChangeRecord]) -> list[Inputs]:
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


def require_advice_holds(mechanism: Mechanism, inputs: Inputs) -> int:
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


@pytest.mark.parametrize(
    "kind", few(OF_KINDS, keep=lambda kind: [*OF_KINDS].index(kind) % 2 == 0 and kind != "cam_gear_transport")
)
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
