"""Example of a cyclogram: the drive of the cylinder and one transport of the sheet on the main shaft, with which a configuration begins."""

from __future__ import annotations

from typing import Any

from diecut_report.api import ExampleBlock, ForEach, Wired

GENEVA, CAM_GEAR = "geneva_transport", "cam_gear_transport"
MARGIN = {"margin": "5 ms"}
DRIVE: dict[str, Any] = {"mechanism": "<cylinder_drive>", "turns_per_sheet": "1/2", "path_efficiency": 0.97}


def _transport(kind: str) -> dict[str, Any]:
    """The line of a transport; on a half of its way the carriage is below the cylinder."""
    way = f"${{<{kind}>.sheet_step}}"
    passing = {
        "name": "passing",
        "from": {"value": f"{way} / 4", "basis": "assumed"},
        "to": {"value": f"3 * {way} / 4", "basis": "assumed"},
    }
    return {"mechanism": f"<{kind}>", "offset": "auto", "path_efficiency": 0.95, "passing": [passing]}


def _interlocks(kind: str) -> list[Wired]:
    """What must lie within what, where a press has the drive of a cylinder and a transport."""
    rests = {"name": "sheet_rests", "phase": "<cylinder_drive>.contact", "within": f"<{kind}>.dwell"} | MARGIN
    passes = {"name": "carriage_passes", "phase": f"<{kind}>.passing", "within": "<cylinder_drive>.carriage_window"}
    return [Wired(rests), Wired(passes | MARGIN)]


EXAMPLE = ExampleBlock(
    "timing",
    {
        "lines": [ForEach("cylinder_drive", DRIVE), Wired(_transport(GENEVA), otherwise=Wired(_transport(CAM_GEAR)))],
        "interlocks": [
            Wired(of_geneva, otherwise=of_cam_gear)
            for of_geneva, of_cam_gear in zip(_interlocks(GENEVA), _interlocks(CAM_GEAR), strict=True)
        ],
    },
)
