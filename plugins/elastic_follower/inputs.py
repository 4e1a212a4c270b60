"""Inputs of the driven link on an elastic drive: a turning link (inertia, angles) or a sliding one (mass, lengths)."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, Any, ClassVar

from diecut_report.api import POINTS, CurveInput, Inputs, OneOf, Quantity, Text
from diecut_report.mechanics.motion_laws import LAWS

# fmt: off


class GivenMotion(OneOf):
    """The motion of the input: one rise by a law, or a curve, which has no use for the law."""

    def fault(self, given: Iterable[str]) -> str:
        """What is wrong with the keys that are given, in words; empty where nothing is."""
        known = set(given)
        if {"motion_curve", "motion_law"} <= known:
            return "motion_law has no use beside motion_curve, which is the motion itself; remove one of them."
        return super().fault(known)


class ElasticFollower(Inputs):
    """Keys of ``elastic_follower``."""

    one_of: ClassVar[tuple[OneOf, ...]] = (
        OneOf(("inertia",), ("mass",)),
        GivenMotion(("rise", "rise_time"), ("motion_curve",)),
    )

    inertia: Annotated[float | None,
        Quantity("I", "kg*m**2", "Moment of inertia of the driven link, if it rotates; rise and stiffness are then in angles", gt=0)] = None
    mass: Annotated[float | None, Quantity("m", "kg", "Mass of the driven link, if it slides; rise and stiffness are then in lengths", gt=0)] = None
    stiffness: Annotated[float, Quantity("K", "N*m/rad", "Stiffness of the drive between input and driven link", gt=0, units=(("mass", "N/m"),))]
    damping_ratio: Annotated[float, Quantity("ζ", "1", "Damping of the drive as a fraction of critical damping", ge=0, lt=1)] = 0.05
    rest_tolerance: Annotated[float | None,
        Quantity("e", "deg", "Deflection within which the link counts as at rest; required for the settling", gt=0, units=(("mass", "mm"),))] = None
    rise: Annotated[float | None, Quantity("h", "rad", "Rise of the input, between two rests", gt=0, units=(("mass", "m"),))] = None
    rise_time: Annotated[float | None,
        Quantity("t_1", "s", "Duration of the rise; with cycles_per_hour as a fraction of the cycle", gt=0, units=(("cycles_per_hour", "1"),))] = None
    motion_law: Annotated[str, Text("Law of motion of the rise; not used with motion_curve", options=LAWS)] = "cycloidal"
    motion_curve: Annotated[Any | None,
        CurveInput("y_c", "rad", "Position of the input by reference, over time or over an angle; instead of rise, rise_time and motion_law",
            referred=True, units=(("mass", "m"),))] = None
    cycles_per_hour: Annotated[float | None,
        Quantity("n", "1/h", "Cycle rate: one period of motion_curve each; or the cycles of which rise_time is a fraction", gt=0)] = None
    dwell_cycles: Annotated[float,
        Quantity("n_f", "1", "Number of natural periods for which the vibration after the motion is calculated", gt=0, le=50)] = 3
    allowable_peak_ratio: Annotated[float,
        Quantity("[q]", "1", "Allowable ratio of the link's peak acceleration during the rise to the rigid-drive value", gt=0)] = 1.1
    allowable_residual_ratio: Annotated[float,
        Quantity("[q_r]", "1", "Allowable ratio of the peak acceleration after the rise to the rigid-drive value", gt=0)] = 0.2
    allowable_torque: Annotated[float | None, Quantity("[M]", "N*m", "Allowable torque (or force) of the drive", gt=0, units=(("mass", "N"),))] = None
    n_points: Annotated[int, POINTS] = 720
