"""A machine whose checks fail, mended: the advice of all of them tried together, then the smallest changes with which none fails."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from diecut_report.config.discovery import Discovery
from diecut_report.config.loader import Config
from diecut_report.contract.inputs import Quantity
from diecut_report.design.advised import Advised, advised
from diecut_report.design.changeable import changeable, is_fixed, is_stepped, named_paths
from diecut_report.design.changed_machines import MOST, ChangedMachines, Enough, Spent
from diecut_report.design.choice_search import ChangeableChoice, changeable_choices, with_choices
from diecut_report.design.conflicts import CheckConflict, conflict_of, follows_from_none, scattered
from diecut_report.design.design_inputs import DesignInput, design_input
from diecut_report.design.may_be_freed import nothing_free, untried
from diecut_report.design.mending import MendingPath
from diecut_report.design.proved_machine import ProvedMachine, proved
from diecut_report.design.single_changes import single_change
from diecut_report.design.typed_changes import fewer, passes, rounded
from diecut_report.design.varied_machines import downstream
from diecut_report.errors import Problem, UserError
from diecut_report.expressions import Array
from diecut_report.languages.phrases import phrase
from diecut_report.study.definition.base_inputs import MECHANISMS, Input

Tell = Callable[[str], None]


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


def mended(
    config: Config,
    discovery: Discovery,
    *,
    free: Iterable[str] = (),
    keep: Iterable[str] = (),
    most: float = MOST,
    tell: Tell,
) -> Mended:
    """Return the machine with the smallest changes with which no check fails, calculated as a machine of its own.

    ``most`` machines are calculated at most to find it. UserError where nothing is free to be changed, or the machine cannot be as it is.
    """
    before = proved(config.tree, {}, discovery)
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
        tell(phrase("leaving out what is not needed"))
        run.spent.most = math.inf  # what is found is not lost for want of a few more
        return _shortest(config, discovery, before, run, path.share)
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


def _shortest(
    config: Config, discovery: Discovery, before: ProvedMachine, run: ChangedMachines, share: Array
) -> Mended:
    """The machine that passes with what is needed alone, and with few digits; proved."""
    for asked in list(run.choices):
        without = run.with_choices({each: text for each, text in run.choices.items() if each is not asked})
        if passes(without(share[None])).all():
            run = without
    share, typed = rounded(run, run.inputs, fewer(run, share))
    changes = [*_numbers(run.inputs, share, typed), *_choices(config, run.choices)]
    machine = proved(config.tree, {each.stands: each.after for each in changes}, discovery)
    left = tuple(name for name, _ in machine.checks("fail"))
    return Mended(before, tuple(changes), machine if not left else None, left, None, len(run.inputs), run.spent.count)


def _with_single_change(path: MendingPath, tell: Tell) -> MendingPath:
    """The search begun anew where one input alone mends the machine with less: of those that it changed, or of all where it mends nothing."""
    run, today = _machines(path), np.zeros(len(path.inputs))
    changed = np.flatnonzero(path.share).tolist()
    if path.passes and len(changed) < 2:
        return path
    tell(phrase("trying to change one input alone"))
    failing = {name.split(".")[0] for name in run(today[None]).failing(0)}
    among = changed if path.passes else range(len(path.inputs))
    among = [each for each in among if failing <= set(downstream(run.config, path.inputs[each].asked.instance))]
    for base in [today] if path.passes or not changed else [today, path.share]:
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
    today = np.zeros(len(inputs))
    shares = [
        advice.numbers[each.asked.path][1] / (each.today or 1.0) - 1.0 if each.asked.path in advice.numbers else 0.0
        for each in inputs
    ]
    advised = np.array(shares)
    if not advised.any():
        return today
    made = run(np.array([today, advised]))
    worse = len(made.failing(1)) > len(made.failing(0)) or not made.exists[1]
    return today if worse else advised


def _numbers(inputs: Sequence[DesignInput], share: Array, typed: dict[int, str]) -> list[InputChange]:
    return [
        InputChange(
            inputs[each].name,
            inputs[each].told(inputs[each].today or 0.0),
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
    today = design_input(config, asked.path).today
    return float(asked.meta.validate(text)) / today - 1.0 if today else None


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
