"""The calculation of the Geneva drive: the wheel, its motion over a turn of the crank, the conveyor's, and the forces."""

from __future__ import annotations

import numpy as np

from diecut_report.api import (
    CURVE_ROUNDING,
    Chapter,
    abscissa,
    as_angle,
    case,
    choice,
    inner,
    m,
    pi,
    reduction,
    self_test,
    value,
)
from diecut_report.mechanics import common, contact
from diecut_report.plugins.geneva_transport import formulas
from diecut_report.plugins.geneva_transport.inputs import GRIPPED

# fmt: off


"""The keys with which the pull of the sheet at its grippers is known."""


CONVEYOR_NEEDS = ("sprocket_teeth", "chain_pitch")

geometry = Chapter("Wheel, crank and slots",
    text="The roller enters and leaves the slots along their direction, hence without impact: crank and slot are then perpendicular to each other.")
geometry.step_angle = value(2 * pi / m.slots, digits=6), "τ", "deg", "Step of the wheel", "000, Fig. 1"
geometry.crank_ratio = formulas.crank_ratio, "λ", "1", "Ratio of crank radius to centre distance", "geometry"
geometry.crank_radius = m.crank_ratio * m.center_distance, "r", "mm", "Radius of the crank", "geometry"
geometry.wheel_radius = (m.center_distance * np.cos(pi / m.slots), "R", "mm", "Radius of the wheel: distance of the roller from its axis at entry",
    "geometry")
geometry.require("roller_below_crank", m.roller_radius < m.crank_radius, key="roller_radius",
    message="is {roller_radius}, but the roller would cover the crank's axis: it must be smaller than the crank radius C·sin(π/z) = "
    "{crank_radius:down}")
geometry.rim_radius = (np.sqrt(m.wheel_radius**2 + m.roller_radius**2), "R_o", "mm",
    "Radius of the wheel's rim, where both flanks guide the roller from its entry on", "geometry")
geometry.slot_length = (m.center_distance * (m.crank_ratio + np.cos(pi / m.slots) - 1) + m.roller_radius, "l", "mm",
    "Length of the slots from the radius R", "geometry")
geometry.nearest_distance = m.center_distance * (1 - m.crank_ratio), "d_0", "mm", "Minimum distance of the roller from the wheel's axis", "geometry"
geometry.require("slot_before_axis", m.roller_radius < m.nearest_distance, key="roller_radius",
    message="is {roller_radius}, but the slots would reach beyond the wheel's axis: the roller comes within C(1 − λ) = {nearest_distance:down} of "
    "it and must be smaller than that")
geometry.hub_radius_max = m.nearest_distance - m.roller_radius, "r_h", "mm", "Radius left for hub and shaft inside the slots", "geometry"
geometry.slot_spacing = (2 * m.nearest_distance * np.sin(pi / m.slots), "e", "mm",
    "Distance between the centre lines of neighbouring slots at their inner ends", "geometry")
geometry.slot_width = 2 * m.roller_radius, "b_s", "mm", "Width of the slots", "geometry"
geometry.roller_clearance = m.slot_spacing - m.slot_width, "w", "mm", "Wall between neighbouring slots at their inner ends", "geometry"

dwell = Chapter("Motion and dwell")
dwell.engagement_half_angle = (value(formulas.engagement_half_angle, digits=6), "α_e", "deg",
    "Crank angle from the middle of the motion to the roller's exit", "geometry")
dwell.entry_angle = (value(2 * pi - formulas.engagement_half_angle(m.slots), digits=6), "α_in", "deg",
    "Crank angle at which the roller enters the next slot", "geometry")
dwell.motion_fraction = formulas.motion_fraction, "κ_m", "1", "Fraction of a revolution in which the wheel turns", "geometry"
dwell.dwell_fraction = formulas.dwell_fraction, "κ_d", "1", "Fraction of a revolution in which it dwells", "geometry"
dwell.cycle_time = 2 * pi / m.crank_speed, "T", "ms", "Time of a revolution of the crank", "kinematics"
dwell.time_motion = formulas.motion_fraction(m.slots) * m.cycle_time, "t_m", "ms", "Time of the motion", "kinematics"
dwell.time_dwell = formulas.dwell_fraction(m.slots) * m.cycle_time, "t_d", "ms", "Time of the dwell", "kinematics"
dwell.speed_ratio_peak = (m.crank_ratio / (1 - m.crank_ratio), "ω_21,max", "1",
    "Maximum ratio of the wheel's speed to the crank's, in the middle of the motion", "kinematics")
dwell.acceleration_entry = (np.tan(pi / m.slots), "ε_21,e", "1",
    "Ratio of the jump of the wheel's acceleration at entry and exit to the square of the crank's speed", "kinematics")
dwell.acceleration_peak_angle = (value(formulas.acceleration_peak_angle, digits=6), "α_ε", "deg",
    "Crank angle before and after the middle of the motion at which the acceleration is largest", "kinematics")

IN_SLOT = m.engaged == 1
MOVING, RESTING = "the roller is in a slot", "the locking disc holds the wheel"

motion = Chapter("Motion over a revolution of the crank",
    text="The crank angle is measured from the middle of the motion, so that the revolution begins and ends within an engagement; α′ is measured "
        "from the middle of the current engagement. The wheel turns in the opposite direction to the crank; its angle is counted in its own "
        "direction. s and n hold for a whole piece of the revolution and are shown in its middle, all other curves at the stated α.")
motion.crank_angle = (abscissa(2 * np.pi, shown_at="acceleration_peak_at", speed="crank_speed"), "α", "deg",
    "Crank angle from the middle of the motion")
motion.breakpoints("engagement", "crank_angle", "engagement_half_angle", "entry_angle")
motion.phase("moving", "moving", "Motion of wheel and sheet", "crank_angle", ("entry_angle", "engagement_half_angle"))
motion.phase("dwell", "rest", "Dwell of wheel and sheet", "crank_angle", rest_of=("moving",))
motion.engaged = (choice(case(1, MOVING, (m.crank_angle <= m.engagement_half_angle) | (m.crank_angle >= m.entry_angle)), case(0, RESTING),
    output=False, per_piece=True), "s", "1", "Roller in a slot (1) or not (0)")
motion.turns = (choice(case(1, "the roller has entered the next slot", m.crank_angle >= m.entry_angle),
    case(0, "the roller has not yet entered the next slot"), output=False, per_piece=True), "n", "1", "Number of completed steps of the wheel")
motion.middle_angle = inner(m.crank_angle - 2 * pi * m.turns), "α′", "deg", "Crank angle from the middle of the present engagement", "kinematics"
motion.wheel_angle = (choice(case(formulas.wheel_angle.of(angle=m.middle_angle), MOVING, IN_SLOT), case(m.step_angle / 2, RESTING)), "ψ", "deg",
    "Angle of the wheel from its position in the middle of its motion", "kinematics")
motion.speed_ratio = (choice(case(formulas.speed_ratio.of(angle=m.middle_angle), MOVING, IN_SLOT), case(0, RESTING), output=False), "ω_21", "1",
    "Ratio of the wheel's angular speed to the crank's", "kinematics")
motion.acceleration_ratio = (choice(case(formulas.acceleration_ratio.of(angle=m.middle_angle), MOVING, IN_SLOT), case(0, RESTING), output=False),
    "ε_21", "1", "Ratio of the wheel's angular acceleration to the square of the crank's speed", "kinematics")
motion.acceleration_peak = (reduction("max", of="acceleration_ratio"), "ε_21,max", "1",
    "Maximum ratio of the wheel's acceleration to the square of the crank's speed", "kinematics")
motion.wheel_speed = formulas.rate.of(ratio=m.speed_ratio), "ω_2", "rad/s", "Angular speed of the wheel", "kinematics"
motion.wheel_acceleration = formulas.rate_of_rate.of(ratio=m.acceleration_ratio), "ε_2", "rad/s**2", "Angular acceleration of the wheel", "kinematics"
motion.wheel_speed_max = formulas.rate.of(ratio=m.speed_ratio_peak), "ω_2,max", "rad/s", "Maximum angular speed of the wheel", "kinematics"
motion.wheel_acceleration_max = (formulas.rate_of_rate.of(ratio=m.acceleration_peak), "ε_2,max", "rad/s**2",
    "Maximum angular acceleration of the wheel", "kinematics")

conveyor = Chapter("Motion of the sheet", needs=CONVEYOR_NEEDS, absent="not calculated: {missing} not given")
conveyor.travel_radius = (m.sprocket_teeth * m.chain_pitch * m.gear_ratio / (2 * pi), "r_c", "mm", "Conveyor displacement per radian of the wheel",
    "000, Fig. 1")
conveyor.sheet_step = (m.sprocket_teeth * m.chain_pitch * m.gear_ratio / m.slots, "S", "mm", "Step of the conveyor per revolution of the crank",
    "000, Fig. 1")
conveyor.sheet_position = (formulas.travel.of(angle=m.wheel_angle), "x", "mm", "Position of the sheet from that in the middle of its motion",
    "kinematics")
conveyor.sheet_velocity = formulas.travel_rate.of(ratio=m.speed_ratio), "v", "m/s", "Velocity of the sheet", "kinematics"
conveyor.sheet_acceleration = formulas.travel_acceleration.of(ratio=m.acceleration_ratio), "a", "m/s**2", "Acceleration of the sheet", "kinematics"
conveyor.sheet_velocity_max = formulas.travel_rate.of(ratio=m.speed_ratio_peak), "v_max", "m/s", "Maximum velocity of the sheet", "kinematics"
conveyor.sheet_acceleration_max = (formulas.travel_acceleration.of(ratio=m.acceleration_peak), "a_max", "m/s**2",
    "Maximum acceleration of the sheet", "kinematics")
conveyor.sheet_acceleration_entry = (formulas.travel_acceleration.of(ratio=m.acceleration_entry), "a_e", "m/s**2",
    "Jump of the sheet's acceleration at entry and exit", "kinematics")

grippers = Chapter("Holding force of the grippers",
    text="The grippers must hold the sheet against its own inertia; air resistance and the friction of the surface on which it slides are neglected.",
    needs=GRIPPED, absent="not calculated: {missing} not given")
grippers.sheet_mass = contact.sheet_mass, "m_s", "g", "Mass of the sheet", "geometry"
grippers.sheet_force = contact.sheet_force, "F_g", "N", "Maximum force of the sheet on its grippers", "mechanics"
rest = Chapter("Rest of the sheet within a tolerance", text="The sheet is at rest as long as it is within e of its dwell position.",
    needs=(*CONVEYOR_NEEDS, "rest_tolerance"), absent="not calculated: {missing} not given")
rest.require("tolerance_below_step", 2 * m.rest_tolerance < m.sheet_step, key="rest_tolerance",
    message="is {rest_tolerance}, but must be less than half the step {sheet_step}")
rest.rest_wheel_angle = (as_angle((m.sheet_step / 2 - m.rest_tolerance) / m.travel_radius), "ψ_e", "deg",
    "Angle of the wheel from the middle of its motion at which the sheet comes within the tolerance", "kinematics")
rest.rest_start = (value(np.arcsin(np.sin(m.rest_wheel_angle) / m.crank_ratio) - m.rest_wheel_angle, digits=6), "α_r1", "deg",
    "Crank angle at which the sheet comes within the tolerance", "kinematics")
rest.rest_end = value(2 * pi - m.rest_start, digits=6), "α_r2", "deg", "Crank angle at which the sheet leaves it again", "symmetry"
rest.phase("rest", "rest", "Rest of the sheet within the tolerance", "crank_angle", ("rest_start", "rest_end"))


HELD = ("cover_angle",)
PLAY_NEEDS = (*CONVEYOR_NEEDS, *HELD, "allowable_sheet_play")
REACHES = m.rim_distance < m.disc_radius

torque = Chapter("Torque at the crank and roller force",
    text="In the first half of the motion the roller pushes the wheel, in the second half it holds it back with the other flank of the slot. The "
        "crank recovers the energy that it supplies, but for the losses of the gear behind the wheel.",
    needs=("driven_inertia",), absent="not calculated: driven_inertia is not given")
torque.require("own_share", m.own_inertia <= m.driven_inertia, key="own_inertia",
    message="is more than driven_inertia, of which it is a part; give less")
torque.felt_inertia = (choice(case(formulas.driven_with_losses, "the roller drives the wheel: the gear takes more", formulas.is_driven),
    case(formulas.braked_with_losses, "the roller brakes the wheel: the gear gives less back"), output=False), "J_w", "kg*m**2",
    "Inertia that the roller feels, with the losses of the gear behind the wheel", "energy")
torque.torque = formulas.driving_torque.of(driven_inertia=m.felt_inertia), "M", "N*m", "Torque at the crank to move the wheel's inertia", "energy"
torque.roller_distance = inner(formulas.roller_distance), "d", "mm", "Distance of the roller from the wheel's axis", "geometry"
torque.roller_force = (formulas.roller_force.of(driven_inertia=m.felt_inertia), "F", "N",
    "Force of the roller on the flank of the slot (positive: it drives)", "statics")
torque.crank_force_x = (inner(-m.roller_force * m.center_distance * m.crank_ratio * np.sin(m.crank_angle) / m.roller_distance), "F_x", "N",
    "Force on the crank along the line of centres, towards the wheel", "statics")
torque.crank_force_y = (inner(-m.roller_force * m.center_distance * (1 - m.crank_ratio * np.cos(m.crank_angle)) / m.roller_distance), "F_y", "N",
    "Force on the crank across the line of centres, in the direction in which its roller passes the line", "statics")
torque.torque_peak = reduction("max", of="torque"), "M_peak", "N*m", "Maximum torque at the crank, driving and driven", "energy"
torque.roller_force_peak = reduction("max", of="roller_force"), "F_peak", "N", "Maximum roller force", "statics"
torque.kinetic_energy_max = (m.driven_inertia * (m.speed_ratio_peak * m.crank_speed) ** 2 / 2, "E_k", "J",
    "Energy exchanged with the wheel at each step", "energy")
torque.energy_turn = reduction("integral", of="torque", output=False), "E_Σ", "J", "Work of the torque over a revolution", "energy"
torque.energy_lost = (inner(m.kinetic_energy_max * (1 - m.own_inertia / m.driven_inertia) * (1 / m.efficiency - m.efficiency)), "E_v", "J",
    "Energy that the gear behind the wheel takes in a step", "energy")
torque.energy_residual = (self_test(m.energy_turn, m.energy_lost, scale=m.kinetic_energy_max, within=CURVE_ROUNDING, check="energy_balance",
    title="Energy balance over a revolution"), "r_E", "1", "Ratio of the work over a revolution, but for the losses, to the energy of a step",
    "conservation of energy")

hertz = Chapter("Contact of roller and slot",
    text="A cylindrical roller on the plane flank of the slot, both of the same material; the load is uniform over the roller's width.",
    needs=("driven_inertia", "roller_width"), absent="not calculated: {missing} not given")
hertz.effective_modulus = contact.effective_modulus_alike, "E*", "GPa", "Effective modulus of the contact", "Hertz"
hertz.contact_pressure = (contact.contact_pressure.of(force=m.roller_force_peak, effective_radius=m.roller_radius, length=m.roller_width), "p_H",
    "MPa", "Maximum contact pressure", "Hertz")
hertz.contact_half_width = (contact.contact_half_width.of(force=m.roller_force_peak, effective_radius=m.roller_radius, length=m.roller_width), "b_H",
    "mm", "Half width of the contact", "Hertz")
hertz.roller_width_min = (value(contact.required_length.of(force=m.roller_force_peak, effective_radius=m.roller_radius,
    allowable_pressure=m.allowable_contact_pressure), needs=("allowable_contact_pressure",)), "b_min", "mm",
    "Roller width at the allowable pressure", "Hertz")

locking = Chapter("Locking arc",
    text="During the dwell the disc on the crank's shaft runs in an arc of the wheel. Its cut-out spans the angle of engagement, so that the disc's "
        "edge is on the line of centres at the instant of entry: until then it holds the wheel, from then on the wheel is free to turn. Just after "
        "the exit and just before the entry the disc hardly covers its arc on one side, and the less it covers, the more play the wheel has.")
locking.flank_distance = (m.crank_radius - m.roller_radius, "r_f", "mm",
    "Distance of the neighbouring slots' flanks from the crank's axis in the dwell", "geometry")
locking.rim_distance = m.center_distance - m.rim_radius, "r_o", "mm", "Distance of the wheel's rim from the crank's axis", "geometry"
locking.locking_radius = (value(m.inputs.locking_radius, needs=("locking_radius",)), "r_l", "mm", "Radius of the wheel's locking arcs: as given",
    "input")
locking.locking_radius = (choice(case(formulas.thick_tip, "the arm's tip between locking arc and slot is as thick as the roller",
    formulas.leaves_thick_tip), case(formulas.half_crank, "such a tip would not pass the cut-out: half the crank's radius",
    formulas.half_crank(m.crank_radius) >= formulas.halfway(m.flank_distance, m.rim_distance)),
    case(formulas.halfway, "the disc must reach into the wheel: halfway between rim and flank"), lacks=("locking_radius",)), "r_l", "mm",
    "Radius of the wheel's locking arcs", "practice")
locking.require("locking_below_crank", m.locking_radius < m.crank_radius, key="locking_radius",
    message="is {locking_radius}, but the locking disc must stay inside the roller's path: below the crank radius C·sin(π/z) = {crank_radius}, and "
    "by a roller radius and the arm's thickness below it", advise=("locking_radius",))
locking.arm_tip = m.flank_distance - m.locking_radius, "w_t", "mm", "Thickness of an arm at its tip, between locking arc and slot", "geometry"
locking.arm_neck = (2 * ((m.center_distance - m.locking_radius) * np.sin(pi / m.slots) - m.roller_radius), "w_n", "mm",
    "Width of an arm where the locking arc is deepest, from slot to slot", "geometry")
locking.require("clearance_below_arc", m.locking_clearance < m.locking_radius, key="locking_clearance",
    message="is {locking_clearance}, but the locking disc is smaller than its arc by that much: it must be below the arc's radius "
    "{locking_radius:down}, and leave the disc its reach", advise=("locking_clearance",))
locking.disc_radius = m.locking_radius - m.locking_clearance, "r_d", "mm", "Radius of the locking disc", "geometry"
locking.locking_cutout_angle = (value(formulas.cutout_angle, digits=6), "γ_c", "deg", "Angle of the disc's cut-out, with the roller at its middle",
    "geometry")
locking.locking_arc_angle = value(2 * pi - formulas.cutout_angle(m.slots), digits=6), "γ_l", "deg", "Angle of the disc's arc", "geometry"
locking.relief_radius = (m.wheel_radius * m.disc_radius / m.crank_radius, "R_c", "mm",
    "Radius of the cut-out's hollow, which ends perpendicular to the disc's arc", "practice")
locking.relief_distance = (m.center_distance * m.disc_radius / m.crank_radius, "C_c", "mm", "Distance of the hollow's centre from the crank's axis",
    "practice")
locking.tip_half_angle = inner(formulas.tip_half_angle), "δ_l", "deg", "Half the angle of a locking arc at the wheel's axis", "geometry"
locking.corner_place = (inner(m.wheel_angle - m.turns * m.step_angle + m.tip_half_angle - pi / m.slots), "δ", "deg",
    "Angle of an arm's inner corner, next to its locking arc, from the line of centres", "geometry")
locking.corner_distance = (inner(np.sqrt(m.center_distance**2 + m.rim_radius**2 - 2 * m.center_distance * m.rim_radius * np.cos(m.corner_place))),
    "d_δ", "mm", "Distance of this corner from the crank's axis", "geometry")
locking.corner_along = (inner(m.center_distance * np.cos(m.crank_angle) - m.rim_radius * np.cos(m.crank_angle + m.corner_place)), "x_δ", "mm",
    "Its component along the crank", "geometry")
locking.corner_to_hollow = (inner(np.sqrt(m.corner_distance**2 + m.relief_distance**2 - 2 * m.relief_distance * m.corner_along)), "h_δ", "mm",
    "Distance of this corner from the hollow's centre", "geometry")
locking.corner_gap = (inner(np.maximum(m.corner_distance - m.disc_radius, m.relief_radius - m.corner_to_hollow)), "g_δ", "mm",
    "Gap between this corner and the disc: to its arc, or to the hollow of its cut-out", "geometry")
locking.cutout_gap = reduction("min", of="corner_gap"), "g", "mm", "Minimum gap between the arms' tips and the disc over a revolution", "geometry"
locking.cutout_overlap = inner((abs(m.cutout_gap) - m.cutout_gap) / 2), "g_o", "mm", "Overlap of the arms' tips and the disc", "geometry"
locking.hold_half_angle = (value(common.enclosed_angle.of(one_side=m.center_distance, other_side=m.locking_radius, opposite_side=m.rim_radius),
    exists=REACHES), "θ_l", "deg", "Half the angle over which an arc of the wheel encloses the disc", "geometry")
locking.cover = (value(np.minimum(m.cover_angle, m.hold_half_angle), exists=REACHES, needs=HELD), "φ_d", "deg",
    "Angle by which the disc covers the wheel's arc on the side where it covers it least", "geometry")
locking.locking_play = (value(formulas.locking_play.of(), exists=REACHES, needs=HELD), "Δψ", "deg", "Play of the wheel while the sheet must rest",
    "geometry")
locking.sheet_play = (value(formulas.travel.of(angle=m.locking_play), exists=REACHES, needs=(*CONVEYOR_NEEDS, *HELD)), "Δx", "mm",
    "Displacement of the sheet during its rest", "geometry")
locking.play_allowed = (inner(as_angle(m.allowable_sheet_play / m.travel_radius), needs=PLAY_NEEDS), "[Δψ]", "deg",
    "Angle by which the wheel may then turn", "geometry")
locking.disc_allowed = (inner(formulas.disc_for_play.of(play=m.play_allowed), exists=REACHES, needs=PLAY_NEEDS), "r_[d]", "mm",
    "Disc radius that permits it", "geometry")
locking.locking_clearance_most = (inner(m.locking_radius - m.disc_allowed, exists=REACHES, needs=PLAY_NEEDS), "j_max", "mm",
    "Clearance of the locking disc at the allowable play", "geometry")
