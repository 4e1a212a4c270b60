"""Numbers that a source prints, held against those that a mechanism calculates: the last printed digit tells how it was rounded."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from diecut_report.quantities.units import pretty
from diecut_report.testing.found_values import MechanismFound

PRINTED = re.compile(r"\s*([+\-−]?\d+(?:\.\d*)?|[+\-−]?\.\d+)(?:e([+\-−]?\d+))?\s*(.*)", re.IGNORECASE)
MORE, LEAST = 2, 5  # digits of our numbers in the table: so many more than are printed, and so many at least


@dataclass(frozen=True)
class PrintedValue:
    """Declare a printed number as the source has it, with its unit: ``PrintedValue("4.6e-3 m**2", place="eq. 17")``.

    ``why`` is the known reason of a difference, such as a mistake of the source: the number must then differ.
    """

    text: str
    place: str = ""
    why: str = ""


@dataclass(frozen=True)
class ComparedValue:
    """Hold a printed number beside ours, in the printed unit: the difference relative to the printed one, and whether ours rounds to it."""

    name: str
    printed: str
    unit: str
    ours: float
    difference: float
    agrees: bool
    place: str = ""
    why: str = ""

    @property
    def is_expected(self) -> bool:
        """Return whether it agrees, or differs for a reason that is known."""
        return self.agrees is not bool(self.why)

    def __str__(self) -> str:
        unit = f" {pretty(self.unit)}".rstrip()
        verdict = "agrees" if self.agrees else f"differs by {self._off(unit)}"
        reason = (
            ""
            if not self.why
            else f": {self.why}"
            if not self.agrees
            else ", though a reason is told why not: take it away"
        )
        place = f" ({self.place})" if self.place else ""
        return f"{self.name}{place}: printed {self.printed}{unit}, calculated {self._ours()}{unit}, {verdict}{reason}"

    def _ours(self) -> str:
        """Our number with more digits than the printed one, so that a difference in its last digit is seen."""
        mantissa = re.split("e", self.printed, flags=re.IGNORECASE)[0]
        shown = len(re.sub(r"\D", "", mantissa).lstrip("0"))
        return f"{self.ours:.{max(shown + MORE, LEAST)}g}"

    def _off(self, unit: str) -> str:
        """The difference itself and, of a number that is not zero, as a share of it."""
        value = float(self.printed)
        absolute = f"{self.ours - value:+.3g}{unit}"
        return f"{absolute} ({self.difference:+.2%})" if value else absolute


class ComparedValues(tuple[ComparedValue, ...]):
    """Hold all compared numbers; as a text it is a line for each: ``assert found.agree, str(found)``."""

    __slots__ = ()

    @property
    def agree(self) -> bool:
        """Return whether each agrees within its printed digits, or differs for a reason that is known."""
        return all(each.is_expected for each in self)

    def __str__(self) -> str:
        return "\n".join(("  " if each.is_expected else "→ ") + str(each) for each in self)

    __repr__ = __str__


def compare(calculated: MechanismFound, printed: Mapping[str, str | PrintedValue]) -> ComparedValues:
    """Return each printed value of a source beside the calculated one: ``{"force": "189 N"}``, ids as in the results file.

    ValueError where a text is not a number with a unit, or the unit is of another kind.
    """
    return ComparedValues(_compared(calculated, name, given) for name, given in printed.items())


def _compared(calculated: MechanismFound, name: str, given: str | PrintedValue) -> ComparedValue:
    row = given if isinstance(given, PrintedValue) else PrintedValue(given)
    number, unit = parted(name, row.text)
    ours = calculated[name].to(unit or "1")
    value = float(number)
    difference = (ours - value) / abs(value) if value else ours - value
    return ComparedValue(name, number, unit, ours, difference, rounds_to(ours, number), row.place, row.why)


def parted(name: str, text: str) -> tuple[str, str]:
    """Return the number of a printed text and its unit; ValueError where it begins with no number."""
    found = PRINTED.fullmatch(text)
    if found is None:
        raise ValueError(f"{name}: {text!r} is not a printed number with its unit, such as '4.6e-3 m**2'")
    mantissa, exponent, unit = found.groups()
    number = mantissa + (f"e{exponent}" if exponent else "")
    return number.replace("−", "-"), unit.strip()


def rounding(printed: str) -> float:
    """Return half a unit of the last printed digit."""
    mantissa, _, exponent = printed.lower().partition("e")
    decimals = len(mantissa.partition(".")[2])
    return float(0.5 * 10.0 ** (int(exponent or 0) - decimals))


def rounds_to(value: float, printed: str) -> bool:
    """Return whether a value rounds to a printed number."""
    return abs(value - float(printed)) <= rounding(printed) * (1 + 1e-9)
