"""Formulas that any calculation needs: comparison, sum and difference, the quantity itself."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.formulas.expression import arccos
from diecut_report.formulas.formula import formula


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
    """Whether a quantity is above zero."""
    return quantity > 0


@formula
def difference(quantity: Any, less: Any) -> Any:
    """One quantity less another, of either sign."""
    return quantity - less


@formula
def sum_of(first: Any, second: Any) -> Any:
    """Sum of two quantities."""
    return first + second


@formula
def product(first: Any, second: Any) -> Any:
    """Product of two quantities."""
    return first * second


@formula
def quotient(quantity: Any, by: Any) -> Any:
    """Quotient of two quantities."""
    return quantity / by


@formula
def is_at_least(greater: Any, smaller: Any) -> Any:
    """Whether one quantity is not below another."""
    return greater >= smaller


@formula
def rounded_up(quantity: Any, step: Any) -> Any:
    """The next multiple of a step; 1e-9 of a step below, so that what is a multiple stays as it is."""
    return step * np.ceil(quantity / step - 1e-9)


# The law of cosines.


@formula
def enclosed_angle(one_side: Any, other_side: Any, opposite_side: Any) -> Any:
    """Angle between two sides of a triangle (law of cosines)."""
    return arccos((one_side**2 + other_side**2 - opposite_side**2) / (2 * one_side * other_side))
