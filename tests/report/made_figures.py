"""Figures made by hand, of every kind that a mechanism may bring: charts, belts, cams, forces, schematics."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from diecut_report.results.figure_record import FigureRecord

Data = dict[str, Any]
Point = tuple[float, float]
LAWS = (
    "cycloidal",
    "harmonic",
    "parabolic",
    "modified sine",
    "modified trapezoidal",
    "polynomial 3-4-5",
    "polynomial 4-5-6-7",
)


def values(array: Any) -> list[float | None]:
    """Numbers as results hold them."""
    return [float(v) if math.isfinite(v) else None for v in np.ravel(array)]


def line(x: Any, y: Any, label: str = "") -> Data:
    """A line or an area of a chart."""
    return {"x": values(x), "y": values(y), "label": label}


def panel(title: str, unit: str, x: tuple[str, str, str], **more: Any) -> Data:
    """A panel of a chart."""
    empty: Data = {"lines": [], "fills": [], "marks": [], "levels": [], "verticals": []}
    return {"title": title, "unit": unit, "x": dict(zip(("title", "symbol", "unit"), x, strict=True))} | empty | more


def chart(name: str, title: str, panels: list[Data]) -> FigureRecord:
    """A chart."""
    return FigureRecord(id=name, title=title, caption=f"{title}, made up.", type="chart", panels=panels)


def drawing(name: str, title: str, shapes: list[Data], unit: str = "mm", *, schematic: bool = False) -> FigureRecord:
    """A drawing."""
    return FigureRecord(
        id=name,
        title=title,
        caption=f"{title}, made up.",
        type="drawing",
        unit=unit,
        shapes=shapes,
        schematic=schematic,
    )


# charts
def wedge() -> FigureRecord:
    """A fan of lines over an angle, each with a gap where it has no value, a mark and a limit."""
    angle = np.radians(np.linspace(2, 30, 113))
    lines = []
    for friction in (0.05, 0.1, 0.15, 0.2, 0.25):
        force = 7143.0 * np.tan(angle + math.atan(friction))
        lines.append(line(angle, np.where(np.tan(angle) > friction, force, np.nan), f"f = {friction}"))
    over = ("Wedge angle", "α", "deg")
    marks = [{"x": math.radians(10), "y": 2009.192, "label": "chosen"}]
    verticals = [{"x": math.atan(0.1), "label": "self-locking below this angle"}]
    levels = [{"value": 4500.0, "label": "greatest force of the cylinder"}]
    return chart("wedge", "Engagement force versus wedge angle",
                 [panel("Engagement force", "kN", over, lines=lines, marks=marks, verticals=verticals, levels=levels)])  # fmt: skip


def laws() -> FigureRecord:
    """Seven lines that run close to each other, in three panels over one abscissa that is no angle."""
    k = np.linspace(0, 1, 201)
    over = ("Share of the time", "k", "1")
    shapes = [np.sin(np.pi * k) ** (1 + 0.12 * n) for n in range(len(LAWS))]
    speeds = [line(k, (1.75 + 0.07 * n) * s, law) for n, (s, law) in enumerate(zip(shapes, LAWS, strict=True))]
    rises = [line(k, np.cumsum(s) / s.sum(), law) for s, law in zip(shapes, LAWS, strict=True)]
    pulls = [
        line(k, (4.8 + 0.35 * n) * np.sin(2 * np.pi * k) * s**0.2, law)
        for n, (s, law) in enumerate(zip(shapes, LAWS, strict=True))
    ]
    titles = ("Position", "Velocity", "Acceleration")
    return chart("laws", "Motion laws for the same dwell",
                 [panel(t, "1", over, lines=lines) for t, lines in zip(titles, (rises, speeds, pulls), strict=True)])  # fmt: skip


def block() -> FigureRecord:
    """Two panels with an abscissa of their own: an area under a line, and a falling line."""
    way = np.linspace(0, 0.0837, 60)
    force = 21428.0 * way
    first = panel(
        "Force", "N", ("Deflection", "h", "mm"), lines=[line(way, force, "P")], fills=[line(way, force, "absorbed energy 75 J")],
        marks=[{"x": 0.0837, "y": float(force[-1]), "label": "at the stop"}],
    )  # fmt: skip
    stress = np.linspace(0.8e6, 2.4e6, 60)
    length = 2 * 150 * 8e6 / (2 * stress**2 * 1.5e-3)
    second = panel(
        "Free length", "mm", ("Allowable stress", "[σ]", "MPa"), lines=[line(stress, length, "H")],
        marks=[{"x": 1.2e6, "y": 0.55556, "label": "this block"}], levels=[{"value": 0.09, "label": "no buckling up to"}],
    )  # fmt: skip
    return chart("block", "Damper block", [first, second])


def energy() -> FigureRecord:
    """Areas of both signs, one of them too small for its name, and named boundaries."""
    angle = np.linspace(0, 2 * math.pi, 361)
    torque = 30 + 60 * np.sin(angle) + 25 * np.sin(3 * angle)
    above, below = np.where(torque >= 30, torque - 30, np.nan), np.where(torque < 30, torque - 30, np.nan)
    small = np.where(np.abs(angle - 6.1) < 0.05, 9.0, np.nan)
    over = ("Angle of the flywheel shaft", "φ_f", "deg")
    verticals = [
        {"x": x, "label": name} for x, name in ((0.0, "I"), (math.pi / 2, "II"), (math.pi, "III"), (4.8, "IV"))
    ]
    return chart("energy", "Torque and energy over a turn", [
        panel("Torque less its mean", "N*m", over, lines=[line(angle, torque - 30, "excess torque")], verticals=verticals,
              fills=[line(angle, above, "taken up"), line(angle, below, "given back"), line(angle, small, "a very small area")]),
        panel("Energy", "J", over, lines=[line(angle, np.cumsum(torque - 30) * 2 * math.pi / 361, "E"), line(angle, 50 + 0 * angle, "mean")],
              levels=[{"value": 130.0, "label": "greatest"}, {"value": -2.0, "label": "least"}]),
    ])  # fmt: skip


# drawings
def circle(center: Point, radius: float, role: str = "outline") -> Data:
    """A circle."""
    return {"shape": "circle", "center": list(center), "radius": radius, "role": role}


def polyline(points: Any, role: str = "outline", *, closed: bool = False) -> Data:
    """A polyline."""
    return {"shape": "polyline", "points": [[float(x), float(y)] for x, y in points], "closed": closed, "role": role}


def label(at: Point, text: str, anchor: str = "left") -> Data:
    """A text."""
    return {"shape": "label", "at": list(at), "text": text, "anchor": anchor}


def arrow(start: Point, end: Point, text: str = "", role: str = "mark") -> Data:
    """An arrow."""
    return {"shape": "arrow", "from": list(start), "to": list(end), "role": role} | ({"label": text} if text else {})


def box(center: Point, size: Point, *lines: str, role: str = "outline") -> Data:
    """A box with text."""
    return {
        "shape": "box",
        "center": list(center),
        "width": size[0],
        "height": size[1],
        "role": role,
        "lines": list(lines),
    }


def dimension(start: Point, end: Point, offset: float, text: str) -> Data:
    """A dimension."""
    return {"shape": "dimension", "from": list(start), "to": list(end), "offset": offset, "text": text}


def belt() -> FigureRecord:
    """Twelve pulleys with names, the belt around them, its direction."""
    turns = [2 * math.pi * k / 12 for k in range(12)]
    centers = [(0.9 * math.cos(t), 0.45 * math.sin(t)) for t in turns]
    rim = [(x * 1.07, y * 1.13) for x, y in centers]
    shapes = [circle(c, 0.05, "body") for c in centers]
    shapes += [{"shape": "point", "at": list(c), "role": "pivot"} for c in centers]
    shapes += [label((x * 1.2, y * 1.25), f"pulley {n}, r = {50 + n} mm, wrap {20 + 3 * n}.0°", "left" if x > 0 else "right")
               for n, (x, y) in enumerate(centers, 1)]  # fmt: skip
    return drawing(
        "belt",
        "Layout of the belt",
        [*shapes, polyline(rim, "link", closed=True), arrow((0.3, 0.2), (-0.3, 0.2), "belt speed V = 1.57 m/s")],
    )


def conveyor() -> FigureRecord:
    """Very wide and low, with a long name at its end."""
    chain = [(0.1, 0.1), (3.9, 0.1), (3.9, -0.1), (0.1, -0.1)]
    ends = [circle((0.1, 0), 0.1, "body"), circle((3.9, 0), 0.1, "body")]
    return drawing("conveyor", "Conveyor", [
        *ends, polyline(chain, "link", closed=True), dimension((0.1, -0.1), (3.9, -0.1), -0.2, "3800 mm"),
        arrow((1.5, 0.18), (2.5, 0.18), "sheet", "outline"), label((4.05, 0), "sprocket of the driven shaft, z = 18", "left"),
        label((-0.05, 0), "tensioning sprocket, z = 18", "right"),
    ])  # fmt: skip


def press() -> FigureRecord:
    """Very tall and narrow."""
    frame = [(-0.15, 0), (0.15, 0), (0.15, 2.2), (-0.15, 2.2)]
    return drawing("press", "Frame of the press", [
        polyline(frame, "body", closed=True), circle((0, 1.9), 0.1, "section"), circle((0, 1.1), 0.105, "outline"), circle((0, 0.4), 0.07, "outline"),
        label((0.2, 1.9), "flywheel"), label((0.2, 1.1), "impression cylinder"), label((0.2, 0.4), "crank shaft"),
        dimension((-0.15, 0), (-0.15, 2.2), 0.08, "2200 mm"), dimension((-0.15, 2.2), (0.15, 2.2), 0.06, "300 mm"),
    ])  # fmt: skip


def cam() -> FigureRecord:
    """A cam with its pitch curve and roller, to scale."""
    turn = np.linspace(0, 2 * math.pi, 720, endpoint=False)
    radius = 0.06 + 0.012 * np.sin(turn) ** 2 * (turn < math.pi)
    pitch, profile = (np.column_stack([(radius - r) * np.cos(turn), (radius - r) * np.sin(turn)]) for r in (0.0, 0.01))
    roller = tuple(pitch[60])
    return drawing(
        "cam",
        "Cam",
        [
            {
                "shape": "region",
                "outer": profile.tolist(),
                "holes": [[[0.01 * math.cos(a), 0.01 * math.sin(a)] for a in np.linspace(0, 6.2, 40)]],
                "role": "section",
            },
            polyline(pitch, "centerline", closed=True),
            circle(roller, 0.01, "body"),
            {"shape": "point", "at": list(roller), "role": "pivot", "label": "roller"},
            {"shape": "point", "at": [0, 0], "role": "pivot", "label": "O_1"},
            {"shape": "radius_dimension", "center": [0, 0], "radius": 0.05, "angle": 4.0, "text": "R = 50 mm"},
        ],
    )


def forces() -> FigureRecord:
    """A force triangle: lengths are forces, with no scale bar."""
    return drawing(
        "forces",
        "Force triangle of the wedge",
        [
            arrow((0, 0), (7.143, 0), "P = 7143 N", "outline"),
            arrow((7.143, 0), (7.143, 2.009), "P_1 = 2009 N"),
            arrow((0, 0), (7.143, 2.009), "resultant", "link"),
            arrow((5.0, -1.0), (5.15, -1.0), "friction", "outline"),
            arrow((2.0, -1.0), (2.0, -1.0), "nothing"),
        ],
        "1",
        schematic=True,
    )


def row_of_boxes(count: int) -> FigureRecord:
    """Boxes side by side with five lines each, arrows with words between them."""
    shapes = []
    for n in range(count):
        shapes.append(
            box((1.5 * n, 0), (1, 1), f"Shaft {n + 1}", "main shaft", "n = 150.0 rpm", "M = 1234 N·m", "P = 19.39 kW")
        )
        if n:
            shapes.append(arrow((1.5 * n - 1, 0), (1.5 * n - 0.5, 0), "V-belt SPA, i = 3.15", "outline"))
    return drawing(f"row{count}", f"{count} shafts in a row", shapes, "1", schematic=True)


def chain() -> FigureRecord:
    """Shafts below each other with wheels between them and boxes of numbers."""
    shapes = [box((9, 0), (18, 12), "Motor", "5.5 kW")]
    for n in range(4):
        y = -24.0 * n
        shapes += [
            polyline([(18 if n == 0 else 41 + 14 * n - 18, y), (51 + 14 * n, y)]),
            polyline([(51 + 14 * n, y), (104, y)], "centerline"),
        ]
        title = ("motor", "flywheel", "main shaft", "output")[n]
        shapes.append(
            box(
                (132, y),
                (56, 13),
                f"Shaft {n + 1}: {title}",
                f"{1450 / 2**n:.1f} rpm · {29.6 * 2**n:.1f} N·m · 4.500 kW",
            )
        )
    for n in range(3):
        y, x = -24.0 * n, 46 + 14.0 * n
        shapes += [polyline([(x - 1.5, y - 7), (x + 1.5, y - 7), (x + 1.5, y + 7), (x - 1.5, y + 7)], "body", closed=True),
                   polyline([(x - 1.5, y - 41), (x + 1.5, y - 41), (x + 1.5, y - 7), (x - 1.5, y - 7)], "body", closed=True),
                   label((x - 5, y - 12), f"z = {20 + n} : {40 + n}", "right")]  # fmt: skip
    return drawing("chain", "Kinematic chain", shapes, "1", schematic=True)


CHARTS = (wedge, laws, block, energy)
DRAWINGS = (belt, conveyor, press, cam, forces, chain)


def all_figures() -> list[FigureRecord]:
    """Every figure once."""
    return [build() for build in (*CHARTS, *DRAWINGS)] + [row_of_boxes(5), row_of_boxes(9)]
