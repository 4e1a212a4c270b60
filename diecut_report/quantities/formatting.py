"""Numbers as neutral texts (decimal point, ``1.2e-05``), rounded and in a display unit; their local form is the report's."""

from __future__ import annotations

import math
import re
from decimal import Decimal

from diecut_report.quantities.units import pretty, unit

DIGITS = 4
NAMED = re.compile(r"\{([\w.]+)(?::(up|down))?\}")  # what a message names: ``{id}``, rounded by ``{id:up}``


def number_text(value: float, digits: int = DIGITS) -> str:
    """Return a number with so many significant digits; whole numbers below a million stand as they are."""
    if abs(value - round(value)) <= 1e-12 * abs(value) and abs(value) < 1e6:
        return f"{round(value)}"
    exponent = math.floor(math.log10(abs(float(f"{value:.{digits - 1}e}"))))
    if -4 <= exponent < 6:
        return f"{value:.{max(digits - 1 - exponent, 0)}f}"
    mantissa, power = f"{value:.{digits - 1}e}".split("e")
    return f"{mantissa}e{int(power)}"


def outward(value: float, up: bool, digits: int = DIGITS) -> float:
    """Return a number with so many significant digits, not below itself (or not above): what advice names must be enough.

    Rounding of the last places of a double apart.
    """
    if value == 0 or not math.isfinite(value):
        return value
    step = 10.0 ** (math.floor(math.log10(abs(value))) - digits + 1)
    steps = math.ceil(value / step - 1e-9) if up else math.floor(value / step + 1e-9)
    return float(f"{steps * step:.15g}")


def below(value: float, digits: int = DIGITS) -> float:
    """Return a number above zero rounded down to so many significant digits, and less than itself."""
    return outward(value * (1 - 1e-9), up=False, digits=digits)


def shortest(value: float, digits: int = 6) -> str:
    """Return what was typed, without the noise of a unit conversion: as few digits as say it, else ``digits``."""
    short = f"{value:.15g}"
    return number_text(value, digits) if len(short.replace(".", "").lstrip("0-")) > digits else short


def shown(value: float, unit_text: str, digits: int = DIGITS) -> dict[str, str]:
    """Return an SI value as text in a display unit."""
    return {"text": number_text(value / unit(unit_text).factor, digits), "unit": unit_text}


def with_unit(text: str, display: str) -> str:
    """A number's text with its unit as one writes it: ``40 mm``, ``60°``, ``5``."""
    sign = pretty(display)
    return f"{text}{sign}" if sign == "°" else f"{text} {sign}".rstrip()


def rounded(value: float, unit_text: str, digits: int = DIGITS) -> str:
    """An SI value in a display unit with so many significant digits, whole or not: what two equal printed numbers share."""
    return f"{value / unit(unit_text).factor:.{digits - 1}e}"


def told(value: float, unit_text: str, digits: int = DIGITS, *, up: bool | None = None) -> str:
    """Return an SI value as one would say it, ``40 mm``; rounded up or down where ``up`` says so."""
    number = value / unit(unit_text).factor
    return with_unit(number_text(number if up is None else outward(number, up, digits), digits), unit_text)


def as_given(value: float, unit_text: str) -> str | float:
    """Return an SI value as a config gives it to a key of this unit, so that it is read back as the very same float.

    That is a text in SI; for pure numbers a bare number, or a text in the key's own unit (``12.5 %``) where it has one.
    """
    own = unit(unit_text)
    if own.si != "1":
        return f"{float(value)!r} {own.si}"
    return value if own.text == "1" else f"{_decimal_text(own.exactly(value))} {own.text}"


def _decimal_text(number: Decimal) -> str:
    """Return all digits of a number, without an exponent where it is of a usual size."""
    short = number.normalize()
    return f"{short:f}" if -6 <= short.adjusted() <= 15 else f"{short}"


def si(value: float, unit_text: str) -> float:
    """Return the SI value of a number in a unit."""
    return value * unit(unit_text).factor
