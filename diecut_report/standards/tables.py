"""Standard series and tables as they are used: values in a display unit, with the published tables that agree on them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from types import MappingProxyType
from typing import Any, NoReturn

from diecut_report.quantities.units import UnitError, unit
from diecut_report.text.phrases import MessageError, Phrase, joined, phrase


class StandardFault(MessageError, ValueError):
    """Report a series or table that cannot be trusted, or an id that no file has; the text says which and what to fix.

    ``row`` is the number of the row at fault, from 0; of a file beside a plugin the text ``tells_place``, with the line.
    """

    row: int | None = None
    tells_place: bool = False


@dataclass(frozen=True)
class StandardSeries:
    """Hold standard values in ascending order, in the display unit ``unit``, and the published tables that agree on them."""

    id: str
    title: str
    unit: str
    values: tuple[float, ...]
    sources: tuple[str, ...]
    left_out: str = ""
    only_source: str = ""
    file: str = ""

    @property
    def is_of_the_program(self) -> bool:
        """Return whether it is one of the program's standard series, not one that a plugin brings."""
        return bool(self.id) and not self.file


@dataclass(frozen=True)
class Column:
    """A column of a table: a value for each row, in the display unit ``unit``."""

    name: str
    unit: str
    values: tuple[float, ...]


@dataclass(frozen=True)
class StandardTable:
    """Hold rows of standard values, and the published tables that agree on them.

    Each row has a name; where ``names`` is empty the rows go by the numbers of the first column, which ascend.
    ``only_source`` says why there is one source only, ``file`` is where the table was read from.
    """

    id: str
    title: str
    columns: tuple[Column, ...]
    sources: tuple[str, ...]
    left_out: str = ""
    names: tuple[str, ...] = ()
    only_source: str = ""
    file: str = ""

    @property
    def is_of_the_program(self) -> bool:
        """Return whether it is one of the program's standard tables, not one that a plugin brings."""
        return bool(self.id) and not self.file

    @property
    def of_values(self) -> tuple[Column, ...]:
        """Return the columns but the one whose numbers the rows go by."""
        return self.columns if self.names else self.columns[1:]

    @property
    def unit(self) -> str:
        """Return the unit of the only column of values."""
        return self.column().unit

    @property
    def values(self) -> Mapping[str, float]:
        """Return the only column of values, by the rows' names."""
        return self.by_name()

    def column(self, name: str = "") -> Column:
        """Return the column of this name, or the only column of values; StandardFault where there is none."""
        if not name and len(self.of_values) == 1:
            return self.of_values[0]
        known = {column.name: column for column in self.columns}
        if name not in known:
            asked = Phrase("has no column {name}", name=repr(name)) if name else phrase("has several columns; name one")
            template = "The table “{title}” {asked}; it has {known}."
            raise StandardFault(template, title=self.title, asked=asked, known=", ".join(known))
        return known[name]

    def by_name(self, column: str = "") -> Mapping[str, float]:
        """Return a column by the rows' names."""
        return MappingProxyType(dict(zip(self.names, self.column(column).values, strict=True)) if self.names else {})

    def series(self, column: str = "") -> StandardSeries:
        """Return the different values of a column in ascending order, as a standard series."""
        own = self.column(column)
        values = tuple(sorted(set(own.values)))
        named = Phrase("{title}: {column}", title=phrase(self.title), column=phrase(own.name))
        title = named if own.name else self.title
        return StandardSeries(
            self.id, title, own.unit, values, self.sources, self.left_out, self.only_source, self.file
        )


def sources_told(taken_from: StandardTable | StandardSeries) -> str:
    """Return in one line what a table or series is and where it comes from."""
    message = Phrase("{title}: {sources}", title=phrase(taken_from.title), sources=joined(taken_from.sources, "; "))
    if not taken_from.only_source:
        return message
    return Phrase("{told} (one source: {reason})", told=message, reason=phrase(taken_from.only_source))


# Tables and series of an author's own, with their sources, checked where they are written.


Rows = Mapping[str, Any] | Sequence[Sequence[Any]]


def own_table(
    *, title: str, rows: Rows, sources: Sequence[str], unit: str = "", columns: Mapping[str, str] | None = None, left_out: str = "",
    only_source: str = "",
) -> StandardTable:  # fmt: skip
    """Return a table that an author brings, checked; StandardFault says what is wrong with it.

    ``rows`` are values by name, {"steel": 7850} in ``unit`` or {"6204": (20, 13.5)} in the units of ``columns``
    ({"bore": "mm", "C": "kN"}); or rows of numbers, ((12, 0.245), (15, 0.29)), whose first column ascends.
    ``sources`` are two published tables that agree, or one and in ``only_source`` why there is no other.
    """
    _texts(title, sources, only_source)
    if bool(unit) is bool(columns):
        _fault(title, phrase('needs one of unit="…" (a value for each name) and columns={"name": "unit", …}'))
    names, cells = _cells(title, rows)
    units = dict(columns) if columns else {"": unit}
    for number, (where, row) in enumerate(zip(names or cells, cells, strict=True)):
        _row(title, where, row, len(units), number)
    by_column = zip(units.items(), zip(*cells, strict=True), strict=True)
    made = [Column(name, shown, tuple(map(float, values))) for (name, shown), values in by_column]
    _units(title, made)
    if not names:
        _ascending(title, made)
    return StandardTable("", title, tuple(made), tuple(sources), left_out, tuple(names), only_source)


def own_series(
    *, title: str, unit: str, values: Sequence[float], sources: Sequence[str], left_out: str = "", only_source: str = ""
) -> StandardSeries:
    """Return a standard series that an author brings, checked as ``own_table`` checks; its values ascend."""
    _texts(title, sources, only_source)
    for value in values:
        _number(title, phrase("the series"), value)
    column = Column("values", unit, tuple(float(value) for value in values))
    _units(title, [column])
    _ascending(title, [column], least=1)
    return StandardSeries("", title, unit, column.values, tuple(sources), left_out, only_source)


def _texts(title: object, sources: Any, only_source: str) -> None:
    if not isinstance(title, str) or not title.strip():
        _fault(str(title), phrase("has no title"))
    if isinstance(sources, str) or not all(isinstance(text, str) and text.strip() for text in sources):
        _fault(title, phrase("needs its sources as texts in brackets, that say what was published where"))
    if not sources or (len(set(sources)) < 2 and not only_source):
        _fault(title, phrase('needs two sources that agree, or one and only_source="why there is no other"'))


def _cells(title: str, rows: Rows) -> tuple[list[str], list[tuple[Any, ...]]]:
    """The names of the rows (none where they go by numbers), and the values in them."""
    if isinstance(rows, Mapping):
        listed = [(name, *(cells if isinstance(cells, list | tuple) else (cells,))) for name, cells in rows.items()]
    else:
        listed = [tuple(row) if isinstance(row, list | tuple) else (row,) for row in rows]
    if not listed:
        _fault(title, phrase("has no rows"))
    if not isinstance(listed[0][0], str):
        return [], listed
    names = [row[0] for row in listed]
    for number, name in enumerate(names):
        if not isinstance(name, str) or not name.strip():
            message = Phrase("has the name {strange} of a row, which is not a text", strange=repr(name))
            _fault(title, message, row=number)
        if name in names[:number]:
            _fault(title, Phrase("has two rows of the name {twice}", twice=repr(name)), row=number)
    return names, [row[1:] for row in listed]


def _row(title: str, where: object, row: tuple[Any, ...], count: int, number: int) -> None:
    if len(row) != count:
        template = "has {count} values in the row {where}, where {wanted} are needed"
        _fault(title, Phrase(template, count=len(row), where=repr(where), wanted=count), row=number)
    for value in row:
        _number(title, Phrase("the row {where}", where=repr(where)), value, number)


def _number(title: str, where: str, value: object, row: int | None = None) -> None:
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        template = "holds {value} in {where}, which is not a finite number"
        _fault(title, Phrase(template, value=repr(value), where=where), row=row)


def _units(title: str, columns: Iterable[Column]) -> None:
    for column in columns:
        try:
            unit(column.unit)
        except UnitError as error:
            where = Phrase(" of {name}", name=column.name) if column.name else ""
            _fault(title, Phrase("has no usable unit{where}: {error}", where=where, error=error), error)


def _ascending(title: str, columns: Sequence[Column], least: int = 2) -> None:
    """Check the first column; a table that goes by numbers needs two rows and a column of values."""
    if len(columns) < least:
        template = "goes by the numbers of its first column and has no other; name its rows, or add a column"
        _fault(title, phrase(template))
    if len(columns[0].values) < least:
        _fault(title, phrase("has too few values; give two rows at least") if least > 1 else phrase("has no values"))
    for number, (before, after) in enumerate(pairwise(columns[0].values), 1):
        if not before < after:
            template = "must ascend in {name} without repetition, but {after} follows {before}"
            message = Phrase(template, name=columns[0].name, after=format(after, "g"), before=format(before, "g"))
            _fault(title, message, row=number)


def _fault(title: str, what: str, cause: Exception | None = None, row: int | None = None) -> NoReturn:
    found = StandardFault("The table “{title}” {what}.", title=title, what=what)
    found.row = row
    raise found from cause
