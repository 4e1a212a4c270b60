"""What may be a mistake is noted: a unit that a formula converts by hand, a chapter that nothing depends on."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Any

import numpy as np
import pytest

from diecut_report.api import GRAVITY, Chapter, Check, Inputs, Mechanism, Quantity
from diecut_report.declaration.formula_checks import doubts


class Drum(Inputs):
    rate: Annotated[float, Quantity("n", "1/min", "Rate", gt=0)] = 60
    allowed: Annotated[float, Quantity("[n]", "1/min", "Allowed", gt=0)] = 60
    mass: Annotated[float, Quantity("m", "kg", "Mass", gt=0)] = 1


BOTH = ("found", "twi" + "ce")  # the file itself names it once, at its step: code that names a result may take it


def made(formula: Any, key_results: tuple[str, ...] = ("found",)) -> Mechanism:
    first, other = Chapter("First"), Chapter("Other")
    first.value("found", "f", "1/s", "Found", formula)
    other.value("weight", "G", "N", "Weight", lambda mass: mass * GRAVITY)
    other.value("twice", "H", "N", "Twice", lambda weight: 2 * weight)
    return Mechanism(
        kind="drum",
        version="1",
        title="Drum",
        summary="",
        inputs=Drum,
        chapters=(first, other),
        key_results=key_results,
    )


DOUBTFUL = {
    "60": lambda rate: rate / 60,
    "1000": lambda rate: 1000 * rate,
    "100": lambda rate: rate * 100,
    "180": lambda rate: rate * 180 / np.pi,
    "9.81": lambda rate: 9.81 * rate,
    "3.14": lambda rate: 2 * 3.14 * rate,
    "1e6": lambda rate: 1e6 * rate,
}


@pytest.mark.parametrize("number", DOUBTFUL)
def test_a_number_that_may_stand_for_a_unit_is_noted(number: str) -> None:
    (note,) = doubts(made(DOUBTFUL[number], BOTH))
    assert f"found: holds {number}, a number without a unit; formulas are in SI and convert nothing" in note
    assert note.startswith("test_doubts.py:")


def test_a_check_whose_sides_are_exchanged_is_noted() -> None:
    mechanism = made(lambda rate: 2 * rate, BOTH)
    right = Check(id="c", check_class="strength", title="C", demand="found", limit="allowed", unit="1/s", demand_label="d", limit_label="l",
                  consequence="no.")  # fmt: skip
    assert list(doubts(replace(mechanism, checks=(right,)))) == []
    (note,) = doubts(replace(mechanism, checks=(replace(right, demand="allowed", limit="found"),)))
    assert (
        "check c: its demand allowed ([n]) has the symbol of what is allowed, and its limit found is calculated" in note
    )


def test_other_numbers_are_not_noted() -> None:
    assert list(doubts(made(lambda rate: 2 * rate + rate**60 * 0.5 + 32 * rate / 3, BOTH))) == []


def test_a_chapter_that_nothing_depends_on_is_noted() -> None:
    (note,) = doubts(made(lambda rate: 2 * rate))
    assert "chapter 'Other': no check, key result, figure or other chapter takes what it gives" in note
    assert list(doubts(replace(made(lambda rate: 2 * rate), key_results=()))) == []  # nothing is asked of it at all
