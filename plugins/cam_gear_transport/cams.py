"""Chapters on the two cams: roller paths, profiles, pressure angle, curvature, roller forces and contact."""

from __future__ import annotations

from diecut_report.api import Chapter, Formula, Reduction, Require, Step, Value, Words, bind
from diecut_report.mechanics import cam, common, contact
from diecut_report.plugins.cam_gear_transport import advice, arms, loads
from diecut_report.plugins.cam_gear_transport.inputs import CAMS, TORQUE

NO_CAMS = "not calculated: arm_length, roller_radius, arm_angle_1 and arm_angle_2 are not all given"
LOADED = (*TORQUE, "roller_width")

OTHER_ARM = (
    "the line O₁O₃; one arm must stay on its left (more than {least_arm_angle:up}, less than {greatest_arm_angle:down}) and the other on its "
    "right (180° more), so that one cam pushes the sector one way and the other cam back; take "
    "{arm_angles_best}"
)


def _one_side(number: str) -> Require:
    return Require(
        id=f"arm_{number}_side", key=f"arm_angle_{number}",
        condition=bind(loads.stays_on_one_side, lowest=f"arm_{number}_lowest", highest=f"arm_{number}_highest"),
        message=f"is {{arm_angle_{number}}}; the arm would swing from {{arm_{number}_lowest}} to {{arm_{number}_highest}} across {OTHER_ARM}",
    )  # fmt: skip


def _swing(number: str) -> tuple[Step, ...]:
    """Between which directions an arm swings."""
    return (
        Value(id=f"arm_{number}_lowest", symbol=f"ψ_min,{number}", unit="deg", source="geometry", output=False,
              description=f"Direction of arm {number} at the start of phase I",
              formula=bind(loads.lowest_direction, arm_angle=f"arm_angle_{number}")),
        Value(id=f"arm_{number}_highest", symbol=f"ψ_max,{number}", unit="deg", source="geometry", output=False,
              description=f"Direction of arm {number} at the end of phase III",
              formula=bind(loads.highest_direction, lowest=f"arm_{number}_lowest")),
    )  # fmt: skip


ROCKER = Chapter(
    "Rocker on the cams",
    needs=CAMS,
    absent=NO_CAMS,
    text="The rocker is fixed to the sector; the rollers on its arms run on two cams that stand still, each profile lying towards O₁ "
    "from its roller. ψ is an arm's direction from the outward line O₁O₃, "
    "w is the rocker's speed to the disc's, γ″ the second derivative of the sector's angle by the disc's.",
    steps=(
        Value(id="sector_rate_change", symbol="γ″", description="Acceleration of the sector to the square of the disc's speed",
              source="kinematics", output=False, formula=loads.sector_rate_change),
        Require(id="sweep_leaves_arms", key="sector_dwell_sweep", condition=loads.leaves_arms,
                message="makes the whole sweep of the sector {sector_sweep}; it must be less than 180°, or no arm can stay on one side of the "
                "line O₁O₃"),
        Value(id="least_arm_angle", symbol="χ_min", unit="deg", description="Least angle of an arm on the left of O₁O₃", source="geometry",
              output=False, formula=loads.least_arm_angle),
        Value(id="greatest_arm_angle", symbol="χ_max", unit="deg", description="Greatest angle of an arm on the left of O₁O₃",
              source="geometry", output=False, formula=loads.greatest_arm_angle),
        Words(id="arm_angles_best", function=arms.angles_at_the_ends, takes=("center_distance", "arm_length", "sector_dwell_sweep", "sector_sweep")),
        *_swing("1"),
        *_swing("2"),
        _one_side("1"),
        _one_side("2"),
        Require(id="arms_on_both_sides", key="arm_angle_2",
                condition=bind(loads.lie_on_both_sides, lowest="arm_1_lowest", highest="arm_1_highest", other_lowest="arm_2_lowest",
                               other_highest="arm_2_highest"),
                message=f"is {{arm_angle_2}}, which puts both arms (the other at {{arm_angle_1}}) on one side of {OTHER_ARM}"),
    ),
)  # fmt: skip


def _path(number: str) -> dict[str, str]:
    """What the formulas of a roller's path take."""
    return {
        "carrier_angle": "disc_angle",
        "pivot_radius": "center_distance",
        "arm_direction": f"arm_{number}_direction",
        "arm_turn": "rocker_turn",
        "arm_acceleration": "sector_rate_change",
        "roller_path": f"cam_{number}_path",
        "swing_part": f"cam_{number}_swing_part",
        "pitch_x": f"cam_{number}_pitch_x",
        "pitch_y": f"cam_{number}_pitch_y",
    }


def _profile(number: str) -> tuple[Step, ...]:
    """Curves of a cam."""

    def curve(name: str, symbol: str, unit: str, description: str, formula: Formula, *, output: bool = True) -> Value:
        takes = {p: q for p, q in _path(number).items() if p in formula.parameters}
        return Value(id=f"cam_{number}_{name}", symbol=symbol, unit=unit, description=f"{description}, cam {number}", output=output,
                     source="geometry", formula=bind(formula, **takes))  # fmt: skip

    return (
        Value(id=f"arm_{number}_direction", symbol=f"ψ_{number}", unit="deg", description=f"Direction of arm {number}", output=False,
              source="geometry", formula=bind(common.sum_of, first=f"arm_angle_{number}", second="sector_angle")),
        curve("pitch_x", f"x_p{number}", "mm", "Pitch curve x", cam.pitch_x),
        curve("pitch_y", f"y_p{number}", "mm", "Pitch curve y", cam.pitch_y),
        curve("path", f"l_{number}", "mm", "Path of the roller's centre for each radian of the disc", cam.roller_path, output=False),
        curve("x", f"x_{number}", "mm", "Profile x", cam.profile_x),
        curve("y", f"y_{number}", "mm", "Profile y", cam.profile_y),
        curve("pressure_angle", f"δ_{number}", "deg", "Pressure angle", cam.pressure_angle),
        curve("swing_part", f"c_{number}", "1", "Part of the curvature that comes with the arm's swing", cam.swing_part, output=False),
        curve("curvature", f"κ_{number}", "1/m", "Curvature of the pitch curve", cam.curvature),
        curve("tangent_distance", f"q_{number}", "mm", "Distance of O₁ from the pitch curve's tangent", cam.tangent_distance, output=False),
    )  # fmt: skip


def _extremes(number: str) -> tuple[Step, ...]:
    """What a cam is judged by."""
    return (
        Reduction(id=f"cam_{number}_pressure_angle_max", symbol=f"δ_max,{number}", unit="deg", source="this method",
                  description=f"Greatest pressure angle of cam {number}", of=f"cam_{number}_pressure_angle", operation="max"),
        Reduction(id=f"cam_{number}_curvature_greatest", symbol=f"κ_max,{number}", unit="1/m", source="geometry", output=False,
                  description=f"Greatest curvature of pitch curve {number}, convex", of=f"cam_{number}_curvature", operation="max"),
        Reduction(id=f"cam_{number}_curvature_least", symbol=f"κ_min,{number}", unit="1/m", source="geometry", output=False,
                  description=f"Least curvature of pitch curve {number}, below zero where it is hollow", of=f"cam_{number}_curvature",
                  operation="min"),
        Reduction(id=f"cam_{number}_tangent_min", symbol=f"q_min,{number}", unit="mm", source="geometry", output=False,
                  description=f"Least distance of O₁ from the tangents of pitch curve {number}", of=f"cam_{number}_tangent_distance",
                  operation="min"),
        Value(id=f"cam_{number}_curvature_min", symbol=f"ρ_min,{number}", unit="mm", source="geometry",
              description=f"Least radius of curvature of pitch curve {number} where it is convex",
              formula=bind(cam.least_radius, greatest_curvature=f"cam_{number}_curvature_greatest")),
        Value(id=f"cam_{number}_profile_radius_min", symbol=f"ρ_c,{number}", unit="mm", source="geometry",
              description=f"Least radius of profile {number} where it is convex; below zero it undercuts",
              formula=bind(cam.profile_radius, pitch_radius=f"cam_{number}_curvature_min")),
        Value(id=f"cam_{number}_hollow_radius_min", symbol=f"ρ_h,{number}", unit="mm", source="geometry",
              description=f"Least radius of profile {number} where it is hollow: no greater grinding wheel",
              exists=bind(cam.is_hollow, least_curvature=f"cam_{number}_curvature_least"),
              formula=bind(cam.hollow_radius, least_curvature=f"cam_{number}_curvature_least")),
    )  # fmt: skip


def _cam(number: str) -> Chapter:
    return Chapter(
        f"Cam {number}",
        needs=CAMS,
        absent=NO_CAMS,
        text="The pitch curve is the path of the roller's centre; the profile is set off from it by the roller's radius, towards O₁. "
        "Curvature counts above zero where the pitch curve is convex, its centre of curvature being on O₁'s side: there the profile's radius is "
        "ρ − r, and where ρ < r the profile undercuts. Where the pitch curve is hollow the profile's radius is |ρ| + r, whatever the roller.",
        steps=(*_profile(number), *_extremes(number)),
    )


BOTH = Chapter(
    "Both cams",
    needs=CAMS,
    absent=NO_CAMS,
    text="A roller touches its profile once only where, besides, the tangents of the pitch curve keep more than r from O₁: then profile "
    "and pitch curve go round O₁ without turning back.",
    steps=(
        Value(id="pressure_angle_max", symbol="δ_max", unit="deg", description="Greatest pressure angle of both cams", source="this method",
              formula=bind(common.greater_of, first="cam_1_pressure_angle_max", second="cam_2_pressure_angle_max")),
        Value(id="curvature_min", symbol="ρ_min", unit="mm", description="Least radius of curvature of both pitch curves where convex",
              source="geometry", formula=bind(common.smaller_of, first="cam_1_curvature_min", second="cam_2_curvature_min")),
        Value(id="tangent_distance_min", symbol="q_min", unit="mm", description="Least distance of O₁ from the tangents of both pitch curves",
              source="geometry", formula=bind(common.smaller_of, first="cam_1_tangent_min", second="cam_2_tangent_min")),
        Words(id="arms_that_fit", function=arms.arms_that_fit, takes=arms.TAKES, lacks=("module",)),
        Words(id="arms_that_fit", function=arms.arms_that_fit, takes=(*arms.TAKES, "module"), needs=("module",)),
        Words(id="roller_smaller", function=advice.smaller_roller, takes=("curvature_min", "tangent_distance_min")),
    ),
)  # fmt: skip


def _loaded(number: str) -> tuple[Step, ...]:
    """Force and pressure of a roller."""
    return (
        Value(id=f"carried_moment_{number}", symbol=f"M_c{number}", unit="N*m", description=f"Moment about O₃ that cam {number} gives",
              source="statics", output=False, formula=bind(loads.carried_moment, arm_direction=f"arm_{number}_direction")),
        Value(id=f"roller_force_{number}", symbol=f"F_{number}", unit="N", description=f"Force of cam {number} on its roller", source="statics",
              formula=bind(loads.roller_force, carried_moment=f"carried_moment_{number}", pressure_angle=f"cam_{number}_pressure_angle")),
        Value(id=f"effective_radius_{number}", symbol=f"R_e{number}", unit="mm", source="Hertz", output=False, needs=("roller_width",),
              description=f"Effective radius of roller and profile {number}",
              formula=bind(cam.effective_radius, curvature=f"cam_{number}_curvature")),
        Value(id=f"bearing_radius_{number}", symbol=f"R_b{number}", unit="mm", source="Hertz", output=False, needs=("roller_width",),
              description=f"The same, at least a thousandth of the roller's radius (profile {number})",
              formula=bind(loads.bearing_radius, effective_radius=f"effective_radius_{number}")),
        Value(id=f"contact_pressure_{number}", symbol=f"p_H{number}", unit="MPa", description=f"Contact pressure of roller and cam {number}",
              source="Hertz", needs=("roller_width",),
              formula=bind(contact.contact_pressure, force=f"roller_force_{number}", effective_radius=f"bearing_radius_{number}",
                           length="roller_width")),
        Reduction(id=f"cam_{number}_roller_force_peak", symbol=f"F_max,{number}", unit="N", description=f"Greatest force on roller {number}",
                  source="statics", of=f"roller_force_{number}", operation="max"),
        Reduction(id=f"cam_{number}_contact_pressure_max", symbol=f"p_H{number},max", unit="MPa", needs=("roller_width",),
                  description=f"Greatest contact pressure of roller and cam {number}", source="Hertz", of=f"contact_pressure_{number}",
                  operation="max"),
    )  # fmt: skip


LOADS = Chapter(
    "Forces on the rollers",
    needs=(*CAMS, *TORQUE),
    absent="not calculated: the cams and conveyor_mass with sprocket_teeth and chain_pitch are not all given",
    text="About O₃ the rocker is in balance between the teeth's reaction, the sector's inertia and one roller: a cam can only push, "
    "outwards, so the cam of the left arm turns the sector clockwise and that of the right arm counter-clockwise. The force stands square "
    "to the profile, at the pressure angle from the roller's motion. A preload of the rollers is not included.",
    steps=(
        Value(id="rocker_moment", symbol="M_3", unit="N*m", description="Moment about O₃ that the cams give the rocker", source="statics",
              output=False, formula=loads.rocker_moment),
        Value(id="effective_modulus", symbol="E*", unit="GPa", description="Modulus of the contact", source="Hertz", needs=("roller_width",),
              formula=contact.effective_modulus_alike),
        *_loaded("1"),
        *_loaded("2"),
        Value(id="roller_force_peak", symbol="F_max", unit="N", description="Greatest force on a roller", source="statics",
              formula=bind(common.greater_of, first="cam_1_roller_force_peak", second="cam_2_roller_force_peak")),
        Value(id="contact_pressure", symbol="p_H,max", unit="MPa", description="Greatest contact pressure of a roller", source="Hertz",
              needs=("roller_width",),
              formula=bind(common.greater_of, first="cam_1_contact_pressure_max", second="cam_2_contact_pressure_max")),
        Words(id="contact_softer", function=advice.softer_contact, needs=("roller_width", "allowable_contact_pressure"),
              takes=("contact_pressure", "allowable_contact_pressure", "roller_width", "cycles_per_hour")),
    ),
)  # fmt: skip

SECTIONS = (ROCKER, _cam("1"), _cam("2"), BOTH, LOADS)
