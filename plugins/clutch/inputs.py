"""Inputs of the friction clutch."""

from __future__ import annotations

from typing import Any, ClassVar

from diecut_report.api import POINTS, Annotated, Block, CurveInput, Inputs, OneOf, Quantity

# fmt: off


class Cooling(Block):
    """Keys of the block ``cooling``."""

    area: Annotated[float, Quantity("A_c", "m**2", "Surface of the drum that transfers heat to the air", gt=0)]
    heat_transfer_coefficient: Annotated[float, Quantity("h_c", "W/(m**2*K)", "Heat transfer coefficient of that surface", gt=0)]


class Clutch(Inputs):
    """Keys of ``clutch``."""

    one_of: ClassVar[tuple[OneOf, ...]] = (OneOf(("torque",), ("power", "speed"), shared=("speed",)),)

    torque: Annotated[float | None, Quantity("M", "N*m", "Torque to be transmitted by the clutch", gt=0)] = None
    torque_curve: Annotated[Any | None,
        CurveInput("M_z", "N*m", "Torque that the clutch transmits over a cycle; of a machine's parts that which passes it")] = None
    power: Annotated[float | None, Quantity("W", "kW", "Power to be transmitted by the clutch at the given speed", gt=0)] = None
    speed: Annotated[float | None, Quantity("ω", "rpm", "Speed of the driving shaft, constant; required for heat, slip time and q·v", gt=0)] = None
    service_factor: Annotated[float, Quantity("k_s", "1", "Service factor on the torque for the design", ge=1)] = 1.5
    shoe_radius: Annotated[float, Quantity("r", "mm", "Radius of the drum's friction surface", gt=0)]
    shoe_friction: Annotated[float, Quantity("f_s", "1", "Coefficient of friction of the lining on the drum", gt=0, lt=1)] = 0.35
    wedge_angle: Annotated[float, Quantity("α", "deg", "Wedge angle: half the included angle of the cone, from its face to the axis", gt=0, lt=90)]
    wedge_friction: Annotated[float, Quantity("f", "1", "Coefficient of friction of the cone under the shoes", ge=0, lt=1)] = 0.1
    allowable_pressure: Annotated[float, Quantity("[q]", "MPa", "Allowable pressure of the lining", gt=0)] = 0.3
    shoe_coverage: Annotated[float, Quantity("κ", "1", "Fraction of the drum's circumference covered by lining", gt=0, le=1)] = 1.0
    shoe_width: Annotated[float | None, Quantity("b_g", "mm", "Width of the shoes; if given, it is checked instead of sized", gt=0)] = None
    radial_gap: Annotated[float | None,
        Quantity("δ", "mm", "Gap between lining and drum with the clutch open; required for the travel of the cone", ge=0)] = None
    wear_allowance: Annotated[float, Quantity("w", "mm", "Permissible wear of the lining", ge=0)] = 0
    available_travel: Annotated[float | None, Quantity("[s]", "mm", "Available axial travel of cone and actuator", gt=0)] = None
    available_force: Annotated[float | None, Quantity("[P_1]", "N", "Available axial force of the actuator", gt=0)] = None
    driven_inertia: Annotated[float | None,
        Quantity("J", "kg*m**2", "Moment of inertia on the driven side, at the clutch's shaft; required with speed for the heat", gt=0)] = None
    load_torque_at_engagement: Annotated[float, Quantity("M_l", "N*m", "Load torque of the driven side during slip", ge=0)] = 0
    engagements_per_hour: Annotated[float, Quantity("z", "1/h", "Engagements per hour", ge=0)] = 0
    drum_conductivity: Annotated[float, Quantity("λ", "W/(m*K)", "Thermal conductivity of the drum (grey iron)", gt=0)] = 50
    drum_density: Annotated[float, Quantity("γ", "kg/m**3", "Density of the drum (grey iron)", gt=0)] = 7200
    drum_specific_heat: Annotated[float, Quantity("c", "J/(kg*K)", "Specific heat of the drum (iron and steel)", gt=0)] = 500
    drum_mass: Annotated[float | None,
        Quantity("m", "kg", "Mass of the drum that absorbs the heat; required for the drum's own temperature rise", gt=0)] = None
    cooling: Cooling | None = None
    allowable_slip_time: Annotated[float | None, Quantity("[t_s]", "s", "Allowable slip time of an engagement", gt=0)] = None
    allowable_power_density: Annotated[float | None,
        Quantity("[p_A]", "W/cm**2", "Allowable mean friction power per unit area of lining", gt=0)] = None
    allowable_pv: Annotated[float | None, Quantity("[qv]", "MPa*m/s", "Allowable product of pressure and sliding speed", gt=0)] = None
    allowable_temperature_rise: Annotated[float | None, Quantity("[ΔT]", "K", "Allowable temperature rise of the lining above ambient", gt=0)] = None
    n_points: Annotated[int, POINTS] = 360
