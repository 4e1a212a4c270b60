"""Repeated parts: a list of blocks; a formula of their keys gives a row, which is summed, run up, and asked for one part."""

from __future__ import annotations

from diecut_report.api import Block, Chapter, Inputs, Mechanism, Quantity, m, neighbour, part, parts, running, total


class Section(Block):
    length = Quantity("l", "mm", "Length of the section", gt=0)
    diameter = Quantity("d", "mm", "Diameter of the section", gt=0)


class Spindle(Inputs):
    sections = parts(Section, "Sections from left to right")


rows = Chapter("Sections")
rows.next_diameter = neighbour(of="sections.diameter"), "d_n,k", "mm", "Diameter of the next section"
rows.step = m.next_diameter - m.sections.diameter, "Δd_k", "mm", "Step to the next section"
rows.end = running("sum", of="sections.length"), "x_k", "mm", "Right end of the section"
rows.length = total("sum", of="sections.length"), "L", "mm", "Length of the spindle"
rows.thickest = total("max", of="sections.diameter"), "d_max", "mm", "Greatest diameter"
rows.last_end = part(of="end", index=-1), "x_e", "mm", "Right end of the last section"

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
