"""References ``${path}``: what each stands for, in which order the values follow, and every mistake in them.

Order and loops are judged by input: the nodes of the graph are single inputs and whole calculations. An input that refers
to another input waits for that input only; one that refers to an output waits for the calculation that gives it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from diecut_report.contract.families import Section
from diecut_report.contract.inputs import (
    Block,
    CurveInput,
    FromPress,
    Meta,
    Quantity,
    Text,
    fields,
    flatten,
    texts_given,
)
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.steps import Step
from diecut_report.errors import Problem, nearest
from diecut_report.expressions import Formula
from diecut_report.units import pretty, unit
from diecut_report.validation import Place, declared, keys_of
from diecut_report.yaml_tree import KeyPath

PRESS = "press"
WHOLE = re.compile(r"\$\{([^${}]*)\}")

Node = KeyPath  # (instance,) is its calculation, (instance, key, …) one of its inputs


@dataclass(frozen=True)
class Slot:
    """A declared input in a block that is there: its key, its declaration, and its value in the file or its default."""

    key: KeyPath
    meta: Meta | None
    value: Any
    is_given: bool
    is_required: bool


def slots(model: type[Block], data: Mapping[str, Any], key: KeyPath = ()) -> Iterator[Slot]:
    """All inputs of a block and of the blocks and lists given in it."""
    for name, (field, meta, block, _) in keys_of(model).items():
        given, own = data.get(name), (*key, name)
        default = None if given is not None or field.is_required() else field.get_default(call_default_factory=True)
        yield Slot(own, meta, default if given is None else given, given is not None, field.is_required())
        parts = list(enumerate(given)) if isinstance(given, list) else [(None, given)]
        for index, part in parts if block else []:
            if block and isinstance(part, dict):
                yield from slots(block, part, own if index is None else (*own, index))


class Instance:
    """A mechanism of the config, or the press (which has no calculation)."""

    def __init__(
        self, name: str, model: type[Block], data: dict[str, Any], place: Place, mechanism: Mechanism | None
    ) -> None:
        self.name, self.model, self.data, self.place, self.mechanism = name, model, data, place, mechanism
        self.without: frozenset[KeyPath] = frozenset()

    def leave_out(self, keys: Iterable[KeyPath]) -> None:
        """Inputs that keep no value, as the press does not give their optional default."""
        self.without = frozenset(keys)
        for known in ("given", "results"):
            self.__dict__.pop(known, None)

    @cached_property
    def given(self) -> frozenset[str]:
        """The ids of the inputs that have a value: given, by default, or from the press."""
        found: set[str] = set()
        for slot in slots(self.model, self.data):
            name = ".".join(part for part in slot.key if isinstance(part, str))
            if isinstance(slot.value, Block):
                found |= set(flatten(slot.value, f"{name}."))
            from_press = default_of(slot) is not None and slot.key not in self.without
            if slot.value not in (None, []) or slot.is_required or from_press:
                found.add(name)
            if isinstance(slot.meta, Text):
                found |= texts_given({name: slot.value})
        return frozenset(found)

    @cached_property
    def results(self) -> dict[str, tuple[str | None, bool]]:
        """What the calculation gives with these inputs: the SI unit (None for a text), and whether it is a curve or row."""
        return self.mechanism.results_of(self.given) if self.mechanism else {}

    def value(self, key: KeyPath) -> Any:
        """The value of an input that is no reference: an SI number, a text, true or false, values of a curve, or None."""
        slot = max((s for s in slots(self.model, self.data) if s.key == key[: len(s.key)]), key=lambda s: len(s.key))
        value = slot.value
        for part in key[len(slot.key) :]:  # within a block that is there by default
            value = getattr(value, part) if isinstance(part, str) else value[part]
        is_own = slot.key == key and isinstance(slot.meta, Quantity | CurveInput)
        return slot.meta.validate(value) if is_own and value is not None and slot.meta else value

    @cached_property
    def declared_steps(self) -> dict[str, tuple[Section, Step]]:
        """Every step of the mechanism by its id, whether it takes part or not."""
        return {step.id: (section, step) for section, step in self.mechanism.steps} if self.mechanism else {}


def default_of(slot: Slot) -> FromPress | None:
    """The press's default that stands in for an input without a value."""
    return slot.meta.press if isinstance(slot.meta, Quantity) and slot.value is None else None


@dataclass(frozen=True)
class Target:
    """What a reference stands for: an output (``result``) or an input (``key``) of an instance."""

    path: str
    instance: str
    key: KeyPath = ()
    result: str | None = None
    unit: str | None = None
    is_curve: bool = False
    is_default: bool = False  # not written by the user: the press's field that stands in for an absent input
    formula: Formula | None = None
    is_broken: bool = False  # the plugin of what it refers to cannot be loaded

    @property
    def node(self) -> Node:
        """What must be known before."""
        return (self.instance,) if self.result is not None or self.is_broken else (self.instance, *self.key)


class Unresolved(LookupError):
    """A reference that stands for nothing, in words."""


class Linker:
    """Finds what every reference stands for; gathers links and problems. Broken mechanisms are None."""

    def __init__(self, instances: Mapping[str, Instance | None]) -> None:
        self.instances = instances
        self.links: dict[Node, Target] = {}
        self.unresolved: set[Node] = set()
        self.problems: list[Problem] = []
        known = [instance for instance in instances.values() if instance is not None]
        for instance in known:
            instance.leave_out(self._not_in_press(instance))
        for instance in known:
            self._written(instance)
            self._from_press(instance)

    def _not_in_press(self, instance: Instance) -> Iterator[KeyPath]:
        press = self.instances[PRESS]
        assert press is not None, "the press is no plugin"
        for slot in slots(instance.model, instance.data):
            default = default_of(slot)
            if default and default.optional and default.path.removeprefix(f"{PRESS}.") not in press.given:
                yield slot.key

    def _written(self, instance: Instance) -> None:
        for key, text in texts(instance.data):
            if "${" not in text:
                continue
            node = (instance.name, *key)
            try:
                self.links[node] = self._within_curve(instance, key, self.target(text))
            except Unresolved as fault:
                self.unresolved.add(node)
                self.problems.append(instance.place.problem(key, str(fault)))

    def _within_curve(self, instance: Instance, key: KeyPath, target: Target) -> Target:
        """The values of a curve given as a list are no inputs of their own, so their kind is judged here."""
        meta = declared(instance.model, key[:-1]) if len(key) > 1 else None
        if isinstance(meta, CurveInput) and not target.is_broken:
            single = target.unit is not None and not target.is_curve
            if not single or unit(str(target.unit)).kind != unit(meta.unit).kind:
                raise Unresolved(
                    f"${{{target.path}}} is no single quantity in {pretty(meta.unit)}, as the other values are"
                )
        return target

    def _from_press(self, instance: Instance) -> None:
        for slot in slots(instance.model, instance.data):
            default = default_of(slot)
            if default is None or slot.key in instance.without:
                continue
            try:
                target = self.target(f"${{{default.path}}}")
            except Unresolved:
                self.problems.append(self._no_default(instance, slot, default))
                continue
            found = Target(target.path, target.instance, target.key, None, target.unit, False, True, default.formula)
            self.links[(instance.name, *slot.key)] = found

    def _no_default(self, instance: Instance, slot: Slot, default: FromPress) -> Problem:
        assert isinstance(slot.meta, Quantity)
        field, key = default.path.removeprefix(f"{PRESS}."), slot.key[-1]
        message = (f"{key} is not given and the press gives no {field} to derive it from; "
                   f"give {key} ({pretty(slot.meta.unit) or 'a number'}) or {default.path}.")  # fmt: skip
        return instance.place.absent(slot.key, message)

    # --- what a path stands for --------------------------------------------------------------------------------------

    def target(self, text: str) -> Target:
        """What a reference stands for; Unresolved in words where it stands for nothing."""
        match = WHOLE.fullmatch(text.strip())
        if match is None:
            raise Unresolved(
                f"“{text}” mixes a reference with text; a reference stands for a whole value, as in ${{press.name}}."
            )
        path = match[1].strip()
        name, *rest = path.split(".")
        if name not in self.instances:
            near = nearest(name, self.instances)
            raise Unresolved(f"${{{path}}}: there is no mechanism {name!r}{near}. Known: {', '.join(self.instances)}.")
        instance = self.instances[name]
        if instance is None:
            return Target(path, name, is_broken=True)
        if not rest or not all(rest):
            example = next(iter(_known(instance)), "output")
            raise Unresolved(f"${{{path}}} names no value; add an output or input, as in ${{{name}.{example}}}.")
        return self._result(path, instance, ".".join(rest)) or self._input(path, instance, rest)

    def _result(self, path: str, instance: Instance, result: str) -> Target | None:
        if result in instance.results:
            si, many = instance.results[result]
            return Target(path, instance.name, result=result, unit=si, is_curve=many)
        row, _, index = result.rpartition(".")
        if index.isdigit() and row in instance.results and instance.results[row][1]:
            return Target(path, instance.name, result=result, unit=instance.results[row][0])
        return None

    def _input(self, path: str, instance: Instance, parts: list[str]) -> Target:
        key: KeyPath = tuple(int(part) if part.isdigit() else part for part in parts)
        meta = declared(instance.model, key)
        name = ".".join(part for part in key if isinstance(part, str))
        if isinstance(meta, type):
            inner = ", ".join(meta.model_fields)
            raise Unresolved(f"${{{path}}} is a block or a list; refer to one of its values ({inner}).")
        if meta is None:
            raise Unresolved(self._unknown(path, instance, ".".join(parts)))
        _check_index(path, instance.data, key)
        if name not in instance.given:
            raise Unresolved(f"${{{path}}} is not given; it is optional. Give {path}, or write the value itself here.")
        si = unit(meta.unit).si if isinstance(meta, Quantity | CurveInput) else None
        return Target(path, instance.name, key, unit=si, is_curve=isinstance(meta, CurveInput))

    def _unknown(self, path: str, instance: Instance, name: str) -> str:
        section, step = (
            instance.declared_steps.get(name) or instance.declared_steps.get(name.removesuffix("_at")) or (None, None)
        )
        if section and step:
            missing = [n for n in (*section.needs, *step.needs) if n not in instance.given]
            excess = [n for n in step.lacks if n in instance.given]
            words = (
                f"calculated only if {' and '.join(missing)} is given"
                if missing
                else f"not calculated, as {', '.join(excess)} is given"
            )
            return f"${{{path}}} is {words} in {instance.name}."
        known = _known(instance)
        near = nearest(name, known)
        return f"${{{path}}}: {instance.name} has no {name!r}{near}." + ("" if near else f" Known: {', '.join(known)}.")


def _known(instance: Instance) -> list[str]:
    return list(dict.fromkeys([*instance.results, *(name for name, _ in fields(instance.model))]))


def _check_index(path: str, data: Any, key: KeyPath) -> None:
    for part in key:
        if isinstance(part, int) and isinstance(data, list) and part >= len(data):
            raise Unresolved(f"${{{path}}}: the list has {len(data)} entries, counted from 0.")
        known = part in data if isinstance(data, dict) else isinstance(data, list) and isinstance(part, int)
        data = data[part] if known else None


def texts(data: Any, key: KeyPath = ()) -> Iterator[tuple[KeyPath, str]]:
    """Every text in plain data, with its key path."""
    if isinstance(data, str):
        yield key, data
    elif isinstance(data, dict | list):
        for name, part in data.items() if isinstance(data, dict) else enumerate(data):
            yield from texts(part, (*key, name))
