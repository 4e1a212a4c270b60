"""The calculation of the friction clutch, chapter by chapter."""

from __future__ import annotations

from diecut_report.api import Case, Chapter, Choice, Require, Value, Words, bind
from diecut_report.mechanics import common
from diecut_report.plugins.clutch import advice
from diecut_report.plugins.clutch import formulas as f

TORQUE = Chapter(
    "Torque",
    steps=(
        Value(id="torque", symbol="M", unit="N*m", description="Torque that the clutch is to carry", source="002 eq. 16", lacks=("torque",),
              formula=bind(common.quotient, quantity="power", by="speed")),
        Value(id="power", symbol="W", unit="kW", description="Power at this torque", source="002 eq. 16", needs=("torque", "speed"),
              formula=bind(common.product, first="torque", second="speed")),
        Value(id="design_torque", symbol="M_c", unit="N*m", description="Torque that the clutch is designed for", source="this method",
              formula=bind(common.product, first="service_factor", second="torque")),
    ),
)  # fmt: skip

WEDGE = Chapter(
    "Wedge",
    text="The cone's force square to its face, N_2, and the friction f·N_2 on it hold the balance of P_1 along the axis and of the shoes' "
    "pressing force P along the radius: P_1 = P·tan(α + ρ) with the angle of friction ρ. All forces are those of the whole ring of shoes.",
    steps=(
        Value(id="radial_share", symbol="c_α", description="Share of N_2 that presses the shoes", source="002 eq. 13", output=False,
              formula=bind(f.cosine, angle="wedge_angle")),
        Value(id="held_share", symbol="c_f", description="Share of N_2 that friction keeps from them", source="002 eq. 13", output=False,
              formula=f.held_by_friction),
        Value(id="wedge_angle_limit", symbol="α_lim", unit="deg", description="Wedge angle from which friction keeps all of it",
              source="002 eq. 13", formula=f.widest_wedge, output=False),
        Value(id="wedge_friction_limit", symbol="f_lim", description="Friction that does so at the given angle", source="002 eq. 13",
              formula=f.greatest_friction, output=False),
        Words(id="wedge_advice", description="What to change where the wedge jams", function=advice.against_jamming,
              takes=("wedge_angle_limit", "wedge_friction_limit")),
        Require(id="wedge_lifts", key="wedge_angle",
                condition=bind(common.is_below, smaller="held_share", greater="radial_share"),
                message="is {wedge_angle}, but with a wedge friction of {wedge_friction} no force on the cone presses the shoes outwards: "
                "cos α > f·sin α is needed; {wedge_advice}"),
        Require(id="load_below_capacity", key="load_torque_at_engagement",
                condition=bind(common.is_below, smaller="load_torque_at_engagement", greater="design_torque"),
                message="is {load_torque_at_engagement}, but the slipping clutch carries {design_torque} only, so that the driven side "
                "never comes up to speed: M_l < M_c = k_s·M is needed; lower the load while engaging or raise torque or service_factor"),
        Value(id="pressing_force", symbol="P", unit="N", description="Radial force that presses the shoes, for the torque",
              source="002 eq. 16", formula=bind(common.over_product, quantity="design_torque", first="shoe_friction", second="shoe_radius")),
        Value(id="wedge_normal_force", symbol="N_2", unit="N", description="Force square to the cone's face", source="002 eq. 14",
              formula=f.wedge_normal_force),
        Value(id="wedge_friction_force", symbol="F_f", unit="N", description="Friction on the cone's face", source="002 eq. 12",
              formula=bind(common.product, first="wedge_friction", second="wedge_normal_force")),
        Value(id="engagement_force", symbol="P_1", unit="N", description="Axial force that engages the clutch", source="002 eq. 12, 15",
              formula=f.engagement_force),
        Value(id="force_amplification", symbol="k_P", description="Amplification of the force by the wedge", source="002 eq. 15",
              formula=bind(common.quotient, quantity="pressing_force", by="engagement_force")),
    ),
)  # fmt: skip

RELEASE = Chapter(
    "Release",
    text="When P_1 is taken away, the shoes still press on the cone and friction turns round: it now holds the cone in. F_r is the axial "
    "force that then has to pull at the cone to release it. A negative F_r means that nothing has to pull: the shoes push the cone out "
    "with this force and the clutch opens by itself; as long as it is to stay engaged, the actuator has to hold the cone with at least "
    "as much. A positive or zero F_r means that the wedge locks itself: the clutch stays engaged without P_1 until the cone is pulled out.",
    steps=(
        Value(id="friction_angle", symbol="ρ", unit="deg", description="Angle of friction: up to this wedge angle the wedge locks itself",
              source="statics", formula=f.friction_angle),
        Value(id="wedge_slope", symbol="t_α", description="Slope of the cone's face: friction from this on locks it", source="statics",
              output=False, formula=f.slope),
        Value(id="release_force", symbol="F_r", unit="N", description="Force that releases the cone; negative: it opens by itself",
              source="statics", formula=f.release_force),
        Choice(id="release_behaviour", symbol="B_r", description="Without the engagement force the clutch", source="statics",
               cases=(Case("opens by itself", "friction is less than the slope of the cone's face",
                           bind(common.is_below, smaller="wedge_friction", greater="wedge_slope")),
                      Case("stays engaged until the cone is pulled out", "friction is not less than the slope of the cone's face"))),
        Value(id="self_locking", symbol="L_s", description="Whether the wedge locks itself", source="statics", formula=f.locks_itself),
        Words(id="release_advice", description="What to change where the wedge locks itself", function=advice.against_locking,
              takes=("friction_angle", "wedge_slope")),
    ),
)  # fmt: skip

LINING = Chapter(
    "Lining",
    text="The shoes are cylindrical and press evenly on their share of the circumference.",
    steps=(
        Value(id="shoe_width", symbol="b", unit="mm", description="Width of the shoes that the allowed pressure asks for",
              source="002 eq. 17", formula=f.width_at_pressure),
        Value(id="lining_width", symbol="b_L", unit="mm", description="Width of the lining: as given", source="input", needs=("shoe_width",),
              formula=bind(common.same, quantity="inputs.shoe_width")),
        Value(id="lining_width", symbol="b_L", unit="mm", description="Width of the lining: as sized", lacks=("shoe_width",),
              formula=bind(common.same, quantity="shoe_width")),
        Value(id="lining_area", symbol="A", unit="cm**2", description="Area of the lining", source="geometry", formula=f.lining_area),
        Value(id="pressure", symbol="q", unit="MPa", description="Pressure of the lining", source="002 eq. 17",
              formula=bind(common.quotient, quantity="pressing_force", by="lining_area")),
        Value(id="width_ratio", symbol="k_b", description="Width of the lining to the drum's diameter", source="this method",
              formula=f.width_ratio),
        Value(id="least_radius", symbol="r_min", unit="mm", description="Radius from which this ratio is at most a half", source="002 eq. 17",
              lacks=("shoe_width",), output=False, formula=f.radius_of_square_shoes),
        Value(id="least_radius", symbol="r_min", unit="mm", description="Radius from which this ratio is at most a half, and the pressure "
              "allowed", source="002 eq. 17", needs=("shoe_width",), output=False, formula=f.radius_of_given_shoes),
        Words(id="pressure_advice", description="What to change against the pressure", needs=("shoe_width",),
              function=advice.against_pressure, takes=("shoe_width", "lining_width", "shoe_radius", "least_radius", "shoe_coverage")),
        Words(id="width_advice", description="What to change where the shoes are too wide", lacks=("shoe_width", "allowable_pv"),
              function=advice.against_width, takes=("shoe_radius", "lining_width")),
        Words(id="width_advice", description="What to change where the shoes are too wide", lacks=("shoe_width", "speed"),
              needs=("allowable_pv",), function=advice.against_width, takes=("shoe_radius", "lining_width")),
        Words(id="width_advice", description="What to change where the shoes are too wide", lacks=("shoe_width",),
              needs=("speed", "allowable_pv"), function=advice.against_width,
              takes=("shoe_radius", "lining_width", "pv", "allowable_pv")),
        Words(id="width_advice", description="What to change where the shoes are too wide", needs=("shoe_width",),
              function=advice.against_given_width, takes=("least_radius",)),
    ),
)  # fmt: skip

TRAVEL = Chapter(
    "Travel of the cone",
    text="Along the cone's face the shoes rise by tan α for each length that the cone travels.",
    needs=("radial_gap",),
    absent="the travel of the cone is not calculated: radial_gap is not given",
    steps=(
        Value(id="engagement_travel", symbol="s_1", unit="mm", description="Axial travel that closes the gap, lining new", source="geometry",
              formula=bind(f.travel, lift="radial_gap")),
        Value(id="axial_travel", symbol="s", unit="mm", description="Axial travel until the permitted wear is used up", source="geometry",
              formula=f.travel_with_wear),
        Value(id="travel_angle", symbol="α_s", unit="deg", description="Wedge angle that does with the available travel", source="geometry",
              needs=("available_travel",), output=False, formula=f.angle_of_travel),
        Words(id="travel_advice", description="What to change where the travel is too small", needs=("available_travel",),
              function=advice.against_travel,
              takes=("wedge_angle", "wedge_angle_limit", "travel_angle", "axial_travel", "available_travel", "radial_gap")),
    ),
)  # fmt: skip

SLIDING = Chapter(
    "Sliding at engagement",
    needs=("speed",),
    absent="sliding speed and q·v are not calculated: speed is not given",
    steps=(
        Value(id="sliding_speed", symbol="v", unit="m/s", description="Sliding speed as the shoes touch the drum", source="kinematics",
              formula=bind(common.product, first="speed", second="shoe_radius")),
        Value(id="pv", symbol="qv", unit="MPa*m/s", description="Pressure times sliding speed", source="this method",
              formula=bind(common.product, first="pressure", second="sliding_speed")),
        Words(id="pv_advice", description="What to change where the lining glazes", needs=("allowable_pv", "torque"),
              function=advice.against_glazing_of_torque,
              takes=("shoe_radius", "shoe_width", "lining_width", "pv", "allowable_pv", "speed")),
        Words(id="pv_advice", description="What to change where the lining glazes", needs=("allowable_pv",), lacks=("torque",),
              function=advice.against_glazing, takes=("shoe_radius", "shoe_width", "lining_width", "pv", "allowable_pv")),
    ),
)  # fmt: skip

HEAT = Chapter(
    "Heat of the engagement",
    text="The driving shaft keeps its speed; the driven side starts from rest and is run up by M_a. The clutch slips the slower "
    "the faster the driven side runs, and all friction work becomes heat.",
    needs=("driven_inertia", "speed"),
    absent="heat, slip time and temperature are not calculated: they need driven_inertia and speed",
    steps=(
        Value(id="accelerating_torque", symbol="M_a", unit="N*m", description="Torque that runs up the driven side", source="statics",
              formula=bind(common.difference, greater="design_torque", smaller="load_torque_at_engagement")),
        Value(id="slip_time", symbol="t_s", unit="s", description="Time in which the clutch slips", source="energy",
              formula=f.slip_time),
        Value(id="engagement_energy", symbol="Q", unit="J", description="Heat of one engagement", source="energy",
              formula=f.engagement_energy),
        Value(id="slip_share", symbol="ε", description="Share of the time in which it slips", source="kinematics",
              formula=bind(common.product, first="engagements_per_hour", second="slip_time")),
        Value(id="lining_power", symbol="W_m", unit="W", description="Mean friction power", source="energy",
              formula=bind(common.product, first="engagement_energy", second="engagements_per_hour")),
        Value(id="lining_power_density", symbol="p_A", unit="W/cm**2", description="Mean friction power for each area of lining",
              source="energy", formula=bind(common.quotient, quantity="lining_power", by="lining_area")),
        Value(id="engagements_limit", symbol="z_lim", unit="1/h", description="Engagements an hour that the lining allows",
              source="energy", needs=("allowable_power_density",), output=False,
              formula=bind(f.engagements_limit, power_density="allowable_power_density")),
    ),
)  # fmt: skip

DRUM = {"conductivity": "drum_conductivity", "density": "drum_density", "specific_heat": "drum_specific_heat"}

TEMPERATURE = Chapter(
    "Temperature of the lining",
    text="The lining leads heat badly: its rubbing surface takes the temperature of the drum's surface, into which all heat is taken to go. "
    "While the clutch slips the drum is a thick body whose surface takes a heat flux that falls evenly to zero; the surface is hottest at "
    "half the slip time. A drum thinner than the depth of the heat gets hotter; with drum_mass its own rise counts where it is greater. "
    "Over many engagements the drum warms up until its cooled surface gives off the mean friction power.",
    needs=("driven_inertia", "speed"),
    steps=(
        Value(id="heat_flux", symbol="p_0", unit="W/cm**2", description="Heat flux into the drum as slipping begins", source="energy",
              formula=f.heat_flux),
        Value(id="heat_depth", symbol="x_h", unit="mm", description="Depth of drum that takes up the heat meanwhile",
              source="heat conduction", formula=bind(f.penetration_depth, **DRUM)),
        Value(id="surface_temperature_rise", symbol="ΔT_s", unit="K", description="Rise of the rubbing surface in one engagement",
              source="heat conduction", formula=bind(f.surface_rise, **DRUM)),
        Value(id="drum_temperature_rise", symbol="ΔT_d", unit="K", description="Rise of the drum in one engagement, evened out",
              source="energy", needs=("drum_mass",),
              formula=bind(common.over_product, quantity="engagement_energy", first="drum_mass", second="drum_specific_heat")),
        Value(id="engagement_temperature_rise", symbol="ΔT_1", unit="K", description="Rise of the lining in one engagement",
              source="this method", needs=("drum_mass",),
              formula=bind(common.greater_of, first="surface_temperature_rise", second="drum_temperature_rise")),
        Value(id="engagement_temperature_rise", symbol="ΔT_1", unit="K", description="Rise of the lining in one engagement",
              source="this method", lacks=("drum_mass",), formula=bind(common.same, quantity="surface_temperature_rise")),
        Value(id="lining_temperature_rise", symbol="ΔT", unit="K", lacks=("cooling",), source="this method",
              description="Greatest rise of the lining, of one engagement alone", formula=bind(common.same, quantity="engagement_temperature_rise")),
    ),
)  # fmt: skip

WARMING = Chapter(
    "Mean temperature",
    needs=("driven_inertia", "speed", "cooling"),
    absent="the mean temperature over many engagements is not calculated: it needs driven_inertia, speed and the block cooling",
    steps=(
        Value(id="mean_temperature_rise", symbol="ΔT_m", unit="K", description="Mean rise of the drum above the surroundings", source="energy",
              formula=bind(common.over_product, quantity="lining_power", first="cooling.heat_transfer_coefficient", second="cooling.area")),
        Value(id="lining_temperature_rise", symbol="ΔT", unit="K", description="Greatest rise of the lining above the surroundings",
              source="this method",
              formula=bind(common.sum_of, first="mean_temperature_rise", second="engagement_temperature_rise")),
        Value(id="cooling_time", symbol="τ", unit="min", description="Time constant with which the drum cools", source="energy",
              needs=("drum_mass",),
              formula=bind(f.time_constant, mass="drum_mass", specific_heat="drum_specific_heat", area="cooling.area",
                           heat_transfer_coefficient="cooling.heat_transfer_coefficient")),
        Value(id="drum_temperature_rise_warm", symbol="ΔT_w", unit="K", source="energy", needs=("drum_mass",),
              description="Rise of the warmed-up drum right after an engagement",
              exists=bind(common.is_below, smaller=0, greater="engagements_per_hour"),
              formula=bind(f.rise_after_engagement, mass_rise="drum_temperature_rise", time_constant="cooling_time")),
    ),
)  # fmt: skip

SECTIONS = (TORQUE, WEDGE, RELEASE, LINING, TRAVEL, SLIDING, HEAT, TEMPERATURE, WARMING)
