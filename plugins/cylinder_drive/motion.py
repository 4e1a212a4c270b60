"""Formulas of the drive's motion and cutting; those of the linkage are in ``mechanics.four_bar``."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import as_angle, formula


@formula
def one_and_longest(frame_ratio: Any, coupler_ratio: Any, rocker_ratio: Any) -> Any:
    """Shortest and longest link together, in crank lengths."""
    return 1 + np.maximum(frame_ratio, np.maximum(coupler_ratio, rocker_ratio))


@formula
def other_two(frame_ratio: Any, coupler_ratio: Any, rocker_ratio: Any) -> Any:
    """The other two links together, in crank lengths."""
    return frame_ratio + coupler_ratio + rocker_ratio - np.maximum(frame_ratio, np.maximum(coupler_ratio, rocker_ratio))


@formula
def time_ratio(dead_center_outer: Any, dead_center_inner: Any) -> Any:
    """Time of the forward to that of the return stroke."""
    return (dead_center_inner - dead_center_outer) / (2 * np.pi - (dead_center_inner - dead_center_outer))


@formula
def folded_angle(transmission_angle_min: Any, transmission_angle_max: Any) -> Any:
    """Worst transmission angle, an obtuse one counted by its supplement."""
    return np.minimum(transmission_angle_min, np.pi - transmission_angle_max)


@formula
def ratio_for_one_turn(swing_angle: Any) -> Any:
    """Ratio with which the full swing turns the cylinder once."""
    return 2 * np.pi / swing_angle


@formula
def rolled(angle: Any, sector_ratio: Any, cylinder_radius: Any) -> Any:
    """Rolled length, speed or acceleration of the cylinder from the rocker's angle or its derivative."""
    return angle * sector_ratio * cylinder_radius


@formula
def rolled_rate(ratio: Any, crank_speed: Any, sector_ratio: Any, cylinder_radius: Any) -> Any:
    """Speed of the cylinder's axis."""
    return ratio * crank_speed * sector_ratio * cylinder_radius


@formula
def rolled_acceleration(ratio: Any, crank_speed: Any, sector_ratio: Any, cylinder_radius: Any) -> Any:
    """Acceleration of the cylinder's axis."""
    return ratio * crank_speed**2 * sector_ratio * cylinder_radius


@formula
def cylinder_rate(ratio: Any, crank_speed: Any, sector_ratio: Any) -> Any:
    """Angular speed of the cylinder."""
    return ratio * crank_speed * sector_ratio


@formula
def cylinder_acceleration(ratio: Any, crank_speed: Any, sector_ratio: Any) -> Any:
    """Angular acceleration of the cylinder."""
    return as_angle(ratio * crank_speed**2) * sector_ratio


@formula
def stroke_error(sector_ratio: Any, swing_angle: Any) -> Any:
    """How far the cylinder's rotation over the stroke is off a full turn."""
    return abs(sector_ratio * swing_angle - 2 * np.pi)


@formula
def cutting_length(cylinder_radius: Any, material_thickness: Any) -> Any:
    """Length over which the cylinder cuts at one time, along its motion."""
    return np.sqrt(2 * cylinder_radius * material_thickness - material_thickness**2)


@formula
def rolling_arm(rolling_coefficient: Any, cutting_length: Any) -> Any:
    """Arm of the rolling resistance."""
    return rolling_coefficient * cutting_length


@formula
def cutting_force(cutting_force_per_length: Any, ejection_force_per_length: Any, cylinder_length: Any) -> Any:
    """Force of cutting and ejection."""
    return (cutting_force_per_length + ejection_force_per_length) * cylinder_length


@formula
def cut_begins(swing_angle: Any, cutting_arc_fraction: Any) -> Any:
    """Rocker angle at one end of the cutting part of the stroke."""
    return swing_angle * (1 - cutting_arc_fraction) / 2


@formula
def cut_ends(swing_angle: Any, cutting_arc_fraction: Any) -> Any:
    """Rocker angle at the other end of the cutting part of the stroke."""
    return swing_angle * (1 + cutting_arc_fraction) / 2


@formula
def cuts_always(cutting_arc_fraction: Any) -> Any:
    """Whether the board is cut over the whole stroke."""
    return cutting_arc_fraction >= 1


@formula
def turn_later(angle: Any) -> Any:
    """The same crank angle a turn later."""
    return angle + 2 * np.pi


@formula
def is_cutting(displacement: Any, stroke: Any, cutting_arc_fraction: Any) -> Any:
    """Whether the cylinder is on the cutting part of its stroke."""
    return abs(displacement - stroke / 2) <= cutting_arc_fraction * stroke / 2


@formula
def direction(rate: Any) -> Any:
    """Direction of motion, +1 forward and −1 back."""
    return np.sign(rate)


@formula
def rotation(rocker_angle: Any, sector_ratio: Any) -> Any:
    """Rotation of the cylinder."""
    return rocker_angle * sector_ratio
