"""The engagement of the clutch against the inertia of the cylinder's drive, by plain code over one machine or many."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import Curve
from diecut_report.mechanics.timing.engagement import Inertia, SlippingClutch, inertia_at_crank, slip, worst_slip
from diecut_report.mechanics.timing.legendre_pieces import LegendrePieces, split, unique_edges

Array = NDArray[np.float64]
TURN = 2 * np.pi
INERTIA = ("cylinder_inertia", "cylinder_mass", "cylinder_radius", "static_unbalance", "crank_speed", "dead_center_outer",
           "dead_center_inner", "clutch_torque", "clutch_load", "clutch_speed")  # fmt: skip
TAKES = ("cylinder_rotation", "cylinder_speed", *INERTIA)

Result = Callable[
    [Inertia, Array, SlippingClutch, float], float
]  # of inertia, dead centres, clutch, and the angle of the engagement


def worst_angle(rotation: Curve, speed: Curve, *numbers: Array) -> Array:
    """Crank angle of the engagement with most heat."""
    unknown = np.zeros_like(numbers[0])
    return _each(
        rotation, speed, (*numbers, unknown), lambda i, ends, clutch, _: worst_slip(i, ends, clutch).engagement_angle
    )


def slip_time(rotation: Curve, speed: Curve, *numbers: Array) -> Array:
    """Time of the slip from the angle of the engagement, the last of the numbers."""
    return _each(rotation, speed, numbers, lambda i, ends, clutch, angle: slip(i, ends, clutch, angle).time)


def driven_angle(rotation: Curve, speed: Curve, *numbers: Array) -> Array:
    """Angle that the crank turns while the clutch slips, from the angle of the engagement, the last of the numbers."""
    return _each(rotation, speed, numbers, lambda i, ends, clutch, angle: slip(i, ends, clutch, angle).driven_angle)


def _each(rotation: Curve, speed: Curve, numbers: tuple[Array, ...], result: Result) -> Array:
    """A number of each machine; none where its clutch does not accelerate, which is impossible."""
    found = []
    for row, machine in enumerate(np.hstack(numbers)):
        *cylinder, crank_speed, outer, inner, torque, load, over, angle = (float(number) for number in machine)
        inertia, clutch = _inertia(rotation, speed, cylinder, crank_speed, row), SlippingClutch(torque, load, over)
        found.append(result(inertia, np.array([outer, inner]), clutch, angle) if clutch.net > 0 else np.nan)
    return np.array(found)[:, None]


def _inertia(rotation: Curve, speed: Curve, cylinder: list[float], crank_speed: float, row: int) -> Inertia:
    """The inertia at the crank as a series on the smooth pieces of its turn: sampled once, never below zero."""
    rows = np.array([row])
    edges = np.concatenate([curve.breakpoints[min(row, len(curve.breakpoints) - 1)] for curve in (rotation, speed)])

    def at(share: Array, middle: Array) -> Array:
        turned, rate = (curve.values(share[None], middle[None], rows)[0] for curve in (rotation, speed))
        found: Array = inertia_at_crank(*cylinder, turned, rate / crank_speed)
        return found

    series = LegendrePieces.of(at, split(unique_edges(edges, 0.0, 1.0), 1 / 16))
    return lambda angle: np.maximum(series.at(angle / TURN % 1), 0.0)
