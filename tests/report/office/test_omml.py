"""Equations as Office Math: read back from their XML they say what the tree says, by elements that an editor of formulas knows."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any
from xml.etree import ElementTree

import pytest

from diecut_report.report.mathematics import WORDS
from diecut_report.report.office.wordml import SPACE, OfficeMath, office_math
from diecut_report.report.rendering import Rendering
from tests.report.made_results import typed

M = f"{{{SPACE}}}"
Element = ElementTree.Element


def read(element: Element) -> str:
    """What an element says, on one line; an element that is not known fails."""
    name = element.tag.removeprefix(M)
    inner = {child.tag.removeprefix(M): child for child in element}
    if name in ("rPr", "dPr", "radPr", "naryPr", "mPr", "oMathParaPr"):
        return ""
    if name == "t":
        return element.text or ""
    if name in SHAPES:
        return SHAPES[name](element, {key: read(child) for key, child in inner.items()})
    assert name in ("oMathPara", "oMath", "r", "e", "num", "den", "sub", "sup", "fName", "deg", "mr"), name
    assert not (element.text or "").strip() and not any((child.tail or "").strip() for child in element)
    return "".join(read(child) for child in element)


def _delimited(element: Element, inner: dict[str, str]) -> str:
    ends = [element.find(f"{M}dPr/{M}{end}") for end in ("begChr", "endChr")]
    left, right = (end.get(f"{M}val") for end in ends if end is not None)
    return f"{left}{inner['e']}{right}"


def _nary(element: Element, inner: dict[str, str]) -> str:
    sign = element.find(f"{M}naryPr/{M}chr")
    assert sign is not None
    return f"{sign.get(f'{M}val')}[{inner['sub']},{inner['sup']}]({inner['e']})"


def _matrix(element: Element, _: dict[str, str]) -> str:
    return "; ".join(" , ".join(map(read, row.findall(f"{M}e"))) for row in element.findall(f"{M}mr"))


SHAPES: dict[str, Callable[[Element, dict[str, str]], str]] = {
    "f": lambda _, inner: f"({inner['num']})/({inner['den']})",
    "rad": lambda _, inner: f"√({inner['e']})",
    "sSub": lambda _, inner: f"{inner['e']}_{inner['sub']}",
    "sSup": lambda _, inner: f"{inner['e']}^{inner['sup']}",
    "sSubSup": lambda _, inner: f"{inner['e']}_{inner['sub']}^{inner['sup']}",
    "func": lambda _, inner: f"{inner['fName']}<{inner['e']}>",
    "d": _delimited,
    "nary": _nary,
    "m": _matrix,
}


def printed(tree: list[Any], decimal: str = ".") -> str:
    """A tree as Office Math, read back; narrow spaces between factors as *."""
    from diecut_report.report.equations import Equation, EquationRow, Link

    equation = Equation("", "", (EquationRow(Link(), [Link(form=tree)], joint=":"),))
    (line,) = office_math(equation, OfficeMath(WORDS, decimal))
    root = ElementTree.fromstring(line.replace("<m:oMathPara>", f'<m:oMathPara xmlns:m="{SPACE}">', 1))
    return read(root).replace("\u2009", "*").replace("\u00a0", " ")


A, B, X = ["sym", "a"], ["sym", "b"], ["sym", "x_max"]
ONE, TWO = ["num", "1"], ["num", "2"]


@pytest.mark.parametrize(
    ("tree", "text"),
    [
        (["/", ["+", A, B], ["-", A, B]], "(a+b)/(a−b)"),
        (["*", ["+", A, B], TWO], "(a+b)·2"),
        (["^", X, TWO], "x_max^2"),
        (["^", ["+", A, B], ["/", ONE, TWO]], "(a+b)^1/2"),
        (["call", "sqrt", ["-", ["^", A, TWO], B]], "√(a^2−b)"),
        (["call", "sin", A], "sin<a>"),
        (["call", "arctan", ["/", A, B]], "arctan<((a)/(b))>"),
        (["call", "abs", ["-", A, B]], "|a−b|"),
        (["call", "ceil", A], "⌈a⌉"),
        (["call", "arctan2", A, B], "arctan2<(a,b)>"),
        (["cases", [A, ["cmp", "<=", A, B]], [B]], "{a , if a≤b; b , otherwise"),
        (["cmp", "<", A, B], "a<b"),
        (["apply", "k_t", A], "k_t(a)"),
        (["neg", A], "−a"),
        (["derivative", A, B], "(da)/(db)"),
        (["integral", A, B, B], "∫[0,b](a*db)"),
        (["nary", "∑", A], "∑[,](a)"),
        (["qty", "12500", "N*mm"], "12\u202f500 N·mm"),
        (["qty", "-1.2e-05", "m**2"], "−1.2*×*10^−5 m²"),
        (["qty", "51.75", "deg"], "51.75°"),
        (["sym", "|F_s|"], "|F_s|"),
        (["sym", "r′_a"], "r′_a"),
    ],
)
def test_a_tree_reads_back(tree: list[Any], text: str) -> None:
    assert printed(tree) == text


def test_the_decimal_sign_is_that_of_the_language() -> None:
    assert printed(["qty", "51.75", "mm"], decimal=",") == "51,75 mm"


def test_units_stand_upright_and_letters_do_not() -> None:
    printer = OfficeMath(WORDS)
    assert 'm:val="p"' in printer(["qty", "5", "mm"]) and 'm:val="i"' not in printer(["qty", "5", "mm"])
    assert 'm:val="i"' in printer(["sym", "a"])


def test_an_operator_that_begins_a_line_has_something_before_it(plain: dict[str, Any]) -> None:
    printer = OfficeMath(WORDS)
    items = [item for part in Rendering(typed(plain)).document.chapters for s in part.sections for item in s.items]
    lines = [line for item in items if item.equation for line in office_math(item.equation, printer)]
    texts = ["".join(t.text or "" for t in _parsed(line).iter(f"{M}t")) for line in lines]
    assert any(text.startswith("\u200b=") for text in texts)
    assert [text for text in texts if text[:1] in "=·+"] == []


def test_every_equation_has_its_rows_and_nothing_stands_outside_of_runs(plain: dict[str, Any]) -> None:
    document = Rendering(typed(plain)).document
    items = [item for part in document.chapters for section in part.sections for item in section.items]
    equations = [e for item in items for e in (item.equation, item.condition, *item.definitions) if e]
    assert len(equations) > 10
    for equation in equations:
        for line in office_math(equation, OfficeMath(WORDS)):
            assert read(_parsed(line))


def _parsed(line: str) -> Element:
    return ElementTree.fromstring(line.replace("<m:oMathPara>", f'<m:oMathPara xmlns:m="{SPACE}">', 1))
