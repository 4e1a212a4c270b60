"""A report as a workbook (XLSX) by openpyxl, which is imported only when one is made: numbers are numbers, texts are never formulas."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import partial
from io import BytesIO
from typing import TYPE_CHECKING, Any
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from diecut_report.report.chapters.front import DATE
from diecut_report.report.context import Material
from diecut_report.report.office.sheets import LONGEST_TEXT, Cell, CellNumber, WorkSheet, sheet_names, sheets

if TYPE_CHECKING:
    from openpyxl import Workbook
    from openpyxl.packaging.core import DocumentProperties
    from openpyxl.worksheet._write_only import WriteOnlyWorksheet


# What office files of all kinds need: archives that bear no time, and texts that such a file can hold.


_UNHOLDABLE = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")  # characters that XML has not


class UndatedArchive(ZipFile):
    """An archive of which no member bears the time: one before 1980 cannot be written, and a clock may be wrong."""

    def __init__(self, file: Any) -> None:
        super().__init__(file, "w", ZIP_DEFLATED, strict_timestamps=False)

    def writestr(self, zinfo_or_arcname: str | ZipInfo, data: Any, *args: Any, **given: Any) -> None:
        """Write a member, dated as early as can be."""
        member = zinfo_or_arcname
        if isinstance(member, str):
            member = ZipInfo(member)
            member.compress_type, member.external_attr = self.compression, 0o600 << 16
        super().writestr(member, data, *args, **given)

    def write(self, filename: Any, *args: Any, **given: Any) -> None:
        """Write a file as a member, dated as early as can be."""
        os.utime(filename, (0, 0))
        super().write(filename, *args, **given)


def undated(content: bytes) -> bytes:
    """Return an archive with the same members, none of which bears the time."""
    made = BytesIO()
    with ZipFile(BytesIO(content)) as given, UndatedArchive(made) as archive:
        for name in given.namelist():
            archive.writestr(name, given.read(name))
    return made.getvalue()


def holdable(text: str) -> str:
    """Return a text with the characters replaced that XML cannot hold."""
    return _UNHOLDABLE.sub("\N{REPLACEMENT CHARACTER}", text)


PROGRAM = "diecut-report"
HEAD_COLOUR = "E9EDF1"
FORMULA_SIGNS = ("=", "+", "-", "@", "\t", "\r")  # what a spreadsheet takes for the begin of a formula
WRAPPED_FROM = 40  # letters wide: the texts of such a column go on in a further line


def workbook(material: Material) -> bytes:
    """Return the report as XLSX; the same bytes for the same results."""
    return book_of(sheets(material), partial(_describe, material))


def book_of(made: Sequence[WorkSheet], describe: Callable[[DocumentProperties], None] = lambda _: None) -> bytes:
    """Return sheets as XLSX; the same bytes for the same sheets. ``describe`` adds to the properties of the document."""
    from openpyxl import Workbook
    from openpyxl.writer.excel import ExcelWriter

    book, content = Workbook(write_only=True), BytesIO()
    with closed(book):
        for name, sheet in zip(sheet_names(sheet.title for sheet in made), made, strict=True):
            _Filled(book.create_sheet(name), sheet).fill()
            _name_cells(book, name, sheet)
        about = book.properties
        about.creator, about.created, about.modified = PROGRAM, DATE, DATE
        describe(about)
        # not Workbook.save, which writes the time
        ExcelWriter(book, UndatedArchive(content)).save()
    return content.getvalue()


class _Filled:
    def __init__(self, into: WriteOnlyWorksheet, sheet: WorkSheet) -> None:
        from openpyxl.styles import Alignment, Font, PatternFill

        self.into, self.sheet = into, sheet
        self.cells: dict[tuple[int, str], Any] = {}
        self.bold = Font(name="Calibri", size=11, bold=True)
        self.fill_of_heads = PatternFill("solid", fgColor=HEAD_COLOUR)
        self.top = Alignment(vertical="top", indent=1)
        self.wrapped = Alignment(vertical="top", indent=1, wrap_text=True)

    def fill(self) -> None:
        """Write all, to be printed across the page, all columns on a page, with the heads on each."""
        from openpyxl.utils import get_column_letter
        from openpyxl.worksheet.properties import PageSetupProperties

        for column, width in enumerate(self.sheet.widths, 1):
            self.into.column_dimensions[get_column_letter(column)].width = width
        self.into.freeze_panes = f"{get_column_letter(self.sheet.held + 1)}{len(self.sheet.heads) + 1}"
        self.into.page_setup.orientation, self.into.page_setup.paperSize = "landscape", 9  # A4
        self.into.sheet_properties.pageSetUpPr = PageSetupProperties(fitToPage=True)
        self.into.page_setup.fitToHeight = 0
        self.into.print_title_rows = f"1:{len(self.sheet.heads)}"
        for head in self.sheet.heads:
            self.into.append([self._text(text, self.wrapped, font=self.bold, fill=self.fill_of_heads) for text in head])
        for row in self.sheet.rows:
            self.into.append([self._cell(value, column) for column, value in enumerate(row)])
        if self.sheet.is_filtered:
            last = get_column_letter(len(self.sheet.widths))
            self.into.auto_filter.ref = f"A{len(self.sheet.heads)}:{last}{len(self.sheet.heads) + len(self.sheet.rows)}"
        if self.sheet.bars:
            self._draw_bars()

    def _draw_bars(self) -> None:
        """Draw columns of the sheet as bars over its first column, below the rows."""
        from openpyxl.chart import BarChart, Reference

        first, last = len(self.sheet.heads), len(self.sheet.heads) + len(self.sheet.rows)
        chart = BarChart()
        for column in self.sheet.bars:
            chart.add_data(Reference(self.into, min_col=column + 1, min_row=first, max_row=last), titles_from_data=True)
        chart.set_categories(Reference(self.into, min_col=1, min_row=first + 1, max_row=last))
        chart.y_axis.number_format, chart.y_axis.scaling.min = "0%", 0
        chart.x_axis.delete = chart.y_axis.delete = False
        chart.legend.position = "b"
        chart.width, chart.height = 26, 11  # cm
        self.into.add_chart(chart, f"A{last + 3}")

    def _text(self, text: str, alignment: Any, **look: Any) -> Any:
        cell = text_cell(self.into, text)
        cell.alignment = alignment
        for name, value in look.items():
            setattr(cell, name, value)
        return cell

    def _cell(self, value: Cell, column: int) -> Any:
        if isinstance(value, CellNumber):
            return self._number(value, column)
        is_wide = column < len(self.sheet.widths) and self.sheet.widths[column] >= WRAPPED_FROM
        return self._text(value, self.wrapped if is_wide else self.top) if value else None

    def _number(self, number: CellNumber, column: int) -> Any:
        """Return a number for its column; a row is written before the next, so one cell of a form does for all of them."""
        from openpyxl.cell import WriteOnlyCell

        key = column, number.form
        if key not in self.cells:
            self.cells[key] = WriteOnlyCell(self.into)
            self.cells[key].number_format = number.form
        self.cells[key].value = number.value
        return self.cells[key]


def text_cell(sheet: WriteOnlyWorksheet, text: str) -> Any:
    """Return a text for a sheet as such: "=1" is not a formula, and characters that a workbook cannot hold are replaced."""
    from openpyxl.cell import WriteOnlyCell

    cell = WriteOnlyCell(sheet, holdable(text)[:LONGEST_TEXT])
    cell.data_type = "s"
    cell.quotePrefix = text.startswith(FORMULA_SIGNS)  # so that it stays a text when somebody edits it
    return cell


@contextmanager
def closed(book: Workbook) -> Iterator[None]:
    """After an error the sheets are closed, which else complain when they are forgotten."""
    try:
        yield
    except BaseException:
        for sheet in book.worksheets:
            with suppress(Exception):  # the error that is reported is the one before
                sheet.close()
        raise


def _name_cells(book: Workbook, name: str, sheet: WorkSheet) -> None:
    from openpyxl.utils import absolute_coordinate, get_column_letter, quote_sheetname
    from openpyxl.workbook.defined_name import DefinedName

    for each, (row, column) in sheet.names.items():
        place = absolute_coordinate(f"{get_column_letter(column)}{row}")
        book.defined_names[each] = DefinedName(each, attr_text=f"{quote_sheetname(name)}!{place}")


def _describe(material: Material, about: DocumentProperties) -> None:
    project, document = material.document.project, material.document
    about.title, about.subject = holdable(document.title), holdable(project["document_number"])
    about.creator = about.lastModifiedBy = holdable(project["prepared_by"] or document.program.name)
    about.description = holdable(f"{document.program.name} {document.program.version}")
    about.language, about.version = document.words.language, holdable(project["revision"])
