"""Names that a configuration gives: of mechanisms and of the parts of a list. They are printed as they are typed, in any language."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from diecut_report.languages.tokens import worded

Data = Mapping[str, Any]


def given_names(mechanism: Data, mechanisms: Collection[str]) -> frozenset[str]:
    """Return the names among the inputs of a mechanism: those of its parts, and of the ``mechanisms`` that it takes."""
    rows = mechanism.get("inputs", {}).values()
    return frozenset(
        text
        for row in rows
        for text in _texts(row["value"])
        if is_name(row) or (text in mechanisms and not _is_choice(row, text))
    )


def is_name(row: Data) -> bool:
    """Return whether an input is what a part of a list is called."""
    return bool(row.get("part", {}).get("quantity") == "name")


def value_in_words(row: Data, names: Collection[str] = ()) -> str:
    """Return the shown text of a quantity: a choice as words, a name, or what stands in the configuration elsewhere, as it is."""
    text: str = row["display"]["text"]
    is_taken = text == row.get("path") or (row.get("origin") == "given" and "text" not in row)  # a mechanism
    return text if is_name(row) or is_taken else in_words(text, names)


def in_words(text: str, names: Collection[str]) -> str:
    """Return a found text as words, unless it is one of the names: bearing main_b is called so wherever it stands."""
    return text if text in names else worded(text)


def _is_choice(row: Data, text: str) -> bool:
    """Whether an input is a word that was typed, such as a role, and no mechanism, though one may be called so."""
    return row.get("origin") == "given" and row.get("text") == text


def _texts(value: Any) -> list[str]:
    several = value if isinstance(value, list) else [value]
    return [each for each in several if isinstance(each, str)]
