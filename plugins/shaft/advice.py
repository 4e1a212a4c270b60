"""What would be enough: by how much the shaft must grow, for the messages of checks."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import Chapter, bind
from diecut_report.plugins.shaft import formulas

# fmt: off

Array = NDArray[Any]
SMALLEST, GREATEST = 0.2, 50.0  # times the given size
HALVINGS = 30
MARGIN = 1.002  # as the material point of the least safety moves a little

enough = Chapter("Sizes that would be enough",
                 text="With all diameters, bores and fillet radii so many times as great forces stay, bending and shear stresses fall by the third "
                      "power (where an axial force acts the second is counted on), deflections with the fourth.")


def growth(required: Array, sigma_a: Array, sigma_m: Array, tau_a: Array, tau_m: Array, own_k_t: Array, own_k_ts: Array, radius: Array,
           size: Array, factors: tuple[Array, ...], axial: Array) -> Array:
    """Return by how much the shaft must grow for the required safety against fatigue, (variants, 1)."""
    k_f, k_fs, endurance, tensile, neuber, neuber_s, share = factors
    power = np.where(axial > 0, 2, 3)

    def safety(scale: Array) -> Array:
        stresses = (each / scale**power for each in (sigma_a, sigma_m, tau_a, tau_m))
        grown = [
            factor * formulas.fatigue_factor(formulas.notch_sensitivity(radius * scale, length), shape)
            / formulas.fatigue_factor(formulas.notch_sensitivity(radius, length), shape)
            for factor, length, shape in ((k_f, neuber, own_k_t), (k_fs, neuber_s, own_k_ts))
        ]
        smaller = formulas.size_factor(size * scale, share) / formulas.size_factor(size, share)
        found: Array = np.min(formulas.goodman(*stresses, *grown, endurance * smaller, tensile), axis=1, keepdims=True)
        return found

    low, high = np.full_like(required, SMALLEST), np.full_like(required, GREATEST)
    for _ in range(HALVINGS):
        middle = np.sqrt(low * high)
        is_enough = safety(middle) >= required
        low, high = np.where(is_enough, low, middle), np.where(is_enough, middle, high)
    found: Array = high * MARGIN
    return found


def _growth(required: Array, sigma_a: Array, sigma_m: Array, tau_a: Array, tau_m: Array, k_t: Array, k_ts: Array, radius: Array, size: Array,
            k_f: Array, k_fs: Array, endurance: Array, tensile: Array, neuber: Array, neuber_s: Array, share: Array, axial: Array) -> Array:
    return growth(required, sigma_a, sigma_m, tau_a, tau_m, k_t, k_ts, radius, size, (k_f, k_fs, endurance, tensile, neuber, neuber_s, share), axial)


enough.computed("fatigue_growth", "s_f", "1", "Growth that meets the safety against fatigue", _growth,
                ("required_fatigue_safety", "sigma_a", "sigma_m", "tau_a", "tau_m", "k_t", "k_ts", "place_radius", "place_diameter", "k_f", "k_fs",
                 "place_endurance", "tensile_strength", "neuber_bending", "neuber_torsion", "size_share", "axial_reaction_max"),
                "found by halving, with notch sensitivity and size factor of the greater shaft", output=False)
enough.value("yield_growth", "s_y", "1", "Growth that meets the safety against yield",
             lambda required_yield_safety, yield_safety, axial_reaction_max:
                 np.where(axial_reaction_max > 0, (required_yield_safety / yield_safety) ** 0.5, (required_yield_safety / yield_safety) ** (1 / 3)),
             source="this method", output=False)
TWISTED = {"exists": lambda torque_span: torque_span > 0}
for name, symbol, title, what, allowed, options in (
    ("slope_growth", "s_v′", "slope at the bearings", "bearing_slope_max", "allowable_bearing_slope", {}),
    ("deflection_growth", "s_v", "deflection", "deflection_max", "allowable_deflection", {"needs": ("allowable_deflection",)}),
    ("twist_growth", "s_ϑ", "twist", "twist_by_length", "allowable_twist", {"needs": ("allowable_twist",), **TWISTED}),
):
    enough.value(name, symbol, "1", f"Growth that meets the allowed {title}", bind(lambda what, allowed: (what / allowed) ** 0.25,
                                                                                what=what, allowed=allowed),
                 source="this method", output=False, **options)
enough.total("notch_yield", "S_y,n", "MPa", "Yield strength that no notch passes", "max", of="notch_stress", source="Shigley 7-16", output=False)
enough.value("half_critical", "n_crit/2", "rpm", "Speed that is far enough from the critical one", lambda critical_speed: critical_speed / 2,
             source="Shigley 7-6", output=False)
enough.value("effective_diameter", "d_e", "mm", "Effective diameter there", lambda size_share, place_diameter: size_share * place_diameter,
             source="Shigley 6-24", output=False)
enough.total("greatest_effective", "d_e,max", "mm", "Greatest effective diameter", "max", of="effective_diameter", source="Shigley 6-24",
             output=False)
