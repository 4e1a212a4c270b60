"""Full-turn kinematics of the crank-rocker four-bar linkage (000 eq. 1–7, with the errata of its method sheet).

Lengths are relative to the crank: frame λ₁ = d/a, coupler λ₂ = b/a, rocker λ₃ = c/a. The crank turns about O₁ = (0, 0),
the rocker about O₃ = (λ₁, 0); the crank angle is measured from O₁O₃, counter-clockwise. The formulas describe the
assembly with the rocker's joint on the left of the line from the rocker's pivot to the crank pin, seen from the pin
(branch +1); the other branch is its mirror image. All take numbers or arrays, for example ratios of shape (variants, 1)
with crank angles of shape (variants, points), and give radians and derivatives by the crank angle.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from diecut_report.formulas import Array
from diecut_report.formulas.expression import arccos, number, pi
from diecut_report.formulas.formula import formula
from diecut_report.mechanics.common import enclosed_angle


@formula
def diagonal(crank_angle: Any, frame_ratio: Any) -> Any:
    """Distance of the crank pin from the rocker's pivot."""
    return np.sqrt(1 + frame_ratio**2 - 2 * frame_ratio * np.cos(crank_angle))


@formula
def diagonal_direction(crank_angle: Any, frame_ratio: Any) -> Any:
    """γ₁, direction from the rocker's pivot to the crank pin, continuous over the turn (frame longer than the crank)."""
    return pi - np.arctan2(np.sin(crank_angle), frame_ratio - np.cos(crank_angle))


@formula
def pin_angle(diagonal: Any, coupler_ratio: Any, rocker_ratio: Any) -> Any:
    """γ₂, angle at the crank pin between the diagonal and the coupler."""
    return enclosed_angle(coupler_ratio, diagonal, rocker_ratio)


@formula
def transmission_angle(diagonal: Any, coupler_ratio: Any, rocker_ratio: Any) -> Any:
    """μ, angle between coupler and rocker."""
    return enclosed_angle(coupler_ratio, rocker_ratio, diagonal)


@formula
def coupler_direction(diagonal_direction: Any, pin_angle: Any) -> Any:
    """γ, direction of the coupler from the crank pin."""
    return diagonal_direction + pin_angle - pi


@formula
def rocker_direction(coupler_direction: Any, transmission_angle: Any) -> Any:
    """β, direction of the rocker from its pivot."""
    return coupler_direction + transmission_angle


@formula
def outer_rocker_direction(frame_ratio: Any, coupler_ratio: Any, rocker_ratio: Any) -> Any:
    """γ₃, direction of the rocker at its outer dead centre, crank and coupler in line and extended."""
    return pi - enclosed_angle(frame_ratio, rocker_ratio, 1 + coupler_ratio)


@formula
def swing_angle(frame_ratio: Any, coupler_ratio: Any, rocker_ratio: Any) -> Any:
    """Swing of the rocker between its dead centres."""
    return enclosed_angle(frame_ratio, rocker_ratio, 1 + coupler_ratio) - enclosed_angle(
        frame_ratio, rocker_ratio, coupler_ratio - 1
    )


@formula
def outer_dead_center(frame_ratio: Any, coupler_ratio: Any, rocker_ratio: Any) -> Any:
    """Crank angle of the outer dead centre."""
    return enclosed_angle(frame_ratio, 1 + coupler_ratio, rocker_ratio)


@formula
def inner_dead_center(frame_ratio: Any, coupler_ratio: Any, rocker_ratio: Any) -> Any:
    """Crank angle of the inner dead centre."""
    return pi + enclosed_angle(frame_ratio, coupler_ratio - 1, rocker_ratio)


@formula
def least_transmission_angle(frame_ratio: Any, coupler_ratio: Any, rocker_ratio: Any) -> Any:
    """Transmission angle with the crank along the frame, towards the rocker's pivot."""
    return enclosed_angle(coupler_ratio, rocker_ratio, frame_ratio - 1)


@formula
def greatest_transmission_angle(frame_ratio: Any, coupler_ratio: Any, rocker_ratio: Any) -> Any:
    """Transmission angle with the crank along the frame, away from the rocker's pivot."""
    return enclosed_angle(coupler_ratio, rocker_ratio, frame_ratio + 1)


@formula
def rocker_speed_ratio(crank_angle: Any, coupler_direction: Any, rocker_direction: Any, rocker_ratio: Any) -> Any:
    """ω₃ᵢ, angular speed of the rocker relative to the crank's."""
    return np.sin(coupler_direction - crank_angle) / (rocker_ratio * np.sin(coupler_direction - rocker_direction))


@formula
def coupler_speed_ratio(crank_angle: Any, coupler_direction: Any, rocker_direction: Any, coupler_ratio: Any) -> Any:
    """ω₂ᵢ, angular speed of the coupler relative to the crank's."""
    return np.sin(rocker_direction - crank_angle) / (coupler_ratio * np.sin(coupler_direction - rocker_direction))


@formula
def rocker_acceleration_ratio(
    crank_angle: Any,
    coupler_direction: Any,
    rocker_direction: Any,
    rocker_speed_ratio: Any,
    coupler_speed_ratio: Any,
    coupler_ratio: Any,
    rocker_ratio: Any,
) -> Any:
    """ε₃ᵢ, angular acceleration of the rocker relative to the square of the crank's angular speed, which is constant."""
    centripetal = rocker_ratio * np.cos(coupler_direction - rocker_direction) * rocker_speed_ratio**2
    pin = np.cos(coupler_direction - crank_angle)
    return (centripetal - pin - coupler_ratio * coupler_speed_ratio**2) / (
        rocker_ratio * np.sin(coupler_direction - rocker_direction)
    )


@formula
def joint_distance(rocker_direction: Any, frame_ratio: Any, rocker_ratio: Any) -> Any:
    """Distance of the joint between coupler and rocker from the crank's pivot."""
    return np.sqrt(frame_ratio**2 + rocker_ratio**2 + 2 * frame_ratio * rocker_ratio * np.cos(rocker_direction))


@formula
def crank_angle_forward(
    rocker_direction: Any, joint_distance: Any, frame_ratio: Any, coupler_ratio: Any, rocker_ratio: Any
) -> Any:
    """Crank angle at which the rocker stands in a direction while it swings from the outer to the inner dead centre."""
    joint = np.arctan2(rocker_ratio * np.sin(rocker_direction), frame_ratio + rocker_ratio * np.cos(rocker_direction))
    return joint + arccos((1 + joint_distance**2 - coupler_ratio**2) / (2 * joint_distance))


@formula
def crank_angle_return(
    rocker_direction: Any, joint_distance: Any, frame_ratio: Any, coupler_ratio: Any, rocker_ratio: Any
) -> Any:
    """The same while it swings back: between the inner dead centre and a turn after the outer one."""
    joint = np.arctan2(rocker_ratio * np.sin(rocker_direction), frame_ratio + rocker_ratio * np.cos(rocker_direction))
    return 2 * pi + joint - arccos((1 + joint_distance**2 - coupler_ratio**2) / (2 * joint_distance))


@formula
def is_crank_rocker(frame_ratio: Any, coupler_ratio: Any, rocker_ratio: Any) -> Any:
    """Grashof's condition with the crank as the shortest link: the crank turns fully, the rocker swings."""
    # A linkage that just folds flat has sides alike but for rounding, which must not decide that it turns. A ratio of typed lengths errs
    # by 2.5 ε (both lengths by ε as they are typed and converted, their quotient by ε/2), the sums by ε more: 3.5 ε of both sides together,
    # which are alike there. That is 7 ε of one side, with ε = 2.2e-16.
    longest = np.maximum(frame_ratio, np.maximum(coupler_ratio, rocker_ratio))
    shortest = np.minimum(frame_ratio, np.minimum(coupler_ratio, rocker_ratio))
    return (shortest > 1) & (1 + 2 * longest < (frame_ratio + coupler_ratio + rocker_ratio) * (number(1) - 1.6e-15))


class LinkageMotion(NamedTuple):
    """Directions (rad) and derivatives by the crank angle; arrays of the broadcast shape of crank angle and ratios."""

    coupler_direction: Array
    rocker_direction: Array
    transmission_angle: Array
    coupler_speed_ratio: Array
    rocker_speed_ratio: Array
    rocker_acceleration_ratio: Array


def motion(
    crank_angle: Array | float,
    frame_ratio: Array | float,
    coupler_ratio: Array | float,
    rocker_ratio: Array | float,
    *,
    branch: int = 1,
) -> LinkageMotion:
    """The whole motion of a crank-rocker in one of its two assemblies (branch +1, or -1: mirrored about the frame line).

    Ratios and crank angle (rad) broadcast together. NaN where the linkage does not close.
    """
    phi = branch * crank_angle
    span = diagonal(phi, frame_ratio)
    coupler = coupler_direction(diagonal_direction(phi, frame_ratio), pin_angle(span, coupler_ratio, rocker_ratio))
    mu = transmission_angle(span, coupler_ratio, rocker_ratio)
    rocker = rocker_direction(coupler, mu)
    speed2 = coupler_speed_ratio(phi, coupler, rocker, coupler_ratio)
    speed3 = rocker_speed_ratio(phi, coupler, rocker, rocker_ratio)
    rate = rocker_acceleration_ratio(phi, coupler, rocker, speed3, speed2, coupler_ratio, rocker_ratio)
    return LinkageMotion(branch * coupler, branch * rocker, mu, speed2, speed3, branch * rate)
