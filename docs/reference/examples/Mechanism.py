"""A whole mechanism: a bracket that carries a load, with a check, a source and an erratum of it."""

from __future__ import annotations

from diecut_report.api import Chapter, Check, Erratum, Inputs, Mechanism, Quantity, Source, m


class Bracket(Inputs):
    force = Quantity("F", "kN", "Load", gt=0)
    arm = Quantity("a", "mm", "Distance of the load from the wall", gt=0)
    width = Quantity("b", "mm", "Width of the bar", gt=0)
    height = Quantity("h", "mm", "Height of the bar", gt=0)
    allowable_stress = Quantity("[σ]", "MPa", "Allowed bending stress", gt=0, optional=True)


bending = Chapter("Bending", text="The bar is clamped at the wall and loaded at its end.")
bending.moment = m.force * m.arm, "M", "N*m", "Bending moment at the wall"
bending.modulus = m.width * m.height**2 / 6, "W", "cm**3", "Section modulus"
bending.stress = m.moment / m.modulus, "σ", "MPa", "Bending stress", "1"

MECHANISM = Mechanism(
    kind="bracket",
    version="1.0",
    title="Bracket",
    summary="Bending of a bar that carries a load at its end.",
    inputs=Bracket,
    chapters=(bending,),
    key_results=("stress",),
    checks=(
        Check(
            "stress",
            "strength",
            "Bending stress",
            m.stress,
            m.allowable_stress,
            needs=("allowable_stress",),
            consequence="a higher bar lowers it by the square of its height.",
        ),
    ),
    assumptions=("The bar's own weight is neglected.",),
    sources=(Source("1", "Any book on the strength of materials, bending of straight bars."),),
    errata=(Erratum("1", "The second edition prints h for h².", touches=("modulus",)),),
)

PRESS = """
mechanisms:
  bracket: {kind: bracket, force: 2 kN, arm: 300 mm, width: 20 mm, height: 60 mm, allowable_stress: 80 MPa}
"""
GIVES = {"bracket.moment": "600 N*m", "bracket.stress": "50 MPa"}
