"""Drawings as they move on a screen: rigid links, contact that stays, and agreement with the mechanism's curves by another way."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from math import pi
from typing import Any

import numpy as np
import pytest

from diecut_report.config.plugins import Discovery
from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation
from diecut_report.mechanism.figures import Drawing
from diecut_report.results.figure_views import FRAMES
from tests.machines import drive, number
from tests.plugins.followers import follower, integrated, law_stretches
from tests.plugins.knives import knife as circular_knife
from tests.plugins.moving import MovingDrawing, complex_points, lengths
from tests.plugins.platens import platen
from tests.plugins.steppers import CAMS, stepper
from tests.plugins.test_elastic_follower import SLIDE
from tests.plugins.test_geneva_transport import geneva
from tests.plugins.test_knife_drive import INNER, OUTER, PLANETARY, SLIDER
from tests.plugins.test_knife_drive import knife as folding_knife

FULL_DRIVE: dict[str, Any] = {"crank_length": "150 mm", "pinion_radius": "60 mm"}
MACHINES: dict[str, tuple[Callable[[], Calculation], str]] = {
    "drive": (lambda: drive(**FULL_DRIVE), "linkage"),
    "stepper": (stepper, "rolling"),
    "cam 1": (lambda: stepper(**CAMS), "cam_1"),
    "cam 2": (lambda: stepper(**CAMS), "cam_2"),
    "geneva": (geneva, "entry"),
    "knife": (circular_knife, "positions"),
    "platen": (platen, "machine"),
    "planetary": (lambda: folding_knife(**PLANETARY), "planetary_drive"),
    "slider": (lambda: folding_knife(**SLIDER), "crank_slider_drive"),
    "rocker outer": (lambda: folding_knife(**OUTER), "crank_rocker_drive"),
    "rocker inner": (lambda: folding_knife(**INNER), "crank_rocker_drive"),
    "turning link": (follower, "turning_link"),
    "sliding link": (lambda: follower(**SLIDE), "sliding_link"),
}
STILL_AT: dict[str, Callable[[Calculation], float]] = {
    "drive": lambda calc: number(calc, "crank_torque_peak_at"), "stepper": lambda calc: 0.0,
    "cam 1": lambda calc: number(calc, "dwell_angle") / 2, "cam 2": lambda calc: number(calc, "dwell_angle") / 2,
    "geneva": lambda calc: number(calc, "entry_angle"), "knife": lambda calc: number(calc, "angle_start"), "platen": lambda calc: 5 * pi / 3,
    "planetary": lambda calc: 3 * pi / 2, "slider": lambda calc: 0.0,
    "turning link": lambda calc: number(calc, "acceleration_peak_at"), "sliding link": lambda calc: number(calc, "acceleration_peak_at"),
    "rocker outer": lambda calc: number(calc, "crank_rocker_lowest_angle"), "rocker inner": lambda calc: number(calc, "crank_rocker_lowest_angle"),
}  # fmt: skip
MOVES = {"geneva": ("body", 6 * 60)}  # which shape of the still drawing must be found, where it is not the link


@cache
def moving(name: str) -> MovingDrawing:
    """One of the drawings above."""
    made, drawing = MACHINES[name]
    return MovingDrawing(made(), drawing)


def test_each_drawing_that_moves_is_tried_here() -> None:
    found = Discovery([])
    figures = [each for kind in found.origins for each in found.mechanism(kind).figures]
    declared = {each.id for each in figures if isinstance(each, Drawing) and each.moving}
    assert declared == {drawing for _, drawing in MACHINES.values()} | {
        "cyclogram"
    }  # which has rows, and a test of its own


@pytest.mark.parametrize("name", MACHINES)
def test_what_moves_lies_at_its_angle_where_the_still_drawing_has_it(name: str) -> None:
    drawn = moving(name)
    role = "body" if name in ("geneva", "stepper", "knife") else "link"
    still = [shape["points"] for shape in drawn.still() if shape["shape"] == "polyline" and shape["role"] == role]
    now = next(shape["points"] for shape in drawn.at(STILL_AT[name](drawn.calc)) if shape.get("role") == role)
    ends = np.array(now)
    near = [np.abs(np.array(each) - ends).max() for each in still if len(each) == len(ends)]
    if name == "geneva":  # the wheel comes one step on: the same outline
        near.append(_same_outline(np.array(still[0]), ends))
    assert min(near) < 1e-9


def _same_outline(one: Any, other: Any) -> float:
    gaps = np.abs(complex_points(one)[:, None] - complex_points(other)[None, :])
    return float(max(gaps.min(axis=0).max(), gaps.min(axis=1).max()))


@pytest.mark.parametrize("name", [each for each in MACHINES if not each.endswith("link")])  # which move over time, once
def test_a_turn_is_shown_at_even_places_and_ends_where_it_begins(name: str) -> None:
    drawn = moving(name)
    assert np.isin(np.round(np.linspace(0, 2 * pi, FRAMES + 1), 12), np.round(drawn.places, 12)).all()
    assert np.ptp(np.diff(drawn.places)) < 2 * pi / FRAMES + 1e-12
    first, last = (drawn.at(float(drawn.places[end])) for end in (0, -1))
    for one, other in zip(first, last, strict=True):
        if one["shape"] == "polyline":
            assert _same_outline(np.array(one["points"]), np.array(other["points"])) < 1e-9


def test_the_drives_links_keep_their_lengths_and_the_pin_follows_the_cursor() -> None:
    drawn = moving("drive")
    joints, ratios = drawn.links(), [1.0, *(number(drawn.calc, f"{link}_ratio") for link in ("coupler", "rocker"))]
    assert np.allclose(lengths(joints), 0.15 * np.array(ratios), rtol=1e-9)
    assert np.allclose(complex_points(joints[:, 1] - joints[:, 0]), 0.15 * np.exp(1j * drawn.places))


def test_sector_and_pinion_roll_on_each_other_and_the_cylinder_goes_as_its_curve_tells() -> None:
    drawn = moving("drive")
    joints, (_, sector), (_, pinion) = drawn.links(), drawn.pose(0), drawn.pose(1)
    assert np.allclose(
        np.exp(1j * sector),
        complex_points(joints[:, 2] - joints[:, 3]) / abs(complex_points(joints[:, 2] - joints[:, 3])),
    )
    arcs = number(drawn.calc, "sector_radius") * (sector - sector[0]) + 0.06 * (pinion - pinion[0])
    assert np.abs(arcs).max() < 1e-12
    way = drawn.of("circle", "hidden")[:, 0]
    assert np.allclose(way - way[0], drawn.curve("displacement") - drawn.curve("displacement")[0])
    assert np.ptp(way) == pytest.approx(number(drawn.calc, "stroke"), rel=1e-3)


def test_the_gear_and_the_sector_roll_without_slip_and_the_gear_stands_in_the_dwell() -> None:
    """The two bodies' material points in contact have one speed, by differences from place to place."""
    drawn = moving("stepper")
    (pin, sector), (_, gear) = drawn.pose(0), drawn.pose(1)
    calc, step = drawn.calc, np.diff(drawn.places)
    big, small = number(calc, "sector_radius"), number(calc, "gear_radius")
    assert np.allclose(np.abs(complex_points(pin)), big + small)
    of_sector = (big + small) * step - big * np.diff(sector)
    assert np.allclose(small * np.diff(gear), of_sector, atol=1e-12)
    resting = drawn.places <= number(calc, "dwell_angle")
    assert np.ptp(gear[resting]) < 1e-12 and gear[-1] - gear[0] == pytest.approx(2 * pi)


@pytest.mark.parametrize("which", ["1", "2"])
def test_the_roller_stays_on_its_cam(which: str) -> None:
    drawn = moving(f"cam {which}")
    arm, roller = drawn.links(), drawn.of("circle", "mark")
    assert np.ptp(lengths(arm)) < 1e-12 and lengths(arm)[0, 0] == pytest.approx(0.09)
    assert np.allclose(np.abs(complex_points(arm[:, 0])), 0.3)
    fine = np.linspace(0, 2 * pi, 7201)[None, :]
    x, y = (
        drawn.calc.sample(f"cam_{which}_{axis}", fine, drawn.calc.domains["disc_angle"].middle_of(fine))[0]
        for axis in "xy"
    )
    gaps = np.abs(complex_points(roller)[:, None] - (x + 1j * y)[None, :]).min(axis=1)
    assert np.allclose(gaps, 0.025, atol=2e-6), "the roller touches the profile, and cuts it nowhere"


def test_the_genevas_roller_runs_in_a_slot_and_in_the_dwell_the_disc_holds_the_wheel() -> None:
    drawn = moving("geneva")
    (axis, wheel), (_, crank) = drawn.pose(0), drawn.pose(1)
    calc, step = drawn.calc, number(drawn.calc, "step_angle")
    roller = number(calc, "crank_radius") * np.exp(1j * crank)
    in_wheel = (roller - complex_points(axis)) * np.exp(-1j * wheel)
    half, turn = number(calc, "engagement_half_angle"), np.mod(drawn.places + pi, 2 * pi) - pi
    slots = np.exp(1j * step * np.arange(6))
    off = np.abs((in_wheel[:, None] / slots[None, :]).imag) + np.where(
        (in_wheel[:, None] / slots[None, :]).real > 0, 0, 1
    )
    engaged = np.abs(turn) <= half + 1e-12
    assert off[engaged].min(axis=1).max() < 1e-9
    arcs = (number(calc, "center_distance") * np.exp(1j * step * (np.arange(6) + 0.5)))[None, :]
    held = np.abs(complex_points(axis)[:, None] + np.exp(1j * wheel)[:, None] * arcs).min(axis=1)
    assert held[~engaged].max() < 1e-9, "the centre of a locking arc lies on the crank's axis"
    assert abs(wheel[-1] - wheel[0]) == pytest.approx(step)


def test_the_knifes_edge_goes_through_the_cutting_point_and_the_blade_stays_as_it_is() -> None:
    drawn = moving("knife")
    (_, turned), cut = drawn.pose(0), drawn.of("point", "mark")
    calc = drawn.calc
    center = number(calc, "eccentricity") * np.exp(1j * turned)
    from_middle = np.mod(drawn.places - number(calc, "middle_angle") + pi, 2 * pi) - pi
    cutting = np.abs(from_middle) < number(calc, "cut_angle") / 2 - 1e-12
    assert np.abs(from_middle[cutting]).max() == pytest.approx(number(calc, "cut_angle") / 2), (
        "up to the very end of the cut"
    )
    assert cutting.sum() >= 4
    assert np.allclose(np.abs(complex_points(cut) - center)[cutting], number(calc, "edge_radius"))
    assert np.allclose(cut[:, 1], -number(calc, "depth"))
    assert np.allclose(
        np.abs(complex_points(drawn.own(0)[1:]) - number(calc, "eccentricity")), number(calc, "edge_radius")
    )


def test_the_platens_rods_are_as_long_as_they_are_but_where_they_stretch() -> None:
    drawn = moving("platen")
    calc, rods = drawn.calc, lengths(drawn.links())[:, 1]
    free = (drawn.places >= number(calc, "dwell_end_angle")) & (
        drawn.places <= 2 * pi - number(calc, "cutting_start_angle")
    )
    assert np.allclose(rods[free], number(calc, "rod_length"))
    stretch = rods - number(calc, "rod_length")
    assert stretch.min() > -1e-12
    assert stretch.max() == pytest.approx(number(calc, "drive_deformation"), rel=1e-6)
    assert np.allclose(
        drawn.links()[:, 2, 0] - drawn.links()[0, 2, 0],
        drawn.curve("platen_displacement_true") - number(calc, "drive_deformation"),
    )


@pytest.mark.parametrize(("name", "key", "expected"), [
    ("planetary", "planetary", [0.065656, 0.065656]), ("slider", "crank_slider", [0.035, 0.14, None]),
    ("rocker outer", "crank_rocker", [0.02, 0.11, 0.08, 0.107]), ("rocker inner", "crank_rocker", [0.02, 0.11, 0.08, 0.107]),
])  # fmt: skip
def test_the_folding_knifes_links_keep_their_lengths_and_its_edge_follows_the_curve(
    name: str, key: str, expected: list[float | None]
) -> None:
    drawn = moving(name)
    found = lengths(drawn.links())
    for link, length in enumerate(expected):
        assert np.ptp(found[:, link]) < 1e-9 and (length is None or found[0, link] == pytest.approx(length))
    edge, heights = complex_points(drawn.links()[:, -1]), drawn.curve(f"{key}_displacement")
    if key == "crank_rocker":  # the height is that along the arc about the rocker's pivot
        swung = np.unwrap(np.angle(edge)) * (1 if name.endswith("outer") else -1)
        assert np.allclose(0.107 * (swung - swung[0]), heights - heights[0])
    else:
        assert np.allclose(edge.imag - edge[0].imag, heights - heights[0]) and np.allclose(edge.real, 0)


def test_the_planet_rolls_inside_its_ring() -> None:
    drawn = moving("planetary")
    planet = drawn.of("circle", "hidden")
    assert np.allclose(np.abs(complex_points(planet)) + planet[:, 2], 2 * 0.065656)


def _integrated(calc: Calculation, places: Array) -> tuple[Array, Array]:
    """Input and deflection of the cycloidal rise at the places, by scipy's integration of the link's equation of motion."""
    omega, damping = np.sqrt(5200 / 0.8), 0.05
    parts = integrated(law_stretches("cycloidal", 1.2, 0.2), number(calc, "duration") - 0.2, omega, damping, fine=60)
    time = np.concatenate([part.time for part in parts])
    states = np.concatenate([part.states for part in parts], axis=1)
    return np.interp(places, time, states[0]), np.interp(places, time, states[2])


def test_the_turning_link_stands_off_its_input_by_the_integrated_deflection_as_many_times_as_is_written() -> None:
    drawn = moving("turning link")
    driver, deflection = _integrated(drawn.calc, drawn.places)
    arm, link = (complex_points(drawn.links(number))[:, 1] for number in (0, 1))
    assert np.abs(arm - 0.45 * np.exp(1j * driver)).max() < 1e-3
    times = _written(drawn)
    assert times * np.abs(deflection).max() > 0.1  # so much that it is seen
    assert np.abs(np.angle(link / arm) - times * deflection).max() < 1e-3 * times


def test_the_spring_of_the_sliding_link_is_as_long_as_the_integrated_deflection_makes_it() -> None:
    drawn = moving("sliding link")
    driver, deflection = _integrated(drawn.calc, drawn.places)
    ends = drawn.links()[:, [0, -1], 0]
    at_rest = ends[0, 1] - ends[0, 0]
    assert np.abs(ends[:, 0] - ends[0, 0] - driver).max() < 1e-3
    assert np.abs(ends[:, 1] - ends[:, 0] - at_rest - _written(drawn) * deflection).max() < 1e-2


def _written(drawn: MovingDrawing) -> int:
    """How many times greater the still drawing says that the deflection is drawn."""
    [text] = (shape["text"] for shape in drawn.still() if "×" in shape.get("text", ""))
    return int(text.split()[-1])
