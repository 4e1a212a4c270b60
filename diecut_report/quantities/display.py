"""How a value is shown where nobody chose its unit: in the unit of its family in which it is easy to read, and no finer than it means."""

from __future__ import annotations

import math
from functools import cache

from diecut_report.quantities.units import unit

LEAST, MOST = 0.1, 1e4  # a number is easy to read from the one to below the other
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
    if not family or not math.isfinite(number) or number == 0 or LEAST <= number < MOST or is_nothing(value, declared):
        return declared
    if number < LEAST:
        if _is_short(number):
            return declared
        smaller = [each for each in family if unit(each).factor < factor]
        fitting = (each for each in reversed(smaller) if abs(value) / unit(each).factor >= LEAST)
        return next(fitting, smaller[0] if smaller else declared)
    greater = [each for each in family if unit(each).factor > factor]
    return next(
        (each for each in greater if abs(value) / unit(each).factor < MOST), greater[-1] if greater else declared
    )


@cache
def _family(declared: str) -> tuple[tuple[str, ...], float]:
    """The family of a unit, and its factor."""
    own = unit(declared)
    return next((units for units in FAMILIES if own.text in units), ()), own.factor


def _is_short(number: float) -> bool:
    """Whether a number is one that somebody wrote: 0.05, but not 0.02591, nor 0.000002."""
    return number >= LEAST / 100 and abs(float(f"{number:.{SHORT - 1}e}") - number) <= 1e-12 * number


def is_nothing(value: float, unit_text: str) -> bool:
    """Return whether an SI value is so small in its unit that it is but the rounding of the computer."""
    own = unit(unit_text)
    if own.text == "1":
        return abs(value) < ROUNDED
    return (own.si in NEVER_SMALL or own.text == "%") and abs(value) < NOTHING * own.factor


def is_rounding(value: float, unit_text: str) -> bool:
    """Return whether an SI value would be zero but for the rounding of the computer, so that the place of an extreme says nothing."""
    return value != 0 and is_nothing(value, unit_text)


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
    step = finest_step(unit_text)
    return (
        None if step is None else (round(math.log10(step)), FEWEST_OF_LENGTH if unit(unit_text).si == "m" else FEWEST)
    )
