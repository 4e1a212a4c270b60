"""A kind that fills its inputs from another mechanism of the press, and a comparison of both that is run by itself."""

from __future__ import annotations

from diecut_report.api import Chapter, Comparison, Inputs, Mechanism, Partner, Quantity, Text, m


class Crank(Inputs):
    radius = Quantity("r", "mm", "Radius of the crank", gt=0)


class Rod(Inputs):
    crank = Text("Crank that moves the rod; the only one of the press if it is left out", optional=True)
    stroke = Quantity("s", "mm", "Stroke", gt=0)


class Both(Inputs):
    crank_radius = Quantity("r", "mm", "Radius of the crank", gt=0)
    rod_stroke = Quantity("s", "mm", "Stroke of the rod", gt=0)


strokes = Chapter("Stroke")
strokes.stroke = 2 * m.radius, "h", "mm", "Stroke of the crank"
half = Chapter("Half")
half.half = m.stroke / 2, "s_h", "mm", "Half of the stroke"
ratio = Chapter("Ratio")
ratio.ratio = m.rod_stroke / m.crank_radius, "k", "1", "Stroke to radius"

COMPARED = Mechanism(
    kind="stroke_ratio", version="1.0", title="Stroke ratio", summary="Compares.", inputs=Both, chapters=(ratio,)
)
CRANK = Mechanism(kind="crank", version="1.0", title="Crank", summary="Turns.", inputs=Crank, chapters=(strokes,))
ROD = Mechanism(
    kind="rod",
    version="1.0",
    title="Rod",
    summary="Goes to and fro.",
    inputs=Rod,
    chapters=(half,),
    partners=(Partner(key="crank", kinds=("crank",), takes={"stroke": "stroke"}),),
    comparisons=(
        Comparison(
            kinds=("crank", "rod"),
            mechanism=COMPARED,
            takes={"crank_radius": ("crank", "radius"), "rod_stroke": ("rod", "stroke")},
        ),
    ),
)

PRESS = """
mechanisms:
  crank: {kind: crank, radius: 40 mm}
  rod: {kind: rod}
"""
GIVES = {"rod.half": "40 mm"}
