"""Chapters on forces, torque, the relaxing rods, work and pin pressures."""

from __future__ import annotations

import numpy as np

from diecut_report.api import GRAVITY, Chapter, bind, case
from diecut_report.mechanics import common, slider_crank
from diecut_report.plugins.platen_press import formulas
from diecut_report.plugins.platen_press.motion import ADOPTED, by_phase, in_phase

# fmt: off

LOAD = (
    "torque_max",
    "allowable_torque",
    "cutting_force_max",
    "torque_max_angle",
    "cutting_start_angle",
    "inertia_force_max",
    "crank_radius",
)

forces = Chapter("Force of the rods",
    text="Both rods together, along the guides, tension positive. The force from the rods' elongation equals the cutting force up to the dead "
        "centre; after it the platen stands and the rods relax.")
forces.value("standing_distance", "x_p", "mm", "Distance of the standing platen's pins from the shaft",
    lambda rod_length, drive_deformation, crank_radius: rod_length + drive_deformation - crank_radius,
    source="001 eq. 16", output=False)
forces.value("stretched_length", "L", "mm", "Length of the rods while the platen stands", formulas.stretched_length, source="001 eq. 16, exact",
    output=False)
forces.choice("rod_stretch", "Δl", "mm", "Elongation of the rods",
    *by_phase(bind(common.difference, quantity="stretched_length", less="rod_length"), bind(common.zero),
        bind(lambda platen_displacement, material_thickness, drive_deformation:
                drive_deformation * (1 - platen_displacement / (material_thickness + drive_deformation)))), source="001 eq. 12, 16")
forces.value("elastic_force", "P", "kN", "Force of the elongated rods; while cutting, equal to the cutting force",
    lambda cutting_force_max, rod_stretch, drive_deformation: cutting_force_max * rod_stretch / drive_deformation, source="001, before eq. 12")
forces.choice("inertia_force", "P_i", "N", "Inertia force of the platen", case(lambda: 0, "the platen stands on the die", in_phase(1)),
    case(lambda platen_mass, platen_acceleration: platen_mass * platen_acceleration, "the platen moves"), source="001, after eq. 2")
forces.value("force", "F", "kN", "Force of the rods along the guides", lambda elastic_force, inertia_force: elastic_force - inertia_force,
    source="001, after eq. 2")
forces.value("crank_pin_force_x", "F_A,x", "kN", "Force of one of the two rods on its crank pin, along the guides", lambda force: force / 2,
    source="symmetry")
forces.value("crank_pin_force_y", "F_A,y", "kN", "Force of one of the two rods on its crank pin, across the guides",
    lambda crank_pin_force_x, rod_angle: crank_pin_force_x * np.tan(rod_angle), source="statics")
forces.crossings("force_change", "φ_F", "deg", "Crank angle at which the force of the rods changes its sign", of="force", output=False)
forces.breakpoints("force_changes", "crank_angle", "force_change")
forces.reduction("inertia_force_max", "P_i,max", "N", "Maximum inertia force of the platen", "abs_max", of="inertia_force")
forces.value("force_max", "F_max", "kN", "Maximum force of the rods: from cutting, or from inertia in free travel",
    lambda cutting_force_max, inertia_force_max: np.maximum(cutting_force_max, inertia_force_max))

friction = Chapter("Friction of the joints",
    text="Each joint turns under the force of the rods; its friction acts at the joint's radius with the relative angular speed of the two parts. "
        "While the rods relax the crank is near its dead centre, and the value of X at the dead centre is used.")
friction.value("rod_speed_ratio", "β′", "1", "Ratio of the rods' angular speed to the crank's",
    bind(slider_crank.inner_coupler_angle_speed, coupler_angle="rod_angle", crank_ratio="lambda_ratio"), source="001 eq. 5", output=False)
friction.crossings("rod_turn", "φ_β", "deg", "Crank angle at which the rods reverse their swing", of="rod_speed_ratio", output=False)
friction.breakpoints("rod_turns", "crank_angle", "rod_turn")
friction.value("moving_joint_arm", "X_φ", "mm", "Friction arm of the joints at the crank angle", formulas.joint_arm, source="001 eq. 5–7",
    output=False)
friction.choice("joint_arm", "X_j", "mm", "Friction arm of the joints",
    case(lambda friction_arm: friction_arm, "the rods relax: value at the dead centre", in_phase(1)),
    case(lambda moving_joint_arm: moving_joint_arm, "the platen moves"), source="001 eq. 5–7, 17")
friction.value("joint_torque", "M_j", "N*m", "Torque from joint friction", lambda force, joint_arm: abs(force) * joint_arm, source="001 eq. 5–7",
    output=False)

guides = Chapter("Friction of the guides",
    text="A force offset from the axis of the guides tilts the platen in them. Where the platen stands, its guides have no friction. The rods also "
        "carry the friction of the guides, so its arm is theirs, V/ω with the ideal speed.", needs=("guide_length",),
    absent="not calculated: guide_length is not given, and no force is offset from the axis of the guides")
guides.value("guide_moment", "M_g", "N*m", "Tilting moment on the platen in its guides",
    lambda force, offset_force, platen_mass, offset_weight: force * offset_force - platen_mass * GRAVITY * offset_weight, source="001 eq. 3",
    output=False)
guides.crossings("guide_change", "φ_g", "deg", "Crank angle at which the guides' reactions change sides", of="guide_moment", output=False)
guides.crossings("platen_turn", "φ_V", "deg", "Crank angle at which the platen reverses", of="platen_velocity_ideal", output=False)
guides.breakpoints("guide_changes", "crank_angle", "guide_change", "platen_turn")
guides.choice("guide_friction", "T", "N", "Friction of the guides", case(lambda: 0, "the platen stands on the die", in_phase(1)),
    case(lambda friction_guide, guide_moment, guide_length: 2 * friction_guide * abs(guide_moment) / guide_length, "the platen moves"),
    source="001 eq. 3, 4")
guides.value("guide_torque", "M_n", "N*m", "Torque from guide friction", lambda guide_friction, travel_rate: guide_friction * abs(travel_rate),
    source="001 eq. 4", output=False)
guides.value("weight_torque", "M_G", "N*m", "Maximum torque due to the guides' friction under the weight alone", formulas.weight_torque,
    source="001 eq. 4", output=False, needs=("allowable_torque",))

torque = Chapter("Torque at the main shaft",
    text="The moment arm of the rods' force follows from the crank and rods alone: V/ω with the ideal speed. The crank must also supply the strain "
        "energy of the rods; they return it after the dead centre.")
torque.choice("force_arm", "a", "mm", "Moment arm of the rods' force about the shaft, positive where it resists the crank",
    case(lambda standing_distance, crank_radius, crank_angle, stretched_length:
            -standing_distance * crank_radius * np.sin(crank_angle) / stretched_length, "the platen stands on the die", in_phase(1)),
    case(lambda travel_rate: -travel_rate, "the platen moves"), source="001 eq. 2, 16", output=False)
torque.value("torque_useful", "M_u", "N*m", "Torque from cutting, elongation and inertia", lambda force, force_arm: force * force_arm,
    source="virtual work")
torque.value("torque_friction", "M_f", "N*m", "Torque from friction in joints and guides",
    lambda joint_torque, guide_torque: joint_torque + guide_torque, source="001 eq. 1", needs=("guide_length",))
torque.value("torque_friction", "M_f", "N*m", "Torque from friction in the joints", lambda joint_torque: joint_torque, source="001 eq. 1",
    lacks=("guide_length",))
torque.value("torque", "M", "N*m", "Torque at the main shaft", lambda torque_useful, torque_friction: torque_useful + torque_friction,
    source="001 eq. 1, corrected")
torque.reduction("torque_max", "M_max", "N*m", "Maximum torque", "max", of="torque")
torque.value("torque_max_angle", "φ_M", "deg", "Crank angle of the maximum torque, before the dead centre",
    lambda torque_max_at: np.where(torque_max_at > 0, 2 * np.pi - torque_max_at, 0))
torque.reduction("torque_min", "M_min", "N*m", "Minimum torque (negative: platen or rods drive the crank)", "min", of="torque")
torque.value("crank_pin_torque", "M_A", "N*m", "Torque of one of the two rods, including friction, on its crank", lambda torque: -torque / 2,
    source="symmetry")
torque.choice("torque_source", "M_14", "N*m", "Torque by eq. 14 as printed, while cutting",
    case(bind(formulas.torque_as_printed), "the board is cut", in_phase(3)), case(lambda: 0, "eq. 14 is for cutting alone"), source="001 eq. 14")
torque.reduction("torque_max_source", "M_14,max", "N*m", "Maximum torque by eq. 14 as printed", "max", of="torque_source")
torque.value("torque_max_source_angle", "φ_14", "deg", "Its crank angle before the dead centre",
    lambda torque_max_source_at: np.where(torque_max_source_at > 0, 2 * np.pi - torque_max_source_at, 0))

returning = Chapter("Relaxing rods",
    text="The elongated rods drive the crank over an arm that grows until they have relaxed; friction resists over X.")
returning.value("elastic_arm", "a_d", "mm", "Maximum arm with which the relaxing rods drive the crank",
    lambda standing_distance, crank_radius, dwell_end_angle, rod_length: standing_distance * crank_radius * np.sin(dwell_end_angle) / rod_length,
    source="001 eq. 16, exact")
returning.value("return_arm_min", "X_min", "mm", "Minimum excess of the friction arm over the arm of the rods",
    lambda friction_arm, elastic_arm: friction_arm - elastic_arm, source="001 eq. 17")
returning.value("friction_limit", "f_rev", "1", "Coefficient of friction below which the rods would drive the crank",
    lambda friction, elastic_arm, friction_arm: friction * elastic_arm / friction_arm, source="statics", needs=("friction",),
    lacks=tuple(key for key, _, _ in ADOPTED), exists=lambda friction: friction > 0)
returning.value("deformation_limit", "Δl_rev", "mm", "Elongation of the drive above which the rods would drive the crank", formulas.deformation_limit,
    source="statics", exists=lambda friction_arm, crank_radius: friction_arm < crank_radius)

work = Chapter("Work and power",
    text="In the model the platen is set in motion instantaneously when the rods have relaxed; this energy is not part of the torque over the "
        "revolution and is added to it. The energy stored in the rods before the dead centre is returned after it.")
work.reduction("torque_work", "W_M", "J", "Work of the torque over a revolution", "integral", of="torque", output=False)
work.value("start_rod_angle", "β_d", "deg", "Angle of the rods to the guides where they have relaxed",
    bind(slider_crank.inner_coupler_angle, crank_angle="dwell_end_angle", crank_ratio="lambda_ratio"), output=False)
work.value("start_velocity", "V_d", "m/s", "Speed with which the platen leaves the die",
    bind(slider_crank.inner_velocity, crank_angle="dwell_end_angle", coupler_angle="start_rod_angle"), output=False)
work.value("start_energy", "W_d", "J", "Energy to set the platen in motion",
    lambda platen_mass, start_velocity: platen_mass * start_velocity ** 2 / 2, source="energy", output=False)
work.value("work_per_cycle", "W_c", "J", "Work per cycle, including setting the platen in motion",
    lambda torque_work, start_energy: torque_work + start_energy, source="energy")
work.value("cutting_work", "W_s", "J", "Work of cutting the board",
    lambda cutting_force_max, material_thickness: cutting_force_max * material_thickness / 2, source="energy")
work.reduction("friction_work", "W_f", "J", "Work of friction", "integral", of="torque_friction")
work.value("strain_energy", "W_e", "J", "Energy stored and returned by the rods",
    lambda cutting_force_max, drive_deformation: cutting_force_max * drive_deformation / 2, source="energy")
work.value("friction_share", "k_f", "%", "Fraction of the work taken by friction",
    lambda friction_work, work_per_cycle: friction_work / work_per_cycle)
work.value("power_mean", "P_mean", "W", "Mean power at the main shaft", lambda work_per_cycle, cycles_per_hour: work_per_cycle * cycles_per_hour)
work.value("energy_residual", "r_E", "1", "Relative difference between the work and its components",
    lambda work_per_cycle, cutting_work, friction_work: abs(work_per_cycle - cutting_work - friction_work) / work_per_cycle,
    source="conservation of energy", output=False)


def _pressure(key: str, name: str, symbol: str, pins: str, radius: str) -> Chapter:
    """The pressure of one kind of pins."""
    chapter = Chapter(f"Pressure on the {pins}", text="The two of them share the force of the rods.", needs=(key,),
        absent=f"not calculated: {key} is not given")
    chapter.value(name, symbol, "MPa", f"Pressure on the {pins} on their projected area",
        bind(lambda force_max, radius, length: force_max / (4 * radius * length), radius=radius, length=key), source="statics")
    return chapter


PRESSURES = (
    _pressure("journal_length", "journal_pressure", "p_0", "journals", "journal_radius"),
    _pressure("crank_pin_length", "crank_pin_pressure", "p_A", "crank pins", "crank_pin_radius"),
    _pressure("platen_pin_length", "platen_pin_pressure", "p_B", "platen's pins", "platen_pin_radius"),
)

rods = Chapter("Stress in the rods", text="The two of them share the force, which pulsates from zero once per revolution.", needs=("rod_net_area",),
    absent="not calculated: rod_net_area is not given")
rods.value("rod_stress", "σ_r", "MPa", "Maximum tensile stress of the rods", lambda force_max, rod_net_area: force_max / (2 * rod_net_area),
    source="statics")
