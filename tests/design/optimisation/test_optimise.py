"""The search as a command: a front that is known in closed form, going on where it ended, and what it tells."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report.design.optimisation import run as run_module
from diecut_report.design.optimisation.result import _outstanding
from diecut_report.design.optimisation.run import Recheck, _share
from diecut_report.design.optimisation.search import search
from tests.design.optimisation.searches import ARM, BASE, FORCE, VARY, WIDTH, optimised, search_file

pytestmark = pytest.mark.usefixtures("without_page")


def told(folder: Path) -> Any:
    return json.loads((folder / "front.json").read_text("utf-8"))


def parts(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted((folder / "variants").iterdir())}


@pytest.mark.nightly
def test_the_front_of_a_lever_is_the_hyperbola_of_its_least_force(tmp_path: Path, capfd: Any) -> None:
    # moment m = F a, pressure p = F / (b a): p m = F² / b, least where F is least, whatever the arm
    study = search_file(tmp_path, more="evaluations: 900, population: 60, points: 4")
    assert optimised(study, tmp_path / "out", "--quiet") == 0
    found = told(tmp_path / "out")
    values = [point["values"] for point in found["front"]]
    moment, pressure = (np.array([each[name] for each in values]) for name in ("a.moment", "a.pressure"))
    least = 1000.0**2 / WIDTH
    assert (moment * pressure >= least * (1 - 1e-12)).all() and np.median(moment * pressure) <= least * 1.02
    assert moment.min() < 52 and moment.max() > 195  # from 1 kN × 50 mm to 1 kN × 200 mm
    assert found["today"] == 0 and all(each["same"] for each in found["recheck"]) and len(found["recheck"]) == 4
    text = capfd.readouterr().out
    assert "a.force: " in text and "lower limit of its range, 1 kN: the limit is active; widen the range" in text
    assert "knee: furthest from the straight line" in text
    # as shares of their ranges the hyperbola is symmetric: its knee lies at the arm √(50 · 200) mm
    (knee,) = [point for point in found["front"] if point["variant"] == found["suggested"]]
    assert knee["values"][ARM] == pytest.approx(0.1, rel=0.15)


@pytest.mark.nightly
def test_a_search_that_was_stopped_goes_on_where_it_ended(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: Any
) -> None:
    study = search_file(tmp_path)
    assert optimised(study, tmp_path / "whole", "--quiet") == 0
    whole = parts(tmp_path / "whole")
    written = run_module.SearchRun._generation

    def until_the_third(self: Any, part: int, *more: Any) -> None:
        if part == 3:
            raise KeyboardInterrupt
        written(self, part, *more)

    monkeypatch.setattr(run_module.SearchRun, "_generation", until_the_third)
    assert optimised(study, tmp_path / "begun", "--quiet") == 130
    assert f"optimise --resume {tmp_path / 'begun'}" in capfd.readouterr().err
    monkeypatch.setattr(run_module.SearchRun, "_generation", written)
    assert parts(tmp_path / "begun") == {name: whole[name] for name in list(whole)[:3]}
    assert optimised(None, tmp_path, "--resume", str(tmp_path / "begun"), "--quiet") == 0
    assert parts(tmp_path / "begun") == whole
    for name in ("front.csv", "front.json"):
        assert (tmp_path / "begun" / name).read_bytes() == (tmp_path / "whole" / name).read_bytes()


@pytest.mark.nightly
def test_a_damaged_generation_is_calculated_again_as_it_was(tmp_path: Path) -> None:
    study = search_file(tmp_path)
    optimised(study, tmp_path / "out", "--quiet")
    before = parts(tmp_path / "out")
    (tmp_path / "out" / "variants" / "part-00001.parquet").write_bytes(b"no")
    assert optimised(study, tmp_path, "--resume", str(tmp_path / "out"), "--quiet") == 0
    assert parts(tmp_path / "out") == before


@pytest.mark.nightly
def test_other_machines_than_those_stored_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: Any
) -> None:
    study = search_file(tmp_path)
    optimised(study, tmp_path / "out", "--quiet")
    monkeypatch.setattr(run_module, "present_values", lambda _: {})  # as another version of the library might ask
    assert optimised(None, tmp_path, "--resume", str(tmp_path / "out"), "--quiet") == 2
    assert "belong to another search" in capfd.readouterr().err


@pytest.mark.nightly
def test_the_store_of_another_study_is_refused(tmp_path: Path, capfd: Any) -> None:
    optimised(search_file(tmp_path), tmp_path / "out", "--quiet")
    other = search_file(tmp_path, more="evaluations: 160, population: 30")
    assert optimised(other, tmp_path, "--resume", str(tmp_path / "out"), "--quiet") == 2
    assert "These results belong to another study" in capfd.readouterr().err
    assert optimised(other, tmp_path / "out", "--quiet") == 2
    assert "Results of a study are here already" in capfd.readouterr().err


@pytest.mark.nightly
def test_one_objective_has_one_best_machine(tmp_path: Path, capfd: Any) -> None:
    # the longest arm that a moment of 150 N·m allows: 150 / 1000 m, with the least force
    study = search_file(
        tmp_path, goals=f"[{{maximise: {ARM}}}]", more="evaluations: 750, population: 30",
        rest="constraints: [\"a.moment <= '150 N*m'\", \"mechanisms.a.force >= '1.2 kN'\"]\n",
    )  # fmt: skip
    assert optimised(study, tmp_path / "out", "--quiet") == 0
    (point,) = told(tmp_path / "out")["front"]
    assert point["values"][ARM] == pytest.approx(0.150 / 1.2, rel=2e-3)
    assert "the best of them:" in capfd.readouterr().out


@pytest.mark.nightly
def test_only_machines_without_a_failed_check_are_taken_unless_told(tmp_path: Path) -> None:
    limited = BASE.replace("width: 10 mm", "width: 10 mm, allowable_moment: 90 N*m")
    strict = search_file(tmp_path, base=limited)
    assert optimised(strict, tmp_path / "strict", "--quiet") == 0
    assert max(point["values"]["a.moment"] for point in told(tmp_path / "strict")["front"]) <= 90
    loose = search_file(tmp_path, base=limited, more="evaluations: 120, population: 30, points: 3, passing: false")
    assert optimised(loose, tmp_path / "loose", "--quiet") == 0
    assert max(point["values"]["a.moment"] for point in told(tmp_path / "loose")["front"]) > 90


def test_all_machines_of_short_lists_are_tried_once(tmp_path: Path, capfd: Any) -> None:
    vary = f"  {FORCE}: [1 kN, 2 kN, 3 kN]\n  {ARM}: [50 mm, 100 mm]\n  mechanisms.a.grade: [fine, coarse]\n"
    assert optimised(search_file(tmp_path, vary=vary), tmp_path / "out", "--quiet") == 0
    found = told(tmp_path / "out")
    assert (found["tried"], found["calculated"], len(found["front"])) == (12, 12, 2)
    assert "12 machines tried, all that exist" in capfd.readouterr().out


@pytest.mark.nightly
def test_texts_lists_and_ranges_are_searched_together(tmp_path: Path) -> None:
    vary = VARY + "  mechanisms.a.teeth: {from: 12, to: 60}\n  mechanisms.a.grade: [fine, coarse]\n"
    vary += "  mechanisms.a.parts.0.length: [10 mm, 20 mm, 40 mm]\n"
    with_parts = BASE.replace("width: 10 mm", "width: 10 mm, parts: [{length: 10 mm}]")
    study = search_file(
        tmp_path, vary=vary, goals="[{minimise: a.moment}, {maximise: mechanisms.a.teeth}]", base=with_parts
    )
    assert optimised(study, tmp_path / "out", "--quiet") == 0
    values = [point["values"] for point in told(tmp_path / "out")["front"]]
    assert {each["mechanisms.a.grade"] for each in values} <= {"fine", "coarse"}
    assert all(float(each["mechanisms.a.teeth"]).is_integer() for each in values)
    assert {each["mechanisms.a.parts.0.length"] for each in values} <= {0.01, 0.02, 0.04}


def test_reports_of_chosen_machines_are_made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from diecut_report.design.optimisation import command

    asked: list[tuple[int, ...]] = []
    monkeypatch.setattr(command, "write_chosen", lambda chosen, *_, **__: (asked.append(chosen.variants), ((), {}))[1])
    study = search_file(tmp_path, rest="reports: best 2\n")
    optimised(study, tmp_path / "out", "--quiet", "--report", "0, suggested")
    found = told(tmp_path / "out")
    assert {0, found["suggested"]} < set(asked[0]) and set(asked[0]) <= {
        0,
        *(point["variant"] for point in found["front"]),
    }
    assert 3 <= len(asked[0]) <= 4


@pytest.mark.nightly
def test_what_is_stored_is_asked_as_a_study(tmp_path: Path, capfd: Any) -> None:
    from diecut_report.cli.main import main
    from tests.configs import GOOD

    optimised(search_file(tmp_path), tmp_path / "out", "--quiet")
    capfd.readouterr()
    assert main(["variants", str(tmp_path / "out"), "--where", "violation = 0", "--format", "json", "--top", "1"]) == 0
    (row,) = json.loads(capfd.readouterr().out)["variants"]
    assert row["violation"] == 0
    named = [f"{tmp_path / 'out'}#7", "-o", str(tmp_path / "my.yaml")]
    assert main(["take", *named, "--plugins", str(GOOD), "--quiet"]) == 0
    assert "force: " in (tmp_path / "my.yaml").read_text("utf-8")


def test_equal_searches_ask_for_equal_machines() -> None:
    from diecut_report.study.definition.samples import ChoiceVariable, RangeVariable
    from diecut_report.study.definition.study_file import Objective, Optimise

    variables = (RangeVariable("x", 0.0, 1.0), ChoiceVariable("t", ("p", "q", "r")))
    asked = Optimise((Objective("a", True), Objective("b", True)), variables, 400, 20, 3, True, 5)

    def gone() -> list[Any]:
        found, own = [], search(asked, {})
        for _ in range(4):
            values = own.ask()
            x = np.asarray(values["x"])
            found.append((x.tolist(), values["t"]))
            own.tell(np.stack([x, (1 - x) ** 2], axis=1), np.maximum(0, 0.2 - x))
        return found

    assert gone() == gone()


@pytest.mark.nightly
def test_a_folder_to_go_on_with_holds_what_a_damaged_copy_does_not(tmp_path: Path, capfd: Any) -> None:
    optimised(search_file(tmp_path), tmp_path / "out", "--quiet")
    shutil.copytree(tmp_path / "out", tmp_path / "copy")
    (tmp_path / "copy" / "base.yaml").write_text("schema_version: 1\n", "utf-8")
    assert optimised(None, tmp_path, "--resume", str(tmp_path / "copy"), "--quiet") == 2
    assert "is missing or has changed" in capfd.readouterr().err


@pytest.mark.parametrize(
    ("one", "other", "least", "is_same"),
    [(1.0, 1.0 + 1e-9, 1e-6, True), (1e-10, 1.000001e-10, 1e-6, True), (3e-10, 0.0, 1e-3, True), (2.0, 2.001, 1e-6, False),
     (1e-10, 1e-4, 1e-6, False)],
)  # fmt: skip
def test_only_real_differences_are_reported(one: float, other: float, least: float, is_same: bool) -> None:
    assert Recheck(1, "pass", "pass", "a", _share(one, other, least)).is_same is is_same


def test_a_machine_without_warning_is_suggested_where_there_is_one() -> None:
    costs = np.array([[0.0, 1.0], [0.1, 0.3], [0.2, 0.25], [1.0, 0.0]])
    assert _outstanding(costs, np.array([True] * 4))[0] == 1
    assert _outstanding(costs, np.array([True, False, True, True]))[0] == 2
    assert _outstanding(costs, np.array([False] * 4))[0] == 1
    # the knee has a warning; an end has none
    place, why = _outstanding(costs, np.array([True, False, False, False]))
    assert place == 0 and "without a warning" in why
