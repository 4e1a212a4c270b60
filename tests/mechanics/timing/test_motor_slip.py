"""The motor behind its flywheel, against harmonics in closed form and an integration in time; pieces of many machines at once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from diecut_report.formulas import Array
from diecut_report.mechanics.numerics import vertex
from diecut_report.mechanics.timing import engagement
from diecut_report.mechanics.timing.shaft_curves import PieceRows

PERIOD, JUMP = 0.6, 0.2  # s, of the loads and of where they jump

Load = Callable[[Array, Array], Array]  # of times (s), and of times that lie in the same smooth piece


class Response:
    """A load at the flywheel's shaft, and the motor's torque over time (N·m) under it."""

    def __init__(self, load: Load, tau: float) -> None:
        def of(share: Array, middle: Array, _: Array) -> Array:
            return load(share * PERIOD, np.broadcast_to(middle, share.shape) * PERIOD)

        self.load = PieceRows.of(of, np.array([[JUMP / PERIOD]]), 8)
        self.rows = engagement.motor_response(self.load, np.array([PERIOD]), np.array([tau]))

    def at(self, time: Array) -> Array:
        """The torque at times."""
        found: Array = self.rows.at(np.atleast_2d(np.asarray(time) / PERIOD % 1), np.zeros(1, dtype=int))[0]
        return found


def rough(time: Array, middle: Array) -> Array:
    """A load that swings, and jumps."""
    return 300 + 250 * np.sin(4 * np.pi * time / PERIOD + 0.4) + np.where(middle < JUMP, 400.0, -150.0)


def test_the_stiffness_behind_belt_and_slip_gives_the_printed_time_constant() -> None:
    rated = 1450 * np.pi / 30
    slope = engagement.slip_stiffness(1100 / rated, 1500 * np.pi / 30, rated)
    found = engagement.time_constant(1.150435, engagement.stiffness_at_flywheel(slope, 3.0, 0.95))
    assert found == pytest.approx(0.09725, abs=1e-5)


@pytest.mark.parametrize("tau", [0.02, 0.09725, 1.0])
def test_the_periodic_torque_is_that_of_an_integration_in_time(tau: float) -> None:
    found = Response(rough, tau)
    state = begin = found.at(np.array([0.0]))
    for start, end in ((0.0, JUMP), (JUMP, PERIOD)):
        middle, times = np.array((start + end) / 2), np.linspace(start, end, 20)[1:-1]

        def rate(time: float, motor: Array, middle: Array = middle) -> Array:
            return (rough(np.array(time), middle) - motor) / tau

        run = solve_ivp(rate, (start, end), state, t_eval=[*times, end], rtol=1e-10, atol=1e-9, max_step=0.01)
        assert run.y[0, :-1] == pytest.approx(found.at(times), abs=1e-5)
        state = run.y[:, -1]
    assert state == pytest.approx(begin, abs=1e-5), "after a period it is where it was"


@pytest.mark.parametrize("times_lag", [1e-3, 0.3, 1.0, 30.0, 1e4])
def test_a_harmonic_is_damped_and_delayed_in_closed_form(times_lag: float) -> None:
    rate = 2 * np.pi / PERIOD
    found = Response(lambda time, _: 5 + 3 * np.cos(rate * time), times_lag / rate)
    time = np.linspace(0, PERIOD, 101)
    expected = 5 + 3 * np.cos(rate * time - np.arctan(times_lag)) / np.hypot(1, times_lag)
    assert found.at(time) == pytest.approx(expected, abs=1e-8)
    assert found.rows.largest == pytest.approx(5 + 3 / np.hypot(1, times_lag), abs=1e-8)
    assert found.rows.mean == pytest.approx(5)


@pytest.mark.parametrize("tau", [1e-4, 0.05, 2.0])
def test_a_load_that_jumps_is_followed_by_exponentials(tau: float) -> None:
    found = Response(lambda _, middle: np.where(middle < JUMP, 4.0, -1.0), tau)
    on, off = np.exp(-0.2 / tau), np.exp(-0.4 / tau)
    start = (4 * (1 - on) * off - (1 - off)) / (1 - on * off)
    top = 4 + (start - 4) * on
    time = np.array([0.0, 0.1, 0.19999, 0.3, 0.5])
    on_for, off_for = np.minimum(time, 0.2), np.maximum(time - 0.2, 0)
    falling = -1 + (top + 1) * np.exp(-off_for / tau)
    expected = np.where(time < 0.2, 4 + (start - 4) * np.exp(-on_for / tau), falling)
    assert found.at(time) == pytest.approx(expected, abs=1e-8)
    assert [found.rows.largest[0], found.rows.least[0]] == pytest.approx([top, start], abs=1e-8)


def test_without_inertia_the_motor_follows_the_load() -> None:
    found = Response(rough, 0.0)
    assert found.rows.rms == pytest.approx(found.load.rms, rel=1e-4)


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


def test_a_machine_without_values_leaves_those_behind_it_alone() -> None:
    sizes = np.array([1.0, np.nan, 3.0, np.inf, 2.0])

    def wave(places: Array, middles: Array, machine: Array) -> Array:
        with np.errstate(invalid="ignore"):
            return np.asarray(sizes[machine][:, None] * np.sin(2 * np.pi * places))

    with np.errstate(invalid="ignore"):
        found = PieceRows.of(wave, np.full((5, 1), np.nan), 8).excess.range
    assert found[[0, 2, 4]] == pytest.approx(np.array([1.0, 3.0, 2.0]) / np.pi, rel=1e-12)  # ∫ sin is (1 − cos)/2π
    assert not np.isfinite(found[[1, 3]]).any()


@pytest.mark.parametrize("bend", [0.3, 1.0, 40.0])
def test_the_vertex_of_a_parabola_is_found_between_its_samples(bend: float) -> None:
    places = np.tile(np.arange(9.0), (3, 1))
    lows = np.array([[3.4], [2.7], [5.0]])
    assert vertex(places, bend * (places - lows) ** 2) == pytest.approx(lows[:, 0], abs=1e-12)
    ends = bend * (places[:2] - np.array([[-1.2], [9.3]])) ** 2
    assert vertex(places[:2], ends).tolist() == [0, 8]  # the least is the first or the last
