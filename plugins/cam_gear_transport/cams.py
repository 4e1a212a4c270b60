"""Chapters on the two cams: roller paths, profiles, pressure angle, curvature, roller forces and contact."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, Formula, Steps, as_number, inner, m, pi, reduction, value
from diecut_report.mechanics import cam, contact
from diecut_report.plugins.cam_gear_transport import arms, formulas
from diecut_report.plugins.cam_gear_transport.inputs import CAMS, TORQUE

# fmt: off

NO_CAMS = "not calculated: {missing} not given"
LOADED = (*TORQUE, "roller_width")

OTHER_ARM = (
    "the line O₁O₃; one arm must stay on its left (more than {least_arm_angle:up}, less than {greatest_arm_angle:down}) and the other on its "
    "right (180° more), so that one cam pushes the sector one way and the other cam back; take "
    "{arm_angles_best}"
)

rocker = Chapter("Rocker on the cams",
    text="The rocker is fixed to the sector; the rollers on its arms run on two fixed cams, each profile lying on the O₁ side of its roller. ψ is "
        "the direction of an arm from the outward line O₁O₃, w the ratio of the rocker's speed to the disc's, γ″ the second derivative of the "
        "sector's angle with respect to the disc's.", needs=CAMS, absent=NO_CAMS)
rocker.sector_rate_change = (inner(as_number(m.sector_acceleration / (2 * pi * m.cycles_per_hour) ** 2)), "γ″", "1",
    "Ratio of the sector's acceleration to the square of the disc's speed", "kinematics")
rocker.require("sweep_leaves_arms", m.sector_sweep < pi, key="sector_dwell_sweep",
    message="makes the whole sweep of the sector {sector_sweep}; it must be less than 180°, or no arm can stay on one side of the line O₁O₃")
rocker.least_arm_angle = inner(m.sector_stop_sweep / 2), "χ_min", "deg", "Minimum angle of an arm to the left of O₁O₃", "geometry"
rocker.greatest_arm_angle = (inner(pi - m.sector_sweep + m.sector_stop_sweep / 2), "χ_max", "deg", "Maximum angle of an arm to the left of O₁O₃",
    "geometry")
rocker.words("arm_angles_best", arms.angles_at_the_ends, ("center_distance", "arm_length", "sector_dwell_sweep", "sector_sweep"))
for number in "12":
    rocker[f"arm_{number}_lowest"] = (inner(formulas.lowest_direction.of(arm_angle=m[f"arm_angle_{number}"])), f"ψ_min,{number}", "deg",
        f"Direction of arm {number} at the start of phase I", "geometry")
    rocker[f"arm_{number}_highest"] = (inner(formulas.highest_direction.of(lowest=m[f"arm_{number}_lowest"])), f"ψ_max,{number}", "deg",
        f"Direction of arm {number} at the end of phase III", "geometry")
for number in "12":
    rocker.require(f"arm_{number}_side", formulas.stays_on_one_side.of(lowest=m[f"arm_{number}_lowest"], highest=m[f"arm_{number}_highest"]),
        key=f"arm_angle_{number}",
        message=f"is {{arm_angle_{number}}}; the arm would swing from {{arm_{number}_lowest}} to {{arm_{number}_highest}} across {OTHER_ARM}")
rocker.require("arms_on_both_sides", (np.sin(m.arm_1_lowest) * np.sin(m.arm_2_lowest) < 0) | (np.sin(m.arm_1_highest) * np.sin(m.arm_2_highest) < 0),
    key="arm_angle_2", message=f"is {{arm_angle_2}}, which puts both arms (the other at {{arm_angle_1}}) on one side of {OTHER_ARM}")


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


def _profile(chapter: Steps, number: str) -> None:
    """Curves of a cam."""

    def curve(name: str, symbol: str, unit: str, description: str, formula: Formula, *, output: bool = True) -> None:
        taken = {parameter: m[id] for parameter, id in _path(number).items() if parameter in formula.parameters}
        chapter[f"cam_{number}_{name}"] = value(formula.of(**taken), output=output), symbol, unit, f"{description}, cam {number}", "geometry"

    chapter[f"arm_{number}_direction"] = (inner(m[f"arm_angle_{number}"] + m.sector_angle), f"ψ_{number}", "deg", f"Direction of arm {number}",
        "geometry")
    curve("pitch_x", f"x_p{number}", "mm", "Pitch curve x", cam.pitch_x)
    curve("pitch_y", f"y_p{number}", "mm", "Pitch curve y", cam.pitch_y)
    curve("path", f"l_{number}", "mm", "Travel of the roller's centre per radian of the disc", cam.roller_path, output=False)
    curve("x", f"x_{number}", "mm", "Profile x", cam.profile_x)
    curve("y", f"y_{number}", "mm", "Profile y", cam.profile_y)
    curve("pressure_angle", f"δ_{number}", "deg", "Pressure angle", cam.pressure_angle)
    curve("swing_part", f"c_{number}", "1", "Component of the curvature due to the arm's swing", cam.swing_part, output=False)
    curve("curvature", f"κ_{number}", "1/m", "Curvature of the pitch curve", cam.curvature)
    curve("tangent_distance", f"q_{number}", "mm", "Distance of O₁ from the pitch curve's tangent", cam.tangent_distance, output=False)


def _extremes(chapter: Steps, number: str) -> None:
    """What a cam is judged by."""
    chapter[f"cam_{number}_pressure_angle_max"] = (reduction("max", of=f"cam_{number}_pressure_angle"), f"δ_max,{number}", "deg",
        f"Maximum pressure angle of cam {number}", "this method")
    chapter[f"cam_{number}_curvature_greatest"] = (reduction("max", of=f"cam_{number}_curvature", output=False), f"κ_max,{number}", "1/m",
        f"Maximum curvature of pitch curve {number}, convex", "geometry")
    chapter[f"cam_{number}_curvature_least"] = (reduction("min", of=f"cam_{number}_curvature", output=False), f"κ_min,{number}", "1/m",
        f"Minimum curvature of pitch curve {number}, negative where it is concave", "geometry")
    chapter[f"cam_{number}_tangent_min"] = (reduction("min", of=f"cam_{number}_tangent_distance", output=False), f"q_min,{number}", "mm",
        f"Minimum distance of O₁ from the tangents of pitch curve {number}", "geometry")
    chapter[f"cam_{number}_curvature_min"] = (cam.least_radius.of(greatest_curvature=m[f"cam_{number}_curvature_greatest"]), f"ρ_min,{number}", "mm",
        f"Minimum radius of curvature of pitch curve {number} where it is convex", "geometry")
    chapter[f"cam_{number}_profile_radius_min"] = (cam.profile_radius.of(pitch_radius=m[f"cam_{number}_curvature_min"]), f"ρ_c,{number}", "mm",
        f"Minimum radius of profile {number} where it is convex; negative: undercut", "geometry")
    chapter[f"cam_{number}_hollow_radius_min"] = (value(cam.hollow_radius.of(least_curvature=m[f"cam_{number}_curvature_least"]),
        exists=cam.is_hollow.of(least_curvature=m[f"cam_{number}_curvature_least"])), f"ρ_h,{number}", "mm",
        f"Minimum radius of profile {number} where it is concave: upper limit for the grinding wheel", "geometry")


def _cam(number: str) -> Chapter:
    chapter = Chapter(f"Cam {number}",
        text="The pitch curve is the path of the roller's centre; the profile is offset from it by the roller's radius, towards O₁. Curvature is "
            "positive where the pitch curve is convex, its centre of curvature being on the O₁ side: there the profile's radius is ρ − r, and where "
            "ρ < r the profile is undercut. Where the pitch curve is concave the profile's radius is |ρ| + r, whatever the roller.", needs=CAMS,
        absent=NO_CAMS)
    _profile(chapter, number)
    _extremes(chapter, number)
    return chapter


both = Chapter("Both cams",
    text="A roller touches its profile at one point only if, in addition, the tangents of the pitch curve keep more than r from O₁: then profile "
        "and pitch curve go round O₁ without reversing.", needs=CAMS, absent=NO_CAMS)
both.pressure_angle_max = (np.maximum(m.cam_1_pressure_angle_max, m.cam_2_pressure_angle_max), "δ_max", "deg", "Maximum pressure angle of both cams",
    "this method")
both.curvature_min = (np.minimum(m.cam_1_curvature_min, m.cam_2_curvature_min), "ρ_min", "mm",
    "Minimum radius of curvature of both pitch curves where convex", "geometry")
both.tangent_distance_min = (np.minimum(m.cam_1_tangent_min, m.cam_2_tangent_min), "q_min", "mm",
    "Minimum distance of O₁ from the tangents of both pitch curves", "geometry")
both.words("arms_that_fit", arms.arms_that_fit, arms.TAKES, lacks=("module",))
both.words("arms_that_fit", arms.arms_that_fit, (*arms.TAKES, "module"), needs=("module",))


def _loaded(chapter: Steps, number: str) -> None:
    """Force and pressure of a roller."""
    chapter[f"carried_moment_{number}"] = (inner(formulas.carried_moment.of(arm_direction=m[f"arm_{number}_direction"])), f"M_c{number}", "N*m",
        f"Moment of cam {number} about O₃", "statics")
    chapter[f"roller_force_{number}"] = (m[f"carried_moment_{number}"] / (m.arm_length * np.cos(m[f"cam_{number}_pressure_angle"])), f"F_{number}",
        "N", f"Force of cam {number} on its roller", "statics")
    chapter[f"effective_radius_{number}"] = (inner(cam.effective_radius.of(curvature=m[f"cam_{number}_curvature"]), needs=("roller_width",)),
        f"R_e{number}", "mm", f"Effective radius of roller and profile {number}", "Hertz")
    chapter[f"bearing_radius_{number}"] = (inner(np.maximum(m[f"effective_radius_{number}"], m.roller_radius / 1000), needs=("roller_width",)),
        f"R_b{number}", "mm", f"Effective radius, at least a thousandth of the roller's radius (profile {number})", "Hertz")
    chapter[f"contact_pressure_{number}"] = (value(contact.contact_pressure.of(force=m[f"roller_force_{number}"],
        effective_radius=m[f"bearing_radius_{number}"], length=m.roller_width), needs=("roller_width",)), f"p_H{number}", "MPa",
        f"Contact pressure of roller and cam {number}", "Hertz")
    chapter[f"cam_{number}_roller_force_peak"] = (reduction("max", of=f"roller_force_{number}"), f"F_max,{number}", "N",
        f"Maximum force on roller {number}", "statics")
    chapter[f"cam_{number}_contact_pressure_max"] = (reduction("max", of=f"contact_pressure_{number}", needs=("roller_width",)), f"p_H{number},max",
        "MPa", f"Maximum contact pressure of roller and cam {number}", "Hertz")


forces = Chapter("Forces on the rollers",
    text="About O₃ the rocker is in equilibrium under the reaction of the teeth, the sector's inertia and one roller: a cam can only push outwards, "
        "so the cam of the left arm turns the sector clockwise and that of the right arm counter-clockwise. The force acts normal to the profile, "
        "at the pressure angle from the roller's direction of motion. A preload of the rollers is not included.", needs=(*CAMS, *TORQUE),
    absent="not calculated: {missing} not given")
forces.rocker_moment = (inner(m.sector_inertia * m.sector_acceleration - m.tooth_force * m.sector_radius), "M_3", "N*m",
    "Moment of the cams on the rocker about O₃", "statics")
forces.effective_modulus = value(contact.effective_modulus_alike, needs=("roller_width",)), "E*", "GPa", "Effective modulus of the contact", "Hertz"
_loaded(forces, "1")
_loaded(forces, "2")
forces.roller_force_peak = np.maximum(m.cam_1_roller_force_peak, m.cam_2_roller_force_peak), "F_max", "N", "Maximum force on a roller", "statics"
forces.contact_pressure = (value(np.maximum(m.cam_1_contact_pressure_max, m.cam_2_contact_pressure_max), needs=("roller_width",)), "p_H,max", "MPa",
    "Maximum contact pressure of a roller", "Hertz")

SECTIONS = (rocker, _cam("1"), _cam("2"), both, forces)
