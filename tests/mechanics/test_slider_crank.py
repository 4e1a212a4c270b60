"""The slider-crank's kinematics, by loop closure, finite differences and the order of what the first-order form leaves out."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from diecut_report.formulas import Array
from diecut_report.mechanics import slider_crank as sc
from tests.examples import examples

PHI = np.linspace(0.0, 2 * np.pi, 721)[None, :]
RATIOS = st.floats(1.05, 20)
RADII = st.floats(0.005, 2)
SPEEDS = st.floats(0.1, 100)
ANGLES = st.floats(0, 2 * np.pi)


def slider(crank: Array, radius: float, rod: float) -> Array:
    """Distance of the slider from the shaft: the crank pin's shadow on the path and the rod's (Pythagoras)."""
    pin = radius * np.exp(1j * crank)
    return np.asarray(pin.real + np.sqrt(rod**2 - pin.imag**2))


@given(radius=RADII, ratio=RATIOS)
@examples(80)
def test_displacements_close_the_loop_from_both_dead_centres(radius: float, ratio: float) -> None:
    rod, scale = radius * ratio, radius * (1 + ratio)
    beta, inner_beta = sc.coupler_angle(PHI, ratio), sc.inner_coupler_angle(PHI, 1 / ratio)
    outer = radius + rod - slider(PHI, radius, rod)
    inner = slider(PHI + np.pi, radius, rod) - (rod - radius)
    np.testing.assert_allclose(sc.displacement(PHI, beta, radius, ratio), outer, atol=1e-13 * scale)
    np.testing.assert_allclose(sc.inner_displacement(PHI, inner_beta, radius, rod), inner, atol=1e-13 * scale)


@given(radius=RADII, ratio=RATIOS, speed=SPEEDS, phi=ANGLES)
@examples(200)
def test_speeds_and_accelerations_are_the_derivatives(radius: float, ratio: float, speed: float, phi: float) -> None:
    step = 1e-4
    five = phi + step * np.array([-2, -1, 0, 1, 2])
    beta, inner_beta = sc.coupler_angle(five, ratio), sc.inner_coupler_angle(five, 1 / ratio)
    inner = sc.inner_displacement(five, inner_beta, radius, radius * ratio)
    pairs = (
        (sc.displacement(five, beta, radius, ratio), sc.velocity(five, beta, radius, speed) / speed),
        (sc.velocity(five, beta, radius, speed), sc.acceleration(five, beta, radius, ratio, speed) / speed),
        (inner, sc.inner_velocity(five, inner_beta, radius, speed) / speed),
        (sc.inner_velocity(five, inner_beta, radius, speed), sc.inner_acceleration(five, inner_beta, radius, 1 / ratio, speed) / speed),
        (radius * beta, radius * sc.coupler_angle_speed(five, beta, ratio)),
        (radius * inner_beta, radius * sc.inner_coupler_angle_speed(five, inner_beta, 1 / ratio)),
    )  # fmt: skip
    for place, rate in pairs:
        derivative = np.dot(place, [1, -8, 0, 8, -1]) / (12 * step)
        assert derivative == pytest.approx(rate[2], abs=1e-6 * radius * (1 + speed) * ratio)


@given(radius=RADII, ratio=RATIOS, speed=SPEEDS, phi=ANGLES)
@examples(80)
def test_the_two_ways_to_count_are_half_a_turn_apart(radius: float, ratio: float, speed: float, phi: float) -> None:
    beta, inner_beta = sc.coupler_angle(phi + np.pi, ratio), sc.inner_coupler_angle(phi, 1 / ratio)
    scale = radius * speed**2 * 1e-10 * (1 + 1 / (ratio - 1))
    outer = sc.acceleration(phi + np.pi, beta, radius, ratio, speed)
    assert sc.inner_acceleration(phi, inner_beta, radius, 1 / ratio, speed) == pytest.approx(-outer, abs=scale)
    toward = sc.velocity(phi + np.pi, beta, radius, speed)
    assert sc.inner_velocity(phi, inner_beta, radius, speed) == pytest.approx(-toward, abs=radius * speed * 1e-10)
    stroke = sc.inner_displacement(phi, inner_beta, radius, radius * ratio) + sc.displacement(
        phi + np.pi, beta, radius, ratio
    )
    assert stroke == pytest.approx(2 * radius, rel=1e-11)  # fmt: skip


@given(radius=RADII, ratio=st.floats(5, 10), speed=SPEEDS)
@examples(60)
def test_the_first_order_form_is_out_by_the_cube_of_the_ratio(radius: float, ratio: float, speed: float) -> None:
    """Half the ratio r/l leaves at most a quarter of the difference, and about an eighth: the next term is of third order."""

    def differences(own: float) -> list[float]:
        beta, inner = sc.coupler_angle(PHI, own), sc.inner_coupler_angle(PHI, 1 / own)
        exact = (
            sc.displacement(PHI, beta, radius, own),
            sc.velocity(PHI, beta, radius, speed),
            sc.acceleration(PHI, beta, radius, own, speed),
            sc.inner_velocity(PHI, inner, radius, speed),
        )
        approximate = (
            sc.displacement_first_order(PHI, radius, own),
            sc.velocity_first_order(PHI, radius, own, speed),
            sc.acceleration_first_order(PHI, radius, own, speed),
            sc.inner_velocity_first_order(PHI, radius, 1 / own, speed),
        )
        return [float(np.max(np.abs(a - b))) for a, b in zip(exact, approximate, strict=True)]

    for whole, halved in zip(differences(ratio), differences(2 * ratio), strict=True):
        assert whole > 0
        assert whole / halved == pytest.approx(8, abs=1.0)


@given(radius=RADII, ratio=RATIOS, share=st.floats(0.0001, 0.9999))
@examples(100)
def test_the_crank_angle_of_a_displacement_is_the_inverse(radius: float, ratio: float, share: float) -> None:
    rod, travel = radius * ratio, 2 * radius * share
    outer = sc.crank_angle_at(travel, radius, rod)
    assert sc.displacement(outer, sc.coupler_angle(outer, ratio), radius, ratio) == pytest.approx(travel, rel=1e-10)
    inner = sc.inner_crank_angle_at(travel, radius, rod)
    beta = sc.inner_coupler_angle(inner, 1 / ratio)
    assert sc.inner_displacement(inner, beta, radius, rod) == pytest.approx(travel, rel=1e-9)


@given(radius=RADII, ratio=RATIOS)
@examples(300)
def test_a_whole_stroke_is_half_a_turn_and_none_is_none(radius: float, ratio: float) -> None:
    for angle_at in (sc.crank_angle_at, sc.inner_crank_angle_at):
        assert angle_at(2 * radius, radius, radius * ratio) == pytest.approx(np.pi, abs=1e-12)
        assert angle_at(0.0, radius, radius * ratio) == 0


def test_variants_and_crank_angles_broadcast() -> None:
    ratios = np.array([[3.0], [5.0]])
    both = sc.acceleration(PHI, sc.coupler_angle(PHI, ratios), 0.1, ratios, 7.0)
    assert both.shape == (2, 721)
    np.testing.assert_array_equal(both[1], sc.acceleration(PHI, sc.coupler_angle(PHI, 5.0), 0.1, 5.0, 7.0)[0])
