"""The published drive line is corrected as docs/correcting-a-drive-line.md tells: after each step the named calculations are left."""

from __future__ import annotations

from copy import deepcopy
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest
import yaml

from tests.examples import few
from tests.test_mending import calculated, taken_over, verdicts

FOLDER = Path(import_module("diecut_report.configs").__path__[0]) / "machines"
GUIDE = (Path(__file__).parents[1] / "docs" / "correcting-a-drive-line.md").read_text(encoding="utf-8")

TEETH = {"meshes_crank_drive", "meshes_main_drive", "meshes_sector", "meshes_step_up"}
SHAFTS = {
    "shafts_conveyor_bearings",
    "shafts_crank",
    "shafts_crank_bearings",
    "shafts_geneva",
    "shafts_main",
    "shafts_main_bearings",
}
KEYS = {
    "shafts_crank_disc_key",
    "shafts_flywheel_pinion_key",
    "shafts_geneva_cross_key",
    "shafts_geneva_large_key",
    "shafts_main_disc_key",
    "shafts_main_wheel_key",
    "shafts_pinion_pinion_key",
    "shafts_rocker_arm_key",
    "shafts_rocker_sector_key",
}

# What is taken over from the corrected machine in each step, and the calculations of which a check fails after it
STEPS: dict[str, tuple[tuple[str, ...], set[str]]] = {
    "published": ((), TEETH | SHAFTS | KEYS),
    "gears": (("machine.gears", "machine.frame", "meshes"), SHAFTS | KEYS),
    "shafts": (("shafts", "machine.surface"), {"cross"}),
    "chains": (("chains", "mechanisms.cylinder.radius"), {"cross", "consistency", "drive", "timing"}),
    "mechanisms": (
        ("mechanisms.clutch", "mechanisms.drive", "mechanisms.cross", "mechanisms.consistency", "belts"),
        set(),
    ),
    "evidence": (("machine",), set()),
}


def stepped() -> dict[str, dict[str, Any]]:
    """The machine after each step."""
    published, corrected = (
        yaml.safe_load((FOLDER / f"{name}.yaml").read_text(encoding="utf-8"))
        for name in ("flat_cylinder", "flat_cylinder_corrected")
    )
    found = {}
    for step, (paths, _) in STEPS.items():
        for path in paths:
            taken_over(published, corrected, path)
        found[step] = deepcopy(published)
    assert found["evidence"] == corrected | {"project": published["project"]}
    return found


@pytest.mark.parametrize("step", few(STEPS, keep=lambda step: step == "evidence"))
def test_each_step_leaves_what_the_guide_says(tmp_path: Path, step: str) -> None:
    results = calculated(tmp_path, stepped()[step])
    failing = verdicts(results).get("fail", set())
    assert {name.partition(".")[0] for name in failing} == STEPS[step][1]
    assert f"**{len(failing)}** checks fail" in GUIDE
