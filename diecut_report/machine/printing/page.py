"""Prints the numbers, formulas and tables of one calculated machine: what steps ask for when they are printed (``StepPrinter``)."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from diecut_report.formulas import Array
from diecut_report.formulas.formula import Formula, FormulaName
from diecut_report.formulas.tree import Node, symbols, transform, walk
from diecut_report.machine import mechanism
from diecut_report.machine.calculation import Calculation, Unproven, declared_unit, unit_for
from diecut_report.machine.numerics.curves import CurveSampler
from diecut_report.machine.numerics.domain import Domain
from diecut_report.machine.printing.substitution import (
    BetweenRows,
    Contradiction,
    Elsewhere,
    Substitution,
    contradicted,
    formula_unit,
    printed,
)
from diecut_report.mechanism.names import formula_of
from diecut_report.mechanism.steps import Abscissa, Choice, Interpolated, PartNames, PartTable, Step, part_result
from diecut_report.mechanism.steps.protocols import Item
from diecut_report.mechanism.steps.value import FormulaStep
from diecut_report.quantities.formatting import (
    DIGITS,
    MOST_DIGITS,
    UNIT_DIGITS,
    author_digits,
    given_shown,
    number_text,
    place_shown,
    rounded,
    shortest,
    shown,
    with_unit,
)
from diecut_report.quantities.units import unit
from diecut_report.text.phrases import NAMING, Phrase, joined, phrase

FIRST = np.zeros(1, dtype=int)  # the variant that is printed
EQUAL_TERMS = "the terms are equal to machine precision, or to within the printed digits"
OPPOSITE = {"<": ">=", "<=": ">", ">": "<=", ">=": "<", "==": "!=", "!=": "=="}


class Page:
    """Print one machine.

    One place of each abscissa is shown for all formulas over it; what is taken elsewhere, as a flag of a smooth piece in its middle, is marked.
    """

    def __init__(self, calc: Calculation) -> None:
        self.calc = calc

    # Numbers.

    def value_at(self, name: str, axis: str | None, *, flag: bool = False, part: int | None = None) -> float:
        """Return a number, or a curve's value where formulas are shown, or that of a row's part (default: the one that is shown).

        What goes into a flag of smooth pieces is taken at the middle of the piece.
        """
        if axis in self.calc.domains and self.calc.axis.get(name) == axis:
            return float(np.ravel(self._sampler(str(axis), elsewhere=flag)[name])[0])  # a constant is a curve too
        row = self.calc[name]
        if row.shape[1] == 1:
            return float(row[0, 0])
        return float(row[0, self.shown_part(name) if part is None else part])

    def result(self, step: Step, value: float) -> Item:
        """Return a number that a step gives as text, in its unit."""
        display = unit_for(self.calc, step.id, step.unit, [value])
        return shown(value, display, author_digits(value, display, step.digits))

    def printed(self, name: str) -> str:
        """Return a quantity as one would say it."""
        return printed(self.calc, name)

    def residual(self, step: Step) -> Item:
        """Return by how much a result missed what proves it."""
        return {"text": number_text(self.calc.proof[step.id], 2), "unit": "1"}

    def _sampler(self, axis: str, *, elsewhere: bool) -> CurveSampler:
        """The curves at the place where formulas are shown, or in the middle of its smooth piece."""

        def places(_: Domain) -> tuple[Array, Array]:
            place, middle = self._shown_place(axis)
            return middle if elsewhere else place, middle

        return self.calc.kept(f"shown {elsewhere}", axis, places, FIRST)

    def _shown_place(self, axis: str) -> tuple[Array, Array]:
        """The place of an abscissa at which formulas are shown, and the middle of its smooth piece, each of shape (1, 1)."""
        calc, step = self.calc, self.calc.steps[axis]
        assert isinstance(step, Abscissa)
        domain = calc.domains[axis]
        if step.shown_at in calc.middle:  # of an extreme, which knows the piece that it lies in
            return calc[step.shown_at][:1], calc.middle[step.shown_at][:1]
        asked = np.mod(calc[step.shown_at][:1], domain.period[:1]) if step.shown_at else None
        place = domain.samples[:1, domain.samples.shape[1] // 8][:, None] if asked is None else asked
        return place, domain.middle_of(place, rows=FIRST)

    def shown_part(self, name: str) -> int:
        """Which part of a row formulas are shown with, from 0: the asked one, or the first that has all values; 0 of a number too."""
        known = self._known_parts(name)
        names = self.calc.steps.get(self.calc.axis.get(name, ""))
        if isinstance(names, PartNames) and names.shown_at:
            asked = int(self.calc[names.shown_at][0, 0])
            if known is None or known[asked]:
                return asked
        return 0 if known is None else int(np.argmax(known))

    def _known_parts(self, name: str) -> Array | None:
        """For which parts a row and all that it takes have values; None of a text."""
        calc = self.calc
        formula = getattr(calc.steps.get(name), "formula", None)
        taken = () if formula is None else formula_of(formula).parameters
        alike = (n for n in (name, *taken) if n in calc.values and calc.axis.get(n) == calc.axis.get(name))
        rows = [calc.values[n][0] for n in alike]
        known = [~np.isnan(row.astype(float)) for row in rows if row.dtype != object]
        return np.asarray(np.all(known, axis=0)) if known else None

    # Places of an abscissa.

    def place(self, axis: str, place: float) -> Item:
        """Return a place of an abscissa as text."""
        step = self.calc.steps[axis]
        return {"symbol": step.symbol} | place_shown(place, declared_unit(self.calc, axis, step.unit))

    def shown(self, axis: str, elsewhere: bool = False) -> Item:
        """Return the place of an abscissa at which formulas are shown."""
        return self.place(axis, float(self._sampler(axis, elsewhere=elsewhere).x[0, 0]))

    def over_axis(self, step: FormulaStep) -> tuple[bool, Item]:
        """Return whether a flag is shown in the middle of its smooth piece, and where a formula over an abscissa is shown."""
        axis = self.calc.axis.get(step.id)
        if axis is None or axis not in self.calc.domains:
            return False, {}
        elsewhere = self._is_elsewhere(step, axis)
        place = self.shown(axis, elsewhere)
        if not elsewhere:
            return False, {"at": place}
        told = f"{place['symbol']} = {with_unit(place['text'], place['unit'])}"
        template = "Shown at {place}, in the middle of its smooth piece, over which it is constant."
        return True, {"at": place, "note": Phrase(template, place=told)}

    def _is_elsewhere(self, step: FormulaStep, axis: str) -> bool:
        """Whether a flag has to be shown in the middle of its smooth piece: where curves are shown its formula gives another."""
        if not step.per_piece:
            return False
        here, there = (step.shown_formula(self, flag) for flag in (False, True))
        if here is not there:
            return True
        formula = formula_of(here)
        return bool(
            formula(*(self.value_at(name, axis) for name in formula.parameters)) != self.value_at(step.id, axis)
        )

    def case_taken(self, step: Choice, elsewhere: bool) -> int:
        """Return which case of a choice is taken where formulas are shown."""
        axis = self.calc.axis.get(step.id)
        if axis is None:
            return int(self.calc.branch[step.id][0, 0])
        for index, case in enumerate(step.cases):
            if case.condition is None:
                return index
            condition = formula_of(case.condition)
            if condition(*(self.value_at(name, axis, flag=elsewhere) for name in condition.parameters)):
                return index
        return len(step.cases) - 1

    def _marks(self, axis: str | None, elsewhere: bool) -> Elsewhere | None:
        """How curves are marked that are taken elsewhere than the chapter's."""
        if not elsewhere or axis is None:
            return None
        place = self.shown(axis, True)
        marked = Node("sym", (place["symbol"],)), Node("qty", (place["text"], place["unit"]))

        def of(name: str) -> tuple[Node, Node] | None:
            curve = self.calc.steps.get(name)
            holds = curve is None or name == axis or getattr(curve, "per_piece", False)
            return None if holds or self.calc.axis.get(name) != axis else marked

        return of

    # Formulas.

    def symbolic(self, part: Formula) -> Node:
        """Return a formula in symbols."""
        return Substitution(self.calc, part, lambda name: self.value_at(name, None)).symbolic()

    def sides(self, part: Formula, held: bool, axis: str | None = None, elsewhere: bool = False) -> tuple[Any, Any]:
        """Return the condition that holds, this one or its opposite, in symbols and with numbers."""
        marked = self._marks(axis, elsewhere)
        substitution = Substitution(self.calc, part, lambda name: self.value_at(name, axis, flag=elsewhere), marked)
        sides = substitution.symbolic(), substitution.comparison(held)
        symbolic, numeric = (side and (side if held else negated(side)).to_json() for side in sides)
        return symbolic, numeric

    def formula(self, step: Step, part: Formula, elsewhere: bool = False) -> Item:
        """Return a formula in symbols, with numbers in, and its result."""
        calc, axis = self.calc, self.calc.axis.get(step.id)
        target = self.value_at(step.id, axis)
        result = self.result(step, target)
        own = None if axis is None or axis in calc.domains else self.shown_part(step.id)
        marked = self._marks(axis, elsewhere)

        def value_of(name: str) -> float:
            return self.value_at(name, axis, flag=elsewhere, part=own)

        between = BetweenRows(calc, step, value_of, marked) if isinstance(step, Interpolated) else None
        substitution = between or Substitution(calc, part, value_of, marked)
        try:
            numeric = substitution.numeric(target, result["unit"], step.digits) if part.parameters else None
        except Contradiction as found:
            raise Unproven(contradicted(step, part, found), step.at) from None
        symbolic = substitution.symbolic()
        item: Item = {"equation": symbolic.to_json(), "substituted": numeric and numeric.to_json()}
        if defined := definitions(symbolic):
            item["where"] = defined
        if part.parameters and numeric is None:
            item["note"] = EQUAL_TERMS
        item = (between.told() if between else {}) | item | bridged(substitution, numeric, target, result)
        return item | conversions(substitution, numeric) | {"result": result}

    # Tables.

    def parts_shown(self, step: Step, item: Item, names: Sequence[str]) -> list[Item]:
        """Return the formula of a row with the part that it is shown for, and the row as a table beside what it takes."""
        axis = self.calc.axis[step.id]
        item["note"] = joined(filter(None, (item.get("note"), self._part_told(step, axis))), ". ")
        return [item] if self.has_tables(axis) else [item, self.table(step, [*names, step.id])]

    def _part_told(self, step: Step, axis: str) -> str:
        """Which of repeated parts the numbers in a row's formula are of; nothing where there is but one."""
        names, part = self.calc.part_names.get(axis) or self._names(step), self.shown_part(step.id)
        if names:
            return Phrase("Shown for: {name}.", name=phrase(names[part]))
        return Phrase("Shown for part {part}.", part=part + 1) if self.calc[step.id].shape[1] > 1 else ""

    def has_tables(self, parts: str) -> bool:
        """Return whether rows over repeated parts are printed in tables that are declared."""
        steps = self.calc.steps.values()
        return parts in self.calc.part_names or any(
            isinstance(step, PartTable) and step.parts == parts for step in steps
        )

    def is_index(self, name: str) -> bool:
        """Return whether a quantity is the index of the part with whose numbers the formulas of a list are shown."""
        return any(isinstance(step, PartNames) and step.shown_at == name for step in self.calc.steps.values())

    def _names(self, step: Step) -> Sequence[str] | None:
        """The names of the parts that a row runs over, where its list has them: by the step's own, else by its list's names."""
        if step.named_by:
            return self.calc.inputs.get(step.named_by)
        home = self.calc.axis.get(step.id, "")
        for key in NAMING:
            given = [str(each or "") for each in self.calc.inputs.get(f"{home}.{key}", ())]
            if all(given) and len(set(given)) == len(given) > 0:
                return given
        return None

    def table(self, step: Step, names: Sequence[str]) -> Item:
        """Return rows over repeated parts as a table, a line for each part."""
        count = self.calc[step.id].shape[1]
        own = [
            n for n in names if n == step.id or self.calc[n].shape[1] == count
        ]  # what is one for all, the formula says
        known = self._names(step)
        table = self._lines("Name" if known else "No.", known or [str(i + 1) for i in range(count)], own)
        return {"type": "table", "title": step.description} | table

    def table_of_parts(self, step: Step, parts: str, names: Sequence[str]) -> Item:
        """Return rows over declared parts, or a list of the inputs: a line for each part by its name."""
        calc, first = self.calc, self.calc.step_or_input(names[0])
        known = calc.part_names.get(parts) or calc.inputs.get(calc.steps[names[0]].named_by)
        heads = known or [str(number + 1) for number in range(calc[names[0]].shape[1])]
        table = self._lines("Name" if getattr(first, "named_by", "") else "Place", heads, names)
        return {"type": "table", "id": step.id, "title": step.description} | table

    def _lines(self, title: str, heads: Sequence[str], names: Sequence[str]) -> Item:
        cells = [(name, self._column_unit(name)) for name in names]
        columns = [_head(title), *(_column(self.calc.step_or_input(name), unit) for name, unit in cells)]
        lines = [[head, *(self._cell(*each, i) for each in cells)] for i, head in enumerate(heads)]
        return {"columns": columns, "rows": lines}

    def table_of_places(self, step: Step, places: Sequence[float]) -> Item:
        """Return places of an abscissa as a table."""
        display = unit_for(self.calc, step.id, step.unit, places)
        lines = [[str(i), place_shown(x, display)["text"]] for i, x in enumerate(places, 1)]
        columns = [_head("No."), _column(step, display)]
        return {"type": "table", "id": step.id, "title": step.description, "columns": columns, "rows": lines}

    def table_of_curves(self, step: Step, at: Item) -> Item:
        """Return the curves of named parts where they are shown."""
        parts, axis = self.calc.inputs[step.named_by], self.calc.axis
        own = [part_result(name, step) for name in parts]
        values = [self.value_at(name, axis[name]) for name in own]
        display = unit_for(self.calc, step.id, step.unit, values)
        texts = [shown(value, display, author_digits(value, display, step.digits))["text"] for value in values]
        place = {"symbol": at["symbol"], "value": with_unit(at["text"], at["unit"])}
        where = Phrase("{title} at {symbol} = {value}", {"title": phrase(step.description), **place})
        columns = [_head("Name"), _column(step, display)]
        lines = [list(line) for line in zip(parts, texts, strict=True)]
        return {"type": "table", "id": step.id, "title": where, "columns": columns, "rows": lines}

    def listing(self, step: Any) -> list[Item]:
        """Return a table that plain code makes."""
        return mechanism.printed(self.calc, step)

    def _column_unit(self, name: str) -> str:
        """The one unit of a column; that of an input is its own."""
        declared, row = self.calc.step_or_input(name), self.calc[name]
        if name not in self.calc.values or np.asarray(row).dtype.kind not in "fc":
            return declared_unit(self.calc, name, declared.unit)
        return unit_for(self.calc, name, declared.unit, row[0])

    def _cell(self, name: str, display: str, part: int) -> str:
        row = self.calc[name]
        value = row[0, min(part, row.shape[1] - 1)]
        if isinstance(value, str):
            return value
        if isinstance(value, np.bool_):
            return "yes" if value else "no"
        if np.isnan(float(value)):
            return "–"
        if name not in self.calc.values:
            return given_shown(float(value), display)["text"]
        step = self.calc.steps[name]
        digits, most = author_digits(float(value), display, step.digits), unit(step.unit).to_si(step.shown_to)
        return shown(float(value), display, digits, most)["text"]


def _head(title: str) -> Item:
    return {"title": title, "symbol": "", "unit": "1"}


def _column(declared: Any, display: str) -> Item:
    return {"title": declared.description, "symbol": declared.symbol, "unit": display}


def negated(condition: Node) -> Node:
    """Return the condition that holds where this one does not."""
    if condition.op != "cmp":
        return Node("not", (condition,))
    sign, *sides = condition.args
    return Node("cmp", (OPPOSITE[sign], *sides))


# What stands beside a printed formula: definitions of the formulas that it calls, and what leads from its units to those of a reader.


def definitions(tree: Node) -> list[dict[str, Any]]:
    """Return the definition of each formula that a tree calls by name, each once: what is defined, and as what."""
    found: dict[str, Formula] = {}
    for formula in _called(tree):
        found.setdefault(formula.printed_as, formula)
    pairs, constants = [], dict[str, Any]()
    for formula in found.values():
        head = Node("apply", (formula.printed_as, *(Node("sym", (name,)) for name in formula.parameters)))
        pairs.append((transform(head, _in_letters), transform(formula.tree, _in_letters)))
        own = set(symbols(formula.tree)) - set(formula.parameters)
        constants |= {symbol: value for symbol, value in formula.constants.items() if symbol in own}
    for symbol, value in constants.items():
        pairs.append((Node("sym", (symbol,)), Node("qty", (shortest(value, MOST_DIGITS), value.unit))))
    return [{"defined": head.to_json(), "as": tree.to_json()} for head, tree in pairs]


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


# What leads from the units of a formula's numbers to those that a reader knows: rad/s to r/min, s to h, rad to degrees.


GIVES_ANGLES = ("arcsin", "arccos", "arctan", "arctan2")  # whose value is read in degrees as it stands


def bridged(substitution: Substitution, numeric: Node | None, target: float, result: Item) -> Item:
    """Return the result in the unit that the formula's numbers give it, where it is printed in another one (``bridge``)."""
    inside = formula_unit(result["unit"])
    if inside == result["unit"] or substitution.is_copy or substitution.in_degrees:
        return {}
    calls = {node.args[0] for node in walk(substitution.part.tree) if node.op == "call"}
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
        told = given_shown(value, display)
        if isinstance(declared, Step):
            told = shown(value, display, declared.digits)
            if display in UNIT_DIGITS:
                told = {"text": number_text(float(rounded(value, display))), "unit": display}
        again = {"text": number_text(value / unit(inside.args[1]).factor, DIGITS), "unit": inside.args[1]}
        yield {"symbol": declared.symbol, "shown": told, "converted": again}


# The calculation as it is printed: for each step an item with its formula, the numbers in it and the result.


TO_ROUNDING = "0 to machine precision"


def section_items(calc: Calculation) -> list[Item]:
    """Return the chapters of the calculation with their items, for the first (only) machine."""
    page = Page(calc)
    chapters: dict[str, Item] = {}
    for section, step in calc.mechanism.active(calc.given):
        chapter = chapters.setdefault(section.title, {"title": section.title, "text": section.text, "items": []})
        chapter["items"] += _once(chapter["items"], [*_with_rounding(calc, items(calc, step))])
        if step.is_shown_at_place and calc.axis.get(step.id) in calc.domains:
            place = page.shown(calc.axis[step.id])
            chapter["shown"] = [*(at for at in chapter.get("shown", []) if at != place), place]
    return [chapter for chapter in chapters.values() if chapter["items"]]


def items(calc: Calculation, step: Step) -> list[Item]:
    """Return what is printed of a step (nothing of breakpoints and requirements)."""
    if not step.printed:
        return []
    row = calc.values[step.id][0] if step.exists is not None and step.id in calc.values else None
    if row is not None and row.dtype.kind in "fc" and np.isnan(row).all():
        text = Phrase("{title}: does not apply to this machine.", title=phrase(step.description))
        return [step.head() | {"type": "note", "text": text}]
    return step.items(Page(calc))


def _with_rounding(calc: Calculation, items: Iterable[Item]) -> Iterator[Item]:
    for item in items:
        is_zero = item.get("result", {}).get("text") == "0" and item["id"] not in calc.axis and "note" not in item
        yield item | {"note": TO_ROUNDING} if is_zero and calc[item["id"]][0, 0] else item


def _once(before: list[Item], new: list[Item]) -> list[Item]:
    """New items; of numbers taken one after another from a table of several columns the first alone names its sources."""
    last = before[-1] if before else {}
    for item in new:
        is_again = item["type"] == last.get("type") == "lookup" and "column" in item
        if is_again and (item["table"], item["key"]) == (last["table"], last["key"]):
            item.pop("note")
    return new
