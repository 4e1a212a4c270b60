"""What the constraints of a study drop from its sample, judged before or beside the calculation."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from diecut_report.conditions.numpy_emitter import JudgedRows
from diecut_report.study.definition.study_file import Study
from diecut_report.study.execution.worker import judged

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
