"""Curves about a pole, and bars in groups."""

from __future__ import annotations

import numpy as np

from diecut_report.api import (
    BarGroup,
    Bars,
    Chapter,
    Inputs,
    Mechanism,
    Polar,
    Quantity,
    Series,
    abscissa,
    m,
    reduction,
    samples,
)


class Rotor(Inputs):
    mean = Quantity("M_m", "N*m", "Mean torque", gt=0)
    ripple = Quantity("M_w", "N*m", "Ripple of the torque", ge=0)
    n_points = samples(72)


torque = Chapter("Torque")
torque.angle = abscissa(2 * np.pi), "φ", "deg", "Angle"
torque.torque = m.mean + m.ripple * np.cos(2 * m.angle), "M", "N*m", "Torque"
torque.torque_max = reduction("max", of="torque"), "M_max", "N*m", "Maximum torque"

MECHANISM = Mechanism(
    kind="rotor", version="1.0", title="Rotor", summary="Torque of a rotor.", inputs=Rotor, chapters=(torque,),
    figures=(
        Polar("about", "Torque about the axis", "Distance from the pole: torque.", abscissa="angle", unit="N*m",
              series=(Series("torque", "torque"),)),
        Bars("parts", "Parts of the torque", "Mean, ripple and greatest.",
             groups=(BarGroup("torque", "N*m", bars=(("mean", "mean"), ("ripple", "ripple"), ("greatest", "torque_max"))),)),
    ),
)  # fmt: skip

PRESS = """
mechanisms:
  rotor: {kind: rotor, mean: 10 N*m, ripple: 4 N*m}
"""
GIVES = {"rotor.torque_max": "14 N*m"}
