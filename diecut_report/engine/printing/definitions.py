"""What stands below a formula that calls others by their names: their definitions, and the constants in these."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator
from typing import Any

from diecut_report.expressions import Formula, FormulaName
from diecut_report.expressions.tree import Node, transform, walk
from diecut_report.quantities.formatting import shortest

ALL_DIGITS = 17


def definitions(tree: Node) -> list[dict[str, Any]]:
    """Return the definition of each formula that a tree calls by name, each once: what is defined, and as what."""
    found: dict[str, Formula] = {}
    for formula in _called(tree):
        found.setdefault(formula.printed_as, formula)
    defined = [
        _pair(*(transform(side, _in_letters) for side in (_head(formula), formula.tree))) for formula in found.values()
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


def _head(formula: Formula) -> Node:
    return Node("apply", (formula.printed_as, *(Node("sym", (name,)) for name in formula.parameters)))


def _own(formula: Formula) -> dict[str, Any]:
    """The constants that stand in the definition itself."""
    named = {node.args[0] for node in walk(formula.tree) if node.op == "sym"} - set(formula.parameters)
    return {symbol: value for symbol, value in formula.constants.items() if symbol in named}


def _pair(head: Node, tree: Node) -> dict[str, Any]:
    return {"defined": head.to_json(), "as": tree.to_json()}
