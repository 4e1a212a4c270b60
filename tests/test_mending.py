"""The published press is mended step by step, as docs/mending-a-press.md tells: after each step the named checks are left, at last none."""

from __future__ import annotations

import re
from collections.abc import Callable
from copy import deepcopy
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

from diecut_report.config.loader import load_config
from diecut_report.errors import UserError
from diecut_report.results.warm_press import WarmPress, WarmRun
from tests.configs import DISCOVERY, EXAMPLES, saved
from tests.examples import few
from tests.machines import number

PUBLISHED, MENDED = (
    next(path for path in EXAMPLES if path.stem == stem)
    for stem in ("flat_cylinder_press", "flat_cylinder_press_mended")
)
GUIDE = Path(__file__).parents[1] / "docs" / "mending-a-press.md"
TIMING = {"timing.interlock_sheet_rests", "consistency.timing"}
CYLINDER = {"cylinder.wall_at_flat", "cylinder.radius", "cylinder.closed_section"}
RATE = {"consistency.actual_rate"}
CLUTCH = {"consistency.clutch_position"}
MOTOR = {"consistency.motor_thermal", "consistency.motor_peak"}
COVER = {"consistency.cover_angle"}
TRUE_RATE = {"consistency.true_rate"}
CARRIAGES = {"consistency.carriages"}
UNFOUNDED = {
    "consistency.clutch_position",
    "sector.k_factors",
    "main_gears.k_factors",
}
ELEMENTS = {
    "crank_key.pressure_hub",
    "crank_key.pressure_key",
    "sector.k_factors",
    "main_gears.k_factors",
    "gripper_chain.slack_side",
    "bearings.rocker_pin_oscillation",
}

# What is taken over from the mended press in each step (keys of mechanisms), and what fails or warns after it
STEPS: dict[str, tuple[tuple[str, ...], set[str]]] = {
    "published": ((), TIMING | CYLINDER | RATE | CLUTCH | ELEMENTS | CARRIAGES),
    "transport": (("timing.lines", "timing.interlocks", "feeder", "cross", "consistency.transport", "consistency.conveyor_mass",
                   "consistency.wheel_side_inertia", "gripper_chain.teeth_1", "gripper_chain.acceleration", "gripper_chain.velocity"),
                  CYLINDER | RATE | CLUTCH | MOTOR | COVER | ELEMENTS | CARRIAGES),
    "cylinder": (("cylinder.radius", "cylinder.bore_radius"), RATE | CLUTCH | COVER | ELEMENTS | CARRIAGES),
    "gears": (("train.gears",), CLUTCH | COVER | TRUE_RATE | ELEMENTS | CARRIAGES),
    "clutch": (("consistency.single_position",), COVER | TRUE_RATE | ELEMENTS | CARRIAGES),
    "elements": (("bearings", "gear_key", "crank_key", "sector", "main_gears", "gripper_chain", "drive.sector_ratio"), COVER | TRUE_RATE | CARRIAGES),
    "station": (("timing.station",), COVER | TRUE_RATE | CARRIAGES | {"timing.carriage_height"}),
    "carriage": (("drive.carriage_clearance",), TRUE_RATE | CARRIAGES),
    "limits": (("train.vbelt", "train.allowable_radial_force", "drive", "clutch",
                "damper", "crankshaft", "crank_pin", "rocker_pin", "consistency"), TRUE_RATE),
    "rate": (("press.productivity", "train", "cross_shaft"), set()),
}  # fmt: skip


def taken_over(press: dict[str, Any], mended: dict[str, Any], path: str) -> None:
    """Put what the mended press has at a path, or has not, into the other one."""
    *parents, key = path.split(".")
    for parent in parents:
        press, mended = press[parent], mended[parent]
    if key in mended:
        press[key] = deepcopy(mended[key])
    else:
        press.pop(key, None)


PRESS = WarmPress(is_advised=False)


def calculated(folder: Path, data: dict[str, Any]) -> WarmRun:
    """A press, calculated."""
    run = PRESS.calculate(load_config(saved(folder, yaml.safe_dump(data, sort_keys=False)), DISCOVERY))
    assert not run.errors and not run.skipped
    return run


def verdicts(run: WarmRun) -> dict[str, set[str]]:
    """The checks of a press by their status."""
    found: dict[str, set[str]] = {}
    for name, checks in run.checks.items():
        for check in checks:
            found.setdefault(check.status, set()).add(f"{name}.{check.id}")
    return found


def utilisation(run: WarmRun, name: str) -> float:
    """The utilisation of a check, percent."""
    home, _, own = name.partition(".")
    used = next(check.utilisation for check in run.checks[home] if check.id == own)
    assert used is not None
    return 100 * used


def output(run: WarmRun, name: str, scale: float = 1.0) -> float:
    """A number of the results."""
    home, _, own = name.partition(".")
    return number(run.calculations[home], own) * scale


SAID: dict[str, tuple[tuple[str, Callable[[WarmRun], float | str]], ...]] = {
    "transport": (("6.96° beyond", lambda found: output(found, "timing.best_margin", 180 / np.pi)),),
    "cylinder": (("(105.5 mm)", lambda found: output(found, "cylinder.radius", 1e3)), ("104 kg", lambda found: output(found, "cylinder.mass"))),
    "station": (("24.2 mm", lambda found: output(found, "timing.clearance_least", 1e3)),),
    "carriage": (("24.9 mm", lambda found: output(found, "timing.clearance_least", 1e3)),),
    "limits": (
        ("makes 6070", lambda found: round(output(found, "consistency.true_rate", 3600), -1)),
        ("at 0.40 m/s", lambda found: output(found, "consistency.contact_speed")),
        ("get 6.9 W", lambda found: output(found, "damper.heat_power")),
    ),
    "rate": (
        ("takes 986 N·m", lambda found: output(found, "cross.torque_peak")),
        ("(98.6 %", lambda found: utilisation(found, "cross.torque")),
        ("governing check is then `cross.sheet_play`", lambda found: str(found.governing)),
    ),
}  # fmt: skip
"""What the guide says of a step, and what the press of that step has there."""


def stepped() -> dict[str, dict[str, Any]]:
    """The press after each step."""
    data, mended = (yaml.safe_load(path.read_text(encoding="utf-8")) for path in (PUBLISHED, MENDED))
    found = {}
    for step, (paths, _) in STEPS.items():
        for path in paths:
            home = "press" if path.startswith("press.") else "mechanisms"
            taken_over({home: data[home]}, {home: mended[home]}, path if home == "press" else f"{home}.{path}")
        found[step] = deepcopy(data)
    return found


def test_the_last_step_is_the_mended_press() -> None:
    mended = yaml.safe_load(MENDED.read_text(encoding="utf-8"))
    assert stepped()["rate"]["mechanisms"] == mended["mechanisms"]


@pytest.mark.parametrize("step", few(STEPS, keep=lambda step: step in ("transport", "rate")))
def test_each_step_leaves_what_the_guide_says(tmp_path: Path, step: str) -> None:
    run = calculated(tmp_path, stepped()[step])
    found, guide = verdicts(run), GUIDE.read_text(encoding="utf-8")
    left = found.get("fail", set()) | found.get("warn", set())
    assert left == STEPS[step][1]
    if step == "rate":
        assert found["not_checked"] == UNFOUNDED
        assert all(f"`{name}`" in guide for name in UNFOUNDED)
    if step == "published":
        assert f"; {len(found['not_checked'])} are not made" in guide
    for text, value in SAID.get(step, ()):
        assert text in guide and agrees(text, value(run))


def agrees(text: str, value: float | str) -> bool:
    """Whether the first number of a text, or the name in it, is a value, as it is rounded there."""
    if isinstance(value, str):
        return f"`{value}`" in text
    said = re.search(r"\d+(?:\.(\d+))?", text)
    return said is not None and float(said[0]) == round(value, len(said[1] or ""))


def test_the_guide_names_each_check_that_is_mended() -> None:
    text = GUIDE.read_text(encoding="utf-8")
    for name in set().union(*(left for _, left in STEPS.values())):
        assert f"`{name}`" in text


def test_a_station_without_the_height_of_a_carriage_is_refused(tmp_path: Path) -> None:
    """Held against nothing, its check could not fail."""
    data = yaml.safe_load(MENDED.read_text(encoding="utf-8"))
    del data["mechanisms"]["drive"]["carriage_clearance"]
    del data["mechanisms"]["timing"]["interlocks"][1]
    with pytest.raises(UserError, match="drive, which has no carriage_clearance to hold the room against"):
        calculated(tmp_path, data)


def test_the_dampers_of_the_mended_press_are_judged_by_every_stroke(tmp_path: Path) -> None:
    """As they stood, 10 mm before the end, they fail by their heat; impacts that nobody counts are told."""
    data = yaml.safe_load(MENDED.read_text(encoding="utf-8"))
    damper = data["mechanisms"]["damper"]
    damper |= {"velocity": "0.6 m/s", "contact_distance": "10 mm"}
    found = calculated(tmp_path, data)
    assert output(found, "damper.heat_power") == pytest.approx(14.3, abs=0.05)
    assert verdicts(found)["fail"] == {"damper.heat_power"}
    damper["impacts_per_hour"] = {"value": "60 1/h", "basis": "assumed"}
    assert verdicts(calculated(tmp_path, data))["fail"] == {"consistency.damper_impacts"}
    damper["contact_distance"] = "0 mm"  # met beyond the stroke alone
    assert "fail" not in verdicts(calculated(tmp_path, data))
