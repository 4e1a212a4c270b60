"""How rows and curves of named parts are printed: in the tables that are declared for them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from diecut_report.contract.code_steps import ComputedCurve, PartNames, PartTable
from diecut_report.contract.result_names import part_result
from diecut_report.contract.steps import Step
from diecut_report.engine.calculation import Calculation
from diecut_report.engine.printing.shown_place import shown_part, value_at
from diecut_report.engine.shown_units import unit_for
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.languages.tokens import NAMING
from diecut_report.quantities.formatting import author_digits, shown, with_unit

Item = dict[str, Any]


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
