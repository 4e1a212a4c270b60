"""A new type of step is one class and a line of the register: declared, checked, calculated, printed and stored without any other room knowing it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
import pytest

from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, abscissa, m, samples
from diecut_report.declaration import faults
from diecut_report.declaration.formula_checks import check_mechanism
from diecut_report.machine.printing.page import section_items
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism import recipes
from diecut_report.mechanism.names import Misdeclared
from diecut_report.mechanism.steps import Step, Steps
from diecut_report.mechanism.steps.base import QuantityStep, recipe
from diecut_report.mechanism.steps.protocols import A_CURVE, Item, Kinds, Names, StepEngine, StepPrinter
from diecut_report.quantities.units import Kind
from diecut_report.results.mechanism import mechanism_results


@dataclass(frozen=True, eq=False)
class Swing(QuantityStep):
    """Declare how far a curve goes beyond ``level`` times its mean: a type of step that the program does not have."""

    of: str
    level: float = 1.0

    TAKES: ClassVar[dict[str, Kinds]] = {"of": A_CURVE}

    @property
    def asked_curve(self) -> str:
        return self.of

    @property
    def signs(self) -> tuple[float, ...]:
        return (1.0,)

    def shape_faults(self) -> Iterator[str]:
        if self.level <= 0:
            yield "has a level that is not above zero"

    def same_units(self, units: Callable[[str], set[str]], names: Names) -> Iterator[tuple[str, set[str]]]:
        yield self.of, units(self.of)

    def dimensions(self, of: Callable[[str], Kind], axis: Callable[[str], str]) -> Iterator[tuple[str, Any, Any]]:
        yield self.of, of(self.of), of(self.id)

    def run(self, calc: StepEngine) -> None:
        integral, residual = calc.integral(self.of, 1)
        calc.prove(self, residual)
        mean = integral / calc.domains[calc.axis[self.of]].period
        calc.values[self.id] = calc.extreme(self.of, 1.0)[0] - self.level * mean

    def items(self, page: StepPrinter) -> list[Item]:
        result = page.result(self, page.value_at(self.id, None))
        return [self.head() | {"type": "found", "relation": None, "method": "top less mean", "result": result}]


swing = recipe(Swing)
"""The register's line of the new type."""


class Wave(Inputs):
    size = Quantity("a", "mm", "Size of the wave", gt=0, default=20)
    n_points = samples(36)


def wave(unit: str = "mm", of: str = "height", level: float = 1.0) -> Mechanism:
    chapter = Chapter("Wave")
    chapter.angle = abscissa(2 * np.pi), "φ", "deg", "Angle"
    chapter.height = m.size * (3 + np.sin(m.angle)), "h", "mm", "Height"
    chapter.swing = swing(of, level), "s", unit, "Swing"
    chapter.doubled = 2 * m.swing, "s_2", "mm", "Twice the swing"
    return Mechanism(kind="wave", version="1", title="Wave", summary="", inputs=Wave, chapters=(chapter,))


def test_it_is_checked_as_others_are() -> None:
    assert faults(wave()) == []
    check_mechanism(wave())


@pytest.mark.parametrize(
    ("made", "words"),
    [
        (wave(unit="kN"), "step swing: is in kN, height in mm"),
        (wave(of="size"), "step swing: of is size, a number; a curve over an abscissa is wanted"),
        (wave(of="lost"), "step swing: takes lost, which nothing gives"),
        (wave(level=0.0), "step swing: has a level that is not above zero"),
    ],
)
def test_what_is_wrong_with_it_is_told_with_its_place(made: Mechanism, words: str) -> None:
    told = list(map(str, faults(made)))
    assert any(words in line and line.startswith("test_step_types.py:") for line in told), told


def test_its_call_knows_the_options_of_all_steps() -> None:
    with pytest.raises(Misdeclared, match=r"swing has no option neds \(did you mean 'needs'\?\)"):
        Chapter("Wave").swing = swing("height", neds=("size",)), "s", "mm", "Swing"  # type: ignore[call-arg]
    with pytest.raises(
        TypeError, match=r"test_step_types\.py:\d+: swing: .*missing a required argument: 'of'; it takes of, level"
    ):
        Chapter("Wave").swing = swing(), "s", "mm", "Swing"  # type: ignore[call-arg]


def test_it_is_calculated_of_one_machine_and_of_many() -> None:
    assert calculate(wave(), {"size": 0.02, "n_points": 36})["swing"] == pytest.approx(0.02)
    many = calculate(wave(), {"size": np.linspace(0.01, 0.1, 12), "n_points": 36}, 12)
    assert many["doubled"][:, 0] == pytest.approx(2 * np.linspace(0.01, 0.1, 12))


def test_it_is_printed_and_stored() -> None:
    calc = calculate(wave(), {"size": 0.02, "n_points": 36})
    [chapter] = section_items(calc)
    assert {item["id"]: item["result"]["text"] for item in chapter["items"] if item["id"] == "swing"} == {"swing": "20"}
    assert mechanism_results(calc, {}).outputs["swing"].value == pytest.approx(0.02)


def test_each_type_has_a_call_of_its_name() -> None:
    both = vars(Steps) | vars(recipes)
    calls = {name: call.__name__ for name, call in both.items() if hasattr(call, "__signature__")}
    assert len(calls) > 30 and calls == {name: name for name in calls}


def test_names_of_fields_are_fields_of_each_type() -> None:
    for each in _types(Step):
        fields = getattr(each, "__dataclass_fields__", {})
        if "__dataclass_fields__" in vars(each):
            assert {name for name in (*each.TAKES, *each.FORMULAS) if name not in fields} == set(), each


def _types(base: type[Step]) -> Iterator[type[Step]]:
    for each in base.__subclasses__():
        yield each
        yield from _types(each)
