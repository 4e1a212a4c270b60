"""The contract test for a mechanism plugin: ``check_mechanism(MECHANISM)`` raises AssertionError with all that is wrong.

It goes through every declared formula with the units of what it takes and refuses where dimensions do not balance (the angle is one), in
each of the units that a mechanism may have, computes every printed expression against the function it was read from, and checks
all that is declared, as loading a plugin does (``diecut_report.declaration``).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import chain, combinations
from typing import cast

import numpy as np

from diecut_report.contract.chapters import Chapter
from diecut_report.contract.inputs import Block, Inputs
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.steps import Step
from diecut_report.contract.unit_variants import form_keys, in_form, in_unit
from diecut_report.declaration import faults
from diecut_report.expressions import evaluate
from diecut_report.formula_checks.dimensions import (
    check_units,
    curve_units,
    dimensions,
    formulas,
    relations,
)
from diecut_report.formula_checks.idle import idle_inputs
from diecut_report.languages.phrases import Phrase


def check_mechanism(mechanism: Mechanism) -> None:
    """Raise AssertionError, listing every flaw of a mechanism's declaration."""
    problems = [str(fault) for fault in faults(mechanism)] or [
        *idle_inputs(mechanism),
        *(problem for form in forms(mechanism) for problem in quantities(form)),
    ]
    assert not problems, f"{mechanism.kind}:\n" + "\n".join(problems)


def quantities(mechanism: Mechanism) -> Iterator[str]:
    """Return what is wrong with the numbers of a mechanism in one of its forms."""
    of_steps = chain(dimensions(mechanism), curve_units(mechanism), relations(mechanism), printing(mechanism))
    return chain(of_steps, check_units(mechanism))


def forms(mechanism: Mechanism) -> Iterator[Mechanism]:
    """Yield the mechanism in all units that it may have, each with the steps that are made then."""
    keys = form_keys(mechanism.inputs).union(*([key for key, _ in step.units] for _, step in mechanism.steps))
    for count in range(len(keys) + 1):
        for given in map(frozenset, combinations(sorted(keys), count)):
            absent = (keys - given) | _excluded(mechanism.inputs, given)
            chapters = tuple(replace(c, steps=_in_form(c, given, absent)) for c in mechanism.chapters)
            checks = tuple(c for c in mechanism.checks if absent.isdisjoint((*c.needs, *c.only_with)))
            inputs = cast(type[Inputs], in_form(mechanism.inputs, given))
            yield replace(mechanism, inputs=inputs, chapters=chapters, checks=checks)


def _excluded(model: type[Block], given: frozenset[str]) -> frozenset[str]:
    """The keys that stand for what is given by other ones."""
    rules = [rule.groups for rule in model.one_of if any(given.intersection(group) for group in rule.groups)]
    return frozenset(key for groups in rules for group in groups if given.isdisjoint(group) for key in group)


def _in_form(chapter: Chapter, given: frozenset[str], absent: frozenset[str]) -> tuple[Step, ...]:
    """The steps of a chapter that may be made with some of the keys on which units depend, in their units."""
    made = [s for s in chapter.steps if absent.isdisjoint(chapter.needs + s.needs) and given.isdisjoint(s.lacks)]
    return tuple(in_unit(step, given) for step in made)


def printing(mechanism: Mechanism) -> Iterator[str]:
    """Yield formulas whose printed expression does not compute what the function computes."""
    random = np.random.default_rng(1)
    for step, part, link in formulas(mechanism):
        taken = dict(zip(link.formula.parameters, random.uniform(0.1, 0.9, len(link.formula.parameters)), strict=True))
        values = taken | link.formula.constants
        with np.errstate(all="ignore"):
            printed = evaluate(link.formula.tree, lambda leaf, known=values: known[leaf.args[0]])  # type: ignore[misc]
            computed = link.formula(**taken)
        if not np.allclose(printed, computed, rtol=1e-12, equal_nan=True):
            yield Phrase(
                "{id}: the {part} {formula} prints {printed}, computes {computed}",
                id=step.id,
                part=part,
                formula=link.formula.__name__,
                printed=printed,
                computed=computed,
            )
