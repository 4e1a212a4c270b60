"""Checks whose verdict is the same for every machine that was tried: can they fail, or hold, at all?"""

from __future__ import annotations

import time
from collections.abc import Iterator

import numpy as np

from diecut_report.contract.inputs import Quantity, fields
from diecut_report.engine import calculate
from diecut_report.engine.steps.extreme_checks import is_made
from diecut_report.expressions import Array
from diecut_report.languages.phrases import Phrase
from diecut_report.results.checks import checks_of, is_sized, judged
from diecut_report.results.unchecked import is_of_machine
from diecut_report.testing.many_machines import MachineCase

FAR = 1.0  # powers of ten by which a number is made greater or less
AT_ONCE, LONGEST = 40, 10.0  # machines calculated together; seconds after which no more are tried


def constant(machine: MachineCase, count: int, seed: int) -> Iterator[tuple[str, str]]:
    """Yield each check whose verdict never changes over about so many machines, each with one number, or all, far from the example's."""
    found: dict[str, set[bool]] = {}
    began, tried = time.process_time(), 0
    for number in range(-(-count // AT_ONCE)):
        for id, held in _verdicts(machine, AT_ONCE, seed + number):
            found.setdefault(id, set()).update(held)
        tried += AT_ONCE
        if time.process_time() - began > LONGEST or all(len(held) == 2 for held in found.values()):
            break
    yield from ((id, _told(held.pop(), tried)) for id, held in found.items() if len(held) == 1)


def _verdicts(machine: MachineCase, count: int, seed: int) -> Iterator[tuple[str, set[bool]]]:
    """Each check of the machine with the verdicts that occur; impossible machines have none."""
    calc = calculate(machine.mechanism, {**machine.values, **_varied(machine, count, seed)}, count)
    possible = np.array([i not in calc.flaws for i in range(count)])
    for check in checks_of(calc):
        is_free = not (
            check.presumed or is_sized(calc.given, check)
        )  # the others hold by what the program chose or presumes
        if is_free and is_of_machine(check) and is_made(calc, check):
            judgement = judged(calc, check)
            rows = judgement.governing(judgement.there) & possible
            yield check.id, set(judgement.governing(judgement.held)[rows].tolist())


def _told(holds: bool, count: int) -> Phrase:
    words = (
        "holds in all of {n} machines far from the example; make sure that it can fail"
        if holds
        else "fails in all of {n} machines far from the example; make sure that it can hold"
    )
    return Phrase(words, n=count)


def _varied(machine: MachineCase, count: int, seed: int) -> dict[str, Array]:
    """The numbers of all machines: each has one, or all, far from the example's, as far as that is allowed."""
    draw, known = np.random.default_rng(seed), dict(fields(machine.mechanism.inputs))
    numbers = [
        name for name, value in machine.values.items() if isinstance(value, int | float) and not isinstance(value, bool)
    ]
    metas = {name: known.get(name) for name in numbers}
    names = [name for name, meta in metas.items() if isinstance(meta, Quantity) and name != "n_points"]
    chosen = draw.integers(0, len(names) + 1, count)
    found = {}
    for number, name in enumerate(names):
        meta, value = metas[name], machine.values[name]
        assert isinstance(meta, Quantity)
        far = value * 10 ** draw.uniform(-FAR, FAR, count)
        far = np.round(far) if meta.integer else far
        is_far = ((chosen == number) | (chosen == len(names))) & meta.holds(far)
        found[name] = np.where(is_far, far, value)
    return found
