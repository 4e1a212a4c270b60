"""Chapters on the motion of the sheet and the torque that it takes."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter
from diecut_report.mechanics import contact
from diecut_report.plugins.cam_gear_transport import formulas, loads
from diecut_report.plugins.cam_gear_transport.inputs import GRIPPED, SHEET, TORQUE

# fmt: off

conveyor = Chapter("Motion of the sheet", text="The gear drives the conveyor's sprocket; one cycle makes one step.", needs=SHEET,
    absent="not calculated: {missing} not given")
conveyor.value("sheet_step", "S", "mm", "Step of the conveyor per cycle", formulas.sheet_step, source="this method")
conveyor.value("sheet_position", "x", "mm", "Position of the sheet from its dwell position",
    lambda gear_angle, sheet_step: sheet_step * gear_angle / (2 * np.pi), source="kinematics")
conveyor.value("sheet_velocity", "V", "m/s", "Velocity of the sheet",
    lambda gear_speed, sheet_step, cycles_per_hour: sheet_step * cycles_per_hour * gear_speed / (2 * np.pi), source="kinematics")
conveyor.value("sheet_acceleration", "a_s", "m/s**2", "Acceleration of the sheet",
    lambda gear_acceleration, sheet_step: sheet_step * gear_acceleration / (2 * np.pi), source="kinematics")
conveyor.reduction("sheet_velocity_max", "V_max", "m/s", "Maximum velocity of the sheet", "abs_max", of="sheet_velocity", source="kinematics")
conveyor.reduction("sheet_acceleration_max", "a_s,max", "m/s**2", "Maximum acceleration of the sheet", "abs_max", of="sheet_acceleration",
    source="kinematics")

grippers = Chapter("Holding force of the grippers",
    text="The grippers must hold the sheet against its own inertia; air resistance and the friction of the surface on which it slides are neglected.",
    needs=GRIPPED, absent="not calculated: {missing} not given")
grippers.value("sheet_mass", "m_s", "g", "Mass of the sheet", contact.sheet_mass, source="geometry")
grippers.value("sheet_force", "F_g", "N", "Maximum force of the sheet on its grippers", contact.sheet_force, source="mechanics")
rest = Chapter("Rest of the sheet within a tolerance",
    text="The sheet is at rest while it is within e of its dwell position: before and after the dwell, as long as the product of both distances "
        "beyond e is negative.", needs=(*SHEET, "rest_tolerance"), absent="not calculated: {missing} not given")
rest.require("tolerance_below_step", lambda rest_tolerance, sheet_step: 2 * rest_tolerance < sheet_step, key="rest_tolerance",
    message="is {rest_tolerance}, but must be less than half the step {sheet_step}")
rest.value("rest_excess", "Π_e", "mm**2", "Product of the distances beyond the tolerance from the last and from the next rest position",
    lambda sheet_position, sheet_step, rest_tolerance: (sheet_position - rest_tolerance) * (sheet_step - rest_tolerance - sheet_position),
    output=False)
rest.crossings("rest_edge", "φ_e", "deg", "Disc angle at which the sheet leaves its rest, and at which it comes to rest again", of="rest_excess")
rest.phase("rest", "rest", "Rest of the sheet within the tolerance", "disc_angle", ("rest_edge_2", "rest_edge_1"))

torques = Chapter("Torque",
    text="Losses are neglected: only the conveyor's mass is moved, and the sector with its rocker where their inertia is given. The fixed cams do "
        "no work, since the rollers move along them; the disc therefore supplies the power of gear and sector.", needs=TORQUE,
    absent="not calculated: {missing} not given")
torques.value("gear_torque", "M_1", "N*m", "Torque at the gear's shaft", loads.gear_torque, source="statics")
torques.value("tooth_force", "F_t", "N", "Tangential force between the teeth of sector and gear", loads.tooth_force, source="statics")
torques.value("drive_torque", "M_2", "N*m", "Torque at the disc's shaft",
    lambda gear_torque, gear_speed, sector_inertia, sector_acceleration, rocker_turn:
        gear_torque * gear_speed / (2 * np.pi) + sector_inertia * sector_acceleration * rocker_turn, source="energy")
torques.reduction("gear_torque_peak", "M_1,max", "N*m", "Maximum torque at the gear's shaft", "abs_max", of="gear_torque", source="statics")
torques.reduction("tooth_force_peak", "F_t,max", "N", "Maximum tangential force between the teeth", "abs_max", of="tooth_force", source="statics")
torques.reduction("torque_peak", "M_peak", "N*m", "Maximum torque at the disc's shaft, driving or driven", "abs_max", of="drive_torque",
    source="energy")
torques.reduction("torque_rms", "M_rms", "N*m", "Root mean square torque at the disc's shaft", "rms", of="drive_torque", source="energy")
torques.reduction("energy_turn", "E_Σ", "J", "Work of the disc's torque per revolution", "integral", of="drive_torque", source="energy", output=False)
torques.value("kinetic_energy_max", "E_k", "J", "Maximum kinetic energy of the conveyor",
    lambda conveyor_mass, sheet_velocity_max: conveyor_mass * sheet_velocity_max ** 2 / 2, source="energy")
torques.value("energy_residual", "r_E", "1", "Ratio of the work per revolution to the maximum kinetic energy",
    lambda energy_turn, kinetic_energy_max: abs(energy_turn) / kinetic_energy_max, source="energy", output=False)
