"""What stands beside a printed formula: definitions of the formulas that it calls, and what leads from its units to those of a reader."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator
from typing import Any

from diecut_report.formulas.formula import Formula, FormulaName
from diecut_report.formulas.tree import Node, symbols, transform, walk
from diecut_report.machine.printing.substitution import Substitution, formula_unit
from diecut_report.mechanism.steps import Step
from diecut_report.mechanism.steps.protocols import Item
from diecut_report.quantities.formatting import DIGITS, UNIT_DIGITS, given_shown, number_text, rounded, shortest, shown
from diecut_report.quantities.units import unit

ALL_DIGITS = 17


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
        pairs.append((Node("sym", (symbol,)), Node("qty", (shortest(value, ALL_DIGITS), value.unit))))
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
        told = given_shown(value, display)
        if isinstance(declared, Step):
            told = shown(value, display, declared.digits)
            if display in UNIT_DIGITS:
                told = {"text": number_text(float(rounded(value, display))), "unit": display}
        again = {"text": number_text(value / unit(inside.args[1]).factor, DIGITS), "unit": inside.args[1]}
        yield {"symbol": declared.symbol, "shown": told, "converted": again}
