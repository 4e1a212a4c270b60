"""Inputs that nothing takes: somebody types them, and no result changes."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator
from dataclasses import fields as fields_of
from dataclasses import is_dataclass
from pathlib import Path
from typing import Any

from diecut_report.contract.inputs import Block, Text, fields, nested
from diecut_report.contract.mechanism import Mechanism
from diecut_report.contract.sections import taken
from diecut_report.contract.steps import Step
from diecut_report.declaration.input_places import of_input
from diecut_report.declaration.sources import own_files, parsed
from diecut_report.languages.phrases import Phrase
from diecut_report.quantities.formatting import NAMED

SAID = ("symbol", "unit", "description", "source", "title", "summary", "caption", "at", "kind", "version", "id")


def idle_inputs(mechanism: Mechanism) -> Iterator[str]:
    """Yield the numbers and curves among the inputs that nothing takes or names; a text may be there for the reader alone."""
    used = {name.removeprefix("inputs.").partition("=")[0] for name in _used(mechanism)}
    used |= {key for keys, singles in _spread(mechanism.inputs) if used.intersection(singles) for key in keys}
    told = _told_in_code(own_files(mechanism))
    for path, meta in fields(mechanism.inputs):
        if not isinstance(meta, Text) and path not in used and path.rpartition(".")[2] not in told:
            place = Path(of_input(mechanism.inputs, path, mechanism.at)).name
            yield Phrase(
                "{place}: input {path}: nothing takes it, so that it changes no result; take it in a step, or "
                "remove it",
                place=place,
                path=path,
            )


def _used(mechanism: Mechanism) -> Iterator[str]:
    """The names in all that is declared: of what is taken, of what switches it on, of what a message prints."""
    for chapter, step in mechanism.steps:
        yield from (*taken(step), *chapter.needs, *named_in(step))
    for parts in (mechanism.checks, mechanism.figures, mechanism.exports):
        yield from named_in(parts)
    for comparison in mechanism.comparisons:
        yield from (name for _, name in comparison.takes.values())
    yield from (key for _, meta in fields(mechanism.inputs) for key, _ in getattr(meta, "units", ()))


def named_in(declared: Any) -> Iterator[str]:
    """Yield the texts in something declared, but those for the reader, with the ``{ids}`` in them."""
    if isinstance(declared, str):
        yield declared
        yield from (found[1] for found in NAMED.finditer(declared))
    elif isinstance(declared, tuple | list):
        for part in declared:
            yield from named_in(part)
    elif is_dataclass(declared):
        for field in fields_of(declared):
            if field.name not in SAID and not (field.name == "cases" and isinstance(declared, Step)):
                yield from named_in(getattr(declared, field.name))


def _spread(model: type[Block], prefix: str = "") -> Iterator[tuple[set[str], set[str]]]:
    """Keys that stand for others, each with those."""
    for key, singles in model.spread.items():
        yield {prefix + key}, {prefix + single for single in singles}
    for name, declared in model.model_fields.items():
        inner = nested(declared.annotation)
        if inner:
            yield from _spread(inner[0], f"{prefix}{name}.")


def _told_in_code(files: Iterable[Path]) -> set[str]:
    """The words that code may ask by, as drawings and validators do: whole texts, their parts between dots, and attributes."""
    found: set[str] = set()
    for file in files:
        for node in ast.walk(parsed(file)):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                found.update(node.value.split("."))
            elif isinstance(node, ast.Attribute):
                found.add(node.attr)
    return found
