"""The steps of a calculation, as a plugin declares them: each is data, the engine runs and prints it.

A step gives one quantity, known by its id. It takes quantities by id: inputs, and what earlier steps gave. Where an
input and a step share an id, the id means the step's value and ``inputs.ID`` the input.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache, cached_property
from typing import Any, Literal

from diecut_report.expressions import Formula


@dataclass(frozen=True, eq=False)
class Bound:
    """A formula bound to quantities: each parameter's quantity id, or a plain number."""

    formula: Formula
    names: Mapping[str, str | float]

    @cached_property
    def takes(self) -> tuple[str | float, ...]:
        """What the parameters take, in their order: ids, or plain numbers as floats."""
        return tuple(name if isinstance(name, str) else float(name) for name in self.names.values())


def bind(formula: Formula, **names: str | float) -> Bound:
    """Bind a formula to quantities; a parameter that is not named takes the quantity of its own name."""
    unknown = set(names) - set(formula.parameters)
    if unknown:
        raise TypeError(f"formula {formula.__name__} has no parameter {', '.join(sorted(unknown))}")
    return Bound(formula, {p: names.get(p, p) for p in formula.parameters})


def bound(part: Bound | Formula) -> Bound:
    """A formula that is not bound yet takes the quantities of its parameters' own names."""
    return part if isinstance(part, Bound) else _by_names(part)


@cache
def _by_names(formula: Formula) -> Bound:
    return bind(formula)


@dataclass(frozen=True, kw_only=True, eq=False)
class Step:
    """What all steps have: the quantity that it gives, and the inputs without which (or with which) it is left out.

    ``needs`` and ``lacks`` name optional inputs: the step is part of the calculation when all of ``needs`` are given
    and none of ``lacks``. ``output`` puts the quantity among the outputs of the results file, else among its values.
    ``exists`` is a condition on numbers: where it does not hold the quantity is absent for that machine.
    """

    id: str
    symbol: str = ""
    unit: str = "1"
    description: str = ""
    source: str = ""
    digits: int = 4
    output: bool = True
    needs: tuple[str, ...] = ()
    lacks: tuple[str, ...] = ()
    exists: Bound | Formula | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class Value(Step):
    """A closed formula: a number, a curve where it takes a curve or an abscissa, a row of numbers over like parts.

    ``per_piece`` marks a flag of a curve's smooth pieces (direction of motion, cutting): it is taken at the middle
    of the piece, so that one-sided limits at the piece's ends are well defined.
    """

    formula: Bound | Formula
    per_piece: bool = False

    def takes(self) -> tuple[str | float, ...]:
        """The ids (or plain numbers) that the formula takes."""
        return tuple(bound(self.formula).names.values())


@dataclass(frozen=True, eq=False)
class Case:
    """One branch of a choice: taken where the condition holds (the last one has none), and why, in words."""

    value: Bound | Formula | str
    words: str
    condition: Bound | Formula | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class Choice(Step):
    """A value (number, or text where the cases' values are texts) chosen by conditions; the branch taken is printed."""

    cases: tuple[Case, ...]
    per_piece: bool = False

    def takes(self) -> tuple[str | float, ...]:
        """The ids (or plain numbers) that the conditions and values take."""
        parts = [p for c in self.cases for p in (c.value, c.condition) if isinstance(p, Bound | Formula)]
        return tuple(name for part in parts for name in bound(part).names.values())


@dataclass(frozen=True, kw_only=True, eq=False)
class Root(Step):
    """A root found in [low, high] of ``equation``, a formula of the unknown (named ``unknown``) that is zero there.

    ``left`` = ``right`` is the relation that is printed and proves the root: another form than the one solved.
    """

    equation: Bound | Formula
    unknown: str
    low: Bound | Formula
    high: Bound | Formula
    left: Bound | Formula
    right: Bound | Formula
    tolerance: float = 1e-9


@dataclass(frozen=True, kw_only=True, eq=False)
class Abscissa(Step):
    """What curves run over, [0, period): sampled at ``points`` (an input's id); shown in print at the place ``shown_at``."""

    period: float
    points: str = "n_points"
    shown_at: str = ""


@dataclass(frozen=True, kw_only=True, eq=False)
class Breakpoints(Step):
    """Places on an abscissa where a curve that follows jumps or has a corner: ids of numbers, or of found crossings."""

    abscissa: str
    places: tuple[str, ...]


@dataclass(frozen=True, kw_only=True, eq=False)
class Crossings(Step):
    """All places where a curve changes its sign, between the breakpoints known so far and at them.

    Their number differs from machine to machine; as outputs they are ``ID_count``, ``ID_1``, ``ID_2`` …
    """

    of: str


Operation = Literal["max", "min", "abs_max", "range", "mean", "rms", "integral"]


@dataclass(frozen=True, kw_only=True, eq=False)
class Reduction(Step):
    """One number of a curve over its abscissa; extremes also give their place, the quantity ``ID_at``."""

    of: str
    operation: Operation


@dataclass(frozen=True, kw_only=True, eq=False)
class Total(Step):
    """Sum or product over like parts."""

    of: str
    operation: Literal["sum", "product"]


@dataclass(frozen=True, kw_only=True, eq=False)
class Pick(Step):
    """A value of a standard series: the next one at or above, at or below, or the nearest to a quantity.

    ``series`` are the standard values in the display unit; the neighbours that were not taken are printed too.
    """

    of: str
    series: tuple[float, ...]
    rule: Literal["above", "below", "nearest"]


@dataclass(frozen=True, kw_only=True, eq=False)
class FromCurve(Step):
    """A curve input taken over as a curve of this mechanism, over ``abscissa`` (of the same kind and any period).

    The one period of what is referred to is laid over one period here.
    """

    given: str
    abscissa: str


@dataclass(frozen=True, kw_only=True, eq=False)
class Require(Step):
    """What must hold for the machine to be possible: where it does not, the message (``{id}`` prints a quantity) and its key."""

    condition: Bound | Formula
    key: str
    message: str


@dataclass(frozen=True, eq=False)
class Section:
    """A chapter of the calculation: steps under a title; ``absent`` says in words what is missing when its needs are."""

    title: str
    steps: tuple[Step, ...]
    text: str = ""
    needs: tuple[str, ...] = ()
    absent: str = ""


def prefixed(
    prefix: str, steps: tuple[Step, ...], shared: tuple[str, ...], symbol_suffix: str = ""
) -> tuple[Step, ...]:
    """One family of steps for another variant: each id gets the prefix, except what is ``shared`` by all variants."""
    own = {step.id for step in steps} - set(shared)

    def rename(part: Any) -> Any:
        match part:
            case str():
                return prefix + part if part in own or part.removesuffix("_at") in own else part
            case Bound(formula=formula, names=names):
                return Bound(formula, {p: rename(n) for p, n in names.items()})
            case Formula():
                return rename(bind(part))
            case Case(value=value, words=words, condition=condition):
                return Case(value if isinstance(value, str) else rename(value), words, rename(condition))
            case tuple():
                return tuple(map(rename, part))
        return part

    names = ("id", "formula", "cases", "of", "abscissa", "places", "shown_at", "equation", "low", "high", "left", "right",
             "condition", "exists")  # fmt: skip
    return tuple(
        replace(s, **{n: rename(getattr(s, n)) for n in names if hasattr(s, n)}, symbol=s.symbol + symbol_suffix)
        for s in steps
    )


__all__ = ["Abscissa", "Bound", "Breakpoints", "Case", "Choice", "Crossings", "FromCurve", "Operation", "Pick", "Reduction",
           "Require", "Root", "Section", "Step", "Total", "Value", "bind", "bound", "prefixed"]  # fmt: skip
