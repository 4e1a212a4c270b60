"""All texts that a plugin's declarations bring into a report, in the order in which they are declared."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from typing import Any, NamedTuple, get_args

from diecut_report.contract.inputs import Block, meta_of, nested
from diecut_report.contract.mechanism import Comparison, Mechanism
from diecut_report.contract.spectra import Spectrum
from diecut_report.contract.steps import Case
from diecut_report.languages.phrases import PLACE, Phrase
from diecut_report.languages.tokens import worded
from diecut_report.standards import StandardSeries, StandardTable

SAID = frozenset({"title", "summary", "text", "absent", "description", "method", "otherwise", "words", "message", "demand_label",
                  "limit_label", "at_least_label", "consequence", "caption", "label", "assumptions"})  # fmt: skip
"""Fields of declared things that the report prints."""
ENTERED = frozenset({"chapters", "steps", "checks", "figures", "panels", "series", "levels", "marks", "spans", "groups", "cases", "heads",
                     "errata", "exports", "comparisons", "spectra", "table", "mechanism"})  # fmt: skip
"""Fields that hold further declared things."""

WORD = re.compile(r"[^\W\d_]{2,}")


class DeclaredText(NamedTuple):
    """Hold a text with what it is of, for whoever translates it."""

    text: str
    of: str


def texts(mechanism: Mechanism) -> Iterator[DeclaredText]:
    """Yield each text once: those of the mechanism, of its inputs, and of the comparisons that it declares."""
    seen = set()
    for found in (*inputs_texts(mechanism.inputs), *_of_declared(mechanism, mechanism.kind)):
        if found.text and found.text not in seen and is_text(found.text):
            seen.add(found.text)
            yield found


def is_text(text: str) -> bool:
    """Return whether there are words in it: not a symbol, a sign or a number alone."""
    return WORD.search(PLACE.sub(" ", text)) is not None


def inputs_texts(model: type[Block], prefix: str = "") -> Iterator[DeclaredText]:
    """Yield what inputs are, and in words what texts they may be."""
    for name, field in model.model_fields.items():
        meta, inner = meta_of(model, name), nested(field.annotation)
        if meta is not None:
            yield DeclaredText(meta.description, f"input {prefix}{name}")
            yield from (_option(text, f"{prefix}{name}") for text in _options(meta, field.annotation))
        if inner:
            yield from inputs_texts(inner[0], f"{prefix}{name}.")


def _options(meta: Any, annotation: Any) -> Iterator[str]:
    """The keys that may be given in place of a number, or as a text."""
    known = (*getattr(meta, "options", ()), *getattr(meta, "words", ()), *_literals(annotation))
    yield from (text for text in known if text.isidentifier() and text.islower())


def _literals(annotation: Any) -> Iterator[str]:
    for part in get_args(annotation):
        yield from [part] if isinstance(part, str) else _literals(part)


def _option(key: str, home: str) -> DeclaredText:
    return DeclaredText(worded(key), f"{key}, a text of {home}")


def _of_declared(declared: Any, told: str) -> Iterator[DeclaredText]:
    if isinstance(declared, Comparison):
        yield from texts(declared.mechanism)
    elif isinstance(declared, StandardTable | StandardSeries):
        yield from _of_table(declared)
    elif isinstance(declared, Mapping):
        for part in declared.values():
            yield from _of_declared(part, told)
    elif isinstance(declared, tuple | list) and not hasattr(declared, "_fields"):
        for part in declared:
            yield from _of_declared(part, told)
    else:
        yield from _of_fields(declared, f"{_kind(declared)} {getattr(declared, 'id', '')}".strip() or told)


def _of_table(declared: StandardTable | StandardSeries) -> Iterator[DeclaredText]:
    """What a table of the plugin's own is; those of the program it translates itself."""
    if not declared.is_of_the_program:
        title = declared.title  # of the series that a column is: both, each by itself
        parts = title.values if isinstance(title, Phrase) else {}
        yield DeclaredText(parts.get("title", title), "table")
        yield DeclaredText(parts.get("column", ""), "column of a table")
        yield DeclaredText(declared.only_source, "why a table has one source only")


def _kind(declared: Any) -> str:
    return type(declared).__name__.lower()


def _of_fields(declared: Any, told: str) -> Iterator[DeclaredText]:
    for name in _names(declared):
        value = getattr(declared, name)
        if name in SAID:
            yield from (DeclaredText(text, told) for text in ([value] if isinstance(value, str) else value))
        elif name == "bars":
            yield from (DeclaredText(label, told) for label, _ in value)
        elif isinstance(declared, Case) and isinstance(value, str):  # what a choice gives
            yield DeclaredText(worded(value), told)
        elif name in ENTERED:
            yield from _of_declared(value, told)
    if isinstance(declared, Spectrum):
        yield from (DeclaredText(line.description, told) for line in declared.lines())


def _names(declared: Any) -> tuple[str, ...]:
    if is_dataclass(declared):
        return tuple(field.name for field in fields(declared))
    return getattr(declared, "_fields", ())
