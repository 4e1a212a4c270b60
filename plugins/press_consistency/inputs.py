"""Inputs of the consistency of the press: all are taken from the mechanisms that they name, or given here."""

from __future__ import annotations

from typing import Any, Literal

from diecut_report.api import POINTS, Annotated, CurveInput, FromPress, Inputs, MechanismInput, Quantity, Text

# fmt: off


class PressConsistency(Inputs):
    """Keys of ``press_consistency``; each is optional, and a check is made where all that it needs is there."""

    productivity: Annotated[float | None,
        Quantity("n", "1/h", "Productivity of the press", gt=0, press=FromPress("press.productivity", optional=True))] = None
    sheet_length: Annotated[float | None,
        Quantity("L_s", "mm", "Length of the sheet", gt=0, press=FromPress("press.sheet.length", optional=True))] = None
    sheet_width: Annotated[float | None,
        Quantity("B_s", "mm", "Width of the sheet", gt=0, press=FromPress("press.sheet.width", optional=True))] = None
    feed_side: Annotated[Literal["width", "length"], Text("Side of the sheet in the direction of feed")] = "width"
    sheet_gap: Annotated[float | None, Quantity("g_s", "mm", "Space required between two sheets in the feed, for grippers and carriage", ge=0)] = None

    cylinder: Annotated[Any | None, MechanismInput("Mechanism that is the cylinder; default: the only cylinder_sizing")] = None
    drive: Annotated[Any | None, MechanismInput("Mechanism that drives it; default: the only cylinder_drive")] = None
    transport: Annotated[str | None, Text("Mechanism that moves the sheet; default: the only cam_gear_transport or geneva_transport")] = None
    conveyor: Annotated[str | None, Text("Mechanism that provides the conveyor's mass; default: the only cam_gear_transport")] = None
    chain: Annotated[str | None, Text("Chain that carries the gripper bars; default: the only roller_chain that moves no cylinder")] = None
    wheel: Annotated[Any | None, MechanismInput("Mechanism that provides the wheel's inertia; default: the only geneva_transport")] = None
    train: Annotated[str | None, Text("Mechanism that drives the main shaft; default: the only drive_train")] = None
    clutch: Annotated[str | None, Text("Clutch before the cylinder drive's crank; default: the only clutch")] = None
    timing: Annotated[Any | None, MechanismInput("Cyclogram of the press; default: the only cyclogram")] = None
    damper: Annotated[Any | None, MechanismInput("Dampers at the ends of the travel; default: the only damper")] = None
    drive_line: Annotated[str | None, Text("Drive line that provides the brakes' torque; default: that of the machine's parts")] = None

    timing_slack: Annotated[float | None,
        Quantity("g_min", "deg", "Minimum slack of all interlocks on the main shaft; negative where one fails")] = None
    working_length: Annotated[float | None, Quantity("l_1", "mm", "Length that the cylinder unrolls while it cuts", gt=0)] = None
    generatrix_length: Annotated[float | None, Quantity("L", "mm", "Length of the cylinder's generatrix", gt=0)] = None

    sheet_step: Annotated[float | None, Quantity("S", "mm", "Step of the sheet transport", gt=0)] = None
    chain_pitch: Annotated[float | None, Quantity("p", "mm", "Pitch of the transport's chain", gt=0)] = None
    sprocket_teeth: Annotated[int | None, Quantity("z_s", "1", "Number of teeth of the transport's sprocket", ge=3, integer=True)] = None
    sheet_play: Annotated[float | None, Quantity("Δx", "mm", "Displacement of the sheet during its rest", ge=0)] = None
    cover_angle: Annotated[float | None,
        Quantity("φ_h", "deg", "Crank angle from the wheel's exit, and to its entry, for which its play is calculated", gt=0, lt=180)] = None
    backlash: Annotated[float, Quantity("Δx_b", "mm", "Additional plays between transport and cylinder, at the sheet", ge=0)] = 0
    register_tolerance: Annotated[float | None, Quantity("[Δx]", "mm", "Allowable error of the position of the cut on the sheet", gt=0)] = None
    conveyor_mass: Annotated[float | None, Quantity("m_c", "kg", "Mass of the conveyor: chains, gripper bars and sheets", gt=0)] = None
    chain_mass: Annotated[float | None,
        Quantity("m_h", "kg", "Mass accelerated by the gripper chain: its own, bars, sheets, and rotating parts", gt=0)] = None
    chain_links: Annotated[int | None, Quantity("X", "1", "Number of links of the gripper chain", gt=0, integer=True)] = None
    wheel_inertia: Annotated[float | None,
        Quantity("J_w", "kg*m**2", "Moment of inertia used in the Geneva wheel's calculation, at its shaft", gt=0)] = None
    wheel_side_inertia: Annotated[float | None,
        Quantity("J_x", "kg*m**2",
            "Moment of inertia of everything that turns with the wheel in addition to the conveyor, at its shaft: the wheel, its shaft, "
                "gears, and the sprocket shaft by the square of its ratio", gt=0)] = None
    travel_radius: Annotated[float | None, Quantity("r_c", "mm", "Conveyor displacement per radian of the wheel", gt=0)] = None

    crank_speed: Annotated[float | None, Quantity("ω_1", "rpm", "Speed of the cylinder drive's crank", gt=0)] = None
    output_speed: Annotated[float | None, Quantity("ω_o", "rpm", "Actual output speed of the drive train", gt=0)] = None
    loaded_output_speed: Annotated[float | None, Quantity("ω_oL", "rpm", "Output speed under the mean torque", gt=0)] = None
    required_rate: Annotated[float | None,
        Quantity("n_req", "1/h", "Required sheets per hour of the press; default: the productivity used in all calculations", gt=0)] = None
    output_turns_per_sheet: Annotated[float | None,
        Quantity("i", "1", "Revolutions of that output per sheet; default: those of the cylinder drive's crank", gt=0)] = None

    cylinder_mass: Annotated[float | None, Quantity("m", "kg", "Mass of the cylinder", gt=0)] = None
    cylinder_inertia: Annotated[float | None, Quantity("I", "kg*m**2", "Moment of inertia of the cylinder about its axis", gt=0)] = None
    cylinder_radius: Annotated[float | None, Quantity("R", "mm", "Radius of the cylinder", gt=0)] = None
    static_unbalance: Annotated[float, Quantity("me", "kg*m", "Static unbalance of the cylinder", ge=0)] = 0
    shafts_inertia: Annotated[float,
        Quantity("I_s", "kg*m**2", "Moment of inertia of the shafts of pinion and rocker with their parts, at the cylinder", ge=0)] = 0
    cylinder_rotation: Annotated[Any | None, CurveInput("θ", "deg", "Rotation of the cylinder over a revolution of its crank", referred=True)] = None
    cylinder_speed: Annotated[Any | None, CurveInput("ω_z", "rad/s", "Speed of the cylinder over a revolution of its crank", referred=True)] = None
    displacement: Annotated[Any | None,
        CurveInput("x_z", "mm", "Displacement of the cylinder's axis over a revolution of its crank", referred=True)] = None
    velocity: Annotated[Any | None, CurveInput("v_z", "m/s", "Velocity of the cylinder's axis over a revolution of its crank", referred=True)] = None
    stroke: Annotated[float | None, Quantity("S_max", "mm", "Stroke of the cylinder's axis", gt=0)] = None
    dead_center_outer: Annotated[float | None, Quantity("φ_out", "deg", "Crank angle of the outer dead centre", ge=0, le=360)] = None
    dead_center_inner: Annotated[float | None, Quantity("φ_in", "deg", "Crank angle of the inner dead centre", ge=0, le=720)] = None

    clutch_torque: Annotated[float | None, Quantity("M_c", "N*m", "Torque of the slipping clutch, on its own shaft", gt=0)] = None
    clutch_load: Annotated[float, Quantity("M_l", "N*m", "Load torque of the driven side during slip", ge=0)] = 0
    clutch_speed: Annotated[float | None, Quantity("ω_c", "rpm", "Speed of the clutch's driving side", gt=0)] = None
    clutch_turns: Annotated[float | None,
        Quantity("i_ct", "1", "Revolutions of the clutch per revolution of the crank; default: by its speed", gt=0)] = None
    clutch_inertia: Annotated[float | None, Quantity("J_c", "kg*m**2", "Moment of inertia used in the clutch's calculation", gt=0)] = None
    clutch_drives: Annotated[list[str], Text("Lines of the cyclogram that the clutch couples, by name")] = []  # noqa: RUF012
    single_position: Annotated[bool, Text("Clutch engages at one angle only")] = False
    engagement_angle: Annotated[float | None,
        Quantity("φ_e", "deg", "Crank angle at which the clutch engages; default: the worst case", ge=0, lt=360)] = None

    brake_torque: Annotated[float | None, Quantity("M_b", "N*m", "Torque of the brake at the main shaft", gt=0)] = None
    shaft_torque_mean: Annotated[float | None, Quantity("M_mean", "N*m", "Mean torque of all lines at the main shaft")] = None
    lines_energy: Annotated[float | None, Quantity("E_k", "J", "Mean kinetic energy of all lines over the common period", ge=0)] = None

    damper_velocity: Annotated[float | None, Quantity("v_d", "m/s", "Speed at contact used in the dampers' calculation", gt=0)] = None
    contact_distance: Annotated[float | None,
        Quantity("d_c", "mm", "Distance before the ends of the travel at which the dampers are met; 0: only beyond them", ge=0)] = None
    damper_mass: Annotated[float | None, Quantity("m_d", "kg", "Mass of the cylinder used in the dampers' calculation", gt=0)] = None
    carriage_mass: Annotated[float | None,
        Quantity("m_car", "kg", "Mass of the carriages, which move with the cylinder's axis, used in the dampers' calculation", ge=0)] = None
    damper_impacts: Annotated[float | None, Quantity("z_d", "1/h", "Impacts at one end of the travel used in the dampers' calculation", gt=0)] = None

    flywheel_torque: Annotated[Any | None,
        CurveInput("M_f", "N*m", "Load at the flywheel's shaft over the revolutions after which it repeats", referred=True)] = None
    load_turns: Annotated[int, Quantity("k_T", "1", "Revolutions of the drive train's output spanned by this load", ge=1, le=64, integer=True)] = 1
    flywheel_inertia: Annotated[float | None, Quantity("J", "kg*m**2", "Moment of inertia of the flywheel", gt=0)] = None
    shafts_energy: Annotated[float,
        Quantity("E_s", "J", "Kinetic energy of the motor's rotor and of the shafts that turn steadily, beside the flywheel", ge=0)] = 0
    flywheel_speed: Annotated[float | None, Quantity("ω_f", "rpm", "Speed of the flywheel", gt=0)] = None
    belt_ratio: Annotated[float | None, Quantity("i_b", "1", "Ratio from the motor to the flywheel", gt=0)] = None
    belt_efficiency: Annotated[float, Quantity("η_b", "1", "Efficiency from the motor to the flywheel", gt=0, le=1)] = 1
    motor_rated_torque: Annotated[float | None, Quantity("M_r", "N*m", "Rated torque of the motor", gt=0)] = None
    motor_speed: Annotated[float | None, Quantity("n_m", "rpm", "Rated speed of the motor", gt=0)] = None
    synchronous_speed: Annotated[float | None, Quantity("n_s", "rpm", "Synchronous speed of the motor", gt=0)] = None
    breakdown_ratio: Annotated[float | None, Quantity("k_b", "1", "Ratio of breakdown torque to rated torque of the motor", ge=1)] = None
    speed_fluctuation: Annotated[float | None, Quantity("δ", "1", "Acceptable speed fluctuation of the flywheel", gt=0, lt=1)] = None
    n_points: Annotated[int, POINTS] = 720
