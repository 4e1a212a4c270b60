"""Steps over repeated parts (rows), and numbers from standard series and tables, for all variants."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from diecut_report.contract.part_steps import Lookup, Neighbour, Part, Pick, Running, Total
from diecut_report.engine.calculation import Calculation
from diecut_report.expressions import Array
from diecut_report.quantities.units import unit
from diecut_report.standards import StandardSeries, StandardTable

NEUTRAL = {"sum": 0.0, "product": 1.0, "min": np.inf, "max": -np.inf}
REDUCE: dict[str, Any] = {"sum": np.sum, "product": np.prod, "min": np.min, "max": np.max}
SAME = 1e-12  # relative difference within which a quantity is the standard value


def total(calc: Calculation, step: Total) -> None:
    """Sum, product, least or greatest over the parts that count."""
    parts = calc[step.of]
    if step.among:
        parts = np.where(calc[step.among] > 0, parts, NEUTRAL[step.operation])
    calc.values[step.id] = REDUCE[step.operation](parts, axis=1, keepdims=True)


def neighbour(calc: Calculation, step: Neighbour) -> None:
    """The value of the next part, or of the one before, around the loop."""
    calc.values[step.id] = np.roll(calc[step.of], -step.shift, axis=1)


def running(calc: Calculation, step: Running) -> None:
    """Sum or product from the first part up to each."""
    cumulate: Any = np.cumsum if step.operation == "sum" else np.cumprod
    calc.values[step.id] = cumulate(calc[step.of], axis=1)


def part(calc: Calculation, step: Part) -> None:
    """The value of one part."""
    calc.values[step.id] = calc[step.of][:, [step.index]]


def lookup(calc: Calculation, step: Lookup) -> None:
    """A number from a table by a text, a row where there is a text for each part."""
    numbers, display = (
        (step.table.values, step.table.unit) if isinstance(step.table, StandardTable) else (step.table, step.unit)
    )
    text = calc.inputs[step.by]
    found = [numbers[key] * unit(display).factor for key in (text if isinstance(text, tuple) else (text,))]
    calc.values[step.id] = np.tile(np.asarray(found, dtype=float), (calc.count, 1))


def series_of(calc: Calculation, step: Pick) -> tuple[tuple[float, ...], str, StandardSeries | None]:
    """The standard values that a step takes from, ascending; their unit; and the standard series, if it is one."""
    series = step.series[str(calc.inputs[step.by])] if isinstance(step.series, Mapping) else step.series
    if isinstance(series, StandardSeries):
        return series.values, series.unit, series
    return tuple(sorted(series)), step.unit, None


def pick(calc: Calculation, step: Pick) -> None:
    """The standard value; beyond the ends of the series its last one."""
    values, display, _ = series_of(calc, step)
    series: Array = np.asarray(values) * unit(display).factor
    sought = calc[step.of]
    above = np.clip(np.searchsorted(series, sought * (1 - SAME)), 0, len(series) - 1)
    below = np.clip(np.searchsorted(series, sought * (1 + SAME), side="right") - 1, 0, len(series) - 1)
    nearer = np.where(sought - series[below] <= series[above] - sought, below, above)
    calc.branch[step.id] = {"above": above, "below": below, "nearest": nearer}[step.rule]
    calc.values[step.id] = series[calc.branch[step.id]]
