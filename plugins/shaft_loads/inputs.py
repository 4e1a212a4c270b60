"""Inputs of the loads of a shaft."""

from __future__ import annotations

from typing import Annotated, Any

from diecut_report.api import POINTS, Block, Inputs, MechanismInput, Quantity, Text

# fmt: off


class LoadCurve(Block):
    """A curve of a mechanism, and how it is taken over."""

    name: Annotated[str, Text("Name of the part that it acts on")]
    mechanism: Annotated[Any, MechanismInput("Mechanism whose curve it is")]
    curve: Annotated[str, Text("Name of the curve")]
    turns_per_sheet: Annotated[str, Text("Revolutions of the mechanism's shaft per sheet, a number or a ratio such as 1/2", symbol="i")] = "1"
    offset: Annotated[float, Quantity("Φ_0", "deg", "Main-shaft angle of the mechanism's own zero", ge=-3600, le=3600)] = 0
    ratio: Annotated[float, Quantity("k", "1", "Factor on the curve; negative where it acts the other way")] = 1


class Torque(LoadCurve):
    """A torque on a part."""

    inertia: Annotated[float, Quantity("J", "kg*m**2", "Inertia that turns an angular acceleration into a torque; 0 for a torque", ge=0)] = 0
    efficiency: Annotated[float, Quantity("η", "1", "Efficiency of the way from this shaft to the torque", gt=0, le=1)] = 1
    lag: Annotated[float,
        Quantity("Φ_τ", "deg", "Angle of the main shaft in the time constant with which a motor behind a flywheel follows the torque; 0: at once",
            ge=0)] = 0


class Force(LoadCurve):
    """A force on a part."""

    turns_per_sheet: Annotated[str, Text("Revolutions of the mechanism's shaft per sheet, a number or a ratio such as 1/2", symbol="i_F")] = "1"
    offset: Annotated[float, Quantity("Φ_F", "deg", "Main-shaft angle of the mechanism's own zero", ge=-3600, le=3600)] = 0
    ratio: Annotated[float, Quantity("k_F", "1", "Factor on the curve; negative where it acts the other way")] = 1
    inertia: Annotated[float, Quantity("J_F", "kg*m**2", "Inertia that turns an angular acceleration into a torque; 0 for others", ge=0)] = 0
    lever: Annotated[float, Quantity("r", "mm", "Radius at which a torque acts as this force; 0 for a force", ge=0)] = 0
    absolute: Annotated[bool, Text("The curve counts by its absolute value: the pull of a chain on its sprocket")] = False
    constant: Annotated[float, Quantity("F_0", "N", "Force that acts all the time")] = 0


class Hub(Block):
    """A part whose joint with its shaft passes the torque at its teeth or chain less what its own inertia takes."""

    name: Annotated[str, Text("Name of the part")]
    torque: Annotated[str, Text("Name of the torque at its teeth or chain, or balance for that which balances the others")]
    inertia: Annotated[str, Text("Name of the torque of its inertia")]


class Motion(Block):
    """How the shaft swings or turns in steps."""

    mechanism: Annotated[Any, MechanismInput("Mechanism that moves the shaft")]
    curve: Annotated[str, Text("Name of the curve of its angle")]
    turns_per_sheet: Annotated[str, Text("Revolutions of the mechanism's shaft per sheet, a number or a ratio such as 1/2", symbol="i_m")] = "1"
    offset: Annotated[float, Quantity("Φ_m", "deg", "Main-shaft angle of the mechanism's own zero", ge=-3600, le=3600)] = 0
    ratio: Annotated[float, Quantity("k_m", "1", "Factor on the angle")] = 1


class ShaftLoads(Inputs):
    """Keys of ``shaft_loads``."""

    main_turns: Annotated[int, Quantity("N_m", "1", "Revolutions of the main shaft in the cycle", ge=1, le=1000, integer=True)]
    torques: Annotated[list[Torque], Text("Torques on the parts")] = []  # noqa: RUF012
    hubs: Annotated[list[Hub], Text("Parts whose inertia counts at their own place")] = []  # noqa: RUF012
    forces: Annotated[list[Force], Text("Forces on the parts")] = []  # noqa: RUF012
    motion: Annotated[Motion | None, Text("How the shaft swings or turns in steps; without it, it turns steadily")] = None
    n_points: Annotated[int, POINTS] = 720


OF_CURVE = ("name", "mechanism", "curve", "turns_per_sheet", "offset", "ratio")
KEYS = (
    "main_turns",
    *(f"torques.{key}" for key in (*OF_CURVE, "inertia", "efficiency", "lag")),
    *(f"hubs.{key}" for key in ("name", "torque", "inertia")),
    *(f"forces.{key}" for key in (*OF_CURVE, "inertia", "lever", "absolute", "constant")),
    *(f"motion.{key}" for key in OF_CURVE[1:]),
)
