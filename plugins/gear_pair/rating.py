"""Chapters that follow from the module: sizes, forces, and the stresses of flank and root with their safeties."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, as_angle, as_number, bind, number, pi
from diecut_report.mechanics import drive_line, involute
from diecut_report.plugins.gear_pair import formulas as f
from diecut_report.plugins.gear_pair.load import DYNAMIC_KNOWN
from diecut_report.plugins.gear_pair.mesh import GIVEN_DISTANCE, ISO_21771, TEETH

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
    root_form.value(f"virtual_teeth_{g}", f"z_n{g}", "1", f"Number of teeth of virtual spur gear {g}",
        bind(lambda teeth, base_helix_angle, helix_angle: teeth / (np.cos(base_helix_angle) ** 2 * np.cos(helix_angle)), teeth=teeth),
        source=FORM, output=False, digits=6)
    root_form.value(f"rounding_height_{g}", f"G_{g}", "1", f"Height of the fillet centre on gear {g}",
        bind(lambda root_radius, dedendum, shift: root_radius - dedendum + shift, shift=f"shift_{g}"), source=FORM, output=False)
    root_form.value(f"tangent_offset_{g}", f"H_{g}", "rad", f"Auxiliary angle of gear {g}",
        bind(lambda virtual_teeth, half_tip_width: as_angle(2 / virtual_teeth * (as_number(pi) / 2 - half_tip_width)) - pi / 3,
            virtual_teeth=f"virtual_teeth_{g}"), source=FORM, output=False, digits=6)
    root_form.require(f"root_exists_{g}",
        bind(lambda offset, virtual_teeth, center_height:
                (offset < 0) & (virtual_teeth * as_number(pi / 3 + offset) > 2 * np.sqrt(number(3)) * center_height), offset=f"tangent_offset_{g}",
            virtual_teeth=f"virtual_teeth_{g}", center_height=f"rounding_height_{g}"), key=f"shift_{g}",
        message=f"is {{shift_{g}}}, with which no tangent at 30° touches the root of the tooth {g}; take less shift or more teeth")
    root_form.root(f"root_angle_{g}", f"θ_{g}", "rad", f"Angle of the tangent's contact on gear {g}",
        bind(lambda theta, offset, virtual_teeth, center_height: theta + offset - as_angle(2 * center_height / virtual_teeth * np.tan(theta)),
            theta=f"root_angle_{g}", offset=f"tangent_offset_{g}", virtual_teeth=f"virtual_teeth_{g}", center_height=f"rounding_height_{g}"),
        low=lambda: 0, high=lambda: pi / 3,
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


PITTING, ROOT, STATICS = "ISO 6336-2:2006", "ISO 6336-3:2006", "statics"
FACTORS = {"application": "application_factor", "dynamic": "dynamic_factor"}
FOR_FLANK = FACTORS | {"face": "face_load_factor", "transverse": "transverse_load_factor"}
FOR_ROOT = FACTORS | {"face": "face_load_root", "transverse": "transverse_load_root"}
RATED = (DYNAMIC_KNOWN,)

sizes = Chapter("Dimensions")
for g, teeth in TEETH.items():
    sizes.value(f"pitch_diameter_{g}", f"d_{g}", "mm", f"Reference diameter of gear {g}",
        bind(drive_line.reference_diameter, teeth=teeth), source=ISO_21771,
        digits=6)
sizes.value("reference_distance", "a_d", "mm", "Reference centre distance",
    lambda pitch_diameter_1, pitch_diameter_2: (pitch_diameter_1 + pitch_diameter_2) / 2, source=ISO_21771, output=False, digits=6)
sizes.value("center_distance", "a", "mm", "Centre distance: as given", bind(lambda given: given, given="inputs.center_distance"),
    needs=GIVEN_DISTANCE, source="input", digits=6)
sizes.value("center_distance", "a", "mm", "Centre distance without backlash", lambda reference_distance, transverse_angle, working_pressure_angle:
        reference_distance * np.cos(transverse_angle) / np.cos(working_pressure_angle), lacks=GIVEN_DISTANCE, source=ISO_21771, digits=6)
for g, teeth in TEETH.items():
    sizes.value(f"base_diameter_{g}", f"d_b{g}", "mm", f"Base diameter of gear {g}",
        bind(lambda diameter, transverse_angle: diameter * np.cos(transverse_angle), diameter=f"pitch_diameter_{g}"), source=ISO_21771, digits=6)
    sizes.value(f"working_diameter_{g}", f"d_w{g}", "mm", f"Working pitch diameter of gear {g}",
        bind(lambda distance, teeth, teeth_1, teeth_2: 2 * distance * teeth / (teeth_1 + teeth_2), distance="center_distance", teeth=teeth),
        source=ISO_21771, digits=6)
    sizes.value(f"tip_diameter_{g}", f"d_a{g}", "mm", f"Tip diameter of gear {g}",
        bind(lambda diameter, module, height: diameter + 2 * module * height, diameter=f"pitch_diameter_{g}", height=f"tip_height_{g}"),
        source=ISO_21771, digits=6)
    sizes.value(f"root_diameter_{g}", f"d_f{g}", "mm", f"Root diameter of gear {g}",
        bind(drive_line.root_diameter, diameter=f"pitch_diameter_{g}", shift=f"shift_{g}"), source=ISO_21771, digits=6)
    sizes.require(f"root_circle_{g}", bind(lambda diameter: diameter > 0, diameter=f"root_diameter_{g}"), key="dedendum",
        message=f"is {{dedendum}}, with which nothing is left of the gear {g} within its roots; take a smaller dedendum or more teeth")
for g in TEETH:
    sizes.value(f"tip_clearance_{g}", f"c_{g}", "mm", f"Clearance between tip {g} and the root of the mating gear",
        bind(lambda center_distance, tip, root: center_distance - (tip + root) / 2, tip=f"tip_diameter_{g}", root=f"root_diameter_{3 - g}"),
        source=ISO_21771)
    sizes.value(f"tip_thickness_{g}", f"s_an{g}", "mm", f"Normal tooth thickness at tip {g}",
        bind(f.tip_thickness, tip_diameter=f"tip_diameter_{g}", half_thickness=f"tip_half_angle_{g}", reference_diameter=f"pitch_diameter_{g}"),
        source=ISO_21771)
    sizes.value(f"root_chord_{g}", f"s_Fn{g}", "mm", f"Tooth root chord of gear {g} at the critical section",
        bind(lambda chord, module: chord * module, chord=f"chord_{g}"), source=f"{ROOT}, 6", digits=6)
    sizes.value(f"root_radius_{g}", f"ρ_F{g}", "mm", f"Root fillet radius of gear {g} at the critical section",
        bind(lambda fillet, module: fillet * module, fillet=f"fillet_{g}"), source=f"{ROOT}, 6", digits=6)
sizes.value("tip_clearance_least", "c_min", "mm", "Minimum tip clearance",
    lambda tip_clearance_1, tip_clearance_2: np.minimum(tip_clearance_1, tip_clearance_2), source=ISO_21771, output=False)
sizes.value("tip_thickness_least", "s_an,min", "mm", "Minimum tip thickness",
    lambda tip_thickness_1, tip_thickness_2: np.minimum(tip_thickness_1, tip_thickness_2), source=ISO_21771, output=False)
sizes.value("tip_clearance_wanted", "c_w", "mm", "Minimum usual tip clearance", lambda module: 0.12 * module, source="practice", output=False)
sizes.value("tip_thickness_wanted", "s_w", "mm", "Minimum usual tip thickness", lambda module: 0.2 * module, source="practice", output=False)
sizes.value("face_width_wanted", "b_w", "mm", "Maximum usual face width", lambda pitch_diameter_1: 1.2 * pitch_diameter_1, source="practice",
    output=False)
sizes.value("base_pitch", "p_bt", "mm", "Transverse base pitch",
    lambda pitch_diameter_1, teeth_1, transverse_angle: as_number(pi) * pitch_diameter_1 / teeth_1 * np.cos(transverse_angle), source=ISO_21771,
    digits=6)
sizes.value("overlap_ratio", "ε_β", "1", "Overlap ratio",
    lambda face_width, helix_angle, module: face_width * np.sin(helix_angle) / (as_number(pi) * module), source=ISO_21771, digits=6)
sizes.value("contact_ratio_total", "ε_γ", "1", "Total contact ratio", lambda contact_ratio, overlap_ratio: contact_ratio + overlap_ratio,
    source=ISO_21771)

forces = Chapter("Forces",
    text="For the maximum torque of run and frequent load cases. F_t acts at the reference circle and is used for the rating; the others act at the "
        "mesh.")
forces.value("tangential_force", "F_t", "N", "Tangential force at the reference circle",
    lambda torque_peak, pitch_diameter_1: 2 * torque_peak / pitch_diameter_1, source="ISO 6336-1")
forces.value("root_force", "F_tF", "N", "Tangential force at the reference circle, for the tooth root",
    lambda torque_root, pitch_diameter_1: 2 * torque_root / pitch_diameter_1, source="ISO 6336-1", output=False)
forces.value("working_force", "F_tw", "N", "Tangential force at the working pitch circle",
    lambda torque_peak, working_diameter_1: 2 * torque_peak / working_diameter_1, source=STATICS)
forces.value("radial_force", "F_r", "N", "Radial force, which separates the axes",
    lambda working_force, working_pressure_angle: working_force * np.tan(working_pressure_angle), source=STATICS)
forces.value("axial_force", "F_a", "N", "Axial force", lambda tangential_force, helix_angle: tangential_force * np.tan(helix_angle), source=STATICS)
forces.value("normal_force", "F_bn", "N", "Force normal to the flanks",
    lambda torque_peak, base_diameter_1, base_helix_angle: 2 * torque_peak / (base_diameter_1 * np.cos(base_helix_angle)), source=STATICS)
forces.value("pitch_velocity", "v", "m/s", "Pitch line velocity", lambda speed, working_diameter_1: speed * working_diameter_1 / 2, needs=("speed",),
    source="kinematics")
forces.value("power_peak", "P", "kW", "Power at the maximum torque", lambda torque_peak, speed: torque_peak * speed, needs=("speed",),
    source="kinematics")

pitting = Chapter("Pitting",
    text="Load at the pitch point, converted to the inner points of single pair tooth contact by Z_B and Z_D. Z_E is for Poisson's ratio 0.3.")
pitting.value("zone_factor", "Z_H", "1", "Zone factor", bind(lambda base_helix_angle, working_angle, alpha:
        np.sqrt(2 * np.cos(base_helix_angle) * np.cos(working_angle) / (np.cos(alpha) ** 2 * np.sin(working_angle))),
    working_angle="working_pressure_angle", alpha="transverse_angle"),
    source=f"{PITTING}, 6")
pitting.value("elasticity", "E_Z", "MPa", "Square of the elasticity factor Z_E",
    lambda elastic_modulus_1, elastic_modulus_2:
        1 / (as_number(pi) * ((1 - number(0.3) ** 2) / elastic_modulus_1 + (1 - number(0.3) ** 2) / elastic_modulus_2)),
    source=f"{PITTING}, 7", output=False)
pitting.value("contact_ratio_factor", "Z_ε", "1", "Contact ratio factor", f.contact_ratio_factor, source=f"{PITTING}, 8")
pitting.value("helix_factor", "Z_β", "1", "Helix angle factor", lambda helix_angle: 1 / np.sqrt(np.cos(helix_angle)),
    source=f"{PITTING}, 9, corrigendum 2008", output=False)
pitting.value("nominal_contact_stress", "σ_H0", "MPa", "Nominal contact stress at the pitch point",
    bind(f.nominal_contact_stress, force="tangential_force", diameter="pitch_diameter_1"), source=f"{PITTING}, 5")
for g, teeth in TEETH.items():
    pitting.require(f"single_contact_exists_{g}",
        bind(lambda tip_angle, teeth: np.tan(tip_angle) > 2 * as_number(pi) / teeth, tip_angle=f"tip_angle_{g}", teeth=teeth), key="addendum",
        message=f"is {{addendum}}, with which the flank {g} ends before its inner point of single contact; take more shift, less dedendum and "
            "addendum, or more teeth")
for g, teeth in TEETH.items():
    mate = 3 - g
    pitting.value(f"single_contact_{g}", f"M_{g}", "1",
        f"Ratio of the pressure at the inner point of single pair tooth contact of gear {g} to that at the pitch point",
        bind(f.single_contact, working_angle="working_pressure_angle", tip_angle=f"tip_angle_{g}", teeth=teeth, tip_angle_mate=f"tip_angle_{mate}",
            teeth_mate=TEETH[mate]), source=f"{PITTING}, 6", output=False)
    pitting.value(f"contact_factor_{g}", "Z_B" if g == 1 else "Z_D", "1", f"Single pair tooth contact factor of gear {g}",
        bind(f.contact_factor, single_contact=f"single_contact_{g}"), source=f"{PITTING}, 6")
    pitting.value(f"contact_stress_{g}", f"σ_H{g}", "MPa", f"Contact stress of gear {g}",
        bind(f.contact_stress, nominal="nominal_contact_stress", contact_factor=f"contact_factor_{g}", **FOR_FLANK),
        source=f"{PITTING}, 5", needs=RATED)
    pitting.value(f"pitting_safety_{g}", f"S_H{g}", "1", f"Safety factor of gear {g} against pitting",
        bind(f.pitting_safety, limit=f"sigma_h_lim_{g}", life=f"life_factor_h_{g}", film="film_factor", stress=f"contact_stress_{g}"),
        source=f"{PITTING}, 5", needs=RATED)

root_stress = Chapter("Tooth root",
    text="Method B: the load acts at the outer point of single pair tooth contact, Y_ε does not occur; Y_B = Y_DT = 1.")
root_stress.value("tooth_height", "h", "mm", "Tooth depth",
    lambda module, addendum, dedendum, tip_alteration: module * (addendum + dedendum + tip_alteration), source=ISO_21771, output=False)
root_stress.value("face_to_height", "r", "1", "Ratio of face width to tooth depth, at least 3",
    lambda face_width, tooth_height: np.maximum(face_width / tooth_height, 3), source="ISO 6336-1", output=False)
root_stress.value("face_load_root", "K_Fβ", "1", "Face load factor for tooth root stress",
    lambda face_load_factor, face_to_height: face_load_factor ** (face_to_height**2 / (1 + face_to_height + face_to_height**2)),
    source="ISO 6336-1, 7", needs=RATED)
root_stress.value("helix_factor_root", "Y_β", "1", "Helix angle factor for tooth root stress",
    lambda overlap_ratio, helix_angle: 1 - np.minimum(overlap_ratio, 1) * helix_angle / (2 * pi / 3), source=f"{ROOT}, 8")
for g in TEETH:
    root_stress.value(f"nominal_root_stress_{g}", f"σ_F0{g}", "MPa", f"Nominal tooth root stress of gear {g}",
        bind(lambda force, form_factor, stress_factor, helix_factor, face_width, module:
                force * form_factor * stress_factor * helix_factor / (face_width * module), force="root_force", form_factor=f"form_factor_{g}",
            stress_factor=f"stress_factor_{g}", helix_factor="helix_factor_root"), source=f"{ROOT}, 5")
    root_stress.value(f"root_stress_{g}", f"σ_F{g}", "MPa", f"Tooth root stress of gear {g}",
        bind(lambda nominal, application, dynamic, face, transverse: nominal * application * dynamic * face * transverse,
            nominal=f"nominal_root_stress_{g}", **FOR_ROOT), source=f"{ROOT}, 5", needs=RATED)
    root_stress.value(f"root_safety_{g}", f"S_F{g}", "1", f"Safety factor of gear {g} against tooth breakage",
        bind(lambda limit, life, notch, alternating, stress: 2 * limit * life * notch * alternating / stress, limit=f"sigma_f_lim_{g}",
            life=f"life_factor_f_{g}", notch="notch_size_factor", alternating="alternating_factor", stress=f"root_stress_{g}"), source=f"{ROOT}, 5",
        needs=RATED)

over_cycle = Chapter("Forces over the cycle", needs=("torque_curve",))
over_cycle.value("tangential_force_curve", "F_tφ", "N", "Tangential force at the reference circle, with the sign of the torque",
    lambda torque_pinion_curve, pitch_diameter_1: 2 * torque_pinion_curve / pitch_diameter_1, source="ISO 6336-1")
over_cycle.value("nominal_contact_curve", "σ_H0φ", "MPa", "Nominal contact stress",
    bind(f.nominal_contact_stress, force="tangential_force_curve", diameter="pitch_diameter_1"), source=f"{PITTING}, 5", output=False)
over_cycle.value("contact_stress_curve", "σ_H1φ", "MPa", "Contact stress of the pinion",
    bind(f.contact_stress, nominal="nominal_contact_curve", contact_factor="contact_factor_1", **FOR_FLANK),
    source=f"{PITTING}, 5", needs=RATED)

sector = Chapter("Sector", needs=("sector",), absent="sector is not given: the wheel makes full revolutions",
    text="The maximum torque is assumed to act at any position in the mesh, on every tooth of the sector.")
sector.value("teeth_swept", "z_γ", "1", "Number of teeth swept by the swing",
    bind(lambda swing, teeth_2: swing * teeth_2 / (2 * pi), swing="sector.swing"), source="kinematics", digits=6)
sector.value("teeth_needed", "z_n", "1", "Required number of teeth of the sector: those swept, those in mesh at the end, and one to spare",
    lambda teeth_swept, contact_ratio: np.ceil(teeth_swept + contact_ratio) + 1, whole=True, source="this method")
sector.value("pinion_rotation", "γ_1", "deg", "Rotation of the pinion", bind(lambda ratio, swing: ratio * swing, swing="sector.swing"),
    source="kinematics", digits=6)
sector.require("teeth_fit", bind(lambda present, teeth_2: present <= teeth_2, present="sector.teeth_present"), key="sector.teeth_present",
    needs=("sector.teeth_present",), message="is {sector.teeth_present}, more than the {teeth_2} of the full circle; give at most those")
