"""Chapter on the pair's mesh, in modules: nothing in it depends on the module, but where the distance of the axes is given."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, as_number, inner, m, pi, root, value
from diecut_report.mechanics import involute
from diecut_report.plugins.gear_pair import formulas as f

# fmt: off

GIVEN_DISTANCE = ("center_distance",)
ALPHA = {"alpha": "transverse_angle"}
TEETH = {1: "teeth_1", 2: "teeth_2"}
ISO_21771 = "ISO 21771"
LARGEST_SHIFT, LEAST_SHIFT = 1.5, -1.0

mesh = Chapter("Mesh", text="Index 1 is the pinion, 2 the wheel. Heights and shifts are in modules, so this chapter applies to any module.")
mesh.require("ordered", m.teeth_1 <= m.teeth_2, key="teeth_1",
    message="is {teeth_1}, more than the {teeth_2} of the wheel; the pinion is the gear with fewer teeth: exchange the gears")
mesh.ratio = value(m.teeth_2 / m.teeth_1, digits=6), "u", "1", "Gear ratio", ISO_21771
mesh.transverse_angle = inner(involute.transverse_pressure_angle, digits=6), "α_t", "deg", "Transverse pressure angle", ISO_21771
mesh.base_helix_angle = (inner(np.arcsin(np.sin(m.helix_angle) * np.cos(m.pressure_angle)), digits=6), "β_b", "deg",
    "Helix angle at the base circle", ISO_21771)

mesh.shift_2 = value(m.inputs.shift_2, needs=("shift_2",)), "x_2", "1", "Profile shift coefficient of the wheel: as given", "input"
mesh.shift_2 = value(0, lacks=("shift_2", *GIVEN_DISTANCE)), "x_2", "1", "Profile shift coefficient of the wheel: none", "input"
mesh.working_involute = (inner(involute.working_involute.of(alpha=m.transverse_angle), lacks=GIVEN_DISTANCE, digits=6), "inv_wt", "1",
    "Involute function of the working pressure angle", ISO_21771)
mesh.require("meshes", m.working_involute > 0, key="shift_1", lacks=GIVEN_DISTANCE,
    message="is {shift_1}, so far negative with the wheel's shift {shift_2} that the flanks cannot touch; take greater shifts")
mesh.working_pressure_angle = (root(involute.involute(m.working_pressure_angle) - m.working_involute, low=0, high=0.48 * pi,
    left=np.tan(m.working_pressure_angle), right=m.working_involute + as_number(m.working_pressure_angle), lacks=GIVEN_DISTANCE, digits=6,
    tolerance=1e-12), "α_wt", "deg", "Working pressure angle", ISO_21771)
mesh.least_distance = (inner(m.inputs.module * (m.teeth_1 + m.teeth_2) * np.cos(m.transverse_angle) / (2 * np.cos(m.helix_angle)),
    needs=GIVEN_DISTANCE), "a_min", "mm", "Centre distance at which the base circles touch", ISO_21771)
mesh.require("base_circles_apart", m.inputs.center_distance > m.least_distance, key="center_distance", needs=GIVEN_DISTANCE,
    message="is {inputs.center_distance}, within which the base circles of {teeth_1} and {teeth_2} teeth overlap; take more than "
    "{least_distance:up}, or a smaller module")
mesh.working_pressure_angle = (value(np.arccos(m.least_distance / m.inputs.center_distance), needs=GIVEN_DISTANCE, digits=6), "α_wt", "deg",
    "Working pressure angle", ISO_21771)
mesh.shift_2 = (value(f.shift_of_distance.of(alpha=m.transverse_angle), needs=GIVEN_DISTANCE, digits=6), "x_2", "1",
    "Profile shift coefficient of the wheel: required by the centre distance", ISO_21771)
mesh.require("shift_2_possible", (m.shift_2 >= LEAST_SHIFT) & (m.shift_2 <= LARGEST_SHIFT), key="center_distance", needs=GIVEN_DISTANCE,
    message="is {inputs.center_distance}, which asks for a profile shift of {shift_2} at the wheel; it can be −1 … 1.5: take another "
    "center_distance, shift_1, module or number of teeth")
mesh.distance_coefficient = (inner((m.teeth_1 + m.teeth_2) / (2 * np.cos(m.helix_angle))
    * (np.cos(m.transverse_angle) / np.cos(m.working_pressure_angle) - 1), digits=6), "y", "1", "Centre distance modification coefficient", ISO_21771)
mesh.tip_alteration = (inner(m.distance_coefficient - (m.shift_1 + m.shift_2), needs=("keep_clearance=true",)), "k", "1",
    "Tip alteration coefficient that keeps the tip clearance", ISO_21771)
mesh.tip_alteration = inner(0, needs=("keep_clearance=false",)), "k", "1", "Tip alteration coefficient: none", "input"

for g, teeth in TEETH.items():
    mesh[f"tip_height_{g}"] = (inner(m.addendum + m[f"shift_{g}"] + m.tip_alteration), f"h_a{g}", "1",
        f"Height of tip {g} above the reference circle, in modules", ISO_21771)
    mesh.require(f"tip_above_base_{g}", f.tip_above_base.of(teeth=m[teeth], tip_height=m[f"tip_height_{g}"], alpha=m.transverse_angle),
        key="addendum", message=f"is {{addendum}}, with which the tip {g} lies within its base circle and has no flank; take a greater "
        "addendum or shift")
    mesh[f"tip_angle_{g}"] = (inner(involute.tip_pressure_angle.of(teeth=m[teeth], tip_height=m[f"tip_height_{g}"], alpha=m.transverse_angle),
        digits=6), f"α_at{g}", "deg", f"Transverse pressure angle at tip {g}", ISO_21771)
    mesh[f"tip_half_angle_{g}"] = (inner(involute.half_thickness.of(teeth=m[teeth], shift=m[f"shift_{g}"], alpha_there=m[f"tip_angle_{g}"],
        alpha=m.transverse_angle)), f"ψ_a{g}", "deg", f"Tooth thickness half angle at tip {g}", ISO_21771)
    mesh.require(f"tip_blunt_{g}", m[f"tip_half_angle_{g}"] > 0, key=f"shift_{g}",
        message=f"is {{shift_{g}}}, with which the tooth {g} ends in a point below its tip circle; take less shift, a smaller addendum or more teeth")
    mesh[f"shift_min_{g}"] = (value(involute.least_shift.of(teeth=m[teeth], tip_radius=m.root_radius, alpha=m.transverse_angle), digits=4),
        f"x_min{g}", "1", f"Profile shift coefficient below which tooth {g} is undercut", ISO_21771)
mesh.contact_ratio = involute.contact_ratio.of(working_angle=m.working_pressure_angle), "ε_α", "1", "Transverse contact ratio", ISO_21771
mesh.require("always_in_mesh", m.contact_ratio >= 1, key="addendum",
    message="is {addendum}, with which a pair of teeth parts before the next one meets: the contact ratio is {contact_ratio}, and 1 is the minimum "
    "that drives; take more teeth, a greater addendum, less shift, or tips that are not shortened")
for g in TEETH:
    mesh[f"shift_lacking_{g}"] = (inner(m[f"shift_min_{g}"] - m[f"shift_{g}"]), f"Δx_{g}", "1",
        f"Profile shift missing to avoid undercut of tooth {g}", ISO_21771)
mesh.shift_lacking = inner(np.maximum(m.shift_lacking_1, m.shift_lacking_2)), "Δx", "1", "Missing profile shift of the worse gear", ISO_21771
