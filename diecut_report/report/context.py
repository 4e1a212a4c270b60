"""What the formats of one report share: its content, formulas and figures, each made once and only when asked for."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

from diecut_report.report.document import Document, document, parts
from diecut_report.report.equations import Equations
from diecut_report.report.i18n import Words
from diecut_report.report.typeset import Typesetter

if TYPE_CHECKING:
    from diecut_report.report.figures.style import Svg


class Material:
    """The parts of the report of a results document."""

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
        from diecut_report.report.figures.by_type import render  # with matplotlib, which takes half a second

        return {
            number: render(figure, data["curves"], self.words, number)
            for chapter, (_, data) in zip(self.document.chapters, parts(self.results), strict=True)
            for number, figure in chapter.figures
        }
