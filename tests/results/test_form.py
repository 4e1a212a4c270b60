"""The form of the results file: what the program writes meets it, nothing else does, and the page describes it."""

from __future__ import annotations

import json
import runpy
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from pydantic import ValidationError

import diecut_report as dr
from diecut_report.cli.main import main
from diecut_report.results.model import ResultsRecord, results_schema
from diecut_report.results.record import FORM_VERSION
from tests.configs import BROKEN, EXAMPLES, GOOD, HEAD, saved
from tests.processes import Example

ROOT = Path(__file__).parents[2]
FORMS = {
    "2.0": "5efe974d65814732910e4f17a207d51d5f7300a7747e85bf3c05d5125cf61c45",
}
"""The hashes of the forms so far, without their words. Where yours is another: raise FORM_VERSION as its comment tells, and add it here."""
ODD = (
    HEAD
    + """\
  a: {kind: lever, force: {value: 2 kN, basis: assumed, note: a guess}, allowable_moment: 190 N*m, parts: [{length: 3 mm}, {length: 4 mm, label: b}]}
  b: {kind: lever, force: "${a.moment} / (1 m)", grade: coarse, teeth: 12}
  c: {kind: breaks_in_calculation}
  d: {kind: lever, force: "${c.result} * (1 kN/m)"}
"""
)


@cache
def validator() -> jsonschema.Draft202012Validator:
    return jsonschema.Draft202012Validator(results_schema())


def faults(data: Any) -> list[str]:
    return [
        f"{'.'.join(map(str, error.absolute_path))}: {error.message:.200}" for error in validator().iter_errors(data)
    ]


def without_words(part: Any) -> Any:
    if isinstance(part, dict):
        return {
            key: without_words(value)
            for key, value in part.items()
            if key not in ("description", "$id") or isinstance(value, dict)
        }
    return [without_words(each) for each in part] if isinstance(part, list) else part


def odd(folder: Path, *more: str) -> dict[str, Any]:
    """What a report tells of a press with all that is seldom."""
    return reported(saved(folder, ODD), "--plugins", str(BROKEN), *more)


def reported(file: Path, *more: str) -> dict[str, Any]:
    """The results file of a report, beside its configuration."""
    main(["report", str(file), "-o", str(file.parent), "--format", "json", "--plugins", str(GOOD), "--quiet", *more])
    found: dict[str, Any] = json.loads((file.parent / "press.json").read_text("utf-8"))
    return found


def test_the_schema_is_one_and_the_command_gives_it(capfd: pytest.CaptureFixture[str]) -> None:
    jsonschema.Draft202012Validator.check_schema(results_schema())
    assert main(["schema", "results"]) == 0
    assert json.loads(capfd.readouterr().out) == results_schema()
    assert results_schema()["$id"] == f"urn:diecut-report:results:{FORM_VERSION}"


def test_a_form_keeps_its_version() -> None:
    form = json.dumps(without_words(results_schema()), sort_keys=True)
    assert sha256(form.encode()).hexdigest() == FORMS[FORM_VERSION]


def test_what_each_form_added_is_told() -> None:
    tool = runpy.run_path(str(ROOT / "tools" / "make_results_page.py"))
    assert list(tool["ADDED"]) == list(FORMS) and list(FORMS)[-1] == FORM_VERSION


def test_the_page_is_made_from_the_form() -> None:
    tool = runpy.run_path(str(ROOT / "tools" / "make_results_page.py"))
    for file, text in tool["pages"]().items():
        assert file.read_text("utf-8") == text, "run: python tools/make_results_page.py"


def test_the_published_press_meets_the_form(example: Example) -> None:
    ResultsRecord.model_validate_json(example.told)


def test_a_small_press_meets_the_schema(small_report: Path) -> None:
    assert faults(json.loads((small_report / "small.json").read_text("utf-8"))) == []


def test_what_is_seldom_meets_the_schema(tmp_path: Path) -> None:
    found = odd(tmp_path, "--only", "a,b", "--detail", "brief")
    statuses = {name: data["status"] for name, data in found["mechanisms"].items()}
    assert statuses == {"a": "fail", "b": "pass", "c": "error", "d": "skipped"} and found["report"]["only"] == [
        "a",
        "b",
    ]
    assert found["mechanisms"]["c"]["plugin_file"] == "breaks_in_calculation.py"
    assert faults(found) == []


def test_what_a_report_alone_tells_meets_the_schema(tmp_path: Path) -> None:
    text = ODD.split("  c: ")[0]
    results = dr.load(saved(tmp_path, text), plugins=[GOOD]).calculate()
    found = reported(tmp_path / "press.yaml", "--previous", str(results.save(tmp_path / "old.json")))
    assert found["summary"]["open"] and "changes" in found
    assert faults(found) == []


def test_the_influence_of_inputs_meets_the_schema(tmp_path: Path) -> None:
    text = ODD.split("  b: ")[0] + "report: {influence: {of: [a.moment]}}\n"
    found = reported(saved(tmp_path, text))
    assert found["influence"]["tornados"] and found["report"]["influence"]["of"] == ["a.moment"]
    assert faults(found) == []


@pytest.mark.nightly
@pytest.mark.parametrize("path", EXAMPLES, ids=[path.name for path in EXAMPLES])
def test_all_examples_meet_the_schema(path: Path) -> None:
    assert faults(json.loads(dr.load(path).calculate().to_json())) == []


@pytest.mark.parametrize(
    "place",
    ["", "program", "config", "summary", "mechanisms.clutch", "mechanisms.clutch.checks.0", "mechanisms.clutch.inputs.torque",
     "mechanisms.clutch.inputs.torque.display", "mechanisms.clutch.sections.0.items.0", "mechanisms.clutch.figures.0"],
)  # fmt: skip
def test_a_key_that_is_not_known_is_refused(small_report: Path, place: str) -> None:
    data = json.loads((small_report / "small.json").read_text("utf-8"))
    block = data
    for key in filter(None, place.split(".")):
        block = block[int(key) if key.isdigit() else key]
    block["strange"] = 1
    assert faults(data)
    with pytest.raises(ValidationError, match="strange"):
        ResultsRecord.model_validate_json(json.dumps(data))


@pytest.mark.parametrize("key", ["status", "mechanisms", "schema_version"])
def test_a_key_that_is_missing_is_refused(small_report: Path, key: str) -> None:
    data = json.loads((small_report / "small.json").read_text("utf-8"))
    del data[key]
    assert faults(data) == [f": '{key}' is a required property"]
