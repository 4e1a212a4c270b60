"""Results of another form of the results file: older ones are read, and what cannot be is refused with both versions."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import diecut_report as dr
from diecut_report.results.record import FORM_VERSION
from diecut_report.time_limit import limited
from tests.cli.test_cli import Capture, run

COMMANDS = {
    "render": ("render", "{file}", "-o", "{folder}", "--format", "html"),
    "extract": ("extract", "{file}", "-o", "{folder}"),
    "verify": ("verify", "{file}"),
    "diff": ("diff", "{file}", "{file}"),
}


def asked(command: str, data: dict[str, Any], folder: Path) -> int:
    file = folder / "old.json"
    file.write_text(json.dumps(data), "utf-8")
    return run(*(part.format(file=file, folder=folder / "out") for part in COMMANDS[command]))


@pytest.fixture
def results(small_report: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads((small_report / "small.json").read_text("utf-8"))
    assert found["form_version"] == FORM_VERSION
    return found


def first_form(data: Any) -> Any:
    """Results without all that was added since the first form."""
    if isinstance(data, list):
        return [first_form(each) for each in data]
    if not isinstance(data, dict):
        return data
    is_place = data.keys() == {"symbol", "text", "unit", "value"}
    added = {"form_version", "plugin_check", "over"} | ({"value"} if is_place else set())
    return {key: first_form(value) for key, value in data.items() if key not in added}


@pytest.mark.parametrize("command", COMMANDS)
def test_results_of_the_first_form_are_read(command: str, results: dict[str, Any], tmp_path: Path) -> None:
    assert asked(command, first_form(results), tmp_path) in (0, 1)


def nested(depth: int) -> dict[str, Any]:
    """A wording of so many within each other, each twice as long as the one in it."""
    inner = {"values": {"a": nested(depth - 1)}} if depth else {"values": {"a": "ha"}}
    return {"text": "{a}{a}", **inner}


@pytest.mark.parametrize(
    "wording", [{"text": "x", "values": [1]}, {"text": "x", "values": "y"}, nested(60)], ids=["list", "text", "long"]
)
@pytest.mark.parametrize("command", COMMANDS)
def test_wordings_that_cannot_be_or_take_all_memory_are_none(
    command: str, wording: dict[str, Any], results: dict[str, Any], tmp_path: Path
) -> None:
    with limited(20):
        assert asked(command, first_form(results) | {"form_version": "1.6", "wordings": {"x": wording}}, tmp_path) in (
            0,
            1,
        )


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize(("version", "advice"), [(2, "Install a newer diecut-report"), (0, "Calculate them anew")])
def test_another_first_number_is_refused_with_both_versions(
    command: str, version: int, advice: str, results: dict[str, Any], tmp_path: Path, capfd: Capture
) -> None:
    given = results | {"schema_version": version, "form_version": f"{version}.7"}
    assert asked(command, given, tmp_path) == 2
    told = capfd.readouterr().err
    assert f"These results are of form {version}.7 (diecut-report {results['program']['version']})" in told
    assert f"this program reads form {FORM_VERSION}" in told and advice in told


def without_summary(data: dict[str, Any]) -> None:
    del data["summary"]


def without_titles(data: dict[str, Any]) -> None:
    for mechanism in data["mechanisms"].values():
        for section in mechanism["sections"]:
            del section["title"]


@pytest.mark.parametrize("change", [without_summary, without_titles])
def test_what_is_missing_in_another_form_is_told_with_both_versions(
    change: Callable[[dict[str, Any]], None], results: dict[str, Any], tmp_path: Path, capfd: Capture
) -> None:
    change(results)
    assert asked("render", results | {"form_version": "1.0"}, tmp_path) == 2
    told = capfd.readouterr().err
    assert (
        "is missing" in told
        and f"are of form 1.0 (diecut-report {dr.__version__}), this program has form {FORM_VERSION}" in told
    )
    assert asked("render", first_form(results), tmp_path) == 2
    assert "of a form before 1.3" in capfd.readouterr().err
    assert not list(tmp_path.glob("out/*"))


def test_a_strange_version_is_not_repeated(results: dict[str, Any], tmp_path: Path, capfd: Capture) -> None:
    given = results | {"schema_version": 10**90, "form_version": "\x1b[2J" * 50, "program": {"version": "\x1b[2J"}}
    assert asked("verify", given, tmp_path) == 2
    told = capfd.readouterr().err
    assert f"form {'1' + 19 * '0'}; this program" in told and "\x1b" not in told


def beyond_floats(data: dict[str, Any]) -> None:
    [*next(iter(data["mechanisms"].values()))["outputs"].values()][-1]["value"] = 10**400


def beyond_floats_in_mm(data: dict[str, Any]) -> None:
    [*next(iter(data["mechanisms"].values()))["outputs"].values()][-1]["value"] = 1e308


def without_mechanisms(data: dict[str, Any]) -> None:
    data["mechanisms"] = {}


def without_checks(data: dict[str, Any]) -> None:
    data["mechanisms"][data["governing"]["mechanism"]]["checks"] = []


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize(
    ("change", "words"),
    [
        (beyond_floats, "beyond the range of numbers"),
        (beyond_floats_in_mm, "beyond the range of numbers"),
        (without_mechanisms, "it names no check"),
        (without_checks, "it names no check"),
    ],
)
def test_results_that_contradict_themselves_are_refused(
    command: str,
    change: Callable[[dict[str, Any]], None],
    words: str,
    results: dict[str, Any],
    tmp_path: Path,
    capfd: Capture,
) -> None:
    change(results)
    assert asked(command, results, tmp_path) == 2
    assert words in capfd.readouterr().err
