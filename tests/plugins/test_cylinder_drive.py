"""The cylinder's drive against energy, finite differences, dense sampling and virtual work."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.inputs import flatten
from diecut_report.plugins.cylinder_drive import MECHANISM
from tests.examples import examples
from tests.machines import LOSSLESS, PUBLISHED_DRIVE, UNBALANCED, drive, number


def dense(calc: Calculation, curve: str, points: int = 200_001) -> Array:
    """A curve at many places of the turn, each taken in the smooth piece that it lies in."""
    phi = np.linspace(0, 2 * np.pi, points)[None, :]
    domain = calc.domains["crank_angle"]
    return calc.sample(
        curve, phi, np.concatenate([domain.middle_of(part) for part in np.array_split(phi, 50, axis=1)], axis=1)
    )[0]


@pytest.mark.parametrize(
    "changes", [{}, UNBALANCED, UNBALANCED | {"sector_ratio": 5.0}, {"rocker_ratio": 3.0, "frame_ratio": 6}]
)
def test_a_lossless_turn_takes_the_work_of_cutting_alone(changes: dict[str, Any]) -> None:
    calc = drive(**LOSSLESS, **changes)
    torque = dense(calc, "crank_torque")
    work = np.sum((torque[1:] + torque[:-1]) / 2) * 2 * np.pi / (len(torque) - 1)
    fraction, u, swing = (number(calc, n) for n in ("cutting_arc_fraction", "sector_ratio", "swing_angle"))
    assert work == pytest.approx(2 * fraction * number(calc, "cutting_moment") * u * swing, rel=2e-4)
    assert number(calc, "energy_residual") < 1e-12


@pytest.mark.parametrize("changes", [{}, UNBALANCED])
def test_means_and_extremes_are_those_of_dense_sampling(changes: dict[str, Any]) -> None:
    calc = drive(**changes)
    torque = dense(calc, "crank_torque")
    assert number(calc, "crank_torque_max") == pytest.approx(torque.max(), rel=1e-4)
    assert number(calc, "crank_torque_min") == pytest.approx(torque.min(), rel=1e-4)
    assert number(calc, "crank_torque_max") >= torque.max() * (1 - 1e-12)
    assert number(calc, "crank_torque_mean") == pytest.approx(torque[:-1].mean(), rel=1e-3)
    assert number(calc, "crank_torque_rms") == pytest.approx(np.sqrt((torque[:-1] ** 2).mean()), rel=1e-4)


SHAFTS = {"pinion_inertia": "0.03467 kg*m**2", "rocker_inertia": "1.2606 kg*m**2", "pinion_radius": "70 mm"}


def test_the_shafts_of_pinion_and_rocker_take_what_their_kinetic_energy_gains() -> None:
    """By finite differences of the rocker's angle: the power at each place beside that without them."""
    bare, whole = drive(**LOSSLESS, pinion_radius="70 mm"), drive(**LOSSLESS, **SHAFTS)
    phi, step = np.radians([[20.0, 75.0, 131.0, 205.0, 263.0, 318.0]]), 1e-4
    domain = whole.domains["crank_angle"]

    def at(calc: Calculation, curve: str, turned: float = 0.0) -> Array:
        return calc.sample(curve, phi + turned, domain.middle_of(phi))[0]

    crank, u = number(whole, "crank_speed"), number(whole, "sector_ratio")
    before, here, behind = (at(whole, "rocker_angle", turned) for turned in (-step, 0, step))
    speed, acceleration = (behind - before) / (2 * step) * crank, (behind - 2 * here + before) / step**2 * crank**2
    energy_gain = (0.03467 * u**2 + 1.2606) * speed * acceleration  # of both shafts, in W
    assert (at(whole, "total_moment") - at(bare, "total_moment")) * speed * u == pytest.approx(energy_gain, rel=2e-4)
    assert (at(whole, "crank_torque") - at(bare, "crank_torque")) * crank == pytest.approx(energy_gain, rel=2e-4)
    assert at(whole, "cylinder_moment") == pytest.approx(at(bare, "total_moment"))  # which is what the chain carries
    pinion_gain = 0.03467 * u**2 * speed * acceleration
    tooth = (at(whole, "tooth_force") - at(bare, "tooth_force")) * 0.07 * speed * u
    assert tooth == pytest.approx(pinion_gain, rel=2e-4)
    assert number(whole, "moved_inertia") == pytest.approx(number(bare, "reduced_inertia") + 0.03467 + 1.2606 / u**2)
    assert number(whole, "kinetic_energy_max") / number(bare, "kinetic_energy_max") == pytest.approx(
        number(whole, "moved_inertia") / number(bare, "reduced_inertia")
    )


def test_inertias_of_shafts_are_given_both_or_none() -> None:
    (rule,) = MECHANISM.inputs.one_of
    assert "rocker_inertia" in rule.fault(["pinion_inertia"]) and not rule.fault(["pinion_inertia", "rocker_inertia"])
    with pytest.raises(ValidationError):
        drive(**SHAFTS | {"rocker_inertia": "-1 kg*m**2"})
    for name in ("crank_torque_peak", "kinetic_energy_max"):
        assert number(drive(pinion_inertia=0, rocker_inertia=0), name) == pytest.approx(
            number(drive(), name), rel=1e-12
        )


def test_the_peak_between_two_grid_points_wins_over_a_higher_grid_point_elsewhere() -> None:
    """Here the best point of the search grid lies at a jump, the peak inside the piece before it."""
    ratios = {"frame_ratio": 5.2421875, "coupler_ratio": 4.71875, "rocker_ratio": 2.5}
    calc = drive(**(UNBALANCED | ratios | {"cutting_arc_fraction": 0.75}))
    torque = np.abs(dense(calc, "crank_torque"))
    assert torque.max() <= number(calc, "crank_torque_peak") <= torque.max() * (1 + 1e-7)


@pytest.mark.parametrize("name", ["crank_torque_peak", "acceleration_max", "inertia_moment_max", "crank_torque_rms"])
def test_results_do_not_depend_on_the_number_of_samples(name: str) -> None:
    few, many = drive(**UNBALANCED, n_points=36), drive(**UNBALANCED, n_points=5000)
    assert number(few, name) == pytest.approx(number(many, name), rel=1e-8)


def test_velocity_and_acceleration_are_the_derivatives_of_the_displacement() -> None:
    calc = drive()
    phi = np.linspace(0.01, 6.2, 2001)
    step, omega = phi[1] - phi[0], 100 * 2 * np.pi / 60
    domain = calc.domains["crank_angle"]
    s, v, w = (
        calc.sample(n, phi[None, :], domain.middle_of(phi[None, :]))[0]
        for n in ("displacement", "velocity", "acceleration")
    )
    np.testing.assert_allclose((s[2:] - s[:-2]) / (2 * step) * omega, v[1:-1], atol=2e-5 * abs(v).max())
    np.testing.assert_allclose((v[2:] - v[:-2]) / (2 * step) * omega, w[1:-1], atol=2e-5 * abs(w).max())


def test_moment_of_inertia_forces_is_the_rate_of_the_cylinders_energy() -> None:
    calc = drive(**UNBALANCED)
    t = np.linspace(0.0, 0.59, 20_001)
    phi = (t * 100 * 2 * np.pi / 60)[None, :]
    mid = calc.domains["crank_angle"].middle_of(phi)
    theta, rate, moment = (
        calc.sample(n, phi, mid)[0] for n in ("cylinder_rotation", "cylinder_speed", "inertia_moment")
    )
    radius, mass, unbalance = 0.105, 80.9077, 1.97727
    vx, vy = radius * rate + unbalance / mass * np.cos(theta) * rate, -unbalance / mass * np.sin(theta) * rate
    about_center = 0.63623 - unbalance**2 / mass
    energy = mass * (vx**2 + vy**2) / 2 + about_center * rate**2 / 2 + 9.80665 * unbalance * np.cos(theta)
    power = np.gradient(energy, t)[2:-2]
    np.testing.assert_allclose(power, (moment * rate)[2:-2], atol=1e-3 * np.abs(power).max())


def test_losses_add_where_the_crank_drives_and_take_where_the_cylinder_drives() -> None:
    ideal, real = drive(**LOSSLESS), drive()
    efficiency = 0.96 * 0.95 * 0.99 * 0.95
    without, with_losses = dense(ideal, "crank_torque", 5001), dense(real, "crank_torque", 5001)
    expected = np.where(without >= 0, without / efficiency, without * efficiency)
    np.testing.assert_allclose(with_losses, expected, rtol=1e-12, atol=1e-9)


def test_reversals_are_where_the_densely_sampled_torque_changes_its_sign() -> None:
    calc = drive(**UNBALANCED)
    torque = dense(calc, "crank_torque")
    phi = np.linspace(0, 2 * np.pi, len(torque))
    changes = phi[:-1][np.sign(torque[:-1]) * np.sign(torque[1:]) < 0]
    found = calc["torque_reversal"][0]
    np.testing.assert_allclose(np.sort(found[np.isfinite(found)]), changes, atol=2 * phi[1])


def test_the_coupler_force_turns_the_crank_with_the_torque_without_losses() -> None:
    """Moment equilibrium of the crank, which was not used to find the coupler's force (that came from the rocker)."""
    calc = drive(**LOSSLESS, **UNBALANCED, crank_length="120 mm")
    phi = np.linspace(0, 2 * np.pi, 5001)
    force, direction, torque = (dense(calc, n, 5001) for n in ("coupler_force", "coupler_direction", "crank_torque"))
    np.testing.assert_allclose(-0.12 * force * np.sin(direction - phi), torque, atol=1e-9 * np.abs(torque).max())


def test_tooth_force_and_sector_carry_the_moment() -> None:
    calc = drive(pinion_radius="60 mm", pressure_angle="20 deg")
    tangential, moment = dense(calc, "tooth_force", 2001), dense(calc, "total_moment", 2001)
    np.testing.assert_allclose(tangential * 0.06, moment, atol=1e-9)
    top = np.abs(tangential).max()
    assert number(calc, "tooth_force_max") == pytest.approx(top, rel=1e-3)
    assert number(calc, "tooth_normal_force_max") == pytest.approx(
        number(calc, "tooth_force_max") / np.cos(np.radians(20))
    )
    assert number(calc, "sector_radius") == pytest.approx(0.06 * 2 * np.pi / number(calc, "swing_angle"))


def lowest_point(radius: float, height: float, theta: Array) -> Array:
    """Clearance over the die, from points all around the cut circle turned by theta from the flat's lowest position."""
    around = np.linspace(-np.pi, np.pi, 20_001)
    depth = np.where(np.abs(around) <= np.arccos(1 - height / radius), (radius - height) / np.cos(around), radius)
    below = depth[None, :] * np.cos(around[None, :] - theta[:, None])
    return radius - np.max(np.where(np.abs(around) < np.pi / 2 - 1e-9, below, -np.inf), axis=1)


def test_the_carriages_window_is_where_the_turned_section_clears_the_die() -> None:
    calc = drive(segment_height="40 mm", carriage_clearance="30 mm")
    edge = number(calc, "clear_rotation")
    inside, outside = lowest_point(0.105, 0.04, np.array([edge * 0.999, edge * 1.001]))
    assert inside > 0.03 > outside
    for name, sign in (("clearance_outer_start", -1), ("clearance_outer_end", 1)):
        phi = np.array([[number(calc, name) % (2 * np.pi)]])
        theta = calc.sample("cylinder_rotation", phi, phi)[0, 0]
        rate = calc.sample("cylinder_speed", phi, phi)[0, 0]
        assert theta == pytest.approx(edge, abs=1e-9)
        assert np.sign(rate) == sign
    for name in ("clearance_inner_start", "clearance_inner_end"):
        phi = np.array([[number(calc, name)]])
        assert 2 * np.pi - calc.sample("cylinder_rotation", phi, phi)[0, 0] == pytest.approx(edge, abs=1e-9)


def test_without_a_full_turn_the_flat_does_not_come_down_at_the_inner_end() -> None:
    calc = drive(segment_height="40 mm", carriage_clearance="30 mm", sector_ratio=5.5)
    assert np.isnan(calc["clearance_inner_time"][0, 0])
    assert np.isfinite(calc["clearance_outer_time"][0, 0])


def test_cutting_over_the_whole_stroke_jumps_at_the_dead_centres_and_nowhere_beside_them() -> None:
    ratios = {"frame_ratio": 4.514403115358973, "coupler_ratio": 5.982909638480922, "rocker_ratio": 4.156393565264966}
    calc = drive(**ratios, **LOSSLESS)
    inside = np.unique(calc.domains["crank_angle"].edges)[1:-1]
    dead = [number(calc, "dead_center_outer"), number(calc, "dead_center_inner")]
    places = [x for x in inside if min(abs(x - d) for d in dead) < 1e-4]
    assert places == pytest.approx(dead, abs=1e-14)


@pytest.mark.parametrize(
    "changes",
    [{"sector_ratio": 30, "static_unbalance": 3}, {"frame_ratio": 5, "coupler_ratio": 3, "rocker_ratio": 3.0001}],
)
def test_many_turns_and_nearly_folding_linkages_are_calculated(changes: dict[str, Any]) -> None:
    calc = drive(**changes)
    torque = dense(calc, "crank_torque")
    assert number(calc, "crank_torque_mean") == pytest.approx(
        torque[:-1].mean(), rel=1e-3, abs=1e-3 * abs(torque).max()
    )


def test_a_cylinder_that_hardly_turns_is_always_clear_and_has_no_window() -> None:
    calc = drive(segment_height="40 mm", carriage_clearance="5 mm", sector_ratio=0.5)
    assert np.isnan(calc["clearance_outer_time"][0, 0])
    assert number(calc, "clear_rotation") > 0.5 * number(calc, "swing_angle")


@pytest.mark.parametrize(
    "changes, key, words",
    [
        ({"rocker_ratio": 0.5}, "rocker_ratio", "Grashof"),
        ({"frame_ratio": 8}, "rocker_ratio", "frame_ratio = 8"),
        ({"material_thickness": "105 mm"}, "material_thickness", "105 mm"),
        ({"segment_height": "105 mm", "carriage_clearance": "20 mm"}, "segment_height", "lower than the radius"),
        ({"segment_height": "20 mm", "carriage_clearance": "30 mm"}, "carriage_clearance", "20 mm"),
    ],
)
def test_an_impossible_drive_is_refused_in_words(changes: dict[str, Any], key: str, words: str) -> None:
    with pytest.raises(Impossible) as refused:
        drive(**changes)
    assert refused.value.key == key
    assert words in refused.value.message


def test_the_refusal_tells_both_sums_of_the_lengths_of_links() -> None:
    with pytest.raises(Impossible) as refused:
        drive(frame_ratio=2.0, coupler_ratio=1.5, rocker_ratio=1.25)
    assert "longest one (3 together) shorter than the other two together (2.75) (Grashof)" in refused.value.message


def test_all_reasons_why_a_drive_cannot_be_are_told_at_once() -> None:
    with pytest.raises(Impossible) as refused:
        drive(rocker_ratio=12, material_thickness="150 mm", segment_height="20 mm", carriage_clearance="30 mm")
    assert [key for key, _ in refused.value.reasons] == ["rocker_ratio", "material_thickness", "carriage_clearance"]


@given(frame=st.floats(4.6, 6.2), coupler=st.floats(4.6, 5.6), rocker=st.floats(1.9, 3.0), fraction=st.floats(0.05, 1))
@examples(40)
def test_the_energy_balance_holds_for_random_linkages(
    frame: float, coupler: float, rocker: float, fraction: float
) -> None:
    keys = PUBLISHED_DRIVE | UNBALANCED | {"frame_ratio": frame, "coupler_ratio": coupler, "rocker_ratio": rocker}
    values = flatten(MECHANISM.inputs.model_validate(keys | {"cutting_arc_fraction": fraction}))
    try:
        calc = calculate(MECHANISM, values)
    except Impossible:
        return
    assert number(calc, "energy_residual") < 1e-10


def test_a_cut_over_the_whole_stroke_ends_a_turn_after_the_outer_dead_centre() -> None:
    calc = drive(cutting_arc_fraction=1)
    assert number(calc, "cut_begin_forward") == number(calc, "dead_center_outer")
    assert number(calc, "cut_end_return") == pytest.approx(number(calc, "dead_center_outer") + 2 * np.pi, rel=1e-15)
