"""A variant of a study taken for a configuration of its own: the base's text with that variant's values, and nothing else changed."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from diecut_report.config import yaml
from diecut_report.config.plugins import Discovery
from diecut_report.quantities.units import parse_quantity
from diecut_report.study.analysis.answers import variants
from diecut_report.study.analysis.variant_config import taken_config
from tests.configs import GOOD, HEAD, saved
from tests.study.stored_study import BORE, SPEED, ten


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return ten(tmp_path_factory.mktemp("taken") / "out")


def test_its_values_are_read_back_as_those_that_were_calculated_and_all_else_stays(folder: Path) -> None:
    text = taken_config(folder, 4, Discovery([])).content.decode()
    (row,) = json.loads("".join(variants(folder, "variant = 4", format="json")))["variants"]
    data = yaml.parse(text, "taken").data["mechanisms"]
    assert parse_quantity(data["cylinder"]["bore_radius"], "mm") == row[BORE]
    assert parse_quantity(data["drive"]["crank_speed"], "rpm") == row[SPEED]  # a reference stood there
    base = (folder / "base.yaml").read_text("utf-8").splitlines()
    heading, *lines = text.splitlines()
    changed = [(old, new) for old, new in zip(base, lines, strict=True) if old != new]
    assert heading == "# Variant 4 of study.yaml" and len(changed) == 2
    assert all(old.partition("#")[2] == new.partition("#")[2] for old, new in changed)


def test_its_values_may_be_rounded(folder: Path) -> None:
    text = taken_config(folder, 4, Discovery([]), digits=2).content.decode()
    data = yaml.parse(text, "taken").data["mechanisms"]
    assert (data["cylinder"]["bore_radius"], data["drive"]["crank_speed"]) == ("65 mm", "50 rpm")


def test_the_command_writes_it_and_tells_how_the_study_judged_it(
    folder: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    assert main(["take", f"{folder}#4", "-o", str(tmp_path / "mine.yaml")]) == 0
    assert "in the study: fail, governed by drive.checks.play" in capfd.readouterr().err
    assert (tmp_path / "mine.yaml").read_bytes() == taken_config(folder, 4, Discovery([])).content
    assert main(["take", f"{folder}#4", "-o", "-"]) == 0
    assert capfd.readouterr().out.encode() == (tmp_path / "mine.yaml").read_bytes()


@pytest.mark.parametrize(
    ("number", "words"), [("#99", "no variant 99"), ("#9", "leaves no wall"), ("", "names no variant")]
)
def test_what_cannot_be_taken_is_told(
    folder: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str], number: str, words: str
) -> None:
    assert main(["take", f"{folder}{number}", "-o", str(tmp_path / "never.yaml")]) == 2
    assert words in capfd.readouterr().err and not (tmp_path / "never.yaml").exists()


@pytest.mark.parametrize(
    "name", ["base.yaml", "study.json", "study.yaml", "variants/part-00000.parquet", "variants/x.csv"]
)
def test_what_the_study_has_stored_is_not_written_over(
    folder: Path, capfd: pytest.CaptureFixture[str], name: str
) -> None:
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    assert main(["take", f"{folder}#4", "-o", str(folder / name)]) == 2
    assert main(["variants", str(folder), "--format", "csv", "-o", str(folder / name)]) == 2
    told = capfd.readouterr().err
    assert told.count("Choose another place with -o.") == 2
    assert {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()} == before


def test_what_the_study_was_made_of_is_not_written_over(
    folder: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    base = tmp_path / "my_press.yaml"
    base.write_bytes((folder / "base.yaml").read_bytes())
    assert main(["take", f"{folder}#4", "-o", str(base)]) == 2
    assert "of which the study was made; it would be written over" in capfd.readouterr().err
    assert base.read_bytes() == (folder / "base.yaml").read_bytes()


@pytest.mark.usefixtures("without_summary")
def test_a_stored_variant_is_solved_and_written_with_what_was_found(tmp_path: Path) -> None:
    press = HEAD + "  a: {kind: lever, force: 2 kN, arm: 100 mm, allowable_moment: 250 N*m}  # the lever\n"
    saved(tmp_path, press)
    study = saved(
        tmp_path,
        "schema_version: 1\nbase: press.yaml\nsample: {method: grid}\nvary: {mechanisms.a.force: [1 kN, 3 kN]}\n",
        "study.yaml",
    )
    plugins = ("--plugins", str(GOOD))
    assert main(["batch", str(study), "-o", str(tmp_path / "out"), *plugins]) == 1
    target, asked = tmp_path / "solved.yaml", ("--vary", "a.arm", "--for", "a.moment = 240 N*m")
    assert main(["solve", f"{tmp_path / 'out'}#1", *asked, "-o", str(target), *plugins]) == 0
    found = yaml.load(target)
    assert found.data["mechanisms"]["a"] | {"force": "3 kN", "arm": "80 mm"} == found.data["mechanisms"]["a"]
    assert "those that were calculated" not in found.text
    assert main(["advise", f"{tmp_path / 'out'}#1", "-o", str(tmp_path / "mended.yaml"), *plugins]) == 0
