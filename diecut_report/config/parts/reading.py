"""Reads the parts of a file: texts such as ``60x320 r1`` taken apart, expressions calculated, and all that is wrong told with its place."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from decimal import Decimal
from functools import cached_property
from types import MappingProxyType
from typing import Any, NamedTuple

from diecut_report.config.instances import BlockData
from diecut_report.config.model import PressBlock
from diecut_report.config.own_tables import OwnTables
from diecut_report.config.parts.keys import (
    PART_KINDS,
    WORDS,
    BeltKeys,
    ChainKeys,
    MachineKeys,
    MeshKeys,
    PartKeys,
    PinKeys,
    ShaftKeys,
    size,
)
from diecut_report.config.references import WHOLE
from diecut_report.config.validation import ConfigPlace, copied, declared, quoted, spread_out, validate, value_at
from diecut_report.config.yaml import KeyPath, Position, Scalar, Tree, key_of, resolved
from diecut_report.errors import Problem, lookalikes
from diecut_report.formulas.condition_parts import Name, read_expression
from diecut_report.formulas.conditions import ConditionError
from diecut_report.mechanism.inputs import Block, Meta, Quantity
from diecut_report.quantities.units import UnitError, number_and_unit, unit
from diecut_report.text.phrases import Phrase, phrase

_NUMBER = r"\d+(?:\.\d*)?|\.\d+"
SECTION = re.compile(
    rf"(?P<diameter>{_NUMBER})(?:/(?P<bore>{_NUMBER}))?x(?P<length>{_NUMBER})(?: +r(?P<fillet_radius>{_NUMBER}))?",
    re.ASCII,
)
"""A section as a text, mm: diameter, bore behind a stroke, length, and the fillet at its right end."""
COORDINATE = size("x", "Place of an axis", plausible=("1 um", "100 m"))
BODY = {
    "mass": Quantity("m", "kg", "Mass of a part", ge=0),
    "inertia": Quantity("J", "kg*m**2", "Moment of inertia of a part", ge=0),
}
MODELS: Mapping[str, type[Block]] = {"shafts": ShaftKeys, "meshes": MeshKeys, "chains": ChainKeys, "belts": BeltKeys}


class _TwoNumbers(NamedTuple):
    """Hold a key whose text holds two numbers, the keys of these, how it is written, and how many of the numbers are needed."""

    key: str
    single: tuple[str, str]
    form: str
    least: int = 2


_TEETH = ("teeth_1", "teeth_2")
PAIRS: Mapping[type[Block], _TwoNumbers] = {
    MeshKeys: _TwoNumbers("teeth", _TEETH, phrase("two numbers of teeth with a stroke between them, such as 18/87")),
    ChainKeys: _TwoNumbers(
        "teeth", _TEETH, phrase("one number of teeth, or two with a stroke between them, such as 17/34"), least=1
    ),
    BeltKeys: _TwoNumbers(
        "diameters", ("diameter_1", "diameter_2"), phrase("two diameters with a stroke between them, such as 125/375")
    ),
}
TAKEN_APART = tuple(dict.fromkeys(pair.key for pair in PAIRS.values()))


class _Apart(NamedTuple):
    """Hold where the pieces of texts stand, the keys that are missing as a text cannot be taken apart, and why that is so."""

    listed: Mapping[KeyPath, KeyPath] = MappingProxyType({})
    missing: frozenset[KeyPath] = frozenset()
    problems: tuple[Problem, ...] = ()


@dataclass(frozen=True)
class ReadBlock:
    """Hold a block of parts: its path, what was read, and the keys that go on to the calculation made of it."""

    path: KeyPath
    keys: Any
    more: tuple[str, ...] = ()


@dataclass
class PartsReader:
    """Reads the blocks of parts of a file; ``problems`` is what is wrong with them, ``read`` what was asked for outside the parts."""

    tree: Tree
    data: Mapping[str, Any]
    models: Mapping[str, type[Block]]  # of the mechanisms, by their names
    tables: OwnTables = field(default_factory=OwnTables)
    problems: list[Problem] = field(default_factory=list)
    read: set[str] = field(default_factory=set)
    _known: dict[str, tuple[float, str] | ConditionError] = field(default_factory=dict)  # what typed values give

    def machine(self) -> ReadBlock | None:
        """Return the block ``machine``, whose keys go on to no calculation: an unknown one is refused."""
        return self._block(MachineKeys, self.data["machine"], ("machine",))

    def frame(self) -> dict[str, tuple[float, float]]:
        """Return the axes of the frame by their names, m."""
        found: dict[str, tuple[float, float]] = {}
        given = self.data["machine"].get("frame", {})
        if not isinstance(given, dict):
            self._fault(("machine", "frame"), "is {given}; axes are needed, NAME: [x, y]", given=quoted(given))
            return found
        for name, pair in given.items():
            path: KeyPath = ("machine", "frame", name)
            if not (isinstance(pair, list) and len(pair) == 2):
                self._fault(path, "is {given}; two numbers in mm are needed: [x, y]", given=quoted(pair))
                continue
            x, y = (self._coordinate((*path, index), value) for index, value in enumerate(pair))
            if x is not None and y is not None:
                found[name] = (x, y)
        return found

    def _coordinate(self, path: KeyPath, given: Any) -> float | None:
        try:
            value: float = COORDINATE.validate(self._calculated(given, path, COORDINATE))
        except (ValueError, ConditionError) as fault:
            told = fault.words if isinstance(fault, ConditionError) else fault.args[0]
            self.problems.append(ConfigPlace(self.tree).problem(path, told))
            return None
        return value

    def blocks(self, word: str) -> Iterator[tuple[str, ReadBlock]]:
        """Yield the blocks of shafts, meshes, chains or belts by their names."""
        given = self.data.get(word)
        if given is not None and not isinstance(given, dict):
            self._fault((word,), "is {given}; a block of names is needed, each with its keys", given=quoted(given))
            return
        for name, block in (given or {}).items():
            path: KeyPath = (word, name)
            if not isinstance(block, dict):
                self._fault(path, "is {given}; a block of keys is needed", given=quoted(block))
            elif found := self._block(MODELS[word], block, path):
                yield name, found

    def _block(self, model: type[Block], given: Mapping[str, Any], path: KeyPath) -> ReadBlock | None:
        place = ConfigPlace(self.tree, path)
        data = copied(dict(given))
        apart = _taken_apart(model, data, place)
        place = replace(place, listed={**place.listed, **apart.listed})
        goes_on = model is not MachineKeys
        own = {
            key: value for key, value in data.items() if not goes_on or key in model.model_fields or key in model.spread
        }
        if model is ShaftKeys and isinstance(own.get("parts"), list):
            own["parts"] = [_part(part) for part in own["parts"]]
        own, place, problems = spread_out(model, own, place)
        read = BlockData.read(model, own, place, self.tables)
        numbers = self._numbers(model, read.data, read.place, ())
        block, faults = validate(model, numbers, read.place, apart.missing)
        self.problems += [*apart.problems, *problems, *read.problems, *faults]
        more = tuple(key for key in given if key not in model.model_fields and key not in TAKEN_APART)
        return None if block is None or apart.problems else ReadBlock(path, block, more)

    def _numbers(self, model: type[Block], data: Any, place: ConfigPlace, key: KeyPath) -> Any:
        """The data with what its expressions give."""
        if isinstance(data, dict):
            return {name: self._numbers(model, part, place, (*key, name)) for name, part in data.items()}
        if isinstance(data, list):
            return [self._numbers(model, part, place, (*key, index)) for index, part in enumerate(data)]
        meta = declared(model, key) if isinstance(data, str) and "${" in data else None
        if not isinstance(meta, Quantity):
            return data
        try:
            return self._calculated(data, place.stands(key)[1], meta)
        except ConditionError as fault:
            self.problems.append(place.problem(key, fault.words))
            return 1.0

    def _calculated(self, given: Any, path: KeyPath, meta: Quantity) -> Any:
        """What an expression of typed numbers gives, in the unit of its key; all else as it is."""
        if not isinstance(given, str) or "${" not in given:
            return given
        values: dict[str, float] = {}

        def name(path: str) -> Name:
            value, si = self._typed(path.removeprefix("${").removesuffix("}"))
            values[path] = value
            return Name(path, "number", si)

        found = read_expression(given, name)
        if refused := found.refused(meta.unit):
            raise ConditionError(refused)
        number = found.known_value(values) / unit(meta.unit).factor
        return number if meta.unit == "1" else f"{number!r} {meta.unit}"

    def _typed(self, path: str) -> tuple[float, str]:
        """The number that is typed at a path, in SI, and its SI unit; ConditionError where none is.

        What it refers to is worked out before it, each once and to any depth.
        """
        waiting = [] if path in self._known else [path]
        while waiting:
            last = waiting[-1]
            ahead = next((each for each in self._referred(last) if each not in self._known), None)
            if ahead is None:
                self._known[waiting.pop()] = self._number(last)
            elif ahead in waiting:
                template = "{path} refers to itself; give one of these values a number."
                self._known[waiting.pop()] = ConditionError(template, path=ahead)
            else:
                waiting.append(ahead)
        found = self._known[path]
        if isinstance(found, ConditionError):
            raise found
        return found

    def _referred(self, path: str) -> list[str]:
        given = self._given(path)[1]
        return WHOLE.findall(given) if isinstance(given, str) else []

    def _given(self, path: str) -> tuple[KeyPath, Any, Meta | type[Block] | None]:
        """A path, what is typed there, and what its key declares."""
        key = key_of(path)
        given = value_at(self.data.get("mechanisms"), key) if key[0] not in self.data else value_at(self.data, key)
        known: dict[str, type[Block]] = {"press": PressBlock, **self.models}
        model = known.get(str(key[0]))
        meta = declared(model, key[1:]) if model and key[1:] else None
        return key, given.get("value") if isinstance(given, dict) else given, meta

    def _number(self, path: str) -> tuple[float, str] | ConditionError:
        key, given, meta = self._given(path)
        self.read.add(".".join(map(str, key)))  # lines.01 is lines.1
        if not isinstance(meta, Quantity) or given is None:
            template = "{path} is not a number that is typed; a dimension of a part must be known before anything is calculated."
            return ConditionError(template, path=path)
        try:
            value: float = meta.validate(self._calculated(given, key, meta))
        except ValueError as fault:
            return ConditionError(str(fault))
        return value, unit(meta.unit).si

    @cached_property
    def formulas(self) -> frozenset[Position]:
        """Return where in the file values stand that refer to others."""
        nodes, found = [self.tree.root], set[Position]()
        for node in nodes:
            nodes.extend((node.children or {}).values())
            if isinstance(node.scalar, str) and "${" in node.scalar:
                found.add(node.position)
        return frozenset(found)

    def typed_number(self, name: str, key: str) -> float | None:
        """Return a number that is typed in the block of a mechanism, SI; None where none is, or where it is calculated."""
        try:
            return self._typed(f"{name}.{key}")[0]
        except ConditionError:
            return None

    def typed_body(self, path: KeyPath, key: str) -> float | None:
        """Return the mass or inertia of a part that is typed at its path, in SI; None where none is, or where it refers to what is calculated."""
        given, meta = self._given_body(path, key), BODY[key]
        try:
            found = meta.validate(self._calculated(given, (*path, key), meta))
        except (KeyError, ValueError, ConditionError):  # what cannot be read is told where it is used
            return None
        return None if found is None else float(found)

    def is_of_results(self, path: KeyPath, key: str) -> bool:
        """Return whether the mass or inertia of a part refers to what is calculated."""
        return "${" in str(self._given_body(path, key)) and self.typed_body(path, key) is None

    def _given_body(self, path: KeyPath, key: str) -> Any:
        return typed_value(self.tree, (*path, key))

    def _fault(self, path: KeyPath, template: str, **values: object) -> None:
        self.problems.append(ConfigPlace(self.tree).problem(path, Phrase(template, **values)))


def _part(given: Any) -> Any:
    """The keys of a part that are its own: what else there is goes on to the calculation made of it."""
    if not isinstance(given, dict):
        return given
    named = {key: str(value) if key in PART_KINDS and isinstance(value, int) else value for key, value in given.items()}
    return {key: value for key, value in named.items() if key in PartKeys.model_fields}


def _taken_apart(model: type[Block], data: dict[str, Any], place: ConfigPlace) -> _Apart:
    """Take the texts of the data apart."""
    if model is ShaftKeys:
        return _sections(data, place)
    return _pair(data, place, PAIRS[model]) if model in PAIRS else _Apart()


def _sections(data: dict[str, Any], place: ConfigPlace) -> _Apart:
    given = data.get("sections")
    if not isinstance(given, str):
        return _Apart()
    found, problems, offset = list[dict[str, float]](), list[Problem](), 0
    for index, text in enumerate(given.split(",")):
        if matched := SECTION.fullmatch(text.strip()):
            found.append({key: float(value) for key, value in matched.groupdict().items() if value})
        else:
            problems.append(_unreadable_section(place, index + 1, text.strip(), offset))
        offset += len(text) + 1
    data["sections"] = found
    listed: dict[KeyPath, KeyPath] = {("sections", index): ("sections",) for index in range(len(found))}
    return _Apart(listed, frozenset([("sections",)]) if problems else frozenset(), tuple(problems))


# Other values in the places of the parts.


def place_of(data: Mapping[str, Any], path: str) -> KeyPath:
    """Return the place in a file that a path of the parts names, ``shafts.main.parts.wheel.hub``: a part by its name or its number."""
    key = key_of(path)
    rows = value_at(data, key[:3]) if key[0] == "shafts" and key[2:3] == ("parts",) else None
    for index, row in enumerate(rows if isinstance(rows, list) else ()):
        if isinstance(row, dict) and key[3:4] and str(key[3]) in {str(row[kind]) for kind in PART_KINDS if kind in row}:
            return (*key[:3], index, *key[4:])
    return key


def typed_changes(tree: Tree, changes: Mapping[KeyPath, Scalar]) -> dict[KeyPath, Scalar]:
    """Return changes of values by where these are typed: of one within a text (``60x320 r1``, ``18/87``, ``[15, 75]``) the text or its place."""
    found: dict[KeyPath, Scalar] = {}
    for asked, value in changes.items():
        path = _listed(tree, asked)
        home = _text_around(path)
        typed = found.get(home, tree.typed(home)) if home else None
        if home is not None and isinstance(typed, str):
            found[home] = _with_number(tree, home, typed, path, str(value))
        else:
            found[(*path, "value") if value_at(tree.data, (*path, "value")) is not None else path] = value
    return found


def typed_value(tree: Tree, path: KeyPath) -> Any:
    """Return what is typed at a place of the parts, also within a text; None where nothing is."""
    path = _listed(tree, path)
    given = value_at(tree.data, path)
    if given is None and (home := _text_around(path)):
        return _numbers_of(home, value_at(tree.data, home)).get(path)
    return given.get("value") if isinstance(given, dict) else given


def typed_places(tree: Tree) -> Iterator[KeyPath]:
    """Yield the places of the parts at which something is typed; of a text of several numbers those of these."""
    for word in WORDS:
        yield from _typed_places((word,), tree.data.get(word))


def _typed_places(path: KeyPath, data: Any) -> Iterator[KeyPath]:
    if isinstance(data, dict | list) and not (isinstance(data, dict) and "value" in data):
        for key, inner in data.items() if isinstance(data, dict) else enumerate(data):
            yield from _typed_places((*path, key), inner)
    elif data is not None:
        yield from _numbers_of(path, data) or (path,)


def _listed(tree: Tree, path: KeyPath) -> KeyPath:
    """The place of a value, which may stand in the span of a pin."""
    ends, span = PinKeys.spread["span"], (*path[:-1], "span")
    return (*span, ends.index(str(path[-1]))) if path[-1] in ends and value_at(tree.data, span) is not None else path


def _text_around(path: KeyPath) -> KeyPath | None:
    """Where a text stands that may hold the number of a place: that of the sections of a shaft, or of a pair of numbers."""
    if path[0] == "shafts" and path[2:3] == ("sections",) and len(path) > 3:
        return path[:3]
    pair = _pair_at(path)
    return (*path[:2], pair.key) if pair and path[-1] in pair.single else None


def _numbers_of(path: KeyPath, given: Any) -> dict[KeyPath, str]:
    """The numbers that a text of several holds, by their places; a single one of a pair counts for both."""
    if path[0] == "shafts" and path[2:] == ("sections",):
        every = (SECTION.fullmatch(each.strip()) for each in str(given).split(","))
        rows = ((index, each.groupdict()) for index, each in enumerate(every) if each)
        return {(*path, index, key): number for index, row in rows for key, number in row.items() if number}
    pair = _pair_at(path)
    if pair is None or path[-1] != pair.key or given is None:
        return {}
    numbers = [each.strip() for each in str(given).split("/")]
    return {(*path[:2], key): numbers[index % len(numbers)] for index, key in enumerate(pair.single)}


def _with_number(tree: Tree, home: KeyPath, typed: str, path: KeyPath, text: str) -> str:
    """A text of several numbers with another one at a place."""
    pair, key = _pair_at(path), str(path[-1])
    if pair is None:
        return _section_text(typed, int(path[3]), key, text)
    numbers = [each.strip() for each in typed.split("/")]
    if len(numbers) < len(pair.single) and (key != pair.single[0] or value_at(tree.data, (*home[:2], "to"))):
        numbers *= 2  # one number for both
    numbers[pair.single.index(key)] = _bare(text)
    return "/".join(numbers)


def typed_text(tree: Tree, path: KeyPath) -> str | None:
    """Return what is typed at a place of a file as it stands there, of the parts also within a text; None where nothing is."""
    given = next((text for place in (path, (*path, "value")) if (text := tree.typed(place)) is not None), None)
    if given is not None or path[0] not in WORDS:
        return given
    found = typed_value(tree, path)
    return None if found is None else str(found)


def _pair_at(path: KeyPath) -> _TwoNumbers | None:
    """The text of two numbers that may stand beside a place, or there."""
    model = MODELS.get(str(path[0])) if len(path) == 3 else None
    return None if model is None else PAIRS.get(model)


def _bare(text: str) -> str:
    """A number as it stands in a text of several: teeth, or a length in mm, with all digits and without an exponent."""
    try:
        number, own = number_and_unit(text)
    except UnitError:  # which is told where the text is read
        return text
    return f"{Decimal(repr(unit('mm').from_si(unit(own).to_si(number)))).normalize():f}" if own else text


def _section_text(sections: str, index: int, key: str, text: str) -> str:
    """The text of sections with another number in one of them."""
    every = [each.strip() for each in sections.split(",")]
    matched = SECTION.fullmatch(every[index])
    if matched is None:  # as a value before it could not be read, which is told
        return sections
    own = {name: value for name, value in matched.groupdict().items() if value} | {key: _bare(text)}
    bore, fillet = (
        f"{sign}{own[name]}" if name in own else "" for sign, name in (("/", "bore"), (" r", "fillet_radius"))
    )
    every[index] = f"{own['diameter']}{bore}x{own['length']}{fillet}"
    return ", ".join(every)


def _unreadable_section(place: ConfigPlace, number: int, text: str, offset: int) -> Problem:
    template = (
        "has as section {number} {text}, which cannot be read; write diameter x length in mm, and r with the fillet at its right end: "
        "60x320 r1, or 60/30x320 where it is bored{seeming}"
    )
    letters = lookalikes(text)
    seeming = Phrase(" ({letters} only looks Latin)", letters=letters) if letters else ""
    return place.problem(("sections",), template, within=offset, number=number, text=quoted(text), seeming=seeming)


def _pair(data: dict[str, Any], place: ConfigPlace, pair: _TwoNumbers) -> _Apart:
    """Put two numbers with a stroke between them, or a single one, under keys of their own."""
    given = data.pop(pair.key, None)
    if given is None:
        return _Apart()
    texts = [text.strip() for text in str(given).split("/")]
    again = [name for name in pair.single if name in data]
    if again:
        problem = place.problem((pair.key,), "stands beside {again}; give one of them", again=" and ".join(again))
    elif not pair.least <= len(texts) <= len(pair.single) or not all(texts):
        problem = place.problem((pair.key,), "is {given}; write {form}", given=quoted(given), form=phrase(pair.form))
    else:
        data |= {name: resolved(text) for name, text in zip(pair.single, texts, strict=False)}
        return _Apart({(name,): (pair.key,) for name in pair.single})
    return _Apart({}, frozenset((name,) for name in pair.single), (problem,))
