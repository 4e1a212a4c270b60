"""The stored variants of a study, opened for questions: read only, by DuckDB over the part files."""

from __future__ import annotations

import glob
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from diecut_report.batch.state import read_state
from diecut_report.errors import Problem, UserError
from diecut_report.units import UnitError, unit

if TYPE_CHECKING:
    from duckdb import DuckDBPyConnection

Kind = Literal["float", "int", "bool", "text"]
KINDS: dict[str, Kind] = {"DOUBLE": "float", "FLOAT": "float", "BOOLEAN": "bool", "VARCHAR": "text"}
DISPLAY = {"m": "mm", "rad": "deg", "rad/s": "rpm", "Pa": "MPa"}  # as designers say it; all else stays in SI
FIXED = ("variant", "status", "governing", "error")
STATUSES = ("pass", "warn", "fail", "error")
MEMORY, BATCH = "400MB", 50_000  # of DuckDB, and rows at a time


@dataclass(frozen=True)
class Column:
    """A stored quantity: its name, what it holds, its SI unit, and the unit that people read."""

    name: str
    kind: Kind
    unit: str = "1"
    display: str = "1"

    @property
    def is_number(self) -> bool:
        """Whether it has sizes: floats and integers."""
        return self.kind in ("float", "int")

    @property
    def sql(self) -> str:
        """The name for DuckDB."""
        return quoted(self.name)


@dataclass(frozen=True)
class Stored:
    """A folder of results: what ``study.json`` says, the columns, and a connection that reads the part files alone."""

    folder: Path
    study: Mapping[str, Any]
    columns: Mapping[str, Column]
    connection: DuckDBPyConnection

    @cached_property
    def varied(self) -> list[Column]:
        """What the study varies, in its order."""
        return [self.columns[path] for path in self.study.get("varied", ()) if path in self.columns]

    @cached_property
    def checks(self) -> dict[str, tuple[Column, Column]]:
        """Each check, ``drive.checks.play``, with its columns of utilisation and status."""
        ends = (".utilisation", ".status")
        names = [name.removesuffix(ends[0]) for name in self.columns if ".checks." in name and name.endswith(ends[0])]
        return {name: (self.columns[name + ends[0]], self.columns[name + ends[1]]) for name in names}

    @cached_property
    def outputs(self) -> list[Column]:
        """The kept outputs."""
        other = {*FIXED, *(column.name for column in self.varied)}
        return [
            column for column in self.columns.values() if column.name not in other and ".checks." not in column.name
        ]

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
    config: dict[str, str | bool | int | float | list[str]] = {
        "memory_limit": MEMORY,
        "temp_directory": tempfile.gettempdir(),
        "preserve_insertion_order": "false",
    }
    with duckdb.connect(":memory:", config=config) as connection:
        try:
            yield Stored(folder, study, _columns(_view(connection, folder), study), connection)
        except (duckdb.IOException, duckdb.InvalidInputException) as error:
            words = f"The stored variants cannot be read ({_first(error)}). Run the study again, or put the file back."
            raise UserError(Problem(words, str(folder / "variants"))) from error


def _first(error: Exception) -> str:
    return str(error).splitlines()[0]


def _study(folder: Path) -> Mapping[str, Any]:
    study = read_state(folder)
    if not any((folder / "variants").glob("part-*.parquet")):
        words = "No variants are stored here yet. Continue the run with `batch --resume`."
        raise UserError(Problem(words, str(folder)))
    return study


def _view(connection: DuckDBPyConnection, folder: Path) -> list[tuple[str, str]]:
    """Names the part files ``v`` and shuts everything else; the columns with their types."""
    place = str((folder / "variants").absolute())
    escaped = glob.escape(place)  # a folder may be called a[1]
    connection.execute(f"CREATE VIEW v AS SELECT * FROM read_parquet({text(f'{escaped}/part-*.parquet')})")
    connection.execute(f"SET allowed_directories = [{text(place)}, {text(escaped)}]")
    connection.execute("SET enable_external_access = false")
    connection.execute("SET lock_configuration = true")
    return [(row[0], row[1]) for row in connection.execute("DESCRIBE v").fetchall()]


def _columns(described: list[tuple[str, str]], study: Mapping[str, Any]) -> dict[str, Column]:
    said = study.get("columns", {})
    return {
        name: _column(name, KINDS.get(kind, "int"), said.get(name, "1")) for name, kind in described if _is_plain(kind)
    }


def _is_plain(kind: str) -> bool:
    """Curves, which are lists, are no quantities to compare."""
    return not kind.endswith("[]")


def _column(name: str, kind: Kind, said: Any) -> Column:
    """A column by what study.json says of it: its SI unit, or a block with ``unit`` and perhaps ``display``."""
    block = said if isinstance(said, dict) else {"unit": said}
    si = str(block.get("unit") or "1")
    display = str(block.get("display") or DISPLAY.get(si, si))
    return Column(name, kind, si, display if _is_like(display, si) else si)


def _is_like(display: str, si: str) -> bool:
    """Whether the one is a unit for the other."""
    try:
        return unit(display).kind == unit(si).kind
    except UnitError:
        return False
