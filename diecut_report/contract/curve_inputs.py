"""Curves as inputs: taken by reference, or given as a list of values over one period."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, get_args

from pydantic import GetCoreSchemaHandler
from pydantic_core import CoreSchema, core_schema

from diecut_report.contract.place import placed
from diecut_report.contract.placeholders import SI, Pending
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.limits import MAX_CURVE_VALUES
from diecut_report.quantities.plausible import plausible
from diecut_report.quantities.units import parse_quantity, pretty, to_display, unit


def optional(source: Any, validate: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """Return a validator that lets None pass where the annotation does."""
    if type(None) not in get_args(source):
        return validate
    return lambda given: None if given is None else validate(given)


@dataclass(frozen=True)
class CurveInput:
    """Declare a curve taken by reference, or (unless ``referred``) a list of equally spaced numbers over one period.

    The validated value is a ``Pending``, the referred curve, or a tuple of SI floats. ``units`` as for ``Quantity``.
    """

    symbol: str
    unit: str
    description: str
    referred: bool = False
    units: tuple[tuple[str, str], ...] = ()
    at: str = placed()

    def validate(self, given: Any) -> Any:
        """Return what the engine makes a curve of; ValueError in words where it cannot."""
        if isinstance(given, Pending):
            if given.unit is None or unit(given.unit).kind != unit(self.unit).kind or not given.is_curve:
                raise ValueError(Phrase("${{path}} is not a curve in {unit}", path=given.path, unit=self.unit))
            return given
        if isinstance(given, list) and not self.referred:
            if len(given) < 4:
                raise ValueError(
                    Phrase("has {count} values; a curve needs at least 4 over its period", count=len(given))
                )
            if len(given) > MAX_CURVE_VALUES:
                raise ValueError(
                    Phrase(
                        "has {count} values; at most {max_curve_values} are allowed for a curve",
                        count=len(given),
                        max_curve_values=MAX_CURVE_VALUES,
                    )
                )
            return tuple(self._listed(value) for value in given)
        if hasattr(given, "curve_id"):
            return given
        or_list = "" if self.referred else phrase(" or a list of values")
        raise ValueError(
            Phrase(
                "is {given}; a reference to a curve{or_list} in {unit} is needed",
                given=repr(given),
                or_list=or_list,
                unit=self.unit,
            )
        )

    def _listed(self, given: Any) -> float:
        """Return one value of a list in SI; one that is referred to is in SI already."""
        if isinstance(given, SI) and unit(given.unit).kind != unit(self.unit).kind:
            raise ValueError(
                Phrase(
                    "{told} is in {unit}; a quantity in {unit_2} is needed here",
                    told=given.told,
                    unit=given.unit,
                    unit_2=self.unit,
                )
            )
        value = float(given.value) if isinstance(given, SI) else parse_quantity(given, self.unit)
        sizes = plausible(self.unit)
        if not sizes.holds(value):
            shown = f"{to_display(value, self.unit):.6g} {pretty(self.unit)}".rstrip()
            source = Phrase(" (from {told})", told=given.told) if isinstance(given, SI) else ""
            raise ValueError(
                Phrase(
                    "holds {shown}{source}, which is not plausible; plausible: {told}, or 0",
                    shown=shown,
                    source=source,
                    told=sizes.told,
                )
            )
        return value

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(optional(source, self.validate))
