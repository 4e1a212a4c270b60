"""Printed numbers of a source are held against the calculated ones within their last digit."""

from __future__ import annotations

import pytest

from diecut_report.testing.machines import calculate, load
from diecut_report.testing.values import PrintedValue, compare
from tests.configs import GOOD

FOUND = calculate(
    load("lever", GOOD), {"force": "2 kN", "arm": "152.35 mm", "width": "20 mm", "speed": "10 rpm"}
)  # 304.7 N·m


@pytest.mark.parametrize(
    ("printed", "agrees"),
    [
        ("304.7 N*m", True), ("304.70 N*m", True), ("305 N*m", True), ("304 N*m", False), ("0.3 kN*m", True),
        ("3.05e2 N*m", True), ("3.0e2 N*m", True), ("3.1e2 N*m", False), ("0.305 kN*m", True), ("−304.7 N*m", False),
    ],
)  # fmt: skip
def test_a_number_agrees_when_ours_rounds_to_it(printed: str, agrees: bool) -> None:
    found = compare(FOUND, {"moment": printed})
    assert found[0].agrees is agrees and found.agree is agrees


def test_the_table_names_each_number_with_its_difference() -> None:
    found = compare(FOUND, {"moment": PrintedValue("300 N*m", place="eq. 3"), "pressure": "0.66 MPa"})
    assert found[0].difference == pytest.approx(4.7 / 300)
    assert str(found) == (
        "→ moment (eq. 3): printed 300 N·m, calculated 304.7 N·m, differs by +4.7 N·m (+1.57%)\n"
        "  pressure: printed 0.66 MPa, calculated 0.65638 MPa, agrees"
    )
    with pytest.raises(AssertionError, match="→ moment"):
        assert found.agree, str(found)


def test_a_difference_in_the_last_digits_is_seen() -> None:
    assert str(compare(FOUND, {"moment": "304.7002 N*m"})) == (
        "→ moment: printed 304.7002 N·m, calculated 304.7 N·m, differs by -0.0002 N·m (-0.00%)"
    )
    assert "calculated 0.65638333 MPa" in str(compare(FOUND, {"pressure": "0.656381 MPa"}))
    assert "printed 0 N·m, calculated 304.7 N·m, differs by +305 N·m" in str(compare(FOUND, {"moment": "0 N*m"}))


def test_a_difference_whose_reason_is_known_is_expected_and_no_other() -> None:
    mistake = PrintedValue("300 N*m", why="the source takes an arm of 150 mm")
    assert compare(FOUND, {"moment": mistake}).agree
    assert "differs by +4.7 N·m (+1.57%): the source takes an arm" in str(compare(FOUND, {"moment": mistake}))
    mended = compare(FOUND, {"moment": PrintedValue("304.7 N*m", why="the source takes an arm of 150 mm")})
    assert not mended.agree and "though a reason is told why not: take it away" in str(mended)


def test_what_is_not_a_printed_number_is_told() -> None:
    with pytest.raises(ValueError, match="moment: 'about 3 N' is not a printed number with its unit, such as"):
        compare(FOUND, {"moment": "about 3 N"})
    with pytest.raises(ValueError, match="moment is in N·m, which is not of the kind of mm"):
        compare(FOUND, {"moment": "300 mm"})
