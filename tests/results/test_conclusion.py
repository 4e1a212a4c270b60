"""The first line on a machine: that all checks pass is said only where nothing is left open."""

from __future__ import annotations

from typing import Any

import pytest

from diecut_report.results.conclusion import conclusion, is_open
from diecut_report.results.model import ResultsRecord
from diecut_report.text.translation import said, speaking
from tests.records import filled


def results(**counts: Any) -> ResultsRecord:
    whole = {"pass": 0, "warn": 0, "fail": 0, "not_checked": 0, "assumed": []} | counts
    lost = whole.pop("lost", 0)
    doubtful = {"plugin_check": "failed"} if whole.pop("doubtful", False) else {}
    mechanisms = {f"m{i}": {"kind": "k", **({"error": "broken"} if i < lost else {}), **doubtful} for i in range(3)}
    return filled(ResultsRecord, {"summary": whole, "mechanisms": mechanisms})


@pytest.mark.parametrize(
    ("found", "line", "is_left"),
    [
        ({"pass": 3}, "All checks pass.", False),
        ({"pass": 3, "warn": 1}, "No check fails, but 1 warns.", True),
        ({"pass": 3, "not_checked": 2}, "No check fails, but 2 are not checked.", True),
        ({"pass": 3, "assumed": ["a.b"]}, "No check fails, but 1 value is assumed.", True),
        (
            {"pass": 3, "warn": 2, "not_checked": 1, "assumed": ["a.b", "a.c"]},
            "No check fails, but 2 warn, 1 is not checked and 2 values are assumed.",
            True,
        ),
        ({"pass": 3, "doubtful": True}, "No check fails, but formulas of a plugin have faults.", True),
        ({"pass": 2, "fail": 1, "not_checked": 1, "assumed": ["a"]}, "1 of 3 checks fails; 1 is not checked and 1 value is assumed.", True),
        ({"not_checked": 1}, "Nothing was checked, and 1 is not checked.", True),
        ({}, "There are no checks.", False),
        ({"pass": 3, "lost": 1}, "1 of 3 mechanisms were not calculated.", True),
    ],
)  # fmt: skip
def test_all_checks_pass_is_said_only_where_nothing_is_open(found: dict[str, Any], line: str, is_left: bool) -> None:
    given = results(**found)
    assert str(conclusion(given)) == line
    assert is_open(given) == is_left


def test_it_is_said_in_ukrainian() -> None:
    with speaking("uk"):
        line = said(conclusion(results(**{"pass": 3, "not_checked": 23, "assumed": ["a", "b"]})))
    assert line == "Невиконаних перевірок немає, але 23 не перевірено і 2 значення прийнято без підтвердження."
