"""Chebyshev series of many pieces at many places, in blocks that stay in the processor's cache."""

from __future__ import annotations

import numpy as np

from diecut_report.expressions import Array

BLOCK = 8192  # places at once


def at_places(terms: Array, piece: Array, x: Array) -> Array:
    """Return the series of pieces at places x in [-1, 1] (rows, points), by Clenshaw's recurrence.

    ``terms`` (degrees, pieces) are the coefficients, ``piece`` (rows, points), or (rows, 1) where a row lies in a single one.
    """
    found = np.empty(x.shape)
    size = max(1, BLOCK // max(1, x.shape[1]))
    for start in range(0, len(x), size):
        part = slice(start, start + size)
        found[part] = _summed(terms, np.ascontiguousarray(piece[part]), x[part])
    return found


def _summed(terms: Array, piece: Array, x: Array) -> Array:
    twice, product = 2 * x, np.empty(x.shape)
    after, here = np.zeros((2, *x.shape))
    own = terms.take(piece, axis=1)
    for coefficients in own[:0:-1]:
        np.multiply(twice, here, product)  # named arguments take as long as a few places
        np.subtract(product, after, after)
        np.add(after, coefficients, after)
        after, here = here, after
    np.multiply(x, here, product)
    product -= after
    product += own[0]
    return product


def of_legendre(count: int) -> Array:
    """Return the matrix that makes Chebyshev coefficients of so many Legendre coefficients.

    P_n(cos t) is the sum over k of a_k a_(n-k) cos((n-2k) t), where a_k = (1·3·…·(2k-1)) / (2·4·…·2k): no term is a difference.
    """
    shares = np.cumprod(np.concatenate([[1.0], (np.arange(1, count) - 0.5) / np.arange(1, count)]))
    found = np.zeros((count, count))
    for degree in range(count):
        for k in range(degree + 1):
            found[abs(degree - 2 * k), degree] += shares[k] * shares[degree - k]
    return found
