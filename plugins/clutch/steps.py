"""The calculation of the friction clutch, chapter by chapter, with its inputs."""

from __future__ import annotations

import numpy as np

from diecut_report.api import (
    Block,
    Chapter,
    CurveInput,
    Inputs,
    OneOf,
    Quantity,
    abscissa,
    as_number,
    block,
    case,
    choice,
    from_curve,
    inner,
    m,
    number,
    pi,
    reduction,
    samples,
    value,
)

# fmt: off


class Cooling(Block):
    """Keys of the block ``cooling``."""

    area = Quantity("A_c", "m**2", "Surface of the drum that transfers heat to the air", gt=0)
    heat_transfer_coefficient = Quantity("h_c", "W/(m**2*K)", "Heat transfer coefficient of that surface", gt=0)


class Clutch(Inputs):
    """Keys of ``clutch``."""

    one_of = (OneOf(("torque",), ("power", "speed"), shared=("speed",)),)

    torque = Quantity("M", "N*m", "Torque to be transmitted by the clutch", gt=0, optional=True)
    torque_curve = CurveInput("M_z", "N*m", "Torque that the clutch transmits over a cycle; of a machine's parts that which passes it", optional=True)
    power = Quantity("W", "kW", "Power to be transmitted by the clutch at the given speed", gt=0, optional=True)
    speed = Quantity("ω", "rpm", "Speed of the driving shaft, constant; required for heat, slip time and q·v", gt=0, optional=True)
    service_factor = Quantity("k_s", "1", "Service factor on the torque for the design", ge=1, default=1.5)
    shoe_radius = Quantity("r", "mm", "Radius of the drum's friction surface", gt=0)
    shoe_friction = Quantity("f_s", "1", "Coefficient of friction of the lining on the drum", gt=0, lt=1, default=0.35)
    wedge_angle = Quantity("α", "deg", "Wedge angle: half the included angle of the cone, from its face to the axis", gt=0, lt=90)
    wedge_friction = Quantity("f", "1", "Coefficient of friction of the cone under the shoes", ge=0, lt=1, default=0.1)
    allowable_pressure = Quantity("[q]", "MPa", "Allowable pressure of the lining", gt=0, default=0.3)
    shoe_coverage = Quantity("κ", "1", "Fraction of the drum's circumference covered by lining", gt=0, le=1, default=1.0)
    shoe_width = Quantity("b_g", "mm", "Width of the shoes; if given, it is checked instead of sized", gt=0, optional=True)
    radial_gap = Quantity("δ", "mm", "Gap between lining and drum with the clutch open; required for the travel of the cone", ge=0, optional=True)
    wear_allowance = Quantity("w", "mm", "Permissible wear of the lining", ge=0, default=0)
    available_travel = Quantity("[s]", "mm", "Available axial travel of cone and actuator", gt=0, optional=True)
    available_force = Quantity("[P_1]", "N", "Available axial force of the actuator", gt=0, optional=True)
    driven_inertia = Quantity("J", "kg*m**2", "Moment of inertia on the driven side, at the clutch's shaft; required with speed for the heat", gt=0,
        optional=True)
    load_torque_at_engagement = Quantity("M_l", "N*m", "Load torque of the driven side during slip", ge=0, default=0)
    engagements_per_hour = Quantity("z", "1/h", "Engagements per hour", ge=0, default=0)
    drum_conductivity = Quantity("λ", "W/(m*K)", "Thermal conductivity of the drum (grey iron)", gt=0, default=50)
    drum_density = Quantity("γ", "kg/m**3", "Density of the drum (grey iron)", gt=0, default=7200)
    drum_specific_heat = Quantity("c", "J/(kg*K)", "Specific heat of the drum (iron and steel)", gt=0, default=500)
    drum_mass = Quantity("m", "kg", "Mass of the drum that absorbs the heat; required for the drum's own temperature rise", gt=0, optional=True)
    cooling = block(Cooling, "Cooling of the drum by the air", optional=True)
    allowable_slip_time = Quantity("[t_s]", "s", "Allowable slip time of an engagement", gt=0, optional=True)
    allowable_power_density = Quantity("[p_A]", "W/cm**2", "Allowable mean friction power per unit area of lining", gt=0, optional=True)
    allowable_pv = Quantity("[qv]", "MPa*m/s", "Allowable product of pressure and sliding speed", gt=0, optional=True)
    allowable_temperature_rise = Quantity("[ΔT]", "K", "Allowable temperature rise of the lining above ambient", gt=0, optional=True)
    n_points = samples(360)


torque = Chapter("Torque")
torque.torque = value(m.power / m.speed, lacks=("torque",)), "M", "N*m", "Torque to be transmitted by the clutch", "002 eq. 16"
torque.power = value(m.torque * m.speed, needs=("torque", "speed")), "W", "kW", "Power at this torque", "002 eq. 16"
torque.design_torque = m.service_factor * m.torque, "M_c", "N*m", "Design torque of the clutch", "this method"

transmitted = Chapter("Torque over the cycle", needs=("torque_curve",),
    text="One period of the referenced curve is mapped to one revolution of the cycle angle. Where it is above the design torque the clutch slips.")
transmitted.cycle_angle = (abscissa(period=2 * np.pi, shown_at="transmitted_torque_max_at"), "φ", "deg",
    "Cycle angle, one revolution per period of the torque")
transmitted.transmitted_torque = from_curve(given="torque_curve", abscissa="cycle_angle"), "M_φ", "N*m", "Transmitted torque"
transmitted.transmitted_torque_max = reduction("abs_max", of="transmitted_torque"), "M_φ,max", "N*m", "Maximum absolute transmitted torque"

wedge = Chapter("Wedge",
    text="The force N_2 normal to the cone's face and the friction f·N_2 on it balance P_1 along the axis and the pressing force P of the shoes "
        "along the radius: P_1 = P·tan(α + ρ) with the angle of friction ρ. All forces are those of the whole ring of shoes.")
wedge.radial_share = inner(np.cos(m.wedge_angle)), "c_α", "1", "Fraction of N_2 that presses the shoes", "002 eq. 13"
wedge.held_share = inner(m.wedge_friction * np.sin(m.wedge_angle)), "c_f", "1", "Fraction of N_2 that friction withholds from them", "002 eq. 13"
wedge.wedge_angle_limit = (inner(pi / 2 - np.arctan(m.wedge_friction)), "α_lim", "deg", "Wedge angle from which friction withholds all of it",
    "002 eq. 13")
wedge.wedge_friction_limit = inner(1 / np.tan(m.wedge_angle)), "f_lim", "1", "Friction that does so at the given angle", "002 eq. 13"
wedge.require("wedge_lifts", m.held_share < m.radial_share, key="wedge_angle",
    message="is {wedge_angle}, but with a wedge friction of {wedge_friction} no force on the cone presses the shoes outwards: cos α > f·sin α is "
    "needed: a wedge_angle below {wedge_angle_limit}, or a wedge_friction below {wedge_friction_limit}")
wedge.require("load_below_capacity", m.load_torque_at_engagement < m.design_torque, key="load_torque_at_engagement",
    message="is {load_torque_at_engagement}, but the slipping clutch carries {design_torque} only, so that the driven side never comes up to speed: "
    "M_l < M_c = k_s·M is needed; lower the load while engaging or raise torque or service_factor")
wedge.pressing_force = (m.design_torque / (m.shoe_friction * m.shoe_radius), "P", "N", "Radial force on the shoes required for the torque",
    "002 eq. 16")
wedge.wedge_normal_force = (m.pressing_force / (np.cos(m.wedge_angle) - m.wedge_friction * np.sin(m.wedge_angle)), "N_2", "N",
    "Force normal to the cone's face", "002 eq. 14")
wedge.wedge_friction_force = m.wedge_friction * m.wedge_normal_force, "F_f", "N", "Friction on the cone's face", "002 eq. 12"
wedge.engagement_force = (m.wedge_normal_force * (np.sin(m.wedge_angle) + m.wedge_friction * np.cos(m.wedge_angle)), "P_1", "N",
    "Axial force to engage the clutch", "002 eq. 12, 15")
wedge.force_amplification = m.pressing_force / m.engagement_force, "k_P", "1", "Force amplification of the wedge", "002 eq. 15"

release = Chapter("Release",
    text="When P_1 is removed, the shoes still press on the cone and friction reverses: it now holds the cone in. F_r is the axial force then "
        "required to pull the cone out. A negative F_r means that no pull is required: the shoes push the cone out with this force and the clutch "
        "opens by itself; to stay engaged, the actuator must hold the cone with at least this force. A positive or zero F_r means that the wedge is "
        "self-locking: the clutch stays engaged without P_1 until the cone is pulled out.")
release.friction_angle = np.arctan(m.wedge_friction), "ρ", "deg", "Angle of friction: up to this wedge angle the wedge is self-locking", "statics"
release.wedge_slope = (inner(np.tan(m.wedge_angle)), "t_α", "1", "Slope of the cone's face: friction from this value on makes it self-locking",
    "statics")
release.release_force = (m.pressing_force * np.tan(m.friction_angle - m.wedge_angle), "F_r", "N",
    "Force to release the cone; negative: it opens by itself", "statics")
release.release_behaviour = (choice(case("opens by itself", "friction is less than the slope of the cone's face", m.wedge_friction < m.wedge_slope),
    case("stays engaged until the cone is pulled out", "friction is not less than the slope of the cone's face")), "B_r", "1",
    "Without the engagement force the clutch", "statics")
release.self_locking = np.tan(m.wedge_angle) <= m.wedge_friction, "L_s", "1", "Self-locking of the wedge", "statics"

lining = Chapter("Lining", text="The shoes are cylindrical and press evenly on their part of the circumference.")
lining.shoe_width = (m.pressing_force / (2 * pi * m.shoe_radius * m.shoe_coverage * m.allowable_pressure), "b", "mm",
    "Shoe width required by the allowed pressure", "002 eq. 17")
lining.lining_width = value(m.inputs.shoe_width, needs=("shoe_width",)), "b_L", "mm", "Width of the lining: as given", "input"
lining.lining_width = value(m.shoe_width, lacks=("shoe_width",)), "b_L", "mm", "Width of the lining: as sized"
lining.lining_area = 2 * pi * m.shoe_radius * m.lining_width * m.shoe_coverage, "A", "cm**2", "Area of the lining", "geometry"
lining.pressure = m.pressing_force / m.lining_area, "q", "MPa", "Pressure on the lining", "002 eq. 17"
lining.width_ratio = m.lining_width / (2 * m.shoe_radius), "k_b", "1", "Ratio of lining width to drum diameter", "this method"

travel = Chapter("Travel of the cone", text="As the cone travels, the shoes rise by tan α per unit of its travel.", needs=("radial_gap",),
    absent="not calculated: radial_gap is not given")
travel.engagement_travel = m.radial_gap / np.tan(m.wedge_angle), "s_1", "mm", "Axial travel that closes the gap, new lining", "geometry"
travel.axial_travel = ((m.radial_gap + m.wear_allowance) / np.tan(m.wedge_angle), "s", "mm", "Axial travel until the permissible wear is used up",
    "geometry")

sliding = Chapter("Sliding at engagement", needs=("speed",), absent="not calculated: speed is not given")
sliding.sliding_speed = m.speed * m.shoe_radius, "v", "m/s", "Sliding speed at first contact of the shoes with the drum", "kinematics"
sliding.pv = m.pressure * m.sliding_speed, "qv", "MPa*m/s", "Product of pressure and sliding speed", "this method"

heat = Chapter("Heat of the engagement",
    text="The driving shaft keeps its speed; the driven side starts from rest and is accelerated by M_a. The sliding speed falls as the driven side "
        "speeds up, and all friction work becomes heat.", needs=("driven_inertia", "speed"), absent="not calculated: {missing} not given")
heat.accelerating_torque = m.design_torque - m.load_torque_at_engagement, "M_a", "N*m", "Torque that accelerates the driven side", "statics"
heat.slip_time = m.driven_inertia * as_number(m.speed) / m.accelerating_torque, "t_s", "s", "Slip time of the clutch", "energy"
heat.engagement_energy = m.driven_inertia * m.speed**2 * m.design_torque / (2 * m.accelerating_torque), "Q", "J", "Heat of one engagement", "energy"
heat.slip_share = m.engagements_per_hour * m.slip_time, "ε", "1", "Fraction of the time during which it slips", "kinematics"
heat.lining_power = m.engagement_energy * m.engagements_per_hour, "W_m", "W", "Mean friction power", "energy"
heat.lining_power_density = m.lining_power / m.lining_area, "p_A", "W/cm**2", "Mean friction power per unit area of lining", "energy"
heat.engagements_limit = (inner(m.allowable_power_density * m.lining_area / m.engagement_energy, needs=("allowable_power_density",)), "z_lim", "1/h",
    "Permissible number of engagements per hour for the lining", "energy")

DRUM = {"conductivity": "drum_conductivity", "density": "drum_density", "specific_heat": "drum_specific_heat"}

temperature = Chapter("Temperature of the lining",
    text="The lining conducts heat poorly: its friction surface takes the temperature of the drum's surface, into which all heat is assumed to "
        "flow. During slip the drum is a thick body whose surface receives a heat flux that falls linearly to zero; the surface is hottest at half "
        "the slip time. A drum thinner than the penetration depth gets hotter; with drum_mass its own rise is used where it is greater. Over many "
        "engagements the drum warms up until its cooled surface dissipates the mean friction power.", needs=("driven_inertia", "speed"))
temperature.heat_flux = (m.design_torque * m.speed / (2 * pi * m.shoe_radius * m.lining_width), "p_0", "W/cm**2",
    "Heat flux into the drum at the start of slip", "energy")
temperature.heat_depth = (2 * np.sqrt(m.drum_conductivity * m.slip_time / (m.drum_density * m.drum_specific_heat)), "x_h", "mm",
    "Depth of drum that absorbs the heat during slip", "heat conduction")
temperature.surface_temperature_rise = (number(4) / 3 * m.heat_flux * np.sqrt(m.slip_time
    / (2 * as_number(pi) * m.drum_conductivity * m.drum_density * m.drum_specific_heat)), "ΔT_s", "K",
    "Temperature rise of the friction surface in one engagement", "heat conduction")
temperature.drum_temperature_rise = (value(m.engagement_energy / (m.drum_mass * m.drum_specific_heat), needs=("drum_mass",)), "ΔT_d", "K",
    "Mean temperature rise of the drum in one engagement", "energy")
temperature.engagement_temperature_rise = (value(np.maximum(m.surface_temperature_rise, m.drum_temperature_rise), needs=("drum_mass",)), "ΔT_1", "K",
    "Temperature rise of the lining in one engagement", "this method")
temperature.engagement_temperature_rise = (value(m.surface_temperature_rise, lacks=("drum_mass",)), "ΔT_1", "K",
    "Temperature rise of the lining in one engagement", "this method")
temperature.lining_temperature_rise = (value(m.engagement_temperature_rise, lacks=("cooling",)), "ΔT", "K",
    "Maximum temperature rise of the lining in a single engagement", "this method")

warming = Chapter("Mean temperature", needs=("driven_inertia", "speed", "cooling"), absent="not calculated: {missing} not given")
warming.mean_temperature_rise = (m.lining_power / (m.cooling.heat_transfer_coefficient * m.cooling.area), "ΔT_m", "K",
    "Mean temperature rise of the drum above ambient", "energy")
warming.lining_temperature_rise = (m.mean_temperature_rise + m.engagement_temperature_rise, "ΔT", "K",
    "Maximum temperature rise of the lining above ambient", "this method")
warming.cooling_time = (value(m.drum_mass * m.drum_specific_heat / (m.cooling.heat_transfer_coefficient * m.cooling.area), needs=("drum_mass",)),
    "τ", "min", "Time constant of the drum's cooling", "energy")
warming.drum_temperature_rise_warm = (value(m.drum_temperature_rise / (1 - np.exp(-1 / (m.engagements_per_hour * m.cooling_time))),
    needs=("drum_mass",), exists=m.engagements_per_hour > 0), "ΔT_w", "K", "Temperature rise of the warm drum just after an engagement", "energy")

SECTIONS = (torque, transmitted, wedge, release, lining, travel, sliding, heat, temperature, warming)
