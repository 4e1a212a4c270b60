"""Derivatives, periods that are calculated, curves laid out from a start, found values: against closed forms, alone and among variants."""

from __future__ import annotations

import numpy as np
import pytest

from diecut_report.machine.calculation import CurveHandle, Impossible, Unproven
from diecut_report.machine.numerics.domain import Domain
from diecut_report.machine.steps.run import calculate, varied, varied_curves
from diecut_report.results.figure_views import MachineView
from tests.examples import few
from tests.machine.loop import MECHANISM as LOOP
from tests.machine.swing import MECHANISM, RATIOS
from tests.machine.swings import CLOSED, TURN, follower, grown, made, results, several, single, swing, values

# --- derivatives and integrals ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("duration", "ripple"),
    few([(2.0, 1.0), (2.0, 0.3), (0.01, 0.001), (7.0, 0.1), (1.0, 5.0)], keep=lambda one: one[1] < 0.3 or one[1] > 1),
)
@pytest.mark.parametrize("curve", CLOSED)
def test_derivatives_and_integrals_are_those_of_closed_form(curve: str, duration: float, ripple: float) -> None:
    found = values(made(duration=duration, ripple=ripple, n_points=100), curve)
    wanted = CLOSED[curve](np.arange(100) / 100, duration)
    np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-9 * np.abs(wanted).max())


def test_a_derivative_has_limits_of_both_sides_where_the_curve_has_a_corner() -> None:
    curves = results(made(duration=2)).curves
    assert curves["acceleration"].breakpoints == [0.5] == curves["time"].breakpoints
    assert curves["acceleration"].left == pytest.approx([24], rel=1e-9)
    assert curves["acceleration"].right == pytest.approx([-(TURN**2) / 4], rel=1e-9)
    assert curves["speed"].left == pytest.approx([6], rel=1e-11)
    assert curves["speed"].right == pytest.approx([0], abs=1e-11)


def test_reductions_of_a_derivative_take_the_limits_in() -> None:
    calc = made(duration=2)
    assert calc["speed_top"][0, 0] == pytest.approx(6, rel=1e-11) and calc["speed_top_at"][0, 0] == 0.5
    assert calc["speed_mean"][0, 0] == pytest.approx(0, abs=1e-13)


def test_a_derivative_keeps_its_value_at_the_end_of_the_period() -> None:
    calc = follower(made(duration=2), duration=0.4)  # the curve's corner lies beyond this abscissa
    domain = calc.domains["time"]
    domain.edges = np.concatenate(
        [domain.edges, domain.period], axis=1
    )  # as among variants of which some have more pieces
    assert domain.widths[0, -1] == 0
    assert MachineView(calc).at("speed", 0.4) == pytest.approx(CLOSED["speed"](0.2, 2), rel=1e-11)


# --- curves laid out from a start ------------------------------------------------------------------------------------


@pytest.mark.parametrize("share", [0, 0.1, 0.25, 0.61, 0.999])
@pytest.mark.parametrize("duration", few([0.5, 2, 2.5, 9], keep=lambda duration: duration in (0.5, 9)))
def test_a_curve_laid_out_from_a_start_goes_around(share: float, duration: float) -> None:
    calc = follower(made(duration=2), "turned", share=share, duration=duration, n_points=90)
    passed = share + np.arange(90) / 90 * duration / 2
    np.testing.assert_allclose(values(calc, "grown"), grown(passed), atol=1e-13)
    np.testing.assert_allclose(values(calc, "position"), grown(passed % 1), atol=1e-13)
    np.testing.assert_allclose(values(calc, "stretched"), grown(np.arange(90) / 90), atol=1e-13)


def test_breakpoints_come_again_in_each_period() -> None:
    curves = results(follower(made(duration=2), "turned", share=0.6, duration=5)).curves
    own = [0.8, 1.3, 2.8, 3.3, 4.8]  # the curve's end, then its corner
    stretched = [5 / 4]
    assert curves["position"].breakpoints == pytest.approx(sorted(own + stretched))
    ends = [curves["position"].breakpoints.index(pytest.approx(place)) for place in (0.8, 2.8, 4.8)]
    assert [curves["position"].left[i] for i in ends] == pytest.approx([2, 2, 2])
    assert [curves["position"].right[i] for i in ends] == pytest.approx([0, 0, 0], abs=1e-13)
    assert [curves["grown"].left[i] for i in ends] == pytest.approx([2, 4, 6])
    assert [curves["grown"].right[i] for i in ends] == pytest.approx([2, 4, 6])


def test_the_curve_of_a_curve_keeps_its_period_and_its_gain() -> None:
    first = follower(made(duration=2), "turned", share=0.25, duration=2)
    second = follower(first, "grown", share=0.5, duration=4)
    assert second["cycle"][0, 0] == 2
    begin = 0.25 + 0.5
    passed = np.arange(48) / 48 * 2
    laps = np.floor(0.5 + passed)  # each period of the first one begins anew at its start
    wanted = grown(0.25 + (0.5 + passed) % 1) + 2 * laps
    np.testing.assert_allclose(values(second, "grown")[0], grown(begin), atol=1e-13)
    np.testing.assert_allclose(values(second, "grown"), wanted, atol=1e-12)


def test_the_period_is_that_of_the_referred_curve() -> None:
    assert follower(made(duration=3))["cycle"][0, 0] == 3
    assert follower(made(duration=3), rate=4)["cycle"][0, 0] == 0.25


def test_a_curve_over_another_quantity_has_no_such_period() -> None:
    handle = CurveHandle(calculate(LOOP, {"pull": 1.0, "material": "rope", "n_points": 90, "swing": 2.0}), "height")
    with pytest.raises(Impossible, match="runs over turn, in °; give rate, with which it runs through") as refused:
        swing(inertia=None, mass=1, motion=handle)
    assert refused.value.key == "motion"
    calc = swing(inertia=None, mass=1, motion=handle, rate=0.5, duration=4, n_points=36)
    np.testing.assert_allclose(values(calc, "position"), 2 * np.sin(np.pi * np.arange(36) / 9), atol=1e-13)
    np.testing.assert_allclose(values(calc, "speed"), 2 * np.pi * np.cos(np.pi * np.arange(36) / 9), atol=1e-9)


def test_a_list_tells_no_period_and_gains_nothing() -> None:
    inputs = {"inertia": 1.0, "stiffness": 1.0, "motion": (0.0, 1.0, 0.0, -1.0), "grade": "plain", "n_points": 36, "ripple": 1.0, "duration": 4.0,
              "share": 0.25}  # fmt: skip
    with pytest.raises(Impossible, match="is a list of values, which tells no period; give rate"):
        calculate(MECHANISM, inputs)
    calc = calculate(MECHANISM, inputs | {"rate": 0.5})
    places = (0.25 + np.arange(36) / 18) % 1
    wanted = np.interp(places, np.arange(5) / 4, [0, 1, 0, -1, 0])
    np.testing.assert_allclose(values(calc, "grown"), wanted, atol=1e-13)
    np.testing.assert_allclose(values(calc, "position"), wanted, atol=1e-13)


# --- found values and spectra ----------------------------------------------------------------------------------------


def test_plain_code_takes_numbers_texts_and_curves() -> None:
    assert made(stiffness=3)["work"][0, 0] == 1.5 and made(stiffness=3, grade="fine")["work"][0, 0] == 0.75
    assert follower(made(duration=2), share=0.9)["between"][0, 0] == pytest.approx(CLOSED["position"](0.4, 2))


def test_a_spectrum_stands_among_the_curves_of_the_results() -> None:
    curves = results(made()).curves
    assert curves["ratio"].values == RATIOS.tolist() and curves["ratio"].is_spectrum
    assert curves["amplitude_2"].values == (RATIOS**2).tolist()
    assert (curves["amplitude_2"].abscissa, curves["amplitude_2"].source) == ("ratio", "made up")
    assert not any(curves[name].is_spectrum for name in CLOSED)


# --- pieces ----------------------------------------------------------------------------------------------------------


def test_finer_pieces_serve_the_search_and_are_no_breakpoints_of_the_results() -> None:
    calc = made(duration=2, ripple=0.1)
    assert calc.domains["time"].widths.max() <= 0.1 * (1 + 1e-12)
    assert results(calc).curves["position"].breakpoints == [0.5]


def test_a_search_for_crossings_leaves_no_breakpoints() -> None:
    calc = made(duration=2)
    assert calc["half_way"][0, :2] == pytest.approx([0.5 * 0.5 ** (1 / 3), 1.5])
    assert results(calc).curves["time"].breakpoints == [0.5]


def test_neither_the_start_nor_the_end_is_a_breakpoint() -> None:
    calc = follower(made(duration=2), duration=2)  # the period of the curve begins at the start
    for curve in results(calc).curves.values():
        assert (curve.breakpoints or [0.5]) == [0.5]


@pytest.mark.parametrize("place", [0.0, 2.0, 1e-15, -1e-17, 2 - 1e-15, 4.0, np.nan])
def test_a_place_at_an_end_cuts_nothing(place: float) -> None:
    domain = Domain(np.full((1, 1), 2.0), np.zeros((1, 4)))
    domain.cut(np.array([[place]]))
    assert np.count_nonzero(domain.widths) == 1 and domain.widths.max() == 2


@pytest.mark.parametrize("length", [0.0, -1.0, np.nan, np.inf, 3.0])
def test_a_length_that_does_not_divide_cuts_nothing(length: float) -> None:
    domain = Domain(np.full((2, 1), 2.0), np.zeros((2, 4)))
    domain.cut_every(np.array([[length], [0.5]]))
    assert np.count_nonzero(domain.widths, axis=1).tolist() == [1, 4] and domain.joints.shape == (2, 2)


def test_one_place_from_two_ways_is_one() -> None:
    domain = Domain(np.full((1, 1), 2.0), np.zeros((1, 4)))
    domain.cut_finer(np.array([[0.3]]))
    domain.cut(np.array([[0.1 * 3]]))
    assert np.count_nonzero(domain.widths) == 2 and domain.is_joint(domain.edges)[0].all()


# --- variants --------------------------------------------------------------------------------------------------------

NUMBERS = ("quarter", "work", "speed_top", "force_top", "speed_mean", "speed_top_at")


def test_variants_of_unlike_period_and_pieces_are_what_each_is_alone() -> None:
    calc = several()
    for index in range(3):
        alone = single(index)
        for name in NUMBERS:
            assert calc[name][index, 0] == pytest.approx(alone[name][0, 0], rel=1e-11, abs=1e-13)
        for curve in (*CLOSED, "force", "turned"):
            scale = np.abs(alone.curve_samples(curve)).max()
            np.testing.assert_allclose(calc.curve_samples(curve)[index], alone.curve_samples(curve)[0], atol=1e-10 * scale)  # fmt: skip


def test_an_impossible_variant_neither_breaks_nor_slows_its_neighbours() -> None:
    calc = several(ripple=np.array([0.3, 1e-12, 0.75]), duration=np.array([2.0, np.nan, 3.0]))
    assert set(calc.flaws) == {1} and calc.domains["time"].edges.shape[1] < 40
    for index in (0, 2):
        assert calc["speed_top"][index, 0] == pytest.approx(single(index)["speed_top"][0, 0], rel=1e-11)


def test_an_impossible_variant_with_countless_pieces_is_not_cut() -> None:
    calc = several(ripple=np.array([0.3, 1e-12, 0.75]))
    assert set(calc.flaws) == {1} and calc.domains["time"].edges.shape[1] < 40


def test_a_period_must_be_above_zero() -> None:
    values = {
        "inertia": 1.0,
        "stiffness": 1.0,
        "share": 0.0,
        "grade": "plain",
        "n_points": 48,
        "lift": 1.0,
        "ripple": 1.0,
    }
    with pytest.raises(Unproven, match=r"Time \(time\) has no length to run over"):
        calculate(MECHANISM, values | {"duration": 0.0})


def test_variants_follow_the_curve_of_one_machine() -> None:
    handle = CurveHandle(made(duration=2, ripple=0.04), "turned")  # more than 40 pieces
    values = {"inertia": 1.0, "stiffness": 1.0, "motion": handle, "grade": "plain", "n_points": 48, "ripple": 1.0}
    shares, durations, rates = [0.0, 0.3, 0.8], [2.0, 1.0, 5.0], [0.5, 1.0, 0.7]
    calc = calculate(MECHANISM, values | {"share": np.array(shares), "duration": np.array(durations), "rate": np.array(rates)}, 3)  # fmt: skip
    for index, (share, duration, rate) in enumerate(zip(shares, durations, rates, strict=True)):
        passed = share + np.arange(48) / 48 * duration * rate
        np.testing.assert_allclose(calc.curve_samples("grown")[index], grown(passed), atol=1e-13)
        alone = calculate(MECHANISM, values | {"share": share, "duration": duration, "rate": rate})
        for name in ("grown_top", "speed_top", "between", "cycle"):
            assert calc[name][index, 0] == pytest.approx(alone[name][0, 0], rel=1e-11)


def test_variants_follow_the_curves_of_variants() -> None:
    handle = CurveHandle(several(), "turned")
    inputs = {
        "inertia": 1.0,
        "stiffness": 1.0,
        "motion": handle,
        "grade": "plain",
        "n_points": 48,
        "ripple": 1.0,
        "duration": 2.5,
        "share": 0.4,
    }
    calc = calculate(MECHANISM, inputs, 3)
    for index in range(3):
        alone = calculate(MECHANISM, inputs | {"motion": CurveHandle(single(index), "turned")})
        np.testing.assert_allclose(calc.curve_samples("grown")[index], alone.curve_samples("grown")[0], atol=1e-12)
        for name in ("cycle", "grown_top", "speed_top", "between"):
            assert calc[name][index, 0] == pytest.approx(alone[name][0, 0], rel=1e-10)


def test_a_sweep_of_a_machine_that_follows_a_curve() -> None:
    calc = follower(made(duration=2), "turned", duration=2)
    found = varied(calc, {"duration": np.array([1.0, 2.0, 4.0])}, ["grown_top"])["grown_top"]
    top = grown(1 / 4 + np.arcsin(2 / TURN) / TURN)  # where the fall outweighs the gain
    assert found == pytest.approx([grown(0.5), top, top + 2], rel=1e-12)
    time, curves = varied_curves(calc, {"duration": 3.0}, ["grown"], 7)
    assert time == pytest.approx(np.linspace(0, 3, 7))
    assert curves["grown"] == pytest.approx(grown(time / 2 * (1 - 1e-15)), abs=1e-12)


def test_what_a_curve_is_laid_over_must_be_above_zero() -> None:
    handle = CurveHandle(made(duration=2), "position")
    values = {
        "inertia": 1.0,
        "stiffness": 1.0,
        "motion": handle,
        "grade": "plain",
        "n_points": 48,
        "ripple": 1.0,
        "duration": 1.0,
        "share": 0.2,
    }
    with pytest.raises(Unproven, match=r"Position \(position\) has no length to run over"):
        calculate(MECHANISM, values | {"rate": -1.0})
    calc = calculate(MECHANISM, values | {"rate": np.array([1.0, -1.0, np.inf])}, 3)
    assert set(calc.flaws) == {1, 2} and calc["cycle"][0, 0] == 1
