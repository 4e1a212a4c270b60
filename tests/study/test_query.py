"""Questions to stored variants: conditions with units, order, formats, refusals in words; what the command prints, and how it ends."""

from __future__ import annotations

import csv
import io
import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from openpyxl import load_workbook

from diecut_report.cli import study
from diecut_report.cli.main import main
from diecut_report.config.plugins import Discovery
from diecut_report.errors import UserError
from diecut_report.study.analysis import answers
from diecut_report.study.analysis.answers import condition
from diecut_report.study.analysis.variant_config import variant_config
from diecut_report.study.analysis.variants import StoredColumn as Read
from diecut_report.study.definition.study_file import load_study
from diecut_report.study.execution.study_run import result_columns, varied_columns
from tests.configs import EXAMPLES, saved
from tests.study.stored_study import BORE, SPEED, calculated, many, ten, variants


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return ten(tmp_path_factory.mktemp("a[1] 'study'") / "out")


def ids(folder: Path, where: str | None = None, sort: str | None = None, top: int | None = None) -> list[int]:
    text = "".join(variants(folder, where, sort, top, "json"))
    return [row["variant"] for row in json.loads(text)["variants"]]


@pytest.mark.parametrize(
    ("where", "expected"),
    [
        (None, list(range(10))),
        (f"{SPEED} < '41 rpm' and {BORE} > '60 mm'", [3, 6, 7]),
        (f"{SPEED} < '41 rpm' and {BORE} between '60 mm' and '7 cm'", [3, 6]),
        ("status = 'pass'", [0, 3, 6]),
        ("status in ('error', 'pass') and not variant = 3", [0, 6, 9]),
        ("governing like '%wall' or error is not null", [7, 9]),
        ("cylinder.checks.wall.utilisation is null", [7, 9]),
        ("drive.slip", [1, 2, 5]),
        ('"drive.slip" and variant <> 5', [1, 2]),
        (f"{BORE} + '1 cm' > \"0.1 m\"", [7, 9]),
        (" * ".join(["variant"] * 25) + " > 1", list(range(2, 10))),  # more than a whole number of 64 bits holds
        ("variant ** variant > 3 and variant < 4", [2, 3]),
        ("status = 'x'' OR 1=1 --'", []),  # a text that looks like SQL is a text
        ("cylinder.mass > 110 and cylinder.mass < '130 kg'", [3, 4, 5]),
    ],
)
def test_a_condition_picks_the_variants_that_fulfil_it(folder: Path, where: str | None, expected: list[int]) -> None:
    assert ids(folder, where) == expected


def test_the_order_is_by_the_named_columns_and_missing_values_stand_last(folder: Path) -> None:
    rows = json.loads("".join(variants(folder, format="json")))["variants"]
    power = calculated(*(np.array([row[name] for row in rows]) for name in (SPEED, BORE)), ["harmonic"] * 10)
    rising = np.argsort(power["drive.power_peak"])[:9].tolist()  # the last variant has none
    assert ids(folder, sort="drive.power_peak") == [*rising, 9]
    assert ids(folder, sort="-drive.power_peak") == [*rising[::-1], 9]
    assert ids(folder, sort="-drive.power_peak", top=2) == rising[:-3:-1]
    assert ids(folder, sort=f"-{BORE}, variant", top=4) == [9, 7, 8, 6]


@pytest.mark.parametrize(
    ("where", "sort", "words"),
    [
        ("drive.crank_torqe_peak < 3", None, "did you mean 'drive.crank_torque_peak'?"),
        ("cylinder.radius < 105", None, "needs mm, for example '105 mm'"),
        ("status = pass", None, "'pass' is not a column"),
        (None, "-drive.pwr", "'drive.pwr' is not a column"),
    ],
)
def test_what_cannot_be_asked_is_told_in_words(folder: Path, where: str | None, sort: str | None, words: str) -> None:
    with pytest.raises(UserError) as caught:
        ids(folder, where, sort)
    assert words in str(caught.value)


COLUMNS = {"a.b": Read("a.b", "float", "m", "mm"), "status": Read("status", "text")}


PIECES = ["a.b", "status", "<", "'1 mm'", "'x'", "(", ")", "and", "not", "-", "2", "in", ",", "sqrt"]


@given(st.text(max_size=40) | st.lists(st.sampled_from(PIECES)).map(" ".join))
def test_any_text_is_a_condition_or_a_fault_in_words(text: str) -> None:
    try:
        found, _ = condition(text, COLUMNS)
    except UserError as error:
        assert str(error)
        return
    outside = found.text.replace('"a.b"', "").replace('"status"', "").replace("'NaN'", "")
    assert "'" not in outside and '"' not in outside and outside.count("?") == len(found.parameters)


def test_csv_and_json_have_si_numbers_units_and_nulls(folder: Path) -> None:
    rows = list(csv.DictReader(io.StringIO("".join(variants(folder, format="csv")))))
    assert len(rows) == 10
    assert float(rows[3][f"{BORE} [m]"]) == 0.065
    assert float(rows[3][f"{SPEED} [rad/s]"]) == 2 * math.pi / 60 * 40
    assert (rows[9]["status"], rows[9]["cylinder.mass [kg]"], rows[1]["drive.slip"]) == ("error", "", "true")
    data = json.loads("".join(variants(folder, "variant = 9", format="json")))
    assert data["units"]["drive.power_peak"] == "W"
    assert data["variants"][0]["drive.power_peak"] is None
    assert "leaves no wall" in data["variants"][0]["error"]


def test_the_table_is_in_the_units_that_people_read_and_says_what_it_leaves_out(folder: Path, tmp_path: Path) -> None:
    text = "".join(variants(folder, "variant = 3", width=160))
    row = next(line for line in text.splitlines() if line.split()[:1] == ["3"])
    assert [row.split()[index] for index in (0, 1, -2, -1)] == ["3", "pass", "40", "65"]
    assert " r/min" in text and " mm" in text
    assert "Matching the condition: 1 of 10 variants." in text
    text = "".join(variants(many(tmp_path / "out", 300), width=160))
    assert "300 of 300 variants; 20 are shown" in text


def test_chosen_columns_stand_in_the_units_and_signs_of_a_firms_spreadsheet(
    folder: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    options = ["--columns", f"{BORE},drive.slip", "--format", "csv", "--units", "display"]
    signs = ["--separator", "semicolon", "--decimal", "comma"]
    assert main(["variants", str(folder), "--pick", "3,1", *options, *signs]) == 0
    assert capfd.readouterr().out == f"variant;{BORE} [mm];drive.slip\n1;55,0;true\n3;65,0;false\n"
    assert main(["variants", str(folder), "--pick", "3", *options, "--separator", "tab"]) == 0
    assert capfd.readouterr().out.splitlines()[1] == "3\t65.0\tfalse"


def test_variants_stand_side_by_side(folder: Path, capfd: pytest.CaptureFixture[str]) -> None:
    compared = ["variants", str(folder), "--pick", "1,3", "--transpose"]
    assert main(compared) == 0
    text = capfd.readouterr().out
    heads, _, *lines = text.strip("\n").splitlines()
    assert heads.split() == ["quantity", "unit", "1", "3"]
    assert [BORE, "mm", "55", "65"] in [line.split() for line in lines]
    assert main([*compared, "--format", "csv"]) == 0
    rows = {name: values for name, *values in csv.reader(io.StringIO(capfd.readouterr().out))}
    same = [name for name, (_, one, other) in rows.items() if one == other]
    assert rows[BORE] == ["m", "0.055", "0.065"] and f"{len(same)} quantities that are equal in all" in text
    assert not any(line.split()[:1] == [name] for name in same for line in lines)


def test_a_workbook_holds_the_chosen_columns(folder: Path, tmp_path: Path) -> None:
    file = tmp_path / "chosen.xlsx"
    asked = ["variants", str(folder), "--where", "status = 'pass'", "--columns", f"{BORE},status", "--format", "xlsx"]
    assert main([*asked, "--units", "display", "-o", str(file)]) == 0
    rows = list(load_workbook(file)["variants"].iter_rows(values_only=True))
    assert rows[0] == ("variant", f"{BORE} [mm]", "status")
    assert [row[0] for row in rows[1:]] == ids(folder, "status = 'pass'") and rows[2] == (3, 65, "pass")


@pytest.mark.parametrize(
    ("options", "words"),
    [(["--pick", "3,33"], "no variant 33 here"), (["--pick", "3,x"], "'x' is not the number"),
     (["--units", "si"], "--units does not apply to table"), (["--format", "xlsx"], "-o FILE"),
     (["--format", "csv", "--decimal", "comma"], "--separator semicolon"),
     (["--format", "json", "--transpose"], "no rows to transpose"), (["--columns", "cylinder.mas"], "cylinder.mass")],
)  # fmt: skip
def test_wrong_options_end_with_words(
    folder: Path, capfd: pytest.CaptureFixture[str], options: list[str], words: str
) -> None:
    assert main(["variants", str(folder), *options]) == 2
    assert words in capfd.readouterr().err


def test_the_command_offers_what_answers_know() -> None:
    assert (tuple(answers.SEPARATORS), tuple(answers.DECIMALS)) == (study.SEPARATORS, study.DECIMALS)


def test_asking_writes_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    out = ten(tmp_path / "out")
    monkeypatch.chdir(tmp_path)
    before = {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*")}
    list(variants(out, "status = 'pass'", "-drive.power_peak"))
    assert before == {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*")}


STUDY = """\
schema_version: 1
base: {}
sample: {{method: latin_hypercube, count: 6}}
vary:
  press.productivity: {{from: 4800 1/h, to: 7800 1/h}}
  mechanisms.cylinder.bore_radius: {{from: 50 mm, to: 120 mm}}
"""


def test_a_variant_that_cannot_exist_says_why(folder: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    reason = "bore_radius 0.104 m leaves no wall"
    with pytest.raises(UserError, match=f"Variant 9 cannot be calculated: {reason}"):
        variant_config(folder, 9, Discovery([]), "broken.yaml")
    assert main(["report", f"{folder}#9", "-o", str(tmp_path / "never")]) == 2
    assert reason in capfd.readouterr().err
    assert not (tmp_path / "never").exists()
    assert "leaves no wall" in "".join(variants(folder, "status = 'error'"))
    assert "leaves no wall" not in "".join(variants(folder, "status = 'pass'"))


def test_a_table_shows_all_that_is_varied_whatever_else_is_asked(folder: Path) -> None:
    outputs = ("drive.crank_torque_peak", "drive.power_peak", "drive.idle_ratio", "cylinder.radius")
    text = "".join(variants(folder, " and ".join(f"{name} > '0'" for name in outputs), "-cylinder.mass", width=2000))
    shown = "".join(line[3 * len("variant") :].replace(" ", "") for line in text.split("───")[0].splitlines())
    assert all(path.rpartition(".")[2].split("_")[-1] in shown for path in (SPEED, BORE))


def test_display_units_and_titles_are_those_that_the_mechanisms_declare(tmp_path: Path) -> None:
    base = next(path for path in EXAMPLES if path.name == "flat_cylinder_mechanisms.yaml")
    study = load_study(saved(tmp_path, STUDY.format(base), "study.yaml"), Discovery([]))
    about = {column.name: column for column in (*varied_columns(study), *result_columns(study))}
    bore = about["mechanisms.cylinder.bore_radius"]
    assert (bore.unit, bore.display, bore.symbol) == ("m", "mm", "R_b")
    assert about["press.productivity"].display == "1/h"
    assert (about["drive.velocity_max"].unit, about["drive.velocity_max"].display) == ("m/s", "")
    assert "no. 2" in about["drive.flank_change_2"].description


def test_the_command_prints_the_answer(folder: Path, capfd: pytest.CaptureFixture[str]) -> None:
    asked = ["variants", str(folder), "--where"]
    assert main([*asked, "status = 'pass'", "--sort", "-cylinder.mass", "--format", "csv"]) == 0
    out, err = capfd.readouterr()
    assert [line.split(",")[0] for line in out.splitlines()] == ["variant", "0", "3", "6"] and err == ""
    assert main([*asked, "status = 'pass"]) == 2
    out, err = capfd.readouterr()
    assert out == "" and "The condition" in err


def test_a_reader_that_goes_away_ends_the_answer_quietly(tmp_path: Path) -> None:
    folder = many(tmp_path / "out", 6000)  # more than a pipe holds
    command = [sys.executable, "-m", "diecut_report", "variants", str(folder), "--format", "csv"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as asked:
        assert asked.stdout is not None and asked.stderr is not None
        assert asked.stdout.readline().startswith("variant,")
        asked.stdout.close()
        assert asked.stderr.read() == ""
    assert asked.returncode == 0
