"""The calculation of the impression cylinder's drive: linkage and motion, the times of a cycle, forces and torque."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import GRAVITY, Bound, Chapter, Formula, Steps, arccos, as_angle, bind, case, formula, pi
from diecut_report.mechanics import circular_segment, common, four_bar

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


def _cutting_edge(chapter: Steps, name: str, symbol: str, description: str, dead_center: Bound, inverse: Formula, edge: str) -> None:
    """A crank angle where cutting begins or ends: a dead centre where the whole stroke cuts.

    There the general formula is left out, for its root turns the last digit of a cosine into 1e-8 rad beside the dead centre.
    """
    inside = bind(inverse, rocker_direction=f"cut_{edge}_direction", joint_distance=f"cut_{edge}_distance")
    cases = (case(dead_center, "the whole stroke cuts, from one dead centre to the other", lambda cutting_arc_fraction: cutting_arc_fraction >= 1),
             case(inside, "only the middle of the stroke cuts"))
    chapter.choice(name, symbol, "deg", description, *cases)


linkage = Chapter("Linkage and its dead centres",
    text="Lengths are relative to the crank. The crank angle is counted from the frame line O₁O₃, counter-clockwise.")
linkage.value("grashof_demand", "Σ_1", "1", "Sum of the shortest and longest links, in crank lengths",
    lambda frame_ratio, coupler_ratio, rocker_ratio: 1 + np.maximum(frame_ratio, np.maximum(coupler_ratio, rocker_ratio)), output=False)
linkage.value("grashof_limit", "Σ_2", "1", "Sum of the other two links, in crank lengths", lambda frame_ratio, coupler_ratio, rocker_ratio:
        frame_ratio + coupler_ratio + rocker_ratio - np.maximum(frame_ratio, np.maximum(coupler_ratio, rocker_ratio)), output=False)
linkage.require("crank_rocker", four_bar.is_crank_rocker, key="rocker_ratio",
    message="gives no crank-rocker: with frame_ratio = {frame_ratio}, coupler_ratio = {coupler_ratio} and rocker_ratio = {rocker_ratio} the crank "
        "(1) must be the shortest link, and it and the longest one ({grashof_demand} together) shorter than the other two together "
        "({grashof_limit}) (Grashof); change the ratios so that both hold")
linkage.value("outer_direction", "γ_3", "deg", "Direction of the rocker at its outer dead centre", four_bar.outer_rocker_direction,
    source="000 eq. 5", output=False)
linkage.value("swing_angle", "δ_max", "deg", "Swing of the rocker", four_bar.swing_angle, source="000 eq. 5, both dead centres", digits=6)
linkage.value("dead_center_outer", "φ_out", "deg", "Crank angle of the outer dead centre", four_bar.outer_dead_center, source="closed form", digits=6)
linkage.value("dead_center_inner", "φ_in", "deg", "Crank angle of the inner dead centre", four_bar.inner_dead_center, source="closed form", digits=6)
linkage.value("time_ratio", "k_t", "1", "Time ratio of the forward to the return stroke",
    lambda dead_center_outer, dead_center_inner: (dead_center_inner - dead_center_outer) / (2 * pi - (dead_center_inner - dead_center_outer)))
linkage.value("transmission_angle_min", "μ_1", "deg", "Minimum transmission angle, at φ = 0", four_bar.least_transmission_angle, source="000 eq. 4")
linkage.value("transmission_angle_max", "μ_2", "deg", "Maximum transmission angle, at φ = 180°", four_bar.greatest_transmission_angle,
    source="000 eq. 4")
linkage.value("transmission_angle_worst", "μ_w", "deg", "Worst transmission angle; for an obtuse angle its supplement",
    lambda transmission_angle_min, transmission_angle_max: np.minimum(transmission_angle_min, pi - transmission_angle_max), output=False)

stroke = Chapter("Sector ratio and stroke")
stroke.value("sector_ratio", "u", "1", "Ratio of sector to pinion: as given",
    bind(lambda sector_ratio: sector_ratio, sector_ratio="inputs.sector_ratio"), source="input", needs=("sector_ratio",), digits=6)
stroke.value("sector_ratio", "u", "1", "Ratio of sector to pinion: the full swing turns the cylinder by one revolution",
    lambda swing_angle: 2 * pi / swing_angle, lacks=("sector_ratio",), digits=6)
stroke.value("stroke", "S_max", "mm", "Stroke of the cylinder's axis",
    lambda swing_angle, sector_ratio, cylinder_radius: swing_angle * sector_ratio * cylinder_radius, source="000 eq. 8")
stroke.value("stroke_error", "Δθ", "deg", "Deviation of the rotation over the stroke from one revolution",
    lambda sector_ratio, swing_angle: abs(sector_ratio * swing_angle - 2 * pi), output=False)

cutting = Chapter("Cutting")
cutting.require("board_below_radius", lambda material_thickness, cylinder_radius: material_thickness < cylinder_radius, key="material_thickness",
    message="is {material_thickness}, but the board must be thinner than the cylinder's radius {cylinder_radius}")
cutting.value("cutting_length", "b", "mm", "Cutting length along the motion",
    lambda cylinder_radius, material_thickness: np.sqrt(2 * cylinder_radius * material_thickness - material_thickness**2),
    source="000, after eq. 19")
cutting.value("rolling_arm", "k", "mm", "Arm of the rolling resistance",
    lambda rolling_coefficient, cutting_length: rolling_coefficient * cutting_length, source="000, after eq. 19")
cutting.value("cutting_force", "P_m", "kN", "Force of cutting and ejection",
    lambda cutting_force_per_length, ejection_force_per_length, cylinder_length:
        (cutting_force_per_length + ejection_force_per_length) * cylinder_length, source="000 eq. 18")
cutting.value("cutting_moment", "M_m", "N*m", "Moment of the technological load", lambda cutting_force, rolling_arm: cutting_force * rolling_arm,
    source="000 eq. 19")
cutting.value("cut_begin_swing", "δ_1", "deg", "Rocker angle where cutting begins (forward)",
    lambda swing_angle, cutting_arc_fraction: swing_angle * (1 - cutting_arc_fraction) / 2, output=False)
cutting.value("cut_end_swing", "δ_2", "deg", "Rocker angle where cutting ends (forward)",
    lambda swing_angle, cutting_arc_fraction: swing_angle * (1 + cutting_arc_fraction) / 2, output=False)
cutting.value("cut_begin_direction", "β_1", "deg", "Direction of the rocker there",
    lambda outer_direction, cut_begin_swing: outer_direction + cut_begin_swing, output=False)
cutting.value("cut_begin_distance", "q_1", "1", "Distance of the rocker's joint from the crank's pivot there, in crank lengths",
    bind(four_bar.joint_distance, rocker_direction="cut_begin_direction"), output=False)
cutting.value("cut_end_direction", "β_2", "deg", "Direction of the rocker there",
    lambda outer_direction, cut_end_swing: outer_direction + cut_end_swing, output=False)
cutting.value("cut_end_distance", "q_2", "1", "Distance of the rocker's joint from the crank's pivot there, in crank lengths",
    bind(four_bar.joint_distance, rocker_direction="cut_end_direction"), output=False)
_cutting_edge(cutting, "cut_begin_forward", "φ_1", "Crank angle where cutting begins, forward stroke",
        bind(common.same, quantity="dead_center_outer"), four_bar.crank_angle_forward, "begin")
_cutting_edge(cutting, "cut_end_forward", "φ_2", "Crank angle where cutting ends, forward stroke", bind(common.same, quantity="dead_center_inner"),
        four_bar.crank_angle_forward, "end")
_cutting_edge(cutting, "cut_begin_return", "φ_3", "Crank angle where cutting begins, return stroke",
        bind(common.same, quantity="dead_center_inner"), four_bar.crank_angle_return, "end")
_cutting_edge(cutting, "cut_end_return", "φ_4", "Crank angle where cutting ends, return stroke (counted on)",
        bind(lambda angle: angle + 2 * pi, angle="dead_center_outer"), four_bar.crank_angle_return, "begin")

kinematics = Chapter("Kinematics over a revolution of the crank")
kinematics.abscissa("crank_angle", "φ", "deg", "Crank angle from the frame line", 2 * np.pi, shown_at="crank_torque_peak_at", intervals=32,
    speed="crank_speed")
kinematics.breakpoints("strokes", "crank_angle", "dead_center_outer", "dead_center_inner", "cut_begin_forward", "cut_end_forward", "cut_begin_return",
    "cut_end_return")
kinematics.value("diagonal", "D", "1", "Distance of the crank pin from the rocker's pivot, in crank lengths", four_bar.diagonal, source="000 eq. 3",
    output=False)
kinematics.value("diagonal_direction", "γ_1", "deg", "Direction from the rocker's pivot to the crank pin", four_bar.diagonal_direction,
    source="000 eq. 2, over the full turn", output=False)
kinematics.value("pin_angle", "γ_2", "deg", "Angle at the crank pin between diagonal and coupler", four_bar.pin_angle, source="000 eq. 3, corrected",
    output=False)
kinematics.value("transmission_angle", "μ", "deg", "Transmission angle", four_bar.transmission_angle, source="000 eq. 4, corrected")
kinematics.value("coupler_direction", "γ", "deg", "Direction of the coupler", four_bar.coupler_direction, source="000, after eq. 6", output=False)
kinematics.value("rocker_direction", "β", "deg", "Direction of the rocker", four_bar.rocker_direction, source="000, after eq. 6", output=False)
kinematics.value("rocker_angle", "δ", "deg", "Rocker angle from its outer dead centre",
    lambda rocker_direction, outer_direction: rocker_direction - outer_direction, source="000 eq. 1")
kinematics.value("rocker_speed_ratio", "ω_3i", "1", "Ratio of the rocker's angular speed to the crank's", four_bar.rocker_speed_ratio,
    source="000 eq. 6", output=False)
kinematics.value("coupler_speed_ratio", "ω_2i", "1", "Ratio of the coupler's angular speed to the crank's", four_bar.coupler_speed_ratio,
    source="000, after eq. 7", output=False)
kinematics.value("rocker_acceleration_ratio", "ε_3i", "1", "Ratio of the rocker's angular acceleration to the square of the crank's speed",
    four_bar.rocker_acceleration_ratio, source="000 eq. 7", output=False)
kinematics.value("displacement", "S", "mm", "Displacement of the cylinder",
    lambda rocker_angle, sector_ratio, cylinder_radius: rocker_angle * sector_ratio * cylinder_radius, source="000 eq. 8")
kinematics.value("velocity", "V", "m/s", "Velocity of the cylinder",
    lambda rocker_speed_ratio, crank_speed, sector_ratio, cylinder_radius: rocker_speed_ratio * crank_speed * sector_ratio * cylinder_radius,
    source="000 eq. 9")
kinematics.value("acceleration", "a_c", "m/s**2", "Acceleration of the cylinder",
    lambda rocker_acceleration_ratio, crank_speed, sector_ratio, cylinder_radius:
        rocker_acceleration_ratio * crank_speed ** 2 * sector_ratio * cylinder_radius, source="000 eq. 10", source_symbol="W")
kinematics.value("cylinder_rotation", "θ", "deg", "Rotation of the cylinder", lambda rocker_angle, sector_ratio: rocker_angle * sector_ratio,
    source="000 eq. 8", output=False)
kinematics.value("cylinder_speed", "ω_c", "rad/s", "Angular speed of the cylinder",
    lambda rocker_speed_ratio, crank_speed, sector_ratio: rocker_speed_ratio * crank_speed * sector_ratio, source="000, after eq. 12", output=False)
kinematics.value("cylinder_acceleration", "ε_c", "rad/s**2", "Angular acceleration of the cylinder",
    lambda rocker_acceleration_ratio, crank_speed, sector_ratio: as_angle(rocker_acceleration_ratio * crank_speed ** 2) * sector_ratio,
    source="000, after eq. 12", output=False)
kinematics.reduction("velocity_max", "V_max", "m/s", "Maximum speed of the cylinder", "abs_max", of="velocity")
kinematics.reduction("acceleration_max", "a_c,max", "m/s**2", "Maximum acceleration of the cylinder", "abs_max", of="acceleration")

TECHNOLOGICAL = Steps()
TECHNOLOGICAL.choice("technological_moment", "M_t", "N*m", "Moment of the technological load at this crank angle",
    case(lambda cutting_moment: cutting_moment, "the cylinder is on the cutting part of its stroke",
        lambda displacement, stroke, cutting_arc_fraction: abs(displacement - stroke / 2) <= cutting_arc_fraction * stroke / 2),
    case(lambda: 0, "the flat is over the die: nothing is cut"), output=False, per_piece=True)
TECHNOLOGICAL.value("direction", "s", "1", "Direction of motion (+1 forward, −1 back)", lambda cylinder_speed: np.sign(cylinder_speed), output=False,
    per_piece=True)


def _at_swing(chapter: Steps, name: str, mark: str, place: str, swing: str) -> None:
    """Direction of the rocker at an angle of its swing, and the distance of its joint from the crank's pivot there."""
    chapter.value(f"{name}_direction", f"β_{mark}", "deg", f"Direction of the rocker where {place}",
        bind(common.sum_of, first="outer_direction", second=swing), output=False)
    chapter.value(f"{name}_distance", f"q_{mark}", "1", f"Distance of the rocker's joint from the crank's pivot where {place}, in crank lengths",
        bind(four_bar.joint_distance, rocker_direction=f"{name}_direction"), output=False)


def _forward(name: str) -> Bound:
    return bind(four_bar.crank_angle_forward, rocker_direction=f"{name}_direction", joint_distance=f"{name}_distance")


def _return(name: str) -> Bound:
    return bind(four_bar.crank_angle_return, rocker_direction=f"{name}_direction", joint_distance=f"{name}_distance")


contact = Chapter("Contact of the cylinder with the board",
    text="The cylinder touches the board while the corner of its flat is within the board's thickness: R(1 − cos(α − θ)) ≤ Δ at both corners.",
    needs=("segment_height",), absent="not calculated: segment_height is not given")
contact.require("flat_below_radius", lambda segment_height, cylinder_radius: segment_height < cylinder_radius, key="segment_height",
    message="is {segment_height}, but the segment must be lower than the radius {cylinder_radius}")
contact.value("flat_half_angle", "α", "deg", "Half the central angle of the flat",
    bind(circular_segment.half_angle, radius="cylinder_radius", height="segment_height"), output=False)
contact.value("contact_rotation", "θ_z", "deg", "Rotation of the cylinder where contact with the board begins",
    bind(clear_rotation, half_angle="flat_half_angle", carriage_clearance="material_thickness"))
contact.value("contact_swing", "δ_z", "deg", "Rocker angle where contact with the board begins",
    lambda contact_rotation, sector_ratio: contact_rotation / sector_ratio, output=False)
contact.value("contact_swing_far", "δ_z′", "deg", "Rocker angle where contact with the board ends, or the whole swing",
    lambda contact_rotation, sector_ratio, swing_angle: far_swing(contact_rotation, sector_ratio, swing_angle), output=False)
_at_swing(contact, "contact", "z", "contact with the board begins", "contact_swing")
_at_swing(contact, "contact_far", "z′", "contact with the board ends", "contact_swing_far")
INNER_END = case(bind(common.same, quantity="dead_center_inner"), "the cylinder touches the board up to the inner end of the stroke",
                 lambda contact_swing_far, swing_angle: contact_swing_far >= swing_angle)
contact.value("contact_begin_forward", "φ_z1", "deg", "Crank angle at which the contact begins, forward stroke", _forward("contact"),
    exists=touches_board)
contact.choice("contact_end_forward", "φ_z2", "deg", "Crank angle at which the contact ends, forward stroke", INNER_END,
    case(_forward("contact_far"), "the flat leaves the board before the inner end"), exists=touches_board)
contact.choice("contact_begin_return", "φ_z3", "deg", "Crank angle at which the contact begins, return stroke", INNER_END,
    case(_return("contact_far"), "the flat leaves the board before the inner end"), exists=touches_board)
contact.value("contact_end_return", "φ_z4", "deg", "Crank angle at which the contact ends, return stroke (counted on)", _return("contact"),
    exists=touches_board)
contact.phase("contact", "working", "Contact of cylinder and board", "crank_angle", ("contact_begin_forward", "contact_end_forward"),
    ("contact_begin_return", "contact_end_return"))

phases = Chapter("Phases of a turn of the crank",
    text="A crank-rocker has no true dwell: the cylinder counts as standing still while it is within θ_s of an end of its rotation.")
phases.value("standstill_swing", "δ_s", "deg", "Rocker angle that counts as standstill",
    lambda standstill_rotation, sector_ratio: standstill_rotation / sector_ratio, output=False)
phases.value("standstill_swing_far", "δ_s′", "deg", "Rocker angle at which the standstill at the inner end begins",
    lambda swing_angle, standstill_swing: swing_angle - standstill_swing, output=False)
_at_swing(phases, "standstill", "s", "the standstill at the outer end ends", "standstill_swing")
_at_swing(phases, "standstill_far", "s′", "the standstill at the inner end begins", "standstill_swing_far")
phases.value("standstill_outer_start", "φ_s1", "deg", "Crank angle at which the standstill at the outer end begins (counted on)",
    _return("standstill"), exists=moves_at_all)
phases.value("standstill_outer_end", "φ_s2", "deg", "Crank angle at which the standstill at the outer end ends", _forward("standstill"),
    exists=moves_at_all)
phases.value("standstill_inner_start", "φ_s3", "deg", "Crank angle at which the standstill at the inner end begins", _forward("standstill_far"),
    exists=moves_at_all)
phases.value("standstill_inner_end", "φ_s4", "deg", "Crank angle at which the standstill at the inner end ends", _return("standstill_far"),
    exists=moves_at_all)
phases.phase("forward", "moving", "Forward stroke", "crank_angle", ("dead_center_outer", "dead_center_inner"))
phases.phase("return", "moving", "Return stroke", "crank_angle", ("dead_center_inner", "dead_center_outer"))
phases.phase("cutting_forward", "working", "Cutting on the forward stroke", "crank_angle", ("cut_begin_forward", "cut_end_forward"))
phases.phase("cutting_return", "working", "Cutting on the return stroke", "crank_angle", ("cut_begin_return", "cut_end_return"))
phases.phase("cutting", "working", "Cutting", "crank_angle", union=("cutting_forward", "cutting_return"))
phases.phase("standstill", "rest", "Standstill at the ends of the stroke", "crank_angle", ("standstill_outer_start", "standstill_outer_end"),
    ("standstill_inner_start", "standstill_inner_end"))


SHAFTS = ("pinion_inertia", "rocker_inertia")

moments = Chapter("Moments on the cylinder", text="The flat is down at θ = 0; the technological moment always resists the motion.")
moments.value("reduced_inertia", "I_r", "kg*m**2", "Equivalent inertia of the rolling cylinder, translation included",
    lambda cylinder_inertia, cylinder_mass, cylinder_radius: cylinder_inertia + cylinder_mass * cylinder_radius**2,
    source="000 eq. 12")
moments.value("greatest_unbalance", "me_max", "kg*m", "Unbalance if the centre of mass were at the cylinder's surface",
    lambda cylinder_mass, cylinder_radius: cylinder_mass * cylinder_radius, output=False)
moments.value("inertia_moment", "M_in", "N*m", "Moment of inertia forces and unbalance", inertia_moment,
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
        efficiency_four_bar * efficiency_behind_rocker(efficiency_sector, efficiency_gear, efficiency_chain, efficiency_bearings),
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
    bind(clear_rotation, half_angle="flat_half_angle"))
clearance.value("clear_swing_outer", "δ_c", "deg", "Rocker angle there", lambda clear_rotation, sector_ratio: clear_rotation / sector_ratio,
    output=False)
clearance.value("clear_direction_outer", "β_c", "deg", "Direction of the rocker there",
    lambda outer_direction, clear_swing_outer: outer_direction + clear_swing_outer, output=False)
clearance.value("clear_distance_outer", "q_3", "1", "Distance of the rocker's joint from the crank's pivot there, in crank lengths",
    bind(four_bar.joint_distance, rocker_direction="clear_direction_outer"), output=False)
clearance.value("clear_return_outer", "φ_c0", "deg", "Crank angle there on the return stroke",
    bind(four_bar.crank_angle_return, rocker_direction="clear_direction_outer", joint_distance="clear_distance_outer"), output=False,
    exists=flat_leaves)
clearance.value("clearance_outer_start", "φ_c1", "deg", "Window at the outer dead centre opens (one revolution earlier)",
    lambda clear_return_outer: clear_return_outer - 2 * pi, exists=flat_leaves)
clearance.value("clearance_outer_end", "φ_c2", "deg", "Window at the outer dead centre closes",
    bind(four_bar.crank_angle_forward, rocker_direction="clear_direction_outer", joint_distance="clear_distance_outer"), exists=flat_leaves)
clearance.value("clearance_outer_time", "t_c1", "ms", "Time of the window at the outer dead centre",
    lambda clearance_outer_start, clearance_outer_end, crank_speed: (clearance_outer_end - clearance_outer_start) / crank_speed,
    exists=flat_leaves)
clearance.value("clear_swing_inner", "δ_c′", "deg", "Rocker angle from which the flat is clear again",
    lambda clear_rotation, sector_ratio: (2 * pi - clear_rotation) / sector_ratio, output=False)
clearance.value("clear_direction_inner", "β_c′", "deg", "Direction of the rocker there",
    lambda outer_direction, clear_swing_inner: outer_direction + clear_swing_inner, output=False)
clearance.value("clear_distance_inner", "q_4", "1", "Distance of the rocker's joint from the crank's pivot there, in crank lengths",
    bind(four_bar.joint_distance, rocker_direction="clear_direction_inner"), output=False)
clearance.value("clearance_inner_start", "φ_c3", "deg", "Window at the inner dead centre opens",
    bind(four_bar.crank_angle_forward, rocker_direction="clear_direction_inner", joint_distance="clear_distance_inner"), exists=flat_arrives)
clearance.value("clearance_inner_end", "φ_c4", "deg", "Window at the inner dead centre closes",
    bind(four_bar.crank_angle_return, rocker_direction="clear_direction_inner", joint_distance="clear_distance_inner"), exists=flat_arrives)
clearance.value("clearance_inner_time", "t_c2", "ms", "Time of the window at the inner dead centre",
    lambda clearance_inner_start, clearance_inner_end, crank_speed: (clearance_inner_end - clearance_inner_start) / crank_speed,
    exists=flat_arrives)
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
teeth.value("sector_radius", "r_s", "mm", "Pitch radius of the sector", bind(length_of, ratio="sector_ratio", crank_length="pinion_radius"))
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
joints.value("frame_length", "d", "mm", "Length of the frame", bind(length_of, ratio="frame_ratio"))
joints.value("coupler_length", "b_c", "mm", "Length of the coupler", bind(length_of, ratio="coupler_ratio"))
joints.value("rocker_length", "c", "mm", "Length of the rocker", bind(length_of, ratio="rocker_ratio"))
joints.value("efficiency_behind_rocker", "η_s", "1", "Efficiency from the rocker to the cylinder", efficiency_behind_rocker, output=False)
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
