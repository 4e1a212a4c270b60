"""A run of a study: chunks of its sample to an engine, results to the folder, then reports and summary."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np

from diecut_report.config.model import PRESS
from diecut_report.config.source_hashes import plugin_faults
from diecut_report.mechanism.inputs import Quantity
from diecut_report.study.definition.base_inputs import Input
from diecut_report.study.definition.samples import Sobol
from diecut_report.study.definition.study_file import Study
from diecut_report.study.execution import worker
from diecut_report.study.execution.pending import Engine, InProcess, Pool, Warm, results
from diecut_report.study.execution.refusals import dask_cluster, without_value
from diecut_report.study.execution.variant_rows import columns_of, curve_columns
from diecut_report.study.execution.worker import ChunkClock
from diecut_report.study.storage.description import Description, ResultColumn, StudySource
from diecut_report.study.storage.store import Store

SMALL = 1024  # variants up to which a pool of processes costs more time than it saves
PARTS = 16  # at least as many part files in a study that is large enough, so that all processes have work to the end
PART = (512, 8192)  # least and most variants of a part file
VALUES = 8_000_000  # numbers of a part file at most, for curves are long


@dataclass
class Counts:
    """Count how far a run is."""

    rows: int
    done: int = 0
    variants: int = 0  # that the constraints leave
    failed: int = 0
    errors: int = 0
    before: int = 0  # rows that an earlier run has done


Tell = Callable[[Counts], None]


@dataclass(frozen=True)
class Where:
    """Say where a study is calculated: so many processes here, or a Dask scheduler's address.

    ``language``: that of its documents, in place of the project's. ``chunk_limit``: the seconds that a chunk may take, 0 for any
    time; None for what follows from the chunks before it.
    """

    jobs: int | None = None
    dask: str | None = None
    plugins: Sequence[str] = ()
    language: str | None = None
    chunk_limit: float | None = None


@dataclass
class StudyOutcome:
    """Hold what a run left in its folder."""

    store: Store
    counts: dict[str, int]
    slow: dict[str, str] = field(default_factory=dict)
    broken: dict[str, str] = field(default_factory=dict)  # plugins that broke for some variants, and why
    broken_reports: dict[str, str] = field(default_factory=dict)  # plugins that broke in full reports, and why
    notes: tuple[str, ...] = ()  # what else the user should know
    doubtful: dict[str, list[str]] = field(
        default_factory=dict
    )  # foreign plugins whose formulas have faults, and which
    overran: int = 0  # chunks that were ended for taking too long

    @property
    def is_failed(self) -> bool:
        """Return whether a variant fails a check, or there is none that can exist; single ones that cannot do not count."""
        return self.counts.get("fail", 0) > 0 or self.has_none

    @property
    def has_none(self) -> bool:
        """Return whether all variants are in error: nothing was calculated of what was asked for."""
        return 0 < self.counts.get("variants", 0) == self.counts.get("error", 0)

    @property
    def is_broken(self) -> bool:
        """Return whether a plugin broke for all variants, in a full report, or never came back: a single variant in error does not count."""
        return bool(self.broken_reports or self.overran) or (
            bool(self.broken) and self.counts["error"] == self.counts["variants"]
        )


def run_study(study: Study, directory: Path, where: Where, *, resume: bool, tell: Tell) -> StudyOutcome:
    """Calculate all variants of a study that are not in the folder yet; each part file is whole or absent, whatever happens."""
    store = Store.open(directory, described(study)) if resume else Store.create(directory, described(study))
    with store.lock():
        store.start(facts(study))
        began, before = time.monotonic(), float(store.state.get("seconds") or 0)
        overran = 0
        slow, broken = dict(store.state.get("slow") or {}), dict(store.state.get("broken") or {})

        def noted() -> None:
            told = {"broken": broken} if broken else {}
            store.note({"slow": slow, "seconds": before + time.monotonic() - began} | told)

        try:
            for done in _calculated(study, store, where, tell):
                slow |= done.slow  # noted with each part: a run that is killed later has reported it
                broken |= done.broken
                overran += done.seconds is None
                noted()
        finally:  # an interrupted run has spent its time too
            noted()
        store.finish({}, without_value(study))
    return StudyOutcome(store, store.state["counts"], slow, broken, doubtful=_doubtful(study), overran=overran)


def _calculated(study: Study, store: Store, where: Where, tell: Tell) -> Iterator[worker.Done]:
    """Write each part as soon as it is calculated."""
    there = store.done_parts()
    for path in (path for index, path in store.parts().items() if index not in there):
        path.unlink(missing_ok=True)  # a damaged part is calculated again
    known = store.counts()
    counts = Counts(
        study.sample.count, variants=known["variants"], failed=known.get("fail", 0), errors=known.get("error", 0)
    )
    counts.before = sum(len(store.rows(index)) for index in there)
    tell(counts)
    missing = store.description.parts - len(there)
    if not missing:
        return
    clock = ChunkClock(where.chunk_limit)
    rows = {index: store.rows(index) for index in range(store.description.parts) if index not in there}
    chunks = (
        worker.Chunk(i, own.start, own.stop, clock.limit(len(own))) for i, own in rows.items()
    )  # when it is begun
    with engine_for(study, where, missing) as engine:
        for chunk, done in results(engine, worker.calculate, chunks):
            store.write_part(chunk.part, done.columns)
            if done.seconds is not None:
                clock.measure(chunk.stop - chunk.start, done.seconds)
            counts.done += chunk.stop - chunk.start
            counts.variants += len(done.columns["status"])
            counts.failed += int(np.sum(done.columns["status"] == "fail"))
            counts.errors += int(np.sum(done.columns["status"] == "error"))
            tell(counts)
            yield done


def engine_for(study: Study, where: Where, chunks: int, rows: int | None = None) -> Engine:
    """A Dask cluster where one is named, a pool of processes for many rows (of the sample), this process for few."""
    warm = Warm(
        _key(study, where),
        worker.load,
        (study.file.read_bytes(), contents(study), tuple(where.plugins), study.base.source_hashes),
    )
    if where.dask:
        return dask_cluster(where.dask, warm)
    jobs = min(where.jobs or os.cpu_count() or 1, chunks)
    return Pool(jobs, warm) if jobs > 1 and (where.jobs or (rows or study.sample.count) > SMALL) else InProcess(warm)


def _key(study: Study, where: Where) -> str:
    known = [
        study.sha256,
        study.base.tree.sha256,
        *study.tables.values(),
        *where.plugins,
        *study.base.source_hashes.values(),
    ]
    return sha256("\n".join(known).encode()).hexdigest()


def contents(study: Study) -> dict[str, bytes]:
    """Return the base and the tables of a study, by their names as it names them."""
    return {name: path.read_bytes() for name, path in study.files.items()}


def described(study: Study) -> Description:
    """Return the study as its folder keeps it."""
    files = contents(study)
    base = str(study.data["base"])
    columns = [*varied_columns(study), *result_columns(study)]
    chunk = min(int(np.clip(study.sample.count // PARTS, *PART)), max(1, VALUES // _width(study, columns)))
    return Description(
        study=StudySource(study.file.name, study.sha256, study.content),
        base=StudySource(base, study.base.tree.sha256, files[base]),
        columns=tuple(columns),
        rows=study.sample.count,
        chunk=chunk,
        tables=tuple(StudySource(name, digest, files[name]) for name, digest in study.tables.items()),
        plugins=_versions(study),
        sources=study.base.source_hashes,
    )


def _width(study: Study, columns: Sequence[ResultColumn]) -> int:
    """How many numbers a variant has, curves with as many points as the longest of the base."""
    models = [instance for instance in study.base.instances.values() if instance is not None]
    points = [instance.data.get("n_points", field.default) for instance in models
              if (field := instance.model.model_fields.get("n_points"))]  # fmt: skip
    most = max((int(number) for number in points if isinstance(number, int)), default=1)
    return sum(most if column.kind == "curve" else 1 for column in columns)


def _versions(study: Study) -> dict[str, str]:
    made = [instance.mechanism for name, instance in study.base.instances.items() if instance and name != PRESS]
    return {mechanism.kind: mechanism.version for mechanism in made if mechanism}


def _doubtful(study: Study) -> dict[str, list[str]]:
    """The kinds of foreign plugins whose formulas have faults, with these."""
    made = [instance.mechanism for instance in study.base.instances.values() if instance]
    return {each.kind: list(faults) for each in made if each and (faults := plugin_faults(each))}


def varied_columns(study: Study) -> list[ResultColumn]:
    """Return a column for each varied path."""
    return [_varied(path, asked) for path, asked in study.inputs.items()]


def _varied(path: str, asked: Input) -> ResultColumn:
    meta = asked.meta
    if not isinstance(meta, Quantity):
        return ResultColumn(path, "text", description=meta.description)
    si = meta.parsed_unit.si
    return ResultColumn(path, "float", si, meta.unit if meta.unit != si else "", meta.symbol, meta.description)


def result_columns(study: Study) -> list[ResultColumn]:
    """Return the outputs that are kept, and all checks, of all texts that the study varies."""
    found: dict[str, ResultColumn] = {}
    curves: dict[str, ResultColumn] = {}
    for base in study.bases:
        found |= {column.name: column for column in columns_of(base)}
        curves |= {column.name: column for column in curve_columns(base, study.curves)}
    kept = [
        column for name, column in found.items() if study.outputs is None or ".checks." in name or name in study.outputs
    ]
    return [*kept, *curves.values()]


def facts(study: Study) -> Mapping[str, Any]:
    """Return what else the summary and questions need to know of the study."""
    objectives = [{"minimise" if each.minimise else "maximise": each.output} for each in study.objectives]
    known: dict[str, Any] = {"varied": list(study.inputs), "objectives": objectives}
    known |= {"doubtful": found} if (found := _doubtful(study)) else {}
    if isinstance(study.sample, Sobol) and study.sample.indices:
        known |= {"design": "saltelli", "n": study.sample.points}
    return known
