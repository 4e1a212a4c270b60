"""Curves at given places, in blocks that stay in the processor's cache; compiled where there is much to compute."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

import numpy as np

from diecut_report.contract.steps import Step
from diecut_report.engine.numerics.codegen import NUMBERS, PIECES, POINTS, Program, program
from diecut_report.engine.numerics.domain import Inside
from diecut_report.expressions import Array

BLOCK = 16384  # places at once
NARROW = 4  # places a row up to which it is faster to take them in turn, each for all rows
MANY = 8  # variants from which compiling pays


class CurveValues(Protocol):
    """Hold curves at certain places, by id."""

    def __getitem__(self, name: str) -> Array:
        """A curve's values."""


Flags = Callable[[tuple[str, ...]], list[Array]]  # of names, a column (rows, 1) for each


class VariantRows(Protocol):
    """Hold what curves are evaluated of: a calculation of one machine or of many."""

    @property
    def count(self) -> int:
        """Return how many machines."""

    @property
    def curves(self) -> Mapping[str, Step]:
        """Return the curves that are known, as they are declared."""

    def __getitem__(self, name: str) -> Array:
        """A number of all machines."""

    def sampler_of(
        self, axis: str, x: Array, middle: Array, rows: Array | None, inside: Inside | None = None
    ) -> CurveValues:
        """Return all curves over an abscissa by the plain formulas, at x in the pieces of these middles."""


class Curves:
    """Hold curves in smooth pieces, a row for each: the middle (rows,) of the piece and the machine ``variant`` (rows,) it belongs to.

    ``flags`` gives flags of these pieces where they are known already.
    """

    def __init__(
        self,
        calc: VariantRows,
        axis: str,
        wanted: Sequence[str],
        middle: Array,
        variant: Array,
        flags: Flags | None = None,
    ) -> None:
        self.calc, self.axis, self.wanted, self.middle, self.variant = calc, axis, tuple(wanted), middle, variant
        self.program: Program | None = None
        if calc.count >= MANY:
            self.program = _program(calc, axis, self.wanted, at_middle=False)
            self.numbers = _Columns(_numbers(calc, self.program))
            self.pieces = _Columns(self._of_pieces(self.program, flags) if self.program.carried[PIECES] else ())

    def at(self, x: Array, rows: Array | slice = slice(None)) -> list[Array]:
        """Return the curves at x (rows, points), in these of the rows (default all)."""
        middle, variant = self.middle[rows][:, None], self.variant[rows]
        if self.program is None:
            sampler = self.calc.sampler_of(self.axis, x, middle, variant)
            return [_filled(x.shape, sampler[name]) for name in self.wanted]
        chosen = np.arange(len(self.middle))[rows] if self.pieces.tables else variant
        found = [np.empty(x.shape) for _ in self.wanted]
        if 1 < x.shape[1] <= NARROW:
            for i in range(x.shape[1]):
                for values, column in zip(found, self.at(x[:, [i]], rows), strict=True):
                    values[:, i] = column[:, 0]
            return found
        size = max(1, BLOCK // x.shape[1])
        for start in range(0, len(x), size):
            part = slice(start, start + size)
            given = _given(self.calc, self.axis, self.program, x[part], middle[part], variant[part])
            carried = [*self.numbers.of(variant[part]), *self.pieces.of(chosen[part])]
            self.program.points(*given, *carried, *(result[part] for result in found))
        return found

    def _of_pieces(self, program: Program, flags: Flags | None) -> Sequence[Any]:
        """What belongs to a piece as a whole."""
        names = tuple(leaf.name for leaf in program.leaves[PIECES].values())
        known = flags(names) if flags else flags_of(self.calc, self.axis, names, self.middle, self.variant)
        found: Sequence[Any] = program.pieces(*known, *self.numbers.of(self.variant))
        return found


def several(
    calc: VariantRows,
    axis: str,
    wanted: Sequence[str],
    x: Array,
    middle: Array,
    inside: Inside | None,
    rows: Array | None,
) -> list[Array]:
    """Return curves of variants (default all) at x (rows, points), with what they have in common computed once."""
    own = np.arange(calc.count) if rows is None else rows
    if calc.count >= MANY and middle.shape == (len(own), 1) and len(own) == len(x):
        return Curves(calc, axis, wanted, middle[:, 0], own).at(x)
    found = calc.sampler_of(axis, x, middle, rows, inside)
    return [_filled(np.broadcast_shapes(np.shape(found[name]), x.shape), found[name]) for name in wanted]


def _filled(shape: tuple[int, ...], values: Array) -> Array:
    """A new array of a shape, filled with values that stand for all of it or for a column."""
    made = np.empty(shape)
    made[...] = values
    return made


def flags_of(calc: VariantRows, axis: str, names: tuple[str, ...], middle: Array, variant: Array) -> list[Array]:
    """Return the flags of pieces, taken at their middles; (rows, 1) each."""
    if not names:
        return []
    own, places = _program(calc, axis, names, at_middle=True), middle[:, None]
    numbers = _Columns(_numbers(calc, own)).of(variant)
    found = own.points(*_given(calc, axis, own, places, places, variant), *numbers)
    return [np.broadcast_to(flag, places.shape) for flag in found]


class _Columns:
    """Columns (rows, 1) and plain numbers, to be taken by rows together."""

    def __init__(self, values: Sequence[Any]) -> None:
        self.values = list(values)
        self.tables: list[tuple[list[int], Array]] = []
        columns = {i: value for i, value in enumerate(values) if isinstance(value, np.ndarray) and value.ndim}
        for kind in dict.fromkeys(value.dtype for value in columns.values()):  # numbers, flags, counts
            own = [i for i, value in columns.items() if value.dtype == kind]
            self.tables.append((own, np.stack([values[i][:, 0] for i in own])))

    def of(self, rows: Array) -> list[Any]:
        """These rows of the columns, in the columns' order."""
        found = list(self.values)
        for own, table in self.tables:
            for i, column in zip(own, table.take(rows, axis=1)[:, :, None], strict=True):
                found[i] = column
        return found


def _program(calc: VariantRows, axis: str, wanted: tuple[str, ...], *, at_middle: bool) -> Program:
    return program(tuple(calc.curves.items()), axis, wanted, at_middle)


def _numbers(calc: VariantRows, of: Program) -> list[Any]:
    """What depends on numbers alone, a row for each machine."""
    found: list[Any] = list(of.numbers(*(calc[leaf.name] for leaf in of.leaves[NUMBERS].values())))
    return found


def _given(calc: VariantRows, axis: str, of: Program, x: Array, middle: Array, variant: Array) -> list[Array]:
    leaves = of.leaves[POINTS].values()
    if all(leaf.kind == "abscissa" for leaf in leaves):
        return [x] * len(leaves)
    sampler = calc.sampler_of(axis, x, middle, variant)
    return [sampler[leaf.name] for leaf in leaves]
