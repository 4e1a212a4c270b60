"""Curves on the search grid of their smooth pieces, each piece evaluated once: a cut elsewhere leaves what is known."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property, partial
from typing import NamedTuple
from weakref import proxy

import numpy as np

from diecut_report.formulas import Array
from diecut_report.machine.numerics.conditions import conditions_of
from diecut_report.machine.numerics.curves import Curves, flags_of
from diecut_report.machine.numerics.domain import CalculatedMachines, Domain, nodes_of, shares

INSIDE = 2e-14  # share of the period by which places at a piece's end are moved inwards, so that rounding decides no condition
SIZED = 4  # of so many points of a piece one tells how great a curve is there
JUMP = 1e-9  # share of a curve's greatest value by which no curve moves on that way, unless it jumps

Rows = Array | slice
EVERY = slice(None)


class CachedPieces:
    """Hold smooth pieces that have a width, one row each, ascending by variant and place."""

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
    def margin(self) -> Array:
        """Return how far inwards from the very end of each piece rounding decides no condition."""
        found: Array = np.minimum(INSIDE * self.period, self.width / 4)
        return found

    def is_same(self, other: CachedPieces) -> bool:
        """Return whether others are the same pieces."""
        return self is other or all(np.array_equal(getattr(self, name), getattr(other, name)) for name in PIECE)

    def grid(self, row: Rows) -> Array:
        """Return the search grid of these pieces, (rows, points): Chebyshev–Lobatto points, ends included."""
        found: Array = self.left[row][:, None] + self.width[row][:, None] * shares(self.intervals)
        found[:, -1] = self.right[row]
        return found

    def point(self, row: Array, k: Array) -> Array:
        """Return points of the search grid by their pieces and numbers, any shape."""
        found = self.left[row] + self.width[row] * shares(self.intervals)[k]
        return np.where(k == self.intervals, self.right[row], found)

    def gauss(self, order: int, row: Rows) -> Array:
        """Return the Gauss–Legendre points of these pieces, (rows, points)."""
        return self.middle[row][:, None] + self.width[row][:, None] * (nodes_of(order)[0] / 2)

    def inside(self, x: Array, row: Rows) -> Array:
        """Return places (rows, points) of these pieces, moved inwards from the very ends."""
        step = self.margin[row][:, None]
        return np.clip(x, self.left[row][:, None] + step, self.right[row][:, None] - step)

    def of_variants(self, reduce: np.ufunc, values: Array) -> Array:
        """Return values of pieces (rows,) or (rows, points) joined to one a variant, shape (variants, 1); NaN where there is no piece."""
        found = np.full((self.shape[0], 1), np.nan)
        if len(values):
            points = values.size // len(values)
            found[self.variant[self.starts], 0] = reduce.reduceat(values.ravel(), self.starts * points)
        return found

    def spread(self, values: Array) -> Array:
        """Return values of pieces (rows, points) as (variants, pieces, points), zero where a piece has no width."""
        found = np.zeros((*self.shape, values.shape[1]))
        found[self.variant, self.column] = values
        return found


Places = Callable[[CachedPieces, Rows], Array]  # of pieces, (rows, points)


class Known(NamedTuple):
    """Hold a curve's values, a row for each of the pieces that there were after so many cuts."""

    cuts: int
    values: Array


class SampleCache:
    """Hold what is known of the curves over one abscissa."""

    def __init__(self, calc: CalculatedMachines, axis: str) -> None:
        self.calc: CalculatedMachines = proxy(calc)  # which holds this table: no memory may wait for the collector
        self.axis = axis
        self._edges: Array | None = None
        self._pieces: CachedPieces
        self._cuts: list[Array] = []  # for each cut the rows that pieces after it had before, -1 for none
        self._known: dict[str, dict[str, Known]] = defaultdict(dict)  # by use and curve
        self._flags: dict[str, Known] = {}

    def pieces(self) -> CachedPieces:
        """Return the present pieces."""
        domain = self.calc.domains[self.axis]
        if self._edges is domain.edges:
            return self._pieces
        new = CachedPieces(domain)
        if self._edges is not None and not new.is_same(self._pieces):
            self._cuts.append(_matches(self._pieces, new))
        self._edges, self._pieces = domain.edges, new
        return new

    def curves(self, names: Sequence[str], row: Rows = EVERY) -> Curves:
        """Return curves in these of the present pieces, anywhere."""
        pieces = self.pieces()
        flags = partial(self._flags_in, row)
        return Curves(self.calc, self.axis, names, pieces.middle[row], pieces.variant[row], flags)

    def _flags_in(self, row: Rows, names: tuple[str, ...]) -> list[Array]:
        """Flags of pieces, each computed once; where few machines are, the sampler keeps them."""
        new = tuple(name for name in names if name not in self._flags or self._flags[name].cuts < len(self._cuts))
        found = flags_of(self.calc, self.axis, new, self._pieces.middle, self._pieces.variant)
        self._flags |= {name: Known(len(self._cuts), flag) for name, flag in zip(new, found, strict=True)}
        return [self._flags[name].values[row] for name in names]

    def on_grid(self, curves: Sequence[str]) -> list[Array]:
        """Return curves on the search grid, (pieces, points) each."""
        return self._at("grid", curves, CachedPieces.grid)

    def at_gauss(self, curves: Sequence[str], order: int) -> list[Array]:
        """Return curves at the Gauss–Legendre points, (pieces, points) each."""
        return self._at(f"gauss {order}", curves, lambda pieces, row: pieces.gauss(order, row))

    def _at(self, use: str, curves: Sequence[str], places: Places) -> list[Array]:
        self.pieces()
        known = self._known[use]
        if any(name not in known or known[name].cuts < len(self._cuts) for name in curves):
            old: dict[int, list[str]] = defaultdict(list)
            for name in dict.fromkeys([*curves, *self.calc.ahead.get(self.axis, ())]):
                old[known[name].cuts if name in known else -1].append(name)
            for cuts, names in old.items():
                if cuts < len(self._cuts):
                    known |= self._renewed(known, cuts, names, places)
        return [known[name].values for name in curves]

    def _renewed(self, known: Mapping[str, Known], cuts: int, names: Sequence[str], places: Places) -> dict[str, Known]:
        """Curves at places of the present pieces, evaluated in those that have come since so many cuts (-1: in all)."""
        if cuts < 0 or not len(known[names[0]].values):
            found = self._evaluated(names, EVERY, places)
        else:
            same = self._since(cuts)
            row = np.flatnonzero(same < 0)
            found = [known[name].values.take(same, axis=0, mode="clip") for name in names]
            for values, new in zip(found, self._evaluated(names, row, places), strict=True):
                values[row] = new
        return {name: Known(len(self._cuts), values) for name, values in zip(names, found, strict=True)}

    def _since(self, cuts: int) -> Array:
        """For each present piece the row that it had after so many cuts, -1 for none."""
        same = self._cuts[-1]
        for earlier in reversed(self._cuts[cuts:-1]):
            same = np.where(same < 0, -1, earlier[same])
        return same

    def _evaluated(self, names: Sequence[str], row: Rows, places: Places) -> list[Array]:
        pieces, x = self._pieces, places(self._pieces, row)
        found = self.curves(names, row).at(x)
        known = tuple(self.calc.curves.items())
        jump = [name for name in names if conditions_of(known, self.axis, name).may_jump]
        ends = x[:, [0, -1]]
        inside = pieces.inside(ends, row)
        if jump and (ends != inside).any():
            limits = self.curves(jump, row).at(inside)
            for name, limit in zip(jump, limits, strict=True):
                _take_limits(found[names.index(name)], limit)
        return found


def _take_limits(values: Array, limits: Array) -> None:
    """Where a condition changes at the very end of a piece, and rounding decides there, the value from inside holds."""
    for side in (0, -1):
        end, limit = values[:, side], limits[:, side]
        rows = np.flatnonzero(np.abs(end - limit) > JUMP * np.abs(end))
        rows = rows[np.abs(end - limit)[rows] > JUMP * np.abs(values[:, ::SIZED][rows]).max(axis=1)]
        values[rows, side] = limit[rows]


PIECE = ("variant", "left", "right")


def _matches(old: CachedPieces, new: CachedPieces) -> Array:
    """For each new piece the row of the old one that it is, -1 for none."""
    if not len(old.left):
        return np.full(len(new.left), -1)
    keys = [pieces.variant + pieces.left / pieces.period for pieces in (old, new)]
    found = np.minimum(np.searchsorted(*keys), len(old.left) - 1)
    same = np.logical_and.reduce([getattr(old, name)[found] == getattr(new, name) for name in PIECE])
    return np.where(same, found, -1)
