"""The command check: many machines side by side, their verdicts in one table and one summary."""

from __future__ import annotations

import csv
import io
import json
import re
from pathlib import Path

import openpyxl
import pytest
from pypdf import PdfReader

from diecut_report.cli.main import main
from diecut_report.results.model import ResultsRecord
from tests.configs import BROKEN, GOOD, LEVER, saved
from tests.records import filled

Capture = pytest.CaptureFixture[str]
LIMITED = LEVER.replace("force: 2 kN", "force: 2 kN, allowable_moment: 150 N*m")


def check(*arguments: object, jobs: int = 1) -> int:
    return main(["check", *map(str, arguments), "--plugins", str(GOOD), "--jobs", str(jobs)])


@pytest.fixture
def firm(tmp_path: Path) -> Path:
    """A folder with a machine that passes, one that fails, a study, and in a folder below it one that passes."""
    folder = tmp_path / "firm"
    (folder / "old").mkdir(parents=True)
    saved(folder, LIMITED.replace("150", "250"), "good.yaml")
    saved(folder, LIMITED, "weak.yaml")
    saved(folder / "old", LIMITED.replace("150", "400").replace("2 kN", "3 kN"), "good.yaml")
    saved(folder, "base: good.yaml\nsample: {method: grid}\n", "study.yaml")
    return folder


def test_a_folder_gives_one_table(firm: Path, capfd: Capture) -> None:
    assert check(firm, jobs=2) == 1
    out, err = capfd.readouterr()
    assert [line.split() for line in out.splitlines()[1:]] == [
        ["firm/good", "pass", "a.moment", "80.0", "%", "0", "0", "0", "0"],
        ["old/good", "pass", "a.moment", "75.0", "%", "0", "0", "0", "0"],
        ["firm/weak", "fail", "a.moment", "133.3", "%", "1", "0", "0", "0"],
    ]
    template = "skipped: it is a study, which batch calculates"
    assert err == f"{firm / 'study.yaml'}: {template}\n3 machines: 2 pass, 1 fail.\n"


def test_a_machine_that_passes_on_what_is_assumed_is_conditional(tmp_path: Path, capfd: Capture) -> None:
    folder, text = tmp_path / "firm", LIMITED.replace("150", "250")
    folder.mkdir()
    saved(folder, text, "good.yaml")
    saved(folder, text.replace("2 kN", "{value: 2 kN, basis: assumed}").replace("250", "210"), "guessed.yaml")
    assert check(folder, "-o", tmp_path / "out", "--format", "json,csv,html") == 0
    out, err = capfd.readouterr()
    assert [line.split()[:2] + line.split()[-1:] for line in out.splitlines()[1:]] == [
        ["good", "pass", "0"],
        ["guessed", "conditional", "1"],
    ]
    assert "2 machines: 1 pass, 1 conditional.\n" in err
    stored = json.loads((tmp_path / "out" / "machines.json").read_text("utf-8"))["machines"]
    assert [each["conclusion"] for each in stored] == [
        "All checks pass.",
        "No check fails, but 1 assumed value is open and 1 default value is open.",
    ]
    assert [each["verdict"] for each in stored] == ["pass", "conditional"]
    page = (tmp_path / "out" / "machines.html").read_text("utf-8")
    assert '<span class="conditional">conditional' in page
    assert "verdict,Verdict,1,pass,conditional" in (tmp_path / "out" / "machines.csv").read_text("utf-8")


def test_all_pass_ends_with_0(firm: Path) -> None:
    assert check(firm / "good.yaml", firm / "old") == 0


def test_a_bad_file_is_told_and_the_others_go_on(firm: Path, capfd: Capture) -> None:
    saved(firm, LEVER.replace("2 kN", "2 kg, arm: -1"), "bad.yaml")
    assert check(firm) == 2
    out, err = capfd.readouterr()
    assert out.splitlines()[1].split() == ["firm/bad", "bad", "file"]
    assert len(out.splitlines()) == 5
    assert "bad.yaml:5:27: mechanisms.a.force: 2 kg is a mass" in err and "bad.yaml:5:38: mechanisms.a.arm" in err


def test_a_broken_plugin_ends_with_3(firm: Path, capfd: Capture) -> None:
    saved(firm, LEVER + "  x: {kind: breaks_in_calculation}\n", "broken.yaml")
    assert main(["check", str(firm), "--plugins", str(GOOD), "--plugins", str(BROKEN), "--jobs", "1"]) == 3
    assert "plugin 'breaks_in_calculation'" in capfd.readouterr().err


def test_an_empty_folder_is_told(tmp_path: Path, capfd: Capture) -> None:
    assert check(tmp_path) == 2
    assert capfd.readouterr().err.startswith("There is no configuration in")


def test_the_summary_has_all_formats_with_the_same_numbers(firm: Path, tmp_path: Path, capfd: Capture) -> None:
    assert check(firm, "-o", tmp_path / "out") == 1
    out = tmp_path / "out"
    assert sorted(path.name for path in out.iterdir()) == [
        f"machines.{e}" for e in ("csv", "html", "json", "pdf", "xlsx")
    ]
    data = json.loads((out / "machines.json").read_text("utf-8"))
    moment = {"firm/good": 0.8, "old/good": 0.75, "firm/weak": 200 / 150}
    assert {name: cell["utilisation"] for name, cell in data["checks"][0]["machines"].items()} == pytest.approx(moment)
    differing = {row["path"]: list(row["machines"].values()) for row in data["own_changes"]}
    assert differing == {"a.force": [2, 3, 2], "a.allowable_moment": [250, 400, 150]}
    advice = "Moment 200 N·m, allowed 150 N·m: shorten the arm."
    assert data["advice"] == [{"machine": "firm/weak", "check": "a.moment", "text": advice}]
    rows = list(csv.reader(io.StringIO((out / "machines.csv").read_text("utf-8"))))
    assert ["a.checks.moment.utilisation", "Moment", "1", "0.8", "0.75", "1.3333333333333333"] in rows
    assert ["a.checks.moment.status", "Moment", "", "pass", "pass", "fail"] in rows
    book = openpyxl.load_workbook(out / "machines.xlsx")
    assert book.sheetnames == ["comparison", "differences", "checks", "advice"]
    assert book["comparison"]["B4"].value == "fail"
    page = (out / "machines.html").read_text("utf-8")
    assert "133.3\N{NO-BREAK SPACE}%" in page and "shorten the arm" in page and "<script" not in page
    document = PdfReader(out / "machines.pdf")
    assert re.search(rf"\b1\s+of\s+{len(document.pages)}\b", document.pages[0].extract_text())


def test_what_is_passed_over_in_a_folder_is_told(firm: Path, tmp_path: Path, capfd: Capture) -> None:
    saved(firm, "- 1\n", "list.yml")
    check(firm)
    err = capfd.readouterr().err
    assert f"{firm / 'list.yml'}: skipped: it has no key mechanisms, and so is not a configuration\n" in err
    assert f"{firm / 'study.yaml'}: skipped: it is a study, which batch calculates\n" in err
    check(firm, "--quiet")
    assert ": skipped: " not in capfd.readouterr().err
    other = tmp_path / "other"
    other.mkdir()
    saved(other, "a: 1\n", "no.yaml")
    assert check(other) == 2
    err = capfd.readouterr().err
    assert "There is no configuration in" in err and "no.yaml: skipped: it has no key" in err


def test_only_the_asked_formats_are_written(firm: Path, tmp_path: Path) -> None:
    check(firm, "-o", tmp_path / "out", "--format", "csv,json", "--quiet")
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["machines.csv", "machines.json"]


def test_strict_ends_with_1_where_something_is_not_checked() -> None:
    from diecut_report.cli.checking import _code
    from diecut_report.study.comparison import Verdict

    for verdict, codes in (("pass", (0, 0)), ("conditional", (0, 1)), ("fail", (1, 1))):
        judged = [Verdict("a", "a.yaml", "pass", verdict=verdict)]
        assert (_code(judged, strict=False), _code(judged, strict=True)) == codes


def test_what_is_not_checked_is_counted_from_the_results() -> None:
    from diecut_report.study.comparison import verdict
    from diecut_report.study.machines import CheckedMachine

    results = filled(ResultsRecord, {"summary": {"not_checked": 7}})
    assert verdict(CheckedMachine("a.yaml", "pass", results), "a").not_checked == 7
