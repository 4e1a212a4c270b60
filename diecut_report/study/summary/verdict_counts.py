"""What fails and what holds: in how many variants each check fails, governs, or is the only one; what governs those that pass."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import NamedTuple

from diecut_report.study.analysis.stored_variants import Stored
from diecut_report.study.summary.data import FAILING, SOUND, Utilisation, chunks
from diecut_report.study.summary.quantity_names import WORST

SAME = 1e-6  # relative difference up to which two margins are shared


class Failure(NamedTuple):
    """Hold a check: in how many variants it fails, governs the failure, is the only failing one, and has a warning."""

    check: str
    failing: int
    governing: int
    only: int
    warning: int


class Governing(NamedTuple):
    """Hold a check that governs variants which pass: how many, their least and greatest utilisation, and whether its own one varies at all."""

    check: str
    variants: int
    least: float | None
    greatest: float | None
    varies: bool = True


class Margin(NamedTuple):
    """Hold least utilisation of all that pass: a variant, its governing check, and how many variants share it."""

    variant: int
    utilisation: float
    check: str
    shared: int


def failures(stored: Stored, used: Sequence[Utilisation]) -> list[Failure]:
    """Return the checks that fail or warn in any variant, those with the most failures first."""
    sql = "SELECT governing, count(*) FROM v WHERE status = 'fail' AND governing IS NOT NULL GROUP BY governing"
    governed = dict(stored.rows(sql))
    rows = [row for row in used if row.failing or row.warning]
    alone = _alone(stored, [row.check for row in rows])
    found = [Failure(row.check, row.failing, governed.get(row.check, 0), alone[row.check], row.warning) for row in rows]
    return sorted(found, key=lambda row: (-row.failing, -row.governing, -row.warning, row.check))


def _alone(stored: Stored, checks: list[str]) -> dict[str, int]:
    """In how many variants each check is the only one that fails."""
    found: dict[str, int] = {}
    for part in chunks(checks):
        asked = (f"count(*) FILTER ({stored.checks[check][1].sql} = 'fail')" for check in part)
        row = stored.rows(f"SELECT {', '.join(asked)} FROM w WHERE {FAILING} = 1")[0]
        found |= dict(zip(part, row, strict=True))
    return found


def unchecked(stored: Stored) -> list[str]:
    """Return the checks that are not made in some variant, as a limit or another key is not given."""
    found: list[str] = []
    for part in chunks(list(stored.checks)):
        asked = (f"count(*) FILTER ({stored.checks[check][1].sql} = 'not_checked')" for check in part)
        row = stored.rows(f"SELECT {', '.join(asked)} FROM v")[0]
        found += [check for check, count in zip(part, row, strict=True) if count]
    return found


def governing(stored: Stored, still: Collection[str] = ()) -> list[Governing]:
    """Return what governs the variants that pass, the most frequent first; checks whose utilisation stands ``still`` come last."""
    sql = (
        f"SELECT governing, count(*) AS n, min({WORST.sql}), max({WORST.sql}) FROM w "
        f"WHERE {SOUND} AND governing IS NOT NULL GROUP BY governing ORDER BY n DESC, governing"
    )
    found = [Governing(*row)._replace(varies=row[0] not in still) for row in stored.rows(sql)]
    return sorted(found, key=lambda row: not row.varies)


def margin(stored: Stored) -> Margin | None:
    """Return which of the variants that do not fail keeps most from its limits, and how many keep as much."""
    there = f"FROM w WHERE {SOUND} AND {WORST.sql} IS NOT NULL"
    least = stored.rows(f"SELECT min({WORST.sql}) {there}")[0][0]
    if least is None:
        return None
    alike = f"{there} AND {WORST.sql} <= {least * (1 + SAME)!r}"
    one, check, shared = stored.rows(f"SELECT min(variant), arg_min(governing, variant), count(*) {alike}")[0]
    return Margin(one, least, check, shared)
