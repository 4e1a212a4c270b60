"""The phases of a calculated mechanism: their intervals for one machine, and the handle by which others refer to them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from types import MappingProxyType

import numpy as np

from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.phase_inputs import TakenWhole
from diecut_report.contract.phases import PREFIX
from diecut_report.contract.steps import Abscissa, Phase
from diecut_report.engine.calculation import Calculation
from diecut_report.languages.phrases import phrase
from diecut_report.mechanics.timing.intervals import TOUCHING, Interval, Intervals, complement, merged
from diecut_report.quantities.units import unit


@dataclass(frozen=True)
class PhaseHandle(TakenWhole):
    """Hand a phase of one mechanism to the input of another; ``row`` counts the variants, of which a single one stands for all.

    ``text`` is how a config refers to it, ``row`` the variant that is meant where none is named.
    """

    calculation: Calculation
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
        """Return what it is: working, rest, moving or window."""
        return self.declared.role

    @property
    def description(self) -> str:
        """Return what it is called in words."""
        return phrase(self.declared.description)

    @property
    def phase_unit(self) -> str:
        """Return the SI unit of its abscissa."""
        return unit(self.calculation.steps[self.declared.abscissa].unit).si

    def of_machine(self, row: int) -> PhaseHandle:
        """Return the phase of one of the variants."""
        return replace(self, row=row)

    def period(self, row: int | None = None) -> float:
        """Return the period of its abscissa, SI."""
        return period_of(self.calculation, self.declared, self.row if row is None else row)

    def intervals(self, row: int | None = None) -> Intervals:
        """Return its intervals, SI; none where the machine does not have it."""
        return self._own if row is None or row == self.row else intervals(self.calculation, self.name, row)

    @cached_property
    def _own(self) -> Intervals:
        return intervals(self.calculation, self.name, self.row)


def phases_of(calc: Calculation) -> Mapping[str, Phase]:
    """Return the phases that take part in a calculation, by their names."""
    return _declared(calc.mechanism, calc.given)


@lru_cache(maxsize=256)
def _declared(mechanism: Mechanism, given: frozenset[str]) -> Mapping[str, Phase]:
    """The same of all calculations with these inputs: among many machines they are asked for many times."""
    found = (step for _, step in mechanism.active(given) if isinstance(step, Phase))
    return MappingProxyType({step.id.removeprefix(PREFIX): step for step in found})


def intervals(calc: Calculation, name: str, row: int = 0) -> Intervals:
    """Return the intervals of a phase for one variant, SI: each begins within the period; none where the machine does not have it."""
    return _intervals(calc, phases_of(calc), name, row)


def _intervals(calc: Calculation, known: Mapping[str, Phase], name: str, row: int) -> Intervals:
    step = known[name]
    period = period_of(calc, step, row)
    held = [each for other in (*step.union, *step.rest_of) for each in _intervals(calc, known, other, row)]
    if step.rest_of:
        return complement(merged(held, period), period) if held else ()
    spans = [(_place(calc, start, row), _place(calc, end, row)) for start, end in step.spans]
    return merged([*held, *(_counted_on(span, period) for span in spans if not np.isnan(span).any())], period)


def _counted_on(span: Interval, period: float) -> Interval:
    """A span whose end, where it lies before the start, is meant a period later; one without a length has none."""
    start, end = span
    if abs(end - start) <= TOUCHING * period:
        return start, start
    return (start, end) if end > start else (start, end + period)


def period_of(calc: Calculation, step: Phase, row: int = 0) -> float:
    """Return after which length of its abscissa a phase comes again, SI."""
    return _of_row(calc[step.period] if step.period else calc.domains[step.abscissa].period, row)


def _place(calc: Calculation, place: str | float, row: int) -> float:
    return float(_of_row(calc[place], row)) if isinstance(place, str) else float(place)


def _of_row(column: np.ndarray[tuple[int, ...], np.dtype[np.float64]], row: int) -> float:
    """The number of a variant; one that holds for all has a single row."""
    return float(column[row if len(column) > 1 else 0, 0])


def speed_of(calc: Calculation, abscissa: str, row: int = 0) -> float | None:
    """Return how fast an abscissa is run through, SI; 1 for one of time, None where nothing tells it."""
    step = calc.steps[abscissa]
    assert isinstance(step, Abscissa)
    if step.speed:
        return _of_row(calc[step.speed], row)
    return 1.0 if unit(step.unit).kind == unit("s").kind else None
