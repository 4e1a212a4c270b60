"""A report of results in its formats; what they share (formulas, figures, the document) is made once."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

from diecut_report.report.document import Document, document
from diecut_report.report.equations import Equations
from diecut_report.report.i18n import Words
from diecut_report.report.typeset import Typesetter

if TYPE_CHECKING:
    from diecut_report.report.figures import Svg


class Rendering:
    """The report of a results document (schema_version 1)."""

    def __init__(self, results: Mapping[str, Any]) -> None:
        self.results = results
        self.words = Words(results["project"].get("language") or "en")
        self.typesetter = Typesetter()

    @cached_property
    def document(self) -> Document:
        """The report's content."""
        return document(self.results, Equations(self.words, self.typesetter.measure), self.words)

    @cached_property
    def figures(self) -> dict[str, Svg]:
        """All figures by their number."""
        from diecut_report.report.figures import render

        mechanisms = self.results["mechanisms"]
        return {
            number: render(figure, mechanisms[chapter.name]["curves"], self.words, number)
            for chapter in self.document.chapters
            for number, figure in chapter.figures
        }

    def html(self) -> str:
        """The report as one self-contained HTML page."""
        from diecut_report.report.html import page

        return page(self)

    def pdf(self) -> bytes:
        """The report as PDF (A4, PDF/UA-1)."""
        from diecut_report.report.pdf import sheets

        return sheets(self)


def render_html(results: Mapping[str, Any]) -> str:
    """A results document as HTML."""
    return Rendering(results).html()


def render_pdf(results: Mapping[str, Any]) -> bytes:
    """A results document as PDF."""
    return Rendering(results).pdf()
