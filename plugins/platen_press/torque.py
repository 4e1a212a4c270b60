"""Chapters on forces, torque, the relaxing rods, work and pin pressures."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, bind, case
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
                 text="Both rods together, along the guides, tension positive. The force of the rods' stretch is that of cutting, until the dead "
                      "centre; after it the platen stands and the rods relax.")
forces.value("standing_distance", "x_p", "mm", "Distance of the standing platen's pins from the shaft", formulas.standing_distance,
             source="001 eq. 16", output=False)
forces.value("stretched_length", "L", "mm", "Length of the rods while the platen stands", formulas.stretched_length, source="001 eq. 16, exact",
             output=False)
forces.choice("rod_stretch", "Δl", "mm", "Stretch of the rods",
              *by_phase(bind(common.difference, quantity="stretched_length", less="rod_length"), bind(common.zero),
              bind(formulas.stretch_in_cut)), source="001 eq. 12, 16")
forces.value("elastic_force", "P", "kN", "Force of the stretched rods, while cutting that of the board",
             lambda cutting_force_max, rod_stretch, drive_deformation: cutting_force_max * rod_stretch / drive_deformation,
             source="001, before eq. 12")
forces.choice("inertia_force", "P_i", "N", "Force that accelerates the platen", case(lambda: 0, "the platen stands on the die", in_phase(1)),
              case(bind(formulas.inertia, acceleration="platen_acceleration"), "the platen moves"), source="001, after eq. 2")
forces.value("force", "F", "kN", "Force of the rods along the guides", lambda elastic_force, inertia_force: elastic_force - inertia_force,
             source="001, after eq. 2")
forces.value("crank_pin_force_x", "F_A,x", "kN", "Force of one of the two rods on its crank pin, along the guides", lambda force: force / 2,
             source="symmetry")
forces.value("crank_pin_force_y", "F_A,y", "kN", "Force of one of the two rods on its crank pin, across the guides",
             lambda crank_pin_force_x, rod_angle: crank_pin_force_x * np.tan(rod_angle), source="statics")
forces.crossings("force_change", "φ_F", "deg", "Crank angle at which the force of the rods changes its sign", of="force", output=False)
forces.breakpoints("force_changes", "crank_angle", "force_change")
forces.reduction("inertia_force_max", "P_i,max", "N", "Greatest inertia force of the platen", "abs_max", of="inertia_force")
forces.value("force_max", "F_max", "kN", "Greatest force of the rods: of cutting, or of inertia in free travel",
             lambda cutting_force_max, inertia_force_max: np.maximum(cutting_force_max, inertia_force_max))

friction = Chapter("Friction of the joints",
                   text="Each joint turns under the force of the rods; its friction acts on the joint's radius with the speed at which the two "
                        "parts turn in each other. While the rods relax the crank stands near its dead centre, and X of the dead centre is taken.")
friction.value("rod_speed_ratio", "β′", "1", "Angular speed of the rods to the crank's",
               bind(slider_crank.inner_coupler_angle_speed, coupler_angle="rod_angle", crank_ratio="lambda_ratio"), source="001 eq. 5", output=False)
friction.crossings("rod_turn", "φ_β", "deg", "Crank angle at which the rods swing back", of="rod_speed_ratio", output=False)
friction.breakpoints("rod_turns", "crank_angle", "rod_turn")
friction.value("moving_joint_arm", "X_φ", "mm", "Arm of the joints' friction at the crank angle", formulas.joint_arm, source="001 eq. 5–7",
               output=False)
friction.choice("joint_arm", "X_j", "mm", "Arm of the joints' friction",
                case(lambda friction_arm: friction_arm, "the rods relax: that of the dead centre", in_phase(1)),
                case(lambda moving_joint_arm: moving_joint_arm, "the platen moves"), source="001 eq. 5–7, 17")
friction.value("joint_torque", "M_j", "N*m", "Torque of the joints' friction", lambda force, joint_arm: abs(force) * joint_arm, source="001 eq. 5–7",
               output=False)

guides = Chapter("Friction of the guides",
                 text="A force beside the axis of the guides turns the platen in them. Where the platen stands its guides have no friction. The "
                      "rods carry the friction of the guides too, so that its arm is theirs, V/ω with the ideal speed.", needs=("guide_length",),
                 absent="not calculated: guide_length is not given, and no force is offset from the axis of the guides")
guides.value("guide_moment", "M_g", "N*m", "Moment that turns the platen in its guides", formulas.guide_moment, source="001 eq. 3", output=False)
guides.crossings("guide_change", "φ_g", "deg", "Crank angle at which the guides' reactions change sides", of="guide_moment", output=False)
guides.crossings("platen_turn", "φ_V", "deg", "Crank angle at which the platen reverses", of="platen_velocity_ideal", output=False)
guides.breakpoints("guide_changes", "crank_angle", "guide_change", "platen_turn")
guides.choice("guide_friction", "T", "N", "Friction of the guides", case(lambda: 0, "the platen stands on the die", in_phase(1)),
              case(bind(formulas.guide_friction), "the platen moves"), source="001 eq. 3, 4")
guides.value("guide_torque", "M_n", "N*m", "Torque of the guides' friction", lambda guide_friction, travel_rate: guide_friction * abs(travel_rate),
             source="001 eq. 4", output=False)
guides.value("weight_torque", "M_G", "N*m", "Greatest torque that the guides' friction under the weight alone asks for", formulas.weight_torque,
             source="001 eq. 4", output=False, needs=("allowable_torque",))

torque_chapter = Chapter("Torque at the main shaft",
                         text="The arm of the rods' force follows from the crank and rods alone: V/ω with the ideal speed. What the rods store "
                              "while they stretch the crank has to give too; they give it back after the dead centre.")
torque_chapter.choice("force_arm", "a", "mm", "Arm of the rods' force about the shaft, positive where it resists the crank",
                      case(lambda standing_distance, crank_radius, crank_angle, stretched_length:
                               -standing_distance * crank_radius * np.sin(crank_angle) / stretched_length, "the platen stands on the die",
                           in_phase(1)), case(lambda travel_rate: -travel_rate, "the platen moves"), source="001 eq. 2, 16", output=False)
torque_chapter.value("torque_useful", "M_u", "N*m", "Torque of cutting, stretch and inertia", lambda force, force_arm: force * force_arm,
                     source="virtual work")
torque_chapter.value("torque_friction", "M_f", "N*m", "Torque of friction in joints and guides",
                     lambda joint_torque, guide_torque: joint_torque + guide_torque, source="001 eq. 1", needs=("guide_length",))
torque_chapter.value("torque_friction", "M_f", "N*m", "Torque of friction in the joints", lambda joint_torque: joint_torque, source="001 eq. 1",
                     lacks=("guide_length",))
torque_chapter.value("torque", "M", "N*m", "Torque at the main shaft", lambda torque_useful, torque_friction: torque_useful + torque_friction,
                     source="001 eq. 1, corrected")
torque_chapter.reduction("torque_max", "M_max", "N*m", "Greatest torque", "max", of="torque")
torque_chapter.value("torque_max_angle", "φ_M", "deg", "Crank angle of the greatest torque, before the dead centre",
                     bind(formulas.before_dead_center, angle="torque_max_at"))
torque_chapter.reduction("torque_min", "M_min", "N*m", "Least torque (below zero: platen or rods drive the crank)", "min", of="torque")
torque_chapter.value("crank_pin_torque", "M_A", "N*m", "Torque that one of the two rods, with the friction, puts on its crank",
                     lambda torque: -torque / 2, source="symmetry")
torque_chapter.choice("torque_source", "M_14", "N*m", "Torque by eq. 14 as printed, while cutting",
                      case(bind(formulas.torque_as_printed), "the board is cut", in_phase(3)), case(lambda: 0, "eq. 14 is for cutting alone"),
                      source="001 eq. 14")
torque_chapter.reduction("torque_max_source", "M_14,max", "N*m", "Greatest torque by eq. 14 as printed", "max", of="torque_source")
torque_chapter.value("torque_max_source_angle", "φ_14", "deg", "Its crank angle before the dead centre",
                     bind(formulas.before_dead_center, angle="torque_max_source_at"))

return_chapter = Chapter("Relaxing rods",
                         text="The stretched rods help the crank over an arm that grows until they have relaxed; friction resists over X.")
return_chapter.value("elastic_arm", "a_d", "mm", "Greatest arm over which the relaxing rods help the crank", formulas.elastic_arm,
                     source="001 eq. 16, exact")
return_chapter.value("return_arm_min", "X_min", "mm", "Least excess of the arm of friction over that of the rods",
                     lambda friction_arm, elastic_arm: friction_arm - elastic_arm, source="001 eq. 17")
return_chapter.value("friction_limit", "f_rev", "1", "Coefficient of friction below which the rods would drive the crank",
                     lambda friction, elastic_arm, friction_arm: friction * elastic_arm / friction_arm, source="statics", needs=("friction",),
                     lacks=tuple(key for key, _, _ in ADOPTED), exists=lambda friction: friction > 0)
return_chapter.value("deformation_limit", "Δl_rev", "mm", "Stretch of the drive above which the rods would drive the crank",
                     formulas.deformation_limit, source="statics", exists=lambda friction_arm, crank_radius: friction_arm < crank_radius)

work = Chapter("Work and power",
               text="The model sets the platen moving in no time when the rods have relaxed; the energy of that is no part of the torque over the "
                    "turn and is added to it. What the rods take up before the dead centre they give back after it.")
work.reduction("torque_work", "W_M", "J", "Work of the torque over a turn", "integral", of="torque", output=False)
work.value("start_rod_angle", "β_d", "deg", "Angle of the rods to the guides where they have relaxed",
           bind(slider_crank.inner_coupler_angle, crank_angle="dwell_end_angle", crank_ratio="lambda_ratio"), output=False)
work.value("start_velocity", "V_d", "m/s", "Speed with which the platen leaves the die",
           bind(slider_crank.inner_velocity, crank_angle="dwell_end_angle", coupler_angle="start_rod_angle"), output=False)
work.value("start_energy", "W_d", "J", "Energy that sets the platen moving",
           lambda platen_mass, start_velocity: platen_mass * start_velocity ** 2 / 2, source="energy", output=False)
work.value("work_per_cycle", "W_c", "J", "Work of a cycle, setting the platen moving included",
           lambda torque_work, start_energy: torque_work + start_energy, source="energy")
work.value("cutting_work", "W_s", "J", "Work of cutting the board", formulas.cutting_work, source="energy")
work.reduction("friction_work", "W_f", "J", "Work of friction", "integral", of="torque_friction")
work.value("strain_energy", "W_e", "J", "Energy that the rods store and give back",
           bind(formulas.cutting_work, material_thickness="drive_deformation"), source="energy")
work.value("friction_share", "k_f", "%", "Share of the work that friction takes",
           lambda friction_work, work_per_cycle: friction_work / work_per_cycle)
work.value("power_mean", "P_mean", "W", "Mean power at the main shaft", lambda work_per_cycle, cycles_per_hour: work_per_cycle * cycles_per_hour)
work.value("energy_residual", "r_E", "1", "Difference of work and what it is spent on, relative",
           lambda work_per_cycle, cutting_work, friction_work: abs(work_per_cycle - cutting_work - friction_work) / work_per_cycle,
           source="conservation of energy", output=False)


def _pressure(key: str, name: str, symbol: str, pins: str, radius: str) -> Chapter:
    """The pressure of one kind of pins."""
    chapter = Chapter(f"Pressure of the {pins}", text="Two of them share the force of the rods.", needs=(key,),
                      absent=f"not calculated: {key} is not given")
    chapter.value(name, symbol, "MPa", f"Pressure of the {pins} on their projected area", bind(formulas.pin_pressure, radius=radius, length=key),
                  source="statics")
    return chapter


PRESSURES = (
    _pressure("journal_length", "journal_pressure", "p_0", "journals", "journal_radius"),
    _pressure("crank_pin_length", "crank_pin_pressure", "p_A", "crank pins", "crank_pin_radius"),
    _pressure("platen_pin_length", "platen_pin_pressure", "p_B", "platen's pins", "platen_pin_radius"),
)

rods = Chapter("Stress of the rods", text="Two of them share the force, which pulsates from zero once a turn.", needs=("rod_net_area",),
               absent="not calculated: rod_net_area is not given")
rods.value("rod_stress", "σ_r", "MPa", "Greatest tensile stress of the rods", lambda force_max, rod_net_area: force_max / (2 * rod_net_area),
           source="statics")
