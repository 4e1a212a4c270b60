"""How long a chunk may take: a plugin that never comes back costs its chunk, not the study."""

from __future__ import annotations

import tempfile
import time
import traceback
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from multiprocessing import parent_process
from pathlib import Path, PurePath
from typing import Any

import numpy as np

from diecut_report.config.loader import Config
from diecut_report.config.plugins import Discovery, said
from diecut_report.errors import Problem, UserError
from diecut_report.formulas import Array
from diecut_report.formulas.condition_numpy import JudgedRows
from diecut_report.study.definition.constraints import Constraint
from diecut_report.study.definition.study_file import Study, load_study
from diecut_report.study.execution.pending import settle
from diecut_report.study.execution.variant_rows import Given, Rows, calculate_rows
from diecut_report.study.storage.description import code_told
from diecut_report.text.phrases import Phrase, phrase
from diecut_report.time_limit import Overran, limited

FIRST, EACH = 120.0, 5.0  # seconds for a chunk, and for each variant of it, before anything was measured
TIMES = 30.0  # as long as the slowest chunk that was finished, by variant


@dataclass
class ChunkClock:
    """Tell how long the next chunk may take, from those that were finished; ``fixed`` is what the user sets, 0 for no limit."""

    fixed: float | None = None
    slowest: float = 0.0  # seconds for each variant

    def measure(self, variants: int, seconds: float) -> None:
        """Note how long a chunk took."""
        self.slowest = max(self.slowest, seconds / max(variants, 1))

    def limit(self, variants: int) -> float | None:
        """Return the seconds that a chunk of so many variants may take; None for any time."""
        if self.fixed is not None:
            return self.fixed or None
        return FIRST + variants * (TIMES * self.slowest or EACH)


def blamed(overran: Overran, config: Config, seconds: float, variants: int) -> tuple[str, str]:
    """Return the kind in whose plugin a chunk was interrupted, and in words how long it took and where it was."""
    place = said(overran).removeprefix(Overran.__name__).lstrip(": ")
    words = Phrase("it took longer than {seconds} s for {variants} variants, and was ended {place}", seconds=f"{seconds:.3g}",
        variants=variants, place=place) + phrase("; --chunk-limit sets how long it may take")  # fmt: skip
    return _kind(overran, config), words


def _kind(overran: Overran, config: Config) -> str:
    """The kind whose code ran last; that of the last mechanism where no plugin's did."""
    homes = {
        name: Path(each.mechanism.at.rpartition(":")[0])
        for name, each in config.instances.items()
        if each and each.mechanism
    }
    for frame in reversed(traceback.extract_tb(overran.__traceback__)):
        for name, file in homes.items():
            home = file.parent if file.name == "__init__.py" else file
            if Path(frame.filename).is_relative_to(home):
                return config.kinds[name]
    return ", ".join(sorted({config.kinds[name] for name in homes}))


# What a worker does: it loads the study once, then calculates chunks of its sample into columns.


Values = Array | list[str]


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
    """The study from the contents of its files, which a worker on another machine does not have; cluster-wide plugin folders.

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
    _refuse_other_code(sources, loaded.base.source_hashes)
    return loaded


def _refuse_other_code(begun: Mapping[str, str], here: Mapping[str, str]) -> None:
    other = [name for name in sorted(begun.keys() | here.keys()) if begun.get(name) != here.get(name)]
    if other:
        words = Phrase(
            "The source of the {name} is not the one that this run was begun with: it was changed "
            "meanwhile, or another machine of the cluster has another version. What is calculated is kept; "
            "put the source back and continue with --resume, or calculate all variants anew in another "
            "folder.",
            name=code_told(other[0]),
        )
        raise UserError(Problem(words))


def calculate(study: Study, chunk: Chunk) -> Done:
    """Calculate the variants of a chunk that the constraints leave: their inputs, outputs, verdicts and reasons."""
    given = study.sample.rows(chunk.start, chunk.stop)
    kept = np.flatnonzero(judged(study, given, chunk.stop - chunk.start).holds)
    given = {path: _taken(values, kept) for path, values in given.items()}
    columns: dict[str, Array] = {"variant": chunk.start + kept}
    columns |= {path: np.asarray(values, dtype=_worker_kind(values)) for path, values in given.items()}
    inputs = {study.inputs[path]: values for path, values in given.items()}
    rows, seconds = _rows(study, inputs, len(kept), chunk.limit)
    left = _left(study, rows, given)
    columns |= {name: values for name, values in rows.columns.items() if _is_kept(study, name)}
    columns |= {"status": rows.status, "governing": rows.governing, "error": rows.errors}
    return Done({name: values[left] for name, values in columns.items()}, rows.slow, rows.broken, seconds)


def _rows(study: Study, inputs: Given, count: int, limit: float | None) -> tuple[Rows, float | None]:
    """The variants, and how long they took; all in error, and None, where they took too long."""
    began = time.monotonic()
    try:
        with limited(limit, own_process=parent_process() is not None):
            rows = calculate_rows(study.base, inputs, count, study.curves)
        return rows, time.monotonic() - began
    except Overran as overran:
        kind, words = blamed(overran, study.base, limit or 0.0, count)
        rows = Rows(count, study.curves, broken={kind: words})
        rows.status[:], rows.errors[:] = "error", f"plugin {kind!r}: {words}"
        return rows, None


def _left(study: Study, rows: Rows, given: Mapping[str, Values]) -> Array:
    """Which calculated variants the constraints on outputs leave; those in error stay with their reason."""
    late = [constraint for constraint in study.constraints if constraint.outputs]
    if not late:
        return np.ones(rows.count, dtype=bool)
    absent = np.full(rows.count, None, dtype=object)  # no variant of these has this output
    named = {name: rows.columns.get(name, absent) for constraint in late for name in constraint.outputs}
    held: Array = _all_hold(late, {**given, **named}, rows.count).holds | (rows.status == "error")
    return held


def judged(study: Study, given: Mapping[str, Values], count: int) -> JudgedRows:
    """Return which rows keep all constraints between inputs, and which break one; the others have one without a value."""
    return _all_hold([constraint for constraint in study.constraints if not constraint.outputs], given, count)


def _all_hold(constraints: Sequence[Constraint], given: Mapping[str, Values], count: int) -> JudgedRows:
    holds, fails = np.ones(count, dtype=bool), np.zeros(count, dtype=bool)
    for constraint in constraints:
        found = constraint.judged(given)
        holds, fails = holds & found.holds, fails | found.fails
    return JudgedRows(holds, fails)


def _taken(values: Values, rows: Array) -> Values:
    return values[rows] if isinstance(values, np.ndarray) else [values[row] for row in rows]


def _worker_kind(values: Values) -> Any:
    return float if isinstance(values, np.ndarray) else object


def _is_kept(study: Study, name: str) -> bool:
    return study.outputs is None or ".checks." in name or name in study.outputs or name in study.curves
