"""Where an input comes from: given in the file, by default, or by reference."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache
from typing import Any, Literal

import numpy as np

from diecut_report.config.instances import Instance, Node, Slot, Target
from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.config.validation import ASSUMED, Basis, is_founded, keys_of, weakest
from diecut_report.config.validation import GIVEN as BASES_GIVEN
from diecut_report.config.yaml import KeyPath
from diecut_report.formulas import Array
from diecut_report.machine.calculation import Calculation, declared_unit
from diecut_report.machine.mechanism import MechanismHandle, PhaseHandle
from diecut_report.machine.steps import soundness
from diecut_report.machine.steps.needed import needed
from diecut_report.mechanism.chapters import taken
from diecut_report.mechanism.curve_inputs import CurveInput, TakenWhole
from diecut_report.mechanism.inputs import Block, Extremes, Quantity, Varying
from diecut_report.mechanism.names import SI
from diecut_report.mechanism.steps import PREFIX, named
from diecut_report.quantities.formatting import given_shown, shortest
from diecut_report.quantities.plausible import without_rounding
from diecut_report.quantities.units import unit
from diecut_report.results.mechanism_record import PartRecord, QuantityRecord
from diecut_report.results.usual import OtherUse
from diecut_report.text.phrases import Phrase, phrase

# What a reference takes over of a calculated mechanism.


class Absent(LookupError):
    """Stand for a value that this machine does not have, or an expression without one; the text says so."""


class Withheld(LookupError):
    """Stand for a value that is not calculated, since the machine does not meet what it stands on; the text says what is not met.

    Without a text a broken or skipped mechanism would have given it.
    """


def require_facts(calc: Calculation, name: str, target: Target) -> None:
    """Raise Withheld where a result stands on a fact that the machine (of several: none of them) does not meet."""
    missed, words = soundness.without(calc, name)
    if missed.all():
        raise Withheld(Phrase("{path}, which is {reason}", path=target.path, reason=phrase(words or "not calculated")))


def number(calc: Calculation, name: str) -> Array | None:
    """Return a number or text by its name in the results, shape (variants,); None where there is no such one."""
    if name in calc.values:
        return calc.values[name][:, 0]
    part = named(name, calc.steps)
    row = calc.values.get(part.id) if part and part.role == "part" else None
    return row[:, part.index] if part and row is not None and part.index < row.shape[1] else None


def output(calc: Calculation, name: str, target: Target) -> Any:
    """Return a result as a reference takes it over: a curve, a phase, a number with its SI unit, or a text.

    Absent where the (first) machine does not have it.
    """
    if target.is_mechanism:
        return MechanismHandle(calc, target.instance)
    require_facts(calc, name, target)
    if target.phase_unit:
        phase = PhaseHandle(calc, name.removeprefix(PREFIX), f"${{{target.path}}}")
        if not phase.intervals():
            raise Absent(phrase("does not apply to this machine."))
        return phase
    if calc.axis.get(name) in calc.domains:
        return calc.handle(name)
    numbers = number(calc, name)
    if numbers is None:
        raise Absent(phrase("does not exist for this machine."))
    value = numbers[0]
    if isinstance(value, str):
        return value
    if math.isnan(value):
        raise Absent(phrase("does not apply to this machine."))
    return SI(float(without_rounding(value, str(target.unit))), str(target.unit), target.path)


# What the values of a run rest on: a reference carries the weakest basis of all that it is calculated from.


def is_default(block: Block, key: KeyPath) -> bool:
    """Return whether an input of a block, or of a block within it, has the value that it would have if nobody typed it, in all machines."""
    return bool(np.all(at_default(block, key)))


def at_default(block: Block, key: KeyPath) -> Any:
    """Return in which machines an input has the value that it would have if nobody typed it: True, False, or an array (variants,)."""
    home: Block = _home(block, key)
    if keys_of(type(home))[str(key[-1])].field.is_required():
        return np.asarray(False)
    return ~np.asarray(value_in(block, key) != _default(type(home), str(key[-1])))


@cache
def _default(model: type[Block], name: str) -> Any:
    default, meta = keys_of(model)[name].default, keys_of(model)[name].meta
    if isinstance(meta, Quantity) and default is not None:
        return meta.validate(default)  # it is declared in the unit of its key
    return default


def as_founded(instance: Instance, block: Block, key: KeyPath) -> Any:
    """Return in which machines a varied input has the value that its basis is of: True, False, or an array (variants,)."""
    return key in instance.founded and np.asarray(value_in(block, key) == instance.founded[key])


def value_in(block: Block, key: KeyPath) -> Any:
    """Return the value of an input in a block, or in a block within it."""
    return getattr(_home(block, key), str(key[-1]))


def _home(block: Block, key: KeyPath) -> Any:
    """The block within another one in which a key stands."""
    for part in key[:-1]:
        block = block[part] if isinstance(part, int) else getattr(block, str(part))  # type: ignore[index]
    return block


class Bases:
    """Follow the references of a run, of which all calculations are known that a value refers to."""

    def __init__(self, config: Config, calculations: Mapping[str, Calculation]) -> None:
        self.config, self.calculations = config, calculations
        self._known: dict[Node, str] = {}
        self._given: dict[str, set[KeyPath]] = {}
        self._beyond: dict[str, dict[KeyPath, str]] = {}
        self._linked: dict[Node, list[Target]] = {}
        for node, target in config.links.items():
            for length in range(2, len(node) + 1):  # also of the whole list that it stands in
                self._linked.setdefault(node[:length], []).append(target)

    def of(self, node: Node) -> str:
        """Return what an input rests on; nothing for a default."""
        if node not in self._known:
            self._known[node] = self._of(node)
        return self._known[node]

    def said(self, node: Node) -> Basis:
        """Return what the file says of an input itself."""
        instance = self.config.instances[str(node[0])]
        return instance.bases.get(node[1:], Basis()) if instance else Basis()

    def beyond(self, instance: Instance) -> dict[KeyPath, str]:
        """Return why inputs may be outside their hard range: what the file says there, or at the input that they refer to."""
        if instance.name not in self._beyond:
            found = {slot.key: self.reason((instance.name, *slot.key)) for slot in instance.slots}
            self._beyond[instance.name] = {key: reason for key, reason in found.items() if reason}
        return self._beyond[instance.name]

    def reason(self, node: Node) -> str:
        """Return why an input may be outside its hard range; nothing where that is not said."""
        target = self.config.links.get(node)
        is_input = target is not None and target.key and not target.expression
        own, parts = self.said(node).beyond, self.config.parts
        if own and parts is not None and parts.follows(node) and parts.sources.get(node) is None:
            return OtherUse(own)  # no file says it: the parts are made so
        return own or (self.reason(target.node) if target is not None and is_input else "")

    def is_founded(self, node: Node) -> bool:
        """Return whether an input is at its default, or rests on what can be looked up."""
        return not self._is_given(node) or is_founded(self.of(node), self.said(node).note)

    def unfounded(self, instance: Instance, block: Block) -> dict[KeyPath, Any]:
        """Return the inputs of which a check asks a basis that can be looked up, and which have none; a typed default is a default.

        Each with the machines in which that is so: True, or an array (variants,).
        """
        asked = {name for check in instance.mechanism.checks for name in check.founded} if instance.mechanism else ()
        keys = [slot.key for slot in (instance.slots if asked else ()) if slot.name in asked]
        named = [key for key in keys if not self.is_founded((instance.name, *key))]
        typed = {key: ~at_default(block, key) & ~np.asarray(as_founded(instance, block, key)) for key in named}
        return {key: where if np.ndim(where) else True for key, where in typed.items() if np.any(where)}

    def _of(self, node: Node) -> str:
        chain = [self.said(node).basis]
        if node in self._linked:
            chain += [self._target(single) or BASES_GIVEN for target in self._linked[node] for single in target.single]
        return weakest(filter(None, chain)) or (BASES_GIVEN if self._is_given(node) else "")

    def _is_given(self, node: Node) -> bool:
        instance = self.config.instances[str(node[0])]
        if instance is None:
            return False
        if instance.name not in self._given:
            self._given[instance.name] = {slot.key for slot in instance.slots if slot.is_given}
        return node[1:] in self._given[instance.name]

    def _target(self, target: Target) -> str:
        if target.result is None:
            return self.of(target.node)
        calculation = self.calculations.get(target.instance)
        return weakest(filter(None, map(self.of, self._inputs(calculation, target)))) if calculation else ""

    def _inputs(self, calculation: Calculation, target: Target) -> Iterator[Node]:
        """The inputs that a result is calculated from."""
        instance = self.config.instances[target.instance]
        assert instance is not None, "what is calculated has a model"
        names = needed(calculation.mechanism, calculation.given, [str(target.result)])
        steps = (step for _, step in calculation.mechanism.active(calculation.given) if step.id in names)
        used = set[str]().union(*map(taken, steps))
        for slot in instance.slots:
            if slot.name in used:
                yield (instance.name, *slot.key)


def input_path(name: str, key: KeyPath = ()) -> str:
    """Return the path of a mechanism or the press, or of an input of it, in the configuration."""
    return ".".join(map(str, (*((PRESS,) if name == PRESS else ("mechanisms", name)), *key)))


def assumed(config: Config) -> list[str]:
    """Return the paths of the values that the file says are assumed, in its order."""
    return [
        input_path(name, key)
        for name, instance in config.instances.items()
        for key, said in (instance.bases.items() if instance else ())
        if said.basis == ASSUMED
    ]


# The inputs of a mechanism as results hold them: value, unit, where each comes from and what was typed.


Origin = Literal["given", "default", "reference", "expression"]


@dataclass(frozen=True)
class Provenance:
    """Hold where an input comes from, the path it refers to (an expression: the ``paths``), its text as typed, and what it rests on."""

    origin: Origin
    path: str = ""
    text: str = ""
    paths: list[str] = field(default_factory=list)
    basis: str = ""
    note: str = ""


GIVEN, DEFAULT = Provenance("given"), Provenance("default")


def inputs(calc: Calculation, provenance: Mapping[str, Provenance]) -> dict[str, QuantityRecord]:
    """Return each input with value, unit, origin and typed text; the parts of a list as ``gears.0.driver_teeth``."""
    found = {}
    for path, name, index, value in placed_inputs(calc):
        meta, home = calc.meta[name], calc.axis.get(name, "")
        display = declared_unit(calc, name, meta.unit) if isinstance(meta, Quantity) else "1"
        quantity = name.removeprefix(f"{home}.")
        part = None if index is None else PartRecord(family=home, index=index, quantity=quantity)
        found[path] = QuantityRecord(**_input(meta, value, display), **vars(provenance.get(path, DEFAULT)), part=part)
    return found


def placed_inputs(calc: Calculation) -> Iterator[tuple[str, str, int | None, Any]]:
    """Yield each input that has a value: its path, its id, for a part of a list which one, and the value."""
    for name in calc.meta:
        if name not in calc.inputs:
            continue
        row = calc.inputs[name]
        if name not in calc.axis:
            if row is not None:
                yield name, name, None, row
            continue
        home = calc.axis[name]
        for index, part in enumerate(row[0] if isinstance(row, np.ndarray) else row):
            if part is not None:  # else left out of this part of the list
                yield f"{home}.{index}{name.removeprefix(home)}", name, index, part


def _input(meta: Any, value: Any, display: str) -> dict[str, Any]:
    """What the results hold of an input; of one that is not a number words, of a choice those that one would say."""
    head = {"symbol": meta.symbol, "description": meta.description}
    is_word = isinstance(value, str | TakenWhole)
    if (
        isinstance(meta, Quantity)
        and not is_word
        and (isinstance(value, float | np.ndarray) or not isinstance(meta, Varying))
    ):
        number = float(np.ravel(value)[0])
        exact = int(number) if meta.integer else number
        return head | {"value": exact, "unit": meta.parsed_unit.si, "display": given_shown(number, display)}
    is_varying = isinstance(meta, CurveInput | Varying) and not is_word
    plain, display = list(value) if isinstance(value, tuple) else value, display if isinstance(value, Extremes) else "1"
    if isinstance(value, Extremes):
        text = " … ".join(shortest(unit(display).from_si(end)) for end in (value.low, value.high))
    elif is_varying:
        text = "a curve"
    elif isinstance(value, bool):
        text = "yes" if value else "no"
    else:
        text = ", ".join(value) if isinstance(value, tuple) else str(value)
    is_plain = not (is_varying or isinstance(value, TakenWhole))
    return head | {"value": plain if is_plain else text, "unit": unit(meta.unit).si if is_varying else "1",
                   "display": {"text": text, "unit": display}}  # fmt: skip


def origin_of(config: Config, instance: Instance, slot: Slot) -> Provenance:
    """Return where an input comes from; what it rests on is not said."""
    target = config.links.get((instance.name, *slot.key))
    typed = (instance.place.typed(slot.key) if slot.is_given else None) or ""
    if target is not None and target.expression:
        return Provenance("expression", "", typed, [term.path for term in target.terms])
    origin: Origin = "default" if not slot.is_given else "reference" if target else "given"
    return Provenance(origin, target.path if target else "", typed)
