"""Formulas of strength: endurance limit, notches, safeties (Shigley, chapters 6 and 7; Peterson's charts)."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import Constant, formula, number
from diecut_report.mechanics.joints import equivalent_stress

MEGAPASCAL = Constant(1e6, "1 MPa", "Pa")
KPSI = Constant(6.894757e6, "1 kpsi", "Pa")
MILLIMETRE = Constant(1e-3, "1 mm", "m")
INCH = Constant(25.4e-3, "1 in", "m")
GREATEST_ENDURANCE = Constant(700e6, "700 MPa", "Pa")
GREATEST_SIZE = Constant(254e-3, "254 mm", "m")
MIDDLE_SIZE = Constant(51e-3, "51 mm", "m")
REFERENCE_SIZE = Constant(7.5e-3, "7.5 mm", "m")
SIZE_OF_TABLE = Constant(40e-3, "40 mm", "m")
REFERENCE_STRENGTH = Constant(1e9, "1000 MPa", "Pa")


@formula
def endurance_of_specimen(tensile_strength: Any) -> Any:
    """Endurance limit of the polished specimen (Shigley 6-8)."""
    return np.minimum(0.5 * tensile_strength, GREATEST_ENDURANCE)


@formula
def surface_factor(surface_a: Any, surface_b: Any, tensile_strength: Any) -> Any:
    """Surface factor (Shigley 6-19), at most 1."""
    return np.minimum(surface_a * (tensile_strength / MEGAPASCAL) ** surface_b, 1)


@formula
def size_factor(diameter: Any, size_share: Any) -> Any:
    """Size factor (Shigley 6-20) of the effective diameter; above 254 mm that of 254 mm."""
    effective = np.minimum(size_share * diameter, GREATEST_SIZE)
    return np.where(
        effective <= MIDDLE_SIZE,
        1.24 * (effective / MILLIMETRE) ** -0.107,
        1.51 * (effective / MILLIMETRE) ** -0.157,
    )


@formula
def neuber_bending(tensile_strength: Any) -> Any:
    """Neuber's length in bending (Shigley 6-35a)."""
    strength = tensile_strength / KPSI
    return (0.246 - 3.08e-3 * strength + 1.51e-5 * strength**2 - 2.67e-8 * strength**3) ** 2 * INCH


@formula
def neuber_torsion(tensile_strength: Any) -> Any:
    """Neuber's length in torsion (Shigley 6-35b)."""
    strength = tensile_strength / KPSI
    return (0.190 - 2.51e-3 * strength + 1.35e-5 * strength**2 - 2.67e-8 * strength**3) ** 2 * INCH


@formula
def notch_sensitivity(radius: Any, neuber: Any) -> Any:
    """Notch sensitivity (Shigley 6-34), 0 without a radius."""
    return np.sqrt(radius) / (np.sqrt(radius) + np.sqrt(neuber))


@formula
def quadratic(constant: Any, linear: Any, square: Any, root: Any) -> Any:
    """A coefficient of Peterson's charts as they are fitted, of w = √(t/r)."""
    return constant + linear * root + square * root**2


BENDING = (  # constant, linear and square term of C_1 … C_4, for t/r up to 2 and above (Peterson, chart 3.10)
    ((0.947, 1.206, -0.131), (1.232, 0.832, -0.008)),
    ((0.022, -3.405, 0.915), (-3.813, 0.968, -0.260)),
    ((0.869, 1.777, -0.555), (7.423, -4.868, 0.869)),
    ((-0.810, 0.422, -0.260), (-3.839, 3.070, -0.600)),
)
TORSION = (  # the same (Peterson, chart 3.12)
    (0.905, 0.783, -0.075),
    (-0.437, -1.969, 0.553),
    (1.557, 1.073, -0.578),
    (-1.061, 0.171, 0.086),
)


@formula
def fatigue_factor(sensitivity: Any, concentration: Any) -> Any:
    """Fatigue notch factor (Shigley 6-32)."""
    return 1 + sensitivity * (concentration - 1)


@formula
def press_fit_factor(tensile_strength: Any) -> Any:
    """Fatigue notch factor of a press fit in bending, of 40 mm (DIN 743-2, table 1)."""
    return 2.7 * (tensile_strength / REFERENCE_STRENGTH) ** 0.43


@formula
def keyseat_factor(tensile_strength: Any) -> Any:
    """Fatigue notch factor of a keyseat in bending, of 40 mm (DIN 743-2, table 1)."""
    return 3 * (tensile_strength / REFERENCE_STRENGTH) ** 0.38


@formula
def size_of_notch(factor: Any, diameter: Any) -> Any:
    """How a size lowers the endurance of a notch with a factor (DIN 743-2, K_3), of 7.5 to 150 mm."""
    share = np.log(np.minimum(np.maximum(diameter / REFERENCE_SIZE, 1), 20)) / np.log(number(20))
    return 1 - 0.2 * np.log10(factor) * share


@formula
def goodman(
    sigma_a: Any, sigma_m: Any, tau_a: Any, tau_m: Any, k_f: Any, k_fs: Any, endurance: Any, tensile_strength: Any
) -> Any:
    """Safety against fatigue by distortion energy and Goodman (Shigley 7-7)."""
    alternating = equivalent_stress(k_f * sigma_a, k_fs * tau_a)
    mean = equivalent_stress(k_f * sigma_m, k_fs * tau_m)
    return 1 / np.maximum(alternating / endurance + mean / tensile_strength, 1e-6)


@formula
def nominal_stress(axial_force: Any, moment: Any, torque: Any, area: Any, modulus: Any) -> Any:
    """Greatest von Mises stress of a section without notches (Shigley 7-15)."""
    return equivalent_stress(axial_force / area + moment / modulus, torque / (2 * modulus))


@formula
def yield_stress(axial_force: Any, moment: Any, torque: Any, area: Any, modulus: Any, k_f: Any, k_fs: Any) -> Any:
    """Greatest von Mises stress of a section with the fatigue factors of its notch (Shigley 7-15)."""
    return nominal_stress(axial_force, k_f * moment, k_fs * torque, area, modulus)
