"""The verdict on a machine and its first line: that all checks pass is said only where nothing is left open."""

from __future__ import annotations

from typing import Any

import pytest

from diecut_report.results.conclusion import judged, summary_of
from diecut_report.results.model import OpenRecord, ResultsRecord, SummaryRecord
from diecut_report.text.translation import said, speaking
from tests.records import filled

KINDS = ("warning", "not_checked", "not_rated", "assumed", "default")


def summary(**counts: Any) -> SummaryRecord:
    """A judged summary with so many checks of each status and so many open items of each kind; ``lost`` mechanisms of three."""
    lost, parts = counts.pop("lost", 0), counts.pop("parts", None)
    items = [{"what": kind, "path": f"m.{number}"} for kind in KINDS for number in range(counts.pop(kind, 0))]
    whole = (
        {"pass": 0, "warn": 0, "fail": 0, "not_checked": 0, "open": items}
        | counts
        | ({"parts": parts} if parts else {})
    )
    return judged(filled(SummaryRecord, whole), 3, lost)


@pytest.mark.parametrize(
    ("found", "verdict", "line"),
    [
        ({"pass": 3}, "pass", "All checks pass."),
        ({"pass": 2, "warn": 1, "warning": 1}, "conditional", "No check fails, but 1 check warns."),
        ({"pass": 3, "not_checked": 2}, "conditional", "No check fails, but 2 checks are not made."),
        ({"pass": 3, "assumed": 1}, "conditional", "No check fails, but 1 assumed value is open."),
        ({"pass": 3, "default": 2}, "conditional", "No check fails, but 2 default values are open."),
        ({"pass": 3, "not_rated": 1}, "conditional", "No check fails, but parts of 1 mechanism are not modelled."),
        (
            {"pass": 3, "warning": 2, "not_checked": 1, "assumed": 2},
            "conditional",
            "No check fails, but 2 checks warn, 1 check is not made and 2 assumed values are open.",
        ),
        ({"pass": 2, "fail": 1, "not_checked": 1}, "fail", "1 of 3 checks fails; 1 check is not made."),
        ({"pass": 2, "fail": 1}, "fail", "1 of 3 checks fails."),
        ({"not_checked": 1}, "conditional", "Nothing was checked, and 1 check is not made."),
        ({}, "conditional", "There are no checks."),
        ({"pass": 3, "lost": 1}, "fail", "1 of 3 mechanisms were not calculated."),
        (
            {"pass": 3, "parts": {"carrying": 9, "rated": 7, "accepted": 2, "not_rated": 0}},
            "pass",
            "All checks pass; 2 parts are accepted without a rating.",
        ),
        (
            {"pass": 3, "not_rated": 4, "parts": {"carrying": 9, "rated": 8, "accepted": 0, "not_rated": 1}},
            "conditional",
            "No check fails, but 1 part is not rated and 3 bodies and joints have no method.",
        ),
    ],
)
def test_the_verdict_is_pass_only_where_nothing_is_open(found: dict[str, Any], verdict: str, line: str) -> None:
    given = summary(**found)
    assert (given.verdict, str(given.conclusion)) == (verdict, line)
    assert ("All checks pass" in line) <= (verdict == "pass")


def test_it_is_said_in_ukrainian() -> None:
    with speaking("uk"):
        line = said(summary(**{"pass": 3, "not_checked": 23, "assumed": 2}).conclusion)
    assert line == "Невиконаних перевірок немає, але 23 перевірки не проведено і 2 прийняті значення не підтверджено."


def test_a_file_before_the_three_verdicts_is_judged_by_its_checks_and_assumed_inputs() -> None:
    checks = [
        {"id": "a", "status": "warn", "message": "too hot"},
        {"id": "b", "status": "not_checked", "message": "no limit"},
    ]
    doubtful = {"kind": "k", "plugin_check": "failed"}
    given = {"summary": {"pass": 3, "warn": 1, "not_checked": 1, "assumed": ["press.sheet.width"]},
             "mechanisms": {"m": {"checks": checks}, "n": doubtful}, "project": {"prepared_by": "Designer"}}  # fmt: skip
    found = summary_of(filled(ResultsRecord, given))
    assert found.verdict == "conditional"
    assert [(each.what, each.path, each.owner) for each in found.open] == [
        ("warning", "mechanisms.n", "Designer"),
        ("warning", "mechanisms.m.checks.a", "Designer"),
        ("not_checked", "mechanisms.m.checks.b", "Designer"),
        ("assumed", "press.sheet.width", "Designer"),
    ]


def test_a_judged_file_is_not_judged_again() -> None:
    item = OpenRecord(what="default", path="mechanisms.m.x", owner="", why="why")
    results = filled(ResultsRecord, {"summary": {"verdict": "conditional", "open": [item], "assumed": ["a.b"]}})
    assert summary_of(results) == results.summary
