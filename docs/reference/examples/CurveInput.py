"""A curve as an input: a list of values, or the curve of another mechanism, laid over an abscissa of one's own."""

from __future__ import annotations

import numpy as np

from diecut_report.api import (
    Chapter,
    CurveInput,
    Inputs,
    Mechanism,
    abscissa,
    curve_period,
    from_curve,
    reduction,
    samples,
)


class Press(Inputs):
    load = CurveInput("F", "kN", "Load over a turn")
    n_points = samples(72)


class Follower(Inputs):
    force = CurveInput("F_c", "kN", "Force of another mechanism", referred=True)
    n_points = samples(72)


turn = Chapter("Turn")
turn.angle = abscissa(2 * np.pi), "φ", "deg", "Angle of the shaft"
turn.force = from_curve(given="load", abscissa="angle"), "F_φ", "kN", "Load over the angle"
turn.force_max = reduction("max", of="force"), "F_max", "kN", "Greatest load"

following = Chapter("Following")
following.period = curve_period("force", otherwise="give a force over an angle"), "Φ", "deg", "Period of the force"
following.angle = abscissa("period"), "φ", "deg", "Angle of the shaft"
following.own_force = from_curve(given="force", abscissa="angle"), "F", "kN", "Force, taken over"
following.force_range = reduction("range", of="own_force"), "ΔF", "kN", "Range of the force"

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
