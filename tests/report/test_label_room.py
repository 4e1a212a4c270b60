"""The texts of figures, as matplotlib sets them: none over another, none out of the picture."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from io import StringIO
from itertools import combinations
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from matplotlib.backends.backend_svg import RendererSVG
from matplotlib.text import Text

from diecut_report.config.plugins import Discovery
from diecut_report.press import Press
from diecut_report.report.chapters.steps import placed, rows_of
from diecut_report.report.figures.by_type import DRAW
from diecut_report.report.figures.labels import AWAY, SIZE, Across, ChartLine, LabelLayout, Note, PanelData, SpanData
from diecut_report.report.figures.style import SizesSize, styled, text_size, wrapped
from diecut_report.report.text import Catalogue, translated
from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.mechanism_record import CurveRecord, MechanismRecord
from diecut_report.results.model import ResultsRecord
from diecut_report.text.catalogues import Catalogues
from tests.configs import EXAMPLES
from tests.records import filled
from tests.report.made_figures import chart, line, panel
from tests.report.made_results import typed

TAIL = 2.2  # points of a line of text below its letters: so much two boxes may share without a letter touching another
EDGE = 0.5


class Box(NamedTuple):
    """A text with the box that it is set in, in points."""

    text: str
    left: float
    bottom: float
    right: float
    top: float


def _boxes(
    figure: FigureRecord, curves: Mapping[str, CurveRecord], size: SizesSize, language: str = "en"
) -> tuple[list[Box], float, float]:
    """The texts that are really drawn (ticks beyond an axis are not), and the size of the picture."""
    drawn: dict[Text, None] = {}
    draw = Text.draw

    def noted(self: Text, renderer: Any) -> None:
        if self.get_visible() and self.get_text().strip():
            drawn[self] = None
        draw(self, renderer)

    with styled("x"), pytest.MonkeyPatch.context() as patch:
        sheet = DRAW[figure.type](figure, curves, Catalogue(language), size)
        patch.setattr(Text, "draw", noted)
        sheet.set_dpi(72)
        renderer = RendererSVG(*(side * 72 for side in sheet.get_size_inches()), StringIO())
        sheet.draw(renderer)
        found = [Box(text.get_text(), *text.get_window_extent(renderer).extents) for text in drawn]
    width, height = (side * 72 for side in sheet.get_size_inches())
    return found, width, height


def _faults(
    figure: FigureRecord, curves: Mapping[str, CurveRecord], size: SizesSize, language: str = "en"
) -> Iterator[str]:
    boxes, width, height = _boxes(figure, curves, size, language)
    for box in boxes:
        if min(box.left, box.bottom) < -EDGE or box.right > width + EDGE or box.top > height + EDGE:
            yield f"{figure.id}: {box.text!r} leaves the picture"
    for one, other in combinations(boxes, 2):
        wide, high = (
            min(one.right, other.right) - max(one.left, other.left),
            min(one.top, other.top) - max(one.bottom, other.bottom),
        )
        if wide > EDGE and high > TAIL:
            yield f"{figure.id}: {one.text!r} over {other.text!r}"


Drawn = tuple[FigureRecord, Mapping[str, CurveRecord], SizesSize]
"""A figure, the curves that it shows, and how large it stands."""


def _drawn(results: ResultsRecord, *, paired: bool) -> Iterator[Drawn]:
    for part in (part for part in results.calculated.values() if part.figures):
        for row in rows_of(placed("A", part), paired=paired):
            size = SizesSize.HALF if len(row) > 1 else SizesSize.LOW if paired else SizesSize.LARGE
            yield from ((e.figure, part.curves, size) for e in row if not e.figure.error)


def _every(results: ResultsRecord, *, paired: bool, language: str = "en") -> list[str]:
    drawn = list(_drawn(translated(results, Catalogues(language)), paired=paired))
    assert drawn
    return [fault for each in drawn for fault in _faults(*each, language)]


@pytest.mark.parametrize("paired", [False, True], ids=["large", "side by side"])
def test_texts_of_figures_keep_clear_of_each_other_and_of_the_edge(results: dict[str, Any], paired: bool) -> None:
    """Of each type and size of figure the one with most in it; all of them, and those of the examples, at night."""
    fullest: dict[Any, Drawn] = {}
    for each in sorted(_drawn(typed(results), paired=paired), key=lambda each: len(json.dumps(each[0].data()))):
        fullest[each[0].type, each[2]] = each
    assert len(fullest) > 2
    assert [fault for each in fullest.values() for fault in _faults(*each)] == []


@pytest.mark.nightly
@pytest.mark.parametrize("paired", [False, True], ids=["large", "side by side"])
def test_texts_of_all_figures_keep_clear(results: dict[str, Any], paired: bool) -> None:
    assert _every(typed(results), paired=paired) == []


@pytest.mark.nightly
@pytest.mark.parametrize("paired", [False, True], ids=["large", "side by side"])
@pytest.mark.parametrize("config", EXAMPLES, ids=lambda path: path.stem)
@pytest.mark.parametrize("language", ["en", "uk"])
def test_texts_of_figures_keep_clear_in_every_example(config: Path, paired: bool, language: str) -> None:
    assert _every(Press.read(config, Discovery([])).calculate().results, paired=paired, language=language) == []


def test_a_diagram_of_many_lines_is_as_wide_as_the_sheet() -> None:
    over = ("Angle", "φ", "deg")
    few, many = ([line([0, 1], [0, n], f"law {n}") for n in range(count)] for count in (6, 7))
    narrow, wide = (
        filled(MechanismRecord, {"figures": [chart("x", "x", [panel("y", "N", over, lines=lines)])] * 2})
        for lines in (few, many)
    )
    assert [len(row) for row in rows_of(placed("A", narrow), paired=True)] == [2]
    assert [len(row) for row in rows_of(placed("A", wide), paired=True)] == [1, 1]


def _layout(
    lines: list[ChartLine], width: float = 182.0, height: float = 96.0, reach: float = 10.0, **more: Any
) -> LabelLayout:
    """The texts of a diagram from 0 to ``reach``, so many points large."""
    across = Across("x", "x", "1", 0.0, reach)
    return LabelLayout(PanelData(title="T", unit="1", across=across, lines=lines, **more), width, height)


@pytest.mark.usefixtures("style")
def test_titles_that_are_wider_than_their_diagram_stand_in_lines() -> None:
    """Two long titles and a legend in rows, in the narrowest size."""
    line = {"x": [0.0, 1.0], "y": [0.0, 1.0], "label": ""}
    template = "A quantity with so long a name that no narrow diagram has room for it in one line"
    panel = {
        "title": template, "unit": "mm", "x": {"title": template, "symbol": "φ", "unit": "deg"}, "fills": [], "marks": [],
        "lines": [line | {"label": f"law number {n} with a long name"} for n in range(3)], "levels": [], "verticals": [],
    }  # fmt: skip
    figure = chart("narrow", "Narrow", [panel, panel])
    assert list(_faults(figure, {}, SizesSize.HALF)) == []
    assert sum("\n" in box.text for box in _boxes(figure, {}, SizesSize.HALF)[0]) == 3


def _crowded(line_count: int = 3) -> LabelLayout:
    """Five marks close together, a level through steep curves, and a named range, in a diagram 400 by 90 points large."""
    x = np.linspace(0.0, 10.0, 400)
    lines = [ChartLine(x, 5 + 5 * np.sin(8 * x + phase), "") for phase in (0.0, 1.0, 2.0)[:line_count]]
    marks = [Note(5.0 + 0.2 * n, 5.0, f"place {n} of five 1.234") for n in range(5)]
    return _layout(
        lines, 400.0, 90.0, marks=marks, levels=[Note(0.0, 5.0, "allowed")], spans=[SpanData(2.0, 8.0, "stroke")]
    )


@pytest.mark.usefixtures("style")
def test_a_name_that_stands_away_from_its_mark_has_a_line_to_it() -> None:
    layout = _crowded(line_count=0)
    names = [text for text in layout.texts if text.text.startswith("place")]
    assert len(names) == 5
    for name, mark in zip(names, layout.panel.marks, strict=True):
        x, y = layout.frame.points(mark.x, mark.y)
        if name.leader is None:
            assert abs(name.y - y) < AWAY + 10 and abs(name.x - x) < AWAY + 60
        else:
            assert name.leader[:2] == pytest.approx((x, y))
    assert any(name.leader for name in names)


@pytest.mark.usefixtures("style")
def test_a_name_does_not_cover_a_curve_however_narrow_the_diagram() -> None:
    """A falling curve, above it the names of two verticals: a mark's name has room across both of them, or in the legend."""
    x = np.linspace(0.02, 0.9, 200)
    layout = _layout([ChartLine(x, 0.4 / (x + 0.4), "")], reach=0.9, marks=[Note(0.4444, 0.4 / 0.8444, "this machine 0.2727 (0.4444)")],
                     verticals=[Note(0.54, 0.0, "return too short"), Note(0.6, 0.0, "no return")])  # fmt: skip
    curve = np.concatenate(layout.lines)
    for text in layout.texts:
        wide, high = text_size(text.text, SIZE)
        assert not ((np.abs(curve[:, 0] - text.x) < wide / 2) & (np.abs(curve[:, 1] - text.y) < high / 2)).any()
    assert len(layout.texts) + len(layout.told) == 3


@pytest.mark.usefixtures("style")
@pytest.mark.parametrize(("what", "heights"), [("verticals", (0.0,)), ("marks", (4.25, 5.75))])
def test_the_name_of_a_level_hides_no_mark_and_cuts_no_line_across(what: str, heights: tuple[float, ...]) -> None:
    """Where these stand so near to each other that it has no room between them it stands in the legend."""
    notes = [Note(x, y, "") for x in np.linspace(0.5, 9.5, 6) for y in heights]
    rising = ChartLine(np.array([0.0, 10.0]), np.array([0.0, 10.0]), "")
    layout = _layout([rising], levels=[Note(0.0, 5.0, "allowed level")], **{what: notes})
    assert layout.told == [("levels", 0)] and not layout.texts


@pytest.mark.usefixtures("style")
def test_a_vertical_line_through_several_diagrams_is_named_once() -> None:
    each = panel(
        "y", "N", ("Angle", "φ", "deg"), lines=[line([0, 1], [0, 1])], verticals=[{"x": 0.5, "label": "contact"}]
    )
    found = _boxes(chart("x", "x", [each, each, each]), {}, SizesSize.LARGE)[0]
    assert [box.text for box in found].count("contact") == 1


def test_a_diagram_with_many_names_is_as_wide_as_the_sheet() -> None:
    few = panel("y", "N", ("Angle", "φ", "deg"), verticals=[{"x": 0.5, "label": "contact"}] * 3)
    many = few | {"marks": [{"x": 0.5, "y": 0.5, "label": "greatest"}]}
    narrow, wide = (filled(MechanismRecord, {"figures": [chart("x", "x", [each])] * 2}) for each in (few, many))
    assert [len(row) for row in rows_of(placed("A", narrow), paired=True)] == [2]
    assert [len(row) for row in rows_of(placed("A", wide), paired=True)] == [1, 1]


@pytest.mark.usefixtures("style")
def test_a_name_that_has_no_room_beside_the_lines_stands_in_the_legend_and_covers_none() -> None:
    layout = _crowded()
    assert layout.told == [*(("marks", n) for n in range(5)), ("levels", 0)]
    assert [text.text for text in layout.texts] == ["stroke"]


@pytest.mark.usefixtures("style")
def test_the_legend_names_such_marks_and_levels_by_their_signs() -> None:
    x = np.linspace(0.0, 2 * np.pi, 200)
    wave = {"x": list(x), "y": list(100 * np.sin(7 * x)), "label": "torque"}
    mark = {"x": 1.57, "y": 99.0, "label": "maximum driving torque of the turn"}
    panel = {
        "title": "Torque", "unit": "N*m", "x": {"title": "Angle", "symbol": "φ", "unit": "deg"}, "fills": [], "marks": [mark],
        "lines": [wave], "levels": [{"value": 30.0, "label": "mean of the whole turn"}], "verticals": [],
    }  # fmt: skip
    figure = chart("narrow", "Narrow", [panel])
    boxes = {box.text: box for box in _boxes(figure, {}, SizesSize.HALF)[0]}
    names = [box for text, box in boxes.items() if text.startswith(("maximum driving", "mean of"))]
    assert len(names) == 2 and all(box.bottom > boxes["Torque, N·m"].top - 20 for box in names)
    assert list(_faults(figure, {}, SizesSize.HALF)) == []


@pytest.mark.usefixtures("style")
def test_a_name_does_not_cover_other_marks() -> None:
    """Stress amplitudes of seven places under a limit that falls to the right, one of them with a long name: it stands in the legend."""
    turn = np.linspace(0, np.pi / 2, 91)
    places = [(0.0, 0.0), (20.0, 0.0), (30.0, 10.0), (60.0, 18.0), (73.0, 27.0), (43.1, 34.0), (43.3, 45.4)]
    marks = [Note(x, y, "notch 2 (keyseat end mill) 45.43 MPa (43.32 MPa)" if y > 40 else "") for x, y in places]
    layout = _layout([ChartLine(148 * np.cos(turn), 86 * np.sin(turn), "")], reach=148.0, marks=marks)
    points = np.array([layout.frame.points(note.x, note.y) for note in marks])
    for text in layout.texts:
        wide, high = text_size(text.text, SIZE)
        assert not ((np.abs(points[:, 0] - text.x) < wide / 2) & (np.abs(points[:, 1] - text.y) < high / 2)).any()


@pytest.mark.usefixtures("style")
def test_the_name_of_an_area_covers_no_line_within_it() -> None:
    x = np.linspace(0.0, 10.0, 100)
    lines = [ChartLine(x, 5 + 4 * np.sin(3 * x) * share, "") for share in (0.2, 0.4, 0.6, 0.8)]
    lines += [ChartLine(x, 0 * x + level, "") for level in (1, 2, 3, 4)]
    assert _layout(lines, fills=[ChartLine(x, 0 * x + 9.0, "whole tension")]).outside == [0]


def test_a_symbol_does_not_stand_alone_on_the_last_line_of_a_title() -> None:
    title = "Cycle angle, one revolution per period of the torque $φ$, °"
    wide = text_size(title.removesuffix(" $φ$, °"))[0] + 2
    assert wrapped(title, wide).split("\n")[-1] == "torque $φ$, °"
