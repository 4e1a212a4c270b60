"""Formulas of the V-belt: speed, fit, tensions and the load that they put on the shafts."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import as_number, formula, standard_series, standard_series_by
from diecut_report.mechanics import belt_path

PULLEYS = standard_series("renard_r40_lengths")
LENGTHS = standard_series_by("iso_4184_lengths")
LARGEST_RATIO = 7.0
LARGEST_DEVIATION = 2.0  # of the output's speed, %
FASTEST_BELT = 30.0  # m/s
LEAST_WRAP = 120.0  # deg


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


@formula
def length_factor(length: Any, reference: Any) -> Any:
    """Factor of the belt's length: a longer belt bends less often."""
    ratio = length / reference
    return np.where(ratio <= 1, ratio**0.18, ratio**0.15)


@formula
def tension_at_rest(pull: Any, tension_ratio: Any, count: Any, mass_per_length: Any, speed: Any) -> Any:
    """Tension of one belt at rest with which the pull is carried: half of both runs, and what the centrifugal force takes."""
    return pull * (tension_ratio + 1) / (2 * count * (tension_ratio - 1)) + mass_per_length * speed**2


@formula
def pull_before_slip(tension: Any, tension_ratio: Any, count: Any, mass_per_length: Any, speed: Any) -> Any:
    """Pull at which belts of a tension at rest begin to slip."""
    return 2 * count * (tension - mass_per_length * speed**2) * (tension_ratio - 1) / (tension_ratio + 1)
