"""A calculated mechanism as a whole, as the input of another one takes it by its name."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from diecut_report.contract.listings import Cell, Listing
from diecut_report.contract.phase_inputs import TakenWhole
from diecut_report.contract.phases import PREFIX
from diecut_report.contract.steps import Phase
from diecut_report.engine import listings
from diecut_report.engine.calculation import Calculation, CurveHandle
from diecut_report.engine.phases import PhaseHandle, phases_of, speed_of
from diecut_report.expressions import Array


@dataclass(frozen=True)
class MechanismHandle(TakenWhole):
    """Hand a whole mechanism to the input of another: its phases, numbers, curves, and how its abscissa is run through.

    Of many variants it is that of one, ``row``; ``numbers`` and ``curve`` are those of all.
    """

    calculation: Calculation
    name: str
    is_mechanism: bool = True
    row: int = 0

    def __str__(self) -> str:
        """Return its name, by which a config refers to it."""
        return self.name

    @property
    def kind(self) -> str:
        """Return its kind."""
        return self.calculation.mechanism.kind

    @property
    def count(self) -> int:
        """Return how many variants it stands for."""
        return self.calculation.count

    @cached_property
    def phases(self) -> dict[str, PhaseHandle]:
        """Return the phases that it has, by their names."""
        calc = self.calculation
        found = (PhaseHandle(calc, name, f"{self.name}.{PREFIX}{name}", self.row) for name in phases_of(calc))
        return {handle.name: handle for handle in found if handle.intervals()}

    def of_machine(self, row: int) -> MechanismHandle:
        """Return the mechanism of one of the variants."""
        return replace(self, row=row)

    def missing_keys(self, phase: str) -> tuple[str, ...] | None:
        """Return the keys without which it has not a phase that its kind may have; None where the kind has none of this name."""
        calc = self.calculation
        declared = [
            each for each in calc.mechanism.steps if each[1].id == f"{PREFIX}{phase}" and isinstance(each[1], Phase)
        ]
        if not declared:
            return None
        chapter, step = declared[0]
        return tuple(key for key in (*chapter.needs, *step.needs) if key not in calc.given)

    def number(self, name: str) -> float | None:
        """Return a number (an output, a value or an input) by its id, SI; None where there is none."""
        found = self.numbers(name)
        own = np.nan if found is None else float(self._own(found)[0])
        return None if np.isnan(own) else own

    def numbers(self, name: str) -> Array | None:
        """Return a number of all variants by its id, SI, shape (variants, 1), NaN where it is absent; None where there is none."""
        calc = self.calculation
        found = calc.values.get(name, calc.inputs.get(name))
        return found if isinstance(found, np.ndarray) and found.dtype != object else None

    def parts(self, name: str) -> tuple[float, ...]:
        """Return a row over repeated parts by its id, SI; nothing where there is none."""
        found = self.calculation.values.get(name)
        return () if found is None else tuple(float(value) for value in self._own(found))

    def _own(self, values: Array) -> Array:
        """The values of the variant; those that hold for all have a single row."""
        found: Array = values[self.row if len(values) > 1 else 0]
        return found

    def texts(self, name: str) -> tuple[str, ...]:
        """Return a text input of all repeated parts, mechanisms by their names; nothing where there is none."""
        return tuple(str(text) for text in self.calculation.inputs.get(name, ()))

    def listing(self, name: str) -> list[list[Cell]]:
        """Return the rows of a table that it lists, by its id, SI; nothing where there is none."""
        step = self.calculation.steps.get(name)
        return listings.rows(self.calculation, step) if isinstance(step, Listing) else []

    def curve(self, name: str) -> CurveHandle | None:
        """Return a curve by its id, over shares of its period; None where there is none."""
        return CurveHandle(self.calculation, name) if name in self.calculation.curves else None

    def period(self, abscissa: str = "") -> float:
        """Return the period of an abscissa, SI; by default of the first one that is declared."""
        return float(self._own(self.calculation.domains[abscissa or self._first()].period)[0])

    def speed(self, abscissa: str = "") -> float | None:
        """Return how fast that abscissa is run through, SI; None where that is not known."""
        return speed_of(self.calculation, abscissa or self._first(), self.row)

    @property
    def has_period(self) -> bool:
        """Return whether it runs over something that comes again."""
        return bool(self.calculation.domains)

    def _first(self) -> str:
        return next(iter(self.calculation.domains))
