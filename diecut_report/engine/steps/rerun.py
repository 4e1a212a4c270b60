"""The same machine calculated again with other inputs: only the steps that the asked quantities need."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from diecut_report.contract.inputs import texts_given
from diecut_report.engine.calculation import Calculation, Impossible, Unproven
from diecut_report.engine.steps.needed import needed
from diecut_report.engine.steps.run import calculate
from diecut_report.expressions import Array


def varied(calc: Calculation, inputs: Mapping[str, Any], names: Sequence[str]) -> dict[str, Array]:
    """Return numbers for other inputs, each of shape (variants,); NaN where the machine is then impossible."""
    count = max((np.size(value) for value in inputs.values() if not isinstance(value, str)), default=1)
    again = _calculated(calc, inputs, count, names)
    if again is None:
        return {name: np.full(count, np.nan) for name in names}
    possible = np.ones(count, dtype=bool)
    possible[list(again.flaws)] = False
    return {name: np.where(possible, again[name][:, 0], np.nan) for name in names}


def varied_curves(
    calc: Calculation, inputs: Mapping[str, Any], names: Sequence[str], points: int
) -> tuple[Array, dict[str, Array]]:
    """Return curves over one abscissa for other inputs, at so many places of the whole of it, ends included.

    NaN where the machine is then impossible.
    """
    again = _calculated(calc, inputs, 1, names)
    axis = calc.axis[names[0]]
    period = float((again or calc).domains[axis].period[0, 0])
    x = np.linspace(0, period, points)
    if again is None:
        return x, dict.fromkeys(names, np.full(points, np.nan))
    places = np.minimum(x, np.nextafter(period, 0))[None, :]
    curves = again.sampler(names[0], places, again.domains[axis].middle_of(places))
    return x, {name: np.broadcast_to(curves[name], places.shape)[0] for name in names}


def _calculated(calc: Calculation, changed: Mapping[str, Any], count: int, names: Sequence[str]) -> Calculation | None:
    inputs = {name: _repeated(value, count) for name, value in calc.inputs.items()}
    for name, value in changed.items():
        inputs[name] = value if isinstance(value, str) else np.broadcast_to(np.asarray(value, dtype=float), (count,))
    only = needed(calc.mechanism, frozenset(inputs) | texts_given(inputs), names)
    try:
        return calculate(calc.mechanism, inputs, count, only)
    except (Impossible, Unproven):
        return None


def _repeated(value: Any, count: int) -> Any:
    return np.repeat(value[:1], count, axis=0) if isinstance(value, np.ndarray) else value


__all__ = ["needed", "varied", "varied_curves"]
