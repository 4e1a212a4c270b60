"""Runs the steps of a mechanism in their order, for one machine or for an array of variants."""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from diecut_report.contract.code_steps import ComputedCurve, Fact, PartCurves, PartNames, PartTable
from diecut_report.contract.input_lists import list_inputs
from diecut_report.contract.listings import Listing
from diecut_report.contract.machines import Machines
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.part_steps import Interpolated, Lookup, Neighbour, Part, Pick, Running, Total
from diecut_report.contract.refusal import Refusal
from diecut_report.contract.result_names import count_name, place_name, result_names
from diecut_report.contract.steps import (
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
)
from diecut_report.engine.calculation import Calculation, Impossible, ImpossibleTogether, SampledCurve
from diecut_report.engine.numerics import extrema, roots_integrals
from diecut_report.engine.numerics.domain import Domain
from diecut_report.engine.steps import (
    extreme_checks,
    facts,
    feasibility,
    interpolation,
    lookups,
    named_parts,
    one_by_one,
    part_rows,
    plain_code,
    prefetch,
    smooth_pieces,
)
from diecut_report.engine.steps.again import Again
from diecut_report.engine.steps.soundness import finite, mark, possible, prove, whole
from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.quantities.formatting import told
from diecut_report.quantities.units import pretty, unit

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
    named_parts.distinct(calc)
    with np.errstate(all="ignore"):
        steps = [step for _, step in mechanism.active(calc.given) if only is None or step.id in only]
        for i, step in enumerate(steps):
            if step.id not in calc.steps or isinstance(step, Words | Phase | Listing):
                continue
            try:
                if isinstance(step, prefetch.Asking):
                    prefetch.look(calc, step, facts.remaining(calc, steps[i:]) if calc.withheld else steps[i:])
                    smooth_pieces.require(calc, step.id, step.of)
                RUN[type(step)](calc, step)
            except KeyError as missing:
                raise _empty_list(calc, missing) from None
            except Impossible as first:
                raise type(first)([*first.reasons, *feasibility.reasons(calc, steps[i + 1 :])]) from None
            finite(calc, step)
            whole(calc, step)
            named_parts.name_row(calc, step)
        for stand_in, residual in extreme_checks.searched(calc) if only is None else ():
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
    signs = prefetch.SIGNS[step.operation]
    ends = [extrema.extreme(calc, step.of, sign) for sign in signs]
    residual = np.maximum.reduce(
        [extrema.outruns(calc, step.of, end[0], sign) for end, sign in zip(ends, signs, strict=True)]
    )
    prove(calc, step, residual, roots_integrals.SAMPLE_TOLERANCE)
    if step.operation == "range":
        calc.values[step.id] = ends[0][0] - ends[1][0]
        return
    upper = np.abs(ends[0][0]) >= np.abs(ends[-1][0]) * (1 - extrema.SAME_HEIGHT)  # of two alike the upper one
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
    calc.inputs[step.id] = _called(calc, step, [known]) if alone else one_by_one.prepared(calc, step, known)


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
    found = one_by_one.computed(calc, step, taken) if of_each else _called(calc, step, taken)
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
    Fact: facts.judge,
    Require: feasibility.require, Clash: feasibility.clash,
    Total: part_rows.total, Neighbour: part_rows.neighbour, Running: part_rows.running, Part: part_rows.part, Lookup: lookups.lookup,
    Pick: part_rows.pick, Interpolated: interpolation.interpolated,
}  # fmt: skip
