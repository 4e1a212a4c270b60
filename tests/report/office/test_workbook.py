"""The report as a workbook: each number is there, shows the digits that it was given, and no text becomes a formula."""

from __future__ import annotations

import io
import json
import math
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import openpyxl
import pytest

from diecut_report.report.office.sheets import defined_name, form_of, sheet_names
from diecut_report.report.rendering import Rendering
from diecut_report.results.model import ResultsRecord
from diecut_report.results.results_file import results_text
from tests.report.made_results import typed

Data = dict[str, Any]
HOSTILE = '=HYPERLINK("http://example.com";"x")'


def opened(results: Data) -> Any:
    """The workbook of results as a reader finds it."""
    return openpyxl.load_workbook(io.BytesIO(Rendering(typed(results)).xlsx()))


def as_shown(cell: Any) -> str:
    """A number as a spreadsheet shows it by its format, which Python's own formatting rounds here."""
    mantissa, exponent, _ = cell.number_format.partition("E+00")
    decimals = len(mantissa.partition(".")[2])
    return f"{cell.value:.{decimals}{'e' if exponent else 'f'}}"


def cell_of(book: Any, name: str) -> Any:
    """The cell that has a name."""
    sheet, place = next(book.defined_names[name].destinations)
    return book[sheet][place]


def outputs_of(results: Data) -> dict[str, Data]:
    """All outputs of results by the names of their cells."""
    calculated = {**results["mechanisms"], **results.get("comparisons", {})}
    return {f"{name}.{key}": row for name, data in calculated.items() for key, row in data.get("outputs", {}).items()}


def test_every_result_stands_in_the_cell_of_its_name_rightly_rounded(small_report: Path) -> None:
    results = json.loads((small_report / "small.json").read_text("utf-8"))
    book, outputs = opened(results), outputs_of(results)
    assert outputs and len(book.defined_names) == len(outputs)
    for name, row in outputs.items():
        cell, text = cell_of(book, name), row["display"]["text"]
        assert (as_shown(cell) if isinstance(cell.value, int | float) else cell.value) == text
        if isinstance(cell.value, int | float):
            assert cell.offset(column=2).value == pytest.approx(row["value"], rel=1e-15)


def test_results_of_comparisons_and_those_that_are_words_have_their_cells(plain: Data) -> None:
    book, outputs = opened(plain), outputs_of(plain)
    assert set(book.defined_names) == set(outputs)
    assert (
        cell_of(book, "cylinder.open").value == "yes" and cell_of(book, "cylinder.open").offset(column=2).value is None
    )


def test_the_sheets_hold_all_with_heads_that_stay_in_view(plain: Data) -> None:
    book = opened(plain)
    compared = plain["mechanisms"] | plain["comparisons"]
    curved = [name for name, data in compared.items() if data.get("curves")]
    assert book.sheetnames == ["Summary", "Inputs", "Results", "Checks", *curved]
    assert [sheet.freeze_panes for sheet in book] == ["B2", "C2", "C2", "D2"] + ["B3"] * len(curved)
    keys = {(row[0].value, row[1].value) for row in book["Inputs"].iter_rows(min_row=2)}
    assert {(name, key) for name, data in plain["mechanisms"].items() for key in data.get("inputs", {})} <= keys
    checks = [(row[0].value, row[1].value) for row in book["Checks"].iter_rows(min_row=2)]
    assert checks == [(name, check["id"]) for name, data in compared.items() for check in data.get("checks", ())]


def test_an_input_has_its_value_as_shown_and_in_si(plain: Data) -> None:
    rows = [[cell.value for cell in row] for row in opened(plain)["Inputs"].iter_rows(min_row=2)]
    height = next(row for row in rows if row[:2] == ["cylinder", "segment_height"])
    assert height[2:8] == ["Height of the segment", "h", 40, "mm", 0.04, "m"]
    length = next(row for row in rows if row[:2] == ["cylinder", "generatrix_length"])
    assert length[10:] == ["reference", "${press.sheet.length}"]


def test_a_check_has_one_unit_for_both_sides(plain: Data) -> None:
    mechanism = plain["mechanisms"]["cylinder"]
    mechanism["checks"][0] |= {"unit": "m", "demand": 0.0005, "demand_display": {"text": "500", "unit": "um"}} | {
        "limit": 0.002,
        "limit_display": {"text": "2", "unit": "mm"},
        "margin_display": {"text": "1.5", "unit": "mm"},
    }
    row = [cell.value for cell in next(opened(plain)["Checks"].iter_rows(min_row=2, max_row=2))]
    assert row[5:11] == [500, "<=", 2000, "µm", pytest.approx(0.228), 1500]


def test_phases_have_a_line_for_each_interval_with_its_numbers_in_full(plain: Data) -> None:
    interval = {"from": "38.85", "to": "55.70", "length": "16.85", "time": "46.80"}
    held = [[math.radians(start), math.radians(start + 16.84851)] for start in (38.84648, 90.25)]
    plain["mechanisms"]["cylinder"]["phases"] = {
        "cutting": {
            "role": "working", "description": "The knife cuts", "abscissa": "angle", "intervals": held,
            "display": {"unit": "deg", "intervals": [interval, interval]},
        }
    }  # fmt: skip
    sheet = opened(plain)["Phases"]
    rows = [[cell.value for cell in row] for row in sheet.iter_rows(min_row=2)]
    assert [row[:4] + row[7:] for row in rows] == [["cylinder", "cutting", "The knife cuts", "working", "°", 46.8]] * 2
    assert [row[4:7] for row in rows] == [
        pytest.approx([start, start + 16.84851, 16.84851], rel=1e-12) for start in (38.84648, 90.25)
    ]
    assert sheet["E2"].number_format == "0.00"


def test_the_curves_stand_beside_their_abscissa_with_a_bounded_number_of_rows(plain: Data) -> None:
    name, data = next((name, data) for name, data in plain["mechanisms"].items() if data.get("curves"))
    axis, curve = next((curve["abscissa"], curve) for curve in data["curves"].values() if "abscissa" in curve)
    for each in data["curves"].values():
        each["values"] = [0.001 * n for n in range(5000)]
    sheet = opened(plain)[name]
    assert str(sheet["A1"].value).startswith(f"{axis} [") and curve["description"] in str(sheet["B2"].value)
    assert 300 < sheet.max_row < 410


def test_a_text_is_never_a_formula_and_holds_no_control_character(plain: Data) -> None:
    plain["project"] |= {"title": HOSTILE, "document_number": "@SUM(A1)", "organisation": "a\x00\x1bb\ufffe"}
    plain["mechanisms"]["cylinder"]["inputs"]["material"]["display"]["text"] = "+1+cmd|' /C calc'!A0"
    content = Rendering(typed(plain)).xlsx()
    book = openpyxl.load_workbook(io.BytesIO(content))
    cells = [cell for sheet in book for row in sheet.iter_rows() for cell in row if cell.value is not None]
    assert {cell.data_type for cell in cells} == {"s", "n"}
    quoted = {cell.value for cell in cells if cell.quotePrefix}
    assert {HOSTILE, "@SUM(A1)", "+1+cmd|' /C calc'!A0"} <= quoted
    assert "a\ufffd\ufffdb\ufffd" in {cell.value for cell in cells}
    with ZipFile(io.BytesIO(content)) as archive:
        assert not any(b"<f>" in archive.read(name) for name in archive.namelist())


def test_equal_results_give_equal_bytes_without_a_time(plain: Data) -> None:
    first, second = (
        Rendering(typed(plain)).xlsx(),
        Rendering(ResultsRecord.model_validate_json(results_text(typed(plain)))).xlsx(),
    )
    assert first == second
    with ZipFile(io.BytesIO(first)) as archive:
        assert {member.date_time for member in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}
        assert archive.read("docProps/core.xml").count(b"1980-01-01T00:00:00Z") == 2


def test_names_of_sheets_are_short_and_unlike() -> None:
    long = "a mechanism with a very long name"
    assert sheet_names(["a/b", "A_B", long, long + " 2", "'x'", "", "History"]) == [
        "a_b", "A_B 2", long[:31], long[:29] + " 2", "x", "_", "History 2",
    ]  # fmt: skip


def test_names_of_cells_are_legal_and_unlike() -> None:
    taken = ["drive.a_b"]
    assert defined_name("drive.crank_torque_peak", taken) == "drive.crank_torque_peak"
    assert defined_name("drive.a-b", taken) == "drive.a_b_2"
    assert defined_name("1.x", taken) == "_1.x" and defined_name("A1", taken) == "_A1"


@pytest.mark.parametrize(
    ("text", "form"), [("105.0", "0.0"), ("23", "0"), ("-1.25e-05", "0.00E+00"), ("steel", "General")]
)
def test_a_number_shows_the_digits_of_its_text(text: str, form: str) -> None:
    assert form_of(text) == form
