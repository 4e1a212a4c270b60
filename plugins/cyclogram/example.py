"""Example of a cyclogram: the drive of a cylinder, or a platen, and a transport of the sheet, with which a configuration begins."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from diecut_report.api import ExampleBlock, ForEach, Wired

GENEVA, CAM_GEAR = "geneva_transport", "cam_gear_transport"
MARGIN = {"margin": "5 ms"}
DRIVE: dict[str, Any] = {"mechanism": "<cylinder_drive>", "turns_per_sheet": "1/2", "path_efficiency": 0.97}


def _transport(kind: str) -> dict[str, Any]:
    """The line of a transport; on a half of its way the carriage is below what cuts."""
    way = f"${{<{kind}>.sheet_step}}"
    passing = {
        "name": "passing",
        "from": {"value": f"{way} / 4", "basis": "assumed"},
        "to": {"value": f"3 * {way} / 4", "basis": "assumed"},
    }
    return {"mechanism": f"<{kind}>", "offset": "auto", "path_efficiency": 0.95, "passing": [passing]}


def _interlocks(kind: str, press: str, pressing: str) -> list[Wired]:
    """What must lie within what, where a press has what cuts and a transport."""
    rests = {"name": "sheet_rests", "phase": f"<{press}>.{pressing}", "within": f"<{kind}>.dwell"} | MARGIN
    passes = {"name": "carriage_passes", "phase": f"<{kind}>.passing", "within": f"<{press}>.carriage_window"}
    return [Wired(rests), Wired(passes | MARGIN)]


def _first_of(ways: list[Wired]) -> Wired:
    """The first way whose kinds a press has."""
    first, *others = ways
    return replace(first, otherwise=_first_of(others)) if others else first


CUTTING = (("cylinder_drive", "contact"), ("platen_press", "pressing"))
EXAMPLE = ExampleBlock(
    "timing",
    {
        "lines": [
            ForEach("cylinder_drive", DRIVE),
            ForEach("platen_press", {"mechanism": "<platen_press>"}),
            Wired(_transport(GENEVA), otherwise=Wired(_transport(CAM_GEAR))),
        ],
        "interlocks": [
            _first_of(list(ways))
            for ways in zip(*(_interlocks(kind, *cut) for cut in CUTTING for kind in (GENEVA, CAM_GEAR)), strict=True)
        ],
    },
)
