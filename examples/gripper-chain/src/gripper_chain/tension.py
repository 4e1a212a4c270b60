"""Chapters on what the chain pulls: tension, torque, grip of the sheet, stations, motor."""

from __future__ import annotations

import numpy as np

from diecut_report.api import GRAVITY, Chapter, standard_series

loads = Chapter(
    "Loads", text="Each chain carries half of everything that both move. On the upper strand a sheet hangs at each bar."
)
loads.value(
    "sheet_mass",
    "m_s",
    "g",
    "Mass of a sheet",
    lambda grammage, sheet_length, sheet_width: grammage * sheet_length * sheet_width,
)
loads.value(
    "strand_mass",
    "m_t",
    "kg",
    "Mass of the upper strand of one chain, with bars and sheets",
    lambda line_mass, centre_distance, sheet_mass, bar_spacing: (
        line_mass * centre_distance + sheet_mass * centre_distance / (2 * bar_spacing)
    ),
)
loads.total("drag_total", "D", "N", "Total drag of the stations, with a sheet at each", "sum", of="stations.drag")
loads.total("drag_greatest", "D_max", "N", "Maximum drag of a station", "max", of="stations.drag")
loads.value(
    "rail_drag",
    "F_r",
    "N",
    "Friction of a chain in its rails",
    lambda rail_friction, strand_mass: rail_friction * strand_mass * GRAVITY,
    source="Coulomb",
)
loads.value(
    "useful_tension",
    "F_u",
    "N",
    "Useful pull of a chain",
    lambda drag_total, rail_drag: drag_total / 2 + rail_drag,
)
loads.value(
    "centrifugal_tension",
    "F_c",
    "N",
    "Centrifugal pull of a chain",
    lambda line_mass, chain_speed: line_mass * chain_speed**2,
    source="Roloff/Matek",
)

pull = Chapter(
    "Pull and torque over a tooth",
    text="The upper strand is assumed rigid: it follows the polygon as a whole. The slack strand yields and follows no polygon.",
)
pull.value(
    "tension",
    "F_θ",
    "N",
    "Pull of the upper strand at the driving sprocket",
    lambda slack_tension, centrifugal_tension, useful_tension, strand_mass, acceleration: (
        slack_tension + centrifugal_tension + useful_tension + strand_mass * acceleration
    ),
    source="dynamics",
)
pull.reduction("tension_max", "F_max", "N", "Maximum pull", "max", of="tension")
pull.value(
    "polygon_tension",
    "F_a",
    "N",
    "Contribution of the polygon effect",
    lambda strand_mass, acceleration_max: strand_mass * acceleration_max,
    output=False,
)
pull.value(
    "torque",
    "M_θ",
    "N*m",
    "Torque of the driving shaft, of both chains",
    lambda tension, slack_tension, centrifugal_tension, pitch_radius, sprocket_angle, half_tooth: (
        2 * (tension - slack_tension - centrifugal_tension) * pitch_radius * np.cos(sprocket_angle - half_tooth)
    ),
    source="statics",
)
pull.reduction("torque_max", "M_max", "N*m", "Maximum torque", "max", of="torque")
pull.reduction("torque_work", "W", "J", "Work of the torque over a tooth", "integral", of="torque")
pull.value(
    "work_needed",
    "W_u",
    "J",
    "Work of the useful pull over a pitch",
    lambda useful_tension, pitch: 2 * useful_tension * pitch,
    source="energy",
    output=False,
)
pull.value(
    "work_error",
    "e_W",
    "1",
    "Difference of the two, relative to the work of the maximum pull",
    lambda torque_work, work_needed, tension_max, pitch: abs(torque_work - work_needed) / (2 * tension_max * pitch),
    output=False,
)
pull.value("power", "P", "W", "Mean power", lambda useful_tension, chain_speed: 2 * useful_tension * chain_speed)

strength = Chapter("Strength of the chain")
strength.value(
    "safety", "S", "1", "Safety factor against breaking", lambda breaking_load, tension_max: breaking_load / tension_max
)
strength.value(
    "breaking_load_needed",
    "F_B,min",
    "kN",
    "Breaking load required by this safety factor",
    lambda required_safety, tension_max: required_safety * tension_max,
    output=False,
)
strength.value(
    "joint_pressure",
    "p_j",
    "MPa",
    "Pressure of the joints",
    lambda tension_max, joint_area: tension_max / joint_area,
    source="Roloff/Matek",
)

grip = Chapter(
    "Grip of the sheet", text="A sheet is held by friction on both its faces. It passes one station at a time."
)
grip.value(
    "sheet_force",
    "F_b",
    "N",
    "Force transmitted from a bar to its sheet",
    lambda sheet_mass, acceleration_max, drag_greatest: sheet_mass * acceleration_max + drag_greatest,
)
grip.value(
    "grip_total",
    "F_h",
    "N",
    "Holding force of the grippers of a bar",
    lambda grip_friction, grippers, grip_force: 2 * grip_friction * grippers * grip_force,
    source="Coulomb",
)
grip.value(
    "grip_force_needed",
    "F_g,min",
    "N",
    "Clamping force per gripper required to hold the sheet",
    lambda sheet_force, grip_friction, grippers: sheet_force / (2 * grip_friction * grippers),
    output=False,
)


motor = Chapter("Motor", needs=("efficiency",), absent="not selected: efficiency is not given")
motor.value("motor_load", "P_l", "W", "Power at the motor", lambda power, efficiency: power / efficiency)
motor.pick(
    "motor_power",
    "P_m",
    "kW",
    "Rated power of the motor",
    "above",
    of="motor_load",
    series=standard_series("iec_60072_ratings"),
    source="IEC 60072",
)
