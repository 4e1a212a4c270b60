"""Chapters on the rolling of sector and gear, and on the phases of the cycle."""

from __future__ import annotations

import numpy as np

from diecut_report.api import ByText, Chapter, Vary, bind
from diecut_report.mechanics import common
from diecut_report.mechanics.motion_laws import MIDDLE_POSITION, MIDDLE_VELOCITY, PEAK_ACCELERATION, PEAK_VELOCITY
from diecut_report.plugins.cam_gear_transport import formulas
from diecut_report.plugins.cam_gear_transport.inputs import MODULES

# fmt: off

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
rolling.value("gear_radius", "R_1", "mm", "Pitch radius of the gear", formulas.gear_radius, source="003 eq. 1")
rolling.value("sector_radius", "R_3", "mm", "Pitch radius of the sector", formulas.sector_radius, source="003 eq. 1")
rolling.value("sector_sweep", "γ_Σ", "deg", "Total sweep of the sector",
    lambda sector_dwell_sweep, sector_stop_sweep: sector_dwell_sweep + sector_stop_sweep, source="003, Fig. 4")
rolling.value("sector_teeth", "z_3′", "1", "Number of teeth of the sector: those of the swept arc, and one on each side",
    lambda sector_wheel_teeth, sector_sweep: np.ceil(sector_wheel_teeth * sector_sweep / (2 * np.pi)) + 2, whole=True, source="this method",
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
        2 * np.pi * sector_dwell_sweep / (sector_dwell_sweep + law_peak_velocity * sector_stop_sweep), source="003 eq. 4, solved", lacks=("module",))
phases.value("dwell_angle_limit", "φ_22,lim", "deg", "Dwell that leaves no time for the return, with these teeth",
    lambda time_stop: 2 * np.pi * (1 - time_stop), source="003 eq. 4, solved", needs=("module",))
phases.value("dwell_angle_recommended", "φ_22,rec", "deg", "Dwell that leaves the required time for the return",
    lambda dwell_angle_limit, min_return_time: (1 - min_return_time) * dwell_angle_limit, source="003 eq. 4, solved", lacks=("module",))
phases.value("dwell_angle_recommended", "φ_22,rec", "deg", "Dwell that leaves the required time for the return",
    lambda dwell_angle_limit, min_return_time: dwell_angle_limit - 2 * np.pi * min_return_time, source="003 eq. 4, solved", needs=("module",))
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
    lambda dwell_angle, time_stop: dwell_angle + np.pi * time_stop, source="003, after eq. 3", digits=6)
phases.value("angle_start", "φ_I", "deg", "Disc angle where the sector starts again: beginning of phase I",
    lambda time_stop: 2 * np.pi - np.pi * time_stop, source="003, after eq. 4", digits=6)
phases.value("sector_speed_return_peak", "ω_3,4", "rad", "Maximum speed of the sector's return, per revolution of the disc",
    bind(formulas.return_peak, peak_velocity="law_peak_velocity"), source="003, after eq. 4, corrected", digits=5)
phases.value("disc_speed", "ω_2", "rad/s", "Angular speed of the disc", lambda cycles_per_hour: 2 * np.pi * cycles_per_hour, source="kinematics",
    output=False)
