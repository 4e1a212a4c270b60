"""A report of results in its formats."""

from __future__ import annotations

from collections.abc import Callable

from diecut_report.report.context import Material
from diecut_report.report.pages.html import page


class Rendering(Material):
    """The report of a results document (schema_version 1), in a firm's own style; what its formats share is made once."""

    def html(self, *, is_part: bool = False) -> str:
        """The report as one self-contained HTML page, or as a part of another page."""
        return page(self, is_part=is_part)

    def pdf(self, begun: Callable[[int], object] = int) -> bytes:
        """The report as PDF (A4, PDF/A-3 and PDF/UA-1); needs the system's pango (OSError without it). ``begun`` gets each sheet's number."""
        from diecut_report.report.pages.frames import SHEET_BEGUN
        from diecut_report.report.pages.pdf import sheets

        before = SHEET_BEGUN.set(begun)
        try:
            return sheets(self)
        finally:
            SHEET_BEGUN.reset(before)

    def docx(self) -> bytes:
        """The report as a document for word processors."""
        from diecut_report.report.office.word_file import word_file

        return word_file(self)

    def xlsx(self) -> bytes:
        """The report's numbers as a workbook."""
        from diecut_report.report.office.workbook import workbook

        return workbook(self)
