"""A mechanism for tests of values that are written out and read again: inputs in %, °, rpm, kN, 1/h, counts, a curve in %."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from diecut_report.api import (
    POINTS,
    Abscissa,
    Annotated,
    Chapter,
    Check,
    CurveInput,
    FromCurve,
    Inputs,
    Mechanism,
    Quantity,
    Reduction,
    Text,
    Value,
    formula,
    m,
)


class Shares(Inputs):
    share: Annotated[float, Quantity("k", "%", "Share", gt=0, le=100)] = 5
    slope: Annotated[float, Quantity("s", "mm/m", "Slope")] = 2
    ratio: Annotated[float, Quantity("i", "1", "Ratio", gt=0)] = 1.5
    angle: Annotated[float, Quantity("α", "°", "Angle", ge=-180, le=180)] = 20
    turn: Annotated[float, Quantity("β", "deg", "Turn")] = 10
    speed: Annotated[float, Quantity("ω", "rpm", "Speed", gt=0)] = 60
    rate: Annotated[float, Quantity("n", "1/h", "Rate", gt=0)] = 3600
    force: Annotated[float, Quantity("F", "kN", "Force", gt=0)] = 1
    length: Annotated[float, Quantity("l", "mm", "Length", gt=0)] = 100
    count: Annotated[int, Quantity("z", "1", "Count", ge=1, integer=True)] = 3
    grade: Annotated[Literal["fine", "coarse", "1e5", "no"], Text("Grade")] = "fine"
    hard: Annotated[bool, Text("Whether it is hardened")] = False
    profile: Annotated[Any | None, CurveInput("p", "%", "Profile over a turn")] = None
    n_points: Annotated[int, POINTS] = 36


@formula
def work(force: Any, length: Any, share: Any, angle: Any, turn: Any, slope: Any) -> Any:
    return force * length * share * np.cos(angle) * np.cos(turn) * slope


@formula
def power(work: Any, speed: Any, ratio: Any, count: Any) -> Any:
    return work * speed * ratio * count


@formula
def per_turn(work: Any, rate: Any) -> Any:
    return work * rate


MECHANISM = Mechanism(
    kind="shares",
    version="1",
    title="Shares",
    summary="Inputs of many units.",
    inputs=Shares,
    chapters=(
        Chapter(
            "Work",
            steps=(
                Value(id="work", symbol="W", unit="J", description="Work", formula=work),
                Value(id="power", symbol="P", unit="W", description="Power", formula=power),
                Value(id="rated", symbol="P_r", unit="W", description="Power at the rate", formula=per_turn),
            ),
        ),
        Chapter(
            "Profile",
            needs=("profile",),
            steps=(
                Abscissa(id="place", symbol="φ", unit="deg", description="Place", period=2 * np.pi),
                FromCurve(id="taken", symbol="p", unit="%", description="Profile", given="profile", abscissa="place"),
                Reduction(id="taken_max", symbol="p_m", unit="%", description="Greatest", of="taken", operation="max"),
            ),
        ),
    ),
    checks=(
        Check("power", "strength", "Power", m.power, m.rated, limit_label="rated", consequence="turn it more slowly."),
    ),
)
