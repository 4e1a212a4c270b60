"""A motor that slips behind its flywheel: linear slip makes its torque a first-order lag of the load.

With M_m = k(ω_s − ω) and Jω̇ = M_m − M_f, all at the flywheel's shaft, the motor's torque obeys M_m + τ·dM_m/dt = M_f, τ = J/k:
a harmonic Ω of the load is damped by 1/√(1 + Ω²τ²).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial import legendre

from diecut_report.expressions import Array, as_number, formula
from diecut_report.mechanics.timing.legendre_pieces import NODES, TO_SERIES, LegendrePieces, split

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


@dataclass(frozen=True, eq=False)
class MotorResponse:
    """Hold the motor's torque over a period of time (N·m, at the flywheel's shaft), which begins and ends alike."""

    torque: LegendrePieces

    @property
    def largest(self) -> float:
        """Return the greatest torque."""
        return self.torque.largest[0]

    @property
    def least(self) -> float:
        """Return the least torque, negative where the motor brakes."""
        return self.torque.least[0]

    def speed_fluctuation(self, stiffness_at_flywheel: float, speed: float) -> float:
        """Return δ, the range of the flywheel's speed to its mean (rad/s): the range of the torque shows it."""
        return (self.largest - self.least) / (stiffness_at_flywheel * speed)


def motor_response(load: LegendrePieces, time_constant: float) -> MotorResponse:
    """Return the periodic torque of the motor under a load over time (N·m, both at the flywheel's shaft).

    On each piece M_m(t) = e^(−t/τ)·[M_m(0) + ∫₀ᵗ e^(s/τ)·M_f ds/τ]; the start follows from the end of the period.
    """
    tau = max(time_constant, SHORTEST * float(load.widths.sum()))
    fine = load.between(split(load.edges, LONGEST * tau))
    own = _from_rest(fine, tau)
    decay = np.exp(-fine.widths / tau)
    starts = _periodic_starts(own[:, -1], decay)
    passed = fine.widths[:, None] * (NODES + 1) / 2
    values = own[:, :-1] + starts[:, None] * np.exp(-passed / tau)
    return MotorResponse(LegendrePieces.through(fine.edges, values))


def _from_rest(load: LegendrePieces, tau: float) -> Array:
    """The response on each piece from zero at its start, at its places and at its end, shape (pieces, places + 1)."""
    half = load.widths[:, None] / (2 * tau)
    rises = load.values * np.exp(half * (NODES + 1)) @ _TO_PLACES.T * half
    found: Array = rises * np.exp(-half * (np.append(NODES, 1.0) + 1))
    return found


def _periodic_starts(gains: Array, decay: Array) -> Array:
    """The torque at the start of each piece: what the pieces add and leave, after a period the same."""
    ends = [0.0]
    for gain, left in zip(gains, decay, strict=True):
        ends.append(gain + left * ends[-1])
    first = ends[-1] / -np.expm1(np.log(decay).sum())
    left_over = np.concatenate([[1.0], np.cumprod(decay[:-1])])
    found: Array = np.asarray(ends[:-1]) + first * left_over
    return found
