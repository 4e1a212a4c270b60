"""The calculation of the platen press: its inputs and formulas, motion, force and torque."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Self

import numpy as np

from diecut_report.api import (
    CURVE_ROUNDING,
    GRAVITY,
    Case,
    Chapter,
    Inputs,
    OneOf,
    Quantity,
    abscissa,
    case,
    choice,
    crossings,
    formula,
    inner,
    m,
    pi,
    reduction,
    samples,
    self_test,
    value,
)
from diecut_report.mechanics import slider_crank
from diecut_report.mechanics.slider_crank import inner_arm_first_order

# fmt: off

STRETCH = "drive_deformation"
RODS = ("rod_area", "elastic_modulus")
"""Keys from which the stretch of the drive follows where it is not given."""

JOINTS = ("friction_guide", "friction_platen_pin", "friction_crank_pin", "friction_journal")
"""Keys of the single coefficients of friction f₁…f₄, in the order of a list."""

INSTEAD = {STRETCH: RODS[:1], "friction": JOINTS}
"""Keys with a default, each with those that are given instead of it."""


def coefficient(place: str, symbol: str) -> Quantity:
    """The declaration of one coefficient of friction."""
    return Quantity(symbol, "1", f"Coefficient of friction {place}", ge=0, le=1, optional=True)


def without_idle_defaults(keys: Mapping[str, Any]) -> dict[str, Any]:
    """The keys, without a default that the keys beside it leave no use."""
    optional = (STRETCH, *RODS, "friction", *JOINTS)
    given = {key: value for key, value in keys.items() if value is not None or key not in optional}
    idle = [key for key, others in INSTEAD.items() if given.keys() >= set(others)]
    return given | {key: None for key in idle if key not in given}


class PlatenPress(Inputs):
    """Keys of ``platen_press``."""

    one_of = (OneOf((STRETCH,), RODS, optional=True),)
    spread = {"friction": JOINTS}

    cycles_per_hour = Quantity("n", "1/h", "Cycle rate of the platen, one revolution of the crank per cycle", gt=0, le=1e6, default=1200)
    cutting_force_max = Quantity("P_max", "kN", "Maximum cutting force, of both rods together", gt=0, default=500)
    platen_mass = Quantity("m", "kg", "Mass of the platen and the parts that move with it", ge=0, default=306)
    drive_deformation = Quantity("Δl_m", "mm",
        "Elongation of the drive at the platen under the maximum cutting force; or rod_area and elastic_modulus", ge=1e-9, optional=True,
        default=0.45)
    rod_area = Quantity("A", "mm**2", "Cross-section of one of the two rods; with elastic_modulus gives their elongation", gt=0, optional=True)
    elastic_modulus = Quantity("E", "GPa", "Elastic modulus of the rods; with rod_area gives their elongation", gt=0, optional=True)
    material_thickness = Quantity("s", "mm", "Thickness of the board", gt=0, default=0.5)
    crank_radius = Quantity("r", "mm", "Radius of the crank", gt=0, default=110)
    rod_length = Quantity("l", "mm", "Unloaded length of the rods", gt=0, default=635)
    journal_radius = Quantity("r_0", "mm", "Radius of the crankshaft's journals", gt=0, default=50.25)
    crank_pin_radius = Quantity("r_A", "mm", "Radius of the crank pins", gt=0, default=47.5)
    platen_pin_radius = Quantity("r_B", "mm", "Radius of the platen's pins", gt=0, default=60)
    friction = Quantity("f", "1", "Coefficient of friction of all joints and guides; or a list of four: guides, platen pins, crank pins, journals",
        ge=0, le=1, optional=True, default=0.1)
    friction_guide = coefficient("of the guides, if different from the common one", "f_1")
    friction_platen_pin = coefficient("of the platen's pins, if different from the common one", "f_2")
    friction_crank_pin = coefficient("of the crank pins, if different from the common one", "f_3")
    friction_journal = coefficient("of the journals, if different from the common one", "f_4")
    journal_length = Quantity("b_0", "mm", "Length of one of the two journals; required for their pressure", gt=0, optional=True)
    crank_pin_length = Quantity("b_A", "mm", "Length of one of the two crank pins; required for their pressure", gt=0, optional=True)
    platen_pin_length = Quantity("b_B", "mm", "Length of one of the two platen pins; required for their pressure", gt=0, optional=True)
    rod_net_area = Quantity("A_n", "mm**2", "Minimum cross-section of one of the two rods, at its eye or shank; required for their stress", gt=0,
        optional=True)
    offset_force = Quantity("h_1", "mm", "Offset of the rods' force from the axis of the guides", default=0)
    offset_weight = Quantity("h_2", "mm", "Offset of the platen's weight from the axis of the guides", default=0)
    guide_length = Quantity("b", "mm", "Length of the guides; required if a force is offset", gt=0, optional=True)
    carriage_clearance = Quantity("c_r", "mm", "Clearance required by the carriages at the platen; required for their window", gt=0, optional=True)
    allowable_torque = Quantity("[M]", "N*m", "Allowable torque at the main shaft", gt=0, optional=True)
    allowable_pin_pressure = Quantity("[p]", "MPa", "Allowable pressure of journals and pins, on their projected area", gt=0, optional=True)
    allowable_rod_stress = Quantity("[σ]", "MPa", "Allowable pulsating stress of the rods, on their minimum cross-section", gt=0, optional=True)
    n_points = samples(720)

    @classmethod
    def model_validate(cls, obj: Any, **how: Any) -> Self:
        """The validated keys; see ``without_idle_defaults``."""
        return super().model_validate(without_idle_defaults(obj) if isinstance(obj, Mapping) else obj, **how)


@formula
def friction_arm(
    friction_platen_pin: Any,
    friction_crank_pin: Any,
    friction_journal: Any,
    platen_pin_radius: Any,
    crank_pin_radius: Any,
    journal_radius: Any,
    lambda_ratio: Any,
) -> Any:
    """Arm of the joints' friction at the dead centre."""
    crank_pin = friction_crank_pin * crank_pin_radius * (1 - lambda_ratio)
    return friction_platen_pin * platen_pin_radius * lambda_ratio + crank_pin + friction_journal * journal_radius


@formula
def joint_arm(
    friction_platen_pin: Any,
    friction_crank_pin: Any,
    friction_journal: Any,
    platen_pin_radius: Any,
    crank_pin_radius: Any,
    journal_radius: Any,
    rod_speed_ratio: Any,
    rod_angle: Any,
) -> Any:
    """Arm of the joints' friction for each unit of the rods' force along the guides."""
    crank_pin = friction_crank_pin * crank_pin_radius * abs(1 - rod_speed_ratio) / np.cos(rod_angle)
    return (
        friction_platen_pin * platen_pin_radius * abs(rod_speed_ratio) + crank_pin + friction_journal * journal_radius
    )


@formula
def true_travel(platen_displacement: Any, material_thickness: Any, drive_deformation: Any) -> Any:
    """Distance of the platen from the dead centre of the unloaded drive while it cuts and the rods stretch."""
    share = material_thickness / (material_thickness + drive_deformation)
    return drive_deformation + platen_displacement * share


@formula
def stretched_length(standing_distance: Any, crank_radius: Any, crank_angle: Any) -> Any:
    """Distance between crank pin and platen pin while the platen stands."""
    along = 2 * standing_distance * crank_radius * np.cos(crank_angle)
    return np.sqrt(standing_distance**2 + crank_radius**2 + along)


@formula
def weight_torque(
    friction_guide: Any, platen_mass: Any, offset_weight: Any, guide_length: Any, velocity_max: Any, crank_speed: Any
) -> Any:
    """The most that the guides' friction under the platen's weight alone can ask for."""
    weight = platen_mass * GRAVITY
    return 2 * friction_guide * weight * abs(offset_weight) * velocity_max / (guide_length * crank_speed)


@formula
def torque_as_printed(
    force: Any,
    crank_angle: Any,
    crank_radius: Any,
    lambda_ratio: Any,
    material_thickness: Any,
    drive_deformation: Any,
    friction_arm: Any,
) -> Any:
    """Torque with the platen's true speed for the arm of the rods' force."""
    share = material_thickness / (material_thickness + drive_deformation)
    return force * (abs(inner_arm_first_order(crank_angle, crank_radius, lambda_ratio)) * share + friction_arm)


@formula
def deformation_limit(rod_length: Any, crank_radius: Any, friction_arm: Any) -> Any:
    """Stretch of the drive at which the relaxed rods pass the shaft at the friction's arm."""
    along = rod_length - np.sqrt(crank_radius**2 - friction_arm**2)
    return np.sqrt(along**2 + friction_arm**2) - (rod_length - crank_radius)


ADOPTED = (
    ("friction_guide", "f_1", "guides"),
    ("friction_platen_pin", "f_2", "platen's pins"),
    ("friction_crank_pin", "f_3", "crank pins"),
    ("friction_journal", "f_4", "journals"),
)


def in_phase(number: int) -> Any:
    """Whether the crank is in a phase: 1 the rods relax, 2 free travel, 3 cutting."""
    return m.phase == number


def by_phase(relaxing: Any, free: Any, cutting: Any) -> tuple[Case, ...]:
    """A quantity's value in each of the three phases."""
    return (case(relaxing, "the platen stands on the die and the rods relax", in_phase(1)),
            case(cutting, "the board is cut and the rods elongate", in_phase(3)),
            case(free, "the platen travels freely"))


machine = Chapter("Machine",
    text="The crank angle φ is measured from the inner dead centre, where crank and rods are folded and the platen is closest to the shaft.")
machine.require("rod_longer", m.rod_length > 1.001 * m.crank_radius, key="rod_length",
    message="is {rod_length}, but the rod must be longer than the crank's radius {crank_radius}, by a thousandth of it at least; else the crank "
    "cannot turn fully")
machine.crank_speed = 2 * pi * m.cycles_per_hour, "ω", "rad/s", "Angular speed of the crank"
machine.stroke = 2 * m.crank_radius, "H", "mm", "Stroke of the platen"
machine.lambda_ratio = m.crank_radius / m.rod_length, "λ", "1", "Ratio of crank radius to rod length", "001, after eq. 2"
machine.drive_deformation = (value(m.inputs.drive_deformation, needs=("drive_deformation",)), "Δl_m", "mm",
    "Elongation of the drive under the maximum cutting force: as given", "input")
machine.drive_deformation = (value(m.cutting_force_max * m.rod_length / (2 * m.rod_area * m.elastic_modulus), lacks=("drive_deformation",)), "Δl_m",
    "mm", "Elongation of the two rods under the maximum cutting force", "Hooke")
machine.drive_stiffness = m.cutting_force_max / m.drive_deformation, "c", "kN/mm", "Stiffness of the drive at the platen"
machine.require("stiff_enough", m.drive_deformation < m.crank_radius, key="drive_deformation",
    message="is {drive_deformation}, but must be less than the crank_radius {crank_radius}; a drive that stretches more cannot cut",
    needs=("drive_deformation",))
machine.require("rods_stiff_enough", m.drive_deformation < m.crank_radius, key="rod_area",
    message="is {rod_area}; under cutting_force_max = {cutting_force_max} the rods stretch by {drive_deformation}, which must be less than the "
    "crank_radius {crank_radius}: take thicker rods", lacks=("drive_deformation",))
machine.require("within_stroke", m.material_thickness + m.drive_deformation < 2 * m.crank_radius, key="material_thickness",
    message="is {material_thickness}; board and stretch of the drive ({drive_deformation}) together must be less than the platen's stroke {stroke}, "
    "twice the crank_radius")
machine.require("guides_given", (m.offset_force == 0) & (m.offset_weight == 0), key="guide_length",
    message="is needed: with offset_force = {offset_force} and offset_weight = {offset_weight} the platen presses on its guides",
    lacks=("guide_length",))
for name, symbol, place in ADOPTED:
    machine[name] = inner(m.inputs[name], needs=(name,)), symbol, "1", f"Coefficient of friction of the {place}: individual value", "input"
    machine[name] = inner(m.friction, lacks=(name,)), symbol, "1", f"Coefficient of friction of the {place}: common value", "input"

contact = Chapter("Contact, dead centre and dwell",
    text="The travel of the drive covers both the thickness of the board and its own elongation. After the dead centre the platen stands on the die "
        "until the rods have regained their own length.")
contact.contact_travel = (m.material_thickness + m.drive_deformation, "u_c", "mm", "Travel of the unloaded drive from contact to the dead centre",
    "001, before eq. 12")
contact.cutting_start_angle = (slider_crank.inner_crank_angle_at.of(displacement=m.contact_travel), "φ_c", "deg",
    "Crank angle before the dead centre at which cutting begins", "closed form")
contact.dwell_end_angle = (slider_crank.inner_crank_angle_at.of(displacement=m.drive_deformation), "φ_d", "deg",
    "Crank angle after the dead centre at which the rods have relaxed", "001, after eq. 17, closed form")
contact.contact_rod_angle = (inner(slider_crank.inner_coupler_angle.of(crank_angle=m.cutting_start_angle, crank_ratio=m.lambda_ratio)), "β_c", "deg",
    "Angle of the rods to the guides at contact")
contact.velocity_at_contact = (slider_crank.inner_velocity.of(crank_angle=m.cutting_start_angle, coupler_angle=m.contact_rod_angle), "V_c", "m/s",
    "Speed of the platen at contact with the board", "loop")
contact.friction_arm = friction_arm, "X", "mm", "Friction arm of the joints at the dead centre", "001 eq. 10, 11"
contact.acceleration_dead_center = (inner(m.crank_radius * m.crank_speed ** 2 * (1 - m.lambda_ratio)), "a_0", "m/s**2",
    "Acceleration of the platen at the dead centre")
contact.inertia_dead_center = m.platen_mass * m.acceleration_dead_center, "P_i0", "N", "Inertia force at the dead centre"
contact.torque_dead_center = (abs(m.cutting_force_max - m.inertia_dead_center) * m.friction_arm, "M_0", "N*m",
    "Torque at the dead centre, with the inertia force", "001 eq. 10, 11")
contact.torque_relaxing = (m.cutting_force_max * m.friction_arm, "M_1", "N*m", "Torque just after the dead centre, where the platen stands",
    "001 eq. 17")

motion = Chapter("Motion over a revolution of the crank",
    text="The ideal displacement is that of an inextensible drive. The first-order form of the source is given beside the exact speed; the "
        "calculation uses the exact one.")
motion.crank_angle = abscissa(2 * np.pi, shown_at="torque_max_at", speed="crank_speed"), "φ", "deg", "Crank angle from the inner dead centre"
motion.cutting_begin = inner(2 * pi - m.cutting_start_angle), "φ_b", "deg", "Crank angle at which cutting begins"
motion.breakpoints("phases", "crank_angle", "dwell_end_angle", "cutting_begin")
motion.phase("cutting", "working", "The board is cut and the rods elongate", "crank_angle", ("cutting_begin", 0))
motion.phase("relaxing", "working", "The platen stands on the die and the rods relax", "crank_angle", (0, "dwell_end_angle"))
motion.phase("pressing", "working", "Pressing", "crank_angle", union=("cutting", "relaxing"))
motion.phase("open", "window", "The platen is off the board", "crank_angle", rest_of=("pressing",))
motion["phase"] = (inner(np.where(m.crank_angle < m.dwell_end_angle, 1, np.where(m.crank_angle < m.cutting_begin, 2, 3)), per_piece=True), "j", "1",
    "Phase: 1 the rods relax, 2 free travel, 3 cutting")
motion.rod_angle = (inner(slider_crank.inner_coupler_angle.of(crank_ratio=m.lambda_ratio)), "β", "deg", "Angle of the rods to the guides",
    "001, after eq. 6")
motion.platen_displacement = (slider_crank.inner_displacement.of(coupler_angle=m.rod_angle), "u", "mm",
    "Displacement of the platen from the dead centre, ideal", "loop")
motion.travel_rate = (inner(slider_crank.inner_arm.of(coupler_angle=m.rod_angle)), "u′", "mm",
    "Ideal travel of the platen per radian of the crank, V/ω", "loop")
motion.platen_velocity_ideal = m.crank_speed * m.travel_rate, "V", "m/s", "Speed of the platen away from the die, ideal", "loop"
motion.platen_velocity_first_order = (slider_crank.inner_velocity_first_order.of(crank_ratio=m.lambda_ratio), "V_1", "m/s",
    "The same, first-order in λ", "001 eq. 2")
motion.first_order_error = inner(m.platen_velocity_ideal - m.platen_velocity_first_order), "ΔV", "m/s", "Difference of exact and first-order speed"
motion.platen_acceleration = (slider_crank.inner_acceleration.of(coupler_angle=m.rod_angle, crank_ratio=m.lambda_ratio), "a_p", "m/s**2",
    "Acceleration of the platen away from the die, ideal", "loop")
motion.platen_displacement_true = (choice(*by_phase(m.drive_deformation, m.platen_displacement, true_travel.of())), "u_t", "mm",
    "Displacement of the platen, true", "001 eq. 12")
motion.platen_velocity_true = (choice(*by_phase(0, m.platen_velocity_ideal, m.platen_velocity_ideal * m.material_thickness
    / (m.material_thickness + m.drive_deformation))), "V_t", "m/s", "Speed of the platen, true", "001 eq. 13")
motion.velocity_max = reduction("abs_max", of="platen_velocity_ideal"), "V_max", "m/s", "Maximum speed of the platen"
motion.velocity_difference = reduction("abs_max", of="first_order_error"), "ΔV_max", "m/s", "Maximum difference of the first-order speed"

window = Chapter("Window of the carriages", needs=("carriage_clearance",), absent="not calculated: carriage_clearance is not given",
    text="The carriages pass while the platen is at least their clearance away from the die.")
window.require("clearance_within_stroke", (m.material_thickness <= m.carriage_clearance)
    & (m.carriage_clearance + m.drive_deformation < 2 * m.crank_radius), key="carriage_clearance",
    message="is {carriage_clearance}, but must be at least the board's thickness {material_thickness}, and less than what the platen opens, its "
    "stroke {stroke} less the stretch {drive_deformation}")
window.clear_travel = (inner(m.carriage_clearance + m.drive_deformation), "u_w", "mm",
    "Travel of the platen from the dead centre at which the clearance remains")
window.window_start = (slider_crank.inner_crank_angle_at.of(displacement=m.clear_travel), "φ_w1", "deg", "Crank angle at which the window opens",
    "closed form")
window.window_end = 2 * pi - m.window_start, "φ_w2", "deg", "Crank angle at which the press closes", "symmetry"
window.phase("carriage_window", "window", "Clearance for the carriages", "crank_angle", ("window_start", "window_end"))


LOAD = (
    "torque_max",
    "allowable_torque",
    "cutting_force_max",
    "torque_max_angle",
    "cutting_start_angle",
    "inertia_force_max",
    "crank_radius",
)

forces = Chapter("Force of the rods",
    text="Both rods together, along the guides, tension positive. The force from the rods' elongation equals the cutting force up to the dead "
        "centre; after it the platen stands and the rods relax.")
forces.standing_distance = (inner(m.rod_length + m.drive_deformation - m.crank_radius), "x_p", "mm",
    "Distance of the standing platen's pins from the shaft", "001 eq. 16")
forces.stretched_length = inner(stretched_length), "L", "mm", "Length of the rods while the platen stands", "001 eq. 16, exact"
forces.rod_stretch = (choice(*by_phase(m.stretched_length - m.rod_length, 0, m.drive_deformation
    * (1 - m.platen_displacement / (m.material_thickness + m.drive_deformation)))), "Δl", "mm", "Elongation of the rods", "001 eq. 12, 16")
forces.elastic_force = (m.cutting_force_max * m.rod_stretch / m.drive_deformation, "P", "kN",
    "Force of the elongated rods; while cutting, equal to the cutting force", "001, before eq. 12")
forces.inertia_force = (choice(case(0, "the platen stands on the die", in_phase(1)),
    case(m.platen_mass * m.platen_acceleration, "the platen moves")), "P_i", "N", "Inertia force of the platen", "001, after eq. 2")
forces.force = m.elastic_force - m.inertia_force, "F", "kN", "Force of the rods along the guides", "001, after eq. 2"
forces.crank_pin_force_x = m.force / 2, "F_A,x", "kN", "Force of one of the two rods on its crank pin, along the guides", "symmetry"
forces.crank_pin_force_y = (m.crank_pin_force_x * np.tan(m.rod_angle), "F_A,y", "kN",
    "Force of one of the two rods on its crank pin, across the guides", "statics")
forces.force_change = crossings(of="force", output=False), "φ_F", "deg", "Crank angle at which the force of the rods changes its sign"
forces.breakpoints("force_changes", "crank_angle", "force_change")
forces.inertia_force_max = reduction("abs_max", of="inertia_force"), "P_i,max", "N", "Maximum inertia force of the platen"
forces.force_max = (np.maximum(m.cutting_force_max, m.inertia_force_max), "F_max", "kN",
    "Maximum force of the rods: from cutting, or from inertia in free travel")

friction = Chapter("Friction of the joints",
    text="Each joint turns under the force of the rods; its friction acts at the joint's radius with the relative angular speed of the two parts. "
        "While the rods relax the crank is near its dead centre, and the value of X at the dead centre is used.")
friction.rod_speed_ratio = (inner(slider_crank.inner_coupler_angle_speed.of(coupler_angle=m.rod_angle, crank_ratio=m.lambda_ratio)), "β′", "1",
    "Ratio of the rods' angular speed to the crank's", "001 eq. 5")
friction.rod_turn = crossings(of="rod_speed_ratio", output=False), "φ_β", "deg", "Crank angle at which the rods reverse their swing"
friction.breakpoints("rod_turns", "crank_angle", "rod_turn")
friction.moving_joint_arm = inner(joint_arm), "X_φ", "mm", "Friction arm of the joints at the crank angle", "001 eq. 5–7"
friction.joint_arm = (choice(case(m.friction_arm, "the rods relax: value at the dead centre", in_phase(1)),
    case(m.moving_joint_arm, "the platen moves")), "X_j", "mm", "Friction arm of the joints", "001 eq. 5–7, 17")
friction.joint_torque = inner(abs(m.force) * m.joint_arm), "M_j", "N*m", "Torque from joint friction", "001 eq. 5–7"

guides = Chapter("Friction of the guides",
    text="A force offset from the axis of the guides tilts the platen in them. Where the platen stands, its guides have no friction. The rods also "
        "carry the friction of the guides, so its arm is theirs, V/ω with the ideal speed.", needs=("guide_length",),
    absent="not calculated: guide_length is not given, and no force is offset from the axis of the guides")
guides.guide_moment = (inner(m.force * m.offset_force - m.platen_mass * GRAVITY * m.offset_weight), "M_g", "N*m",
    "Tilting moment on the platen in its guides", "001 eq. 3")
guides.guide_change = crossings(of="guide_moment", output=False), "φ_g", "deg", "Crank angle at which the guides' reactions change sides"
guides.platen_turn = crossings(of="platen_velocity_ideal", output=False), "φ_V", "deg", "Crank angle at which the platen reverses"
guides.breakpoints("guide_changes", "crank_angle", "guide_change", "platen_turn")
guides.guide_friction = (choice(case(0, "the platen stands on the die", in_phase(1)),
    case(2 * m.friction_guide * abs(m.guide_moment) / m.guide_length, "the platen moves")), "T", "N", "Friction of the guides", "001 eq. 3, 4")
guides.guide_torque = inner(m.guide_friction * abs(m.travel_rate)), "M_n", "N*m", "Torque from guide friction", "001 eq. 4"
guides.weight_torque = (inner(weight_torque, needs=("allowable_torque",)), "M_G", "N*m",
    "Maximum torque due to the guides' friction under the weight alone", "001 eq. 4")

torque = Chapter("Torque at the main shaft",
    text="The moment arm of the rods' force follows from the crank and rods alone: V/ω with the ideal speed. The crank must also supply the strain "
        "energy of the rods; they return it after the dead centre.")
torque.force_arm = (choice(case(-m.standing_distance * m.crank_radius * np.sin(m.crank_angle) / m.stretched_length, "the platen stands on the die",
    in_phase(1)), case(-m.travel_rate, "the platen moves"), output=False), "a", "mm",
    "Moment arm of the rods' force about the shaft, positive where it resists the crank", "001 eq. 2, 16")
torque.torque_useful = m.force * m.force_arm, "M_u", "N*m", "Torque from cutting, elongation and inertia", "virtual work"
torque.torque_friction = (value(m.joint_torque + m.guide_torque, needs=("guide_length",)), "M_f", "N*m", "Torque from friction in joints and guides",
    "001 eq. 1")
torque.torque_friction = value(m.joint_torque, lacks=("guide_length",)), "M_f", "N*m", "Torque from friction in the joints", "001 eq. 1"
torque.torque = m.torque_useful + m.torque_friction, "M", "N*m", "Torque at the main shaft", "001 eq. 1, corrected"
torque.torque_max = reduction("max", of="torque"), "M_max", "N*m", "Maximum torque"
torque.torque_max_angle = (np.where(m.torque_max_at > 0, 2 * pi - m.torque_max_at, 0), "φ_M", "deg",
    "Crank angle of the maximum torque, before the dead centre")
torque.torque_min = reduction("min", of="torque"), "M_min", "N*m", "Minimum torque (negative: platen or rods drive the crank)"
torque.crank_pin_torque = -m.torque / 2, "M_A", "N*m", "Torque of one of the two rods, including friction, on its crank", "symmetry"
torque.torque_source = (choice(case(torque_as_printed.of(), "the board is cut", in_phase(3)), case(0, "eq. 14 is for cutting alone")), "M_14", "N*m",
    "Torque by eq. 14 as printed, while cutting", "001 eq. 14")
torque.torque_max_source = reduction("max", of="torque_source"), "M_14,max", "N*m", "Maximum torque by eq. 14 as printed"
torque.torque_max_source_angle = (np.where(m.torque_max_source_at > 0, 2 * pi - m.torque_max_source_at, 0), "φ_14", "deg",
    "Its crank angle before the dead centre")

returning = Chapter("Relaxing rods",
    text="The elongated rods drive the crank over an arm that grows until they have relaxed; friction resists over X.")
returning.elastic_arm = (m.standing_distance * m.crank_radius * np.sin(m.dwell_end_angle) / m.rod_length, "a_d", "mm",
    "Maximum arm with which the relaxing rods drive the crank", "001 eq. 16, exact")
returning.return_arm_min = m.friction_arm - m.elastic_arm, "X_min", "mm", "Minimum excess of the friction arm over the arm of the rods", "001 eq. 17"
returning.friction_limit = (value(m.friction * m.elastic_arm / m.friction_arm, needs=("friction",), lacks=tuple(key for key, _, _ in ADOPTED),
    exists=m.friction > 0), "f_rev", "1", "Coefficient of friction below which the rods would drive the crank", "statics")
returning.deformation_limit = (value(deformation_limit, exists=m.friction_arm < m.crank_radius), "Δl_rev", "mm",
    "Elongation of the drive above which the rods would drive the crank", "statics")

work = Chapter("Work and power",
    text="In the model the platen is set in motion instantaneously when the rods have relaxed; this energy is not part of the torque over the "
        "revolution and is added to it. The energy stored in the rods before the dead centre is returned after it.")
work.torque_work = reduction("integral", of="torque", output=False), "W_M", "J", "Work of the torque over a revolution"
work.start_rod_angle = (inner(slider_crank.inner_coupler_angle.of(crank_angle=m.dwell_end_angle, crank_ratio=m.lambda_ratio)), "β_d", "deg",
    "Angle of the rods to the guides where they have relaxed")
work.start_velocity = (inner(slider_crank.inner_velocity.of(crank_angle=m.dwell_end_angle, coupler_angle=m.start_rod_angle)), "V_d", "m/s",
    "Speed with which the platen leaves the die")
work.start_energy = inner(m.platen_mass * m.start_velocity ** 2 / 2), "W_d", "J", "Energy to set the platen in motion", "energy"
work.work_per_cycle = m.torque_work + m.start_energy, "W_c", "J", "Work per cycle, including setting the platen in motion", "energy"
work.cutting_work = m.cutting_force_max * m.material_thickness / 2, "W_s", "J", "Work of cutting the board", "energy"
work.friction_work = reduction("integral", of="torque_friction"), "W_f", "J", "Work of friction"
work.strain_energy = m.cutting_force_max * m.drive_deformation / 2, "W_e", "J", "Energy stored and returned by the rods", "energy"
work.friction_share = m.friction_work / m.work_per_cycle, "k_f", "%", "Fraction of the work taken by friction"
work.power_mean = m.work_per_cycle * m.cycles_per_hour, "P_mean", "W", "Mean power at the main shaft"
work.energy_residual = (self_test(m.work_per_cycle, m.cutting_work + m.friction_work, scale=m.work_per_cycle, within=CURVE_ROUNDING,
    check="energy_balance", title="Energy balance over a cycle"), "r_E", "1", "Relative difference between the work and its components",
    "conservation of energy")


def _pressure(key: str, name: str, symbol: str, pins: str, radius: str) -> Chapter:
    """The pressure of one kind of pins."""
    chapter = Chapter(f"Pressure on the {pins}", text="The two of them share the force of the rods.", needs=(key,),
        absent=f"not calculated: {key} is not given")
    chapter[name] = m.force_max / (4 * m[radius] * m[key]), symbol, "MPa", f"Pressure on the {pins} on their projected area", "statics"
    return chapter


PRESSURES = (
    _pressure("journal_length", "journal_pressure", "p_0", "journals", "journal_radius"),
    _pressure("crank_pin_length", "crank_pin_pressure", "p_A", "crank pins", "crank_pin_radius"),
    _pressure("platen_pin_length", "platen_pin_pressure", "p_B", "platen's pins", "platen_pin_radius"),
)

rods = Chapter("Stress in the rods", text="The two of them share the force, which pulsates from zero once per revolution.", needs=("rod_net_area",),
    absent="not calculated: rod_net_area is not given")
rods.rod_stress = m.force_max / (2 * m.rod_net_area), "σ_r", "MPa", "Maximum tensile stress of the rods", "statics"
