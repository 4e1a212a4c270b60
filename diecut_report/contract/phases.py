"""Phases: when, over the period of an abscissa, a mechanism works, rests, moves or leaves room."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Literal, Protocol, Unpack, get_args

from diecut_report.contract.options import StepCondition
from diecut_report.contract.steps import Phase, Step

PhaseRole = Literal["working", "rest", "moving", "window"]
ROLES: tuple[str, ...] = get_args(PhaseRole)
PREFIX = "phases."
"""What the name of a phase begins with, where quantities are named too: in references and among the ids of steps."""


class StepHolder(Protocol):
    """What steps can be added to."""

    def add(self, *steps: Step | Iterable[Any]) -> None:
        """Add steps."""


class PhaseForm:
    """Give chapters the call that declares a phase."""

    def phase(
        self: StepHolder,
        name: str,
        role: PhaseRole,
        description: str,
        abscissa: str,
        *spans: tuple[str | float, str | float],
        union: tuple[str, ...] = (),
        rest_of: tuple[str, ...] = (),
        period: str = "",
        **when: Unpack[StepCondition],
    ) -> None:
        """Declare when the mechanism works, rests, moves or leaves room, over the period of ``abscissa``.

        Each of ``spans`` goes from one place to another, both ids of numbers (0 for the start of the period), the end counted on
        where it passes the period. Instead of spans ``union`` names phases that this one holds together, ``rest_of`` those
        that it leaves out.
        """
        own: dict[str, Any] = {"role": role, "abscissa": abscissa, "spans": spans, "union": union, "rest_of": rest_of}
        own["period"] = period
        self.add(Phase(id=f"{PREFIX}{name}", description=description, **own, **when))
