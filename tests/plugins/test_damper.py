"""The rubber damper against the motion of mass and spring, its energy, bad input and figures."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from diecut_report.config.plugins import Discovery
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.damper import MECHANISM
from diecut_report.press import Press
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.figure_views import figures
from diecut_report.results.mechanism import mechanism_results
from tests.configs import problems, saved
from tests.machines import inputs, number
from tests.plugins.dampers import calculated, checks, passing, told
from tests.validation.rows_damper import WORKED, damper

UNITS = {"inertia": "kg*m**2", "static_unbalance": "kg*m"}
CUT_AWAY: dict[str, Any] = {
    "elastic_modulus": "8 MPa", "ring_width": "60 mm", "pad_height": "60 mm",
    "mass": "104 kg", "rolling_radius": "105 mm", "velocity": "0.6 m/s", "carriage_mass": "40 kg",
}  # fmt: skip
ROLLING: dict[str, Any] = {"mass": "80 kg", "inertia": "0.9 kg*m**2", "rolling_radius": "105 mm"}


def without(*keys: str) -> dict[str, Any]:
    """The worked example without some of its keys."""
    return {key: value for key, value in WORKED.items() if key not in keys}


def springs(calc: Calculation) -> float:
    """Stiffness of all dampers from the inputs alone, N/m."""
    sides = float(calc["ring_width"][0, 0] * calc["pad_height"][0, 0])
    return float(calc["damper_count"][0, 0]) * sides * number(calc, "elastic_modulus") / number(calc, "adopted_length")


def rolling(**changes: Any) -> Calculation:
    """A damper that stops a cylinder with its carriages."""
    return calculate(MECHANISM, inputs(MECHANISM, CUT_AWAY | changes))


# --- what is stopped ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("way", [0.0, 0.01, 0.08])
def test_the_energy_is_that_of_all_points_of_a_rolling_cylinder_and_its_carriages(way: float) -> None:
    """A disc with a part cut away below its axis, point by point: it rolls on the die, the axis at the speed of contact."""
    radius, speed, carriages = 0.105, 0.6, 40.0
    side = np.linspace(-radius, radius, 2001)
    x, y = (each.ravel() for each in np.meshgrid(side, side))
    there = (np.hypot(x, y) <= radius) & (y >= -0.065)
    x, y, each = x[there], y[there], 104.0 / there.sum()
    turn = way / radius
    x, y = x * np.cos(turn) + y * np.sin(turn), y * np.cos(turn) - x * np.sin(turn)
    energy = each / 2 * ((speed * (1 + y / radius)) ** 2 + (speed * x / radius) ** 2).sum() + carriages * speed**2 / 2
    upright = {
        "static_unbalance": each * float(np.hypot(x.sum(), y.sum())),
        "inertia": each * float((x**2 + y**2).sum()),
    }
    calc = rolling(**{key: f"{value:.15g} {UNITS[key]}" for key, value in upright.items()}, contact_distance=f"{way} m")
    assert number(calc, "kinetic_energy") == pytest.approx(energy, rel=1e-6)


def test_nothing_that_follows_from_a_part_of_the_energy_is_checked() -> None:
    known = {"static_unbalance": "2 kg*m", "contact_distance": "10 mm"}
    part = {key: value for key, value in CUT_AWAY.items() if key != "carriage_mass"} | {"inertia": "0.7 kg*m**2"}
    assert checks(calculate(MECHANISM, inputs(MECHANISM, part))) == {}
    found = checks(rolling(**known, inertia="0.7 kg*m**2"))
    assert set(found) == {"strain", "stress", "slenderness"}


# --- energy and motion -----------------------------------------------------------------------------------------------


def test_the_force_over_the_deflection_takes_up_the_energy() -> None:
    calc = damper(damper_count=3)
    taken = quad(lambda x: springs(calc) * x, 0, number(calc, "deflection"))[0]
    assert taken == pytest.approx(150, rel=1e-12)
    assert 3 * number(calc, "peak_force") == pytest.approx(springs(calc) * number(calc, "deflection"), rel=1e-12)


def test_the_energy_is_that_of_translation_and_rotation() -> None:
    calc = calculated(without("kinetic_energy") | ROLLING)
    assert number(calc, "kinetic_energy") == pytest.approx(80 * 0.5**2 / 2 + 0.9 * (0.5 / 0.105) ** 2 / 2, rel=1e-12)
    assert number(calc, "reduced_mass") == pytest.approx(80 + 0.9 / 0.105**2, rel=1e-12)


def stopped(mass: float, stiffness: float, velocity: float, push: float) -> tuple[float, float]:
    """Time and deflection at which a mass on a spring comes to rest, by integration of its motion."""

    def rest(_: float, state: Any) -> float:
        return float(state[1])

    rest.terminal = True  # type: ignore[attr-defined]
    rest.direction = -1  # type: ignore[attr-defined]

    def motion(_: float, state: Any) -> list[float]:
        return [state[1], (push - stiffness * state[0]) / mass]

    found = solve_ivp(motion, (0, 100), (0, velocity), events=rest, rtol=1e-11, atol=1e-12, method="DOP853")
    return float(found.t_events[0][0]), float(found.y_events[0][0][0])


@pytest.mark.parametrize("push", [0.0, 40.0, 200.0, 3000.0])
def test_the_stop_is_that_of_the_integrated_motion(push: float) -> None:
    calc = calculated(without("kinetic_energy") | ROLLING | ({"drive": {"force": push}} if push else {}))
    mass, stiffness = 80 + 0.9 / 0.105**2, springs(calc)
    time, deflection = stopped(mass, stiffness, 0.5, push)
    names = ("driven_stop_time", "driven_deflection", "driven_peak_deceleration")
    names = names if push else ("stop_time", "deflection", "peak_deceleration")
    expected = (time, deflection, (stiffness * deflection - push) / mass)
    for name, value in zip(names, expected, strict=True):
        assert number(calc, name) == pytest.approx(value, rel=1e-8)


def test_the_loss_tangent_loses_what_a_damped_half_cycle_loses() -> None:
    loss = 0.03
    calc = damper(loss_tangent=loss)
    mass, stiffness = number(calc, "reduced_mass"), springs(calc)
    damping = loss * np.sqrt(stiffness * mass)

    def back(_: float, state: Any) -> float:
        return float(state[0])

    back.direction = -1  # type: ignore[attr-defined]

    def motion(_: float, state: Any) -> list[float]:
        return [state[1], -(stiffness * state[0] + damping * state[1]) / mass]

    end = 1.2 * np.pi * np.sqrt(mass / stiffness)
    found = solve_ivp(motion, (0, end), (0, 0.5), events=back, rtol=1e-11, atol=1e-13, method="DOP853")
    velocity = abs(found.y_events[0][-1][1])
    assert number(calc, "loss_fraction") == pytest.approx(1 - (velocity / 0.5) ** 2, abs=2e-5)
    assert number(calc, "rebound_velocity") == pytest.approx(velocity, rel=2e-5)


def test_rebound_and_heat_share_the_energy() -> None:
    calc = damper(loss_fraction=0.35, impacts_per_hour=1800)
    left = number(calc, "reduced_mass") * number(calc, "rebound_velocity") ** 2 / 2
    assert left + number(calc, "heat_power") * 3600 / 1800 == pytest.approx(150, rel=1e-12)


def test_an_impact_that_loses_all_does_not_rebound() -> None:
    assert number(damper(loss_fraction=1), "rebound_velocity") == 0


@given(hardness=st.floats(20, 80))
def test_the_modulus_is_that_of_a_half_space_under_the_durometers_punch(hardness: float) -> None:
    """Gent's derivation: 56 gf + 7.62336 gf a degree, 0.1 in deep at zero, flat punch of radius 0.0203 in, incompressible."""
    calc = calculated(without("elastic_modulus") | {"shore_hardness": hardness})
    force = (56 + 7.62336 * hardness) * 9.81e-3
    depth, radius = 0.1 * 25.4e-3 * (1 - hardness / 100), 0.0203 * 25.4e-3
    assert number(calc, "elastic_modulus") == pytest.approx(force * (1 - 0.5**2) / (2 * radius * depth), rel=1e-4)


# --- length ----------------------------------------------------------------------------------------------------------


@given(energy=st.floats(0.01, 1e5))
def test_the_adopted_length_is_the_next_multiple_of_five_millimetres(energy: float) -> None:
    calc = damper(kinetic_energy=energy)
    free, adopted = number(calc, "free_length"), number(calc, "adopted_length")
    assert free * (1 - 1e-8) <= adopted < free + 0.005
    assert adopted / 0.005 == pytest.approx(round(adopted / 0.005), abs=1e-9)
    assert number(calc, "stress") <= 1.2e6 * (1 + 1e-8)


def test_a_length_of_almost_nothing_is_one_step() -> None:
    assert number(damper(kinetic_energy=1e-12), "adopted_length") == pytest.approx(0.005, rel=1e-12)


def test_a_given_length_is_checked_instead_of_sized() -> None:
    calc = damper(adopted_length="400 mm")
    assert number(calc, "free_length") == pytest.approx(5 / 9, rel=1e-12)
    assert number(calc, "stress") == pytest.approx(1.2e6 * np.sqrt(5 / 9 / 0.4), rel=1e-12)
    assert "stress" not in passing(calc)


# --- buckling ----------------------------------------------------------------------------------------------------------


@pytest.mark.nightly
@given(energy=st.floats(1, 1e4), width=st.floats(2, 300), height=st.floats(2, 300), modulus=st.floats(1, 20))
def test_pad_and_number_against_buckling_are_the_least(
    energy: float, width: float, height: float, modulus: float
) -> None:
    keys = {"kinetic_energy": energy, "ring_width": width, "pad_height": height, "elastic_modulus": modulus}
    calc = damper(**keys)
    side = round(number(calc, "steady_pad_side") * 1e3)
    assert side % 5 == 0
    assert "slenderness" in passing(damper(**keys | {"ring_width": side, "pad_height": side}))
    if side > 5:
        assert "slenderness" not in passing(damper(**keys | {"ring_width": side - 5, "pad_height": side - 5}))
    count = round(number(calc, "steady_damper_count"))
    assume(count <= 1_000_000)  # more are refused as not plausible
    assert "slenderness" in passing(damper(**keys | {"damper_count": count}))
    if count > 1:
        assert "slenderness" not in passing(damper(**keys | {"damper_count": count - 1}))


def test_a_pad_that_is_narrower_than_any_length_still_has_a_number_of_dampers() -> None:
    calc = damper(pad_height="1 mm")
    assert number(calc, "length_limit") == pytest.approx(3e-3)
    count = int(number(calc, "steady_damper_count"))
    assert {"slenderness", "stress"} <= passing(damper(pad_height="1 mm", damper_count=count, adopted_length="3 mm"))


# --- the drive still pushing -----------------------------------------------------------------------------------------


@given(push=st.floats(1, 1e5), energy=st.floats(0.1, 1e4), length=st.floats(20, 2000))
def test_the_driven_deflection_holds_energy_and_work_of_the_drive(push: float, energy: float, length: float) -> None:
    calc = damper(kinetic_energy=energy, adopted_length=length, drive={"force": push})
    stiffness = springs(calc)
    top = 2 * push / stiffness + np.sqrt(2 * energy / stiffness) + 1e-9
    found = brentq(lambda x: stiffness * x**2 / 2 - energy - push * x, push / stiffness, top, xtol=1e-15, rtol=1e-14)
    assert number(calc, "driven_deflection") == pytest.approx(found, rel=1e-9)
    assert number(calc, "driving_work") == pytest.approx(push * found, rel=1e-9)
    assert number(calc, "driven_stress") == pytest.approx(8e6 * found / (length / 1e3), rel=1e-9)
    assert number(calc, "driven_peak_force") == pytest.approx(number(calc, "driven_stress") * 1.5e-3, rel=1e-12)
    assert number(calc, "resting_deflection") == pytest.approx(push / stiffness, rel=1e-12)


def test_a_torque_pushes_as_the_force_that_does_its_work() -> None:
    """Rolling a turn takes the torque 2π rad and the axis 2π·R."""
    by_torque = damper(drive={"torque": "21 N*m", "rolling_radius": "105 mm"})
    assert number(by_torque, "driving_force") * 2 * np.pi * 0.105 == pytest.approx(21 * 2 * np.pi, rel=1e-12)


@pytest.mark.parametrize("max_strain", [0.2, 0.1])
def test_the_length_and_the_number_against_the_drive_keep_the_limits_and_are_the_least(max_strain: float) -> None:
    pushed: dict[str, Any] = {"drive": {"force": 300}, "max_strain": max_strain}
    limits = {"driven_stress", "driven_strain"}
    assert not limits <= passing(damper(**pushed))
    count = round(number(damper(**pushed), "driven_damper_count"))
    assert limits <= passing(damper(**pushed, damper_count=count, adopted_length="560 mm"))
    assert not limits <= passing(damper(**pushed, damper_count=count - 1, adopted_length="560 mm"))
    assert limits <= passing(damper(**pushed, adopted_length=f"{number(damper(**pushed), 'driven_length')!r} m"))
    least = number(damper(**pushed), "driven_free_length")
    assert limits <= passing(damper(**pushed, adopted_length=least * 1e3 * (1 + 1e-7)))
    assert not limits <= passing(damper(**pushed, adopted_length=least * 1e3 * (1 - 1e-7)))


def test_beyond_the_greatest_force_no_length_helps() -> None:
    for length in (1e3, 1e5, 1e7, 1e9):
        assert number(damper(drive={"force": 1800}, adopted_length=length), "driven_stress") > 1.2e6
    hopeless = damper(drive={"force": 2000})
    assert "driven_free_length" not in mechanism_results(hopeless, {}).outputs
    failed = checks(hopeless)["driven_stress"]
    assert "let go before the stop" in told(hopeless, "driven_stress")
    assert [[change.key for change in way] for way in failed.advice] == [["damper_count"], ["ring_width", "pad_height"]]
    for way in failed.advice:
        better = damper(drive={"force": 2000}, **{change.key: change.value for change in way})
        assert checks(better)["driven_stress"].status == "pass"


# --- figures, configs ------------------------------------------------------------------------------------------------


def figure(calc: Calculation, name: str) -> FigureRecord:
    """A figure's data by its id."""
    return next(f for f in figures(calc) if f.id == name)


def test_the_shaded_areas_are_the_energies() -> None:
    calc = damper(drive={"force": 200})
    fills = figure(calc, "force").panels[0].fills
    areas = [np.trapezoid(part.y, part.x) for part in fills]
    assert areas == pytest.approx([150, number(calc, "driving_work")], rel=1e-12)


def test_the_pressed_block_is_drawn_with_its_length_and_its_volume() -> None:
    calc = damper()
    shapes = figure(calc, "block").shapes
    free, _, pressed = (np.array(shape.outer) for shape in shapes if getattr(shape, "role", "") == "section")
    assert np.ptp(pressed[:, 0]) == pytest.approx(0.56 - number(calc, "deflection"), rel=1e-12)
    half = len(pressed) // 2
    volumes = []
    for outline in (free, pressed):
        x, thick = outline[:half, 0], 2 * (outline[:half, 1] - outline[:, 1].mean())
        volumes.append(np.trapezoid(thick**2 * 50 / 30, x))
    assert volumes[0] == pytest.approx(0.05 * 0.03 * 0.56, rel=1e-12)
    assert volumes[1] == pytest.approx(volumes[0], rel=1e-4)


def test_a_block_that_cannot_be_pressed_so_far_is_drawn_free_alone() -> None:
    shapes = figure(damper(elastic_modulus="1 MPa"), "block").shapes
    assert any("no block can be pressed" in getattr(shape, "text", "") for shape in shapes)


@pytest.mark.parametrize("length", [{}, {"adopted_length": "100 mm"}, {"adopted_length": "5000 mm"}])
def test_the_length_falls_with_the_square_of_the_stress_and_the_adopted_one_is_on_the_line(
    length: dict[str, Any],
) -> None:
    panel = figure(damper(**length), "length").panels[0]
    x, y = (np.array(numbers) for numbers in (panel.lines[0].x, panel.lines[0].y))
    assert y * x**2 == pytest.approx(5 / 9 * 1.2e6**2, rel=1e-12)
    [mark] = panel.marks
    assert mark.y * mark.x**2 == pytest.approx(5 / 9 * 1.2e6**2, rel=1e-12)
    assert x[0] < mark.x < x[-1]


def test_nothing_is_said_of_a_drive_that_is_not_given() -> None:
    said = [figure.caption + str(figure.shapes) for figure in figures(damper())]
    assert not any("drive" in text for text in said)
    assert "by the drive too" in str(figure(damper(drive={"force": 50}), "block").shapes)


CONFIG = """\
schema_version: 1
project: {title: Test}
press: {name: P%s}
mechanisms:
  a: {kind: damper, ring_width: 50, pad_height: 30, %s}
"""
SURE = "kinetic_energy: 150, velocity: 0.5, elastic_modulus: 8"


@pytest.mark.parametrize("press, impacts", [(", productivity: 6000 1/h", 3000), ("", None)])
def test_half_the_sheets_heat_each_end(tmp_path: Path, press: str, impacts: float | None) -> None:
    path = saved(tmp_path, CONFIG % (press, SURE))
    found = Press.read(path, Discovery()).calculate().results.mechanisms["a"]
    if impacts is None:
        assert "heat_power" not in found.outputs
        assert any("impacts_per_hour" in absent.text for absent in found.absent)
    else:
        assert found.outputs["heat_power"].value == pytest.approx(0.2 * 150 * impacts / 3600, rel=1e-12)


@pytest.mark.parametrize(
    "keys, words",
    [
        ("velocity: 0.5, elastic_modulus: 8", ("kinetic_energy", "mass", "inertia", "rolling_radius", "velocity")),
        (
            "velocity: 0.5, elastic_modulus: 8, mass: 80",
            ("inertia and rolling_radius is missing beside mass and velocity",),
        ),
        (SURE + ", mass: 80, inertia: 1, rolling_radius: 100", ("kinetic_energy and mass are both given",)),
        ("kinetic_energy: 150, velocity: 0.5", ("elastic_modulus", "shore_hardness")),
        (SURE + ", shore_hardness: 60", ("elastic_modulus and shore_hardness are both given",)),
        (
            "elastic_modulus: 8, mass: 80, inertia: 1, rolling_radius: 100",
            ("velocity is missing beside mass, inertia",),
        ),
        (
            "elastic_modulus: 8, mass: 80, inertia: 1, rolling_radius: 100, velocity: 0.5, static_unbalance: 2",
            ("carriage_mass and contact_distance is missing beside mass",),
        ),
        (SURE + ", drive: {}", ("force", "torque")),
        (SURE + ", drive: {torque: 20}", ("rolling_radius is missing beside torque",)),
    ],
)
def test_bad_input_is_told_in_words(tmp_path: Path, keys: str, words: tuple[str, ...]) -> None:
    [message] = problems(tmp_path, CONFIG % ("", keys), Discovery())
    assert all(word in message for word in words), message


def test_without_the_speed_at_contact_the_stop_is_left_out_and_said() -> None:
    calc = calculate(
        MECHANISM, inputs(MECHANISM, {"kinetic_energy": 150, "elastic_modulus": 8, "ring_width": 50, "pad_height": 30})
    )
    results = mechanism_results(calc, {})
    assert {"stop_time", "peak_deceleration", "rebound_velocity"}.isdisjoint(results.outputs)
    assert results.outputs["loss_fraction"].value == 0.2 and results.outputs["stress"].value > 0
    assert any("velocity is not given" in part.text for part in results.absent)


@pytest.mark.parametrize("loss", [0, 0.2, 0.3])
def test_a_loss_beside_a_loss_tangent_is_refused(loss: float) -> None:
    with pytest.raises(Impossible, match=rf"loss_fraction of {loss},.*leave one of them out") as refused:
        damper(loss_fraction=loss, loss_tangent=0.1)
    assert refused.value.key == "loss_tangent"


def test_the_inputs_show_no_loss_beside_the_one_that_is_used() -> None:
    """A loss that is taken by default would contradict the one that follows from the loss tangent."""
    results = mechanism_results(damper(loss_tangent=0.15), {})
    assert "loss_fraction" not in results.inputs
    assert results.outputs["loss_fraction"].value == pytest.approx(1 - np.exp(-0.15 * np.pi), rel=1e-12)
    usual = mechanism_results(damper(), {}).outputs["loss_fraction"]
    assert usual.value == 0.2 and "usual" in usual.description


@pytest.mark.parametrize("rubber", [{"elastic_modulus": "8 MPa"}, {"shore_hardness": 60}])
def test_a_stiffer_rubber_at_the_impact_is_a_stiffer_rubber(rubber: dict[str, Any]) -> None:
    block = without("elastic_modulus")
    still = calculated(block | rubber)
    quick = calculated(block | rubber | {"dynamic_stiffness_factor": 1.5})
    stiffer = calculated(block | {"elastic_modulus": f"{1.5e-6 * number(still, 'elastic_modulus')!r} MPa"})
    for name in ("elastic_modulus", "free_length", "stress", "strain", "deflection", "peak_force"):
        assert number(quick, name) == pytest.approx(number(stiffer, name), rel=1e-12)
    assert number(quick, "static_modulus") == pytest.approx(number(still, "elastic_modulus"), rel=1e-15)


def test_the_rubbers_stiffness_at_the_impact_is_not_taken_for_that_at_rest_without_a_word() -> None:
    block = WORKED | {"adopted_length": "700 mm"}
    unsaid = {check.id: check for check in mechanism_results(calculated(block), {}).checks}["dynamic_stiffness"]
    assert (unsaid.status, unsaid.missing) == ("not_checked", ["dynamic_stiffness_factor"])
    borne = number(calculated(block), "stiffness_borne")
    assert borne == pytest.approx(
        700 / 555.56, rel=1e-5
    )  # 555.56 mm of the worked example bear the allowed stress at rest
    for factor, status in ((borne * 0.999, "pass"), (borne * 1.001, "fail")):
        found = checks(calculated(block | {"dynamic_stiffness_factor": factor}))
        assert found["dynamic_stiffness"].status == found["stress"].status == status


def test_a_length_sized_for_the_rubber_at_rest_is_overstressed_by_its_dynamic_stiffness() -> None:
    hit = calculated(WORKED | {"adopted_length": "560 mm", "dynamic_stiffness_factor": 1.5})
    assert number(hit, "stress") == pytest.approx(1.19523e6 * math.sqrt(1.5), rel=1e-5)
    assert "allowed 1.2" in told(hit, "stress")
