"""The shaft to scale."""

from __future__ import annotations

from itertools import accumulate

from diecut_report.api import Phrase, Point, Shape, View, arrow, dimension, label, point, polyline

SHARE = 0.06  # of the length, by which marks stand off


def shaft(view: View) -> list[Shape]:
    """Draw sections, bearings, loads and notches, seen from the side."""
    length = view["length"]
    sizes = view.row("section_diameter")
    ends = [0.0, *accumulate(view.row("sections.length"))]
    highest = max(sizes) / 2
    shapes = [polyline([(-SHARE * length, 0), ((1 + SHARE) * length, 0)], "centerline")]
    for i, (size, bore) in enumerate(zip(sizes, view.row("sections.bore"), strict=True)):
        shapes.append(polyline(_rectangle(ends[i], ends[i + 1], size / 2), closed=True))
        if bore > 0:
            shapes.append(polyline(_rectangle(ends[i], ends[i + 1], bore / 2), "hidden", closed=True))
    for name, here in (("a", "A"), ("b", "B")):
        shapes += _bearing(view, name, here, highest)
    for name, x in zip(view.words("loads.name"), view.row("loads.position"), strict=True):
        radius = _radius(ends, sizes, x)
        shapes.append(arrow((x, radius + 2 * SHARE * length), (x, radius), "mark", name))
    if "notches.position" in view:
        for i, x in enumerate(view.row("notches.position")):
            radius = _radius(ends, sizes, x)
            shapes.append(point((x, radius), "mark", Phrase("notch {i}", i=i + 1)))
    return [*shapes, dimension((0, -highest), (length, -highest), -4 * SHARE * length, view.text("length"))]


def _rectangle(left: float, right: float, height: float) -> list[Point]:
    return [(left, -height), (right, -height), (right, height), (left, height)]


def _radius(ends: list[float], sizes: list[float], x: float) -> float:
    """The shaft's radius at a place."""
    inside = [
        size for left, right, size in zip(ends, ends[1:], sizes, strict=False) if left - 1e-9 <= x <= right + 1e-9
    ]
    return max(inside) / 2


def _bearing(view: View, name: str, told: str, highest: float) -> list[Shape]:
    x, width = view[f"bearing_{name}"], SHARE * view["length"] / 2
    foot = -highest - 2 * width
    triangle = [(x, -highest), (x - width, foot), (x + width, foot)]
    axial = view.word("locating") == name
    return [
        polyline(triangle, "link" if axial else "outline", closed=True),
        label(
            (x, foot - width), Phrase("bearing {told}, locating" if axial else "bearing {told}", told=told), "center"
        ),
    ]
