"""A configuration that begins with chosen kinds: which mechanisms it has, their values, and its text with a comment beside each key."""

from __future__ import annotations

import json
import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from textwrap import wrap
from typing import Any, Literal, get_args, get_origin

from diecut_report.config.loader import RESERVED, free_name, name_fault
from diecut_report.config.model import PressBlock, Project
from diecut_report.config.plugins import Discovery, DuplicateKind, UnknownKind
from diecut_report.config.validation import ASSUMED, ModelKey, keys_of
from diecut_report.config.yaml import resolved
from diecut_report.declaration.inputs import fault_of
from diecut_report.errors import MAX_MECHANISMS, PluginError, Problem, UserError
from diecut_report.mechanism.curve_inputs import CurveInput, PhaseInput
from diecut_report.mechanism.inputs import Block, Quantity
from diecut_report.mechanism.mechanism import KIND, ForEach, Mechanism, Wired, kinds_named
from diecut_report.mechanism.names import Text
from diecut_report.quantities.units import number_and_unit, pretty
from diecut_report.text.catalogues import SOURCE_LANGUAGE
from diecut_report.text.phrases import Phrase
from diecut_report.text.translation import localised, said, say, spoken_language

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
        given = (press.get(path, block[key]) for press in examples)
        block[key] = min(given, key=lambda text: number_and_unit(str(text))[0])
    return found


def _block(name: str, words: str, model: type[Block], data: Mapping[str, Any]) -> Iterator[str]:
    writer = BlockWriter()
    off = list(writer.off(model, data))
    if model is Project:  # whose list of revisions stands in one line
        off = [line for line in off if (known := keys_of(Project).get(line.code.partition(":")[0])) and not known.block]
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


# Values for what a kind must have and its example does not give: of plugins without an example, to be replaced by one's own.

SIZES = (10, 100, 1, 0.5, 0.1, 20, 50, 1000, 0.01)  # in the key's display unit, which is one of handy numbers
WAVE = [0, 1, 0, -1]  # of a curve over one period


def completed(model: type[Block], data: Mapping[str, Any]) -> dict[str, Any]:
    """Return the values of a block with guesses for the keys that it lacks; what cannot be guessed is left out."""
    texts = {name: data.get(name, known.field.default) for name, known in keys_of(model).items()}
    rules = [rule for rule in model.one_of if not rule.optional and rule.is_asked(texts)]
    lacking = [rule for rule in rules if not any(data.keys() & set(group) for group in rule.groups)]
    wanted = [*required(model), *(key for rule in lacking for key in rule.groups[0])]  # the first alternative
    guesses = {key: guess for key in wanted if key not in data and (guess := guessed(keys_of(model)[key])) is not None}
    return {**data, **guesses}


def guessed(known: ModelKey) -> Any:
    """Return a value that a key may have by its declaration alone; None where it must be a reference."""
    if known.block:
        block = completed(known.block, {})
        return [block] if known.is_list else block
    match known.meta:
        case Quantity() as meta:
            size = next((size for size in SIZES if not fault_of(meta, size)), None)
            return size if size is None or meta.unit == "1" else f"{size} {meta.unit}"
        case CurveInput(referred=False):
            return list(WAVE)
        case Text() as meta:
            # the first of the texts that are allowed, "no" of yes and no, else a text that says that it is one's own
            is_flag = bool in _parts(known.field.annotation)
            return next(iter(options(known)), False if is_flag else "A")
    return None


def options(known: ModelKey) -> Collection[str]:
    """Return the texts that a key may have; nothing where it takes any."""
    if isinstance(known.meta, Text) and known.meta.options:
        return known.meta.options
    return [option for part in _parts(known.field.annotation) for option in get_args(part) if option is not None]


def _parts(annotation: Any) -> list[Any]:
    if get_origin(annotation) is Literal or not get_args(annotation):
        return [annotation]
    return [each for part in get_args(annotation) for each in _parts(part)]


def required(model: type[Block]) -> list[str]:
    """Return the keys that a block must have."""
    return [name for name, known in keys_of(model).items() if known.field.is_required()]


# Lines of a configuration with a comment beside each, in two columns.


UNBROKEN = "\N{NO-BREAK SPACE}"  # where a line is not to end; a plain space in the file
LINE_WIDTH, MAX_CODE_WIDTH, MIN_COMMENT_WIDTH = 150, 66, 60  # letters


@dataclass(frozen=True)
class DraftLine:
    """Hold a line of a configuration and what is said of it; one that is ``off`` is a comment itself, to be turned on."""

    code: str
    comment: str = ""
    indent: int = 0
    off: bool = False

    @property
    def text(self) -> str:
        """Return the line without its comment."""
        return " " * self.indent + ("# " if self.off else "") + self.code


def laid_out(lines: Sequence[DraftLine]) -> Iterator[str]:
    """Yield the lines of a block, their comments below each other; a long comment goes on in the next lines."""
    lengths = [len(line.text) for line in lines if line.comment and len(line.text) <= MAX_CODE_WIDTH]
    column = max(lengths, default=0) + 2
    for line in lines:
        yield from _with_comment(line, column)


def remarks(text: str, indent: int = 0) -> Iterator[str]:
    """Yield a text as lines of comment."""
    for paragraph in text.split("\n"):
        head = " " * indent + "# "
        yield from (f"{head}{part}" for part in wrap(paragraph, LINE_WIDTH - len(head), break_long_words=False) or [""])


def _with_comment(line: DraftLine, column: int) -> Iterator[str]:
    if not line.comment:
        yield line.text
        return
    start = max(column, len(line.text) + 2)
    width = max(MIN_COMMENT_WIDTH, LINE_WIDTH - start - 2)
    parts = wrap(line.comment, width, break_long_words=False, break_on_hyphens=False)
    heads = (line.text.ljust(start), *(" " * start for _ in parts[1:]))
    yield from (f"{head}# {part}".replace(UNBROKEN, " ") for head, part in zip(heads, parts, strict=True))


def shifted(lines: Iterable[DraftLine], by: int, *, off: bool = False) -> Iterator[DraftLine]:
    """Yield lines of a block within another one; ``off`` turns them into comments, whose indents stay behind the mark."""
    for line in lines:
        commented = replace(line, indent=by, code=" " * line.indent + line.code, off=True)
        yield commented if off else replace(line, indent=line.indent + by)


# Single values as they are typed in YAML.


IN_BRACES = ",[]{}"
AT_START = "!&*-?:|>%@`\"'#[]{}, "


def typed(value: Any, *, in_braces: bool = False) -> str:
    """Return a value as YAML: texts in quotes where they would be read as something else, lists and blocks in one line."""
    match value:
        case bool():
            return str(value).lower()
        case str():
            return _text(value, in_braces)
        case Mapping():
            return "{" + ", ".join(f"{key}: {typed(part, in_braces=True)}" for key, part in value.items()) + "}"
        case Sequence():
            return "[" + ", ".join(typed(part, in_braces=True) for part in value) + "]"
    return f"{value:g}" if isinstance(value, float) else str(value)


def with_basis(meta: Any, value: Any) -> Any:
    """Return a number of an example as a block that says that it is assumed; what refers to something else, or is a word, as it stands."""
    if not isinstance(meta, Quantity) or isinstance(value, bool | list):
        return value
    if isinstance(value, Mapping):
        return {**value, "basis": value.get("basis", ASSUMED)} if "value" in value else value
    if isinstance(value, str) and ("${" in value or value in meta.words):
        return value
    return {"value": value, "basis": ASSUMED}


def _text(text: str, in_braces: bool) -> str:
    is_bare = text == text.strip() and text[:1] not in AT_START and isinstance(resolved(text), str)
    marks = (": ", " #", "\n", *(IN_BRACES if in_braces else ()))
    is_plain = is_bare and not text.endswith(":") and not any(mark in text for mark in marks)
    return text if is_plain else json.dumps(text, ensure_ascii=False)


# What is said of a key beside it: symbol, meaning, what is allowed, its default, and what is not checked without it.


OPEN = "…"  # stands for a value that is one's own to give


def sample(known: ModelKey) -> str:
    """Return what stands behind a key that is not given: its default with its unit, else a place to fill."""
    found, meta = known.default, known.meta
    if isinstance(meta, Quantity):
        if found is None and meta.press is not None and meta.press.formula is None:
            return f"${{{meta.press.path}}}"
        value = OPEN if found is None else found
        shown = typed(value if isinstance(value, str) else float(value))
        return shown if meta.unit == "1" or value in meta.words else f"{shown} {meta.unit}"
    if found not in (None, "", []):
        return typed(found)
    if isinstance(meta, CurveInput):
        return "${" + OPEN + "}"
    return "${" + OPEN + ".phases." + OPEN + "}" if isinstance(meta, PhaseInput) else OPEN


def _others(model: type[Block], name: str, given: Collection[str]) -> list[str]:
    """The given keys of another alternative, beside which a key has no use."""
    for rule in model.one_of:
        own = [group for group in rule.groups if name in group]
        if own and name not in rule.shared and not any(set(group) <= set(given) for group in own):
            found = [key for group in rule.groups if group not in own and set(group) <= set(given) for key in group]
            if found := [key for key in found if key not in rule.shared]:
                return found
    return []


STEP = 2


@dataclass(frozen=True)
class BlockWriter:
    """Writes the keys of blocks of one kind, explained in the language that is spoken; without a mechanism those of the press."""

    mechanism: Mechanism | None = None

    def lines(
        self, model: type[Block], data: Mapping[str, Any], path: str = "", *, is_told: bool = True
    ) -> Iterator[DraftLine]:
        """Yield the lines of a block: its values and, where these are explained, the keys that it does not have, turned off."""
        yield from self.given(model, data, path, is_told=is_told)
        yield from self.off(model, data, path) if is_told else ()

    def given(
        self, model: type[Block], data: Mapping[str, Any], path: str = "", *, is_told: bool = True
    ) -> Iterator[DraftLine]:
        """Yield the keys that have a value, in the order in which they are declared."""
        for name, known in keys_of(model).items():
            if name not in data:
                continue
            words = self.words(model, name, data, path) if is_told else ""
            if known.block is None:
                yield DraftLine(f"{name}: {typed(with_basis(known.meta, data[name]))}", words)
                continue
            yield DraftLine(f"{name}:", words)
            for number, part in enumerate(data[name] if known.is_list else [data[name]]):  # the first explains all
                inner = self.lines(known.block, part, f"{path}{name}.", is_told=is_told and number == 0)
                yield from shifted(_as_part(list(inner)) if known.is_list else inner, STEP)

    def off(self, model: type[Block], data: Mapping[str, Any], path: str = "") -> Iterator[DraftLine]:
        """Yield the keys that a block does not have, as comments to be turned on."""
        for name in keys_of(model):
            if name not in data:
                yield from shifted(self._off(model, name, data, path), 0, off=True)

    def _off(self, model: type[Block], name: str, data: Mapping[str, Any], path: str) -> Iterator[DraftLine]:
        known, words = keys_of(model)[name], self.words(model, name, data, path)
        if known.block is None:
            yield DraftLine(f"{name}: {sample(known)}", words)
            return
        yield DraftLine(f"{name}:", words)
        own = f"{path}{name}."
        inner = [line for key in keys_of(known.block) for line in self._off(known.block, key, {}, own)]
        yield from shifted(_as_part(inner) if known.is_list else inner, STEP)

    def words(self, model: type[Block], name: str, given: Collection[str], path: str) -> str:
        """Return what is said of a key of a block; ``given`` are the keys that the block has."""
        known = keys_of(model)[name]
        symbol, described = getattr(known.meta, "symbol", ""), getattr(known.meta, "description", "")
        meaning = ": ".join(filter(None, (symbol, said(described, self.mechanism.kind if self.mechanism else ""))))
        return "; ".join(filter(None, (meaning, *self._more(model, known, name, given, path))))

    def _more(self, model: type[Block], known: ModelKey, name: str, given: Collection[str], path: str) -> Iterator[str]:
        meta = known.meta
        if isinstance(meta, Quantity) and meta.allowed:
            in_typed_units = meta.allowed.replace(pretty(meta.unit) or "\0", meta.unit)
            yield localised(in_typed_units).replace(" ", UNBROKEN)
        if allowed := options(known):
            yield say("one of {options}", options=", ".join(map(str, allowed)))
        if name in given:
            return
        if known.field.is_required():
            yield say("required")
            return
        if others := _others(model, name, given):
            yield say("instead of {keys}", keys=", ".join(others))
        if known.default not in (None, []):
            yield say("default")
        elif isinstance(meta, Quantity) and meta.press is not None:
            yield say("default: from {path}", path=meta.press.path)
        elif titles := self._checks(f"{path}{name}"):
            yield say("if omitted, not checked: {titles}", titles=", ".join(titles))

    def _checks(self, key: str) -> list[str]:
        """The titles of the checks that a key alone makes possible: it is their limit, or one of their needs."""
        if self.mechanism is None:
            return []
        checks = [check for check in self.mechanism.checks if key == check.limit or key in check.needs]
        return list(dict.fromkeys(said(check.title, self.mechanism.kind) for check in checks))


def _as_part(lines: Sequence[DraftLine]) -> Iterator[DraftLine]:
    """The lines of a part of a list, the first behind a dash."""
    yield from (replace(line, code=f"- {line.code}") for line in lines[:1])
    yield from (replace(line, indent=line.indent + STEP) for line in lines[1:])
