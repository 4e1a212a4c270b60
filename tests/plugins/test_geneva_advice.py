"""What the Geneva drive's messages advise is put in as printed: the checks then pass."""

from __future__ import annotations

import re
from typing import Any

import pytest

from diecut_report.machine.calculation import Impossible
from diecut_report.plugins.geneva_transport.advice import arc_that_fits, greatest_overlap, roller_that_fits
from tests.examples import few
from tests.machines import number
from tests.plugins.test_geneva_transport import SHEET, checks, geneva

LAYOUT = ("roller_clearance", "arm_thickness", "locking_reach", "cutout")


def told(message: str) -> dict[str, float]:
    """What a message names, by its key; each alone is to help."""
    return {key: float(value) for key, value in re.findall(r"an? (\w+) of (?:at (?:least|most) )?([\d.]+)", message)}


@pytest.mark.parametrize(
    "changes",
    [{"roller_radius": "51 mm"}, {"locking_radius": "95 mm"}, {"locking_radius": "20 mm"}, {"slots": 12, "roller_radius": "13 mm"},
     *few([{"slots": 18, "roller_radius": "30 mm"}, {"slots": 3, "roller_radius": "25 mm", "locking_radius": "150 mm"},
           {"slots": 8, "roller_radius": "26 mm", "locking_radius": "32 mm"}], keep=lambda _: False)],
)  # fmt: skip
def test_the_named_roller_and_locking_arc_are_sound(changes: dict[str, Any]) -> None:
    found = checks(**changes)
    failing = [found[name] for name in LAYOUT if found[name]["status"] != "pass"]
    assert failing
    for check in failing:
        advised = told(check["message"])
        assert advised
        for key, value in advised.items():
            again = checks(**changes | {key: value})
            assert {again[name]["status"] for name in LAYOUT} == {"pass"}, (key, value)


@pytest.mark.parametrize("allowed", few([800, 1000, 1200, 1500], keep=lambda allowed: allowed in (800, 1500)))
@pytest.mark.parametrize("inertia", few([3, 4, 5.5], keep=lambda inertia: inertia != 4))
def test_the_named_width_keeps_the_contact_pressure(allowed: float, inertia: float) -> None:
    machine = {"driven_inertia": inertia, "roller_width": "4 mm", "allowable_contact_pressure": allowed}
    (width,) = told(checks(**machine)["contact_pressure"]["message"]).values()
    assert checks(**machine | {"roller_width": width})["contact_pressure"]["status"] == "pass"


@pytest.mark.parametrize("allowed", [20, 33, 50, 70])
def test_the_named_speed_keeps_the_sheets_acceleration(allowed: float) -> None:
    machine = SHEET | {"allowable_sheet_acceleration": allowed}
    (speed,) = told(checks(**machine)["sheet_acceleration"]["message"]).values()
    assert checks(**machine | {"crank_speed": speed})["sheet_acceleration"]["status"] == "pass"


def test_more_slots_lower_the_acceleration_also_with_the_same_step() -> None:
    peaks = [
        number(geneva(slots=z, roller_radius=3, **SHEET | {"gear_ratio": 4 * z / 6}), "sheet_acceleration_max")
        for z in range(3, 19)
    ]
    assert sorted(peaks, reverse=True) == peaks


def test_a_locking_radius_beyond_the_roller_is_refused_with_one_that_passes() -> None:
    with pytest.raises(Impossible) as refused:
        geneva(locking_radius="120 mm")
    advised = told(refused.value.message)
    assert "locking_radius" in advised
    again = checks(locking_radius=advised["locking_radius"])
    assert {again[name]["status"] for name in LAYOUT} == {"pass"}


def test_a_clearance_that_leaves_no_disc_is_refused_with_one_that_passes() -> None:
    with pytest.raises(Impossible) as refused:
        geneva(locking_clearance="70 mm")
    room = re.search(r"take at most ([\d.]+) mm", refused.value.message)
    assert room is not None
    assert checks(locking_clearance=float(room[1]))["locking_reach"]["status"] == "pass"


@pytest.mark.parametrize("slots, roller, locking", [(6, 10, 70), (12, 13, 29), (18, 7, 15), (8, 26, 32), (4, 30, 70)])
def test_the_overlap_that_is_tried_is_that_of_the_calculation(slots: int, roller: float, locking: float) -> None:
    calc = geneva(slots=slots, roller_radius=roller, locking_radius=locking)
    tried = greatest_overlap(slots, 0.2, number(calc, "rim_radius"), locking / 1000, number(calc, "disc_radius"))
    assert float(tried[0]) == pytest.approx(number(calc, "cutout_overlap"), rel=2e-3, abs=1e-8)


def test_where_nothing_fits_it_is_said() -> None:
    assert arc_that_fits(6, 0.2, 0.2, 0.01, 0.07) == ""
    assert roller_that_fits(6, 0.2, 0.0, 0.01, 0.11) == "a greater center_distance"
