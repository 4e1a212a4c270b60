"""A formula is written once, as a small Python function: it computes, and its own syntax tree prints.

A formula is a lambda or a function marked by ``@formula`` whose parameters are named for what it takes (SI), whose body holds
assignments of intermediate terms and one return, in plain NumPy. Calling it computes, on numbers and on arrays; ``.tree`` is
what prints. The tree is read on first use only, so that importing a plugin costs nothing for it.
"""

from typing import Any

from numpy.typing import NDArray

from diecut_report.formulas.formula import LAMBDA, Formula, FormulaError, FormulaName, Reading, evaluate, formula
from diecut_report.formulas.tree import (
    APPLY,
    AS_ANGLE,
    AS_NUMBER,
    BINARY,
    COMPARE,
    FUNCTIONS,
    GRAVITY,
    NUMERIC,
    PI,
    Constant,
    Node,
    arccos,
    as_angle,
    as_number,
    substitute,
    symbols,
    transform,
    walk,
    written,
)

Array = NDArray[Any]

__all__ = [
    "APPLY", "AS_ANGLE", "AS_NUMBER", "BINARY", "COMPARE", "FUNCTIONS", "GRAVITY", "LAMBDA", "NUMERIC", "PI", "Array", "Constant",
    "Formula", "FormulaError", "FormulaName", "Node", "Reading", "arccos", "as_angle", "as_number", "evaluate", "formula", "substitute",
    "symbols", "transform", "walk", "written",
]  # fmt: skip
