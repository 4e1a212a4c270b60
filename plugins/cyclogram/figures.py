"""Figures of the cyclogram."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi
from typing import Any

import numpy as np

from diecut_report.api import (
    Chart,
    Drawing,
    Driven,
    Grip,
    Phrase,
    Shape,
    View,
    arc,
    chart_panel,
    circle,
    label,
    line,
    mark,
    phrase,
    polyline,
    told,
    vertical,
)
from diecut_report.mechanics.timing.intervals import Intervals, slack
from diecut_report.mechanics.timing.productivity import tents_of
from diecut_report.plugins.cyclogram.timing import Timing
from diecut_report.plugins.cyclogram.torques import Motions, Together, Torques

WIDTH, HIGH, BAR = 8.0, 0.44, 0.22  # of the whole period, a row, a bar
INNER, RING, LAYER = 0.8, 0.8, 0.22  # of the rings: the innermost radius, a line, a role of its phases
LAYERS = {"working": "link", "rest": "outline", "window": "hidden"}
TURN = 2 * pi
POINTS = 721
AXIS = (phrase("Main-shaft angle"), "Φ", "deg")


def _pieces(intervals: Intervals, period: float) -> Iterator[tuple[float, float]]:
    """Both ends of each interval as shares of the period; what passes its end goes on at its start."""
    for start, end in intervals:
        for a, b in ((start, min(end, period)), (0.0, end - period)):
            if b > a:
                yield a / period, b / period


def _bars(intervals: Intervals, period: float, y: float, role: str, grip: Grip | None = None) -> list[Shape]:
    """Bars of a row; those of a line are moved with its offset."""
    low, high = y - BAR / 2, y + BAR / 2
    ends = [(a * WIDTH, b * WIDTH) for a, b in _pieces(intervals, period)]
    return [polyline([(a, low), (b, low), (b, high), (a, high)], role, closed=True, grip=grip) for a, b in ends]


def _brackets(intervals: Intervals, period: float, y: float) -> list[Shape]:
    """What must be held, as brackets over the row."""
    low, high = y - BAR / 2, y + BAR * 0.8
    ends = [(a * WIDTH, b * WIDTH) for a, b in _pieces(intervals, period)]
    return [polyline([(a, low), (a, high), (b, high), (b, low)], "mark") for a, b in ends]


def _scale(timing: Timing, bottom: float) -> list[Shape]:
    """Lines at each quarter of a sheet, and what they stand for."""
    count = round(4 * float(timing.common))
    shapes = []
    for index in range(count + 1):
        x = index / count * WIDTH
        shapes.append(polyline([(x, HIGH), (x, bottom)], "centerline"))
        shapes.append(label((x, HIGH * 1.5), told(index * TURN / 4, "deg"), "center"))
    return shapes


def _shades(timing: Timing, bottom: float) -> list[Shape]:
    """The dwells through all rows."""
    dwells = [each.on_main_shaft("dwell", timing.common, None) for each in timing.lines if "dwell" in each.phases]
    pieces = [(a * WIDTH, b * WIDTH) for dwell in dwells for a, b in _pieces(dwell, timing.period)]
    return [polyline([(a, HIGH / 2), (b, HIGH / 2), (b, bottom), (a, bottom)], "shade", closed=True) for a, b in pieces]


def rows(view: View) -> list[Shape]:
    """A row of bars for each phase over the common period, and one for each interlock with its margins."""
    timing: Timing = view.prepared("timing")
    shapes, y, period = [], 0.0, view["main_period"]
    for number, each in enumerate(timing.lines):
        shapes.append(label((-0.2, y), Phrase("{name}:", name=each.name), "right"))
        grip = Grip(f"lines.{number}.offset", period / WIDTH, each.line.offset)
        y -= HIGH
        for name in each.told:
            shapes.append(label((-0.2, y), each.words[name], "right"))
            shapes += _bars(each.on_main_shaft(name, timing.common, None), period, y, "outline", grip)
            y -= HIGH
        y -= HIGH / 2
    for interlock, pair in zip(timing.final, timing.worst, strict=True):
        shapes.append(label((-0.2, y), interlock.name, "right"))
        shapes += _bars(interlock.outer, period, y, "ghost")
        shapes += _brackets(interlock.inner, period, y)
        shapes.append(label((WIDTH + 0.2, y), f"{told(pair.start, 'deg')}, {told(pair.end, 'deg')}", "left"))
        y -= 1.3 * HIGH
    return [*_shades(timing, y), *_scale(timing, y), *shapes]


def at_angle(view: View, angle: float) -> list[Shape]:
    """The rows with a line across all of them at an angle of the main shaft; the bars are filled while it passes them."""
    still, scale = view.once(rows), view.prepared("timing").period / WIDTH
    heights = [y for shape in still if shape["shape"] == "polyline" for _, y in shape["points"]]
    shapes = [shape | {"during": _ends(shape, scale)} if shape.get("role") == "outline" else shape for shape in still]
    return [*shapes, polyline([(angle / scale, max(heights)), (angle / scale, min(heights))], "mark")]


def driven(view: View) -> list[Driven]:
    """The lines, each with its final offset."""
    lines = view.prepared("timing").lines
    return [Driven(each.name, each.line.offset, TURN * float(each.line.period_turns())) for each in lines]


def _ends(bar: Shape, scale: float) -> list[float]:
    places = [x * scale for x, _ in bar["points"]]
    return [min(places), max(places)]


def rings(view: View) -> list[Shape]:
    """A ring for each line, the common period once round, clockwise from the top."""
    timing: Timing = view.prepared("timing")
    shapes, period = list[Shape](), view["main_period"]
    for index, each in enumerate(timing.lines):
        radius = INNER + index * RING
        shapes += [circle((0.0, 0.0), radius, "ghost"), label((0.0, radius - 0.1), each.name, "center")]
        for name in each.phases:
            role = each.roles[name]
            if role in LAYERS:
                own = radius + LAYER * (1 + list(LAYERS).index(role)) / 1.5
                pieces = _pieces(each.on_main_shaft(name, timing.common, None), period)
                shapes += [
                    arc((0.0, 0.0), own, TURN / 4 - b * TURN, TURN / 4 - a * TURN, LAYERS[role]) for a, b in pieces
                ]
    outside = INNER + len(timing.lines) * RING
    return [*shapes, *_spokes(timing, outside)]


def _spokes(timing: Timing, outside: float) -> list[Shape]:
    """Lines at each quarter of a sheet, and what they stand for."""
    count = round(4 * float(timing.common))
    ends = [(np.sin(k / count * TURN), np.cos(k / count * TURN)) for k in range(count)]
    shapes = [polyline([(INNER * x, INNER * y), (outside * x, outside * y)], "centerline") for x, y in ends]
    said = (told(k * TURN / 4, "deg") for k in range(count))
    return [
        *shapes,
        *(
            label((1.12 * outside * x, 1.08 * outside * y), text, "center")
            for (x, y), text in zip(ends, said, strict=True)
        ),
    ]


def moving(view: View) -> list[Shape]:
    """The ways of the lines, each in a panel of its own, and the room over the carriages where it is known where they stand."""
    motions: Motions = view.prepared("motions")
    main = _angles(view.prepared("timing"))
    ways = [
        (
            Phrase("Displacement of {name}", name=name),
            line(main, motions.ways.one(k, main[None], main[None], None)[0], name),
        )
        for k, name in enumerate(motions.ways.names)
    ]
    panels = [chart_panel(title, "mm", *AXIS, lines=[drawn]) for title, drawn in ways]
    return [*panels, *_slack(view.prepared("timing"))]


def taking(view: View) -> list[Shape]:
    """The torques of all consumers at the main shaft, with their sum."""
    known: Torques = view.prepared("sum")
    return [_with_sum(view, known.together, "Torque at the main shaft", "N*m")]


def swinging(view: View) -> list[Shape]:
    """The kinetic energies of the lines, with their sum."""
    motions: Motions = view.prepared("motions")
    return [_with_sum(view, motions.energies, "Kinetic energy", "J")]


def _with_sum(view: View, curves: Together, title: str, unit: str) -> Shape:
    """Several curves over the main shaft, with their sum."""
    main = _angles(view.prepared("timing"))
    each = curves.each(main[None], main[None], None)[:, 0]
    lines = [line(main, own, name) for own, name in zip(each, curves.names, strict=True)]
    return chart_panel(title, unit, *AXIS, lines=[*lines, line(main, each.sum(axis=0), "sum")])


def clearing(view: View) -> list[Shape]:
    """The room over the carriages."""
    main = _angles(view.prepared("timing"))
    room = view.prepared("clearance").over(main[None], main[None], None)[0]
    needed = line(main, np.full_like(main, view["carriage_clearance"]), "required")
    return [chart_panel("Height over the carriages", "mm", *AXIS, lines=[line(main, room, "minimum"), needed])]


def _angles(timing: Timing) -> Any:
    return np.linspace(0, timing.period, POINTS)[:-1] + timing.period / POINTS / 2


def _room(low: float, high: float) -> Iterator[Any]:
    """The ends of the offsets at which all interlocks hold."""
    yield vertical(low, Phrase("from {end}", end=told(low, "deg")))
    yield vertical(high, Phrase("to {end}", end=told(high, "deg")))


def _slack(timing: Timing) -> list[Shape]:
    """The least slack of all interlocks over the offset that is to be found; nothing where none is."""
    best = timing.best
    if best is None:
        return []
    offsets = np.linspace(0, timing.span, 4 * POINTS)
    heights = slack(offsets, tents_of(timing.interlocks(timing.drawn), timing.period, timing.productivity))
    feasible = [end for low, high in best.feasible for end in _room(low, high)]
    marks = [mark(best.shift, best.slack, "best")] if np.isfinite(best.slack) else []
    lines = [
        line(offsets, np.where(np.isfinite(heights), heights, np.nan), "minimum slack"),
        line(offsets, 0 * offsets, "no slack"),
    ]
    return [chart_panel("Slack", "deg", "Offset", "Φ_0", "deg", lines=lines, marks=marks, verticals=feasible)]


FIGURES = (
    Drawing(
        "cyclogram",
        "Cyclogram",
        "Operating phases of each mechanism over the common period of the main shaft; below, for each interlock, what must be contained "
        "(brackets) within what contains it (light), with the smallest margins at the start and at the end. Shaded: dwell.",
        build=rows,
        moving=at_angle,
        over="main_angle",
        drives=driven,
        schematic=True,
    ),
    Drawing(
        "rings",
        "Circular cyclogram",
        "One common period, clockwise from the top, a ring for each line. From inside to outside: working (heavy), at rest (full), "
        "leaving room for others (dashed).",
        build=rings,
        schematic=True,
    ),
    Chart(
        "ways",
        "Displacements and slack",
        "Displacements of the lines over the common period of the main shaft; a transport advances with each step. Where an offset is "
        "solved: the minimum slack of all interlocks versus the offset; between the vertical lines all interlocks hold.",
        needs=("rates_agree",),
        build=moving,
    ),
    Chart(
        "clearance",
        "Clearance over the carriages",
        "The minimum height that the cylinder leaves over all carriages; where none is below it, its radius is shown.",
        needs=("rates_agree", "station"),
        build=clearing,
    ),
    Chart(
        "torques",
        "Torques at the main shaft",
        "The torques of the lines at the main shaft and their sum; negative where a line drives the shaft.",
        needs=("rates_agree", "takes_torque"),
        build=taking,
    ),
    Chart(
        "energies",
        "Kinetic energies",
        "The kinetic energies of the lines and their sum: energy released by one line while another absorbs it needs no flywheel.",
        needs=("rates_agree", "energy_known"),
        build=swinging,
    ),
)
