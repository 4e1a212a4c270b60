"""A mechanism for tests of values that are written out and read again: inputs in %, °, rpm, kN, 1/h, counts, a curve in %."""

from __future__ import annotations

import numpy as np

from diecut_report.api import (
    Chapter,
    Check,
    CurveInput,
    Inputs,
    Mechanism,
    Quantity,
    Text,
    abscissa,
    from_curve,
    m,
    reduction,
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


work = Chapter("Work")
work.work = m.force * m.length * m.share * np.cos(m.angle) * np.cos(m.turn) * m.slope, "W", "J", "Work"
work.power = m.work * m.speed * m.ratio * m.count, "P", "W", "Power"
work.rated = m.work * m.rate, "P_r", "W", "Power at the rate"

profile = Chapter("Profile", needs=("profile",))
profile.place = abscissa(2 * np.pi), "φ", "deg", "Place"
profile.taken = from_curve("profile", abscissa="place"), "p", "%", "Profile"
profile.taken_max = reduction("max", of="taken"), "p_m", "%", "Greatest"

MECHANISM = Mechanism(
    kind="shares",
    version="1",
    title="Shares",
    summary="Inputs of many units.",
    inputs=Shares,
    chapters=(work, profile),
    checks=(
        Check("power", "strength", "Power", m.power, m.rated, limit_label="rated", consequence="turn it more slowly."),
    ),
)
