"""Figures of the gear pair."""

from __future__ import annotations

from math import cos, pi, sin, sqrt, tan

import numpy as np

from diecut_report.api import (
    BarGroup,
    Bars,
    Chart,
    Drawing,
    Panel,
    Plot,
    Point,
    Series,
    Shape,
    View,
    arrow,
    chart_panel,
    dimension,
    label,
    level,
    line,
    mark,
    point,
    polyline,
    region,
)
from diecut_report.mechanics.involute import RackCutTooth
from diecut_report.plugins.gear_pair.inputs import GEARS
from diecut_report.plugins.gear_pair.load import DYNAMIC_KNOWN
from diecut_report.plugins.gear_pair.sizing import MODULES, SAFETIES, SERIES

AROUND = 3  # teeth drawn on each side of the pitch point
RIM = 1.6  # depth of the rim that is drawn, in modules
POINTS = 60  # along a flank


def tooth(view: View, gear: int, *, virtual: bool = False) -> RackCutTooth:
    """A tooth of the gear in modules, in the transverse section or that of the virtual spur gear."""
    teeth = view[f"virtual_teeth_{gear}"] if virtual else view[f"teeth_{gear}"]
    helix = 0.0 if virtual else view["helix_angle"]
    return RackCutTooth(
        teeth, view[f"shift_{gear}"], view["dedendum"], view["root_radius"], view["pressure_angle"], helix
    )


def half_outline(one: RackCutTooth, tip: float) -> tuple[list[float], list[float]]:
    """Radii from root to tip and half the tooth's thickness at them, as angles."""
    share = np.sin(np.linspace(0, pi / 2, POINTS))  # denser at the tip's end, where flanks are steep in angle
    radii = one.root_radius + (tip - one.root_radius) * np.sort(1 - share)
    return list(radii), list(one.half_angles(radii))


def outline(one: RackCutTooth, tip: float, phase: float, count: int) -> list[tuple[float, float]]:
    """The teeth from −count to count as radius and angle, clockwise from the line of centres; ``phase`` is the middle one's."""
    radii, halves = half_outline(one, tip)
    step = 2 * pi / one.teeth
    single = [(r, -h) for r, h in zip(radii, halves, strict=True)] + [
        (r, h) for r, h in zip(radii[::-1], halves[::-1], strict=True)
    ]
    return [(r, phase + k * step + angle) for k in range(-count, count + 1) for r, angle in single]


def _placed(polar: list[tuple[float, float]], center: float, side: int, module: float) -> list[Point]:
    """Points of a gear whose axis stands at (0, center); ``side`` 1 looks up to the pitch point, −1 down."""
    return [(module * r * sin(angle), center + side * module * r * cos(angle)) for r, angle in polar]


def _gear(view: View, gear: int, center: float, side: int, leans: int) -> Shape:
    """One gear's teeth around the pitch point, its loaded flank through it."""
    one, module = tooth(view, gear), view["module"]
    working = view[f"working_diameter_{gear}"] / (2 * module)
    tip = view[f"tip_diameter_{gear}"] / (2 * module)
    phase = leans * float(one.half_angles(np.array([working]))[0])
    teeth = outline(one, tip, phase, min(AROUND, int(one.teeth // 2) - 1))
    rim = max(one.root_radius - RIM, 0.3 * one.root_radius)
    under = [(rim, angle) for angle in np.linspace(teeth[-1][1], teeth[0][1], 40)]
    return region(_placed([*teeth, *under], center, side, module))


def mesh(view: View) -> list[Shape]:
    """Both gears at the pitch point, the line of action, and the path of contact on it."""
    below, above = -view["working_diameter_1"] / 2, view["working_diameter_2"] / 2
    angle = view["working_pressure_angle"]
    recess, approach = _path(view, 1), _path(view, 2)
    reach = 1.5 * max(recess, approach)

    def along(distance: float) -> Point:
        return distance * cos(angle), distance * sin(angle)

    return [
        _gear(view, 1, below, 1, -1),
        _gear(view, 2, above, -1, 1),
        *_circles(view, 1, below, 1),
        *_circles(view, 2, above, -1),
        polyline([along(-reach), along(reach)], "centerline"),
        polyline([along(-approach), along(recess)], "mark"),
        point(along(-approach), "mark", "A"),
        point(along(recess), "mark", "E"),
        point((0.0, 0.0), "mark", "C"),
        arrow(along(recess), along(reach), "mark", view.text("normal_force")),
    ]  # fmt: skip


def _path(view: View, gear: int) -> float:
    """Length of the path of contact from the pitch point to the gear's tip circle."""
    base, tip = view[f"base_diameter_{gear}"] / 2, view[f"tip_diameter_{gear}"] / 2
    return sqrt(tip**2 - base**2) - base * tan(view["working_pressure_angle"])


def _circles(view: View, gear: int, center: float, side: int) -> list[Shape]:
    """The circles of a gear near the teeth; the base circle of a great wheel lies far below its roots."""
    near = view[f"base_diameter_{gear}"] > view[f"root_diameter_{gear}"] - 2 * RIM * view["module"]
    kinds = ("working_diameter", "tip_diameter", *(("base_diameter",) if near else ()))
    return [_circle(view, gear, kind, center, side) for kind in kinds]


def _circle(view: View, gear: int, kind: str, center: float, side: int) -> Shape:
    """A piece of one of the gear's circles, as wide as the teeth that are drawn."""
    radius, wide = view[f"{kind}_{gear}"] / 2, AROUND * pi * view["module"] / cos(view["helix_angle"])
    end = min(wide / radius, pi)
    role = {"working_diameter": "centerline", "base_diameter": "hidden", "tip_diameter": "ghost"}[kind]
    return polyline([(radius * sin(t), center + side * radius * cos(t)) for t in np.linspace(-end, end, 60)], role)


# --- critical sections -----------------------------------------------------------------------------------------------


def roots(view: View) -> list[Shape]:
    """A tooth of each virtual gear with its critical section, the 30° tangents and the load, beside each other."""
    left = _root(view, 1, 0.0)
    return left + _root(view, 2, 5.2 * view["module"])


def _root(view: View, gear: int, offset: float) -> list[Shape]:
    one, module = tooth(view, gear, virtual=True), view["module"]
    bottom = one.root_radius
    radii, halves = half_outline(one, one.teeth / 2 + view[f"tip_height_{gear}"])
    right = [(r * sin(h), r * cos(h)) for r, h in zip(radii, halves, strict=True)]

    def place(x: float, y: float) -> Point:
        return offset + module * x, module * (y - bottom)

    whole = [*right, *((-x, y) for x, y in reversed(right))]
    base = [(-right[0][0], right[0][1] - RIM), (right[0][0], right[0][1] - RIM)]
    chord, level = view[f"chord_{gear}"], _section(view, gear)
    load, half, angle = view[f"load_diameter_{gear}"] / 2, view[f"load_half_angle_{gear}"], view[f"load_angle_{gear}"]
    at = load * sin(half), load * cos(half)
    crossing = level + view[f"load_arm_{gear}"]
    away = 0.9
    return [
        region([place(*p) for p in (*whole, *base)]),
        polyline([place(0, right[0][1] - RIM), place(0, right[-1][1] + 0.4)], "centerline"),
        *(polyline([place(side * (chord / 2 + s * sin(pi / 6)), level - s * cos(pi / 6)) for s in (-away, away)], "ghost") for side in (1, -1)),
        dimension(place(-chord / 2, level), place(chord / 2, level), -0.1 * module, view.text(f"root_chord_{gear}")),
        arrow(place(at[0] + away * cos(angle), at[1] + away * sin(angle)), place(*at), "mark", "F_bn"),
        polyline([place(*at), place(0, crossing)], "hidden"),
        dimension(place(0, level), place(0, crossing), 1.6 * module, f"h_Fe{gear}"),
        label(place(0, right[-1][1] + 0.55), ("pinion", "wheel")[gear - 1], "center"),
    ]  # fmt: skip


def _section(view: View, gear: int) -> float:
    """Distance of the critical section from the axis of the virtual gear, in modules."""
    theta, height = view[f"root_angle_{gear}"], view[f"rounding_height_{gear}"]
    return (view[f"virtual_teeth_{gear}"] * cos(pi / 3 - theta) + height / cos(theta) - view["root_radius"]) / 2


TOLD = {"pitting_safety": "flank, ", "root_safety": "root, "}
SHARES = np.linspace(0.4, 2.0, 33)  # of the face width
NEIGHBOURS = 4  # modules of the series on each side of the chosen one


def reserves(view: View) -> list[Shape]:
    """What the safeties reach of those required, over the module; over the face width where the distance of the axes is given."""
    if "module_least" in view:
        chosen, title, symbol, key = view["module"], "Normal module", "m_n", "module"
        nearest = int(np.argmin(abs(SERIES - chosen)))
        values = np.unique([*SERIES[max(nearest - NEIGHBOURS, 0) : nearest + NEIGHBOURS + 1], chosen])
    else:
        chosen, title, symbol, key = view["face_width"], "Face width", "b", "face_width"
        values = SHARES * chosen
    found = view.varied({key: values}, *SAFETIES)
    lines = [line(values, found[name] / view[required], _told(name)) for name, required in SAFETIES.items()]
    least = min(view[name] / view[required] for name, required in SAFETIES.items())
    return [
        chart_panel("Ratio of safety factor to the required one", "1", title, symbol, MODULES.unit, lines=lines,
                    marks=[mark(chosen, least, "chosen")], levels=[level(1.0, "required")])
    ]  # fmt: skip


def _told(name: str) -> str:
    kind, gear = name[:-2], int(name[-1])
    return TOLD[kind] + GEARS[gear]


FIGURES = (
    Drawing(
        "mesh",
        "Teeth in mesh",
        "Transverse section to scale, the pinion below: involutes, and roots as cut by the rounded tips of the rack. Dash-dotted: the "
                "working pitch circles and the line of action; dashed: the base circles; light: the tip circles. The path of contact runs from A "
                "to E; here contact is at the pitch point C.",
        build=mesh,
    ),
    Drawing(
        "roots",
        "Critical sections of the tooth roots",
        "Normal section of the virtual spur gears, to scale. Light: the tangents at 30°, which touch the root fillet at its critical "
                "section; the load acts at the outer point of single pair tooth contact, h_Fe is its moment arm about that section.",
        build=roots,
    ),
    Bars(
        "stresses",
        "Stresses and safety factors",
        "Contact and tooth root stresses of both gears, and their safety factors.",
        groups=(
            BarGroup(
                "Contact stress",
                "MPa",
                bars=(("nominal", "nominal_contact_stress"), ("pinion", "contact_stress_1"), ("wheel", "contact_stress_2")),
            ),
            BarGroup("Tooth root stress", "MPa", bars=(("pinion", "root_stress_1"), ("wheel", "root_stress_2"))),
            BarGroup(
                "Safety",
                "1",
                bars=(
                    ("flank, pinion", "pitting_safety_1"),
                    ("flank, wheel", "pitting_safety_2"),
                    ("root, pinion", "root_safety_1"),
                    ("root, wheel", "root_safety_2"),
                ),
            ),
        ),
        needs=(DYNAMIC_KNOWN,),
    ),
    Chart(
        "reserves",
        "Safety factors versus module",
        "Ratio of the safety factors of flank and root to the required ones, with other modules of the preferred series and all else "
                "unchanged; where the centre distance is given, with other face widths.",
        build=reserves,
        needs=(DYNAMIC_KNOWN,),
    ),
    Plot(
        "force_over_cycle",
        "Force and contact stress over the cycle",
        "Tangential force at the reference circle, with the sign of the torque, and the pinion's contact "
                "stress.",
        abscissa="cycle_angle",
        panels=(
            Panel("Tangential force", "N", series=(Series("tangential_force_curve", "F_t"),)),
            Panel("Contact stress of the pinion", "MPa", series=(Series("contact_stress_curve", "σ_H1"),)),
        ),
        needs=("torque_curve", DYNAMIC_KNOWN),
    ),
)  # fmt: skip
