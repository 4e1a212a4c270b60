"""The folder of a study's results: study.json with its state, copies of its files, and Parquet parts of its variants.

Each file is whole or absent, whatever ends the run; a run holds the folder alone.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.compute
import pyarrow.dataset
import pyarrow.parquet as pq
from filelock import FileLock

from diecut_report.errors import Problem, UserError
from diecut_report.files import in_words, remove_stale
from diecut_report.given_files import refuse_special, refuse_unreadable_name
from diecut_report.study.storage import state
from diecut_report.study.storage.description import VARIANT, Description
from diecut_report.study.storage.part_files import (
    DAMAGED,
    Values,
    has_schema,
    is_whole,
    is_within,
    readable,
    schema_of,
    table_of,
    write_part,
)

PARTS = "variants"
FOLDERS = (PARTS, state.TABLES, "reports")
OWN_FOLDER = "Results are written into folders of their own; put a folder in its place."
NO_PART = "It is no part of the results. Move it to another folder."
NAME = re.compile(r"part-(\d+)\.parquet")
BATCH = 4096  # rows read at a time


class Store:
    """Results of one study in one folder. Made by `create` or `open`; written to only within `lock`."""

    def __init__(self, directory: Path, description: Description) -> None:
        self.directory, self.description = directory, description
        self.schema = schema_of(description)
        self._lock = FileLock(directory / state.LOCK)

    @classmethod
    def create(cls, directory: Path, description: Description) -> Store:
        """Begin the results of a study in a folder that is new or empty."""
        refuse_unreadable_name(directory)
        with in_words(directory):
            directory.mkdir(parents=True, exist_ok=True)
            if not (directory / state.STATE).exists():
                state.refuse_used(directory)
        store = cls(directory, description)
        with store.lock():
            state.begin(directory, description)
        return store

    @classmethod
    def open(cls, directory: Path, description: Description | None = None) -> Store:
        """The results in a folder: to read them or, with the study's description, to continue them.

        Raises UserError where there are none, or where they belong to another study, with what has changed.
        The size of the parts stays that of the folder (`description.chunk`).
        """
        before = state.read_description(directory)
        if description is not None:
            state.same_study(directory, before, description)
            now = description
            before = replace(before, study=now.study, base=now.base, tables=now.tables)  # with their contents
        return cls(directory, before)

    @contextmanager
    def lock(self) -> Iterator[None]:
        """Keep other runs out of the folder; what a killed run left half-written is removed."""
        with state.held(self._lock, self.directory):
            refuse_special((self.directory / name for name in FOLDERS), OWN_FOLDER, folders=True)
            remove_stale(self.directory)
            yield

    def start(self, facts: Mapping[str, Any]) -> None:
        """Begin or continue a run: keep what the study is made of, and note facts of it in study.json."""
        state.write_copies(self.directory, self.description)
        self.note(state.with_libraries(self.state) | dict(facts) | {"state": "running"})

    @property
    def _folder(self) -> Path:
        return self.directory / PARTS

    def part(self, index: int) -> Path:
        """The file of a part, whether it is there or not."""
        return self._folder / f"part-{index:05d}.parquet"

    def rows(self, index: int) -> range:
        """The numbers of the sample's rows that make a part."""
        chunk = self.description.chunk
        return range(index * chunk, min((index + 1) * chunk, self.description.rows))

    def write_part(self, index: int, columns: Mapping[str, Values]) -> None:
        """Write the variants of one part, whole or not at all.

        Columns: SI floats (NaN becomes null), integers, booleans, texts, curves or None; `status` is needed, others may be
        missing. A column ``variant`` numbers those that constraints have left; without it they are the part's first ones.
        """
        if not self._lock.is_locked:
            raise RuntimeError("the folder is not locked for writing")
        table = table_of(self.schema, columns, self._variants(index, columns))
        with in_words(self._folder):
            self._folder.mkdir(exist_ok=True)
        write_part(self.part(index), table)

    def _variants(self, index: int, columns: Mapping[str, Values]) -> Any:
        rows = self.rows(index)
        count = len(next(iter(columns.values()), ()))
        found = np.asarray(columns.get(VARIANT.name, range(rows.start, rows.start + count)), np.int64)
        if len(found) and not (rows.start <= found[0] and found[-1] < rows.stop and (np.diff(found) > 0).all()):
            raise ValueError(
                f"part {index} holds the variants {rows.start} to {rows.stop - 1}, once each, in their order"
            )
        return found

    def parts(self) -> dict[int, Path]:
        """The part files that are there, by index; UserError for a file that only looks like one."""
        found = sorted(self._folder.glob("part-*.parquet"))
        for path in found:
            if not (match := NAME.fullmatch(path.name)) or path != self.part(int(match[1])):
                raise UserError(Problem("This is no part of the results. Move it to another folder.", str(path)))
        refuse_special(found, NO_PART)
        return {int(path.stem.partition("-")[2]): path for path in found}

    def done_parts(self) -> set[int]:
        """The parts that are whole to their last byte and belong to this study; the others are to be calculated."""
        return {
            index
            for index, path in self.parts().items()
            if index < self.description.parts and is_whole(path, self.schema) and is_within(path, self.rows(index))
        }

    def _files(self) -> list[Path]:
        """The part files, in their order; UserError where one of them is damaged or of another study."""
        found = self.parts()
        damaged = [
            path
            for index, path in found.items()
            if index >= self.description.parts or not has_schema(path, self.schema)
        ]
        if damaged:
            raise UserError(Problem(DAMAGED, str(path)) for path in damaged)
        return list(found.values())

    def read(self, columns: Sequence[str] | None = None) -> pyarrow.dataset.Dataset:
        """The variants stored so far as a dataset of these columns (default: all), in their order."""
        names = self.schema.names if columns is None else columns
        wanted = pa.schema([self.schema.field(name) for name in names], self.schema.metadata)
        return pyarrow.dataset.dataset([str(path) for path in self._files()], schema=wanted, format="parquet")

    def batches(self, columns: Sequence[str] | None = None) -> Iterator[pa.RecordBatch]:
        """The variants stored so far, some thousands at a time, in their order; UserError for a part that is damaged."""
        names = self.schema.names if columns is None else list(columns)
        for path in self._files():
            with readable(path), pq.ParquetFile(path) as file:
                found = file.iter_batches(BATCH, columns=names)
                while (batch := next(found, None)) is not None:
                    yield batch.select(names)  # "status" reads "status.mass" too, of a mechanism of that name

    def count(self) -> int:
        """How many variants are stored, by the ends of the part files alone."""
        return sum(int(pq.read_metadata(path).num_rows) for path in self._files())

    def counts(self) -> dict[str, int]:
        """How many rows the sample has, how many variants are stored of them, and of each status."""
        found: Counter[str] = Counter(sample=self.description.rows, variants=0)
        for batch in self.batches(["status"]):
            for each in pyarrow.compute.value_counts(batch.column(0)).to_pylist():
                found[each["values"]] += each["counts"]
            found["variants"] += batch.num_rows
        return dict(found)

    @property
    def state(self) -> dict[str, Any]:
        """study.json as it is now."""
        return state.read_state(self.directory)

    def note(self, facts: Mapping[str, Any]) -> None:
        """Add facts of the run (seconds, …) to study.json."""
        state.write_state(self.directory, self.state | dict(facts))

    def finish(self, facts: Mapping[str, Any], without_value: int = 0) -> None:
        """Mark the results as complete, with their counts and facts of the run; all parts must be there.

        ``without_value``: how many of the rows that are not stored were dropped as a constraint has no value for them.
        """
        missing = set(range(self.description.parts)) - self.parts().keys()
        if missing:
            raise RuntimeError(f"{len(missing)} parts are missing, such as {min(missing)}")
        counts = self.counts()
        counts["dropped"] = counts["sample"] - counts["variants"]
        counts |= {"without_value": without_value} if without_value else {}
        self.note({**facts, "parts": self.description.parts, "counts": counts, "state": "complete"})
