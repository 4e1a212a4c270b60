"""Files of tables (CSV, Parquet, XLSX) as headers and cells, none unpacked to more than is bearable.

The libraries are imported where they are needed. What is wrong is a UserError that does not yet name the file.
"""

from __future__ import annotations

import codecs
import csv
import re
import warnings
from bisect import bisect_right
from collections.abc import Iterable, Iterator
from contextlib import closing
from dataclasses import dataclass
from typing import Any, BinaryIO
from xml.parsers import expat
from zipfile import ZipFile

import numpy as np

from diecut_report.errors import Problem, UserError, refusal
from diecut_report.formulas import Array
from diecut_report.text.phrases import Phrase, joined, phrase

MAX_BYTES = {".csv": 200_000_000, ".parquet": 200_000_000, ".xlsx": 25_000_000}
MAX_UNPACKED = {".parquet": 500_000_000, ".xlsx": 100_000_000}  # what the packed file holds, in bytes
MAX_CELLS = {".csv": 10_000_000, ".parquet": 10_000_000, ".xlsx": 500_000}
MAX_COLUMNS = 16_384  # as many as a sheet of a workbook holds
CHUNK = 1 << 20  # bytes that are looked at together
SLICE = 65_536  # cells that are Python values at a time
SMALLER = phrase("Give fewer rows or columns")
OTHER_FORM = phrase("save the table as CSV or Parquet, which may be larger")
ADVICE = {".csv": SMALLER, ".parquet": SMALLER, ".xlsx": joined((SMALLER, OTHER_FORM), ", or ")}
NO_MEMORY = Phrase("needs more memory than there is. {smaller}", smaller=SMALLER)
NO_ROWS = phrase("the table has no rows below its header; give at least one")
NO_HEADER = phrase("row 1 is empty; it must hold the names of the columns")


@dataclass(frozen=True, eq=False)
class Cells:
    """Hold the cells of a column as a file holds them: an Arrow array of numbers or texts, or a list of Python values.

    `first` is the file's row of the first cell; `skipped` are rows of the file without cells, ascending.
    """

    raw: Any
    first: int = 2
    skipped: tuple[int, ...] = ()

    def __len__(self) -> int:
        return len(self.raw)

    def row(self, place: int) -> int:
        """Return the row of the file, counted from 1, in which a cell stands."""
        behind = [skipped - count for count, skipped in enumerate(self.skipped)]
        return place + self.first + bisect_right(behind, place + self.first)

    def floats(self) -> Array | None:
        """Return the cells as floats, NaN where a number is missing; None unless all are plain numbers."""
        import pyarrow
        from pyarrow import compute, types

        if isinstance(self.raw, list):
            plain = all(isinstance(value, int | float) and not isinstance(value, bool) for value in self.raw)
            return np.array(self.raw, dtype=float) if plain else None
        is_text = types.is_string(self.raw.type) or types.is_large_string(self.raw.type)
        found = np.empty(len(self.raw))
        for start in range(0, len(self.raw), SLICE):  # all at once would be a second copy of all texts
            part = self.raw.slice(start, SLICE)
            part = compute.utf8_trim_whitespace(part) if is_text else part
            try:
                found[start : start + SLICE] = compute.cast(part, pyarrow.float64(), safe=False).to_numpy()
            except pyarrow.ArrowInvalid:  # a text that is not a plain number: the cells are read one by one
                return None
        return found

    def items(self) -> Iterator[Any]:
        """Yield the cells as Python values, some of them at a time; None where there is nothing."""
        if isinstance(self.raw, list):
            yield from self.raw
            return
        for start in range(0, len(self.raw), SLICE):
            yield from self.raw.slice(start, SLICE).to_pylist()

    def texts(self) -> list[str]:
        """Return the cells as texts without blanks around them, "" where there is nothing; whole numbers without a point."""
        once: dict[str, str] = {}  # a text that repeats is kept once
        return [once.setdefault(text, text) for text in map(_text, self.items())]


def _text(value: Any) -> str:
    if isinstance(value, float) and value.is_integer():
        return f"{int(value)}"
    return "" if value is None else str(value).strip()


Columns = tuple[list[tuple[str, str | None]], list[Cells]]
"""What heads each column, with the unit that the file stores beside it, and its cells."""


def check_size(kind: str, rows: int, columns: int) -> None:
    """Refuse a table of more cells than a file of this type may have."""
    if columns > MAX_COLUMNS:
        template = "has {columns} columns; at most {max_columns} are allowed. {smaller}"
        raise refusal(template, columns=columns, max_columns=MAX_COLUMNS, smaller=SMALLER)
    if rows * columns > MAX_CELLS[kind]:
        most = Phrase("at most {max_cells} cells are allowed", max_cells=f"{MAX_CELLS[kind]:,}")
        template = "has {rows} rows × {columns} columns; {most}. {advice}"
        counts = {"rows": f"{rows:,}", "columns": f"{columns:,}"}
        raise refusal(template, **counts, most=most, advice=ADVICE[kind])


def check_unpacked(kind: str, size: int) -> None:
    """Refuse a file whose content, unpacked, takes more bytes than is bearable."""
    if size > MAX_UNPACKED[kind]:
        most = Phrase("at most {max_unpacked} MB are allowed", max_unpacked=f"{MAX_UNPACKED[kind] / 1e6:g}")
        template = "holds {size} MB when it is unpacked; {most}. {advice}"
        raise refusal(template, size=f"{size / 1e6:.1f}", most=most, advice=ADVICE[kind])


# --- CSV ---------------------------------------------------------------------------------------------------------------

DELIMITERS = ",;\t"
NOT_UTF8 = phrase("is not in UTF-8; save it as “CSV UTF-8”")
MAX_LINE = 1_000_000  # bytes of a row
MAX_REPORTED = 100  # rows of another length that are reported one by one


def read_csv(file: BinaryIO) -> Columns:
    """Return the headers and the cells of all columns of a CSV file."""
    import pyarrow
    from pyarrow import csv as arrow_csv

    names, delimiter = _csv_header(file)
    check_size(".csv", _csv_rows(file), len(names))
    wrong: list[Problem] = []
    others = 0

    def skip(row: Any) -> str:
        nonlocal others
        template = "row {number} has {actual_columns} cells, the header {expected_columns}; fill up or quote"
        counts = {"actual_columns": row.actual_columns, "expected_columns": row.expected_columns}
        if len(wrong) < MAX_REPORTED:
            wrong.append(Problem(Phrase(template, counts, number=row.number), line=row.number))
        else:
            others += 1
        return "skip"

    try:
        table = arrow_csv.read_csv(
            file,
            arrow_csv.ReadOptions(use_threads=False, skip_rows=1, column_names=[str(i) for i in range(len(names))]),
            arrow_csv.ParseOptions(delimiter=delimiter, ignore_empty_lines=False, invalid_row_handler=skip),
            arrow_csv.ConvertOptions(column_types={str(i): pyarrow.string() for i in range(len(names))}),
        )
    except pyarrow.ArrowMemoryError as error:
        raise refusal(NO_MEMORY) from error
    except pyarrow.ArrowException as error:
        raise refusal(_csv_fault(str(error))) from error
    if wrong:
        template = "{more} more rows have not as many cells as the header"
        raise UserError([*wrong, *([Problem(Phrase(template, more=others))] if others else [])])
    blank = _blank_rows(table)
    rows = tuple((np.flatnonzero(blank) + 2).tolist())
    return [(name, None) for name in names], [Cells(column, 2, rows) for column in table.filter(~blank).columns]


def _csv_header(file: BinaryIO) -> tuple[list[str], str]:
    """Return the cells of the first row, and what separates them: the comma, or what the first row has more of."""
    line = re.split(rb"[\r\n]", file.readline(MAX_LINE), maxsplit=1)[0]
    if len(line) == MAX_LINE:
        raise UserError(Problem(phrase("row 1 is too long; it must hold the names of the columns"), line=1))
    try:
        first = line.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise refusal(NOT_UTF8) from error
    if not first.strip():
        raise UserError(Problem(NO_HEADER, line=1))
    delimiter = max(DELIMITERS, key=first.count)
    if first.count(delimiter) >= 2 * MAX_COLUMNS:  # before it is parted; some may stand in quotes
        check_size(".csv", 0, first.count(delimiter) + 1)
    try:
        return next(csv.reader([first], delimiter=delimiter)), delimiter
    except csv.Error as error:
        template = "row 1 cannot be read: {error}; it must hold the names of the columns"
        raise UserError(Problem(Phrase(template, error=error), line=1)) from error


def _csv_rows(file: BinaryIO) -> int:
    """Return how many rows there may be; the file stands at its beginning again. UserError where it is no text, or a quotation is open."""
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
        raise refusal(NOT_UTF8) from error
    if quotes % 2:  # Arrow takes what follows the last one, whatever it is, for one cell
        template = "has {quotes} quotation marks, so that one is not closed; within a quoted cell it is doubled"
        raise refusal(template, quotes=quotes)
    file.seek(0)
    return max(feeds, returns)


def _csv_fault(message: str) -> str:
    if "straddling" in message or "out of sync" in message:
        template = (
            "has a row that ends in another line, or is longer than 1 MB; look for a quotation mark that is not closed"
        )
        return phrase(template)
    is_empty = "Empty" in message or "Could not skip" in message
    return NO_ROWS if is_empty else Phrase("is not a CSV file: {message}", message=message)


def _blank_rows(table: Any) -> Any:
    from pyarrow import compute

    empty = (compute.equal(compute.utf8_trim_whitespace(column), "").to_numpy() for column in table.columns)
    blank = np.logical_and.reduce([np.asarray(column, dtype=bool) for column in empty])
    if table.num_columns == 1:
        blank[: np.max(np.flatnonzero(~blank), initial=-1) + 1] = False
    return blank


# --- Parquet -----------------------------------------------------------------------------------------------------------

ROWS = 65_536  # read at a time
MAX_FOOTER_TEXT = 10_000_000  # bytes of a text in the footer, which describes the columns


def read_parquet(file: BinaryIO) -> Columns:
    """Return the headers and the cells of all columns of a Parquet file, judged by its footer before it is unpacked."""
    import pyarrow

    try:
        table = _parquet_table(file)
        units = [((field.metadata or {}).get(b"unit") or b"").decode() or None for field in table.schema]
    except pyarrow.ArrowMemoryError as error:
        raise refusal(NO_MEMORY) from error
    except (pyarrow.ArrowException, OSError, ValueError, OverflowError) as error:  # Parquet says OSError of damage too
        if getattr(error, "errno", None):
            raise
        raise refusal("is not a Parquet file, or a damaged one: {told}", told=" ".join(str(error).split())) from error
    # their pieces as they are: one piece would be a copy
    return list(zip(table.column_names, units, strict=True)), [Cells(column, 1) for column in table.columns]


def _parquet_table(file: BinaryIO) -> Any:
    """Return the table, its texts whole, read a piece at a time and no further than is bearable."""
    import pyarrow
    from pyarrow import parquet

    limits = {"thrift_string_size_limit": MAX_FOOTER_TEXT, "thrift_container_size_limit": 4 * MAX_COLUMNS}
    metadata = parquet.ParquetFile(file, **limits).metadata
    check_size(".parquet", metadata.num_rows, metadata.num_columns)
    groups = [metadata.row_group(number) for number in range(metadata.num_row_groups)]
    check_unpacked(".parquet", sum(max(group.total_byte_size, 0) for group in groups))
    plain, texts = _plain_schema(metadata.schema.to_arrow_schema())
    # texts that repeat stay one text each until their whole size is known
    source = parquet.ParquetFile(file, read_dictionary=texts, page_checksum_verification=True, **limits)
    pieces, size = [], 0
    for batch in source.iter_batches(ROWS):
        size += sum(_whole_size(column) for column in batch.columns)
        check_unpacked(".parquet", size)
        columns = [column.cast(field.type) for column, field in zip(batch.columns, plain, strict=True)]
        pieces.append(pyarrow.RecordBatch.from_arrays(columns, schema=plain))
    return pyarrow.Table.from_batches(pieces, plain)


def _plain_schema(schema: Any) -> tuple[Any, list[str]]:
    """Return the columns without dictionaries, and which of them are texts; UserError where one is neither numbers nor texts."""
    import pyarrow
    from pyarrow import types

    kinds = [field.type.value_type if types.is_dictionary(field.type) else field.type for field in schema]
    plain = pyarrow.schema([field.with_type(kind) for field, kind in zip(schema, kinds, strict=True)])
    texts = [field.name for field in plain if types.is_string(field.type) or types.is_large_string(field.type)]
    is_number = (types.is_integer, types.is_floating, types.is_decimal)
    template = "column {name} holds {type}; numbers or texts are needed"
    wrong = [
        Problem(Phrase(template, name=field.name, type=field.type))
        for field in plain
        if field.name not in texts and not any(holds(field.type) for holds in is_number)
    ]
    if wrong:
        raise UserError(wrong)
    return plain, texts


def _whole_size(column: Any) -> int:
    """Return how many bytes a column takes with its texts whole."""
    from pyarrow import compute, types

    if not types.is_dictionary(column.type):
        return int(column.nbytes)
    if not (types.is_string(column.type.value_type) or types.is_large_string(column.type.value_type)):
        return len(column) * 8
    lengths = compute.binary_length(column.dictionary)
    return int(compute.sum(lengths.take(column.indices)).as_py() or 0) + 4 * len(column)


# --- XLSX --------------------------------------------------------------------------------------------------------------

DAMAGED = phrase("is not an XLSX workbook, or a damaged one; save it again as .xlsx")
MAX_MEMBERS = 10_000
MAX_ELEMENTS = 4 * MAX_CELLS[".xlsx"]  # a cell has up to three
MAX_OTHER_ELEMENTS = 200_000  # that are no part of a cell or a text: styles, widths, merged cells
CELL_ELEMENTS = {"row", "c", "v", "f", "is", "si", "t", "r"}
MAX_ROWS = 1_048_576  # of a sheet
MAX_PLACES = 20 * MAX_CELLS[".xlsx"]  # with the empty ones before the last cell of each row
ENCODINGS = {"", "utf-8", "us-ascii", "iso-8859-1"}  # in which "<" is the byte that it is in ASCII
LITERAL = re.compile(r'"([^"]*)"|\\(.)|\[\$([^\]-]*)[^\]]*\]')  # text within a number format
CHANGING = re.compile(r"[0#?],+(?![0#?])|\[[<>=]")  # shows a number in thousands, or by what it is
SIGNS = re.compile("[°‰′″µΩ]")  # units that stand in a format without quotation marks
UTF_16 = (b"\xff\xfe", b"\xfe\xff")
COMMENTS = ((b"<!--", b"-->"), (b"<?", b"?>"))
LONG = phrase("holds a text of more than a million letters; a cell has some dozens. Save it again")
MANY = Phrase(
    "has more than {max_cells} cells, or as many other parts. {smaller}, or {other_form}",
    max_cells=f"{MAX_CELLS['.xlsx']:,}",
    smaller=SMALLER,
    other_form=OTHER_FORM,
)


def read_xlsx(file: BinaryIO) -> Columns:
    """Return the headers and the cells of the first sheet of a workbook, which is judged before it is unpacked."""
    import openpyxl

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of styles and checks of cells that openpyxl leaves out
            _check_archive(file)
            with closing(openpyxl.load_workbook(file, read_only=True, data_only=True, keep_links=False)) as book:
                sheet = book.worksheets[0]
                sheet.reset_dimensions()  # the stored size may be wrong
                return _columns(list(_bounded(tuple(map(_shown, row)) for row in sheet.iter_rows())))
    except (UserError, OSError):
        raise
    except MemoryError as error:
        raise refusal(NO_MEMORY) from error
    except Exception as error:  # of zipfile, zlib, expat or openpyxl, which trusts what it reads
        raise refusal(DAMAGED) from error


def _shown(cell: Any) -> Any:
    """What a cell shows: a percentage is kept as its hundredth, and a unit may stand in the number format alone."""
    value, form = cell.value, (cell.number_format or "").partition(";")[0]
    if not isinstance(value, int | float) or isinstance(value, bool):
        return value
    beside, rest = "".join("".join(found) for found in LITERAL.findall(form)).strip(), LITERAL.sub("", form)
    if "%" in rest:
        return f"{value * 100:.15g} %"
    if CHANGING.search(rest):
        return f"{value} shown as {form}"  # which is refused as it stands there
    beside += "".join(SIGNS.findall(rest))
    return f"{value} {beside}" if beside else value


def _check_archive(file: BinaryIO) -> None:
    """Refuse what would unpack to too much, by the archive's directory, and by the elements of its members."""
    elements = others = 0

    def count(name: str, _attributes: Any) -> None:  # each element takes memory, however short it is
        nonlocal elements, others
        elements += 1
        others += name.rpartition(":")[2] not in CELL_ELEMENTS
        if elements > MAX_ELEMENTS or others > MAX_OTHER_ELEMENTS:
            raise refusal(MANY)

    with ZipFile(file) as archive:
        members = archive.infolist()
        if len(members) > MAX_MEMBERS:
            raise refusal("has {count} files within; a workbook has some dozens. Save it again", count=len(members))
        check_unpacked(".xlsx", sum(member.file_size for member in members))
        for member in members:
            with archive.open(member) as unpacked:
                _check_member(unpacked, count)


def _check_member(unpacked: Any, count: Any) -> None:
    """Look at a member: nothing in it declares entities or another encoding, and no text or comment is endless."""

    def declared(_version: str, encoding: str | None, _standalone: int) -> None:
        if (encoding or "").lower() not in ENCODINGS:
            refuse()

    def refuse(*_: Any) -> None:
        raise refusal(DAMAGED)

    parser = expat.ParserCreate()
    parser.XmlDeclHandler, parser.StartDoctypeDeclHandler, parser.StartElementHandler = declared, refuse, count
    begun, awaited = False, list[bytes]()
    while chunk := unpacked.read(CHUNK):
        if not begun and (b"\0" in chunk[:4] or chunk.startswith(UTF_16)):
            refuse()
        if len(chunk) == CHUNK and (b"<" not in chunk or any(end not in chunk for end in awaited)):
            raise refusal(LONG)
        begun, awaited = True, [end for begin, end in COMMENTS if chunk.rfind(begin) > chunk.rfind(end)]
        try:
            parser.Parse(chunk, False)
        except expat.ExpatError:  # a picture, or what openpyxl will call damaged when it comes to it
            return


def _bounded(rows: Iterable[tuple[Any, ...]]) -> Iterator[list[Any]]:
    """Yield the rows without the empty cells at their ends; UserError as soon as they are more than a table may have."""
    places = cells = 0
    for number, row in enumerate(rows, 1):
        kept = list(row)
        while kept and kept[-1] is None:
            kept.pop()
        places, cells = places + len(row), cells + len(kept)
        if number > MAX_ROWS or places > MAX_PLACES:
            raise _far(number)
        if cells > MAX_CELLS[".xlsx"]:
            raise refusal(MANY)
        yield kept


def _columns(rows: list[list[Any]]) -> Columns:
    while rows and not rows[-1]:
        rows.pop()
    if not rows or not rows[0]:
        raise UserError(Problem(NO_HEADER, line=1))
    width = max(len(row) for row in rows)
    blank = [place for place, row in enumerate(rows, 1) if width > 1 and not row]
    check_size(".xlsx", len(rows) - len(blank), width)
    if len(rows) * width > MAX_PLACES:
        raise _far(len(rows))
    heads, *kept = [row + [None] * (width - len(row)) for row in rows if row or width == 1]
    columns = list(zip(*kept, strict=True)) or [()] * width
    headers: list[tuple[str, str | None]] = [("" if head is None else str(head), None) for head in heads]
    return headers, [Cells(list(column), 2, tuple(blank)) for column in columns]


def _far(row: int) -> UserError:
    return refusal("has a cell far from the others, in row {row}; delete what stands there", row=row)
