"""Mistakes of authors in phases are told with the phase, what is wrong, and what to write instead."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from diecut_report.api import Chapter, Constant, Inputs, Mechanism, Quantity, abscissa, m, samples
from diecut_report.declaration import faults
from diecut_report.mechanism.steps import Phase


class Knife(Inputs):
    begins = Quantity("φ_1", "deg", "Where it begins")
    ends = Quantity("φ_2", "deg", "Where it ends")
    blade = Quantity("l", "mm", "Length")
    guard = Quantity("φ_3", "deg", "Guard", optional=True)
    speed = Quantity("ω", "rpm", "Speed")
    n_points = samples(36)


Declare = Callable[[Chapter], None]


def told(declare: Declare) -> list[str]:
    """What is said of a mechanism with these phases beside a sound one."""
    chapter = Chapter("Knife")
    chapter.angle = abscissa(2 * np.pi, speed="speed"), "φ", "deg", "Angle"
    chapter.edge_way = m.angle * m.blade, "s", "mm", "Way"
    chapter.phase("cutting", "working", "Cutting", "angle", ("begins", "ends"))
    chapter.phase("guarded", "window", "Guarded", "angle", (0, "guard"), needs=("guard",))
    declare(chapter)
    made = Mechanism(kind="knife", version="1", title="Knife", summary="Knife.", inputs=Knife, chapters=(chapter,))
    return [str(fault) for fault in faults(made)]


def test_sound_phases_pass() -> None:
    assert told(lambda c: c.phase("free", "window", "Free", "angle", rest_of=("cutting",))) == []


MISTAKES: dict[str, tuple[Declare, str]] = {
    "an unknown role": (lambda c: c.phase("x", "workin", "X", "angle", (0, "ends")), "role 'workin' (did you mean 'working'?)"),  # type: ignore[arg-type]
    "no form": (lambda c: c.phase("x", "rest", "X", "angle"), "needs one of three forms"),
    "two forms": (lambda c: c.phase("x", "rest", "X", "angle", (0, "ends"), union=("cutting",)), "needs one of three forms"),
    "no pair": (lambda c: c.phase("x", "rest", "X", "angle", "begins", "ends"), '("begins", "ends")'),  # type: ignore[arg-type]
    "a place in mm": (lambda c: c.phase("x", "rest", "X", "angle", ("blade", "ends")), "goes to blade, in mm; its abscissa angle is in deg"),
    "an unknown place": (lambda c: c.phase("x", "rest", "X", "angle", ("begin", "ends")), "begin, which nothing gives (did you mean 'begins'?)"),
    "a curve as a place": (lambda c: c.phase("x", "rest", "X", "angle", ("edge_way", "ends")), "edge_way, a curve; a single number is wanted"),
    "no abscissa": (lambda c: c.phase("x", "rest", "X", "blade", (0, "ends")), "blade, a number; the id of an Abscissa is wanted"),
    "an unknown phase": (lambda c: c.phase("x", "rest", "X", "angle", union=("cuting",)), "not declared above it (did you mean 'cutting'?)"),
    "a phase that may be absent": (lambda c: c.phase("x", "rest", "X", "angle", union=("guarded",)), "without guard; give both the same needs"),
    "an optional place": (lambda c: c.phase("x", "rest", "X", "angle", (0, "guard")), "guard, which nothing gives without guard"),
    "a phase twice": (lambda c: c.phase("cutting", "working", "X", "angle", (0, "ends")), "has the id of another step"),
    "a bare end": (lambda c: c.phase("x", "rest", "X", "angle", ("begins", 240)), "goes to 240, a number without a unit"),
    "a bare end in SI": (lambda c: c.phase("x", "rest", "X", "angle", (2.5, "ends")), "goes to 2.5, a number without a unit"),
    "a bare period of a phase": (
        lambda c: c.phase("x", "rest", "X", "angle", (0, "ends"), period=360),  # type: ignore[arg-type]
        "has period=360; name the input or the step that gives it, by its id",
    ),
    "a period in mm": (
        lambda c: c.phase("x", "rest", "X", "angle", (0, "ends"), period="blade"), "has the period blade, in mm; its abscissa angle is in deg"),
    "a period in degrees": (
        lambda c: c.add(abscissa(360).step("turn", "ψ", "deg", "Turn")), "has the period 360, a number of radians that is not a part of"),
    "a bare period": (lambda c: c.add(abscissa(400).step("way", "x", "mm", "Way")), "has the period 400, a number without a unit; name the input"),
    "a bare place of print": (
        lambda c: c.add(abscissa(2 * np.pi, shown_at=120).step("turn", "ψ", "deg", "Turn")),  # type: ignore[arg-type]
        "has shown_at=120",
    ),
    "a bare length of pieces": (lambda c: c.breakpoints("b", "angle", every=30), "has every=30"),  # type: ignore[arg-type]
    "a speed in mm": (lambda c: c.add(abscissa(2 * np.pi, speed="blade").step("turn", "ψ", "deg", "Turn")), "a speed in deg/s is needed"),
}  # fmt: skip


@pytest.mark.parametrize("what", MISTAKES)
def test_a_mistake_is_told(what: str) -> None:
    declare, words = MISTAKES[what]
    found = told(declare)
    assert any(words in text for text in found), found
    assert all("test_phases.py" in text for text in found)


@pytest.mark.parametrize("turns", [2, 1, 0.5, 1 / 3, 1 / 7 * 7, 4])
def test_parts_of_a_turn_are_periods(turns: float) -> None:
    assert told(lambda c: c.add(abscissa(turns * np.pi).step("turn", "ψ", "deg", "Turn"))) == []


def test_a_constant_with_its_unit_is_a_period() -> None:
    assert told(lambda c: c.add(abscissa(Constant(0.4, "l", "m")).step("way", "x", "mm", "Way"))) == []


def test_a_phase_is_a_step_with_a_name_of_its_own() -> None:
    """A quantity may have the same name."""
    chapter = Chapter("C")
    chapter.phase("cutting", "working", "Cutting", "angle", ("a", "b"))
    step: Any = chapter.steps[0]
    assert isinstance(step, Phase)
    assert (step.id, step.spans) == ("phases.cutting", (("a", "b"),))
