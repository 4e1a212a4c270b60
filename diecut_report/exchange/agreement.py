"""Two results documents held against each other, value by value: how many numbers agree, how exactly, and which differ."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

CLOSE = 1e-9  # relative: other processors and libraries round differently in the last digits
NOISE = 1e-12  # of the greatest value of a list, below which nothing but rounding is left
TINY = 1e-15
ORDER = ("status", "summary", "governing", "inputs", "checks", "outputs", "values", "phases", "curves")
"""The parts of results from the most important on; what is not named here comes last."""
WORDS = ("text", "message")

Value = Any
NOWHERE = object()


@dataclass(frozen=True)
class Difference:
    """Hold a place of the results with what stands there in both; None where there is nothing."""

    path: str
    first: Value
    second: Value

    @property
    def order(self) -> tuple[int, bool]:
        """Return by what differences are sorted: the part of the results, and last the words, which follow from the numbers."""
        parts = self.path.split(".")
        named = [ORDER.index(part) for part in (parts[0], *parts[2:3]) if part in ORDER]
        return named[0] if named else len(ORDER), parts[-1] in WORDS


@dataclass
class Agreement:
    """Hold the count of the numbers, of those that are exactly alike, and what differs, the most important first."""

    numbers: int = 0
    exact: int = 0
    differences: list[Difference] = field(default_factory=list)

    @property
    def differing(self) -> int:
        """Return how many numbers differ."""
        return sum(_is_number(each.first) or _is_number(each.second) for each in self.differences)


def agreement(first: Mapping[str, Any], second: Mapping[str, Any]) -> Agreement:
    """Return how far two results documents agree."""
    made = Agreement()
    made.differences = sorted(_differences(first, second, "", made, 0.0), key=lambda each: each.order)
    return made


def _differences(a: Value, b: Value, path: str, made: Agreement, scale: float) -> Iterator[Difference]:
    if isinstance(a, dict) and isinstance(b, dict):
        for key in dict.fromkeys([*a, *b]):
            yield from _differences(a.get(key, NOWHERE), b.get(key, NOWHERE), _below(path, key), made, 0.0)
        yield from _order_of_keys(a, b, path)
    elif isinstance(a, list) and isinstance(b, list) and len(a) == len(b):
        scale = max((abs(each) for each in a if _is_number(each)), default=0.0)
        for index, pair in enumerate(zip(a, b, strict=True)):
            yield from _differences(*pair, _below(path, _named(pair[0], index)), made, scale)
    elif not _agree(a, b, made, scale):
        yield Difference(path, None if a is NOWHERE else a, None if b is NOWHERE else b)


def _order_of_keys(a: dict[str, Value], b: dict[str, Value], path: str) -> Iterator[Difference]:
    """What stands in another order is shown in another order."""
    orders = [[key for key in side if key in other] for side, other in ((a, b), (b, a))]
    if orders[0] != orders[1]:
        first = next(index for index, pair in enumerate(zip(*orders, strict=True)) if pair[0] != pair[1])
        yield Difference(_below(path, "(order)"), *(", ".join(order[first:]) for order in orders))


def _agree(a: Value, b: Value, made: Agreement, scale: float) -> bool:
    if not (_is_number(a) and _is_number(b)):
        return type(a) is type(b) and bool(a == b)
    made.numbers += 1
    made.exact += a == b
    return math.isclose(a, b, rel_tol=CLOSE, abs_tol=max(NOISE * scale, TINY))


def _is_number(value: Value) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _below(path: str, key: object) -> str:
    return f"{path}.{key}" if path else f"{key}"


def _named(part: Value, index: int) -> object:
    """What a part of a list is called: by its id, where it has one."""
    return part["id"] if isinstance(part, dict) and isinstance(part.get("id"), str) else index
