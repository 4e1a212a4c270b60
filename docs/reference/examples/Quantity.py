"""Inputs of all sorts: bounds, a default, whole and listed numbers, a choice, yes or no, and what takes part in which case."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, Text, m, pi, value


class Wheel(Inputs):
    speed = Quantity("n", "rpm", "Speed of the wheel", gt=0, le=3000)
    teeth = Quantity("z", "1", "Teeth of the wheel", ge=12, integer=True)
    pressure_angle = Quantity("α", "deg", "Pressure angle", listed=(15, 20, 25), default=20)
    use = Text("What the wheel is for", ("drive", "convey"), default="drive")
    reversing = Text("Whether it turns both ways", default=False)


meshing = Chapter("Meshing")
meshing.mesh_rate = m.teeth * m.speed / (2 * pi), "f_z", "1/s", "Teeth that mesh in a second"
meshing.changes = value(2 * m.mesh_rate, needs=("reversing=true", "use=drive")), "f_r", "1/s", "Changes of load"
meshing.undercut = 2 / np.sin(m.pressure_angle) ** 2, "z_g", "1", "Least teeth without undercut"

MECHANISM = Mechanism(
    kind="wheel", version="1.0", title="Wheel", summary="Rate at which teeth mesh.", inputs=Wheel, chapters=(meshing,)
)

PRESS = """
mechanisms:
  wheel: {kind: wheel, speed: 60 rpm, teeth: 20, reversing: true}
"""
GIVES = {"wheel.mesh_rate": "20 1/s", "wheel.changes": "40 1/s", "wheel.undercut": "17.1"}
