"""A value between the rows of a table: straight on axes that are linear or logarithmic.

Its formula computes by the whole table and prints one piece of it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, ClassVar, Literal

import numpy as np

from diecut_report.errors import nearest
from diecut_report.formulas import Array
from diecut_report.formulas.expression import Constant, m, number
from diecut_report.formulas.formula import Formula, formula
from diecut_report.formulas.tree import Node, substitute
from diecut_report.mechanism.names import Misdeclared, Written
from diecut_report.mechanism.steps.protocols import ANY, Item, Kinds, Names, StepEngine, StepPrinter
from diecut_report.mechanism.steps.table_steps import (
    SAME,
    column_title,
    key_faults,
    key_to_change,
    si_values,
    sources,
    unlike_units,
)
from diecut_report.mechanism.steps.value import Value
from diecut_report.quantities.formatting import DIGITS, MOST_DIGITS, number_text, with_unit
from diecut_report.quantities.units import unit
from diecut_report.standards.tables import Column, StandardFault, StandardTable
from diecut_report.text.phrases import Phrase, phrase

ROUNDING = 1e-12  # of the table's range: beyond its ends by no more is rounding


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
    """Declare the value of a column at the quantity ``of``, which the table's rows go by; beyond its ends it goes on as in the last piece.

    ``x`` and ``y`` are the two columns in SI.
    """

    def __init__(
        self, table: StandardTable, column: str, of: str, name: str, interpolation: Interpolation = "linear"
    ) -> None:
        try:
            self.columns = _columns(table, column)
            self.line = _line(table, self.columns, interpolation)
        except StandardFault as fault:
            raise Misdeclared(f"step {name}: {fault}") from None
        self.x, self.y = (si_values(own.values, own.unit) for own in self.columns)
        through = self.line.function

        def between(x: Any) -> Any:
            k = self.piece(x)
            return through(x, self.x[k], self.y[k], self.x[k + 1], self.y[k + 1])

        super().__init__(between, name)
        self.across = of

    @cached_property
    def parameters(self) -> tuple[str, ...]:
        return (self.across,)

    def piece(self, x: Any) -> Array:
        """Return between which row and the next one each x lies."""
        found: Array = np.clip(np.searchsorted(self.x, x, side="right") - 1, 0, len(self.x) - 2)
        return found

    def through(self, x: Node, *rows: Node) -> Node:
        """Return the expression of the line at ``x`` through two rows: x_1, y_1, x_2, y_2."""
        return substitute(self.line.tree, dict(zip(self.line.parameters, (x, *rows), strict=True)))

    @property
    def function(self) -> Callable[..., Any]:
        return self._function

    @cached_property
    def spoken(self) -> Node:
        """All pieces as cases, with the table's numbers as constants."""
        sought = Node("sym", (self.across,))
        numbers = {
            f"{name}_{k}": Constant(float(value), f"{name}_{k}", unit(own.unit).si).node
            for name, own, values in zip("xy", self.columns, (self.x, self.y), strict=True)
            for k, value in enumerate(values)
        }
        pieces = [
            self.through(sought, *(numbers[f"{name}_{row}"] for row in (k, k + 1) for name in "xy"))
            for k in range(len(self.x) - 1)
        ]
        branches = [(piece, Node("cmp", ("<", sought, numbers[f"x_{k}"]))) for k, piece in enumerate(pieces[:-1], 1)]
        return Node("cases", (*branches, (pieces[-1],))) if branches else pieces[-1]


def _columns(table: object, column: str) -> tuple[Column, Column]:
    if not isinstance(table, StandardTable):
        template = "{table} is not a table; write one with own_table(…), rows of numbers and its sources."
        raise StandardFault(Phrase(template, table=repr(table)))
    if table.names:
        raise StandardFault("The table “{title}” goes by names; one that goes by numbers is needed.", title=table.title)
    if column == table.columns[0].name:
        raise StandardFault(
            "The table “{title}” goes by {column}; take another column.", title=table.title, column=column
        )
    return table.columns[0], table.column(column)


def _line(table: StandardTable, columns: tuple[Column, Column], interpolation: Interpolation) -> Formula:
    if interpolation not in LINES:
        near = nearest(str(interpolation), LINES)
        message = "interpolation is {interpolation}{near}; allowed: {lines}."
        raise StandardFault(Phrase(message, interpolation=repr(interpolation), near=near, lines=", ".join(LINES)))
    for own in (columns[index] for index in LOGARITHMIC[interpolation]):
        if below := [value for value in own.values if value <= 0]:
            template = "has the number {value} in its column {name}, which has no logarithm"
            message = Phrase(template, value=format(below[0], "g"), name=own.name)
            raise StandardFault(
                "The table “{title}” {words}; interpolate linearly there.", title=table.title, words=message
            )
    return LINES[interpolation]


@dataclass(frozen=True, eq=False)
class Interpolated(Value):
    """Declare a value between the rows of a table that go by numbers, by the quantity ``of``: straight from row to row.

    With ``interpolation`` "log-x", "log-y" or "log-log" it is straight on logarithmic axes (x, across, is ``of``).
    It is a number, a row or a curve, as ``of`` is; ``formula`` is a ``Between`` of the table's columns. Outside of the table
    the machine is impossible: ``key`` is then the input to change, else ``of``.
    """

    formula: Written = field(init=False)
    table: StandardTable
    of: str
    column: str = field(default="", kw_only=True)
    key: str = field(default="", kw_only=True)
    interpolation: Interpolation = field(default="linear", kw_only=True)

    TAKES: ClassVar[dict[str, Kinds]] = {"of": ANY}

    def __post_init__(self) -> None:
        object.__setattr__(self, "formula", Between(self.table, self.column, self.of, self.id, self.interpolation))
        super().__post_init__()

    @property
    def between(self) -> Between:
        """Return the formula that goes through the table."""
        own = self.formula
        assert isinstance(own, Between)
        return own

    @cached_property
    def corners(self) -> tuple[Value, ...]:
        """Return curves that cross zero where ``of`` crosses an inner row of the table, so that this one has a corner there."""
        return tuple(
            Value(f"{self.id}@{index}", "", self.unit, "", m[self.of] - number(float(row)))
            for index, row in enumerate(self.between.x[1:-1], 1)
        )

    def faults(self, names: Names, when: Any) -> Iterator[str]:
        yield from super().faults(names, when)
        across, upwards = self.between.columns
        yield from unlike_units(column_title(upwards), upwards.unit, self.all_units, phrase("the step"))
        yield from unlike_units(column_title(across), across.unit, names.units(self.of), self.of)
        yield from key_faults(self.key, self.of, names, self._is_covered(names), phrase("lie outside of the table"))

    def _is_covered(self, names: Names) -> bool:
        """Whether the table goes over an abscissa of a period that is always the same."""
        low, high = self.between.x[[0, -1]]
        givers = names.givers(self.of)
        periods = [getattr(giver.step, "period", "") if giver.kind == "abscissa" else "" for giver in givers]
        return all(not isinstance(each, str) and low <= 0 and each <= high * (1 + ROUNDING) for each in periods)

    def cuts(self, axis: str, axes: Mapping[str, str]) -> bool:
        return axes.get(self.id) == axis

    def run(self, calc: StepEngine) -> None:
        super().run(calc)
        axis = calc.axis.get(self.id)
        if axis not in calc.domains:
            self._require_inside(calc, calc.existing(self, calc[self.of]))
            return
        self._require_inside(calc, self._ends(calc, str(axis)))
        calc.domains[str(axis)].cut(self._corner_places(calc, str(axis)))

    def _ends(self, calc: StepEngine, axis: str) -> Array:
        """The least and the greatest value of the quantity along its abscissa, shape (variants, 2)."""
        if self.of == axis:
            return np.concatenate([np.zeros((calc.count, 1)), calc.domains[axis].period], axis=1)
        if self.of not in calc.curves:
            return calc[self.of]
        return np.concatenate([calc.extreme(self.of, sign)[0] for sign in (-1.0, 1.0)], axis=1)

    def _corner_places(self, calc: StepEngine, axis: str) -> Array:
        """Where on the abscissa the quantity passes the inner rows of the table, shape (variants, any number), NaN where it does not."""
        rows = self.between.x[1:-1]
        if self.of == axis:
            places = np.tile(rows, (calc.count, 1))
            return np.where((places > 0) & (places < calc.domains[axis].period), places, np.nan)
        found = [np.full((calc.count, 1), np.nan)]
        known = calc.axis
        for corner in self.corners:
            calc.curves[corner.id], calc.axis = corner, {**known, corner.id: axis}
            found.append(calc.crossings(corner.id)[0])
            del calc.curves[corner.id]
        calc.axis = known
        return np.concatenate(found, axis=1)

    def _require_inside(self, calc: StepEngine, values: Array) -> None:
        low, high = self.between.x[[0, -1]]
        beyond = np.maximum(low - values, values - high)
        for variant in np.flatnonzero((beyond > ROUNDING * (high - low)).any(axis=1)):
            part = int(np.nanargmax(beyond[variant]))
            words = "" if calc.is_partial else self._outside(calc, float(values[variant, part]))
            calc.refuse(int(variant), key_to_change(self, self.of, calc, part), words)

    def _outside(self, calc: StepEngine, value: float) -> str:
        """What lies outside, and what the table has."""
        own, declared = self.between.columns[0], calc.step_or_input(self.of)
        first, last = (with_unit(number_text(end, MOST_DIGITS), own.unit) for end in (own.values[0], own.values[-1]))
        is_input = self.of not in calc.steps and not self.key
        template = (
            "{text} {shown}, outside of the table “{title}” for {description} ({symbol}), which goes from "
            "{first} to {last}"
        )
        return Phrase(
            template,
            text=phrase("is") if is_input else phrase("leads to"),
            shown=f"{declared.symbol} = {with_unit(_beyond(value / unit(own.unit).factor, own.values), own.unit)}",
            title=self.table.title,
            description=self.description,
            symbol=self.symbol,
            first=first,
            last=last,
        )

    def items(self, page: StepPrinter) -> list[Item]:
        exact = self._exact_row(page) if page.calc.axis.get(self.id) is None else None
        return super().items(page) if exact is None else [self.head() | exact]

    def _exact_row(self, page: StepPrinter) -> Item | None:
        value, (_, taken) = float(page.calc[self.of][0, 0]), self.between.columns
        if not (np.abs(self.between.x - value) <= SAME * abs(value)).any():
            return None
        by = page.calc.step_or_input(self.of)
        item = {
            "type": "lookup",
            "by": by.description,
            "key": f"{by.symbol} = {page.printed(self.of)}",
            "table": self.table.title,
        }
        result = page.result(self, page.value_at(self.id, None))
        return item | {"column": taken.name} | sources(self.table) | {"result": result}


def _beyond(value: float, rows: Sequence[float]) -> str:
    texts = (number_text(value, digits) for digits in range(DIGITS, MOST_DIGITS + 1))
    return next((text for text in texts if not rows[0] <= float(text) <= rows[-1]), number_text(value, MOST_DIGITS))
