"""The part files of a study: columns of values to Parquet (pyarrow) and back, and whether a file is as the run wrote it."""

from __future__ import annotations

import hashlib
import os
import time
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Annotated, Any, NamedTuple

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray
from pydantic import BaseModel, Field, TypeAdapter

from diecut_report.errors import Problem, UserError
from diecut_report.files import cache_folder, write
from diecut_report.study.storage.description import (
    SCHEMA_VERSION,
    STATUSES,
    VARIANT,
    VERDICT,
    Description,
    Kind,
    ResultColumn,
)
from diecut_report.text.phrases import Phrase, phrase

Values = NDArray[Any] | Sequence[Any]
STATUS = VERDICT[0].name
TYPES: dict[Kind, Any] = {
    "float": pa.float64(),
    "int": pa.int64(),
    "bool": pa.bool_(),
    "text": pa.dictionary(pa.int32(), pa.string()),
    "curve": pa.list_(pa.field("element", pa.float64())),  # the name that Parquet gives
}
DAMAGED = phrase("This part of the results is damaged or not of this study. Calculate it again with --resume.")
FOREIGN = phrase("No run of this study has written this part. Move it to another folder, or let --resume remove it.")
MISSING = phrase("This part of the results is missing. Calculate it again with --resume.")


def schema_of(description: Description) -> pa.Schema:
    """Return the types of the columns, with unit, symbol and description of each, and where the results come from."""
    provenance = {"program": "diecut-report", "version": description.program, "schema_version": str(SCHEMA_VERSION)}
    provenance |= {"study": description.study.sha256, "base": description.base.sha256}
    return pa.schema([_field(column) for column in description.all_columns], provenance)


def _field(column: ResultColumn) -> pa.Field:
    about = {"unit": column.unit, "symbol": column.symbol, "description": column.description}
    return pa.field(column.name, TYPES[column.kind], column.name != VARIANT.name, about)


def table_of(schema: pa.Schema, columns: Mapping[str, Values | None], count: int) -> pa.Table:
    """Return columns of so many variants as a table; one that is not given holds nulls, for an output that applies to none of them."""
    if strange := [name for name in columns if name not in schema.names]:
        raise ValueError(f"columns without description: {', '.join(strange)}")
    return pa.Table.from_arrays([_array_of(field, columns.get(field.name), count) for field in schema], schema=schema)


def described_table(columns: Mapping[ResultColumn, Values | None], count: int) -> pa.Table:
    """Return columns of so many variants as a table in memory, with unit, symbol and description of each."""
    schema = pa.schema([_field(column) for column in columns])
    return table_of(schema, {column.name: values for column, values in columns.items()}, count)


def plain_table(rows: Iterable[dict[str, Any]]) -> pa.Table:
    """Return rows of plain values as a table."""
    return pa.Table.from_pylist(list(rows))


def _array_of(field: pa.Field, values: Values | None, count: int) -> pa.Array:
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
    if pa.types.is_list(kind):  # curves, one after the other in one array; None where there is none
        missing = np.array([one is None for one in values], bool)
        given = [np.asarray(() if one is None else one, float) for one in values]
        ends = np.append(0, np.cumsum([len(one) for one in given])).astype(np.int32)
        numbers = _array(kind.value_type, np.concatenate([*given, np.empty(0)]))
        return pa.ListArray.from_arrays(ends, numbers, kind, mask=pa.array(missing))
    if pa.types.is_floating(kind) and not isinstance(values, np.ndarray):
        values = np.array(values, float)  # None is not a number
    if isinstance(values, np.ndarray) and values.dtype.kind == "f":
        missing = ~np.isfinite(values)
        return pa.array(np.where(missing, 0.0, values), mask=missing).cast(kind)  # refuses 0.5 as an integer
    return pa.array(values, kind)


def part_content(table: pa.Table) -> memoryview:
    """Return the table as the content of a Parquet file, with a checksum for each page."""
    texts = [field.name for field in table.schema if pa.types.is_dictionary(field.type)]
    sink = pa.BufferOutputStream()
    # numbers that seldom repeat only grow by a dictionary
    pq.write_table(table, sink, compression="zstd", use_dictionary=texts, row_group_size=max(len(table), 1),
                   write_page_checksum=True)  # fmt: skip
    return memoryview(sink.getvalue())


@contextmanager
def readable(path: Path) -> Iterator[None]:
    """Turn what goes wrong in reading a part into a UserError that says what to do."""
    try:
        yield
    except (pa.ArrowException, OSError) as error:
        words = DAMAGED
        if isinstance(error, OSError) and error.errno:  # Parquet's own has no number
            words = Phrase("This part cannot be read: {strerror}.", strerror=error.strerror)
        raise UserError(Problem(words, str(path))) from error


MOST_PART, MOST_UNPACKED = 2_000_000_000, 200_000_000  # bytes of a part, and of the columns that are read of it


def _unpacked(part: pq.ParquetFile, names: Sequence[str]) -> int:
    """How many bytes columns of a part have by its own words."""
    groups = (part.metadata.row_group(i) for i in range(part.metadata.num_row_groups))
    chunks = (group.column(k) for group in groups for k in range(group.num_columns))
    return sum(each.total_uncompressed_size for each in chunks if each.path_in_schema.split(".")[0] in names)


def columns_of_part(path: Path, schema: pa.Schema, names: Sequence[str], rows: int | None = None) -> pa.Table | None:
    """Return some columns of a part, nothing where it is none or of another origin, other columns than the schema or other ``rows``."""
    try:
        with pq.ParquetFile(path) as part:
            is_meant = part.schema_arrow.equals(schema, check_metadata=True) and _unpacked(part, names) <= MOST_UNPACKED
            return part.read(columns=list(names)) if is_meant and rows in (None, part.metadata.num_rows) else None
    except pa.ArrowException:
        return None
    except OSError as error:
        if error.errno is None:  # Parquet says so too of a damaged file
            return None
        raise


# Which part files have been verified, remembered by their size and times, so that a second command need not read them all.
#
# The memory is the user's own, outside the folder of results: asking writes nothing there, and a copy of a folder is verified anew.


REMEMBERED_SIZE = 4_000_000  # bytes of parts up to which they are verified at each command, which is soon done
SETTLED = 2_000_000_000  # ns after which a change of a file shows in its times
MAX_FOLDERS = 100  # studies that are remembered
MARK = ("st_size", "st_mtime_ns", "st_ctime_ns", "st_ino")


class VerifiedPart(BaseModel):
    """What is known of a part: the hash of its bytes, what changes with its content, and its variants by status."""

    sha256: str
    mark: Annotated[list[int], Field(min_length=len(MARK), max_length=len(MARK))]
    counts: dict[str, int]


MEMORY = TypeAdapter(dict[str, VerifiedPart])


def memory_file(directory: Path) -> Path | None:
    """Return the file of the user's cache for this folder, nothing where the user has no home."""
    folder = cache_folder("verified")
    name = hashlib.sha256(os.fsencode(directory.resolve())).hexdigest()[:32]
    return folder / f"{name}.json" if folder else None


# Whether the part files are those that the run wrote: by the hash of their bytes, and by the variants that they hold.


class CheckedPart(NamedTuple):
    """Hold what is wrong with a part (nothing where it is as it was written), and its variants by status."""

    fault: str
    counts: Mapping[str, int]


class PartChecks:
    """Check the parts of one folder; what is as it was written is remembered."""

    def __init__(self, directory: Path, description: Description) -> None:
        self._description, self._schema = description, schema_of(description)
        self._file, self._known = memory_file(directory), dict[str, VerifiedPart]()
        with suppress(OSError, ValueError):  # a memory that cannot be read remembers nothing
            self._known = MEMORY.validate_json(self._file.read_bytes(), strict=True) if self._file else {}

    def checked(self, found: Mapping[int, Path], entries: Mapping[str, Mapping[str, Any]]) -> dict[int, CheckedPart]:
        """Return what each of these part files is, by what study.json says of them (``part_files``)."""
        before = dict(self._known)
        parts = {index: self._check(index, path, entries.get(path.name)) for index, path in found.items()}
        if self._known != before and sum(part.mark[0] for part in self._known.values()) >= REMEMBERED_SIZE:
            self._remember()
        return parts

    def _remember(self) -> None:
        if self._file is None:
            return
        with suppress(OSError, UserError):  # costs the next command some time, and nothing else
            self._file.parent.mkdir(parents=True, exist_ok=True)
            write(self._file, MEMORY.dump_json(self._known))
            for old in sorted(self._file.parent.glob("*.json"), key=lambda path: -path.stat().st_mtime)[MAX_FOLDERS:]:
                old.unlink(missing_ok=True)

    def _check(self, index: int, path: Path, entry: Mapping[str, Any] | None) -> CheckedPart:
        if index >= self._description.parts or entry is None:
            return CheckedPart(FOREIGN, {})
        with readable(path):
            state = path.stat()
            mark = [getattr(state, name) for name in MARK]
            known = self._known.get(path.name)
            if known and (known.sha256, known.mark) == (entry["sha256"], mark):
                return CheckedPart("", known.counts)
            part = self._read(index, path, entry)
        # one that has just been written may change again within its times
        if not part.fault and time.time_ns() - max(mark[1], mark[2]) > SETTLED:
            self._known[path.name] = VerifiedPart(sha256=entry["sha256"], mark=mark, counts=dict(part.counts))
        return part

    def _read(self, index: int, path: Path, entry: Mapping[str, Any]) -> CheckedPart:
        if path.stat().st_size > MOST_PART or entry["variants"] > len(self._description.part_rows(index)):
            return CheckedPart(DAMAGED, {})
        with path.open("rb") as file:
            is_whole = hashlib.file_digest(file, "sha256").hexdigest() == entry["sha256"]
        read = columns_of_part(path, self._schema, [VARIANT.name, STATUS], entry["variants"]) if is_whole else None
        if read is None:
            return CheckedPart(DAMAGED, {})
        numbers, rows = read[VARIANT.name].to_numpy(), self._description.part_rows(index)
        counts = Counter(map(str, read[STATUS].cast(pa.string()).to_pylist()))
        if len(numbers) != entry["variants"] or not set(counts) <= set(STATUSES):
            return CheckedPart(DAMAGED, {})
        inside = (numbers >= rows.start).all() and (numbers < rows.stop).all() and (np.diff(numbers) > 0).all()
        template = "{damaged} It may hold the variants {start} to {stop}, each once, in their order."
        other = Phrase(template, damaged=DAMAGED, start=rows.start, stop=rows.stop - 1)
        return CheckedPart("" if inside else other, counts)
