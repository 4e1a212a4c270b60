"""The folder of a study's results: study.json with its state, copies of its files, and Parquet parts of its variants.

Each file is whole or absent, whatever ends the run; a run holds the folder alone.
"""

from __future__ import annotations

import json
import os
import re
import socket
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from hashlib import sha256
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.dataset
import pyarrow.parquet as pq
from filelock import FileLock, Timeout

from diecut_report.errors import Problem, UserError, refusal
from diecut_report.files import content, in_words, refuse_special, refuse_unreadable_name, remove_stale, write
from diecut_report.study.storage import state
from diecut_report.study.storage.description import VARIANT, Description, as_data, changes, libraries
from diecut_report.study.storage.parts import (
    MISSING,
    STATUS,
    CheckedPart,
    PartChecks,
    Values,
    part_content,
    readable,
    schema_of,
    table_of,
)
from diecut_report.text.phrases import Phrase, phrase

LOCK, HOLDER = ".lock", ".lock.json"
MOST_HOLDER = 10_000  # bytes
PARTS = "variants"
FOLDERS = (PARTS, state.TABLES, "reports")
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
            if not (directory / state.STATE).exists():
                refuse_used(directory)
        store = cls(directory, description)
        with store.lock():
            refuse_used(directory)
            state.write_state(directory, as_data(description) | {"part_files": {}, "state": "running"})
            state.write_copies(directory, description)
        return store

    @classmethod
    def open(cls, directory: Path, description: Description | None = None) -> Store:
        """Return the results in a folder: to read them or, with the study's description, to continue them.

        Raises UserError where there are none, or where they belong to another study, with what has changed.
        The size of the parts stays that of the folder (`description.chunk`).
        """
        before = state.read_description(directory, sealed=description is None)
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
        return state.read_state(self.directory)

    def note(self, facts: Mapping[str, Any]) -> None:
        """Add facts of the run (seconds, …) to study.json."""
        state.write_state(self.directory, self.state | dict(facts))

    def start(self, facts: Mapping[str, Any]) -> None:
        """Begin or continue a run: keep what the study is made of, and note facts of it in study.json.

        Where a run continues with other versions of the libraries, both are noted.
        """
        state.write_copies(self.directory, self.description)
        before = state.read_state(self.directory, sealed=False)
        if not state.is_sealed(before):  # what follows from the study is written anew, parts have their own hashes
            before = {key: before[key] for key in ("part_files", "libraries") if key in before}
        names = {state.part_name(index) for index in range(self.description.parts)}
        files = {name: entry for name, entry in before["part_files"].items() if name in names}
        noted = before.get("libraries", {})
        used = {name: list(dict.fromkeys([*noted.get(name, ()), own])) for name, own in libraries().items()}
        known = before | as_data(self.description) | {"part_files": files, "libraries": used}
        state.write_state(self.directory, known | dict(facts) | {"state": "running"})

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
        return self._folder / state.part_name(index)

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
                raise UserError(Problem(message, str(self.directory / state.STATE), path=f"counts.{status}"))

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
    if state.STATE in others:
        template = "Results of a study are here already. Continue them with --resume, or choose another folder with -o."
        raise refusal(template, folder)
    if others:
        template = "This folder is not empty ({others} is in it). Choose a new one with -o, so that nothing is lost."
        raise refusal(template, folder, others=others[0])
