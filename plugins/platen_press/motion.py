"""Chapters on the machine, contact and dwell, and the motion over a turn of the crank."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Abscissa, Bound, Breakpoints, Case, Chapter, Choice, Reduction, Require, Value, bind
from diecut_report.mechanics import common, slider_crank
from diecut_report.plugins.platen_press import formulas

ADOPTED = (
    ("friction_guide", "f_1", "guides"),
    ("friction_platen_pin", "f_2", "platen's pins"),
    ("friction_crank_pin", "f_3", "crank pins"),
    ("friction_journal", "f_4", "journals"),
)


def in_phase(number: int) -> Bound:
    """Whether the crank is in a phase: 1 the rods relax, 2 free travel, 3 cutting."""
    return bind(formulas.is_phase, number=number)


def by_phase(relaxing: Bound, free: Bound, cutting: Bound) -> tuple[Case, ...]:
    """A quantity's value in each of the three phases."""
    return (Case(relaxing, "the platen stands on the die and the rods relax", in_phase(1)),
            Case(cutting, "the board is cut and the rods stretch", in_phase(3)),
            Case(free, "the platen travels freely"))  # fmt: skip


def _frictions() -> tuple[Value, ...]:
    """The coefficient of each place: its own where it is given, else that of all."""
    own = [Value(id=name, symbol=symbol, description=f"Coefficient of friction of the {place}: its own", source="input", output=False,
                 needs=(name,), formula=bind(common.same, quantity=f"inputs.{name}")) for name, symbol, place in ADOPTED]  # fmt: skip
    shared = [Value(id=name, symbol=symbol, description=f"Coefficient of friction of the {place}: that of all", source="input",
                    output=False, lacks=(name,), formula=bind(common.same, quantity="friction"))
              for name, symbol, place in ADOPTED]  # fmt: skip
    return tuple(step for pair in zip(own, shared, strict=True) for step in pair)


MACHINE = Chapter(
    "Machine",
    text="The crank angle φ is counted from the inner dead centre, where crank and rods are folded and the platen stands nearest to the shaft.",
    steps=(
        Require(id="rod_longer", condition=formulas.turns_fully, key="rod_length",
                message="is {rod_length}, but the rod must be longer than the crank's radius {crank_radius}, by a thousandth of it at least; "
                "else the crank cannot turn fully"),
        Value(id="crank_speed", symbol="ω", unit="rad/s", description="Angular speed of the crank", formula=formulas.turning_speed),
        Value(id="stroke", symbol="H", unit="mm", description="Stroke of the platen",
              formula=bind(common.twice, quantity="crank_radius")),
        Value(id="lambda_ratio", symbol="λ", description="Radius of the crank to the length of the rods", source="001, after eq. 2",
              digits=6, formula=bind(common.quotient, quantity="crank_radius", by="rod_length")),
        Value(id="drive_deformation", symbol="Δl_m", unit="mm", description="Stretch of the drive under the greatest cutting force: as given",
              source="input", needs=("drive_deformation",), formula=bind(common.same, quantity="inputs.drive_deformation")),
        Value(id="drive_deformation", symbol="Δl_m", unit="mm", description="Stretch of the two rods under the greatest cutting force",
              source="Hooke", lacks=("drive_deformation",), formula=formulas.rods_stretch),
        Value(id="drive_stiffness", symbol="c", unit="kN/mm", description="Stiffness of the drive at the platen",
              formula=bind(common.quotient, quantity="cutting_force_max", by="drive_deformation")),
        Require(id="stiff_enough", condition=bind(common.is_below, smaller="drive_deformation", greater="crank_radius"),
                key="drive_deformation", needs=("drive_deformation",),
                message="is {drive_deformation}, but must be less than the crank_radius {crank_radius}; a drive that stretches more cannot cut"),
        Require(id="rods_stiff_enough", condition=bind(common.is_below, smaller="drive_deformation", greater="crank_radius"),
                key="rod_area", lacks=("drive_deformation",),
                message="is {rod_area}; under cutting_force_max = {cutting_force_max} the rods stretch by {drive_deformation}, which must be less "
                "than the crank_radius {crank_radius}: take thicker rods"),
        Require(id="within_stroke", condition=formulas.fits_stroke, key="material_thickness",
                message="is {material_thickness}; board and stretch of the drive ({drive_deformation}) together must be less than the platen's "
                "stroke {stroke}, twice the crank_radius"),
        Require(id="guides_given", condition=formulas.no_offset, key="guide_length", lacks=("guide_length",),
                message="is needed: with offset_force = {offset_force} and offset_weight = {offset_weight} the platen presses on its guides"),
        *_frictions(),
    ),
)  # fmt: skip

CONTACT = Chapter(
    "Contact, dead centre and dwell",
    text="The drive covers the thickness of the board and its own stretch together. After the dead centre the platen stands on the die "
    "until the rods have their own length again.",
    steps=(
        Value(id="contact_travel", symbol="u_c", unit="mm", description="Travel of the unloaded drive from contact to the dead centre",
              source="001, before eq. 12", formula=bind(common.sum_of, first="material_thickness", second="drive_deformation")),
        Value(id="cutting_start_angle", symbol="φ_c", unit="deg", description="Crank angle before the dead centre at which cutting begins",
              source="closed form", digits=6, formula=bind(slider_crank.inner_crank_angle_at, displacement="contact_travel")),
        Value(id="dwell_end_angle", symbol="φ_d", unit="deg", description="Crank angle after the dead centre at which the rods have relaxed",
              source="001, after eq. 17, closed form", digits=6,
              formula=bind(slider_crank.inner_crank_angle_at, displacement="drive_deformation")),
        Value(id="contact_rod_angle", symbol="β_c", unit="deg", description="Angle of the rods to the guides at contact", output=False,
              formula=bind(slider_crank.inner_coupler_angle, crank_angle="cutting_start_angle", crank_ratio="lambda_ratio")),
        Value(id="velocity_at_contact", symbol="V_c", unit="m/s", description="Speed of the platen at contact with the board", source="loop",
              formula=bind(slider_crank.inner_velocity, crank_angle="cutting_start_angle", coupler_angle="contact_rod_angle")),
        Value(id="friction_arm", symbol="X", unit="mm", description="Arm of the joints' friction at the dead centre",
              source="001 eq. 10, 11", digits=5, formula=formulas.friction_arm),
        Value(id="acceleration_dead_center", symbol="W_0", unit="m/s**2", description="Acceleration of the platen at the dead centre",
              output=False, formula=formulas.acceleration_dead_center),
        Value(id="inertia_dead_center", symbol="P_i0", unit="N", description="Inertia force at the dead centre",
              formula=bind(formulas.inertia, acceleration="acceleration_dead_center")),
        Value(id="torque_dead_center", symbol="M_0", unit="N*m", description="Torque at the dead centre, with the inertia force",
              source="001 eq. 10, 11", digits=6, formula=formulas.torque_dead_center),
        Value(id="torque_relaxing", symbol="M_1", unit="N*m", description="Torque just after the dead centre, where the platen stands",
              source="001 eq. 17", digits=6, formula=bind(common.moment, force="cutting_force_max", arm="friction_arm")),
    ),
)  # fmt: skip

MOTION = Chapter(
    "Motion over a turn of the crank",
    text="The ideal displacement is that of a drive which does not stretch. Beside the exact speed stands the first-order form of the source; "
    "the calculation uses the exact one.",
    steps=(
        Abscissa(id="crank_angle", symbol="φ", unit="deg", description="Crank angle from the inner dead centre", period=2 * np.pi,
                 shown_at="torque_max_at"),
        Value(id="cutting_begin", symbol="φ_b", unit="deg", description="Crank angle at which cutting begins", output=False,
              formula=bind(formulas.turn_less, angle="cutting_start_angle")),
        Breakpoints(id="phases", abscissa="crank_angle", places=("dwell_end_angle", "cutting_begin")),
        Value(id="phase", symbol="j", description="Phase: 1 the rods relax, 2 free travel, 3 cutting", output=False, per_piece=True,
              formula=formulas.phase),
        Value(id="rod_angle", symbol="β", unit="deg", description="Angle of the rods to the guides", source="001, after eq. 6", output=False,
              formula=bind(slider_crank.inner_coupler_angle, crank_ratio="lambda_ratio")),
        Value(id="platen_displacement", symbol="u", unit="mm", description="Displacement of the platen from the dead centre, ideal",
              source="loop", formula=bind(slider_crank.inner_displacement, coupler_angle="rod_angle")),
        Value(id="travel_rate", symbol="u′", unit="mm", description="Ideal travel of the platen for each radian of the crank, V/ω",
              source="loop", output=False, formula=bind(slider_crank.inner_arm, coupler_angle="rod_angle")),
        Value(id="platen_velocity_ideal", symbol="V", unit="m/s", description="Speed of the platen away from the die, ideal", source="loop",
              formula=bind(common.product, first="crank_speed", second="travel_rate")),
        Value(id="platen_velocity_first_order", symbol="V_1", unit="m/s", description="The same to the first order of λ", source="001 eq. 2",
              formula=bind(slider_crank.inner_velocity_first_order, crank_ratio="lambda_ratio")),
        Value(id="first_order_error", symbol="ΔV", unit="m/s", description="Exact speed less the first-order one", output=False,
              formula=bind(common.difference, greater="platen_velocity_ideal", smaller="platen_velocity_first_order")),
        Value(id="platen_acceleration", symbol="W", unit="m/s**2", description="Acceleration of the platen away from the die, ideal",
              source="loop", formula=bind(slider_crank.inner_acceleration, coupler_angle="rod_angle", crank_ratio="lambda_ratio")),
        Choice(id="platen_displacement_true", symbol="u_t", unit="mm", description="Displacement of the platen, true", source="001 eq. 12",
               cases=by_phase(bind(common.same, quantity="drive_deformation"), bind(common.same, quantity="platen_displacement"),
                              bind(formulas.true_travel))),
        Choice(id="platen_velocity_true", symbol="V_t", unit="m/s", description="Speed of the platen, true", source="001 eq. 13",
               cases=by_phase(bind(common.zero), bind(common.same, quantity="platen_velocity_ideal"), bind(formulas.true_velocity))),
        Reduction(id="velocity_max", symbol="V_max", unit="m/s", description="Greatest speed of the platen", of="platen_velocity_ideal",
                  operation="abs_max"),
        Reduction(id="velocity_difference", symbol="ΔV_max", unit="m/s", description="Greatest difference of the first-order speed",
                  of="first_order_error", operation="abs_max"),
    ),
)  # fmt: skip
