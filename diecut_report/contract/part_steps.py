"""Steps over repeated parts (a list of blocks in the config), and steps that take from standard series and tables."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from diecut_report.contract.between import Between, difference
from diecut_report.contract.binding import bind, bound
from diecut_report.contract.steps import Step, Value
from diecut_report.standards import Column, StandardSeries, StandardTable


@dataclass(frozen=True, kw_only=True, eq=False)
class Total(Step):
    """Declare the sum, product, least or greatest over repeated parts; with ``among`` (a row) only over the parts where that is above zero."""

    of: str
    operation: Literal["sum", "product", "min", "max"]
    among: str = ""


@dataclass(frozen=True, kw_only=True, eq=False)
class Neighbour(Step):
    """Declare a row: the value of the next part (``shift`` = 1) or of the one before (-1), the parts standing in a closed loop."""

    of: str
    shift: Literal[1, -1] = 1


@dataclass(frozen=True, kw_only=True, eq=False)
class Running(Step):
    """Declare a row: sum or product of a row's parts from the first one up to each."""

    of: str
    operation: Literal["sum", "product"]


@dataclass(frozen=True, kw_only=True, eq=False)
class Part(Step):
    """Declare the value of one part of a row: the first (``index`` = 0), the last (-1)."""

    of: str
    index: int


@dataclass(frozen=True, kw_only=True, eq=False)
class Lookup(Step):
    """Declare a number from a row of a table: the one that a text input names, or the one that has the number ``by``.

    ``by`` is a text for a table whose rows have names, of an input or one that was found (``choice``, ``computed`` with ``is_text``); for one
    whose rows go by numbers it is any number, as one that was picked from it; with ``sought_in``, a column, the number is sought there. It
    is a row where ``by`` is one of repeated parts. ``column`` is the column that is taken, where a table has several. A number that the
    table does not have makes the machine impossible: ``key`` is then the input to change, else ``by``.
    ``given`` is an optional input: where it is given the step has its value.
    """

    by: str
    table: Mapping[str, float] | StandardTable
    column: str = ""
    given: str = ""
    sought_in: str = ""
    key: str = ""

    @property
    def is_by_number(self) -> bool:
        """Return whether the row is the one that has a number, not the one of a name."""
        return isinstance(self.table, StandardTable) and bool(self.sought_in or not self.table.names)

    @property
    def sought(self) -> Column:
        """Return the column in which the number is sought; StandardFault where there is none of this name."""
        assert isinstance(self.table, StandardTable)
        return self.table.column(self.sought_in) if self.sought_in else self.table.columns[0]

    def of_number(self) -> Column:
        """Return the column that is taken for the row with a number."""
        assert isinstance(self.table, StandardTable)
        return self.table.column(self.column)

    def rows(self) -> tuple[Mapping[str, float], str]:
        """Return the numbers by the rows' names, and their unit."""
        if isinstance(self.table, StandardTable):
            return self.table.by_name(self.column), self.table.column(self.column).unit
        return self.table, self.unit


@dataclass(frozen=True, kw_only=True, eq=False)
class Interpolated(Value):
    """Declare a value between the rows of a table that go by numbers, by the quantity ``of``: straight from row to row.

    With ``interpolation`` "log-x", "log-y" or "log-log" it is straight on logarithmic axes (x, across, is ``of``).
    It is a number, a row or a curve, as ``of`` is; ``formula`` is a ``Between`` of the table's columns. Outside of the table
    the machine is impossible: ``key`` is then the input to change, else ``of``.
    """

    of: str
    table: StandardTable
    column: str = ""
    key: str = ""

    @property
    def between(self) -> Between:
        """Return the formula that goes through the table."""
        formula = bound(self.formula).formula
        assert isinstance(formula, Between)
        return formula

    @cached_property
    def corners(self) -> tuple[Value, ...]:
        """Return curves that cross zero where ``of`` crosses an inner row of the table, so that this one has a corner there."""
        return tuple(
            Value(id=f"{self.id}@{number}", unit=self.unit, formula=bind(difference, x=self.of, row=float(row)))
            for number, row in enumerate(self.between.x[1:-1], 1)
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class Pick(Step):
    """Declare a value of a standard series: the next one at or above, at or below, or the nearest to a quantity.

    ``series`` are the standard values: in the display unit, or a standard series; or one for each value of the text
    input ``by``. The neighbours that were not taken are printed too. A quantity beyond the end of the series makes the machine
    impossible, for which ``key`` is then the input to change, else ``of``; ``beyond="last"`` takes the last value there, for a mechanism
    that judges it by a check of its own. ``given`` is an optional input: where it is given the step has its value, whatever it is.
    """

    of: str
    given: str = ""
    key: str = ""
    series: tuple[float, ...] | StandardSeries | Mapping[str, StandardSeries]
    by: str = ""
    rule: Literal["above", "below", "nearest"]
    beyond: Literal["impossible", "last"] = "impossible"
