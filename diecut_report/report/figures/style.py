"""Figures of the results as SVG: what charts and drawings have in common (fonts, inks, labels, and how they are written)."""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager
from enum import Enum
from functools import cache, partial
from itertools import groupby
from textwrap import fill
from typing import Any, NamedTuple
from xml.sax.saxutils import escape

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_mixed import MixedModeRenderer
from matplotlib.backends.backend_svg import FigureCanvasSVG, RendererSVG
from matplotlib.colors import rgb2hex
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties, fontManager, get_font, ttfFontProperty
from matplotlib.textpath import TextToPath
from numpy.typing import NDArray

from diecut_report.report.symbols import SYMBOL, font_file
from diecut_report.report.text import tidy

# How figures measure and write their texts: each text is measured once, by its letters at one size, for all figures of a process.
#
# The drawing engine remembers fifty formulas and no plain texts, sets a formula anew for each size, and writes an element for each letter.


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
        key = s, bool(ismath), str(prop.get_family()[0])
        if key not in self.sizes:
            self.sizes[key] = super().get_text_width_height_descent(s, self._scaled(prop), ismath)
        scale = prop.get_size_in_points() / self.FONT_SCALE
        width, height, descent = self.sizes[key]
        return width * scale, height * scale, descent * scale

    def placed(self, s: str, prop: FontProperties) -> list[Letter]:
        """Return the letters of a formula from the left to the right."""
        key = s, str(prop.get_family()[0])
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
    for (y, own, face), row in groupby(letters, lambda each: (each.y, each.size, each.face)):
        same = list(row)
        place = {"x": " ".join(_short(each.x * size) for each in same), "y": _short(y * size)}
        yield place, face.format(_short(own * size)), "".join(each.sign for each in same)


@cache
def _face(file: str) -> str:
    found = ttfFontProperty(get_font(file))
    slant = "font-style: italic; " if found.style == "italic" else ""
    return f"{slant}font-size: {{}}px; font-family: '{found.name}'"


def _short(value: float) -> str:
    said = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if said == "-0" else said


INK, SOFT, PALE, ACCENT = "#1b232c", "#66717d", "#e9edf1", "#0b5c8f"
MM = 72 / 25.4  # points
FONT_SIZE = 8.5  # points
BELOW = 1.2  # what the tails of letters take beyond a text's size, points
LINE = 1.25  # from line to line of a text, in font sizes
WORDS = re.compile(r"(?:(?<!\\)\$.*?(?<!\\)\$|\S)+")  # a symbol is one word, whatever stands in it
SHORTEST = 3.0  # em of a last line of several that may stand alone
Box = tuple[float, float, float, float]  # left, bottom, right, top


FONTS = ("report-sans-regular", "report-symbols")


class Svg(NamedTuple):
    """A figure: SVG text without a prologue, and its natural size in points."""

    text: str
    width: float
    height: float


def drawn(build: Callable[[], Figure], title: str, key: str) -> Svg:
    """What ``build`` draws, in the report's style; ``key`` keeps its ids apart from those of the report's other figures."""
    with styled(key):
        return written(build(), title)


def styled(key: str) -> AbstractContextManager[None]:
    """Draw within with the settings of all figures, and with the report's fonts, by which matplotlib measures texts."""
    if not any(entry.name == "Report Sans" for entry in fontManager.ttflist):
        for name in FONTS:
            fontManager.addfont(font_file(name))
    settings: dict[Any, Any] = {
        "svg.fonttype": "none", "svg.hashsalt": key, "font.family": "Report Sans", "font.size": FONT_SIZE,
        "mathtext.fontset": "custom", "mathtext.rm": "Report Sans", "mathtext.it": "Report Symbols",
        "mathtext.cal": "Report Sans", "mathtext.sf": "Report Sans", "mathtext.tt": "Report Sans", "mathtext.bf": "Report Sans",
        "mathtext.bfit": "Report Symbols",
        "axes.edgecolor": INK, "axes.labelcolor": INK, "axes.linewidth": 0.6, "axes.unicode_minus": True,
        "axes.titlesize": FONT_SIZE, "axes.titlelocation": "left", "axes.grid": True, "grid.color": "#d5dbe1",
        "grid.linewidth": 0.4, "xtick.color": INK, "ytick.color": INK, "xtick.labelsize": 8, "ytick.labelsize": 8,
        "xtick.major.width": 0.6, "ytick.major.width": 0.6, "xtick.major.size": 3, "ytick.major.size": 3,
        "xtick.minor.width": 0.4, "xtick.minor.size": 1.8, "text.color": INK, "legend.frameon": False, "legend.fontsize": 8,
        "lines.linewidth": 1.2, "path.simplify": True, "path.simplify_threshold": 0.2, "legend.handlelength": 2.6,
    }  # fmt: skip
    return mpl.rc_context(settings)


def canvas(width: float, height: float) -> Figure:
    """An empty figure of a size in points."""
    figure = Figure(figsize=(width / 72, height / 72))
    TextCanvas(figure)
    return figure


WIDE, TALL = 60, 45  # letters along the sides of a figure of matplotlib's own size


class ShownFigure(Figure):
    """A figure that a notebook shows, also where pyplot, which would teach it to, is not loaded."""

    def _repr_png_(self) -> bytes:
        buffer = io.BytesIO()
        self.savefig(buffer, format="png")
        return buffer.getvalue()


def plotted(x: Any, y: Any, labels: tuple[str, str], axes: Any = None, **style: Any) -> Any:
    """Draw a line into axes of matplotlib, or into those of a figure of its own, with labels of several lines; return the axes."""
    axes = ShownFigure(layout="constrained").add_subplot() if axes is None else axes
    axes.plot(x, y, **style)
    axes.set(xlabel=fill(labels[0], WIDE), ylabel=fill(labels[1], TALL))
    return axes


def written(figure: Figure, title: str) -> Svg:
    """A drawn figure as SVG, without what would leak into the page that it stands in."""
    buffer = io.StringIO()
    figure.savefig(
        buffer, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None}, transparent=True
    )
    body = buffer.getvalue().rpartition("</metadata>")[2]
    body = body[body.index("<defs>") if "<defs>" in body[:400] else 0 :]
    body = re.sub(r"<style[^>]*>.*?</style>", "", body, count=1, flags=re.DOTALL)
    body = re.sub(r'<g id="[^"]*"', "<g", body)
    body = re.sub(r"<!--.*?-->\s*", "", body, flags=re.DOTALL)
    shorter = partial(re.sub, r"-?\d+\.\d{3,}", lambda found: f"{float(found[0]):.2f}".rstrip("0").rstrip("."))
    body = re.sub(r'="[^"]*\d\.\d{3}[^"]*"', lambda found: shorter(found[0]), body)
    body = re.sub(r"\n\s*", "\n", body[: body.rindex("</svg>")]).strip()
    width, height = (float(side) * 72 for side in figure.get_size_inches())
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 {width:.2f} {height:.2f}" '
        f'width="{width:.2f}pt" height="{height:.2f}pt" stroke-linejoin="round" role="img">'
    )
    return Svg(f"{head}<title>{escape(title)}</title>{body}</svg>", width, height)


_SYMBOL = re.compile(
    r"(?<!\w)([^\W\d_]{1,2}[′']?)(?:_(\w+))?(?= =)|^(?!(?:II|IV|VI|IX|XI)$)([^\W\d_]{1,2}[′']?)(?:_(\w+))?$"
)


def marked(text: str) -> str:
    """A text whose symbols (``R_b = 70 mm``, ``S``) are set as symbols, for matplotlib."""
    parts, start = [], 0
    said = tidy(text)
    for found in _SYMBOL.finditer(said):
        base, below = found[1] or found[3], found[2] or found[4]
        parts += [plain(said[start : found.start()]), f"${base.replace('′', chr(39))}"]
        parts.append(rf"_{{\mathrm{{{below}}}}}$" if below else "$")
        start = found.end()
    return "".join([*parts, plain(said[start:])])


def symbol(name: str) -> str:
    """A symbol for matplotlib: ``φ_22``, ``[σ]``; bars and brackets stand upright."""
    found = SYMBOL.fullmatch(name)
    if found is None:
        return plain(name)
    below = rf"_{{\mathrm{{{found['below'].replace('_', ' ')}}}}}" if found["below"] else ""
    letters = found["base"].replace("′", "'")
    return f"{plain(found['before'])}${letters}{below}${plain(found['after'])}"


def plain(text: str) -> str:
    """A text that matplotlib takes letter by letter."""
    return text.replace("$", r"\$")


def text_size(text: str, size: float = FONT_SIZE) -> tuple[float, float]:
    """Width and height of a text in points, a little air included; it may have several lines."""
    lines = text.split("\n")
    sizes = [_line_size(line, size) for line in lines]
    return max(wide for wide, _ in sizes), max(high for _, high in sizes) + (len(lines) - 1) * LINE * size


def wrapped(text: str, width: float, size: float = FONT_SIZE) -> str:
    """Return a text in lines no wider than so many points, broken between words; a longer word stands on a line of its own."""
    lines = in_lines(WORDS.findall(text), lambda longer: text_size(longer, size)[0] <= width)
    return "\n".join(_with_company(lines, size))


def in_lines(parts: Iterable[str], has_room: Callable[[str], bool]) -> list[str]:
    """Gather parts of a text into lines, each as long as it has room; a part without room stands on a line of its own."""
    lines: list[str] = []
    for part in parts:
        longer = f"{lines[-1]} {part}" if lines else part
        if lines and has_room(longer):
            lines[-1] = longer
        else:
            lines.append(part)
    return lines


def _with_company(lines: list[str], size: float) -> list[str]:
    """The lines, a last one that is a symbol or a unit alone with the word before it."""
    *before, last = lines
    if not before or text_size(last, size)[0] > SHORTEST * size or " " not in before[-1] or before[-1].count("$") % 2:
        return lines
    words = WORDS.findall(before[-1])
    return [*before[:-1], " ".join(words[:-1]), f"{words[-1]} {last}"] if len(words) > 1 else lines


def _line_size(text: str, size: float) -> tuple[float, float]:
    math = text.count("$") - text.count(r"\$") >= 2
    width, height, _ = MEASURE.get_text_width_height_descent(
        text, FontProperties(family="Report Sans", size=size), ismath=math
    )
    return float(width), max(float(height), 1.08 * size)


def overlap(one: Box, other: Box) -> float:
    """The area that two boxes share."""
    wide = min(one[2], other[2]) - max(one[0], other[0])
    high = min(one[3], other[3]) - max(one[1], other[1])
    return max(wide, 0) * max(high, 0)


class Labels:
    """Finds places for texts, clear of each other and of lines (all in points)."""

    def __init__(self, lines: NDArray[Any], limits: Box | None = None, weights: NDArray[Any] | None = None) -> None:
        self.lines = lines
        self.weights = np.full(len(lines), 8.0) if weights is None else weights
        self.limits = limits
        self.taken: list[Box] = []

    def place(self, size: tuple[float, float], centers: Iterable[tuple[float, float]]) -> tuple[float, float]:
        """The best of the proposed centres for a text of a size; earlier ones are liked better."""
        best, _ = self.best(size, centers)
        self.take(best, size)
        return best

    def best(
        self, size: tuple[float, float], centers: Iterable[tuple[float, float]]
    ) -> tuple[tuple[float, float], float]:
        """The best of the proposed centres, and how much stands in the way there."""
        found, lowest, least = (0.0, 0.0), 0.0, float("inf")
        for order, (x, y) in enumerate(centers):
            cost = self._cost((x - size[0] / 2, y - size[1] / 2, x + size[0] / 2, y + size[1] / 2))
            if cost + 0.4 * order < least:
                found, lowest, least = (x, y), cost, cost + 0.4 * order
        return found, lowest

    def take(self, center: tuple[float, float], size: tuple[float, float]) -> None:
        """Keep a box free of further texts, with the little air that letters below the line take."""
        x, y, high = *center, size[1] / 2 + BELOW
        self.taken.append((x - size[0] / 2, y - high, x + size[0] / 2, y + high))

    def _cost(self, box: Box) -> float:
        air = 2.5
        inside = (
            (self.lines[:, 0] > box[0] - air) & (self.lines[:, 0] < box[2] + air)
            & (self.lines[:, 1] > box[1] - air) & (self.lines[:, 1] < box[3] + air)
        )  # fmt: skip
        cost = min(float(self.weights[inside].sum()), 96.0) + 5.0 * sum(overlap(box, other) for other in self.taken)
        if self.limits:
            x0, y0, x1, y1 = self.limits
            cost += 50 * (max(x0 - box[0], 0) + max(box[2] - x1, 0) + max(y0 - box[1], 0) + max(box[3] - y1, 0))
        return cost


def sampled(points: NDArray[Any], step: float = 2.0) -> NDArray[Any]:
    """Points along a line of straight pieces, about ``step`` apart; pieces without end points are left out."""
    whole = np.isfinite(points).all(axis=1)
    clear = whole[:-1] & whole[1:]
    starts, reach = points[:-1][clear], (points[1:] - points[:-1])[clear]
    counts = np.maximum(2, (np.hypot(*reach.T) / step).astype(int) + 1)
    piece = np.repeat(np.arange(len(counts)), counts)
    order = np.arange(len(piece)) - (np.cumsum(counts) - counts)[piece]
    found: NDArray[Any] = starts[piece] + (order / (counts - 1)[piece])[:, None] * reach[piece]
    return found


# How large figures are: alone on a page that has room for all, alone and lower, one of two side by side, or a sketch.


class SizesSize(Enum):
    """The place that a figure has on the page."""

    LARGE = "large"
    LOW = "low"
    HALF = "half"
    SKETCH = "sketch"


WIDTHS = {size: (84 if size is SizesSize.HALF else 172) * MM for size in SizesSize}  # in points
WIDEST_HALF = 98 * MM  # a drawing with its texts, which is set a little smaller then
