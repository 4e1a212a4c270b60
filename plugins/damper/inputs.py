"""Inputs of the rubber end-of-stroke damper."""

from __future__ import annotations

from typing import ClassVar

from diecut_report.api import Annotated, Block, FromPress, Inputs, OneOf, Quantity, formula

# fmt: off

USUAL_LOSS = 0.2
CYLINDER = ("mass", "inertia", "rolling_radius", "velocity")
STOPPED = ("carriage_mass", "static_unbalance", "contact_distance")
"""What is stopped beside a balanced cylinder: without it nothing that follows from the energy is checked."""


class DriveBlock(Block):
    """A drive that still pushes while the dampers stop the mass: its force, or its torque and the rolling radius."""

    one_of: ClassVar[tuple[OneOf, ...]] = (OneOf(("force",), ("torque", "rolling_radius")),)

    force: Annotated[float | None, Quantity("F", "N", "Force of the drive in the direction of travel, constant over the stop", gt=0)] = None
    torque: Annotated[float | None, Quantity("M_F", "N*m", "Torque of the drive about the cylinder's axis, constant over the stop", gt=0)] = None
    rolling_radius: Annotated[float | None, Quantity("R_F", "mm", "Radius on which the torque rolls the cylinder", gt=0)] = None


class Damper(Inputs):
    """Keys of ``damper``."""

    one_of: ClassVar[tuple[OneOf, ...]] = (
        OneOf(("kinetic_energy",), (*CYLINDER, *STOPPED), CYLINDER, shared=("velocity",)),
        OneOf(("elastic_modulus",), ("shore_hardness",)),
    )

    kinetic_energy: Annotated[float | None,
        Quantity("W_k", "J", "Kinetic energy at contact of everything that is stopped; or the data it follows from", gt=0)] = None
    mass: Annotated[float | None, Quantity("m", "kg", "Mass of the cylinder", gt=0)] = None
    inertia: Annotated[float | None, Quantity("I", "kg*m**2", "Moment of inertia of the rolling body about its axis", gt=0)] = None
    rolling_radius: Annotated[float | None, Quantity("R", "mm", "Rolling radius", gt=0)] = None
    velocity: Annotated[float | None,
        Quantity("v", "m/s", "Speed at contact, not the maximum of the drive; required for stop, deceleration and rebound", gt=0)] = None
    carriage_mass: Annotated[float | None,
        Quantity("m_c", "kg", "Mass of the carriages and of everything else that moves with the axis", ge=0)] = None
    static_unbalance: Annotated[float | None, Quantity("me", "kg*m", "Static unbalance of the cylinder, away from the die at the end", ge=0)] = None
    contact_distance: Annotated[float | None, Quantity("d_c", "mm", "Distance before the end of travel at which the damper is engaged", ge=0)] = None
    elastic_modulus: Annotated[float | None, Quantity("E", "MPa", "Elastic modulus of the rubber; or shore_hardness", gt=0)] = None
    shore_hardness: Annotated[float | None, Quantity("S_A", "1", "Shore A hardness of the rubber, for Gent's relation", ge=20, le=80)] = None
    dynamic_stiffness_factor: Annotated[float | None,
        Quantity("k_d", "1", "Ratio of dynamic to static stiffness of the rubber, at the speed of the impact", ge=1, le=5)] = None
    allowable_stress: Annotated[float, Quantity("[σ]", "MPa", "Allowable compressive stress", gt=0)] = 1.0
    ring_width: Annotated[float, Quantity("l", "mm", "Width of the ring: one side of the pad", gt=0)]
    pad_height: Annotated[float, Quantity("y", "mm", "Height of the pad: its other side", gt=0)]
    damper_count: Annotated[int, Quantity("n", "1", "Number of dampers that act at once", ge=1, integer=True)] = 2
    adopted_length: Annotated[float | None,
        Quantity("H_a", "mm", "Actual length of the damper; if given, it is checked instead of sized", gt=0)] = None
    length_step: Annotated[float, Quantity("s_H", "mm", "Step to which the sized length is rounded up", gt=0)] = 5
    max_strain: Annotated[float, Quantity("ε_max", "1", "Strain up to which the rubber is linear", gt=0, lt=1)] = 0.20
    loss_fraction: Annotated[float | None,
        Quantity("ψ", "1", f"Fraction of the energy lost in one impact; or loss_tangent; {USUAL_LOSS} where neither is given", ge=0, le=1)] = None
    loss_tangent: Annotated[float | None, Quantity("η", "1", "Loss tangent of the rubber, tan δ; gives the fraction that is lost", ge=0, le=1)] = None
    impacts_per_hour: Annotated[float | None,
        Quantity("z", "1/h", "Impacts at one end of the travel per unit time, for the heat", gt=0,
            press=FromPress("press.productivity", formula(lambda productivity: productivity / 2), optional=True))] = None
    allowable_force: Annotated[float | None, Quantity("[P]", "N", "Allowable force on carriage and frame at one damper", gt=0)] = None
    allowable_deceleration: Annotated[float | None, Quantity("[a]", "m/s**2", "Allowable deceleration of the stop", gt=0)] = None
    allowable_heat_power: Annotated[float | None, Quantity("[P_h]", "W", "Allowable heat flow from the dampers of one end", gt=0)] = None
    drive: DriveBlock | None = None
