"""The clutch that starts the cylinder's drive, against the printed numbers and an integration in time."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar

from diecut_report.mechanics.timing import engagement
from diecut_report.mechanics.timing.engagement import SlippingClutch
from tests.mechanics.timing.example_press import crank_inertia, dead_centers


def clutch_of(torque: float, load: float, speed: float) -> SlippingClutch:
    """A single clutch."""
    return SlippingClutch(*(np.array([number]) for number in (torque, load, speed)))


class One:
    """An engagement of a single clutch, its numbers alone."""

    def __init__(self, inertia: Any, clutch: SlippingClutch, angle: float | None = None, ends: Any = None) -> None:
        places = np.atleast_2d(dead_centers() if ends is None else ends)
        felt: engagement.Inertia = lambda at, _: inertia(at)  # noqa: E731
        start = None if angle is None else np.array([angle])
        asked = (felt, places, clutch)
        found = engagement.worst_slip(*asked) if start is None else engagement.slip(*asked, start)
        for name in engagement.Slip.__dataclass_fields__:
            setattr(self, name, float(getattr(found, name)[0]))

    engagement_angle: float
    time: float
    driven_angle: float
    lag: float
    heat: float
    equal_inertia: float


CLUTCH = clutch_of(741.166, 0.0, 5.16475)
INERTIAS = {"unbalanced": crank_inertia, "balanced": partial(crank_inertia, balanced=True)}


@pytest.mark.parametrize(
    "name, mean, largest, at, energy",
    [("unbalanced", 7.18859, 15.34397, 328.928, 210.332), ("balanced", 7.54153, 17.08504, 314.772, 234.198)],
)
def test_the_inertia_at_the_crank_is_the_printed_one(
    name: str, mean: float, largest: float, at: float, energy: float
) -> None:
    angle = np.linspace(0, 2 * np.pi, 72_001)[:-1]
    found = INERTIAS[name](angle)
    assert found.mean() == pytest.approx(mean, abs=1e-5)
    assert found.max() == pytest.approx(largest, abs=1e-5)
    assert np.degrees(angle[found.argmax()]) == pytest.approx(at, abs=6e-3)
    assert found.max() * (6000 / 3600 * np.pi) ** 2 / 2 == pytest.approx(energy, abs=1e-3)


@pytest.mark.parametrize(
    "name, at, time, driven, lag, heat, inertia",
    [
        ("unbalanced", 323.60, 0.101808, 14.5751, 15.5516, 201.173, 15.0834),
        ("balanced", 308.83, 0.115195, None, None, 225.298, 16.8923),
    ],
)
def test_the_worst_engagement_is_the_printed_one(
    name: str, at: float, time: float, driven: float | None, lag: float | None, heat: float, inertia: float
) -> None:
    """The angle is printed from a grid; the heat is flat there, so that the time changes more than it."""
    found = One(INERTIAS[name], CLUTCH)
    assert np.degrees(found.engagement_angle) == pytest.approx(at, abs=0.03)
    assert found.time == pytest.approx(time, abs=2e-5)
    assert found.heat == pytest.approx(heat, abs=6e-4)
    assert found.equal_inertia == pytest.approx(inertia, abs=6e-5)
    if driven and lag:
        assert np.degrees(found.driven_angle) == pytest.approx(driven, abs=6e-3)
        assert np.degrees(found.lag) == pytest.approx(lag, abs=6e-5)


@pytest.mark.parametrize("name", INERTIAS)
@pytest.mark.parametrize("load", [0.0, 300.0])
def test_no_other_engagement_is_hotter(name: str, load: float) -> None:
    clutch = clutch_of(741.166, load, 5.16475)
    worst = One(INERTIAS[name], clutch)

    def cold(angle: float) -> float:
        return -One(INERTIAS[name], clutch, angle).heat

    grid = [-cold(angle) for angle in np.linspace(0, 2 * np.pi, 61)]
    assert max(grid) <= worst.heat * (1 + 1e-9)
    near: Any = minimize_scalar(
        cold,
        bounds=(worst.engagement_angle - 0.05, worst.engagement_angle + 0.05),
        method="bounded",
        options={"xatol": 1e-6},
    )
    assert -near.fun <= worst.heat * (1 + 1e-9)


@pytest.mark.parametrize("start", [0.8, 2.0, 4.5, 5.65, 6.2])
def test_a_slip_is_that_of_an_integration_of_the_motion_in_time(start: float) -> None:
    """The equation of motion I·ω̇ + ½I′·ω² = M, with I′ by differences, from rest until the speeds are equal."""
    clutch = clutch_of(741.166, 120.0, 5.16475)
    found = One(crank_inertia, clutch, start)

    def rate(_: float, state: Any) -> list[float]:
        angle, speed = state
        around = crank_inertia(np.array([angle - 1e-5, angle, angle + 1e-5]))
        slope = (around[2] - around[0]) / 2e-5
        return [speed, (clutch.net[0] - slope * speed**2 / 2) / around[1]]

    def ended(_: float, state: Any) -> float:
        return float(state[1] - clutch.speed[0])

    ended.terminal = True  # type: ignore[attr-defined]
    run = solve_ivp(rate, (0, 1), [start, 0.0], events=ended, rtol=1e-9, atol=1e-10)
    assert found.time == pytest.approx(run.t_events[0][0], rel=1e-6)
    assert found.driven_angle == pytest.approx(run.y_events[0][0][0] - start, rel=1e-5)
    assert found.lag == pytest.approx(clutch.speed[0] * found.time - found.driven_angle)
    assert found.heat == pytest.approx(clutch.torque[0] * found.lag)


def test_at_a_dead_centre_the_clutch_hardly_slips() -> None:
    for angle in dead_centers():
        found = One(crank_inertia, CLUTCH, float(angle))
        assert found.heat == pytest.approx(0, abs=1e-6)
        assert np.isfinite(found.time)


def test_a_constant_inertia_slips_as_the_clutch_of_the_books() -> None:
    clutch = clutch_of(200.0, 50.0, 10.0)
    found = One(lambda angle: np.full(np.shape(angle), 0.8), clutch, 1.0, [5.0])
    assert found.time == pytest.approx(0.8 * 10 / 150)
    assert found.heat == pytest.approx(200 * 10 * found.time / 2)
    assert found.equal_inertia == pytest.approx(0.8)


def test_a_clutch_below_its_load_never_ends_its_slip() -> None:
    assert np.isnan(One(crank_inertia, clutch_of(50, 60, 5), 1.0).time)


def test_many_engagements_at_once_are_each_alone() -> None:
    torques, loads, speeds = np.array([741.0, 500.0, 900.0]), np.array([0.0, 200.0, 10.0]), np.array([5.2, 4.0, 6.0])
    many = engagement.worst_slip(
        lambda angle, _: crank_inertia(angle), np.tile(dead_centers(), (3, 1)), SlippingClutch(torques, loads, speeds)
    )
    for index in range(3):
        alone = One(crank_inertia, clutch_of(torques[index], loads[index], speeds[index]))
        assert many.time[index] == pytest.approx(alone.time, rel=1e-9)
        assert many.heat[index] == pytest.approx(alone.heat, rel=1e-12)
