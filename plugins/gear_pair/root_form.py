"""Chapter on the form of the tooth roots, in modules: form factor and stress correction (ISO 6336-3:2006, method B)."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, as_angle, as_number, bind
from diecut_report.mechanics import involute
from diecut_report.plugins.gear_pair import formulas as f
from diecut_report.plugins.gear_pair.mesh import TEETH

# fmt: off

FORM, CORRECTION = "ISO 6336-3:2006, 6", "ISO 6336-3:2006, 7"

root_form = Chapter("Form of the tooth root",
    text="Virtual spur gears in the normal section, lengths in modules. The whole load acts at the outer point of single pair tooth contact. The "
        "critical section lies where tangents at 30° to the tooth's centre line touch the root fillet.")
root_form.value("half_tip_width", "E", "1", "Distance of the fillet centre from the centre line of the rack tooth", f.half_tip_width, source=FORM,
    output=False)
root_form.require("rack_possible", lambda half_tip_width: half_tip_width >= 0, key="root_radius",
    message="is {root_radius}, so that the roundings of the rack's tip overlap; take a smaller root_radius or dedendum")
root_form.value("virtual_contact_ratio", "ε_αn", "1", "Contact ratio of the virtual spur gears",
    lambda contact_ratio, base_helix_angle: contact_ratio / np.cos(base_helix_angle) ** 2, source=FORM, output=False)
root_form.require("below_two_pairs", lambda virtual_contact_ratio: virtual_contact_ratio < 2, key="addendum",
    message="is {addendum}, with which the virtual contact ratio is {virtual_contact_ratio}; from 2 on no single pair carries the load and this "
        "method does not hold: take a smaller addendum, fewer teeth or less helix")

for g, teeth in TEETH.items():
    own = {"virtual_teeth": f"virtual_teeth_{g}", "theta": f"root_angle_{g}", "center_height": f"rounding_height_{g}"}
    load = {"half_thickness": f"load_half_angle_{g}", "load_angle": f"load_angle_{g}", "diameter": f"load_diameter_{g}"}
    root_form.value(f"virtual_teeth_{g}", f"z_n{g}", "1", f"Number of teeth of virtual spur gear {g}", bind(f.virtual_teeth, teeth=teeth),
        source=FORM, output=False, digits=6)
    root_form.value(f"rounding_height_{g}", f"G_{g}", "1", f"Height of the fillet centre on gear {g}",
        bind(lambda root_radius, dedendum, shift: root_radius - dedendum + shift, shift=f"shift_{g}"), source=FORM, output=False)
    root_form.value(f"tangent_offset_{g}", f"H_{g}", "rad", f"Auxiliary angle of gear {g}",
        bind(lambda virtual_teeth, half_tip_width: as_angle(2 / virtual_teeth * (as_number(np.pi) / 2 - half_tip_width)) - np.pi / 3,
            virtual_teeth=f"virtual_teeth_{g}"), source=FORM, output=False, digits=6)
    root_form.require(f"root_exists_{g}",
        bind(lambda offset, virtual_teeth, center_height:
                (offset < 0) & (virtual_teeth * as_number(np.pi / 3 + offset) > 2 * np.sqrt(3) * center_height), offset=f"tangent_offset_{g}",
            virtual_teeth=f"virtual_teeth_{g}", center_height=f"rounding_height_{g}"), key=f"shift_{g}",
        message=f"is {{shift_{g}}}, with which no tangent at 30° touches the root of the tooth {g}; take less shift or more teeth")
    root_form.root(f"root_angle_{g}", f"θ_{g}", "rad", f"Angle of the tangent's contact on gear {g}",
        bind(lambda theta, offset, virtual_teeth, center_height: theta + offset - as_angle(2 * center_height / virtual_teeth * np.tan(theta)),
            theta=f"root_angle_{g}", offset=f"tangent_offset_{g}", virtual_teeth=f"virtual_teeth_{g}", center_height=f"rounding_height_{g}"),
        low=lambda: 0, high=lambda: np.pi / 3,
        left=bind(lambda theta, virtual_teeth, offset: virtual_teeth * as_number(theta + offset) * np.cos(theta), theta=f"root_angle_{g}",
            offset=f"tangent_offset_{g}", virtual_teeth=f"virtual_teeth_{g}"),
        right=bind(lambda theta, center_height: 2 * center_height * np.sin(theta), theta=f"root_angle_{g}", center_height=f"rounding_height_{g}"),
        source=FORM, output=False, digits=6, tolerance=1e-9)
    root_form.value(f"chord_{g}", f"s_n{g}", "1", f"Tooth root chord of gear {g} at the critical section, in modules", bind(f.root_chord, **own),
        source=FORM, output=False, digits=6)
    root_form.value(f"fillet_{g}", f"r_n{g}", "1", f"Root fillet radius of gear {g} at the critical section, in modules",
        bind(f.fillet_radius, **own), source=FORM, output=False, digits=6)
    root_form.value(f"load_diameter_{g}", f"d_en{g}", "1", f"Diameter at the outer point of single pair tooth contact of gear {g}, in modules",
        bind(f.single_contact_diameter, virtual_teeth=f"virtual_teeth_{g}", tip_height=f"tip_height_{g}"), source=FORM, output=False, digits=6)
    root_form.value(f"load_pressure_angle_{g}", f"α_en{g}", "deg", f"Pressure angle at this point of gear {g}",
        bind(lambda virtual_teeth, pressure_angle, diameter: np.arccos(virtual_teeth * np.cos(pressure_angle) / diameter),
            virtual_teeth=f"virtual_teeth_{g}", diameter=f"load_diameter_{g}"), source=FORM, output=False, digits=6)
    root_form.value(f"load_half_angle_{g}", f"γ_e{g}", "deg", f"Tooth thickness half angle at this point of gear {g}",
        bind(involute.half_thickness, teeth=f"virtual_teeth_{g}", shift=f"shift_{g}", alpha="pressure_angle", alpha_there=f"load_pressure_angle_{g}"),
        source=FORM, output=False, digits=6)
    root_form.value(f"load_angle_{g}", f"α_Fen{g}", "deg", f"Load direction angle of gear {g}",
        bind(lambda pressure, half: pressure - half, pressure=f"load_pressure_angle_{g}", half=f"load_half_angle_{g}"), source=FORM, output=False,
        digits=6)
    root_form.value(f"load_arm_{g}", f"h_Fe{g}", "1", f"Bending moment arm of gear {g}, in modules", bind(f.load_arm, **own, **load), source=FORM,
        output=False, digits=6)
    root_form.require(f"load_above_root_{g}", bind(lambda arm, chord: (arm > 0) & (chord > 0), arm=f"load_arm_{g}", chord=f"chord_{g}"),
        key="addendum",
        message=f"is {{addendum}}, with which the load meets the tooth {g} below its critical section; take a greater addendum, or less dedendum")
    root_form.value(f"form_factor_{g}", f"Y_F{g}", "1", f"Form factor of gear {g}",
        bind(f.form_factor, load_arm=f"load_arm_{g}", load_angle=f"load_angle_{g}", root_chord=f"chord_{g}"), source=FORM, digits=6)
    root_form.value(f"notch_parameter_{g}", f"q_s{g}", "1", f"Notch parameter of root {g}",
        bind(lambda chord, fillet: chord / (2 * fillet), chord=f"chord_{g}", fillet=f"fillet_{g}"), source=CORRECTION, output=False)
    root_form.value(f"stress_factor_{g}", f"Y_S{g}", "1", f"Stress correction factor of gear {g}",
        bind(f.stress_factor, root_chord=f"chord_{g}", load_arm=f"load_arm_{g}", notch_parameter=f"notch_parameter_{g}"), source=CORRECTION,
        digits=6)
root_form.value("notch_parameter", "q_s", "1", "Notch parameter: the one below 1, else the greater one", f.worse_notch, source=CORRECTION,
    output=False)
