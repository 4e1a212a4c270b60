"""Curves over an angle: a slide that springs a pad, with breakpoints, extremes, derivative, integral and zeros, and its diagram."""

from __future__ import annotations

import numpy as np

from diecut_report.api import (
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
    abscissa,
    accumulated,
    crossings,
    derivative,
    m,
    pi,
    reduction,
    samples,
)


class Slide(Inputs):
    stroke = Quantity("h", "mm", "Stroke", gt=0)
    pad = Quantity("x_p", "mm", "Position at which the pad is met", gt=0)
    stiffness = Quantity("c", "N/mm", "Stiffness of the pad", gt=0)
    n_points = samples(72)


motion = Chapter("Motion")
motion.require("meets", m.pad < m.stroke, key="pad", message="is {pad}, beyond the stroke {stroke}")
motion.meets_at = np.arccos(1 - 2 * m.pad / m.stroke), "φ_1", "deg", "Where the pad is met"
motion.leaves_at = 2 * pi - m.meets_at, "φ_2", "deg", "Where the pad is left"
motion.angle = abscissa(2 * np.pi), "φ", "deg", "Angle of the crank"
motion.breakpoints("pad_ends", "angle", "meets_at", "leaves_at")
motion.position = m.stroke / 2 * (1 - np.cos(m.angle)), "x", "mm", "Position"
motion.slope = derivative(of="position"), "x_1", "mm/rad", "Change of position by the angle"
motion.turning = crossings(of="slope"), "φ_t", "deg", "Where the slide turns back"
motion.force = m.stiffness * np.maximum(m.position - m.pad, 0), "F", "N", "Force on the pad"
motion.force_max = reduction("max", of="force"), "F_max", "N", "Greatest force"
motion.force_mean = reduction("mean", of="force"), "F_m", "N", "Mean force"
motion.impulse = accumulated(of="force"), "S", "N*rad", "Force that has been, over the angle"

MECHANISM = Mechanism(
    kind="slide",
    version="1.0",
    title="Slide",
    summary="Force of a pad on a slide.",
    inputs=Slide,
    chapters=(motion,),
    figures=(
        Plot(
            "motion",
            "Motion of the slide",
            "Above the position, below the force of the pad.",
            abscissa="angle",
            panels=(
                Panel(
                    "position",
                    "mm",
                    series=(Series("position", "slide"),),
                    levels=(Level("pad", "pad"),),
                    spans=(Span("meets_at", "leaves_at", "pressed"),),
                ),
                Panel(
                    "force",
                    "N",
                    series=(Series("force", "pad"),),
                    marks=(Mark("force_max_at", "force_max", "greatest"),),
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
