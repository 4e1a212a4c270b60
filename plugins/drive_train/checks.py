"""Checks of the drive train."""

from __future__ import annotations

from diecut_report.api import Check
from diecut_report.plugins.drive_train.advice import FASTEST_BELT, LARGEST_DEVIATION, LARGEST_RATIO, LEAST_WRAP

CHECKS = (
    Check(id="vbelt_speed", check_class="practice", title="Speed of the V-belt",
          demand="vbelt_speed", limit=FASTEST_BELT, unit="m/s", demand_label="belt speed", limit_label="allowed", source="practice",
          consequence="the centrifugal force lifts the belt out of the grooves; {slower_belt_advice}."),
    Check(id="vbelt_wrap", check_class="practice", title="Wrap on the smaller pulley",
          demand=LEAST_WRAP, limit="vbelt_wrap", unit="deg", demand_label="required", limit_label="wrap", source="practice",
          consequence="the belt slips; {distance_advice}."),
    Check(id="vbelt_ratio", check_class="practice", title="Ratio of the V-belt",
          demand="vbelt_ratio_actual", limit=LARGEST_RATIO, unit="1", demand_label="ratio", limit_label="allowed", source="practice",
          consequence="too much for one V-belt; {gears_advice}; now it is {gear_ratio_total}."),
    Check(id="output_speed_error", check_class="function", title="Speed of the output",
          demand="output_speed_error", limit=LARGEST_DEVIATION, unit="%", demand_label="deviation", limit_label="allowed", source="this method",
          consequence="with driven pulleys of R40 the output turns at {output_speed}, not at {inputs.output_speed}; {driver_advice}."),
    Check(id="motor_power", check_class="function", title="Motor", demand="power_required", limit="motor_power", unit="kW",
          demand_label="required power", limit_label="rated power", sized_unless=(), source="IEC 60072-1",
          consequence="no standard motor is so large; {motor_advice}."),
    Check(id="motor_overload", check_class="function", title="Overload of the motor",
          demand="motor_peak_torque", limit="motor_breakdown_torque", unit="N*m",
          demand_label="peak torque at the motor", limit_label="breakdown torque", source="this method",
          consequence="no flywheel smooths the peak, so the motor stalls; {overload_advice}."),
    Check(id="flywheel_rim_speed", check_class="strength", title="Rim of the flywheel",
          demand="flywheel_rim_speed", limit="flywheel_rim_limit", unit="m/s", only_with=("torque_curve",),
          demand_label="rim speed", limit_label="allowed for the material", source="material",
          consequence="the wheel may burst; {rim_advice}."),
    Check(id="run_up_torque", check_class="function", title="Torque while the motor runs up",
          demand="run_up_load_torque", limit="run_up_torque", unit="N*m",
          operator="<", demand_label="load at the motor", limit_label="torque of the motor", source="this method",
          consequence="the motor does not run up; {run_up_advice}."),
    Check(id="run_up_time", check_class="function", title="Run-up time", demand="run_up_time", limit="allowable_run_up_time", unit="s",
          demand_label="run-up", limit_label="allowed", source="this method",
          consequence="the motor's protection trips; {run_up_advice}."),
    Check(id="gear_teeth", check_class="practice", title="Teeth of the gears", demand=17.0, limit="least_teeth", unit="1", severity="warn",
          demand_label="teeth without undercut", limit_label="fewest teeth", source="practice",
          consequence="gears below 17 teeth are undercut; shift their profile, or take 17 teeth or more and as many more on the other gear."),
    Check(id="torque_mean", check_class="practice", title="Mean torque and curve",
          demand="mean_difference", limit="accepted_difference", unit="N*m", severity="warn", only_with=("torque_curve",),
          demand_label="difference of the means", limit_label="accepted", source="this method",
          consequence="they do not belong together, and the curve is used; {mean_advice}."),
    Check(id="torque_peak", check_class="practice", title="Peak torque and curve",
          demand="peak_difference", limit="accepted_difference", unit="N*m", severity="warn", only_with=("torque_curve",),
          demand_label="difference of the peaks", limit_label="accepted", source="this method",
          consequence="they do not belong together, and the curve is used; set torque_peak to {curve_peak}, or take both from the same "
          "mechanism."),
    Check(id="power_balance", check_class="numerical", title="Power balance", demand="power_missing", limit="power_rounding", unit="W",
          demand_label="missing power", limit_label="rounding", source="conservation of energy",
          consequence="the calculation contradicts itself; do not use it."),
)  # fmt: skip
