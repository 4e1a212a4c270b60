"""A data file of the standard series that cannot be trusted is told, with what is wrong in it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from diecut_report.standards import standard_ids, standard_series, standard_series_by, standard_table
from diecut_report.standards.tables import StandardFault

GOOD: dict[str, Any] = {"title": "Rods", "unit": "mm", "sources": ["One", "Two"], "range": [1, 3], "values": [1, 2, 3]}
TABLE: dict[str, Any] = {"title": "Rods", "unit": "mm", "sources": ["One", "Two"], "table": {"a": 5, "b": 2.5, "c": 5}}
BY: dict[str, Any] = {
    "title": "Rods",
    "unit": "mm",
    "sources": ["One", "Two"],
    "left_out": "Much.",
    "by": {
        "a": {"values": [1, 2], "range": [1, 2]},
        "b": {"values": [4, 8], "range": [4, 8], "sources": ["Three", "Four"], "left_out": "More."},
    },
}
FAULTS = {
    "out of order": ({"values": [1, 3, 2], "range": [1, 2]}, "must ascend without repetition, but 2 follows 3"),
    "twice": ({"values": [1, 2, 2, 3]}, "must ascend without repetition, but 2 follows 2"),
    "range not met": ({"range": [1, 4]}, r"runs from 1 to 3, but its range is 1 to 4"),
    "no values": ({"values": []}, "has no values"),
    "text": ({"values": [1, "2", 3]}, "holds '2', which is not a number above 0"),
    "true": ({"values": [True, 2, 3]}, "holds True, which is not a number above 0"),
    "zero": ({"values": [0, 2, 3]}, "holds 0, which is not a number above 0"),
    "not a number": ({"values": [1, float("nan"), 3]}, "holds nan, which is not a number above 0"),
    "infinite": ({"values": [1, 2, float("inf")]}, "holds inf, which is not a number above 0"),
    "unknown unit": ({"unit": "furlongz"}, "has no usable unit: .*furlongz"),
    "one source": ({"sources": ["One"]}, "needs two sources that agree"),
    "the same source twice": ({"sources": ["One", "One"]}, "needs two sources that agree"),
    "no source": ({"sources": None}, "lacks sources"),
    "empty source": ({"sources": ["One", " "]}, "has an empty title or source"),
    "empty title": ({"title": ""}, "has an empty title or source"),
    "no title": ({"title": None}, "lacks title"),
    "no range": ({"range": None}, "lacks range"),
    "unknown key": ({"remark": "x"}, "has the unknown remark"),
    "a text as sources": ({"sources": "One, Two"}, "needs a list as sources"),
    "a number as values": ({"values": 3}, "needs a list as values"),
    "a number as title": ({"title": 3}, "needs a text as title"),
    "a range of three": ({"range": [1, 2, 3]}, "needs the first and the last value as range"),
    "a range of texts": ({"range": ["1", "3"]}, "needs numbers as range"),
    "a list by name": ({"values": None, "range": None, "by": [1]}, "needs a table of names as by"),
    "no form": ({"values": None}, "needs exactly one of values, table, by"),
    "two forms": ({"table": {}}, "needs exactly one of values, table, by"),
}


def write(folder: Path, id: str, data: dict[str, Any]) -> Path:
    (folder / f"{id}.json").write_text(json.dumps({k: v for k, v in data.items() if v is not None}), encoding="utf-8")
    return folder


def test_a_good_file_is_read(tmp_path: Path) -> None:
    series = standard_series("rods", write(tmp_path, "rods", GOOD))
    assert (series.id, series.title, series.unit, series.left_out) == ("rods", "Rods", "mm", "")
    assert (series.values, series.sources) == ((1.0, 2.0, 3.0), ("One", "Two"))


@pytest.mark.parametrize(("change", "told"), FAULTS.values(), ids=FAULTS)
def test_a_fault_of_a_file_is_told(tmp_path: Path, change: dict[str, Any], told: str) -> None:
    write(tmp_path, "rods", {**GOOD, **change})
    with pytest.raises(StandardFault, match=f"^Standard series 'rods' {told}"):
        standard_series("rods", tmp_path)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('{"title": "Rods",', "is not readable: Expecting"),
        ('{"title": "Rods", "title": "Tubes"}', "is not readable: 'title' stands twice in it"),
        ('{"table": {"a": 1, "a": 2}}', "is not readable: 'a' stands twice in it"),
        ("[1, 2]", "needs exactly one of"),
    ],
)
def test_a_file_that_is_no_object_of_different_names_is_told(tmp_path: Path, text: str, told: str) -> None:
    (tmp_path / "rods.json").write_text(text, encoding="utf-8")
    with pytest.raises(StandardFault, match=f"'rods' {told}"):
        standard_series("rods", tmp_path)


def test_an_unknown_id_names_the_known_ones() -> None:
    with pytest.raises(StandardFault, match=r"no standard series 'renard'; there are: .*renard_r10, renard_r20"):
        standard_series("renard")


def test_a_table_is_also_the_series_of_its_different_values(tmp_path: Path) -> None:
    write(tmp_path, "rods", TABLE)
    assert dict(standard_table("rods", tmp_path).values) == {"a": 5.0, "b": 2.5, "c": 5.0}
    assert standard_series("rods", tmp_path).values == (2.5, 5.0)


def test_a_bad_value_of_a_table_is_told(tmp_path: Path) -> None:
    write(tmp_path, "rods", {**TABLE, "table": {"a": -1}})
    with pytest.raises(StandardFault, match="'rods' holds -1, which is not a number above 0"):
        standard_table("rods", tmp_path)


def test_series_by_name_take_what_they_do_not_say_from_the_file(tmp_path: Path) -> None:
    parts = standard_series_by("rods", write(tmp_path, "rods", BY))
    assert {name: part.values for name, part in parts.items()} == {"a": (1.0, 2.0), "b": (4.0, 8.0)}
    assert (parts["a"].id, parts["a"].sources, parts["a"].left_out) == ("rods.a", ("One", "Two"), "Much.")
    assert (parts["b"].id, parts["b"].sources, parts["b"].left_out) == ("rods.b", ("Three", "Four"), "More.")


@pytest.mark.parametrize(
    ("part", "told"),
    [
        ({"values": [2, 1], "range": [2, 1]}, "must ascend"),
        ({"values": [1, 2]}, "lacks range"),
        ([1, 2], "must be a table of names"),
        ({"values": [1, 2], "range": [1, 2], "unit": "m"}, "has the unknown unit"),
        ({"values": [1, 2], "range": [1, 2], "sources": ["One"]}, "needs two sources"),
    ],
)
def test_a_fault_of_one_name_is_told_with_it(tmp_path: Path, part: Any, told: str) -> None:
    write(tmp_path, "rods", {**BY, "by": {"a": part}})
    with pytest.raises(StandardFault, match=rf"'rods\.a' {told}"):
        standard_series_by("rods", tmp_path)


def test_the_wrong_reader_is_told_which_is_right(tmp_path: Path) -> None:
    write(write(tmp_path, "rods", BY), "tubes", GOOD)
    with pytest.raises(StandardFault, match="'rods' holds one series for each name; use standard_series_by"):
        standard_series("rods", tmp_path)
    with pytest.raises(StandardFault, match="'tubes' is of the form 'values', not 'table'"):
        standard_table("tubes", tmp_path)
    with pytest.raises(StandardFault, match="'tubes' is of the form 'values', not 'by'"):
        standard_series_by("tubes", tmp_path)
    assert standard_ids("values", tmp_path) == ("tubes",)
