"""The stored variants of a study, opened for questions: read only, by DuckDB over the part files."""

from __future__ import annotations

import glob
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from diecut_report.config import yaml_tree
from diecut_report.errors import Problem, UserError
from diecut_report.languages.catalogues import SOURCE_LANGUAGE
from diecut_report.languages.phrases import Phrase
from diecut_report.languages.speech import know_plugins, spoken_language
from diecut_report.quantities.units import UnitError, unit
from diecut_report.study.analysis.titles import UTILISATION, VERDICT_OF, titles
from diecut_report.study.storage.description import VARIANT, VERDICT, Description, Kind
from diecut_report.study.storage.state_form import continuing
from diecut_report.study.storage.store import Store

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
    """Hold a stored quantity: its name, what it holds, its SI unit, the unit that people read, its symbol, and what it is."""

    name: str
    kind: Kind
    unit: str = "1"
    display: str = "1"
    symbol: str = ""
    title: str = ""

    @property
    def is_number(self) -> bool:
        """Return whether it has sizes: floats and integers."""
        return self.kind in ("float", "int")

    @property
    def sql(self) -> str:
        """Return the name for DuckDB."""
        return quoted(self.name)

    @property
    def told(self) -> str:
        """Return what people call it."""
        return self.title or self.name.removeprefix("mechanisms.")


@dataclass(frozen=True)
class Stored:
    """Hold a folder of results: its study, what ``study.json`` says, the columns, and a connection that reads the part files alone."""

    folder: Path
    description: Description
    study: Mapping[str, Any]
    columns: Mapping[str, StoredColumn]
    connection: DuckDBPyConnection

    @cached_property
    def varied(self) -> list[StoredColumn]:
        """Return what the study varies, in its order."""
        return [self.columns[path] for path in self.study.get("varied", ()) if path in self.columns]

    @cached_property
    def checks(self) -> dict[str, tuple[StoredColumn, StoredColumn]]:
        """Return each check, ``drive.checks.play``, with its columns of utilisation and status."""
        names = [
            name.removesuffix(UTILISATION) for name in self.columns if ".checks." in name and name.endswith(UTILISATION)
        ]
        return {name: (self.columns[name + UTILISATION], self.columns[name + VERDICT_OF]) for name in names}

    @cached_property
    def outputs(self) -> list[StoredColumn]:
        """Return the kept outputs."""
        other = {*FIXED, *(column.name for column in self.varied)}
        return [
            column for column in self.columns.values() if column.name not in other and ".checks." not in column.name
        ]

    def check_told(self, check: str) -> str:
        """Return what people call a check."""
        return self.checks[check][1].told if check in self.checks else check

    def rows(self, sql: str, parameters: Any = ()) -> list[tuple[Any, ...]]:
        """Return the whole answer to a query, which is to be small."""
        return self.connection.execute(sql, list(parameters)).fetchall()


def quoted(name: str) -> str:
    """Return a name as DuckDB takes it."""
    return '"' + name.replace('"', '""') + '"'


def text(value: str) -> str:
    """Return a text as DuckDB takes it."""
    return "'" + value.replace("'", "''") + "'"


@contextmanager
def opened(folder: Path) -> Iterator[Stored]:
    """Open the stored variants of a study; UserError in words where there are none or they cannot be read.

    The connection reads the folder's part files and nothing else, and writes nothing.
    """
    import duckdb

    store = Store.open(folder)
    paths = store.whole_parts()
    if not paths:
        columns = dict.fromkeys(column.name for column in store.description.columns)
        words = Phrase(
            "No variants are stored here yet. Continue the run with: {continued}", continued=continuing(folder, columns)
        )
        raise UserError(Problem(words, str(folder)))
    description = store.description
    config: dict[str, str | bool | int | float | list[str]] = {
        "memory_limit": MEMORY,
        "temp_directory": tempfile.gettempdir(),
        "preserve_insertion_order": "false",
    }
    with duckdb.connect(":memory:", config=config) as connection:
        try:
            _view(connection, paths)
            yield Stored(folder, description, store.state, columns_of(description), connection)
        except duckdb.InterruptException as error:
            raise KeyboardInterrupt from error
        except (
            duckdb.Error
        ) as error:  # the parts are as they were written: what is asked gives no answer, or there is no room
            words = Phrase(
                "The stored variants give no answer to this ({first}). Ask for something else, or for less at a time.",
                first=_first(error),
            )
            raise UserError(Problem(words, str(folder))) from error


def _first(error: Exception) -> str:
    return str(error).splitlines()[0]


def _view(connection: DuckDBPyConnection, paths: Sequence[Path]) -> None:
    """Name the part files ``v`` and shut everything else."""
    files = [str(path.absolute()) for path in paths]
    named = ", ".join(text(glob.escape(file)) for file in files)  # a folder may be called a[1]
    connection.execute(f"CREATE VIEW v AS SELECT * FROM read_parquet([{named}])")
    connection.execute(f"SET allowed_paths = [{', '.join(map(text, files))}]")
    connection.execute("SET enable_external_access = false")
    connection.execute("SET lock_configuration = true")


def columns_of(description: Description) -> dict[str, StoredColumn]:
    """Return the columns of the part files by name; curves, which are lists, are not quantities to compare."""
    known = titles(description.all_columns, _kinds(description))
    return {
        column.name: StoredColumn(column.name, column.kind, column.unit, _display(column.display, column.unit), column.symbol, known[column.name])
        for column in description.all_columns
        if column.kind != "curve"
    }  # fmt: skip


def _kinds(description: Description) -> Mapping[str, str]:
    """The kinds of the mechanisms by name, so that their columns are told in the words of their plugins; none in English."""
    content = description.base.content
    if spoken_language() == SOURCE_LANGUAGE:
        return {}
    know_plugins(description.plugins)  # also where the base is not kept any more
    given = yaml_tree.parse(content.decode("utf-8-sig"), description.base.file).data if content else {}
    return {name: str(block.get("kind")) for name, block in (given.get("mechanisms") or {}).items()}


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
