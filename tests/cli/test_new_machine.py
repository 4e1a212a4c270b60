"""A whole machine to begin with."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

import pytest

from diecut_report.cli.main import main

FOLDER = Path(import_module("diecut_report.configs").__path__[0]) / "machines"


@pytest.mark.parametrize("name", sorted(path.stem for path in FOLDER.glob("*.yaml")))
def test_a_machine_is_written_that_is_valid(name: str, tmp_path: Path) -> None:
    file = tmp_path / "press.yaml"
    assert main(["new", "--machine", name, "-o", str(file)]) == 0
    assert file.read_text("utf-8") == (FOLDER / f"{name}.yaml").read_text("utf-8")
    assert main(["validate", str(file)]) == 0


def test_a_file_that_is_there_is_not_overwritten(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "press.yaml").write_text("kept", "utf-8")
    assert main(["new", "--machine", "flat_cylinder", "-o", str(tmp_path / "press.yaml")]) == 2
    assert (tmp_path / "press.yaml").read_text("utf-8") == "kept" and "--force" in capfd.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "told"),
    [(["--machine", "flat_cylnder"], "did you mean 'flat_cylinder'"), (["--machine", "../flat_cylinder"], "Known: flat_cylinder"),
     (["clutch", "--machine", "flat_cylinder"], "Give --machine alone")],
)  # fmt: skip
def test_what_is_no_machine_is_refused(arguments: list[str], told: str, capfd: pytest.CaptureFixture[str]) -> None:
    assert main(["new", *arguments]) == 2
    assert told in capfd.readouterr().err
