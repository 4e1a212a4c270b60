"""The utilisation matrix: chosen variants against all checks, each with the way to its full report."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from diecut_report.batch.stored import Stored
from diecut_report.batch.summary.data import BANDS, WORST, Utilisation
from diecut_report.batch.summary.names import utilised

ALL, REPORTED, BEST, WORST_ONES = 80, 15, 15, 10  # rows: up to which all variants stand, else of each sort
ACROSS = 14  # checks in a table
LISTED = 200  # links to full reports
IDLE = 0.1  # utilisation that a check of the matrix reaches in some variant


class Cell(NamedTuple):
    """A utilisation as text, and its class: u0 … u4 by size, ``none`` without one; ``is_failing`` by the check's status."""

    text: str
    sort: str
    is_failing: bool


class Row(NamedTuple):
    """A variant: its number, the file of its full report (or nothing), its status, and its cells."""

    variant: int
    href: str
    status: str
    cells: list[Cell]


class Matrix(NamedTuple):
    """Part of the matrix: numbers and names of its checks, and its rows."""

    checks: list[tuple[int, str]]
    rows: list[Row]


def report_of(folder: Path, variant: int) -> str:
    """The full report of a variant, from the summary's place, if there is one."""
    for ending in ("html", "pdf"):
        if (folder / "reports" / f"{variant}.{ending}").is_file():
            return f"reports/{variant}.{ending}"
    return ""


def reported(folder: Path) -> list[int]:
    """The variants that have a full report."""
    files = (folder / "reports").glob("*.*") if (folder / "reports").is_dir() else []
    return sorted({int(file.stem) for file in files if file.stem.isdecimal() and file.suffix in (".html", ".pdf")})


def chosen(stored: Stored, total: int, best: Iterable[int]) -> list[int]:
    """All variants of a small study; of a large one those with reports, the best, and the most overloaded."""
    if total <= ALL:
        return [row[0] for row in stored.rows("SELECT variant FROM v ORDER BY variant")]
    sql = (
        f"SELECT variant FROM w WHERE status = 'fail' ORDER BY {WORST.sql} DESC NULLS FIRST, variant LIMIT {WORST_ONES}"
    )
    worst = [row[0] for row in stored.rows(sql)]
    found = [*reported(stored.folder)[:REPORTED], *list(best)[:BEST], *worst]
    return sorted(dict.fromkeys(int(variant) for variant in found))


def telling(used: Sequence[Utilisation]) -> list[Utilisation]:
    """The checks that stand in the matrix: those that do not always pass with ease."""
    return [row for row in used if row.failing or row.warning or (row.greatest or 0.0) > IDLE]


def matrices(stored: Stored, variants: Sequence[int], checks: Sequence[str]) -> Iterator[Matrix]:
    """The matrix in parts that fit on paper."""
    for start in range(0, len(checks), ACROSS):
        part = list(checks[start : start + ACROSS])
        numbers = [(start + index + 1, stored.check_told(name)) for index, name in enumerate(part)]
        yield Matrix(numbers, list(_rows(stored, variants, part)))


def _rows(stored: Stored, variants: Sequence[int], checks: Sequence[str]) -> Iterator[Row]:
    asked = ", ".join(column.sql for check in checks for column in stored.checks[check])
    listed = ", ".join(str(variant) for variant in variants) or "NULL"
    for variant, status, *values in stored.rows(
        f"SELECT variant, status, {asked} FROM v WHERE variant IN ({listed}) ORDER BY variant"
    ):
        cells = [_cell(value, made) for value, made in zip(values[::2], values[1::2], strict=True)]
        yield Row(variant, report_of(stored.folder, variant), status, cells)


def _cell(value: float | None, made: str | None) -> Cell:
    failing = made == "fail"
    if value is None:
        return Cell("✗" if failing else "–" if made is None else "✓", "u4" if failing else "none", failing)
    return Cell(utilised(value), f"u{sum(value > limit for limit in BANDS)}", failing)
