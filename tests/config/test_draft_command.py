"""The command new: lists, writes, refuses; and the way of a designer who begins with it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import yaml

from diecut_report.cli.main import main
from tests.configs import GOOD

Capture = pytest.CaptureFixture[str]


def test_without_a_kind_the_kinds_are_listed_a_line_each(capfd: Capture) -> None:
    assert main(["new"]) == 0
    lines = capfd.readouterr().out.splitlines()
    assert "clutch              Friction clutch with a wedge-spread shoe ring" in lines
    assert len(lines) == 18
    assert main(["new", "--language", "uk"]) == 0
    assert "clutch              Фрикційна муфта" in capfd.readouterr().out


def test_without_a_file_it_goes_to_standard_output(capfd: Capture) -> None:
    assert main(["new", "clutch:main"]) == 0
    out, err = capfd.readouterr()
    assert list(yaml.safe_load(out)["mechanisms"]) == ["main"] and err == ""


def test_a_file_is_written_and_told_with_what_was_added(tmp_path: Path, capfd: Capture) -> None:
    file = tmp_path / "new folder" / "my_press.yaml"
    assert main(["new", "cyclogram", "-o", str(file)]) == 0
    out, err = capfd.readouterr()
    assert out == "" and err.splitlines() == [
        f"written: {file}",
        "added: drive (cylinder_drive), which timing cannot be without",
        "added: cross (geneva_transport), which timing cannot be without",
    ]
    assert "#   diecut-report report my_press.yaml -o build" in file.read_text("utf-8").splitlines()


def test_a_file_that_is_there_is_written_over_by_force_alone(tmp_path: Path, capfd: Capture) -> None:
    file = tmp_path / "press.yaml"
    file.write_text("mine\n", "utf-8")
    assert main(["new", "damper", "-o", str(file)]) == 2
    assert (
        capfd.readouterr().err
        == f"{file}: This is there already; it is not written over. Choose another name, or give --force.\n"
    )
    assert file.read_text("utf-8") == "mine\n"
    assert main(["new", "damper", "-o", str(file), "--force", "--quiet"]) == 0
    assert "damper" in file.read_text("utf-8") and capfd.readouterr().err == ""
    assert main(["new", "damper", "-o", str(tmp_path), "--force"]) == 2
    assert [each.name for each in tmp_path.iterdir()] == ["press.yaml"]


def test_all_that_is_wrong_is_told_at_once_and_nothing_is_written(tmp_path: Path, capfd: Capture) -> None:
    file = tmp_path / "press.yaml"
    assert main(["new", "cluch", "damper:1x", "clutch:press", "clutch:a", "damper:a", "-o", str(file)]) == 2
    err = capfd.readouterr().err
    assert "'cluch' is not a known kind (did you mean 'clutch'?)" in err
    assert (
        "“1x” is not a name" in err
        and "the name 'press' is reserved" in err
        and "the name 'a' is given to several" in err
    )
    assert not file.exists()


def test_equal_kinds_give_equal_bytes(tmp_path: Path) -> None:
    texts = []
    for name in ("a", "b"):
        assert main(["new", "cam_gear_transport", "elastic_follower", "-o", str(tmp_path / name / "p.yaml")]) == 0
        texts.append((tmp_path / name / "p.yaml").read_bytes())
    assert texts[0] == texts[1]


def test_a_kind_without_an_example_is_written_with_what_is_to_be_given(tmp_path: Path, capfd: Capture) -> None:
    file = tmp_path / "press.yaml"
    code = main(["new", "lever", "-o", str(file), "--plugins", str(GOOD)])
    err = capfd.readouterr().err
    assert file.exists() and "no example tells these; put in your own: lever." in err
    assert code == main(["validate", str(file), "--plugins", str(GOOD), "--quiet"]) == 0


def test_a_designer_begins_changes_a_number_and_has_a_report(tmp_path: Path, capfd: Capture) -> None:
    file, out = tmp_path / "my_press.yaml", tmp_path / "build"
    assert main(["new", "damper", "cylinder_sizing", "-o", str(file)]) == 0
    text = file.read_text("utf-8")
    assert "velocity: {value: 0.6 m/s, basis: assumed}" in text
    file.write_text(text.replace("velocity: {value: 0.6 m/s, basis: assumed}", "velocity: 0.65 m/s"), "utf-8")
    assert (
        main(["report", "-o", str(tmp_path / "no"), str(file), "-o", str(out), "--format", "json", "--detail", "brief"])
        == 0
    )
    results = json.loads((out / "my_press.json").read_text("utf-8"))
    assert not (tmp_path / "no").exists()  # the last folder that is named holds: ./make-report names one first
    assert results["mechanisms"]["damper"]["inputs"]["velocity"]["value"] == pytest.approx(0.65)
    assert "mechanisms.damper.velocity" not in results["summary"]["assumed"]
    assert "mechanisms.damper.ring_width" in results["summary"]["assumed"]
    capfd.readouterr()
    assert main(["check", str(file)]) == 0
    assert "my_press" in capfd.readouterr().out
