"""The contract test for a mechanism plugin: ``check_mechanism(MECHANISM)`` raises AssertionError with all that is wrong.

It goes through every declared formula with the units of what it takes and refuses where dimensions do not balance (the angle is one), in
each of the units that a mechanism may have, computes every printed expression against the function it was read from, and looks for
ids that nothing gives.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import chain, combinations
from typing import cast

import numpy as np

from diecut_report.contract.chapters import Chapter
from diecut_report.contract.inputs import Block, Inputs, Quantity, Text, fields, meta_of, nested
from diecut_report.contract.mechanism import Mechanism, axes
from diecut_report.contract.sections import taken
from diecut_report.contract.steps import SILENT, Step
from diecut_report.contract.unit_variants import form_keys, in_form, in_unit
from diecut_report.expressions import evaluate
from diecut_report.testing.dimensions import check_units, curve_units, dimensions, formulas, relations, units_of


def check_mechanism(mechanism: Mechanism) -> None:
    """Raise AssertionError, listing every flaw of a mechanism's declaration."""
    problems = list(chain(ids(mechanism), unit_keys(mechanism), spectra(mechanism))) or [
        problem for form in forms(mechanism) for problem in list(unmade(form)) or quantities(form)
    ]
    assert not problems, f"{mechanism.kind}:\n" + "\n".join(problems)


def quantities(mechanism: Mechanism) -> Iterator[str]:
    """What is wrong with the numbers of a mechanism in one of its forms."""
    of_steps = chain(dimensions(mechanism), curve_units(mechanism), relations(mechanism), printing(mechanism))
    return chain(of_steps, check_units(mechanism))


def forms(mechanism: Mechanism) -> Iterator[Mechanism]:
    """The mechanism in all units that it may have, each with the steps that are made then."""
    keys = form_keys(mechanism.inputs).union(*([key for key, _ in step.units] for _, step in mechanism.steps))
    for count in range(len(keys) + 1):
        for given in map(frozenset, combinations(sorted(keys), count)):
            absent = (keys - given) | _excluded(mechanism.inputs, given)
            chapters = tuple(replace(c, steps=_in_form(c, given, absent)) for c in mechanism.chapters)
            yield replace(mechanism, inputs=cast(type[Inputs], in_form(mechanism.inputs, given)), chapters=chapters)


def _excluded(model: type[Block], given: frozenset[str]) -> frozenset[str]:
    """The keys that stand for what is given by other ones."""
    rules = [rule.groups for rule in model.one_of if any(given.intersection(group) for group in rule.groups)]
    return frozenset(key for groups in rules for group in groups if given.isdisjoint(group) for key in group)


def _in_form(chapter: Chapter, given: frozenset[str], absent: frozenset[str]) -> tuple[Step, ...]:
    """The steps of a chapter that may be made with some of the keys on which units depend, in their units."""
    made = [s for s in chapter.steps if absent.isdisjoint(chapter.needs + s.needs) and given.isdisjoint(s.lacks)]
    return tuple(in_unit(step, given) for step in made)


def ids(mechanism: Mechanism) -> Iterator[str]:
    """Ids that a formula, check or step takes and nothing gives; quantities without symbol or description."""
    known = _known(mechanism)
    yield from unmade(mechanism)
    for check in mechanism.checks:
        for name in (check.demand, check.limit, *check.needs):
            if isinstance(name, str) and name not in known:
                yield f"check {check.id} takes {name}, which nothing gives"
    yield from (f"the key result {name} is no step" for name in mechanism.key_results if name not in known)
    for _, step in mechanism.steps:
        if not isinstance(step, SILENT) and not (step.symbol and step.description):
            yield f"{step.id} has no symbol or no description"


def unmade(mechanism: Mechanism) -> Iterator[str]:
    """Ids that a step takes and nothing gives."""
    known = _known(mechanism)
    for _, step in mechanism.steps:
        yield from (f"{step.id} takes {name}, which nothing gives" for name in sorted(taken(step) - known))


def _known(mechanism: Mechanism) -> set[str]:
    own = {f"{step.id}_{part}" for _, step in mechanism.steps for part in ("at", "count")}
    return own | {*units_of(mechanism), *inputs_of(mechanism.inputs)}


def unit_keys(mechanism: Mechanism) -> Iterator[str]:
    """Units beside a key that is no optional input without a default, by which it could be told; units within a block."""
    optional = {name for name, field in mechanism.inputs.model_fields.items() if _may_be_absent(mechanism.inputs, name)}
    declared = [(name, meta) for name, meta in fields(mechanism.inputs) if not isinstance(meta, Text)]
    for name, told in chain(declared, ((step.id, step) for _, step in mechanism.steps)):
        if told.units and "." in name:
            yield f"{name} has other units within a block, where none hold"
        yield from (f"{name} has units beside {key}, which is no optional input without a default" for key, _ in told.units
                    if key not in optional)  # fmt: skip


def _may_be_absent(model: type[Block], name: str) -> bool:
    field, meta = model.model_fields[name], meta_of(model, name)
    from_press = isinstance(meta, Quantity) and meta.press is not None
    return not field.is_required() and field.default is None and not from_press


def spectra(mechanism: Mechanism) -> Iterator[str]:
    """Curves over a range of their own that have another curve's id, are not as long as their range, or have no symbol."""
    known = set(axes(tuple(step for _, step in mechanism.steps), mechanism.inputs))
    for spectrum in mechanism.spectra:
        for curve in (spectrum, *spectrum.lines()):
            if curve.id in known:
                yield f"{curve.id} of a spectrum is the id of another curve"
            if np.shape(curve.values) != (len(spectrum.values),) or not np.isfinite(curve.values).all():
                yield f"{curve.id} does not have one number for each of {spectrum.id}"
            if not (curve.symbol and curve.description):
                yield f"{curve.id} has no symbol or no description"
            known.add(curve.id)


def inputs_of(model: type[Block], prefix: str = "") -> Iterator[str]:
    """The paths of all inputs and of the blocks that hold them."""
    for name, field in model.model_fields.items():
        yield f"{prefix}{name}"
        block = nested(field.annotation)
        if block:
            yield from inputs_of(block[0], f"{prefix}{name}.")


def printing(mechanism: Mechanism) -> Iterator[str]:
    """Formulas whose printed expression does not compute what the function computes."""
    random = np.random.default_rng(1)
    for step, part, link in formulas(mechanism):
        taken = dict(zip(link.formula.parameters, random.uniform(0.1, 0.9, len(link.formula.parameters)), strict=True))
        values = taken | link.formula.constants
        with np.errstate(all="ignore"):
            printed = evaluate(link.formula.tree, lambda leaf, known=values: known[leaf.args[0]])  # type: ignore[misc]
            computed = link.formula(**taken)
        if not np.allclose(printed, computed, rtol=1e-12, equal_nan=True):
            yield f"{step.id}: the {part} {link.formula.__name__} prints {printed}, computes {computed}"
