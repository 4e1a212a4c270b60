"""Whether the part files are those that the run wrote: by the hash of their bytes, and by the variants that they hold."""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pyarrow as pa

from diecut_report.languages.phrases import Phrase
from diecut_report.study.storage.description import VARIANT, VERDICT, Description
from diecut_report.study.storage.part_files import DAMAGED, FOREIGN, columns_of_part, readable, schema_of
from diecut_report.study.storage.state_form import STATUSES
from diecut_report.study.storage.verified_parts import Verified, mark

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
