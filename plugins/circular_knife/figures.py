"""Figures of the circular knife."""

from __future__ import annotations

from math import cos, pi, sin
from typing import Any

import numpy as np

from diecut_report.api import (
    Chart,
    Drawing,
    Phrase,
    Point,
    Shape,
    View,
    chart_panel,
    circle,
    dimension,
    label,
    level,
    line,
    mark,
    phrase,
    point,
    polyline,
    radius_dimension,
    region,
    rigid,
    si,
    told,
    vertical,
)
from diecut_report.plugins.circular_knife import steps

MARGIN = si(6, "deg")  # by which the drawn edge is longer than what cuts


def center_at(view: View, angle: float) -> Point:
    """The edge's centre at a knife angle."""
    return view["eccentricity"] * cos(angle), -view["eccentricity"] * sin(angle)


def crossing(view: View, angle: float, depth: float) -> Point:
    """Where the edge crosses a depth."""
    return float(steps.edge_position(angle, depth, view["eccentricity"], view["edge_radius"])), -depth


def edge_arc(view: View, angle: float, first: float, last: float, points: int = 81) -> list[Point]:
    """The edge between two directions, as seen from its centre (clockwise from the direction of the cut)."""
    (x, y), radius = center_at(view, angle), view["edge_radius"]
    return [(x + radius * cos(a), y - radius * sin(a)) for a in np.linspace(first, last, points)]


def drawn_edge(view: View, angle: float) -> tuple[float, float]:
    """Directions between which the edge is drawn at a knife angle."""
    return angle + view["edge_angle_last"] - MARGIN, angle + view["edge_angle_first"] + MARGIN


def _moved(points: list[Point], offset: float) -> list[Point]:
    return [(x + offset, y) for x, y in points]


def _knife(view: View, angle: float, offset: float) -> list[Shape]:
    """The blade from its shaft to the edge, hub, centre of the edge and the circle on which it runs."""
    arc = edge_arc(view, angle, *drawn_edge(view, angle))
    axis, center = (offset, 0.0), _moved([center_at(view, angle)], offset)[0]
    return [
        polyline([axis, *_moved(arc, offset)], "body", closed=True),
        circle(axis, view["eccentricity"], "ghost"),
        polyline([axis, center], "link"),
        point(axis, "pivot"),
        point(center, "joint", "O₁"),
    ]


def _blade(view: View) -> list[Shape]:
    """The knife at the angle zero, from its shaft to the edge, with the edge's centre."""
    center = center_at(view, 0.0)
    arc = edge_arc(view, 0.0, *drawn_edge(view, 0.0))
    return [
        polyline([(0.0, 0.0), *arc], "body", closed=True),
        polyline([(0.0, 0.0), center], "link"),
        point(center, "joint"),
    ]


def _still(view: View) -> list[Shape]:
    """What stands: board and counter-knife, and the circle on which the edge's centre runs."""
    board, counter = _board(view, 0.0)
    return [polyline(counter["outer"], "body", closed=True), board, circle((0.0, 0.0), view["eccentricity"], "ghost")]


def turning(view: View, angle: float) -> list[Shape]:
    """The knife at an angle, which turns clockwise, over board and counter-knife; outside the cut the cutting point waits at its start."""
    return [
        rigid(view.once(_blade), (0.0, 0.0), -angle),
        *view.once(_still),
        point((0.0, 0.0), "pivot"),
        point((view.at("cut_position", angle), -view["depth"]), "mark"),
    ]


def _board(view: View, offset: float) -> list[Shape]:
    """The board, thin on this scale, and the counter-knife below it."""
    front, end, depth, thickness = (view[name] for name in ("front_distance", "cut_end", "depth", "thickness"))
    right, deep = end + 0.4 * view["cut_length"], 0.12 * view["edge_radius"]
    return [
        polyline(_moved([(front, -depth), (right, -depth), (right, thickness - depth), (front, thickness - depth)], offset),
                 "link", closed=True),
        region(_moved([(front, -depth), (right, -depth), (right, -depth - deep), (front, -depth - deep)], offset)),
    ]  # fmt: skip


def _position(view: View, place: Phrase, angle: float, offset: float) -> list[Shape]:
    """Knife, board and counter-knife at a knife angle, with the cutting point."""
    above = 1.6 * view["eccentricity"] + 0.12 * view["edge_radius"]
    return [
        *_board(view, offset),
        *_knife(view, angle, offset),
        point(_moved([crossing(view, angle, view["depth"])], offset)[0], "mark"),
        label(
            (offset + 0.3 * view["edge_radius"], above),
            Phrase("{place}: φ = {angle}", place=place, angle=told(angle, "deg")),
            "center",
        ),
    ]


def positions(view: View) -> list[Shape]:
    """Start, middle and end of the cut, side by side."""
    start, middle, end = (view[name] for name in ("angle_start", "middle_angle", "angle_end"))
    depth, front, radius = view["depth"], view["front_distance"], view["edge_radius"]
    reached = [
        x for angle in (start, middle, end) for x, _ in edge_arc(view, angle, *drawn_edge(view, angle), points=9)
    ]
    widest = max(*reached, view["cut_end"] + 0.4 * view["cut_length"], view["eccentricity"])
    apart = widest - min(*reached, -view["eccentricity"]) + 0.6 * view["eccentricity"]
    below = 0.12 * radius
    return [
        *_position(view, phrase("start"), start, 0.0),
        *_position(view, phrase("middle"), middle, apart),
        *_position(view, phrase("end"), end, 2 * apart),
        dimension((0.0, 0.0), (0.0, -depth), -1.5 * view["eccentricity"], view.text("depth")),
        dimension((0.0, -depth - below), (front, -depth - below), -0.12 * radius, view.text("front_distance")),
        radius_dimension((apart + center_at(view, middle)[0], center_at(view, middle)[1]), radius,
                         -(middle + (view["edge_angle_first"] + view["edge_angle_last"]) / 2), view.text("edge_radius")),
        dimension((2 * apart + front, -depth - below), (2 * apart + view["cut_end"], -depth - below), -0.12 * radius, view.text("cut_length")),
    ]  # fmt: skip


def front(view: View) -> list[Shape]:
    """The working front in the middle of the cut, enlarged: board, edge and counter-knife."""
    angle, depth, face = view["middle_angle"], view["depth"], view["face_depth"]
    point_below, point_above = crossing(view, angle, depth), crossing(view, angle, face)
    sizes = view["eccentricity"], view["edge_radius"]
    slopes = [float(steps.edge_slope(angle, level, *sizes)) for level in (depth, face)]
    length, thickness = point_above[0] - point_below[0], view["thickness"]
    left, right, deep = point_below[0] - length, point_above[0] + length, 0.8 * thickness
    working = edge_arc(view, angle, pi / 2 - slopes[0], pi / 2 - slopes[1])
    beyond = (slopes[1] - slopes[0]) / 2
    edge = edge_arc(view, angle, pi / 2 - slopes[0] + beyond, pi / 2 - slopes[1] - beyond)
    return [
        region([*working, (right, -face), (right, -depth)]),
        polyline([(left, -face), point_above], "hidden"),
        region([(left, -depth), (right, -depth), (right, -depth - deep), (left, -depth - deep)]),
        polyline(edge, "link"),
        point(point_below, "mark", f"τ = {told(slopes[0], 'deg')}"),
        dimension((right, -depth), (right, -face), -0.25 * length, view.text("thickness")),
        dimension((point_below[0], -face), point_above, 0.35 * thickness, f"a = {told(length, 'mm')}"),
        label((left + 0.1 * length, -depth - deep / 2), "counter-knife"),
        label((point_above[0] + 0.5 * length, -depth + thickness / 2), "board", "center"),
    ]


ANGLE = (phrase("knife angle"), "φ", "deg")
INSIDE = 1e-9  # share of the cut by which the curves' ends are taken inside it
POINTS = 121


def over_cut(view: View) -> tuple[Any, Any]:
    """Knife angles of the cut, and the places on the abscissa at which they lie."""
    angles = np.linspace(view["angle_start"], view["angle_end"], POINTS)
    inside = np.linspace(INSIDE, 1 - INSIDE, POINTS)
    return angles, np.mod(view["angle_start"] + inside * view["cut_angle"], 2 * np.pi)


def panel(view: View, title: str, unit: str, *curves: tuple[str, str], **more: Any) -> Shape:
    """Curves over the cut."""
    angles, places = over_cut(view)
    lines = [line(angles, [view.at(curve, place) for place in places], words) for curve, words in curves]
    return chart_panel(title, unit, *ANGLE, lines=lines, over="knife_angle", **more)


def place_of(view: View, name: str) -> float:
    """The knife angle of an extreme, counted as the range of the cut is."""
    turns = np.round((view[f"{name}_at"] - view["middle_angle"]) / (2 * np.pi))
    return float(view[f"{name}_at"] - 2 * np.pi * turns)


def greatest(view: View, name: str) -> list[Shape]:
    """The mark of an extreme."""
    return [mark(place_of(view, name), view[name], "maximum")]


def usual(view: View) -> list[Shape]:
    """The limits of the shear angle that are usual."""
    return [level(view["shear_angle_upper"], "usual maximum"), level(view["shear_angle_lower"], "usual minimum")]


def motion(view: View) -> list[Shape]:
    """Cutting point, shear angle, speed and sliding over the cut."""
    return [
        panel(view, "Cutting point from the axis", "mm", ("cut_position", "x_c")),
        panel(view, "Shear angle", "deg", ("shear_angle", "τ"), levels=usual(view)),
        panel(view, "Speed of the cutting point", "m/s", ("cut_speed", "v_c")),
        panel(view, "Sliding ratio", "1", ("sliding_ratio", "k")),
    ]


def load(view: View) -> list[Shape]:
    """Force and torque over the cut."""
    forces = (("force", phrase("force")), ("working_force", "by virtual work"))
    torques = (
        ("torque", phrase("whole")),
        ("friction_torque", phrase("friction")),
        ("useful_torque", phrase("cutting")),
    )
    return [
        panel(view, "Downward force on the board", "N", *forces, marks=greatest(view, "force_max")),
        panel(view, "Torque at the knife's shaft", "N*m", *torques, marks=greatest(view, "torque_max")),
    ]


def placement(view: View) -> list[Shape]:
    """Shear angle, force and torque over the distance of the board's front edge, all else as it is."""
    least = max(view["lowest_at_face"], view["lowest_at_counter"])
    most = view["reach_greatest"] - view["cut_length"]
    distances = least + np.linspace(0.01, 0.97, 97) * (most - least)
    names = ("shear_angle_min", "shear_angle_max", "guillotine_force_ratio", "torque_max")
    found = view.varied({"front_distance": distances}, *names)
    across = ("distance of the board's front edge", "b", "mm")
    here = [vertical(view["front_distance"], "this machine")]
    slopes = [
        line(distances, found["shear_angle_max"], "at the end"),
        line(distances, found["shear_angle_min"], "at the start"),
    ]
    return [
        chart_panel("Shear angle", "deg", *across, lines=slopes, levels=usual(view), verticals=here),
        chart_panel("Ratio of the maximum force to that of a guillotine", "1", *across,
                    lines=[line(distances, found["guillotine_force_ratio"], "F_max/F_g")], verticals=here),
        chart_panel("Maximum torque", "N*m", *across, lines=[line(distances, found["torque_max"], "M_max")], verticals=here),
    ]  # fmt: skip


FIGURES = (
    Drawing(
        "positions",
        "Knife, board and counter-knife",
        "To scale at start, middle and end of the cut; the knife turns clockwise about its shaft, the edge's centre O₁ moves on the "
        "light circle. The cross marks the cutting point; thick: the board on the counter-knife (hatched). Only the part of the edge "
        "that cuts is drawn, with 6° more at both ends.",
        build=positions,
        moving=turning,
        over="knife_angle",
    ),
    Drawing(
        "front",
        "Working front",
        "Board, edge and counter-knife in the middle of the cut, to scale. At the cross the board is cut through; along a the edge is in "
        "the board; the cut advances to the right. Dashed: the upper face where the board is cut.",
        build=front,
    ),
    Chart(
        "motion",
        "Motion over the cut",
        "Cutting point, shear angle with its usual limits, speed of the cutting point and sliding ratio of the edge, from start to end of "
        "the cut.",
        build=motion,
    ),
    Chart(
        "load",
        "Force and torque over the cut",
        "Downward force F_v on the board, with the smaller one by virtual work, F_w; torque at the knife's shaft with its components.",
        build=load,
    ),
    Chart(
        "placement",
        "Position of the board",
        "Shear angle, force and torque for other distances of the board's front edge from the axis, all else unchanged: further away the "
        "edge is steeper and the force smaller.",
        build=placement,
    ),
)
