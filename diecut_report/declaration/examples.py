"""Examples name keys that there are, with values that these take."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from diecut_report.contract.example import ExampleBlock, ForEach, Wired, kinds_named
from diecut_report.contract.inputs import Block, Quantity, Text, meta_of, nested
from diecut_report.contract.mechanism import Mechanism
from diecut_report.declaration.names import DeclaredNames
from diecut_report.declaration.words import Fault
from diecut_report.errors import nearest
from diecut_report.languages.phrases import Phrase, phrase

NAME = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")


def faults(mechanism: Mechanism, names: DeclaredNames) -> Iterator[Fault]:
    """Yield the keys of an example that name no input, and the values that an input does not take."""
    example: Any = mechanism.example
    if example is None:
        return
    if not isinstance(example, ExampleBlock):
        text = Phrase('has example={example}; write ExampleBlock("name", {"key": "10 mm"})', example=repr(example))
        yield Fault(mechanism.at, Phrase("mechanism {kind}", kind=mechanism.kind), text)
        return
    if not NAME.fullmatch(example.name):
        text = phrase("is not a name of a mechanism: a letter, then letters, digits, _ and - are allowed")
        yield Fault(example.at, Phrase("example {name}", name=repr(example.name)), text)
    subject = Phrase("example {name}", name=example.name)
    for key, words in _wrong(mechanism.inputs, example.inputs, ""):
        yield Fault(example.at, subject, Phrase("{key} {text}", key=key, text=words))


def _wrong(model: type[Block], data: Mapping[str, Any], path: str) -> Iterator[tuple[str, str]]:
    for key, value in data.items():
        if key not in model.model_fields:
            yield f"{path}{key}", Phrase("names no input{nearest}", nearest=nearest(key, model.model_fields))
            continue
        block, meta = nested(model.model_fields[key].annotation), meta_of(model, key)
        for each in _values(value):
            if block and isinstance(each, dict):
                yield from _wrong(block[0], each, f"{path}{key}.")
            elif isinstance(meta, Quantity | Text) and (text := _refused(meta, each)):
                yield f"{path}{key}", text


def _values(value: Any) -> Iterator[Any]:
    """The values that may stand there, and the parts of those that are lists."""
    match value:
        case Wired():
            yield from _values(value.value)
            yield from _values(value.otherwise)
        case ForEach():
            yield from _values(value.part)
        case list() | tuple():
            for part in value:
                yield from _values(part)
        case _:
            yield value


def _refused(meta: Quantity | Text, value: Any) -> str:
    """What is wrong with a value that refers to nothing, in words."""
    if isinstance(value, dict) and isinstance(meta, Quantity):
        value = value.get("value")
    if value is None or (isinstance(value, str) and ("${" in value or any(kinds_named(value)))):
        return ""
    if isinstance(meta, Text) and not meta.options:
        return ""
    others = [replace(meta, unit=unit, units=()) for _, unit in meta.units] if isinstance(meta, Quantity) else []
    found = [_fault(each, value) for each in (meta, *others)]
    return found[0] if all(found) else ""


def _fault(meta: Quantity | Text, value: Any) -> str:
    try:
        meta.validate(value)
    except ValueError as fault:
        return str(fault)
    return ""
