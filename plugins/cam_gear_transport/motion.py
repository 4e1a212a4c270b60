"""Chapters on the motion of sector and gear over a turn of the disc."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Binding, ByText, Case, Chapter, as_number, bind, case
from diecut_report.mechanics import common
from diecut_report.mechanics.motion_laws import ACCELERATION, JOINT, POSITION, VELOCITY
from diecut_report.plugins.cam_gear_transport import formulas

# fmt: off


def _before(place: str) -> Binding:
    """Whether the disc is in a phase before a place."""
    return bind(common.is_below, smaller="piece_middle", greater=place)


def by_phase(dwell: Binding, stopping: Binding, returning: Binding, starting: Binding) -> tuple[Case, ...]:
    """What holds in the phases II, III, IV and I."""
    return (
        case(dwell, "the disc is in phase II, the gear dwells", _before("dwell_angle")),
        case(stopping, "the disc is in phase III, the sector stops", _before("angle_stop")),
        case(returning, "the disc is in phase IV, the sector returns", _before("angle_start")),
        case(starting, "the disc is in phase I, the sector starts"),
    )


RISE = {"sweep": "sector_stop_sweep", "time": "time_stop"}
FALL = {"sweep": "sector_sweep", "time": "time_return"}

sector = Chapter("Motion of the sector",
    text="The disc angle is counted from the start of the dwell. γ is the sector's angle relative to the disc, counter-clockwise, 0 at the start of "
        "the dwell; k is the elapsed fraction of the rise or return, and in the dwell that of the middle of the rise, where the speed is the same. "
        "φ_m holds for a whole phase and is shown in its middle, all other quantities at the stated φ.")
sector.abscissa("disc_angle", "φ", "deg", "Disc angle from the start of the dwell", 2 * np.pi, shown_at="gear_power_peak_at", speed="disc_speed")
sector.breakpoints("phases", "disc_angle", "dwell_angle", "angle_stop", "angle_start")
sector.phase("phase_1", "moving", "Phase I: the sector starts", "disc_angle", ("angle_start", "angle_dwell"))
sector.phase("phase_2", "rest", "Phase II: the gear dwells", "disc_angle", ("angle_dwell", "dwell_angle"))
sector.phase("phase_3", "moving", "Phase III: the sector stops", "disc_angle", ("dwell_angle", "angle_stop"))
sector.phase("phase_4", "moving", "Phase IV: the sector returns", "disc_angle", ("angle_stop", "angle_start"))
sector.phase("dwell", "rest", "Dwell of gear and sheet", "disc_angle", union=("phase_2",))
sector.phase("moving", "moving", "Motion of gear and sheet", "disc_angle", rest_of=("dwell",))
sector.value("piece_middle", "φ_m", "deg", "Disc angle in the middle of the present phase (or part of it)", lambda disc_angle: disc_angle,
    source="this method", output=False, per_piece=True)
sector.choice("law_share", "k", "1", "Elapsed fraction of the rise or return",
    *by_phase(bind(common.same, quantity=0.5), formulas.stopping_share,
        bind(lambda disc_angle, start, time: (disc_angle - start) / (2 * np.pi * time), start="angle_stop", time="time_return"),
        bind(lambda disc_angle, start, time: (disc_angle - start) / (2 * np.pi * time), start="angle_start", time="time_stop")), source="003 eq. 2",
    output=False)
sector.value("law_joint", "j", "1", "Junction of the law: changes its sign where the law's formula changes",
    ByText("motion_law", JOINT, k="law_share"), output=False, source="motion laws", printed=False)
sector.crossings("law_break", "φ_j", "deg", "Disc angle at which the law's formula changes, or a phase begins", of="law_joint", output=False,
    printed=False)
sector.breakpoints("law_breaks", "disc_angle", "law_break")
sector.value("law_position", "f", "1", "Law of motion: position at k", ByText("motion_law", POSITION, k="law_share"), source="motion laws",
    output=False)
sector.value("law_velocity", "f′", "1", "Law of motion: velocity at k", ByText("motion_law", VELOCITY, k="law_share"), source="motion laws",
    output=False)
sector.value("law_middle", "k_m", "1", "Fraction k in the middle of the current phase (or part of it)", lambda law_share: law_share,
    source="this method", output=False, per_piece=True, printed=False)
sector.value("law_side", "k", "1", "Fraction k just inside its piece: selects the side where the law's acceleration jumps",
    lambda law_share, law_middle: law_share + 1e-12 * (law_middle - law_share), output=False, source="this method", printed=False)
sector.value("law_acceleration", "f″", "1", "Law of motion: acceleration at k", ByText("motion_law", ACCELERATION, k="law_side"),
    source="motion laws", output=False)
sector.choice("sector_angle", "γ", "deg", "Angle of the sector relative to the disc",
    *by_phase(bind(lambda disc_angle, sector_dwell_sweep, dwell_angle: sector_dwell_sweep * disc_angle / dwell_angle), bind(formulas.stopping_angle),
        bind(formulas.returning_angle), bind(formulas.starting_angle)), source="003, Fig. 4")
sector.choice("sector_speed", "ω_3", "rad", "Speed of the sector relative to the disc, per revolution of the disc",
    *by_phase(bind(common.same, quantity="sector_speed_dwell"), bind(formulas.rise_speed, **RISE), bind(formulas.fall_speed, **FALL),
        bind(formulas.rise_speed, **RISE)), source="003 eq. 1, 2, Fig. 6")
sector.choice("sector_acceleration", "ε_3", "rad/s**2", "Angular acceleration of the sector",
    *by_phase(common.zero, bind(formulas.rise_acceleration, **RISE), bind(formulas.fall_acceleration, **FALL),
        bind(formulas.rise_acceleration, **RISE)), source="kinematics")
sector.value("rocker_turn", "w", "1", "Ratio of the angular speed of sector and rocker to that of the disc",
    lambda sector_speed: 1 + sector_speed / (2 * np.pi), source="kinematics", output=False)

gear = Chapter("Motion of the gear",
    text="The disc carries the gear along; the arc that the sector rolls off is subtracted. The gear's angle is counted from its dwell position. "
        "Over a cycle the sector returns to its initial position, so the gear makes one revolution.")
gear.value("gear_angle", "φ_1", "deg", "Angle of the gear from its dwell position",
    lambda disc_angle, sector_angle, sector_radius, gear_radius: disc_angle - sector_radius / gear_radius * sector_angle, source="003, Fig. 3")
gear.value("gear_speed", "ω_1", "rad", "Speed of the gear, per revolution of the disc", formulas.gear_speed, source="003, Fig. 7, corrected")
gear.value("gear_acceleration", "ε_1", "rad/s**2", "Angular acceleration of the gear", formulas.gear_acceleration, source="kinematics")
gear.value("gear_power", "P_J", "W/(kg*m**2)", "Power per unit of inertia on the gear's shaft",
    lambda gear_speed, gear_acceleration, cycles_per_hour: as_number(gear_speed * cycles_per_hour * gear_acceleration), source="energy",
    output=False)
gear.reduction("gear_speed_peak", "ω_1,max", "rad", "Maximum speed of the gear, per revolution of the disc", "max", of="gear_speed",
    source="003, Fig. 7, corrected", digits=5)
gear.reduction("gear_acceleration_peak", "ε_1,max", "rad/s**2", "Maximum angular acceleration of the gear", "abs_max", of="gear_acceleration",
    source="kinematics")
gear.reduction("gear_power_peak", "P_J,max", "W/(kg*m**2)", "Maximum power per unit of inertia on the gear's shaft", "max", of="gear_power",
    source="energy")
gear.value("gear_speed_ratio_peak", "i_max", "1", "Maximum ratio of the gear's speed to that of the disc",
    bind(formulas.share_of_turn, angle="gear_speed_peak"), source="this method", digits=5)
gear.value("gear_speed_peak_sector_referred", "ω_31", "rad",
    "Maximum speed of the gear referred to the sector (times R_1/R_3), per revolution of the disc",
    lambda gear_speed_peak, gear_radius, sector_radius: gear_speed_peak * gear_radius / sector_radius, digits=6,
    source="003, Fig. 7, the source's unit")
gear.reduction("gear_rotation_per_cycle", "φ_1,Σ", "deg", "Rotation of the gear per cycle (mean of its speed)", "mean", of="gear_speed",
    source="kinematics")
gear.value("gear_rotation_error", "Δφ_1", "deg", "Deviation from one revolution",
    lambda gear_rotation_per_cycle: abs(gear_rotation_per_cycle - 2 * np.pi), source="kinematics", output=False)
