"""The calculation of the cam-gear stepper: rolling of sector and gear, phases and motion of a cycle, the sheet, and the torque."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    CURVE_ROUNDING,
    ByText,
    Case,
    Chapter,
    Vary,
    abscissa,
    as_number,
    case,
    choice,
    crossings,
    inner,
    lookup,
    m,
    number,
    pi,
    reduction,
    self_test,
    value,
)
from diecut_report.mechanics import contact
from diecut_report.mechanics.motion_laws import (
    ACCELERATION,
    JOINT,
    MIDDLE_POSITION,
    MIDDLE_VELOCITY,
    PEAK_ACCELERATION,
    PEAK_VELOCITY,
    POSITION,
    VELOCITY,
)
from diecut_report.plugins.cam_gear_transport import formulas
from diecut_report.plugins.cam_gear_transport.inputs import GRIPPED, MODULES, SHEET, TORQUE

# fmt: off


"""The usual modules, in mm."""

"""The keys with which the cams are synthesised."""

"""The keys with which the motion of the sheet is known."""

"""The keys with which the pull of the sheet at its grippers is known."""

"""The keys with which torque and forces are known."""


LEAST_RETURN = 1e-6  # share of a turn: what is left below it is mostly rounding, and its speeds with it

rolling = Chapter("Rolling of the sector on the gear",
    text="While the disc turns by φ_22, the sector turns on its pin by γ_32 and rolls off the same arc of the gear: φ_22·R_1 = γ_32·R_3. The gear, "
        "which is coaxial with the disc, therefore stands still.")
rolling.teeth_together = (inner(formulas.teeth_together, needs=("module",), digits=6), "z_Σ", "1",
    "Number of teeth of gear and sector together, the sector counted as a full wheel", "geometry")
rolling.center_distance_nearest = (inner(np.maximum(np.round(m.teeth_together), 2) * m.module / 2, needs=("module",), digits=10), "R_2′", "mm",
    "Nearest radius of the pin with whole numbers of teeth", "geometry")
rolling.require("whole_teeth", abs(m.teeth_together - np.round(m.teeth_together)) <= 1e-9 * m.teeth_together, key="center_distance",
    message="is {center_distance}, but with a module of {module} gear and sector would have 2·R₂/m = {teeth_together} teeth together, which must be "
    "a whole number; the nearest center_distance is {center_distance_nearest}", needs=("module",))
rolling.gear_teeth = (value(formulas.gear_teeth.of(sweep=m.inputs.sector_dwell_sweep), whole=True, needs=("module",)), "z_1", "1",
    "Number of teeth of the gear", "this method")
rolling.sector_wheel_teeth = (value(formulas.other_teeth, whole=True, needs=("module",)), "z_3", "1",
    "Number of teeth of the sector, counted as a full wheel", "this method")
rolling.require("some_teeth", np.minimum(m.gear_teeth, m.sector_wheel_teeth) >= 1, key="module",
    message="is {module}, with which the gear would have {gear_teeth} and the sector {sector_wheel_teeth} teeth", needs=("module",),
    advise=(Vary("module", "down", MODULES), "sector_dwell_sweep", "dwell_angle"))
rolling.sector_dwell_sweep = (value(formulas.sweep_of_teeth, needs=("module",), digits=6), "γ_32", "deg",
    "Sweep of the sector during the dwell: as required by whole numbers of teeth", "003 eq. 1, for whole teeth")
rolling.sector_dwell_sweep = (value(m.inputs.sector_dwell_sweep, lacks=("module",), digits=6), "γ_32", "deg",
    "Sweep of the sector during the dwell: as given", "input")
rolling.radius_ratio = formulas.radius_ratio.of(sweep=m.sector_dwell_sweep), "R_12", "1", "Ratio of gear radius to pin radius, R_1/R_2", "003 eq. 1"
rolling.gear_radius = m.center_distance * m.radius_ratio, "R_1", "mm", "Pitch radius of the gear", "003 eq. 1"
rolling.sector_radius = m.center_distance - m.gear_radius, "R_3", "mm", "Pitch radius of the sector", "003 eq. 1"
rolling.sector_sweep = m.sector_dwell_sweep + m.sector_stop_sweep, "γ_Σ", "deg", "Total sweep of the sector", "003, Fig. 4"
rolling.sector_teeth = (value(np.ceil(m.sector_wheel_teeth * m.sector_sweep / (2 * pi)) + 2, whole=True, needs=("module",)), "z_3′", "1",
    "Number of teeth of the sector: those of the swept arc, and one on each side", "this method")

phases = Chapter("Phases of the cycle",
    text="Times are fractions of a revolution of the disc, speeds are in rad per revolution of the disc. Phase II is the dwell; in III the sector "
        "stops, in IV it returns, in I it starts again. III and I are the two halves of one rise by the law of motion, whose maximum speed is that "
        "of the dwell.")
phases.law_peak_velocity = ByText("motion_law", PEAK_VELOCITY), "B", "1", "Peak velocity of the law of motion", "003, after eq. 3"
phases.law_peak_acceleration = ByText("motion_law", PEAK_ACCELERATION), "A", "1", "Peak acceleration of the law of motion", "motion laws"
phases.law_middle_position = lookup(MIDDLE_POSITION, by="motion_law", output=False), "f_m", "1", "Position of the law at half its time", "motion laws"
phases.law_middle_velocity = (lookup(MIDDLE_VELOCITY, by="motion_law", output=False), "f′_m", "1", "Velocity of the law at half its time",
    "motion laws")
phases.require("law_symmetric", formulas.is_symmetric.of(middle_position=m.law_middle_position, middle_velocity=m.law_middle_velocity,
    peak_velocity=m.law_peak_velocity), key="motion_law",
    message="is {motion_law}, which is not half way and fastest in the middle of its time; the phases III and I ask for that, take another law")
phases.time_dwell = formulas.share_of_turn.of(angle=m.dwell_angle), "T_2", "1", "Dwell fraction of the cycle, phase II", "003, second eq. 1"
phases.sector_speed_dwell = (value(formulas.constant_speed.of(sweep=m.sector_dwell_sweep, time=m.time_dwell), digits=5), "ω_3,2", "rad",
    "Speed of the sector in the dwell, per revolution of the disc", "003, second eq. 1")
phases.time_stop = (formulas.time_stop.of(peak_velocity=m.law_peak_velocity), "T_(3+1)", "1", "Fraction of the cycle for phases III and I together",
    "003 eq. 3")
phases.time_return = formulas.time_return, "T_4", "1", "Fraction of the cycle for the return, phase IV", "003 eq. 4"
phases.dwell_angle_limit = (value(2 * pi * m.sector_dwell_sweep / (m.sector_dwell_sweep + m.law_peak_velocity * m.sector_stop_sweep),
    lacks=("module",)), "φ_22,lim", "deg", "Dwell that leaves no time for the return, with these sweeps", "003 eq. 4, solved")
phases.dwell_angle_limit = (value(2 * pi * (1 - m.time_stop), needs=("module",)), "φ_22,lim", "deg",
    "Dwell that leaves no time for the return, with these teeth", "003 eq. 4, solved")
phases.dwell_angle_recommended = (value((1 - m.min_return_time) * m.dwell_angle_limit, lacks=("module",)), "φ_22,rec", "deg",
    "Dwell that leaves the required time for the return", "003 eq. 4, solved")
phases.dwell_angle_recommended = (value(m.dwell_angle_limit - 2 * pi * m.min_return_time, needs=("module",)), "φ_22,rec", "deg",
    "Dwell that leaves the required time for the return", "003 eq. 4, solved")
phases.stop_sweep_limit = ((1 - m.time_dwell) * m.sector_speed_dwell / m.law_peak_velocity, "γ_lim", "deg",
    "Sweep of stop and start that leaves no time for the return, with this dwell", "003 eq. 4, solved")
phases.stop_sweep_recommended = ((1 - m.min_return_time - m.time_dwell) * m.sector_speed_dwell / m.law_peak_velocity, "γ_rec", "deg",
    "Sweep of stop and start that leaves the required time for the return, with this dwell", "003 eq. 4, solved")
phases.require("return_exists", m.time_return > LEAST_RETURN, key="dwell_angle",
    message="is {dwell_angle}; with a sector_stop_sweep of {sector_stop_sweep} dwell, stop and start take the whole turn and leave T₄ = 1 − T₂ − "
    "T₍₃₊₁₎ = {time_return} for the sector's return", advise=("dwell_angle", "sector_stop_sweep"))
phases.angle_dwell = inner(0), "φ_II", "deg", "Disc angle where the dwell begins, phase II", "this method"
phases.angle_stop = (value(m.dwell_angle + pi * m.time_stop, digits=6), "φ_IV", "deg", "Disc angle where the sector stops: end of phase III",
    "003, after eq. 3")
phases.angle_start = (value(2 * pi - pi * m.time_stop, digits=6), "φ_I", "deg", "Disc angle where the sector starts again: beginning of phase I",
    "003, after eq. 4")
phases.sector_speed_return_peak = (value(formulas.return_peak.of(peak_velocity=m.law_peak_velocity), digits=5), "ω_3,4", "rad",
    "Maximum speed of the sector's return, per revolution of the disc", "003, after eq. 4, corrected")
phases.disc_speed = inner(2 * pi * m.cycles_per_hour), "ω_2", "rad/s", "Angular speed of the disc", "kinematics"


def _before(place: str) -> Any:
    """Whether the disc is in a phase before a place."""
    return m.piece_middle < m[place]


def by_phase(dwell: Any, stopping: Any, returning: Any, starting: Any) -> tuple[Case, ...]:
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
sector.disc_angle = abscissa(2 * np.pi, shown_at="gear_power_peak_at", speed="disc_speed"), "φ", "deg", "Disc angle from the start of the dwell"
sector.breakpoints("phases", "disc_angle", "dwell_angle", "angle_stop", "angle_start")
sector.phase("phase_1", "moving", "Phase I: the sector starts", "disc_angle", ("angle_start", "angle_dwell"))
sector.phase("phase_2", "rest", "Phase II: the gear dwells", "disc_angle", ("angle_dwell", "dwell_angle"))
sector.phase("phase_3", "moving", "Phase III: the sector stops", "disc_angle", ("dwell_angle", "angle_stop"))
sector.phase("phase_4", "moving", "Phase IV: the sector returns", "disc_angle", ("angle_stop", "angle_start"))
sector.phase("dwell", "rest", "Dwell of gear and sheet", "disc_angle", union=("phase_2",))
sector.phase("moving", "moving", "Motion of gear and sheet", "disc_angle", rest_of=("dwell",))
sector.piece_middle = (inner(m.disc_angle, per_piece=True), "φ_m", "deg", "Disc angle in the middle of the present phase (or part of it)",
    "this method")
sector.law_share = (choice(*by_phase(0.5, number(1) / 2 + (m.disc_angle - m.dwell_angle) / (2 * pi * m.time_stop),
    (m.disc_angle - m.angle_stop) / (2 * pi * m.time_return), (m.disc_angle - m.angle_start) / (2 * pi * m.time_stop)), output=False), "k", "1",
    "Elapsed fraction of the rise or return", "003 eq. 2")
sector.law_joint = (inner(ByText("motion_law", JOINT, k=m.law_share), printed=False), "j", "1",
    "Junction of the law: changes its sign where the law's formula changes", "motion laws")
sector.law_break = (crossings(of="law_joint", output=False, printed=False), "φ_j", "deg",
    "Disc angle at which the law's formula changes, or a phase begins")
sector.breakpoints("law_breaks", "disc_angle", "law_break")
sector.law_position = inner(ByText("motion_law", POSITION, k=m.law_share)), "f", "1", "Law of motion: position at k", "motion laws"
sector.law_velocity = inner(ByText("motion_law", VELOCITY, k=m.law_share)), "f′", "1", "Law of motion: velocity at k", "motion laws"
sector.law_middle = (inner(m.law_share, per_piece=True, printed=False), "k_m", "1", "Fraction k in the middle of the current phase (or part of it)",
    "this method")
sector.law_side = (inner(m.law_share + 1e-12 * (m.law_middle - m.law_share), printed=False), "k", "1",
    "Fraction k just inside its piece: selects the side where the law's acceleration jumps", "this method")
sector.law_acceleration = inner(ByText("motion_law", ACCELERATION, k=m.law_side)), "f″", "1", "Law of motion: acceleration at k", "motion laws"
sector.sector_angle = (choice(*by_phase(m.sector_dwell_sweep * m.disc_angle / m.dwell_angle,
    m.sector_dwell_sweep + formulas.starting_angle(m.sector_stop_sweep, m.law_position), formulas.returning_angle.of(),
    formulas.starting_angle.of())), "γ", "deg", "Angle of the sector relative to the disc", "003, Fig. 4")
sector.sector_speed = (choice(*by_phase(m.sector_speed_dwell, formulas.rise_speed.of(sweep=m.sector_stop_sweep, time=m.time_stop),
    -m.sector_sweep / m.time_return * m.law_velocity, formulas.rise_speed.of(sweep=m.sector_stop_sweep, time=m.time_stop))), "ω_3", "rad",
    "Speed of the sector relative to the disc, per revolution of the disc", "003 eq. 1, 2, Fig. 6")
sector.sector_acceleration = (choice(*by_phase(0, formulas.rise_acceleration.of(sweep=m.sector_stop_sweep, time=m.time_stop),
    -m.sector_sweep * (m.cycles_per_hour / m.time_return) ** 2 * m.law_acceleration,
    formulas.rise_acceleration.of(sweep=m.sector_stop_sweep, time=m.time_stop))), "ε_3", "rad/s**2", "Angular acceleration of the sector",
    "kinematics")
sector.rocker_turn = (inner(1 + m.sector_speed / (2 * pi)), "w", "1", "Ratio of the angular speed of sector and rocker to that of the disc",
    "kinematics")

gear = Chapter("Motion of the gear",
    text="The disc carries the gear along; the arc that the sector rolls off is subtracted. The gear's angle is counted from its dwell position. "
        "Over a cycle the sector returns to its initial position, so the gear makes one revolution.")
gear.gear_angle = (m.disc_angle - m.sector_radius / m.gear_radius * m.sector_angle, "φ_1", "deg", "Angle of the gear from its dwell position",
    "003, Fig. 3")
gear.gear_speed = formulas.gear_speed, "ω_1", "rad", "Speed of the gear, per revolution of the disc", "003, Fig. 7, corrected"
gear.gear_acceleration = formulas.gear_acceleration, "ε_1", "rad/s**2", "Angular acceleration of the gear", "kinematics"
gear.gear_power = (inner(as_number(m.gear_speed * m.cycles_per_hour * m.gear_acceleration)), "P_J", "W/(kg*m**2)",
    "Power per unit of inertia on the gear's shaft", "energy")
gear.gear_speed_peak = (reduction("max", of="gear_speed", digits=5), "ω_1,max", "rad", "Maximum speed of the gear, per revolution of the disc",
    "003, Fig. 7, corrected")
gear.gear_acceleration_peak = (reduction("abs_max", of="gear_acceleration"), "ε_1,max", "rad/s**2", "Maximum angular acceleration of the gear",
    "kinematics")
gear.gear_power_peak = reduction("max", of="gear_power"), "P_J,max", "W/(kg*m**2)", "Maximum power per unit of inertia on the gear's shaft", "energy"
gear.gear_speed_ratio_peak = (value(formulas.share_of_turn.of(angle=m.gear_speed_peak), digits=5), "i_max", "1",
    "Maximum ratio of the gear's speed to that of the disc", "this method")
gear.gear_speed_peak_sector_referred = (value(m.gear_speed_peak * m.gear_radius / m.sector_radius, digits=6), "ω_31", "rad",
    "Maximum speed of the gear referred to the sector (times R_1/R_3), per revolution of the disc", "003, Fig. 7, the source's unit")
gear.gear_rotation_per_cycle = reduction("mean", of="gear_speed"), "φ_1,Σ", "deg", "Rotation of the gear per cycle (mean of its speed)", "kinematics"
gear.gear_rotation_error = inner(abs(m.gear_rotation_per_cycle - 2 * pi)), "Δφ_1", "deg", "Deviation from one revolution", "kinematics"


conveyor = Chapter("Motion of the sheet", text="The gear drives the conveyor's sprocket; one cycle makes one step.", needs=SHEET,
    absent="not calculated: {missing} not given")
conveyor.sheet_step = m.sprocket_teeth * m.chain_pitch * m.sprocket_ratio, "S", "mm", "Step of the conveyor per cycle", "this method"
conveyor.sheet_position = m.sheet_step * m.gear_angle / (2 * pi), "x", "mm", "Position of the sheet from its dwell position", "kinematics"
conveyor.sheet_velocity = m.sheet_step * m.cycles_per_hour * m.gear_speed / (2 * pi), "V", "m/s", "Velocity of the sheet", "kinematics"
conveyor.sheet_acceleration = m.sheet_step * m.gear_acceleration / (2 * pi), "a_s", "m/s**2", "Acceleration of the sheet", "kinematics"
conveyor.sheet_velocity_max = reduction("abs_max", of="sheet_velocity"), "V_max", "m/s", "Maximum velocity of the sheet", "kinematics"
conveyor.sheet_acceleration_max = (reduction("abs_max", of="sheet_acceleration"), "a_s,max", "m/s**2", "Maximum acceleration of the sheet",
    "kinematics")

grippers = Chapter("Holding force of the grippers",
    text="The grippers must hold the sheet against its own inertia; air resistance and the friction of the surface on which it slides are neglected.",
    needs=GRIPPED, absent="not calculated: {missing} not given")
grippers.sheet_mass = contact.sheet_mass, "m_s", "g", "Mass of the sheet", "geometry"
grippers.sheet_force = contact.sheet_force, "F_g", "N", "Maximum force of the sheet on its grippers", "mechanics"
rest = Chapter("Rest of the sheet within a tolerance",
    text="The sheet is at rest while it is within e of its dwell position: before and after the dwell, as long as the product of both distances "
        "beyond e is negative.", needs=(*SHEET, "rest_tolerance"), absent="not calculated: {missing} not given")
rest.require("tolerance_below_step", 2 * m.rest_tolerance < m.sheet_step, key="rest_tolerance",
    message="is {rest_tolerance}, but must be less than half the step {sheet_step}")
rest.rest_excess = (inner((m.sheet_position - m.rest_tolerance) * (m.sheet_step - m.rest_tolerance - m.sheet_position)), "Π_e", "mm**2",
    "Product of the distances beyond the tolerance from the last and from the next rest position")
rest.rest_edge = crossings(of="rest_excess"), "φ_e", "deg", "Disc angle at which the sheet leaves its rest, and at which it comes to rest again"
rest.phase("rest", "rest", "Rest of the sheet within the tolerance", "disc_angle", ("rest_edge_2", "rest_edge_1"))

torques = Chapter("Torque",
    text="Losses are neglected: only the conveyor's mass is moved, and the sector with its rocker where their inertia is given. The fixed cams do "
        "no work, since the rollers move along them; the disc therefore supplies the power of gear and sector.", needs=TORQUE,
    absent="not calculated: {missing} not given")
torques.gear_torque = m.conveyor_mass * m.sheet_acceleration * m.sheet_step / (2 * pi), "M_1", "N*m", "Torque at the gear's shaft", "statics"
torques.tooth_force = m.gear_torque / m.gear_radius, "F_t", "N", "Tangential force between the teeth of sector and gear", "statics"
torques.drive_torque = (m.gear_torque * m.gear_speed / (2 * pi) + m.sector_inertia * m.sector_acceleration * m.rocker_turn, "M_2", "N*m",
    "Torque at the disc's shaft", "energy")
torques.gear_torque_peak = reduction("abs_max", of="gear_torque"), "M_1,max", "N*m", "Maximum torque at the gear's shaft", "statics"
torques.tooth_force_peak = reduction("abs_max", of="tooth_force"), "F_t,max", "N", "Maximum tangential force between the teeth", "statics"
torques.torque_peak = reduction("abs_max", of="drive_torque"), "M_peak", "N*m", "Maximum torque at the disc's shaft, driving or driven", "energy"
torques.torque_rms = reduction("rms", of="drive_torque"), "M_rms", "N*m", "Root mean square torque at the disc's shaft", "energy"
torques.energy_turn = reduction("integral", of="drive_torque", output=False), "E_Σ", "J", "Work of the disc's torque per revolution", "energy"
torques.kinetic_energy_max = m.conveyor_mass * m.sheet_velocity_max ** 2 / 2, "E_k", "J", "Maximum kinetic energy of the conveyor", "energy"
torques.energy_residual = (self_test(m.energy_turn, 0, scale=m.kinetic_energy_max, within=CURVE_ROUNDING, check="energy_balance",
    title="Energy balance over a revolution"), "r_E", "1", "Ratio of the work per revolution to the maximum kinetic energy", "conservation of energy")
