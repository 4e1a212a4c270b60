"""Presses that nobody may build: each is the mended press with one thing made absurd, and fails for it, or says what is not checked."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import yaml

from tests.examples import few
from tests.test_mending import MENDED, calculated, verdicts

PINS = ("crank_pin", "rocker_pin")
BORED = {f"mechanisms.bearings.bearings.{i}.designation": None for i in (2, 3)}  # which thin pins would contradict
ABSURD: list[tuple[str, dict[str, Any], str, set[str]]] = [
    ("a sheet longer than the step", {"press.sheet.width": "750 mm"}, "fail", {"consistency.step", "consistency.sheet_gap"}),
    ("a cylinder shorter than the sheet", {"mechanisms.cylinder.generatrix_length": "400 mm"}, "fail", {"consistency.format_generatrix"}),
    ("a crank of 5 mm", {"mechanisms.drive.crank_length": "5 mm"}, "fail",
     {"drive.joint_force", "crankshaft.fatigue", *(f"{pin}.yield" for pin in PINS), "bearings.main_b_static"}),
    ("pins of 5 mm", {f"mechanisms.{pin}.sections.0.diameter": "5 mm" for pin in PINS} | BORED, "fail",
     {f"{pin}.{check}" for pin in PINS for check in ("fatigue", "yield")}),
    ("no limit of sheet and roller",
     {f"mechanisms.cross.{key}": None for key in ("allowable_contact_pressure", "allowable_sheet_acceleration", "gripper_force")},
     "not_checked", {"cross.contact_pressure", "cross.sheet_acceleration", "cross.grippers"}),
]  # fmt: skip


def made_absurd(changes: dict[str, Any]) -> dict[str, Any]:
    """The mended press with values at paths; None takes a key away."""
    data: dict[str, Any] = yaml.safe_load(MENDED.read_text(encoding="utf-8"))
    for path, value in changes.items():
        *parents, key = path.split(".")
        place: Any = data
        for parent in parents:
            place = place[int(parent)] if parent.isdigit() else place[parent]
        if value is None:
            del place[key]
        else:
            place[key] = value
    return data


@pytest.mark.parametrize(
    ("changes", "status", "checks"),
    few([case[1:] for case in ABSURD], keep=lambda case: case[1] == "not_checked"),
)
def test_a_press_that_nobody_may_build_does_not_pass(
    tmp_path: Path, changes: dict[str, Any], status: str, checks: set[str]
) -> None:
    assert checks <= verdicts(calculated(tmp_path, made_absurd(changes))).get(status, set())
