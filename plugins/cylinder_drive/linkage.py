"""Chapters on the linkage: dead centres, sector ratio, cutting, motion over a turn of the crank."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Bound, Chapter, Formula, Steps, as_angle, bind, case
from diecut_report.mechanics import common, four_bar

# fmt: off


def _cutting_edge(name: str, symbol: str, description: str, dead_center: Bound, inverse: Formula, edge: str) -> Steps:
    """A crank angle where cutting begins or ends: a dead centre where the whole stroke cuts.

    There the general formula is left out, for its root turns the last digit of a cosine into 1e-8 rad beside the dead centre.
    """
    inside = bind(inverse, rocker_direction=f"cut_{edge}_direction", joint_distance=f"cut_{edge}_distance")
    cases = (case(dead_center, "the whole stroke cuts, from one dead centre to the other", lambda cutting_arc_fraction: cutting_arc_fraction >= 1),
             case(inside, "only the middle of the stroke cuts"))
    steps = Steps()
    steps.choice(name, symbol, "deg", description, *cases)
    return steps


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
    lambda dead_center_outer, dead_center_inner: (dead_center_inner - dead_center_outer) / (2 * np.pi - (dead_center_inner - dead_center_outer)))
linkage.value("transmission_angle_min", "μ_1", "deg", "Minimum transmission angle, at φ = 0", four_bar.least_transmission_angle, source="000 eq. 4")
linkage.value("transmission_angle_max", "μ_2", "deg", "Maximum transmission angle, at φ = 180°", four_bar.greatest_transmission_angle,
    source="000 eq. 4")
linkage.value("transmission_angle_worst", "μ_w", "deg", "Worst transmission angle; for an obtuse angle its supplement",
    lambda transmission_angle_min, transmission_angle_max: np.minimum(transmission_angle_min, np.pi - transmission_angle_max), output=False)

stroke = Chapter("Sector ratio and stroke")
stroke.value("sector_ratio", "u", "1", "Ratio of sector to pinion: as given",
    bind(lambda sector_ratio: sector_ratio, sector_ratio="inputs.sector_ratio"), source="input", needs=("sector_ratio",), digits=6)
stroke.value("sector_ratio", "u", "1", "Ratio of sector to pinion: the full swing turns the cylinder by one revolution",
    lambda swing_angle: 2 * np.pi / swing_angle, lacks=("sector_ratio",), digits=6)
stroke.value("stroke", "S_max", "mm", "Stroke of the cylinder's axis",
    lambda swing_angle, sector_ratio, cylinder_radius: swing_angle * sector_ratio * cylinder_radius, source="000 eq. 8")
stroke.value("stroke_error", "Δθ", "deg", "Deviation of the rotation over the stroke from one revolution",
    lambda sector_ratio, swing_angle: abs(sector_ratio * swing_angle - 2 * np.pi), output=False)

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
cutting.add(_cutting_edge("cut_begin_forward", "φ_1", "Crank angle where cutting begins, forward stroke",
        bind(common.same, quantity="dead_center_outer"), four_bar.crank_angle_forward, "begin"))
cutting.add(_cutting_edge("cut_end_forward", "φ_2", "Crank angle where cutting ends, forward stroke", bind(common.same, quantity="dead_center_inner"),
        four_bar.crank_angle_forward, "end"))
cutting.add(_cutting_edge("cut_begin_return", "φ_3", "Crank angle where cutting begins, return stroke",
        bind(common.same, quantity="dead_center_inner"), four_bar.crank_angle_return, "end"))
cutting.add(_cutting_edge("cut_end_return", "φ_4", "Crank angle where cutting ends, return stroke (counted on)",
        bind(lambda angle: angle + 2 * np.pi, angle="dead_center_outer"), four_bar.crank_angle_return, "begin"))

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
