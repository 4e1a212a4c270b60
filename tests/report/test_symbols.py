"""Symbols in running text."""

from __future__ import annotations

import re

import pytest

from diecut_report.report.symbols import declared_letters, letters_declared, own_words, prose, symbol
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
    letters = declared_letters(typed(results))
    declared = {row["symbol"] for data in results["mechanisms"].values() for row in data.get("outputs", {}).values()}
    assert {symbol[:1] for symbol in declared if symbol[1:2] in ("", "_") and symbol[:1].isalpha()} <= letters.symbols
    assert set(results["mechanisms"]) <= letters.names


def test_no_line_breaks_within_a_ratio_or_a_sum_in_brackets() -> None:
    text = re.sub("<[^>]*>", "", prose("The angle |dθ/dφ|, and/or r·cos(φ + τ) of crank/rocker."))
    assert "dθ/\u2060dφ" in text and "(φ\u00a0+\u00a0τ)" in text
    assert "and/or" in text and "crank/rocker" in text
