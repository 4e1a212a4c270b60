"""Chapters on what the chain pulls: tension, torque, grip of the sheet, stations, motor."""

from __future__ import annotations

import numpy as np

from diecut_report.api import GRAVITY, Chapter, inner, m, pick, reduction, self_test, standard_series, total

# fmt: off

loads = Chapter(
    "Loads", text="Each chain carries half of everything that both move. On the upper strand a sheet hangs at each bar."
)
loads.sheet_mass = m.grammage * m.sheet_length * m.sheet_width, "m_s", "g", "Mass of a sheet"
loads.strand_mass = (m.line_mass * m.centre_distance + m.sheet_mass * m.centre_distance / (2 * m.bar_spacing),
    "m_t", "kg", "Mass of the upper strand of one chain, with bars and sheets")
loads.drag_total = total("sum", of="stations.drag"), "D", "N", "Total drag of the stations, with a sheet at each"
loads.drag_greatest = total("max", of="stations.drag"), "D_max", "N", "Maximum drag of a station"
loads.rail_drag = m.rail_friction * m.strand_mass * GRAVITY, "F_r", "N", "Friction of a chain in its rails", "Coulomb"
loads.useful_tension = m.drag_total / 2 + m.rail_drag, "F_u", "N", "Useful pull of a chain"
loads.centrifugal_tension = m.line_mass * m.chain_speed**2, "F_c", "N", "Centrifugal pull of a chain", "Roloff/Matek"

pull = Chapter(
    "Pull and torque over a tooth",
    text="The upper strand is assumed rigid: it follows the polygon as a whole. The slack strand yields and follows no polygon.",
)
pull.tension = (m.slack_tension + m.centrifugal_tension + m.useful_tension + m.strand_mass * m.acceleration,
    "F_θ", "N", "Pull of the upper strand at the driving sprocket", "dynamics")
pull.tension_max = reduction("max", of="tension"), "F_max", "N", "Maximum pull"
pull.polygon_tension = inner(m.strand_mass * m.acceleration_max), "F_a", "N", "Contribution of the polygon effect"
net = m.tension - m.slack_tension - m.centrifugal_tension
pull.torque = (2 * net * m.pitch_radius * np.cos(m.sprocket_angle - m.half_tooth),
    "M_θ", "N*m", "Torque of the driving shaft, of both chains", "statics")
pull.torque_max = reduction("max", of="torque"), "M_max", "N*m", "Maximum torque"
pull.torque_work = reduction("integral", of="torque"), "W", "J", "Work of the torque over a tooth"
pull.work_needed = inner(2 * m.useful_tension * m.pitch), "W_u", "J", "Work of the useful pull over a pitch", "energy"
pull.work_error = (self_test(m.torque_work, m.work_needed, scale=2 * m.tension_max * m.pitch, check="work", title="Work balance of the torque"),
    "e_W", "1", "Difference of the two, relative to the work of the maximum pull", "energy")
pull.power = 2 * m.useful_tension * m.chain_speed, "P", "W", "Mean power"

strength = Chapter("Strength of the chain")
strength.safety = m.breaking_load / m.tension_max, "S", "1", "Safety factor against breaking"
strength.breaking_load_needed = (inner(m.required_safety * m.tension_max),
    "F_B,min", "kN", "Breaking load required by this safety factor")
strength.joint_pressure = m.tension_max / m.joint_area, "p_j", "MPa", "Pressure of the joints", "Roloff/Matek"

grip = Chapter(
    "Grip of the sheet", text="A sheet is held by friction on both its faces. It passes one station at a time."
)
grip.sheet_force = (m.sheet_mass * m.acceleration_max + m.drag_greatest,
    "F_b", "N", "Force transmitted from a bar to its sheet")
grip.grip_total = (2 * m.grip_friction * m.grippers * m.grip_force,
    "F_h", "N", "Holding force of the grippers of a bar", "Coulomb")
grip.grip_force_needed = (inner(m.sheet_force / (2 * m.grip_friction * m.grippers)),
    "F_g,min", "N", "Clamping force per gripper required to hold the sheet")

motor = Chapter("Motor", needs=("efficiency",), absent="not selected: efficiency is not given")
motor.motor_load = m.power / m.efficiency, "P_l", "W", "Power at the motor"
motor.motor_power = (pick("above", of="motor_load", series=standard_series("iec_60072_ratings")),
    "P_m", "kW", "Rated power of the motor", "IEC 60072")
