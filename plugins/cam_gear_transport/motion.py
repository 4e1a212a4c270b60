"""Chapters on the motion of sector and gear over a turn of the disc."""

from __future__ import annotations

import numpy as np

from diecut_report.api import (
    Abscissa,
    Binding,
    Breakpoints,
    ByText,
    Case,
    Chapter,
    Choice,
    Crossings,
    Reduction,
    Value,
    bind,
)
from diecut_report.mechanics import common
from diecut_report.mechanics.motion_laws import ACCELERATION, JOINT, POSITION, VELOCITY
from diecut_report.plugins.cam_gear_transport import formulas


def _before(place: str) -> Binding:
    """Whether the disc is in a phase before a place."""
    return bind(common.is_below, smaller="piece_middle", greater=place)


def by_phase(dwell: Binding, stopping: Binding, returning: Binding, starting: Binding) -> tuple[Case, ...]:
    """What holds in the phases II, III, IV and I."""
    return (
        Case(dwell, "the disc is in phase II, the gear dwells", _before("dwell_angle")),
        Case(stopping, "the disc is in phase III, the sector stops", _before("angle_stop")),
        Case(returning, "the disc is in phase IV, the sector returns", _before("angle_start")),
        Case(starting, "the disc is in phase I, the sector starts"),
    )


RISE = {"sweep": "sector_stop_sweep", "time": "time_stop"}
FALL = {"sweep": "sector_sweep", "time": "time_return"}

SECTOR = Chapter(
    "Motion of the sector",
    text="The disc angle counts from the start of the dwell. γ is the sector's angle relative to the disc, counter-clockwise, 0 at the "
    "start of the dwell; k is the share of the rise or return that has passed, in the dwell that of the rise's middle, where it is as fast. "
    "φ_m and k_m hold for a whole phase and are shown in its middle, all other quantities at the one φ that is named.",
    steps=(
        Abscissa(id="disc_angle", symbol="φ", unit="deg", description="Disc angle from the start of the dwell", period=2 * np.pi,
                 shown_at="gear_power_peak_at"),
        Breakpoints(id="phases", abscissa="disc_angle", places=("dwell_angle", "angle_stop", "angle_start")),
        Value(id="piece_middle", symbol="φ_m", unit="deg", description="Disc angle in the middle of the present phase (or part of it)",
              source="this method", output=False, per_piece=True, formula=bind(common.same, quantity="disc_angle")),
        Choice(id="law_share", symbol="k", description="Share of the rise or return that has passed", source="003 eq. 2", output=False,
               cases=by_phase(bind(common.same, quantity=0.5), formulas.stopping_share,
                              bind(formulas.share_since, start="angle_stop", time="time_return"),
                              bind(formulas.share_since, start="angle_start", time="time_stop"))),
        Value(id="law_joint", symbol="j", description="Joint of the law: changes its sign where the law's formula changes", output=False,
              source="motion laws", formula=ByText("motion_law", JOINT, k="law_share")),
        Crossings(id="law_break", symbol="φ_j", unit="deg", description="Disc angle at which the law's formula changes, or a phase begins",
                  output=False, of="law_joint"),
        Breakpoints(id="law_breaks", abscissa="disc_angle", places=("law_break",)),
        Value(id="law_position", symbol="f", description="Law of motion: position at k", source="motion laws", output=False,
              formula=ByText("motion_law", POSITION, k="law_share")),
        Value(id="law_velocity", symbol="f′", description="Law of motion: velocity at k", source="motion laws", output=False,
              formula=ByText("motion_law", VELOCITY, k="law_share")),
        Value(id="law_middle", symbol="k_m", description="Share k in the middle of the present phase (or part of it)", source="this method",
              output=False, per_piece=True, formula=bind(common.same, quantity="law_share")),
        Value(id="law_side", symbol="k_i", output=False, source="this method",
              description="Share k just inside its piece: where the law's acceleration jumps, this tells the side",
              formula=bind(common.just_inside, share="law_share", middle="law_middle")),
        Value(id="law_acceleration", symbol="f″", description="Law of motion: acceleration at k", source="motion laws", output=False,
              formula=ByText("motion_law", ACCELERATION, k="law_side")),
        Choice(id="sector_angle", symbol="γ", unit="deg", description="Angle of the sector relative to the disc", source="003, Fig. 4",
               cases=by_phase(bind(formulas.rolled_angle), bind(formulas.stopping_angle), bind(formulas.returning_angle),
                              bind(formulas.starting_angle))),
        Choice(id="sector_speed", symbol="ω_3", unit="rad", description="Speed of the sector relative to the disc, per turn of the disc",
               source="003 eq. 1, 2, Fig. 6",
               cases=by_phase(bind(common.same, quantity="sector_speed_dwell"), bind(formulas.rise_speed, **RISE),
                              bind(formulas.fall_speed, **FALL), bind(formulas.rise_speed, **RISE))),
        Choice(id="sector_acceleration", symbol="ε_3", unit="rad/s**2", description="Angular acceleration of the sector",
               source="kinematics",
               cases=by_phase(common.zero, bind(formulas.rise_acceleration, **RISE), bind(formulas.fall_acceleration, **FALL),
                              bind(formulas.rise_acceleration, **RISE))),
        Value(id="rocker_turn", symbol="w", description="Angular speed of sector and rocker, to that of the disc", source="kinematics",
              output=False, formula=formulas.rocker_turn),
    ),
)  # fmt: skip

GEAR = Chapter(
    "Motion of the gear",
    text="The disc carries the gear along; what the sector rolls off is taken away. The gear's angle counts from where it dwells. Over a "
    "cycle the sector comes back to where it was, so the gear makes one turn.",
    steps=(
        Value(id="gear_angle", symbol="φ_1", unit="deg", description="Angle of the gear from its dwell", source="003, Fig. 3",
              formula=formulas.gear_angle),
        Value(id="gear_speed", symbol="ω_1", unit="rad", description="Speed of the gear, per turn of the disc", source="003, Fig. 7, corrected",
              formula=formulas.gear_speed),
        Value(id="gear_acceleration", symbol="ε_1", unit="rad/s**2", description="Angular acceleration of the gear", source="kinematics",
              formula=formulas.gear_acceleration),
        Value(id="gear_power", symbol="P_J", unit="W/(kg*m**2)", description="Power for each unit of inertia on the gear's shaft",
              source="energy", output=False, formula=formulas.gear_power),
        Reduction(id="gear_speed_peak", symbol="ω_1,max", unit="rad", description="Greatest speed of the gear, per turn of the disc",
                  source="003, Fig. 7, corrected", digits=5, of="gear_speed", operation="max"),
        Reduction(id="gear_acceleration_peak", symbol="ε_1,max", unit="rad/s**2", description="Greatest angular acceleration of the gear",
                  source="kinematics", of="gear_acceleration", operation="abs_max"),
        Reduction(id="gear_power_peak", symbol="P_J,max", unit="W/(kg*m**2)", source="energy",
                  description="Greatest power for each unit of inertia on the gear's shaft", of="gear_power", operation="max"),
        Value(id="gear_speed_ratio_peak", symbol="i_max", description="Greatest speed of the gear to that of the disc", source="this method",
              digits=5, formula=bind(formulas.share_of_turn, angle="gear_speed_peak")),
        Value(id="gear_speed_peak_sector_referred", symbol="ω_31", unit="rad", digits=6, source="003, Fig. 7, the source's unit",
              description="Greatest speed of the gear referred to the sector (times R_1/R_3), per turn of the disc", formula=formulas.referred),
        Reduction(id="gear_rotation_per_cycle", symbol="φ_1,Σ", unit="deg", description="Rotation of the gear in a cycle (mean of its speed)",
                  source="kinematics", of="gear_speed", operation="mean"),
        Value(id="gear_rotation_error", symbol="Δφ_1", unit="deg", description="What that is off a full turn", source="kinematics", output=False,
              formula=bind(formulas.off_one_turn, rotation="gear_rotation_per_cycle")),
    ),
)  # fmt: skip
