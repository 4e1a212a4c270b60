"""Phases of other mechanisms, and other mechanisms as a whole, as inputs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

from pydantic import GetCoreSchemaHandler
from pydantic_core import CoreSchema, core_schema

from diecut_report.contract.curve_inputs import optional
from diecut_report.contract.place import placed
from diecut_report.contract.placeholders import Curve, Pending
from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.quantities.units import pretty, unit


class TakenWhole:
    """Be something of another mechanism that an input takes whole: no number, but what can be asked for numbers."""


class GivenPhase(Protocol):
    """Hold a phase that an input refers to."""

    name: str

    @property
    def role(self) -> str:
        """Return what it is: working, rest, moving or window."""

    @property
    def description(self) -> str:
        """Return what it is called in words, a text that is translated wherever it stands."""

    def period(self, row: int | None = None) -> float:
        """Return the period of its abscissa, SI, of one of the variants."""

    def intervals(self, row: int | None = None) -> tuple[tuple[float, float], ...]:
        """Return its intervals, SI, of one of the variants: sorted, disjoint, each beginning within the period; none where it is absent."""


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
        other = getattr(given, "phase_unit", None)
        if other is None:
            named = f"${{{given.path}}}" if isinstance(given, Pending) else f"{given!r}"
            raise ValueError(Phrase("{named} is not a phase; {needed}", named=named, needed=self.needed))
        if unit(other).kind != unit(self.unit).kind:
            raise ValueError(
                Phrase(
                    "is a phase over an abscissa in {pretty}; one in {pretty_2} is needed here",
                    pretty=pretty(other),
                    pretty_2=pretty(self.unit),
                )
            )
        return given

    @property
    def needed(self) -> str:
        """Return in words what is to be given."""
        return phrase("a reference to a phase is needed, as in ${drive.phases.cutting}")

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(optional(source, self.validate))


@dataclass(frozen=True)
class MechanismInput:
    """Declare another mechanism of the configuration, taken whole by its name: ``mechanism: drive``.

    It is calculated first, as if it were referred to. The validated value is a ``Pending`` or the mechanism (``GivenMechanism``).
    """

    description: str
    symbol: str = ""
    at: str = placed()

    def validate(self, given: Any) -> Any:
        """Return the mechanism; ValueError in words where there is none."""
        if getattr(given, "is_mechanism", False):
            return given
        named = f"${{{given.path}}}" if isinstance(given, Pending) else f"{given!r}"
        raise ValueError(
            Phrase("{named} is not a mechanism; the name of one is needed, as in mechanism: drive", named=named)
        )

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(optional(source, self.validate))


class GivenMechanism(Protocol):
    """Hold a calculated mechanism that an input names, of one machine; ``numbers`` and ``curve`` are of all, where there are many."""

    name: str

    @property
    def kind(self) -> str:
        """Return its kind."""

    @property
    def phases(self) -> dict[str, GivenPhase]:
        """Return the phases that it has, by their names."""

    @property
    def count(self) -> int:
        """Return how many variants it stands for."""

    @property
    def has_period(self) -> bool:
        """Return whether it runs over something that comes again."""

    def missing_keys(self, phase: str) -> tuple[str, ...] | None:
        """Return the keys without which it has not a phase that its kind may have; None where the kind has none of this name."""

    def number(self, name: str) -> float | None:
        """Return a number (an output, a value or an input) by its id, SI; None where there is none."""

    def numbers(self, name: str) -> Array | None:
        """Return a number of all variants by its id, SI, shape (variants, 1), NaN where it is absent; None where there is none."""

    def parts(self, name: str) -> tuple[float, ...]:
        """Return a row over repeated parts by its id, SI; nothing where there is none."""

    def texts(self, name: str) -> tuple[str, ...]:
        """Return a text input of all repeated parts, mechanisms by their names; nothing where there is none."""

    def listing(self, name: str) -> list[list[float | str | None]]:
        """Return the rows of a table that it lists, by its id, SI; nothing where there is none."""

    def curve(self, name: str) -> Curve | None:
        """Return a curve by its id, over shares of its period; None where there is none."""

    def period(self, abscissa: str = "") -> float:
        """Return the period of an abscissa, SI; by default of the first one that is declared."""

    def speed(self, abscissa: str = "") -> float | None:
        """Return how fast that abscissa is run through, SI; None where that is not known."""
