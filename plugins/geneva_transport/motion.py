"""Chapters on the wheel's geometry, its motion over a turn of the crank, and the conveyor's."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Abscissa, Breakpoints, Case, Chapter, Choice, Reduction, Require, Value, Words, bind
from diecut_report.mechanics import common
from diecut_report.plugins.geneva_transport import advice, formulas

CONVEYOR_NEEDS = ("sprocket_teeth", "chain_pitch")

GEOMETRY = Chapter(
    "Wheel, crank and slots",
    text="The roller enters and leaves the slots along their direction, so without a blow: crank and slot then stand square to each other.",
    steps=(
        Value(id="step_angle", symbol="τ", unit="deg", description="Step of the wheel", source="000, Fig. 1", digits=6,
              formula=formulas.step_angle),
        Value(id="crank_ratio", symbol="λ", description="Crank radius to centre distance", source="geometry",
              formula=formulas.crank_ratio),
        Value(id="crank_radius", symbol="r", unit="mm", description="Radius of the crank", source="geometry", formula=formulas.crank_radius),
        Value(id="wheel_radius", symbol="R", unit="mm", description="Radius of the wheel: the roller's distance from its axis at entry",
              source="geometry", formula=formulas.wheel_radius),
        Require(id="roller_below_crank", condition=bind(common.is_below, smaller="roller_radius", greater="crank_radius"),
                key="roller_radius", message="is {roller_radius}, but the roller would cover the crank's axis: it must be smaller than "
                "the crank radius C·sin(π/z) = {crank_radius:down}"),
        Value(id="rim_radius", symbol="R_o", unit="mm", description="Radius of the wheel's rim, where both flanks guide the roller from its entry on",
              source="geometry", formula=formulas.rim_radius),
        Value(id="slot_length", symbol="l", unit="mm", description="Length of the slots from the radius R", source="geometry",
              formula=formulas.slot_length),
        Value(id="nearest_distance", symbol="d_0", unit="mm", description="Roller's least distance from the wheel's axis", source="geometry",
              formula=formulas.nearest_roller),
        Require(id="slot_before_axis", condition=bind(common.is_below, smaller="roller_radius", greater="nearest_distance"),
                key="roller_radius", message="is {roller_radius}, but the slots would reach beyond the wheel's axis: the roller comes within "
                "C(1 − λ) = {nearest_distance:down} of it and must be smaller than that"),
        Value(id="hub_radius_max", symbol="r_h", unit="mm", description="Radius of hub and shaft that the slots leave", source="geometry",
              formula=bind(common.difference, greater="nearest_distance", smaller="roller_radius")),
        Value(id="slot_spacing", symbol="e", unit="mm", description="Distance of neighbouring slots' middles at their inner ends", source="geometry",
              formula=formulas.slot_spacing),
        Value(id="slot_width", symbol="b_s", unit="mm", description="Width of the slots", source="geometry",
              formula=bind(common.twice, quantity="roller_radius")),
        Value(id="roller_clearance", symbol="w", unit="mm", description="Wall between neighbouring slots at their inner ends",
              source="geometry", formula=bind(common.difference, greater="slot_spacing", smaller="slot_width")),
    ),
)  # fmt: skip

DWELL = Chapter(
    "Motion and dwell",
    steps=(
        Value(id="engagement_half_angle", symbol="α_e", unit="deg", description="Crank angle from the middle of the motion to the roller's exit",
              source="geometry", digits=6, formula=formulas.engagement_half_angle),
        Value(id="entry_angle", symbol="α_in", unit="deg", description="Crank angle at which the roller enters the next slot",
              source="geometry", digits=6, formula=formulas.entry_angle),
        Value(id="motion_fraction", symbol="κ_m", description="Share of a turn in which the wheel turns", source="geometry",
              formula=formulas.motion_fraction),
        Value(id="dwell_fraction", symbol="κ_d", description="Share of a turn in which it dwells", source="geometry",
              formula=formulas.dwell_fraction),
        Value(id="cycle_time", symbol="T", unit="ms", description="Time of a turn of the crank", source="kinematics",
              formula=formulas.cycle_time),
        Value(id="time_motion", symbol="t_m", unit="ms", description="Time of the motion", source="kinematics",
              formula=formulas.time_motion),
        Value(id="time_dwell", symbol="t_d", unit="ms", description="Time of the dwell", source="kinematics",
              formula=formulas.time_dwell),
        Value(id="speed_ratio_peak", symbol="ω_21,max", description="Greatest speed of the wheel to the crank's, in the middle of the motion",
              source="kinematics", formula=formulas.speed_ratio_peak),
        Value(id="acceleration_entry", symbol="ε_21,e", source="kinematics",
              description="Jump of the wheel's acceleration at entry and exit, to the square of the crank's speed",
              formula=formulas.acceleration_entry),
        Value(id="acceleration_peak_angle", symbol="α_ε", unit="deg", source="kinematics", digits=6,
              description="Crank angle before and after the middle of the motion at which the acceleration is greatest",
              formula=formulas.acceleration_peak_angle),
    ),
)  # fmt: skip


def _moving(name: str, symbol: str, unit: str, description: str, moving: Case, rest: Case, *, output: bool) -> Choice:
    """A curve of the wheel: one formula while the roller is in a slot, another one in the dwell."""
    return Choice(id=name, symbol=symbol, unit=unit, description=description, source="kinematics", output=output,
                  cases=(moving, rest))  # fmt: skip


IN_SLOT = bind(formulas.holds, flag="engaged")
MOVING, RESTING = "the roller is in a slot", "the locking disc holds the wheel"

MOTION = Chapter(
    "Motion over a turn of the crank",
    text="The crank angle is counted from the middle of the motion, so that the turn begins and ends within an engagement; α′ counts from "
    "the middle of the present engagement. The wheel turns against the crank; its angle is counted in its own direction. "
    "s and n hold for a whole piece of the turn and are shown in its middle, all other curves at the one α that is named.",
    steps=(
        Abscissa(id="crank_angle", symbol="α", unit="deg", description="Crank angle from the middle of the motion", period=2 * np.pi,
                 shown_at="acceleration_peak_at"),
        Breakpoints(id="engagement", abscissa="crank_angle", places=("engagement_half_angle", "entry_angle")),
        Choice(id="engaged", symbol="s", description="Whether the roller is in a slot (1) or not (0)", output=False, per_piece=True,
               cases=(Case(common.one, MOVING,
                           bind(formulas.is_inside, angle="crank_angle", start="entry_angle", end="engagement_half_angle")),
                      Case(common.zero, RESTING))),
        Choice(id="turns", symbol="n", description="Steps of the wheel that are done", output=False, per_piece=True,
               cases=(Case(common.one, "the roller has entered the next slot",
                           bind(common.is_at_least, greater="crank_angle", smaller="entry_angle")),
                      Case(common.zero, "the roller has not yet entered the next slot"))),
        Value(id="middle_angle", symbol="α′", unit="deg", description="Crank angle from the middle of the present engagement", output=False,
              source="kinematics", formula=formulas.from_middle),
        _moving("wheel_angle", "ψ", "deg", "Angle of the wheel from where it is in the middle of its motion",
                Case(bind(formulas.wheel_angle, angle="middle_angle"), MOVING, IN_SLOT),
                Case(bind(common.half, quantity="step_angle"), RESTING), output=True),
        _moving("speed_ratio", "ω_21", "1", "Angular speed of the wheel to the crank's",
                Case(bind(formulas.speed_ratio, angle="middle_angle"), MOVING, IN_SLOT), Case(common.zero, RESTING), output=False),
        _moving("acceleration_ratio", "ε_21", "1", "Angular acceleration of the wheel to the square of the crank's speed",
                Case(bind(formulas.acceleration_ratio, angle="middle_angle"), MOVING, IN_SLOT), Case(common.zero, RESTING), output=False),
        Reduction(id="acceleration_peak", symbol="ε_21,max", of="acceleration_ratio", operation="max", source="kinematics",
                  description="Greatest acceleration of the wheel to the square of the crank's speed"),
        Value(id="wheel_speed", symbol="ω_2", unit="rad/s", description="Angular speed of the wheel", source="kinematics",
              formula=bind(formulas.rate, ratio="speed_ratio")),
        Value(id="wheel_acceleration", symbol="ε_2", unit="rad/s**2", description="Angular acceleration of the wheel", source="kinematics",
              formula=bind(formulas.rate_of_rate, ratio="acceleration_ratio")),
        Value(id="wheel_speed_max", symbol="ω_2,max", unit="rad/s", description="Greatest angular speed of the wheel", source="kinematics",
              formula=bind(formulas.rate, ratio="speed_ratio_peak")),
        Value(id="wheel_acceleration_max", symbol="ε_2,max", unit="rad/s**2", description="Greatest angular acceleration of the wheel",
              source="kinematics", formula=bind(formulas.rate_of_rate, ratio="acceleration_peak")),
    ),
)  # fmt: skip

CONVEYOR = Chapter(
    "Motion of the sheet",
    needs=CONVEYOR_NEEDS,
    absent="not calculated: sprocket_teeth and chain_pitch are not both given",
    steps=(
        Value(id="travel_radius", symbol="r_c", unit="mm", description="Way of the conveyor for each radian of the wheel", source="000, Fig. 1",
              formula=formulas.travel_radius),
        Value(id="sheet_step", symbol="S", unit="mm", description="Step of the conveyor for each turn of the crank", source="000, Fig. 1",
              formula=formulas.sheet_step),
        Value(id="sheet_position", symbol="x", unit="mm", description="Position of the sheet from where it is in the middle of its motion",
              source="kinematics", formula=bind(formulas.travel, angle="wheel_angle")),
        Value(id="sheet_velocity", symbol="v", unit="m/s", description="Velocity of the sheet", source="kinematics",
              formula=bind(formulas.travel_rate, ratio="speed_ratio")),
        Value(id="sheet_acceleration", symbol="a", unit="m/s**2", description="Acceleration of the sheet", source="kinematics",
              formula=bind(formulas.travel_acceleration, ratio="acceleration_ratio")),
        Value(id="sheet_velocity_max", symbol="v_max", unit="m/s", description="Greatest velocity of the sheet", source="kinematics",
              formula=bind(formulas.travel_rate, ratio="speed_ratio_peak")),
        Value(id="sheet_acceleration_max", symbol="a_max", unit="m/s**2", description="Greatest acceleration of the sheet", source="kinematics",
              formula=bind(formulas.travel_acceleration, ratio="acceleration_peak")),
        Words(id="crank_slower", function=advice.slower_crank, takes=("crank_speed", "sheet_acceleration_max", "allowable_sheet_acceleration"),
              needs=("allowable_sheet_acceleration",)),
        Value(id="sheet_acceleration_entry", symbol="a_e", unit="m/s**2", description="Jump of the sheet's acceleration at entry and exit",
              source="kinematics", formula=bind(formulas.travel_acceleration, ratio="acceleration_entry")),
    ),
)  # fmt: skip
