"""A report of results in its formats."""

from __future__ import annotations

from diecut_report.report.context import DrawingFault, Material
from diecut_report.report.pages.firm_templates import HouseStyle
from diecut_report.report.pages.html import page
from diecut_report.results.model import ResultsRecord
from diecut_report.text.catalogues import Catalogues


class Rendering:
    """The report of a results document (schema_version 1), in a firm's own style; what its formats share is made once."""

    def __init__(
        self, results: ResultsRecord, catalogues: Catalogues | None = None, house: HouseStyle | None = None
    ) -> None:
        self.material = Material(results, catalogues, house)

    @property
    def faults(self) -> list[DrawingFault]:
        """The figures that could not be drawn; known when a format is made."""
        return self.material.faults

    def html(self) -> str:
        """The report as one self-contained HTML page."""
        return page(self.material)

    def pdf(self) -> bytes:
        """The report as PDF (A4, PDF/A-3 and PDF/UA-1); needs the system's pango (OSError without it)."""
        from diecut_report.report.pages.pdf import sheets

        return sheets(self.material)

    def docx(self) -> bytes:
        """The report as a document for word processors."""
        from diecut_report.report.office.word_file import word_file

        return word_file(self.material)

    def xlsx(self) -> bytes:
        """The report's numbers as a workbook."""
        from diecut_report.report.office.workbook import workbook

        return workbook(self.material)
