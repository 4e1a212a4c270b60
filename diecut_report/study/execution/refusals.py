"""Studies that are refused before anything is calculated: those without a variant, and those that are huge by mistake."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from diecut_report.errors import Problem, UserError
from diecut_report.expressions import Array
from diecut_report.study.definition.study_file import Study
from diecut_report.study.execution.worker import allowed

LARGEST = 10_000_000  # rows that are calculated without being asked for twice
ROWS = 65_536  # at a time


def refuse_huge(study: Study, agreed: bool) -> None:
    """A sample that is larger than one would calculate by mistake must be agreed to."""
    count = study.sample.count
    if count > LARGEST and not agreed:
        words = (
            f"the sample has {count:,} variants, more than {LARGEST:,}. Vary less, or give --yes to calculate them all."
        )
        raise UserError(Problem(words, str(study.file), path="sample"))


def refuse_empty(study: Study) -> None:
    """At least one variant must be left by the constraints."""
    if not study.constraints or any(kept.any() for kept in _kept(study)):
        return
    words = f"the constraints drop all {study.sample.count:,} variants of the sample. Loosen one of them, or vary other values."
    raise UserError(Problem(words, str(study.file), path="constraints"))


def _kept(study: Study) -> Iterator[Array]:
    """Which rows are left, some at a time."""
    for start in range(0, study.sample.count, ROWS):
        stop = min(start + ROWS, study.sample.count)
        yield np.asarray(allowed(study, study.sample.rows(start, stop), stop - start))
