"""A formula that runs between the rows of a table, straight on axes that are linear or logarithmic: it computes by the whole
table and prints one piece of it."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from diecut_report.contract.place import Misdeclared
from diecut_report.errors import nearest
from diecut_report.expressions import Array, Constant, Formula, Node, Reading, formula, substitute
from diecut_report.languages.phrases import Phrase
from diecut_report.quantities.units import unit
from diecut_report.standards import Column, StandardFault, StandardTable


@formula
def difference(x: Any, row: Any) -> Any:
    """Return how far a quantity is beyond a row of a table."""
    return x - row


@formula
def _linear(x: Any, x_1: Any, y_1: Any, x_2: Any, y_2: Any) -> Any:
    return y_1 + (y_2 - y_1) * (x - x_1) / (x_2 - x_1)


@formula
def _log_x(x: Any, x_1: Any, y_1: Any, x_2: Any, y_2: Any) -> Any:
    return y_1 + (y_2 - y_1) * np.log(x / x_1) / np.log(x_2 / x_1)


@formula
def _log_y(x: Any, x_1: Any, y_1: Any, x_2: Any, y_2: Any) -> Any:
    return y_1 * (y_2 / y_1) ** ((x - x_1) / (x_2 - x_1))


@formula
def _log_log(x: Any, x_1: Any, y_1: Any, x_2: Any, y_2: Any) -> Any:
    return y_1 * (x / x_1) ** (np.log(y_2 / y_1) / np.log(x_2 / x_1))


Interpolation = Literal["linear", "log-x", "log-y", "log-log"]
LINES: dict[Interpolation, Formula] = {"linear": _linear, "log-x": _log_x, "log-y": _log_y, "log-log": _log_log}
"""The straight line through two rows; x, across, is what the rows go by."""
LOGARITHMIC: dict[Interpolation, tuple[int, ...]] = {"linear": (), "log-x": (0,), "log-y": (1,), "log-log": (0, 1)}
"""Which columns stand on logarithmic axes, and must be above zero."""


class Between(Formula):
    """Declare the value of a column at ``x``, which the table's rows go by; beyond its ends it goes on as in the last piece.

    ``x`` and ``y`` are the two columns in SI.
    """

    def __init__(self, table: StandardTable, column: str, name: str, interpolation: Interpolation = "linear") -> None:
        try:
            self.columns = _columns(table, column)
            self.line = _line(table, self.columns, interpolation)
        except StandardFault as fault:
            raise Misdeclared(f"step {name}: {fault}") from None
        self.x, self.y = (np.asarray(own.values) * unit(own.unit).factor for own in self.columns)
        through = self.line.function

        def between(x: Any) -> Any:
            k = self.piece(x)
            return through(x, self.x[k], self.y[k], self.x[k + 1], self.y[k + 1])

        super().__init__(between, name)

    def piece(self, x: Any) -> Array:
        """Return between which row and the next one each x lies."""
        found: Array = np.clip(np.searchsorted(self.x, x, side="right") - 1, 0, len(self.x) - 2)
        return found

    def through(self, x: Node, *rows: Node) -> Node:
        """Return the expression of the line at ``x`` through two rows: x_1, y_1, x_2, y_2."""
        return substitute(self.line.tree, dict(zip(self.line.parameters, (x, *rows), strict=True)))

    def reading(self, above: tuple[Formula, ...] = (), *, full: bool = False) -> Reading:
        """Return all pieces as cases, with the table's numbers as constants."""
        constants = {
            f"{name}_{k}": Constant(float(value), f"{name}_{k}", unit(own.unit).si)
            for name, own, values in zip("xy", self.columns, (self.x, self.y), strict=True)
            for k, value in enumerate(values)
        }
        sought, numbers = Node("sym", ("x",)), {name: Node("sym", (name,)) for name in constants}
        pieces = [
            self.through(sought, *(numbers[f"{name}_{row}"] for row in (k, k + 1) for name in "xy"))
            for k in range(len(self.x) - 1)
        ]
        branches = [(piece, Node("cmp", ("<", sought, numbers[f"x_{k}"]))) for k, piece in enumerate(pieces[:-1], 1)]
        return Reading(Node("cases", (*branches, (pieces[-1],))) if branches else pieces[-1], constants)


def _columns(table: object, column: str) -> tuple[Column, Column]:
    if not isinstance(table, StandardTable):
        raise StandardFault(
            Phrase(
                "{table} is not a table; write one with own_table(…), rows of numbers and its sources.",
                table=repr(table),
            )
        )
    if table.names:
        raise StandardFault(
            Phrase("The table “{title}” goes by names; one that goes by numbers is needed.", title=table.title)
        )
    if column == table.columns[0].name:
        raise StandardFault(
            Phrase("The table “{title}” goes by {column}; take another column.", title=table.title, column=column)
        )
    return table.columns[0], table.column(column)


def _line(table: StandardTable, columns: tuple[Column, Column], interpolation: Interpolation) -> Formula:
    if interpolation not in LINES:
        near = nearest(str(interpolation), LINES)
        raise StandardFault(
            Phrase(
                "interpolation is {interpolation}{near}; allowed: {lines}.",
                interpolation=repr(interpolation),
                near=near,
                lines=", ".join(LINES),
            )
        )
    for own in (columns[number] for number in LOGARITHMIC[interpolation]):
        for value in own.values:
            if value <= 0:
                words = Phrase(
                    "has the number {value} in its column {name}, which has no logarithm",
                    value=format(value, "g"),
                    name=own.name,
                )
                raise StandardFault(
                    Phrase("The table “{title}” {words}; interpolate linearly there.", title=table.title, words=words)
                )
    return LINES[interpolation]
