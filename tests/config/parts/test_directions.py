"""The forces of mechanisms on their shafts act where they do in the frame: their moment about the axis is the torque there."""

from __future__ import annotations

from dataclasses import replace
from math import atan2, hypot

import numpy as np
import pytest

from diecut_report.config.loader import examined
from diecut_report.config.yaml import parse
from diecut_report.formulas import Array
from diecut_report.results.press_run import Run
from tests.config.parts.test_parts import DISCOVERY, FILE, TEXT

KINDS = ("cylinder_sizing", "cylinder_drive", "geneva_transport", "cyclogram", "shaft_body", "drive_line", "shaft_loads")
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


def force_on(run: Run, shaft: str, part: str) -> tuple[Array, Array]:
    """Its components in the frame, shape (points,), of all curves that make them up."""
    loads = run.calculations[f"shafts_{shaft}_loads"]
    names = [name for name in loads.curves if name.startswith(f"{part}_") and name.endswith("_force")]
    y, z = (
        sum(loads.curve_samples(name)[0] for name in names if name.endswith(f"{axis}_force")) + 0.0 for axis in "yz"
    )
    return y, z


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


@pytest.mark.parametrize("frame", FRAMES)
def test_the_rollers_force_has_the_moment_of_the_torque_about_both_axes(frame: str) -> None:
    run = run_in(frame)
    right, up = roller(run, "main")
    along, across = force_on(run, "main", "disc")
    torque = run.calculations["shafts_main_loads"].curve_samples("disc_torque")[0]
    assert np.abs(torque).max() > 900
    np.testing.assert_allclose(right * across - up * along, torque, atol=1e-6 * np.abs(torque).max())

    (x, y), (u, v) = axis_of(run, "main"), axis_of(run, "geneva")
    right, up = roller(run, "geneva")
    along, across = force_on(run, "geneva", "cross")
    driving = run.calculations["shafts_geneva_loads"].curve_samples("balance")[0]
    assert np.abs(driving).max() > 1200
    moment = (x + right - u) * across - (y + up - v) * along
    np.testing.assert_allclose(moment, driving, atol=1e-6 * np.abs(driving).max())
