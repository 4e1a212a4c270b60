"""Tables of variants from CSV, Parquet and XLSX files, and what is said where they are wrong."""

from __future__ import annotations

import csv
import math
from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from typing import Any

import numpy as np
import openpyxl
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import given
from hypothesis import strategies as st

from diecut_report.errors import UserError
from diecut_report.quantities.units import parse_quantity
from diecut_report.study.tables.formats import SLICE, Cells
from diecut_report.study.tables.reading import read_table, si_numbers

HEADERS = ["drive.crank_speed [rpm]", "cylinder.bore_radius", "drive.motion_law", "train.teeth"]
ROWS: list[list[Any]] = [[60, "55 mm", "cycloidal", 17], [90.5, "60.5 mm", "harmonic", 23]]


def write_csv(path: Path, rows: list[list[Any]]) -> None:
    with path.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows(rows)


def write_parquet(path: Path, rows: list[list[Any]]) -> None:
    names, *cells = rows
    columns = [pa.array([float(c) if isinstance(c, int) else c for c in column]) for column in zip(*cells, strict=True)]
    pq.write_table(pa.Table.from_arrays(columns, names=names), path)


def write_xlsx(path: Path, rows: list[list[Any]]) -> None:
    book = openpyxl.Workbook()
    for row in rows:
        book.worksheets[0].append(row)
    book.save(path)


Writer = Callable[[Path, list[list[Any]]], None]
WRITERS: dict[str, Writer] = {"csv": write_csv, "parquet": write_parquet, "xlsx": write_xlsx}


def test_a_column_has_one_decimal_sign(tmp_path: Path) -> None:
    """Where the comma is it, 1.200 may be twelve hundred."""
    table = read_table(csv_of(tmp_path, "a [N*m];b\n850,5;1\n1.200;2\n3;3\n"))
    words = "row 3: the cell has the decimal sign ., but row 2 has ,; a column has one"
    assert words in fault(lambda: table.columns["a"].si("N*m"))
    table = read_table(csv_of(tmp_path, "a [N*m];b\n850,5;1.5 kg\n3;2.5 kg\n"))
    assert list(table.columns["a"].si("N*m")) == [850.5, 3] and list(table.columns["b"].si("kg")) == [1.5, 2.5]


SHOWN = [  # a number, its format, and what the cell shows
    (0.71, "0%", "71 %"), (0.125, "0.00 %", "12.5 %"), (5, '0" %"', "5 %"), (0.6, '0.0" kN·m";-0.0', "0.6 kN·m"),
    (1200, r"#\ ##0\ \m\m", "1200 mm"), (3, "[$MPa] 0.0", "3 MPa"), (7, "[Red]#,##0", "7"), (12000, "0.0,", "12000 shown as 0.0,"),
    (5, "0°", "5 °"), (5, '[>=10]0.0" m";0" mm"', '5 shown as [>=10]0.0" m"'),
]  # fmt: skip


def test_a_number_of_excel_has_the_unit_that_its_cell_shows(tmp_path: Path) -> None:
    """Excel keeps 71 % as 0.71, and a unit that only the number format has nowhere else."""
    book = openpyxl.Workbook()
    sheet = book.worksheets[0]
    sheet.append([f"head {form}" for _, form, _ in SHOWN])
    sheet.append([number for number, _, _ in SHOWN])
    for column, (_, form, _) in enumerate(SHOWN, 1):
        sheet.cell(2, column).number_format = form
    book.save(tmp_path / "t.xlsx")
    found = [column.cells.texts() for column in read_table(tmp_path / "t.xlsx").columns.values()]
    assert found == [[text] for *_, text in SHOWN]


def faults(read: Callable[[], object]) -> list[str]:
    with pytest.raises(UserError) as caught:
        read()
    return [str(problem) for problem in caught.value.problems]


def fault(read: Callable[[], object]) -> str:
    (found,) = faults(read)
    return found


def csv_of(folder: Path, text: str, encoding: str = "utf-8") -> Path:
    path = folder / "t.csv"
    path.write_text(text, encoding=encoding, newline="")
    return path


# --- what is read ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", WRITERS)
def test_a_table_becomes_si_values_and_texts(kind: str, tmp_path: Path) -> None:
    WRITERS[kind](tmp_path / f"t.{kind}", [HEADERS, *ROWS])
    table = read_table(tmp_path / f"t.{kind}")
    speed, radius, law, teeth = table.columns.values()
    assert list(table.columns) == ["drive.crank_speed", "cylinder.bore_radius", "drive.motion_law", "train.teeth"]
    np.testing.assert_allclose(speed.si("rad/s"), np.array([60, 90.5]) * 2 * math.pi / 60)
    assert list(radius.si("mm")) == [0.055, 0.0605]
    assert law.texts() == ["cycloidal", "harmonic"]
    assert list(teeth.si("1")) == [17.0, 23.0] and teeth.texts() == ["17", "23"]


@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
def test_a_csv_may_be_of_any_spreadsheet(delimiter: str, tmp_path: Path) -> None:
    text = "\ufeffa [mm],b\r\n 1.5 , x \r\n\r\n2e1,y\r\n\r\n".replace(",", delimiter)
    table = read_table(csv_of(tmp_path, text))
    assert list(table.column("a").si("m")) == [0.0015, 0.02]
    assert table.column("b").texts() == ["x", "y"]
    assert list(read_table(csv_of(tmp_path, "a\n1\n2\n\n\n")).column("a").si("1")) == [1.0, 2.0]


def parquet_of(folder: Path, **columns: Any) -> Path:
    path = folder / "t.parquet"
    pq.write_table(pa.table(columns), path)
    return path


def test_a_parquet_column_may_store_its_unit_beside_it(tmp_path: Path) -> None:
    field = pa.field("a", pa.float32(), metadata={b"unit": b"mm"})
    pq.write_table(pa.table([pa.array([1.5, 2.0], pa.float32())], pa.schema([field])), tmp_path / "t.parquet")
    assert list(read_table(tmp_path / "t.parquet").column("a").si("m")) == [0.0015, 0.002]


def test_a_parquet_column_may_hold_repeated_texts_as_a_dictionary(tmp_path: Path) -> None:
    path = parquet_of(tmp_path, a=pa.array(["x", "y", "x"]).dictionary_encode())
    assert read_table(path).column("a").texts() == ["x", "y", "x"]


@given(st.lists(st.floats(-1e6, 1e6), min_size=1), st.sampled_from(["mm", "kN", "rpm", "1/h", "deg", "1", "kg*m**2"]))
def test_columns_are_converted_as_single_values_are(values: list[float], unit_text: str) -> None:
    expected = [parse_quantity(value, unit_text) for value in values]
    plain, (wrong, _) = si_numbers(Cells(values), unit_text, own=False)
    typed = [f"{value!r} {unit_text}" if unit_text != "1" else repr(value) for value in values]
    with_units, (none_either, _) = si_numbers(Cells(typed), unit_text, own=False)
    assert len(wrong) == len(none_either) == 0
    assert list(plain) == list(with_units) == expected


def test_a_column_longer_than_is_read_at_once_is_converted_as_a_short_one() -> None:
    values = [0.1 * (i % 997) for i in range(SLICE + 5)]
    found, (wrong, _) = si_numbers(Cells(values), "mm", own=False)
    assert not len(wrong) and list(found[-9:]) == [parse_quantity(value, "mm") for value in values[-9:]]
    assert list(found[:997]) == list(found[997:1994]) and len(found) == len(values)


# --- what is wrong with cells ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", WRITERS)
def test_an_empty_cell_is_told_with_its_row(kind: str, tmp_path: Path) -> None:
    path = tmp_path / f"t.{kind}"
    WRITERS[kind](path, [["x", "a [mm]", "b"], [0.5, 1.5, "x"], [0.5, None, "y"], [0.5, 3.5, None]])
    table, first = read_table(path), 1 if kind == "parquet" else 2
    assert f"{path}:{first + 1}:2: a: row {first + 1}: the cell is empty" in fault(lambda: table.column("a").si("m"))
    assert f"{path}:{first + 2}:3: b: row {first + 2}: the cell is empty" in fault(table.column("b").texts)


@pytest.mark.parametrize("cell", ["nan", "NaN", "inf", "-inf", "#N/A", "null"])
@pytest.mark.parametrize("other", ["1", "1 mm"])
def test_a_cell_that_is_no_finite_number_is_refused(cell: str, other: str, tmp_path: Path) -> None:
    table = read_table(csv_of(tmp_path, f"a,b\n{other},x\n{cell},x\n"))
    assert "t.csv:3:1: a: row 3: " in fault(lambda: table.column("a").si("mm"))


def test_nan_in_a_parquet_column_is_refused(tmp_path: Path) -> None:
    nan, infinite = faults(lambda: read_table(parquet_of(tmp_path, a=[1.0, math.nan, math.inf])).column("a").si("1"))
    assert "row 2" in nan and "row 3: the number is infinite" in infinite


@pytest.mark.parametrize(
    ("cells", "words"),
    [
        ("55 mm\n6 cm", "row 3: the cell is in cm, but row 2 is in mm; a column has one unit"),
        ("55\n6 cm", "row 3: the cell is in cm, but row 2 has no unit"),
        ("55 mm\n6", "row 3: the cell has no unit, but row 2 is in mm"),
        ("55 mm\n6 kg", "row 3: 6 kg is a mass; a length is needed"),
        ("55 mm\n6 furlogs", "row 3: 'furlogs' is not a known unit"),
        ("1\n\"2,500\"", "row 3: '2,500' may be 2500 or 2.500"),
        ("1\nabc", "row 3: 'abc' does not begin with a finite number"),
    ],
)  # fmt: skip
def test_mixed_and_wrong_units_are_told_with_their_row(cells: str, words: str, tmp_path: Path) -> None:
    table = read_table(csv_of(tmp_path, f"a\n{cells}\n"))
    assert words in fault(lambda: table.column("a").si("mm"))


def test_what_an_unknown_unit_may_have_meant_is_sought_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sought = list[str]()

    def suggestion(text: str, _known: object) -> str:
        sought.append(text)
        return ""

    monkeypatch.setattr("diecut_report.quantities.units.suggestion", suggestion)
    table = read_table(csv_of(tmp_path, "a\n" + "".join(f"{number} furlogns\n" for number in range(300))))
    told = faults(lambda: table.column("a").si("mm"))
    assert "295 more cells of this column are wrong" in told[-1] and len(sought) == 1


def test_a_cell_may_repeat_the_unit_of_its_header_but_no_other(tmp_path: Path) -> None:
    table = read_table(csv_of(tmp_path, "a [cm],b [cm]\n1 cm,1\n2,2 mm\n"))
    assert list(table.column("a").si("mm")) == [0.01, 0.02]
    assert "row 3: the cell is in mm, but the header is in cm" in fault(lambda: table.column("b").si("mm"))


@pytest.mark.parametrize(
    ("unit", "words"),
    [("kg", " [kg] is of another kind; give one such as [mm]"), ("furlogs", ": 'furlogs' is not a known unit")],
)
def test_a_wrong_unit_in_the_header_is_refused(unit: str, words: str, tmp_path: Path) -> None:
    table = read_table(csv_of(tmp_path, f"a [{unit}]\n1\n"))
    assert f"the header's unit{words}" in fault(lambda: table.column("a").si("mm"))


def test_a_text_has_no_unit_and_no_control_characters(tmp_path: Path) -> None:
    assert "remove the unit" in fault(read_table(csv_of(tmp_path, "law [mm]\nx\n")).column("law").texts)
    table = read_table(parquet_of(tmp_path, law=["x", "a\x1b[2J", "y"]))
    assert "law: row 2: the text holds the invisible character U+001B" in fault(table.column("law").texts)


def test_a_date_in_a_workbook_is_no_number(tmp_path: Path) -> None:
    write_xlsx(tmp_path / "t.xlsx", [["a"], [1.0], [datetime(2026, 1, 5)], [True]])
    found = faults(lambda: read_table(tmp_path / "t.xlsx").column("a").si("1"))
    assert "row 3: 2026-01-05 00:00:00 is not a number (the cell holds a datetime)" in found[0]
    assert "row 4: true is not a quantity" in found[1]


def test_rows_are_counted_with_the_blank_lines_between_them(tmp_path: Path) -> None:
    table = read_table(csv_of(tmp_path, "a,b\n1,x\n\n2,x\n\n\n,x\n"))
    assert "t.csv:7:1: a: row 7" in fault(lambda: table.column("a").si("1"))


# --- what is wrong with tables ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("text", ['a,b\n1,"2\n', 'a,b\n1,2\n3,"4', 'a,"b\n1,2\n', 'a,b\n1,2"\n'])
def test_a_quotation_that_is_not_closed_is_refused(text: str, tmp_path: Path) -> None:
    assert "has 1 quotation marks, so that one is not closed" in fault(lambda: read_table(csv_of(tmp_path, text)))


def test_rows_of_another_length_are_all_told(tmp_path: Path) -> None:
    longer, shorter = faults(lambda: read_table(csv_of(tmp_path, "a,b\n1,2\n\n1,2,3\n4,5\n6\n")))
    assert "t.csv:4: row 4 has 3 cells, the header 2" in longer and "t.csv:6: row 6 has 1 cells" in shorter


@pytest.mark.parametrize("kind", WRITERS)
def test_columns_of_one_name_or_none_are_refused(kind: str, tmp_path: Path) -> None:
    path = tmp_path / f"t.{kind}"
    WRITERS[kind](path, [["a [mm]", "", "a [cm]"], [1, 2, 3]])
    found = faults(lambda: read_table(path))
    assert "column 2 has no name" in found[0]
    assert "columns 1 and 3 have the same name" in found[1]


@pytest.mark.parametrize("text", ["", "\n1,2\n", "a,b\n", "a,b\n\n", "a,b", "a\n\n"])
def test_a_table_without_rows_is_refused(text: str, tmp_path: Path) -> None:
    words = "no rows below its header" if text.startswith("a") else "row 1 is empty"
    assert words in fault(lambda: read_table(csv_of(tmp_path, text)))


@pytest.mark.parametrize("rows", [[], [[None, None]]])
def test_a_workbook_without_rows_is_refused(rows: list[list[Any]], tmp_path: Path) -> None:
    write_xlsx(tmp_path / "t.xlsx", [["a", "b"], *rows])
    assert "no rows below its header" in fault(lambda: read_table(tmp_path / "t.xlsx"))


@pytest.mark.parametrize("text", ["a,b\n1,я\n", "я,b\n1,2\n"])
def test_a_csv_in_another_encoding_is_refused(text: str, tmp_path: Path) -> None:
    path = csv_of(tmp_path, text, encoding="cp1251")
    assert "is not in UTF-8" in fault(lambda: read_table(path))


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("t.parquet", "is not a Parquet file"),
        ("t.xlsx", "is not an XLSX workbook"),
        ("t.xls", "the ending .xls is not known; save the table as .csv, .parquet, .xlsx"),
        ("table", "the ending (none) is not known"),
    ],
)
def test_a_file_of_another_kind_is_refused(name: str, words: str, tmp_path: Path) -> None:
    path = tmp_path / name
    path.write_bytes(b"something else, long enough to be no table at all")
    assert words in fault(lambda: read_table(path))


@pytest.mark.parametrize("name", ["none.csv", "none.parquet", "none.xlsx"])
def test_a_file_that_is_not_there_is_told(name: str, tmp_path: Path) -> None:
    assert "There is no such file. Check the name and the folder." in fault(lambda: read_table(tmp_path / name))


def test_a_parquet_column_of_another_kind_is_refused(tmp_path: Path) -> None:
    path = parquet_of(tmp_path, a=[[1.0], [2.0]], b=[True, False], c=[1, 2])
    found = [text.split(": ", 1)[1].split("; ")[0] for text in faults(lambda: read_table(path))]
    assert found == ["column a holds list<element: double>", "column b holds bool"]


def test_a_table_of_many_rows_is_read_by_column(tmp_path: Path) -> None:
    values = np.random.default_rng(0).random((50_000, 3))
    path = tmp_path / "t.csv"
    np.savetxt(path, values, delimiter=",", header="a [mm],b [rpm],c", comments="", fmt="%.17g")
    table = read_table(path)
    np.testing.assert_allclose(table.column("a").si("m"), values[:, 0] / 1000, rtol=1e-15)
    np.testing.assert_array_equal(table.column("c").si("1"), values[:, 2])
