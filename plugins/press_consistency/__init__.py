"""Do the mechanisms belong to one press? Sizes, rates, inertias and speeds of one against those of another."""

from __future__ import annotations

from diecut_report.api import Mechanism
from diecut_report.plugins.press_consistency import cylinder, drive, sheet
from diecut_report.plugins.press_consistency.checks import CHECKS
from diecut_report.plugins.press_consistency.example import EXAMPLE
from diecut_report.plugins.press_consistency.figures import FIGURES
from diecut_report.plugins.press_consistency.inputs import PressConsistency
from diecut_report.plugins.press_consistency.partners import PARTNERS

MECHANISM = Mechanism(
    kind="press_consistency",
    version="1.0",
    title="Consistency of the press",
    summary="Compares the mechanisms of a press with one another: the sheet with cylinder and step, the rate given by the gears with the "
            "productivity, the equivalent inertia at the crank with that of the clutch, the speed before the ends of the travel with that of the "
            "dampers, the conveyor's mass with the wheel's inertia, the motor with a load that its flywheel smooths in part, the plays with the "
            "register.",
    inputs=PressConsistency,
    example=EXAMPLE,
    chapters=(sheet.sides, cylinder.CYLINDER, sheet.rate, drive.inertia, drive.engagement, drive.coupling,
              drive.ends_chapter, sheet.conveyor, drive.motor_chapter, sheet.stopping, sheet.dwell, sheet.register),
    key_results=("step_room", "actual_rate", "crank_inertia_mean", "crank_inertia_max", "slip_heat", "equal_inertia", "way_inner", "way_outer",
                 "motor_torque_rms", "motor_torque_peak", "speed_swing", "play_total"),
    checks=CHECKS,
    figures=FIGURES,
    partners=PARTNERS,
    assumptions=(
        "Not checked: when grippers open and close; feeder, delivery and stripping; elasticity and backlash between the lines; whether the flat "
        "sweeps over parts other than the carriages; the speed fluctuation of the main shaft, with which times vary while angles hold.",
        "Values that two mechanisms share are compared if both give them; a value given by only one is not checked.",
        "The clutch slips at constant torque, and its driving side keeps its speed. Not checked: whether shafts, keys and teeth withstand the "
        "slip torque, which exceeds that of the cycle by the service factor.",
        "The motor's torque is linear in its speed between the synchronous and the rated one, and extrapolated beyond; near its breakdown "
        "torque, and below the rated voltage, a real motor falls short of this line.",
    ),
)  # fmt: skip
