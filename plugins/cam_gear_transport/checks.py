"""Checks of the cam-gear stepper."""

from __future__ import annotations

from diecut_report.api import Check, Vary
from diecut_report.plugins.cam_gear_transport.cams import LOADED
from diecut_report.plugins.cam_gear_transport.inputs import CAMS, GRIPPED, MODULES, SHEET, TORQUE

SHORTER = (Vary("dwell_angle", "down"), Vary("sector_stop_sweep", "down"))
SLOWER = (Vary("cycles_per_hour", "down"),)

CHECKS = (
    Check(id="return_time", check_class="practice", title="Time of the sector's return", demand="min_return_time", limit="time_return", unit="1",
        demand_label="required fraction", limit_label="available fraction, T₄", source="practice",
        consequence="the sector and the conveyor are thrown in too short a time.", advise=SHORTER),
    Check(id="gear_turn", check_class="numerical", title="One revolution of the gear per cycle", demand="gear_rotation_error", limit=1e-6, unit="deg",
        demand_label="deviation from one revolution", limit_label="accepted", source="kinematics",
        consequence="the law of motion contradicts itself: its velocity is not the rate of its position; correct the law."),
    Check(id="tooth_undercut", check_class="practice", title="Minimum number of teeth of the gear", demand=17.0, limit="gear_teeth", unit="1",
        severity="warn", needs=("module",), demand_label="teeth without undercut", limit_label="teeth of the gear", source="involute teeth of 20°",
        consequence="the gear's teeth are undercut at their roots, unless the profile is shifted.", advise=(Vary("module", "down", MODULES),)),
    Check(id="pressure_angle", check_class="practice", title="Pressure angle of the cams", demand="pressure_angle_max", limit="max_pressure_angle",
        unit="deg", demand_label="maximum pressure angle", limit_label="accepted", source="practice", needs=CAMS,
        consequence="the roller presses on its pivot more than it turns the arm (cam 1 has {cam_1_pressure_angle_max}, cam 2 "
            "{cam_2_pressure_angle_max}); {arms_that_fit}."),
    Check(id="curvature", check_class="function", title="No undercut of the cams", demand="roller_radius", limit="curvature_min", unit="mm",
        operator="<", demand_label="roller radius", limit_label="minimum radius of pitch curves", source="geometry", needs=CAMS,
        consequence="a profile ends in a point and its roller leaves the wanted path there; {arms_that_fit}.",
        advise=(Vary("roller_radius", "down"),)),
    Check(id="profile_turns", check_class="function", title="Cams enclose the shaft", demand="roller_radius", limit="tangent_distance_min", unit="mm",
        operator="<", demand_label="roller radius", limit_label="minimum tangent distance", source="geometry", needs=CAMS,
        consequence="a roller runs back around O₁ or its profile crosses itself; {arms_that_fit}.", advise=(Vary("roller_radius", "down"),)),
    Check(id="contact_pressure", check_class="strength", title="Contact pressure of rollers", demand="contact_pressure",
        limit="allowable_contact_pressure", unit="MPa", demand_label="maximum contact pressure", limit_label="allowed",
        source="Hertz", needs=(*CAMS, *LOADED, "allowable_contact_pressure"),
        consequence="rollers and cams wear and pit; a lighter conveyor presses less.", advise=(Vary("roller_width", "up"), *SLOWER)),
    Check(id="sheet_acceleration", check_class="function", title="Acceleration of the sheet", demand="sheet_acceleration_max",
        limit="allowable_sheet_acceleration", unit="m/s**2", demand_label="maximum acceleration", limit_label="allowed",
        source="input", needs=(*SHEET, "allowable_sheet_acceleration"), consequence="the sheet slips from the grippers or tears.",
        advise=("sector_stop_sweep", *SLOWER, Vary("dwell_angle", "down"))),
    Check(id="grippers", check_class="function", title="Holding force of the grippers", demand="sheet_force", limit="gripper_force", unit="N",
        demand_label="force of the sheet on the grippers", limit_label="holding force of the grippers", source="mechanics",
        needs=(*GRIPPED, "gripper_force"), consequence="the sheet slips out of the grippers, and the register is lost.", advise=SLOWER),
    Check(id="torque", check_class="strength", title="Torque at the disc's shaft", demand="torque_peak", limit="allowable_torque", unit="N*m",
        demand_label="maximum torque", limit_label="allowed", source="input",
        consequence="the shaft and what drives it are overloaded; a lighter conveyor needs less.", advise=SLOWER),
    Check(id="energy_balance", check_class="numerical", title="Energy balance over a revolution", demand="energy_residual", limit=1e-6, unit="1",
        needs=TORQUE, demand_label="relative difference", limit_label="accepted", source="conservation of energy",
        consequence="the calculation contradicts itself; do not use it."),
)  # fmt: skip
