"""Facts that steps stand on: where a machine does not meet one, the steps that need it are left out."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from diecut_report.contract.code_steps import Fact
from diecut_report.contract.result_names import read
from diecut_report.contract.steps import Step
from diecut_report.engine.calculation import Calculation
from diecut_report.engine.steps.soundness import possible
from diecut_report.expressions import Array


def judge(calc: Calculation, step: Fact) -> None:
    """Note which variants do not meet a fact; where none does, the steps that need it take no part.

    Where some do, the numbers of the others mean nothing: these variants are to be calculated by themselves.
    """
    missed: Array = calc.apply(step.condition)[:, 0] == 0
    if not missed.any():
        return
    calc.withheld[step.id] = missed
    if missed[possible(calc)].all():
        calc.given -= {step.id}
        known = dict(calc.curves)  # those of named parts too, which are not declared one by one
        calc.steps = known | {each.id: each for _, each in calc.mechanism.active(calc.given)}
        calc.axis = {name: calc.axis[name] for name in known} | calc.mechanism.axes(calc.given)


def remaining(calc: Calculation, steps: Sequence[Step]) -> list[Step]:
    """Return those of the coming steps that take part still."""
    return [step for step in steps if step.id in calc.steps]


def without(calc: Calculation, name: str) -> tuple[Array, str]:
    """Return which variants do not have a result for want of a fact, and why in words."""
    for step, missed, words in _withheld(calc):
        if read(name, step):
            return missed, words
    return np.zeros(calc.count, dtype=bool), ""


def unmet(calc: Calculation, needs: Iterable[str]) -> str:
    """Return what is said of a fact among these needs that the machine does not meet; empty where it meets all."""
    facts = [step for _, step in calc.mechanism.steps if isinstance(step, Fact)]
    return next((step.words for step in facts if step.id in needs and step.id in calc.withheld), "")


def _withheld(calc: Calculation) -> Iterator[tuple[Step, Array, str]]:
    """The steps that need a fact which some variants do not meet, which these are, and what is said of it."""
    for chapter, step in calc.mechanism.steps if calc.withheld else ():
        facts = {*chapter.needs, *step.needs} & calc.withheld.keys()
        if facts:
            yield step, np.any([calc.withheld[each] for each in facts], axis=0), unmet(calc, facts)
