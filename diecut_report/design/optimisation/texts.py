"""What an optimisation has found, in words: for the terminal, and for the page."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

from diecut_report.design.optimisation.result import (
    Conflict,
    InputPlace,
    OptimisationResult,
    signs,
)
from diecut_report.quantities.formatting import number_text, with_unit
from diecut_report.quantities.units import unit
from diecut_report.study.analysis.variants import StoredColumn, table_text
from diecut_report.text.phrases import Counted, Phrase, joined, phrase
from diecut_report.text.translation import localised

DIGITS = 5
TOLD = 5  # machines that differ, demands that are broken


def quantity(value: float, column: StoredColumn) -> str:
    """Return an SI value in the unit that people read."""
    return localised(with_unit(number_text(unit(column.display).from_si(value), DIGITS), column.display))


def called(column: StoredColumn) -> str:
    """Return what a quantity is called in commands: ``knife.cut_time``, an input without ``mechanisms.``"""
    return column.name.removeprefix("mechanisms.")


def lines(found: OptimisationResult) -> Iterator[str]:
    """Yield what was searched for and found, a line after the other."""
    goals = [
        Phrase("{quantity} minimised" if goal.is_less else "{quantity} maximised", quantity=called(goal.column))
        for goal in found.front.objectives
    ]
    yield Phrase("searched for: {goals}", goals=joined(goals, ", "))
    yield counts(found)
    if found.conflict is not None:
        yield from conflict_lines(found.conflict)
        return
    held_ones = (held(each, found.front.is_single) for each in found.bounds)
    yield from filter(None, (head(found), *table(found), suggested(found), present(found), *held_ones))
    yield from recheck_lines(found)


def counts(found: OptimisationResult) -> str:
    """Return how many machines were tried, and what became of them."""
    tried = Counted(found.tried, "{n} machine tried", "{n} machines tried")
    parts: list[str] = [tried + phrase(", all that exist") if found.is_all else tried]
    parts.append(Counted(found.front.allowed, "{n} of them feasible", "{n} of them feasible"))
    if found.errors:
        parts.append(Counted(found.errors, "{n} cannot exist", "{n} cannot exist"))
    if found.dropped:
        words = "{n} violates a constraint between inputs", "{n} violate a constraint between inputs"
        parts.append(Counted(found.dropped, *words))
    return joined(parts, "; ")


def head(found: OptimisationResult) -> str:
    """Return how large the front is, and how much of it is listed."""
    if found.front.is_single:
        return phrase("the best of them:")
    size, listed = len(found.front.variants), len(found.front.listed)
    words = "Pareto front: {n} machine", "Pareto front: {n} machines"
    of_all = Phrase(", {listed} of them listed", listed=listed) if listed < size else ""
    return Counted(size, *words) + of_all + ":"


def table(found: OptimisationResult) -> list[str]:
    """Return the listed machines as lines of a table."""
    stored, front = found.stored, found.front
    fixed = [stored.columns[name] for name in ("variant", "status", "governing")]
    columns = [*fixed, *front.columns]
    text, _ = table_text(columns, [row(found, place) for place in front.listed], None)
    return [line for line in text.splitlines() if line.strip()]


def row(found: OptimisationResult, place: int) -> list[Any]:
    """Return a machine of the front: number, verdict, governing check, then objectives and inputs, each once (SI)."""
    front = found.front
    values: dict[str, Any] = {column.name: front.inputs[column.name][place] for column in front.varied}
    values |= {goal.column.name: front.values[place, n] for n, goal in enumerate(front.objectives)}
    own = [int(front.variants[place]), front.status[place], front.governing[place]]
    return [*own, *(plain(values[column.name]) for column in front.columns)]


def plain(value: Any) -> Any:
    """Return a value as plain data."""
    return value.item() if hasattr(value, "item") else value


def suggested(found: OptimisationResult) -> str:
    """Return which machine is suggested, and why."""
    front = found.front
    if front.is_single:
        return ""
    if front.suggested is None:
        return front.why
    number = int(front.variants[front.suggested])
    return Phrase("a suggestion: {number} ({why})", number=number, why=phrase(front.why))


def present(found: OptimisationResult, name: Callable[[StoredColumn], str] = called) -> str:
    """Return what today's machine has of the objectives, each by its ``name``."""
    if found.front.present is None:
        return ""
    goals = found.front.objectives
    told = []
    for goal, value in zip(goals, found.known.costs[0] * signs(goals), strict=True):
        shown = quantity(value, goal.column) if math.isfinite(value) else "–"
        told.append(Phrase("{name} {value}", name=name(goal.column), value=shown))
    verdict = phrase("it is feasible") if found.known.violations[0] == 0 else phrase("it is not feasible")
    template = "the present machine is {number} ({verdict}): {told}"
    return Phrase(template, number=0, verdict=verdict, told=joined(told, ", "))


def held(each: InputPlace, is_single: bool) -> str:
    """Return in words that an end of what is searched holds the front; nothing where none does."""
    if each.is_text or not (each.at_low or each.at_high):
        return ""
    ends = (
        (phrase("lower"), each.at_low, each.low, each.may_lower),
        (phrase("upper"), each.at_high, each.high, each.may_raise),
    )
    parts = [_end(each, *end, is_single) for end in ends if end[1]]
    return Phrase("{name}: {ends}", name=called(each.column), ends=joined(parts, "; "))


def _end(each: InputPlace, end: str, count: int, value: float, may_go: bool, is_single: bool) -> str:
    where = {"end": end, "value": quantity(value, each.column)}
    place = Phrase("is at the {end} limit of its range, {value}", where)
    if not is_single:
        one = "{n} of {all} is at the {end} limit of its range, {value}"
        place = Counted(count, one, "{n} of {all} are at the {end} limit of its range, {value}", where, all=each.count)
    more = ": the limit is active; widen the range to search further" if may_go else ", and the input allows no more"
    return place + phrase(more)


def recheck_lines(found: OptimisationResult) -> Iterator[str]:
    """Yield what the listed machines are by themselves."""
    count, differing = len(found.rechecks), found.differing
    if not differing:
        most = max((each.share for each in found.rechecks), default=0.0)
        agreed = "recalculated individually: {n} agrees{most}", "recalculated individually: all {n} agree{most}"
        share = Phrase(" (numbers differ by {share} at most)", share=f"{most:.1g}") if most else ""
        yield Counted(count, *agreed, most=share)
        return
    one = "recalculated individually: {n} of {all} differs"
    yield Counted(len(differing), one, "recalculated individually: {n} of {all} differ", all=count)
    for each in differing[:TOLD]:
        if each.fault:
            message = Phrase("{number}: {fault}", number=each.variant, fault=phrase(each.fault))
        elif each.status != each.alone:
            template = "{number}: {status} in the batch, {alone} on its own"
            message = Phrase(template, number=each.variant, status=phrase(each.status), alone=phrase(each.alone))
        else:
            template = "{number}: {name} differs by {share} of its value"
            message = Phrase(template, number=each.variant, name=each.name, share=f"{each.share:.2g}")
        yield "  " + message


def conflict_lines(why: Conflict) -> Iterator[str]:
    """Yield why no machine is allowed, and which one comes nearest."""
    if why.nearest is None:
        reason = phrase(why.reason) if why.reason else phrase("the constraints between inputs exclude them all")
        yield Phrase("none of them can be calculated: {reason}", reason=reason)
        return
    if len(why.together) == 1:
        yield Phrase("none of them satisfies this: {name}", name=why.together[0])
    elif why.together:
        yield Phrase("none of them satisfies all of these: {names}", names=", ".join(why.together))
    told = [
        f"{name} ({localised(f'{used:.4g}')})" if math.isfinite(used) else name for name, used in why.failing[:TOLD]
    ]
    names = ", ".join([*told, "…"] if len(why.failing) > TOLD else told)
    yield Phrase("the nearest is {number}, which violates {names}", number=why.nearest, names=names)
