"""Do the mechanisms belong to one press? Sizes, rates, inertias and speeds of one against those of another."""

from __future__ import annotations

from diecut_report.api import Mechanism
from diecut_report.plugins.press_consistency import drive, sheet
from diecut_report.plugins.press_consistency.checks import CHECKS
from diecut_report.plugins.press_consistency.example import EXAMPLE
from diecut_report.plugins.press_consistency.figures import FIGURES
from diecut_report.plugins.press_consistency.inputs import PressConsistency
from diecut_report.plugins.press_consistency.partners import PARTNERS

MECHANISM = Mechanism(
    kind="press_consistency",
    version="1.0",
    title="Consistency of the press",
    summary="Holds the mechanisms of a press against one another: the sheet against cylinder and step, the rate that the gears give against the "
    "productivity, the equivalent inertia at the crank against that of the clutch, the speed before the ends of the travel against that of the "
    "dampers, the conveyor's mass against the wheel's inertia, the motor against a load that its flywheel smooths in part, the plays "
    "against the register.",
    inputs=PressConsistency,
    example=EXAMPLE,
    chapters=(sheet.sides, sheet.rate, drive.inertia, drive.engagement, drive.coupling,
              drive.ends_chapter, sheet.conveyor, drive.motor_chapter, sheet.stopping, sheet.dwell, sheet.register),
    key_results=("step_room", "actual_rate", "crank_inertia_mean", "crank_inertia_max", "slip_heat", "equal_inertia", "way_inner", "way_outer",
                 "motor_torque_rms", "motor_torque_peak", "speed_swing", "play_total"),
    checks=CHECKS,
    figures=FIGURES,
    partners=PARTNERS,
    assumptions=(
        "Not checked: when grippers open and close; feeder, delivery and stripping; elasticity and backlash between the lines; whether the flat "
        "sweeps over parts that are no carriages; the uneven speed of the main shaft, by which times vary while angles hold.",
        "What two mechanisms share is judged where both tell it; what only one tells is not checked.",
        "The clutch slips with a constant torque, and its driving side keeps its speed. Not checked: whether shafts, keys and teeth bear the "
        "torque at which it slips, which is greater than that of the cycle by the service factor.",
        "The motor's torque falls in proportion to its speed between the synchronous and the rated one, and goes on so beyond; near its "
        "breakdown torque, and at less than the rated voltage, a real motor falls behind this line.",
    ),
)  # fmt: skip
