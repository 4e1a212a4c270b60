"""The engagement of the clutch against the inertia of the cylinder's drive, by plain code over one machine or many."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from diecut_report.mechanics.timing.engagement import Slip, SlippingClutch, inertia_at_crank, slip, worst_slip
from diecut_report.mechanics.timing.shaft_curves import PieceRows

ONE_SHAFT = (
    0.1  # share by which the driving side of a clutch on the crank's shaft may be faster or slower than the crank
)
SAME = 1e-6  # relative difference of two speeds that are one
TURN = 2 * np.pi
CYLINDER = ("cylinder_inertia", "cylinder_mass", "cylinder_radius", "static_unbalance", "shafts_inertia")
CLUTCH = ("clutch_torque", "clutch_load", "clutch_speed", "clutch_ratio")
TAKES = (
    "cylinder_rotation",
    "cylinder_speed",
    "crank_speed",
    "dead_center_outer",
    "dead_center_inner",
    *CYLINDER,
    *CLUTCH,
)
PIECES = 16  # of a turn of the crank, at least
TOGETHER = 64  # machines whose engagements are tried together, as each takes many places


def engagement(given: Mapping[str, Any]) -> Slip:
    """Return the engagement of each machine, at the angle that is given, else the one with most heat; shapes (machines,)."""
    series = _inertia(given)
    parts = np.array_split(np.arange(series.count), -(-series.count // TOGETHER))
    found = [_of_part(given, series, part) for part in parts]
    return Slip(*(np.concatenate([getattr(each, name) for each in found]) for name in Slip.__dataclass_fields__))


def _of_part(given: Mapping[str, Any], series: PieceRows, machines: Any) -> Slip:
    """The engagements of some of the machines: of a clutch on another shaft, as of one at the crank."""

    def inertia(angle: Any, machine: Any) -> Any:
        return np.maximum(series.at(angle / TURN % 1, machines[machine]), 0.0)

    torque, load, speed, ratio = (given[name][machines, 0] for name in CLUTCH)
    clutch = SlippingClutch(torque * ratio, load * ratio, speed / ratio)
    ends = np.concatenate([given["dead_center_outer"], given["dead_center_inner"]], axis=1)[machines]
    if "engagement_angle" in given:
        return slip(inertia, ends, clutch, given["engagement_angle"][machines, 0])
    return worst_slip(inertia, ends, clutch)


def _inertia(given: Mapping[str, Any]) -> PieceRows:
    """The inertia at the crank as series on the smooth pieces of its turn: sampled once."""
    rotation, speed = given["cylinder_rotation"], given["cylinder_speed"]
    numbers = [given[name] for name in CYLINDER]
    count = len(given["crank_speed"])

    def at(share: Any, middle: Any, machine: Any) -> Any:
        turned, rate = (curve.values(share, middle, machine) for curve in (rotation, speed))
        return inertia_at_crank(*(number[machine] for number in numbers), turned, rate / given["crank_speed"][machine])

    places = [np.broadcast_to(curve.breakpoints, (count, curve.breakpoints.shape[1])) for curve in (rotation, speed)]
    return PieceRows.of(at, np.concatenate(places, axis=1), PIECES)
