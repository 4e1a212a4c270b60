"""Chapters on torque, roller force, contact pressure and locking."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, as_angle, bind, case
from diecut_report.mechanics import common, contact
from diecut_report.plugins.geneva_transport import formulas, loads
from diecut_report.plugins.geneva_transport.motion import CONVEYOR_NEEDS

# fmt: off


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
    case(loads.driven_with_losses, "the roller drives the wheel: the gear takes more", loads.is_driven),
    case(loads.braked_with_losses, "the roller brakes the wheel: the gear gives less back"), source="energy", output=False)
torque.value("torque", "M", "N*m", "Torque at the crank to move the wheel's inertia", bind(loads.driving_torque, driven_inertia="felt_inertia"),
    source="energy")
torque.value("roller_distance", "d", "mm", "Distance of the roller from the wheel's axis", loads.roller_distance, source="geometry", output=False)
torque.value("roller_force", "F", "N", "Force of the roller on the flank of the slot (positive: it drives)",
    bind(loads.roller_force, driven_inertia="felt_inertia"), source="statics")
torque.value("crank_force_x", "F_x", "N", "Force on the crank along the line of centres, towards the wheel", loads.force_along, source="statics",
    output=False)
torque.value("crank_force_y", "F_y", "N", "Force on the crank across the line of centres, in the direction in which its roller passes the line",
    loads.force_across, source="statics", output=False)
torque.reduction("torque_peak", "M_peak", "N*m", "Maximum torque at the crank, driving and driven", "max", of="torque", source="energy")
torque.reduction("roller_force_peak", "F_peak", "N", "Maximum roller force", "max", of="roller_force", source="statics")
torque.value("kinetic_energy_max", "E_k", "J", "Energy exchanged with the wheel at each step",
    lambda driven_inertia, speed_ratio_peak, crank_speed: driven_inertia * (speed_ratio_peak * crank_speed) ** 2 / 2, source="energy")
torque.reduction("energy_turn", "E_Σ", "J", "Work of the torque over a revolution", "integral", of="torque", output=False, source="energy")
torque.value("energy_lost", "E_v", "J", "Energy that the gear behind the wheel takes in a step", loads.energy_lost, source="energy", output=False)
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
locking.value("flank_distance", "r_f", "mm", "Distance of the neighbouring slots' flanks from the crank's axis in the dwell", loads.flank_distance,
    source="geometry")
locking.value("rim_distance", "r_o", "mm", "Distance of the wheel's rim from the crank's axis", loads.rim_distance, source="geometry")
locking.value("locking_radius", "r_l", "mm", "Radius of the wheel's locking arcs: as given",
    bind(lambda locking_radius: locking_radius, locking_radius="inputs.locking_radius"), source="input", needs=("locking_radius",))
locking.choice("locking_radius", "r_l", "mm", "Radius of the wheel's locking arcs",
    case(loads.thick_tip, "the arm's tip between locking arc and slot is as thick as the roller", loads.leaves_thick_tip),
    case(loads.half_crank, "such a tip would not pass the cut-out: half the crank's radius", loads.is_deep_enough),
    case(loads.halfway, "the disc must reach into the wheel: halfway between rim and flank"), source="practice", lacks=("locking_radius",))
locking.require("locking_below_crank", lambda locking_radius, crank_radius: locking_radius < crank_radius, key="locking_radius",
    message="is {locking_radius}, but the locking disc must stay inside the roller's path: below the crank radius C·sin(π/z) = {crank_radius}, and "
        "by a roller radius and the arm's thickness below it", advise=("locking_radius",))
locking.value("arm_tip", "w_t", "mm", "Thickness of an arm at its tip, between locking arc and slot",
    lambda flank_distance, locking_radius: flank_distance - locking_radius, source="geometry")
locking.value("arm_neck", "w_n", "mm", "Width of an arm where the locking arc is deepest, from slot to slot",
    lambda slots, center_distance, locking_radius, roller_radius: 2 * ((center_distance - locking_radius) * np.sin(np.pi / slots) - roller_radius),
    source="geometry")
locking.require("clearance_below_arc", lambda locking_clearance, locking_radius: locking_clearance < locking_radius, key="locking_clearance",
    message="is {locking_clearance}, but the locking disc is smaller than its arc by that much: it must be below the arc's radius "
        "{locking_radius:down}, and leave the disc its reach", advise=("locking_clearance",))
locking.value("disc_radius", "r_d", "mm", "Radius of the locking disc", lambda locking_radius, locking_clearance: locking_radius - locking_clearance,
    source="geometry")
locking.value("locking_cutout_angle", "γ_c", "deg", "Angle of the disc's cut-out, with the roller at its middle", formulas.cutout_angle,
    source="geometry", digits=6)
locking.value("locking_arc_angle", "γ_l", "deg", "Angle of the disc's arc", lambda slots: 2 * np.pi - formulas.cutout_angle(slots), source="geometry",
    digits=6)
locking.value("relief_radius", "R_c", "mm", "Radius of the cut-out's hollow, which ends perpendicular to the disc's arc",
    lambda wheel_radius, disc_radius, crank_radius: wheel_radius * disc_radius / crank_radius, source="practice")
locking.value("relief_distance", "C_c", "mm", "Distance of the hollow's centre from the crank's axis",
    lambda center_distance, disc_radius, crank_radius: center_distance * disc_radius / crank_radius, source="practice")
locking.value("tip_half_angle", "δ_l", "deg", "Half the angle of a locking arc at the wheel's axis", loads.tip_half_angle, source="geometry",
    output=False)
locking.value("corner_place", "δ", "deg", "Angle of an arm's inner corner, next to its locking arc, from the line of centres", loads.corner_place,
    source="geometry", output=False)
locking.value("corner_distance", "d_δ", "mm", "Distance of this corner from the crank's axis", lambda center_distance, rim_radius, corner_place:
        np.sqrt(center_distance**2 + rim_radius**2 - 2 * center_distance * rim_radius * np.cos(corner_place)), source="geometry", output=False)
locking.value("corner_along", "x_δ", "mm", "Its component along the crank", loads.corner_along, source="geometry", output=False)
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
