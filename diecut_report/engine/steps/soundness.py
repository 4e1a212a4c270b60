"""Refuses numbers that are none, counts that are not whole and results that are not proved, of one machine; marks such variants."""

from __future__ import annotations

from math import isfinite
from pathlib import Path

import numpy as np

from diecut_report.contract.steps import Crossings, Step
from diecut_report.engine.calculation import Calculation, Unproven
from diecut_report.engine.steps.rough_places import sharpest
from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase
from diecut_report.quantities.units import unit

WHOLE = 1e-9  # by which a count may be off a whole number, for rounding


def possible(calc: Calculation) -> Array:
    """Return which variants are possible, as far as is known."""
    found = np.ones(calc.count, dtype=bool)
    found[list(calc.flaws)] = False
    return found


def prove(calc: Calculation, step: Step, residual: Array, tolerance: float) -> None:
    """Refuse a result that is not proved for a single machine; mark the variant among several."""
    if calc.count == 1 and residual[0, 0] <= tolerance:
        calc.proof[step.id] = max(float(residual[0, 0]), 0.0)
        return
    unproved = ~(residual[:, 0] <= tolerance) & possible(calc)
    calc.proof[step.id] = float(np.max(residual[possible(calc) & ~unproved], initial=0.0))
    if unproved.any():
        mark(
            calc,
            step,
            unproved,
            Phrase(
                "{description}: the proof leaves {residual}, not {tolerance}",
                description=step.description,
                residual=format(np.max(residual[unproved]), ".1e"),
                tolerance=format(tolerance, ".0e"),
            )
            + sharpest(calc, step),
        )


def mark(calc: Calculation, step: Step, bad: Array, words: str) -> None:
    """Refuse a single machine in words; mark these among several."""
    if calc.count == 1:
        raise Unproven(words, step.at)
    calc.flaws |= {int(variant): (step.id, words) for variant in np.flatnonzero(bad)}


def finite(calc: Calculation, step: Step) -> None:
    """Require that no number of a possible machine is NaN or infinite, but for an absent output and the padding of crossings."""
    values = calc.values.get(step.id)
    if values is None or values.dtype == object or step.exists is not None or isinstance(step, Crossings):
        return
    if values.size == 1 and isfinite(values.item()):
        return
    is_finite = np.isfinite(values)
    if is_finite.all():
        return
    bad = ~is_finite.all(axis=1) & possible(calc)
    if bad.any():
        mark(
            calc,
            step,
            bad,
            Phrase("{description} ({id}) has no value with these inputs", description=step.description, id=step.id),
        )


def whole(calc: Calculation, step: Step) -> None:
    """Require that what is marked as a count is whole: the results would round it."""
    values = calc.values.get(step.id)
    if not step.whole or values is None or values.dtype == object:
        return
    numbers = values / unit(step.unit).factor
    bad = (np.abs(numbers - np.round(numbers)) > WHOLE * np.maximum(np.abs(numbers), 1)).any(axis=1) & possible(calc)
    if bad.any():
        given = f"{numbers[np.flatnonzero(bad)[0]].ravel()[0]:.6g}"
        words = Phrase(
            "{description} ({id}, {name}) is {given}, but is marked as a count (whole=True)",
            description=step.description,
            id=step.id,
            name=Path(step.at).name,
            given=given,
        )
        mark(calc, step, bad, Phrase("{words}; round it in its formula, or take whole=True away", words=words))
