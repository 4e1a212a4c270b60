"""What leads from the units of a formula's numbers to those that a reader knows: rad/s to r/min, s to h, rad to degrees."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from diecut_report.contract.steps import Step
from diecut_report.engine.printing.substitution import Substitution, formula_unit
from diecut_report.expressions import Node
from diecut_report.expressions.tree import walk
from diecut_report.quantities.display import UNIT_DIGITS
from diecut_report.quantities.formatting import DIGITS, given_shown, number_text, rounded, shown
from diecut_report.quantities.units import unit

Item = dict[str, Any]
GIVES_ANGLES = ("arcsin", "arccos", "arctan", "arctan2")  # whose value is read in degrees as it stands


def bridged(substitution: Substitution, numeric: Node | None, target: float, result: Item) -> Item:
    """Return the result in the unit that the formula's numbers give it, where it is printed in another one (``bridge``)."""
    inside = formula_unit(result["unit"])
    if inside == result["unit"] or substitution.is_copy or substitution.in_degrees:
        return {}
    calls = {node.args[0] for node in walk(substitution.part.formula.tree) if node.op == "call"}
    in_rad = numeric is not None and any(node.op == "qty" and node.args[1] == "rad" for node in walk(numeric))
    if unit(inside).si == "rad" and not calls.isdisjoint(GIVES_ANGLES) and not in_rad:
        return {}
    return {"bridge": shown(target, inside, max(DIGITS, len(result["text"].strip("-0").replace(".", ""))))}


def conversions(substitution: Substitution, numeric: Node | None) -> Item:
    """Return for each quantity that stands in a formula in another unit than its own how the one follows from the other."""
    found = list(_conversions(substitution)) if numeric is not None and not substitution.is_copy else []
    return {"conversions": found} if found else {}


def _conversions(substitution: Substitution) -> Iterator[Item]:
    calc = substitution.calc
    for name, inside in substitution.numbers.items():
        display = substitution.display(name)
        if unit(display).si == "rad" or formula_unit(display) == display or inside.args[1] == display:
            continue
        declared, value = calc.step_or_input(name), substitution.value_of(name)
        told = _told(value, display, declared.digits) if isinstance(declared, Step) else given_shown(value, display)
        again = {"text": number_text(value / unit(inside.args[1]).factor, DIGITS), "unit": inside.args[1]}
        yield {"symbol": declared.symbol, "shown": told, "converted": again}


def _told(value: float, display: str, digits: int) -> dict[str, str]:
    """A number beside the one that it is converted to: where its unit asks for fewer digits it has the usual ones here, or they would differ."""
    if display not in UNIT_DIGITS:
        return shown(value, display, digits)
    return {"text": number_text(float(rounded(value, display))), "unit": display}
