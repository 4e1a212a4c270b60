"""Figures of the impression cylinder's drive."""

from __future__ import annotations

from math import cos, pi, sin
from typing import Any

import numpy as np

from diecut_report.api import (
    Drawing,
    Level,
    Mark,
    Panel,
    Phrase,
    Plot,
    Point,
    Polar,
    Series,
    Shape,
    Span,
    View,
    arc,
    circle,
    label,
    point,
    polyline,
    rigid,
)

STROKES = (Span("dead_center_outer", "dead_center_inner", "forward stroke"),)


def _crank_length(view: View) -> float:
    """The crank's length; without one the drawing is in crank lengths."""
    return view.get("crank_length", 1.0)


def _joints(view: View, phi: float) -> tuple[Point, Point, Point, Point]:
    """Crank pivot, crank pin, rocker joint and rocker pivot at a crank angle."""
    a, beta = _crank_length(view), view.at("rocker_direction", phi)
    rocker, frame = a * view["rocker_ratio"], a * view["frame_ratio"]
    return (0.0, 0.0), (a * cos(phi), a * sin(phi)), (frame + rocker * cos(beta), rocker * sin(beta)), (frame, 0.0)


def _path(view: View) -> list[Shape]:
    """The paths of the crank pin and of the rocker's joint."""
    a = _crank_length(view)
    outer = view["outer_direction"]
    pivot = (a * view["frame_ratio"], 0.0)
    return [
        circle((0.0, 0.0), a, "ghost"),
        arc(pivot, a * view["rocker_ratio"], outer, outer + view["swing_angle"], "ghost"),
        polyline([(-1.3 * a, 0.0), (pivot[0] + 0.8 * a, 0.0)], "centerline"),
    ]


def _sector(view: View, phi: float) -> list[Shape]:
    """Sector and pinion, opposite the rocker in the middle of its swing, and the cylinder on its way."""
    if "pinion_radius" not in view:
        return []
    pivot = _joints(view, phi)[3]
    radius, pinion = view["sector_radius"], view["pinion_radius"]
    middle, direction = view["outer_direction"] + view["swing_angle"] / 2, view.at("rocker_direction", phi)
    center = (pivot[0] - (radius + pinion) * cos(middle), pivot[1] - (radius + pinion) * sin(middle))
    return [
        rigid(view.once(_rim), pivot, direction),
        rigid(
            [circle((0.0, 0.0), pinion), polyline([(0.0, 0.0), (pinion, 0.0)])],
            center,
            middle - (direction - middle) * radius / pinion,
        ),
        point(center, "pivot", "pinion"),
        *_cylinder(view, phi, (center[0], center[1] - radius - pinion)),
    ]


def _rim(view: View) -> list[Shape]:
    """The sector about its pivot, opposite the rocker, which points to the right."""
    half = view["swing_angle"] / 2 + 0.1
    rim = [view["sector_radius"] * np.exp(1j * angle) for angle in np.linspace(pi - half, pi + half, 41)]
    return [polyline([(0.0, 0.0), *((float(at.real), float(at.imag)) for at in rim)], "body", closed=True)]


def _cylinder(view: View, phi: float, middle: Point) -> list[Shape]:
    """The cylinder at its place of the travel, whose middle is free: the pinion stands, a chain moves the carriages of the cylinder."""
    half, radius = view["stroke"] / 2, view["cylinder_radius"]
    axis = (middle[0] + view.at("displacement", phi) - half, middle[1])
    return [
        polyline(
            [(middle[0] - half - 1.2 * radius, middle[1]), (middle[0] + half + 1.2 * radius, middle[1])], "centerline"
        ),
        *(circle((middle[0] + end, middle[1]), radius, "ghost") for end in (-half, half)),
        circle(axis, radius, "hidden"),
        point(axis, "pivot", "cylinder"),
    ]


def linkage(view: View) -> list[Shape]:
    """The linkage in its dead centres (light) and at the crank angle of the torque's peak, with sector and cylinder."""
    peak = view["crank_torque_peak_at"]
    shapes = _path(view)
    for place in (view["dead_center_outer"], view["dead_center_inner"]):
        shapes.append(polyline(_joints(view, place), "ghost"))
    crank_pivot, pin, joint, rocker_pivot = _joints(view, peak)
    a = _crank_length(view)
    return [
        *shapes,
        *_sector(view, peak),
        polyline([crank_pivot, pin, joint, rocker_pivot], "link"),
        point(crank_pivot, "pivot", "O₁"),
        point(rocker_pivot, "pivot", "O₃"),
        point(pin, "joint"),
        point(joint, "joint"),
        label(
            (-1.2 * a, 1.25 * a),
            Phrase("crank at {crank_torque_peak_at}", crank_torque_peak_at=view.text("crank_torque_peak_at")),
        ),
    ]


def moving(view: View, place: float) -> list[Shape]:
    """The linkage at a crank angle, with sector, pinion and cylinder where they are known."""
    crank_pivot, pin, joint, rocker_pivot = _joints(view, place)
    return [
        *_sector(view, place),
        polyline([crank_pivot, pin, joint, rocker_pivot], "link"),
        *(
            point(at, "pivot" if at in (crank_pivot, rocker_pivot) else "joint")
            for at in (crank_pivot, pin, joint, rocker_pivot)
        ),
    ]


def _panel(title: str, unit: str, *series: tuple[str, str], **more: Any) -> Panel:
    """Curves with their labels over a turn of the crank, the forward stroke shaded."""
    drawn = tuple(Series(curve, words) for curve, words in series)
    return Panel(title, unit, series=drawn, spans=STROKES, **more)


FIGURES = (
    Drawing(
        "linkage",
        "Linkage",
        "The linkage to scale at the crank angle of the maximum torque, light: in its dead centres. With a crank length and a pinion "
        "also sector, pinion and cylinder (dashed, light: at the ends of its travel). The pinion's shaft is fixed, and a chain moves the "
        "carriages of the cylinder; the positions of the pinion around the sector and of the travel are arbitrary.",
        build=linkage,
        moving=moving,
        over="crank_angle",
        scaled_by="crank_length",
    ),
    Plot(
        "motion",
        "Motion of the cylinder",
        "Displacement, velocity and acceleration over a turn of the crank (figure 2 of 000).",
        abscissa="crank_angle",
        panels=(
            _panel("Displacement", "mm", ("displacement", "S")),
            _panel("Velocity", "m/s", ("velocity", "V")),
            _panel("Acceleration", "m/s**2", ("acceleration", "a_c")),
        ),
    ),
    Plot(
        "moments",
        "Moments on the cylinder",
        "Moment of the inertia forces and total moment on the cylinder's axis; the jumps are where cutting begins and ends.",
        abscissa="crank_angle",
        panels=(_panel("Moment", "N*m", ("total_moment", "total moment"), ("inertia_moment", "inertia forces")),),
    ),
    Plot(
        "torque",
        "Torque at the crank",
        "Torque over a revolution of the crank with its extremes, mean and root mean square (figure 3 of "
        "000); negative: the cylinder drives.",
        abscissa="crank_angle",
        panels=(
            _panel(
                "Torque",
                "N*m",
                ("crank_torque", "torque"),
                levels=(Level("crank_torque_mean", "mean"), Level("crank_torque_rms", "rms")),
                marks=(
                    Mark("crank_torque_max_at", "crank_torque_max", "maximum driving"),
                    Mark("crank_torque_min_at", "crank_torque_min", "maximum braking"),
                ),
            ),
        ),
    ),
    Polar(
        "torque_polar",
        "Torque over the crank circle",
        "Absolute torque as distance from the centre over the crank angle; dashed where the cylinder drives.",
        abscissa="crank_angle",
        unit="N*m",
        series=(Series("crank_torque", "torque"),),
    ),
    Plot(
        "joint_forces",
        "Force in the coupler",
        "Force along the coupler, tension positive; its joints and the crank's bearing carry it.",
        abscissa="crank_angle",
        needs=("crank_length",),
        panels=(
            _panel(
                "Force",
                "kN",
                ("coupler_force", "coupler"),
                ("crank_bearing_force_x", "crank's bearing, along the frame"),
                ("crank_bearing_force_y", "crank's bearing, normal to it"),
                marks=(Mark("coupler_tension_max_at", "coupler_tension_max", "maximum tension"),),
            ),
        ),
    ),
    Plot(
        "tooth_forces",
        "Tooth force of the sector",
        "Tangential force between the teeth of sector and pinion; where it changes its sign the flanks change.",
        abscissa="crank_angle",
        needs=("pinion_radius",),
        panels=(_panel("Tangential force", "kN", ("tooth_force", "tooth force")),),
    ),
)
