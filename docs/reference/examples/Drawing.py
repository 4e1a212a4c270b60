"""A drawing to scale, in metres: all shapes, with the roles in which they are drawn; the crank moves on a screen."""

from __future__ import annotations

import numpy as np

from diecut_report.api import (
    Chapter,
    Drawing,
    Inputs,
    Mechanism,
    Point,
    Quantity,
    Shape,
    View,
    abscissa,
    arc,
    arrow,
    box,
    circle,
    dimension,
    label,
    m,
    point,
    polyline,
    radius_dimension,
    region,
    rigid,
    samples,
)  # fmt: skip


class CrankSlider(Inputs):
    crank = Quantity("r", "mm", "Crank", gt=0)
    rod = Quantity("l", "mm", "Rod", gt=0)
    n_points = samples(72)


motion = Chapter("Motion")
motion.require("turns", m.crank < m.rod, key="rod", message="is {rod}; it must be longer than the crank {crank}")
motion.angle = abscissa(2 * np.pi), "φ", "deg", "Crank angle"
across, upwards = m.crank * np.cos(m.angle), m.crank * np.sin(m.angle)
motion.position = across + np.sqrt(m.rod**2 - upwards**2), "x", "mm", "Position"
motion.stroke = 2 * m.crank, "s", "mm", "Stroke"


def pose(view: View, angle: float) -> list[Shape]:
    """The links at a crank angle."""
    pin: Point = (view["crank"] * np.cos(angle), view["crank"] * np.sin(angle))
    slider: Point = (view.at("position", angle), 0.0)
    return [
        polyline([(0.0, 0.0), pin, slider], "link"),
        point((0.0, 0.0), "pivot"),
        point(pin, "joint"),
        rigid([polyline([(-0.01, -0.01), (0.01, -0.01), (0.01, 0.01), (-0.01, 0.01)], "outline", closed=True)], slider),
        point(slider, "joint"),
    ]


def shapes(view: View) -> list[Shape]:
    """All shapes; lengths in metres, angles in rad."""
    r, x = view["crank"], view.at("position", np.pi / 3)
    h = r / 3
    return [
        circle((0.0, 0.0), r, "ghost"),
        arc((0.0, 0.0), 0.4 * r, 0.0, np.pi / 3, "mark"),
        polyline([(-1.3 * r, 0.0), (x + 2 * r, 0.0)], "centerline"),
        polyline([(x - r, -h), (x + r, -h)], "ground"),
        region([(x - h, -h), (x + h, -h), (x + h, h), (x - h, h)]),
        *pose(view, np.pi / 3),
        radius_dimension((0.0, 0.0), r, 2.4, view.text("crank")),
        dimension((x - h, h), (x + h, h), 0.5 * r, "slider"),
        arrow((x + 1.8 * r, 0.0), (x + 0.6 * r, 0.0), text="F"),
        label((-1.2 * r, -1.2 * r), "crank drive"),
        box((x, -1.4 * r), 2 * r, 0.6 * r, ["frame"]),
    ]


MECHANISM = Mechanism(
    kind="crank_slider", version="1.0", title="Crank drive", summary="A crank drive.", inputs=CrankSlider, chapters=(motion,),
    figures=(
        Drawing("drive", "Crank drive", "To scale at 60° of the crank.", build=shapes, moving=pose, over="angle"),
    ),
)  # fmt: skip

PRESS = """
mechanisms:
  drive: {kind: crank_slider, crank: 30 mm, rod: 90 mm}
"""
GIVES = {"drive.stroke": "60 mm"}
