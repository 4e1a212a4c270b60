"""A file with parts as a file of mechanisms alone: the calculations made of the parts, and references to parts as what they stand for.

Each value of a calculation stands where the part's own is typed, so that whatever is wrong with it is told there.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from diecut_report.config.model import ConfigDocument
from diecut_report.config.parts.demands import Element, Typed, millimetres
from diecut_report.config.parts.elements import Elements
from diecut_report.config.parts.keys import WORDS
from diecut_report.config.parts.model import MachineParts, MachineShaft
from diecut_report.config.parts.reading import PartsReader, typed_changes
from diecut_report.config.parts.rules import coherence, misdriven
from diecut_report.config.validation import ASSUMED, ConfigPlace
from diecut_report.config.yaml import KeyPath, Scalar, Tree, YamlNode, with_root, with_value
from diecut_report.errors import Problem, nearest
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.standards.ranges import asks_basis

REFERENCE = re.compile(r"\$\{\s*((?:" + "|".join(WORDS) + r")\.[^${}]*?)\s*\}")
SINGLE = re.compile(r"\$\{[^${}]*\}")


@dataclass(frozen=True, eq=False)
class Expanded:
    """Hold a file with parts, the parts themselves, the calculations made of them, and what is wrong with them."""

    base: Tree
    parts: MachineParts | None = None
    elements: Elements | None = None
    problems: tuple[Problem, ...] = ()

    @cached_property
    def tree(self) -> Tree:
        """Return the file as one of mechanisms alone; without the parts where something is wrong with them."""
        if self.parts is None or self.elements is None:
            return _without(self.base)
        return _Writer(self.base, self.parts, self.elements).written(self.elements.made)


def has_parts(data: Any) -> bool:
    """Return whether a file has parts."""
    return isinstance(data, dict) and isinstance(data.get("machine"), dict) and "shafts" in data


def misnamed(tree: Tree) -> tuple[Tree, tuple[Problem, ...]]:
    """Return a file with parts, of which a block has no name that is known or one is missing, without its parts; and what is wrong with it.

    What follows from the parts that are not read is told only once they are.
    """
    data = tree.data if isinstance(tree.data, dict) else {}
    known, given = [*ConfigDocument.model_fields, *WORDS], {*data} & {*WORDS}
    unknown, lacking = [key for key in data if key not in known], [word for word in WORDS[:2] if word not in given]
    if not given or not (unknown or lacking):
        return tree, ()
    place, own = ConfigPlace(tree), ", ".join(known)
    template = "is an unknown key{nearest}. Known keys: {own}."
    problems = [
        place.problem((key,), template, at_key=True, nearest=nearest(str(key), known), own=own) for key in unknown
    ]
    template = "is of a machine of parts, which has {word}, too; give it"
    for word in () if unknown else lacking:
        problems.append(place.problem((min(given),), template, at_key=True, word=word))
    children = {key: node for key, node in (tree.root.children or {}).items() if key not in unknown}
    return _without(with_root(tree, replace(tree.root, children=children))), tuple(problems)


def expanded(tree: Tree, of_kind: Callable[[str], Mechanism | None]) -> Expanded:
    """Return the file with the calculations made of its parts."""
    given = tree.data.get("mechanisms")
    if not isinstance(given, dict):  # which is told where the file is judged
        return Expanded(tree)
    blocks = {name: block for name, block in given.items() if isinstance(block, dict)}
    kinds = {name: str(block.get("kind")) for name, block in blocks.items()}
    known = {kind: found for kind in {*kinds.values()} if (found := of_kind(kind)) is not None}
    models = {name: known[kind].inputs for name, kind in kinds.items() if kind in known}
    reader = PartsReader(tree, tree.data, models)
    parts = MachineParts.read(reader, kinds)
    if parts is not None and not reader.problems:
        reader.problems += misdriven(parts)
    if parts is None or reader.problems:
        return Expanded(tree, parts, problems=tuple(reader.problems))
    elements = Elements(parts, blocks, known)
    made = elements.all()
    parts.calculations.update({each.name: ".".join(map(str, each.path[:2])) for each in made if len(each.path) > 1})
    parts.derived.update((each.name,) for each in made)
    parts.derived.update((name, key) for name, fills in elements.fills.items() for key in fills)
    parts.sources.update({(each.name,): each.path for each in made})
    parts.sources.update(pair for each in made for pair in _sources((each.name,), each.inputs))
    parts.sources.update(pair for name, fills in elements.fills.items() for pair in _sources((name,), fills))
    homes: dict[str, KeyPath] = {}
    for each in made:
        first = homes.setdefault(each.name, each.path)
        if each.name in given:
            parts.fault(
                ("mechanisms", each.name), "is the name of a calculation that the parts make; choose another one"
            )
        if first is not each.path:
            template = (
                "makes the calculation {name}, as another part does by its name; choose another name (against {place})"
            )
            parts.fault(each.path, template, name=each.name, place=parts.where(first))
    problems = [*reader.problems, *coherence(parts, elements)]
    if problems:  # which would be told again of what is made of them
        return Expanded(tree, parts, problems=tuple(problems))
    return Expanded(tree, parts, elements)


def _sources(node: KeyPath, given: Any) -> Iterator[tuple[KeyPath, KeyPath | None]]:
    """The inputs of a calculation, each with where its value is typed; None where it follows from several."""
    parts = given.items() if isinstance(given, dict) else enumerate(given) if isinstance(given, list) else ()
    if not parts:
        yield node, given.place if isinstance(given, Typed) else None
    for key, part in parts:
        yield from _sources((*node, key), part)


def retyped(tree: Tree, changes: Mapping[KeyPath, Scalar]) -> Tree:
    """Return the file with these values in the places of what is typed."""
    for path, value in typed_changes(tree, changes).items():
        tree = with_value(tree, path, value)
    return tree


def with_parts(parts: MachineParts, changes: Mapping[KeyPath, Scalar], kinds: Mapping[str, Mechanism]) -> Expanded:
    """Return the file with these values in the places of what is typed, and the calculations that are made of it then.

    What is wrong with it names a second place by its line in the base, wherever that is read from.
    """
    tree = retyped(parts.reader.tree, changes)
    return expanded(Tree(tree.root, "base", tree.text, tree.sha256, tree.name, tree.problems), kinds.get)


def refused(parts: MachineParts, changes: Mapping[KeyPath, Scalar], kinds: Mapping[str, Mechanism]) -> bool:
    """Return whether the parts contradict each other, or cannot be read, with these values in the places of what is typed."""
    return bool(with_parts(parts, changes, kinds).problems)


def _without(tree: Tree) -> Tree:
    """The file without its parts."""
    children = {key: node for key, node in (tree.root.children or {}).items() if key not in WORDS}
    return with_root(tree, replace(tree.root, children=children))


class _Writer:
    """Writes calculations into the tree of a file."""

    def __init__(self, tree: Tree, parts: MachineParts, elements: Elements) -> None:
        self.tree, self.parts, self.elements = tree, parts, elements

    def written(self, made: list[Element]) -> Tree:
        """Return the file with the calculations beside its mechanisms."""
        root = self.tree.root
        mechanisms = (root.children or {})["mechanisms"]
        blocks: dict[str | int, YamlNode] = dict(mechanisms.children or {})
        for name, fills in self.elements.fills.items():
            if name in blocks:
                blocks[name] = self._filled(blocks[name], fills, (self.parts.mechanisms[name],))
        for element in made:
            blocks[element.name] = self._node({"kind": element.kind} | element.inputs, element.path, (element.kind,))
        positions = mechanisms.key_positions | {each.name: self.tree.key_position(each.path) for each in made}
        home = replace(mechanisms, children=blocks, key_positions=positions)
        children = {key: node for key, node in (root.children or {}).items() if key not in WORDS} | {"mechanisms": home}
        return with_root(self.tree, self._resolved(replace(root, children=children)))

    def _filled(self, block: YamlNode, fills: Mapping[str, Any], home: tuple[str, ...]) -> YamlNode:
        """A mechanism's block with what the parts give it; what it gives itself stays."""
        children: dict[str | int, YamlNode] = dict(block.children or {})
        for key, value in fills.items():
            children.setdefault(key, self._node(value, ("machine",), (*home, key)))
        return replace(block, children=children)

    def _node(self, value: Any, path: KeyPath, key: tuple[str, ...]) -> YamlNode:
        """A value as it stands at a path; ``key`` is the kind of mechanism that it is given to, and the input without places in lists."""
        position = self.tree.position(path)
        match value:
            case Typed(path=there, text=text):
                place = self.tree.position(there)
                return self._based(YamlNode(place, text, text) if text else self.tree.node(there), place, key)
            case dict():
                children: dict[str | int, YamlNode] = {
                    name: self._node(part, path, (*key, name)) for name, part in value.items()
                }
                return YamlNode(position, children=children, key_positions=dict.fromkeys(children, position))
            case list():
                parts: dict[str | int, YamlNode] = {i: self._node(part, path, key) for i, part in enumerate(value)}
                return YamlNode(position, children=parts, is_list=True)
            case bool():
                return YamlNode(position, value, str(value).lower())
        return YamlNode(position, value, str(value))

    def _based(self, node: YamlNode, place: tuple[int, int], key: tuple[str, ...]) -> YamlNode:
        """A typed number with the basis of all parts, where it does not say its own.

        A drawing of the machine founds its dimensions alone: what asks for a basis (a strength, a factor of a method) has its own or none.
        """
        basis, note = self.parts.keys.basis, self.parts.keys.note
        number = isinstance(node.scalar, int | float) and not isinstance(node.scalar, bool)
        is_quantity = number or (isinstance(node.scalar, str) and node.scalar[:1].isdigit() and " " in node.scalar)
        if basis is None or not is_quantity or (basis != ASSUMED and asks_basis(key[0], ".".join(key[1:]))):
            return node
        children: dict[str | int, YamlNode] = {"value": node, "basis": YamlNode(place, basis, basis)}
        if note:
            children["note"] = YamlNode(place, note, note)
        return YamlNode(place, children=children, key_positions=dict.fromkeys(children, place))

    # References to parts.

    def _resolved(self, node: YamlNode) -> YamlNode:
        if node.children is not None:
            return replace(node, children={key: self._resolved(child) for key, child in node.children.items()})
        if not isinstance(node.scalar, str) or not REFERENCE.search(node.scalar):
            return node
        whole = REFERENCE.fullmatch(node.scalar.strip())
        text = REFERENCE.sub(lambda match: self._stands_for(match[1], is_alone=bool(whole)), node.scalar)
        return replace(node, scalar=text, typed=text)

    def _stands_for(self, path: str, *, is_alone: bool) -> str:
        found = self._meant(path.split("."))
        if found is None:
            return f"${{{path}}}"
        return found if is_alone or SINGLE.fullmatch(found) else f"({found})"

    def _meant(self, parts: list[str]) -> str | None:
        shafts = self.parts.shafts
        match parts:
            case ["shafts", shaft, "speed"] if shaft in self.parts.ratios:
                return self.elements.speed(shaft)
            case ["shafts", name, "inertia" | "mass" as what] if name in shafts:
                return self.elements.whole(shafts[name], what)
            case ["shafts", name, "inertia_total"] if name in shafts:
                return self._total_inertia(shafts[name])
            case ["shafts", name, "bearings", bearing, what] if name in shafts:
                return self._of_bearing(shafts[name], bearing, what)
            case ["shafts", name, "parts", part, what] if name in shafts:
                return self._of_part(shafts[name], part, what)
            case ["shafts", name, "sections", index, what] if name in shafts:
                return f"${{{shafts[name].calculation}.sections.{index}.{what}}}"
            case [word, name, what] if word in WORDS:
                return self._of_join(word, name, what)
            case ["machine", what]:
                return f"${{machine_inertia.{what}}}"
        return None

    def _total_inertia(self, shaft: MachineShaft) -> str:
        """Everything that turns with a shaft, referred to it."""
        if shaft.name not in self.parts.ratios:
            return self.elements.whole(shaft, "inertia")
        return self.elements.inertia_of_steady(shaft.name, self.parts.ratios)

    def _of_bearing(self, shaft: MachineShaft, name: str, what: str) -> str | None:
        for part, end in zip(shaft.bearings, "ab", strict=False):
            if part.name == name and what == "reaction":
                return f"${{{shaft.calculation}.reaction_{end}}}"
            if part.name == name and what == "bore" and (bore := part.size("d")) is not None:
                return millimetres(bore)
        return None

    def _of_part(self, shaft: MachineShaft, name: str, what: str) -> str | None:
        part = next((each for each in shaft.parts if each.name == name), None)
        if part is None:
            return None
        if what == "position" and shaft.name in self.parts.lefts:
            return millimetres(self.parts.lefts[shaft.name] + part.keys.at)
        return self.elements._torque_reference(part) if what == "torque" else None

    def _of_join(self, word: str, name: str, what: str) -> str | None:
        join = next((each for each in self.parts.joins if (each.word, each.name) == (word, name)), None)
        if join is None:
            return None
        named = {("meshes", "ratio"): "mesh_ratio", ("meshes", "center_distance"): "center_distance", ("belts", "ratio"): "belt_ratio",
                 ("chains", "length"): "chain_length", ("chains", "mass"): "chain_mass"}  # fmt: skip
        if (word, what) in named:
            return f"${{drive_line.{name}_{named[word, what]}}}"
        if what in ("pitch_radius", "pitch_radius_1", "pitch_radius_2"):
            side = join.driven if what.endswith("2") else join.drivers
            return millimetres(join.radius(side[0])) if side else None
        if what == "shaft_load" and word == "belts" and (train := self.elements.named("drive_train")):
            return f"${{{train}.shaft_load}}"
        return None
