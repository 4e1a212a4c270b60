"""Standard series and tables as they are used: values in a display unit, with the published tables that agree on them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from diecut_report.languages.phrases import Phrase, joined, phrase


class StandardFault(ValueError):
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
            raise StandardFault(
                Phrase(
                    "The table “{title}” {asked}; it has {known}.",
                    title=self.title,
                    asked=asked,
                    known=", ".join(known),
                )
            )
        return known[name]

    def by_name(self, column: str = "") -> Mapping[str, float]:
        """Return a column by the rows' names."""
        return MappingProxyType(dict(zip(self.names, self.column(column).values, strict=True)) if self.names else {})

    def series(self, column: str = "") -> StandardSeries:
        """Return the different values of a column in ascending order, as a standard series."""
        own = self.column(column)
        values = tuple(sorted(set(own.values)))
        title = (
            Phrase("{title}: {column}", title=phrase(self.title), column=phrase(own.name)) if own.name else self.title
        )
        return StandardSeries(
            self.id, title, own.unit, values, self.sources, self.left_out, self.only_source, self.file
        )


def sources_told(taken_from: StandardTable | StandardSeries) -> str:
    """Return in one line what a table or series is and where it comes from."""
    told = Phrase("{title}: {sources}", title=phrase(taken_from.title), sources=joined(taken_from.sources, "; "))
    if not taken_from.only_source:
        return told
    return Phrase("{told} (one source: {reason})", told=told, reason=phrase(taken_from.only_source))
