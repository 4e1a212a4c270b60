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
                   text="The roller enters and leaves the slots along their direction, so without a blow: crank and slot then stand square to each "
                        "other.")
geometry.value("step_angle", "τ", "deg", "Step of the wheel", formulas.step_angle, source="000, Fig. 1", digits=6)
geometry.value("crank_ratio", "λ", "1", "Crank radius to centre distance", formulas.crank_ratio, source="geometry")
geometry.value("crank_radius", "r", "mm", "Radius of the crank", formulas.crank_radius, source="geometry")
geometry.value("wheel_radius", "R", "mm", "Radius of the wheel: the roller's distance from its axis at entry", formulas.wheel_radius,
               source="geometry")
geometry.require("roller_below_crank", lambda roller_radius, crank_radius: roller_radius < crank_radius, key="roller_radius",
                 message="is {roller_radius}, but the roller would cover the crank's axis: it must be smaller than the crank radius C·sin(π/z) = "
                         "{crank_radius:down}")
geometry.value("rim_radius", "R_o", "mm", "Radius of the wheel's rim, where both flanks guide the roller from its entry on", formulas.rim_radius,
               source="geometry")
geometry.value("slot_length", "l", "mm", "Length of the slots from the radius R",
               lambda slots, center_distance, crank_ratio, roller_radius: center_distance * (crank_ratio + np.cos(np.pi / slots) - 1) + roller_radius,
               source="geometry")
geometry.value("nearest_distance", "d_0", "mm", "Roller's least distance from the wheel's axis", formulas.nearest_roller, source="geometry")
geometry.require("slot_before_axis", lambda roller_radius, nearest_distance: roller_radius < nearest_distance, key="roller_radius",
                 message="is {roller_radius}, but the slots would reach beyond the wheel's axis: the roller comes within C(1 − λ) = "
                         "{nearest_distance:down} of it and must be smaller than that")
geometry.value("hub_radius_max", "r_h", "mm", "Radius of hub and shaft that the slots leave",
               lambda nearest_distance, roller_radius: nearest_distance - roller_radius, source="geometry")
geometry.value("slot_spacing", "e", "mm", "Distance of neighbouring slots' middles at their inner ends", formulas.slot_spacing, source="geometry")
geometry.value("slot_width", "b_s", "mm", "Width of the slots", lambda roller_radius: 2 * roller_radius, source="geometry")
geometry.value("roller_clearance", "w", "mm", "Wall between neighbouring slots at their inner ends",
               lambda slot_spacing, slot_width: slot_spacing - slot_width, source="geometry")

dwell = Chapter("Motion and dwell")
dwell.value("engagement_half_angle", "α_e", "deg", "Crank angle from the middle of the motion to the roller's exit", formulas.engagement_half_angle,
            source="geometry", digits=6)
dwell.value("entry_angle", "α_in", "deg", "Crank angle at which the roller enters the next slot",
            lambda slots: 2 * np.pi - formulas.engagement_half_angle(slots), source="geometry", digits=6)
dwell.value("motion_fraction", "κ_m", "1", "Share of a turn in which the wheel turns", formulas.motion_fraction, source="geometry")
dwell.value("dwell_fraction", "κ_d", "1", "Share of a turn in which it dwells", formulas.dwell_fraction, source="geometry")
dwell.value("cycle_time", "T", "ms", "Time of a turn of the crank", formulas.cycle_time, source="kinematics")
dwell.value("time_motion", "t_m", "ms", "Time of the motion", lambda slots, cycle_time: formulas.motion_fraction(slots) * cycle_time,
            source="kinematics")
dwell.value("time_dwell", "t_d", "ms", "Time of the dwell", lambda slots, cycle_time: formulas.dwell_fraction(slots) * cycle_time,
            source="kinematics")
dwell.value("speed_ratio_peak", "ω_21,max", "1", "Greatest speed of the wheel to the crank's, in the middle of the motion",
            lambda crank_ratio: crank_ratio / (1 - crank_ratio), source="kinematics")
dwell.value("acceleration_entry", "ε_21,e", "1", "Jump of the wheel's acceleration at entry and exit, to the square of the crank's speed",
            lambda slots: np.tan(np.pi / slots), source="kinematics")
dwell.value("acceleration_peak_angle", "α_ε", "deg", "Crank angle before and after the middle of the motion at which the acceleration is greatest",
            formulas.acceleration_peak_angle, source="kinematics", digits=6)


def _moving(name: str, symbol: str, unit: str, description: str, moving: Case, rest: Case, *, output: bool) -> Steps:
    """A curve of the wheel: one formula while the roller is in a slot, another one in the dwell."""
    steps = Steps()
    steps.choice(name, symbol, unit, description, moving, rest, source="kinematics", output=output)
    return steps


IN_SLOT = bind(formulas.holds, flag="engaged")
MOVING, RESTING = "the roller is in a slot", "the locking disc holds the wheel"

motion_chapter = Chapter("Motion over a turn of the crank",
                         text="The crank angle is counted from the middle of the motion, so that the turn begins and ends within an engagement; α′ "
                              "counts from the middle of the present engagement. The wheel turns against the crank; its angle is counted in its "
                              "own direction. s and n hold for a whole piece of the turn and are shown in its middle, all other curves at the one "
                              "α that is named.")
motion_chapter.abscissa("crank_angle", "α", "deg", "Crank angle from the middle of the motion", 2 * np.pi, shown_at="acceleration_peak_at",
                        speed="crank_speed")
motion_chapter.breakpoints("engagement", "crank_angle", "engagement_half_angle", "entry_angle")
motion_chapter.phase("moving", "moving", "Motion of wheel and sheet", "crank_angle", ("entry_angle", "engagement_half_angle"))
motion_chapter.phase("dwell", "rest", "Dwell of wheel and sheet", "crank_angle", rest_of=("moving",))
motion_chapter.choice("engaged", "s", "1", "Whether the roller is in a slot (1) or not (0)",
                      case(lambda: 1, MOVING,
                           lambda crank_angle, entry_angle, engagement_half_angle:
                               (crank_angle <= engagement_half_angle) | (crank_angle >= entry_angle)), case(lambda: 0, RESTING), output=False,
                      per_piece=True)
motion_chapter.choice("turns", "n", "1", "Steps of the wheel that are done",
                      case(lambda: 1, "the roller has entered the next slot", lambda crank_angle, entry_angle: crank_angle >= entry_angle),
                      case(lambda: 0, "the roller has not yet entered the next slot"), output=False, per_piece=True)
motion_chapter.value("middle_angle", "α′", "deg", "Crank angle from the middle of the present engagement",
                     lambda crank_angle, turns: crank_angle - 2 * np.pi * turns, output=False, source="kinematics")
motion_chapter.add(_moving("wheel_angle", "ψ", "deg", "Angle of the wheel from where it is in the middle of its motion",
                           case(bind(formulas.wheel_angle, angle="middle_angle"), MOVING, IN_SLOT), case(lambda step_angle: step_angle / 2, RESTING),
                           output=True))
motion_chapter.add(_moving("speed_ratio", "ω_21", "1", "Angular speed of the wheel to the crank's",
                           case(bind(formulas.speed_ratio, angle="middle_angle"), MOVING, IN_SLOT), case(lambda: 0, RESTING), output=False))
motion_chapter.add(_moving("acceleration_ratio", "ε_21", "1", "Angular acceleration of the wheel to the square of the crank's speed",
                           case(bind(formulas.acceleration_ratio, angle="middle_angle"), MOVING, IN_SLOT), case(lambda: 0, RESTING), output=False))
motion_chapter.reduction("acceleration_peak", "ε_21,max", "1", "Greatest acceleration of the wheel to the square of the crank's speed", "max",
                         of="acceleration_ratio", source="kinematics")
motion_chapter.value("wheel_speed", "ω_2", "rad/s", "Angular speed of the wheel", bind(formulas.rate, ratio="speed_ratio"), source="kinematics")
motion_chapter.value("wheel_acceleration", "ε_2", "rad/s**2", "Angular acceleration of the wheel",
                     bind(formulas.rate_of_rate, ratio="acceleration_ratio"), source="kinematics")
motion_chapter.value("wheel_speed_max", "ω_2,max", "rad/s", "Greatest angular speed of the wheel", bind(formulas.rate, ratio="speed_ratio_peak"),
                     source="kinematics")
motion_chapter.value("wheel_acceleration_max", "ε_2,max", "rad/s**2", "Greatest angular acceleration of the wheel",
                     bind(formulas.rate_of_rate, ratio="acceleration_peak"), source="kinematics")

conveyor = Chapter("Motion of the sheet", needs=CONVEYOR_NEEDS, absent="not calculated: {missing} not given")
conveyor.value("travel_radius", "r_c", "mm", "Conveyor displacement per radian of the wheel", formulas.travel_radius, source="000, Fig. 1")
conveyor.value("sheet_step", "S", "mm", "Step of the conveyor for each turn of the crank",
               lambda sprocket_teeth, chain_pitch, gear_ratio, slots: sprocket_teeth * chain_pitch * gear_ratio / slots, source="000, Fig. 1")
conveyor.value("sheet_position", "x", "mm", "Position of the sheet from where it is in the middle of its motion",
               bind(formulas.travel, angle="wheel_angle"), source="kinematics")
conveyor.value("sheet_velocity", "v", "m/s", "Velocity of the sheet", bind(formulas.travel_rate, ratio="speed_ratio"), source="kinematics")
conveyor.value("sheet_acceleration", "a", "m/s**2", "Acceleration of the sheet", bind(formulas.travel_acceleration, ratio="acceleration_ratio"),
               source="kinematics")
conveyor.value("sheet_velocity_max", "v_max", "m/s", "Greatest velocity of the sheet", bind(formulas.travel_rate, ratio="speed_ratio_peak"),
               source="kinematics")
conveyor.value("sheet_acceleration_max", "a_max", "m/s**2", "Greatest acceleration of the sheet",
               bind(formulas.travel_acceleration, ratio="acceleration_peak"), source="kinematics")
conveyor.value("sheet_acceleration_entry", "a_e", "m/s**2", "Jump of the sheet's acceleration at entry and exit",
               bind(formulas.travel_acceleration, ratio="acceleration_entry"), source="kinematics")

grippers = Chapter("Hold of the grippers",
                   text="The grippers must hold the sheet against its own inertia; air and the friction of what it slides on are left out.",
                   needs=GRIPPED, absent="not calculated: {missing} not given")
grippers.value("sheet_mass", "m_s", "g", "Mass of the sheet", contact.sheet_mass, source="geometry")
grippers.value("sheet_force", "F_g", "N", "Greatest force of the sheet on its grippers", contact.sheet_force, source="mechanics")
rest = Chapter("Rest of the sheet within a tolerance",
               text="The sheet rests as long as it is no farther than e from where it stands in the dwell.",
               needs=(*CONVEYOR_NEEDS, "rest_tolerance"),
               absent="not calculated: {missing} not given")
rest.require("tolerance_below_step", lambda rest_tolerance, sheet_step: 2 * rest_tolerance < sheet_step, key="rest_tolerance",
             message="is {rest_tolerance}, but must be less than half the step {sheet_step}")
rest.value("rest_wheel_angle", "ψ_e", "deg", "Angle of the wheel from the middle of its motion at which the sheet comes within the tolerance",
           lambda sheet_step, rest_tolerance, travel_radius: as_angle((sheet_step / 2 - rest_tolerance) / travel_radius), source="kinematics")
rest.value("rest_start", "α_r1", "deg", "Crank angle at which the sheet comes within the tolerance",
           bind(formulas.crank_of_wheel, wheel="rest_wheel_angle"),
           source="kinematics", digits=6)
rest.value("rest_end", "α_r2", "deg", "Crank angle at which the sheet leaves it again", lambda rest_start: 2 * np.pi - rest_start, source="symmetry",
           digits=6)
rest.phase("rest", "rest", "Rest of the sheet within the tolerance", "crank_angle", ("rest_start", "rest_end"))
