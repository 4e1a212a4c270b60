"""Chapters on the sheet: its sides against cylinder and step, the rate that it comes at, its register, what moves it."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import Chapter, as_angle, as_number, bind, case, formula
from diecut_report.mechanics import common
from diecut_report.plugins.press_consistency import on_main_shaft

# fmt: off

BY_WIDTH, BY_LENGTH = ("feed_side=width",), ("feed_side=length",)
CONVEYOR = ("conveyor_mass", "travel_radius", "wheel_inertia")



@formula
def actual_rate(output_speed: Any, turns_a_sheet: Any) -> Any:
    """Sheets in a time at a speed of the output."""
    return as_number(output_speed) / (as_number(2 * np.pi) * turns_a_sheet)


@formula
def turns_like_main_shaft(output_speed: Any, crank_speed: Any, productivity: Any) -> Any:
    """Whether a speed is nearer to a turn a sheet than to the crank's speed, by their ratios."""
    to_shaft = output_speed / (2 * np.pi * productivity)
    to_crank = output_speed / crank_speed
    return np.maximum(to_shaft, 1 / to_shaft) < np.maximum(to_crank, 1 / to_crank)


SIDES = {"sheet_width": bind(common.same, quantity="sheet_width"), "sheet_length": bind(common.same, quantity="sheet_length")}

sides = Chapter("Sheet, cylinder and step",
    text="The cylinder must unroll over the whole dimension of the sheet in the feed direction, and extend over the whole dimension across it; a "
        "step of the transport covers a sheet and the gap between two.")
for feed, length, width in ((BY_WIDTH, "sheet_length", "sheet_width"), (BY_LENGTH, "sheet_width", "sheet_length")):
    sides.value("side_in_feed", "s_f", "mm", f"Dimension of the sheet in the feed direction: its {width.removeprefix('sheet_')}", SIDES[width],
        source="input", needs=(*feed, width))
    sides.value("side_across", "s_a", "mm", f"Dimension across the feed: its {length.removeprefix('sheet_')}", SIDES[length], source="input",
        needs=(*feed, length))
    sides.value("step_room", "Δs", "mm", "Gap between two sheets after a step", lambda sheet_step, side_in_feed: sheet_step - side_in_feed,
        source="geometry", needs=(*feed, width, "sheet_step"))

WAYS = ((("output_turns_per_sheet",), ()), (("crank_speed",), ("output_turns_per_sheet",)))
"""How the turns of the output for each sheet are known."""

rate = Chapter("Rate given by the gears",
    text="Gears have whole teeth and pulleys standard diameters, so the press runs slightly off its productivity. Under the mean torque, which is "
        "below its rated torque, the motor runs faster than at its rated speed, and so does the press.", needs=("output_speed", "productivity"),
    absent="not calculated: the drive train's output_speed and productivity are not both given")
rate.value("turns_a_sheet", "i_o", "1", "Revolutions of the output per sheet: as given", lambda output_turns_per_sheet: output_turns_per_sheet,
    source="input", needs=("output_turns_per_sheet",))
rate.choice("turns_a_sheet", "i_o", "1", "Revolutions of the output per sheet",
    case(lambda: 1, "the output is closer in speed to the main shaft than to the crank", turns_like_main_shaft),
    case(lambda crank_speed, productivity: np.maximum(np.round(as_number(crank_speed) / as_number(np.pi * productivity)), 1) / 2,
        "the output turns with the crank, whole half turns for a sheet"), source="kinematics",
    needs=("crank_speed",), lacks=("output_turns_per_sheet",))
rate.value("rate_asked", "n_0", "1/h", "Required sheet rate", lambda required_rate: required_rate, source="input", output=False,
    needs=("required_rate",))
rate.value("rate_asked", "n_0", "1/h", "Required sheet rate", lambda productivity: productivity, source="input", output=False,
    lacks=("required_rate",))
for needs, lacks in WAYS:
    rate.value("actual_rate", "n_a", "1/h", "Sheet rate at the motor's rated speed", actual_rate, source="kinematics", needs=needs, lacks=lacks)
    rate.value("rate_error", "Δn", "%", "Relative excess over its productivity", lambda actual_rate, productivity: actual_rate / productivity - 1,
        source="kinematics", needs=needs, lacks=lacks)
    rate.value("true_rate", "n_t", "1/h", "Sheet rate at the speed of the motor under the mean torque",
        bind(actual_rate, output_speed="loaded_output_speed"), source="kinematics", needs=(*needs, "loaded_output_speed"), lacks=lacks)
    rate.value("load_rise", "Δ_a", "%", "Relative increase of the accelerations", lambda true_rate, productivity: (true_rate / productivity) ** 2 - 1,
        source="kinematics", needs=(*needs, "loaded_output_speed"), lacks=lacks)
    rate.value("least_rate", "n_min", "1/h", "Lower of the two rates", lambda actual_rate, true_rate: np.minimum(actual_rate, true_rate),
        source="kinematics", output=False, needs=(*needs, "loaded_output_speed"), lacks=lacks)
    rate.value("least_rate", "n_min", "1/h", "Known rate", lambda actual_rate: actual_rate, source="kinematics", output=False, needs=needs,
        lacks=(*lacks, "loaded_output_speed"))
    rate.listing("times", "Times at the rate given by the gears", on_main_shaft.TIMES, on_main_shaft.times, ("timing", "productivity", "actual_rate"),
        needs=("timing", *needs), lacks=lacks)

STOPPED = ("brake_torque", "flywheel_inertia", "flywheel_speed", "shaft_torque_mean", "lines_energy", "productivity", "output_speed")
stopping = Chapter("Stopping", needs=STOPPED, text="Brake and mean load absorb the energy of flywheel, shafts and lines; the speed falls linearly.",
    absent="not calculated: brake_torque is not given, or flywheel and cyclogram are not there")
stopping.value("energy_running", "E_0", "J", "Kinetic energy of flywheel, shafts and lines",
    lambda flywheel_inertia, flywheel_speed, shafts_energy, lines_energy: flywheel_inertia * flywheel_speed**2 / 2 + shafts_energy + lines_energy,
    source="energy")
stopping.value("stopping_angle", "Φ_b", "deg", "Main-shaft rotation to standstill",
    lambda energy_running, brake_torque, shaft_torque_mean: as_angle(energy_running / (brake_torque + shaft_torque_mean)), source="energy")
for needs, lacks in WAYS:
    stopping.value("stopping_time", "t_b", "s", "Time to standstill",
        lambda stopping_angle, actual_rate: 2 * as_number(stopping_angle) / (as_number(2 * np.pi) * actual_rate), source="kinematics", needs=needs,
        lacks=lacks)

conveyor = Chapter("Inertia of the conveyor", needs=CONVEYOR,
    text="The inertia is the conveyor's mass times the square of its displacement per radian of the wheel.",
    absent="not calculated: {missing} not given")
conveyor.value("conveyor_inertia", "J_m", "kg*m**2", "Moment of inertia of the conveyor's mass at the wheel's shaft",
    lambda conveyor_mass, travel_radius: conveyor_mass * travel_radius**2, source="energy")
conveyor.value("moved_inertia", "J_Σ", "kg*m**2", "Moment of inertia of everything that the wheel moves, at its shaft",
    lambda conveyor_inertia, wheel_side_inertia: conveyor_inertia + wheel_side_inertia, source="energy", needs=("wheel_side_inertia",))
conveyor.value("moved_inertia", "J_Σ", "kg*m**2", "Moment of inertia at the wheel's shaft, without the parts that turn with it",
    lambda conveyor_inertia: conveyor_inertia, source="energy", lacks=("wheel_side_inertia",))
conveyor.value("inertia_error", "Δ_J", "%", "Relative difference of the inertia used in the wheel's calculation",
    lambda wheel_inertia, moved_inertia: abs(wheel_inertia / moved_inertia - 1), source="energy")

dwell = Chapter("Dwell and the phases within it", needs=("timing", "wheel", "cover_angle"),
    text="The wheel has the largest play just after its exit and just before its entry; the smaller the margins of the timing, the larger the play.",
    absent="not calculated: there is no cyclogram, or the wheel's cover_angle is not given")
dwell.computed("held_in_dwell", "N_d", "1", "Number of interlocks that contain something within the wheel's dwell", on_main_shaft.held_in_dwell,
    ("timing", "wheel"), "as given", output=False)
dwell.computed("dwell_margin", "φ_m", "deg", "Minimum angle of the wheel's crank between an end of the dwell and what must lie within it",
    on_main_shaft.dwell_margin, ("timing", "wheel"), "smaller margin of each interlock, multiplied by the revolutions of the line per sheet",
    exists=lambda held_in_dwell: held_in_dwell > 0)

register = Chapter("Register",
    text="Plays add up, since each may be at its limit; a step of whole pitches stops the chain in the same position each time.")
register.value("play_total", "Δx_Σ", "mm", "Total play of transport and lines", lambda sheet_play, backlash: sheet_play + backlash, source="geometry",
    needs=("sheet_play",))
register.value("pitches", "n_p", "1", "Chain pitches per step", lambda sheet_step, chain_pitch: sheet_step / chain_pitch, source="geometry",
    needs=("sheet_step", "chain_pitch"), digits=10)
register.value("pitch_error", "Δn_p", "1", "Deviation from a whole number", lambda pitches: abs(pitches - np.floor(pitches + 1 / 2)),
    source="geometry", needs=("sheet_step", "chain_pitch"))
register.value("loop_steps", "n_l", "1", "Steps in which the gripper chain goes round once", lambda chain_links, pitches: chain_links / pitches,
    source="geometry", needs=("sheet_step", "chain_pitch", "chain_links"), digits=10)
register.value("loop_error", "Δn_l", "1", "Deviation from a whole number", lambda loop_steps: abs(loop_steps - np.floor(loop_steps + 1 / 2)),
    source="geometry", needs=("sheet_step", "chain_pitch", "chain_links"))
register.value("speed_ripple", "ε_v", "%", "Speed ripple of the chain due to the polygon effect",
    lambda sprocket_teeth: 1 - np.cos(np.pi / sprocket_teeth), source="geometry", needs=("sprocket_teeth",))
