"""Symbols in running text."""

from __future__ import annotations

import re
from typing import Any

import pytest
from markupsafe import Markup

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
from diecut_report.results.mechanism_record import MechanismRecord
from tests.records import filled
from tests.report.made_results import sample, typed


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
