"""Inputs of a few repeated parts: a line for each quantity, a column for each part."""

from __future__ import annotations

from typing import Any

from diecut_report.report.chapters.repetition import FEWEST_GIVEN, gathered
from diecut_report.report.chapters.tables import Tables
from diecut_report.report.chapters.value_tables import RecordTable
from diecut_report.report.text import Catalogue
from diecut_report.results.mechanism_record import QuantityRecord
from tests.records import filled


def given(index: int, quantity: str, value: str, **more: Any) -> QuantityRecord:
    """An input of the part of a list."""
    found = {"value": value, "description": quantity, "unit": "1", "display": {"text": value, "unit": "1"}, "origin": "given",
             "part": {"family": "loads", "index": index, "quantity": quantity}} | more  # fmt: skip
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
