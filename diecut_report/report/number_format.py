"""Numbers and units for print: the one place that gives the neutral texts of the results their printed form."""

from __future__ import annotations

import math
import re

from diecut_report.quantities.formatting import shown
from diecut_report.quantities.units import pretty

MINUS = "\u2212"
THIN = "\u202f"  # narrow, and never broken
RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹"
_RAISED = str.maketrans("0123456789-", f"{RAISED}⁻")
_NUMBER = re.compile(r"([+-]?)(\d+)(?:\.(\d+))?(?:[eE]([+-]?\d+))?")
_SPACED_FROM = 5  # digits: 10 000, but 1200
# A long whole number of a sentence with its unit, and none that is a name: EN 10083.
_LONG = re.compile(
    r"(?<![\w.,])\d{5,}(?=(?:[.,]\d+)?[ \u00a0](?:[kMG]?N|[kMG]?Pa|k?W|k?J|[mµ]?m|kg|s|h|r/min|1/h|1/s|K)(?!\w))"
)


def parts(text: str) -> tuple[str, str, str, int] | None:
    """Sign, whole digits, decimals and power of ten of a number as results hold it ("-1.2e-05"); None of other texts."""
    found = _NUMBER.fullmatch(text)
    return (found[1], found[2], found[3] or "", int(found[4] or 0)) if found else None


def is_words(text: str) -> bool:
    """Whether the text of a value is not a number."""
    return parts(text) is None


def grouped(whole: str, separator: str = THIN) -> str:
    """Whole digits in threes from 10 000 up."""
    if len(whole) < _SPACED_FROM:
        return whole
    first = len(whole) % 3
    groups = [whole[:first]] if first else []
    return separator.join(groups + [whole[i : i + 3] for i in range(first, len(whole), 3)])


def number(text: str, decimal: str = ".") -> str:
    """A number of the results as it is printed: ``-1.2e-05`` → ``−1.2 × 10⁻⁵``; a text that is not a number stands as it is."""
    found = parts(text)
    if found is None:
        return text
    sign, whole, decimals, power = found
    body = grouped(whole) + (decimal + decimals if decimals else "")
    return (MINUS if sign == "-" else "") + body + (power_of_ten(power) if power else "")


def power_of_ten(exponent: int) -> str:
    """A power of ten behind a number."""
    return f"\u2009×\u200910{str(exponent).translate(_RAISED)}"


def quantity(text: str, unit: str, decimal: str = ".") -> str:
    """A number with its unit: ``21000``, ``N*m`` → ``21 000 N·m``; degrees stand close to the number."""
    return joined(number(text, decimal), pretty(unit))


def joined(printed: str, unit: str) -> str:
    """A printed number and a printed unit, not to be broken apart."""
    space = "" if not unit or unit.startswith(("°", "′", "″")) else "\u00a0"
    if not space and unit and printed.endswith(tuple(RAISED)):  # 10⁻⁶ °, whose sign is no part of the power
        space = THIN
    return f"{printed}{space}{unit}"


def significant(value: float, digits: int = 4) -> str:
    """A value as a neutral text with so many significant digits."""
    if value == 0:
        return "0"
    exponent = math.floor(math.log10(abs(float(f"{value:.{digits - 1}e}"))))
    if -4 <= exponent < 6:
        return f"{value:.{max(digits - 1 - exponent, 0)}f}"
    return f"{value:.{digits - 1}e}"


def displayed(value: float, unit: str, decimal: str = ".") -> str:
    """An SI value as it is printed in a display unit, without the unit: with those of its digits that mean something."""
    return number(shown(value, unit)["text"], decimal)


def tidy(text: str) -> str:
    """A sentence with real minus signs, powers of ten written out, long numbers in threes, and degrees close to their number."""
    powers = re.sub(r"(?<=\d)[eE]([+-]?\d+)(?!\w)", lambda found: power_of_ten(int(found[1])), text.replace(" °", "°"))
    powers = re.sub(f"(?<=[{RAISED}])°", f"{THIN}°", _LONG.sub(lambda found: grouped(found[0]), powers))
    return re.sub(r"(?<![\w.)])-(?=\d)", MINUS, powers)


def sentence(text: str) -> str:
    """A text as the beginning of a sentence."""
    return text[:1].upper() + text[1:]
