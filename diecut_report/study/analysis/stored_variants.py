"""The stored variants of a study, opened for questions: read only, by DuckDB over the part files."""

from __future__ import annotations

import glob
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from diecut_report.errors import Problem, UserError
from diecut_report.given_files import refuse_special
from diecut_report.quantities.units import UnitError, unit
from diecut_report.study.analysis.titles import UTILISATION, VERDICT_OF, titles
from diecut_report.study.storage.description import VARIANT, VERDICT, Description, Kind
from diecut_report.study.storage.state import read_description, read_state

if TYPE_CHECKING:
    from duckdb import DuckDBPyConnection

DISPLAY = {
    "m": "mm",
    "rad": "deg",
    "rad/s": "rpm",
    "Pa": "MPa",
    "1/s": "1/h",
}  # as designers say it, where a column does not
FIXED = (VARIANT.name, *(column.name for column in VERDICT))
STATUSES = ("pass", "warn", "fail", "error")
PARTS = "part-*.parquet"
MEMORY = "400MB"  # of DuckDB


@dataclass(frozen=True)
class StoredColumn:
    """A stored quantity: its name, what it holds, its SI unit, the unit that people read, its symbol, and what it is."""

    name: str
    kind: Kind
    unit: str = "1"
    display: str = "1"
    symbol: str = ""
    title: str = ""

    @property
    def is_number(self) -> bool:
        """Whether it has sizes: floats and integers."""
        return self.kind in ("float", "int")

    @property
    def sql(self) -> str:
        """The name for DuckDB."""
        return quoted(self.name)

    @property
    def told(self) -> str:
        """What people call it."""
        return self.title or self.name.removeprefix("mechanisms.")


@dataclass(frozen=True)
class Stored:
    """A folder of results: its study, what ``study.json`` says, the columns, and a connection that reads the part files alone."""

    folder: Path
    description: Description
    study: Mapping[str, Any]
    columns: Mapping[str, StoredColumn]
    connection: DuckDBPyConnection

    @cached_property
    def varied(self) -> list[StoredColumn]:
        """What the study varies, in its order."""
        return [self.columns[path] for path in self.study.get("varied", ()) if path in self.columns]

    @cached_property
    def checks(self) -> dict[str, tuple[StoredColumn, StoredColumn]]:
        """Each check, ``drive.checks.play``, with its columns of utilisation and status."""
        names = [
            name.removesuffix(UTILISATION) for name in self.columns if ".checks." in name and name.endswith(UTILISATION)
        ]
        return {name: (self.columns[name + UTILISATION], self.columns[name + VERDICT_OF]) for name in names}

    @cached_property
    def outputs(self) -> list[StoredColumn]:
        """The kept outputs."""
        other = {*FIXED, *(column.name for column in self.varied)}
        return [
            column for column in self.columns.values() if column.name not in other and ".checks." not in column.name
        ]

    def check_told(self, check: str) -> str:
        """What people call a check."""
        return self.checks[check][1].told if check in self.checks else check

    def rows(self, sql: str, parameters: Any = ()) -> list[tuple[Any, ...]]:
        """The whole answer to a query, which is to be small."""
        return self.connection.execute(sql, list(parameters)).fetchall()


def quoted(name: str) -> str:
    """A name as DuckDB takes it."""
    return '"' + name.replace('"', '""') + '"'


def text(value: str) -> str:
    """A text as DuckDB takes it."""
    return "'" + value.replace("'", "''") + "'"


@contextmanager
def opened(folder: Path) -> Iterator[Stored]:
    """The stored variants of a study; UserError in words where there are none or they cannot be read.

    The connection reads the folder's part files and nothing else, and writes nothing.
    """
    import duckdb

    study = _study(folder)
    description = read_description(folder)
    config: dict[str, str | bool | int | float | list[str]] = {
        "memory_limit": MEMORY,
        "temp_directory": tempfile.gettempdir(),
        "preserve_insertion_order": "false",
    }
    with duckdb.connect(":memory:", config=config) as connection:
        try:
            _view(connection, folder)
            yield Stored(folder, description, study, columns_of(description), connection)
        except (duckdb.IOException, duckdb.InvalidInputException) as error:
            words = f"The stored variants cannot be read ({_first(error)}). Run the study again, or put the file back."
            raise UserError(Problem(words, str(folder / "variants"))) from error


def _first(error: Exception) -> str:
    return str(error).splitlines()[0]


def _study(folder: Path) -> Mapping[str, Any]:
    study = read_state(folder)
    parts = list((folder / "variants").glob(PARTS))
    refuse_special(parts, "It is no part of the results. Move it to another folder.")
    if not parts:
        words = "No variants are stored here yet. Continue the run with `batch --resume`."
        raise UserError(Problem(words, str(folder)))
    return study


def _view(connection: DuckDBPyConnection, folder: Path) -> None:
    """Names the part files ``v`` and shuts everything else."""
    place = str((folder / "variants").absolute())
    escaped = glob.escape(place)  # a folder may be called a[1]
    # each by its name: in a pattern a folder called a\\b would be two folders
    parts = ", ".join(text(glob.escape(str(path.absolute()))) for path in sorted((folder / "variants").glob(PARTS)))
    connection.execute(f"CREATE VIEW v AS SELECT * FROM read_parquet([{parts}])")
    connection.execute(f"SET allowed_directories = [{text(place)}, {text(escaped)}]")
    connection.execute("SET enable_external_access = false")
    connection.execute("SET lock_configuration = true")


def columns_of(description: Description) -> dict[str, StoredColumn]:
    """The columns of the part files by name; curves, which are lists, are no quantities to compare."""
    known = titles(description.all_columns)
    return {
        column.name: StoredColumn(column.name, column.kind, column.unit, _display(column.display, column.unit), column.symbol, known[column.name])
        for column in description.all_columns
        if column.kind != "curve"
    }  # fmt: skip


def _display(wanted: str, si: str) -> str:
    """The unit that people read: the column's own, else the usual one for its SI unit."""
    usual = DISPLAY.get(si, si)
    return wanted if wanted and _is_like(wanted, si) else usual


def _is_like(display: str, si: str) -> bool:
    """Whether the one is a unit for the other."""
    try:
        return unit(display).kind == unit(si).kind
    except UnitError:
        return False
