"""The numbers that 003 prints for its example of the cam-gear stepper, and worked examples of the method.

Rehei I. I., Uhryn Ya. M., Ternytskyi S. V., Ivaskiv B. R., Mlynko O. I. The synthesis of cam-gear mechanism for discrete
transportation of cardboard blanks by its side bleeds through units of the die-cutting equipment. 2021.
doi: 10.32403/0554-4866-2021-2-82-11-20.
"""

from __future__ import annotations

from functools import cache
from math import degrees

from diecut_report.machine.calculation import Calculation
from tests.machines import number
from tests.plugins.steppers import CAMS, stepper
from tests.validation.rows import Row

ROUGH_PI = 3.14


@cache
def published() -> Calculation:
    """The example: a dwell of 160°, sweeps of 60° and 20°, the sinusoidal law; with arms of 0.3 R₂ at 72° and 232°."""
    return stepper(**CAMS)


@cache
def by_law(law: str) -> Calculation:
    """The example with another law of motion."""
    return stepper(motion_law=law)


@cache
def of_dwell(share: str) -> Calculation:
    """The example with another dwell, given as share of a turn; a smaller sweep of stop and start leaves a return."""
    return stepper(dwell_angle=f"{float(share) * 360!r} deg", sector_stop_sweep="5 deg")


def ours(name: str) -> float:
    """A number of the example."""
    return number(published(), name)


def angle(name: str) -> float:
    """An angle of the example in degrees."""
    return degrees(ours(name))


def rough_dwell_speed() -> float:
    """The sector's speed in the dwell, with the source's π."""
    return 60 / 180 * ROUGH_PI / (160 / 360)


def rough_gear_peak() -> float:
    """The gear's greatest speed referred to the sector, with the source's π: return and dwell together."""
    return 2 * (80 / 180 * ROUGH_PI) / (1 - 160 / 360 - 2 * 20 / 135) + rough_dwell_speed()


ROWS: tuple[Row, ...] = (
    Row("before “stages of the synthesis”", "R₁/R₂ for a dwell of 0.25 of a turn", "0.4", "1",
        lambda: number(of_dwell("0.25"), "radius_ratio")),
    Row("before “stages of the synthesis”", "R₁/R₂ for a dwell of 0.625 of a turn", "0.21", "1",
        lambda: number(of_dwell("0.625"), "radius_ratio"),
        why="the ratio alone: with sweeps of 60° and 20° this dwell leaves no return (T₄ = −0.04)"),
    Row("second eq. 1", "share of the dwell T₂", "0.444", "1", lambda: ours("time_dwell")),
    Row("second eq. 1", "speed of the sector in the dwell ω₃", "2.355", "rad per turn", lambda: ours("sector_speed_dwell"), "mistake",
        rough_dwell_speed, "π was taken as 3.14; exactly 2.3562"),
    Row("eq. 3", "share of the phases III and I together T₍₃₊₁₎", "0.296", "1", lambda: ours("time_stop")),
    Row("eq. 3", "disc angle of phase III, and of I", "53.33", "°", lambda: angle("angle_stop") - angle("dwell_angle")),
    Row("after eq. 3", "disc angle where the sector stops", "213.33", "°", lambda: angle("angle_stop")),
    Row("eq. 4", "share of the return T₄", "0.259", "1", lambda: ours("time_return")),
    Row("after eq. 4", "disc angle where the sector starts again", "306.67", "°", lambda: angle("angle_start")),
    Row("after eq. 4", "greatest speed of the sector in its return", "13.12", "rad per turn", lambda: ours("sector_speed_return_peak"),
        "mistake", rough_gear_peak, "the sector's is 2·80°/0.2593 = 10.771; the printed number is the gear's"),
    Row("stage 5", "greatest speed of the gear, referred to the sector", "13.12", "rad per turn",
        lambda: ours("gear_speed_peak_sector_referred"), "mistake", rough_gear_peak,
        "10.771 + 2.356 = 13.127; with π = 3.14 it becomes 13.12"),
    Row("worked example", "greatest speed of the gear, referred to the sector", "13.1274", "rad per turn",
        lambda: ours("gear_speed_peak_sector_referred")),
    Row("worked example", "speed of the sector in the dwell", "2.3562", "rad per turn", lambda: ours("sector_speed_dwell")),
    Row("worked example", "greatest speed of the sector in its return", "10.771", "rad per turn", lambda: ours("sector_speed_return_peak")),
    Row("worked example", "greatest speed of the gear to the disc's", "5.5714", "1", lambda: ours("gear_speed_ratio_peak")),
    Row("worked example", "R₁/R₂ for a dwell of 0.625 of a turn", "0.2105", "1", lambda: number(of_dwell("0.625"), "radius_ratio")),
    Row("worked example", "disc angle where the sector stops, polynomial 3-4-5", "210.0", "°",
        lambda: degrees(number(by_law("polynomial_345"), "angle_stop"))),
    Row("worked example", "disc angle where the sector starts, polynomial 3-4-5", "310.0", "°",
        lambda: degrees(number(by_law("polynomial_345"), "angle_start"))),
    Row("worked example", "greatest speed of the gear, referred to the sector, polynomial 3-4-5", "11.7810", "rad per turn",
        lambda: number(by_law("polynomial_345"), "gear_speed_peak_sector_referred")),
    Row("worked example", "greatest speed of the gear to the disc's, polynomial 3-4-5", "5.0", "1",
        lambda: number(by_law("polynomial_345"), "gear_speed_ratio_peak")),
    Row("worked example", "greatest speed of the gear, referred to the sector, harmonic", "9.1497", "rad per turn",
        lambda: number(by_law("harmonic"), "gear_speed_peak_sector_referred")),
    Row("worked example", "greatest pressure angle of cam 1, arm of 0.3 R₂ at 72°", "43", "°", lambda: angle("cam_1_pressure_angle_max")),
    Row("worked example", "greatest pressure angle of cam 2, arm of 0.3 R₂ at 232°", "45", "°", lambda: angle("cam_2_pressure_angle_max")),
)  # fmt: skip
