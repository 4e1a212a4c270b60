"""A friction clutch that starts a crank drive from rest: the inertia it feels changes with the crank angle while it slips."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from diecut_report.expressions import Array, formula
from diecut_report.mechanics.timing.legendre_pieces import NODES, WEIGHTS

TURN = 2 * np.pi
AT = 1e-9  # rad from a dead centre that is none
LOOKS = 41  # places up to the next dead centre at which the end of a slip is looked for
CLOSER = 33  # places of a closer look at it
NESTED = 6  # times that it is looked at closer
STARTS = 48  # engagement angles that are tried over a turn
ZOOMS = 5  # times that the worst of them is looked at closer
ACROSS = 17  # places of a closer look
PIECES = 3  # of a slip, in which its time is integrated
_SHARES = ((np.arange(PIECES)[:, None] + (NODES + 1) / 2) / PIECES).ravel()
_PARTS = np.tile(WEIGHTS / 2 / PIECES, PIECES)

Inertia = Callable[[Array], Array]  # kg·m² at crank angles (rad) of any shape, with the period 2π


@formula
def inertia_at_crank(
    cylinder_inertia: Any,
    cylinder_mass: Any,
    cylinder_radius: Any,
    static_unbalance: Any,
    rotation: Any,
    speed_ratio: Any,
) -> Any:
    """Inertia of the rolling cylinder that its crank feels, with the unbalance: of equal kinetic energy.

    ``rotation`` is counted from where the flat is down, ``speed_ratio`` is the cylinder's speed to the crank's.
    """
    rolling = cylinder_inertia + cylinder_mass * cylinder_radius**2
    swinging = 2 * cylinder_radius * static_unbalance * np.cos(rotation)
    return (rolling + swinging) * speed_ratio**2


@dataclass(frozen=True)
class SlippingClutch:
    """Hold the torque of a slipping clutch, the load's torque below it (N·m), and the speed of its driving side (rad/s)."""

    torque: float
    load: float
    speed: float

    @property
    def net(self) -> float:
        """Return the torque that accelerates."""
        return self.torque - self.load


@dataclass(frozen=True)
class Slip:
    """Hold an engagement: the crank angle where it begins (rad), and what follows until the slip ends.

    Time (s), angle driven (rad), lag of the driven side (rad), heat (J), and the constant inertia of equal heat (kg·m²).
    """

    engagement_angle: float
    time: float
    driven_angle: float
    lag: float
    heat: float
    equal_inertia: float


def slip(inertia: Inertia, dead_centers: Array, clutch: SlippingClutch, engagement_angle: float) -> Slip:
    """Return the engagement from rest at a crank angle (rad).

    ``dead_centers`` are the crank angles where the inertia is zero: there the slip has always ended. ValueError where the clutch
    has no more torque than the load, so that the slip never ends.
    """
    angle = np.array([engagement_angle])
    driven = _driven_angles(inertia, dead_centers, clutch, angle)
    time = _times(inertia, clutch, angle, driven)
    return _told(clutch, engagement_angle, float(driven[0]), float(time[0]))


def worst_slip(inertia: Inertia, dead_centers: Array, clutch: SlippingClutch) -> Slip:
    """Return the engagement from rest with the greatest heat, of all crank angles; ValueError as for ``slip``."""
    low, high, places = 0.0, TURN, STARTS + 1
    for _ in range(1 + ZOOMS):
        angles = np.linspace(low, high, places)
        driven = _driven_angles(inertia, dead_centers, clutch, angles)
        heats = clutch.speed * _times(inertia, clutch, angles, driven) - driven
        best, step = angles[int(np.argmax(heats))], angles[1] - angles[0]
        low, high, places = best - step, best + step, ACROSS
    return slip(inertia, dead_centers, clutch, float(best % TURN))


def _told(clutch: SlippingClutch, start: float, driven: float, time: float) -> Slip:
    lag = clutch.speed * time - driven
    heat = clutch.torque * lag
    return Slip(start, time, driven, lag, heat, 2 * heat * clutch.net / (clutch.torque * clutch.speed**2))


def _driven_angles(inertia: Inertia, dead_centers: Array, clutch: SlippingClutch, starts: Array) -> Array:
    """The angle after each start (starts,) at which the driven side first has the speed of the driving side."""
    if clutch.net <= 0:
        raise ValueError(
            f"a clutch with {clutch.torque:g} N·m does not accelerate against a load of {clutch.load:g} N·m"
        )
    ahead = (dead_centers - starts[:, None]) % TURN
    longest = np.where(ahead > AT, ahead, TURN).min(axis=1, keepdims=True)
    low, high = np.zeros_like(longest), longest
    for looks in (LOOKS, *(CLOSER,) * NESTED):
        driven = low + (high - low) * np.linspace(0, 1, looks)
        ended = clutch.net * driven >= inertia(starts[:, None] + driven) * clutch.speed**2 / 2
        ended[:, -1] = True
        first = np.argmax(ended, axis=1)[:, None]
        low, high = (np.take_along_axis(driven, each, axis=1) for each in (np.maximum(first - 1, 0), first))
    found: Array = (low + high)[:, 0] / 2
    return found


def _times(inertia: Inertia, clutch: SlippingClutch, starts: Array, driven: Array) -> Array:
    """The time of each slip, ∫dφ/ω with φ = start + s²; up to a dead centre the root of the inertia is smooth."""
    ends = np.sqrt(driven)[:, None]
    places = ends * _SHARES
    rate = np.sqrt(2 * inertia(starts[:, None] + places**2) / clutch.net)
    found: Array = ends[:, 0] * (rate @ _PARTS)
    return found
