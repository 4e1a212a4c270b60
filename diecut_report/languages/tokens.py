"""Keys of configurations as words."""

from __future__ import annotations

import re

NAMING = ("name", "mechanism")
"""The keys that say what a part of a list is called."""

_TOKEN = re.compile(r"[a-z][a-z0-9]*(?:_[a-z0-9]+)+")
_JOINED = re.compile(r"\bcrank (?=rocker\b|slider\b)")
_POWERS = re.compile(r"(?<=\bpolynomial )[0-9]+")


def worded(text: str) -> str:
    """Return a text input as words: ``stainless_304`` → stainless 304; other texts as they are.

    ``polynomial_345`` → polynomial 3-4-5, ``crank_rocker`` → crank-rocker.
    """
    if not _TOKEN.fullmatch(text):
        return text
    words = _JOINED.sub("crank-", text.replace("_", " "))
    return _POWERS.sub(lambda powers: "-".join(powers[0]), words)
