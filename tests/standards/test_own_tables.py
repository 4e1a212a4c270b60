"""A table of an author's own is checked where it is written, in the plugin or in a file beside it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from diecut_report.standards.files import table_beside
from diecut_report.standards.tables import StandardFault, StandardTable, own_series, own_table

STEELS: dict[str, Any] = {
    "title": "Steels",
    "columns": {"R_e": "MPa", "ρ": "kg/m**3"},
    "rows": {"S235": (235, 7850), "S355": (355, 7850)},
    "sources": ("One", "Two"),
}
FACTORS: dict[str, Any] = {
    "title": "Factors",
    "columns": {"teeth": "1", "Y": "1"},
    "rows": ((12, 0.245), (15, 0.29), (20, 0.32)),
    "sources": ("One", "Two"),
}
YAML = """
title: Steels
columns: {R_e: MPa, ρ: kg/m**3}
sources: [One, Two]
rows:
  S235: [235, 7850]
  S355: [355, 7850]
"""
JSON = '{"title": "Factors", "columns": {"teeth": "1", "Y": "1"}, "sources": ["One", "Two"], "rows": [[12, 0.245], [15, 2.9e-1], [20, 0.32]]}'
CSV = """# title: Steels
# source: One
# source: Two

grade, R_e [MPa], ρ [kg/m**3]
S235, 235, 7850
S355, 355, 7850
"""


def test_rows_by_name_have_columns_with_their_units() -> None:
    table = own_table(**STEELS)
    assert table.by_name("R_e") == {"S235": 235.0, "S355": 355.0} and table.column("ρ").unit == "kg/m**3"
    given: dict[str, Any] = {"title": "Densities", "unit": "kg/m**3", "rows": {"steel": 7850}, "sources": ("One",)}
    one = own_table(**given, only_source="the maker's own")
    assert one.values == {"steel": 7850.0} and one.unit == "kg/m**3"


def test_a_column_is_a_series_of_its_different_values() -> None:
    series = own_table(**STEELS).series("ρ")
    assert (series.values, series.unit, series.title) == ((7850.0,), "kg/m**3", "Steels: ρ")
    assert series.sources == ("One", "Two")


@pytest.mark.parametrize(
    ("name", "text", "wanted"), [("a.yaml", YAML, STEELS), ("a.json", JSON, FACTORS), ("a.csv", CSV, STEELS)]
)
def test_a_file_beside_a_plugin_holds_the_same(tmp_path: Path, name: str, text: str, wanted: dict[str, Any]) -> None:
    (tmp_path / name).write_text(text, encoding="utf-8")
    read, written = table_beside(str(tmp_path / "plugin.py"), name), own_table(**wanted)
    assert read == replace(written, id="a", file=str(tmp_path / name))


FAULTS = {
    "no title": (STEELS, {"title": " "}, "has no title"),
    "one source": (STEELS, {"sources": ("One",)}, "needs two sources that agree, or one and only_source="),
    "the same source twice": (STEELS, {"sources": ("One", "One")}, "needs two sources"),
    "no source": (STEELS, {"sources": (), "only_source": "none"}, "needs two sources"),
    "sources as a text": (STEELS, {"sources": "One, Two"}, "needs its sources as texts in brackets"),
    "unit and columns": (STEELS, {"unit": "mm"}, "needs one of unit="),
    "neither": (STEELS, {"columns": None}, "needs one of unit="),
    "no rows": (STEELS, {"rows": {}}, "has no rows"),
    "a short row": (STEELS, {"rows": {"S235": (235,)}}, "has 1 values in the row 'S235', where 2 are needed"),
    "a text as a value": (STEELS, {"rows": {"S235": (235, "7850")}}, "holds '7850' in the row 'S235'"),
    "yes as a value": (STEELS, {"rows": {"S235": (235, True)}}, "holds True in the row 'S235'"),
    "no finite value": (FACTORS, {"rows": ((12, 0.2), (15, float("nan")))}, r"holds nan in the row \(15, nan\)"),
    "a name twice": (STEELS, {"rows": (("S235", 235, 1), ("S235", 236, 1))}, "has two rows of the name 'S235'"),
    "a name that is none": (STEELS, {"rows": (("S235", 235, 1), (235, 1, 1))}, "has the name 235 of a row"),
    "descending": (FACTORS, {"rows": ((15, 0.29), (12, 0.245))}, "must ascend in teeth without repetition, but 12 follows 15"),
    "a number twice": (FACTORS, {"rows": ((12, 0.2), (12, 0.3))}, "must ascend in teeth without repetition, but 12 follows 12"),
    "one row": (FACTORS, {"rows": ((12, 0.2),)}, "has too few values; give two rows"),
    "one column of numbers": (FACTORS, {"columns": {"teeth": "1"}, "rows": ((12,), (13,))}, "goes by the numbers of its first column"),
    "an unknown unit": (FACTORS, {"columns": {"teeth": "1", "Y": "furlongz"}}, "has no usable unit of Y: .*furlongz"),
}  # fmt: skip


@pytest.mark.parametrize(("sound", "change", "told"), FAULTS.values(), ids=FAULTS)
def test_a_fault_is_told(sound: dict[str, Any], change: dict[str, Any], told: str) -> None:
    with pytest.raises(StandardFault, match=f"^The table “.*” {told}"):
        own_table(**{**sound, **change})


def test_a_column_that_is_not_there_is_told() -> None:
    table = own_table(**STEELS)
    for name, told in (
        ("R_m", "has no column 'R_m'; it has R_e, ρ"),
        ("", "has several columns; name one; it has R_e, ρ"),
    ):
        with pytest.raises(StandardFault, match=told):
            table.column(name)


def test_a_series_of_ones_own_ascends() -> None:
    given: dict[str, Any] = {"title": "Rods", "unit": "mm", "sources": ("One", "Two")}
    assert own_series(values=(1, 2), **given).values == (1.0, 2.0)
    for values, told in (((2, 1), "must ascend"), ((), "has no values"), ((1, "2"), "holds '2'")):
        with pytest.raises(StandardFault, match=told):
            own_series(values=values, **given)  # type: ignore[arg-type]


NUMBERED = "# title: Rods\n# source: One\n# a remark\n# source: Two\n\nbore [mm],rod [mm]\n25,12\n\n32,14\n40,{last}\n"


@pytest.mark.parametrize(
    ("name", "text", "told"),
    [
        ("a.yaml", "title: Steels\nrows: {a: 1}\nsources: [One, Two]\nunits: mm",
         "a.yaml:4: units is not a key of a table (did you mean 'unit'?); known: title,"),
        ("a.yaml", "title: Steels\nunit: mm\nsources: [One, Two]", "a.yaml: rows is missing; write values by the names of the rows"),
        ("a.yaml", YAML + "  S355: [360, 7850]", "a.yaml:8: 'S355' stands twice, in line 7 already"),
        ("a.yaml", YAML.replace("235, 7850", "2:35, 7850"), "a.yaml:6: The table “Steels” holds '2:35' in the row 'S235'"),
        ("a.yaml", "[", "The table {folder}/a.yaml cannot be read: "),
        ("a.json", "", "a.json: it is not written as a table"),
        ("a.csv", "# title: Steels", "The table {folder}/a.csv cannot be read: it has no line with the names of its columns"),
        ("a.csv", CSV.replace("ρ [kg/m**3]", "R_e [MPa]"), "The table {folder}/a.csv cannot be read: two of its columns have one name"),
        ("a.csv", CSV.replace("355, 7850", "355"), "a.csv:7: The table “Steels” has 1 values in the row 'S355'"),
        ("a.yaml", "title: Steels\nrows: {a: 1}\nsources: One\nunit: mm", "a.yaml:3: sources is something else than it must be; write a list"),
        ("a.csv", CSV + "# note: of 2024",
         "a.csv:8: “# note:” says nothing here; known: # title:, # source:, # only_source:, # left_out:; in a comment"),
        ("a.csv", CSV + "# tittle: Steels", "a.csv:8: “# tittle:” says nothing here (did you mean 'title'?)"),
        ("a.csv", CSV + "# title: Others", "a.csv:8: “# title:” stands in line 1 already; write it once"),
        ("a.csv", CSV + "# rows: 3", "a.csv:8: “# rows:” says nothing here"),
        ("a.csv", CSV.replace("# title: Steels", ""), "a.csv: title is missing; write a line # title: … above the columns"),
        ("a.csv", NUMBERED.format(last="x"), "a.csv:10: The table “Rods” holds 'x'"),
        ("a.csv", NUMBERED.format(last="18,3"), "a.csv:10: The table “Rods” has 3 values"),
        ("a.csv", NUMBERED.format(last="18\n40,3"), "a.csv:11: The table “Rods” must ascend in bore"),
        ("a.csv", CSV.replace("S355", "S235"), "a.csv:7: The table “Steels” has two rows of the name 'S235'"),
        ("a.csv", NUMBERED.replace("source: Two", "left_out: Two").format(last="18"), "a.csv: The table “Rods” needs two sources"),
        ("a.yaml", YAML.replace("235, 7850", "x, 7850"), "a.yaml:6: The table “Steels” holds 'x'"),
        ("a.json", JSON.replace("[15", "[11"), "a.json:1: The table “Factors” must ascend"),
    ],
)  # fmt: skip
def test_a_fault_of_a_file_is_told_with_its_line(tmp_path: Path, name: str, text: str, told: str) -> None:
    (tmp_path / name).write_text(text, encoding="utf-8")
    with pytest.raises(StandardFault) as found:
        table_beside(str(tmp_path / "plugin.py"), name)
    assert str(found.value).startswith(told.replace("{folder}", str(tmp_path))) and found.value.tells_place
    with pytest.raises(StandardFault, match=r"b\.yaml cannot be read"):
        table_beside(str(tmp_path / "plugin.py"), "b.yaml")


def test_a_table_is_data() -> None:
    assert isinstance(own_table(**STEELS), StandardTable) and own_table(**STEELS) == own_table(**STEELS)
