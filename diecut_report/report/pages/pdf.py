"""The report as PDF by WeasyPrint, which is imported only here. Nothing is fetched: all is embedded."""

from __future__ import annotations

import base64
import gc
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from typing import Any

from markupsafe import Markup, escape

from diecut_report.report.chapters.front import DATE
from diecut_report.report.context import Material
from diecut_report.report.document import RULE, Backdrop
from diecut_report.report.equations import Equation
from diecut_report.report.model import Item
from diecut_report.report.pages.frames import sheet_blocks, waiting_figures
from diecut_report.report.pages.html import Screen, filled
from diecut_report.report.pages.page_engine import HTML, Attachment, URLFetcher, block_layout, read_page, told_of_page
from diecut_report.report.pages.pdf_archive import complete
from diecut_report.report.pages.pdf_figures import FigurePicture, NotDrawn
from diecut_report.report.pages.pdf_math import Letters, Picture

BESIDE_WIDTH = 33.0  # em of a formula that stands beside its description
BESIDE_LETTERS = 60  # of a description of two lines beside a formula
NARROW_WIDTH = 22.0  # em of a formula beside which a description has more room
ROOMY_LETTERS = 100  # of such a description
SMALLER = 0.85  # of the letters of a source
BACKDROP, FORMULA = "data:backdrop,", "data:formula,"  # addresses of pictures, which WeasyPrint finds in its cache


block_layout.block_level_layout = waiting_figures(block_layout.block_level_layout)


class Paper(Screen):
    """Formulas as outlines with searchable text under them, figures as images."""

    def __init__(self, material: Material) -> None:
        super().__init__(material)
        block, words = material.document.block, material.words
        self.frame = sheet_blocks(block, words, has_logo=bool(material.logo))
        self.letters = Letters()
        behind = Backdrop(block.frame, words["across"] if block.is_held else "")
        self.formulas: set[str] = set()
        self.pictures: dict[str, Picture | FigurePicture | Backdrop] = {BACKDROP: behind} if behind else {}
        self.style = RULE.format(BACKDROP) if behind else ""

    def display(self, equation: Equation) -> Markup:
        return self._picture(equation, "")

    def beside(self, equation: Equation) -> Markup:
        depth = self.material.typesetter.outline(equation.latex).depth
        return self._picture(equation, f' style="vertical-align:{depth}em"')

    def fits_beside(self, item: Item) -> bool:
        """Whether a formula and its description, in two lines at most, have room side by side."""
        if item.equation is None or item.condition or item.words:
            return False
        is_short = _letters(item) <= BESIDE_LETTERS
        is_narrow = is_short and self.material.typesetter.measure(item.equation.latex) <= BESIDE_WIDTH
        return is_narrow or self.has_room_beside(item)

    def has_room_beside(self, item: Item) -> bool:
        """Whether a formula is so narrow that its description may be wider."""
        if item.equation is None or _letters(item) > ROOMY_LETTERS:
            return False
        return self.material.typesetter.measure(item.equation.latex) <= NARROW_WIDTH

    def _picture(self, equation: Equation, style: str) -> Markup:
        self.formulas.add(equation.text)
        told = escape(equation.text).replace("\n", Markup("&#10;"))
        outline = self.material.typesetter.outline(equation.latex)
        return self._image(Picture(outline, equation.text, self.letters), told, style)

    def _image(self, picture: Picture | FigurePicture, told: str, style: str = "") -> Markup:
        address = f"{FORMULA}{len(self.pictures)}"
        self.pictures[address] = picture
        return Markup('<img src="{}" alt="{}"{}>').format(address, told, Markup(style))

    def figure(self, number: str, title: str) -> Markup:
        """A figure as outlines; as an image where it holds what cannot be drawn so."""
        drawing = self.material.figures[number]
        try:
            return self._image(FigurePicture(*drawing), title)
        except NotDrawn:
            data = base64.b64encode(drawing.text.encode()).decode()
            return Markup('<img src="data:image/svg+xml;base64,{}" alt="{}">').format(data, title)


def _letters(item: Item) -> float:
    """How long what is said of a formula is, in letters of the description."""
    return len(item.description) + len(item.text) + SMALLER * len(item.source)


def sheets(material: Material) -> bytes:
    """The whole PDF."""
    paper = Paper(material)
    source = filled(material, paper, "print")
    fetcher = URLFetcher(allowed_protocols={"data"}, allow_redirects=False, fail_on_errors=True)
    cache: dict[str, Any] = dict(paper.pictures)
    with (
        _without_collection(),
        told_of_page(material.house.folder if material.house else ""),
        warnings.catch_warnings(action="ignore", category=ResourceWarning),
    ):  # WeasyPrint's own file
        content: bytes = read_page(source, fetcher, is_own=material.house is None).write_pdf(
            pdf_variant="pdf/a-3a", cache=cache, presentational_hints=False,
            finisher=partial(complete, words=material.words, letters=paper.letters, formulas=paper.formulas),
            attachments=[
                # the type of a file is that of its address, not what the system takes its ending for
                Attachment(url=file.address, url_fetcher=fetcher, name=file.name, description=file.description,
                           created=DATE, modified=DATE, relationship=file.relationship)
                for file in material.carried
            ],
        )  # fmt: skip
    return content


def printed_page(source: str) -> bytes:
    """Return a page of its own as PDF (A4, PDF/UA-1); whoever asks gives it room for its files."""
    fetcher = URLFetcher(allowed_protocols={"data"}, allow_redirects=False, fail_on_errors=True)
    with _without_collection():
        content: bytes = HTML(string=source, url_fetcher=fetcher).write_pdf(pdf_variant="pdf/ua-1")
    return content


@contextmanager
def _without_collection() -> Iterator[None]:
    """Without the garbage collector's passes, which find nothing in a tree of boxes that is in use.

    What the figures left behind goes first: it would lie beside the tree, where the memory's peak is.
    """
    gc.collect()
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()
