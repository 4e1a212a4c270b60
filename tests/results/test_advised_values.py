"""Which values an advice names: of small machines, whose limits are known by hand."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Any, Literal

import pytest

from diecut_report.api import Chapter, Check, Inputs, Mechanism, Quantity, Text, Vary
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.checks import AdviceWay
from diecut_report.results.advice import FACTORS
from diecut_report.results.checks import check_results


class Pin(Inputs):
    grade: Annotated[Literal["soft", "hard"], Text("Grade")] = "soft"
    bore: Annotated[float, Quantity("d", "mm", "Bore", gt=0)] = 10


def pin(*checks: Check, advise: tuple[AdviceWay, ...]) -> Mechanism:
    """A pin that gives way when it is soft, and breaks when it is hard."""
    chapter = Chapter("Pin")
    chapter.lookup("strength", "σ", "MPa", "Strength", {"soft": 1.0, "hard": 4.0}, by="grade")
    chapter.value("notch", "k", "1", "Notch sensitivity", lambda: 1, needs=("grade=soft",))
    chapter.value("notch", "k", "1", "Notch sensitivity", lambda: 3, needs=("grade=hard",))
    chapter.value("pressure", "p", "MPa", "Pressure", lambda bore: 2e6 * 0.01 / bore)
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
    width: Annotated[float, Quantity("b", "mm", "Width", gt=0)]
    room: Annotated[float, Quantity("B", "mm", "Room for it", gt=0)] = 100_000
    damping: Annotated[float, Quantity("d", "1", "Damping", ge=0)] = 1


def spring(advise: tuple[AdviceWay, ...]) -> Mechanism:
    """A spring that bears from 20 mm on, and without damping swings too far within 10 % of 100 mm squared."""
    chapter = Chapter("Spring")
    chapter.value("load", "p", "1", "Load", lambda width: 0.02 / width)
    chapter.value("swing", "s", "1", "Swing", lambda width, damping: 1 / (damping + abs(1 - (width / 0.1) ** 2)))
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
