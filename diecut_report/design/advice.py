"""A machine whose checks fail, mended: the advice of all of them tried together, then the smallest changes with which none fails."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from diecut_report.config.discovery import Discovery
from diecut_report.config.loader import Config
from diecut_report.design.advised import Advised, advised
from diecut_report.design.changeable import changeable
from diecut_report.design.design_inputs import DesignInput, design_input
from diecut_report.design.mending import MendingPath, conflict
from diecut_report.design.proved_machine import ProvedMachine, proved
from diecut_report.design.typed_changes import fewer, rounded
from diecut_report.design.varied_machines import VariedMachines, varied
from diecut_report.expressions import Array
from diecut_report.quantities.formatting import with_unit
from diecut_report.quantities.units import UnitError, number_and_unit
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

    ``left`` are the checks that fail at the best machine that was found, ``conflict`` those of them and others that cannot hold together
    there, as far as can be told. ``advised`` says how many of the changes are what the checks themselves advise.
    """

    before: ProvedMachine
    changes: tuple[InputChange, ...] = ()
    machine: ProvedMachine | None = None
    left: tuple[str, ...] = ()
    conflict: tuple[str, ...] = ()
    free: int = 0
    calculated: int = 0

    @property
    def size(self) -> float:
        """Return the sum of the changes, as shares of today's values: what the search makes small."""
        return float(sum(abs(each.share) for each in self.changes if each.share is not None))


class _Machines:
    """Calculates machines by the shares of their inputs that are changed; counts them."""

    def __init__(self, config: Config, inputs: list[DesignInput], choices: list[tuple[Input, str]]) -> None:
        self.config, self.inputs, self.choices, self.count = config, inputs, choices, 0
        self.today = np.array([each.today for each in inputs], dtype=float)

    def __call__(self, shares: Array) -> VariedMachines:
        count = len(shares)
        self.count += count
        values = self.today * (1.0 + shares)
        given: dict[Input, Any] = {each.asked: values[:, index] for index, each in enumerate(self.inputs)}
        return varied(self.config, given | {asked: [text] * count for asked, text in self.choices}, count)


def mended(
    config: Config, discovery: Discovery, *, free: Iterable[str] = (), keep: Iterable[str] = (), tell: Tell
) -> Mended:
    """Return the machine with the smallest changes with which no check fails, calculated as a machine of its own.

    UserError where nothing is free to be changed, or the machine cannot be as it is.
    """
    before = proved(config.tree, {}, discovery)
    if not before.checks("fail"):
        return Mended(before)
    kept = {design_input(config, name).asked.path for name in keep}
    only = {design_input(config, name).asked.path for name in free}
    advice = advised(config, before.checks("fail"))
    advice.leave_out(lambda path: path in kept or bool(only and path not in only))
    inputs = changeable(config, free, keep, [each.name for each, _ in advice.numbers.values()])
    run = _Machines(config, inputs, list(advice.choices.values()))
    path = MendingPath(run, inputs, _start(run, inputs, advice))
    path.go(tell)
    if not path.passes:
        return _unmended(before, path, inputs, run)
    tell("leaving out what is not needed")
    share, typed = rounded(run, inputs, fewer(run, path.share))
    changes = [*_numbers(inputs, share, typed), *_choices(config, advice)]
    machine = proved(config.tree, {each.stands: each.after for each in changes}, discovery)
    left = tuple(name for name, _ in machine.checks("fail"))
    return Mended(before, tuple(changes), machine if not left else None, left, (), len(inputs), run.count)


def _unmended(before: ProvedMachine, path: MendingPath, inputs: list[DesignInput], run: _Machines) -> Mended:
    against = conflict(path.planes, path.share, inputs) if path.planes else []
    left = tuple(path.made.failing(0))
    return Mended(before, (), None, left, tuple(against), len(inputs), run.count)


def _start(run: _Machines, inputs: list[DesignInput], advice: Advised) -> Array:
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


def _numbers(inputs: list[DesignInput], share: Array, typed: dict[int, str]) -> list[InputChange]:
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


def _choices(config: Config, advice: Advised) -> list[InputChange]:
    found = []
    for asked, text in advice.choices.values():
        instance = config.instances[asked.instance]
        assert instance is not None
        _, stands = instance.place.stands(asked.key)
        found.append(
            InputChange(asked.path.removeprefix(f"{MECHANISMS}."), config.tree.typed(stands) or "", text, None, stands)
        )
    return found


def lines(found: Mended) -> Iterator[str]:
    """Yield what became of the machine, in words."""
    failing = [name for name, _ in found.before.checks("fail")]
    if not failing:
        yield f"no check fails: nothing is to be mended (governing: {found.before.governing or 'none'})"
        return
    yield f"{_counted(failing)} today: {', '.join(failing)}"
    if found.machine is None:
        yield from _without(found)
        return
    yield f"with {len(found.changes)} change{'s' if len(found.changes) > 1 else ''} none fails, calculated as a machine of its own:"
    width = max(len(each.name) for each in found.changes)
    for each in found.changes:
        share = "" if each.share is None else f"  ({100 * each.share:+.2g} %)"
        yield f"  {each.name.ljust(width)}  {each.before or 'not given'} → {_said(each.after)}{share}"
    yield f"sum of the changes: {100 * found.size:.3g} % of today's values; governing: {found.machine.governing}"
    warned = [name for name, _ in found.machine.checks("warn")]
    if warned:
        yield f"with a warning: {', '.join(warned)}"


def _said(typed: str) -> str:
    """A value as it is typed, with its unit as one writes it."""
    try:
        number, own = number_and_unit(typed)
    except UnitError:  # a text or a yes/no
        return typed
    return with_unit(f"{number}", own or "1")


def _without(found: Mended) -> Iterator[str]:
    yield f"none of the {found.calculated} machines that were calculated with other values of {found.free} inputs passes"
    yield f"of the best of them {_counted(found.left)}: {', '.join(found.left)}"
    if found.conflict:
        yield f"as far as can be told there, these cannot hold together: {', '.join(found.conflict)}"
    yield "let more inputs be changed with --free, or change what the machine is made of"


def _counted(names: Sequence[str]) -> str:
    return f"{len(names)} check{'s fail' if len(names) > 1 else ' fails'}"


def data(found: Mended) -> dict[str, Any]:
    """Return the same as plain data."""
    machine = found.machine
    return {
        "schema_version": 1,
        "failing": [name for name, _ in found.before.checks("fail")],
        "changes": [{"name": c.name, "before": c.before, "after": c.after, "share": c.share} for c in found.changes],
        "size": found.size,
        "machine": None if machine is None else {"status": machine.status, "governing": machine.governing,
                                                 "warnings": [name for name, _ in machine.checks("warn")]},
        "left": list(found.left),
        "conflict": list(found.conflict),
        "free": found.free,
        "calculated": found.calculated,
    }  # fmt: skip
