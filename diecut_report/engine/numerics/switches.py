"""Where a curve jumps inside a smooth piece: each condition of its formula is followed through the piece to where it changes.

A condition is held as the difference of its sides. Where that changes its sign between two points of the search grid, or comes near
to zero between them, the very place is found; a condition on the abscissa itself has a straight difference, so that no window is
too narrow. A place at an end of the piece, or one where the curve that is asked for does not jump, is not a fault.

What decides is mostly a term of the curve itself, so that it is computed with it on the search grid, of all machines at once.
"""

from __future__ import annotations

from collections.abc import Iterator
from weakref import proxy

import numpy as np

from diecut_report.contract.sections import taken
from diecut_report.engine.calculation import Calculation
from diecut_report.engine.numerics.curve_evaluation import BLOCK
from diecut_report.engine.numerics.decisions import Deciding, asked
from diecut_report.engine.numerics.sample_cache import PIECE
from diecut_report.engine.numerics.switching import JumpFault, SearchedMachines
from diecut_report.expressions import Array


def faults(calc: Calculation, curve: str) -> Iterator[tuple[int, JumpFault]]:
    """Give the first jump of a curve inside a smooth piece of each machine (its variant) that has one and is not impossible already."""
    axis = calc.axis[curve]
    edges = calc.domains[axis].edges
    search = calc.searches.get(axis)
    if search is None or not search.holds(edges):
        search = calc.searches[axis] = _Search(calc, axis, edges)
    if curve in search.sound:
        return
    search.sound.add(curve)
    for variant, found in search.faults(curve):
        if variant not in calc.flaws:
            yield variant, found


class _Search:
    """What is known of the jumps of curves over an abscissa with these pieces, of so many machines at once as fit a cache."""

    def __init__(self, calc: Calculation, axis: str, edges: Array) -> None:
        self.calc: Calculation = proxy(calc)
        self.axis, self.edges = axis, edges
        self.sound: set[str] = set()  # curves that were searched
        self.ends: dict[str, Array] = {}  # of quantities, just inside of each piece, where rounding decides nothing
        self._asked: dict[str, Deciding] = {}
        self._names: dict[str, list[str]] = {}  # for each curve, what decides in it
        self.pieces = calc.table(axis).pieces()
        own = np.flatnonzero(~np.isin(self.pieces.variant, list(calc.flaws)))
        size = max(1, BLOCK // (self.pieces.intervals + 1))
        starts = np.flatnonzero(np.diff(self.pieces.variant[own], prepend=-1))
        cuts = starts[np.diff(starts // size, prepend=0) > 0]  # no machine in two parts
        self.machines = [SearchedMachines(self, rows) for rows in np.split(own, cuts) if len(rows)]

    def holds(self, edges: Array) -> bool:
        """Return whether the smooth pieces are still the same: a cut beside an edge leaves them."""
        if edges is not self.edges:
            now = self.calc.table(self.axis).pieces()
            if not all(np.array_equal(getattr(now, name), getattr(self.pieces, name)) for name in PIECE):
                return False
            self.edges = edges
        return True

    def faults(self, curve: str) -> Iterator[tuple[int, JumpFault]]:
        """Give the first jump of a curve of each machine that has one."""
        question = self.asked(curve)
        if any(question) and self.machines:
            self._prepare(curve)
            for machines in self.machines:
                yield from machines.faults(curve, question).items()

    def asked(self, curve: str) -> Deciding:
        """Return what makes a curve jump."""
        if curve not in self._asked:
            self._asked[curve] = asked(tuple(self.calc.curves.items()), self.axis, curve)
        return self._asked[curve]

    def coming(self, curve: str) -> list[str]:
        """Return the curve, and those that will be asked for."""
        known = self.calc.curves
        return [curve, *(each for each in self.calc.ahead.get(self.axis, ()) if each in known and each != curve)]

    def _prepare(self, curve: str) -> None:
        """Compute what decides in this curve and the coming ones on the grid, with them, as it is a part of them."""
        names = dict.fromkeys(name for each in self.coming(curve) for name in self._deciding_in(each))
        new = [name for name in names if name not in self.ends and self.is_curve(name)]
        if new:
            table = self.calc.table(self.axis)
            table.on_grid([*new, curve])
            ends = np.stack([self.pieces.left, self.pieces.right], axis=1)
            found = table.curves(new).at(self.pieces.inside(ends, slice(None)))
            self.ends |= zip(new, found, strict=True)

    def _deciding_in(self, curve: str) -> list[str]:
        if curve not in self._names:
            self._names[curve] = list(self._deciding(self.asked(curve)))
        return self._names[curve]

    def _deciding(self, question: Deciding) -> Iterator[str]:
        """The quantities that decide, and that flags follow from."""
        flags = [name for decision in question.by_flags for name in decision.names]
        for decision in question.changing:
            yield from decision.names
        for flag in (*question.flags, *flags):
            yield from sorted(taken(self.calc.curves[flag])) if flag in self.calc.curves else ()

    def is_curve(self, name: str) -> bool:
        """Return whether a quantity varies within a piece and is computed, as the abscissa, flags of pieces and numbers are not."""
        return name in self.calc.curves and not getattr(self.calc.curves[name], "per_piece", False)
