"""A machine whose checks fail, mended: the advice of all of them tried together, then the smallest changes with which none fails."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.config.references import upstream
from diecut_report.design.advised import (
    Advised,
    CheckConflict,
    Choices,
    MendingPath,
    advised,
    changeable_choices,
    conflict_of,
    scattered,
    with_choices,
)
from diecut_report.design.inputs import (
    DesignInput,
    changeable,
    is_fixed,
    named_input,
    nothing_free,
    touched_by,
    untried,
)
from diecut_report.design.machines import (
    MOST,
    ChangedMachines,
    Enough,
    ProvedMachine,
    Spent,
    downstream,
    proved,
)
from diecut_report.errors import Problem, UserError
from diecut_report.formulas import Array
from diecut_report.press import Press
from diecut_report.quantities.formatting import number_text, with_unit
from diecut_report.quantities.units import UnitError, number_and_unit
from diecut_report.study.definition.base_inputs import Input
from diecut_report.text.phrases import Counted, Phrase, phrase
from diecut_report.text.translation import localised

# Changes as a designer would type them: as few inputs as will do, as few digits as still pass.


NOTHING = 1e-6  # share of a value that is no change
DIGITS = (2, 3, 4, 5, 6)
DEARER, TYPED_CHANGES_EACH = 1.05, 0.005  # what rounding may make of the size of all changes, and add for each of them
EXACT = 12
MOST_CHANGES = 12  # of a machine that does not pass, that are shown

Ended = Literal["", "limit", "stopped"]
Typed = dict[int, str]
"""How inputs are typed, by their places."""


def fewer(run: ChangedMachines, share: Array) -> Array:
    """Return the changes without those that are not needed for a machine that passes, the smallest left out first."""
    share = np.where(np.abs(share) > NOTHING, share, 0.0)
    while share.any():
        changed = [int(each) for each in np.argsort(np.abs(share)) if share[each]]
        tried = np.array([np.where(np.arange(len(share)) == each, 0.0, share) for each in changed])
        good = run(tried).passes
        if not good.any():
            break
        share = tried[int(np.argmax(good))]
    return share


def rounded(run: ChangedMachines, share: Array) -> tuple[Array, Typed]:
    """Return the changes with few digits that still pass, and how each input is typed.

    All are rounded alike first; then each for itself, as far as it goes.
    """
    changed = [int(each) for each in np.flatnonzero(share)]
    if not changed:
        return share, {}
    start = {each: _texts(run.inputs[each], share[each]) for each in changed}
    most = DEARER * float(np.abs(share).sum()) + TYPED_CHANGES_EACH * len(changed)
    typed = _first_good(
        run, share, [dict(zip(start, texts, strict=True)) for texts in zip(*start.values(), strict=True)], most
    )
    if typed is None:
        return share, {each: run.inputs[each].typed(run.inputs[each].changed(share[each]), EXACT) for each in changed}
    for each in changed:
        shorter = [typed | {each: text} for text in start[each] if len(text) < len(typed[each])]
        typed = _first_good(run, share, shorter, most) or typed
    return _shares(run, share, typed), typed


def _first_good(run: ChangedMachines, share: Array, tried: Sequence[Typed], most: float) -> Typed | None:
    """The first of these that passes, with changes that are no greater than that."""
    if not tried:
        return None
    shares = np.array([_shares(run, share, typed) for typed in tried])
    good = run(shares).passes & (np.abs(shares).sum(axis=1) <= most)
    return tried[int(np.argmax(good))] if good.any() else None


def _texts(design: DesignInput, share: float) -> list[str]:
    """How a change may be typed, the shortest first: rounded to the nearest, beyond it, and before it."""
    value, further = design.changed(share), share * (design.present or 1.0) > 0
    return [
        text
        for digits in DIGITS
        for text in (
            design.typed(value, digits),
            design.typed_inwards(value, digits, up=further),
            design.typed_inwards(value, digits, up=not further),
        )
    ]


def _shares(run: ChangedMachines, share: Array, typed: Typed) -> Array:
    """The changes with these typed; NaN, a machine that cannot be, where one was rounded beyond what is allowed."""
    found = share.copy()
    for each, text in typed.items():
        found[each] = run.inputs[each].share(run.inputs[each].read_allowed(text))
    return found


# One input alone changed over its whole range: finds what steps from one machine to the next do not see, such as a size that is rounded.


LEAST, LOWEST, HIGHEST = 0.004, 0.95, 3.0  # shares of today's value by which an input is changed
MACHINES, EACH = 500, (24, 100)  # of one scan, and of each input to each side
CLOSER = 12  # machines between one that passes and the next smaller change


def single_change(run: ChangedMachines, base: Array, among: Collection[int], most: float) -> Array | None:
    """Return the smallest changes of one input among these, beside what ``base`` changes of the others, with which all passes.

    None where none is found whose sum is less than ``most``.
    """
    if not among:
        return None
    count = int(np.clip(MACHINES / 2 / len(among), *EACH))
    tried = np.concatenate([-np.geomspace(LOWEST, LEAST, count), np.geomspace(LEAST, HIGHEST, count)])
    found = _best(run, base, dict.fromkeys(among, tried), most)
    if found is None:
        return None
    index, row = found
    share = float(row[index])
    sizes = np.sort(np.abs(tried[np.sign(tried) == np.sign(share)]))
    smaller = float(sizes[max(int(np.searchsorted(sizes, abs(share) * (1 - 1e-9))) - 1, 0)])
    nearer = np.sign(share) * np.linspace(min(smaller, abs(share)), abs(share), CLOSER)
    closer = _best(run, base, {index: nearer}, most)
    return row if closer is None else closer[1]


def _best(run: ChangedMachines, base: Array, tried: Mapping[int, Array], most: float) -> tuple[int, Array] | None:
    """The smallest changes that pass with one input changed by one of these shares beside the base, and which input that is."""
    best: tuple[int, Array] | None = None
    for index, shares in tried.items():
        rows = np.repeat(base[None], len(shares), axis=0)
        rows[:, index] = shares
        allowed = np.abs(rows).sum(axis=1) < most
        for column, each in enumerate(run.inputs):
            allowed &= each.allows(each.changed(rows[:, column]))
        rows = rows[allowed]
        good = rows[run(rows).passes] if len(rows) else rows
        if len(good):
            row = good[int(np.argmin(np.abs(good).sum(axis=1)))]
            best, most = (index, row), float(np.abs(row).sum())
    return best


@dataclass(frozen=True)
class InputChange:
    """Hold an input that is changed: what stands there today (empty where nothing), what is to be typed, and by which share it differs."""

    design: DesignInput
    before: str
    after: str
    share: float | None


@dataclass(frozen=True)
class Mended:
    """Hold what became of a machine: its checks before, the changes, the machine with them (None where none passes), why none does.

    ``left`` are the checks that fail at the best machine that was found, with these changes, ``conflict`` those of them and others that do
    not hold together. ``ended`` says by what a search was ended before it was at its end: by the limit of machines, or by somebody.
    ``untried`` are the texts and numbers of parts that are tried only where they are named.
    """

    before: ProvedMachine
    changes: tuple[InputChange, ...] = ()
    machine: ProvedMachine | None = None
    left: tuple[str, ...] = ()
    conflict: CheckConflict | None = None
    free: int = 0
    calculated: int = 0
    ended: Ended = ""
    untried: tuple[str, ...] = ()

    @property
    def size(self) -> float:
        """Return the sum of the changes, as shares of today's values: what the search makes small."""
        return float(sum(abs(each.share) for each in self.changes if each.share is not None))


def mended(press: Press, *, free: Iterable[str] = (), keep: Iterable[str] = (), most: float = MOST) -> Mended:
    """Return the machine with the smallest changes with which no check fails, calculated as a machine of its own.

    ``most`` machines are calculated at most to find it. UserError where nothing is free to be changed, or the machine cannot be as it is.
    """
    before, config = proved(press, is_advised=True), press.config
    named = [named_input(config, name) for name in free]
    kept = {named_input(config, name).asked.path for name in keep}
    failing = before.failing
    if not failing:
        return Mended(before)
    only, numbers = {each.asked.path for each in named}, [each for each in named if each.asked.unit is not None]
    advice = advised(config, before.checks("fail"))
    advice.leave_out(lambda asked: asked.path in kept or (asked.path not in only if only else is_fixed(config, asked)))
    inputs = changeable(config, numbers, kept, advice.others.values()) if numbers or not only else []
    choices = changeable_choices(config, named, kept)
    stepped = {path: (each, each.typed(value)) for path, (each, value) in advice.numbers.items() if each.is_stepped}
    begun = advice.choices | stepped
    free_ones = [each.asked for each in (*inputs, *(each for each, _ in (*choices.values(), *begun.values())))]
    if not free_ones:
        raise UserError(Problem(nothing_free(config, {*only, *kept}), config.tree.file))
    touched, count = set().union(*(touched_by(config, asked) for asked in free_ones)), len(inputs) + len(choices)
    left_out = () if named else untried(config, touched, {each.path for each in free_ones} | kept)
    reached = {name: upstream(config.links, [name.split(".")[0]]) for name in failing}
    if unreached := tuple(name for name in failing if reached[name].isdisjoint(touched)):
        conflict = CheckConflict(unreached, is_proved=True)  # no search can mend it
        return Mended(before, left=failing, conflict=conflict, free=count, untried=left_out)
    run = ChangedMachines(config, inputs, begun, Spent(most), press.tell)
    path, ended = _searched(MendingPath(run, _start(run, advice)), choices)
    if path.passes:
        press.tell(phrase("removing unnecessary changes"))
        run.spent.most = math.inf  # what is found is not lost for want of a few more
        return _shortest(before, path)
    why = None
    if not ended:
        try:
            why = conflict_of(path)
        except Enough:
            ended = "limit"
        except KeyboardInterrupt:
            ended = "stopped"
    changes = tuple(_changes(path.run, path.share, _typed(path.run, path.share)))
    return Mended(before, changes, None, tuple(path.made.failing(0)), why, count, run.spent.count, ended, left_out)


def _searched(path: MendingPath, choices: Choices) -> tuple[MendingPath, Ended]:
    """The best path that is found, and by what it was ended."""
    try:
        if path.run.inputs:
            path.go()
            path = _with_single_change(path)
            path = path if path.passes else _again(path)
        if not path.passes and choices:
            path = with_choices(path, choices)
    except Enough:
        return path, "limit"
    except KeyboardInterrupt:
        return path, "stopped"
    return path, ""


def _shortest(before: ProvedMachine, path: MendingPath) -> Mended:
    """The machine that passes with what is needed alone, and with few digits; proved."""
    run, share = path.run, path.share
    ended: Ended = ""
    try:
        for name in run.choices:
            without = replace(run, choices={other: chosen for other, chosen in run.choices.items() if other != name})
            if without(share[None]).passes.all():
                run = without
        share, typed = rounded(run, fewer(run, share))
    except KeyboardInterrupt:
        typed, ended = _typed(run, share), "stopped"
    changes = list(_changes(run, share, typed))
    machine = proved(
        before.press.with_values({each.design.stands: each.design.in_file(each.after) for each in changes})
    )
    passing = None if machine.failing else machine
    return Mended(before, tuple(changes), passing, machine.failing, None, len(run.inputs), run.spent.count, ended)


def _changes(run: ChangedMachines, share: Array, typed: Typed) -> Iterator[InputChange]:
    """The changes of a machine, as they are typed."""
    for number, text in typed.items():
        each = run.inputs[number]
        yield InputChange(each, each.told(each.present or 0.0), text, float(share[number]))
    for each, text in run.choices.values():
        is_number = each.asked.unit is not None and each.present
        yield InputChange(each, each.written or "", text, each.share(each.read(text)) if is_number else None)


def _typed(run: ChangedMachines, share: Array) -> Typed:
    """How the changes of a machine that does not pass are typed, the greatest first: as it was calculated."""
    changed = [int(each) for each in np.argsort(-np.abs(share)) if abs(share[each]) > NOTHING]
    return {each: run.inputs[each].typed(run.inputs[each].changed(share[each]), DIGITS[-1]) for each in changed}


def _with_single_change(path: MendingPath) -> MendingPath:
    """The search begun anew where one input alone mends the machine with less: of those that it changed, or of all where it mends nothing."""
    run, present = path.run, path.run.present
    changed = np.flatnonzero(path.share).tolist()
    if path.passes and len(changed) < 2:
        return path
    run.tell(phrase("trying changes of a single input"))
    failing = {name.split(".")[0] for name in run(present[None]).failing(0)}
    among = changed if path.passes else range(len(run.inputs))
    among = [each for each in among if failing <= _reached(run.config, run.inputs[each].asked)]
    for base in [present] if path.passes or not changed else [present, path.share]:
        found = single_change(run, base, among, path.merit if path.passes else math.inf)
        if found is not None:
            other = MendingPath(run, found)
            other.go()
            return other
    return path


def _reached(config: Config, asked: Input) -> set[str]:
    """The mechanisms that follow from an input."""
    return set().union(*(downstream(config, name) for name in touched_by(config, asked)))


def _again(path: MendingPath) -> MendingPath:
    """The search begun anew at the best of many machines that are scattered; the better of both."""
    places = scattered(len(path.run.inputs))
    found = path.merits(path.run(places), places)
    other = MendingPath(path.run, places[int(np.argmin(found))])
    other.go()
    return other if other.passes or other.merit < path.merit else path


def _start(run: ChangedMachines, advice: Advised) -> Array:
    """Where the search begins: at what is advised, where that machine is better than today's."""
    known = {path: each.share(value) for path, (each, value) in advice.numbers.items()}
    advised = np.array([known.get(each.asked.path, 0.0) for each in run.inputs])
    if not advised.any():
        return run.present
    made = run(np.array([run.present, advised]))
    worse = len(made.failing(1)) > len(made.failing(0)) or not made.exists[1]
    return run.present if worse else advised


def data(found: Mended) -> dict[str, Any]:
    """Return the same as plain data."""
    machine, why = found.machine, found.conflict
    changes = [(each.design.name, each.before, each.after, each.share) for each in found.changes]
    return {
        "schema_version": 1,
        "failing": list(found.before.failing),
        "changes": [dict(zip(("name", "before", "after", "share"), each, strict=True)) for each in changes],
        "size": found.size,
        "machine": machine and {"status": machine.run.status, "governing": machine.governing, "warnings": list(machine.checks("warn"))},
        "left": list(found.left),
        "conflict": why and {"checks": list(why.checks), "proved": why.is_proved, "least": why.is_least},
        "free": found.free,
        "calculated": found.calculated,
        "ended": bool(found.ended),
        "untried": list(found.untried),
    }  # fmt: skip


# What became of a machine that was to be mended, in words.


def lines(found: Mended) -> Iterator[str]:
    """Yield what became of the machine, in words."""
    failing, machine = found.before.failing, found.machine
    if not failing:
        template = "no check fails: nothing to fix (governing: {check})"
        yield Phrase(template, check=found.before.governing or phrase("none"))
        return
    checks = ", ".join(failing)
    yield Counted(
        len(failing), "{n} check fails at present: {checks}", "{n} checks fail at present: {checks}", checks=checks
    )
    if machine is None:
        yield from _without(found)
        return
    one = "with {n} change no check fails, recalculated as a single machine:"
    yield Counted(len(found.changes), one, "with {n} changes no check fails, recalculated as a single machine:")
    yield from _listed_changes(found.changes)
    template = "total change: {size} % of the present values; governing: {check}"
    yield Phrase(template, size=localised(number_text(100 * found.size, 3)), check=machine.governing or phrase("none"))
    if warned := machine.checks("warn"):
        yield Phrase("with a warning: {checks}", checks=", ".join(warned))


def _listed_changes(changes: Sequence[InputChange]) -> Iterator[Phrase]:
    width = max(len(each.design.name) for each in changes)
    for each in changes:
        share = "" if each.share is None else f"  ({share_told(each.share)})"
        before, after = each.before or phrase("not given"), _as_written(each.after)
        name = each.design.name.ljust(width)
        yield Phrase("  {name}  {before} → {after}{share}", name=name, before=before, after=after, share=share)


def share_told(share: float) -> str:
    """Return a change as a share of today's value, in percent with a sign: two digits, or a whole number of more."""
    percent = 100 * share
    told = number_text(round(percent) if abs(percent) >= 100 else percent, 2)
    return f"{'+' * (share > 0)}{localised(told)} %"


def _as_written(typed: str) -> str:
    """A value as it is typed, with its unit as one writes it."""
    try:
        number, own = number_and_unit(typed)
    except UnitError:  # a text or a yes/no
        return typed
    return with_unit(f"{number}", own or "1")


def _without(found: Mended) -> Iterator[Phrase]:
    template = "none of the {machines} machines calculated with other values of the free inputs ({free}) passes"
    if found.calculated:
        yield Phrase(template, machines=found.calculated, free=found.free)
    if found.ended == "limit":
        yield phrase("the search stopped at its limit and has not converged; increase --most")
    if found.ended == "stopped":
        yield phrase("the search was stopped before it converged")
    if found.calculated and found.left:
        one = "in the best of them {n} check fails: {checks}"
        many = "in the best of them {n} checks fail: {checks}"
        yield Counted(len(found.left), one, many, checks=", ".join(found.left))
    if shown := found.changes[:MOST_CHANGES]:
        yield phrase("the changes of the best of them:")
        yield from _listed_changes(shown)
        more = len(found.changes) - len(shown)
        yield from [Counted(more, "  and {n} further one", "  and {n} further ones")] if more else []
    if found.conflict:
        yield from _conflict(found.conflict)
    if found.untried:
        template = "not tried, as --free must name them, and then names all that may be changed: {names}"
        yield Phrase(template, names=", ".join(found.untried))
    yield phrase("allow more inputs to change with --free, or change the concept of the machine")


def _conflict(found: CheckConflict) -> Iterator[Phrase]:
    count, checks = len(found.checks), ", ".join(found.checks)
    if found.is_proved:
        one = "proved: {checks} does not depend on any free input and fails for all of their values"
        many = "proved: {checks} do not depend on any free input and fail for all of their values"
        yield Counted(count, one, many, checks=checks)
    elif count == 1:
        template = "no machine was found that satisfies {checks}; this does not prove that none exists"
        yield Phrase(template, checks=checks)
    elif found.is_least:
        template = "no machine was found that satisfies all of these; this does not prove that none exists: {checks}"
        yield Phrase(template, checks=checks)
        yield phrase("if any one of them is dropped, a calculated machine satisfies the others")
    else:
        template = "no machine was found that satisfies all of these; a smaller set may conflict already: {checks}"
        yield Phrase(template, checks=checks)
