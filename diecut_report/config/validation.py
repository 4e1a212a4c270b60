"""Validates a block of the config against its model, and says in words, with positions, what is wrong with it."""

from __future__ import annotations

import re
from collections.abc import Callable, Container, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any, NamedTuple, get_args

from pydantic import ValidationError
from pydantic.fields import FieldInfo

from diecut_report.config.plugins import said
from diecut_report.config.yaml import KeyPath, Tree
from diecut_report.errors import PluginError, Problem, nearest
from diecut_report.mechanism.curve_inputs import CurveInput
from diecut_report.mechanism.inputs import Block, Meta, Quantity, meta_of, nested
from diecut_report.mechanism.names import Pending, Text
from diecut_report.quantities.units import pretty
from diecut_report.text.phrases import Phrase, message, phrase
from diecut_report.time_limit import in_time

MAX_QUOTED = 60  # characters of a given text that a message repeats
MAX_NAMED = 20  # entries of a table that a message names


@dataclass(frozen=True)
class ConfigPlace:
    """Where a block stands in the file."""

    tree: Tree
    root: KeyPath = ()
    listed: Mapping[KeyPath, KeyPath] = field(default_factory=dict)
    """Where keys stand whose values come in the list of another key."""
    elsewhere: Mapping[KeyPath, tuple[Tree, KeyPath]] = field(default_factory=dict)
    """Where keys stand whose values come from another file: a table of the user's."""
    named: Mapping[KeyPath, tuple[str, ...]] = field(default_factory=dict)
    """Names of entries of such tables that a key may have, beside its own texts."""

    def inner(self, key: KeyPath) -> KeyPath:
        """The path below this block; what stands in a value that is listed elsewhere stands there."""
        for length in range(len(key), 0, -1):
            if key[:length] in self.listed:
                return (*self.listed[key[:length]], *key[length:])
        return key

    def stands(self, key: KeyPath) -> tuple[Tree, KeyPath]:
        """The file that a key below this block stands in, and its path there."""
        own = self.inner(key)
        for length in range(len(own), 0, -1):
            if own[:length] in self.elsewhere:
                tree, path = self.elsewhere[own[:length]]
                return tree, (*path, *own[length:])
        return self.tree, (*self.root, *own)

    def typed(self, key: KeyPath) -> Any:
        """What was typed there."""
        tree, path = self.stands(key)
        return tree.typed(path)

    def problem(
        self, key: KeyPath, template: str, /, *, at_key: bool = False, within: int | None = None, **values: object
    ) -> Problem:
        """A problem of the value at ``key`` below this block (or of the key itself, or of a letter ``within`` its text)."""
        tree, path = self.stands(key)
        line, column = tree.key_position(path) if at_key else tree.position(path)
        column += tree.offset(path, within) if within else 0
        return Problem(message(template, values), tree.file, line, column, ".".join(map(str, path)))

    def absent(self, key: KeyPath, template: str, /, **values: object) -> Problem:
        """A problem of a key that is not there; its place is the key of the block where it belongs."""
        tree, home = self.stands(key[:-1]) if self.elsewhere else (self.tree, (*self.root, *key[:-1]))
        line, column = tree.key_position(home)
        return Problem(message(template, values), tree.file, line, column, ".".join(map(str, (*home, *key[-1:]))))


def spread_out(
    model: type[Block], data: Mapping[str, Any], place: ConfigPlace
) -> tuple[dict[str, Any], ConfigPlace, list[Problem]]:
    """The data with lists that stand for single keys under these, where these stand in the file, and what is wrong with it."""
    found, problems, listed = copied(dict(data)), list[Problem](), dict(place.listed)
    for own, block, home in list(blocks(model, found)):
        for key, single in own.spread.items():
            if not isinstance(block.get(key), list):
                continue
            values, path = block.pop(key), (*home, key)
            again = [name for name in single if block.get(name) is not None]
            if len(values) != len(single):
                count = {0: phrase("no values"), 1: "1 value"}.get(len(values), f"{len(values)} values")
                template = "has {given}; give one for all, or {count}: for {single}"
                problems.append(place.problem(path, template, given=count, count=len(single), single=", ".join(single)))
            elif again:
                template = "is a list for all of them, but {again} is given beside it; give the list, or single keys"
                problems.append(place.problem(path, template, again=" and ".join(again)))
            else:
                block |= zip(single, values, strict=True)
                listed |= {(*home, name): (*path, index) for index, name in enumerate(single)}
    return found, replace(place, listed=listed), problems


def validate(
    model: type[Block], data: Any, place: ConfigPlace, open_keys: Container[KeyPath] = ()
) -> tuple[Any | None, list[Problem]]:
    """The validated block, or None with the problems; what is wrong at ``open_keys`` cannot be judged yet and is left out."""
    chosen = list(_choices(model, data, place))
    try:
        with in_time():
            block = model.model_validate(data)
        return (None, chosen) if chosen else (block, [])
    except ValidationError as error:
        faults = [_Fault(model, place, fault) for fault in error.errors(include_url=False)]
        return None, chosen + [fault.problem() for fault in faults if fault.key not in open_keys]
    except Exception as cause:  # of a validator of the plugin's own
        message = Phrase("its inputs {name__} cannot be validated: {said}", name__=model.__name__, said=said(cause))
        raise PluginError(message, instance=str(place.root[-1])) from cause


def _choices(model: type[Block], data: Any, place: ConfigPlace) -> Iterator[Problem]:
    """What is wrong with inputs of which one group is needed, in a block and the blocks in it."""
    for own, block, key in blocks(model, data):
        given = [name for name, value in block.items() if value not in (None, [])]
        texts = {name: block.get(name, field.default) for name, field in own.model_fields.items()}
        for fault in filter(None, (rule.fault(given) for rule in own.one_of if rule.is_asked(texts))):
            yield place.problem(key, fault, at_key=True)


class ModelKey(NamedTuple):
    """A key of a block: its field, what it declares, and the block that it holds (or a list of it)."""

    field: FieldInfo
    meta: Meta | None
    block: type[Block] | None
    is_list: bool

    @property
    def default(self) -> Any:
        """Return the default of the key; None where it has none."""
        return None if self.field.is_required() else self.field.get_default(call_default_factory=True)


@cache
def keys_of(model: type[Block]) -> dict[str, ModelKey]:
    """The keys of a block by their names."""
    found = {}
    for name, declared_as in model.model_fields.items():
        block, is_list = nested(declared_as.annotation) or (None, False)
        found[name] = ModelKey(declared_as, meta_of(model, name), block, is_list)
    return found


def blocks(model: type[Block], data: Any, key: KeyPath = ()) -> Iterator[tuple[type[Block], dict[str, Any], KeyPath]]:
    """Yield a block and all blocks that stand in it, each with its model and its key."""
    if not isinstance(data, dict):
        return
    yield model, data, key
    for name, (_, _, block, is_list) in keys_of(model).items():
        if block and name in data:
            given = data[name]
            parts = enumerate(given) if is_list and isinstance(given, list) else [(None, given)]
            for index, part in parts:
                yield from blocks(block, part, (*key, name) if index is None else (*key, name, index))


def copied(data: Any) -> Any:
    """Return plain data with dicts and lists of its own."""
    if isinstance(data, dict):
        return {key: copied(part) for key, part in data.items()}
    return [copied(part) for part in data] if isinstance(data, list) else data


def value_at(data: Any, path: KeyPath) -> Any:
    """Return what stands at a path in plain data; None where nothing does."""
    for part in path:
        known = part in data if isinstance(data, dict) else isinstance(data, list) and part in range(len(data))
        data = data[part] if known else None
    return data


def as_typed(model: type[Block], data: Any, place: ConfigPlace) -> Any:
    """Return the data with its texts as they were typed: a document number 0012 or a date stays as it is."""
    typed = copied(data)
    for own, block, key in blocks(model, typed):
        for name in block.keys() & keys_of(own).keys():
            annotation = keys_of(own)[name].field.annotation
            if str in (annotation, *get_args(annotation)) and not isinstance(block[name], dict | list | None):
                block[name] = place.typed((*key, name))
    return typed


def declared(model: type[Block], key: KeyPath) -> Meta | type[Block] | None:
    """What a key path names: an input's declaration, a block (or a list of blocks), or None where there is no such key."""
    name, *rest = key
    found = keys_of(model).get(name) if isinstance(name, str) else None
    if found is None:
        return None
    if found.block is None:
        return None if rest else found.meta
    if found.is_list and rest:
        if not isinstance(rest[0], int):
            return None
        rest = rest[1:]
    return declared(found.block, tuple(rest)) if rest else found.block


class _Fault:
    """One fault that pydantic found, in our words."""

    def __init__(self, model: type[Block], place: ConfigPlace, found: Mapping[str, Any]) -> None:
        self.model, self.place = model, place
        self.type: str = found["type"]
        self.key: KeyPath = found["loc"]
        self.given, self.context = found["input"], found.get("ctx", {})

    def problem(self) -> Problem:
        if self.type == "missing":
            return replace(self.place.absent(self.key, self._missing()), allowed=self._allowed())
        found = self.place.problem(self.key, self.message(), at_key=self.type == "extra_forbidden")
        return replace(found, allowed=self._allowed())

    def _allowed(self) -> str:
        meta = None if self.type == "extra_forbidden" or not self.key else declared(self.model, self.key)
        if isinstance(meta, Quantity):
            return meta.allowed
        return ", ".join(self._options()) if self.type in ("literal_error", "enum") else ""

    def message(self) -> str:
        words: dict[str, Callable[[], str]] = {
            "extra_forbidden": self._unknown_key,
            "value_error": lambda: str(self.context["error"]),
            "literal_error": self._choice,
            "enum": self._choice,
            "too_short": lambda: Phrase("has {actual_length} entries; at least {min_length} needed", self.context),
            "too_long": lambda: Phrase("has {actual_length} entries; at most {max_length} allowed", self.context),
            "string_too_short": lambda: phrase("is empty; give a text"),
        }
        return words.get(self.type, self._other)()

    def _missing(self) -> str:
        meta = declared(self.model, self.key)
        if isinstance(meta, Quantity | CurveInput):
            allowed = f" ({meta.allowed})" if isinstance(meta, Quantity) and meta.allowed else ""
            unit = pretty(meta.unit) or phrase("plain numbers")
            template = "is missing. Give it in {text}{allowed}: {description}."
            return Phrase(template, text=unit, allowed=allowed, description=phrase(meta.description))
        described = ": " + phrase(meta.description) if isinstance(meta, Text) else ""
        return Phrase("is missing; it is required{described}.", described=described)

    def _unknown_key(self) -> str:
        home = declared(self.model, self.key[:-1]) if len(self.key) > 1 else self.model
        known = list(home.model_fields) if isinstance(home, type) else []
        if self.given is None and re.match(r"\d", str(self.key[-1])):
            comma = phrase("YAML separates entries in braces at each comma; write a decimal point, as in {gap: 0.5 mm}")
            return Phrase("is the remainder of a number with a decimal comma: {words}.", words=comma)
        own = ["kind"] if self.place.root[:1] == ("mechanisms",) and len(self.key) == 1 else []
        template = "is an unknown key{nearest}. Known keys: {own}."
        return Phrase(template, nearest=nearest(str(self.key[-1]), known), own=", ".join(own + known))

    def _options(self) -> list[str]:
        expected = str(self.context["expected"]).replace(" or ", ", ")
        choices = [choice.strip("'") for choice in expected.split(", ")]
        return [*choices, *self.place.named.get(self.key, ())[:MAX_NAMED]]

    def _choice(self) -> str:
        choices = self._options()
        near = nearest(self.given, choices) if isinstance(self.given, str) and self.given not in choices else ""
        template = "is {given}{near}; allowed: {choices}"
        return Phrase(template, given=quoted(self.given), near=near, choices=", ".join(choices))

    def _other(self) -> str:
        meta = declared(self.model, self.key) if self.key else None
        if isinstance(self.given, Pending):
            number = phrase("is a text")
            if self.given.unit:
                what = phrase("curve") if self.given.is_curve else phrase("number")
                number = Phrase("is a {text} in {unit}", text=what, unit=self.given.unit)
            needed: str = self._needed(meta)
            if self.type.startswith("string") and isinstance(meta, Text):
                needed = Phrase("a text ({description})", description=phrase(meta.description))
            template = "${{path}} {number}; {needed} is needed here"
            return Phrase(template, path=self.given.path, number=number, needed=needed)
        if self.given is None:
            return Phrase("has no value; {needed} is needed, or remove the key", needed=self._needed(meta))
        return Phrase("is {given}; {needed} is needed", given=quoted(self.given), needed=self._needed(meta))

    def _needed(self, meta: Meta | type[Block] | None) -> str:
        kinds = {"bool": phrase("true or false"), "int": phrase("a whole number"), "float": phrase("a number"),
                 "string": phrase("a text"), "list": phrase("a list"), "dict": phrase("a block of keys"),
                 "model": phrase("a block of keys")}  # fmt: skip
        if known := kinds.get(self.type.split("_")[0]):
            return known
        if isinstance(meta, Text):
            return Phrase("another value ({description})", description=phrase(meta.description))
        return phrase("another value")


def quoted(given: Any) -> str:
    """A given value in a message: texts in quotes and cut where they are long, lists and blocks named only."""
    match given:
        case None:
            return "empty"
        case bool():
            return str(given).lower()
        case str():
            return f"“{given}”" if len(given) <= MAX_QUOTED else f"“{given[: MAX_QUOTED - 1]}…”"
        case list():
            return phrase("a list")
        case dict():
            return phrase("a block of keys")
    return f"{given}"


# What a value rests on: a quantity as a block ``{value: 0.8 kg*m**2, basis: assumed, note: …}``, and the weakest of a chain.


ASSUMED, GIVEN = "assumed", "given"
BASES = (ASSUMED, GIVEN, "catalogue", "drawing", "standard", "measured")
"""From the weakest to the strongest: an assumption can be anything; what is only given says nothing of where it comes from; a
maker's catalogue tells what is sold, a drawing what is to be made, a standard what is agreed, a measurement what is there."""
OF_ONE_VALUE = ("catalogue", "standard", "measured")
"""What founds the value that was looked up alone: another one in its place is assumed. What a drawing says is the designer's own to change."""
KEYS = ("value", "basis", "note", "beyond")
LEAST_REASON = 20  # characters of a reason for a value beyond what any machine has


@dataclass(frozen=True)
class Basis:
    """Hold what a value rests on ("" where that is not said), what the user notes of it, and why it is beyond what is possible elsewhere."""

    basis: str = ""
    note: str = ""
    beyond: str = ""


def is_founded(basis: str, note: str) -> bool:
    """Return whether somebody can look a value up: measured, on a drawing, or by a standard or a catalogue that the note names."""
    return basis in ("measured", "drawing") or (basis in ("standard", "catalogue") and names_something(note))


def names_something(text: str) -> bool:
    """Return whether a text can name where a value comes from: it holds a word, two letters or digits side by side."""
    return re.search(r"[^\W_]{2}", text) is not None


def weakest(bases: Iterable[str]) -> str:
    """Return the weakest basis; nothing where there are none."""
    return min(bases, key=BASES.index, default="")
