"""Numbers from the rows of tables: by a text, by a number that the row has, or as they are given."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.contract.part_steps import Lookup, Pick
from diecut_report.contract.place import Misdeclared
from diecut_report.engine.calculation import Calculation
from diecut_report.engine.steps.feasibility import refuse
from diecut_report.engine.steps.soundness import possible
from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.quantities.formatting import number_text, with_unit
from diecut_report.quantities.units import unit
from diecut_report.standards import Column

SAME = 1e-9  # relative difference within which a number is that of a row
MOST_DIGITS = 17
SHOWN_NUMBERS = 6  # of those that a table has, the nearest ones


def lookup(calc: Calculation, step: Lookup) -> None:
    """Take a number from a row of a table, or as it is given; a row where there is a text or a number for each part."""
    given = given_of(calc, step)
    if isinstance(given, np.ndarray):
        calc.values[step.id] = given
        return
    found = _by_number(calc, step, given) if step.is_by_number else _by_text(calc, step)
    for part, value in enumerate(given or ()):
        if value is not None:
            found[:, part] = value
    calc.values[step.id] = found


def given_of(calc: Calculation, step: Lookup | Pick) -> Any:
    """Return what is given in place of the table's number: of all parts, or a tuple with None for those without; None where nothing is."""
    return calc.inputs.get(step.given.removeprefix("inputs.")) if step.given else None


def text_of(calc: Calculation, step: Lookup) -> Any:
    """Return the text by which a row is taken: of an input (a tuple of those of parts), or what was calculated of many machines, an array."""
    return calc.values[step.by] if step.by in calc.steps else calc.inputs[step.by]


def _by_text(calc: Calculation, step: Lookup) -> Array:
    numbers, display = step.rows()
    text = text_of(calc, step)
    if isinstance(text, np.ndarray):
        return _by_found(calc, step, text)
    found = [
        np.nan if key is None else numbers[key] * unit(display).factor
        for key in (text if isinstance(text, tuple) else (text,))
    ]
    return np.tile(np.asarray(found, dtype=float), (calc.count, 1))


def _by_found(calc: Calculation, step: Lookup, texts: Array) -> Array:
    """The numbers of rows whose names were found, NaN without one; Misdeclared where a machine that can be has another name."""
    numbers, display = step.rows()
    strange = next((text for text in texts[possible(calc)].flat if isinstance(text, str) and text not in numbers), None)
    if strange is not None:
        words = "step {id}: {by} is {text}, which is not a row of its table; the rows are {rows}"
        filling = {"id": step.id, "by": step.by, "text": repr(strange), "rows": ", ".join(numbers)}
        raise Misdeclared(Phrase(words, filling), calc.steps[step.by].at)
    found = np.array([numbers.get(text, np.nan) for text in texts.flat], dtype=float)
    return found.reshape(texts.shape) * unit(display).factor


def _by_number(calc: Calculation, step: Lookup, given: Any) -> Array:
    """The number of the row that has exactly what is sought; a machine for which no row has it is refused, or marked among several."""
    own, taken, sought = step.sought, step.of_number(), calc[step.by]
    numbers = np.asarray(own.values) * unit(own.unit).factor
    row = np.abs(sought[..., None] - numbers).argmin(axis=-1)
    missing = np.abs(sought - numbers[row]) > SAME * np.abs(numbers[row])  # not where there is nothing to seek by
    for part, value in enumerate(given or ()):
        missing[:, part] &= value is None
    for variant in np.flatnonzero(missing.any(axis=1)):
        _refused(calc, step, int(variant), int(np.argmax(missing[variant])))
    return np.where(missing | np.isnan(sought), np.nan, (np.asarray(taken.values) * unit(taken.unit).factor)[row])


def _refused(calc: Calculation, step: Lookup, variant: int, part: int) -> None:
    key = step.key or step.by.removeprefix("inputs.")
    home = calc.axis.get(step.id)
    if home and key.startswith(f"{home}."):
        key = f"{home}.{part}{key.removeprefix(home)}"
    refuse(calc, variant, key, "" if calc.is_partial else _said(calc, step, float(calc[step.by][variant, part])))


def _said(calc: Calculation, step: Lookup, value: float) -> Phrase:
    """What no row has, and what the rows next to it have."""
    own, declared = step.sought, calc.step_or_input(step.by)
    filling = {
        "symbol": declared.symbol,
        "value": with_unit(number_text(value / unit(own.unit).factor), own.unit),
        "table": phrase(getattr(step.table, "title", "")),
        "description": phrase(step.description),
        "taken": step.symbol,
        "rows": _nearest(own, value / unit(own.unit).factor),
    }
    if step.by in calc.steps or step.key:
        return Phrase(
            "leads to {symbol} = {value}, which no row of the table “{table}” has for {description} ({taken}); the nearest have {rows}",
            filling,
        )
    return Phrase(
        "is {symbol} = {value}, which no row of the table “{table}” has for {description} ({taken}); the nearest have {rows}",
        filling,
    )


def _nearest(own: Column, value: float) -> str:
    near = sorted(sorted(set(own.values), key=lambda each: abs(each - value))[:SHOWN_NUMBERS])
    return with_unit(", ".join(number_text(each, MOST_DIGITS) for each in near), own.unit)
