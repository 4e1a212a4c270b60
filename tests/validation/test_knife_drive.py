"""What 004 prints of its equations, beside the corrected forms."""

from __future__ import annotations

import numpy as np
import pytest

from diecut_report.mechanics import slider_crank
from tests.machines import number
from tests.validation.rows_knife_drive import knife

PHI = np.linspace(0.05, 6.2, 200)
LAMBDA = 4.0
BETA = np.arcsin(np.sin(PHI) / LAMBDA)


def test_the_printed_displacement_of_eq_2_is_no_integral_of_its_velocity() -> None:
    printed_velocity = np.sin(PHI) + np.cos(PHI) * np.tan(BETA)
    step = 1e-5

    def slope(displacement: object) -> np.ndarray:
        assert callable(displacement)
        return np.asarray((displacement(PHI + step) - displacement(PHI - step)) / (2 * step))

    def printed(phi: np.ndarray) -> np.ndarray:
        return np.asarray(1 + LAMBDA * np.cos(phi) - LAMBDA * np.cos(np.arcsin(np.sin(phi) / LAMBDA)))

    def corrected(phi: np.ndarray) -> np.ndarray:
        beta = slider_crank.coupler_angle(phi, LAMBDA)
        return np.asarray(slider_crank.displacement(phi, beta, 1.0, LAMBDA))

    assert np.abs(slope(printed) - printed_velocity).max() > 1
    np.testing.assert_allclose(slope(corrected), printed_velocity, atol=1e-8)


@pytest.mark.parametrize(
    "factor, angle, fits",
    [("coupler", "rocker", True), ("rocker", "rocker", False), ("coupler", "coupler", False)],
    ids=["corrected", "λ₃ω₂² as printed", "sin(δ − φ) in ω₂ as printed"],
)
def test_eq_3_gives_the_rockers_acceleration_only_as_corrected(factor: str, angle: str, fits: bool) -> None:
    """004's letters: δ is the direction of the coupler, γ that of the rocker; λ₂ the coupler, λ₃ the rocker."""
    calc = knife()
    phi = np.linspace(0.1, 6.0, 100)[None, :]
    middle = calc.domains["crank_angle"].middle_of(phi)
    delta, gamma = (calc.sample(f"crank_rocker_{n}_direction", phi, middle)[0] for n in ("coupler", "rocker"))
    turn, two, three = phi[0], 5.5, 4.0
    speed3 = np.sin(delta - turn) / (three * np.sin(delta - gamma))
    speed2 = np.sin({"rocker": gamma, "coupler": delta}[angle] - turn) / (two * np.sin(delta - gamma))
    pull = {"coupler": two, "rocker": three}[factor] * speed2**2
    by_source = (three * np.cos(delta - gamma) * speed3**2 - np.cos(delta - turn) - pull) / (
        three * np.sin(delta - gamma)
    )
    step = 1e-5
    ends = [calc.sample("crank_rocker_rocker_speed_ratio", phi + s, middle)[0] for s in (-step, step)]
    slope = (ends[1] - ends[0]) / (2 * step)
    assert bool(np.abs(by_source - slope).max() < 1e-7) is fits


def test_the_edge_meets_the_signature_faster_than_the_rollers_run_only_with_the_planetary_drive() -> None:
    speeds = {
        drive: number(knife(), f"{drive}_contact_velocity") for drive in ("planetary", "crank_slider", "crank_rocker")
    }
    rollers = number(knife(), "roller_velocity")
    assert [drive for drive, speed in speeds.items() if speed > rollers] == ["planetary"]
