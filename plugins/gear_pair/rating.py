"""Chapters that follow from the module: sizes, forces, and the stresses of flank and root with their safeties."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, as_angle, as_number, inner, m, number, pi, root, value
from diecut_report.mechanics import drive_line, involute
from diecut_report.plugins.gear_pair import formulas as f
from diecut_report.plugins.gear_pair.load import DYNAMIC_KNOWN
from diecut_report.plugins.gear_pair.mesh import GIVEN_DISTANCE, ISO_21771, TEETH

# fmt: off

FORM, CORRECTION = "ISO 6336-3:2006, 6", "ISO 6336-3:2006, 7"

root_form = Chapter("Form of the tooth root",
    text="Virtual spur gears in the normal section, lengths in modules. The whole load acts at the outer point of single pair tooth contact. The "
        "critical section lies where tangents at 30° to the tooth's centre line touch the root fillet.")
root_form.half_tip_width = inner(f.half_tip_width), "E", "1", "Distance of the fillet centre from the centre line of the rack tooth", FORM
root_form.require("rack_possible", m.half_tip_width >= 0, key="root_radius",
    message="is {root_radius}, so that the roundings of the rack's tip overlap; take a smaller root_radius or dedendum")
root_form.virtual_contact_ratio = (inner(m.contact_ratio / np.cos(m.base_helix_angle) ** 2), "ε_αn", "1", "Contact ratio of the virtual spur gears",
    FORM)
root_form.require("below_two_pairs", m.virtual_contact_ratio < 2, key="addendum",
    message="is {addendum}, with which the virtual contact ratio is {virtual_contact_ratio}; from 2 on no single pair carries the load and this "
    "method does not hold: take a smaller addendum, fewer teeth or less helix")

for g, teeth in TEETH.items():
    own = {"virtual_teeth": m[f"virtual_teeth_{g}"], "theta": m[f"root_angle_{g}"], "center_height": m[f"rounding_height_{g}"]}
    root_form[f"virtual_teeth_{g}"] = (inner(m[teeth] / (np.cos(m.base_helix_angle) ** 2 * np.cos(m.helix_angle)), digits=6), f"z_n{g}", "1",
        f"Number of teeth of virtual spur gear {g}", FORM)
    root_form[f"rounding_height_{g}"] = (inner(m.root_radius - m.dedendum + m[f"shift_{g}"]), f"G_{g}", "1",
        f"Height of the fillet centre on gear {g}", FORM)
    root_form[f"tangent_offset_{g}"] = (inner(as_angle(2 / m[f"virtual_teeth_{g}"] * (as_number(pi) / 2 - m.half_tip_width)) - pi / 3, digits=6),
        f"H_{g}", "rad", f"Auxiliary angle of gear {g}", FORM)
    root_form.require(f"root_exists_{g}", (m[f"tangent_offset_{g}"] < 0) & (m[f"virtual_teeth_{g}"] * as_number(pi / 3 + m[f"tangent_offset_{g}"])
        > 2 * np.sqrt(number(3)) * m[f"rounding_height_{g}"]), key=f"shift_{g}",
        message=f"is {{shift_{g}}}, with which no tangent at 30° touches the root of the tooth {g}; take less shift or more teeth")
    root_form[f"root_angle_{g}"] = (root(m[f"root_angle_{g}"] + m[f"tangent_offset_{g}"]
        - as_angle(2 * m[f"rounding_height_{g}"] / m[f"virtual_teeth_{g}"] * np.tan(m[f"root_angle_{g}"])), low=0, high=pi / 3,
        left=m[f"virtual_teeth_{g}"] * as_number(m[f"root_angle_{g}"] + m[f"tangent_offset_{g}"]) * np.cos(m[f"root_angle_{g}"]),
        right=2 * m[f"rounding_height_{g}"] * np.sin(m[f"root_angle_{g}"]), output=False, digits=6, tolerance=1e-9), f"θ_{g}", "rad",
        f"Angle of the tangent's contact on gear {g}", FORM)
    root_form[f"chord_{g}"] = (inner(f.root_chord.of(**own), digits=6), f"s_n{g}", "1",
        f"Tooth root chord of gear {g} at the critical section, in modules", FORM)
    root_form[f"fillet_{g}"] = (inner(f.fillet_radius.of(**own), digits=6), f"r_n{g}", "1",
        f"Root fillet radius of gear {g} at the critical section, in modules", FORM)
    root_form[f"load_diameter_{g}"] = (inner(f.single_contact_diameter.of(virtual_teeth=m[f"virtual_teeth_{g}"], tip_height=m[f"tip_height_{g}"]),
        digits=6), f"d_en{g}", "1", f"Diameter at the outer point of single pair tooth contact of gear {g}, in modules", FORM)
    root_form[f"load_pressure_angle_{g}"] = (inner(np.arccos(m[f"virtual_teeth_{g}"] * np.cos(m.pressure_angle) / m[f"load_diameter_{g}"]),
        digits=6), f"α_en{g}", "deg", f"Pressure angle at this point of gear {g}", FORM)
    root_form[f"load_half_angle_{g}"] = (inner(involute.half_thickness.of(teeth=m[f"virtual_teeth_{g}"], shift=m[f"shift_{g}"],
        alpha=m.pressure_angle, alpha_there=m[f"load_pressure_angle_{g}"]), digits=6), f"γ_e{g}", "deg",
        f"Tooth thickness half angle at this point of gear {g}", FORM)
    root_form[f"load_angle_{g}"] = (inner(m[f"load_pressure_angle_{g}"] - m[f"load_half_angle_{g}"], digits=6), f"α_Fen{g}", "deg",
        f"Load direction angle of gear {g}", FORM)
    root_form[f"load_arm_{g}"] = (inner(f.load_arm.of(**own, half_thickness=m[f"load_half_angle_{g}"], load_angle=m[f"load_angle_{g}"],
        diameter=m[f"load_diameter_{g}"]), digits=6), f"h_Fe{g}", "1", f"Bending moment arm of gear {g}, in modules", FORM)
    root_form.require(f"load_above_root_{g}", (m[f"load_arm_{g}"] > 0) & (m[f"chord_{g}"] > 0), key="addendum",
        message=f"is {{addendum}}, with which the load meets the tooth {g} below its critical section; take a greater addendum, or less dedendum")
    root_form[f"form_factor_{g}"] = (value(f.form_factor.of(load_arm=m[f"load_arm_{g}"], load_angle=m[f"load_angle_{g}"],
        root_chord=m[f"chord_{g}"]), digits=6), f"Y_F{g}", "1", f"Form factor of gear {g}", FORM)
    root_form[f"notch_parameter_{g}"] = inner(m[f"chord_{g}"] / (2 * m[f"fillet_{g}"])), f"q_s{g}", "1", f"Notch parameter of root {g}", CORRECTION
    root_form[f"stress_factor_{g}"] = (value(f.stress_factor.of(root_chord=m[f"chord_{g}"], load_arm=m[f"load_arm_{g}"],
        notch_parameter=m[f"notch_parameter_{g}"]), digits=6), f"Y_S{g}", "1", f"Stress correction factor of gear {g}", CORRECTION)
root_form.notch_parameter = inner(f.worse_notch), "q_s", "1", "Notch parameter: the one below 1, else the greater one", CORRECTION


PITTING, ROOT, STATICS = "ISO 6336-2:2006", "ISO 6336-3:2006", "statics"
FACTORS = {"application": "application_factor", "dynamic": "dynamic_factor"}
FOR_FLANK = FACTORS | {"face": "face_load_factor", "transverse": "transverse_load_factor"}
FOR_ROOT = FACTORS | {"face": "face_load_root", "transverse": "transverse_load_root"}
RATED = (DYNAMIC_KNOWN,)

sizes = Chapter("Dimensions")
for g, teeth in TEETH.items():
    sizes[f"pitch_diameter_{g}"] = (value(drive_line.reference_diameter.of(teeth=m[teeth]), digits=6), f"d_{g}", "mm",
        f"Reference diameter of gear {g}", ISO_21771)
sizes.reference_distance = inner((m.pitch_diameter_1 + m.pitch_diameter_2) / 2, digits=6), "a_d", "mm", "Reference centre distance", ISO_21771
sizes.center_distance = value(m.inputs.center_distance, needs=GIVEN_DISTANCE, digits=6), "a", "mm", "Centre distance: as given", "input"
sizes.center_distance = (value(m.reference_distance * np.cos(m.transverse_angle) / np.cos(m.working_pressure_angle), lacks=GIVEN_DISTANCE, digits=6),
    "a", "mm", "Centre distance without backlash", ISO_21771)
for g, teeth in TEETH.items():
    sizes[f"base_diameter_{g}"] = (value(m[f"pitch_diameter_{g}"] * np.cos(m.transverse_angle), digits=6), f"d_b{g}", "mm",
        f"Base diameter of gear {g}", ISO_21771)
    sizes[f"working_diameter_{g}"] = (value(2 * m.center_distance * m[teeth] / (m.teeth_1 + m.teeth_2), digits=6), f"d_w{g}", "mm",
        f"Working pitch diameter of gear {g}", ISO_21771)
    sizes[f"tip_diameter_{g}"] = (value(m[f"pitch_diameter_{g}"] + 2 * m.module * m[f"tip_height_{g}"], digits=6), f"d_a{g}", "mm",
        f"Tip diameter of gear {g}", ISO_21771)
    sizes[f"root_diameter_{g}"] = (value(drive_line.root_diameter.of(diameter=m[f"pitch_diameter_{g}"], shift=m[f"shift_{g}"]), digits=6), f"d_f{g}",
        "mm", f"Root diameter of gear {g}", ISO_21771)
    sizes.require(f"root_circle_{g}", m[f"root_diameter_{g}"] > 0, key="dedendum",
        message=f"is {{dedendum}}, with which nothing is left of the gear {g} within its roots; take a smaller dedendum or more teeth")
for g in TEETH:
    sizes[f"tip_clearance_{g}"] = (m.center_distance - (m[f"tip_diameter_{g}"] + m[f"root_diameter_{3 - g}"]) / 2, f"c_{g}", "mm",
        f"Clearance between tip {g} and the root of the mating gear", ISO_21771)
    sizes[f"tip_thickness_{g}"] = (f.tip_thickness.of(tip_diameter=m[f"tip_diameter_{g}"], half_thickness=m[f"tip_half_angle_{g}"],
        reference_diameter=m[f"pitch_diameter_{g}"]), f"s_an{g}", "mm", f"Normal tooth thickness at tip {g}", ISO_21771)
    sizes[f"root_chord_{g}"] = (value(m[f"chord_{g}"] * m.module, digits=6), f"s_Fn{g}", "mm",
        f"Tooth root chord of gear {g} at the critical section", f"{ROOT}, 6")
    sizes[f"root_radius_{g}"] = (value(m[f"fillet_{g}"] * m.module, digits=6), f"ρ_F{g}", "mm",
        f"Root fillet radius of gear {g} at the critical section", f"{ROOT}, 6")
sizes.tip_clearance_least = inner(np.minimum(m.tip_clearance_1, m.tip_clearance_2)), "c_min", "mm", "Minimum tip clearance", ISO_21771
sizes.tip_thickness_least = inner(np.minimum(m.tip_thickness_1, m.tip_thickness_2)), "s_an,min", "mm", "Minimum tip thickness", ISO_21771
sizes.tip_clearance_wanted = inner(0.12 * m.module), "c_w", "mm", "Minimum usual tip clearance", "practice"
sizes.tip_thickness_wanted = inner(0.2 * m.module), "s_w", "mm", "Minimum usual tip thickness", "practice"
sizes.face_width_wanted = inner(1.2 * m.pitch_diameter_1), "b_w", "mm", "Maximum usual face width", "practice"
sizes.base_pitch = (value(as_number(pi) * m.pitch_diameter_1 / m.teeth_1 * np.cos(m.transverse_angle), digits=6), "p_bt", "mm",
    "Transverse base pitch", ISO_21771)
sizes.overlap_ratio = value(m.face_width * np.sin(m.helix_angle) / (as_number(pi) * m.module), digits=6), "ε_β", "1", "Overlap ratio", ISO_21771
sizes.contact_ratio_total = m.contact_ratio + m.overlap_ratio, "ε_γ", "1", "Total contact ratio", ISO_21771

forces = Chapter("Forces",
    text="For the maximum torque of run and frequent load cases. F_t acts at the reference circle and is used for the rating; the others act at the "
        "mesh.")
forces.tangential_force = 2 * m.torque_peak / m.pitch_diameter_1, "F_t", "N", "Tangential force at the reference circle", "ISO 6336-1"
forces.root_force = (inner(2 * m.torque_root / m.pitch_diameter_1), "F_tF", "N", "Tangential force at the reference circle, for the tooth root",
    "ISO 6336-1")
forces.working_force = 2 * m.torque_peak / m.working_diameter_1, "F_tw", "N", "Tangential force at the working pitch circle", STATICS
forces.radial_force = m.working_force * np.tan(m.working_pressure_angle), "F_r", "N", "Radial force, which separates the axes", STATICS
forces.axial_force = m.tangential_force * np.tan(m.helix_angle), "F_a", "N", "Axial force", STATICS
forces.normal_force = 2 * m.torque_peak / (m.base_diameter_1 * np.cos(m.base_helix_angle)), "F_bn", "N", "Force normal to the flanks", STATICS
forces.pitch_velocity = value(m.speed * m.working_diameter_1 / 2, needs=("speed",)), "v", "m/s", "Pitch line velocity", "kinematics"
forces.power_peak = value(m.torque_peak * m.speed, needs=("speed",)), "P", "kW", "Power at the maximum torque", "kinematics"

pitting = Chapter("Pitting",
    text="Load at the pitch point, converted to the inner points of single pair tooth contact by Z_B and Z_D. Z_E is for Poisson's ratio 0.3.")
pitting.zone_factor = (np.sqrt(2 * np.cos(m.base_helix_angle) * np.cos(m.working_pressure_angle)
    / (np.cos(m.transverse_angle) ** 2 * np.sin(m.working_pressure_angle))), "Z_H", "1", "Zone factor", f"{PITTING}, 6")
pitting.elasticity = (inner(1 / (as_number(pi) * ((1 - number(0.3) ** 2) / m.elastic_modulus_1 + (1 - number(0.3) ** 2) / m.elastic_modulus_2))),
    "E_Z", "MPa", "Square of the elasticity factor Z_E", f"{PITTING}, 7")
pitting.contact_ratio_factor = f.contact_ratio_factor, "Z_ε", "1", "Contact ratio factor", f"{PITTING}, 8"
pitting.helix_factor = inner(1 / np.sqrt(np.cos(m.helix_angle))), "Z_β", "1", "Helix angle factor", f"{PITTING}, 9, corrigendum 2008"
pitting.nominal_contact_stress = (f.nominal_contact_stress.of(force=m.tangential_force, diameter=m.pitch_diameter_1), "σ_H0", "MPa",
    "Nominal contact stress at the pitch point", f"{PITTING}, 5")
for g, teeth in TEETH.items():
    pitting.require(f"single_contact_exists_{g}", np.tan(m[f"tip_angle_{g}"]) > 2 * as_number(pi) / m[teeth], key="addendum",
        message=f"is {{addendum}}, with which the flank {g} ends before its inner point of single contact; take more shift, less dedendum and "
        "addendum, or more teeth")
for g, teeth in TEETH.items():
    mate = 3 - g
    pitting[f"single_contact_{g}"] = (inner(f.single_contact.of(working_angle=m.working_pressure_angle, tip_angle=m[f"tip_angle_{g}"],
        teeth=m[teeth], tip_angle_mate=m[f"tip_angle_{mate}"], teeth_mate=m[TEETH[mate]])), f"M_{g}", "1",
        f"Ratio of the pressure at the inner point of single pair tooth contact of gear {g} to that at the pitch point", f"{PITTING}, 6")
    pitting[f"contact_factor_{g}"] = (f.contact_factor.of(single_contact=m[f"single_contact_{g}"]), "Z_B" if g == 1 else "Z_D", "1",
        f"Single pair tooth contact factor of gear {g}", f"{PITTING}, 6")
    pitting[f"contact_stress_{g}"] = (value(f.contact_stress.of(nominal=m.nominal_contact_stress, contact_factor=m[f"contact_factor_{g}"],
        application=m.application_factor, dynamic=m.dynamic_factor, face=m.face_load_factor, transverse=m.transverse_load_factor), needs=RATED),
        f"σ_H{g}", "MPa", f"Contact stress of gear {g}", f"{PITTING}, 5")
    pitting[f"pitting_safety_{g}"] = (value(f.pitting_safety.of(limit=m[f"sigma_h_lim_{g}"], life=m[f"life_factor_h_{g}"], film=m.film_factor,
        stress=m[f"contact_stress_{g}"]), needs=RATED), f"S_H{g}", "1", f"Safety factor of gear {g} against pitting", f"{PITTING}, 5")

root_stress = Chapter("Tooth root",
    text="Method B: the load acts at the outer point of single pair tooth contact, Y_ε does not occur; Y_B = Y_DT = 1.")
root_stress.tooth_height = inner(m.module * (m.addendum + m.dedendum + m.tip_alteration)), "h", "mm", "Tooth depth", ISO_21771
root_stress.face_to_height = (inner(np.maximum(m.face_width / m.tooth_height, 3)), "r", "1", "Ratio of face width to tooth depth, at least 3",
    "ISO 6336-1")
root_stress.face_load_root = (value(m.face_load_factor ** (m.face_to_height**2 / (1 + m.face_to_height + m.face_to_height**2)), needs=RATED), "K_Fβ",
    "1", "Face load factor for tooth root stress", "ISO 6336-1, 7")
root_stress.helix_factor_root = (1 - np.minimum(m.overlap_ratio, 1) * m.helix_angle / (2 * pi / 3), "Y_β", "1",
    "Helix angle factor for tooth root stress", f"{ROOT}, 8")
for g in TEETH:
    root_stress[f"nominal_root_stress_{g}"] = (m.root_force * m[f"form_factor_{g}"] * m[f"stress_factor_{g}"] * m.helix_factor_root
        / (m.face_width * m.module), f"σ_F0{g}", "MPa", f"Nominal tooth root stress of gear {g}", f"{ROOT}, 5")
    root_stress[f"root_stress_{g}"] = (value(m[f"nominal_root_stress_{g}"] * m.application_factor * m.dynamic_factor * m.face_load_root
        * m.transverse_load_root, needs=RATED), f"σ_F{g}", "MPa", f"Tooth root stress of gear {g}", f"{ROOT}, 5")
    root_stress[f"root_safety_{g}"] = (value(2 * m[f"sigma_f_lim_{g}"] * m[f"life_factor_f_{g}"] * m.notch_size_factor * m.alternating_factor
        / m[f"root_stress_{g}"], needs=RATED), f"S_F{g}", "1", f"Safety factor of gear {g} against tooth breakage", f"{ROOT}, 5")

over_cycle = Chapter("Forces over the cycle", needs=("torque_curve",))
over_cycle.tangential_force_curve = (2 * m.torque_pinion_curve / m.pitch_diameter_1, "F_tφ", "N",
    "Tangential force at the reference circle, with the sign of the torque", "ISO 6336-1")
over_cycle.nominal_contact_curve = (inner(f.nominal_contact_stress.of(force=m.tangential_force_curve, diameter=m.pitch_diameter_1)), "σ_H0φ", "MPa",
    "Nominal contact stress", f"{PITTING}, 5")
over_cycle.contact_stress_curve = (value(f.contact_stress.of(nominal=m.nominal_contact_curve, contact_factor=m.contact_factor_1,
    application=m.application_factor, dynamic=m.dynamic_factor, face=m.face_load_factor, transverse=m.transverse_load_factor), needs=RATED), "σ_H1φ",
    "MPa", "Contact stress of the pinion", f"{PITTING}, 5")

sector = Chapter("Sector", needs=("sector",), absent="sector is not given: the wheel makes full revolutions",
    text="The maximum torque is assumed to act at any position in the mesh, on every tooth of the sector.")
sector.teeth_swept = value(m.sector.swing * m.teeth_2 / (2 * pi), digits=6), "z_γ", "1", "Number of teeth swept by the swing", "kinematics"
sector.teeth_needed = (value(np.ceil(m.teeth_swept + m.contact_ratio) + 1, whole=True), "z_n", "1",
    "Required number of teeth of the sector: those swept, those in mesh at the end, and one to spare", "this method")
sector.pinion_rotation = value(m.ratio * m.sector.swing, digits=6), "γ_1", "deg", "Rotation of the pinion", "kinematics"
sector.require("teeth_fit", m.sector.teeth_present <= m.teeth_2, key="sector.teeth_present", needs=("sector.teeth_present",),
    message="is {sector.teeth_present}, more than the {teeth_2} of the full circle; give at most those")
