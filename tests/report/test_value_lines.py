"""How steps of one line each share the lines of a sheet."""

from __future__ import annotations

from markupsafe import Markup

from diecut_report.report.value_lines import ALONE, in_lines
from diecut_report.report.value_rows import ValueRow


def row(description: str, value: str = "1 mm") -> ValueRow:
    """A step without its formula."""
    return ValueRow("A.1", description, Markup("a"), value, refers="B.12")


def test_short_steps_stand_two_by_two() -> None:
    assert [form for _, form in in_lines([row("Width")] * 4)] == [""] * 4


def test_a_long_one_stands_alone_and_not_in_a_narrow_column() -> None:
    long = row("Distance from the crank's support to the joint of the rocker in this position, in lengths of the crank")
    assert [form for _, form in in_lines([row("Width"), row("Width"), long, row("Width"), row("Width")])] == [
        "", "", ALONE, "", "",
    ]  # fmt: skip


def test_a_last_one_without_a_neighbour_stands_alone() -> None:
    assert [form for _, form in in_lines([row("Width")] * 3)][-1:] in ([ALONE], [""])
    assert [form for _, form in in_lines([row("Width")])] == [ALONE]


def test_every_step_is_kept_in_its_order() -> None:
    rows = [row("x" * length) for length in (3, 80, 12, 150, 30, 9, 60)]
    assert [each for each, _ in in_lines(rows)] == rows
