"""Drive trains that several tests calculate, and what they compare them with."""

from __future__ import annotations

from collections.abc import Sequence
from math import pi
from typing import Any

import numpy as np

from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, formula
from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, CurveHandle
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.steps import Abscissa, Value
from diecut_report.plugins.drive_train import MECHANISM
from diecut_report.results.mechanism_record import CheckRecord
from tests.machines import checks, inputs

RPM = 2 * pi / 60
EXAMPLE: dict[str, Any] = {
    "motor_speed": "1450 rpm",
    "output_speed": "50 rpm",
    "torque_mean": "200 N*m",
    "torque_peak": "900 N*m",
    "gears": [{"driver_teeth": 20, "driven_teeth": 100}],
    "motor_inertia": 0,
    "load_inertia": 0,
    "vbelt": {"driver_diameter": "125 mm", "center_distance": "600 mm"},
}
PAIRS = [
    {"driver_teeth": 20, "driven_teeth": 50, "efficiency": 0.96},
    {"driver_teeth": 25, "driven_teeth": 60, "efficiency": 0.98},
]
UNEVEN = [120.0, 900.0, 1500.0, 700.0, -300.0, -800.0, -250.0, 60.0, 400.0, -100.0, 10.0, 30.0]
WORKING: dict[str, Any] = {"gears": PAIRS, "torque_curve": UNEVEN, "torque_mean": 189.1667, "torque_peak": 1500}


def train(**changes: Any) -> Calculation:
    """A drive train with changes."""
    return calculate(MECHANISM, inputs(MECHANISM, EXAMPLE | changes))


class SineLoad(Inputs):
    """A torque that swings once a turn."""

    mean = Quantity("M_0", "N*m", "Mean torque", gt=0, default=100)
    swing = Quantity("M_s", "N*m", "Swing of the torque", ge=0, default=100)
    n_points = Quantity("N", "1", "Samples", ge=36, integer=True, default=90)


@formula
def swinging(place: Any, mean: Any, swing: Any) -> Any:
    """Torque over the turn."""
    return mean + swing * np.sin(place)


LOAD = Mechanism(
    kind="sine_load",
    version="1",
    title="Load",
    summary="A torque that swings once a turn.",
    inputs=SineLoad,
    chapters=(
        Chapter(
            "Torque",
            steps=(
                Abscissa(id="place", symbol="φ", unit="deg", description="Angle", period=2 * pi),
                Value(id="torque", symbol="M", unit="N*m", description="Torque", formula=swinging),
            ),
        ),
    ),
)


def sine_load(**changes: Any) -> CurveHandle:
    """A torque curve M₀ + M_s·sin φ, as another mechanism gives it."""
    return CurveHandle(calculate(LOAD, inputs(LOAD, changes)), "torque")


def check(calc: Calculation, name: str) -> CheckRecord:
    """A check's result."""
    return checks(calc)[name]


def checked(calc: Calculation) -> set[str]:
    """The checks that take part."""
    return set(checks(calc))


def over_a_turn(values: Sequence[float], points: int) -> tuple[Array, Array]:
    """Angles and torques of a list of equally spaced values, straight between them."""
    phi = np.linspace(0, 2 * pi, points)
    return phi, np.interp(phi, np.linspace(0, 2 * pi, len(values) + 1), [*values, values[0]])


def at_flywheel(torque: Array, ratio: float, efficiency: float) -> Array:
    """The torque at the flywheel's shaft, by cases."""
    return np.where(torque > 0, torque / ratio / efficiency, torque / ratio * efficiency)
