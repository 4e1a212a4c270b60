"""Inputs with a default of the press name a number that a press may give, of their own kind."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from diecut_report.api import ExampleBlock, FromPress, Inputs, Quantity, formula, pi
from diecut_report.config.model import faults
from diecut_report.config.plugins import Discovery
from tests.declaration.test_faults import made


@formula
def a_turn_each(productivity: Any) -> Any:
    return 2 * pi * productivity


def told(unit: str, press: FromPress) -> list[str]:
    class Driven(Inputs):
        speed = Quantity("ω", unit, "Speed", press=press, optional=True)

    return [str(fault) for fault in faults(replace(made(), inputs=Driven))]


@pytest.mark.parametrize("kind", [kind for kind, origins in Discovery().origins.items() if origins[0].is_own])
def test_the_programs_own_plugins_take_what_the_press_has(kind: str) -> None:
    assert not list(faults(Discovery().mechanism(kind)))


def test_a_number_of_the_press_is_taken_as_it_is_or_by_a_formula() -> None:
    assert told("1/min", FromPress("press.productivity")) == []
    assert told("rpm", FromPress("press.productivity", a_turn_each)) == []


@pytest.mark.parametrize("path", ["press.speed", "productivity", "press.sheet", "press.name"])
def test_what_is_no_number_of_the_press_is_told_at_its_line(path: str) -> None:
    (text,) = told("1/min", FromPress(path))
    assert text.startswith("test_press_defaults.py:") and f"input speed: takes {path}, which is not a number of" in text


def test_an_example_is_made_for_a_press_that_there_may_be() -> None:
    def of_press(**press: str) -> list[str]:
        return [str(fault) for fault in faults(replace(made(), example=ExampleBlock("a", {}, press=press)))]

    assert of_press(productivity="1200 1/h", **{"sheet.length": "500 mm"}) == []
    (text,) = of_press(speed="5 rpm")
    assert "example a: press speed is not a number of the press" in text
    (text,) = of_press(productivity="5 rpm")
    assert "example a: press productivity 5 rpm is an angular speed" in text


def test_a_number_of_another_kind_is_told() -> None:
    (text,) = told("rpm", FromPress("press.productivity"))
    assert "input speed: in rpm takes press.productivity, which is in 1/h; name a formula between them" in text
