"""Dimensions of what a mechanism declares: its formulas are gone through with the kinds of what they take."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from diecut_report.contract.binding import Binding, Bound, ByText, bound
from diecut_report.contract.checks import Check
from diecut_report.contract.inputs import fields
from diecut_report.contract.mechanism import Mechanism, axes
from diecut_report.contract.result_names import names_ahead
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
from diecut_report.formula_checks.kinds import (
    NUMBER,
    Found,
    KindError,
    alike,
    angle_hint,
    kind_given,
    kind_text,
    times,
)
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.quantities.units import Kind, unit


def formulas(mechanism: Mechanism) -> Iterator[tuple[Step, str, Bound]]:
    """Yield every bound formula with its step and its part in it."""
    for _, step in mechanism.steps:
        for part in (
            phrase("formula"),
            phrase("condition"),
            "exists",
            phrase("equation"),
            "low",
            "high",
            "left",
            "right",
        ):
            declared = getattr(step, part, None)
            yield from _bindings(step, part, declared)
        for case in getattr(step, "cases", ()):
            yield from _of_case(step, case)


def _of_case(step: Step, case: Case) -> Iterator[tuple[Step, str, Bound]]:
    yield from _bindings(step, phrase("formula"), case.value)
    yield from _bindings(step, phrase("condition"), case.condition)


def _bindings(step: Step, part: str, declared: Any) -> Iterator[tuple[Step, str, Bound]]:
    """The formulas of a part of a step; of a choice by text all of them."""
    if isinstance(declared, ByText):
        yield from ((step, part, option) for option in declared.options())
    elif isinstance(declared, Binding):
        yield step, part, bound(declared)


def units_of(mechanism: Mechanism) -> dict[str, str]:
    """Return the SI unit of each id of numbers, inputs and steps."""
    found = {name: unit(meta.unit).si for name, meta in fields(mechanism.inputs) if hasattr(meta, "unit")}
    found |= {f"inputs.{name}": si for name, si in found.items()}
    for _, step in mechanism.steps:
        if not isinstance(step, SILENT):
            found[step.id] = unit(step.unit).si
    axis_of = axes(tuple(step for _, step in mechanism.steps), mechanism.inputs)
    for _, step in mechanism.steps:
        for each in names_ahead(step):
            of_place = found[axis_of[step.of]] if each.role == "place" else ""  # type: ignore[attr-defined]
            found.setdefault(each.name, {"count": "1", "place": of_place}.get(each.role, found[step.id]))
    return found


def dimensions(mechanism: Mechanism) -> Iterator[str]:
    """Yield formulas whose dimensions do not balance, or do not give what their step declares."""
    units = units_of(mechanism)
    for step, part, link in formulas(mechanism):
        try:
            given = _given(link, units)
        except KindError as error:
            yield f"{step.id}: {link.formula.__name__}: {error}"
            continue
        wanted = _wanted(step, part, units)
        if wanted is not None and not alike(given, unit(wanted).kind):
            yield Phrase(
                "{id}: {name} gives {given}, declared is {wanted}",
                id=step.id,
                name=link.formula.__name__,
                given=kind_text(given),
                wanted=wanted,
            ) + angle_hint(given, unit(wanted).kind)


def curve_units(mechanism: Mechanism) -> Iterator[str]:
    """Yield curves and what is laid over an abscissa, in other units than what they are made of has."""
    units = units_of(mechanism)
    axis_of = axes(tuple(step for _, step in mechanism.steps), mechanism.inputs)
    for _, step in mechanism.steps:
        for name, made, wanted in _made_of(step, units, axis_of):
            if not alike(made, wanted):
                yield Phrase(
                    "{id}: {name} gives {given}, declared is {wanted}",
                    id=step.id,
                    name=name,
                    given=kind_text(made),
                    wanted=kind_text(wanted),
                )


def _made_of(step: Step, units: dict[str, str], axis_of: dict[str, str]) -> Iterator[tuple[str, Found, Found]]:
    """What a step takes of a curve or an abscissa: in words, its kind, and the kind as it is wanted."""

    def of(name: str) -> Kind:
        return unit(units[name]).kind

    own = of(step.id) if step.id in units else None
    match step:
        case Derivative(of=curve):
            yield Phrase("the derivative of {curve}", curve=curve), times(of(curve), of(axis_of[curve]), -1), own
        case Accumulated(of=curve) | Reduction(of=curve, operation="integral"):
            yield Phrase("the integral of {curve}", curve=curve), times(of(curve), of(axis_of[curve])), own
        case Reduction(of=curve):
            yield curve, of(curve), own
        case Abscissa(period=str() as period):
            yield period, of(period), own
        case FromCurve():
            yield from ((step.given, of(step.given), own),) if step.given else ()
            yield from ((name, of(name), of(step.abscissa)) for name in (step.lasts,) if name)
            yield from ((name, of(name), NUMBER) for name in (step.start,) if name)
        case Breakpoints():
            yield from ((name, of(name), of(step.abscissa)) for name in (*step.places, step.every) if name)


def relations(mechanism: Mechanism) -> Iterator[str]:
    """Yield roots that are proved by a relation between quantities of unlike dimensions."""
    units = units_of(mechanism)
    sides: dict[str, list[Found]] = {}
    for step, part, link in formulas(mechanism):
        if part in ("left", "right"):
            sides.setdefault(step.id, []).append(_given(link, units))
    for name, (a, b) in sides.items():
        if not alike(a, b):
            words = "{name}: the relation equals {one} with {other}"
            yield Phrase(words, name=name, one=kind_text(a), other=kind_text(b))


def _wanted(step: Step, part: str, units: dict[str, str]) -> str | None:
    """The unit that a part of a step must give; None for conditions, and for the sides of an equation (compared below)."""
    if part == "formula" and isinstance(step, Value | Choice | Abscissa):
        return unit(step.unit).si
    if part in ("low", "high") and isinstance(step, Root):
        return unit(step.unit).si
    return None


def _given(link: Bound, units: dict[str, str]) -> Found:
    """The kind of what a bound formula gives; KindError where it has none."""
    taken = zip(link.names, link.takes, strict=True)
    kinds = {parameter: unit(units[name]).kind if isinstance(name, str) else name for parameter, name in taken}
    return kind_given(link.formula, kinds)


def check_units(mechanism: Mechanism) -> Iterator[str]:
    """Yield checks that compare quantities of unlike kinds."""
    units = units_of(mechanism)
    for check in mechanism.checks:
        yield from _unlike(check, units)


def _unlike(check: Check, units: dict[str, str]) -> Iterator[str]:
    for side in (check.demand, check.limit):
        if isinstance(side, str) and side in units and unit(units[side]).kind != unit(check.unit).kind:
            yield Phrase(
                "check {id} is in {unit}, {side} in {units}", id=check.id, unit=check.unit, side=side, units=units[side]
            )
