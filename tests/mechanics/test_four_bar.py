"""The crank-rocker's kinematics, by loop closure, finite differences and dead centres found numerically."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar

from diecut_report.formulas import Array
from diecut_report.formulas.formula import Formula
from diecut_report.mechanics import four_bar
from tests.examples import examples

PHI = np.linspace(0.0, 2 * np.pi, 721)[None, :]
SHEET = (5.0, 5.0, 2.05)


@st.composite
def crank_rockers(draw: st.DrawFn) -> tuple[float, float, float]:
    """Ratios of crank-rockers, from nearly change-point linkages to long ones."""
    coupler, rocker = draw(st.floats(1.05, 12)), draw(st.floats(1.05, 12))
    low, high = abs(coupler - rocker) + 1, coupler + rocker - 1
    share = draw(st.floats(0.02, 0.98))
    frame = low + share * (high - low)
    assume(frame > 1.02 and bool(four_bar.is_crank_rocker(frame, coupler, rocker)))
    return frame, coupler, rocker


def closure(motion: four_bar.LinkageMotion, phi: Array, frame: float, coupler: float, rocker: float) -> Array:
    """What the vector loop crank + coupler − frame − rocker leaves open."""
    loop = np.exp(1j * phi) + coupler * np.exp(1j * motion.coupler_direction) - frame
    return np.abs(loop - rocker * np.exp(1j * motion.rocker_direction))


@pytest.mark.parametrize("branch", [1, -1])
@given(ratios=crank_rockers())
@examples(80)
def test_the_loop_closes_in_both_branches(branch: int, ratios: tuple[float, float, float]) -> None:
    motion = four_bar.motion(PHI, *ratios, branch=branch)
    assert np.max(closure(motion, PHI, *ratios)) < 1e-12 * max(ratios) * 10


@given(ratios=crank_rockers())
@examples(80)
def test_the_rocker_swings_between_its_dead_centres_without_a_jump(ratios: tuple[float, float, float]) -> None:
    motion = four_bar.motion(PHI, *ratios)
    swing = motion.rocker_direction - four_bar.outer_rocker_direction(*ratios)
    assert np.min(swing) > -1e-7
    assert np.max(swing) <= four_bar.swing_angle(*ratios) + 1e-7
    assert abs(swing[0, -1] - swing[0, 0]) < 1e-12


@given(ratios=crank_rockers(), branch=st.sampled_from([1, -1]), phi=st.floats(0, 2 * np.pi))
@examples(150)
def test_speeds_and_acceleration_are_the_derivatives(
    ratios: tuple[float, float, float], branch: int, phi: float
) -> None:
    assume(np.sin(four_bar.motion(phi, *ratios).transmission_angle) > 0.1)
    step = 1e-4
    five = phi + step * np.array([-2, -1, 0, 1, 2])
    motion = four_bar.motion(five, *ratios, branch=branch)
    scale = 1 + abs(motion.rocker_acceleration_ratio[2]) + motion.rocker_speed_ratio[2] ** 2
    for position, speed in (
        (motion.rocker_direction, motion.rocker_speed_ratio),
        (motion.coupler_direction, motion.coupler_speed_ratio),
        (motion.rocker_speed_ratio, motion.rocker_acceleration_ratio),
    ):
        derivative = np.dot(position, [1, -8, 0, 8, -1]) / (12 * step)
        assert derivative == pytest.approx(speed[2], abs=2e-8 * scale**3)


@pytest.mark.parametrize("sign, closed_form", [(1, four_bar.inner_dead_center), (-1, four_bar.outer_dead_center)])
def test_dead_centres_in_closed_form_are_the_extremes_of_the_rocker(sign: int, closed_form: Formula) -> None:
    guess = closed_form(*SHEET)
    found: Any = minimize_scalar(
        lambda phi: -sign * float(four_bar.motion(phi, *SHEET).rocker_direction),
        bounds=(guess - 0.5, guess + 0.5),
        method="bounded",
        options={"xatol": 1e-10},
    )
    assert found.x == pytest.approx(guess, abs=1e-6)


@given(ratios=crank_rockers())
@examples(80)
def test_the_rocker_stands_still_at_its_dead_centres(ratios: tuple[float, float, float]) -> None:
    dead = np.array([four_bar.outer_dead_center(*ratios), four_bar.inner_dead_center(*ratios)])
    assert np.max(np.abs(four_bar.motion(dead, *ratios).rocker_speed_ratio)) < 1e-6


@given(ratios=crank_rockers(), share=st.floats(0.01, 0.99))
@examples(80)
def test_the_crank_angle_of_a_rocker_direction_is_the_inverse(ratios: tuple[float, float, float], share: float) -> None:
    frame, coupler, rocker = ratios
    direction = four_bar.outer_rocker_direction(*ratios) + share * four_bar.swing_angle(*ratios)
    distance = four_bar.joint_distance(direction, frame, rocker)
    for inverse in (four_bar.crank_angle_forward, four_bar.crank_angle_return):
        phi = inverse(direction, distance, frame, coupler, rocker)
        motion = four_bar.motion(phi, *ratios)
        assert motion.rocker_direction == pytest.approx(direction, abs=1e-9)
        assert (motion.rocker_speed_ratio > 0) == (inverse is four_bar.crank_angle_forward)


@given(ratios=crank_rockers())
@examples(80)
def test_extremes_of_the_transmission_angle_bound_it(ratios: tuple[float, float, float]) -> None:
    mu = four_bar.motion(PHI, *ratios).transmission_angle
    assert np.min(mu) == pytest.approx(four_bar.least_transmission_angle(*ratios), abs=1e-7)
    assert np.max(mu) == pytest.approx(four_bar.greatest_transmission_angle(*ratios), abs=1e-4)


def test_variants_and_crank_angles_broadcast() -> None:
    frame, coupler, rocker = np.array([[5.0, 5.0, 2.05], [6.0, 5.5, 3.0]]).T[:, :, None]
    motion = four_bar.motion(PHI, frame, coupler, rocker)
    assert motion.rocker_direction.shape == (2, 721)
    alone = four_bar.motion(PHI, 6.0, 5.5, 3.0)
    np.testing.assert_array_equal(motion.rocker_direction[1], alone.rocker_direction[0])


@pytest.mark.parametrize("ratios", [(5, 5, 0.9), (2, 5, 2.05), (8, 5, 2.05), (0.9, 5, 5), (6, 5, 2)])
def test_what_is_no_crank_rocker_is_seen(ratios: tuple[float, float, float]) -> None:
    assert not four_bar.is_crank_rocker(*ratios)


def test_rounding_does_not_decide_whether_a_linkage_that_folds_flat_turns() -> None:
    """Lengths of tenths of a millimetre, of which the least and the greatest are together as long as the others."""
    crank, first, second = np.random.default_rng(1).integers(1, 2000, (3, 20_000))
    frame = first + second - crank
    crank, coupler, rocker, frame = (
        each[crank < np.minimum(first, second)] * 0.1 * 1e-3 for each in (crank, first, second, frame)
    )
    assert not four_bar.is_crank_rocker(frame / crank, coupler / crank, rocker / crank).any()
    shorter = crank * (1 - 1e-9)
    assert four_bar.is_crank_rocker(frame / shorter, coupler / shorter, rocker / shorter).mean() > 0.99
