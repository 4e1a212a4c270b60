"""Constants that are named by what they are, and parameters that are named after letters, as they are printed."""

from __future__ import annotations

import pytest

from diecut_report.formulas.formula import formula
from diecut_report.formulas.tree import Node
from diecut_report.machine.printing.conversions import definitions
from diecut_report.machine.printing.substitution import _constant, _quantity


@formula(printed_as="inv")
def involute(alpha: float) -> float:
    """A formula of one angle, named in letters."""
    return 2.0 * alpha


@formula
def called(angle: float) -> float:
    """A formula that calls it, with a great number of its own."""
    return 1e6 * involute(angle)


@pytest.mark.parametrize(
    ("name", "value", "unit", "symbolic", "numeric"),
    [
        ("254 mm", 0.254, "m", ("254", "mm"), ("254", "mm")),
        ("700 MPa", 7e8, "Pa", ("700", "MPa"), ("700", "MPa")),
        ("1 in", 0.0254, "m", ("1", "in"), ("25.4", "mm")),  # not of SI: its number stands in the substituted formula
        ("p_G", 98100.0, "Pa", None, ("98.1", "kPa")),
    ],
)
def test_a_constant_stands_as_the_quantity_that_it_is(
    name: str, value: float, unit: str, symbolic: tuple[str, str] | None, numeric: tuple[str, str]
) -> None:
    found = _quantity(name)
    assert (found and found.args) == symbolic
    assert _constant(name, value, unit).args == numeric


def test_a_parameter_named_after_a_greek_letter_is_printed_as_it() -> None:
    (told,) = definitions(called.tree)
    assert told["defined"] == ["apply", "inv", ["sym", "α"]]
    assert "alpha" not in str(told)


def test_a_great_number_of_a_formula_has_no_row_of_zeros() -> None:
    assert called.tree.args[0] == Node("num", ("1e6",))
