"""The numbers of rolling bearings that catalogues and textbooks print.

SKF, General catalogue 6000, selection of bearing size, example 1: bearing 6309; table 2, revolutions of a swing.
SKF Bearing Calculator, report on bearing 6309 of 25 January 2015.
NSK, Rolling bearings, section 5.7, examples 1 to 3: bearings 6208 and 6210.
Mott R. L. Machine Elements in Mechanical Design. 4th ed. Prentice Hall, 2004; example problem 14-6: bearing 6308 under three loads in turn.
A notebook on Shigley's tables 11-1 and 11-2 (jeevanjyoti4/dome): 02 series, 65 mm bore, outer ring turning; these are ISO's with f0 = 12.3.
EPK, General catalogue 2011, table 9, and NKE, catalogue, table 6.8: life factors of the reliability by ISO 281:2007.
"""

from __future__ import annotations

from functools import cache, partial

import numpy as np

from diecut_report.machine.calculation import Calculation
from tests.plugins.bearings import BALL, ROLLER, SOUGHT, Over, bearings, one, value
from tests.validation.rows import Row

HOUR, POUND = 3600.0, 4.4482216152605
LEVELS = {95: "0.64", 96: "0.55", 97: "0.47", 98: "0.37", 99: "0.25"}


@cache
def skf() -> Calculation:
    """Example 1 of the catalogue."""
    return one(BALL, dynamic_rating=55.3, static_rating=31.5, radial_force="10 kN", speed=3000)


@cache
def calculator() -> Calculation:
    """The bearing of the report."""
    return one(
        BALL, dynamic_rating=55.3, static_rating=31.5, f0=13, radial_force="4 kN", axial_force="0.5 kN", speed=1800
    )


@cache
def nsk(axial: float) -> Calculation:
    """Examples 1 and 3."""
    return one(BALL, dynamic_rating=29.1, static_rating=17.9, f0=14, radial_force=2500, axial_force=axial, speed=900)


@cache
def sought() -> Calculation:
    """Example 2, the bearing sought in the table of this program."""
    keys = {name: each for name, each in SOUGHT.items() if name != "axial_force"}
    return bearings(keys | {"radial_force": 3000, "speed": 1900, "bore_min": 50}, required_life=10000)


@cache
def mott() -> Calculation:
    """Three loads in turn, in pounds, over half, a sixth and a third of the time."""
    loads = Over(
        lambda phi: np.select([phi < np.pi, phi < 4 / 3 * np.pi], [650 * POUND, 750 * POUND], 250 * POUND),
        (1 / 2, 2 / 3),
    )
    return one(BALL, radial_force=loads, speed=600)


@cache
def shigley() -> Calculation:
    """The bearing of the notebook."""
    return one(BALL, dynamic_rating=55.9, static_rating=34, f0=12.3, radial_force=8400, axial_force=3000, speed=500)


@cache
def swinging() -> Calculation:
    """A roller bearing that swings by 35° to either side."""
    keys = {name: each for name, each in ROLLER.items() if name != "speed"}
    return one(keys, relative_angle=Over(lambda phi: np.radians(35) * np.sin(phi)), cycle_speed=60)


@cache
def reliable(level: int) -> Calculation:
    """A bearing of a reliability."""
    return bearings(BALL, reliability=level)


def ratio(level: int) -> float:
    """Modified to basic life."""
    return value(reliable(level), "life_modified") / value(reliable(level), "life")


ROWS = (
    Row("SKF, example 1", "basic rating life", "169", "10⁶", lambda: value(skf(), "life_revolutions") / 1e6),
    Row("SKF, example 1", "basic rating life", "940", "h", lambda: value(skf(), "life") / HOUR),
    Row("SKF, table 2", "turns in a swing of 35° to either side, 2γ/180°", "0.38889", "1", lambda: value(swinging(), "turns_per_cycle")),
    Row("SKF calculator", "equivalent load", "4", "kN", lambda: value(calculator(), "equivalent_load") / 1e3),
    Row("SKF calculator", "load ratio C/P", "13.8", "1", lambda: value(calculator(), "load_ratio")),
    Row("SKF calculator", "basic rating life", "2.45e4", "h", lambda: value(calculator(), "life") / HOUR),
    Row("NSK, example 1", "life", "2.9e4", "h", lambda: value(nsk(0), "life") / HOUR),
    Row("NSK, example 2", "dynamic rating of the bearing that is chosen (6210)", "35.0", "kN", lambda: value(sought(), "dynamic_rating") / 1e3),
    Row("NSK, example 3", "f₀F_a/C₀", "0.782", "1", lambda: value(nsk(1000), "relative_axial")),
    Row("NSK, example 3", "axial factor Y", "1.67", "1", lambda: value(nsk(1000), "axial_factor")),
    Row("NSK, example 3", "equivalent load", "3.07e3", "N", lambda: value(nsk(1000), "equivalent_load")),
    Row("Mott, 14-6", "mean effective load", "597", "lb", lambda: value(mott(), "equivalent_load") / POUND),
    Row("Shigley, 65 mm bore", "axial factor Y", "1.53", "1", lambda: value(shigley(), "axial_factor")),
    *(Row("EPK, table 9; NKE, table 6.8", f"life factor of {level} %", text, "1", partial(ratio, level)) for level, text in LEVELS.items()),
)  # fmt: skip
