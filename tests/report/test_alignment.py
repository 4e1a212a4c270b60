"""Columns aligned on the decimal sign."""

from __future__ import annotations

import pytest

from diecut_report.report.text import rooms


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
