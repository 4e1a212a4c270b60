"""The command compare: one table of machines on the terminal and in all formats; variants of a study, and what is wrong with some."""

from __future__ import annotations

import csv
import io
import json
import re
import shutil
from pathlib import Path

import openpyxl
import pytest
from pypdf import PdfReader

from diecut_report.cli.main import main
from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.study.machines import typed_at_parts
from tests.configs import BROKEN, EXAMPLE, GOOD, LEVER, saved
from tests.shared import once

Capture = pytest.CaptureFixture[str]
LIMITED = LEVER.replace("2 kN", "2 kN, allowable_moment: 250 N*m")
STUDY = """\
schema_version: 1
base: press.yaml
sample: {method: grid}
vary: {mechanisms.a.arm: [100 mm, 110 mm, 140 mm]}
"""


def compare(*arguments: object) -> int:
    return main(["compare", *map(str, arguments), "--plugins", str(GOOD), "--jobs", "1"])


def read(capfd: Capture) -> tuple[str, str]:
    """What was shown, with plain spaces, and what was reported."""
    out, err = capfd.readouterr()
    return out.replace("\N{NO-BREAK SPACE}", " "), err


@pytest.fixture
def two(tmp_path: Path) -> list[Path]:
    """Two machines of the same name in two folders."""
    for name, text in (("old", LIMITED), ("new", LIMITED.replace("2 kN", "3 kN"))):
        (tmp_path / name).mkdir()
        saved(tmp_path / name, text, "press.yaml")
    return [tmp_path / "old" / "press.yaml", tmp_path / "new" / "press.yaml"]


@pytest.fixture
def study(tmp_path: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The results of a study of three variants, of which one fails."""

    def make(folder: Path) -> None:
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr("diecut_report.study.command.summarise", lambda *_, **__: None)
            saved(folder, LIMITED)
            file = saved(folder, STUDY, "study.yaml")
            assert (
                main(["batch", str(file), "-o", str(folder / "out"), "--plugins", str(GOOD), "--jobs", "1", "--quiet"])
                == 1
            )

    return Path(shutil.copytree(once(tmp_path_factory, "compared_study", make) / "out", tmp_path / "study"))


def test_the_table_has_verdicts_results_and_own_changes(two: list[Path], capfd: Capture) -> None:
    assert compare(*two, "--show", "a.moment,rate", "--units", "kN*mm") == 1
    out, err = read(capfd)
    lines = [re.split(r"\s{2,}", line.strip()) for line in out.splitlines() if line.strip()]
    assert lines[0] == ["quantity", "unit", "old/press", "new/press"]
    assert ["Verdict", "pass", "fail"] in lines and ["Governing check", "80.0 %", "120.0 %"] in lines
    assert ["a.moment", "kN·mm", "200", "300"] in lines and ["a.force", "kN", "2", "3"] in lines
    assert err.endswith("2 machines: 1 pass, 1 fail.\n")


def test_all_formats_hold_numbers(two: list[Path], tmp_path: Path) -> None:
    out = tmp_path / "out"
    assert compare(*two, "-o", out, "--quiet") == 1
    assert sorted(path.suffix for path in out.iterdir()) == [".csv", ".html", ".json", ".pdf", ".xlsx"]
    data = json.loads((out / "comparison.json").read_text("utf-8"))
    assert data["own_changes"] == [
        {"path": "a.force", "description": "Force", "unit": "kN", "machines": {"old/press": 2.0, "new/press": 3.0}}
    ]
    results = {row["path"]: list(row["machines"].values()) for row in data["results"]}
    assert results == {"rate": [6000, 6000], "torque_max": [200, 300], "strength": [0.8, 1.2]}
    rows = {row[0]: row[1:] for row in csv.reader(io.StringIO((out / "comparison.csv").read_text("utf-8")))}
    assert rows["a.force"] == ["Force", "kN", "2.0", "3.0"] and rows["rate"][1:] == ["1/h", "6000.0", "6000.0"]


def test_of_machines_of_parts_what_is_typed_at_a_part_differs() -> None:
    """Not the inputs of the calculations that follow from it."""
    file = EXAMPLE.parent / "machines" / "flat_cylinder.yaml"
    typed = {row.path: row for row in typed_at_parts(load_config(file, Discovery([])))}
    width, teeth, name = (
        typed[path] for path in ("meshes.main_drive.width", "meshes.main_drive.teeth_2", "shafts.main.parts.b.bearing")
    )
    assert (width.value, width.display.unit, teeth.value, name.value) == (pytest.approx(0.05), "mm", 87, "b")
    assert typed["shafts.main.sections.2.diameter"].value == pytest.approx(0.06)
    assert typed["machine.frame.main.0"].value == pytest.approx(0.18) and "meshes.main_drive.teeth" not in typed


@pytest.mark.nightly
def test_what_follows_from_a_part_is_no_difference(tmp_path: Path) -> None:
    text = (EXAMPLE.parent / "machines" / "flat_cylinder.yaml").read_text("utf-8")
    assert text.count("teeth: 18/87, module: 4, width: 50") == 1
    other = text.replace("module: 4, width: 50", "module: 4, width: 48")
    two = [saved(tmp_path, text, "a.yaml"), saved(tmp_path, other, "b.yaml")]
    compare(*two, "-o", tmp_path / "out", "--format", "json", "--quiet")
    data = json.loads((tmp_path / "out" / "comparison.json").read_text("utf-8"))
    assert {row["path"]: [*row["machines"].values()] for row in data["own_changes"]} == {
        "meshes.main_drive.width": [50, 48]
    }


def test_the_workbook_is_for_calculating(two: list[Path], tmp_path: Path) -> None:
    assert compare(*two, "-o", tmp_path, "--format", "xlsx", "--quiet") == 1
    book = openpyxl.load_workbook(tmp_path / "comparison.xlsx")
    sheet = book["comparison"]
    rows = list(sheet.iter_rows(values_only=True))
    old, new = (dict(zip(rows[0], row, strict=True)) for row in rows[1:])
    torque = "Greatest torque of all shafts [N·m]"
    assert (old[torque], new[torque]) == (200, 300) and (old["Checks that fail"], new["Checks that fail"]) == (0, 1)
    assert [old["Governing check [%]"], new["Governing check [%]"]] == pytest.approx([0.8, 1.2])
    assert old["Governing check: which"] == "a.moment"
    assert sheet.freeze_panes == "B2" and sheet.auto_filter.ref == f"A1:{sheet.cell(3, sheet.max_column).coordinate}"
    (chart,) = sheet._charts
    assert [each.tx.strRef.f for each in chart.series] == ["'comparison'!C1", "'comparison'!L1"]
    assert book["checks"]["C2"].number_format == "0.0%"
    assert sheet.column_dimensions["A"].width > len("old/press")


@pytest.mark.nightly
def test_a_landscape_sheet_holds_twelve_machines(tmp_path: Path) -> None:
    for number in range(12):
        saved(tmp_path, LIMITED.replace("2 kN", f"{1 + number / 100} kN"), f"a_rather_long_name_{number}.yaml")
    assert compare(tmp_path, "-o", tmp_path / "out", "--format", "pdf", "--quiet") == 0
    (sheet,) = PdfReader(tmp_path / "out" / "comparison.pdf").pages
    assert float(sheet.mediabox.width) > float(sheet.mediabox.height)
    text = "".join(sheet.extract_text().split())
    assert all(f"a_rather_long_name_{number}" in text for number in range(12))


def test_a_bad_file_is_reported_beside_the_others(two: list[Path], tmp_path: Path, capfd: Capture) -> None:
    bad = saved(tmp_path, LEVER.replace("2 kN", "2 kg"), "bad.yaml")
    assert compare(*two, bad, tmp_path / "none.yaml", "-o", tmp_path / "out", "--format", "html") == 2
    out, err = read(capfd)
    assert "bad file" in out and "120.0 %" in out
    assert "bad.yaml:5:27: mechanisms.a.force: 2 kg is a mass" in err and "none.yaml: There is no such file" in err
    page = (tmp_path / "out" / "comparison.html").read_text("utf-8")
    assert "2 kg is a mass" in page and "120.0" in page


def test_a_broken_plugin_ends_with_3(two: list[Path], tmp_path: Path, capfd: Capture) -> None:
    broken = saved(tmp_path, LEVER + "  x: {kind: breaks_in_calculation}\n", "broken.yaml")
    assert compare(two[0], broken, "--plugins", BROKEN) == 3
    assert "plugin 'breaks_in_calculation'" in capfd.readouterr().err


def test_variants_of_a_study_are_compared(study: Path, capfd: Capture) -> None:
    assert compare(f"{study}#0", f"{study}#2", "--show", "a.moment") == 1
    lines = [re.split(r"\s{2,}", line.strip()) for line in capfd.readouterr().out.splitlines() if line.strip()]
    assert lines[0] == ["quantity", "unit", "study#0", "study#2"]
    assert ["a.moment", "N·m", "200", "280"] in lines and ["a.arm", "mm", "100", "140"] in lines


def test_a_folder_of_a_study_stands_for_its_variants(
    study: Path, capfd: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert compare(study) == 1
    assert capfd.readouterr().out.splitlines()[1].split() == ["quantity", "unit", "study#0", "study#1", "study#2"]
    monkeypatch.setattr("diecut_report.study.machines.MAX_VARIANTS", 2)
    assert compare(study) == 2
    assert f"This study has more than 2 variants. Name some: {study}#3 {study}#17;" in capfd.readouterr().err


@pytest.mark.parametrize("number", ["99", "²", "9" * 30, "-1", ""])
def test_a_variant_that_is_not_there_hides_no_other(study: Path, number: str, capfd: Capture) -> None:
    assert compare(f"{study}#{number}", f"{study}#0") == 2
    out, err = read(capfd)
    assert "80.0 %" in out
    assert ("There is no variant 99 here" if number == "99" else "There is no such file") in err


def test_a_damaged_study_hides_no_other(study: Path, two: list[Path], capfd: Capture) -> None:
    state = study / "study.json"
    state.write_text(state.read_text("utf-8")[:-20], "utf-8")
    assert compare(study, f"{study}#1", two[0]) == 2
    out, err = read(capfd)
    assert "80.0 %" in out and err.count("The state of the study cannot be read") == 2


def test_an_empty_list_is_refused(two: list[Path], capfd: Capture) -> None:
    assert compare(*two, "--show", ",") == 2
    assert "nothing is named" in capfd.readouterr().err


def test_the_comparison_overwrites_no_configuration(tmp_path: Path, capfd: Capture) -> None:
    file = saved(tmp_path, LIMITED, "comparison.json")
    assert compare(file, "-o", tmp_path, "--format", "json") == 2
    assert file.read_text("utf-8") == LIMITED and "would be overwritten" in capfd.readouterr().err


def test_the_page_is_dark_where_a_reader_asks_for_it_and_runs_no_script(two: list[Path], tmp_path: Path) -> None:
    compare(*two, "-o", tmp_path, "--format", "html", "--quiet")
    page = (tmp_path / "comparison.html").read_text("utf-8")
    assert "prefers-color-scheme: dark" in page and "<script" not in page
