"""Rows over repeated parts, and what was taken from tables and standard series, as they are printed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from diecut_report.contract.part_steps import Interpolated, Lookup, Part, Pick, Total
from diecut_report.contract.steps import Crossings, Step
from diecut_report.engine.calculation import Calculation
from diecut_report.engine.printing import named_parts
from diecut_report.engine.printing.substitution import printed
from diecut_report.engine.shown_units import declared_unit, step_shown, unit_for
from diecut_report.engine.steps.lookups import SAME, given_of, text_of
from diecut_report.engine.steps.part_rows import series_of
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.quantities.formatting import DIGITS, author_digits, given_shown, place_shown, shown, with_unit
from diecut_report.standards import StandardSeries, StandardTable, sources_told

Item = dict[str, Any]
AS_GIVEN = "as given"
AMONG = "over the parts with {symbol} > 0"
SERIES_WORDS = {
    "above": "the next standard value at or above {value}; neighbours not taken: {beside}",
    "below": "the next standard value at or below {value}; neighbours not taken: {beside}",
    "nearest": "the nearest standard value to {value}; neighbours not taken: {beside}",
}


def table(calc: Calculation, step: Step, names: list[str]) -> Item:
    """Return a row over repeated parts with what it is made of: a line for each part, by its name or numbered."""
    count = calc[step.id].shape[1]
    names = [
        name for name in names if name == step.id or calc[name].shape[1] == count
    ]  # what is one for all, the formula says
    declared = [calc.step_or_input(name) for name in names]
    known = named_parts.printed_names(calc, step)
    columns = [{"title": "Name" if known else "No.", "symbol": "", "unit": "1"}]
    units = [_column_unit(calc, name) for name in names]
    columns += [_column(d, display) for d, display in zip(declared, units, strict=True)]
    heads = known or [str(i + 1) for i in range(count)]
    lines = [[heads[i], *(_cell(calc, *column, i) for column in zip(names, units, strict=True))] for i in range(count)]
    return {"type": "table", "title": step.description, "columns": columns, "rows": lines}


def of_parts(calc: Calculation, step: Step, parts: Sequence[str], names: list[str]) -> Item:
    """Return rows over declared parts, or a list of the inputs: a line for each part by its name."""
    declared = [calc.step_or_input(name) for name in names]
    columns = [{"title": "Name" if getattr(declared[0], "named_by", "") else "Place", "symbol": "", "unit": "1"}]
    units = [_column_unit(calc, name) for name in names]
    columns += [_column(d, display) for d, display in zip(declared, units, strict=True)]
    lines = [
        [part, *(_cell(calc, *column, i) for column in zip(names, units, strict=True))] for i, part in enumerate(parts)
    ]
    return {"type": "table", "id": step.id, "title": step.description, "columns": columns, "rows": lines}


def _column(declared: Any, display: str) -> Item:
    return {"title": declared.description, "symbol": declared.symbol, "unit": display}


def _column_unit(calc: Calculation, name: str) -> str:
    """The one unit of a column; that of an input is its own."""
    declared, row = calc.step_or_input(name), calc[name]
    if name not in calc.values or np.asarray(row).dtype.kind not in "fc":
        return declared_unit(calc, name, declared.unit)
    return unit_for(calc, name, declared.unit, row[0])


def _cell(calc: Calculation, name: str, display: str, part: int) -> str:
    row = calc[name]
    value = row[0, min(part, row.shape[1] - 1)]
    if isinstance(value, str):
        return value
    if isinstance(value, np.bool_):
        return "yes" if value else "no"
    if np.isnan(float(value)):
        return "–"
    if name not in calc.values:
        return given_shown(float(value), display)["text"]
    digits = getattr(calc.step_or_input(name), "digits", DIGITS)
    return shown(float(value), display, author_digits(float(value), display, digits))["text"]


def number(calc: Calculation, step: Total | Pick | Lookup | Part) -> Item:
    """Return a number taken from rows, from a table, from a series."""
    result = step_shown(calc, step, float(calc[step.id][0, 0]))
    match step:
        case Lookup():
            return _lookup(calc, step) | {"result": result}
        case Pick() if given_of(calc, step) is not None:
            return _as_given(calc, step) | {"result": result}
        case Pick():
            values = _pick(calc, step)
        case Total(operation=operation, among=among):
            counted = Phrase(AMONG, symbol=calc.step_or_input(among).symbol) if among else ""
            values = {"operation": operation, "method": counted}
        case Part(index=index):
            values = {"operation": "last" if index < 0 else "first", "method": ""}
    return {"type": "reduction", "of": calc.step_or_input(step.of).symbol, "result": result} | values


def looked_up(calc: Calculation, step: Lookup) -> Item:
    """Return a row taken from a table, beside the texts or numbers by which it was taken."""
    if step.is_by_number:
        return table(calc, step, [step.by, step.id])
    found = table(calc, step, [step.id])
    found["columns"].insert(1, {"title": calc.step_or_input(step.by).description, "symbol": "", "unit": "1"})
    for line, text in zip(found["rows"], _texts(calc, step), strict=True):
        line.insert(1, str(text))
    return found


def _texts(calc: Calculation, step: Lookup) -> Sequence[str]:
    """By which text each part of a row was looked up, or that its number is given."""
    given = given_of(calc, step)
    count = calc[step.id].shape[1]
    if isinstance(given, np.ndarray):
        return [AS_GIVEN] * count
    found = text_of(calc, step)
    texts: Sequence[str] = found[0] if isinstance(found, np.ndarray) else found
    own = given or (None,) * count
    return [text if value is None else AS_GIVEN for text, value in zip(texts, own, strict=True)]


def _text(calc: Calculation, step: Lookup) -> str:
    """The name of the row that was taken."""
    found = text_of(calc, step)
    return str(found[0, 0] if isinstance(found, np.ndarray) else found)


def _lookup(calc: Calculation, step: Lookup) -> Item:
    if given_of(calc, step) is not None:
        return _as_given(calc, step)
    by = calc.step_or_input(step.by)
    return {
        "type": "lookup",
        "by": by.description,
        "key": f"{by.symbol} = {printed(calc, step.by)}" if step.is_by_number else _text(calc, step),
        "table": step.table.title if isinstance(step.table, StandardTable) else "",
        **({"column": step.column} if step.column else {}),
        **_tables(step.table),
    }


def _as_given(calc: Calculation, step: Lookup | Pick) -> Item:
    declared = calc.meta[step.given.removeprefix("inputs.")]
    return {"type": "lookup", "by": declared.description, "key": AS_GIVEN, "table": ""}


def exact_row(calc: Calculation, step: Interpolated) -> Item | None:
    """Return what is printed of a number between the rows of a table that is one of these rows; None where it lies between two."""
    value, (_, taken) = float(calc[step.of][0, 0]), step.between.columns
    if not (np.abs(step.between.x - value) <= SAME * abs(value)).any():
        return None
    by = calc.step_or_input(step.of)
    key = f"{by.symbol} = {printed(calc, step.of)}"
    return {
        "type": "lookup",
        "by": by.description,
        "key": key,
        "table": step.table.title,
        "column": taken.name,
        **_tables(step.table),
    }


def once(before: list[Item], new: list[Item]) -> list[Item]:
    """Return new items; of numbers taken one after another from a table of several columns the first alone names its sources."""
    last = before[-1] if before else {}
    for item in new:
        is_again = item["type"] == last.get("type") == "lookup" and "column" in item
        if is_again and (item["table"], item["key"]) == (last["table"], last["key"]):
            item.pop("note")
    return new


def _pick(calc: Calculation, step: Pick) -> Item:
    values, display, standard = series_of(calc, step)
    index = int(calc.branch[step.id][0, 0])
    beside = [with_unit(f"{values[i]:g}", display) for i in (index - 1, index + 1) if 0 <= i < len(values)]
    words = Phrase(SERIES_WORDS[step.rule], value=printed(calc, step.of), beside=", ".join(beside))
    return {"operation": "pick", "method": words} | ({"series": standard.title} if standard else {}) | _tables(standard)


def _tables(taken_from: object) -> Item:
    """The published tables that agree on a standard value."""
    if isinstance(taken_from, StandardTable | StandardSeries):
        return {"note": sources_told(taken_from)}
    return {}


def crossings(calc: Calculation, step: Crossings) -> Item:
    """Return the places where a curve changes its sign, a line for each; a note where there is none."""
    head = {"id": step.id, "symbol": step.symbol, "description": step.description, "source": step.source}
    places = [float(x) for x in calc[step.id][0] if x == x]
    if not places:
        return head | {"type": "note", "text": Phrase("{title}: there is none.", title=phrase(step.description))}
    display = unit_for(calc, step.id, step.unit, places)
    lines = [[str(i), place_shown(x, display)["text"]] for i, x in enumerate(places, 1)]
    columns = [
        {"title": "No.", "symbol": "", "unit": "1"},
        _column(step, display),
    ]
    return {"type": "table", "id": step.id, "title": step.description, "columns": columns, "rows": lines}
