"""Chapters on torque, roller force, contact pressure and locking."""

from __future__ import annotations

from diecut_report.api import Case, Chapter, Choice, Reduction, Require, Value, Words, bind
from diecut_report.mechanics import common, contact, triangle
from diecut_report.plugins.geneva_transport import advice, formulas, loads
from diecut_report.plugins.geneva_transport.motion import CONVEYOR_NEEDS

GEOMETRY = ("slots", "center_distance", "locking_clearance", "roller_radius")

REACHES = bind(common.is_below, smaller="rim_distance", greater="disc_radius")

TORQUE = Chapter(
    "Torque at the crank and roller force",
    needs=("driven_inertia",),
    absent="not calculated: driven_inertia is not given",
    text="In the first half of the motion the roller pushes the wheel, in the second half it holds it back with the slot's other flank. "
    "What the crank puts in it gets back.",
    steps=(
        Value(id="torque", symbol="M", unit="N*m", description="Torque at the crank that moves the wheel's inertia", source="energy",
              formula=loads.driving_torque),
        Value(id="roller_distance", symbol="d", unit="mm", description="Distance of the roller from the wheel's axis", source="geometry",
              output=False, formula=loads.roller_distance),
        Value(id="roller_force", symbol="F", unit="N", description="Force of the roller on the slot's flank (positive: it drives)",
              source="statics", formula=loads.roller_force),
        Reduction(id="torque_peak", symbol="M_peak", unit="N*m", description="Greatest torque at the crank, driving and driven", of="torque",
                  operation="max", source="energy"),
        Reduction(id="roller_force_peak", symbol="F_peak", unit="N", description="Greatest roller force", of="roller_force", operation="max",
                  source="statics"),
        Value(id="kinetic_energy_max", symbol="E_k", unit="J", description="Energy that goes into the wheel and back at each step",
              source="energy", formula=bind(loads.kinetic_energy, speed_ratio="speed_ratio_peak")),
        Reduction(id="energy_turn", symbol="E_Σ", unit="J", description="Work of the torque over a turn", of="torque", operation="integral",
                  output=False, source="energy"),
        Value(id="energy_residual", symbol="r_E", description="Work over a turn to the energy of a step", source="energy", output=False,
              formula=bind(common.relative_size, quantity="energy_turn", scale="kinetic_energy_max")),
    ),
)  # fmt: skip

CONTACT = Chapter(
    "Contact of roller and slot",
    needs=("driven_inertia", "roller_width"),
    absent="not calculated: driven_inertia and roller_width are not both given",
    text="A cylindrical roller on the plane flank of the slot, both of one material; the load is even over the roller's width.",
    steps=(
        Value(id="effective_modulus", symbol="E*", unit="GPa", description="Modulus of the contact", source="Hertz",
              formula=contact.effective_modulus_alike),
        Value(id="contact_pressure", symbol="p_H", unit="MPa", description="Greatest contact pressure", source="Hertz",
              formula=bind(contact.contact_pressure, force="roller_force_peak", effective_radius="roller_radius", length="roller_width")),
        Value(id="contact_half_width", symbol="b_H", unit="mm", description="Half the width of the contact", source="Hertz",
              formula=bind(contact.contact_half_width, force="roller_force_peak", effective_radius="roller_radius", length="roller_width")),
        Value(id="roller_width_min", symbol="b_min", unit="mm", description="Width of roller that keeps the allowed pressure", source="Hertz",
              needs=("allowable_contact_pressure",),
              formula=bind(contact.required_length, force="roller_force_peak", effective_radius="roller_radius",
                           allowable_pressure="allowable_contact_pressure")),
    ),
)  # fmt: skip

LOCKING = Chapter(
    "Locking arc",
    text="In the dwell the disc on the crank's shaft runs in an arc of the wheel. Its cut-out takes the engagement's angle, so that the "
    "disc's edge stands on the line of centres at the instant of entry: up to then it holds, from then on the wheel is free to turn.",
    steps=(
        Value(id="flank_distance", symbol="r_f", unit="mm", source="geometry",
              description="Distance of the neighbouring slots' flanks from the crank's axis in the dwell", formula=loads.flank_distance),
        Value(id="rim_distance", symbol="r_o", unit="mm", description="Distance of the wheel's rim from the crank's axis", source="geometry",
              formula=loads.rim_distance),
        Value(id="locking_radius", symbol="r_l", unit="mm", description="Radius of the wheel's locking arcs: as given", source="input",
              needs=("locking_radius",), formula=bind(common.same, quantity="inputs.locking_radius")),
        Choice(id="locking_radius", symbol="r_l", unit="mm", description="Radius of the wheel's locking arcs", source="practice",
               lacks=("locking_radius",),
               cases=(Case(loads.thick_tip, "the arm's tip between locking arc and slot is as thick as the roller", loads.leaves_thick_tip),
                      Case(loads.half_crank, "such a tip would not pass the cut-out: half the crank's radius", loads.is_deep_enough),
                      Case(loads.halfway, "the disc must reach into the wheel: halfway between rim and flank"))),
        Words(id="roller_fits", function=advice.roller_that_fits, takes=GEOMETRY, lacks=("locking_radius",)),
        Words(id="roller_fits", function=advice.roller_that_fits, takes=(*GEOMETRY, "locking_radius"), needs=("locking_radius",)),
        Words(id="arc_fits", function=advice.arc_that_fits, takes=(*GEOMETRY, "locking_radius")),
        Words(id="clearance_fits", function=advice.clearance_that_fits, takes=("slots", "center_distance", "roller_radius", "locking_radius")),
        Require(id="locking_below_crank", condition=bind(common.is_below, smaller="locking_radius", greater="crank_radius"),
                key="locking_radius", message="is {locking_radius}, but the locking disc must stay inside the roller's path: below the crank "
                "radius C·sin(π/z) = {crank_radius}, and by a roller radius and the arm's thickness below it; take {arc_fits}{roller_fits}"),
        Value(id="arm_tip", symbol="w_t", unit="mm", description="Thickness of an arm at its tip, between locking arc and slot",
              source="geometry", formula=bind(common.difference, greater="flank_distance", smaller="locking_radius")),
        Value(id="arm_neck", symbol="w_n", unit="mm", description="Width of an arm where the locking arc is deepest, from slot to slot",
              source="geometry", formula=loads.neck),
        Require(id="clearance_below_arc", condition=bind(common.is_below, smaller="locking_clearance", greater="locking_radius"),
                key="locking_clearance", message="is {locking_clearance}, but the locking disc is smaller than its arc by that much: it must be "
                "below the arc's radius {locking_radius:down}, and leave the disc its reach: {clearance_fits}"),
        Value(id="disc_radius", symbol="r_d", unit="mm", description="Radius of the locking disc", source="geometry",
              formula=bind(common.difference, greater="locking_radius", smaller="locking_clearance")),
        Value(id="locking_cutout_angle", symbol="γ_c", unit="deg", description="Angle of the disc's cut-out, in its middle the roller",
              source="geometry", digits=6, formula=formulas.cutout_angle),
        Value(id="locking_arc_angle", symbol="γ_l", unit="deg", description="Angle of the disc's arc", source="geometry", digits=6,
              formula=formulas.arc_angle),
        Value(id="relief_radius", symbol="R_c", unit="mm", source="practice",
              description="Radius of the cut-out's hollow, which ends square to the disc's arc", formula=bind(loads.scaled, length="wheel_radius")),
        Value(id="relief_distance", symbol="C_c", unit="mm", source="practice",
              description="Distance of the hollow's centre from the crank's axis", formula=bind(loads.scaled, length="center_distance")),
        Value(id="tip_half_angle", symbol="δ_l", unit="deg", source="geometry", output=False,
              description="Half the angle of a locking arc at the wheel's axis", formula=loads.tip_half_angle),
        Value(id="corner_place", symbol="δ", unit="deg", source="geometry", output=False,
              description="Angle of an arm's inner corner, beside its locking arc, from the line of centres", formula=loads.corner_place),
        Value(id="corner_distance", symbol="d_δ", unit="mm", source="geometry", output=False,
              description="Distance of this corner from the crank's axis",
              formula=bind(triangle.third_side, one_side="center_distance", other_side="rim_radius", enclosed="corner_place")),
        Value(id="corner_along", symbol="x_δ", unit="mm", source="geometry", output=False,
              description="Part of it along the crank", formula=loads.corner_along),
        Value(id="corner_to_hollow", symbol="h_δ", unit="mm", source="geometry", output=False,
              description="Distance of this corner from the hollow's centre", formula=loads.corner_to_hollow),
        Value(id="corner_gap", symbol="g_δ", unit="mm", source="geometry", output=False,
              description="Gap between this corner and the disc: to its arc, or to the hollow of its cut-out", formula=loads.corner_gap),
        Reduction(id="cutout_gap", symbol="g", unit="mm", source="geometry", of="corner_gap", operation="min",
                  description="Least gap between the arms' tips and the disc over a turn"),
        Value(id="cutout_overlap", symbol="g_o", unit="mm", source="geometry", output=False,
              description="Overlap of the arms' tips and the disc", formula=bind(loads.overlap, gap="cutout_gap")),
        Value(id="hold_half_angle", symbol="θ_l", unit="deg", source="geometry", exists=REACHES,
              description="Half the angle over which an arc of the wheel encloses the disc",
              formula=bind(triangle.enclosed_angle, one_side="center_distance", other_side="locking_radius", opposite_side="rim_radius")),
        Value(id="locking_play", symbol="Δψ", unit="deg", source="geometry", exists=REACHES,
              description="Angle by which the wheel can turn either way in the dwell", formula=bind(loads.play, clearance="locking_clearance")),
        Value(id="sheet_play", symbol="Δx", unit="mm", source="geometry", exists=REACHES,
              needs=CONVEYOR_NEEDS, description="Way by which the sheet can move either way in the dwell",
              formula=bind(formulas.travel, angle="locking_play")),
    ),
)  # fmt: skip
