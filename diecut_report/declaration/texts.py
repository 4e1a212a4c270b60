"""All texts that a plugin's declarations bring into a report, in the order in which they are declared."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from typing import Any, NamedTuple

from diecut_report.contract.inputs import Block, meta_of, nested
from diecut_report.contract.mechanism import Comparison, Mechanism
from diecut_report.contract.spectra import Spectrum
from diecut_report.standards import StandardSeries, StandardTable

SAID = frozenset({"title", "summary", "text", "absent", "description", "method", "otherwise", "words", "message", "demand_label",
                  "limit_label", "at_least_label", "consequence", "caption", "label", "assumptions"})  # fmt: skip
"""Fields of declared things that the report prints."""
ENTERED = frozenset({"chapters", "steps", "checks", "figures", "panels", "series", "levels", "marks", "spans", "groups", "cases", "heads",
                     "errata", "exports", "comparisons", "spectra", "table", "mechanism"})  # fmt: skip
"""Fields that hold further declared things."""


class DeclaredText(NamedTuple):
    """Hold a text with what it is of, for whoever translates it."""

    text: str
    of: str


def texts(mechanism: Mechanism) -> Iterator[DeclaredText]:
    """Yield each text once: those of the mechanism, of its inputs, and of the comparisons that it declares."""
    seen = set()
    for found in (*_of_inputs(mechanism.inputs), *_of_declared(mechanism, mechanism.kind)):
        if found.text not in seen and is_text(found.text):
            seen.add(found.text)
            yield found


def is_text(text: str) -> bool:
    """Return whether there are words in it: not a symbol, a sign or a number alone."""
    return (
        any(part.isalpha() and len(part) > 1 for part in text.replace("-", " ").replace(".", " ").split())
        or " " in text
    )


def _of_inputs(model: type[Block], prefix: str = "") -> Iterator[DeclaredText]:
    for name, field in model.model_fields.items():
        meta, inner = meta_of(model, name), nested(field.annotation)
        if meta is not None:
            yield DeclaredText(meta.description, f"input {prefix}{name}")
        if inner:
            yield from _of_inputs(inner[0], f"{prefix}{name}.")


def _of_declared(declared: Any, told: str) -> Iterator[DeclaredText]:
    if isinstance(declared, Comparison):
        yield from texts(declared.mechanism)
    elif isinstance(declared, StandardTable | StandardSeries):
        yield DeclaredText(declared.title, "table")
    elif isinstance(declared, Mapping):
        for part in declared.values():
            yield from _of_declared(part, told)
    elif isinstance(declared, tuple | list):
        for part in declared:
            yield from _of_declared(part, told)
    else:
        yield from _of_fields(declared, f"{_kind(declared)} {getattr(declared, 'id', '')}".strip() or told)


def _kind(declared: Any) -> str:
    return type(declared).__name__.lower()


def _of_fields(declared: Any, told: str) -> Iterator[DeclaredText]:
    for name in _names(declared):
        value = getattr(declared, name)
        if name in SAID:
            yield from (DeclaredText(text, told) for text in ([value] if isinstance(value, str) else value))
        elif name == "bars":
            yield from (DeclaredText(label, told) for label, _ in value)
        elif (
            name == "value" and isinstance(value, str) and not value.isidentifier()
        ):  # a choice's text that is not a key
            yield DeclaredText(value, told)
        elif name in ENTERED:
            yield from _of_declared(value, told)
    if isinstance(declared, Spectrum):
        yield from (DeclaredText(line.description, told) for line in declared.lines())


def _names(declared: Any) -> tuple[str, ...]:
    if is_dataclass(declared):
        return tuple(field.name for field in fields(declared))
    return getattr(declared, "_fields", ())
