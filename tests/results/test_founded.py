"""A check that would hold because somebody typed it is not checked; what can be looked up is a basis."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.results.document import document
from diecut_report.results.press_run import compute
from diecut_report.study.definition.base_inputs import find_input
from diecut_report.study.execution.press_batch import calculated
from diecut_report.study.execution.variant_rows import verdicts
from tests.configs import saved

HEAD = "schema_version: 1\nproject: {title: Gears}\npress: {name: P}\nmechanisms:\n"
FACTORS = ("application_factor", "dynamic_factor", "face_load_factor", "transverse_load_factor")
DEFAULTS = dict(zip(FACTORS, (1.25, 1.1, 1.3, 1.0), strict=True))


def gears(**more: Any) -> dict[str, Any]:
    strength = {f"sigma_h_lim_{i}": "767 MPa" for i in (1, 2)} | {f"sigma_f_lim_{i}": "314 MPa" for i in (1, 2)}
    own = {
        "kind": "gear_pair",
        "module": "5 mm",
        "teeth_1": 24,
        "teeth_2": 48,
        "face_width": "50 mm",
        "torque": "50 N*m",
    }
    return own | strength | more


def judged(tmp_path: Path, own: dict[str, Any], check: str) -> dict[str, Any]:
    file = saved(tmp_path, HEAD + f"  a: {own!r}\n")
    results = document(compute(load_config(file, Discovery()), lambda _: None))
    (found,) = (each for each in results.mechanisms["a"].checks if each.id == check)
    return dict(found) | {"conclusion": results.summary.conclusion}


@pytest.mark.parametrize(
    ("basis", "status"),
    [
        ({"basis": "assumed"}, "not_checked"),
        ({}, "not_checked"),
        ({"basis": "given", "note": "so I was told"}, "not_checked"),
        ({"basis": "standard"}, "not_checked"),
        ({"basis": "standard", "note": "  "}, "not_checked"),
        ({"basis": "standard", "note": "ISO 6336-1, method B"}, "pass"),
        ({"basis": "measured"}, "pass"),
    ],
)
def test_factors_hold_by_what_can_be_looked_up_alone(tmp_path: Path, basis: dict[str, str], status: str) -> None:
    typed = {key: {"value": value, **basis} for key, value in DEFAULTS.items()}
    found = judged(tmp_path, gears(**typed), "k_factors")
    assert found["status"] == status
    if status != "pass":
        assert "All checks pass" not in found["conclusion"] and "not checked" in found["conclusion"]
        assert found["missing"] == list(FACTORS)
        assert "would pass only because of application_factor" in found["message"]


def test_factors_that_are_left_out_are_counted_as_before(tmp_path: Path) -> None:
    found = judged(tmp_path, gears(), "k_factors")
    assert (found["status"], found["demand"]) == ("warn", 4)


def test_many_machines_are_judged_as_each_alone(tmp_path: Path) -> None:
    for basis, is_left in (("assumed", True), ("measured", False)):
        typed = {key: {"value": value, "basis": basis} for key, value in DEFAULTS.items()}
        config = load_config(saved(tmp_path, HEAD + f"  a: {gears(**typed)!r}\n"), Discovery())
        made = calculated(config, {}, 3)
        found = verdicts(made.calculations, 3)
        assert ("a.checks.k_factors" in found.unchecked) == is_left
        assert ("a.checks.k_factors" in found.names) != is_left
        made.release()


def test_a_factor_that_varies_is_typed_in_all_machines(tmp_path: Path) -> None:
    typed = {key: {"value": value, "basis": "assumed"} for key, value in DEFAULTS.items()}
    config = load_config(saved(tmp_path, HEAD + f"  a: {gears(**typed)!r}\n"), Discovery())
    made = calculated(config, {find_input(config, "mechanisms.a.dynamic_factor"): np.array([1.05, 1.1, 1.2])}, 3)
    assert "a.checks.k_factors" in verdicts(made.calculations, 3).unchecked
    made.release()


READ_OFF = {"basis": "standard", "note": "DIN 6892, figure 5"}
KEY = {
    "kind": "parallel_key", "shaft_diameter": "40 mm", "yield_shaft": "600 MPa", "yield_hub": "600 MPa",
    "torque_curve": ["300 N*m", "-200 N*m", "100 N*m", "300 N*m"],
}  # fmt: skip


@pytest.mark.parametrize(("key", "value"), [("flank_changes", 1), ("load_direction_factor", 0.7)])
@pytest.mark.parametrize(
    ("basis", "status"), [({}, "not_checked"), (READ_OFF, "pass"), ({"basis": "measured"}, "pass")]
)
def test_what_a_key_is_spared_by_is_no_proof_when_it_is_only_typed(
    tmp_path: Path, key: str, value: float, basis: dict[str, str], status: str
) -> None:
    assert judged(tmp_path, KEY | {key: {"value": value, **basis}}, "reversing")["status"] == status
