"""Formulas that any calculation needs: comparison, sum and difference, the quantity itself."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.expressions import formula


@formula
def same(quantity: Any) -> Any:
    """The quantity itself."""
    return quantity


@formula
def zero() -> Any:
    """Zero."""
    return 0


@formula
def is_below(smaller: Any, greater: Any) -> Any:
    """Whether one quantity is below another."""
    return smaller < greater


@formula
def is_at_most(smaller: Any, greater: Any) -> Any:
    """Whether one quantity is not above another."""
    return smaller <= greater


@formula
def is_positive(quantity: Any) -> Any:
    """Whether a quantity is not negative."""
    return quantity >= 0


@formula
def difference(greater: Any, smaller: Any) -> Any:
    """Difference of two quantities."""
    return greater - smaller


@formula
def sum_of(first: Any, second: Any) -> Any:
    """Sum of two quantities."""
    return first + second


@formula
def size_of(quantity: Any) -> Any:
    """Absolute value."""
    return abs(quantity)


@formula
def twice(quantity: Any) -> Any:
    """Twice the quantity."""
    return 2 * quantity


@formula
def smaller_of(first: Any, second: Any) -> Any:
    """The smaller of two quantities."""
    return np.minimum(first, second)


@formula
def moment(force: Any, arm: Any) -> Any:
    """Moment of a force on an arm."""
    return force * arm


@formula
def one() -> Any:
    """One."""
    return 1


@formula
def product(first: Any, second: Any) -> Any:
    """Product of two quantities."""
    return first * second


@formula
def quotient(quantity: Any, by: Any) -> Any:
    """Quotient of two quantities."""
    return quantity / by


@formula
def over_product(quantity: Any, first: Any, second: Any) -> Any:
    """A quantity over the product of two others."""
    return quantity / (first * second)


@formula
def half(quantity: Any) -> Any:
    """Half the quantity."""
    return quantity / 2


@formula
def greater_of(first: Any, second: Any) -> Any:
    """The greater of two quantities."""
    return np.maximum(first, second)


@formula
def is_at_least(greater: Any, smaller: Any) -> Any:
    """Whether one quantity is not below another."""
    return greater >= smaller


@formula
def relative_size(quantity: Any, scale: Any) -> Any:
    """Size of a quantity to another one."""
    return abs(quantity) / scale


@formula
def rounded_up(quantity: Any, step: Any) -> Any:
    """The next multiple of a step; 1e-9 of a step below, so that what is a multiple stays as it is."""
    return step * np.ceil(quantity / step - 1e-9)


@formula
def just_inside(share: Any, middle: Any) -> Any:
    """A share, moved towards the middle of its piece by next to nothing: a jump at the piece's end is taken from inside."""
    return share + 1e-12 * (middle - share)
