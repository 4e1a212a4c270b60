"""Formulas of the cam-gear stepper, and of the loads on it."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import formula, number, pi


@formula
def teeth_together(center_distance: Any, module: Any) -> Any:
    """Teeth of gear and sector together, the sector counted as a full wheel."""
    return 2 * center_distance / module


@formula
def gear_teeth(teeth_together: Any, sweep: Any, dwell_angle: Any) -> Any:
    """Whole teeth of the gear for the wanted sweep."""
    return np.round(teeth_together * sweep / (sweep + dwell_angle))


@formula
def other_teeth(teeth_together: Any, gear_teeth: Any) -> Any:
    """Teeth of the sector, counted as a full wheel."""
    return np.round(teeth_together) - gear_teeth


@formula
def sweep_of_teeth(dwell_angle: Any, gear_teeth: Any, sector_wheel_teeth: Any) -> Any:
    """Sweep of the sector with which the gear stands still in the dwell."""
    return dwell_angle * gear_teeth / sector_wheel_teeth


@formula
def radius_ratio(sweep: Any, dwell_angle: Any) -> Any:
    """Radius of the gear to that of the pin: the sector rolls off as fast as the disc turns."""
    return sweep / (sweep + dwell_angle)


@formula
def share_of_turn(angle: Any) -> Any:
    """Share of a turn."""
    return angle / (2 * pi)


@formula
def constant_speed(sweep: Any, time: Any) -> Any:
    """Speed of an even motion."""
    return sweep / time


@formula
def time_stop(peak_velocity: Any, sector_stop_sweep: Any, sector_speed_dwell: Any) -> Any:
    """Time of the rise whose greatest speed is that of the dwell."""
    return peak_velocity * sector_stop_sweep / sector_speed_dwell


@formula
def time_return(time_dwell: Any, time_stop: Any) -> Any:
    """What dwell, stop and start leave of the turn."""
    return 1 - time_dwell - time_stop


@formula
def is_symmetric(middle_position: Any, middle_velocity: Any, peak_velocity: Any) -> Any:
    """Whether a law is half way, and fastest, in the middle of its time."""
    return (abs(middle_position - number(1) / 2) <= 1e-9) & (
        abs(middle_velocity - peak_velocity) <= 1e-9 * peak_velocity
    )


@formula
def return_peak(peak_velocity: Any, sector_sweep: Any, time_return: Any) -> Any:
    """Greatest speed of the sector's return."""
    return peak_velocity * sector_sweep / time_return


@formula
def starting_angle(sector_stop_sweep: Any, law_position: Any) -> Any:
    """Sector angle in phase I."""
    return sector_stop_sweep * (law_position - number(1) / 2)


@formula
def returning_angle(sector_dwell_sweep: Any, sector_stop_sweep: Any, sector_sweep: Any, law_position: Any) -> Any:
    """Sector angle in phase IV."""
    return sector_dwell_sweep + sector_stop_sweep / 2 - sector_sweep * law_position


@formula
def rise_speed(sweep: Any, time: Any, law_velocity: Any) -> Any:
    """Speed of a rise by the law."""
    return sweep / time * law_velocity


@formula
def rise_acceleration(sweep: Any, time: Any, law_acceleration: Any, cycles_per_hour: Any) -> Any:
    """Acceleration of a rise by the law."""
    return sweep * (cycles_per_hour / time) ** 2 * law_acceleration


@formula
def gear_speed(sector_speed: Any, sector_radius: Any, gear_radius: Any) -> Any:
    """Speed of the gear in rad for each turn of the disc."""
    return 2 * pi - sector_radius / gear_radius * sector_speed


@formula
def gear_acceleration(sector_acceleration: Any, sector_radius: Any, gear_radius: Any) -> Any:
    """Angular acceleration of the gear."""
    return -sector_radius / gear_radius * sector_acceleration


@formula
def carried_moment(rocker_moment: Any, arm_direction: Any) -> Any:
    """Part of the moment that this roller's cam gives: it can only push the roller outwards."""
    asked = -np.sign(np.sin(arm_direction)) * rocker_moment
    return (asked + abs(asked)) / 2


@formula
def lowest_direction(arm_angle: Any, sector_stop_sweep: Any) -> Any:
    """Direction of an arm at the start of phase I."""
    return arm_angle - sector_stop_sweep / 2


@formula
def highest_direction(lowest: Any, sector_sweep: Any) -> Any:
    """Direction of an arm at the end of phase III."""
    return lowest + sector_sweep


@formula
def stays_on_one_side(lowest: Any, highest: Any) -> Any:
    """Whether an arm stays on one side of the line O₁O₃ (its sweep is below half a turn)."""
    return np.sin(lowest) * np.sin(highest) > 1e-12  # on the line itself the cams could not move the arm
