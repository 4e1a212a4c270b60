"""What one mechanism of a press gave, by its ids: numbers with their units, curves, checks, phases."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from diecut_report.errors import nearest
from diecut_report.quantities.units import pretty, to_display, unit

Data = Mapping[str, Any]


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


@dataclass(frozen=True)
class CheckFound:
    """Hold a check: its status (pass, warn, fail, not_checked), what it compares in SI, the share that is used, its message."""

    id: str
    status: str
    demand: float | None
    limit: float | None
    unit: str
    utilisation: float | None
    message: str


@dataclass(frozen=True)
class PhaseFound:
    """Hold a phase: what it is, and its intervals over its abscissa, SI."""

    id: str
    role: str
    unit: str
    intervals: tuple[tuple[float, float], ...]


class MechanismFound:
    """Give what a mechanism's machine gave: ``found["force"]``, ``found.checks["stress"]``, ``found.phases["cutting"]``.

    A part of a row over repeated parts is called as in the results file, counted from 0: ``found["stress.0"]``;
    ``row`` gives all of them. ``data`` is all that the results file holds of the mechanism.
    """

    def __init__(self, data: Data) -> None:
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
        outputs = {**self.data["values"], **self.data["outputs"]}
        places = {f"{name}_at": _place(row) for name, row in outputs.items() if "at" in row}
        inputs = {f"inputs.{name}" if name in outputs else name: row for name, row in self.data["inputs"].items()}
        return {name: _quantity(name, row) for name, row in (outputs | places | inputs).items()}

    @cached_property
    def curves(self) -> dict[str, CurveFound]:
        """Return the curves, and what they run over, by their ids."""
        made = self.data["curves"].items()
        return {
            name: CurveFound(name, tuple(row["values"]), row["unit"], row.get("abscissa", name)) for name, row in made
        }

    @cached_property
    def checks(self) -> dict[str, CheckFound]:
        """Return the checks that apply, also those that are not made for want of an input, by their ids."""
        return {check["id"]: _check(check) for check in self.data["checks"]}

    @cached_property
    def phases(self) -> dict[str, PhaseFound]:
        """Return the phases that the machine has, by their ids."""
        return {name: _phase(name, row) for name, row in self.data["phases"].items()}

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
        return f"{self.data['kind']} gives no {name!r}{nearest(name, [*self.quantities, *self.curves])}"


def in_unit(name: str, value: float, si: str, other: str) -> float:
    """Return a number of SI in another unit; ValueError where that is of another kind."""
    if unit(other).kind != unit(si).kind:
        raise ValueError(f"{name} is in {pretty(si) or 'plain numbers'}, which is not of the kind of {other}")
    return to_display(value, other)


def _is_part(name: str, key: str) -> bool:
    """Whether a key is that of a part of a row: ``stress.0``, ``springs.0.wire`` of ``springs.wire``."""
    parts = key.split(".")
    return key != name and ".".join(part for part in parts if not part.isdigit()) == name


def _quantity(name: str, row: Data) -> QuantityFound:
    shown = f"{row['display']['text']} {pretty(row['display']['unit'])}".rstrip()
    value = row["value"]
    found = value if isinstance(value, str) else str(value) if isinstance(value, bool | list | None) else float(value)
    return QuantityFound(name, found, row["unit"], row["symbol"], row["description"], shown)


def _place(row: Data) -> Data:
    """The place of an extreme."""
    at = row["at"]
    return {"value": at["value"], "unit": unit(at["unit"]).si, "symbol": at["symbol"],
            "description": row["description"], "display": at}  # fmt: skip


def _check(row: Data) -> CheckFound:
    values = (row["demand"], row["limit"], row["unit"], row["utilisation"], row["message"])
    return CheckFound(row["id"], row["status"], *values)


def _phase(name: str, row: Data) -> PhaseFound:
    intervals = tuple((float(start), float(end)) for start, end in row["intervals"])
    return PhaseFound(name, row["role"], row["unit"], intervals)
