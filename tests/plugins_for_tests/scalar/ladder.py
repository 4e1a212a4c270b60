"""A mechanism whose code can only calculate one machine at a time, as a plugin from elsewhere may be."""

from __future__ import annotations

import math
from typing import Any

from scipy.optimize import brentq

from diecut_report.api import Chapter, Check, Inputs, Mechanism, Quantity, computed


class Ladder(Inputs):
    long = Quantity("a", "m", "Longer ladder", gt=0, default=4.0)
    short = Quantity("b", "m", "Shorter ladder", gt=0, default=3.0)
    crossing = Quantity("c", "m", "Height of their crossing", gt=0, default=1.0)
    least = Quantity("w_min", "m", "Least width", gt=0, default=2.0)


def width(long: Any, short: Any, crossing: Any) -> Any:
    """Width of the alley in which two crossing ladders meet at a height; arrays of one machine alone."""
    a, b, c = long.item(), short.item(), crossing.item()

    def residual(w: float) -> float:
        return 1 / math.sqrt(a * a - w * w) + 1 / math.sqrt(b * b - w * w) - 1 / c

    return brentq(residual, 0, min(a, b) * (1 - 1e-12), xtol=1e-15)


alley = Chapter("Alley")
alley.width = (
    computed(width, takes=("long", "short", "crossing"), method="root of 1/√(a² − w²) + 1/√(b² − w²) = 1/c"),
    "w",
    "m",
    "Width of the alley",
    "geometry",
)

MECHANISM = Mechanism(
    kind="ladder",
    version="1",
    title="Crossing ladders",
    summary="Width of an alley in which two ladders cross.",
    inputs=Ladder,
    chapters=(alley,),
    checks=(
        Check(
            "wide",
            "strength",
            "Width",
            "least",
            "width",
            demand_label="needed",
            consequence="let the ladders cross lower.",
        ),
    ),
)
