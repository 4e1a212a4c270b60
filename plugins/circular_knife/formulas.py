"""Formulas of the circular knife: the shaft's axis is the origin, x runs along the cut, depths point down, angles turn clockwise."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import formula


@formula
def lowest_passes(eccentricity: Any, depth: Any, edge_radius: Any) -> Any:
    """Distance from the axis at which the edge's lowest point passes a depth; zero where it never does."""
    return np.sqrt(eccentricity**2 - np.minimum((depth - edge_radius) ** 2, eccentricity**2))


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
def past_centre(angle: Any, distance: Any, eccentricity: Any, depth: Any, edge_radius: Any) -> Any:
    """Zero where a point of the counter-knife lies on the edge: its way along the line axis–centre, by the law of cosines."""
    along = distance * np.cos(angle) + depth * np.sin(angle)
    return along - (distance**2 + (depth - edge_radius) * (depth + edge_radius) + eccentricity**2) / (2 * eccentricity)


@formula
def is_clear_of(smaller: Any, greater: Any, edge_radius: Any) -> Any:
    """Whether one distance is below another by more than a millionth of the edge's radius, or there is no other one at all."""
    return (smaller + 1e-6 * edge_radius < greater) | (greater != greater)


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
def sliding_ratio(edge_radius: Any, eccentricity: Any, angle: Any, shear_angle: Any) -> Any:
    """Tangential to normal speed of the edge at the cutting point."""
    direction = angle + shear_angle
    return (edge_radius + eccentricity * np.sin(direction)) / (eccentricity * np.cos(direction))


@formula
def front_length(edge_radius: Any, face_angle: Any, shear_angle: Any) -> Any:
    """Length along the cut in which the board is partly cut through."""
    return edge_radius * (np.sin(face_angle) - np.sin(shear_angle))


@formula
def force(shear_resistance: Any, thickness: Any, front_length: Any, bow_area: Any) -> Any:
    """Shear stress times the area between the edge and the line square to the board through the cutting point."""
    return shear_resistance * (thickness * front_length / 2 + bow_area)


@formula
def friction_torque(
    friction: Any, force: Any, shear_angle: Any, edge_radius: Any, eccentricity: Any, angle: Any
) -> Any:
    """Torque of the friction along the edge: what presses on the edge times the way that the edge slides for each radian."""
    pressed = force / np.cos(shear_angle)
    return friction * pressed * (edge_radius + eccentricity * np.sin(angle + shear_angle))
