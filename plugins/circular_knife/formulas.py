"""Formulas of the circular knife: the shaft's axis is the origin, x runs along the cut, depths point down, angles turn clockwise."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import formula


@formula
def reach(edge_radius: Any, eccentricity: Any, depth: Any) -> Any:
    """Distance from the axis to which the edge gets at a depth: the edge's centre then stands on the line to that point."""
    return np.sqrt((edge_radius + eccentricity) ** 2 - depth**2)


@formula
def lowest_passes(eccentricity: Any, depth: Any, edge_radius: Any) -> Any:
    """Distance from the axis at which the edge's lowest point passes a depth; zero where it never does."""
    return np.sqrt(eccentricity**2 - np.minimum((depth - edge_radius) ** 2, eccentricity**2))


@formula
def is_thick_enough(thickness: Any, edge_radius: Any) -> Any:
    """Whether the thickness is at least a millionth of the edge's radius."""
    return thickness >= 1e-6 * edge_radius


@formula
def touching_angle(depth: Any, edge_radius: Any, eccentricity: Any) -> Any:
    """Knife angle at which the edge's lowest point comes to a depth."""
    return np.arcsin((depth - edge_radius) / eccentricity)


@formula
def distance_of(along: Any, down: Any) -> Any:
    """Distance from the axis of a point beside and below it."""
    return np.sqrt(along**2 + down**2)


@formula
def meeting_angle(eccentricity: Any, edge_radius: Any, corner: Any, front_distance: Any, face_depth: Any) -> Any:
    """Knife angle at which the edge meets a point: its direction less the angle at the axis, by the law of cosines."""
    cosine = (eccentricity**2 + corner**2 - edge_radius**2) / (2 * eccentricity * corner)
    return np.arctan2(face_depth, front_distance) - np.arccos(np.maximum(cosine, -1))


@formula
def meeting_place(eccentricity: Any, edge_radius: Any, corner: Any) -> Any:
    """Place on the edge that meets a point at a distance from the axis, by the law of cosines."""
    cosine = (corner**2 - eccentricity**2 - edge_radius**2) / (2 * eccentricity * edge_radius)
    return np.arccos(np.maximum(cosine, -1))


@formula
def reversal_angle(depth: Any, edge_radius: Any, eccentricity: Any) -> Any:
    """Knife angle at which the edge's point in a depth turns back."""
    return np.arcsin(depth / (edge_radius + eccentricity))


@formula
def past_centre(angle: Any, distance: Any, eccentricity: Any, depth: Any, edge_radius: Any) -> Any:
    """Zero where a point of the counter-knife lies on the edge: its way along the line axis–centre, by the law of cosines."""
    along = distance * np.cos(angle) + depth * np.sin(angle)
    return along - (distance**2 + (depth - edge_radius) * (depth + edge_radius) + eccentricity**2) / (2 * eccentricity)


@formula
def from_centre_squared(angle: Any, distance: Any, eccentricity: Any, depth: Any) -> Any:
    """Square of the distance of a point of the counter-knife from the edge's centre."""
    return (distance - eccentricity * np.cos(angle)) ** 2 + (depth - eccentricity * np.sin(angle)) ** 2


@formula
def squared(length: Any) -> Any:
    """Square of a length."""
    return length**2


@formula
def is_clear_of(smaller: Any, greater: Any, edge_radius: Any) -> Any:
    """Whether one distance is below another by more than a millionth of the edge's radius, or there is no other one at all."""
    return (smaller + 1e-6 * edge_radius < greater) | (greater != greater)


@formula
def reaches_end(cut_end: Any, front_distance: Any, reach_greatest: Any, edge_radius: Any) -> Any:
    """Whether the edge reaches the end of the cut, or not even its beginning."""
    return is_clear_of(cut_end, reach_greatest, edge_radius) | ~is_clear_of(front_distance, reach_greatest, edge_radius)


@formula
def enters_counter(lowest_at_counter: Any, lowest_at_face: Any, front_distance: Any, edge_radius: Any) -> Any:
    """Whether the edge meets the counter-knife before the board, or comes down on the board from above anyway."""
    return is_clear_of(lowest_at_counter, front_distance, edge_radius) | (front_distance < lowest_at_face)


@formula
def parting_angle(angle_start: Any, angle_end: Any, touch_angle: Any) -> Any:
    """Knife angle that parts the cut where curves begin steeply: the geometric mean from the touching angle."""
    return touch_angle + np.sqrt((angle_start - touch_angle) * (angle_end - touch_angle))


@formula
def edge_position(angle: Any, depth: Any, eccentricity: Any, edge_radius: Any) -> Any:
    """Distance from the axis at which the edge crosses a depth."""
    down = depth - eccentricity * np.sin(angle)
    return eccentricity * np.cos(angle) + np.sqrt(edge_radius**2 - down**2)


@formula
def edge_slope(angle: Any, depth: Any, eccentricity: Any, edge_radius: Any) -> Any:
    """Angle between edge and counter-knife where the edge crosses a depth."""
    down = depth - eccentricity * np.sin(angle)
    return np.arctan2(np.sqrt(edge_radius**2 - down**2), down)


@formula
def elapsed(angle: Any, speed: Any) -> Any:
    """Time of a turn by an angle."""
    return angle / speed


@formula
def middle_of(first: Any, second: Any) -> Any:
    """Middle of two angles."""
    return (first + second) / 2


@formula
def is_within(angle: Any, middle: Any, sweep: Any) -> Any:
    """Whether an angle is within a sweep about its middle, whatever the turn."""
    return np.cos(angle - middle) >= np.cos(sweep / 2)


@formula
def holds(flag: Any) -> Any:
    """Whether a flag is set."""
    return flag == 1


@formula
def cut_speed(speed: Any, eccentricity: Any, angle: Any, shear_angle: Any) -> Any:
    """Speed of the cutting point along the counter-knife."""
    return speed * eccentricity * np.cos(angle + shear_angle) / np.sin(shear_angle)


@formula
def sliding_ratio(edge_radius: Any, eccentricity: Any, angle: Any, shear_angle: Any) -> Any:
    """Tangential to normal speed of the edge at the cutting point."""
    direction = angle + shear_angle
    return (edge_radius + eccentricity * np.sin(direction)) / (eccentricity * np.cos(direction))


@formula
def effective_angle(sharpening_angle: Any, sliding_ratio: Any) -> Any:
    """Sharpening angle in the direction in which the edge moves through the board."""
    return np.arctan(np.tan(sharpening_angle) * np.cos(np.arctan(sliding_ratio)))


@formula
def expulsion_angle(friction: Any) -> Any:
    """Shear angle from which edge and counter-knife push the board out between them."""
    return 2 * np.arctan(friction)


@formula
def least_shear_angle() -> Any:
    """Least shear angle of practice, 2°."""
    return 2 * np.pi / 180


@formula
def greatest_shear_angle() -> Any:
    """Greatest shear angle of practice, 20°."""
    return 20 * np.pi / 180


@formula
def upper_side_governs(greatest: Any, upper: Any, lower: Any, least: Any) -> Any:
    """Whether a range comes nearer to its upper limit than to its lower one."""
    return greatest / upper >= lower / least


@formula
def half_between(first: Any, second: Any) -> Any:
    """Half the difference of two angles."""
    return (second - first) / 2


@formula
def front_length(edge_radius: Any, face_angle: Any, shear_angle: Any) -> Any:
    """Length along the cut in which the board is partly cut through."""
    return edge_radius * (np.sin(face_angle) - np.sin(shear_angle))


@formula
def force(shear_resistance: Any, thickness: Any, front_length: Any, bow_area: Any) -> Any:
    """Shear stress times the area between the edge and the line square to the board through the cutting point."""
    return shear_resistance * (thickness * front_length / 2 + bow_area)


@formula
def working_force(shear_resistance: Any, thickness: Any, front_length: Any, bow_area: Any) -> Any:
    """Shear stress times the area that the edge has still to cut over the working front."""
    return shear_resistance * (thickness * front_length / 2 - bow_area)


@formula
def thrust(shear_resistance: Any, thickness: Any) -> Any:
    """Force along the cut; also the work of each unit of length cut."""
    return shear_resistance * thickness**2 / 2


@formula
def useful_torque(eccentricity: Any, working_force: Any, thrust: Any, angle: Any) -> Any:
    """Torque of the forces on the edge, which all point to the edge's centre."""
    return eccentricity * (working_force * np.cos(angle) - thrust * np.sin(angle))


@formula
def friction_torque(
    friction: Any, force: Any, shear_angle: Any, edge_radius: Any, eccentricity: Any, angle: Any
) -> Any:
    """Torque of the friction along the edge: what presses on the edge times the way that the edge slides for each radian."""
    pressed = force / np.cos(shear_angle)
    return friction * pressed * (edge_radius + eccentricity * np.sin(angle + shear_angle))


@formula
def guillotine_force(shear_resistance: Any, thickness: Any, cut_length: Any) -> Any:
    """Force of a straight blade that cuts the whole length at once."""
    return shear_resistance * thickness * cut_length


@formula
def guillotine_work(guillotine_force: Any, thickness: Any) -> Any:
    """Work of that blade: its force falls to zero over the thickness."""
    return guillotine_force * thickness / 2


@formula
def mean_power(work: Any, speed: Any) -> Any:
    """Mean power over a turn with one cut."""
    return work * speed / (2 * np.pi)


@formula
def place_on_edge(angle: Any, edge_slope: Any) -> Any:
    """Place on the edge, seen from its centre, from the line shaft–centre."""
    return np.pi / 2 - angle - edge_slope


@formula
def arc_between(edge_radius: Any, first: Any, last: Any) -> Any:
    """Length of the edge between two places on it."""
    return edge_radius * (first - last)
