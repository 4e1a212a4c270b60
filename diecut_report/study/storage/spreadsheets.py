"""The variants as CSV and XLSX beside the part files, for spreadsheets and other programs; streamed, so memory stays flat."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from io import BytesIO
from itertools import chain, islice
from pathlib import Path
from typing import TYPE_CHECKING, Any
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from diecut_report.errors import Problem, UserError, nearest
from diecut_report.files import replaced, room
from diecut_report.study.storage.store import PARTS, Store

if TYPE_CHECKING:
    from openpyxl import Workbook
    from openpyxl.worksheet._write_only import WriteOnlyWorksheet

NAME = "variants"
SHEET_ROWS, SHEET_COLUMNS = 1_048_576, 16_384  # what a sheet of a workbook holds


def export(store: Store, formats: Iterable[str]) -> tuple[str, ...]:
    """Write the variants stored so far as DIR/variants.csv or .xlsx, a row each; says what is to be known of the files."""
    wanted = list(dict.fromkeys(formats))
    if strange := [name for name in wanted if name not in WRITERS]:
        words = (
            f"{strange[0]!r} is not a format of a table{nearest(strange[0], WRITERS)}. Allowed: {', '.join(WRITERS)}."
        )
        raise UserError(Problem(words))
    for name in wanted:
        path = store.directory / f"{NAME}.{name}"
        with replaced(path) as temporary:
            WRITERS[name](store, temporary, path)
    return tuple(_told(store, wanted))


def _told(store: Store, formats: list[str]) -> Iterator[str]:
    """What of the results stands elsewhere than one would look for it."""
    curves = [column.name for column in store.description.columns if column.kind == "curve"]
    if curves and formats:
        names = " and ".join(f"{NAME}.{name}" for name in formats)
        yield f"{names}: without the curves {', '.join(curves)}, which only the Parquet files in {store.directory / PARTS} hold."
    if "xlsx" in formats and _sheets(store) > 1:
        yield f"{NAME}.xlsx: {store.count()} variants in {_sheets(store)} sheets, as a sheet holds {SHEET_ROWS} rows."


def _sheets(store: Store) -> int:
    return max(1, math.ceil(store.count() / (SHEET_ROWS - 1)))


def heads(store: Store) -> dict[str, str]:
    """Return the columns but for curves, and their names with units, `drive.crank_torque_peak [N*m]`, as tables of a study have them."""
    units = {column.name: column.unit for column in store.description.all_columns if column.kind != "curve"}
    return {name: name if unit == "1" else f"{name} [{unit}]" for name, unit in units.items()}


def _write_csv(store: Store, temporary: Path, path: Path) -> None:
    """UTF-8; numbers in their shortest form that reads back the same, nothing for null."""
    import pyarrow as pa
    from pyarrow.csv import CSVWriter

    names = heads(store)
    schema = pa.schema([store.schema.field(name).with_name(head) for name, head in names.items()])
    with temporary.open("wb") as file, CSVWriter(file, schema) as writer:
        for batch in store.batches(list(names)):
            writer.write_batch(pa.RecordBatch.from_arrays(batch.columns, schema=schema))


def _write_xlsx(store: Store, temporary: Path, path: Path) -> None:
    """A workbook; as many sheets as the rows need, each with its heads, which stay in view."""
    from openpyxl import Workbook
    from openpyxl.writer.excel import ExcelWriter

    names = heads(store)
    if len(names) > SHEET_COLUMNS:
        words = f"The results have {len(names)} columns; a sheet holds {SHEET_COLUMNS}. Use CSV."
        raise UserError(Problem(words, str(path)))
    book = Workbook(write_only=True)
    rows = _rows(store, list(names))
    with room(store.directory), _closed(book):  # it keeps each sheet in a temporary file
        for sheet in range(_sheets(store)):
            _fill(book.create_sheet(f"{NAME} {sheet + 1}"), list(names.values()), islice(rows, SHEET_ROWS - 1))
        ExcelWriter(book, _Archive(temporary, "w", ZIP_DEFLATED, strict_timestamps=False)).save()


def workbook(tables: Mapping[str, list[list[Any]]]) -> bytes:
    """Return tables as a workbook, each in a sheet of its name, with its first row and column in view."""
    from openpyxl import Workbook
    from openpyxl.writer.excel import ExcelWriter

    book, content = Workbook(write_only=True), BytesIO()
    with _closed(book):
        for name, (heads, *rows) in tables.items():
            _fill(book.create_sheet(name), heads, rows)
        ExcelWriter(book, _Archive(content, "w", ZIP_DEFLATED, strict_timestamps=False)).save()
    return content.getvalue()


class _Archive(ZipFile):
    """An archive of which no member bears the time: one before 1980 cannot be written, and a clock may be wrong."""

    def writestr(
        self,
        zinfo_or_arcname: str | ZipInfo,
        data: Any,
        compress_type: int | None = None,
        compresslevel: int | None = None,
    ) -> None:
        """Write a member, dated as early as can be."""
        member = ZipInfo(zinfo_or_arcname) if isinstance(zinfo_or_arcname, str) else zinfo_or_arcname
        if member is not zinfo_or_arcname:
            member.compress_type, member.external_attr = self.compression, 0o600 << 16
        super().writestr(member, data, compress_type, compresslevel)

    def write(
        self, filename: Any, arcname: Any = None, compress_type: int | None = None, compresslevel: int | None = None
    ) -> None:
        """Write a file as a member, dated as early as can be."""
        os.utime(filename, (0, 0))
        super().write(filename, arcname, compress_type, compresslevel)


@contextmanager
def _closed(book: Workbook) -> Iterator[None]:
    """After an error the sheets are closed, which else complain when they are forgotten."""
    try:
        yield
    except BaseException:
        for sheet in book.worksheets:
            with suppress(Exception):  # the error that is reported is the one before
                sheet.close()
        raise


def _fill(sheet: WriteOnlyWorksheet, names: list[str], rows: Iterable[list[Any]]) -> None:
    sheet.freeze_panes = "B2"
    for row in chain([names], rows):
        sheet.append([_cell(sheet, value) if isinstance(value, str) else value for value in row])


def _cell(sheet: WriteOnlyWorksheet, text: str) -> Any:
    """A text as such: "=1" is not a formula, and characters that a workbook cannot hold are replaced."""
    from openpyxl.cell import WriteOnlyCell
    from openpyxl.cell.cell import ILLEGAL_CHARACTERS_RE

    cell = WriteOnlyCell(sheet, ILLEGAL_CHARACTERS_RE.sub("\N{REPLACEMENT CHARACTER}", text))
    cell.data_type = "s"
    return cell


def _rows(store: Store, names: list[str]) -> Iterator[list[Any]]:
    for batch in store.batches(names):
        yield from map(list, zip(*(column.to_pylist() for column in batch.columns), strict=True))


WRITERS: dict[str, Callable[[Store, Path, Path], None]] = {"csv": _write_csv, "xlsx": _write_xlsx}
