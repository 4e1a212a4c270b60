"""Curves as inputs: taken by reference, or given as a list of values over one period."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol, get_args

from pydantic import GetCoreSchemaHandler
from pydantic_core import CoreSchema, core_schema

from diecut_report.errors import MAX_CURVE_VALUES
from diecut_report.formulas import Array
from diecut_report.mechanism.names import SI, Curve, DeclaredKey, Pending
from diecut_report.quantities.formatting import told
from diecut_report.quantities.plausible import plausible
from diecut_report.quantities.units import number_and_unit, parse_quantity, pretty, to_display, unit
from diecut_report.text.phrases import Phrase, phrase


def by_validate(declared: Any, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
    """Let pydantic read an input by the ``validate`` of what declares it, which sees no None where the annotation allows that."""
    may_be_none, validate = type(None) in get_args(source), declared.validate
    read = (lambda given: None if given is None else validate(given)) if may_be_none else validate
    return core_schema.no_info_plain_validator_function(read)


@dataclass(frozen=True)
class CurveInput(DeclaredKey):
    """Declare a curve taken by reference, or (unless ``referred``) a list of equally spaced numbers over one period.

    The validated value is a ``Pending``, the referred curve, or a tuple of SI floats. ``units`` as for ``Quantity``.
    """

    symbol: str
    unit: str
    description: str
    referred: bool = False
    units: tuple[tuple[str, str], ...] = ()
    __get_pydantic_core_schema__ = by_validate

    def validate(self, given: Any) -> Any:
        """Return what the engine makes a curve of; ValueError in words where it cannot."""
        if isinstance(given, Pending):
            if given.unit is None or unit(given.unit).kind != unit(self.unit).kind or not given.is_curve:
                raise ValueError(Phrase("${{path}} is not a curve in {unit}", path=given.path, unit=self.unit))
            return given
        if isinstance(given, list) and not self.referred:
            if len(given) < 4:
                template = "has {count} values; a curve needs at least 4 over its period"
                raise ValueError(Phrase(template, count=len(given)))
            if len(given) > MAX_CURVE_VALUES:
                template = "has {count} values; at most {max_curve_values} are allowed for a curve"
                raise ValueError(Phrase(template, count=len(given), max_curve_values=MAX_CURVE_VALUES))
            return tuple(self._listed(value) for value in given)
        if hasattr(given, "curve_id"):
            return given
        or_list = "" if self.referred else phrase(" or a list of values")
        template = "is {given}; a reference to a curve{or_list} in {unit} is needed"
        raise ValueError(Phrase(template, given=repr(given), or_list=or_list, unit=self.unit))

    def _listed(self, given: Any) -> float:
        """Return one value of a list in SI; one that is referred to is in SI already."""
        if isinstance(given, SI) and unit(given.unit).kind != unit(self.unit).kind:
            template = "{told} is in {unit}; a quantity in {unit_2} is needed here"
            raise ValueError(Phrase(template, told=given.told, unit=given.unit, unit_2=self.unit))
        value = float(given.value) if isinstance(given, SI) else parse_quantity(given, self.unit)
        sizes = plausible(self.unit)
        if not sizes.holds(value):
            shown = f"{to_display(value, self.unit):.6g} {pretty(self.unit)}".rstrip()
            source = Phrase(" (from {told})", told=given.told) if isinstance(given, SI) else ""
            template = "holds {shown}{source}, which is not plausible; plausible: {told}, or 0"
            raise ValueError(Phrase(template, shown=shown, source=source, told=sizes.told))
        return value


# Phases of other mechanisms, and other mechanisms as a whole, as inputs.


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
class PhaseInput(DeclaredKey):
    """Declare a phase of another mechanism, taken by reference: ``${drive.phases.cutting}``.

    ``unit`` is that of the abscissa it runs over (an angle, a time). The validated value is a ``Pending`` or the phase
    (``GivenPhase``).
    """

    symbol: str
    unit: str
    description: str
    __get_pydantic_core_schema__ = by_validate

    def validate(self, given: Any) -> Any:
        """Return the phase; ValueError in words where there is none, or where it runs over something else."""
        other = getattr(given, "phase_unit", None)
        if other is None:
            named = f"${{{given.path}}}" if isinstance(given, Pending) else f"{given!r}"
            raise ValueError(Phrase("{named} is not a phase; {needed}", named=named, needed=self.needed))
        if unit(other).kind != unit(self.unit).kind:
            template = "is a phase over an abscissa in {pretty}; one in {pretty_2} is needed here"
            raise ValueError(Phrase(template, pretty=pretty(other), pretty_2=pretty(self.unit)))
        return given

    @property
    def needed(self) -> str:
        """Return in words what is to be given."""
        return phrase("a reference to a phase is needed, as in ${drive.phases.cutting}")


@dataclass(frozen=True)
class MechanismInput(DeclaredKey):
    """Declare another mechanism of the configuration, taken whole by its name: ``mechanism: drive``.

    It is calculated first, as if it were referred to. The validated value is a ``Pending`` or the mechanism (``GivenMechanism``).
    """

    description: str
    symbol: str = ""
    __get_pydantic_core_schema__ = by_validate

    def validate(self, given: Any) -> Any:
        """Return the mechanism; ValueError in words where there is none."""
        if getattr(given, "is_mechanism", False):
            return given
        named = f"${{{given.path}}}" if isinstance(given, Pending) else f"{given!r}"
        template = "{named} is not a mechanism; the name of one is needed, as in mechanism: drive"
        raise ValueError(Phrase(template, named=named))


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

    def cycle(self) -> float:
        """Return after which length of its first abscissa it comes again, SI: more than the period where a part of it is calculated alone."""

    def speed(self, abscissa: str = "") -> float | None:
        """Return how fast that abscissa is run through, SI; None where that is not known."""


# Keys whose text may name an entry in a table of the user's own, beside the configuration.


@dataclass(frozen=True)
class FromTable:
    """Name a key whose text may be an entry of the user's table ``table``, and the keys that such an entry gives.

    ``gives`` has for each key of the block the key of the entry: {"sigma_h_lim_1": "sigma_h_lim"}. The key itself is left out
    then, or has the text ``stands_for``, by which the steps are chosen. What the block gives itself stays.
    """

    key: str
    table: str
    gives: Mapping[str, str]
    stands_for: str = ""


# Quantities that may be given in one of two kinds of unit, as a margin in degrees or in milliseconds.


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
        return bool(number_and_unit(text)[1])
    except ValueError:
        return False
