"""The numbers of the clutch.

Loizyk V. V., Bryndas A. M., Shelonh N. M., Ternytskyi S. V. Analytical studies of drive mechanism parameters of flat cylinder
die-cutting press. Lviv Polytechnic National University (in Ukrainian). It prints formulas (eq. 12–17) and no numbers of the clutch.
"""

from __future__ import annotations

from functools import cache

from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.clutch import MECHANISM
from tests.machines import inputs, number
from tests.validation.rows import Row

WORKED = {
    "torque": "300 N*m",
    "service_factor": 1,
    "shoe_radius": "120 mm",
    "shoe_friction": 0.35,
    "wedge_angle": "10 deg",
    "wedge_friction": 0.1,
    "allowable_pressure": "0.4 MPa",
}


@cache
def worked_clutch() -> Calculation:
    """The clutch of the worked example."""
    return calculate(MECHANISM, inputs(MECHANISM, WORKED))


def clutch(name: str, scale: float = 1.0) -> float:
    """A number of the worked example."""
    return number(worked_clutch(), name) * scale


PLACE = "worked example"
ROWS = (
    Row(PLACE, "pressing force P (eq. 16)", "7142.857", "N", lambda: clutch("pressing_force")),
    Row(PLACE, "normal force on the cone N₂ (eq. 14)", "7383.234", "N", lambda: clutch("wedge_normal_force")),
    Row(PLACE, "engagement force P₁ (eq. 15)", "2009.192", "N", lambda: clutch("engagement_force")),
    Row(PLACE, "width of the shoes b (eq. 17)", "23.684", "mm", lambda: clutch("shoe_width", 1e3)),
    Row(PLACE, "release force", "-535.75", "N", lambda: clutch("release_force")),
)
