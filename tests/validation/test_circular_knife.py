"""The circular knife's worked example by a second computation."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import integrate, optimize

from tests.machines import number
from tests.validation.rows_circular_knife import example


def test_a_second_computation_with_roots_and_quadratures_of_its_own_agrees() -> None:
    """The method's integrals over the thickness as they stand, the range by scipy's brentq, the work by its quad."""
    r, edge, depth, front, thickness, length, stress, friction = 0.02, 0.1, 0.112, 0.026, 5e-4, 0.015, 1e7, 0.3

    def position(phi: float, y: float) -> float:
        return float(r * np.cos(phi) + np.sqrt(edge**2 - (y - r * np.sin(phi)) ** 2))

    def force(phi: float) -> float:
        return stress * integrate.quad(lambda y: position(phi, y) - position(phi, depth), depth - thickness, depth)[0]

    def torque(phi: float) -> float:
        def rate(y: float) -> float:
            down = y - r * np.sin(phi)
            return float(-r * np.sin(phi) + r * np.cos(phi) * down / np.sqrt(edge**2 - down**2))

        tau = np.arccos((depth - r * np.sin(phi)) / edge)
        useful = stress * integrate.quad(lambda y: (depth - y) * rate(y), depth - thickness, depth)[0]
        return float(useful + friction * force(phi) / np.cos(tau) * (edge + r * np.sin(phi + tau)))

    low, high = np.arcsin((depth - edge) / r) + 1e-9, np.arcsin(depth / (edge + r))
    start = optimize.brentq(lambda p: position(p, depth) - front, low, high)
    end = optimize.brentq(lambda p: position(p, depth) - front - length, low, high)
    calc = example()
    assert number(calc, "angle_start") == pytest.approx(start, rel=1e-12)
    assert number(calc, "angle_end") == pytest.approx(end, rel=1e-12)
    assert number(calc, "force_max") == pytest.approx(force(start), rel=1e-9)
    assert number(calc, "torque_max") == pytest.approx(torque(start), rel=1e-9)
    assert number(calc, "work") == pytest.approx(integrate.quad(torque, start, end, epsrel=1e-11)[0], rel=1e-9)
