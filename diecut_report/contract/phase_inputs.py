"""Phases of other mechanisms, and other mechanisms as a whole, as inputs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

from pydantic import GetCoreSchemaHandler
from pydantic_core import CoreSchema, core_schema

from diecut_report.contract.curve_inputs import optional
from diecut_report.contract.place import placed
from diecut_report.contract.placeholders import Pending
from diecut_report.quantities.units import pretty, unit


class GivenPhase(Protocol):
    """Hold a phase that an input refers to."""

    @property
    def name(self) -> str:
        """Return its name."""

    @property
    def role(self) -> str:
        """Return what it is: working, rest, moving or window."""

    def period(self, row: int = 0) -> float:
        """Return the period of its abscissa, SI, of one of the variants."""

    def intervals(self, row: int = 0) -> list[tuple[float, float]]:
        """Return its intervals, SI, of one of the variants: sorted, disjoint, each beginning within the period."""


@dataclass(frozen=True)
class PhaseInput:
    """Declare a phase of another mechanism, taken by reference: ``${drive.phases.cutting}``.

    ``unit`` is that of the abscissa it runs over (an angle, a time). The validated value is a ``Pending`` or the phase
    (``GivenPhase``).
    """

    symbol: str
    unit: str
    description: str
    at: str = placed()

    def validate(self, given: Any) -> Any:
        """Return the phase; ValueError in words where there is none, or where it runs over something else."""
        other = given.unit if isinstance(given, Pending) and given.is_phase else getattr(given, "phase_unit", None)
        if isinstance(given, Pending) and not given.is_phase:
            raise ValueError(f"${{{given.path}}} is not a phase; {self.needed}")
        if other is None:
            raise ValueError(f"is {given!r}; {self.needed}")
        if unit(other).kind != unit(self.unit).kind:
            raise ValueError(
                f"is a phase over an abscissa in {pretty(other)}; one in {pretty(self.unit)} is needed here"
            )
        return given

    @property
    def needed(self) -> str:
        """Return in words what is to be given."""
        return "a reference to a phase is needed, as in ${drive.phases.cutting}"

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(optional(source, self.validate))
