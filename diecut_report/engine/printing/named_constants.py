"""Constants of a formula with numbers in, and the unit in which its numbers stand."""

from __future__ import annotations

import math
import re
from functools import cache

from diecut_report.expressions import Node
from diecut_report.quantities.display import easy_unit
from diecut_report.quantities.formatting import shortest
from diecut_report.quantities.units import unit

MOST_DIGITS = 17


@cache
def formula_unit(display: str) -> str:
    """Return the unit in which a number stands inside a formula: the display unit where it is a power of ten of SI, else SI."""
    own = unit(display)
    decade = math.log10(own.factor)
    return display if abs(decade - round(decade)) < 1e-12 else own.si


def beside_a_number(node: Node) -> list[str]:
    """Return what a comparison holds against a plain number: 0.99 < 0.995, not 99 % < 0.995."""
    _, *sides = node.args if node.op == "cmp" else ("",)
    is_number = any(side.op == "num" and float(side.args[0]) for side in sides)
    return [side.args[0] for side in sides if side.op == "sym"] if is_number else []


QUANTITY = re.compile(r"(\d+(?:\.\d+)?) (\S+)")  # a constant that is named by what it is: 254 mm


def as_quantity(symbol: str) -> Node | None:
    """Return a constant that is named by its number and its unit, as both; None for any other name."""
    found = QUANTITY.fullmatch(symbol)
    return Node("qty", found.groups()) if found else None


def constant_shown(symbol: str, value: float, declared: str) -> Node:
    """Return a constant of a formula: as it is named where its name is its quantity in SI's powers of ten, else in a unit easy to read."""
    named = as_quantity(symbol)
    if named and formula_unit(named.args[1]) == named.args[1]:
        return named
    display = easy_unit(value, declared)
    return Node("qty", (shortest(unit(display).from_si(value), MOST_DIGITS), display))
