"""Rolling bearings that several tests calculate, and curves that load them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.rolling_bearing import MECHANISM
from tests.machines import inputs

Function = Callable[[Array], Array]


@dataclass(frozen=True)
class Over:
    """A curve over the angle of a cycle, in SI, as a reference to another mechanism hands it over; it jumps at shares of the cycle."""

    function: Function
    jumps: tuple[float, ...] = ()
    cycle: str = "crank_angle"
    curve_id: str = "curve"
    rate: Array = field(default_factory=lambda: np.zeros((1, 1)))
    turns: Array = field(default_factory=lambda: np.ones((1, 1)))

    def values(self, share: Array, middle: Array, rows: Array | None) -> Array:
        """Values at shares of the cycle; of a place where the curve jumps on the side of the middle."""
        inside = share + np.sign(middle - share) * 1e-12
        return np.asarray(self.function(2 * np.pi * np.where(np.isin(share, self.jumps), inside, share)), dtype=float)

    @property
    def joints(self) -> Array:
        """Where it jumps."""
        return np.array([self.jumps])

    breakpoints = joints


BALL: dict[str, Any] = {
    "name": "ball", "type": "deep_groove", "dynamic_rating": 35.1, "static_rating": 21.6, "f0": 14, "radial_force": 4000, "speed": 300,
}  # fmt: skip
ROLLER: dict[str, Any] = {
    "name": "roller", "type": "roller", "dynamic_rating": 81.5, "static_rating": 75, "radial_force": 9000, "speed": 50,
}  # fmt: skip
ANGULAR: dict[str, Any] = {
    "name": "angular", "type": "ball", "dynamic_rating": 40, "static_rating": 30, "x": 0.35, "y": 0.57, "e": 1.14, "x0": 0.5, "y0": 0.26,
    "radial_force": 2000, "axial_force": 3000, "speed": 300, "limiting_speed": 9000,
}  # fmt: skip
SOUGHT: dict[str, Any] = {
    "name": "sought",
    "type": "deep_groove",
    "radial_force": 3000,
    "axial_force": 500,
    "speed": 300,
}
SOUGHT_ROLLER: dict[str, Any] = {"name": "sought_roller", "type": "roller", "radial_force": 9000, "speed": 300}
SWINGING: dict[str, Any] = {
    "name": "swinging", "type": "roller", "dynamic_rating": 81.5, "static_rating": 75, "rolling_elements": 14, "cycle_speed": 50,
    "radial_force": Over(lambda phi: 9000 * np.cos(phi)), "relative_angle": Over(lambda phi: np.pi / 6 * np.sin(phi)),
}  # fmt: skip
WAVING: dict[str, Any] = BALL | {
    "name": "waving", "radial_force": Over(lambda phi: 3000 + 2000 * np.sin(phi)), "axial_force": Over(lambda phi: 2500 * np.sin(2 * phi)),
    "speed": Over(lambda phi: 20 + 10 * np.cos(phi)),
}  # fmt: skip
JUMPING: dict[str, Any] = ROLLER | {
    "name": "jumping", "radial_force": Over(lambda phi: np.where(phi < np.pi, 4000.0, 8000.0), (0.5,)),
}  # fmt: skip


def bearings(*parts: dict[str, Any], **common: Any) -> Calculation:
    """Bearings, with common keys."""
    return calculate(MECHANISM, inputs(MECHANISM, {"bearings": list(parts), "n_points": 72} | common))


def one(part: dict[str, Any], **changes: Any) -> Calculation:
    """One bearing with changes of its own keys."""
    return bearings(part | changes)


def value(calc: Calculation, name: str, part: int = 0) -> float:
    """A number of one of the bearings, SI."""
    return float(calc[name][0, part])
