"""What must hold, and a text made of numbers that its message names."""

from __future__ import annotations

from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, m


class Spring(Inputs):
    stroke = Quantity("s", "mm", "Stroke", gt=0)
    free_length = Quantity("L_0", "mm", "Length without load", gt=0)
    solid_length = Quantity("L_c", "mm", "Length with coils on coils", gt=0)


travel = Chapter("Travel")
travel.travel = m.free_length - m.solid_length, "s_c", "mm", "Travel until coils touch"
travel.words("share", lambda stroke, travel: f"{stroke / travel:.0%}", ("stroke", "travel"))
travel.require(
    "fits",
    m.stroke < m.travel,
    key="stroke",
    message="is {stroke}, {share} of the travel; at most {travel:down} is possible",
)

MECHANISM = Mechanism(
    kind="spring", version="1.0", title="Spring", summary="Travel of a spring.", inputs=Spring, chapters=(travel,)
)

PRESS = """
mechanisms:
  spring: {kind: spring, stroke: 20 mm, free_length: 60 mm, solid_length: 25 mm}
"""
GIVES = {"spring.travel": "35 mm"}
