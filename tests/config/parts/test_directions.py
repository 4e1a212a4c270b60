"""The loads of shafts by their own statics: the moment of a force about the axis is the torque there, and a motor lags behind its flywheel."""

from __future__ import annotations

from dataclasses import replace
from math import atan2, hypot

import numpy as np
import pytest

from diecut_report.config.loader import examined
from diecut_report.config.yaml import parse
from diecut_report.formulas import Array
from diecut_report.results.press_run import Run
from tests.config.parts.machines import DISCOVERY, FILE, TEXT
from tests.examples import every, few

KINDS = (
    "cylinder_sizing", "cylinder_drive", "geneva_transport", "cyclogram", "shaft_body", "drive_line", "shaft_loads", "roller_chain",
    "drive_train",
)  # fmt: skip
GENEVA = "geneva: [180, 240], conveyor: [180, 520], far: [2180.254, 520]"
FRAMES = {
    "above": GENEVA,
    "below": "geneva: [180, -240], conveyor: [180, -520], far: [2180.254, -520]",
    "beside": "geneva: [420, 0], conveyor: [700, 0], far: [2700.254, 0]",
    "oblique": "geneva: [36, 192], conveyor: [-132, 416], far: [1868.254, 416]",
}


def run_in(frame: str) -> Run:
    """The example's loads with its Geneva wheel elsewhere."""
    config, problems = examined(parse(TEXT.replace(GENEVA, FRAMES[frame], 1), str(FILE)), DISCOVERY)
    assert not problems
    names = {name for name, own in config.instances.items() if own and own.mechanism and own.mechanism.kind in KINDS}
    order = tuple(node for node in config.order if node[0] in names or len(node) > 1 or node == ("press",))
    return Run(replace(config, order=order), lambda _: None)


SENSES = {
    "main": -1,
    "geneva": 1,
    "rocker": 1,
    "crank": 1,
    "pinion": -1,
}  # the crank of the drive is seen turning anticlockwise


def force_on(run: Run, shaft: str, part: str) -> tuple[Array, Array]:
    """Its components in the frame, shape (points,), of all curves that make them up."""
    loads = run.calculations[f"shafts_{shaft}_loads"]
    names = [name for name in loads.curves if name.startswith(f"{part}_") and name.endswith("_force")]
    y, z = (
        sum(loads.curve_samples(name)[0] for name in names if name.endswith(f"{axis}_force")) + 0.0 for axis in "yz"
    )
    return y, SENSES[shaft] * z


def axis_of(run: Run, shaft: str) -> tuple[float, float]:
    assert run.config.parts is not None
    return run.config.parts.axes[shaft]


def roller(run: Run, shaft: str) -> tuple[Array, Array]:
    """Its place from the main shaft's axis, at the samples of a shaft's loads.

    The main shaft turns against the crank of the drive, which is seen turning anticlockwise.
    """
    (x, y), (u, v) = axis_of(run, "main"), axis_of(run, "geneva")
    main = run.calculations[f"shafts_{shaft}_loads"].curve_samples("main_angle")[0]
    angle = atan2(v - y, u - x) - (main - run.calculations["timing"]["line_offset"][0, 1])
    radius = hypot(u - x, v - y) / 2
    return radius * np.cos(angle), radius * np.sin(angle)


LOST = 0.95  # the cyclogram's path_efficiency of the Geneva drive


@pytest.mark.parametrize("frame", few(FRAMES, keep=lambda frame: frame == "oblique"))
def test_the_rollers_force_has_the_moment_of_the_torque_about_both_axes(frame: str) -> None:
    run = run_in(frame)
    right, up = roller(run, "main")
    along, across = force_on(run, "main", "disc")
    torque = run.calculations["shafts_main_loads"].curve_samples("disc_torque")[0] * SENSES["main"]
    torque *= np.where(torque * SENSES["main"] < 0, LOST, 1 / LOST)  # what is lost between the shaft and the roller
    assert np.abs(torque).max() > 900
    np.testing.assert_allclose(right * across - up * along, torque, atol=1e-6 * np.abs(torque).max())

    (x, y), (u, v) = axis_of(run, "main"), axis_of(run, "geneva")
    right, up = roller(run, "geneva")
    along, across = force_on(run, "geneva", "cross")
    driving = run.calculations["shafts_geneva_loads"].curve_samples("balance")[0] * SENSES["geneva"]
    assert np.abs(driving).max() > 1200
    moment = (x + right - u) * across - (y + up - v) * along
    np.testing.assert_allclose(moment, driving, atol=1e-6 * np.abs(driving).max())


@pytest.mark.parametrize(
    ("driver", "driven"),
    every(2, [(("main", "pinion"), ("crank", "wheel")), (("rocker", "sector"), ("pinion", "pinion"))]),
)
def test_teeth_push_each_other_apart_with_one_force(driver: tuple[str, str], driven: tuple[str, str]) -> None:
    """By the tangential force of the torque, and the radial one away from the mate, in the frame."""
    run, forces = run_in("above"), []
    for shaft, part in (driver, driven):
        loads, gear = run.calculations[f"shafts_{shaft}_loads"], _gear(run, shaft, part)
        name = f"{part}_torque" if f"{part}_torque" in loads.curves else "balance"
        pull, angle = loads.curve_samples(name)[0] / gear["radius"], gear["angle"]
        push = np.abs(pull) * np.tan(np.radians(20))
        y, z = -pull * np.sin(angle) - push * np.cos(angle), pull * np.cos(angle) - push * np.sin(angle)
        forces.append(np.array([y, SENSES[shaft] * z]))
    size = np.hypot(*forces[0])
    assert size.max() > 4000
    strong = size > 0.05 * size.max()
    ratio = -np.sum(forces[0] * forces[1], axis=0)[strong] / size[strong] ** 2  # 1 but for the losses
    # of a shaft that swings the inertia is in the torque, and losses count as if it drove throughout, also where it brakes
    most = 1.035 if shaft == "crank" else 1.2
    assert ratio.min() > 0.93 and ratio.max() < most
    across = np.abs(forces[0][0] * forces[1][1] - forces[0][1] * forces[1][0])[strong]
    np.testing.assert_allclose(across / size[strong] ** 2, 0, atol=1e-9)


def _gear(run: Run, shaft: str, part: str) -> dict[str, float]:
    """The pitch radius of a gear, m, and where its mate stands, rad."""
    assert run.config.parts is not None
    load = next(each for each in run.config.tree.data["mechanisms"][f"shafts_{shaft}"]["loads"] if each["name"] == part)
    join = next(
        each
        for each in run.config.parts.joins
        if any(gear.called == f"{shaft}.{part}" for gear in (*each.drivers, *each.driven))
    )
    gear = next(each for each in (*join.drivers, *join.driven) if each.called == f"{shaft}.{part}")
    angle = load["gear"]["mesh_angle"]
    degrees = (angle["value"] if isinstance(angle, dict) else angle).split()[0]
    return {"radius": join.radius(gear), "angle": float(np.radians(float(degrees)))}


HELICAL = "teeth: 120/20, module: 3.5, width: 30, helix_angle: {angle} deg"


@pytest.mark.nightly
@pytest.mark.parametrize("angle", few([28.955, -28.955], keep=lambda angle: angle < 0))
def test_the_bearing_that_locates_a_shaft_takes_the_axial_force_of_its_helical_gear(angle: float) -> None:
    """By F_a = T / r tan β of the torque at each instant; a right-handed driver is pushed against the sense of its torque."""
    text = TEXT.replace("teeth: 120/20, module: 4, width: 30", HELICAL.format(angle=angle))
    config, problems = examined(parse(text, str(FILE)), DISCOVERY)
    assert text != TEXT and not problems
    kinds = (*KINDS, "shaft", "rolling_bearing")
    names = {name for name, own in config.instances.items() if own and own.mechanism and own.mechanism.kind in kinds}
    names -= {name for name in names if not name.startswith("shafts_conveyor") and config.kinds[name] in kinds[-2:]}
    order = tuple(node for node in config.order if node[0] in names or len(node) > 1 or node == ("press",))
    run = Run(replace(config, order=order), lambda _: None)
    torque = run.calculations["shafts_conveyor_loads"].curve_samples("balance")[0]
    radius = 3.5e-3 * 20 / 2 / np.cos(np.radians(angle))
    expected = np.max(np.abs(torque)) / radius * np.tan(np.radians(abs(angle)))
    bearings = run.calculations["shafts_conveyor_bearings"]
    assert bearings["axial_greatest"][0] == pytest.approx([expected, 0.0], rel=1e-3)
    assert expected > 1000
    load = next(each for each in config.tree.data["mechanisms"]["shafts_conveyor"]["loads"] if each["name"] == "small")
    # along the shaft F_x = F_t tan β, positive where a left-handed gear is turned from y to z, which are mirrored where the shaft is seen to turn
    # clockwise; the driven gear is left-handed where the driver is right-handed
    typed = load["gear"]["helix_angle"]
    assert float((typed["value"] if isinstance(typed, dict) else typed).split()[0]) == pytest.approx(
        -SENSES["geneva"] * angle
    )


@pytest.mark.nightly
def test_the_couplers_force_has_the_moment_of_the_torque_about_the_rockers_axis() -> None:
    run = run_in("above")
    loads = run.calculations["shafts_rocker_loads"]
    crank = loads.curve_samples("main_angle")[0] / 2
    frame, coupler, rocker = 0.5, 0.5, 0.205
    to_pin = np.array([0.1 * np.cos(crank) - frame, 0.1 * np.sin(crank)])
    distance = np.hypot(*to_pin)
    # the rocker lies from the crank's pin, seen from its own axis, by the angle of the triangle
    angle = np.arctan2(to_pin[1], to_pin[0]) - np.arccos(
        (rocker**2 + distance**2 - coupler**2) / (2 * rocker * distance)
    )
    along, across = force_on(run, "rocker", "arm")
    moment = rocker * (np.cos(angle) * across - np.sin(angle) * along)
    driving = loads.curve_samples("balance")[0]
    assert np.abs(driving).max() > 1900
    np.testing.assert_allclose(moment, driving, atol=1e-6 * np.abs(driving).max())


@pytest.mark.nightly
def test_the_motor_drives_the_pulley_with_what_a_first_order_lag_leaves_of_the_load() -> None:
    run = run_in("above")
    loads, train = run.calculations["shafts_flywheel_loads"], run.calculations["train"]
    load, motor = (loads.curve_samples(f"{name}_torque")[0] for name in ("pinion", "large"))
    main = loads.curve_samples("main_angle")[0]
    load, motor, main = load[:-1], motor[:-1], main[:-1]  # the end is the start again
    speed = run.calculations["drive_line"]["reference_speed"][0, 0]
    time_constant = train["motor_time_constant"][0, 0]
    assert time_constant == pytest.approx(
        train["flywheel_inertia"][0, 0] / (train["motor_rated_torque"][0, 0] / (50 * np.pi / 30) * 9 * 0.95), rel=0.05
    )
    rates = np.fft.fftfreq(len(load), (main[1] - main[0]) / (2 * np.pi)) * speed
    expected = np.fft.ifft(np.fft.fft(load) / (1 + 1j * rates * time_constant)).real
    assert np.ptp(expected) > 0.1 * np.ptp(load)
    np.testing.assert_allclose(-motor, expected, atol=0.01 * np.ptp(load))
    assert np.mean(motor) == pytest.approx(-np.mean(load), rel=5e-3)
    assert np.abs(loads.curve_samples("balance")[0]).max() > np.abs(motor).max()  # most of it the flywheel gives
