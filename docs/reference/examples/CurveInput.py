"""A curve as an input: a list of values, or the curve of another mechanism, laid over an abscissa of one's own."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import POINTS, Annotated, Chapter, CurveInput, Inputs, Mechanism


class Press(Inputs):
    load: Annotated[Any, CurveInput("F", "kN", "Load over a turn")]
    n_points: Annotated[int, POINTS] = 72


class Follower(Inputs):
    force: Annotated[Any, CurveInput("F_c", "kN", "Force of another mechanism", referred=True)]
    n_points: Annotated[int, POINTS] = 72


turn = Chapter("Turn")
turn.abscissa("angle", "φ", "deg", "Angle of the shaft", 2 * np.pi)
turn.from_curve("force", "F_φ", "kN", "Load over the angle", given="load", abscissa="angle")
turn.reduction("force_max", "F_max", "kN", "Greatest load", operation="max", of="force")

following = Chapter("Following")
following.curve_period(
    "period", "Φ", "deg", "Period of the force", given="force", otherwise="give a force over an angle",
)  # fmt: skip
following.abscissa("angle", "φ", "deg", "Angle of the shaft", period="period")
following.from_curve("own_force", "F", "kN", "Force, taken over", given="force", abscissa="angle")
following.reduction("force_range", "ΔF", "kN", "Range of the force", operation="range", of="own_force")

PUNCH = Mechanism(
    kind="punch", version="1.0", title="Punch", summary="A load over a turn.", inputs=Press, chapters=(turn,)
)
FOLLOWER = Mechanism(
    kind="follower",
    version="1.0",
    title="Follower",
    summary="Takes a force over.",
    inputs=Follower,
    chapters=(following,),
)

PRESS = """
mechanisms:
  punch: {kind: punch, load: [0, 2, 8, 2, 0, 0]}
  follower: {kind: follower, force: "${punch.force}"}
"""
GIVES = {"punch.force_max": "8 kN", "follower.force_range": "8 kN"}
