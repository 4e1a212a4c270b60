"""What all types of step have: their fields, and the questions that the rooms of the program ask them.

A step gives one quantity, known by its id, and takes others by id: what earlier steps gave, and inputs (``inputs.ID`` where a step shares it).
A type of step is a subclass in a file of its own: its fields, what it takes and gives, its dimension, its faults, how it runs and prints.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache
from inspect import Parameter, Signature, signature
from typing import Any, ClassVar, Concatenate, Literal, ParamSpec, Protocol, TypedDict

from diecut_report.errors import nearest
from diecut_report.formulas import Array
from diecut_report.formulas.expression import Expression, FormulaError
from diecut_report.mechanism.names import Misdeclared, Written, as_formula, here, ids
from diecut_report.mechanism.steps.protocols import (
    LABELS,
    OF_UNIT,
    ROW,
    Called,
    Item,
    Kinds,
    Names,
    StepEngine,
    StepFormula,
    StepPrinter,
    TakenName,
)
from diecut_report.quantities.units import Kind
from diecut_report.text.phrases import Phrase

P = ParamSpec("P")


class StepHolder(Protocol):
    """What steps can be added to."""

    def add(self, *steps: Step | Iterable[Any]) -> None:
        """Add steps."""


@dataclass(frozen=True, eq=False, repr=False)
class Recipe:
    """Hold what gives a quantity, before it is said which: the type of step with all that it takes beside id, symbol, unit and description."""

    make: Callable[..., Step]
    args: tuple[Any, ...]
    options: dict[str, Any]

    def step(self, id: str, symbol: str, unit: str, description: str, source: str = "") -> Step:
        """Return the step that gives a quantity so."""
        options = self.options | ({"source": source} if source else {})
        return made(self.make, (id, symbol, unit, description, *self.args), options)

    def __repr__(self) -> str:
        return f"{name_of_call(_step_type(self.make))}(…)"


def recipe(make: Callable[Concatenate[str, str, str, str, P], Step]) -> Callable[P, Recipe]:
    """Return the call that says how a type of step gives a quantity: ``chapter.ID = reduction("max", of="force"), "F", "N", "Greatest force"``."""

    def given(*args: P.args, **options: P.kwargs) -> Recipe:
        return Recipe(make, args, options)

    step_type = _step_type(make)
    given.__name__, given.__doc__ = name_of_call(step_type), make.__doc__
    own = [each for name, each in _own(make).items() if name not in HEAD]
    given.__signature__ = _signature(own, Options)  # type: ignore[attr-defined]
    return given


def form(make: Callable[P, Step]) -> Callable[Concatenate[StepHolder, P], None]:
    """Return the call of a chapter that declares a step of a type that gives no single quantity: it takes what the type takes."""

    def declare(self: StepHolder, /, *args: P.args, **options: P.kwargs) -> None:
        self.add(made(make, args, options))

    step_type = _step_type(make)
    declare.__name__, declare.__doc__ = name_of_call(step_type), make.__doc__
    taken = [Parameter("self", Parameter.POSITIONAL_ONLY), *_own(make).values()]
    declare.__signature__ = _signature(taken, _shared(step_type))  # type: ignore[attr-defined]
    return declare


FOR_READERS = ("symbol", "unit", "description", "source", "source_symbol")  # texts that name no quantity
HEAD = ("id", "symbol", "unit", "description")


def made(make: Callable[..., Step], args: tuple[Any, ...], options: Mapping[str, Any]) -> Step:
    """Return a step; Misdeclared where an option is unknown, TypeError where something is missing or too much."""
    step_type = _step_type(make)
    known = (*_own(make), *_shared(step_type).__annotations__)
    for name in options.keys() - set(known):
        template = "{id} has no option {name}{near}"
        raise Misdeclared(Phrase(template, id=[*args, ""][0], name=name, near=nearest(name, known)))
    try:
        return make(*args, **options)
    except (Misdeclared, FormulaError):
        raise
    except TypeError as wrong:
        _refuse_call(make, args, options)
        raise wrong


def _refuse_call(make: Callable[..., Step], args: tuple[Any, ...], options: Mapping[str, Any]) -> None:
    """Raise Misdeclared where something is missing in a call, or too much."""
    try:
        signature(make).bind(*args, **options)
    except TypeError as wrong:
        own = _own(make)
        known = (
            [*own]
            if "id" in own and issubclass(_step_type(make), SilentStep)
            else [each for each in own if each not in HEAD]
        )
        template = "{id}: {call}() cannot be called so: {wrong}; it takes {known}, and options by their names"
        told = {"id": [*args, ""][0], "call": name_of_call(_step_type(make)), "wrong": str(wrong)}
        raise Misdeclared(Phrase(template, told, known=", ".join(known))) from None


def name_of_call(step_type: type[Step]) -> str:
    """Return the name by which authors call a type of step."""
    return "".join(f"_{each.lower()}" if each.isupper() else each for each in step_type.__name__).lstrip("_")


def _step_type(make: Any) -> type[Step]:
    found: type[Step] = make if isinstance(make, type) else make.__self__
    return found


def _signature(own: Iterable[Parameter], shared: type) -> Signature:
    more = Parameter("options", Parameter.VAR_KEYWORD, annotation=f"Unpack[{shared.__name__}]")
    return Signature([*sorted(own, key=lambda each: each.kind), more])


def _shared(step_type: type[Step]) -> type:
    return StepCondition if issubclass(step_type, SilentStep) else Options


@cache
def _own(make: Callable[..., Step]) -> dict[str, Parameter]:
    """What a type takes of its own, beside the options that it shares with others."""
    step_type = _step_type(make)
    declared = {
        name for base in step_type.__mro__ if base not in Step.__mro__ for name in vars(base).get("__annotations__", ())
    }
    return {
        n: each
        for n, each in signature(make).parameters.items()
        if n == "id" or n in declared or (make is not step_type and each.kind is not each.VAR_KEYWORD)
    }


def tuple_faults(declared: Any, *names: str) -> Iterator[str]:
    """Yield fields that are no tuples of texts."""
    template = 'has {name}={given}; write a tuple of texts, with a comma behind a single one: {name}=("key",)'
    for name in names:
        given = getattr(declared, name)
        if not isinstance(given, tuple) or not all(isinstance(each, str) for each in given):
            yield Phrase(template, name=name, given=repr(given))


class Options(TypedDict, total=False):
    """Declare what any step that gives a quantity may say besides; see ``Step``."""

    source: str
    source_symbol: str
    digits: int
    shown_to: float
    output: bool
    needs: tuple[str, ...]
    lacks: tuple[str, ...]
    exists: Written | None
    numbered: str
    first: int
    named_by: str
    whole: bool
    printed: bool
    units: tuple[tuple[str, str], ...]


class StepCondition(TypedDict, total=False):
    """Declare with which optional inputs a step takes part that gives no quantity."""

    needs: tuple[str, ...]
    lacks: tuple[str, ...]


Role = Literal["value", "place", "count", "crossing", "part"]


@dataclass(frozen=True)
class ResultName:
    """Hold a name, the id of the step that gives it, and what it is of the step's quantity.

    A crossing and a part have an ``index``, counted from 0, and the ``number`` that tells them apart in print: the one in
    the name, or counted from 1 where the name is a path (``wraps.0``).
    """

    name: str
    id: str
    role: Role = "value"
    index: int = -1
    number: int = 0


Over = Callable[..., set[tuple[str, str]]]  # of names: the kinds and axes of what runs over something


@dataclass(frozen=True, eq=False)
class Step:
    """Declare what all steps have: the quantity that it gives, and the inputs without which (or with which) it is left out.

    ``needs`` and ``lacks`` name optional inputs: the step is part of the calculation when all of ``needs`` are given and none of ``lacks``.
    ``output`` puts the quantity among the outputs of the results file, else among its values. A text input takes part in them by its value:
    ``needs=("engagement=away",)``. ``exists`` is a condition on numbers: where it does not hold the quantity is absent. ``source_symbol`` is the
    source's letter, where another. ``whole`` marks a count, an integer in the results. ``units`` are other units, each with the input beside which
    it holds: (("mass", "N"),). A row over repeated parts is named ``ID.0``, ``ID.1`` … in the results, or by ``numbered`` (``shaft_{}_speed``) from
    ``first`` on, or with ``named_by``, the text input of the parts' names: ``NAME_ID``. What is not ``printed`` serves messages or other steps.
    A value above ``shown_to`` (in ``unit``) means nothing more than that: results and tables say "> 100" of it.
    """

    id: str
    symbol: str = field(default="", kw_only=True)
    unit: str = field(default="1", kw_only=True)
    description: str = field(default="", kw_only=True)
    source: str = field(default="", kw_only=True)
    source_symbol: str = field(default="", kw_only=True)
    digits: int = field(default=4, kw_only=True)
    shown_to: float = field(default=math.inf, kw_only=True)
    output: bool = field(default=True, kw_only=True)
    needs: tuple[str, ...] = field(default=(), kw_only=True)
    lacks: tuple[str, ...] = field(default=(), kw_only=True)
    exists: Written | None = field(default=None, kw_only=True)
    numbered: str = field(default="", kw_only=True)
    first: int = field(default=1, kw_only=True)
    named_by: str = field(default="", kw_only=True)
    whole: bool = field(default=False, kw_only=True)
    units: tuple[tuple[str, str], ...] = field(default=(), kw_only=True)
    printed: bool = field(default=True, kw_only=True)
    at: str = field(default_factory=here, kw_only=True, repr=False, compare=False)

    TAKES: ClassVar[dict[str, Kinds]] = {}
    """Fields that name quantities, beside the formulas, each with what it may stand for; ANY of what is judged elsewhere."""
    FORMULAS: ClassVar[dict[str, Kinds]] = {}
    """Fields that are formulas, each with what it may take."""
    MAY_LACK: ClassVar[tuple[str, ...]] = ("exists",)
    """Those of FORMULAS that need not be given."""
    NUMBERS: ClassVar[tuple[str, ...]] = ()
    """Those of TAKES that may be a number, not a name alone."""
    is_counted: ClassVar[bool] = False  # whether how many it gives shows in calculating
    is_taken: ClassVar[bool] = True  # whether anything may take its id
    is_run: ClassVar[bool] = True  # whether it is part of the run, not made where it is asked for
    is_made_late: ClassVar[bool] = False  # whether it may take what stands below it
    is_formula: ClassVar[bool] = False  # whether nothing but formulas gives it
    may_be_absent: ClassVar[bool] = False  # whether ``exists`` holds for it
    is_shown_at_place: ClassVar[bool] = (
        False  # whether its chapter says at which place of their abscissa curves are shown
    )
    message_places: ClassVar[tuple[str, ...]] = ()  # what its message may name beside quantities

    def __post_init__(self) -> None:
        for name, part in vars(self).items():
            if isinstance(part, Expression | tuple | dict) and name not in (*self.FORMULAS, "exists", *FOR_READERS):
                object.__setattr__(self, name, ids(part))
        for name in ("exists", *self.FORMULAS):
            if (written := getattr(self, name)) is not None or name not in self.MAY_LACK:
                called = self.id if name in ("formula", "condition") else f"{self.id} ({name})"
                object.__setattr__(self, name, as_formula(written, called))

    # What it is made of.

    def formulas(self) -> Iterator[StepFormula]:
        """Yield its formulas."""
        for name, takes in self.FORMULAS.items():
            part, field = LABELS.get(name, (name, name))
            if (written := getattr(self, name)) is not None:
                yield StepFormula(part, field, written, name in OF_UNIT, takes, name == "condition")
        if self.exists is not None:
            yield StepFormula("exists", "exists", self.exists, False, ROW, True)

    def takes_ids(self) -> Iterator[TakenName]:
        """Yield what it takes by its other fields."""
        for name, allowed in self.TAKES.items():
            given = getattr(self, name)
            named = given if isinstance(given, tuple) else (given,)
            yield from (TakenName(name, each, allowed) for each in named if allowed and each and isinstance(each, str))

    @property
    def instead(self) -> str:
        """Return the input that may be given in place of the quantity."""
        return ""

    @property
    def own_names(self) -> frozenset[str]:
        """Return the names in its fields that stand for nothing elsewhere."""
        return frozenset()

    @property
    def called(self) -> Called | None:
        """Return how its function is called, where it has one: with what it takes."""
        takes = getattr(self, "takes", None)
        return Called(len(takes)) if isinstance(takes, tuple) else None

    # What it gives.

    @property
    def is_text(self) -> bool:
        """Return whether it gives a text."""
        return False

    @property
    def is_condition(self) -> bool:
        """Return whether it gives yes or no."""
        return False

    @property
    def all_units(self) -> set[str]:
        """Return the units that it may have."""
        return {self.unit, *(other for _, other in self.units)}

    @property
    def standard_values(self) -> set[float]:
        """Return all numbers that it may have, where these are known."""
        return set()

    def kinds(self, over: Over) -> set[tuple[str, str]]:
        """Return what it may give: the kind, and the abscissa or the list that it runs over."""
        return {("number", "")}

    def runs_over(self, known: Mapping[str, str]) -> str | None:
        """Return the abscissa of the curve, or the list of the row, that it gives; ``known`` are those of other names."""
        return None

    def beside(self) -> Iterator[ResultName]:
        """Yield what it gives beside its value."""
        yield from ()

    def takes_over(self) -> set[str]:
        """Return the quantities that it gives again as they are."""
        return {self.instead} if self.instead else set()

    # What may be wrong with it.

    def shape_faults(self) -> Iterator[str]:
        """Yield what has not the shape that is wanted."""
        for name in self.TAKES:
            if not isinstance(
                given := getattr(self, name), str | tuple | (int | float if name in self.NUMBERS else str)
            ):
                template = "has {name}={given}; name the input or the step that gives it, by its id"
                yield Phrase(template, name=name, given=repr(given))

    def faults(self, names: Names, when: Any) -> Iterator[str]:
        """Yield what is wrong with what it takes."""
        yield from ()

    def same_units(self, units: Callable[[str], set[str]], names: Names) -> Iterator[tuple[str, set[str]]]:
        """Yield what it takes over as it is, with the units that this may have."""
        yield from ()

    def dimensions(self, of: Callable[[str], Kind], axis: Callable[[str], str]) -> Iterator[tuple[str, Any, Any]]:
        """Yield what it makes of a curve or an abscissa: in words, its dimension, and the one that is wanted."""
        yield from ()

    # How it runs and prints.

    def run(self, calc: StepEngine) -> None:
        """Calculate it, for all variants."""

    def can_be_judged(self, known: Collection[str]) -> bool:
        """Return whether it tells from what is known already why a machine cannot be."""
        return False

    def curve(self, sampler: Any) -> Array:
        """Return the curve that it is at the places of a sampler."""
        raise TypeError(f"{self.id} is not a curve")

    def is_same(self, pair: Any) -> bool:
        """Return whether a curve of two calculations is the same; what plain code gives is not looked into."""
        return False

    @property
    def asked_curve(self) -> str:
        """Return the curve that it searches or integrates."""
        return ""

    @property
    def signs(self) -> tuple[float, ...]:
        """Return which extremes of that curve it searches: the greatest (1), the least (-1)."""
        return ()

    def cuts(self, axis: str, axes: Mapping[str, str]) -> bool:
        """Return whether it cuts an abscissa into finer pieces."""
        return getattr(self, "abscissa", "") == axis

    def items(self, page: StepPrinter) -> list[Item]:
        """Return what is printed of it."""
        return []

    def head(self) -> Item:
        """Return what is printed of the quantity itself."""
        return {"id": self.id, "symbol": self.symbol, "description": self.description, "source": self.source}


@dataclass(frozen=True, eq=False)
class QuantityStep(Step):
    """Declare the base of steps that give a quantity: a chapter's call begins with id, symbol, unit and description."""

    symbol: str = field()
    unit: str = field()
    description: str = field()


@dataclass(frozen=True, eq=False)
class SilentStep(Step):
    """Declare the base of steps that give no quantity."""

    is_taken: ClassVar[bool] = False

    def kinds(self, over: Over) -> set[tuple[str, str]]:
        """Return nothing."""
        return set()
