"""What a strict judge counts as failed in a study: variants that warn, and checks that are not made."""

from __future__ import annotations

from pathlib import Path

from diecut_report.results.unchecked import NOT_CHECKED
from diecut_report.study.analysis.stored_variants import opened, text


def is_doubtful(folder: Path) -> bool:
    """Return whether a stored variant warns, or a check of one is not made; one that cannot exist does not count."""
    with opened(folder) as stored:
        columns = (status.sql for _, status in stored.checks.values())
        asked = " OR ".join(["status = 'warn'", *(f"{column} = {text(NOT_CHECKED)}" for column in columns)])
        ((count,),) = stored.rows(f"SELECT count(*) FROM v WHERE status <> 'error' AND ({asked})")
    return bool(count)
