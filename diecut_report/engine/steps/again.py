"""The same machines calculated again with other inputs, for plain code that seeks a size: many of them at once."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextvars import ContextVar
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from diecut_report.contract.inputs import texts_given
from diecut_report.contract.steps import Step
from diecut_report.contract.varying import Extremes
from diecut_report.engine.calculation import Calculation, CurveHandle, Impossible, Unproven
from diecut_report.engine.steps import again_faults as faults
from diecut_report.engine.steps.needed import needed
from diecut_report.expressions import Array

Calculate = Callable[..., Calculation]
DEEPEST = 2  # times that a search may be within itself, as one of a second size
SEEKING: ContextVar[tuple[tuple[str, str], ...]] = ContextVar("SEEKING", default=())
"""The kinds and steps that seek now, the outer ones first."""


@dataclass(frozen=True)
class RowsOf:
    """Hold a curve of other variants: which one for each."""

    curve: CurveHandle
    rows: Array

    def values(self, share: Array, middle: Array, rows: Array | None) -> Array:
        """Return values as the curve gives them."""
        return self.curve.values(share, middle, self.rows if rows is None else self.rows[rows])

    @property
    def breakpoints(self) -> Array:
        """Return those of the curve, of each variant."""
        return self.curve.breakpoints[self.rows]

    @property
    def joints(self) -> Array:
        """Return those of the curve, of each variant."""
        return self.curve.joints[self.rows]

    @property
    def cycle(self) -> str:
        """Return what the curve runs over."""
        return self.curve.cycle


class Again:
    """Calculate machines that differ from those of a calculation in some inputs; ``step`` asks for them."""

    def __init__(self, calc: Calculation, calculate: Calculate, step: Step) -> None:
        self.mechanism, self.count, self.calculate, self.step = calc.mechanism, calc.count, calculate, step
        self.inputs = {name: value for name, value in calc.inputs.items() if name in calc.given}

    def __call__(self, changed: Mapping[str, Any], rows: Array, names: Sequence[str]) -> dict[str, Array]:
        """Return quantities of the machines ``rows`` (variants of the calculation), each with the inputs ``changed``.

        Numbers are arrays in SI (trials, or trials and parts); a text is one for all trials, or one for each. NaN where a machine is
        impossible then, and where it does not have the quantity. Misdeclared says what of it cannot be.
        """
        faults.judge(self.mechanism, self.step, changed, len(rows), names)
        found = {name: np.full(len(rows), np.nan) for name in names}
        for trials, texts in _alike(changed, len(rows)):
            numbers = {name: _of_trials(value, trials) for name, value in changed.items() if name not in texts}
            for name, values in self._made(numbers | texts, np.asarray(rows)[trials], names).items():
                found[name][trials] = values
        return found

    @property
    def _outer(self) -> tuple[tuple[str, str], ...]:
        """The searches within which this one is made; Misdeclared where it is made within itself again and again."""
        outer = SEEKING.get()
        if outer.count((self.mechanism.kind, self.step.id)) >= DEEPEST:
            raise faults.endless(self.step)
        return outer

    def _made(self, changed: Mapping[str, Any], rows: Array, names: Sequence[str]) -> dict[str, Array]:
        """The quantities of machines of the same texts."""
        inputs = {name: _of(value, rows, self.count) for name, value in self.inputs.items()} | dict(changed)
        only = needed(self.mechanism, frozenset(inputs) | texts_given(inputs), names)
        if not only:  # none of these machines has what is asked
            return {}
        asking = SEEKING.set((*self._outer, (self.mechanism.kind, self.step.id)))
        try:
            made = self.calculate(self.mechanism, inputs, len(rows), only)
        except (Impossible, Unproven):
            return {}
        finally:
            SEEKING.reset(asking)
        possible = np.ones(len(rows), dtype=bool)
        possible[list(made.flaws)] = False
        there = [name for name in names if name in made.values or name in made.inputs]
        return {name: np.where(possible, made[name].reshape(len(rows), -1)[:, 0], np.nan) for name in there}


def _of_trials(value: Any, trials: Array) -> Any:
    """The numbers of these trials; one alone is that of all, of parts each has its own, or none."""
    if isinstance(value, tuple):
        return tuple(None if part is None else _of_trials(part, trials) for part in value)
    found = np.asarray(value, dtype=float)
    return found[trials] if found.ndim else np.full(len(trials), found)


def _alike(changed: Mapping[str, Any], count: int) -> Iterator[tuple[Array, dict[str, Any]]]:
    """The trials that have the same texts, with these."""
    texts = {name: value for name, value in changed.items() if faults.is_text(value)}
    if not texts:
        yield np.arange(count), {}
        return
    each = list(
        zip(*(np.broadcast_to(np.asarray(value, dtype=object), (count,)) for value in texts.values()), strict=True)
    )
    trials: dict[tuple[Any, ...], list[int]] = {}
    for trial, said in enumerate(each):
        trials.setdefault(said, []).append(trial)
    yield from ((np.array(own), dict(zip(texts, said, strict=True))) for said, own in trials.items())


def _of(value: Any, rows: Array, count: int) -> Any:
    """An input of these rows of a calculation of so many variants."""
    match value:
        case np.ndarray():
            return value[rows]
        case tuple():
            return tuple(_of(part, rows, count) for part in value)
        case Extremes(low=low, high=high):
            return replace(value, low=_of(low, rows, count), high=_of(high, rows, count))
        case CurveHandle() if count > 1:
            return RowsOf(value, rows)
    return value
