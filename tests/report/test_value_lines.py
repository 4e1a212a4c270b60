"""How steps of one line each share the lines of a sheet."""

from __future__ import annotations

from markupsafe import Markup

from diecut_report.report.chapters.value_tables import ValueRow
from diecut_report.report.model import ALONE, in_lines


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
