"""Figures: what is drawn, where, that texts keep clear of lines and are measured once; figures that wait for the next sheet."""

from __future__ import annotations

import inspect
import math
import re
from collections.abc import Callable
from io import BytesIO, StringIO
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextToPath
from pypdf import PdfReader

import diecut_report.report.pages.pdf  # noqa: F401 - figures wait where reports are set
from diecut_report.report.chapters.tables import continuous, period_of, through_pole
from diecut_report.report.figures import by_type
from diecut_report.report.figures.by_type import render
from diecut_report.report.figures.charts import bars, polar
from diecut_report.report.figures.drawing import hatching
from diecut_report.report.figures.style import Labels, TextCanvas, TextMeasure, TextWriter, canvas, marked, written
from diecut_report.report.pages.page_engine import HTML
from diecut_report.report.pages.pdf_figures import FigurePicture
from diecut_report.report.text import Catalogue
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.mechanism_record import CurveRecord
from tests.records import filled
from tests.report.made_results import typed

WORDS = Catalogue("en")


def _figures(results: dict[str, Any]) -> list[tuple[FigureRecord, dict[str, CurveRecord]]]:
    return [(f, m.curves) for m in typed(results).mechanisms.values() for f in m.figures]


@pytest.mark.parametrize("every", [False, pytest.param(True, marks=pytest.mark.nightly)])
def test_each_kind_is_drawn_as_clean_svg(results: dict[str, Any], every: bool) -> None:
    figures = _figures(results)
    figures = figures if every else list({figure.type: (figure, curves) for figure, curves in figures}.values())
    assert {f.type for f, _ in figures} == {"plot", "chart", "polar", "bars", "drawing"}
    for figure, curves in figures:
        svg = render(figure, curves, WORDS, figure.id)
        root = ElementTree.fromstring(svg.text)
        assert root.find("{http://www.w3.org/2000/svg}title").text == figure.title  # type: ignore[union-attr]
        assert "<style" not in svg.text and "<!DOCTYPE" not in svg.text
        assert 0 < svg.width <= 174 * 72 / 25.4
        assert not re.search(r'="[^"]*\d\.\d{4,}', svg.text)


def test_printed_numbers_keep_their_digits(results: dict[str, Any]) -> None:
    bars = next((f, curves) for f, curves in _figures(results) if f.type == "bars")
    assert {"189.1", "−84.05", "0.636"} <= set(re.findall(r">([−\d.]+)<", render(*bars, WORDS, "x").text))


def test_same_figure_gives_same_bytes_and_own_ids(results: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(by_type, "kept", lambda _, draw: draw())
    figure, curves = _figures(results)[0]
    one, same, other = (render(figure, curves, WORDS, key).text for key in ("A.1", "A.1", "B.1"))
    assert one == same
    ids = [set(re.findall(r'id="([^"]+)"', text)) for text in (one, other)]
    assert not ids[0] & ids[1]


def test_title_is_escaped(results: dict[str, Any]) -> None:
    figure, curves = _figures(results)[1]
    svg = render(figure.with_(title="<script>&"), curves, WORDS, "x").text
    assert "<title>&lt;script&gt;&amp;</title>" in svg


def _over(values: list[float], unit: str = "rad", **more: Any) -> CurveRecord:
    return filled(CurveRecord, {"values": values, "unit": unit} | more)


def _curve(**more: Any) -> tuple[CurveRecord, CurveRecord]:
    return _over([0.0, 1.0, 2.0, 3.0], "N", **more), _over([k * math.pi / 2 for k in range(4)])


def test_jump_stands_at_its_true_place_with_both_values() -> None:
    curve, over = _curve(breakpoints=[2.0], left=[1.25], right=[9.0])
    x, y = continuous(curve, over, 2 * math.pi)
    where = np.nonzero(x == 2.0)[0]
    assert list(y[where]) == [1.25, 9.0]
    assert (np.diff(x) >= 0).all()


def test_jump_at_a_sample_replaces_the_sample() -> None:
    curve, over = _curve(breakpoints=[math.pi], left=[2.0], right=[7.0])
    x, y = continuous(curve, over, None)
    assert list(y[x == math.pi]) == [2.0, 7.0]


def _over_a_turn(shape: Callable[[float], float]) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
    angles = [2 * math.pi * k / 72 for k in range(72)]
    over = _over(angles)
    assert period_of(over) == 2 * math.pi
    return continuous(_over([shape(angle) for angle in angles], "N"), over, period_of(over))


@pytest.mark.parametrize(
    "shape", [math.cos, math.sin, lambda x: abs(math.sin(x)), lambda _: 3.0, lambda x: math.cos(36 * x)]
)
def test_full_turn_is_closed(shape: Callable[[float], float]) -> None:
    x, y = _over_a_turn(shape)
    assert x[-1] == pytest.approx(2 * math.pi)
    assert y[-1] == y[0]


@pytest.mark.parametrize("shape", [lambda x: x, lambda x: x - math.sin(x), lambda x: math.cos(x / 2)])
def test_curve_that_grows_over_the_turn_is_led_to_its_end_without_a_jump_back(shape: Callable[[float], float]) -> None:
    x, y = _over_a_turn(shape)
    assert x[-1] == pytest.approx(2 * math.pi)
    assert y[-1] == pytest.approx(shape(2 * math.pi), abs=0.01)


def test_part_of_a_turn_is_not_closed() -> None:
    assert period_of(_over([0.0, 0.1, 0.2, 0.3])) is None
    assert period_of(_over([0.0, 0.1, 0.2, 0.3], "s")) is None


def test_polar_curve_changes_its_sign_at_the_pole() -> None:
    x, y = through_pole(np.array([0.0, 1.0, 1.0, 2.0]), np.array([1.0, 1.0, -3.0, -3.0]))
    assert list(x) == [0.0, 1.0, 1.0, 1.0, 2.0]
    assert list(y) == [1.0, 1.0, 0.0, -3.0, -3.0]


def test_a_polar_diagram_keeps_the_range_that_it_declares() -> None:
    over = _over(np.linspace(0, 6, 40).tolist(), description="Turn", symbol="φ", display_unit="deg")
    curves = {"turn": over, "lift": _over([0.004] * 40, "m")}
    series = [{"curve": "lift", "label": "h"}]
    figure = filled(
        FigureRecord, {"type": "polar", "title": "Lift", "abscissa": "turn", "unit": "mm", "series": series}
    )

    def reach(**more: Any) -> tuple[float, float]:
        (axes,) = polar(figure.with_(**more), curves, WORDS).axes
        return axes.get_ylim()

    assert reach()[0] == 0 and 4 < reach()[1] < 5
    assert reach(range=[None, 0.006]) == (0, pytest.approx(6)) and reach(range=[0.003, None])[0] == pytest.approx(3)


def test_bars_with_a_declared_range_name_its_ends() -> None:
    group = {
        "label": "Masses",
        "unit": "kg",
        "bars": [{"label": "one", "value": 95.0}, {"label": "two", "value": 98.0}],
    }

    def axis(**more: Any) -> tuple[float, list[str]]:
        (axes,) = bars(filled(FigureRecord, {"type": "bars", "groups": [group | more]}), {}, WORDS).axes
        named = [text.get_text() for text in axes.get_xticklabels() if axes.xaxis.get_tick_params()["labelbottom"]]
        return axes.get_xlim()[0], named

    assert axis() == (pytest.approx(-0.02 * 98), [])
    assert axis(range=[90.0, None]) == (90, ["90", "98"])


def test_hatching_fills_the_section_and_leaves_its_hole() -> None:
    square = np.array([[0, 0], [100, 0], [100, 100], [0, 100], [0, 0]], dtype=float)
    hole = np.array([[25, 25], [75, 25], [75, 75], [25, 75], [25, 25]], dtype=float)
    starts, ends = hatching([square, hole], 2.0)
    lengths = np.hypot(*(ends - starts).T)
    assert lengths.sum() * 2.0 == pytest.approx(100 * 100 - 50 * 50, rel=0.02)
    middles = (starts + ends) / 2
    assert not ((middles > 26) & (middles < 74)).all(axis=1).any()


def test_text_keeps_clear_of_lines_and_other_texts() -> None:
    line = np.column_stack([np.linspace(0, 100, 60), np.zeros(60)])
    labels = Labels(line)
    first = labels.place((20, 8), [(50, 0), (50, 10)])
    second = labels.place((20, 8), [(52, 11), (52, 40)])
    assert [first, second] == [(50, 10), (52, 40)]


def test_text_stays_inside_its_limits() -> None:
    labels = Labels(np.empty((0, 2)), limits=(0, 0, 100, 100))
    assert labels.place((20, 8), [(95, 50), (80, 50)]) == (80, 50)


@pytest.mark.parametrize(("text", "set_as"), [
    ("R_b = 70 mm", r"$R_{\mathrm{b}}$ = 70 mm"), ("crank at φ = 98 °", "crank at $φ$ = 98°"), ("V", "$V$"),
    ("cost in $", r"cost in \$"), ("die", "die"), ("w = -5 mm", "$w$ = −5 mm"),
])  # fmt: skip
def test_symbols_of_a_drawing(text: str, set_as: str) -> None:
    assert marked(text) == set_as


def test_bars_stand_in_rows_where_names_and_titles_leave_no_room_beside_each_other() -> None:
    def groups(name: str) -> FigureRecord:
        one = {
            "bars": [{"label": f"{name} 1", "value": 5.0}, {"label": f"{name} 2", "value": 6.0}],
            "label": "Safety factors",
            "unit": "1",
        }
        return filled(FigureRecord, {"type": "bars", "groups": [one] * 4})

    def rows(name: str) -> int:
        return len({round(axes.get_position().y1, 3) for axes in bars(groups(name), {}, WORDS).axes})

    assert rows("gear") == 1
    assert rows("flank of the gear with the most teeth") > 1
    wide = bars(groups("flank of the gear with the most teeth"), {}, WORDS)
    points = wide.get_figwidth() * 72
    assert all(axes.get_position().width * points > 50 for axes in wide.axes)
    assert all(axes.get_position().x1 <= 1 for axes in wide.axes)


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


STYLE = (
    "@page { size: 100mm 101mm; margin: 0 } body { margin: 0 } html { font: 4mm/10mm sans-serif } p, h2 { margin: 0 }"
    "h2 { font-size: 4mm; break-after: avoid } figure { margin: 0; break-inside: avoid }"
)


def _sheets(*parts: str) -> list[str]:
    """What stands on each sheet, in its order: t1, F1 …"""
    page = HTML(string=f"<html><style>{STYLE}</style><body>{''.join(parts)}</body></html>")
    content = page.write_pdf()
    texts = [sheet.extract_text() for sheet in PdfReader(BytesIO(content)).pages]
    return [" ".join(re.findall(r"[tFC]\d+", text)) for text in texts]


def _text(first: int, last: int) -> str:
    return "".join(f"<p>t{n}</p>" for n in range(first, last + 1))


def _figure(number: int, height: int) -> str:
    """A figure so many lines high."""
    return f'<div class="waits"><figure><div style="height: {height * 10 - 10}mm"></div><p>F{number}</p></figure></div>'


def test_text_goes_on_where_a_figure_has_no_room() -> None:
    sheets = _sheets(_text(1, 7), _figure(1, 5), _text(8, 15))
    assert sheets == ["t1 t2 t3 t4 t5 t6 t7 t8 t9 t10", "F1 t11 t12 t13 t14 t15"]


def test_a_figure_that_has_room_stays_in_its_place() -> None:
    assert _sheets(_text(1, 5), _figure(1, 5), _text(6, 7)) == ["t1 t2 t3 t4 t5 F1", "t6 t7"]


def test_figures_keep_their_order() -> None:
    sheets = _sheets(_text(1, 6), _figure(1, 5), _text(7, 8), _figure(2, 2), _text(9, 15))
    assert sheets == ["t1 t2 t3 t4 t5 t6 t7 t8 t9 t10", "F1 F2 t11 t12 t13", "t14 t15"]


def test_a_figure_for_which_the_next_sheet_has_no_room_waits_for_the_one_after_it() -> None:
    sheets = _sheets(_text(1, 6), _figure(1, 6), _text(7, 8), _figure(2, 5), _text(9, 18))
    assert sheets == ["t1 t2 t3 t4 t5 t6 t7 t8 t9 t10", "F1 t11 t12 t13 t14", "F2 t15 t16 t17 t18"]
    chapter = "<section><h2>C1</h2><p>t9</p></section>"
    assert _sheets(_text(1, 6), _figure(1, 6), _figure(2, 5), _text(7, 7), chapter)[1:] == ["F1", "F2 C1 t9"]


def test_a_chapter_begins_behind_the_figures_of_the_one_before_it() -> None:
    sheets = _sheets(_text(1, 6), _figure(1, 5), _text(7, 7), "<section><h2>C1</h2>", _text(8, 9), "</section>")
    assert sheets == ["t1 t2 t3 t4 t5 t6 t7", "F1 C1 t8 t9"]


def test_a_figure_at_the_end_is_not_lost() -> None:
    assert _sheets(_text(1, 7), _figure(1, 5)) == ["t1 t2 t3 t4 t5 t6 t7", "F1"]
    assert _sheets(_text(1, 7), _figure(1, 5), _text(8, 8)) == ["t1 t2 t3 t4 t5 t6 t7", "F1 t8"]


def test_a_figure_stays_with_the_heading_before_it() -> None:
    sheets = _sheets(_text(1, 6), "<h2>C1</h2>", _figure(1, 5), _text(7, 8))
    assert sheets == ["t1 t2 t3 t4 t5 t6", "C1 F1 t7 t8"]


def test_a_text_that_has_no_room_below_the_waiting_figure_stands_on_the_sheet_after_it() -> None:
    block = '<div style="break-inside: avoid; height: 50mm"><p>t8</p></div>'
    sheets = _sheets(_text(1, 7), _figure(1, 8), block, _text(9, 9))
    assert sheets == ["t1 t2 t3 t4 t5 t6 t7", "F1", "t8 t9"]


def test_a_waiting_figure_is_tagged_and_linked_where_it_stands() -> None:
    figure = _figure(1, 5).replace("<figure>", '<figure id="fig">')
    page = HTML(string=f'<html><style>{STYLE}</style><body><p><a href="#fig">t1</a></p>{_text(2, 7)}{figure}{_text(8, 9)}</body></html>')  # fmt: skip
    reader = PdfReader(BytesIO(page.write_pdf()))
    place = reader.named_destinations["fig"]
    assert reader.get_destination_page_number(place) == 1
