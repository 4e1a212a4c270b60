"""Quantity values as a script meets them: a number with its unit, that converts, prints, compares, and goes to pint."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import total_ordering
from typing import TYPE_CHECKING, Any

from diecut_report.errors import ConfigError, Problem
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.quantities.formatting import shown, with_unit
from diecut_report.quantities.units import UnitError, kind_name, parse_quantity, pretty, unit

if TYPE_CHECKING:
    import pint

PlainValue = float | int | bool | str


@total_ordering
@dataclass(frozen=True, eq=False, repr=False)
class QuantityValue:
    """Hold a number with its unit; or a text, a yes or no, a whole number, which have none (unit ``1``).

    ``value`` counts in ``unit``: of results and inputs the SI unit, at full precision, as in the results file. ``str`` gives what
    a report prints. ``name``, ``symbol``, ``description`` and ``source`` are those of the quantity; a converted value keeps them.
    """

    value: PlainValue
    unit: str = "1"
    name: str = ""
    symbol: str = ""
    description: str = ""
    source: str = ""
    display: tuple[str, str] | None = field(default=None)

    @property
    def magnitude(self) -> float:
        """Return the number in ``unit``; ConfigError where the value is not a number."""
        if isinstance(self.value, bool | str):
            raise self._unfit(phrase("is not a number"))
        return self.value

    def to(self, other: str) -> QuantityValue:
        """Return the same quantity in another unit of its dimension, such as ``N*m`` or ``rpm``; ConfigError for one of another."""
        return replace(self, value=self.m_as(other), unit=unit(other).text, display=None)

    def m_as(self, other: str) -> float:
        """Return the number of another unit of its dimension; ConfigError for one of another."""
        try:
            wanted = unit(other)
        except UnitError as fault:
            raise ConfigError(Problem(fault.args[0], path=self.name)) from None
        own, number = unit(self.unit), self.si  # which a text has not
        if wanted.kind != own.kind:
            given = Phrase("{unit} is {kind}", unit=other, kind=phrase(kind_name(wanted)))
            raise self._unfit(
                Phrase("is {kind} in {unit}; {given}", kind=phrase(kind_name(own)), unit=self.unit, given=given)
            )
        return wanted.from_si(number)

    @property
    def si(self) -> float:
        """Return the number in the SI unit of its dimension."""
        return unit(self.unit).to_si(self.magnitude)

    def to_pint(self, registry: pint.UnitRegistry[Any] | None = None) -> Any:
        """Return it as a quantity of pint, of this registry or of the application's."""
        import pint

        made: Any = pint.Quantity if registry is None else registry.Quantity
        return made(self.magnitude, self.unit if self.unit != "1" else "")

    def _unfit(self, words: Phrase) -> ConfigError:
        return ConfigError(Problem(Phrase("{value} {words}.", value=str(self), words=words), path=self.name))

    # --- printed -----------------------------------------------------------------------------------------------------

    @property
    def printed(self) -> tuple[str, str]:
        """Return the number as a neutral text, and the unit it counts in: as in a report, or in the unit it was converted to."""
        if self.display is not None:
            return self.display
        if isinstance(self.value, str):
            return self.value, "1"
        if isinstance(self.value, bool):
            return ("yes" if self.value else "no"), "1"
        made = shown(self.si, self.unit)
        return made["text"], made["unit"]

    def __str__(self) -> str:
        return with_unit(*self.printed)

    def __repr__(self) -> str:
        return f"<{self.name}: {self}>" if self.name else f"<{self}>"

    def __format__(self, form: str) -> str:
        """Return the number in this form with its unit, ``f"{torque:.1f}"``; without a form as ``str``."""
        return with_unit(format(self.magnitude, form), self.unit) if form else str(self)

    def _repr_html_(self) -> str:
        from diecut_report.scripting.display import value_html

        return value_html(self.symbol, self.printed)

    def _repr_latex_(self) -> str:
        from diecut_report.scripting.display import value_latex

        return value_latex(self.symbol, self.printed)

    # --- numbers -----------------------------------------------------------------------------------------------------

    def __float__(self) -> float:
        """Return a pure number; TypeError of one with a unit, of which ``to("N*m").value`` is the number."""
        if pretty(self.unit):
            raise TypeError(
                Phrase(
                    "{value} has a unit; take the number of one, as in .to({unit}).value",
                    value=self,
                    unit=repr(self.unit),
                )
            )
        return self.magnitude

    def __bool__(self) -> bool:
        return bool(self.value)

    def __eq__(self, other: object) -> bool:
        if isinstance(other, QuantityValue):
            return self._key == other._key
        return unit(self.unit).si == "1" and isinstance(other, bool | int | float | str) and self._key[1] == other

    def __hash__(self) -> int:
        return hash(self._key[1] if unit(self.unit).si == "1" else self._key)

    def __lt__(self, other: object) -> bool:
        return self.si < self._other(other)

    @property
    def _key(self) -> tuple[object, PlainValue]:
        is_number = not isinstance(self.value, bool | str)
        return unit(self.unit).kind, self.si if is_number else self.value

    def _other(self, other: object) -> float:
        """What it is compared with, SI: a quantity, a text such as ``400 N*m``, or a number in its own unit."""
        if isinstance(other, QuantityValue):
            other.m_as(self.unit)  # of the same dimension
            return other.si
        if isinstance(other, int | float | str) and not isinstance(other, bool):
            try:
                return parse_quantity(other, self.unit)
            except UnitError as fault:
                raise ConfigError(Problem(fault.args[0], path=self.name)) from None
        raise TypeError(Phrase("{value} cannot be compared with {other}", value=self, other=repr(other)))


@dataclass(frozen=True, eq=False, repr=False)
class InputValue(QuantityValue):
    """Hold an input of a calculated mechanism: ``origin`` tells where it comes from (``given``, ``default``, ``reference``, ``expression``).

    ``path`` is what it refers to, ``typed`` its text in the file, ``basis`` what it rests on (``assumed``, ``given`` …), ``note`` what is
    noted of it.
    """

    origin: str = ""
    path: str = ""
    typed: str = ""
    basis: str = ""
    note: str = ""
