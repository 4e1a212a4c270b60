"""Chapters on the stations below the upper strand, and on the grippers' cam."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import Chapter, abscissa, inner, m, part, pi, running

# fmt: off


def out_of_order(position: Any) -> Any:
    """Return for each station the index of the next one, where that is not nearer to the driving sprocket; else -1."""
    following = np.append(position[:, 1:], np.full((len(position), 1), -np.inf), axis=1)
    return np.where(following >= position, np.arange(1, position.shape[1] + 1), -1)


stations = Chapter(
    "Stations", text="A worn chain is longer: a bar lags more, the farther it is from the sprocket that pulls it."
)
stations.clash(
    "in_order",
    out_of_order,
    takes=("stations.position",),
    key="stations.{index}.position",
    message="is the place of station {part}, and station {other} is not nearer to the driving sprocket; list the stations as a sheet passes them, "
    "the farthest first",
)
stations.require("on_the_strand", m.stations.position <= m.centre_distance, key="stations.{index}.position",
    message="puts station {part} beyond the other sprocket, whose axis is {centre_distance} away; move it, or make centre_distance greater")
stations.first_position = (part(of="stations.position", index=0, output=False),
    "s_1", "mm", "Distance of the first station")
stations.transit_time = ((m.first_position - m.stations.position) / m.chain_speed,
    "t_i", "s", "Time since the first station", "kinematics")
stations.drag_so_far = (running("sum", of="stations.drag", output=False),
    "D_Σi", "N", "Drag of the stations up to this one")
behind = (m.centre_distance - m.stations.position) / m.centre_distance
stations.strand_pull = (m.slack_tension + m.centrifugal_tension + m.drag_so_far / 2 + m.rail_drag * behind,
    "F_i", "N", "Mean pull of a chain behind the station", "statics")
stations.shift = (m.elongation * m.stations.position + m.ripple_max,
    "Δ_i", "mm", "Shift of the sheet's front edge by wear and polygon", "geometry")
allowed = np.maximum((m.allowable_shift - m.ripple_max) / m.first_position, 0)
stations.elongation_allowed = (inner(allowed, needs=("allowable_shift",)),
    "ε_lim", "%", "Elongation at which the first station is still met")

cycle = Chapter(
    "Cycle of a bar",
    needs=("cam",),
    absent="not calculated: cam is not given",
    text="One revolution of the main shaft moves the chain by one spacing of the bars; at φ = 0 a bar is at the pick-up point.",
)
cycle.require("cam_shorter", m.cam.before + m.cam.after < m.bar_spacing, key="cam.before",
    message="is {cam.before}, with {cam.after} behind the pick-up point; together they must be less than the spacing of the bars {bar_spacing}")
cycle.main_speed = 2 * pi * m.sheet_rate, "ω_m", "rpm", "Speed of the main shaft"
cycle.opening_begins = (2 * pi * (1 - m.cam.before / m.bar_spacing),
    "φ_1", "deg", "Main-shaft angle at which the grippers begin to open")
cycle.opening_ends = (2 * pi * m.cam.after / m.bar_spacing,
    "φ_2", "deg", "Main-shaft angle at which they are closed again")
cycle.main_angle = abscissa(2 * np.pi, speed="main_speed", shown_at="opening_begins"), "φ", "deg", "Main-shaft angle"
cycle.breakpoints("cam_ends", "main_angle", "opening_begins", "opening_ends")
cycle.phase(
    "picking", "working", "The grippers are open and take a sheet", "main_angle", ("opening_begins", "opening_ends")
)
cycle.phase("carrying", "moving", "The bar carries its sheet", "main_angle", rest_of=("picking",))
cycle.is_open = (inner((m.main_angle > m.opening_begins) | (m.main_angle < m.opening_ends), per_piece=True),
    "o", "1", "Whether the grippers are open")
since = m.main_angle - m.opening_begins
cycle.cam_angle = (inner(np.where(m.main_angle >= m.opening_begins, since, m.main_angle + 2 * pi - m.opening_begins)),
    "ψ", "deg", "Rotation of the main shaft since the grippers began to open")
cycle.cam_length = (inner(2 * pi * (m.cam.before + m.cam.after) / m.bar_spacing),
    "ψ_c", "deg", "Rotation of the main shaft over the whole cam")
cycle.gripper_opening = (np.where(m.is_open > 0, m.cam.opening * np.sin(pi * m.cam_angle / m.cam_length) ** 2, 0),
    "h_φ", "mm", "Opening of the grippers", "this method")
cycle.opening_time = (m.cam.before + m.cam.after) / m.chain_speed, "t_o", "ms", "Time in which the grippers are open"
