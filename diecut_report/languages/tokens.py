"""Keys of configurations as words."""

from __future__ import annotations

import re

_TOKEN = re.compile(r"[a-z][a-z0-9]*(?:_[a-z0-9]+)+")


def worded(text: str) -> str:
    """Return a text input as words: ``cast_iron`` → cast iron, ``polynomial_345`` → polynomial 3-4-5; other texts as they are."""
    if not _TOKEN.fullmatch(text):
        return text
    return " ".join("-".join(part) if part.isdigit() else part for part in text.split("_"))
