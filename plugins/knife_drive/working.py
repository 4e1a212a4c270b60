"""The chapters on speeds and rollers, and the working stroke: one model for all drives."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np

from diecut_report.api import (
    Chapter,
    Step,
    Steps,
    abscissa,
    as_number,
    case,
    choice,
    formula,
    inner,
    m,
    phrase,
    pi,
    prefixed,
    reduction,
    value,
)

# fmt: off


@formula
def planetary_velocity(crank_angle: Any, carrier_radius: Any, crank_speed: Any) -> Any:
    """Velocity of the edge, upwards."""
    return 2 * carrier_radius * crank_speed * np.cos(crank_angle)


@formula
def planetary_acceleration(crank_angle: Any, carrier_radius: Any, crank_speed: Any) -> Any:
    """Acceleration of the edge, upwards."""
    return -2 * carrier_radius * crank_speed**2 * np.sin(crank_angle)


@formula
def holds(flag: Any) -> Any:
    """Whether a flag is set."""
    return flag > 0


DRIVES = ("planetary", "crank_slider", "crank_rocker")


class DriveKind(NamedTuple):
    """A drive: its block's key, its name in words, its letter in figure 1 of the source, what makes its stroke greater, in words and by its key."""

    key: str
    name: str
    letter: str
    longer: str
    stroke_key: str


PLANETARY = DriveKind("planetary", phrase("planetary drive"), "a", "a greater carrier_radius", "carrier_radius")
CRANK_SLIDER = DriveKind("crank_slider", phrase("crank-slider"), "b", "a greater crank_radius", "crank_radius")
CRANK_ROCKER = DriveKind("crank_rocker", phrase("crank-rocker"), "c", "a longer knife_arm or a wider swing", "knife_arm")
ALL = (PLANETARY, CRANK_SLIDER, CRANK_ROCKER)
Drives = tuple[DriveKind, ...]


def groups(least: int = 1) -> tuple[Drives, ...]:
    """The drives that may be given together, of so many drives at least."""
    return tuple(group for size in range(least, len(ALL) + 1) for group in combinations(ALL, size))


def keys(drives: Drives) -> tuple[str, ...]:
    """The blocks of drives."""
    return tuple(drive.key for drive in drives)


def lacking(drives: Drives) -> tuple[str, ...]:
    """The blocks of the other drives."""
    return tuple(drive.key for drive in ALL if drive not in drives)


speeds = Chapter("Knife shaft and folding rollers",
    text="The crank angle of each drive has its own origin. Displacement, velocity and acceleration of the knife's edge count upwards.")
speeds.require("any_drive", 0 >= 1, key="planetary",
    message="no drive is given; give at least one of the blocks planetary, crank_slider and crank_rocker", lacks=DRIVES)
speeds.crank_speed = 2 * pi * m.cylinder_rate * m.drive_ratio, "ω_1", "rad/s", "Angular speed of the knife shaft", "kinematics"
speeds.cycle_time = 2 * pi / m.crank_speed, "T", "ms", "Time of a revolution of the knife shaft", "004, after Fig. 3"
speeds.roller_velocity = pi * m.roller_diameter * m.roller_ratio / m.cycle_time, "V_r", "m/s", "Surface speed of the rollers", "kinematics"
speeds.grip_time = (m.grip_angle * m.cycle_time / (2 * pi), "t_g", "ms", "Time for the rollers to bring the signature to their speed",
    "004, after Fig. 3")
speeds.roller_time = (value((m.signature_length - m.working_depth) / m.roller_velocity, needs=("signature_length",)), "t_r", "ms",
    "Time from the knife's lowest point until the trailing edge has left the table", "kinematics")
speeds.signature_interval = (value(m.cycle_time * m.drive_ratio / 2, needs=("signature_length",)), "t_s", "ms", "Time between two signatures",
    "kinematics")
speeds.strokes_per_signature = (m.drive_ratio / 2, "k_s", "1",
    "Strokes of the knife per signature: a signature comes each half turn of the plate cylinder", "kinematics")
speeds.stroke_error = inner(abs(m.strokes_per_signature - 1)), "Δk", "1", "Deviation from one stroke per signature", "kinematics"
speeds.crank_angle = abscissa(2 * np.pi, speed="crank_speed"), "φ", "deg", "Crank angle"

WORKING = Steps()
WORKING.working_time = m.working_angle * m.cycle_time / (2 * pi), "t_w", "ms", "Duration of the working stroke", "kinematics"
WORKING.contact_velocity = abs(m.contact_rate), "V_t", "m/s", "Speed of the edge as it meets the signature on the table", "kinematics"
WORKING.breakpoints("working_ends", "crank_angle", "contact_angle", "lowest_angle")
WORKING.working = (choice(case(1, "within the working stroke", np.cos(m.crank_angle - m.lowest_angle + m.working_angle / 2)
    > np.cos(m.working_angle / 2)), case(0, "outside the working stroke"), output=False, per_piece=True), "s_", "1",
    "Knife leads the signature (1) or not (0)")
WORKING.paper_acceleration = (choice(case(m.acceleration, "within the working stroke", holds.of(flag=m.working)),
    case(0, "outside the working stroke"), output=False), "a_p", "m/s**2", "Acceleration of the signature while the knife leads it")
WORKING.acceleration_peak = reduction("abs_max", of="paper_acceleration"), "a_m", "m/s**2", "Maximum acceleration in the working stroke"
WORKING.end_factor = (2 * m.acceleration_end / (m.stroke * as_number(m.crank_speed) ** 2), "k_", "1",
    "Ratio of the acceleration at the lowest point to that of a harmonic motion of the same stroke, H·ω₁²/2", "this method")
WORKING.grip_velocity = value(m.grip_speed, needs=("grip_speed",)), "V_g", "m/s", "Speed of the signature when gripping begins", "input"
WORKING.grip_velocity = value(abs(m.grip_rate), lacks=("grip_speed",)), "V_g", "m/s", "Speed of the edge when gripping begins", "kinematics"
WORKING.grip_acceleration = ((m.roller_velocity - m.grip_velocity) / m.grip_time, "a_g", "m/s**2",
    "Acceleration of the signature in the grip of the rollers", "004, after Fig. 3")
WORKING.grip_size = inner(abs(m.grip_acceleration)), "a_s", "m/s**2", "Absolute acceleration in the grip of the rollers"
WORKING.table_time = (value(m.working_time + m.roller_time, needs=("signature_length",)), "t_t", "ms",
    "Time of the signature on the table, from contact on", "kinematics")


SIGNATURE_BEYOND_DEPTH = Steps()
SIGNATURE_BEYOND_DEPTH.require("signature_beyond_depth", m.working_depth < m.signature_length, key="signature_length",
    message="is {signature_length}, but the knife alone takes {working_depth} of the signature (working_depth) below the table; make "
    "signature_length greater than that", needs=("signature_length",))


def reaches(drive: DriveKind) -> Steps:
    """The edge must rise above the table."""
    steps = Steps()
    steps.require("rises", m.working_depth <= m.stroke, key="working_depth",
        message=f"is {{working_depth}}, but the edge of the {drive.name} travels {{{drive.key}_stroke}} in all: it would never rise above the "
        f"table; make the depth at most {{{drive.key}_stroke:down}}, or the stroke greater with {drive.longer} in {drive.key}")
    return steps


def grips(drive: DriveKind) -> Steps:
    """The rollers grip what the knife has pushed to them."""
    steps = Steps()
    steps.require(f"{drive.key}_grips", m.grip_angle <= m[f"{drive.key}_working_angle"], key="grip_angle",
        message=f"is {{grip_angle}}, but the working stroke of the {drive.name} is {{{drive.key}_working_angle}}: the rollers would grip before the "
        f"knife meets the signature; make grip_angle at most {{{drive.key}_working_angle:down}}, or working_depth greater", needs=(drive.key,))
    return steps


def of_drive(drive: DriveKind, own: Iterable[Step]) -> Chapter:
    """The chapter of a drive: its own motion, then the working stroke."""
    family = (*own, *WORKING)
    chapter = Chapter(f"{drive.name[0].upper()}{drive.name[1:]}", needs=(drive.key,), absent=f"The {drive.name}: there is no block {drive.key}.")
    chapter.add(tuple(_told_apart(step, drive) for step in prefixed(f"{drive.key}_", family, shared=())))
    low, contact, leave = (f"{drive.key}_{place}_angle" for place in ("lowest", "contact", "leave"))
    for name, words, span in (
        ("working", "the knife leads the signature", (contact, low)),
        ("below", "the edge is below the table", (contact, leave)),
    ):
        chapter.phase(f"{drive.key}_{name}", "working", f"{drive.name[0].upper()}{drive.name[1:]}: {words}", "crank_angle", span)
    chapter.phase(f"{drive.key}_clear", "window", f"{drive.name[0].upper()}{drive.name[1:]}: the edge is above the table", "crank_angle",
        rest_of=(f"{drive.key}_below",))
    return chapter


def _told_apart(step: Step, drive: DriveKind) -> Step:
    """The step with the drive's letter in its symbol and, where it is a result, the drive's name in its description."""
    name, said = f"{drive.name[0].upper()}{drive.name[1:]}", step.description
    return replace(
        step,
        symbol=step.symbol and f"{step.symbol}{'' if step.symbol.endswith('_') else ','}{drive.letter}",
        description=f"{name}: {said[0].lower()}{said[1:]}" if said and step.output else said,
    )
