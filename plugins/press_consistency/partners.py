"""Where the consistency of the press takes its inputs from."""

from __future__ import annotations

from diecut_report.api import Partner

PARTNERS = (
    Partner(key="cylinder", kinds=("cylinder_sizing",), takes={"working_length": "working_length", "generatrix_length": "generatrix_length"}),
    Partner(key="drive", kinds=("cylinder_drive",), takes={
        "cylinder_mass": "cylinder_mass", "cylinder_inertia": "cylinder_inertia", "cylinder_radius": "cylinder_radius",
        "static_unbalance": "static_unbalance", "shafts_inertia": "shafts_inertia", "cylinder_rotation": "cylinder_rotation",
        "cylinder_speed": "cylinder_speed",
        "displacement": "displacement", "velocity": "velocity", "stroke": "stroke", "crank_speed": "crank_speed",
        "dead_center_outer": "dead_center_outer", "dead_center_inner": "dead_center_inner"}),
    Partner(key="transport", kinds=("cam_gear_transport", "geneva_transport"), takes={
        "sheet_step": "sheet_step", "chain_pitch": "chain_pitch", "sprocket_teeth": "sprocket_teeth", "sheet_play": "sheet_play"}),
    Partner(key="conveyor", kinds=("cam_gear_transport",), takes={"conveyor_mass": "conveyor_mass"}),
    Partner(key="chain", kinds=("roller_chain",), takes={"chain_mass": "moving_mass_total", "chain_links": "links"},
        unless={"acceleration": "cylinder_drive"}),
    Partner(key="wheel", kinds=("geneva_transport",), takes={
        "wheel_inertia": "driven_inertia", "travel_radius": "travel_radius", "cover_angle": "cover_angle"}),
    Partner(key="train", kinds=("drive_train",), takes={
        "output_speed": "output_speed", "loaded_output_speed": "loaded_output_speed",
        "flywheel_torque": "flywheel_torque", "load_turns": "torque_curve_turns",
        "flywheel_inertia": "wheel_inertia", "shafts_energy": "shafts_energy", "flywheel_speed": "shaft_2_speed", "belt_ratio": "vbelt_ratio_actual",
        "belt_efficiency": "vbelt.efficiency", "motor_rated_torque": "motor_rated_torque", "motor_speed": "motor_speed",
        "synchronous_speed": "synchronous_speed", "breakdown_ratio": "breakdown_ratio", "speed_fluctuation": "speed_fluctuation"}),
    Partner(key="clutch", kinds=("clutch",), takes={
        "clutch_torque": "design_torque", "clutch_load": "load_torque_at_engagement", "clutch_speed": "speed",
        "clutch_inertia": "driven_inertia"}),
    Partner(key="timing", kinds=("cyclogram",), always=True, takes={
        "timing_slack": "best_margin", "shaft_torque_mean": "torque_mean", "lines_energy": "kinetic_energy_mean"}),
    Partner(key="drive_line", kinds=("drive_line",), takes={"brake_torque": "brake_torque"}),
    Partner(key="damper", kinds=("damper",), takes={
        "damper_velocity": "velocity", "contact_distance": "contact_distance", "damper_impacts": "impacts_per_hour",
        "damper_mass": "mass", "carriage_mass": "carriage_mass"}),
)  # fmt: skip
