"""Rows over repeated parts, and what was taken from tables and standard series, as they are printed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from diecut_report.formulas import Array
from diecut_report.formulas.tree import Node
from diecut_report.machine.calculation import Calculation, declared_unit, step_shown, unit_for
from diecut_report.machine.curve_samples import CurveSampler
from diecut_report.machine.numerics.domain import Domain
from diecut_report.machine.printing.substitution import Elsewhere, printed
from diecut_report.machine.steps.lookups import SAME, given_of, text_of
from diecut_report.machine.steps.rows import series_of
from diecut_report.mechanism.names import bound
from diecut_report.mechanism.part_steps import (
    ComputedCurve,
    Interpolated,
    Lookup,
    Part,
    PartNames,
    PartTable,
    Pick,
    Total,
)
from diecut_report.mechanism.steps import Abscissa, Choice, Crossings, Step, Value, part_result
from diecut_report.quantities.formatting import DIGITS, author_digits, given_shown, shown, with_unit
from diecut_report.quantities.formatting import place_shown as as_place
from diecut_report.quantities.formatting import place_shown as tables_place_shown
from diecut_report.standards.tables import StandardSeries, StandardTable, sources_told
from diecut_report.text.phrases import NAMING, Phrase, phrase

# Where on its abscissa a curve is shown in print: one place for all formulas over it, and what is taken elsewhere.


Item = dict[str, Any]
FIRST = np.zeros(1, dtype=int)  # the variant that is printed


def shown_place(calc: Calculation, axis: str) -> tuple[Array, Array]:
    """Return the place of an abscissa at which formulas are shown, and the middle of its smooth piece, each of shape (1, 1)."""
    step = calc.steps[axis]
    assert isinstance(step, Abscissa)
    domain = calc.domains[axis]
    if step.shown_at in calc.middle:  # of an extreme, which knows the piece that it lies in
        return calc[step.shown_at][:1], calc.middle[step.shown_at][:1]
    asked = np.mod(calc[step.shown_at][:1], domain.period[:1]) if step.shown_at else None
    place = domain.samples[:1, domain.samples.shape[1] // 8][:, None] if asked is None else asked
    return place, domain.middle_of(place, rows=FIRST)


def value_at(calc: Calculation, name: str, axis: str | None, *, flag: bool = False, part: int | None = None) -> float:
    """Return a number, or a curve's value where formulas are shown, or that of a row's part (default: the one that is shown).

    What goes into a flag of smooth pieces is taken at the middle of the piece.
    """
    if axis in calc.domains and calc.axis.get(name) == axis:
        return float(np.ravel(_sampler(calc, str(axis), elsewhere=flag)[name])[0])  # a constant is a curve too
    row = calc[name]
    if row.shape[1] == 1:
        return float(row[0, 0])
    return float(row[0, shown_part(calc, name) if part is None else part])


def _sampler(calc: Calculation, axis: str, *, elsewhere: bool) -> CurveSampler:
    """The curves at the place where formulas are shown, or in the middle of its smooth piece."""

    def places(_: Domain) -> tuple[Array, Array]:
        place, middle = shown_place(calc, axis)
        return middle if elsewhere else place, middle

    return calc.kept(f"shown {elsewhere}", axis, places, FIRST)


def shown_part(calc: Calculation, name: str) -> int:
    """Return which part of a row formulas are shown with, from 0: the asked one, or the first that has all values; 0 of a number too."""
    known = _known_parts(calc, name)
    names = calc.steps.get(calc.axis.get(name, ""))
    if isinstance(names, PartNames) and names.shown_at:
        asked = int(calc[names.shown_at][0, 0])
        if known is None or known[asked]:
            return asked
    return 0 if known is None else int(np.argmax(known))


def _known_parts(calc: Calculation, name: str) -> Array | None:
    """Return for which parts a row and all that it takes have values; None of a text."""
    step = calc.steps.get(name)
    taken = [each for each in step.takes() if isinstance(each, str)] if isinstance(step, Value) else []
    rows = [
        calc.values[each][0]
        for each in (name, *taken)
        if each in calc.values and calc.axis.get(each) == calc.axis.get(name)
    ]
    known = [~np.isnan(row.astype(float)) for row in rows if row.dtype != object]
    return np.asarray(np.all(known, axis=0)) if known else None


def is_elsewhere(calc: Calculation, step: Value | Choice, axis: str | None) -> bool:
    """Return whether a flag has to be shown in the middle of its smooth piece: where curves are shown its formula gives another."""
    if not step.per_piece or axis not in calc.domains:
        return False
    here, there = (
        step if isinstance(step, Value) else step.cases[case_taken(calc, step, axis, flag=f)] for f in (False, True)
    )
    if here is not there:
        return True
    part = here.formula if isinstance(here, Value) else here.value
    assert not isinstance(part, str), "a curve has no texts"
    link = bound(part)
    taken = (value_at(calc, name, axis) if isinstance(name, str) else name for name in link.takes)
    return bool(link.formula(*taken) != value_at(calc, step.id, axis))


def located(calc: Calculation, axis: str, elsewhere: bool) -> Item:
    """Return where a formula over an abscissa is shown, and why where that is not its chapter's place."""
    place = place_shown(calc, axis, elsewhere)
    if not elsewhere:
        return {"at": place}
    told = f"{place['symbol']} = {with_unit(place['text'], place['unit'])}"
    words = "Taken at {place}, in the middle of its smooth piece; it is the same in all of it."
    return {"at": place, "note": Phrase(words, place=told)}


def marks(calc: Calculation, axis: str | None, elsewhere: bool) -> Elsewhere | None:
    """Return how curves are marked that are taken elsewhere than the chapter's."""
    if not elsewhere or axis is None:
        return None
    place = place_shown(calc, axis, True)
    marked = Node("sym", (place["symbol"],)), Node("qty", (place["text"], place["unit"]))

    def of(name: str) -> tuple[Node, Node] | None:
        curve = calc.steps.get(name)
        holds = curve is None or name == axis or getattr(curve, "per_piece", False)
        return None if holds or calc.axis.get(name) != axis else marked

    return of


def place_shown(calc: Calculation, axis: str, elsewhere: bool) -> Item:
    return place_of(calc, axis, float(_sampler(calc, axis, elsewhere=elsewhere).x[0, 0]))


def place_of(calc: Calculation, axis: str, place: float) -> Item:
    step = calc.steps[axis]
    return {"symbol": step.symbol} | as_place(place, declared_unit(calc, axis, step.unit))


def case_taken(calc: Calculation, step: Choice, axis: str | None, *, flag: bool) -> int:
    if axis is None:
        return int(calc.branch[step.id][0, 0])
    for index, case in enumerate(step.cases):
        if case.condition is None:
            return index
        link = bound(case.condition)
        taken = (value_at(calc, n, axis, flag=flag) if isinstance(n, str) else n for n in link.names.values())
        if link.formula(*taken):
            return index
    return len(step.cases) - 1


# How rows and curves of named parts are printed: in the tables that are declared for them.


def has_tables(calc: Calculation, parts: str) -> bool:
    """Return whether rows over repeated parts are printed in tables that are declared."""
    return parts in calc.part_names or any(
        isinstance(step, PartTable) and step.parts == parts for step in calc.steps.values()
    )


def is_index(calc: Calculation, name: str) -> bool:
    """Return whether a quantity is the index of the part with whose numbers the formulas of a list are shown."""
    return any(isinstance(step, PartNames) and step.shown_at == name for step in calc.steps.values())


def names(calc: Calculation, parts: str, row: str) -> Sequence[str]:
    """Return the names of the parts that a row runs over; of a list without names their numbers."""
    known = calc.part_names.get(parts) or calc.inputs.get(calc.steps[row].named_by)
    return known or [str(number + 1) for number in range(calc[row].shape[1])]


def printed_names(calc: Calculation, step: Step) -> Sequence[str] | None:
    """Return the names of the parts that a row runs over, where its list has them: by the step's own, else by its list's names."""
    if step.named_by:
        return calc.inputs.get(step.named_by)
    home = calc.axis.get(step.id, "")
    for key in NAMING:
        given = [str(each or "") for each in calc.inputs.get(f"{home}.{key}", ())]
        if all(given) and len(set(given)) == len(given) > 0:
            return given
    return None


def curves(calc: Calculation, step: ComputedCurve, at: Item) -> Item:
    """Return the curves of named parts where they are shown."""
    own = [part_result(name, step) for name in calc.inputs[step.named_by]]
    values = [value_at(calc, name, step.abscissa) for name in own]
    display = unit_for(calc, step.id, step.unit, values)
    head = (
        {"title": "Name", "symbol": "", "unit": "1"},
        {"title": step.description, "symbol": step.symbol, "unit": display},
    )
    texts = [shown(value, display, author_digits(value, display, step.digits))["text"] for value in values]
    place = {"symbol": at["symbol"], "value": with_unit(at["text"], at["unit"])}
    where = Phrase("{title} at {symbol} = {value}", {"title": phrase(step.description), **place})
    lines = [list(line) for line in zip(calc.inputs[step.named_by], texts, strict=True)]
    return {"type": "table", "id": step.id, "title": where, "columns": list(head), "rows": lines}


def told(calc: Calculation, step: Step, axis: str) -> str:
    """Return which of repeated parts the numbers in a row's formula are of; nothing where there is but one."""
    names, part = calc.part_names.get(axis) or printed_names(calc, step), shown_part(calc, step.id)
    if names:
        return Phrase("Shown for: {name}.", name=phrase(names[part]))
    return Phrase("Shown for part {part}.", part=part + 1) if calc[step.id].shape[1] > 1 else ""


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
    known = printed_names(calc, step)
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
    lines = [[str(i), tables_place_shown(x, display)["text"]] for i, x in enumerate(places, 1)]
    columns = [
        {"title": "No.", "symbol": "", "unit": "1"},
        _column(step, display),
    ]
    return {"type": "table", "id": step.id, "title": step.description, "columns": columns, "rows": lines}
