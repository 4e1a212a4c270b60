"""Cams that drive a roller on an arm, the arm's pivot going round the cam's axis (a carrier turns, or the cam does).

The carrier turns about O₁ = (0, 0) by φ, counter-clockwise; the arm's pivot is on it, at the radius R. The arm of length a
stands at ψ from the outward line O₁–pivot, counter-clockwise, and turns relative to the carrier: ψ′ and ψ″ are derivatives
by φ (``arm_rate``, ``arm_acceleration``), w = 1 + ψ′ (``arm_turn``) is the arm's speed in the frame of the cam. All lines
are in that frame. The roller's centre runs on the pitch curve; the cam's profile is the curve beside it, set off by the
roller's radius to the left of the motion, which is towards O₁ while the centre goes round O₁ counter-clockwise. Curvature
is above zero where the pitch curve is convex, its centre of curvature being on O₁'s side.

There the profile's radius of curvature is 1/κ − r: it ends in a point and undercuts where 1/κ < r. Where the pitch curve is
hollow (κ < 0) the profile's radius is r greater than the pitch curve's, and it never undercuts of itself. Profile and roller
do not meet a second time where, further, the tangent of the pitch curve keeps more than r from O₁ all around: then the
profile goes round O₁ without turning back, as do all curves between it and the pitch curve.

All take numbers or arrays, and give lengths in the unit of R.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.formulas.formula import formula


@formula
def pitch_x(carrier_angle: Any, pivot_radius: Any, arm_length: Any, arm_direction: Any) -> Any:
    """First coordinate of the roller's centre."""
    return pivot_radius * np.cos(carrier_angle) + arm_length * np.cos(carrier_angle + arm_direction)


@formula
def pitch_y(carrier_angle: Any, pivot_radius: Any, arm_length: Any, arm_direction: Any) -> Any:
    """Second coordinate of the roller's centre."""
    return pivot_radius * np.sin(carrier_angle) + arm_length * np.sin(carrier_angle + arm_direction)


@formula
def arm_turn(arm_rate: Any) -> Any:
    """Angular speed of the arm in the frame of the cam, to that of the carrier."""
    return 1 + arm_rate


@formula
def roller_path(pivot_radius: Any, arm_length: Any, arm_direction: Any, arm_turn: Any) -> Any:
    """Path of the roller's centre for each radian of the carrier."""
    turning = arm_length * arm_turn
    return np.sqrt(pivot_radius**2 + 2 * pivot_radius * turning * np.cos(arm_direction) + turning**2)


@formula
def profile_x(
    pitch_x: Any,
    roller_radius: Any,
    carrier_angle: Any,
    pivot_radius: Any,
    arm_length: Any,
    arm_direction: Any,
    arm_turn: Any,
    roller_path: Any,
) -> Any:
    """First coordinate of the profile."""
    turning = arm_length * arm_turn * np.cos(carrier_angle + arm_direction)
    return pitch_x - roller_radius * (pivot_radius * np.cos(carrier_angle) + turning) / roller_path


@formula
def profile_y(
    pitch_y: Any,
    roller_radius: Any,
    carrier_angle: Any,
    pivot_radius: Any,
    arm_length: Any,
    arm_direction: Any,
    arm_turn: Any,
    roller_path: Any,
) -> Any:
    """Second coordinate of the profile."""
    turning = arm_length * arm_turn * np.sin(carrier_angle + arm_direction)
    return pitch_y - roller_radius * (pivot_radius * np.sin(carrier_angle) + turning) / roller_path


@formula
def pressure_angle(pivot_radius: Any, arm_length: Any, arm_direction: Any, arm_turn: Any) -> Any:
    """Angle between the force on the roller and its velocity relative to the carrier (the way in which it moves the arm)."""
    along = np.cos(arm_direction) + arm_length / pivot_radius * arm_turn
    return np.arctan(abs(along) / abs(np.sin(arm_direction)))


@formula
def swing_part(arm_direction: Any, arm_turn: Any, arm_acceleration: Any) -> Any:
    """Part of the pitch curve's curvature that comes with the arm's swing."""
    return arm_turn * (1 + arm_turn) * np.cos(arm_direction) + arm_acceleration * np.sin(arm_direction)


@formula
def curvature(pivot_radius: Any, arm_length: Any, arm_turn: Any, swing_part: Any, roller_path: Any) -> Any:
    """Curvature of the pitch curve, above zero where it is convex."""
    return (pivot_radius**2 + pivot_radius * arm_length * swing_part + arm_length**2 * arm_turn**3) / roller_path**3


@formula
def tangent_distance(pivot_radius: Any, arm_length: Any, arm_direction: Any, arm_turn: Any, roller_path: Any) -> Any:
    """Distance of O₁ from the pitch curve's tangent, above zero where the roller's centre goes round O₁ counter-clockwise."""
    turned = pivot_radius * arm_length * (1 + arm_turn) * np.cos(arm_direction)
    return (pivot_radius**2 + turned + arm_length**2 * arm_turn) / roller_path


@formula
def least_radius(greatest_curvature: Any) -> Any:
    """Least radius of curvature of the convex stretches."""
    return 1 / greatest_curvature


@formula
def profile_radius(pitch_radius: Any, roller_radius: Any) -> Any:
    """Radius of curvature of a convex stretch of the profile; below zero where the profile undercuts."""
    return pitch_radius - roller_radius


@formula
def hollow_radius(least_curvature: Any, roller_radius: Any) -> Any:
    """Least radius of the profile's hollow stretches, which no grinding wheel may exceed."""
    return roller_radius - 1 / least_curvature


@formula
def is_hollow(least_curvature: Any) -> Any:
    """Whether the profile has hollow stretches."""
    return least_curvature < 0


@formula
def effective_radius(roller_radius: Any, curvature: Any) -> Any:
    """Effective radius of the contact of roller and profile: that of r and 1/κ − r together, convex or hollow."""
    return roller_radius * (1 - roller_radius * curvature)
