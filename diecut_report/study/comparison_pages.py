"""The comparison of machines as HTML (one file, no network), PDF, XLSX, CSV and JSON."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from diecut_report.files import room
from diecut_report.quantities.units import pretty
from diecut_report.report.office.sheets import Cell, CellNumber, WorkSheet, form_of
from diecut_report.report.office.workbook import book_of
from diecut_report.report.pages.html import styled_page
from diecut_report.report.pages.pdf import printed_page
from diecut_report.results.results_file import encoded
from diecut_report.study.comparison import MOST_ROWS, WORDS, ComparedCell, ComparedRow, MachineComparison, as_data
from diecut_report.text.phrases import phrase
from diecut_report.text.translation import said, say

MOST_COLUMNS = 12  # machines abreast on a landscape sheet; more of them go on in a further table
STYLES = {"screen": ("reader", "comparison", "comparison_screen"), "print": ("comparison",)}


def page(made: MachineComparison, kind: str = "screen") -> str:
    """Return the comparison as one self-contained HTML page."""
    groups = [
        (phrase("Verdicts"), made.verdicts),
        (phrase("Results"), made.results),
        (phrase("Mechanisms that not all have"), _merged(made.kinds)),
        (phrase("Inputs typed differently"), made.changes[:MOST_ROWS]),
    ]
    return styled_page(
        "comparison.html.j2", kind, STYLES[kind], c=made, groups=[each for each in groups if each[1]], checks=made.telling_checks[:MOST_ROWS],
        tables=list(blocks(len(made.machines))), omitted=made.omitted, pretty=pretty,
    )  # fmt: skip


def printed(made: MachineComparison) -> bytes:
    """Return the comparison as PDF."""
    with room():
        return printed_page(page(made, "print"))


def _merged(kinds: Sequence[ComparedRow]) -> list[ComparedRow]:
    """Return one row for all mechanisms that the same machines have; one whose kind differs stands alone, with its kinds."""
    alike: dict[tuple[bool, ...], list[str]] = {}
    rows = []
    for row in kinds:
        if len({cell.text for cell in row.cells if cell}) > 1:
            rows.append(replace(row, title=row.path))
        else:
            alike.setdefault(tuple(cell is not None for cell in row.cells), []).append(row.path)
    tick = ComparedCell(True, "✓")
    for there, names in alike.items():
        rows.append(ComparedRow("", ", ".join(names), [tick if has else None for has in there]))
    return rows


def blocks(count: int) -> Iterator[range]:
    """Yield the machines of each table: as few tables as possible, all of about the same width."""
    tables = -(-count // MOST_COLUMNS) or 1
    for number in range(tables):
        yield range(count * number // tables, count * (number + 1) // tables)


def table(made: MachineComparison) -> bytes:
    """Return all rows as CSV: path, what it is, unit, and a number or a text for each machine; a check has a row for each of its two sides."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([say("path"), say("description"), say("unit"), *made.names])
    rows = [*made.verdicts, *made.results, *made.kinds, *made.changes]
    writer.writerows([row.path, row.title, row.unit, *map(_plain, row.cells)] for row in rows)
    for row in made.checks:
        path, _, check = row.path.partition(".")
        states = [cell.status if cell else "" for cell in row.cells]
        writer.writerow([f"{path}.checks.{check}.utilisation", row.title, row.unit, *map(_plain, row.cells)])
        writer.writerow([f"{path}.checks.{check}.status", row.title, "", *states])
    return encoded(text.getvalue())


def _plain(cell: ComparedCell | None) -> str | float | None:
    """Return what a cell holds, as programs read it."""
    return None if cell is None else str(cell.value).lower() if isinstance(cell.value, bool) else cell.value


# The workbook: a machine in each row of its first sheet, so that it can be filtered and drawn; units stand in the heads.


LONGEST = 46  # letters of a column


def sheets(made: MachineComparison) -> list[WorkSheet]:
    """Return the sheets: machines with their results, what differs, the checks, the advice; numbers are numbers."""
    found = [_machines(made)]
    if made.kinds or made.changes:
        found.append(_differences(made, [*made.kinds, *made.changes]))
    if made.checks:
        found.append(_checks(made))
    if made.advice:
        heads = [say("machine"), say("check"), say("advice")]
        found.append(_sheet(say("advice"), heads, [list(each) for each in made.advice]))
    return found


def _differences(made: MachineComparison, rows: Sequence[ComparedRow]) -> WorkSheet:
    """Return the sheet of what was typed differently; behind the values of all what they rest on, where that differs."""
    heads = [say("input"), say("description"), say("unit"), *made.names]
    cells: list[list[Cell]] = [[row.path, row.title, pretty(row.unit), *map(_cell, row.cells)] for row in rows]
    notes = [[cell.note if cell else "" for cell in row.cells] for row in rows]
    if any(map(any, notes)):
        heads += [f"{name}: " + say("basis") for name in made.names]
        cells = [[*own, *rests_on] for own, rests_on in zip(cells, notes, strict=True)]
    return _sheet(say("differences"), heads, cells)


def _machines(made: MachineComparison) -> WorkSheet:
    columns = [part for row in (*made.verdicts, *made.results) for part in _columns(row)]
    columns.append((say("file"), [each.file for each in made.machines]))
    if any(each.messages for each in made.machines):
        columns.append((say("what is wrong"), ["\n".join(map(said, each.messages)) for each in made.machines]))
    rows: list[list[Cell]] = [[name, *(cells[index] for _, cells in columns)] for index, name in enumerate(made.names)]
    sheet = _sheet(say("comparison"), [say("machine"), *(head for head, _ in columns)], rows)
    if len(rows) > 1:
        sheet.bars = [number for number, (_, cells) in enumerate(columns, 1) if any(map(_is_share, cells))]
    return sheet


def _columns(row: ComparedRow) -> Iterator[tuple[str, list[Cell]]]:
    """Yield the column of a row, and, where its cells have notes, a column of these; a check without a utilisation has its verdict there."""
    cells = list(map(_cell, row.cells))
    yield f"{row.title} [%]" if any(map(_is_share, cells)) else row.head, cells
    notes = [
        cell.note and (f"{cell.note}: {cell.text}" if cell.value is None else cell.note) if cell else ""
        for cell in row.cells
    ]
    if any(notes):
        yield say("{title}: which", title=row.title), list(notes)


def _is_share(cell: Cell) -> bool:
    return isinstance(cell, CellNumber) and cell.form.endswith("%")


def _checks(made: MachineComparison) -> WorkSheet:
    """Return the checks, of each machine the utilisation and, behind those of all, the verdict."""
    verdicts = [f"{name}: " + say("verdict") for name in made.names]
    rows: list[list[Cell]] = []
    for row in made.checks:
        states = [said(WORDS[cell.status]) if cell else "" for cell in row.cells]
        rows.append([row.path, row.title, *map(_cell, row.cells), *states])
    return _sheet(say("checks"), [say("check"), say("title"), *made.names, *verdicts], rows)


def _cell(cell: ComparedCell | None) -> Cell:
    """Return a cell of a workbook: a number with the digits that are printed, a utilisation as a share in per cent."""
    if cell is None or cell.value is None:
        return None
    if isinstance(cell.value, bool) or not isinstance(cell.value, int | float):
        return cell.text
    if cell.text.endswith("%"):
        return CellNumber(cell.value, "0.0%")
    return CellNumber(cell.value, form_of(cell.text.replace(",", ".")))


def _sheet(title: str, heads: list[str], rows: list[list[Cell]]) -> WorkSheet:
    columns = zip(heads, *([*row, *[None] * (len(heads) - len(row))] for row in rows), strict=True)
    widths = [min(max(_width(cell) for cell in column) + 3, LONGEST) for column in columns]
    return WorkSheet(title, [heads], rows, widths, is_filtered=True)


def _width(cell: Cell) -> int:
    return 8 if isinstance(cell, CellNumber) else max(map(len, (cell or "").splitlines()), default=0)


FORMATS: dict[str, Callable[[MachineComparison], bytes]] = {
    "html": lambda made: encoded(page(made)),
    "pdf": printed,
    "xlsx": lambda made: book_of(sheets(made)),
    "csv": table,
    "json": lambda made: encoded(json.dumps(as_data(made), indent=1, ensure_ascii=False, allow_nan=False) + "\n"),
}


def files(
    made: MachineComparison, folder: Path, name: str, formats: Sequence[str], neutral: MachineComparison
) -> dict[Path, bytes]:
    """Return the files of a comparison, all made before any is written; ``neutral`` is the same in English, for JSON."""
    shown: dict[str, Any] = {"json": neutral}
    return {folder / f"{name}.{ending}": FORMATS[ending](shown.get(ending, made)) for ending in formats}
