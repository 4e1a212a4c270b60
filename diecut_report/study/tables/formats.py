"""Parquet files as headers and cells, judged by their footer before they are unpacked."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, BinaryIO
from xml.parsers import expat
from zipfile import ZipFile

from diecut_report.study.tables.cells import (
    MAX_CELLS,
    MAX_COLUMNS,
    OTHER_FORM,
    SMALLER,
    Cells,
    UnreadableTable,
    judge_size,
    judge_unpacked,
)
from diecut_report.text.phrases import Phrase, phrase

KIND = ".parquet"
ROWS = 65_536  # read at a time
FOOTER = 10_000_000  # bytes of a text in the footer, which tells the columns

Header = tuple[str, str | None]


def read(file: BinaryIO) -> tuple[list[Header], list[Cells]]:
    """The headers, with the units that stand beside them, and the cells of all columns."""
    import pyarrow

    try:
        table = _table(file)
        units = [((field.metadata or {}).get(b"unit") or b"").decode() or None for field in table.schema]
        columns = [Cells(column, 1) for column in table.columns]  # their pieces as they are: one piece would be a copy
    except pyarrow.ArrowMemoryError as error:
        raise UnreadableTable(Phrase("needs more memory than there is. {smaller}", smaller=SMALLER)) from error
    except (pyarrow.ArrowException, OSError, ValueError, OverflowError) as error:  # Parquet says OSError of damage too
        if getattr(error, "errno", None):
            raise
        told = " ".join(str(error).split())
        raise UnreadableTable(Phrase("is not a Parquet file, or a damaged one: {told}", told=told)) from error
    return list(zip(table.column_names, units, strict=True)), columns


def _table(file: BinaryIO) -> Any:
    """The table, its texts whole, read a piece at a time and no further than is bearable."""
    import pyarrow
    from pyarrow import parquet

    limits = {"thrift_string_size_limit": FOOTER, "thrift_container_size_limit": 4 * MAX_COLUMNS}
    metadata = parquet.ParquetFile(file, **limits).metadata
    _judge(metadata)
    schema = metadata.schema.to_arrow_schema()
    _refuse_kinds(schema)
    # texts that repeat stay one text each until their whole size is known
    texts = [field.name for field in schema if _is_text(_plain_type(field.type))]
    source = parquet.ParquetFile(file, read_dictionary=texts, page_checksum_verification=True, **limits)
    plain = pyarrow.schema([pyarrow.field(f.name, _plain_type(f.type), metadata=f.metadata) for f in schema])
    pieces, size = [], 0
    for batch in source.iter_batches(ROWS):
        size += sum(_size(column) for column in batch.columns)
        judge_unpacked(KIND, size)
        whole = [_decoded(column).cast(field.type) for column, field in zip(batch.columns, plain, strict=True)]
        pieces.append(pyarrow.RecordBatch.from_arrays(whole, schema=plain))
    return pyarrow.Table.from_batches(pieces, plain)


def _judge(metadata: Any) -> None:
    judge_size(KIND, metadata.num_rows, metadata.num_columns)
    groups = [metadata.row_group(number) for number in range(metadata.num_row_groups)]
    judge_unpacked(KIND, sum(max(group.total_byte_size, 0) for group in groups))


def _refuse_kinds(schema: Any) -> None:
    wrong = [field for field in schema if not _is_plain(field.type)]
    if wrong:
        words = "column {name} holds {type}; numbers or texts are needed"
        raise UnreadableTable((Phrase(words, name=field.name, type=field.type), None) for field in wrong)


def _is_plain(kind: Any) -> bool:
    from pyarrow import types

    kind = _plain_type(kind)
    return _is_text(kind) or types.is_integer(kind) or types.is_floating(kind) or types.is_decimal(kind)


def _is_text(kind: Any) -> bool:
    from pyarrow import types

    return bool(types.is_string(kind) or types.is_large_string(kind))


def _plain_type(kind: Any) -> Any:
    from pyarrow import types

    return kind.value_type if types.is_dictionary(kind) else kind


def _size(column: Any) -> int:
    """How many bytes a column takes with its texts whole."""
    from pyarrow import compute, types

    if not types.is_dictionary(column.type):
        return int(column.nbytes)
    if not _is_text(column.type.value_type):
        return len(column) * 8
    lengths = compute.binary_length(column.dictionary)
    return int(compute.sum(lengths.take(column.indices)).as_py() or 0) + 4 * len(column)


def _decoded(column: Any) -> Any:
    from pyarrow import types

    return column.dictionary_decode() if types.is_dictionary(column.type) else column


# XLSX workbooks as headers and cells, judged before they are unpacked.


WORKBOOKS_KIND = ".xlsx"
DAMAGED = phrase("is not an XLSX workbook, or a damaged one; save it again as .xlsx")
MAX_MEMBERS = 10_000
MAX_ELEMENTS = 4 * MAX_CELLS[WORKBOOKS_KIND]  # a cell has up to three
MAX_OTHERS = 200_000  # that are no part of a cell or a text: styles, widths, merged cells
OF_CELLS = {"row", "c", "v", "f", "is", "si", "t", "r"}
MAX_ROWS = 1_048_576  # of a sheet
MAX_PLACES = 20 * MAX_CELLS[WORKBOOKS_KIND]  # with the empty ones before the last cell of each row
ENCODINGS = {"", "utf-8", "us-ascii", "iso-8859-1"}  # in which "<" is the byte that it is in ASCII
UTF_16 = (b"\xff\xfe", b"\xfe\xff")
COMMENTS = ((b"<!--", b"-->"), (b"<?", b"?>"))
CHUNK = 1 << 20
LONG = phrase("holds a text of more than a million letters; a cell has some dozens. Save it again")
MANY = Phrase(
    "has more than {max_cells} cells, or as many other parts. {smaller}, or {other_form}",
    max_cells=format(MAX_CELLS[WORKBOOKS_KIND], ","),
    smaller=SMALLER,
    other_form=OTHER_FORM,
)

Rows = list[list[Any]]


def workbooks_read(file: BinaryIO, sheet: str | None) -> tuple[list[Header], list[Cells]]:
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
        judge_unpacked(WORKBOOKS_KIND, sum(member.file_size for member in members))
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
        if cells > MAX_CELLS[WORKBOOKS_KIND]:
            raise UnreadableTable(MANY)
        yield kept


def _from_rows(rows: Rows) -> tuple[list[Header], list[Cells]]:
    while rows and not rows[-1]:
        rows.pop()
    if not rows or not rows[0]:
        raise UnreadableTable([(phrase("row 1 is empty; it must hold the names of the columns"), 1)])
    width = max(len(row) for row in rows)
    blank = {place for place, row in enumerate(rows, 1) if width > 1 and not row}
    judge_size(WORKBOOKS_KIND, len(rows) - len(blank), width)
    if len(rows) * width > MAX_PLACES:
        raise _far(len(rows))
    kept = [row + [None] * (width - len(row)) for place, row in enumerate(rows, 1) if place not in blank]
    headers: list[Header] = [("" if value is None else str(value), None) for value in kept[0]]
    columns = list(zip(*kept[1:], strict=True)) or [()] * width
    skipped = tuple(sorted(blank))
    return headers, [Cells(list(column), 2, skipped) for column in columns]


def _far(row: int) -> UnreadableTable:
    return UnreadableTable(Phrase("has a cell far from the others, in row {row}; delete what stands there", row=row))
