"""Mistakes with tables, series and axis ranges are told where they are declared, with what to write instead."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from diecut_report.api import (
    BarGroup,
    Bars,
    Block,
    Chapter,
    Inputs,
    Mechanism,
    Panel,
    Plot,
    Polar,
    Quantity,
    Series,
    Text,
    abscissa,
    interpolated,
    lookup,
    m,
    own_series,
    own_table,
    parts,
    pick,
    samples,
)
from diecut_report.config.plugins import Discovery
from diecut_report.declaration import faults
from diecut_report.errors import PluginError
from diecut_report.mechanism.names import Misdeclared

SOURCES = ("One", "Two")
BEARINGS = own_table(
    title="Bearings", columns={"bore": "mm", "C": "kN"}, rows={"small": (20, 13.5), "big": (25, 14.8)}, sources=SOURCES
)
ALIKE = own_table(
    title="Alike", columns={"bore": "mm", "C": "kN"}, rows={"small": (20, 13.5), "big": (20, 14.8)}, sources=SOURCES
)
ONLY_SMALL = own_table(title="Small", unit="mm", rows={"small": 20}, sources=SOURCES)
FACTORS = own_table(title="Factors", columns={"teeth": "1", "Y": "1"}, rows=((12, 0.2), (15, 0.3)), sources=SOURCES)
LIFTS = own_table(title="Lifts", columns={"turn": "deg", "lift": "mm"}, rows=((0, 0), (90, 1)), sources=SOURCES)
RODS = own_series(title="Rods", unit="mm", values=(1, 2), sources=SOURCES)


class Wheel(Block):
    width = Quantity("b_i", "mm", "Width of a wheel", optional=True)


class Shaft(Inputs):
    bearing = Text("Bearing", ("small", "big"), default="small")
    teeth = Quantity("z", "1", "Teeth", default=13)
    length = Quantity("l", "mm", "Length", default=13)
    bore = Quantity("d_g", "mm", "Bore", optional=True)
    count = Quantity("z_x", "1", "Count", optional=True)
    force = Quantity("F", "N", "Force", optional=True)
    wheels = parts(Wheel, "Wheels", optional=True)
    n_points = samples(36)


def told(declare: Callable[[Chapter], None], *figures: Any) -> list[str]:
    chapter = Chapter("All")
    declare(chapter)
    mechanism = Mechanism(
        kind="shaft", version="1", title="Shaft", summary="", inputs=Shaft, chapters=(chapter,), figures=figures
    )
    return [str(fault) for fault in faults(mechanism)]


def row_of(table: Any = BEARINGS, **more: Any) -> Callable[[Chapter], None]:
    wanted = {"by": "bearing", "column": "bore", **more}
    return lambda chapter: chapter.add(lookup(table, **wanted).step("d", "d", "mm", "Bore"))


def by_number(table: Any, by: str, **more: Any) -> Callable[[Chapter], None]:
    """A row by a number: an input, what is calculated, what is picked from the table and from elsewhere."""

    def declare(chapter: Chapter) -> None:
        chapter.twice = 2 * m.teeth, "2z", "1", "Twice the teeth"
        chapter.own_teeth = pick("above", of="teeth", series=FACTORS.series("teeth")), "z_o", "1", "Teeth of the table"
        chapter.given_teeth = (
            pick("above", of="teeth", series=FACTORS.series("teeth"), given="count"),
            "z_g",
            "1",
            "Teeth, given or picked",
        )
        chapter.other_teeth = pick("above", of="teeth", series=(12, 13)), "z_e", "1", "Teeth of elsewhere"
        unit, column = ("1", "Y") if table is FACTORS else ("kN", "C")
        chapter.found = lookup(table, by, column=column, **more), "f", unit, "Found"

    return declare


def between(table: Any = FACTORS, of: str = "teeth", unit: str = "1", **more: Any) -> Callable[[Chapter], None]:
    def declare(chapter: Chapter) -> None:
        chapter.twice = 2 * m.teeth, "2z", "1", "Twice the teeth"
        chapter.turn = abscissa(period=2 * np.pi), "φ", "deg", "Turn"
        chapter.y = interpolated(table, of, **more), "Y", unit, "Factor"

    return declare


def picked(series: Any, of: str = "length") -> Callable[[Chapter], None]:
    return lambda chapter: chapter.add(pick("above", of, series).step("rod", "r", "mm", "Rod"))


MISTAKES = {
    "a column that is not there": (row_of(column="bores"), "The table “Bearings” has no column 'bores'; it has bore, C"),
    "no column named": (row_of(column=""), "has several columns; name one; it has bore, C"),
    "a column of a plain table": (row_of({"small": 1.0, "big": 2.0}), "names the column bore, but its table has none"),
    "a column in another unit": (row_of(column="C"), "the column C of the table is in kN, the step in mm"),
    "a table of numbers by a text": (row_of(FACTORS, column="Y"), "by is bearing, a text; a number or a row over repeated parts is wanted"),
    "a table of names by a number": (row_of(by="length"), "for a number name the column that it is sought in, sought_in"),
    "a column to seek in that is not there": (by_number(BEARINGS, "length", sought_in="bor"), "has no column 'bor'; it has bore, C"),
    "a column to seek in, in another unit": (by_number(BEARINGS, "teeth", sought_in="bore"), "the column bore of the table is in mm, teeth in 1"),
    "a number that two rows have": (by_number(ALIKE, "length", sought_in="bore"), "the table “Alike”, which has a number twice"),
    "no key of a number that may be none of the table": (by_number(FACTORS, "twice"), "which may be a number that the table does not have"),
    "no key of what is picked elsewhere": (by_number(FACTORS, "other_teeth"), "takes other_teeth, which may be a number"),
    "no key of what may be given": (by_number(FACTORS, "given_teeth"), "takes given_teeth, which may be a number"),
    "a key of a text": (row_of(key="length"), "names the key length, but its row is that of a text"),
    "a text without a row": (row_of(ONLY_SMALL, column=""), "has no row in the table for bearing=big"),
    "given that is not an input": (row_of(given="boer"), "given is boer, which is not an input that is a number (did you mean 'bore'?)"),
    "given that is a text": (row_of(given="bearing"), "given is bearing, which is not an input that is a number"),
    "given that is always there": (row_of(given="length"), "given is length, which is always there; let it be float | None"),
    "given in another unit": (row_of(given="force"), "given, force, is in N, the step in mm"),
    "given of parts, a text of none": (row_of(given="wheels.width"), "both must be inputs of one list, or of none"),
    "the step in another unit than the column": (between(unit="mm"), "the column Y of the table is in 1, the step in mm"),
    "another quantity than the table goes by": (between(of="length"), "the column teeth of the table is in 1, length in mm"),
    "no key of what is calculated": (between(of="twice"), 'takes twice, which may lie outside of the table; name the input'),
    "a key that is not there": (between(of="twice", key="tooth"), "key is tooth, which is not an input (did you mean 'teeth'?)"),
    "a turn of which the table has a quarter": (between(LIFTS, "turn", "mm"), "takes turn, which may lie outside of the table"),
    "a quantity that is not there": (between(of="tooth"), "takes tooth, which nothing gives"),
    "a series in another unit": (picked(RODS, "teeth"), "the series “Rods” is in mm, teeth in 1"),
    "a table as a series": (picked(BEARINGS), "takes from a table; name its column, table.series(…)"),
}  # fmt: skip


@pytest.mark.parametrize(("declare", "words"), MISTAKES.values(), ids=MISTAKES)
def test_a_mistake_is_told_with_its_place(declare: Callable[[Chapter], None], words: str) -> None:
    found = told(declare)
    assert any(words in text for text in found), found
    assert all(text.startswith("test_tables.py:") for text in found)


@pytest.mark.parametrize(
    ("table", "column", "words"),
    [
        (BEARINGS, "bore", "“Bearings” goes by names; one that goes by numbers is needed"),
        (FACTORS, "X", "has no column 'X'; it has teeth, Y"),
        (FACTORS, "teeth", "goes by teeth; take another column"),
        ({1: 2}, "", "is not a table; write one with own_table"),
    ],
)
def test_what_cannot_be_gone_between_is_told_at_once(table: Any, column: str, words: str) -> None:
    with pytest.raises(Misdeclared, match=rf"test_tables\.py:\d+: step y: .*{words}"):
        told(between(table, column=column))


@pytest.mark.parametrize(
    "declare",
    [
        row_of(),
        row_of(given="bore"),
        by_number(FACTORS, "teeth"),
        by_number(FACTORS, "own_teeth"),
        by_number(FACTORS, "twice", key="teeth"),
        by_number(BEARINGS, "length", sought_in="bore"),
        between(),
        between(of="twice", key="teeth"),
        picked(RODS),
        picked(BEARINGS.series("bore")),
    ],
)
def test_what_is_sound_is_not_told(declare: Callable[[Chapter], None]) -> None:
    assert told(declare) == []


RANGES = {
    "one end": (0, "has the range 0 in the panel 'Sine'; write its two ends, (0, None)"),
    "ends that fall": ((1, 0), "has the range (1, 0) in the panel 'Sine', whose ends do not ascend"),
    "an id that is not there": ((0, "tooth"), "draws tooth, which nothing gives"),
    "an id in another unit": ((0, "length"), "draws length, in mm, on an axis in 1"),
    "a curve": (("sine", None), "a number is wanted there"),
}


def turned(limits: Any) -> list[str]:
    def declare(chapter: Chapter) -> None:
        chapter.turn = abscissa(period=2 * np.pi), "φ", "deg", "Turn"
        chapter.sine = np.sin(m.turn), "s", "1", "Sine"

    panel = Panel("Sine", "1", series=(Series("sine", "s"),), range=limits)
    return told(declare, Plot("p", "P", "", abscissa="turn", panels=(panel,)))


@pytest.mark.parametrize(("limits", "words"), RANGES.values(), ids=RANGES)
def test_a_range_that_is_none_is_told(limits: Any, words: str) -> None:
    assert any(words in text for text in turned(limits)), turned(limits)


def test_a_sound_range_is_not_told() -> None:
    assert turned((-1, None)) == turned((None, "teeth")) == turned((None, None)) == []


def test_ranges_of_polar_diagrams_and_of_bars_are_judged_too() -> None:
    def declare(chapter: Chapter) -> None:
        chapter.turn = abscissa(period=2 * np.pi), "φ", "deg", "Turn"
        chapter.sine = np.sin(m.turn), "s", "1", "Sine"

    def drawn(limits: Any) -> list[str]:
        series, bars = (Series("sine", "s"),), (("z", "teeth"),)
        polar = Polar("p", "P", "", abscissa="turn", unit="1", series=series, range=limits)
        group = BarGroup("G", "1", bars=bars, range=limits)
        return told(declare, polar, Bars("b", "B", "", groups=(group,)))

    assert drawn((0, None)) == drawn(("teeth", None)) == drawn(None) == []
    of_polar, of_bars = drawn((2, 1))
    assert "figure p: has the range (2, 1), whose ends do not ascend" in of_polar
    assert "figure b: has the range (2, 1) in the group 'G', whose ends do not ascend" in of_bars
    (below,) = drawn((-1, None))
    assert "has the range (-1, None), but no distance from the pole is below zero" in below
    assert all("draws length, in mm, on an axis in 1" in text for text in drawn(("length", 1)))


PLUGIN = """
from typing import Annotated
from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, interpolated, table_beside

class Own(Inputs):
    teeth = Quantity("z", "1", "Teeth", default=13)

all_ = Chapter("All")
all_.y = interpolated(table_beside(__file__, "factors.yaml"), of="teeth"), "Y", "1", "Factor"
MECHANISM = Mechanism(kind="own", version="1", title="Own", summary="", inputs=Own, chapters=(all_,))
"""
TABLE = "title: Factors\ncolumns: {teeth: '1', Y: '1'}\nsources: [One, Two]\nrows: [[12, 0.2], [15, 0.3]]\n"


def _read_anew(folder: Path) -> None:
    """Load the plugin as another run of the program does."""
    for name in [name for name in sys.modules if name.startswith("diecut_report_local_") and name.endswith("_own")]:
        del sys.modules[name]
    Discovery([folder]).mechanism("own")


def test_a_file_beside_a_plugin_is_judged_again_when_it_changes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    (tmp_path / "own.py").write_text(PLUGIN, "utf-8")
    (tmp_path / "factors.yaml").write_text(TABLE, "utf-8")
    _read_anew(tmp_path)
    (tmp_path / "factors.yaml").write_text(TABLE.replace("Y: '1'", "Y: mm"), "utf-8")
    with pytest.raises(PluginError, match="the column Y of the table is in mm, the step in 1"):
        _read_anew(tmp_path)
    (tmp_path / "factors.yaml").write_text(TABLE.replace("15", "11"), "utf-8")
    with pytest.raises(
        PluginError,
        match=r"factors\.yaml:4: The table “Factors” must ascend in teeth without repetition, but 11 follows 12\.$",
    ):
        _read_anew(tmp_path)
