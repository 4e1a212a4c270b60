"""The tables of the cyclogram against the numbers of its method."""

from __future__ import annotations

import math
import re
from math import degrees
from typing import Any

import pytest

from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.figure_views import figures
from diecut_report.results.mechanism import mechanism_results
from tests.plugins.test_cyclogram import example, locks, press

NEAR = 6e-5


def rows(transport: str, name: str, which: str = "cutting passing") -> list[list[Any]]:
    """The rows of a table."""
    found = mechanism_results(example(transport, which), {}).listings[name]
    assert all(len(row) == len(found.columns) for row in found.rows)
    return list(found.rows)


MARGINS = {
    "feeder": [(-23.8309, -6.8923), (7.0202, -23.8309), (13.7269, 24.7424), (12.6172, 6.8388)],
    "cross": [(19.0583, 30.2185), (49.9093, 13.2799), (12.4370, 29.2308), (11.3273, 11.3273)],
}


@pytest.mark.parametrize("transport", MARGINS)
def test_the_margins_of_each_interval_are_those_of_the_method(transport: str) -> None:
    found = sorted((round(degrees(row[3]), 3), degrees(row[3]), degrees(row[4])) for row in rows(transport, "margins"))
    told = sorted((round(pair[0], 3), *pair) for pair in MARGINS[transport])
    for (_, *own), (_, *wanted) in zip(found, told, strict=True):
        assert own == pytest.approx(wanted, abs=NEAR)
    for row in rows(transport, "margins"):
        assert [1000 * time for time in row[5:]] == pytest.approx([degrees(angle) * 600 / 360 for angle in row[3:5]])


PHASES = {
    "drive.forward": [(37.6086, 406.1661)],
    "drive.cutting": [(117.1747, 307.8979), (508.0258, 684.8365)],
    "drive.contact": [(111.7238, 314.1021), (501.5482, 689.5301)],
    "drive.carriage_window": [(10.6152, 65.6176), (369.5054, 443.5212)],
}
TIMES = {
    "drive.contact": [337.2972, 313.3031],
    "drive.carriage_window": [91.6708, 123.3596],
    "drive.forward": [614.2625],
}


def test_the_phases_on_the_main_shaft_are_those_of_the_method() -> None:
    table = rows("cross", "main_phases")
    for phase, wanted in PHASES.items():
        found = [(degrees(row[3]), degrees(row[4])) for row in table if row[0] == phase]
        assert [edge for each in found for edge in each] == pytest.approx(
            [e for each in wanted for e in each], abs=2e-4
        )
    for phase, times in TIMES.items():
        assert [1000 * row[7] for row in table if row[0] == phase] == pytest.approx(times, abs=2e-4)
    assert {row[2] for row in table if row[0] == "cross.passing"} == {"moving"}


def test_a_phase_is_told_in_words_and_none_twice() -> None:
    table = rows("cross", "main_phases")
    told = {row[0]: row[1] for row in table}
    assert told["drive.cutting"] == "drive: Cutting" and told["cross.passing"] == "cross: passing"
    assert "drive.cutting_forward" not in told and "drive.carriage_window_outer" not in told
    places = [(row[0].split(".")[0], row[2], *row[3:5]) for row in table]
    assert len(places) == len(set(places))


def test_all_offsets_that_leave_the_margins_are_told() -> None:
    (line, *ends), *others = rows("cross", "offsets", "contact passing")
    assert (line, others) == ("cross", [])
    assert [degrees(end) for end in ends] == pytest.approx([29.5301, 49.4437], abs=NEAR)
    assert rows("feeder", "offsets") == []


def test_a_length_is_told_only_where_one_window_holds_an_interlock() -> None:
    outputs = mechanism_results(press("feeder", locks("contact passing", "feeder")), {}).outputs
    assert degrees(outputs["needed_length.0"].value) == pytest.approx(217.8062, abs=NEAR)
    assert "needed_length.1" not in outputs


def drawn(name: str, transport: str = "feeder", which: str = "cutting passing") -> FigureRecord:
    """A figure of the press with this transport."""
    found = {figure.id: figure for figure in figures(example(transport, which))}
    assert "error" not in found[name]
    return found[name]


def shapes(name: str) -> list[dict[str, Any]]:
    """The shapes of a figure of the press with the cam-gear transport."""
    return list(drawn(name).shapes)


def test_lines_at_the_ends_of_the_offsets_say_which_end_they_are() -> None:
    told = str(drawn("ways", "cross", "contact passing"))
    assert re.findall(r"'((?:from|to) [^']*)'", told) == ["from 29.53°", "to 49.44°"]


def test_the_dwell_is_shaded_and_interlocks_are_brackets_with_their_margins() -> None:
    drawn = shapes("cyclogram")
    shades = [shape.points for shape in drawn if getattr(shape, "role", "") == "shade"]
    edges = sorted(90 * points[0][0] for points in shades)  # 720 degrees are 8 wide
    assert edges == pytest.approx([141.0056, 501.0056], abs=1e-3)
    brackets = [shape.points for shape in drawn if getattr(shape, "role", "") == "mark"]
    assert [90 * points[0][0] for points in brackets[:2]] == pytest.approx([117.1747, 508.0258], abs=1e-3)
    texts = {shape.text for shape in drawn if shape.shape == "label"}
    assert {"-23.83°, -6.892°", "12.62°, 6.839°"} <= texts


def test_a_ring_stands_for_each_line() -> None:
    drawn = shapes("rings")
    assert sum(shape.shape == "circle" for shape in drawn) == 2
    rests = [shape.end - shape.start for shape in drawn if getattr(shape, "role", "") == "outline"]
    assert rests.count(pytest.approx(math.radians(160 / 2))) >= 2  # the dwell of either sheet: two are once round
