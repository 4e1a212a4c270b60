"""Chapter on the pair's mesh, in modules: nothing in it depends on the module, but where the distance of the axes is given."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, as_number, bind, pi
from diecut_report.mechanics import involute
from diecut_report.plugins.gear_pair import formulas as f

# fmt: off

GIVEN_DISTANCE = ("center_distance",)
ALPHA = {"alpha": "transverse_angle"}
TEETH = {1: "teeth_1", 2: "teeth_2"}
ISO_21771 = "ISO 21771"
LARGEST_SHIFT, LEAST_SHIFT = 1.5, -1.0

mesh = Chapter("Mesh", text="Index 1 is the pinion, 2 the wheel. Heights and shifts are in modules, so this chapter applies to any module.")
mesh.require("ordered", lambda teeth_1, teeth_2: teeth_1 <= teeth_2, key="teeth_1",
    message="is {teeth_1}, more than the {teeth_2} of the wheel; the pinion is the gear with fewer teeth: exchange the gears")
mesh.value("ratio", "u", "1", "Gear ratio", lambda teeth_1, teeth_2: teeth_2 / teeth_1, source=ISO_21771, digits=6)
mesh.value("transverse_angle", "α_t", "deg", "Transverse pressure angle", involute.transverse_pressure_angle, source=ISO_21771, output=False,
    digits=6)
mesh.value("base_helix_angle", "β_b", "deg", "Helix angle at the base circle",
    lambda pressure_angle, helix_angle: np.arcsin(np.sin(helix_angle) * np.cos(pressure_angle)), source=ISO_21771, output=False, digits=6)

mesh.value("shift_2", "x_2", "1", "Profile shift coefficient of the wheel: as given", bind(lambda given: given, given="inputs.shift_2"),
    needs=("shift_2",), source="input")
mesh.value("shift_2", "x_2", "1", "Profile shift coefficient of the wheel: none", lambda: 0, lacks=("shift_2", *GIVEN_DISTANCE), source="input")
mesh.value("working_involute", "inv_wt", "1", "Involute function of the working pressure angle", bind(involute.working_involute, **ALPHA),
    lacks=GIVEN_DISTANCE, source=ISO_21771, output=False, digits=6)
mesh.require("meshes", lambda working_involute: working_involute > 0, key="shift_1", lacks=GIVEN_DISTANCE,
    message="is {shift_1}, so far negative with the wheel's shift {shift_2} that the flanks cannot touch; take greater shifts")
mesh.root("working_pressure_angle", "α_wt", "deg", "Working pressure angle",
    lambda working_pressure_angle, working_involute: involute.involute(working_pressure_angle) - working_involute, low=lambda: 0,
    high=lambda: 0.48 * pi, left=lambda working_pressure_angle: np.tan(working_pressure_angle),
    right=lambda working_pressure_angle, working_involute: working_involute + as_number(working_pressure_angle), lacks=GIVEN_DISTANCE,
    source=ISO_21771, digits=6, tolerance=1e-12)
mesh.value("least_distance", "a_min", "mm", "Centre distance at which the base circles touch",
    bind(lambda module, teeth_1, teeth_2, helix_angle, alpha: module * (teeth_1 + teeth_2) * np.cos(alpha) / (2 * np.cos(helix_angle)),
        module="inputs.module", **ALPHA), needs=GIVEN_DISTANCE, source=ISO_21771, output=False)
mesh.require("base_circles_apart", bind(lambda distance, least_distance: distance > least_distance, distance="inputs.center_distance"),
    key="center_distance", needs=GIVEN_DISTANCE,
    message="is {inputs.center_distance}, within which the base circles of {teeth_1} and {teeth_2} teeth overlap; take more than "
        "{least_distance:up}, or a smaller module")
mesh.value("working_pressure_angle", "α_wt", "deg", "Working pressure angle",
    bind(lambda distance, least_distance: np.arccos(least_distance / distance), distance="inputs.center_distance"), needs=GIVEN_DISTANCE,
    source=ISO_21771, digits=6)
mesh.value("shift_2", "x_2", "1", "Profile shift coefficient of the wheel: required by the centre distance", bind(f.shift_of_distance, **ALPHA),
    needs=GIVEN_DISTANCE, source=ISO_21771, digits=6)
mesh.require("shift_2_possible", bind(lambda shift_2, least, most: (shift_2 >= least) & (shift_2 <= most), least=LEAST_SHIFT, most=LARGEST_SHIFT),
    key="center_distance", needs=GIVEN_DISTANCE,
    message="is {inputs.center_distance}, which asks for a profile shift of {shift_2} at the wheel; it can be −1 … 1.5: take another "
        "center_distance, shift_1, module or number of teeth")
mesh.value("distance_coefficient", "y", "1", "Centre distance modification coefficient",
    bind(lambda teeth_1, teeth_2, helix_angle, alpha, working_angle:
            (teeth_1 + teeth_2) / (2 * np.cos(helix_angle)) * (np.cos(alpha) / np.cos(working_angle) - 1),
        working_angle="working_pressure_angle", **ALPHA), source=ISO_21771, output=False, digits=6)
mesh.value("tip_alteration", "k", "1", "Tip alteration coefficient that keeps the tip clearance",
    lambda distance_coefficient, shift_1, shift_2: distance_coefficient - (shift_1 + shift_2), needs=("keep_clearance=true",), source=ISO_21771,
    output=False)
mesh.value("tip_alteration", "k", "1", "Tip alteration coefficient: none", lambda: 0, needs=("keep_clearance=false",), source="input", output=False)

for g, teeth in TEETH.items():
    mesh.value(f"tip_height_{g}", f"h_a{g}", "1", f"Height of tip {g} above the reference circle, in modules",
        bind(lambda addendum, shift, tip_alteration: addendum + shift + tip_alteration, shift=f"shift_{g}"), source=ISO_21771, output=False)
    mesh.require(f"tip_above_base_{g}", bind(f.tip_above_base, teeth=teeth, tip_height=f"tip_height_{g}", **ALPHA), key="addendum",
        message=f"is {{addendum}}, with which the tip {g} lies within its base circle and has no flank; take a greater addendum or shift")
    mesh.value(f"tip_angle_{g}", f"α_at{g}", "deg", f"Transverse pressure angle at tip {g}",
        bind(involute.tip_pressure_angle, teeth=teeth, tip_height=f"tip_height_{g}", **ALPHA), source=ISO_21771, output=False, digits=6)
    mesh.value(f"tip_half_angle_{g}", f"ψ_a{g}", "deg", f"Tooth thickness half angle at tip {g}",
        bind(involute.half_thickness, teeth=teeth, shift=f"shift_{g}", alpha_there=f"tip_angle_{g}", **ALPHA), source=ISO_21771, output=False)
    mesh.require(f"tip_blunt_{g}", bind(lambda half: half > 0, half=f"tip_half_angle_{g}"), key=f"shift_{g}",
        message=f"is {{shift_{g}}}, with which the tooth {g} ends in a point below its tip circle; take less shift, a smaller addendum or more teeth"
    )
    mesh.value(f"shift_min_{g}", f"x_min{g}", "1", f"Profile shift coefficient below which tooth {g} is undercut",
        bind(involute.least_shift, teeth=teeth, tip_radius="root_radius", **ALPHA), source=ISO_21771, digits=4)
mesh.value("contact_ratio", "ε_α", "1", "Transverse contact ratio", bind(involute.contact_ratio, working_angle="working_pressure_angle"),
    source=ISO_21771)
mesh.require("always_in_mesh", lambda contact_ratio: contact_ratio >= 1, key="addendum",
    message="is {addendum}, with which a pair of teeth parts before the next one meets: the contact ratio is {contact_ratio}, and 1 is the minimum "
        "that drives; take more teeth, a greater addendum, less shift, or tips that are not shortened")
for g in TEETH:
    mesh.value(f"shift_lacking_{g}", f"Δx_{g}", "1", f"Profile shift missing to avoid undercut of tooth {g}",
        bind(lambda least, shift: least - shift, least=f"shift_min_{g}", shift=f"shift_{g}"), source=ISO_21771, output=False)
mesh.value("shift_lacking", "Δx", "1", "Missing profile shift of the worse gear",
    lambda shift_lacking_1, shift_lacking_2: np.maximum(shift_lacking_1, shift_lacking_2), source=ISO_21771, output=False)
