"""What joins the shafts of a machine, and how fast they turn."""

from __future__ import annotations

from typing import Any

from diecut_report.api import (
    Block,
    Chapter,
    Check,
    ExampleBlock,
    FromPress,
    Inputs,
    Mechanism,
    Quantity,
    Source,
    Text,
    formula,
    inner,
    m,
    parts,
    pi,
    total,
    value,
)
from diecut_report.mechanics import drive_line as formulas

# fmt: off


@formula
def at_main_shaft(torque: Any, ratio: Any) -> Any:
    """Torque of a brake referred to the main shaft."""
    return torque * abs(ratio)


class ShaftRatio(Block):
    """A shaft that turns steadily."""

    name = Text("Name of the shaft")
    ratio = Quantity("i", "1", "Speed of the shaft for each of the main shaft")


class Mesh(Block):
    """A pair of gears, from the driving one to the driven one."""

    name = Text("Name of the pair")
    module = Quantity("m_n", "mm", "Normal module", gt=0)
    helix_angle = Quantity("β", "deg", "Helix angle, positive where the driving gear is right-handed", ge=-30, le=30, default=0)
    teeth_1 = Quantity("z_1", "1", "Number of teeth of the driving gear", ge=5, integer=True)
    teeth_2 = Quantity("z_2", "1", "Number of teeth of the driven gear", ge=5, integer=True)


class ChainDrive(Block):
    """A chain, from the driving sprocket to the driven one."""

    name = Text("Name of the chain")
    pitch = Quantity("p", "mm", "Pitch of the chain", gt=0)
    links = Quantity("X", "1", "Number of links", ge=8, integer=True)
    teeth_1 = Quantity("z_3", "1", "Number of teeth of the driving sprocket", ge=6, integer=True)
    teeth_2 = Quantity("z_4", "1", "Number of teeth of the driven sprocket", ge=6, integer=True)
    strands = Quantity("s", "1", "Number of chains side by side", ge=1, le=4, integer=True, default=1)
    mass_per_length = Quantity("q", "kg/m", "Mass per unit length of one chain", gt=0)
    moving_mass = Quantity("m_c", "kg", "Mass that the chains move, without the chains themselves", ge=0, default=0)
    pretension = Quantity("F_v", "N", "Pretension of each chain", ge=0, default=0)


class Belt(Block):
    """A V-belt, from the driving pulley to the driven one."""

    name = Text("Name of the belt")
    diameter_1 = Quantity("d_1", "mm", "Datum diameter of the driving pulley", gt=0)
    diameter_2 = Quantity("d_2", "mm", "Datum diameter of the driven pulley", gt=0)


class Rolling(Block):
    """A chain that rolls a cylinder: it moves its axis, which must be as much as its turning makes it roll."""

    name = Text("Name of the chain")
    teeth = Quantity("z_r", "1", "Number of teeth of the driving sprocket", ge=6, integer=True)
    pitch = Quantity("p_r", "mm", "Pitch of the chain", gt=0)
    radius = Quantity("R", "mm", "Radius of the cylinder", gt=0)


class Brake(Block):
    """A brake on a shaft that turns steadily."""

    name = Text("Name of the brake")
    torque = Quantity("M_b", "N*m", "Torque of the brake on its shaft", gt=0)
    ratio = Quantity("i_B", "1", "Speed of its shaft for each of the main shaft")


class HeldBrake(Block):
    """A brake behind a clutch, on a shaft that turns steadily."""

    name = Text("Name of the brake")
    torque = Quantity("M_h", "N*m", "Torque of the brake on its shaft", gt=0)
    ratio = Quantity("i_H", "1", "Speed of its shaft for each of the main shaft")


class DriveLine(Inputs):
    """Keys of ``drive_line``."""

    reference_speed = Quantity("ω_m", "rpm", "Speed of the main shaft, which turns once a sheet", gt=0,
        press=FromPress("press.productivity", formula(lambda productivity: 2 * pi * productivity)))
    shafts = parts(ShaftRatio, "Shafts that turn steadily")
    meshes = parts(Mesh, "Pairs of gears", optional=True)
    chains = parts(ChainDrive, "Chains", optional=True)
    rolling = parts(Rolling, "Chains that roll a cylinder", optional=True)
    belts = parts(Belt, "V-belts", optional=True)
    brakes = parts(Brake, "Brakes that stop the flywheel", optional=True)
    clutch_brakes = parts(HeldBrake, "Brakes behind a clutch, which hold what it drives and do not stop the flywheel", optional=True)


turning = Chapter("Speeds of the shafts")
turning.speed = value(m.shafts.ratio * m.reference_speed, named_by="shafts.name"), "n", "rpm", "Speed of the shaft", "kinematics"
turning.part_table("shafts_table", "Shafts", "shafts", ("speed",))

joins = Chapter("Gears, chains and belts", needs=("meshes",))
joins.mesh_ratio = (value(formulas.speed_ratio.of(driving=m.meshes.teeth_1, driven=m.meshes.teeth_2), named_by="meshes.name"), "i_z", "1",
    "Speed of the driven gear for each of the driving one", "kinematics")
for number, gear in ((1, "driving"), (2, "driven")):
    joins[f"radius_{number}"] = (inner(formulas.pitch_radius.of(module=m.meshes.module, teeth=m[f"meshes.teeth_{number}"],
        helix_angle=m.meshes.helix_angle), named_by="meshes.name"), f"r_{number}", "mm", f"Pitch radius of the {gear} gear", "ISO 21771")
joins.center_distance = value(formulas.center_distance, named_by="meshes.name"), "a", "mm", "Centre distance", "ISO 21771"
joins.part_table("meshes_table", "Pairs of gears", "meshes", ("mesh_ratio", "radius_1", "radius_2", "center_distance"))
drives = Chapter("Chains", needs=("chains",))
drives.chain_travel = (value(formulas.chain_travel.of(teeth=m.chains.teeth_1, pitch=m.chains.pitch), named_by="chains.name"), "v_φ", "mm",
    "Travel of the chain per radian of the driving sprocket", "kinematics")
drives.chain_length = value(m.chains.links * m.chains.pitch, named_by="chains.name"), "L_c", "mm", "Length of the chain", "geometry"
drives.chain_mass = (value(m.chains.strands * m.chains.links * m.chains.pitch * m.chains.mass_per_length + m.chains.moving_mass,
    named_by="chains.name"), "m_K", "kg", "Mass of the chains with what they move", "geometry")
drives.chain_pull = (inner(2 * m.chains.strands * m.chains.pretension, named_by="chains.name"), "F_0", "N",
    "Load of all chains at rest on the shaft of their sprockets", "statics")
drives.part_table("chains_table", "Chains", "chains", ("chain_travel", "chain_length", "chain_mass", "chain_pull"))
rolling = Chapter("Rolling of the cylinder", needs=("rolling",))
rolling.rolling_travel = (inner(formulas.chain_travel.of(teeth=m.rolling.teeth, pitch=m.rolling.pitch)), "v_R", "mm",
    "Travel of the chain per radian of its sprocket", "kinematics")
rolling.rolling_error = (inner(abs(m.rolling_travel / m.rolling.radius - 1)), "ε_R", "%",
    "Relative difference of travel and radius: the cylinder slips on the board by that much", "kinematics")
rolling.part_table("rolling_table", "Rolling of the cylinder", "rolling", ("rolling_travel", "rolling_error"))
rolling.require("rolls", m.rolling_error <= 0.005, key="rolling.{index}.teeth",
    message="moves the cylinder's axis by {rolling_travel} a radian, but its radius is {rolling.radius}: it slips by {rolling_error}, more than "
    "0.5 %; take other teeth, or another radius")
belts = Chapter("V-belts", needs=("belts",))
belts.belt_ratio = (value(formulas.speed_ratio.of(driving=m.belts.diameter_2, driven=m.belts.diameter_1), named_by="belts.name"), "i_b", "1",
    "Speed of the driving pulley for each of the driven one, without creep", "kinematics")
belts.part_table("belts_table", "V-belts", "belts", ("belt_ratio",))
brakes = Chapter("Brakes", needs=("brakes",))
brakes.referred_torque = (inner(at_main_shaft.of(torque=m.brakes.torque, ratio=m.brakes.ratio), named_by="brakes.name"), "M_b,m", "N*m",
    "Torque of the brake referred to the main shaft", "statics")
brakes.part_table("brakes_table", "Brakes", "brakes", ("referred_torque",))
brakes.brake_torque = total("sum", of="referred_torque"), "M_b,Σ", "N*m", "Torque of all brakes, referred to the main shaft"
held = Chapter("Brakes behind a clutch", needs=("clutch_brakes",))
held.held_torque = (inner(at_main_shaft.of(torque=m.clutch_brakes.torque, ratio=m.clutch_brakes.ratio), named_by="clutch_brakes.name"), "M_h,m",
    "N*m", "Torque of the brake referred to the main shaft", "statics")
held.part_table("clutch_brakes_table", "Brakes behind a clutch", "clutch_brakes", ("held_torque",))

EXAMPLE = ExampleBlock("drive_line", {
    "reference_speed": "100 rpm",
    "shafts": [{"name": "main", "ratio": 1}, {"name": "crank", "ratio": 0.5}],
    "meshes": [{"name": "crank_drive", "module": "5 mm", "teeth_1": 24, "teeth_2": 48}],
    "chains": [{"name": "cylinder", "pitch": "12.7 mm", "links": 240, "teeth_1": 52, "teeth_2": 52, "mass_per_length": "0.69 kg/m"}],
    "rolling": [{"name": "cylinder", "teeth": 52, "pitch": "12.7 mm", "radius": "105.1 mm"}],
    "belts": [{"name": "motor", "diameter_1": "125 mm", "diameter_2": "375 mm"}],
    "brakes": [{"name": "main_disc", "torque": "400 N*m", "ratio": 1}],
    "clutch_brakes": [{"name": "crank_drum", "torque": "200 N*m", "ratio": 0.5}],
})

MECHANISM = Mechanism(
    kind="drive_line",
    version="1.0",
    title="Shafts of the drive line",
    summary="Ratios, pitch radii and centre distances of what joins the shafts of a machine, and the speeds of those that turn steadily.",
    inputs=DriveLine,
    example=EXAMPLE,
    chapters=(joins, drives, rolling, belts, turning, brakes, held),
    sources=(Source("ISO 21771", "ISO 21771:2007, Gears. Cylindrical involute gears and gear pairs. Concepts and geometry."),),
    checks=(
        Check("rolling", "practice", "Rolling of the cylinder", m.rolling_error, 0.1, severity="warn", needs=("rolling",),
              demand_label="difference of the chain's travel and the radius",
              consequence="the cylinder slips on the board while it cuts; take a radius that the chain's travel makes."),
    ),
    assumptions=("Shafts and joins are rigid and without backlash; a V-belt loses a hundredth of its speed.",),
)
