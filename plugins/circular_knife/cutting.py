"""Chapters on motion, force and torque over the knife's turn, and the comparison with a guillotine."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Binding, Chapter, Steps, bind, case
from diecut_report.mechanics import circular_segment
from diecut_report.plugins.circular_knife import formulas as f
from diecut_report.plugins.circular_knife.geometry import OWN

# fmt: off

CUTTING = bind(lambda flag: flag == 1, flag="cutting")
INSIDE, OUTSIDE = "the knife is in its cut", "the knife is outside its cut"


def _in_cut(
    name: str, symbol: str, unit: str, description: str, formula: Binding, *, source: str = OWN, output: bool = True
) -> Steps:
    """A curve that is zero outside the cut."""
    steps = Steps()
    steps.choice(name, symbol, unit, description, case(formula, INSIDE, CUTTING), case(lambda: 0, OUTSIDE), source=source, output=output)
    return steps


motion = Chapter("Motion over a revolution of the knife",
    text="The curves cover a full revolution, so that a drive can use them. Outside the cut, cutting point and shear angle stay as they are at its "
        "start; speed, sliding, force and torque are zero. At the cutting point the angle between the edge's normal and the direction of its centre "
        "is φ + τ: hence the speeds of the edge along itself, ω·(R + r·sin(φ + τ)), and normal to itself, ω·r·cos(φ + τ).")
motion.abscissa("knife_angle", "φ", "deg", "Knife angle, one turn", 2 * np.pi, shown_at="torque_max_at", speed="speed")
motion.phase("cutting", "working", "The knife cuts", "knife_angle", ("angle_start", "angle_end"))
motion.phase("free", "window", "The knife is off the board", "knife_angle", rest_of=("cutting",))
motion.value("parting_angle", "φ_s", "deg", "Knife angle that divides the cut for integration: with a flat edge the cut begins steeply",
    lambda angle_start, angle_end, touch_angle: touch_angle + np.sqrt((angle_start - touch_angle) * (angle_end - touch_angle)), source=OWN,
    output=False)
motion.breakpoints("ends_of_cut", "knife_angle", "angle_start", "parting_angle", "angle_end")
motion.value("middle_angle", "φ_m", "deg", "Knife angle in the middle of the cut", lambda angle_start, angle_end: (angle_start + angle_end) / 2,
    source="kinematics", output=False)
motion.choice("cutting", "c", "1", "Knife in its cut (1) or not (0)",
    case(lambda: 1, INSIDE, lambda knife_angle, middle_angle, cut_angle: np.cos(knife_angle - middle_angle) >= np.cos(cut_angle / 2)),
    case(lambda: 0, OUTSIDE), output=False, per_piece=True)
motion.choice("cut_place", "φ_c", "deg", "Knife angle in the cut, or at its start", case(lambda knife_angle: knife_angle, INSIDE, CUTTING),
    case(lambda angle_start: angle_start, OUTSIDE), output=False)
motion.value("cut_position", "x_c", "mm", "Distance of the cutting point from the axis", bind(f.edge_position, angle="cut_place"), source=OWN)
motion.value("shear_angle", "τ", "deg", "Shear angle between edge and counter-knife", bind(f.edge_slope, angle="cut_place"), source=OWN)
motion.add(_in_cut("cut_speed", "v_c", "m/s", "Speed of the cutting point along the counter-knife",
        bind(lambda speed, eccentricity, angle, shear_angle: speed * eccentricity * np.cos(angle + shear_angle) / np.sin(shear_angle),
            angle="cut_place"), source="kinematics"))
motion.add(_in_cut("sliding_ratio", "k", "1", "Sliding ratio: speed of the edge along itself divided by its normal speed",
        bind(f.sliding_ratio, angle="cut_place")))
motion.reduction("cut_speed_max", "v_c,max", "m/s", "Maximum speed of the cutting point", "max", of="cut_speed", source="kinematics")
motion.reduction("sliding_ratio_max", "k_max", "1", "Maximum sliding ratio", "max", of="sliding_ratio", source=OWN)
motion.value("effective_sharpening_angle_min", "δ_e", "deg", "Minimum effective sharpening angle, in the direction of motion",
    lambda sharpening_angle, sliding_ratio_max: np.arctan(np.tan(sharpening_angle) * np.cos(np.arctan(sliding_ratio_max))), source=OWN)

forces = Chapter("Force and torque",
    text="Over the length a of the working front the board is partly cut through; the edge bows out of its chord by the area A_b. Each millimetre "
        "of the edge in the board carries σ times the thickness still to be cut, normal to the edge: σ·h where it enters, nothing where the board "
        "is cut through. Each unit of area cut therefore takes the work σ·h/2. The resultants of these loads are F_w downwards and F_h along the "
        "cut; the loads all point to the edge's centre, and their torque about the shaft is M_u. By virtual work, M_u·dφ is the sum of the loads "
        "times the distances by which they move the edge into the board, and F_w·dy the same if the knife sinks by dy. F_v uses the thickness "
        "already passed instead of that left. For a straight edge both are σ·h²/(2·tan τ); for this edge F_v is greater by 2·σ·A_b. The maximum "
        "force, the ratio to a guillotine and the friction are calculated with F_v, on the safe side; the work of cutting belongs to F_w. Both "
        "areas are integrals over the board's thickness, in closed form by the segment of the edge's arc.")
forces.value("face_angle", "τ_h", "deg", "Slope of the edge in the board's upper face", bind(f.edge_slope, angle="cut_place", depth="face_depth"),
    source=OWN, output=False)
forces.value("front_half_angle", "α", "deg", "Half the angle of the working front", lambda shear_angle, face_angle: (face_angle - shear_angle) / 2,
    source=OWN, output=False)
forces.add(_in_cut("front_length", "a", "mm", "Length of the working front", bind(f.front_length), output=False))
forces.value("bow_area", "A_b", "mm**2", "Area between the working front and its chord",
    bind(circular_segment.area, radius="edge_radius", half_angle="front_half_angle"), source=OWN, output=False)
forces.add(_in_cut("force", "F_v", "N", "Downward force on the board", bind(f.force), source=OWN))
forces.add(_in_cut("working_force", "F_w", "N", "Downward force by virtual work",
        bind(lambda shear_resistance, thickness, front_length, bow_area: shear_resistance * (thickness * front_length / 2 - bow_area)),
        source="energy", output=False))
forces.value("thrust", "F_h", "N", "Force along the cut by virtual work", lambda shear_resistance, thickness: shear_resistance * thickness**2 / 2,
    source="energy")
forces.add(_in_cut("useful_torque", "M_u", "N*m", "Torque of cutting",
        bind(lambda eccentricity, working_force, thrust, angle: eccentricity * (working_force * np.cos(angle) - thrust * np.sin(angle)),
            angle="cut_place"), source="statics", output=False))
forces.add(_in_cut("friction_torque", "M_f", "N*m", "Torque of friction", bind(f.friction_torque, angle="cut_place"), source=OWN))
forces.value("torque", "M", "N*m", "Torque at the knife's shaft", lambda useful_torque, friction_torque: useful_torque + friction_torque,
    source="statics")
forces.reduction("front_length_max", "a_max", "mm", "Maximum length of the working front", "max", of="front_length", source=OWN)
forces.reduction("force_max", "F_max", "N", "Maximum downward force on the board", "max", of="force", source=OWN)
forces.reduction("working_force_max", "F_w,max", "N", "Maximum downward force by virtual work", "max", of="working_force", source="energy")
forces.reduction("torque_max", "M_max", "N*m", "Maximum torque at the knife's shaft", "max", of="torque", source="statics")
forces.reduction("useful_work", "W_u", "J", "Work of cutting, from φ_1 to φ_2", "integral", of="useful_torque", source="energy")
forces.reduction("work", "W", "J", "Work of a cut, with friction", "integral", of="torque", source="energy")
forces.value("power_mean", "P_mean", "W", "Mean power over a revolution with one cut", lambda work, speed: work * speed / (2 * np.pi),
    source="energy")
forces.value("power_peak", "P_max", "W", "Maximum power", lambda torque_max, speed: torque_max * speed, source="energy")

guillotine = Chapter("Comparison with a guillotine",
    text="A straight blade parallel to the counter-knife cuts the same length at once. Its work differs slightly from the work of cutting W_u: at "
        "φ_1 part of the board is already cut into, and at φ_2 the edge has cut into it beyond the end.")
guillotine.value("guillotine_force", "F_g", "N", "Force of a guillotine for the same length of cut",
    lambda shear_resistance, thickness, cut_length: shear_resistance * thickness * cut_length, source=OWN)
guillotine.value("guillotine_work", "W_g", "J", "Its work, without friction", lambda guillotine_force, thickness: guillotine_force * thickness / 2,
    source="energy")
guillotine.value("guillotine_force_ratio", "q_F", "1", "Ratio of the maximum force to that of a guillotine",
    lambda force_max, guillotine_force: force_max / guillotine_force, source=OWN)
guillotine.value("guillotine_line_force", "q_σ", "N/mm", "Force of a straight cut per length, by the shear resistance",
    lambda shear_resistance, thickness: shear_resistance * thickness, source=OWN)
guillotine.value("resistance_by_rule", "σ_q", "N/mm**2", "Shear resistance corresponding to the force of the rule",
    lambda rule_force, thickness: rule_force / thickness, source=OWN, needs=("rule_force",))
