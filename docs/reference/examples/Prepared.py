"""Plain code for several steps: an object made once, and of it rows, curves, a table, and parts that are no list of the inputs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from diecut_report.api import (
    Cell,
    Chapter,
    Inputs,
    ListedColumn,
    Mechanism,
    Quantity,
    Recipe,
    abscissa,
    computed,
    computed_curve,
    m,
    reduction,
    samples,
)

PARTS = ["driver", "driven"]


class Pair(Inputs):
    ratio = Quantity("i", "1", "Ratio", gt=0)
    torque = Quantity("M", "N*m", "Torque of the driver", gt=0)
    ripple = Quantity("w", "%", "Ripple of the torque", ge=0, le=100)
    n_points = samples(72)


@dataclass(frozen=True)
class Torques:
    """What several steps ask."""

    mean: tuple[float, float]
    ripple: float

    def over(self, index: int, angle):
        """Torque of one of both over the angle."""
        return self.mean[index] * (1 + self.ripple * np.cos(angle))


def torques(known):
    """Called with what there is of the ids named: once for each machine."""
    torque, ratio, ripple = (float(known[name].item()) for name in ("torque", "ratio", "ripple"))
    return Torques((torque, torque * ratio), ripple)


def curve(torques, index, angle, middle, rows):
    """Of the part ``index`` at angles of shape (variants, points)."""
    return torques.over(index, angle)


def both(torques, angle, middle, rows):
    """The sum over the angle."""
    return torques.over(0, angle) + torques.over(1, angle)


def of_both(function) -> Recipe:
    """How a row over both wheels is given, for any of their quantities."""
    return computed(function, ("torques",), "driver, driven", over="wheels")


def table(known) -> list[tuple[Cell, ...]]:
    """Rows of texts and SI numbers, None where there is none."""
    return [(name, value) for name, value in zip(PARTS, known["torques"].mean, strict=True)]


pair = Chapter("Pair")
pair.angle = abscissa(2 * np.pi), "φ", "deg", "Angle of the driver"
pair.prepared("torques", torques, ("torque", "ratio", "ripple"))
pair.part_names("wheels", "Both wheels", lambda ratio: PARTS, ("ratio",), count=lambda length: 2)
pair.mean = of_both(lambda torques: torques.mean), "M_k", "N*m", "Mean torque"
pair.halved = m.mean / 2, "H_k", "N*m", "Half of the mean torque"
pair.part_table("wheel_table", "Torques of the wheels", "wheels", ("mean", "halved"))
pair.sum = computed_curve(both, "torques", "angle", "both are added"), "M_Σ", "N*m", "Sum of both"
pair.part_curves(
    "torque_over", "M_φ", "N*m", "Torque over the angle", lambda torques: PARTS, curve, "torques", "angle", "a cosine about its mean",
)  # fmt: skip
pair.sum_max = reduction("max", of="sum"), "M_max", "N*m", "Greatest sum"
pair.listing(
    "list", "Torques in a list", (ListedColumn("wheel", "Wheel"), ListedColumn("mean", "Mean", "M_m", "N*m")), table, ("torques",),
)  # fmt: skip

MECHANISM = Mechanism(
    kind="pair", version="1.0", title="Pair", summary="Torques of a pair.", inputs=Pair, chapters=(pair,)
)

PRESS = """
mechanisms:
  pair: {kind: pair, ratio: 3, torque: 10 N*m, ripple: 10 %}
"""
GIVES = {"pair.sum_max": "44 N*m"}
