"""Figures of the roller chain."""

from __future__ import annotations

from math import acos, ceil, cos, floor, pi, sin

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import (
    Chart,
    Drawing,
    Point,
    Shape,
    View,
    arc,
    arrow,
    chart_panel,
    circle,
    dimension,
    fill,
    label,
    level,
    line,
    mark,
    point,
    polyline,
    radius_dimension,
)
from diecut_report.plugins.roller_chain.inputs import CONVEYOR, DRIVE

POINTS = 201  # of a line within two teeth
Array = NDArray[np.float64]


def loop(view: View) -> list[Shape]:
    """The chain over its sprockets."""
    center, small, large = (
        view["center_distance_adjusted"],
        view["sprocket_diameter_1"] / 2,
        view["sprocket_diameter_2"] / 2,
    )
    slope = acos((small - large) / center)  # direction of the contact points from the line through the axes
    second = (center, 0.0)
    shapes: list[Shape] = [
        polyline([(-1.2 * small, 0.0), (center + 1.2 * large, 0.0)], "centerline"),
        circle((0.0, 0.0), small, "centerline"),
        circle(second, large, "centerline"),
        point((0.0, 0.0), "pivot"),
        point(second, "pivot"),
        arc((0.0, 0.0), small, slope, 2 * pi - slope, "link"),
        arc(second, large, -slope, slope, "link"),
        *(
            polyline([_on((0.0, 0.0), small, side * slope), _on(second, large, side * slope)], "link")
            for side in (1, -1)
        ),
    ]
    above, below = 1.15 * max(small, large), -1.25 * max(small, large)
    return [
        *shapes,
        *_joints(view, 0.0, small, "teeth_1"),
        *_joints(view, center, large, "driven_teeth"),
        dimension((0.0, 0.0), second, below, view.text("center_distance_adjusted")),
        radius_dimension((0.0, 0.0), small, 2.6, view.text("sprocket_diameter_1")),
        radius_dimension(second, large, 0.6, view.text("sprocket_diameter_2")),
        arrow((0.35 * center, above), (0.65 * center, above), text=view.text("velocity")),
        label((0.35 * center, 0.0), f"{view.text('links')}, {view.text('chain_length')}"),
    ]  # fmt: skip


def _on(center: Point, radius: float, angle: float) -> Point:
    return center[0] + radius * cos(angle), center[1] + radius * sin(angle)


def _joints(view: View, x: float, radius: float, teeth: str) -> list[Shape]:
    """The places of the joints on a sprocket."""
    count = round(view[teeth])
    roller = 0.2 * view["pitch"]
    return [circle(_on((x, 0.0), radius, 2 * pi * i / count), roller, "ghost") for i in range(count)]


def tension_over_cycle(view: View) -> list[Shape]:
    """The tension of the tight strand over the cycle, where the velocity is a curve."""
    return _stacked(view, np.array(view.curve("centrifugal_over")), np.array(view.curve("chordal_over")))


def tension_at_even_speed(view: View) -> list[Shape]:
    """The same where the velocity is the same all the time."""
    even = np.ones(len(view.curve("cycle_angle")))
    return _stacked(view, view["centrifugal_tension"] * even, view["chordal_tension"] * even)


def _stacked(view: View, centrifugal: Array, chordal: Array) -> list[Shape]:
    """The parts of the tension, one upon the other."""
    angle = np.array(view.curve("cycle_angle"))
    quiet = view["pretension"] + view["sag_tension"] + 0 * angle
    lines = [
        line(angle, quiet, "sag and pretension"),
        line(angle, quiet + centrifugal, "with centrifugal tension"),
        line(angle, quiet + centrifugal + chordal, "with polygon shocks"),
        line(angle, view.curve("strand_tension"), "with useful tension"),
    ]
    return [
        chart_panel("Tension of the tight strand", "N", "Cycle angle", "φ", "deg", lines=lines,
                    fills=[fill(angle, view.curve("strand_tension"), "whole tension")],
                    marks=[mark(view["tension_peak_angle"], view["tension_peak"], "maximum")])
    ]  # fmt: skip


def velocity_within_teeth(view: View) -> list[Shape]:
    """The velocity of the chain over two teeth of the driving sprocket that turns evenly."""
    tooth = 2 * pi / view["teeth_1"]
    turned = np.linspace(0, 2 * tooth, POINTS)
    within = turned - tooth * np.floor(turned / tooth) - tooth / 2
    velocity = view["velocity_max"] * np.cos(within)
    mean = view["velocity_max"] * sin(tooth / 2) / (tooth / 2)
    return [
        chart_panel(
            "Velocity of the chain",
            "m/s",
            "Angle of the driving sprocket",
            "θ",
            "deg",
            lines=[line(turned, velocity, "velocity")],
            levels=[level(mean, "mean")],
            range=_axis(view["velocity_min"], view["velocity_max"]),
        )
    ]


def _axis(least: float, most: float) -> tuple[float | None, float | None]:
    """Ends of an axis that shows the fall within a tooth; from zero where nothing falls."""
    room = most - least
    if room <= 0:
        return 0.0, None
    step = 10.0 ** floor(np.log10(room))
    return floor((least - room / 2) / step) * step, ceil((most + room / 2) / step) * step


CYCLE = (
    "The components stacked: sag and pretension, centrifugal tension, polygon shocks, and the useful tension (with the application factor) up to "
    "the total."
)

FIGURES = (
    Drawing(
        "loop",
        "Chain over its sprockets",
        "To scale: pitch circles (dash-dotted), the joints that lie on them (light) and the chain's line.",
        build=loop,
    ),
    *(
        Chart("tension", "Tension over the cycle", CYCLE, build=build, needs=needs)
        for needs, build in (
            ((DRIVE, "torque_curve"), tension_at_even_speed),
            ((CONVEYOR, "acceleration_curve", "velocity"), tension_at_even_speed),
            ((CONVEYOR, "velocity_curve"), tension_over_cycle),
        )
    ),
    Chart(
        "velocity",
        "Velocity within two teeth",
        "The driving sprocket runs at constant speed; where a joint meets it the velocity has a kink and its slope jumps.",
        build=velocity_within_teeth,
    ),
)
