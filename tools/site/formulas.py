"""The formulas of a mechanism in its own symbols, from its declarations, typeset as in reports: as MathML."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from diecut_report.formulas.tree import Node, transform
from diecut_report.machine.printing.page import definitions
from diecut_report.mechanism.inputs import fields
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.names import Bound, ByText, Written, bound
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
        """A formula with the mechanism's symbols in place of its parameters."""
        link = bound(part)
        return transform(link.formula.tree, lambda leaf: self._leaf(leaf, link, step))

    def _leaf(self, leaf: Node, link: Bound, step: Step) -> Node:
        name = link.names.get(leaf.args[0]) if leaf.op == "sym" else None
        if name is None:
            return leaf
        return Node("sym", (self.symbol(name, step),)) if isinstance(name, str) else Node("num", (f"{name:g}",))

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
