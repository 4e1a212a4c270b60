"""The chapters on speeds and rollers, and the working stroke: one model for all drives."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from typing import NamedTuple

import numpy as np

from diecut_report.api import (
    Abscissa,
    Breakpoints,
    Case,
    Chapter,
    Choice,
    Reduction,
    Require,
    Step,
    Value,
    bind,
    prefixed,
)
from diecut_report.mechanics import common
from diecut_report.plugins.knife_drive import formulas

DRIVES = ("planetary", "crank_slider", "crank_rocker")


class Drive(NamedTuple):
    """A drive: its block's key, its name in words, its letter in figure 1 of the source, what makes its stroke greater."""

    key: str
    name: str
    letter: str
    longer: str


PLANETARY = Drive("planetary", "planetary drive", "a", "a greater carrier_radius")
CRANK_SLIDER = Drive("crank_slider", "crank-slider", "b", "a greater crank_radius")
CRANK_ROCKER = Drive("crank_rocker", "crank-rocker", "c", "a longer knife_arm or a wider swing")
ALL = (PLANETARY, CRANK_SLIDER, CRANK_ROCKER)
Drives = tuple[Drive, ...]


def groups(least: int = 1) -> tuple[Drives, ...]:
    """The drives that may be given together, of so many drives at least."""
    return tuple(group for size in range(least, len(ALL) + 1) for group in combinations(ALL, size))


def keys(drives: Drives) -> tuple[str, ...]:
    """The blocks of drives."""
    return tuple(drive.key for drive in drives)


def lacking(drives: Drives) -> tuple[str, ...]:
    """The blocks of the other drives."""
    return tuple(drive.key for drive in ALL if drive not in drives)


SPEEDS = Chapter(
    "Knife's shaft and folding rollers",
    text="The crank angle of each drive has its own origin. Displacement, velocity and acceleration of the knife's edge count upwards.",
    steps=(
        Require(id="any_drive", lacks=DRIVES, condition=bind(common.is_at_least, greater=0, smaller=1), key="planetary",
                message="no drive is given; give at least one of the blocks planetary, crank_slider and crank_rocker"),
        Value(id="crank_speed", symbol="ω_1", unit="rad/s", description="Angular speed of the knife's shaft", source="kinematics",
              digits=6, formula=formulas.shaft_speed),
        Value(id="cycle_time", symbol="T", unit="ms", description="Time of a turn of the knife's shaft", source="004, after Fig. 3",
              formula=formulas.turn_time),
        Value(id="roller_velocity", symbol="V_r", unit="m/s", description="Speed of the rollers' surface", source="kinematics",
              formula=formulas.roller_velocity),
        Value(id="grip_time", symbol="t_g", unit="ms", description="Time in which the rollers bring the signature to their speed",
              source="004, after Fig. 3", formula=bind(formulas.time_of_angle, angle="grip_angle")),
        Value(id="roller_time", symbol="t_r", unit="ms", needs=("signature_length",),
              description="Time from the knife's lowest point until the trailing edge has left the table", source="kinematics",
              formula=formulas.roller_time),
        Value(id="signature_interval", symbol="t_s", unit="ms", needs=("signature_length",), description="Time between two signatures",
              source="kinematics", formula=formulas.signature_interval),
        Abscissa(id="crank_angle", symbol="φ", unit="deg", description="Crank angle", period=2 * np.pi),
    ),
)  # fmt: skip

WORKING = (
    Value(id="working_time", symbol="t_w", unit="ms", description="Duration of the working stroke", source="kinematics",
          formula=bind(formulas.time_of_angle, angle="working_angle")),
    Value(id="contact_velocity", symbol="V_t", unit="m/s", description="Speed of the edge as it meets the signature on the table",
          source="kinematics", formula=bind(common.size_of, quantity="contact_rate")),
    Breakpoints(id="working_ends", abscissa="crank_angle", places=("contact_angle", "lowest_angle")),
    Choice(id="working", symbol="s_", description="Whether the knife leads the signature (1) or not (0)", output=False, per_piece=True,
           cases=(Case(common.one, "within the working stroke", formulas.is_within), Case(common.zero, "outside the working stroke"))),
    Choice(id="paper_acceleration", symbol="W_p", unit="m/s**2", output=False,
           description="Acceleration of the signature while the knife leads it",
           cases=(Case(bind(common.same, quantity="acceleration"), "within the working stroke", bind(formulas.holds, flag="working")),
                  Case(common.zero, "outside the working stroke"))),
    Reduction(id="acceleration_peak", symbol="W_m", unit="m/s**2", description="Greatest acceleration in the working stroke",
              of="paper_acceleration", operation="abs_max"),
    Value(id="end_factor", symbol="k_", description="Acceleration at the lowest point to that of a harmonic motion of the same stroke, H·ω₁²/2",
          source="this method", formula=formulas.end_factor),
    Value(id="grip_velocity", symbol="V_g", unit="m/s", description="Speed of the signature when gripping begins", source="input",
          needs=("grip_speed",), formula=bind(common.same, quantity="grip_speed")),
    Value(id="grip_velocity", symbol="V_g", unit="m/s", description="Speed of the edge when gripping begins", source="kinematics",
          lacks=("grip_speed",), formula=bind(common.size_of, quantity="grip_rate")),
    Value(id="grip_acceleration", symbol="W_g", unit="m/s**2", description="Acceleration of the signature in the grip of the rollers",
          source="004, after Fig. 3", formula=formulas.grip_acceleration),
    Value(id="grip_size", symbol="W_s", unit="m/s**2", description="Size of the acceleration in the grip of the rollers", output=False,
          formula=bind(common.size_of, quantity="grip_acceleration")),
    Value(id="table_time", symbol="t_t", unit="ms", description="Time of the signature on the table, from contact on", source="kinematics",
          needs=("signature_length",), formula=bind(common.sum_of, first="working_time", second="roller_time")),
)  # fmt: skip


SIGNATURE_BEYOND_DEPTH = Require(
    id="signature_beyond_depth", needs=("signature_length",), key="signature_length",
    condition=bind(common.is_below, smaller="working_depth", greater="signature_length"),
    message="is {signature_length}, but the knife alone takes {working_depth} of the signature (working_depth) below the table; make "
    "signature_length greater than that",
)  # fmt: skip


def reaches(drive: Drive) -> Require:
    """The edge must rise above the table."""
    return Require(
        id="rises", key="working_depth", condition=bind(common.is_at_most, smaller="working_depth", greater="stroke"),
        message=f"is {{working_depth}}, but the edge of the {drive.name} travels {{{drive.key}_stroke}} in all: it would never rise above "
        f"the table; make the depth at most {{{drive.key}_stroke:down}}, or the stroke greater with {drive.longer} in {drive.key}",
    )  # fmt: skip


def grips(drive: Drive) -> Require:
    """The rollers grip what the knife has pushed to them."""
    return Require(
        id=f"{drive.key}_grips", key="grip_angle", needs=(drive.key,),
        condition=bind(common.is_at_most, smaller="grip_angle", greater=f"{drive.key}_working_angle"),
        message=f"is {{grip_angle}}, but the working stroke of the {drive.name} is {{{drive.key}_working_angle}}: the rollers would grip before "
        f"the knife meets the signature; make grip_angle at most {{{drive.key}_working_angle:down}}, or working_depth greater",
    )  # fmt: skip


def of_drive(drive: Drive, own: tuple[Step, ...]) -> Chapter:
    """The chapter of a drive: its own motion, then the working stroke."""
    family = (*own, *WORKING)
    return Chapter(
        f"{drive.name[0].upper()}{drive.name[1:]}",
        needs=(drive.key,),
        absent=f"The {drive.name}: there is no block {drive.key}.",
        steps=tuple(_told_apart(step, drive) for step in prefixed(f"{drive.key}_", family, shared=())),
    )


def _told_apart(step: Step, drive: Drive) -> Step:
    """The step with the drive's letter in its symbol and, where it is a result, the drive's name in its description."""
    name, said = f"{drive.name[0].upper()}{drive.name[1:]}", step.description
    return replace(
        step,
        symbol=step.symbol and f"{step.symbol}{'' if step.symbol.endswith('_') else ','}{drive.letter}",
        description=f"{name}: {said[0].lower()}{said[1:]}" if said and step.output else said,
    )
