"""Angles are a dimension: where the number of radians is meant, or a ratio is an angle, the formula says so."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Annotated, Chapter, Inputs, Mechanism, Quantity, arccos, as_angle, as_number


class Belt(Inputs):
    wrap: Annotated[float, Quantity("β", "deg", "Angle of wrap", gt=0)]
    friction: Annotated[float, Quantity("μ", "1", "Friction", gt=0)]
    mass: Annotated[float, Quantity("m", "kg", "Mass", gt=0)]
    radius: Annotated[float, Quantity("r", "mm", "Radius", gt=0)]
    speed: Annotated[float, Quantity("ω", "rpm", "Angular speed", gt=0)]
    lift: Annotated[float, Quantity("s", "mm", "Lift along the rim", ge=0)]


belt = Chapter("Belt")
belt.value("ratio", "k", "1", "Ratio of the belt's tensions", lambda friction, wrap: np.exp(friction * as_number(wrap)))
belt.value("force", "F", "N", "Centrifugal force", lambda mass, radius, speed: mass * radius * as_number(speed) ** 2)
belt.value("turn", "φ", "deg", "Turn of the rim", lambda lift, radius: as_angle(lift / radius))
belt.value("rise", "γ", "deg", "Angle from the top", lambda lift, radius: arccos(1 - lift / radius))
belt.value("time", "T", "s", "Time of a turn: 2π is an angle", lambda speed: 2 * np.pi / speed)

MECHANISM = Mechanism(
    kind="belt", version="1.0", title="Belt", summary="A belt on a pulley.", inputs=Belt, chapters=(belt,)
)

PRESS = """
mechanisms:
  belt: {kind: belt, wrap: 180 deg, friction: 0.3, mass: 2 kg, radius: 100 mm, speed: 300 rpm, lift: 100 mm}
"""
GIVES = {
    "belt.ratio": "2.566",
    "belt.force": "197.4 N",
    "belt.turn": "1 rad",
    "belt.rise": "90 deg",
    "belt.time": "200 ms",
}
