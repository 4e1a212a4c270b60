"""Chapters on the sheet and on the drive of a press."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import Chapter, as_angle, as_number, bind, case, formula, number, pi
from diecut_report.mechanics import common
from diecut_report.mechanics.timing import engagement as motor_slip
from diecut_report.mechanics.timing.engagement import inertia_at_crank
from diecut_report.plugins.press_consistency import relations

# fmt: off

BY_WIDTH, BY_LENGTH = ("feed_side=width",), ("feed_side=length",)
CONVEYOR = ("conveyor_mass", "travel_radius", "wheel_inertia")


@formula
def actual_rate(output_speed: Any, turns_a_sheet: Any) -> Any:
    """Sheets in a time at a speed of the output."""
    return as_number(output_speed) / (as_number(2 * pi) * turns_a_sheet)


@formula
def turns_like_main_shaft(output_speed: Any, crank_speed: Any, productivity: Any) -> Any:
    """Whether a speed is nearer to a turn a sheet than to the crank's speed, by their ratios."""
    to_shaft = output_speed / (2 * pi * productivity)
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
    case(lambda crank_speed, productivity: np.maximum(np.round(as_number(crank_speed) / as_number(pi * productivity)), 1) / 2,
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
    rate.listing("times", "Times at the rate given by the gears", relations.TIMES, relations.times, ("timing", "productivity", "actual_rate"),
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
        lambda stopping_angle, actual_rate: 2 * as_number(stopping_angle) / (as_number(2 * pi) * actual_rate), source="kinematics", needs=needs,
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
dwell.computed("held_in_dwell", "N_d", "1", "Number of interlocks that contain something within the wheel's dwell",
    lambda timing, wheel: len(relations.dwell_margins(timing, wheel)), ("timing", "wheel"), "as given", output=False)
dwell.computed("dwell_margin", "φ_m", "deg", "Minimum angle of the wheel's crank between an end of the dwell and what must lie within it",
    lambda timing, wheel: min(relations.dwell_margins(timing, wheel), default=0.0), ("timing", "wheel"),
    "smaller margin of each interlock, multiplied by the revolutions of the line per sheet",
    exists=lambda held_in_dwell: held_in_dwell > 0)

register = Chapter("Register",
    text="Plays add up, since each may be at its limit; a step of whole pitches stops the chain in the same position each time.")
register.value("play_total", "Δx_Σ", "mm", "Total play of transport and lines", lambda sheet_play, backlash: sheet_play + backlash, source="geometry",
    needs=("sheet_play",))
register.value("pitches", "n_p", "1", "Chain pitches per step", lambda sheet_step, chain_pitch: sheet_step / chain_pitch, source="geometry",
    needs=("sheet_step", "chain_pitch"), digits=10)
register.value("pitch_error", "Δn_p", "1", "Deviation from a whole number", lambda pitches: abs(pitches - np.floor(pitches + number(1) / 2)),
    source="geometry", needs=("sheet_step", "chain_pitch"))
register.value("loop_steps", "n_l", "1", "Steps in which the gripper chain goes round once", lambda chain_links, pitches: chain_links / pitches,
    source="geometry", needs=("sheet_step", "chain_pitch", "chain_links"), digits=10)
register.value("loop_error", "Δn_l", "1", "Deviation from a whole number", lambda loop_steps: abs(loop_steps - np.floor(loop_steps + number(1) / 2)),
    source="geometry", needs=("sheet_step", "chain_pitch", "chain_links"))
register.value("speed_ripple", "ε_v", "%", "Speed ripple of the chain due to the polygon effect",
    lambda sprocket_teeth: 1 - np.cos(pi / sprocket_teeth), source="geometry", needs=("sprocket_teeth",))


CYLINDER = ("cylinder_mass", "cylinder_inertia", "cylinder_radius", "cylinder_rotation", "cylinder_speed", "crank_speed")
ENGAGED = (*CYLINDER, "dead_center_outer", "dead_center_inner", "clutch_torque", "clutch_speed")
TRAVEL = ("displacement", "velocity", "stroke", "dead_center_outer", "dead_center_inner")
MOTOR = ("flywheel_torque", "output_speed", "flywheel_inertia", "flywheel_speed", "belt_ratio", "motor_rated_torque", "motor_speed",
         "synchronous_speed")

inertia = Chapter("Equivalent inertia at the crank",
    text="The inertia of equal kinetic energy; it is zero where the cylinder stands, and the unbalance makes it differ between the strokes.",
    needs=CYLINDER, absent="not calculated: there is no cylinder drive to use, or there are several")
inertia.abscissa("crank_angle", "φ", "deg", "Crank angle", 2 * np.pi, shown_at="crank_inertia_max_at")
inertia.from_curve("rotation", "θ", "deg", "Rotation of the cylinder", given="cylinder_rotation", abscissa="crank_angle", output=False)
inertia.from_curve("speed", "ω_z", "rad/s", "Speed of the cylinder", given="cylinder_speed", abscissa="crank_angle", output=False)
inertia.value("speed_ratio", "ω_31", "1", "Ratio of the cylinder's speed to the crank's", lambda speed, crank_speed: speed / crank_speed,
    source="kinematics", output=False)
inertia.value("crank_inertia", "I_red", "kg*m**2", "Equivalent inertia at the crank",
    bind(inertia_at_crank, rotation="rotation", speed_ratio="speed_ratio"), source="energy")
inertia.reduction("crank_inertia_mean", "I_m", "kg*m**2", "Mean equivalent inertia at the crank over a revolution, for the run-up", "mean",
    of="crank_inertia")
inertia.reduction("crank_inertia_max", "I_max", "kg*m**2", "Maximum equivalent inertia at the crank", "max", of="crank_inertia")

engagement = Chapter("Engagement of the clutch",
    text="From rest the net torque M′ accelerates the crank to ω(φ) = √(2M′(φ − φ₀)/I_red(φ)); the slip ends where this first reaches the speed of "
        "the driving side, at the crank. The equal inertia is the constant one at the clutch that would generate the same heat.", needs=ENGAGED,
    absent="not calculated: there is no clutch or no cylinder drive to use, or there are several")
engagement.require("clutch_pulls", lambda clutch_load, clutch_torque: clutch_load < clutch_torque, key="clutch_load",
    message="is {clutch_load}, but the slipping clutch carries {clutch_torque} only: the driven side never comes up to speed; lower the load while "
        "engaging")
RATIO = ("clutch_ratio", "i_c", "1")
ON_OUTPUT = ("output_speed", "output_turns_per_sheet", "productivity")
engagement.require("one_ratio",
    bind(lambda clutch_turns, clutch_speed, crank_speed, tolerance:
        abs(clutch_speed - clutch_turns * crank_speed) <= tolerance * clutch_turns * crank_speed, tolerance=relations.ONE_SHAFT),
    key="clutch_turns", needs=("clutch_turns",),
    message="is {clutch_turns}, but the clutch turns at {clutch_speed} and the crank at {crank_speed}; give their ratio, or leave the key out")
engagement.require("one_position", lambda: 0 >= 1, key="engagement_angle", needs=("engagement_angle",), lacks=("single_position=true",),
    message="is {engagement_angle}, but a friction clutch engages at any angle; say single_position where a pin lets it engage there alone, or "
        "leave the key out")
engagement.value(*RATIO, "Revolutions of the clutch per revolution of the crank: as given", lambda clutch_turns: clutch_turns, source="input",
    needs=("clutch_turns",), output=False)
ON_CRANK = case(lambda: 1, "it is on the crank's shaft: its driving side is at most a tenth faster or slower",
    bind(lambda clutch_speed, crank_speed, tolerance: abs(clutch_speed - crank_speed) <= tolerance * crank_speed, tolerance=relations.ONE_SHAFT))
ELSEWHERE = case(lambda clutch_speed, crank_speed: clutch_speed / crank_speed, "it is on another shaft")
engagement.choice(*RATIO, "Revolutions of the clutch per revolution of the crank", ON_CRANK,
    case(lambda output_turns_per_sheet, productivity, crank_speed:
        output_turns_per_sheet * productivity * as_number(2 * pi) / as_number(crank_speed), "it is on the drive train's output",
        bind(lambda clutch_speed, output_speed, tolerance: abs(clutch_speed - output_speed) <= tolerance * output_speed, tolerance=relations.SAME)),
    ELSEWHERE, source="kinematics", needs=ON_OUTPUT, lacks=("clutch_turns",), output=False)
for lacking in ON_OUTPUT:
    engagement.choice(*RATIO, "Revolutions of the clutch per revolution of the crank", ON_CRANK, ELSEWHERE, source="kinematics",
        needs=ON_OUTPUT[: ON_OUTPUT.index(lacking)], lacks=("clutch_turns", lacking), output=False)
engagement.value("net_torque", "M′", "N*m", "Accelerating torque at the crank",
    lambda clutch_torque, clutch_load, clutch_ratio: (clutch_torque - clutch_load) * clutch_ratio, source="mechanics")
engagement.prepared("slip", relations.engagement, (*relations.TAKES, "engagement_angle"), for_many=True)
engagement.value("start_angle", "φ_0", "deg", "Crank angle of the engagement: as given", lambda engagement_angle: engagement_angle, source="input",
    needs=("engagement_angle",))
engagement.computed("start_angle", "φ_0", "deg", "Crank angle of the engagement: the one with the most heat",
    lambda slip: slip.engagement_angle[:, None], ("slip",), "all crank angles tried", source="this method", lacks=("engagement_angle",))
engagement.computed("slip_time", "t_s", "ms", "Slip time", lambda slip: slip.time[:, None], ("slip",), "Gauss–Legendre", source="this method")
engagement.computed("driven_angle", "Δφ", "deg", "Rotation of the crank during slip", lambda slip: slip.driven_angle[:, None], ("slip",),
    "root of equal speeds", source="this method")
engagement.value("lag_angle", "Δφ_l", "deg", "Additional rotation of the driving side, at the crank",
    lambda clutch_speed, clutch_ratio, slip_time, driven_angle: clutch_speed / clutch_ratio * slip_time - driven_angle, source="kinematics")
engagement.value("slip_heat", "Q", "J", "Heat of the engagement, with the varying inertia",
    lambda clutch_torque, clutch_ratio, lag_angle: clutch_torque * clutch_ratio * lag_angle, source="energy")
BEHIND, NAMED = ("is_behind", "b_z", "1", "Cylinder behind the clutch (1) or not (0)"), ("clutch_drives", "drive")
engagement.computed(*BEHIND, lambda drives, drive: float(drive.name in drives), NAMED, "as given", needs=NAMED, output=False, printed=False)
for lacks in (("clutch_drives",), ("drive",)):
    engagement.value(*BEHIND, lambda: 1, needs=NAMED[: NAMED.index(lacks[0])], lacks=lacks, output=False, printed=False)
engagement.value("equal_inertia", "I_eq", "kg*m**2", "Constant inertia at the clutch that would generate the same heat",
    lambda slip_heat, clutch_load, clutch_torque, clutch_speed: 2 * slip_heat * (1 - clutch_load / clutch_torque) / clutch_speed**2, source="energy",
    exists=lambda is_behind: is_behind > 0)

coupling = Chapter("Clutch and offsets of the lines", needs=("timing", "clutch_drives", "clutch_torque"),
    absent="not calculated: clutch_drives is not given, or there is no clutch or no cyclogram to use")
coupling.computed("lines_out_of_step", "N_c", "1", "Number of lines that lose synchronism with the others when the clutch engages",
    function=relations.lines_out_of_step, takes=("clutch_drives", "single_position", "timing"),
    method="those driven through the clutch, unless these are all or it engages at one angle only", source="kinematics")
coupling.computed("lines_beside", "N_b", "1", "Number of lines behind the clutch whose inertia is not compared with that of its calculation",
    lambda drives, drive: float(len({*drives} - {drive.name})), ("clutch_drives", "drive"),
    "those driven through the clutch but for the cylinder's", output=False, needs=("drive",))
coupling.words("clutch_lines", relations.listed, ("clutch_drives",))

ends_chapter = Chapter("Speed before the ends of the travel", needs=TRAVEL,
    text="The drive brings the cylinder to rest by itself; dampers that are met before the ends absorb its remaining energy there.",
    absent="not calculated: there is no cylinder drive to use, or there are several")
ends_chapter.require("contact_within_stroke", lambda contact_distance, stroke: contact_distance < stroke, key="contact_distance",
    message="is {contact_distance}, but the whole stroke is {stroke}; dampers are met shortly before its ends", needs=("contact_distance",))
ends_chapter.computed("contact_speed_inner", "v_in", "m/s", "Speed at contact before the inner end",
    function=lambda displacement, velocity, stroke, outer, inner, way: relations.speed_at(displacement, velocity, outer, inner, stroke - way),
    takes=(*relations.INNER, "contact_distance"), method="nested search", source="kinematics", needs=("contact_distance",))
ends_chapter.computed("contact_speed_outer", "v_out", "m/s", "Speed at contact before the outer end",
    function=lambda displacement, velocity, stroke, outer, inner, way: relations.speed_at(displacement, velocity, inner, outer + 2 * np.pi, way),
    takes=(*relations.INNER, "contact_distance"), method="nested search", source="kinematics", needs=("contact_distance",))
ends_chapter.value("contact_speed", "v_k", "m/s", "Higher speed at contact",
    lambda contact_speed_inner, contact_speed_outer: np.maximum(contact_speed_inner, contact_speed_outer), source="kinematics",
    needs=("contact_distance",))
ends_chapter.choice("end_impacts", "z_e", "1/h", "Impacts at one end of the travel",
    case(lambda: 0, "dampers at the ends themselves are not met in any stroke", lambda contact_distance: contact_distance <= 0),
    case(lambda crank_speed: as_number(crank_speed) / as_number(2 * pi), "dampers before the ends are met in every revolution"),
    source="kinematics", needs=("contact_distance", "crank_speed"))
ends_chapter.computed("way_inner", "d_in", "mm", "Distance before the inner end at which the speed used in the dampers' calculation occurs",
    function=lambda displacement, velocity, stroke, outer, inner, speed: relations.way_below(displacement, velocity, outer, inner, speed, stroke),
    takes=(*relations.INNER, "damper_velocity"), method="nested search", source="kinematics", needs=("damper_velocity",))
ends_chapter.computed("way_outer", "d_out", "mm", "Distance before the outer end at which it occurs",
    function=lambda displacement, velocity, stroke, outer, inner, speed:
        relations.way_below(displacement, velocity, inner, outer + 2 * np.pi, speed, stroke),
    takes=(*relations.INNER, "damper_velocity"), method="nested search", source="kinematics", needs=("damper_velocity",))

ends_chapter.value("stopped_mass", "m_s", "kg", "Mass that moves with the cylinder's axis, with the carriages",
    lambda damper_mass, carriage_mass: damper_mass + carriage_mass, source="this method", needs=("damper_mass", "carriage_mass"))

motor_chapter = Chapter("Motor behind its flywheel",
    text="With linear slip the motor follows the load as a first-order lag, M_m + τ·dM_m/dt = M_f: a flywheel shields it only if τ is long compared "
        "with the time of a stroke.", needs=MOTOR, absent="not calculated: there is no drive train with a torque curve to use, or there are several")
motor_chapter.require("motor_slips", lambda motor_speed, synchronous_speed: motor_speed < synchronous_speed, key="motor_speed",
    message="is {motor_speed}, but a motor under load turns slower than its synchronous speed {synchronous_speed}")
motor_chapter.value("load_period", "T_f", "ms", "Time after which the load repeats",
    lambda load_turns, output_speed: load_turns * as_number(2 * pi) / as_number(output_speed), source="kinematics")
motor_chapter.value("slip_stiffness", "k", "N*m*s/rad", "Torque of the motor per unit of slip speed",
    bind(motor_slip.slip_stiffness, rated_torque="motor_rated_torque", rated_speed="motor_speed"), source="this method")
motor_chapter.value("flywheel_stiffness", "k_f", "N*m*s/rad", "The same at the flywheel's shaft",
    bind(motor_slip.stiffness_at_flywheel, ratio="belt_ratio", efficiency="belt_efficiency"), source="energy")
motor_chapter.value("time_constant", "τ", "ms", "Time constant of the lag",
    bind(motor_slip.time_constant, inertia="flywheel_inertia", stiffness_at_flywheel="flywheel_stiffness"), source="this method")
motor_chapter.prepared("response", relations.response, ("flywheel_torque", "load_turns", "load_period", "time_constant"), for_many=True)
for name, symbol, words, function in (
    ("lagged_rms", "M_f,rms", "Root mean square torque of the motor at the flywheel's shaft", lambda response: response.rms[:, None]),
    ("lagged_max", "M_f,max", "Maximum torque of the motor at the flywheel's shaft", lambda response: response.largest[:, None]),
    ("lagged_min", "M_f,min", "Minimum torque of the motor at the flywheel's shaft; negative where it brakes", lambda response: response.least[:,
                                                                                                                                               None])):
    motor_chapter.computed(name, symbol, "N*m", words, function, ("response",), "exponentials on smooth pieces", source="this method", output=False)
motor_chapter.value("motor_torque_rms", "M_rms", "N*m", "Root mean square torque of the motor",
    lambda lagged_rms, belt_ratio, belt_efficiency: lagged_rms / (belt_ratio * belt_efficiency), source="energy")
motor_chapter.value("motor_torque_max", "M_max", "N*m", "Maximum torque of the motor",
    lambda lagged_max, belt_ratio, belt_efficiency: lagged_max / (belt_ratio * belt_efficiency), source="energy")
motor_chapter.value("motor_torque_min", "M_min", "N*m", "Minimum torque of the motor",
    lambda lagged_min, belt_ratio, belt_efficiency: lagged_min / (belt_ratio * belt_efficiency), source="energy")
motor_chapter.value("motor_torque_peak", "M_peak", "N*m", "Maximum absolute torque of the motor",
    lambda motor_torque_max, motor_torque_min: np.maximum(abs(motor_torque_max), abs(motor_torque_min)), source="this method")
motor_chapter.value("breakdown_torque", "M_br", "N*m", "Breakdown torque of the motor",
    lambda breakdown_ratio, motor_rated_torque: breakdown_ratio * motor_rated_torque, source="this method", needs=("breakdown_ratio",))
motor_chapter.value("speed_swing", "δ_a", "1", "Speed fluctuation of the flywheel: (maximum − minimum)/mean",
    lambda lagged_max, lagged_min, flywheel_stiffness, flywheel_speed: (lagged_max - lagged_min) / (flywheel_stiffness * flywheel_speed),
    source="this method")
