"""Figures of the cyclogram."""

from __future__ import annotations

from math import pi

import numpy as np

from diecut_report.api import Chart, Drawing, Shape, View, box, chart_panel, label, line, mark, polyline, told, vertical
from diecut_report.mechanics.timing.intervals import Intervals
from diecut_report.mechanics.timing.offsets import slack
from diecut_report.mechanics.timing.productivity import tents_of
from diecut_report.plugins.cyclogram.clearances import way_of
from diecut_report.plugins.cyclogram.kinds import POSITION, STEP
from diecut_report.plugins.cyclogram.timing import Timing
from diecut_report.plugins.cyclogram.torques import Sum

WIDTH, HIGH, BAR, LABELS = 8.0, 0.3, 0.2, 3.2  # of the whole period, a row, a bar, the names
TURN = 2 * pi
POINTS = 721


def _bars(intervals: Intervals, period: float, y: float, role: str) -> list[Shape]:
    """Bars of a row; what passes the end of the period goes on at its start."""
    shapes = []
    for start, end in intervals:
        for a, b in ((start, min(end, period)), (0.0, end - period)):
            if b > a:
                shapes.append(box(((a + b) / 2 / period * WIDTH, y), (b - a) / period * WIDTH, BAR, [], role))
    return shapes


def _scale(timing: Timing, bottom: float) -> list[Shape]:
    """Lines at each quarter of a sheet, and what they stand for."""
    count = round(4 * float(timing.common))
    shapes = []
    for index in range(count + 1):
        x = index / count * WIDTH
        shapes.append(polyline([(x, HIGH), (x, bottom)], "centerline"))
        shapes.append(label((x, HIGH * 1.4), told(index * TURN / 4, "deg")))
    return shapes


def rows(view: View) -> list[Shape]:
    """A row of bars for each phase over the common period, and one for each interlock with its margins."""
    timing: Timing = view.prepared("timing")
    shapes, y = [], 0.0
    for each in timing.lines:
        for name in each.phases:
            shapes.append(label((-0.1, y), f"{each.name}.{name}", "right"))
            shapes += _bars(each.on_main_shaft(name, timing.common, None), timing.period, y, "outline")
            y -= HIGH
        y -= HIGH / 2
    for interlock, pair in zip(timing.final, timing.worst, strict=True):
        shapes.append(label((-0.1, y), interlock.name, "right"))
        shapes += _bars(interlock.outer, timing.period, y, "ghost")
        shapes += _bars(interlock.inner, timing.period, y, "body")
        shapes.append(label((WIDTH + 0.1, y), f"{told(pair.start, 'deg')}, {told(pair.end, 'deg')}", "left"))
        y -= HIGH
    return [*_scale(timing, y), *shapes]


def over_main_shaft(view: View) -> list[Shape]:
    """Ways of the sheets, and the torques with their sum."""
    timing: Timing = view.prepared("timing")
    known: Sum = view.prepared("sum")
    main = np.linspace(0, timing.period, POINTS)[:-1] + timing.period / POINTS / 2
    ways = [
        line(main, way_of(each, each.mechanism.number(STEP) or 0.0)(main), each.name)
        for each in timing.lines
        if each.mechanism.curve(POSITION) is not None and "dwell" in each.phases
    ]
    torques = [line(main, each.at_main_shaft(main, main), each.name) for each in known.consumers]
    torques += (
        [line(main, np.sum([each.at_main_shaft(main, main) for each in known.consumers], axis=0), "sum")]
        if torques
        else []
    )
    axis = ("Angle of the main shaft", "Φ", "deg")
    panels = [chart_panel("Way", "mm", *axis, lines=ways)] if ways else []
    panels += [chart_panel("Torque at the main shaft", "N*m", *axis, lines=torques)] if torques else []
    return [*panels, *_slack(timing)]


def _slack(timing: Timing) -> list[Shape]:
    """The least slack of all interlocks over the offset that is to be found; nothing where none is."""
    best = timing.best
    if best is None:
        return []
    offsets = np.linspace(0, timing.span, 4 * POINTS)
    heights = slack(offsets, tents_of(timing.interlocks(timing.drawn), timing.period, timing.productivity))
    feasible = [vertical(end, told(end, "deg")) for each in best.feasible for end in each]
    marks = [mark(best.shift, best.slack, "best")] if np.isfinite(best.slack) else []
    lines = [
        line(offsets, np.where(np.isfinite(heights), heights, np.nan), "least slack"),
        line(offsets, 0 * offsets, "none"),
    ]
    return [chart_panel("Slack", "deg", "Offset", "Φ_0", "deg", lines=lines, marks=marks, verticals=feasible)]


FIGURES = (
    Drawing(
        id="cyclogram",
        title="Cyclogram",
        caption="When each mechanism does what, over the common period of the main shaft; below, for each interlock, what must be held "
        "(full) within what holds it (light), with the least margins at the start and at the end.",
        build=rows,
        schematic=True,
    ),
    Chart(
        id="over_main_shaft",
        title="Ways, torques and slack",
        caption="Ways of the sheets from where they stand, and the torques of the lines at the main shaft with their sum. Where an offset "
        "is found: the least slack of all interlocks over it; between the upright lines all interlocks hold.",
        build=over_main_shaft,
    ),
)
