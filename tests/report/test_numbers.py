"""Numbers and units as they are printed, alone and in the tables of a chapter."""

from __future__ import annotations

import math
import re
import subprocess
from pathlib import Path
from typing import Any

import pytest
from markupsafe import Markup

from diecut_report.report.chapters.printed_tables import PrintedTable
from diecut_report.report.chapters.repetition import FEWEST_GIVEN, counted, gathered
from diecut_report.report.chapters.tables import Tables, table_places
from diecut_report.report.chapters.value_tables import RecordTable, ValueRow
from diecut_report.report.model import ALONE, in_lines
from diecut_report.report.pages.html import folder
from diecut_report.report.pages.page_engine import HTML
from diecut_report.report.text import Catalogue, displayed, number, quantity, rooms, significant, tidy
from diecut_report.results.mechanism_record import CurveRecord, ItemRecord, PhaseRecord, QuantityRecord
from tests.records import filled
from tests.report.made_results import inputs, outputs, part
from tests.report.made_results import quantity as shown_quantity

THIN = "\u202f"
NARROW = "\u2009"
FIXED = "\u00a0"


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("2", "2"),
        ("-0.5", "−0.5"),
        ("105.0", "105.0"),  # a rounded result keeps its digits
        ("9999", "9999"),
        ("21000", f"21{THIN}000"),
        ("-1234567.25", f"−1{THIN}234{THIN}567.25"),
        ("1.2e-05", f"1.2{NARROW}×{NARROW}10⁻⁵"),
        ("-3e+12", f"−3{NARROW}×{NARROW}10¹²"),
        ("5e0", "5"),
        ("steel", "steel"),
        ("", ""),
        ("1.2.3", "1.2.3"),
    ],
)
def test_number(text: str, printed: str) -> None:
    assert number(text) == printed


def test_decimal_sign_of_the_language() -> None:
    assert number("12345.5", decimal=",") == f"12{THIN}345,5"


@pytest.mark.parametrize(
    ("text", "unit", "printed"),
    [
        ("40", "mm", f"40{FIXED}mm"),
        ("0.6362", "kg*m**2", f"0.6362{FIXED}kg·m²"),
        ("21", "N*m", f"21{FIXED}N·m"),
        ("59.4576", "deg", "59.4576°"),
        ("6.05", "1", "6.05"),
        ("6000", "1/h", f"6000{FIXED}1/h"),
        ("1e-06", "deg", f"1{NARROW}×{NARROW}10⁻⁶{THIN}°"),  # no power of a degree
    ],
)
def test_quantity(text: str, unit: str, printed: str) -> None:
    assert quantity(text, unit) == printed


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"),
        (1.0, "1.000"),
        (-0.0012345, "-0.001234"),
        (99995.0, "99995"),
        (0.99996, "1.000"),
        (1234567.0, "1.235e+06"),
    ],
)
def test_significant_digits(value: float, text: str) -> None:
    assert significant(value, 4) == text


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [(0.105, "mm", "105"), (0.34906585039886595, "deg", "20"), (2.591e-5, "mm", "0,026"), (0.8550499, "m/s", "0,855")],
)
def test_a_value_is_shown_with_the_digits_that_mean_something(value: float, unit: str, text: str) -> None:
    assert displayed(value, unit, ",") == text


@pytest.mark.parametrize(
    ("sentence", "printed"),
    [
        ("the wall is -5 mm", "the wall is −5 mm"),
        ("at 49.91 °.", "at 49.91°."),
        ("DCP-700", "DCP-700"),
        ("2-3 times", "2-3 times"),
        ("off by 5.1e-14", f"off by 5.1{NARROW}×{NARROW}10⁻¹⁴"),
        ("key 3e4f", "key 3e4f"),
    ],
)
def test_sentences(sentence: str, printed: str) -> None:
    assert tidy(sentence) == printed


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("allowed 10000 m/s², steel of EN 10083", f"allowed 10{THIN}000 m/s², steel of EN 10083"),
        ("critical speed 971837,5 r/min in 12345 steps", f"critical speed 971{THIN}837,5 r/min in 12345 steps"),
        ("accepted 1e-06 °", f"accepted 1{NARROW}×{NARROW}10⁻⁶{THIN}°"),
    ],
)
def test_a_sentence_has_its_numbers_as_a_table_has_them(text: str, printed: str) -> None:
    assert tidy(text) == printed


# Columns aligned on the decimal sign.


@pytest.mark.parametrize(
    ("column", "classes"),
    [
        (["1.25", "10", "−0.5", "12\u202f000"], ["", "w2", "f1", "w2"]),
        (["1,25", "10,5"], ["", "f1"]),
        (["1", "20"], ["", ""]),
        (["–", "1.5", "as given", "1.2 × 10⁻⁵", "3"], ["", "", "", "", "w1"]),
        (["0.1234567890", "1"], ["", "w8"]),
        ([], []),
    ],
)  # fmt: skip
def test_a_number_leaves_room_for_the_decimals_of_its_column(column: list[str], classes: list[str]) -> None:
    assert rooms(column) == classes


TURN = CurveRecord(
    values=[math.radians(k / 2) for k in range(720)],
    unit="rad",
    display_unit="deg",
    symbol="φ",
    description="Angle",
    source="",
)


def curve(*breaks: float, jump: float = 0.0) -> CurveRecord:
    """A curve that is 5 everywhere and jumps to 5 + ``jump`` at its breakpoints (degrees), as the results hold it."""
    common = {"unit": "N", "display_unit": "N", "symbol": "F", "description": "Force", "abscissa": "angle"}
    places = {
        "breakpoints": [math.radians(b) for b in breaks],
        "left": [5.0] * len(breaks),
        "right": [5.0 + jump] * len(breaks),
    }
    return filled(CurveRecord, common | {"values": [5.0] * 720} | (places if breaks else {}))


def angles(*curves: CurveRecord) -> list[float]:
    """Where the rows of a table stand, in degrees."""
    return [round(math.degrees(place.x), 6) for place in table_places(TURN, curves)]


def test_a_table_of_curves_stands_at_even_steps() -> None:
    assert angles(curve()) == angles(curve(38.8465, 42.97, 55.695)) == [20.0 * k for k in range(18)]


def test_a_jump_stands_twice_and_takes_the_place_of_a_step() -> None:
    assert angles(curve(40.0, 55.5, jump=2.0))[:6] == [0.0, 20.0, 40.0, 40.0, 55.5, 55.5]


def test_a_jump_has_a_row_before_and_one_after_it() -> None:
    table = Tables("A", Catalogue("en")).of_curves({"angle": TURN, "force": curve(100.2, jump=2.0)})[0]
    assert [row[1] for row in table.rows if row[0] == "100.2"] == ["5", "7"]


@pytest.mark.parametrize("rounding", [0.0, 1e-7, -1e-7])
def test_a_breakpoint_without_a_jump_has_no_row(rounding: float) -> None:
    table = Tables("A", Catalogue("en")).of_curves({"angle": TURN, "force": curve(100.2, jump=rounding)})[0]
    assert [row[1] for row in table.rows if row[0] == "100.2"] == []


def test_rounding_beside_great_values_is_printed_as_zero() -> None:
    force = curve(100.2, jump=2.0).with_(left=[3e-11])
    table = Tables("A", Catalogue("en")).of_curves({"angle": TURN, "force": force})[0]
    assert [row[1] for row in table.rows if row[0] == "100.2"] == ["0", "7"]


@pytest.mark.parametrize(
    "curves",
    [(curve(*range(10, 350, 10), jump=2.0),), (curve(100.2, jump=2.0), curve())],
    ids=["too many", "not shared"],
)
def test_pieces_that_are_too_many_or_not_shared_are_not_told_apart(curves: tuple[CurveRecord, ...]) -> None:
    assert angles(*curves) == [20.0 * k for k in range(18)]


def test_phases_over_time_do_not_tell_their_time_once_more() -> None:
    shown = {"unit": "ms", "intervals": [{"from": "0", "to": "333.3", "length": "333.3", "time": "333.3"}]}
    phase = {"abscissa": "time", "description": "The input moves", "role": "moving", "display": shown}
    turned = phase | {"abscissa": "angle", "display": shown | {"unit": "deg"}}
    phases = {name: filled(PhaseRecord, each) for name, each in (("moves", phase), ("turns", turned))}
    over_time, over_angle = Tables("A", Catalogue("en")).of_phases(phases)
    assert [unit for _, _, unit in over_time.columns] == ["", "", "ms", "ms", "ms"]
    assert [unit for _, _, unit in over_angle.columns] == ["", "", "°", "°", "°", "ms"]


def test_the_head_of_a_column_leaves_out_what_is_explained_behind_a_semicolon() -> None:
    column = {"title": "Side of the pulley; outside is on the back", "symbol": "", "unit": "1"}
    item = {"type": "table", "title": "Pulleys", "columns": [column], "rows": [["inside"]]}
    table = Tables("A", Catalogue("en")).of_item(ItemRecord.model_validate(item))
    assert table.columns[0][0] == "Side of the pulley"


# Tables say themselves what stands in their columns, whatever their language.


NONE = Markup("")
PHASE = filled(PhaseRecord, {
    "description": "Ніж ріже", "role": "working", "abscissa": "phi",
    "display": {"unit": "deg", "intervals": [{"from": "1.5", "to": "20", "length": "18.5"}]},
})  # fmt: skip


def kinds(*columns: list[str], symbol: str = "", unit: str = "") -> list[str]:
    rows = [list(row) for row in zip(*columns, strict=True)]
    return PrintedTable("", [("", Markup(symbol), unit) for _ in columns], rows).kinds


@pytest.mark.parametrize(
    ("texts", "kind"),
    [
        (["1", "2", "3"], "nth"),
        (["1", "3"], ""),
        (["барабан", "вал"], "named"),
        (["A", "–"], "named"),
        (["12,5", "–", "−3"], ""),
        (["1,2\u2009×\u200910⁻⁵", "3"], ""),
        (["10,34", "> 100"], ""),
    ],
)
def test_a_first_column_is_what_its_texts_are(texts: list[str], kind: str) -> None:
    assert kinds(texts) == [kind]


def test_texts_in_another_column_are_words_also_where_they_are_numbers_with_their_units() -> None:
    assert kinds(["1", "2"], ["26 µm", "1,5 mm"], ["1", "2"]) == ["nth", "words", ""]


def test_values_of_a_quantity_do_not_number_lines() -> None:
    assert kinds(["1", "2"], symbol="φ") == [""] and kinds(["1", "2"], unit="mm") == [""]


@pytest.mark.parametrize("language", ["en", "uk"])
def test_phases_are_named_in_every_language(language: str) -> None:
    (table,) = Tables("A", Catalogue(language)).of_phases({"cuts": PHASE})
    assert table.kinds == ["named", "words", "", "", ""]


def test_a_long_table_of_few_columns_stands_in_two_halves() -> None:
    rows = [[f"phase {n}", f"{n}.5"] for n in range(17)]
    columns = [{"title": "Phase", "symbol": "", "unit": "1"}, {"title": "Time", "symbol": "t", "unit": "ms"}]
    item = {"type": "table", "title": "Times", "columns": columns, "rows": rows}
    table = Tables("A", Catalogue("en")).of_item(ItemRecord.model_validate(item))
    assert len(table.columns) == 4 and len(table.rows) == 9
    assert table.rows[0] == ["phase 0", "0.5", "phase 9", "9.5"] and table.rows[8] == ["phase 8", "8.5", "", ""]
    assert table.kinds == ["named", "", "named", ""]


def test_columns_of_a_wide_table_have_room_for_symbols_alone() -> None:
    wide = PrintedTable("", [("A long title", Markup("a"), "mm")] * 13, [["1"] * 13])
    assert wide.is_wide and not PrintedTable("", wide.columns[:8], [["1"] * 8]).is_wide


def test_a_long_word_in_a_narrow_head_is_divided_between_syllables(tmp_path: Path) -> None:
    style = (folder() / "report.css").read_text("utf-8")
    head = '<table style="width: 25mm; table-layout: fixed"><tr><th>За продуктивністю</th></tr></table>'
    file = tmp_path / "head.pdf"
    HTML(string=f'<html lang="uk"><style>{style}</style>{head}').write_pdf(file)
    told = subprocess.run(["pdftotext", "-layout", str(file), "-"], capture_output=True, text=True, check=True).stdout
    assert re.search(r"\w{4,}[-\u2010]\n\s*\w{4,}", told)


# Inputs of a few repeated parts: a line for each quantity, a column for each part.


def given(index: int, shown_quantity: str, value: str, **more: Any) -> QuantityRecord:
    """An input of the part of a list."""
    found = {"value": value, "description": shown_quantity, "unit": "1", "display": {"text": value, "unit": "1"}, "origin": "given",
             "part": {"family": "loads", "index": index, "quantity": shown_quantity}} | more  # fmt: skip
    return filled(QuantityRecord, found)


def of(*rows: QuantityRecord) -> RecordTable:
    """The table of inputs."""
    inputs = {f"loads.{row.part.index}.{row.part.quantity}": row for row in rows if row.part}
    _, [parts] = gathered(inputs, FEWEST_GIVEN)
    [table] = Tables("A", Catalogue("en"), {"loads": "Loads"}).of_records(parts)
    assert isinstance(table, RecordTable)
    return table


def test_parts_stand_side_by_side_under_their_names() -> None:
    table = of(given(0, "name", "gear"), given(0, "mass", "12"), given(1, "name", "crank"), given(1, "mass", "8"))
    assert (table.title, table.family, table.heads) == ("Loads", "loads", ["gear", "crank"])
    assert [(row.key, [cell.text for cell in row.cells]) for row in table.rows] == [("mass", ["12", "8"])]


def test_what_all_values_rest_on_is_said_once() -> None:
    rows = [given(0, "mass", "12", basis="assumed"), given(1, "mass", "8", basis="assumed"),
            given(0, "offset", "1", basis="assumed"), given(1, "offset", "2")]  # fmt: skip
    mass, offset = of(*rows).rows
    assert (mass.note, [cell.note for cell in mass.cells]) == ("assumed", ["", ""])
    assert (offset.note, [cell.note for cell in offset.cells]) == ("", ["assumed", ""])


def test_what_is_said_at_length_of_single_values_stands_beside_their_line() -> None:
    typed = given(1, "force", "5", text="${drive.crank_bearing_force_x}")
    names = given(0, "name", "gear"), given(1, "name", "crank")
    [force] = of(*names, given(0, "force", "2", basis="assumed"), typed).rows
    assert force.note == "gear: assumed\ncrank: ${drive.crank_bearing_force_x}"
    assert [cell.note for cell in force.cells] == ["", ""]


def test_a_part_without_a_value_has_a_dash() -> None:
    rows = [given(0, "mass", "12"), given(1, "offset", "8")]
    assert [[cell.text for cell in row.cells] for row in of(*rows).rows] == [["12", "–"], ["–", "8"]]


# Quantities of repeated parts are gathered into tables, lone ones stay lines.


Data = dict[str, Any]


def recorded(rows: Data) -> dict[str, QuantityRecord]:
    """The quantities of data that hold them."""
    return {name: filled(QuantityRecord, row) for name, row in rows.items()}


def _row(description: str, of: Data) -> Data:
    return shown_quantity(1.0, "m", "1", description, part=of)


def test_lists_of_three_parts_and_more_make_a_table() -> None:
    single, [table] = gathered(recorded(inputs()))
    assert list(single) == ["vbelt.section", "law", "speed", "gears.0.teeth", "gears.1.teeth"]
    assert table.family == "belt.pulleys" and table.listed
    assert table.numbers == [1, 2, 3, 4, 5]
    assert list(table.columns) == ["radius", "side", "mass"]
    assert list(table.columns["mass"]) == [4]


def test_rows_of_results_and_numbered_names_make_tables() -> None:
    single, tables = gathered(recorded(outputs()))
    assert list(single) == ["radius", "ratios.0", "ratios.1"]
    assert [(t.family, t.listed, t.numbers, list(t.columns)) for t in tables] == [
        ("belt.pulleys", True, [1, 2, 3, 4, 5], ["wraps", "arcs"]), ("shaft", False, [3, 4, 5, 6], ["speed", "torque"]),
    ]  # fmt: skip


def test_nothing_is_told_twice_and_nothing_is_lost() -> None:
    for rows in (recorded(inputs()), recorded(outputs())):
        single, tables = gathered(rows)
        told = [name for table in tables for column in table.columns.values() for name, _ in column.values()]
        assert sorted([*single, *told]) == sorted(rows)


def test_numbers_in_names_alone_make_no_parts() -> None:
    rows = {f"angle_{n}": shown_quantity(1.0, "rad", "1", f"End of phase {n}") for n in range(1, 5)}
    single, tables = gathered(recorded(rows))
    assert list(single) == list(rows) and tables == []


def test_rows_over_other_lists_stand_in_tables_of_their_own() -> None:
    rows = {f"wraps.{k}": _row("Wrap", part("pulleys", k, "wraps")) for k in range(4)}
    rows |= {f"teeth.{k}": _row("Teeth", part("gears", k, "teeth")) for k in range(3)}
    _, tables = gathered(recorded(rows))
    assert [(table.family, list(table.columns)) for table in tables] == [("pulleys", ["wraps"]), ("gears", ["teeth"])]


def test_a_family_of_one_quantity_makes_a_table() -> None:
    paths = {f"wraps.{k}": _row("Wrap", part("wraps", k)) for k in range(3)}
    crossings = {f"turn_{k}": _row("Turn", part("turn", k - 1, number=k)) for k in range(1, 4)}
    _, tables = gathered(recorded(paths | crossings))
    assert [(t.family, t.listed, t.numbers, list(t.columns)) for t in tables] == [
        ("", True, [1, 2, 3], ["wraps"]), ("turn", False, [1, 2, 3], ["turn"]),
    ]  # fmt: skip


def test_no_rows_no_tables() -> None:
    assert gathered({}) == ({}, [])


def test_quantities_of_one_description_are_counted() -> None:
    rows = {f"ratio.{k}": _row("Ratio", part("gears", k, "ratio")) for k in range(2)}
    rows |= {f"shaft_{k}_speed": _row("Speed of the shaft", part("shaft", k - 2, "speed", k)) for k in (2, 3)}
    rows |= {"x.0": _row("Alone", part("posts", 0, "x")), "lone": shown_quantity(1.0, "m", "1", "Ratio")}
    assert counted(recorded(rows)) == {"ratio.0": 1, "ratio.1": 2, "shaft_2_speed": 2, "shaft_3_speed": 3}


# How steps of one line each share the lines of a sheet.


def row(description: str, value: str = "1 mm") -> ValueRow:
    """A step without its formula."""
    return ValueRow("A.1", description, Markup("a"), value, refers="B.12")


def test_short_steps_stand_two_by_two() -> None:
    assert [form for _, form in in_lines([row("Width")] * 4)] == [""] * 4


def test_beside_a_long_one_each_stands_in_a_line_of_its_own() -> None:
    long = row("Distance from the crank's support to the joint of the rocker in this position, in lengths of the crank")
    assert [form for _, form in in_lines([row("Width"), row("Width"), long])] == [ALONE] * 3


def test_a_wide_value_leaves_no_room_beside_it() -> None:
    assert [form for _, form in in_lines([row("Width"), row("Width", "1.234 567 890 1 N·m at 12 mm")])] == [ALONE] * 2


def test_every_step_is_kept_in_its_order() -> None:
    rows = [row("x" * length) for length in (3, 80, 12, 150, 30, 9, 60)]
    assert [each for each, _ in in_lines(rows)] == rows
