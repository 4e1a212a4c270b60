"""Steps over repeated parts (a list of blocks in the config), and steps that take from standard series and tables."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal, NamedTuple, Unpack

import numpy as np

from diecut_report.errors import nearest
from diecut_report.formulas import Array
from diecut_report.formulas.formula import Formula, Reading, formula
from diecut_report.formulas.tree import Constant, Node, substitute
from diecut_report.mechanism.names import Binding, Misdeclared, as_binding, bind, bound
from diecut_report.mechanism.steps import (
    MadeCurve,
    Options,
    Prepared,
    SilentStep,
    Step,
    StepCondition,
    StepHolder,
    Value,
    Written,
)
from diecut_report.quantities.units import unit
from diecut_report.standards.tables import Column, StandardFault, StandardSeries, StandardTable
from diecut_report.text.phrases import Phrase, phrase

# Steps of plain code over prepared objects: curves for all variants, repeated parts that follow from the inputs, and facts.


@dataclass(frozen=True, kw_only=True, eq=False)
class ComputedCurve(Step):
    """Declare a curve over ``abscissa`` that plain code gives for all variants, from the prepared object ``of``.

    ``function`` takes it, the places x of shape (rows, points), the middles of their smooth pieces (of any shape that broadcasts to
    that) and the variants ``rows`` (None: all, or the only one); it gives values of the shape of x. ``joints`` gives from the object
    the places where the curve jumps or has a corner, of shape (variants, places), NaN where there is none. With ``named_by`` there is a
    curve for each named part: ``function`` takes the part's index before all else.
    """

    of: str
    abscissa: str
    function: Callable[..., Array]
    method: str
    joints: Callable[[Any], Array] | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class PartNames(SilentStep):
    """Declare repeated parts that are no list of the inputs, but follow from them: ``function`` gives their names.

    Rows run over its id. Formulas of them are shown with the numbers of the part ``shown_at`` (the id of its index from 0). ``count`` says
    how many parts there are, of a function that tells the length of a list of the inputs; without it rows have no columns in a study.
    """

    function: Callable[..., list[str]]
    takes: tuple[str, ...]
    shown_at: str = ""
    count: Callable[[Callable[[str], int]], int] | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class PartTable(SilentStep):
    """Declare a table that is printed here: the rows ``columns`` over the declared ``parts``, a line for each by its name.

    ``parts`` may be a list of the inputs, too: its rows are then printed in such tables alone.
    """

    parts: str
    columns: tuple[str, ...]


@dataclass(frozen=True, kw_only=True, eq=False)
class PartCurves(SilentStep):
    """Declare curves over ``abscissa`` of named parts, from the prepared object ``of``: ``ID_1``, ``ID_2`` … in the results.

    ``names`` gives from it the names of the parts, one for each curve; ``function`` takes it, the part's number (from 0), and
    then what that of ``ComputedCurve`` takes. Each is told by the description and the part's name.
    """

    of: str
    abscissa: str
    names: Callable[[Any], Sequence[str]]
    function: Callable[..., Array]
    method: str
    joints: Callable[[Any], Array] | None = None

    def curves(self, of: Any) -> Iterator[ComputedCurve]:
        """Yield the curve of each part."""
        between = "," if "_" in self.symbol else "_"
        for index, name in enumerate(self.names(of)):
            yield ComputedCurve(
                id=f"{self.id}_{index + 1}", symbol=f"{self.symbol}{between}{index + 1}", unit=self.unit, at=self.at, method=self.method,
                description=Phrase("{title}: {name}", title=phrase(self.description), name=name), source=self.source, of=self.of,
                abscissa=self.abscissa,
                function=lambda of, *places, index=index: self.function(of, index, *places),
            )  # fmt: skip


@dataclass(frozen=True, kw_only=True, eq=False)
class Fact(SilentStep):
    """Declare what other steps stand on: they name its id among their ``needs``, as they do with an input.

    Where the condition does not hold for a machine, they are left out for it, and what refers to them is not calculated;
    ``words`` say why. A check that stands on it is then not checked for want of the first key of ``lacks``, with which the fact is not asked.
    """

    condition: Binding
    words: str


class CodeForm:
    """Give chapters the calls that declare these steps."""

    def computed_curve(
        self: StepHolder, id: str, symbol: str, unit: str, description: str, function: Callable[..., Array], of: str, abscissa: str,
        method: str, *, joints: Callable[[Any], Array] | None = None, **options: Unpack[Options],
    ) -> None:  # fmt: skip
        """Declare a curve that plain code gives: see ``ComputedCurve``."""
        own: dict[str, Any] = {"function": function, "of": of, "abscissa": abscissa, "method": method, "joints": joints}
        self.add(ComputedCurve(id=id, symbol=symbol, unit=unit, description=description, **own, **options))  # type: ignore[arg-type]

    def part_names(
        self: StepHolder, id: str, description: str, function: Callable[..., list[str]], takes: tuple[str, ...], *, shown_at: str = "",
        count: Callable[[Callable[[str], int]], int] | None = None,
    ) -> None:  # fmt: skip
        """Declare repeated parts that follow from the inputs: see ``PartNames``."""
        self.add(
            PartNames(id=id, description=description, function=function, takes=takes, shown_at=shown_at, count=count)
        )

    def part_table(self: StepHolder, id: str, description: str, parts: str, columns: tuple[str, ...]) -> None:
        """Declare a table of rows over such parts, printed here: see ``PartTable``."""
        self.add(PartTable(id=id, description=description, parts=parts, columns=columns))

    def part_curves(
        self: StepHolder, id: str, symbol: str, unit: str, description: str, names: Callable[[Any], Sequence[str]],
        function: Callable[..., Array], of: str, abscissa: str, method: str, *, joints: Callable[[Any], Array] | None = None,
        **when: Unpack[StepCondition],
    ) -> None:  # fmt: skip
        """Declare curves of named parts that plain code gives: see ``PartCurves``."""
        own: dict[str, Any] = {
            "names": names,
            "function": function,
            "of": of,
            "abscissa": abscissa,
            "method": method,
            "joints": joints,
        }
        self.add(PartCurves(id=id, symbol=symbol, unit=unit, description=description, **own, **when))

    def fact(self: StepHolder, id: str, condition: Written, words: str, **when: Unpack[StepCondition]) -> None:
        """Declare what steps and chapters may need beside inputs, and what is said where it does not hold: see ``Fact``."""
        self.add(Fact(id=id, condition=as_binding(condition, id), words=words, **when))


# Tables that plain code makes, where what is to be shown is neither a number nor a curve nor a row of an input's parts.


Cell = float | str | None


class ListedColumn(NamedTuple):
    """Hold a column of a listing: its id in the results, what it is, its symbol and display unit; texts have no unit.

    ``digits`` are the significant digits of its numbers; 0 leaves them to the unit: to what can be made or measured, all alike. A column
    that is not ``printed``, such as keys beside their words, stands in the results alone.
    """

    id: str
    description: str
    symbol: str = ""
    unit: str = "1"
    digits: int = 0
    printed: bool = True


@dataclass(frozen=True, kw_only=True, eq=False)
class Listing(Prepared):
    """Declare a table: ``function`` takes one mapping, as that of ``Prepared`` does, and returns rows of texts and numbers (SI; None: none).

    It is made only where results are told, of one machine. ``taken`` is the quantity, a text or a number, that stands in the first column of
    the row that was taken, which is marked.
    """

    heads: tuple[ListedColumn, ...]
    taken: str = ""


class ListingForm:
    """Give chapters the call that declares a listing."""

    def listing(
        self: StepHolder, id: str, description: str, columns: tuple[ListedColumn, ...], function: Callable[..., Iterable[Sequence[Cell]]],
        holds: tuple[str, ...], taken: str = "", **when: Unpack[StepCondition],
    ) -> None:  # fmt: skip
        """Declare a table that plain code makes: see ``Listing``."""
        own: dict[str, Any] = {"heads": columns, "function": function, "holds": holds, "taken": taken}
        self.add(Listing(id=id, description=description, **own, **when))


# The calls that declare what plain code makes: curves, and what several steps ask.


class MadeCurveForm:
    """Give chapters the calls that declare what plain code makes."""

    def made_curve(
        self: StepHolder, id: str, symbol: str, unit: str, description: str, function: Callable[..., Any], takes: tuple[str, ...],
        abscissa: str, method: str, **options: Unpack[Options],
    ) -> None:  # fmt: skip
        """Declare a curve that plain code makes: see ``MadeCurve``."""
        own: dict[str, Any] = {"function": function, "takes": takes, "abscissa": abscissa, "method": method, **options}
        self.add(MadeCurve(id=id, symbol=symbol, unit=unit, description=description, **own))

    def prepared(
        self: StepHolder, id: str, function: Callable[..., Any], holds: tuple[str, ...], *, for_many: bool = False,
        again: bool = False, **when: Unpack[StepCondition],
    ) -> None:  # fmt: skip
        """Declare what plain code makes of inputs once, for steps that take it by its id: see ``Prepared``; ValueError for ``again`` alone."""
        if again and not for_many:
            raise ValueError(
                Phrase(
                    "{id} is prepared again=True, which calculates all machines at once: write it for many, with "
                    "for_many=True",
                    id=id,
                )
            )
        self.add(Prepared(id=id, function=function, holds=holds, for_many=for_many, again=again, **when))


# A formula that runs between the rows of a table, straight on axes that are linear or logarithmic: it computes by the whole
# table and prints one piece of it.


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
