"""Figures of the platen press: motion, forces and torque about the dead centre (figures 2 and 3 of the source), and over a turn."""

from __future__ import annotations

from math import asin, cos, pi, sin, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import (
    Chart,
    Drawing,
    Mark,
    Panel,
    Plot,
    Point,
    Series,
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
    radius_dimension,
    rigid,
    vertical,
)

SHOWN = -pi / 3  # crank angle of the main position: a sixth of a turn before the dead centre


def _joints(view: View, phi: float) -> tuple[Point, Point]:
    """Crank pin and platen's pin at a crank angle."""
    r, rod = view["crank_radius"], view["rod_length"]
    pin = (-r * cos(phi), r * sin(phi))
    return pin, (pin[0] + sqrt(rod**2 - pin[1] ** 2), 0.0)


def _platen(view: View, at: float) -> list[Point]:
    """The platen about its pins; its size is free and chosen here."""
    width, half = 1.3 * view["platen_pin_radius"], 2.2 * view["crank_radius"]
    return [(at - width, -half), (at + width, -half), (at + width, half), (at - width, half)]


def machine(view: View) -> list[Shape]:
    """Crank, rod and platen a sixth of a turn before the dead centre, light: closed and open."""
    r, gap = view["crank_radius"], 1.3 * view["platen_pin_radius"]
    (pin, platen), (_, shut), (_, far) = (_joints(view, phi) for phi in (SHOWN, 0.0, pi))
    height = 2.2 * r
    return [
        circle((0.0, 0.0), r, "ghost"),
        polyline(_platen(view, shut[0]), "ghost", closed=True),
        polyline(_platen(view, far[0]), "ghost", closed=True),
        polyline(_platen(view, platen[0]), "body", closed=True),
        polyline([(shut[0] - gap, -1.3 * height), (shut[0] - gap, 1.3 * height)], "ground"),
        polyline([(-1.3 * r, 0.0), (far[0] + 2 * gap, 0.0)], "centerline"),
        polyline([(0.0, 0.0), pin, platen], "link"),
        circle((0.0, 0.0), view["journal_radius"]),
        circle(pin, view["crank_pin_radius"]),
        circle(platen, view["platen_pin_radius"]),
        point((0.0, 0.0), "pivot", "O"),
        point(pin, "joint", "A"),
        point(platen, "joint", "B"),
        label((shut[0] - gap, 1.4 * height), "die", "right"),
        label((far[0] + gap, 1.1 * height), "platen, open", "right"),
        radius_dimension((0.0, 0.0), r, 0.75 * pi, view.text("crank_radius")),
        dimension(pin, platen, -1.5 * height, view.text("rod_length")),
        dimension((shut[0], 0.0), (far[0], 0.0), -1.7 * height, view.text("stroke")),
    ]  # fmt: skip


def turning(view: View, phi: float) -> list[Shape]:
    """Crank, rods and platen at a crank angle: on the die the rods stretch, and the platen stands until they have relaxed."""
    r, gap, height = view["crank_radius"], 1.3 * view["platen_pin_radius"], 2.2 * view["crank_radius"]
    shut = view["rod_length"] - r
    pin, platen = (-r * cos(phi), r * sin(phi)), (shut + view.at("platen_displacement_true", phi), 0.0)
    own = [polyline(_platen(view, 0.0), "body", closed=True), circle((0.0, 0.0), view["platen_pin_radius"])]
    return [
        circle((0.0, 0.0), r, "ghost"),
        polyline([(shut - gap, -1.3 * height), (shut - gap, 1.3 * height)], "ground"),
        rigid(own, platen),
        polyline([(0.0, 0.0), pin, platen], "link"),
        circle((0.0, 0.0), view["journal_radius"]),
        circle(pin, view["crank_pin_radius"]),
        point((0.0, 0.0), "pivot"),
        point(pin, "joint"),
        point(platen, "joint"),
    ]


def relaxed(view: View) -> list[Shape]:
    """The shaft where the rods have relaxed: the line of the rods, its arm and that of friction."""
    r, arm, friction = view["crank_radius"], view["elastic_arm"], view["friction_arm"]
    pin, _ = _joints(view, view["dwell_end_angle"])
    tilt = asin(pin[1] / view["rod_length"])
    foot = (arm * sin(tilt), arm * cos(tilt))
    end = (0.9 * r, pin[1] - (0.9 * r - pin[0]) * sin(tilt) / cos(tilt))
    return [
        circle((0.0, 0.0), friction, "mark"),
        circle((0.0, 0.0), view["journal_radius"], "ghost"),
        arc((0.0, 0.0), r, pi - 0.5, pi + 0.5, "ghost"),
        polyline([(-1.2 * r, 0.0), (1.0 * r, 0.0)], "centerline"),
        polyline([(0.0, 0.0), pin], "link"),
        polyline([pin, end], "outline"),
        polyline([(0.0, 0.0), foot], "hidden"),
        point((0.0, 0.0), "pivot", "O"),
        point(pin, "joint", "A"),
        label((end[0], end[1] + 0.05 * r), "rods, to B", "right"),
        label((0.1 * r, foot[1] + 0.12 * r), view.text("elastic_arm")),
        radius_dimension((0.0, 0.0), friction, -0.3 * pi, view.text("friction_arm")),
    ]  # fmt: skip


POINTS = 28_801  # over the turn, of which a small part about the dead centre is drawn
MARGIN = 1.2  # of what is drawn to the angles of cutting and relaxing
FROM_DEAD_CENTER = (phrase("Crank angle from the dead centre"), "φ", "deg")
SOURCE_PEAK = 5100.0  # N·m, printed by 001, conclusion 1
SOURCE_MACHINE = {
    "cutting_force_max": 5e5, "platen_mass": 306.0, "drive_deformation": 4.5e-4, "material_thickness": 5e-4, "crank_radius": 0.11,
    "rod_length": 0.635, "journal_radius": 0.05025, "crank_pin_radius": 0.0475, "platen_pin_radius": 0.06, "friction_platen_pin": 0.1,
    "friction_crank_pin": 0.1, "friction_journal": 0.1, "crank_speed": 2 * np.pi / 3,
}  # fmt: skip


def about_dead_center(view: View, *names: str) -> tuple[NDArray[Any], dict[str, NDArray[Any]]]:
    """Crank angles from before contact to after the dwell, negative before the dead centre, and curves there."""
    turn, curves = view.varied_curves({}, *names, points=POINTS)
    before = turn >= 2 * np.pi - MARGIN * view["cutting_start_angle"]
    after = turn <= MARGIN * max(view["dwell_end_angle"], view["cutting_start_angle"] / 2)
    angle = np.concatenate([turn[before] - 2 * np.pi, turn[after]])
    return angle, {name: np.concatenate([values[before], values[after]]) for name, values in curves.items()}


def panel(view: View, title: str, unit: str, lines: list[Shape], **more: Any) -> Shape:
    """One diagram about the dead centre, with contact, dead centre and the end of the dwell."""
    events = [
        vertical(-view["cutting_start_angle"], "contact"),
        vertical(0.0, "dead centre"),
        vertical(view["dwell_end_angle"], "relaxed"),
    ]
    return chart_panel(title, unit, *FROM_DEAD_CENTER, lines=lines, verticals=events, over="crank_angle", **more)


def is_source_machine(view: View) -> bool:
    """Whether this is the machine whose torque the source prints."""
    return all(bool(np.isclose(view[name], value, rtol=1e-6)) for name, value in SOURCE_MACHINE.items())


def forces(view: View) -> list[Shape]:
    """Force of the rods, with that of the guides where there is one, and their stretch, about the dead centre."""
    guided = "guide_length" in view
    angle, curves = about_dead_center(view, "force", "rod_stretch", *(["guide_friction"] if guided else []))
    lines = [line(angle, curves["force"], "F" if not guided else "F, without the guides")]
    if guided:
        against = -np.sign(angle) * curves["guide_friction"]
        lines.append(line(angle, curves["force"] + against, "with the friction of the guides"))
    return [
        panel(view, "Force of the rods", "kN", lines),
        panel(view, "Elongation of the rods", "mm", [line(angle, curves["rod_stretch"], "Δl")]),
    ]


def cutting(view: View) -> list[Shape]:
    """Displacement, speed and torque about the dead centre."""
    names = ("platen_displacement", "platen_displacement_true", "platen_velocity_ideal", "platen_velocity_true",
             "torque", "torque_useful", "torque_friction")  # fmt: skip
    angle, found = about_dead_center(view, *names)
    displacement, displacement_true, velocity, velocity_true, torque, useful, friction = (found[name] for name in names)
    is_shown = view["torque_max_angle"] <= MARGIN * view["cutting_start_angle"]
    peak = [mark(-view["torque_max_angle"], view["torque_max"], "maximum")] if is_shown else []
    return [
        panel(view, "Displacement", "mm", [line(angle, displacement, "ideal"), line(angle, displacement_true, "true")]),
        panel(view, "Speed", "mm/s", [line(angle, velocity, "ideal"), line(angle, velocity_true, "true")]),
        panel(view, "Torque", "N*m", [line(angle, torque, "torque"), line(angle, useful, "useful and elastic"), line(angle, friction, "friction")],
              marks=peak),
    ]  # fmt: skip


def beside_source(view: View) -> list[Shape]:
    """The torque beside eq. 14 as printed, up to the dead centre."""
    angle, curves = about_dead_center(view, "torque", "torque_source", "torque_friction")
    cut = (angle <= 0) & (angle >= -view["cutting_start_angle"])
    cut[np.flatnonzero(angle == 0)[1:]] = False
    phi, torque, printed = angle[cut], curves["torque"][cut], curves["torque_source"][cut]
    levels = [level(SOURCE_PEAK, "printed")] if is_source_machine(view) else []
    peaks = (("torque_max", "corrected"), ("torque_max_source", "eq. 14"))
    marks = [
        mark(-view[f"{name}_angle"], view[name], label)
        for name, label in peaks
        if view[name] > 0 and view[f"{name}_angle"] <= view["cutting_start_angle"]
    ]
    return [
        chart_panel("Torque while cutting", "N*m", *FROM_DEAD_CENTER,
                    lines=[line(phi, torque, "corrected"), line(phi, printed, "eq. 14 as printed")],
                    fills=[fill(phi, curves["torque_friction"][cut], "friction")],
                    marks=marks, levels=levels, over="crank_angle"),
    ]  # fmt: skip


def thickness(view: View) -> list[Shape]:
    """Greatest torque and work over the thickness of the board."""
    own = view["material_thickness"]
    boards = np.linspace(0.2, 2.5, 93) * own
    found = view.varied(
        {"material_thickness": boards}, "torque_max", "torque_max_source", "work_per_cycle", "friction_work"
    )
    at = ("Thickness of the board", "s", "mm")
    return [
        chart_panel("Maximum torque", "N*m", *at, lines=[line(boards, found["torque_max"], "corrected"),
                    line(boards, found["torque_max_source"], "eq. 14 as printed")], marks=[mark(own, view["torque_max"], "this board")]),
        chart_panel("Work of a cycle", "J", *at, lines=[line(boards, found["work_per_cycle"], "all"),
                    line(boards, found["friction_work"], "friction")], marks=[mark(own, view["work_per_cycle"], "this board")]),
    ]  # fmt: skip


FIGURES = (
    Drawing(
        "machine",
        "Crank, rods and platen",
        "The mechanism to scale a sixth of a revolution before the dead centre, with journal, crank pin and platen's pin; light: the "
                "platen closed and open. The size of the platen and the position of the die on it are arbitrary.",
        build=machine,
        moving=turning,
        over="crank_angle",
    ),
    Chart(
        "cutting",
        "Displacement, speed and torque around the dead centre",
        "Figure 3 of 001: before the dead centre the board is cut and the rods elongate, so that the platen is slower than its drive; "
                "after it the platen stands until the rods have relaxed. Torque from cutting, elongation and inertia, torque from friction, and "
                "their sum; while the rods relax they drive the crank.",
        build=cutting,
    ),
    Chart(
        "forces",
        "Force and elongation of the rods around the dead centre",
        "Figure 2 of 001: the force of both rods increases with the elongation up to the dead centre and decreases with it while the "
                "platen stands. A force or weight offset from the axis of the guides adds the guides' friction while the platen moves.",
        build=forces,
    ),
    Chart(
        "source",
        "Torque while cutting, compared with eq. 14",
        "At the dead centre both give the friction of the joints alone, P_max·X less the share of the inertia force. Before it the force "
                "has an arm too: that of crank and rods, or, in eq. 14, a shorter one by the platen's slower true speed. Arm and force together "
                "make the peaks before the dead centre. The 5100 N·m that 001 prints for its machine lie 2 % above P_max·X, friction alone at "
                "the dead centre, where the force is maximum: both torques pass it before, and the number leaves out the peak of its own "
                "equation.",
        build=beside_source,
    ),
    Chart(
        "thickness",
        "Thickness of the board",
        "A thicker board with the same maximum force is met sooner, where the arm is longer: not only the work increases, as 001 "
                "concludes, but also the maximum torque.",
        build=thickness,
    ),
    Drawing(
        "relaxed",
        "Relaxed rods and friction",
        "The shaft to scale where the rods have relaxed: as long as the line of the rods passes the shaft at a distance a_d less than "
                "the friction arm X, the rods do not drive the crank.",
        build=relaxed,
    ),
    Plot(
        "turn",
        "Motion and torque over a revolution",
        "Displacement, speed and torque over a revolution of the crank from the inner dead centre.",
        abscissa="crank_angle",
        panels=(
            Panel("Displacement", "mm", series=(Series("platen_displacement", "u"),)),
            Panel("Speed", "m/s", series=(Series("platen_velocity_true", "true"),
                                                     Series("platen_velocity_first_order", "ideal, first order"))),
            Panel("Torque", "N*m", series=(Series("torque", "M"),),
                  marks=(Mark("torque_max_at", "torque_max", "maximum"),)),
        ),
    ),
)  # fmt: skip
