"""The worked example of the circular knife.

Uhryn Ya. M. Analytical study of the process of cutting board with a circular knife. Naukovi zapysky (Scientific Papers) 1999,
No. 1. The page that survives prints no numbers; those of the worked example follow from the geometry by two computations.
"""

from __future__ import annotations

from functools import cache, partial
from math import degrees

from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.circular_knife import MECHANISM
from tests.machines import inputs, number
from tests.validation.rows import Row

KEYS = {
    "eccentricity": "20 mm",
    "edge_radius": "100 mm",
    "depth": "112 mm",
    "front_distance": "26 mm",
    "thickness": "0.5 mm",
    "cut_length": "15 mm",
    "sharpening_angle": "20 deg",
    "speed": "60 rpm",
}


@cache
def example() -> Calculation:
    """The knife of the worked example."""
    return calculate(MECHANISM, inputs(MECHANISM, KEYS))


def ours(name: str) -> float:
    """A number of the example; angles in degrees, times in ms."""
    value = number(example(), name)
    return degrees(value) if "angle" in name else value * 1e3 if name == "cut_time" else value


def row(name: str, quantity: str, printed: str, unit: str = "") -> Row:
    """A number of the worked example."""
    return Row("worked example", quantity, printed, unit, partial(ours, name))


ROWS = (
    row("angle_start", "knife angle at the start of the cut φ₁", "38.8465", "°"),
    row("angle_end", "knife angle at the end of the cut φ₂", "55.6950", "°"),
    row("cut_time", "time of the cut", "46.8013", "ms"),
    row("shear_angle_min", "least shear angle", "5.9830", "°"),
    row("shear_angle_max", "maximum shear angle", "17.2943", "°"),
    row("force_max", "greatest force down on the board", "10.5276", "N"),
    row("torque_max", "maximum torque", "0.493709", "N·m"),
    row("work", "work of a cut", "0.0761905", "J"),
    row("guillotine_force_ratio", "greatest force to a guillotine's", "0.140368"),
)
