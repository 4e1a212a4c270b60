"""The same machines calculated again with other inputs, for plain code that seeks a size: many of them at once."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextvars import ContextVar
from itertools import chain
from typing import Any

import numpy as np

from diecut_report.errors import nearest
from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, Impossible, Unproven, of_rows
from diecut_report.machine.steps.needed import needed
from diecut_report.mechanism.inputs import Key, Quantity, keys, texts_given
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.names import Misdeclared
from diecut_report.mechanism.steps import Step, named
from diecut_report.quantities.units import pretty
from diecut_report.text.phrases import Phrase, phrase

# What plain code asks of machines that are calculated again, and that cannot be: told at the step that asks for it.


def is_text(value: Any) -> bool:
    """Return whether what is tried are texts, or yes and no; a tuple of others is what the parts of a list have."""
    if isinstance(value, tuple):
        return bool(value) and all(isinstance(each, str) for each in value)
    return np.asarray(value).dtype.kind in "UOb"


def judge(mechanism: Mechanism, step: Step, changed: Mapping[str, Any], count: int, names: Sequence[str]) -> None:
    """Raise Misdeclared with the first thing that cannot be calculated so."""
    wrong = next(chain(_inputs(mechanism, changed, count), _asked(mechanism, names)), None)
    if wrong:
        raise _told(step, wrong)


def _told(step: Step, wrong: str) -> Misdeclared:
    return Misdeclared(Phrase("step {id}: {call} {wrong}", id=step.id, call='known["again"]', wrong=wrong), step.at)


def _inputs(mechanism: Mechanism, changed: Mapping[str, Any], count: int) -> Iterator[str]:
    known = keys(mechanism.inputs)
    for name, value in changed.items():
        if name not in known:
            yield Phrase("changes {name}, which is not an input{near}", name=name, near=nearest(name, known))
        elif not isinstance(value, tuple) and np.ndim(value) and len(value) != count:
            template = "gets {n} values of {name} for {count} trials; give one for each"
            yield Phrase(template, n=len(value), name=name, count=count)
        elif is_text(value):
            yield from _text(known[name], value)
        elif known[name].texts:
            template = "tries numbers for {name}, which is a text: {texts}"
            yield Phrase(template, name=name, texts=", ".join(known[name].texts))


def _text(key: Key, value: Any) -> Iterator[str]:
    """What is wrong with texts in the place of an input."""
    tried = dict.fromkeys(np.ravel(np.asarray(value, dtype=object)))
    if isinstance(key.meta, Quantity):
        shown = pretty(key.meta.unit) or "1"
        template = "tries {value} for {name}, which is a number: give it in SI, si(…, {unit})"
        yield Phrase(template, value=repr(next(iter(tried))), name=key.path, unit=repr(shown))
    elif key.home or key.block:
        template = "tries texts for {name}, a key of a list's parts, of which numbers alone can be tried"
        yield Phrase(template, name=key.path)
    for text in tried if key.texts and not isinstance(key.meta, Quantity) else ():
        if (str(text).lower() if isinstance(text, bool) else text) not in key.texts:
            template = "tries {text} for {name}; allowed: {texts}"
            yield Phrase(template, text=repr(text), name=key.path, texts=", ".join(key.texts))


def _asked(mechanism: Mechanism, names: Sequence[str]) -> Iterator[str]:
    """Quantities that no step gives."""
    steps, inputs = {step.id: step for _, step in mechanism.steps}, keys(mechanism.inputs)
    for name in names:
        if name not in steps and name not in inputs and named(name, steps) is None:
            yield Phrase("asks for {name}, which nothing gives{near}", name=name, near=nearest(name, {*steps, *inputs}))


Calculate = Callable[..., Calculation]
ENDLESS = phrase(
    "tries machines that seek again: let the step lack the input that is tried (lacks=…), and try nothing without it"
)
DEEPEST = 2  # times that a search may be within itself, as one of a second size
SEEKING: ContextVar[tuple[tuple[str, str], ...]] = ContextVar("SEEKING", default=())
"""The kinds and steps that seek now, the outer ones first."""


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
        judge(self.mechanism, self.step, changed, len(rows), names)
        found = {name: np.full(len(rows), np.nan) for name in names}
        for trials, texts in _alike(changed, len(rows)):
            numbers = {name: _of_trials(value, trials) for name, value in changed.items() if name not in texts}
            for name, values in self._made(numbers | texts, np.asarray(rows)[trials], names).items():
                found[name][trials] = values
        return found

    def _made(self, changed: Mapping[str, Any], rows: Array, names: Sequence[str]) -> dict[str, Array]:
        """The quantities of machines of the same texts."""
        inputs = {name: of_rows(value, rows, self.count) for name, value in self.inputs.items()} | dict(changed)
        only = needed(self.mechanism, frozenset(inputs) | texts_given(inputs), names)
        if not only:  # none of these machines has what is asked
            return {}
        outer, own = SEEKING.get(), (self.mechanism.kind, self.step.id)
        if outer.count(own) >= DEEPEST:
            raise _told(self.step, ENDLESS)
        asking = SEEKING.set((*outer, own))
        try:
            made = self.calculate(self.mechanism, inputs, len(rows), only)
        except (Impossible, Unproven):
            return {}
        finally:
            SEEKING.reset(asking)
        there = [name for name in names if name in made.values or name in made.inputs]
        return {name: np.where(made.possible, made[name].reshape(len(rows), -1)[:, 0], np.nan) for name in there}


def _of_trials(value: Any, trials: Array) -> Any:
    """The numbers of these trials; one alone is that of all, of parts each has its own, or none."""
    if isinstance(value, tuple):
        return tuple(None if part is None else _of_trials(part, trials) for part in value)
    found = np.asarray(value, dtype=float)
    return found[trials] if found.ndim else np.full(len(trials), found)


def _alike(changed: Mapping[str, Any], count: int) -> Iterator[tuple[Array, dict[str, Any]]]:
    """The trials that have the same texts, with these."""
    texts = {name: value for name, value in changed.items() if is_text(value)}
    if not texts:
        yield np.arange(count), {}
        return
    columns = (np.broadcast_to(np.asarray(value, dtype=object), (count,)) for value in texts.values())
    trials: dict[tuple[Any, ...], list[int]] = {}
    for trial, said in enumerate(zip(*columns, strict=True)):
        trials.setdefault(said, []).append(trial)
    yield from ((np.array(own), dict(zip(texts, said, strict=True))) for said, own in trials.items())
