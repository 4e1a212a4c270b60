"""Figures of the Geneva drive."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import Chart, Drawing, Shape, View, chart_panel, level, line, mark, phrase, vertical
from diecut_report.plugins.geneva_transport import formulas, loads
from diecut_report.plugins.geneva_transport.drawing import at_entry, positions, turning

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
        loads.is_driven(curves["acceleration"]), loads.driven_with_losses(*parts), loads.braked_with_losses(*parts)
    )
    alpha = curves["alpha"]
    torque = loads.driving_torque(inertia, speed, curves["acceleration"], curves["speed"])
    distance = loads.roller_distance(alpha, view["center_distance"], view["crank_ratio"])
    force = loads.roller_force(inertia, formulas.rate_of_rate(curves["acceleration"], speed), distance)
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
        id="entry",
        title="Geneva drive at the roller's entry",
        caption="Wheel, crank with roller and locking disc to scale at the instant of entry: crank and slot are perpendicular to each other, and "
        "the disc's edge is on the line of centres. Light: the roller's path, the roller in the middle of the motion and at its exit.",
        build=at_entry,
        moving=turning,
        over="crank_angle",
    ),
    Drawing(
        id="positions",
        title="Middle of the motion, and dwell",
        caption="Left: in the middle of the motion the disc's cut-out lets the arms pass. Right: in the dwell the disc holds the wheel.",
        build=positions,
    ),
    Chart(
        id="motion",
        title="Motion of the wheel over a turn",
        caption="Angle, speed and acceleration of the wheel over a revolution of the crank, with the motion in the middle. The speed begins and "
        "ends without a jump, the acceleration jumps at entry and exit. " + COUNTED,
        build=motion,
    ),
    Chart(
        id="sheet",
        title="Motion of the sheet over a turn",
        caption="Position, velocity and acceleration of the sheet over a revolution of the crank, with the motion in the middle. "
        + COUNTED,
        needs=("sprocket_teeth", "chain_pitch"),
        build=sheet,
    ),
    Chart(
        id="engagement",
        title="Torque and roller force over the engagement",
        caption="Before the middle the roller drives the wheel; after it the wheel drives the crank, and the roller bears on the other flank of "
        "the slot. " + COUNTED,
        needs=("driven_inertia",),
        build=engagement,
    ),
)
