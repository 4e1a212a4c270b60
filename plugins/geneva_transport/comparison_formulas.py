"""Formulas of the comparison of cam-gear stepper and Geneva drive.

Velocities are related to the mean velocity S/T (step and cycle time), accelerations to S/T².
"""

from __future__ import annotations

from typing import Any

from diecut_report.api import formula


@formula
def are_alike(one: Any, other: Any) -> Any:
    """Whether two quantities are the same, rounding apart."""
    return abs(one - other) <= 1e-6 * abs(one)


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
