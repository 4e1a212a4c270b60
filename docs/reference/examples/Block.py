"""Repeated parts: a list of blocks; a formula of their keys gives a row, which is summed, run up, and asked for one part."""

from __future__ import annotations

from diecut_report.api import Annotated, Block, Chapter, Inputs, Mechanism, Quantity, Text, bind


class Section(Block):
    length: Annotated[float, Quantity("l", "mm", "Length of the section", gt=0)]
    diameter: Annotated[float, Quantity("d", "mm", "Diameter of the section", gt=0)]


class Spindle(Inputs):
    sections: Annotated[list[Section], Text("Sections from left to right")]


rows = Chapter("Sections")
rows.neighbour("next_diameter", "d_n,k", "mm", "Diameter of the next section", of="sections.diameter")
rows.value(
    "step", "Δd_k", "mm", "Step to the next section", bind(lambda n, d: n - d, n="next_diameter", d="sections.diameter")
)
rows.running("end", "x_k", "mm", "Right end of the section", operation="sum", of="sections.length")
rows.total("length", "L", "mm", "Length of the spindle", operation="sum", of="sections.length")
rows.total("thickest", "d_max", "mm", "Greatest diameter", operation="max", of="sections.diameter")
rows.part("last_end", "x_e", "mm", "Right end of the last section", of="end", index=-1)

MECHANISM = Mechanism(
    kind="spindle",
    version="1.0",
    title="Spindle",
    summary="Lengths of a stepped spindle.",
    inputs=Spindle,
    chapters=(rows,),
)

PRESS = """
mechanisms:
  spindle: {kind: spindle, sections: [{length: 30 mm, diameter: 20 mm}, {length: 50 mm, diameter: 28 mm}]}
"""
GIVES = {"spindle.length": "80 mm", "spindle.last_end": "80 mm", "spindle.step.0": "8 mm", "spindle.thickest": "28 mm"}
