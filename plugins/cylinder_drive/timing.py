"""Chapters on what the cylinder does when: contact with the board, standstill at the ends, and the phases of a turn of the crank."""

from __future__ import annotations

from diecut_report.api import Bound, Chapter, Steps, bind, case
from diecut_report.mechanics import circular_segment, common, four_bar
from diecut_report.plugins.cylinder_drive import loads

# fmt: off


def _at_swing(name: str, mark: str, place: str, swing: str) -> Steps:
    """Direction of the rocker at an angle of its swing, and the distance of its joint from the crank's pivot there."""
    steps = Steps()
    steps.value(f"{name}_direction", f"β_{mark}", "deg", f"Direction of the rocker where {place}",
        bind(common.sum_of, first="outer_direction", second=swing), output=False)
    steps.value(f"{name}_distance", f"q_{mark}", "1", f"Distance of the rocker's joint from the crank's pivot where {place}, in crank lengths",
        bind(four_bar.joint_distance, rocker_direction=f"{name}_direction"), output=False)
    return steps


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
    bind(loads.clear_rotation, half_angle="flat_half_angle", carriage_clearance="material_thickness"))
contact.value("contact_swing", "δ_z", "deg", "Rocker angle where contact with the board begins",
    lambda contact_rotation, sector_ratio: contact_rotation / sector_ratio, output=False)
contact.value("contact_swing_far", "δ_z′", "deg", "Rocker angle where contact with the board ends, or the whole swing",
    lambda contact_rotation, sector_ratio, swing_angle: loads.far_swing(contact_rotation, sector_ratio, swing_angle), output=False)
contact.add(_at_swing("contact", "z", "contact with the board begins", "contact_swing"))
contact.add(_at_swing("contact_far", "z′", "contact with the board ends", "contact_swing_far"))
INNER_END = case(bind(common.same, quantity="dead_center_inner"), "the cylinder touches the board up to the inner end of the stroke",
                 lambda contact_swing_far, swing_angle: contact_swing_far >= swing_angle)
contact.value("contact_begin_forward", "φ_z1", "deg", "Crank angle at which the contact begins, forward stroke", _forward("contact"),
    exists=loads.touches_board)
contact.choice("contact_end_forward", "φ_z2", "deg", "Crank angle at which the contact ends, forward stroke", INNER_END,
    case(_forward("contact_far"), "the flat leaves the board before the inner end"), exists=loads.touches_board)
contact.choice("contact_begin_return", "φ_z3", "deg", "Crank angle at which the contact begins, return stroke", INNER_END,
    case(_return("contact_far"), "the flat leaves the board before the inner end"), exists=loads.touches_board)
contact.value("contact_end_return", "φ_z4", "deg", "Crank angle at which the contact ends, return stroke (counted on)", _return("contact"),
    exists=loads.touches_board)
contact.phase("contact", "working", "Contact of cylinder and board", "crank_angle", ("contact_begin_forward", "contact_end_forward"),
    ("contact_begin_return", "contact_end_return"))

phases = Chapter("Phases of a turn of the crank",
    text="A crank-rocker has no true dwell: the cylinder counts as standing still while it is within θ_s of an end of its rotation.")
phases.value("standstill_swing", "δ_s", "deg", "Rocker angle that counts as standstill",
    lambda standstill_rotation, sector_ratio: standstill_rotation / sector_ratio, output=False)
phases.value("standstill_swing_far", "δ_s′", "deg", "Rocker angle at which the standstill at the inner end begins",
    lambda swing_angle, standstill_swing: swing_angle - standstill_swing, output=False)
phases.add(_at_swing("standstill", "s", "the standstill at the outer end ends", "standstill_swing"))
phases.add(_at_swing("standstill_far", "s′", "the standstill at the inner end begins", "standstill_swing_far"))
phases.value("standstill_outer_start", "φ_s1", "deg", "Crank angle at which the standstill at the outer end begins (counted on)",
    _return("standstill"), exists=loads.moves_at_all)
phases.value("standstill_outer_end", "φ_s2", "deg", "Crank angle at which the standstill at the outer end ends", _forward("standstill"),
    exists=loads.moves_at_all)
phases.value("standstill_inner_start", "φ_s3", "deg", "Crank angle at which the standstill at the inner end begins", _forward("standstill_far"),
    exists=loads.moves_at_all)
phases.value("standstill_inner_end", "φ_s4", "deg", "Crank angle at which the standstill at the inner end ends", _return("standstill_far"),
    exists=loads.moves_at_all)
phases.phase("forward", "moving", "Forward stroke", "crank_angle", ("dead_center_outer", "dead_center_inner"))
phases.phase("return", "moving", "Return stroke", "crank_angle", ("dead_center_inner", "dead_center_outer"))
phases.phase("cutting_forward", "working", "Cutting on the forward stroke", "crank_angle", ("cut_begin_forward", "cut_end_forward"))
phases.phase("cutting_return", "working", "Cutting on the return stroke", "crank_angle", ("cut_begin_return", "cut_end_return"))
phases.phase("cutting", "working", "Cutting", "crank_angle", union=("cutting_forward", "cutting_return"))
phases.phase("standstill", "rest", "Standstill at the ends of the stroke", "crank_angle", ("standstill_outer_start", "standstill_outer_end"),
    ("standstill_inner_start", "standstill_inner_end"))
