"""Inputs of the rubber end-of-stroke damper."""

from __future__ import annotations

from typing import ClassVar

from diecut_report.api import Annotated, Block, FromPress, Inputs, OneOf, Quantity
from diecut_report.plugins.damper.formulas import USUAL_LOSS, half_the_sheets

CYLINDER = ("mass", "inertia", "rolling_radius", "velocity")
STOPPED = ("carriage_mass", "static_unbalance", "contact_distance")
"""What is stopped beside a balanced cylinder: without it nothing that follows from the energy is checked."""


class DriveBlock(Block):
    """A drive that still pushes while the dampers stop the mass: its force, or its torque and the rolling radius."""

    one_of: ClassVar[tuple[OneOf, ...]] = (OneOf(("force",), ("torque", "rolling_radius")),)

    force: Annotated[
        float | None,
        Quantity("F", "N", "Force of the drive in the direction of travel, constant over the stop", gt=0),
    ] = None
    torque: Annotated[
        float | None,
        Quantity("M_F", "N*m", "Torque of the drive about the cylinder's axis, constant over the stop", gt=0),
    ] = None
    rolling_radius: Annotated[
        float | None, Quantity("R_F", "mm", "Radius on which the torque rolls the cylinder", gt=0)
    ] = None


class Damper(Inputs):
    """Keys of ``damper``."""

    one_of: ClassVar[tuple[OneOf, ...]] = (
        OneOf(("kinetic_energy",), (*CYLINDER, *STOPPED), CYLINDER, shared=("velocity",)),
        OneOf(("elastic_modulus",), ("shore_hardness",)),
    )

    kinetic_energy: Annotated[
        float | None,
        Quantity("W_k", "J", "Kinetic energy at contact of all that is stopped; or what it follows from", gt=0),
    ] = None
    mass: Annotated[float | None, Quantity("m", "kg", "Mass of the cylinder", gt=0)] = None
    inertia: Annotated[
        float | None, Quantity("I", "kg*m**2", "Moment of inertia of what rolls, about its axis", gt=0)
    ] = None
    rolling_radius: Annotated[float | None, Quantity("R", "mm", "Radius on which it rolls", gt=0)] = None
    velocity: Annotated[
        float | None,
        Quantity(
            "v", "m/s", "Speed at contact, not the drive's greatest; with it stop, deceleration and rebound", gt=0
        ),
    ] = None
    carriage_mass: Annotated[
        float | None, Quantity("m_c", "kg", "Mass of the carriages and of what else moves with the axis", ge=0)
    ] = None
    static_unbalance: Annotated[
        float | None, Quantity("me", "kg*m", "Static unbalance of the cylinder, away from the die at the end", ge=0)
    ] = None
    contact_distance: Annotated[
        float | None, Quantity("d_c", "mm", "Distance before the end of travel at which the damper is engaged", ge=0)
    ] = None
    elastic_modulus: Annotated[
        float | None, Quantity("E", "MPa", "Elastic modulus of the rubber; or shore_hardness", gt=0)
    ] = None
    shore_hardness: Annotated[
        float | None, Quantity("S_A", "1", "Shore A hardness of the rubber, for Gent's relation", ge=20, le=80)
    ] = None
    dynamic_stiffness_factor: Annotated[
        float | None,
        Quantity(
            "k_d", "1", "Dynamic stiffness of the rubber over its static one, at the speed of the impact", ge=1, le=5
        ),
    ] = None
    allowable_stress: Annotated[float, Quantity("[σ]", "MPa", "Allowed compression stress", gt=0)] = 1.0
    ring_width: Annotated[float, Quantity("l", "mm", "Width of the ring: one side of the pad", gt=0)]
    pad_height: Annotated[float, Quantity("y", "mm", "Height of the pad: its other side", gt=0)]
    damper_count: Annotated[int, Quantity("n", "1", "Dampers that act at once", ge=1, integer=True)] = 2
    adopted_length: Annotated[
        float | None,
        Quantity("H_a", "mm", "Length of the damper as it is made; if given, it is checked instead of sized", gt=0),
    ] = None
    length_step: Annotated[
        float, Quantity("s_H", "mm", "The sized length is rounded up to a multiple of this", gt=0)
    ] = 5
    max_strain: Annotated[
        float, Quantity("ε_max", "1", "Strain up to which the rubber obeys the linear law", gt=0, lt=1)
    ] = 0.20
    loss_fraction: Annotated[
        float | None,
        Quantity(
            "ψ",
            "1",
            f"Share of the energy that one impact loses; or loss_tangent; {USUAL_LOSS} where neither is given",
            ge=0,
            le=1,
        ),
    ] = None
    loss_tangent: Annotated[
        float | None,
        Quantity("η", "1", "Loss tangent of the rubber, tan δ; with it the share that is lost", ge=0, le=1),
    ] = None
    impacts_per_hour: Annotated[
        float | None,
        Quantity(
            "z",
            "1/h",
            "Impacts at one end of the travel, for the heat",
            gt=0,
            press=FromPress("press.productivity", half_the_sheets, optional=True),
        ),
    ] = None
    allowable_force: Annotated[
        float | None, Quantity("[P]", "N", "Force that carriage and frame bear at one damper", gt=0)
    ] = None
    allowable_deceleration: Annotated[
        float | None, Quantity("[a]", "m/s**2", "Allowed deceleration of the stop", gt=0)
    ] = None
    allowable_heat_power: Annotated[
        float | None, Quantity("[P_h]", "W", "Heat that the dampers of one end may give off", gt=0)
    ] = None
    drive: DriveBlock | None = None
