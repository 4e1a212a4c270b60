"""What the values of a run rest on: a reference carries the weakest basis of all that it is calculated from."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from diecut_report.config.basis import ASSUMED, GIVEN, Basis, is_founded, weakest
from diecut_report.config.instances import Instance
from diecut_report.config.loader import Config
from diecut_report.config.model import PRESS
from diecut_report.config.targets import Node, Target
from diecut_report.config.yaml_tree import KeyPath
from diecut_report.contract.inputs import Block
from diecut_report.contract.sections import taken
from diecut_report.engine import Calculation
from diecut_report.engine.steps.rerun import needed


class _Slots(NamedTuple):
    """Hold the inputs of a mechanism: the keys of those that are given, and of all with the names that its steps know them by."""

    given: frozenset[KeyPath]
    named: Sequence[tuple[str, KeyPath]]


class Bases:
    """Follow the references of a run, of which all calculations are known that a value refers to."""

    def __init__(self, config: Config, calculations: Mapping[str, Calculation]) -> None:
        self.config, self.calculations = config, calculations
        self._known: dict[Node, str] = {}
        self._slots_of: dict[str, _Slots] = {}
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

    def is_founded(self, node: Node) -> bool:
        """Return whether an input is at its default, or rests on what can be looked up."""
        return not self._is_given(node) or is_founded(self.of(node), self.said(node).note)

    def unfounded(self, instance: Instance, block: Block) -> frozenset[str]:
        """Return the inputs of which a check asks a basis that can be looked up, and which have none; a typed default is a default."""
        asked = {name for check in instance.mechanism.checks for name in check.founded} if instance.mechanism else ()
        typed = [name for name in asked if np.any(getattr(block, name) != type(block).model_fields[name].get_default())]
        return frozenset(name for name in typed if not self.is_founded((instance.name, name)))

    def _of(self, node: Node) -> str:
        chain = [self.said(node).basis]
        if node in self._linked:
            chain += [self._target(single) or GIVEN for target in self._linked[node] for single in target.single]
        return weakest(filter(None, chain)) or (GIVEN if self._is_given(node) else "")

    def _is_given(self, node: Node) -> bool:
        instance = self.config.instances[str(node[0])]
        return instance is not None and node[1:] in self._slots(instance).given

    def _slots(self, instance: Instance) -> _Slots:
        if instance.name not in self._slots_of:
            found = instance.slots
            given = frozenset(slot.key for slot in found if slot.is_given)
            names = [(".".join(part for part in slot.key if isinstance(part, str)), slot.key) for slot in found]
            self._slots_of[instance.name] = _Slots(given, names)
        return self._slots_of[instance.name]

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
        used = {
            name
            for _, step in calculation.mechanism.active(calculation.given)
            if step.id in names
            for name in taken(step)
        }
        yield from ((instance.name, *key) for name, key in self._slots(instance).named if name in used)


def assumed(config: Config) -> list[str]:
    """Return the paths of the values that the file says are assumed, in its order."""
    return [
        ".".join(map(str, (*((PRESS,) if name == PRESS else ("mechanisms", name)), *key)))
        for name, instance in config.instances.items()
        for key, said in (instance.bases.items() if instance else ())
        if said.basis == ASSUMED
    ]
