"""The clutch against the balance of forces as vectors, geometry, bad input and single runs."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from pydantic import ValidationError
from scipy.integrate import quad
from scipy.optimize import brentq

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Impossible
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.clutch import MECHANISM
from diecut_report.results.mechanism import mechanism_results
from diecut_report.results.origins import Provenance
from tests.machines import inputs, number
from tests.plugins.bearings import Over
from tests.plugins.clutches import BASE, checks, clutch

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
    assert checks(calc)["releases"].status == "fail"
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
    assert checks(calculation)["transmitted_torque"].status == status
    assert "transmitted_torque" not in checks(clutch())


def test_a_width_is_checked_and_one_that_is_sized_reaches_the_allowed_pressure() -> None:
    sized = checks(clutch())["pressure"]
    assert (sized.status, sized.sized_to_limit) == ("pass", True) and sized.utilisation == pytest.approx(1)
    left_out = mechanism_results(clutch(), {"allowable_pressure": Provenance("given")}).absent
    assert "allowable_pressure" not in str(left_out)
    needed = number(clutch(), "shoe_width")
    wide, narrow = (checks(clutch(shoe_width=f"{needed * share!r} m"))["pressure"] for share in (1.001, 0.999))
    assert (wide.status, narrow.status) == ("pass", "fail")
    assert narrow.utilisation == pytest.approx(1 / 0.999)
    assert "Set shoe_width to between 31.58 mm and 120 mm" in narrow.message  # 31.5785 rounded up


def test_travel_lifts_the_shoes_by_gap_and_wear() -> None:
    calc = clutch(radial_gap="0.4 mm", wear_allowance="1.6 mm", available_travel="11 mm")
    along = face(np.radians(10))[1]
    lifted = -along[1] / along[0]  # of the face at a fixed place, for each length of travel
    assert number(calc, "engagement_travel") * lifted == pytest.approx(0.4e-3)
    assert number(calc, "axial_travel") * lifted == pytest.approx(2e-3)
    assert checks(calc)["axial_travel"].status == "fail"


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


@pytest.mark.parametrize(
    "key, value",
    [("torque", 0), ("power", -1), ("speed", 0), ("service_factor", 0.9), ("shoe_radius", 0), ("shoe_friction", 0), ("shoe_friction", 1),
     ("wedge_angle", 0), ("wedge_angle", 90), ("wedge_friction", -0.1), ("wedge_friction", 1), ("allowable_pressure", 0),
     ("driven_inertia", 0), ("load_torque_at_engagement", -1), ("shoe_width", 0), ("allowable_power_density", 0),
     ("engagements_per_hour", -1), ("shoe_coverage", 0), ("shoe_coverage", 1.01), ("radial_gap", -1), ("wear_allowance", -1),
     ("available_travel", 0), ("drum_mass", 0), ("cooling", {"area": 1}), ("allowable_pv", 0), ("allowable_temperature_rise", 0)],
)  # fmt: skip
def test_an_input_out_of_its_range_is_refused(key: str, value: Any) -> None:
    with pytest.raises(ValidationError, match=key):
        MECHANISM.inputs.model_validate(BASE | {key: value})


@pytest.mark.parametrize("share", [1 - 1e-13, 1 - 1e-15, 1 + 1e-14, 1 + 1e-12])
def test_beside_the_self_locking_limit_nothing_breaks(share: float) -> None:
    results = mechanism_results(clutch(wedge_angle="15 deg", wedge_friction=np.tan(np.pi / 12) * share), {})
    items = {item.id: item for section in results.sections for item in section.items if item.id}
    assert abs(results.outputs["release_force"].value) < 1e-7
    assert items["release_force"].substituted is None and "printed digits" in items["release_force"].note
