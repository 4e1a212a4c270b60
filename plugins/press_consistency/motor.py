"""The motor's torque behind its flywheel, by plain code over one machine or many."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import Curve
from diecut_report.mechanics.timing.legendre_pieces import LegendrePieces, split, unique_edges
from diecut_report.mechanics.timing.motor_slip import MotorResponse, motor_response

Array = NDArray[np.float64]
WIDEST = 1 / 16  # of a piece, in turns of the drive train's output


def rms(torque: Curve, turns: Array, period: Array, time_constant: Array) -> Array:
    """Root mean square of the motor's torque."""
    return _each(torque, turns, period, time_constant, lambda response: response.torque.rms)


def largest(torque: Curve, turns: Array, period: Array, time_constant: Array) -> Array:
    """Greatest torque of the motor."""
    return _each(torque, turns, period, time_constant, lambda response: response.largest)


def least(torque: Curve, turns: Array, period: Array, time_constant: Array) -> Array:
    """Least torque of the motor, negative where it brakes."""
    return _each(torque, turns, period, time_constant, lambda response: response.least)


def _each(torque: Curve, turns: Array, period: Array, lag: Array, result: Callable[[MotorResponse], float]) -> Array:
    """A number of each machine's motor, at the flywheel's shaft."""
    rows = range(len(period))
    loads = (load_of(torque, float(turns[row, 0]), row).scaled(float(period[row, 0])) for row in rows)
    found = [result(motor_response(load, float(lag[row, 0]))) for row, load in zip(rows, loads, strict=True)]
    return np.array(found)[:, None]


def load_of(torque: Curve, turns: float, row: int = 0) -> LegendrePieces:
    """Return the load over shares of its period."""
    rows, inner = np.array([row]), torque.breakpoints
    edges = unique_edges(inner[min(row, len(inner) - 1)], 0.0, 1.0)
    return LegendrePieces.of(
        lambda share, middle: torque.values(share[None], middle[None], rows)[0], split(edges, WIDEST / turns)
    )
