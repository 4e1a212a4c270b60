"""Mass of the shafts of a machine, and the inertia that turns with its main shaft."""

from __future__ import annotations

from diecut_report.api import Block, Chapter, ExampleBlock, Inputs, Mechanism, Quantity, Text, m, parts, total, value

# fmt: off


class TurningShaft(Block):
    """A shaft that turns steadily."""

    name = Text("Name of the shaft")
    ratio = Quantity("i", "1", "Speed of the shaft for each of the main shaft")
    mass = Quantity("m_k", "kg", "Mass of the shaft with its parts", ge=0)
    inertia = Quantity("J_k", "kg*m**2", "Moment of inertia of the shaft with its parts", ge=0)


class MovingShaft(Block):
    """A shaft that swings or turns in steps."""

    name = Text("Name of the shaft")
    mass = Quantity("m_s", "kg", "Mass of the shaft with its parts", ge=0)


class MachineInertia(Inputs):
    """Keys of ``machine_inertia``."""

    shafts = parts(TurningShaft, "Shafts that turn steadily")
    moving = parts(MovingShaft, "Shafts that swing or turn in steps", optional=True)


MOVING = ("moving",)

inertia = Chapter("Mass and inertia of the shafts",
    text="The inertia of each shaft is referred to the main shaft by the square of its ratio. That of shafts which swing or turn in steps is part of "
        "the mechanisms that move them.")
inertia.referred_inertia = (value(m.shafts.inertia * m.shafts.ratio ** 2, named_by="shafts.name"), "J_m", "kg*m**2",
    "Moment of inertia referred to the main shaft", "energy")
inertia.part_table("shafts_table", "Shafts", "shafts", ("referred_inertia",))
inertia.inertia = total("sum", of="referred_inertia"), "J", "kg*m**2", "Moment of inertia of all steadily turning shafts, referred to the main shaft"
inertia.turning_mass = total("sum", of="shafts.mass", output=False), "m_t", "kg", "Mass of the steadily turning shafts with their parts"
inertia.moving_mass = total("sum", of="moving.mass", output=False, needs=MOVING), "m_S", "kg", "Mass of the shafts that swing or turn in steps"
inertia.mass = value(m.turning_mass + m.moving_mass, needs=MOVING), "m", "kg", "Mass of all shafts with their parts"
inertia.mass = value(m.turning_mass, lacks=MOVING), "m", "kg", "Mass of all shafts with their parts"

EXAMPLE = ExampleBlock("machine_inertia", {
    "shafts": [{"name": "main", "ratio": 1, "mass": "57.8 kg", "inertia": "0.576 kg*m**2"},
               {"name": "crank", "ratio": 0.5, "mass": "36.9 kg", "inertia": "0.13 kg*m**2"}],
    "moving": [{"name": "rocker", "mass": "30 kg"}],
})

MECHANISM = Mechanism(
    kind="machine_inertia",
    version="1.0",
    title="Mass and inertia of the machine's shafts",
    summary="The mass of all shafts with the parts on them, and the moment of inertia of those that turn steadily, referred to the main shaft, which "
            "turns once a sheet.",
    inputs=MachineInertia,
    example=EXAMPLE,
    chapters=(inertia,),
    key_results=("inertia", "mass"),
    assumptions=("Shafts and joins are rigid.",),
)
