"""All mechanisms of a config calculated for many variants at once: the same way through the graph, with arrays for numbers."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import chain
from typing import Any

import numpy as np

from diecut_report.config.instances import Instance, Node, Target
from diecut_report.config.loader import Config
from diecut_report.config.plugins import said
from diecut_report.config.validation import declared, validate
from diecut_report.config.yaml import KeyPath, key_of
from diecut_report.errors import PluginError, Problem
from diecut_report.formulas import Array
from diecut_report.formulas.condition_parts import WITHOUT_VALUE
from diecut_report.machine.calculation import (
    Calculation,
    CurveHandle,
    Impossible,
    ImpossibleTogether,
    TakenOfMachines,
    Unproven,
    of_rows,
)
from diecut_report.machine.mechanism import PhaseHandle
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.curve_inputs import InOtherUnit
from diecut_report.mechanism.inputs import Block, Extremes, Quantity, flatten
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.names import SI
from diecut_report.mechanism.steps import PREFIX
from diecut_report.quantities.plausible import without_rounding
from diecut_report.results.coherence import note_findings, placed_findings
from diecut_report.results.open_items import doubtful, open_values, unrated_forces, varied_open
from diecut_report.results.origins import Absent, number, output, require_facts
from diecut_report.results.press_run import Run, Tell
from diecut_report.results.usual import note_usual, outside
from diecut_report.study.definition.base_inputs import Input, with_values
from diecut_report.text.phrases import Phrase, phrase
from diecut_report.time_limit import contained

Values = Mapping[Input, Array | str]
MOSTLY = 0.8  # of the variants: where more of them differ, all are calculated


class NotOnArrays(Exception):
    """Report a plugin that cannot calculate these variants together, or breaks; its kind and what went wrong."""

    def __init__(self, kind: str, message: str) -> None:
        super().__init__(kind, message)
        self.kind, self.message = kind, message

    def __str__(self) -> str:
        return f"plugin {self.kind!r}: {self.message}"


class Mixed(Exception):
    """Report variants that are calculated in another way than the rest, as they lack something that the rest have: a mask of them."""

    def __init__(self, rows: Array) -> None:
        super().__init__(rows)
        self.rows = rows


@contextmanager
def of_plugin(kind: str) -> Iterator[None]:
    """Report what breaks within as a fault of the plugin, whose code runs there."""
    try:
        with contained():
            yield
    except (Impossible, NotOnArrays, Unproven):
        raise
    except PluginError as cause:
        raise NotOnArrays(kind, cause.message) from cause
    except Exception as cause:
        raise NotOnArrays(kind, said(cause)) from cause


@dataclass
class CalculatedVariants:
    """Hold what was calculated of a number of variants; ``reasons`` has a text for each that cannot exist.

    ``is_open`` says that they rest on assumed or default values, make forces that no part takes, or have parts, whose rating is not judged here.
    """

    count: int
    calculations: dict[str, Calculation]
    reasons: dict[int, str] = field(default_factory=dict)
    is_open: Array | bool = False

    def release(self) -> None:
        """Free the memory of the curves at once, and not when garbage is collected."""
        for calculation in self.calculations.values():
            calculation.release()


def untold(_name: str) -> None:
    """Tell nobody which mechanism comes next."""


def calculated(base: Config, values: Values, count: int, tell: Tell = untold) -> CalculatedVariants:
    """Calculate all mechanisms of the base for so many variants: numbers as arrays of shape (count,), SI; texts the same for all.

    ``tell`` is called with the name of each mechanism before it is calculated; what it raises ends the calculation.

    Raises ``NotOnArrays`` where a plugin cannot take arrays, ``Mixed`` where not all variants are calculated in the same way.
    """
    data = {asked: SI(given, asked.unit, asked.path) if asked.unit else given for asked, given in values.items()}
    config, problems = with_values(base, data)
    variants = CalculatedVariants(count, {})
    if problems:
        variants.reasons = dict.fromkeys(range(count), _reason_text(problems[0]))
    else:
        made = _Rows(config, variants, tell)
        variants.calculations = made.calculations
        has_parts = config.parts is not None
        is_open = has_parts or any(True for _ in chain(doubtful(made), unrated_forces(made), open_values(made)))
        variants.is_open = np.ones(count, dtype=bool) if is_open else varied_open(made, count)
    return variants


class _Rows(Run):
    """One way through the graph for many variants; what is wrong with one of them is kept as its reason."""

    _number = staticmethod(np.asarray)

    def __init__(self, config: Config, variants: CalculatedVariants, tell: Tell) -> None:
        self.variants = variants
        self.alike: dict[int, Array] = {}  # for each calculation by its id which variants are the same there
        super().__init__(config, tell)
        self._all_wrong(self.problems)

    def _broke(self, instance: Instance, cause: BaseException, words: str = "") -> None:
        """Leave no mechanism of a variant out in silence."""
        raise NotOnArrays(self.config.kinds[instance.name], words or said(cause)) from cause

    def _output(self, calculation: Calculation, name: str, target: Target) -> Any:
        """Return a result of all variants; where it is absent that is the variant's reason."""
        if target.is_mechanism or calculation.axis.get(name) in calculation.domains:
            return output(calculation, name, target)
        require_facts(calculation, name, target)
        if target.phase_unit:
            return self._phase(calculation, name, target)
        column = number(calculation, name)
        if column is None:
            raise Absent(phrase("does not exist for these variants."))
        if column.dtype == object:
            if self.variants.count == 1:
                return column[0]
            raise NotOnArrays(calculation.mechanism.kind, Phrase("its text {name} is referred to", name=name))
        return SI(without_rounding(column.astype(float), str(target.unit)), str(target.unit), target.path)

    def _phase(self, calculation: Calculation, name: str, target: Target) -> PhaseHandle:
        """Return a phase of all variants; where it is absent that is the variant's reason."""
        handle = PhaseHandle(calculation, name.removeprefix(PREFIX), f"${{{target.path}}}")
        without = [row for row in range(self.variants.count) if not handle.intervals(row)]
        self._reason(without, Phrase("${{path}} does not apply to this machine.", path=target.path))
        return handle

    def _with_values(self, instance: Instance, own: dict[Node, Target]) -> dict[str, Any]:
        """Return the block's data without what partners do not have; Mixed where some of the variants alone lack it."""
        data = super()._with_values(instance, own)
        for key in instance.derived & data.keys():
            value = data[key].value if isinstance(data[key], SI) else None
            if isinstance(value, np.ndarray) and value.ndim:
                self._require_alike(np.isnan(value))
                if np.isnan(value).all():
                    del data[key]
        return data

    def _require_alike(self, rows: Array) -> None:
        """Raise Mixed where some of the variants that can exist are among the rows, and some are not."""
        known = np.ones(self.variants.count, dtype=bool)
        known[list(self.variants.reasons)] = False
        if (rows & known).any() and (~rows & known).any():
            raise Mixed(rows)

    def _validated(self, name: str, instance: Instance, data: dict[str, Any]) -> bool:
        """Judge the columns by the bounds of their keys; the block then holds arrays that are sound."""
        sound = _filled(data, lambda key, value: self._sound(instance, key, value))
        with of_plugin(self.config.kinds.get(name, name)):
            block, problems = validate(instance.model, sound, instance.place)
        self._all_wrong(problems)
        if block is not None:
            self.blocks[name] = block
        return block is not None

    def _all_wrong(self, problems: list[Problem]) -> None:
        for problem in problems[:1]:
            self._reason(range(self.variants.count), _reason_text(problem))

    def _sound(self, instance: Instance, key: KeyPath, value: SI) -> Any:
        """Return a column without the values that its key refuses: these variants get a reason, and the value of another one."""
        meta = declared(instance.model, key)
        if not isinstance(value.value, np.ndarray):
            return value
        if value.value.ndim == 0:
            return SI(value.value[()], value.unit, value.told)
        if not isinstance(meta, Quantity):  # one value of a curve given as a list
            if value.value.size > 1:
                message = Phrase("a curve given as a list refers to {told}, which varies", told=value.told)
                raise NotOnArrays(self.config.kinds[instance.name], message)
            return SI(value.value.item(), value.unit, value.told)
        meta = meta.of_unit(value.unit)
        column = np.broadcast_to(value.value, (self.variants.count,)).astype(float)
        bad = np.flatnonzero(~meta.holds(column, calculated=True))
        for row in bad:
            self._refused(instance, key, meta, SI(float(column[row]), value.unit, value.told), int(row))
        good = np.setdiff1d(np.arange(len(column)), [*bad, *self.variants.reasons])
        column[bad] = column[good[0]] if len(good) else np.nan
        return SI(column, value.unit, value.told)

    def _refused(self, instance: Instance, key: KeyPath, meta: Quantity, value: SI, row: int) -> None:
        words = "has no value"
        if np.isnan(value.value) and "${" in value.told:  # an expression gives none
            words = Phrase("“{told}” has no value: {without_value}", told=value.told, without_value=WITHOUT_VALUE)
        elif not np.isnan(value.value):
            try:
                words = str(meta.validate(value))
            except ValueError as fault:
                words = str(fault)
        self._reason([row], _reason_text(instance.place.problem(key, words)))

    def _refuse(self, problem: Callable[[int], Problem], wrong: Array) -> None:
        for row in np.flatnonzero(np.broadcast_to(wrong, (self.variants.count,))):
            self._reason([row], _reason_text(problem(int(row))))

    def _reason(self, rows: Any, words: str) -> None:
        for row in rows:
            self.variants.reasons.setdefault(int(row), words)

    def _calculate(self, name: str, instance: Instance, block: Any) -> None:
        assert instance.mechanism is not None
        beside = self.beside(instance)
        self._slips(instance, outside(instance, flatten(block), beside))
        if len(self.variants.reasons) == self.variants.count:
            return
        self.tell(name)
        try:
            with of_plugin(instance.mechanism.kind):
                found = self._each_once(instance.mechanism, flatten(block))
        except ImpossibleTogether as fault:
            words = Phrase("it refuses some of many: {reasons}", reasons=fault.reasons[0][1])
            raise NotOnArrays(instance.mechanism.kind, words) from fault
        except (Impossible, Unproven) as fault:
            # a single variant that cannot exist
            key, message = fault.reasons[0] if isinstance(fault, Impossible) else ("", str(fault))
            self._reason(range(self.variants.count), _flaw_text(instance, key, message))
            return
        found.unfounded = self.bases.unfounded(instance, block)
        self.calculations[name] = found
        self._slips(instance, note_usual(found, instance, block, beside))
        note_findings(found, placed_findings(self.config.parts, instance.mechanism.kind))
        for row, (key, message) in found.flaws.items():
            self._reason([row], _flaw_text(instance, key, message))
        for missed in found.withheld.values():
            self._require_alike(missed)

    def _each_once(self, mechanism: Mechanism, inputs: dict[str, Any]) -> Calculation:
        """Calculate a mechanism; of variants that have the same inputs, as another mechanism is varied, one for all."""
        count = self.variants.count
        _, first, alike = np.unique(self._alike(inputs), return_index=True, return_inverse=True)
        if len(first) > MOSTLY * count:
            found = calculate(mechanism, inputs, count)
        else:
            if len(first) == 1:  # plain code is asked for a single machine in another way
                first = first.repeat(2)
            own = {name: of_rows(value, first, count) for name, value in inputs.items()}
            found = calculate(mechanism, own, len(first)).of_rows(alike)
        self.alike[id(found)] = alike
        return found

    def _alike(self, inputs: Mapping[str, Any]) -> Array:
        """A number for each variant, which those with the same inputs have in common."""
        found = np.zeros(self.variants.count, dtype=int)
        for column in self._columns(tuple(inputs.values())):
            own = np.unique(column, return_inverse=True)[1].reshape(-1)
            found = np.unique(found * (own.max() + 1) + own, return_inverse=True)[1]
        return found

    def _columns(self, value: Any) -> Iterator[Array]:
        """What differs between variants of an input, shape (variants,) each."""
        every = np.arange(self.variants.count)
        match value:
            case tuple():
                for each in value:
                    yield from self._columns(each)
            case np.ndarray() if value.size > 1:
                yield value.reshape(-1)
            case Extremes(low=low, high=high):
                yield from self._columns((low, high))
            case InOtherUnit(value=own):
                yield from self._columns(own)
            case CurveHandle(calculation=calc, rows=rows) if calc.count > 1:
                yield self.alike.get(id(calc), every) if rows is None else rows
            case TakenOfMachines(calculation=calc) if calc.count > 1:
                yield self.alike.get(id(calc), every)
            case Block():  # a list within the parts of a list: not looked into
                yield every


def _flaw_text(instance: Instance, path: str, message: str) -> str:
    key = key_of(path) if path else ()
    return _reason_text(instance.place.problem(key, message))


def _reason_text(problem: Problem) -> str:
    return ": ".join(part for part in (problem.path, problem.message) if part)


def _filled(data: Any, sound: Callable[[KeyPath, SI], Any], key: KeyPath = ()) -> Any:
    match data:
        case SI():
            return sound(key, data)
        case dict():
            return {name: _filled(part, sound, (*key, name)) for name, part in data.items()}
        case list():
            return [_filled(part, sound, (*key, index)) for index, part in enumerate(data)]
    return data
