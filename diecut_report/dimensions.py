"""Dimensions of what a mechanism declares: its formulas are fed with quantities that carry units (pint)."""

from __future__ import annotations

import types
from collections.abc import Iterator
from typing import Any

import numpy as np
import pint

from diecut_report.contract.binding import Binding, Bound, ByText, bound
from diecut_report.contract.checks import Check
from diecut_report.contract.inputs import fields
from diecut_report.contract.mechanism import Mechanism, axes
from diecut_report.contract.steps import (
    SILENT,
    Abscissa,
    Accumulated,
    Breakpoints,
    Case,
    Choice,
    Derivative,
    FromCurve,
    Reduction,
    Root,
    Step,
    Value,
)
from diecut_report.expressions import Constant, Formula
from diecut_report.units import unit

REGISTRY: pint.UnitRegistry[float] = pint.UnitRegistry()


def formulas(mechanism: Mechanism) -> Iterator[tuple[Step, str, Bound]]:
    """Every bound formula with its step and its part in it."""
    for _, step in mechanism.steps:
        for part in ("formula", "condition", "exists", "equation", "low", "high", "left", "right"):
            declared = getattr(step, part, None)
            yield from _bindings(step, part, declared)
        for case in getattr(step, "cases", ()):
            yield from _of_case(step, case)


def _of_case(step: Step, case: Case) -> Iterator[tuple[Step, str, Bound]]:
    yield from _bindings(step, "formula", case.value)
    yield from _bindings(step, "condition", case.condition)


def _bindings(step: Step, part: str, declared: Any) -> Iterator[tuple[Step, str, Bound]]:
    """The formulas of a part of a step; of a choice by text all of them."""
    if isinstance(declared, ByText):
        yield from ((step, part, option) for option in declared.options())
    elif isinstance(declared, Binding):
        yield step, part, bound(declared)


def units_of(mechanism: Mechanism) -> dict[str, str]:
    """The SI unit of each id of numbers, inputs and steps."""
    found = {name: unit(meta.unit).si for name, meta in fields(mechanism.inputs) if hasattr(meta, "unit")}
    found |= {f"inputs.{name}": si for name, si in found.items()}
    for _, step in mechanism.steps:
        if not isinstance(step, SILENT):
            found[step.id] = unit(step.unit).si
            if step.numbered:
                found |= {step.numbered.format(i): found[step.id] for i in range(step.first, step.first + 3)}
    axis_of = axes(tuple(step for _, step in mechanism.steps), mechanism.inputs)
    extremes = [s for _, s in mechanism.steps if isinstance(s, Reduction) and s.operation in ("max", "min", "abs_max")]
    return found | {f"{step.id}_at": found[axis_of[step.of]] for step in extremes}


def dimensions(mechanism: Mechanism) -> Iterator[str]:
    """Formulas whose dimensions do not balance, or do not give what their step declares."""
    units = units_of(mechanism)
    for step, part, link in formulas(mechanism):
        try:
            with np.errstate(all="ignore"):
                result = _dimensioned(link.formula)(*_quantities(link, units))
        except (pint.DimensionalityError, pint.OffsetUnitCalculusError, ValueError) as error:
            yield f"{step.id}: {link.formula.__name__}: {error}"
            continue
        wanted = _wanted(step, part, units)
        if wanted is None or (not isinstance(result, pint.Quantity) and result == 0):
            continue
        if not _like(result, REGISTRY.Quantity(1, wanted)):
            yield f"{step.id}: {link.formula.__name__} gives {REGISTRY.Quantity(result).units}, declared is {wanted}"


def curve_units(mechanism: Mechanism) -> Iterator[str]:
    """Curves and what is laid over an abscissa, in other units than what they are made of has."""
    units = units_of(mechanism)
    axis_of = axes(tuple(step for _, step in mechanism.steps), mechanism.inputs)
    for _, step in mechanism.steps:
        for name, made, wanted in _made_of(step, units, axis_of):
            if not _like(made, wanted):
                yield f"{step.id}: {name} gives {made.units}, declared is {wanted.units}"


def _made_of(step: Step, units: dict[str, str], axis_of: dict[str, str]) -> Iterator[tuple[str, Any, Any]]:
    """What a step takes of a curve or an abscissa: in words, the quantity, and one as it is wanted."""

    def of(name: str) -> Any:
        return REGISTRY.Quantity(1.0, units[name])

    own = of(step.id) if step.id in units else None
    match step:
        case Derivative(of=curve):
            yield f"the derivative of {curve}", of(curve) / of(axis_of[curve]), own
        case Accumulated(of=curve) | Reduction(of=curve, operation="integral"):
            yield f"the integral of {curve}", of(curve) * of(axis_of[curve]), own
        case Reduction(of=curve):
            yield curve, of(curve), own
        case Abscissa(period=str() as period):
            yield period, of(period), own
        case FromCurve():
            yield step.given, of(step.given), own
            yield from ((name, of(name), of(step.abscissa)) for name in (step.lasts,) if name)
            yield from ((name, of(name), REGISTRY.Quantity(1.0)) for name in (step.start,) if name)
        case Breakpoints():
            yield from ((name, of(name), of(step.abscissa)) for name in (*step.places, step.every) if name)


def relations(mechanism: Mechanism) -> Iterator[str]:
    """Roots that are proved by a relation between quantities of unlike dimensions."""
    units = units_of(mechanism)
    sides: dict[str, list[Any]] = {}
    for step, part, link in formulas(mechanism):
        if part in ("left", "right"):
            with np.errstate(all="ignore"):
                result = _dimensioned(link.formula)(*_quantities(link, units))
            sides.setdefault(step.id, []).append(result)
    yield from (f"{name}: the relation equals {a} with {b}" for name, (a, b) in sides.items() if not _like(a, b))


def _like(one: Any, other: Any) -> bool:
    return bool(REGISTRY.Quantity(one).dimensionality == REGISTRY.Quantity(other).dimensionality)


def _wanted(step: Step, part: str, units: dict[str, str]) -> str | None:
    """The unit that a part of a step must give; None for conditions, and for the sides of an equation (compared below)."""
    if part == "formula" and isinstance(step, Value | Choice | Abscissa):
        return unit(step.unit).si
    if part in ("low", "high") and isinstance(step, Root):
        return unit(step.unit).si
    return None


def _quantities(link: Bound, units: dict[str, str]) -> list[Any]:
    """What a formula takes, as quantities of unlike sizes: equal ones would make a difference in a denominator zero."""
    return [REGISTRY.Quantity(np.float64(0.6 + 0.01 * i), units[name]) if isinstance(name, str) else name
            for i, name in enumerate(link.names.values())]  # fmt: skip


def _dimensioned(formula: Formula) -> Any:
    """The formula's function with its constants, and those of the formulas it calls, as quantities with units."""

    def carried(value: Any) -> Any:
        if isinstance(value, Constant):
            return REGISTRY.Quantity(float(value), value.unit)
        return _dimensioned(value) if isinstance(value, Formula) else value

    function = formula.function
    space = function.__globals__
    named = {n: carried(space[n]) for n in function.__code__.co_names if n in space and space[n] is not formula}
    return types.FunctionType(function.__code__, {**function.__globals__, **named})


def check_units(mechanism: Mechanism) -> Iterator[str]:
    """Checks that compare quantities of unlike kinds."""
    units = units_of(mechanism)
    for check in mechanism.checks:
        yield from _unlike(check, units)


def _unlike(check: Check, units: dict[str, str]) -> Iterator[str]:
    for side in (check.demand, check.limit):
        if isinstance(side, str) and side in units and unit(units[side]).kind != unit(check.unit).kind:
            yield f"check {check.id} is in {check.unit}, {side} in {units[side]}"
