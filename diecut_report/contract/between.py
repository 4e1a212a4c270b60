"""A formula that runs straight between the rows of a table: it computes by the whole table and prints one piece of it."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.contract.place import Misdeclared
from diecut_report.expressions import Array, Constant, Formula, Node, Reading, formula
from diecut_report.quantities.units import unit
from diecut_report.standards import Column, StandardFault, StandardTable


@formula
def difference(x: Any, row: Any) -> Any:
    """Return how far a quantity is beyond a row of a table."""
    return x - row


class Between(Formula):
    """Declare the value of a column at ``x``, which the table's rows go by; beyond its ends it goes on as in the last piece.

    ``x`` and ``y`` are the two columns in SI.
    """

    def __init__(self, table: StandardTable, column: str, name: str) -> None:
        try:
            self.columns = _columns(table, column)
        except StandardFault as fault:
            raise Misdeclared(f"step {name}: {fault}") from None
        self.x, self.y = (np.asarray(own.values) * unit(own.unit).factor for own in self.columns)
        runs, rises = np.diff(self.x), np.diff(self.y)

        def between(x: Any) -> Any:
            k = self.piece(x)
            return self.y[k] + rises[k] * (x - self.x[k]) / runs[k]

        super().__init__(between, name)

    def piece(self, x: Any) -> Array:
        """Return between which row and the next one each x lies."""
        found: Array = np.clip(np.searchsorted(self.x, x, side="right") - 1, 0, len(self.x) - 2)
        return found

    def reading(self, above: tuple[Formula, ...] = (), *, full: bool = False) -> Reading:
        """Return all pieces as cases, with the table's numbers as constants."""
        constants = {
            f"{name}_{k}": Constant(float(value), f"{name}_{k}", unit(own.unit).si)
            for name, own, values in zip("xy", self.columns, (self.x, self.y), strict=True)
            for k, value in enumerate(values)
        }
        sought, numbers = Node("sym", ("x",)), {name: Node("sym", (name,)) for name in constants}
        pieces = [
            straight(sought, *(numbers[f"{name}_{row}"] for row in (k, k + 1) for name in "xy"))
            for k in range(len(self.x) - 1)
        ]
        branches = [(piece, Node("cmp", ("<", sought, numbers[f"x_{k}"]))) for k, piece in enumerate(pieces[:-1], 1)]
        return Reading(Node("cases", (*branches, (pieces[-1],))) if branches else pieces[-1], constants)


def straight(x: Node, x_1: Node, y_1: Node, x_2: Node, y_2: Node) -> Node:
    """Return the expression of the straight line through two rows."""
    rise = Node("*", (Node("-", (y_2, y_1)), Node("-", (x, x_1))))
    return Node("+", (y_1, Node("/", (rise, Node("-", (x_2, x_1))))))


def _columns(table: object, column: str) -> tuple[Column, Column]:
    if not isinstance(table, StandardTable):
        raise StandardFault(f"{table!r} is not a table; write one with own_table(…), rows of numbers and its sources.")
    if table.names:
        raise StandardFault(f"The table “{table.title}” goes by names; one that goes by numbers is needed.")
    if column == table.columns[0].name:
        raise StandardFault(f"The table “{table.title}” goes by {column}; take another column.")
    return table.columns[0], table.column(column)
