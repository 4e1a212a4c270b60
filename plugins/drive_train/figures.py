"""Figures of the drive train."""

from __future__ import annotations

from collections.abc import Sequence
from math import atan2

from diecut_report.api import (
    Drawing,
    Level,
    Mark,
    Panel,
    Phrase,
    Plot,
    Point,
    Series,
    Shape,
    View,
    arc,
    arrow,
    box,
    circle,
    dimension,
    joined,
    label,
    phrase,
    point,
    polyline,
    radius_dimension,
    told,
)
from diecut_report.mechanics import belt_path


def layout(
    x: Sequence[float], y: Sequence[float], radius: Sequence[float], side: Sequence[float], wraps: Sequence[str] = ()
) -> list[Shape]:
    """Shapes of a belt over pulleys (m) in the order in which it meets them, counter-clockwise; side +1 inside, -1 outside.

    ``wraps`` are the wraps as texts, which stand beside the pulleys' numbers.
    """
    belt = belt_path.path(x, y, [s * r for s, r in zip(side, radius, strict=True)])
    leave, meet = (
        [*zip(map(float, a), map(float, b), strict=True)]
        for a, b in ((belt.leave_x, belt.leave_y), (belt.meet_x, belt.meet_y))
    )
    shapes: list[Shape] = []
    for i, center in enumerate(zip(x, y, strict=True)):
        ends = (meet[i - 1], leave[i]) if side[i] > 0 else (leave[i], meet[i - 1])
        shapes += _pulley(center, radius[i], ends, float(belt.wraps[i]))
        shapes.append(polyline([leave[i], meet[i]], "link"))
        shapes.append(point(center, "pivot", Phrase("{i}: {wrap}", i=i + 1, wrap=wraps[i]) if wraps else f"{i + 1}"))
    return [*shapes, _direction(leave, meet)]


def _pulley(center: Point, radius: float, ends: tuple[Point, Point], wrap: float) -> list[Shape]:
    """Pitch circle, rays to the ends of the wrap, and the belt on it, counter-clockwise from the first end."""
    start = atan2(ends[0][1] - center[1], ends[0][0] - center[0])
    return [
        circle(center, radius, "centerline"),
        *(polyline([center, end], "ghost") for end in ends),
        arc(center, radius, start, start + wrap, "link"),
    ]


def _direction(leave: Sequence[Point], meet: Sequence[Point]) -> Shape:
    """An arrow beside the longest run, outside the loop, in the direction in which the belt meets the pulleys."""
    runs = [(m[0] - p[0], m[1] - p[1]) for p, m in zip(leave, meet, strict=True)]
    longest = max(range(len(runs)), key=lambda i: runs[i][0] ** 2 + runs[i][1] ** 2)
    (px, py), (dx, dy) = leave[longest], runs[longest]
    off = 0.06 * max(abs(dx), abs(dy)) / (dx**2 + dy**2) ** 0.5
    start, end = ((px + share * dx + off * dy, py + share * dy - off * dx) for share in (0.4, 0.6))
    return arrow(start, end)


def vbelt_layout(view: View) -> list[Shape]:
    """Both pulleys with the belt, the motor's on the left and turning counter-clockwise: the upper run is tight."""
    wraps = [view.text("vbelt_wrap"), view.text("vbelt_wrap_large")]
    r1, r2, a = view["vbelt.driver_diameter"] / 2, view["driven_diameter"] / 2, view["center_distance"]
    return [
        polyline([(-1.15 * r1, 0.0), (a + 1.1 * r2, 0.0)], "centerline"),
        *layout([0.0, a], [0.0, 0.0], [r1, r2], [1.0, 1.0], wraps if r1 <= r2 else wraps[::-1]),
        dimension((0.0, 0.0), (a, 0.0), -1.3 * max(r1, r2), view.text("center_distance")),
        dimension((0.0, -r1), (0.0, r1), 1.4 * r1, view.text("vbelt.driver_diameter")),
        dimension((a, -r2), (a, r2), -1.2 * r2, view.text("driven_diameter")),
        *_loads(view, a),
    ]


def _loads(view: View, a: float) -> list[Shape]:
    """The load of the belts at rest on both shafts, along the line of centres."""
    if view["shaft_load"] == 0:
        return []
    size = 0.25 * a
    return [
        arrow((0.0, 0.0), (size, 0.0), text=view.text("shaft_load")),
        arrow((a, 0.0), (a - size, 0.0)),
    ]


VBELT_LAYOUT = Drawing(
    "vbelt_layout",
    "V-belt",
    "The belt drive to scale with the wraps: 1 the motor pulley, 2 the flywheel pulley. With the direction of rotation shown by the "
    "arrow beside the belt, the upper span is the tight side; the arrows at the axes are the static loads of the belts on the shafts.",
    build=vbelt_layout,
)


BELT_AT, BOX_LEFT, BOX_WIDTH, HIGHEST = 46.0, 104.0, 56.0, 100.0
WHEEL = 3.0  # width of pulleys and gears


def shaft_values(view: View, quantity: str) -> list[float]:
    """Speed, torque or power (SI) of all shafts, from the motor's on."""
    behind = view.row(f"gear_shaft_{quantity}") if "gear_shaft_speed" in view else []
    return [view[f"shaft_1_{quantity}"], view[f"shaft_2_{quantity}"], *behind]


def _wheel(x: float, y: float, radius: float, role: str = "body", width: float = WHEEL) -> Shape:
    """A pulley, gear or flywheel from the side."""
    left, right = x - width / 2, x + width / 2
    return polyline(
        [(left, y - radius), (right, y - radius), (right, y + radius), (left, y + radius)], role, closed=True
    )


def _numbers(view: View, heights: list[float], tall: float) -> list[Shape]:
    """For each shaft a box with its number, speed, torque and power."""
    last = len(heights)
    driven = phrase("flywheel") if "flywheel_inertia" in view else phrase("driven pulley")
    names = {1: phrase("motor"), 2: driven}
    speeds, torques, powers = (shaft_values(view, name) for name in ("speed", "torque", "power"))
    shapes = []
    for i, y in enumerate(heights):
        role = joined(
            [name for name in (names.get(i + 1, ""), phrase("output") if i + 1 == last else "") if name], ", "
        )
        values = f"{told(speeds[i], 'rpm')} · {told(torques[i], 'N*m')} · {told(powers[i], 'kW')}"
        title = Phrase("Shaft {i}", i=i + 1) + (Phrase(": {role}", role=role) if role else "")
        shapes.append(box((BOX_LEFT + BOX_WIDTH / 2, y), BOX_WIDTH, tall, [title, values]))
    return shapes


def _belt(view: View, top: float, bottom: float) -> list[Shape]:
    """Both pulleys with the belt between them."""
    room = 0.36 * (top - bottom)
    ratio = min(view["vbelt_ratio_actual"], 2.5)
    small, large = 2 * room / (1 + ratio), 2 * room * ratio / (1 + ratio)
    sides = [BELT_AT - 0.5, BELT_AT + 0.5]
    return [
        *(polyline([(x, top + small), (x, bottom - large)], "link") for x in sides),
        _wheel(BELT_AT, top, small),
        _wheel(BELT_AT, bottom, large),
        label((BELT_AT - 6, (top + bottom) / 2), Phrase("V-belt {word}, {vbelt_ratio_actual} : 1", word=view.word("vbelt.section"),
                                                        vbelt_ratio_actual=told(view["vbelt_ratio_actual"], "1")), "right"),
    ]  # fmt: skip


def _pair(x: float, top: float, bottom: float, teeth: tuple[float, float], form: str) -> list[Shape]:
    """A pair of gears: discs from the side, or two cones that meet where their shafts would cross."""
    ratio = min(max(teeth[1] / teeth[0], 0.4), 2.5)
    driver = (top - bottom) / (1 + ratio)
    driven = top - bottom - driver
    wheels = (
        _cones(x, top, bottom, driver, driven)
        if form == "bevel"
        else [_wheel(x, top, driver), _wheel(x, bottom, driven)]
    )
    numbers = f"z = {teeth[0]:.0f} : {teeth[1]:.0f}"
    return [
        *wheels,
        label((x - 6, bottom - 4), Phrase("bevel, {teeth}", teeth=numbers) if form == "bevel" else numbers, "right"),
    ]


def _cones(x: float, top: float, bottom: float, driver: float, driven: float) -> list[Shape]:
    """Two cone frustums whose teeth meet; the driven shaft is turned into the plane of the schematic."""
    return [
        polyline(
            [
                (x - WHEEL, top - driver),
                (x + WHEEL, top - 0.6 * driver),
                (x + WHEEL, top + 0.6 * driver),
                (x - WHEEL, top + driver),
            ],
            "body",
            closed=True,
        ),
        polyline(
            [
                (x - WHEEL, bottom + driven),
                (x + WHEEL, bottom + 0.6 * driven),
                (x + WHEEL, bottom - 0.6 * driven),
                (x - WHEEL, bottom - driven),
            ],
            "body",
            closed=True,
        ),
    ]


def chain(view: View) -> list[Shape]:
    """Shafts below each other, the motor's on top; wheels stand on them, boxes of numbers beside them."""
    pairs = (
        list(zip(view.row("gears.driver_teeth"), view.row("gears.driven_teeth"), view.words("gears.form"), strict=True))
        if "gear_shaft_speed" in view
        else []
    )
    step = min(24.0, HIGHEST / (len(pairs) + 2))
    heights = [-step * i for i in range(len(pairs) + 2)]
    apart = min(18.0, 36.0 / max(len(pairs), 1))
    places = [BELT_AT, *(BELT_AT + 8 + apart * (i + 1) for i in range(len(pairs)))]
    shapes: list[Shape] = [
        shape
        for x, top, bottom, (driver, driven, form) in zip(places[1:], heights[1:], heights[2:], pairs, strict=False)
        for shape in _pair(x, top, bottom, (driver, driven), form)
    ]
    ends = [*(x + 5 for x in places), BOX_LEFT - 4]
    starts = [18.0, *(x - 5 for x in places)]
    for left, right, y in zip(starts, ends, heights, strict=True):
        line: list[Point] = [(left, y), (right, y)]
        shapes += [polyline(line, "outline"), polyline([(right, y), (BOX_LEFT, y)], "centerline")]
    if "flywheel_inertia" in view:
        shapes.append(_wheel(BELT_AT + 8, heights[1], 0.45 * step, "section", 4.0))
        shapes.append(label((BELT_AT + 8, heights[1] - 0.45 * step - 4), "flywheel", "center"))
    motor = box((9.0, 0.0), 18.0, 12.0, ["Motor", told(view["motor_power"], "kW")])
    return [*shapes, *_belt(view, heights[0], heights[1]), motor, *_numbers(view, heights, 0.55 * step)]


CHAIN = Drawing(
    "chain",
    "Kinematic chain",
    "Shafts with their mean speed, torque and power, losses included; the shafts are numbered from the motor. Not to scale.",
    build=chain,
    schematic=True,
)


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
        "toothed_belt_rolling",
        "Cylinder on the toothed belt",
        "The cylinder on the die to scale with its pulley (dash-dotted: pitch circle) and the belt; the arrows show the velocities of "
        "carriage and belt. The die lies below: the belt runs over the pulley where this engages away from the die, and below it where "
        "it engages on the die side.",
        build=cylinder_on_belt,
        needs=("toothed_belt",),
    ),
    Drawing(
        "toothed_belt_layout",
        "Toothed belt",
        "The belt's pitch line over its pulleys to scale; at each axis the number of the pulley, in the order in which the belt meets "
        "it, and its wrap; the first one drives. The arrow beside the longest span points along the order. The die lies below: the "
        "cylinder (thin circle) is drawn on it where one of the pulleys is fixed to the cylinder.",
        build=belt_layout,
        needs=("toothed_belt", "toothed_belt.pulleys"),
    ),
)


TURN = Plot(
    "energy",
    "Torque and energy over a turn",
    "Torque at the flywheel shaft, negative where the load drives, with its mean, which the motor delivers; and the excess energy that "
    "the load has taken since the start of the revolution. The fluctuation ΔE is the height between the dashed lines.",
    abscissa="output_angle",
    needs=("torque_curve",),
    panels=(
        Panel(
            "Torque at the flywheel's shaft",
            "N*m",
            series=(Series("flywheel_torque", "torque"),),
            levels=(Level("flywheel_torque_mean", "mean"),),
        ),
        Panel(
            "Energy from the flywheel",
            "J",
            series=(Series("excess_energy", "energy"),),
            levels=(
                Level("excess_energy_max", "upper end of ΔE"),
                Level("excess_energy_min", "lower end of ΔE"),
            ),
            marks=(
                Mark("excess_energy_max_at", "excess_energy_max", "flywheel slowest"),
                Mark("excess_energy_min_at", "excess_energy_min", "flywheel fastest"),
            ),
        ),
    ),
)

FIGURES = (CHAIN, VBELT_LAYOUT, TURN, *TOOTHED_BELT_FIGURES)
