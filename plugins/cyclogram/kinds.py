"""What the cyclogram asks of mechanisms of each kind: their torque and what moves with how much energy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

TORQUES = {
    "cylinder_drive": "crank_torque",
    "cam_gear_transport": "drive_torque",
    "geneva_transport": "torque",
    "platen_press": "torque",
    "circular_knife": "torque",
}
"""The curve of the torque at the line's own shaft, losses inside the mechanism included."""

POSITION, STEP = "sheet_position", "sheet_step"
"""The way of the sheet in a transport, and how far a step goes."""

WAYS = {
    "cylinder_drive": "displacement",
    "cam_gear_transport": POSITION,
    "geneva_transport": POSITION,
    "platen_press": "platen_displacement",
}
"""The curve of a line's way."""


@dataclass(frozen=True)
class Energy:
    """Declare the kinetic energy of a kind: the curves and numbers that it takes, and what it makes of them."""

    curves: tuple[str, ...]
    numbers: tuple[str, ...]
    of: Callable[..., Any]


ENERGIES = {
    "cylinder_drive": Energy(
        ("cylinder_rotation", "cylinder_speed"),
        ("moved_inertia", "cylinder_radius", "static_unbalance"),
        lambda turned, speed, inertia, radius, unbalance: (
            (inertia + 2 * radius * unbalance * np.cos(turned)) * speed**2 / 2
        ),
    ),
    "cam_gear_transport": Energy(("sheet_velocity",), ("conveyor_mass",), lambda v, mass: mass * v**2 / 2),
    "geneva_transport": Energy(("wheel_speed",), ("driven_inertia",), lambda speed, inertia: inertia * speed**2 / 2),
    "platen_press": Energy(("platen_velocity_true",), ("platen_mass",), lambda v, mass: mass * v**2 / 2),
}
