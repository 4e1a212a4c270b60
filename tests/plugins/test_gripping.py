"""The hold of the grippers on the sheet, of both conveyors: mass times acceleration, and advice that lies at the limit."""

from __future__ import annotations

import re
from typing import Any

import pytest

from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.plugins.cam_gear_transport import MECHANISM as STEPPER
from diecut_report.plugins.geneva_transport import MECHANISM as GENEVA
from diecut_report.results.mechanism import mechanism_results
from diecut_report.results.mechanism_record import CheckRecord
from tests.machines import inputs, number

CHAIN = {"sprocket_teeth": 30, "chain_pitch": "19.05 mm"}
SHEET = {"grammage": "450 g/m**2", "sheet_length": "700 mm", "sheet_width": "470 mm", "gripper_force": "5 N"}
MACHINES = {
    "crank_speed": (GENEVA, CHAIN | {"center_distance": "240 mm", "roller_radius": "16 mm", "gear_ratio": 6, "crank_speed": "100 rpm"}),
    "cycles_per_hour": (STEPPER, CHAIN | {"dwell_angle": "160 deg", "sector_dwell_sweep": "60 deg", "sector_stop_sweep": "20 deg",
                                          "center_distance": "300 mm", "cycles_per_hour": "6000 1/h"}),
}  # fmt: skip


def gripped(mechanism: Mechanism, keys: dict[str, Any]) -> CheckRecord:
    """The check of the grippers."""
    checks = mechanism_results(calculate(mechanism, inputs(mechanism, keys)), {}).checks
    return next(check for check in checks if check.id == "grippers")


@pytest.mark.parametrize("rate", MACHINES)
def test_the_grippers_hold_the_sheets_inertia(rate: str) -> None:
    mechanism, keys = MACHINES[rate]
    calc = calculate(mechanism, inputs(mechanism, keys | SHEET))
    assert number(calc, "sheet_mass") == pytest.approx(0.450 * 0.7 * 0.47, rel=1e-12)
    assert number(calc, "sheet_force") == pytest.approx(0.14805 * number(calc, "sheet_acceleration_max"), rel=1e-12)


@pytest.mark.parametrize("rate", MACHINES)
def test_the_rate_that_is_advised_is_the_greatest_that_the_grippers_hold(rate: str) -> None:
    mechanism, keys = MACHINES[rate]
    found = gripped(mechanism, keys | SHEET)
    assert found.status == "fail"
    told = re.search(rf"{rate} to at most ([\d.]+) (\S+)[,.]", found.message)
    assert told
    for factor, status in ((1, "pass"), (1.002, "fail")):
        again = {rate: f"{float(told[1]) * factor} {told[2].replace('1/h', '1/h')}"}
        assert gripped(mechanism, keys | SHEET | again).status == status
