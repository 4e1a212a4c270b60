"""Formulas of ratios, speeds, torques and powers along the shafts."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import formula


@formula
def steps_down(vbelt_ratio: Any) -> Any:
    """Whether the V-belt has nothing to speed up."""
    return vbelt_ratio > 1 - 1e-12


@formula
def relative_deviation(speed: Any, demanded: Any) -> Any:
    """Deviation of a speed from the demanded one."""
    return abs(speed - demanded) / demanded


@formula
def driving_part(torque: Any) -> Any:
    """The torque where it drives the load, else zero."""
    return np.maximum(torque, 0)


@formula
def braking_part(torque: Any) -> Any:
    """The size of the torque where the load drives, else zero."""
    return np.maximum(-torque, 0)


@formula
def referred_back(torque: Any, ratio: Any, efficiency: Any) -> Any:
    """Torque before a ratio that what is behind it drives: the losses take from it."""
    return torque * efficiency / ratio


@formula
def mean_torque(driving_mean: Any, braking_mean: Any, ratio: Any, efficiency: Any) -> Any:
    """Mean torque of a shaft from the driving and the braking part at the output, with the losses between."""
    return driving_mean / (ratio * efficiency) - braking_mean * efficiency / ratio


@formula
def lost(power: Any, efficiency: Any) -> Any:
    """Power that a transmission loses of what goes into it."""
    return power * (1 - efficiency)


@formula
def lost_both_ways(driving_mean: Any, braking_mean: Any, speed: Any, behind: Any, efficiency: Any) -> Any:
    """Power that a pair loses: of what drives the load through it, and of what flows back through it."""
    return speed * (1 - efficiency) * (driving_mean / (behind * efficiency) + braking_mean * behind)


@formula
def net_power(driving_mean: Any, braking_mean: Any, speed: Any) -> Any:
    """Power that the output takes, what it gives back subtracted."""
    return (driving_mean - braking_mean) * speed


@formula
def unbalanced(power_in: Any, losses: Any, power_out: Any) -> Any:
    """What is missing between power in, losses and power out."""
    return abs(power_in - losses - power_out)


@formula
def accepted_rounding(driving_mean: Any, braking_mean: Any, speed: Any) -> Any:
    """What the rounding of the computer may take from the powers."""
    return 1e-12 * (driving_mean + braking_mean) * speed


@formula
def off(one: Any, other: Any) -> Any:
    """How far two quantities are apart."""
    return abs(one - other)


@formula
def mean_off(driving_mean: Any, braking_mean: Any, torque_mean: Any) -> Any:
    """How far the mean of a torque, of its two parts, is off the mean given."""
    return abs(driving_mean - braking_mean - torque_mean)


@formula
def hundredth_of(torque: Any) -> Any:
    """A hundredth of a torque."""
    return torque / 100
