"""Checks that are not made because an optional input is not given: what each needs, and its demand where that is known."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from diecut_report.contract.checks import Check
from diecut_report.contract.missing_keys import missing_keys
from diecut_report.contract.placeholders import listed
from diecut_report.engine import Calculation
from diecut_report.engine.shown_units import unit_for
from diecut_report.languages.phrases import Phrase, joined, named, phrase
from diecut_report.quantities.formatting import shown, with_unit
from diecut_report.quantities.units import unit

Data = dict[str, Any]
NOT_CHECKED = "not_checked"
MISSING = {  # whether several keys are missing, whether a side is known
    (False, False): "Not checked: {keys} is not given.",
    (True, False): "Not checked: {keys} are not given.",
    (False, True): "Not checked: {known}, but {keys} is not given.",
    (True, True): "Not checked: {known}, but {keys} are not given.",
}


def is_of_machine(check: Check) -> bool:
    """Return whether a check judges the machine, and not the calculation itself."""
    return check.check_class != "numerical"


def missing(calc: Calculation, check: Check) -> tuple[str, ...]:
    """Return the keys without which a check is not made; none where it is made, does not apply, or tests the calculation itself."""
    if not is_of_machine(check) or any(_does_not_exist(calc, side) for side in (check.demand, check.limit)):
        return ()
    return missing_keys(calc.mechanism, check, calc.given) or _left_out(calc, check)


def _left_out(calc: Calculation, check: Check) -> tuple[str, ...]:
    """Return the optional keys of a list that the part which a check judges leaves out, though others give them."""
    rows = {key: calc.inputs[key] for key in check.named if key in calc.inputs}
    return tuple(
        key
        for key, row in rows.items()
        if check.index is not None and isinstance(row, tuple) and row[check.index] is None
    )


def _does_not_exist(calc: Calculation, side: str | float) -> bool:
    """Whether a side is a quantity that this machine (none of many) does not have, as a shaft without a torque has no twist."""
    if not isinstance(side, str) or side not in calc.values or calc.steps[side].exists is None:
        return False
    return bool(np.isnan(calc.values[side].astype(float)).all())


def result(calc: Calculation, check: Check, keys: tuple[str, ...]) -> Data:
    """Return a check that is not made, in the form of those that are."""
    demand = _known(calc, check.demand, check.index)
    text = None if demand is None else shown(demand, check_unit(calc, check, [demand]))
    return {
        "id": check.id,
        "title": check.title,
        "class": check.check_class,
        "status": NOT_CHECKED,
        "demand": demand,
        "limit": None,
        "operator": check.operator,
        "unit": unit(check.unit).si,
        "utilisation": None,
        "source": check.source,
        "message": _message(calc, check, keys),
        "demand_label": check.demand_label,
        "limit_label": check.limit_label,
        "demand_display": text,
        "limit_display": None,
        "margin_display": None,
        "missing": list(keys),
    }


def without_basis(calc: Calculation, check: Check) -> tuple[str, ...]:
    """Return the inputs by which a check would hold because they were typed."""
    return tuple(key for key in check.founded if key in calc.unfounded)


def unfounded(calc: Calculation, check: Check, keys: tuple[str, ...]) -> Data:
    """Return a check that would hold by what was typed alone, in the form of those that are not made."""
    words = (
        "Not checked: it would hold by {keys} alone, which nothing proves; give the basis there, as in {value: 1.2, basis: standard, "
        "note: …}: measured, drawing, or the standard or catalogue that the note names."
    )
    return result(calc, check, keys) | {"message": Phrase(words, keys=listed(keys))}


def check_unit(calc: Calculation, check: Check, sides: list[float]) -> str:
    """Return the one unit in which the sides of a check are shown."""
    named = [side for side in (check.demand, check.limit) if isinstance(side, str) and side in calc.chosen_units.by_id]
    return unit_for(calc, named[0] if named else "", check.unit, sides)


def _message(calc: Calculation, check: Check, keys: tuple[str, ...]) -> str:
    """What is known of either side, and what is not given."""
    sides = (
        (check.demand_label, _known(calc, check.demand, check.index)),
        (check.limit_label, _known(calc, check.limit, check.index)),
    )
    known = [
        Phrase(
            "{label} {value}",
            label=phrase(label),
            value=with_unit(*shown(value, check_unit(calc, check, [value])).values()),
        )
        for label, value in sides
        if value is not None
    ]
    told: str = Phrase(MISSING[len(keys) > 1, bool(known)], keys=listed(keys), known=known[0] if known else "")
    return joined([told, *dict.fromkeys(_of_partners(calc, keys))], " ")


def _of_partners(calc: Calculation, keys: tuple[str, ...]) -> Iterator[str]:
    """Where the missing keys would come from by themselves."""
    for partner in calc.mechanism.partners:
        wanted = [key for key in keys if key in partner.takes]
        if wanted and partner.key in calc.given:
            homes = listed([f"{calc.inputs[partner.key]}.{partner.takes[key]}" for key in wanted])
            yield Phrase("{keys} are not there." if len(wanted) > 1 else "{keys} is not there.", keys=homes)
        elif wanted:
            none = "There is no {kinds}, or there are several: name one by {key}."
            yield Phrase(none, kinds=named(partner.kinds, " or "), key=partner.key)


def _known(calc: Calculation, side: str | float, index: int | None) -> float | None:
    """One side of a check as a number in SI, of repeated parts the one that is judged or the greatest; None where it is not known, or a curve."""
    if not isinstance(side, str) or not (side in calc.values or side in calc.inputs):
        return None
    found: Any = calc[side]
    if isinstance(found, tuple):  # of parts that do not all have it
        found = np.array([[np.nan if part is None else part for part in found]], dtype=float)
    row = np.asarray(found, dtype=float)[0]
    row = row if index is None else row[[index]]
    return float(np.nanmax(row)) if np.isfinite(row).any() else None
