"""The Geneva drive against vector loops, finite differences, energy, virtual work and the bare geometry of the drawn parts."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import brentq

from diecut_report.config.plugins import Discovery
from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.steps.run import calculate
from diecut_report.plugins.geneva_transport import MECHANISM
from diecut_report.plugins.geneva_transport.figures import disc_outline, wheel_outline
from diecut_report.press import Press
from diecut_report.results.figure_views import MachineView
from diecut_report.results.mechanism import mechanism_results
from tests.configs import HEAD, saved
from tests.examples import examples, few
from tests.machines import advised, at, checks, inputs, number

CROSS: dict[str, Any] = {"slots": 6, "center_distance": "200 mm", "crank_speed": "100 rpm", "roller_radius": "10 mm"}
SHEET: dict[str, Any] = {"sprocket_teeth": 24, "chain_pitch": "31.75 mm", "gear_ratio": 4}
OMEGA = 100 * 2 * np.pi / 60
SLOTS = (3, 4, 5, 6, 8, 12, 18)


def geneva(**changes: Any) -> Calculation:
    """The Geneva drive of the conformance case with changes."""
    return calculate(MECHANISM, inputs(MECHANISM, CROSS | changes))


@cache
def with_slots(slots: int) -> Calculation:
    """A drive with so many slots, inertia and conveyor, and a roller that fits."""
    return geneva(slots=slots, roller_radius="3 mm", driven_inertia=0.8, locking_clearance=0, **SHEET)


def engaged(calc: Calculation, points: int = 2001, inside: float = 1 - 1e-9) -> Array:
    """Crank angles of the engagement."""
    half = number(calc, "engagement_half_angle") * inside
    return np.linspace(-half, half, points)


def wheel_from_middle(calc: Calculation, alpha: Array) -> Array:
    """Angle of the wheel, counted from the middle of the same motion for angles before it too."""
    return at(calc, "wheel_angle", alpha) - np.where(alpha < 0, number(calc, "step_angle"), 0)


# --- losses behind the wheel ---


def test_the_gear_behind_the_wheel_takes_its_losses_where_the_roller_drives_and_where_it_brakes() -> None:
    free, lossy = geneva(driven_inertia=4), geneva(driven_inertia=4, own_inertia=1, efficiency=0.9)
    alpha = engaged(free)
    wanted = np.where(alpha < 0, 1 + 3 / 0.9, 1 + 3 * 0.9) / 4
    for name in ("torque", "roller_force"):
        assert at(lossy, name, alpha) == pytest.approx(at(free, name, alpha) * wanted, rel=1e-9)
    assert number(lossy, "energy_residual") < 1e-6
    energy = number(lossy, "energy_turn")
    assert energy == pytest.approx(number(free, "kinetic_energy_max") * 3 / 4 * (1 / 0.9 - 0.9), rel=1e-6)


def test_the_wheel_has_no_more_inertia_than_all_that_it_moves() -> None:
    with pytest.raises(Impossible, match="is more than driven_inertia"):
        geneva(driven_inertia=1, own_inertia=2)


# --- motion ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("slots", SLOTS)
def test_the_roller_lies_in_the_slot_the_vector_loop_closes(slots: int) -> None:
    calc = with_slots(slots)
    alpha = engaged(calc)
    psi, distance = wheel_from_middle(calc, alpha), at(calc, "roller_distance", alpha)
    roller = 0.2 * np.sin(np.pi / slots) * np.exp(1j * alpha)
    np.testing.assert_allclose(0.2 + distance * np.exp(1j * (np.pi - psi)), roller, atol=1e-15)


@pytest.mark.parametrize("slots", SLOTS)
def test_speed_and_acceleration_are_the_derivatives_of_the_angle(slots: int) -> None:
    calc = with_slots(slots)
    alpha = engaged(calc, 20_001)
    step = alpha[1] - alpha[0]
    psi, speed, acceleration = (
        wheel_from_middle(calc, alpha),
        at(calc, "wheel_speed", alpha),
        at(calc, "wheel_acceleration", alpha),
    )
    np.testing.assert_allclose((psi[2:] - psi[:-2]) / (2 * step) * OMEGA, speed[1:-1], atol=1e-5 * speed.max())
    np.testing.assert_allclose(
        (speed[2:] - speed[:-2]) / (2 * step) * OMEGA, acceleration[1:-1], atol=1e-5 * acceleration.max()
    )


@pytest.mark.parametrize("slots", SLOTS)
def test_the_wheel_makes_one_step_a_turn_and_rests_between(slots: int) -> None:
    calc = with_slots(slots)
    half = np.pi / 2 - np.pi / slots
    dwell = np.linspace(half, 2 * np.pi - half, 301)[1:-1]
    assert at(calc, "wheel_angle", dwell) == pytest.approx(np.full(299, np.pi / slots), rel=1e-14)
    assert not at(calc, "wheel_speed", dwell).any() and not at(calc, "wheel_acceleration", dwell).any()
    before, after = at(calc, "wheel_angle", np.array([0.0, 2 * np.pi - 1e-9]))
    assert after - before == pytest.approx(2 * np.pi / slots, abs=1e-7)
    edges = np.array([half - 1e-9, half + 1e-9, 2 * np.pi - half - 1e-9, 2 * np.pi - half + 1e-9])
    assert at(calc, "wheel_angle", edges) == pytest.approx(np.full(4, np.pi / slots), abs=1e-8)


@given(slots=st.integers(3, 18), distance=st.floats(50, 900), share=st.floats(0.02, 0.1))
def test_peaks_shares_and_sizes_for_any_number_of_slots(slots: int, distance: float, share: float) -> None:
    calc = geneva(slots=slots, center_distance=distance, roller_radius=distance * share)
    ratio = np.sin(np.pi / slots)
    alpha = np.linspace(-1, 1, 40_001) * (np.pi / 2 - np.pi / slots)
    psi = np.angle(1 - ratio * np.exp(-1j * alpha))
    slope = np.gradient(psi, alpha)
    found = {name: number(calc, name) for name in ("speed_ratio_peak", "acceleration_peak", "acceleration_peak_angle")}
    assert found["speed_ratio_peak"] == pytest.approx(slope.max(), rel=1e-5)
    bend = (ratio * (ratio**2 - 1) * np.sin(alpha)) / abs(1 - ratio * np.exp(1j * alpha)) ** 4
    assert found["acceleration_peak"] == pytest.approx(bend.max(), rel=1e-6)
    assert np.gradient(slope, alpha)[2:-2].max() == pytest.approx(bend.max(), rel=1e-3)
    assert found["acceleration_peak_angle"] == pytest.approx(-alpha[np.argmax(bend)], abs=1e-4)
    assert number(calc, "acceleration_peak_at") == pytest.approx(2 * np.pi - found["acceleration_peak_angle"], abs=1e-6)
    assert number(calc, "motion_fraction") + number(calc, "dwell_fraction") == pytest.approx(1, rel=1e-15)
    assert number(calc, "time_motion") + number(calc, "time_dwell") == pytest.approx(0.6, rel=1e-14)
    assert number(calc, "motion_fraction") == pytest.approx(2 * alpha[-1] / (2 * np.pi), rel=1e-12)
    assert number(calc, "slot_length") + number(calc, "nearest_distance") == pytest.approx(
        number(calc, "wheel_radius") + number(calc, "roller_radius"), rel=1e-12
    )


def test_the_sheet_follows_the_wheel_through_gear_and_sprocket() -> None:
    calc = geneva(**SHEET)
    alpha = engaged(calc, 501)
    radius = 24 * 0.03175 / (2 * np.pi) * 4  # of the sprocket's pitch line, for each radian of the wheel
    assert number(calc, "sheet_step") == pytest.approx(radius * np.pi / 3, rel=1e-14)
    for of_sheet, of_wheel in (
        ("sheet_position", "wheel_angle"),
        ("sheet_velocity", "wheel_speed"),
        ("sheet_acceleration", "wheel_acceleration"),
    ):
        np.testing.assert_allclose(
            at(calc, of_sheet, alpha), radius * at(calc, of_wheel, alpha), rtol=1e-13, atol=1e-12
        )
    assert number(calc, "sheet_velocity_max") == pytest.approx(at(calc, "sheet_velocity", alpha).max(), rel=1e-12)
    assert number(calc, "sheet_acceleration_max") == pytest.approx(
        at(calc, "sheet_acceleration", alpha).max(), rel=1e-4
    )
    assert number(calc, "sheet_acceleration_entry") == pytest.approx(
        at(calc, "sheet_acceleration", alpha[:1])[0], rel=1e-7
    )


# --- torque and forces -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("slots", SLOTS)
def test_the_torque_is_the_rate_of_the_wheels_energy_and_none_is_left_after_a_turn(slots: int) -> None:
    calc = with_slots(slots)
    alpha = engaged(calc, 20_001)
    energy, torque = 0.8 * at(calc, "wheel_speed", alpha) ** 2 / 2, at(calc, "torque", alpha)
    np.testing.assert_allclose(np.gradient(energy, alpha)[1:-1], torque[1:-1], atol=1e-5 * torque.max())
    work = np.sum((torque[1:] + torque[:-1]) / 2) * (alpha[1] - alpha[0])
    assert work == pytest.approx(0, abs=1e-9 * energy.max())
    assert number(calc, "kinetic_energy_max") == pytest.approx(energy.max(), rel=1e-9)
    assert number(calc, "energy_residual") < 1e-12
    assert number(calc, "torque_peak") == pytest.approx(torque.max(), rel=1e-6)


@pytest.mark.parametrize("slots", SLOTS)
def test_the_roller_force_turns_the_wheel_and_loads_the_crank(slots: int) -> None:
    """Equilibrium of the wheel about its axis and of the crank about its own, from the force as a vector square to the slot."""
    calc = with_slots(slots)
    alpha = engaged(calc, 501)
    psi, force = wheel_from_middle(calc, alpha), at(calc, "roller_force", alpha)
    roller = 0.2 * np.sin(np.pi / slots) * np.exp(1j * alpha)
    on_wheel = force * np.exp(
        1j * (np.pi / 2 - psi)
    )  # square to the slot, the way the wheel turns: clockwise about (C, 0)
    about_wheel = np.imag(np.conj(roller - 0.2) * on_wheel)
    np.testing.assert_allclose(
        -about_wheel, 0.8 * at(calc, "wheel_acceleration", alpha), atol=1e-9 * abs(about_wheel).max()
    )
    needed = np.imag(np.conj(roller) * on_wheel)  # what the crank's motor gives against the reaction −on_wheel
    torque = at(calc, "torque", alpha)
    np.testing.assert_allclose(needed, torque, atol=1e-9 * torque.max())
    assert number(calc, "roller_force_peak") == pytest.approx(force.max(), rel=1e-4)
    assert number(calc, "roller_force_peak") >= force.max() * (1 - 1e-12)


def test_the_contact_pressure_is_that_of_a_cylinder_on_a_plane() -> None:
    calc = geneva(driven_inertia=4, roller_width="24 mm", allowable_contact_pressure="1200 MPa")
    load = number(calc, "roller_force_peak") / 0.024
    assert number(calc, "contact_pressure") == pytest.approx(
        0.591 * np.sqrt(load * 210e9 / 0.02), rel=1e-3
    )  # Roark, ν = 0.3
    share = (number(calc, "contact_pressure") / 1.2e9) ** 2
    assert number(calc, "roller_width_min") == pytest.approx(0.024 * share, rel=1e-12)


# --- what cannot be, and checks --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "changes, key, words",
    [
        ({"roller_radius": "101 mm"}, "roller_radius", "crank radius C·sin(π/z) = 100"),
        ({"slots": 3, "roller_radius": "30 mm"}, "roller_radius", "26.79 mm"),
        ({"locking_radius": "120 mm"}, "locking_radius", "crank radius"),
        ({"locking_clearance": "70 mm"}, "locking_clearance", "arc's radius 70 mm"),
    ],
)
def test_an_impossible_drive_is_refused_in_words(changes: dict[str, Any], key: str, words: str) -> None:
    with pytest.raises(Impossible) as refused:
        geneva(**changes)
    assert refused.value.key == key
    assert words in refused.value.message


@pytest.mark.parametrize(
    "changes, name, words",
    [
        ({"roller_radius": "51 mm"}, "roller_clearance", "the wall between them is -2 mm"),
        ({"locking_radius": "95 mm"}, "arm_thickness", "90 mm"),
        ({"locking_radius": "20 mm"}, "locking_reach", "26.51 mm"),
        (SHEET | {"allowable_sheet_acceleration": 50}, "sheet_acceleration", "set slots to"),
        (
            {"driven_inertia": 4, "roller_width": "5 mm", "allowable_contact_pressure": 1200},
            "contact_pressure",
            "Set roller_width to at least",
        ),
        ({"slots": 12, "roller_radius": "13 mm"}, "cutout", "Set locking_radius to"),
    ],
)
def test_a_check_fails_in_words_that_tell_what_to_change(changes: dict[str, Any], name: str, words: str) -> None:
    found = advised(geneva(**changes))
    assert found[name].status == "fail"
    assert words in found[name].message.replace("−", "-")


def test_all_checks_pass_where_the_drive_is_sound() -> None:
    everything = {
        "driven_inertia": 4,
        "roller_width": "24 mm",
        "allowable_contact_pressure": 1200,
        "allowable_sheet_acceleration": 80,
    }
    found = checks(geneva(**SHEET, **everything))
    assert set(found) == {
        "roller_clearance",
        "arm_thickness",
        "locking_reach",
        "cutout",
        "grippers",
        "sheet_acceleration",
        "contact_pressure",
        "torque",
        "sheet_play",
        "energy_balance",
    }
    assert {name for name, check in found.items() if check.status != "pass"} == {"torque", "sheet_play", "grippers"}
    assert {check.status for check in found.values()} == {"pass", "not_checked"}


@pytest.mark.nightly
def test_the_figures_are_drawn_even_where_nothing_holds_the_wheel() -> None:
    for changes in (
        {"locking_radius": "20 mm"},
        {"locking_radius": "95 mm"},
        {"roller_radius": "60 mm"},
        {"slots": 18, "roller_radius": "30 mm"},
    ):
        shapes = mechanism_results(geneva(**changes), {}).figures
        assert [figure.id for figure in shapes] == ["entry", "positions", "motion"]


def test_the_crank_makes_a_turn_for_each_sheet_of_the_press(tmp_path: Path) -> None:
    config = saved(tmp_path, HEAD + "  g: {kind: geneva_transport, center_distance: 200 mm, roller_radius: 10 mm}\n")
    found = Press.read(config, Discovery([])).calculate().results.mechanisms["g"]
    assert found.inputs["crank_speed"].value == pytest.approx(2 * np.pi * 6000 / 3600, rel=1e-14)
    assert found.outputs["time_dwell"].value == pytest.approx(0.4, rel=1e-14)


@pytest.mark.parametrize("slots, roller", [(3, 0.02), (4, 0.03), (6, 0.012), (6, 0.06), (9, 0.03), (18, 0.02)])
def test_the_wall_between_slots_is_that_of_their_outlines(slots: int, roller: float) -> None:
    calc = geneva(slots=slots, roller_radius=f"{roller} m")
    inner, mouth = 0.2 * (1 - np.sin(np.pi / slots)), 0.2 * np.cos(np.pi / slots)
    middles = np.linspace(inner, mouth, 4001)  # the slot is what a roller sweeps whose middle goes along this line
    turned = middles * np.exp(2j * np.pi / slots)
    nearest = min(abs(turned[i : i + 200, None] - middles[None, :]).min() for i in range(0, 4001, 200))
    assert number(calc, "roller_clearance") == pytest.approx(nearest - 2 * roller, abs=1e-12)


@pytest.mark.parametrize("slots, roller", [(3, 10), (4, 12), (6, 12), (6, 24), (8, 10), (18, 6)])
def test_arms_are_as_thick_as_the_drawn_wheels(slots: int, roller: float) -> None:
    calc = geneva(slots=slots, roller_radius=roller)
    outline = np.array(wheel_outline(MachineView(calc), np.pi / slots)) @ [1, 1j]  # in the dwell
    radius, rim = number(calc, "locking_radius"), number(calc, "rim_radius")
    on_arc = outline[abs(abs(outline) - radius) < 1e-9]
    assert len(on_arc) >= 41 and min(abs(outline)) == pytest.approx(radius, rel=1e-9)
    on_rim = outline[abs(abs(outline - 0.2) - rim) < 1e-9]
    mouth = 0.2 + 0.2 * np.cos(np.pi / slots) * np.exp(1j * (np.pi - np.pi / slots))
    corner = on_rim[
        np.argmin(abs(on_rim - mouth) + 1e3 * (abs(on_rim) > abs(mouth)))
    ]  # the slot's corner next to the disc
    assert abs(corner - mouth) == pytest.approx(roller / 1e3, rel=1e-9)
    assert abs(corner) - radius == pytest.approx(number(calc, "arm_tip"), abs=1e-12)
    deepest = on_arc[np.argmin(abs(on_arc - 0.2))]
    flank = abs(np.imag((deepest - 0.2) * np.exp(-1j * (np.pi - np.pi / slots)))) - roller / 1e3
    assert 2 * flank == pytest.approx(number(calc, "arm_neck"), abs=1e-12)


def crosses(calc: Calculation, crank: float, wheel: float, depth: float = 1e-7) -> bool:
    """Whether wheel and disc overlap by more than ``depth``, judged by the points of the wheel's outline."""
    view = MachineView(calc)
    points = np.array(wheel_outline(view, wheel)) @ [1, 1j] * np.exp(-1j * crank)
    in_disc = abs(points) < number(calc, "disc_radius") - depth
    return bool(
        np.any(in_disc & (abs(points - number(calc, "relief_distance")) > number(calc, "relief_radius") + depth))
    )


def meets(calc: Calculation) -> bool:
    """Whether wheel and disc overlap anywhere in the engagement."""
    alpha = engaged(calc, 181)
    return any(crosses(calc, a, psi) for a, psi in zip(alpha, wheel_from_middle(calc, alpha), strict=True))


@pytest.mark.parametrize("slots", few(SLOTS, keep=lambda slots: slots in (3, 6, 18)))
def test_the_cut_out_lets_the_arms_pass_through_the_whole_engagement(slots: int) -> None:
    calc = with_slots(slots)
    assert number(calc, "cutout_gap") == pytest.approx(0, abs=1e-12)
    assert not meets(calc)


@pytest.mark.parametrize(
    "slots, roller, locking",
    [
        (6, 36, 36),
        (12, 13, None),
        (12, 13, 29),
        (18, 5, 24),
        *few([(6, 24, None), (8, 26, 32), (16, 5, 12), (18, 7, None), (4, 30, 70)], keep=lambda _: False),
    ],
)
def test_tips_that_meet_the_disc_are_found_as_by_turning_the_drawn_parts(
    slots: int, roller: float, locking: float | None
) -> None:
    changes = {} if locking is None else {"locking_radius": locking}
    calc = geneva(slots=slots, roller_radius=roller, locking_clearance=0, **changes)
    assert meets(calc) == (number(calc, "cutout_gap") < -1e-7)


@pytest.mark.parametrize("slots", SLOTS)
def test_the_disc_holds_up_to_the_entry_and_frees_the_wheel_there(slots: int) -> None:
    calc = with_slots(slots)
    half, rest, nudge = np.pi / 2 - np.pi / slots, np.pi / slots, 0.01
    hold = number(calc, "hold_half_angle")
    for crank in (half + hold, np.pi, 2 * np.pi - half - hold):
        assert not crosses(calc, crank, rest)
        assert crosses(calc, crank, rest + nudge) and crosses(calc, crank, rest - nudge)
    early, late = 2 * np.pi - half - 0.25 * hold, 2 * np.pi - half + 1e-6
    assert crosses(calc, early, rest + nudge)
    assert not crosses(calc, late, rest + 1e-5, depth=1e-9)


def test_the_disc_is_the_turn_without_the_cut_out_and_the_hollow_closes_it() -> None:
    calc = geneva()
    outline = np.array(disc_outline(MachineView(calc), 0.0)) @ [1, 1j]
    arc = outline[abs(abs(outline) - number(calc, "disc_radius")) < 1e-12]
    angles = np.unwrap(np.angle(arc))
    assert angles[-1] - angles[0] == pytest.approx(number(calc, "locking_arc_angle"), rel=1e-12)
    assert number(calc, "locking_arc_angle") == pytest.approx(np.radians(240), rel=1e-12)
    hollow = outline[len(arc) :]
    assert abs(hollow - number(calc, "relief_distance")) == pytest.approx(
        np.full(len(hollow), number(calc, "relief_radius")), rel=1e-12
    )
    assert abs(hollow[0] - arc[-1]) < 0.01 and abs(hollow[-1] - arc[0]) < 0.01


def turned_until_it_touches(calc: Calculation, cover: float, way: int) -> float:
    """Angle by which the wheel turns until its locking arc meets one of many points of the disc's arc."""
    center, radius = number(calc, "center_distance"), number(calc, "locking_radius")
    hold = number(calc, "hold_half_angle")
    disc = number(calc, "disc_radius") * np.exp(1j * np.linspace(-hold, min(cover, hold), 20_001))
    return float(
        brentq(lambda turn: abs(disc - center * (1 - np.exp(1j * way * turn))).max() - radius, 0, 0.3, xtol=1e-15)
    )


@pytest.mark.parametrize("clearance", [0.02, 0.1, 0.3])
@pytest.mark.parametrize("cover", [2.0, 10.98, 30.0, 90.0])
def test_the_play_is_that_of_the_disc_that_covers_its_arc_on_one_side_in_part(clearance: float, cover: float) -> None:
    calc = geneva(locking_clearance=f"{clearance} mm", cover_angle=cover, **SHEET)
    play = max(turned_until_it_touches(calc, np.radians(cover), way) for way in (1, -1))
    assert number(calc, "locking_play") == pytest.approx(play, rel=1e-6)
    assert number(calc, "sheet_play") == pytest.approx(play * 24 * 0.03175 * 4 / (2 * np.pi), rel=1e-6)


def test_the_usual_proportions_of_stop_arc_and_clearance_arc() -> None:
    """A worked example of the usual shop rules: six slots, wheel radius 55, pin 4, clearance 0.1 (all mm)."""
    calc = geneva(center_distance=float(55 / np.cos(np.pi / 6)), roller_radius="2 mm", locking_clearance="0.1 mm")
    expected = {
        "crank_radius": 31.7543,
        "center_distance": 63.5085,
        "locking_radius": 25.7543,
        "disc_radius": 25.6543,
        "relief_radius": 44.4345,
    }
    for name, value in expected.items():
        assert number(calc, name) * 1e3 == pytest.approx(value, abs=5e-5)
    assert (number(calc, "slot_length") - 0.002) * 1e3 == pytest.approx(23.2457, abs=5e-5)


@examples(50)
@given(slots=st.integers(3, 18), share=st.floats(0.001, 0.999))
def test_the_default_locking_arc_lies_between_rim_and_slots_wherever_there_is_room(slots: int, share: float) -> None:
    ratio = np.sin(np.pi / slots)
    calc = geneva(slots=slots, roller_radius=200 * min(ratio / 2, 1 - ratio) * share, locking_clearance=0)
    rim, locking, flank = (number(calc, name) for name in ("rim_distance", "locking_radius", "flank_distance"))
    if rim < flank:
        assert rim < locking < flank
        assert 0 < number(calc, "hold_half_angle") < number(calc, "engagement_half_angle")
    else:
        assert np.isnan(calc["hold_half_angle"][0, 0])


def test_a_given_locking_radius_is_taken() -> None:
    assert number(geneva(locking_radius="80 mm"), "arm_tip") == pytest.approx(0.01, rel=1e-12)


@pytest.mark.parametrize("slots", SLOTS)
def test_the_roller_enters_along_the_slot(slots: int) -> None:
    """In the resting wheel's frame the roller has no velocity across the slot at entry; its path touches the slot there."""
    half = np.pi / 2 - np.pi / slots
    radius = 0.2 * np.sin(np.pi / slots)
    slot = np.exp(1j * (np.pi + np.pi / slots))  # direction of the slot that waits for the roller
    alpha = -half + np.array([-1e-4, 0.0, 1e-4])
    across = np.imag((radius * np.exp(1j * alpha) - 0.2) / slot)
    assert across[1] == pytest.approx(0, abs=1e-15)
    assert (across[2] - across[0]) / 2e-4 == pytest.approx(0, abs=1e-8)
    calc = with_slots(slots)
    assert at(calc, "wheel_speed", engaged(calc)[:1])[0] == pytest.approx(0, abs=1e-7)
    assert at(calc, "wheel_acceleration", engaged(calc)[:1])[0] == pytest.approx(
        np.tan(np.pi / slots) * OMEGA**2, rel=1e-7
    )
