"""Chapters on the sheet and on the drive of a press."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    Chapter,
    abscissa,
    as_angle,
    as_number,
    case,
    choice,
    computed,
    formula,
    from_curve,
    inner,
    m,
    number,
    pi,
    reduction,
    value,
)
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


SIDES = {"sheet_width": m.sheet_width, "sheet_length": m.sheet_length}

sides = Chapter("Sheet, cylinder and step",
    text="The cylinder must unroll over the whole dimension of the sheet in the feed direction, and extend over the whole dimension across it; a "
        "step of the transport covers a sheet and the gap between two.")
for feed, length, width in ((BY_WIDTH, "sheet_length", "sheet_width"), (BY_LENGTH, "sheet_width", "sheet_length")):
    sides.side_in_feed = (value(SIDES[width], needs=(*feed, width)), "s_f", "mm",
        f"Dimension of the sheet in the feed direction: its {width.removeprefix('sheet_')}", "input")
    sides.side_across = (value(SIDES[length], needs=(*feed, length)), "s_a", "mm", f"Dimension across the feed: its {length.removeprefix('sheet_')}",
        "input")
    sides.step_room = (value(m.sheet_step - m.side_in_feed, needs=(*feed, width, "sheet_step")), "Δs", "mm", "Gap between two sheets after a step",
        "geometry")

WAYS = ((("output_turns_per_sheet",), ()), (("crank_speed",), ("output_turns_per_sheet",)))
"""How the turns of the output for each sheet are known."""

rate = Chapter("Rate given by the gears",
    text="Gears have whole teeth and pulleys standard diameters, so the press runs slightly off its productivity. Under the mean torque, which is "
        "below its rated torque, the motor runs faster than at its rated speed, and so does the press.", needs=("output_speed", "productivity"),
    absent="not calculated: the drive train's output_speed and productivity are not both given")
rate.turns_a_sheet = (value(m.output_turns_per_sheet, needs=("output_turns_per_sheet",)), "i_o", "1",
    "Revolutions of the output per sheet: as given", "input")
rate.turns_a_sheet = (choice(case(1, "the output is closer in speed to the main shaft than to the crank", turns_like_main_shaft),
    case(np.maximum(np.round(as_number(m.crank_speed) / as_number(pi * m.productivity)), 1) / 2,
    "the output turns with the crank, whole half turns for a sheet"), needs=("crank_speed",), lacks=("output_turns_per_sheet",)), "i_o", "1",
    "Revolutions of the output per sheet", "kinematics")
rate.rate_asked = inner(m.required_rate, needs=("required_rate",)), "n_0", "1/h", "Required sheet rate", "input"
rate.rate_asked = inner(m.productivity, lacks=("required_rate",)), "n_0", "1/h", "Required sheet rate", "input"
for needs, lacks in WAYS:
    rate.actual_rate = value(actual_rate, needs=needs, lacks=lacks), "n_a", "1/h", "Sheet rate at the motor's rated speed", "kinematics"
    rate.rate_error = (value(m.actual_rate / m.productivity - 1, needs=needs, lacks=lacks), "Δn", "%", "Relative excess over its productivity",
        "kinematics")
    rate.true_rate = (value(actual_rate.of(output_speed=m.loaded_output_speed), needs=(*needs, "loaded_output_speed"), lacks=lacks), "n_t", "1/h",
        "Sheet rate at the speed of the motor under the mean torque", "kinematics")
    rate.load_rise = (value((m.true_rate / m.productivity) ** 2 - 1, needs=(*needs, "loaded_output_speed"), lacks=lacks), "Δ_a", "%",
        "Relative increase of the accelerations", "kinematics")
    rate.least_rate = (inner(np.minimum(m.actual_rate, m.true_rate), needs=(*needs, "loaded_output_speed"), lacks=lacks), "n_min", "1/h",
        "Lower of the two rates", "kinematics")
    rate.least_rate = inner(m.actual_rate, needs=needs, lacks=(*lacks, "loaded_output_speed")), "n_min", "1/h", "Known rate", "kinematics"
    rate.listing("times", "Times at the rate given by the gears", relations.TIMES, relations.times, ("timing", "productivity", "actual_rate"),
        needs=("timing", *needs), lacks=lacks)

STOPPED = ("brake_torque", "flywheel_inertia", "flywheel_speed", "shaft_torque_mean", "lines_energy", "productivity", "output_speed")
stopping = Chapter("Stopping", needs=STOPPED, text="Brake and mean load absorb the energy of flywheel, shafts and lines; the speed falls linearly.",
    absent="not calculated: brake_torque is not given, or flywheel and cyclogram are not there")
stopping.energy_running = (m.flywheel_inertia * m.flywheel_speed**2 / 2 + m.shafts_energy + m.lines_energy, "E_0", "J",
    "Kinetic energy of flywheel, shafts and lines", "energy")
stopping.stopping_angle = (as_angle(m.energy_running / (m.brake_torque + m.shaft_torque_mean)), "Φ_b", "deg", "Main-shaft rotation to standstill",
    "energy")
for needs, lacks in WAYS:
    stopping.stopping_time = (value(2 * as_number(m.stopping_angle) / (as_number(2 * pi) * m.actual_rate), needs=needs, lacks=lacks), "t_b", "s",
        "Time to standstill", "kinematics")

conveyor = Chapter("Inertia of the conveyor", needs=CONVEYOR,
    text="The inertia is the conveyor's mass times the square of its displacement per radian of the wheel.",
    absent="not calculated: {missing} not given")
conveyor.conveyor_inertia = (m.conveyor_mass * m.travel_radius**2, "J_m", "kg*m**2", "Moment of inertia of the conveyor's mass at the wheel's shaft",
    "energy")
conveyor.moved_inertia = (value(m.conveyor_inertia + m.wheel_side_inertia, needs=("wheel_side_inertia",)), "J_Σ", "kg*m**2",
    "Moment of inertia of everything that the wheel moves, at its shaft", "energy")
conveyor.moved_inertia = (value(m.conveyor_inertia, lacks=("wheel_side_inertia",)), "J_Σ", "kg*m**2",
    "Moment of inertia at the wheel's shaft, without the parts that turn with it", "energy")
conveyor.inertia_error = (abs(m.wheel_inertia / m.moved_inertia - 1), "Δ_J", "%",
    "Relative difference of the inertia used in the wheel's calculation", "energy")

dwell = Chapter("Dwell and the phases within it", needs=("timing", "wheel", "cover_angle"),
    text="The wheel has the largest play just after its exit and just before its entry; the smaller the margins of the timing, the larger the play.",
    absent="not calculated: there is no cyclogram, or the wheel's cover_angle is not given")
dwell.held_in_dwell = (computed(lambda timing, wheel: len(relations.dwell_margins(timing, wheel)), ("timing", "wheel"), "as given", output=False),
    "N_d", "1", "Number of interlocks that contain something within the wheel's dwell")
dwell.dwell_margin = (computed(lambda timing, wheel: min(relations.dwell_margins(timing, wheel), default=0.0), ("timing", "wheel"),
    "smaller margin of each interlock, multiplied by the revolutions of the line per sheet", exists=m.held_in_dwell > 0), "φ_m", "deg",
    "Minimum angle of the wheel's crank between an end of the dwell and what must lie within it")

register = Chapter("Register",
    text="Plays add up, since each may be at its limit; a step of whole pitches stops the chain in the same position each time.")
register.play_total = value(m.sheet_play + m.backlash, needs=("sheet_play",)), "Δx_Σ", "mm", "Total play of transport and lines", "geometry"
register.pitches = (value(m.sheet_step / m.chain_pitch, needs=("sheet_step", "chain_pitch"), digits=10), "n_p", "1", "Chain pitches per step",
    "geometry")
register.pitch_error = (value(abs(m.pitches - np.floor(m.pitches + number(1) / 2)), needs=("sheet_step", "chain_pitch")), "Δn_p", "1",
    "Deviation from a whole number", "geometry")
register.loop_steps = (value(m.chain_links / m.pitches, needs=("sheet_step", "chain_pitch", "chain_links"), digits=10), "n_l", "1",
    "Steps in which the gripper chain goes round once", "geometry")
register.loop_error = (value(abs(m.loop_steps - np.floor(m.loop_steps + number(1) / 2)), needs=("sheet_step", "chain_pitch", "chain_links")), "Δn_l",
    "1", "Deviation from a whole number", "geometry")
register.speed_ripple = (value(1 - np.cos(pi / m.sprocket_teeth), needs=("sprocket_teeth",)), "ε_v", "%",
    "Speed ripple of the chain due to the polygon effect", "geometry")


CYLINDER = ("cylinder_mass", "cylinder_inertia", "cylinder_radius", "cylinder_rotation", "cylinder_speed", "crank_speed")
ENGAGED = (*CYLINDER, "dead_center_outer", "dead_center_inner", "clutch_torque", "clutch_speed")
TRAVEL = ("displacement", "velocity", "stroke", "dead_center_outer", "dead_center_inner")
MOTOR = ("flywheel_torque", "output_speed", "flywheel_inertia", "flywheel_speed", "belt_ratio", "motor_rated_torque", "motor_speed",
         "synchronous_speed")

inertia = Chapter("Equivalent inertia at the crank",
    text="The inertia of equal kinetic energy; it is zero where the cylinder stands, and the unbalance makes it differ between the strokes.",
    needs=CYLINDER, absent="not calculated: there is no cylinder drive to use, or there are several")
inertia.crank_angle = abscissa(2 * np.pi, shown_at="crank_inertia_max_at"), "φ", "deg", "Crank angle"
inertia.rotation = from_curve(given="cylinder_rotation", abscissa="crank_angle", output=False), "θ", "deg", "Rotation of the cylinder"
inertia.speed = from_curve(given="cylinder_speed", abscissa="crank_angle", output=False), "ω_z", "rad/s", "Speed of the cylinder"
inertia.speed_ratio = inner(m.speed / m.crank_speed), "ω_31", "1", "Ratio of the cylinder's speed to the crank's", "kinematics"
inertia.crank_inertia = (inertia_at_crank.of(rotation=m.rotation, speed_ratio=m.speed_ratio), "I_red", "kg*m**2", "Equivalent inertia at the crank",
    "energy")
inertia.crank_inertia_mean = (reduction("mean", of="crank_inertia"), "I_m", "kg*m**2",
    "Mean equivalent inertia at the crank over a revolution, for the run-up")
inertia.crank_inertia_max = reduction("max", of="crank_inertia"), "I_max", "kg*m**2", "Maximum equivalent inertia at the crank"

engagement = Chapter("Engagement of the clutch",
    text="From rest the net torque M′ accelerates the crank to ω(φ) = √(2M′(φ − φ₀)/I_red(φ)); the slip ends where this first reaches the speed of "
        "the driving side, at the crank. The equal inertia is the constant one at the clutch that would generate the same heat.", needs=ENGAGED,
    absent="not calculated: there is no clutch or no cylinder drive to use, or there are several")
engagement.require("clutch_pulls", m.clutch_load < m.clutch_torque, key="clutch_load",
    message="is {clutch_load}, but the slipping clutch carries {clutch_torque} only: the driven side never comes up to speed; lower the load while "
    "engaging")
RATIO = ("i_c", "1")
ON_OUTPUT = ("output_speed", "output_turns_per_sheet", "productivity")
engagement.require("one_ratio", abs(m.clutch_speed - m.clutch_turns * m.crank_speed) <= relations.ONE_SHAFT * m.clutch_turns * m.crank_speed,
    key="clutch_turns", needs=("clutch_turns",),
    message="is {clutch_turns}, but the clutch turns at {clutch_speed} and the crank at {crank_speed}; give their ratio, or leave the key out")
engagement.require("one_position", 0 >= 1, key="engagement_angle", needs=("engagement_angle",), lacks=("single_position=true",),
    message="is {engagement_angle}, but a friction clutch engages at any angle; say single_position where a pin lets it engage there alone, or "
    "leave the key out")
engagement.clutch_ratio = (inner(m.clutch_turns, needs=("clutch_turns",)), *RATIO, "Revolutions of the clutch per revolution of the crank: as given",
    "input")
ON_CRANK = case(1, "it is on the crank's shaft: its driving side is at most a tenth faster or slower",
    abs(m.clutch_speed - m.crank_speed) <= relations.ONE_SHAFT * m.crank_speed)
ELSEWHERE = case(m.clutch_speed / m.crank_speed, "it is on another shaft")
engagement.clutch_ratio = (choice(ON_CRANK, case(m.output_turns_per_sheet * m.productivity * as_number(2 * pi) / as_number(m.crank_speed),
    "it is on the drive train's output", abs(m.clutch_speed - m.output_speed) <= relations.SAME * m.output_speed), ELSEWHERE, needs=ON_OUTPUT,
    lacks=("clutch_turns",), output=False), *RATIO, "Revolutions of the clutch per revolution of the crank", "kinematics")
for lacking in ON_OUTPUT:
    engagement.clutch_ratio = (choice(ON_CRANK, ELSEWHERE, needs=ON_OUTPUT[: ON_OUTPUT.index(lacking)], lacks=("clutch_turns", lacking),
        output=False), *RATIO, "Revolutions of the clutch per revolution of the crank", "kinematics")
engagement.net_torque = (m.clutch_torque - m.clutch_load) * m.clutch_ratio, "M′", "N*m", "Accelerating torque at the crank", "mechanics"
engagement.prepared("slip", relations.engagement, (*relations.TAKES, "engagement_angle"), for_many=True)
engagement.start_angle = value(m.engagement_angle, needs=("engagement_angle",)), "φ_0", "deg", "Crank angle of the engagement: as given", "input"
engagement.start_angle = (computed(lambda slip: slip.engagement_angle[:, None], ("slip",), "all crank angles tried", lacks=("engagement_angle",)),
    "φ_0", "deg", "Crank angle of the engagement: the one with the most heat", "this method")
engagement.slip_time = computed(lambda slip: slip.time[:, None], ("slip",), "Gauss–Legendre"), "t_s", "ms", "Slip time", "this method"
engagement.driven_angle = (computed(lambda slip: slip.driven_angle[:, None], ("slip",), "root of equal speeds"), "Δφ", "deg",
    "Rotation of the crank during slip", "this method")
engagement.lag_angle = (m.clutch_speed / m.clutch_ratio * m.slip_time - m.driven_angle, "Δφ_l", "deg",
    "Additional rotation of the driving side, at the crank", "kinematics")
engagement.slip_heat = m.clutch_torque * m.clutch_ratio * m.lag_angle, "Q", "J", "Heat of the engagement, with the varying inertia", "energy"
BEHIND, NAMED = ("b_z", "1", "Cylinder behind the clutch (1) or not (0)"), ("clutch_drives", "drive")
engagement.is_behind = (computed(lambda drives, drive: float(drive.name in drives), NAMED, "as given", needs=NAMED, output=False, printed=False),
    *BEHIND)
for lacks in (("clutch_drives",), ("drive",)):
    engagement.is_behind = inner(1, needs=NAMED[: NAMED.index(lacks[0])], lacks=lacks, printed=False), *BEHIND
engagement.equal_inertia = (value(2 * m.slip_heat * (1 - m.clutch_load / m.clutch_torque) / m.clutch_speed**2, exists=m.is_behind > 0), "I_eq",
    "kg*m**2", "Constant inertia at the clutch that would generate the same heat", "energy")

coupling = Chapter("Clutch and offsets of the lines", needs=("timing", "clutch_drives", "clutch_torque"),
    absent="not calculated: clutch_drives is not given, or there is no clutch or no cyclogram to use")
coupling.lines_out_of_step = (computed(function=relations.lines_out_of_step, takes=("clutch_drives", "single_position", "timing"),
    method="those driven through the clutch, unless these are all or it engages at one angle only"), "N_c", "1",
    "Number of lines that lose synchronism with the others when the clutch engages", "kinematics")
coupling.lines_beside = (computed(lambda drives, drive: float(len({*drives} - {drive.name})), ("clutch_drives", "drive"),
    "those driven through the clutch but for the cylinder's", output=False, needs=("drive",)), "N_b", "1",
    "Number of lines behind the clutch whose inertia is not compared with that of its calculation")
coupling.words("clutch_lines", relations.listed, ("clutch_drives",))

ends_chapter = Chapter("Speed before the ends of the travel", needs=TRAVEL,
    text="The drive brings the cylinder to rest by itself; dampers that are met before the ends absorb its remaining energy there.",
    absent="not calculated: there is no cylinder drive to use, or there are several")
ends_chapter.require("contact_within_stroke", m.contact_distance < m.stroke, key="contact_distance",
    message="is {contact_distance}, but the whole stroke is {stroke}; dampers are met shortly before its ends", needs=("contact_distance",))
ends_chapter.contact_speed_inner = (computed(function=lambda displacement, velocity, stroke, outer, inner,
    way: relations.speed_at(displacement, velocity, outer, inner, stroke - way), takes=(*relations.INNER, "contact_distance"),
    method="nested search", needs=("contact_distance",)), "v_in", "m/s", "Speed at contact before the inner end", "kinematics")
ends_chapter.contact_speed_outer = (computed(function=lambda displacement, velocity, stroke, outer, inner,
    way: relations.speed_at(displacement, velocity, inner, outer + 2 * np.pi, way), takes=(*relations.INNER, "contact_distance"),
    method="nested search", needs=("contact_distance",)), "v_out", "m/s", "Speed at contact before the outer end", "kinematics")
ends_chapter.contact_speed = (value(np.maximum(m.contact_speed_inner, m.contact_speed_outer), needs=("contact_distance",)), "v_k", "m/s",
    "Higher speed at contact", "kinematics")
ends_chapter.end_impacts = (choice(case(0, "dampers at the ends themselves are not met in any stroke", m.contact_distance <= 0),
    case(as_number(m.crank_speed) / as_number(2 * pi), "dampers before the ends are met in every revolution"),
    needs=("contact_distance", "crank_speed")), "z_e", "1/h", "Impacts at one end of the travel", "kinematics")
ends_chapter.way_inner = (computed(function=lambda displacement, velocity, stroke, outer, inner,
    speed: relations.way_below(displacement, velocity, outer, inner, speed, stroke), takes=(*relations.INNER, "damper_velocity"),
    method="nested search", needs=("damper_velocity",)), "d_in", "mm",
    "Distance before the inner end at which the speed used in the dampers' calculation occurs", "kinematics")
ends_chapter.way_outer = (computed(function=lambda displacement, velocity, stroke, outer, inner,
    speed: relations.way_below(displacement, velocity, inner, outer + 2 * np.pi, speed, stroke), takes=(*relations.INNER, "damper_velocity"),
    method="nested search", needs=("damper_velocity",)), "d_out", "mm", "Distance before the outer end at which it occurs", "kinematics")

ends_chapter.stopped_mass = (value(m.damper_mass + m.carriage_mass, needs=("damper_mass", "carriage_mass")), "m_s", "kg",
    "Mass that moves with the cylinder's axis, with the carriages", "this method")

motor_chapter = Chapter("Motor behind its flywheel",
    text="With linear slip the motor follows the load as a first-order lag, M_m + τ·dM_m/dt = M_f: a flywheel shields it only if τ is long compared "
        "with the time of a stroke.", needs=MOTOR, absent="not calculated: there is no drive train with a torque curve to use, or there are several")
motor_chapter.require("motor_slips", m.motor_speed < m.synchronous_speed, key="motor_speed",
    message="is {motor_speed}, but a motor under load turns slower than its synchronous speed {synchronous_speed}")
motor_chapter.load_period = (m.load_turns * as_number(2 * pi) / as_number(m.output_speed), "T_f", "ms", "Time after which the load repeats",
    "kinematics")
motor_chapter.slip_stiffness = (motor_slip.slip_stiffness.of(rated_torque=m.motor_rated_torque, rated_speed=m.motor_speed), "k", "N*m*s/rad",
    "Torque of the motor per unit of slip speed", "this method")
motor_chapter.flywheel_stiffness = (motor_slip.stiffness_at_flywheel.of(ratio=m.belt_ratio, efficiency=m.belt_efficiency), "k_f", "N*m*s/rad",
    "The same at the flywheel's shaft", "energy")
motor_chapter.time_constant = (motor_slip.time_constant.of(inertia=m.flywheel_inertia, stiffness_at_flywheel=m.flywheel_stiffness), "τ", "ms",
    "Time constant of the lag", "this method")
motor_chapter.prepared("response", relations.response, ("flywheel_torque", "load_turns", "load_period", "time_constant"), for_many=True)
for name, symbol, words, function in (
    ("lagged_rms", "M_f,rms", "Root mean square torque of the motor at the flywheel's shaft", lambda response: response.rms[:, None]),
    ("lagged_max", "M_f,max", "Maximum torque of the motor at the flywheel's shaft", lambda response: response.largest[:, None]),
    ("lagged_min", "M_f,min", "Minimum torque of the motor at the flywheel's shaft; negative where it brakes", lambda response: response.least[:,
                                                                                                                                               None])):
    motor_chapter[name] = computed(function, ("response",), "exponentials on smooth pieces", output=False), symbol, "N*m", words, "this method"
motor_chapter.motor_torque_rms = m.lagged_rms / (m.belt_ratio * m.belt_efficiency), "M_rms", "N*m", "Root mean square torque of the motor", "energy"
motor_chapter.motor_torque_max = m.lagged_max / (m.belt_ratio * m.belt_efficiency), "M_max", "N*m", "Maximum torque of the motor", "energy"
motor_chapter.motor_torque_min = m.lagged_min / (m.belt_ratio * m.belt_efficiency), "M_min", "N*m", "Minimum torque of the motor", "energy"
motor_chapter.motor_torque_peak = (np.maximum(abs(m.motor_torque_max), abs(m.motor_torque_min)), "M_peak", "N*m",
    "Maximum absolute torque of the motor", "this method")
motor_chapter.breakdown_torque = (value(m.breakdown_ratio * m.motor_rated_torque, needs=("breakdown_ratio",)), "M_br", "N*m",
    "Breakdown torque of the motor", "this method")
motor_chapter.speed_swing = ((m.lagged_max - m.lagged_min) / (m.flywheel_stiffness * m.flywheel_speed), "δ_a", "1",
    "Speed fluctuation of the flywheel: (maximum − minimum)/mean", "this method")
