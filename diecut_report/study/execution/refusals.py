"""What the constraints of a study drop from its sample, judged before or beside the calculation."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from diecut_report.errors import Problem, UserError
from diecut_report.formulas.condition_numpy import JudgedRows
from diecut_report.study.definition.constraints import why_dropped
from diecut_report.study.definition.study_file import Study
from diecut_report.study.execution.pending import ChunkFailed, Engine, InProcess, Pool, Warm, results
from diecut_report.study.execution.worker import judged
from diecut_report.text.phrases import Phrase, phrase

ROWS = 65_536  # at a time


def judged_rows(study: Study) -> Iterator[JudgedRows]:
    """Yield which rows of the sample keep all constraints and which break one, some at a time."""
    for start in range(0, study.sample.count, ROWS):
        stop = min(start + ROWS, study.sample.count)
        yield judged(study, study.sample.rows(start, stop), stop - start)


def without_value(study: Study) -> int:
    """Return how many rows break no constraint, but have one without a value; they are dropped too."""
    if not study.constraints:
        return 0
    return sum(int(np.sum(~(found.holds | found.fails))) for found in judged_rows(study))


# Where chunks of a study are calculated: in this process, in a pool of processes, or on a Dask cluster.
#
# One interface, `results`; the same function on the same chunks gives the same results on each engine.


__all__ = ["ChunkFailed", "Engine", "InProcess", "Pool", "Warm", "dask_cluster", "results"]


def dask_cluster(address: str, warm: Warm) -> Engine:
    """Return the workers of the Dask scheduler at this address; UserError where Dask is not installed."""
    try:
        from diecut_report.study.execution.dask_cluster import Dask
    except ModuleNotFoundError as error:
        if error.name not in ("dask", "distributed"):
            raise
        words = phrase(
            "Dask is not installed. Install it with: pip install --require-hashes -r requirements-cluster.lock"
        )
        raise UserError(Problem(words)) from error
    return Dask(address, warm)


# Studies that are refused before anything is calculated: those without a variant, and those that are huge by mistake.


LARGEST = 10_000_000  # rows that are calculated without being asked for twice


def refuse_unsampled(study: Study) -> None:
    """Require a sample: a study that says only what is searched for has no variants of its own."""
    if not study.is_sampled:
        words = "is missing: this study says by optimise what is searched for. Run it with `diecut-report optimise`, or give a sample."
        raise UserError(Problem(phrase(words), str(study.file), path="sample"))


def refuse_huge(study: Study, agreed: bool) -> None:
    """Require a yes to a sample that is larger than one would calculate by mistake."""
    count = study.sample.count
    if count > LARGEST and not agreed:
        words = Phrase(
            "the sample has {count} variants, more than {largest}. Vary less, or give --yes to calculate them all.",
            count=format(count, ","),
            largest=format(LARGEST, ","),
        )
        raise UserError(Problem(words, str(study.file), path="sample"))


def refuse_empty(study: Study) -> None:
    """Require that the constraints leave at least one variant."""
    if not study.constraints or any(found.holds.any() for found in judged_rows(study)):
        return
    why = why_dropped({"without_value": without_value(study)})
    words = Phrase(
        "the constraints drop all {count} variants of the sample{why}. Loosen one of them, or vary other values.",
        count=format(study.sample.count, ","),
        why=why,
    )
    raise UserError(Problem(words, str(study.file), path="constraints"))
