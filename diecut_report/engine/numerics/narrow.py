"""Where a condition may hold in a window that its difference does not show between the points of the search grid.

A difference such as ``exp(-((φ - φ_0)/w)²) - 1/2`` is the same at all points but for a place between two of them: nothing dips. What
goes into such functions does show the place. So each of their arguments is followed to where it comes nearest to zero
and to where it turns, and there the condition is asked. What curves do that a condition takes is not looked into.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache

import numpy as np

from diecut_report.engine.numerics.discontinuities import parts
from diecut_report.engine.numerics.gaps import nonzero
from diecut_report.expressions import Array, Node, symbols

FLATTENING = {"exp", "tanh", "arctan", "minimum", "maximum", "clip", "/", "^"}  # what levels off, or has a corner
ROUNDS, PARTS = (
    17,
    16,
)  # how often a place is looked for in so many parts of what is left: down to the rounding of a place

Value = Callable[[Node, Array, Array], Array]  # of a part of a condition, at places (rows, points) of some rows
Cells = tuple[Array, Array, Array]  # rows, and the two places (rows,) between which something is sought


@lru_cache(maxsize=4096)
def arguments(node: Node, varying: frozenset[str]) -> tuple[Node, ...]:
    """Return what goes into the functions of a condition where one of them levels off in what varies; nothing for all other conditions."""
    inner = [(_name(part), each) for side in parts(node) for part in _walk(side) for each in _taken(part)]
    found = [(name, each) for name, each in inner if varying.intersection(symbols(each))]
    return tuple(dict.fromkeys(each for _, each in found)) if FLATTENING.intersection(name for name, _ in found) else ()


def _walk(node: Node) -> Iterator[Node]:
    yield node
    for part in parts(node):
        yield from _walk(part)


def _name(node: Node) -> str:
    return str(node.args[0]) if node.op == "call" else node.op


def _taken(node: Node) -> Iterator[Node]:
    """What a function takes, or by how much two of its arguments differ: where they are equal is a corner."""
    match node:
        case Node("call", ("minimum" | "maximum" | "clip", first, *others)):
            yield from (Node("-", (first, other)) for other in others)
        case Node("call", (_, *taken)):
            yield from taken
        case Node("/", (_, below)):
            yield below
        case Node("^", (base, _)):
            yield base


def places(of: tuple[Node, ...], x: Array, value: Value) -> Iterator[Cells]:
    """Give, of each row with places ``x`` (rows, points), where one of these parts is least, greatest or nearest to zero, and the points beside."""
    every = np.arange(len(x))
    for argument in of:
        with np.errstate(all="ignore"):
            on_grid = value(argument, x, every)
            for size in (np.abs, np.positive, np.negative):
                row, k = _lowest(size(on_grid))
                low, high = x[row, np.maximum(k - 1, 0)], x[row, np.minimum(k + 1, x.shape[1] - 1)]
                place = _least(lambda at, own, part=argument, by=size: by(value(part, at, own)), row, low, high)  # type: ignore[misc]
                yield row, k, place


def _lowest(values: Array) -> tuple[Array, Array]:
    """Points of the grid, by row and number, that are no higher than those beside them, and lower than one of them."""
    falls, rises = values[:, 1:] <= values[:, :-1], values[:, :-1] <= values[:, 1:]
    is_low = np.concatenate([rises[:, :1], falls[:, :-1] & rises[:, 1:], falls[:, -1:]], axis=1)
    is_flat = np.concatenate([falls[:, :1], rises[:, :-1] & falls[:, 1:], rises[:, -1:]], axis=1)
    return nonzero(is_low & ~is_flat)


def _least(size: Callable[[Array, Array], Array], row: Array, low: Array, high: Array) -> Array:
    """Where a size is least between two places."""
    each = np.arange(len(row))
    for _ in range(ROUNDS):
        at = low[:, None] + (high - low)[:, None] * np.linspace(0, 1, PARTS + 1)
        least = size(at, row).argmin(axis=1)
        low, high = at[each, np.maximum(least - 1, 0)], at[each, np.minimum(least + 1, PARTS)]
    found: Array = (low + high) / 2
    return found
