"""Sets on a circle, margins, the best offset and the largest productivity, against brute force; printed numbers: tests/plugins/test_cyclogram.py."""

from __future__ import annotations

from fractions import Fraction
from math import inf

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from diecut_report.mechanics.timing import intervals
from diecut_report.mechanics.timing.intervals import DrivenLine, Intervals, common_period, composed, exact_turns
from diecut_report.mechanics.timing.productivity import (
    Interlock,
    fixed_productivity_limit,
    productivity_limit,
    tents_of,
)
from tests.examples import examples
from tests.mechanics.timing.example_press import COMMON, PERIOD, TURN, dwell, in_degrees, phase

MS = 1e-3


def interlocks(transport: str, names: str, offset: float = 0.0, cut: float = 0.0, pas: float = 0.0) -> list[Interlock]:
    """The interlocks of the example press; required margins in ms."""
    all_of = {
        "cutting": Interlock("cutting", phase("cutting"), dwell(transport, offset), "outer", margin_time=cut * MS),
        "contact": Interlock("contact", phase("contact"), dwell(transport, offset), "outer", margin_time=cut * MS),
        "passing": Interlock(
            "passing", phase(f"{transport}_passing", offset), phase("carriage_window"), "inner", margin_time=pas * MS
        ),
    }
    return [all_of[name] for name in names.split()]


ROWS = [
    ("cam", "cutting", None),
    ("cam", "contact", None),
    ("cam", "passing", (128.3884, 147.8444)),
    ("cam", "cutting passing", None),
    ("cam", "contact passing", None),
    ("geneva", "cutting", (24.8365, 57.1747)),
    ("geneva", "contact", (29.5301, 51.7238)),
    ("geneva", "passing", (26.7891, 49.4437)),
    ("geneva", "cutting passing", (26.7891, 49.4437)),
    ("geneva", "contact passing", (29.5301, 49.4437)),
]


@pytest.mark.parametrize("transport, names, feasible", ROWS)
def test_no_offset_of_a_grid_is_better_and_the_margins_there_are_the_slack(
    transport: str, names: str, feasible: tuple[float, float] | None
) -> None:
    def at(degrees: float) -> float:
        return min(least(each.inner, each.outer, PERIOD) for each in interlocks(transport, names, degrees))

    found = intervals.best_offset(tents_of(interlocks(transport, names), PERIOD, 1.0), TURN)
    assert at(float(np.degrees(found.shift))) == pytest.approx(found.slack, abs=1e-9)
    grid = np.array([at(degrees) for degrees in np.arange(0, 360, 0.5)])
    assert grid.max() <= found.slack + 1e-9
    assert grid.max() >= found.slack - np.radians(0.25) - 1e-9
    inside = [
        0 <= degrees - feasible[0] <= feasible[1] - feasible[0] if feasible else False
        for degrees in np.arange(0, 360, 0.5)
    ]
    assert list(grid >= 0) == inside


def least(inner: Intervals, outer: Intervals, period: float) -> float:
    """The least margin of all."""
    pair = intervals.worst(intervals.margins_within(inner, outer, period))
    return inf if pair is None else pair.least


PAIRS = [
    ("cam", 141.0056, "cutting", [(-23.8309, -6.8923), (7.0202, -23.8309)]),
    ("cam", 141.0056, "passing", [(13.7269, 24.7424), (12.6172, 6.8388)]),
    ("geneva", 38.1164, "cutting", [(19.0583, 30.2185), (49.9093, 13.2799)]),
    ("geneva", 38.1164, "passing", [(12.4370, 29.2308), (11.3273, 11.3273)]),
]


@pytest.mark.parametrize("transport, offset, name, expected", PAIRS)
def test_the_margins_of_each_interval_are_the_printed_ones(
    transport: str, offset: float, name: str, expected: list[tuple[float, float]]
) -> None:
    (lock,) = interlocks(transport, name, offset)
    found = intervals.margins_within(lock.inner, lock.outer, PERIOD)
    degrees = sorted((float(np.degrees(pair.start)), float(np.degrees(pair.end))) for pair in found)
    assert degrees == [pytest.approx(pair, abs=3e-4) for pair in sorted(expected)]


@pytest.mark.parametrize("name, expected", [("cutting", 207.6618), ("contact", 217.8062)])
def test_the_needed_dwell_covers_both_strokes_laid_over_one_another(name: str, expected: float) -> None:
    (lock,) = interlocks("cam", name)
    found = intervals.needed_length(np.radians(160), tents_of([lock], PERIOD, 0.0), TURN)
    assert np.degrees(found) == pytest.approx(expected, abs=2e-4)
    both = intervals.merged(phase(name), TURN)
    assert intervals.total_length(both) == pytest.approx(found, abs=1e-9)


def test_at_the_largest_productivity_an_offset_just_remains() -> None:
    locks = interlocks("geneva", "cutting passing", 0.0, 15, 5)
    limit = productivity_limit(locks, PERIOD, TURN).value
    assert limit is not None
    slack = [intervals.best_offset(tents_of(locks, PERIOD, limit * by), TURN).slack for by in (1 - 1e-6, 1 + 1e-6)]
    assert slack[0] > 0 > slack[1]
    assert max(map(abs, slack)) < 1e-5


def test_without_a_margin_of_time_no_productivity_is_too_large() -> None:
    locks = interlocks("geneva", "cutting passing")
    for found in (productivity_limit(locks, PERIOD, TURN), fixed_productivity_limit(locks, PERIOD)):
        assert found.reason in ("no_time_margin", "angles_decide")
    assert productivity_limit(locks, PERIOD, TURN).reason == "no_time_margin"


def test_an_interlock_apart_from_the_line_limits_productivity_too() -> None:
    still = Interlock("still", ((1.0, 2.0),), ((0.5, 2.5),), None, margin_time=0.02)
    found = productivity_limit([*interlocks("geneva", "cutting", 0.0, 10), still], PERIOD, TURN)
    assert found.value == pytest.approx(0.5 / (TURN * 0.02))
    fails = Interlock("fails", ((1.0, 2.0),), ((1.5, 2.5),), None)
    assert (
        productivity_limit([*interlocks("geneva", "cutting", 0.0, 10), fails], PERIOD, TURN).reason == "angles_decide"
    )


def test_nothing_lies_within_an_empty_set_and_everything_within_the_circle() -> None:
    one: Intervals = ((1.0, 2.0),)
    assert least(one, (), 5.0) == -inf
    assert least(one, ((0.0, 5.0),), 5.0) == inf
    assert least(((0.0, 5.0),), one, 5.0) == -inf
    assert intervals.best_offset(intervals.tents(one, (), 5.0, "inner"), 5.0).slack == -inf
    assert intervals.best_offset(intervals.tents(((0.0, 5.0),), one, 5.0, "inner"), 5.0) == intervals.BestOffset(
        0.0, -inf, ()
    )
    assert intervals.best_offset(intervals.tents(one, ((0.0, 5.0),), 5.0, "inner"), 5.0) == intervals.BestOffset(
        0.0, inf, ((0.0, 5.0),)
    )
    assert intervals.worst(()) is None


WHOLE = 24  # places on the circle of the random sets; edges at whole and margins at half places are met exactly
sets = st.lists(st.tuples(st.integers(0, WHOLE - 1), st.integers(1, 10)), min_size=1, max_size=3).map(
    lambda given: intervals.merged(((float(a), float(a + b)) for a, b in given), WHOLE)
)


@given(one=sets, other=sets)
@examples(200)
def test_a_margin_is_what_an_interval_can_grow_within_the_other_set(one: Intervals, other: Intervals) -> None:
    for pair in intervals.margins_within(one, other, WHOLE):
        start, end = pair.inner
        grown = [k / 2 for k in range(-2 * WHOLE, 2 * WHOLE) if end - start + k > 0]
        holds = [by for by in grown if _is_inside((start - by, end + by), other)]
        if np.isfinite(pair.least) and pair.least > -(end - start) / 2:
            assert max(holds) == pytest.approx(pair.least)
        elif pair.least == -inf:
            assert not other or intervals.is_whole(one, WHOLE)


def _is_inside(pair: tuple[float, float], other: Intervals) -> bool:
    shifts = (-2 * WHOLE, -WHOLE, 0, WHOLE, 2 * WHOLE)
    return any(start + k <= pair[0] and pair[1] <= end + k for start, end in other for k in shifts)


@given(inner=sets, outer=sets, second=sets, moved=st.sampled_from(["inner", "outer"]), margin=st.integers(0, 2))
@examples(200)
def test_the_best_shift_is_that_of_brute_force(
    inner: Intervals, outer: Intervals, second: Intervals, moved: intervals.Moved, margin: int
) -> None:
    rows = (
        *intervals.tents(inner, outer, WHOLE, moved, margin),
        *intervals.tents(second, outer, WHOLE, "inner" if moved == "inner" else "outer", 0),
    )

    def at(shift: float) -> float:
        moves = (lambda each: intervals.shifted(each, shift, WHOLE), lambda each: each)
        of_inner, of_outer = moves if moved == "inner" else moves[::-1]
        return min(
            least(of_inner(inner), of_outer(outer), WHOLE) - margin, least(of_inner(second), of_outer(outer), WHOLE)
        )

    found = intervals.best_offset(rows, WHOLE)
    quarters = [at(k / 4) for k in range(4 * WHOLE)]
    assert found.slack == pytest.approx(max(quarters))
    if np.isfinite(found.slack):
        assert at(found.shift) == pytest.approx(found.slack)
        assert found.shift == next(k / 4 for k in range(4 * WHOLE) if quarters[k] >= max(quarters) - 1e-9)
        feasible = [any(a <= k / 4 <= b for a, b in found.feasible) for k in range(4 * WHOLE)]
        assert feasible == [each >= -1e-9 for each in quarters]


SHEET_PERIOD = 24
pairs = st.lists(
    st.tuples(st.integers(-60, 60), st.integers(0, 30)).map(lambda pair: (float(pair[0]), float(sum(pair)))), max_size=6
)


def places(of: list[tuple[float, float]] | Intervals) -> set[int]:
    """The unit cells of the circle that pairs of whole numbers cover."""
    return {cell % SHEET_PERIOD for start, end in of for cell in range(round(start), round(end))}


def assert_ordered(found: Intervals) -> None:
    assert all(0 <= start < SHEET_PERIOD and start < end <= start + SHEET_PERIOD for start, end in found)
    edges = [edge for pair in found for edge in pair]
    assert edges == sorted(set(edges)), "sorted, disjoint, none that touch"
    assert not found or len(found) == 1 or edges[-1] - SHEET_PERIOD < edges[0], "the seam does not part an interval"


@given(one=pairs)
@examples(200)
def test_a_merged_set_covers_the_same_places_in_order(one: list[tuple[float, float]]) -> None:
    found = intervals.merged(one, SHEET_PERIOD)
    assert_ordered(found)
    assert places(found) == places(one)
    assert intervals.total_length(found) == pytest.approx(len(places(one)))
    assert intervals.is_whole(found, SHEET_PERIOD) == (len(places(one)) == SHEET_PERIOD)


@given(one=pairs, other=pairs, by=st.integers(-50, 50))
@examples(200)
def test_sets_are_combined_as_sets_of_places(
    one: list[tuple[float, float]], other: list[tuple[float, float]], by: int
) -> None:
    a, b = intervals.merged(one, SHEET_PERIOD), intervals.merged(other, SHEET_PERIOD)
    everywhere = set(range(SHEET_PERIOD))
    for found, expected in (
        (intervals.complement(a, SHEET_PERIOD), everywhere - places(one)),
        (intervals.union(a, b, SHEET_PERIOD), places(one) | places(other)),
        (intervals.intersection(a, b, SHEET_PERIOD), places(one) & places(other)),
        (intervals.shifted(a, by, SHEET_PERIOD), {(place + by) % SHEET_PERIOD for place in places(one)}),
    ):
        assert_ordered(found)
        assert places(found) == expected
    assert places(a) == places(one)


@given(one=pairs)
@examples(50)
def test_a_set_that_repeats_holds_at_each_turn_what_it_holds_at_one(one: list[tuple[float, float]]) -> None:
    a = intervals.merged(one, SHEET_PERIOD)
    found = intervals.repeated(a, SHEET_PERIOD, 3 * SHEET_PERIOD)
    cells = {cell % (3 * SHEET_PERIOD) for start, end in found for cell in range(round(start), round(end))}
    assert cells == {place for place in range(3 * SHEET_PERIOD) if place % SHEET_PERIOD in places(one)}


def test_rounding_neither_parts_nor_adds_an_interval_at_the_seam() -> None:
    third = SHEET_PERIOD / 3
    assert intervals.merged(
        [(0, third), (third * 1.0000000000000002, 2 * third), (2 * third, SHEET_PERIOD - 1e-14)], SHEET_PERIOD
    ) == ((0.0, SHEET_PERIOD),)
    assert intervals.merged([(-1e-15, 2.0)], SHEET_PERIOD) == (pytest.approx((0.0, 2.0)),)


@pytest.mark.parametrize(
    "typed, expected",
    [(1, "1"), (0.5, "1/2"), (Fraction(1, 2), "1/2"), (1 / 3, "1/3"), (63 / 64, "63/64"), (2.75, "11/4")],
)
def test_turns_are_taken_as_the_fraction_they_are(typed: float, expected: str) -> None:
    assert exact_turns(typed) == Fraction(expected)


@pytest.mark.parametrize("typed", [0, -1, -0.5, 1 / 65, 0.1234567, 1e-9])
def test_turns_without_a_small_fraction_are_refused(typed: float) -> None:
    with pytest.raises(ValueError, match="not a fraction above zero with a denominator of at most 64"):
        exact_turns(typed)


@given(turns=st.lists(st.fractions(Fraction(1, 8), 8, max_denominator=8), min_size=1, max_size=4))
@examples(100)
def test_the_common_period_is_the_first_at_which_all_lines_are_whole(turns: list[Fraction]) -> None:
    found = common_period([1 / each for each in turns])
    wholes = (k / turns[0] for k in range(1, 10**6))  # turns of the main shaft after which the first line is whole
    assert next(whole for whole in wholes if all((whole * each).denominator == 1 for each in turns)) == found


@pytest.mark.parametrize(
    "name, expected",
    [
        ("forward", [(37.6086, 406.1661)]),
        ("cutting", [(117.1747, 307.8979), (508.0258, 684.8365)]),
        ("contact", [(111.7238, 314.1021), (501.5482, 689.5301)]),
        ("carriage_window", [(10.6152, 65.6176), (369.5054, 443.5212)]),
    ],
)
def test_the_phases_of_the_cylinder_stand_on_the_main_shaft(name: str, expected: list[tuple[float, float]]) -> None:
    assert in_degrees(phase(name)) == [pytest.approx(pair, abs=2e-4) for pair in expected]


def test_an_offset_and_every_second_turn_are_counted_on_the_main_shaft() -> None:
    line = DrivenLine(Fraction(1), 1.0)
    assert line.on_main_shaft(((6.0, 6.5),), COMMON, every=2) == (pytest.approx((7.0, 7.5)),)
    assert line.on_main_shaft(((6.0, 6.5),), COMMON) == (
        pytest.approx((7.0 - 2 * 3.141592653589793, 7.5 - 2 * 3.141592653589793)),
        pytest.approx((7.0, 7.5)),
    )


def test_a_set_that_is_others_together_is_told_with_these() -> None:
    sets = {
        "a": frozenset({1}),
        "b": frozenset({2}),
        "both": frozenset({1, 2}),
        "again": frozenset({2}),
        "other": frozenset({2, 3}),
    }
    assert composed(sets) == {"both": ("a", "b", "again"), "again": ("b",)}
