"""The units that a report chooses: judged with file and line, and used in tables, formulas, checks and curves."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from diecut_report.config.plugins import Discovery
from diecut_report.errors import UserError
from diecut_report.press import Press
from diecut_report.results.mechanism_record import ShownRecord
from diecut_report.results.model import ResultsRecord

KNIFE = Path(__file__, "../../../configs/circular_knife.yaml").resolve().read_text(encoding="utf-8")


def config(tmp_path: Path, units: str) -> Path:
    """The circular knife's configuration with chosen units."""
    path = tmp_path / "press.yaml"
    path.write_text(re.sub(r"(?m)^press:", f"report:\n  units: {units}\npress:", KNIFE), encoding="utf-8")
    return path


def results(tmp_path: Path, units: str) -> ResultsRecord:
    """Its results."""
    return Press.read(config(tmp_path, units), Discovery()).calculate().results


@pytest.mark.parametrize(
    ("units", "column", "words"),
    [
        ("{lenght: m}", 11, "report.units.lenght: is not a dimension (did you mean 'length'?)"),
        ("{length: kN}", 19, "report.units.length: is a unit of a force; one of a length is needed, such as m"),
        ("{length: 3}", 19, "report.units.length: is 3; a unit is needed, such as m"),
        ("{length: mmm}", 19, "report.units.length: 'mmm' is not a known unit."),
        ("{moment: J}", 19, "report.units.moment: is a unit of an energy; one of a moment is needed, such as N*m"),
        ("{knife.forcemax: kN}", 11, "names forcemax, which is not a quantity of knife with a number (did you mean 'force_max'?)"),
        ("{blade.force: kN}", 11, "names blade, which is not there; known: press, knife"),
        ("mm", 10, "report.units: is “mm”; keys with units are needed, as in units: {length: mm, rotational_speed: rad/s}"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_a_chosen_unit_is_said_at_its_place(
    tmp_path: Path, units: str, column: int, words: str
) -> None:
    with pytest.raises(UserError) as refused:
        results(tmp_path, units)
    (problem,) = refused.value.problems
    assert words in str(problem) and problem.column == column


def test_a_report_shows_its_quantities_in_the_chosen_units(tmp_path: Path) -> None:
    units = "{length: m, rotational_speed: rad/s, knife.force_max: kN, knife.eccentricity: mm, press.sheet.width: cm}"
    found = results(tmp_path, units)
    knife = found.mechanisms["knife"]
    assert knife.inputs["edge_radius"].display == ShownRecord(text="0.1", unit="m")
    assert knife.inputs["eccentricity"].display == ShownRecord(text="20", unit="mm")
    assert knife.inputs["speed"].display == ShownRecord(text="6.283", unit="rad/s")
    assert knife.outputs["force_max"].display.unit == "kN"
    assert knife.outputs["force_max"].unit == "N"
    checks = {check.id: check for check in knife.checks}
    assert checks["reach"].limit_display.unit == checks["reach"].margin_display.unit == "m"
    items = {item.id: item for section in knife.sections for item in section.items if item.id}
    assert items["depth_least"].result == ShownRecord(text="0.08", unit="m")
    assert items["depth_least"].substituted == ["-", ["qty", "0.1", "m"], ["qty", "20", "mm"]]
    assert knife.curves["cut_position"].display_unit == "m"
    shown = {field.path: field.display for field in found.press.fields}
    assert shown["press.sheet.width"] == ShownRecord(text="35", unit="cm")
    assert shown["press.sheet.length"] == ShownRecord(text="0.5", unit="m")


def test_chosen_units_change_no_value(tmp_path: Path) -> None:
    plain, chosen = (results(tmp_path, units).mechanisms["knife"] for units in ("{}", "{length: um, force: kN}"))
    for group in ("inputs", "outputs", "values"):
        values = [
            {name: (row.value, row.unit) for name, row in getattr(each, group).items()} for each in (plain, chosen)
        ]
        assert values[0] == values[1]
