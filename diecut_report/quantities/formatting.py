"""Numbers as neutral texts (decimal point, ``1.2e-05``), rounded and in a display unit; their local form is the report's."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from decimal import Decimal
from functools import cache

from diecut_report.quantities.units import pretty, unit

# How a value is shown where nobody chose its unit: in the unit of its family in which it is easy to read, and no finer than it means.


EASY_FROM, EASY_BELOW = 0.1, 1e4  # a number is easy to read from the one to below the other
FAMILIES = (
    ("um", "mm", "m"),
    ("N", "kN", "MN"),
    ("Pa", "kPa", "MPa", "GPa"),
    ("W", "kW", "MW"),
    ("J", "kJ", "MJ"),
    ("us", "ms", "s"),
    ("N*m", "kN*m", "MN*m"),
    ("g", "kg", "t"),
    ("mm/s", "m/s"),
)
FORCES = (("N", 1e3), ("kN", 1e7), ("MN", math.inf))  # the least, N, that is told in a greater unit
"""Forces go from one mechanism to the next: each is told in the unit of its size, whatever a chapter declares, so that all tell it alike."""
# The finest step of a machine's quantity that can be made or measured, SI.
STEPS = {
    "m": 1e-6, "s": 1e-4, "kg": 1e-3, "N": 0.1, "m/s": 1e-3, "K": 0.1,
}  # fmt: skip
UNIT_STEPS = {"deg": 0.01, "%": 0.01}  # of these units alone: a small angle in rad is another quantity
UNIT_DIGITS = {"h": 3}  # what is told in hours is a life, a number of statistics
FEWEST, FEWEST_OF_LENGTH = 3, 2  # digits of what is smaller than these steps allow for: 26 µm
SHORT = 2  # digits of a number that stands as it is, however small: 0.05 mm
NOTHING = 1e-7  # of a unit: what is less is the rounding of the computer
ROUNDED = 1e-12  # of a pure number: what is left of a difference or a ratio of equal ones
NEVER_SMALL = frozenset(
    ("m", "rad", "s", "N", "N*m", "W", "J", "Pa", "kg", "m/s", "m/s**2", "rad/s", "rad/s**2", "K", "1/s")
)


def easy_unit(value: float, declared: str) -> str:
    """Return the unit of the declared one's family in which an SI value is easy to read; the declared one where it is already."""
    family, factor = _family(declared)
    if "N" in family and math.isfinite(value) and not is_nothing(value, "N"):
        return next(name for name, most in FORCES if abs(value) < most)
    number = abs(value) / factor
    is_easy = EASY_FROM <= number < EASY_BELOW or (number < EASY_FROM and _is_short(number))
    if not family or not math.isfinite(number) or number == 0 or is_easy or is_nothing(value, declared):
        return declared
    if number < EASY_FROM:
        others = [each for each in reversed(family) if unit(each).factor < factor]
        fitting = (each for each in others if abs(value) / unit(each).factor >= EASY_FROM)
    else:
        others = [each for each in family if unit(each).factor > factor]
        fitting = (each for each in others if abs(value) / unit(each).factor < EASY_BELOW)
    return next(fitting, others[-1] if others else declared)


@cache
def _family(declared: str) -> tuple[tuple[str, ...], float]:
    """The family of a unit, and its factor."""
    own = unit(declared)
    return next((units for units in FAMILIES if own.text in units), ()), own.factor


def _is_short(number: float) -> bool:
    """Whether a number is one that somebody wrote: 0.05, but not 0.02591, nor 0.000002."""
    return number >= EASY_FROM / 100 and abs(float(f"{number:.{SHORT - 1}e}") - number) <= 1e-12 * number


def is_nothing(value: float, unit_text: str) -> bool:
    """Return whether an SI value is so small in its unit that it is but the rounding of the computer."""
    own = unit(unit_text)
    if own.text == "1":
        return abs(value) < ROUNDED
    return (own.si in NEVER_SMALL or own.text == "%") and abs(value) < NOTHING * own.factor


def finest_step(unit_text: str) -> float | None:
    """Return the finest step of a quantity that can be made or measured, in its unit; None where none is known."""
    own = unit(unit_text)
    return UNIT_STEPS.get(own.text) or (STEPS[own.si] / own.factor if own.si in STEPS else None)


def meant_digits(value: float, unit_text: str, digits: int) -> int:
    """Return how many of the significant digits of an SI value mean something: none finer than can be made or measured."""
    number, known = abs(value) / unit(unit_text).factor, finest(unit_text)
    if known is None or number == 0 or not math.isfinite(number):
        return digits
    first = math.floor(math.log10(float(f"{number:.{digits - 1}e}")))
    return min(digits, max(first - known[0] + 1, known[1]))


@cache
def finest(unit_text: str) -> tuple[int, int] | None:
    """Return the place (a power of ten) of the last digit that means something in a unit, and how many digits a small number keeps."""
    step, fewest = finest_step(unit_text), FEWEST_OF_LENGTH if unit(unit_text).si == "m" else FEWEST
    return None if step is None else (round(math.log10(step)), fewest)


DIGITS = 4
PLACE_DIGITS = LISTED_DIGITS = 6  # of a place on an abscissa, at most; of a number in a list
MOST_DIGITS = 17  # that say all of a number
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


ABOVE = "> "  # begins the text of a value of which only that it is so great means something


def shown(value: float, unit_text: str, digits: int = DIGITS, most: float = math.inf) -> dict[str, str]:
    """Return an SI value as text in a display unit: of its digits those that mean something, rounding of the computer as zero.

    Where other than the usual number of digits is asked for, they all stand. Of a value above ``most`` (SI) no more is said.
    """
    if value > most:
        return {"text": f"{ABOVE}{unit(unit_text).from_si(most):.15g}", "unit": unit_text}
    if is_nothing(value, unit_text):
        return {"text": "0", "unit": unit_text}
    text = number_text(unit(unit_text).from_si(value), shown_digits(value, unit_text, digits))
    return {"text": text, "unit": unit_text}


def place_shown(value: float, unit_text: str, more: int = 0) -> dict[str, str]:
    """Return a place on an abscissa as text: with up to six digits, of which those stand that mean something, and so many more."""
    return shown(value, unit_text, min(meant_digits(value, unit_text, PLACE_DIGITS) + more, PLACE_DIGITS))


def listed_text(value: float, unit_text: str) -> str:
    """Return an SI value among others of a column: to the step that can be made or measured, so that all have as many decimals."""
    number, step = value / unit(unit_text).factor, finest_step(unit_text)
    if step is None:
        return number_text(number, LISTED_DIGITS)
    text = f"{number:.{max(-math.floor(math.log10(step) + EXACT), 0)}f}"
    short = text.rstrip("0").rstrip(".") if "." in text else text
    return "0" if short == "-0" else short


def given_shown(value: float, unit_text: str) -> dict[str, str]:
    """Return an input as text in a display unit: as it was typed, or rounded as a result is where it follows from one."""
    short = f"{unit(unit_text).from_si(value):.15g}"
    is_typed = len(short.replace(".", "").lstrip("0-")) <= TYPED
    return {"text": short, "unit": unit_text} if is_typed else shown(value, unit_text)


def shown_digits(value: float, unit_text: str, digits: int) -> int:
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
    """Return the SI value of a number in a unit, rounded once, as a typed quantity is."""
    return unit(unit_text).to_si(value)
