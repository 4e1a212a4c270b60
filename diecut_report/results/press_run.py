"""Runs the mechanisms of a config in the order of their references."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import product
from typing import Any, TypeVar

import numpy as np
from pydantic import ValidationError

from diecut_report.config import instances
from diecut_report.config.instances import Instance, Node, Target, substituted
from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.config.plugins import said
from diecut_report.config.validation import declared, validate
from diecut_report.config.yaml import key_of
from diecut_report.errors import MAX_COMPARISONS, PluginError, Problem, UserError
from diecut_report.formulas import Array
from diecut_report.formulas.conditions import ConditionError
from diecut_report.machine.calculation import NONE_CHOSEN, Calculation, ChosenUnits, CurveHandle, Impossible, same_curve
from diecut_report.machine.steps.needed import needed
from diecut_report.machine.steps.run import calculate
from diecut_report.mechanism.chapters import in_form, taken
from diecut_report.mechanism.curve_inputs import CurveInput, InOtherUnit
from diecut_report.mechanism.inputs import Block, Quantity, flatten, meta_of, texts_given
from diecut_report.mechanism.mechanism import Comparison, Mechanism
from diecut_report.mechanism.names import SI, Text
from diecut_report.mechanism.steps import Clash, Require
from diecut_report.quantities.plausible import without_rounding
from diecut_report.quantities.units import unit
from diecut_report.results.advice import advice_text, possible_ways
from diecut_report.results.checks import holds
from diecut_report.results.coherence import TAKEN, Machine, disagreements, note_findings, placed_findings
from diecut_report.results.mechanism import SelfTestFailed, mechanism_results
from diecut_report.results.mechanism_record import CheckRecord, MechanismRecord, SourceRecord
from diecut_report.results.origins import (
    Absent,
    Bases,
    Provenance,
    Withheld,
    input_path,
    origin_of,
    output,
)
from diecut_report.results.usual import Beside, Outside, beside, note_usual, outside
from diecut_report.text.phrases import Phrase, named, phrase
from diecut_report.time_limit import contained, in_time

# Comparisons over the results of named kinds, calculated when all mechanisms are known.


Data = dict[str, Any]


class Uncomparable(ValueError):
    """A result or an input of an instance that a comparison cannot be made with, in words."""

    def __init__(self, words: str, instance: str, name: str) -> None:
        super().__init__(words)
        self.instance, self.name = instance, name


@dataclass(frozen=True)
class Found:
    """Hold a comparison with the instances that it is between, by their kinds."""

    comparison: Comparison
    between: Mapping[str, str]

    @property
    def name(self) -> str:
        """Return what the results know it by: its kind and the instances."""
        return "-".join([self.comparison.mechanism.kind, *self.between.values()])


def found(calculations: Mapping[str, Calculation]) -> Iterator[Found]:
    """Yield the comparisons that the calculated mechanisms declare, for each choice of one instance of each kind."""
    by_kind: dict[str, list[str]] = {}
    for name, calc in calculations.items():
        by_kind.setdefault(calc.mechanism.kind, []).append(name)
    declared = {c.mechanism.kind: c for calc in calculations.values() for c in calc.mechanism.comparisons}
    for comparison in declared.values():
        for names in product(*(by_kind.get(kind, []) for kind in comparison.kinds)):
            yield Found(comparison, dict(zip(comparison.kinds, names, strict=True)))


def compared(
    case: Found, calculations: Mapping[str, Calculation], chosen: ChosenUnits = NONE_CHOSEN
) -> MechanismRecord:
    """Return the results of a comparison, in the form of a mechanism's, shown in the chosen units, and between which instances it is."""
    values, origins = {}, {}
    for key, (kind, name) in case.comparison.takes.items():
        instance = case.between[kind]
        value = _taken(calculations[instance], name)
        if value is not None:
            values[key], origins[key] = value, Provenance("reference", f"{instance}.{name}")
    block = _block(case, values)
    calculation = calculate(case.comparison.mechanism, flatten(block))
    calculation.chosen_units = chosen
    return mechanism_results(calculation, origins).with_(between=list(case.between.values()))


def _block(case: Found, values: Mapping[str, Any]) -> Block:
    """Return the validated inputs; Uncomparable in words where a result is none that they may have."""
    try:
        return in_form(case.comparison.mechanism.inputs, values).model_validate(values)
    except ValidationError as error:
        fault = error.errors(include_url=False)[0]
        key = str(fault["loc"][0])
        meta, value = meta_of(case.comparison.mechanism.inputs, key), values.get(key)
        if not (
            isinstance(meta, Quantity) and isinstance(value, SI) and unit(value.unit).kind == meta.parsed_unit.kind
        ):
            raise  # a fault of what is declared
        kind, name = case.comparison.takes[key]
        instance, told = case.between[kind], fault["msg"].removeprefix("Value error, ")
        template = "The comparison {name} takes {output}: {fault}."
        raise Uncomparable(
            Phrase(template, name=case.name, output=f"{instance}.{name}", fault=told), instance, name
        ) from error


def _taken(calc: Calculation, name: str) -> Any:
    """A number with its SI unit, a text, a curve; None where there is none."""
    if calc.axis.get(name) in calc.domains:
        return calc.handle(name)
    values = calc.values.get(name, calc.inputs.get(name))
    if not isinstance(values, np.ndarray):
        return values
    value = values[0, 0]
    if isinstance(value, str):
        return value
    si = unit(calc.step_or_input(name).unit).si
    return None if np.isnan(value) else SI(float(without_rounding(value, si)), si, name)


def same_inputs(one: Any, other: Any) -> bool:
    """Return whether two inputs are the same to the last bit: zero is not the same as minus zero, nor 1 as 1.0 or true."""
    if type(one) is not type(other):
        return False
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(same_inputs(part, other[key]) for key, part in one.items())
    if isinstance(one, tuple | list):
        return len(one) == len(other) and all(map(same_inputs, one, other))
    if isinstance(one, CurveHandle):
        return same_curve(one, other)
    if isinstance(one, SI):
        return all(same_inputs(getattr(one, part), getattr(other, part)) for part in ("value", "unit", "told"))
    if isinstance(one, float):
        return one == other and math.copysign(1, one) == math.copysign(1, other)
    return one is other or bool(one == other)


Tell = Callable[[str], None]
R = TypeVar("R", bound="Run")


def compute(config: Config, tell: Tell) -> Run:
    """Calculate all mechanisms of a config; UserError where a machine is impossible. What broke is in ``errors``.

    ``tell`` is called with the name of each mechanism before it is calculated.
    """
    return require_possible(ReportedRun(config, tell))


def require_possible(run: R) -> R:
    """Return a run; UserError with all that is wrong where its machine is impossible."""
    if run.problems:
        broken = (Problem(str(error), run.config.tree.file) for error in run.errors.values())
        raise UserError([*run.problems, *broken])
    return run


class Run:
    """Go one way through the config's graph: every value that is referred to, every calculation."""

    def __init__(self, config: Config, tell: Tell) -> None:
        self.config, self.tell = config, tell
        self.values: dict[Node, Any] = {}
        self.blocks: dict[str, Block] = {}
        self.calculations: dict[str, Calculation] = {}
        self.results: dict[str, MechanismRecord] = {}
        self.errors: dict[str, PluginError] = dict(config.broken)
        self.self_tests: dict[str, list[CheckRecord]] = {}  # of what contradicts itself, what does not hold
        self.skipped: dict[str, str] = {}
        self.withheld: dict[Node, str] = {}  # values that are not calculated, and why
        self.slipped: set[Node] = set()  # inputs outside the range of all machines
        self.problems: list[Problem] = []
        self.comparisons: dict[str, MechanismRecord] = {}
        self.cases: list[Found] = []
        self.left_out: list[str] = []
        for node in config.order:
            if len(node) == 1:
                self._mechanism(str(node[0]))
            elif node in config.links:
                self._value(node, config.links[node])
        self._agree()
        self._comparisons()

    def _agree(self) -> None:
        """Hold the mechanisms against each other."""
        for each in disagreements(Machine(self.config.instances, self.blocks, self.calculations, self.config.links)):
            self._refuse(each.problem, each.wrong)

    def _comparisons(self) -> None:
        """Compare mechanisms, where their comparisons are asked for."""

    def _value(self, node: Node, target: Target) -> None:
        instance = self.config.instances[str(node[0])]
        assert instance is not None, "a mechanism without a plugin has no links"
        try:
            values = [self._term(single) for single in target.single]
            value = self._computed(target, values) if target.expression else values[0]
            self.values[node] = self._derived(instance, node, target, value) if target.formula else value
        except (Absent, Withheld) as fault:  # what needs it is skipped; what holds it against others does without
            if node[1] in instance.derived:  # a partner does not have it: what needs it is not checked
                self.values[node] = None
            elif isinstance(fault, Absent):
                self.problems.append(instance.place.problem(node[1:], str(fault)))
            elif words := str(fault):
                self.withheld[node] = words

    def _term(self, target: Target) -> Any:
        try:
            return self._referred(target)
        except Absent as absent:
            raise Absent(Phrase("{path} {absent}", path=target.told, absent=absent)) from None

    def _computed(self, target: Target, values: list[SI]) -> SI:
        """What an expression gives; Absent in words where that is nothing."""
        expression = target.expression
        assert expression is not None
        known = {name: given.value for name, given in zip(expression.names, values, strict=True)}
        try:
            return SI(expression.known_value(known), str(target.unit), expression.text)
        except ConditionError as fault:
            raise Absent(fault.words) from None

    def _derived(self, instance: Instance, node: Node, target: Target, value: SI) -> SI:
        """A default of the press that is not the press's field itself."""
        meta = declared(instance.model, node[1:])
        assert isinstance(meta, Quantity) and target.formula is not None
        try:
            with contained():
                return SI(self._number(target.formula(value.value)), meta.parsed_unit.si, target.path)
        except Exception as cause:
            self._broke(instance, cause)
            raise Withheld from cause

    def _referred(self, target: Target) -> Any:
        if target.result is not None or target.is_broken:
            if target.instance not in self.calculations:
                raise Withheld
            return self._output(self.calculations[target.instance], str(target.result), target)
        node = (target.instance, *target.key)
        if node in self.config.links and node not in self.values:
            raise Withheld
        instance = self.config.instances[target.instance]
        assert instance is not None, "a broken mechanism's links are marked as broken"
        return self._input(instance, target, self.values.get(node))

    _number: Callable[[Any], Any] = staticmethod(float)

    def _output(self, calculation: Calculation, name: str, target: Target) -> Any:
        return output(calculation, name, target)

    def _input(self, instance: Instance, target: Target, followed: Any) -> Any:
        value = instance.value(target.key) if followed is None else followed
        value = value.value if isinstance(value, InOtherUnit) else value
        if isinstance(value, SI):
            value = value.value
        if isinstance(value, tuple):
            return [SI(part, str(target.unit), target.path) for part in value]
        if value is None:
            raise Absent(phrase("is not given there."))
        return value if target.unit is None or target.is_curve else SI(value, target.unit, target.path)

    # --- mechanisms --------------------------------------------------------------------------------------------------

    def _mechanism(self, name: str) -> None:
        instance, own = self.config.instances[name], self.config.links_of.get(name, {})
        if instance is None or name in self.errors:
            return
        asked = (target for node, target in own.items() if node[1] not in instance.derived)
        lost = self.errors.keys() | self.skipped.keys()
        unusable = [each.instance for target in asked for each in target.single if each.instance in lost]
        missing = [node for node in own if node not in self.values]
        if instance.mechanism is None:
            self._press(instance, {node: own[node] for node in own if node not in missing}, missing)
            return
        if unusable or missing:
            self.skipped[name] = self._why_skipped(unusable, missing)
        elif self._validated(name, instance, self._with_values(instance, own)):
            self._calculate(name, instance, self.blocks[name])

    def _why_skipped(self, unusable: list[str], missing: list[Node]) -> str:
        told = next((self.withheld[node] for node in missing if node in self.withheld), "")
        if told:
            return Phrase("It refers to {result}.", result=told)
        if not unusable:
            return phrase("It refers to what is not there, which gives no results.")
        return Phrase("It refers to {names}, which gives no results.", names=named(sorted(set(unusable)), " and "))

    def _press(self, instance: Instance, own: dict[Node, Target], missing: list[Node]) -> None:
        """The press, without the fields that a broken mechanism would have given."""
        data = self._with_values(instance, own)
        for _, *home, last in missing:
            part: Any = data
            for key in home:
                part = part[key]
            del part[last]
        if self._validated(PRESS, instance, {"name": "?"} | data):
            self._slips(instance, outside(instance, flatten(self.blocks[PRESS]), self.beside(instance)))

    def _with_values(self, instance: Instance, own: dict[Node, Target]) -> Data:
        data = substituted(instance, own, lambda node, _: self.values[node])
        lost = {key for key in instance.derived if data.get(key) is None}  # what a partner does not have is not given
        return {key: value for key, value in data.items() if key not in lost}

    def _validated(self, name: str, instance: Instance, data: Data) -> bool:
        try:
            block, problems = validate(instance.model, data, instance.place)
        except PluginError as error:
            self._broke(instance, error.__cause__ or error)
            return False
        self.problems += [self._where_typed(instance, problem) for problem in problems]
        if block is not None:
            self.blocks[name] = block
        return block is not None

    def _calculate(self, name: str, instance: Instance, block: Block) -> None:
        assert instance.mechanism is not None
        known = self.beside(instance)
        self._slips(instance, self._outside(instance, block, known))
        self.tell(name)
        try:
            with in_time():
                self.calculations[name] = self._made(instance, instance.mechanism, block)
                self._slips(instance, self._outside(instance, block, known, self.calculations[name]))
                note_findings(self.calculations[name], placed_findings(self.config.parts, instance.mechanism.kind))
                self._printed(instance, self.calculations[name])
        except Impossible as fault:
            for path, message in fault.reasons:
                key = key_of(path) if path else ()
                ways = possible_ways(instance.mechanism, flatten(block), path, holds)
                problem = instance.place.problem(key, message)
                problem = replace(problem, advice=advice_text(ways)) if ways else problem
                self.problems.append(self._where_typed(instance, problem))
        except SelfTestFailed as fault:
            self.self_tests[name] = fault.checks
            self._broke(instance, fault, str(fault))
        except Exception as cause:
            self._broke(instance, cause)

    def _where_typed(self, instance: Instance, problem: Problem) -> Problem:
        """Return a problem of an input that takes a field of the press by default at that field, which alone is typed."""
        key = problem.path.removeprefix(f"{input_path(instance.name)}.")
        target = self.config.links.get((instance.name, *key.split(".")))
        press = self.config.instances[PRESS]
        if target is None or not target.is_default or press is None:
            return problem
        template = "{name} takes it by default: {message}"
        name = f"{instance.name}.{key}"
        at_field = press.place.problem(target.key, template, name=name, message=problem.message)
        return replace(at_field, allowed=problem.allowed, advice=problem.advice)

    def _made(self, instance: Instance, mechanism: Mechanism, block: Block) -> Calculation:
        calculation = calculate(mechanism, flatten(block))
        calculation.chosen_units = self.chosen_units(instance.name)
        calculation.unfounded = self.bases.unfounded(instance, block)
        return calculation

    def beside(self, instance: Instance) -> Beside:
        """Return what is known beside the inputs of a mechanism by which their values are judged."""
        press = flatten(self.blocks[PRESS]) if PRESS in self.blocks else {}
        known = {f"{PRESS}.{name}": value for name, value in press.items()}
        return beside(instance, known, self.bases.beyond(instance))

    def _outside(
        self, instance: Instance, block: Block, known: Beside, calculation: Calculation | None = None
    ) -> list[Outside]:
        """What is outside its usual range before a mechanism is calculated, and then."""
        if calculation is None:
            return outside(instance, flatten(block), known)
        return note_usual(calculation, instance, block, known)

    def _slips(self, instance: Instance, found: Sequence[Outside]) -> None:
        """Refuse the values that are a slip, each once and where it is typed: a default from the press where that gives it."""
        for each in (one for one in found if one.slips.any()):
            node = (instance.name, *each.key)
            target = self.config.links.get(node)
            source = target.node if target else node
            home = self.config.instances[str(source[0])] if target and target.is_default else None
            problem = partial(each.problem, instance, target.told if target else "")
            if home:
                problem = partial(replace(each, key=source[1:]).problem, home, "")
            if not self.slipped & {node, source}:
                self._refuse(problem, each.slips)
            self.slipped |= {node, source} if home else {node}

    def _refuse(self, problem: Callable[[int], Problem], wrong: Array) -> None:
        """Note what a machine cannot be, by its variants."""
        self.problems.append(problem(0))

    def chosen_units(self, name: str) -> ChosenUnits:
        """Return the units that the report chose for the quantities of a mechanism."""
        chosen = self.config.report.units or {}
        return ChosenUnits(instances.by_si(chosen), instances.by_id(chosen, name))

    def _printed(self, instance: Instance, calculation: Calculation) -> None:
        """Make the results of a mechanism, where these are asked for."""

    def _broke(self, instance: Instance, cause: BaseException, words: str = "") -> None:
        self.calculations.pop(instance.name, None)
        self.errors[instance.name] = PluginError(words or said(cause), self.config.kinds[instance.name], instance.name)
        self.errors[instance.name].__cause__ = cause

    @cached_property
    def bases(self) -> Bases:
        """Return what the values of the run rest on."""
        return Bases(self.config, self.calculations)


class ReportedRun(Run):
    """Go through the graph, and make all results of it, comparisons too."""

    def _comparisons(self) -> None:
        cases = list(found(self.calculations)) if not self.problems else []
        for case in cases[:MAX_COMPARISONS]:
            self._compare(case)
        self.left_out = [case.name for case in cases[MAX_COMPARISONS:]]

    def _printed(self, instance: Instance, calculation: Calculation) -> None:
        self._store(instance, mechanism_results(calculation, self._provenance(instance)))

    def _store(self, instance: Instance, found: MechanismRecord) -> None:
        tables = [SourceRecord(id=file, citation=citation) for file, citation in instance.own.sources.items()]
        self.results[instance.name] = found.with_(sources=[*found.sources, *tables])

    def _compare(self, case: Found) -> None:
        self.tell(case.name)
        self.cases.append(case)
        try:
            with in_time():
                self.comparisons[case.name] = compared(case, self.calculations, self.chosen_units(""))
        except (
            Uncomparable
        ) as fault:  # told at the key that the value was given by, or else at the mechanism that gives it
            instance = self.config.instances[fault.instance]
            assert instance is not None, "a broken mechanism is compared with nothing"
            is_given = fault.name in instance.data
            key = (fault.name,) if is_given else ()
            self.problems.append(instance.place.problem(key, str(fault), at_key=not is_given))
        except Exception as cause:
            self.errors[case.name] = PluginError(said(cause), case.comparison.mechanism.kind, case.name)
            self.errors[case.name].__cause__ = cause

    def _provenance(self, instance: Instance) -> dict[str, Provenance]:
        found, bases = {}, self.bases
        for slot in instance.slots:
            node = (instance.name, *slot.key)
            origin = origin_of(self.config, instance, slot)
            rests = bases.of(node) if isinstance(slot.meta, Quantity | CurveInput | Text) else ""
            found[".".join(map(str, slot.key))] = replace(origin, basis=rests, note=bases.said(node).note)
        return found


# Whether the machines of a config can exist, without their results: only the steps run on which that depends, or a reference.


def impossible(config: Config, known: Sequence[Problem]) -> tuple[list[Problem], list[PluginError]]:
    """Return what cannot be in a config, beside the ``known`` problems of it, and the plugins that break on it.

    Mechanisms with a known problem are left out, with those that refer to them; all are where they lack their parts.
    """
    if config.lacks_parts:
        return [], []
    run = _FeasibilityRun(config, known)
    return run.problems, [error for name, error in run.errors.items() if name not in config.broken]


class _FeasibilityRun(Run):
    """One way through the graph that stops at what must hold."""

    def __init__(self, config: Config, known: Sequence[Problem]) -> None:
        self.known = known
        self.wrong = {
            name for name in config.instances for problem in known if _is_within(problem.path, input_path(name))
        }
        super().__init__(config, lambda _: None)

    def _mechanism(self, name: str) -> None:
        if name in self.wrong:
            self.skipped[name] = phrase("It has problems of its own.")
        else:
            super()._mechanism(name)

    def _referred(self, target: Target) -> Any:
        """Return what a reference stands for; Withheld where the value there has a problem of its own, for it cannot be read."""
        path = input_path(target.instance, target.key)
        faulty = (problem.path for problem in self.known if target.instance in self.wrong)
        if any(_is_within(each, path) or _is_within(path, each) for each in faulty):
            raise Withheld
        return super()._referred(target)

    def _made(self, instance: Instance, mechanism: Mechanism, block: Block) -> Calculation:
        inputs = flatten(block)
        given = frozenset(inputs) | texts_given(inputs)
        links = [link for link in self.config.links.values() if link.instance == instance.name]
        # taken whole, or a phase of it: that is more than a few of its results
        if any(link.is_mechanism or link.phase_unit is not None for link in links):
            return calculate(mechanism, inputs)
        referred = (single for target in self.config.links.values() for single in target.single)
        names = [str(each.result) for each in referred if each.instance == instance.name and each.result]
        steps = [step for _, step in mechanism.active(given) if isinstance(step, Require | Clash)]
        names += [name for step in steps for name in taken(step)]  # what must be known of what must hold
        names += TAKEN.get(mechanism.kind, ())
        try:
            return calculate(mechanism, inputs, 1, needed(mechanism, given, names))
        except Impossible:  # its words may name what these steps do not know
            return calculate(mechanism, inputs)


def _is_within(path: str, home: str) -> bool:
    """Return whether a key path is another or lies within it."""
    return f"{path}.".startswith(f"{home}.")
