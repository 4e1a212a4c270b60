"""Figures of the parallel key."""

from __future__ import annotations

from math import asin, cos, pi, sin, sqrt

import numpy as np

from diecut_report.api import (
    BarGroup,
    Bars,
    Drawing,
    Panel,
    Plot,
    Point,
    Series,
    Shape,
    View,
    dimension,
    label,
    phrase,
    polyline,
    region,
)

HUB = 0.32  # thickness of the hub that is drawn, to the shaft's diameter


def _around(radius: float, start: float, end: float, points: int = 90) -> list[Point]:
    """Points of an arc, angles from the upright, clockwise."""
    return [(radius * sin(a), radius * cos(a)) for a in np.linspace(start, end, points)]


def section(view: View) -> list[Shape]:
    """Section through shaft, key and hub; the heights that bear are marked beside the key."""
    radius, half = view["shaft_diameter"] / 2, view["width"] / 2
    bottom, top = radius - view["depth_shaft"], radius + view["depth_hub"]
    corner, crown = sqrt(radius**2 - half**2), bottom + view["height"]
    open_angle = asin(half / radius)
    shaft = [*_around(radius, open_angle, 2 * pi - open_angle, 180), (-half, bottom), (half, bottom)]
    hub_hole = [*_around(radius, open_angle, 2 * pi - open_angle, 180), (-half, top), (half, top)]
    key: list[Point] = [(-half, bottom), (half, bottom), (half, crown), (-half, crown)]
    outer = radius + max(HUB * 2 * radius, 2 * view["depth_hub"])
    away = 0.35 * radius
    return [
        region(shaft),
        region(_around(outer, 0.0, 2 * pi, 180), [hub_hole]),
        polyline(key, "body", closed=True),
        *_bearing(view, half, bottom, crown),
        dimension((-half, crown), (half, crown), outer - crown + 0.1 * radius, view.text("width")),
        dimension((half, bottom), (half, crown), -outer - away, view.text("height")),
        label((outer + 0.1 * radius, -0.6 * radius), view.text("shaft_diameter")),
        label((0.0, -0.1 * radius), "shaft", "center"),
        label((0.0, -(radius + outer) / 2), "hub", "center"),
        polyline([(0.0, -1.1 * outer), (0.0, corner * 0.6)], "centerline"),
    ]


def _bearing(view: View, half: float, bottom: float, crown: float) -> list[Shape]:
    """The heights that bear: of the shaft on the left, of the hub on the right."""
    rim = bottom + view["depth_shaft"]
    chamfer = view["chamfer"]
    return [
        polyline([(-half, bottom + chamfer), (-half, rim)], "mark"),
        polyline([(half, rim), (half, crown - chamfer)], "mark"),
    ]


LOADS = ((phrase("regular"), ""), (phrase("maximum"), "_peak"))
FIGURES = (
    Drawing(
        "section",
        "Section through shaft, key and hub",
        "To scale. Marked: the bearing height in the shaft keyway (left) and in the hub (right).",
        build=section,
    ),
    Bars(
        "pressures",
        "Pressures and allowable values",
        "Pressures on shaft, hub and key under the equivalent and the maximum torque, each with its allowable value.",
        groups=tuple(
            BarGroup(
                f"{part.capitalize()}",
                "MPa",
                bars=tuple(
                    bar
                    for words, load in LOADS
                    for bar in ((words, f"pressure_{part}{load}"), (f"{words}, allowed", f"allowed_{part}{load}"))
                ),
            )
            for part in ("shaft", "hub", "key")
        ),
    ),
    Plot(
        "torque",
        "Torque over the cycle",
        "Torque as given, over one revolution of the cycle angle.",
        abscissa="cycle_angle",
        panels=(Panel("Torque", "N*m", series=(Series("torque_over_cycle", "T"),)),),
        needs=("torque_curve",),
    ),
)
