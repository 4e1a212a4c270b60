"""Figures of the elastic drive: the motion, and the spectrum with the machine's point."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from diecut_report.api import (
    Chart,
    Mark,
    Panel,
    Plot,
    Series,
    Shape,
    View,
    chart_panel,
    level,
    line,
    mark,
    phrase,
    worded,
)
from diecut_report.mechanics.followers import peaks
from diecut_report.mechanics.motion_laws import LAWS
from diecut_report.plugins.elastic_follower.drawing import DRAWINGS
from diecut_report.plugins.elastic_follower.motion import CURVE
from diecut_report.plugins.elastic_follower.spectrum import DAMPINGS, FIRST, LAST, RATIOS, of_law

PERIODS = (phrase("Natural periods within the motion"), "λ", "1")
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
    drawn = {
        "Ratio of peak acceleration during the motion to the rigid-drive value": (
            [found[name].rise for name in LAWS],
            "peak_ratio",
            "allowable_peak_ratio",
        ),
        "Ratio of peak acceleration after the motion to the rigid-drive value": (
            [found[name].residual for name in LAWS],
            "residual_ratio",
            "allowable_residual_ratio",
        ),
    }
    panels = [
        chart_panel(title, "1", *PERIODS, lines=[*named(values), *_own_line(view, name)], marks=[mark(ratio, view[name], "this machine")],
                    levels=[level(view[limit], "allowed")])
        for title, (values, name, limit) in drawn.items()
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
    titles = {
        "peak_ratio": "Ratio of peak acceleration during the motion to the rigid-drive value",
        "residual_ratio": "Ratio of peak acceleration after the motion to the rigid-drive value",
    }
    return [
        chart_panel(title, "1", *PERIODS,
                    lines=[line(ratios, row[name], f"ζ = {damping:g}") for damping, row in zip(DAMPINGS, found, strict=True)],
                    marks=[mark(view["tuning_ratio"], view[name], "this machine")])
        for name, title in titles.items()
    ]  # fmt: skip


def motion(body: str, position: str, acceleration: str) -> Plot:
    """Input and driven link over time, of a turning or a sliding link."""
    return Plot(
        id="motion",
        title="Input and driven link",
        caption="The driven link follows the input through the elastic drive and continues to oscillate when the input rests. The rigid "
                "acceleration is that of the input.",
        abscissa="time",
        needs=(body,),
        panels=(
            Panel(title="Position", unit=position, series=(Series(curve="input", label="input"), Series(curve="response", label="driven link"))),
            Panel(title="Deflection of the drive", unit=position, series=(Series(curve="deflection", label="z"),)),
            Panel(title="Acceleration", unit=acceleration,
                  series=(Series(curve="rigid_acceleration", label="rigid drive"), Series(curve="acceleration", label="driven link")),
                  marks=(Mark(x="acceleration_peak_at", y="acceleration_peak", label="maximum"),)),
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
        id="laws",
        title="Laws of motion on this drive",
        caption="All laws, as single rises, over the natural periods within the rise, with this machine's damping and its point. The lower part "
                "shows which law loads the link least: both the law's own peak (A of the law) and the amplification by the drive count. A motion "
                "of several parts, given as a curve, requires more than a single rise of the same height and duration.",
        build=laws,
    ),
    Chart(id="own_spectrum", title="Spectrum of this motion", needs=CURVE, build=own_dampings,
          caption="The motion of the curve on drives of other stiffness, for five damping ratios, with this machine's point."),
    Chart(id="spectrum_1", title="Spectrum of the laws of motion", caption=SPECTRUM_CAPTION, build=dampings(FIRST_LAWS)),
    Chart(id="spectrum_2", title="Spectrum of the laws of motion, continued", caption=SPECTRUM_CAPTION, build=dampings(OTHER_LAWS)),
)  # fmt: skip
