"""A mechanism for tests of values that are written out and read again: inputs in %, °, rpm, kN, 1/h, counts, a curve in %."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    Abscissa,
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
    samples,
)


class Shares(Inputs):
    share = Quantity("k", "%", "Share", gt=0, le=100, default=5)
    slope = Quantity("s", "mm/m", "Slope", default=2)
    ratio = Quantity("i", "1", "Ratio", gt=0, default=1.5)
    angle = Quantity("α", "°", "Angle", ge=-180, le=180, default=20)
    turn = Quantity("β", "deg", "Turn", default=10)
    speed = Quantity("ω", "rpm", "Speed", gt=0, default=60)
    rate = Quantity("n", "1/h", "Rate", gt=0, default=3600)
    force = Quantity("F", "kN", "Force", gt=0, default=1)
    length = Quantity("l", "mm", "Length", gt=0, default=100)
    count = Quantity("z", "1", "Count", ge=1, integer=True, default=3)
    grade = Text("Grade", ("fine", "coarse", "1e5", "no"), default="fine")
    hard = Text("Whether it is hardened", default=False)
    profile = CurveInput("p", "%", "Profile over a turn", optional=True)
    n_points = samples(36)


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
        Check(
            id="power",
            check_class="strength",
            title="Power",
            demand="power",
            limit="rated",
            unit="W",
            demand_label="power",
            limit_label="rated",
            consequence="turn it more slowly.",
        ),
    ),
)
