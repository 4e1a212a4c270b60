"""The steps of a calculation, as a plugin declares them: each is data, the engine runs and prints it.

A step gives one quantity, known by its id, and takes others by id: what earlier steps gave, and inputs (``inputs.ID`` where a step shares it).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal, Protocol, TypedDict, Unpack, get_args

from diecut_report.formulas import Array
from diecut_report.mechanism.checks import AdviceWay
from diecut_report.mechanism.names import Binding, ByText, as_binding, bound, placed


@dataclass(frozen=True, kw_only=True, eq=False)
class Step:
    """Declare what all steps have: the quantity that it gives, and the inputs without which (or with which) it is left out.

    ``needs`` and ``lacks`` name optional inputs: the step is part of the calculation when all of ``needs`` are given and none of ``lacks``.
    ``output`` puts the quantity among the outputs of the results file, else among its values. A text input takes part in them by its value:
    ``needs=("engagement=away",)``. ``exists`` is a condition on numbers: where it does not hold the quantity is absent. ``source_symbol`` is the
    source's letter, where another. ``whole`` marks a count, an integer in the results. ``units`` are other units, each with the input beside which
    it holds: (("mass", "N"),). A row over repeated parts is named ``ID.0``, ``ID.1`` … in the results, or by ``numbered`` (``shaft_{}_speed``) from
    ``first`` on, or with ``named_by``, the text input of the parts' names: ``NAME_ID``. What is not ``printed`` serves messages or other steps.
    """

    id: str
    symbol: str = ""
    unit: str = "1"
    description: str = ""
    source: str = ""
    source_symbol: str = ""
    digits: int = 4
    output: bool = True
    needs: tuple[str, ...] = ()
    lacks: tuple[str, ...] = ()
    exists: Binding | None = None
    numbered: str = ""
    first: int = 1
    named_by: str = ""
    whole: bool = False
    units: tuple[tuple[str, str], ...] = ()
    printed: bool = True
    at: str = placed()


@dataclass(frozen=True, kw_only=True, eq=False)
class Value(Step):
    """Declare a closed formula: a number, a curve where it takes a curve or an abscissa, a row of numbers over repeated parts.

    ``per_piece`` marks a flag of a curve's smooth pieces (direction of motion, cutting): it is taken at the middle
    of the piece, so that one-sided limits at the piece's ends are well defined.
    """

    formula: Binding
    per_piece: bool = False

    def takes(self) -> tuple[str | float, ...]:
        """Return the ids (or plain numbers) that the formula takes."""
        return tuple(bound(self.formula).names.values())

    @property
    def is_condition(self) -> bool:
        """Return whether it gives yes or no."""
        return bound(self.formula).formula.tree.op in ("cmp", "and", "or", "not")


@dataclass(frozen=True, eq=False)
class Case:
    """Declare one branch of a choice: taken where the condition holds (the last one has none), and why, in words."""

    value: Binding | str
    words: str
    condition: Binding | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class Choice(Step):
    """Declare a value (number, or text where the cases' values are texts) chosen by conditions; the branch taken is printed."""

    cases: tuple[Case, ...]
    per_piece: bool = False

    def takes(self) -> tuple[str | float, ...]:
        """Return the ids (or plain numbers) that the conditions and values take."""
        parts = [p for c in self.cases for p in (c.value, c.condition) if isinstance(p, Binding)]
        return tuple(name for part in parts for name in bound(part).names.values())


@dataclass(frozen=True, kw_only=True, eq=False)
class Root(Step):
    """Declare a root found in [low, high] of ``equation``, a formula of the unknown (named ``unknown``) that is zero there.

    ``left`` = ``right`` is the relation that is printed and proves the root: another form than the one solved.
    """

    equation: Binding
    unknown: str
    low: Binding
    high: Binding
    left: Binding
    right: Binding
    tolerance: float = 1e-9


@dataclass(frozen=True, kw_only=True, eq=False)
class Abscissa(Step):
    """Declare what curves run over, [0, period): sampled at ``points`` (an input's id); shown in print at the place ``shown_at`` (an id).

    ``period`` is a part of a turn in rad, a ``Constant``, or an id. ``intervals`` are those of the search grid in each smooth piece: fewer are enough
    where breakpoints leave the pieces short. ``speed`` is the id of how fast it is run through, from which phases have
    their times; an abscissa of time needs none.
    """

    period: float | str
    points: str = "n_points"
    speed: str = ""
    shown_at: str = ""
    intervals: int = 64


@dataclass(frozen=True, kw_only=True, eq=False)
class Breakpoints(Step):
    """Declare places on an abscissa where a curve that follows jumps or has a corner: ids of numbers, or of found crossings.

    ``every`` is the id of a length within which curves turn back at most a few times: extremes and integrals are searched in
    pieces no longer than that. These are not breakpoints of the results.
    """

    abscissa: str
    places: tuple[str, ...] = ()
    every: str = ""


@dataclass(frozen=True, kw_only=True, eq=False)
class Crossings(Step):
    """Declare all places where a curve changes its sign, between the breakpoints known so far and at them.

    Their number differs from machine to machine; as outputs they are ``ID_count``, ``ID_1``, ``ID_2`` …
    """

    of: str


Operation = Literal["max", "min", "abs_max", "range", "mean", "rms", "integral"]


@dataclass(frozen=True, kw_only=True, eq=False)
class Reduction(Step):
    """Declare one number of a curve over its abscissa; extremes also give their place, the quantity ``ID_at``."""

    of: str
    operation: Operation


@dataclass(frozen=True, kw_only=True, eq=False)
class Accumulated(Step):
    """Declare a curve: the running integral of another curve over its abscissa, from the abscissa's start."""

    of: str


@dataclass(frozen=True, kw_only=True, eq=False)
class Derivative(Step):
    """Declare a curve: the derivative of another curve by its abscissa, within the smooth pieces."""

    of: str


@dataclass(frozen=True, kw_only=True, eq=False)
class Computed(Step):
    """Declare a number found by plain code where no closed formula tells it; ``method`` says in words how.

    ``function`` takes the quantities ``takes`` by position: numbers as arrays of shape (variants, 1), texts, the handles of curve inputs (``Curve``).
    It gives an array of shape (variants, 1), SI; (variants, parts) for a row over the list ``over``, or over what ``PartNames`` declares; or with
    ``is_text`` a text for each variant. Truth values are printed as yes and no.
    """

    function: Callable[..., Any]
    takes: tuple[str, ...]
    method: str
    over: str = ""
    is_text: bool = False


@dataclass(frozen=True, kw_only=True, eq=False)
class CurvePeriod(Step):
    """Declare the period of what a curve input refers to, a quantity of this step's unit.

    Where the curve runs over another kind of quantity, ``otherwise`` says in words what to give.
    """

    given: str
    otherwise: str


@dataclass(frozen=True, kw_only=True, eq=False)
class Words(Step):
    """Declare a text made by plain code, for messages (``{id}``): ``function`` takes the numbers (SI) and texts ``takes`` of one machine.

    It is made only where a message or a drawing asks for it. With ``each_part`` the function gives a tuple: a text for each part of a row.
    """

    function: Callable[..., str | tuple[str, ...]]
    takes: tuple[str, ...]
    each_part: bool = False


@dataclass(frozen=True, kw_only=True, eq=False)
class FromCurve(Step):
    """Declare a curve input taken over as a curve of this mechanism, over ``abscissa`` (of the same kind and any period).

    The one period of what is referred to is laid over one period here, or over ``lasts`` (an id) of the abscissa, so that
    the abscissa begins at the share ``start`` (an id) of it. ``gains`` says that the curve goes on where a period ends,
    as an angle does that grows from turn to turn.
    """

    given: str
    abscissa: str
    start: str = ""
    lasts: str = ""
    gains: bool = False


@dataclass(frozen=True, kw_only=True, eq=False)
class MadeCurve(FromCurve):
    """Declare a curve that plain code makes for one machine: ``function`` gives a ``Curve`` over the period of ``abscissa``.

    It takes what ``Computed`` takes; ``method`` says in words how the curve is made.
    """

    given: str = ""
    function: Callable[..., Any]
    takes: tuple[str, ...]
    method: str


@dataclass(frozen=True, kw_only=True, eq=False)
class Require(Step):
    """Declare what must hold for the machine to be possible: where it does not, the message (``{id}`` prints a quantity) and its key.

    A condition on rows must hold for each part; message and key may name the first part that fails: ``{part}`` counted
    from 1, ``{next}`` the one after it in the loop, ``{index}`` counted from 0 as in the file.
    """

    condition: Binding
    key: str
    message: str
    advise: tuple[AdviceWay, ...] = ()


@dataclass(frozen=True, kw_only=True, eq=False)
class Clash(Step):
    """Declare geometry that no printed formula tells: which of repeated parts stand in each other's way.

    ``function`` takes the rows ``takes``, each of shape (variants, parts), and gives for each part the index of the one that
    it clashes with, -1 for none, of the same shape. The message may name ``{part}`` and ``{other}``, counted from 1.
    """

    function: Callable[..., Array]
    takes: tuple[str, ...]
    key: str
    message: str


@dataclass(frozen=True, kw_only=True, eq=False)
class Phase(Step):
    """Declare when, over the period of an abscissa, the mechanism does something; its id is ``phases.NAME``.

    ``role`` is what it does: ``working`` (a tool on the product), ``rest``, ``moving``, ``window`` (room for another part). Each of
    ``spans`` goes from one place to another: ids of numbers, or 0; a place that does not exist for a machine leaves its
    span out. ``period`` is the id of what repeats, where that is not the abscissa's own. ``union`` names phases that are taken
    together instead, ``rest_of`` those that leave it the rest of the period.
    """

    role: str
    abscissa: str
    spans: tuple[tuple[str | float, str | float], ...] = ()
    union: tuple[str, ...] = ()
    rest_of: tuple[str, ...] = ()
    period: str = ""


@dataclass(frozen=True, kw_only=True, eq=False)
class Prepared(Step):
    """Declare an object that plain code makes of a machine once (``for_many``: of many at once) of those of ``holds`` that there are."""

    function: Callable[..., Any]
    holds: tuple[str, ...]
    for_many: bool = False
    again: bool = False  # it also gets ``known["again"]``, which calculates the same machines with other inputs


class SilentStep(Step):
    """Declare the base of other steps that give no quantity."""


SILENT = Breakpoints | Require | Clash | Words | Phase | Prepared | SilentStep  # steps that give no quantity


# The names of what a step gives: made here for all who show or store results, and read back for all who are given a name.
#
# A step gives one quantity, its value under the step's id. An extreme also gives its place, ``ID_at``. Crossings are
# ``ID_count`` and then ``ID_1``, ``ID_2`` … A row over repeated parts is ``ID.0``, ``ID.1`` …, or has names of its own by the
# pattern ``numbered`` (``shaft_{}_speed``), counted from ``first`` on; or, with ``named_by``, after the parts: ``NAME_ID``.


MOST_NAMED = 99
"""So many crossings or parts may be named before a machine is calculated; how many it has shows in calculating."""

CROSSING_COLUMNS = 8
"""So many crossings of a curve have columns of their own in a study, where each column is there for all variants."""

EXTREMES = ("max", "min", "abs_max")
"""The reductions that also give their place."""

INDEX = re.compile(r"(?<=[_,])[ijk]$")
"""The letter that stands for a part's number at the end of a row's symbol: ``ω_k``, ``P_V,k``."""

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


@dataclass(frozen=True)
class Pattern:
    """Describe how the parts of a row, or the crossings of a curve, are named: a number from ``first`` on between head and tail."""

    head: str
    tail: str
    first: int

    @property
    def is_path(self) -> bool:
        """Return whether the number is a key of its own, as a list's parts have it."""
        return self.head.endswith(".")

    @property
    def family(self) -> str:
        """Return what is numbered: ``shaft`` of ``shaft_{}_speed``."""
        return self.head.rstrip("._")

    @property
    def quantity(self) -> str:
        """Return what is said of each: ``speed`` of ``shaft_{}_speed``; none where the family is of one quantity alone."""
        return self.tail.lstrip("._")

    def name(self, step: Step, index: int) -> ResultName:
        """Return the name of a part or crossing."""
        number = self.first + index
        role: Role = "crossing" if isinstance(step, Crossings) else "part"
        printed = number + 1 if self.is_path and not self.first else number
        return ResultName(f"{self.head}{number}{self.tail}", step.id, role, index, printed)

    def index(self, name: str) -> int | None:
        """Return which part has a name, None where it is not of this pattern."""
        inner = name[len(self.head) : len(name) - len(self.tail)]
        is_number = inner.isascii() and inner.isdecimal() and str(int(inner)) == inner
        if not is_number or name != f"{self.head}{inner}{self.tail}" or int(inner) < self.first:
            return None
        return int(inner) - self.first


def pattern(step: Step) -> Pattern:
    """Return how a step's parts or crossings are named."""
    if isinstance(step, Crossings):
        return Pattern(f"{step.id}_", "", 1)
    if not step.numbered:
        return Pattern(f"{step.id}.", "", 0)
    head, _, tail = step.numbered.partition("{}")
    return Pattern(head, tail, step.first)


def has_own_names(step: Step) -> bool:
    """Return whether the parts or crossings that a step gives are quantities of their own, which formulas and references name."""
    return bool(step.numbered) or isinstance(step, Crossings)


def result_names(step: Step, parts: int | None = None, names: Sequence[str] | None = None) -> tuple[ResultName, ...]:
    """Return all names that a step gives, in the order of the results.

    ``parts`` says how many parts a row has, or how many crossings there are; None for a single number or a curve. ``names`` are those of
    the parts, after which a row with ``named_by`` is named.
    """
    if isinstance(step, SILENT):
        return ()
    if step.named_by and names is not None:
        return tuple(ResultName(part_result(name, step), step.id, "part", i, i + 1) for i, name in enumerate(names))
    if parts is None and not isinstance(step, Crossings):
        return (ResultName(step.id, step.id), *_beside(step))
    made = pattern(step)
    return (*_beside(step), *(made.name(step, index) for index in range(parts or 0)))


def names_ahead(step: Step) -> tuple[ResultName, ...]:
    """Return the names that a step may give, known before a machine is calculated; of a row without own names its id."""
    return result_names(step, MOST_NAMED if has_own_names(step) else None)


def numbered_symbol(step: Step, number: int) -> str:
    """Return the symbol of one part or crossing: with its number behind it, or, of a row, in the place of its index (``ω_k``)."""
    symbol, indices = (step.symbol, 0) if isinstance(step, Crossings) else INDEX.subn(str(number), step.symbol)
    return symbol if indices else f"{symbol}{',' if '_' in symbol else '_'}{number}"


def part_result(name: str, step: Step) -> str:
    """Return what a row or curve with ``named_by`` is called of the part of a name."""
    return f"{name}_{step.id}"


def place_name(id: str) -> str:
    """Return what the place of an extreme is called."""
    return f"{id}_at"


def count_name(id: str) -> str:
    """Return what the number of crossings is called."""
    return f"{id}_count"


def _beside(step: Step) -> Iterator[ResultName]:
    """Yield what a step gives beside its value."""
    if isinstance(step, Reduction) and step.operation in EXTREMES:
        yield ResultName(place_name(step.id), step.id, "place")
    if isinstance(step, Crossings):
        yield ResultName(count_name(step.id), step.id, "count")


def read(name: str, step: Step) -> ResultName | None:
    """Return what a name is of a step, None where the step does not give it."""
    if isinstance(step, SILENT):
        return None
    if name == step.id:
        return ResultName(name, step.id)
    known = next((beside for beside in _beside(step) if beside.name == name), None)
    index = pattern(step).index(name)
    return known if index is None else pattern(step).name(step, index)


def named(name: str, steps: Mapping[str, Step], numbered: Iterable[Step] | None = None) -> ResultName | None:
    """Return which of steps, by their ids, gives a name, and what it is of it; None where none does.

    A part that has a name of its own may also be asked for as part of its row, ``ID.0``. ``numbered`` are the steps with such parts,
    where they are known.
    """
    with_parts = (step for step in steps.values() if step.numbered) if numbered is None else numbered
    found = (read(name, step) for step in _candidates(name, steps, with_parts))
    return next((each for each in found if each is not None), None) or _part_of_row(name, steps)


def _candidates(name: str, steps: Mapping[str, Step], with_parts: Iterable[Step]) -> Iterator[Step]:
    """Yield the steps that may give a name, first the one whose id it is."""
    for known in (name, name.rpartition("_")[0], name.rpartition(".")[0]):
        if known in steps:
            yield steps[known]
    yield from with_parts


def _part_of_row(name: str, steps: Mapping[str, Step]) -> ResultName | None:
    step = steps.get(name.rpartition(".")[0])
    if step is None or not step.numbered or pattern(step).head == f"{step.id}.":
        return None
    index = Pattern(f"{step.id}.", "", 0).index(name)
    return None if index is None else ResultName(name, step.id, "part", index, pattern(step).first + index)


# What an author may write of any step: formulas in their forms, and what a step may say besides.


Written = Binding | ByText | Callable[..., Any]
"""A formula as an author writes it: a lambda, a ``@formula``, one that is bound, one chosen by a text."""


class Options(TypedDict, total=False):
    """Declare what any step may say besides; see ``Step``."""

    source: str
    source_symbol: str
    digits: int
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


def case(value: Written | str, words: str, condition: Written | None = None) -> Case:
    """Return one branch of a choice: its value (formula or text), why in words, and when it is taken; the last one has no condition."""
    taken = value if isinstance(value, str) else as_binding(value, words)
    return Case(taken, words, None if condition is None else as_binding(condition, words))


# Phases: when, over the period of an abscissa, a mechanism works, rests, moves or leaves room.


PhaseRole = Literal["working", "rest", "moving", "window"]
ROLES: tuple[str, ...] = get_args(PhaseRole)
PREFIX = "phases."
"""What the name of a phase begins with, where quantities are named too: in references and among the ids of steps."""


class StepHolder(Protocol):
    """What steps can be added to."""

    def add(self, *steps: Step | Iterable[Any]) -> None:
        """Add steps."""


class PhaseForm:
    """Give chapters the call that declares a phase."""

    def phase(
        self: StepHolder,
        name: str,
        role: PhaseRole,
        description: str,
        abscissa: str,
        *spans: tuple[str | float, str | float],
        union: tuple[str, ...] = (),
        rest_of: tuple[str, ...] = (),
        period: str = "",
        **when: Unpack[StepCondition],
    ) -> None:
        """Declare when the mechanism works, rests, moves or leaves room, over the period of ``abscissa``.

        Each of ``spans`` goes from one place to another, both ids of numbers (0 for the start of the period), the end counted on
        where it passes the period. Instead of spans ``union`` names phases that this one holds together, ``rest_of`` those
        that it leaves out.
        """
        own: dict[str, Any] = {"role": role, "abscissa": abscissa, "spans": spans, "union": union, "rest_of": rest_of}
        own["period"] = period
        self.add(Phase(id=f"{PREFIX}{name}", description=description, **own, **when))
