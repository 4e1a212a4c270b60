"""Files of tables (CSV, Parquet, XLSX) as headers and cells. The libraries are imported where they are needed."""

from __future__ import annotations

import codecs
import csv
import hashlib
import re
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

from diecut_report.given_files import opened
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.study.tables import parquet_files, workbooks
from diecut_report.study.tables.cells import Cells
from diecut_report.study.tables.limits import MAX_BYTES, MAX_COLUMNS, UnreadableTable, judge_size

DELIMITERS = ",;\t"
NO_ROWS = phrase("the table has no rows below its header; give at least one")
NOT_UTF8 = phrase("is not in UTF-8; save it as “CSV UTF-8”")
LINE = 1_000_000  # bytes of a row at most
KEPT = 100  # rows of another length that are told one by one
CHUNK = 1 << 20

Header = tuple[str, str | None]
"""What heads a column, and the unit that the file stores beside it."""


class Read(NamedTuple):
    """Hold what a file gives: its columns' headers and cells, and the SHA-256 of the very bytes that were read."""

    headers: list[Header]
    cells: list[Cells]
    sha256: str


def read_cells(path: Path, sheet: str | None) -> Read:
    """Return the headers and the cells of all columns of a file.

    UnreadableTable in words for what is not a table or too large a one, UserError for what is no regular file or too large a one.
    """
    kind = path.suffix.lower()
    if kind not in MAX_BYTES:
        known = ", ".join(MAX_BYTES)
        raise UnreadableTable(
            Phrase(
                "the ending {suffix} is not known; save the table as {known}",
                suffix=path.suffix or phrase("(none)"),
                known=known,
            )
        )
    if sheet is not None and kind != ".xlsx":
        raise UnreadableTable(phrase("sheet is given, but only a workbook (.xlsx) has sheets; remove it"))
    with opened(path, MAX_BYTES[kind], Phrase("a table ({kind})", kind=kind)) as file:
        try:
            digest = hashlib.file_digest(file, "sha256").hexdigest()
            file.seek(0)
            return Read(*_read(kind, file, sheet), digest)
        except OSError as error:
            raise UnreadableTable(Phrase("cannot be read: {strerror}", strerror=error.strerror or error)) from error


def _read(kind: str, file: BinaryIO, sheet: str | None) -> tuple[list[Header], list[Cells]]:
    if kind == ".xlsx":
        return workbooks.read(file, sheet)
    return parquet_files.read(file) if kind == ".parquet" else _csv(file)


def _csv(file: BinaryIO) -> tuple[list[Header], list[Cells]]:
    import pyarrow
    from pyarrow import csv as arrow_csv

    names, delimiter = _csv_header(file)
    judge_size(".csv", _lines(file), len(names))
    other = _OtherRows()
    try:
        table = arrow_csv.read_csv(
            file,
            arrow_csv.ReadOptions(use_threads=False, skip_rows=1, column_names=[str(i) for i in range(len(names))]),
            arrow_csv.ParseOptions(delimiter=delimiter, ignore_empty_lines=False, invalid_row_handler=other),
            arrow_csv.ConvertOptions(column_types={str(i): pyarrow.string() for i in range(len(names))}),
        )
    except pyarrow.ArrowMemoryError as error:
        raise UnreadableTable(phrase("needs more memory than there is. Give fewer rows or columns")) from error
    except pyarrow.ArrowException as error:
        raise UnreadableTable(_csv_fault(str(error))) from error
    other.refuse()
    kept, blank = _without_blank_rows(table)
    return [(name, None) for name in names], [Cells(column, 2, blank) for column in kept.columns]


class _OtherRows:
    """Gathers the rows that have not as many cells as the header, as many of them as are told one by one."""

    def __init__(self) -> None:
        self.faults: list[tuple[str, int | None]] = []
        self.more = 0

    def __call__(self, row: Any) -> str:
        """Note a row; Arrow leaves it out."""
        words = Phrase(
            "row {number} has {actual_columns} cells, the header {expected_columns}; fill up or quote",
            number=row.number,
            actual_columns=row.actual_columns,
            expected_columns=row.expected_columns,
        )
        if len(self.faults) < KEPT:
            self.faults.append((words, row.number))
        else:
            self.more += 1
        return "skip"

    def refuse(self) -> None:
        """UnreadableTable where there are any."""
        if self.faults:
            told = (
                [(Phrase("{more} more rows have not as many cells as the header", more=self.more), None)]
                if self.more
                else []
            )
            raise UnreadableTable([*self.faults, *told])


def _csv_header(file: BinaryIO) -> tuple[list[str], str]:
    """The cells of the first row, and what separates them: the comma, or what the first row has more of."""
    line = re.split(rb"[\r\n]", file.readline(LINE), maxsplit=1)[0]
    if len(line) == LINE:
        raise UnreadableTable([(phrase("row 1 is too long; it must hold the names of the columns"), 1)])
    try:
        first = line.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise UnreadableTable(NOT_UTF8) from error
    if not first.strip():
        raise UnreadableTable([(phrase("row 1 is empty; it must hold the names of the columns"), 1)])
    delimiter = max(DELIMITERS, key=first.count)
    if first.count(delimiter) >= 2 * MAX_COLUMNS:  # before it is parted; some may stand in quotes
        judge_size(".csv", 0, first.count(delimiter) + 1)
    try:
        return next(csv.reader([first], delimiter=delimiter)), delimiter
    except csv.Error as error:
        raise UnreadableTable(
            [(Phrase("row 1 cannot be read: {error}; it must hold the names of the columns", error=error), 1)]
        ) from error


def _lines(file: BinaryIO) -> int:
    """How many rows there may be; the file stands at its beginning again. UnreadableTable where it is no text, or a quotation is open."""
    file.seek(0)
    feeds = returns = quotes = 0
    decoder = codecs.getincrementaldecoder("utf-8")()
    try:
        while chunk := file.read(CHUNK):
            decoder.decode(chunk)  # Arrow prints a traceback for a row of another length that is not in UTF-8
            feeds, returns = feeds + chunk.count(b"\n"), returns + chunk.count(b"\r")
            quotes += chunk.count(b'"')
        decoder.decode(b"", final=True)
    except UnicodeDecodeError as error:
        raise UnreadableTable(NOT_UTF8) from error
    if quotes % 2:  # Arrow takes what follows the last one, whatever it is, for one cell
        raise UnreadableTable(
            Phrase(
                "has {quotes} quotation marks, so that one is not closed; within a quoted cell it is doubled",
                quotes=quotes,
            )
        )
    file.seek(0)
    return max(feeds, returns)


def _csv_fault(message: str) -> str:
    if "straddling" in message or "out of sync" in message:
        return phrase(
            "has a row that ends in another line, or is longer than 1 MB; look for a quotation mark that is not closed"
        )
    return (
        NO_ROWS
        if "Empty" in message or "Could not skip" in message
        else Phrase("is not a CSV file: {message}", message=message)
    )


def _without_blank_rows(table: Any) -> tuple[Any, tuple[int, ...]]:
    """The table without rows that hold nothing, and their rows in the file; in a single column only those at its end."""
    import numpy as np
    from pyarrow import compute

    empty = (compute.equal(compute.utf8_trim_whitespace(column), "").to_numpy() for column in table.columns)
    blank = np.logical_and.reduce([np.asarray(column, dtype=bool) for column in empty])
    if table.num_columns == 1:
        blank[: np.max(np.flatnonzero(~blank), initial=-1) + 1] = False
    return table.filter(~blank), tuple((np.flatnonzero(blank) + 2).tolist())
