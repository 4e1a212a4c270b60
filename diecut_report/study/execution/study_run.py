"""A run of a study: refused where it makes no sense, then chunks of its sample to an engine, and results to the folder."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np

from diecut_report.config.references import as_file
from diecut_report.config.source_hashes import plugin_faults
from diecut_report.errors import Problem, UserError, refusal
from diecut_report.mechanism.inputs import Quantity
from diecut_report.study.definition.constraints import why_dropped
from diecut_report.study.definition.samples import Sobol
from diecut_report.study.definition.study_file import Study
from diecut_report.study.execution import worker
from diecut_report.study.execution.engines import Engine, InProcess, WorkerSetup, local_engine, results
from diecut_report.study.execution.variant_rows import column_of, columns_of, curve_columns
from diecut_report.study.execution.worker import ChunkClock, judged_rows, without_value
from diecut_report.study.storage.description import JUDGED, Description, ResultColumn, StudySource
from diecut_report.study.storage.store import Store
from diecut_report.text.phrases import Phrase

SMALL = 1024  # variants up to which a pool of processes costs more time than it saves
LARGEST = 10_000_000  # rows that are calculated without being asked for twice
PARTS = 16  # at least as many part files in a study that is large enough, so that all processes have work to the end
PART = (512, 8192)  # least and most variants of a part file
MAX_PART_VALUES = 8_000_000  # numbers of a part file, for curves are long


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
    doubtful: dict[str, list[str]] = field(default_factory=dict)  # foreign plugins with the faults of their formulas
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
        is_useless = bool(self.broken) and self.counts["error"] == self.counts["variants"]
        return bool(self.broken_reports or self.overran) or is_useless


def refuse_sample(study: Study, agreed: bool) -> None:
    """Require a sample, which a study lacks that says only what is searched for, and a yes to more than one would calculate by mistake."""
    count = study.sample.count
    if not study.is_sampled:
        template = "is missing: this study says by optimise what is searched for. Run it with `diecut-report optimise`, or give a sample."
    elif count > LARGEST and not agreed:
        template = (
            "the sample has {count} variants, more than {largest}. Vary less, or give --yes to calculate them all."
        )
    else:
        return
    message = Phrase(template, count=f"{count:,}", largest=f"{LARGEST:,}")
    raise UserError(Problem(message, study.tree.file, path="sample"))


def refuse_empty(study: Study) -> None:
    """Require that the constraints leave at least one variant."""
    if not study.constraints or any(found.holds.any() for found in judged_rows(study)):
        return
    template = (
        "the constraints exclude all {count} variants of the sample{why}. Relax one of them, or vary other values."
    )
    why = why_dropped({"without_value": without_value(study)})
    message = Phrase(template, count=f"{study.sample.count:,}", why=why)
    raise UserError(Problem(message, study.tree.file, path="constraints"))


def run_study(study: Study, directory: Path, where: Where, *, resume: bool, tell: Tell) -> StudyOutcome:
    """Calculate all variants of a study that are not in the folder yet; each part file is whole or absent, whatever happens."""
    store = Store.open(directory, described(study)) if resume else Store.create(directory, described(study))
    with store.lock():
        store.start(facts(study))
        began, before = time.monotonic(), store.state
        slow, broke = (dict(before.get(key) or {}) for key in ("slow", "broken"))
        outcome = StudyOutcome(store, {}, slow, broke, doubtful=_doubtful(study))

        def note() -> None:
            broken = {"broken": outcome.broken} if outcome.broken else {}
            seconds = float(before.get("seconds") or 0) + time.monotonic() - began
            store.note({"slow": outcome.slow, "seconds": seconds} | broken)

        try:
            for done in _calculated(study, store, where, tell):
                outcome.slow |= done.slow  # noted with each part: a run that is killed later has reported it
                outcome.broken |= done.broken
                outcome.overran += done.seconds is None
                note()
        finally:  # an interrupted run has spent its time too
            note()
        store.finish(without_value(study))
    outcome.counts = store.state["counts"]
    return outcome


def _calculated(study: Study, store: Store, where: Where, tell: Tell) -> Iterator[worker.Done]:
    there = store.done_parts()
    for path in (path for index, path in store.parts().items() if index not in there):
        path.unlink(missing_ok=True)  # a damaged part is calculated again
    known, rows = store.counts(), store.description.part_rows
    counts = Counts(study.sample.count, 0, known["variants"], known.get("fail", 0), known.get("error", 0))
    counts.before = sum(len(rows(index)) for index in there)
    tell(counts)
    missing = [index for index in range(store.description.parts) if index not in there]
    if not missing:
        return
    clock = ChunkClock(where.chunk_limit)
    # its limit is that of the time when it is begun
    chunks = (worker.Chunk(i, rows(i).start, rows(i).stop, clock.limit(len(rows(i)))) for i in missing)
    with engine_for(study, where, len(missing)) as engine:
        for chunk, done in results(engine, worker.calculate, chunks):
            store.write_part(chunk.part, done.columns)
            if done.seconds is not None:
                clock.measure(chunk.stop - chunk.start, done.seconds)
            status = done.columns["status"]
            counts.done += chunk.stop - chunk.start
            counts.variants += len(status)
            counts.failed += int(np.sum(status == "fail"))
            counts.errors += int(np.sum(status == "error"))
            tell(counts)
            yield done


def engine_for(study: Study, where: Where, chunks: int, rows: int | None = None) -> Engine:
    """Return a Dask cluster where one is named, a pool of processes for many rows (of the sample), this process for few."""
    code = study.base.source_hashes
    known = [study.tree.sha256, study.base.tree.sha256, *study.tables.values(), *where.plugins, *code.values()]
    args = (Path(study.tree.file).read_bytes(), contents(study), tuple(where.plugins), code)
    setup = WorkerSetup(sha256("\n".join(known).encode()).hexdigest(), worker.load, args)
    if where.dask:
        return dask_cluster(where.dask, setup)
    is_large = where.jobs or (rows or study.sample.count) > SMALL
    return local_engine(where.jobs, chunks, setup) if is_large else InProcess(setup)


def dask_cluster(address: str, setup: WorkerSetup) -> Engine:
    """Return the workers of the Dask scheduler at this address; UserError where Dask is not installed."""
    try:
        from diecut_report.study.execution.dask_cluster import Dask
    except ModuleNotFoundError as error:
        if error.name not in ("dask", "distributed"):
            raise
        template = "Dask is not installed. Install it with: pip install --require-hashes -r requirements-cluster.lock"
        raise refusal(template) from error
    return Dask(address, setup)


def contents(study: Study) -> dict[str, bytes]:
    """Return the base and the tables of a study, by their names as it names them."""
    return {name: path.read_bytes() for name, path in study.files.items()}


# --- what the folder keeps of a study --------------------------------------------------------------------------------


def described(study: Study) -> Description:
    """Return the study as its folder keeps it."""
    files = contents(study)
    base = str(study.tree.data["base"])
    columns = [*varied_columns(study), *result_columns(study)]
    chunk = min(int(np.clip(study.sample.count // PARTS, *PART)), max(1, MAX_PART_VALUES // _width(study, columns)))
    made = [instance.mechanism for instance in study.base.instances.values() if instance]
    return Description(
        study=StudySource(Path(study.tree.file).name, study.tree.sha256, as_file(study.tree, study.tree.text)),
        base=StudySource(base, study.base.tree.sha256, files[base]),
        columns=tuple(columns),
        rows=study.sample.count,
        chunk=chunk,
        tables=tuple(StudySource(name, digest, files[name]) for name, digest in study.tables.items()),
        plugins={mechanism.kind: mechanism.version for mechanism in made if mechanism},
        sources=study.base.source_hashes,
    )


def _width(study: Study, columns: Sequence[ResultColumn]) -> int:
    """Return how many numbers a variant has, curves with as many points as the longest of the base."""
    points = [instance.data.get("n_points", field.default) for instance in study.base.instances.values()
              if instance and (field := instance.model.model_fields.get("n_points"))]  # fmt: skip
    most = max((int(number) for number in points if isinstance(number, int)), default=1)
    return sum(most if column.kind == "curve" else 1 for column in columns)


def _doubtful(study: Study) -> dict[str, list[str]]:
    """Return the kinds of foreign plugins whose formulas have faults, with these."""
    made = [instance.mechanism for instance in study.base.instances.values() if instance]
    return {each.kind: list(faults) for each in made if each and (faults := plugin_faults(each))}


def varied_columns(study: Study) -> list[ResultColumn]:
    return [
        column_of(path, "float", asked.meta.unit, asked.meta)
        if isinstance(asked.meta, Quantity)
        else ResultColumn(path, "text", description=asked.meta.description)
        for path, asked in study.inputs.items()
    ]


def result_columns(study: Study) -> list[ResultColumn]:
    """Return the outputs that are kept, and all checks, of all texts that the study varies."""
    found: dict[str, ResultColumn] = {}
    curves: dict[str, ResultColumn] = {}
    for base in study.bases:
        found |= {column.name: column for column in columns_of(base)}
        curves |= {column.name: column for column in curve_columns(base, study.curves)}
    wanted = found if study.outputs is None else study.outputs
    return [*(each for name, each in found.items() if ".checks." in name or name in wanted), *curves.values(), JUDGED]


def facts(study: Study) -> dict[str, Any]:
    """Return what else the summary and questions need to know of the study."""
    objectives = [{"minimise" if each.minimise else "maximise": each.output} for each in study.objectives]
    known: dict[str, Any] = {"varied": list(study.inputs), "objectives": objectives}
    if found := _doubtful(study):
        known["doubtful"] = found
    if isinstance(study.sample, Sobol) and study.sample.indices:
        known |= {"design": "saltelli", "n": study.sample.points}
    return known
