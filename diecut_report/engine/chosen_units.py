"""The units that a report chose for its quantities."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from diecut_report.quantities.units import unit


@dataclass(frozen=True)
class ChosenUnits:
    """Hold the units that a report chose: for all quantities of an SI unit (``m``), and for single quantities by their ids."""

    by_si: Mapping[str, str] = field(default_factory=dict)
    by_id: Mapping[str, str] = field(default_factory=dict)

    def of(self, name: str, declared: str) -> str | None:
        """Return the unit chosen for a quantity that is declared in a unit; None where none is."""
        return self.by_id.get(name) or self.by_si.get(unit(declared).si)


NONE_CHOSEN = ChosenUnits()
