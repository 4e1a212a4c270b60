"""Constants that are named by what they are, and parameters that are named after letters, as they are printed."""

from __future__ import annotations

from typing import Annotated

import numpy as np
import pytest

from diecut_report.api import Chapter, Constant, Inputs, Mechanism, Quantity
from diecut_report.formulas.formula import formula
from diecut_report.formulas.tree import Node
from diecut_report.machine.printing.page import definitions
from diecut_report.machine.printing.substitution import _constant, _quantity
from diecut_report.machine.steps.run import calculate
from diecut_report.results.mechanism import mechanism_results


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


class InCases(Inputs):
    """Inputs of a formula of cases."""

    strength: Annotated[float, Quantity("R_m", "MPa", "Strength", gt=0)]
    given: Annotated[float, Quantity("K_0", "1", "Factor, 0 where it is not given")] = 0


KPSI = Constant(6.894757e6, "1 kpsi", "Pa")
IN_CASES = Chapter("Cases")
IN_CASES.value("factor", "K", "1", "Factor",
               lambda strength, given: np.where(given > 0, given, 2 + 0.001 * strength / KPSI))  # fmt: skip


@pytest.mark.parametrize(("given", "printed"), [(0.0, ["900", "MPa", "6.894757"]), (1.5, ["1.5"])])
def test_with_numbers_only_the_case_that_holds_is_printed_and_a_constant_in_the_unit_beside_it(
    given: float, printed: list[str]
) -> None:
    mechanism = Mechanism(
        kind="cases", version="1", title="Cases", summary="Cases.", inputs=InCases, chapters=(IN_CASES,)
    )
    calc = calculate(mechanism, {"strength": 9e8, "given": given})
    (item,) = [
        each for section in mechanism_results(calc, {}).sections for each in section.items if each.id == "factor"
    ]
    symbolic, numbers = str(item.equation), str(item.substituted)
    assert "cases" in symbolic and "cases" not in numbers and "kPa" not in numbers
    assert all(f"'{each}'" in numbers for each in printed)
