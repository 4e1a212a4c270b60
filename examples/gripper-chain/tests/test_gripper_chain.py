"""Numbers of the gripper chain, each by another way than its formula: link by link, point by point, by energy."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from gripper_chain import MECHANISM

from diecut_report.testing import MechanismFound, Refused, calculate, check_mechanism, compare

GRAVITY = 9.80665
PRESS = {"productivity": "6000 1/h", "sheet": {"length": "700 mm", "width": "1000 mm"}}
KEYS = {
    "chain": "12B",
    "teeth": 20,
    "links": 240,
    "bar_links": 48,
    "centre_distance": "2093 mm",
    "elongation": "0.02 %",
    "bar_mass": "4.5 kg",
    "grammage": "350 g/m**2",
    "stations": [
        {"name": "cutting", "position": "1750 mm", "drag": "4 N"},
        {"name": "stripping", "position": "1150 mm", "drag": "12 N"},
        {"name": "delivery", "position": "400 mm", "drag": "8 N"},
    ],
    "grippers": 9,
    "grip_force": "30 N",
    "cam": {"before": "60 mm", "after": "90 mm", "opening": "12 mm"},
    "allowable_shift": "0.6 mm",
    "n_points": 2000,
}


def chain(**changes: Any) -> MechanismFound:
    """The example with other inputs."""
    return calculate(MECHANISM, KEYS | changes, press=PRESS)


FOUND = chain()


def number(name: str) -> float:
    return float(FOUND[name])


def test_the_declaration() -> None:
    check_mechanism(MECHANISM)


def test_the_numbers_of_a_sheet_of_paper() -> None:
    """One spacing of 48 links of 19.05 mm in 0.6 s; 20 teeth a turn; 9 grippers that hold on two faces."""
    by_hand = compare(
        FOUND,
        {
            "chain_speed": "1.524 m/s",
            "sprocket_speed": "240 rpm",
            "bar_count": "5",
            "sheet_mass": "245 g",
            "grip_total": "108 N",
        },
    )
    assert by_hand.agree, str(by_hand)


def test_the_strand_follows_the_corners_of_the_polygon() -> None:
    """The corner that pulls is followed through a tooth, turned as a complex number; its way along the strand is differenced."""
    angle = np.array(FOUND.curves["sprocket_angle"].values)
    corner = 0.01905 / abs(np.exp(2j * np.pi / 20) - 1)  # a side of the polygon is a pitch
    turned = corner * np.exp(1j * (np.pi / 2 + np.pi / 20 - angle))
    time = angle / (2 * np.pi * 4)  # at 240 turns a minute
    velocity = np.gradient(turned.real, time, edge_order=2)
    assert FOUND.curves["velocity"].values == pytest.approx(velocity, rel=1e-6)
    acceleration = np.gradient(np.array(FOUND.curves["velocity"].values), time, edge_order=2)
    assert FOUND.curves["acceleration"].values == pytest.approx(acceleration, abs=1e-4)
    assert number("acceleration_max") == pytest.approx((2 * np.pi * 4) ** 2 * 0.01905 / 2, rel=1e-9)


def test_the_speed_varies_as_shigley_has_it() -> None:
    variation = np.pi / 20 * (1 / np.sin(np.pi / 20) - 1 / np.tan(np.pi / 20))
    assert (number("velocity_max") - number("velocity_min")) / number("chain_speed") == pytest.approx(
        variation, rel=1e-9
    )


@pytest.mark.parametrize("centre", [2095.5, 2093, 2000, 1850])
def test_the_slack_strand_hangs_as_its_links_do(centre: float) -> None:
    """From the lowest point on each short link points where the weight below it and the horizontal pull do: no cosh, no sinh."""
    stations = [{"name": "only", "position": "400 mm"}]
    found = chain(centre_distance=f"{centre} mm", stations=stations)
    pull = float(found["line_mass"]) * GRAVITY * float(found["catenary"])
    links = 200_000
    link = float(found["slack_length"]) / 2 / links
    weights = float(found["line_mass"]) * GRAVITY * link * (np.arange(links) + 0.5)
    slope = np.arctan2(weights, pull)
    assert 2 * link * np.cos(slope).sum() == pytest.approx(centre / 1000, rel=1e-9)
    assert link * np.sin(slope).sum() == pytest.approx(float(found["sag"]), rel=1e-7)
    assert np.hypot(pull, weights[-1]) == pytest.approx(float(found["slack_tension"]), rel=1e-5)


def test_the_parabola_lacks_a_sixth_of_the_sag() -> None:
    lacking = number("line_mass") * GRAVITY * number("catenary") - number("parabola_tension")
    assert lacking == pytest.approx(number("line_mass") * GRAVITY * number("sag") / 6, rel=0.01)


def test_the_torque_does_the_work_of_pull_and_motion() -> None:
    """Power of the shaft less that of the useful pull is what the kinetic energy of both strands gains."""
    angle, velocity = (np.array(FOUND.curves[name].values) for name in ("sprocket_angle", "velocity"))
    energy = 2 * number("strand_mass") * velocity**2 / 2
    speed = 2 * np.pi * 4
    gained = np.gradient(energy, angle / speed, edge_order=2)
    shaft = np.array(FOUND.curves["torque"].values) * speed
    assert shaft - 2 * number("useful_tension") * velocity == pytest.approx(gained, abs=1e-3 * np.abs(shaft).max())
    assert number("power") == pytest.approx(number("torque_work") * speed / (2 * np.pi / 20), rel=1e-9)


def test_the_pull_grows_from_station_to_station() -> None:
    rails, slack = number("rail_drag"), number("slack_tension") + number("centrifugal_tension")
    places, drags = (1.75, 1.15, 0.4), (4, 12, 8)
    expected = [slack + sum(drags[: i + 1]) / 2 + rails * (2.093 - place) / 2.093 for i, place in enumerate(places)]
    assert FOUND.row("strand_pull", "N") == pytest.approx(expected)


def test_the_grippers_are_open_over_the_cam() -> None:
    angle, opening = (np.array(FOUND.curves[name].values) for name in ("main_angle", "gripper_opening"))
    way = np.where(angle > np.pi, angle - 2 * np.pi, angle) / (2 * np.pi) * 0.9144  # beyond the pick-up point
    assert np.array_equal(opening > 1e-9, (way > -0.06 + 1e-9) & (way < 0.09 - 1e-9))
    assert opening.max() == pytest.approx(0.012, rel=1e-4) and way[np.argmax(opening)] == pytest.approx(0.015, abs=1e-3)
    ((start, end),) = FOUND.phases["picking"].intervals
    assert (end - start) / (2 * np.pi) * 600 == pytest.approx(FOUND["opening_time"].to("ms"))


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"links": 241}, "links: is 241, not a multiple of bar_links = 48.* take 288"),
        ({"links": 192}, "links: is 192, .* take at least 240 links"),
        ({"links": 384}, "links: is 384, .* hang down by more than a third"),
        ({"stations": KEYS["stations"][::-1]}, r"stations.0.position: .* station 1, and station 2 is not nearer"),
        (
            {"centre_distance": "2.2 m", "links": 288, "stations": [{"name": "far", "position": "2.3 m"}]},
            "hang down|station 1 beyond",
        ),
        (
            {"cam": {"before": "900 mm", "after": "90 mm", "opening": "12 mm"}},
            "cam.before: is 900 mm, with 90 mm behind",
        ),
    ],
)
def test_what_cannot_be_is_refused_in_words(changes: dict[str, Any], words: str) -> None:
    with pytest.raises(Refused, match=words):
        chain(**changes)


def test_the_advice_for_the_grip_is_enough() -> None:
    failing = chain(grip_force="2 N").checks["grip"]
    assert failing.status == "fail"
    advised = failing.message.partition("set grip_force to at least ")[2].partition(",")[0]
    assert chain(grip_force=advised).checks["grip"].status == "pass"


def test_wear_brings_the_first_station_out_of_register() -> None:
    allowed = FOUND["elongation_allowed"].to("%")
    assert chain(elongation=f"{0.999 * allowed} %").checks["shift_cutting"].status == "pass"
    assert chain(elongation=f"{1.001 * allowed} %").checks["shift_cutting"].status == "fail"
