"""Inputs that are a number or vary over a cycle: a number, a curve by reference, or extremes alone; a list's parts may differ in it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from diecut_report.contract.inputs import Quantity
from diecut_report.contract.placeholders import Pending
from diecut_report.languages.phrases import Phrase, joined, phrase
from diecut_report.quantities.units import pretty, unit


@dataclass(frozen=True)
class Extremes:
    """Hold the least and the greatest value of what varies in a way that is not known, SI."""

    low: float
    high: float


@dataclass(frozen=True)
class Varying(Quantity):
    """Declare a quantity that is a number or a curve by reference; put into ``Annotated[Any, Varying(...)]``.

    The validated value is an SI float, the referred curve, with ``extremes`` also ``Extremes`` from a block ``{min, max}``, or one of
    the texts ``words``. Only plain code takes it (``Prepared``).
    """

    extremes: bool = False

    def validate(self, given: Any) -> Any:
        """Return what the plugin's code takes; ValueError in words where it is not allowed."""
        if isinstance(given, Pending) and given.is_curve:
            if given.unit is None or unit(given.unit).kind != self.parsed_unit.kind:
                raise ValueError(
                    Phrase(
                        "${{path}} is not a curve in {unit}, but in {own}",
                        path=given.path,
                        unit=pretty(self.unit),
                        own=given.unit,
                    )
                )
            return given
        if isinstance(given, Extremes) or hasattr(given, "curve_id"):
            return given
        if isinstance(given, dict):
            return self._extremes(given)
        try:
            return super().validate(given)
        except ValueError as fault:
            raise ValueError(Phrase("{fault}{ways}", fault=fault, ways=self._ways(given))) from None

    def _ways(self, given: Any) -> str:
        """What else would be allowed, where something else than a number was given."""
        if not isinstance(given, str) or not given[:1].isalpha():
            return ""
        ways = [phrase("a reference to a curve"), *(f"“{word}”" for word in self.words)]
        return Phrase("; or give {ways}", ways=joined(ways, ", or "))

    def _extremes(self, given: dict[Any, Any]) -> Extremes:
        if not self.extremes:
            raise ValueError(phrase("is a block of keys; a number or a reference to a curve is needed"))
        if set(given) != {"min", "max"}:
            raise ValueError(phrase("is a block of keys; as a block it has the keys min and max, and no others"))
        low, high = (super(Varying, self).validate(given[key]) for key in ("min", "max"))
        if not isinstance(low, Pending) and not isinstance(high, Pending) and low > high:
            raise ValueError(phrase("has a min above its max; exchange them"))
        return Extremes(low, high)


__all__ = ["Extremes", "Varying"]
