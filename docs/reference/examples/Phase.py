"""When a mechanism works and rests, and others that take a phase of it, or the mechanism whole."""

from __future__ import annotations

import numpy as np

from diecut_report.api import (
    Chapter,
    GivenMechanism,
    GivenPhase,
    Inputs,
    Mechanism,
    MechanismInput,
    PhaseInput,
    Quantity,
    abscissa,
    computed,
    m,
    samples,
)  # fmt: skip


class Knife(Inputs):
    begin = Quantity("φ_1", "deg", "Where the cut begins", ge=0, lt=360)
    end = Quantity("φ_2", "deg", "Where the cut ends", ge=0, lt=360)
    speed = Quantity("n", "rpm", "Speed", gt=0)
    n_points = samples(72)


class Guard(Inputs):
    watched = PhaseInput("A", "deg", "Phase that is watched")
    mechanism = MechanismInput("Mechanism that is watched")


turn = Chapter("Turn")
turn.angle = abscissa(2 * np.pi, speed="speed"), "φ", "deg", "Angle of the knife"
turn.phase("cutting", "working", "Cutting", "angle", ("begin", "end"))
turn.phase("idle", "moving", "Without a cut", "angle", rest_of=("cutting",))
turn.width = m.end - m.begin, "Δφ", "deg", "Angle of the cut"


def share(known):
    """Share of the period in which the phase is there, by what other mechanisms are asked for."""
    phase: GivenPhase = known["watched"]
    other: GivenMechanism = known["mechanism"]
    assert phase.name in other.phases and other.number("width") is not None
    return sum(end - start for start, end in phase.intervals()) / phase.period()


watching = Chapter("Watching")
watching.prepared("found", share, ("watched", "mechanism"))
watching.share = computed(lambda found: found, ("found",), "the sum of its intervals"), "s", "%", "Share of the turn"

KNIFE = Mechanism(kind="blade", version="1.0", title="Knife", summary="Cuts.", inputs=Knife, chapters=(turn,))
GUARD = Mechanism(kind="guard", version="1.0", title="Guard", summary="Watches.", inputs=Guard, chapters=(watching,))

PRESS = """
mechanisms:
  knife: {kind: blade, begin: 30 deg, end: 120 deg, speed: 60 rpm}
  guard: {kind: guard, watched: "${knife.phases.cutting}", mechanism: knife}
"""
GIVES = {"guard.share": "25 %"}
