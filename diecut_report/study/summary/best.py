"""The best variants as a table, and the variants that have a full report."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from diecut_report.languages.speech import said
from diecut_report.study.analysis.stored_variants import Stored, StoredColumn
from diecut_report.study.summary import matrix, pareto
from diecut_report.study.summary.quantity_names import WORST, display, utilised, value_told

INPUTS = 6  # columns of inputs


class Best(NamedTuple):
    """Hold a variant on the front: number, report, status, greatest utilisation and whose it is, and objectives and inputs as texts."""

    variant: int
    href: str
    status: str
    utilisation: str
    governing: str
    values: list[str]


class ListedReport(NamedTuple):
    """Hold a full report of a variant."""

    variant: int
    href: str
    status: str


def columns(stored: Stored, goals: Sequence[pareto.StoredObjective]) -> list[StoredColumn]:
    """Return objectives and inputs that the table of the best shows."""
    return list(dict.fromkeys([*(goal.column for goal in goals), *stored.varied[:INPUTS]]))


def best(stored: Stored, variants: Sequence[int], shown: Sequence[StoredColumn]) -> list[Best]:
    """Return the rows of that table, in the order of the variants."""
    asked = ", ".join(["status", WORST.sql, "governing", *(column.sql for column in shown)])
    rows = {
        row[0]: row[1:] for row in stored.rows(f"SELECT variant, {asked} FROM w WHERE variant IN ({_list(variants)})")
    }
    return [_row(stored, one, rows[one], shown) for one in variants]


def _row(stored: Stored, variant: int, row: Sequence[Any], shown: Sequence[StoredColumn]) -> Best:
    status, worst, governing, *values = row
    return Best(
        variant,
        matrix.report_of(stored.folder, variant),
        status,
        "–" if worst is None else utilised(worst),
        said(stored.check_told(governing)) if governing else "",
        [_told(value, column) for value, column in zip(values, shown, strict=True)],
    )


def _told(value: Any, column: StoredColumn) -> str:
    if value is None:
        return "–"
    return display(float(value), column) if column.is_number else value_told(value)


def reports(stored: Stored, variants: Sequence[int]) -> list[ListedReport]:
    """Return the full reports of these variants."""
    states = dict(stored.rows(f"SELECT variant, status FROM v WHERE variant IN ({_list(variants)})"))
    return [ListedReport(one, matrix.report_of(stored.folder, one), states[one]) for one in variants if one in states]


def _list(variants: Sequence[int]) -> str:
    return ", ".join(map(str, variants)) or "NULL"
