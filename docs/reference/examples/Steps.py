"""A family of steps that two chapters share: once as it is, once for the other side, under other names."""

from __future__ import annotations

from diecut_report.api import Chapter, Inputs, Mechanism, Quantity, Step, Steps, m, prefixed


class Beam(Inputs):
    load = Quantity("F", "kN", "Load", gt=0)
    span = Quantity("L", "mm", "Span", gt=0)
    place = Quantity("a", "mm", "Distance of the load from the left end", ge=0)


family = Steps()
family.arm = m.span - m.place, "b", "mm", "Arm of the load"
family.reaction = m.load * m.arm / m.span, "R", "kN", "Reaction"

turned: tuple[Step, ...] = prefixed("right_", family, shared=(), symbol_suffix="_r")  # right_arm, right_reaction

left = Chapter("Left support")
left.add(family)
right = Chapter("Right support", text="The same family, as if the right support were the left one.")
right.add(turned)

MECHANISM = Mechanism(
    kind="beam", version="1.0", title="Beam", summary="Supports.", inputs=Beam, chapters=(left, right)
)

PRESS = """
mechanisms:
  beam: {kind: beam, load: 4 kN, span: 1 m, place: 250 mm}
"""
GIVES = {"beam.reaction": "3 kN"}
