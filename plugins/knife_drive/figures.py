"""Diagrams of the folding knife's drives: each over its crank angle, all from the lowest point, accelerations over the stroke."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from diecut_report.api import (
    Chart,
    Drawing,
    Phrase,
    Shape,
    View,
    chart_panel,
    fill,
    level,
    line,
    mark,
    phrase,
    vertical,
)
from diecut_report.plugins.knife_drive.drawing import CRANK_ROCKER_DRAWN, CRANK_SLIDER_DRAWN, PLANETARY_DRAWN
from diecut_report.plugins.knife_drive.table import table
from diecut_report.plugins.knife_drive.working import ALL, CRANK_ROCKER, CRANK_SLIDER, PLANETARY, DriveKind

Values = Any
CURVES = (("displacement", phrase("Displacement of the edge"), "mm", "S"), ("velocity", phrase("Velocity of the edge"), "m/s", "V"),
          ("acceleration", phrase("Acceleration of the edge"), "m/s**2", "a"))  # fmt: skip
PLAIN = {"displacement": phrase("displacement"), "velocity": phrase("velocity"), "acceleration": phrase("acceleration")}
FROM_LOWEST = (phrase("Crank angle from the lowest point"), "ψ", "deg")
TURN = 2 * np.pi
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
    *(Chart(id=f"{drive.key}_motion", title=f"Motion of the edge: {drive.name}", needs=(drive.key,), build=over_turn(drive),
            caption="Displacement, velocity and acceleration over the crank angle, counted upwards, with the working stroke shaded "
            f"(figure 2{drive.letter} of 004).")
      for drive in ALL),
    Chart(id="from_lowest", title="The drives from their lowest point", build=from_lowest,
          caption="Speed and acceleration of the edge with the lowest points of all drives aligned, the working strokes shaded; after it the "
                  "rollers lead the signature at their speed (figure 3 of 004)."),
    Drawing(id="comparison", title="Comparison of the drives", build=table, schematic=True,
            caption="Values of each drive and, in brackets, their ratio to those of the best drive, the one with the lowest maximum acceleration "
                    "in the working stroke. Factor: ratio of the acceleration at the end to that of a harmonic motion of the same stroke, so "
                    "that stroke times factor is proportional to the acceleration at the end."),
    Chart(id="over_stroke", title="Acceleration versus stroke", build=over_stroke,
          caption="Acceleration at the lowest point if each drive is scaled as a whole (for the crank-rocker: its knife arm) at this speed. It "
                  "increases with the stroke. The distance between the lines at one stroke is due to the type of drive."),
    Chart(id="crank_slider_first_order", title="Crank-slider: exact and first-order form", needs=(CRANK_SLIDER.key,), build=first_order,
          caption="Acceleration of the edge by both forms, and the difference between the exact form and the form of first order in the ratio of "
                  "crank to rod, r/l, for displacement, velocity and acceleration. Everything else is calculated with the exact form."),
    PLANETARY_DRAWN,
    CRANK_SLIDER_DRAWN,
    CRANK_ROCKER_DRAWN,
)  # fmt: skip
