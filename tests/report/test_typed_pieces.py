"""Where a line may break in what was typed, and which letters of a sentence are symbols."""

from __future__ import annotations

import re

import pytest

from diecut_report.report.symbols import cited, pieces, prose


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
