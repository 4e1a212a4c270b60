"""The formulas of a mechanism in its own symbols, from its declarations, typeset as in reports: as MathML."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from diecut_report.formulas.expression import m, node_of
from diecut_report.formulas.formula import is_id
from diecut_report.formulas.tree import FUNCTIONS, OF_TWO, Node, arccos_of, transform
from diecut_report.machine.printing.page import definitions
from diecut_report.mechanism.inputs import fields
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.names import ByText, Written, formula_of
from diecut_report.mechanism.steps import (
    Accumulated,
    Choice,
    Derivative,
    Interpolated,
    Reduction,
    Require,
    Root,
    Running,
    Step,
    Total,
    Value,
    named,
)
from diecut_report.report.equations import OPERATORS, Equations, Typesetter
from diecut_report.report.text import Catalogue
from diecut_report.results.mechanism_record import ItemRecord
from tools.site.markup import code, plain, table

WIDTH = 44.0  # of the page's text, in em of its formulas
WORDS = Catalogue("en")
TYPESETTER = Typesetter()
NEVER_WIDE = 90  # letters of LaTeX, which are narrower than the page whatever they say


def _measured(latex: str) -> float:
    return TYPESETTER.measure(latex) if len(latex) > NEVER_WIDE else 0.0


EQUATIONS = Equations(WORDS, _measured, WIDTH)


class Formulas:
    """Typesets the steps of one mechanism."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.inputs = dict(fields(mechanism.inputs))
        self.steps: dict[str, list[tuple[frozenset[str], Step]]] = {}
        self.axes: dict[str, str] = {}
        for chapter, step in mechanism.steps:
            self.steps.setdefault(step.id, []).append((frozenset(chapter.needs + step.needs), step))
        for given in (frozenset(), frozenset(self.inputs)):
            self.axes |= mechanism.axes(given)

    def of(self, step: Step) -> list[str]:
        """Return what is typeset of a step, each as MathML; nothing of what words alone tell."""
        return [TYPESETTER.mathml(latex) for latex in self._latex(step)]

    def symbol(self, name: str, asked: Step | None = None) -> str:
        """Return the symbol of a quantity by its id, as the step sees it that asks: of several with one id that which is there with it."""
        found = self._step(name, asked)
        if found is None:
            plain = named(name, {id: each[-1][1] for id, each in self.steps.items()})
            if plain is not None and plain.role == "place":
                return f"{self.symbol(self.axes[plain.id.removesuffix('_at')])}" if plain.id in self.axes else name
            meta = self.inputs.get(name.removeprefix("inputs."))
            return getattr(meta, "symbol", "") or name
        return found.symbol or name

    def _step(self, name: str, asked: Step | None) -> Step | None:
        """The step of an id: not one that is left out where the asking one is made, nor, if there is another, the asking one itself."""
        known = self.steps.get(name, [])
        fit = [
            step
            for needs, step in known
            if asked is None or (needs.isdisjoint(asked.lacks) and not set(asked.needs) & set(step.lacks))
        ]
        return next((step for step in fit if step is not asked), fit[0] if fit else None)

    def _latex(self, step: Step) -> Iterator[str]:
        match step:
            case Interpolated():
                return
            case Value(formula=ByText() as choice):
                for option in choice.options():
                    yield from self._equation(step, self._tree(step, option))
            case Value(formula=formula):
                yield from self._equation(step, self._tree(step, formula))
            case Choice(cases=cases):
                yield from self._equation(step, Node("cases", tuple(self._branches(step, cases))))
            case Root(left=left, right=right):
                yield _set(self._tree(step, left), self._tree(step, right))
            case Require(condition=condition):
                yield EQUATIONS.latex(self._tree(step, condition).to_json())
            case Reduction() | Total() | Running() | Accumulated() | Derivative():
                yield self._taken(step)

    def _tree(self, step: Step, part: Written) -> Node:
        """A formula with the mechanism's symbols in place of its quantities."""
        return transform(formula_of(part).tree, lambda leaf: self._leaf(leaf, step))

    def _leaf(self, leaf: Node, step: Step) -> Node:
        is_quantity = leaf.op == "sym" and is_id(leaf.args[0])
        return Node("sym", (self.symbol(leaf.args[0], step),)) if is_quantity else leaf

    def _branches(self, step: Choice, cases: tuple[object, ...]) -> Iterator[tuple[Node, ...]]:
        for each in step.cases:
            value = self._tree(step, each.value) if not isinstance(each.value, str) else Node("num", (each.value,))
            yield (value,) if each.condition is None else (value, self._tree(step, each.condition))

    def _equation(self, step: Step, tree: Node) -> Iterator[str]:
        yield _set(Node("sym", (step.symbol or step.id,)), tree)
        for each in EQUATIONS.definitions(_defining(definitions(tree))):
            yield rf"\text{{where }} {each.latex}"

    def _taken(self, step: Reduction | Total | Running | Accumulated | Derivative) -> str:
        """What is taken of a curve or of a row."""
        of, own = EQUATIONS.latex.symbol(self.symbol(step.of, step)), EQUATIONS.latex.symbol(step.symbol)
        if isinstance(step, Accumulated | Derivative):
            by = EQUATIONS.latex.symbol(self.symbol(self.axes.get(step.of, step.of)))
            if isinstance(step, Derivative):
                return rf"{own} = \frac{{\mathrm{{d}}{of}}}{{\mathrm{{d}}{by}}}"
            return rf"{own} = \int_{{0}}^{{{by}}} {of}\,\mathrm{{d}}{by}"
        if step.operation == "abs_max":
            return rf"{own} = \max \left| {of} \right|"
        word = OPERATORS.get(step.operation, rf"\operatorname{{{step.operation}}}")
        return rf"{own} = {word} {of}"


def _set(left: Node, right: Node) -> str:
    """An equation, in rows where it is wider than the page."""
    return EQUATIONS.definitions(_defining([{"defined": left.to_json(), "as": right.to_json()}]))[0].latex


def _defining(where: list[dict[str, Any]]) -> ItemRecord:
    """A printed step that has these definitions alone."""
    return ItemRecord.model_validate({"type": "formula", "where": where})


# The functions that a formula may use, from formulas/tree.py: how each is written, how it prints, what it means.


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
        np.where(m.x > m.y, m.x, 2 * m.y),
        Meaning("one or the other, by a condition", ONE_KIND, "the same kind"),
    ),
    "np.hypot(x, y)": (
        np.hypot(m.x, m.y),
        Meaning("length of the hypotenuse", ONE_KIND, "the same kind"),
    ),
    "np.clip(x, a, b)": (
        np.clip(m.x, m.a, m.b),
        Meaning("x, not below a and not above b", ONE_KIND, "the same kind"),
    ),
}
SAYING = {
    "as_number": Meaning("says that radians stand as a plain number", "an angle, 1/s for rad/s", "a number"),
    "as_angle": Meaning("says that a plain number stands as radians", "a number", "an angle"),
}
WRITTEN_OPERATORS = (
    ("x + y, x - y", "sum and difference, of one kind"),
    ("x * y, x / y, -x", "product, quotient, negative"),
    ("x**2, x**(number(1) / 3)", "power; of what has a unit the exponent is a number of the formula itself"),
    ("x < y, <=, >, >=, ==, !=", "a condition, of two of one kind; one comparison at a time"),
    ("(x < y) & (y < z), |, ~", "and, or, not: of conditions, each in brackets"),
    ("pi", "π, half a turn: an angle; as_number(pi) is the mere number"),
    ("number(1) / 3", "1/3 as it is written; 1 / 3 is 0.3333…"),
    ("Constant(value, symbol, unit)", "a constant, printed by its symbol and with its value"),
    ("other(x, y)", "another formula: its expression stands in place of the call, or its name with printed_as"),
)


def functions_page() -> Iterator[str]:
    """Yield the page of what a formula may hold."""
    yield from ("# What a formula may hold", "")
    yield (
        "A formula is an expression of quantities, `m.ID`, or a function that is given such. What it may hold is here; all else is refused "
        "with its line when the plugin is loaded. The same expression is printed, computes on numbers and arrays, and is checked for its "
        "dimensions: what a function takes and gives says so. [Angles, percent and units](units.md) has the rules."
    )
    yield from ("", "## Functions", "")
    yield from table(("written", "printed", "meaning", "takes", "gives"), _rows(), "functions")
    yield from ("## Operators and constants", "")
    yield from table(
        ("written", "meaning"), ((code(written), plain(words)) for written, words in WRITTEN_OPERATORS), "functions"
    )


def _rows() -> Iterator[tuple[str, ...]]:
    for function, name in FUNCTIONS.items():
        written = _written(function)
        tree = Node("call", (name, Y, X) if name == "arctan2" else (name, X, Y) if name in OF_TWO else (name, X))
        arguments = "y, x" if name == "arctan2" else "x, y" if name in OF_TWO else "x"
        yield code(f"{written}({arguments})"), _printed(tree), *map(plain, MEANINGS[name])
    for written, (expression, meaning) in MADE_OF_OTHERS.items():
        yield code(written), _printed(node_of(expression)), *map(plain, meaning)
    for name, meaning in SAYING.items():
        yield code(f"{name}(x)"), _printed(X), *map(plain, meaning)


def _written(function: object) -> str:
    """How it is called: NumPy's with ``np``, Python's own and those of the interface by their names."""
    name = getattr(function, "__name__", "")
    return (
        "arccos"
        if function is arccos_of
        else name
        if function is abs
        else f"np.{'abs' if name == 'absolute' else name}"
    )


def _printed(tree: Node) -> str:
    """What the report prints, in a line."""
    return TYPESETTER.mathml(EQUATIONS.latex(tree.to_json()), display=False).replace("|", "&#124;")
