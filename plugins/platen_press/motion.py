"""Chapters on the machine, contact and dwell, and the motion over a turn of the crank."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Bound, Case, Chapter, Steps, bind, case
from diecut_report.mechanics import common, slider_crank
from diecut_report.plugins.platen_press import formulas

# fmt: off

ADOPTED = (
    ("friction_guide", "f_1", "guides"),
    ("friction_platen_pin", "f_2", "platen's pins"),
    ("friction_crank_pin", "f_3", "crank pins"),
    ("friction_journal", "f_4", "journals"),
)


def in_phase(number: int) -> Bound:
    """Whether the crank is in a phase: 1 the rods relax, 2 free travel, 3 cutting."""
    return bind(lambda phase, number: phase == number, number=number)


def by_phase(relaxing: Bound, free: Bound, cutting: Bound) -> tuple[Case, ...]:
    """A quantity's value in each of the three phases."""
    return (case(relaxing, "the platen stands on the die and the rods relax", in_phase(1)),
            case(cutting, "the board is cut and the rods elongate", in_phase(3)),
            case(free, "the platen travels freely"))


def _frictions() -> Steps:
    """The coefficient of each place: its own where it is given, else that of all."""
    steps = Steps()
    for name, symbol, place in ADOPTED:
        steps.value(name, symbol, "1", f"Coefficient of friction of the {place}: individual value", bind(common.same, quantity=f"inputs.{name}"),
            needs=(name,), source="input", output=False)
        steps.value(name, symbol, "1", f"Coefficient of friction of the {place}: common value", lambda friction: friction, lacks=(name,),
            source="input", output=False)
    return steps


machine = Chapter("Machine",
    text="The crank angle φ is measured from the inner dead centre, where crank and rods are folded and the platen is closest to the shaft.")
machine.require("rod_longer", lambda rod_length, crank_radius: rod_length > 1.001 * crank_radius, key="rod_length",
    message="is {rod_length}, but the rod must be longer than the crank's radius {crank_radius}, by a thousandth of it at least; else the crank "
        "cannot turn fully")
machine.value("crank_speed", "ω", "rad/s", "Angular speed of the crank", lambda cycles_per_hour: 2 * np.pi * cycles_per_hour)
machine.value("stroke", "H", "mm", "Stroke of the platen", lambda crank_radius: 2 * crank_radius)
machine.value("lambda_ratio", "λ", "1", "Ratio of crank radius to rod length", lambda crank_radius, rod_length: crank_radius / rod_length,
    source="001, after eq. 2")
machine.value("drive_deformation", "Δl_m", "mm", "Elongation of the drive under the maximum cutting force: as given",
    bind(lambda drive_deformation: drive_deformation, drive_deformation="inputs.drive_deformation"), source="input", needs=("drive_deformation",))
machine.value("drive_deformation", "Δl_m", "mm", "Elongation of the two rods under the maximum cutting force",
    lambda cutting_force_max, rod_length, rod_area, elastic_modulus: cutting_force_max * rod_length / (2 * rod_area * elastic_modulus),
    source="Hooke", lacks=("drive_deformation",))
machine.value("drive_stiffness", "c", "kN/mm", "Stiffness of the drive at the platen",
    lambda cutting_force_max, drive_deformation: cutting_force_max / drive_deformation)
machine.require("stiff_enough", lambda drive_deformation, crank_radius: drive_deformation < crank_radius, key="drive_deformation",
    message="is {drive_deformation}, but must be less than the crank_radius {crank_radius}; a drive that stretches more cannot cut",
    needs=("drive_deformation",))
machine.require("rods_stiff_enough", lambda drive_deformation, crank_radius: drive_deformation < crank_radius, key="rod_area",
    message="is {rod_area}; under cutting_force_max = {cutting_force_max} the rods stretch by {drive_deformation}, which must be less than the "
        "crank_radius {crank_radius}: take thicker rods", lacks=("drive_deformation",))
machine.require("within_stroke",
    lambda material_thickness, drive_deformation, crank_radius: material_thickness + drive_deformation < 2 * crank_radius, key="material_thickness",
    message="is {material_thickness}; board and stretch of the drive ({drive_deformation}) together must be less than the platen's stroke {stroke}, "
        "twice the crank_radius")
machine.require("guides_given", lambda offset_force, offset_weight: (offset_force == 0) & (offset_weight == 0), key="guide_length",
    message="is needed: with offset_force = {offset_force} and offset_weight = {offset_weight} the platen presses on its guides",
    lacks=("guide_length",))
machine.add(_frictions())

contact = Chapter("Contact, dead centre and dwell",
    text="The travel of the drive covers both the thickness of the board and its own elongation. After the dead centre the platen stands on the die "
        "until the rods have regained their own length.")
contact.value("contact_travel", "u_c", "mm", "Travel of the unloaded drive from contact to the dead centre",
    lambda material_thickness, drive_deformation: material_thickness + drive_deformation, source="001, before eq. 12")
contact.value("cutting_start_angle", "φ_c", "deg", "Crank angle before the dead centre at which cutting begins",
    bind(slider_crank.inner_crank_angle_at, displacement="contact_travel"), source="closed form")
contact.value("dwell_end_angle", "φ_d", "deg", "Crank angle after the dead centre at which the rods have relaxed",
    bind(slider_crank.inner_crank_angle_at, displacement="drive_deformation"), source="001, after eq. 17, closed form")
contact.value("contact_rod_angle", "β_c", "deg", "Angle of the rods to the guides at contact",
    bind(slider_crank.inner_coupler_angle, crank_angle="cutting_start_angle", crank_ratio="lambda_ratio"), output=False)
contact.value("velocity_at_contact", "V_c", "m/s", "Speed of the platen at contact with the board",
    bind(slider_crank.inner_velocity, crank_angle="cutting_start_angle", coupler_angle="contact_rod_angle"), source="loop")
contact.value("friction_arm", "X", "mm", "Friction arm of the joints at the dead centre", formulas.friction_arm, source="001 eq. 10, 11")
contact.value("acceleration_dead_center", "a_0", "m/s**2", "Acceleration of the platen at the dead centre",
    lambda crank_radius, crank_speed, lambda_ratio: crank_radius * crank_speed ** 2 * (1 - lambda_ratio), output=False)
contact.value("inertia_dead_center", "P_i0", "N", "Inertia force at the dead centre",
    lambda platen_mass, acceleration_dead_center: platen_mass * acceleration_dead_center)
contact.value("torque_dead_center", "M_0", "N*m", "Torque at the dead centre, with the inertia force",
    lambda cutting_force_max, inertia_dead_center, friction_arm: abs(cutting_force_max - inertia_dead_center) * friction_arm,
    source="001 eq. 10, 11")
contact.value("torque_relaxing", "M_1", "N*m", "Torque just after the dead centre, where the platen stands",
    lambda cutting_force_max, friction_arm: cutting_force_max * friction_arm, source="001 eq. 17")

motion = Chapter("Motion over a revolution of the crank",
    text="The ideal displacement is that of an inextensible drive. The first-order form of the source is given beside the exact speed; the "
        "calculation uses the exact one.")
motion.abscissa("crank_angle", "φ", "deg", "Crank angle from the inner dead centre", 2 * np.pi, shown_at="torque_max_at", speed="crank_speed")
motion.value("cutting_begin", "φ_b", "deg", "Crank angle at which cutting begins", lambda cutting_start_angle: 2 * np.pi - cutting_start_angle,
    output=False)
motion.breakpoints("phases", "crank_angle", "dwell_end_angle", "cutting_begin")
motion.phase("cutting", "working", "The board is cut and the rods elongate", "crank_angle", ("cutting_begin", 0))
motion.phase("relaxing", "working", "The platen stands on the die and the rods relax", "crank_angle", (0, "dwell_end_angle"))
motion.phase("pressing", "working", "Pressing", "crank_angle", union=("cutting", "relaxing"))
motion.phase("open", "window", "The platen is off the board", "crank_angle", rest_of=("pressing",))
motion.value("phase", "j", "1", "Phase: 1 the rods relax, 2 free travel, 3 cutting",
    lambda crank_angle, dwell_end_angle, cutting_begin: np.where(crank_angle < dwell_end_angle, 1, np.where(crank_angle < cutting_begin, 2, 3)),
    output=False, per_piece=True)
motion.value("rod_angle", "β", "deg", "Angle of the rods to the guides", bind(slider_crank.inner_coupler_angle, crank_ratio="lambda_ratio"),
    source="001, after eq. 6", output=False)
motion.value("platen_displacement", "u", "mm", "Displacement of the platen from the dead centre, ideal",
    bind(slider_crank.inner_displacement, coupler_angle="rod_angle"), source="loop")
motion.value("travel_rate", "u′", "mm", "Ideal travel of the platen per radian of the crank, V/ω",
    bind(slider_crank.inner_arm, coupler_angle="rod_angle"), source="loop", output=False)
motion.value("platen_velocity_ideal", "V", "m/s", "Speed of the platen away from the die, ideal",
    lambda crank_speed, travel_rate: crank_speed * travel_rate, source="loop")
motion.value("platen_velocity_first_order", "V_1", "m/s", "The same, first-order in λ",
    bind(slider_crank.inner_velocity_first_order, crank_ratio="lambda_ratio"), source="001 eq. 2")
motion.value("first_order_error", "ΔV", "m/s", "Difference of exact and first-order speed",
    lambda platen_velocity_ideal, platen_velocity_first_order: platen_velocity_ideal - platen_velocity_first_order, output=False)
motion.value("platen_acceleration", "a_p", "m/s**2", "Acceleration of the platen away from the die, ideal",
    bind(slider_crank.inner_acceleration, coupler_angle="rod_angle", crank_ratio="lambda_ratio"), source="loop")
motion.choice("platen_displacement_true", "u_t", "mm", "Displacement of the platen, true",
    *by_phase(bind(common.same, quantity="drive_deformation"), bind(common.same, quantity="platen_displacement"), bind(formulas.true_travel)),
    source="001 eq. 12")
motion.choice("platen_velocity_true", "V_t", "m/s", "Speed of the platen, true",
    *by_phase(bind(common.zero), bind(common.same, quantity="platen_velocity_ideal"),
        bind(lambda platen_velocity_ideal, material_thickness, drive_deformation:
                platen_velocity_ideal * material_thickness / (material_thickness + drive_deformation))), source="001 eq. 13")
motion.reduction("velocity_max", "V_max", "m/s", "Maximum speed of the platen", "abs_max", of="platen_velocity_ideal")
motion.reduction("velocity_difference", "ΔV_max", "m/s", "Maximum difference of the first-order speed", "abs_max", of="first_order_error")

window = Chapter("Window of the carriages", needs=("carriage_clearance",), absent="not calculated: carriage_clearance is not given",
    text="The carriages pass while the platen is at least their clearance away from the die.")
window.require("clearance_within_stroke", lambda carriage_clearance, drive_deformation, material_thickness, crank_radius:
        (material_thickness <= carriage_clearance) & (carriage_clearance + drive_deformation < 2 * crank_radius), key="carriage_clearance",
    message="is {carriage_clearance}, but must be at least the board's thickness {material_thickness}, and less than what the platen opens, its "
        "stroke {stroke} less the stretch {drive_deformation}")
window.value("clear_travel", "u_w", "mm", "Travel of the platen from the dead centre at which the clearance remains",
    lambda carriage_clearance, drive_deformation: carriage_clearance + drive_deformation, output=False)
window.value("window_start", "φ_w1", "deg", "Crank angle at which the window opens",
    bind(slider_crank.inner_crank_angle_at, displacement="clear_travel"), source="closed form")
window.value("window_end", "φ_w2", "deg", "Crank angle at which the press closes", lambda window_start: 2 * np.pi - window_start, source="symmetry")
window.phase("carriage_window", "window", "Clearance for the carriages", "crank_angle", ("window_start", "window_end"))
