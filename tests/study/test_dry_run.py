"""A dry run tells what a study is before it is run: held against counts by hand and against the run itself."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from diecut_report.cli.main import main
from diecut_report.study.execution import dry_run as module
from diecut_report.study.execution.dry_run import dry_run
from tests.configs import GOOD, saved
from tests.study.studies import BASE, study, varied

Capture = pytest.CaptureFixture[str]
TEN = "schema_version: 1\nbase: press.yaml\nsample: {method: grid}\nvary:\n"
FORCES = TEN + "  mechanisms.a.force: [1 kN, 2, 3000 N, 4, 5]\n  mechanisms.a.grade: [fine, coarse]\n"
DROPPING = FORCES + "constraints:\n  - mechanisms.a.force >= '2 kN'\n  - mechanisms.a.force != '5 kN'\n"


def validated(folder: Path, text: str, capfd: Capture, *more: str, code: int = 0) -> Any:
    saved(folder, BASE)
    file = saved(folder, text, "study.yaml")
    assert main(["validate", str(file), "--format", "json", *more, "--plugins", str(GOOD)]) == code
    (found,) = json.loads(capfd.readouterr().out)
    return found


def test_the_variants_and_what_each_constraint_drops_are_counted(tmp_path: Path, capfd: Capture) -> None:
    found = validated(tmp_path, DROPPING, capfd, "--dry-run")["study"]
    assert (found["rows"], found["variants"], found["exact"]) == (10, 6, True)
    assert found["dropped_by"] == {"mechanisms.a.force >= '2 kN'": 2, "mechanisms.a.force != '5 kN'": 2}
    assert found["measured"]["variants"] == 6 == sum(found["measured"]["statuses"].values())
    force, grade = found["varied"]  # with their range and the value of the first variant
    assert force == {"path": "mechanisms.a.force", "unit": "kN", "low": 1.0, "high": 5.0, "texts": [], "first": 2.0}
    assert (grade["texts"], grade["first"], grade["low"]) == (["fine", "coarse"], "fine", None)
    on_results = FORCES + "constraints: [a.moment <= '500 N*m']\n"
    found = validated(tmp_path, on_results, capfd, "--dry-run")["study"]
    assert found["variants"] == 10 and found["dropped_by"] == {}
    assert found["measured"]["dropped"] == 6  # forces of 1 and 2 kN at 200 mm stay, 400 N·m at most


def test_the_size_is_that_of_the_run(tmp_path: Path, without_summary: None) -> None:
    found = dry_run(study(tmp_path, varied("{from: 1 kN, to: 9 kN}", sample="{method: latin_hypercube, count: 1100}")))
    asked = ["batch", str(tmp_path / "study.yaml"), "-o", str(tmp_path / "out"), "--jobs", "1", "--quiet"]
    assert main([*asked, "--plugins", str(GOOD)]) in (0, 1)
    files = list((tmp_path / "out" / "variants").glob("*.parquet"))
    assert found.bytes_ == pytest.approx(sum(file.stat().st_size for file in files), rel=0.5)
    assert found.parts == len(files)
    names = json.loads((tmp_path / "out" / "study.json").read_text("utf-8"))["columns"]
    assert found.checks == len([name for name in names if ".checks." in name and name.endswith(".status")])
    # varied, variant, verdict
    assert found.quantities == len([name for name in names if ".checks." not in name]) - 6


def test_of_a_large_sample_pieces_are_looked_at_that_lie_evenly(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "LOOKED_AT", 1000)
    text = varied("{from: 1 kN, to: 9 kN, count: 8000}", rest="constraints: [mechanisms.a.force <= '3 kN']\n")
    found = dry_run(study(tmp_path, text))
    assert (found.rows, found.looked_at, found.is_exact) == (8000, 1000, False)
    assert found.variants == pytest.approx(2000, rel=0.1)
    assert (found.varied[0]["low"], found.varied[0]["high"]) == (1.0, 9.0)


def test_rates_are_those_of_a_further_variant() -> None:
    assert module._rates([(10, 1.5, 1100), (110, 6.5, 2100)], 3.0) == pytest.approx((0.05, 1.0, 3.0, 10.0, 1000.0))
    assert module._rates([(4, 2.0, 400)], 3.0) == pytest.approx((0.5, 0.0, 3.0, 100.0, 0.0))
    assert module._rates([(0, 1.0, 50), (3, 1.0, 80)], 3.0)[0] == pytest.approx(1 / 3)
    disturbed = module._rates([(10, 3.0, 100), (20, 2.0, 90)], 3.0)
    assert disturbed == pytest.approx((0.1, 0.0, 3.0, 0.0, 90.0))


def test_variants_that_lie_among_the_first_rows_alone_are_counted(tmp_path: Path) -> None:
    """Of 300 rows the first three satisfy the constraint: they are those that are measured, whatever comes behind them."""
    text = varied("{from: 1 kN, to: 300 kN, count: 300}", rest="constraints: [mechanisms.a.force <= '3 kN']\n")
    found = dry_run(study(tmp_path, text)).measured
    assert (found.variants, found.statuses.total(), found.dropped) == (3, 3, 0) and found.seconds > 0


def test_the_time_is_that_of_the_variants_of_the_part_files_and_of_a_process(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = dry_run(study(tmp_path, varied("{from: 1 kN, to: 9 kN, count: 8000}")))
    measured = replace(found.measured, seconds=0.01, seconds_of_part=0.5, seconds_once=3.0)
    monkeypatch.setattr(module.os, "cpu_count", lambda: 2)
    parts = -(-found.parts // 2)
    assert replace(found, measured=measured).seconds == pytest.approx(3 + 0.5 * parts + 0.01 * found.variants / 2)


def test_people_are_told_it_line_by_line_and_nothing_is_written(tmp_path: Path, capfd: Capture) -> None:
    saved(tmp_path, BASE)
    saved(tmp_path, "mechanisms.a.force [kN]\n1.5\n2.5\n3.5\n", "forces.csv")
    file = saved(
        tmp_path, "schema_version: 1\nbase: press.yaml\nsample: {method: table, file: forces.csv}\n", "study.yaml"
    )
    before = sorted(tmp_path.iterdir())
    assert main(["validate", str(file), "--dry-run", "--plugins", str(GOOD)]) == 0
    out, err = capfd.readouterr()
    lines = out.splitlines()
    assert err == f"{file}: valid\n" and lines[0] == f"{file}: 3 variants"
    assert "  mechanisms.a.force  1.5 … 3.5 kN  variant 0: 1.5 kN" in lines
    assert "calculated 3 to measure: " in out and " in 1 process, excluding summary" in out and "disk: about " in out
    assert sorted(tmp_path.iterdir()) == before
    assert main(["validate", str(file), "--dry-run", "--language", "uk", "--plugins", str(GOOD)]) == 0
    assert "1,5 … 3,5 kN" in capfd.readouterr().out


def test_of_a_search_it_tells_how_many_machines_are_tried(tmp_path: Path, capfd: Capture) -> None:
    ranged = FORCES.replace("sample: {method: grid}\n", "").replace("[1 kN, 2, 3000 N, 4, 5]", "{from: 1 kN, to: 5 kN}")
    search = "optimise: {objectives: [minimise: a.moment], evaluations: 400, population: 40, seed: 1}\n"
    found = validated(tmp_path, ranged + search, capfd, "--dry-run")["study"]
    goals = {"objectives": [{"minimise": "a.moment"}], "passing": True}
    assert (found["rows"], found["optimise"]) == (40, {"evaluations": 400, "population": 40} | goals)
    asked = ["validate", str(tmp_path / "study.yaml"), "--dry-run", "--plugins", str(GOOD)]
    assert main(asked) == 0
    lines = capfd.readouterr().out.splitlines()
    assert lines[0].endswith("study.yaml: a search over 400 machines, 40 per generation")
    assert lines[1:3] == ["  searched for: a.moment minimised", "  feasible: machines with no failing check"]
    assert "  mechanisms.a.force  1 … 5 kN" in lines  # the whole range, and not what the first generation takes of it
    assert lines[-1].startswith("  time: ") and lines[-1].endswith(" on one processor, excluding page and reports")
    saved(tmp_path, FORCES + search, "study.yaml")  # beside a sample both are told
    assert main(asked) == 0
    out = capfd.readouterr().out
    assert "optimise tries 400 machines, which take one processor about " in out and "variant 0: " in out


def test_all_faults_are_told_at_once_and_nothing_is_calculated(tmp_path: Path, capfd: Capture) -> None:
    text = FORCES.replace("force", "farce").replace("grid", "grit")
    found = validated(tmp_path, text, capfd, "--dry-run", code=2)
    assert found["status"] == "bad" and "study" not in found
    assert {each["path"].split(".")[0] for each in found["problems"]} == {"sample", "vary"}
    assert all(each["line"] and each["file"].endswith("study.yaml") for each in found["problems"])
    text = FORCES + "constraints: [mechanisms.a.force > '9 kN']\n"
    found = validated(tmp_path, text, capfd, "--dry-run", code=2)
    assert "the constraints exclude all 10 variants" in found["problems"][0]["message"]


def test_files_are_judged_as_json_without_being_tried(tmp_path: Path, capfd: Capture) -> None:
    found = validated(tmp_path, DROPPING, capfd)
    assert found == {"file": str(tmp_path / "study.yaml"), "status": "valid", "problems": [], "broken": []}
    assert main(["validate", str(tmp_path / "press.yaml"), "--format", "json", "--plugins", str(GOOD)]) == 0
    assert json.loads(capfd.readouterr().out)[0]["status"] == "valid"
