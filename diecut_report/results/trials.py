"""What an advice tries: numbers of the inputs, and the machine with other values there."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from diecut_report.declaration.names import world
from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation
from diecut_report.machine.steps.needed import needed
from diecut_report.machine.steps.run import recalculated
from diecut_report.mechanism.chapters import taken
from diecut_report.mechanism.checks import Check
from diecut_report.mechanism.inputs import Quantity, list_inputs
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.steps import Clash, Require
from diecut_report.standards.ranges import range_of

Judge = Callable[[Calculation, Check], tuple[Array, Array]]
"""Where a check is made, and where it holds, each of shape (variants,)."""

LEVELS = 3  # of what holds: the check itself; the checks that held, too; the failing ones with the same keys, too
SMALLEST_BATCH = 4  # machines; a larger batch that cannot be calculated as a whole is halved


@dataclass(frozen=True)
class VariedNumber:
    """A number of the inputs: a key, and of a list the part; ``present`` is its value, SI, None where it is not given."""

    key: str
    meta: Quantity
    part: int | None
    present: float | None
    path: str

    def shown(self, value: float) -> float:
        """Return an SI value in the unit of the input."""
        return float(f"{self.meta.parsed_unit.from_si(value):.12g}")

    def si(self, shown: float) -> float:
        """Return the SI value of a number that is typed in the unit of the input."""
        return self.meta.parsed_unit.to_si(shown)


def _possible(calc: Calculation, key: str, meta: Quantity) -> Quantity:
    """An input with the sizes that some machine has: what is advised must not be refused."""
    row = range_of(calc.mechanism.kind, key)
    if row is None or row.of or not row.hard[0]:
        return meta
    low, high = (f"{end!r} {meta.parsed_unit.si}".removesuffix(" 1") for end in row.hard)
    return replace(meta, plausible=(low, high))


def parts_of(value: Any) -> list[Any]:
    """Return what a calculation of one machine has of an input, of a list for each part; nothing where it is not given."""
    return [] if value is None else list(value[0] if isinstance(value, np.ndarray) else value)


@lru_cache(maxsize=1024)
def _required(mechanism: Mechanism, given: frozenset[str], keys: tuple[str, ...]) -> frozenset[str]:
    """What conditions take that follow from some inputs: without it they are not judged."""
    conditions = (taken(step) for _, step in mechanism.active(given) if isinstance(step, Require | Clash))
    return frozenset().union(
        *(names for names in conditions if not inputs_of(mechanism, given, tuple(sorted(names))).isdisjoint(keys))
    )


@lru_cache(maxsize=4096)
def inputs_of(mechanism: Mechanism, given: frozenset[str], names: tuple[str, ...]) -> frozenset[str]:
    """Return the inputs that quantities follow from, with what stands between."""
    ids = needed(mechanism, given, names)
    steps = [step for _, step in mechanism.active(given) if step.id in ids]
    found = set(names).union(*(taken(step) | {*getattr(step, "holds", ())} for step in steps))
    return frozenset(name.removeprefix("inputs.") for name in found)


@dataclass(frozen=True)
class Trials:
    """Try inputs with which a failing check holds, and others of its mechanism; without a ``check``: with which its machine is possible.

    ``held`` are the checks that hold, ``failing`` those that fail and name the same keys. Numbers at the paths ``kept`` stay as they are.
    """

    calc: Calculation
    judge: Judge
    check: Check | None = None
    held: Sequence[Check] = ()
    failing: Sequence[Check] = ()
    kept: frozenset[str] = frozenset()

    def hold(self, changed: Mapping[str, Any], count: int) -> Array | None:
        """Return for so many machines whether what is asked holds, by level: shape (LEVELS, machines).

        None where a machine is among these that cannot be proved, or none is possible.
        """
        held, failing = (self._affected(tuple(changed), checks) for checks in (self.held, self.failing))
        made = recalculated(self.calc, changed, count, self._names(changed, [*held, *failing]))
        if made is None:
            return None
        there, holds = self.judge(made, self.check) if self.check else (True, np.ones(count, dtype=bool))
        own = there & holds
        own[list(made.flaws)] = False
        sound = own & self._none_fails(made, held)
        return np.array([own, sound, sound & self._none_fails(made, failing)])

    def broken(self, changed: Mapping[str, Any]) -> tuple[str, ...]:
        """Return the titles of the checks that held and fail on a single machine with other inputs; of what was not possible none."""
        if self.check is None:
            return ()
        checks = self._affected(tuple(changed), self.held)
        made = recalculated(self.calc, changed, 1, self._names(changed, checks))
        return () if made is None else tuple(check.title for check in checks if not self._none_fails(made, [check])[0])

    def _none_fails(self, made: Calculation, checks: Sequence[Check]) -> Array:
        """The machines of which no check fails."""
        found = np.ones(made.count, dtype=bool)
        for there, holds in (self.judge(made, check) for check in checks):
            found &= ~there | holds
        return found

    def _affected(self, keys: tuple[str, ...], checks: Sequence[Check]) -> list[Check]:
        """The checks that follow from one of these inputs; all where other steps may be made."""
        if self._needs_all(keys):
            return list(checks)
        mechanism, given = self.calc.mechanism, self.calc.given
        return [each for each in checks if not inputs_of(mechanism, given, (*each.named, *each.needs)).isdisjoint(keys)]

    def _names(self, changed: Mapping[str, Any], checks: Sequence[Check]) -> list[str] | None:
        """What must be calculated to judge the checks; None for all, as curves are judged when all is known."""
        names = {name for each in (self.check, *checks) if each for name in each.named}
        names |= _required(self.calc.mechanism, self.calc.given, tuple(changed))
        return None if self._needs_all(changed) or names & self.calc.curves.keys() else sorted(names)

    def _needs_all(self, keys: Iterable[str]) -> bool:
        """Whether steps may be switched on or off: in a machine that was not possible, by what was not given, or by a text."""
        return self.check is None or any(key not in self.calc.inputs or self.texts(key) for key in keys)

    def may_be_given(self, key: str) -> bool:
        """Return whether an input is given, or may be given beside what is: not in place of what else was chosen."""
        rules = self.calc.mechanism.inputs.one_of
        return key in self.calc.inputs or not any(key in group for rule in rules for group in rule.groups)

    def texts(self, key: str) -> tuple[str, ...]:
        """Return the texts that an input may have; none for a number."""
        known = world(self.calc.mechanism.inputs).keys.get(key)
        return () if known is None or isinstance(known.meta, Quantity) else tuple(known.texts)

    def places(self, key: str) -> list[VariedNumber]:
        """Return the numbers of an input: one, or one for each part of a list that has it; only that of the part that is judged."""
        meta, value = self.calc.meta.get(key), self.calc.inputs.get(key)
        if not isinstance(meta, Quantity) or not isinstance(value, np.ndarray | tuple | None):
            return []
        only = self.check.index if self.check else None
        meta, home = _possible(self.calc, key, meta), list_inputs(self.calc.mechanism.inputs).get(key)
        if home is None:
            present = None if value is None else float(np.ravel(value)[0])
            found = [VariedNumber(key, meta, None, present, key)]
        else:
            found = [
                VariedNumber(key, meta, i, float(part), f"{home}.{i}.{key.removeprefix(f'{home}.')}")
                for i, part in enumerate(parts_of(value))
                if isinstance(part, int | float | np.number) and only in (None, i)
            ]
        return [each for each in found if each.path not in self.kept]

    def with_text(self, key: str, text: str | bool) -> Array:
        """Return whether checks hold with a text, by level, shape (LEVELS, 1)."""
        found = self.hold({key: text}, 1)
        return np.zeros((LEVELS, 1), dtype=bool) if found is None else found

    def with_numbers(self, places: Sequence[VariedNumber], values: Array) -> Array:
        """Return whether checks hold with each row of values, shape (machines, places), by level: shape (LEVELS, machines)."""
        whole = [place.meta.integer for place in places]
        values = np.where(whole, np.rint(values), values)
        found = np.zeros((LEVELS, len(values)), dtype=bool)
        allowed = np.logical_and.reduce([place.meta.holds(values[:, i]) for i, place in enumerate(places)])
        if allowed.any():
            found[:, allowed] = self._with_numbers(places, values[allowed])
        return found

    def _with_numbers(self, places: Sequence[VariedNumber], values: Array) -> Array:
        found = self.hold(self.changed(places, values), len(values))
        if found is not None:
            return found
        if len(values) <= SMALLEST_BATCH:
            return np.zeros((LEVELS, len(values)), dtype=bool)
        return np.hstack([self._with_numbers(places, half) for half in np.array_split(values, 2)])

    def changed(self, places: Sequence[VariedNumber], values: Array) -> dict[str, Any]:
        """Return the inputs of machines with other values, shape (machines, places)."""
        found: dict[str, Any] = {}
        for column, place in enumerate(places):
            if place.part is None:
                found[place.key] = values[:, column]
                continue
            known = self.calc.inputs[place.key]  # of parts each a number, or None where a part does not have it
            row = found.get(place.key) or (tuple(known[0].tolist()) if isinstance(known, np.ndarray) else tuple(known))
            found[place.key] = (*row[: place.part], values[:, column], *row[place.part + 1 :])
        return found
