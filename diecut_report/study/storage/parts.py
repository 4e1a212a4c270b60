"""Columns of values to tables with schema, units and provenance (pyarrow)."""

from __future__ import annotations

import hashlib
import json
import os
import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from hashlib import sha256
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from diecut_report.errors import Problem, UserError
from diecut_report.files import cache_folder, write
from diecut_report.study.storage.description import SCHEMA_VERSION, VARIANT, VERDICT, Description, Kind, ResultColumn
from diecut_report.study.storage.state import STATUSES
from diecut_report.text.phrases import Phrase, phrase

Values = NDArray[Any] | Sequence[Any]
TYPES: dict[Kind, Any] = {
    "float": pa.float64(),
    "int": pa.int64(),
    "bool": pa.bool_(),
    "text": pa.dictionary(pa.int32(), pa.string()),
    "curve": pa.list_(pa.field("element", pa.float64())),  # the name that Parquet gives
}
COMPRESSION = "zstd"
DAMAGED = phrase("This part of the results is damaged or not of this study. Calculate it again with --resume.")
FOREIGN = phrase("No run of this study has written this part. Move it to another folder, or let --resume remove it.")
MISSING = phrase("This part of the results is missing. Calculate it again with --resume.")


def schema_of(description: Description) -> pa.Schema:
    """Return the types of the columns, with unit, symbol and description of each, and where the results come from."""
    return pa.schema([_field(column) for column in description.all_columns], provenance(description))


def _field(column: ResultColumn) -> pa.Field:
    about = {"unit": column.unit, "symbol": column.symbol, "description": column.description}
    return pa.field(column.name, TYPES[column.kind], column.name != VARIANT.name, about)


def provenance(description: Description) -> dict[str, str]:
    """Return what the schema of each part says of its origin."""
    return {
        "program": "diecut-report",
        "version": description.program,
        "study": description.study.sha256,
        "base": description.base.sha256,
        "schema_version": str(SCHEMA_VERSION),
    }


def table_of(schema: pa.Schema, columns: Mapping[str, Values], variants: NDArray[np.int64]) -> pa.Table:
    """Return the columns as a table; one that is not given holds nulls, for an output that applies to none of the variants."""
    names = [field.name for field in schema]
    strange = [name for name in columns if name not in names]
    if strange or VERDICT[0].name not in columns:
        raise ValueError(f"a part needs its status and no columns without description: {', '.join(strange)}")
    arrays = [array_of(field, columns.get(field.name), len(variants)) for field in schema if field.name != VARIANT.name]
    return pa.Table.from_arrays([pa.array(variants), *arrays], schema=schema)


def described_table(columns: Mapping[ResultColumn, Values | None], count: int) -> pa.Table:
    """Return columns of so many variants as a table in memory, with unit, symbol and description of each."""
    fields = [_field(column) for column in columns]
    arrays = [array_of(field, values, count) for field, values in zip(fields, columns.values(), strict=True)]
    return pa.Table.from_arrays(arrays, schema=pa.schema(fields))


def plain_table(rows: Sequence[Mapping[str, Any]]) -> pa.Table:
    """Return rows of plain values as a table."""
    return pa.Table.from_pylist([dict(row) for row in rows])


def array_of(field: pa.Field, values: Values | None, count: int) -> pa.Array:
    """Return the values of a column in its type; what is missing, not a number or infinite is null."""
    if values is None:
        return pa.nulls(count, field.type)
    if len(values) != count:
        raise ValueError(f"the column {field.name} has {len(values)} values for {count} variants")
    try:
        return _array(field.type, values)
    except (pa.ArrowException, TypeError, ValueError) as error:
        raise ValueError(f"the column {field.name} cannot hold its values as {field.type}: {error}") from error


def _array(kind: Any, values: Values) -> pa.Array:
    if pa.types.is_dictionary(kind):
        return pa.array(list(values), pa.string()).dictionary_encode()
    if pa.types.is_list(kind):
        return _lists(kind, values)
    if pa.types.is_floating(kind) and not isinstance(values, np.ndarray):
        values = np.array(values, float)  # None is not a number
    if isinstance(values, np.ndarray) and values.dtype.kind == "f":
        missing = ~np.isfinite(values)
        return pa.array(np.where(missing, 0.0, values), mask=missing).cast(kind)  # refuses 0.5 as an integer
    return pa.array(values, kind)


def _lists(kind: Any, values: Values) -> pa.Array:
    """Curves, one after the other in one array; None where there is none."""
    missing = np.array([one is None for one in values], bool)
    given = [np.asarray(one, float) for one in values if one is not None]
    ends = np.cumsum([0 if one is None else len(one) for one in values])
    numbers = _array(kind.value_type, np.concatenate([*given, np.empty(0)]))
    return pa.ListArray.from_arrays(np.append(0, ends).astype(np.int32), numbers, kind, mask=pa.array(missing))


def part_content(table: pa.Table) -> memoryview:
    """Return the table as the content of a Parquet file, with a checksum for each page."""
    texts = [field.name for field in table.schema if pa.types.is_dictionary(field.type)]
    sink = pa.BufferOutputStream()
    # numbers that seldom repeat only grow by a dictionary
    pq.write_table(table, sink, compression=COMPRESSION, use_dictionary=texts, row_group_size=max(len(table), 1),
                   write_page_checksum=True)  # fmt: skip
    return memoryview(sink.getvalue())


@contextmanager
def readable(path: Path) -> Iterator[None]:
    """Turn what goes wrong in reading a part into a UserError that says what to do."""
    try:
        yield
    except pa.ArrowException as error:
        raise UserError(Problem(DAMAGED, str(path))) from error
    except OSError as error:
        words = (
            Phrase("This part cannot be read: {strerror}.", strerror=error.strerror) if error.errno else DAMAGED
        )  # Parquet's own has no number
        raise UserError(Problem(words, str(path))) from error


def columns_of_part(path: Path, schema: pa.Schema, names: Sequence[str]) -> pa.Table | None:
    """Return some columns of a part, nothing where it is none or of another origin or other columns than the schema."""
    try:
        with pq.ParquetFile(path) as part:
            return part.read(columns=list(names)) if part.schema_arrow.equals(schema, check_metadata=True) else None
    except pa.ArrowException:
        return None
    except OSError as error:
        if error.errno is None:  # Parquet says so too of a damaged file
            return None
        raise


# Which part files have been verified, remembered by their size and times, so that a second command need not read them all.
#
# The memory is the user's own, outside the folder of results: asking writes nothing there, and a copy of a folder is verified anew.


LARGE = 4_000_000  # bytes of parts up to which they are verified at each command: it takes some hundredths of a second
SETTLED = 2_000_000_000  # ns after which a change of a file shows in its times
FOLDERS = 100  # studies that are remembered

Mark = list[int]
MARK = ("st_size", "st_mtime_ns", "st_ctime_ns", "st_ino")


def mark(path: Path) -> Mark:
    """Return what changes with a file's content: its size, its times, and its place on the disk."""
    found = path.stat()
    return [getattr(found, name) for name in MARK]


class Verified:
    """What is known of the parts of one folder: for each the hash of its bytes, its mark, and its counts by status."""

    def __init__(self, directory: Path) -> None:
        self._file = _memory(directory)
        self._known: dict[str, dict[str, Any]] = _read(self._file)
        self._is_new = False

    def counts(self, path: Path, digest: str, seen: Mark) -> dict[str, int] | None:
        """Return the counts of a part that was verified to have this hash and has not changed since, None for another."""
        known = self._known.get(path.name)
        return dict(known["counts"]) if known and (known["sha256"], known["mark"]) == (digest, seen) else None

    def keep(self, path: Path, digest: str, seen: Mark, counts: Mapping[str, int]) -> None:
        """Remember a part as it was when ``seen``; one that has just been written may change again within its times."""
        if time.time_ns() - max(seen[1], seen[2]) > SETTLED:
            self._known[path.name] = {"sha256": digest, "mark": seen, "counts": dict(counts)}
            self._is_new = True

    def write(self) -> None:
        """Keep what is known of a large study for the next command; where that is not possible it is verified again."""
        if self._file is None or not self._is_new or sum(known["mark"][0] for known in self._known.values()) < LARGE:
            return
        with suppress(OSError, UserError):  # costs the next command some time, and nothing else
            self._file.parent.mkdir(parents=True, exist_ok=True)
            write(self._file, json.dumps(self._known).encode())
            for old in sorted(self._file.parent.glob("*.json"), key=lambda path: -path.stat().st_mtime)[FOLDERS:]:
                old.unlink(missing_ok=True)


def _memory(directory: Path) -> Path | None:
    """Return the file of the user's cache for this folder, nothing where the user has no home."""
    folder = cache_folder("verified")
    return folder / f"{sha256(os.fsencode(directory.resolve())).hexdigest()[:32]}.json" if folder else None


def _read(file: Path | None) -> dict[str, dict[str, Any]]:
    """Return what is remembered; a memory that cannot be read, or is none, remembers nothing."""
    try:
        found = json.loads(file.read_text("utf-8")) if file else {}
        return {name: known for name, known in found.items() if _is_known(known)}
    except (OSError, ValueError, AttributeError, RecursionError):
        return {}


def _is_known(known: Any) -> bool:
    if not isinstance(known, dict) or known.keys() != {"sha256", "mark", "counts"}:
        return False
    if not isinstance(known["mark"], list) or not isinstance(known["counts"], dict):
        return False
    return len(known["mark"]) == len(MARK) and all(
        isinstance(n, int) for n in (*known["mark"], *known["counts"].values())
    )


# Whether the part files are those that the run wrote: by the hash of their bytes, and by the variants that they hold.


STATUS = VERDICT[0].name
Entry = Mapping[str, Any]  # of study.json: the hash of a part and how many variants it holds


class Judged(NamedTuple):
    """What is wrong with a part, in words (nothing where it is as it was written), and its variants by status."""

    fault: str
    counts: Mapping[str, int]


class PartChecks:
    """The checks of one folder's parts; what is as it was written is remembered (`Verified`)."""

    def __init__(self, directory: Path, description: Description) -> None:
        self._description, self._schema = description, schema_of(description)
        self._verified = Verified(directory)

    def judged(self, found: Mapping[int, Path], entries: Mapping[str, Entry]) -> dict[int, Judged]:
        """Return what each of these part files is, by what study.json says of them (``part_files``)."""
        parts = {index: self._judged(index, path, entries.get(path.name)) for index, path in found.items()}
        self._verified.write()
        return parts

    def rows(self, index: int) -> range:
        """Return the numbers of the sample's rows that make a part."""
        chunk = self._description.chunk
        return range(index * chunk, min((index + 1) * chunk, self._description.rows))

    def _judged(self, index: int, path: Path, entry: Entry | None) -> Judged:
        if index >= self._description.parts or entry is None:
            return Judged(FOREIGN, {})
        with readable(path):
            seen = mark(path)
            known = self._verified.counts(path, entry["sha256"], seen)
            if known is not None:
                return Judged("", known)
            judged = self._read(index, path, entry)
        if not judged.fault:
            self._verified.keep(path, entry["sha256"], seen, judged.counts)
        return judged

    def _read(self, index: int, path: Path, entry: Entry) -> Judged:
        with path.open("rb") as file:
            is_whole = hashlib.file_digest(file, "sha256").hexdigest() == entry["sha256"]
        read = columns_of_part(path, self._schema, [VARIANT.name, STATUS]) if is_whole else None
        if read is None:
            return Judged(DAMAGED, {})
        numbers, rows = read[VARIANT.name].to_numpy(), self.rows(index)
        counts = Counter(map(str, read[STATUS].cast(pa.string()).to_pylist()))
        if len(numbers) != entry["variants"] or not set(counts) <= set(STATUSES):
            return Judged(DAMAGED, {})
        inside = (numbers >= rows.start).all() and (numbers < rows.stop).all() and (np.diff(numbers) > 0).all()
        other = Phrase(
            "{damaged} It may hold the variants {start} to {stop}, each once, in their order.",
            damaged=DAMAGED,
            start=rows.start,
            stop=rows.stop - 1,
        )
        return Judged("" if inside else other, counts)
