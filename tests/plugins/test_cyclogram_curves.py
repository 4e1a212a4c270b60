"""The curves over the main shaft against those of the lines themselves, and what is not calculated where the rates differ."""

from __future__ import annotations

from math import pi
from typing import Any

import numpy as np
import pytest

from diecut_report.plugins.cyclogram import torques
from diecut_report.report.profile_files import written
from diecut_report.results.document import document
from diecut_report.results.mechanism import mechanism_results
from tests.machines import number
from tests.plugins.test_cyclogram import STATION, base, check_of, example, keys_of, linked, locks, press

ETA = {"drive": 0.97, "cross": 0.95}


def own(line: str, curve: str, main: Any, turns: float, offset: float) -> Any:
    """A curve of a line at main-shaft angles, from its own calculation."""
    calc = base().calculations[line]
    place = ((main - offset) * turns % (2 * pi))[None, :]
    return calc.sample(curve, place, calc.domains["crank_angle"].middle_of(place))[0]


def curves(transport: str = "cross") -> dict[str, Any]:
    """The curves of the results, as arrays."""
    found = mechanism_results(example(transport, "cutting passing"), {}).curves
    return {name: np.array(curve.values) for name, curve in found.items()} | {"described": found}


def test_each_lines_torque_is_its_own_with_the_losses_of_its_way() -> None:
    found, offset = curves(), float(example("cross", "cutting passing")["line_offset"][0, 1])
    main = found["main_angle"]
    for index, (line, turns, at, name) in enumerate(
        (("drive", 0.5, 0.0, "crank_torque"), ("cross", 1.0, offset, "torque")), 1
    ):
        torque = own(line, name, main, turns, at)
        expected = turns * np.where(torque > 0, torque / ETA[line], torque * ETA[line])
        assert found[f"line_torque_{index}"] == pytest.approx(expected, abs=1e-7)
        assert found["described"][f"line_torque_{index}"].description == f"Torque of the line at the main shaft: {line}"
    assert found["main_shaft_torque"] == pytest.approx(found["line_torque_1"] + found["line_torque_2"], abs=1e-9)
    assert found["greatest_torque"] == pytest.approx(found["line_torque_1"], abs=1e-9)


def test_the_ways_and_kinetic_energies_are_those_of_the_lines() -> None:
    found, offset = curves(), float(example("cross", "cutting passing")["line_offset"][0, 1])
    main, drive = found["main_angle"], base().calculations["drive"]
    assert found["way_1"] == pytest.approx(own("drive", "displacement", main, 0.5, 0.0), abs=1e-12)
    step = number(base().calculations["cross"], "sheet_step")
    turned = np.floor((main - offset) / (2 * pi))
    assert found["way_2"] == pytest.approx(own("cross", "sheet_position", main, 1.0, offset) + turned * step, abs=1e-9)
    speed, rotation = (own("drive", name, main, 0.5, 0.0) for name in ("cylinder_speed", "cylinder_rotation"))
    swing = 2 * number(drive, "cylinder_radius") * number(drive, "static_unbalance") * np.cos(rotation)
    assert found["kinetic_energy_1"] == pytest.approx(
        (number(drive, "reduced_inertia") + swing) * speed**2 / 2, abs=1e-7
    )
    wheel = own("cross", "wheel_speed", main, 1.0, offset)
    assert found["kinetic_energy_2"] == pytest.approx(3.57 * wheel**2 / 2, abs=1e-7)
    assert found["kinetic_energy_total"] == pytest.approx(
        found["kinetic_energy_1"] + found["kinetic_energy_2"], abs=1e-9
    )


def test_the_peak_power_of_the_greatest_consumer_is_that_of_the_method() -> None:
    """The cylinder alone, printed with its sum."""
    assert number(example("cross", "cutting passing"), "greatest_power_peak") == pytest.approx(2667.2, abs=0.1)


def test_the_clearance_is_a_curve_with_its_least_value() -> None:
    station = STATION | {"transport": "cross"}
    calc = press("cross", locks("cutting passing", "cross"), "48 deg", station=station, n_points=7200)
    over = np.array(mechanism_results(calc, {}).curves["clearance_over"].values)
    assert over.min() == pytest.approx(0.0289877, abs=2e-6)
    assert over.max() <= number(base().calculations["drive"], "cylinder_radius")


def test_without_a_station_the_height_over_the_carriages_is_not_checked() -> None:
    check = check_of(example("cross", "cutting"), "carriage_height")
    assert (check.status, check.missing) == ("not_checked", ["station"])


TRAIN = {
    "kind": "drive_train", "motor_speed": "1450 rpm", "output_speed": "${timing.main_shaft_speed}", "torque_mean": "${timing.torque_mean}",
    "torque_peak": "${timing.torque_peak}", "torque_curve": "${timing.main_shaft_torque}",
    "vbelt": {"section": "SPA", "driver_diameter": "125 mm", "center_distance": "600 mm"}, "power_per_belt": "3.5 kW",
    "gears": [{"driver_teeth": 20, "driven_teeth": 98}],
}  # fmt: skip


def unlike(**more: Any) -> Any:
    """A press whose transport makes as many steps as before, while the press makes fewer sheets."""
    timing = {"kind": "cyclogram"} | keys_of("cross", locks("cutting", "cross")) | {"productivity": "5000 1/h"}
    return linked({"timing": timing, "train": TRAIN} | more, printed=True)


def test_where_a_line_runs_at_another_rate_the_sum_of_the_torques_is_not_given() -> None:
    run = unlike()
    found = run.results["timing"]
    assert next(each for each in found.checks if each.id == "equal_rates").status == "fail"
    assert not {"torque_mean", "power_peak", "energy_exchange"} & found.outputs.keys()
    assert not {"main_shaft_torque", "way_1"} & found.curves.keys()
    said = {each.title: each.text for each in found.absent}
    assert "a line runs at another rate than the press" in said["Sum of the torques at the main shaft"]
    assert "interlock_cutting" in {each.id for each in found.checks}, "angles hold"


def test_what_refers_to_a_sum_that_is_not_given_is_skipped_with_the_reason() -> None:
    run = unlike()
    results = document(run)
    train = results.mechanisms["train"]
    assert train.status == "skipped"
    assert (
        "timing.main_shaft_torque, which is not calculated: a line runs at another rate than the press" in train.error
    )
    assert results.status == "fail"
    consistency = results.mechanisms["press_consistency"]
    assert consistency.status != "skipped", "what it holds against others it does without"
    unchecked = {each.id for each in consistency.checks if each.status == "not_checked"}
    assert {"actual_rate", "motor_thermal"} <= unchecked


def test_without_any_torque_there_is_no_sum(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(torques, "TORQUES", {})
    found = mechanism_results(press("cross", locks("cutting", "cross")), {})
    assert "way_2" in found.curves
    assert "torque_mean" not in found.outputs
    assert "no line has a known torque" in next(each.text for each in found.absent if each.title.startswith("Sum"))


def test_the_curves_over_the_main_shaft_are_written_as_a_table() -> None:
    timing = {"kind": "cyclogram"} | keys_of("cross", locks("cutting", "cross"))
    files, _ = written(document(linked({"timing": timing}, printed=True)))
    heads, *rows = files["timing.main_shaft.csv"].decode().splitlines()
    assert heads.split(",")[0] == '"main_angle [deg]"'
    assert '"line_torque_2 [N*m]"' in heads.split(",")
    assert len(rows) == 720
    assert "timing.main_shaft.dxf" not in files
