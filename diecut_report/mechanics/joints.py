"""Strength of joints and bars, as formulas: pins, bars in tension and bending, struts; forces count in either direction."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.formulas.expression import as_number, pi
from diecut_report.formulas.formula import formula
from diecut_report.mechanics.sections import round_bar

# A pin in an eye, between the cheeks of a fork (Roloff/Matek, Machine elements, chapter on pins).


@formula
def pin_pressure(force: Any, diameter: Any, length: Any) -> Any:
    """Mean pressure of a pin on an eye, on the projected area."""
    return abs(force) / (diameter * length)


@formula
def pin_shear(force: Any, diameter: Any, planes: Any) -> Any:
    """Mean shear stress of a full pin in one shear plane or two; the greatest of a short pin is 4/3 of it."""
    return abs(force) / (planes * round_bar(diameter).area)


@formula
def pin_moment(force: Any, eye: Any, cheek: Any) -> Any:
    """Bending moment in the middle of a pin that fits loosely, its load even over the eye's width and over that of each cheek."""
    return abs(force) * (eye + 2 * cheek) / 8


# A bar, and a strut (Shigley's Mechanical Engineering Design, 4-12 and 4-13, columns of Euler and Johnson).


@formula
def edge_stress(force: Any, area: Any, moment: Any, modulus: Any) -> Any:
    """Greatest stress of a bar in tension or compression and bending, at its edge."""
    return abs(force) / area + abs(moment) / modulus


@formula
def equivalent_stress(normal: Any, shear: Any) -> Any:
    """Von Mises stress of a normal and a shear stress (Shigley 5-15, 7-4)."""
    return np.sqrt(normal**2 + 3 * shear**2)


@formula
def limiting_slenderness(elastic_modulus: Any, yield_strength: Any) -> Any:
    """Slenderness above which a strut buckles by Euler, below it by Johnson: there half the yield strength is reached (Shigley 4-45)."""
    return as_number(pi) * np.sqrt(2 * elastic_modulus / yield_strength)


@formula
def buckling_stress(slenderness: Any, elastic_modulus: Any, yield_strength: Any) -> Any:
    """Stress at which a strut buckles, by its slenderness: effective length to least radius of gyration (Shigley 4-44, 4-48)."""
    johnson = yield_strength - (yield_strength * slenderness / (2 * as_number(pi))) ** 2 / elastic_modulus
    euler = as_number(pi) ** 2 * elastic_modulus / slenderness**2
    return np.where(slenderness > limiting_slenderness(elastic_modulus, yield_strength), euler, johnson)
