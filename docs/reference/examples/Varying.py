"""A number, the extremes of what is not known as a curve, or a curve: plain code asks which it was given."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, Curve, Extremes, Inputs, Mechanism, Varying, computed


class Bolt(Inputs):
    force = Varying("F", "kN", "Force: a number, {min, max}, or a curve", extremes=True)


def amplitude(known):
    """Half of the range of the force."""
    force = known["force"]
    if isinstance(force, Extremes):
        return (force.high - force.low) / 2
    return half_range(force) if hasattr(force, "values") else 0.0


def half_range(force: Curve) -> float:
    """Of a curve, on a grid of its period."""
    shares = np.linspace(0, 1, 181)[None, :]
    values = force.values(shares, shares, None)
    return float(np.ptp(values)) / 2


alternating = Chapter("Alternating force")
alternating.prepared("half", amplitude, ("force",))
alternating.amplitude = computed(lambda half: half, ("half",), "half of the range"), "F_a", "kN", "Amplitude"

MECHANISM = Mechanism(
    kind="bolt", version="1.0", title="Bolt", summary="Amplitude of a force.", inputs=Bolt, chapters=(alternating,)
)

PRESS = """
mechanisms:
  constant: {kind: bolt, force: 3 kN}
  pulsating: {kind: bolt, force: {min: 1 kN, max: 5 kN}}
"""
GIVES = {"constant.amplitude": "0 kN", "pulsating.amplitude": "2 kN"}
