"""Numbers and units as they are printed."""

from __future__ import annotations

import pytest

from diecut_report.report.text import displayed, number, quantity, rooms, significant, tidy

THIN = "\u202f"
NARROW = "\u2009"
FIXED = "\u00a0"


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("2", "2"),
        ("-0.5", "−0.5"),
        ("105.0", "105.0"),  # a rounded result keeps its digits
        ("9999", "9999"),
        ("21000", f"21{THIN}000"),
        ("-1234567.25", f"−1{THIN}234{THIN}567.25"),
        ("1.2e-05", f"1.2{NARROW}×{NARROW}10⁻⁵"),
        ("-3e+12", f"−3{NARROW}×{NARROW}10¹²"),
        ("5e0", "5"),
        ("steel", "steel"),
        ("", ""),
        ("1.2.3", "1.2.3"),
    ],
)
def test_number(text: str, printed: str) -> None:
    assert number(text) == printed


def test_decimal_sign_of_the_language() -> None:
    assert number("12345.5", decimal=",") == f"12{THIN}345,5"


@pytest.mark.parametrize(
    ("text", "unit", "printed"),
    [
        ("40", "mm", f"40{FIXED}mm"),
        ("0.6362", "kg*m**2", f"0.6362{FIXED}kg·m²"),
        ("21", "N*m", f"21{FIXED}N·m"),
        ("59.4576", "deg", "59.4576°"),
        ("6.05", "1", "6.05"),
        ("6000", "1/h", f"6000{FIXED}1/h"),
        ("1e-06", "deg", f"1{NARROW}×{NARROW}10⁻⁶{THIN}°"),  # no power of a degree
    ],
)
def test_quantity(text: str, unit: str, printed: str) -> None:
    assert quantity(text, unit) == printed


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"),
        (1.0, "1.000"),
        (-0.0012345, "-0.001234"),
        (99995.0, "99995"),
        (0.99996, "1.000"),
        (1234567.0, "1.235e+06"),
    ],
)
def test_significant_digits(value: float, text: str) -> None:
    assert significant(value, 4) == text


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [(0.105, "mm", "105"), (0.34906585039886595, "deg", "20"), (2.591e-5, "mm", "0,026"), (0.8550499, "m/s", "0,855")],
)
def test_a_value_is_shown_with_the_digits_that_mean_something(value: float, unit: str, text: str) -> None:
    assert displayed(value, unit, ",") == text


@pytest.mark.parametrize(
    ("sentence", "printed"),
    [
        ("the wall is -5 mm", "the wall is −5 mm"),
        ("at 49.91 °.", "at 49.91°."),
        ("DCP-700", "DCP-700"),
        ("2-3 times", "2-3 times"),
        ("off by 5.1e-14", f"off by 5.1{NARROW}×{NARROW}10⁻¹⁴"),
        ("key 3e4f", "key 3e4f"),
    ],
)
def test_sentences(sentence: str, printed: str) -> None:
    assert tidy(sentence) == printed


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("allowed 10000 m/s², steel of EN 10083", f"allowed 10{THIN}000 m/s², steel of EN 10083"),
        ("critical speed 971837,5 r/min in 12345 steps", f"critical speed 971{THIN}837,5 r/min in 12345 steps"),
        ("accepted 1e-06 °", f"accepted 1{NARROW}×{NARROW}10⁻⁶{THIN}°"),
    ],
)
def test_a_sentence_has_its_numbers_as_a_table_has_them(text: str, printed: str) -> None:
    assert tidy(text) == printed


# Columns aligned on the decimal sign.


@pytest.mark.parametrize(
    ("column", "classes"),
    [
        (["1.25", "10", "−0.5", "12\u202f000"], ["", "w2", "f1", "w2"]),
        (["1,25", "10,5"], ["", "f1"]),
        (["1", "20"], ["", ""]),
        (["–", "1.5", "as given", "1.2 × 10⁻⁵", "3"], ["", "", "", "", "w1"]),
        (["0.1234567890", "1"], ["", "w8"]),
        ([], []),
    ],
)  # fmt: skip
def test_a_number_leaves_room_for_the_decimals_of_its_column(column: list[str], classes: list[str]) -> None:
    assert rooms(column) == classes
