"""Inputs of the impression cylinder's drive."""

from __future__ import annotations

from diecut_report.api import FromPress, Inputs, OneOf, Quantity, formula, pi, samples

# fmt: off


def _efficiency(index: str, of: str, default: float) -> Quantity:
    return Quantity(f"η_{index}", "1", f"Efficiency of the {of}", gt=0, le=1, default=default)


class CylinderDrive(Inputs):
    """Keys of ``cylinder_drive``."""

    one_of = (OneOf(("pinion_inertia", "rocker_inertia"), optional=True),)

    frame_ratio = Quantity("λ_1", "1", "Frame-to-crank ratio, d/a", gt=0, default=5.0)
    coupler_ratio = Quantity("λ_2", "1", "Coupler-to-crank ratio, b/a", gt=0, default=5.0)
    rocker_ratio = Quantity("λ_3", "1", "Rocker-to-crank ratio, c/a", gt=0, default=2.05)
    crank_speed = Quantity("ω_1", "rpm", "Speed of the crank; two sheets per revolution", gt=0,
        press=FromPress("press.productivity", formula(lambda productivity: 2 * pi * productivity / 2)))
    sector_ratio = Quantity("u", "1", "Ratio of sector to pinion; default: the full swing turns the cylinder by one revolution", gt=0,
        plausible=("0.01", "500"), optional=True)
    cylinder_radius = Quantity("R", "mm", "Radius of the cylinder", gt=0)
    cylinder_length = Quantity("L", "mm", "Length of the cylinder's generatrix", gt=0)
    cylinder_mass = Quantity("m", "kg", "Mass of the cylinder", gt=0)
    cylinder_inertia = Quantity("I", "kg*m**2", "Moment of inertia of the cylinder about its axis", gt=0)
    pinion_inertia = Quantity("J_p", "kg*m**2", "Moment of inertia of the pinion's shaft with its parts", ge=0, optional=True)
    rocker_inertia = Quantity("J_r", "kg*m**2", "Moment of inertia of the shaft of rocker and sector with its parts", ge=0, optional=True)
    cutting_force_per_length = Quantity("q_a", "N/mm", "Cutting force per unit length of the rules", ge=0, default=25)
    ejection_force_per_length = Quantity("q_e", "N/mm", "Force of the ejection material per unit length", ge=0, default=5)
    material_thickness = Quantity("Δ", "mm", "Thickness of the board (below the radius)", gt=0, press=FromPress("press.sheet.thickness"))
    rolling_coefficient = Quantity("k_0", "1", "Ratio of rolling-resistance arm to cutting length", gt=0, default=0.3)
    cutting_arc_fraction = Quantity("κ", "1", "Fraction of the stroke, in rolled length, over whose middle the board is cut", gt=0, le=1, default=1.0)
    static_unbalance = Quantity("me", "kg*m", "Static unbalance of the cylinder", ge=0, default=0)
    efficiency_sector = _efficiency("sector", "sector and pinion", 0.96)
    efficiency_gear = _efficiency("gear", "gear pair between crank and cylinder, if there is one", 1.0)
    efficiency_four_bar = _efficiency("four-bar", "four-bar linkage", 0.95)
    efficiency_bearings = _efficiency("bearings", "bearings", 0.99)
    efficiency_chain = _efficiency("chain", "chain", 0.95)
    n_points = samples(720)
    min_transmission_angle = Quantity("μ_min", "deg", "Minimum acceptable transmission angle", gt=0, le=90, default=40)
    segment_height = Quantity("h", "mm", "Height of the cylinder's segment; required for the carriage window", gt=0, optional=True)
    carriage_clearance = Quantity("c_r", "mm", "Clearance required by the carriages under the cylinder", gt=0, optional=True)
    standstill_rotation = Quantity("θ_s", "deg", "Rotation of the cylinder from an end position within which it counts as standing still", gt=0,
        le=90, default=2)
    crank_length = Quantity("a", "mm", "Length of the crank; required for the forces in the joints", gt=0, optional=True)
    pinion_radius = Quantity("r_p", "mm", "Pitch radius of the pinion; required for the tooth force of the sector", gt=0, optional=True)
    allowable_torque = Quantity("[M]", "N*m", "Allowable torque at the crank's shaft", gt=0, optional=True)
    allowable_acceleration = Quantity("[a_c]", "m/s**2", "Allowable acceleration of the cylinder", gt=0, optional=True)
    allowable_tooth_force = Quantity("[F_t]", "kN", "Allowable tangential force between the teeth of sector and pinion", gt=0, optional=True)
    allowable_joint_force = Quantity("[F_j]", "kN", "Allowable force in the joints of the coupler and the crank's bearing", gt=0, optional=True)
    pressure_angle = Quantity("α_w", "deg", "Pressure angle of the teeth", gt=0, lt=45, default=20)
