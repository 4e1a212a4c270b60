"""What is too much in a config: long texts, long lists, many mechanisms. Told before anything is made of it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from diecut_report.config.yaml_tree import KeyPath, Tree
from diecut_report.errors import TOLD, Problem
from diecut_report.languages.phrases import Phrase
from diecut_report.limits import MAX_CURVE_VALUES, MAX_MECHANISMS, MAX_PARTS, MAX_TEXT


def too_much(tree: Tree) -> list[Problem]:
    """Return what a config holds too much of, in words; the first of them where there are many."""
    found: list[Problem] = []
    for path, message in _excess(tree.data, ()):
        if len(found) == TOLD:
            return found
        line, column = tree.position(path)
        found.append(Problem(message, tree.file, line, column, _shown(path)))
    return found


def _excess(data: Any, path: KeyPath) -> Iterator[tuple[KeyPath, str]]:
    match data:
        case str() if len(data) > MAX_TEXT:
            yield (
                path,
                Phrase(
                    "has {count} characters; at most {max_text} are allowed. Shorten it.",
                    count=len(data),
                    max_text=MAX_TEXT,
                ),
            )
        case dict():
            if path == ("mechanisms",) and len(data) > MAX_MECHANISMS:
                yield (
                    path,
                    Phrase(
                        "has {count} mechanisms; at most {max_mechanisms} are allowed. Split the configuration.",
                        count=len(data),
                        max_mechanisms=MAX_MECHANISMS,
                    ),
                )
                return
            for key, part in data.items():
                if len(key) > MAX_TEXT:
                    yield (
                        (*path, key),
                        Phrase(
                            "is a key of {count} characters; at most {max_text} are allowed. Shorten it.",
                            count=len(key),
                            max_text=MAX_TEXT,
                        ),
                    )
                else:
                    yield from _excess(part, (*path, key))
        case list():
            most = MAX_PARTS if any(isinstance(part, dict | list) for part in data) else MAX_CURVE_VALUES
            if len(data) > most:
                yield (
                    path,
                    Phrase("has {count} entries; at most {most} are allowed. Give fewer.", count=len(data), most=most),
                )
                return
            for index, part in enumerate(data):
                yield from _excess(part, (*path, index))


def _shown(path: KeyPath) -> str:
    return ".".join(part if len(part := str(step)) <= MAX_TEXT else f"{part[:40]}…" for step in path)
