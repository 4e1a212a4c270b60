"""A motor that slips behind its flywheel: linear slip makes its torque a first-order lag of the load.

With M_m = k(ω_s − ω) and Jω̇ = M_m − M_f, all at the flywheel's shaft, the motor's torque obeys M_m + τ·dM_m/dt = M_f, τ = J/k:
a harmonic Ω of the load is damped by 1/√(1 + Ω²τ²).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.polynomial import legendre

from diecut_report.expressions import Array, as_number, formula
from diecut_report.mechanics.timing.piece_rows import NARROW, NODES, TO_SERIES, PieceRows

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


def next_synchronous_speed(speed: float, frequency: float = 50.0) -> float:
    """Return the next synchronous speed above a rated one, with whole pairs of poles (rad/s; frequency of the mains in Hz).

    ValueError where the speed is not below that of one pair.
    """
    most = 2 * np.pi * frequency
    pairs = int(np.ceil(most / speed * (1 - 1e-9))) - 1
    if pairs < 1:
        raise ValueError(f"no synchronous speed at {frequency:g} Hz is above {speed:g} rad/s")
    return float(most / pairs)


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
    found: Array = begins[load.machine, place]
    return found


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
