"""Single values as they are typed in YAML."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

from diecut_report.config.basis import ASSUMED
from diecut_report.config.yaml_tree import resolved
from diecut_report.contract.inputs import Quantity

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
    is_plain = (
        text != ""
        and text == text.strip()
        and text[0] not in AT_START
        and isinstance(resolved(text), str)
        and not any(mark in text for mark in (": ", " #", "\n"))
        and not text.endswith(":")
    )
    if not is_plain or (in_braces and any(letter in text for letter in IN_BRACES)):
        return json.dumps(text, ensure_ascii=False)
    return text
