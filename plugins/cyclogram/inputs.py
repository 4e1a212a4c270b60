"""Inputs of the cyclogram."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal

from diecut_report.api import POINTS, Block, FromPress, Inputs, MechanismInput, OneOf, Quantity, Text

# fmt: off

PHASE = "the phase of a line, as mechanism.phase, or mechanism.phase.k for its k-th interval alone, counted from 0"


def _turns(symbol: str, of: str) -> Text:
    return Text(f"Revolutions of the shaft of {of} per sheet, a number or a ratio such as 1/2", symbol=symbol)


class Passage(Block):
    """A stretch of the sheet's way of which it is known what it passes there."""

    name: Annotated[str, Text("Name of the phase")]
    __annotations__["from"] = Annotated[
        float, Quantity("s_1", "mm", "Displacement from the dwell at which it begins", ge=0)
    ]
    to: Annotated[float, Quantity("s_2", "mm", "Displacement from the dwell at which it ends", gt=0)]
    every: Annotated[int, Quantity("k", "1", "One of this number of steps passes", ge=1, le=12, integer=True)] = 1
    first: Annotated[int, Quantity("k_0", "1", "Number of the first step that passes", ge=0, le=11, integer=True)] = 0


class LineKeys(Block):
    """A mechanism that the main shaft drives."""

    mechanism: Annotated[Any, MechanismInput("Mechanism that is a line")]
    turns_per_sheet: Annotated[str, _turns("i", "the line")] = "1"
    offset: Annotated[float,
        Quantity("Φ_0", "deg", "Main-shaft angle of the line's own zero; auto: the one with the largest margins", ge=-3600, le=3600,
            plausible=("1e-6 deg", "3600 deg"), words=("auto",))] = 0
    path_efficiency: Annotated[float, Quantity("η", "1", "Efficiency from the main shaft to the shaft of the line's torque", gt=0, le=1)] = 1
    torque_curve: Annotated[str, Text("Name of a torque curve of the line, such as `torque`, if not the default of its kind")] = ""
    passing: Annotated[list[Passage], Text("Stations that the sheet passes")] = []  # noqa: RUF012


class InterlockKeys(Block):
    """What must lie within, or apart from, what."""

    name: Annotated[str, Text("Name of the interlock")]
    phase: Annotated[str, Text(f"What must be contained: {PHASE}")]
    within: Annotated[str, Text(f"What it must lie within: {PHASE}")] = ""
    apart_from: Annotated[str, Text(f"What it must lie apart from: {PHASE}")] = ""
    margin: Annotated[float,
        Quantity("m", "deg", "Required margin at both ends, as a main-shaft angle or a time", ge=0, le=360, or_unit="ms",
            plausible=("1e-6 deg", "360 deg"))] = 0


class StationKeys(Block):
    """Where the carriages stand below the cylinder."""

    cylinder: Annotated[Any, MechanismInput("Drive of the cylinder, one of the lines")]
    transport: Annotated[Any, MechanismInput("Sheet transport, one of the lines")]
    carriage_stop: Annotated[float, Quantity("x_s", "mm", "Position of the middle of a carriage along the feed, from the middle of the die")]
    carriage_width: Annotated[float, Quantity("w_c", "mm", "Length of a carriage along the feed", ge=0)]
    forward_direction: Annotated[Literal["with", "against"], Text("Direction of the forward stroke relative to the feed")]


class FrictionKeys(Block):
    """What takes a constant torque."""

    one_of: ClassVar[tuple[OneOf, ...]] = (OneOf(("torque",), ("power",)),)

    name: Annotated[str, Text("Name of the consumer")]
    torque: Annotated[float | None, Quantity("M_f", "N*m", "Torque at its own shaft", ge=0)] = None
    power: Annotated[float | None, Quantity("P_f", "kW", "Power", ge=0)] = None
    turns_per_sheet: Annotated[str, _turns("i_f", "the consumer")] = "1"
    path_efficiency: Annotated[float, Quantity("η_f", "1", "Efficiency from the main shaft to its shaft", gt=0, le=1)] = 1


class Cyclogram(Inputs):
    """Keys of ``cyclogram``."""

    productivity: Annotated[float | None, Quantity("n", "1/h", "Sheets per hour", gt=0, press=FromPress("press.productivity"))] = None
    lines: Annotated[list[LineKeys], Text("Mechanisms that the main shaft drives")]
    interlocks: Annotated[list[InterlockKeys], Text("Interlocks: what must lie within, or apart from, what")]
    station: Annotated[StationKeys | None, Text("Position of the carriages when they stand; required for the exact clearance")] = None
    friction: Annotated[list[FrictionKeys], Text("Consumers of constant torque")] = []  # noqa: RUF012
    n_points: Annotated[int, POINTS] = 720
