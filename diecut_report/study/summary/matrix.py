"""The utilisation matrix: chosen variants against all checks, each with the way to its full report."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from diecut_report.languages.speech import said, say
from diecut_report.study.analysis.stored_variants import Stored
from diecut_report.study.summary.data import BANDS, SOUND, Utilisation
from diecut_report.study.summary.quantity_names import WORST, utilised

ALL, REPORTED, BEST, WORST_ONES = 80, 15, 15, 10  # rows: up to which all variants stand, else of each sort
ACROSS = 14  # checks in a table
LISTED = 200  # links to full reports
IDLE = 0.1  # utilisation that a check of the matrix reaches in some variant


class MatrixCell(NamedTuple):
    """Hold a utilisation as text, and its class: u0 … u4 by size, ``none`` without one; ``is_failing`` by the check's status."""

    text: str
    sort: str
    is_failing: bool


class MatrixRow(NamedTuple):
    """Hold a variant: its number, the file of its full report (or nothing), its status, and its cells."""

    variant: int
    href: str
    status: str
    cells: list[MatrixCell]


class Group(NamedTuple):
    """Hold variants that stand together in the matrix, under a title that says why."""

    title: str
    variants: list[int]


class Matrix(NamedTuple):
    """Hold part of the matrix: numbers and names of its checks, and its rows in groups."""

    checks: list[tuple[int, str]]
    groups: list[tuple[str, list[MatrixRow]]]

    @property
    def rows(self) -> list[MatrixRow]:
        """Return the rows of all groups."""
        return [row for _, rows in self.groups for row in rows]


def report_of(folder: Path, variant: int) -> str:
    """Return the full report of a variant, from the summary's place, if there is one."""
    for ending in ("html", "pdf"):
        if (folder / "reports" / f"{variant}.{ending}").is_file():
            return f"reports/{variant}.{ending}"
    return ""


def reported(folder: Path) -> list[int]:
    """Return the variants that have a full report."""
    files = (folder / "reports").glob("*.*") if (folder / "reports").is_dir() else []
    return sorted({int(file.stem) for file in files if file.stem.isdecimal() and file.suffix in (".html", ".pdf")})


def chosen(stored: Stored, total: int, best: Sequence[int]) -> list[Group]:
    """Return the best first, then those with reports, then the most overloaded; of a small study all variants. Each stands once."""
    reports = reported(stored.folder)
    first = say("Best: first by the objective") if len(_goals(stored)) == 1 else say("Best: on the Pareto front")
    groups = [Group(_cut(first, len(best), BEST), list(best[:BEST]))]
    if total <= ALL:
        groups += [
            Group(say("Others that pass, with most margin first"), _numbers(stored, SOUND, "NULLS LAST")),
            Group(
                say("Those that fail, the least overloaded first"), _numbers(stored, "status = 'fail'", "NULLS LAST")
            ),
            Group(say("Those that cannot exist"), _numbers(stored, "status = 'error'", "")),
        ]
    else:
        groups += [
            Group(_cut(say("Others with a full report"), len(reports), REPORTED), reports[:REPORTED]),
            Group(
                say("Fail: the {n} most overloaded variants", n=WORST_ONES),
                _numbers(stored, "status = 'fail'", f"DESC NULLS FIRST, variant LIMIT {WORST_ONES}"),
            ),
        ]
    return list(_once(groups))


def _goals(stored: Stored) -> Sequence[object]:
    return stored.study.get("objectives") or ()


def _cut(title: str, count: int, most: int) -> str:
    return say("{title} (the first {most} of {n})", title=title, most=most, n=count) if count > most else title


def _numbers(stored: Stored, where: str, order: str) -> list[int]:
    order = order if "variant" in order else f"{order}, variant"
    return [row[0] for row in stored.rows(f"SELECT variant FROM w WHERE {where} ORDER BY {WORST.sql} {order}")]


def _once(groups: Iterable[Group]) -> Iterator[Group]:
    known: set[int] = set()
    for title, variants in groups:
        new = [int(variant) for variant in variants if variant not in known]
        known |= set(new)
        if new:
            yield Group(title, new)


def telling(used: Sequence[Utilisation]) -> list[Utilisation]:
    """Return the checks that stand in the matrix: those that do not always pass with ease."""
    return [row for row in used if row.failing or row.warning or (row.greatest or 0.0) > IDLE]


def matrices(stored: Stored, groups: Sequence[Group], checks: Sequence[str]) -> Iterator[Matrix]:
    """Yield the matrix in parts that fit on paper."""
    for start in range(0, len(checks), ACROSS):
        part = list(checks[start : start + ACROSS])
        numbers = [(start + index + 1, said(stored.check_told(name))) for index, name in enumerate(part)]
        rows = _rows(stored, [variant for group in groups for variant in group.variants], part)
        found = [(group.title, [rows[one] for one in group.variants if one in rows]) for group in groups]
        yield Matrix(numbers, [(title, some) for title, some in found if some])


def _rows(stored: Stored, variants: Sequence[int], checks: Sequence[str]) -> dict[int, MatrixRow]:
    asked = ", ".join(column.sql for check in checks for column in stored.checks[check])
    listed = ", ".join(str(variant) for variant in variants) or "NULL"
    found = {}
    for variant, status, *values in stored.rows(f"SELECT variant, status, {asked} FROM v WHERE variant IN ({listed})"):
        cells = [_cell(value, made) for value, made in zip(values[::2], values[1::2], strict=True)]
        found[variant] = MatrixRow(variant, report_of(stored.folder, variant), status, cells)
    return found


def _cell(value: float | None, made: str | None) -> MatrixCell:
    failing = made == "fail"
    if value is None:
        return MatrixCell("✗" if failing else "–" if made is None else "✓", "u4" if failing else "none", failing)
    return MatrixCell(utilised(value), f"u{sum(value > limit for limit in BANDS)}", failing)
