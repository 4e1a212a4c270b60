"""Figures of the comparison of cam-gear stepper and Geneva drive."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import BarGroup, Bars, Chart, Shape, View, chart_panel, level, line, mark, vertical
from diecut_report.plugins.geneva_transport import comparison_formulas as related

DRIVES = (("cam-gear", "cam"), ("Geneva", "geneva"))
NARROWEST = 0.25  # of the sweeps drawn, to that of the least acceleration


def cycle(view: View) -> list[Shape]:
    """Velocity and acceleration of the sheet over the cycle, both drives; in m/s where the step is known."""
    step, time = view.get("cam_step", view.get("geneva_step", 0.0)), view["cycle_time"]
    if step:
        return [
            _over_cycle(view, "velocity", "Velocity of the sheet", "m/s", step / time),
            _over_cycle(view, "acceleration", "Acceleration of the sheet", "m/s**2", step / time**2),
        ]
    return [
        _over_cycle(view, "velocity", "Velocity in units of S/T", "1", 1.0),
        _over_cycle(view, "acceleration", "Acceleration in units of S/T²", "1", 1.0),
    ]


def _over_cycle(view: View, what: str, title: str, unit: str, factor: float) -> Shape:
    share = np.append(np.array(view.curve("cycle_angle")) / (2 * np.pi), 1.0)
    return chart_panel(
        title,
        unit,
        "Fraction of the cycle",
        "",
        "1",
        lines=[line(share, _closed(view, f"{drive}_{what}") * factor, name) for name, drive in DRIVES],
        verticals=[vertical(view["dwell_share"], "end of the cam-gear's dwell")],
    )


def _closed(view: View, curve: str) -> Any:
    """A curve's samples, and again the first one at the end of the cycle."""
    values = view.curve(curve)
    return np.array([*values, values[0]])


def same_dwell(view: View) -> list[Shape]:
    """What a cam-gear with the Geneva drive's dwell asks of the sheet, over its sweep of stop and start."""
    dwell, held, peak = view["geneva_dwell"], view["sector_dwell_sweep"], view["law_peak_velocity"]
    best, limit = view["stop_sweep_best"], view["stop_sweep_limit"]
    sweep = np.linspace(NARROWEST * best, limit, 181)
    stop = related.time_of_stop(sweep, dwell, held, peak)
    back = related.time_of_return(dwell, stop)
    hard = view["law_peak_acceleration"]
    stopping = related.acceleration_of_stop(sweep, dwell, held, hard, stop)
    returning = related.acceleration_of_return(sweep, dwell, held, hard, back)
    over = ("Sweep of stop and start", "γ_3(3+1)", "deg")
    return [
        chart_panel("Maximum acceleration in units of S/T²", "1", *over,
                    lines=[line(sweep, stopping, "stop and start"), line(sweep, returning, "return")],
                    marks=[mark(best, view["best_acceleration"], "minimum")],
                    levels=[level(view["geneva_acceleration_peak"], "Geneva")]),
        chart_panel("Maximum velocity in units of S/T", "1", *over,
                    lines=[line(sweep, related.velocity_of_return(sweep, dwell, held, peak, back), "cam-gear")],
                    marks=[mark(best, view["best_velocity"], "with the lowest acceleration")],
                    levels=[level(view["geneva_velocity_peak"], "Geneva")]),
    ]  # fmt: skip


def _both(label: str, unit: str, cam: str, geneva: str) -> BarGroup:
    return BarGroup(label=label, unit=unit, bars=(("cam-gear", cam), ("Geneva", geneva)))


FIGURES = (
    Bars(
        id="peaks",
        title="Dwell and peaks",
        caption="Dwell as a fraction of the cycle, maximum velocity in units of S/T, maximum acceleration in units of S/T², and maximum power in "
        "units of m·S²/T³, which is also the ratio of the torques.",
        groups=(
            _both("Dwell", "%", "dwell_share", "geneva_dwell"),
            _both("Velocity", "1", "cam_velocity_peak", "geneva_velocity_peak"),
            _both("Acceleration", "1", "cam_acceleration_peak", "geneva_acceleration_peak"),
            _both("Power", "1", "cam_power_peak", "geneva_power_peak"),
        ),
    ),
    Chart(
        id="cycle",
        title="Motion of the sheet by both drives",
        caption="Over a cycle that begins with the cam-gear's dwell; both motions have the same middle.",
        build=cycle,
    ),
    Chart(
        id="same_dwell",
        title="Cam-gear with the Geneva drive's dwell",
        caption="Acceleration of the sheet versus the sweep of stop and start, up to the sweep that leaves a tenth of the cycle for the return.",
        build=same_dwell,
    ),
)
