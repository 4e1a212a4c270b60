"""A machine whose checks fail, mended: the advice of all of them tried together, then the smallest changes with which none fails."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.design.advised import (
    Advised,
    ChangeableChoice,
    CheckConflict,
    MendingPath,
    advised,
    changeable_choices,
    conflict_of,
    follows_from_none,
    scattered,
    with_choices,
)
from diecut_report.design.inputs import (
    DesignInput,
    changeable,
    design_input,
    is_fixed,
    is_stepped,
    named_paths,
    nothing_free,
    untried,
)
from diecut_report.design.machines import (
    MOST,
    ChangedMachines,
    Enough,
    ProvedMachine,
    Spent,
    VariedMachines,
    downstream,
    proved,
)
from diecut_report.errors import Problem, UserError
from diecut_report.formulas import Array
from diecut_report.mechanism.inputs import Quantity
from diecut_report.press import Press, Tell
from diecut_report.quantities.formatting import number_text, with_unit
from diecut_report.quantities.units import UnitError, number_and_unit
from diecut_report.study.definition.base_inputs import MECHANISMS, Input
from diecut_report.text.phrases import Counted, Phrase, phrase
from diecut_report.text.translation import localised

# Changes as a designer would type them: as few inputs as will do, as few digits as still pass.


NOTHING = 1e-6  # share of a value that is no change
DIGITS = (2, 3, 4, 5, 6)
DEARER, TYPED_CHANGES_EACH = 1.05, 0.005  # what rounding may make of the size of all changes, and add for each of them
EXACT = 12

Run = Callable[[Array], VariedMachines]
Texts = tuple[str, ...]


def fewer(run: Run, share: Array) -> Array:
    """Return the changes without those that are not needed for a machine that passes, the smallest left out first."""
    share = np.where(np.abs(share) > NOTHING, share, 0.0)
    while True:
        changed = [int(each) for each in np.argsort(np.abs(share)) if share[each]]
        tried = np.array([np.where(np.arange(len(share)) == each, 0.0, share) for each in changed])
        good = passes(run(tried)) if len(changed) else np.zeros(0, dtype=bool)
        if not good.any():
            return share
        share = tried[int(np.argmax(good))]


def rounded(run: Run, inputs: Sequence[DesignInput], share: Array) -> tuple[Array, dict[int, str]]:
    """Return the changes with few digits that still pass, and how each input is typed, by its place.

    All are rounded alike first; then each for itself, as far as it goes.
    """
    changed = [int(each) for each in np.flatnonzero(share)]
    start = {each: _texts(inputs[each], share[each]) for each in changed}
    if not changed:
        return share, {}
    ways = range(len(next(iter(start.values()))))
    most = DEARER * float(np.abs(share).sum()) + TYPED_CHANGES_EACH * len(changed)
    tried = [{each: start[each][way] for each in changed} for way in ways]
    good = _good(run, inputs, share, tried, most)
    if not good.any():
        return share, {each: inputs[each].typed(_value(inputs[each], share[each]), EXACT) for each in changed}
    typed = tried[int(np.argmax(good))]
    for each in changed:
        shorter = [typed | {each: text} for text in start[each] if len(text) < len(typed[each])]
        good = _good(run, inputs, share, shorter, most)
        typed = shorter[int(np.argmax(good))] if good.any() else typed
    return _shares(inputs, share, typed), typed


def passes(made: VariedMachines) -> Array:
    """Return which machines can be and have no check that fails."""
    return np.isin(made.status.astype(str), ["pass", "warn"])


def _good(run: Run, inputs: Sequence[DesignInput], share: Array, tried: Sequence[dict[int, str]], most: float) -> Array:
    """Which of these pass, with changes that are no greater than that."""
    if not tried:
        return np.zeros(0, dtype=bool)
    shares = np.array([_shares(inputs, share, typed) for typed in tried])
    return np.asarray(passes(run(shares)) & (np.abs(shares).sum(axis=1) <= most))


def _texts(design: DesignInput, share: float) -> Texts:
    """How a change may be typed, the shortest first: rounded to the nearest, beyond it, and before it."""
    value = _value(design, share)
    found = []
    for digits in DIGITS:
        further = share * (design.present or 1.0) > 0
        found += [
            design.typed(value, digits),
            design.typed_inwards(value, digits, up=further),
            design.typed_inwards(value, digits, up=not further),
        ]
    return tuple(found)


def _value(design: DesignInput, share: float) -> float:
    return (design.present or 0.0) * (1.0 + share)


def _shares(inputs: Sequence[DesignInput], share: Array, typed: dict[int, str]) -> Array:
    found = share.copy()
    for each, text in typed.items():
        try:
            found[each] = inputs[each].read(text) / (inputs[each].present or 1.0) - 1.0
        except ValueError:  # rounded beyond what its declaration allows: a machine that cannot be
            found[each] = np.nan
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
    found = _best(run, [_with(base, each, tried) for each in among], most)
    if found is None:
        return None
    which, row = found
    index, share = list(among)[which], float(row[list(among)[which]])
    sizes = np.sort(np.abs(tried[np.sign(tried) == np.sign(share)]))
    smaller = float(sizes[max(int(np.searchsorted(sizes, abs(share) * (1 - 1e-9))) - 1, 0)])
    nearer = np.sign(share) * np.linspace(min(smaller, abs(share)), abs(share), CLOSER)
    closer = _best(run, [_with(base, index, nearer)], most)
    return row if closer is None else closer[1]


def _with(base: Array, index: int, shares: Array) -> Array:
    rows = np.repeat(base[None], len(shares), axis=0)
    rows[:, index] = shares
    return rows


def _best(run: ChangedMachines, rows: list[Array], most: float) -> tuple[int, Array] | None:
    """The smallest changes of these that pass, and in which group of rows they stand."""
    best: tuple[int, Array] | None = None
    for which, group in enumerate(rows):
        size = np.abs(group).sum(axis=1)
        allowed = group[_allowed(run, group) & (size < most)]
        if not len(allowed):
            continue
        good = allowed[passes(run(allowed))]
        if len(good):
            row = good[int(np.argmin(np.abs(good).sum(axis=1)))]
            best, most = (which, row), float(np.abs(row).sum())
    return best


def _allowed(run: ChangedMachines, rows: Array) -> Array:
    """Which rows change no input beyond what its declaration allows."""
    found = np.ones(len(rows), dtype=bool)
    for index, each in enumerate(run.inputs):
        found &= each.allows((each.present or 0.0) * (1.0 + rows[:, index]))
    return found


@dataclass(frozen=True)
class InputChange:
    """Hold an input that is changed: its name, what stands there today (empty where nothing), and what is to be typed."""

    name: str
    before: str
    after: str
    share: float | None
    stands: tuple[str | int, ...]


@dataclass(frozen=True)
class Mended:
    """Hold what became of a machine: its checks before, the changes, the machine with them (None where none passes), why none does.

    ``left`` are the checks that fail at the best machine that was found, ``conflict`` those of them and others that do not hold together.
    ``is_ended``: as many machines were calculated as were allowed, and the search is not at its end. ``untried`` are the texts and numbers
    of parts that are tried only where they are named.
    """

    before: ProvedMachine
    changes: tuple[InputChange, ...] = ()
    machine: ProvedMachine | None = None
    left: tuple[str, ...] = ()
    conflict: CheckConflict | None = None
    free: int = 0
    calculated: int = 0
    is_ended: bool = False
    untried: tuple[str, ...] = ()

    @property
    def size(self) -> float:
        """Return the sum of the changes, as shares of today's values: what the search makes small."""
        return float(sum(abs(each.share) for each in self.changes if each.share is not None))


def mended(press: Press, *, free: Iterable[str] = (), keep: Iterable[str] = (), most: float = MOST) -> Mended:
    """Return the machine with the smallest changes with which no check fails, calculated as a machine of its own.

    ``most`` machines are calculated at most to find it. UserError where nothing is free to be changed, or the machine cannot be as it is.
    """
    before, config, tell = proved(press), press.config, press.tell
    free, keep = list(free), list(keep)
    numbers, only = named_paths(config, free)
    _, kept = named_paths(config, keep)
    if not before.checks("fail"):
        return Mended(before)
    advice = advised(config, before.checks("fail"))
    fixed = {path for path, asked in advice.asked.items() if is_fixed(config, asked)}
    advice.leave_out(lambda path: path in kept or (path not in only if only else path in fixed))
    further = [each.name for each in advice.others.values() if not is_stepped(each)]
    inputs = changeable(config, numbers, kept, further) if numbers or not only else []
    choices = changeable_choices(config, free, kept)
    begun = dict(advice.choices.values()) | advice.stepped
    if not inputs and not begun and not choices:
        raise UserError(Problem(nothing_free(config, {*only, *kept}), config.tree.file))
    free_ones = [*(each.asked for each in inputs), *(each.asked for each in choices), *begun]
    touched = {asked.instance for asked in free_ones}
    left_out = () if free else untried(config, touched, {each.path for each in free_ones} | kept)
    count = len(inputs) + len(choices)
    failing = tuple(name for name, _ in before.checks("fail"))
    if unreached := tuple(name for name in failing if follows_from_none(config, name, touched)):
        conflict = CheckConflict(unreached, is_proved=True)  # no search can mend it
        return Mended(before, left=failing, conflict=conflict, free=count, untried=left_out)
    run = ChangedMachines(config, inputs, begun, Spent(most))
    path, is_ended = _searched(MendingPath(run, inputs, _start(run, inputs, advice)), choices, tell)
    run = _machines(path)
    if path.passes:
        tell(phrase("removing unnecessary changes"))
        run.spent.most = math.inf  # what is found is not lost for want of a few more
        return _shortest(before, run, path.share)
    why = None
    if not is_ended:
        why, is_ended = _conflict(path, tell)
    found = tuple(path.made.failing(0))
    return Mended(before, (), None, found, why, count, run.spent.count, is_ended, left_out)


def _searched(path: MendingPath, choices: Sequence[ChangeableChoice], tell: Tell) -> tuple[MendingPath, bool]:
    """The best path that is found, and whether it was ended as enough machines were calculated."""
    try:
        if len(path.inputs):
            path.go(tell)
            path = _with_single_change(path, tell)
            path = path if path.passes else _again(path, tell)
        if not path.passes and choices:
            path = with_choices(path, choices, tell)
    except Enough:
        return path, True
    return path, False


def _conflict(path: MendingPath, tell: Tell) -> tuple[CheckConflict | None, bool]:
    """Why no machine passes, as far as enough machines tell it, and whether it was ended before."""
    try:
        return conflict_of(path, tell), False
    except Enough:
        return None, True


def _machines(path: MendingPath) -> ChangedMachines:
    assert isinstance(path.run, ChangedMachines)
    return path.run


def _shortest(before: ProvedMachine, run: ChangedMachines, share: Array) -> Mended:
    """The machine that passes with what is needed alone, and with few digits; proved."""
    for asked in list(run.choices):
        without = run.with_choices({each: text for each, text in run.choices.items() if each is not asked})
        if passes(without(share[None])).all():
            run = without
    share, typed = rounded(run, run.inputs, fewer(run, share))
    changes = [*_numbers(run.inputs, share, typed), *_choices(run.config, run.choices)]
    machine = proved(before.press.with_values({each.stands: each.after for each in changes}))
    left = tuple(name for name, _ in machine.checks("fail"))
    return Mended(before, tuple(changes), machine if not left else None, left, None, len(run.inputs), run.spent.count)


def _with_single_change(path: MendingPath, tell: Tell) -> MendingPath:
    """The search begun anew where one input alone mends the machine with less: of those that it changed, or of all where it mends nothing."""
    run, present = _machines(path), np.zeros(len(path.inputs))
    changed = np.flatnonzero(path.share).tolist()
    if path.passes and len(changed) < 2:
        return path
    tell(phrase("trying changes of a single input"))
    failing = {name.split(".")[0] for name in run(present[None]).failing(0)}
    among = changed if path.passes else range(len(path.inputs))
    among = [each for each in among if failing <= set(downstream(run.config, path.inputs[each].asked.instance))]
    for base in [present] if path.passes or not changed else [present, path.share]:
        found = single_change(run, base, among, path.merit if path.passes else math.inf)
        if found is not None:
            other = MendingPath(run, path.inputs, found)
            other.go(tell)
            return other
    return path


def _again(path: MendingPath, tell: Tell) -> MendingPath:
    """The search begun anew at the best of many machines that are scattered; the better of both."""
    places = scattered(len(path.inputs))
    found = path.merits(path.run(places), places)
    other = MendingPath(path.run, path.inputs, places[int(np.argmin(found))])
    other.go(tell)
    return other if other.passes or other.merit < path.merit else path


def _start(run: ChangedMachines, inputs: Sequence[DesignInput], advice: Advised) -> Array:
    """Where the search begins: at what is advised, where that machine is better than today's."""
    present = np.zeros(len(inputs))
    shares = [
        advice.numbers[each.asked.path][1] / (each.present or 1.0) - 1.0 if each.asked.path in advice.numbers else 0.0
        for each in inputs
    ]
    advised = np.array(shares)
    if not advised.any():
        return present
    made = run(np.array([present, advised]))
    worse = len(made.failing(1)) > len(made.failing(0)) or not made.exists[1]
    return present if worse else advised


def _numbers(inputs: Sequence[DesignInput], share: Array, typed: dict[int, str]) -> list[InputChange]:
    return [
        InputChange(
            inputs[each].name,
            inputs[each].told(inputs[each].present or 0.0),
            text,
            float(share[each]),
            inputs[each].stands,
        )
        for each, text in typed.items()
    ]


def _choices(config: Config, choices: Mapping[Input, str]) -> list[InputChange]:
    found = []
    for asked, text in choices.items():
        instance = config.instances[asked.instance]
        assert instance is not None
        _, stands = instance.place.stands(asked.key)
        found.append(
            InputChange(
                asked.path.removeprefix(f"{MECHANISMS}."),
                config.tree.typed(stands) or "",
                text,
                _share(config, asked, text),
                stands,
            )
        )
    return found


def _share(config: Config, asked: Input, text: str) -> float | None:
    """By how much a stepped number is changed; None for a text."""
    if not isinstance(asked.meta, Quantity):
        return None
    present = design_input(config, asked.path).present
    return float(asked.meta.validate(text)) / present - 1.0 if present else None


def data(found: Mended) -> dict[str, Any]:
    """Return the same as plain data."""
    machine, why = found.machine, found.conflict
    return {
        "schema_version": 1,
        "failing": [name for name, _ in found.before.checks("fail")],
        "changes": [{"name": c.name, "before": c.before, "after": c.after, "share": c.share} for c in found.changes],
        "size": found.size,
        "machine": None if machine is None else {"status": machine.status, "governing": machine.governing,
                                                 "warnings": [name for name, _ in machine.checks("warn")]},
        "left": list(found.left),
        "conflict": None if why is None else {"checks": list(why.checks), "proved": why.is_proved, "least": why.is_least},
        "free": found.free,
        "calculated": found.calculated,
        "ended": found.is_ended,
        "untried": list(found.untried),
    }  # fmt: skip


# What became of a machine that was to be mended, in words.


def lines(found: Mended) -> Iterator[str]:
    """Yield what became of the machine, in words."""
    failing = [name for name, _ in found.before.checks("fail")]
    if not failing:
        words = "no check fails: nothing to fix (governing: {check})"
        yield Phrase(words, check=found.before.governing or phrase("none"))
        return
    yield Counted(
        len(failing),
        "{n} check fails at present: {checks}",
        "{n} checks fail at present: {checks}",
        checks=", ".join(failing),
    )
    if found.machine is None:
        yield from _without(found)
        return
    one = "with {n} change no check fails, recalculated as a single machine:"
    yield Counted(len(found.changes), one, "with {n} changes no check fails, recalculated as a single machine:")
    width = max(len(each.name) for each in found.changes)
    yield from (_change(each, width) for each in found.changes)
    words = "total change: {size} % of the present values; governing: {check}"
    yield Phrase(
        words, size=localised(number_text(100 * found.size, 3)), check=found.machine.governing or phrase("none")
    )
    if warned := [name for name, _ in found.machine.checks("warn")]:
        yield Phrase("with a warning: {checks}", checks=", ".join(warned))


def share_told(share: float) -> str:
    """Return a change as a share of today's value, in percent with a sign: two digits, or a whole number of more."""
    percent = 100 * share
    told = number_text(round(percent) if abs(percent) >= 100 else percent, 2)
    return f"{'+' * (share > 0)}{localised(told)} %"


def _change(change: InputChange, width: int) -> Phrase:
    share = "" if change.share is None else f"  ({share_told(change.share)})"
    before = change.before or phrase("not given")
    return Phrase(
        "  {name}  {before} → {after}{share}",
        name=change.name.ljust(width),
        before=before,
        after=_said(change.after),
        share=share,
    )


def _said(typed: str) -> str:
    """A value as it is typed, with its unit as one writes it."""
    try:
        number, own = number_and_unit(typed)
    except UnitError:  # a text or a yes/no
        return typed
    return with_unit(f"{number}", own or "1")


def _without(found: Mended) -> Iterator[Phrase]:
    words = "none of the {machines} machines calculated with other values of the free inputs ({free}) passes"
    if found.calculated:
        yield Phrase(words, machines=found.calculated, free=found.free)
    if found.is_ended:
        yield phrase("the search stopped at its limit and has not converged; increase --most")
    if found.calculated and found.left:
        one = "in the best of them {n} check fails: {checks}"
        many = "in the best of them {n} checks fail: {checks}"
        yield Counted(len(found.left), one, many, checks=", ".join(found.left))
    if found.conflict:
        yield from _advice_text_conflict(found.conflict)
    if found.untried:
        words = "not tried, as --free must name them, and then names all that may be changed: {names}"
        yield Phrase(words, names=", ".join(found.untried))
    yield phrase("allow more inputs to change with --free, or change the concept of the machine")


def _advice_text_conflict(found: CheckConflict) -> Iterator[Phrase]:
    """What is proved of it, and what is not."""
    count, checks = len(found.checks), ", ".join(found.checks)
    if found.is_proved:
        one = "proved: {checks} does not depend on any free input and fails for all of their values"
        many = "proved: {checks} do not depend on any free input and fail for all of their values"
        yield Counted(count, one, many, checks=checks)
    elif count == 1:
        yield Phrase(
            "no machine was found that satisfies {checks}; this does not prove that none exists", checks=checks
        )
    elif found.is_least:
        yield Phrase(
            "no machine was found that satisfies all of these; this does not prove that none exists: {checks}",
            checks=checks,
        )
        yield phrase("if any one of them is dropped, a calculated machine satisfies the others")
    else:
        words = "no machine was found that satisfies all of these; a smaller set may conflict already: {checks}"
        yield Phrase(words, checks=checks)
