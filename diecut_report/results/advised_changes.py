"""What the messages of failing checks advise to change, where they name a key of the mechanism and a value for it."""

from __future__ import annotations

import re
from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from types import MappingProxyType
from typing import Literal

QUANTITY = r"[-+]?\d[\d.]*(?:e[-+]?\d+)?(?: ?[^\s,;:()]+)?"
KEY = r"(?P<key>[a-z]\w*(?:\.\w+)*)"  # of a block or a part of a list by its path: bolt.diameter, sections.0.length
SET = re.compile(rf"\bset {KEY} to (?:(?P<sign>at least|at most) )?(?P<value>{QUANTITY}|true|false)")
BETWEEN = re.compile(rf"\bset {KEY} to between (?P<value>{QUANTITY}) and (?P<other>{QUANTITY})")
BESIDE = re.compile(rf"\bwith an? {KEY} of (?P<sign>at least|at most) (?P<value>{QUANTITY})")
CHOSEN = re.compile(rf"\({KEY}: (?P<value>true|false|[a-z]\w*)\)")
OTHER_WAY = re.compile(r"[,;] or (?:set|leave|take|make)\b|; or ")
NONE: Mapping[str, tuple[str, ...]] = MappingProxyType({})
END = re.compile(r"[.,;:]+$")

Sign = Literal["at least", "at most", "to", "between"]


@dataclass(frozen=True)
class AdvisedChange:
    """Hold what is advised: a key of the mechanism, a value as text, and whether it is a bound; ``other`` is the second of two."""

    key: str
    sign: Sign
    value: str
    other: str = ""


def advised_changes(
    message: str, keys: Container[str], texts: Mapping[str, tuple[str, ...]] = NONE
) -> list[list[AdvisedChange]]:
    """Return what a message advises, each of its ways by itself, the first one first; none where it names no key of these with a value.

    ``texts`` are the texts that keys may have, by the key (of a list without the number of the part): one of them may be advised
    as a number is.
    """
    patterns = (SET, BETWEEN, *(_set_text(key, own) for key, own in texts.items() if own))
    starts = [found.start() for pattern in patterns if (found := pattern.search(message))]
    if not starts:
        chosen = CHOSEN.search(message)
        is_known = chosen is not None and _is_of(chosen["key"], keys)
        return [[AdvisedChange(chosen["key"], "to", chosen["value"])]] if chosen and is_known else []
    ways = (list(_changes(way, keys, (*patterns, BESIDE))) for way in _ways(message[min(starts) :]))
    return [way for way in ways if way]


def _is_of(path: str, keys: Container[str]) -> bool:
    return path.partition(".")[0] in keys


def _ways(advice: str) -> Iterator[str]:
    """The parts of an advice of which one is enough."""
    start = 0
    for other in OTHER_WAY.finditer(advice):
        yield advice[start : other.start()]
        start = other.start() + 1
    yield advice[start:]


@cache
def _set_text(key: str, texts: tuple[str, ...]) -> re.Pattern[str]:
    """The way in which one of some texts is advised, the longest first."""
    known = "|".join(map(re.escape, sorted(texts, key=len, reverse=True)))
    path = r"\.(?:\d+\.)?".join(map(re.escape, key.split(".")))
    return re.compile(rf"\bset (?P<key>{path}) to (?P<sign>)(?P<value>{known})(?![\w-])")


def _changes(way: str, keys: Container[str], patterns: Iterable[re.Pattern[str]]) -> Iterator[AdvisedChange]:
    for pattern in patterns:
        for found in pattern.finditer(way):
            if _is_of(found["key"], keys):
                yield _change(found.groupdict())


def _change(found: Mapping[str, str | None]) -> AdvisedChange:
    key, value = found["key"] or "", END.sub("", found["value"] or "")
    if other := found.get("other"):
        return AdvisedChange(key, "between", value, END.sub("", other))
    sign: Sign = "at least" if found["sign"] == "at least" else "at most" if found["sign"] else "to"
    return AdvisedChange(key, sign, value)
