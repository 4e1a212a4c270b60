"""Symbols in running text."""

from __future__ import annotations

import pytest

from diecut_report.report.symbols import prose, symbol


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
    ],
)
def test_prose(text: str, html: str) -> None:
    assert prose(text) == html


def test_no_line_ends_between_a_letter_and_its_number() -> None:
    assert prose("angle, at φ = 180°") == "angle, at <i class=sy>φ</i>\u00a0=\u00a0180°"
    assert prose("a = b") == "<i class=sy>a</i> = <i class=sy>b</i>"


def test_a_long_text_before_a_symbol_ends_where_a_line_may() -> None:
    long = "Here the radius of the profile that is ground is, as the paper says,"
    assert prose(f"{long} ρ") == f"<span>{long}</span> <i class=sy>ρ</i>"
    assert prose("The radius is ρ") == "The radius is <i class=sy>ρ</i>"
