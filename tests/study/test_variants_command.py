"""One stored variant taken for a configuration, and the command ``variants``: what it prints, and how it ends."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from diecut_report.config.plugins import Discovery
from diecut_report.errors import UserError
from diecut_report.study.analysis.variant_config import variant_config
from diecut_report.study.definition.study_file import load_study
from diecut_report.study.execution.study_run import result_columns, varied_columns
from tests.configs import EXAMPLES, saved
from tests.study.questions import variants
from tests.study.stored_study import BORE, SPEED, many, ten

STUDY = """\
schema_version: 1
base: {}
sample: {{method: latin_hypercube, count: 6}}
vary:
  press.productivity: {{from: 4800 1/h, to: 7800 1/h}}
  mechanisms.cylinder.bore_radius: {{from: 50 mm, to: 120 mm}}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return ten(tmp_path_factory.mktemp("ten") / "out")


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
