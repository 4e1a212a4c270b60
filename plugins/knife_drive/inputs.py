"""Inputs of the folding knife's drive."""

from __future__ import annotations

from typing import Any

from diecut_report.api import Block, Inputs, Quantity, Text, block, samples

# fmt: off

MOST_RATIO = 1000


def _length(symbol: str, description: str, **otherwise: Any) -> Quantity:
    return Quantity(symbol, "mm", description, gt=0, le=1e5, **otherwise)


class Planetary(Block):
    """Keys of the planetary (hypocycloidal) drive."""

    carrier_radius = _length("r_v", "Planetary drive: radius of the carrier, which is also that of the knife's arm")


class CrankSlider(Block):
    """Keys of the crank-slider drive."""

    crank_radius = _length("r", "Crank-slider: radius of the crank")
    rod_length = _length("l", "Crank-slider: length of the rod, longer than the crank")


class CrankRocker(Block):
    """Keys of the crank-rocker drive."""

    crank = _length("a", "Crank-rocker: length of the crank, the shortest link")
    coupler = _length("b", "Crank-rocker: length of the coupler")
    rocker = _length("c", "Crank-rocker: length of the rocker")
    frame = _length("d_f", "Crank-rocker: distance of the pivots of crank and rocker")
    knife_arm = _length("R", "Crank-rocker: distance of the knife's edge from the rocker's pivot")
    lowest_dead_center = Text("Crank-rocker: dead centre of the rocker at which the knife is lowest, outer (crank and coupler extended) or inner",
        ("outer", "inner"), default="outer")


class KnifeDrive(Inputs):
    """Keys of ``knife_drive``."""

    cylinder_rate = Quantity("n", "1/h", "Revolutions of the plate cylinder per hour", gt=0, le=1e6, default=25000)
    drive_ratio = Quantity("i_1", "1", "Revolutions of the knife shaft per revolution of the plate cylinder", gt=0, le=MOST_RATIO, default=2)
    working_depth = _length("h", "Travel of the knife's edge below the table, down to its lowest point")
    roller_diameter = _length("d", "Diameter of the folding rollers", default=80)
    roller_ratio = Quantity("i_r", "1", "Revolutions of the folding rollers per revolution of the knife shaft", gt=0, le=MOST_RATIO, default=2)
    grip_angle = Quantity("φ_g", "deg",
        "Rotation of the knife shaft during which the rollers bring the signature to their speed; it ends at the knife's lowest point", gt=0, le=180,
        default=5)
    grip_speed = Quantity("V_g", "m/s", "Speed of the signature when gripping begins; default: that of the knife there", ge=0, le=1000, optional=True)
    signature_length = _length("L", "Length of the signature, half the cut-off; required for its time on the table", optional=True)
    planetary = block(Planetary, "Planetary drive", optional=True)
    crank_slider = block(CrankSlider, "Crank-slider drive", optional=True)
    crank_rocker = block(CrankRocker, "Crank-rocker drive", optional=True)
    allowable_paper_acceleration = Quantity("[a]", "m/s**2", "Allowable acceleration of the paper by the knife", gt=0, default=1000)
    allowable_grip_acceleration = Quantity("[a_g]", "m/s**2", "Allowable acceleration of the paper in the grip of the rollers", gt=0, default=10000)
    n_points = samples(720)
