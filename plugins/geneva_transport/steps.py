"""The calculation of the Geneva drive: the wheel, its motion over a turn of the crank, the conveyor's, and the forces."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, as_angle, bind, case, pi
from diecut_report.mechanics import common, contact
from diecut_report.plugins.geneva_transport import formulas
from diecut_report.plugins.geneva_transport.inputs import GRIPPED

# fmt: off


"""The keys with which the pull of the sheet at its grippers is known."""


CONVEYOR_NEEDS = ("sprocket_teeth", "chain_pitch")

geometry = Chapter("Wheel, crank and slots",
    text="The roller enters and leaves the slots along their direction, hence without impact: crank and slot are then perpendicular to each other.")
geometry.value("step_angle", "τ", "deg", "Step of the wheel", lambda slots: 2 * pi / slots, source="000, Fig. 1", digits=6)
geometry.value("crank_ratio", "λ", "1", "Ratio of crank radius to centre distance", formulas.crank_ratio, source="geometry")
geometry.value("crank_radius", "r", "mm", "Radius of the crank", lambda crank_ratio, center_distance: crank_ratio * center_distance,
    source="geometry")
geometry.value("wheel_radius", "R", "mm", "Radius of the wheel: distance of the roller from its axis at entry",
    lambda slots, center_distance: center_distance * np.cos(pi / slots), source="geometry")
geometry.require("roller_below_crank", lambda roller_radius, crank_radius: roller_radius < crank_radius, key="roller_radius",
    message="is {roller_radius}, but the roller would cover the crank's axis: it must be smaller than the crank radius C·sin(π/z) = "
        "{crank_radius:down}")
geometry.value("rim_radius", "R_o", "mm", "Radius of the wheel's rim, where both flanks guide the roller from its entry on",
    lambda wheel_radius, roller_radius: np.sqrt(wheel_radius**2 + roller_radius**2), source="geometry")
geometry.value("slot_length", "l", "mm", "Length of the slots from the radius R",
    lambda slots, center_distance, crank_ratio, roller_radius: center_distance * (crank_ratio + np.cos(pi / slots) - 1) + roller_radius,
    source="geometry")
geometry.value("nearest_distance", "d_0", "mm", "Minimum distance of the roller from the wheel's axis",
    lambda center_distance, crank_ratio: center_distance * (1 - crank_ratio), source="geometry")
geometry.require("slot_before_axis", lambda roller_radius, nearest_distance: roller_radius < nearest_distance, key="roller_radius",
    message="is {roller_radius}, but the slots would reach beyond the wheel's axis: the roller comes within C(1 − λ) = {nearest_distance:down} of "
        "it and must be smaller than that")
geometry.value("hub_radius_max", "r_h", "mm", "Radius left for hub and shaft inside the slots",
    lambda nearest_distance, roller_radius: nearest_distance - roller_radius, source="geometry")
geometry.value("slot_spacing", "e", "mm", "Distance between the centre lines of neighbouring slots at their inner ends",
    lambda slots, nearest_distance: 2 * nearest_distance * np.sin(pi / slots), source="geometry")
geometry.value("slot_width", "b_s", "mm", "Width of the slots", lambda roller_radius: 2 * roller_radius, source="geometry")
geometry.value("roller_clearance", "w", "mm", "Wall between neighbouring slots at their inner ends",
    lambda slot_spacing, slot_width: slot_spacing - slot_width, source="geometry")

dwell = Chapter("Motion and dwell")
dwell.value("engagement_half_angle", "α_e", "deg", "Crank angle from the middle of the motion to the roller's exit", formulas.engagement_half_angle,
    source="geometry", digits=6)
dwell.value("entry_angle", "α_in", "deg", "Crank angle at which the roller enters the next slot",
    lambda slots: 2 * pi - formulas.engagement_half_angle(slots), source="geometry", digits=6)
dwell.value("motion_fraction", "κ_m", "1", "Fraction of a revolution in which the wheel turns", formulas.motion_fraction, source="geometry")
dwell.value("dwell_fraction", "κ_d", "1", "Fraction of a revolution in which it dwells", formulas.dwell_fraction, source="geometry")
dwell.value("cycle_time", "T", "ms", "Time of a revolution of the crank", lambda crank_speed: 2 * pi / crank_speed, source="kinematics")
dwell.value("time_motion", "t_m", "ms", "Time of the motion", lambda slots, cycle_time: formulas.motion_fraction(slots) * cycle_time,
    source="kinematics")
dwell.value("time_dwell", "t_d", "ms", "Time of the dwell", lambda slots, cycle_time: formulas.dwell_fraction(slots) * cycle_time,
    source="kinematics")
dwell.value("speed_ratio_peak", "ω_21,max", "1", "Maximum ratio of the wheel's speed to the crank's, in the middle of the motion",
    lambda crank_ratio: crank_ratio / (1 - crank_ratio), source="kinematics")
dwell.value("acceleration_entry", "ε_21,e", "1", "Ratio of the jump of the wheel's acceleration at entry and exit to the square of the crank's speed",
    lambda slots: np.tan(pi / slots), source="kinematics")
dwell.value("acceleration_peak_angle", "α_ε", "deg", "Crank angle before and after the middle of the motion at which the acceleration is largest",
    formulas.acceleration_peak_angle, source="kinematics", digits=6)

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
    lambda crank_angle, turns: crank_angle - 2 * pi * turns, output=False, source="kinematics")
motion.choice("wheel_angle", "ψ", "deg", "Angle of the wheel from its position in the middle of its motion",
    case(bind(formulas.wheel_angle, angle="middle_angle"), MOVING, IN_SLOT), case(lambda step_angle: step_angle / 2, RESTING), source="kinematics")
motion.choice("speed_ratio", "ω_21", "1", "Ratio of the wheel's angular speed to the crank's",
    case(bind(formulas.speed_ratio, angle="middle_angle"), MOVING, IN_SLOT), case(lambda: 0, RESTING), source="kinematics", output=False)
motion.choice("acceleration_ratio", "ε_21", "1", "Ratio of the wheel's angular acceleration to the square of the crank's speed",
    case(bind(formulas.acceleration_ratio, angle="middle_angle"), MOVING, IN_SLOT), case(lambda: 0, RESTING), source="kinematics", output=False)
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
conveyor.value("travel_radius", "r_c", "mm", "Conveyor displacement per radian of the wheel",
    lambda sprocket_teeth, chain_pitch, gear_ratio: sprocket_teeth * chain_pitch * gear_ratio / (2 * pi), source="000, Fig. 1")
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
rest.value("rest_end", "α_r2", "deg", "Crank angle at which the sheet leaves it again", lambda rest_start: 2 * pi - rest_start, source="symmetry",
    digits=6)
rest.phase("rest", "rest", "Rest of the sheet within the tolerance", "crank_angle", ("rest_start", "rest_end"))


HELD = ("cover_angle",)
PLAY_NEEDS = (*CONVEYOR_NEEDS, *HELD, "allowable_sheet_play")
REACHES = bind(common.is_below, smaller="rim_distance", greater="disc_radius")

torque = Chapter("Torque at the crank and roller force",
    text="In the first half of the motion the roller pushes the wheel, in the second half it holds it back with the other flank of the slot. The "
        "crank recovers the energy that it supplies, but for the losses of the gear behind the wheel.",
    needs=("driven_inertia",), absent="not calculated: driven_inertia is not given")
torque.require("own_share", lambda own_inertia, driven_inertia: own_inertia <= driven_inertia, key="own_inertia",
    message="is more than driven_inertia, of which it is a part; give less")
torque.choice("felt_inertia", "J_w", "kg*m**2", "Inertia that the roller feels, with the losses of the gear behind the wheel",
    case(formulas.driven_with_losses, "the roller drives the wheel: the gear takes more", formulas.is_driven),
    case(formulas.braked_with_losses, "the roller brakes the wheel: the gear gives less back"), source="energy", output=False)
torque.value("torque", "M", "N*m", "Torque at the crank to move the wheel's inertia", bind(formulas.driving_torque, driven_inertia="felt_inertia"),
    source="energy")
torque.value("roller_distance", "d", "mm", "Distance of the roller from the wheel's axis", formulas.roller_distance, source="geometry", output=False)
torque.value("roller_force", "F", "N", "Force of the roller on the flank of the slot (positive: it drives)",
    bind(formulas.roller_force, driven_inertia="felt_inertia"), source="statics")
torque.value("crank_force_x", "F_x", "N", "Force on the crank along the line of centres, towards the wheel",
    lambda roller_force, crank_angle, center_distance, crank_ratio, roller_distance:
        -roller_force * center_distance * crank_ratio * np.sin(crank_angle) / roller_distance,
    source="statics",
    output=False)
torque.value("crank_force_y", "F_y", "N", "Force on the crank across the line of centres, in the direction in which its roller passes the line",

            lambda roller_force, crank_angle, center_distance, crank_ratio, roller_distance:
                -roller_force * center_distance * (1 - crank_ratio * np.cos(crank_angle)) / roller_distance,
        source="statics", output=False)
torque.reduction("torque_peak", "M_peak", "N*m", "Maximum torque at the crank, driving and driven", "max", of="torque", source="energy")
torque.reduction("roller_force_peak", "F_peak", "N", "Maximum roller force", "max", of="roller_force", source="statics")
torque.value("kinetic_energy_max", "E_k", "J", "Energy exchanged with the wheel at each step",
    lambda driven_inertia, speed_ratio_peak, crank_speed: driven_inertia * (speed_ratio_peak * crank_speed) ** 2 / 2, source="energy")
torque.reduction("energy_turn", "E_Σ", "J", "Work of the torque over a revolution", "integral", of="torque", output=False, source="energy")
torque.value("energy_lost", "E_v", "J", "Energy that the gear behind the wheel takes in a step",
    lambda kinetic_energy_max, driven_inertia, own_inertia, efficiency:
        kinetic_energy_max * (1 - own_inertia / driven_inertia) * (1 / efficiency - efficiency),
    source="energy", output=False)
torque.value("energy_residual", "r_E", "1", "Ratio of the work over a revolution, but for the losses, to the energy of a step",
    lambda energy_turn, energy_lost, kinetic_energy_max: abs(energy_turn - energy_lost) / kinetic_energy_max, source="energy", output=False)

hertz = Chapter("Contact of roller and slot",
    text="A cylindrical roller on the plane flank of the slot, both of the same material; the load is uniform over the roller's width.",
    needs=("driven_inertia", "roller_width"), absent="not calculated: {missing} not given")
hertz.value("effective_modulus", "E*", "GPa", "Effective modulus of the contact", contact.effective_modulus_alike, source="Hertz")
hertz.value("contact_pressure", "p_H", "MPa", "Maximum contact pressure",
    bind(contact.contact_pressure, force="roller_force_peak", effective_radius="roller_radius", length="roller_width"), source="Hertz")
hertz.value("contact_half_width", "b_H", "mm", "Half width of the contact",
    bind(contact.contact_half_width, force="roller_force_peak", effective_radius="roller_radius", length="roller_width"), source="Hertz")
hertz.value("roller_width_min", "b_min", "mm", "Roller width at the allowable pressure",
    bind(contact.required_length, force="roller_force_peak", effective_radius="roller_radius", allowable_pressure="allowable_contact_pressure"),
    source="Hertz", needs=("allowable_contact_pressure",))

locking = Chapter("Locking arc",
    text="During the dwell the disc on the crank's shaft runs in an arc of the wheel. Its cut-out spans the angle of engagement, so that the disc's "
        "edge is on the line of centres at the instant of entry: until then it holds the wheel, from then on the wheel is free to turn. Just after "
        "the exit and just before the entry the disc hardly covers its arc on one side, and the less it covers, the more play the wheel has.")
locking.value("flank_distance", "r_f", "mm", "Distance of the neighbouring slots' flanks from the crank's axis in the dwell",
    lambda crank_radius, roller_radius: crank_radius - roller_radius,
    source="geometry")
locking.value("rim_distance", "r_o", "mm", "Distance of the wheel's rim from the crank's axis",
    lambda center_distance, rim_radius: center_distance - rim_radius, source="geometry")
locking.value("locking_radius", "r_l", "mm", "Radius of the wheel's locking arcs: as given",
    bind(lambda locking_radius: locking_radius, locking_radius="inputs.locking_radius"), source="input", needs=("locking_radius",))
locking.choice("locking_radius", "r_l", "mm", "Radius of the wheel's locking arcs",
    case(formulas.thick_tip, "the arm's tip between locking arc and slot is as thick as the roller", formulas.leaves_thick_tip),
    case(formulas.half_crank, "such a tip would not pass the cut-out: half the crank's radius",
            lambda crank_radius, flank_distance, rim_distance:
                formulas.half_crank(crank_radius) >= formulas.halfway(flank_distance, rim_distance)),
    case(formulas.halfway, "the disc must reach into the wheel: halfway between rim and flank"), source="practice", lacks=("locking_radius",))
locking.require("locking_below_crank", lambda locking_radius, crank_radius: locking_radius < crank_radius, key="locking_radius",
    message="is {locking_radius}, but the locking disc must stay inside the roller's path: below the crank radius C·sin(π/z) = {crank_radius}, and "
        "by a roller radius and the arm's thickness below it", advise=("locking_radius",))
locking.value("arm_tip", "w_t", "mm", "Thickness of an arm at its tip, between locking arc and slot",
    lambda flank_distance, locking_radius: flank_distance - locking_radius, source="geometry")
locking.value("arm_neck", "w_n", "mm", "Width of an arm where the locking arc is deepest, from slot to slot",
    lambda slots, center_distance, locking_radius, roller_radius: 2 * ((center_distance - locking_radius) * np.sin(pi / slots) - roller_radius),
    source="geometry")
locking.require("clearance_below_arc", lambda locking_clearance, locking_radius: locking_clearance < locking_radius, key="locking_clearance",
    message="is {locking_clearance}, but the locking disc is smaller than its arc by that much: it must be below the arc's radius "
        "{locking_radius:down}, and leave the disc its reach", advise=("locking_clearance",))
locking.value("disc_radius", "r_d", "mm", "Radius of the locking disc", lambda locking_radius, locking_clearance: locking_radius - locking_clearance,
    source="geometry")
locking.value("locking_cutout_angle", "γ_c", "deg", "Angle of the disc's cut-out, with the roller at its middle", formulas.cutout_angle,
    source="geometry", digits=6)
locking.value("locking_arc_angle", "γ_l", "deg", "Angle of the disc's arc", lambda slots: 2 * pi - formulas.cutout_angle(slots), source="geometry",
    digits=6)
locking.value("relief_radius", "R_c", "mm", "Radius of the cut-out's hollow, which ends perpendicular to the disc's arc",
    lambda wheel_radius, disc_radius, crank_radius: wheel_radius * disc_radius / crank_radius, source="practice")
locking.value("relief_distance", "C_c", "mm", "Distance of the hollow's centre from the crank's axis",
    lambda center_distance, disc_radius, crank_radius: center_distance * disc_radius / crank_radius, source="practice")
locking.value("tip_half_angle", "δ_l", "deg", "Half the angle of a locking arc at the wheel's axis", formulas.tip_half_angle, source="geometry",
    output=False)
locking.value("corner_place", "δ", "deg", "Angle of an arm's inner corner, next to its locking arc, from the line of centres",
    lambda wheel_angle, turns, step_angle, tip_half_angle, slots: wheel_angle - turns * step_angle + tip_half_angle - pi / slots,
    source="geometry", output=False)
locking.value("corner_distance", "d_δ", "mm", "Distance of this corner from the crank's axis", lambda center_distance, rim_radius, corner_place:
        np.sqrt(center_distance**2 + rim_radius**2 - 2 * center_distance * rim_radius * np.cos(corner_place)), source="geometry", output=False)
locking.value("corner_along", "x_δ", "mm", "Its component along the crank",
    lambda center_distance, rim_radius, corner_place, crank_angle:
        center_distance * np.cos(crank_angle) - rim_radius * np.cos(crank_angle + corner_place),
    source="geometry", output=False)
locking.value("corner_to_hollow", "h_δ", "mm", "Distance of this corner from the hollow's centre",
    lambda corner_distance, relief_distance, corner_along: np.sqrt(corner_distance**2 + relief_distance**2 - 2 * relief_distance * corner_along),
    source="geometry", output=False)
locking.value("corner_gap", "g_δ", "mm", "Gap between this corner and the disc: to its arc, or to the hollow of its cut-out",
    lambda corner_distance, disc_radius, relief_radius, corner_to_hollow: np.maximum(corner_distance - disc_radius, relief_radius - corner_to_hollow),
    source="geometry", output=False)
locking.reduction("cutout_gap", "g", "mm", "Minimum gap between the arms' tips and the disc over a revolution", "min", of="corner_gap",
    source="geometry")
locking.value("cutout_overlap", "g_o", "mm", "Overlap of the arms' tips and the disc", lambda cutout_gap: (abs(cutout_gap) - cutout_gap) / 2,
    source="geometry", output=False)
locking.value("hold_half_angle", "θ_l", "deg", "Half the angle over which an arc of the wheel encloses the disc",
    bind(common.enclosed_angle, one_side="center_distance", other_side="locking_radius", opposite_side="rim_radius"), source="geometry",
    exists=REACHES)
locking.value("cover", "φ_d", "deg", "Angle by which the disc covers the wheel's arc on the side where it covers it least",
    lambda cover_angle, hold_half_angle: np.minimum(cover_angle, hold_half_angle), source="geometry", exists=REACHES, needs=HELD)
locking.value("locking_play", "Δψ", "deg", "Play of the wheel while the sheet must rest", bind(formulas.locking_play), source="geometry",
    exists=REACHES, needs=HELD)
locking.value("sheet_play", "Δx", "mm", "Displacement of the sheet during its rest", bind(formulas.travel, angle="locking_play"), source="geometry",
    exists=REACHES, needs=(*CONVEYOR_NEEDS, *HELD))
locking.value("play_allowed", "[Δψ]", "deg", "Angle by which the wheel may then turn",
    lambda allowable_sheet_play, travel_radius: as_angle(allowable_sheet_play / travel_radius), source="geometry", output=False, needs=PLAY_NEEDS)
locking.value("disc_allowed", "r_[d]", "mm", "Disc radius that permits it", bind(formulas.disc_for_play, play="play_allowed"), source="geometry",
    output=False, exists=REACHES, needs=PLAY_NEEDS)
locking.value("locking_clearance_most", "j_max", "mm", "Clearance of the locking disc at the allowable play",
    bind(lambda locking_radius, disc: locking_radius - disc, disc="disc_allowed"), source="geometry", output=False, exists=REACHES, needs=PLAY_NEEDS)
