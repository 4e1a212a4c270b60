"""What one mechanism of a press gave, by its ids: numbers with their units, curves, checks, phases."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from diecut_report.errors import nearest
from diecut_report.quantities.units import pretty, to_display, unit
from diecut_report.results.mechanism_record import CheckRecord, MechanismRecord, PhaseRecord, QuantityRecord


class NotGiven(LookupError):
    """Report that a mechanism gives nothing of this name; the text names the nearest, and where to look."""

    def __str__(self) -> str:
        return str(self.args[0])


@dataclass(frozen=True)
class QuantityFound:
    """Hold a quantity: its value in SI (or its text), its SI unit, and how a report shows it."""

    id: str
    value: float | str
    unit: str
    symbol: str
    description: str
    shown: str

    def to(self, other: str) -> float:
        """Return the number in another unit of the same kind: ``found["force"].to("kN")``; ValueError where it has none."""
        if isinstance(self.value, str):
            raise ValueError(f"{self.id} is the text {self.value!r}, which has no unit")
        return in_unit(self.id, self.value, self.unit, other)

    def __float__(self) -> float:
        return float(self.value)


@dataclass(frozen=True)
class CurveFound:
    """Hold a curve at the samples of its abscissa (an id among the curves), SI."""

    id: str
    values: tuple[float, ...]
    unit: str
    abscissa: str

    def to(self, other: str) -> tuple[float, ...]:
        """Return its values in another unit of the same kind."""
        return tuple(in_unit(self.id, value, self.unit, other) for value in self.values)


class MechanismFound:
    """Give what a mechanism's machine gave: ``found["force"]``, ``found.checks["stress"]``, ``found.phases["cutting"]``.

    A part of a row over repeated parts is called as in the results file, counted from 0: ``found["stress.0"]``;
    ``row`` gives all of them. ``data`` is all that the results file holds of the mechanism.
    """

    def __init__(self, data: MechanismRecord) -> None:
        self.data = data

    def __getitem__(self, name: str) -> QuantityFound:
        if name not in self.quantities:
            raise NotGiven(self._instead(name))
        return self.quantities[name]

    def __contains__(self, name: object) -> bool:
        return name in self.quantities

    def __iter__(self) -> Iterator[str]:
        return iter(self.quantities)

    @cached_property
    def quantities(self) -> dict[str, QuantityFound]:
        """Return the results, the places of extremes (``ID_at``) and the inputs by their ids.

        Where a result has the id of an input, that is ``inputs.ID``.
        """
        outputs = {**self.data.values, **self.data.outputs}
        inputs = {f"inputs.{name}" if name in outputs else name: row for name, row in self.data.inputs.items()}
        found = {name: _quantity(name, row) for name, row in (outputs | inputs).items()}
        return found | {place.id: place for name, row in outputs.items() for place in _place(f"{name}_at", row)}

    @cached_property
    def curves(self) -> dict[str, CurveFound]:
        """Return the curves, and what they run over, by their ids."""
        made = self.data.curves.items()
        return {name: CurveFound(name, tuple(row.values), row.unit, (row.abscissa or name)) for name, row in made}

    @cached_property
    def checks(self) -> dict[str, CheckRecord]:
        """Return the checks that apply, also those that are not made for want of an input, by their ids."""
        return {row.id: row for row in self.data.checks}

    @property
    def phases(self) -> dict[str, PhaseRecord]:
        """Return the phases that the machine has, by their ids."""
        return self.data.phases

    def row(self, name: str, other: str = "") -> tuple[float, ...]:
        """Return the numbers of all repeated parts, in another unit of the same kind or in SI."""
        parts = [q for key, q in self.quantities.items() if _is_part(name, key)]
        if not parts:
            raise NotGiven(self._instead(name))
        return tuple(part.to(other or part.unit) for part in parts)

    def _instead(self, name: str) -> str:
        if name in self.curves:
            return f"{name} is a curve; ask .curves[{name!r}]"
        if any(_is_part(name, key) for key in self.quantities):
            return f"{name} has a number for each part; ask .row({name!r}), or one of them as {name + '.0'!r}"
        return f"{self.data.kind} gives no {name!r}{nearest(name, [*self.quantities, *self.curves])}"


def in_unit(name: str, value: float, si: str, other: str) -> float:
    """Return a number of SI in another unit; ValueError where that is of another kind."""
    if unit(other).kind != unit(si).kind:
        raise ValueError(f"{name} is in {pretty(si) or 'plain numbers'}, which is not of the kind of {other}")
    return to_display(value, other)


def _is_part(name: str, key: str) -> bool:
    """Whether a key is that of a part of a row: ``stress.0``, ``springs.0.wire`` of ``springs.wire``."""
    parts = key.split(".")
    return key != name and ".".join(part for part in parts if not part.isdigit()) == name


def _quantity(name: str, row: QuantityRecord) -> QuantityFound:
    shown = f"{row.display.text} {pretty(row.display.unit)}".rstrip()
    value = row.value
    found = value if isinstance(value, str) else str(value) if isinstance(value, bool | list) else float(value)
    return QuantityFound(name, found, row.unit, row.symbol, row.description, shown)


def _place(name: str, row: QuantityRecord) -> Iterator[QuantityFound]:
    if (at := row.at) and at.value is not None:  # which all places of results have
        shown = f"{at.text} {pretty(at.unit)}".rstrip()
        yield QuantityFound(name, at.value, unit(at.unit).si, at.symbol, row.description, shown)


# Numbers that a source prints, held against those that a mechanism calculates: the last printed digit tells how it was rounded.


PRINTED = re.compile(r"\s*([+\-−]?\d+(?:\.\d*)?|[+\-−]?\.\d+)(?:e([+\-−]?\d+))?\s*(.*)", re.IGNORECASE)
EXTRA_DIGITS, MIN_DIGITS = 2, 5  # digits of our numbers in the table: so many more than are printed, so many at least


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
        unit, printed = f" {pretty(self.unit)}".rstrip(), float(self.printed)
        share = f" ({self.difference:+.2%})" if printed else ""
        verdict = "agrees" if self.agrees else f"differs by {self.ours - printed:+.3g}{unit}{share}"
        # so many digits of ours that a difference in the last printed one is seen
        digits = len(re.sub(r"\D", "", re.split("e", self.printed, flags=re.IGNORECASE)[0]).lstrip("0")) + EXTRA_DIGITS
        ours = f"{self.ours:.{max(digits, MIN_DIGITS)}g}"
        idle = ", though a reason is told why not: take it away"
        reason = "" if not self.why else idle if self.agrees else f": {self.why}"
        place = f" ({self.place})" if self.place else ""
        return f"{self.name}{place}: printed {self.printed}{unit}, calculated {ours}{unit}, {verdict}{reason}"


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


def rounds_to(value: float, printed: str) -> bool:
    """Return whether a value rounds to a printed number: half a unit of its last digit lies between them at most."""
    mantissa, _, exponent = printed.lower().partition("e")
    last_digit: float = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
    return abs(value - float(printed)) <= 0.5 * last_digit * (1 + 1e-9)
