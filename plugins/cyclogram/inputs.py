"""Inputs of the cyclogram."""

from __future__ import annotations

from diecut_report.api import Block, FromPress, Inputs, MechanismInput, OneOf, Quantity, Text, block, parts, samples

# fmt: off

PHASE = "the phase of a line, as mechanism.phase, or mechanism.phase.k for its k-th interval alone, counted from 0"


def _turns(symbol: str, of: str) -> Text:
    return Text(f"Revolutions of the shaft of {of} per sheet, a number or a ratio such as 1/2", symbol=symbol, default="1")


class Passage(Block):
    """A stretch of the sheet's way of which it is known what it passes there."""

    name = Text("Name of the phase")
    from_ = Quantity("s_1", "mm", "Displacement from the dwell at which it begins", ge=0)
    to = Quantity("s_2", "mm", "Displacement from the dwell at which it ends", gt=0)
    every = Quantity("k", "1", "One of this number of steps passes", ge=1, le=12, integer=True, default=1)
    first = Quantity("k_0", "1", "Number of the first step that passes", ge=0, le=11, integer=True, default=0)


class LineKeys(Block):
    """A mechanism that the main shaft drives."""

    mechanism = MechanismInput("Mechanism that is a line")
    turns_per_sheet = _turns("i", "the line")
    offset = Quantity("Φ_0", "deg", "Main-shaft angle of the line's own zero; auto: the one with the largest margins", ge=-3600, le=3600,
        plausible=("1e-6 deg", "3600 deg"), words=("auto",), default=0)
    path_efficiency = Quantity("η", "1", "Efficiency from the main shaft to the shaft of the line's torque", gt=0, le=1, default=1)
    torque_curve = Text("Name of a torque curve of the line, such as `torque`, if not the default of its kind", default="")
    passing = parts(Passage, "Stations that the sheet passes", optional=True)


class InterlockKeys(Block):
    """What must lie within, or apart from, what."""

    name = Text("Name of the interlock")
    phase = Text(f"What must be contained: {PHASE}")
    within = Text(f"What it must lie within: {PHASE}", default="")
    apart_from = Text(f"What it must lie apart from: {PHASE}", default="")
    margin = Quantity("m", "deg", "Required margin at both ends, as a main-shaft angle or a time", ge=0, le=360, or_unit="ms",
        plausible=("1e-6 deg", "360 deg"), default=0)


class StationKeys(Block):
    """Where the carriages stand below the cylinder."""

    cylinder = MechanismInput("Drive of the cylinder, one of the lines")
    transport = MechanismInput("Sheet transport, one of the lines")
    carriage_stop = Quantity("x_s", "mm", "Position of the middle of a carriage along the feed, from the middle of the die")
    carriage_width = Quantity("w_c", "mm", "Length of a carriage along the feed", ge=0)
    forward_direction = Text("Direction of the forward stroke relative to the feed", ("with", "against"))


class FrictionKeys(Block):
    """What takes a constant torque."""

    one_of = (OneOf(("torque",), ("power",)),)

    name = Text("Name of the consumer")
    torque = Quantity("M_f", "N*m", "Torque at its own shaft", ge=0, optional=True)
    power = Quantity("P_f", "kW", "Power", ge=0, optional=True)
    turns_per_sheet = _turns("i_f", "the consumer")
    path_efficiency = Quantity("η_f", "1", "Efficiency from the main shaft to its shaft", gt=0, le=1, default=1)


class Cyclogram(Inputs):
    """Keys of ``cyclogram``."""

    productivity = Quantity("n", "1/h", "Sheets per hour", gt=0, press=FromPress("press.productivity"))
    lines = parts(LineKeys, "Mechanisms that the main shaft drives")
    interlocks = parts(InterlockKeys, "Interlocks: what must lie within, or apart from, what")
    station = block(StationKeys, "Position of the carriages when they stand; required for the exact clearance", optional=True)
    friction = parts(FrictionKeys, "Consumers of constant torque", optional=True)
    n_points = samples(720)
