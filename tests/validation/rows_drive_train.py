"""The worked examples of the drive train: belts over pulleys and the flywheel.

Loizyk V. V., Bryndas A. M., Shelonh N. M., Ternytskyi S. V. Analytical studies of drive mechanism parameters of flat cylinder die-cutting
press. Lviv Polytechnic National University; it prints the formulas (eq. 7–11) without numbers.
"""

from __future__ import annotations

from functools import cache
from math import degrees

from diecut_report.machine.calculation import Calculation
from diecut_report.mechanics import belt_path
from tests.machines import number
from tests.plugins.drive_trains import sine_load, train
from tests.validation.rows import Row


def toothed(*pulleys: tuple[float, float, float, str], engagement: str = "away") -> Calculation:
    """A drive train with a toothed belt over pulleys (mm)."""
    block = {"cylinder_radius": 105, "driven_radius": 60, "cylinder_velocity": 1, "shaft_speed": 150, "pitch": 8}
    named = [dict(zip(("x", "y", "radius", "side"), pulley, strict=True)) for pulley in pulleys]
    return train(toothed_belt=block | {"engagement": engagement, "pulleys": named})


@cache
def two_pulleys() -> Calculation:
    """A toothed belt over two pulleys."""
    return toothed((0, 0, 100, "inside"), (500, 0, 200, "inside"))


@cache
def three_pulleys() -> Calculation:
    """A toothed belt over two pulleys and an idler outside."""
    return toothed((0, 0, 100, "inside"), (600, 0, 100, "inside"), (300, 70, 50, "outside"))


def wrap(belt: Calculation, pulley: int) -> float:
    """Wrap of one pulley, degrees."""
    return degrees(float(belt["wraps"][0, pulley]))


def open_vbelt() -> float:
    """The same two pulleys as a V-belt."""
    vbelt = {"driver_diameter": "200 mm", "center_distance": "500 mm"}
    return number(train(motor_speed=100, output_speed=50, gears=[], vbelt=vbelt), "vbelt_length")


def energy_share() -> float:
    """ΔE/M₀ of the torque M₀(1 + sin φ), without gears."""
    calc = train(gears=[], output_speed="290 rpm", torque_mean=100, torque_peak=200, torque_curve=sine_load())
    return number(calc, "energy_fluctuation") / 100


ROWS = (
    Row("worked example", "open belt, radii 100 and 200 mm, axes 500 mm apart: length as a V-belt", "1.962545", "m", open_vbelt),
    Row("worked example", "the same as a toothed belt: length", "1.962545", "m", lambda: number(two_pulleys(), "toothed_belt_length")),
    Row("worked example", "its wrap on the small pulley", "156.926", "°", lambda: wrap(two_pulleys(), 0)),
    Row("worked example", "the same, in closed form", "156.926", "°", lambda: degrees(belt_path.wrap_small(0.5, 0.1, 0.2))),
    Row("worked example", "its wrap on the large pulley", "203.074", "°", lambda: wrap(two_pulleys(), 1)),
    Row("worked example", "belt over (0, 0), (600, 0) of 100 mm and outside (300, 70) of 50 mm: length", "1.850262", "m",
        lambda: number(three_pulleys(), "toothed_belt_length")),
    Row("worked example", "its wrap on the first pulley", "196.0044", "°", lambda: wrap(three_pulleys(), 0)),
    Row("worked example", "its wrap on the second pulley", "196.0044", "°", lambda: wrap(three_pulleys(), 1)),
    Row("worked example", "its wrap on the pulley outside", "32.0087", "°", lambda: wrap(three_pulleys(), 2)),
    Row("eq. 10, worked example", "driving pulley r_p for V = 1 m/s, r_d = 60 mm, R = 105 mm, n = 150 rpm", "100.0402", "mm",
        lambda: number(three_pulleys(), "driving_pulley_radius") * 1e3),
    Row("worked example", "ΔE/M₀ of the torque M₀(1 + sin φ)", "2.000000", "1", energy_share),
)  # fmt: skip
