"""Steps over repeated parts (rows), and numbers from standard series, for all variants."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from diecut_report.contract.part_steps import Neighbour, Part, Pick, Running, Total
from diecut_report.engine.calculation import Calculation, Impossible
from diecut_report.engine.steps.lookups import given_of
from diecut_report.expressions import Array
from diecut_report.languages.phrases import Counted, Phrase, phrase
from diecut_report.quantities.formatting import told
from diecut_report.quantities.units import unit
from diecut_report.standards import StandardSeries

NEUTRAL = {"sum": 0.0, "product": 1.0, "min": np.inf, "max": -np.inf}
REDUCE: dict[str, Any] = {"sum": np.sum, "product": np.prod, "min": np.min, "max": np.max}
SAME = 1e-12  # relative difference within which a quantity is the standard value


def total(calc: Calculation, step: Total) -> None:
    """Calculate the sum, product, least or greatest over the parts that count."""
    parts = calc[step.of]
    if step.among:
        parts = np.where(calc[step.among] > 0, parts, NEUTRAL[step.operation])
    calc.values[step.id] = REDUCE[step.operation](parts, axis=1, keepdims=True)


def neighbour(calc: Calculation, step: Neighbour) -> None:
    """Take the value of the next part, or of the one before, around the loop."""
    calc.values[step.id] = np.roll(calc[step.of], -step.shift, axis=1)


def running(calc: Calculation, step: Running) -> None:
    """Calculate the sum or product from the first part up to each."""
    cumulate: Any = np.cumsum if step.operation == "sum" else np.cumprod
    calc.values[step.id] = cumulate(calc[step.of], axis=1)


def part(calc: Calculation, step: Part) -> None:
    """Take the value of one part; a machine whose list is shorter is impossible."""
    count = calc[step.of].shape[1]
    if not -count <= step.index < count:
        which = (
            Phrase("part {number}", number=step.index + 1)
            if step.index >= 0
            else Phrase("part {number} from the last", number=-step.index)
        )
        words = Phrase(
            "has {count}, but {description} ({id}) takes {which}; add what is missing",
            count=Counted(count, "{n} entry", "{n} entries"),
            description=step.description,
            id=step.id,
            which=which,
        )
        raise Impossible([(calc.axis[step.of], words)])
    calc.values[step.id] = calc[step.of][:, [step.index]]


def series_of(calc: Calculation, step: Pick) -> tuple[tuple[float, ...], str, StandardSeries | None]:
    """Return the standard values that a step takes from, ascending; their unit; and the standard series, if it is one."""
    series = step.series[str(calc.inputs[step.by])] if isinstance(step.series, Mapping) else step.series
    if isinstance(series, StandardSeries):
        return series.values, series.unit, series
    return tuple(sorted(series)), step.unit, None


def pick(calc: Calculation, step: Pick) -> None:
    """Take the standard value; beyond the ends of the series its last one, or no machine."""
    given = given_of(calc, step)
    if given is not None:
        calc.values[step.id] = given
        return
    values, display, _ = series_of(calc, step)
    series: Array = np.asarray(values) * unit(display).factor
    sought = calc[step.of]
    if step.beyond == "impossible":
        _within(calc, step, sought, series)
    above = np.clip(np.searchsorted(series, sought * (1 - SAME)), 0, len(series) - 1)
    below = np.clip(np.searchsorted(series, sought * (1 + SAME), side="right") - 1, 0, len(series) - 1)
    nearer = np.where(sought - series[below] <= series[above] - sought, below, above)
    calc.branch[step.id] = {"above": above, "below": below, "nearest": nearer}[step.rule]
    calc.values[step.id] = series[calc.branch[step.id]]


def _within(calc: Calculation, step: Pick, sought: Array, series: Array) -> None:
    """Refuse a machine for which the series has no value by the rule: what is sought lies beyond its end; mark such variants."""
    over = sought > series[-1] * (1 + SAME) if step.rule != "below" else np.zeros_like(sought, dtype=bool)
    under = sought < series[0] * (1 - SAME) if step.rule != "above" else np.zeros_like(sought, dtype=bool)
    for variant in np.flatnonzero((over | under).any(axis=1)):
        part = int(np.argmax(over[variant] | under[variant]))
        end = (
            Phrase("the greatest value is {value}", value=told(series[-1], step.unit))
            if over[variant, part]
            else Phrase("the least value is {value}", value=told(series[0], step.unit))
        )
        title = getattr(series_of(calc, step)[2], "title", phrase("the series"))
        words = Phrase(
            "{description} ({id}): {sought} is beyond {title}, of which {end}",
            description=step.description,
            id=step.id,
            sought=_sought(calc, step, float(sought[variant, part])),
            title=title,
            end=end,
        )
        key = step.key or step.of.removeprefix("inputs.")
        if calc.count == 1:
            raise Impossible([(key if step.key or key in calc.inputs else "", words)])
        calc.flaws.setdefault(int(variant), (step.key or step.id, words))


def _sought(calc: Calculation, step: Pick, value: float) -> str:
    """Return what a step picks by, with its symbol and value."""
    declared = calc.step_or_input(step.of)
    return f"{declared.description}, {declared.symbol} = {told(value, declared.unit)},"
