"""The motor behind its flywheel, against the printed numbers, harmonics in closed form and an integration in time."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from diecut_report.formulas import Array
from diecut_report.mechanics.timing import engagement
from diecut_report.mechanics.timing.shaft_curves import PieceRows
from tests.mechanics.timing import torque_sum
from tests.mechanics.timing.example_press import COMMON
from tests.mechanics.timing.legendre_pieces import LegendrePieces, split
from tests.mechanics.timing.test_torque_sum import cam, cylinder

RATED_SPEED = 1450 * np.pi / 30
RATED = 1100 / RATED_SPEED
BELT, BELT_EFFICIENCY, GEAR, GEAR_EFFICIENCY = 3.0, 0.95, 98 / 20, 0.97
INERTIA = 1.150435
FLYWHEEL_SPEED = RATED_SPEED / BELT
STIFFNESS = engagement.stiffness_at_flywheel(
    engagement.slip_stiffness(RATED, 1500 * np.pi / 30, RATED_SPEED), BELT, BELT_EFFICIENCY
)


def load(makers: list[Any]) -> LegendrePieces:
    """The load at the flywheel's shaft over time, at the speed that the gears really give."""
    total = torque_sum.torque_sum([make() for make in makers], COMMON).total
    return torque_sum.carried_back(total, GEAR, GEAR_EFFICIENCY).scaled(GEAR / FLYWHEEL_SPEED)


class Response:
    """The motor's torque over time (N·m, at the flywheel's shaft) as the program finds it, asked as a single curve."""

    def __init__(self, load: LegendrePieces, tau: float) -> None:
        self.period = float(load.edges[-1])
        shares = load.edges[None, 1:-1] / self.period

        def of(share: Array, middle: Array, _: Array) -> Array:
            return load.at(share * self.period, np.broadcast_to(middle, share.shape) * self.period)

        rows = PieceRows.of(of, shares, 1)
        self.rows = engagement.motor_response(rows, np.array([self.period]), np.array([tau]))
        self.largest, self.least, self.mean, self.rms = (
            float(each[0]) for each in (self.rows.largest, self.rows.least, self.rows.mean, self.rows.rms)
        )

    def at(self, time: Array) -> Array:
        """The torque at times."""
        found: Array = self.rows.at(np.atleast_2d(np.asarray(time) / self.period % 1), np.zeros(1, dtype=int))[0]
        return found

    @property
    def fluctuation(self) -> float:
        """The range of the flywheel's speed to its mean."""
        return (self.largest - self.least) / (STIFFNESS * FLYWHEEL_SPEED)


ROWS = [
    ([cylinder], 1, 0.90629, 13.834, None, 0.07489),
    ([cylinder, cam], 1, 0.90392, 13.745, -2.391, 0.07681),
    ([cylinder, cam], 10, 0.74398, None, None, 0.00976),
]


@pytest.mark.parametrize("makers, times, rms, largest, least, fluctuation", ROWS)
def test_the_motor_of_the_example_press_is_loaded_as_printed(
    makers: list[Any], times: float, rms: float, largest: float | None, least: float | None, fluctuation: float
) -> None:
    tau = engagement.time_constant(times * INERTIA, STIFFNESS)
    assert tau == pytest.approx(0.09725 * times, abs=1e-5 * times)
    found = Response(load(makers), tau)
    at_motor = 1 / (BELT * BELT_EFFICIENCY)
    assert found.rms * at_motor / RATED == pytest.approx(rms, abs=1e-5)
    assert found.fluctuation == pytest.approx(fluctuation, abs=1e-5)
    if largest:
        assert found.largest * at_motor == pytest.approx(largest, abs=1e-3)
    if least:
        assert found.least * at_motor == pytest.approx(least, abs=1e-3)


def test_the_periodic_torque_is_that_of_an_integration_in_time() -> None:
    torque = load([cylinder, cam])
    tau = engagement.time_constant(INERTIA, STIFFNESS)
    found = Response(torque, tau)
    period = torque.edges[-1]

    def rate(time: float, motor: Array) -> Array:
        return (torque.at(np.array(time)) - motor) / tau

    state = found.at(np.array([0.0]))
    for start, end in zip(torque.edges[:-1], torque.edges[1:], strict=True):
        times = np.linspace(start, end, 6)[1:-1]
        run = solve_ivp(
            rate, (start, end), state, t_eval=[*times, end], rtol=1e-10, atol=1e-9, max_step=(end - start) / 4
        )
        assert run.y[0, :-1] == pytest.approx(found.at(times), abs=1e-5)
        state = run.y[:, -1]
    assert state[0] == pytest.approx(found.at(np.array(0.0))[0], abs=1e-5), f"after {period} s it is where it was"


@pytest.mark.parametrize("times_lag", [1e-3, 0.3, 1.0, 30.0, 1e4])
def test_a_harmonic_is_damped_and_delayed_in_closed_form(times_lag: float) -> None:
    rate = 2 * np.pi / 0.6
    tau = times_lag / rate
    wave = LegendrePieces.of(lambda time, _: 5 + 3 * np.cos(rate * time), split(np.array([0.0, 0.6]), 0.05))
    found = Response(wave, tau)
    time = np.linspace(0, 0.6, 101)
    expected = 5 + 3 * np.cos(rate * time - np.arctan(times_lag)) / np.hypot(1, times_lag)
    assert found.at(time) == pytest.approx(expected, abs=1e-8)
    assert found.largest == pytest.approx(5 + 3 / np.hypot(1, times_lag), abs=1e-8)
    assert found.mean == pytest.approx(5)


@pytest.mark.parametrize("tau", [1e-4, 0.05, 2.0])
def test_a_load_that_jumps_is_followed_by_exponentials(tau: float) -> None:
    edges = np.array([0.0, 0.2, 0.6])
    jump = LegendrePieces.of(lambda _, middle: np.where(middle < 0.2, 4.0, -1.0), edges)
    found = Response(jump, tau)
    on, off = np.exp(-0.2 / tau), np.exp(-0.4 / tau)
    start = (4 * (1 - on) * off - (1 - off)) / (1 - on * off)
    top = 4 + (start - 4) * on
    time = np.array([0.0, 0.1, 0.19999, 0.3, 0.5])
    on_for, off_for = np.minimum(time, 0.2), np.maximum(time - 0.2, 0)
    falling = -1 + (top + 1) * np.exp(-off_for / tau)
    expected = np.where(time < 0.2, 4 + (start - 4) * np.exp(-on_for / tau), falling)
    assert found.at(time) == pytest.approx(expected, abs=1e-8)
    assert (found.largest, found.least) == pytest.approx((top, start), abs=1e-8)


def test_without_inertia_the_motor_follows_the_load() -> None:
    torque = load([cylinder])
    found = Response(torque, 0.0)
    assert found.rms == pytest.approx(torque.rms, rel=1e-4)


def test_many_motors_at_once_are_each_alone() -> None:
    taus, jumps = np.array([1e-4, 0.05, 2.0]), np.array([[0.3, 0.6], [0.3, np.nan], [0.7, 0.9]])

    def of(share: Array, _: Array, machine: Array) -> Array:
        return np.cos(2 * np.pi * share) * (1 + machine[:, None])

    load, period = PieceRows.of(of, jumps, 4), np.array([0.6, 0.7, 0.8])
    found = engagement.motor_response(load, period, taus)
    for index in range(3):
        one = PieceRows.of(lambda share, _, __, k=index: np.cos(2 * np.pi * share) * (1 + k), jumps[[index]], 4)
        alone = engagement.motor_response(one, period[[index]], taus[[index]])
        assert [found.rms[index], found.largest[index], found.least[index]] == pytest.approx(
            [alone.rms[0], alone.largest[0], alone.least[0]], rel=1e-12
        )


def test_pieces_joined_by_doubling_are_those_gone_through_one_by_one() -> None:
    random = np.random.default_rng(1)
    gain, left = random.normal(size=(3, 1001)), random.uniform(size=(3, 1001))
    added, kept = engagement._run_through(gain, left)
    torque = start = random.normal(size=3)
    for piece in range(1001):
        torque = gain[:, piece] + left[:, piece] * torque
        assert added[:, piece] + kept[:, piece] * start == pytest.approx(torque, rel=1e-12, abs=1e-12)
    alone = engagement._run_through(gain[:1, :77], left[:1, :77])
    assert np.array_equal(alone[0], added[:1, :77])  # a machine is the same among others, which may have more pieces


def test_behind_a_lag_without_end_the_motor_bears_the_mean() -> None:
    edges = np.array([[0.25, 0.5]])
    load = PieceRows.of(lambda share, _, __: 300 + 200 * np.sin(2 * np.pi * share), edges, 8)
    for lag in (1e6, 1e12, 1e18):
        found = engagement.motor_response(load, np.array([1.0]), np.array([lag]))
        assert found.values == pytest.approx(300, rel=1e-5)
