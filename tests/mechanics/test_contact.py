"""Hertz line contact against the elastic half plane: the pressure that is claimed must flatten what is claimed."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from diecut_report.mechanics import contact

STEEL = contact.effective_modulus_alike(210e9, 0.3)


@pytest.mark.parametrize("force, radius, length", [(5000.0, 0.012, 0.024), (300.0, 0.05, 0.01)])
def test_the_pressure_carries_the_force_and_flattens_the_bodies(force: float, radius: float, length: float) -> None:
    """Half-plane solution of a line load (Flamant): both bodies together give way by −2/(πE*)·∫p(s)·ln|x − s| ds."""
    half = contact.contact_half_width(force, STEEL, radius, length)
    top = contact.contact_pressure(force, STEEL, radius, length)

    def pressure(s: float) -> float:
        return float(top * np.sqrt(max(1 - s**2, 0)))

    assert quad(pressure, -1, 1)[0] * half == pytest.approx(force / length, rel=1e-7)

    def sunk(x: float) -> float:
        parts = (quad(lambda s: pressure(s) * np.log(abs(x - s)), a, b, limit=400)[0] for a, b in ((-1, x), (x, 1)))
        return float(-2 / (np.pi * STEEL) * half * sum(parts))

    for x in (0.3, 0.6, 0.9):
        assert sunk(0.0) - sunk(x) == pytest.approx((x * half) ** 2 / (2 * radius), rel=1e-5)


def test_steel_has_the_coefficients_of_the_usual_tables() -> None:
    """Roark, cylinder on a plane, ν = 0.3: σ = 0.591·√(pE/D), width of contact 2.15·√(pD/E), p the load for each length."""
    modulus, radius, length, force = 210e9, 0.01, 0.02, 1000.0
    load = force / length
    steel = contact.effective_modulus_alike(modulus, 0.3)
    assert contact.contact_pressure(force, steel, radius, length) / np.sqrt(
        load * modulus / (2 * radius)
    ) == pytest.approx(0.591, abs=5e-4)
    width = 2 * contact.contact_half_width(force, steel, radius, length)
    assert width / np.sqrt(load * 2 * radius / modulus) == pytest.approx(2.15, abs=5e-3)


@given(force=st.floats(-1e5, 1e5).filter(lambda f: abs(f) > 1), allowed=st.floats(1e8, 2e9))
def test_length_and_force_for_an_allowed_pressure_give_that_pressure(force: float, allowed: float) -> None:
    length = contact.required_length(force, STEEL, 0.012, allowed)
    assert contact.contact_pressure(force, STEEL, 0.012, length) == pytest.approx(allowed, rel=1e-12)


def test_arrays_are_single_numbers_together() -> None:
    forces = np.array([-2000.0, 0.0, 500.0])
    together = contact.contact_pressure(forces, STEEL, 0.01, 0.02)
    assert together == pytest.approx(
        [contact.contact_pressure(force, STEEL, 0.01, 0.02) for force in forces], rel=1e-15
    )
