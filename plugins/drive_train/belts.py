"""Formulas of the V-belt: speed, fit, tensions and the load that they put on the shafts."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import as_number, formula
from diecut_report.mechanics import belt_path


@formula
def rim_speed(speed: Any, diameter: Any) -> Any:
    """Speed at the circumference."""
    return speed * diameter / 2


@formula
def run_left_by_arcs(center_distance: Any, small: Any, large: Any, belt: Any) -> Any:
    """What the arcs leave of half the belt: the straight run."""
    return (belt - np.pi * (large + small)) / 2 - (large - small) * np.arcsin((large - small) / center_distance)


@formula
def length_left_over(center_distance: Any, small: Any, large: Any, belt: Any) -> Any:
    """What an open belt around the pulleys is longer than the belt that there is."""
    return belt_path.open_belt_length(center_distance, small, large) - belt


@formula
def ratio_leaves_room(ratio: Any, largest: Any, least: Any, distance: Any) -> Any:
    """Whether it is not a ratio too great for a V-belt that makes the pulleys overlap."""
    return (ratio <= largest) | (least < distance)


@formula
def has_room(ratio: Any, largest: Any, least: Any, distance: Any) -> Any:
    """Whether the pulleys stand apart, or it is the ratio that is to blame."""
    return (ratio > largest) | (least < distance)


@formula
def ratio_leaves_belt(ratio: Any, largest: Any, shortest: Any, length: Any, longest: Any) -> Any:
    """Whether it is not a ratio too great for a V-belt for which there is no belt."""
    return (ratio <= largest) | ((length >= shortest) & (length <= longest))


@formula
def has_belt(ratio: Any, largest: Any, shortest: Any, length: Any, longest: Any) -> Any:
    """Whether there is a belt of such a length, or it is the ratio that is to blame."""
    return (ratio > largest) | ((length >= shortest) & (length <= longest))


@formula
def tension_ratio(groove_friction: Any, wrap: Any) -> Any:
    """Ratio of the tensions of the tight and the slack side (Euler, with the friction of the groove)."""
    return np.exp(groove_friction * as_number(wrap))
