"""Numbers from the rows of tables: by a text, by a number that the row has, or as they are given."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.numerics import extremes, roots_integrals
from diecut_report.machine.steps.soundness import possible, refuse
from diecut_report.mechanism.names import Misdeclared
from diecut_report.mechanism.part_steps import Interpolated, Lookup, Pick
from diecut_report.quantities.formatting import DIGITS, number_text, with_unit
from diecut_report.quantities.units import unit
from diecut_report.standards.tables import Column
from diecut_report.text.phrases import Phrase, phrase

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


# Values between the rows of a table: where they have corners, and machines that lie outside of the table.


INTERPOLATION_SAME = 1e-12  # of the table's range: beyond its ends by no more is rounding


def interpolated(calc: Calculation, step: Interpolated) -> None:
    """Interpolate at each machine's quantity, or along its curve; a machine outside of the table is refused, or marked among several."""
    axis = calc.axis.get(step.id)
    if axis not in calc.domains:
        calc.values[step.id] = calc.existing(step, calc.apply(step.formula))
        _inside(calc, step, calc.existing(step, calc[step.of]))
        return
    calc.curves[step.id] = step
    _inside(calc, step, _ends(calc, step, str(axis)))
    calc.domains[str(axis)].cut(_corners(calc, step, str(axis)))


def _ends(calc: Calculation, step: Interpolated, axis: str) -> Array:
    """The least and the greatest value of the quantity along its abscissa, shape (variants, 2)."""
    if step.of == axis:
        return np.concatenate([np.zeros((calc.count, 1)), calc.domains[axis].period], axis=1)
    if step.of not in calc.curves:
        return calc[step.of]
    return np.concatenate([extremes.extreme(calc, step.of, sign)[0] for sign in (-1.0, 1.0)], axis=1)


def _corners(calc: Calculation, step: Interpolated, axis: str) -> Array:
    """Where on the abscissa the quantity passes the inner rows of the table, shape (variants, any number), NaN where it does not."""
    rows = step.between.x[1:-1]
    if step.of == axis:
        places = np.tile(rows, (calc.count, 1))
        return np.where((places > 0) & (places < calc.domains[axis].period), places, np.nan)
    found = [np.full((calc.count, 1), np.nan)]
    known = calc.axis
    for corner in step.corners:
        calc.curves[corner.id], calc.axis = corner, {**known, corner.id: axis}
        found.append(roots_integrals.all_crossings(calc, corner.id)[0])
        del calc.curves[corner.id]
    calc.axis = known
    return np.concatenate(found, axis=1)


def _inside(calc: Calculation, step: Interpolated, values: Array) -> None:
    """Refuse machines whose quantity lies outside of the table, in words: which, how far, and what the table has."""
    low, high = step.between.x[[0, -1]]
    beyond = np.maximum(low - values, values - high)
    for variant in np.flatnonzero((beyond > INTERPOLATION_SAME * (high - low)).any(axis=1)):
        part = int(np.nanargmax(beyond[variant]))
        message = "" if calc.is_partial else _interpolation_said(calc, step, float(values[variant, part]))
        refuse(calc, int(variant), _key(calc, step, part), message)


def _key(calc: Calculation, step: Interpolated, part: int) -> str:
    """The input to change; of a list that of the part."""
    key = step.key or step.of.removeprefix("inputs.")
    home = calc.axis.get(step.id)
    return (
        f"{home}.{part}{key.removeprefix(home)}"
        if home and home not in calc.domains and key.startswith(f"{home}.")
        else key
    )


def _interpolation_said(calc: Calculation, step: Interpolated, value: float) -> str:
    """What lies outside, and what the table has."""
    own, declared = step.between.columns[0], calc.step_or_input(step.of)
    first, last = (with_unit(number_text(end, MOST_DIGITS), own.unit) for end in (own.values[0], own.values[-1]))
    shown = f"{declared.symbol} = {with_unit(_beyond(value / unit(own.unit).factor, own.values), own.unit)}"
    is_input = step.of not in calc.steps and not step.key
    return Phrase(
        "{text} {shown}, outside of the table “{title}” for {description} ({symbol}), which goes from "
        "{first} to {last}",
        text=phrase("is") if is_input else phrase("leads to"),
        shown=shown,
        title=step.table.title,
        description=step.description,
        symbol=step.symbol,
        first=first,
        last=last,
    )


def _beyond(value: float, rows: Sequence[float]) -> str:
    """A number with so many digits that it is seen to lie outside."""
    texts = (number_text(value, digits) for digits in range(DIGITS, MOST_DIGITS + 1))
    return next((text for text in texts if not rows[0] <= float(text) <= rows[-1]), number_text(value, MOST_DIGITS))
