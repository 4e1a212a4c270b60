"""The calculation of the rubber damper, chapter by chapter, with its inputs and formulas."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    Block,
    Chapter,
    Constant,
    FromPress,
    Inputs,
    OneOf,
    Quantity,
    as_angle,
    as_number,
    block,
    case,
    choice,
    formula,
    inner,
    m,
    number,
    pi,
    value,
)
from diecut_report.mechanics.common import rounded_up

# fmt: off

USUAL_LOSS = 0.2
CYLINDER = ("mass", "inertia", "rolling_radius", "velocity")
STOPPED = ("carriage_mass", "static_unbalance", "contact_distance")
"""What is stopped beside a balanced cylinder: without it nothing that follows from the energy is checked."""


class DriveBlock(Block):
    """A drive that still pushes while the dampers stop the mass: its force, or its torque and the rolling radius."""

    one_of = (OneOf(("force",), ("torque", "rolling_radius")),)

    force = Quantity("F", "N", "Force of the drive in the direction of travel, constant over the stop", gt=0, optional=True)
    torque = Quantity("M_F", "N*m", "Torque of the drive about the cylinder's axis, constant over the stop", gt=0, optional=True)
    rolling_radius = Quantity("R_F", "mm", "Radius on which the torque rolls the cylinder", gt=0, optional=True)


class Damper(Inputs):
    """Keys of ``damper``."""

    one_of = (
        OneOf(("kinetic_energy",), (*CYLINDER, *STOPPED), CYLINDER, shared=("velocity",)),
        OneOf(("elastic_modulus",), ("shore_hardness",)),
    )

    kinetic_energy = Quantity("W_k", "J", "Kinetic energy at contact of everything that is stopped; or the data it follows from", gt=0, optional=True)
    mass = Quantity("m", "kg", "Mass of the cylinder", gt=0, optional=True)
    inertia = Quantity("I", "kg*m**2", "Moment of inertia of the rolling body about its axis", gt=0, optional=True)
    rolling_radius = Quantity("R", "mm", "Rolling radius", gt=0, optional=True)
    velocity = Quantity("v", "m/s", "Speed at contact, not the maximum of the drive; required for stop, deceleration and rebound", gt=0,
        optional=True)
    carriage_mass = Quantity("m_c", "kg", "Mass of the carriages and of everything else that moves with the axis", ge=0, optional=True)
    static_unbalance = Quantity("me", "kg*m", "Static unbalance of the cylinder, away from the die at the end", ge=0, optional=True)
    contact_distance = Quantity("d_c", "mm", "Distance before the end of travel at which the damper is engaged", ge=0, optional=True)
    elastic_modulus = Quantity("E", "MPa", "Elastic modulus of the rubber; or shore_hardness", gt=0, optional=True)
    shore_hardness = Quantity("S_A", "1", "Shore A hardness of the rubber, for Gent's relation", ge=20, le=80, optional=True)
    dynamic_stiffness_factor = Quantity("k_d", "1", "Ratio of dynamic to static stiffness of the rubber, at the speed of the impact", ge=1, le=5,
        optional=True)
    allowable_stress = Quantity("[σ]", "MPa", "Allowable compressive stress", gt=0, default=1.0)
    ring_width = Quantity("l", "mm", "Width of the ring: one side of the pad", gt=0)
    pad_height = Quantity("y", "mm", "Height of the pad: its other side", gt=0)
    damper_count = Quantity("n", "1", "Number of dampers that act at once", ge=1, integer=True, default=2)
    adopted_length = Quantity("H_a", "mm", "Actual length of the damper; if given, it is checked instead of sized", gt=0, optional=True)
    length_step = Quantity("s_H", "mm", "Step to which the sized length is rounded up", gt=0, default=5)
    max_strain = Quantity("ε_max", "1", "Strain up to which the rubber is linear", gt=0, lt=1, default=0.20)
    loss_fraction = Quantity("ψ", "1", f"Fraction of the energy lost in one impact; or loss_tangent; {USUAL_LOSS} where neither is given", ge=0, le=1,
        optional=True)
    loss_tangent = Quantity("η", "1", "Loss tangent of the rubber, tan δ; gives the fraction that is lost", ge=0, le=1, optional=True)
    impacts_per_hour = Quantity("z", "1/h", "Impacts at one end of the travel per unit time, for the heat", gt=0,
        press=FromPress("press.productivity", formula(lambda productivity: productivity / 2), optional=True))
    allowable_force = Quantity("[P]", "N", "Allowable force on carriage and frame at one damper", gt=0, optional=True)
    allowable_deceleration = Quantity("[a]", "m/s**2", "Allowable deceleration of the stop", gt=0, optional=True)
    allowable_heat_power = Quantity("[P_h]", "W", "Allowable heat flow from the dampers of one end", gt=0, optional=True)
    drive = block(DriveBlock, "Drive that pushes on while the dampers stop the mass", optional=True)


GENT = Constant(98_100.0, "p_G", "Pa")
SLENDEREST = 3.0  # length over smaller side up to which a block with clamped ends does not buckle


@formula
def gent_modulus(shore_hardness: Any) -> Any:
    """Elastic modulus of rubber from its Shore A hardness."""
    return GENT * (56 + 7.62336 * shore_hardness) / (0.137505 * (254 - 2.54 * shore_hardness))


@formula
def kinetic_energy(
    mass: Any,
    inertia: Any,
    rolling_radius: Any,
    velocity: Any,
    carriage_mass: Any,
    static_unbalance: Any,
    contact_distance: Any,
) -> Any:
    """Energy of a rolling cylinder whose centre of mass lies away from the die at the end of its travel, and of what moves with its axis."""
    unbalance = 2 * static_unbalance * np.cos(as_angle(contact_distance / rolling_radius)) / rolling_radius
    return (carriage_mass + mass + inertia / rolling_radius**2 + unbalance) * velocity**2 / 2


@formula
def whole_steps_above(length: Any, length_step: Any) -> Any:
    """The next multiple of the step, at least one."""
    return np.maximum(rounded_up(length, length_step), length_step)


@formula
def stiffness_borne(
    kinetic_energy: Any, modulus: Any, damper_count: Any, area: Any, adopted_length: Any, allowable_stress: Any
) -> Any:
    """How much stiffer than at rest the rubber may be, so that the stress does not exceed the allowable one."""
    return damper_count * area * adopted_length * allowable_stress**2 / (2 * kinetic_energy * modulus)


@formula
def three_sides(side: Any) -> Any:
    """Length up to which a block with clamped ends does not buckle."""
    return 3 * side


@formula
def driven_stop_time(reduced_mass: Any, stiffness: Any, driving_force: Any, velocity: Any) -> Any:
    """Time from contact to rest of a mass on a spring with a constant force behind it."""
    late = np.arctan(driving_force / (velocity * np.sqrt(stiffness * reduced_mass)))
    return np.sqrt(reduced_mass / stiffness) * as_number(pi / 2 + late)


@formula
def driven_length(
    kinetic_energy: Any, elastic_modulus: Any, stress_limit: Any, damper_count: Any, area: Any, driving_force: Any
) -> Any:
    """Length at which the dampers take up energy and work of the drive with a stress."""
    borne = damper_count * area * stress_limit - 2 * driving_force
    return 2 * kinetic_energy * elastic_modulus / (stress_limit * borne)


@formula
def driven_count(
    kinetic_energy: Any, elastic_modulus: Any, driving_force: Any, stress_limit: Any, adopted_length: Any, area: Any
) -> Any:
    """Dampers of this pad and length that take up energy and work of the drive with a stress."""
    demanded = 2 * (kinetic_energy * elastic_modulus + driving_force * stress_limit * adopted_length)
    return np.ceil(demanded / (area * stress_limit**2 * adopted_length) - 1e-9)


energy = Chapter("Energy and rubber")
energy.kinetic_energy = value(m.inputs.kinetic_energy, needs=("kinetic_energy",)), "W_k", "J", "Kinetic energy at contact: as given", "input"
energy.kinetic_energy = (value((m.mass + m.inertia / m.rolling_radius ** 2) * m.velocity ** 2 / 2, lacks=("kinetic_energy", "carriage_mass")), "W_k",
    "J", "Kinetic energy at contact", "energy")
energy.kinetic_energy = value(kinetic_energy, needs=STOPPED), "W_k", "J", "Kinetic energy at contact, with the carriages and the unbalance", "energy"
energy.elastic_modulus = (value(m.inputs.elastic_modulus, needs=("elastic_modulus",), lacks=("dynamic_stiffness_factor",)), "E", "MPa",
    "Elastic modulus of the rubber: as given", "input")
energy.elastic_modulus = (value(gent_modulus, lacks=("elastic_modulus", "dynamic_stiffness_factor")), "E", "MPa",
    "Elastic modulus from the hardness, with p_G = 0.0981 MPa", "Gent 1958")
energy.static_modulus = (value(m.inputs.elastic_modulus, needs=("elastic_modulus", "dynamic_stiffness_factor")), "E_0", "MPa",
    "Elastic modulus at rest: as given", "input")
energy.static_modulus = (value(gent_modulus, needs=("dynamic_stiffness_factor",), lacks=("elastic_modulus",)), "E_0", "MPa",
    "Elastic modulus at rest from the hardness, with p_G = 0.0981 MPa", "Gent 1958")
energy.elastic_modulus = (value(m.dynamic_stiffness_factor * m.static_modulus, needs=("dynamic_stiffness_factor",)), "E", "MPa",
    "Elastic modulus at the speed of the impact", "this method")

length = Chapter("Length",
    text="The n dampers that act at once absorb the energy as linear springs: W_k = n·P·h/2 (002 eq. 18–22). At the allowable stress this gives the "
        "length.")
length.area = m.ring_width * m.pad_height, "S", "mm**2", "Compressed area of one damper", "002, after eq. 22"
length.free_length = (2 * m.kinetic_energy * m.elastic_modulus / (m.damper_count * m.area * m.allowable_stress**2), "H", "mm",
    "Free length of the damper at the allowable stress", "002 eq. 23, for n dampers")
length.adopted_length = value(m.inputs.adopted_length, needs=("adopted_length",)), "H_a", "mm", "Adopted length: as given", "input"
length.adopted_length = (value(whole_steps_above.of(length=m.free_length), lacks=("adopted_length",)), "H_a", "mm",
    "Adopted length: rounded up to the step", "this method")

load = Chapter("Load at the adopted length")
load.stress = (np.sqrt(2 * m.kinetic_energy * m.elastic_modulus / (m.damper_count * m.area * m.adopted_length)), "σ", "MPa",
    "Maximum compressive stress", "002 eq. 22")
load.strain = m.stress / m.elastic_modulus, "ε", "1", "Maximum strain", "002 eq. 19"
load.peak_force = m.stress * m.area, "P", "N", "Maximum force on one damper", "002 eq. 20"
load.stiffness_borne = (value(stiffness_borne.of(modulus=m.elastic_modulus), lacks=("dynamic_stiffness_factor",)), "k_d,max", "1",
    "Ratio of dynamic to static stiffness at which the allowable stress is reached", "002 eq. 22")
load.stiffness_borne = (value(stiffness_borne.of(modulus=m.static_modulus), needs=("dynamic_stiffness_factor",)), "k_d,max", "1",
    "Ratio of dynamic to static stiffness at which the allowable stress is reached", "002 eq. 22")
load.deflection = m.peak_force * m.adopted_length / (m.area * m.elastic_modulus), "h", "mm", "Maximum deflection", "002 eq. 21"

loss = Chapter("Energy loss of an impact")
loss.require("one_loss", m.inputs.loss_fraction < 0, key="loss_tangent",
    message="is given, and so is a loss_fraction of {inputs.loss_fraction}, but one follows from the other; leave one of them out",
    needs=("loss_fraction", "loss_tangent"))
loss.loss_fraction = (value(m.inputs.loss_fraction, needs=("loss_fraction",), lacks=("loss_tangent",)), "ψ", "1",
    "Fraction of the energy lost in one impact: as given", "input")
loss.loss_fraction = (value(USUAL_LOSS, lacks=("loss_fraction", "loss_tangent")), "ψ", "1",
    "Fraction of the energy lost in one impact: usual for rubber", "this method")
loss.loss_fraction = (value(1 - np.exp(-as_number(pi) * m.loss_tangent), needs=("loss_tangent",)), "ψ", "1",
    "Fraction of the energy lost in one impact: half a cycle", "this method")

stop = Chapter("Stop and rebound", text="Mass and dampers oscillate as a mass–spring system: the stop is a quarter of the period.",
    needs=("velocity",), absent="not calculated: velocity is not given")
stop.reduced_mass = 2 * m.kinetic_energy / m.velocity**2, "m_red", "kg", "Equivalent mass at the speed of contact", "energy"
stop.stop_time = as_number(pi) * m.deflection / (2 * m.velocity), "t_s", "ms", "Time from contact to rest", "this method"
stop.peak_deceleration = m.damper_count * m.peak_force / m.reduced_mass, "a_max", "m/s**2", "Maximum deceleration", "this method"
stop.rebound_velocity = m.velocity * np.sqrt(1 - m.loss_fraction), "v_r", "m/s", "Rebound speed", "energy"

heat = Chapter("Heat", needs=("impacts_per_hour",), absent="not calculated: neither impacts_per_hour nor the press's productivity is given")
heat.heat_power = m.loss_fraction * m.kinetic_energy * m.impacts_per_hour, "P_h", "W", "Heat flow from the dampers of one end", "energy"

buckling = Chapter("Buckling",
    text="A block with clamped ends does not buckle up to a length of three times its smaller side. The changes that bring this about, each by "
        "itself, are listed with the slenderness; a wider pad or more dampers need a shorter length for the same energy.")
buckling.smaller_side = inner(np.minimum(m.ring_width, m.pad_height)), "b", "mm", "Smaller side of the pad"
buckling.slenderness = m.adopted_length / m.smaller_side, "λ", "1", "Ratio of length to smaller side", "this method"
buckling.length_limit = (choice(case(m.length_step * np.floor(three_sides(m.smaller_side) / m.length_step + 1e-09), "in whole steps",
    m.length_step <= three_sides(m.smaller_side)), case(three_sides.of(side=m.smaller_side), "less than a step")), "H_λ", "mm",
    "Length up to which this pad does not buckle", "this method")
buckling.least_side = inner(m.adopted_length / 3, needs=("adopted_length",)), "b_0", "mm", "Minimum side of a square pad at this length"
buckling.least_side = (inner((m.area * m.free_length / 3) ** (number(1) / 3), lacks=("adopted_length",)), "b_0", "mm",
    "Side of the square pad whose length is three sides")
buckling.steady_pad_side = whole_steps_above.of(length=m.least_side), "b_λ", "mm", "Minimum side of a square pad that does not buckle", "this method"
buckling.steady_damper_count = (value(np.ceil(m.damper_count * m.free_length / m.length_limit - 1e-09), whole=True), "n_λ", "1",
    "Minimum number of dampers of this pad that does not buckle", "this method")
buckling.steady_modulus = (m.elastic_modulus * m.length_limit / m.free_length, "E_λ", "MPa", "Maximum modulus with which this pad does not buckle",
    "this method")

drive = Chapter("Drive still pushing",
    text="A drive that is not disengaged before the stop continues to push with a constant force. Its work over the deflection adds to the energy, "
        "½k·h² = W_k + F·h, and the dampers are compressed further.", needs=("drive",), absent="not calculated: drive is not given")
drive.driving_force = value(m.drive.force, needs=("drive.force",)), "F", "N", "Force of the drive: as given", "input"
drive.driving_force = value(m.drive.torque / m.drive.rolling_radius, lacks=("drive.force",)), "F", "N", "Force of the drive", "statics"
drive.stiffness = m.damper_count * m.area * m.elastic_modulus / m.adopted_length, "k", "N/mm", "Total stiffness of the dampers", "002 eq. 21"
drive.driven_deflection = ((m.driving_force + np.sqrt(m.driving_force**2 + 2 * m.stiffness * m.kinetic_energy)) / m.stiffness, "h_d", "mm",
    "Maximum deflection with the drive", "energy")
drive.driving_work = m.driving_force * m.driven_deflection, "A_d", "J", "Work of the drive until the stop", "energy"
drive.driven_strain = m.driven_deflection / m.adopted_length, "ε_d", "1", "Maximum strain with the drive", "002 eq. 18"
drive.driven_stress = m.elastic_modulus * m.driven_strain, "σ_d", "MPa", "Maximum stress with the drive", "002 eq. 19"
drive.driven_peak_force = m.driven_stress * m.area, "P_d", "N", "Maximum force on one damper with the drive", "002 eq. 20"
drive.driven_peak_deceleration = (value((m.damper_count * m.driven_peak_force - m.driving_force) / m.reduced_mass, needs=("velocity",)), "a_d",
    "m/s**2", "Maximum deceleration with the drive", "dynamics")
drive.driven_stop_time = value(driven_stop_time, needs=("velocity",)), "t_d", "ms", "Time from contact to rest with the drive", "dynamics"
drive.resting_deflection = m.driving_force / m.stiffness, "h_0", "mm", "Deflection at which the drive holds the dampers at rest", "statics"
drive.stress_limit = (inner(np.minimum(m.allowable_stress, m.elastic_modulus * m.max_strain)), "σ_lim", "MPa",
    "Stress within the allowable one and the linear law")
drive.force_limit = m.damper_count * m.area * m.stress_limit / 2, "F_lim", "N", "Force from which no length is sufficient", "energy"
drive.driven_free_length = (value(driven_length, exists=m.driving_force < m.force_limit), "H_d", "mm", "Minimum length that withstands the drive",
    "energy")
drive.driven_length = (value(whole_steps_above.of(length=m.driven_free_length), exists=m.driving_force < m.force_limit), "H_da", "mm",
    "Minimum length that withstands the drive, rounded up to the step", "this method")
drive.driven_damper_count = (value(driven_count, whole=True), "n_d", "1",
    "Minimum number of dampers of this pad and length that withstands the drive", "energy")

SECTIONS = (energy, length, load, loss, stop, heat, buckling, drive)
