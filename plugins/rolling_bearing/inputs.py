"""Inputs of rolling bearings."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal

from diecut_report.api import POINTS, Block, Inputs, OneOf, Quantity, Text, Varying

# fmt: off

RELIABILITIES = (90, 95, 96, 97, 98, 99)


class Bearing(Block):
    """A bearing with its load over one cycle."""

    one_of: ClassVar[tuple[OneOf, ...]] = (
        OneOf(("speed",), ("relative_angle", "cycle_speed")),
        OneOf(("dynamic_rating", "static_rating"), optional=True),
        OneOf(("x", "y", "e"), optional=True),
        OneOf(("x0", "y0"), optional=True),
    )

    name: Annotated[str, Text("Name, used as the prefix of its results")]
    type: Annotated[Literal["deep_groove", "ball", "roller"], Text("Type: deep groove, other ball or roller bearing")]
    designation: Annotated[str | None,
        Text("Designation, such as 6209 or NU2208E; looked up in the tables if no ratings are given, otherwise for information only")] = None
    series: Annotated[Literal["60", "62", "63", "NU2", "NU22", "NU3", "NU23"] | None,
        Text(
            "Series in which the smallest sufficient bearing is selected, without ratings and designation; default: 62 for deep groove ball "
                "bearings, NU2 for roller bearings")] = None
    bore_min: Annotated[float, Quantity("d_min", "mm", "Minimum bore of the bearing to be selected", ge=0, le=100)] = 0
    on: Annotated[str | None,
        Text(
            "Shaft (its mechanism) on which it sits: its bore is compared with the seat; default: the shaft whose reaction it bears, or that "
                "has its name")] = None
    dynamic_rating: Annotated[float | None, Quantity("C_g", "kN", "Basic dynamic load rating, from the manufacturer's catalogue", gt=0)] = None
    static_rating: Annotated[float | None, Quantity("C_0g", "kN", "Basic static load rating, from the manufacturer's catalogue", gt=0)] = None
    f0: Annotated[float | None,
        Quantity("f_0g", "1", "Factor f0 from the manufacturer's catalogue (deep_groove with axial force)", ge=10, le=17)] = None
    x: Annotated[float | None, Quantity("X_g", "1", "Radial factor (ball, roller, with axial force)", gt=0)] = None
    y: Annotated[float | None, Quantity("Y_g", "1", "Axial factor (ball, roller, with axial force)", gt=0)] = None
    e: Annotated[float | None, Quantity("e_g", "1", "Limit of F_a/F_r (ball, roller, with axial force)", gt=0)] = None
    x0: Annotated[float | None, Quantity("X_0g", "1", "Static radial factor; 0.6 of a deep groove ball bearing", ge=0)] = None
    y0: Annotated[float | None, Quantity("Y_0g", "1", "Static axial factor; 0.5 of a deep groove ball bearing", ge=0)] = None
    radial_force: Annotated[Any, Varying("F_rg", "N", "Radial force, a number or a curve over one cycle")]
    axial_force: Annotated[Any, Varying("F_ag", "N", "Axial force, a number or a curve over one cycle")] = 0
    speed: Annotated[Any | None, Varying("n_g", "rpm", "Relative speed of the rings, a number or a curve over one cycle")] = None
    relative_angle: Annotated[Any | None, Varying("θ_g", "deg", "Relative angle of the rings: a curve over one cycle, instead of speed")] = None
    cycle_speed: Annotated[float | None,
        Quantity("n_c", "rpm", "Cycle rate of the relative angle, as a speed: 1 r/min is one cycle per minute", gt=0)] = None
    rolling_elements: Annotated[int | None,
        Quantity("Z_g", "1", "Number of rolling elements per row, for the minimum swing", ge=5, integer=True)] = None
    a_iso: Annotated[float,
        Quantity("a_ISO", "1", "Life modification factor for lubrication and contamination (ISO 281, clause 9)", ge=0.1, le=50)] = 1
    tilt: Annotated[float | None,
        Quantity("ψ_g", "mrad", "Misalignment of the rings: slope of the shaft; for a pin its own and that of its support", ge=0)] = None
    permitted_tilt: Annotated[float | None,
        Quantity("ψ_zul,g", "mrad",
            "Misalignment permitted by the manufacturer; default: 0.58 for ball bearings (2′), 0.87 for roller bearings N, NJ and NU (3′), "
                "0.29 for others (1′)", gt=0)] = None
    limiting_speed: Annotated[float | None, Quantity("n_lim", "rpm", "Limiting speed, from the manufacturer's catalogue", gt=0)] = None


class RollingBearing(Inputs):
    """Keys of ``rolling_bearing``."""

    bearings: Annotated[list[Bearing], Text("Bearings")]
    reliability: Annotated[float, Quantity("R", "%", "Reliability of the life", listed=RELIABILITIES)] = 90
    required_life: Annotated[float, Quantity("[L]", "h", "Required life", gt=0)] = 20000
    required_static_safety: Annotated[float | None,
        Quantity("[s_0]", "1", "Required static safety factor; default: 1 for ball, 1.5 for roller bearings", gt=0)] = None
    service_factor: Annotated[float, Quantity("f_s", "1", "Factor on all forces, for shocks not included in the curves", ge=1)] = 1
    n_points: Annotated[int, POINTS] = 360
