"""The variants as CSV and XLSX beside the part files, for spreadsheets and other programs; streamed, so memory stays flat."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from io import BytesIO
from itertools import chain, islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

from diecut_report.errors import refusal
from diecut_report.files import replaced, room
from diecut_report.study.storage.store import PARTS, Store
from diecut_report.text.phrases import Phrase, named

if TYPE_CHECKING:
    from openpyxl.worksheet._write_only import WriteOnlyWorksheet

NAME, PROGRAM = "variants", "diecut-report"
SHEET_ROWS, SHEET_COLUMNS = 1_048_576, 16_384  # what a sheet of a workbook holds


def export(store: Store, formats: Sequence[str]) -> list[str]:
    """Write the variants stored so far as DIR/variants.csv or .xlsx, a row each; returns what is to be known of the files."""
    for name in formats:
        path = store.directory / f"{NAME}.{name}"
        with replaced(path) as temporary:
            WRITERS[name](store, temporary, path)
    notes: list[str] = []
    curves = ", ".join(column.name for column in store.description.columns if column.kind == "curve")
    if curves and formats:
        template = "{files}: without the curves {curves}, which only the Parquet files in {folder} hold."
        files = named([f"{NAME}.{name}" for name in formats], " and ")
        notes.append(Phrase(template, files=files, curves=curves, folder=store.directory / PARTS))
    if "xlsx" in formats and (count := store.counts()["variants"]) >= SHEET_ROWS:
        template = "{file}: {count} variants in {sheets} sheets, as a sheet holds {rows} rows."
        notes.append(Phrase(template, file=f"{NAME}.xlsx", count=count, sheets=_sheets(count), rows=SHEET_ROWS))
    return notes


def _sheets(count: int) -> int:
    return max(1, math.ceil(count / (SHEET_ROWS - 1)))


def _heads(store: Store) -> dict[str, str]:
    """Return the columns but for curves, and their names with units, `drive.crank_torque_peak [N*m]`, as tables of a study have them."""
    units = {column.name: column.unit for column in store.description.all_columns if column.kind != "curve"}
    return {name: name if unit == "1" else f"{name} [{unit}]" for name, unit in units.items()}


def _write_csv(store: Store, temporary: Path, _path: Path) -> None:
    """Write UTF-8; numbers in their shortest form that reads back the same, nothing for null."""
    import pyarrow as pa
    from pyarrow.csv import CSVWriter

    names = _heads(store)
    schema = pa.schema([store.schema.field(name).with_name(head) for name, head in names.items()])
    with temporary.open("wb") as file, CSVWriter(file, schema) as writer:
        for batch in store.batches(list(names)):
            writer.write_batch(pa.RecordBatch.from_arrays(batch.columns, schema=schema))


def _write_xlsx(store: Store, temporary: Path, path: Path) -> None:
    """Write as many sheets as the rows need, each with its heads, which stay in view."""
    names = _heads(store)
    if len(names) > SHEET_COLUMNS:
        template = "The results have {count} columns; a sheet holds {sheet_columns}. Use CSV."
        raise refusal(template, path, count=len(names), sheet_columns=SHEET_COLUMNS)
    batches = ([column.to_pylist() for column in batch.columns] for batch in store.batches(list(names)))
    rows = chain.from_iterable(zip(*columns, strict=True) for columns in batches)
    heads = tuple(names.values())
    numbers = range(1, _sheets(store.counts()["variants"]) + 1)
    sheets = ((f"{NAME} {number}", chain([heads], islice(rows, SHEET_ROWS - 1))) for number in numbers)
    with room(store.directory):  # openpyxl keeps each sheet in a temporary file
        _save(sheets, temporary)


def workbook(tables: Mapping[str, list[list[Any]]]) -> bytes:
    """Return tables as a workbook, each in a sheet of its name, with its first row and column in view."""
    content = BytesIO()
    _save(tables.items(), content)
    return content.getvalue()


def _save(sheets: Iterable[tuple[str, Iterable[Sequence[Any]]]], target: Path | BytesIO) -> None:
    from openpyxl import Workbook
    from openpyxl.writer.excel import ExcelWriter

    from diecut_report.report.office.workbook import UndatedArchive, closed, text_cell

    book = Workbook(write_only=True)
    book.properties.creator = PROGRAM
    with closed(book):
        for name, rows in sheets:
            sheet: WriteOnlyWorksheet = book.create_sheet(name)
            sheet.freeze_panes = "B2"
            for row in rows:
                sheet.append([text_cell(sheet, value) if isinstance(value, str) else value for value in row])
        ExcelWriter(book, UndatedArchive(target)).save()


WRITERS: dict[str, Callable[[Store, Path, Path], None]] = {"csv": _write_csv, "xlsx": _write_xlsx}
