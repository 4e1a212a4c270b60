"""A bar over the turn of a main shaft, which is dragged on the live page, and the mechanism whose drawing moves with it."""

from __future__ import annotations

import numpy as np

from diecut_report.api import (
    Chapter,
    Drawing,
    Driven,
    Grip,
    Inputs,
    Mechanism,
    MechanismInput,
    Quantity,
    View,
    abscissa,
    label,
    m,
    pi,
    polyline,
    samples,
)

TURN = 2 * np.pi


class Line(Inputs):
    runs = MechanismInput("Mechanism that runs with the shaft")
    offset = Quantity("Φ_0", "deg", "Shaft angle of its zero", ge=0, lt=360, default=0)
    n_points = samples(72)


turn = Chapter("Turn")
turn.shaft = abscissa(TURN), "Φ", "deg", "Shaft angle"
turn.middle = m.offset + pi, "Φ_1", "deg", "Shaft angle of its half"
turn.prepared("name", lambda known: known["runs"].name, ("runs",))


def bar(view: View, angle: float):
    """The period of the mechanism from its zero, a metre for a turn, and where the shaft is."""
    start, now = view["offset"] / TURN, angle / TURN
    grip = Grip("offset", TURN, view["offset"])
    return [
        polyline([(start, 0.0), (start + 1, 0.0), (start + 1, 0.1), (start, 0.1)], closed=True, grip=grip),
        polyline([(view["middle"] / TURN, 0.0), (view["middle"] / TURN, 0.1)], "centerline"),
        label((start, 0.15), view.prepared("name")),
        polyline([(now, -0.1), (now, 0.2)], "mark"),
    ]


MECHANISM = Mechanism(
    kind="line", version="1.0", title="Line", summary="Runs with the shaft.", inputs=Line, chapters=(turn,),
    figures=(
        Drawing(
            "line", "Line", "Its period.", schematic=True, build=lambda view: bar(view, 0.0), moving=bar, over="shaft",
            drives=lambda view: [Driven(view.prepared("name"), view["offset"], TURN)],
        ),
    ),
)  # fmt: skip

PRESS = """
mechanisms:
  line: {kind: line, runs: knife, offset: 30 deg}
  knife: {kind: circular_knife, eccentricity: 20 mm, edge_radius: 100 mm, depth: 112 mm, front_distance: 26 mm, thickness: 0.5 mm,
          cut_length: 15 mm, sharpening_angle: 20 deg, speed: 60 rpm, shear_resistance: 42 N/mm**2}
"""
GIVES = {"line.middle": "210 deg"}
