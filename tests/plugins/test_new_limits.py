"""Limits of forces, accelerations and play: without them a check says so, with them the absurd fails, and what is told is enough."""

from __future__ import annotations

import re
from typing import Any

import pytest

from diecut_report.machine.calculation import Calculation
from diecut_report.results.checks import check_results
from diecut_report.results.mechanism_record import CheckRecord
from tests.machines import drive, number
from tests.plugins.test_geneva_transport import geneva

JOINTS = {"crank_length": "5 mm", "allowable_joint_force": 40}
TEETH = {"pinion_radius": "5 mm", "allowable_tooth_force": 6}
JERKY = {"crank_speed": "300 rpm", "allowable_acceleration": 15}


def check(calc: Calculation, name: str) -> CheckRecord:
    return {found.id: found for found in check_results(calc)}[name]


def test_a_crank_of_five_millimetres_says_what_its_joints_bear_and_that_nobody_limits_it() -> None:
    calc = drive(crank_length="5 mm")
    found = check(calc, "joint_force")
    assert (found.status, found.missing) == ("not_checked", ["allowable_joint_force"])
    assert found.demand == pytest.approx(number(calc, "joint_force_max")) and found.demand > 100e3


@pytest.mark.parametrize(
    ("name", "given", "key", "unit"),
    [("joint_force", JOINTS, "crank_length", "mm"), ("tooth_force", TEETH, "pinion_radius", "mm"), ("acceleration", JERKY, "crank_speed", "r/min")],
)  # fmt: skip
def test_a_drive_beyond_its_limit_is_told_a_size_that_keeps_it(
    name: str, given: dict[str, Any], key: str, unit: str
) -> None:
    message = check(drive(**given), name).message
    told = re.search(rf"{key} to at (?:least|most) ([\d.]+) {unit}", message)
    assert told and check(drive(**given), name).status == "fail"
    fixed = check(drive(**given | {key: f"{told[1]} {unit}"}), name)
    assert fixed.status == "pass" and fixed.utilisation == pytest.approx(1, abs=2e-3)


def test_play_beyond_the_register_is_told_the_clearance_that_keeps_it() -> None:
    sheet = {"sprocket_teeth": 24, "chain_pitch": "31.75 mm", "gear_ratio": 4, "allowable_sheet_play": "0.05 mm",
             "cover_angle": "20 deg"}  # fmt: skip
    found = check(geneva(**sheet), "sheet_play")
    told = re.search(r"locking_clearance to at most ([\d.]+ \w+)", found.message)
    assert found.status == "fail" and told
    kept = check(geneva(**sheet, locking_clearance=told[1]), "sheet_play")
    assert kept.status == "pass" and kept.utilisation == pytest.approx(1, abs=1e-3)
    del sheet["allowable_sheet_play"], sheet["cover_angle"]
    assert check(geneva(**sheet), "sheet_play").missing == ["cover_angle", "allowable_sheet_play"]
