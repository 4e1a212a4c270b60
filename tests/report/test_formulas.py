"""Expressions in print, both as LaTeX and as linear text; symbols in formulas and in running text."""

from __future__ import annotations

import math
import operator
import re
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from markupsafe import Markup

from diecut_report.report.chapters.repetition import SaidOnce, ToldBefore
from diecut_report.report.chapters.steps import PrintedSteps
from diecut_report.report.chapters.tables import Tables
from diecut_report.report.equations import WIDTH, Equations, Typesetter
from diecut_report.report.mathematics import Latex, Linear, unit_latex
from diecut_report.report.model import Heading
from diecut_report.report.symbols import (
    SymbolRow,
    cited,
    declared_letters,
    in_blocks,
    letters_declared,
    own_words,
    pieces,
    prose,
    symbol,
    symbol_rows,
)
from diecut_report.report.text import Catalogue
from diecut_report.results.mechanism_record import ItemRecord, MechanismRecord, SectionRecord
from tests.records import filled
from tests.report.made_results import sample, typed

Tree = list[Any]
A, B, C = ["sym", "a"], ["sym", "b"], ["sym", "c"]
ONE, TWO, THREE = ["num", "1"], ["num", "2"], ["num", "3"]
NEG_A = ["neg", A]
MM = ["qty", "40", "mm"]

CASES: list[tuple[Tree, str, str]] = [
    (["-", A, ["-", B, C]], r"a - (b - c)", "a − (b − c)"),
    (["+", A, ["*", ["neg", ["num", "0.13"]], B]], r"a - 0.13\,b", "a − 0.13·b"),
    (["+", A, ["*", ["num", "-0.5"], B]], r"a - 0.5\,b", "a − 0.5·b"),
    (["-", A, ["*", ["*", ["neg", TWO], B], C]], r"a + 2\,b\,c", "a + 2·b·c"),
    (["call", "minimum", ["call", "minimum", A, B], C], r"\min(a,\, b,\, c)", "min(a, b, c)"),
    (["call", "maximum", ["call", "minimum", A, B], C], r"\max(\min(a,\, b),\, c)", "max(min(a, b), c)"),
    (["apply", "inv", A], r"\operatorname{inv}(a)", "inv(a)"),
    (["*", A, ["qty", "1", "in"]], r"a \cdot 1\,\mathrm{in}", "a · 1 in"),
    (["-", ["-", A, B], C], r"a - b - c", "a − b − c"),
    (["-", A, ["+", B, C]], r"a - (b + c)", "a − (b + c)"),
    (["+", A, ["-", B, C]], r"a + b - c", "a + b − c"),
    (["/", ["/", A, B], C], r"\frac{\frac{a}{b}}{c}", "a/b/c"),
    (["/", A, ["/", B, C]], r"\frac{a}{\frac{b}{c}}", "a/(b/c)"),
    (["/", A, ["*", B, C]], r"\frac{a}{b\,c}", "a/(b·c)"),
    (["/", ["+", A, B], C], r"\frac{a + b}{c}", "(a + b)/c"),
    (["*", ["/", A, B], C], r"\frac{a}{b}\,c", "a/b·c"),
    (["*", A, ["/", B, C]], r"a\,\frac{b}{c}", "a·b/c"),
    (["*", ["+", A, B], C], r"(a + b)\,c", "(a + b)·c"),
    (["^", NEG_A, TWO], r"{(-a)}^{2}", "(−a)²"),
    (["neg", ["^", A, TWO]], r"-a^{2}", "−a²"),
    (["^", ["/", A, B], TWO], r"{\left( \frac{a}{b} \right)}^{2}", "(a/b)²"),
    (["^", ["*", A, B], TWO], r"{(a\,b)}^{2}", "(a·b)²"),
    (["^", MM, TWO], r"{(40\,\mathrm{mm})}^{2}", "(40 mm)²"),
    (["^", ["^", A, B], C], r"{(a^{b})}^{c}", "(a^(b))^(c)"),
    (["^", A, ["/", ONE, THREE]], r"a^{1/3}", "a^(1/3)"),
    (["^", ["sym", "R_b"], TWO], r"R_{\mathrm{b}}^{2}", "R_b²"),
    (["^", ["call", "cos", A], TWO], r"{(\cos a)}^{2}", "(cos a)²"),
    (["^", ["call", "abs", A], TWO], r"{\left| a \right|}^{2}", "|a|²"),
    (["^", ["call", "sqrt", A], TWO], r"{\left( \sqrt{a} \right)}^{2}", "(√a)²"),
    (["+", A, ["neg", B]], r"a + (-b)", "a + (−b)"),
    (["-", A, ["neg", ["+", B, C]]], r"a - (-(b + c))", "a − (−(b + c))"),
    (["*", A, ["neg", B]], r"a\,(-b)", "a·(−b)"),
    (["*", NEG_A, B], r"-a\,b", "−a·b"),
    (["-", ONE, ["*", NEG_A, B]], r"1 - (-a\,b)", "1 − (−a·b)"),
    (["-", ONE, ["/", NEG_A, B]], r"1 - \frac{-a}{b}", "1 − (−a)/b"),
    (["neg", NEG_A], r"-(-a)", "−(−a)"),
    (["+", MM, ["qty", "-0.5", "mm"]], r"40\,\mathrm{mm} + (-0.5\,\mathrm{mm})", "40 mm + (−0.5 mm)"),
    (["*", ["qty", "-0.5", "1"], MM], r"-0.5 \cdot 40\,\mathrm{mm}", "−0.5 · 40 mm"),
    (["*", MM, ["qty", "-0.5", "1"]], r"40\,\mathrm{mm} \cdot (-0.5)", "40 mm · (−0.5)"),
    (["*", TWO, ["/", THREE, C]], r"2 \cdot \frac{3}{c}", "2 · 3/c"),
    (["*", TWO, A], r"2\,a", "2·a"),
    (["*", TWO, MM], r"2 \cdot 40\,\mathrm{mm}", "2 · 40 mm"),
    (["*", MM, ["call", "cos", ["qty", "60", "deg"]]], r"40\,\mathrm{mm} \cdot \cos(60°)", "40 mm · cos(60°)"),
    (["*", ["call", "cos", A], B], r"\cos(a)\,b", "cos(a)·b"),
    (["*", ["call", "sin", A], ["call", "cos", A]], r"\sin a\,\cos a", "sin a·cos a"),
    (["call", "sqrt", ["+", A, B]], r"\sqrt{a + b}", "√(a + b)"),
    (["call", "arctan2", A, ["-", B, ONE]], r"\operatorname{arctan2}(a,\, b - 1)", "arctan2(a, b − 1)"),
    (["call", "minimum", A, B], r"\min(a,\, b)", "min(a, b)"),
    (["call", "sign", ["neg", A]], r"\operatorname{sgn}(-a)", "sgn(−a)"),
    (["call", "ceil", ["/", A, B]], r"\left\lceil  \frac{a}{b} \right\rceil ", "⌈a/b⌉"),
    (["call", "exp", NEG_A], r"\exp(-a)", "exp(−a)"),
    (["call", "log", A], r"\ln a", "ln a"),
    (["cmp", "<=", A, ["+", B, C]], r"a \le b + c", "a ≤ b + c"),
    (["+", ["cmp", "<", A, B], ONE], r"(a < b) + 1", "(a < b) + 1"),
    (["cases", [NEG_A, ["and", ["cmp", "<", A, B], ["cmp", "!=", B, C]]], [["num", "0"]]],
     r"\begin{cases} -a & \text{if }a < b\text{ and }b \ne c \\ 0 & \text{otherwise} \end{cases}",
     "{−a if a < b and b ≠ c; 0 otherwise}"),
]  # fmt: skip


@pytest.mark.parametrize(("tree", "latex", "linear"), CASES)
def test_brackets(tree: Tree, latex: str, linear: str) -> None:
    assert Latex()(tree) == latex
    assert Linear()(tree) == linear


@pytest.mark.parametrize(("name", "latex"), [
    ("R", "R"), ("R_b", r"R_{\mathrm{b}}"), ("λ_1", "λ_{1}"), ("M_Σ", r"M_{\mathrm{Σ}}"), ("η_sector", r"η_{\mathrm{sector}}"),
    ("η_four_bar", r"η_{\mathrm{four}\,\mathrm{bar}}"), ("m′", "m'"),
    ("η_four-bar", r"η_{\mathrm{four}\text{-}\mathrm{bar}}"), ("β_c′", r"β'_{\mathrm{c}}"),
    ("me", r"\mathit{me}"), ("F_t,max", r"F_{\mathrm{t},\mathrm{max}}"),
    ("P_різ", r"P_{\mathrm{різ}}"), ("|e_cf|", r"\left| e_{\mathrm{cf}} \right|"), ("", "{}"),
])  # fmt: skip
def test_symbols(name: str, latex: str) -> None:
    assert Latex().symbol(name) == latex


@pytest.mark.parametrize(("unit", "latex"), [
    ("mm", r"\mathrm{mm}"), ("1", ""), ("kg*m**2", r"\mathrm{kg}{\cdot}\mathrm{m}^{2}"), ("m/s**2", r"\mathrm{m}/\mathrm{s}^{2}"),
    ("%", r"\%"), ("deg", "°"), ("1/h", r"1/\mathrm{h}"),
])  # fmt: skip
def test_units_stand_upright(unit: str, latex: str) -> None:
    assert unit_latex(unit) == latex


def test_words_of_another_language_and_its_decimal_sign() -> None:
    words = {"if": "якщо", "otherwise": "інакше", "and": "та", "or": "або", "not": "не"}
    tree = ["cases", [["qty", "0.5", "mm"], ["cmp", "<", A, B]], [["num", "0"]]]
    assert Linear(words, ",")(tree) == "{0,5 mm якщо a < b; 0 інакше}"
    assert r"0{,}5\,\mathrm{mm}" in Latex(words, ",")(tree)


@pytest.mark.parametrize("tree", [case[0] for case in CASES])
def test_both_typesetters_take_it(tree: Tree) -> None:
    typesetter, latex = Typesetter(), Latex()(tree)
    assert typesetter.mathml(latex).startswith("<math")
    assert typesetter.measure(latex) > 0.3


# Random arithmetic, read again from the linear text, gives the same value.
def _trees() -> st.SearchStrategy[Tree]:
    leaves = st.integers(-9, 9).filter(bool).map(lambda n: ["qty", str(n), "1"]) | st.integers(1, 9).map(
        lambda n: ["num", str(n)]
    )
    return st.recursive(
        leaves,
        lambda inner: (
            st.builds(lambda o, a, b: [o, a, b], st.sampled_from("+-*/"), inner, inner)
            | st.builds(lambda a: ["neg", a], inner)
            | st.builds(lambda a, n: ["^", a, ["num", str(n)]], inner, st.integers(2, 3))
            | st.builds(lambda a: ["call", "abs", a], inner)
        ),
        max_leaves=8,
    )


OPERATIONS: dict[str, Callable[[float, float], float]] = {
    "+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv, "^": operator.pow,
}  # fmt: skip


def _value(tree: Tree) -> float:
    match tree:
        case ["num" | "qty", text, *_]:
            return float(text)
        case ["neg", inner]:
            return -_value(inner)
        case ["call", "abs", inner]:
            return abs(_value(inner))
    left, right = _value(tree[1]), _value(tree[2])
    return float(OPERATIONS[tree[0]](left, right))


def _python(text: str) -> str:
    raised = re.sub(r"([²³])", lambda m: "**" + {"²": "2", "³": "3"}[m[1]], text)
    plain = raised.replace("−", "-").replace("·", "*")
    while "|" in plain:  # the innermost pair of bars
        plain = re.sub(r"\|([^|]*)\|", r"abs(\1)", plain, count=1)
    return plain


@given(_trees().filter(lambda tree: str(tree).count("abs") <= 1))
def test_linear_text_says_what_the_tree_says(tree: Tree) -> None:
    try:
        expected = _value(tree)
    except (ZeroDivisionError, OverflowError):
        return
    if not math.isfinite(expected):
        return
    assert math.isclose(eval(_python(Linear()(tree))), expected, rel_tol=1e-9, abs_tol=1e-9)


# Equations: rows, breaking, places
def _equations(language: str = "en") -> tuple[Equations, Typesetter]:
    typesetter = Typesetter()
    return Equations(Catalogue(language), typesetter.measure), typesetter


def _said(item: ItemRecord, language: str = "en") -> str:
    """The equation of an item as linear text."""
    equation = _equations(language)[0].of(item)
    return "" if equation is None else equation.text


def _item(**more: Any) -> ItemRecord:
    formula = {"type": "formula", "symbol": "c", "equation": ["+", A, B], "result": {"text": "5", "unit": "mm"}}
    return ItemRecord.model_validate(formula | more)


def _branch(**more: Any) -> ItemRecord:
    return ItemRecord.model_validate({"type": "choice"} | more)


def test_short_equation_stands_in_one_line() -> None:
    equation = _equations()[0].of(_item(substituted=["+", MM, MM]))
    assert equation is not None
    assert equation.latex == r"c = a + b = 40\,\mathrm{mm} + 40\,\mathrm{mm} = 5\,\mathrm{mm}"
    assert equation.text == "c = a + b = 40 mm + 40 mm = 5 mm"


def test_place_of_a_curve_is_said() -> None:
    assert _said(_item(at={"symbol": "φ", "text": "181.2", "unit": "deg"})) == "c = a + b = 5 mm at φ = 181.2°"


def test_formula_that_is_the_result_itself_is_not_repeated() -> None:
    assert _said(_item(equation=["sym", "c"], substituted=["qty", "5", "mm"])) == "c = 5 mm"


def test_wide_sum_is_broken_before_its_signs_and_nothing_is_lost() -> None:
    equations, typesetter = _equations()
    tree: Tree = ["qty", "1", "mm"]
    for index in range(20):
        tree = ["-" if index % 2 else "+", tree, ["*", ["qty", f"{index}.125", "N/mm"], ["qty", "2.5", "mm"]]]
    equation = equations.of(_item(equation=tree))
    assert equation is not None
    assert typesetter.measure(equation.latex) <= WIDTH + 3
    assert all(f"{index}.125" in equation.latex for index in range(20))
    rows = equation.latex.split(r"\\")
    assert len(rows) > 3
    assert all(re.match(r"\s*&\\quad \{\} [+-] ", row) for row in rows[1:-1])


def test_wide_product_is_broken_before_a_dot() -> None:
    equations, typesetter = _equations()
    tree: Tree = ["sym", "η_first"]
    for index in range(24):
        tree = ["*", tree, ["sym", f"η_part{index}"]]
    equation = equations.of(_item(equation=tree))
    assert equation is not None
    assert typesetter.measure(equation.latex) <= WIDTH + 3
    assert r"&\quad {} \cdot " in equation.latex


def test_a_number_does_not_stand_alone_before_a_wide_factor() -> None:
    equations, _ = _equations()
    wide: Tree = ["sym", "η_first"]
    for index in range(9):
        wide = ["+", wide, ["sym", f"η_part{index}"]]
    tree = ["*", TWO, ["call", "sin", wide]]
    equation = equations.of(_item(equation=None, substituted=tree))
    assert equation is not None
    assert [row.strip() for row in equation.latex.split(r"\\")[0].split("&=")][-1] != "2"


def test_found_value_shows_its_relation() -> None:
    item = _item(type="found", equation=None, relation=["cmp", "==", ["*", TWO, ["sym", "c"]], A])
    assert _said(item) == "2·c = a\nc = 5 mm"


@pytest.mark.parametrize(("operation", "text"), [
    ("max", "c = max V = 5 mm"), ("abs_max", "c = max |V| = 5 mm"), ("mean", "c = mean V = 5 mm"), ("rms", "c = rms V = 5 mm"),
    ("integral", "c = ∫ V = 5 mm"), ("sum", "c = ∑ V = 5 mm"), ("product", "c = ∏ V = 5 mm"), ("pick", "c = 5 mm"),
])  # fmt: skip
def test_reductions(operation: str, text: str) -> None:
    assert _said(_item(type="reduction", operation=operation, of="V")) == text


def test_an_integral_tells_over_what_it_is_taken() -> None:
    over = {"symbol": "φ", "text": "360", "unit": "deg"}
    item = _item(type="reduction", operation="integral", of="V", over=over)
    assert _said(item) == "c = ∫ V dφ from 0 to 360° = 5 mm" and _said(item, "uk") == "c = ∫ V dφ від 0 до 360° = 5 mm"
    equation = _equations()[0].of(item)
    assert equation and equation.latex.startswith(r"c = \int_{0}^{360°} V\,\mathrm{d}φ = ")


def test_condition_is_shown_in_symbols_and_with_numbers() -> None:
    item = _branch(condition=["cmp", ">", A, B], condition_substituted=["cmp", ">", MM, ["qty", "30", "mm"]])
    condition = _equations()[0].condition(item)
    assert condition is not None
    assert condition.text == "a > b: 40 mm > 30 mm"


def test_a_branch_is_shown_with_its_condition_once_and_named_after_that() -> None:
    said = SaidOnce(_equations()[0], Catalogue("en"))
    item = _branch(words="the knife cuts", condition=["cmp", ">", A, B])
    first = said.condition(item)
    assert first is not None and first.text == "a > b"
    assert said.condition(item) is None
    assert said.condition(item.with_(words="the board is long")) is not None


def test_a_branch_whose_condition_is_that_one_is_one_is_named_alone() -> None:
    said = SaidOnce(_equations()[0], Catalogue("en"))
    flag = _branch(
        condition=["cmp", "==", A, ["num", "1"]],
        condition_substituted=["cmp", "==", ["qty", "1", "1"], ["num", "1"]],
    )
    assert said.condition(flag.with_(words="the roller is in a slot")) is None
    assert said.condition(flag) is not None


def test_a_branch_that_was_told_is_named_beside_the_next_formula_that_takes_it() -> None:
    words = Catalogue("en")
    steps = PrintedSteps("A", _equations()[0], words, Tables("A", words), (), ToldBefore())
    taken = _item(type="choice", source="statics", words="the knife cuts", condition=["cmp", ">", A, B], equation=A)
    items = [taken.with_(id=name, description=name) for name in ("x", "y", "z")]
    section = SectionRecord(title="Cut", text="", items=items)
    first, second, third = steps.section(0, section, Heading("A.1", "Cut", "s-A.1")).items
    assert (first.words, first.source) == ("the knife cuts", "statics") and first.condition
    assert (second.words, second.source) == ("", "statics · the knife cuts") and not second.condition
    assert third.source == "statics"  # what follows at once takes it too


def test_a_number_times_one_of_a_unit_is_printed_as_a_quantity() -> None:
    condition = _equations()[0].condition(_branch(condition=["cmp", "<=", A, ["*", ["num", "40"], ["qty", "1", "mm"]]]))
    assert condition is not None and condition.text == "a ≤ 40 mm"


def test_unknown_expression_is_refused() -> None:
    with pytest.raises(ValueError, match="no expression"):
        Latex()(["@", A, B])


def _links(item: dict[str, Any]) -> str:
    built = Equations(Catalogue("en"), lambda _: 1.0).of(_item(**{"symbol": "x", **item}))
    return built.text if built else ""


def test_what_is_copied_or_nothing_is_said_once() -> None:
    taken = {"equation": ["sym", "y"], "substituted": ["qty", "1.3354", "K"], "result": {"text": "1.34", "unit": "K"}}
    assert _links(taken) == "x = y = 1.34 K"
    other_unit = {
        "equation": ["sym", "y"],
        "substituted": ["qty", "10.47", "rad/s"],
        "result": {"text": "100", "unit": "rpm"},
    }
    assert _links(other_unit) == "x = y = 10.47 rad/s = 100 r/min"
    nothing = {
        "equation": ["num", "0"],
        "substituted": None,
        "bridge": {"text": "0", "unit": "rad"},
        "result": {"text": "0", "unit": "deg"},
    }
    assert _links(nothing) == "x = 0°"


@pytest.mark.parametrize(
    ("name", "html"),
    [
        ("R", "<i class=sy>R</i>"),
        ("R_b", "<i class=sy>R</i><sub>b</sub>"),
        ("|e_cf|", "|<i class=sy>e</i><sub>cf</sub>|"),
        ("β_c′", "<i class=sy>β</i><sub>c</sub>′"),
        ("[f]", "[<i class=sy>f</i>]"),
        ("2α", "2<i class=sy>α</i>"),
        ("", ""),
        ("v(x)", "<i class=sy>v</i>(<i class=sy>x</i>)"),
        ("t/r", "<i class=sy>t</i>/<i class=sy>r</i>"),
        ("Σ s_L", "Σ\u2009<i class=sy>s</i><sub>L</sub>"),
        ("<b>", "&lt;b&gt;"),
        ("R_<b>", "<i class=sy>R</i><sub>&lt;b&gt;</sub>"),
    ],
)
def test_symbol(name: str, html: str) -> None:
    assert symbol(name) == html


@pytest.mark.parametrize(
    ("text", "html"),
    [
        ("R_b > R − h", "<i class=sy>R</i><sub>b</sub> &gt; <i class=sy>R</i> − <i class=sy>h</i>"),
        ("give n_points or crank_speed", "give n_points or crank_speed"),
        ("drive.crank_torque", "drive.crank_torque"),
        ("a force of 3 kN·m instead", "a force of 3 kN·m instead"),
        (
            "дорівнює −ω_3 і −ε_3, а ε = β",
            "дорівнює −<i class=sy>ω</i><sub>3</sub> і −<i class=sy>ε</i><sub>3</sub>, "
            "а <i class=sy>ε</i> = <i class=sy>β</i>",
        ),
        ("divided by η there", "divided by <i class=sy>η</i> there"),
        ("<script>alert</script>", "&lt;script&gt;alert&lt;/script&gt;"),
        ("k is the share", "<i class=sy>k</i> is the share"),
        ("the step S in S/T²", "the step <i class=sy>S</i> in <i class=sy>S</i>/<i class=sy>T</i>²"),
        ("pressed with P. The shoe", "pressed with <i class=sy>P</i>. The shoe"),
        ("2πR ≥ p·u", "2π<i class=sy>R</i> ≥ <i class=sy>p</i>·<i class=sy>u</i>"),
        ("радіус r і сила P", "радіус <i class=sy>r</i> і сила <i class=sy>P</i>"),
        ("the torque M′ gives", "the torque <i class=sy>M′</i> gives"),
    ],
)
def test_prose(text: str, html: str) -> None:
    assert prose(text) == html


def test_no_line_ends_between_a_letter_and_its_number() -> None:
    assert prose("angle, at φ = 180°") == "angle, at <i class=sy>φ</i>\u00a0=\u00a0180°"
    assert prose("a = b") == "<i class=sy>a</i> = <i class=sy>b</i>"


@pytest.mark.parametrize(
    "text",
    ["a bearing A or B, method C", "a V-belt and K factors", "5 m, 10⁻³ m², 3 N·m/rad", "in m/s, 1/h, r/min, J/(kg·K) or 0.3°/m",
     "Gent A. N. and Johnson P. L.", "write (f) there", "C45E+N and NU2208E", "x-axis", "I.5", "the sector's arm"],
)  # fmt: skip
def test_letters_that_are_no_symbols(text: str) -> None:
    assert prose(text) == text.replace("'", "&#39;")


def test_a_letter_of_a_user_s_own_words_is_no_symbol() -> None:
    assert own_words("layout b, sheet Z of the drawing") == "layout b, sheet Z of the drawing"
    assert own_words("from R_b = 20 mm") == "from <i class=sy>R</i><sub>b</sub>\u00a0=\u00a020 mm"


def test_only_declared_letters_are_symbols_and_none_of_a_name() -> None:
    with letters_declared({"k", "R"}, {"k", "shaft k", "drive"}):
        assert prose("pulleys Z to E") == "pulleys Z to E"
        assert prose("bearing k holds R, k = 3") == "bearing k holds <i class=sy>R</i>, <i class=sy>k</i>\u00a0=\u00a03"
    with letters_declared({"k"}, {"shaft k"}):
        assert prose("k of shaft k") == "<i class=sy>k</i> of shaft k"


def test_letters_of_a_report_are_those_of_its_quantities_with_or_without_index() -> None:
    results = sample()
    symbols, names = declared_letters(typed(results))
    declared = {row["symbol"] for data in results["mechanisms"].values() for row in data.get("outputs", {}).values()}
    assert {symbol[:1] for symbol in declared if symbol[1:2] in ("", "_") and symbol[:1].isalpha()} <= symbols
    assert set(results["mechanisms"]) <= names


def test_no_line_breaks_within_a_ratio_or_a_sum_in_brackets() -> None:
    text = re.sub("<[^>]*>", "", prose("The angle |dθ/dφ|, and/or r·cos(φ + τ) of crank/rocker."))
    assert "dθ/\u2060dφ" in text and "(φ\u00a0+\u00a0τ)" in text
    assert "and/or" in text and "crank/rocker" in text


# Where a line may break in what was typed, and which letters of a sentence are symbols.


@pytest.mark.parametrize(
    ("typed", "whole"),
    [
        ("${cylinder.cutting_arc_fraction}", ["${cylinder.", "cutting_arc_fraction}"]),
        ("2 * ${drive.energy} / 1.5", ["2", "*", "${drive.", "energy}", "/", "1.5"]),
        ("60 1/h", ["60", "1/h"]),
    ],
)
def test_a_path_breaks_behind_its_dots_and_nowhere_else(typed: str, whole: list[str]) -> None:
    assert re.findall(r"<span class=\"whole\">(.*?)</span>", pieces(typed)) == whole
    assert re.sub(r"<.*?>", "", pieces(typed)) == typed  # what is copied is what was typed


@pytest.mark.parametrize(
    ("sentence", "symbols"),
    [
        ("where z = 60 1/h = 0.01667 1/s", ["z"]),
        ("where L_10h = 752 356 h = 2.7e9 s", ["L"]),
        ("where n_crit = 40 568 r/min = 4248 rad/s", ["n"]),
        ("set n_points or crank_speed, at least 3 h", []),
    ],
)
def test_a_unit_is_not_a_symbol_and_a_long_subscript_is_one(sentence: str, symbols: list[str]) -> None:
    assert re.findall(r"<i class=sy>(.*?)</i>", prose(sentence)) == symbols


def test_the_number_of_a_source_stays_with_it() -> None:
    assert cited("ISO 6336-3:2006, 6") == "ISO\u00a06336-3:2006,\u00a06"
    assert cited("this method · the knife is in its cut") == "this\u00a0method · the knife is in its cut"
    assert cited("000, after eq. 19") == "000,\u00a0after\u00a0eq.\u00a019"  # short: whole


def test_in_a_narrow_column_a_path_breaks_behind_its_low_lines_too() -> None:
    found = re.findall(r"<span class=\"whole\">(.*?)</span>", pieces("${drive.crank_speed}", narrow=True))
    assert found == ["${drive.", "crank_", "speed}"]


# The list of symbols of a chapter.


Data = dict[str, Any]


def row(symbol: str, description: str, unit: str = "mm", **more: Any) -> Data:
    """A quantity of the results."""
    return {"symbol": symbol, "description": description, "display": {"text": "1", "unit": unit}} | more


def mechanism() -> Data:
    """Results in which ω and b stand in formulas, a of the source's letter is a result, and c is never printed."""
    formula = {"type": "formula", "symbol": "a_c", "equation": ["*", ["sym", "ω"], ["/", ["sym", "b"], ["num", "2"]]]}
    return {
        "inputs": {"width": row("b", "Width; without it the length"), "idle": row("c", "Clearance")},
        "curves": {"speed": {"symbol": "ω", "description": "Speed", "display_unit": "rpm"}},
        "outputs": {"acceleration": row("a_c", "Acceleration", "m/s**2", source_symbol="W")},
        "values": {"again": row("b", "Another width")},
        "sections": [{"items": [formula, {"type": "note", "text": "a note"}]}],
    }


def rows_of(data: Data) -> list[SymbolRow]:
    """The list of symbols of these results."""
    return symbol_rows(filled(MechanismRecord, data))


def test_a_symbol_of_a_formula_stands_once_with_meaning_and_unit_by_the_alphabet() -> None:
    rows = rows_of(mechanism())
    assert [(each.meaning, each.unit) for each in rows] == [
        ("Acceleration", "m/s²"), ("Width", "mm"), ("Speed", "r/min"),
    ]  # fmt: skip
    assert "ω" in rows[2].symbol


def test_the_list_tells_the_letter_of_the_source() -> None:
    first, *others = rows_of(mechanism())
    assert "W" in first.in_source and not any(each.in_source for each in others)


def test_the_arrow_before_a_choice_in_words_is_no_symbol() -> None:
    made = mechanism()
    made["values"]["chosen"] = row("→", "Drive that is taken", "1")
    made["sections"][0]["items"].append({"symbol": "→", "type": "choice"})
    assert all("→" not in each.symbol for each in rows_of(made))


def test_a_lone_symbol_stands_in_the_first_column() -> None:
    row = SymbolRow(Markup("φ"), "Cycle angle", "°", Markup(""))
    assert in_blocks([row]) == [[[row]]]


def test_a_long_list_is_cut_into_blocks_that_stay_whole_on_a_sheet() -> None:
    rows = [SymbolRow(Markup("a"), f"Number {nth}", "mm", Markup("")) for nth in range(100)]
    blocks = in_blocks(rows)
    assert [row for block in blocks for column in block for row in column] == rows
    assert len(blocks) == 3 and all(len(column) <= 14 for block in blocks for column in block)
    assert not in_blocks([])


def test_a_letter_means_what_its_step_prints_and_not_what_a_chart_draws_with_it() -> None:
    made = mechanism()
    made["curves"] = {
        "drawn": {"symbol": "a_c", "description": "Acceleration with another law", "display_unit": "1"}
    } | made["curves"]
    made["sections"][0]["items"][0]["id"] = "acceleration"
    assert rows_of(made)[0].meaning == "Acceleration"
