"""Figures of the elastic drive: the motion, and the spectrum with the machine's point."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import (
    Chart,
    Drawing,
    Mark,
    Panel,
    Phrase,
    Plot,
    Series,
    Shape,
    View,
    chart_panel,
    circle,
    label,
    level,
    line,
    mark,
    phrase,
    point,
    polyline,
    worded,
)
from diecut_report.mechanics.followers import peaks
from diecut_report.mechanics.motion_laws import LAWS
from diecut_report.plugins.elastic_follower.motion import CURVE
from diecut_report.plugins.elastic_follower.response import DAMPINGS, FIRST, LAST, RATIOS, of_law

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
    Drawing("turning_link", "Link on its elastic drive", CAPTION, unit="1", build=turned, moving=turning, over="time",
            needs=("inertia",)),
    Drawing("sliding_link", "Link on its elastic drive", CAPTION, build=slid, moving=sliding, over="time", needs=("mass",)),
)  # fmt: skip


PERIODS = (phrase("Natural periods within the motion"), "λ", "1")
RATIO_TITLES = {
    "peak_ratio": phrase("Ratio of peak acceleration during the motion to the rigid-drive value"),
    "residual_ratio": phrase("Ratio of peak acceleration after the motion to the rigid-drive value"),
}
OWN = 64  # points of the line of this machine's own motion
OWN_DAMPED = 40  # the same where there is a line for each damping


def own_ratios(view: View, points: int) -> NDArray[Any]:
    """Natural periods of the line of the machine's own motion: those of the spectrum, led on to the machine's."""
    ratio = view["tuning_ratio"]
    return np.linspace(min(FIRST, ratio), max(LAST, ratio), points)


def own(view: View, ratios: NDArray[Any], **changed: float) -> dict[str, NDArray[Any]]:
    """Peaks of the machine's own motion with other stiffnesses."""
    stiffness = view["stiffness"] * (ratios / view["tuning_ratio"]) ** 2
    return view.varied({"stiffness": stiffness, **changed}, "peak_ratio", "residual_ratio", "acceleration_peak")


def laws(view: View) -> list[Shape]:
    """All laws with the machine's damping: peak in the rise, after it, and the greatest acceleration."""
    found = {name: peaks(law, RATIOS, view["damping_ratio"]) for name, law in LAWS.items()}
    ratio, unit = view["tuning_ratio"], view["rise"] / view["rise_duration"] ** 2
    ratios = {
        "peak_ratio": [each.rise for each in found.values()],
        "residual_ratio": [each.residual for each in found.values()],
    }
    panels = [
        chart_panel(RATIO_TITLES[name], "1", *PERIODS, lines=[*named(values), *_own_line(view, name)],
                    marks=[mark(ratio, view[name], "this machine")], levels=[level(view[f"allowable_{name}"], "allowed")])
        for name, values in ratios.items()
    ]  # fmt: skip
    greatest = [np.maximum(*found[name]) * law.A for name, law in LAWS.items()]
    marks = [mark(ratio, view["acceleration_peak"] / unit, "this machine")]
    return [
        *panels,
        chart_panel(
            "Maximum acceleration, in units of rise/duration²", "1", *PERIODS, lines=named(greatest), marks=marks
        ),
    ]


def named(values: list[NDArray[Any]]) -> list[Shape]:
    """A line for each law."""
    return [line(RATIOS, row, phrase(worded(name))) for name, row in zip(LAWS, values, strict=True)]


def _own_line(view: View, name: str) -> list[Shape]:
    """The machine's own motion, where it is given as a curve."""
    if "motion_share" not in view:
        return []
    ratios = own_ratios(view, OWN)
    return [line(ratios, own(view, ratios)[name], "this motion")]


def dampings(names: tuple[str, ...]) -> Any:
    """What draws the peak in the rise for five dampings, a panel for each of some laws."""

    def build(view: View) -> list[Shape]:
        return [_damped(view, name) for name in names if name in LAWS]

    return build


def _damped(view: View, name: str) -> Shape:
    is_own = "motion_share" not in view and view.word("motion_law") == name
    marks = [mark(view["tuning_ratio"], view["peak_ratio"], "this machine")] if is_own else []
    drawn = [line(RATIOS, row, f"ζ = {damping:g}") for damping, row in zip(DAMPINGS, of_law(name).rise, strict=True)]
    return chart_panel(LAWS[name].title, "1", *PERIODS, lines=drawn, marks=marks)


def own_dampings(view: View) -> list[Shape]:
    """The machine's own motion for five dampings."""
    ratios = own_ratios(view, OWN_DAMPED)
    found = [own(view, ratios, damping_ratio=damping) for damping in DAMPINGS]
    return [
        chart_panel(title, "1", *PERIODS,
                    lines=[line(ratios, row[name], f"ζ = {damping:g}") for damping, row in zip(DAMPINGS, found, strict=True)],
                    marks=[mark(view["tuning_ratio"], view[name], "this machine")])
        for name, title in RATIO_TITLES.items()
    ]  # fmt: skip


def motion(body: str, position: str, acceleration: str) -> Plot:
    """Input and driven link over time, of a turning or a sliding link."""
    return Plot(
        "motion",
        "Input and driven link",
        "The driven link follows the input through the elastic drive and continues to oscillate when the input rests. The rigid "
                "acceleration is that of the input.",
        abscissa="time",
        needs=(body,),
        panels=(
            Panel("Position", position, series=(Series("input", "input"), Series("response", "driven link"))),
            Panel("Deflection of the drive", position, series=(Series("deflection", "z"),)),
            Panel("Acceleration", acceleration,
                  series=(Series("rigid_acceleration", "rigid drive"), Series("acceleration", "driven link")),
                  marks=(Mark("acceleration_peak_at", "acceleration_peak", "maximum"),)),
        ),
    )  # fmt: skip


FIRST_LAWS, OTHER_LAWS = tuple(LAWS)[:4], tuple(LAWS)[4:]
SPECTRUM_CAPTION = (
    "The last figure of 001, first paper, for this law: peak acceleration of the driven link during the rise, relative to the rigid-drive value, "
    "over the natural periods within the rise, for five damping ratios. Drives of equal λ and ζ are dynamically similar."
)
FIGURES = (
    *DRAWINGS,
    motion("inertia", "deg", "rad/s**2"),
    motion("mass", "mm", "m/s**2"),
    Chart(
        "laws",
        "Laws of motion on this drive",
        "All laws, as single rises, over the natural periods within the rise, with this machine's damping and its point. The lower part "
                "shows which law loads the link least: both the law's own peak (A of the law) and the amplification by the drive count. A motion "
                "of several parts, given as a curve, requires more than a single rise of the same height and duration.",
        build=laws,
    ),
    Chart("own_spectrum", "Spectrum of this motion", needs=CURVE, build=own_dampings,
          caption="The motion of the curve on drives of other stiffness, for five damping ratios, with this machine's point."),
    Chart("spectrum_1", "Spectrum of the laws of motion", SPECTRUM_CAPTION, build=dampings(FIRST_LAWS)),
    Chart("spectrum_2", "Spectrum of the laws of motion, continued", SPECTRUM_CAPTION, build=dampings(OTHER_LAWS)),
)  # fmt: skip
