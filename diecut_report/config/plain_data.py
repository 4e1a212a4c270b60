"""Plain data of a file: dicts, lists and scalars."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from diecut_report.config.yaml_tree import KeyPath


def texts(data: Any, key: KeyPath = ()) -> Iterator[tuple[KeyPath, str]]:
    """Every text in plain data, with its key path."""
    if isinstance(data, str):
        yield key, data
    elif isinstance(data, dict | list):
        for name, part in data.items() if isinstance(data, dict) else enumerate(data):
            yield from texts(part, (*key, name))
