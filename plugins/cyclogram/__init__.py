"""The press as one machine: phases of all lines on the main shaft, interlocks, offsets, clearance, torques together."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from diecut_report.api import Check, CurveTable, ExampleBlock, ForEach, Mechanism, Source, Wired, m
from diecut_report.plugins.cyclogram import steps
from diecut_report.plugins.cyclogram.figures import FIGURES
from diecut_report.plugins.cyclogram.inputs import Cyclogram

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


NOT_COVERED = (
    "Not checked: when grippers open and close.",
    "Not checked: feeder and delivery, and the stripping of the waste.",
    "Not checked: whether the flat sweeps over parts other than the carriages.",
)

MECHANISM = Mechanism(
    kind="cyclogram",
    version="1.0",
    title="Cyclogram of the press",
    summary="The main shaft drives all mechanisms; one revolution of it is one sheet. The phases of all mechanisms are plotted over the common "
            "period, and interlocks define what must lie within what, so that the sheet rests while it is cut and the carriages pass while the "
            "cylinder leaves clearance. The offset of one line may be solved for the largest margins. The torques of all lines are added at the "
            "main shaft, where they all run in step with the press.",
    inputs=Cyclogram,
    example=EXAMPLE,
    chapters=(steps.shaft, steps.interlocks, steps.station, steps.motions, steps.energies, steps.torques),
    key_results=("sheet_time", "offset_found", "best_margin", "clearance_least", "torque_mean", "torque_rms",
                 "torque_peak", "power_peak", "energy_fluctuation", "energy_exchange"),
    checks=(
        Check("interlock", "function", "Interlock", m.length_demand, m.length_available, named_by="interlocks.name",
              demand_label="required with margins", limit_label="available", source="timing", consequence="{interlock_verdict}"),
        Check("equal_rates", "function", "Equal rates of press and lines", m.rate_error, steps.LARGEST_RATE_ERROR, demand_label="relative difference",
              source="kinematics", consequence="{line_name} runs at another rate than the press; let its speed follow press.productivity."),
        Check("carriage_height", "function", "Clearance height for the carriages", m.carriage_clearance, m.clearance_least, demand_label="required",
              limit_label="minimum over the period", source="geometry", asks_for=("station",), only_beside=("cylinder_drive",),
              consequence="a carriage is hit; let the carriages stop elsewhere, lower them, or turn the transport by its offset."),
    ),
    figures=FIGURES,
    exports=(CurveTable(id="main_shaft", title="Curves over the main shaft", columns=("main_angle",), needs=("rates_agree",)),),
    assumptions=(
        "The main shaft rotates at constant speed: angles hold, times vary with its fluctuation. The lines are rigid and without backlash "
        "between them.",
        "Only the given interlocks are checked.",
        *NOT_COVERED,
        "Torques of lines that have none are not in the sum, nor is friction that is not given. A mechanism that is not a line contributes "
        "neither phases nor torque.",
        "The sum of the torques applies to the adopted offsets. If an interlock fails there, it belongs to a timing with which the press cannot "
        "run, and so does everything sized from it.",
    ),
    sources=(Source("timing", "Intervals of the phases on the main shaft over the common period; tents of the slack over the offset."),),
)  # fmt: skip
