"""Chapters on the linkage: dead centres, sector ratio, cutting, motion over a turn of the crank."""

from __future__ import annotations

import numpy as np

from diecut_report.api import (
    Abscissa,
    Bound,
    Breakpoints,
    Case,
    Chapter,
    Choice,
    Formula,
    Reduction,
    Require,
    Value,
    bind,
)
from diecut_report.mechanics import common, four_bar
from diecut_report.plugins.cylinder_drive import motion


def _cutting_edge(name: str, symbol: str, description: str, dead_center: Bound, inverse: Formula, edge: str) -> Choice:
    """A crank angle where cutting begins or ends: a dead centre where the whole stroke cuts.

    There the general formula is left out, for its root turns the last digit of a cosine into 1e-8 rad beside the dead centre.
    """
    inside = bind(inverse, rocker_direction=f"cut_{edge}_direction", joint_distance=f"cut_{edge}_distance")
    cases = (Case(dead_center, "the whole stroke cuts, from one dead centre to the other", motion.cuts_always),
             Case(inside, "only the middle of the stroke cuts"))  # fmt: skip
    return Choice(id=name, symbol=symbol, unit="deg", description=description, cases=cases)


LINKAGE = Chapter(
    "Linkage and its dead centres",
    text="Lengths are relative to the crank. The crank angle is counted from the frame line O₁O₃, counter-clockwise.",
    steps=(
        Value(id="grashof_demand", symbol="Σ_1", description="Shortest and longest link together, in crank lengths", output=False,
              formula=motion.one_and_longest),
        Value(id="grashof_limit", symbol="Σ_2", description="The other two links together, in crank lengths", output=False,
              formula=motion.other_two),
        Require(id="crank_rocker", condition=four_bar.is_crank_rocker, key="rocker_ratio",
                message="gives no crank-rocker: with frame_ratio = {frame_ratio}, coupler_ratio = {coupler_ratio} and rocker_ratio = "
                "{rocker_ratio} the crank (1) must be the shortest link, and it and the longest one ({grashof_demand} together) "
                "shorter than the other two together ({grashof_limit}) (Grashof); change the ratios so that both hold"),
        Value(id="outer_direction", symbol="γ_3", unit="deg", description="Direction of the rocker at its outer dead centre",
              source="000 eq. 5", output=False, formula=four_bar.outer_rocker_direction),
        Value(id="swing_angle", symbol="δ_max", unit="deg", description="Swing of the rocker", source="000 eq. 5, both dead centres",
              digits=6, formula=four_bar.swing_angle),
        Value(id="dead_center_outer", symbol="φ_out", unit="deg", description="Crank angle of the outer dead centre",
              source="closed form", digits=6, formula=four_bar.outer_dead_center),
        Value(id="dead_center_inner", symbol="φ_in", unit="deg", description="Crank angle of the inner dead centre",
              source="closed form", digits=6, formula=four_bar.inner_dead_center),
        Value(id="time_ratio", symbol="k_t", description="Time of the forward to that of the return stroke",
              formula=motion.time_ratio),
        Value(id="transmission_angle_min", symbol="μ_1", unit="deg", description="Least transmission angle, at φ = 0",
              source="000 eq. 4", formula=four_bar.least_transmission_angle),
        Value(id="transmission_angle_max", symbol="μ_2", unit="deg", description="Greatest transmission angle, at φ = 180°",
              source="000 eq. 4", formula=four_bar.greatest_transmission_angle),
        Value(id="transmission_angle_worst", symbol="μ_w", unit="deg",
              description="Worst transmission angle, an obtuse one counted by its supplement", output=False, formula=motion.folded_angle),
    ),
)  # fmt: skip

STROKE = Chapter(
    "Sector ratio and stroke",
    steps=(
        Value(id="sector_ratio", symbol="u", description="Ratio of sector to pinion: as given", source="input", needs=("sector_ratio",),
              digits=6, formula=bind(common.same, quantity="inputs.sector_ratio")),
        Value(id="sector_ratio", symbol="u", description="Ratio of sector to pinion: the full swing turns the cylinder once",
              lacks=("sector_ratio",), digits=6, formula=motion.ratio_for_one_turn),
        Value(id="stroke", symbol="S_max", unit="mm", description="Stroke of the cylinder's axis", source="000 eq. 8",
              formula=bind(motion.rolled, angle="swing_angle")),
        Value(id="stroke_error", symbol="Δθ", unit="deg", description="Rotation over the stroke off a full turn", output=False,
              formula=motion.stroke_error),
    ),
)  # fmt: skip

CUTTING = Chapter(
    "Cutting",
    steps=(
        Require(id="board_below_radius", condition=bind(common.is_below, smaller="material_thickness", greater="cylinder_radius"),
                key="material_thickness",
                message="is {material_thickness}, but the board must be thinner than the cylinder's radius {cylinder_radius}"),
        Value(id="cutting_length", symbol="b", unit="mm", description="Cutting length along the motion", source="000, after eq. 19",
              formula=motion.cutting_length),
        Value(id="rolling_arm", symbol="k", unit="mm", description="Arm of the rolling resistance", source="000, after eq. 19",
              formula=motion.rolling_arm),
        Value(id="cutting_force", symbol="P_m", unit="kN", description="Force of cutting and ejection", source="000 eq. 18",
              formula=motion.cutting_force),
        Value(id="cutting_moment", symbol="M_m", unit="N*m", description="Moment of the technological load", source="000 eq. 19",
              formula=bind(common.moment, force="cutting_force", arm="rolling_arm")),
        Value(id="cut_begin_swing", symbol="δ_1", unit="deg", description="Rocker angle where cutting begins (forward)", output=False,
              formula=motion.cut_begins),
        Value(id="cut_end_swing", symbol="δ_2", unit="deg", description="Rocker angle where cutting ends (forward)", output=False,
              formula=motion.cut_ends),
        Value(id="cut_begin_direction", symbol="β_1", unit="deg", description="Direction of the rocker there", output=False,
              formula=bind(common.sum_of, first="outer_direction", second="cut_begin_swing")),
        Value(id="cut_begin_distance", symbol="q_1", description="Distance of the rocker's joint from the crank's pivot there, in crank lengths",
              output=False, formula=bind(four_bar.joint_distance, rocker_direction="cut_begin_direction")),
        Value(id="cut_end_direction", symbol="β_2", unit="deg", description="Direction of the rocker there", output=False,
              formula=bind(common.sum_of, first="outer_direction", second="cut_end_swing")),
        Value(id="cut_end_distance", symbol="q_2", description="Distance of the rocker's joint from the crank's pivot there, in crank lengths",
              output=False, formula=bind(four_bar.joint_distance, rocker_direction="cut_end_direction")),
        _cutting_edge("cut_begin_forward", "φ_1", "Crank angle where cutting begins, forward stroke",
                      bind(common.same, quantity="dead_center_outer"), four_bar.crank_angle_forward, "begin"),
        _cutting_edge("cut_end_forward", "φ_2", "Crank angle where cutting ends, forward stroke",
                      bind(common.same, quantity="dead_center_inner"), four_bar.crank_angle_forward, "end"),
        _cutting_edge("cut_begin_return", "φ_3", "Crank angle where cutting begins, return stroke",
                      bind(common.same, quantity="dead_center_inner"), four_bar.crank_angle_return, "end"),
        _cutting_edge("cut_end_return", "φ_4", "Crank angle where cutting ends, return stroke (counted on)",
                      bind(motion.turn_later, angle="dead_center_outer"), four_bar.crank_angle_return, "begin"),
    ),
)  # fmt: skip

KINEMATICS = Chapter(
    "Kinematics over a turn of the crank",
    steps=(
        Abscissa(id="crank_angle", symbol="φ", unit="deg", description="Crank angle from the frame line", period=2 * np.pi, intervals=32,
                 shown_at="crank_torque_peak_at"),
        Breakpoints(id="strokes", abscissa="crank_angle", places=(
            "dead_center_outer", "dead_center_inner", "cut_begin_forward", "cut_end_forward", "cut_begin_return", "cut_end_return")),
        Value(id="diagonal", symbol="D", description="Distance of the crank pin from the rocker's pivot, in crank lengths",
              source="000 eq. 3, corrected", output=False, formula=four_bar.diagonal),
        Value(id="diagonal_direction", symbol="γ_1", unit="deg", description="Direction from the rocker's pivot to the crank pin",
              source="000 eq. 2, over the full turn", output=False, formula=four_bar.diagonal_direction),
        Value(id="pin_angle", symbol="γ_2", unit="deg", description="Angle at the crank pin between diagonal and coupler",
              source="000 eq. 3, corrected", output=False, formula=four_bar.pin_angle),
        Value(id="transmission_angle", symbol="μ", unit="deg", description="Transmission angle", source="000 eq. 4, corrected",
              formula=four_bar.transmission_angle),
        Value(id="coupler_direction", symbol="γ", unit="deg", description="Direction of the coupler", source="000, after eq. 6",
              output=False, formula=four_bar.coupler_direction),
        Value(id="rocker_direction", symbol="β", unit="deg", description="Direction of the rocker", source="000, after eq. 6",
              output=False, formula=four_bar.rocker_direction),
        Value(id="rocker_angle", symbol="δ", unit="deg", description="Rocker angle from its outer dead centre", source="000 eq. 1",
              formula=bind(common.difference, greater="rocker_direction", smaller="outer_direction")),
        Value(id="rocker_speed_ratio", symbol="ω_3i", description="Angular speed of the rocker to the crank's", source="000 eq. 6",
              output=False, formula=four_bar.rocker_speed_ratio),
        Value(id="coupler_speed_ratio", symbol="ω_2i", description="Angular speed of the coupler to the crank's",
              source="000, after eq. 7", output=False, formula=four_bar.coupler_speed_ratio),
        Value(id="rocker_acceleration_ratio", symbol="ε_3i",
              description="Angular acceleration of the rocker to the crank's speed squared", source="000 eq. 7", output=False,
              formula=four_bar.rocker_acceleration_ratio),
        Value(id="displacement", symbol="S", unit="mm", description="Displacement of the cylinder", source="000 eq. 8",
              formula=bind(motion.rolled, angle="rocker_angle")),
        Value(id="velocity", symbol="V", unit="m/s", description="Velocity of the cylinder", source="000 eq. 9",
              formula=bind(motion.rolled_rate, ratio="rocker_speed_ratio")),
        Value(id="acceleration", symbol="W", unit="m/s**2", description="Acceleration of the cylinder", source="000 eq. 10",
              formula=bind(motion.rolled_acceleration, ratio="rocker_acceleration_ratio")),
        Value(id="cylinder_rotation", symbol="θ", unit="deg", description="Rotation of the cylinder", source="000 eq. 8", output=False,
              formula=bind(motion.rotation)),
        Value(id="cylinder_speed", symbol="ω_c", unit="rad/s", description="Angular speed of the cylinder", source="000, after eq. 12",
              output=False, formula=bind(motion.cylinder_rate, ratio="rocker_speed_ratio")),
        Value(id="cylinder_acceleration", symbol="ε_c", unit="rad/s**2", description="Angular acceleration of the cylinder",
              source="000, after eq. 12", output=False, formula=bind(motion.cylinder_acceleration, ratio="rocker_acceleration_ratio")),
        Reduction(id="velocity_max", symbol="V_max", unit="m/s", description="Greatest speed of the cylinder", of="velocity",
                  operation="abs_max"),
        Reduction(id="acceleration_max", symbol="W_max", unit="m/s**2", description="Greatest acceleration of the cylinder",
                  of="acceleration", operation="abs_max"),
    ),
)  # fmt: skip

TECHNOLOGICAL = (
    Choice(id="technological_moment", symbol="M_t", unit="N*m", description="Moment of the technological load at this crank angle",
           output=False, per_piece=True,
           cases=(Case(bind(common.same, quantity="cutting_moment"), "the cylinder is on the cutting part of its stroke", motion.is_cutting),
                  Case(bind(common.zero), "the flat is over the die: nothing is cut"))),
    Value(id="direction", symbol="s", description="Direction of motion (+1 forward, −1 back)", output=False, per_piece=True,
          formula=bind(motion.direction, rate="cylinder_speed")),
)  # fmt: skip
