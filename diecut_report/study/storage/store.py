"""The folder of a study's results: study.json with its state, copies of its files, and Parquet parts of its variants.

Each file is whole or absent, whatever ends the run; a run holds the folder alone.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.compute
import pyarrow.dataset
import pyarrow.parquet as pq
from filelock import FileLock

from diecut_report.errors import Problem, UserError
from diecut_report.files import in_words, refuse_special, refuse_unreadable_name, remove_stale, write
from diecut_report.study.storage import state
from diecut_report.study.storage.description import VARIANT, Description, as_data
from diecut_report.study.storage.parts import (
    MISSING,
    Judged,
    PartChecks,
    Values,
    part_content,
    readable,
    schema_of,
    table_of,
)
from diecut_report.study.storage.state import part_name
from diecut_report.text.phrases import Phrase, phrase

PARTS = "variants"
FOLDERS = (PARTS, state.TABLES, "reports")
OWN_FOLDER = phrase("Results are written into folders of their own; put a folder in its place.")
NO_PART = phrase("It is not a part of the results. Move it to another folder.")
NAME = re.compile(r"part-(\d+)\.parquet")
BATCH = 4096  # rows read at a time
TOLD = 5  # parts that are told to be wrong, each by itself


class Store:
    """Keep the results of one study in one folder. Made by `create` or `open`; written to only within `lock`."""

    def __init__(self, directory: Path, description: Description) -> None:
        self.directory, self.description = directory, description
        self.schema = schema_of(description)
        self._checks = PartChecks(directory, description)
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
        """Return the results in a folder: to read them or, with the study's description, to continue them.

        Raises UserError where there are none, or where they belong to another study, with what has changed.
        The size of the parts stays that of the folder (`description.chunk`).
        """
        before = state.read_description(directory, sealed=description is None)
        if description is not None:
            state.same_study(directory, before, description)
            now = description
            study = replace(now.study, file=before.study.file)  # its copy in the folder has another name
            before = replace(before, study=study, base=now.base, tables=now.tables)  # with their contents
        return cls(directory, before)

    @contextmanager
    def lock(self) -> Iterator[None]:
        """Keep other runs out of the folder; what a killed run left half-written is removed."""
        with state.held(self._lock, self.directory):
            refuse_special((self.directory / name for name in FOLDERS), OWN_FOLDER, folders=True)
            remove_stale(self.directory)
            try:
                yield
            finally:  # a second Ctrl-C may have come while the first was cleaning up
                remove_stale(self.directory)

    def start(self, facts: Mapping[str, Any]) -> None:
        """Begin or continue a run: keep what the study is made of, and note facts of it in study.json."""
        state.write_copies(self.directory, self.description)
        before = state.read_state(self.directory, sealed=False)
        if not state.is_sealed(
            before
        ):  # what follows from the study is written anew, the parts have hashes of their own
            before = {key: before[key] for key in ("part_files", "libraries") if key in before}
        names = {part_name(index) for index in range(self.description.parts)}
        files = {"part_files": {name: told for name, told in before["part_files"].items() if name in names}}
        known = state.with_libraries(before | as_data(self.description) | files)
        state.write_state(self.directory, known | dict(facts) | {"state": "running"})

    @property
    def _folder(self) -> Path:
        return self.directory / PARTS

    def part(self, index: int) -> Path:
        """The file of a part, whether it is there or not."""
        return self._folder / part_name(index)

    def rows(self, index: int) -> range:
        """The numbers of the sample's rows that make a part."""
        return self._checks.rows(index)

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
        content = part_content(table)
        known = {"sha256": sha256(content).hexdigest(), "variants": len(table)}
        # first its hash: a run that is killed in between leaves no part that nobody knows
        self.note({"part_files": self.state["part_files"] | {self.part(index).name: known}})
        write(self.part(index), content)

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
        """Return the part files that are there, by index; UserError for a file that only looks like one."""
        found = sorted(self._folder.glob("part-*.parquet"))
        for path in found:
            match = NAME.fullmatch(path.name)
            if not match or path != self.part(int(match[1])):
                raise UserError(
                    Problem(phrase("This is not a part of the results. Move it to another folder."), str(path))
                )
        refuse_special(found, NO_PART)
        return {int(path.stem.partition("-")[2]): path for path in found}

    def _judged(self) -> dict[int, Judged]:
        """Return what the part files are. A run may go on meanwhile: it notes each part before it writes it."""
        found = self.parts()
        return self._checks.judged(found, self.state["part_files"])

    def done_parts(self) -> set[int]:
        """Return the parts that are as they were written and belong to this study; the others are to be calculated."""
        return {index for index, judged in self._judged().items() if not judged.fault}

    def whole_parts(self) -> list[Path]:
        """Return the part files, in their order.

        UserError where one of them is not as it was written or, in a study that is called complete, where one is missing.
        """
        told = self.state
        judged = self._judged()
        wrong = {index: each.fault for index, each in judged.items() if each.fault}
        if told["state"] == "complete":
            wrong |= dict.fromkeys(set(range(self.description.parts)) - judged.keys(), MISSING)
        if wrong:
            raise UserError(self._told(wrong))
        if told["state"] == "complete":
            self._check_counts(told["counts"], judged)
        return [self.part(index) for index in judged]

    def _told(self, wrong: Mapping[int, str]) -> Iterator[Problem]:
        for index in sorted(wrong)[:TOLD]:
            yield Problem(wrong[index], str(self.part(index)))
        if len(wrong) > TOLD:
            yield Problem(
                Phrase("{count} more parts are wrong or missing.", count=len(wrong) - TOLD), str(self._folder)
            )

    def _check_counts(self, told: Mapping[str, int], judged: Mapping[int, Judged]) -> None:
        stored = sum((Counter(each.counts) for each in judged.values()), Counter[str]())
        for status, count in stored.items():
            if told.get(status, 0) != count:
                words = Phrase(
                    "{given} is given; the parts hold {count}. Let --resume count them again.",
                    given=told.get(status, 0),
                    count=count,
                )
                raise UserError(Problem(words, str(self.directory / state.STATE), path=f"counts.{status}"))

    def read(self, columns: Sequence[str] | None = None) -> pyarrow.dataset.Dataset:
        """Return the variants stored so far as a dataset of these columns (default: all), in their order."""
        names = self.schema.names if columns is None else columns
        wanted = pa.schema([self.schema.field(name) for name in names], self.schema.metadata)
        return pyarrow.dataset.dataset([str(path) for path in self.whole_parts()], schema=wanted, format="parquet")

    def batches(self, columns: Sequence[str] | None = None) -> Iterator[pa.RecordBatch]:
        """Yield the variants stored so far, some thousands at a time, in their order; UserError for a part that is damaged."""
        names = self.schema.names if columns is None else list(columns)
        for path in self.whole_parts():
            with readable(path), pq.ParquetFile(path) as file:
                found = file.iter_batches(BATCH, columns=names)
                while (batch := next(found, None)) is not None:
                    yield batch.select(names)  # "status" reads "status.mass" too, of a mechanism of that name

    def count(self) -> int:
        """How many variants are stored."""
        entries = self.state["part_files"]
        return sum(int(entries[path.name]["variants"]) for path in self.whole_parts())

    def counts(self) -> dict[str, int]:
        """Return how many rows the sample has, how many variants are stored of them, and of each status."""
        found: Counter[str] = Counter(sample=self.description.rows, variants=0)
        for batch in self.batches(["status"]):
            for each in pyarrow.compute.value_counts(batch.column(0)).to_pylist():
                found[each["values"]] += each["counts"]
            found["variants"] += batch.num_rows
        return dict(found)

    @property
    def state(self) -> dict[str, Any]:
        """Return study.json as it is now."""
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
            raise RuntimeError(
                Phrase("{count} parts are missing, such as {missing}", count=len(missing), missing=min(missing))
            )
        counts = self.counts()
        counts["dropped"] = counts["sample"] - counts["variants"]
        counts |= {"without_value": without_value} if without_value else {}
        self.note({**facts, "parts": self.description.parts, "counts": counts, "state": "complete"})
