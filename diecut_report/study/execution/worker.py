"""What a worker does: it loads the study once, then calculates chunks of its sample into columns, each within its time."""

from __future__ import annotations

import tempfile
import time
import traceback
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from multiprocessing import parent_process
from pathlib import Path, PurePath

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.config.plugins import Discovery, said
from diecut_report.errors import refusal
from diecut_report.formulas import Array
from diecut_report.formulas.condition_numpy import JudgedRows
from diecut_report.study.definition.constraints import Constraint
from diecut_report.study.definition.samples import Values
from diecut_report.study.definition.study_file import Study, load_study
from diecut_report.study.execution.engines import settle
from diecut_report.study.execution.variant_rows import Given, Rows, calculate_rows
from diecut_report.study.storage.description import JUDGED, source_name
from diecut_report.text.phrases import Phrase, phrase
from diecut_report.time_limit import Overran, limited

FIRST_SECONDS, SECONDS_EACH = 120.0, 5.0  # for a chunk, and for each variant of it, before anything was measured
TIMES_SLOWEST = 30.0  # as long as the slowest chunk that was finished, by variant
JUDGED_ROWS = 65_536  # rows whose constraints are judged at a time


@dataclass
class ChunkClock:
    """Say how long the next chunk may take, from those that were finished; ``fixed`` is what the user sets, 0 for no limit."""

    fixed: float | None = None
    slowest: float = 0.0  # seconds for each variant

    def measure(self, variants: int, seconds: float) -> None:
        self.slowest = max(self.slowest, seconds / max(variants, 1))

    def limit(self, variants: int) -> float | None:
        """Return the seconds that a chunk of so many variants may take; None for any time."""
        if self.fixed is not None:
            return self.fixed or None
        return FIRST_SECONDS + variants * (TIMES_SLOWEST * self.slowest or SECONDS_EACH)


@dataclass(frozen=True)
class Chunk:
    """Hold a piece of the sample: the part file that it makes, its rows, and the seconds that it may take (None for any time)."""

    part: int
    start: int
    stop: int
    limit: float | None = field(default=None, repr=False)


@dataclass
class Done:
    """Hold a chunk's columns by name, ready for its part file.

    ``slow`` names kinds that were calculated one by one, ``broken`` those whose plugin broke, and why. ``seconds`` is how long it
    took; of a chunk that was ended for taking too long it is None.
    """

    columns: dict[str, Array]
    slow: dict[str, str] = field(default_factory=dict)
    broken: dict[str, str] = field(default_factory=dict)
    seconds: float | None = None


def load(study: bytes, files: Mapping[str, bytes], plugins: Sequence[str], sources: Mapping[str, str]) -> Study:
    """Return the study from the contents of its files, which a worker on another machine does not have; cluster-wide plugin folders.

    ``files``: the base and the tables by their names in the study, which may be paths to anywhere. ``sources``: the hashes of
    the code that the run was begun with; UserError where this process, which may have been started later, has another.
    """
    settle()
    with tempfile.TemporaryDirectory() as folder:
        places = {name: Path(folder) / f"{n}-{PurePath(name).name}" for n, name in enumerate(files)}
        for name, content in files.items():
            places[name].write_bytes(content)
        file = Path(folder) / "study.yaml"
        file.write_bytes(study)
        loaded = load_study(file, Discovery([Path(plugin) for plugin in plugins]), places)
    here = loaded.base.source_hashes
    if other := [name for name in sorted(sources.keys() | here.keys()) if sources.get(name) != here.get(name)]:
        template = (
            "The source of the {name} is not the one that this run was begun with: it was changed meanwhile, or another machine "
            "of the cluster has another version. What is calculated is kept; put the source back and continue with --resume, or "
            "calculate all variants anew in another folder."
        )
        raise refusal(template, name=source_name(other[0]))
    return loaded


def calculate(study: Study, chunk: Chunk) -> Done:
    """Calculate the variants of a chunk that the constraints leave: their inputs, outputs, verdicts and reasons."""
    sampled = study.sample.rows(chunk.start, chunk.stop)
    kept = np.flatnonzero(judged(study, sampled, chunk.stop - chunk.start).holds)
    given: dict[str, Array] = {}
    for path, values in sampled.items():
        given[path] = np.asarray(values, dtype=None if isinstance(values, np.ndarray) else object)[kept]
    rows, seconds = _rows(study, {study.inputs[path]: values for path, values in given.items()}, len(kept), chunk.limit)
    columns: dict[str, Array] = {"variant": chunk.start + kept, **given}
    wanted = rows.columns if study.outputs is None else {*study.outputs, *study.curves}
    columns |= {name: values for name, values in rows.columns.items() if ".checks." in name or name in wanted}
    columns |= {JUDGED.name: rows.verdict, "status": rows.status, "governing": rows.governing, "error": rows.errors}
    left = _left(study, rows, given)
    return Done({name: values[left] for name, values in columns.items()}, rows.slow, rows.broken, seconds)


def _rows(study: Study, inputs: Given, count: int, limit: float | None) -> tuple[Rows, float | None]:
    """Return the variants, and how long they took; all in error, and None, where they took too long."""
    began = time.monotonic()
    try:
        with limited(limit, own_process=parent_process() is not None):
            rows = calculate_rows(study.base, inputs, count, study.curves)
        return rows, time.monotonic() - began
    except Overran as overran:
        place = said(overran).removeprefix(Overran.__name__).lstrip(": ")
        template = "it took longer than {seconds} s for {variants} variants, and was ended {place}"
        message = Phrase(template, seconds=f"{limit or 0.0:.3g}", variants=count, place=place)
        message += phrase("; --chunk-limit sets how long it may take")
        kind = _interrupted_kind(overran, study.base)
        rows = Rows(count, study.curves, broken={kind: message})
        rows.status[:], rows.errors[:] = "error", f"plugin {kind!r}: {message}"
        return rows, None


def _interrupted_kind(overran: Overran, config: Config) -> str:
    made = {name: each.mechanism for name, each in config.instances.items() if each and each.mechanism}
    homes = {name: Path(mechanism.at.rpartition(":")[0]) for name, mechanism in made.items()}
    for frame in reversed(traceback.extract_tb(overran.__traceback__)):
        for name, file in homes.items():
            home = file.parent if file.name == "__init__.py" else file
            if Path(frame.filename).is_relative_to(home):
                return config.kinds[name]
    return ", ".join(sorted({config.kinds[name] for name in homes}))


# --- constraints -----------------------------------------------------------------------------------------------------


def _left(study: Study, rows: Rows, given: Mapping[str, Array]) -> Array:
    """Return which calculated variants the constraints on outputs leave; those in error stay with their reason."""
    late = [constraint for constraint in study.constraints if constraint.outputs]
    absent = np.full(rows.count, None, dtype=object)  # no variant of these has this output
    outputs = {name: rows.columns.get(name, absent) for constraint in late for name in constraint.outputs}
    return np.asarray(_all_hold(late, {**given, **outputs}, rows.count).holds | (rows.status == "error"))


def judged(study: Study, given: Mapping[str, Values], count: int) -> JudgedRows:
    """Return which rows keep all constraints between inputs, and which break one; the others have one without a value."""
    return _all_hold([constraint for constraint in study.constraints if not constraint.outputs], given, count)


def _all_hold(constraints: Sequence[Constraint], given: Mapping[str, Values], count: int) -> JudgedRows:
    holds, fails = np.ones(count, dtype=bool), np.zeros(count, dtype=bool)
    for constraint in constraints:
        found = constraint.judged(given)
        holds, fails = holds & found.holds, fails | found.fails
    return JudgedRows(holds, fails)


def judged_rows(study: Study) -> Iterator[JudgedRows]:
    """Yield which rows of the sample keep all constraints and which break one, some at a time."""
    for start in range(0, study.sample.count, JUDGED_ROWS):
        stop = min(start + JUDGED_ROWS, study.sample.count)
        yield judged(study, study.sample.rows(start, stop), stop - start)


def without_value(study: Study) -> int:
    """Return how many rows break no constraint, but have one without a value; they are dropped too."""
    if not study.constraints:
        return 0
    return sum(int(np.sum(~(found.holds | found.fails))) for found in judged_rows(study))
