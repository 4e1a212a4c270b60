"""One stored variant taken for a configuration, and the command ``variants``: what it prints, and how it ends."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from diecut_report.cli.main import main
from diecut_report.config.plugins import Discovery
from diecut_report.errors import UserError
from diecut_report.results.mechanism import worst
from diecut_report.study.analysis.variant_config import variant_config
from diecut_report.study.definition.study_file import load_study
from diecut_report.study.execution.study_run import Where, run_study
from tests.configs import EXAMPLES
from tests.shared import once
from tests.study.questions import variants
from tests.study.stored_study import many, ten

PRESS = "flat_cylinder_mechanisms.yaml"
STUDY = """\
schema_version: 1
base: flat_cylinder_mechanisms.yaml
sample: {method: latin_hypercube, count: 6, seed: 4}
vary:
  press.productivity: {from: 4800 1/h, to: 7800 1/h}
  press.sheet.thickness: {distribution: normal, mean: 0.6 mm, sd: 0.05 mm}
  mechanisms.cylinder.bore_radius: {from: 50 mm, to: 120 mm}
  mechanisms.drive.cutting_arc_fraction: {from: 0.5, to: 0.9}
  mechanisms.train.gears.0.driver_teeth: [19, 20, 21]
  mechanisms.train.motor_speed: [960 rpm, 1450 rpm]
  mechanisms.feeder.motion_law: [cycloidal, modified_sine]
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A few machines of the press, some of which cannot exist, as a run stores them."""

    def make(place: Path) -> None:
        base = next(path for path in EXAMPLES if path.name == PRESS)
        (place / PRESS).write_bytes(base.read_bytes())
        (place / "study.yaml").write_text(STUDY, encoding="utf-8")
        study = load_study(place / "study.yaml", Discovery([]))
        run_study(study, place / "out", Where(1), resume=False, tell=lambda _: None)

    return once(tmp_path_factory, "study_of_the_press", make) / "out"


def rows(folder: Path) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = json.loads("".join(variants(folder, format="json")))["variants"]
    return found


def test_a_variant_calculated_alone_gives_the_row_that_is_stored(run: Path, capfd: pytest.CaptureFixture[str]) -> None:
    calculated = [row for row in rows(run) if row["status"] != "error"]
    assert len(calculated) >= 2
    for row in calculated[:1]:
        code = main(["calc", f"{run}#{row['variant']}", "--quiet"])
        results = json.loads(capfd.readouterr().out)
        assert code == (1 if results["status"] == "fail" else 0)
        del results["mechanisms"][
            "press_consistency"
        ]  # runs by itself in a report; a study calculates what its base names
        assert worst(mechanism["status"] for mechanism in results["mechanisms"].values()) == row["status"]
        assert _differences(row, results) == []


def _differences(row: dict[str, Any], results: dict[str, Any]) -> list[str]:
    """The outputs and checks of the results that are not those of the row."""
    found = []
    for name, mechanism in results["mechanisms"].items():
        for key, output in mechanism["outputs"].items():
            share = 1e-6 if output["unit"] == "rad" else 1e-12  # places of extremes
            if not key.endswith("_residual") and not _same(row[f"{name}.{key}"], output["value"], share):
                found.append(f"{name}.{key}: {row[f'{name}.{key}']} and {output['value']}")
        for check in (each for each in mechanism["checks"] if each["class"] != "numerical"):
            if row[f"{name}.checks.{check['id']}.status"] != check["status"]:
                found.append(f"{name}.{check['id']}")
    return found


def _same(one: Any, two: Any, share: float) -> bool:
    is_number = isinstance(one, float) and isinstance(two, int | float)
    return math.isclose(one, two, rel_tol=share) if is_number else bool(one == two)


def test_a_variant_that_cannot_exist_says_why(run: Path, capfd: pytest.CaptureFixture[str]) -> None:
    broken = next(row for row in rows(run) if row["status"] == "error")
    with pytest.raises(UserError) as caught:
        variant_config(run, broken["variant"], Discovery([]), "broken.yaml")
    assert f"Variant {broken['variant']} cannot be calculated: {broken['error']}" in str(caught.value)
    assert main(["report", f"{run}#{broken['variant']}", "-o", str(run / "never")]) == 2
    assert broken["error"] in capfd.readouterr().err
    assert not (run / "never").exists()


def test_the_table_gives_the_reasons_where_variants_are_in_error(tmp_path: Path) -> None:
    folder = ten(tmp_path / "out")
    assert "leaves no wall" in "".join(variants(folder, "status = 'error'"))
    assert "leaves no wall" not in "".join(variants(folder, "status = 'pass'"))


def test_a_table_shows_all_that_is_varied_whatever_else_is_asked(run: Path) -> None:
    outputs = [f"drive.{name}" for name in ("crank_torque_peak", "velocity_max", "power_peak", "crank_torque_mean")]
    text = "".join(variants(run, " and ".join(f"{name} > 0" for name in outputs), "-cylinder.mass", width=2000))
    shown = "".join(line[3 * len("variant") :].replace(" ", "") for line in text.split("───")[0].splitlines())
    study = json.loads((run / "study.json").read_text("utf-8"))
    assert len(study["varied"]) == 7
    assert all(path.rpartition(".")[2].split("_")[-1] in shown for path in study["varied"])


def test_display_units_and_titles_are_those_that_the_mechanisms_declare(run: Path) -> None:
    study = json.loads((run / "study.json").read_text("utf-8"))
    about = (
        {entry["name"]: entry for entry in study["columns"]} if isinstance(study["columns"], list) else study["columns"]
    )
    bore = about["mechanisms.cylinder.bore_radius"]
    assert (bore["unit"], bore["display"], bore["symbol"]) == ("m", "mm", "R_b")
    assert about["press.productivity"]["display"] == "1/h"
    assert about["drive.velocity_max"]["unit"] == "m/s" and "display" not in about["drive.velocity_max"]
    assert "no. 2" in about["drive.flank_change_2"]["description"]


def test_the_command_prints_the_answer(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    folder = ten(tmp_path / "out")
    assert (
        main(["variants", str(folder), "--where", "status = 'pass'", "--sort", "-cylinder.mass", "--format", "csv"])
        == 0
    )
    out, err = capfd.readouterr()
    assert [line.split(",")[0] for line in out.splitlines()] == ["variant", "0", "3", "6"] and err == ""
    assert main(["variants", str(folder), "--where", "status = 'pass"]) == 2
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
