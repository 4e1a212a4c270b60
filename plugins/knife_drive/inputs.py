"""Inputs of the folding knife's drive."""

from __future__ import annotations

from typing import Literal

from diecut_report.api import POINTS, Annotated, Block, Inputs, Quantity, Text

# fmt: off

MOST_RATIO = 1000


def _length(symbol: str, description: str) -> Quantity:
    return Quantity(symbol, "mm", description, gt=0, le=1e5)


class Planetary(Block):
    """Keys of the planetary (hypocycloidal) drive."""

    carrier_radius: Annotated[float, _length("r_v", "Planetary drive: radius of the carrier, which is also that of the knife's arm")]


class CrankSlider(Block):
    """Keys of the crank-slider drive."""

    crank_radius: Annotated[float, _length("r", "Crank-slider: radius of the crank")]
    rod_length: Annotated[float, _length("l", "Crank-slider: length of the rod, longer than the crank")]


class CrankRocker(Block):
    """Keys of the crank-rocker drive."""

    crank: Annotated[float, _length("a", "Crank-rocker: length of the crank, the shortest link")]
    coupler: Annotated[float, _length("b", "Crank-rocker: length of the coupler")]
    rocker: Annotated[float, _length("c", "Crank-rocker: length of the rocker")]
    frame: Annotated[float, _length("d_f", "Crank-rocker: distance of the pivots of crank and rocker")]
    knife_arm: Annotated[float, _length("R", "Crank-rocker: distance of the knife's edge from the rocker's pivot")]
    lowest_dead_center: Annotated[Literal["outer", "inner"],
        Text("Crank-rocker: dead centre of the rocker at which the knife is lowest, outer (crank and coupler extended) or inner")] = "outer"


class KnifeDrive(Inputs):
    """Keys of ``knife_drive``."""

    cylinder_rate: Annotated[float, Quantity("n", "1/h", "Revolutions of the plate cylinder per hour", gt=0, le=1e6)] = 25000
    drive_ratio: Annotated[float,
        Quantity("i_1", "1", "Revolutions of the knife shaft per revolution of the plate cylinder", gt=0, le=MOST_RATIO)] = 2
    working_depth: Annotated[float, _length("h", "Travel of the knife's edge below the table, down to its lowest point")]
    roller_diameter: Annotated[float, _length("d", "Diameter of the folding rollers")] = 80
    roller_ratio: Annotated[float,
        Quantity("i_r", "1", "Revolutions of the folding rollers per revolution of the knife shaft", gt=0, le=MOST_RATIO)] = 2
    grip_angle: Annotated[float,
        Quantity("φ_g", "deg",
            "Rotation of the knife shaft during which the rollers bring the signature to their speed; it ends at the knife's lowest point", gt=0,
            le=180)] = 5
    grip_speed: Annotated[float | None,
        Quantity("V_g", "m/s", "Speed of the signature when gripping begins; default: that of the knife there", ge=0, le=1000)] = None
    signature_length: Annotated[float | None, _length("L", "Length of the signature, half the cut-off; required for its time on the table")] = None
    planetary: Annotated[Planetary | None, Text("Planetary drive")] = None
    crank_slider: Annotated[CrankSlider | None, Text("Crank-slider drive")] = None
    crank_rocker: Annotated[CrankRocker | None, Text("Crank-rocker drive")] = None
    allowable_paper_acceleration: Annotated[float, Quantity("[a]", "m/s**2", "Allowable acceleration of the paper by the knife", gt=0)] = 1000
    allowable_grip_acceleration: Annotated[float,
        Quantity("[a_g]", "m/s**2", "Allowable acceleration of the paper in the grip of the rollers", gt=0)] = 10000
    n_points: Annotated[int, POINTS] = 720
