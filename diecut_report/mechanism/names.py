"""Where an author's file declares something: every declared thing carries it, so that what is wrong with it is reported there."""

from __future__ import annotations

import operator
import reprlib
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields, is_dataclass, replace
from types import FunctionType
from typing import Annotated, Any, Literal, NamedTuple, Protocol

from pydantic import GetCoreSchemaHandler
from pydantic_core import CoreSchema, core_schema

from diecut_report.errors import nearest
from diecut_report.formulas import Array
from diecut_report.formulas.expression import Expression, author_place
from diecut_report.formulas.formula import Formula, WrittenFormula
from diecut_report.text.phrases import Phrase

OWN = "diecut_report.mechanism"


def here() -> str:
    """Return the place, ``file:line``, of the call outside the contract that declares what is being made."""
    file, line = author_place()
    return f"{file}:{line}"


def placed() -> Any:
    """Return a field ``at`` with the place where its owner is declared: no part of its value, kept by ``dataclasses.replace``."""
    return field(default_factory=here, kw_only=True, repr=False, compare=False)


class Misdeclared(TypeError):
    """Report that what a plugin declares cannot be made; the text says so with the place that is named, or where it is declared now."""

    def __init__(self, text: str, at: str = "") -> None:
        super().__init__(f"{at or here()}: {text}")


# Ids: wherever one is wanted, a quantity stands for its own.


def ids(part: Any, at: str = "") -> Any:
    """Return an id for a quantity, in tuples and tables too; all else as it is. Misdeclared where an expression is no single quantity."""
    match part:
        case Expression():
            if not part.id:
                template = "{part} is calculated, where a single quantity is wanted; declare it, chapter.NAME = …, and name m.NAME here"
                raise Misdeclared(Phrase(template, part=repr(part)), at)
            return part.id
        case tuple() | list() if type(part) in (tuple, list):
            found = type(part)(ids(each, at) for each in part)
            return part if all(map(operator.is_, found, part)) else found
        case dict() if type(part) is dict:
            return {key: ids(each, at) for key, each in part.items()}
    return part


def with_ids(declared: Any, at: str = "") -> Any:
    """Return what is declared with ids for the quantities in its fields, and in those of what it holds."""
    if isinstance(declared, tuple):
        return tuple(with_ids(each, at) for each in declared)
    if not is_dataclass(declared) or isinstance(declared, type):
        return declared
    given = {each.name: getattr(declared, each.name) for each in fields(declared) if each.init}
    at = getattr(declared, "at", at)
    changed = {name: ids(with_ids(part, at), at) for name, part in given.items()}
    return declared if all(map(_same, given.values(), changed.values())) else replace(declared, **changed)


def _same(one: Any, other: Any) -> bool:
    return one is other or (isinstance(one, tuple) and len(one) == len(other) and all(map(_same, one, other)))


# Inputs.


@dataclass(frozen=True, kw_only=True)
class DeclaredKey:
    """Declare what any input may say: whether it is ``optional``, so that it may be absent, or its ``default``, as one would type it."""

    optional: bool = False
    default: Any = ...
    at: str = placed()

    @property
    def form(self) -> Any:
        """Return what its value is when it is given."""
        return Any

    @property
    def given_as(self) -> Any:
        """Return its annotation for pydantic."""
        return Annotated[self.form | None if self.optional else self.form, self]

    @property
    def otherwise(self) -> Any:
        """Return its value where nobody gives one; ``...`` where it must be given."""
        return None if self.optional and self.default is ... else self.default


@dataclass(frozen=True)
class Text(DeclaredKey):
    """Declare an input that is a text, one of several (``options``), yes or no (a default that is True or False), or ``many`` texts.

    ``options`` that are no tuple are a registry, in which others may be added later. ``block`` is that of a block or of a list's parts.
    """

    description: str
    options: Collection[str] = ()
    symbol: str = ""
    many: bool = False
    block: type | None = None

    def __post_init__(self) -> None:
        if isinstance(self.options, str):
            template = "options are {given}, a single text; write a tuple of all that are allowed, with a comma behind a single one: ({given},)"
            raise Misdeclared(Phrase(template, given=repr(self.options)), self.at)

    @property
    def form(self) -> Any:
        """Return what its value is when it is given."""
        one: Any = self.block or (bool if isinstance(self.default, bool) else str)
        if isinstance(self.options, tuple) and self.options:
            one = Literal[self.options]
        return list[one] if self.many else one

    @property
    def otherwise(self) -> Any:
        """Return its value where nobody gives one: of many, none."""
        return [] if self.many and self.optional else super().otherwise

    @property
    def given_as(self) -> Any:
        """Return its annotation for pydantic: an empty list stands for none."""
        return Annotated[self.form, self] if self.many else super().given_as

    def validate(self, given: str | None) -> str | None:
        """Return the text, if it is one of the options; ValueError with the known ones in words where it is not."""
        if given is None or given in self.options:
            return given
        raise ValueError(f"is “{given}”{nearest(given, self.options)}; allowed: {', '.join(self.options)}")

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        schema = handler(source)
        is_registry = self.options and not isinstance(self.options, tuple)
        return core_schema.no_info_after_validator_function(self.validate, schema) if is_registry else schema


# What may stand in for a typed value: a number that is known already, a reference, a default of the press, one of several.


@dataclass(frozen=True)
class SI:
    """Hold a number (of many machines an array of them) that is already in SI, from a reference or a default of the press.

    ``told`` says from where.
    """

    value: Any
    unit: str
    told: str


@dataclass(frozen=True)
class Pending:
    """Stand for a reference whose value is not known yet; ``unit`` is that of what it refers to, None where it is not a number.

    ``phase_unit`` is that of what a phase runs over.
    """

    path: str
    unit: str | None
    is_curve: bool = False
    phase_unit: str | None = None
    is_mechanism: bool = False


class Curve(Protocol):
    """Hold a curve that an input refers to, over shares of its period."""

    def is_in(self, unit: str) -> bool:
        """Return whether its values are of the dimension of a unit."""

    def values(self, share: Array, middle: Array, rows: Array | None) -> Array:
        """Return values at shares, shape (variants, points), each in the smooth piece that the share ``middle`` lies in."""

    @property
    def breakpoints(self) -> Array:
        """Return the inner edges of the curve's smooth pieces, as shares, ascending, shape (variants, places)."""

    @property
    def joints(self) -> Array:
        """Return those of them where the curve jumps or has a corner."""

    @property
    def cycle(self) -> str:
        """Return the id of what the curve runs over: of two curves over one cycle it is the same."""

    @property
    def rate(self) -> Array:
        """Return how often the curve comes again, as a speed (one turn each time), shape (variants, 1); 0 where nothing tells it."""

    @property
    def turns(self) -> Array:
        """Return the revolutions of its period, shape (variants, 1); 1 where it does not run over an angle."""


@dataclass(frozen=True)
class FromPress:
    """Name a default that the press gives: a press field's path and, where it is not that number itself, a formula of it.

    An ``optional`` one leaves the input without a value where the press does not give the field; else that is an error.
    """

    path: str
    formula: Formula | None = None
    optional: bool = False


class When(NamedTuple):
    """Hold when something is part of the calculation: all of these tokens hold, and none of those."""

    needs: frozenset[str]
    lacks: frozenset[str] = frozenset()

    def with_(self, other: When) -> When:
        """Return when both are."""
        return When(self.needs | other.needs, self.lacks | other.lacks)

    def holds(self, given: frozenset[str]) -> bool:
        """Return whether it is, where these inputs (and texts, as ``key=value``) are given."""
        return self.needs <= given and self.lacks.isdisjoint(given)


class OneOf:
    """Name inputs of which one group is needed: ``OneOf(("torque",), ("power", "speed"))``.

    One group must be given completely, and nothing of another one, but for the keys that are ``shared``: these have a use
    beside each group. Where it is ``optional`` a default holds without any of the keys. With ``when`` it is asked only where
    a text of the same block is chosen: ``when="use=drive"``.
    """

    def __init__(
        self, *groups: tuple[str, ...], shared: tuple[str, ...] = (), optional: bool = False, when: str = ""
    ) -> None:
        self.groups, self.shared, self.optional, self.when = groups, shared, optional, when

    def is_asked(self, texts: Mapping[str, Any]) -> bool:
        """Return whether the text is chosen with which the rule holds, of the values of a block with their defaults."""
        key, _, text = self.when.partition("=")
        return not key or texts.get(key) == text

    def fault(self, given: Iterable[str]) -> str:
        """Return what is wrong with the keys that are given, in words; empty where nothing is."""
        known = set(given)
        told = ", or ".join(listed(group) for group in self.groups)
        heads = list(dict.fromkeys(group[0] for group in self.groups if group[0] in known))
        if len(heads) > 1:
            template = "{listed} are both given, but only one can hold; give {told}."
            return Phrase(template, listed=listed(heads), told=told)
        complete = [group for group in self.groups if known.issuperset(group)]
        idle = known & {key for group in self.groups for key in group} - {*self.shared}.union(*complete[:1])
        if complete and not idle:
            return ""
        fuller = [group for group in self.groups if complete and {*complete[0], *idle} <= {*group}]
        if complete and not fuller:
            unused = [key for group in self.groups for key in group if key in idle]
            without = Phrase("has no use beside {listed}; remove it", listed=listed(complete[0]))
            return Phrase("{listed} {without}, or give {told}.", listed=listed(unused), without=without, told=told)
        begun = fuller or [group for group in self.groups if known & set(group) - set(self.shared)]
        if begun:
            nearest = min(begun, key=lambda group: len(set(group) - known))
            missing = [key for key in nearest if key not in known]
            beside = [key for key in nearest if key in known]
            template = "{listed} is missing beside {present}; give {told}."
            return Phrase(template, listed=listed(missing), present=listed(beside), told=told)
        chosen = Phrase(" with {key}", key=self.when.replace("=", ": ")) if self.when else ""
        return "" if self.optional else Phrase("{told} is needed{chosen}.", told=told, chosen=chosen)


def listed(keys: Sequence[str]) -> str:
    """Return keys in words: ``mass, inertia and velocity``."""
    return Phrase("{first} and {next}", first=", ".join(keys[:-1]), next=keys[-1]) if len(keys) > 1 else "".join(keys)


# Formulas of the quantities of a mechanism: the parameters of each are the ids of what it takes.


class ByText:
    """Choose a formula by a text input: the expression ``formulas[text]``, or that of a function of these quantities (``formula.of(**given)``).

    ``formulas`` may be a live view of a registry; all its formulas have the same parameters.
    """

    def __init__(self, key: str, formulas: Mapping[str, Formula | Expression], /, **given: Expression | float) -> None:
        self.key, self.formulas, self.given, self.at = ids(key), formulas, given, here()
        self._made: dict[str, Formula] = {}

    def of(self, text: str) -> Formula:
        """Return the formula for a value of the text input."""
        if text not in self._made:
            chosen = self.formulas[text]
            if isinstance(chosen, Formula):
                self._made[text] = WrittenFormula(chosen.of(**self.given), chosen.__name__, chosen.place)
            else:
                self._made[text] = WrittenFormula(chosen, text, self.at)
        return self._made[text]

    def options(self) -> tuple[Formula, ...]:
        """Return the formulas of all values."""
        return tuple(map(self.of, self.formulas))

    def renamed(self, rename: Callable[[str], str]) -> ByText:
        """Return the same choice with other ids for its quantities."""
        return ByText(self.key, {text: Expression(self.of(text).renamed(rename).spoken) for text in self.formulas})


Written = Formula | ByText | Expression | float | Callable[..., Any] | Array
"""A formula as an author writes it: an expression of quantities (of which NumPy's types say that it is an array), a number, a function whose
parameters are quantities, one chosen by a text."""


def as_formula(part: Written, name: str) -> Formula | ByText:
    """Return what an author wrote as a formula, called ``name`` in messages where it has no name of its own."""
    if isinstance(part, Expression | int | float):
        return WrittenFormula(part, name, here())
    if isinstance(part, Formula | ByText):
        return part
    if not isinstance(part, FunctionType):
        template = "{name} needs a formula, and {part} is none; write an expression of quantities, as m.radius / 2"
        raise Misdeclared(Phrase(template, name=name, part=reprlib.repr(part)))
    if part.__module__.startswith(OWN):
        template = "{name} is given by {part}, which is not called; write {part}(…)"
        raise Misdeclared(Phrase(template, name=name, part=part.__name__))
    made = Formula(part, name)
    if made.defaults:
        template = (
            "the formula of {name} has a default for {optional}, which is never used: each parameter takes "
            "a quantity; remove it"
        )
        raise Misdeclared(Phrase(template, name=name, optional=", ".join(made.defaults)))
    return made


def formula_of(part: Written) -> Formula:
    """Return a formula of a step; a choice by a text stands here for its first one, as what it takes does not depend on the text."""
    if isinstance(part, ByText):
        return part.options()[0]
    assert isinstance(part, Formula), "steps hold what as_formula gives"
    return part
