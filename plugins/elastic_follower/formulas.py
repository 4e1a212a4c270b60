"""Formulas of the elastic drive: times, the motion of the input, ratios of peaks."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import formula


@formula
def cycles_a_second(angular_frequency: Any) -> Any:
    """Frequency."""
    return angular_frequency / (2 * np.pi)


@formula
def inverse(frequency: Any) -> Any:
    """Duration of a cycle."""
    return 1 / frequency


@formula
def passed_share(time: Any, rise_duration: Any) -> Any:
    """Share of the rise that has passed, 1 after it."""
    return np.minimum(time / rise_duration, 1)


@formula
def law_acceleration(rise: Any, rise_duration: Any, acceleration: Any) -> Any:
    """Acceleration of a rise by a law, of the law's acceleration."""
    return rise / rise_duration**2 * acceleration


@formula
def overshoot_of_rise(response_max: Any, rise: Any) -> Any:
    """What the link goes beyond the rise, to the rise."""
    return (response_max - rise) / rise


@formula
def overshoot_of_curve(response_max: Any, response_min: Any, input_max: Any, input_min: Any, rise: Any) -> Any:
    """What the link goes beyond the ends of the motion, to the motion's range."""
    return np.maximum(response_max - input_max, input_min - response_min) / rise


@formula
def tuned_stiffness(stiffness: Any, wanted: Any, tuning_ratio: Any) -> Any:
    """Stiffness with a wanted number of natural periods."""
    return stiffness * (wanted / tuning_ratio) ** 2
