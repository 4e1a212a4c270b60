"""Columns of numbers aligned on their decimal sign: how much room a number leaves behind itself."""

from __future__ import annotations

import re
from collections.abc import Sequence

_NUMBER = re.compile(r"[−-]?[\d\u202f]+(?:[.,](\d+))?")
_POWER = re.compile(r"[−-]?\d(?:[.,]\d+)?\u2009×\u200910[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+")
MOST = 8  # digits for which there is a class


def decimals(text: str) -> int | None:
    """How many digits a printed number has behind its decimal sign; None of words, of a dash, of a power of ten."""
    found = _NUMBER.fullmatch(text)
    return len(found[1] or "") if found else None


def is_power(text: str) -> bool:
    """Whether a text is a printed number with a power of ten."""
    return _POWER.fullmatch(text) is not None


def rooms(texts: Sequence[str]) -> list[str]:
    """The class of each text of a column: ``f2`` leaves room for two digits, ``w2`` for these and the decimal sign."""
    found = [decimals(text) for text in texts]
    most = max((count for count in found if count is not None), default=0)
    return [_room(count, most) for count in found]


def _room(count: int | None, most: int) -> str:
    if count is None or count == most:
        return ""
    return f"{'f' if count else 'w'}{min(most - count, MOST)}"
