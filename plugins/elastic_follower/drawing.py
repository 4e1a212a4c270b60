"""The link on its elastic drive: where its input, its spring and the link itself are at a time."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Drawing, Phrase, Shape, View, circle, label, point, polyline

ARM, SEAT = 0.45, 0.75  # of the disc's radius: the end of the input's arm, and where the spring takes the link
TEETH, SWAY = 8, 0.05  # of a drawn spring: half waves, and how far they reach to the sides, of its disc or its stroke
TIMES = (1, 2, 5, 10, 20, 50, 100, 200, 500)
SEEN = 0.3  # such a deflection that is drawn: rad, or of the stroke
APART, HALF = 0.8, 0.09  # of the stroke: from input to link at rest, and half the side of their blocks


def magnified(view: View, seen: float) -> int:
    """Return how many times greater a deflection is drawn, so that one under the input's peak acceleration is about as far as ``seen``."""
    greatest = view["acceleration_rigid"] / view["angular_frequency"] ** 2
    return max((times for times in TIMES if times * greatest <= seen), default=1)


def _told(view: View, seen: float) -> Phrase:
    return Phrase("deflection × {times}", times=str(magnified(view, seen)))


def on_circle(radius: float, angle: float) -> tuple[float, float]:
    """Return a point of a circle about the shaft."""
    return radius * float(np.cos(angle)), radius * float(np.sin(angle))


def turning(view: View, time: float) -> list[Shape]:
    """Return the link as a disc, its input as an arm within, the spring between them, and where a rigid drive would have it (light)."""
    driver = view.at("input", time)
    link = driver + magnified(view, SEEN) * view.at("deflection", time)
    return [
        circle((0.0, 0.0), 1.0, "body"),
        polyline([on_circle(SEAT, driver), on_circle(1.0, driver)], "ghost"),
        polyline([(0.0, 0.0), on_circle(ARM, driver)], "link"),
        polyline([on_circle(SEAT, link), on_circle(1.0, link)], "link"),
        polyline(_coil(driver, link), "outline"),
        point((0.0, 0.0), "pivot"),
    ]


def _coil(driver: float, link: float) -> list[tuple[float, float]]:
    """The spring from the input's arm to the link: half waves beside a line that leads from the one angle to the other."""
    shares = np.linspace(0.0, 1.0, TEETH + 1)
    sides = np.where(np.arange(TEETH + 1) % 2, 1.0, -1.0) * (np.abs(shares - 0.5) < 0.49)
    radii = ARM + (SEAT - ARM) * shares
    angles = driver + (link - driver) * shares + SWAY * sides / radii
    return [on_circle(float(r), float(a)) for r, a in zip(radii, angles, strict=True)]


def sliding(view: View, time: float) -> list[Shape]:
    """Return input and link as blocks on their way, the spring between them, and where a rigid drive would have the link (light)."""
    stroke = view["rise"]
    driver = view.at("input", time)
    link = driver + magnified(view, SEEN * stroke) * view.at("deflection", time) + APART * stroke
    half, shares = HALF * stroke, np.linspace(0.0, 1.0, TEETH + 1)
    sides = np.where(np.arange(TEETH + 1) % 2, 1.0, -1.0) * (np.abs(shares - 0.5) < 0.49)
    start, end = driver + half, link - half
    spring = [(float(start + (end - start) * s), float(SWAY * stroke * t)) for s, t in zip(shares, sides, strict=True)]
    return [
        _block(driver + APART * stroke, half, "ghost"),
        _block(driver, half, "outline"),
        _block(link, half, "body"),
        polyline(spring, "link"),
    ]


def _block(place: float, half: float, role: str) -> Shape:
    corners = [(place - half, -half), (place + half, -half), (place + half, half), (place - half, half)]
    return polyline(corners, role, closed=True)


def turned(view: View) -> list[Shape]:
    """Return the turning link where its acceleration is greatest."""
    time = view["acceleration_peak_at"]
    driver, deflection = view.at("input", time), view.at("deflection", time)
    apart = 0.5 if deflection >= 0 else -0.5
    link = driver + magnified(view, SEEN) * deflection
    return [
        *turning(view, time),
        label(on_circle(0.3, driver - apart), "y"),
        label(on_circle(1.15, link + apart / 4), "x"),
        label((-0.75, -1.2), _told(view, SEEN)),
    ]


def slid(view: View) -> list[Shape]:
    """Return the sliding link where its acceleration is greatest."""
    time, stroke = view["acceleration_peak_at"], view["rise"]
    driver = view.at("input", time)
    link = driver + magnified(view, SEEN * stroke) * view.at("deflection", time) + APART * stroke
    above = 2.2 * HALF * stroke
    told = label((driver, -above), _told(view, SEEN * stroke))
    return [*sliding(view, time), label((driver, above), "y"), label((link, above), "x"), told]


CAPTION = (
    "The link (x) at its maximum acceleration, its input (y) and the spring between them; light: the link of a rigid drive. The deflection is "
    "magnified by the factor shown."
)
DRAWINGS = (
    Drawing(id="turning_link", title="Link on its elastic drive", caption=CAPTION, unit="1", build=turned, moving=turning, over="time",
            needs=("inertia",)),
    Drawing(id="sliding_link", title="Link on its elastic drive", caption=CAPTION, build=slid, moving=sliding, over="time", needs=("mass",)),
)  # fmt: skip
