"""Curves on the search grid of their smooth pieces, each piece evaluated once: a cut elsewhere leaves what is known."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import Protocol
from weakref import proxy

import numpy as np

from diecut_report.engine.domain import Domain, nodes_of, shares
from diecut_report.engine.evaluation import Curves, Machines
from diecut_report.expressions import Array

INSIDE = 2e-14  # share of the period by which places at a piece's end are moved inwards, so that rounding decides no condition
JUMP = 1e-9  # share of a curve's greatest value by which no curve moves on that way, unless it jumps


class Pieces:
    """Smooth pieces that have a width, one row each, ascending by variant and place."""

    def __init__(self, domain: Domain) -> None:
        widths = domain.widths
        self.variant, self.column = np.nonzero(widths > 0)
        self.left, self.right = domain.edges[self.variant, self.column], domain.edges[self.variant, self.column + 1]
        self.middle = (self.left + self.right) / 2
        self.width = self.right - self.left
        self.period = domain.period[self.variant, 0] if len(domain.period) > 1 else domain.period[0, 0]
        self.starts = np.flatnonzero(np.diff(self.variant, prepend=-1))  # the first piece of each variant that has one
        self.shape, self.intervals, self.proof_order = widths.shape, domain.intervals, domain.proof_order

    @cached_property
    def grid(self) -> Array:
        """Chebyshev–Lobatto points of each piece, ends included."""
        found: Array = self.left[:, None] + self.width[:, None] * shares(self.intervals)
        found[:, -1] = self.right
        return found

    def gauss(self, order: int) -> Array:
        """The Gauss–Legendre points of each piece."""
        found: Array = self.middle[:, None] + self.width[:, None] * nodes_of(order)[0] / 2
        return found

    def inside(self, x: Array, row: Array) -> Array:
        """Places (rows, points) of these pieces, moved inwards from the very ends."""
        step = np.minimum(INSIDE * self.period, self.width / 4)[row][:, None]
        found: Array = np.clip(x, self.left[row][:, None] + step, self.right[row][:, None] - step)
        return found

    def of_variants(self, reduce: np.ufunc, values: Array) -> Array:
        """Values of pieces (rows,) or (rows, points) joined to one a variant, shape (variants, 1); NaN where there is no piece."""
        found = np.full((self.shape[0], 1), np.nan)
        if len(values):
            points = values.size // len(values)
            found[self.variant[self.starts], 0] = reduce.reduceat(values.ravel(), self.starts * points)
        return found

    def spread(self, values: Array) -> Array:
        """Values of pieces (rows, points) as (variants, pieces, points), zero where a piece has no width."""
        found = np.zeros((*self.shape, values.shape[1]))
        found[self.variant, self.column] = values
        return found


class Owner(Machines, Protocol):
    """The calculation that a table belongs to."""

    @property
    def domains(self) -> Mapping[str, Domain]:
        """The abscissas with their pieces."""

    @property
    def ahead(self) -> Mapping[str, Sequence[str]]:
        """For each abscissa the curves that coming steps ask for."""


class Table:
    """What is known of the curves over one abscissa."""

    def __init__(self, calc: Owner, axis: str) -> None:
        self.calc: Owner = proxy(
            calc
        )  # which holds this table: among many machines no memory may wait for the collector
        self.axis = axis
        self._edges: Array | None = None
        self._pieces: Pieces
        self._known: dict[str, dict[str, Array]] = {}  # by use and curve: a row for each present piece

    def pieces(self) -> Pieces:
        """The present pieces."""
        domain = self.calc.domains[self.axis]
        if self._edges is None:
            self._edges, self._pieces = domain.edges, Pieces(domain)
        elif self._edges is not domain.edges:
            self._move(domain)
        return self._pieces

    def _move(self, domain: Domain) -> None:
        """Take over what is known of pieces that stay; the entry "" tells which rows are computed."""
        old, new = self._pieces, Pieces(domain)
        self._edges, self._pieces = domain.edges, new
        if all(np.array_equal(getattr(old, name), getattr(new, name)) for name in ("variant", "left", "right")):
            return
        if not len(old.left):
            self._known.clear()
        same = _matches(old, new)
        for known in self._known.values():
            done = known.pop("")
            for name, values in known.items():
                known[name] = values[same]
            known[""] = np.where(same >= 0, done[same, 0], 0.0)[:, None]

    def on_grid(self, curves: Sequence[str]) -> list[Array]:
        """Curves on the search grid, (pieces, points) each."""
        return self._at("grid", curves, lambda pieces, row: pieces.grid[row])

    def at_gauss(self, curves: Sequence[str], order: int) -> list[Array]:
        """Curves at the Gauss–Legendre points, (pieces, points) each."""
        return self._at(f"gauss {order}", curves, lambda pieces, row: pieces.gauss(order)[row])

    def _at(self, use: str, curves: Sequence[str], places: Callable[[Pieces, Array], Array]) -> list[Array]:
        pieces = self.pieces()
        known = self._known.setdefault(use, {})
        done = known.get("")
        if done is not None and not done.all():
            self._fill(known, [name for name in known if name], np.flatnonzero(done[:, 0] == 0), places)
        if any(name not in known for name in curves):
            missing = [
                name for name in dict.fromkeys([*curves, *self.calc.ahead.get(self.axis, ())]) if name not in known
            ]
            every = np.arange(len(pieces.left))
            known |= dict(zip(missing, self._evaluated(missing, every, places), strict=True))
        known[""] = np.ones((len(pieces.left), 1))
        return [known[name] for name in curves]

    def _fill(
        self, known: dict[str, Array], names: list[str], row: Array, places: Callable[[Pieces, Array], Array]
    ) -> None:
        for name, values in zip(names, self._evaluated(names, row, places), strict=True):
            known[name][row] = values

    def _evaluated(self, names: Sequence[str], row: Array, places: Callable[[Pieces, Array], Array]) -> list[Array]:
        pieces = self._pieces
        x = places(pieces, row)
        curves = Curves(self.calc, self.axis, names, pieces.middle[row], pieces.variant[row])
        found = curves.at(x)
        ends = x[:, [0, -1]]
        inside = pieces.inside(ends, row)
        if (ends != inside).any():
            for values, limit in zip(found, curves.at(inside), strict=True):
                _take_limits(values, limit)
        return found


def _take_limits(values: Array, limits: Array) -> None:
    """Where a condition changes at the very end of a piece, and rounding decides there, the value from inside holds."""
    ends = values[:, [0, -1]]
    apart = np.abs(ends - limits)
    rows = np.flatnonzero((apart > JUMP * np.abs(ends)).any(axis=1))
    if len(rows):
        row, side = np.nonzero(apart[rows] > JUMP * np.abs(values[rows]).max(axis=1, keepdims=True))
        values[rows[row], -side] = limits[rows[row], side]


def _matches(old: Pieces, new: Pieces) -> Array:
    """For each new piece the row of the old one that it is, -1 for none."""
    columns = [np.concatenate([getattr(old, name), getattr(new, name)]) for name in ("right", "left", "variant")]
    order = np.lexsort(columns)  # stable: an old piece comes right before the new one that it is
    same = np.logical_and.reduce([column[order][1:] == column[order][:-1] for column in columns])
    found = np.full(len(new.left), -1)
    found[order[1:][same] - len(old.left)] = order[:-1][same]
    return found
