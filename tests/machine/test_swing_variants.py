"""Pieces of an abscissa, and links of unlike period and pieces calculated at once: each is what it is alone."""

from __future__ import annotations

import numpy as np
import pytest

from diecut_report.machine.calculation import CurveHandle, Unproven
from diecut_report.machine.numerics.domain import Domain
from diecut_report.machine.steps.run import calculate, varied, varied_curves
from tests.machine.swing import MECHANISM
from tests.machine.swings import CLOSED, TURN, follower, grown, made, results, several, single

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
