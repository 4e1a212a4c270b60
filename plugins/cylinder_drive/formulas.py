"""Formulas of the impression cylinder's drive; those of the linkage are in ``mechanics.four_bar``."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import GRAVITY, arccos, formula


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
def same(quantity: Any) -> Any:
    """The quantity itself."""
    return quantity


@formula
def is_below(smaller: Any, greater: Any) -> Any:
    """Whether one quantity is below another."""
    return smaller < greater


@formula
def is_at_most(smaller: Any, greater: Any) -> Any:
    """Whether one quantity is not above another."""
    return smaller <= greater


@formula
def is_positive(quantity: Any) -> Any:
    """Whether a quantity is not negative."""
    return quantity >= 0


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
    return ratio * crank_speed**2 * sector_ratio


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
def moment(force: Any, arm: Any) -> Any:
    """Moment of a force on an arm."""
    return force * arm


@formula
def cut_begins(swing_angle: Any, cutting_arc_fraction: Any) -> Any:
    """Rocker angle at one end of the cutting part of the stroke."""
    return swing_angle * (1 - cutting_arc_fraction) / 2


@formula
def cut_ends(swing_angle: Any, cutting_arc_fraction: Any) -> Any:
    """Rocker angle at the other end of the cutting part of the stroke."""
    return swing_angle * (1 + cutting_arc_fraction) / 2


@formula
def sum_of(first: Any, second: Any) -> Any:
    """Sum of two quantities."""
    return first + second


@formula
def is_cutting(displacement: Any, stroke: Any, cutting_arc_fraction: Any) -> Any:
    """Whether the cylinder is on the cutting part of its stroke."""
    return abs(displacement - stroke / 2) <= cutting_arc_fraction * stroke / 2


@formula
def zero() -> Any:
    """Zero."""
    return 0


@formula
def direction(rate: Any) -> Any:
    """Direction of motion, +1 forward and −1 back."""
    return np.sign(rate)


@formula
def reduced_inertia(cylinder_inertia: Any, cylinder_mass: Any, cylinder_radius: Any) -> Any:
    """Inertia of the rolling cylinder about its axis, its translation included."""
    return cylinder_inertia + cylinder_mass * cylinder_radius**2


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
def total_moment(inertia_moment: Any, technological_moment: Any, direction: Any) -> Any:
    """Moment on the cylinder's axis; the technological one resists the motion."""
    return inertia_moment + technological_moment * direction


@formula
def lossless_torque(sector_ratio: Any, rocker_speed_ratio: Any, total_moment: Any) -> Any:
    """Torque at the crank without losses."""
    return sector_ratio * rocker_speed_ratio * total_moment


@formula
def efficiency_total(
    efficiency_four_bar: Any, efficiency_sector: Any, efficiency_gear: Any, efficiency_chain: Any, efficiency_bearings: Any
) -> Any:
    """Efficiency from the crank to the cylinder."""
    return efficiency_four_bar * efficiency_sector * efficiency_gear * efficiency_chain * efficiency_bearings


@formula
def with_losses(torque: Any, efficiency: Any) -> Any:
    """Torque where the crank drives: the losses add to it."""
    return torque / efficiency


@formula
def after_losses(torque: Any, efficiency: Any) -> Any:
    """Torque where the cylinder drives back: the losses take from it."""
    return torque * efficiency


@formula
def power(torque: Any, crank_speed: Any) -> Any:
    """Power at the crank."""
    return torque * crank_speed


@formula
def technological_work(cutting_arc_fraction: Any, cutting_moment: Any, sector_ratio: Any, swing_angle: Any) -> Any:
    """Work of the technological moment over a turn of the crank, two strokes."""
    return 2 * cutting_arc_fraction * cutting_moment * sector_ratio * swing_angle


@formula
def kinetic_energy(reduced_inertia: Any, velocity: Any, cylinder_radius: Any) -> Any:
    """Kinetic energy of the rolling cylinder at a speed of its axis."""
    return reduced_inertia * (velocity / cylinder_radius) ** 2 / 2


@formula
def energy_residual(energy: Any, work: Any, kinetic_energy: Any) -> Any:
    """What the energy over a turn differs from the work, relative to the greater of work and kinetic energy."""
    return abs(energy - work) / np.maximum(work, kinetic_energy)


@formula
def clear_rotation(half_angle: Any, carriage_clearance: Any, cylinder_radius: Any) -> Any:
    """Rotation from the flat's lowest position at which its lower edge still leaves the clearance."""
    return half_angle - arccos(1 - carriage_clearance / cylinder_radius)


@formula
def rocker_at_rotation(rotation: Any, sector_ratio: Any) -> Any:
    """Rocker angle at a rotation of the cylinder."""
    return rotation / sector_ratio


@formula
def rocker_before_turn(rotation: Any, sector_ratio: Any) -> Any:
    """Rocker angle at a rotation before the cylinder's full turn."""
    return (2 * np.pi - rotation) / sector_ratio


@formula
def turn_less(angle: Any) -> Any:
    """The same crank angle a turn earlier."""
    return angle - 2 * np.pi


@formula
def elapsed(start: Any, end: Any, crank_speed: Any) -> Any:
    """Time between two crank angles."""
    return (end - start) / crank_speed


@formula
def length_of(ratio: Any, crank_length: Any) -> Any:
    """Length of a link."""
    return ratio * crank_length


@formula
def rocker_torque(sector_ratio: Any, total_moment: Any) -> Any:
    """Torque at the rocker without losses."""
    return sector_ratio * total_moment


@formula
def efficiency_behind_rocker(
    efficiency_sector: Any, efficiency_gear: Any, efficiency_chain: Any, efficiency_bearings: Any
) -> Any:
    """Efficiency from the rocker to the cylinder."""
    return efficiency_sector * efficiency_gear * efficiency_chain * efficiency_bearings


@formula
def coupler_force(rocker_torque: Any, rocker_length: Any, transmission_angle: Any) -> Any:
    """Force along the coupler, tension positive."""
    return rocker_torque / (rocker_length * np.sin(transmission_angle))


@formula
def along_x(force: Any, direction: Any) -> Any:
    """Component along the frame line."""
    return force * np.cos(direction)


@formula
def along_y(force: Any, direction: Any) -> Any:
    """Component square to the frame line."""
    return force * np.sin(direction)


@formula
def tooth_force(total_moment: Any, pinion_radius: Any) -> Any:
    """Tangential force between the teeth of sector and pinion."""
    return total_moment / pinion_radius


@formula
def normal_force(tangential: Any, pressure_angle: Any) -> Any:
    """Force square to the teeth's flanks."""
    return tangential / np.cos(pressure_angle)


@formula
def radial_force(tangential: Any, pressure_angle: Any) -> Any:
    """Force that presses sector and pinion apart."""
    return tangential * np.tan(pressure_angle)


@formula
def sizes_added(first: Any, second: Any) -> Any:
    """Sizes of two forces together: their resultant is not greater."""
    return abs(first) + abs(second)


@formula
def difference(greater: Any, smaller: Any) -> Any:
    """Difference of two quantities."""
    return greater - smaller


@formula
def rotation(rocker_angle: Any, sector_ratio: Any) -> Any:
    """Rotation of the cylinder."""
    return rocker_angle * sector_ratio


@formula
def flat_arrives(sector_ratio: Any, swing_angle: Any, clear_rotation: Any) -> Any:
    """Whether the flat comes within the clear rotation of its lowest position at the inner dead centre."""
    return abs(sector_ratio * swing_angle - 2 * np.pi) <= clear_rotation
