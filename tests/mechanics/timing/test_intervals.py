"""Sets on a circle, against a set of whole places on it."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from diecut_report.mechanics.timing import intervals
from diecut_report.mechanics.timing.intervals import DrivenLine, Intervals, common_period, composed, exact_turns
from tests.examples import examples
from tests.mechanics.timing.example_press import COMMON, in_degrees, phase

PERIOD = 24
pairs = st.lists(
    st.tuples(st.integers(-60, 60), st.integers(0, 30)).map(lambda pair: (float(pair[0]), float(sum(pair)))), max_size=6
)


def places(of: list[tuple[float, float]] | Intervals) -> set[int]:
    """The unit cells of the circle that pairs of whole numbers cover."""
    return {cell % PERIOD for start, end in of for cell in range(round(start), round(end))}


def assert_ordered(found: Intervals) -> None:
    assert all(0 <= start < PERIOD and start < end <= start + PERIOD for start, end in found)
    edges = [edge for pair in found for edge in pair]
    assert edges == sorted(set(edges)), "sorted, disjoint, none that touch"
    assert not found or len(found) == 1 or edges[-1] - PERIOD < edges[0], "the seam does not part an interval"


@given(one=pairs)
@examples(200)
def test_a_merged_set_covers_the_same_places_in_order(one: list[tuple[float, float]]) -> None:
    found = intervals.merged(one, PERIOD)
    assert_ordered(found)
    assert places(found) == places(one)
    assert intervals.total_length(found) == pytest.approx(len(places(one)))
    assert intervals.is_whole(found, PERIOD) == (len(places(one)) == PERIOD)


@given(one=pairs, other=pairs, by=st.integers(-50, 50))
@examples(200)
def test_sets_are_combined_as_sets_of_places(
    one: list[tuple[float, float]], other: list[tuple[float, float]], by: int
) -> None:
    a, b = intervals.merged(one, PERIOD), intervals.merged(other, PERIOD)
    everywhere = set(range(PERIOD))
    for found, expected in (
        (intervals.complement(a, PERIOD), everywhere - places(one)),
        (intervals.union(a, b, PERIOD), places(one) | places(other)),
        (intervals.intersection(a, b, PERIOD), places(one) & places(other)),
        (intervals.shifted(a, by, PERIOD), {(place + by) % PERIOD for place in places(one)}),
    ):
        assert_ordered(found)
        assert places(found) == expected
    assert places(a) == places(one)


@given(one=pairs)
@examples(50)
def test_a_set_that_repeats_holds_at_each_turn_what_it_holds_at_one(one: list[tuple[float, float]]) -> None:
    a = intervals.merged(one, PERIOD)
    found = intervals.repeated(a, PERIOD, 3 * PERIOD)
    cells = {cell % (3 * PERIOD) for start, end in found for cell in range(round(start), round(end))}
    assert cells == {place for place in range(3 * PERIOD) if place % PERIOD in places(one)}


def test_rounding_neither_parts_nor_adds_an_interval_at_the_seam() -> None:
    third = PERIOD / 3
    assert intervals.merged(
        [(0, third), (third * 1.0000000000000002, 2 * third), (2 * third, PERIOD - 1e-14)], PERIOD
    ) == ((0.0, PERIOD),)
    assert intervals.merged([(-1e-15, 2.0)], PERIOD) == (pytest.approx((0.0, 2.0)),)


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
