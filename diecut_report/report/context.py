"""What the formats of one report share: its content, formulas and figures, each made once and only when asked for."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from diecut_report.report.chapters.front import CarriedFile, PrintedChanges, carried_files, marked, printed_changes
from diecut_report.report.chapters.sources import numbered
from diecut_report.report.document import ReportDocument, document
from diecut_report.report.equations import Equations, Typesetter
from diecut_report.report.model import Drawn, Item
from diecut_report.report.pages.firm_templates import HouseStyle
from diecut_report.report.scope import BRIEF, FULL, parts
from diecut_report.report.symbols import DeclaredLetters, declared_letters
from diecut_report.report.text import Catalogue, translated
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.mechanism_record import CurveRecord
from diecut_report.results.model import ResultsRecord
from diecut_report.text.catalogues import Catalogues

if TYPE_CHECKING:
    from diecut_report.report.figures.by_type import Raster
    from diecut_report.report.figures.style import SizesSize, Svg

Drawing = TypeVar("Drawing")


class DrawingFault(NamedTuple):
    """A figure that could not be drawn: its mechanism, number and data, and what went wrong."""

    mechanism: str
    number: str
    figure: Drawn
    cause: Exception

    @property
    def id(self) -> str:
        """Its id."""
        return self.figure.id if isinstance(self.figure, FigureRecord) else self.number

    @property
    def words(self) -> str:
        """What went wrong."""
        return f"{self.cause}" if isinstance(self.cause, ValueError) else f"{type(self.cause).__name__}: {self.cause}"


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
    def letters(self) -> DeclaredLetters:
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

        return self._drawn(render)

    @cached_property
    def rasters(self) -> dict[str, Raster]:
        """The same as pictures of points."""
        from diecut_report.report.figures.by_type import raster

        return self._drawn(raster)

    def _drawn(self, draw: Callable[..., Drawing]) -> dict[str, Drawing]:
        found: dict[str, Drawing] = {}
        calculated = dict(parts(self.said))
        for chapter in self.document.chapters:
            for number, figure in chapter.figures:
                if figure.error:
                    continue
                try:
                    found[number] = self._sized(draw, number, figure, calculated[chapter.name].curves)
                except Exception as cause:  # of any kind: what a plugin gives to be drawn is its own
                    if all(fault.number != number for fault in self.faults):
                        self.faults.append(DrawingFault(chapter.name, number, figure, cause))
            for number in _left_alone(chapter.pairs, found):
                curves = calculated[chapter.name].curves
                found[number] = draw(dict(chapter.figures)[number], curves, self.words, number, self._whole)
        for number, tornado in self.document.influence.figures if self.document.influence else ():
            found[number] = self._sized(draw, number, tornado, {})
        return found

    def _sized(
        self, draw: Callable[..., Drawing], number: str, figure: Drawn, curves: Mapping[str, CurveRecord]
    ) -> Drawing:
        """A figure in the size of its place; one whose texts take more than half the width has it alone."""
        from diecut_report.report.figures.style import WIDEST_HALF
        from diecut_report.report.figures.style import SizesSize as Size

        if number in self.document.halves:
            made: Any = draw(figure, curves, self.words, number, Size.HALF)
            if made.width <= WIDEST_HALF:
                return made  # type: ignore[no-any-return]
        return draw(figure, curves, self.words, number, self._whole)

    @property
    def _whole(self) -> SizesSize:
        """The size of a figure that stands alone."""
        from diecut_report.report.figures.style import SizesSize as Size

        return {BRIEF: Size.SKETCH, FULL: Size.LARGE}.get(self.document.detail, Size.LOW)

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


def _left_alone(pairs: Sequence[tuple[str, ...]], drawn: Mapping[str, Any]) -> Iterator[str]:
    """The figures drawn over half the width of which the other one of a pair has no room beside it."""
    from diecut_report.report.figures.style import WIDEST_HALF

    for pair in pairs:
        narrow = [number for number in pair if number in drawn and drawn[number].width <= WIDEST_HALF]
        yield from narrow if len(narrow) < len([number for number in pair if number in drawn]) else ()
