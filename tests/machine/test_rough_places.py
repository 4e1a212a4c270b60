"""A curve that jumps or has a pole where no condition tells it is refused with the place; what is only steep, bent or rounded is not."""

from __future__ import annotations

import re
from typing import Annotated, Any

import numpy as np
import pytest

from diecut_report.api import POINTS, Chapter, Inputs, Mechanism, Quantity, as_number
from diecut_report.machine.calculation import Calculation, Unproven
from diecut_report.machine.steps.run import calculate
from diecut_report.results.mechanism import curves


class Arm(Inputs):
    arm: Annotated[float, Quantity("a", "mm", "Arm", gt=0)]
    place: Annotated[float, Quantity("φ_p", "deg", "Place", gt=0)]
    n_points: Annotated[int, POINTS] = 36


ROUGH: dict[str, tuple[str, Any]] = {
    "an angle that wraps": ("deg", lambda angle, place: np.arctan2(np.sin(angle - place), -np.cos(angle - place))),
    "an angle of a tangent": ("deg", lambda angle, place: np.arctan(1 / np.tan(angle - place))),
    "a simple pole": ("mm", lambda arm, angle, place: arm / as_number(angle - place)),
    "a pole of one sign": ("mm", lambda arm, angle, place: arm / np.abs(as_number(angle - place))),
    "a double pole": ("mm", lambda arm, angle, place: arm / np.sin((angle - place) / 2) ** 2),
    "a tangent": ("mm", lambda arm, angle, place: arm * np.tan((angle - place) / 2 + np.pi / 2)),
    "a logarithm": ("mm", lambda arm, angle, place: -arm * np.log(np.abs(np.sin((angle - place) / 2)))),
    "a logarithm beside much": (
        "mm",
        lambda arm, angle, place: 10 * arm * np.cos(angle) + arm * np.log(np.abs(np.sin((angle - place) / 2))),
    ),
    "a slow pole": ("mm", lambda arm, angle, place: arm / np.abs(as_number(angle - place)) ** 0.1),
}
SMOOTH: dict[str, tuple[str, Any]] = {
    "steep": ("mm", lambda arm, angle, place: arm * np.tanh(1e4 * as_number(angle - place))),
    "narrow": ("mm", lambda arm, angle, place: arm / (1e-6 + as_number(angle - place) ** 2)),
    "a narrow step": ("mm", lambda arm, angle, place: arm * np.arctan(1e6 * as_number(angle - place))),
    "a narrow turn": ("mm", lambda arm, angle, place: arm / np.sqrt(1e-10 + as_number(angle - place) ** 2) ** 0.1),
    "a corner": ("mm", lambda arm, angle, place: arm * np.abs(as_number(angle - place))),
    "upright": ("mm", lambda arm, angle, place: arm * np.sqrt(np.abs(as_number(angle - place)))),
    "nearly upright": ("mm", lambda arm, angle, place: arm * np.abs(as_number(angle - place)) ** 0.1),
    "a logarithm with an end": ("mm", lambda arm, angle, place: arm * np.log(1e-10 + as_number(angle - place) ** 2)),
    "rounding": ("mm", lambda arm, angle: (arm * np.sin(angle) + 1000 * arm) - 1000 * arm - arm * np.sin(angle)),
    "a share of rounding": ("1", lambda arm, angle: (arm + arm * np.cos(angle) ** 2 - 2 * arm + arm * np.sin(angle) ** 2) / arm),
    "a number": ("mm", lambda arm, angle: arm + 0 * as_number(angle)),
    "nothing": ("mm", lambda arm, angle: 0 * arm * as_number(angle)),
}  # fmt: skip


def calculated(unit: str, formula: Any, place: float, *, breakpoint: bool = False) -> Calculation:
    chapter = Chapter("Turn")
    chapter.abscissa("angle", "φ", "deg", "Angle", 2 * np.pi)
    if breakpoint:
        chapter.breakpoints("there", "angle", "place")
    chapter.value("rough", "R", unit, "Rough", formula)
    mechanism = Mechanism(kind="arm", version="1", title="Arm", summary="", inputs=Arm, chapters=(chapter,))
    return calculate(mechanism, {"arm": 0.05, "place": place, "n_points": 36})


@pytest.mark.parametrize("name", ROUGH)
@pytest.mark.parametrize("place", [2.0, np.pi, 0.1, 6.2])
def test_a_rough_place_is_refused_with_its_place(name: str, place: float) -> None:
    with pytest.raises(Unproven) as caught:
        curves(calculated(*ROUGH[name], place))
    told = str(caught.value)
    assert re.match(
        r"Rough \(rough, test_rough_places.py:\d+\) (jumps inside a|jumps or has a pole inside a|has a pole at)", told
    )
    found = float(told.partition("φ = ")[2].partition("°")[0])
    assert np.tan(np.radians(found)) == pytest.approx(
        np.tan(place), abs=0.01
    )  # half a turn farther on the tangent is the same
    assert ("declare that place among the breakpoints of angle" in told) == ("has a pole at" not in told)
    assert "require what keeps away from it" in told


@pytest.mark.parametrize("name", SMOOTH)
@pytest.mark.parametrize("place", [2.0, np.pi, 0.1, 6.2])
def test_what_is_whole_passes(name: str, place: float) -> None:
    curves(calculated(*SMOOTH[name], place))


def test_a_pole_of_what_is_not_printed_is_refused_where_its_extreme_is_asked() -> None:
    chapter = Chapter("Turn")
    chapter.abscissa("angle", "φ", "deg", "Angle", 2 * np.pi)
    chapter.value("rough", "R", "mm", "Rough", ROUGH["a pole of one sign"][1], output=False)
    mechanism = Mechanism(kind="arm", version="1", title="Arm", summary="", inputs=Arm, chapters=(chapter,))
    given = {"arm": 0.05, "place": 2.0, "n_points": 36}
    curves(calculate(mechanism, given))  # it may be masked by what takes it
    chapter.reduction("most", "R_m", "mm", "Most", "max", of="rough")
    asked = Mechanism(kind="arm", version="1", title="Arm", summary="", inputs=Arm, chapters=(chapter,))
    with pytest.raises(Unproven, match="pole"):
        curves(calculate(asked, given))


ENDLESS: dict[str, tuple[str, Any]] = {
    "a tangent whose pole is a place of the grid": ("max", lambda arm, angle: -arm * np.tan(angle)),
    "a secant on its high side": ("min", lambda arm, angle, place: arm / np.cos(angle - place)),
    "a pole of a hundredth": ("abs_max", lambda arm, angle, place: arm * (1 + 0.01 / np.cos(angle - place))),
    "a pole of a ten-thousandth": ("max", lambda arm, angle, place: arm * (np.sin(angle) + 1e-4 / np.cos(angle - place))),
    "a pole that touches": ("max", lambda arm, angle, place: arm * (1 + 0.001 / (1 - np.cos(angle - place)))),
    "a logarithm": ("max", lambda arm, angle, place: -arm * np.log(np.abs(np.sin((angle - place) / 2)))),
    "a slow pole": ("max", lambda arm, angle, place: arm / np.abs(as_number(angle - place)) ** 0.1),
    "an eighth root": ("max", lambda arm, angle, place: arm / np.abs(np.sin((angle - place) / 2)) ** (1 / 8)),
    "a power that is given": ("max", lambda arm, angle, place: arm * np.abs(np.sin((angle - place) / 2)) ** (-arm / arm)),
    "the end of the turn": ("max", lambda arm, angle: arm / np.cos(angle / 4)),
    "both ends": ("max", lambda arm, angle: arm * np.tan((angle - np.pi) / 2)),
    "a power": ("max", lambda arm, angle, place: arm * np.cos(angle - place) ** -2),
}  # fmt: skip
WHOLE: dict[str, tuple[str, Any]] = {
    "a hole that is filled": ("max", lambda arm, angle, place: arm * np.sin(2 * (angle - place)) / np.sin(angle - place)),
    "a double hole": ("max", lambda arm, angle, place: arm * (1 - np.cos(angle - place)) / np.tan((angle - place) / 2) ** 2),
    "a wrap that the sine undoes": ("max", lambda arm, angle, place: arm * np.sin(np.arctan2(np.sin(angle - place), -np.cos(angle - place)))),
    "an upright turn": ("max", lambda arm, angle, place: arm * as_number(angle - place) / np.abs(as_number(angle - place)) ** 0.9),
    "a logarithm that is drowned": ("max", lambda arm, angle, place: arm * np.sin((angle - place) / 2) * np.log(np.abs(np.sin((angle - place) / 2)))),
    "a turn beside the end": (
        "max",
        lambda arm, angle: arm * (7 + 30 * as_number(angle - 0.00345) ** 2 + 0 * as_number(np.arctan2(np.sin(angle), 2 + np.cos(angle)))),
    ),
    "a narrow peak": ("max", lambda arm, angle, place: arm / (1e-10 + as_number(angle - place) ** 2)),
    "near a pole": ("max", lambda arm, angle, place: arm / (1.0001 - np.cos(angle - place))),
}  # fmt: skip


def reduced(reduction: str, formula: Any, places: list[float], *, breakpoint: bool = False) -> Calculation:
    chapter = Chapter("Turn")
    chapter.abscissa("angle", "φ", "deg", "Angle", 2 * np.pi)
    if breakpoint:
        chapter.breakpoints("there", "angle", "place")
    chapter.value("rough", "R", "mm", "Rough", formula)
    chapter.reduction("most", "R_m", "mm", "Most", reduction, of="rough")
    mechanism = Mechanism(kind="arm", version="1", title="Arm", summary="", inputs=Arm, chapters=(chapter,))
    given = {"arm": 0.05, "place": np.array(places) if len(places) > 1 else places[0], "n_points": 36}
    return calculate(mechanism, given, len(places))


PLACES = [1e-5, 0.3, 0.7853981633974483, 1.0, 2.2, np.pi, 4.014, 5.9]


@pytest.mark.parametrize("name", ENDLESS)
def test_an_extreme_of_what_has_a_pole_is_refused_of_one_machine_and_of_many(name: str) -> None:
    for place in PLACES:
        with pytest.raises(Unproven, match=r"has a pole at φ = |near φ = .*pole"):
            reduced(*ENDLESS[name], [place])
    assert sorted(reduced(*ENDLESS[name], PLACES).flaws) == list(range(len(PLACES)))


@pytest.mark.parametrize("name", WHOLE)
def test_what_is_divided_by_nothing_and_stays_finite_passes(name: str) -> None:
    assert not reduced(*WHOLE[name], PLACES).flaws
    for place in PLACES:
        assert np.isfinite(reduced(*WHOLE[name], [place])["most"]).all()


@pytest.mark.parametrize("place", PLACES)
def test_a_breakpoint_at_a_pole_is_no_remedy(place: float) -> None:
    for name in ("a simple pole", "a pole of one sign", "a slow pole"):
        with pytest.raises(Unproven, match=r"has a pole at φ = .*; require what keeps away from it"):
            reduced("max", ROUGH[name][1], [place], breakpoint=True)


def test_of_many_machines_those_whose_curve_has_no_value_somewhere_are_in_error() -> None:
    """The root of what is negative where the crank is longer than the rod."""
    push = lambda arm, angle, place: arm * np.sqrt(1 - (place / np.pi * np.sin(angle)) ** 2)  # noqa: E731
    made = reduced("max", push, [1.0, 4.0, 3.0])
    assert list(made.flaws) == [1] and "has no value at some of its places" in made.flaws[1][1]
    with pytest.raises(Unproven, match="has no value at some of its places"):
        curves(reduced("max", push, [4.0]))


def test_what_is_not_proved_tells_where_the_curve_bends() -> None:
    chapter = Chapter("Turn")
    chapter.abscissa("angle", "φ", "deg", "Angle", 2 * np.pi)
    chapter.value("rough", "R", "mm", "Rough", SMOOTH["a corner"][1])
    chapter.derivative("slope", "R′", "mm", "Slope", of="rough")
    mechanism = Mechanism(kind="arm", version="1", title="Arm", summary="", inputs=Arm, chapters=(chapter,))
    with pytest.raises(
        Unproven,
        match=r"Slope: the proof leaves .*; Rough \(rough, .*\) bends most near φ = 114\.6°: if it has a corner",
    ):
        calculate(mechanism, {"arm": 0.05, "place": 2.0, "n_points": 36})


def test_an_angle_that_wraps_at_a_breakpoint_passes() -> None:
    curves(calculated(*ROUGH["an angle that wraps"], 2.0, breakpoint=True))
