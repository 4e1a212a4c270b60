"""A mechanism whose code can only calculate one machine at a time, as a plugin from elsewhere may be."""

from __future__ import annotations

import math
from typing import Any

from scipy.optimize import brentq

from diecut_report.api import Annotated, Chapter, Check, Computed, Inputs, Mechanism, Quantity


class Ladder(Inputs):
    long: Annotated[float, Quantity("a", "m", "Longer ladder", gt=0)] = 4.0
    short: Annotated[float, Quantity("b", "m", "Shorter ladder", gt=0)] = 3.0
    crossing: Annotated[float, Quantity("c", "m", "Height of their crossing", gt=0)] = 1.0
    least: Annotated[float, Quantity("w_min", "m", "Least width", gt=0)] = 2.0


def width(long: Any, short: Any, crossing: Any) -> Any:
    """Width of the alley in which two crossing ladders meet at a height; arrays of one machine alone."""
    a, b, c = long.item(), short.item(), crossing.item()

    def residual(w: float) -> float:
        return 1 / math.sqrt(a * a - w * w) + 1 / math.sqrt(b * b - w * w) - 1 / c

    return brentq(residual, 0, min(a, b) * (1 - 1e-12), xtol=1e-15)


MECHANISM = Mechanism(
    kind="ladder",
    version="1",
    title="Crossing ladders",
    summary="Width of an alley in which two ladders cross.",
    inputs=Ladder,
    chapters=(
        Chapter(
            "Alley",
            steps=(
                Computed(
                    id="width",
                    symbol="w",
                    unit="m",
                    description="Width of the alley",
                    source="geometry",
                    function=width,
                    takes=("long", "short", "crossing"),
                    method="root of 1/√(a² − w²) + 1/√(b² − w²) = 1/c",
                ),
            ),
        ),
    ),
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
