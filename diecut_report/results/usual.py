"""Which values of a machine lie outside their usual range, and which are a slip: ``standards.ranges``, held against numbers.

Typed, referred to or by default, a value is judged where it is a number: before its mechanism is calculated, and again with the
results that a ratio of the table names. What is outside the hard range is refused, unless the file says why it is beyond; what is
outside the usual one makes the check ``usual_values`` of its mechanism warn, which is not there where all is usual.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from diecut_report.config.instances import Instance
from diecut_report.config.model import NUMBERS, PRESS
from diecut_report.config.yaml import KeyPath, dotted
from diecut_report.errors import Problem
from diecut_report.formulas import Array
from diecut_report.formulas.condition_parts import Name, TypedExpression, read_expression
from diecut_report.machine.calculation import Calculation
from diecut_report.mechanism.checks import Check
from diecut_report.mechanism.inputs import Block, Quantity, fields, flatten, keys, list_inputs
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.quantities.formatting import given_shown, with_unit
from diecut_report.quantities.plausible import ROUNDING
from diecut_report.quantities.units import unit
from diecut_report.standards.ranges import UsualRange, ranges_of
from diecut_report.text.phrases import Phrase, joined, phrase

MORE = 1.1  # times a number, by which it is seen whether a ratio is in proportion to it
USUAL = "usual_values"  # the check, and the number that it judges
Inputs = Mapping[str, Any]


class OtherUse(str):
    """Say why a value that the program makes of the parts has another use than its range is of: it is not unusual."""

    __slots__ = ()


class Beside(NamedTuple):
    """Hold what is known beside a mechanism's inputs: the numbers of the press, and why values are beyond their hard range."""

    press: Mapping[str, Any]
    reasons: Mapping[KeyPath, str]


def beside(instance: Instance, press: Inputs, reasons: Mapping[KeyPath, str]) -> Beside:
    """Return what counts beside the inputs of a mechanism: of the numbers of the press only those that its rows name."""
    rows = (row for own in ranges_of(_kind(instance)).values() for row in own)
    named = " ".join(row.of for row in rows)
    return Beside({name: value for name, value in press.items() if f"${{{name}}}" in named}, reasons)


def _kind(instance: Instance) -> str:
    return instance.mechanism.kind if instance.mechanism else PRESS


@dataclass(frozen=True, eq=False)
class Outside:
    """Hold a value outside its usual range: its key, SI values of shape (variants,), which are unusual, and which are a slip.

    ``possible`` says between which values a slip in a ratio may be, with all else as it is.
    """

    key: KeyPath
    row: UsualRange
    values: Array
    unusual: Array
    slips: Array
    reason: str
    possible: Phrase | None = None

    def given(self, variant: int) -> Phrase:
        """Return what was given: the key's value, or what it makes with others."""
        value = given_shown(float(self.values[min(variant, len(self.values) - 1)]), self.row.unit)
        named = self.row.of.replace("${", "").replace("}", "") or ".".join(map(str, self.key))
        return Phrase("{name} = {value}", name=named, value=with_unit(*value.values()))

    @property
    def ranges(self) -> Phrase:
        """Return both ranges with their source."""
        usual, hard, source = _ends(self.row.usual, self.row.unit), _ends(self.row.hard, self.row.unit), self.row.source
        return Phrase("usual: {usual}, possible: {hard}, by {source}", usual=usual, hard=hard, source=phrase(source))

    def problem(self, instance: Instance, source: str = "", variant: int = 0) -> Problem:
        """Return what is wrong with a slip, at its place in the file; ``source`` is what it refers to."""
        origin = Phrase(" (from {source})", source=source) if source else ""
        template = (
            "gives {given}{origin}, which no machine of this kind has ({ranges}). Correct the value, its unit or the place; if it is "
            "meant, write {value: …, beyond: …} with a reason of at least 20 characters, and it stays a warning.{else_as_it_is}"
        )
        possible = {"key": dotted(self.key), "possible": self.possible}
        alone = Phrase(" With all else as it is, {key} may be {possible}.", possible) if self.possible else ""
        return instance.place.problem(
            self.key, template, given=self.given(variant), origin=origin, ranges=self.ranges, else_as_it_is=alone
        )


def outside(instance: Instance, inputs: Inputs, beside: Beside, results: Inputs | None = None) -> list[Outside]:
    """Return the values of a mechanism (or the press) outside their usual range, of those rows whose quantities are known.

    ``inputs`` and ``results`` hold numbers, or arrays of shape (variants,), SI; tuples of them for the parts of a list.
    """
    judged = (
        _outside(key, row, values, beside.reasons.get(key, ""), _may_be_zero(instance, key))
        for key, row, values in _values(instance, inputs, beside.press, results or {})
    )
    found = (each for each in judged if each.unusual.any())
    known = inputs, beside, results or {}
    return [replace(each, possible=_possible(instance, each, *known)) if each.slips.any() else each for each in found]


def _possible(instance: Instance, found: Outside, inputs: Inputs, beside: Beside, results: Inputs) -> Phrase | None:
    """Between which values of its own a slip in a ratio would be possible; None where it is in no ratio, or in no proportion to one."""
    meta = dict(fields(instance.model)).get(dotted(found.key))
    ends = ends_by_ratio(instance, found.key, found.row, inputs, beside, results, hard=True) if found.row.of else None
    return _ends(ends, meta.unit) if ends and isinstance(meta, Quantity) else None


def unbounded(instance: Instance, inputs: Inputs, beside: Beside, results: Inputs) -> set[KeyPath]:
    """Return the keys whose row bounds nothing, as a result that it names does not exist for this value."""
    return {key for key, _, values in _values(instance, inputs, beside.press, results) if np.isnan(values).any()}


def _may_be_zero(instance: Instance, key: KeyPath) -> bool:
    """Whether a zero only says what holds without the key: it is left out, or typed where zero is its default."""
    slot = instance.by_key.get(key)
    if slot is None or not slot.is_given:
        return True
    declared = keys(instance.model)[slot.name]
    return declared.default == 0 and "${" not in str(slot.value)


def _outside(key: KeyPath, row: UsualRange, values: Array, reason: str, may_be_zero: bool) -> Outside:
    size = np.abs(values)
    there = np.isfinite(size) & ((size > 0) | (not may_be_zero))
    slips = there & ~_within(size, row.hard)
    unusual = there & ~_within(size, row.usual) & (not isinstance(reason, OtherUse))
    return Outside(key, row, values, unusual, slips & (not reason), reason)


def _within(size: Array, ends: tuple[float, float]) -> Array:
    held: Array = (size >= ends[0] * (1 - ROUNDING)) & (size <= ends[1] * (1 + ROUNDING))
    return held


def ends_by_ratio(
    instance: Instance,
    key: KeyPath,
    row: UsualRange,
    inputs: Inputs,
    beside: Beside,
    results: Inputs,
    *,
    hard: bool = False,
) -> tuple[float, float] | None:
    """Return the least and greatest value (SI) of a number with which what a row bounds is usual, or just possible, all else as it is.

    None where that is not known, or what it bounds is not in proportion to the number, such as a slip or a distance between places.
    """
    path = ".".join(step for step in key if isinstance(step, str))
    home = list_inputs(instance.model).get(path, "")
    present = next((given for placed, _, given in _placed(path, home, inputs) if placed == key), None)
    x = numbers_of(present)
    if present is None or x is None or not x[0]:
        return None
    found = [
        float(values[0]) for each in (inputs, with_value(inputs, path, key, MORE * present))
        for placed, own, values in _values(instance, each, beside.press, results) if (placed, own) == (key, row)
    ]  # fmt: skip
    if len(found) != 2 or not found[0] or not abs(found[1] - MORE * found[0]) <= ROUNDING * abs(found[1]):
        return None
    low, high = sorted(float(x[0]) * end / found[0] for end in (row.hard if hard else row.usual))
    return low, high


def with_value(inputs: Inputs, path: str, key: KeyPath, value: Any) -> Inputs:
    """Return inputs with another value at a key, whose ``path`` has no places in lists."""
    index = next((step for step in key if isinstance(step, int)), None)
    if index is None:
        return {**inputs, path: value}
    parts = inputs[path]
    return {**inputs, path: (*parts[:index], value, *parts[index + 1 :])}


def _values(
    instance: Instance, inputs: Inputs, press: Inputs, results: Inputs
) -> Iterator[tuple[KeyPath, UsualRange, Array]]:
    """Yield what each row bounds, as far as it is known: each part of a list by itself."""
    homes = list_inputs(instance.model)
    for path, rows in ranges_of(_kind(instance)).items():
        for key, index, given in _placed(path, homes.get(path, ""), inputs):

            def known(name: str, path: str = path, home: str = homes.get(path, ""), index: int | None = index) -> Any:
                found = press.get(name) if name in NUMBERS else results.get(name, inputs.get(name))
                if isinstance(found, tuple) and index is not None and homes.get(name) == home:
                    return numbers_of(found[index])
                if (
                    index is not None
                    and isinstance(found, np.ndarray)
                    and name in results
                    and np.shape(found)[1:] == (len(inputs[path]),)
                ):
                    return numbers_of(found[:, index])  # a result of each part of the list
                return numbers_of(found)

            for row in rows:
                values = numbers_of(given) if not row.of else _computed(instance, row.of, known)
                if values is not None and numbers_of(given) is not None:
                    yield key, row, np.atleast_1d(values)


def _placed(path: str, home: str, inputs: Inputs) -> Iterator[tuple[KeyPath, int | None, Any]]:
    """Yield an input with its key, of the parts of a list each."""
    if not home:
        yield tuple(path.split(".")), None, inputs.get(path)
        return
    for index, part in enumerate(inputs.get(path) or ()):
        yield (*home.split("."), index, *path.removeprefix(f"{home}.").split(".")), index, part


def numbers_of(given: Any) -> Array | None:
    """Return a number of all variants, shape (variants,); of the parts of a list the greatest; None where it is none or not known."""
    match given:
        case tuple():
            parts = [each for each in map(numbers_of, given) if each is not None]
            return np.max(np.stack(np.broadcast_arrays(*parts)), axis=0) if parts else None
        case np.ndarray() if given.dtype.kind in "fi":
            return given.max(axis=1) if given.ndim > 1 else given
        case float() | int() if not isinstance(given, bool):
            return np.array([float(given)])
    return None


def _computed(instance: Instance, of: str, known: Callable[[str], Array | None]) -> Array | None:
    """What an expression of the table gives; None where something in it is not known."""
    assert instance.mechanism is not None, "the rows of the press bound keys alone"
    expression = _expression(instance.mechanism, of)
    values = {name: known(name[2:-1]) for name in expression.names}
    if any(each is None for each in values.values()):
        return None
    found: Array = np.asarray(expression.value(values.__getitem__))
    return found


@cache
def _expression(mechanism: Mechanism, of: str) -> TypedExpression:
    units = {name: meta.unit for name, meta in NUMBERS.items()} | {step.id: step.unit for _, step in mechanism.steps}
    units |= {path: meta.unit for path, meta in fields(mechanism.inputs) if isinstance(meta, Quantity)}
    return read_expression(of, lambda name: Name(name, "number", unit(units[name[2:-1]]).si))


def _ends(ends: tuple[float, float], display: str) -> Phrase:
    low, high = (given_shown(end, display) for end in ends)
    return Phrase("{low} to {high}", low=low["text"], high=with_unit(*high.values()))


def note_usual(calc: Calculation, instance: Instance, block: Block, beside: Beside) -> list[Outside]:
    """Give a calculation the check of its usual values, where some are outside; return these."""
    found = outside(instance, flatten(block), beside, calc.values)
    if found:
        many = np.sum([np.broadcast_to(each.unusual, (calc.count,)) for each in found], axis=0).astype(float)
        calc.values[USUAL] = np.where(many == 0, np.nan, many)[:, None]
        calc.further_checks = (usual_check([each for each in found if each.unusual[0]]),)
    return found


def usual_check(found: list[Outside]) -> Check:
    """Return the check that warns of values outside their usual range."""
    parts = [
        Phrase("{given} ({ranges})", given=each.given(0), ranges=each.ranges)
        + (Phrase(", beyond because: {reason}", reason=each.reason) if each.reason else "")
        for each in found
    ]
    template = "{values}. Check the values and their units, and say where they come from."
    return Check(USUAL, "practice", phrase("Usual values"), USUAL, 0.0, severity="warn", unit="1",
        demand_label=phrase("values outside their usual range"), limit_label=phrase("allowed"),
        consequence=Phrase(template, values=joined(parts, "; ")))  # fmt: skip
