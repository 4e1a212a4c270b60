"""The numbers of gear pairs.

Bolsover, D. Profile shifted external spur gears: the table of the maker KHK. bolsover.com, utilities for Alibre.
hanslhansl. din3990: DIN 3990-11 and DIN 21771 as public code, printed run in tests/test_1.py (commit 22b8478).
Gear generating profile shift calculations: a helical pair by ISO 21771. Scribd 376176518.
"""

from __future__ import annotations

from functools import cache
from math import degrees, pi, radians

from diecut_report.machine.calculation import Calculation
from diecut_report.plugins.gear_pair import formulas as f
from tests.machines import number
from tests.plugins.gears import STEEL, pair
from tests.validation.rows import Row

ELASTICITY = 189.8  # √MPa, that the code takes for Z_E
MODULUS = f"{2 * pi * (1 - 0.3**2) * ELASTICITY**2!r} MPa"
TABLE = STEEL | {
    "module": 3, "teeth_1": 12, "teeth_2": 24, "shift_1": 0.6, "center_distance": 56.5, "keep_clearance": True, "face_width": 30, "torque": 10,
}  # fmt: skip
CODE = STEEL | {
    "module": 4, "teeth_1": 19, "teeth_2": 104, "shift_1": 0.5, "shift_2": 0.15, "root_radius": 0.25, "face_width": 48.64,
    "torque": 535.9299104114843, "speed": 980, "elastic_modulus_1": MODULUS, "elastic_modulus_2": MODULUS,
}  # fmt: skip
SHEET = STEEL | {
    "module": 3.5, "teeth_1": 30, "teeth_2": 31, "helix_angle": "21 deg", "center_distance": 116.5, "shift_1": 0.360877131252,
    "face_width": 30, "torque": 10,
}  # fmt: skip
MACHINES = {"table": TABLE, "code": CODE, "sheet": SHEET}


@cache
def machine(which: str) -> Calculation:
    """One of the pairs."""
    return pair(MACHINES[which])


def found(which: str, name: str, scale: float = 1.0) -> float:
    """A number of one of the pairs."""
    return number(machine(which), name) * scale


def angle(which: str, name: str) -> float:
    """An angle of one of the pairs in degrees."""
    return degrees(found(which, name))


def chord_at(gear: int, theta: float) -> float:
    """The chord of a root in mm for an angle ϑ in degrees."""
    known = found("code", f"virtual_teeth_{gear}"), radians(theta), found("code", f"rounding_height_{gear}"), 0.25
    return 4 * float(f.root_chord(*known))


EARLY = "the code stops its search for ϑ before its equation holds; with the printed ϑ the chord is the printed one"
KHK, RUN, SHIFTS = "table of a profile-shifted pair", "printed run of the code", "helical pair"
ROWS = (
    Row(KHK, "working pressure angle", "26.0888", "°", lambda: angle("table", "working_pressure_angle")),
    Row(KHK, "distance coefficient y", "0.83333", "", lambda: found("table", "distance_coefficient")),
    Row(KHK, "sum of the shifts", "0.960", "", lambda: 0.6 + found("table", "shift_2")),
    Row(KHK, "base diameter of the pinion", "33.8289", "mm", lambda: found("table", "base_diameter_1", 1e3)),
    Row(KHK, "base diameter of the wheel", "67.6579", "mm", lambda: found("table", "base_diameter_2", 1e3)),
    Row(KHK, "working pitch diameter of the pinion", "37.667", "mm", lambda: found("table", "working_diameter_1", 1e3)),
    Row(KHK, "working pitch diameter of the wheel", "75.333", "mm", lambda: found("table", "working_diameter_2", 1e3)),
    Row(KHK, "tip diameter of the pinion", "44.840", "mm", lambda: found("table", "tip_diameter_1", 1e3)),
    Row(KHK, "tip diameter of the wheel", "79.400", "mm", lambda: found("table", "tip_diameter_2", 1e3)),
    Row(KHK, "root diameter of the pinion", "32.100", "mm", lambda: found("table", "root_diameter_1", 1e3)),
    Row(KHK, "root diameter of the wheel", "66.660", "mm", lambda: found("table", "root_diameter_2", 1e3)),
    Row(KHK, "contact ratio", "1.202", "", lambda: found("table", "contact_ratio")),
    Row(SHIFTS, "reference distance of the axes", "114.3447280708", "mm", lambda: found("sheet", "reference_distance", 1e3)),
    Row(SHIFTS, "transverse pressure angle", "21.2990642859", "°", lambda: angle("sheet", "transverse_angle")),
    Row(SHIFTS, "working pressure angle", "23.8707609654", "°", lambda: angle("sheet", "working_pressure_angle")),
    Row(SHIFTS, "shift of the gear with 31 teeth (eq. 62)", "0.2910000000", "", lambda: found("sheet", "shift_2")),
    Row(RUN, "working pressure angle", "21.531902292465", "°", lambda: angle("code", "working_pressure_angle")),
    Row(RUN, "distance of the axes", "248.506843355171", "mm", lambda: found("code", "center_distance", 1e3)),
    Row(RUN, "base diameter of the wheel", "390.91213024694", "mm", lambda: found("code", "base_diameter_2", 1e3)),
    Row(RUN, "working pitch diameter of the pinion", "76.77447193087", "mm", lambda: found("code", "working_diameter_1", 1e3)),
    Row(RUN, "contact ratio", "1.53632359458323", "", lambda: found("code", "contact_ratio")),
    Row(RUN, "pitch velocity of the reference circle", "3.89976368", "m/s", lambda: found("code", "pitch_velocity") * 76 / 76.77447193086583),
    Row(RUN, "tangential force", "14103.418695", "N", lambda: found("code", "tangential_force")),
    Row(RUN, "contact ratio factor Z_ε", "0.906214912961", "", lambda: found("code", "contact_ratio_factor")),
    Row(RUN, "zone factor Z_H", "2.39594066709", "", lambda: found("code", "zone_factor")),
    Row(RUN, "M₁", "1.00554704550", "", lambda: found("code", "single_contact_1")),
    Row(RUN, "M₂", "0.88355901023", "", lambda: found("code", "single_contact_2")),
    Row(RUN, "Z_B", "1.00554704550", "", lambda: found("code", "contact_factor_1")),
    Row(RUN, "Z_D", "1.0", "", lambda: found("code", "contact_factor_2")),
    Row(RUN, "nominal contact stress σ_H0, with Z_E = 189.8 √MPa", "875.38273790", "MPa", lambda: found("code", "nominal_contact_stress", 1e-6)),
    Row(RUN, "E of the root", "0.62153394405", "mm", lambda: found("code", "half_tip_width", 4)),
    Row(RUN, "G of the pinion", "-0.5", "", lambda: found("code", "rounding_height_1")),
    Row(RUN, "G of the wheel", "-0.85", "", lambda: found("code", "rounding_height_2")),
    Row(RUN, "H of the pinion", "-0.898206725851", "", lambda: found("code", "tangent_offset_1")),
    Row(RUN, "H of the wheel", "-1.019978073489", "", lambda: found("code", "tangent_offset_2")),
    Row(RUN, "chord of the root of the pinion s_Fn", "8.748743", "mm", lambda: found("code", "root_chord_1", 1e3), "mistake",
        lambda: chord_at(1, 48.10260415904784), EARLY),
    Row(RUN, "chord of the root of the wheel s_Fn", "9.239505", "mm", lambda: found("code", "root_chord_2", 1e3), "mistake",
        lambda: chord_at(2, 56.99835389167487), EARLY),
)  # fmt: skip
