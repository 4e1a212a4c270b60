"""A configuration that begins with chosen kinds: which mechanisms it has, their values, and its text."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from diecut_report.config.draft_layout import (
    BlockWriter,
    DraftLine,
    completed,
    laid_out,
    remarks,
    required,
    shifted,
    typed,
)
from diecut_report.config.loader import RESERVED, free_name, name_fault
from diecut_report.config.model import PressBlock, Project
from diecut_report.config.plugins import Discovery, DuplicateKind, UnknownKind
from diecut_report.config.validation import keys_of
from diecut_report.errors import MAX_MECHANISMS, PluginError, Problem, UserError
from diecut_report.mechanism.inputs import Block
from diecut_report.mechanism.mechanism import KIND, ForEach, Mechanism, Wired, kinds_named
from diecut_report.quantities.units import number_and_unit
from diecut_report.text.catalogues import SOURCE_LANGUAGE
from diecut_report.text.phrases import Phrase
from diecut_report.text.translation import said, say, spoken_language

# What a configuration is to begin with: mechanisms of chosen kinds, each with a name of its own.


@dataclass(frozen=True)
class Drafted:
    """Hold a mechanism that is to be written: its name, its kind, and what its plugin declares."""

    name: str
    kind: str
    mechanism: Mechanism


def chosen(given: Sequence[str], discovery: Discovery) -> list[Drafted]:
    """Return the mechanisms of texts such as ``clutch`` or ``clutch:main``; UserError with all that is wrong with them."""
    parts = [text.partition(":") for text in given]
    found, problems, asked = [], list[Problem](), [name for _, colon, name in parts if colon]
    for name in dict.fromkeys(asked):
        if fault := name_fault(name):
            problems.append(Problem(fault))
        elif asked.count(name) > 1:
            template = "the name {name} is given to several mechanisms. Choose another one."
            problems.append(Problem(Phrase(template, name=repr(name))))
    if len(given) > MAX_MECHANISMS:
        template = "{count} mechanisms are requested; a configuration has at most {most}."
        problems.append(Problem(Phrase(template, count=len(given), most=MAX_MECHANISMS)))
    names = {name for _, _, name in parts if name}
    for kind, _, name in parts:
        try:
            mechanism = discovery.mechanism(kind)
        except (UnknownKind, DuplicateKind) as fault:
            problems.append(Problem(str(fault)))
            continue
        own = name or _free_name(mechanism, names)
        names.add(own)
        found.append(Drafted(own, kind, mechanism))
    if problems:
        raise UserError(dict.fromkeys(problems))
    return found


def _free_name(mechanism: Mechanism, names: Iterable[str]) -> str:
    """Return a name that no other mechanism has: that of its example, else its kind, numbered from the second on."""
    return free_name(mechanism.example.name if mechanism.example else mechanism.kind, {*names, *RESERVED})


# Fills an example with what the other mechanisms of a draft give: names in the place of kinds, other values where a kind is absent.


@dataclass(frozen=True)
class LeftOut:
    """Stand for a value that is left out; mechanisms of these ``kinds`` would give it, where that is told."""

    kinds: tuple[str, ...] = ()


def _lacking(value: LeftOut) -> float:
    """How many mechanisms would have to be added for a value: of several ways the one with the fewest is taken."""
    return len(value.kinds) or math.inf


class NeedsKind(LookupError):
    """Report that a mechanism cannot be without one of another ``kind``."""

    def __init__(self, asking: Drafted, kind: str) -> None:
        super().__init__(f"{asking.name} needs {kind}")
        self.asking, self.kind = asking, kind


@dataclass(frozen=True)
class Wiring:
    """Knows the names of the mechanisms of each kind, and which of them the example is of."""

    names: Mapping[str, Sequence[str]]
    own: Drafted

    def inputs(self, data: Mapping[str, Any]) -> dict[str, Any]:
        """Return the values of a mechanism's keys; NeedsKind where one that is needed comes from a kind that is not there."""
        model, found = self.own.mechanism.inputs, {}
        for key, value in data.items():
            known = keys_of(model).get(key)
            made = self.value(value, known.block if known else None)
            if not isinstance(made, LeftOut):
                found[key] = made
            elif known and known.field.is_required() and made.kinds:
                raise NeedsKind(self.own, made.kinds[0])
        return found

    def value(self, value: Any, model: type[Block] | None) -> Any:
        """Return what stands for a declared value, ``LeftOut`` where nothing does."""
        match value:
            case Wired():
                return self._wired(value, model)
            case str():
                if missing := self._missing(kinds_named(value)):
                    return LeftOut(missing)
                return KIND.sub(lambda found: self._name(found[1]), value)
            case dict():
                return self._block(value, model)
            case list() | tuple():
                made = [each for part in value for each in self._parts(part, model)]
                found = [part for part in made if not isinstance(part, LeftOut)]
                return min(made, key=_lacking) if made and not found else found
        return value

    def _wired(self, wired: Wired, model: type[Block] | None) -> Any:
        missing = self._missing(wired.kinds)
        if wired.value is None and not missing:
            return LeftOut()
        made = LeftOut(missing) if missing else self.value(wired.value, model)
        if not isinstance(made, LeftOut) or wired.otherwise is None:
            return made
        other = self.value(wired.otherwise, model)
        return min(made, other, key=_lacking) if isinstance(other, LeftOut) else other

    def _block(self, data: Mapping[str, Any], model: type[Block] | None) -> Any:
        known = keys_of(model) if model else {}
        found: dict[str, Any] = {}
        for key, value in data.items():
            made = self.value(value, known[key].block if key in known else None)
            if not isinstance(made, LeftOut):
                found[key] = made
            elif key not in known or known[key].field.is_required():
                return made
        return found

    def _parts(self, part: Any, model: type[Block] | None) -> list[Any]:
        if not isinstance(part, ForEach):
            return [self.value(part, model)]
        names = self.names.get(part.kind, ())
        one_by_one = [replace(self, names={**self.names, part.kind: (name,)}) for name in names]
        return [wiring.value(part.part, model) for wiring in one_by_one] or [LeftOut((part.kind,))]

    def _missing(self, kinds: Iterable[str]) -> tuple[str, ...]:
        """Those of these kinds that are not there."""
        return tuple(kind for kind in kinds if kind != self.own.kind and not self.names.get(kind))

    def _name(self, kind: str) -> str:
        """The mechanism of a kind: the first belongs to the first, the second to the second; of the own kind the own one."""
        if kind == self.own.kind:
            return self.own.name
        names = self.names[kind]
        own = self.names[self.own.kind]
        place = own.index(self.own.name) if self.own.name in own else 0
        return names[min(place, len(names) - 1)]


PRESS: Mapping[str, Any] = {
    "productivity": "6000 1/h",
    "sheet": {"length": "700 mm", "width": "470.7 mm", "thickness": "0.6 mm"},
}
"""The press of source 000; an example may be made for another one."""


@dataclass(frozen=True)
class Draft:
    """Hold the text of a configuration, and what is to be told of it.

    ``added`` are mechanisms that others cannot be without, each with the one that asks for it; ``guessed`` the keys whose values no
    example gives, ``open`` those that have no value.
    """

    text: str
    added: tuple[tuple[Drafted, Drafted], ...]
    guessed: tuple[str, ...]
    open: tuple[str, ...]


def _wire(
    mechanisms: list[Drafted], discovery: Discovery
) -> tuple[dict[str, dict[str, Any]], list[tuple[Drafted, Drafted]]]:  # fmt: skip
    """Return the values of all mechanisms by their names; those that they cannot be without are added, and returned with who asks."""
    added: list[tuple[Drafted, Drafted]] = []
    while True:
        names: dict[str, list[str]] = {}
        for each in mechanisms:
            names.setdefault(each.kind, []).append(each.name)
        given = [(each, each.mechanism.example.inputs if each.mechanism.example else {}) for each in mechanisms]
        try:
            return {each.name: Wiring(names, each).inputs(inputs) for each, inputs in given}, added
        except NeedsKind as need:
            asking = need.asking
            try:
                mechanism = discovery.mechanism(need.kind)
            except (UnknownKind, DuplicateKind) as fault:
                message = Phrase("its example requires another mechanism: {fault}", fault=str(fault))
                raise PluginError(message, asking.kind, asking.name) from fault
            new = Drafted(_free_name(mechanism, [each.name for each in mechanisms]), need.kind, mechanism)
            mechanisms.append(new)
            added.append((new, asking))


def draft(given: Sequence[str], discovery: Discovery, file: str = "my_press.yaml") -> Draft:
    """Return a configuration of mechanisms such as ``clutch`` and ``clutch:main``, in the language that is spoken.

    ``file`` is what it is to be called.
    """
    mechanisms = chosen(given, discovery)
    wired, added = _wire(mechanisms, discovery)
    values = {each.name: completed(each.mechanism.inputs, wired[each.name]) for each in mechanisms}
    guessed = [f"{name}.{key}" for name, found in values.items() for key in found if key not in wired[name]]
    needed = [(each.name, key) for each in mechanisms for key in required(each.mechanism.inputs)]
    lacking = [f"{name}.{key}" for name, key in needed if key not in values[name]]
    text = "\n".join([*_head(mechanisms, file), *_mechanisms(mechanisms, values)]) + "\n"
    return Draft(text, tuple(added), tuple(guessed), tuple(lacking))


# --- text ------------------------------------------------------------------------------------------------------------


def _head(mechanisms: Sequence[Drafted], file: str) -> Iterator[str]:
    titles = [said(each.mechanism.title, each.kind) for each in mechanisms]
    yield from remarks("\n".join(dict.fromkeys(titles)))
    yield "#"
    yield f"#   diecut-report report {file} -o build"
    yield "#"
    yield from remarks(say(
        "Each line has a key, its value, and its symbol, meaning and range. A quantity carries its unit (40 mm, 0.07 m, 21 kN); a bare "
        "number is in the unit that stands here. {reference} takes a number or a curve of another mechanism or of the press. Values with "
        "`basis: assumed` are those of an example: put in your own, without the braces, and the report no longer counts them as assumed. "
        "Lines behind # are optional: remove the first # of such a line, and put in a value where … stands.",
        reference="${NAME.QUANTITY}",
    ))  # fmt: skip
    yield ""
    yield "schema_version: 1"
    yield ""
    language = {} if spoken_language() == SOURCE_LANGUAGE else {"language": spoken_language()}
    project = {"title": say("New press"), **language}
    yield from _block("project", say("title block of each sheet"), Project, project)
    yield ""
    yield from _block("press", say("data shared by all mechanisms"), PressBlock, _press(mechanisms))


def _press(mechanisms: Sequence[Drafted]) -> dict[str, Any]:
    """The values of the press: of those that the examples are made for the least, with which all of them can run."""
    found: dict[str, Any] = {"name": say("My press"), **PRESS, "sheet": dict(PRESS["sheet"])}
    examples = [each.mechanism.example.press for each in mechanisms if each.mechanism.example]
    for path in dict.fromkeys(path for press in examples for path in press):
        home, _, key = path.rpartition(".")
        block = found[home] if home else found
        block[key] = min(
            (press.get(path, block[key]) for press in examples), key=lambda text: number_and_unit(str(text))[0]
        )
    return found


def _block(name: str, words: str, model: type[Block], data: Mapping[str, Any]) -> Iterator[str]:
    writer = BlockWriter()
    off = list(writer.off(model, data))
    if model is Project:  # whose list of revisions stands in one line
        single = [key for key, known in keys_of(Project).items() if known.block is None]
        off = [line for line in off if line.code.partition(":")[0] in single]
    yield f"{name}: # {words}"
    yield from laid_out(list(shifted([*writer.given(model, data), *off], 2)))


def _mechanisms(mechanisms: Sequence[Drafted], values: Mapping[str, Mapping[str, Any]]) -> Iterator[str]:
    yield ""
    yield "mechanisms:"
    for number, each in enumerate(mechanisms):
        if number:
            yield ""
        yield from remarks(f"{said(each.mechanism.title, each.kind)}. {said(each.mechanism.summary, each.kind)}", 2)
        yield f"  {each.name}:"
        writer = BlockWriter(each.mechanism)
        kind = DraftLine(f"kind: {typed(each.kind)}")
        body = [kind, *writer.lines(each.mechanism.inputs, values[each.name])]
        yield from laid_out(list(shifted(body, 4)))
