"""The numbers that 004 prints for the folding knife, and the worked example.

Didych V. P., Nahorniuk S. O. Comparative analysis of the mechanisms of the knife's drive in folders of the second longitudinal
fold of web printing machines (in Ukrainian). 1996. UDC 681.62.067. The paper prints no dimensions of its drives: the carrier of the
worked example has the radius that gives the printed 1000 m/s².
"""

from __future__ import annotations

from functools import cache
from math import cos, pi, radians

from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.knife_drive import MECHANISM
from tests.machines import inputs, number
from tests.validation.rows import Row

RATE = {"cylinder_rate": "25000 1/h", "working_depth": "40 mm", "roller_diameter": "80 mm", "grip_angle": "5 deg"}
DRIVES = {
    "planetary": {"carrier_radius": "65.656 mm"},
    "crank_slider": {"crank_radius": "35 mm", "rod_length": "140 mm"},
    "crank_rocker": {
        "crank": 20,
        "coupler": 110,
        "rocker": 80,
        "frame": 120,
        "knife_arm": 107,
        "lowest_dead_center": "inner",
    },
}


@cache
def knife() -> Calculation:
    """The three drives of the example, the knife's speed from the mechanism."""
    return calculate(MECHANISM, inputs(MECHANISM, RATE | DRIVES))


@cache
def gripped_at_printed_speed() -> Calculation:
    """The same with the printed speed of 0.2 m/s where gripping begins."""
    return calculate(MECHANISM, inputs(MECHANISM, RATE | DRIVES | {"grip_speed": "0.2 m/s"}))


def ours(name: str, scale: float = 1.0) -> float:
    """A number of the example."""
    return number(knife(), name) * scale


def times_lower(drive: str) -> float:
    """How many times lower the acceleration is than the planetary drive's."""
    return ours("planetary_acceleration_peak") / ours(f"{drive}_acceleration_peak")


def speed_of_short_planetary() -> float:
    """Speed 5° before the lowest point of a planetary drive with 200 m/s² there, by eq. 1."""
    speed = 2 * pi * 50000 / 3600
    return 200 / speed * cos(radians(85))


AFTER = "after Fig. 3"

ROWS = (
    Row(AFTER, "turns of the knife's shaft n₁", "50000", "1/h", lambda: ours("crank_speed", 3600 / (2 * pi))),
    Row(AFTER, "time of a cycle T", "0.072", "s", lambda: ours("cycle_time")),
    Row(AFTER, "time of gripping t", "0.001", "s", lambda: ours("grip_time")),
    Row(AFTER, "speed 5° before the lowest point V", "0.2", "m/s", lambda: ours("planetary_grip_velocity"), "mistake",
        speed_of_short_planetary, "0.999 m/s with the planetary drive of 1000 m/s²; 0.2 m/s belongs to a drive with about 200 m/s² at its end, "
        "as the crank-rocker of the example"),
    Row(AFTER, "the same, crank-rocker of the example", "0.2", "m/s", lambda: ours("crank_rocker_grip_velocity")),
    Row(AFTER, "acceleration in the grip W, with V = 0.2 m/s", "6.8e3", "m/s²",
        lambda: number(gripped_at_printed_speed(), "planetary_grip_acceleration"), why="6781 m/s²"),
    Row(AFTER, "greatest acceleration, planetary drive", "1.0e3", "m/s²", lambda: ours("planetary_acceleration_peak"),
        why="with a carrier of 65.656 mm, which the paper does not print; the stroke is then 262.6 mm"),
    Row(AFTER, "accelerations lower by, crank-slider of the example", "3", "times", lambda: times_lower("crank_slider"),
        why="at a stroke 3.75 times shorter; at equal stroke it would be 1.25 times higher"),
    Row(AFTER, "accelerations lower by, crank-rocker of the example", "6", "times", lambda: times_lower("crank_rocker"),
        why="at a stroke 4.74 times shorter; at equal stroke it would be 1.27 times lower"),
    Row("worked example", "angular speed of the knife's shaft ω₁", "87.2665", "rad/s", lambda: ours("crank_speed")),
    Row("worked example", "speed of the rollers V_r", "6.981", "m/s", lambda: ours("roller_velocity")),
    Row("worked example", "acceleration in the grip, with V = 0.2 m/s", "6781", "m/s²",
        lambda: number(gripped_at_printed_speed(), "planetary_grip_acceleration")),
    Row("worked example", "stroke of the planetary drive", "262.6", "mm", lambda: ours("planetary_stroke", 1e3)),
    Row("worked example", "acceleration at its lowest point", "1000", "m/s²", lambda: ours("planetary_acceleration_end")),
    Row("worked example", "its speed 5° before the lowest point", "0.999", "m/s", lambda: ours("planetary_grip_velocity")),
    Row("worked example", "its acceleration in the grip", "5983", "m/s²", lambda: ours("planetary_grip_acceleration")),
)  # fmt: skip
