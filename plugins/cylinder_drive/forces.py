"""Chapters on moments, torque and forces."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, bind, case
from diecut_report.mechanics import four_bar
from diecut_report.plugins.cylinder_drive import loads
from diecut_report.plugins.cylinder_drive.linkage import TECHNOLOGICAL

# fmt: off

SHAFTS = ("pinion_inertia", "rocker_inertia")

moments = Chapter("Moments on the cylinder", text="The flat is down at θ = 0; the technological moment always resists the motion.")
moments.value("reduced_inertia", "I_r", "kg*m**2", "Equivalent inertia of the rolling cylinder, translation included",
    lambda cylinder_inertia, cylinder_mass, cylinder_radius: cylinder_inertia + cylinder_mass * cylinder_radius**2,
    source="000 eq. 12")
moments.value("greatest_unbalance", "me_max", "kg*m", "Unbalance if the centre of mass were at the cylinder's surface",
    lambda cylinder_mass, cylinder_radius: cylinder_mass * cylinder_radius, output=False)
moments.value("inertia_moment", "M_in", "N*m", "Moment of inertia forces and unbalance", loads.inertia_moment,
    source="000 eq. 12, with the unbalance")
moments.add(TECHNOLOGICAL)
MOMENT = bind(lambda inertia_moment, technological_moment, direction: inertia_moment + technological_moment * direction)
moments.value("total_moment", "M_Σ", "N*m", "Moment on the cylinder's axis", MOMENT, lacks=SHAFTS, source="000 eq. 11, 20, corrected")
moments.value("cylinder_moment", "M_c", "N*m", "Moment on the cylinder's axis, of the cylinder alone", MOMENT, needs=SHAFTS,
    source="000 eq. 11, 20, corrected")
moments.value("pinion_moment", "M_p", "N*m", "Moment on the pinion, with the inertia of its shaft",
    lambda cylinder_moment, pinion_inertia, cylinder_acceleration: cylinder_moment + pinion_inertia * cylinder_acceleration, needs=SHAFTS,
    source="this method")
moments.value("total_moment", "M_Σ", "N*m", "Moment on the cylinder's axis, with the inertia of the shafts of pinion and rocker",
    lambda pinion_moment, rocker_inertia, sector_ratio, cylinder_acceleration:
        pinion_moment + rocker_inertia / sector_ratio**2 * cylinder_acceleration, needs=SHAFTS, source="this method")
for id, symbol, words in (("cylinder_moment", "M_c", "Moment on the cylinder's axis, of the cylinder alone"),
                          ("pinion_moment", "M_p", "Moment on the pinion")):
    moments.value(id, symbol, "N*m", words, lambda total_moment: total_moment, lacks=SHAFTS, output=False, printed=False)
moments.value("shafts_inertia", "I_s", "kg*m**2", "Inertia of the shafts of pinion and rocker, at the cylinder",
    lambda pinion_inertia, rocker_inertia, sector_ratio: pinion_inertia + rocker_inertia / sector_ratio**2, needs=SHAFTS, source="energy")
moments.value("shafts_inertia", "I_s", "kg*m**2", "Inertia of the shafts of pinion and rocker: neglected", lambda: 0, lacks=SHAFTS,
    output=False, printed=False)
moments.value("moved_inertia", "I_Σ", "kg*m**2", "Equivalent inertia at the cylinder, with the shafts of pinion and rocker",
    lambda reduced_inertia, shafts_inertia: reduced_inertia + shafts_inertia, needs=SHAFTS, source="energy")
moments.value("moved_inertia", "I_Σ", "kg*m**2", "Equivalent inertia at the cylinder", lambda reduced_inertia: reduced_inertia, lacks=SHAFTS,
    output=False, printed=False)
moments.value("rocker_acceleration", "ε_3", "rad/s**2", "Angular acceleration of the rocker",
    lambda cylinder_acceleration, sector_ratio: cylinder_acceleration / sector_ratio, output=False, needs=SHAFTS, source="kinematics")
moments.crossings("flank_change", "φ_f", "deg", "Crank angle at which the teeth of sector and pinion change flanks", of="total_moment")
moments.breakpoints("losses", "crank_angle", "flank_change")
moments.reduction("inertia_moment_max", "M_in,max", "N*m", "Maximum moment of inertia forces", "max", of="inertia_moment")
moments.reduction("inertia_moment_min", "M_in,min", "N*m", "Minimum moment of inertia forces", "min", of="inertia_moment")

torque = Chapter("Torque at the crank",
    text="Referred to the crank, the efficiency follows the direction of power: the losses add where the crank drives and subtract where the "
        "cylinder drives.")
torque.value("efficiency_total", "η", "1", "Efficiency from the crank to the cylinder",
    lambda efficiency_four_bar, efficiency_sector, efficiency_gear, efficiency_chain, efficiency_bearings:
        efficiency_four_bar * loads.efficiency_behind_rocker(efficiency_sector, efficiency_gear, efficiency_chain, efficiency_bearings),
    source="000, after eq. 21")
torque.value("lossless_torque", "M_0", "N*m", "Torque at the crank without losses",
    lambda sector_ratio, rocker_speed_ratio, total_moment: sector_ratio * rocker_speed_ratio * total_moment, source="000 eq. 21", output=False)
torque.choice("crank_torque", "M_1", "N*m", "Torque at the crank",
    case(lambda lossless_torque, efficiency_total: lossless_torque / efficiency_total, "power flows from the crank to the cylinder: divided by η",
        lambda lossless_torque: lossless_torque >= 0),
    case(lambda lossless_torque, efficiency_total: lossless_torque * efficiency_total, "the cylinder drives the crank: multiplied by η"),
    source="000 eq. 21, corrected")
torque.reduction("crank_torque_peak", "M_peak", "N*m", "Maximum absolute torque", "abs_max", of="crank_torque")
torque.reduction("crank_torque_max", "M_max", "N*m", "Maximum driving torque", "max", of="crank_torque")
torque.reduction("crank_torque_min", "M_min", "N*m", "Maximum braking torque", "min", of="crank_torque")
torque.reduction("crank_torque_mean", "M_mean", "N*m", "Mean torque", "mean", of="crank_torque")
torque.reduction("crank_torque_rms", "M_rms", "N*m", "Root mean square torque", "rms", of="crank_torque")
torque.value("power_mean", "P_mean", "kW", "Mean power at the crank", lambda crank_torque_mean, crank_speed: crank_torque_mean * crank_speed)
torque.value("power_peak", "P_peak", "kW", "Peak power at the crank", lambda crank_torque_peak, crank_speed: crank_torque_peak * crank_speed)
torque.crossings("torque_reversal", "φ_r", "deg", "Crank angle at which the torque reverses (backlash)", of="crank_torque")

energy = Chapter("Energy balance",
    text="Without losses, one revolution of the crank takes the work of the technological moment; inertia and weight return all of theirs.")
energy.reduction("energy_turn", "E", "J", "Energy over a revolution without losses", "integral", of="lossless_torque", output=False)
energy.value("technological_work", "E_t", "J", "Work of the technological moment, two strokes",
    lambda cutting_arc_fraction, cutting_moment, sector_ratio, swing_angle: 2 * cutting_arc_fraction * cutting_moment * sector_ratio * swing_angle)
energy.value("kinetic_energy_max", "E_k", "J", "Maximum kinetic energy of the cylinder and of the shafts that swing with it, without the unbalance",
    lambda moved_inertia, velocity_max, cylinder_radius: moved_inertia * (velocity_max / cylinder_radius) ** 2 / 2)
energy.value("energy_residual", "r_E", "1", "Relative difference between energy and work",
    lambda energy_turn, technological_work, kinetic_energy_max:
        abs(energy_turn - technological_work) / np.maximum(technological_work, kinetic_energy_max))

clearance = Chapter("Window of the carriages",
    text="The carriages pass while the lower edge of the turned flat leaves their clearance over the die: R(1 − cos(α − θ)) ≥ c_r on both sides of "
        "the lowest position of the flat.", needs=("carriage_clearance", "segment_height"), absent="not calculated: {missing} not given")
clearance.require("clearance_below_flat", lambda carriage_clearance, segment_height: carriage_clearance <= segment_height, key="carriage_clearance",
    message="is {carriage_clearance}, but the flat leaves no more than the segment's height {segment_height}")
clearance.value("clear_rotation", "θ_c", "deg", "Rotation of the cylinder up to which the clearance remains",
    bind(loads.clear_rotation, half_angle="flat_half_angle"))
clearance.value("clear_swing_outer", "δ_c", "deg", "Rocker angle there", lambda clear_rotation, sector_ratio: clear_rotation / sector_ratio,
    output=False)
clearance.value("clear_direction_outer", "β_c", "deg", "Direction of the rocker there",
    lambda outer_direction, clear_swing_outer: outer_direction + clear_swing_outer, output=False)
clearance.value("clear_distance_outer", "q_3", "1", "Distance of the rocker's joint from the crank's pivot there, in crank lengths",
    bind(four_bar.joint_distance, rocker_direction="clear_direction_outer"), output=False)
clearance.value("clear_return_outer", "φ_c0", "deg", "Crank angle there on the return stroke",
    bind(four_bar.crank_angle_return, rocker_direction="clear_direction_outer", joint_distance="clear_distance_outer"), output=False,
    exists=loads.flat_leaves)
clearance.value("clearance_outer_start", "φ_c1", "deg", "Window at the outer dead centre opens (one revolution earlier)",
    lambda clear_return_outer: clear_return_outer - 2 * np.pi, exists=loads.flat_leaves)
clearance.value("clearance_outer_end", "φ_c2", "deg", "Window at the outer dead centre closes",
    bind(four_bar.crank_angle_forward, rocker_direction="clear_direction_outer", joint_distance="clear_distance_outer"), exists=loads.flat_leaves)
clearance.value("clearance_outer_time", "t_c1", "ms", "Time of the window at the outer dead centre",
    lambda clearance_outer_start, clearance_outer_end, crank_speed: (clearance_outer_end - clearance_outer_start) / crank_speed,
    exists=loads.flat_leaves)
clearance.value("clear_swing_inner", "δ_c′", "deg", "Rocker angle from which the flat is clear again",
    lambda clear_rotation, sector_ratio: (2 * np.pi - clear_rotation) / sector_ratio, output=False)
clearance.value("clear_direction_inner", "β_c′", "deg", "Direction of the rocker there",
    lambda outer_direction, clear_swing_inner: outer_direction + clear_swing_inner, output=False)
clearance.value("clear_distance_inner", "q_4", "1", "Distance of the rocker's joint from the crank's pivot there, in crank lengths",
    bind(four_bar.joint_distance, rocker_direction="clear_direction_inner"), output=False)
clearance.value("clearance_inner_start", "φ_c3", "deg", "Window at the inner dead centre opens",
    bind(four_bar.crank_angle_forward, rocker_direction="clear_direction_inner", joint_distance="clear_distance_inner"), exists=loads.flat_arrives)
clearance.value("clearance_inner_end", "φ_c4", "deg", "Window at the inner dead centre closes",
    bind(four_bar.crank_angle_return, rocker_direction="clear_direction_inner", joint_distance="clear_distance_inner"), exists=loads.flat_arrives)
clearance.value("clearance_inner_time", "t_c2", "ms", "Time of the window at the inner dead centre",
    lambda clearance_inner_start, clearance_inner_end, crank_speed: (clearance_inner_end - clearance_inner_start) / crank_speed,
    exists=loads.flat_arrives)
clearance.phase("carriage_window_outer", "window", "Clearance for the carriages at the outer end", "crank_angle",
    ("clearance_outer_start", "clearance_outer_end"))
clearance.phase("carriage_window_inner", "window", "Clearance for the carriages at the inner end", "crank_angle",
    ("clearance_inner_start", "clearance_inner_end"))
clearance.phase("carriage_window", "window", "Clearance for the carriages", "crank_angle", union=("carriage_window_outer", "carriage_window_inner"))

teeth = Chapter("Tooth force of the sector",
    text="The pinion's shaft is fixed in the frame and turns with the cylinder, and a chain moves the carriages of the cylinder: the power at the "
        "teeth is that at the cylinder, so the moment on the pinion is M_Σ, without the inertia of the rocker's shaft where that is given. Losses "
        "between the teeth and the cylinder are not included: where the crank drives, the load on the teeth is higher by the losses of chain and "
        "bearings.", needs=("pinion_radius",),
    absent="not calculated: pinion_radius is not given")
teeth.value("sector_radius", "r_s", "mm", "Pitch radius of the sector", bind(loads.length_of, ratio="sector_ratio", crank_length="pinion_radius"))
teeth.value("tooth_force", "F_t", "kN", "Tangential force between the teeth", lambda pinion_moment, pinion_radius: pinion_moment / pinion_radius)
teeth.value("tooth_normal_force", "F_n", "kN", "Force normal to the flanks", lambda tooth_force, pressure_angle: tooth_force / np.cos(pressure_angle))
teeth.reduction("tooth_force_max", "F_t,max", "kN", "Maximum tangential force", "abs_max", of="tooth_force")
teeth.reduction("tooth_normal_force_max", "F_n,max", "kN", "Maximum force normal to the flanks", "abs_max", of="tooth_normal_force")
teeth.value("tooth_radial_force_max", "F_r,max", "kN", "Maximum force separating sector and pinion",
    lambda tooth_force_max, pressure_angle: tooth_force_max * np.tan(pressure_angle))

joints = Chapter("Forces in the joints",
    text="The links are massless: the coupler carries a single axial force, which acts on each of its joints and on the crank's bearing. It follows "
        "from the rocker's torque, so it remains finite at the dead centres.", needs=("crank_length",),
    absent="not calculated: crank_length is not given")
joints.value("frame_length", "d", "mm", "Length of the frame", bind(loads.length_of, ratio="frame_ratio"))
joints.value("coupler_length", "b_c", "mm", "Length of the coupler", bind(loads.length_of, ratio="coupler_ratio"))
joints.value("rocker_length", "c", "mm", "Length of the rocker", bind(loads.length_of, ratio="rocker_ratio"))
joints.value("efficiency_behind_rocker", "η_s", "1", "Efficiency from the rocker to the cylinder", loads.efficiency_behind_rocker, output=False)
joints.value("lossless_rocker_torque", "M_20", "N*m", "Torque at the rocker without losses",
    lambda sector_ratio, total_moment: sector_ratio * total_moment, output=False)
joints.choice("rocker_torque", "M_2", "N*m", "Torque at the rocker",
    case(lambda lossless_rocker_torque, efficiency_behind_rocker: lossless_rocker_torque / efficiency_behind_rocker,
        "power flows from the rocker to the cylinder: divided by η_s", lambda lossless_torque: lossless_torque >= 0),
    case(lambda lossless_rocker_torque, efficiency_behind_rocker: lossless_rocker_torque * efficiency_behind_rocker,
        "the cylinder drives the rocker: multiplied by η_s"))
joints.value("coupler_force", "F_c", "kN", "Force along the coupler, tension positive",
    lambda rocker_torque, rocker_length, transmission_angle: rocker_torque / (rocker_length * np.sin(transmission_angle)))
joints.value("crank_bearing_force_x", "F_1x", "kN", "Force on the crank's bearing along the frame line",
    lambda coupler_force, coupler_direction: coupler_force * np.cos(coupler_direction))
joints.value("crank_bearing_force_y", "F_1y", "kN", "Force on the crank's bearing normal to the frame line",
    lambda coupler_force, coupler_direction: coupler_force * np.sin(coupler_direction))
joints.reduction("coupler_tension_max", "F_c,max", "kN", "Maximum tension of the coupler", "max", of="coupler_force")
joints.reduction("coupler_tension_min", "F_c,min", "kN", "Maximum compression of the coupler (negative)", "min", of="coupler_force")
joints.reduction("joint_force_max", "F_j", "kN", "Maximum force in the coupler's joints and the crank's bearing", "abs_max", of="coupler_force")
joints.value("rocker_bearing_force", "F_3", "kN",
    "Force on the rocker's bearing: coupler and teeth together, for any position of the pinion (upper bound)",
    lambda coupler_force, tooth_normal_force: abs(coupler_force) + abs(tooth_normal_force), needs=("pinion_radius",))
joints.reduction("rocker_bearing_force_max", "F_3,max", "kN", "Maximum force on the rocker's bearing (upper bound)", "max", of="rocker_bearing_force",
    needs=("pinion_radius",))
