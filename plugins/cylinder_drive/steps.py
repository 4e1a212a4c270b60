"""The calculation of the impression cylinder's drive: linkage and motion, the times of a cycle, forces and torque."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    CURVE_ROUNDING,
    GRAVITY,
    Chapter,
    Expression,
    Formula,
    Steps,
    abscissa,
    arccos,
    as_angle,
    case,
    choice,
    crossings,
    formula,
    inner,
    m,
    pi,
    reduction,
    self_test,
    value,
)
from diecut_report.mechanics import circular_segment, four_bar

# fmt: off


@formula
def inertia_moment(
    reduced_inertia: Any,
    cylinder_radius: Any,
    static_unbalance: Any,
    cylinder_rotation: Any,
    cylinder_speed: Any,
    cylinder_acceleration: Any,
) -> Any:
    """Moment on the cylinder's axis that its inertia and the weight of its unbalance ask for."""
    varying = reduced_inertia + 2 * cylinder_radius * static_unbalance * np.cos(cylinder_rotation)
    centrifugal = cylinder_radius * static_unbalance * np.sin(cylinder_rotation) * cylinder_speed**2
    weight = GRAVITY * static_unbalance * np.sin(cylinder_rotation)
    return varying * cylinder_acceleration - centrifugal - weight


@formula
def efficiency_behind_rocker(
    efficiency_sector: Any, efficiency_gear: Any, efficiency_chain: Any, efficiency_bearings: Any
) -> Any:
    """Efficiency from the rocker to the cylinder."""
    return efficiency_sector * efficiency_gear * efficiency_chain * efficiency_bearings


@formula
def clear_rotation(half_angle: Any, carriage_clearance: Any, cylinder_radius: Any) -> Any:
    """Rotation from the flat's lowest position at which its lower edge still leaves the clearance."""
    return half_angle - arccos(1 - carriage_clearance / cylinder_radius)


@formula
def length_of(ratio: Any, crank_length: Any) -> Any:
    """Length of a link."""
    return ratio * crank_length


@formula
def flat_arrives(sector_ratio: Any, swing_angle: Any, clear_rotation: Any) -> Any:
    """Whether the flat comes within the clear rotation of its lowest position at the inner dead centre."""
    return abs(sector_ratio * swing_angle - 2 * pi) <= clear_rotation


@formula
def flat_leaves(sector_ratio: Any, swing_angle: Any, clear_rotation: Any) -> Any:
    """Whether the cylinder turns beyond the clear rotation at all."""
    return clear_rotation <= sector_ratio * swing_angle


@formula
def far_swing(contact_rotation: Any, sector_ratio: Any, swing_angle: Any) -> Any:
    """Rocker angle at which the flat's other corner leaves the board, no more than the whole swing."""
    return np.minimum((2 * pi - contact_rotation) / sector_ratio, swing_angle)


@formula
def touches_board(contact_rotation: Any, sector_ratio: Any, swing_angle: Any) -> Any:
    """Whether the flat clears the board, and the cylinder turns beyond it."""
    return (contact_rotation > 0) & (contact_rotation < sector_ratio * swing_angle)


@formula
def moves_at_all(standstill_swing: Any, swing_angle: Any) -> Any:
    """Whether the rocker swings further than what counts as standstill."""
    return standstill_swing < swing_angle


def _cutting_edge(chapter: Steps, name: str, symbol: str, description: str, dead_center: Expression, inverse: Formula, edge: str) -> None:
    """A crank angle where cutting begins or ends: a dead centre where the whole stroke cuts.

    There the general formula is left out, for its root turns the last digit of a cosine into 1e-8 rad beside the dead centre.
    """
    inside = inverse.of(rocker_direction=m[f"cut_{edge}_direction"], joint_distance=m[f"cut_{edge}_distance"])
    cases = (case(dead_center, "the whole stroke cuts, from one dead centre to the other", m.cutting_arc_fraction >= 1),
             case(inside, "only the middle of the stroke cuts"))
    chapter[name] = choice(*cases), symbol, "deg", description


linkage = Chapter("Linkage and its dead centres",
    text="Lengths are relative to the crank. The crank angle is counted from the frame line O₁O₃, counter-clockwise.")
linkage.grashof_demand = (inner(1 + np.maximum(m.frame_ratio, np.maximum(m.coupler_ratio, m.rocker_ratio))), "Σ_1", "1",
    "Sum of the shortest and longest links, in crank lengths")
linkage.grashof_limit = (inner(m.frame_ratio + m.coupler_ratio + m.rocker_ratio - np.maximum(m.frame_ratio,
    np.maximum(m.coupler_ratio, m.rocker_ratio))), "Σ_2", "1", "Sum of the other two links, in crank lengths")
linkage.require("crank_rocker", four_bar.is_crank_rocker, key="rocker_ratio",
    message="gives no crank-rocker: with frame_ratio = {frame_ratio}, coupler_ratio = {coupler_ratio} and rocker_ratio = {rocker_ratio} the crank "
    "(1) must be the shortest link, and it and the longest one ({grashof_demand} together) shorter than the other two together "
    "({grashof_limit}) (Grashof); change the ratios so that both hold")
linkage.outer_direction = inner(four_bar.outer_rocker_direction), "γ_3", "deg", "Direction of the rocker at its outer dead centre", "000 eq. 5"
linkage.swing_angle = value(four_bar.swing_angle, digits=6), "δ_max", "deg", "Swing of the rocker", "000 eq. 5, both dead centres"
linkage.dead_center_outer = value(four_bar.outer_dead_center, digits=6), "φ_out", "deg", "Crank angle of the outer dead centre", "closed form"
linkage.dead_center_inner = value(four_bar.inner_dead_center, digits=6), "φ_in", "deg", "Crank angle of the inner dead centre", "closed form"
linkage.time_ratio = ((m.dead_center_inner - m.dead_center_outer) / (2 * pi - (m.dead_center_inner - m.dead_center_outer)), "k_t", "1",
    "Time ratio of the forward to the return stroke")
linkage.transmission_angle_min = four_bar.least_transmission_angle, "μ_1", "deg", "Minimum transmission angle, at φ = 0", "000 eq. 4"
linkage.transmission_angle_max = four_bar.greatest_transmission_angle, "μ_2", "deg", "Maximum transmission angle, at φ = 180°", "000 eq. 4"
linkage.transmission_angle_worst = (inner(np.minimum(m.transmission_angle_min, pi - m.transmission_angle_max)), "μ_w", "deg",
    "Worst transmission angle; for an obtuse angle its supplement")

stroke = Chapter("Sector ratio and stroke")
stroke.sector_ratio = value(m.inputs.sector_ratio, needs=("sector_ratio",), digits=6), "u", "1", "Ratio of sector to pinion: as given", "input"
stroke.sector_ratio = (value(2 * pi / m.swing_angle, lacks=("sector_ratio",), digits=6), "u", "1",
    "Ratio of sector to pinion: the full swing turns the cylinder by one revolution")
stroke.stroke = m.swing_angle * m.sector_ratio * m.cylinder_radius, "S_max", "mm", "Stroke of the cylinder's axis", "000 eq. 8"
stroke.stroke_error = (inner(abs(m.sector_ratio * m.swing_angle - 2 * pi)), "Δθ", "deg",
    "Deviation of the rotation over the stroke from one revolution")

cutting = Chapter("Cutting")
cutting.require("board_below_radius", m.material_thickness < m.cylinder_radius, key="material_thickness",
    message="is {material_thickness}, but the board must be thinner than the cylinder's radius {cylinder_radius}")
cutting.cutting_length = (np.sqrt(2 * m.cylinder_radius * m.material_thickness - m.material_thickness**2), "b", "mm",
    "Cutting length along the motion", "000, after eq. 19")
cutting.rolling_arm = m.rolling_coefficient * m.cutting_length, "k", "mm", "Arm of the rolling resistance", "000, after eq. 19"
cutting.cutting_force = ((m.cutting_force_per_length + m.ejection_force_per_length) * m.cylinder_length, "P_m", "kN",
    "Force of cutting and ejection", "000 eq. 18")
cutting.cutting_moment = m.cutting_force * m.rolling_arm, "M_m", "N*m", "Moment of the technological load", "000 eq. 19"
cutting.cut_begin_swing = inner(m.swing_angle * (1 - m.cutting_arc_fraction) / 2), "δ_1", "deg", "Rocker angle where cutting begins (forward)"
cutting.cut_end_swing = inner(m.swing_angle * (1 + m.cutting_arc_fraction) / 2), "δ_2", "deg", "Rocker angle where cutting ends (forward)"
cutting.cut_begin_direction = inner(m.outer_direction + m.cut_begin_swing), "β_1", "deg", "Direction of the rocker there"
cutting.cut_begin_distance = (inner(four_bar.joint_distance.of(rocker_direction=m.cut_begin_direction)), "q_1", "1",
    "Distance of the rocker's joint from the crank's pivot there, in crank lengths")
cutting.cut_end_direction = inner(m.outer_direction + m.cut_end_swing), "β_2", "deg", "Direction of the rocker there"
cutting.cut_end_distance = (inner(four_bar.joint_distance.of(rocker_direction=m.cut_end_direction)), "q_2", "1",
    "Distance of the rocker's joint from the crank's pivot there, in crank lengths")
_cutting_edge(cutting, "cut_begin_forward", "φ_1", "Crank angle where cutting begins, forward stroke",
        m.dead_center_outer, four_bar.crank_angle_forward, "begin")
_cutting_edge(cutting, "cut_end_forward", "φ_2", "Crank angle where cutting ends, forward stroke", m.dead_center_inner,
        four_bar.crank_angle_forward, "end")
_cutting_edge(cutting, "cut_begin_return", "φ_3", "Crank angle where cutting begins, return stroke",
        m.dead_center_inner, four_bar.crank_angle_return, "end")
_cutting_edge(cutting, "cut_end_return", "φ_4", "Crank angle where cutting ends, return stroke (counted on)",
        m.dead_center_outer + 2 * pi, four_bar.crank_angle_return, "begin")

kinematics = Chapter("Kinematics over a revolution of the crank")
kinematics.crank_angle = (abscissa(2 * np.pi, shown_at="crank_torque_peak_at", intervals=32, speed="crank_speed"), "φ", "deg",
    "Crank angle from the frame line")
kinematics.breakpoints("strokes", "crank_angle", "dead_center_outer", "dead_center_inner", "cut_begin_forward", "cut_end_forward", "cut_begin_return",
    "cut_end_return")
kinematics.diagonal = inner(four_bar.diagonal), "D", "1", "Distance of the crank pin from the rocker's pivot, in crank lengths", "000 eq. 3"
kinematics.diagonal_direction = (inner(four_bar.diagonal_direction), "γ_1", "deg", "Direction from the rocker's pivot to the crank pin",
    "000 eq. 2, over the full turn")
kinematics.pin_angle = inner(four_bar.pin_angle), "γ_2", "deg", "Angle at the crank pin between diagonal and coupler", "000 eq. 3, corrected"
kinematics.transmission_angle = four_bar.transmission_angle, "μ", "deg", "Transmission angle", "000 eq. 4, corrected"
kinematics.coupler_direction = inner(four_bar.coupler_direction), "γ", "deg", "Direction of the coupler", "000, after eq. 6"
kinematics.rocker_direction = inner(four_bar.rocker_direction), "β", "deg", "Direction of the rocker", "000, after eq. 6"
kinematics.rocker_angle = m.rocker_direction - m.outer_direction, "δ", "deg", "Rocker angle from its outer dead centre", "000 eq. 1"
kinematics.rocker_speed_ratio = inner(four_bar.rocker_speed_ratio), "ω_3i", "1", "Ratio of the rocker's angular speed to the crank's", "000 eq. 6"
kinematics.coupler_speed_ratio = (inner(four_bar.coupler_speed_ratio), "ω_2i", "1", "Ratio of the coupler's angular speed to the crank's",
    "000, after eq. 7")
kinematics.rocker_acceleration_ratio = (inner(four_bar.rocker_acceleration_ratio), "ε_3i", "1",
    "Ratio of the rocker's angular acceleration to the square of the crank's speed", "000 eq. 7")
kinematics.displacement = m.rocker_angle * m.sector_ratio * m.cylinder_radius, "S", "mm", "Displacement of the cylinder", "000 eq. 8"
kinematics.velocity = m.rocker_speed_ratio * m.crank_speed * m.sector_ratio * m.cylinder_radius, "V", "m/s", "Velocity of the cylinder", "000 eq. 9"
kinematics.acceleration = (value(m.rocker_acceleration_ratio * m.crank_speed ** 2 * m.sector_ratio * m.cylinder_radius, source_symbol="W"), "a_c",
    "m/s**2", "Acceleration of the cylinder", "000 eq. 10")
kinematics.cylinder_rotation = inner(m.rocker_angle * m.sector_ratio), "θ", "deg", "Rotation of the cylinder", "000 eq. 8"
kinematics.cylinder_speed = (inner(m.rocker_speed_ratio * m.crank_speed * m.sector_ratio), "ω_c", "rad/s", "Angular speed of the cylinder",
    "000, after eq. 12")
kinematics.cylinder_acceleration = (inner(as_angle(m.rocker_acceleration_ratio * m.crank_speed ** 2) * m.sector_ratio), "ε_c", "rad/s**2",
    "Angular acceleration of the cylinder", "000, after eq. 12")
kinematics.velocity_max = reduction("abs_max", of="velocity"), "V_max", "m/s", "Maximum speed of the cylinder"
kinematics.acceleration_max = reduction("abs_max", of="acceleration"), "a_c,max", "m/s**2", "Maximum acceleration of the cylinder"

TECHNOLOGICAL = Steps()
TECHNOLOGICAL.technological_moment = (choice(case(m.cutting_moment, "the cylinder is on the cutting part of its stroke",
    abs(m.displacement - m.stroke / 2) <= m.cutting_arc_fraction * m.stroke / 2), case(0, "the flat is over the die: nothing is cut"), output=False,
    per_piece=True), "M_t", "N*m", "Moment of the technological load at this crank angle")
TECHNOLOGICAL.direction = inner(np.sign(m.cylinder_speed), per_piece=True), "s", "1", "Direction of motion (+1 forward, −1 back)"


def _at_swing(chapter: Steps, name: str, mark: str, place: str, swing: str) -> None:
    """Direction of the rocker at an angle of its swing, and the distance of its joint from the crank's pivot there."""
    chapter[f"{name}_direction"] = inner(m.outer_direction + m[swing]), f"β_{mark}", "deg", f"Direction of the rocker where {place}"
    chapter[f"{name}_distance"] = (inner(four_bar.joint_distance.of(rocker_direction=m[f"{name}_direction"])), f"q_{mark}", "1",
        f"Distance of the rocker's joint from the crank's pivot where {place}, in crank lengths")


def _forward(name: str) -> Expression:
    return four_bar.crank_angle_forward.of(rocker_direction=m[f"{name}_direction"], joint_distance=m[f"{name}_distance"])


def _return(name: str) -> Expression:
    return four_bar.crank_angle_return.of(rocker_direction=m[f"{name}_direction"], joint_distance=m[f"{name}_distance"])


contact = Chapter("Contact of the cylinder with the board",
    text="The cylinder touches the board while the corner of its flat is within the board's thickness: R(1 − cos(α − θ)) ≤ Δ at both corners.",
    needs=("segment_height",), absent="not calculated: segment_height is not given")
contact.require("flat_below_radius", m.segment_height < m.cylinder_radius, key="segment_height",
    message="is {segment_height}, but the segment must be lower than the radius {cylinder_radius}")
contact.flat_half_angle = (inner(circular_segment.half_angle.of(radius=m.cylinder_radius, height=m.segment_height)), "α", "deg",
    "Half the central angle of the flat")
contact.contact_rotation = (clear_rotation.of(half_angle=m.flat_half_angle, carriage_clearance=m.material_thickness), "θ_z", "deg",
    "Rotation of the cylinder where contact with the board begins")
contact.contact_swing = inner(m.contact_rotation / m.sector_ratio), "δ_z", "deg", "Rocker angle where contact with the board begins"
contact.contact_swing_far = (inner(far_swing(m.contact_rotation, m.sector_ratio, m.swing_angle)), "δ_z′", "deg",
    "Rocker angle where contact with the board ends, or the whole swing")
_at_swing(contact, "contact", "z", "contact with the board begins", "contact_swing")
_at_swing(contact, "contact_far", "z′", "contact with the board ends", "contact_swing_far")
INNER_END = case(m.dead_center_inner, "the cylinder touches the board up to the inner end of the stroke", m.contact_swing_far >= m.swing_angle)
contact.contact_begin_forward = (value(_forward("contact"), exists=touches_board), "φ_z1", "deg",
    "Crank angle at which the contact begins, forward stroke")
contact.contact_end_forward = (choice(INNER_END, case(_forward("contact_far"), "the flat leaves the board before the inner end"),
    exists=touches_board), "φ_z2", "deg", "Crank angle at which the contact ends, forward stroke")
contact.contact_begin_return = (choice(INNER_END, case(_return("contact_far"), "the flat leaves the board before the inner end"),
    exists=touches_board), "φ_z3", "deg", "Crank angle at which the contact begins, return stroke")
contact.contact_end_return = (value(_return("contact"), exists=touches_board), "φ_z4", "deg",
    "Crank angle at which the contact ends, return stroke (counted on)")
contact.phase("contact", "working", "Contact of cylinder and board", "crank_angle", ("contact_begin_forward", "contact_end_forward"),
    ("contact_begin_return", "contact_end_return"))

phases = Chapter("Phases of a turn of the crank",
    text="A crank-rocker has no true dwell: the cylinder counts as standing still while it is within θ_s of an end of its rotation.")
phases.standstill_swing = inner(m.standstill_rotation / m.sector_ratio), "δ_s", "deg", "Rocker angle that counts as standstill"
phases.standstill_swing_far = inner(m.swing_angle - m.standstill_swing), "δ_s′", "deg", "Rocker angle at which the standstill at the inner end begins"
_at_swing(phases, "standstill", "s", "the standstill at the outer end ends", "standstill_swing")
_at_swing(phases, "standstill_far", "s′", "the standstill at the inner end begins", "standstill_swing_far")
phases.standstill_outer_start = (value(_return("standstill"), exists=moves_at_all), "φ_s1", "deg",
    "Crank angle at which the standstill at the outer end begins (counted on)")
phases.standstill_outer_end = (value(_forward("standstill"), exists=moves_at_all), "φ_s2", "deg",
    "Crank angle at which the standstill at the outer end ends")
phases.standstill_inner_start = (value(_forward("standstill_far"), exists=moves_at_all), "φ_s3", "deg",
    "Crank angle at which the standstill at the inner end begins")
phases.standstill_inner_end = (value(_return("standstill_far"), exists=moves_at_all), "φ_s4", "deg",
    "Crank angle at which the standstill at the inner end ends")
phases.phase("forward", "moving", "Forward stroke", "crank_angle", ("dead_center_outer", "dead_center_inner"))
phases.phase("return", "moving", "Return stroke", "crank_angle", ("dead_center_inner", "dead_center_outer"))
phases.phase("cutting_forward", "working", "Cutting on the forward stroke", "crank_angle", ("cut_begin_forward", "cut_end_forward"))
phases.phase("cutting_return", "working", "Cutting on the return stroke", "crank_angle", ("cut_begin_return", "cut_end_return"))
phases.phase("cutting", "working", "Cutting", "crank_angle", union=("cutting_forward", "cutting_return"))
phases.phase("standstill", "rest", "Standstill at the ends of the stroke", "crank_angle", ("standstill_outer_start", "standstill_outer_end"),
    ("standstill_inner_start", "standstill_inner_end"))


SHAFTS = ("pinion_inertia", "rocker_inertia")

moments = Chapter("Moments on the cylinder", text="The flat is down at θ = 0; the technological moment always resists the motion.")
moments.reduced_inertia = (m.cylinder_inertia + m.cylinder_mass * m.cylinder_radius**2, "I_r", "kg*m**2",
    "Equivalent inertia of the rolling cylinder, translation included", "000 eq. 12")
moments.greatest_unbalance = (inner(m.cylinder_mass * m.cylinder_radius), "me_max", "kg*m",
    "Unbalance if the centre of mass were at the cylinder's surface")
moments.inertia_moment = inertia_moment, "M_in", "N*m", "Moment of inertia forces and unbalance", "000 eq. 12, with the unbalance"
moments.add(TECHNOLOGICAL)
MOMENT = m.inertia_moment + m.technological_moment * m.direction
moments.total_moment = value(MOMENT, lacks=SHAFTS), "M_Σ", "N*m", "Moment on the cylinder's axis", "000 eq. 11, 20, corrected"
moments.cylinder_moment = (value(MOMENT, needs=SHAFTS), "M_c", "N*m", "Moment on the cylinder's axis, of the cylinder alone",
    "000 eq. 11, 20, corrected")
moments.pinion_moment = (value(m.cylinder_moment + m.pinion_inertia * m.cylinder_acceleration, needs=SHAFTS), "M_p", "N*m",
    "Moment on the pinion, with the inertia of its shaft", "this method")
moments.total_moment = (value(m.pinion_moment + m.rocker_inertia / m.sector_ratio**2 * m.cylinder_acceleration, needs=SHAFTS), "M_Σ", "N*m",
    "Moment on the cylinder's axis, with the inertia of the shafts of pinion and rocker", "this method")
for id, symbol, words in (("cylinder_moment", "M_c", "Moment on the cylinder's axis, of the cylinder alone"),
                          ("pinion_moment", "M_p", "Moment on the pinion")):
    moments[id] = inner(m.total_moment, lacks=SHAFTS, printed=False), symbol, "N*m", words
moments.shafts_inertia = (value(m.pinion_inertia + m.rocker_inertia / m.sector_ratio**2, needs=SHAFTS), "I_s", "kg*m**2",
    "Inertia of the shafts of pinion and rocker, at the cylinder", "energy")
moments.shafts_inertia = inner(0, lacks=SHAFTS, printed=False), "I_s", "kg*m**2", "Inertia of the shafts of pinion and rocker: neglected"
moments.moved_inertia = (value(m.reduced_inertia + m.shafts_inertia, needs=SHAFTS), "I_Σ", "kg*m**2",
    "Equivalent inertia at the cylinder, with the shafts of pinion and rocker", "energy")
moments.moved_inertia = inner(m.reduced_inertia, lacks=SHAFTS, printed=False), "I_Σ", "kg*m**2", "Equivalent inertia at the cylinder"
moments.rocker_acceleration = (inner(m.cylinder_acceleration / m.sector_ratio, needs=SHAFTS), "ε_3", "rad/s**2",
    "Angular acceleration of the rocker", "kinematics")
moments.flank_change = crossings(of="total_moment"), "φ_f", "deg", "Crank angle at which the teeth of sector and pinion change flanks"
moments.breakpoints("losses", "crank_angle", "flank_change")
moments.inertia_moment_max = reduction("max", of="inertia_moment"), "M_in,max", "N*m", "Maximum moment of inertia forces"
moments.inertia_moment_min = reduction("min", of="inertia_moment"), "M_in,min", "N*m", "Minimum moment of inertia forces"

torque = Chapter("Torque at the crank",
    text="Referred to the crank, the efficiency follows the direction of power: the losses add where the crank drives and subtract where the "
        "cylinder drives.")
torque.efficiency_total = (m.efficiency_four_bar * efficiency_behind_rocker(m.efficiency_sector, m.efficiency_gear, m.efficiency_chain,
    m.efficiency_bearings), "η", "1", "Efficiency from the crank to the cylinder", "000, after eq. 21")
torque.lossless_torque = (inner(m.sector_ratio * m.rocker_speed_ratio * m.total_moment), "M_0", "N*m", "Torque at the crank without losses",
    "000 eq. 21")
torque.crank_torque = (choice(case(m.lossless_torque / m.efficiency_total, "power flows from the crank to the cylinder: divided by η",
    m.lossless_torque >= 0), case(m.lossless_torque * m.efficiency_total, "the cylinder drives the crank: multiplied by η")), "M_1", "N*m",
    "Torque at the crank", "000 eq. 21, corrected")
torque.crank_torque_peak = reduction("abs_max", of="crank_torque"), "M_peak", "N*m", "Maximum absolute torque"
torque.crank_torque_max = reduction("max", of="crank_torque"), "M_max", "N*m", "Maximum driving torque"
torque.crank_torque_min = reduction("min", of="crank_torque"), "M_min", "N*m", "Maximum braking torque"
torque.crank_torque_mean = reduction("mean", of="crank_torque"), "M_mean", "N*m", "Mean torque"
torque.crank_torque_rms = reduction("rms", of="crank_torque"), "M_rms", "N*m", "Root mean square torque"
torque.power_mean = m.crank_torque_mean * m.crank_speed, "P_mean", "kW", "Mean power at the crank"
torque.power_peak = m.crank_torque_peak * m.crank_speed, "P_peak", "kW", "Peak power at the crank"
torque.torque_reversal = crossings(of="crank_torque"), "φ_r", "deg", "Crank angle at which the torque reverses (backlash)"

energy = Chapter("Energy balance",
    text="Without losses, one revolution of the crank takes the work of the technological moment; inertia and weight return all of theirs.")
energy.energy_turn = reduction("integral", of="lossless_torque", output=False), "E", "J", "Energy over a revolution without losses"
energy.technological_work = (2 * m.cutting_arc_fraction * m.cutting_moment * m.sector_ratio * m.swing_angle, "E_t", "J",
    "Work of the technological moment, two strokes")
energy.kinetic_energy_max = (m.moved_inertia * (m.velocity_max / m.cylinder_radius) ** 2 / 2, "E_k", "J",
    "Maximum kinetic energy of the cylinder and of the shafts that swing with it, without the unbalance")
energy.energy_residual = (self_test(m.energy_turn, m.technological_work, scale=np.maximum(m.technological_work, m.kinetic_energy_max),
    within=CURVE_ROUNDING, check="energy_balance", title="Energy balance over a revolution", output=True), "r_E", "1",
    "Relative difference between energy and work", "conservation of energy")

clearance = Chapter("Window of the carriages",
    text="The carriages pass while the lower edge of the turned flat leaves their clearance over the die: R(1 − cos(α − θ)) ≥ c_r on both sides of "
        "the lowest position of the flat.", needs=("carriage_clearance", "segment_height"), absent="not calculated: {missing} not given")
clearance.require("clearance_below_flat", m.carriage_clearance <= m.segment_height, key="carriage_clearance",
    message="is {carriage_clearance}, but the flat leaves no more than the segment's height {segment_height}")
clearance.clear_rotation = clear_rotation.of(half_angle=m.flat_half_angle), "θ_c", "deg", "Rotation of the cylinder up to which the clearance remains"
clearance.clear_swing_outer = inner(m.clear_rotation / m.sector_ratio), "δ_c", "deg", "Rocker angle there"
clearance.clear_direction_outer = inner(m.outer_direction + m.clear_swing_outer), "β_c", "deg", "Direction of the rocker there"
clearance.clear_distance_outer = (inner(four_bar.joint_distance.of(rocker_direction=m.clear_direction_outer)), "q_3", "1",
    "Distance of the rocker's joint from the crank's pivot there, in crank lengths")
clearance.clear_return_outer = (inner(four_bar.crank_angle_return.of(rocker_direction=m.clear_direction_outer,
    joint_distance=m.clear_distance_outer), exists=flat_leaves), "φ_c0", "deg", "Crank angle there on the return stroke")
clearance.clearance_outer_start = (value(m.clear_return_outer - 2 * pi, exists=flat_leaves), "φ_c1", "deg",
    "Window at the outer dead centre opens (one revolution earlier)")
clearance.clearance_outer_end = (value(four_bar.crank_angle_forward.of(rocker_direction=m.clear_direction_outer,
    joint_distance=m.clear_distance_outer), exists=flat_leaves), "φ_c2", "deg", "Window at the outer dead centre closes")
clearance.clearance_outer_time = (value((m.clearance_outer_end - m.clearance_outer_start) / m.crank_speed, exists=flat_leaves), "t_c1", "ms",
    "Time of the window at the outer dead centre")
clearance.clear_swing_inner = inner((2 * pi - m.clear_rotation) / m.sector_ratio), "δ_c′", "deg", "Rocker angle from which the flat is clear again"
clearance.clear_direction_inner = inner(m.outer_direction + m.clear_swing_inner), "β_c′", "deg", "Direction of the rocker there"
clearance.clear_distance_inner = (inner(four_bar.joint_distance.of(rocker_direction=m.clear_direction_inner)), "q_4", "1",
    "Distance of the rocker's joint from the crank's pivot there, in crank lengths")
clearance.clearance_inner_start = (value(four_bar.crank_angle_forward.of(rocker_direction=m.clear_direction_inner,
    joint_distance=m.clear_distance_inner), exists=flat_arrives), "φ_c3", "deg", "Window at the inner dead centre opens")
clearance.clearance_inner_end = (value(four_bar.crank_angle_return.of(rocker_direction=m.clear_direction_inner,
    joint_distance=m.clear_distance_inner), exists=flat_arrives), "φ_c4", "deg", "Window at the inner dead centre closes")
clearance.clearance_inner_time = (value((m.clearance_inner_end - m.clearance_inner_start) / m.crank_speed, exists=flat_arrives), "t_c2", "ms",
    "Time of the window at the inner dead centre")
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
teeth.sector_radius = length_of.of(ratio=m.sector_ratio, crank_length=m.pinion_radius), "r_s", "mm", "Pitch radius of the sector"
teeth.tooth_force = m.pinion_moment / m.pinion_radius, "F_t", "kN", "Tangential force between the teeth"
teeth.tooth_normal_force = m.tooth_force / np.cos(m.pressure_angle), "F_n", "kN", "Force normal to the flanks"
teeth.tooth_force_max = reduction("abs_max", of="tooth_force"), "F_t,max", "kN", "Maximum tangential force"
teeth.tooth_normal_force_max = reduction("abs_max", of="tooth_normal_force"), "F_n,max", "kN", "Maximum force normal to the flanks"
teeth.tooth_radial_force_max = m.tooth_force_max * np.tan(m.pressure_angle), "F_r,max", "kN", "Maximum force separating sector and pinion"

joints = Chapter("Forces in the joints",
    text="The links are massless: the coupler carries a single axial force, which acts on each of its joints and on the crank's bearing. It follows "
        "from the rocker's torque, so it remains finite at the dead centres.", needs=("crank_length",),
    absent="not calculated: crank_length is not given")
joints.frame_length = length_of.of(ratio=m.frame_ratio), "d", "mm", "Length of the frame"
joints.coupler_length = length_of.of(ratio=m.coupler_ratio), "b_c", "mm", "Length of the coupler"
joints.rocker_length = length_of.of(ratio=m.rocker_ratio), "c", "mm", "Length of the rocker"
joints.efficiency_behind_rocker = inner(efficiency_behind_rocker), "η_s", "1", "Efficiency from the rocker to the cylinder"
joints.lossless_rocker_torque = inner(m.sector_ratio * m.total_moment), "M_20", "N*m", "Torque at the rocker without losses"
joints.rocker_torque = (choice(case(m.lossless_rocker_torque / m.efficiency_behind_rocker,
    "power flows from the rocker to the cylinder: divided by η_s", m.lossless_torque >= 0),
    case(m.lossless_rocker_torque * m.efficiency_behind_rocker, "the cylinder drives the rocker: multiplied by η_s")), "M_2", "N*m",
    "Torque at the rocker")
joints.coupler_force = m.rocker_torque / (m.rocker_length * np.sin(m.transmission_angle)), "F_c", "kN", "Force along the coupler, tension positive"
joints.crank_bearing_force_x = m.coupler_force * np.cos(m.coupler_direction), "F_1x", "kN", "Force on the crank's bearing along the frame line"
joints.crank_bearing_force_y = m.coupler_force * np.sin(m.coupler_direction), "F_1y", "kN", "Force on the crank's bearing normal to the frame line"
joints.coupler_tension_max = reduction("max", of="coupler_force"), "F_c,max", "kN", "Maximum tension of the coupler"
joints.coupler_tension_min = reduction("min", of="coupler_force"), "F_c,min", "kN", "Maximum compression of the coupler (negative)"
joints.joint_force_max = reduction("abs_max", of="coupler_force"), "F_j", "kN", "Maximum force in the coupler's joints and the crank's bearing"
joints.rocker_bearing_force = (value(abs(m.coupler_force) + abs(m.tooth_normal_force), needs=("pinion_radius",)), "F_3", "kN",
    "Force on the rocker's bearing: coupler and teeth together, for any position of the pinion (upper bound)")
joints.rocker_bearing_force_max = (reduction("max", of="rocker_bearing_force", needs=("pinion_radius",)), "F_3,max", "kN",
    "Maximum force on the rocker's bearing (upper bound)")
