"""Where a number comes from: each name of each example's results leads to a line that is there."""

from __future__ import annotations

import json
import re
from functools import cache
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from diecut_report.config.loader import load_config
from diecut_report.errors import UnknownName
from diecut_report.results.mechanism import numbers
from diecut_report.results.warm_press import WarmRun
from diecut_report.results.where import where
from tests.configs import DISCOVERY, EXAMPLE, EXAMPLES, PARTS, WARM
from tests.examples import few

KNIFE = EXAMPLE.with_name("circular_knife.yaml")


@cache
def calculated(file: Path) -> WarmRun:
    return WARM.calculate(load_config(file, DISCOVERY))


def line_at(place: str) -> str:
    """The line that a place names; it must be there."""
    file, _, number = place.rpartition(":")
    return Path(file).read_text("utf-8").splitlines()[int(number) - 1]


@pytest.mark.parametrize("file", few(EXAMPLES, lambda file: file.stem not in PARTS), ids=lambda file: file.stem)
def test_each_name_of_the_results_leads_to_a_line(file: Path) -> None:
    run = calculated(file)
    assert run.status in ("pass", "warn", "fail")
    for mechanism, calc in run.calculations.items():
        groups = numbers(calc)
        names = [*groups["outputs"], *groups["values"], *(f"checks.{check.id}" for check in run.checks[mechanism])]
        places = [where(run, f"{mechanism}.{name}") for name in names]
        assert places
        for place in (each for found in places for each in (found, *found.takes, *found.checks) if ":" in each.place):
            assert line_at(place.place).strip(), place.name
            assert not place.formula or re.search("@formula|def |lambda", line_at(place.formula)), place.name


def test_a_number_names_what_it_takes_and_who_compares_it() -> None:
    found = where(calculated(EXAMPLE), "drive.crank_torque_peak")
    assert found.value.endswith("N·m") and ".crank_torque_peak =" in line_at(found.place)
    assert [each.name for each in found.takes] == ["drive.crank_torque"]
    assert [each.name for each in found.checks] == ["drive.checks.crank_torque"]


def test_a_typed_input_leads_to_its_line_in_the_configuration() -> None:
    found = where(calculated(EXAMPLE), "drive.inputs.crank_length")
    assert found.value == "100 mm" and line_at(found.place).strip().startswith("crank_length:")


def test_a_part_of_a_row_has_its_own_value() -> None:
    run = calculated(EXAMPLE)
    assert (
        where(run, "train.gear_ratio.0").value == "4.9" and where(run, "crankshaft.section_diameter.1").value == "55 mm"
    )


def test_an_input_that_refers_to_another_shows_both() -> None:
    found = where(calculated(EXAMPLE), "drive.inputs.segment_height")
    assert re.fullmatch(r"[\d.]+ mm, \$\{cylinder\.segment_height\}", found.value)


def test_a_check_names_its_sides() -> None:
    found = where(calculated(EXAMPLE), "drive.checks.crank_torque")
    assert "drive.crank_torque_peak" in [each.name for each in found.takes]


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("drive.crank_torqe_peak", "did you mean 'crank_torque_peak'"),
        ("drives.crank_torque_peak", "did you mean 'drive'"),
        ("drive", r"MECHANISM.NAME; the mechanisms are: [^(]*$"),
        ("press.productivity", "MECHANISM.NAME"),
        ("drive.inputs.", "gives nothing of this name"),
        ("drive.\x1b[31m", "gives nothing of this name"),
    ],
)
def test_an_unknown_name_is_refused_with_the_nearest(name: str, words: str) -> None:
    with pytest.raises(UnknownName, match=words):
        where(calculated(EXAMPLE), name)


def test_the_command_prints_the_places_as_text_and_as_data(capfd: pytest.CaptureFixture[str]) -> None:
    arguments = ["where", "knife.torque_max", str(KNIFE)]
    assert main([*arguments, "--quiet"]) == 0
    text = capfd.readouterr().out
    assert main([*arguments, "--format", "json"]) == 0
    data = json.loads(capfd.readouterr().out)
    assert Path(data["place"].rpartition(":")[0]).is_file()
    assert all(each["name"] in text for each in (data, *data["takes"], *data["checks"]))
    assert main(["where", "knife.nothing", str(KNIFE)]) == 2


def test_a_place_is_short_where_it_lies_in_the_current_folder(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(KNIFE.parent)
    assert main(["where", "knife.inputs.eccentricity", KNIFE.name, "--quiet"]) == 0
    assert f"({KNIFE.name}:" in capfd.readouterr().out
