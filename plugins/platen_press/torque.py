"""Chapters on forces, torque, the relaxing rods, work and pin pressures."""

from __future__ import annotations

from diecut_report.api import Breakpoints, Case, Chapter, Choice, Crossings, Reduction, Value, Words, bind
from diecut_report.mechanics import common, slider_crank
from diecut_report.plugins.platen_press import advice, formulas
from diecut_report.plugins.platen_press.motion import ADOPTED, by_phase, in_phase

LOAD = (
    "torque_max",
    "allowable_torque",
    "cutting_force_max",
    "torque_max_angle",
    "cutting_start_angle",
    "inertia_force_max",
    "crank_radius",
)

FORCES = Chapter(
    "Force of the rods",
    text="Both rods together, along the guides, tension positive. The force of the rods' stretch is that of cutting, until the dead centre; "
    "after it the platen stands and the rods relax.",
    steps=(
        Value(id="standing_distance", symbol="x_p", unit="mm", description="Distance of the standing platen's pins from the shaft",
              source="001 eq. 16", digits=6, output=False, formula=formulas.standing_distance),
        Value(id="stretched_length", symbol="L", unit="mm", description="Length of the rods while the platen stands", source="001 eq. 16, exact",
              output=False, formula=formulas.stretched_length),
        Choice(id="rod_stretch", symbol="Δl", unit="mm", description="Stretch of the rods", source="001 eq. 12, 16",
               cases=by_phase(bind(common.difference, greater="stretched_length", smaller="rod_length"), bind(common.zero),
                              bind(formulas.stretch_in_cut))),
        Value(id="elastic_force", symbol="P", unit="kN", description="Force of the stretched rods, while cutting that of the board",
              source="001, before eq. 12", formula=formulas.elastic_force),
        Choice(id="inertia_force", symbol="P_i", unit="N", description="Force that accelerates the platen", source="001, after eq. 2",
               cases=(Case(bind(common.zero), "the platen stands on the die", in_phase(1)),
                      Case(bind(formulas.inertia, acceleration="platen_acceleration"), "the platen moves"))),
        Value(id="force", symbol="F", unit="kN", description="Force of the rods along the guides", source="001, after eq. 2",
              formula=bind(common.difference, greater="elastic_force", smaller="inertia_force")),
        Crossings(id="force_change", symbol="φ_F", unit="deg", of="force", output=False,
                  description="Crank angle at which the force of the rods changes its sign"),
        Breakpoints(id="force_changes", abscissa="crank_angle", places=("force_change",)),
        Reduction(id="inertia_force_max", symbol="P_i,max", unit="N", description="Greatest inertia force of the platen", of="inertia_force",
                  operation="abs_max"),
        Value(id="force_max", symbol="F_max", unit="kN", description="Greatest force of the rods: of cutting, or of inertia in free travel",
              formula=bind(common.greater_of, first="cutting_force_max", second="inertia_force_max")),
    ),
)  # fmt: skip

FRICTION = Chapter(
    "Friction of the joints",
    text="Each joint turns under the force of the rods; its friction acts on the joint's radius with the speed at which the two parts turn "
    "in each other. While the rods relax the crank stands near its dead centre, and X of the dead centre is taken.",
    steps=(
        Value(id="rod_speed_ratio", symbol="β′", description="Angular speed of the rods to the crank's", source="001 eq. 5", output=False,
              formula=bind(slider_crank.inner_coupler_angle_speed, coupler_angle="rod_angle", crank_ratio="lambda_ratio")),
        Crossings(id="rod_turn", symbol="φ_β", unit="deg", of="rod_speed_ratio", output=False,
                  description="Crank angle at which the rods swing back"),
        Breakpoints(id="rod_turns", abscissa="crank_angle", places=("rod_turn",)),
        Value(id="moving_joint_arm", symbol="X_φ", unit="mm", description="Arm of the joints' friction at the crank angle", source="001 eq. 5–7",
              output=False, formula=formulas.joint_arm),
        Choice(id="joint_arm", symbol="X_j", unit="mm", description="Arm of the joints' friction", source="001 eq. 5–7, 17",
               cases=(Case(bind(common.same, quantity="friction_arm"), "the rods relax: that of the dead centre", in_phase(1)),
                      Case(bind(common.same, quantity="moving_joint_arm"), "the platen moves"))),
        Value(id="joint_torque", symbol="M_j", unit="N*m", description="Torque of the joints' friction", source="001 eq. 5–7", output=False,
              formula=formulas.joint_torque),
    ),
)  # fmt: skip

GUIDES = Chapter(
    "Friction of the guides",
    needs=("guide_length",),
    absent="not calculated: guide_length is not given, and no force is offset from the axis of the guides",
    text="A force beside the axis of the guides turns the platen in them. Where the platen stands its guides have no friction. The rods "
    "carry the friction of the guides too, so that its arm is theirs, V/ω with the ideal speed.",
    steps=(
        Value(id="guide_moment", symbol="M_g", unit="N*m", description="Moment that turns the platen in its guides", source="001 eq. 3",
              output=False, formula=formulas.guide_moment),
        Crossings(id="guide_change", symbol="φ_g", unit="deg", of="guide_moment", output=False,
                  description="Crank angle at which the guides' reactions change sides"),
        Crossings(id="platen_turn", symbol="φ_V", unit="deg", of="platen_velocity_ideal", output=False,
                  description="Crank angle at which the platen turns back"),
        Breakpoints(id="guide_changes", abscissa="crank_angle", places=("guide_change", "platen_turn")),
        Choice(id="guide_friction", symbol="T", unit="N", description="Friction of the guides", source="001 eq. 3, 4",
               cases=(Case(bind(common.zero), "the platen stands on the die", in_phase(1)),
                      Case(bind(formulas.guide_friction), "the platen moves"))),
        Value(id="guide_torque", symbol="M_n", unit="N*m", description="Torque of the guides' friction", source="001 eq. 4",
              output=False, formula=formulas.guide_torque),
        Value(id="weight_torque", symbol="M_G", unit="N*m", description="Greatest torque that the guides' friction under the weight alone asks for",
              source="001 eq. 4", output=False, needs=("allowable_torque",), formula=formulas.weight_torque),
    ),
)  # fmt: skip

TORQUE = Chapter(
    "Torque at the main shaft",
    text="The arm of the rods' force follows from the crank and rods alone: V/ω with the ideal speed. What the rods store while they stretch the "
    "crank has to give too; they give it back after the dead centre.",
    steps=(
        Choice(id="force_arm", symbol="a", unit="mm", description="Arm of the rods' force about the shaft, positive where it resists the crank",
               source="001 eq. 2, 16", output=False,
               cases=(Case(bind(formulas.relaxing_arm), "the platen stands on the die", in_phase(1)),
                      Case(bind(formulas.driving_arm), "the platen moves"))),
        Value(id="torque_useful", symbol="M_u", unit="N*m", description="Torque of cutting, stretch and inertia", source="virtual work",
              formula=bind(common.moment, arm="force_arm")),
        Value(id="torque_friction", symbol="M_f", unit="N*m", description="Torque of friction in joints and guides", source="001 eq. 1",
              needs=("guide_length",), formula=bind(common.sum_of, first="joint_torque", second="guide_torque")),
        Value(id="torque_friction", symbol="M_f", unit="N*m", description="Torque of friction in the joints", source="001 eq. 1",
              lacks=("guide_length",), formula=bind(common.same, quantity="joint_torque")),
        Value(id="torque", symbol="M", unit="N*m", description="Torque at the main shaft", source="001 eq. 1, corrected",
              formula=bind(common.sum_of, first="torque_useful", second="torque_friction")),
        Reduction(id="torque_max", symbol="M_max", unit="N*m", description="Greatest torque", of="torque", operation="max"),
        Value(id="torque_max_angle", symbol="φ_M", unit="deg", description="Crank angle of the greatest torque, before the dead centre",
              formula=bind(formulas.before_dead_center, angle="torque_max_at")),
        Reduction(id="torque_min", symbol="M_min", unit="N*m", description="Least torque (below zero: platen or rods drive the crank)", of="torque",
                  operation="min"),
        Choice(id="torque_source", symbol="M_14", unit="N*m", description="Torque by eq. 14 as printed, while cutting", source="001 eq. 14",
               cases=(Case(bind(formulas.torque_as_printed), "the board is cut", in_phase(3)),
                      Case(bind(common.zero), "eq. 14 is for cutting alone"))),
        Reduction(id="torque_max_source", symbol="M_14,max", unit="N*m", description="Greatest torque by eq. 14 as printed", of="torque_source",
                  operation="max"),
        Value(id="torque_max_source_angle", symbol="φ_14", unit="deg", description="Its crank angle before the dead centre",
              formula=bind(formulas.before_dead_center, angle="torque_max_source_at")),
        Words(id="torque_lower", function=advice.smaller_force, takes=LOAD, needs=("allowable_torque",), lacks=("guide_length",)),
        Words(id="torque_lower", function=advice.smaller_force, takes=(*LOAD, "weight_torque"), needs=("allowable_torque", "guide_length")),
    ),
)  # fmt: skip

RETURN = Chapter(
    "Relaxing rods",
    text="The stretched rods help the crank over an arm that grows until they have relaxed; friction resists over X.",
    steps=(
        Value(id="elastic_arm", symbol="a_d", unit="mm", description="Greatest arm over which the relaxing rods help the crank",
              source="001 eq. 16, exact", formula=formulas.elastic_arm),
        Value(id="return_arm_min", symbol="X_min", unit="mm", description="Least of what friction's arm has over theirs", source="001 eq. 17",
              formula=formulas.return_arm),
        Value(id="friction_limit", symbol="f_rev", description="Coefficient of friction below which the rods would drive the crank",
              source="statics", needs=("friction",), lacks=tuple(key for key, _, _ in ADOPTED), formula=formulas.friction_limit,
              exists=bind(common.is_below, smaller=0, greater="friction")),
        Value(id="deformation_limit", symbol="Δl_rev", unit="mm", description="Stretch of the drive above which the rods would drive the crank",
              source="statics", formula=formulas.deformation_limit,
              exists=bind(common.is_below, smaller="friction_arm", greater="crank_radius")),
        Words(id="drive_stiffer", function=advice.softest_drive, takes=("deformation_limit",), needs=("drive_deformation",)),
        Words(id="drive_stiffer", function=advice.thinnest_rods, lacks=("drive_deformation",),
              takes=("deformation_limit", "drive_deformation", "rod_area", "elastic_modulus")),
    ),
)  # fmt: skip

WORK = Chapter(
    "Work and power",
    text="The model sets the platen moving in no time when the rods have relaxed; the energy of that is no part of the torque over the "
    "turn and is added to it. What the rods take up before the dead centre they give back after it.",
    steps=(
        Reduction(id="torque_work", symbol="W_M", unit="J", description="Work of the torque over a turn", of="torque", operation="integral",
                  output=False),
        Value(id="start_rod_angle", symbol="β_d", unit="deg", description="Angle of the rods to the guides where they have relaxed",
              output=False, formula=bind(slider_crank.inner_coupler_angle, crank_angle="dwell_end_angle", crank_ratio="lambda_ratio")),
        Value(id="start_velocity", symbol="V_d", unit="m/s", description="Speed with which the platen leaves the die", output=False,
              formula=bind(slider_crank.inner_velocity, crank_angle="dwell_end_angle", coupler_angle="start_rod_angle")),
        Value(id="start_energy", symbol="W_d", unit="J", description="Energy that sets the platen moving", source="energy", output=False,
              formula=formulas.start_energy),
        Value(id="work_per_cycle", symbol="W_c", unit="J", description="Work of a cycle, setting the platen moving included",
              source="energy", digits=6, formula=bind(common.sum_of, first="torque_work", second="start_energy")),
        Value(id="cutting_work", symbol="W_s", unit="J", description="Work of cutting the board", source="energy",
              formula=formulas.cutting_work),
        Reduction(id="friction_work", symbol="W_f", unit="J", description="Work of friction", of="torque_friction", operation="integral"),
        Value(id="strain_energy", symbol="W_e", unit="J", description="Energy that the rods store and give back", source="energy",
              formula=bind(formulas.cutting_work, material_thickness="drive_deformation")),
        Value(id="friction_share", symbol="k_f", unit="%", description="Share of the work that friction takes",
              formula=bind(common.quotient, quantity="friction_work", by="work_per_cycle")),
        Value(id="power_mean", symbol="N_mean", unit="W", description="Mean power at the main shaft",
              formula=bind(common.product, first="work_per_cycle", second="cycles_per_hour")),
        Value(id="energy_residual", symbol="r_E", description="Difference of work and what it is spent on, relative",
              source="conservation of energy", output=False, formula=formulas.energy_residual),
    ),
)  # fmt: skip


def _pressure(key: str, name: str, symbol: str, pins: str, radius: str) -> Chapter:
    """The pressure of one kind of pins."""
    steps = (
        Value(id=name, symbol=symbol, unit="MPa", description=f"Pressure of the {pins} on their projected area", source="statics",
              formula=bind(formulas.pin_pressure, radius=radius, length=key)),
        Value(id=f"{key}_least", symbol=f"b_{symbol[-1]},min", unit="mm", description=f"Length of one of the {pins} at the allowed pressure",
              source="statics", output=False, needs=("allowable_pin_pressure",), formula=bind(formulas.pin_length, radius=radius)),
    )  # fmt: skip
    return Chapter(
        f"Pressure of the {pins}",
        steps=steps,
        text="Two of them share the force of the rods.",
        needs=(key,),
        absent=f"not calculated: {key} is not given",
    )


PRESSURES = (
    _pressure("journal_length", "journal_pressure", "p_0", "journals", "journal_radius"),
    _pressure("crank_pin_length", "crank_pin_pressure", "p_A", "crank pins", "crank_pin_radius"),
    _pressure("platen_pin_length", "platen_pin_pressure", "p_B", "platen's pins", "platen_pin_radius"),
)
