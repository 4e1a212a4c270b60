"""The cam-gear stepper drawn to scale: gear and sector, and each cam with its roller and arm."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np

from diecut_report.api import (
    Point,
    Shape,
    View,
    arc,
    circle,
    dimension,
    label,
    point,
    polyline,
    radius_dimension,
    rigid,
)

MOST_POINTS = 720  # of a drawn curve
MOST_MOVING = 180  # of one beside which a drawing moves on a screen


def polar(center: Point, radius: float, angle: float) -> Point:
    """A point at a distance and direction from another one."""
    return center[0] + radius * cos(angle), center[1] + radius * sin(angle)


def _sector(view: View, disc_angle: float, role: str) -> list[Shape]:
    """The sector at a disc angle: its pin, and the arc that meshes with the gear over the whole cycle."""
    pin = polar((0.0, 0.0), view["center_distance"], disc_angle)
    turned = disc_angle + view.at("sector_angle", disc_angle)
    sector = polyline([(0.0, 0.0), *view.once(_rim)], role, closed=True)
    return [rigid([sector], pin, turned), point(pin, "pivot" if role == "body" else "joint")]


def _rim(view: View) -> list[Point]:
    """The sector's teeth about its pin, from where they mesh at the start of phase I to the end of phase III."""
    half_stop = view["sector_stop_sweep"] / 2
    start, end = pi - view["sector_dwell_sweep"] - half_stop, pi + half_stop
    return [polar((0.0, 0.0), view["sector_radius"], angle) for angle in np.linspace(start, end, 61)]


def rolling_at(view: View, disc_angle: float) -> list[Shape]:
    """Gear, disc and sector at a disc angle."""
    gear, pin = view["gear_radius"], polar((0.0, 0.0), view["center_distance"], disc_angle)
    wheel = [circle((0.0, 0.0), gear), polyline([(0.0, 0.0), (gear, 0.0)])]
    return [
        circle((0.0, 0.0), view["center_distance"], "centerline"),
        *_sector(view, disc_angle, "body"),
        rigid(wheel, (0.0, 0.0), view.at("gear_angle", disc_angle)),
        polyline([(0.0, 0.0), pin], "link"),
        point((0.0, 0.0), "pivot"),
    ]


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


def _curve(view: View, name: str, most: int = MOST_POINTS) -> list[Point]:
    x, y = view.curve(f"{name}x"), view.curve(f"{name}y")
    step = -(-len(x) // most)
    return list(zip(x[::step], y[::step], strict=True))


def _profile(view: View, number: str, most: int = MOST_POINTS) -> list[Shape]:
    """A cam with the path of its roller's centre and that of the pin."""
    return [
        circle((0.0, 0.0), view["center_distance"], "centerline"),
        polyline(_curve(view, f"cam_{number}_pitch_", most), "hidden", closed=True),
        polyline(_curve(view, f"cam_{number}_", most), "body", closed=True),
    ]


def _arm(view: View, number: str, disc_angle: float) -> tuple[Point, Point]:
    """The pin O₃ and the roller's centre at a disc angle."""
    pin = polar((0.0, 0.0), view["center_distance"], disc_angle)
    return pin, polar(pin, view["arm_length"], disc_angle + view.at(f"arm_{number}_direction", disc_angle))


def _cam(view: View, number: str) -> list[Shape]:
    """One cam with arm and roller in the middle of the dwell, and at the start of the return."""
    center = (0.0, 0.0)
    distance = view["center_distance"]
    shapes = _profile(view, number)
    for place, arm, wheel in ((view["angle_stop"], "ghost", "ghost"), (view["dwell_angle"] / 2, "link", "mark")):
        pin, roller = _arm(view, number, place)
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


def _cam_at(view: View, number: str, disc_angle: float) -> list[Shape]:
    """One cam with disc, arm and roller at a disc angle."""
    pin, roller = _arm(view, number, disc_angle)
    return [
        *view.once(_profile_1 if number == "1" else _profile_2),
        polyline([(0.0, 0.0), pin], "outline"),
        polyline([pin, roller], "link"),
        circle(roller, view["roller_radius"], "mark"),
        point((0.0, 0.0), "pivot"),
        point(pin, "joint"),
    ]


def _profile_1(view: View) -> list[Shape]:
    return _profile(view, "1", MOST_MOVING)


def _profile_2(view: View) -> list[Shape]:
    return _profile(view, "2", MOST_MOVING)


def cam_1_at(view: View, disc_angle: float) -> list[Shape]:
    """The first cam at a disc angle."""
    return _cam_at(view, "1", disc_angle)


def cam_2_at(view: View, disc_angle: float) -> list[Shape]:
    """The second cam at a disc angle."""
    return _cam_at(view, "2", disc_angle)
