"""Steps that do not apply to a machine: those that stand one after the other in one sentence, not in a line each."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from typing import Any

Data = Mapping[str, Any]


def gathered_notes(items: Sequence[Data | None]) -> list[Data | None]:
    """Return the steps in their places; the notes of one kind that follow each other stand as one in the first's place."""
    found: list[Data | None] = []
    for said, group in groupby(items, key=_said):
        run = list(group)
        found += list(_as_one(said, run)) if said and len(run) > 1 else run
    return found


def under_heading(absent: Sequence[Data], heading: str) -> list[Data]:
    """Return why parts are absent, without the words of the heading that stands above them; those for one reason in one line."""
    titles: dict[str, list[str]] = {}
    for told in absent:
        titles.setdefault(told["text"].removeprefix(f"{heading.lower()}: "), []).append(told["title"])
    return [{"title": "; ".join(named), "text": text} for text, named in titles.items()]


def _said(item: Data | None) -> str:
    """What a note says of its step, without its name; nothing of any other step."""
    if item is None or item["type"] != "note" or not item.get("description"):
        return ""
    name, text = f"{item['description']}: ", str(item["text"])
    return text.removeprefix(name) if text.startswith(name) else ""


def _as_one(said: str, notes: Sequence[Data | None]) -> Iterator[Data | None]:
    names = "; ".join(str(note["description"]) for note in notes if note)
    start = said.rstrip(".")
    yield {"type": "note", "text": f"{start[:1].upper()}{start[1:]}: {names}."}
    yield from (None for _ in notes[1:])
