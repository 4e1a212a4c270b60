"""Inputs of the consistency of the press: all are taken from the mechanisms that they name, or given here."""

from __future__ import annotations

from diecut_report.api import CurveInput, FromPress, Inputs, MechanismInput, Quantity, Text, samples

# fmt: off


class PressConsistency(Inputs):
    """Keys of ``press_consistency``; each is optional, and a check is made where all that it needs is there."""

    productivity = Quantity("n", "1/h", "Productivity of the press", gt=0, press=FromPress("press.productivity", optional=True))
    sheet_length = Quantity("L_s", "mm", "Length of the sheet", gt=0, press=FromPress("press.sheet.length", optional=True))
    sheet_width = Quantity("B_s", "mm", "Width of the sheet", gt=0, press=FromPress("press.sheet.width", optional=True))
    feed_side = Text("Side of the sheet in the direction of feed", ("width", "length"), default="width")
    sheet_gap = Quantity("g_s", "mm", "Space required between two sheets in the feed, for grippers and carriage", ge=0, optional=True)

    cylinder = MechanismInput("Mechanism that is the cylinder; default: the only cylinder_sizing", optional=True)
    drive = MechanismInput("Mechanism that drives it; default: the only cylinder_drive", optional=True)
    transport = Text("Mechanism that moves the sheet; default: the only cam_gear_transport or geneva_transport", optional=True)
    conveyor = Text("Mechanism that provides the conveyor's mass; default: the only cam_gear_transport", optional=True)
    chain = Text("Chain that carries the gripper bars; default: the only roller_chain that moves no cylinder", optional=True)
    wheel = MechanismInput("Mechanism that provides the wheel's inertia; default: the only geneva_transport", optional=True)
    train = Text("Mechanism that drives the main shaft; default: the only drive_train", optional=True)
    clutch = Text("Clutch before the cylinder drive's crank; default: the only clutch", optional=True)
    timing = MechanismInput("Cyclogram of the press; default: the only cyclogram", optional=True)
    damper = MechanismInput("Dampers at the ends of the travel; default: the only damper", optional=True)
    drive_line = Text("Drive line that provides the brakes' torque; default: that of the machine's parts", optional=True)

    timing_slack = Quantity("g_min", "deg", "Minimum slack of all interlocks on the main shaft; negative where one fails", optional=True)
    working_length = Quantity("l_1", "mm", "Length that the cylinder unrolls while it cuts", gt=0, optional=True)
    generatrix_length = Quantity("L", "mm", "Length of the cylinder's generatrix", gt=0, optional=True)

    sheet_step = Quantity("S", "mm", "Step of the sheet transport", gt=0, optional=True)
    chain_pitch = Quantity("p", "mm", "Pitch of the transport's chain", gt=0, optional=True)
    sprocket_teeth = Quantity("z_s", "1", "Number of teeth of the transport's sprocket", ge=3, integer=True, optional=True)
    sheet_play = Quantity("Δx", "mm", "Displacement of the sheet during its rest", ge=0, optional=True)
    cover_angle = Quantity("φ_h", "deg", "Crank angle from the wheel's exit, and to its entry, for which its play is calculated", gt=0, lt=180,
        optional=True)
    backlash = Quantity("Δx_b", "mm", "Additional plays between transport and cylinder, at the sheet", ge=0, default=0)
    register_tolerance = Quantity("[Δx]", "mm", "Allowable error of the position of the cut on the sheet", gt=0, optional=True)
    conveyor_mass = Quantity("m_c", "kg", "Mass of the conveyor: chains, gripper bars and sheets", gt=0, optional=True)
    chain_mass = Quantity("m_h", "kg", "Mass accelerated by the gripper chain: its own, bars, sheets, and rotating parts", gt=0, optional=True)
    chain_links = Quantity("X", "1", "Number of links of the gripper chain", gt=0, integer=True, optional=True)
    wheel_inertia = Quantity("J_w", "kg*m**2", "Moment of inertia used in the Geneva wheel's calculation, at its shaft", gt=0, optional=True)
    wheel_side_inertia = Quantity("J_x", "kg*m**2",
        "Moment of inertia of everything that turns with the wheel in addition to the conveyor, at its shaft: the wheel, its shaft, "
        "gears, and the sprocket shaft by the square of its ratio",
        gt=0, optional=True)
    travel_radius = Quantity("r_c", "mm", "Conveyor displacement per radian of the wheel", gt=0, optional=True)

    crank_speed = Quantity("ω_1", "rpm", "Speed of the cylinder drive's crank", gt=0, optional=True)
    output_speed = Quantity("ω_o", "rpm", "Actual output speed of the drive train", gt=0, optional=True)
    loaded_output_speed = Quantity("ω_oL", "rpm", "Output speed under the mean torque", gt=0, optional=True)
    required_rate = Quantity("n_req", "1/h", "Required sheets per hour of the press; default: the productivity used in all calculations", gt=0,
        optional=True)
    output_turns_per_sheet = Quantity("i", "1", "Revolutions of that output per sheet; default: those of the cylinder drive's crank", gt=0,
        optional=True)

    cylinder_mass = Quantity("m", "kg", "Mass of the cylinder", gt=0, optional=True)
    cylinder_inertia = Quantity("I", "kg*m**2", "Moment of inertia of the cylinder about its axis", gt=0, optional=True)
    cylinder_radius = Quantity("R", "mm", "Radius of the cylinder", gt=0, optional=True)
    static_unbalance = Quantity("me", "kg*m", "Static unbalance of the cylinder", ge=0, default=0)
    shafts_inertia = Quantity("I_s", "kg*m**2", "Moment of inertia of the shafts of pinion and rocker with their parts, at the cylinder", ge=0,
        default=0)
    cylinder_rotation = CurveInput("θ", "deg", "Rotation of the cylinder over a revolution of its crank", referred=True, optional=True)
    cylinder_speed = CurveInput("ω_z", "rad/s", "Speed of the cylinder over a revolution of its crank", referred=True, optional=True)
    displacement = CurveInput("x_z", "mm", "Displacement of the cylinder's axis over a revolution of its crank", referred=True, optional=True)
    velocity = CurveInput("v_z", "m/s", "Velocity of the cylinder's axis over a revolution of its crank", referred=True, optional=True)
    stroke = Quantity("S_max", "mm", "Stroke of the cylinder's axis", gt=0, optional=True)
    dead_center_outer = Quantity("φ_out", "deg", "Crank angle of the outer dead centre", ge=0, le=360, optional=True)
    dead_center_inner = Quantity("φ_in", "deg", "Crank angle of the inner dead centre", ge=0, le=720, optional=True)

    clutch_torque = Quantity("M_c", "N*m", "Torque of the slipping clutch, on its own shaft", gt=0, optional=True)
    clutch_load = Quantity("M_l", "N*m", "Load torque of the driven side during slip", ge=0, default=0)
    clutch_speed = Quantity("ω_c", "rpm", "Speed of the clutch's driving side", gt=0, optional=True)
    clutch_turns = Quantity("i_ct", "1", "Revolutions of the clutch per revolution of the crank; default: by its speed", gt=0, optional=True)
    clutch_inertia = Quantity("J_c", "kg*m**2", "Moment of inertia used in the clutch's calculation", gt=0, optional=True)
    clutch_drives = Text("Lines of the cyclogram that the clutch couples, by name", many=True, optional=True)
    single_position = Text("Clutch engages at one angle only", default=False)
    engagement_angle = Quantity("φ_e", "deg", "Crank angle at which the clutch engages; default: the worst case", ge=0, lt=360, optional=True)

    brake_torque = Quantity("M_b", "N*m", "Torque of the brake at the main shaft", gt=0, optional=True)
    shaft_torque_mean = Quantity("M_mean", "N*m", "Mean torque of all lines at the main shaft", optional=True)
    lines_energy = Quantity("E_k", "J", "Mean kinetic energy of all lines over the common period", ge=0, optional=True)

    damper_velocity = Quantity("v_d", "m/s", "Speed at contact used in the dampers' calculation", gt=0, optional=True)
    contact_distance = Quantity("d_c", "mm", "Distance before the ends of the travel at which the dampers are met; 0: only beyond them", ge=0,
        optional=True)
    damper_mass = Quantity("m_d", "kg", "Mass of the cylinder used in the dampers' calculation", gt=0, optional=True)
    carriage_mass = Quantity("m_car", "kg", "Mass of the carriages, which move with the cylinder's axis, used in the dampers' calculation", ge=0,
        optional=True)
    damper_impacts = Quantity("z_d", "1/h", "Impacts at one end of the travel used in the dampers' calculation", gt=0, optional=True)

    flywheel_torque = CurveInput("M_f", "N*m", "Load at the flywheel's shaft over the revolutions after which it repeats", referred=True,
        optional=True)
    load_turns = Quantity("k_T", "1", "Revolutions of the drive train's output spanned by this load", ge=1, le=64, integer=True, default=1)
    flywheel_inertia = Quantity("J", "kg*m**2", "Moment of inertia of the flywheel", gt=0, optional=True)
    shafts_energy = Quantity("E_s", "J", "Kinetic energy of the motor's rotor and of the shafts that turn steadily, beside the flywheel", ge=0,
        default=0)
    flywheel_speed = Quantity("ω_f", "rpm", "Speed of the flywheel", gt=0, optional=True)
    belt_ratio = Quantity("i_b", "1", "Ratio from the motor to the flywheel", gt=0, optional=True)
    belt_efficiency = Quantity("η_b", "1", "Efficiency from the motor to the flywheel", gt=0, le=1, default=1)
    motor_rated_torque = Quantity("M_r", "N*m", "Rated torque of the motor", gt=0, optional=True)
    motor_speed = Quantity("n_m", "rpm", "Rated speed of the motor", gt=0, optional=True)
    synchronous_speed = Quantity("n_s", "rpm", "Synchronous speed of the motor", gt=0, optional=True)
    breakdown_ratio = Quantity("k_b", "1", "Ratio of breakdown torque to rated torque of the motor", ge=1, optional=True)
    speed_fluctuation = Quantity("δ", "1", "Acceptable speed fluctuation of the flywheel", gt=0, lt=1, optional=True)
    n_points = samples(720)
