"""The calculation of the cam-gear stepper: rolling of sector and gear, phases and motion of a cycle, the sheet, and the torque."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Binding, ByText, Case, Chapter, Vary, as_number, bind, case, number, pi
from diecut_report.mechanics import common, contact
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
rolling.value("teeth_together", "z_Σ", "1", "Number of teeth of gear and sector together, the sector counted as a full wheel",
    formulas.teeth_together, source="geometry", output=False, needs=("module",), digits=6)
rolling.value("center_distance_nearest", "R_2′", "mm", "Nearest radius of the pin with whole numbers of teeth",
    lambda teeth_together, module: np.maximum(np.round(teeth_together), 2) * module / 2, output=False, source="geometry", needs=("module",),
    digits=10)
rolling.require("whole_teeth", lambda teeth_together: abs(teeth_together - np.round(teeth_together)) <= 1e-9 * teeth_together, key="center_distance",
    message="is {center_distance}, but with a module of {module} gear and sector would have 2·R₂/m = {teeth_together} teeth together, which must be "
        "a whole number; the nearest center_distance is {center_distance_nearest}", needs=("module",))
rolling.value("gear_teeth", "z_1", "1", "Number of teeth of the gear", bind(formulas.gear_teeth, sweep="inputs.sector_dwell_sweep"), whole=True,
    source="this method", needs=("module",))
rolling.value("sector_wheel_teeth", "z_3", "1", "Number of teeth of the sector, counted as a full wheel", formulas.other_teeth, whole=True,
    source="this method", needs=("module",))
rolling.require("some_teeth", lambda gear_teeth, sector_wheel_teeth: np.minimum(gear_teeth, sector_wheel_teeth) >= 1, key="module",
    message="is {module}, with which the gear would have {gear_teeth} and the sector {sector_wheel_teeth} teeth", needs=("module",),
    advise=(Vary("module", "down", MODULES), "sector_dwell_sweep", "dwell_angle"))
rolling.value("sector_dwell_sweep", "γ_32", "deg", "Sweep of the sector during the dwell: as required by whole numbers of teeth",
    formulas.sweep_of_teeth, source="003 eq. 1, for whole teeth", needs=("module",), digits=6)
rolling.value("sector_dwell_sweep", "γ_32", "deg", "Sweep of the sector during the dwell: as given",
    bind(lambda sector_dwell_sweep: sector_dwell_sweep, sector_dwell_sweep="inputs.sector_dwell_sweep"), source="input", lacks=("module",), digits=6)
rolling.value("radius_ratio", "R_12", "1", "Ratio of gear radius to pin radius, R_1/R_2", bind(formulas.radius_ratio, sweep="sector_dwell_sweep"),
    source="003 eq. 1")
rolling.value("gear_radius", "R_1", "mm", "Pitch radius of the gear",
    lambda center_distance, radius_ratio: center_distance * radius_ratio, source="003 eq. 1")
rolling.value("sector_radius", "R_3", "mm", "Pitch radius of the sector",
    lambda center_distance, gear_radius: center_distance - gear_radius, source="003 eq. 1")
rolling.value("sector_sweep", "γ_Σ", "deg", "Total sweep of the sector",
    lambda sector_dwell_sweep, sector_stop_sweep: sector_dwell_sweep + sector_stop_sweep, source="003, Fig. 4")
rolling.value("sector_teeth", "z_3′", "1", "Number of teeth of the sector: those of the swept arc, and one on each side",
    lambda sector_wheel_teeth, sector_sweep: np.ceil(sector_wheel_teeth * sector_sweep / (2 * pi)) + 2, whole=True, source="this method",
    needs=("module",))

phases = Chapter("Phases of the cycle",
    text="Times are fractions of a revolution of the disc, speeds are in rad per revolution of the disc. Phase II is the dwell; in III the sector "
        "stops, in IV it returns, in I it starts again. III and I are the two halves of one rise by the law of motion, whose maximum speed is that "
        "of the dwell.")
phases.value("law_peak_velocity", "B", "1", "Peak velocity of the law of motion", ByText("motion_law", PEAK_VELOCITY), source="003, after eq. 3")
phases.value("law_peak_acceleration", "A", "1", "Peak acceleration of the law of motion", ByText("motion_law", PEAK_ACCELERATION),
    source="motion laws")
phases.lookup("law_middle_position", "f_m", "1", "Position of the law at half its time", MIDDLE_POSITION, by="motion_law", source="motion laws",
    output=False)
phases.lookup("law_middle_velocity", "f′_m", "1", "Velocity of the law at half its time", MIDDLE_VELOCITY, by="motion_law", source="motion laws",
    output=False)
phases.require("law_symmetric",
    bind(formulas.is_symmetric, middle_position="law_middle_position", middle_velocity="law_middle_velocity", peak_velocity="law_peak_velocity"),
    key="motion_law",
    message="is {motion_law}, which is not half way and fastest in the middle of its time; the phases III and I ask for that, take another law")
phases.value("time_dwell", "T_2", "1", "Dwell fraction of the cycle, phase II", bind(formulas.share_of_turn, angle="dwell_angle"),
    source="003, second eq. 1")
phases.value("sector_speed_dwell", "ω_3,2", "rad", "Speed of the sector in the dwell, per revolution of the disc",
    bind(formulas.constant_speed, sweep="sector_dwell_sweep", time="time_dwell"), source="003, second eq. 1", digits=5)
phases.value("time_stop", "T_(3+1)", "1", "Fraction of the cycle for phases III and I together",
    bind(formulas.time_stop, peak_velocity="law_peak_velocity"), source="003 eq. 3")
phases.value("time_return", "T_4", "1", "Fraction of the cycle for the return, phase IV", formulas.time_return, source="003 eq. 4")
phases.value("dwell_angle_limit", "φ_22,lim", "deg", "Dwell that leaves no time for the return, with these sweeps",
    lambda sector_dwell_sweep, sector_stop_sweep, law_peak_velocity:
        2 * pi * sector_dwell_sweep / (sector_dwell_sweep + law_peak_velocity * sector_stop_sweep), source="003 eq. 4, solved", lacks=("module",))
phases.value("dwell_angle_limit", "φ_22,lim", "deg", "Dwell that leaves no time for the return, with these teeth",
    lambda time_stop: 2 * pi * (1 - time_stop), source="003 eq. 4, solved", needs=("module",))
phases.value("dwell_angle_recommended", "φ_22,rec", "deg", "Dwell that leaves the required time for the return",
    lambda dwell_angle_limit, min_return_time: (1 - min_return_time) * dwell_angle_limit, source="003 eq. 4, solved", lacks=("module",))
phases.value("dwell_angle_recommended", "φ_22,rec", "deg", "Dwell that leaves the required time for the return",
    lambda dwell_angle_limit, min_return_time: dwell_angle_limit - 2 * pi * min_return_time, source="003 eq. 4, solved", needs=("module",))
phases.value("stop_sweep_limit", "γ_lim", "deg", "Sweep of stop and start that leaves no time for the return, with this dwell",
    lambda time_dwell, sector_speed_dwell, law_peak_velocity: (1 - time_dwell) * sector_speed_dwell / law_peak_velocity, source="003 eq. 4, solved")
phases.value("stop_sweep_recommended", "γ_rec", "deg", "Sweep of stop and start that leaves the required time for the return, with this dwell",
    lambda time_dwell, sector_speed_dwell, law_peak_velocity, min_return_time:
        (1 - min_return_time - time_dwell) * sector_speed_dwell / law_peak_velocity, source="003 eq. 4, solved")
phases.require("return_exists", bind(common.is_below, smaller=LEAST_RETURN, greater="time_return"), key="dwell_angle",
    message="is {dwell_angle}; with a sector_stop_sweep of {sector_stop_sweep} dwell, stop and start take the whole turn and leave T₄ = 1 − T₂ − "
        "T₍₃₊₁₎ = {time_return} for the sector's return", advise=("dwell_angle", "sector_stop_sweep"))
phases.value("angle_dwell", "φ_II", "deg", "Disc angle where the dwell begins, phase II", lambda: 0, source="this method", output=False)
phases.value("angle_stop", "φ_IV", "deg", "Disc angle where the sector stops: end of phase III",
    lambda dwell_angle, time_stop: dwell_angle + pi * time_stop, source="003, after eq. 3", digits=6)
phases.value("angle_start", "φ_I", "deg", "Disc angle where the sector starts again: beginning of phase I",
    lambda time_stop: 2 * pi - pi * time_stop, source="003, after eq. 4", digits=6)
phases.value("sector_speed_return_peak", "ω_3,4", "rad", "Maximum speed of the sector's return, per revolution of the disc",
    bind(formulas.return_peak, peak_velocity="law_peak_velocity"), source="003, after eq. 4, corrected", digits=5)
phases.value("disc_speed", "ω_2", "rad/s", "Angular speed of the disc", lambda cycles_per_hour: 2 * pi * cycles_per_hour, source="kinematics",
    output=False)


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
    *by_phase(bind(common.same, quantity=0.5),
        bind(lambda disc_angle, dwell_angle, time_stop: number(1) / 2 + (disc_angle - dwell_angle) / (2 * pi * time_stop)),
        bind(lambda disc_angle, start, time: (disc_angle - start) / (2 * pi * time), start="angle_stop", time="time_return"),
        bind(lambda disc_angle, start, time: (disc_angle - start) / (2 * pi * time), start="angle_start", time="time_stop")), source="003 eq. 2",
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
    *by_phase(bind(lambda disc_angle, sector_dwell_sweep, dwell_angle: sector_dwell_sweep * disc_angle / dwell_angle),
        bind(lambda sector_dwell_sweep, sector_stop_sweep, law_position:
                sector_dwell_sweep + formulas.starting_angle(sector_stop_sweep, law_position)),
        bind(formulas.returning_angle), bind(formulas.starting_angle)), source="003, Fig. 4")
sector.choice("sector_speed", "ω_3", "rad", "Speed of the sector relative to the disc, per revolution of the disc",
    *by_phase(bind(common.same, quantity="sector_speed_dwell"), bind(formulas.rise_speed, **RISE),
        bind(lambda sweep, time, law_velocity: -sweep / time * law_velocity, **FALL),
        bind(formulas.rise_speed, **RISE)), source="003 eq. 1, 2, Fig. 6")
sector.choice("sector_acceleration", "ε_3", "rad/s**2", "Angular acceleration of the sector",
    *by_phase(common.zero, bind(formulas.rise_acceleration, **RISE),
        bind(lambda sweep, time, law_acceleration, cycles_per_hour: -sweep * (cycles_per_hour / time) ** 2 * law_acceleration, **FALL),
        bind(formulas.rise_acceleration, **RISE)), source="kinematics")
sector.value("rocker_turn", "w", "1", "Ratio of the angular speed of sector and rocker to that of the disc",
    lambda sector_speed: 1 + sector_speed / (2 * pi), source="kinematics", output=False)

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
    lambda gear_rotation_per_cycle: abs(gear_rotation_per_cycle - 2 * pi), source="kinematics", output=False)


conveyor = Chapter("Motion of the sheet", text="The gear drives the conveyor's sprocket; one cycle makes one step.", needs=SHEET,
    absent="not calculated: {missing} not given")
conveyor.value("sheet_step", "S", "mm", "Step of the conveyor per cycle",
    lambda sprocket_teeth, chain_pitch, sprocket_ratio: sprocket_teeth * chain_pitch * sprocket_ratio, source="this method")
conveyor.value("sheet_position", "x", "mm", "Position of the sheet from its dwell position",
    lambda gear_angle, sheet_step: sheet_step * gear_angle / (2 * pi), source="kinematics")
conveyor.value("sheet_velocity", "V", "m/s", "Velocity of the sheet",
    lambda gear_speed, sheet_step, cycles_per_hour: sheet_step * cycles_per_hour * gear_speed / (2 * pi), source="kinematics")
conveyor.value("sheet_acceleration", "a_s", "m/s**2", "Acceleration of the sheet",
    lambda gear_acceleration, sheet_step: sheet_step * gear_acceleration / (2 * pi), source="kinematics")
conveyor.reduction("sheet_velocity_max", "V_max", "m/s", "Maximum velocity of the sheet", "abs_max", of="sheet_velocity", source="kinematics")
conveyor.reduction("sheet_acceleration_max", "a_s,max", "m/s**2", "Maximum acceleration of the sheet", "abs_max", of="sheet_acceleration",
    source="kinematics")

grippers = Chapter("Holding force of the grippers",
    text="The grippers must hold the sheet against its own inertia; air resistance and the friction of the surface on which it slides are neglected.",
    needs=GRIPPED, absent="not calculated: {missing} not given")
grippers.value("sheet_mass", "m_s", "g", "Mass of the sheet", contact.sheet_mass, source="geometry")
grippers.value("sheet_force", "F_g", "N", "Maximum force of the sheet on its grippers", contact.sheet_force, source="mechanics")
rest = Chapter("Rest of the sheet within a tolerance",
    text="The sheet is at rest while it is within e of its dwell position: before and after the dwell, as long as the product of both distances "
        "beyond e is negative.", needs=(*SHEET, "rest_tolerance"), absent="not calculated: {missing} not given")
rest.require("tolerance_below_step", lambda rest_tolerance, sheet_step: 2 * rest_tolerance < sheet_step, key="rest_tolerance",
    message="is {rest_tolerance}, but must be less than half the step {sheet_step}")
rest.value("rest_excess", "Π_e", "mm**2", "Product of the distances beyond the tolerance from the last and from the next rest position",
    lambda sheet_position, sheet_step, rest_tolerance: (sheet_position - rest_tolerance) * (sheet_step - rest_tolerance - sheet_position),
    output=False)
rest.crossings("rest_edge", "φ_e", "deg", "Disc angle at which the sheet leaves its rest, and at which it comes to rest again", of="rest_excess")
rest.phase("rest", "rest", "Rest of the sheet within the tolerance", "disc_angle", ("rest_edge_2", "rest_edge_1"))

torques = Chapter("Torque",
    text="Losses are neglected: only the conveyor's mass is moved, and the sector with its rocker where their inertia is given. The fixed cams do "
        "no work, since the rollers move along them; the disc therefore supplies the power of gear and sector.", needs=TORQUE,
    absent="not calculated: {missing} not given")
torques.value("gear_torque", "M_1", "N*m", "Torque at the gear's shaft",
    lambda conveyor_mass, sheet_acceleration, sheet_step: conveyor_mass * sheet_acceleration * sheet_step / (2 * pi), source="statics")
torques.value("tooth_force", "F_t", "N", "Tangential force between the teeth of sector and gear",
    lambda gear_torque, gear_radius: gear_torque / gear_radius, source="statics")
torques.value("drive_torque", "M_2", "N*m", "Torque at the disc's shaft",
    lambda gear_torque, gear_speed, sector_inertia, sector_acceleration, rocker_turn:
        gear_torque * gear_speed / (2 * pi) + sector_inertia * sector_acceleration * rocker_turn, source="energy")
torques.reduction("gear_torque_peak", "M_1,max", "N*m", "Maximum torque at the gear's shaft", "abs_max", of="gear_torque", source="statics")
torques.reduction("tooth_force_peak", "F_t,max", "N", "Maximum tangential force between the teeth", "abs_max", of="tooth_force", source="statics")
torques.reduction("torque_peak", "M_peak", "N*m", "Maximum torque at the disc's shaft, driving or driven", "abs_max", of="drive_torque",
    source="energy")
torques.reduction("torque_rms", "M_rms", "N*m", "Root mean square torque at the disc's shaft", "rms", of="drive_torque", source="energy")
torques.reduction("energy_turn", "E_Σ", "J", "Work of the disc's torque per revolution", "integral", of="drive_torque", source="energy", output=False)
torques.value("kinetic_energy_max", "E_k", "J", "Maximum kinetic energy of the conveyor",
    lambda conveyor_mass, sheet_velocity_max: conveyor_mass * sheet_velocity_max ** 2 / 2, source="energy")
torques.value("energy_residual", "r_E", "1", "Ratio of the work per revolution to the maximum kinetic energy",
    lambda energy_turn, kinetic_energy_max: abs(energy_turn) / kinetic_energy_max, source="energy", output=False)
