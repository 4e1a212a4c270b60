"""Charts of lines that a mechanism brings itself: what is written where, gaps, areas, axes; what is zero everywhere is said in a sentence."""

from __future__ import annotations

import math
import re
from itertools import combinations
from typing import Any

import numpy as np
import pytest

from diecut_report.report.chapters.repetition import without_zero_diagrams
from diecut_report.report.chapters.steps import BEFORE, Place, Placed, told_once
from diecut_report.report.figures.by_type import render
from diecut_report.report.figures.charts import _of_curves, _of_lines, diagrams
from diecut_report.report.figures.charts import chart as sheet_of
from diecut_report.report.figures.diagram import STROKES, Diagram, legend
from diecut_report.report.figures.labels import SIZE, LabelLayout, PanelData, pieces
from diecut_report.report.figures.style import SizesSize, overlap, text_size
from diecut_report.report.text import Catalogue
from diecut_report.results.figure_record import FigureRecord, LevelRecord, PlotPanelRecord
from diecut_report.results.mechanism_record import CurveRecord, MechanismRecord
from tests.records import filled
from tests.report.made_figures import CHARTS, block, chart, energy, laws, line, panel, wedge

pytestmark = pytest.mark.usefixtures("style")
WORDS = Catalogue("en")
Data = dict[str, Any]
TURN = ("Angle", "φ", "deg")


def _texts(figure: FigureRecord) -> list[str]:
    """What stands in a figure, without blanks (texts with symbols are set letter by letter)."""
    svg = render(figure, {}, WORDS, "x").text
    groups = re.findall(r"<text.*?</text>", svg, re.DOTALL)
    return [re.sub(r"<[^>]*>|\s", "", group) for group in groups]


def _panels(figure: FigureRecord) -> list[PanelData]:
    return [_of_lines(each, WORDS) for each in figure.panels]


def _names(figure: FigureRecord, index: int = 0) -> LabelLayout:
    drawn = _panels(figure)[index]
    return LabelLayout(drawn, 430, 205)


# what is written
def test_marks_and_levels_tell_their_values_verticals_their_names() -> None:
    written = [text.text for text in _names(wedge()).texts]
    assert "chosen 2.009\u00a0kN (10°)" in written
    assert "greatest force of the cylinder 4.5\u00a0kN" in written
    assert "self-locking below this angle" in written


def test_phases_are_no_symbols() -> None:
    written = [text.text for text in _names(energy()).texts]
    assert {"I", "II", "III", "IV"} <= set(written)


def test_mark_without_a_name_is_only_marked() -> None:
    figure = chart(
        "x", "x", [panel("y", "N", TURN, lines=[line([0, 1], [0, 1])], marks=[{"x": 0.5, "y": 0.5, "label": ""}])]
    )
    assert _names(figure).texts == []


@pytest.mark.parametrize("build", CHARTS)
def test_texts_keep_clear_of_each_other_and_inside(build: Any) -> None:
    for each in _panels(build()):
        names = LabelLayout(each, 430, 150)
        boxes = []
        for text in names.texts:
            wide, high = (side / 2 for side in text_size(text.text, SIZE))
            assert text.x - wide >= 0 and text.x + wide <= 430 and text.y - high >= 0 and text.y + high <= 150, text
            boxes.append((text.x - wide, text.y - high, text.x + wide, text.y + high))
        assert sum(overlap(one, other) for one, other in combinations(boxes, 2)) == 0


@pytest.mark.parametrize("build", [wedge, block])
def test_notes_keep_clear_of_lines(build: Any) -> None:
    for each in _panels(build()):
        names = LabelLayout(each, 430, 150)
        points = np.concatenate([*names.lines, names.notes])
        for text in names.texts:
            if text.solid or text.text == "absorbed energy 75 J":  # on its line, or in its area
                continue
            wide, high = (side / 2 for side in text_size(text.text, SIZE))
            assert not ((np.abs(points[:, 0] - text.x) < wide) & (np.abs(points[:, 1] - text.y) < high)).any(), text


def test_the_title_of_an_axis_begins_with_a_capital() -> None:
    figure = chart("x", "x", [panel("y", "N", ("knife angle", "φ", "deg"), lines=[line([0, 1], [0, 1], "F")])])
    assert diagrams(figure, {}, WORDS)[0].across.title == "Knife angle"


# telling lines apart
def test_eight_lines_have_eight_strokes() -> None:
    assert len({(str(dashes), width) for _, dashes, width in STROKES}) == len(STROKES) == 8


def test_few_lines_have_a_legend_and_nothing_at_them() -> None:
    names = _names(energy(), 1)
    assert names.tags == ["$E$", "mean"]
    assert not any(text.solid for text in names.texts)


def test_many_lines_with_room_carry_their_names() -> None:
    names = _names(wedge())
    assert names.tags == [""] * 5
    tags = [text for text in names.texts if text.solid]
    assert [text.text for text in tags] == [f"$f$ = {f}" for f in (0.05, 0.1, 0.15, 0.2, 0.25)]
    for text, own in zip(tags, names.lines, strict=True):
        assert np.hypot(*(own - [text.x, text.y]).T).min() < 1e-9
        others = [other for other in names.lines if other is not own]
        assert min(np.hypot(*(other - [text.x, text.y]).T).min() for other in others) > 4


def test_many_lines_without_room_carry_numbers_which_the_legend_names() -> None:
    names = _names(laws(), 1)
    assert names.tags[0] == "1  cycloidal" and names.tags[6] == "7  polynomial 4-5-6-7"
    tags = [text for text in names.texts if text.solid]
    assert [text.text for text in tags] == list("1234567")
    for text, own in zip(tags, names.lines, strict=True):
        assert np.hypot(*(own - [text.x, text.y]).T).min() < 1e-9


def test_panels_of_the_same_lines_share_a_legend_in_rows() -> None:
    written = _texts(laws())
    assert sum("cycloidal" in text for text in written) == 1


def test_a_panel_names_in_its_legend_only_what_the_first_does_not() -> None:
    figure = laws()
    bounds = [LevelRecord(value=0.5, label="a bound whose long name has room nowhere among so many lines")]
    whole, bounded, last = figure.panels
    bounded = bounded.with_(levels=bounds, lines=bounded.lines[:5])
    figure = figure.with_(panels=[whole, bounded, last])
    first, second, _ = (Diagram(each, 400, 20) for each in diagrams(figure, {}, WORDS))
    before = list(second.told)
    second.follow(first)
    assert before[:5] == first.told[:5] and second.told == before[5:]


def test_a_legend_beside_the_title_is_not_said_again() -> None:
    turn = [line([0, 1], [0, 1], "left"), line([0, 1], [1, 0], "right")]
    first, second = (
        Diagram(each, 400, 60) for each in diagrams(chart("x", "x", [panel("y", "N", TURN, lines=turn)] * 2), {}, WORDS)
    )
    assert first.legend and first.legend.beside
    second.follow(first)
    assert second.legend is None


def test_legend_stands_beside_a_short_title_and_in_rows_where_it_is_long() -> None:
    assert legend([], 400, 50) is None
    short = legend(["coupler", "rocker"], 400, 50)
    assert short is not None and short.beside and short.rows == 1
    long = legend([f"a line with a long name, number {n}" for n in range(8)], 400, 50)
    assert long is not None and not long.beside and long.columns * long.rows >= 8 and long.columns < 8


# lines and areas
def test_null_breaks_a_line() -> None:
    with_gap = chart("x", "x", [panel("y", "N", TURN, lines=[line([0, 1, 2, 3, 4], [0, 1, math.nan, 1, 5], "F")])])
    [drawn] = _panels(with_gap)
    assert [len(piece) for piece in pieces(np.column_stack([drawn.lines[0].x, drawn.lines[0].y]))] == [2, 2]
    lines = re.findall(r'<path d="([^"]*)"[^>]*stroke: #0b5c8f', render(with_gap, {}, WORDS, "x").text)
    assert [path.count("M") for path in lines] == [2]


def test_pieces_run_from_left_to_right() -> None:
    points = np.array([[3.0, 1], [2, 1], [np.nan, 1], [5, 1], [np.nan, np.nan]])
    assert [piece.tolist() for piece in pieces(points)] == [[[2, 1], [3, 1]]]


def test_name_of_an_area_stands_in_it_or_in_the_legend() -> None:
    names = _names(energy())
    written = {text.text: text for text in names.texts}
    assert names.outside == [2]
    zero = names.frame.points(0, 0)[1]
    assert written["taken up"].y > zero > written["given back"].y
    assert "a very small area" not in written
    assert "averysmallarea" in _texts(energy())


def test_area_is_hatched_up_to_its_line() -> None:
    svg = render(block(), {}, WORDS, "x").text
    strokes = re.findall(r'<path d="([^"]*)"[^>]*stroke: #66717d; stroke-width: 0.35', svg)
    assert len(strokes) == 1 and strokes[0].count("M") > 30


@pytest.mark.parametrize("values", [[2.0, 2.0], [None, None], [0.0, 0.0]])
def test_line_without_a_range_is_drawn(values: list[float | None]) -> None:
    figure = chart("x", "x", [panel("y", "N", TURN, lines=[{"x": [0.0, 1.0], "y": values, "label": "F"}])])
    assert render(figure, {}, WORDS, "x").width > 0


def test_lone_point_is_drawn() -> None:
    figure = chart(
        "x",
        "x",
        [panel("y", "N", TURN, lines=[line([1.0], [1.0], "F")], marks=[{"x": 1.0, "y": 1.0, "label": "here"}])],
    )
    assert any("here1" in text for text in _texts(figure))


# axes
def test_abscissa_is_as_long_as_its_lines_and_no_turn() -> None:
    angles = np.linspace(0, 2 * math.pi, 72, endpoint=False)
    figure = chart("x", "x", [panel("y", "N", TURN, lines=[line(angles, np.sin(angles), "F")])])
    [drawn] = _panels(figure)
    assert (drawn.across.low, drawn.across.high) == pytest.approx((0, 355))


def test_marks_and_verticals_belong_to_the_range() -> None:
    figure = chart("x", "x", [panel("y", "N", ("Time", "t", "ms"), lines=[line([0.001, 0.002], [1, 2], "F")],
                                    marks=[{"x": 0.004, "y": 9.0, "label": "m"}], verticals=[{"x": -0.001, "label": "v"}])])  # fmt: skip
    [drawn] = _panels(figure)
    assert (drawn.across.low, drawn.across.high) == pytest.approx((-1, 4))
    assert drawn.heights[1] > 9


def test_each_panel_has_its_own_abscissa_or_they_share_one() -> None:
    own = _texts(block())
    assert sum("Deflection" in text for text in own) == sum("Allowablestress" in text for text in own) == 1
    assert sum("Shareofthetime" in text for text in _texts(laws())) == 1


@pytest.mark.parametrize(
    ("low", "high", "shown"), [(5.0, 10.0, False), (4.0, 10.0, True), (-3.0, 1.0, True), (-10.0, -8.0, False)]
)
def test_zero_is_shown_where_it_is_near(low: float, high: float, shown: bool) -> None:
    [drawn] = _panels(chart("x", "x", [panel("y", "N", TURN, lines=[line([0, 1], [low, high], "F")])]))
    assert (drawn.heights[0] <= 0 <= drawn.heights[1]) is shown


def test_no_room_is_wasted_below_zero() -> None:
    [drawn] = _panels(chart("x", "x", [panel("y", "N", TURN, lines=[line([0, 1], [0, 10], "F")])]))
    assert -0.5 < drawn.heights[0] < 0


def test_level_beyond_a_curve_is_seen() -> None:
    time = {"values": [0.0, 1.0, 2.0], "unit": "s", "display_unit": "s", "description": "Time", "symbol": "t"}
    force = filled(CurveRecord, {"values": [1.0, 2.0, 1.0], "unit": "N"})
    series, levels = [{"curve": "f", "label": "F"}], [{"value": 9.0, "label": "allowed"}]
    own = PlotPanelRecord(title="Force", unit="N", series=series, levels=levels, marks=[], spans=[])
    drawn = _of_curves(own, {"f": force}, filled(CurveRecord, time), WORDS)
    assert drawn.heights[0] < 0 < 9 < drawn.heights[1]


@pytest.mark.parametrize("count", [1, pytest.param(4, marks=pytest.mark.nightly), 9])
def test_chart_stays_on_its_page(count: int) -> None:
    each = panel("y", "N", TURN, lines=[line([0, 1], [0, 1], "F")])
    svg = render(
        chart("x", "x", [each | {"x": each["x"] | {"title": f"Angle {n}"}} for n in range(count)]), {}, WORDS, "x"
    )
    assert svg.height <= 660 and svg.width <= 174 * 72 / 25.4


def test_symbol_of_an_abscissa_may_hold_more_than_letters() -> None:
    figure = chart("x", "x", [panel("y", "N", ("Sweep", "γ_3(3+1)", "deg"), lines=[line([0, 1], [0, 1], "F")])])
    assert any(
        text.replace(" ", "").startswith("Sweepγ3(3+1)") or "3(3+1)" in text.replace(" ", "") for text in _texts(figure)
    )


def test_head_of_a_diagram_leaves_room_for_its_legend() -> None:
    one, many = (Diagram(_panels(figure)[0], 430, 118) for figure in (block(), laws()))
    assert many.head > one.head


# room
def test_names_of_a_legend_are_broken_where_they_are_wider_than_the_diagram() -> None:
    long = "stress at the governing place of the shaft (a keyseat made by an end mill) with its required safety"
    figure = chart(
        "c", "Chart", [panel("Stress", "MPa", TURN, lines=[line([0, 1], [0, 1], long), line([0, 1], [1, 0], "other")])]
    )
    narrow = Diagram(_panels(figure)[0], 180, 96)
    assert any("\n" in text for text in narrow.told)
    assert all(text_size(each)[0] <= 180 for text in narrow.told for each in text.split("\n"))
    assert narrow.legend and narrow.legend.rows >= sum(text.count("\n") + 1 for text in narrow.told)


def test_many_diagrams_stand_two_by_two_where_the_sheet_is_to_be_saved() -> None:
    figure = chart("c", "Chart", [panel(f"Panel {n}", "mm", TURN, lines=[line([0, 1], [0, 1], "a")]) for n in range(4)])

    def places(size: SizesSize) -> list[tuple[float, float]]:
        axes = sheet_of(figure, {}, WORDS, size).axes
        return [(round(each.get_position().x0, 3), round(each.get_position().y0, 3)) for each in axes]

    assert len({x for x, _ in places(SizesSize.LOW)}) == 2 and len({y for _, y in places(SizesSize.LOW)}) == 2
    assert len({x for x, _ in places(SizesSize.LARGE)}) == 1


def test_points_that_are_counted_have_whole_numbers_below() -> None:
    marks = [{"x": float(n), "y": 1.0, "label": f"part {n}"} for n in (1, 2, 3)]
    figure = chart(
        "c", "Chart", [panel("Life", "1", ("Part", "", "1"), lines=[line([0.5, 3.5], [0, 0], "a")], marks=marks)]
    )
    (axes,) = sheet_of(figure, {}, WORDS, SizesSize.LOW).axes
    low, high = axes.get_xlim()
    assert [tick for tick in axes.get_xticks() if low <= tick <= high] == [1, 2, 3]


CURVES = {"torque": {"values": [0.0, 1e-14, -0.0]}, "moment": {"values": [0.0, 5.0, 2.0]}}


def zero_panel(title: str, *curves: str, **more: Any) -> dict[str, Any]:
    return {"title": title, "unit": "N*m", "series": [{"curve": name, "label": ""} for name in curves], **more}


def machine(*panels: dict[str, Any]) -> MechanismRecord:
    figure = {
        "id": "along",
        "title": "Along",
        "caption": "Over the shaft.",
        "type": "plot",
        "panels": list(panels),
        "shows": ["torque"],
    }
    items = [{"type": "formula", "id": "torque"}, {"type": "formula", "id": "moment"}]
    data = {"figures": [figure], "curves": CURVES, "sections": [{"title": "Loads", "items": items}]}
    return filled(MechanismRecord, data)


def test_a_diagram_that_is_zero_everywhere_is_a_sentence_of_the_caption() -> None:
    [figure] = without_zero_diagrams(
        machine(zero_panel("Torque", "torque"), zero_panel("Moment", "moment")), WORDS
    ).figures
    assert [each.title for each in figure.panels] == ["Moment"]
    assert figure.caption == "Over the shaft. Torque: 0 everywhere."


def test_a_figure_that_is_zero_everywhere_is_a_note_behind_the_step_that_it_shows() -> None:
    found = without_zero_diagrams(machine(zero_panel("Torque", "torque")), WORDS)
    assert found.figures == []
    assert [item.type for item in found.sections[0].items] == ["formula", "note", "formula"]
    assert found.sections[0].items[1].text == "Torque: 0 everywhere."


def test_a_zero_line_beside_another_or_under_a_limit_is_drawn() -> None:
    both, limited = (
        zero_panel("Both", "torque", "moment"),
        zero_panel("Torque", "torque", levels=[{"value": 3.0, "label": "allowed"}]),
    )
    [figure] = without_zero_diagrams(machine(both, limited), WORDS).figures
    assert len(figure.panels) == 2


def test_a_long_sentence_of_a_caption_is_told_once_and_a_short_one_each_time() -> None:
    long = "Angles count from the middle of the motion: what the results call α above 180° is here 360° less, in the same place."
    captions = [f"Motion of the wheel. {long} Shaded: dwell.", f"Motion of the sheet. {long} Shaded: dwell.", long]
    drawn = [filled(FigureRecord, {"caption": caption}) for caption in captions]
    figures = [Placed(Place(0, BEFORE), f"G.{n}", figure) for n, figure in enumerate(drawn, 1)]
    found = [each.figure.caption for each in told_once(figures)]
    assert found == [captions[0], "Motion of the sheet. Shaded: dwell.", ""]
