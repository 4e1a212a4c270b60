"""Curves that are written beside the report: a profile as a table and a drawing, and all curves over an abscissa as a table."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, CurveTable, Inputs, Mechanism, Profile, Quantity, abscissa, m, reduction, samples


class Disc(Inputs):
    radius = Quantity("r", "mm", "Radius", gt=0)
    lift = Quantity("h", "mm", "Lift", gt=0)
    n_points = samples(72)


contour = Chapter("Contour")
contour.angle = abscissa(2 * np.pi), "φ", "deg", "Angle"
contour.distance = m.radius + m.lift / 2 * (1 - np.cos(m.angle)), "ρ", "mm", "Distance from the axis"
contour.x = m.distance * np.cos(m.angle), "x", "mm", "Across"
contour.y = m.distance * np.sin(m.angle), "y", "mm", "Upwards"
contour.greatest = reduction("max", of="distance"), "ρ_max", "mm", "Greatest distance"

MECHANISM = Mechanism(
    kind="disc", version="1.0", title="Disc", summary="A disc cam.", inputs=Disc, chapters=(contour,),
    exports=(Profile(id="disc", title="Contour", columns=("x", "y")), CurveTable(id="all", title="Curves", columns=("angle",))),
)  # fmt: skip

PRESS = """
mechanisms:
  disc: {kind: disc, radius: 40 mm, lift: 10 mm}
"""
GIVES = {"disc.greatest": "50 mm"}
