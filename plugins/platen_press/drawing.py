"""The platen press drawn to scale. The shaft turns about the origin; the platen's pins run along the x-axis."""

from __future__ import annotations

from math import asin, cos, pi, sin, sqrt

from diecut_report.api import (
    Point,
    Shape,
    View,
    arc,
    circle,
    dimension,
    label,
    point,
    polyline,
    radius_dimension,
    rigid,
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
