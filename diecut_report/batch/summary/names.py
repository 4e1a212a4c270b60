"""How the summary calls quantities and prints their sizes."""

from __future__ import annotations

import math

from diecut_report.batch.stored import Column
from diecut_report.report.numbers import joined, number
from diecut_report.texts import number_text
from diecut_report.units import pretty, unit

DIGITS = 4


def named(column: Column) -> str:
    """A quantity by its path, without the word that all varied inputs begin with."""
    return column.name.removeprefix("mechanisms.")


def titled(column: Column) -> str:
    """A quantity with the unit that people read."""
    sign = pretty(column.display)
    return named(column) + (f", {sign}" if sign else "")


def breakable(name: str) -> str:
    """A name that may be broken between its parts."""
    return name.replace(".", ".\u200b").replace("_", "_\u200b")


def factor(column: Column) -> float:
    """Display units in an SI unit."""
    return 1.0 / unit(column.display).factor


def display(value: float, column: Column) -> str:
    """An SI value in the unit that people read, without the unit."""
    if not math.isfinite(value):
        return "–"
    return number(number_text(unit(column.display).from_si(value), DIGITS)) if value else "0"


def quantity(value: float, column: Column) -> str:
    """An SI value with the unit that people read."""
    return joined(display(value, column), pretty(column.display))


def counted(count: int, one: str, many: str = "") -> str:
    """A number with its noun."""
    return f"{number(str(count))} {one if count == 1 else many or one + 's'}"


def percent(part: float, whole: float) -> str:
    """A share; a small one that is not none does not print as 0."""
    share = 100.0 * part / whole if whole else 0.0
    return "< 0.1 %" if 0 < share < 0.1 else f"{share:.3g} %" if share < 99.95 or part == whole else "> 99.9 %"
