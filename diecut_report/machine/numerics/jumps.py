"""Which curves may jump inside a smooth piece's rounding: where a condition on places decides, the very end may be on the wrong side."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from diecut_report.formulas import Array
from diecut_report.formulas.formula import FormulaError
from diecut_report.formulas.tree import Node, substitute
from diecut_report.machine.numerics.domain import piece_of
from diecut_report.mechanics import numerics
from diecut_report.mechanism.names import Binding, bound
from diecut_report.mechanism.steps import Accumulated, Choice, Derivative, Step, Value

STEPWISE = {"sign", "ceil", "floor", "round"}  # functions that jump themselves


@lru_cache(maxsize=256)
def jumping(curves: tuple[tuple[str, Step], ...], axis: str) -> frozenset[str]:
    """Return the curves over an abscissa whose formulas hold a condition that may change from place to place within a smooth piece."""
    return frozenset(_Curves(dict(curves), axis).found())


class _Curves:
    def __init__(self, curves: dict[str, Step], axis: str) -> None:
        self.curves, self.axis = curves, axis
        self.known: dict[str | float, bool] = {axis: False}

    def found(self) -> Iterator[str]:
        return (name for name in self.curves if self._jumps(name))

    def _jumps(self, name: str | float) -> bool:
        if name not in self.known:
            self.known[name] = self._declared(self.curves[str(name)]) if self._varies(name) else False
        return self.known[name]

    def _varies(self, name: str | float) -> bool:
        """Whether a quantity varies within a piece: flags of pieces and numbers do not."""
        return name == self.axis or (name in self.curves and not getattr(self.curves[str(name)], "per_piece", False))

    def _declared(self, step: Step) -> bool:
        match step:
            case Value(formula=part):
                return self._formula(part, condition=False)
            case Choice(cases=cases):
                return any(self._formula(c.value, condition=False) for c in cases) or any(
                    self._formula(c.condition, condition=True) for c in cases if c.condition is not None
                )
            case Accumulated() | Derivative():
                return False  # polynomials, piece by piece
        return True

    def _formula(self, part: Any, *, condition: bool) -> bool:
        """Whether a formula jumps; of a condition, whether it may change."""
        link = bound(_binding(part))
        names = [name for name in link.names.values() if self._varies(name)]
        try:
            tree = link.formula.tree
        except FormulaError:  # it is called as it is
            return bool(names)
        varying = {parameter for parameter, name in link.names.items() if self._varies(name)}
        return (
            any(self._jumps(name) for name in names) or (condition and bool(names)) or _decides(expanded(tree), varying)
        )


def _binding(part: Any) -> Binding:
    assert not isinstance(part, str), "a curve has no texts"
    found: Binding = part
    return found


def expanded(node: Node) -> Node:
    """Return a tree with the expressions of formulas in the place of the names by which they are printed."""
    if node.op == "apply":
        called, *args = node.args
        given = dict(zip(called.formula.parameters, map(expanded, args), strict=True))
        return substitute(expanded(called.formula.tree), given)
    return Node(node.op, tuple(_expanded(part) for part in node.args))


def _expanded(part: Any) -> Any:
    if isinstance(part, Node):
        return expanded(part)
    return tuple(map(_expanded, part)) if isinstance(part, tuple) else part


def _decides(node: Node, varying: set[str]) -> bool:
    """Whether a part of a formula compares, or takes a step, by what varies."""
    if node.op == "cmp" or (node.op == "call" and node.args[0] in STEPWISE):
        return any(name in varying for name in _symbols(node))
    return any(_decides(part, varying) for part in parts(node))


def _symbols(node: Node) -> Iterator[str]:
    if node.op == "sym":
        yield node.args[0]
    for part in parts(node):
        yield from _symbols(part)


def parts(node: Node) -> Iterator[Node]:
    """Give the nodes that a node is made of."""
    for part in node.args:
        if isinstance(part, Node):
            yield part
        elif isinstance(part, tuple):
            yield from parts(Node("cases", part))


# How near a decision is to changing, on the points of the search grid: where it dips, and where it only begins at the end of a piece.


NEAR = 5  # points of the grid that tell how a gap runs from the end of its piece to the next point
BETWEEN = np.array([1 / 16, 1 / 4, 1 / 2])  # places from the end to the next point where it is looked at
ALIKE = 0.01  # of a gap: where the points beside the end tell it by so much, there is no bend between
FLAT = 0.1  # of a gap: where it moves by less about its least value that is not nothing
SOME = 5  # points of a piece at which a curve is held against its flag that varies in it


def lowest(gap: Array, is_change: Array) -> tuple[Array, Array]:
    """Return points of the grid, by row and number, where a gap is lower than beside it by as much as itself, and no change is beside it."""
    falls, rises = gap[:, 1:] <= gap[:, :-1], gap[:, :-1] <= gap[:, 1:]
    is_low = np.concatenate([rises[:, :1], falls[:, :-1] & rises[:, 1:], falls[:, -1:]], axis=1)
    row, k = nonzero(is_low)
    last = gap.shape[1] - 1
    before, after = np.where(k > 0, k - 1, 1), np.where(k < last, k + 1, last - 1)
    here = gap[row, k]
    changed = (is_change[row, k - 1] & (k > 0)) | (is_change[row, np.minimum(k, last - 1)] & (k < last))
    found = (2 * here <= np.maximum(gap[row, before], gap[row, after])) & (here > 0) & ~changed
    return row[found], k[found]


def rises(gap: Array, places: Array) -> Array:
    """Return whether gaps (rows, points) near the end of a piece have their least size at the end, by the polynomial through them.

    The points without the end must tell the gap there: no bend hides between the end and the next point.
    """
    inner, beside = _weights_beside_end(tuple(places.tolist()))
    tells = np.abs(gap[:, 1:] @ inner - gap[:, :1]) <= ALIKE * np.abs(gap[:, 1:2])
    between = gap @ beside
    rising = (np.abs(between) >= np.abs(gap[:, :1])) & ((between > 0) == (gap[:, 1:2] > 0))
    found: Array = (tells & rising).all(axis=1)
    return found


@lru_cache(maxsize=16)
def _weights_beside_end(places: tuple[float, ...]) -> tuple[Array, Array]:
    """What the places of a grid count at its end, without that, and between the end and the next place."""
    points = np.array(places)
    return _weights(points[1:], points[:1]), _weights(points, points[1] * BETWEEN)


def _weights(points: Array, places: Array) -> Array:
    """What each point counts at other places in the polynomial through all, (points, places)."""
    parts = [np.prod([(places - other) / (own - other) for other in points if other != own], axis=0) for own in points]
    return np.stack(parts)


def nonzero(marks: Array) -> tuple[Array, Array]:
    """Return rows and columns of marks (rows, columns) of which few are set."""
    row, k = np.divmod(np.flatnonzero(marks), marks.shape[1])
    return row, k


def some(apart: Array) -> Array:
    """Return of the points that are apart in each piece (rows, all) some, from the first to the last (rows, SOME)."""
    count = apart.sum(axis=1)
    rank = np.round(np.linspace(0, 1, SOME) * (count[:, None] - 1)).astype(int)
    found: Array = np.nonzero(apart)[1][np.cumsum(count)[:, None] - count[:, None] + rank]
    return found


def may_reach(gap: Array, least: Array) -> Array:
    """Return whether gaps (rows, places) may come down to nothing between their places: they turn back, and are not flat yet."""
    turns = (least > 0) & (least < gap.shape[1] - 1)
    found: Array = turns & (np.ptp(gap, axis=1) > FLAT * gap.min(axis=1))
    return found


# Running integrals and derivatives of curves, as Chebyshev series of their smooth pieces.


@dataclass(frozen=True)
class PieceSeries:
    """Hold a curve as Chebyshev series: for each variant and smooth piece one over [-1, 1]."""

    edges: Array  # (variants, pieces + 1)
    series: Array  # (order, variants, pieces)

    def values(self, x: Array, middle: Array, rows: Array | None) -> Array:
        """Return values at x (rows, points), each in the piece that its middle lies in; rows are variants (default all)."""
        known = np.arange(len(self.edges)) if rows is None else rows
        edges = self.edges if len(self.edges) == 1 else self.edges[known]
        piece = piece_of(edges, np.broadcast_to(middle, (len(x), np.shape(middle)[-1])))  # one a row, or one a place
        variant = np.broadcast_to(known[:, None] if len(self.edges) > 1 else 0, piece.shape)
        start, end = self.edges[variant, piece], self.edges[variant, piece + 1]
        place = (2 * x - start - end) / np.where(end > start, end - start, 1)
        terms = self.series.reshape(len(self.series), -1)
        return numerics.at_places(terms, variant * self.series.shape[2] + piece, place)
