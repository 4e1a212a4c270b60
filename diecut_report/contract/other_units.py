"""Quantities that may be given in one of two kinds of unit, as a margin in degrees or in milliseconds."""

from __future__ import annotations

from dataclasses import dataclass

from diecut_report.contract.phase_inputs import TakenWhole
from diecut_report.quantities.formatting import told
from diecut_report.quantities.units import parse_quantity


@dataclass(frozen=True)
class InOtherUnit(TakenWhole):
    """Hold a quantity that is given in the other kind of unit that its key allows: its SI value."""

    value: float
    unit: str

    def __str__(self) -> str:
        """Return it as one writes it."""
        return told(self.value, self.unit)


def is_in(text: str, unit_text: str) -> bool:
    """Return whether a text is a quantity of the kind of a unit, and says so."""
    try:
        parse_quantity(text, unit_text)
    except ValueError:
        return False
    return not _is_bare(text)


def _is_bare(text: str) -> bool:
    """Whether a text is a number without a unit."""
    try:
        float(text)
    except ValueError:
        return False
    return True
