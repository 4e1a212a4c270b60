"""The sides of a check before anything is calculated: what their quantities are described as, and in which unit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from diecut_report.mechanism.chapters import in_unit
from diecut_report.mechanism.checks import Check
from diecut_report.mechanism.inputs import Inputs, Meta, Quantity, keys
from diecut_report.mechanism.steps import Step, read
from diecut_report.text.phrases import phrase, small

ALLOWED, ACCEPTED, AT_LEAST = phrase("allowed"), phrase("accepted"), phrase("at least")


class DeclaredSide(NamedTuple):
    """Hold what is said of a side where it is declared; nothing of a number, and of what nothing gives."""

    unit: str = ""
    label: str = ""
    source: str = ""
    is_input: bool = False


class CheckSides:
    """Know the quantities of a mechanism that its checks may compare."""

    def __init__(self, steps: Sequence[Step], inputs: type[Inputs]) -> None:
        self.steps, self.inputs = steps, keys(inputs)
        self.by_id = {step.id: step for step in reversed(steps)}

    def full(self, check: Check) -> Check:
        """Return a check with all that its author left to what it compares."""
        demand, limit = (self._side(check, side) for side in (check.demand, check.limit))
        is_allowed = limit.is_input and not demand.is_input and demand.unit
        told: dict[str, Any] = {
            "unit": demand.unit or limit.unit,
            "source": demand.source or limit.source,
            "demand_label": demand.label if isinstance(check.demand, str) else AT_LEAST,
            "limit_label": (ALLOWED if is_allowed else limit.label) if isinstance(check.limit, str) else ACCEPTED,
        }
        found = {name: text for name, text in told.items() if text and not getattr(check, name)}
        return replace(check, **found) if found else check

    def _side(self, check: Check, name: str | float) -> DeclaredSide:
        if not isinstance(name, str):
            return DeclaredSide()
        declared = self._declared(name)
        if not isinstance(declared, Step | Quantity):
            return DeclaredSide()
        unit = in_unit(declared, (*check.needs, *check.only_with)).unit
        label = small(declared.description) if declared.description else ""
        return DeclaredSide(unit, label, getattr(declared, "source", ""), isinstance(declared, Quantity))

    def _declared(self, name: str) -> Step | Meta | None:
        """What gives a quantity, a crossing or a part: a step before an input of the same id; None of what is counted, and of places."""
        if name in self.by_id:
            return self.by_id[name]
        if key := self.inputs.get(name.removeprefix("inputs.")):
            return key.meta
        return next(
            (each for each in self.steps if (found := read(name, each)) and found.role in ("crossing", "part")), None
        )
