"""Curves over an angle: a slide that springs a pad, with breakpoints, extremes, derivative, integral and zeros, and its diagram."""

from __future__ import annotations

import numpy as np

from diecut_report.api import (
    POINTS,
    Annotated,
    Chapter,
    Inputs,
    Level,
    Mark,
    Mechanism,
    Panel,
    Plot,
    Quantity,
    Series,
    Span,
)


class Slide(Inputs):
    stroke: Annotated[float, Quantity("h", "mm", "Stroke", gt=0)]
    pad: Annotated[float, Quantity("x_p", "mm", "Position at which the pad is met", gt=0)]
    stiffness: Annotated[float, Quantity("c", "N/mm", "Stiffness of the pad", gt=0)]
    n_points: Annotated[int, POINTS] = 72


motion = Chapter("Motion")
motion.require("meets", lambda pad, stroke: pad < stroke, key="pad", message="is {pad}, beyond the stroke {stroke}")
motion.value("meets_at", "φ_1", "deg", "Where the pad is met", lambda pad, stroke: np.arccos(1 - 2 * pad / stroke))
motion.value("leaves_at", "φ_2", "deg", "Where the pad is left", lambda meets_at: 2 * np.pi - meets_at)
motion.abscissa("angle", "φ", "deg", "Angle of the crank", 2 * np.pi)
motion.breakpoints("pad_ends", "angle", "meets_at", "leaves_at")
motion.value("position", "x", "mm", "Position", lambda stroke, angle: stroke / 2 * (1 - np.cos(angle)))
motion.derivative("slope", "x_1", "mm/rad", "Change of position by the angle", of="position")
motion.crossings("turning", "φ_t", "deg", "Where the slide turns back", of="slope")
motion.value(
    "force", "F", "N", "Force on the pad", lambda stiffness, position, pad: stiffness * np.maximum(position - pad, 0 * pad),
)  # fmt: skip
motion.reduction("force_max", "F_max", "N", "Greatest force", operation="max", of="force")
motion.reduction("force_mean", "F_m", "N", "Mean force", operation="mean", of="force")
motion.accumulated("impulse", "S", "N*rad", "Force that has been, over the angle", of="force")

MECHANISM = Mechanism(
    kind="slide",
    version="1.0",
    title="Slide",
    summary="Force of a pad on a slide.",
    inputs=Slide,
    chapters=(motion,),
    figures=(
        Plot(
            id="motion",
            title="Motion of the slide",
            caption="Above the position, below the force of the pad.",
            abscissa="angle",
            panels=(
                Panel(
                    title="position",
                    unit="mm",
                    series=(Series(curve="position", label="slide"),),
                    levels=(Level(value="pad", label="pad"),),
                    spans=(Span(start="meets_at", end="leaves_at", label="pressed"),),
                ),
                Panel(
                    title="force",
                    unit="N",
                    series=(Series(curve="force", label="pad"),),
                    marks=(Mark(x="force_max_at", y="force_max", label="greatest"),),
                ),
            ),
        ),
    ),
)

PRESS = """
mechanisms:
  slide: {kind: slide, stroke: 40 mm, pad: 30 mm, stiffness: 50 N/mm}
"""
GIVES = {"slide.meets_at": "120 deg", "slide.force_max": "500 N", "slide.turning_count": "2"}
