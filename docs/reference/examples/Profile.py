"""Curves that are written beside the report: a profile as a table and a drawing, and all curves over an abscissa as a table."""

from __future__ import annotations

import numpy as np

from diecut_report.api import POINTS, Annotated, Chapter, CurveTable, Inputs, Mechanism, Profile, Quantity


class Disc(Inputs):
    radius: Annotated[float, Quantity("r", "mm", "Radius", gt=0)]
    lift: Annotated[float, Quantity("h", "mm", "Lift", gt=0)]
    n_points: Annotated[int, POINTS] = 72


contour = Chapter("Contour")
contour.abscissa("angle", "φ", "deg", "Angle", 2 * np.pi)
contour.value(
    "distance", "ρ", "mm", "Distance from the axis", lambda radius, lift, angle: radius + lift / 2 * (1 - np.cos(angle))
)
contour.value("x", "x", "mm", "Across", lambda distance, angle: distance * np.cos(angle))
contour.value("y", "y", "mm", "Upwards", lambda distance, angle: distance * np.sin(angle))
contour.reduction("greatest", "ρ_max", "mm", "Greatest distance", operation="max", of="distance")

MECHANISM = Mechanism(
    kind="disc", version="1.0", title="Disc", summary="A disc cam.", inputs=Disc, chapters=(contour,),
    exports=(Profile(id="disc", title="Contour", columns=("x", "y")), CurveTable(id="all", title="Curves", columns=("angle",))),
)  # fmt: skip

PRESS = """
mechanisms:
  disc: {kind: disc, radius: 40 mm, lift: 10 mm}
"""
GIVES = {"disc.greatest": "50 mm"}
