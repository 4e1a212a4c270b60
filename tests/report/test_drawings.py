"""Drawings: arrows, boxes, schematics, many texts, very wide and very tall ones."""

from __future__ import annotations

import math
import re
from itertools import combinations
from typing import Any

import numpy as np
import pytest

from diecut_report.report.figures.by_type import render
from diecut_report.report.figures.drawing import (
    LARGEST,
    PAD,
    PAGE,
    SIZES,
    Shapes,
    beyond,
    content,
    filled,
    folded,
    hatching,
)
from diecut_report.report.figures.style import FONT_SIZE, MM, SizesSize, marked, overlap, text_size
from diecut_report.report.text import Catalogue
from diecut_report.results.figure_record import BoxRecord, FigureRecord
from tests.examples import few
from tests.report.made_figures import (
    DRAWINGS,
    arrow,
    belt,
    box,
    chain,
    circle,
    conveyor,
    drawing,
    forces,
    label,
    polyline,
    press,
    row_of_boxes,
)

pytestmark = pytest.mark.usefixtures("style")
WORDS = Catalogue("en")
Data = dict[str, Any]


def _sheet(figure: FigureRecord) -> Shapes:
    sheet = Shapes(figure, WORDS, LARGEST)
    sheet.finish()
    return sheet


def _svg(figure: FigureRecord) -> Any:
    return render(figure, {}, WORDS, "x")


# arrows
def _heads(figure: FigureRecord) -> list[np.ndarray[Any, Any]]:
    """The corners of all heads of arrows (in a schematic nothing else is filled)."""
    return [np.asarray(patch.get_xy())[:3] for patch in _sheet(figure.with_(schematic=True, unit="1")).axes.patches]


@pytest.mark.parametrize("size", [0.01, 1.0, 100.0])
def test_head_of_an_arrow_has_its_size_on_paper(size: float) -> None:
    [head] = _heads(drawing("x", "x", [arrow((0, 0), (3 * size, 4 * size))]))
    back = (head[1] + head[2]) / 2
    assert np.hypot(*(head[0] - back)) == pytest.approx(5.5 + 2.2 * 1.2)
    assert (head[0] - back) @ [3, 4] == pytest.approx(5 * np.hypot(*(head[0] - back)))  # it points along the arrow


def test_head_is_no_longer_than_its_arrow() -> None:
    figure = drawing("x", "x", [polyline([(0, 0), (1, 0)]), arrow((0.5, 0.1), (0.505, 0.1))])
    [head] = _heads(figure)
    assert np.hypot(*(head[0] - (head[1] + head[2]) / 2)) == pytest.approx(0.005 * LARGEST[0])


def test_arrow_of_no_length_is_a_point_with_its_name() -> None:
    figure = drawing("x", "x", [polyline([(0, 0), (1, 0)]), arrow((0.5, 0.1), (0.5, 0.1), "no force")])
    assert _heads(figure) == []
    assert ">no force<" in _svg(figure).text


def test_arrow_between_the_middles_of_boxes_runs_from_edge_to_edge() -> None:
    boxes = [box((0, 0), (1, 1), "a"), box((3, 0), (1, 1), "b")]
    sheet = _sheet(drawing("x", "x", [*boxes, arrow((0, 0), (3, 0))], "1", schematic=True))
    [shaft] = sheet.axes.lines
    half = filled(sheet.shapes[0], sheet.scale)[1][0] / 2
    x = np.asarray(shaft.get_xdata())
    assert x[0] == pytest.approx(half)
    assert half < x[1] < 3 * sheet.scale.across - half


@pytest.mark.parametrize(("start", "end", "left"), [
    ((0, 0), (4, 0), (1, 0)), ((0, 0), (4, 4), (1, 1)), ((0.5, 0), (0.5, -9), (0.5, -1)), ((1, 0), (3, 0), (1, 0)),
    ((2, 0), (4, 0), (2, 0)), ((0.2, 0), (0.8, 0), (0.2, 0)),
])  # fmt: skip
def test_way_out_of_a_box(start: Any, end: Any, left: Any) -> None:
    found = beyond(np.array(start, dtype=float), np.array(end, dtype=float), np.zeros(2), np.ones(2))
    assert found == pytest.approx(left)


# boxes
@pytest.mark.parametrize(
    "figure",
    [chain(), *few([row_of_boxes(3), row_of_boxes(5), row_of_boxes(9)], keep=lambda figure: figure.id == "row5")],
    ids=lambda f: f.id,
)
def test_text_fits_its_box_and_can_be_read(figure: FigureRecord) -> None:
    sheet = _sheet(figure)
    boxes = [shape for shape in figure.shapes if isinstance(shape, BoxRecord)]
    for shape in boxes:
        lines, size = filled(shape, sheet.scale)
        assert (content(lines, sheet.scale.text) + PAD <= size + 1e-9).all()
        assert " ".join(lines) == " ".join(shape.lines)  # nothing is lost
    assert sheet.scale.text in SIZES and min(SIZES) >= 6.5


def test_schematic_is_stretched_before_its_text_is_made_smaller() -> None:
    tall = box((0, 0), (1, 0.2), "one", "two", "three", "four", "five")
    sheet = _sheet(drawing("x", "x", [tall, box((2, 0), (1, 0.2), "a")], "1", schematic=True))
    assert sheet.scale.text == SIZES[0]
    assert sheet.scale.upwards > sheet.scale.across


def test_boxes_in_a_row_do_not_overlap() -> None:
    sheet = _sheet(row_of_boxes(5))
    assert sum(overlap(one, other) for one, other in combinations(sheet.solid, 2)) == 0


def test_a_few_boxes_are_not_blown_up() -> None:
    shapes = [box((0, 0), (1, 0.5), "motor"), box((2, 0), (1, 0.5), "wheel")]
    assert _svg(drawing("x", "x", shapes, "1", schematic=True)).width < 120 * MM


def test_drawing_to_scale_is_not_stretched() -> None:
    shapes = [box((0, 0), (0.1, 0.002), "a very long text in a box that is far too low for it"), circle((0, 0), 0.1)]
    sheet = _sheet(drawing("x", "x", shapes))
    assert sheet.scale.across == sheet.scale.upwards


@pytest.mark.parametrize(("unit", "has_bar"), [("mm", True), ("N", True), ("1", False)])
def test_a_drawing_without_a_unit_has_no_scale_bar(unit: str, has_bar: bool) -> None:
    sheet = _sheet(drawing("x", "x", [circle((0, 0), 1.0)], unit))
    assert bool([text for text in sheet.axes.texts if text.get_text().endswith(unit)]) is has_bar


def test_round_things_stay_round_in_a_stretched_schematic() -> None:
    tall = box((0, 0), (1, 0.2), "one", "two", "three", "four", "five")
    sheet = _sheet(drawing("x", "x", [tall, circle((3, 0), 0.3)], "1", schematic=True))
    points = np.column_stack(sheet.axes.lines[0].get_data())
    assert np.ptp(points[:, 0]) == pytest.approx(np.ptp(points[:, 1]), rel=0.02)


# folding
@pytest.mark.parametrize(("text", "width", "lines"), [
    ("pulley 1, r = 51 mm, wrap 23°", 1e9, ["pulley 1, r = 51 mm, wrap 23°"]),
    ("pulley 1, r = 51 mm, wrap 23°", 90, ["pulley 1, r = 51 mm,", "wrap 23°"]),
    ("pulley 1, r = 51 mm, wrap 23°", 0, ["pulley 1,", "r = 51 mm,", "wrap 23°"]),
    ("P = 19.39 kW", 0, ["P = 19.39 kW"]),
    ("1450 rpm · 5.11 N·m", 0, ["1450 rpm · 5.11 N·m"]),
    ("main shaft", 0, ["main", "shaft"]),
    ("", 0, [""]),
])  # fmt: skip
def test_texts_are_folded_behind_commas_or_between_words_and_units_stay(
    text: str, width: float, lines: list[str]
) -> None:
    assert folded(text, width) == lines


# pages
def _is_to_scale(svg: str) -> bool:
    """Whether there is a scale bar: its white half, drawn last."""
    return re.search(r">\d+\s(mm|m)<", svg) is not None


def test_schematic_has_no_scale_bar() -> None:
    assert not _is_to_scale(_svg(chain()).text) and not _is_to_scale(_svg(forces()).text)
    assert _is_to_scale(_svg(belt()).text)


@pytest.mark.parametrize(
    "figure",
    [*(build() for build in DRAWINGS), pytest.param(row_of_boxes(9), marks=pytest.mark.nightly)],
    ids=lambda f: f.id,
)
def test_drawing_fits_the_page(figure: FigureRecord) -> None:
    svg = _svg(figure)
    assert svg.width <= PAGE[0] and svg.height <= PAGE[1]


def test_tall_drawing_takes_the_height_of_the_page_and_a_wide_one_its_width() -> None:
    assert 85 * MM < _svg(press()).height < 150 * MM
    wide = _svg(conveyor())
    assert wide.width > 125 * MM and wide.height < 50 * MM


def test_many_texts_find_places() -> None:
    sheet = _sheet(belt())
    assert sheet.crowded == 0


def test_names_beside_their_rows_stand_at_their_height() -> None:
    rows = [(-0.2, -0.44 * n) for n in range(14)]
    shapes = [polyline([(0, y), (5, y)]) for _, y in rows]
    shapes += [
        label(at, f"Standstill at both ends of the stroke of the cylinder {n}", "right") for n, at in enumerate(rows)
    ]
    sheet = _sheet(drawing("x", "x", shapes, unit="1", schematic=True))
    for text in sheet.axes.texts:
        _, y = rows[int(text.get_text().split()[-1])]
        assert text.get_position()[1] == pytest.approx(y * sheet.scale.upwards) and "\n" not in text.get_text()


@pytest.mark.parametrize("share", [1.0, 0.66, 0.5, 0.36])
@pytest.mark.parametrize("count", [4, 12, 20])
def test_rows_keep_their_height_however_small_the_drawing_and_long_their_names(count: int, share: float) -> None:
    """Also those of both sides, of another distance; none is folded, and none stands on another."""
    rows = [(0.0, -0.44 * n - 0.2 * (n > 3)) for n in range(count)]
    shapes = [polyline([(0, y), (8, y), (8, y - 0.1)], closed=True) for _, y in rows]
    shapes += [
        label((-0.2, y), f"The platen stands on the die and the rods relax {n}", "right")
        for n, (_, y) in enumerate(rows)
    ]
    shapes += [label((8.2, y), f"110.1°, 113.4° {n}", "left") for n, (_, y) in enumerate(rows) if n % 2]
    sheet = Shapes(drawing("x", "x", shapes, unit="1", schematic=True), Catalogue("en"), LARGEST * share)
    sheet.finish()
    texts = [text for text in sheet.axes.texts if text.get_alpha() != 0]
    assert len(texts) == count + count // 2
    for text in texts:
        _, y = rows[int(text.get_text().split()[-1])]
        assert text.get_position()[1] == pytest.approx(y * sheet.scale.upwards) and "\n" not in text.get_text()
    heads = sorted(text.get_position()[1] for text in texts if "platen" in text.get_text())
    assert min(np.diff(heads)) > 1.2 * FONT_SIZE


def test_drawing_is_made_smaller_until_its_texts_have_places() -> None:
    shapes = [polyline([(0, 0), (0.2, 0), (0.2, 0.1), (0, 0.1)], closed=True)]
    shapes += [polyline([(0, y), (0.2, y)]) for y in np.linspace(0, 0.1, 60)]
    shapes += [
        label((0.21, y), f"a name that is told beside the drawing and is longer than its room {n}")
        for n, y in enumerate(np.linspace(0.01, 0.09, 12))
    ]
    figure = drawing("x", "x", shapes)
    assert _sheet(figure).crowded > 0
    svg = _svg(figure)
    assert svg.width <= PAGE[0]
    outline = re.search(r'<path d="([^"]*)"[^>]*stroke-width: 1.1;', svg.text)
    assert outline is not None
    reach = [float(x) for x in re.findall(r"[ML] ([\d.]+)", outline[1])]
    assert 60 * MM < max(reach) - min(reach) < 0.95 * LARGEST[0]


@pytest.mark.parametrize(("texts", "is_lower"), [(4, True), (30, False)])
def test_a_drawing_with_many_texts_is_not_made_lower(texts: int, is_lower: bool) -> None:
    points = [[0.0, 0.0], [0.3, 0.0], [0.3, 0.2], [0.0, 0.2]]
    labels = [
        {"shape": "label", "at": [0.15, 0.2 * k / texts], "text": f"row {k}", "anchor": "left"} for k in range(texts)
    ]
    outline = {"shape": "polyline", "points": points, "closed": True, "role": "outline"}
    figure = drawing("d", "Rows", [outline, *labels])
    low, large = (render(figure, {}, Catalogue("en"), "d", size).height for size in (SizesSize.LOW, SizesSize.LARGE))
    assert (low < large) is is_lower


def test_a_point_in_the_midst_gets_a_leader_to_its_name() -> None:
    lines = [polyline([(-1, y), (1, y)]) for y in np.linspace(-0.12, 0.12, 40)]
    named = {"shape": "point", "at": [0, 0], "role": "pivot", "label": "O_1"}
    count = [len(_sheet(drawing("x", "x", [*lines, shape])).axes.lines) for shape in (named, named | {"label": ""})]
    assert count[0] == count[1] + 1


def test_pulley_is_filled() -> None:
    assert "#f1f4f6" in _svg(drawing("x", "x", [circle((0, 0), 0.1, "body")])).text


def test_hatching_falls_for_the_second_area() -> None:
    square = np.array([[0, 0], [100, 0], [100, 100], [0, 100], [0, 0]], dtype=float)
    for falling, slope in ((False, 1), (True, -1)):
        starts, ends = hatching([square], falling=falling)
        reach = ends - starts
        assert (reach[:, 1] / reach[:, 0]) == pytest.approx(np.full(len(reach), slope))


def test_nothing_is_hatched_where_there_is_no_room() -> None:
    sliver = np.array([[0, 0], [0.1, 0], [0.1, 0.1], [0, 0]], dtype=float)
    starts, ends = hatching([sliver])
    assert len(starts) == len(ends) <= 1


def test_text_of_several_lines_is_as_high_as_they_are() -> None:
    one, three = text_size("pulley"), text_size("pulley\nr\nwrap")
    assert three[0] == one[0] and three[1] == pytest.approx(one[1] + 2 * 1.25 * 8.5)


@pytest.mark.parametrize(("text", "set_as"), [("II", "II"), ("IV", "IV"), ("V", "$V$"), ("XI", "XI")])
def test_roman_numbers_are_no_symbols(text: str, set_as: str) -> None:
    assert marked(text) == set_as


def test_circle_of_arrows_points_around() -> None:
    turns = np.linspace(0, 2 * math.pi, 8, endpoint=False)
    heads = _heads(drawing("x", "x", [arrow((0, 0), (math.cos(t), math.sin(t))) for t in turns]))
    tips = np.array([head[0] for head in heads])
    assert np.arctan2(tips[:, 1], tips[:, 0]) % (2 * math.pi) == pytest.approx(turns % (2 * math.pi), abs=1e-9)
