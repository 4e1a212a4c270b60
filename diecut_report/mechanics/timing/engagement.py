"""Friction clutches that start crank drives from rest: the inertia they feel changes with the crank angle while they slip.

All of many machines at once: numbers have the shape (machines,).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from diecut_report.expressions import Array, formula
from diecut_report.mechanics.bracketed_roots import root
from diecut_report.mechanics.timing.piece_rows import NODES, WEIGHTS, vertices

TURN = 2 * np.pi
AT = 1e-9  # rad from a dead centre that is none
LOOKS = 240  # places of a turn at which the end of a slip is looked for
STARTS = 40  # engagement angles that are tried over a turn
ZOOMS = 3  # times that the worst of them is looked at closer
ACROSS = np.linspace(-1, 1, 9)  # places of a closer look
PIECES = 3  # of a slip, in which its time is integrated
CLOSE = 1e-14  # rad to which the end of a slip is known
_SHARES = ((np.arange(PIECES)[:, None] + (NODES + 1) / 2) / PIECES).ravel()
_PARTS = np.tile(WEIGHTS / 2 / PIECES, PIECES)

Inertia = Callable[[Array, Array], Array]
"""kg·m² at crank angles (rad; rows, points) of the machine (rows,) of each row, with the period 2π."""


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
    """Hold the torque of slipping clutches, the load's torque below them (N·m), and the speed of their driving sides (rad/s)."""

    torque: Array
    load: Array
    speed: Array

    @property
    def net(self) -> Array:
        """Return the torque that accelerates."""
        return self.torque - self.load


@dataclass(frozen=True)
class Slip:
    """Hold engagements: the crank angle where each begins (rad), and what follows until the slip ends.

    Time (s), angle driven (rad), lag of the driven side (rad), heat (J), and the constant inertia of equal heat (kg·m²). All
    are NaN where the clutch has no more torque than the load, so that the slip never ends.
    """

    engagement_angle: Array
    time: Array
    driven_angle: Array
    lag: Array
    heat: Array
    equal_inertia: Array


def slip(inertia: Inertia, dead_centers: Array, clutch: SlippingClutch, engagement_angle: Array) -> Slip:
    """Return the engagements from rest at crank angles (rad).

    ``dead_centers`` (machines, any number) are the crank angles where the inertia is zero: there a slip has always ended.
    """
    driven, time = _slips(inertia, dead_centers, clutch, engagement_angle[:, None])
    lag = clutch.speed * time[:, 0] - driven[:, 0]
    heat = clutch.torque * lag
    equal = 2 * heat * clutch.net / (clutch.torque * clutch.speed**2)
    return Slip(engagement_angle, time[:, 0], driven[:, 0], lag, heat, equal)


def worst_slip(inertia: Inertia, dead_centers: Array, clutch: SlippingClutch) -> Slip:
    """Return the engagements from rest with the greatest heat, of all crank angles."""
    machines = np.arange(len(clutch.torque))
    angles = np.tile(np.linspace(0, TURN, STARTS, endpoint=False), (len(machines), 1))
    width = TURN / STARTS
    for zoom in range(1 + ZOOMS):
        driven, time = _slips(inertia, dead_centers, clutch, angles)
        heats = np.nan_to_num(clutch.speed[:, None] * time - driven)
        best = angles[machines, np.argmax(heats, axis=1)]
        if zoom < ZOOMS:
            angles, width = best[:, None] + width * ACROSS, width * (ACROSS[1] - ACROSS[0])
    return slip(inertia, dead_centers, clutch, (best + width * vertices(heats)) % TURN)


def _slips(inertia: Inertia, dead_centers: Array, clutch: SlippingClutch, starts: Array) -> tuple[Array, Array]:
    """Angle driven and time of the slips from crank angles (machines, starts), of the same shape."""
    driven = _driven_angles(inertia, dead_centers, clutch, starts)
    ends = np.sqrt(driven)[:, :, None]
    places = starts[:, :, None] + (ends * _SHARES) ** 2
    felt = inertia(places.reshape(len(starts), -1), np.arange(len(starts))).reshape(places.shape)
    rate = np.sqrt(2 * felt / np.where(clutch.net > 0, clutch.net, np.nan)[:, None, None])
    return driven, ends[:, :, 0] * (rate @ _PARTS)


def _driven_angles(inertia: Inertia, dead_centers: Array, clutch: SlippingClutch, starts: Array) -> Array:
    """The angle after each start (machines, starts) at which the driven side first has the speed of the driving side."""
    low, high = _brackets(inertia, dead_centers, clutch, starts % TURN)
    machine = np.repeat(np.arange(len(starts)), starts.shape[1])
    begins = (starts % TURN).ravel()

    def missing(driven: Array, slip: Array) -> Array:
        row = machine[slip]
        felt = inertia((begins[slip] + driven)[:, None], row)[:, 0]
        return np.asarray(clutch.net[row] * driven - felt * clutch.speed[row] ** 2 / 2)

    found = root(missing, low.ravel(), high.ravel(), CLOSE)
    ended = np.where(np.isfinite(found), found, high.ravel()).reshape(starts.shape)
    return np.where(clutch.net[:, None] > 0, ended, np.nan)


def _brackets(inertia: Inertia, dead_centers: Array, clutch: SlippingClutch, starts: Array) -> tuple[Array, Array]:
    """Angles after each start between which its slip ends: its end is looked for on a grid over two turns, which holds the dead centres."""
    even = np.broadcast_to(np.linspace(0, TURN, LOOKS, endpoint=False), (len(starts), LOOKS))
    turn = np.sort(np.concatenate([even, dead_centers % TURN], axis=1), axis=1)
    felt = inertia(turn, np.arange(len(starts)))
    felt = np.where((turn[:, :, None] == (dead_centers % TURN)[:, None, :]).any(axis=2), 0.0, felt)
    angles, needed = np.concatenate([turn, turn + TURN], axis=1), np.tile(felt, 2) * clutch.speed[:, None] ** 2 / 2
    driven = angles[:, None, :] - starts[:, :, None]
    ended = (driven > AT) & (clutch.net[:, None, None] * driven >= needed[:, None, :])
    first = np.argmax(ended, axis=2)
    high = np.take_along_axis(driven, first[:, :, None], axis=2)[:, :, 0]
    low = np.take_along_axis(driven, np.maximum(first - 1, 0)[:, :, None], axis=2)[:, :, 0]
    return np.maximum(low, 0.0), high
