"""The calculation of the platen press: its inputs and formulas, motion, force and torque."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Self

import numpy as np

from diecut_report.api import (
    GRAVITY,
    POINTS,
    Annotated,
    Bound,
    Case,
    Chapter,
    Inputs,
    OneOf,
    Quantity,
    bind,
    case,
    formula,
    pi,
)
from diecut_report.mechanics import common, slider_crank
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
    return Quantity(symbol, "1", f"Coefficient of friction {place}", ge=0, le=1)


def without_idle_defaults(keys: Mapping[str, Any]) -> dict[str, Any]:
    """The keys, without a default that the keys beside it leave no use."""
    optional = (STRETCH, *RODS, "friction", *JOINTS)
    given = {key: value for key, value in keys.items() if value is not None or key not in optional}
    idle = [key for key, others in INSTEAD.items() if given.keys() >= set(others)]
    return given | {key: None for key in idle if key not in given}


class PlatenPress(Inputs):
    """Keys of ``platen_press``."""

    one_of: ClassVar[tuple[OneOf, ...]] = (OneOf((STRETCH,), RODS, optional=True),)
    spread: ClassVar[Mapping[str, tuple[str, ...]]] = {"friction": JOINTS}

    cycles_per_hour: Annotated[float, Quantity("n", "1/h", "Cycle rate of the platen, one revolution of the crank per cycle", gt=0, le=1e6)] = 1200
    cutting_force_max: Annotated[float, Quantity("P_max", "kN", "Maximum cutting force, of both rods together", gt=0)] = 500
    platen_mass: Annotated[float, Quantity("m", "kg", "Mass of the platen and the parts that move with it", ge=0)] = 306
    drive_deformation: Annotated[float | None,
        Quantity("Δl_m", "mm", "Elongation of the drive at the platen under the maximum cutting force; or rod_area and elastic_modulus",
            ge=1e-9)] = 0.45
    rod_area: Annotated[float | None,
        Quantity("A", "mm**2", "Cross-section of one of the two rods; with elastic_modulus gives their elongation", gt=0)] = None
    elastic_modulus: Annotated[float | None, Quantity("E", "GPa", "Elastic modulus of the rods; with rod_area gives their elongation", gt=0)] = None
    material_thickness: Annotated[float, Quantity("s", "mm", "Thickness of the board", gt=0)] = 0.5
    crank_radius: Annotated[float, Quantity("r", "mm", "Radius of the crank", gt=0)] = 110
    rod_length: Annotated[float, Quantity("l", "mm", "Unloaded length of the rods", gt=0)] = 635
    journal_radius: Annotated[float, Quantity("r_0", "mm", "Radius of the crankshaft's journals", gt=0)] = 50.25
    crank_pin_radius: Annotated[float, Quantity("r_A", "mm", "Radius of the crank pins", gt=0)] = 47.5
    platen_pin_radius: Annotated[float, Quantity("r_B", "mm", "Radius of the platen's pins", gt=0)] = 60
    friction: Annotated[float | None,
        Quantity("f", "1", "Coefficient of friction of all joints and guides; or a list of four: guides, platen pins, crank pins, journals",
            ge=0, le=1)] = 0.1
    friction_guide: Annotated[float | None, coefficient("of the guides, if different from the common one", "f_1")] = None
    friction_platen_pin: Annotated[float | None, coefficient("of the platen's pins, if different from the common one", "f_2")] = None
    friction_crank_pin: Annotated[float | None, coefficient("of the crank pins, if different from the common one", "f_3")] = None
    friction_journal: Annotated[float | None, coefficient("of the journals, if different from the common one", "f_4")] = None
    journal_length: Annotated[float | None, Quantity("b_0", "mm", "Length of one of the two journals; required for their pressure", gt=0)] = None
    crank_pin_length: Annotated[float | None, Quantity("b_A", "mm", "Length of one of the two crank pins; required for their pressure", gt=0)] = None
    platen_pin_length: Annotated[float | None,
        Quantity("b_B", "mm", "Length of one of the two platen pins; required for their pressure", gt=0)] = None
    rod_net_area: Annotated[float | None,
        Quantity("A_n", "mm**2", "Minimum cross-section of one of the two rods, at its eye or shank; required for their stress", gt=0)] = None
    offset_force: Annotated[float, Quantity("h_1", "mm", "Offset of the rods' force from the axis of the guides")] = 0
    offset_weight: Annotated[float, Quantity("h_2", "mm", "Offset of the platen's weight from the axis of the guides")] = 0
    guide_length: Annotated[float | None, Quantity("b", "mm", "Length of the guides; required if a force is offset", gt=0)] = None
    carriage_clearance: Annotated[float | None,
        Quantity("c_r", "mm", "Clearance required by the carriages at the platen; required for their window", gt=0)] = None
    allowable_torque: Annotated[float | None, Quantity("[M]", "N*m", "Allowable torque at the main shaft", gt=0)] = None
    allowable_pin_pressure: Annotated[float | None,
        Quantity("[p]", "MPa", "Allowable pressure of journals and pins, on their projected area", gt=0)] = None
    allowable_rod_stress: Annotated[float | None,
        Quantity("[σ]", "MPa", "Allowable pulsating stress of the rods, on their minimum cross-section", gt=0)] = None
    n_points: Annotated[int, POINTS] = 720

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


def in_phase(number: int) -> Bound:
    """Whether the crank is in a phase: 1 the rods relax, 2 free travel, 3 cutting."""
    return bind(lambda phase, number: phase == number, number=number)


def by_phase(relaxing: Bound, free: Bound, cutting: Bound) -> tuple[Case, ...]:
    """A quantity's value in each of the three phases."""
    return (case(relaxing, "the platen stands on the die and the rods relax", in_phase(1)),
            case(cutting, "the board is cut and the rods elongate", in_phase(3)),
            case(free, "the platen travels freely"))


machine = Chapter("Machine",
    text="The crank angle φ is measured from the inner dead centre, where crank and rods are folded and the platen is closest to the shaft.")
machine.require("rod_longer", lambda rod_length, crank_radius: rod_length > 1.001 * crank_radius, key="rod_length",
    message="is {rod_length}, but the rod must be longer than the crank's radius {crank_radius}, by a thousandth of it at least; else the crank "
        "cannot turn fully")
machine.value("crank_speed", "ω", "rad/s", "Angular speed of the crank", lambda cycles_per_hour: 2 * pi * cycles_per_hour)
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
for name, symbol, place in ADOPTED:
    machine.value(name, symbol, "1", f"Coefficient of friction of the {place}: individual value", bind(common.same, quantity=f"inputs.{name}"),
        needs=(name,), source="input", output=False)
    machine.value(name, symbol, "1", f"Coefficient of friction of the {place}: common value", lambda friction: friction, lacks=(name,),
        source="input", output=False)

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
contact.value("friction_arm", "X", "mm", "Friction arm of the joints at the dead centre", friction_arm, source="001 eq. 10, 11")
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
motion.value("cutting_begin", "φ_b", "deg", "Crank angle at which cutting begins", lambda cutting_start_angle: 2 * pi - cutting_start_angle,
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
    *by_phase(bind(common.same, quantity="drive_deformation"), bind(common.same, quantity="platen_displacement"), bind(true_travel)),
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
window.value("window_end", "φ_w2", "deg", "Crank angle at which the press closes", lambda window_start: 2 * pi - window_start, source="symmetry")
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
forces.value("standing_distance", "x_p", "mm", "Distance of the standing platen's pins from the shaft",
    lambda rod_length, drive_deformation, crank_radius: rod_length + drive_deformation - crank_radius,
    source="001 eq. 16", output=False)
forces.value("stretched_length", "L", "mm", "Length of the rods while the platen stands", stretched_length, source="001 eq. 16, exact",
    output=False)
forces.choice("rod_stretch", "Δl", "mm", "Elongation of the rods",
    *by_phase(bind(common.difference, quantity="stretched_length", less="rod_length"), bind(common.zero),
        bind(lambda platen_displacement, material_thickness, drive_deformation:
                drive_deformation * (1 - platen_displacement / (material_thickness + drive_deformation)))), source="001 eq. 12, 16")
forces.value("elastic_force", "P", "kN", "Force of the elongated rods; while cutting, equal to the cutting force",
    lambda cutting_force_max, rod_stretch, drive_deformation: cutting_force_max * rod_stretch / drive_deformation, source="001, before eq. 12")
forces.choice("inertia_force", "P_i", "N", "Inertia force of the platen", case(lambda: 0, "the platen stands on the die", in_phase(1)),
    case(lambda platen_mass, platen_acceleration: platen_mass * platen_acceleration, "the platen moves"), source="001, after eq. 2")
forces.value("force", "F", "kN", "Force of the rods along the guides", lambda elastic_force, inertia_force: elastic_force - inertia_force,
    source="001, after eq. 2")
forces.value("crank_pin_force_x", "F_A,x", "kN", "Force of one of the two rods on its crank pin, along the guides", lambda force: force / 2,
    source="symmetry")
forces.value("crank_pin_force_y", "F_A,y", "kN", "Force of one of the two rods on its crank pin, across the guides",
    lambda crank_pin_force_x, rod_angle: crank_pin_force_x * np.tan(rod_angle), source="statics")
forces.crossings("force_change", "φ_F", "deg", "Crank angle at which the force of the rods changes its sign", of="force", output=False)
forces.breakpoints("force_changes", "crank_angle", "force_change")
forces.reduction("inertia_force_max", "P_i,max", "N", "Maximum inertia force of the platen", "abs_max", of="inertia_force")
forces.value("force_max", "F_max", "kN", "Maximum force of the rods: from cutting, or from inertia in free travel",
    lambda cutting_force_max, inertia_force_max: np.maximum(cutting_force_max, inertia_force_max))

friction = Chapter("Friction of the joints",
    text="Each joint turns under the force of the rods; its friction acts at the joint's radius with the relative angular speed of the two parts. "
        "While the rods relax the crank is near its dead centre, and the value of X at the dead centre is used.")
friction.value("rod_speed_ratio", "β′", "1", "Ratio of the rods' angular speed to the crank's",
    bind(slider_crank.inner_coupler_angle_speed, coupler_angle="rod_angle", crank_ratio="lambda_ratio"), source="001 eq. 5", output=False)
friction.crossings("rod_turn", "φ_β", "deg", "Crank angle at which the rods reverse their swing", of="rod_speed_ratio", output=False)
friction.breakpoints("rod_turns", "crank_angle", "rod_turn")
friction.value("moving_joint_arm", "X_φ", "mm", "Friction arm of the joints at the crank angle", joint_arm, source="001 eq. 5–7",
    output=False)
friction.choice("joint_arm", "X_j", "mm", "Friction arm of the joints",
    case(lambda friction_arm: friction_arm, "the rods relax: value at the dead centre", in_phase(1)),
    case(lambda moving_joint_arm: moving_joint_arm, "the platen moves"), source="001 eq. 5–7, 17")
friction.value("joint_torque", "M_j", "N*m", "Torque from joint friction", lambda force, joint_arm: abs(force) * joint_arm, source="001 eq. 5–7",
    output=False)

guides = Chapter("Friction of the guides",
    text="A force offset from the axis of the guides tilts the platen in them. Where the platen stands, its guides have no friction. The rods also "
        "carry the friction of the guides, so its arm is theirs, V/ω with the ideal speed.", needs=("guide_length",),
    absent="not calculated: guide_length is not given, and no force is offset from the axis of the guides")
guides.value("guide_moment", "M_g", "N*m", "Tilting moment on the platen in its guides",
    lambda force, offset_force, platen_mass, offset_weight: force * offset_force - platen_mass * GRAVITY * offset_weight, source="001 eq. 3",
    output=False)
guides.crossings("guide_change", "φ_g", "deg", "Crank angle at which the guides' reactions change sides", of="guide_moment", output=False)
guides.crossings("platen_turn", "φ_V", "deg", "Crank angle at which the platen reverses", of="platen_velocity_ideal", output=False)
guides.breakpoints("guide_changes", "crank_angle", "guide_change", "platen_turn")
guides.choice("guide_friction", "T", "N", "Friction of the guides", case(lambda: 0, "the platen stands on the die", in_phase(1)),
    case(lambda friction_guide, guide_moment, guide_length: 2 * friction_guide * abs(guide_moment) / guide_length, "the platen moves"),
    source="001 eq. 3, 4")
guides.value("guide_torque", "M_n", "N*m", "Torque from guide friction", lambda guide_friction, travel_rate: guide_friction * abs(travel_rate),
    source="001 eq. 4", output=False)
guides.value("weight_torque", "M_G", "N*m", "Maximum torque due to the guides' friction under the weight alone", weight_torque,
    source="001 eq. 4", output=False, needs=("allowable_torque",))

torque = Chapter("Torque at the main shaft",
    text="The moment arm of the rods' force follows from the crank and rods alone: V/ω with the ideal speed. The crank must also supply the strain "
        "energy of the rods; they return it after the dead centre.")
torque.choice("force_arm", "a", "mm", "Moment arm of the rods' force about the shaft, positive where it resists the crank",
    case(lambda standing_distance, crank_radius, crank_angle, stretched_length:
            -standing_distance * crank_radius * np.sin(crank_angle) / stretched_length, "the platen stands on the die", in_phase(1)),
    case(lambda travel_rate: -travel_rate, "the platen moves"), source="001 eq. 2, 16", output=False)
torque.value("torque_useful", "M_u", "N*m", "Torque from cutting, elongation and inertia", lambda force, force_arm: force * force_arm,
    source="virtual work")
torque.value("torque_friction", "M_f", "N*m", "Torque from friction in joints and guides",
    lambda joint_torque, guide_torque: joint_torque + guide_torque, source="001 eq. 1", needs=("guide_length",))
torque.value("torque_friction", "M_f", "N*m", "Torque from friction in the joints", lambda joint_torque: joint_torque, source="001 eq. 1",
    lacks=("guide_length",))
torque.value("torque", "M", "N*m", "Torque at the main shaft", lambda torque_useful, torque_friction: torque_useful + torque_friction,
    source="001 eq. 1, corrected")
torque.reduction("torque_max", "M_max", "N*m", "Maximum torque", "max", of="torque")
torque.value("torque_max_angle", "φ_M", "deg", "Crank angle of the maximum torque, before the dead centre",
    lambda torque_max_at: np.where(torque_max_at > 0, 2 * pi - torque_max_at, 0))
torque.reduction("torque_min", "M_min", "N*m", "Minimum torque (negative: platen or rods drive the crank)", "min", of="torque")
torque.value("crank_pin_torque", "M_A", "N*m", "Torque of one of the two rods, including friction, on its crank", lambda torque: -torque / 2,
    source="symmetry")
torque.choice("torque_source", "M_14", "N*m", "Torque by eq. 14 as printed, while cutting",
    case(bind(torque_as_printed), "the board is cut", in_phase(3)), case(lambda: 0, "eq. 14 is for cutting alone"), source="001 eq. 14")
torque.reduction("torque_max_source", "M_14,max", "N*m", "Maximum torque by eq. 14 as printed", "max", of="torque_source")
torque.value("torque_max_source_angle", "φ_14", "deg", "Its crank angle before the dead centre",
    lambda torque_max_source_at: np.where(torque_max_source_at > 0, 2 * pi - torque_max_source_at, 0))

returning = Chapter("Relaxing rods",
    text="The elongated rods drive the crank over an arm that grows until they have relaxed; friction resists over X.")
returning.value("elastic_arm", "a_d", "mm", "Maximum arm with which the relaxing rods drive the crank",
    lambda standing_distance, crank_radius, dwell_end_angle, rod_length: standing_distance * crank_radius * np.sin(dwell_end_angle) / rod_length,
    source="001 eq. 16, exact")
returning.value("return_arm_min", "X_min", "mm", "Minimum excess of the friction arm over the arm of the rods",
    lambda friction_arm, elastic_arm: friction_arm - elastic_arm, source="001 eq. 17")
returning.value("friction_limit", "f_rev", "1", "Coefficient of friction below which the rods would drive the crank",
    lambda friction, elastic_arm, friction_arm: friction * elastic_arm / friction_arm, source="statics", needs=("friction",),
    lacks=tuple(key for key, _, _ in ADOPTED), exists=lambda friction: friction > 0)
returning.value("deformation_limit", "Δl_rev", "mm", "Elongation of the drive above which the rods would drive the crank", deformation_limit,
    source="statics", exists=lambda friction_arm, crank_radius: friction_arm < crank_radius)

work = Chapter("Work and power",
    text="In the model the platen is set in motion instantaneously when the rods have relaxed; this energy is not part of the torque over the "
        "revolution and is added to it. The energy stored in the rods before the dead centre is returned after it.")
work.reduction("torque_work", "W_M", "J", "Work of the torque over a revolution", "integral", of="torque", output=False)
work.value("start_rod_angle", "β_d", "deg", "Angle of the rods to the guides where they have relaxed",
    bind(slider_crank.inner_coupler_angle, crank_angle="dwell_end_angle", crank_ratio="lambda_ratio"), output=False)
work.value("start_velocity", "V_d", "m/s", "Speed with which the platen leaves the die",
    bind(slider_crank.inner_velocity, crank_angle="dwell_end_angle", coupler_angle="start_rod_angle"), output=False)
work.value("start_energy", "W_d", "J", "Energy to set the platen in motion",
    lambda platen_mass, start_velocity: platen_mass * start_velocity ** 2 / 2, source="energy", output=False)
work.value("work_per_cycle", "W_c", "J", "Work per cycle, including setting the platen in motion",
    lambda torque_work, start_energy: torque_work + start_energy, source="energy")
work.value("cutting_work", "W_s", "J", "Work of cutting the board",
    lambda cutting_force_max, material_thickness: cutting_force_max * material_thickness / 2, source="energy")
work.reduction("friction_work", "W_f", "J", "Work of friction", "integral", of="torque_friction")
work.value("strain_energy", "W_e", "J", "Energy stored and returned by the rods",
    lambda cutting_force_max, drive_deformation: cutting_force_max * drive_deformation / 2, source="energy")
work.value("friction_share", "k_f", "%", "Fraction of the work taken by friction",
    lambda friction_work, work_per_cycle: friction_work / work_per_cycle)
work.value("power_mean", "P_mean", "W", "Mean power at the main shaft", lambda work_per_cycle, cycles_per_hour: work_per_cycle * cycles_per_hour)
work.value("energy_residual", "r_E", "1", "Relative difference between the work and its components",
    lambda work_per_cycle, cutting_work, friction_work: abs(work_per_cycle - cutting_work - friction_work) / work_per_cycle,
    source="conservation of energy", output=False)


def _pressure(key: str, name: str, symbol: str, pins: str, radius: str) -> Chapter:
    """The pressure of one kind of pins."""
    chapter = Chapter(f"Pressure on the {pins}", text="The two of them share the force of the rods.", needs=(key,),
        absent=f"not calculated: {key} is not given")
    chapter.value(name, symbol, "MPa", f"Pressure on the {pins} on their projected area",
        bind(lambda force_max, radius, length: force_max / (4 * radius * length), radius=radius, length=key), source="statics")
    return chapter


PRESSURES = (
    _pressure("journal_length", "journal_pressure", "p_0", "journals", "journal_radius"),
    _pressure("crank_pin_length", "crank_pin_pressure", "p_A", "crank pins", "crank_pin_radius"),
    _pressure("platen_pin_length", "platen_pin_pressure", "p_B", "platen's pins", "platen_pin_radius"),
)

rods = Chapter("Stress in the rods", text="The two of them share the force, which pulsates from zero once per revolution.", needs=("rod_net_area",),
    absent="not calculated: rod_net_area is not given")
rods.value("rod_stress", "σ_r", "MPa", "Maximum tensile stress of the rods", lambda force_max, rod_net_area: force_max / (2 * rod_net_area),
    source="statics")
