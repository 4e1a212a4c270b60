"""Inputs of the driven link on an elastic drive: a turning link (inertia, angles) or a sliding one (mass, lengths)."""

from __future__ import annotations

from collections.abc import Iterable

from diecut_report.api import CurveInput, Inputs, OneOf, Quantity, Text, samples
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

    one_of = (
        OneOf(("inertia",), ("mass",)),
        GivenMotion(("rise", "rise_time"), ("motion_curve",)),
    )

    inertia = Quantity("I", "kg*m**2", "Moment of inertia of the driven link, if it rotates; rise and stiffness are then in angles", gt=0,
        optional=True)
    mass = Quantity("m", "kg", "Mass of the driven link, if it slides; rise and stiffness are then in lengths", gt=0, optional=True)
    stiffness = Quantity("K", "N*m/rad", "Stiffness of the drive between input and driven link", gt=0, units=(("mass", "N/m"),))
    damping_ratio = Quantity("ζ", "1", "Damping of the drive as a fraction of critical damping", ge=0, lt=1, default=0.05)
    rest_tolerance = Quantity("e", "deg", "Deflection within which the link counts as at rest; required for the settling", gt=0,
        units=(("mass", "mm"),), optional=True)
    rise = Quantity("h", "rad", "Rise of the input, between two rests", gt=0, units=(("mass", "m"),), optional=True)
    rise_time = Quantity("t_1", "s", "Duration of the rise; with cycles_per_hour as a fraction of the cycle", gt=0, units=(("cycles_per_hour", "1"),),
        optional=True)
    motion_law = Text("Law of motion of the rise; not used with motion_curve", options=LAWS, default="cycloidal")
    motion_curve = CurveInput("y_c", "rad",
        "Position of the input by reference, over time or over an angle; instead of rise, rise_time and motion_law", referred=True,
        units=(("mass", "m"),), optional=True)
    cycles_per_hour = Quantity("n", "1/h", "Cycle rate: one period of motion_curve each; or the cycles of which rise_time is a fraction", gt=0,
        optional=True)
    dwell_cycles = Quantity("n_f", "1", "Number of natural periods for which the vibration after the motion is calculated", gt=0, le=50, default=3)
    allowable_peak_ratio = Quantity("[q]", "1", "Allowable ratio of the link's peak acceleration during the rise to the rigid-drive value", gt=0,
        default=1.1)
    allowable_residual_ratio = Quantity("[q_r]", "1", "Allowable ratio of the peak acceleration after the rise to the rigid-drive value", gt=0,
        default=0.2)
    allowable_torque = Quantity("[M]", "N*m", "Allowable torque (or force) of the drive", gt=0, units=(("mass", "N"),), optional=True)
    n_points = samples(720)
