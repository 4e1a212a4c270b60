"""The calculation as it is printed: for each step an item with its formula, the numbers in it and the result."""

from __future__ import annotations

import unicodedata
from collections.abc import Callable, Iterable, Iterator
from typing import Any

import numpy as np

from diecut_report.formulas import Array
from diecut_report.formulas.formula import Formula, FormulaName
from diecut_report.formulas.tree import Node, transform, walk
from diecut_report.machine import mechanism
from diecut_report.machine.calculation import Calculation, Unproven, step_shown
from diecut_report.machine.printing import tables
from diecut_report.machine.printing.substitution import (
    BetweenRows,
    Contradiction,
    Elsewhere,
    Substitution,
    contradicted,
    formula_unit,
    printed,
)
from diecut_report.machine.printing.tables import (
    case_taken,
    is_elsewhere,
    located,
    marks,
    place_of,
    place_shown,
    shown_part,
    value_at,
)
from diecut_report.mechanism.names import Binding, Bound, bound
from diecut_report.mechanism.part_steps import (
    ComputedCurve,
    Interpolated,
    Listing,
    Lookup,
    Neighbour,
    Part,
    PartTable,
    Pick,
    Running,
    Total,
)
from diecut_report.mechanism.steps import (
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
    place_name,
)
from diecut_report.quantities.formatting import (
    DIGITS,
    UNIT_DIGITS,
    given_shown,
    is_rounding,
    number_text,
    rounded,
    shortest,
    shown,
)
from diecut_report.quantities.units import unit
from diecut_report.text.phrases import Phrase, joined, phrase

# How numbers were found, in words.


EQUAL_TERMS = "the terms are equal up to the rounding of the computer, or so nearly that printed numbers do not show it"
TO_ROUNDING = "0 up to the rounding of the computer"
METHODS = {
    "root": "bracketed root search, proved by the relation shown, which was not used to find it",
    "max": "bounded search on the curve within each smooth piece, one-sided limits at the breakpoints included",
    "mean": "Gauss–Legendre between the breakpoints, repeated with the doubled order",
    "derivative": "Chebyshev series between the breakpoints, differentiated; the series is compared with the curve at other places",
    "accumulated": "Chebyshev series between the breakpoints, integrated; its end compared with Gauss–Legendre",
}


def period(calc: Calculation, step: CurvePeriod) -> str:
    """Return that a number is the period of a curve."""
    return Phrase("the period of {symbol}", symbol=calc.meta[step.given].symbol)


def said_rounded(calc: Calculation, items: Iterable[dict[str, Any]]) -> Iterator[dict[str, Any]]:
    """Yield items; of a number that is printed as 0, but is what rounding left, a note says so."""
    for item in items:
        is_zero = item.get("result", {}).get("text") == "0" and item["id"] not in calc.axis and "note" not in item
        yield item | {"note": TO_ROUNDING} if is_zero and calc[item["id"]][0, 0] else item


# What stands below a formula that calls others by their names: their definitions, and the constants in these.


ALL_DIGITS = 17


def definitions(tree: Node) -> list[dict[str, Any]]:
    """Return the definition of each formula that a tree calls by name, each once: what is defined, and as what."""
    found: dict[str, Formula] = {}
    for formula in _called(tree):
        found.setdefault(formula.printed_as, formula)
    defined = [
        _pair(*(transform(side, _in_letters) for side in (_definitions_head(formula), formula.tree)))
        for formula in found.values()
    ]
    constants = {symbol: value for formula in found.values() for symbol, value in _own(formula).items()}
    values = [
        _pair(Node("sym", (symbol,)), Node("qty", (shortest(value, ALL_DIGITS), value.unit)))
        for symbol, value in constants.items()
    ]
    return defined + values


def _called(tree: Node) -> Iterator[Formula]:
    for node in walk(tree):
        match node:
            case Node("apply", (FormulaName(formula=formula), *_)):
                yield formula
                yield from _called(formula.tree)


def _in_letters(leaf: Node) -> Node:
    """A parameter that is named after a Greek letter as that letter: alpha is α."""
    name = leaf.args[0] if leaf.op == "sym" else ""
    try:
        return Node("sym", (unicodedata.lookup(f"GREEK SMALL LETTER {name.upper()}"),)) if name.isalpha() else leaf
    except KeyError:
        return leaf


def _definitions_head(formula: Formula) -> Node:
    return Node("apply", (formula.printed_as, *(Node("sym", (name,)) for name in formula.parameters)))


def _own(formula: Formula) -> dict[str, Any]:
    """The constants that stand in the definition itself."""
    named = {node.args[0] for node in walk(formula.tree) if node.op == "sym"} - set(formula.parameters)
    return {symbol: value for symbol, value in formula.constants.items() if symbol in named}


def _pair(head: Node, tree: Node) -> dict[str, Any]:
    return {"defined": head.to_json(), "as": tree.to_json()}


# What leads from the units of a formula's numbers to those that a reader knows: rad/s to r/min, s to h, rad to degrees.


Item = dict[str, Any]
GIVES_ANGLES = ("arcsin", "arccos", "arctan", "arctan2")  # whose value is read in degrees as it stands


def bridged(substitution: Substitution, numeric: Node | None, target: float, result: Item) -> Item:
    """Return the result in the unit that the formula's numbers give it, where it is printed in another one (``bridge``)."""
    inside = formula_unit(result["unit"])
    if inside == result["unit"] or substitution.is_copy or substitution.in_degrees:
        return {}
    calls = {node.args[0] for node in walk(substitution.part.formula.tree) if node.op == "call"}
    in_rad = numeric is not None and any(node.op == "qty" and node.args[1] == "rad" for node in walk(numeric))
    if unit(inside).si == "rad" and not calls.isdisjoint(GIVES_ANGLES) and not in_rad:
        return {}
    return {"bridge": shown(target, inside, max(DIGITS, len(result["text"].strip("-0").replace(".", ""))))}


def conversions(substitution: Substitution, numeric: Node | None) -> Item:
    """Return for each quantity that stands in a formula in another unit than its own how the one follows from the other."""
    found = list(_conversions(substitution)) if numeric is not None and not substitution.is_copy else []
    return {"conversions": found} if found else {}


def _conversions(substitution: Substitution) -> Iterator[Item]:
    calc = substitution.calc
    for name, inside in substitution.numbers.items():
        display = substitution.display(name)
        if unit(display).si == "rad" or formula_unit(display) == display or inside.args[1] == display:
            continue
        declared, value = calc.step_or_input(name), substitution.value_of(name)
        told = _told(value, display, declared.digits) if isinstance(declared, Step) else given_shown(value, display)
        again = {"text": number_text(value / unit(inside.args[1]).factor, DIGITS), "unit": inside.args[1]}
        yield {"symbol": declared.symbol, "shown": told, "converted": again}


def _told(value: float, display: str, digits: int) -> dict[str, str]:
    """A number beside the one that it is converted to: where its unit asks for fewer digits it has the usual ones here, or they would differ."""
    if display not in UNIT_DIGITS:
        return shown(value, display, digits)
    return {"text": number_text(float(rounded(value, display))), "unit": display}


def section_items(calc: Calculation) -> list[dict[str, Any]]:
    """Return the chapters of the calculation with their items, for the first (only) machine."""
    chapters: dict[str, dict[str, Any]] = {}
    for section, step in calc.mechanism.active(calc.given):
        chapter = chapters.setdefault(section.title, {"title": section.title, "text": section.text, "items": []})
        chapter["items"] += tables.once(chapter["items"], [*said_rounded(calc, items(calc, step))])
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
        case Computed() if tables.is_index(calc, step.id):
            return []  # from 0, of the part that the formulas are shown for, which is told by its name
        case Computed() if step.id in calc.axis:
            return [] if tables.has_tables(calc, calc.axis[step.id]) else [tables.table(calc, step, [step.id])]
        case MadeCurve():
            return [_made(calc, step)]
        case Computed() | CurvePeriod():
            return [_computed(calc, step)]
        case ComputedCurve():
            at = place_shown(calc, step.abscissa, False)
            return [tables.curves(calc, step, at)] if step.named_by else [_computed(calc, step) | {"at": at}]
        case PartTable(parts=parts, columns=columns):
            return [tables.of_parts(calc, step, tables.names(calc, parts, columns[0]), list(columns))]
        case Lookup() if step.id in calc.axis:
            return [] if tables.has_tables(calc, calc.axis[step.id]) else [tables.looked_up(calc, step)]
        case Total() | Pick() | Lookup() | Part():
            return [_head(step) | tables.number(calc, step)]
        case Running():
            return [tables.table(calc, step, [step.of, step.id])]
        case Listing():
            return mechanism.printed(calc, step)
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
        item["note"] = joined(filter(None, (item.get("note"), tables.told(calc, step, axis))), ". ")
        if not tables.has_tables(calc, axis):
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
        item["note"] = EQUAL_TERMS
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
