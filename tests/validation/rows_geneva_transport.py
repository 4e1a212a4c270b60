"""The Maltese cross of 000, and the worked examples of Geneva drives with four, six and eight slots.

Topolnytskyi P. V., Shustykevych A. I., Kolomiiets A. B., Vatuliak Yu. V. Research of the drive parameters of the pressure
cylinder of a flat-bed type die-cutting machine. 2024. doi: 10.32403/1998-6912-2024-2-69-140-150. The paper prints the step of
its cross alone; the numbers of the worked examples follow from the closed forms of the external Geneva drive by hand.
"""

from __future__ import annotations

from functools import cache, partial
from math import degrees

from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.geneva_transport import MECHANISM
from tests.machines import inputs, number
from tests.validation.rows import Row


@cache
def with_slots(slots: int) -> Calculation:
    """A drive with so many slots; its ratios do not depend on the sizes."""
    keys = {"slots": slots, "center_distance": "200 mm", "crank_speed": "100 rpm", "roller_radius": "10 mm"}
    return calculate(MECHANISM, inputs(MECHANISM, keys))


def ours(slots: int, name: str) -> float:
    """A number of the drive; angles in degrees."""
    value = number(with_slots(slots), name)
    return degrees(value) if name.endswith("angle") else value


def row(slots: int, name: str, quantity: str, printed: str, unit: str = "", place: str = "") -> Row:
    """A number of a worked example."""
    return Row(place or f"worked example, z = {slots}", quantity, printed, unit, partial(ours, slots, name))


SPEED, PEAK, ENTRY = "greatest speed ω₂/ω₁", "greatest acceleration ε₂/ω₁²", "acceleration at entry ε₂/ω₁²"
PLACE = "crank angle of the greatest acceleration, from the middle"

ROWS = (
    row(6, "step_angle", "step of the cross", "60", "°", place="text after Fig. 1"),
    row(6, "motion_fraction", "share of the motion", "0.333333"),
    row(6, "speed_ratio_peak", SPEED, "1.0"),
    row(6, "acceleration_peak", PEAK, "1.349637"),
    row(6, "acceleration_peak_angle", PLACE, "22.903", "°"),
    row(6, "acceleration_entry", ENTRY, "0.577350"),
    row(4, "speed_ratio_peak", SPEED, "2.414214"),
    row(4, "acceleration_peak", PEAK, "5.406981"),
    row(4, "acceleration_peak_angle", PLACE, "11.464", "°"),
    row(4, "acceleration_entry", ENTRY, "1.0"),
    row(8, "speed_ratio_peak", SPEED, "0.619914"),
    row(8, "acceleration_peak", PEAK, "0.699757"),
    row(8, "acceleration_entry", ENTRY, "0.414214"),
)
