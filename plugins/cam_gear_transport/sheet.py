"""Chapters on the motion of the sheet and the torque that it takes."""

from __future__ import annotations

from diecut_report.api import Chapter, Reduction, Value, Words, bind
from diecut_report.mechanics import common
from diecut_report.plugins.cam_gear_transport import advice, formulas, loads
from diecut_report.plugins.cam_gear_transport.inputs import SHEET, TORQUE

CONVEYOR = Chapter(
    "Motion of the sheet",
    needs=SHEET,
    absent="not calculated: sprocket_teeth and chain_pitch are not both given",
    text="The gear drives the conveyor's sprocket; one cycle makes one step.",
    steps=(
        Value(id="sheet_step", symbol="S", unit="mm", description="Step of the conveyor in a cycle", source="this method",
              formula=formulas.sheet_step),
        Value(id="sheet_position", symbol="x", unit="mm", description="Position of the sheet from its dwell", source="kinematics",
              formula=bind(formulas.travel, angle="gear_angle")),
        Value(id="sheet_velocity", symbol="V", unit="m/s", description="Velocity of the sheet", source="kinematics",
              formula=formulas.sheet_velocity),
        Value(id="sheet_acceleration", symbol="W", unit="m/s**2", description="Acceleration of the sheet", source="kinematics",
              formula=bind(formulas.travel, angle="gear_acceleration")),
        Reduction(id="sheet_velocity_max", symbol="V_max", unit="m/s", description="Greatest velocity of the sheet", source="kinematics",
                  of="sheet_velocity", operation="abs_max"),
        Reduction(id="sheet_acceleration_max", symbol="W_max", unit="m/s**2", description="Greatest acceleration of the sheet",
                  source="kinematics", of="sheet_acceleration", operation="abs_max"),
        Words(id="sheet_gentler", function=advice.gentler_sheet, needs=("allowable_sheet_acceleration",),
              takes=("sheet_acceleration_max", "allowable_sheet_acceleration", "time_dwell", "sector_dwell_sweep", "sector_stop_sweep",
                     "law_peak_velocity", "min_return_time", "cycles_per_hour")),
    ),
)  # fmt: skip

TORQUES = Chapter(
    "Torque",
    needs=TORQUE,
    absent="not calculated: sprocket_teeth, chain_pitch and conveyor_mass are not all given",
    text="Without losses: the conveyor's mass alone is moved, and the sector with its rocker where their inertia is given. The fixed cams "
    "do no work, for the rollers move along them; so the disc gives the power that gear and sector take.",
    steps=(
        Value(id="gear_torque", symbol="M_1", unit="N*m", description="Torque at the gear's shaft", source="statics",
              formula=loads.gear_torque),
        Value(id="tooth_force", symbol="F_t", unit="N", description="Tangential force between the teeth of sector and gear", source="statics",
              formula=loads.tooth_force),
        Value(id="drive_torque", symbol="M_2", unit="N*m", description="Torque at the disc's shaft", source="energy",
              formula=loads.drive_torque),
        Reduction(id="gear_torque_peak", symbol="M_1,max", unit="N*m", description="Greatest torque at the gear's shaft", source="statics",
                  of="gear_torque", operation="abs_max"),
        Reduction(id="tooth_force_peak", symbol="F_t,max", unit="N", description="Greatest tangential force between the teeth",
                  source="statics", of="tooth_force", operation="abs_max"),
        Reduction(id="torque_peak", symbol="M_peak", unit="N*m", description="Greatest torque at the disc's shaft, driving or driven",
                  source="energy", of="drive_torque", operation="abs_max"),
        Reduction(id="torque_rms", symbol="M_rms", unit="N*m", description="Root mean square torque at the disc's shaft", source="energy",
                  of="drive_torque", operation="rms"),
        Reduction(id="energy_turn", symbol="E_Σ", unit="J", description="Work of the disc's torque over a turn", source="energy", output=False,
                  of="drive_torque", operation="integral"),
        Value(id="kinetic_energy_max", symbol="E_k", unit="J", description="Greatest kinetic energy of the conveyor", source="energy",
              formula=bind(loads.kinetic_energy, velocity="sheet_velocity_max")),
        Value(id="energy_residual", symbol="r_E", description="Work over a turn to the greatest kinetic energy", source="energy", output=False,
              formula=bind(common.relative_size, quantity="energy_turn", scale="kinetic_energy_max")),
    ),
)  # fmt: skip
