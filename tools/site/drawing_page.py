"""The shapes and roles of drawings as pictures, drawn by the very code that draws them in reports."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from math import pi

from diecut_report.api import (
    Shape,
    arc,
    arrow,
    box,
    circle,
    dimension,
    label,
    point,
    polyline,
    radius_dimension,
    region,
)  # fmt: skip
from diecut_report.report.figures.drawing import drawing
from diecut_report.report.figures.style import SizesSize, drawn
from diecut_report.report.text import Catalogue
from diecut_report.results.figure_record import FigureRecord
from tools.site.markup import html, plain

WORDS = Catalogue("en")
BENT = [(0.0, 0.0), (0.02, 0.012), (0.04, 0.0), (0.06, 0.012)]
MEANINGS = {  # of the roles of lines, in the order in which they are known
    "outline": "visible edges of a part",
    "section": "edges of a cut face",
    "hidden": "edges behind something",
    "centerline": "axes and lines of symmetry",
    "ground": "what stands still: short strokes go down from it",
    "link": "the members of a mechanism",
    "ghost": "other positions, paths, circles that only help",
    "mark": "what is spoken of: a measure, a direction, a force",
    "body": "a part seen from outside, filled lightly where it is closed",
    "shade": "a light area without edges",
}
POINTS = {
    "mark": "a place that is spoken of",
    "pivot": "a joint that is fixed to the ground",
    "joint": "a joint that moves; any other role looks so",
}
SHAPES: Mapping[str, tuple[list[Shape], str]] = {
    "polyline": ([polyline([(0, 0), (0.03, 0.02), (0.05, 0.0)])], "straight lines from point to point; `closed=True` joins the ends"),
    "region": ([region([(0, 0), (0.05, 0), (0.05, 0.03), (0, 0.03)], [[(0.02, 0.01), (0.03, 0.01), (0.03, 0.02), (0.02, 0.02)]])],
               "a cut area, hatched, with holes"),
    "circle": ([circle((0, 0), 0.015), point((0, 0), "joint")], "a full circle"),
    "arc": ([arc((0, 0), 0.02, 0.0, 2 * pi / 3)], "counter-clockwise from start to end, in rad"),
    "dimension": ([polyline([(0, 0), (0.05, 0)]), dimension((0, 0), (0.05, 0), 0.01, "l = 50 mm")],
                  "set off to the left of the direction from the first point to the second, to the right where the offset is negative"),
    "radius_dimension": ([circle((0, 0), 0.015), radius_dimension((0, 0), 0.015, pi / 4, "R = 15 mm")], "a radius, drawn at an angle"),
    "label": ([polyline([(0, 0), (0.05, 0)]), label((0.01, 0.008), "text beside it")], "a text; it moves aside where lines are in its way"),
    "arrow": ([arrow((0, 0), (0.05, 0.01), text="F")], "a force or a direction, with its name"),
    "box": ([box((0, 0), 0.03, 0.016, ["motor", "3 kW"]), box((0.06, 0), 0.03, 0.016, ["clutch"], "body"), arrow((0, 0), (0.06, 0))],
            "a box of a schematic with its lines; arrows go from edge to edge"),
    "point": ([polyline([(0, 0), (0.04, 0.01)], "link"), point((0, 0), "pivot", "A"), point((0.04, 0.01), "joint", "B")],
              "a joint or a marked place, with its name"),
}  # fmt: skip


def drawing_page() -> Iterator[str]:
    """Yield the page of shapes and roles."""
    yield from ("# Shapes and roles of drawings", "")
    yield (
        "`Drawing(build=…)` gives shapes in metres, and for each a role; how a role looks is the report's business. The pictures here are drawn by "
        "the code that draws them in reports. A role that is not known is told when the drawing is made."
    )
    yield from ("", "## Roles of lines", "", "Of `polyline`, `circle`, `arc`, `arrow` and `box`:", "")
    yield from _gallery((f"role-{role}", role, words, _line(role)) for role, words in MEANINGS.items())
    yield from ("## Roles of points", "")
    points = (
        (f"point-{role}", role, words, [polyline([(0, 0), (0.03, 0)], "ghost"), point((0.015, 0), role)])
        for role, words in POINTS.items()
    )
    yield from _gallery(points)
    yield from ("## Shapes", "")
    yield from _gallery((f"shape-{name}", name, words, shapes) for name, (shapes, words) in SHAPES.items())


def _line(role: str) -> list[Shape]:
    if role in ("body", "shade", "section"):
        return [polyline([(0, 0), (0.05, 0), (0.05, 0.015), (0, 0.015)], role, closed=True)]
    return [polyline([(0, 0), (0.06, 0)] if role in ("ground", "centerline") else BENT, role)]


def _gallery(each: Iterator[tuple[str, str, str, Sequence[Shape]]]) -> Iterator[str]:
    """Pictures with what they show: the picture as it is, the words as text, which the search knows."""
    for key, name, words, shapes in each:
        yield from html(f'<figure class="sample"><div class="fig">{picture(key, name, shapes)}</div></figure>')
        yield from (f"`{name}`: {words if '`' in words else plain(words)}", "")


def picture(key: str, title: str, shapes: Sequence[Shape]) -> str:
    """Return shapes as SVG, as a drawing of a report is drawn."""
    told = {"type": "drawing", "id": "", "title": title, "caption": "", "unit": "mm", "schematic": True}
    figure = FigureRecord.model_validate(told | {"shapes": [dict(shape) for shape in shapes]})
    return drawn(partial(drawing, figure, {}, WORDS, SizesSize.HALF), title, key).text
