"""What the messages of failing checks advise to change, where they name a key of the mechanism and a value for it."""

from __future__ import annotations

import re
from collections.abc import Container, Iterator
from dataclasses import dataclass
from typing import Literal

QUANTITY = r"[-+]?\d[\d.]*(?:e[-+]?\d+)?(?: ?[^\s,;:()]+)?"
SET = re.compile(rf"\bset (?P<key>[a-z]\w*) to (?:(?P<sign>at least|at most) )?(?P<value>{QUANTITY}|true|false)")
BESIDE = re.compile(rf"\bwith an? (?P<key>[a-z]\w*) of (?P<sign>at least|at most) (?P<value>{QUANTITY})")
CHOSEN = re.compile(r"\((?P<key>[a-z]\w*): (?P<value>true|false|[a-z]\w*)\)")
OTHER_WAY = re.compile(r"[,;] or (?:set|leave|take|make)\b|; or ")
END = re.compile(r"[.,;:]+$")

Sign = Literal["at least", "at most", "to"]


@dataclass(frozen=True)
class AdvisedChange:
    """Hold what is advised: a key of the mechanism, a value as text, and whether it is a bound."""

    key: str
    sign: Sign
    value: str


def advised_changes(message: str, keys: Container[str]) -> list[AdvisedChange]:
    """Return what a message advises by its first way, of several; nothing where it names no key of these with a value."""
    start = SET.search(message)
    if start is None:
        chosen = CHOSEN.search(message)
        is_known = chosen is not None and chosen["key"] in keys
        return [AdvisedChange(chosen["key"], "to", chosen["value"])] if chosen and is_known else []
    rest = message[start.start() :]
    other = OTHER_WAY.search(rest)
    way = rest[: other.start()] if other else rest
    return list(_changes(way, keys))


def _changes(way: str, keys: Container[str]) -> Iterator[AdvisedChange]:
    for pattern in (SET, BESIDE):
        for found in pattern.finditer(way):
            if found["key"] in keys:
                sign: Sign = "at least" if found["sign"] == "at least" else "at most" if found["sign"] else "to"
                yield AdvisedChange(found["key"], sign, END.sub("", found["value"]))
