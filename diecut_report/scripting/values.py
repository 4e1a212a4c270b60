"""Quantity values as a script meets them: a number with its unit, that converts, prints, compares, and goes to pint."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from decimal import Decimal
from functools import total_ordering
from typing import TYPE_CHECKING, Any

from markupsafe import Markup

from diecut_report.config.model import PRESS
from diecut_report.config.parts.keys import WORDS
from diecut_report.config.plugins import Discovery, catalogues_for
from diecut_report.config.yaml import plain_text
from diecut_report.errors import ConfigError, Problem, UnknownName, Unwritable, UserError
from diecut_report.quantities.formatting import shown, with_unit
from diecut_report.quantities.units import UnitError, kind_name, parse_quantity, pretty, unit
from diecut_report.report.context import Material
from diecut_report.report.mathematics import Latex
from diecut_report.report.pages.html import filled_page
from diecut_report.report.symbols import symbol
from diecut_report.report.text import Catalogue, quantity
from diecut_report.results.model import ResultsRecord
from diecut_report.study.definition.base_inputs import MECHANISMS
from diecut_report.text.catalogues import SOURCE_LANGUAGE, UnknownLanguage, known, of_all_plugins
from diecut_report.text.phrases import Phrase, phrase
from diecut_report.text.translation import said, speaking

if TYPE_CHECKING:
    import pint


PlainValue = float | int | bool | str


def _by_pint(operation: Callable[..., Any]) -> Callable[..., QuantityValue]:
    """The method of an operator, which reckons by pint."""

    def method(self: QuantityValue, *others: Any) -> QuantityValue:
        made = operation(
            self.to_pint(), *(each.to_pint() if isinstance(each, QuantityValue) else each for each in others)
        )
        return QuantityValue(made.magnitude, f"{made.units:~C}" or "1")

    return method


@total_ordering
@dataclass(frozen=True, eq=False, repr=False)
class QuantityValue:
    """Hold a number with its unit; or a text, a yes or no, a whole number, which have none (unit ``1``).

    ``value`` counts in ``unit``: of results and inputs the SI unit, at full precision, as in the results file. ``str`` gives what
    a report prints. ``name``, ``symbol``, ``description`` and ``source`` are those of the quantity; a converted value keeps them.
    Values add, multiply, divide and take powers, by pint (whose ``DimensionalityError`` tells of unlike ones).
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
            message = Phrase("is {kind} in {unit}; {given}", kind=phrase(kind_name(own)), unit=self.unit, given=given)
            raise self._unfit(message)
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

    __neg__, __abs__, __pow__ = _by_pint(operator.neg), _by_pint(abs), _by_pint(operator.pow)
    __add__, __sub__ = _by_pint(operator.add), _by_pint(operator.sub)
    __mul__, __truediv__ = _by_pint(operator.mul), _by_pint(operator.truediv)
    __radd__ = _by_pint(lambda own, other: other + own)
    __rsub__ = _by_pint(lambda own, other: other - own)
    __rmul__ = _by_pint(lambda own, other: other * own)
    __rtruediv__ = _by_pint(lambda own, other: other / own)

    def _unfit(self, words: Phrase) -> ConfigError:
        return ConfigError(Problem(Phrase("{value} {words}.", value=str(self), words=words), path=self.name))

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
        head = Markup("{} = ").format(symbol(self.symbol)) if self.symbol else Markup("")
        return str(head + quantity(*self.printed))

    def _repr_latex_(self) -> str:
        latex = Latex(Catalogue(SOURCE_LANGUAGE), ".")
        head = f"{latex.symbol(self.symbol)} = " if self.symbol else ""
        return f"${head}{latex.quantity(*self.printed)}$"

    def __float__(self) -> float:
        """Return a pure number; TypeError of one with a unit, of which ``to("N*m").value`` is the number."""
        if pretty(self.unit):
            template = "{value} has a unit; take the number of one, as in .to({unit}).value"
            raise TypeError(Phrase(template, value=self, unit=repr(self.unit)))
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
        """What it is compared with, SI: a quantity, a text such as ``400 N*m``, zero, or a number where it has no unit itself."""
        if isinstance(other, QuantityValue):
            other.m_as(self.unit)  # of the same dimension
            return other.si
        if isinstance(other, int | float | str) and not isinstance(other, bool):
            if not isinstance(other, str) and other and pretty(self.unit):
                template = "{value} has a unit, and {other} has none; compare it with a text, such as {example}"
                raise TypeError(Phrase(template, value=self, other=other, example=repr(f"{other:g} {self.printed[1]}")))
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


# Values of a script as they are typed into a configuration: numbers, texts with units, quantities of this program, of pint and of NumPy.


NEEDED = phrase("a number, a text such as `120 mm`, a quantity, true or false is needed")


def linspace(start: Any, stop: Any, count: int) -> dict[str, Any]:
    """Return so many values from ``start`` to ``stop``, both included, in equal steps, for ``sweep``: ``linspace("80 mm", "120 mm", 41)``."""
    return {"from": start, "to": stop, "count": count}


def scalar(given: Any, path: str) -> float | int | bool | str:
    """Return a value of a script as a configuration holds it; ConfigError where it is not a single value."""
    if isinstance(given, bool | str):
        return given
    if isinstance(given, QuantityValue):
        number = scalar(given.value, path)  # of a column of a table it is one of NumPy
        return _pure(number) if given.unit == "1" else f"{number!r} {given.unit}"
    # of pint; its unit in the short form is read back as the same one
    if hasattr(given, "magnitude") and hasattr(given, "units"):
        number, own = scalar(given.magnitude, path), f"{given.units:~C}"
        return _pure(number) if own == "" else f"{number!r} {own}"
    if hasattr(given, "item") and not _is_array(given):  # a number of NumPy
        given = given.item()
    if isinstance(given, bool | str | int) or (isinstance(given, float) and math.isfinite(given)):
        return given
    message = Phrase("is {kind}; {needed}.", kind=f"{given!r:.60}", needed=NEEDED)
    raise ConfigError(Problem(message, path=path))


def _pure(value: float | int | bool | str) -> bool | str:
    """A pure number with its unit, so that a key of another kind refuses it: a bare one would count in the unit of the key; texts and flags stay."""
    return value if isinstance(value, bool | str) else f"{Decimal(repr(value)) * 100:f} %"


def _is_array(given: Any) -> bool:
    return bool(getattr(given, "ndim", False))


def typed(given: Any, path: str) -> str:
    """Return a value as it stands in the file: a text in quotes where it would be read as something else."""
    value = scalar(given, path)
    if isinstance(value, bool):
        return str(value).lower()
    return plain_text(value) if isinstance(value, str) else repr(value)


def plain(given: Any, path: str) -> Any:
    """Return blocks and lists of a script with each value as a configuration holds it; a key that is None is not given."""
    if isinstance(given, Mapping):
        known = {str(key): part for key, part in given.items() if part is not None}
        return {key: plain(part, f"{path}.{key}".lstrip(".")) for key, part in known.items()}
    if hasattr(given, "magnitude") and _is_array(given.magnitude):  # an array of pint
        return [plain(part, f"{path}.{index}") for index, part in enumerate(given)]
    if given is None or isinstance(given, str | QuantityValue) or hasattr(given, "magnitude"):
        return None if given is None else scalar(given, path)
    if isinstance(given, Iterable) and (_is_array(given) or not hasattr(given, "ndim")):
        return [plain(part, f"{path}.{index}") for index, part in enumerate(given)]
    return scalar(given, path)


def whole_path(name: str) -> str:
    """Return the path of an input in the file, where its mechanism may be named alone."""
    return name if name.split(".")[0] in (PRESS, MECHANISMS, *WORDS) else f"{MECHANISMS}.{name}"


# What goes wrong in a script, told in the language that it asked for.


@contextmanager
def told_in(language: str | None, *, without_places: bool = False) -> Iterator[None]:
    """Let errors of a user leave as errors of a script, a ConfigError where they have no class of their own, in a language.

    ``without_places``: lines and columns are of a text that the user has not written, and are left out.
    """
    try:
        yield
    except UserError as error:
        own = type(error) if isinstance(error, UnknownName | Unwritable) else ConfigError
        language = language or SOURCE_LANGUAGE
        with speaking(language, None if language == SOURCE_LANGUAGE else of_all_plugins(language)):
            problems = [replace(each, message=said(each.message)) for each in error.problems]
        if without_places:
            problems = [replace(each, file="", line=None, column=None) for each in problems]
        raise own(problems) from error.__cause__


def known_language(language: str | None) -> str | None:
    """Return the language that is asked for; ConfigError where the program has no words of it."""
    try:
        return None if language is None else known(language)
    except UnknownLanguage as error:
        raise ConfigError(Problem(Phrase("The language {error}.", error=error), path="language")) from None


# What a notebook shows: the very texts, formulas and figures of a report, as HTML without scripts, on light and on dark paper.


def notebook_page(part: str, words: Catalogue, **given: object) -> str:
    """Return a part of the notebook's template."""
    return filled_page("notebook.html.j2", part=part, t=words, **given)


# Results as documents and notebooks are made of them.


@dataclass(frozen=True, eq=False)
class Printable:
    """Hold results with what finds the words of their plugins; ``language`` is that of messages and documents, where one was asked for."""

    data: ResultsRecord
    discovery: Discovery
    language: str | None

    @property
    def document_language(self) -> str:
        """Return the language of documents: the one that was asked for, else that of the project."""
        return self.language or self.data.project.language

    def in_language(self) -> ResultsRecord:
        """Return the results in the language of documents."""
        return self.data.with_(project=self.data.project.with_(language=self.document_language))

    def material(self, detail: str, only: str = "") -> Material:
        """Return the parts of the report at a detail; ``only`` is the mechanism, or the comparison, that is shown."""
        data = self.in_language()
        data = data.with_(report=data.report.with_(detail=detail))
        if only in data.mechanisms:
            data = data.with_(report=data.report.with_(only=[only]))
        elif only:
            data = data.with_(**self._compared(only))
        kinds = [mechanism.kind for mechanism in data.mechanisms.values()]
        return Material(data, catalogues_for(data.project.language, kinds, self.discovery))

    def _compared(self, name: str) -> dict[str, Any]:
        """A comparison alone, and the mechanisms that it is between without what takes time to print."""
        comparison, own = self.data.comparisons[name], self.data.mechanisms
        mechanisms = {each: own[each].with_(figures=[], sections=[]) for each in comparison.between}
        return {"mechanisms": mechanisms, "comparisons": {name: comparison}, "governing": None}
