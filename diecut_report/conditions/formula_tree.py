"""The tree of an expression as the tree of a formula, so that it may stand within one."""

from __future__ import annotations

from collections.abc import Mapping

from diecut_report.conditions.tree import Call, Chain, ColumnName, Negative, Node, Number, Power
from diecut_report.expressions import Node as FormulaNode


def as_formula(node: Node, known: Mapping[str, FormulaNode]) -> FormulaNode:
    """Return the tree of an expression with what its names stand for."""
    match node:
        case Number(value):
            return FormulaNode("qty", (value,))
        case ColumnName(name):
            return known[name]
        case Negative(of):
            return FormulaNode("neg", (as_formula(of, known),))
        case Chain(first, rest):
            found = as_formula(first, known)
            for sign, part in rest:
                found = FormulaNode(sign, (found, as_formula(part, known)))
            return found
        case Power(base, exponent):
            return FormulaNode("^", (as_formula(base, known), as_formula(exponent, known)))
        case Call(name, of):
            return _called(name, [as_formula(part, known) for part in of])
    raise TypeError(f"{node} is not a number")


def _called(name: str, given: list[FormulaNode]) -> FormulaNode:
    """The least and the greatest take two at a time in formulas."""
    if name in ("abs", "sqrt"):
        return FormulaNode("call", (name, *given))
    found = given[0]
    for each in given[1:]:
        found = FormulaNode("call", ({"min": "minimum", "max": "maximum"}[name], found, each))
    return found
