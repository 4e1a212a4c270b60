"""A calculated mechanism as a whole, as the input of another one takes it by its name."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from diecut_report.contract.listings import Cell, Listing
from diecut_report.contract.phase_inputs import TakenWhole
from diecut_report.contract.phases import PREFIX
from diecut_report.contract.steps import Phase
from diecut_report.engine import listings
from diecut_report.engine.calculation import Calculation, CurveHandle
from diecut_report.engine.phases import PhaseHandle, phases_of, speed_of


@dataclass(frozen=True)
class MechanismHandle(TakenWhole):
    """Hand a whole mechanism to the input of another: its phases, numbers, curves, and how its abscissa is run through."""

    calculation: Calculation
    name: str
    is_mechanism: bool = True

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

    @property
    def phases(self) -> dict[str, PhaseHandle]:
        """Return the phases that it has, by their names."""
        found = (
            PhaseHandle(self.calculation, name, f"{self.name}.{PREFIX}{name}") for name in phases_of(self.calculation)
        )
        return {handle.name: handle for handle in found if handle.intervals()}

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
        calc = self.calculation
        found = calc.values.get(name, calc.inputs.get(name))
        if not isinstance(found, np.ndarray) or found.dtype == object or np.isnan(found[0, 0]):
            return None
        return float(found[0, 0])

    def row(self, name: str) -> tuple[float, ...]:
        """Return a row over repeated parts by its id, SI; nothing where there is none."""
        found = self.calculation.values.get(name)
        return () if found is None else tuple(float(value) for value in found[0])

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
        return float(self.calculation.domains[abscissa or self._first()].period[0, 0])

    def speed(self, abscissa: str = "") -> float | None:
        """Return how fast that abscissa is run through, SI; None where that is not known."""
        return speed_of(self.calculation, abscissa or self._first())

    @property
    def has_period(self) -> bool:
        """Return whether it runs over something that comes again."""
        return bool(self.calculation.domains)

    def _first(self) -> str:
        return next(iter(self.calculation.domains))
