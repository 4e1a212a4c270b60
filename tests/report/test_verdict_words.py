"""What stands on the page of the verdict: sentences, and what is assumed by the check that it moves."""

from __future__ import annotations

from diecut_report.report.chapters.front import assumed_groups, followed_line
from diecut_report.report.text import Catalogue, sentence
from diecut_report.results.model import ResultsRecord
from tests.records import filled


def test_the_counts_begin_a_sentence() -> None:
    assert sentence("не виконано 6 перевірок з 135") == "Не виконано 6 перевірок з 135"
    assert sentence("6 of 135 checks fail") == "6 of 135 checks fail"


def test_an_assumed_value_that_was_typed_as_a_text_is_not_broken_before_its_unit() -> None:
    path = "mechanisms.timing.interlocks.0.margin"
    row = {"basis": "assumed", "display": {"text": "5 ms", "unit": "1"}, "unit": "1"}
    mechanisms = {"timing": {"inputs": {"interlocks.0.margin": row}, "checks": []}}
    results = {"mechanisms": mechanisms, "press": {"fields": []}, "summary": {"assumed": [path], "moves": []}}
    (group,) = assumed_groups(filled(ResultsRecord, results), Catalogue("uk"))
    assert group.values == [("interlocks.0.margin", "5\u00a0ms", "")]


def test_advice_has_the_numbers_of_the_language() -> None:
    changes = [{"path": "cylinder.radius", "value": "105.2 mm"}, {"path": "clutch.single_position", "value": "true"}]
    results = {"summary": {"advice": {"changes": changes, "failing": [], "error": None}}}
    (line,) = followed_line(filled(ResultsRecord, results), Catalogue("uk"))
    assert "cylinder.radius 105,2 mm, clutch.single_position true" in line
