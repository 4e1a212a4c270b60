"""The calculation of the friction clutch, chapter by chapter, with its inputs."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from diecut_report.api import (
    POINTS,
    Annotated,
    Block,
    Chapter,
    CurveInput,
    Inputs,
    OneOf,
    Quantity,
    as_number,
    bind,
    case,
    number,
    pi,
)

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


torque = Chapter("Torque")
torque.value("torque", "M", "N*m", "Torque to be transmitted by the clutch", lambda power, speed: power / speed, source="002 eq. 16",
    lacks=("torque",))
torque.value("power", "W", "kW", "Power at this torque", lambda torque, speed: torque * speed, source="002 eq. 16", needs=("torque", "speed"))
torque.value("design_torque", "M_c", "N*m", "Design torque of the clutch", lambda service_factor, torque: service_factor * torque,
    source="this method")

transmitted = Chapter("Torque over the cycle", needs=("torque_curve",),
    text="One period of the referenced curve is mapped to one revolution of the cycle angle. Where it is above the design torque the clutch slips.")
transmitted.abscissa("cycle_angle", "φ", "deg", "Cycle angle, one revolution per period of the torque", period=2 * np.pi,
    shown_at="transmitted_torque_max_at")
transmitted.from_curve("transmitted_torque", "M_φ", "N*m", "Transmitted torque", given="torque_curve", abscissa="cycle_angle")
transmitted.reduction("transmitted_torque_max", "M_φ,max", "N*m", "Maximum absolute transmitted torque", "abs_max", of="transmitted_torque")

wedge = Chapter("Wedge",
    text="The force N_2 normal to the cone's face and the friction f·N_2 on it balance P_1 along the axis and the pressing force P of the shoes "
        "along the radius: P_1 = P·tan(α + ρ) with the angle of friction ρ. All forces are those of the whole ring of shoes.")
wedge.value("radial_share", "c_α", "1", "Fraction of N_2 that presses the shoes", lambda wedge_angle: np.cos(wedge_angle), source="002 eq. 13",
    output=False)
wedge.value("held_share", "c_f", "1", "Fraction of N_2 that friction withholds from them",
    lambda wedge_friction, wedge_angle: wedge_friction * np.sin(wedge_angle), source="002 eq. 13", output=False)
wedge.value("wedge_angle_limit", "α_lim", "deg", "Wedge angle from which friction withholds all of it",
    lambda wedge_friction: pi / 2 - np.arctan(wedge_friction), source="002 eq. 13", output=False)
wedge.value("wedge_friction_limit", "f_lim", "1", "Friction that does so at the given angle", lambda wedge_angle: 1 / np.tan(wedge_angle),
    source="002 eq. 13", output=False)
wedge.require("wedge_lifts", lambda held_share, radial_share: held_share < radial_share, key="wedge_angle",
    message="is {wedge_angle}, but with a wedge friction of {wedge_friction} no force on the cone presses the shoes outwards: cos α > f·sin α is "
        "needed: a wedge_angle below {wedge_angle_limit}, or a wedge_friction below {wedge_friction_limit}")
wedge.require("load_below_capacity", lambda load_torque_at_engagement, design_torque: load_torque_at_engagement < design_torque,
    key="load_torque_at_engagement",
    message="is {load_torque_at_engagement}, but the slipping clutch carries {design_torque} only, so that the driven side never comes up to speed: "
        "M_l < M_c = k_s·M is needed; lower the load while engaging or raise torque or service_factor")
wedge.value("pressing_force", "P", "N", "Radial force on the shoes required for the torque",
    lambda design_torque, shoe_friction, shoe_radius: design_torque / (shoe_friction * shoe_radius), source="002 eq. 16")
wedge.value("wedge_normal_force", "N_2", "N", "Force normal to the cone's face",
    lambda pressing_force, wedge_angle, wedge_friction: pressing_force / (np.cos(wedge_angle) - wedge_friction * np.sin(wedge_angle)),
    source="002 eq. 14")
wedge.value("wedge_friction_force", "F_f", "N", "Friction on the cone's face",
    lambda wedge_friction, wedge_normal_force: wedge_friction * wedge_normal_force, source="002 eq. 12")
wedge.value("engagement_force", "P_1", "N", "Axial force to engage the clutch",
    lambda wedge_normal_force, wedge_angle, wedge_friction: wedge_normal_force * (np.sin(wedge_angle) + wedge_friction * np.cos(wedge_angle)),
    source="002 eq. 12, 15")
wedge.value("force_amplification", "k_P", "1", "Force amplification of the wedge",
    lambda pressing_force, engagement_force: pressing_force / engagement_force, source="002 eq. 15")

release = Chapter("Release",
    text="When P_1 is removed, the shoes still press on the cone and friction reverses: it now holds the cone in. F_r is the axial force then "
        "required to pull the cone out. A negative F_r means that no pull is required: the shoes push the cone out with this force and the clutch "
        "opens by itself; to stay engaged, the actuator must hold the cone with at least this force. A positive or zero F_r means that the wedge is "
        "self-locking: the clutch stays engaged without P_1 until the cone is pulled out.")
release.value("friction_angle", "ρ", "deg", "Angle of friction: up to this wedge angle the wedge is self-locking",
    lambda wedge_friction: np.arctan(wedge_friction), source="statics")
release.value("wedge_slope", "t_α", "1", "Slope of the cone's face: friction from this value on makes it self-locking",
    lambda wedge_angle: np.tan(wedge_angle), source="statics", output=False)
release.value("release_force", "F_r", "N", "Force to release the cone; negative: it opens by itself",
    lambda pressing_force, friction_angle, wedge_angle: pressing_force * np.tan(friction_angle - wedge_angle), source="statics")
release.choice("release_behaviour", "B_r", "1", "Without the engagement force the clutch",
    case("opens by itself", "friction is less than the slope of the cone's face", lambda wedge_friction, wedge_slope: wedge_friction < wedge_slope),
    case("stays engaged until the cone is pulled out", "friction is not less than the slope of the cone's face"), source="statics")
release.value("self_locking", "L_s", "1", "Self-locking of the wedge", lambda wedge_angle, wedge_friction: np.tan(wedge_angle) <= wedge_friction,
    source="statics")

lining = Chapter("Lining", text="The shoes are cylindrical and press evenly on their part of the circumference.")
lining.value("shoe_width", "b", "mm", "Shoe width required by the allowed pressure",
    lambda pressing_force, shoe_radius, shoe_coverage, allowable_pressure:
        pressing_force / (2 * pi * shoe_radius * shoe_coverage * allowable_pressure), source="002 eq. 17")
lining.value("lining_width", "b_L", "mm", "Width of the lining: as given", bind(lambda shoe_width: shoe_width, shoe_width="inputs.shoe_width"),
    source="input", needs=("shoe_width",))
lining.value("lining_width", "b_L", "mm", "Width of the lining: as sized", lambda shoe_width: shoe_width, lacks=("shoe_width",))
lining.value("lining_area", "A", "cm**2", "Area of the lining",
    lambda shoe_radius, lining_width, shoe_coverage: 2 * pi * shoe_radius * lining_width * shoe_coverage, source="geometry")
lining.value("pressure", "q", "MPa", "Pressure on the lining", lambda pressing_force, lining_area: pressing_force / lining_area, source="002 eq. 17")
lining.value("width_ratio", "k_b", "1", "Ratio of lining width to drum diameter", lambda lining_width, shoe_radius: lining_width / (2 * shoe_radius),
    source="this method")

travel = Chapter("Travel of the cone", text="As the cone travels, the shoes rise by tan α per unit of its travel.", needs=("radial_gap",),
    absent="not calculated: radial_gap is not given")
travel.value("engagement_travel", "s_1", "mm", "Axial travel that closes the gap, new lining",
    lambda radial_gap, wedge_angle: radial_gap / np.tan(wedge_angle), source="geometry")
travel.value("axial_travel", "s", "mm", "Axial travel until the permissible wear is used up",
    lambda radial_gap, wear_allowance, wedge_angle: (radial_gap + wear_allowance) / np.tan(wedge_angle), source="geometry")

sliding = Chapter("Sliding at engagement", needs=("speed",), absent="not calculated: speed is not given")
sliding.value("sliding_speed", "v", "m/s", "Sliding speed at first contact of the shoes with the drum",
    lambda speed, shoe_radius: speed * shoe_radius, source="kinematics")
sliding.value("pv", "qv", "MPa*m/s", "Product of pressure and sliding speed", lambda pressure, sliding_speed: pressure * sliding_speed,
    source="this method")

heat = Chapter("Heat of the engagement",
    text="The driving shaft keeps its speed; the driven side starts from rest and is accelerated by M_a. The sliding speed falls as the driven side "
        "speeds up, and all friction work becomes heat.", needs=("driven_inertia", "speed"), absent="not calculated: {missing} not given")
heat.value("accelerating_torque", "M_a", "N*m", "Torque that accelerates the driven side",
    lambda design_torque, load_torque_at_engagement: design_torque - load_torque_at_engagement, source="statics")
heat.value("slip_time", "t_s", "s", "Slip time of the clutch",
    lambda driven_inertia, speed, accelerating_torque: driven_inertia * as_number(speed) / accelerating_torque, source="energy")
heat.value("engagement_energy", "Q", "J", "Heat of one engagement",
    lambda driven_inertia, speed, design_torque, accelerating_torque: driven_inertia * speed**2 * design_torque / (2 * accelerating_torque),
    source="energy")
heat.value("slip_share", "ε", "1", "Fraction of the time during which it slips",
    lambda engagements_per_hour, slip_time: engagements_per_hour * slip_time, source="kinematics")
heat.value("lining_power", "W_m", "W", "Mean friction power",
    lambda engagement_energy, engagements_per_hour: engagement_energy * engagements_per_hour, source="energy")
heat.value("lining_power_density", "p_A", "W/cm**2", "Mean friction power per unit area of lining",
    lambda lining_power, lining_area: lining_power / lining_area, source="energy")
heat.value("engagements_limit", "z_lim", "1/h", "Permissible number of engagements per hour for the lining",
    lambda allowable_power_density, lining_area, engagement_energy: allowable_power_density * lining_area / engagement_energy, source="energy",
    needs=("allowable_power_density",), output=False)

DRUM = {"conductivity": "drum_conductivity", "density": "drum_density", "specific_heat": "drum_specific_heat"}

temperature = Chapter("Temperature of the lining",
    text="The lining conducts heat poorly: its friction surface takes the temperature of the drum's surface, into which all heat is assumed to "
        "flow. During slip the drum is a thick body whose surface receives a heat flux that falls linearly to zero; the surface is hottest at half "
        "the slip time. A drum thinner than the penetration depth gets hotter; with drum_mass its own rise is used where it is greater. Over many "
        "engagements the drum warms up until its cooled surface dissipates the mean friction power.", needs=("driven_inertia", "speed"))
temperature.value("heat_flux", "p_0", "W/cm**2", "Heat flux into the drum at the start of slip",
    lambda design_torque, speed, shoe_radius, lining_width: design_torque * speed / (2 * pi * shoe_radius * lining_width), source="energy")
temperature.value("heat_depth", "x_h", "mm", "Depth of drum that absorbs the heat during slip",
    bind(lambda slip_time, conductivity, density, specific_heat: 2 * np.sqrt(conductivity * slip_time / (density * specific_heat)), **DRUM),
    source="heat conduction")
temperature.value("surface_temperature_rise", "ΔT_s", "K", "Temperature rise of the friction surface in one engagement",
    bind(lambda heat_flux, slip_time, conductivity, density, specific_heat:
            number(4) / 3 * heat_flux * np.sqrt(slip_time / (2 * as_number(pi) * conductivity * density * specific_heat)),
    **DRUM),
    source="heat conduction")
temperature.value("drum_temperature_rise", "ΔT_d", "K", "Mean temperature rise of the drum in one engagement",
    lambda engagement_energy, drum_mass, drum_specific_heat: engagement_energy / (drum_mass * drum_specific_heat), source="energy",
    needs=("drum_mass",))
temperature.value("engagement_temperature_rise", "ΔT_1", "K", "Temperature rise of the lining in one engagement",
    lambda surface_temperature_rise, drum_temperature_rise: np.maximum(surface_temperature_rise, drum_temperature_rise), source="this method",
    needs=("drum_mass",))
temperature.value("engagement_temperature_rise", "ΔT_1", "K", "Temperature rise of the lining in one engagement",
    lambda surface_temperature_rise: surface_temperature_rise, source="this method", lacks=("drum_mass",))
temperature.value("lining_temperature_rise", "ΔT", "K", "Maximum temperature rise of the lining in a single engagement",
    lambda engagement_temperature_rise: engagement_temperature_rise, lacks=("cooling",), source="this method")

warming = Chapter("Mean temperature", needs=("driven_inertia", "speed", "cooling"), absent="not calculated: {missing} not given")
warming.value("mean_temperature_rise", "ΔT_m", "K", "Mean temperature rise of the drum above ambient",
    bind(lambda lining_power, heat_transfer_coefficient, area: lining_power / (heat_transfer_coefficient * area),
        heat_transfer_coefficient="cooling.heat_transfer_coefficient", area="cooling.area"), source="energy")
warming.value("lining_temperature_rise", "ΔT", "K", "Maximum temperature rise of the lining above ambient",
    lambda mean_temperature_rise, engagement_temperature_rise: mean_temperature_rise + engagement_temperature_rise, source="this method")
warming.value("cooling_time", "τ", "min", "Time constant of the drum's cooling",
    bind(lambda mass, specific_heat, heat_transfer_coefficient, area: mass * specific_heat / (heat_transfer_coefficient * area), mass="drum_mass",
        specific_heat="drum_specific_heat", area="cooling.area", heat_transfer_coefficient="cooling.heat_transfer_coefficient"), source="energy",
    needs=("drum_mass",))
warming.value("drum_temperature_rise_warm", "ΔT_w", "K", "Temperature rise of the warm drum just after an engagement",
    lambda drum_temperature_rise, engagements_per_hour, cooling_time:
        drum_temperature_rise / (1 - np.exp(-1 / (engagements_per_hour * cooling_time))), source="energy", needs=("drum_mass",),
    exists=lambda engagements_per_hour: engagements_per_hour > 0)

SECTIONS = (torque, transmitted, wedge, release, lining, travel, sliding, heat, temperature, warming)
