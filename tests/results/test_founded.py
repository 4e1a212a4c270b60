"""A check that would hold because somebody typed it is not checked; what can be looked up is a basis."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.config.yaml import load
from diecut_report.errors import UserError
from diecut_report.results.warm_press import WarmPress
from diecut_report.study.definition.base_inputs import find_input
from diecut_report.study.execution.press_batch import calculated
from diecut_report.study.execution.variant_rows import verdicts
from tests.configs import DISCOVERY, EXAMPLE, WARM, saved

HEAD = "schema_version: 1\nproject: {title: Gears}\npress: {name: P}\nmechanisms:\n"
MENDED_PRESS = EXAMPLE.with_name("flat_cylinder_press_mended.yaml")
FACTORS = ("application_factor", "dynamic_factor", "face_load_factor", "transverse_load_factor")
DEFAULTS = dict(zip(FACTORS, (1.25, 1.1, 1.3, 1.0), strict=True))


def gears(**more: Any) -> dict[str, Any]:
    strength = {f"sigma_h_lim_{i}": "767 MPa" for i in (1, 2)} | {f"sigma_f_lim_{i}": "314 MPa" for i in (1, 2)}
    sizes = {"module": "5 mm", "teeth_1": 24, "teeth_2": 48, "face_width": "50 mm", "torque": "50 N*m"}
    return {"kind": "gear_pair"} | sizes | strength | more


def judged(tmp_path: Path, own: dict[str, Any], check: str) -> dict[str, Any]:
    file = saved(tmp_path, HEAD + f"  a: {own!r}\n")
    run = WARM.calculate(load_config(file, DISCOVERY))
    (found,) = (each for each in run.checks["a"] if each.id == check)
    return dict(found) | {"conclusion": run.summary.conclusion}


@pytest.mark.parametrize(
    ("basis", "status"),
    [
        ({"basis": "assumed"}, "not_checked"),
        ({}, "not_checked"),
        ({"basis": "given", "note": "so I was told"}, "not_checked"),
        ({"basis": "standard"}, "not_checked"),
        *(({"basis": "standard", "note": note}, "not_checked") for note in ("  ", ".", "– – –", "__", "a 1")),
        ({"basis": "standard", "note": "№ 7, ГОСТ"}, "pass"),
        ({"basis": "standard", "note": "ISO 6336-1, method B"}, "pass"),
        ({"basis": "measured"}, "pass"),
    ],
)
def test_factors_hold_by_what_can_be_looked_up_alone(tmp_path: Path, basis: dict[str, str], status: str) -> None:
    typed = {key: {"value": value, **basis} for key, value in DEFAULTS.items()}
    found = judged(tmp_path, gears(**typed), "k_factors")
    assert found["status"] == status
    if status != "pass":
        assert "All checks pass" not in found["conclusion"] and "not made" in found["conclusion"]
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


KEY = {"kind": "parallel_key", "shaft_diameter": "40 mm", "yield_shaft": "600 MPa", "yield_hub": "600 MPa"}
LOADED = KEY | {"torque": "300 N*m", "application_factor": 1.25}
TURNED = KEY | {"torque_curve": ["300 N*m", "-200 N*m", "100 N*m", "300 N*m"]}
PRESSURES = ("pressure_shaft", "pressure_hub", "pressure_key")


@pytest.mark.parametrize(("typed", "status"), [({}, "not_checked"), ({"basis": "measured"}, "pass")])
@pytest.mark.parametrize(
    ("own", "key", "value", "checks"),
    [
        (gears(), "life_factor_h_1", 1.4, ("pitting_1",)),
        (gears(), "life_factor_f_2", 1.4, ("root_2",)),
        (TURNED, "flank_changes", 2, ("reversing", *PRESSURES)),
        (LOADED, "load_distribution_factor", 1, ("pressure_peak", *PRESSURES)),
    ],
)
def test_a_factor_that_is_only_typed_proves_nothing(
    tmp_path: Path, own: dict[str, Any], key: str, value: float, checks: tuple[str, ...], typed: Any, status: str
) -> None:
    for check in checks:
        assert judged(tmp_path, own | {key: {"value": value, **typed}}, check)["status"] == status


def test_a_factor_that_is_left_out_or_typed_as_its_default_is_no_way_to_hold(tmp_path: Path) -> None:
    for check in ("pitting_1", "root_2"):
        assert judged(tmp_path, gears(), check)["status"] == "pass"
    for check in ("pressure_peak", *PRESSURES):
        assert judged(tmp_path, LOADED, check)["status"] == "pass"
        assert judged(tmp_path, LOADED | {"load_distribution_factor": 1.2}, check)["status"] == "pass"


def test_a_factor_that_varies_is_typed_in_all_machines(tmp_path: Path) -> None:
    typed = {key: {"value": value, "basis": "assumed"} for key, value in DEFAULTS.items()}
    config = load_config(saved(tmp_path, HEAD + f"  a: {gears(**typed)!r}\n"), Discovery())
    made = calculated(config, {find_input(config, "mechanisms.a.dynamic_factor"): np.array([1.05, 1.1, 1.2])}, 3)
    assert "a.checks.k_factors" in verdicts(made.calculations, 3).unchecked
    made.release()


MENDED = WarmPress(is_advised=False)


def mended(**changes: dict[str, Any]) -> dict[str, Any]:
    """The statuses of the mended press's checks by typing, with other inputs of its mechanisms."""
    tree = load(MENDED_PRESS)
    for name, own in changes.items():
        block = tree.data["mechanisms"][name]
        tree.data["mechanisms"][name] = {key: value for key, value in (block | own).items() if value is not None}
    found = MENDED.calculate(load_config(tree, Discovery())).checks
    return {f"{name}.{each.id}": each.status for name in found for each in found[name]}


@pytest.mark.nightly
def test_a_clutch_and_a_key_do_not_pass_by_a_word() -> None:
    drawn = {"value": True, "basis": "drawing"}
    read_off = {"value": 0.3, "basis": "standard", "note": "DIN 6892, figure 5"}
    for clutch, factor, expected in ((True, 0.3, "not_checked"), (drawn, read_off, "pass")):
        counted = {"required_life": None, "cycle_speed": None}
        told = mended(consistency={"single_position": clutch}, gear_key=counted | {"load_direction_factor": factor})
        assert (
            told["consistency.clutch_position"]
            == told["gear_key.reversing"]
            == told["gear_key.pressure_hub"]
            == expected
        )
    for changes, expected in ((1e8, "not_checked"), ({"value": 1e8, "basis": "measured"}, "pass")):
        told = mended(gear_key={"required_life": None, "cycle_speed": None, "flank_changes": changes})
        assert told["gear_key.reversing"] == told["gear_key.pressure_hub"] == expected
    told = mended(consistency={"single_position": False})
    assert told["consistency.clutch_position"] == "fail"


def test_a_life_of_a_second_is_no_life() -> None:
    with pytest.raises(
        UserError, match=r"gives required_life = 0.000278 h, which no machine of this kind has \(usual: 5000 to 60000 h"
    ):
        mended(gear_key={"required_life": "1 s"})


def test_a_torque_that_goes_through_gears_keeps_its_speed() -> None:
    with pytest.raises(UserError, match="comes again with"):
        mended(gear_key={"torque": "${main_gears.torque_pinion_curve}", "cycle_speed": "49 rpm"})


@pytest.mark.parametrize("part", [0, 1])
@pytest.mark.parametrize(("typed", "status"), [({}, "not_checked"), ({"basis": "measured"}, "pass")])
def test_a_key_of_a_block_and_of_one_part_of_a_list_is_asked_for_its_basis(
    typed: dict[str, str], status: str, part: int
) -> None:
    tree = load(MENDED_PRESS)
    mechanisms = tree.data["mechanisms"]
    mechanisms["train"]["vbelt"]["groove_friction"] = {"value": 0.6, **typed}
    name = next(
        name for name, block in mechanisms.items() if block["kind"] == "rolling_bearing" and len(block["bearings"]) > 1
    )
    mechanisms[name]["bearings"][part]["a_iso"] = {"value": 1.5, **typed}
    found = MENDED.calculate(load_config(tree, Discovery())).checks
    (slip,) = (each.status for each in found["train"] if each.id == "vbelt_slip")
    lives = [each.status for each in found[name] if each.id.endswith("_life")]
    assert (slip, lives[part], lives[1 - part]) == (status, status, "pass")
