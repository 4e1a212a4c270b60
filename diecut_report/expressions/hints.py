"""What to write instead of what a formula cannot hold: Python that takes one machine alone, functions that are not NumPy's."""

from __future__ import annotations

import ast

from diecut_report.expressions.functions import NUMERIC
from diecut_report.languages.phrases import Phrase, phrase

LISTED = phrase("a formula holds assignments, one return, arithmetic, NumPy functions, constants and other formulas")
OF_NUMPY = {name: name for name in NUMERIC} | {
    "asin": "arcsin", "acos": "arccos", "atan": "arctan", "atan2": "arctan2", "asinh": "arcsinh", "acosh": "arccosh", "atanh": "arctanh",
    "min": "minimum", "max": "maximum", "fabs": "abs",
}  # fmt: skip
"""Functions as Python's own library calls them, each with its name in NumPy."""


def instead(node: ast.AST, value: object) -> str:
    """Return in words what to write instead of a part of a formula; ``value`` is what it stands for where it is a name."""
    match node:
        case ast.BoolOp(op=ast.And()):
            return phrase("write (a) & (b), each condition in brackets, which takes arrays too")
        case ast.BoolOp(op=ast.Or()):
            return phrase("write (a) | (b), each condition in brackets, which takes arrays too")
        case ast.UnaryOp(op=ast.Not()):
            return phrase("write ~(a), which takes arrays too")
        case ast.Compare(ops=[_, _, *_]):
            return phrase("write (a < b) & (b < c), which takes arrays too")
        case ast.IfExp() | ast.If():
            return phrase("write np.where(condition, a, b), which takes arrays too")
        case ast.Call(func=ast.Name(id=name) | ast.Attribute(value=ast.Name(id="math"), attr=name)) if name in OF_NUMPY:
            return Phrase("write np.{of_numpy}, which takes arrays too", of_numpy=OF_NUMPY[name])
        case ast.Name(id=name) if isinstance(value, int | float) and not isinstance(value, bool):
            return Phrase(
                "write the number itself, or bind it: bind(…, {name}={value}), or make it one of the constants, "
                "Constant(value, symbol, unit), which are printed with their symbols",
                name=name,
                value=format(value, "g"),
            )
    return LISTED
