"""The drives drawn to scale over table and rollers: in the lowest position, at the contact (light) and at the top (light)."""

from __future__ import annotations

from math import cos, pi, sin

from diecut_report.api import Drawing, Point, Shape, View, arc, circle, dimension, label, point, polyline

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
    id="planetary_drive", title="Planetary drive", needs=("planetary",), build=planetary, moving=planetary_at,
    over="crank_angle",
    caption=CAPTION + "The planet (dashed) rolls inside a circle of twice its size (dash-dotted); the edge moves straight up and down.",
)  # fmt: skip
CRANK_SLIDER_DRAWN = Drawing(
    id="crank_slider_drive", title="Crank-slider drive", needs=("crank_slider",), build=crank_slider, moving=crank_slider_at,
    over="crank_angle",
    caption=CAPTION + "The length of the knife below the rod is arbitrary.",
)  # fmt: skip
CRANK_ROCKER_DRAWN = Drawing(
    id="crank_rocker_drive", title="Crank-rocker drive", needs=("crank_rocker",), build=crank_rocker, moving=crank_rocker_at,
    over="crank_angle",
    caption=CAPTION + "The angle between rocker and knife arm is arbitrary; here the arm is level at the lowest point.",
)  # fmt: skip
