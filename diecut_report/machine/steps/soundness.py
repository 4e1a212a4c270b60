"""What makes the numbers of curves untrue: jumps and poles inside smooth pieces; checks on curves; facts that are not met."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path
from typing import cast

import numpy as np

from diecut_report.formulas import Array
from diecut_report.formulas.expression import Expression, WrittenNumber, m
from diecut_report.formulas.tree import Node, substitute, written
from diecut_report.machine.calculation import Calculation, Found, Side, Unproven
from diecut_report.machine.numerics import extremes, jumps
from diecut_report.machine.numerics.conditions import BranchCondition, Singularity
from diecut_report.machine.numerics.domain import shares
from diecut_report.machine.numerics.jumps import JumpFault
from diecut_report.mechanism.chapters import taken
from diecut_report.mechanism.checks import Check
from diecut_report.mechanism.steps import Choice, Fact, Require, Step, Value, read
from diecut_report.quantities.formatting import told
from diecut_report.quantities.units import unit
from diecut_report.text.phrases import Phrase, phrase

# Refuses what would be reported of a curve that jumps inside a smooth piece: its extremes and integrals could be any numbers.


NO_VALUE = phrase("{description} ({id}) is a curve that has no value at some of its places")


def require(calc: Calculation, asking: str, curve: str) -> None:
    """Refuse a single machine whose curve jumps elsewhere than at its breakpoints; mark such variants. ``asking`` asks for the curve."""
    if curve not in calc.curves:
        return
    for variant, found in jumps.faults(calc, curve):
        words = _words(calc, found)
        if calc.count == 1:
            raise Unproven(words, calc.curves[curve].at)
        calc.flaws[variant] = asking, words
    if calc.count > 1 and (step := calc.curves[curve]).output:  # of a single one that is told where it is written
        for variant in jumps.without_value(calc, curve):
            calc.flaws[variant] = asking, Phrase(NO_VALUE, description=step.description, id=curve)


def _words(calc: Calculation, found: JumpFault) -> str:
    curve, axis = calc.steps.get(found.curve), calc.steps[calc.axis[found.curve]]
    assert curve is not None
    place = f"{axis.symbol} = {told(found.place, axis.unit)}"
    where = f"{curve.description} ({curve.id}, {Path(curve.at).name})"
    fix = Phrase("declare that place among the breakpoints of {id}, above what asks for the curve", id=axis.id)
    if found.condition is None:
        return (Phrase("{where} takes a flag of its smooth pieces (per_piece) that is not constant within one, as at "
"{place}: it would be that of the middle of the piece; {fix}, or take per_piece away", where=where, place=place, fix=fix))  # fmt: skip
    step, formula = found.condition.step, found.condition.formula
    is_formula = hasattr(step, "formula")
    name = Phrase("the formula {name}", name=formula.__name__) if is_formula else phrase("the choice")
    decided = written(_in_symbols(calc, found.condition))
    of: str = Phrase("{name} of {id} ({place})", name=name, id=step.id, place=Path(step.at).name)
    of = phrase("its formula") if step.id == curve.id else of
    if found.is_pole:
        template = "{where} has a pole at {place}, where {decided} is zero in {of}; require what keeps away from it"
        return Phrase(template, where=where, place=place, decided=decided, of=of)
    if isinstance(found.condition, Singularity):
        fix = Phrase("{fix}, or require what keeps away from it", fix=fix)
        template = "{where} jumps inside a smooth piece, at {place}, where {decided} is zero in {of}; {fix}"
        return Phrase(template, where=where, place=place, decided=decided, of=of, fix=fix)
    template = "{where} jumps inside a smooth piece, at {place}, where {decided} changes in {of}; {fix}"
    return Phrase(template, where=where, place=place, decided=decided, of=of, fix=fix)


def _in_symbols(calc: Calculation, condition: BranchCondition) -> Node:
    """What decides, with the symbols of the quantities."""
    return substitute(
        condition.node, {name: Node("sym", (calc.step_or_input(name).symbol,)) for name in condition.names}
    )


# Where a curve is not smooth inside a smooth piece though no condition tells it: an angle that wraps, a pole, a corner.


FINE = 64  # intervals of a piece in which a curve is looked at first
ROUNDS, WITHIN = 8, 16  # how often the place is looked at closer, each time in so many intervals
INSET, WIDE = (
    1e-9,
    1e-6,
)  # shares: of a piece, that its ends are left out by; of the period, of pieces that are looked at
STAYS, APART = 0.5, 0.05  # of a difference: a jump keeps it however near, and what is beside it changes by far less
GROWS, STILL = 1e3, 4.0  # times the greatest size seen first, and two looks before: a pole
TENTHS = 10.0 ** -np.arange(3, 8)  # shares of a piece
GOES_ON, SLOW = (
    0.9,
    4.0,
)  # times: with each tenth of the distance a logarithm moves by as much, a slow pole by a little more
LEAST = 1e-9  # of the sizes in the formula: a difference that is not rounding


def require_whole(calc: Calculation, curve: str) -> None:
    """Raise Unproven where a curve of a single machine jumps or has a pole inside a smooth piece: its numbers there mean nothing."""
    with np.errstate(all="ignore"):
        x, middles = _pieces(calc, curve)
        values = _values(calc, curve, x, middles)
        place = _pole(calc, curve, x, middles, values)
        place = _torn(calc, curve, x, middles, values) if place is None else place
        place = _endless(calc, curve, x, middles, values) if place is None else place
    if place is None:
        return
    require(calc, curve, curve)  # tells the condition that jumps there, if one does
    told = _told(calc, curve, place)
    message = Phrase("{where} jumps or has a pole inside a smooth piece, near {place}; {instead}", told)
    raise Unproven(message, calc.curves[curve].at)


def sharpest(calc: Calculation, step: Step) -> str:
    """Return in words where the curve that a step asks for bends most; empty where it asks for none."""
    curve = step.asked_curve
    if calc.count > 1 or curve not in calc.curves:
        return ""
    found = _told(calc, curve, _sharpest(calc, curve))
    return Phrase("; {where} bends most near {place}: if it has a corner, a jump or a pole there, {instead}", found)


def _told(calc: Calculation, curve: str, place: float) -> dict[str, str]:
    step, axis = calc.curves[curve], calc.steps[calc.axis[curve]]
    where = Phrase("{description} ({id}, {place})", description=step.description, id=curve, place=Path(step.at).name)
    instead = Phrase("declare that place among the breakpoints of {id}, above what asks for the curve, or require what keeps away from it",
                     id=axis.id)  # fmt: skip
    return {"where": where, "place": f"{axis.symbol} = {told(place, axis.unit)}", "instead": instead}


def _pieces(calc: Calculation, curve: str) -> tuple[Array, Array]:
    """Places in the pieces of an abscissa, (pieces, places), and the middle of each."""
    domain = calc.domains[calc.axis[curve]]
    wide = domain.widths[0] > WIDE * domain.period[0, 0]
    starts, widths = domain.edges[0, :-1][wide], domain.widths[0][wide]
    inner = INSET + (1 - 2 * INSET) * shares(FINE)
    return starts[:, None] + widths[:, None] * inner, domain.middles[0][wide]


def _values(calc: Calculation, curve: str, x: Array, middles: Array) -> Array:
    middle = np.broadcast_to(middles[:, None], x.shape)
    return np.broadcast_to(calc.sample(curve, x.reshape(1, -1), middle.reshape(1, -1)), (1, x.size)).reshape(x.shape)


def _torn(calc: Calculation, curve: str, x: Array, middles: Array, values: Array) -> float | None:
    """The place where a formula stays apart however near it is looked at, as an angle that wraps; None where there is none."""
    steps = np.abs(np.diff(values))
    first = steps.max(initial=0.0)
    if not calc.curves[curve].is_formula or not _stands_out(steps, 1):
        return None
    if not first > LEAST * _scale(calc, curve, x, middles):
        return None
    for _ in range(ROUNDS):
        row, k = np.unravel_index(np.nanargmax(np.abs(np.diff(values))), (len(x), x.shape[1] - 1))
        x, middles = np.linspace(x[row, k], x[row, k + 1], WITHIN + 1)[None], middles[[row]]
        values = _values(calc, curve, x, middles)
    others = np.sort(np.abs(np.diff(values[0])))
    return float(x[0, WITHIN // 2]) if others[-1] > STAYS * first and others[-2] < APART * others[-1] else None


def _stands_out(sizes: Array, beside: int) -> bool:
    row, k = np.unravel_index(np.argmax(sizes), sizes.shape)
    near = sizes[row, max(int(k) - beside, 0) : int(k) + beside + 1]
    return bool(sizes[row, k] > 2 * near.min(initial=np.inf))


def _pole(calc: Calculation, curve: str, x: Array, middles: Array, values: Array) -> float | None:
    """The place where a curve still grows however near it is looked at; None where there is none."""
    sizes: list[float] = []
    if np.isfinite(values).all() and not _stands_out(np.abs(values), 2):
        return None
    for _ in range(ROUNDS):
        values = _values(calc, curve, x, middles) if sizes else values
        size = np.nan_to_num(np.abs(values), posinf=np.inf)
        if np.isinf(size).any():
            return float(x[np.isinf(size)][0])
        row, k = np.unravel_index(np.argmax(size), size.shape)
        before, after = max(int(k) - 1, 0), min(int(k) + 1, x.shape[1] - 1)
        sizes.append(float(size[row, k]))
        if sizes[-1] * LEAST > np.delete(size[row, before : after + 1], k - before).max() > 0:  # the pole itself
            return float(x[row, k])
        x, middles = np.linspace(x[row, before], x[row, after], WITHIN + 1)[None], middles[[row]]
    is_pole = sizes[-1] > GROWS * sizes[0] and sizes[-1] > STILL * sizes[-3]
    return float(x[0, WITHIN // 2]) if is_pole else None


def _endless(calc: Calculation, curve: str, x: Array, middles: Array, values: Array) -> float | None:
    """The place towards which a formula goes on for ever, if slowly, as a logarithm does; None where there is none."""
    if not calc.curves[curve].is_formula or not _stands_out(np.abs(np.diff(values, 2)), 2):
        return None
    place = _sharpest(calc, curve)
    row = int(np.argmax((x[:, 0] <= place) & (place <= x[:, -1])))
    for reach in (x[row, -1] - x[row, 0]) * TENTHS * [[-1], [1]]:
        moved = np.diff(_values(calc, curve, place + reach[None], middles[[row]])[0])
        is_within = x[row, 0] <= place + reach[0] <= x[row, -1]
        factors = moved[1:] / moved[:-1]
        if is_within and factors.min() > GOES_ON and factors.max() < SLOW:  # towards a narrow bend by 10 or 100
            return place if abs(moved[0]) > LEAST * _scale(calc, curve, x, middles) else None
    return None


def _scale(calc: Calculation, curve: str, x: Array, middles: Array) -> float:
    """The greatest size of a formula's curve and of what it takes in its unit: a difference of those has the rounding of theirs."""
    step = calc.curves[curve]
    assert isinstance(step, Value | Choice)
    own = unit(step.unit).kind
    scale = 1.0 if own in (unit("1").kind, unit("rad").kind) else 0.0
    for name in {curve, *step.takes()}:
        if name == curve or unit(calc.step_or_input(name).unit).kind == own:
            values = x
            if name not in calc.domains:
                values = _values(calc, name, x, middles) if name in calc.curves else calc[name]
            scale = max(scale, float(np.abs(values).max(initial=0.0)))
    return scale


def _sharpest(calc: Calculation, curve: str) -> float:
    x, middles = _pieces(calc, curve)
    x = np.linspace(x[:, 0], x[:, -1], FINE + 1, axis=1)
    for _ in range(ROUNDS):
        bends = np.nan_to_num(np.abs(np.diff(_values(calc, curve, x, middles), 2)), posinf=np.inf)
        row, k = np.unravel_index(np.argmax(bends), bends.shape)
        x, middles = np.linspace(x[row, k], x[row, k + 2], WITHIN + 1)[None], middles[[row]]
    return float(x[0, WITHIN // 2])


# Checks on curves: the place of the abscissa where each goes furthest beyond its limit, or comes nearest to it.


def searched(calc: Calculation) -> Iterator[tuple[Value, Array]]:
    """Search the checks on curves; give what stands for each, and how far it is from being proved, shape (variants, 1)."""
    for check in calc.mechanism.checks:
        if is_made(calc, check) and any(name in calc.curves for name in check.named):
            for name in check.named:
                require(calc, check.id, name)
            for number, step in enumerate(_stand_ins(check)):
                yield step, _search(calc, check, number, step)


def is_made(calc: Calculation, check: Check) -> bool:
    """Return whether a check is made: what it needs is given, and the calculation has what it compares."""
    there = all(name in calc.values or name in calc.inputs or name in calc.curves for name in check.named)
    return there and calc.given.issuperset((*check.needs, *check.only_with))


@cache
def _stand_ins(check: Check) -> tuple[Value, ...]:
    """A curve for each pair of a check's sides: the one less the other. The same for all calculations, as programs are kept for it."""

    def gap(number: int) -> Expression:
        demand, limit = (m[side] if isinstance(side, str) else WrittenNumber(side) for side in _sides(check, number))
        return cast(Expression, demand - limit)  # one side at least is a quantity

    return tuple(
        Value(f"checks.{check.id}.{i}", "", "1", check.title, gap(i), output=False) for i in range(len(check.pairs))
    )


def _sides(check: Check, number: int) -> tuple[str | float, ...]:
    """The sides of one of a check's pairs: ids, or numbers in SI."""
    factor = unit(check.unit).factor
    return tuple(side if isinstance(side, str) else side * factor for side in check.pairs[number])


def _search(calc: Calculation, check: Check, number: int, step: Value) -> Array:
    """Note both sides where the first is furthest beyond the second, found by the search for all extremes; give what is left of its proof."""
    axis = next(calc.axis[name] for name in check.named if name in calc.curves)
    (_, place, middle), residual = _greatest(calc, step, axis)
    demand, limit = (_there(calc, side, place, middle) for side in _sides(check, number))
    calc.judged[check.id, number] = Side(demand, limit, axis, place)
    return residual


def _greatest(calc: Calculation, step: Value, axis: str) -> tuple[Found, Array]:
    """The greatest value of a curve that stands in for a comparison, and how far it is from being proved."""
    axes, calc.axis, calc.curves[step.id] = calc.axis, {**calc.axis, step.id: axis}, step
    found = extremes.extreme(calc, step.id, 1.0)
    residual = extremes.outruns(calc, step.id, found[0], 1.0)
    calc.axis = axes
    del calc.curves[step.id]
    return found, residual


def _there(calc: Calculation, side: str | float, place: Array, middle: Array) -> Array:
    if not isinstance(side, str):
        return np.full(place.shape, side)
    return calc.sample(side, place, middle) if side in calc.curves else np.broadcast_to(calc[side], place.shape)


# Conditions on curves: the place where each comparison fails most, or comes nearest to failing.


def fails(calc: Calculation, step: Require, axis: str) -> dict[int, float]:
    """Return the variants of which a comparison of a condition does not hold all over an abscissa, with the place where it fails most."""
    for name in taken(step):
        require(calc, step.id, name)
    found: dict[int, float] = {}
    for (sign, *_), gap in zip(step.comparisons, _gaps(step), strict=True):
        (greatest, place, _), _ = _greatest(calc, gap, axis)
        holds = greatest < 0 if sign in ("<", ">") else greatest <= 0
        found = {int(variant): float(place[variant, 0]) for variant in np.flatnonzero(~holds)} | found
    return found


@cache
def _gaps(step: Require) -> tuple[Value, ...]:
    """A curve for each comparison of a condition, which is below zero where it holds."""
    sides = [(a, b) if sign.startswith("<") else (b, a) for sign, a, b in step.comparisons]
    return tuple(
        Value(f"{step.id}.{i}", "", "1", step.id, Expression(Node("-", both)), output=False)
        for i, both in enumerate(sides)
    )


# Facts that a machine does not meet: the steps that need them are left out.


def without(calc: Calculation, name: str) -> tuple[Array, str]:
    """Return which variants do not have a result for want of a fact, and why in words."""
    for chapter, step in calc.mechanism.steps if calc.withheld else ():
        facts = {*chapter.needs, *step.needs} & calc.withheld.keys()
        if facts and read(name, step):
            return np.any([calc.withheld[each] for each in facts], axis=0), unmet(calc, facts)
    return np.zeros(calc.count, dtype=bool), ""


def unmet(calc: Calculation, needs: Iterable[str]) -> str:
    """Return what is said of a fact among these needs that the machine does not meet; empty where it meets all."""
    facts = [step for _, step in calc.mechanism.steps if isinstance(step, Fact)]
    return next((step.words for step in facts if step.id in needs and step.id in calc.withheld), "")
