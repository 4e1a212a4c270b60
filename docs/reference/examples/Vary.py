"""What may be changed where a check fails: the report tells the values with which it holds."""

from __future__ import annotations

from diecut_report.api import AdviceWay, Chapter, Check, Inputs, Mechanism, Quantity, Vary, m


class Bracket(Inputs):
    force = Quantity("F", "N", "Force", gt=0)
    arm = Quantity("a", "mm", "Arm", gt=0)
    width = Quantity("b", "mm", "Width", gt=0)
    height = Quantity("h", "mm", "Height", gt=0)
    allowable_stress = Quantity("[σ]", "MPa", "Allowed stress", gt=0, default=100)


bending = Chapter("Bending")
bending.stress = 6 * m.force * m.arm / (m.width * m.height**2), "σ", "MPa", "Stress"

STRONGER: tuple[AdviceWay, ...] = (
    "arm",  # to whichever side helps
    Vary("height", "up", series=(12, 16, 20, 25)),  # bars that can be bought, in mm
    ("width", "height"),  # both in one proportion
)

MECHANISM = Mechanism(
    kind="advised_bracket",
    version="1.0",
    title="Bracket",
    summary="A bracket.",
    inputs=Bracket,
    chapters=(bending,),
    checks=(
        Check(
            "stress",
            "strength",
            "Stress",
            m.stress,
            m.allowable_stress,
            consequence="the bracket bends.",
            advise=STRONGER,
        ),
    ),
)

PRESS = """
mechanisms:
  bracket: {kind: advised_bracket, force: 900 N, arm: 100 mm, width: 20 mm, height: 10 mm}
"""
GIVES = {"bracket.stress": "270 MPa"}
