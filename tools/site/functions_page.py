"""The functions that a formula may use, from formulas/tree.py: how each is written, how it prints, what it means."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from diecut_report.formulas.formula import Formula
from diecut_report.formulas.tree import FUNCTIONS, OF_TWO, SAID, Node, arccos, as_angle, as_number
from tools.site.formulas import EQUATIONS, TYPESETTER
from tools.site.markup import code, plain, table

X, Y = Node("sym", ("x",)), Node("sym", ("y",))
NUMBER, ONE_KIND = "a number", "of one kind"


class Meaning(NamedTuple):
    """What a function means, what it takes and what it gives."""

    words: str
    takes: str
    gives: str


MEANINGS = {
    "sqrt": Meaning("square root", "any, such as an area", "its root, a length"),
    "sin": Meaning("sine", "an angle", NUMBER),
    "cos": Meaning("cosine", "an angle", NUMBER),
    "tan": Meaning("tangent", "an angle", NUMBER),
    "arcsin": Meaning("angle of a sine, from −π/2 to π/2", NUMBER, "an angle"),
    "arccos": Meaning("angle of a cosine, from 0 to π; the function of the interface forgives what rounding carries beyond ±1", NUMBER, "an angle"),
    "arctan": Meaning("angle of a tangent, from −π/2 to π/2", NUMBER, "an angle"),
    "arctan2": Meaning("angle of the direction (y, x), from −π to π", ONE_KIND, "an angle"),
    "exp": Meaning("exponential", NUMBER, NUMBER),
    "log": Meaning("natural logarithm", NUMBER, NUMBER),
    "log10": Meaning("common logarithm", NUMBER, NUMBER),
    "abs": Meaning("size without its sign", "any", "the same kind"),
    "sign": Meaning("−1, 0 or 1", "any", NUMBER),
    "minimum": Meaning("the lesser of two", ONE_KIND, "the same kind"),
    "maximum": Meaning("the greater of two", ONE_KIND, "the same kind"),
    "ceil": Meaning("the next whole number upwards", NUMBER, NUMBER),
    "floor": Meaning("the next whole number downwards", NUMBER, NUMBER),
    "round": Meaning("the nearest whole number, of two the even one", NUMBER, NUMBER),
    "sinh": Meaning("hyperbolic sine", NUMBER, NUMBER),
    "cosh": Meaning("hyperbolic cosine", NUMBER, NUMBER),
    "tanh": Meaning("hyperbolic tangent", NUMBER, NUMBER),
    "arcsinh": Meaning("inverse of the hyperbolic sine", NUMBER, NUMBER),
    "arccosh": Meaning("inverse of the hyperbolic cosine, of 1 and more", NUMBER, NUMBER),
    "arctanh": Meaning("inverse of the hyperbolic tangent, between −1 and 1", NUMBER, NUMBER),
}  # fmt: skip
MADE_OF_OTHERS = {  # what prints as others do
    "np.where(x > y, x, 2 * y)": (
        Formula(lambda x, y: np.where(x > y, x, 2 * y)),
        Meaning("one or the other, by a condition", ONE_KIND, "the same kind"),
    ),
    "np.hypot(x, y)": (
        Formula(lambda x, y: np.hypot(x, y)),
        Meaning("length of the hypotenuse", ONE_KIND, "the same kind"),
    ),
    "np.clip(x, a, b)": (
        Formula(lambda x, a, b: np.clip(x, a, b)),
        Meaning("x, not below a and not above b", ONE_KIND, "the same kind"),
    ),
}
SAYING = {
    as_number: Meaning("says that radians stand as a plain number", "an angle, 1/s for rad/s", "a number"),
    as_angle: Meaning("says that a plain number stands as radians", "a number", "an angle"),
}
OPERATORS = (
    ("x + y, x - y", "sum and difference, of one kind"),
    ("x * y, x / y, -x", "product, quotient, negative"),
    ("x**2, x**(1/3)", "power; of what has a unit the exponent is a number of the formula itself"),
    ("x < y, <=, >, >=, ==, !=", "a condition, of two of one kind; one comparison at a time"),
    ("(x < y) & (y < z), |, ~", "and, or, not: of conditions, each in brackets"),
    ("np.pi", "π, half a turn: an angle; as_number(np.pi) is the mere number"),
    ("Constant(value, symbol, unit)", "a constant, printed by its symbol and with its value"),
    ("other(x, y)", "another formula: its expression stands in place of the call, or its name with printed_as"),
)


def functions_page() -> Iterator[str]:
    """Yield the page of what a formula may hold."""
    yield from ("# What a formula may hold", "")
    yield (
        "A formula is a lambda, or a `def` with `@formula` that holds assignments and one `return`. What it may hold is here; all else is refused "
        "with its place when the plugin is loaded. It computes on numbers and arrays alike, prints from its own body, and is checked for its "
        "dimensions: what a function takes and gives says so. [Angles, percent and units](units.md) has the rules."
    )
    yield from ("", "## Functions", "")
    yield from table(("written", "printed", "meaning", "takes", "gives"), _rows(), "functions")
    yield from ("## Operators and constants", "")
    yield from table(
        ("written", "meaning"), ((code(written), plain(words)) for written, words in OPERATORS), "functions"
    )


def _rows() -> Iterator[tuple[str, ...]]:
    for function, name in FUNCTIONS.items():
        written = _written(function)
        tree = Node("call", (name, Y, X) if name == "arctan2" else (name, X, Y) if name in OF_TWO else (name, X))
        arguments = "y, x" if name == "arctan2" else "x, y" if name in OF_TWO else "x"
        yield code(f"{written}({arguments})"), _printed(tree), *map(plain, MEANINGS[name])
    for written, (formula, meaning) in MADE_OF_OTHERS.items():
        yield code(written), _printed(formula.tree), *map(plain, meaning)
    for function in SAID:
        yield code(f"{function.__name__}(x)"), _printed(X), *map(plain, SAYING[function])


def _written(function: object) -> str:
    """How it is called: NumPy's with ``np``, Python's own and those of the interface by their names."""
    name = getattr(function, "__name__", "")
    return name if function in (abs, arccos) else f"np.{'abs' if name == 'absolute' else name}"


def _printed(tree: Node) -> str:
    """What the report prints, in a line."""
    return TYPESETTER.mathml(EQUATIONS.latex(tree.to_json()), display=False).replace("|", "&#124;")
