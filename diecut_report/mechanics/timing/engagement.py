"""Friction clutches that start crank drives from rest: the inertia they feel changes with the crank angle while they slip.

All of many machines at once: numbers have the shape (machines,).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial import legendre

from diecut_report.formulas import Array
from diecut_report.formulas.expression import as_number
from diecut_report.formulas.formula import formula
from diecut_report.mechanics import numerics
from diecut_report.mechanics.timing.shaft_curves import NARROW, NODES, TO_SERIES, WEIGHTS, PieceRows

TURN = 2 * np.pi
AT = 1e-9  # rad from a dead centre that is none
LOOKS = 240  # places of a turn at which the end of a slip is looked for
STARTS = 40  # engagement angles that are tried over a turn
ZOOMS = 3  # times that the worst of them is looked at closer
ACROSS = 8  # parts of a closer look
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
    shafts_inertia: Any,
    rotation: Any,
    speed_ratio: Any,
) -> Any:
    """Inertia of the rolling cylinder that its crank feels, with the unbalance and the shafts between: of equal kinetic energy.

    ``rotation`` is counted from where the flat is down, ``speed_ratio`` is the cylinder's speed to the crank's.
    """
    rolling = cylinder_inertia + cylinder_mass * cylinder_radius**2 + shafts_inertia
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

    def head_start(angles: Array, _: Array) -> Array:
        """By how much less than nothing the driven side lags behind."""
        driven, time = _slips(inertia, dead_centers, clutch, angles)
        lag: Array = np.nan_to_num(clutch.speed[:, None] * time - driven)
        return -lag

    starts = np.tile(np.linspace(0, TURN, STARTS, endpoint=False), (len(machines), 1))
    best = starts[machines, head_start(starts, machines).argmin(axis=1)]
    width = TURN / STARTS
    angle = numerics.vertex(*numerics.looks(head_start, best - width, best + width, ACROSS, ZOOMS))
    return slip(inertia, dead_centers, clutch, angle % TURN)


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

    found = numerics.root(missing, low.ravel(), high.ravel(), CLOSE)
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


# A motor that slips behind its flywheel: linear slip makes its torque a first-order lag of the load.
#
# With M_m = k(ω_s − ω) and Jω̇ = M_m − M_f, all at the flywheel's shaft, the motor's torque obeys M_m + τ·dM_m/dt = M_f, τ = J/k:
# a harmonic Ω of the load is damped by 1/√(1 + Ω²τ²).


LONGEST = 4.0  # width of a piece, in time constants
SHORTEST = 1e-5  # share of the period: a shorter time constant counts as this one

# of a polynomial through values at the places, its integral from −1 to each of them, and to 1
_INTEGRALS = legendre.legint(np.eye(len(NODES)), lbnd=-1, axis=0)
_TO_PLACES = legendre.legvander(np.append(NODES, 1.0), len(NODES)) @ _INTEGRALS @ TO_SERIES


@formula
def slip_stiffness(rated_torque: Any, synchronous_speed: Any, rated_speed: Any) -> Any:
    """Torque of a motor for each radian a second below its synchronous speed, through its rated point."""
    return rated_torque / (synchronous_speed - rated_speed)


@formula
def stiffness_at_flywheel(slip_stiffness: Any, ratio: Any, efficiency: Any) -> Any:
    """The same at the flywheel's shaft, behind a ratio with losses."""
    return slip_stiffness * ratio**2 * efficiency


@formula
def time_constant(inertia: Any, stiffness_at_flywheel: Any) -> Any:
    """Time constant with which the motor's torque follows the load."""
    return as_number(inertia / stiffness_at_flywheel)


def motor_response(load: PieceRows, period: Array, time_constant: Array) -> PieceRows:
    """Return the periodic torques of motors under loads over shares of their periods (s), all at the flywheel's shaft.

    Periods and time constants (s) have shape (machines,). On each piece M_m(t) = e^(−t/τ)·[M_m(0) + ∫₀ᵗ e^(s/τ)·M_f ds/τ]; the
    start follows from the end of the period.
    """
    tau = np.maximum(time_constant / period, SHORTEST)
    fine = load.split(np.maximum(np.ceil(load.width / (LONGEST * tau[load.machine]) - NARROW), 1).astype(int))
    lag = tau[fine.machine]
    own = _from_rest(fine, lag)
    starts = _periodic_starts(fine, own[:, -1], np.exp(-fine.width / lag), tau)
    passed = fine.width[:, None] * (NODES + 1) / 2
    return fine.through(own[:, :-1] + starts[:, None] * np.exp(-passed / lag[:, None]))


def _from_rest(load: PieceRows, tau: Array) -> Array:
    """The response on each piece from zero at its start, at its places and at its end, shape (pieces, places + 1)."""
    half = (load.width / (2 * tau))[:, None]
    rises = load.values * np.exp(half * (NODES + 1)) @ _TO_PLACES.T * half
    found: Array = rises * np.exp(-half * (np.append(NODES, 1.0) + 1))
    return found


def _periodic_starts(load: PieceRows, gains: Array, decay: Array, tau: Array) -> Array:
    """The torque at the start of each piece: what the pieces add and leave, after a period the same.

    What a period takes away is as small as it is with a long lag, and not the difference of two numbers near one.
    """
    number = np.bincount(load.machine, minlength=load.count)
    place = np.arange(len(gains)) - (np.cumsum(number) - number)[load.machine]
    gain, left = np.zeros((load.count, number.max())), np.ones((load.count, number.max()))
    gain[load.machine, place], left[load.machine, place] = gains, decay
    gain, left = _run_through(gain, left)
    first = gain[:, -1:] / -np.expm1(-1 / tau)[:, None]
    begins = np.concatenate([first, gain + left * first], axis=1)
    return begins[load.machine, place]


def _run_through(gain: Array, left: Array) -> tuple[Array, Array]:
    """What the pieces up to each one make of a torque together, pieces along the last axis: they add the first, and keep the second of it.

    Doubled spans of pieces are joined: a short lag has tens of thousands of pieces, too many to go through one by one.
    """
    span = 1
    while span < gain.shape[1]:
        joined = gain[:, span:] + left[:, span:] * gain[:, :-span], left[:, span:] * left[:, :-span]
        gain, left = (np.concatenate([of[:, :span], new], axis=1) for of, new in zip((gain, left), joined, strict=True))
        span *= 2
    return gain, left
