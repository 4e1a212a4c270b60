"""The Geneva drive drawn to scale: wheel, crank with roller, locking disc. The crank turns about the origin, the wheel about (C, 0)."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np

from diecut_report.api import Point, Shape, View, circle, dimension, point, polyline, radius_dimension, rigid


def _around(center: Point, radius: float, start: float, end: float, points: int = 25) -> list[Point]:
    return [(center[0] + radius * cos(a), center[1] + radius * sin(a)) for a in np.linspace(start, end, points)]


def _slot(view: View) -> list[Point]:
    """A slot's outline along +x from the wheel's axis, from its lower to its upper mouth."""
    half, inner = view["roller_radius"], view["nearest_distance"]
    mouth = view["wheel_radius"]
    return [(mouth, -half), *_around((inner, 0.0), half, -pi / 2, -3 * pi / 2), (mouth, half)]


def _holds(view: View) -> bool:
    """Whether the locking disc reaches into the wheel."""
    return view["rim_distance"] < view["disc_radius"]


def _tip(view: View) -> tuple[float, float]:
    """Where the tip of an arm begins and ends on the rim: from a slot's corner to the locking arc."""
    rim, center, step = view["rim_radius"], view["center_distance"], view["step_angle"]
    corner = float(np.arctan2(view["roller_radius"], view["wheel_radius"]))
    if not _holds(view):
        return corner, step / 2
    radius = min(view["locking_radius"], view["flank_distance"])  # where the arc cuts the slots, the arms end
    return corner, step / 2 - float(np.arccos((center**2 + rim**2 - radius**2) / (2 * center * rim)))


def _rim(view: View) -> list[Point]:
    """The rim from one slot (along +x) to the next one, with the locking arc where the disc reaches the wheel."""
    rim, step, (corner, end) = view["rim_radius"], view["step_angle"], _tip(view)
    first, last = _around((0.0, 0.0), rim, corner, end, 9), _around((0.0, 0.0), rim, step - end, step - corner, 9)
    if not _holds(view):
        return [*first, *last]
    center = (view["center_distance"] * cos(step / 2), view["center_distance"] * sin(step / 2))
    start = float(np.arctan2(first[-1][1] - center[1], first[-1][0] - center[0])) % (2 * pi)
    radius = float(np.hypot(first[-1][0] - center[0], first[-1][1] - center[1]))
    return [*first, *_around(center, radius, start, 2 * pi + step - start, 41), *last]


def _turned(points: list[Point], angle: float, center: Point) -> list[Point]:
    return [
        (center[0] + x * cos(angle) - y * sin(angle), center[1] + x * sin(angle) + y * cos(angle)) for x, y in points
    ]


def wheel_outline(view: View, angle: float) -> list[Point]:
    """The wheel's outline; at angle 0 a slot points to the crank's axis. A positive angle turns it as it moves."""
    return _turned(wheel(view), pi - angle, (view["center_distance"], 0.0))


def wheel(view: View) -> list[Point]:
    """The wheel's outline about its axis, a slot along +x."""
    one = [*_slot(view), *_rim(view)[1:-1]]
    steps = range(round(view["slots"]))
    return [p for k in steps for p in _turned(one, k * view["step_angle"], (0.0, 0.0))]


def disc_outline(view: View, angle: float) -> list[Point]:
    """The locking disc's outline with the roller at a crank angle; empty where it does not reach the wheel."""
    if not _holds(view):
        return []
    half = view["engagement_half_angle"]
    arc = _around((0.0, 0.0), view["disc_radius"], half, 2 * pi - half, 121)
    opening = pi / 2 - half  # the hollow as seen from its centre
    hollow = _around((view["relief_distance"], 0.0), view["relief_radius"], pi + opening, pi - opening, 61)
    return _turned([*arc, *hollow[1:-1]], angle, (0.0, 0.0))


def _machine(view: View, crank: float, wheel: float, offset: float = 0.0) -> list[Shape]:
    """Wheel, disc and crank in one position, set off to the right."""

    def moved(points: list[Point]) -> list[Point]:
        return [(x + offset, y) for x, y in points]

    radius, distance = view["crank_radius"], view["center_distance"]
    roller = (offset + radius * cos(crank), radius * sin(crank))
    disc = disc_outline(view, crank)
    return [
        polyline(moved(wheel_outline(view, wheel)), "body", closed=True),
        *([polyline(moved(disc), "body", closed=True)] if disc else []),
        polyline([(offset, 0.0), roller], "link"),
        circle(roller, view["roller_radius"], "mark"),
        circle((offset, 0.0), radius, "ghost"),
        polyline([(offset - 0.15 * distance, 0.0), (offset + 1.15 * distance, 0.0)], "centerline"),
        point((offset, 0.0), "pivot"),
        point((offset + distance, 0.0), "pivot"),
    ]


def at_entry(view: View) -> list[Shape]:
    """The instant of entry, with the main dimensions."""
    half, step, radius = view["engagement_half_angle"], view["step_angle"], view["crank_radius"]
    distance, rim, roller = view["center_distance"], view["rim_radius"], view["roller_radius"]
    entry = (radius * cos(half), -radius * sin(half))
    last = round(view["slots"]) // 2  # the slot that points away from the crank
    shapes = [
        *_machine(view, -half, -step / 2),
        circle((radius, 0.0), roller, "ghost"),
        circle((entry[0], -entry[1]), roller, "ghost"),
        dimension((0.0, 0.0), (distance, 0.0), -1.12 * max(rim, radius + roller), view.text("center_distance")),
        radius_dimension((0.0, 0.0), radius, 0.8 * pi, view.text("crank_radius")),
        radius_dimension(
            (distance, 0.0), rim, pi + step / 2 + last * step + sum(_tip(view)) / 2, view.text("rim_radius")
        ),
        radius_dimension(entry, roller, -0.6 * pi, view.text("roller_radius")),
    ]
    return (
        [*shapes, radius_dimension((0.0, 0.0), view["disc_radius"], 0.55 * pi, view.text("disc_radius"))]
        if _holds(view)
        else shapes
    )


def positions(view: View) -> list[Shape]:
    """The middle of the motion and, beside it, the middle of the dwell."""
    apart = view["center_distance"] + view["rim_radius"] + 1.35 * view["crank_radius"] + view["roller_radius"]
    return [*_machine(view, 0.0, 0.0), *_machine(view, pi, view["step_angle"] / 2, apart)]


def _driven(view: View) -> list[Shape]:
    return [polyline(wheel(view), "body", closed=True)]


def _driving(view: View) -> list[Shape]:
    """The crank with its roller and the locking disc, along +x."""
    disc, roller = disc_outline(view, 0.0), (view["crank_radius"], 0.0)
    locking = [polyline(disc, "body", closed=True)] if disc else []
    return [*locking, polyline([(0.0, 0.0), roller], "link"), circle(roller, view["roller_radius"], "mark")]


def turning(view: View, crank: float) -> list[Shape]:
    """Wheel, disc and crank at a crank angle."""
    distance = view["center_distance"]
    return [
        rigid(view.once(_driven), (distance, 0.0), pi - view.at("wheel_angle", crank)),
        rigid(view.once(_driving), (0.0, 0.0), crank),
        point((0.0, 0.0), "pivot"),
        point((distance, 0.0), "pivot"),
    ]
