"""A made-up link that turns or slides, by a law of its own or by a referred curve: derivatives, periods, spectra."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    Case,
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
    formula,
    m,
    number,
    pi,
)
from diecut_report.mechanism.steps import (
    Abscissa,
    Accumulated,
    Breakpoints,
    Choice,
    Computed,
    Crossings,
    CurvePeriod,
    Derivative,
    FromCurve,
    Reduction,
    Require,
    Value,
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


passed = formula(lambda time, duration: time / duration)
rising = formula(lambda lift, passed: 64 * lift * passed**3)
falling = formula(lambda lift, passed: lift * np.cos(2 * pi / 3 * (passed - number(1) / 4)))
quarter = formula(lambda duration: duration / 4)
is_calm = formula(lambda duration, ripple: duration < 1000 * ripple)
inverse = formula(lambda rate: 1 / rate)
turned = formula(lambda position, lift, passed: position + 2 * lift * passed)
level = formula(lambda position, lift: position - lift / 2)
force = formula(lambda stiffness, position: stiffness * position)


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


OWN = Chapter(
    "Motion by a law",
    needs=("lift",),
    steps=(
        Require(id="calm", condition=is_calm, key="lift", message="of {lift} turns back too often with {stiffness}; give a longer ripple"),
        Abscissa(id="time", symbol="t", unit="s", description="Time", period="duration"),
        Value(id="quarter", symbol="t_4", unit="s", description="End of the rise", formula=quarter),
        Breakpoints(id="joints", abscissa="time", places=("quarter",), every="ripple"),
        Value(unit="1", id="passed", symbol="k", description="Share of the time", formula=passed),
        Value(id="middle", symbol="t_m", unit="s", description="Middle of the piece", per_piece=True, output=False,
              formula=m.time),
        Choice(id="position", symbol="y", unit="deg", units=LENGTH, description="Position",
               cases=(Case(rising, "it rises", m.middle < m.quarter),
                      Case(falling, "it falls"))),
        Value(id="turned", symbol="φ", unit="deg", units=LENGTH, description="Position that grows", formula=turned),
        Value(id="level", symbol="y_l", unit="deg", units=LENGTH, description="Position above half the lift", output=False, formula=level),
        Crossings(id="half_way", symbol="t_h", unit="s", description="Time at half the lift", of="level"),
        Computed(id="work", symbol="W", unit="J", description="Work of the lift", function=work, takes=("stiffness", "lift", "grade"),
                 method="half of stiffness times lift squared"),
    ),
)  # fmt: skip

TAKEN = Chapter(
    "Motion by a curve",
    needs=("motion",),
    steps=(
        CurvePeriod(id="cycle", symbol="T_c", unit="s", description="Period of the motion", lacks=("rate",), given="motion",
                    otherwise="give rate, with which it runs through"),
        Value(id="cycle", symbol="T_c", unit="s", description="Period of the motion", needs=("rate",), formula=inverse),
        Abscissa(id="time", symbol="t", unit="s", description="Time", period="duration"),
        FromCurve(id="position", symbol="y", unit="deg", units=LENGTH, description="Position", given="motion", abscissa="time", start="share",
                  lasts="cycle"),
        FromCurve(id="grown", symbol="y_g", unit="deg", units=LENGTH, description="Position that goes on", given="motion", abscissa="time",
                  start="share", lasts="cycle", gains=True),
        FromCurve(id="stretched", symbol="y_s", unit="deg", units=LENGTH, description="Position over the whole time", given="motion",
                  abscissa="time"),
        Reduction(id="grown_top", symbol="y_g,max", unit="deg", units=LENGTH, description="Farthest that it goes on", of="grown", operation="max"),
        Computed(id="between", symbol="y_2", unit="deg", units=LENGTH, description="Position half a period later", function=between,
                 takes=("motion", "share"), method="the curve at half a period after its start"),
    ),
)  # fmt: skip

BOTH = Chapter(
    "What follows from the motion",
    steps=(
        Derivative(id="speed", symbol="v", unit="rad/s", units=SPEED, description="Speed", source="kinematics", of="position"),
        Derivative(id="acceleration", symbol="a", unit="rad/s**2", units=(("mass", "m/s**2"),), description="Acceleration", of="speed"),
        Accumulated(id="area", symbol="A", unit="rad*s", units=(("mass", "m*s"),), description="Area under the position", of="position"),
        Accumulated(id="way", symbol="s", unit="rad", units=(("mass", "m"),), description="Integral of the speed", of="speed"),
        Value(id="force", symbol="F", unit="N*m", units=(("mass", "N"),), description="Torque or force", formula=force),
        Reduction(id="speed_top", symbol="v_max", unit="rad/s", units=SPEED, description="Greatest speed", of="speed", operation="max"),
        Reduction(id="force_top", symbol="F_max", unit="N*m", units=(("mass", "N"),), description="Greatest force", of="force", operation="abs_max"),
        Reduction(id="speed_mean", symbol="v_m", unit="rad/s", units=SPEED, description="Mean speed", of="speed", operation="mean"),
    ),
)  # fmt: skip

SPECTRUM = Spectrum(
    id="ratio", symbol="λ", description="Ratio of frequencies", values=RATIOS, lines=lines, source="made up"
)

MECHANISM = Mechanism(
    kind="swing", version="1", title="Swing", summary="A link that swings.", inputs=Swing, chapters=(OWN, TAKEN, BOTH), spectra=(SPECTRUM,)
)  # fmt: skip
