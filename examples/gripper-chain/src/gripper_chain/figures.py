"""Figures of the gripper chain."""

from __future__ import annotations

import numpy as np

from diecut_report.api import (
    BarGroup,
    Bars,
    Chart,
    Drawing,
    Level,
    Mark,
    Panel,
    Plot,
    Series,
    Shape,
    View,
    chart_panel,
    line,
    mark,
)
from gripper_chain.drawing import loop


def wear(view: View) -> list[Shape]:
    """Return how sag and pull of the slack strand change while the chain wears."""
    elongation = np.linspace(0, 0.02, 61)
    found = view.varied({"elongation": elongation}, "sag_share", "slack_tension")
    axis, now = ("Elongation of the chain by wear", "ε", "%"), view["elongation"]
    return [
        chart_panel(
            "Ratio of the sag to the centre distance",
            "%",
            *axis,
            lines=[line(elongation, found["sag_share"], "ζ")],
            marks=[mark(now, view["sag_share"], "this chain")],
        ),
        chart_panel(
            "Pull of the slack strand",
            "N",
            *axis,
            lines=[line(elongation, found["slack_tension"], "F_s")],
            marks=[mark(now, view["slack_tension"], "this chain")],
        ),
    ]


FIGURES = (
    Drawing(
        "loop",
        "Chain, bars and stations",
        "The loop to scale: sprockets as polygons, the upper strand with its stations, the slack strand as a catenary, the gripper bars.",
        build=loop,
    ),
    Plot(
        "tooth",
        "Polygon effect over a tooth",
        "While the sprocket turns by a tooth the velocity rises and falls; where the next joint comes up, the acceleration jumps from "
        "its minimum to its maximum value.",
        abscissa="sprocket_angle",
        panels=(
            Panel(
                "Velocity",
                "m/s",
                series=(Series("velocity", "v_θ"),),
                levels=(Level("chain_speed", "mean"),),
                range=(None, None),
            ),
            Panel("Acceleration", "m/s**2", series=(Series("acceleration", "a_θ"),)),
            Panel(
                "Pull of a chain",
                "N",
                series=(Series("tension", "F_θ"),),
                marks=(Mark("tension_max_at", "tension_max", "maximum"),),
            ),
        ),
    ),
    Bars(
        "pulls",
        "Components of the pull",
        "Components of the maximum pull of a chain.",
        groups=(
            BarGroup(
                "Pull",
                "N",
                bars=(
                    ("slack strand", "slack_tension"),
                    ("centrifugal", "centrifugal_tension"),
                    ("stations and rails", "useful_tension"),
                    ("polygon", "polygon_tension"),
                    ("all", "tension_max"),
                ),
            ),
        ),
    ),
    Chart(
        "wear",
        "Wear",
        "A worn chain hangs deeper and pulls less at its slack side, until the sprockets are moved apart.",
        build=wear,
    ),
    Plot(
        "grippers",
        "Grippers over a turn of the main shaft",
        "Opening of the grippers that pass the pick-up point.",
        abscissa="main_angle",
        needs=("cam",),
        panels=(Panel("Opening", "mm", series=(Series("gripper_opening", "h_φ"),)),),
    ),
)
