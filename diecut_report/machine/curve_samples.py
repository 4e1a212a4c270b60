"""Curves of a calculation at given places of their abscissa, each computed once from those that it takes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from diecut_report.formulas import Array
from diecut_report.machine.numerics.domain import Domain, Inside, PieceSeries
from diecut_report.mechanism.names import Binding, Bound, bound
from diecut_report.mechanism.part_steps import ComputedCurve
from diecut_report.mechanism.steps import Accumulated, Choice, Derivative, FromCurve, Value

CurveStep = Value | Choice | FromCurve | ComputedCurve | Accumulated | Derivative


class CalculatedMachines(Protocol):
    """Hold the machines that curves are of: a calculation."""

    count: int
    curves: dict[str, CurveStep]
    domains: dict[str, Domain]
    inputs: dict[str, Any]
    series: dict[str, PieceSeries]

    def __getitem__(self, name: str) -> Array:
        """A number of all machines."""

    def of_pieces(self, axis: str) -> CurveSampler:
        """Return all curves over an abscissa at the middles of its pieces, kept until these change."""


class CurveSampler:
    """Give curves at given places of their abscissa; each is computed once.

    ``inside`` are the middles of all pieces (rows, pieces) and which of them each place lies in, where there are more places than pieces.
    """

    def __init__(
        self,
        owner: CalculatedMachines,
        axis: str,
        x: Array,
        middle: Array,
        rows: Array | None,
        inside: Inside | None = None,
    ) -> None:
        self.owner, self.axis, self.x, self.mid, self.inside = owner, axis, x, middle, inside
        self.rows = rows if owner.count > 1 else None  # a single machine's numbers broadcast to all rows
        self.known: dict[str, Array] = {axis: x}

    def __getitem__(self, name: str) -> Array:
        found = self.known.get(name)
        if found is None:
            found = self.known[name] = self._compute(name)
        return found

    def over(self, name: str) -> Array:
        """Return a curve, or a number, at each of the places."""
        found = self[name]
        if np.shape(found) == self.x.shape:
            return found
        return np.broadcast_to(found, np.broadcast_shapes(np.shape(found), np.shape(self.x)))

    def _compute(self, name: str) -> Array:
        step = self.owner.curves.get(name)
        if step is None:
            number = self.owner[name]
            return number if self.rows is None else number[self.rows]
        if type(step) is Value and not step.per_piece:  # most are, and matching takes as long as a formula
            return self._apply(step.formula)
        match step:
            case FromCurve():
                return self._taken_over(step)
            case ComputedCurve():
                found: Array = step.function(self.owner.inputs[step.of], self.x, self.mid, self.rows)
                return found
            case Accumulated() | Derivative():
                return self.owner.series[name].values(self.x, self.mid, self.rows)
            case Value(per_piece=True) | Choice(per_piece=True) if self.mid is not self.x:
                return self._of_pieces(name)
        return self.formula_of(step)

    def _of_pieces(self, name: str) -> Array:
        """A flag of the pieces, at their middles."""
        if self._present is not None:
            pieces, own = self._present
            found: Array = pieces.over(name)[0].take(own)
            return found
        if self.inside is None:
            return self._at_middles[name]
        return np.take_along_axis(self._at_middles.over(name), self.inside[1], axis=1)

    @cached_property
    def _present(self) -> tuple[CurveSampler, Array] | None:
        """What gives the flags of all present pieces of a single machine, each computed once, and which of these each place lies in.

        None of many machines, and where a place lies in a piece that is not there any more.
        """
        if self.owner.count > 1:
            return None
        pieces = self.owner.of_pieces(self.axis)
        own = pieces.mid[0].searchsorted(self.mid)
        return (pieces, own) if np.array_equal(pieces.mid[0].take(own, mode="clip"), self.mid) else None

    @cached_property
    def _at_middles(self) -> CurveSampler:
        middles = self.mid if self.inside is None else self.inside[0]
        return CurveSampler(self.owner, self.axis, middles, middles, self.rows)

    def formula_of(self, step: Value | Choice) -> Array:
        """Return what a step's formula gives at x itself, of a flag of the pieces too."""
        if isinstance(step, Value):
            return self._apply(step.formula)
        held = [self._apply(c.condition) for c in step.cases if c.condition is not None]
        taken = [self._apply(c.value) for c in step.cases if not isinstance(c.value, str)]
        return chosen(held, taken)

    def _taken_over(self, step: FromCurve) -> Array:
        """A curve input at shares of its period; where it gains, with what it gained in the periods before."""
        lasts = self[step.lasts] if step.lasts else self.owner.domains[self.axis].period_of(self.rows)
        start = self[step.start] if step.start else 0.0
        share, middle = start + self.x / lasts, start + self.mid / lasts
        passed = np.floor(middle)
        curve = self.owner.inputs[step.given or step.id]
        found: Array = curve.values(share - passed, middle - passed, self.rows)
        return found + passed * curve.gain(self.rows) if step.gains else found

    def _apply(self, part: Binding) -> Array:
        link = part if type(part) is Bound else bound(part)
        known = self.known
        taken = [n if isinstance(n, float) else known[n] if n in known else self[n] for n in link.takes]
        found: Array = link.formula.function(*taken)
        return found


def chosen(held: Sequence[Any], values: Sequence[Any]) -> Array:
    """Return the values of the first condition that holds, the last where none does."""
    found = values[-1]  # NumPy's select takes five times as long for the short arrays of one machine
    for condition, value in zip(reversed(held), reversed(values[:-1]), strict=True):
        found = np.where(condition, value, found)
    return np.asarray(found)


# A curve that is given as a list of values.


@dataclass(frozen=True)
class SampledCurve:
    """Hold a curve given as equally spaced values over one period; between them it runs straight."""

    numbers: tuple[float, ...]

    def values(self, share: Array, middle: Array, rows: Array | None) -> Array:
        """Return values at shares of the period, of any shape (all variants have the same curve, which has no jumps)."""
        places = np.arange(len(self.numbers) + 1) / len(self.numbers)
        found: Array = np.interp(share % 1, places, [*self.numbers, self.numbers[0]])
        return found

    @property
    def breakpoints(self) -> Array:
        """Return the given places, where the curve has its corners, as shares of the period, shape (1, places)."""
        return np.arange(len(self.numbers))[None, :] / len(self.numbers)

    joints = breakpoints
    cycle = "list"  # of values, over whatever takes it

    def gain(self, rows: Array | None) -> Array:
        """Return nothing: the curve closes."""
        return np.zeros((1, 1))
