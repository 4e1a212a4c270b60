"""How figures measure and write their texts: each text is measured once, by its letters at one size, for all figures of a process.

The drawing engine remembers fifty formulas and no plain texts, sets a formula anew for each size, and writes an element for each letter.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from itertools import groupby
from typing import Any, NamedTuple

from matplotlib.backends.backend_mixed import MixedModeRenderer
from matplotlib.backends.backend_svg import FigureCanvasSVG, RendererSVG
from matplotlib.colors import rgb2hex
from matplotlib.font_manager import FontProperties, get_font, ttfFontProperty
from matplotlib.textpath import TextToPath

Size = tuple[float, float, float]
SPACE, FIRM_SPACE = 0x20, "\u00a0"


class Letter(NamedTuple):
    """A letter of a formula: its place in thousandths of the size, and how it looks."""

    x: float
    y: float
    size: float
    face: str
    sign: str


class TextMeasure(TextToPath):
    """Sizes of texts and letters of formulas, found once for all sizes."""

    def __init__(self) -> None:
        super().__init__()
        self.sizes: dict[tuple[str, bool, str], Size] = {}
        self.letters: dict[tuple[str, str], list[Letter]] = {}

    def get_text_width_height_descent(self, s: str, prop: FontProperties, ismath: Any) -> Size:
        """Width, height and what is below the line."""
        key = s, bool(ismath), _family(prop)
        if key not in self.sizes:
            self.sizes[key] = super().get_text_width_height_descent(s, self._scaled(prop), ismath)
        scale = prop.get_size_in_points() / self.FONT_SCALE
        width, height, descent = self.sizes[key]
        return width * scale, height * scale, descent * scale

    def placed(self, s: str, prop: FontProperties) -> list[Letter]:
        """Return the letters of a formula from the left to the right."""
        key = s, _family(prop)
        if key not in self.letters:
            *_, glyphs, _ = self.mathtext_parser.parse(s, 72, self._scaled(prop))
            self.letters[key] = sorted(
                Letter(x / self.FONT_SCALE, -y / self.FONT_SCALE, size / self.FONT_SCALE, _face(font.fname),
                    FIRM_SPACE if code == SPACE else chr(code))
                for font, size, code, _, x, y in glyphs
            )  # fmt: skip
        return self.letters[key]

    def _scaled(self, prop: FontProperties) -> FontProperties:
        same = prop.copy()
        same.set_size(self.FONT_SCALE)
        return same


MEASURE = TextMeasure()


class TextWriter(RendererSVG):
    """Writes a figure as SVG; the letters of a formula that look the same and stand on one line in one element."""

    def get_text_width_height_descent(self, s: str, prop: FontProperties, ismath: Any) -> Size:
        """Width, height and what is below the line."""
        return MEASURE.get_text_width_height_descent(s, prop, ismath)

    def draw_text(
        self, gc: Any, x: float, y: float, s: str, prop: FontProperties, angle: float, ismath: Any = False, mtext: Any = None
    ) -> None:  # fmt: skip
        """Write a text; the engine writes a plain one."""
        if not ismath:
            super().draw_text(gc, x, y, s, prop, angle, ismath, mtext)  # type: ignore[no-untyped-call]
            return
        turn = f" rotate({_short(-angle)})" if angle else ""
        look = f"fill: {rgb2hex(gc.get_rgb())}"
        alpha = gc.get_alpha() if gc.get_forced_alpha() else gc.get_rgb()[3]
        look += f"; opacity: {_short(alpha)}" if alpha != 1 else ""
        writer: Any = self.writer
        writer.start("g", style=look, transform=f"translate({_short(x)} {_short(y)}){turn}")
        writer.start("text")
        for place, style, signs in _spans(MEASURE.placed(s, prop), prop.get_size_in_points()):
            writer.element("tspan", signs, style=style, **place)
        writer.end("text")
        writer.end("g")


class TextCanvas(FigureCanvasSVG):
    """A figure's canvas whose texts are measured and written here."""

    def print_svg(self, filename: Any, *, metadata: Any = None, **_given: Any) -> None:
        """Write the figure into an open text file."""
        dpi, self.figure.dpi = self.figure.dpi, 72
        width, height = self.figure.get_size_inches()
        writer = TextWriter(width * 72, height * 72, filename, image_dpi=dpi, metadata=metadata)  # type: ignore[no-untyped-call]
        renderer: Any = MixedModeRenderer(self.figure, width, height, dpi, writer)  # type: ignore[no-untyped-call]
        self.figure.draw(renderer)
        renderer.finalize()


def _spans(letters: list[Letter], size: float) -> Iterator[tuple[dict[str, str], str, str]]:
    """Yield letters in a row that look the same, with their places."""
    for (y, own, face), row in groupby(letters, lambda each: (each.y, each.size, each.face)):
        same = list(row)
        place = {"x": " ".join(_short(each.x * size) for each in same), "y": _short(y * size)}
        yield place, face.format(_short(own * size)), "".join(each.sign for each in same)


def _family(prop: FontProperties) -> str:
    family: str = prop.get_family()[0]
    return family


@cache
def _face(file: str) -> str:
    """The style of a font's letters; their size is to be filled in."""
    found = ttfFontProperty(get_font(file))
    slant = "font-style: italic; " if found.style == "italic" else ""
    return f"{slant}font-size: {{}}px; font-family: '{found.name}'"


def _short(value: float) -> str:
    said = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if said == "-0" else said
