"""A calculated mechanism as a whole, as the input of another one takes it by its name."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from types import MappingProxyType
from typing import Any

import numpy as np

from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, CurveHandle, TakenOfMachines, declared_unit
from diecut_report.mechanics.timing.intervals import TOUCHING, Interval, Intervals, complement, merged
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.names import Misdeclared
from diecut_report.mechanism.steps import PREFIX, Abscissa, Cell, ListedColumn, Listing, Phase
from diecut_report.mechanism.steps.table_steps import SAME
from diecut_report.quantities.formatting import listed_text, number_text, told
from diecut_report.quantities.units import unit
from diecut_report.text.phrases import Phrase, phrase

# The phases of a calculated mechanism: their intervals for one machine, and the handle by which others refer to them.


@dataclass(frozen=True)
class PhaseHandle(TakenOfMachines):
    """Hand a phase of one mechanism to the input of another, as ``GivenPhase``.

    ``text`` is how a config refers to it, ``row`` the variant that is meant where none is named.
    """

    name: str
    text: str = ""
    row: int = 0

    def __str__(self) -> str:
        """Return how a config refers to it."""
        return self.text

    @property
    def declared(self) -> Phase:
        """Return the phase as it is declared."""
        return phases_of(self.calculation)[self.name]

    @property
    def role(self) -> str:
        return self.declared.role

    @property
    def description(self) -> str:
        return phrase(self.declared.description)

    @property
    def phase_unit(self) -> str:
        """Return the SI unit of its abscissa."""
        return unit(self.calculation.steps[self.declared.abscissa].unit).si

    def of_machine(self, row: int) -> PhaseHandle:
        """Return the phase of one of the variants."""
        return replace(self, row=row)

    def period(self, row: int | None = None) -> float:
        return period_of(self.calculation, self.declared, self.row if row is None else row)

    def intervals(self, row: int | None = None) -> Intervals:
        return self._own if row is None or row == self.row else intervals(self.calculation, self.name, row)

    @cached_property
    def _own(self) -> Intervals:
        return intervals(self.calculation, self.name, self.row)


def phases_of(calc: Calculation) -> Mapping[str, Phase]:
    """Return the phases that take part in a calculation, by their names."""
    return _declared(calc.mechanism, calc.given)


@lru_cache(maxsize=256)
def _declared(mechanism: Mechanism, given: frozenset[str]) -> Mapping[str, Phase]:
    found = (step for _, step in mechanism.active(given) if isinstance(step, Phase))
    return MappingProxyType({step.id.removeprefix(PREFIX): step for step in found})


def intervals(calc: Calculation, name: str, row: int = 0) -> Intervals:
    """Return the intervals of a phase for one variant, SI: each begins within the period; none where the machine does not have it."""
    step = phases_of(calc)[name]
    period = period_of(calc, step, row)
    held = [each for other in (*step.union, *step.rest_of) for each in intervals(calc, other, row)]
    if step.rest_of:
        return complement(merged(held, period), period) if held else ()

    def place(end: str | float) -> float:
        return _of_row(calc[end], row) if isinstance(end, str) else float(end)

    spans = [(place(start), place(end)) for start, end in step.spans]
    return merged([*held, *(_counted_on(span, period) for span in spans if not np.isnan(span).any())], period)


def overlong(calc: Calculation) -> Iterator[tuple[Phase, int, Phrase]]:
    """Yield each phase whose ends are farther apart than its period, with the variant and why: it would be all of it, or nothing."""
    for step in phases_of(calc).values():
        periods = np.broadcast_to(
            calc[step.period] if step.period else calc.domains[step.abscissa].period[:, :1], (calc.count, 1)
        )
        for span in step.spans:
            start, end = (calc[each] if isinstance(each, str) else each for each in span)
            lengths = np.abs(np.broadcast_to(end - start, (calc.count, 1)))
            for row in np.flatnonzero((lengths > periods * (1 + TOUCHING)) & np.isfinite(lengths)):
                if row in calc.flaws:  # impossible already
                    continue
                yield step, int(row), _overlong(calc, step, float(lengths[row, 0]), float(periods[row, 0]))


def _overlong(calc: Calculation, step: Phase, length: float, period: float) -> Phrase:
    display = declared_unit(calc, step.abscissa, calc.steps[step.abscissa].unit)
    template = "{description} ({id}) has ends {length} apart, more than its period of {period}; ends that plain code gives are in SI"
    sides = {"length": told(length, display), "period": told(period, display)}
    return Phrase(template, description=step.description, id=step.id.removeprefix(PREFIX), **sides)


def _counted_on(span: Interval, period: float) -> Interval:
    """A span whose end, where it lies before the start, is meant a period later; one without a length has none."""
    start, end = span
    if abs(end - start) <= TOUCHING * period:
        return start, start
    return (start, end) if end > start else (start, end + period)


def period_of(calc: Calculation, step: Phase, row: int = 0) -> float:
    """Return after which length of its abscissa a phase comes again, SI."""
    return _of_row(calc[step.period] if step.period else calc.domains[step.abscissa].period, row)


def _of_row(column: np.ndarray[tuple[int, ...], np.dtype[np.float64]], row: int) -> float:
    return float(column[row if len(column) > 1 else 0, 0])


def speed_of(calc: Calculation, abscissa: str, row: int = 0) -> float | None:
    """Return how fast an abscissa is run through, SI; 1 for one of time, None where nothing tells it."""
    step = calc.steps[abscissa]
    assert isinstance(step, Abscissa)
    if step.speed:
        return _of_row(calc[step.speed], row)
    return 1.0 if unit(step.unit).kind == unit("s").kind else None


# Tables that plain code makes: their rows, checked, as numbers and as they are printed.


Data = dict[str, Any]
TAKEN, MARK = phrase("taken"), "→"


def rows(calc: Calculation, step: Listing) -> list[list[Cell]]:
    """Return the rows of a listing, SI; Misdeclared where they are none."""
    known = {name: calc[name] for name in step.holds if name in calc.values or name in calc.inputs}
    found = [[cell if isinstance(cell, str | None) else float(cell) for cell in row] for row in step.function(known)]
    for row in found:
        if len(row) != len(step.columns) or any(isinstance(cell, float) and not math.isfinite(cell) for cell in row):
            template = "step {id}: its function gives the row {row}; {count} texts and finite numbers are wanted"
            raise Misdeclared(Phrase(template, id=step.id, row=row, count=len(step.columns)), step.at)
    return found


def results(calc: Calculation) -> Data:
    """Return all listings of a machine by id, as the results hold them; nothing where there is none."""
    found: Data = {}
    for step in calc.steps.values():
        if isinstance(step, Listing):
            columns = [
                {"id": each.id, "description": each.description, "unit": unit(each.unit).si} for each in step.columns
            ]
            lines = rows(calc, step)
            marked = {"taken": taken} if (taken := _taken(calc, step, lines)) else {}
            found[step.id] = {"description": step.description, "columns": columns, "rows": lines} | marked
    return found


def _taken(calc: Calculation, step: Listing, lines: list[list[Cell]]) -> list[int]:
    """The rows that begin with what was taken."""
    name = step.taken.removeprefix("inputs.")
    if not name or (name not in calc.values and name not in calc.inputs):
        return []
    own: Any = calc[name]
    value = own[0, 0] if isinstance(own, np.ndarray) else own

    def is_taken(cell: Cell) -> bool:
        is_number = isinstance(cell, float) and not isinstance(value, str)
        return math.isclose(cell, value, rel_tol=SAME) if is_number else bool(cell == value)  # type: ignore[arg-type]

    return [number for number, row in enumerate(lines) if is_taken(row[0])]


def printed(calc: Calculation, step: Listing) -> list[Data]:
    """Return a listing as a table of the calculation, the rows that were taken marked in a column of their own; none where it has no rows."""
    columns = [
        {"title": each.description, "symbol": each.symbol, "unit": each.unit} for each in step.columns if each.printed
    ]
    found = rows(calc, step)
    lines = [[_text(cell, head) for cell, head in zip(row, step.columns, strict=True) if head.printed] for row in found]
    if taken := _taken(calc, step, found):
        columns = [{"title": TAKEN, "symbol": "", "unit": "1"}, *columns]
        lines = [[MARK if number in taken else "", *line] for number, line in enumerate(lines)]
    return [{"type": "table", "title": step.description, "columns": columns, "rows": lines}] if lines else []


def _text(cell: Cell, head: ListedColumn) -> str:
    if cell is None:
        return "–"
    if isinstance(cell, str):
        return cell
    return number_text(cell / unit(head.unit).factor, head.digits) if head.digits else listed_text(cell, head.unit)


@dataclass(frozen=True)
class MechanismHandle(TakenOfMachines):
    """Hand a whole mechanism to the input of another, as ``GivenMechanism``: what it may be asked for is told there.

    Of many variants it is that of one, ``row``; ``numbers`` and ``curve`` are those of all.
    """

    name: str
    is_mechanism: bool = True
    row: int = 0

    def __str__(self) -> str:
        """Return its name, by which a config refers to it."""
        return self.name

    @property
    def kind(self) -> str:
        return self.calculation.mechanism.kind

    @property
    def count(self) -> int:
        return self.calculation.count

    @cached_property
    def phases(self) -> dict[str, PhaseHandle]:
        calc = self.calculation
        found = (PhaseHandle(calc, name, f"{self.name}.{PREFIX}{name}", self.row) for name in phases_of(calc))
        return {handle.name: handle for handle in found if handle.intervals()}

    def of_machine(self, row: int) -> MechanismHandle:
        """Return the mechanism of one of the variants."""
        return replace(self, row=row)

    def missing_keys(self, phase: str) -> tuple[str, ...] | None:
        calc = self.calculation
        declared = [
            each for each in calc.mechanism.steps if each[1].id == f"{PREFIX}{phase}" and isinstance(each[1], Phase)
        ]
        if not declared:
            return None
        chapter, step = declared[0]
        return tuple(key for key in (*chapter.needs, *step.needs) if key not in calc.given)

    def number(self, name: str) -> float | None:
        found = self.numbers(name)
        own = np.nan if found is None else _of_row(found, self.row)
        return None if np.isnan(own) else own

    def numbers(self, name: str) -> Array | None:
        calc = self.calculation
        found = calc.values.get(name, calc.inputs.get(name))
        return found if isinstance(found, np.ndarray) and found.dtype != object else None

    def parts(self, name: str) -> tuple[float, ...]:
        found = self.calculation.values.get(name)
        return () if found is None else tuple(map(float, found[self.row if len(found) > 1 else 0]))

    def texts(self, name: str) -> tuple[str, ...]:
        return tuple(str(text) for text in self.calculation.inputs.get(name, ()))

    def listing(self, name: str) -> list[list[Cell]]:
        step = self.calculation.steps.get(name)
        return rows(self.calculation, step) if isinstance(step, Listing) else []

    def curve(self, name: str) -> CurveHandle | None:
        return self.calculation.handle(name) if name in self.calculation.curves else None

    def period(self, abscissa: str = "") -> float:
        return _of_row(self.calculation.domains[abscissa or self._first()].period, self.row)

    def cycle(self) -> float:
        first = self._first()
        longer = (each for each in phases_of(self.calculation).values() if each.abscissa == first and each.period)
        phase = next(longer, None)
        return self.period() if phase is None else period_of(self.calculation, phase, self.row)

    def speed(self, abscissa: str = "") -> float | None:
        return speed_of(self.calculation, abscissa or self._first(), self.row)

    @property
    def has_period(self) -> bool:
        return bool(self.calculation.domains)

    def _first(self) -> str:
        return next(iter(self.calculation.domains))
