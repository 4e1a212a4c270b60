"""A curve that plain code makes of one machine's inputs: an object with the methods of ``Curve``."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from diecut_report.api import Chapter, Curve, Inputs, Mechanism, Quantity, abscissa, made_curve, reduction, samples


class Cam(Inputs):
    lift = Quantity("h", "mm", "Lift", gt=0)
    n_points = samples(72)


@dataclass(frozen=True)
class Ramp:
    """Up in the first half of the period, down in the second."""

    lift: np.ndarray

    def values(self, share, middle, rows):
        """At shares of the period, of the variants ``rows`` (None: all)."""
        lift = self.lift if rows is None else self.lift[rows]
        return lift * np.where(middle < 0.5, 2 * share, 2 - 2 * share)

    @property
    def breakpoints(self):
        """Inner edges of the smooth pieces, as shares, shape (variants, places)."""
        return np.full((len(self.lift), 1), 0.5)

    joints = breakpoints
    cycle = "ramp"


def ramp(lift) -> Curve:
    """The curve of these machines."""
    return Ramp(lift)


cam = Chapter("Cam")
cam.angle = abscissa(2 * np.pi), "φ", "deg", "Angle of the cam"
cam.path = made_curve(ramp, ("lift",), "angle", "a ramp up and a ramp down"), "s", "mm", "Lift over the angle"
cam.mean = reduction("mean", of="path"), "s_m", "mm", "Mean lift"

MECHANISM = Mechanism(kind="ramp_cam", version="1.0", title="Cam", summary="A ramp.", inputs=Cam, chapters=(cam,))

PRESS = """
mechanisms:
  cam: {kind: ramp_cam, lift: 20 mm}
"""
GIVES = {"cam.mean": "10 mm"}
