"""Checks on curves: the place of the abscissa where each goes furthest beyond its limit, or comes nearest to it."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Any

import numpy as np

from diecut_report.contract.binding import bind
from diecut_report.contract.checks import Check
from diecut_report.contract.steps import Value
from diecut_report.engine.calculation import Calculation, Side
from diecut_report.engine.numerics import extrema
from diecut_report.engine.steps import smooth_pieces
from diecut_report.expressions import Array, formula
from diecut_report.quantities.units import unit


@formula
def excess(demand: Any, limit: Any) -> Any:
    """Return how far a demand is beyond its limit."""
    return demand - limit


def searched(calc: Calculation) -> Iterator[tuple[Value, Array]]:
    """Search the checks on curves; give what stands for each, and how far it is from being proved, shape (variants, 1)."""
    for check in calc.mechanism.checks:
        if is_made(calc, check) and any(name in calc.curves for name in check.named):
            for name in check.named:
                smooth_pieces.require(calc, check.id, name)
            for number, step in enumerate(_stand_ins(check)):
                yield step, _search(calc, check, number, step)


def is_made(calc: Calculation, check: Check) -> bool:
    """Return whether a check is made: what it needs is given, and the calculation has what it compares."""
    there = all(name in calc.values or name in calc.inputs or name in calc.curves for name in check.named)
    return there and calc.given.issuperset((*check.needs, *check.only_with))


@cache
def _stand_ins(check: Check) -> tuple[Value, ...]:
    """A curve for each pair of a check's sides: the one less the other. The same for all calculations, as programs are kept for it."""
    factor = unit(check.unit).factor

    def sides(pair: tuple[str | float, ...]) -> dict[str, str | float]:
        in_si = (side if isinstance(side, str) else side * factor for side in pair)
        return dict(zip(("demand", "limit"), in_si, strict=True))

    return tuple(
        Value(id=f"checks.{check.id}.{i}", description=check.title, formula=bind(excess, **sides(pair)), output=False)
        for i, pair in enumerate(check.pairs)
    )


def _search(calc: Calculation, check: Check, number: int, step: Value) -> Array:
    """Note both sides where the first is furthest beyond the second, found by the search for all extremes; give what is left of its proof."""
    axis = next(calc.axis[name] for name in check.named if name in calc.curves)
    axes, calc.axis, calc.curves[step.id] = calc.axis, {**calc.axis, step.id: axis}, step
    found, place, middle = extrema.extreme(calc, step.id, 1.0)
    residual = extrema.outruns(calc, step.id, found, 1.0)
    demand, limit = (_there(calc, side, place, middle) for side in step.takes())
    calc.judged[check.id, number] = Side(demand, limit, axis, place)
    calc.axis = axes
    del calc.curves[step.id]
    return residual


def _there(calc: Calculation, side: str | float, place: Array, middle: Array) -> Array:
    """One side of a check at the place found in each machine, shape (variants, 1)."""
    if not isinstance(side, str):
        return np.full(place.shape, side)
    return calc.sample(side, place, middle) if side in calc.curves else np.broadcast_to(calc[side], place.shape)
