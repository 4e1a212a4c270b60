"""Fatigue and critical speed of shafts by published solutions, and the worked example of the method.

Budynas R. G., Nisbett J. K. Shigley's Mechanical Engineering Design, solutions manual to chapter 7 (problems 7-1, 7-2) and, in the book,
examples 6-6 and 7-5. The worked example is the crankshaft of a flat-cylinder press.
"""

from __future__ import annotations

from math import pi

import numpy as np
from scipy.optimize import brentq

from diecut_report.mechanics.beams import Supports, influence
from diecut_report.plugins.shaft import formulas
from tests.machines import number
from tests.plugins.shafts import crankshaft, row
from tests.validation.rows import Row

KPSI, INCH, POUND = 6.894757e6, 25.4e-3, 4.4482216
TORQUE = POUND * INCH  # of 1 lbf·in


def goodman_diameter() -> float:
    """The diameter of problem 7-1 (d), in inches, by the program's formula of the safety."""

    def missing(inches: float) -> float:
        d = inches * INCH
        sigma_a, sigma_m = (32 * moment * TORQUE / (pi * d**3) for moment in (600, 500))
        tau_a, tau_m = (16 * torque * TORQUE / (pi * d**3) for torque in (400, 300))
        return float(formulas.goodman(sigma_a, sigma_m, tau_a, tau_m, 2.2, 1.8, 30 * KPSI, 100 * KPSI)) - 2

    return float(brentq(missing, 0.5, 2))


def factor_of_size() -> float:
    """The size factor of problem 7-2."""
    return float(formulas.size_factor(0.022, 1.0))


def endurance() -> float:
    """The endurance limit of problem 7-2, MPa."""
    limit = formulas.endurance_of_specimen(1226e6) * formulas.surface_factor(4.51, -0.265, 1226e6) * factor_of_size()
    return float(limit) / 1e6


def notch(concentration: float) -> float:
    """The fatigue notch factor of example 6-6."""
    return float(
        formulas.fatigue_factor(formulas.notch_sensitivity(3e-3, formulas.neuber_bending(690e6)), concentration)
    )


def at_middle(load: float, place: float) -> float:
    """The load at the middle of the shaft of example 7-5 that is equivalent to one at a place (lbf, inches)."""
    x = np.sort([0.0, place, 15.5, 31.0])[:, None] * INCH
    places = np.array([[place], [15.5]]) * INCH
    found = influence(x, np.ones((3, 1)), places, Supports(np.array([0.0]), np.array([31 * INCH])))[0]
    return float(load * found[0, 0] / found[1, 1])


def crank(name: str, place: str, scale: float = 1.0) -> float:
    """A number of the worked example at a place."""
    return row(crankshaft(), name)[place] * scale


MANUAL = "Shigley, solutions manual"
EXAMPLE = "worked example"
ROWS = (
    Row(f"{MANUAL} 7-1", "diameter by DE-Goodman, n = 2", "1.073", "in", goodman_diameter),
    Row(f"{MANUAL} 7-2", "surface factor k_a", "0.685", "1", lambda: float(formulas.surface_factor(4.51, -0.265, 1226e6))),
    Row(
        f"{MANUAL} 7-2", "size factor k_b", "0.893", "1", factor_of_size, "mistake", lambda: (22 / 7.62) ** -0.107,
        "the source rounds the factor otherwise, (d/7.62)^−0.107 beside 1.24 d^−0.107",
    ),
    Row(
        f"{MANUAL} 7-2", "endurance limit S_e", "375", "MPa", endurance, "mistake", lambda: 0.685 * 0.893 * 0.5 * 1226,
        "follows from the size factor above",
    ),
    Row("Shigley, example 6-6", "fatigue notch factor K_f", "1.55", "1", lambda: notch(1.65)),
    Row("Shigley, example 7-5", "35 lbf at 7 in as a load at the middle", "17.1", "lbf", lambda: at_middle(35, 7)),
    Row("Shigley, example 7-5", "55 lbf at 20 in as a load at the middle", "46.1", "lbf", lambda: at_middle(55, 20)),
    Row(EXAMPLE, "greatest reaction of bearing A", "4444.857", "N", lambda: number(crankshaft(), "reaction_a_max")),
    Row(EXAMPLE, "greatest reaction of bearing B", "15476.789", "N", lambda: number(crankshaft(), "reaction_b_max")),
    Row(EXAMPLE, "amplitude of the bending stress at the shoulder 60/50", "61.0788", "MPa", lambda: crank("sigma_a", "shoulder 3", 1e-6)),
    Row(EXAMPLE, "amplitude of the shear stress there", "16.7253", "MPa", lambda: crank("tau_a", "shoulder 3", 1e-6)),
    Row(EXAMPLE, "safety against fatigue there", "1.7132", "1", lambda: crank("place_safety", "shoulder 3")),
    Row(EXAMPLE, "safety against fatigue at the shoulder 55/60", "2.0842", "1", lambda: crank("place_safety", "shoulder 2")),
    Row(EXAMPLE, "nominal safety against yield", "9.242", "1", lambda: number(crankshaft(), "yield_safety")),
    Row(EXAMPLE, "slope at bearing B", "0.72818", "mrad", lambda: number(crankshaft(), "slope_b") * 1e3),
    Row(EXAMPLE, "deflection of the end", "93.967", "µm", lambda: number(crankshaft(), "deflection_end") * 1e6),
    Row(EXAMPLE, "critical speed", "40568", "rpm", lambda: number(crankshaft(), "critical_speed") * 30 / pi),
    Row(EXAMPLE, "critical speed by Rayleigh", "40578", "rpm", lambda: number(crankshaft(), "critical_speed_rayleigh") * 30 / pi),
    Row(EXAMPLE, "critical speed by Dunkerley", "37154", "rpm", lambda: number(crankshaft(), "critical_speed_dunkerley") * 30 / pi),
)  # fmt: skip
