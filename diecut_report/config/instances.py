"""The mechanisms of a config (and its press): which inputs have a value, and what their results are called."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from diecut_report.config.basis import Basis
from diecut_report.config.taken_entries import Taken
from diecut_report.config.targets import Node, Target
from diecut_report.config.validation import ConfigPlace, keys_of
from diecut_report.config.yaml_tree import KeyPath
from diecut_report.contract.chapters import Chapter
from diecut_report.contract.code_steps import ComputedCurve, PartNames
from diecut_report.contract.input_lists import list_inputs
from diecut_report.contract.inputs import (
    Block,
    CurveInput,
    FromPress,
    Meta,
    Quantity,
    Text,
    flatten,
    texts_given,
)
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.phases import PREFIX
from diecut_report.contract.result_names import part_result
from diecut_report.contract.steps import Step
from diecut_report.errors import nearest
from diecut_report.languages.phrases import Phrase, phrase


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
        self, name: str, model: type[Block], data: dict[str, Any], place: ConfigPlace, mechanism: Mechanism | None,
        bases: Mapping[KeyPath, Basis] | None = None, own: Taken | None = None,
    ) -> None:  # fmt: skip
        self.name, self.model, self.data, self.place, self.mechanism = name, model, data, place, mechanism
        self.bases = bases or {}
        self.own = own  # what comes from the user's own tables
        self.without: frozenset[KeyPath] = frozenset()
        self.derived: frozenset[str] = frozenset()  # inputs taken from partners

    def take(self, found: Mapping[str, str]) -> None:
        """Take inputs from partners: names, and references that keep no value where a machine does not have what they name."""
        self.data |= found
        self.derived = frozenset(found)
        self.forget()

    def leave_out(self, keys: Iterable[KeyPath]) -> None:
        """Inputs that keep no value, as the press does not give their optional default."""
        without = frozenset(keys)
        if without != self.without:
            self.without = without
            self.forget()

    def forget(self) -> None:
        """Forget what follows from the inputs, as they have changed."""
        for known in ("slots", "_by_key", "given", "results", "phases", "rows"):
            self.__dict__.pop(known, None)

    @cached_property
    def slots(self) -> tuple[Slot, ...]:
        """All inputs of the blocks and lists that are given in it."""
        return tuple(slots(self.model, self.data))

    @cached_property
    def _by_key(self) -> dict[KeyPath, Slot]:
        return {slot.key: slot for slot in self.slots}

    @cached_property
    def given(self) -> frozenset[str]:
        """The ids of the inputs that have a value: given, by default, or from the press."""
        found: set[str] = set(self.mechanism.facts) if self.mechanism else set()
        for slot in self.slots:
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
        if self.mechanism is None:
            return {}
        found = dict(self.mechanism.results_of(self.given))
        for _, step in self.mechanism.active(self.given):
            for name in self.names_of_parts(step.named_by):
                found[part_result(name, step)] = found[step.id][0], isinstance(step, ComputedCurve)
            if step.named_by and isinstance(step, ComputedCurve):
                del found[step.id]
        return found

    def names_of_parts(self, path: str) -> list[str]:
        """Return the names that the blocks of a list have in the file; none where there is no such list."""
        home, _, key = path.rpartition(".")
        blocks = self.data.get(home) if home else None
        return [str(block.get(key)) for block in blocks if isinstance(block, dict)] if isinstance(blocks, list) else []

    @cached_property
    def phases(self) -> dict[str, str]:
        """The phases that there are with these inputs (``phases.NAME``), each with the SI unit of what it runs over."""
        return self.mechanism.phases_of(self.given) if self.mechanism else {}

    def no_phase(self, phase: str) -> str:
        """Why there is no such phase, in words."""
        if phase in self.declared_steps:
            chapter, step = self.declared_steps[phase]
            missing = [key for key in (*chapter.needs, *step.needs) if key not in self.given]
            return Phrase(
                "is there only if {missing} is given in {name}.", missing=" and ".join(missing), name=self.name
            )
        name, known = phase.removeprefix(PREFIX), [each.removeprefix(PREFIX) for each in self.phases]
        near = nearest(name, known)
        told = Phrase(" Known: {known}.", known=", ".join(known)) if known else phrase(" Its kind has none.")
        return Phrase(
            "names no phase: {name} has no phase {name_2}{near}.{told}",
            name=self.name,
            name_2=repr(name),
            near=near,
            told=("" if near else told),
        )

    @cached_property
    def rows(self) -> dict[str, str]:
        """The results that have a value for each part of a list, with that list."""
        if self.mechanism is None:
            return {}
        lists = {
            *list_inputs(self.model).values(),
            *(s.id for _, s in self.mechanism.steps if isinstance(s, PartNames)),
        }
        return {name: home for name, home in self.mechanism.axes(self.given).items() if home in lists}

    def value(self, key: KeyPath) -> Any:
        """The value of an input that is not a reference: an SI number, a text, true or false, values of a curve, or None."""
        slot = next(self._by_key[key[:n]] for n in range(len(key), 0, -1) if key[:n] in self._by_key)
        value = slot.value
        for part in key[len(slot.key) :]:  # within a block that is there by default
            if value is None:  # an optional block that is not given
                return None
            value = getattr(value, part) if isinstance(part, str) else value[part]
        is_own = slot.key == key and isinstance(slot.meta, Quantity | CurveInput)
        return slot.meta.validate(value) if is_own and value is not None and slot.meta else value

    @cached_property
    def declared_steps(self) -> dict[str, tuple[Chapter, Step]]:
        """Every step of the mechanism by its id, whether it takes part or not."""
        return {step.id: (section, step) for section, step in self.mechanism.steps} if self.mechanism else {}

    @cached_property
    def declared(self) -> dict[str, Step]:
        """Those steps without their chapters."""
        return {name: step for name, (_, step) in self.declared_steps.items()}


def default_of(slot: Slot) -> FromPress | None:
    """The press's default that stands in for an input without a value."""
    return slot.meta.press if isinstance(slot.meta, Quantity) and slot.value is None else None


def substituted(
    instance: Instance, links: Mapping[Node, Target], value: Callable[[Node, Target], Any]
) -> dict[str, Any]:
    """The data of an instance with what stands in for its references; defaults of the press are left to ``value`` too."""
    data: dict[str, Any] = _copied(instance.data)
    for node, target in links.items():
        if node[0] != instance.name:
            continue
        home: Any = data
        for part in node[1:-1]:
            home = home[part]
        home[node[-1]] = value(node, target)
    return data


def _copied(data: Any) -> Any:
    if isinstance(data, dict):
        return {key: _copied(part) for key, part in data.items()}
    return [_copied(part) for part in data] if isinstance(data, list) else data
