"""Example of a drive train: to the main shaft of a press, or to the crank where there is no cyclogram, with which a configuration begins."""

from __future__ import annotations

from diecut_report.api import ExampleBlock, Wired

EXAMPLE = ExampleBlock(
    "train",
    {
        "motor_speed": Wired("1420 rpm", needs=("platen_press", "cyclogram"), otherwise="1450 rpm"),
        "output_speed": Wired(
            "${<cyclogram>.main_shaft_speed}", otherwise=Wired("${<cylinder_drive>.crank_speed}", otherwise="100 rpm")
        ),
        "torque_mean": Wired(
            "${<cyclogram>.torque_mean}", otherwise=Wired("${<cylinder_drive>.crank_torque_mean}", otherwise="75 N*m")
        ),
        "torque_peak": Wired(
            "${<cyclogram>.torque_peak}", otherwise=Wired("${<cylinder_drive>.crank_torque_peak}", otherwise="150 N*m")
        ),
        "torque_curve": Wired("${<cyclogram>.main_shaft_torque}", otherwise=Wired("${<cylinder_drive>.crank_torque}")),
        "torque_curve_turns": Wired("${<cyclogram>.torque_curve_turns}"),
        "vbelt": {"driver_diameter": "125 mm", "center_distance": "600 mm"},
        "power_per_belt": "3.5 kW",
        "gears": [
            {"driver_teeth": 18, "driven_teeth": 87},
            # a platen is slower
            Wired({"driver_teeth": 20, "driven_teeth": 77}, needs=("platen_press", "cyclogram")),
            # from the main shaft to the crank's
            Wired(
                None,
                needs=("cyclogram",),
                otherwise=Wired({"driver_teeth": 24, "driven_teeth": 48}, needs=("cylinder_drive",)),
            ),
        ],
        # a platen takes its torque at once: a soft motor, which starts with the clutch open
        "reserve_factor": Wired(1.6, needs=("platen_press", "cyclogram"), otherwise=1.3),
        "run_up_load": Wired(0, needs=("platen_press", "cyclogram")),
        "flywheel_material": "cast_iron",
    },
)
