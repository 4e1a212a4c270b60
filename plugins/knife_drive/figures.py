"""Diagrams of the folding knife's drives: each over its crank angle, all from the lowest point, accelerations over the stroke."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, pi, sin
from typing import Any

import numpy as np

from diecut_report.api import (
    Chart,
    Drawing,
    Phrase,
    Point,
    Shape,
    View,
    arc,
    chart_panel,
    circle,
    dimension,
    fill,
    label,
    level,
    line,
    mark,
    phrase,
    point,
    polyline,
    vertical,
)
from diecut_report.plugins.knife_drive.comparison import table
from diecut_report.plugins.knife_drive.working import ALL, CRANK_ROCKER, CRANK_SLIDER, PLANETARY, DriveKind

TURN = 2 * pi
CAPTION = (
    "To scale, with the knife's edge at its lowest point; light: at contact with the signature on the table, and with the crank half a "
    "revolution later. "
)


def _table(view: View, edge: Point, level: float, side: int = -1) -> list[Shape]:
    """Table with its slot and the rollers below it, under an edge whose lowest point is given; the depth stands on one side."""
    radius = view["roller_diameter"] / 2
    slot, width = 0.15 * radius, 2.4 * radius
    axes = min(level - radius, edge[1])
    measured = edge[0] + side * width
    return [
        *(polyline([(edge[0] + s * slot, level), (edge[0] + s * width, level)][::s], "ground") for s in (-1, 1)),
        *(circle((edge[0] + s * radius, axes), radius, "body") for s in (-1, 1)),
        *(point((edge[0] + s * radius, axes), "pivot") for s in (-1, 1)),
        label((edge[0] - side * width, level), "table", "left" if side < 0 else "right"),
        dimension((measured, edge[1]), (measured, level), -side * 0.3 * radius, view.text("working_depth")),
    ]


def _rollers(view: View, edge: Point, level: float) -> list[Shape]:
    """Table and rollers alone, which stand while the drive moves."""
    return [shape for shape in _table(view, edge, level) if shape["shape"] in ("polyline", "circle", "point")]


def _chained(places: list[Point]) -> list[Shape]:
    """Links from joint to joint, the first of which is the crank's pivot and the last one the edge."""
    return [polyline(places, "link"), point(places[0], "pivot"), *(point(place, "joint") for place in places[1:-1])]


def _planetary(view: View, phi: float) -> list[Point]:
    """Carrier's axis, planet's axis and edge at a crank angle."""
    radius, height = view["planetary.carrier_radius"], view.at("planetary_displacement", phi % TURN)
    return [(0.0, 0.0), (radius * cos(phi), radius * sin(phi)), (0.0, height)]


def planetary_at(view: View, phi: float) -> list[Shape]:
    """Carrier, planet and knife arm at a crank angle."""
    radius = view["planetary.carrier_radius"]
    places, lowest = _planetary(view, phi), -2 * radius
    return [
        circle((0.0, 0.0), 2 * radius, "centerline"),
        *_rollers(view, (0.0, lowest), lowest + view["working_depth"]),
        circle(places[1], radius, "hidden"),
        *_chained(places),
    ]


def planetary(view: View) -> list[Shape]:
    """Carrier and knife arm in three positions, with the circles that roll in each other."""
    radius, contact = view["planetary.carrier_radius"], view["planetary_contact_angle"]
    lowest = (0.0, -2 * radius)
    shapes = [circle((0.0, 0.0), 2 * radius, "centerline"), circle((0.0, 0.0), radius, "ghost")]
    for phi in (contact, pi / 2):
        shapes.append(polyline(_planetary(view, phi), "ghost"))
    shapes += [circle(_planetary(view, contact)[1], radius, "hidden"), polyline(_planetary(view, 3 * pi / 2), "link")]
    shapes += [
        point((0.0, 0.0), "pivot"),
        point(_planetary(view, contact)[1], "joint"),
        point(_planetary(view, 3 * pi / 2)[1], "joint"),
    ]
    shapes += _table(view, lowest, lowest[1] + view["working_depth"])
    stroke = dimension(lowest, (0.0, 2 * radius), 2.3 * radius, view.text("planetary_stroke"))
    return [*shapes, stroke]


def _slider(view: View, phi: float) -> list[Point]:
    """Crank's pivot, crank pin, knife's joint and edge at a crank angle."""
    crank, rod = view["crank_slider.crank_radius"], view["crank_slider.rod_length"]
    blade = view["working_depth"] + view["roller_diameter"] / 2
    joint = view.at("crank_slider_displacement", phi % TURN) - crank - rod
    return [(0.0, 0.0), (crank * sin(phi), -crank * cos(phi)), (0.0, joint), (0.0, joint - blade)]


def crank_slider_at(view: View, phi: float) -> list[Shape]:
    """Crank, rod and knife at a crank angle."""
    lowest = _slider(view, 0.0)[3]
    crank = circle((0.0, 0.0), view["crank_slider.crank_radius"], "ghost")
    return [crank, *_rollers(view, lowest, lowest[1] + view["working_depth"]), *_chained(_slider(view, phi))]


def crank_slider(view: View) -> list[Shape]:
    """Crank, rod and knife in three positions; the length of the knife is free and chosen here."""
    crank = view["crank_slider.crank_radius"]
    lowest = _slider(view, 0.0)[3]
    contact = _slider(view, view["crank_slider_contact_angle"])
    shapes = [
        circle((0.0, 0.0), crank, "ghost"),
        polyline([(0.0, 1.2 * crank), (0.0, lowest[1] - crank / 2)], "centerline"),
    ]
    shapes += [polyline(places, "ghost") for places in (contact, _slider(view, pi))]
    shapes += [polyline(_slider(view, 0.0), "link"), point((0.0, 0.0), "pivot"), point(contact[1], "joint")]
    shapes += [point(place, "joint") for place in _slider(view, 0.0)[1:3]]
    shapes += _table(view, lowest, lowest[1] + view["working_depth"])
    side = max(crank, 1.25 * view["roller_diameter"])
    return [*shapes, dimension(lowest, _slider(view, pi)[3], -1.3 * side, view.text("crank_slider_stroke"))]


def crank_rocker(view: View) -> list[Shape]:
    """Linkage and knife arm in three positions; the arm lies level in the lowest one, the linkage stands away from the rollers."""
    lowest, contact = view["crank_rocker_lowest_angle"], view["crank_rocker_contact_angle"]
    crank, arm, swing = view["crank_rocker.crank"], view["crank_rocker.knife_arm"], view["crank_rocker_swing_angle"]
    is_outer = view.word("crank_rocker.lowest_dead_center") == "outer"
    low, touching, high = (_joints(view, phi) for phi in (lowest, contact, lowest + pi))
    start = 0.0 if is_outer else pi - swing
    return [
        circle(low[0], crank, "ghost"),
        arc((0.0, 0.0), arm, start, start + swing, "ghost"),
        polyline([low[0], (0.0, 0.0)], "centerline"),
        polyline(touching, "ghost"),
        polyline(high, "ghost"),
        polyline(low, "link"),
        point(low[0], "pivot", "O₁"),
        point(low[3], "pivot", "O₃"),
        *(point(place, "joint") for place in low[1:3]),
        *_table(view, low[4], touching[4][1], 1 if is_outer else -1),
    ]


def crank_rocker_at(view: View, phi: float) -> list[Shape]:
    """Linkage and knife arm at a crank angle."""
    lowest, contact = (_joints(view, view[f"crank_rocker_{place}_angle"]) for place in ("lowest", "contact"))
    places = _joints(view, phi)
    return [
        circle(lowest[0], view["crank_rocker.crank"], "ghost"),
        *_rollers(view, lowest[4], contact[4][1]),
        *_chained(places),
        point(places[3], "pivot"),
    ]


def _joints(view: View, phi: float) -> list[Point]:
    """Crank's pivot, crank pin, rocker's joint, rocker's pivot (the origin) and edge at a crank angle."""
    crank, rocker, frame, arm = (view[f"crank_rocker.{name}"] for name in ("crank", "rocker", "frame", "knife_arm"))
    is_outer = view.word("crank_rocker.lowest_dead_center") == "outer"
    turned = 0.0 if is_outer else -pi / 2  # of the frame: so the linkage stands beside the knife or above it
    beta = _direction(view, phi)
    swung = beta - _direction(view, view["crank_rocker_lowest_angle"]) + (0.0 if is_outer else pi)
    pivot = (-frame * cos(turned), -frame * sin(turned))
    pin = (pivot[0] + crank * cos(phi + turned), pivot[1] + crank * sin(phi + turned))
    joint = (rocker * cos(beta + turned), rocker * sin(beta + turned))
    return [pivot, pin, joint, (0.0, 0.0), (arm * cos(swung), arm * sin(swung))]


def _direction(view: View, phi: float) -> float:
    return view.at("crank_rocker_rocker_direction", phi % TURN)


PLANETARY_DRAWN = Drawing(
    "planetary_drive", "Planetary drive", needs=("planetary",), build=planetary, moving=planetary_at,
    over="crank_angle",
    caption=CAPTION + "The planet (dashed) rolls inside a circle of twice its size (dash-dotted); the edge moves straight up and down.",
)  # fmt: skip
CRANK_SLIDER_DRAWN = Drawing(
    "crank_slider_drive", "Crank-slider drive", needs=("crank_slider",), build=crank_slider, moving=crank_slider_at,
    over="crank_angle",
    caption=CAPTION + "The length of the knife below the rod is arbitrary.",
)  # fmt: skip
CRANK_ROCKER_DRAWN = Drawing(
    "crank_rocker_drive", "Crank-rocker drive", needs=("crank_rocker",), build=crank_rocker, moving=crank_rocker_at,
    over="crank_angle",
    caption=CAPTION + "The angle between rocker and knife arm is arbitrary; here the arm is level at the lowest point.",
)  # fmt: skip


Values = Any
CURVES = (("displacement", phrase("Displacement of the edge"), "mm", "S"), ("velocity", phrase("Velocity of the edge"), "m/s", "V"),
          ("acceleration", phrase("Acceleration of the edge"), "m/s**2", "a"))  # fmt: skip
PLAIN = {"displacement": phrase("displacement"), "velocity": phrase("velocity"), "acceleration": phrase("acceleration")}
FROM_LOWEST = (phrase("Crank angle from the lowest point"), "ψ", "deg")
AROUND = np.linspace(0, TURN, 721)


def given(view: View) -> list[DriveKind]:
    """The drives that are calculated."""
    return [drive for drive in ALL if f"{drive.key}_stroke" in view]


def at(view: View, curve: str, places: Values) -> Values:
    """A curve at crank angles of any turn, between its samples."""
    return np.interp(places, view.curve("crank_angle"), view.curve(curve), period=TURN)


def over_turn(drive: DriveKind) -> Callable[[View], list[Shape]]:
    """Displacement, velocity and acceleration of a drive over its crank angle, the working stroke shaded."""

    def build(view: View) -> list[Shape]:
        lowest, angle = view[f"{drive.key}_lowest_angle"], view[f"{drive.key}_working_angle"]
        edges = np.mod([lowest - angle, lowest], TURN)
        phi = np.sort(np.concatenate([AROUND, edges]))
        within = np.mod(phi - lowest + angle + 1e-9, TURN) <= angle + 2e-9
        panels = []
        for name, title, unit, symbol in CURVES:
            values = at(view, f"{drive.key}_{name}", phi)
            shaded = np.where(within, values, np.nan)
            panels.append(
                chart_panel(title, unit, "Crank angle", "φ", "deg", lines=[line(phi, values, symbol)],
                            fills=[fill(phi, shaded, "working stroke")])
            )  # fmt: skip
        return panels

    return build


def from_lowest(view: View) -> list[Shape]:
    """Speeds and accelerations of all drives with their lowest points in one place."""
    reach = max(view[f"{drive.key}_working_angle"] for drive in given(view))
    last = reach / 3
    psi = np.linspace(-min(1.15 * reach, np.pi), last, 361)
    end = _off_table(view) if _off_table(view) <= np.pi else last
    rollers = [line([0.0, end], [view["roller_velocity"]] * 2, "rollers")]
    speeds, heights = {}, {}
    for drive in given(view):
        places = view[f"{drive.key}_lowest_angle"] + psi
        speeds[drive] = -at(view, f"{drive.key}_velocity", places)
        heights[drive] = at(view, f"{drive.key}_acceleration", places)
    return [
        _common(view, "Speed of the edge towards the rollers", "m/s", psi, speeds, rollers),
        _common(view, phrase("Acceleration of the edge"), "m/s**2", psi, heights, [],
                levels=[level(view["allowable_paper_acceleration"], "allowed")]),
    ]  # fmt: skip


def _off_table(view: View) -> float:
    """Crank angle from the lowest point to where the signature has left the table; boundless where its length is not given."""
    return view["roller_time"] * view["crank_speed"] if "roller_time" in view else np.inf


def _common(
    view: View, title: str, unit: str, psi: Values, curves: dict[DriveKind, Values], more: list[Shape], **notes: Any
) -> Shape:
    """The curves of all drives in one diagram; under each its working stroke is shaded."""
    fills: list[Shape] = []
    for drive, values in curves.items():
        angle = view[f"{drive.key}_working_angle"]
        inside = np.linspace(-angle, 0, 121)
        fills.append(fill(inside, np.interp(inside, psi, values), Phrase("working stroke, {name}", name=drive.name)))
    lines = [line(psi, values, drive.name) for drive, values in curves.items()]
    places = [vertical(-view["grip_angle"], "grip")]
    if _off_table(view) <= np.pi:
        places.append(vertical(_off_table(view), "off the table"))
    return chart_panel(title, unit, *FROM_LOWEST, lines=[*lines, *more], fills=fills, verticals=places, **notes)


def first_order(view: View) -> list[Shape]:
    """The crank-slider's acceleration in its exact and its first-order form, and the differences of all three curves."""
    phi = view.curve("crank_angle")
    own = [(name, unit, symbol, view.curve(f"crank_slider_{name}"), view.curve(f"crank_slider_{name}_first_order"))
           for name, _, unit, symbol in CURVES]  # fmt: skip
    _, unit, _, exact, approximate = own[-1]
    lines = [line(phi, exact, "exact"), line(phi, approximate, "first order")]
    return [
        chart_panel("Acceleration of the edge", unit, "Crank angle", "φ", "deg", lines=lines),
        *(chart_panel(Phrase("Difference of exact and first-order {name}", name=PLAIN[name]), unit, "Crank angle", "φ", "deg",
                      lines=[line(phi, np.subtract(exact, approximate), f"Δ{symbol}")])
          for name, unit, symbol, exact, approximate in own),
    ]  # fmt: skip


def over_stroke(view: View) -> list[Shape]:
    """The acceleration at the lowest point over the stroke, each drive enlarged and made smaller as a whole."""
    sizes = {
        PLANETARY: ("planetary.carrier_radius",),
        CRANK_SLIDER: ("crank_slider.crank_radius", "crank_slider.rod_length"),
        CRANK_ROCKER: ("crank_rocker.knife_arm",),
    }
    longest = 1.1 * max(view[f"{drive.key}_stroke"] for drive in given(view))
    lines, marks = [], []
    for drive in given(view):
        stroke, end = f"{drive.key}_stroke", f"{drive.key}_acceleration_end"
        share = np.linspace(view["working_depth"] * (1 + 1e-9), longest, 41) / view[stroke]
        varied = view.varied({name: view[name] * share for name in sizes[drive]}, stroke, end)
        lines.append(line(varied[stroke], varied[end], drive.name))
        marks.append(mark(view[stroke], view[end], drive.name))
    allowed = [level(view["allowable_paper_acceleration"], "allowed")]
    return [
        chart_panel(
            "Acceleration at the lowest point", "m/s**2", "Stroke", "H", "mm", lines=lines, marks=marks, levels=allowed
        )
    ]


FIGURES = (
    *(Chart(f"{drive.key}_motion", f"Motion of the edge: {drive.name}", needs=(drive.key,), build=over_turn(drive),
            caption="Displacement, velocity and acceleration over the crank angle, counted upwards, with the working stroke shaded "
            f"(figure 2{drive.letter} of 004).")
      for drive in ALL),
    Chart("from_lowest", "The drives from their lowest point", build=from_lowest,
          caption="Speed and acceleration of the edge with the lowest points of all drives aligned, the working strokes shaded; after it the "
                  "rollers lead the signature at their speed (figure 3 of 004)."),
    Drawing("comparison", "Comparison of the drives", build=table, schematic=True,
            caption="Values of each drive and, in brackets, their ratio to those of the best drive, the one with the lowest maximum acceleration "
                    "in the working stroke. Factor: ratio of the acceleration at the end to that of a harmonic motion of the same stroke, so "
                    "that stroke times factor is proportional to the acceleration at the end."),
    Chart("over_stroke", "Acceleration versus stroke", build=over_stroke,
          caption="Acceleration at the lowest point if each drive is scaled as a whole (for the crank-rocker: its knife arm) at this speed. It "
                  "increases with the stroke. The distance between the lines at one stroke is due to the type of drive."),
    Chart("crank_slider_first_order", "Crank-slider: exact and first-order form", needs=(CRANK_SLIDER.key,), build=first_order,
          caption="Acceleration of the edge by both forms, and the difference between the exact form and the form of first order in the ratio of "
                  "crank to rod, r/l, for displacement, velocity and acceleration. Everything else is calculated with the exact form."),
    PLANETARY_DRAWN,
    CRANK_SLIDER_DRAWN,
    CRANK_ROCKER_DRAWN,
)  # fmt: skip
