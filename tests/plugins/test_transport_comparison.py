"""The comparison of cam-gear stepper and Geneva drive against both drives' own results, and against trying all sweeps."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from diecut_report.config.plugins import Discovery
from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanics.motion_laws import LAWS
from diecut_report.plugins.cam_gear_transport import MECHANISM as CAM
from diecut_report.plugins.geneva_transport import MECHANISM as GENEVA
from diecut_report.press import Press
from diecut_report.results.mechanism_record import MechanismRecord
from diecut_report.results.model import ResultsRecord
from diecut_report.results.press_run import compared, found
from tests.configs import HEAD, saved
from tests.examples import examples, few
from tests.machines import inputs, number

STEPPER: dict[str, Any] = {"dwell_angle": "160 deg", "center_distance": "300 mm", "cycles_per_hour": 6000}
CROSS: dict[str, Any] = {"slots": 6, "center_distance": "200 mm", "crank_speed": "100 rpm", "roller_radius": "10 mm"}
HAS, JUMPS = "the Geneva drive has", "its acceleration jumps at entry and exit"
CONVEYOR: dict[str, Any] = {"sprocket_teeth": 24, "chain_pitch": "31.75 mm"}  # of the cam-gear: a step of 762 mm


def cam(**changes: Any) -> Calculation:
    """The cam-gear stepper with changes."""
    return calculate(CAM, inputs(CAM, STEPPER | changes))


def geneva(**changes: Any) -> Calculation:
    """The Geneva drive with changes."""
    return calculate(GENEVA, inputs(GENEVA, CROSS | changes))


def results(stepper: Calculation, cross: Calculation) -> MechanismRecord:
    """The results of the comparison of two drives."""
    (case,) = found({"stepper": stepper, "cross": cross})
    return compared(case, {"stepper": stepper, "cross": cross})


def outputs(stepper: Calculation, cross: Calculation) -> dict[str, Any]:
    """The outputs of the comparison as plain values."""
    return {name: output.value for name, output in results(stepper, cross).outputs.items()}


def curves(data: MechanismRecord, *names: str) -> list[Array]:
    """Curves of the results."""
    return [np.array(data.curves[name].values) for name in names]


def test_on_the_same_step_and_cycle_each_drive_has_its_own_results() -> None:
    stepper = cam(**CONVEYOR, conveyor_mass=17)
    cross = geneva(**CONVEYOR, gear_ratio=6, driven_inertia=17 * (0.762 * 6 / (2 * np.pi)) ** 2)
    together = outputs(stepper, cross)
    for name in ("sheet_velocity_max", "sheet_acceleration_max", "torque_peak"):
        assert together[f"cam_{name}"] == pytest.approx(number(stepper, name), rel=1e-9)
        assert together[f"geneva_{name}"] == pytest.approx(number(cross, name), rel=1e-9)
    assert together["velocity_ratio"] == pytest.approx(
        number(cross, "sheet_velocity_max") / number(stepper, "sheet_velocity_max")
    )
    assert together["torque_ratio"] == pytest.approx(number(cross, "torque_peak") / number(stepper, "torque_peak"))
    assert together["cam_time_dwell"] == pytest.approx(0.6 * 160 / 360)
    assert together["geneva_time_dwell"] == pytest.approx(number(cross, "time_dwell"))
    assert together["dwell_ratio"] == pytest.approx(240 / 160)
    assert (together["cycle_basis"], together["step_basis"]) == ("both drives have it", "both drives have it")


def test_another_step_and_cycle_of_the_geneva_drive_change_nothing_but_the_words() -> None:
    stepper = cam(**CONVEYOR, conveyor_mass=17)
    own, other = (
        outputs(stepper, geneva(**CONVEYOR, gear_ratio=ratio, crank_speed=speed))
        for ratio, speed in ((6, 100), (4, 80))
    )
    differ = {name for name in own if own[name] != other[name]}
    assert differ == {"geneva_cycle_time", "cycle_basis", "step_basis"}
    assert other["step_basis"] == "the cam-gear's, for both drives"


def test_without_a_conveyor_only_ratios_are_compared() -> None:
    together = outputs(cam(), geneva())
    assert "acceleration_ratio" in together
    assert not [name for name in together if "sheet" in name or "torque_peak" in name or name == "step_basis"]


def test_the_step_of_the_geneva_drive_serves_where_the_cam_gear_has_none() -> None:
    cross = geneva(**CONVEYOR)
    together = outputs(cam(), cross)
    assert together["geneva_sheet_velocity_max"] == pytest.approx(number(cross, "sheet_velocity_max"), rel=1e-9)
    assert "cam_torque_peak" not in together


@pytest.mark.parametrize(
    "slots, dwell, stop",
    few([(6, 160, 20), (3, 160, 20), (18, 230, 2), (12, 235, 4), (5, 90, 30)], keep=lambda one: one[0] in (3, 18)),
)
def test_both_drives_make_one_step_a_cycle_about_the_same_middle(slots: int, dwell: float, stop: float) -> None:
    """Also where the Geneva drive moves for longer than the cam-gear, and so into the next cycle's beginning."""
    stepper = cam(dwell_angle=dwell, sector_stop_sweep=stop, n_points=3600)
    (case,) = found({"stepper": stepper, "cross": geneva(slots=slots, roller_radius="3 mm")})
    data = compared(case, {"stepper": stepper, "cross": geneva(slots=slots, roller_radius="3 mm")})
    angle, gear, wheel, jerked, kicked = curves(
        data, "cycle_angle", "cam_velocity", "geneva_velocity", "cam_acceleration", "geneva_acceleration"
    )
    assert [np.mean(v) for v in (gear, wheel)] == pytest.approx([1, 1], abs=2e-3)
    assert [np.mean(a) for a in (jerked, kicked)] == pytest.approx([0, 0], abs=0.2)
    middle = np.pi * (1 + dwell / 360)
    for velocity in (gear, wheel):
        one, other = (
            np.interp(np.mod(middle + side * np.linspace(0, 1.5, 40), 2 * np.pi), angle, velocity, period=2 * np.pi)
            for side in (1, -1)
        )
        np.testing.assert_allclose(one, other, atol=0.02 * velocity.max())
    np.testing.assert_allclose(np.gradient(wheel, 1 / len(wheel))[5:-5][abs(np.gradient(kicked))[5:-5] < 0.5],
                               kicked[5:-5][abs(np.gradient(kicked))[5:-5] < 0.5], atol=0.02 * kicked.max())  # fmt: skip


@pytest.mark.parametrize("slots", [3, 6, 12])
def test_the_jump_at_entry_is_how_the_wheel_sets_off(slots: int) -> None:
    """The wheel's angle by the drawing: the roller goes round a center beside it, and begins at a right angle to the slot."""
    arm = np.sin(np.pi / slots)  # to the distance of the centers
    entry, step = np.pi / 2 - np.pi / slots, 1e-4
    crank = step * np.arange(3) - entry
    wheel = np.arctan2(arm * np.sin(crank), 1 - arm * np.cos(crank))
    share = wheel * slots / (2 * np.pi)  # of the sheet's step
    jump = np.diff(share, 2)[0] / (step / (2 * np.pi)) ** 2
    assert outputs(cam(), geneva(slots=slots, roller_radius="3 mm"))["geneva_jump"] == pytest.approx(jump, rel=2e-3)


def dwelling(**changes: Any) -> Calculation:
    """A cam-gear stepper that dwells as long as the Geneva drive with six slots."""
    return cam(dwell_angle="240 deg", **changes)


def test_at_the_limit_a_tenth_of_the_cycle_is_left_for_the_return() -> None:
    limit = outputs(cam(), geneva())["stop_sweep_limit"]
    assert np.degrees(limit) == pytest.approx(10.5, abs=1e-9)
    assert number(dwelling(sector_stop_sweep=f"{limit!r} rad"), "time_return") == pytest.approx(0.1, rel=1e-12)


@pytest.mark.parametrize("law", few(LAWS, keep=lambda law: law in ("modified_trapezoidal", "harmonic")))
def test_no_other_sweep_asks_for_less_acceleration_at_the_geneva_drives_dwell(law: str) -> None:
    together = outputs(cam(motion_law=law, dwell_angle="150 deg"), geneva())
    best, relative = together["stop_sweep_best"], 0.6**2 / (2 * np.pi)  # accelerations to S/T² from the gear's
    built = dwelling(motion_law=law, sector_stop_sweep=f"{best!r} rad")
    assert number(built, "gear_acceleration_peak") * relative == pytest.approx(together["best_acceleration"], rel=1e-9)
    assert number(built, "gear_speed_ratio_peak") == pytest.approx(together["best_velocity"], rel=1e-9)
    assert number(built, "time_return") == pytest.approx(together["best_return_time"], rel=1e-12)
    sweeps = np.linspace(0.3, 3, 41) * best
    base = inputs(CAM, STEPPER | {"dwell_angle": "240 deg", "motion_law": law, "n_points": 36})
    tried = calculate(CAM, base | {"sector_stop_sweep": sweeps}, variants=len(sweeps))["gear_acceleration_peak"][:, 0]
    assert tried.min() * relative >= together["best_acceleration"] * (1 - 1e-9)


def test_the_chart_of_all_sweeps_is_what_machines_with_them_do() -> None:
    """Stop and start ask for most where the sweep is narrow, the return where it is wide."""
    data = results(cam(dwell_angle="150 deg"), geneva())
    (chart,) = (figure for figure in data.figures if figure.id == "same_dwell")
    stopping, returning = chart.panels[0].lines
    (speed,) = chart.panels[1].lines
    for place, governing in ((0, stopping), (20, stopping), (120, returning), (180, returning)):
        built = dwelling(sector_stop_sweep=f"{governing.x[place]!r} rad", n_points=36)
        peak = number(built, "gear_acceleration_peak") * 0.6**2 / (2 * np.pi)
        assert governing.y[place] == max(stopping.y[place], returning.y[place]) == pytest.approx(peak, rel=1e-9)
        assert speed.y[place] == pytest.approx(number(built, "gear_speed_ratio_peak"), rel=1e-9)


@examples(25)
@given(slots=st.integers(3, 18), held=st.floats(20, 120))
def test_the_best_sweep_is_below_the_limit_for_any_number_of_slots(slots: int, held: float) -> None:
    together = outputs(
        cam(sector_dwell_sweep=held, sector_stop_sweep=held / 3, n_points=36),
        geneva(slots=slots, roller_radius="2 mm", n_points=36),
    )
    assert 0 < together["stop_sweep_best"] < together["stop_sweep_limit"]


NARROW = {"sector_stop_sweep": 2}
SMALLER, WITH_ITS_OWN, ALREADY = (
    "only with a smaller sweep of stop and start",
    "yes, with its sweep of stop and start",
    "it does already",
)


@pytest.mark.parametrize(
    ("changes", "slots", "is_gentle", "is_longer", "dwell"),
    [
        ({}, 6, True, True, SMALLER),
        ({}, 3, False, True, SMALLER),
        (NARROW, 3, False, True, WITH_ITS_OWN),
        (NARROW | {"dwell_angle": 250}, 8, True, False, ALREADY),
        ({"dwell_angle": 241, "sector_stop_sweep": 2.5, "motion_law": "parabolic"}, 6, False, False, ALREADY),
    ],
)
def test_the_verdict_follows_from_peaks_and_dwells(
    changes: dict[str, Any], slots: int, is_gentle: bool, is_longer: bool, dwell: str
) -> None:
    together = outputs(cam(**changes), geneva(slots=slots))
    assert (together["geneva_acceleration_peak"] <= together["cam_acceleration_peak"]) is is_gentle
    assert (together["dwell_ratio"] >= 1) is is_longer
    told = {
        (True, True): f"{HAS} lower peak acceleration and a longer dwell, but {JUMPS}",
        (False, True): f"{HAS} a longer dwell, but no lower peak acceleration, and {JUMPS}",
        (True, False): f"{HAS} lower peak acceleration, but a shorter dwell, and {JUMPS}",
        (False, False): f"{HAS} no lower peak acceleration and a shorter dwell, and {JUMPS}",
    }
    assert together["verdict"] == told[is_gentle, is_longer]
    assert together["dwell_verdict"] == dwell
    lower = {name for name in ("velocity", "torque") if together[f"{name}_ratio"] < 1}
    words = {("torque", "velocity"): "lower peak velocity and torque", ("velocity",): "lower peak velocity, but no lower torque",
             ("torque",): "lower peak torque, but no lower velocity", (): "no lower peak velocity and torque"}  # fmt: skip
    assert together["peaks_verdict"] == f"{HAS} {words[tuple(sorted(lower))]}"


def test_the_same_dwell_is_told_as_the_same() -> None:
    for changes, words in (({"sector_stop_sweep": 3}, "lower peak acceleration and the same dwell, but"),
                           ({"sector_stop_sweep": 3, "motion_law": "parabolic"}, "peak acceleration and the same dwell, ")):  # fmt: skip
        assert words in outputs(dwelling(**changes), geneva())["verdict"]


def test_a_press_with_both_drives_is_compared_and_one_with_a_single_drive_is_not(tmp_path: Path) -> None:
    stepper = "  s: {kind: cam_gear_transport, dwell_angle: 160, center_distance: 300}\n"
    cross = "  g: {kind: geneva_transport, center_distance: 200, roller_radius: 10}\n"

    def calculated(text: str) -> ResultsRecord:
        return Press.read(saved(tmp_path, HEAD + text), Discovery([])).calculate().results

    both = calculated(cross + stepper).comparisons
    (data,) = both.values()
    assert data.kind == "transport_comparison"
    assert [figure.id for figure in data.figures] == ["peaks", "cycle", "same_dwell"]
    assert data.outputs["cycle_basis"].value == "both drives have it"
    assert not calculated(cross).comparisons
