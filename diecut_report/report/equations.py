"""One item of a calculation as a typeset equation: symbol = formula = numbers = result, in rows that fit the page."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from functools import cache, partial, reduce
from typing import NamedTuple

import mathra
from math_core import LatexToMathML

from diecut_report.report.mathematics import LEVEL, Latex, Linear, Tree, escaped, factors, terms, with_units
from diecut_report.results.mechanism_record import ItemRecord, PlaceRecord, ShownRecord

Measure = Callable[[str], float]  # the width of LaTeX in em

WIDTH = 48.0  # of the text column, in em of the formulas' size
SHORT = 3.0  # a factor that does not stand alone in a line
ONE_LINE = 46.0  # an equation no wider stands in one line
BLANK: Tree = ["sym", ""]  # what a broken-off rest of a sum is added to
OPERATORS = {"max": r"\max", "min": r"\min", "sum": r"\sum", "product": r"\prod", "integral": r"\int"}
SIGNS = {"sum": "∑", "product": "∏", "integral": "∫"}


class Equation(NamedTuple):
    """A typeset equation: its LaTeX, the same as linear text, a line for each row, and the rows for programs that break lines themselves."""

    latex: str
    text: str
    rows: tuple[EquationRow, ...] = ()


class Link(NamedTuple):
    """One side of an equality in both forms, and the tree by which it may be broken, and any other form is printed."""

    latex: str = ""
    text: str = ""
    form: Tree = BLANK


class EquationRow(NamedTuple):
    """A row of an equation: what stands left of the first sign of equality, the links behind it, and the place.

    ``joint`` is the sign between links; of a broken-off rest the one before it, if its first term has none.
    """

    head: Link
    links: list[Link]
    place: Link = Link()
    joint: str = "="

    def latex(self, mark: str = "") -> str:
        """The row as LaTeX; ``mark`` stands where rows are aligned."""
        start = f"{self.head.latex} {mark}= " if self.head.latex or mark else ""
        return start + " = ".join(link.latex for link in self.links) + self.place.latex

    def text(self) -> str:
        """The row as linear text."""
        return " = ".join(link.text for link in (self.head, *self.links) if link.text) + self.place.text


def _without_copies(links: list[Link], result: Link, symbol: str) -> list[Link]:
    """What stands between a symbol and its result, each once: 0, 0 rad and 0° say the same, as do numbers of a lone symbol and the result."""
    if (
        len(links) > 1
        and links[0].form[0] == "sym"
        and links[1].form[0] == "qty"
        and links[1].form[2] == result.form[2]
    ):
        links = links[:1]
    told = (result.text, symbol)
    kept = [link for link in links if link.text not in told and not (_is_nought(link) and _is_nought(result))]
    return [link for before, link in zip([Link(), *kept], kept, strict=False) if link.text != before.text]


def _is_nought(link: Link) -> bool:
    return link.form[0] in ("num", "qty") and link.form[1] == "0"


class Equations:
    """Builds the equations of a report; ``measure`` tells how wide LaTeX comes out."""

    def __init__(self, words: Mapping[str, str], measure: Measure, width: float = WIDTH) -> None:
        self.words = words
        self.measure = measure
        self.width = width
        self.latex = Latex(words, words["decimal"])
        self.linear = Linear(words, words["decimal"])

    def of(self, item: ItemRecord) -> Equation | None:
        """The equation of an item; None where there is nothing to typeset."""
        links = self._links(item)
        head, place = self._symbol(item.symbol), self._place(item)
        if item.relation:
            _, _, left, right = item.relation
            return self._stacked([EquationRow(self._link(left), [self._link(right)]), EquationRow(head, links, place)])
        if not links:
            return None
        whole = EquationRow(head, links, place)
        if self.measure(whole.latex()) <= ONE_LINE:
            return self._single(whole)
        return self._stacked(self._rows(whole))

    def condition(self, item: ItemRecord) -> Equation | None:
        """The condition of the branch taken: in symbols, and with its numbers."""
        links = [self._link(tree) for tree in (item.condition, item.condition_substituted) if tree]
        if not links:
            return None
        row = EquationRow(Link(), links, joint=":")
        return Equation(r":\quad ".join(link.latex for link in links), ": ".join(link.text for link in links), (row,))

    def definitions(self, item: ItemRecord) -> list[Equation]:
        """What the names stand for by which the item's formula calls others: where k_t(x) = …"""
        rows = [EquationRow(self._link(each.defined), [self._link(each.stands_for)]) for each in item.where]
        return [self._single(row) if self.measure(row.latex()) <= self.width else self._stacked([row]) for row in rows]

    def _single(self, row: EquationRow) -> Equation:
        return Equation(row.latex(), row.text(), (row,))

    def _links(self, item: ItemRecord) -> list[Link]:
        result = self._result(item.outcome)
        if item.type == "reduction":
            return [*self._reduced(item), result]
        trees = [tree for tree in (item.equation, item.substituted) if tree]
        links = [*map(self._link, trees), *([self._result(item.bridge)] if item.bridge else [])]
        links = _without_copies(links, result, item.symbol)
        return [*links, result] if trees or item.type in ("found", "lookup") else []

    def _link(self, tree: Tree) -> Link:
        tree = with_units(tree)
        return Link(self.latex(tree), self.linear(tree), tree)

    def _result(self, result: ShownRecord | PlaceRecord) -> Link:
        return self._link(["qty", result.text, result.unit])

    def _symbol(self, name: str) -> Link:
        return self._link(["sym", name]) if name else Link()

    def _reduced(self, item: ItemRecord) -> list[Link]:
        """What is taken of a curve or of repeated parts: max V, mean M …"""
        name, operation = item.of, item.operation
        if not name or operation == "pick":
            return []
        curve = self._symbol(name)
        if operation == "abs_max":
            return [self._link(["call", "max", ["call", "abs", curve.form]])]
        if item.over or operation in ("derivative", "accumulated"):
            return [self._of_calculus(item, curve)]
        if sign := SIGNS.get(operation):
            return [Link(f"{OPERATORS[operation]} {curve.latex}", f"{sign} {curve.text}", ["nary", sign, curve.form])]
        return [self._link(["call", operation if operation in LEVEL else self.words[operation], curve.form])]

    def _of_calculus(self, item: ItemRecord, curve: Link) -> Link:
        """The derivative of a curve, or its integral: up to the place that is shown, or over all of its abscissa."""
        place = item.over or item.at
        assert place is not None, "a curve is taken over something"
        by = self._symbol(place.symbol)
        differential = rf"\mathrm{{d}}{by.latex}"
        if item.operation == "derivative":
            latex = rf"\frac{{\mathrm{{d}}{curve.latex}}}{{{differential}}}"
            return Link(latex, f"d{curve.text}/d{by.text}", ["derivative", curve.form, by.form])
        end = self._result(item.over) if item.over else by
        latex = rf"\int_{{0}}^{{{end.latex}}} {curve.latex}\,{differential}"
        text = f"∫ {curve.text} d{by.text} {self.words['from_nought'].format(end=end.text)}"
        return Link(latex, text, ["integral", curve.form, by.form, end.form])

    def _place(self, item: ItemRecord) -> Link:
        at = item.at
        if not at:
            return Link()
        place, word = self._result(at), self.words["at"]
        latex = rf"\quad\text{{{escaped(word)} }}{self.latex.symbol(at.symbol)} = {place.latex}"
        return Link(latex, f" {word} {at.symbol} = {place.text}", ["place", word, ["sym", at.symbol], place.form])

    def _rows(self, whole: EquationRow) -> list[EquationRow]:
        *formulas, result = whole.links
        if not formulas:
            return [whole]
        rows = [EquationRow(whole.head, formulas[:1])] + [EquationRow(Link(), [link]) for link in formulas[1:]]
        last = rows[-1]._replace(links=[*rows[-1].links, result], place=whole.place)
        if len(rows) > 1 and self.measure(last.latex("")) <= self.width:
            return [*rows[:-1], last]
        return [*rows, EquationRow(Link(), [result], whole.place)]

    def _stacked(self, rows: list[EquationRow]) -> Equation:
        """Rows one below the other, aligned at their first sign of equality, each broken where it is too wide."""
        lines = [line for row in rows for line in self._fitted(row)]
        stacked = r" \\ ".join(latex for latex, _ in lines)
        text = "\n".join(row.text() for row in rows)
        return Equation(rf"\begin{{aligned}} {stacked} \end{{aligned}}", text, tuple(line for _, line in lines))

    def _fitted(self, row: EquationRow) -> list[tuple[str, EquationRow]]:
        """A row's lines; one that cannot be broken stays whole and is made smaller on the page."""
        tree = row.links[0].form
        if self.measure(row.latex()) <= self.width or tree[0] not in ("+", "-", "*") or len(row.links) > 1:
            return [(row.latex("&"), row)]
        first, *others = self._chunks(tree, self.width - self.measure(f"{row.head.latex} = "))
        begin, sign = row._replace(links=[first]), "" if len(terms(tree)) > 1 else "·"
        return [(begin.latex("&"), begin)] + [
            (rf"&\quad {chunk.latex}", EquationRow(Link(), [chunk], joint=sign)) for chunk in others
        ]

    def _chunks(self, tree: Tree, width: float) -> list[Link]:
        """The terms of a sum, or the factors of a product, gathered into lines no wider than ``width``."""
        if len(terms(tree)) > 1:
            groups = [[term] for term in terms(tree)]
            joined = self._sum
        else:
            groups = [[("*", factor)] for factor in factors(tree)]
            joined = self._product
        lines = [groups[0]]
        for group in groups[1:]:
            if self.measure(joined([*lines[-1], *group], first=len(lines) == 1).latex) <= width:
                lines[-1] = [*lines[-1], *group]
            else:
                lines.append(group)
        if joined == self._product and len(lines) > 1 and self.measure(joined(lines[0], first=True).latex) < SHORT:
            lines[:2] = [[*lines[0], *lines[1]]]  # a little too wide rather than a number alone
        return [joined(line, first=index == 0) for index, line in enumerate(lines)]

    def _sum(self, parts: list[tuple[str, Tree]], *, first: bool) -> Link:
        start = parts[0][1] if first else [parts[0][0], BLANK, parts[0][1]]
        tree = reduce(lambda left, term: [term[0], left, term[1]], parts[1:], start)
        return Link(self.latex(tree), form=tree)

    def _product(self, parts: list[tuple[str, Tree]], *, first: bool) -> Link:
        tree = reduce(lambda left, factor: ["*", left, factor], (factor for _, factor in parts))
        whole = self.latex(tree)
        return Link(whole if first else rf"{{}} \cdot {whole}", form=tree)


# Typeset formulas of one report: each LaTeX once as an outline picture (mathra) and once as MathML (math-core).


_SIZE = re.compile(r'viewBox="([-\d.]+) ([-\d.]+) ([-\d.]+) ([-\d.]+)".*?vertical-align: ([-\d.]+)em', re.DOTALL)
SHALLOW = 2000  # letters, in which no formula is nested too deep


class Outline(NamedTuple):
    """A formula as SVG, its viewbox (1000 units an em), and how far it reaches below the line, em (negative)."""

    svg: str
    left: float
    top: float
    width: float
    height: float
    depth: float


class Typesetter:
    """Keeps what it has set, so that a formula is converted once in a report."""

    def __init__(self) -> None:
        self.outline = cache(_outline)
        self.mathml = cache(partial(_mathml, LatexToMathML(), self.outline))

    def measure(self, latex: str) -> float:
        """The width of a formula in em."""
        return self.outline(latex).width / 1000


def _outline(latex: str, *, display: bool = True) -> Outline:
    """A formula as outlines; invalid LaTeX raises ValueError."""
    svg = mathra.tex_to_svg(latex, display=display, strict=True)
    found = _SIZE.search(svg)
    if found is None:
        raise ValueError(f"a typeset formula without a size: {latex}")
    return Outline(svg, *map(float, found.groups()))


def _mathml(core: LatexToMathML, outline: Callable[..., Outline], latex: str, *, display: bool = True) -> str:
    """A formula as MathML."""
    if len(latex) > SHALLOW:
        # this refuses what is nested so deep that the other library would overrun its stack
        outline(latex, display=display)
    return core.convert_with_local_state(latex, displaystyle=display)
