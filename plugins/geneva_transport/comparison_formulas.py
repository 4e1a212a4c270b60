"""Formulas of the comparison of cam-gear stepper and Geneva drive.

Velocities are related to the mean velocity S/T (step and cycle time), accelerations to S/T².
"""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import as_number, formula
from diecut_report.plugins.geneva_transport import formulas


@formula
def time_of_cycle(cycles: Any) -> Any:
    """Time of a cycle."""
    return 1 / cycles


@formula
def are_alike(one: Any, other: Any) -> Any:
    """Whether two quantities are the same, rounding apart."""
    return abs(one - other) <= 1e-6 * abs(one)


@formula
def middle_of_motion(dwell_share: Any) -> Any:
    """Disc angle in the middle of the cam-gear's motion."""
    return np.pi * (1 + dwell_share)


@formula
def comes_before(angle: Any, middle: Any) -> Any:
    """Whether an angle is nearer to the middle of the motion before."""
    return angle < middle - np.pi


@formula
def from_middle(angle: Any, middle: Any, turns: Any) -> Any:
    """Crank angle of the Geneva drive, whose motion has the same middle as the cam-gear's."""
    return angle - middle + 2 * np.pi * turns


@formula
def is_within(angle: Any, half: Any) -> Any:
    """Whether the Geneva drive's roller is in a slot."""
    return abs(angle) <= half


@formula
def cam_velocity(gear_speed: Any) -> Any:
    """Velocity by the gear's speed, one turn of which is a step."""
    return gear_speed / (2 * np.pi)


@formula
def cam_acceleration(gear_acceleration: Any, cycle_time: Any) -> Any:
    """Acceleration by the gear's, one turn of which is a step."""
    return gear_acceleration * cycle_time**2 / (2 * np.pi)


@formula
def geneva_velocity(slots: Any, angle: Any, crank_ratio: Any) -> Any:
    """Velocity by the wheel's speed, one slot of which is a step."""
    return slots * formulas.speed_ratio(angle, crank_ratio)


@formula
def geneva_acceleration(slots: Any, angle: Any, crank_ratio: Any) -> Any:
    """Acceleration by the wheel's, one slot of which is a step."""
    return as_number(2 * np.pi) * slots * formulas.acceleration_ratio(angle, crank_ratio)


@formula
def geneva_jump(slots: Any) -> Any:
    """Jump of the acceleration at entry and exit."""
    return as_number(2 * np.pi) * slots * np.tan(np.pi / slots)


@formula
def in_metres(relative: Any, step: Any, cycle_time: Any) -> Any:
    """A velocity from the related one."""
    return relative * step / cycle_time


@formula
def in_metres_squared(relative: Any, step: Any, cycle_time: Any) -> Any:
    """An acceleration from the related one."""
    return relative * step / cycle_time**2


@formula
def in_newton_metres(relative: Any, mass: Any, step: Any, cycle_time: Any) -> Any:
    """Torque at a shaft that makes a turn a cycle."""
    return relative * mass * (step / cycle_time) ** 2 / (2 * np.pi)


@formula
def stop_sweep_limit(geneva_dwell: Any, dwell_sweep: Any, peak_velocity: Any, least_return: Any) -> Any:
    """Sweep of stop and start that leaves the return its least time, at the Geneva drive's dwell."""
    return (1 - least_return - geneva_dwell) * dwell_sweep / (peak_velocity * geneva_dwell)


@formula
def stop_sweep_best(geneva_dwell: Any, dwell_sweep: Any, peak_velocity: Any) -> Any:
    """Sweep of stop and start with which both ask for the same acceleration as the return, at the Geneva drive's dwell."""
    moved = 1 - geneva_dwell
    reach = peak_velocity * geneva_dwell
    return dwell_sweep * moved**2 / (reach * (reach + 2 * moved))


@formula
def time_of_stop(stop_sweep: Any, geneva_dwell: Any, dwell_sweep: Any, peak_velocity: Any) -> Any:
    """Share of stop and start."""
    return peak_velocity * geneva_dwell * stop_sweep / dwell_sweep


@formula
def time_of_return(geneva_dwell: Any, time_of_stop: Any) -> Any:
    """Share of the return."""
    return 1 - geneva_dwell - time_of_stop


@formula
def velocity_of_return(
    stop_sweep: Any, geneva_dwell: Any, dwell_sweep: Any, peak_velocity: Any, return_time: Any
) -> Any:
    """Greatest velocity of the sheet: the disc's part and the returning sector's."""
    return 1 + peak_velocity * geneva_dwell * (1 + stop_sweep / dwell_sweep) / return_time


@formula
def acceleration_of_stop(
    stop_sweep: Any, geneva_dwell: Any, dwell_sweep: Any, peak_acceleration: Any, stop_time: Any
) -> Any:
    """Greatest acceleration of the sheet while the sector stops and starts."""
    return peak_acceleration * geneva_dwell * stop_sweep / (dwell_sweep * stop_time**2)


@formula
def acceleration_of_return(
    stop_sweep: Any, geneva_dwell: Any, dwell_sweep: Any, peak_acceleration: Any, return_time: Any
) -> Any:
    """Greatest acceleration of the sheet while the sector returns."""
    return peak_acceleration * geneva_dwell * (1 + stop_sweep / dwell_sweep) / return_time**2


@formula
def is_gentle_and_long(geneva: Any, cam: Any, geneva_dwell: Any, dwell_share: Any) -> Any:
    """Whether the Geneva drive has the lower acceleration, and dwells at least as long."""
    return (geneva < cam) & (geneva_dwell >= dwell_share)


@formula
def is_gentle_and_alike(geneva: Any, cam: Any, geneva_dwell: Any, dwell_share: Any) -> Any:
    """Whether the Geneva drive has the lower acceleration in the same dwell."""
    return (geneva < cam) & are_alike(geneva_dwell, dwell_share)


@formula
def are_both_below_one(first: Any, second: Any) -> Any:
    """Whether two ratios are below one."""
    return (first < 1) & (second < 1)
