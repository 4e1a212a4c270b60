"""Figures of the friction clutch."""

from __future__ import annotations

from math import atan, atan2, cos, pi, sin, tan

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import (
    Chart,
    Drawing,
    Phrase,
    Point,
    Shape,
    View,
    arc,
    arrow,
    chart_panel,
    dimension,
    label,
    line,
    mark,
    polyline,
    region,
    si,
    vertical,
)

Array = NDArray[np.float64]

FRICTIONS = (0.05, 0.1, 0.15, 0.2)  # of the comparison, beside the chosen one
WIDEST, STEEPEST = si(25, "deg"), si(80, "deg")  # of the angles compared; α + ρ stays below the second
SMALL = 0.01  # forces below this share of P are too small to draw


def force_triangle(view: View) -> list[Shape]:
    """The forces on the ring of shoes, head to tail; light: the cone's force once P_1 is taken away."""
    push, radial, normal = (view[name] for name in ("engagement_force", "pressing_force", "wedge_normal_force"))
    alpha = view["wedge_angle"]
    start, foot, tip = (0.0, 0.0), (push, 0.0), (push, radial)
    corner = (normal * sin(alpha), normal * cos(alpha))
    shapes = [
        polyline([start, (0.0, 1.06 * radial)], "centerline"),
        polyline([start, tip], "hidden"),
        arrow(start, corner, "mark", view.text("wedge_normal_force")),
        arrow(tip, foot, "mark", view.text("pressing_force")),
        arrow(foot, start, "mark", view.text("engagement_force")),
        *_angle(start, 0.45 * radial, pi / 2 - alpha, pi / 2, view.text("wedge_angle")),
    ]
    if view["wedge_friction"] > SMALL:
        direction = atan2(radial, push)
        shapes += [
            arrow(corner, tip, "mark", view.text("wedge_friction_force")),
            *_angle(start, 0.7 * radial, direction, pi / 2 - alpha, view.text("friction_angle")),
        ]
    return shapes + _released(view)


def _released(view: View) -> list[Shape]:
    """The cone's force on the shoes with friction turned round, and what of it points along the axis."""
    along, radial = -view["release_force"], view["pressing_force"]
    shapes: list[Shape] = [polyline([(0.0, 0.0), (along, radial)], "ghost")]
    if abs(along) > SMALL * radial:
        shapes.append(dimension((0.0, radial), (along, radial), 0.08 * radial, view.text("release_force")))
    return shapes


def _angle(corner: Point, radius: float, start: float, end: float, text: str) -> list[Shape]:
    """An angle with its text beside the arc."""
    middle, away = (start + end) / 2, 1.08 * radius
    return [
        arc(corner, radius, start, end, "ghost"),
        label((corner[0] + away * cos(middle), corner[1] + away * sin(middle)), text, "center"),
    ]


def section(view: View) -> list[Shape]:
    """Half section through drum, shoe and cone, engaged."""
    radius, width, alpha = view["shoe_radius"], view["lining_width"], view["wedge_angle"]
    thick = min(0.3 * width, 0.15 * radius)
    face = min(width, 0.6 * radius / tan(alpha))  # a steep or wide face would reach the axis
    left, right = (width - face) / 2, (width + face) / 2
    top = radius - thick
    low = top - face * tan(alpha)
    bottom = max(low - 0.6 * width, 0.05 * radius)
    cone: list[Point] = [
        (left - 0.5 * width, bottom),
        (left - 0.5 * width, top),
        (left, top),
        (right, low),
        (right, bottom),
    ]
    shoe: list[Point] = [(0.0, top), (left, top), (right, low), (width, low), (width, radius), (0.0, radius)]
    middle = (left - 0.5 * width, (top + bottom) / 2)
    return [
        _drum(radius, width),
        polyline(shoe, "body", closed=True),
        region(cone),
        *_moved(view, cone),
        polyline([(right, low), (right - 0.75 * face, low)], "ghost"),
        *_angle((right, low), 0.6 * face, pi - alpha, pi, view.text("wedge_angle")),
        arrow((middle[0] - 0.4 * width, middle[1]), middle, "mark", "P_1"),
        arrow((width / 2, (top + low) / 2), (width / 2, radius), "mark", "P"),
        dimension((0.0, radius + thick), (width, radius + thick), 0.25 * width, view.text("lining_width")),
        arrow((1.25 * width, bottom), (1.25 * width, radius), "body"),
        label((1.3 * width, (radius + bottom) / 2), Phrase("{radius} from the axis", radius=view.text("shoe_radius"))),
        label((1.2 * width, radius + thick / 2), "drum"),
    ]  # fmt: skip


def _drum(radius: float, width: float) -> Shape:
    """The drum's rim over the shoe."""
    outer = radius + min(0.3 * width, 0.15 * radius)
    ends = (-0.15 * width, 1.15 * width)
    return region([(ends[0], radius), (ends[1], radius), (ends[1], outer), (ends[0], outer)])


def _moved(view: View, cone: list[Point]) -> list[Shape]:
    """The cone where the gap to the drum is open; none where no gap is given, or where it lies far out of the picture."""
    back = view.get("engagement_travel", 0.0)
    if not 0 < back < 2 * view["lining_width"]:
        return []
    moved = [(x - back, y) for x, y in cone]
    return [
        polyline(moved, "hidden", closed=True),
        label((moved[0][0], moved[0][1]), "dashed: with the gap open ", "right"),
    ]


def force_over_angle(view: View) -> list[Shape]:
    """Engagement force over the wedge angle for several frictions."""
    chosen, friction = view["wedge_angle"], view["wedge_friction"]
    frictions = sorted({*FRICTIONS, friction})
    steepest = max(chosen, min(max(WIDEST, 1.6 * chosen), STEEPEST - atan(frictions[-1])))
    angles = np.linspace(min(si(0.5, "deg"), chosen), steepest, 160)
    lines = [_force_line(view, angles, one, f"f = {one:.4g}") for one in frictions]
    locking = np.linspace(0.0, min(atan(frictions[-1]), steepest), 60)[1:]
    lines.append(_force_line(view, locking, np.tan(locking), "self-locking limit, f = tan α"))
    return [
        chart_panel(
            "Engagement force", "kN", "Wedge angle", "α", "deg",
            lines=lines,
            marks=[mark(chosen, view["engagement_force"], "chosen")],
            verticals=[vertical(view["friction_angle"], Phrase("self-locking up to {friction_angle}", friction_angle=view.text("friction_angle")))]
            if friction
            else [],
        )
    ]  # fmt: skip


def _force_line(view: View, angles: Array, friction: float | Array, name: str) -> Shape:
    """The force of one friction, cut off where it leaves the diagram."""
    force = view.varied({"wedge_angle": angles, "wedge_friction": friction}, "engagement_force")["engagement_force"]
    highest = max(4 * view["engagement_force"], 1.5 * view["pressing_force"])
    return line(angles, np.where(force < highest, force, np.nan), name)


FIGURES = (
    Drawing(
        "section",
        "Section through the wedge",
        "Half section above the axis, engaged: the cone, driven in by P_1, lifts the shoe and presses it against the drum with P. The "
        "shoe's width and the wedge angle are to scale, the other dimensions are not.",
        build=section,
    ),
    Drawing(
        "force_triangle",
        "Force triangle of the wedge",
        "Forces on the ring of shoes, to scale, head to tail: N_2 and its friction from the cone, P from the drum, P_1 from the stop "
        "that locates the shoes axially. Light: the force between cone and shoes once P_1 is removed and friction has reversed; right of "
        "the vertical the shoes push the cone out, left of it they hold it.",
        build=force_triangle,
        unit="kN",
    ),
    Chart(
        "engagement_force",
        "Engagement force versus wedge angle",
        "Axial force for the same torque versus wedge angle, for several coefficients of friction between cone and shoes. Left of the "
        "self-locking limit the cone has to be pulled out.",
        build=force_over_angle,
    ),
)
