"""Inputs of the impression cylinder's drive."""

from __future__ import annotations

from typing import ClassVar

from diecut_report.api import POINTS, Annotated, FromPress, Inputs, OneOf, Quantity, formula, pi

# fmt: off


def _efficiency(index: str, of: str) -> Quantity:
    return Quantity(f"η_{index}", "1", f"Efficiency of the {of}", gt=0, le=1)


class CylinderDrive(Inputs):
    """Keys of ``cylinder_drive``."""

    one_of: ClassVar[tuple[OneOf, ...]] = (OneOf(("pinion_inertia", "rocker_inertia"), optional=True),)

    frame_ratio: Annotated[float, Quantity("λ_1", "1", "Frame-to-crank ratio, d/a", gt=0)] = 5.0
    coupler_ratio: Annotated[float, Quantity("λ_2", "1", "Coupler-to-crank ratio, b/a", gt=0)] = 5.0
    rocker_ratio: Annotated[float, Quantity("λ_3", "1", "Rocker-to-crank ratio, c/a", gt=0)] = 2.05
    crank_speed: Annotated[float | None,
        Quantity("ω_1", "rpm", "Speed of the crank; two sheets per revolution", gt=0,
            press=FromPress("press.productivity", formula(lambda productivity: 2 * pi * productivity / 2)))] = None
    sector_ratio: Annotated[float | None,
        Quantity("u", "1", "Ratio of sector to pinion; default: the full swing turns the cylinder by one revolution", gt=0,
            plausible=("0.01", "500"))] = None
    cylinder_radius: Annotated[float, Quantity("R", "mm", "Radius of the cylinder", gt=0)]
    cylinder_length: Annotated[float, Quantity("L", "mm", "Length of the cylinder's generatrix", gt=0)]
    cylinder_mass: Annotated[float, Quantity("m", "kg", "Mass of the cylinder", gt=0)]
    cylinder_inertia: Annotated[float, Quantity("I", "kg*m**2", "Moment of inertia of the cylinder about its axis", gt=0)]
    pinion_inertia: Annotated[float | None,
        Quantity("J_p", "kg*m**2", "Moment of inertia of the pinion's shaft with its parts", ge=0)] = None
    rocker_inertia: Annotated[float | None,
        Quantity("J_r", "kg*m**2", "Moment of inertia of the shaft of rocker and sector with its parts", ge=0)] = None
    cutting_force_per_length: Annotated[float, Quantity("q_a", "N/mm", "Cutting force per unit length of the rules", ge=0)] = 25
    ejection_force_per_length: Annotated[float, Quantity("q_e", "N/mm", "Force of the ejection material per unit length", ge=0)] = 5
    material_thickness: Annotated[float | None,
        Quantity("Δ", "mm", "Thickness of the board (below the radius)", gt=0, press=FromPress("press.sheet.thickness"))] = None
    rolling_coefficient: Annotated[float, Quantity("k_0", "1", "Ratio of rolling-resistance arm to cutting length", gt=0)] = 0.3
    cutting_arc_fraction: Annotated[float,
        Quantity("κ", "1", "Fraction of the stroke, in rolled length, over whose middle the board is cut", gt=0, le=1)] = 1.0
    static_unbalance: Annotated[float, Quantity("me", "kg*m", "Static unbalance of the cylinder", ge=0)] = 0
    efficiency_sector: Annotated[float, _efficiency("sector", "sector and pinion")] = 0.96
    efficiency_gear: Annotated[float, _efficiency("gear", "gear pair between crank and cylinder, if there is one")] = 1.0
    efficiency_four_bar: Annotated[float, _efficiency("four-bar", "four-bar linkage")] = 0.95
    efficiency_bearings: Annotated[float, _efficiency("bearings", "bearings")] = 0.99
    efficiency_chain: Annotated[float, _efficiency("chain", "chain")] = 0.95
    n_points: Annotated[int, POINTS] = 720
    min_transmission_angle: Annotated[float, Quantity("μ_min", "deg", "Minimum acceptable transmission angle", gt=0, le=90)] = 40
    segment_height: Annotated[float | None, Quantity("h", "mm", "Height of the cylinder's segment; required for the carriage window", gt=0)] = None
    carriage_clearance: Annotated[float | None, Quantity("c_r", "mm", "Clearance required by the carriages under the cylinder", gt=0)] = None
    standstill_rotation: Annotated[float,
        Quantity("θ_s", "deg", "Rotation of the cylinder from an end position within which it counts as standing still", gt=0, le=90)] = 2
    crank_length: Annotated[float | None, Quantity("a", "mm", "Length of the crank; required for the forces in the joints", gt=0)] = None
    pinion_radius: Annotated[float | None,
        Quantity("r_p", "mm", "Pitch radius of the pinion; required for the tooth force of the sector", gt=0)] = None
    allowable_torque: Annotated[float | None, Quantity("[M]", "N*m", "Allowable torque at the crank's shaft", gt=0)] = None
    allowable_acceleration: Annotated[float | None, Quantity("[a_c]", "m/s**2", "Allowable acceleration of the cylinder", gt=0)] = None
    allowable_tooth_force: Annotated[float | None,
        Quantity("[F_t]", "kN", "Allowable tangential force between the teeth of sector and pinion", gt=0)] = None
    allowable_joint_force: Annotated[float | None,
        Quantity("[F_j]", "kN", "Allowable force in the joints of the coupler and the crank's bearing", gt=0)] = None
    pressure_angle: Annotated[float, Quantity("α_w", "deg", "Pressure angle of the teeth", gt=0, lt=45)] = 20
