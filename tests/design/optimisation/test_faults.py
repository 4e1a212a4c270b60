"""What a search is refused, and what it tells where no machine is allowed."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import jsonschema
import pytest
import yaml

from diecut_report.cli.main import main
from diecut_report.study.definition.schema import study_schema
from tests.configs import GOOD
from tests.design.optimisation.searches import BASE, FORCE, VARY, optimised, search_file
from tests.study.studies import faults

pytestmark = pytest.mark.usefixtures("without_page")
GOALS = "objectives: [{minimise: a.moment}]"
REFUSED = [  # the block, what is varied, what is told
    ("{objectives: [{minimise: a.momnt}]}", VARY, "optimise.objectives.0.minimise: a.momnt is not an output (did you mean 'moment'?)"),
    ("{objectives: [{minimise: a.size}]}", VARY, "optimise.objectives.0.minimise: a.size is a text or a yes/no"),
    ("{objectives: [{maximise: press.productivity}]}", VARY, "press.productivity is not varied, so it is the same in all variants"),
    ("{objectives: [{maximise: mechanisms.a.grade}]}", VARY + "  mechanisms.a.grade: [fine, coarse]\n",
     "mechanisms.a.grade is a text, a choice or a yes/no, which cannot be minimised or maximised"),
    ("{objectives: [{}]}", VARY, "optimise.objectives.0: names no outputs; give minimise or maximise"),
    ("{objectives: [{minimise: a.moment}, {maximise: a.moment}]}", VARY, "optimise.objectives.1: a.moment is an objective already"),
    ("{}", VARY, "optimise.objectives: is missing; name what is to be minimised or maximised"),
    (f"{{{GOALS}, evaluations: 0}}", VARY, "optimise.evaluations: 0 is out of range; allowed: ≥ 1"),
    (f"{{{GOALS}, population: 3}}", VARY, "optimise.population: 3 is out of range; allowed: ≥ 4"),
    (f"{{{GOALS}, population: 90, evaluations: 80}}", VARY, "optimise.population: is 90, more than the evaluations, 80"),
    (f"{{{GOALS}, generations: 3}}", VARY, "optimise.generations: is an unknown key"),
    (f"{{{GOALS}}}", f"  {FORCE}: [1 kN]\n", "vary: leaves nothing free: each path has a single value."),
    (f"{{{GOALS}}}", f"  {FORCE}: {{distribution: uniform, low: 1 kN, high: 2 kN}}\n", f"vary.{FORCE}: is a distribution; an optimisation "
                                                                                       "searches"),
]  # fmt: skip


@pytest.mark.parametrize(("block", "vary", "words"), REFUSED, ids=[words[:60] for *_, words in REFUSED])
def test_what_cannot_be_searched_is_told_with_its_place(tmp_path: Path, block: str, vary: str, words: str) -> None:
    told = faults(tmp_path, f"schema_version: 1\nbase: press.yaml\nvary:\n{vary}optimise: {block}\n", BASE)
    assert len(told) == 1 and words in told[0] and told[0].startswith("study.yaml:")


def test_a_study_without_sample_and_search_is_told_both_ways(tmp_path: Path) -> None:
    (told,) = faults(tmp_path, f"schema_version: 1\nbase: press.yaml\nvary:\n{VARY}", BASE)
    assert "sample: is missing; say how the variants are taken, or by optimise what is searched for." in told


def test_the_schema_holds_what_is_searched_for(tmp_path: Path) -> None:
    validator = jsonschema.Draft202012Validator(study_schema())
    given = yaml.safe_load(search_file(tmp_path).read_text("utf-8"))
    assert list(validator.iter_errors(given)) == []
    for wrong in ({"evaluations": 0}, {"objectives": [{"minimize": "a.moment"}]}, {"goals": []}):
        assert list(validator.iter_errors(given | {"optimise": given["optimise"] | wrong}))
    assert list(validator.iter_errors({key: value for key, value in given.items() if key != "optimise"}))


def test_validate_takes_a_search_and_batch_sends_it_on(tmp_path: Path, capfd: Any) -> None:
    study = search_file(tmp_path)
    assert main(["validate", str(study), "--plugins", str(GOOD)]) == 0
    assert main(["batch", str(study), "-o", str(tmp_path / "out"), "--plugins", str(GOOD)]) == 2
    assert "Run it with `diecut-report optimise`" in capfd.readouterr().err and not (tmp_path / "out").exists()


def test_a_study_that_says_nothing_of_a_search_is_refused(tmp_path: Path, capfd: Any) -> None:
    study = search_file(tmp_path)
    study.write_text(study.read_text("utf-8").split("optimise:")[0] + "sample: {method: sobol, count: 4}\n", "utf-8")
    assert optimised(study, tmp_path / "out") == 2
    assert "optimise: is missing; say what is searched for" in capfd.readouterr().err


@pytest.mark.nightly
def test_an_objective_that_does_not_vary_leaves_nothing_behind(tmp_path: Path, capfd: Any) -> None:
    vary = "  mechanisms.a.teeth: {from: 20, to: 90}\n"
    assert optimised(search_file(tmp_path, vary=vary, goals="[{minimise: a.moment}]"), tmp_path / "out") == 2
    told = capfd.readouterr().err
    assert "a.moment is the same in all of the first 30 machines tried" in told and not (tmp_path / "out").exists()
    assert re.search(r"search\.yaml:\d+:\d+: optimise\.objectives\.0: ", told)


def test_where_no_machine_is_allowed_the_conflict_and_the_nearest_are_told(tmp_path: Path, capfd: Any) -> None:
    # a moment of at most 40 N·m by the check needs an arm below 40 mm; a pressure of at most 1 MPa one above 100 mm
    base = BASE.replace("width: 10 mm", "width: 10 mm, allowable_moment: 120 N*m")
    study = search_file(tmp_path, base=base, rest="constraints: [\"a.pressure <= '0.7 MPa'\"]\n")
    assert optimised(study, tmp_path / "out", "--quiet") == 1
    text = capfd.readouterr().out
    assert "none of them satisfies all of these: " in text and "a.pressure <= '0.7 MPa'" in text and "a.checks." in text
    assert "nearest is " in text
    found = json.loads((tmp_path / "out" / "front.json").read_text("utf-8"))
    assert found["front"] == [] and len(found["conflict"]["together"]) == 2 and found["conflict"]["nearest"] is not None


def test_where_constraints_drop_all_that_is_told(tmp_path: Path, capfd: Any) -> None:
    study = search_file(tmp_path, rest=f"constraints: [\"{FORCE} >= '5 kN'\"]\n")
    assert optimised(study, tmp_path / "out", "--quiet") == 1
    assert "the constraints between inputs exclude them all" in capfd.readouterr().out


@pytest.mark.nightly
def test_it_speaks_ukrainian(tmp_path: Path, capfd: Any) -> None:
    assert optimised(search_file(tmp_path), tmp_path / "out", "--quiet", "--language", "uk") == 0
    text = capfd.readouterr().out
    assert "шукано: найменше: a.moment" in text and "пропозиція: " in text and "searched" not in text
    assert not re.search(r"\d\.\d", text)


@pytest.mark.nightly
def test_a_cluster_that_cannot_be_reached_is_told_before_anything_is_written(
    tmp_path: Path, capfd: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("diecut_report.study.execution.dask_cluster.TIMEOUT", 1)
    assert optimised(search_file(tmp_path), tmp_path / "out", "--dask", "tcp://127.0.0.1:1") == 2
    assert "The Dask scheduler at tcp://127.0.0.1:1 cannot be reached" in capfd.readouterr().err
    assert not (tmp_path / "out").exists()


def test_what_goes_on_with_a_search_is_named_so(tmp_path: Path, capfd: Any) -> None:
    assert optimised(search_file(tmp_path), tmp_path / "out", "--quiet") == 0
    state = tmp_path / "out" / "study.json"
    state.write_text(state.read_text("utf-8").replace('"rows": 120', '"rows": 119'), "utf-8")
    capfd.readouterr()
    assert main(["variants", str(tmp_path / "out")]) == 2
    assert f"diecut-report optimise --resume {tmp_path / 'out'}" in capfd.readouterr().err


def test_a_machine_that_is_not_named_is_refused(tmp_path: Path, capfd: Any) -> None:
    assert optimised(search_file(tmp_path), tmp_path / "out", "--report", "best") == 2
    assert "'best' is neither the number of a machine nor one of: suggested, front." in capfd.readouterr().err
    assert optimised(search_file(tmp_path), tmp_path / "out", "--report", "3,120") == 2
    assert "there is no machine 120; those that are tried are numbered from 0 to 119." in capfd.readouterr().err
    assert not (tmp_path / "out").exists()
