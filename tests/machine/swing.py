"""A made-up link that turns or slides, by a law of its own or by a referred curve: derivatives, periods, spectra."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    Chapter,
    Curve,
    CurveInput,
    Inputs,
    Mechanism,
    OneOf,
    Quantity,
    Spectrum,
    SpectrumLine,
    Text,
    abscissa,
    accumulated,
    case,
    choice,
    computed,
    crossings,
    curve_period,
    derivative,
    from_curve,
    inner,
    m,
    number,
    pi,
    reduction,
    value,
)

LENGTH, SPEED = (("mass", "mm"),), (("mass", "m/s"),)
RATIOS = np.linspace(0.5, 2, 4)


class Swing(Inputs):
    one_of = (OneOf(("inertia",), ("mass",)), OneOf(("lift",), ("motion",)))

    inertia = Quantity("I", "kg*m**2", "Inertia, where the link turns", gt=0, optional=True)
    mass = Quantity("m", "kg", "Mass, where the link slides", gt=0, optional=True)
    stiffness = Quantity("K", "N*m/rad", "Stiffness", gt=0, units=(("mass", "N/m"),), default=100)
    lift = Quantity("h", "deg", "Lift of the link", gt=0, le=400, units=LENGTH, optional=True)
    motion = CurveInput("y_c", "deg", "Motion by reference", referred=True, units=(("mass", "mm"),), optional=True)
    duration = Quantity("T", "s", "Time that is calculated", gt=0, default=2)
    ripple = Quantity("δ", "s", "Time in which curves may turn back", gt=0, default=1)
    share = Quantity("s_0", "1", "Share of the motion's period at which it begins", ge=0, lt=1, default=0)
    rate = Quantity("n", "1/s", "Periods of the motion in a second", gt=0, optional=True)
    grade = Text("Grade of the link", default="plain")
    n_points = Quantity("N", "1", "Samples", ge=36, le=100_000, integer=True, default=48)


def between(motion: Curve, share: Any) -> Any:
    """The motion half a period after its start."""
    place = (share + 0.5) % 1
    return motion.values(place, place, None)


def work(stiffness: Any, lift: Any, grade: str) -> Any:
    """Work of the greatest lift; a fine link needs half of it."""
    return stiffness * lift**2 / (4 if grade == "fine" else 2)


def lines() -> list[SpectrumLine]:
    return [SpectrumLine(id=f"amplitude_{k}", symbol=f"q_{k}", description=f"Amplitude {k}", values=RATIOS**k, source="made up")
            for k in (1, 2)]  # fmt: skip


# fmt: off

OWN = Chapter("Motion by a law", needs=("lift",))
OWN.require("calm", m.duration < 1000 * m.ripple, key="lift", message="of {lift} turns back too often with {stiffness}; give a longer ripple")
OWN.time = abscissa("duration"), "t", "s", "Time"
OWN.quarter = m.duration / 4, "t_4", "s", "End of the rise"
OWN.breakpoints("joints", "time", "quarter", every="ripple")
OWN.passed = m.time / m.duration, "k", "1", "Share of the time"
OWN.middle = inner(m.time, per_piece=True), "t_m", "s", "Middle of the piece"
OWN.position = choice(
    case(64 * m.lift * m.passed**3, "it rises", m.middle < m.quarter),
    case(m.lift * np.cos(2 * pi / 3 * (m.passed - number(1) / 4)), "it falls"), units=LENGTH), "y", "deg", "Position"
OWN.turned = value(m.position + 2 * m.lift * m.passed, units=LENGTH), "φ", "deg", "Position that grows"
OWN.level = inner(m.position - m.lift / 2, units=LENGTH), "y_l", "deg", "Position above half the lift"
OWN.half_way = crossings(of="level"), "t_h", "s", "Time at half the lift"
OWN.work = computed(work, takes=("stiffness", "lift", "grade"), method="half of stiffness times lift squared"), "W", "J", "Work of the lift"

TAKEN = Chapter("Motion by a curve", needs=("motion",))
TAKEN.cycle = (curve_period("motion", lacks=("rate",), otherwise="give rate, with which it runs through"), "T_c", "s",
               "Period of the motion")
TAKEN.cycle = value(1 / m.rate, needs=("rate",)), "T_c", "s", "Period of the motion"
TAKEN.time = abscissa("duration"), "t", "s", "Time"
TAKEN.position = from_curve("motion", abscissa="time", start="share", lasts="cycle", units=LENGTH), "y", "deg", "Position"
TAKEN.grown = (from_curve("motion", abscissa="time", start="share", lasts="cycle", gains=True, units=LENGTH), "y_g", "deg",
               "Position that goes on")
TAKEN.stretched = from_curve("motion", abscissa="time", units=LENGTH), "y_s", "deg", "Position over the whole time"
TAKEN.grown_top = reduction("max", of="grown", units=LENGTH), "y_g,max", "deg", "Farthest that it goes on"
TAKEN.between = (computed(between, takes=("motion", "share"), method="the curve at half a period after its start", units=LENGTH), "y_2", "deg",
                 "Position half a period later")

BOTH = Chapter("What follows from the motion")
BOTH.speed = derivative(of="position", units=SPEED), "v", "rad/s", "Speed", "kinematics"
BOTH.acceleration = derivative(of="speed", units=(("mass", "m/s**2"),)), "a", "rad/s**2", "Acceleration"
BOTH.area = accumulated(of="position", units=(("mass", "m*s"),)), "A", "rad*s", "Area under the position"
BOTH.way = accumulated(of="speed", units=(("mass", "m"),)), "s", "rad", "Integral of the speed"
BOTH.force = value(m.stiffness * m.position, units=(("mass", "N"),)), "F", "N*m", "Torque or force"
BOTH.speed_top = reduction("max", of="speed", units=SPEED), "v_max", "rad/s", "Greatest speed"
BOTH.force_top = reduction("abs_max", of="force", units=(("mass", "N"),)), "F_max", "N*m", "Greatest force"
BOTH.speed_mean = reduction("mean", of="speed", units=SPEED), "v_m", "rad/s", "Mean speed"

# fmt: on

SPECTRUM = Spectrum(
    id="ratio", symbol="λ", description="Ratio of frequencies", values=RATIOS, lines=lines, source="made up"
)

MECHANISM = Mechanism(
    kind="swing", version="1", title="Swing", summary="A link that swings.", inputs=Swing, chapters=(OWN, TAKEN, BOTH), spectra=(SPECTRUM,)
)  # fmt: skip
