"""The calculation of the rubber damper, chapter by chapter, with its inputs and formulas."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from diecut_report.api import (
    Annotated,
    Block,
    Chapter,
    Constant,
    FromPress,
    Inputs,
    OneOf,
    Quantity,
    as_angle,
    as_number,
    bind,
    case,
    formula,
    number,
    pi,
)
from diecut_report.mechanics import common
from diecut_report.mechanics.common import rounded_up

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
energy.value("kinetic_energy", "W_k", "J", "Kinetic energy at contact: as given",
    bind(lambda kinetic_energy: kinetic_energy, kinetic_energy="inputs.kinetic_energy"), source="input", needs=("kinetic_energy",))
energy.value("kinetic_energy", "W_k", "J", "Kinetic energy at contact",
    lambda mass, inertia, rolling_radius, velocity: (mass + inertia / rolling_radius ** 2) * velocity ** 2 / 2, source="energy",
    lacks=("kinetic_energy", "carriage_mass"))
energy.value("kinetic_energy", "W_k", "J", "Kinetic energy at contact, with the carriages and the unbalance", kinetic_energy, source="energy",
    needs=STOPPED)
energy.value("elastic_modulus", "E", "MPa", "Elastic modulus of the rubber: as given",
    bind(lambda elastic_modulus: elastic_modulus, elastic_modulus="inputs.elastic_modulus"), source="input", needs=("elastic_modulus",),
    lacks=("dynamic_stiffness_factor",))
energy.value("elastic_modulus", "E", "MPa", "Elastic modulus from the hardness, with p_G = 0.0981 MPa", gent_modulus, source="Gent 1958",
    lacks=("elastic_modulus", "dynamic_stiffness_factor"))
energy.value("static_modulus", "E_0", "MPa", "Elastic modulus at rest: as given",
    bind(lambda elastic_modulus: elastic_modulus, elastic_modulus="inputs.elastic_modulus"), source="input",
    needs=("elastic_modulus", "dynamic_stiffness_factor"))
energy.value("static_modulus", "E_0", "MPa", "Elastic modulus at rest from the hardness, with p_G = 0.0981 MPa", gent_modulus, source="Gent 1958",
    needs=("dynamic_stiffness_factor",), lacks=("elastic_modulus",))
energy.value("elastic_modulus", "E", "MPa", "Elastic modulus at the speed of the impact",
    lambda dynamic_stiffness_factor, static_modulus: dynamic_stiffness_factor * static_modulus, source="this method",
    needs=("dynamic_stiffness_factor",))

length = Chapter("Length",
    text="The n dampers that act at once absorb the energy as linear springs: W_k = n·P·h/2 (002 eq. 18–22). At the allowable stress this gives the "
        "length.")
length.value("area", "S", "mm**2", "Compressed area of one damper", lambda ring_width, pad_height: ring_width * pad_height,
    source="002, after eq. 22")
length.value("free_length", "H", "mm", "Free length of the damper at the allowable stress",
    lambda kinetic_energy, elastic_modulus, damper_count, area, allowable_stress:
        2 * kinetic_energy * elastic_modulus / (damper_count * area * allowable_stress**2), source="002 eq. 23, for n dampers")
length.value("adopted_length", "H_a", "mm", "Adopted length: as given",
    bind(lambda adopted_length: adopted_length, adopted_length="inputs.adopted_length"), source="input", needs=("adopted_length",))
length.value("adopted_length", "H_a", "mm", "Adopted length: rounded up to the step", bind(whole_steps_above, length="free_length"),
    source="this method", lacks=("adopted_length",))

load = Chapter("Load at the adopted length")
load.value("stress", "σ", "MPa", "Maximum compressive stress",
    lambda kinetic_energy, elastic_modulus, damper_count, area, adopted_length:
        np.sqrt(2 * kinetic_energy * elastic_modulus / (damper_count * area * adopted_length)),
    source="002 eq. 22")
load.value("strain", "ε", "1", "Maximum strain", lambda stress, elastic_modulus: stress / elastic_modulus, source="002 eq. 19")
load.value("peak_force", "P", "N", "Maximum force on one damper", lambda stress, area: stress * area, source="002 eq. 20")
load.value("stiffness_borne", "k_d,max", "1", "Ratio of dynamic to static stiffness at which the allowable stress is reached",
    bind(stiffness_borne, modulus="elastic_modulus"), source="002 eq. 22", lacks=("dynamic_stiffness_factor",))
load.value("stiffness_borne", "k_d,max", "1", "Ratio of dynamic to static stiffness at which the allowable stress is reached",
    bind(stiffness_borne, modulus="static_modulus"), source="002 eq. 22", needs=("dynamic_stiffness_factor",))
load.value("deflection", "h", "mm", "Maximum deflection",
    lambda peak_force, adopted_length, area, elastic_modulus: peak_force * adopted_length / (area * elastic_modulus), source="002 eq. 21")

loss = Chapter("Energy loss of an impact")
loss.require("one_loss", bind(lambda loss_fraction: loss_fraction < 0, loss_fraction="inputs.loss_fraction"), key="loss_tangent",
    message="is given, and so is a loss_fraction of {inputs.loss_fraction}, but one follows from the other; leave one of them out",
    needs=("loss_fraction", "loss_tangent"))
loss.value("loss_fraction", "ψ", "1", "Fraction of the energy lost in one impact: as given",
    bind(lambda loss_fraction: loss_fraction, loss_fraction="inputs.loss_fraction"), source="input", needs=("loss_fraction",),
    lacks=("loss_tangent",))
loss.value("loss_fraction", "ψ", "1", "Fraction of the energy lost in one impact: usual for rubber", bind(common.same, quantity=USUAL_LOSS),
    source="this method", lacks=("loss_fraction", "loss_tangent"))
loss.value("loss_fraction", "ψ", "1", "Fraction of the energy lost in one impact: half a cycle",
    lambda loss_tangent: 1 - np.exp(-as_number(pi) * loss_tangent), source="this method", needs=("loss_tangent",))

stop = Chapter("Stop and rebound", text="Mass and dampers oscillate as a mass–spring system: the stop is a quarter of the period.",
    needs=("velocity",), absent="not calculated: velocity is not given")
stop.value("reduced_mass", "m_red", "kg", "Equivalent mass at the speed of contact",
    lambda kinetic_energy, velocity: 2 * kinetic_energy / velocity**2, source="energy")
stop.value("stop_time", "t_s", "ms", "Time from contact to rest", lambda deflection, velocity: as_number(pi) * deflection / (2 * velocity),
    source="this method")
stop.value("peak_deceleration", "a_max", "m/s**2", "Maximum deceleration",
    lambda damper_count, peak_force, reduced_mass: damper_count * peak_force / reduced_mass, source="this method")
stop.value("rebound_velocity", "v_r", "m/s", "Rebound speed", lambda velocity, loss_fraction: velocity * np.sqrt(1 - loss_fraction), source="energy")

heat = Chapter("Heat", needs=("impacts_per_hour",), absent="not calculated: neither impacts_per_hour nor the press's productivity is given")
heat.value("heat_power", "P_h", "W", "Heat flow from the dampers of one end",
    lambda loss_fraction, kinetic_energy, impacts_per_hour: loss_fraction * kinetic_energy * impacts_per_hour, source="energy")

buckling = Chapter("Buckling",
    text="A block with clamped ends does not buckle up to a length of three times its smaller side. The changes that bring this about, each by "
        "itself, are listed with the slenderness; a wider pad or more dampers need a shorter length for the same energy.")
buckling.value("smaller_side", "b", "mm", "Smaller side of the pad", lambda ring_width, pad_height: np.minimum(ring_width, pad_height), output=False)
buckling.value("slenderness", "λ", "1", "Ratio of length to smaller side", lambda adopted_length, smaller_side: adopted_length / smaller_side,
    source="this method")
buckling.choice("length_limit", "H_λ", "mm", "Length up to which this pad does not buckle",
    case(lambda smaller_side, length_step: length_step * np.floor(three_sides(smaller_side) / length_step + 1e-09), "in whole steps",
        lambda length_step, smaller_side: length_step <= three_sides(smaller_side)),
    case(bind(three_sides, side="smaller_side"), "less than a step"), source="this method")
buckling.value("least_side", "b_0", "mm", "Minimum side of a square pad at this length", lambda adopted_length: adopted_length / 3, output=False,
    needs=("adopted_length",))
buckling.value("least_side", "b_0", "mm", "Side of the square pad whose length is three sides",
    lambda area, free_length: (area * free_length / 3) ** (number(1) / 3), output=False, lacks=("adopted_length",))
buckling.value("steady_pad_side", "b_λ", "mm", "Minimum side of a square pad that does not buckle", bind(whole_steps_above, length="least_side"),
    source="this method")
buckling.value("steady_damper_count", "n_λ", "1", "Minimum number of dampers of this pad that does not buckle",
    lambda damper_count, free_length, length_limit: np.ceil(damper_count * free_length / length_limit - 1e-09), whole=True, source="this method")
buckling.value("steady_modulus", "E_λ", "MPa", "Maximum modulus with which this pad does not buckle",
    lambda elastic_modulus, free_length, length_limit: elastic_modulus * length_limit / free_length, source="this method")

drive = Chapter("Drive still pushing",
    text="A drive that is not disengaged before the stop continues to push with a constant force. Its work over the deflection adds to the energy, "
        "½k·h² = W_k + F·h, and the dampers are compressed further.", needs=("drive",), absent="not calculated: drive is not given")
drive.value("driving_force", "F", "N", "Force of the drive: as given", bind(lambda force: force, force="drive.force"), source="input",
    needs=("drive.force",))
drive.value("driving_force", "F", "N", "Force of the drive",
    bind(lambda torque, rolling_radius: torque / rolling_radius, torque="drive.torque", rolling_radius="drive.rolling_radius"), source="statics",
    lacks=("drive.force",))
drive.value("stiffness", "k", "N/mm", "Total stiffness of the dampers",
    lambda damper_count, area, elastic_modulus, adopted_length: damper_count * area * elastic_modulus / adopted_length, source="002 eq. 21")
drive.value("driven_deflection", "h_d", "mm", "Maximum deflection with the drive",
    lambda driving_force, stiffness, kinetic_energy: (driving_force + np.sqrt(driving_force**2 + 2 * stiffness * kinetic_energy)) / stiffness,
    source="energy")
drive.value("driving_work", "A_d", "J", "Work of the drive until the stop",
    lambda driving_force, driven_deflection: driving_force * driven_deflection, source="energy")
drive.value("driven_strain", "ε_d", "1", "Maximum strain with the drive",
    lambda driven_deflection, adopted_length: driven_deflection / adopted_length, source="002 eq. 18")
drive.value("driven_stress", "σ_d", "MPa", "Maximum stress with the drive", lambda elastic_modulus, driven_strain: elastic_modulus * driven_strain,
    source="002 eq. 19")
drive.value("driven_peak_force", "P_d", "N", "Maximum force on one damper with the drive", lambda driven_stress, area: driven_stress * area,
    source="002 eq. 20")
drive.value("driven_peak_deceleration", "a_d", "m/s**2", "Maximum deceleration with the drive",
    lambda damper_count, driven_peak_force, driving_force, reduced_mass: (damper_count * driven_peak_force - driving_force) / reduced_mass,
    source="dynamics", needs=("velocity",))
drive.value("driven_stop_time", "t_d", "ms", "Time from contact to rest with the drive", driven_stop_time, source="dynamics", needs=("velocity",))
drive.value("resting_deflection", "h_0", "mm", "Deflection at which the drive holds the dampers at rest",
    lambda driving_force, stiffness: driving_force / stiffness, source="statics")
drive.value("stress_limit", "σ_lim", "MPa", "Stress within the allowable one and the linear law",
    lambda allowable_stress, elastic_modulus, max_strain: np.minimum(allowable_stress, elastic_modulus * max_strain), output=False)
drive.value("force_limit", "F_lim", "N", "Force from which no length is sufficient",
    lambda damper_count, area, stress_limit: damper_count * area * stress_limit / 2, source="energy")
drive.value("driven_free_length", "H_d", "mm", "Minimum length that withstands the drive", driven_length, source="energy",
    exists=lambda driving_force, force_limit: driving_force < force_limit)
drive.value("driven_length", "H_da", "mm", "Minimum length that withstands the drive, rounded up to the step",
    bind(whole_steps_above, length="driven_free_length"), source="this method",
    exists=lambda driving_force, force_limit: driving_force < force_limit)
drive.value("driven_damper_count", "n_d", "1", "Minimum number of dampers of this pad and length that withstands the drive", driven_count,
    whole=True, source="energy")

SECTIONS = (energy, length, load, loss, stop, heat, buckling, drive)
