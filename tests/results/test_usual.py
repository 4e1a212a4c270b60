"""Values outside their usual range warn, values that no machine has are refused, unless the file says why they are beyond it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

from diecut_report.config.loader import Config, load_config
from diecut_report.config.plugins import Discovery
from diecut_report.config.schema import kind_schema
from diecut_report.errors import UserError
from diecut_report.mechanism.inputs import flatten
from diecut_report.press import Press
from diecut_report.results.document import resolved
from diecut_report.results.mechanism import mechanism_results
from diecut_report.results.press_run import impossible
from diecut_report.results.usual import _values, ends_by_ratio, with_value
from diecut_report.results.warm_press import WarmRun
from diecut_report.standards.ranges import range_of
from diecut_report.study.definition.base_inputs import find_input
from diecut_report.study.execution.variant_rows import calculate_rows
from tests.configs import DISCOVERY, EXAMPLE, WARM

CLUTCH = {
    "kind": "clutch", "torque": "500 N*m", "shoe_radius": "180 mm", "wedge_angle": "10 deg", "wedge_friction": 0.1, "shoe_friction": 0.35,
    "allowable_pressure": "0.3 MPa",
}  # fmt: skip
REASON = "a sintered lining that was measured on the rig"


def loaded(folder: Path, **others: Any) -> Config:
    """A file with a clutch, whose keys are changed by ``clutch``, and other mechanisms."""
    own = {**CLUTCH, **others.pop("clutch", {})}
    press = {"name": "P", **others.pop("press", {})}
    data = {"schema_version": 1, "project": {"title": "T"}, "press": press, "mechanisms": {"clutch": own, **others}}
    file = folder / "press.yaml"
    file.write_text(yaml.safe_dump(data, sort_keys=False, allow_unicode=True), encoding="utf-8")
    return load_config(file, Discovery())


def run(folder: Path, **others: Any) -> WarmRun:
    return WARM.calculate(loaded(folder, **others))


def problems(folder: Path, **others: Any) -> list[Any]:
    with pytest.raises(UserError) as refused:
        run(folder, **others)
    return refused.value.problems


def usual(found: WarmRun, name: str = "clutch") -> Any:
    return next((each for each in found.checks[name] if each.id == "usual_values"), None)


BOTH_RANGES = (
    "press.yaml:13:",
    "shoe_friction = 0.7",
    "usual: 0.25 to 0.45, possible: 0.1 to 0.6, by VDI 2241",
    "beyond",
    "20 characters",
)
GEARS = {"kind": "gear_pair", "module": "4 mm", "teeth_1": 20, "teeth_2": 60, "face_width": "500 mm", "torque": "100 N*m",
         **{f"sigma_{name}_lim_{number}": "430 MPa" for name in "hf" for number in (1, 2)}}  # fmt: skip
TRAIN = {"kind": "drive_train", "motor_speed": "1450 rpm", "output_speed": "100 rpm", "torque_mean": "100 N*m", "torque_peak": "200 N*m",
         "vbelt": {"section": "SPA", "driver_diameter": "125 mm", "center_distance": "600 mm"},
         "gears": [{"driver_teeth": 20, "driven_teeth": 60}, {"driver_teeth": 20, "driven_teeth": 60, "efficiency": 0.097}]}  # fmt: skip
FEEDER = {"kind": "cam_gear_transport", "dwell_angle": "160 deg", "center_distance": "300 mm"}
SECOND = CLUTCH | {"shoe_friction": "${clutch.shoe_friction}"}
SLIPS: dict[str, tuple[dict[str, Any], str, tuple[str, ...]]] = {  # what is given, where it is told, and with which words
    "with both ranges, their source and what to do": ({"clutch": {"shoe_friction": 0.7}}, "mechanisms.clutch.shoe_friction", BOTH_RANGES),
    "a zero that is typed by an expression": ({"clutch": {"engagements_per_hour": "0 1/min * ${clutch.wedge_friction}"}},
        "mechanisms.clutch.engagements_per_hour", ("engagements_per_hour = 0 1/h",)),
    "an expression where it is a number": ({"clutch": {"shoe_friction": "7 * ${clutch.wedge_friction}"}},
        "mechanisms.clutch.shoe_friction", ("shoe_friction = 0.7 (from “7 * ${clutch.wedge_friction}”)",)),
    "where it is typed and not at each reference": ({"clutch": {"shoe_friction": 0.7}, "second": SECOND}, "mechanisms.clutch.shoe_friction", ()),
    "a number of the press": ({"press": {"sheet": {"thickness": "60 mm"}}}, "press.sheet.thickness", ()),
    "a default from the press where the press gives it": ({"press": {"productivity": "60000 1/h"}, "feeder": FEEDER},
        "press.productivity", ("possible: 50 to 20000 1/h",)),
    "a part of a list by its own key": ({"train": TRAIN}, "mechanisms.train.gears.1.efficiency", ()),
    "a value beside one whose reason holds for itself alone": ({"clutch": {"shoe_friction": {"value": 0.7, "beyond": REASON}, "wedge_friction": 0.5}},
        "mechanisms.clutch.wedge_friction", ()),
    # the table bounds face_width / module, hard from 2 to 40
    "a ratio, with the values between which it would be possible": ({"gears": GEARS},
        "mechanisms.gears.face_width", ("With all else as it is, face_width may be 8 to 160 mm.",)),
}  # fmt: skip


@pytest.mark.parametrize("name", SLIPS)
def test_a_value_that_no_machine_has_is_refused_once_where_it_is_typed(name: str, tmp_path: Path) -> None:
    given, path, words = SLIPS[name]
    (told,) = problems(tmp_path, **given)
    assert told.path == path and all(each in str(told) for each in words)


def test_it_is_told_when_only_feasibility_is_judged(tmp_path: Path) -> None:
    found, broken = impossible(loaded(tmp_path, clutch={"shoe_friction": 0.7}), [])
    assert [each.path for each in found] == ["mechanisms.clutch.shoe_friction"]
    assert broken == []


@pytest.mark.parametrize("value", [0.1, 0.25, 0.45, 0.6])
def test_the_ends_of_the_hard_range_are_possible(tmp_path: Path, value: float) -> None:
    assert (usual(run(tmp_path, clutch={"shoe_friction": value})) is not None) == (value in (0.1, 0.6))


def test_all_that_is_unusual_is_one_warning_of_its_mechanism(tmp_path: Path) -> None:
    found = run(tmp_path, clutch={"shoe_friction": 0.5, "wedge_friction": 0.3})
    check = usual(found)
    assert (check.status, check.check_class, check.demand) == ("warn", "practice", 2)
    assert all(
        words in check.message
        for words in ("shoe_friction = 0.5", "wedge_friction = 0.3", "VDI 2241", "handbooks of machine elements")
    )
    assert mechanism_results(found.calculations["clutch"], {}).warnings == [check.message]


def test_zero_is_usual_only_where_it_is_what_holds_without_the_key(tmp_path: Path) -> None:
    assert usual(run(tmp_path, clutch={"engagements_per_hour": "0 1/h"})) is None


# --- beyond ------------------------------------------------------------------------------------------------------------


def beyond(value: Any, reason: Any = REASON) -> dict[str, Any]:
    return {"value": value, "beyond": reason}


def test_a_reason_makes_it_a_warning_that_stays(tmp_path: Path) -> None:
    check = usual(run(tmp_path, clutch={"shoe_friction": beyond(0.7)}))
    assert check.status == "warn"
    assert REASON in check.message


@pytest.mark.parametrize(
    "reason",
    ["too short", " " * 30, "x" * 19, 12345678901234567890123, True, ["a reason that is long enough"], {"a": "b"}],
)
def test_what_is_no_reason_is_refused(tmp_path: Path, reason: Any) -> None:
    (told,) = problems(tmp_path, clutch={"shoe_friction": beyond(0.7, reason)})
    assert told.path.endswith("shoe_friction.beyond") and "at least 20 characters" in told.message


def test_a_reason_may_hold_signs_of_a_template(tmp_path: Path) -> None:
    reason = "measured {torque} at ${clutch.torque} {value:up} on the rig"
    found = run(tmp_path, clutch={"shoe_friction": beyond(0.7, reason.replace("$", ""))})
    assert reason.replace("$", "") in usual(found).message


def test_references_carry_the_reason(tmp_path: Path) -> None:
    found = run(tmp_path, clutch={"shoe_friction": beyond(0.7)}, second=SECOND)
    assert REASON in usual(found, "second").message


def test_the_resolved_configuration_keeps_the_reason(tmp_path: Path) -> None:
    data = resolved(run(tmp_path, clutch={"shoe_friction": beyond(0.7)}, second=SECOND))
    for name in ("clutch", "second"):
        assert data["mechanisms"][name]["shoe_friction"]["beyond"] == REASON
    again = tmp_path / "again.yaml"
    again.write_text(yaml.safe_dump(data, allow_unicode=True), encoding="utf-8")
    assert usual(WARM.calculate(load_config(again, DISCOVERY)), "second").status == "warn"


def test_the_schema_of_editors_has_the_key() -> None:
    ways = kind_schema(Discovery().mechanism("clutch"))["properties"]["shoe_friction"]["anyOf"]
    block = next(way for way in ways if way.get("type") == "object")
    assert block["properties"]["beyond"]["minLength"] == 20


# --- many variants -----------------------------------------------------------------------------------------------------


def test_a_variant_outside_the_hard_range_cannot_exist_and_an_unusual_one_warns(tmp_path: Path) -> None:
    base = loaded(tmp_path)
    rows = calculate_rows(base, {find_input(base, "mechanisms.clutch.shoe_friction"): np.array([0.35, 0.5, 0.7])}, 3)
    assert list(rows.status) == ["pass", "warn", "error"]
    assert "shoe_friction = 0.7" in rows.errors[2]
    assert list(rows.columns["clutch.checks.usual_values.status"]) == [None, "warn", None]


def test_a_variant_whose_parts_disagree_cannot_exist() -> None:
    base = load_config(EXAMPLE, Discovery())
    rows = calculate_rows(base, {find_input(base, "mechanisms.main_gears.module"): np.array([5e-3, 4e-3])}, 2)
    assert (rows.errors[0], rows.status[1]) == (None, "error")
    assert "which takes the same torque, has the pitch radius 96 mm there" in rows.errors[1]


def test_a_value_that_is_written_into_the_file_keeps_the_reason(tmp_path: Path) -> None:
    press = Press(loaded(tmp_path, clutch={"shoe_friction": beyond(0.7)}), Discovery(), lambda _: None)
    text = press.with_values({("mechanisms", "clutch", "shoe_friction", "value"): "0.65"}).config.tree.text
    assert REASON in text and "0.65" in text


def test_a_mechanism_that_types_what_the_press_states_otherwise_is_warned_of(tmp_path: Path) -> None:
    platen = {
        "kind": "platen_press", "cutting_force_max": "450 kN", "platen_mass": "300 kg", "drive_deformation": "0.4 mm", "crank_radius": "100 mm",
        "rod_length": "600 mm", "journal_radius": "50 mm", "crank_pin_radius": "47 mm", "platen_pin_radius": "58 mm",
    }  # fmt: skip
    press = {"productivity": "4000 1/h", "sheet": {"length": "700 mm", "width": "500 mm", "thickness": "1.6 mm"}}
    same = {"cycles_per_hour": "${press.productivity}", "material_thickness": "${press.sheet.thickness}"}
    other = {"cycles_per_hour": "1500 1/h", "material_thickness": "0.6 mm"}
    assert usual(run(tmp_path, press=press, platen={**platen, **same}), "platen") is None
    told = usual(run(tmp_path, press=press, platen={**platen, **other}), "platen")
    assert (told.status, told.demand) == ("warn", 2)
    assert "cycles_per_hour / press.productivity = 0.375 (usual: 0.999 to 1.001" in str(told.message)
    assert "material_thickness / press.sheet.thickness = 0.375" in str(told.message)
    assert usual(run(tmp_path, platen={**platen, **other}), "platen") is None  # the press says nothing


@pytest.mark.parametrize(("rate", "status"), [("6000 1/h", None), ("3000 1/h", "warn")])
def test_a_crank_that_turns_otherwise_than_once_a_sheet_is_warned_of(
    tmp_path: Path, rate: str, status: str | None
) -> None:
    cross = {
        "kind": "geneva_transport", "center_distance": "240 mm", "roller_radius": "16 mm", "roller_width": "25 mm", "gear_ratio": 6,
        "sprocket_teeth": 30, "chain_pitch": "19.05 mm", "driven_inertia": "8.8 kg*m**2", "crank_speed": "100 rpm",
    }  # fmt: skip
    press = {"productivity": rate, "sheet": {"length": "700 mm", "width": "500 mm", "thickness": "0.6 mm"}}
    found = usual(run(tmp_path, press=press, cross=cross), "cross")
    assert (found and found.status) == status
    assert found is None or "crank_speed / (press.productivity * 1 revolution) = 2 (usual: 0.999 to 1.001" in str(
        found.message
    )


@pytest.mark.parametrize("name", ["flat_cylinder_press_mended", "flat_cylinder_elements"])
def test_at_its_usual_ends_a_value_makes_a_ratio_that_is_one_end_of_its_row(name: str) -> None:
    config = load_config(EXAMPLE.with_name(f"{name}.yaml"), Discovery())
    machine, tried = WARM.calculate(config), 0
    for home, calculation in machine.calculations.items():
        instance, inputs = config.instances[home], flatten(machine.blocks[home])
        beside = machine.beside(instance)
        for key, row, values in _values(instance, inputs, beside.press, calculation.values):
            path = ".".join(step for step in key if isinstance(step, str))
            if not row.of or range_of(calculation.mechanism.kind, path) != row or not np.isfinite(values).all():
                continue
            ends = ends_by_ratio(instance, key, row, inputs, beside, calculation.values)
            for end in ends or ():
                made = with_value(inputs, path, key, end)
                again = [
                    each
                    for placed, own, each in _values(instance, made, beside.press, calculation.values)
                    if (placed, own) == (key, row)
                ]
                assert min(abs(float(again[0][0]) - each) for each in row.usual) < 1e-9 * max(row.usual)
                tried += 1
    assert tried > 10
