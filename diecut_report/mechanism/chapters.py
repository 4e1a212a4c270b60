"""The author's form: a chapter of the calculation, written quantity by quantity in the order in which they are calculated.

Each method declares one step: its id, symbol, unit and description, then what gives it. A formula is a lambda whose parameters
are named for the quantities that it takes (``lambda radius, height: radius - height``), or ``bind(formula, parameter="id")``.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Annotated, Any, Literal, TypeVar, Unpack

from pydantic import create_model

from diecut_report.errors import nearest
from diecut_report.formulas import Array
from diecut_report.formulas.formula import Formula
from diecut_report.mechanism.checks import AdviceWay
from diecut_report.mechanism.curve_inputs import CurveInput
from diecut_report.mechanism.inputs import Block, Meta, Quantity, meta_of
from diecut_report.mechanism.names import Bound, ByText, Misdeclared, as_binding, bind, placed
from diecut_report.mechanism.part_steps import (
    Between,
    CodeForm,
    Interpolated,
    Interpolation,
    ListingForm,
    Lookup,
    MadeCurveForm,
    Neighbour,
    Part,
    Pick,
    Running,
    Total,
)
from diecut_report.mechanism.steps import (
    Abscissa,
    Accumulated,
    Breakpoints,
    Case,
    Choice,
    Clash,
    Computed,
    Crossings,
    CurvePeriod,
    Derivative,
    FromCurve,
    Operation,
    Options,
    PhaseForm,
    Reduction,
    Require,
    Root,
    Step,
    StepCondition,
    Value,
    Words,
    Written,
    names_ahead,
)
from diecut_report.standards.tables import StandardSeries, StandardTable
from diecut_report.text.phrases import Phrase


@dataclass(eq=False)
class Steps(PhaseForm, MadeCurveForm, CodeForm, ListingForm):
    """Hold declared steps in the order in which they are calculated; a family of them may be added to several chapters."""

    steps: Sequence[Step] = field(default=(), kw_only=True)

    def __iter__(self) -> Iterator[Step]:
        return iter(self.steps)

    def add(self, *steps: Step | Iterable[Any]) -> None:
        """Add steps that are declared elsewhere: a family, several of them, or what several chapters share."""
        for step in steps:
            if isinstance(step, Step):
                if any(step is other for other in self.steps):
                    raise Misdeclared(Phrase("{id} is added twice; add it once", id=step.id))
                self.steps = (*self.steps, step)
            else:
                self.add(*step)

    def value(
        self,
        id: str,
        symbol: str,
        unit: str,
        description: str,
        formula: Written,
        *,
        per_piece: bool = False,
        **options: Unpack[Options],
    ) -> None:
        """Declare a closed formula: a number, a curve where it takes a curve or an abscissa, a row over repeated parts.

        ``per_piece`` marks a flag of a curve's smooth pieces (direction of motion, cutting), taken at the middle of the piece.
        """
        self._give(Value, id, symbol, unit, description, options, formula=as_binding(formula, id), per_piece=per_piece)

    def choice(
        self,
        id: str,
        symbol: str,
        unit: str,
        description: str,
        *cases: Case,
        per_piece: bool = False,
        **options: Unpack[Options],
    ) -> None:
        """Declare a value (number or text) chosen by conditions; the last case has none. The branch taken is printed."""
        self._give(
            Choice,
            id,
            symbol,
            unit,
            description,
            options,
            cases=cases,
            per_piece=per_piece,
        )

    def root(
        self, id: str, symbol: str, unit: str, description: str, equation: Written, *, low: Written, high: Written, left: Written,
        right: Written, unknown: str = "", tolerance: float = 1e-9, **options: Unpack[Options],
    ) -> None:  # fmt: skip
        """Declare a root in [low, high] of ``equation``, zero there; ``left`` = ``right`` is printed and proves it.

        The equation names the unknown by this step's id, or by ``unknown``.
        """
        parts = {"equation": equation, "low": low, "high": high, "left": left, "right": right}
        bound = {name: as_binding(part, f"{id} ({name})") for name, part in parts.items()}
        self._give(Root, id, symbol, unit, description, options, unknown=unknown or id, tolerance=tolerance, **bound)

    def abscissa(
        self, id: str, symbol: str, unit: str, description: str, period: float | str, *, points: str = "n_points", shown_at: str = "",
        intervals: int = 64, speed: str = "", **options: Unpack[Options],
    ) -> None:  # fmt: skip
        """Declare what curves run over, [0, period): see ``Abscissa``."""
        own = {"period": period, "points": points, "shown_at": shown_at, "intervals": intervals, "speed": speed}
        self._give(Abscissa, id, symbol, unit, description, options, **own)

    def breakpoints(self, id: str, abscissa: str, *places: str, every: str = "", **when: Unpack[StepCondition]) -> None:
        """Declare places of an abscissa where a curve jumps or has a corner: see ``Breakpoints``."""
        self.add(Breakpoints(id=id, abscissa=abscissa, places=places, every=every, **when))

    def crossings(self, id: str, symbol: str, unit: str, description: str, of: str, **options: Unpack[Options]) -> None:
        """Declare all places where the curve ``of`` changes its sign: outputs ``ID_count``, ``ID_1``, ``ID_2`` …"""
        self._give(Crossings, id, symbol, unit, description, options, of=of)

    def reduction(
        self,
        id: str,
        symbol: str,
        unit: str,
        description: str,
        operation: Operation,
        of: str,
        **options: Unpack[Options],
    ) -> None:
        """Declare one number of the curve ``of`` over its abscissa; extremes also give their place, the quantity ``ID_at``."""
        self._give(Reduction, id, symbol, unit, description, options, operation=operation, of=of)

    def accumulated(
        self, id: str, symbol: str, unit: str, description: str, of: str, **options: Unpack[Options]
    ) -> None:
        """Declare the running integral of the curve ``of`` over its abscissa, a curve."""
        self._give(Accumulated, id, symbol, unit, description, options, of=of)

    def derivative(
        self, id: str, symbol: str, unit: str, description: str, of: str, **options: Unpack[Options]
    ) -> None:
        """Declare the derivative of the curve ``of`` by its abscissa, a curve."""
        self._give(Derivative, id, symbol, unit, description, options, of=of)

    def computed(
        self, id: str, symbol: str, unit: str, description: str, function: Callable[..., Any], takes: tuple[str, ...], method: str,
        *, over: str = "", is_text: bool = False, **options: Unpack[Options],
    ) -> None:  # fmt: skip
        """Declare a number that plain code finds, where no closed formula tells it: see ``Computed``."""
        own = {"function": function, "takes": takes, "method": method, "over": over}
        self._give(Computed, id, symbol, unit, description, options, **own, is_text=is_text)

    def curve_period(
        self, id: str, symbol: str, unit: str, description: str, given: str, otherwise: str, **options: Unpack[Options]
    ) -> None:
        """Declare the period of what the curve input ``given`` refers to: see ``CurvePeriod``."""
        self._give(CurvePeriod, id, symbol, unit, description, options, given=given, otherwise=otherwise)

    def from_curve(
        self, id: str, symbol: str, unit: str, description: str, given: str, abscissa: str, *, start: str = "", lasts: str = "",
        gains: bool = False, **options: Unpack[Options],
    ) -> None:  # fmt: skip
        """Declare a curve input taken over as a curve of this mechanism: see ``FromCurve``."""
        own = {"given": given, "abscissa": abscissa, "start": start, "lasts": lasts, "gains": gains}
        self._give(FromCurve, id, symbol, unit, description, options, **own)

    def require(
        self, id: str, condition: Written, key: str, message: str, advise: tuple[AdviceWay, ...] = (), **when: Unpack[StepCondition],
    ) -> None:  # fmt: skip
        """Declare what must hold for the machine to be possible, the key to change, and what is said where it does not.

        ``advise`` names the inputs of which values are found with which the machine is possible, as that of a check does.
        """
        self.add(Require(id=id, condition=as_binding(condition, id), key=key, message=message, advise=advise, **when))

    def clash(
        self, id: str, function: Callable[..., Array], takes: tuple[str, ...], key: str, message: str, **when: Unpack[StepCondition],
    ) -> None:  # fmt: skip
        """Declare which of repeated parts stand in each other's way: see ``Clash``."""
        self.add(Clash(id=id, function=function, takes=takes, key=key, message=message, **when))

    def words(
        self,
        id: str,
        function: Callable[..., str | tuple[str, ...]],
        takes: tuple[str, ...],
        *,
        each_part: bool = False,
        output: bool = True,
        **when: Unpack[StepCondition],
    ) -> None:
        """Declare a text that plain code makes of numbers, for messages: see ``Words``."""
        self.add(Words(id=id, function=function, takes=takes, each_part=each_part, output=output, **when))

    def total(
        self, id: str, symbol: str, unit: str, description: str, operation: Literal["sum", "product", "min", "max"], of: str, *,
        among: str = "", **options: Unpack[Options],
    ) -> None:  # fmt: skip
        """Declare the sum, product, least or greatest of a row, or of its parts where the row ``among`` is above zero."""
        self._give(Total, id, symbol, unit, description, options, operation=operation, of=of, among=among)

    def neighbour(
        self,
        id: str,
        symbol: str,
        unit: str,
        description: str,
        of: str,
        shift: Literal[1, -1] = 1,
        **options: Unpack[Options],
    ) -> None:
        """Declare a row: the value of the next part (1) or of the one before (-1), the parts standing in a closed loop."""
        self._give(Neighbour, id, symbol, unit, description, options, of=of, shift=shift)

    def running(
        self,
        id: str,
        symbol: str,
        unit: str,
        description: str,
        operation: Literal["sum", "product"],
        of: str,
        **options: Unpack[Options],
    ) -> None:
        """Declare a row: the sum or product of a row's parts from the first one up to each."""
        self._give(Running, id, symbol, unit, description, options, operation=operation, of=of)

    def part(
        self, id: str, symbol: str, unit: str, description: str, of: str, index: int, **options: Unpack[Options]
    ) -> None:
        """Declare the value of one part of a row: the first (``index`` = 0), the last (-1)."""
        self._give(Part, id, symbol, unit, description, options, of=of, index=index)

    def lookup(
        self, id: str, symbol: str, unit: str, description: str, table: Mapping[str, float] | StandardTable, by: str, *,
        column: str = "", given: str = "", sought_in: str = "", key: str = "", **options: Unpack[Options],
    ) -> None:  # fmt: skip
        """Declare a number from a row of a table, by the text input or the number ``by``: see ``Lookup``.

        ``column`` is one of several columns; with the optional input ``given`` its value is taken where it is given.
        """
        own = {"table": table, "by": by, "column": column, "given": given, "sought_in": sought_in, "key": key}
        self._give(Lookup, id, symbol, unit, description, options, **own)

    def interpolated(
        self, id: str, symbol: str, unit: str, description: str, table: StandardTable, of: str, *, column: str = "", key: str = "",
        interpolation: Interpolation = "linear", **options: Unpack[Options],
    ) -> None:  # fmt: skip
        """Declare a value between the rows of a table of numbers, by the quantity ``of``: see ``Interpolated``."""
        formula = bind(Between(table, column, id, interpolation), x=of)
        own = {"formula": formula, "of": of, "table": table, "column": column, "key": key}
        self._give(Interpolated, id, symbol, unit, description, options, **own)

    def pick(
        self, id: str, symbol: str, unit: str, description: str, rule: Literal["above", "below", "nearest"], of: str,
        series: tuple[float, ...] | StandardSeries | Mapping[str, StandardSeries], *, by: str = "",
        beyond: Literal["impossible", "last"] = "impossible", given: str = "", key: str = "", **options: Unpack[Options],
    ) -> None:  # fmt: skip
        """Declare a value of a standard series, taken by the quantity ``of``; its neighbours are printed: see ``Pick``.

        With the optional input ``given`` its value is taken where it is given.
        """
        own = {"rule": rule, "of": of, "series": series, "by": by, "beyond": beyond, "given": given, "key": key}
        self._give(Pick, id, symbol, unit, description, options, **own)

    def _give(
        self, kind: type[Step], id: str, symbol: str, unit: str, description: str, options: Options, **own: Any
    ) -> None:
        """Declare a step that gives a quantity."""
        given: dict[str, Any] = {"symbol": symbol, "unit": unit, "description": description, **options, **own}
        exists = options.get("exists")
        given["exists"] = None if exists is None else as_binding(exists, f"{id} (exists)")
        for name in given.keys() - (known := kind.__dataclass_fields__).keys():
            raise Misdeclared(Phrase("{id} has no option {name}{near}", id=id, name=name, near=nearest(name, known)))
        self.add(kind(id=id, **given))


MISSING = "{missing}"  # in the words of a chapter that is left out: the keys that are not given


@dataclass(eq=False)
class Chapter(Steps):
    """Declare a chapter of the calculation; ``absent`` says in words what it lacks: ``{missing}`` are the needed keys not given."""

    title: str
    text: str = field(default="", kw_only=True)
    needs: tuple[str, ...] = field(default=(), kw_only=True)
    absent: str = field(default="", kw_only=True)
    at: str = placed()


# Inputs and steps whose unit depends on which other input is given: angles or lengths, seconds or a share of the cycle.


Declared = TypeVar("Declared", bound="Meta | Step | None")


def in_form(model: type[Block], given: Collection[str]) -> type[Block]:
    """Return the inputs with the units that hold when these keys are given."""
    keys = form_keys(model).intersection(given)
    return _formed(model, keys) if keys else model


def in_unit(declared: Declared, given: Collection[str]) -> Declared:
    """Return what is declared, in the unit that holds when these keys are given."""
    if not isinstance(declared, Quantity | CurveInput | Step):
        return declared
    other = next((unit for key, unit in declared.units if key in given), None)
    return replace(declared, unit=other) if other else declared


def in_all_units(declared: Quantity | CurveInput | Step, told: Callable[[Any], str]) -> str:
    """Return what is said of a declaration, and of it in its other units with the key of each: ``N·m (with mass: N)``."""
    others = [f"with {key}: {told(in_unit(declared, [key]))}" for key, _ in declared.units]
    return told(declared) + (f" ({'; '.join(others)})" if others else "")


@cache
def form_keys(model: type[Block]) -> frozenset[str]:
    """Return the keys on which units of a model's inputs depend."""
    return frozenset(key for name in model.model_fields for key, _ in getattr(meta_of(model, name), "units", ()))


@cache
def _formed(model: type[Block], given: frozenset[str]) -> type[Block]:
    changed: dict[str, Any] = {}
    for name, declared in model.model_fields.items():
        meta = meta_of(model, name)
        other = in_unit(meta, given)
        if other is not meta:
            told = (other if part is meta else part for part in declared.metadata)
            changed[name] = (Annotated[declared.annotation, *told], ... if declared.is_required() else declared.default)
    formed: type[Block] = create_model(model.__name__, __base__=model, __module__=model.__module__, **changed)
    return formed


# What can be done with declared steps: name them anew, settle texts, ask what they take.


NAMING = ("formula", "cases", "of", "among", "takes", "given", "by", "points", "period", "abscissa", "places", "every", "start", "lasts", "speed",
          "spans", "shown_at", "taken", "parts", "columns", "equation", "low", "high", "left", "right", "condition", "exists")  # fmt: skip
"""Fields of steps that name quantities."""

Rename = Callable[[str | float], str | float]


def prefixed(prefix: str, steps: Iterable[Step], shared: tuple[str, ...], symbol_suffix: str = "") -> tuple[Step, ...]:
    """Return one family of steps for another variant: each id gets the prefix, except what is ``shared`` by all variants."""
    steps = tuple(steps)
    own_steps = [step for step in steps if step.id not in shared]
    own = {step.id for step in own_steps} | {
        e.name for step in own_steps if not step.numbered for e in names_ahead(step)
    }

    def rename(name: str | float) -> str | float:
        return f"{prefix}{name}" if name in own else name

    return tuple(
        replace(
            step,
            id=str(rename(step.id)),
            symbol=step.symbol + symbol_suffix,
            source_symbol=step.source_symbol and step.source_symbol + symbol_suffix,
            **_renamed(step, rename),
        )
        for step in steps
    )


def settled(step: Step, given: frozenset[str]) -> Step:
    """Return the step with the formulas that a text chooses, where the text is known, and with the unit that holds then."""
    step = in_unit(step, given)

    def settle(part: Any) -> Any:
        match part:
            case ByText(key=key, formulas=formulas):
                chosen = [text for text in formulas if f"{key}={text}" in given]
                return part.of(chosen[0]) if chosen else part
            case Case():
                return replace(part, value=settle(part.value), condition=settle(part.condition))
            case tuple():
                return tuple(map(settle, part))
        return part

    chosen_by_text = {name: getattr(step, name) for name in _declared(step) if _holds_text(getattr(step, name))}
    return replace(step, **{name: settle(part) for name, part in chosen_by_text.items()}) if chosen_by_text else step


def _holds_text(part: Any) -> bool:
    match part:
        case ByText():
            return True
        case Case(value=value, condition=condition):
            return _holds_text(value) or _holds_text(condition)
        case tuple():
            return any(map(_holds_text, part))
    return False


def _declared(step: Step) -> list[str]:
    return [name for name in NAMING if name in step.__dataclass_fields__]


@cache
def taken(step: Step) -> frozenset[str]:
    """Return the ids that a step names: inputs, and what earlier steps gave."""
    names: set[str] = set()

    def note(name: str | float) -> str | float:
        if isinstance(name, str) and name:
            names.add(name)
        return name

    _renamed(step, note)
    return frozenset(names)


def _renamed(step: Step, rename: Rename) -> dict[str, Any]:
    def walk(part: Any) -> Any:
        match part:
            case str():
                return rename(part)
            case Bound(formula=formula, names=names):
                return Bound(formula, {parameter: rename(name) for parameter, name in names.items()})
            case Formula():
                return walk(bind(part))
            case ByText():
                return part.renamed(rename)
            case Case(value=value, words=words, condition=condition):
                return Case(value if isinstance(value, str) else walk(value), words, walk(condition))
            case tuple():
                return tuple(map(walk, part))
        return part

    return {name: walk(getattr(step, name)) for name in _declared(step)}
