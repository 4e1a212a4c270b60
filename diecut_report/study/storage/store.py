"""The folder of a study's results: study.json, copies of the study's files, and Parquet parts of its variants (pyarrow).

Each file is whole or absent, whatever ends the run; a run holds the folder alone. A part file is as the run wrote it, or it is refused.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import socket
import time
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import replace
from hashlib import sha256
from pathlib import Path
from typing import Annotated, Any, NamedTuple

import numpy as np
import pyarrow as pa
import pyarrow.dataset
import pyarrow.parquet as pq
from filelock import FileLock, Timeout
from numpy.typing import NDArray
from pydantic import BaseModel, Field, TypeAdapter

from diecut_report.errors import Problem, UserError, refusal
from diecut_report.files import (
    cache_folder,
    content,
    in_words,
    refuse_special,
    refuse_unreadable_name,
    remove_stale,
    write,
)
from diecut_report.study.storage.description import (
    SCHEMA_VERSION,
    STATE,
    STATUSES,
    TABLES,
    VARIANT,
    VERDICT,
    Description,
    Kind,
    ResultColumn,
    as_data,
    changes,
    is_sealed,
    libraries,
    part_name,
    read_description,
    read_state,
    write_copies,
    write_state,
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


LOCK, HOLDER = ".lock", ".lock.json"
MOST_HOLDER = 10_000  # bytes
PARTS = "variants"
FOLDERS = (PARTS, TABLES, "reports")
PART_NAME = re.compile(r"part-(\d+)\.parquet")
BATCH = 4096  # rows read at a time
MAX_REPORTED = 5  # parts that are reported to be wrong, each by itself


class Store:
    """Keep the results of one study in one folder. Made by `create` or `open`; written to only within `lock`."""

    def __init__(self, directory: Path, description: Description) -> None:
        self.directory, self.description = directory, description
        self.schema = schema_of(description)
        self._folder = directory / PARTS
        self._checks = PartChecks(directory, description)
        self._lock = FileLock(directory / LOCK)

    @classmethod
    def create(cls, directory: Path, description: Description) -> Store:
        """Begin the results of a study in a folder that is new or empty."""
        refuse_unreadable_name(directory)
        with in_words(directory):
            directory.mkdir(parents=True, exist_ok=True)
            if not (directory / STATE).exists():
                refuse_used(directory)
        store = cls(directory, description)
        with store.lock():
            refuse_used(directory)
            write_state(directory, as_data(description) | {"part_files": {}, "state": "running"})
            write_copies(directory, description)
        return store

    @classmethod
    def open(cls, directory: Path, description: Description | None = None) -> Store:
        """Return the results in a folder: to read them or, with the study's description, to continue them.

        Raises UserError where there are none, or where they belong to another study, with what has changed.
        The size of the parts stays that of the folder (`description.chunk`).
        """
        before = read_description(directory, sealed=description is None)
        if description is not None:
            if found := list(changes(before, description)):
                template = (
                    "These results belong to another study; put it back as it was, or choose a new folder with -o."
                )
                raise UserError([Problem(phrase(template), str(directory)), *found])
            study = replace(description.study, file=before.study.file)  # its copy in the folder has another name
            # with their contents
            before = replace(before, study=study, base=description.base, tables=description.tables)
        return cls(directory, before)

    @contextmanager
    def lock(self) -> Iterator[None]:
        """Hold the folder for this run alone, as long as it lives; what a killed run left half-written is removed."""
        with in_words(self.directory):
            try:
                self._lock.acquire(timeout=0)
            except Timeout:
                raise refusal("Another run uses this folder{holder}.", self.directory, holder=self._holder()) from None
        holder = self.directory / HOLDER
        try:
            write(holder, json.dumps({"process": os.getpid(), "host": socket.gethostname()}).encode())
            own_folder = phrase("Results are written into folders of their own; put a folder in its place.")
            refuse_special((self.directory / name for name in FOLDERS), own_folder, folders=True)
            remove_stale(self.directory)
            try:
                yield
            finally:  # a second Ctrl-C may have come while the first was cleaning up
                remove_stale(self.directory)
        finally:
            holder.unlink(missing_ok=True)
            self._lock.release()

    def _holder(self) -> str:
        """Return who holds it, as far as that is known: the run may just be writing or removing its name."""
        template = ": process {process} on {host}. Wait for its end, or choose another folder with -o"
        try:
            found = json.loads(content(self.directory / HOLDER, MOST_HOLDER, phrase("the note of a run")))
            return Phrase(template, process=found["process"], host=found["host"])
        except (UserError, ValueError, KeyError, TypeError):
            return phrase(", and has not given its name. Wait for its end, or choose another folder with -o")

    # --- study.json --------------------------------------------------------------------------------------------------

    @property
    def state(self) -> dict[str, Any]:
        """Return study.json as it is now."""
        return read_state(self.directory)

    def note(self, facts: Mapping[str, Any]) -> None:
        """Add facts of the run (seconds, …) to study.json."""
        write_state(self.directory, self.state | dict(facts))

    def start(self, facts: Mapping[str, Any]) -> None:
        """Begin or continue a run: keep what the study is made of, and note facts of it in study.json.

        Where a run continues with other versions of the libraries, both are noted.
        """
        write_copies(self.directory, self.description)
        before = read_state(self.directory, sealed=False)
        if not is_sealed(before):  # what follows from the study is written anew, parts have their own hashes
            before = {key: before[key] for key in ("part_files", "libraries") if key in before}
        names = {part_name(index) for index in range(self.description.parts)}
        files = {name: entry for name, entry in before["part_files"].items() if name in names}
        noted = before.get("libraries", {})
        used = {name: list(dict.fromkeys([*noted.get(name, ()), own])) for name, own in libraries().items()}
        known = before | as_data(self.description) | {"part_files": files, "libraries": used}
        write_state(self.directory, known | dict(facts) | {"state": "running"})

    def finish(self, without_value: int = 0) -> None:
        """Mark the results as complete, with their counts; all parts must be there.

        ``without_value``: how many of the rows that are not stored were dropped as a constraint has no value for them.
        """
        missing = set(range(self.description.parts)) - self.parts().keys()
        if missing:
            raise RuntimeError(f"{len(missing)} parts are missing, such as {min(missing)}")
        counts = self.counts()
        counts["dropped"] = counts["sample"] - counts["variants"]
        counts |= {"without_value": without_value} if without_value else {}
        self.note({"parts": self.description.parts, "counts": counts, "state": "complete"})

    # --- part files --------------------------------------------------------------------------------------------------

    def part(self, index: int) -> Path:
        """Return the file of a part, whether it is there or not."""
        return self._folder / part_name(index)

    def write_part(self, index: int, columns: Mapping[str, Values]) -> None:
        """Write the variants of one part, whole or not at all.

        Columns: SI floats (NaN becomes null), integers, booleans, texts, curves or None; ``variant`` (those that constraints have left,
        ascending) and ``status`` are needed, others may be missing.
        """
        if not self._lock.is_locked:
            raise RuntimeError("the folder is not locked for writing")
        if missing := {VARIANT.name, STATUS} - columns.keys():
            raise ValueError(f"a part needs its {' and '.join(sorted(missing))}")
        table = table_of(self.schema, columns, len(columns[VARIANT.name]))
        with in_words(self._folder):
            self._folder.mkdir(exist_ok=True)
        content = part_content(table)
        known = {"sha256": sha256(content).hexdigest(), "variants": len(table)}
        # first its hash: a run that is killed in between leaves no part that nobody knows
        self.note({"part_files": self.state["part_files"] | {self.part(index).name: known}})
        write(self.part(index), content)

    def parts(self) -> dict[int, Path]:
        """Return the part files that are there, by index; UserError for a file that only looks like one."""
        found: dict[int, Path] = {}
        for path in sorted(self._folder.glob("part-*.parquet")):
            match = PART_NAME.fullmatch(path.name)
            if not match or path != self.part(int(match[1])):
                raise refusal("This is not a part of the results. Move it to another folder.", path)
            found[int(match[1])] = path
        refuse_special(found.values(), phrase("It is not a part of the results. Move it to another folder."))
        return found

    def _checked(self) -> dict[int, CheckedPart]:
        found = self.parts()  # before the state: a run that goes on meanwhile notes each part before it writes it
        return self._checks.checked(found, self.state["part_files"])

    def done_parts(self) -> set[int]:
        """Return the parts that are as they were written and belong to this study; the others are to be calculated."""
        return {index for index, part in self._checked().items() if not part.fault}

    def whole_parts(self) -> dict[Path, Mapping[str, int]]:
        """Return the part files in their order, each with its variants by status.

        UserError where one of them is not as it was written or, in a study that is called complete, where one is missing.
        """
        known = self.state
        checked = self._checked()
        wrong = {index: part.fault for index, part in checked.items() if part.fault}
        if known["state"] == "complete":
            wrong |= dict.fromkeys(set(range(self.description.parts)) - checked.keys(), MISSING)
        if wrong:
            problems = [Problem(wrong[index], str(self.part(index))) for index in sorted(wrong)[:MAX_REPORTED]]
            if more := len(wrong) - len(problems):
                message = Phrase("{count} more parts are wrong or missing.", count=more)
                problems.append(Problem(message, str(self._folder)))
            raise UserError(problems)
        if known["state"] == "complete":
            self._check_counts(known.get("counts") or {}, checked.values())
        return {self.part(index): part.counts for index, part in checked.items()}

    def _check_counts(self, noted: Mapping[str, int], checked: Iterable[CheckedPart]) -> None:
        stored = sum((Counter(part.counts) for part in checked), Counter[str]())
        for status, count in stored.items():
            if noted.get(status, 0) != count:
                template = "{given} is given; the parts hold {count}. Let --resume count them again."
                message = Phrase(template, given=noted.get(status, 0), count=count)
                raise UserError(Problem(message, str(self.directory / STATE), path=f"counts.{status}"))

    # --- variants ----------------------------------------------------------------------------------------------------

    def read(self, columns: Sequence[str] | None = None) -> pyarrow.dataset.Dataset:
        """Return the variants stored so far as a dataset of these columns (default: all), in their order."""
        names = self.schema.names if columns is None else columns
        wanted = pa.schema([self.schema.field(name) for name in names], self.schema.metadata)
        return pyarrow.dataset.dataset([str(path) for path in self.whole_parts()], schema=wanted, format="parquet")

    def batches(self, columns: Sequence[str]) -> Iterator[pa.RecordBatch]:
        """Yield these columns of the variants stored so far, some thousands at a time, in their order; UserError for a part that is damaged."""
        for path in self.whole_parts():
            with readable(path), pq.ParquetFile(path) as file:
                found = file.iter_batches(BATCH, columns=columns)
                while (batch := next(found, None)) is not None:
                    yield batch.select(columns)  # "status" reads "status.mass" too, of a mechanism of that name

    def counts(self) -> dict[str, int]:
        """Return how many rows the sample has, how many variants are stored of them, and of each status."""
        found = sum(map(Counter, self.whole_parts().values()), Counter[str]())
        return {"sample": self.description.rows, "variants": found.total(), **found}


def refuse_used(folder: Path) -> None:
    """Refuse a folder that holds anything."""
    others = sorted(path.name for path in folder.iterdir() if path.name not in (LOCK, HOLDER))
    if STATE in others:
        template = "Results of a study are here already. Continue them with --resume, or choose another folder with -o."
        raise refusal(template, folder)
    if others:
        template = "This folder is not empty ({others} is in it). Choose a new one with -o, so that nothing is lost."
        raise refusal(template, folder, others=others[0])
