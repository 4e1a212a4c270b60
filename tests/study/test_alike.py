"""Numbers that differ by rounding alone, in ranks and on the front of the best."""

from __future__ import annotations

import numpy as np

from diecut_report.study.analysis.answers import rounded
from diecut_report.study.summary.best import pareto_best


def test_ten_digits_are_kept() -> None:
    given = np.array([0.0, -3.5550900582002396, 1.23456789012e-7, 9.99999999999e20, np.inf, np.nan])
    np.testing.assert_allclose(rounded(given), given, rtol=6e-10)
    assert rounded(np.array([3.5550900582002396]))[0] == rounded(np.array([3.555090058200241]))[0]
    assert rounded(np.array([1.0, 1.000000001])).tolist() == [1.0, 1.000000001]


def test_no_variant_stands_on_the_front_by_rounding() -> None:
    costs = np.array([[151.9, 1.925, 3.555090058200241], [187.3, 2.062, 3.5550900582002396]])
    assert sorted(pareto_best(costs).tolist()) == [0, 1]
    assert pareto_best(rounded(costs)).tolist() == [0]
