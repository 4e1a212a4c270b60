"""The stored variants of a study, opened for questions: read only, by DuckDB over the part files; and as a table for people."""

from __future__ import annotations

import glob
import io
import re
import tempfile
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from diecut_report.config import yaml
from diecut_report.config.plugins import Discovery, DuplicateKind, UnknownKind
from diecut_report.config.source_hashes import plugin_hash, program_hash
from diecut_report.errors import PluginError, refusal
from diecut_report.quantities.formatting import number_text
from diecut_report.quantities.units import UnitError, pretty, unit
from diecut_report.report.text import number
from diecut_report.study.definition.base_inputs import MECHANISMS
from diecut_report.study.storage.description import (
    JUDGED,
    VARIANT,
    VERDICT,
    Description,
    ResultColumn,
    continuing,
    short_hash,
    source_name,
)
from diecut_report.study.storage.store import Store
from diecut_report.text.catalogues import SOURCE_LANGUAGE
from diecut_report.text.phrases import Phrase, phrase
from diecut_report.text.translation import decimal_sign, know_plugins, said, say, spoken_language

if TYPE_CHECKING:
    from duckdb import DuckDBPyConnection

# the usual units, where a column has none
DISPLAY = {"m": "mm", "rad": "deg", "rad/s": "rpm", "Pa": "MPa", "1/s": "1/h"}
FIXED = (VARIANT.name, JUDGED.name, *(column.name for column in VERDICT))
UTILISATION, STATUS = ".utilisation", ".status"  # ends of the columns of a check
MEMORY, OF_COLUMN = 400, 0.15  # MB for DuckDB, and for each column, of which each thread holds a piece
MOST_COLUMNS = 1000  # that several threads read at a time


@dataclass(frozen=True)
class StoredColumn(ResultColumn):
    """Hold a stored quantity: a column with the unit that people read, whether it is another or not, and with what it is called."""

    display: str = "1"
    title: str = ""

    @property
    def sql(self) -> str:
        """Return the name for DuckDB."""
        return quoted(self.name)

    @property
    def label(self) -> str:
        """Return what people call it."""
        return self.title or self.name.removeprefix(f"{MECHANISMS}.")


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
        ends = (name for name in self.columns if ".checks." in name and name.endswith(UTILISATION))
        names = [name.removesuffix(UTILISATION) for name in ends]
        return {name: (self.columns[name + UTILISATION], self.columns[name + STATUS]) for name in names}

    @cached_property
    def outputs(self) -> list[StoredColumn]:
        other = {*FIXED, *(column.name for column in self.varied)}
        return [each for name, each in self.columns.items() if name not in other and ".checks." not in name]

    def check_label(self, check: str) -> str:
        """Return what people call a check."""
        return self.checks[check][1].label if check in self.checks else check

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
    """Open the stored variants of a study; UserError where there are none or they cannot be read.

    The connection reads the folder's part files and nothing else, and writes nothing.
    """
    import duckdb

    store = Store.open(folder)
    paths = store.whole_parts()
    if not paths:
        command = continuing(folder, [column.name for column in store.description.columns])
        raise refusal("No variants are stored here yet. Continue the run with: {continued}", folder, continued=command)
    columns = len(store.description.columns)
    config: dict[str, str | bool | int | float | list[str]] = {
        "memory_limit": f"{MEMORY + OF_COLUMN * columns:.0f}MB",
        "temp_directory": tempfile.gettempdir(),
        "preserve_insertion_order": "false",
        **({"threads": 1} if columns > MOST_COLUMNS else {}),
    }
    with duckdb.connect(":memory:", config=config) as connection:
        try:
            files = [str(path.absolute()) for path in paths]
            named = ", ".join(text(glob.escape(file)) for file in files)  # a folder may be called a[1]
            connection.execute(f"CREATE VIEW v AS SELECT * FROM read_parquet([{named}])")
            connection.execute(f"SET allowed_paths = [{', '.join(map(text, files))}]")
            for setting in ("enable_external_access = false", "lock_configuration = true"):  # all else is shut
                connection.execute(f"SET {setting}")
            yield Stored(folder, store.description, store.state, columns_of(store.description), connection)
        except duckdb.InterruptException as error:
            raise KeyboardInterrupt from error
        except duckdb.Error as error:
            # the parts are as they were written: what is asked gives no answer, or there is no room
            template = (
                "The query on the stored variants failed ({first}). Ask for something else, or for less at a time."
            )
            raise refusal(template, folder, first=str(error).splitlines()[0]) from error


def columns_of(description: Description) -> dict[str, StoredColumn]:
    """Return the columns of the part files by name; curves, which are lists, are not quantities to compare."""
    known = titles(description.all_columns, _kinds(description))
    return {
        column.name: StoredColumn(**vars(column) | {"display": _display(column), "title": known[column.name]})
        for column in description.all_columns
        if column.kind != "curve"
    }  # fmt: skip


def _kinds(description: Description) -> Mapping[str, str]:
    """Return the kinds of the mechanisms by name, so that their columns have the words of their plugins; none in English."""
    content = description.base.content
    if spoken_language() == SOURCE_LANGUAGE:
        return {}
    know_plugins(description.plugins)  # also where the base is not kept any more
    given = yaml.parse(content.decode("utf-8-sig"), description.base.file).data if content else {}
    return {name: str(block.get("kind")) for name, block in (given.get(MECHANISMS) or {}).items()}


def _display(column: ResultColumn) -> str:
    """Return the unit that people read: the column's own, else the usual one for its SI unit."""
    try:
        is_own = bool(column.display) and unit(column.display).kind == unit(column.unit).kind
    except UnitError:
        is_own = False
    return column.display if is_own else DISPLAY.get(column.unit, column.unit)


def other_code(sources: Mapping[str, str], kinds: Iterable[str], discovery: Discovery) -> list[str]:
    """Return what has other code now than the ``sources`` of a study have noted, for variants of these kinds."""
    discovery.extend()
    now = {"program": program_hash()}
    for kind in dict.fromkeys(kinds):
        try:
            now[f"plugin {kind}"] = plugin_hash(discovery.mechanism(kind))
        except (PluginError, UnknownKind, DuplicateKind):  # reported where the configuration is read
            continue
    now |= {f"extension {name}": digest for name, digest in discovery.extended.items()}
    gone = [name for name in sources if name.startswith("extension ") and name not in now]
    changed = [name for name in (*now, *gone) if sources.get(name, "") != now.get(name, "")]
    template = (
        "The source of the {name} is not what the study was calculated by (SHA-256 {old} then, {new} now): the numbers of this "
        "variant may differ from those that are stored."
    )
    return [
        Phrase(template, name=source_name(name), old=short_hash(sources.get(name)), new=short_hash(now.get(name)))
        for name in changed
        if name.isprintable()  # a name of study.json may be by anybody
    ]


# What people call the columns of a study: the description of the quantity and its mechanism, each title once.


PART = re.compile(r"(.+)\.(\d+)\.\w+")  # of a list of the inputs
ENDS = {  # as `columns_of` of `variant_rows` describes one of several results of a step
    re.compile(r"(?P<what>.+): no\. (?P<number>\d+)"): phrase("{quantity}: no. {number}"),
    re.compile("(?P<what>.+): how many in a turn"): phrase("{quantity}: how many in a turn"),
}
CHECK_ENDS = {
    re.compile("(?P<what>.+): utilisation"): phrase("{quantity}: utilisation"),
    re.compile("(?P<what>.+): verdict"): "",
}


def titles(columns: Sequence[ResultColumn], kinds: Mapping[str, str] = MappingProxyType({})) -> dict[str, str]:
    """Return the titles by name: ``Radius of the bore (cylinder)``; longer where two columns would share one, empty without a description.

    They are in the language that is spoken, by the catalogue of the mechanism's kind; ``kinds`` says which each one is of.
    """

    def titled(some: Sequence[ResultColumn]) -> dict[str, str]:
        found = {column.name: "" for column in some}
        untitled = [column for column in some if column.description and home(column.name)]
        for form in (_short_title, lambda _, described: described, _named_title):
            made = {each.name: f"{form(each, _described(each, kinds))} ({home(each.name)})" for each in untitled}
            often = Counter([*made.values(), *found.values()])
            found |= {name: title for name, title in made.items() if often[title] == 1 or form is _named_title}
            untitled = [column for column in untitled if not found[column.name]]
        return found

    verdicts = [column for column in columns if _is_verdict(column)]
    return titled([column for column in columns if not _is_verdict(column)]) | titled(verdicts)


def home(name: str) -> str:
    """Return the mechanism (or ``press``) of a column; nothing for those of the study itself."""
    first, _, rest = name.removeprefix(f"{MECHANISMS}.").partition(".")
    return first if rest else ""


def _short_title(column: ResultColumn, described: str) -> str:
    """Leave out what a closing bracket explains; of a part its number stands, whatever else is varied."""
    if column.name.startswith(f"{MECHANISMS}.") and PART.fullmatch(column.name.split(".", 2)[2]):
        return _named_title(column, described)
    return re.sub(r" \([^()]*\)$", "", described)


def _named_title(column: ResultColumn, described: str) -> str:
    """Add the key, or which part of a list it is of."""
    name = column.name.removeprefix(f"{MECHANISMS}.").partition(".")[2]
    if listed := PART.fullmatch(name):
        return say("{quantity}: no. {nth} of {list}", quantity=described, nth=int(listed[2]) + 1, list=listed[1])
    return f"{described}, {name}"


def _described(column: ResultColumn, kinds: Mapping[str, str]) -> str:
    """Return the description in the language that is spoken; of a check's verdict the check alone."""
    kind, is_of_check = kinds.get(home(column.name), ""), _is_verdict(column) or column.name.endswith(UTILISATION)
    for pattern, words in (CHECK_ENDS if is_of_check else ENDS).items():
        if found := pattern.fullmatch(column.description):
            if not words or _is_verdict(column):
                return said(found["what"], kind)
            number_ = found.groupdict().get("number", "")
            return said(Phrase(words, quantity=phrase(found["what"]), number=number_), kind)
    return said(column.description, kind)


def _is_verdict(column: ResultColumn) -> bool:
    return ".checks." in column.name and column.name.endswith(STATUS)


# Stored variants as a table for people: in the units that they read, as many columns as the line holds.


UNBROKEN = 10_000  # letters of a line that no terminal breaks
HEAD = 14  # letters of a line of a heading
BETWEEN, REASON = 3, 40  # letters between columns; on a line of a reason, at least
FEWEST = 3  # columns that stand whatever the line holds


def table_text(
    columns: Sequence[StoredColumn], rows: Sequence[Sequence[Any]], width: int | None
) -> tuple[str, list[StoredColumn]]:
    """Return the table, and the columns that the line has no room for."""
    heads = [_head(column) for column in columns]
    texts = [[shown(value, column) for value, column in zip(row, columns, strict=True)] for row in rows]
    wide = [max(map(len, (*head.split("\n"), *column))) for head, *column in zip(heads, *texts, strict=True)]
    kept = _fitting(columns, wide, width or UNBROKEN)
    shown_heads = [(heads[index], not columns[index].is_number) for index in kept]
    table = _printed(shown_heads, ([row[index] for index in kept] for row in texts), width)
    return table, [column for index, column in enumerate(columns) if index not in kept]


def compared_text(
    columns: Sequence[StoredColumn], rows: Sequence[Sequence[Any]], width: int | None, *, keep_equal: bool
) -> tuple[str, int]:
    """Return variants side by side, a line for each quantity with its unit, and how many quantities are left out as equal for all."""
    lines = [(column, [row[index] for row in rows]) for index, column in enumerate(columns) if column.name != "variant"]
    kept = [(column, values) for column, values in lines if keep_equal or any(value != values[0] for value in values)]
    texts = [
        [column.name, pretty(column.display), *(shown(value, column) for value in values)] for column, values in kept
    ]
    return side_by_side([str(row[0]) for row in rows], texts, width), len(lines) - len(kept)


def side_by_side(names: Sequence[str], rows: Iterable[Sequence[str]], width: int | None) -> str:
    """Return a table of texts for people: in each row a quantity, its unit, and what each of those named has."""
    heads = [(say("quantity"), True), (say("unit"), True), *((name, False) for name in names)]
    return _printed(heads, rows, width)


def _fitting(columns: Sequence[StoredColumn], wide: Sequence[int], room: int) -> list[int]:
    """Return the columns that fit, by index: the first ones, the reason of an error (on several lines, if need be), then what fits."""
    reason = [index for index, column in enumerate(columns) if column.name == "error"]
    kept: list[int] = []
    used = 0
    for index in dict.fromkeys([*range(min(FEWEST, len(wide))), *reason, *range(len(wide))]):
        own = BETWEEN + (min(wide[index], REASON) if index in reason else wide[index])
        if used + own <= room or len(kept) < FEWEST:
            kept.append(index)
            used += own
    return sorted(kept)


def _printed(heads: Iterable[tuple[str, bool]], rows: Iterable[Sequence[str]], width: int | None) -> str:
    """Return a table of texts; with each head whether its column stands to the left."""
    from rich import box
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    table, target = Table(box=box.SIMPLE_HEAD, pad_edge=False), io.StringIO()
    for head, is_left in heads:
        table.add_column(Text(head), justify="left" if is_left else "right", overflow="fold")
    for row in rows:
        table.add_row(*map(Text, row))
    Console(file=target, width=width or UNBROKEN, color_system=None, soft_wrap=False, legacy_windows=False).print(table)
    return "\n".join(line.rstrip() for line in target.getvalue().splitlines())


def _head(column: StoredColumn) -> str:
    lines = [""]
    for part in re.findall(r"[^._]*[._]|[^._]+", column.name.removeprefix(f"{MECHANISMS}.")):
        if lines[-1] and (lines[-1].endswith(".") or len(lines[-1] + part) > HEAD):
            lines.append("")
        lines[-1] += part
    return "\n".join(filter(None, [*lines, pretty(column.display)]))


def shown(value: Any, column: StoredColumn) -> str:
    """Return a stored value as people read it, in the column's display unit, without the unit."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return say("yes") if value else say("no")
    if isinstance(value, float):
        return number(number_text(unit(column.display).from_si(value), 5), decimal_sign()) if value else "0"
    return number(str(value)) if isinstance(value, int) and column.name != "variant" else str(value)
