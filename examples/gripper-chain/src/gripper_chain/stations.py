"""Chapters on the stations below the upper strand, and on the grippers' cam."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import Chapter, bind


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
stations.require(
    "on_the_strand",
    bind(lambda position, centre_distance: position <= centre_distance, position="stations.position"),
    key="stations.{index}.position",
    message="puts station {part} beyond the other sprocket, whose axis is {centre_distance} away; move it, or make centre_distance greater",
)
stations.part(
    "first_position", "s_1", "mm", "Distance of the first station", of="stations.position", index=0, output=False
)
stations.value(
    "transit_time",
    "t_i",
    "s",
    "Time since the first station",
    bind(
        lambda first, position, chain_speed: (first - position) / chain_speed,
        first="first_position",
        position="stations.position",
    ),
    source="kinematics",
)
stations.running(
    "drag_so_far", "D_Σi", "N", "Drag of the stations up to this one", "sum", of="stations.drag", output=False
)
stations.value(
    "strand_pull",
    "F_i",
    "N",
    "Mean pull of a chain behind the station",
    bind(
        lambda slack_tension, centrifugal_tension, drag_so_far, rail_drag, position, centre_distance: (
            slack_tension
            + centrifugal_tension
            + drag_so_far / 2
            + rail_drag * (centre_distance - position) / centre_distance
        ),
        position="stations.position",
    ),
    source="statics",
)
stations.value(
    "shift",
    "Δ_i",
    "mm",
    "Shift of the sheet's front edge by wear and polygon",
    bind(lambda elongation, position, ripple_max: elongation * position + ripple_max, position="stations.position"),
    source="geometry",
)
stations.value(
    "elongation_allowed",
    "ε_lim",
    "%",
    "Elongation at which the first station is still met",
    lambda allowable_shift, ripple_max, first_position: np.maximum((allowable_shift - ripple_max) / first_position, 0),
    needs=("allowable_shift",),
    output=False,
)

cycle = Chapter(
    "Cycle of a bar",
    needs=("cam",),
    absent="not calculated: cam is not given",
    text="One revolution of the main shaft moves the chain by one spacing of the bars; at φ = 0 a bar is at the pick-up point.",
)
cycle.require(
    "cam_shorter",
    bind(lambda before, after, bar_spacing: before + after < bar_spacing, before="cam.before", after="cam.after"),
    key="cam.before",
    message="is {cam.before}, with {cam.after} behind the pick-up point; together they must be less than the spacing of the bars {bar_spacing}",
)
cycle.value("main_speed", "ω_m", "rpm", "Speed of the main shaft", lambda sheet_rate: 2 * np.pi * sheet_rate)
cycle.value(
    "opening_begins",
    "φ_1",
    "deg",
    "Main-shaft angle at which the grippers begin to open",
    bind(lambda before, bar_spacing: 2 * np.pi * (1 - before / bar_spacing), before="cam.before"),
)
cycle.value(
    "opening_ends",
    "φ_2",
    "deg",
    "Main-shaft angle at which they are closed again",
    bind(lambda after, bar_spacing: 2 * np.pi * after / bar_spacing, after="cam.after"),
)
cycle.abscissa("main_angle", "φ", "deg", "Main-shaft angle", 2 * np.pi, speed="main_speed", shown_at="opening_begins")
cycle.breakpoints("cam_ends", "main_angle", "opening_begins", "opening_ends")
cycle.phase(
    "picking", "working", "The grippers are open and take a sheet", "main_angle", ("opening_begins", "opening_ends")
)
cycle.phase("carrying", "moving", "The bar carries its sheet", "main_angle", rest_of=("picking",))
cycle.value(
    "is_open",
    "o",
    "1",
    "Whether the grippers are open",
    lambda main_angle, opening_begins, opening_ends: (main_angle > opening_begins) | (main_angle < opening_ends),
    per_piece=True,
    output=False,
)
cycle.value(
    "cam_angle",
    "ψ",
    "deg",
    "Rotation of the main shaft since the grippers began to open",
    lambda main_angle, opening_begins: np.where(
        main_angle >= opening_begins, main_angle - opening_begins, main_angle + 2 * np.pi - opening_begins
    ),
    output=False,
)
cycle.value(
    "cam_length",
    "ψ_c",
    "deg",
    "Rotation of the main shaft over the whole cam",
    bind(
        lambda before, after, bar_spacing: 2 * np.pi * (before + after) / bar_spacing,
        before="cam.before",
        after="cam.after",
    ),
    output=False,
)
cycle.value(
    "gripper_opening",
    "h_φ",
    "mm",
    "Opening of the grippers",
    bind(
        lambda is_open, opening, cam_angle, cam_length: np.where(
            is_open > 0, opening * np.sin(np.pi * cam_angle / cam_length) ** 2, 0
        ),
        opening="cam.opening",
    ),
    source="this method",
)
cycle.value(
    "opening_time",
    "t_o",
    "ms",
    "Time in which the grippers are open",
    bind(lambda before, after, chain_speed: (before + after) / chain_speed, before="cam.before", after="cam.after"),
)
