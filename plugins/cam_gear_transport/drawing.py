"""The cam-gear stepper drawn to scale: gear and sector, and each cam with its roller and arm."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np

from diecut_report.api import Point, Shape, View, arc, circle, dimension, label, point, polyline, radius_dimension

MOST_POINTS = 720  # of a drawn curve


def polar(center: Point, radius: float, angle: float) -> Point:
    """A point at a distance and direction from another one."""
    return center[0] + radius * cos(angle), center[1] + radius * sin(angle)


def _sector(view: View, disc_angle: float, role: str) -> list[Shape]:
    """The sector at a disc angle: its pin, and the arc that meshes with the gear over the whole cycle."""
    pin = polar((0.0, 0.0), view["center_distance"], disc_angle)
    turned = disc_angle + view.at("sector_angle", disc_angle)
    half_stop = view["sector_stop_sweep"] / 2
    start, end = pi - view["sector_dwell_sweep"] - half_stop, pi + half_stop
    rim = [polar(pin, view["sector_radius"], turned + angle) for angle in np.linspace(start, end, 61)]
    return [polyline([pin, *rim], role, closed=True), point(pin, "pivot" if role == "body" else "joint")]


def rolling(view: View) -> list[Shape]:
    """Gear and sector at the start of the dwell (dark) and at its end (light)."""
    distance, gear, dwell = view["center_distance"], view["gear_radius"], view["dwell_angle"]
    end = polar((0.0, 0.0), distance, dwell)
    return [
        polyline([(0.0, 0.0), end], "centerline"),
        polyline([(0.0, 0.0), (distance, 0.0)], "centerline"),
        circle((0.0, 0.0), distance, "centerline"),
        *_sector(view, dwell * (1 - 1e-12), "ghost"),
        *_sector(view, 0.0, "body"),
        circle((0.0, 0.0), gear, "outline"),
        arc((0.0, 0.0), gear, 0.0, dwell, "link"),
        arc((0.0, 0.0), 0.5 * gear, 0.0, dwell, "mark"),
        label(polar((0.0, 0.0), 0.5 * gear, dwell / 2), view.text("dwell_angle")),
        point((0.0, 0.0), "pivot", "O₁"),
        label((distance, 0.0), "O₃", "right"),
        point((gear, 0.0), "mark", "A₁"),
        point(polar((0.0, 0.0), gear, dwell), "mark", "A₂"),
        radius_dimension((0.0, 0.0), gear, -0.3 * pi, view.text("gear_radius")),
        radius_dimension((0.0, 0.0), distance, -0.45 * pi, view.text("center_distance")),
        dimension((distance, 0.0), (gear, 0.0), 0.75 * gear, view.text("sector_radius")),
    ]


def _curve(view: View, name: str) -> list[Point]:
    x, y = view.curve(f"{name}x"), view.curve(f"{name}y")
    step = -(-len(x) // MOST_POINTS)
    return list(zip(x[::step], y[::step], strict=True))


def _cam(view: View, number: str) -> list[Shape]:
    """One cam with arm and roller in the middle of the dwell, and at the start of the return."""
    center = (0.0, 0.0)
    distance = view["center_distance"]
    shapes = [
        circle(center, distance, "centerline"),
        polyline(_curve(view, f"cam_{number}_pitch_"), "hidden", closed=True),
        polyline(_curve(view, f"cam_{number}_"), "body", closed=True),
    ]
    for place, arm, wheel in ((view["angle_stop"], "ghost", "ghost"), (view["dwell_angle"] / 2, "link", "mark")):
        pin = polar(center, distance, place)
        roller = polar(pin, view["arm_length"], place + view.at(f"arm_{number}_direction", place))
        shapes += [polyline([pin, roller], arm), circle(roller, view["roller_radius"], wheel), point(pin, "joint")]
    return [
        *shapes,
        label(pin, "O₃", "right"),
        point(center, "pivot", "O₁"),
        radius_dimension(center, distance, -0.2 * pi, view.text("center_distance")),
        dimension(pin, roller, 0.12 * distance, view.text("arm_length")),
    ]


def cam_1(view: View) -> list[Shape]:
    """The first cam."""
    return _cam(view, "1")


def cam_2(view: View) -> list[Shape]:
    """The second cam."""
    return _cam(view, "2")
