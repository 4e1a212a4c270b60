"""The command ``batch`` from a study file to its folder: what it writes, tells and refuses."""

from __future__ import annotations

import json
import os
import pty
import re
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest

from diecut_report.cli.main import main
from diecut_report.config.yaml import FORBIDDEN_IN_KEY
from diecut_report.study.execution import dask_cluster, variant_reports
from diecut_report.study.execution.variant_reports import best
from tests.configs import EXAMPLES, GOOD, saved
from tests.study.studies import BASE, STUDY, varied

KNIFE = next(path for path in EXAMPLES if path.stem == "circular_knife")

Capture = pytest.CaptureFixture[str]
CHECKED = BASE.replace("force: 2 kN,", "force: 2 kN, allowable_moment: 450,")


def run(*arguments: object) -> int:
    return main([*map(str, arguments), "--plugins", str(GOOD)])


def files(folder: Path, text: str = STUDY, base: str = BASE) -> Path:
    saved(folder, base)
    return saved(folder, text, "study.yaml")


def batch(folder: Path, text: str = STUDY, *options: object, base: str = BASE) -> int:
    """The exit code of a study that is run into the folder ``out``."""
    return run("batch", files(folder, text, base), "-o", folder / "out", *options)


def counts(folder: Path) -> dict[str, int]:
    found: dict[str, int] = json.loads((folder / "out" / "study.json").read_text())["counts"]
    return found


def rows(folder: Path) -> list[dict[str, object]]:
    found: list[dict[str, object]] = pq.read_table(folder / "out" / "variants").to_pylist()
    return found


def test_strict_fails_where_a_variant_warns_or_a_check_is_not_made(tmp_path: Path, without_summary: None) -> None:
    without_limit = files(tmp_path)
    assert run("batch", without_limit, "-o", tmp_path / "one") == 0
    assert run("batch", "--resume", tmp_path / "one", "--strict") == 1
    limited = files(tmp_path, base=BASE.replace("force:", "allowable_moment: 1000 N*m, force:"))
    assert run("batch", limited, "-o", tmp_path / "two", "--strict") == 0


@pytest.mark.nightly
@pytest.mark.wheel
def test_a_study_becomes_a_folder_named_as_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: Capture) -> None:
    files(tmp_path)
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    assert run("batch", "../study.yaml") == 0
    out, err = capfd.readouterr()
    assert out == ""
    assert err.splitlines() == ["written: study, with summary.html and summary.pdf", "6 variants: 6 pass."]
    names = {"study.json", "study.yaml", "base.yaml", "variants", "summary.html", "summary.pdf"}
    assert {path.name for path in Path("study").iterdir()} >= names
    forces = pq.read_table("study/variants")["mechanisms.a.force"].to_pylist()
    assert forces == [1000, 1000, 2000, 2000, 3000, 3000]
    state = json.loads(Path("study/study.json").read_text())
    assert (state["state"], state["counts"]["variants"]) == ("complete", 6)


@pytest.mark.usefixtures("without_summary")
def test_a_variant_that_fails_gives_1_and_one_in_error_does_not(tmp_path: Path) -> None:
    assert batch(tmp_path, STUDY, "--quiet", base=CHECKED) == 1
    assert [row["status"] for row in rows(tmp_path)] == ["pass", "pass", "pass", "pass", "fail", "fail"]
    assert rows(tmp_path)[5]["governing"] == "a.checks.moment"
    impossible = varied("[100 mm, 999 mm]", path="mechanisms.a.arm").replace("count", "")
    assert run("batch", files(tmp_path, impossible), "-o", tmp_path / "other", "--quiet") == 0


@pytest.mark.usefixtures("without_summary")
def test_a_study_of_which_no_variant_can_exist_gives_1_and_says_so(tmp_path: Path, capfd: Capture) -> None:
    assert batch(tmp_path, varied("[200, 210]", path="mechanisms.a.teeth")) == 1
    assert [row["status"] for row in rows(tmp_path)] == ["error", "error"]
    assert "No variant can exist; the summary gives the reasons." in capfd.readouterr().err


@pytest.mark.usefixtures("without_summary")
def test_outputs_and_curves_are_those_that_were_asked_for(tmp_path: Path) -> None:
    batch(tmp_path, varied("[1 kN, 2 kN]", rest="outputs: [a.moment]\ncurves: [a.angle]\n"), "--quiet")
    schema = pq.read_schema(next((tmp_path / "out" / "variants").iterdir()))
    assert [name for name in schema.names if ".checks." not in name] == [
        "variant", "mechanisms.a.force", "a.moment", "a.angle", "verdict", "status", "governing", "error"]  # fmt: skip
    assert schema.field("a.moment").metadata[b"unit"] == b"N*m"
    assert len({len(row["a.angle"]) for row in rows(tmp_path)}) == 1  # type: ignore[arg-type]


UNDEFINED = "constraints: [\"'1 kN*m' / (mechanisms.a.force - '2 kN') < '5 m'\", \"mechanisms.a.force < '{limit}'\"]\n"
NO_VALUE = "1 of them because a constraint has no value there (a division by zero, or the root of a number below zero)"


@pytest.mark.usefixtures("with_html_summary")
@pytest.mark.nightly
def test_variants_for_which_a_constraint_has_no_value_are_dropped_and_counted(tmp_path: Path, capfd: Capture) -> None:
    assert batch(tmp_path, varied("[1 kN, 2 kN, 3 kN, 4 kN]", rest=UNDEFINED.format(limit="3.5 kN"))) == 0
    assert f"; the constraints exclude 2 more of the sample, {NO_VALUE}." in capfd.readouterr().err
    assert [row["variant"] for row in rows(tmp_path)] == [0, 2]
    page = re.sub(r"<[^>]+>", " ", (tmp_path / "out" / "summary.html").read_text("utf-8"))
    assert len(re.findall(rf"2\s+variants, {re.escape(NO_VALUE)}", page)) == 2
    assert run("batch", "--resume", tmp_path / "out") == 0
    assert f"exclude 2 more of the sample, {NO_VALUE}." in capfd.readouterr().err


@pytest.mark.usefixtures("without_summary")
def test_variants_that_another_constraint_drops_anyway_are_not_counted_again(tmp_path: Path) -> None:
    assert batch(tmp_path, varied("[1 kN, 2 kN]", rest=UNDEFINED.format(limit="1.5 kN")), "--quiet") == 0
    assert counts(tmp_path)["dropped"] == 1 and "without_value" not in counts(tmp_path)


@pytest.mark.usefixtures("without_summary")
@pytest.mark.parametrize(
    ("rest", "why"),
    [("constraints: [\"mechanisms.a.force > '5 kN'\"]\n", ""), (UNDEFINED.format(limit="3.5 kN"), f", {NO_VALUE}")],
)
def test_constraints_that_drop_all_variants_are_told_before_anything_is_written(
    tmp_path: Path, capfd: Capture, rest: str, why: str
) -> None:
    assert batch(tmp_path, varied("[2 kN, 4 kN]", rest=rest)) == 2
    told = f"constraints: the constraints exclude all 2 variants of the sample{why}. Relax one of them"
    assert told in capfd.readouterr().err
    assert not (tmp_path / "out").exists()


@pytest.mark.usefixtures("without_summary")
@pytest.mark.parametrize(
    ("condition", "left"),
    [("a.moment < '500 N*m'", [0, 1]), ("a.moment > mechanisms.a.force * '0.3 m'", []),
     ("a.moment - '0.4 kN*m' = 0 or mechanisms.a.force > '2.5 kN'", [1, 2]), ("not a.moment / (a.moment - a.moment) > 1", [])],
)  # fmt: skip
def test_constraints_on_outputs_drop_what_was_calculated(tmp_path: Path, condition: str, left: list[int]) -> None:
    """The arm is 200 mm: forces of 1, 2 and 3 kN give 200, 400 and 600 N*m."""
    text = varied("[1 kN, 2 kN, 3 kN]", rest=f'constraints: ["{condition}"]\noutputs: [b.moment]\n')
    assert batch(tmp_path, text, "--quiet") == 0
    assert [row["variant"] for row in rows(tmp_path)] == left
    assert (counts(tmp_path)["sample"], counts(tmp_path)["dropped"]) == (3, 3 - len(left))


@pytest.mark.usefixtures("without_summary")
def test_a_variant_in_error_keeps_its_reason_whatever_a_constraint_asks_of_outputs(tmp_path: Path) -> None:
    rest = "constraints: [\"a.moment > '1 N*m'\"]\n"
    assert batch(tmp_path, varied("[50, 200]", path="mechanisms.a.teeth", rest=rest), "--quiet") == 0
    assert [row["status"] for row in rows(tmp_path)] == ["pass", "error"]


@pytest.mark.nightly
def test_a_study_of_which_the_outputs_leave_nothing_still_tells_so(tmp_path: Path, capfd: Capture) -> None:
    assert batch(tmp_path, varied("[1 kN, 2 kN]", rest="constraints: [\"a.moment > '5 kN*m'\"]\n")) == 0
    assert "0 variants: none; the constraints exclude 2 more of the sample." in capfd.readouterr().err
    assert "No variant" in (tmp_path / "out" / "summary.html").read_text("utf-8")


@pytest.mark.usefixtures("without_summary")
def test_a_huge_grid_says_its_size_and_asks(tmp_path: Path, capfd: Capture) -> None:
    arms = "  mechanisms.a.arm: {from: 1 mm, to: 900 mm, count: 1000000}\n"
    assert batch(tmp_path, varied("{from: 1 kN, to: 2 kN, count: 1000000}", rest=arms)) == 2
    template = "the sample has 1,000,000,000,000 variants, more than 10,000,000. Vary less, or give --yes"
    assert template in capfd.readouterr().err
    assert not (tmp_path / "out").exists()


@pytest.mark.nightly
@pytest.mark.usefixtures("without_summary")
def test_reports_of_some_variants_are_the_same_from_several_processes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(variant_reports, "FORMATS", ("html", "json"))  # here; other processes make the PDF too
    made = []
    for jobs, values, reports in ((1, "[1 kN, 2 kN, 3 kN]", "[0]"), (2, "[1 kN, 2 kN]", "all")):
        study = files(tmp_path, varied(values, rest=f"reports: {reports}\n"))
        assert run("batch", study, "-o", tmp_path / f"{jobs}", "--jobs", jobs) == 0
        made.append({path.name: path.read_bytes() for path in (tmp_path / f"{jobs}" / "reports").iterdir()})
    assert sorted(made[0]) == ["0.html", "0.json"]
    assert sorted(made[1]) == [f"{variant}.{ending}" for variant in (0, 1) for ending in ("html", "json", "pdf")]
    assert made[0].items() <= made[1].items()


@pytest.mark.usefixtures("without_summary")
def test_some_variants_get_reports_and_one_that_is_dropped_is_told(
    tmp_path: Path, capfd: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(variant_reports, "FORMATS", ("json",))
    rest = "reports: [0, 2]\nconstraints: [\"mechanisms.a.force < '3.5 kN'\"]\n"
    assert batch(tmp_path, varied("[1 kN, 2 kN, 4 kN]", rest=rest)) == 0
    assert [path.name for path in (tmp_path / "out" / "reports").iterdir()] == ["0.json"]
    assert "variant 2 gets no full report: a constraint excludes it." in capfd.readouterr().err


@pytest.mark.usefixtures("without_summary")
def test_the_failed_ones_get_a_report(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(variant_reports, "FORMATS", ("json",))
    assert batch(tmp_path, varied("[2 kN, 3 kN]", rest="reports: failed\n"), "--quiet", base=CHECKED) == 1
    assert [path.name for path in (tmp_path / "out" / "reports").iterdir()] == ["1.json"]
    found = json.loads((tmp_path / "out" / "reports" / "1.json").read_text())
    assert found["status"] == "fail"
    assert found["mechanisms"]["a"]["inputs"]["force"]["value"] == 3000


@pytest.mark.usefixtures("without_summary")
@pytest.mark.nightly
def test_a_full_report_says_and_verifies_what_the_report_of_its_variant_does(
    tmp_path: Path, capfd: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With its assumed values tried, and the advice followed."""
    monkeypatch.setattr(variant_reports, "FORMATS", ("html", "json"))
    text = varied("[14 mm, 15 mm]", rest="reports: [1]\n", path="mechanisms.knife.cut_length")
    assert batch(tmp_path, text, "--quiet", base=KNIFE.read_text("utf-8")) == 0
    full = tmp_path / "out" / "reports" / "1.html"
    assert run("report", f"{tmp_path / 'out'}#1", "-o", tmp_path / "own", "--format", "json", "--quiet") == 0
    own = json.loads(next((tmp_path / "own").glob("*.json")).read_text())
    assert json.loads(full.with_suffix(".json").read_text())["summary"] == own["summary"] and own["summary"]["tried"]
    capfd.readouterr()
    assert run("verify", full) == 0
    assert "Everything agrees." in capfd.readouterr().out


@pytest.mark.usefixtures("without_summary")
def test_one_stored_variant_is_a_config_for_other_commands(tmp_path: Path, capfd: Capture) -> None:
    """Where the folder's copy of the base is as it was."""
    out, copy = tmp_path / "out", tmp_path / "out" / "base.yaml"
    assert batch(tmp_path, STUDY, "--quiet", "--format", "csv,xlsx") == 0
    assert capfd.readouterr() == ("", "")
    assert (out / "variants.xlsx").exists()
    assert "mechanisms.a.force [N]" in (out / "variants.csv").read_text().splitlines()[0]
    assert run("calc", f"{out}#4") == 0
    found = json.loads(capfd.readouterr().out)
    assert found["mechanisms"]["a"]["inputs"]["force"]["value"] == 3000
    assert run("report", f"{out}#4", "-o", tmp_path / "one", "--format", "html", "--quiet") == 0
    assert [path.name for path in (tmp_path / "one").iterdir()] == ["out-4.html"]
    assert run("calc", f"{out}#9") == 2
    assert "There is no variant 9 here" in capfd.readouterr().err
    copy.write_text(copy.read_text().replace("200 mm", "300 mm"))
    assert run("calc", f"{out}#4") == 2
    assert "This copy of press.yaml is missing or has changed." in capfd.readouterr().err


@pytest.mark.usefixtures("without_summary")
def test_a_study_given_to_another_command_is_told(tmp_path: Path, capfd: Capture) -> None:
    assert run("calc", files(tmp_path)) == 2
    assert "This is a study: calculate it with diecut-report batch" in capfd.readouterr().err


@pytest.mark.usefixtures("without_summary")
def test_a_refused_folder_and_a_cluster_that_is_not_there_leave_nothing(
    tmp_path: Path, capfd: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(dask_cluster, "TIMEOUT", 1)
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "mine").touch()
    assert run("batch", files(tmp_path), "-o", tmp_path / "full") == 2
    assert "This folder is not empty (mine is in it)" in capfd.readouterr().err
    assert [path.name for path in (tmp_path / "full").iterdir()] == ["mine"]
    assert run("batch", files(tmp_path), "-o", tmp_path / "out", "--dask", "tcp://127.0.0.1:1") == 2
    assert "cannot be reached" in capfd.readouterr().err
    assert not (tmp_path / "out").exists()


def test_rounding_makes_no_variant_better(tmp_path: Path) -> None:
    columns = {"a.x": np.array([2.0, 1.0, 1 + 1e-15]), "a.y": np.array([1.0, 1 + 2e-16, 1.0])}
    columns["status"] = np.array(["pass"] * 3, object)
    assert list(best(columns, [("a.x", True), ("a.y", True)], 1)) == [1]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["batch"], "Name a study file, or a folder to continue with --resume DIR."),
        (["batch", "s.yaml", "--resume", "x", "-o", "y"], "--resume names the folder; omit -o."),
        (["batch", "s.yaml", "--format", "cvs"], "'cvs' is not a format (did you mean 'csv'?); known: csv, xlsx."),
        (["batch", "absent.yaml"], "absent.yaml"),
        (["batch", "--resume", "absent"], "There are no results of a study here"),
        (["variants", "absent"], "There are no results of a study here"),
    ],
)
def test_wrong_usage_gives_2_with_words(
    arguments: list[str], words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: Capture
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(*arguments) == 2
    assert words in capfd.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.nightly
def test_progress_on_a_terminal(tmp_path: Path) -> None:
    program = [sys.executable, "-m", "tests.study.without_summary", "batch", str(files(tmp_path))]
    parent, child = pty.openpty()
    environment = {**os.environ, "TERM": "xterm", "COLUMNS": "120", "PYTHONPATH": str(Path(__file__).parents[2])}
    asked = [*program, "--plugins", str(GOOD), "-o", str(tmp_path / "one")]
    with subprocess.Popen(asked, stderr=child, env=environment) as shown:
        os.close(child)
        told = b""
        with suppress(OSError):  # the program has closed its end
            while True:
                told += os.read(parent, 4096)
    os.close(parent)
    assert shown.returncode == 0
    assert all(words in told for words in (b"6/6", b"0 of 6 fail", b"summary"))


NAME = "\x1b[31mred\u202e.yaml"


@pytest.mark.nightly
def test_the_name_of_a_study_acts_on_no_terminal_and_turns_no_letters_round(tmp_path: Path) -> None:
    """In its summary, and in what is made of its variants."""
    saved(tmp_path, BASE)
    out, taken = tmp_path / "\x1b[2Jout", tmp_path / "taken.yaml"
    assert run("batch", saved(tmp_path, STUDY, NAME), "-o", out, "--jobs", 1, "--quiet") in (0, 1)
    page = (out / "summary.html").read_text("utf-8")
    assert "�[31mred�.yaml" in page and not FORBIDDEN_IN_KEY.search(page.translate({9: None, 10: None}))
    assert run("report", f"{out}#1", "-o", tmp_path / "made", "--format", "html", "--quiet") in (0, 1)
    assert run("calc", f"{out}#1", "-o", tmp_path / "made.json", "--quiet") in (0, 1)
    assert not FORBIDDEN_IN_KEY.search((tmp_path / "made.json").read_text("utf-8").replace("\n", ""))
    assert run("take", f"{out}#1", "-o", taken, "--quiet") == 0
    assert run("calc", taken, "-o", tmp_path / "taken.json") in (0, 1)
