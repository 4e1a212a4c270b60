"""The unit in which a quantity is shown: the one that the report chose for it, else one in which its values are easy to read."""

from __future__ import annotations

from collections.abc import Iterable
from math import isfinite
from typing import TYPE_CHECKING

import numpy as np

from diecut_report.contract.inputs import Quantity
from diecut_report.contract.steps import Step
from diecut_report.expressions import Array
from diecut_report.quantities.display import easy_unit
from diecut_report.quantities.formatting import author_digits, shown
from diecut_report.quantities.units import unit

if TYPE_CHECKING:
    from diecut_report.engine.calculation import Calculation


FEW = 20  # values up to which they are looked through one by one


def declared_unit(calc: Calculation, name: str, declared: str) -> str:
    """Return the chosen unit of a quantity, else the declared one."""
    return calc.chosen_units.of(name, declared) or declared


def unit_for(calc: Calculation, name: str, declared: str, values: Array | Iterable[float]) -> str:
    """Return the one unit in which values of a quantity are shown: the greatest of them is easy to read."""
    if chosen := calc.chosen_units.of(name, declared):
        return chosen
    if isinstance(values, np.ndarray) and values.size > FEW:
        sizes = np.abs(values.astype(float)).ravel()
        sizes = sizes[np.isfinite(sizes)]
        return easy_unit(float(sizes.max()), declared) if len(sizes) else declared
    few = np.ravel(values).tolist() if isinstance(values, np.ndarray) else map(float, values)
    return easy_unit(max(known), declared) if (known := [abs(size) for size in few if isfinite(size)]) else declared


def axis_unit(declared: str, heights: Iterable[float]) -> str:
    """Return the unit of what a diagram shows: of forces that in which the greatest of them is told, of anything else the declared one."""
    known = [abs(height) for height in heights if isfinite(height)] if unit(declared).si == "N" else []
    return easy_unit(max(known), declared) if known else declared


def _unit_of(calc: Calculation, name: str, declared: str, value: float) -> str:
    """The same of one number."""
    return calc.chosen_units.of(name, declared) or easy_unit(value, declared)


def step_shown(calc: Calculation, step: Step, value: float) -> dict[str, str]:
    """Return a number that a step gives as text, in its unit."""
    display = _unit_of(calc, step.id, step.unit, value)
    return shown(value, display, author_digits(value, display, step.digits))


def number_unit(calc: Calculation, name: str, declared: Step | Quantity, value: float) -> str:
    """Return the unit of a number inside of a formula: what is typed stands as it was typed."""
    is_typed = name not in calc.values and name not in calc.curves
    return declared_unit(calc, name, declared.unit) if is_typed else _unit_of(calc, name, declared.unit, value)
