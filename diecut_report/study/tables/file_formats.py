"""Files of tables (CSV, Parquet, XLSX) as headers and cells. The libraries are imported where they are needed."""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from diecut_report.study.tables.cells import Cells

DELIMITERS = ",;\t"
NO_ROWS = "the table has no rows below its header; give at least one"

Header = tuple[str, str | None]
"""What heads a column, and the unit that the file stores beside it."""
Read = tuple[list[Header], list[Cells]]


class UnreadableTable(Exception):
    """Report a file that is not a table, in words, each with the row where it is known."""

    def __init__(self, faults: str | Iterable[tuple[str, int | None]]) -> None:
        self.faults = [(faults, None)] if isinstance(faults, str) else list(faults)
        super().__init__(self.faults)


def read_cells(path: Path, sheet: str | None) -> Read:
    """Return the headers and the cells of all columns of a file."""
    readers: dict[str, Callable[[], Read]] = {
        ".csv": lambda: _csv(path),
        ".parquet": lambda: _parquet(path),
        ".xlsx": lambda: _xlsx(path, sheet),
    }
    reader = readers.get(path.suffix.lower())
    if reader is None:
        raise UnreadableTable(
            f"the ending {path.suffix or '(none)'} is not known; save the table as {', '.join(readers)}"
        )
    if sheet is not None and path.suffix.lower() != ".xlsx":
        raise UnreadableTable("sheet is given, but only a workbook (.xlsx) has sheets; remove it")
    try:
        return reader()
    except OSError as error:
        raise UnreadableTable(f"cannot be read: {error.strerror or error}") from error


# --- CSV -------------------------------------------------------------------------------------------------------------


def _csv(path: Path) -> Read:
    import pyarrow
    from pyarrow import csv as arrow_csv

    names, delimiter = _csv_header(path)
    faults: list[tuple[str, int | None]] = []

    def invalid(row: Any) -> str:
        told = f"row {row.number} has {row.actual_columns} cells, the header {row.expected_columns}; fill up or quote"
        faults.append((told, row.number))
        return "skip"

    try:
        table = arrow_csv.read_csv(
            path,
            arrow_csv.ReadOptions(use_threads=False, skip_rows=1, column_names=[str(i) for i in range(len(names))]),
            arrow_csv.ParseOptions(delimiter=delimiter, ignore_empty_lines=False, invalid_row_handler=invalid),
            arrow_csv.ConvertOptions(column_types={str(i): pyarrow.string() for i in range(len(names))}),
        )
    except pyarrow.ArrowInvalid as error:
        raise UnreadableTable(_csv_fault(str(error))) from error
    if faults:
        raise UnreadableTable(faults)
    kept, blank = _without_blank_rows(table)
    return [(name, None) for name in names], [Cells(column, 2, blank) for column in kept.columns]


def _csv_header(path: Path) -> tuple[list[str], str]:
    """The cells of the first row, and what separates them: the comma, or what the first row has more of."""
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            first = file.readline().rstrip("\r\n")
    except UnicodeDecodeError as error:
        raise UnreadableTable("is not in UTF-8; save it as “CSV UTF-8”") from error
    if not first.strip():
        raise UnreadableTable([("row 1 is empty; it must hold the names of the columns", 1)])
    delimiter = max(DELIMITERS, key=first.count)
    return next(csv.reader([first], delimiter=delimiter)), delimiter


def _csv_fault(message: str) -> str:
    if "UTF8" in message:
        return "is not in UTF-8; save it as “CSV UTF-8”"
    return NO_ROWS if "Empty" in message or "Could not skip" in message else f"is not a CSV file: {message}"


def _without_blank_rows(table: Any) -> tuple[Any, tuple[int, ...]]:
    """The table without rows that hold nothing, and their rows in the file; in a single column only those at its end."""
    import numpy as np
    from pyarrow import compute

    empty = (compute.equal(compute.utf8_trim_whitespace(column), "").to_numpy() for column in table.columns)
    blank = np.logical_and.reduce([np.asarray(column, dtype=bool) for column in empty])
    if table.num_columns == 1:
        blank[: np.max(np.flatnonzero(~blank), initial=-1) + 1] = False
    return table.filter(~blank), tuple((np.flatnonzero(blank) + 2).tolist())


# --- Parquet ---------------------------------------------------------------------------------------------------------


def _parquet(path: Path) -> Read:
    import pyarrow
    from pyarrow import parquet

    try:
        with path.open("rb") as file:
            table = parquet.ParquetFile(file).read()
    except pyarrow.ArrowException as error:
        raise UnreadableTable(f"is not a Parquet file, or a damaged one: {error}") from error
    wrong = [field for field in table.schema if not _is_plain(field.type)]
    if wrong:
        words = "column {0.name} holds {0.type}; numbers or texts are needed"
        raise UnreadableTable((words.format(field), None) for field in wrong)
    units = [((field.metadata or {}).get(b"unit") or b"").decode() or None for field in table.schema]
    columns = (column.combine_chunks() for column in table.columns)
    return list(zip(table.column_names, units, strict=True)), [Cells(_decoded(column), 1) for column in columns]


def _is_plain(kind: Any) -> bool:
    from pyarrow import types

    kind = kind.value_type if types.is_dictionary(kind) else kind
    tests = (types.is_integer, types.is_floating, types.is_decimal, types.is_string, types.is_large_string)
    return any(test(kind) for test in tests)


def _decoded(column: Any) -> Any:
    from pyarrow import types

    return column.dictionary_decode() if types.is_dictionary(column.type) else column


# --- XLSX ------------------------------------------------------------------------------------------------------------


def _xlsx(path: Path, sheet: str | None) -> Read:
    from zipfile import BadZipFile

    import openpyxl

    try:
        book = openpyxl.load_workbook(path, read_only=True, data_only=True)
    except (BadZipFile, KeyError, ValueError) as error:
        raise UnreadableTable("is not an XLSX workbook, or a damaged one; save it again as .xlsx") from error
    try:
        if sheet is not None and sheet not in book.sheetnames:
            raise UnreadableTable(f"has no sheet “{sheet}”; its sheets: {', '.join(book.sheetnames)}")
        worksheet = book[sheet] if sheet is not None else book.worksheets[0]
        worksheet.reset_dimensions()  # the stored size may be wrong
        rows = [list(row) for row in worksheet.iter_rows(values_only=True)]
    finally:
        book.close()
    return _from_rows(rows)


def _from_rows(rows: list[list[Any]]) -> Read:
    while rows and all(value is None for value in rows[-1]):
        rows.pop()
    if not rows or all(value is None for value in rows[0]):
        raise UnreadableTable([("row 1 is empty; it must hold the names of the columns", 1)])
    width = max(max((i + 1 for i, value in enumerate(row) if value is not None), default=0) for row in rows)
    full = [(row + [None] * width)[:width] for row in rows]
    headers: list[Header] = [("" if value is None else str(value), None) for value in full[0]]
    blank = tuple(place for place, row in enumerate(full, 1) if width > 1 and all(value is None for value in row))
    left_out = set(blank)
    kept = [row for place, row in enumerate(full, 1) if place not in left_out]
    columns = list(zip(*kept[1:], strict=True)) or [()] * width
    return headers, [Cells(list(column), 2, blank) for column in columns]
