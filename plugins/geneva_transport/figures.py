"""Figures of the Geneva drive."""

from __future__ import annotations

from math import cos, pi, sin
from typing import Any

import numpy as np

from diecut_report.api import (
    Chart,
    Drawing,
    Point,
    Shape,
    View,
    chart_panel,
    circle,
    dimension,
    level,
    line,
    mark,
    phrase,
    point,
    polyline,
    radius_dimension,
    rigid,
    vertical,
)
from diecut_report.plugins.geneva_transport import formulas


def _around(center: Point, radius: float, start: float, end: float, points: int = 25) -> list[Point]:
    return [(center[0] + radius * cos(a), center[1] + radius * sin(a)) for a in np.linspace(start, end, points)]


def _slot(view: View) -> list[Point]:
    """A slot's outline along +x from the wheel's axis, from its lower to its upper mouth."""
    half, inner = view["roller_radius"], view["nearest_distance"]
    mouth = view["wheel_radius"]
    return [(mouth, -half), *_around((inner, 0.0), half, -pi / 2, -3 * pi / 2), (mouth, half)]


def _holds(view: View) -> bool:
    """Whether the locking disc reaches into the wheel."""
    return view["rim_distance"] < view["disc_radius"]


def _tip(view: View) -> tuple[float, float]:
    """Where the tip of an arm begins and ends on the rim: from a slot's corner to the locking arc."""
    rim, center, step = view["rim_radius"], view["center_distance"], view["step_angle"]
    corner = float(np.arctan2(view["roller_radius"], view["wheel_radius"]))
    if not _holds(view):
        return corner, step / 2
    radius = min(view["locking_radius"], view["flank_distance"])  # where the arc cuts the slots, the arms end
    return corner, step / 2 - float(np.arccos((center**2 + rim**2 - radius**2) / (2 * center * rim)))


def _rim(view: View) -> list[Point]:
    """The rim from one slot (along +x) to the next one, with the locking arc where the disc reaches the wheel."""
    rim, step, (corner, end) = view["rim_radius"], view["step_angle"], _tip(view)
    first, last = _around((0.0, 0.0), rim, corner, end, 9), _around((0.0, 0.0), rim, step - end, step - corner, 9)
    if not _holds(view):
        return [*first, *last]
    center = (view["center_distance"] * cos(step / 2), view["center_distance"] * sin(step / 2))
    start = float(np.arctan2(first[-1][1] - center[1], first[-1][0] - center[0])) % (2 * pi)
    radius = float(np.hypot(first[-1][0] - center[0], first[-1][1] - center[1]))
    return [*first, *_around(center, radius, start, 2 * pi + step - start, 41), *last]


def _turned(points: list[Point], angle: float, center: Point) -> list[Point]:
    return [
        (center[0] + x * cos(angle) - y * sin(angle), center[1] + x * sin(angle) + y * cos(angle)) for x, y in points
    ]


def wheel_outline(view: View, angle: float) -> list[Point]:
    """The wheel's outline; at angle 0 a slot points to the crank's axis. A positive angle turns it as it moves."""
    return _turned(wheel(view), pi - angle, (view["center_distance"], 0.0))


def wheel(view: View) -> list[Point]:
    """The wheel's outline about its axis, a slot along +x."""
    one = [*_slot(view), *_rim(view)[1:-1]]
    steps = range(round(view["slots"]))
    return [p for k in steps for p in _turned(one, k * view["step_angle"], (0.0, 0.0))]


def disc_outline(view: View, angle: float) -> list[Point]:
    """The locking disc's outline with the roller at a crank angle; empty where it does not reach the wheel."""
    if not _holds(view):
        return []
    half = view["engagement_half_angle"]
    arc = _around((0.0, 0.0), view["disc_radius"], half, 2 * pi - half, 121)
    opening = pi / 2 - half  # the hollow as seen from its centre
    hollow = _around((view["relief_distance"], 0.0), view["relief_radius"], pi + opening, pi - opening, 61)
    return _turned([*arc, *hollow[1:-1]], angle, (0.0, 0.0))


def _machine(view: View, crank: float, wheel: float, offset: float = 0.0) -> list[Shape]:
    """Wheel, disc and crank in one position, set off to the right."""

    def moved(points: list[Point]) -> list[Point]:
        return [(x + offset, y) for x, y in points]

    radius, distance = view["crank_radius"], view["center_distance"]
    roller = (offset + radius * cos(crank), radius * sin(crank))
    disc = disc_outline(view, crank)
    return [
        polyline(moved(wheel_outline(view, wheel)), "body", closed=True),
        *([polyline(moved(disc), "body", closed=True)] if disc else []),
        polyline([(offset, 0.0), roller], "link"),
        circle(roller, view["roller_radius"], "mark"),
        circle((offset, 0.0), radius, "ghost"),
        polyline([(offset - 0.15 * distance, 0.0), (offset + 1.15 * distance, 0.0)], "centerline"),
        point((offset, 0.0), "pivot"),
        point((offset + distance, 0.0), "pivot"),
    ]


def at_entry(view: View) -> list[Shape]:
    """The instant of entry, with the main dimensions."""
    half, step, radius = view["engagement_half_angle"], view["step_angle"], view["crank_radius"]
    distance, rim, roller = view["center_distance"], view["rim_radius"], view["roller_radius"]
    entry = (radius * cos(half), -radius * sin(half))
    last = round(view["slots"]) // 2  # the slot that points away from the crank
    shapes = [
        *_machine(view, -half, -step / 2),
        circle((radius, 0.0), roller, "ghost"),
        circle((entry[0], -entry[1]), roller, "ghost"),
        dimension((0.0, 0.0), (distance, 0.0), -1.12 * max(rim, radius + roller), view.text("center_distance")),
        radius_dimension((0.0, 0.0), radius, 0.8 * pi, view.text("crank_radius")),
        radius_dimension(
            (distance, 0.0), rim, pi + step / 2 + last * step + sum(_tip(view)) / 2, view.text("rim_radius")
        ),
        radius_dimension(entry, roller, -0.6 * pi, view.text("roller_radius")),
    ]
    return (
        [*shapes, radius_dimension((0.0, 0.0), view["disc_radius"], 0.55 * pi, view.text("disc_radius"))]
        if _holds(view)
        else shapes
    )


def positions(view: View) -> list[Shape]:
    """The middle of the motion and, beside it, the middle of the dwell."""
    apart = view["center_distance"] + view["rim_radius"] + 1.35 * view["crank_radius"] + view["roller_radius"]
    return [*_machine(view, 0.0, 0.0), *_machine(view, pi, view["step_angle"] / 2, apart)]


def _driven(view: View) -> list[Shape]:
    return [polyline(wheel(view), "body", closed=True)]


def _driving(view: View) -> list[Shape]:
    """The crank with its roller and the locking disc, along +x."""
    disc, roller = disc_outline(view, 0.0), (view["crank_radius"], 0.0)
    locking = [polyline(disc, "body", closed=True)] if disc else []
    return [*locking, polyline([(0.0, 0.0), roller], "link"), circle(roller, view["roller_radius"], "mark")]


def turning(view: View, crank: float) -> list[Shape]:
    """Wheel, disc and crank at a crank angle."""
    distance = view["center_distance"]
    return [
        rigid(view.once(_driven), (distance, 0.0), pi - view.at("wheel_angle", crank)),
        rigid(view.once(_driving), (0.0, 0.0), crank),
        point((0.0, 0.0), "pivot"),
        point((distance, 0.0), "pivot"),
    ]


COUNTED = (
    "Angles are measured from the middle of the motion: values of α above 180° in the results are shown here 360° lower, at the same "
    "position."
)
FROM_MIDDLE = (phrase("Crank angle from the middle of the motion"), "α", "deg")
OVER = "crank_angle"
Curves = dict[str, Any]


def over_engagement(view: View) -> Curves:
    """The wheel's motion from the roller's entry to its exit: crank angle, wheel angle, speed and acceleration ratio."""
    half, ratio = view["engagement_half_angle"], view["crank_ratio"]
    alpha = np.linspace(-half, half, 241)
    return {
        "alpha": alpha,
        "angle": formulas.wheel_angle(alpha, 0, view["step_angle"], ratio),
        "speed": formulas.speed_ratio(alpha, ratio),
        "acceleration": formulas.acceleration_ratio(alpha, ratio),
    }


def over_turn(view: View) -> Curves:
    """The same over a turn, with the dwell before and after it; where the acceleration jumps it has both values."""
    curves = over_engagement(view)
    step = view["step_angle"] / 2
    ends = {"alpha": (-np.pi, curves["alpha"][0], curves["alpha"][-1], np.pi), "angle": (-step, -step, step, step)}
    return {name: np.concatenate([ends.get(name, np.zeros(4))[:2], values, ends.get(name, np.zeros(4))[2:]])
            for name, values in curves.items()}  # fmt: skip


def panel(title: str, unit: str, alpha: Any, values: Any, label: str, view: View, **more: Any) -> Shape:
    """One curve over the crank angle, with entry and exit."""
    half = view["engagement_half_angle"]
    edges = [vertical(-half, "entry"), vertical(half, "exit")]
    return chart_panel(
        title, unit, *FROM_MIDDLE, lines=[line(alpha, values, label)], verticals=edges, over=OVER, **more
    )


def motion(view: View) -> list[Shape]:
    """Angle, speed and acceleration of the wheel over a turn of the crank."""
    curves, speed = over_turn(view), view["crank_speed"]
    alpha, peak = curves["alpha"], view["wheel_acceleration_max"]
    top = [mark(-view["acceleration_peak_angle"], peak, "maximum")]
    return [
        panel("Angle of the wheel", "deg", alpha, curves["angle"], "ψ", view),
        panel("Speed of the wheel", "rad/s", alpha, formulas.rate(curves["speed"], speed), "ω₂", view),
        panel("Acceleration of the wheel", "rad/s**2", alpha, formulas.rate_of_rate(curves["acceleration"], speed), "ε₂", view, marks=top),
    ]  # fmt: skip


def sheet(view: View) -> list[Shape]:
    """Position, velocity and acceleration of the sheet over a turn of the crank."""
    curves, speed, radius = over_turn(view), view["crank_speed"], view["travel_radius"]
    alpha, allowed = curves["alpha"], "allowable_sheet_acceleration"
    top = [mark(-view["acceleration_peak_angle"], view["sheet_acceleration_max"], "maximum")]
    bounds = [level(view[allowed], "allowed")] if allowed in view else []
    velocity = formulas.travel_rate(curves["speed"], speed, radius)
    acceleration = formulas.travel_acceleration(curves["acceleration"], speed, radius)
    return [
        panel("Position of the sheet", "mm", alpha, formulas.travel(curves["angle"], radius), "x", view),
        panel("Velocity of the sheet", "m/s", alpha, velocity, "v", view),
        panel("Acceleration of the sheet", "m/s**2", alpha, acceleration, "a", view, marks=top, levels=bounds),
    ]


def engagement(view: View) -> list[Shape]:
    """Torque and roller force while the roller is in the slot."""
    curves, speed = over_engagement(view), view["crank_speed"]
    parts = (view["driven_inertia"], view["own_inertia"], view["efficiency"])
    inertia = np.where(
        formulas.is_driven(curves["acceleration"]),
        formulas.driven_with_losses(*parts),
        formulas.braked_with_losses(*parts),
    )
    alpha = curves["alpha"]
    torque = formulas.driving_torque(inertia, speed, curves["acceleration"], curves["speed"])
    distance = formulas.roller_distance(alpha, view["center_distance"], view["crank_ratio"])
    force = formulas.roller_force(inertia, formulas.rate_of_rate(curves["acceleration"], speed), distance)
    places = {name: view[f"{name}_at"] - 2 * np.pi for name in ("torque_peak", "roller_force_peak")}
    return [
        chart_panel("Torque at the crank", "N*m", *FROM_MIDDLE, lines=[line(alpha, torque, "M")],
                    marks=[mark(places["torque_peak"], view["torque_peak"], "maximum")], verticals=[vertical(0.0, "middle")], over=OVER),
        chart_panel("Roller force", "N", *FROM_MIDDLE, lines=[line(alpha, force, "F")],
                    marks=[mark(places["roller_force_peak"], view["roller_force_peak"], "maximum")],
                    verticals=[vertical(0.0, "middle: the roller changes flanks")], over=OVER),
    ]  # fmt: skip


FIGURES = (
    Drawing(
        "entry",
        "Geneva drive at the roller's entry",
        "Wheel, crank with roller and locking disc to scale at the instant of entry: crank and slot are perpendicular to each other, and "
        "the disc's edge is on the line of centres. Light: the roller's path, the roller in the middle of the motion and at its exit.",
        build=at_entry,
        moving=turning,
        over="crank_angle",
    ),
    Drawing(
        "positions",
        "Middle of the motion, and dwell",
        "Left: in the middle of the motion the disc's cut-out lets the arms pass. Right: in the dwell the disc holds the wheel.",
        build=positions,
    ),
    Chart(
        "motion",
        "Motion of the wheel over a turn",
        "Angle, speed and acceleration of the wheel over a revolution of the crank, with the motion in the middle. The speed begins and "
        "ends without a jump, the acceleration jumps at entry and exit. " + COUNTED,
        build=motion,
    ),
    Chart(
        "sheet",
        "Motion of the sheet over a turn",
        "Position, velocity and acceleration of the sheet over a revolution of the crank, with the motion in the middle. "
        + COUNTED,
        needs=("sprocket_teeth", "chain_pitch"),
        build=sheet,
    ),
    Chart(
        "engagement",
        "Torque and roller force over the engagement",
        "Before the middle the roller drives the wheel; after it the wheel drives the crank, and the roller bears on the other flank of "
        "the slot. " + COUNTED,
        needs=("driven_inertia",),
        build=engagement,
    ),
)
