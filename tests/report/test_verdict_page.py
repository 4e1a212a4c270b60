"""Page 1: sorted by utilisation, what governs, what is not checked, and what holds no reserve."""

from __future__ import annotations

from typing import Any

import pytest

from diecut_report.report.chapters.front import followed_line, machine_facts, not_covered, open_groups
from diecut_report.report.document import document
from diecut_report.report.equations import Equations
from diecut_report.report.text import Catalogue, sentence
from diecut_report.results.conclusion import governing, summary
from diecut_report.results.mechanism_record import CheckRecord
from diecut_report.results.model import PartCountRecord, ResultsRecord
from tests.records import filled
from tests.report.made_results import check, mechanism, sample, typed

SHOWN = {"text": "16", "unit": "N"}


def judged(name: str, ratio: float | None, status: str = "pass", **more: Any) -> dict[str, Any]:
    return check(name) | {"status": status, "utilisation": ratio} | more


def unchecked(name: str, key: str) -> dict[str, Any]:
    return judged(
        name,
        None,
        "not_checked",
        limit=None,
        limit_display=None,
        margin_display=None,
        demand_display=SHOWN,
        missing=[key],
    )


def page(*checks: dict[str, Any]) -> Any:
    results = sample()
    ranks = [one["status"] for one in checks if one["status"] != "not_checked"]
    worst = next((status for status in ("fail", "warn") if status in ranks), "pass")
    judged_checks = [CheckRecord.model_validate(each) for each in checks]
    by_name = {"train": judged_checks}
    results["mechanisms"] = {"train": mechanism("Train", checks=judged_checks, status=worst)}
    results |= {
        "comparisons": {},
        "status": worst,
        "governing": governing(by_name),
        "summary": summary(by_name, []),
    }
    words = Catalogue("en")
    return document(typed(results), Equations(words, lambda _: 0.0), words)


def test_the_summary_is_sorted_by_utilisation_what_fails_first_and_what_was_sized_last() -> None:
    found = page(judged("low", 0.2), judged("high", 0.9), judged("sized", 0.99, sized_to_limit=True), judged("over", 1.5, "fail"),
                 judged("missed", None, "fail"), judged("odd", 1.01, "warn"), judged("own", 0.5, **{"class": "numerical"}))  # fmt: skip
    assert [row.id for row in found.checks] == ["missed", "over", "odd", "high", "low", "sized"]
    assert [row.id for row in found.sized] == ["sized"] and found.governing.id == "missed"
    assert found.counts == ["3 pass"] and found.verdict == "2 of 6 checks fail; 1 check warns."
    assert found.notes == ["1 self-test of the calculation holds."]


def test_checks_that_fail_in_spite_of_the_advice_are_called_as_in_the_lines_above() -> None:
    found = page(judged("wall", 1.5, "fail"))
    advice = {"changes": [{"path": "train.x", "value": "5 mm"}], "failing": ["train.wall", "gone.check"], "error": None}
    (line,) = followed_line(filled(ResultsRecord, {"summary": {"advice": advice}}), Catalogue("en"), found.checks)
    assert line.endswith(f"leaves other checks failing: A · {found.checks[0].title}, gone.check.")


def test_what_the_calculation_presumes_is_sorted_behind_what_has_a_reserve() -> None:
    found = page(judged("range", 0.99, presumed=True), judged("low", 0.2), judged("left", 1.2, "warn", presumed=True))
    assert [row.id for row in found.checks] == ["left", "low", "range"] and found.governing.id == "left"


def test_a_failure_without_a_utilisation_tells_by_how_much_in_words() -> None:
    found = page(judged("missed", None, "fail", margin_display={"text": "-10", "unit": "mm"}))
    assert (found.governing.utilisation, found.governing.used) == ("–", "10\N{NO-BREAK SPACE}mm beyond the limit")


@pytest.mark.parametrize(
    ("checks", "verdict", "face"),
    [
        ([judged("a", 0.5)], "All checks pass.", "pass"),
        ([judged("a", 0.5), unchecked("b", "rated")], "No check fails, but 1 check is not made.", "conditional"),
        ([unchecked("b", "rated")], "Nothing was checked, and 1 check is not made.", "conditional"),
        ([judged("a", 1.1, "warn"), unchecked("b", "rated")], "No check fails, but 1 check warns and 1 check is not made.", "conditional"),
        ([judged("a", 1.1, "fail"), unchecked("b", "rated")], "1 of 1 checks fails; 1 check is not made.", "fail"),
        ([], "There are no checks.", "conditional"),
    ],
)  # fmt: skip
def test_all_checks_pass_is_said_where_all_are_made_alone(
    checks: list[dict[str, Any]], verdict: str, face: str
) -> None:
    found = page(*checks)
    assert (found.verdict, found.face) == (verdict, face)


def test_what_is_not_checked_stands_apart_with_what_it_needs() -> None:
    found = page(judged("a", 0.5), unchecked("b", "rated"))
    assert [(row.id, row.missing, row.demand, row.limit) for row in found.unchecked] == [
        ("b", ("rated",), "16\N{NO-BREAK SPACE}N", "–")
    ]
    assert found.counts == ["1 passes"] and found.chapters[0].count("not_checked") == 1


# What stands on the page of the verdict: sentences, and what is assumed by the check that it moves.


def test_the_counts_begin_a_sentence() -> None:
    assert sentence("не виконано 6 перевірок з 135") == "Не виконано 6 перевірок з 135"
    assert sentence("6 of 135 checks fail") == "6 of 135 checks fail"


def test_open_values_stand_by_their_mechanism_those_with_the_same_reason_together() -> None:
    shown = {"interlocks.0.margin": "5 ms", "a": "3", "b": "4", "c": "7"}
    inputs: dict[str, Any] = {key: {"display": {"text": text, "unit": "1"}, "unit": "1"} for key, text in shown.items()}
    inputs["c"]["basis"] = "catalogue"
    items = [("interlocks.0.margin", "at 6 ms"), ("a", "together"), ("b", "together"), ("c", "together")]
    left = [{"what": "assumed", "path": f"mechanisms.timing.{key}", "why": why} for key, why in items]
    results = {
        "mechanisms": {"timing": {"inputs": inputs}},
        "press": {"fields": []},
        "summary": {"verdict": "conditional", "open": left},
    }
    (group,) = open_groups(filled(ResultsRecord, results), Catalogue("en"))
    assert group.reasons == [
        ([("interlocks.0.margin", "5\u00a0ms")], "assumed: at 6 ms"),
        ([("a", "3"), ("b", "4")], "assumed: together"),
        ([("c", "7")], "assumed, as no note names its standard or catalogue: together"),
    ]


def test_page_1_says_what_the_machine_is_as_far_as_the_results_hold_it() -> None:
    def row(text: str, unit: str, description: str) -> dict[str, Any]:
        return {"value": 1.0, "unit": "1", "description": description, "display": {"text": text, "unit": unit}}

    fields = [
        row("700", "mm", "Length") | {"path": "press.sheet.length"},
        row("470", "mm", "Width") | {"path": "press.sheet.width"},
    ]
    train = {"kind": "drive_train", "outputs": {"motor_power": row("1.1", "kW", "Rated power")}}
    asked = {"kind": "press_consistency", "inputs": {"required_rate": row("4500", "1/h", "Rate; default: another one")}}
    found = machine_facts(
        filled(ResultsRecord, {"press": {"fields": fields}, "mechanisms": {"train": train, "all": asked}}),
        Catalogue("en"),
    )
    assert found == [
        ("Required rate", "4500\u00a01/h"),
        ("Format", "700\u00a0mm × 470\u00a0mm"),
        ("Rated power (train)", "1.1\u00a0kW"),
    ]
    assert machine_facts(filled(ResultsRecord, {"press": {"fields": []}, "mechanisms": {}}), Catalogue("en")) == []


@pytest.mark.parametrize("owner", ["Designer", ""])
def test_page_1_names_what_is_not_covered_with_its_owner(owner: str) -> None:
    item = {"what": "not_rated", "path": "mechanisms.cross", "owner": owner, "why": "no part takes torque"}
    given = {"project": {"prepared_by": owner}, "summary": {"verdict": "conditional", "open": [item]}}
    found = not_covered(filled(ResultsRecord, given), Catalogue("en"))
    assert [each.text for each in found][:2] == [
        "Parts of the drive line are not modelled.",
        "cross: no part takes torque.",
    ]
    assert len(found) == 4 and {each.owner for each in found} == {owner}
    (alone,) = not_covered(filled(ResultsRecord, {"project": {"prepared_by": owner}}), Catalogue("en"))
    assert alone.text.endswith("beyond the methods.")


def test_each_mechanism_has_its_worst_strength_and_function_check() -> None:
    strength, practice = {"class": "strength"}, {"class": "practice"}
    found = page(judged("low", 0.2, **strength), judged("high", 0.9, **strength), judged("rule", 0.99, **practice))
    (row,) = found.judged_parts
    assert row.worst_strength.id == "high" and row.worst_function is None
    (hurt,) = page(judged("guard", 0.4, **{"class": "safety"})).checks
    assert (hurt.check_class, hurt.id) == ("safety", "guard")


def test_advice_has_the_numbers_of_the_language() -> None:
    changes = [{"path": "cylinder.radius", "value": "105.2 mm"}, {"path": "clutch.single_position", "value": "true"}]
    results = {"summary": {"advice": {"changes": changes, "failing": [], "error": None}}}
    (line,) = followed_line(filled(ResultsRecord, results), Catalogue("uk"))
    assert "cylinder.radius 105,2 mm, clutch.single_position true" in line


def test_calculations_of_one_part_are_one_row_with_the_worst_of_them() -> None:
    results = sample()
    results["mechanisms"] = {
        "train": mechanism("Train", checks=[judged("own", 0.2)]),
        "crank": mechanism("Shaft", part="shafts.crank", checks=[judged("low", 0.3, **{"class": "strength"})]),
        "key": mechanism("Key", part="shafts.crank", status="fail", checks=[judged("high", 1.2, "fail", **{"class": "strength"})]),
    }  # fmt: skip
    words = Catalogue("en")
    found = document(typed(results | {"comparisons": {}}), Equations(words, lambda _: 0.0), words)
    _, part = found.judged_parts
    assert (part.title, part.counts, part.face) == ("B–C shafts.crank", [1, 0, 1, 0], "fail")
    assert part.worst_strength is not None and part.worst_function is None
    assert (part.worst_strength.id, part.worst_strength.home) == ("high", "C key")
    assert found.judged_parts[0].title.startswith("A ")


def test_page_1_counts_the_parts_that_are_rated() -> None:
    results, words = typed(sample()), Catalogue("en")
    parts = PartCountRecord(carrying=54, rated=49, accepted=0, not_rated=5)
    counted = results.with_(summary=results.summary.with_(parts=parts))
    told = "49 of 54 parts with a method of calculation are rated"
    assert told in document(counted, Equations(words, lambda _: 0.0), words).counts
    assert told not in document(results, Equations(words, lambda _: 0.0), words).counts
