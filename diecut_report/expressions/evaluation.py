"""Computing a tree as it is printed."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from diecut_report.expressions.formula import FormulaName
from diecut_report.expressions.functions import APPLY, NUMERIC
from diecut_report.expressions.tree import Node
from diecut_report.languages.phrases import phrase


def evaluate(node: Node, value_of: Callable[[Node], Any]) -> Any:
    """Compute the tree as it is printed; ``value_of`` gives the SI value of ``sym`` and ``qty`` leaves."""
    match node:
        case Node("num", (text,)):
            return float(text)
        case Node("sym", ("π",)):
            return math.pi
        case Node("sym" | "qty", _):
            return value_of(node)
        case Node("call", (name, *args)):
            return NUMERIC[name](*(evaluate(a, value_of) for a in args))
        case Node("apply", (FormulaName(formula=called), *args)):
            known = dict(zip(called.parameters, (evaluate(a, value_of) for a in args), strict=True))
            return evaluate(called.tree, lambda leaf: known[leaf.args[0]] if leaf.args[0] in known else value_of(leaf))
        case Node("cmp", (sign, left, right)):
            return APPLY[sign](evaluate(left, value_of), evaluate(right, value_of))
        case Node("cases", branches):
            return _first_that_holds(branches, value_of)
    return APPLY[node.op](*(evaluate(a, value_of) for a in node.args))


def _first_that_holds(branches: tuple[tuple[Node, ...], ...], value_of: Callable[[Node], Any]) -> Any:
    for number, branch in enumerate(branches):
        if len(branch) == 1:
            return evaluate(branch[0], value_of)
        held = evaluate(branch[1], value_of)
        if np.ndim(held):
            return np.where(held, evaluate(branch[0], value_of), _first_that_holds(branches[number + 1 :], value_of))
        if held:
            return evaluate(branch[0], value_of)
    raise ValueError(phrase("no case of the formula holds"))
