"""Heat and temperature of the clutch against an integrated run-up, heat conduction in the drum and repeated cooling."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from diecut_report.formulas import Array
from diecut_report.results.mechanism import mechanism_results
from tests.machines import number
from tests.plugins.clutches import COOLED, HEATED, checks, clutch


def run_up(inertia: float, speed: float, torque: float, load: float) -> tuple[float, float]:
    """Time and heat of an engagement, integrated until the driven side has the shaft's speed."""

    def rate(_: float, state: Array) -> list[float]:
        return [(torque - load) / inertia, torque * (speed - state[0])]

    def caught_up(_: float, state: Array) -> float:
        return float(state[0] - speed)

    caught_up.terminal = True  # type: ignore[attr-defined]
    run = solve_ivp(rate, (0, 1e3), [0.0, 0.0], events=caught_up, rtol=1e-10, atol=1e-10, max_step=0.05)
    return float(run.t[-1]), float(run.y[1, -1])


@pytest.mark.parametrize("load", [0.0, 80.0, 250.0])
def test_heat_and_slip_time_are_those_of_the_integrated_run_up(load: float) -> None:
    calc = clutch(HEATED, load_torque_at_engagement=load)
    speed = 600 * 2 * np.pi / 60
    time, heat = run_up(3, speed, 300, load)
    assert number(calc, "slip_time") == pytest.approx(time, rel=1e-8)
    assert number(calc, "engagement_energy") == pytest.approx(heat, rel=1e-7)
    supplied = 300 * speed * time  # by the shaft, whose speed is constant
    gained = 3 * speed**2 / 2 + load * speed * time / 2  # by inertia and load
    assert number(calc, "engagement_energy") == pytest.approx(supplied - gained, rel=1e-7)


def test_mean_power_of_the_lining_is_the_heat_of_an_hour() -> None:
    calc = clutch(HEATED, shoe_width="40 mm", shoe_coverage=0.75)
    hour = 240 * number(calc, "engagement_energy")
    area = 0.75 * 2 * np.pi * 0.12 * 0.04
    assert number(calc, "lining_power_density") == pytest.approx(hour / 3600 / area)
    assert number(calc, "pv") == pytest.approx(number(calc, "pressure") * 0.12 * 600 * 2 * np.pi / 60)
    limit = checks(clutch(HEATED, allowable_power_density="0.1 W/cm**2"))["lining_power_density"]
    assert limit.status == "fail"
    most = number(clutch(HEATED, allowable_power_density="0.1 W/cm**2"), "engagements_limit")
    again = clutch(HEATED, engagements_per_hour=f"{most!r} 1/s")
    assert number(again, "lining_power_density") == pytest.approx(1000)


def conducted(flux: float, time: float, conductivity: float, capacity: float) -> tuple[float, Array, Array]:
    """A thick wall under a surface flux that falls evenly to zero, by finite volumes: the greatest rise of its surface, and
    at the end the depths of the volumes' far edges with the share of the heat that lies above each."""
    reach = 8 * np.sqrt(conductivity * time / capacity)
    edges = reach * np.linspace(0, 1, 401) ** 2
    widths, centers = np.diff(edges), (edges[1:] + edges[:-1]) / 2

    def rate(t: float, rise: Array) -> Array:
        inner = -conductivity * np.diff(rise) / np.diff(centers)
        flows = np.concatenate([[flux * (1 - t / time)], inner, [0.0]])
        change: Array = -np.diff(flows) / (capacity * widths)
        return change

    step = time / 200
    run = solve_ivp(
        rate, (0, time), np.zeros(400), method="LSODA", lband=1, uband=1, rtol=1e-7, atol=1e-7, max_step=step
    )
    surface = run.y[0] + flux * (1 - run.t / time) * widths[0] / 2 / conductivity
    held = np.cumsum(run.y[:, -1] * widths)
    return float(surface.max()), edges[1:], held / held[-1]


def test_the_surface_gets_as_hot_as_conduction_into_the_drum_makes_it() -> None:
    calc = clutch(HEATED)
    flux = 300 * 600 * 2 * np.pi / 60 / (2 * np.pi * 0.12 * number(calc, "shoe_width"))
    assert number(calc, "heat_flux") == pytest.approx(flux)
    expected, depths, held = conducted(flux, number(calc, "slip_time"), 50, 7200 * 500)
    assert number(calc, "surface_temperature_rise") == pytest.approx(expected, rel=1e-4)
    assert 0.9 < np.interp(number(calc, "heat_depth"), depths, held) < 0.99


def test_the_warm_drum_swings_between_its_repeated_engagements() -> None:
    """Cooling integrated from engagement to engagement until nothing changes any more."""
    calc = clutch(COOLED)
    heat, mass, between = number(calc, "engagement_energy"), 9 * 500, 15.0
    rise, before = 0.0, 1.0
    while abs(rise - before) > 1e-9 * rise or rise == 0:
        before = rise
        run = solve_ivp(lambda _, y: -25 * 0.2 / mass * y, (0, between), [rise], rtol=1e-10, atol=1e-12)
        rise = float(run.y[0, -1]) + heat / mass
    assert number(calc, "drum_temperature_rise_warm") == pytest.approx(rise, rel=1e-5)
    cooling = solve_ivp(lambda _, y: [-25 * 0.2 / mass * y[0], y[0]], (0, between), [rise, 0.0], rtol=1e-10, atol=1e-10)
    assert number(calc, "mean_temperature_rise") == pytest.approx(cooling.y[1, -1] / between, rel=1e-5)


def test_the_lining_is_the_mean_and_an_engagement_above_the_surroundings() -> None:
    calc = clutch(COOLED, drum_mass="0.5 kg")  # so light that it warms through
    single = number(calc, "drum_temperature_rise")
    assert single == pytest.approx(number(calc, "engagement_energy") / (0.5 * 500))
    assert single > number(calc, "surface_temperature_rise")
    assert number(calc, "lining_temperature_rise") == pytest.approx(single + number(calc, "mean_temperature_rise"))
    alone = clutch(HEATED)
    assert number(alone, "lining_temperature_rise") == number(alone, "surface_temperature_rise")


def test_a_single_engagement_has_no_rise_of_a_warm_drum() -> None:
    outputs = mechanism_results(clutch(COOLED, engagements_per_hour=0), {}).outputs
    assert "drum_temperature_rise_warm" not in outputs
    assert outputs["mean_temperature_rise"].value == outputs["lining_power_density"].value == 0


def test_engagements_that_follow_too_fast_fail() -> None:
    time = number(clutch(HEATED), "slip_time")
    late, soon = (
        checks(clutch(HEATED, engagements_per_hour=f"{rate / time!r} 1/s"))["slip_share"] for rate in (0.99, 1.01)
    )
    assert (late.status, soon.status) == ("pass", "fail")


@pytest.mark.parametrize(
    "key, quantity, unit",
    [("allowable_pv", "pv", "Pa*m/s"), ("allowable_temperature_rise", "lining_temperature_rise", "K"),
     ("allowable_power_density", "lining_power_density", "W/m**2")],
)  # fmt: skip
def test_what_is_allowed_is_checked_when_it_is_given(key: str, quantity: str, unit: str) -> None:
    value = number(clutch(COOLED), quantity)
    name = {"allowable_power_density": "lining_power_density"}.get(key, key.removeprefix("allowable_"))
    for share, status in ((0.999, "fail"), (1.001, "pass")):
        check = checks(clutch(COOLED, **{key: f"{value * share!r} {unit}"}))[name]
        assert check.status == status
        assert check.utilisation == pytest.approx(1 / share)
    assert checks(clutch(COOLED))[name].missing == [key]
