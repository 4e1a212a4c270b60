"""A press that is not that of the method, calculated a second time in plain NumPy: timing of the main shaft, slip of clutch and motor, bearings."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from diecut_report.formulas import Array
from diecut_report.press import Press
from diecut_report.results.mechanism_record import MechanismRecord
from tests.configs import DISCOVERY, saved

pytestmark = pytest.mark.nightly  # what it goes through is tested piece by piece in tests/mechanics/timing

FRAME, COUPLER, ROCKER = 4.6, 4.7, 2.2
RATE, SLOTS, MARGIN = 4500.0, 8, 4e-3  # sheets an hour, slots of the cross, s
THICKNESS, CLEARANCE = 0.5e-3, 20e-3
PRESS = f"""
schema_version: 1
project: {{title: Another press}}
press: {{name: Another, productivity: {RATE} 1/h, sheet: {{length: 620 mm, width: 430 mm, thickness: {THICKNESS * 1e3} mm}}}}
mechanisms:
  cylinder: {{kind: cylinder_sizing, working_length: 430 mm, segment_height: 36 mm, generatrix_length: 620 mm, bore_radius: 45 mm}}
  drive:
    kind: cylinder_drive
    frame_ratio: {FRAME}
    coupler_ratio: {COUPLER}
    rocker_ratio: {ROCKER}
    cylinder_radius: ${{cylinder.radius}}
    cylinder_length: ${{cylinder.generatrix_length}}
    cylinder_mass: ${{cylinder.mass}}
    cylinder_inertia: ${{cylinder.inertia}}
    static_unbalance: ${{cylinder.static_unbalance}}
    cutting_arc_fraction: ${{cylinder.cutting_arc_fraction}}
    material_thickness: ${{press.sheet.thickness}}
    cutting_force_per_length: 22 N/mm
    segment_height: ${{cylinder.segment_height}}
    carriage_clearance: {CLEARANCE * 1e3} mm
    crank_length: 90 mm
  cross: {{kind: geneva_transport, slots: {SLOTS}, center_distance: 220 mm, roller_radius: 12 mm, gear_ratio: 8, sprocket_teeth: 28,
    chain_pitch: 19.05 mm,
    driven_inertia: 2.9 kg*m**2}}
  timing:
    kind: cyclogram
    lines:
      - {{mechanism: drive, turns_per_sheet: 1/2, path_efficiency: 0.96}}
      - {{mechanism: cross, offset: auto, path_efficiency: 0.94, passing: [{{name: passing, from: 150 mm, to: 370 mm}}]}}
    interlocks:
      - {{name: rests, phase: drive.contact, within: cross.dwell, margin: {MARGIN * 1e3} ms}}
      - {{name: passes, phase: cross.passing, within: drive.carriage_window, margin: {MARGIN * 1e3} ms}}
  train:
    kind: drive_train
    motor_speed: 1420 rpm
    output_speed: ${{timing.main_shaft_speed}}
    torque_mean: ${{timing.torque_mean}}
    torque_peak: ${{timing.torque_peak}}
    torque_curve: ${{timing.main_shaft_torque}}
    torque_curve_turns: ${{timing.torque_curve_turns}}
    vbelt: {{section: SPA, driver_diameter: 112 mm, center_distance: 550 mm}}
    power_per_belt: 3 kW
    gears: [{{driver_teeth: 21, driven_teeth: 113}}]
    speed_fluctuation: 0.08
    flywheel_material: steel
  clutch:
    kind: clutch
    torque: ${{drive.crank_torque_peak}}
    speed: ${{train.output_speed}} / 2
    service_factor: 1.4
    shoe_radius: 170 mm
    wedge_angle: 10 deg
    wedge_friction: 0.1
    shoe_friction: 0.35
    allowable_pressure: 0.3 MPa
    driven_inertia: 9 kg*m**2
    engagements_per_hour: 30 1/h
  pins:
    kind: rolling_bearing
    bearings:
      - {{name: crank, type: roller, designation: NU2206E, radial_force: "${{drive.coupler_force}}", speed: "${{drive.crank_speed}}"}}
      - {{name: rocker, type: roller, designation: NU2206E, radial_force: "${{drive.coupler_force}}", relative_angle: "${{drive.transmission_angle}}",
         cycle_speed: "${{drive.crank_speed}}"}}
"""
TURN = 2 * np.pi


@pytest.fixture(scope="module")
def press(tmp_path_factory: pytest.TempPathFactory) -> dict[str, MechanismRecord]:
    results = Press.read(saved(tmp_path_factory.mktemp("another"), PRESS), DISCOVERY).calculate().results
    assert all(each.status != "error" for each in results.mechanisms.values()), results
    return results.mechanisms


def out(press: dict[str, MechanismRecord], name: str) -> float:
    home, _, own = name.partition(".")
    return float(press[home].outputs[own].value)


def given(press: dict[str, MechanismRecord], name: str) -> float:
    home, _, own = name.partition(".")
    return float(press[home].inputs[own].value)


# --- the linkage, from nothing but its lengths --------------------------------------------------------------------------------


def rocker(phi: Array) -> Array:
    """Angle of the rocker about its pivot at (FRAME, 0), the joint above the line of the frame."""
    x, y = np.cos(phi) - FRAME, np.sin(phi)
    distance = np.hypot(x, y)
    inner = np.arccos((ROCKER**2 + distance**2 - COUPLER**2) / (2 * ROCKER * distance))
    return np.asarray(np.unwrap(np.arctan2(y, x) - inner))


def dead_centres() -> tuple[float, float]:
    """Crank angles of both ends of the travel: the crank in line with the coupler, beyond it and over it."""
    outer = np.arccos(((COUPLER + 1) ** 2 + FRAME**2 - ROCKER**2) / (2 * (COUPLER + 1) * FRAME))
    inner = np.pi + np.arccos(((COUPLER - 1) ** 2 + FRAME**2 - ROCKER**2) / (2 * (COUPLER - 1) * FRAME))
    return float(outer), float(inner)


def rotation(phi: Array) -> Array:
    """Rotation of the cylinder from its outer end, which the whole swing turns once."""
    outer, inner = dead_centres()
    ends = rocker(np.linspace(outer, inner, 20001))
    swung = np.mod(rocker(phi) - ends[0] + np.pi, TURN) - np.pi
    return np.asarray(np.abs(swung) * TURN / abs(ends[-1] - ends[0]))


def edges(low: float, high: float) -> list[tuple[float, float]]:
    """Crank angles between which the rotation lies within two bounds, one interval a stroke."""
    outer, inner = dead_centres()
    found = []
    for start, end in ((outer, inner), (inner, outer + TURN)):
        phi = np.linspace(start, end, 400_001)
        inside = phi[(rotation(phi) >= low) & (rotation(phi) <= high)]
        found.append((float(inside[0]), float(inside[-1])))
    return found


def contact(radius: float) -> list[tuple[float, float]]:
    """Main-shaft angles in which the cylinder touches the board."""
    return [(2 * a, 2 * b) for a, b in edges(*arc(THICKNESS, radius))]


def arc(depth: float, radius: float) -> tuple[float, float]:
    """Rotations between which the flat's corner is deeper than something; the segment is 36 mm high."""
    angle = np.arccos(1 - 36e-3 / radius) - np.arccos(1 - depth / radius)
    return float(angle), float(TURN - angle)


def window(radius: float) -> list[tuple[float, float]]:
    """Main-shaft angles in which the flat leaves a carriage its height, about each end."""
    low, high = arc(CLEARANCE, radius)
    (a, b), (c, d) = edges(low, high)
    return [(2 * b, 2 * c), (2 * d, 2 * (a + TURN))]


def best_slack(inner: list[tuple[float, float]], moving: Any, shifts: Array, moved_is_inner: bool) -> Array:
    """Least margin above the required one for each shift, by trying all copies of all intervals."""
    needed = MARGIN * RATE / 3600 * TURN
    outer, own = (inner, moving) if moved_is_inner else (moving, inner)
    least = np.full(shifts.shape, np.inf)
    for a, b in own:
        best = np.full(shifts.shape, -np.inf)
        for c, d in outer:
            for turn in range(-3, 4):
                start, end = (a + shifts - c, d - b - shifts) if moved_is_inner else (a - c - shifts, d + shifts - b)
                shift = turn * 2 * TURN
                pair = np.minimum(start + shift, end - shift)
                best = np.maximum(best, pair)
        least = np.minimum(least, best - needed)
    return np.asarray(least)


def test_the_automatic_offset_and_its_slack_are_those_of_trying_all(press: dict[str, MechanismRecord]) -> None:
    radius = out(press, "cylinder.radius")
    half = np.pi / 2 - np.pi / SLOTS
    shifts = np.linspace(0, TURN, 72_001)
    dwell = [(half + k * TURN, TURN - half + k * TURN) for k in range(2)]
    slack = best_slack(contact(radius), dwell, shifts, moved_is_inner=False)
    own = passing(press)
    slack = np.minimum(
        slack,
        best_slack(
            window(radius), [(own[0] + k * TURN, own[1] + k * TURN) for k in range(2)], shifts, moved_is_inner=True
        ),
    )
    best = int(np.argmax(slack))
    assert out(press, "timing.best_margin") == pytest.approx(slack[best], abs=3e-4)
    assert out(press, "timing.line_offset.1") == pytest.approx(shifts[best], abs=3e-4)


def passing(press: dict[str, MechanismRecord]) -> tuple[float, float]:
    """Crank angles of the cross between which the sheet goes from 150 to 370 mm of its step, by the cross's closed form."""
    phi = np.linspace(-(np.pi / 2 - np.pi / SLOTS), np.pi / 2 - np.pi / SLOTS, 400_001)
    ratio = np.sin(np.pi / SLOTS)
    turned = np.arctan2(ratio * np.sin(phi), 1 - ratio * np.cos(phi)) + np.pi / SLOTS
    step = 28 * 19.05e-3  # eight to one: a turn of the sprocket each step
    way = turned / (TURN / SLOTS) * step
    assert out(press, "cross.sheet_step") == pytest.approx(step)
    return float(np.interp(0.150, way, phi)), float(np.interp(0.370, way, phi))


def test_the_torques_add_up_on_the_main_shaft(press: dict[str, MechanismRecord]) -> None:
    """Of each line's own curve, with the losses of its way by the sense of the power."""
    grid = (np.arange(20_000) + 0.5) / 20_000 * 2 * TURN
    total = np.zeros_like(grid)
    for name, curve, turns, efficiency, offset in (
        ("drive", "crank_torque", 0.5, 0.96, 0.0),
        ("cross", "torque", 1.0, 0.94, out(press, "timing.line_offset.1")),
    ):
        angle, torque = (np.array(press[name].curves[key].values) for key in ("crank_angle", curve))
        own = np.interp(np.mod((grid - offset) * turns - angle[0], TURN) + angle[0], angle, torque)
        total += turns * own * efficiency ** -np.sign(own)
    assert out(press, "timing.torque_mean") == pytest.approx(total.mean(), rel=5e-3)
    assert out(press, "timing.torque_rms") == pytest.approx(np.sqrt(np.mean(total**2)), rel=5e-3)
    excess = np.cumsum(total - total.mean()) * (grid[1] - grid[0])
    assert out(press, "timing.energy_fluctuation") == pytest.approx(np.ptp(excess), rel=5e-3)


def test_the_inertia_of_equal_heat_is_that_of_stepping_through_the_slip(press: dict[str, MechanismRecord]) -> None:
    phi = np.linspace(0, 2 * TURN, 80_001)
    theta = rotation(phi)
    mass, inertia, unbalance = (out(press, f"cylinder.{name}") for name in ("mass", "inertia", "static_unbalance"))
    radius = out(press, "cylinder.radius")
    reduced = (inertia + mass * radius**2 + 2 * radius * unbalance * np.cos(theta)) * np.gradient(theta, phi) ** 2
    assert out(press, "press_consistency.crank_inertia_max") == pytest.approx(reduced.max(), rel=1e-4)
    assert out(press, "press_consistency.crank_inertia_mean") == pytest.approx(reduced[:40_000].mean(), rel=1e-4)
    torque, speed = given(press, "press_consistency.clutch_torque"), given(press, "press_consistency.clutch_speed")
    heats = [heat(phi, reduced, start, torque, speed) for start in range(0, 40_000, 100)]
    worst = max(heats)
    assert out(press, "press_consistency.slip_heat") == pytest.approx(worst, rel=2e-3)
    assert out(press, "press_consistency.equal_inertia") == pytest.approx(2 * worst / speed**2, rel=2e-3)


def heat(phi: Array, reduced: Array, start: int, torque: float, speed: float) -> float:
    """Heat of an engagement from rest: the work of the clutch by what the driving side runs ahead."""
    way = phi[start + 1 :] - phi[start]
    reached = torque * way >= reduced[start + 1 :] * speed**2 / 2  # the crank is as fast as the driving side
    if not reached.any() or reached[0]:
        return 0.0
    end = int(np.argmax(reached))
    root = np.sqrt(np.concatenate([[0.0], way[: end + 1]]))  # of the way, in which the motion from rest is even
    inertia = np.interp(phi[start] + (root[1:] + root[:-1]) ** 2 / 4, phi, reduced)
    time = float(np.sum(np.sqrt(2 * inertia / torque) * np.diff(root)))
    return torque * (speed * time - float(way[end]))


def test_the_motor_is_loaded_as_its_harmonics_are_damped(press: dict[str, MechanismRecord]) -> None:
    curve = press["train"].curves["flywheel_torque"]
    angle = np.array(press["train"].curves["output_angle"].values)
    load = np.array(curve.values)
    even = np.arange(8192) / 8192 * (angle[-1] - angle[0]) + angle[0]
    spectrum = np.fft.rfft(np.interp(even, angle, load))
    k = given(press, "press_consistency.motor_rated_torque") / (
        given(press, "press_consistency.synchronous_speed") - given(press, "press_consistency.motor_speed")
    )
    belt, loss = given(press, "press_consistency.belt_ratio"), given(press, "press_consistency.belt_efficiency")
    lag = given(press, "press_consistency.flywheel_inertia") / (k * belt**2 * loss)
    period = 2 * TURN / given(press, "press_consistency.output_speed")
    damped = spectrum / (1 + 1j * TURN / period * np.arange(len(spectrum)) * lag)
    motor = np.fft.irfft(damped, 8192) / (belt * loss)
    assert out(press, "press_consistency.motor_torque_rms") == pytest.approx(np.sqrt(np.mean(motor**2)), rel=3e-3)
    assert out(press, "press_consistency.motor_torque_max") == pytest.approx(motor.max(), rel=5e-3)


def test_the_lives_of_both_pins_are_those_of_dense_sums(press: dict[str, MechanismRecord]) -> None:
    """Dynamic rating 48.9 kN, exponent 10/3; the rocker's pin counts by the way of its angle."""
    curves = press["drive"].curves
    phi, force, angle = (
        np.array(curves[name].values) for name in ("crank_angle", "coupler_force", "transmission_angle")
    )
    middle = np.abs(force[1:] + force[:-1]) / 2
    for name, weight, turns in (
        ("crank", np.diff(phi), 1.0),
        ("rocker", np.abs(np.diff(angle)), np.abs(np.diff(angle)).sum() / TURN),
    ):
        mean = (np.sum(middle ** (10 / 3) * weight) / weight.sum()) ** 0.3
        life = (48_900 / mean) ** (10 / 3) * 1e6 / (RATE / 2 / 3600 * turns)
        assert out(press, f"pins.{name}_equivalent_load") == pytest.approx(mean, rel=3e-3)
        assert out(press, f"pins.{name}_life") == pytest.approx(life, rel=1e-2)
