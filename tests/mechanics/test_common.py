"""Comparison, sum and difference: what the name of each formula says, at the borders too."""

from __future__ import annotations

import numpy as np

from diecut_report.mechanics import common


def test_positive_is_above_zero() -> None:
    assert common.is_positive(np.array([-1.0, -0.0, 0.0, 5e-324, 1.0])).tolist() == [False, False, False, True, True]


def test_comparisons_say_which_side_equality_is_on() -> None:
    small, great = np.array([1.0, 2.0, 3.0]), np.array([2.0, 2.0, 2.0])
    assert common.is_below(smaller=small, greater=great).tolist() == [True, False, False]
    assert common.is_at_most(smaller=small, greater=great).tolist() == [True, True, False]
    assert common.is_at_least(greater=great, smaller=small).tolist() == [True, True, False]


def test_a_difference_may_have_either_sign() -> None:
    assert common.difference(quantity=3.0, less=1.0) == 2.0
    assert common.difference(quantity=1.0, less=3.0) == -2.0
