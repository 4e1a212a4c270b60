"""Texts of figures: their sizes are the drawing engine's, each is measured once, and formulas stand in elements of several letters."""

from __future__ import annotations

import inspect
import re
from io import StringIO
from xml.etree import ElementTree

import pytest
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextToPath

from diecut_report.report.figures.style import TextCanvas, TextMeasure, TextWriter, canvas, written
from diecut_report.report.pages.pdf_figures import FigurePicture

TEXTS = ("die", "c = 164.9 mm", r"$R_{\mathrm{b}}$ = 70 mm", r"Displacement $S$, mm", r"$\varphi$")


@pytest.mark.parametrize("own", [TextMeasure, TextWriter, TextCanvas])
def test_only_what_the_drawing_engine_offers_is_put_in_the_place_of_its_own(own: type) -> None:
    """What begins with a low line the engine may rename in any version, and then a figure would be written in another way unnoticed."""
    known = {name for base in own.__mro__[1:] for name in vars(base)}
    private = [name for name in vars(own) if name.startswith("_") and not name.startswith("__") and name in known]
    hidden = re.findall(r"(?:self|font_?manager|renderer|super\(\))\._(?!_)\w+", inspect.getsource(own), re.IGNORECASE)
    assert private == [] and set(hidden) <= {f"self.{name}" for name in vars(own)}


@pytest.mark.usefixtures("style")
def test_texts_are_drawn_by_the_call_that_is_replaced(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the engine drew a formula in another way than by ``draw_text``, its letters would come one by one."""
    drawn: list[str] = []
    monkeypatch.setattr(TextMeasure, "placed", lambda _, s, prop: drawn.append(s) or [])
    written(_labelled("$S$ = 2"), "Title")
    assert drawn == ["$S$ = 2"]


def _labelled(text: str, *, turned: float = 0.0) -> Figure:
    figure = canvas(120, 40)
    figure.text(0.1, 0.5, text, rotation=turned)
    return figure


@pytest.mark.usefixtures("style")
@pytest.mark.parametrize("text", TEXTS)
@pytest.mark.parametrize("size", [6.0, 8.5])
def test_sizes_are_those_of_the_drawing_engine(text: str, size: float) -> None:
    font = FontProperties(family="Report Sans", size=size)
    asked = text, font, "$" in text
    assert TextMeasure().get_text_width_height_descent(*asked) == TextToPath().get_text_width_height_descent(*asked)


@pytest.mark.usefixtures("style")
def test_a_text_is_measured_once_for_all_sizes(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[str] = []
    original = TextToPath.get_text_width_height_descent

    def noted(self: TextToPath, s: str, prop: FontProperties, ismath: bool) -> tuple[float, float, float]:
        asked.append(s)
        found: tuple[float, float, float] = original(self, s, prop, ismath)
        return found

    monkeypatch.setattr(TextToPath, "get_text_width_height_descent", noted)
    measure = TextMeasure()
    wide = [
        measure.get_text_width_height_descent("die", FontProperties(family="Report Sans", size=size), False)[0]
        for size in (4, 8, 8)
    ]
    assert asked == ["die"] and wide[1] == pytest.approx(2 * wide[0]) and wide[1] == wide[2]


@pytest.mark.usefixtures("style")
@pytest.mark.parametrize("size", [6.0, 8.5])
def test_letters_of_a_formula_stand_where_the_drawing_engine_puts_them(size: float) -> None:
    font = FontProperties(family="Report Sans", size=size)
    *_, glyphs, _ = TextToPath().mathtext_parser.parse(r"$a_{\mathrm{cm}}$ = 2.5 m", 72, font)
    expected = sorted((x, -y, own, chr(code).replace(" ", "\u00a0")) for _, own, code, _, x, y in glyphs)
    placed = TextMeasure().placed(r"$a_{\mathrm{cm}}$ = 2.5 m", font)
    assert [each.sign for each in placed] == [sign for *_, sign in expected]
    for each, (x, y, own, _) in zip(placed, expected, strict=True):
        assert (each.x * size, each.size * size) == pytest.approx((x, own), abs=0.06)
        assert each.y * size == pytest.approx(y, abs=0.5)  # the engine rounds the line's place to its pixels


@pytest.mark.usefixtures("style")
def test_a_formula_is_written_in_the_order_in_which_it_is_read() -> None:
    drawn = written(_labelled(r"Velocity $V_{\mathrm{c}}$, m/s"), "Title")
    spans = [node.text for node in ElementTree.fromstring(drawn.text).iter("{http://www.w3.org/2000/svg}tspan")]
    assert spans == ["Velocity\u00a0", "V", "c", ",\u00a0m/s"]
    assert FigurePicture(*drawn).texts == ["Velocity\u00a0Vc,\u00a0m/s"]


@pytest.mark.usefixtures("style")
def test_a_turned_formula_is_turned_about_its_place() -> None:
    drawn = written(_labelled("$S$ = 2", turned=90.0), "Title")
    assert re.search(r'transform="translate\([\d.]+ [\d.]+\) rotate\(-90\)"', drawn.text)


@pytest.mark.usefixtures("style")
def test_heights_of_lines_are_those_of_the_drawing_engine() -> None:
    from matplotlib.backends.backend_svg import RendererSVG

    figure = _labelled("die\nsecond line")
    figure.dpi = 72  # as where a figure is written
    [text] = figure.texts
    boxes = [text.get_window_extent(kind(120, 40, StringIO())).bounds for kind in (RendererSVG, TextWriter)]
    assert isinstance(figure.canvas, TextCanvas) and boxes[0] == pytest.approx(boxes[1])
