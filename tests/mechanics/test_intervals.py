"""Intervals of a periodic quantity against membership at many places."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from diecut_report.mechanics.intervals import Interval, in_order, left_out
from tests.examples import examples

PERIOD = 7.0
PLACES = np.linspace(0, PERIOD, 701)[:-1] + 0.0037

quarters = st.integers(-40, 40).map(lambda n: n / 4)
spans = st.lists(
    st.tuples(quarters, st.integers(0, 28).map(lambda n: n / 4)).map(lambda s: (s[0], s[0] + s[1])), max_size=5
)


def covered(intervals: list[Interval]) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
    """Which places lie in one of the intervals, a period earlier or later."""
    return np.array([any(np.mod(x - a, PERIOD) < b - a for a, b in intervals) for x in PLACES])


@examples(100)
@given(spans)
def test_ordered_intervals_cover_what_the_spans_cover(given_spans: list[Interval]) -> None:
    found = in_order(given_spans, PERIOD)
    assert np.array_equal(covered(found), covered(given_spans))
    assert all(0 <= a < PERIOD and a < b <= a + PERIOD for a, b in found)
    assert all(one[1] < other[0] for one, other in pairwise(found))
    assert len(found) < 2 or found[-1][1] - PERIOD < found[0][0]


@examples(100)
@given(spans)
def test_what_is_left_out_is_what_is_not_covered(given_spans: list[Interval]) -> None:
    found = in_order(given_spans, PERIOD)
    rest = left_out(found, PERIOD)
    assert np.array_equal(covered(rest), ~covered(found))
    assert left_out(rest, PERIOD) == found


def test_a_span_that_ends_before_it_begins_ends_a_period_later() -> None:
    assert in_order([(6.0, 1.0)], PERIOD) == [(6.0, 8.0)]


def test_edges_that_rounding_sets_apart_touch() -> None:
    assert in_order([(1.0, 2.0), (2.0 + 1e-13, 3.0), (-1e-14, 0.5)], PERIOD) == [(0.0, 0.5 + 1e-14), (1.0, 3.0)]
