"""Mass and moment of inertia of a shaft with its parts."""

from __future__ import annotations

from diecut_report.api import (
    Block,
    Chapter,
    ExampleBlock,
    Inputs,
    Mechanism,
    Quantity,
    Text,
    inner,
    m,
    parts,
    total,
    value,
)
from diecut_report.mechanics.sections import tube

# fmt: off


class Disc(Block):
    """A section of the shaft, or a part on it, as a disc."""

    name = Text("Name of the section or part")
    diameter = Quantity("D", "mm", "Diameter: of a gear, sprocket or pulley its reference, pitch or datum diameter", gt=0)
    bore = Quantity("d", "mm", "Bore", ge=0, default=0)
    width = Quantity("b", "mm", "Width", gt=0)
    density = Quantity("ρ", "kg/m**3", "Density", gt=0, default=7850)
    fill = Quantity("k_f", "1", "Fraction of the full disc that is there", gt=0, le=1, default=1)


class KnownMass(Block):
    """A part of known mass."""

    name = Text("Name of the part")
    mass = Quantity("m_b", "kg", "Mass of the part", ge=0)
    inertia = Quantity("J_b", "kg*m**2", "Moment of inertia of the part about the shaft's axis", ge=0, default=0)


class ShaftBody(Inputs):
    """Keys of ``shaft_body``."""

    discs = parts(Disc, "Sections of the shaft and parts on it, as discs")
    bodies = parts(KnownMass, "Parts of known mass", optional=True)


OF_DISC = {key: f"discs.{key}" for key in ("diameter", "bore", "width", "density", "fill")}
BODIES = ("bodies",)

body = Chapter("Mass and moment of inertia")
body.require("bored", m.discs.bore < m.discs.diameter, key="discs.{index}.bore",
    message="is not smaller than the diameter of {part}; take a smaller bore")
body.disc_mass = (inner(m.discs.fill * m.discs.density * tube(m.discs.diameter, m.discs.bore).area * m.discs.width,
    named_by="discs.name"), "m_k", "kg", "Mass of the section or part", "geometry")
body.disc_inertia = (inner(m.disc_mass * (m.discs.diameter ** 2 + m.discs.bore ** 2) / 8, named_by="discs.name"), "J_k", "kg*m**2",
    "Moment of inertia of the section or part", "geometry")
body.part_table("discs_table", "Sections and parts", "discs", ("disc_mass", "disc_inertia"))
body.discs_mass = total("sum", of="disc_mass", output=False), "m_d", "kg", "Mass of the sections and parts that are discs"
body.discs_inertia = total("sum", of="disc_inertia", output=False), "J_d", "kg*m**2", "Moment of inertia of the sections and parts that are discs"
body.bodies_mass = total("sum", of="bodies.mass", output=False, needs=BODIES), "m_B", "kg", "Mass of the other parts"
body.bodies_inertia = total("sum", of="bodies.inertia", output=False, needs=BODIES), "J_B", "kg*m**2", "Moment of inertia of the other parts"
body.mass = value(m.discs_mass + m.bodies_mass, needs=BODIES), "m", "kg", "Mass of the shaft with its parts"
body.mass = value(m.discs_mass, lacks=BODIES), "m", "kg", "Mass of the shaft with its parts"
body.inertia = value(m.discs_inertia + m.bodies_inertia, needs=BODIES), "J", "kg*m**2", "Moment of inertia of the shaft with its parts"
body.inertia = value(m.discs_inertia, lacks=BODIES), "J", "kg*m**2", "Moment of inertia of the shaft with its parts"

EXAMPLE = ExampleBlock("shaft_body", {
    "discs": [{"name": "journal", "diameter": "50 mm", "width": "40 mm"}, {"name": "seat", "diameter": "60 mm", "width": "320 mm"},
              {"name": "wheel", "diameter": "348 mm", "bore": "60 mm", "width": "50 mm"}],
    "bodies": [{"name": "disc", "mass": "9 kg"}],
})

MECHANISM = Mechanism(
    kind="shaft_body",
    version="1.0",
    title="Mass and moment of inertia of a shaft",
    summary="A shaft and the parts on it count as hollow discs of their reference, pitch or datum diameter, unless the mass of a part is given.",
    inputs=ShaftBody,
    example=EXAMPLE,
    chapters=(body,),
    key_results=("mass", "inertia"),
    assumptions=("Keyways, teeth and fillets are neglected; a part is a disc without hub and recesses, of which the given fraction is there.",),
)
