"""The calculation as it is printed: for each step an item with its formula, the numbers in it and the result."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from diecut_report.contract.binding import Binding, Bound, bound
from diecut_report.contract.code_steps import ComputedCurve, PartTable
from diecut_report.contract.listings import Listing
from diecut_report.contract.part_steps import Interpolated, Lookup, Neighbour, Part, Pick, Running, Total
from diecut_report.contract.result_names import place_name
from diecut_report.contract.steps import (
    Abscissa,
    Accumulated,
    Choice,
    Computed,
    Crossings,
    CurvePeriod,
    Derivative,
    MadeCurve,
    Reduction,
    Root,
    Step,
    Value,
    Words,
)
from diecut_report.engine import listings
from diecut_report.engine.calculation import Calculation, Unproven
from diecut_report.engine.printing import methods, named_parts, tables
from diecut_report.engine.printing.bridges import bridged, conversions
from diecut_report.engine.printing.contradictions import contradicted
from diecut_report.engine.printing.definitions import definitions
from diecut_report.engine.printing.interpolation import BetweenRows
from diecut_report.engine.printing.methods import METHODS, period
from diecut_report.engine.printing.shown_place import (
    case_taken,
    is_elsewhere,
    located,
    marks,
    place_of,
    place_shown,
    shown_part,
    value_at,
)
from diecut_report.engine.printing.substitution import (
    Contradiction,
    Elsewhere,
    Substitution,
    printed,
)
from diecut_report.engine.shown_units import step_shown
from diecut_report.expressions import Array, Node
from diecut_report.languages.phrases import Phrase, joined, phrase
from diecut_report.quantities.display import is_rounding
from diecut_report.quantities.formatting import number_text

Item = dict[str, Any]


def section_items(calc: Calculation) -> list[dict[str, Any]]:
    """Return the chapters of the calculation with their items, for the first (only) machine."""
    chapters: dict[str, dict[str, Any]] = {}
    for section, step in calc.mechanism.active(calc.given):
        chapter = chapters.setdefault(section.title, {"title": section.title, "text": section.text, "items": []})
        chapter["items"] += tables.once(chapter["items"], [*methods.said_rounded(calc, items(calc, step))])
        if isinstance(step, Value | Choice | Accumulated | Derivative) and calc.axis.get(step.id) in calc.domains:
            place = place_shown(calc, calc.axis[step.id], False)
            chapter["shown"] = [*(at for at in chapter.get("shown", []) if at != place), place]
    return [chapter for chapter in chapters.values() if chapter["items"]]


def _is_nothing(row: Array) -> bool:
    """Whether no part of a row has a number; a text is something."""
    return row.dtype.kind in "fc" and bool(np.isnan(row).all())


def items(calc: Calculation, step: Step) -> list[Item]:
    """Return what is printed of a step (nothing of breakpoints and requirements)."""
    if not step.printed:
        return []
    if step.exists is not None and step.id in calc.values and _is_nothing(calc.values[step.id][0]):
        text = Phrase("{title}: does not apply to this machine.", title=phrase(step.description))
        return [_head(step) | {"type": "note", "text": text}]
    match step:
        case Value(formula=part):
            return _value(calc, step, bound(part))
        case Choice():
            listed = step.id in calc.axis and calc.axis[step.id] not in calc.domains
            return [_choice(calc, step), *([tables.table(calc, step, [step.id])] if listed else [])]
        case Root():
            return [_root(calc, step)]
        case Reduction():
            return [_reduction(calc, step)]
        case Crossings():
            return [tables.crossings(calc, step)]
        case Accumulated() | Derivative():
            return [_of_curve(calc, step)]
        case Computed() if named_parts.is_index(calc, step.id):
            return []  # from 0, of the part that the formulas are shown for, which is told by its name
        case Computed() if step.id in calc.axis:
            return [] if named_parts.has_tables(calc, calc.axis[step.id]) else [tables.table(calc, step, [step.id])]
        case MadeCurve():
            return [_made(calc, step)]
        case Computed() | CurvePeriod():
            return [_computed(calc, step)]
        case ComputedCurve():
            at = place_shown(calc, step.abscissa, False)
            return [named_parts.curves(calc, step, at)] if step.named_by else [_computed(calc, step) | {"at": at}]
        case PartTable(parts=parts, columns=columns):
            return [tables.of_parts(calc, step, named_parts.names(calc, parts, columns[0]), list(columns))]
        case Lookup() if step.id in calc.axis:
            return [] if named_parts.has_tables(calc, calc.axis[step.id]) else [tables.looked_up(calc, step)]
        case Total() | Pick() | Lookup() | Part():
            return [_head(step) | tables.number(calc, step)]
        case Running():
            return [tables.table(calc, step, [step.of, step.id])]
        case Listing():
            return listings.printed(calc, step)
        case Neighbour() | Words():  # a neighbour stands beside its part in the table of what takes it
            return []
        case Abscissa(points=points):
            told = {"title": phrase(step.description), "count": printed(calc, points)}
            text = Phrase("{title}; curves are sampled at {count} places of it.", told)
            return [_head(step) | {"type": "note", "text": text}]
    return []


def _head(step: Step) -> Item:
    return {"id": step.id, "symbol": step.symbol, "description": step.description, "source": step.source}


def _value(calc: Calculation, step: Value, part: Bound) -> list[Item]:
    axis = calc.axis.get(step.id)
    if step.id in calc.values and calc.values[step.id].dtype == bool:
        return [_yes_or_no(calc, step, part)]
    if isinstance(step, Interpolated) and axis is None and (row := tables.exact_row(calc, step)) is not None:
        return [_head(step) | row | {"result": step_shown(calc, step, value_at(calc, step.id, None))}]
    elsewhere = is_elsewhere(calc, step, axis)
    item = _head(step) | {"type": "formula"} | _formula(calc, part, step, axis, elsewhere)
    if axis in calc.domains:
        item |= located(calc, str(axis), elsewhere)
    elif axis is not None:
        item["note"] = joined(filter(None, (item.get("note"), named_parts.told(calc, step, axis))), ". ")
        if not named_parts.has_tables(calc, axis):
            taken = [name for name in part.names.values() if isinstance(name, str)]
            return [item, tables.table(calc, step, [*taken, step.id])]
    return [item]


def _yes_or_no(calc: Calculation, step: Value, part: Bound) -> Item:
    """Whether a condition holds, with the one that does: itself or its opposite."""
    held = bool(calc[step.id][0, 0])
    substitution = Substitution(calc, part, lambda name: value_at(calc, name, None))
    return _head(step) | _answer(*_sides(substitution, held), held=held)


def _answer(symbolic: Any = None, numeric: Any = None, *, held: bool) -> Item:
    """Yes or no, with the condition that says so where there is one."""
    condition = {"condition": symbolic, "condition_substituted": numeric} if symbolic else {}
    result = Item(text="yes" if held else "no", unit="1")
    return {"type": "choice", "words": "", "equation": None, "substituted": None, "result": result} | condition


def _sides(substitution: Substitution, held: bool) -> tuple[Any, Any]:
    """The condition that holds (this one or its opposite) in symbols, and with numbers where these show it."""
    sides = substitution.symbolic(), substitution.comparison(held)
    symbolic, numeric = (side and (side if held else negated(side)).to_json() for side in sides)
    return symbolic, numeric


def _formula(calc: Calculation, part: Bound, step: Step, axis: str | None, elsewhere: bool) -> Item:
    target = value_at(calc, step.id, axis)
    result = step_shown(calc, step, target)
    marked = marks(calc, axis, elsewhere)
    own = None if axis is None or axis in calc.domains else shown_part(calc, step.id)
    substitution = _substitution(
        calc, part, step, lambda name: value_at(calc, name, axis, flag=elsewhere, part=own), marked
    )
    takes = [name for name in part.names.values() if isinstance(name, str)]
    try:
        numeric = substitution.numeric(target, result["unit"], step.digits) if takes else None
    except Contradiction as found:
        raise Unproven(contradicted(step, part, found), step.at) from None
    symbolic = substitution.symbolic()
    item: Item = {"equation": symbolic.to_json(), "substituted": numeric and numeric.to_json()}
    if defined := definitions(symbolic):
        item["where"] = defined
    if takes and numeric is None:
        item["note"] = methods.EQUAL_TERMS
    if isinstance(substitution, BetweenRows):
        item = substitution.told() | item
    return (
        item | bridged(substitution, numeric, target, result) | conversions(substitution, numeric) | {"result": result}
    )


def _substitution(
    calc: Calculation, part: Bound, step: Step, value_of: Callable[[str], float], marked: Elsewhere | None
) -> Substitution:
    if isinstance(step, Interpolated):
        return BetweenRows(calc, step, value_of, marked)
    return Substitution(calc, part, value_of, marked)


OPPOSITE = {"<": ">=", "<=": ">", ">": "<=", ">=": "<", "==": "!=", "!=": "=="}


def negated(condition: Node) -> Node:
    """Return the condition that holds where this one does not."""
    if condition.op != "cmp":
        return Node("not", (condition,))
    sign, *sides = condition.args
    return Node("cmp", (OPPOSITE[sign], *sides))


def _choice(calc: Calculation, step: Choice) -> Item:
    axis = calc.axis.get(step.id)
    elsewhere = is_elsewhere(calc, step, axis)
    index = case_taken(calc, step, axis, flag=elsewhere)
    case = step.cases[index]
    item = _head(step) | {"type": "choice", "words": case.words}
    held = case.condition if case.condition is not None else step.cases[index - 1].condition
    if held is not None:
        marked = marks(calc, axis, elsewhere)
        substitution = Substitution(calc, bound(held), lambda name: value_at(calc, name, axis, flag=elsewhere), marked)
        symbolic, numeric = _sides(substitution, case.condition is not None)
        item |= {"condition": symbolic, "condition_substituted": numeric}
    if axis in calc.domains:
        item |= located(calc, str(axis), elsewhere)
    if isinstance(case.value, Binding):
        return item | _formula(calc, bound(case.value), step, axis, elsewhere)
    return item | {"equation": None, "substituted": None, "result": {"text": str(case.value), "unit": "1"}}


def _root(calc: Calculation, step: Root) -> Item:
    sides = [
        Substitution(calc, bound(side), lambda name: value_at(calc, name, None)).symbolic()
        for side in (step.left, step.right)
    ]
    residual = number_text(calc.proof[step.id], 2)
    return _head(step) | {
        "type": "found",
        "relation": Node("cmp", ("==", *sides)).to_json(),
        "method": METHODS["root"],
        "result": step_shown(calc, step, value_at(calc, step.id, None)),
        "residual": {"text": residual, "unit": "1"},
    }


def _reduced(calc: Calculation, step: Step, of: str) -> Item:
    result = step_shown(calc, step, value_at(calc, step.id, None))
    return {"type": "reduction", "of": calc.step_or_input(of).symbol, "result": result}


def _reduction(calc: Calculation, step: Reduction) -> Item:
    integrated = step.operation in ("mean", "rms", "integral")
    item = _head(step) | _reduced(calc, step, step.of) | {"operation": step.operation}
    item["method"] = METHODS["mean" if integrated else "max"]
    item["residual"] = {"text": number_text(calc.proof[step.id], 2), "unit": "1"}
    if step.operation == "integral":
        axis = calc.axis[step.of]
        item["over"] = place_of(calc, axis, float(calc.domains[axis].period_of(None)[0, 0]))
    place = place_name(step.id)
    if place in calc.values and not is_rounding(value_at(calc, step.id, None), step.unit):
        item["at"] = place_of(calc, calc.axis[step.of], float(calc[place][0, 0]))
    return item


def _computed(calc: Calculation, step: Computed | ComputedCurve | CurvePeriod) -> Item:
    method = period(calc, step) if isinstance(step, CurvePeriod) else step.method
    if isinstance(step, Computed) and step.is_text:
        result: Item = {"text": calc[step.id][0, 0], "unit": "1"}
    elif isinstance(step, Computed) and calc[step.id].dtype == bool:
        return _head(step) | _answer(held=bool(calc[step.id][0, 0]))
    else:
        result = step_shown(calc, step, value_at(calc, step.id, calc.axis.get(step.id)))
    is_chosen = isinstance(step, Computed) and step.lacks  # in the place of an input that may be given
    chosen = {"chosen": True} if is_chosen else {}
    return _head(step) | {"type": "found", "relation": None, "method": method, "result": result} | chosen


def _made(calc: Calculation, step: MadeCurve) -> Item:
    result = step_shown(calc, step, value_at(calc, step.id, calc.axis[step.id]))
    found = _head(step) | {"type": "found", "relation": None, "method": step.method, "result": result}
    return found | {"at": place_shown(calc, calc.axis[step.id], False)}


def _of_curve(calc: Calculation, step: Accumulated | Derivative) -> Item:
    operation = "accumulated" if isinstance(step, Accumulated) else "derivative"
    axis = calc.axis[step.id]
    result = step_shown(calc, step, value_at(calc, step.id, axis))
    return _head(step) | {
        "type": "reduction", "operation": operation, "of": calc.step_or_input(step.of).symbol, "result": result,
        "at": place_shown(calc, axis, False), "method": METHODS[operation],
        "residual": {"text": number_text(calc.proof[step.id], 2), "unit": "1"},
    }  # fmt: skip
