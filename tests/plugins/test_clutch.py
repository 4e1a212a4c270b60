"""The clutch against balances of forces, an integrated run-up, conduction of heat and repeated cooling; its figures, and bad input."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.clutch import MECHANISM
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.figure_views import figures
from diecut_report.results.mechanism import mechanism_results
from diecut_report.results.origins import Provenance
from tests.machines import advised, checks, inputs, number, statuses
from tests.plugins.bearings import Over
from tests.plugins.clutches import BASE, COOLED, HEATED, clutch

WEDGE = ("wedge_angle", "wedge_friction")

# --- forces of the wedge ---------------------------------------------------------------------------------------------


def face(alpha: float) -> tuple[Array, Array]:
    """Unit vectors in the plane of axis (x, the cone moves along +x to engage) and radius (y): square to the cone's face,
    out of the cone, and along it as the engaging cone slides under the shoe. Found by turning the cylinder's face."""
    turn = np.array([[np.cos(alpha), np.sin(alpha)], [-np.sin(alpha), np.cos(alpha)]])
    return turn @ np.array([0.0, 1.0]), turn @ np.array([1.0, 0.0])


def contact(alpha: float, friction: float, pressing: float, sliding: float) -> tuple[Array, float]:
    """The cone's force on the shoes and its normal part, from the shoes' balance: unknown are the normal force and the
    force along the axis; friction on the shoe points the way the cone slides (+1 engaging, −1 coming out)."""
    normal, along = face(alpha)
    on_shoe = normal + sliding * friction * along  # for each newton of normal force
    size = np.linalg.solve(np.column_stack([on_shoe, [1.0, 0.0]]), [0.0, pressing])[0]
    return size * on_shoe, size


@given(alpha=st.floats(0.01, 1.5), friction=st.floats(0, 0.99), torque=st.floats(1, 1e5))
def test_shoes_and_cone_are_in_balance_engaging_and_releasing(alpha: float, friction: float, torque: float) -> None:
    assume(np.cos(alpha) - friction * np.sin(alpha) > 1e-3)
    calc = clutch(torque=torque, wedge_angle=f"{alpha!r} rad", wedge_friction=friction)
    pressing = number(calc, "pressing_force")
    assert pressing * 0.35 * 0.12 == pytest.approx(torque)
    force, normal = contact(alpha, friction, pressing, 1.0)
    assert number(calc, "wedge_normal_force") == pytest.approx(normal)
    assert number(calc, "wedge_friction_force") == pytest.approx(friction * normal)
    assert number(calc, "engagement_force") == pytest.approx(force[0])
    assert number(calc, "force_amplification") == pytest.approx(pressing / force[0])
    released = -contact(alpha, friction, pressing, -1.0)[0][0]  # along −x the shoes push the cone out
    assert number(calc, "release_force") == pytest.approx(released, abs=1e-9 * pressing)


@given(alpha=st.floats(0.001, 1.5), friction=st.floats(0, 0.99))
def test_a_self_locking_wedge_has_to_be_pulled_out(alpha: float, friction: float) -> None:
    assume(np.cos(alpha) > friction * np.sin(alpha))
    assume(abs(np.tan(alpha) - friction) > 1e-9)
    calc = clutch(wedge_angle=f"{alpha!r} rad", wedge_friction=friction)
    locks = np.tan(alpha) < friction
    assert bool(calc["self_locking"][0, 0]) is bool(locks)
    assert (number(calc, "release_force") > 0) is bool(locks)
    check = checks(calc)["releases"]
    assert check.status == ("fail" if locks else "pass")
    assert check.utilisation == pytest.approx(friction / np.tan(alpha))


def test_friction_that_equals_the_slope_locks_and_fails_strictly() -> None:
    values = inputs(MECHANISM, BASE) | {"wedge_angle": 0.2, "wedge_friction": float(np.tan(0.2))}
    calc = calculate(MECHANISM, values)
    assert mechanism_results(calc, {}).outputs["self_locking"].value is True
    assert statuses(calc)["releases"] == "fail"
    assert checks(calc)["releases"].utilisation == 1.0
    assert number(calc, "release_force") == pytest.approx(0, abs=1e-9)
    assert calc["release_behaviour"][0, 0] == "stays engaged until the cone is pulled out"


def test_the_report_says_what_a_negative_release_force_means() -> None:
    results = mechanism_results(clutch(), {})
    assert results.outputs["release_force"].value < 0
    assert results.outputs["release_behaviour"].value == "opens by itself"
    said = next(section.text for section in results.sections if section.title == "Release")
    assert "negative F_r means that no pull is required" in said


# --- torque and lining -----------------------------------------------------------------------------------------------


def test_torque_comes_from_power_and_speed() -> None:
    keys = {key: value for key, value in BASE.items() if key != "torque"}
    calc = clutch(keys, power="12 kW", speed="955 rpm")
    assert number(calc, "torque") == pytest.approx(12000 / (955 * 2 * np.pi / 60))
    assert number(clutch(speed="100 rpm"), "power") == pytest.approx(300 * 100 * 2 * np.pi / 60)


@pytest.mark.parametrize(
    "keys, words",
    [({}, "torque, or power and speed"), ({"power": 3}, "speed"), ({"torque": 3, "power": 3, "speed": 5}, "torque")],
)
def test_torque_or_power_and_speed_is_needed(keys: dict[str, Any], words: str) -> None:
    rest = {"shoe_radius": 120, "wedge_angle": 10}
    fault = MECHANISM.inputs.one_of[0].fault({**rest, **keys})
    assert words in fault
    assert MECHANISM.inputs.one_of[0].fault({**rest, "torque": 3, "speed": 5}) == ""


def test_the_lining_carries_the_torque() -> None:
    """Integral of friction over the shoes' surface, pressure by the results."""
    calc = clutch(shoe_coverage=0.8, shoe_width="35 mm")
    reach = 0.8 * 2 * np.pi
    torque = quad(lambda _: 0.35 * number(calc, "pressure") * 0.12 * 0.035 * 0.12, 0, reach)[0]
    assert torque == pytest.approx(300)
    sized = clutch(shoe_coverage=0.8)
    assert number(sized, "pressure") == pytest.approx(0.3e6)
    assert number(sized, "lining_width") == number(sized, "shoe_width") == number(calc, "shoe_width")


@pytest.mark.parametrize(("greatest", "status"), [(1.49, "pass"), (1.51, "fail")])
def test_a_clutch_holds_the_torque_that_passes_it(greatest: float, status: str) -> None:
    """Also where it acts backwards; up to the design torque, which has the service factor of 1.5."""
    torque = clutch()["torque"].item()
    curve = Over(lambda angle: -greatest * torque * np.cos(angle) ** 2)
    calculation = clutch(torque_curve=curve, service_factor=1.5)
    assert number(calculation, "transmitted_torque_max") == pytest.approx(greatest * torque)
    assert statuses(calculation)["transmitted_torque"] == status
    assert "transmitted_torque" not in checks(clutch())


def test_a_width_is_checked_and_one_that_is_sized_reaches_the_allowed_pressure() -> None:
    sized = checks(clutch())["pressure"]
    assert (sized.status, sized.sized_to_limit) == ("pass", True) and sized.utilisation == pytest.approx(1)
    left_out = mechanism_results(clutch(), {"allowable_pressure": Provenance("given")}).absent
    assert "allowable_pressure" not in str(left_out)
    needed = number(clutch(), "shoe_width")
    wide, narrow = (advised(clutch(shoe_width=f"{needed * share!r} m"))["pressure"] for share in (1.001, 0.999))
    assert (wide.status, narrow.status) == ("pass", "fail")
    assert narrow.utilisation == pytest.approx(1 / 0.999)
    assert "Set shoe_width to between 31.58 mm and 120 mm" in narrow.message  # 31.5785 rounded up


def test_travel_lifts_the_shoes_by_gap_and_wear() -> None:
    calc = clutch(radial_gap="0.4 mm", wear_allowance="1.6 mm", available_travel="11 mm")
    along = face(np.radians(10))[1]
    lifted = -along[1] / along[0]  # of the face at a fixed place, for each length of travel
    assert number(calc, "engagement_travel") * lifted == pytest.approx(0.4e-3)
    assert number(calc, "axial_travel") * lifted == pytest.approx(2e-3)
    assert statuses(calc)["axial_travel"] == "fail"


def test_what_is_not_given_is_said_and_left_out() -> None:
    results = mechanism_results(clutch(), {})
    absent = " ".join(part.text for part in results.absent)
    for key in ("radial_gap", "speed", "driven_inertia", "cooling"):
        assert key in absent
    assert {"pv", "slip_time", "axial_travel", "lining_temperature_rise"}.isdisjoint(results.outputs)
    made = {check.id: check for check in results.checks}
    assert {name for name, check in made.items() if check.status != "not_checked"} == {
        "releases",
        "width_ratio",
        "pressure",  # that the width is sized to
    }
    assert made["pv"].missing == ["speed", "allowable_pv"]


# --- bad input -------------------------------------------------------------------------------------------------------


@given(alpha=st.floats(0.8, 1.57), friction=st.floats(0.01, 0.99))
def test_a_wedge_that_jams_is_refused_and_what_is_told_lies_on_the_limit(alpha: float, friction: float) -> None:
    limit = brentq(lambda angle: np.cos(angle) - friction * np.sin(angle), 0.01, 1.57)
    assume(abs(alpha - limit) > 1e-9)
    values = inputs(MECHANISM, BASE) | {"wedge_angle": alpha, "wedge_friction": friction}
    if alpha < limit:
        calc = calculate(MECHANISM, values)
        assert number(calc, "wedge_angle_limit") == pytest.approx(limit)
        return
    with pytest.raises(Impossible) as refused:
        calculate(MECHANISM, values)
    assert refused.value.key == "wedge_angle"


def test_a_wedge_that_jams_is_told_the_greatest_angle_and_friction() -> None:
    with pytest.raises(Impossible) as refused:
        clutch(wedge_angle="80 deg", wedge_friction=0.3)
    told = refused.value.message
    angle, friction = (float(told.split(f"{key} below ")[1].split("°")[0].split(",")[0]) for key in WEDGE)
    assert 0.998 * 73.3008 < angle <= 73.3008 and 0.998 * 0.17633 < friction <= 0.17633
    for change in ({"wedge_angle": angle}, {"wedge_friction": friction}):
        clutch(**{"wedge_angle": "80 deg", "wedge_friction": 0.3} | change)


def test_a_jamming_wedge_and_too_great_a_load_are_told_at_once() -> None:
    with pytest.raises(Impossible) as refused:
        clutch(wedge_angle="80 deg", wedge_friction=0.5, load_torque_at_engagement="400 N*m")
    assert [key for key, _ in refused.value.reasons] == ["wedge_angle", "load_torque_at_engagement"]


@pytest.mark.parametrize("load", ["300 N*m", "301 N*m"])
def test_a_load_that_the_clutch_cannot_run_up_is_refused(load: str) -> None:
    with pytest.raises(Impossible) as refused:
        clutch(load_torque_at_engagement=load)
    assert refused.value.key == "load_torque_at_engagement"
    assert "300 N·m" in refused.value.message


@pytest.mark.parametrize("share", [1 - 1e-13, 1 - 1e-15, 1 + 1e-14, 1 + 1e-12])
def test_beside_the_self_locking_limit_nothing_breaks(share: float) -> None:
    results = mechanism_results(clutch(wedge_angle="15 deg", wedge_friction=np.tan(np.pi / 12) * share), {})
    items = {item.id: item for section in results.sections for item in section.items if item.id}
    assert abs(results.outputs["release_force"].value) < 1e-7
    assert items["release_force"].substituted is None and "printed digits" in items["release_force"].note


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


def drawn(calc: Calculation, name: str) -> FigureRecord:
    """A figure's data by its id."""
    return next(figure for figure in figures(calc) if figure.id == name)


@pytest.mark.parametrize("friction", [0.0, 0.1, 0.3])
def test_the_arrows_of_the_force_triangle_are_the_forces_and_close(friction: float) -> None:
    calc = clutch(wedge_friction=friction)
    arrows = [shape for shape in drawn(calc, "force_triangle").shapes if shape.shape == "arrow"]
    vectors = [np.subtract(shape.end, shape.start) for shape in arrows]
    np.testing.assert_allclose(np.sum(vectors, axis=0), 0, atol=1e-9 * number(calc, "pressing_force"))
    names = [
        "pressing_force",
        "engagement_force",
        "wedge_normal_force",
        *(["wedge_friction_force"] if friction else []),
    ]
    lengths = sorted(float(np.hypot(*vector)) for vector in vectors)
    np.testing.assert_allclose(lengths, sorted(number(calc, name) for name in names))


def test_the_chart_shows_the_chosen_point_and_the_self_locking_limit() -> None:
    calc = clutch(wedge_friction=0.12)
    panel = drawn(calc, "engagement_force").panels[0]
    names = [line.label for line in panel.lines]
    assert names == ["f = 0.05", "f = 0.1", "f = 0.12", "f = 0.15", "f = 0.2", "self-locking limit, f = tan α"]
    pressing = number(calc, "pressing_force")
    for line, friction in zip(panel.lines, [0.05, 0.1, 0.12, 0.15, 0.2], strict=False):
        x, y = (np.array(numbers, dtype=float) for numbers in (line.x, line.y))
        np.testing.assert_allclose(y[np.isfinite(y)], (pressing * np.tan(x + np.arctan(friction)))[np.isfinite(y)])
        assert np.isfinite(y).sum() > 50
    limit = panel.lines[-1]
    np.testing.assert_allclose(limit.y, pressing * np.tan(2 * np.array(limit.x)))
    assert panel.marks[0].x == pytest.approx(np.radians(10))
    assert panel.marks[0].y == number(calc, "engagement_force")
    assert panel.verticals[0].x == pytest.approx(np.arctan(0.12))


def test_the_cone_with_the_gap_open_is_named_where_it_is_drawn_alone() -> None:
    for changes, is_named in (({}, False), ({"radial_gap": "1 mm"}, True), ({"radial_gap": 0}, False)):
        figure = drawn(clutch(**changes), "section")
        assert "dashed" not in figure.caption
        assert any("dashed" in text for text in figure.texts) is is_named


@pytest.mark.parametrize(
    "changes",
    [
        {"wedge_angle": 0.5},
        {"wedge_angle": 0.1},
        {"wedge_angle": 1, "wedge_friction": 0},
        {"wedge_angle": 1, "radial_gap": "5 mm"},
        {"wedge_angle": 75, "wedge_friction": 0.2},
        {"wedge_angle": 45, "wedge_friction": 0.95},
        {"shoe_width": "300 mm"},
        {"radial_gap": "1 mm"},
    ],
)
def test_figures_of_unusual_clutches_have_no_infinite_coordinate(changes: dict[str, Any]) -> None:
    for figure in figures(clutch(**changes)):
        for shape in figure.shapes:
            for key in ("points", "outer", "from", "to", "at", "center"):
                assert np.all(np.isfinite(getattr(shape, key, 0.0)))
        for panel in figure.panels:
            assert all(np.isfinite(np.array(line.y, dtype=float)).sum() > 10 for line in panel.lines)
