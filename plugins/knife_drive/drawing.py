"""The drives drawn to scale over table and rollers: in the lowest position, at the contact (light) and at the top (light)."""

from __future__ import annotations

from math import asin, cos, pi, sin

from diecut_report.api import Drawing, Point, Shape, View, arc, circle, dimension, label, point, polyline

CAPTION = "To scale, with the knife's edge at its lowest point; light: as it meets the signature on the table, and with the crank half a turn on. "


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


def planetary(view: View) -> list[Shape]:
    """Carrier and knife arm in three positions, with the circles that roll in each other."""
    radius, contact = view["planetary.carrier_radius"], view["planetary_contact_angle"]

    def chain(phi: float) -> list[Point]:
        return [(0.0, 0.0), (radius * cos(phi), radius * sin(phi)), (0.0, 2 * radius * sin(phi))]

    lowest = (0.0, -2 * radius)
    shapes = [circle((0.0, 0.0), 2 * radius, "centerline"), circle((0.0, 0.0), radius, "ghost")]
    for phi in (contact, pi / 2):
        shapes.append(polyline(chain(phi), "ghost"))
    shapes += [circle(chain(contact)[1], radius, "hidden"), polyline(chain(3 * pi / 2), "link")]
    shapes += [point((0.0, 0.0), "pivot"), point(chain(contact)[1], "joint"), point(chain(3 * pi / 2)[1], "joint")]
    shapes += _table(view, lowest, lowest[1] + view["working_depth"])
    stroke = dimension(lowest, (0.0, 2 * radius), 2.3 * radius, view.text("planetary_stroke"))
    return [*shapes, stroke]


def crank_slider(view: View) -> list[Shape]:
    """Crank, rod and knife in three positions; the length of the knife is free and chosen here."""
    crank, rod = view["crank_slider.crank_radius"], view["crank_slider.rod_length"]
    blade = view["working_depth"] + view["roller_diameter"] / 2
    lowest = (0.0, -crank - rod - blade)

    def chain(phi: float) -> list[Point]:
        pin = (crank * sin(phi), -crank * cos(phi))
        far = -crank * cos(phi) - rod * cos(asin(crank * sin(phi) / rod))
        return [(0.0, 0.0), pin, (0.0, far), (0.0, far - blade)]

    contact = chain(view["crank_slider_contact_angle"])
    shapes = [
        circle((0.0, 0.0), crank, "ghost"),
        polyline([(0.0, 1.2 * crank), (0.0, lowest[1] - crank / 2)], "centerline"),
    ]
    shapes += [polyline(places, "ghost") for places in (contact, chain(pi))]
    shapes += [polyline(chain(0.0), "link"), point((0.0, 0.0), "pivot"), point(contact[1], "joint")]
    shapes += [point(place, "joint") for place in chain(0.0)[1:3]]
    shapes += _table(view, lowest, lowest[1] + view["working_depth"])
    side = max(crank, 1.25 * view["roller_diameter"])
    return [*shapes, dimension(lowest, chain(pi)[3], -1.3 * side, view.text("crank_slider_stroke"))]


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
    return view.at("crank_rocker_rocker_direction", phi % (2 * pi))


PLANETARY_DRAWN = Drawing(
    id="planetary_drive", title="Planetary drive", needs=("planetary",), build=planetary,
    caption=CAPTION + "The planet (dashed) rolls inside a circle of twice its size (dash-dotted); the edge goes straight up and down.",
)  # fmt: skip
CRANK_SLIDER_DRAWN = Drawing(
    id="crank_slider_drive", title="Crank-slider drive", needs=("crank_slider",), build=crank_slider,
    caption=CAPTION + "The length of the knife below the rod is free and chosen here.",
)  # fmt: skip
CRANK_ROCKER_DRAWN = Drawing(
    id="crank_rocker_drive", title="Crank-rocker drive", needs=("crank_rocker",), build=crank_rocker,
    caption=CAPTION + "The angle between rocker and knife arm is free; here the arm lies level at the lowest point.",
)  # fmt: skip
