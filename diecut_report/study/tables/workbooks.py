"""XLSX workbooks as headers and cells, judged before they are unpacked."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, BinaryIO
from xml.parsers import expat
from zipfile import ZipFile

from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.study.tables.cells import Cells
from diecut_report.study.tables.limits import (
    MAX_CELLS,
    OTHER_FORM,
    SMALLER,
    UnreadableTable,
    judge_size,
    judge_unpacked,
)

KIND = ".xlsx"
DAMAGED = phrase("is not an XLSX workbook, or a damaged one; save it again as .xlsx")
MAX_MEMBERS = 10_000
MAX_ELEMENTS = 4 * MAX_CELLS[KIND]  # a cell has up to three
MAX_OTHERS = 200_000  # that are no part of a cell or a text: styles, widths, merged cells
OF_CELLS = {"row", "c", "v", "f", "is", "si", "t", "r"}
MAX_ROWS = 1_048_576  # of a sheet
MAX_PLACES = 20 * MAX_CELLS[KIND]  # with the empty ones before the last cell of each row
ENCODINGS = {"", "utf-8", "us-ascii", "iso-8859-1"}  # in which "<" is the byte that it is in ASCII
UTF_16 = (b"\xff\xfe", b"\xfe\xff")
COMMENTS = ((b"<!--", b"-->"), (b"<?", b"?>"))
CHUNK = 1 << 20
LONG = phrase("holds a text of more than a million letters; a cell has some dozens. Save it again")
MANY = Phrase(
    "has more than {max_cells} cells, or as many other parts. {smaller}, or {other_form}",
    max_cells=format(MAX_CELLS[KIND], ","),
    smaller=SMALLER,
    other_form=OTHER_FORM,
)

Header = tuple[str, str | None]
Rows = list[list[Any]]


def read(file: BinaryIO, sheet: str | None) -> tuple[list[Header], list[Cells]]:
    """The headers and the cells of a sheet, the first one unless it is named."""
    import openpyxl

    with _damaged(), warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of styles and checks of cells that openpyxl leaves out
        _judge_archive(file)
        book = openpyxl.load_workbook(file, read_only=True, data_only=True, keep_links=False)
        try:
            rows = _rows(book, sheet)
        finally:
            book.close()
    return _from_rows(rows)


@contextmanager
def _damaged() -> Iterator[None]:
    """What goes wrong in a damaged file is any exception: of zipfile, zlib, expat or openpyxl, which trusts what it reads."""
    try:
        yield
    except (UnreadableTable, OSError):
        raise
    except MemoryError as error:
        raise UnreadableTable(Phrase("needs more memory than there is. {smaller}", smaller=SMALLER)) from error
    except Exception as error:
        raise UnreadableTable(DAMAGED) from error


# --- before it is unpacked ---------------------------------------------------------------------------------------------


def _judge_archive(file: BinaryIO) -> None:
    """Refuse what would unpack to too much, by the archive's directory, and by the elements of its members."""
    with ZipFile(file) as archive:
        members = archive.infolist()
        if len(members) > MAX_MEMBERS:
            raise UnreadableTable(
                Phrase("has {count} files within; a workbook has some dozens. Save it again", count=len(members))
            )
        judge_unpacked(KIND, sum(member.file_size for member in members))
        seen = _Seen()
        for member in members:
            with archive.open(member) as unpacked:
                _look(unpacked, seen)


@dataclass
class _Seen:
    """How many elements the members have so far; each takes memory, however short it is."""

    elements: int = 0
    others: int = 0

    def __call__(self, name: str, _attributes: Any) -> None:
        """Count one more; UnreadableTable where they are too many."""
        self.elements += 1
        self.others += name.rpartition(":")[2] not in OF_CELLS
        if self.elements > MAX_ELEMENTS or self.others > MAX_OTHERS:
            raise UnreadableTable(MANY)


def _look(unpacked: Any, seen: _Seen) -> None:
    """Look at a member: nothing in it declares entities or another encoding, and no text or comment is endless."""
    parser = expat.ParserCreate()
    parser.XmlDeclHandler, parser.StartDoctypeDeclHandler, parser.StartElementHandler = _declared, _refuse, seen
    begun, awaited = False, list[bytes]()
    while chunk := unpacked.read(CHUNK):
        if not begun and (b"\0" in chunk[:4] or chunk.startswith(UTF_16)):
            _refuse()
        if len(chunk) == CHUNK and (b"<" not in chunk or any(end not in chunk for end in awaited)):
            raise UnreadableTable(LONG)
        begun, awaited = True, [end for begin, end in COMMENTS if chunk.rfind(begin) > chunk.rfind(end)]
        try:
            parser.Parse(chunk, False)
        except expat.ExpatError:  # a picture, or what openpyxl will call damaged when it comes to it
            return


def _declared(_version: str, encoding: str | None, _standalone: int) -> None:
    if (encoding or "").lower() not in ENCODINGS:
        _refuse()


def _refuse(*_: Any) -> None:
    raise UnreadableTable(DAMAGED)


# --- rows --------------------------------------------------------------------------------------------------------------


def _rows(book: Any, sheet: str | None) -> Rows:
    if sheet is not None and sheet not in book.sheetnames:
        raise UnreadableTable(
            Phrase(
                "has no sheet “{sheet}”; its sheets: {sheetnames}", sheet=sheet, sheetnames=", ".join(book.sheetnames)
            )
        )
    worksheet = book[sheet] if sheet is not None else book.worksheets[0]
    worksheet.reset_dimensions()  # the stored size may be wrong
    return list(_bounded(worksheet.iter_rows(values_only=True)))


def _bounded(rows: Iterable[tuple[Any, ...]]) -> Iterator[list[Any]]:
    """The rows without the empty cells at their ends; UnreadableTable as soon as they are more than a table may have."""
    places = cells = 0
    for number, row in enumerate(rows, 1):
        kept = list(row)
        while kept and kept[-1] is None:
            kept.pop()
        places, cells = places + len(row), cells + len(kept)
        if number > MAX_ROWS or places > MAX_PLACES:
            raise _far(number)
        if cells > MAX_CELLS[KIND]:
            raise UnreadableTable(MANY)
        yield kept


def _from_rows(rows: Rows) -> tuple[list[Header], list[Cells]]:
    while rows and not rows[-1]:
        rows.pop()
    if not rows or not rows[0]:
        raise UnreadableTable([(phrase("row 1 is empty; it must hold the names of the columns"), 1)])
    width = max(len(row) for row in rows)
    blank = {place for place, row in enumerate(rows, 1) if width > 1 and not row}
    judge_size(KIND, len(rows) - len(blank), width)
    if len(rows) * width > MAX_PLACES:
        raise _far(len(rows))
    kept = [row + [None] * (width - len(row)) for place, row in enumerate(rows, 1) if place not in blank]
    headers: list[Header] = [("" if value is None else str(value), None) for value in kept[0]]
    columns = list(zip(*kept[1:], strict=True)) or [()] * width
    skipped = tuple(sorted(blank))
    return headers, [Cells(list(column), 2, skipped) for column in columns]


def _far(row: int) -> UnreadableTable:
    return UnreadableTable(Phrase("has a cell far from the others, in row {row}; delete what stands there", row=row))
