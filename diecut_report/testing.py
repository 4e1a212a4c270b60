"""The contract test for a mechanism plugin: ``check_mechanism(MECHANISM)`` raises AssertionError with all that is wrong.

It feeds every declared formula with quantities that carry units (pint) and refuses where dimensions do not balance, computes
every printed expression against the function it was read from, and looks for ids that nothing gives.
"""

from __future__ import annotations

import types
from collections.abc import Iterator
from itertools import chain
from typing import Any

import numpy as np
import pint

from diecut_report.contract.binding import Binding, Bound, ByText, bound
from diecut_report.contract.checks import Check
from diecut_report.contract.families import taken
from diecut_report.contract.inputs import Block, fields, nested
from diecut_report.contract.mechanism import Mechanism, axes
from diecut_report.contract.steps import SILENT, Abscissa, Case, Choice, Reduction, Root, Step, Value
from diecut_report.expressions import Constant, Formula, evaluate
from diecut_report.units import unit

REGISTRY: pint.UnitRegistry[float] = pint.UnitRegistry()


def check_mechanism(mechanism: Mechanism) -> None:
    """Raise AssertionError, listing every flaw of a mechanism's declaration."""
    problems = list(ids(mechanism)) or list(
        chain(dimensions(mechanism), relations(mechanism), printing(mechanism), check_units(mechanism))
    )
    assert not problems, f"{mechanism.kind}:\n" + "\n".join(problems)


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


def ids(mechanism: Mechanism) -> Iterator[str]:
    """Ids that a formula, check or step takes and nothing gives; quantities without symbol or description."""
    known = {*units_of(mechanism), *inputs_of(mechanism.inputs)}
    known |= {f"{step.id}_at" for _, step in mechanism.steps} | {f"{step.id}_count" for _, step in mechanism.steps}
    for _, step in mechanism.steps:
        yield from (f"{step.id} takes {name}, which nothing gives" for name in sorted(taken(step) - known))
    for check in mechanism.checks:
        for name in (check.demand, check.limit, *check.needs):
            if isinstance(name, str) and name not in known:
                yield f"check {check.id} takes {name}, which nothing gives"
    yield from (f"the key result {name} is no step" for name in mechanism.key_results if name not in known)
    for _, step in mechanism.steps:
        if not isinstance(step, SILENT) and not (step.symbol and step.description):
            yield f"{step.id} has no symbol or no description"


def inputs_of(model: type[Block], prefix: str = "") -> Iterator[str]:
    """The paths of all inputs and of the blocks that hold them."""
    for name, field in model.model_fields.items():
        yield f"{prefix}{name}"
        block = nested(field.annotation)
        if block:
            yield from inputs_of(block[0], f"{prefix}{name}.")


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


def _like(one: Any, other: Any) -> bool:
    return bool(REGISTRY.Quantity(one).dimensionality == REGISTRY.Quantity(other).dimensionality)


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
    named = {n: carried(function.__globals__[n]) for n in function.__code__.co_names if n in function.__globals__}
    return types.FunctionType(function.__code__, {**function.__globals__, **named})


def printing(mechanism: Mechanism) -> Iterator[str]:
    """Formulas whose printed expression does not compute what the function computes."""
    random = np.random.default_rng(1)
    for step, part, link in formulas(mechanism):
        taken = dict(zip(link.formula.parameters, random.uniform(0.1, 0.9, len(link.formula.parameters)), strict=True))
        values = taken | link.formula.constants
        with np.errstate(all="ignore"):
            printed = evaluate(link.formula.tree, lambda leaf, known=values: known[leaf.args[0]])  # type: ignore[misc]
            computed = link.formula(**taken)
        if not np.allclose(printed, computed, rtol=1e-12, equal_nan=True):
            yield f"{step.id}: the {part} {link.formula.__name__} prints {printed}, computes {computed}"


def check_units(mechanism: Mechanism) -> Iterator[str]:
    """Checks that compare quantities of unlike kinds."""
    units = units_of(mechanism)
    for check in mechanism.checks:
        yield from _unlike(check, units)


def _unlike(check: Check, units: dict[str, str]) -> Iterator[str]:
    for side in (check.demand, check.limit):
        if isinstance(side, str) and unit(units[side]).kind != unit(check.unit).kind:
            yield f"check {check.id} is in {check.unit}, {side} in {units[side]}"
