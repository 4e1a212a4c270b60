"""Quantities of like parts are gathered into tables, lone ones stay lines."""

from __future__ import annotations

from typing import Any

import pytest

from diecut_report.report.repeated_parts import counted, gathered, place
from tests.report.made_results import inputs, outputs, quantity

Data = dict[str, Any]


def _rows(*names: str, description: str = "Speed") -> Data:
    return {name: quantity(1.0, "m", "1", description) for name in names}


@pytest.mark.parametrize(("name", "found"), [
    ("gears.0.driver_teeth", ("gears", 0, "driver_teeth", 0)), ("toothed_belt.pulleys.11.x", ("toothed_belt.pulleys", 11, "x", 0)),
    ("wraps.2", ("wraps", 2, "", 0)), ("shaft_3_speed", ("shaft", 3, "speed", 1)), ("torque_reversal_1", ("torque_reversal", 1, "", 1)),
    ("vbelt.section", None), ("radius", None),
])  # fmt: skip
def test_place_of_a_quantity(name: str, found: tuple[str, int, str, int] | None) -> None:
    assert place(name) == found


def test_lists_of_three_parts_and_more_make_a_table() -> None:
    single, [table] = gathered(inputs())
    assert list(single) == ["vbelt.section", "law", "speed", "gears.0.teeth", "gears.1.teeth"]
    assert table.family == "belt.pulleys" and table.listed
    assert table.numbers == [1, 2, 3, 4, 5]
    assert list(table.columns) == ["radius", "side", "mass"]
    assert list(table.columns["mass"]) == [4]


def test_rows_of_results_and_numbered_names_make_tables() -> None:
    single, tables = gathered(outputs())
    assert list(single) == ["radius", "ratios.0", "ratios.1"]
    assert [(t.family, t.listed, t.numbers, list(t.columns)) for t in tables] == [
        ("", True, [1, 2, 3, 4, 5], ["wraps", "arcs"]), ("shaft", False, [3, 4, 5, 6], ["speed", "torque"]),
    ]  # fmt: skip


def test_nothing_is_told_twice_and_nothing_is_lost() -> None:
    for rows in (inputs(), outputs()):
        single, tables = gathered(rows)
        told = [name for table in tables for column in table.columns.values() for name, _ in column.values()]
        assert sorted([*single, *told]) == sorted(rows)


def test_numbered_names_of_different_quantities_stay_lines() -> None:
    rows = {f"angle_{n}": quantity(1.0, "rad", "1", f"End of phase {n}") for n in range(1, 5)}
    single, tables = gathered(rows)
    assert list(single) == list(rows) and tables == []


def test_rows_of_unlike_length_stand_in_tables_of_their_own() -> None:
    rows = _rows(*(f"wraps.{k}" for k in range(4))) | _rows(*(f"teeth.{k}" for k in range(3)))
    _, tables = gathered(rows)
    assert [list(table.columns) for table in tables] == [["wraps"], ["teeth"]]


def test_no_rows_no_tables() -> None:
    assert gathered({}) == ({}, [])


def test_quantities_of_one_description_are_counted() -> None:
    rows = (
        _rows("ratio.0", "ratio.1")
        | _rows("shaft_2_speed", "shaft_3_speed", description="Speed of the shaft")
        | _rows("x.0", description="Alone")
    )
    assert counted(rows) == {"ratio.0": 1, "ratio.1": 2, "shaft_2_speed": 2, "shaft_3_speed": 3}
