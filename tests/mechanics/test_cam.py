"""Cams against finite differences of the roller's path, nearest-point search and circles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar

from diecut_report.formulas import Array
from diecut_report.mechanics import cam

TURN = np.linspace(0, 2 * np.pi, 1441)[:-1]
STEP = 1e-4


@dataclass(frozen=True)
class Follower:
    """An arm that swings as two waves over a turn of its carrier."""

    pivot: float = 0.3
    arm: float = 0.09
    middle: float = 1.6
    swing: float = 0.5
    second: float = 0.1

    def direction(self, phi: Any) -> Any:
        return self.middle + self.swing * np.sin(phi) + self.second * np.cos(2 * phi)

    def rate(self, phi: Any) -> Any:
        return self.swing * np.cos(phi) - 2 * self.second * np.sin(2 * phi)

    def acceleration(self, phi: Any) -> Any:
        return -self.swing * np.sin(phi) - 4 * self.second * np.cos(2 * phi)

    def turn(self, phi: Any) -> Any:
        return cam.arm_turn(self.rate(phi))

    def center(self, phi: Any) -> Any:
        """The roller's centre as a complex number, from the program."""
        x = cam.pitch_x(phi, self.pivot, self.arm, self.direction(phi))
        return x + 1j * cam.pitch_y(phi, self.pivot, self.arm, self.direction(phi))

    def path(self, phi: Any) -> Any:
        return cam.roller_path(self.pivot, self.arm, self.direction(phi), self.turn(phi))

    def profile(self, phi: Any, roller: float) -> Any:
        """The profile as a complex number, from the program."""
        where = (phi, self.pivot, self.arm, self.direction(phi), self.turn(phi), self.path(phi))
        center = self.center(phi)
        return cam.profile_x(center.real, roller, *where) + 1j * cam.profile_y(center.imag, roller, *where)

    def curvature(self, phi: Any) -> Any:
        part = cam.swing_part(self.direction(phi), self.turn(phi), self.acceleration(phi))
        return cam.curvature(self.pivot, self.arm, self.turn(phi), part, self.path(phi))

    def tangent_distance(self, phi: Any) -> Any:
        return cam.tangent_distance(self.pivot, self.arm, self.direction(phi), self.turn(phi), self.path(phi))


FOLLOWERS = st.builds(
    Follower, pivot=st.floats(0.05, 2), arm=st.floats(0.01, 0.6), middle=st.floats(0, 6.2), swing=st.floats(-0.8, 0.8),
    second=st.floats(-0.2, 0.2),
)  # fmt: skip


def slope(curve: Any, phi: Any) -> Any:
    """A derivative by central differences of fourth order."""
    return (8 * (curve(phi + STEP) - curve(phi - STEP)) - curve(phi + 2 * STEP) + curve(phi - 2 * STEP)) / (12 * STEP)


@given(follower=FOLLOWERS)
def test_the_centre_stands_at_pivot_and_arm(follower: Follower) -> None:
    pin = follower.pivot * np.exp(1j * TURN)
    arm = follower.center(TURN) - pin
    np.testing.assert_allclose(np.abs(arm), follower.arm, rtol=1e-9)
    np.testing.assert_allclose(
        arm * np.exp(-1j * TURN), follower.arm * np.exp(1j * follower.direction(TURN)), atol=1e-12
    )


@given(follower=FOLLOWERS)
def test_path_tangent_distance_and_curvature_are_those_of_the_differentiated_path(follower: Follower) -> None:
    velocity = slope(follower.center, TURN)
    assume(np.abs(velocity).min() > 0.02 * follower.pivot)
    np.testing.assert_allclose(follower.path(TURN), np.abs(velocity), rtol=1e-7)
    tangent = velocity / np.abs(velocity)
    across = (np.conj(follower.center(TURN)) * tangent).imag
    np.testing.assert_allclose(follower.tangent_distance(TURN), across, atol=1e-8)
    change = slope(lambda phi: slope(follower.center, phi), TURN)
    curvature = (np.conj(velocity) * change).imag / np.abs(velocity) ** 3
    np.testing.assert_allclose(follower.curvature(TURN), curvature, atol=1e-5 * np.abs(curvature).max())


@given(follower=FOLLOWERS, share=st.floats(0.05, 1))
def test_the_profile_lies_square_to_the_path_on_its_left_a_rollers_radius_away(
    follower: Follower, share: float
) -> None:
    velocity = slope(follower.center, TURN)
    assume(np.abs(velocity).min() > 0.02 * follower.pivot)
    roller = share * follower.pivot
    away = follower.profile(TURN, roller) - follower.center(TURN)
    np.testing.assert_allclose(away, roller * 1j * velocity / np.abs(velocity), atol=1e-7 * roller)


@given(follower=FOLLOWERS)
def test_the_pressure_angle_is_that_between_force_and_relative_velocity(follower: Follower) -> None:
    phi = TURN[np.abs(np.sin(follower.direction(TURN))) > 0.05]
    velocity = slope(follower.center, phi)
    assume(len(phi) > 10 and np.abs(velocity).min() > 0.02 * follower.pivot)
    force = 1j * velocity / np.abs(velocity)
    moved = 1j * np.exp(
        1j * (phi + follower.direction(phi))
    )  # square to the arm: the roller's motion seen from the carrier
    angle = np.arccos(np.clip(np.abs((np.conj(force) * moved).real), 0, 1))
    given_angle = cam.pressure_angle(follower.pivot, follower.arm, follower.direction(phi), follower.turn(phi))
    np.testing.assert_allclose(given_angle, angle, atol=1e-6)


def test_an_arm_that_stands_still_makes_circles() -> None:
    still = Follower(swing=0, second=0)
    radius = abs(0.3 + 0.09 * np.exp(1.6j))
    np.testing.assert_allclose(still.curvature(TURN), 1 / radius, rtol=1e-12)
    np.testing.assert_allclose(still.tangent_distance(TURN), radius, rtol=1e-12)
    np.testing.assert_allclose(np.abs(still.profile(TURN, 0.02)), radius - 0.02, rtol=1e-12)


def nearest(follower: Follower, center: complex, roller: float) -> float:
    """The least distance of a point from the whole profile, by search on its function."""
    distances = np.abs(follower.profile(TURN, roller) - center)
    local = (distances <= np.roll(distances, 1)) & (distances <= np.roll(distances, -1))
    found = (
        minimize_scalar(lambda phi: abs(follower.profile(phi, roller) - center), method="bounded",
                        bounds=(place - 0.005, place + 0.005), options={"xatol": 1e-12}).fun
        for place in TURN[local]
    )  # fmt: skip
    return float(min(found))


@given(follower=FOLLOWERS, share=st.floats(0.05, 0.95), turn=st.floats(0, 6.2))
def test_a_roller_within_the_bounds_touches_its_profile_and_never_cuts_it(
    follower: Follower, share: float, turn: float
) -> None:
    bound = min(1 / follower.curvature(TURN).max(), follower.tangent_distance(TURN).min())
    assume(bound > 0.02 * follower.pivot)
    roller = share * bound
    assert nearest(follower, follower.center(turn), roller) == pytest.approx(roller, rel=1e-9)


@given(follower=FOLLOWERS, share=st.floats(1.1, 3))
def test_a_greater_roller_than_the_radius_of_curvature_cuts_its_profile(follower: Follower, share: float) -> None:
    """Where it is sharpest the profile runs backwards, and the roller there overlaps other parts of it."""
    curvature = follower.curvature(TURN)
    sharpest = float(TURN[np.argmax(curvature)])
    roller = share / curvature.max()
    assume(
        follower.tangent_distance(TURN).min() > 0 and np.abs(slope(follower.center, TURN)).min() > 0.02 * follower.pivot
    )
    backwards = slope(lambda phi: follower.profile(phi, roller), sharpest) / slope(follower.center, sharpest)
    assert backwards.real < 0
    assert nearest(follower, follower.center(sharpest), roller) < roller * (1 - 1e-6)


def test_a_hollow_path_never_undercuts_and_its_profile_is_wider_by_the_roller() -> None:
    hollow = Follower(arm=0.12, second=0.9)
    curvature = hollow.curvature(TURN)
    place = float(TURN[np.argmin(curvature)])
    assert curvature.min() < 0
    assert bool(cam.is_hollow(curvature.min()))
    roller = 0.05
    first = slope(lambda phi: hollow.profile(phi, roller), place)
    change = slope(lambda phi: slope(lambda x: hollow.profile(x, roller), phi), place)
    radius = abs(first) ** 3 / (np.conj(first) * change).imag
    assert radius < 0
    assert cam.hollow_radius(hollow.curvature(place), roller) == pytest.approx(-radius, rel=1e-5)


@given(curvature=st.floats(-50, 19), roller=st.just(0.05))
def test_the_effective_radius_is_that_of_roller_and_profile(curvature: float, roller: float) -> None:
    assume(abs(curvature) > 1e-3)
    profile = 1 / curvature - roller  # below zero where it is hollow
    assert cam.effective_radius(roller, curvature) == pytest.approx(1 / (1 / roller + 1 / profile), rel=1e-9)


def test_least_radii() -> None:
    assert cam.least_radius(5.0) == 0.2
    assert cam.profile_radius(0.2, 0.25) == pytest.approx(-0.05)
    assert not bool(cam.is_hollow(0.1))


def test_arrays_of_variants_give_what_single_machines_give() -> None:
    arms = np.array([[0.05], [0.09], [0.2]])
    one = Follower()
    psi, w, part = (
        one.direction(TURN),
        one.turn(TURN),
        cam.swing_part(one.direction(TURN), one.turn(TURN), one.acceleration(TURN)),
    )
    paths = cam.roller_path(0.3, arms, psi, w)
    together: Array = cam.curvature(0.3, arms, w, part, paths)
    assert together.shape == (3, len(TURN))
    for row, arm in zip(together, arms[:, 0], strict=True):
        np.testing.assert_array_equal(row, Follower(arm=float(arm)).curvature(TURN))
