"""Values between the rows of a table: where they have corners, and machines that lie outside of the table."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from diecut_report.contract.part_steps import Interpolated
from diecut_report.engine.calculation import Calculation
from diecut_report.engine.numerics import extrema, roots_integrals
from diecut_report.engine.steps.feasibility import refuse
from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.quantities.formatting import DIGITS, number_text, with_unit
from diecut_report.quantities.units import unit

MOST_DIGITS = 17
SAME = 1e-12  # of the table's range: beyond its ends by no more is rounding


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
    return np.concatenate([extrema.extreme(calc, step.of, sign)[0] for sign in (-1.0, 1.0)], axis=1)


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
    for variant in np.flatnonzero((beyond > SAME * (high - low)).any(axis=1)):
        part = int(np.nanargmax(beyond[variant]))
        message = "" if calc.is_partial else _said(calc, step, float(values[variant, part]))
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


def _said(calc: Calculation, step: Interpolated, value: float) -> str:
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
