"""The torque that 001 prints for the converted platen press ZPPT-30, and worked examples of its method.

Banakh Yu. O. Estimation of torques during die-cutting, with the compliance of the press, on a machine of the platen type. Naukovi
zapysky (Ukrainian Academy of Printing), 1999, no. 1 (in Ukrainian). The paper prints the machine's data and one result.
"""

from __future__ import annotations

from functools import cache
from math import degrees, pi, radians
from typing import Any

from diecut_report.machine.calculation import Calculation
from tests.machines import at, number
from tests.plugins.platens import platen
from tests.validation.rows import Row

WORKED = "worked example"
SILENT = "worked example, without the inertia force"
DOUBLE = "worked example, 1 mm of board, without the inertia force"
LIGHT = {"platen_mass": 0}


@cache
def press(**changes: Any) -> Calculation:
    """The machine of the source with changes."""
    return platen(**changes)


def ours(name: str, scale: float = 1.0, **changes: Any) -> float:
    """A number of the machine; angles in degrees."""
    value = number(press(**changes), name) * scale
    return degrees(value) if name.endswith("angle") else value


def eq_14(angle: float) -> float:
    """Eq. 14 as printed at an angle (°) before the dead centre, N·m."""
    return float(at(press(), "torque_source", 2 * pi - radians(angle))[0])


ROWS = (
    Row("conclusion 1", "greatest torque while cutting", "5100", "N·m", lambda: ours("torque_max_source"), "cannot be reproduced",
        lambda: eq_14(0.265), "eq. 14 passes it 0.27° before the dead centre on its way up to 5496 N·m at 2.24°; 5100 N·m is 2 % above P_max·X, "
        "the friction at the dead centre alone"),
    Row(WORKED, "friction arm X", "9.9915", "mm", lambda: ours("friction_arm", 1e3)),
    Row(WORKED, "P_max·X", "4995.77", "N·m", lambda: ours("torque_relaxing")),
    Row(WORKED, "torque at the dead centre, with the inertia force", "4994.55", "N·m", lambda: ours("torque_dead_center")),
    Row(WORKED, "inertia force at the dead centre", "122", "N", lambda: ours("inertia_dead_center")),
    Row(WORKED, "greatest inertia force, at 180°", "173", "N", lambda: ours("inertia_force_max")),
    Row(WORKED, "friction arm at 180°", "11.64", "mm", lambda: float(at(press(), "joint_arm", pi)[0]) * 1e3),
    Row(WORKED, "cutting starts before the dead centre", "8.28", "°", lambda: ours("cutting_start_angle")),
    Row(WORKED, "rods relaxed after the dead centre", "5.7007", "°", lambda: ours("dwell_end_angle")),
    Row(SILENT, "maximum torque", "6411", "N·m", lambda: ours("torque_max", **LIGHT)),
    Row(SILENT, "its angle before the dead centre", "3.12", "°", lambda: ours("torque_max_angle", **LIGHT)),
    Row(SILENT, "greatest torque by eq. 14 as printed", "5497", "N·m", lambda: ours("torque_max_source", **LIGHT)),
    Row(SILENT, "its angle before the dead centre", "2.24", "°", lambda: ours("torque_max_source_angle", **LIGHT)),
    Row(SILENT, "work of cutting and relaxing", "937.8", "J", lambda: ours("work_per_cycle", **LIGHT)),
    Row(SILENT, "work of friction", "812.8", "J", lambda: ours("friction_work", **LIGHT)),
    Row(WORKED, "work of cutting the board", "125", "J", lambda: ours("cutting_work")),
    Row(WORKED, "strain energy of the rods", "112.5", "J", lambda: ours("strain_energy")),
    Row(WORKED, "greatest arm of the relaxing rods", "9.041", "mm", lambda: ours("elastic_arm", 1e3)),
    Row(WORKED, "least return arm", "0.950", "mm", lambda: ours("return_arm_min", 1e3)),
    Row(WORKED, "friction at which the torque would reverse", "0.0905", "", lambda: ours("friction_limit")),
    Row(WORKED, "stretch at which the torque would reverse", "0.550", "mm", lambda: ours("deformation_limit", 1e3)),
    Row(DOUBLE, "maximum torque", "6925", "N·m", lambda: ours("torque_max", material_thickness=1, **LIGHT)),
    Row(DOUBLE, "greatest torque by eq. 14 as printed", "6103", "N·m", lambda: ours("torque_max_source", material_thickness=1, **LIGHT)),
)  # fmt: skip
