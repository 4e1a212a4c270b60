"""A belt over its pulleys, to scale: pitch circles, the belt with its arcs, its direction, numbers and wraps."""

from __future__ import annotations

from collections.abc import Sequence
from math import atan2

from diecut_report.api import Phrase, Point, Shape, arc, arrow, circle, point, polyline
from diecut_report.mechanics import belt_path


def layout(
    x: Sequence[float], y: Sequence[float], radius: Sequence[float], side: Sequence[float], wraps: Sequence[str] = ()
) -> list[Shape]:
    """Shapes of a belt over pulleys (m) in the order in which it meets them, counter-clockwise; side +1 inside, -1 outside.

    ``wraps`` are the wraps as texts, which stand beside the pulleys' numbers.
    """
    belt = belt_path.path(x, y, [s * r for s, r in zip(side, radius, strict=True)])
    leave, meet = (
        [*zip(map(float, a), map(float, b), strict=True)]
        for a, b in ((belt.leave_x, belt.leave_y), (belt.meet_x, belt.meet_y))
    )
    shapes: list[Shape] = []
    for i, center in enumerate(zip(x, y, strict=True)):
        ends = (meet[i - 1], leave[i]) if side[i] > 0 else (leave[i], meet[i - 1])
        shapes += _pulley(center, radius[i], ends, float(belt.wraps[i]))
        shapes.append(polyline([leave[i], meet[i]], "link"))
        shapes.append(point(center, "pivot", Phrase("{i}: {wrap}", i=i + 1, wrap=wraps[i]) if wraps else f"{i + 1}"))
    return [*shapes, _direction(leave, meet)]


def _pulley(center: Point, radius: float, ends: tuple[Point, Point], wrap: float) -> list[Shape]:
    """Pitch circle, rays to the ends of the wrap, and the belt on it, counter-clockwise from the first end."""
    start = atan2(ends[0][1] - center[1], ends[0][0] - center[0])
    return [
        circle(center, radius, "centerline"),
        *(polyline([center, end], "ghost") for end in ends),
        arc(center, radius, start, start + wrap, "link"),
    ]


def _direction(leave: Sequence[Point], meet: Sequence[Point]) -> Shape:
    """An arrow beside the longest run, outside the loop, in the direction in which the belt meets the pulleys."""
    runs = [(m[0] - p[0], m[1] - p[1]) for p, m in zip(leave, meet, strict=True)]
    longest = max(range(len(runs)), key=lambda i: runs[i][0] ** 2 + runs[i][1] ** 2)
    (px, py), (dx, dy) = leave[longest], runs[longest]
    off = 0.06 * max(abs(dx), abs(dy)) / (dx**2 + dy**2) ** 0.5
    start, end = ((px + share * dx + off * dy, py + share * dy - off * dx) for share in (0.4, 0.6))
    return arrow(start, end)
