"""What the formats of one report share: its content, formulas and figures, each made once and only when asked for."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from diecut_report.report.chapters.front import CarriedFile, PrintedChanges, carried_files, marked, printed_changes
from diecut_report.report.document import ReportDocument, document
from diecut_report.report.equations import Equations, Typesetter
from diecut_report.report.model import Item, PrintedChapter
from diecut_report.report.pages.firm_templates import HouseStyle
from diecut_report.report.scope import BRIEF, FULL, parts
from diecut_report.report.symbols import declared_letters
from diecut_report.report.text import Catalogue, numbered, translated
from diecut_report.results.model import ResultsRecord
from diecut_report.text.catalogues import Catalogues

if TYPE_CHECKING:
    from diecut_report.report.figures.by_type import Raster
    from diecut_report.report.figures.style import SizesSize, Svg

Drawing = TypeVar("Drawing")


class DrawingFault(NamedTuple):
    """A figure that could not be drawn: its mechanism, number and id, and what went wrong."""

    mechanism: str
    number: str
    id: str
    words: str


class Material:
    """The parts of the report of a results document."""

    def __init__(
        self, results: ResultsRecord, catalogues: Catalogues | None = None, house: HouseStyle | None = None
    ) -> None:
        self.results, self.house = results, house
        self.words = Catalogue(results.project.language)
        self.catalogues = catalogues or Catalogues(self.words.language)
        self.typesetter = Typesetter()
        self.faults: list[DrawingFault] = []

    @cached_property
    def document(self) -> ReportDocument:
        """The report's content."""
        return document(marked(self.said), Equations(self.words, self.typesetter.measure), self.words)

    @cached_property
    def said(self) -> ResultsRecord:
        """The results with their texts in the report's language, and papers by their numbers."""
        return numbered(translated(self.results, self.catalogues))

    @cached_property
    def letters(self) -> tuple[set[str], set[str]]:
        """The lone letters that are symbols, and the configuration's own names."""
        return declared_letters(self.results)

    @cached_property
    def changes(self) -> PrintedChanges | None:
        """What changed since the former revision, where the results tell that."""
        return printed_changes(self.said.changes, self.words) if self.said.changes else None

    @cached_property
    def carried(self) -> tuple[CarriedFile, ...]:
        """The files that the report carries."""
        return carried_files(self.results, self.words)

    @property
    def logo(self) -> str:
        """The organisation's logo as a data address; nothing where there is none."""
        logo = self.results.config.logo
        return f"data:{logo.media_type};base64,{logo.base64}" if logo else ""

    @cached_property
    def figures(self) -> dict[str, Svg]:
        """All figures by their number, but those that cannot be drawn: these are in ``faults``."""
        from diecut_report.report.figures.by_type import render  # with matplotlib, which takes half a second
        from diecut_report.report.figures.kept import make_room

        made = self._drawn(render)
        make_room()
        return made

    @cached_property
    def rasters(self) -> dict[str, Raster]:
        """The same as pictures of points."""
        from diecut_report.report.figures.by_type import raster

        return self._drawn(raster)

    def _drawn(self, draw: Callable[..., Drawing]) -> dict[str, Drawing]:
        """All figures; two side by side have room over half the width, or each gets all of it."""
        from diecut_report.report.figures.style import WIDEST_HALF
        from diecut_report.report.figures.style import SizesSize as Size

        found: dict[str, Any] = {}
        whole = {BRIEF: Size.SKETCH, FULL: Size.LARGE}.get(self.document.detail, Size.LOW)
        for chapter in self.document.chapters:
            halves = {number for pair in chapter.pairs for number in pair}
            found |= self._made(draw, chapter, [number for number, _ in chapter.figures if number not in halves], whole)
            for pair in chapter.pairs:
                made: dict[str, Any] = self._made(draw, chapter, pair, Size.HALF)
                is_wide = any(each.width > WIDEST_HALF for each in made.values())
                found |= self._made(draw, chapter, list(made), whole) if is_wide else made
        influence = self.document.influence.figures if self.document.influence else []
        for number, figure in (*self.document.drive_line, *influence):
            found[number] = draw(figure, {}, self.words, number, whole)
        return found

    def _made(
        self, draw: Callable[..., Drawing], chapter: PrintedChapter, numbers: Iterable[str], size: SizesSize
    ) -> dict[str, Drawing]:
        """These figures of a chapter, but those that cannot be drawn."""
        found, curves, figures = {}, dict(parts(self.said))[chapter.name].curves, dict(chapter.figures)
        for number in numbers:
            try:
                if not figures[number].error:
                    found[number] = draw(figures[number], curves, self.words, number, size)
            except Exception as cause:  # of any kind: what a plugin gives to be drawn is its own
                if all(fault.number != number for fault in self.faults):
                    told = f"{cause}" if isinstance(cause, ValueError) else f"{type(cause).__name__}: {cause}"
                    self.faults.append(DrawingFault(chapter.name, number, figures[number].id, told))
        return found

    def are_abreast(self, pair: tuple[Item, ...]) -> bool:
        """Whether two figures have room side by side."""
        from diecut_report.report.figures.style import WIDEST_HALF

        return all(item.number not in self.figures or self.figures[item.number].width <= WIDEST_HALF for item in pair)

    def failed(self, number: str) -> str:
        """Why a figure could not be drawn; nothing where it could."""
        return "" if number in self.figures else self.why_not_drawn(number)

    def why_not_drawn(self, number: str) -> str:
        """Why a figure that could not be drawn could not."""
        figure = dict(pair for chapter in self.document.chapters for pair in chapter.figures)[number]
        return figure.error or next(fault.words for fault in self.faults if fault.number == number)
