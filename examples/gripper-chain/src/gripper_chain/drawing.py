"""The loop of the chain, to scale."""

from __future__ import annotations

from math import asinh, cos, pi, sin

import numpy as np

from diecut_report.api import Point, Shape, View, circle, dimension, label, point, polyline

# The idle sprocket stands at the origin, the driving one to its right; the upper strand runs to the right.


def hanging(view: View, along: float) -> Point:
    """Return the point of the slack strand at a length from the driving sprocket."""
    c, span, length = view["catenary"], view["centre_distance"], view["slack_length"]
    x = c * asinh((along - length / 2) / c)  # from the middle, to the left
    return span / 2 - x, -view["pitch_radius"] - view["sag"] + c * (np.cosh(x / c) - 1)


def on_loop(view: View, way: float) -> Point:
    """Return the point of the loop at a way from the top of the idle sprocket."""
    span, radius, slack = view["centre_distance"], view["pitch_radius"], view["slack_length"]
    around = view["teeth"] * view["pitch"] / 2
    if way < span:
        return way, radius
    if way < span + around:
        turned = pi / 2 - pi * (way - span) / around
        return span + radius * cos(turned), radius * sin(turned)
    if way < span + around + slack:
        return hanging(view, way - span - around)
    turned = -pi / 2 - pi * (way - span - around - slack) / around
    return radius * cos(turned), radius * sin(turned)


def sprocket(view: View, x: float) -> list[Shape]:
    """Return a sprocket as the polygon of its joints."""
    radius, half = view["pitch_radius"], view["half_tooth"]
    angles = pi / 2 + half + 2 * half * np.arange(round(view["teeth"]))
    return [
        polyline([(x + radius * cos(turn), radius * sin(turn)) for turn in angles], "body", closed=True),
        circle((x, 0.0), radius / 5),
        point((x, 0.0), "pivot"),
    ]


def loop(view: View) -> list[Shape]:
    """Return both sprockets, both strands, the bars and the stations."""
    span, radius, bar = view["centre_distance"], view["pitch_radius"], view["centre_distance"] / 80
    slack = [hanging(view, along) for along in np.linspace(0, view["slack_length"], 81)]
    spacing = view["bar_spacing"] * (1 + view["elongation"])
    bars = [on_loop(view, spacing * number) for number in range(round(view["bar_count"]))]
    shapes = [*sprocket(view, 0.0), *sprocket(view, span)]
    shapes += [polyline([(0.0, radius), (span, radius)], "link"), polyline(slack, "link")]
    shapes += [circle(each, bar, "mark") for each in bars]
    for name, position in zip(view.words("stations.name"), view.row("stations.position"), strict=True):
        x = span - position
        shapes += [
            polyline([(x, radius - bar), (x, radius - 3 * bar)], "mark"),
            label((x, radius - 4 * bar), name, "center"),
        ]
    middle = -radius - view["sag"]
    shapes += [
        dimension((span, 0.0), (0.0, 0.0), radius + view["sag"] + 4 * bar, view.text("centre_distance")),
        dimension((span / 2, -radius), (span / 2, middle), bar, view.text("sag")),
        polyline([(0.0, -radius), (span, -radius)], "centerline"),
    ]
    return shapes
