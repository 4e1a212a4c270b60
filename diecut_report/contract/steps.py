"""The steps of a calculation, as a plugin declares them: each is data, the engine runs and prints it.

A step gives one quantity, known by its id, and takes others by id: what earlier steps gave, and inputs (``inputs.ID`` where a step shares it).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

from diecut_report.contract.binding import Binding, bound
from diecut_report.contract.place import placed
from diecut_report.expressions import Array


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
