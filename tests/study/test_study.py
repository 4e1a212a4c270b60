"""The study file: what it gives, and every mistake in it told in words with its place, all at once."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest
import yaml

from diecut_report.cli.main import main
from diecut_report.config.plugins import Discovery
from diecut_report.errors import PluginError
from diecut_report.study.definition.schema import study_schema
from diecut_report.study.definition.study_file import Objective, Reports, load_study
from tests.configs import BROKEN, EXAMPLE, GOOD, HEAD, saved
from tests.study.studies import BASE, STUDY, faults, study, varied

FORCE, GRADE = "mechanisms.a.force", "mechanisms.a.grade"
VALIDATOR = jsonschema.Draft202012Validator(study_schema())


def schema_faults(text: str) -> list[str]:
    """The keys at which the schema of a study is not met."""
    return sorted({".".join(map(str, error.absolute_path)) for error in VALIDATOR.iter_errors(yaml.safe_load(text))})


def test_a_grid_takes_each_value_with_each_and_what_is_not_asked_for_has_its_default(tmp_path: Path) -> None:
    found = study(tmp_path)
    rows = found.sample.rows(0, 6)
    assert list(rows[FORCE]) == [1000.0, 1000.0, 2000.0, 2000.0, 3000.0, 3000.0]
    assert rows[GRADE] == ["fine", "coarse"] * 3
    assert found.sample.count == 6
    assert {path: asked.unit for path, asked in found.inputs.items()} == {FORCE: "N", GRADE: None}
    assert (found.outputs, found.curves, found.objectives, found.constraints) == (None, (), (), ())
    assert found.reports == Reports("none")
    assert (found.tree.text, found.tree.data["base"], len(found.tree.sha256)) == (STUDY, "press.yaml", 64)
    assert list(found.base.kinds) == ["a", "b"]
    # each text is tried for the names of the results
    assert [each.data["grade"] for base in found.bases if (each := base.instances["a"])] == ["fine", "coarse"]


def test_a_varied_input_replaces_a_reference(tmp_path: Path) -> None:
    found = study(tmp_path, varied("[1 kN]", path="mechanisms.b.force"))
    assert ("b", "force") in found.base.links
    assert ("b", "force") not in found.bases[0].links


def test_inputs_that_the_base_leaves_out_may_vary_with_what_they_give(tmp_path: Path) -> None:
    text = varied("[20 mm, 30 mm]", path="mechanisms.a.width", rest="outputs: [a.pressure]\n")
    assert study(tmp_path, text).outputs == ("a.pressure",)
    told = faults(tmp_path, varied("[1 kN]", rest="outputs: [a.pressure]\n"))
    assert told[0].startswith("study.yaml:6:11: outputs.0: a.pressure is not an output.")


VALUES = [  # what is varied, its values, and the SI values of the rows
    (FORCE, "[1, 2.5]", [1000.0, 2500.0]),
    (FORCE, "{from: 1 kN, to: 2 kN, count: 3}", [1000.0, 1500.0, 2000.0]),
    (FORCE, "{from: 1, to: 100, count: 3, spacing: log}", [1000.0, 10000.0, 100000.0]),
    ("mechanisms.a.teeth", "{from: 20, to: 24, count: 3}", [20.0, 22.0, 24.0]),
    ("mechanisms.a.parts.1.length", "[1 cm, 2]", [0.01, 0.002]),
    ("mechanisms.a.spring.stiffness", "[3 N/mm]", [3000.0]),
    ("mechanisms.a.hard", "[true, false]", ["true", "false"]),
    ("mechanisms.a.remark", "[12.50, on]", ["12.50", "on"]),
    ("mechanisms.a.parts.0.label", "[x]", ["x"]),
    ("press.productivity", "[3600 1/h]", [1.0]),
    ("press.sheet.width", "[500]", [0.5]),
    ("press.name", "[P, Q]", ["P", "Q"]),
]


@pytest.mark.parametrize(("path", "values", "rows"), VALUES, ids=[f"{path} {values}" for path, values, _ in VALUES])
def test_values_are_read_as_in_a_config(tmp_path: Path, path: str, values: str, rows: list[float | str]) -> None:
    text = varied(values, path=path)
    sample = study(tmp_path, text).sample
    found = list(sample.rows(0, sample.count)[path])
    assert found == (pytest.approx(rows) if isinstance(rows[0], float) else rows)
    assert schema_faults(text) == []


DRAWN = [
    ("{distribution: uniform, low: 1 kN, high: 3 kN}", 1000, 3000, 2000),
    ("{distribution: normal, mean: 2 kN, sd: 100 N}", 1000, 3000, 2000),
    ("{distribution: normal, mean: 2 kN, sd: 0.5, low: 2 kN}", 2000, 5000, 2399),  # half a normal: mean + sd √(2/π)
    ("{distribution: triangular, low: 1, mode: 1, high: 4}", 1000, 4000, 2000),
    ("{from: 1 kN, to: 3 kN}", 1000, 3000, 2000),
    ("[1 kN, 3 kN]", 1000, 3000, 2000),
]


@pytest.mark.parametrize("method", ["latin_hypercube", "sobol"])
@pytest.mark.parametrize(("values", "low", "high", "mean"), DRAWN, ids=[values for values, *_ in DRAWN])
def test_distributions_lists_and_ranges_are_drawn(
    tmp_path: Path, method: str, values: str, low: float, high: float, mean: float
) -> None:
    text = varied(values, sample=f"{{method: {method}, count: 1024, seed: 3}}")
    forces = np.asarray(study(tmp_path, text).sample.rows(0, 1024)[FORCE], dtype=float)
    assert low <= forces.min() and forces.max() <= high
    assert forces.mean() == pytest.approx(mean, rel=0.01)
    assert schema_faults(text) == []


def test_seeds_indices_and_zipped_lists_are_taken_from_the_file(tmp_path: Path) -> None:
    def sampled(sample: str, values: str = "{from: 1, to: 2}") -> tuple[int, list[Any]]:
        found = study(tmp_path, varied(values, sample=sample)).sample
        return found.count, list(found.rows(0, 2)[FORCE])

    drawn = [sampled(f"{{method: latin_hypercube, count: 9{seed}}}") for seed in ("", ", seed: 0", ", seed: 1")]
    assert drawn[0] == drawn[1] != drawn[2]
    assert sampled("{method: sobol, count: 8, indices: true}")[0] == 24
    assert sampled("{method: zip}", "[1 kN, 2]") == (2, [1000.0, 2000.0])


def test_constraints_hold_between_varied_fixed_and_referred_inputs(tmp_path: Path) -> None:
    rest = "constraints:\n" + "".join(
        f"  - {text}\n"
        for text in (
            "mechanisms.a.force * mechanisms.a.arm < '500 N*m'",  # the arm is 200 mm in the base
            "mechanisms.b.force > '1 kN'",  # refers to the varied one
            "mechanisms.a.force > 0 and mechanisms.a.speed < '101 rpm'",  # 100 rpm, by default from the press
            "mechanisms.a.force > 0 and mechanisms.b.grade == 'coarse'",
        )
    )
    found = study(tmp_path, varied("[1 kN, 2 kN, 3 kN]", rest=rest))
    held = [constraint.judged(found.sample.rows(0, 3)).holds.tolist() for constraint in found.constraints]
    assert held == [[True, True, False], [False, True, True], [True] * 3, [True] * 3]


def test_a_default_of_the_press_follows_the_varied_press(tmp_path: Path) -> None:
    rest = "constraints: [\"mechanisms.a.speed < '100 rpm'\"]\n"  # one turn for each sheet
    found = study(tmp_path, varied("[5900 1/h, 6100 1/h]", path="press.productivity", rest=rest))
    assert found.constraints[0].judged(found.sample.rows(0, 2)).holds.tolist() == [True, False]


def test_results_are_named_as_in_references_and_a_check_may_be_an_objective(tmp_path: Path) -> None:
    rest = (
        "outputs: [a.moment, b.size, a.length]\ncurves: [a.torque]\nreports: best 2\n"
        "objectives: [{minimise: b.moment}, {maximise: a.arm}, {minimise: a.checks.moment.utilisation}]\n"
    )
    base = BASE.replace("force: 2 kN,", "force: 2 kN, allowable_moment: 600 N*m,")
    found = study(tmp_path, varied("[1 kN, 2 kN]", rest=rest), base)
    assert schema_faults(found.tree.text) == []
    assert found.outputs == ("a.moment", "b.size", "a.length", "b.moment", "a.arm")
    assert found.curves == ("a.torque",)
    asked = [("b.moment", True), ("a.arm", False), ("a.checks.moment.utilisation", True)]
    assert found.objectives == tuple(Objective(*each) for each in asked)
    assert found.reports == Reports("best", 2)


REPORTS = {
    "none": Reports("none"),
    "failed": Reports("failed"),
    "all": Reports("all"),
    "~": Reports("none"),
    "[1, 0, 1]": Reports("ids", ids=(1, 0)),
}


@pytest.mark.parametrize(("given", "reports"), REPORTS.items())
def test_reports_are_asked_for(tmp_path: Path, given: str, reports: Reports) -> None:
    assert study(tmp_path, varied("[1, 2]", rest=f"reports: {given}\n")).reports == reports


# --- tables ----------------------------------------------------------------------------------------------------------

TABLE = "schema_version: 1\nbase: press.yaml\nsample: {method: table, file: machines.csv}\n"


def test_a_table_gives_the_variants_and_a_column_the_values_of_a_path(tmp_path: Path) -> None:
    saved(tmp_path, f"{FORCE} [N],{GRADE}\n1500,fine\n2500,coarse\n", "machines.csv")
    found = study(tmp_path, TABLE)
    rows = found.sample.rows(0, 2)
    assert (list(rows[FORCE]), list(rows[GRADE])) == ([1500.0, 2500.0], ["fine", "coarse"])
    assert list(found.tables) == ["machines.csv"] and len(found.tables["machines.csv"]) == 64
    saved(tmp_path, "load [kN],other\n1,x\n2,y\n", "loads.csv")
    assert list(study(tmp_path, varied("{table: loads.csv, column: load}")).sample.rows(0, 2)[FORCE]) == [1000, 2000]
    told = "loads.csv:1: the table has no column laod (did you mean 'load'?). Its columns: load, other"
    (line,) = faults(tmp_path, varied("{table: loads.csv, column: laod}"))
    assert line.removeprefix(f"{tmp_path}/") == told


TABLES = [  # the file, and what is told of it
    (f"{FORCE} [N]\n1500\n-2\n", "machines.csv:3:1: mechanisms.a.force: row 3: -0.002 kN (from the table) is out of range; allowed: > 0 kN"),
    (f"{FORCE} [N]\n" + "-2\n" * 7, "machines.csv:7:1: mechanisms.a.force: row 7: 2 more cells of this column are wrong"),
    (f"{FORCE} [mm]\n1\n", "machines.csv:1:1: mechanisms.a.force: the header's unit [mm] is of another kind"),
    ("mechanisms.a.forse\n1\n", "machines.csv:1:1: mechanisms.a.forse: the column's name 'forse' is not an input of a (did you mean 'force'?)"),
    (f"{FORCE},remark\n1,2\n", "machines.csv:1:2: remark: the column's name is not a path of an input (did you mean 'mechanisms.a.remark'?); paths"),
    (f"{GRADE}\nfine\nfin\n", "machines.csv:3:1: mechanisms.a.grade: row 3: is “fin” (did you mean 'fine'?); allowed: fine, coarse"),
    (f"{FORCE}\n", "machines.csv: the table has no rows below its header; give at least one"),
]  # fmt: skip


@pytest.mark.parametrize(("content", "message"), TABLES)
def test_what_is_wrong_with_a_table_is_told_with_its_row(tmp_path: Path, content: str, message: str) -> None:
    saved(tmp_path, content, "machines.csv")
    assert any(line.startswith(message) for line in faults(tmp_path, TABLE)), faults(tmp_path, TABLE)


# --- faults ----------------------------------------------------------------------------------------------------------

FAULTS = [  # values of mechanisms.a.force, and the whole beginning of what is told
    ("[]", "5:23: vary.mechanisms.a.force: the list is empty; give at least one value"),
    ("7", "5:23: vary.mechanisms.a.force: is 7; a list of values, a range {from: …, to: …, count: …}, a distribution"),
    ("[1 kN, -3 kN]", "5:30: vary.mechanisms.a.force.1: -3 kN is out of range; allowed: > 0 kN"),
    ("[1 kN, 12 kg]", "5:30: vary.mechanisms.a.force.1: 12 kg is a mass; a force is needed, for example"),
    ("[~]", "5:24: vary.mechanisms.a.force.0: has no value; write one, or remove the entry."),
    ("['${b.force}']", "5:24: vary.mechanisms.a.force.0: is “${b.force}”; a reference does not vary."),
    ("[true]", "5:24: vary.mechanisms.a.force.0: is true; a number or a text such as “10 kN” is needed"),
    ("{from: 1, to: }", "5:37: vary.mechanisms.a.force.to: has no value; write one, or remove the entry."),
    ("{distribution: normal, mean: , sd: 1}", "5:52: vary.mechanisms.a.force.mean: has no value; write one, or remove the entry."),
    ("{distribution: [normal], low: 1, high: 2}", "5:38: vary.mechanisms.a.force.distribution: is a list; allowed: uniform, normal, triangular"),
    ("{from: 1, count: 3}", "5:3: vary.mechanisms.a.force.to: is missing. Give it in kN (> 0 kN): Force."),
    ("{from: 1, to: 0 N, count: 3}", "5:37: vary.mechanisms.a.force.to: 0 N is out of range; allowed: > 0 kN"),
    ("{from: 1, to: 2}", "5:23: vary.mechanisms.a.force: count is missing"),
    ("{from: 1, to: 2, count: 1}", "5:23: vary.mechanisms.a.force: count: 1 gives one value, but from and to differ"),
    ("{from: 1, to: 2, count: 0}", "5:47: vary.mechanisms.a.force.count: 0 is out of range; allowed: ≥ 1, ≤ 1e+09"),
    ("{from: 1, to: 2, cuont: 3}", "5:40: vary.mechanisms.a.force.cuont: is an unknown key (did you mean 'count'?)"),
    ("{from: 1, to: 2, count: 3, spacing: wide}", "5:59: vary.mechanisms.a.force.spacing: is “wide”; allowed: linear, log"),
    ("{distribution: uniform, low: 1, high: 2}", "5:23: vary.mechanisms.a.force: a distribution has no list of values"),
    ("{distribution: normal, mean: 2, sd: -1}", "5:59: vary.mechanisms.a.force.sd: -1 kN is out of range; allowed: > 0 kN"),
    ("{distribution: gauss}", "5:38: vary.mechanisms.a.force.distribution: is “gauss”; allowed: uniform, normal, triangular"),
    ("{distribution: uniform, low: 3, high: 2}", "5:23: vary.mechanisms.a.force: low must be below high"),
    ("{distribution: triangular, low: 3 kN, mode: 2 mm, high: 4}",
     "5:67: vary.mechanisms.a.force.mode: 2 mm is a length; a force is needed"),
    ("{table: no.csv, column: x}", "5:31: vary.mechanisms.a.force.table: there is no file no.csv. The table is sought"),
    ("{table: 3}", "5:31: vary.mechanisms.a.force.table: there is no file 3."),
]  # fmt: skip


def test_known_inputs_of_a_list_say_how_its_parts_are_numbered(tmp_path: Path) -> None:
    (told,) = faults(tmp_path, varied("[1, 2]", path="mechanisms.a.parts.1.x"))
    assert "parts.0…1.length" in told


@pytest.mark.parametrize(("values", "message"), FAULTS, ids=[values for values, _ in FAULTS])
def test_wrong_values_are_told_as_in_a_config(tmp_path: Path, values: str, message: str) -> None:
    assert [told[: len(message) + 11] for told in faults(tmp_path, varied(values))] == [f"study.yaml:{message}"]


PATHS = [  # a path that cannot be varied, and what is told
    ("mechanisms.a.forc", "'forc' is not an input of a (did you mean 'force'?). Known: force, arm, grade"),
    ("mechanisms.a.parts.².length", "'parts.².length' is not an input of a"),
    ("mechanisms.a.parts.1.lenght", "'parts.1.lenght' is not an input of a (did you mean 'parts.1.length'?)"),
    ("mechanisms.c.force", "there is no mechanism 'c'. Known: a, b."),
    ("mechanisms.a", "names no input; known of a: force, arm"),
    ("mechanisms", "is not a path of an input"),
    ("a.force", "is not a path of an input; write mechanisms.a.force."),
    (
        "force",
        "is not a path of an input (did you mean 'mechanisms.a.force'?); paths are mechanisms.NAME.KEY and press.KEY.",
    ),
    ("project.title", "is in the title block, which cannot be varied"),
    ("press.produktivity", "'produktivity' is not an input of press (did you mean 'productivity'?)"),
    ("press.sheet", "is a block or a list; vary one of its values, such as press.sheet.length."),
    ("mechanisms.press.name", "there is no mechanism 'press'"),
    ("mechanisms.a.kind", "cannot be varied; a mechanism keeps its kind in all variants."),
    ("mechanisms.a.moment", "is an output of a; only inputs can be varied"),
    ("mechanisms.a.parts", "is a block or a list; vary one of its values, such as mechanisms.a.parts.0.length."),
    ("mechanisms.a.parts.2.length", "the list has 2 entries in the base, counted from 0."),
    ("mechanisms.b.parts.0.length", "the list has 0 entries in the base, counted from 0."),
    ("mechanisms.a.parts.length", "'parts.length' is not an input of a"),
    ("mechanisms.a.load", "is a curve; curves cannot be varied, only numbers, texts and choices."),
    ("mechanisms.a.force.x", "'force.x' is not an input of a (did you mean 'force'?)"),
    ("mechanisms.a..force", "'.force' is not an input of a"),
]


@pytest.mark.parametrize(("path", "words"), PATHS, ids=[path for path, _ in PATHS])
def test_a_path_that_cannot_vary_is_told_with_the_nearest_known_one(tmp_path: Path, path: str, words: str) -> None:
    told = faults(tmp_path, varied("[1 kN]", path=path))
    assert told[0].startswith(f"study.yaml:5:3: vary.{path}: {words}")
    assert len(told) == 1


WHOLE = [  # a whole study with one fault: sample, rest, what is told
    ("{method: grid, count: 3}", "", "3:24: sample.count: has no use with method grid; remove it, or choose latin_hypercube or sobol."),
    ("{method: zip, seed: 3}", "", "3:23: sample.seed: has no use with method zip"),
    ("{method: grid, indices: true}", "", "3:24: sample.indices: has no use with method grid; remove it, or choose sobol."),
    ("{method: sobol}", "", "3:1: sample.count: is missing; sobol needs the number of variants."),
    ("{method: sobol, count: 0}", "", "3:32: sample.count: 0 is out of range; allowed: ≥ 1"),
    ("{method: grid, file: x.csv}", "", "3:24: sample.file: has no use with method grid; remove it, or choose table."),
    ("{method: random}", "", "3:18: sample.method: is “random”; allowed: grid, zip, latin_hypercube, sobol, table"),
    ("{}", "", "3:1: sample.method: is missing; it is required"),
    ("{method: grid}", "constraint: []\n", "6:1: constraint: is an unknown key (did you mean 'constraints'?)."),
    ("{method: grid}", "constraints: [mechanisms.a.force < 3]\n", "6:15: constraints.0: mechanisms.a.force is a force and 3 is a pure number"),
    ("{method: grid}", "constraints: ['mechanisms.a.forc < 3']\n", "6:15: constraints.0: “mechanisms.a.forc”: 'forc' is not an input of a"),
    ("{method: grid}", "constraints: [\"mechanisms.b.width < '3 mm'\"]\n",
     "6:15: constraints.0: “mechanisms.b.width” refers to ${a.length}, which is known only after calculating; in a constraint an output is named"),
    ("{method: grid}", "constraints: [\"a.momnt < '3 N*m'\"]\n", "6:15: constraints.0: “a.momnt” is not an output (did you mean 'a.moment'?)"),
    ("{method: grid}", "constraints: [\"a.moment < '3 N'\"]\n", "6:15: constraints.0: a.moment is a moment and '3 N' is a force"),
    ("{method: grid}", "constraints: [\"mechanisms.a.width < '3 mm'\"]\n", "6:15: constraints.0: “mechanisms.a.width” has no value in the base"),
    ("{method: grid}", "outputs: [a.momnt]\n", "6:11: outputs.0: a.momnt is not an output (did you mean 'moment'?)."),
    ("{method: grid}", "outputs: [mechanisms.a.moment]\n", "6:11: outputs.0: mechanisms.a.moment: outputs are named without mechanisms."),
    ("{method: grid}", "outputs: [c.moment]\n", "6:11: outputs.0: c.moment: there is no mechanism 'c'. Known: a, b."),
    ("{method: grid}", "outputs: [a]\n", "6:11: outputs.0: a names no output; add one, as in a.arm."),
    ("{method: grid}", "outputs: [a.torque]\n", "6:11: outputs.0: a.torque is a curve; only single values are kept here, curves by the key curves."),
    ("{method: grid}", "outputs: [a.force]\n", "6:11: outputs.0: a.force is not an output"),
    ("{method: grid}", "outputs: a.moment\n", "6:10: outputs: is “a.moment”; a list is needed"),
    ("{method: grid}", "curves: [a.moment]\n", "6:10: curves.0: a.moment is a single value; name it in outputs."),
    ("{method: grid}", "curves: [a.torqe]\n", "6:10: curves.0: a.torqe is not a curve (did you mean 'torque'?)."),
    ("{method: grid}", "objectives: [{minimise: a.momnt}]\n", "6:25: objectives.0.minimise: a.momnt is not an output (did you mean 'moment'?)."),
    ("{method: grid}", "objectives: [{minimise: a.size}]\n", "6:25: objectives.0.minimise: a.size is a text or a yes/no, which cannot be minimised"),
    ("{method: grid}", "objectives: [{}]\n", "6:14: objectives.0: names no outputs; give minimise or maximise with one"),
    ("{method: grid}", "objectives: [{minimize: a.arm}]\n", "6:15: objectives.0.minimize: is an unknown key (did you mean 'minimise'?)"),
    ("{method: grid}", "reports: best\n", "6:10: reports: is “best”"),
    ("{method: grid}", "reports: fails\n", "6:10: reports: is “fails” (did you mean 'failed'?); allowed: none, failed, best N"),
    ("{method: grid}", "reports: best 3\n", "6:10: reports: best needs objectives, such as objectives: [{minimise: cylinder.mass}]."),
    ("{method: grid}", "reports: [0, 1]\n", "6:14: reports.1: there is no variant 1; variants are numbered from 0 to 0."),
    ("{method: grid}", "reports: [0, 1.5]\n", "6:14: reports.1: is 1.5; a variant has a whole number, as in [0, 17]."),
    ("{method: grid}", "reports: {a: 1}\n", "6:10: reports: is a block of keys; allowed: none, failed, best N"),
    ("{method: grid}", "reports: [-1]\n", "6:11: reports.0: there is no variant -1; variants are numbered from 0 to 0."),
]  # fmt: skip


@pytest.mark.parametrize(("sample", "rest", "message"), WHOLE, ids=[message[:60] for *_, message in WHOLE])
def test_a_wrong_study_is_told_with_its_place(tmp_path: Path, sample: str, rest: str, message: str) -> None:
    told = faults(tmp_path, varied("[1 kN]", sample=sample, rest=rest))
    assert [line[: len(message) + 11] for line in told] == [f"study.yaml:{message}"]


NO_VARY = "schema_version: 1\nbase: press.yaml\nsample: {method: grid}\n"
NO_BASE = STUDY.replace("press.yaml", "pres.yaml")
SINGLE = [  # a whole study, and the beginnings of all that is told of it
    (STUDY.replace("grid", "zip"),
     ["3:9: sample: sample: zip needs as many values of each path: mechanisms.a.force has 3, mechanisms.a.grade has 2"]),
    (NO_VARY, ["1:1: vary: is missing or empty; vary at least one path."]),
    *((f"{NO_VARY}vary: {values}\n", [f"4:7: vary: is {shown}; a block of keys is needed"])
      for values, shown in (("3", "“3”"), ("[1]", "a list"), ("x", "“x”"))),
    (varied("[1]", sample="{method: table}"), ["3:1: sample.file: ", "4:1: vary: "]),
    (varied("{from: 1, to: 2}", path=GRADE),
     ["5:23: vary.mechanisms.a.grade: is a text or a choice; give a list of values, as in [fine, coarse]."]),
    (NO_BASE, ["2:7: base: there is no file pres.yaml. The base is sought from the study's folder; check its name."]),
    (NO_BASE.replace("grid", "grid, seed: 1") + "colour: red\n", ["2:7: base: ", "3:24: sample.seed: ", "7:1: colour: "]),
    (STUDY.replace("press.yaml", "study.yaml"), ["2:7: base: is this study itself; name the configuration whose inputs it varies."]),
]  # fmt: skip


@pytest.mark.parametrize(("text", "messages"), SINGLE)
def test_all_that_is_wrong_with_a_study_is_told(tmp_path: Path, text: str, messages: list[str]) -> None:
    for line, words in zip(faults(tmp_path, text), messages, strict=True):
        assert line.startswith(f"study.yaml:{words}")


def test_problems_of_the_base_are_told_with_its_own_name(tmp_path: Path) -> None:
    told = faults(tmp_path, STUDY, BASE.replace("2 kN", "2 kg") + "  c: {kind: levr}\n")
    assert [line.split(": ")[0] for line in told] == ["study.yaml:2:7", "press.yaml:5:27", "press.yaml:7:13"]


def test_a_broken_plugin_of_the_base_is_told(tmp_path: Path) -> None:
    base = HEAD + "  a: {kind: lever, force: 1}\n  x: {kind: breaks_at_import}\n"
    with pytest.raises(PluginError, match="mechanism 'x' of plugin 'breaks_at_import': it cannot be loaded"):
        study(tmp_path, varied("[1]"), base, Discovery([BROKEN, GOOD]))


def test_keys_that_cannot_be_given_together_are_told(tmp_path: Path) -> None:
    told = faults(tmp_path, varied("[x]", path="mechanisms.b.parts.0.label"))
    assert told[0].startswith("study.yaml:5:3: vary.mechanisms.b.parts.0.label: the list has 0 entries")
    press = EXAMPLE.read_text("utf-8")
    told = faults(tmp_path, varied("[1 kN*m]", path="mechanisms.train.toothed_belt.pitch"), press, Discovery([]))
    words = "study.yaml:4:1: vary: with these paths varied, the base is wrong: mechanisms.train.toothed_belt"
    assert told[0].startswith(words)


def test_all_faults_of_a_study_are_told_at_once(tmp_path: Path) -> None:
    assert "a block of keys is needed" in faults(tmp_path, "[1, 2]\n")[0]
    text = varied(
        "[1 kg]",
        sample="{method: grid, seed: 1}",
        rest="  mechanisms.x.y: [1]\nconstraints: [1 < 2]\noutputs: [a.x]\ncolour: red\n",
    )
    told = faults(tmp_path, text)
    assert [line.split(":")[1] for line in told] == ["3", "5", "6", "7", "8", "9"]


def test_the_example_study_is_valid_and_names_what_the_press_gives() -> None:
    found = load_study(EXAMPLE.with_name("flat_cylinder_study.yaml"), Discovery([]))
    held = found.constraints[0].judged(found.sample.rows(0, 1000)).holds
    assert (found.sample.count, len(found.inputs), found.reports) == (100_000, 6, Reports("best", 3))
    assert held.mean() == pytest.approx(0.64, abs=0.05)  # the triangle of bore and segment that leaves the wall
    jsonschema.Draft202012Validator.check_schema(study_schema())
    assert schema_faults(found.tree.text) == []


@pytest.mark.parametrize(
    ("values", "sample", "rest", "where"),
    [
        ("[1]", "{method: random}", "", "sample.method"),
        ("[1]", "{method: grid, seeds: 1}", "", "sample"),
        ("[1]", "{method: sobol, count: 0}", "", "sample.count"),
        ("[1]", "{method: sobol, count: 8.5}", "", "sample.count"),
        ("[1]", "{method: sobol, count: '${a.moment}'}", "", "sample.count"),
        ("[1]", "{method: '${a.grade}'}", "", "sample.method"),
        ("{table: forces.csv, col: F}", "{method: grid}", "", f"vary.{FORCE}"),
        ("[]", "{method: grid}", "", f"vary.{FORCE}"),
        ("{from: 1}", "{method: grid}", "", f"vary.{FORCE}"),
        ("{distribution: normal, low: 1, high: 2}", "{method: grid}", "", f"vary.{FORCE}"),
        ("[1]", "{method: grid}", "colour: red\n", ""),
        ("[1]", "{method: grid}", "reports: best\n", "reports"),
        ("[1]", "{method: grid}", "objectives: [{}]\n", "objectives.0"),
        ("[1]", "{method: grid}", "outputs: [a]\n", "outputs.0"),
    ],
)
def test_an_editor_marks_what_the_program_refuses(values: str, sample: str, rest: str, where: str) -> None:
    assert schema_faults(varied(values, sample=sample, rest=rest)) == [where]


def test_a_word_in_place_of_a_number_does_not_vary(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "shaft", "-o", str(tmp_path / "base.yaml"), "--quiet"]) == 0
    vary = "vary: {mechanisms.crankshaft.rotation: [none, turning]}"
    study = saved(tmp_path, f"schema_version: 1\nbase: base.yaml\nsample: {{method: grid}}\n{vary}\n", "words.yaml")
    assert main(["validate", str(study)]) == 2
    told = capfd.readouterr().err
    place = "words.yaml:4:41: vary.mechanisms.crankshaft.rotation.0"
    assert f"{place}: is “none”, which stands in place of a number" in told
