"""The kinematic chain as a schematic: motor, V-belt, flywheel, gears, and a box of numbers for each shaft."""

from __future__ import annotations

from diecut_report.api import Drawing, Phrase, Point, Shape, View, box, joined, label, phrase, polyline, told

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
    id="chain",
    title="Kinematic chain",
    caption="Shafts with their mean speed, torque and power, losses included; the shafts are numbered from the motor. Not to scale.",
    build=chain,
    schematic=True,
)
