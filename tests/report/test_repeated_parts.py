"""Quantities of repeated parts are gathered into tables, lone ones stay lines."""

from __future__ import annotations

from typing import Any

from diecut_report.report.chapters.repetition import counted, gathered
from diecut_report.results.mechanism_record import QuantityRecord
from tests.records import filled
from tests.report.made_results import inputs, outputs, part, quantity

Data = dict[str, Any]


def recorded(rows: Data) -> dict[str, QuantityRecord]:
    """The quantities of data that hold them."""
    return {name: filled(QuantityRecord, row) for name, row in rows.items()}


def _row(description: str, of: Data) -> Data:
    return quantity(1.0, "m", "1", description, part=of)


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
    rows = {f"angle_{n}": quantity(1.0, "rad", "1", f"End of phase {n}") for n in range(1, 5)}
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
    rows |= {"x.0": _row("Alone", part("posts", 0, "x")), "lone": quantity(1.0, "m", "1", "Ratio")}
    assert counted(recorded(rows)) == {"ratio.0": 1, "ratio.1": 2, "shaft_2_speed": 2, "shaft_3_speed": 3}
