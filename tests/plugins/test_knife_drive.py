"""The folding knife's drives against geometry, finite differences, dense sampling and integration; comparison, checks, refusals, figures."""

from __future__ import annotations

from itertools import combinations, pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, Impossible
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanics import four_bar
from diecut_report.plugins.knife_drive import MECHANISM
from diecut_report.results.checks import check_results, verdicts
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.figure_views import figures
from tests.examples import examples
from tests.machines import at, inputs, number

OMEGA = 2 * np.pi * 50000 / 3600
DRIVES = ("planetary", "crank_slider", "crank_rocker")
LINKAGE: dict[str, Any] = {"crank": 20, "coupler": 110, "rocker": 80, "frame": 120, "knife_arm": 107}
PLANETARY: dict[str, Any] = {"planetary": {"carrier_radius": 65.656}}
SLIDER: dict[str, Any] = {"crank_slider": {"crank_radius": 35, "rod_length": 140}}
OUTER: dict[str, Any] = {"crank_rocker": LINKAGE}
INNER: dict[str, Any] = {"crank_rocker": LINKAGE | {"lowest_dead_center": "inner"}}
MACHINES = [("planetary", PLANETARY), ("crank_slider", SLIDER), ("crank_rocker", OUTER), ("crank_rocker", INNER)]
each_drive = pytest.mark.parametrize(
    "drive, keys", MACHINES, ids=["planetary", "slider", "rocker outer", "rocker inner"]
)


def knife(**keys: Any) -> Calculation:
    """A knife with 40 mm below the table unless said otherwise."""
    return calculate(MECHANISM, inputs(MECHANISM, {"working_depth": 40} | keys))


def heights(calc: Calculation, drive: str, points: int = 400_001) -> tuple[Array, Array]:
    """Crank angles of two turns, and the edge above its lowest point."""
    phi = np.linspace(0, 4 * np.pi, points)
    s = at(calc, f"{drive}_displacement", phi)
    return phi, s - s.min()


@each_drive
def test_velocity_and_acceleration_are_the_derivatives_of_the_displacement(drive: str, keys: dict[str, Any]) -> None:
    calc = knife(**keys)
    phi, step = np.linspace(0, 2 * np.pi, 1441), 1e-4
    s, v, w = (lambda x, n=name: at(calc, f"{drive}_{n}", x) for name in ("displacement", "velocity", "acceleration"))
    slope, bend = ((f(phi + step) - f(phi - step)) / (2 * step) * OMEGA for f in (s, v))
    np.testing.assert_allclose(slope, v(phi), atol=1e-6 * np.abs(v(phi)).max())
    np.testing.assert_allclose(bend, w(phi), atol=1e-6 * np.abs(w(phi)).max())


def test_the_planetary_edge_goes_straight_on_carrier_and_arm_of_equal_length() -> None:
    """Carrier at φ, arm at π − φ: the planet turns back by twice the carrier's angle inside a circle of twice its size."""
    phi = np.linspace(0, 2 * np.pi, 73)
    edge = 0.065656 * (np.exp(1j * phi) + np.exp(1j * (np.pi - phi)))
    np.testing.assert_allclose(edge.real, 0, atol=1e-15)
    np.testing.assert_allclose(at(knife(**PLANETARY), "planetary_displacement", phi), edge.imag, atol=1e-15)


def test_the_slider_stands_where_the_rod_reaches() -> None:
    phi = np.linspace(0, 2 * np.pi, 73)
    reach = 0.035 * np.cos(phi) + np.sqrt(0.14**2 - (0.035 * np.sin(phi)) ** 2)
    np.testing.assert_allclose(at(knife(**SLIDER), "crank_slider_displacement", phi), 0.175 - reach, atol=1e-15)


@pytest.mark.parametrize("ratio", [1.5, 4.0, 8.0])
def test_the_first_order_form_of_the_slider_and_its_differences_are_reported(ratio: float) -> None:
    """The series of Pythagoras, cut after r/l, its slopes by the series itself."""
    calc = knife(crank_slider={"crank_radius": 35, "rod_length": 35 * ratio})
    phi = np.linspace(0, 2 * np.pi, 20_001)
    cut = {
        "displacement": 0.035 * (1 - np.cos(phi) + (1 - np.cos(2 * phi)) / (4 * ratio)),
        "velocity": 0.035 * OMEGA * (np.sin(phi) + np.sin(2 * phi) / (2 * ratio)),
        "acceleration": 0.035 * OMEGA**2 * (np.cos(phi) + np.cos(2 * phi) / ratio),
    }
    for name, approximate in cut.items():
        found = at(calc, f"crank_slider_{name}_first_order", phi)
        np.testing.assert_allclose(found, approximate, atol=1e-13 * np.abs(approximate).max())
        greatest = np.abs(at(calc, f"crank_slider_{name}", phi) - approximate).max()
        assert number(calc, f"crank_slider_{name}_difference") == pytest.approx(greatest, rel=1e-5)
    share = number(calc, "crank_slider_acceleration_difference") / (0.035 * OMEGA**2 * (1 + 1 / ratio))
    assert number(calc, "crank_slider_acceleration_difference_share") == pytest.approx(share, rel=1e-12)


@each_drive
def test_a_tiny_depth_keeps_its_digits(drive: str, keys: dict[str, Any]) -> None:
    """Near its lowest point the edge rises by W·t²/2; the next term is of third order, absent where the drive is symmetrical."""
    calc = knife(**keys, working_depth="1e-6 mm", grip_angle=1e-6)
    end, time = number(calc, f"{drive}_acceleration_end"), number(calc, f"{drive}_working_time")
    assert end * time**2 / 2 == pytest.approx(1e-9, rel=1e-7 if drive != "crank_rocker" else 1e-3)


def rocker_direction(phi: Array) -> Array:
    """Direction of the rocker from the crossing of two circles, that of the coupler about the pin and that of the rocker."""
    pin = 0.02 * np.exp(1j * phi)
    span = pin - 0.12
    distance = np.abs(span)
    along = (0.08**2 - 0.11**2 + distance**2) / (2 * distance)
    joint = span / distance * (along - 1j * np.sqrt(0.08**2 - along**2))
    return np.angle(joint)


@pytest.mark.parametrize("keys, sign", [(OUTER, 1), (INNER, -1)])
def test_the_rocker_stands_where_two_circles_cross(keys: dict[str, Any], sign: int) -> None:
    phi = np.linspace(0, 2 * np.pi, 20_001)
    beta = rocker_direction(phi)
    dead = beta.min() if sign > 0 else beta.max()
    found = at(knife(**keys), "crank_rocker_displacement", phi)
    np.testing.assert_allclose(found, 0.107 * sign * (beta - dead), atol=1e-9)


@each_drive
def test_contact_and_lowest_point_are_those_of_dense_sampling(drive: str, keys: dict[str, Any]) -> None:
    calc = knife(**keys)
    phi, height = heights(calc, drive)
    turn = len(phi) // 2
    lowest = int(np.argmin(height[turn // 2 : turn // 2 + turn])) + turn // 2
    before = np.arange(lowest, 0, -1)
    contact = before[np.argmax(height[before] > 0.04)]
    step = phi[1]
    lowest_angle = number(calc, f"{drive}_lowest_angle")
    assert np.mod(phi[lowest] - lowest_angle + 1, 2 * np.pi) - 1 == pytest.approx(0, abs=2 * step)
    assert number(calc, f"{drive}_working_angle") == pytest.approx(phi[lowest] - phi[contact], abs=3 * step)
    assert number(calc, f"{drive}_stroke") == pytest.approx(height.max(), rel=1e-9)
    assert number(calc, f"{drive}_working_time") == pytest.approx(number(calc, f"{drive}_working_angle") / OMEGA)


@each_drive
def test_at_contact_the_edge_is_at_the_table_and_goes_down(drive: str, keys: dict[str, Any]) -> None:
    calc = knife(**keys)
    contact, lowest = (np.array([number(calc, f"{drive}_{name}_angle")]) for name in ("contact", "lowest"))
    above = at(calc, f"{drive}_displacement", contact) - at(calc, f"{drive}_displacement", lowest)
    assert above[0] == pytest.approx(0.04, rel=1e-12)
    assert at(calc, f"{drive}_velocity", contact)[0] == pytest.approx(
        -number(calc, f"{drive}_contact_velocity"), rel=1e-12
    )
    assert at(calc, f"{drive}_velocity", lowest)[0] == pytest.approx(0, abs=1e-12)


@each_drive
def test_peak_and_end_are_those_of_the_acceleration_in_the_working_stroke(drive: str, keys: dict[str, Any]) -> None:
    calc = knife(**keys)
    lowest, angle = number(calc, f"{drive}_lowest_angle"), number(calc, f"{drive}_working_angle")
    within = np.abs(at(calc, f"{drive}_acceleration", lowest - np.linspace(angle, 0, 100_001)))
    assert number(calc, f"{drive}_acceleration_peak") == pytest.approx(within.max(), rel=1e-8)
    assert number(calc, f"{drive}_acceleration_end") == pytest.approx(within[-1], rel=1e-12)


def test_the_outer_dead_centre_has_its_peak_before_the_end() -> None:
    calc = knife(**OUTER)
    assert number(calc, "crank_rocker_acceleration_peak") > 1.01 * number(calc, "crank_rocker_acceleration_end")


def test_a_deep_stroke_may_have_its_peak_where_the_edge_is_still_speeding_up() -> None:
    """With a rod hardly longer than the crank the edge is thrown down from the top; the peak is no braking."""
    calc = knife(crank_slider={"crank_radius": 35, "rod_length": 36}, working_depth=69)
    place = np.array([number(calc, "crank_slider_acceleration_peak_at")])
    assert at(calc, "crank_slider_acceleration", place)[0] < -1.5 * number(calc, "crank_slider_acceleration_end")


@each_drive
def test_the_grip_begins_with_the_knifes_speed(drive: str, keys: dict[str, Any]) -> None:
    calc = knife(**keys, grip_angle=7, roller_diameter=90, roller_ratio=1.5)
    begin = np.array([number(calc, f"{drive}_lowest_angle") - np.radians(7)])
    speed = -at(calc, f"{drive}_velocity", begin)[0]
    rollers, time = 0.045 * 1.5 * OMEGA, np.radians(7) / OMEGA
    assert number(calc, f"{drive}_grip_velocity") == pytest.approx(speed, rel=1e-12)
    assert number(calc, f"{drive}_grip_acceleration") == pytest.approx((rollers - speed) / time, rel=1e-12)
    given_speed = knife(**keys, grip_speed=0.2)
    assert number(given_speed, f"{drive}_grip_acceleration") == pytest.approx(
        (0.08 * OMEGA - 0.2) / (np.pi / 36 / OMEGA)
    )


def test_rollers_slower_than_the_knife_brake_the_signature_and_are_checked_by_size() -> None:
    calc = knife(**PLANETARY, roller_diameter=1)
    assert number(calc, "planetary_grip_acceleration") < 0
    assert number(calc, "planetary_grip_size") == -number(calc, "planetary_grip_acceleration")


@each_drive
def test_the_signature_leaves_the_table_when_its_trailing_edge_has_passed(drive: str, keys: dict[str, Any]) -> None:
    """The signature followed in small steps of time: with the knife to its lowest point, then with the rollers."""
    calc = knife(**keys, signature_length=273)
    step, angle, passed, time = 1e-5, number(calc, f"{drive}_working_angle"), 0.0, 0.0
    lowest = number(calc, f"{drive}_lowest_angle")
    phi = np.arange(lowest - angle, lowest, OMEGA * step) + OMEGA * step / 2
    speeds = iter(-at(calc, f"{drive}_velocity", phi))
    while passed < 0.273:
        passed += next(speeds, 0.08 * OMEGA) * step
        time += step
    assert number(calc, f"{drive}_table_time") == pytest.approx(time, abs=5e-5)
    assert number(calc, "signature_interval") == pytest.approx(3600 / 25000 / 2)


@each_drive
def test_results_do_not_depend_on_the_number_of_samples(drive: str, keys: dict[str, Any]) -> None:
    few, many = knife(**keys, n_points=36), knife(**keys, n_points=5000)
    peak = f"{drive}_acceleration_peak"
    assert number(few, peak) == pytest.approx(number(many, peak), rel=1e-10)


@pytest.mark.parametrize("ratio", [1.2, 3.0, 4.0, 8.0])
def test_at_equal_stroke_planetary_and_crank_slider_differ_by_one_and_the_ratio_of_crank_to_rod(ratio: float) -> None:
    radius = 65.656 * 2
    calc = knife(**PLANETARY, crank_slider={"crank_radius": radius, "rod_length": radius * ratio})
    assert number(calc, "planetary_stroke") == pytest.approx(number(calc, "crank_slider_stroke"))
    ends = number(calc, "planetary_acceleration_end") / number(calc, "crank_slider_acceleration_end")
    assert ends == pytest.approx(1 / (1 + 1 / ratio), rel=1e-12)
    assert number(calc, "factor_ratio_planetary") == pytest.approx(ends, rel=1e-12)


@each_drive
def test_the_edge_may_start_at_the_table(drive: str, keys: dict[str, Any]) -> None:
    stroke = number(knife(**keys), f"{drive}_stroke")
    calc = knife(**keys, working_depth=f"{stroke!r} m")
    assert number(calc, f"{drive}_contact_velocity") == pytest.approx(0, abs=1e-5)
    assert number(calc, f"{drive}_working_angle") > 1


@pytest.mark.parametrize(
    ("ratio", "status"), [(2, "pass"), (4, "fail"), (1, "fail"), (1.87, "fail"), (3, "fail"), (0.001, "fail")]
)
def test_a_knife_that_does_not_fold_each_signature_once_fails(ratio: float, status: str) -> None:
    """Counted over 200 signatures: those that no lowest point of the knife belongs to, and strokes that belong to none."""
    calc = knife(**SLIDER, drive_ratio=ratio, signature_length=273)
    interval, cycle = number(calc, "signature_interval"), number(calc, "cycle_time")
    missed = [each for each in range(200) if abs(each * interval / cycle - round(each * interval / cycle)) > 1e-9]
    idle = round(200 * interval / cycle) - 200
    assert (status == "pass") == (not missed and idle == 0)
    assert {each.id: each.status for each in verdicts(calc)}["in_step"] == status


@given(
    crank=st.floats(10, 30), coupler=st.floats(60, 160), rocker=st.floats(40, 120), frame=st.floats(60, 160),
    arm=st.floats(60, 200), share=st.floats(0.05, 0.98), side=st.sampled_from(["outer", "inner"]),
)  # fmt: skip
@examples(60)
def test_any_crank_rocker_covers_the_depth_in_its_working_stroke(
    crank: float, coupler: float, rocker: float, frame: float, arm: float, share: float, side: str
) -> None:
    longest = max(coupler, rocker, frame)
    assume(crank < min(coupler, rocker, frame) - 1 and crank + longest < coupler + rocker + frame - longest - 2)
    keys = {"crank": crank, "coupler": coupler, "rocker": rocker, "frame": frame, "knife_arm": arm}
    try:
        whole = knife(crank_rocker=keys | {"lowest_dead_center": side}, working_depth=1, grip_angle=0.01)
        depth = share * number(whole, "crank_rocker_stroke")
        calc = knife(crank_rocker=keys | {"lowest_dead_center": side}, working_depth=f"{depth!r} m", grip_angle=0.01)
    except Impossible as refused:
        assert refused.key == "working_depth"
        return
    nodes, weights = np.polynomial.legendre.leggauss(200)
    lowest, angle = number(calc, "crank_rocker_lowest_angle"), number(calc, "crank_rocker_working_angle")
    phi = lowest - angle / 2 + angle / 2 * nodes
    velocity, acceleration = (at(calc, f"crank_rocker_{name}", phi) for name in ("velocity", "acceleration"))
    assert (velocity < 0).all()
    assert np.sum(velocity * weights) * angle / 2 / OMEGA == pytest.approx(-depth, rel=1e-8)
    braked = np.sum(acceleration * weights) * angle / 2 / OMEGA
    assert braked == pytest.approx(number(calc, "crank_rocker_contact_velocity"), rel=1e-6, abs=1e-6)


@given(radius=st.floats(20, 100), ratio=st.floats(1.01, 8), share=st.floats(0.05, 0.999))
@examples(60)
def test_any_crank_slider_stands_at_the_depth_at_contact(radius: float, ratio: float, share: float) -> None:
    rod, depth = radius * ratio, 2 * radius * share
    calc = knife(crank_slider={"crank_radius": radius, "rod_length": rod}, working_depth=depth, grip_angle=0.01)
    angle = number(calc, "crank_slider_working_angle")
    reach = radius * np.cos(angle) + np.sqrt(rod**2 - (radius * np.sin(angle)) ** 2)
    assert radius + rod - reach == pytest.approx(depth, rel=1e-7)


BLOCKS = {"planetary": PLANETARY, "crank_slider": SLIDER, "crank_rocker": INNER}
EVERY = PLANETARY | SLIDER | INNER


def word(calc: Calculation, name: str) -> str:
    return str(calc[name][0, 0])


@pytest.mark.parametrize("names", [n for size in (1, 2, 3) for n in combinations(DRIVES, size)], ids="+".join)
@pytest.mark.parametrize("depth", [20, 40])
def test_the_best_drive_has_the_least_peak_of_those_given(names: tuple[str, ...], depth: float) -> None:
    calc = knife(**{key: part for name in names for key, part in BLOCKS[name].items()}, working_depth=depth)
    peaks = {name: number(calc, f"{name}_acceleration_peak") for name in names}
    best = min(peaks, key=lambda name: peaks[name])
    assert word(calc, "best_drive") == best
    assert best.replace("_", "-") in word(calc, "verdict")
    for name in names if len(names) > 1 else ():
        for what in (
            "stroke",
            "working_time",
            "contact_velocity",
            "acceleration_peak",
            "acceleration_end",
            "end_factor",
            "grip_size",
        ):
            ratio = number(calc, f"{name}_{what}") / number(calc, f"{best}_{what}")
            assert number(calc, f"{name}_{what}_ratio") == pytest.approx(ratio, rel=1e-12)
    others = [peaks[name] for name in names if name != "planetary"]
    if "planetary" in names and others:
        assert number(calc, "acceleration_ratio_planetary") == pytest.approx(
            peaks["planetary"] / min(others), rel=1e-12
        )
    else:
        assert "acceleration_ratio_planetary" not in calc.values


def test_the_planetary_drive_is_the_best_one_where_it_is_small() -> None:
    calc = knife(planetary={"carrier_radius": 10.5}, **SLIDER, **INNER)
    assert word(calc, "best_drive") == "planetary"
    assert number(calc, "acceleration_ratio_planetary") < 1


def test_what_the_paper_stands_is_said() -> None:
    assert "and its acceleration is allowed" in word(knife(**EVERY), "verdict")
    assert "too, is above the allowed" in word(knife(**EVERY, allowable_paper_acceleration=100), "verdict")
    assert "given; its acceleration is allowed" in word(knife(**PLANETARY), "verdict")
    assert "above the allowed" in word(knife(**PLANETARY, allowable_paper_acceleration=999), "verdict")


def test_stroke_or_kind_of_drive_is_named_as_the_reason() -> None:
    assert word(knife(**EVERY), "reason") == "mostly its stroke"
    equal = knife(**PLANETARY, crank_slider={"crank_radius": 131.312, "rod_length": 300})
    assert word(equal, "reason") == "mostly the kind of drive"


def test_stroke_times_factor_is_the_acceleration_at_the_lowest_point() -> None:
    calc = knife(**EVERY)
    shares = number(calc, "stroke_ratio_planetary") * number(calc, "factor_ratio_planetary")
    ends = number(calc, "planetary_acceleration_end") / number(calc, "crank_rocker_acceleration_end")
    assert shares == pytest.approx(ends, rel=1e-12)


def test_what_asks_more_of_the_paper_is_named() -> None:
    assert word(knife(**EVERY), "grip_verdict").startswith("the grip of the rollers")
    slow = knife(**EVERY, roller_diameter=2)
    assert number(slow, "crank_rocker_grip_size") < number(slow, "crank_rocker_acceleration_peak")
    assert word(slow, "grip_verdict").startswith("the knife")


def test_each_drive_has_its_checks_and_only_the_drives_that_are_given() -> None:
    ids = [check.id for check in check_results(knife(**PLANETARY, **INNER))]
    what = ("paper_acceleration", "grip_acceleration", "depth")
    every = (*what, "time_budget")  # not checked: the signature's length is not given
    assert set(ids) == {"in_step"} | {f"{drive}_{name}" for drive in ("planetary", "crank_rocker") for name in every}
    timed = {c.id: c for c in check_results(knife(**PLANETARY, signature_length=800))}["planetary_time_budget"]
    assert timed.status == "fail"
    assert timed.utilisation == pytest.approx((0.0091885 + 0.76 / 6.981317) / 0.072, rel=1e-4)


@pytest.mark.parametrize(
    "keys, key, words",
    [
        ({}, "planetary", "at least one of the blocks planetary, crank_slider and crank_rocker"),
        ({"crank_slider": {"crank_radius": 35, "rod_length": 35}}, "crank_slider.rod_length", "not longer than the crank_radius"),
        ({"planetary": {"carrier_radius": 9}}, "working_depth", "never rise above the table"),
        ({"crank_slider": {"crank_radius": 19, "rod_length": 90}}, "working_depth", "travels 38 mm in all"),
        (OUTER | {"working_depth": 60}, "working_depth", "longer knife_arm"),
        ({"crank_rocker": LINKAGE | {"crank": 85}}, "crank_rocker.crank", "Grashof"),
        ({"crank_rocker": LINKAGE | {"frame": 180}}, "crank_rocker.crank", "frame = 180 mm"),
        ({"crank_rocker": LINKAGE | {"frame": 200}}, "crank_rocker.crank", "shorter than the other two together"),
        (PLANETARY | {"working_depth": 0.2}, "grip_angle", "before the knife meets the signature"),
        (PLANETARY | {"working_depth": 0.2}, "grip_angle", "make grip_angle at most 3.162°"),
        (OUTER | {"working_depth": 60}, "working_depth", "at most 55.44 mm"),
        (PLANETARY | {"signature_length": 40}, "signature_length", "make signature_length greater than that"),
    ],
)  # fmt: skip
def test_an_impossible_knife_is_refused_in_words(keys: dict[str, Any], key: str, words: str) -> None:
    with pytest.raises(Impossible) as refused:
        knife(**keys)
    assert refused.value.key == key
    assert words in refused.value.message


def test_every_drive_that_would_be_gripped_too_early_is_told_at_once() -> None:
    with pytest.raises(Impossible) as refused:
        knife(**EVERY, grip_angle=130)
    told = [message for key, message in refused.value.reasons if key == "grip_angle"]
    for drive in ("planetary drive", "crank-slider", "crank-rocker"):
        assert any(f"working stroke of the {drive} is" in message for message in told)


def test_a_depth_beyond_stroke_and_signature_is_told_for_both() -> None:
    with pytest.raises(Impossible) as refused:
        knife(**PLANETARY, working_depth=300, signature_length=273)
    assert [key for key, _ in refused.value.reasons] == ["working_depth", "signature_length"]


def drawn(calc: Calculation) -> dict[str, FigureRecord]:
    return {figure.id: figure for figure in figures(calc)}


def test_the_working_stroke_is_shaded_from_contact_to_the_lowest_point() -> None:
    calc = knife(**PLANETARY, **SLIDER, **OUTER, working_depth=30)
    found = drawn(calc)
    for drive in DRIVES:
        fills = found[f"{drive}_motion"].panels[1].fills[0]
        shaded = np.array([x for x, y in zip(fills.x, fills.y, strict=True) if y is not None])
        lowest, angle = number(calc, f"{drive}_lowest_angle"), number(calc, f"{drive}_working_angle")
        back = np.mod(lowest - shaded + 1e-6, 2 * np.pi) - 1e-6
        assert back.min() == pytest.approx(0, abs=1e-9) and back.max() == pytest.approx(angle, abs=1e-9)
        assert len(shaded) == pytest.approx(angle / (2 * np.pi) * 721, abs=4)


def test_all_drives_stand_still_at_the_common_origin() -> None:
    panel = drawn(knife(**EVERY))["from_lowest"].panels[0]
    for line in panel.lines[:3]:
        assert np.interp(0.0, line.x, line.y) == pytest.approx(0, abs=0.02)
        assert np.interp(-0.5, line.x, line.y) > 0.9
    assert panel.lines[3].y[0] == pytest.approx(0.08 * 2 * np.pi * 50000 / 3600)


def test_a_long_signature_does_not_stretch_the_comparison() -> None:
    for length, last in ((273, (0.273 - 0.04) / 0.08), (2000, None)):
        panel = drawn(knife(**EVERY, signature_length=length))["from_lowest"].panels[0]
        ends = {line.label: line.x[-1] for line in panel.lines}
        assert ends["rollers"] == pytest.approx(last or ends["crank-rocker"])
        assert ["off the table" in place.label for place in panel.verticals] == [False, True][: 1 + (length == 273)]


def test_the_differences_of_the_first_order_form_are_drawn() -> None:
    calc = knife(**SLIDER)
    exact, *errors = drawn(calc)["crank_slider_first_order"].panels
    assert [line.label for line in exact.lines] == ["exact", "first order"]
    for panel, name in zip(errors, ("displacement", "velocity", "acceleration"), strict=True):
        assert np.abs(panel.lines[0].y).max() == pytest.approx(
            number(calc, f"crank_slider_{name}_difference"), rel=1e-3
        )


def test_the_lines_over_the_stroke_pass_through_the_machines() -> None:
    panel = drawn(knife(**EVERY))["over_stroke"].panels[0]
    for line, mark in zip(panel.lines, panel.marks, strict=True):
        assert np.interp(mark.x, line.x, line.y) == pytest.approx(mark.y, rel=1e-6)
        slopes = np.array(line.y) / np.array(line.x)
        np.testing.assert_allclose(slopes, slopes[0], rtol=1e-9)


def test_the_table_holds_the_numbers_and_their_ratios() -> None:
    boxes = drawn(knife(**EVERY))["comparison"].shapes
    cells = [line for box in boxes for line in box.lines]
    assert "planetary drive" in cells and "crank-rocker" in cells
    assert "1000 m/s² (× 6.00)" in cells and "262.6 mm (× 4.74)" in cells
    timed = [line for box in drawn(example())["comparison"].shapes for line in box.lines]
    assert "42.56 ms of 72 ms" in timed
    assert "0.7894 (× 1.00)" in cells and "6815 m/s² (× 1.00)" in cells
    assert "crank-rocker is gentlest on the paper, and its acceleration is allowed" in " ".join(cells)
    assert "6.00 = 4.74 (stroke) × 1.27 (factor); mostly its stroke." in " ".join(cells)
    alone = [line for box in drawn(knife(**PLANETARY))["comparison"].shapes for line in box.lines]
    assert "262.6 mm" in alone


@pytest.mark.parametrize("keys", [OUTER, INNER], ids=["outer", "inner"])
def test_the_drawn_linkage_has_its_lengths_and_its_edge_travels_down_to_the_table_and_below(
    keys: dict[str, Any],
) -> None:
    calc = knife(**keys)
    chains = [np.array(s.points) for s in drawn(calc)["crank_rocker_drive"].shapes
              if s.shape == "polyline" and len(s.points) == 5]  # fmt: skip
    assert len(chains) == 3
    for chain in chains:
        lengths = [float(np.hypot(*(two - one))) for one, two in pairwise(chain)]
        assert lengths == pytest.approx([0.02, 0.11, 0.08, 0.107], abs=1e-4)
    contact, high, low = (chain[4, 1] for chain in chains)
    assert low == pytest.approx(0, abs=1e-9)
    assert contact == pytest.approx(0.107 * np.sin(0.04 / 0.107), rel=1e-4)
    assert high > contact


@pytest.mark.parametrize("drive, links", [("planetary", [65.656, 65.656]), ("crank_slider", [35, 140, 80])])
def test_the_drawn_straight_line_drives_have_their_lengths(drive: str, links: list[float]) -> None:
    shapes = drawn(knife(**PLANETARY, **SLIDER))[f"{drive}_drive"].shapes
    chains = [np.array(s.points) for s in shapes if s.shape == "polyline" and len(s.points) == len(links) + 1]
    for chain in chains:
        assert [1e3 * float(np.hypot(*(b - a))) for a, b in pairwise(chain)] == pytest.approx(links)
    contact, _, lowest = (chain[-1] for chain in chains)
    assert contact[1] - lowest[1] == pytest.approx(0.04, rel=1e-9)


def example() -> Calculation:
    """The knife of the example."""
    return knife(**EVERY, signature_length=273)


def test_a_knife_without_a_drive_says_so_once() -> None:
    with pytest.raises(Impossible) as refused:
        calculate(MECHANISM, inputs(MECHANISM, {"working_depth": 40}))
    assert len(refused.value.reasons) == 1


@pytest.mark.parametrize("keys, sign", [(OUTER, 1), (INNER, -1)])
def test_the_rocker_moves_as_the_four_bar(keys: dict[str, Any], sign: int) -> None:
    phi = np.linspace(0, 2 * np.pi, 361)
    calc, linkage = knife(**keys), four_bar.motion(phi, 6.0, 5.5, 4.0)
    np.testing.assert_allclose(
        at(calc, "crank_rocker_velocity", phi), sign * linkage.rocker_speed_ratio * OMEGA * 0.107, atol=1e-12
    )
    np.testing.assert_allclose(
        at(calc, "crank_rocker_acceleration", phi),
        sign * linkage.rocker_acceleration_ratio * OMEGA**2 * 0.107,
        atol=1e-9,
    )


@each_drive
def test_what_brakes_the_edge_is_its_speed_at_contact_and_its_way_the_depth(drive: str, keys: dict[str, Any]) -> None:
    calc = knife(**keys)
    nodes, weights = np.polynomial.legendre.leggauss(60)
    lowest, angle = number(calc, f"{drive}_lowest_angle"), number(calc, f"{drive}_working_angle")
    phi, time = lowest - angle / 2 + angle / 2 * nodes, angle / 2 * weights / OMEGA
    braked, way = (np.sum(at(calc, f"{drive}_{name}", phi) * time) for name in ("acceleration", "velocity"))
    assert braked == pytest.approx(number(calc, f"{drive}_contact_velocity"), rel=1e-12)
    assert way == pytest.approx(-0.04, rel=1e-12)
