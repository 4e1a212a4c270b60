"""The platen press against brute force, virtual work, energy, finite differences, and the equilibrium of rod, crank and platen as vectors."""

from __future__ import annotations

from itertools import pairwise
from math import degrees, pi
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.integrate import quad
from scipy.optimize import brentq

from diecut_report.config.plugins import Discovery
from diecut_report.machine.calculation import Calculation
from diecut_report.press import Press
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.mechanism import mechanism_results
from diecut_report.results.mechanism_record import ShownRecord
from tests.configs import EXAMPLES
from tests.examples import examples
from tests.machines import advised, at, checks, number, statuses
from tests.plugins.platens import FRICTIONS, GUIDED, platen

FRICTION = 0.1

RADII = (0.06, 0.0475, 0.05025)


def balance(phi: float, pull: float, moments: tuple[float, float, float], stands: float | None = None) -> float:
    """Torque of the crank, from nine equations: forces and moments on platen, rod and crank.

    ``pull`` is the force on the platen away from the shaft that the rod must carry along the guides, ``moments`` the size of the
    friction moments at platen's pin, crank pin and journal; each resists the turning of its two parts.
    """
    a, b = pins(phi, stands)
    rod = turned(phi, stands)
    at_b, at_a, at_o = moments
    on_rod_b = -at_b * np.sign(rod)  # the platen does not turn
    on_rod_a = -at_a * np.sign(rod + 1)  # the crank turns with −1
    on_crank_o = at_o  # against its clockwise turning
    # unknowns: force of platen on rod (bx, by), of crank on rod (ax, ay), of guides on platen g, of frame on crank (ox, oy), torque M
    equations = np.zeros((8, 8))
    known = np.zeros(8)
    equations[0, 0], known[0] = -1, -pull  # platen along: pull − bx = 0
    equations[1, [1, 4]] = -1, 1  # platen across
    equations[2, [0, 2]] = 1  # rod along
    equations[3, [1, 3]] = 1  # rod across
    equations[4, [2, 3]] = -(a - b).imag, (a - b).real  # rod about B
    known[4] = -(on_rod_a + on_rod_b)
    equations[5, [2, 5]] = -1, 1
    equations[6, [3, 6]] = -1, 1
    equations[7, [2, 3, 7]] = a.imag, -a.real, 1  # crank about O
    known[7] = -(on_crank_o - on_rod_a)
    return -float(np.linalg.solve(equations, known)[7])  # driving is clockwise


def turned(phi: float, stands: float | None) -> float:
    """Angular speed of the rod to the crank's, by differences; the crank turns clockwise."""
    step = 1e-6
    low, high = (np.angle(b - a) for a, b in (pins(phi - step, stands), pins(phi + step, stands)))
    return float((high - low) / (2 * step))


R, ROD, FORCE, MASS, BOARD, STRETCH, OMEGA = 0.11, 0.635, 5e5, 306.0, 5e-4, 4.5e-4, 2 * pi / 3


def slider(phi: Any) -> Any:
    """Distance of the platen's pins from the shaft in an unloaded drive (Pythagoras)."""
    return -R * np.cos(phi) + np.sqrt(ROD**2 - (R * np.sin(phi)) ** 2)


def travel(phi: Any) -> Any:
    """Its distance from the dead centre."""
    return slider(phi) - (ROD - R)


# --- contact, dwell, motion ------------------------------------------------------------------------------------------


def test_contact_and_dwell_are_where_the_loop_puts_them() -> None:
    calc = platen()
    contact = brentq(lambda phi: travel(phi) - BOARD - STRETCH, 0.01, 1, xtol=1e-14)
    relaxed = brentq(lambda phi: travel(phi) - STRETCH, 0.01, 1, xtol=1e-14)
    assert number(calc, "cutting_start_angle") == pytest.approx(contact, rel=1e-9)
    assert number(calc, "dwell_end_angle") == pytest.approx(relaxed, rel=1e-9)
    step = 1e-6
    speed = (travel(contact + step) - travel(contact - step)) / (2 * step) * OMEGA
    assert number(calc, "velocity_at_contact") == pytest.approx(speed, rel=1e-7)


def smooth(calc: Calculation, count: int = 1201, clear: float = 3e-3) -> NDArray[Any]:
    """Crank angles that keep clear of all joints of the curves."""
    phi = np.linspace(0, 2 * pi, count)
    edges = calc.domains["crank_angle"].edges[0]
    found: NDArray[Any] = phi[np.abs(phi[:, None] - edges[None, :]).min(axis=1) > clear]
    return found


def slope(calc: Calculation, curve: str, phi: NDArray[Any], step: float = 5e-4) -> NDArray[Any]:
    """The derivative by the crank angle, by central differences of fourth order."""
    near, far = (at(calc, curve, phi + n * step) - at(calc, curve, phi - n * step) for n in (1, 2))
    return np.asarray((8 * near - far) / (12 * step))


@pytest.mark.parametrize(
    "place, rate",
    [
        ("platen_displacement", "platen_velocity_ideal"),
        ("platen_velocity_ideal", "platen_acceleration"),
        ("platen_displacement_true", "platen_velocity_true"),
    ],
)
def test_speeds_and_accelerations_are_derivatives(place: str, rate: str) -> None:
    calc = platen()
    phi = smooth(calc)
    expected = at(calc, rate, phi)
    np.testing.assert_allclose(slope(calc, place, phi) * OMEGA, expected, atol=1e-8 * np.abs(expected).max())


def test_the_ideal_displacement_closes_the_loop_and_the_true_one_is_it_with_the_stretch() -> None:
    calc = platen()
    phi = np.linspace(0, 2 * pi, 4001)[:-1]
    np.testing.assert_allclose(at(calc, "platen_displacement", phi), travel(phi), atol=1e-15)
    before = -np.linspace(0.001, 0.999, 300) * number(calc, "cutting_start_angle")
    stretched = at(calc, "platen_displacement_true", before) - at(calc, "platen_displacement", before)
    np.testing.assert_allclose(at(calc, "rod_stretch", before), stretched, atol=1e-15)
    after = np.linspace(0.001, 0.999, 300) * number(calc, "dwell_end_angle")
    crank = R * np.stack([-np.cos(after), np.sin(after)])
    rods = np.hypot(crank[0] - (ROD - R + STRETCH), crank[1]) - ROD
    np.testing.assert_allclose(at(calc, "rod_stretch", after), rods, atol=1e-15)


def test_the_first_order_speed_is_reported_beside_the_exact_one() -> None:
    calc = platen()
    phi = np.linspace(0, 2 * pi, 20_001)[:-1]
    lam = R / ROD
    printed = R * OMEGA * (np.sin(phi) - lam / 2 * np.sin(2 * phi))
    np.testing.assert_allclose(at(calc, "platen_velocity_first_order", phi), printed, atol=1e-15)
    exact = np.gradient(travel(phi), phi) * OMEGA
    assert number(calc, "velocity_difference") == pytest.approx(np.abs(exact - printed)[2:-2].max(), rel=1e-3)
    assert number(calc, "velocity_difference") < 1e-3 * number(calc, "velocity_max")


# --- torque ----------------------------------------------------------------------------------------------------------


def brute_torque(before: float, share: float = 1.0, mass: float = MASS) -> float:
    """Torque while cutting, ``before`` the dead centre: rigid-body speeds by differences, no formula of the plugin."""
    step = 1e-5
    down, here, up = (travel(-before + d) for d in (-step, 0.0, step))
    rate, bend = (up - down) / (2 * step), (up - 2 * here + down) / step**2
    tilt = np.arcsin(R / ROD * np.sin(before))
    turn = (np.arcsin(R / ROD * np.sin(before + step)) - np.arcsin(R / ROD * np.sin(before - step))) / (2 * step)
    arm = 0.1 * (0.06 * abs(turn) + 0.0475 * abs(1 - turn) / np.cos(tilt) + 0.05025)
    force = FORCE * (1 - here / (BOARD + STRETCH)) - mass * bend * OMEGA**2
    return float(force * (-rate * share + arm))


def test_an_inertia_force_above_the_cutting_force_is_told_and_friction_stays_a_resistance() -> None:
    calc = platen(platen_mass=2e6)
    inertia = number(calc, "inertia_dead_center")
    assert inertia > FORCE and statuses(calc)["inertia"] == "fail"
    assert number(calc, "torque_dead_center") == pytest.approx(
        (inertia - FORCE) * number(calc, "friction_arm"), rel=1e-12
    )
    assert statuses(platen())["inertia"] == "pass"


def test_a_greatest_torque_at_the_dead_centre_lies_no_turn_before_it() -> None:
    """A drive so stiff and a board so thin that the inertia force takes more than the arm before the dead centre gives."""
    calc = platen(platen_mass=1e5, drive_deformation=0.01, material_thickness=0.01)
    assert number(calc, "torque_max") == pytest.approx(FORCE * number(calc, "friction_arm"), rel=1e-9)
    assert number(calc, "torque_max_angle") == 0


def test_the_torque_while_cutting_and_its_peak_are_those_of_brute_force() -> None:
    calc = platen()
    angles = np.linspace(1e-3, 0.999, 400) * number(calc, "cutting_start_angle")
    expected = np.array([brute_torque(float(before)) for before in angles])
    np.testing.assert_allclose(at(calc, "torque", -angles), expected, atol=2e-5 * expected.max())
    best = int(np.argmax(expected))
    assert number(calc, "torque_max") == pytest.approx(expected[best], rel=2e-5)
    assert number(calc, "torque_max_angle") == pytest.approx(angles[best], abs=5e-4)
    printed = np.array([brute_torque(float(before), BOARD / (BOARD + STRETCH)) for before in angles])
    assert number(calc, "torque_max_source") == pytest.approx(printed.max(), rel=2e-5)
    assert number(calc, "torque_max_source_angle") == pytest.approx(angles[int(np.argmax(printed))], abs=5e-4)


def test_power_at_every_angle_goes_into_board_rods_platen_and_friction() -> None:
    """Virtual work: M·ω is the power of the cutting force on the platen, of stretch, of inertia and of friction.

    The rods carry the guides' friction; beside what slides at the true speed stands its share in their stretch: the ideal speed.
    """
    calc = platen(**GUIDED, **FRICTIONS)
    phi = smooth(calc)
    stiffness = FORCE / STRETCH
    force, arm = at(calc, "elastic_force", phi), at(calc, "joint_arm", phi)
    strain = slope(calc, "rod_stretch", phi) * at(calc, "rod_stretch", phi) * stiffness
    cutting = np.where(phi > pi, -at(calc, "platen_velocity_true", phi) / OMEGA * force, 0)
    moving = np.abs(at(calc, "platen_velocity_true", phi)) > 0
    kinetic = np.where(
        moving, MASS * at(calc, "platen_acceleration", phi) * at(calc, "platen_velocity_ideal", phi) / OMEGA, 0
    )
    sliding = np.where(moving, np.abs(at(calc, "platen_velocity_ideal", phi)), 0) / OMEGA
    press = np.abs(at(calc, "force", phi) * 0.005 - MASS * 9.80665 * 0.02) * 2 / 0.4
    friction = np.abs(at(calc, "force", phi)) * arm + 0.15 * press * sliding
    np.testing.assert_allclose(
        at(calc, "torque", phi), cutting + strain + kinetic + friction, atol=1e-6 * number(calc, "torque_max")
    )


@pytest.mark.parametrize(
    "changes", [{}, GUIDED | FRICTIONS, {"cycles_per_hour": 9000}, {"material_thickness": "3 mm"}, {"friction": 0}]
)
def test_the_torque_over_a_cycle_is_spent_on_the_board_on_friction_and_on_setting_the_platen_moving(
    changes: dict[str, Any],
) -> None:
    calc = platen(**changes)
    edges = calc.domains["crank_angle"].edges[0]
    pieces = [(a + 1e-13, b - 1e-13) for a, b in pairwise(edges) if b - a > 1e-9]
    work, friction = (
        sum(
            quad(lambda x, c=curve: float(at(calc, c, x)[0]), a, b, epsabs=1e-10, epsrel=1e-11, limit=200)[0]
            for a, b in pieces
        )
        for curve in ("torque", "torque_friction")
    )
    board = FORCE / 2 * number(calc, "material_thickness")
    step = 1e-6
    release = number(calc, "dwell_end_angle")
    start = (travel(release + step) - travel(release - step)) / (2 * step) * number(calc, "crank_speed")
    assert work + MASS * start**2 / 2 == pytest.approx(board + friction, rel=1e-8)
    assert number(calc, "work_per_cycle") == pytest.approx(board + friction, rel=1e-9)
    assert number(calc, "friction_work") == pytest.approx(friction, rel=1e-9, abs=1e-12)
    assert number(calc, "power_mean") == pytest.approx(
        (board + friction) * number(calc, "crank_speed") / (2 * pi), rel=1e-9
    )
    assert number(calc, "energy_residual") < 1e-9


@given(stretch=st.floats(0.05, 5), board=st.floats(0.05, 5), rod=st.floats(130, 2000), force=st.floats(1, 5000),
       frictions=st.lists(st.floats(0.005, 0.5), min_size=4, max_size=4), rate=st.floats(10, 9000))  # fmt: skip
@examples(60)
def test_any_machine_keeps_energy_and_its_least_return_arm_is_that_of_the_whole_dwell(
    stretch: float, board: float, rod: float, force: float, frictions: list[float], rate: float
) -> None:
    calc = platen(drive_deformation=stretch, material_thickness=board, rod_length=rod, cutting_force_max=force, friction=frictions,
                  cycles_per_hour=rate)  # fmt: skip
    assert number(calc, "energy_residual") < 1e-8
    after = np.linspace(0, number(calc, "dwell_end_angle"), 2001)
    pin, stands = R * np.exp(1j * (pi - after)), rod / 1e3 - R + stretch / 1e3
    passes = np.abs(np.imag(np.conj(stands - pin) * pin)) / np.abs(
        stands - pin
    )  # distance of the rods' line from the shaft
    least = (number(calc, "friction_arm") - passes).min()
    assert number(calc, "return_arm_min") == pytest.approx(least, abs=1e-9)
    found = statuses(calc)["torque_sign"]
    assert found == ("pass" if least > 1e-12 else "fail")


def test_the_torque_of_the_relaxing_rods_touches_zero_at_both_limits() -> None:
    calc = platen()
    for change in (
        {"friction": number(calc, "friction_limit")},
        {"drive_deformation": number(calc, "deformation_limit") * 1e3},
    ):
        assert number(platen(**change), "return_arm_min") == pytest.approx(0, abs=1e-12)
    beyond = platen(drive_deformation=0.6)
    after = np.linspace(0.01, 0.99, 99) * number(beyond, "dwell_end_angle")
    assert (
        at(beyond, "torque", after).min()
        < 0
        < at(calc, "torque", np.linspace(0, 0.99, 99) * number(calc, "dwell_end_angle")).min()
    )


# --- checks, figures, contract ---------------------------------------------------------------------------------------


def test_pins_share_the_force_and_are_checked() -> None:
    lengths = {"journal_length": "120 mm", "crank_pin_length": "110 mm", "platen_pin_length": "90 mm"}
    calc = platen(**lengths, allowable_pin_pressure=23)
    assert number(calc, "crank_pin_pressure") == pytest.approx(250e3 / (0.095 * 0.11), rel=1e-12)
    assert number(calc, "journal_pressure") == pytest.approx(250e3 / (0.1005 * 0.12), rel=1e-12)
    assert number(calc, "platen_pin_pressure") == pytest.approx(250e3 / (0.12 * 0.09), rel=1e-12)
    found = {name: check.status for name, check in checks(calc).items() if name.startswith("contact_stress")}
    assert found == {
        "contact_stress_journal": "pass",
        "contact_stress_crank_pin": "fail",
        "contact_stress_platen_pin": "fail",
    }


def test_the_torque_is_held_against_what_is_allowed() -> None:
    assert statuses(platen(allowable_torque=6500))["torque_max"] == "pass"
    assert statuses(platen(allowable_torque=6300))["torque_max"] == "fail"
    assert checks(platen())["torque_max"].missing == ["allowable_torque"]


def figure(calc: Calculation, name: str) -> FigureRecord:
    """A figure of the results."""
    return next(f for f in mechanism_results(calc, {}).figures if f.id == name)


def test_the_printed_torque_stands_in_the_figure_of_the_sources_machine_alone() -> None:
    levels = [
        [level.label for level in figure(platen(**change), "source").panels[0].levels]
        for change in ({}, {"platen_mass": 300})
    ]
    assert levels == [["printed"], []]


def test_the_figure_of_forces_adds_the_friction_of_the_guides_against_the_motion() -> None:
    calc = platen(**GUIDED)
    lines = figure(calc, "forces").panels[0].lines
    phi = np.array(lines[0].x)
    added = np.array(lines[1].y) - np.array(lines[0].y)
    press = 2 * 0.1 * np.abs(at(calc, "force", phi) * 0.005 - MASS * 9.80665 * 0.02) / 0.4
    stands = (phi >= 0) & (phi < number(calc, "dwell_end_angle"))
    keep = np.abs(phi - number(calc, "dwell_end_angle")) > 1e-3
    np.testing.assert_allclose(added[keep], np.where(stands, 0, -np.sign(phi) * press)[keep], atol=1e-6)
    assert len(figure(platen(), "forces").panels[0].lines) == 1


def test_no_peak_is_marked_where_it_lies_outside_the_cut() -> None:
    panels = [figure(platen(platen_mass=m), name).panels[-1] for m in (306, 2e8) for name in ("source", "cutting")]
    assert [[mark.label for mark in panel.marks] for panel in panels] == [
        ["corrected", "eq. 14"], ["maximum"], [], []]  # fmt: skip


def test_all_figures_are_drawn_for_a_machine_of_other_proportions() -> None:
    calc = platen(rod_length="130 mm", material_thickness="40 mm", drive_deformation="20 mm", friction=0)
    names = [f.id for f in mechanism_results(calc, {}).figures]
    assert names == ["machine", "cutting", "forces", "source", "thickness", "relaxed", "turn"]


def test_the_figure_over_the_thickness_has_the_peaks_of_single_machines() -> None:
    lines = figure(platen(), "thickness").panels[0].lines
    for i in (0, 40, 92):
        single = platen(material_thickness=lines[0].x[i] * 1e3)
        assert lines[0].y[i] == pytest.approx(number(single, "torque_max"), rel=1e-9)
        assert lines[1].y[i] == pytest.approx(number(single, "torque_max_source"), rel=1e-9)


def test_the_example_is_the_sources_machine() -> None:
    example = next(path for path in EXAMPLES if path.name == "platen_press_zppt30.yaml")
    found = Press.read(example, Discovery([])).calculate().results
    assert found.status != "fail"
    kinds = {name: each.kind for name, each in found.mechanisms.items()}
    assert kinds == {"platen": "platen_press", "crank": "shaft", "platen_pin": "shaft", "wheel_key": "parallel_key"}
    outputs = found.mechanisms["platen"].outputs
    assert outputs["torque_max"].value == number(platen(), "torque_max")
    assert degrees(outputs["torque_max_angle"].value) == pytest.approx(3.12, abs=5e-3)


def test_a_number_half_way_between_two_is_rounded_alike_as_a_result_and_within_a_formula() -> None:
    steps = {item.id: item for part in mechanism_results(platen(), {}).sections for item in part.items if item.id}
    assert steps["standing_distance"].outcome.data() == {"text": "525.5", "unit": "mm"}
    assert "'525.4'" not in str(steps["stretched_length"])


def test_a_margin_has_no_zeros_behind_what_its_sides_show() -> None:
    journal = checks(platen(journal_length="120 mm", allowable_pin_pressure=30))["contact_stress_journal"]
    assert journal.margin_display == ShownRecord(text="9.27", unit="MPa")


# --- crank, rods and pins as elements ----------------------------------------------------------------------------------


def test_one_rods_force_on_its_crank_pin_has_half_the_useful_torque_about_the_shaft() -> None:
    calc = platen()
    phi = smooth(calc)
    along, across = at(calc, "crank_pin_force_x", phi), at(calc, "crank_pin_force_y", phi)
    pin = -R * np.array(
        [np.cos(phi), np.sin(phi)]
    )  # about the shaft, x towards the platen: at 0 crank and rods are folded
    about = pin[0] * across - pin[1] * along
    moving = (
        np.abs(at(calc, "platen_velocity_true", phi)) > 0
    )  # where the platen stands the stretched rods stand at another angle
    assert about[moving] == pytest.approx(-at(calc, "torque_useful", phi)[moving] / 2, abs=1e-6)
    assert 0 < np.abs(about + at(calc, "torque_useful", phi) / 2)[~moving].max() < 1  # N·m
    assert at(calc, "crank_pin_torque", phi) == pytest.approx(-at(calc, "torque", phi) / 2, rel=1e-12)


def test_rods_are_judged_by_their_least_section() -> None:
    calc = platen(rod_net_area=3000, allowable_rod_stress=80)
    assert number(calc, "rod_stress") == pytest.approx(5e5 / (2 * 3e-3), rel=1e-12)
    failed = advised(calc)["rod_stress"]
    assert failed.status == "fail" and "rod_net_area to at least 3125 mm²" in failed.message
    assert statuses(platen(rod_net_area=3125, allowable_rod_stress=80))["rod_stress"] == "pass"


def pins(phi: float, stands: float | None) -> tuple[complex, complex]:
    """Crank pin and platen's pin; the platen stands at a place, or follows rods of their own length."""
    crank = R * np.exp(1j * (np.pi - phi))
    return crank, complex(crank.real + np.sqrt(ROD**2 - crank.imag**2)) if stands is None else complex(stands)


def angles(calc: Calculation) -> list[float]:
    """Crank angles while cutting and in free travel."""
    begin, end = number(calc, "dwell_end_angle"), 2 * np.pi
    return [float(phi) for phi in np.linspace(begin + 1e-3, end - 1e-6, 181)]


def test_what_the_rods_take_up_they_give_back() -> None:
    calc = platen(platen_mass=0)
    useful = [quad(lambda x: float(at(calc, "torque_useful", x)[0]), *ends, epsabs=1e-10)[0]
              for ends in ((1e-13, number(calc, "dwell_end_angle")), (number(calc, "cutting_begin"), 2 * pi - 1e-13))]  # fmt: skip
    assert useful == pytest.approx([-112.5, 237.5], rel=1e-8)
    assert number(calc, "strain_energy") == pytest.approx(112.5, rel=1e-12)


@pytest.mark.parametrize("rate, guided", [(1200, {}), (30_000, {}), (1200, GUIDED)])
def test_the_moving_platens_torque_is_that_of_equilibrium(rate: float, guided: dict[str, str]) -> None:
    """The rods carry the guides' friction too; the joints' own friction follows the force without it."""
    calc = platen(cycles_per_hour=rate, **guided)
    for phi in angles(calc):
        force = float(at(calc, "force", phi)[0])
        couple = force * 0.005 - 306 * 9.80665 * 0.02
        slide = -np.sign(np.sin(phi)) * 2 * FRICTION * abs(couple) / 0.4 if guided else 0.0
        tilt = np.arcsin(R / ROD * np.sin(phi))
        size = FRICTION * abs(force)
        moments = (size * RADII[0], size * RADII[1] / np.cos(tilt), size * RADII[2])
        expected = balance(phi, force + slide, moments)
        assert at(calc, "torque", phi)[0] == pytest.approx(expected, rel=1e-7, abs=1e-7 * (abs(force) + abs(slide)) * R)


def test_the_relaxing_rods_torque_is_that_of_equilibrium() -> None:
    """Against the friction of the dead centre, whose arm the relaxing phase keeps: out by the square of a few degrees."""
    calc = platen()
    stands = ROD - R + 4.5e-4
    for phi in np.linspace(1e-4, 0.999, 50) * number(calc, "dwell_end_angle"):
        a, b = pins(float(phi), stands)
        rods = (abs(b - a) - ROD) * 5e5 / 4.5e-4
        along = rods * (b - a).real / abs(b - a)
        frictionless = balance(float(phi), along, (0.0, 0.0, 0.0), stands)
        assert at(calc, "torque_useful", phi)[0] == pytest.approx(frictionless, rel=1e-9, abs=1e-6)
        moments = tuple(FRICTION * rods * radius for radius in RADII)
        expected = balance(float(phi), along, moments, stands)  # type: ignore[arg-type]
        assert at(calc, "torque", phi)[0] == pytest.approx(expected, abs=1e-3 * 5e5 * number(calc, "friction_arm"))


def test_friction_circles_give_the_same_torque_but_for_the_square_of_friction() -> None:
    """Exact joints: the rod's line of force touches the friction circles of both pins; the crank's reaction that of the journal."""
    differences = []
    for friction in (0.1, 0.05):
        calc = platen(friction=friction)
        phi = 2 * np.pi - number(calc, "torque_max_angle")
        a, b = pins(phi, None)
        force = float(at(calc, "force", phi)[0])
        sine = friction / np.sqrt(1 + friction**2)
        at_b, at_a, at_o = (radius * sine for radius in RADII)
        rod = turned(phi, None)
        # the line of force touches the circles of both pins on the sides that resist the turning of rod and crank
        line = np.angle(b - a) + np.arcsin((at_b * np.sign(rod) + at_a * np.sign(rod + 1)) / abs(b - a))
        pull = force / np.cos(line)
        torque = pull * (np.imag(np.conj(a) * np.exp(1j * line)) + at_a * np.sign(rod + 1) + at_o)
        differences.append(abs(torque - number(calc, "torque_max")) / number(calc, "torque_max"))
    assert differences[0] < 0.005
    assert differences[1] / differences[0] == pytest.approx(0.25, abs=0.1)
