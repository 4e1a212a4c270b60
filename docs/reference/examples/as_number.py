"""Angles are a dimension: where the number of radians is meant, or a ratio is an angle, the formula says so."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, arccos, as_angle, as_number, m, pi


class Belt(Inputs):
    wrap = Quantity("β", "deg", "Angle of wrap", gt=0)
    friction = Quantity("μ", "1", "Friction", gt=0)
    mass = Quantity("m", "kg", "Mass", gt=0)
    radius = Quantity("r", "mm", "Radius", gt=0)
    speed = Quantity("ω", "rpm", "Angular speed", gt=0)
    lift = Quantity("s", "mm", "Lift along the rim", ge=0)


belt = Chapter("Belt")
belt.ratio = np.exp(m.friction * as_number(m.wrap)), "k", "1", "Ratio of the belt's tensions"
belt.force = m.mass * m.radius * as_number(m.speed) ** 2, "F", "N", "Centrifugal force"
belt.turn = as_angle(m.lift / m.radius), "φ", "deg", "Turn of the rim"
belt.rise = arccos(1 - m.lift / m.radius), "γ", "deg", "Angle from the top"
belt.time = 2 * pi / m.speed, "T", "s", "Time of a turn: 2π is an angle"

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
