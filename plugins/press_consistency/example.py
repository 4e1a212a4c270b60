"""Example of the consistency of a press, told what its mechanisms do not tell, with which a configuration begins."""

from __future__ import annotations

from diecut_report.api import ExampleBlock, Wired

EXAMPLE = ExampleBlock(
    "consistency",
    {
        "cylinder": "<cylinder_sizing>",
        "drive": "<cylinder_drive>",
        "transport": Wired("<geneva_transport>", otherwise="<cam_gear_transport>"),
        "conveyor": "<cam_gear_transport>",
        "chain": "<roller_chain>",
        "wheel": "<geneva_transport>",
        "train": "<drive_train>",
        "clutch": "<clutch>",
        "timing": "<cyclogram>",
        "damper": "<damper>",
        "sheet_gap": "90 mm",
        "register_tolerance": "0.3 mm",
        "clutch_drives": Wired(["<cylinder_drive>"], needs=("cyclogram", "clutch")),
        "single_position": Wired(True, needs=("clutch",)),
    },
)
