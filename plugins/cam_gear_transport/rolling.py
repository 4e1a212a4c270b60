"""Chapters on the rolling of sector and gear, and on the phases of the cycle."""

from __future__ import annotations

from diecut_report.api import ByText, Chapter, Lookup, Require, Value, Words, bind
from diecut_report.mechanics import common
from diecut_report.mechanics.motion_laws import MIDDLE_POSITION, MIDDLE_VELOCITY, PEAK_ACCELERATION, PEAK_VELOCITY
from diecut_report.plugins.cam_gear_transport import advice, formulas

LEAST_RETURN = 1e-9  # share of a turn: below it what is left for the return is rounding

ROLLING = Chapter(
    "Rolling of the sector on the gear",
    text="While the disc turns by φ_22, the sector turns on its pin by γ_32 and rolls off the same arc of the gear: φ_22·R_1 = γ_32·R_3. "
    "So the gear, whose axis is that of the disc, stands still.",
    steps=(
        Value(id="teeth_together", symbol="z_Σ", description="Teeth of gear and sector together, the sector counted as a full wheel",
              source="geometry", output=False, needs=("module",), digits=6, formula=formulas.teeth_together),
        Value(id="center_distance_nearest", symbol="R_2′", unit="mm", description="Nearest radius of the pin with whole teeth", output=False,
              source="geometry", needs=("module",), digits=10, formula=formulas.nearest_distance),
        Require(id="whole_teeth", needs=("module",), key="center_distance", condition=bind(formulas.is_whole, number="teeth_together"),
                message="is {center_distance}, but with a module of {module} gear and sector would have 2·R₂/m = {teeth_together} teeth "
                "together, which must be a whole number; the nearest center_distance is {center_distance_nearest}"),
        Value(id="gear_teeth", whole=True, symbol="z_1", description="Teeth of the gear", source="this method", needs=("module",),
              formula=bind(formulas.gear_teeth, sweep="inputs.sector_dwell_sweep")),
        Value(id="sector_wheel_teeth", whole=True, symbol="z_3", description="Teeth of the sector, counted as a full wheel", source="this method",
              needs=("module",), formula=formulas.other_teeth),
        Words(id="module_finer", function=advice.finer_teeth, takes=("center_distance", "inputs.sector_dwell_sweep", "dwell_angle"),
              needs=("module",)),
        Require(id="some_teeth", needs=("module",), key="module", condition=formulas.both_have_teeth,
                message="is {module}, with which the gear would have {gear_teeth} and the sector {sector_wheel_teeth} teeth; take "
                "{module_finer}, or change sector_dwell_sweep or dwell_angle"),
        Value(id="sector_dwell_sweep", symbol="γ_32", unit="deg", source="003 eq. 1, for whole teeth", needs=("module",), digits=6,
              description="Sweep of the sector during the dwell: as the whole teeth ask for", formula=formulas.sweep_of_teeth),
        Value(id="sector_dwell_sweep", symbol="γ_32", unit="deg", description="Sweep of the sector during the dwell: as given",
              source="input", lacks=("module",), digits=6, formula=bind(common.same, quantity="inputs.sector_dwell_sweep")),
        Value(id="radius_ratio", symbol="R_12", description="Radius of the gear to that of the pin, R_1/R_2", source="003 eq. 1",
              formula=bind(formulas.radius_ratio, sweep="sector_dwell_sweep")),
        Value(id="gear_radius", symbol="R_1", unit="mm", description="Pitch radius of the gear", source="003 eq. 1",
              formula=formulas.gear_radius),
        Value(id="sector_radius", symbol="R_3", unit="mm", description="Pitch radius of the sector", source="003 eq. 1",
              formula=formulas.sector_radius),
        Value(id="sector_sweep", symbol="γ_Σ", unit="deg", description="Whole sweep of the sector", source="003, Fig. 4",
              formula=bind(common.sum_of, first="sector_dwell_sweep", second="sector_stop_sweep")),
        Value(id="sector_teeth", whole=True, symbol="z_3′", description="Teeth of the sector: of the swept arc, and one on each side",
              source="this method", needs=("module",), formula=formulas.sector_teeth),
    ),
)  # fmt: skip

PHASES = Chapter(
    "Phases of the cycle",
    text="Times are shares of a turn of the disc, speeds are in rad for each turn of the disc. Phase II is the dwell; in III the sector "
    "stops, in IV it returns, in I it starts again. III and I are the two halves of one rise by the law of motion, whose greatest speed "
    "is that of the dwell.",
    steps=(
        Value(id="law_peak_velocity", symbol="B", description="Peak velocity of the law of motion", source="003, after eq. 3",
              formula=ByText("motion_law", PEAK_VELOCITY)),
        Value(id="law_peak_acceleration", symbol="A", description="Peak acceleration of the law of motion", source="motion laws",
              formula=ByText("motion_law", PEAK_ACCELERATION)),
        Lookup(id="law_middle_position", symbol="f_m", description="Position of the law in the middle of its time", source="motion laws",
               output=False, by="motion_law", table=MIDDLE_POSITION),
        Lookup(id="law_middle_velocity", symbol="f′_m", description="Velocity of the law in the middle of its time", source="motion laws",
               output=False, by="motion_law", table=MIDDLE_VELOCITY),
        Require(id="law_symmetric", key="motion_law",
                condition=bind(formulas.is_symmetric, middle_position="law_middle_position", middle_velocity="law_middle_velocity",
                               peak_velocity="law_peak_velocity"),
                message="is {motion_law}, which is not half way and fastest in the middle of its time; the phases III and I ask for that, "
                "take another law"),
        Value(id="time_dwell", symbol="T_2", description="Share of the dwell, phase II", source="003, second eq. 1",
              formula=bind(formulas.share_of_turn, angle="dwell_angle")),
        Value(id="sector_speed_dwell", symbol="ω_3,2", unit="rad", description="Speed of the sector in the dwell, per turn of the disc",
              source="003, second eq. 1", digits=5, formula=bind(formulas.constant_speed, sweep="sector_dwell_sweep", time="time_dwell")),
        Value(id="time_stop", symbol="T_(3+1)", description="Share of the phases III and I together", source="003 eq. 3",
              formula=bind(formulas.time_stop, peak_velocity="law_peak_velocity")),
        Value(id="time_return", symbol="T_4", description="Share of the return, phase IV", source="003 eq. 4",
              formula=formulas.time_return),
        Value(id="dwell_angle_limit", symbol="φ_22,lim", unit="deg", description="Dwell that leaves no time for the return, with these sweeps",
              source="003 eq. 4, solved", lacks=("module",),
              formula=bind(formulas.dwell_limit, sweep="sector_dwell_sweep", peak_velocity="law_peak_velocity")),
        Value(id="dwell_angle_limit", symbol="φ_22,lim", unit="deg", description="Dwell that leaves no time for the return, with these teeth",
              source="003 eq. 4, solved", needs=("module",), formula=formulas.dwell_limit_of_teeth),
        Value(id="dwell_angle_recommended", symbol="φ_22,rec", unit="deg", description="Dwell that leaves the return its time",
              source="003 eq. 4, solved", lacks=("module",), formula=formulas.dwell_recommended),
        Value(id="dwell_angle_recommended", symbol="φ_22,rec", unit="deg", description="Dwell that leaves the return its time",
              source="003 eq. 4, solved", needs=("module",), formula=formulas.dwell_recommended_of_teeth),
        Value(id="stop_sweep_limit", symbol="γ_lim", unit="deg", source="003 eq. 4, solved",
              description="Sweep of stop and start that leaves no time for the return, with this dwell",
              formula=bind(formulas.stop_sweep_limit, peak_velocity="law_peak_velocity")),
        Value(id="stop_sweep_recommended", symbol="γ_rec", unit="deg", source="003 eq. 4, solved",
              description="Sweep of stop and start that leaves the return its time, with this dwell",
              formula=bind(formulas.stop_sweep_recommended, peak_velocity="law_peak_velocity")),
        Words(id="return_recommended", function=advice.leaves_return, takes=("dwell_angle_recommended", "stop_sweep_recommended"),
              lacks=("module",)),
        Words(id="return_recommended", function=advice.leaves_return_with_teeth, takes=("dwell_angle_recommended", "stop_sweep_recommended"),
              needs=("module",)),
        Words(id="return_limit", function=advice.leaves_return, takes=("dwell_angle_limit", "stop_sweep_limit"),
              lacks=("module",)),
        Words(id="return_limit", function=advice.leaves_return_with_teeth, takes=("dwell_angle_limit", "stop_sweep_limit"),
              needs=("module",)),
        Require(id="return_exists", key="dwell_angle", condition=bind(common.is_below, smaller=LEAST_RETURN, greater="time_return"),
                message="is {dwell_angle}; with a sector_stop_sweep of {sector_stop_sweep} dwell, stop and start take the whole turn and leave "
                "T₄ = 1 − T₂ − T₍₃₊₁₎ = {time_return} for the sector's return; take {return_recommended}, which leaves it {min_return_time} of "
                "the turn. The bare limit, which leaves next to nothing, is {return_limit}"),
        Value(id="angle_dwell", symbol="φ_II", unit="deg", description="Disc angle where the dwell begins, phase II", source="this method",
              output=False, formula=common.zero),
        Value(id="angle_stop", symbol="φ_IV", unit="deg", description="Disc angle where the sector stops: end of phase III",
              source="003, after eq. 3", digits=6, formula=formulas.angle_stop),
        Value(id="angle_start", symbol="φ_I", unit="deg", description="Disc angle where the sector starts again: beginning of phase I",
              source="003, after eq. 4", digits=6, formula=formulas.angle_start),
        Value(id="sector_speed_return_peak", symbol="ω_3,4", unit="rad", description="Greatest speed of the sector's return, per turn of the disc",
              source="003, after eq. 4, corrected", digits=5,
              formula=bind(formulas.return_peak, peak_velocity="law_peak_velocity")),
    ),
)  # fmt: skip
