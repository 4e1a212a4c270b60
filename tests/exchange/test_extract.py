"""What a report carries comes out of it as it went in, under names of the program's own, and over nothing that is there."""

from __future__ import annotations

import gzip
import hashlib
import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import diecut_report as dr
from diecut_report.results.record import FORM_VERSION
from diecut_report.time_limit import limited
from tests.config.test_own_tables import HEAD, SHAFT, TABLES
from tests.configs import LEVER, SMALL, saved
from tests.exchange.reports import added_at, changed, page_with, pdf_with, removed_at, run, set_at
from tests.report.links import links

Capture = pytest.CaptureFixture[str]


@pytest.mark.wheel
@pytest.mark.parametrize("ending", ["pdf", "html"])
def test_a_report_gives_back_its_configuration_and_its_results_byte_for_byte(
    small_report: Path, tmp_path: Path, ending: str
) -> None:
    assert run("extract", small_report / f"small.{ending}", "-o", tmp_path / "out") == 0
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["small.json", "small.yaml"]
    assert (tmp_path / "out" / "small.yaml").read_bytes() == SMALL.encode()
    assert (tmp_path / "out" / "small.json").read_bytes() == (small_report / "small.json").read_bytes()


def test_a_reader_without_the_program_gets_them_by_the_links_of_the_page(small_report: Path) -> None:
    found = links((small_report / "small.html").read_text("utf-8"))
    assert gzip.decompress(found["results.json.gz"]) == (small_report / "small.json").read_bytes()
    assert gzip.decompress(found["config.yaml.gz"]) == SMALL.encode()


def test_a_byte_order_mark_of_the_configuration_comes_back(tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_bytes(b"\xef\xbb\xbf" + LEVER.encode())
    assert run("report", tmp_path / "a.yaml", "-o", tmp_path / "out", "--format", "html", "--quiet") == 0
    assert run("extract", tmp_path / "out" / "a.html", "-o", tmp_path / "back") == 0
    assert (tmp_path / "back" / "a.yaml").read_bytes() == (tmp_path / "a.yaml").read_bytes()


def test_what_is_there_already_is_not_written_over(small_report: Path, tmp_path: Path, capfd: Capture) -> None:
    own = saved(tmp_path, SMALL.replace("300", "400"), "small.yaml")
    assert run("extract", small_report / "small.html", "-o", tmp_path) == 2
    assert own.read_text("utf-8") == SMALL.replace("300", "400") and not (tmp_path / "small.json").exists()
    assert "Another file of this name exists" in capfd.readouterr().err
    saved(tmp_path, SMALL, "small.yaml")
    assert run("extract", small_report / "small.html", "-o", tmp_path) == 0  # the same one may stay
    assert (tmp_path / "small.json").exists()


def test_neither_a_link_nor_a_pipe_by_that_name_is_written_into(small_report: Path, tmp_path: Path) -> None:
    target = saved(tmp_path, "mine", "elsewhere")
    for make in (lambda path: path.symlink_to(target), os.mkfifo):
        make(tmp_path / "small.json")
        assert run("extract", small_report / "small.html", "-o", tmp_path) == 2
        (tmp_path / "small.json").unlink()
    assert target.read_text("utf-8") == "mine"


def test_names_of_attachments_are_no_names_of_files(small_report: Path, tmp_path: Path) -> None:
    results = (small_report / "small.json").read_bytes()
    data = json.loads(results)
    data["config"]["file"] = "../../above.yaml"
    (tmp_path / "in").mkdir()
    report = tmp_path / "in" / "a.pdf"
    report.write_bytes(pdf_with({"results.json": json.dumps(data).encode(), "../evil.json": b"{}", "/tmp/evil": b"x"}))
    assert run("extract", report, "-o", tmp_path / "in" / "out") == 0
    assert sorted(str(path.relative_to(tmp_path)) for path in tmp_path.rglob("*") if path.is_file()) == [
        "in/a.pdf", "in/out/a.json", "in/out/a.yaml",
    ]  # fmt: skip


def test_a_report_without_results_is_refused_in_words(tmp_path: Path, capfd: Capture) -> None:
    (tmp_path / "a.html").write_bytes(b"<!DOCTYPE html><p>Results</p>")
    (tmp_path / "a.pdf").write_bytes(pdf_with({"other.json": b"{}"}))
    (tmp_path / "a.png").write_bytes(b"\x89PNG")
    for name, words in (
        ("a.html", "carries no results"),
        ("a.pdf", "carries no results"),
        ("a.png", "neither a report"),
    ):
        assert run("extract", tmp_path / name, "-o", tmp_path / "out") == 2
        assert words in capfd.readouterr().err
    assert not (tmp_path / "out").exists()


def test_a_configuration_that_is_not_that_of_the_results_is_refused(
    small_report: Path, tmp_path: Path, capfd: Capture
) -> None:
    results = (small_report / "small.json").read_bytes()
    (tmp_path / "a.pdf").write_bytes(pdf_with({"results.json": results, "config.yaml": LEVER.encode()}))
    assert run("extract", tmp_path / "a.pdf", "-o", tmp_path / "out") == 2
    assert "not the one in the attached results" in capfd.readouterr().err
    (tmp_path / "b.html").write_bytes(page_with(results))
    assert run("extract", tmp_path / "b.html", "-o", tmp_path / "out") == 0


def with_tables(folder: Path) -> Path:
    """The page of a shaft whose steel stands in a table of the user's own, in a folder below the configuration."""
    (folder / "data").mkdir(parents=True)
    saved(folder / "data", TABLES, "steels.yaml")
    config = saved(folder, HEAD.replace("steels.yaml", "data/steels.yaml") + SHAFT, "shaft.yaml")
    assert run("report", config, "-o", folder / "out", "--format", "html", "--quiet") in (0, 1)
    return folder / "out" / "shaft.html"


@pytest.mark.nightly
def test_the_users_own_tables_come_back_and_are_used_again(tmp_path: Path, capfd: Capture) -> None:
    report = with_tables(tmp_path / "in")
    assert run("extract", report, "-o", tmp_path / "out") == 0
    assert (tmp_path / "out" / "data" / "steels.yaml").read_bytes() == TABLES.encode()
    assert run("calc", tmp_path / "out" / "shaft.yaml", "-o", tmp_path / "again.json", "--quiet") in (0, 1)
    # what lies beside the report is not what it was calculated with
    report.with_name("data").mkdir()
    saved(report.with_name("data"), "source: other\nsteels: {own: {strengths: []}}\n", "steels.yaml")
    capfd.readouterr()
    assert run("verify", report, "--numbers") == 0
    assert "shaft.yaml, data/steels.yaml, SHA-256" in capfd.readouterr().out


def with_table(name: str, text: str) -> Callable[[dict[str, Any]], None]:
    """Say that the configuration names a table."""
    digest = hashlib.sha256(text.encode()).hexdigest()
    return added_at("config", "materials", [{"file": name, "sha256": digest, "source_text": text}])


@pytest.mark.parametrize(
    "name",
    [
        "",
        ".",
        "../up.yaml",
        "/tmp/up.yaml",
        "C:\\up.yaml",
        "up.py",
        ".hidden.yaml",
        ".github/workflows/x.yml",
        "a/.b/c.yaml",
        f"{300 * 'a'}.yaml",
    ],
)
def test_the_name_of_a_table_leads_nowhere_else(small_report: Path, tmp_path: Path, name: str) -> None:
    (tmp_path / "in").mkdir()
    report = changed(small_report / "small.json", tmp_path / "in" / "a.json", with_table(name, "x"))
    for command in ("extract", "verify", "render"):
        assert run(command, report, *(["-o", tmp_path / "in" / "out"] if command != "verify" else [])) == 2
    assert [path.name for path in tmp_path.rglob("*") if path.is_file()] == ["a.json"]


@pytest.mark.parametrize("text", ["x", "on: push\njobs: {}\n", "steels: {own: {strengths: []}}\n", "a: [\n"])
def test_what_is_no_table_is_not_written(small_report: Path, tmp_path: Path, text: str) -> None:
    report = changed(small_report / "small.json", tmp_path / "a.json", with_table("compose.yml", text))
    assert run("extract", report, "-o", tmp_path / "out") == 2
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("name", ["a.yaml", "./a.yaml", ".//a.yaml"])
def test_a_table_does_not_take_the_place_of_the_configuration(
    small_report: Path, tmp_path: Path, capfd: Capture, name: str
) -> None:
    report = changed(small_report / "small.json", tmp_path / "a.json", with_table(name, "x"))
    assert run("extract", report, "-o", tmp_path / "out") == 2
    assert "would be called so itself" in capfd.readouterr().err and not (tmp_path / "out").exists()


def test_a_link_to_another_folder_is_not_followed(tmp_path: Path, capfd: Capture) -> None:
    report = with_tables(tmp_path / "in")
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "data").symlink_to(tmp_path / "elsewhere")
    assert run("extract", report, "-o", tmp_path / "out") == 2
    assert "leads out of the folder" in capfd.readouterr().err and not list((tmp_path / "elsewhere").iterdir())


# Results of another form of the results file: older ones are read, and what cannot be is refused with both versions.


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


def without_titles(data: dict[str, Any]) -> None:
    for mechanism in data["mechanisms"].values():
        for section in mechanism["sections"]:
            del section["title"]


@pytest.mark.parametrize("change", [removed_at("", "summary"), without_titles])
def test_what_is_missing_in_another_form_is_told_with_both_versions(
    change: Callable[[dict[str, Any]], object], results: dict[str, Any], tmp_path: Path, capfd: Capture
) -> None:
    change(results)
    assert asked("render", results | {"form_version": "1.0"}, tmp_path) == 2
    told = capfd.readouterr().err
    assert "is missing" in told
    assert f"are of form 1.0 (diecut-report {dr.__version__}), this program has form {FORM_VERSION}" in told
    assert asked("render", first_form(results), tmp_path) == 2
    assert "of a form before 1.3" in capfd.readouterr().err
    assert not list(tmp_path.glob("out/*"))


def test_a_strange_version_is_not_repeated(results: dict[str, Any], tmp_path: Path, capfd: Capture) -> None:
    given = results | {"schema_version": 10**90, "form_version": "\x1b[2J" * 50, "program": {"version": "\x1b[2J"}}
    assert asked("verify", given, tmp_path) == 2
    told = capfd.readouterr().err
    assert f"form {'1' + 19 * '0'}; this program" in told and "\x1b" not in told


def last_output(value: float) -> Callable[[dict[str, Any]], object]:
    return lambda data: [*next(iter(data["mechanisms"].values()))["outputs"].values()][-1].update(value=value)


def without_checks(data: dict[str, Any]) -> None:
    data["mechanisms"][data["governing"]["mechanism"]]["checks"] = []


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize(
    ("change", "words"),
    [
        (last_output(10**400), "beyond the range of numbers"),
        (last_output(1e308), "beyond the range of numbers"),
        (set_at("mechanisms", {}), "it names no check"),
        (without_checks, "it names no check"),
    ],
)
def test_results_that_contradict_themselves_are_refused(
    command: str, change: Callable[[Any], object], words: str, results: Any, tmp_path: Path, capfd: Capture
) -> None:
    change(results)
    assert asked(command, results, tmp_path) == 2
    assert words in capfd.readouterr().err
