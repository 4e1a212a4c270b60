"""Sums of Chebyshev polynomials against NumPy's own, and Legendre coefficients carried over to them by way of powers."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.polynomial import chebyshev, legendre

from diecut_report.mechanics import numerics


@pytest.mark.parametrize("count", [1, 2, 3, 8])
@pytest.mark.parametrize("shape", [(1, 1), (5, 3), (3, numerics.BLOCK - 1), (numerics.BLOCK + 1, 1)])
def test_each_place_has_the_series_of_its_piece(count: int, shape: tuple[int, int]) -> None:
    draw = np.random.default_rng(5)
    terms, x, piece = draw.normal(size=(count, 4)), draw.uniform(-1, 1, shape), draw.integers(0, 4, shape)
    expected = np.choose(piece, [chebyshev.chebval(x, terms[:, each]) for each in range(4)])
    np.testing.assert_allclose(numerics.at_places(terms, piece, x), expected, rtol=1e-12, atol=1e-13)
    np.testing.assert_array_equal(
        numerics.at_places(terms, piece[:, :1], x),
        numerics.at_places(terms, np.broadcast_to(piece[:, :1], shape), x),
    )


@pytest.mark.parametrize("count", [1, 2, 3, 9])
def test_legendre_coefficients_are_carried_over(count: int) -> None:
    found = numerics.of_legendre(count)
    for degree in range(count):
        of_powers = chebyshev.poly2cheb(legendre.leg2poly(np.eye(count)[degree]))
        np.testing.assert_allclose(found[:, degree], np.pad(of_powers, (0, count - len(of_powers))), atol=1e-14)
