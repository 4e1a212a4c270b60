"""Runs the steps of a mechanism in their order, for one machine or for an array of variants."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator, Mapping, Sequence
from contextvars import ContextVar
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np

from diecut_report.declaration.names import Key, world
from diecut_report.errors import nearest
from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, CurveHandle, Impossible, ImpossibleTogether, Unproven
from diecut_report.machine.curve_samples import SampledCurve
from diecut_report.machine.numerics import extremes, roots_integrals
from diecut_report.machine.numerics.domain import Domain
from diecut_report.machine.steps import lookups, plain_code, rows, soundness
from diecut_report.machine.steps.rows import needed
from diecut_report.machine.steps.soundness import finite, mark, possible, prove, whole
from diecut_report.mechanism.checks import Refusal
from diecut_report.mechanism.inputs import Block, Extremes, Quantity, list_inputs, texts_given
from diecut_report.mechanism.mechanism import Machines, Mechanism
from diecut_report.mechanism.names import Misdeclared
from diecut_report.mechanism.part_steps import (
    ComputedCurve,
    Fact,
    Interpolated,
    Listing,
    Lookup,
    Neighbour,
    Part,
    PartCurves,
    PartNames,
    PartTable,
    Pick,
    Running,
    Total,
)
from diecut_report.mechanism.steps import (
    Abscissa,
    Accumulated,
    Breakpoints,
    Choice,
    Clash,
    Computed,
    Crossings,
    CurvePeriod,
    Derivative,
    FromCurve,
    MadeCurve,
    Phase,
    Prepared,
    Reduction,
    Require,
    Root,
    Step,
    Value,
    Words,
    count_name,
    named,
    place_name,
    result_names,
)
from diecut_report.quantities.formatting import told
from diecut_report.quantities.units import pretty, unit
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


def endless(step: Step) -> Misdeclared:
    """Return what is told where the machines that are tried would be sought themselves."""
    words = "tries machines that seek again: let the step lack the input that is tried (lacks=…), and try nothing without it"
    return _told(step, phrase(words))


def _told(step: Step, wrong: str) -> Misdeclared:
    return Misdeclared(Phrase("step {id}: {call} {wrong}", id=step.id, call='known["again"]', wrong=wrong), step.at)


@cache
def _keys(model: type[Block]) -> dict[str, Key]:
    return world(model).keys


@lru_cache(maxsize=64)
def _steps(mechanism: Mechanism) -> dict[str, Step]:
    return {step.id: step for _, step in mechanism.steps}


def _inputs(mechanism: Mechanism, changed: Mapping[str, Any], count: int) -> Iterator[str]:
    keys = _keys(mechanism.inputs)
    for name, value in changed.items():
        if name not in keys:
            yield Phrase("changes {name}, which is not an input{near}", name=name, near=nearest(name, keys))
        elif not isinstance(value, tuple) and np.ndim(value) and len(value) != count:
            words = "gets {n} values of {name} for {count} trials; give one for each"
            yield Phrase(words, n=len(value), name=name, count=count)
        elif is_text(value):
            yield from _text(keys[name], value)
        elif keys[name].texts:
            words = "tries numbers for {name}, which is a text: {texts}"
            yield Phrase(words, name=name, texts=", ".join(keys[name].texts))


def _text(key: Key, value: Any) -> Iterator[str]:
    """What is wrong with texts in the place of an input."""
    tried = dict.fromkeys(np.ravel(np.asarray(value, dtype=object)))
    if isinstance(key.meta, Quantity):
        shown = pretty(key.meta.unit) or "1"
        words = "tries {value} for {name}, which is a number: give it in SI, si(…, {unit})"
        yield Phrase(words, value=repr(next(iter(tried))), name=key.path, unit=repr(shown))
    elif key.home or key.is_block:
        words = "tries texts for {name}, a key of a list's parts, of which numbers alone can be tried"
        yield Phrase(words, name=key.path)
    for text in tried if key.texts and not isinstance(key.meta, Quantity) else ():
        if (str(text).lower() if isinstance(text, bool) else text) not in key.texts:
            words = "tries {text} for {name}; allowed: {texts}"
            yield Phrase(words, text=repr(text), name=key.path, texts=", ".join(key.texts))


def _asked(mechanism: Mechanism, names: Sequence[str]) -> Iterator[str]:
    """Quantities that no step gives."""
    steps, keys = _steps(mechanism), _keys(mechanism.inputs)
    for name in names:
        if name not in steps and name not in keys and named(name, steps) is None:
            yield Phrase("asks for {name}, which nothing gives{near}", name=name, near=nearest(name, {*steps, *keys}))


# The same machines calculated again with other inputs, for plain code that seeks a size: many of them at once.


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
        judge(self.mechanism, self.step, changed, len(rows), names)
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
            raise endless(self.step)
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
    texts = {name: value for name, value in changed.items() if is_text(value)}
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


EMPTY = phrase("is empty; give at least one")


def calculate(
    mechanism: Mechanism, values: Mapping[str, Any], variants: int = 1, only: Container[str] | None = None
) -> Calculation:
    """Calculate a mechanism, or only those of its steps that are named.

    ``values`` holds the inputs by id in SI: numbers, or arrays of shape (variants,); tuples for the parts of a list;
    texts, flags, ``CurveHandle``. Optional inputs that are not given are left out.
    Raises ``Impossible`` when a single machine cannot exist (among several it is marked in ``flaws``), ``Unproven`` when a
    result does not meet what proves it.
    """
    curves = {
        n: SampledCurve(v) if n in mechanism.curve_inputs and isinstance(v, tuple) else v for n, v in values.items()
    }
    calc = Calculation(mechanism, curves, variants)
    calc.is_partial = only is not None
    plain_code.distinct(calc)
    with np.errstate(all="ignore"):
        steps = [step for _, step in mechanism.active(calc.given) if only is None or step.id in only]
        for i, step in enumerate(steps):
            if step.id not in calc.steps or isinstance(step, Words | Phase | Listing):
                continue
            try:
                if isinstance(step, rows.Asking):
                    rows.look(calc, step, soundness.remaining(calc, steps[i:]) if calc.withheld else steps[i:])
                    soundness.require(calc, step.id, step.of)
                RUN[type(step)](calc, step)
            except KeyError as missing:
                raise _empty_list(calc, missing) from None
            except Impossible as first:
                raise type(first)([*first.reasons, *soundness.reasons(calc, steps[i + 1 :])]) from None
            finite(calc, step)
            whole(calc, step)
            plain_code.name_row(calc, step)
        for stand_in, residual in soundness.searched(calc) if only is None else ():
            prove(calc, stand_in, residual, roots_integrals.SAMPLE_TOLERANCE)
    return calc


def _value(calc: Calculation, step: Value) -> None:
    if step.id in calc.axis and calc.axis[step.id] in calc.domains:
        calc.curves[step.id] = step
    else:
        calc.values[step.id] = calc.existing(step, calc.apply(step.formula))


def _choice(calc: Calculation, step: Choice) -> None:
    if step.id in calc.axis and calc.axis[step.id] in calc.domains:
        calc.curves[step.id] = step
        return
    held = [calc.apply(c.condition).astype(bool) for c in step.cases if c.condition is not None]
    last = np.full((calc.count, 1), len(held))
    calc.branch[step.id] = np.select(held, [np.full_like(last, i) for i in range(len(held))], last)
    taken = [
        np.full((calc.count, 1), c.value, dtype=object) if isinstance(c.value, str) else calc.apply(c.value)
        for c in step.cases
    ]
    calc.values[step.id] = calc.existing(step, np.choose(calc.branch[step.id], taken))


def _root(calc: Calculation, step: Root) -> None:
    found, residual = roots_integrals.root(calc, step)
    lost = np.isnan(found)[:, 0] & possible(calc)
    if lost.any():
        low, high = (
            told(float(calc.apply(end)[np.flatnonzero(lost)[0], 0]), step.unit) for end in (step.low, step.high)
        )
        where = f"{step.description} ({step.id}, {Path(step.at).name})"
        words = "{where}: the equation does not change its sign between low = {low} and high = {high}; let the bracket hold the root, or require what it needs to exist"  # noqa: E501
        mark(calc, step, lost, Phrase(words, where=where, low=low, high=high))
        residual = np.where(lost[:, None], 0.0, residual)
    prove(calc, step, residual, step.tolerance)


def _abscissa(calc: Calculation, step: Abscissa) -> None:
    points = int(calc[step.points][0, 0])
    whole = calc[step.period] if isinstance(step.period, str) else np.full((calc.count, 1), step.period)
    _above_zero(calc, step, whole)
    calc.domains[step.id] = Domain(whole, np.arange(points) * (whole / points), step.intervals)


def _above_zero(calc: Calculation, step: Step, length: Array) -> None:
    """A length that curves are laid over must be there."""
    empty = ~(length > 0)[:, 0] & possible(calc)
    if empty.any():
        words = "{description} ({id}) has no length to run over with these inputs"
        mark(calc, step, empty, Phrase(words, description=step.description, id=step.id))


def _breakpoints(calc: Calculation, step: Breakpoints) -> None:
    domain = calc.domains[step.abscissa]
    for place in step.places:
        domain.cut(calc[place])
    if step.every:
        domain.cut_every(np.where(possible(calc)[:, None], calc[step.every], np.nan))


def _crossings(calc: Calculation, step: Crossings) -> None:
    places, residual = roots_integrals.all_crossings(calc, step.of)
    calc.values[step.id] = places
    calc.values[count_name(step.id)] = np.isfinite(places).sum(axis=1, keepdims=True)
    names = [each for each in result_names(step, places.shape[1]) if each.role == "crossing"]
    calc.values |= {each.name: places[:, [each.index]] for each in names}
    prove(calc, step, residual, roots_integrals.SAMPLE_TOLERANCE)


def _reduction(calc: Calculation, step: Reduction) -> None:
    if step.operation in ("mean", "rms", "integral"):
        _integrated(calc, step)
        return
    signs = rows.SIGNS[step.operation]
    ends = [extremes.extreme(calc, step.of, sign) for sign in signs]
    residual = np.maximum.reduce(
        [extremes.outruns(calc, step.of, end[0], sign) for end, sign in zip(ends, signs, strict=True)]
    )
    prove(calc, step, residual, roots_integrals.SAMPLE_TOLERANCE)
    if step.operation == "range":
        calc.values[step.id] = ends[0][0] - ends[1][0]
        return
    upper = np.abs(ends[0][0]) >= np.abs(ends[-1][0]) * (1 - extremes.SAME_HEIGHT)  # of two alike the upper one
    value, place, middle = (np.where(upper, top, bottom) for top, bottom in zip(ends[0], ends[-1], strict=True))
    calc.values[step.id] = np.maximum(*(np.abs(end[0]) for end in ends)) if step.operation == "abs_max" else value
    calc.values[place_name(step.id)], calc.middle[place_name(step.id)] = place, middle


def _integrated(calc: Calculation, step: Reduction) -> None:
    whole, residual = roots_integrals.integral(calc, step.of, 2 if step.operation == "rms" else 1)
    prove(calc, step, residual, roots_integrals.SAMPLE_TOLERANCE)
    mean = whole / calc.domains[calc.axis[step.of]].period
    calc.values[step.id] = {"integral": whole, "mean": mean, "rms": np.sqrt(np.abs(mean))}[step.operation]


def _accumulated(calc: Calculation, step: Accumulated) -> None:
    prove(calc, step, roots_integrals.accumulate(calc, step), roots_integrals.SAMPLE_TOLERANCE)


def _derivative(calc: Calculation, step: Derivative) -> None:
    prove(calc, step, roots_integrals.differentiate(calc, step), roots_integrals.SAMPLE_TOLERANCE)


def _from_curve(calc: Calculation, step: FromCurve) -> None:
    calc.curves[step.id] = step
    domain, curve = calc.domains[step.abscissa], calc.inputs[step.given or step.id]
    if step.lasts:
        _above_zero(calc, step, calc[step.lasts])
    domain.cut(_laid_out(calc, step, curve.joints))
    domain.cut_finer(_laid_out(calc, step, curve.breakpoints))


def _prepared(calc: Calculation, step: Prepared) -> None:
    there = [name for name in step.holds if name in calc.values or name in calc.inputs]
    known: dict[str, Any] = dict(zip(there, plain_code.taken(calc, there), strict=True))
    if step.again:
        known["again"] = Again(calc, calculate, step)
    alone = calc.count == 1 or step.for_many
    calc.inputs[step.id] = _called(calc, step, [known]) if alone else rows.prepared(calc, step, known)


def _made_curve(calc: Calculation, step: MadeCurve) -> None:
    if calc.count > 1:
        raise TypeError(f"{step.id} is made for one machine, and was asked for {calc.count}")
    calc.inputs[step.id] = _called(calc, step, plain_code.taken(calc, step.takes))
    _from_curve(calc, step)


def _empty_list(calc: Calculation, missing: KeyError) -> Exception:
    """What to raise where a step asks for the rows of a list that has no parts; the fault itself where it is another one."""
    asked = str(missing.args[0]).removeprefix("inputs.") if missing.args else ""
    home = list_inputs(calc.mechanism.inputs).get(asked)
    return missing if home is None or home in calc.given else Impossible([(home, EMPTY)])


def _called(calc: Calculation, step: Computed | MadeCurve | Prepared, taken: list[Any]) -> Any:
    try:
        return step.function(*taken)
    except Refusal as refused:
        kind = Impossible if calc.count == 1 else ImpossibleTogether
        raise kind([(refused.key, refused.words)]) from None


def _laid_out(calc: Calculation, step: FromCurve, shares: Array) -> Array:
    """Shares of a curve's period as places on the abscissa that it is laid over, NaN where they are not on it."""
    period = calc.domains[step.abscissa].period
    lasts = calc[step.lasts] if step.lasts else period
    if step.start or step.lasts:
        shares = np.concatenate([shares, np.zeros((len(shares), 1))], axis=1)  # where a period of the curve begins anew
    shares = np.mod(shares - (calc[step.start] if step.start else 0), 1)
    turns = np.where(possible(calc)[:, None], np.ceil(period / lasts), 1)
    places = [(shares + turn) * lasts for turn in range(int(turns.max()))]
    return np.concatenate([np.where(place < period, place, np.nan) for place in places], axis=1)


def _curve_period(calc: Calculation, step: CurvePeriod) -> None:
    curve = calc.inputs[step.given]
    if isinstance(curve, SampledCurve):
        words = "is a list of values, which tells no period; {otherwise}"
        raise Impossible([(step.given, Phrase(words, otherwise=step.otherwise))])
    declared = curve.abscissa
    if unit(declared.unit).kind != unit(step.unit).kind:
        words = "runs over {id}, in {unit}; {otherwise}"
        named = {"id": declared.id, "unit": pretty(declared.unit), "otherwise": step.otherwise}
        raise Impossible([(step.given, Phrase(words, named))])
    calc.values[step.id] = np.broadcast_to(curve.domain.period, (calc.count, 1))


def _computed(calc: Calculation, step: Computed) -> None:
    taken = plain_code.taken(calc, step.takes)
    of_each = any(isinstance(each, Machines) for each in taken)
    found = rows.computed(calc, step, taken) if of_each else _called(calc, step, taken)
    if calc.count > 1 and np.shape(found)[:1] != (calc.count,) and any(isinstance(each, np.ndarray) for each in taken):
        raise TypeError(f"{step.id} was given {calc.count} machines and has one value for all")
    if step.is_text:
        calc.values[step.id] = plain_code.texts(step, found, calc.count)
        return
    give = plain_code.row if step.over else plain_code.number
    calc.values[step.id] = calc.existing(step, give(step, found, calc.count))


RUN: dict[type[Step], Callable[[Calculation, Any], None]] = {
    Value: _value, Choice: _choice, Root: _root, Abscissa: _abscissa, Breakpoints: _breakpoints, Crossings: _crossings,
    Reduction: _reduction, Accumulated: _accumulated, Derivative: _derivative, FromCurve: _from_curve,
    CurvePeriod: _curve_period, Computed: _computed, MadeCurve: _made_curve,
    Prepared: _prepared, ComputedCurve: plain_code.curve, PartCurves: plain_code.part_curves,
    PartNames: plain_code.part_names, PartTable: lambda _, __: None,
    Fact: soundness.judge,
    Require: soundness.feasibility_require, Clash: soundness.clash,
    Total: rows.total, Neighbour: rows.neighbour, Running: rows.running, Part: rows.part, Lookup: lookups.lookup,
    Pick: rows.pick, Interpolated: lookups.interpolated,
}  # fmt: skip


# The same machine calculated again with other inputs: only the steps that the asked quantities need.


def varied(calc: Calculation, inputs: Mapping[str, Any], names: Sequence[str]) -> dict[str, Array]:
    """Return numbers for other inputs, each of shape (variants,); NaN where the machine is then impossible."""
    count = max((np.size(value) for value in inputs.values() if not isinstance(value, str)), default=1)
    again = _calculated(calc, inputs, count, names)
    if again is None:
        return {name: np.full(count, np.nan) for name in names}
    possible = np.ones(count, dtype=bool)
    possible[list(again.flaws)] = False
    return {name: np.where(possible, again[name][:, 0], np.nan) for name in names}


def varied_curves(
    calc: Calculation, inputs: Mapping[str, Any], names: Sequence[str], points: int
) -> tuple[Array, dict[str, Array]]:
    """Return curves over one abscissa for other inputs, at so many places of the whole of it, ends included.

    NaN where the machine is then impossible.
    """
    again = _calculated(calc, inputs, 1, names)
    axis = calc.axis[names[0]]
    period = float((again or calc).domains[axis].period[0, 0])
    x = np.linspace(0, period, points)
    if again is None:
        return x, dict.fromkeys(names, np.full(points, np.nan))
    places = np.minimum(x, np.nextafter(period, 0))[None, :]
    curves = again.sampler(names[0], places, again.domains[axis].middle_of(places))
    return x, {name: np.broadcast_to(curves[name], places.shape)[0] for name in names}


def recalculated(
    calc: Calculation, changed: Mapping[str, Any], count: int, names: Sequence[str] | None = None
) -> Calculation | None:
    """Return so many machines that differ from the first of a calculation in the inputs ``changed``; None where all are impossible.

    Only the steps that ``names`` need are run; all of them where it is None.
    """
    first = np.zeros(count, dtype=int)
    inputs = {name: _of(value, first, calc.count) for name, value in calc.inputs.items() if name in calc.given}
    inputs |= changed
    only = None if names is None else needed(calc.mechanism, frozenset(inputs) | texts_given(inputs), names)
    try:
        return calculate(calc.mechanism, inputs, count, only)
    except (Impossible, Unproven):
        return None


def _calculated(calc: Calculation, changed: Mapping[str, Any], count: int, names: Sequence[str]) -> Calculation | None:
    inputs = {name: _repeated(value, count) for name, value in calc.inputs.items()}
    for name, value in changed.items():
        inputs[name] = value if isinstance(value, str) else np.broadcast_to(np.asarray(value, dtype=float), (count,))
    only = needed(calc.mechanism, frozenset(inputs) | texts_given(inputs), names)
    try:
        return calculate(calc.mechanism, inputs, count, only)
    except (Impossible, Unproven):
        return None


def _repeated(value: Any, count: int) -> Any:
    return np.repeat(value[:1], count, axis=0) if isinstance(value, np.ndarray) else value


__all__ = ["needed", "recalculated", "varied", "varied_curves"]
