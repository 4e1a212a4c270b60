"""Chapters on the wheel's geometry, its motion over a turn of the crank, and the conveyor's."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Case, Chapter, Steps, as_angle, bind, case
from diecut_report.mechanics import contact
from diecut_report.plugins.geneva_transport import formulas
from diecut_report.plugins.geneva_transport.inputs import GRIPPED

# fmt: off

CONVEYOR_NEEDS = ("sprocket_teeth", "chain_pitch")

geometry = Chapter("Wheel, crank and slots",
    text="The roller enters and leaves the slots along their direction, hence without impact: crank and slot are then perpendicular to each other.")
geometry.value("step_angle", "τ", "deg", "Step of the wheel", formulas.step_angle, source="000, Fig. 1", digits=6)
geometry.value("crank_ratio", "λ", "1", "Ratio of crank radius to centre distance", formulas.crank_ratio, source="geometry")
geometry.value("crank_radius", "r", "mm", "Radius of the crank", lambda crank_ratio, center_distance: crank_ratio * center_distance,
    source="geometry")
geometry.value("wheel_radius", "R", "mm", "Radius of the wheel: distance of the roller from its axis at entry",
    lambda slots, center_distance: center_distance * np.cos(np.pi / slots), source="geometry")
geometry.require("roller_below_crank", lambda roller_radius, crank_radius: roller_radius < crank_radius, key="roller_radius",
    message="is {roller_radius}, but the roller would cover the crank's axis: it must be smaller than the crank radius C·sin(π/z) = "
        "{crank_radius:down}")
geometry.value("rim_radius", "R_o", "mm", "Radius of the wheel's rim, where both flanks guide the roller from its entry on",
    lambda wheel_radius, roller_radius: np.sqrt(wheel_radius**2 + roller_radius**2), source="geometry")
geometry.value("slot_length", "l", "mm", "Length of the slots from the radius R",
    lambda slots, center_distance, crank_ratio, roller_radius: center_distance * (crank_ratio + np.cos(np.pi / slots) - 1) + roller_radius,
    source="geometry")
geometry.value("nearest_distance", "d_0", "mm", "Minimum distance of the roller from the wheel's axis",
    lambda center_distance, crank_ratio: center_distance * (1 - crank_ratio), source="geometry")
geometry.require("slot_before_axis", lambda roller_radius, nearest_distance: roller_radius < nearest_distance, key="roller_radius",
    message="is {roller_radius}, but the slots would reach beyond the wheel's axis: the roller comes within C(1 − λ) = {nearest_distance:down} of "
        "it and must be smaller than that")
geometry.value("hub_radius_max", "r_h", "mm", "Radius left for hub and shaft inside the slots",
    lambda nearest_distance, roller_radius: nearest_distance - roller_radius, source="geometry")
geometry.value("slot_spacing", "e", "mm", "Distance between the centre lines of neighbouring slots at their inner ends",
    lambda slots, nearest_distance: 2 * nearest_distance * np.sin(np.pi / slots), source="geometry")
geometry.value("slot_width", "b_s", "mm", "Width of the slots", lambda roller_radius: 2 * roller_radius, source="geometry")
geometry.value("roller_clearance", "w", "mm", "Wall between neighbouring slots at their inner ends",
    lambda slot_spacing, slot_width: slot_spacing - slot_width, source="geometry")

dwell = Chapter("Motion and dwell")
dwell.value("engagement_half_angle", "α_e", "deg", "Crank angle from the middle of the motion to the roller's exit", formulas.engagement_half_angle,
    source="geometry", digits=6)
dwell.value("entry_angle", "α_in", "deg", "Crank angle at which the roller enters the next slot",
    lambda slots: 2 * np.pi - formulas.engagement_half_angle(slots), source="geometry", digits=6)
dwell.value("motion_fraction", "κ_m", "1", "Fraction of a revolution in which the wheel turns", formulas.motion_fraction, source="geometry")
dwell.value("dwell_fraction", "κ_d", "1", "Fraction of a revolution in which it dwells", formulas.dwell_fraction, source="geometry")
dwell.value("cycle_time", "T", "ms", "Time of a revolution of the crank", lambda crank_speed: 2 * np.pi / crank_speed, source="kinematics")
dwell.value("time_motion", "t_m", "ms", "Time of the motion", lambda slots, cycle_time: formulas.motion_fraction(slots) * cycle_time,
    source="kinematics")
dwell.value("time_dwell", "t_d", "ms", "Time of the dwell", lambda slots, cycle_time: formulas.dwell_fraction(slots) * cycle_time,
    source="kinematics")
dwell.value("speed_ratio_peak", "ω_21,max", "1", "Maximum ratio of the wheel's speed to the crank's, in the middle of the motion",
    lambda crank_ratio: crank_ratio / (1 - crank_ratio), source="kinematics")
dwell.value("acceleration_entry", "ε_21,e", "1", "Ratio of the jump of the wheel's acceleration at entry and exit to the square of the crank's speed",
    lambda slots: np.tan(np.pi / slots), source="kinematics")
dwell.value("acceleration_peak_angle", "α_ε", "deg", "Crank angle before and after the middle of the motion at which the acceleration is largest",
    formulas.acceleration_peak_angle, source="kinematics", digits=6)


def _moving(name: str, symbol: str, unit: str, description: str, moving: Case, rest: Case, *, output: bool) -> Steps:
    """A curve of the wheel: one formula while the roller is in a slot, another one in the dwell."""
    steps = Steps()
    steps.choice(name, symbol, unit, description, moving, rest, source="kinematics", output=output)
    return steps


IN_SLOT = bind(lambda flag: flag == 1, flag="engaged")
MOVING, RESTING = "the roller is in a slot", "the locking disc holds the wheel"

motion = Chapter("Motion over a revolution of the crank",
    text="The crank angle is measured from the middle of the motion, so that the revolution begins and ends within an engagement; α′ is measured "
        "from the middle of the current engagement. The wheel turns in the opposite direction to the crank; its angle is counted in its own "
        "direction. s and n hold for a whole piece of the revolution and are shown in its middle, all other curves at the stated α.")
motion.abscissa("crank_angle", "α", "deg", "Crank angle from the middle of the motion", 2 * np.pi, shown_at="acceleration_peak_at",
    speed="crank_speed")
motion.breakpoints("engagement", "crank_angle", "engagement_half_angle", "entry_angle")
motion.phase("moving", "moving", "Motion of wheel and sheet", "crank_angle", ("entry_angle", "engagement_half_angle"))
motion.phase("dwell", "rest", "Dwell of wheel and sheet", "crank_angle", rest_of=("moving",))
motion.choice("engaged", "s", "1", "Roller in a slot (1) or not (0)",
    case(lambda: 1, MOVING,
        lambda crank_angle, entry_angle, engagement_half_angle: (crank_angle <= engagement_half_angle) | (crank_angle >= entry_angle)),
    case(lambda: 0, RESTING), output=False, per_piece=True)
motion.choice("turns", "n", "1", "Number of completed steps of the wheel",
    case(lambda: 1, "the roller has entered the next slot", lambda crank_angle, entry_angle: crank_angle >= entry_angle),
    case(lambda: 0, "the roller has not yet entered the next slot"), output=False, per_piece=True)
motion.value("middle_angle", "α′", "deg", "Crank angle from the middle of the present engagement",
    lambda crank_angle, turns: crank_angle - 2 * np.pi * turns, output=False, source="kinematics")
motion.add(_moving("wheel_angle", "ψ", "deg", "Angle of the wheel from its position in the middle of its motion",
        case(bind(formulas.wheel_angle, angle="middle_angle"), MOVING, IN_SLOT), case(lambda step_angle: step_angle / 2, RESTING), output=True))
motion.add(_moving("speed_ratio", "ω_21", "1", "Ratio of the wheel's angular speed to the crank's",
        case(bind(formulas.speed_ratio, angle="middle_angle"), MOVING, IN_SLOT), case(lambda: 0, RESTING), output=False))
motion.add(_moving("acceleration_ratio", "ε_21", "1", "Ratio of the wheel's angular acceleration to the square of the crank's speed",
        case(bind(formulas.acceleration_ratio, angle="middle_angle"), MOVING, IN_SLOT), case(lambda: 0, RESTING), output=False))
motion.reduction("acceleration_peak", "ε_21,max", "1", "Maximum ratio of the wheel's acceleration to the square of the crank's speed", "max",
    of="acceleration_ratio", source="kinematics")
motion.value("wheel_speed", "ω_2", "rad/s", "Angular speed of the wheel", bind(formulas.rate, ratio="speed_ratio"), source="kinematics")
motion.value("wheel_acceleration", "ε_2", "rad/s**2", "Angular acceleration of the wheel", bind(formulas.rate_of_rate, ratio="acceleration_ratio"),
    source="kinematics")
motion.value("wheel_speed_max", "ω_2,max", "rad/s", "Maximum angular speed of the wheel", bind(formulas.rate, ratio="speed_ratio_peak"),
    source="kinematics")
motion.value("wheel_acceleration_max", "ε_2,max", "rad/s**2", "Maximum angular acceleration of the wheel",
    bind(formulas.rate_of_rate, ratio="acceleration_peak"), source="kinematics")

conveyor = Chapter("Motion of the sheet", needs=CONVEYOR_NEEDS, absent="not calculated: {missing} not given")
conveyor.value("travel_radius", "r_c", "mm", "Conveyor displacement per radian of the wheel", formulas.travel_radius, source="000, Fig. 1")
conveyor.value("sheet_step", "S", "mm", "Step of the conveyor per revolution of the crank",
    lambda sprocket_teeth, chain_pitch, gear_ratio, slots: sprocket_teeth * chain_pitch * gear_ratio / slots, source="000, Fig. 1")
conveyor.value("sheet_position", "x", "mm", "Position of the sheet from that in the middle of its motion", bind(formulas.travel, angle="wheel_angle"),
    source="kinematics")
conveyor.value("sheet_velocity", "v", "m/s", "Velocity of the sheet", bind(formulas.travel_rate, ratio="speed_ratio"), source="kinematics")
conveyor.value("sheet_acceleration", "a", "m/s**2", "Acceleration of the sheet", bind(formulas.travel_acceleration, ratio="acceleration_ratio"),
    source="kinematics")
conveyor.value("sheet_velocity_max", "v_max", "m/s", "Maximum velocity of the sheet", bind(formulas.travel_rate, ratio="speed_ratio_peak"),
    source="kinematics")
conveyor.value("sheet_acceleration_max", "a_max", "m/s**2", "Maximum acceleration of the sheet",
    bind(formulas.travel_acceleration, ratio="acceleration_peak"), source="kinematics")
conveyor.value("sheet_acceleration_entry", "a_e", "m/s**2", "Jump of the sheet's acceleration at entry and exit",
    bind(formulas.travel_acceleration, ratio="acceleration_entry"), source="kinematics")

grippers = Chapter("Holding force of the grippers",
    text="The grippers must hold the sheet against its own inertia; air resistance and the friction of the surface on which it slides are neglected.",
    needs=GRIPPED, absent="not calculated: {missing} not given")
grippers.value("sheet_mass", "m_s", "g", "Mass of the sheet", contact.sheet_mass, source="geometry")
grippers.value("sheet_force", "F_g", "N", "Maximum force of the sheet on its grippers", contact.sheet_force, source="mechanics")
rest = Chapter("Rest of the sheet within a tolerance", text="The sheet is at rest as long as it is within e of its dwell position.",
    needs=(*CONVEYOR_NEEDS, "rest_tolerance"), absent="not calculated: {missing} not given")
rest.require("tolerance_below_step", lambda rest_tolerance, sheet_step: 2 * rest_tolerance < sheet_step, key="rest_tolerance",
    message="is {rest_tolerance}, but must be less than half the step {sheet_step}")
rest.value("rest_wheel_angle", "ψ_e", "deg", "Angle of the wheel from the middle of its motion at which the sheet comes within the tolerance",
    lambda sheet_step, rest_tolerance, travel_radius: as_angle((sheet_step / 2 - rest_tolerance) / travel_radius), source="kinematics")
rest.value("rest_start", "α_r1", "deg", "Crank angle at which the sheet comes within the tolerance",
    lambda rest_wheel_angle, crank_ratio: np.arcsin(np.sin(rest_wheel_angle) / crank_ratio) - rest_wheel_angle, source="kinematics", digits=6)
rest.value("rest_end", "α_r2", "deg", "Crank angle at which the sheet leaves it again", lambda rest_start: 2 * np.pi - rest_start, source="symmetry",
    digits=6)
rest.phase("rest", "rest", "Rest of the sheet within the tolerance", "crank_angle", ("rest_start", "rest_end"))
