"""Figures of the toothed belt."""

from __future__ import annotations

from diecut_report.api import Drawing, Phrase, Shape, View, arrow, circle, label, point, polyline, radius_dimension
from diecut_report.plugins.drive_train.layout import layout


def belt_layout(view: View) -> list[Shape]:
    """The belt over its pulleys, and where it can be known the cylinder on the die."""
    x, y, radius = (view.row(f"toothed_belt.pulleys.{key}") for key in ("x", "y", "radius"))
    wraps = [view.word(f"wraps.{i}") for i in range(len(x))]
    drawn = layout(x, y, radius, view.row("pulley_side"), [Phrase("{wraps}, driving", wraps=wraps[0]), *wraps[1:]])
    roles = view.words("toothed_belt.pulleys.role")
    return drawn + (_cylinder(view, roles.index("cylinder")) if "cylinder" in roles else [])


def _cylinder(view: View, pulley: int) -> list[Shape]:
    """The cylinder behind its pulley, rolling on the die."""
    x, y = (view.row(f"toothed_belt.pulleys.{key}")[pulley] for key in ("x", "y"))
    radius = view["toothed_belt.cylinder_radius"]
    return [
        circle((x, y), radius, "ghost"),
        polyline([(x - 2 * radius, y - radius), (x + 2 * radius, y - radius)], "ground"),
        label((x + 0.75 * radius, y + 0.8 * radius), Phrase("cylinder, on pulley {pulley}", pulley=pulley + 1)),
        label((x - 1.95 * radius, y - 0.9 * radius), "die"),
    ]


def cylinder_on_belt(view: View) -> list[Shape]:
    """The cylinder rolling on the die, its pulley on the belt; the arrows are as long as carriage and belt are fast."""
    radius, driven = view["toothed_belt.cylinder_radius"], view["toothed_belt.driven_radius"]
    velocity, speed = view["toothed_belt.cylinder_velocity"], view["belt_speed"]
    sign = 1 if view.word("toothed_belt.engagement") == "away" else -1
    reach, above = 1.7 * max(radius, driven), sign * driven + 0.07 * max(radius, driven)
    scale = 0.6 * reach / max(velocity, speed)
    return [
        polyline([(-reach, -radius), (reach, -radius)], "ground"),
        circle((0.0, 0.0), radius),
        circle((0.0, 0.0), driven, "centerline"),
        polyline([(-reach, sign * driven), (reach, sign * driven)], "link"),
        point((0.0, 0.0), "pivot"),
        arrow((0.0, 0.0), (velocity * scale, 0.0), text=view.text("toothed_belt.cylinder_velocity")),
        arrow((0.0, above), (speed * scale, above), text=view.text("belt_speed")),
        radius_dimension((0.0, 0.0), radius, 2.4, view.text("toothed_belt.cylinder_radius")),
        radius_dimension((0.0, 0.0), driven, 3.9 if sign > 0 else 1.2, view.text("toothed_belt.driven_radius")),
        label((-0.99 * reach, -0.93 * radius), "die"),
    ]


TOOTHED_BELT_FIGURES = (
    Drawing(
        id="toothed_belt_rolling",
        title="Cylinder on the toothed belt",
        caption="The cylinder on the die to scale with its pulley (dash-dotted: pitch circle) and the belt; the arrows show the velocities of "
        "carriage and belt. The die lies below: the belt runs over the pulley where this engages away from the die, and below it where "
        "it engages on the die side.",
        build=cylinder_on_belt,
        needs=("toothed_belt",),
    ),
    Drawing(
        id="toothed_belt_layout",
        title="Toothed belt",
        caption="The belt's pitch line over its pulleys to scale; at each axis the number of the pulley, in the order in which the belt meets "
        "it, and its wrap; the first one drives. The arrow beside the longest span points along the order. The die lies below: the "
        "cylinder (thin circle) is drawn on it where one of the pulleys is fixed to the cylinder.",
        build=belt_layout,
        needs=("toothed_belt", "toothed_belt.pulleys"),
    ),
)
