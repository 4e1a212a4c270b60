"""Numbers as neutral texts (decimal point, ``1.2e-05``), rounded and in a display unit; their local form is the report's."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from decimal import Decimal

from diecut_report.quantities.display import UNIT_DIGITS, finest_step, is_nothing, meant_digits
from diecut_report.quantities.units import pretty, unit

DIGITS = 4
PLACE_DIGITS = 6  # of a place on an abscissa, at most
EXACT = 1e-12  # relative: the rounding of the computer
TYPED = 12  # digits: a number with no more of them is one that somebody typed
NAMED = re.compile(r"\{([\w.]+)(?::(up|down))?\}")  # what a message names: ``{id}``, rounded by ``{id:up}``


def number_text(value: float, digits: int = DIGITS) -> str:
    """Return a number with so many significant digits; whole numbers below a million stand as they are.

    Fewer digits than usual are so many before the decimal sign, too: a life of 173 102.3 h is one of 173 000 h.
    Zeros at its end stand only where they say something: 0.8550 is rounded, 0.5 is not.
    """
    if abs(value - round(value)) <= EXACT * abs(value) and abs(value) < 1e6:
        return f"{round(value)}"
    exponent = math.floor(math.log10(abs(float(f"{value:.{digits - 1}e}"))))
    if digits < DIGITS and digits <= exponent < 6:
        return f"{round(value, digits - 1 - exponent):.0f}"
    if -4 <= exponent < 6:
        return _without_zeros(f"{value:.{max(digits - 1 - exponent, 0)}f}", value)
    mantissa, power = f"{value:.{digits - 1}e}".split("e")
    return f"{_without_zeros(mantissa, value, f'e{int(power)}')}e{int(power)}"


def _without_zeros(text: str, value: float, power: str = "") -> str:
    """A decimal text without the zeros at its end, where it is the value itself and not a rounding of it."""
    is_exact = "." in text and abs(float(text + power) - value) <= EXACT * abs(value)
    return text.rstrip("0").rstrip(".") if is_exact else text


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
    return number_text(value, digits) if len(short.replace(".", "").lstrip("0-")) > max(digits, TYPED) else short


def shown(value: float, unit_text: str, digits: int = DIGITS) -> dict[str, str]:
    """Return an SI value as text in a display unit: of its digits those that mean something, rounding of the computer as zero.

    Where other than the usual number of digits is asked for, they all stand.
    """
    if is_nothing(value, unit_text):
        return {"text": "0", "unit": unit_text}
    return {
        "text": number_text(unit(unit_text).from_si(value), shown_digits(value, unit_text, digits)),
        "unit": unit_text,
    }


def place_shown(value: float, unit_text: str, more: int = 0) -> dict[str, str]:
    """Return a place on an abscissa as text: with up to six digits, of which those stand that mean something, and so many more."""
    return shown(value, unit_text, min(meant_digits(value, unit_text, PLACE_DIGITS) + more, PLACE_DIGITS))


def listed_text(value: float, unit_text: str, digits: int = 6) -> str:
    """Return an SI value among others of a column: to the step that can be made or measured, so that all have as many decimals."""
    number, step = value / unit(unit_text).factor, finest_step(unit_text)
    if step is None:
        return number_text(number, digits)
    text = f"{number:.{max(-math.floor(math.log10(step) + EXACT), 0)}f}"
    short = text.rstrip("0").rstrip(".") if "." in text else text
    return "0" if short == "-0" else short


def given_shown(value: float, unit_text: str) -> dict[str, str]:
    """Return an input as text in a display unit: as it was typed, or rounded as a result is where it follows from one."""
    short = f"{unit(unit_text).from_si(value):.15g}"
    is_typed = len(short.replace(".", "").lstrip("0-")) <= TYPED
    return {"text": short, "unit": unit_text} if is_typed else shown(value, unit_text)


def shown_digits(value: float, unit_text: str, digits: int = DIGITS) -> int:
    """Return with how many significant digits an SI value is shown, of which so many are asked for."""
    return meant_digits(value, unit_text, UNIT_DIGITS.get(unit_text, digits)) if digits == DIGITS else digits


def author_digits(value: float, unit_text: str, digits: int) -> int:
    """Return how many of the digits that a plugin asks for are shown: of an angle or a pure number all, of a length none finer than it is made."""
    return digits if finest_step(unit(unit_text).si) is None else meant_digits(value, unit_text, digits)


def with_unit(text: str, display: str) -> str:
    """A number's text with its unit as one writes it: ``40 mm``, ``60°``, ``5``."""
    sign = pretty(display)
    return f"{text}{sign}" if sign == "°" else f"{text} {sign}".rstrip()


def rounded(value: float, unit_text: str, digits: int = DIGITS) -> str:
    """An SI value in a display unit with so many significant digits, whole or not: what two equal printed numbers share."""
    return f"{value / unit(unit_text).factor:.{digits - 1}e}"


def told(
    value: float, unit_text: str, digits: int = DIGITS, *, up: bool | None = None, listed: Sequence[float] = ()
) -> str:
    """Return an SI value as one would say it, ``40 mm``; rounded up or down where ``up`` says so.

    ``listed`` are the only numbers that there are, in this unit: the next of them above or below, or the nearest; beyond them the number itself.
    """
    number = value / unit(unit_text).factor
    allowed = [
        each for each in listed if up is None or math.isclose(each, number, rel_tol=1e-9) or bool(each > number) is up
    ]
    if allowed:
        return with_unit(number_text(min(allowed, key=lambda each: abs(each - number)), digits), unit_text)
    return with_unit(number_text(number if up is None else outward(number, up, digits), digits), unit_text)


def as_given(value: float, unit_text: str) -> str | float:
    """Return an SI value as a config gives it to a key of this unit, so that it is read back as the very same float.

    That is a text in SI; for pure numbers a bare number, or a text in the key's own unit (``12.5 %``) where it has one.
    """
    own = unit(unit_text)
    if own.si != "1":
        return f"{float(value)!r} {own.si}"
    return value if own.text == "1" else f"{_decimal_text(own.exactly(value))} {own.text}"


def as_typed(value: float, unit_text: str) -> str | float:
    """Return an SI value as a designer types it, ``55.3 mm``: with as few digits as are read back as the very same float."""
    own = unit(unit_text)
    if own.text == "1":
        return value
    short = own.from_si(value)
    for digits in range(1, 18):
        number = Decimal(f"{short:.{digits}g}")
        if own.to_si(number) == value:
            return f"{_decimal_text(number)} {own.text}"
    return as_given(value, unit_text)


def _decimal_text(number: Decimal) -> str:
    """Return all digits of a number, without an exponent where it is of a usual size."""
    short = number.normalize()
    return f"{short:f}" if -6 <= short.adjusted() <= 15 else f"{short}"


def si(value: float, unit_text: str) -> float:
    """Return the SI value of a number in a unit."""
    return value * unit(unit_text).factor
