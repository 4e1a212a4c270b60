"""Figures of the circular knife."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import Chart, Drawing, Shape, View, chart_panel, level, line, mark, phrase, vertical
from diecut_report.plugins.circular_knife.drawing import front, positions, turning

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
        id="positions",
        title="Knife, board and counter-knife",
        caption="To scale at start, middle and end of the cut; the knife turns clockwise about its shaft, the edge's centre O₁ moves on the "
        "light circle. The cross marks the cutting point; thick: the board on the counter-knife (hatched). Only the part of the edge "
        "that cuts is drawn, with 6° more at both ends.",
        build=positions,
        moving=turning,
        over="knife_angle",
    ),
    Drawing(
        id="front",
        title="Working front",
        caption="Board, edge and counter-knife in the middle of the cut, to scale. At the cross the board is cut through; along a the edge is in "
        "the board; the cut advances to the right. Dashed: the upper face where the board is cut.",
        build=front,
    ),
    Chart(
        id="motion",
        title="Motion over the cut",
        caption="Cutting point, shear angle with its usual limits, speed of the cutting point and sliding ratio of the edge, from start to end of "
        "the cut.",
        build=motion,
    ),
    Chart(
        id="load",
        title="Force and torque over the cut",
        caption="Downward force F_v on the board, with the smaller one by virtual work, F_w; torque at the knife's shaft with its components.",
        build=load,
    ),
    Chart(
        id="placement",
        title="Position of the board",
        caption="Shear angle, force and torque for other distances of the board's front edge from the axis, all else unchanged: further away the "
        "edge is steeper and the force smaller.",
        build=placement,
    ),
)
