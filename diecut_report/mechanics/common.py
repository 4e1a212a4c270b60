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
