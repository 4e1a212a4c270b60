"""The motor's torque behind its flywheel, by plain code over one machine or many."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from diecut_report.api import Curve
from diecut_report.mechanics.timing.engagement import motor_response
from diecut_report.mechanics.timing.shaft_curves import PieceRows

PIECES = 8  # of each turn of the drive train's output, at least


def response(given: Mapping[str, Any]) -> PieceRows:
    """Return the torque of each machine's motor at the flywheel's shaft, over shares of the load's period."""
    period, lag = given["load_period"][:, 0], given["time_constant"][:, 0]
    return motor_response(load_of(given["flywheel_torque"], given["load_turns"]), period, lag)


def load_of(torque: Curve, turns: Any) -> PieceRows:
    """Return the load of each machine over shares of its period; its turns (machines, 1)."""
    count = len(turns)
    places = np.broadcast_to(torque.breakpoints, (count, torque.breakpoints.shape[1]))
    return PieceRows.of(torque.values, places, PIECES * int(np.nanmax(turns)))
