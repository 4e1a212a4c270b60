"""Friction clutch with a wedge-spread ring of shoes (002 eq. 12–17)."""

from __future__ import annotations

from diecut_report.api import Check, ExampleBlock, Mechanism, Source, Vary, Wired
from diecut_report.plugins.clutch.figures import FIGURES
from diecut_report.plugins.clutch.steps import SECTIONS, Clutch

EXAMPLE = ExampleBlock(
    "clutch",
    {
        "torque": Wired("${<cylinder_drive>.crank_torque_peak}", otherwise="500 N*m"),
        "speed": Wired(
            "${<cylinder_drive>.crank_speed}", otherwise=Wired("${<drive_train>.output_speed}", otherwise="50 rpm")
        ),
        "shoe_radius": "180 mm",
        "wedge_angle": "10 deg",
        # what moves is at its fastest, at this shaft
        "driven_inertia": Wired(
            "2 * ${<cylinder_drive>.kinetic_energy_max} / ${<cylinder_drive>.crank_speed}**2", otherwise="20 kg*m**2"
        ),
        "engagements_per_hour": "60 1/h",
        "radial_gap": "0.6 mm",
        "available_travel": "6 mm",
        "available_force": "4 kN",
    },
)


HEATED = ("driven_inertia", "speed")

MECHANISM = Mechanism(
    kind="clutch",
    version="1.0",
    title="Friction clutch with a wedge-spread shoe ring",
    summary="The clutch couples the cylinder's drive to a shaft that rotates at constant speed. An axial force drives a cone under the shoes and "
            "presses them against a drum. From the torque follow the pressing force, the engagement force, the release and the width of the "
            "shoes; with the driven inertia the heat, slip time and temperature of an engagement, with the gap the travel of the cone.",
    inputs=Clutch,
    example=EXAMPLE,
    chapters=SECTIONS,
    key_results=("design_torque", "pressing_force", "engagement_force", "release_force", "self_locking", "shoe_width", "axial_travel",
                 "engagement_energy", "slip_time", "lining_temperature_rise"),
    checks=(
        Check(id="releases", check_class="function", title="Clutch releases by itself",
              demand="wedge_friction", limit="wedge_slope", unit="1", operator="<",
              demand_label="friction coefficient f", limit_label="slope tan α", source="statics",
              consequence="the wedge locks itself: without P_1 the clutch stays engaged, and the cone must be pulled out with "
              "{release_force}.",
              advise=(Vary("wedge_angle", "up"), Vary("wedge_friction", "down"))),
        Check(id="transmitted_torque", check_class="function", title="Torque that the clutch transmits",
              demand="transmitted_torque_max", limit="design_torque", unit="N*m", only_with=("torque_curve",),
              demand_label="maximum over the cycle", limit_label="design torque", source="statics",
              consequence="the clutch slips in every cycle, and wears and heats; it is to be designed for the torque that passes it.",
              advise=(Vary("torque", "up"), Vary("service_factor", "up"))),
        Check(id="pressure", check_class="strength", title="Pressure on the lining",
              demand="pressure", limit="allowable_pressure", unit="MPa",
              sized_unless=("shoe_width",), demand_label="pressure", limit_label="allowed", source="002 eq. 17",
              consequence="the given shoes are too narrow.",
              advise=(Vary("shoe_width", "up"), Vary("shoe_radius", "up"), Vary("shoe_coverage", "up"))),
        Check(id="width_ratio", check_class="practice", title="Width of the shoes", demand="width_ratio", limit=0.5, unit="1",
              demand_label="ratio of width to diameter", limit_label="accepted", source="this method",
              consequence="so wide shoes do not bear evenly; of a lining of more friction they may be narrower.",
              advise=(Vary("shoe_radius", "up"), Vary("shoe_width", "down"), ("shoe_radius", "shoe_width"))),
        Check(id="axial_travel", check_class="function", title="Travel of the cone",
              demand="axial_travel", limit="available_travel", unit="mm",
              needs=("radial_gap", "available_travel"), demand_label="travel for gap and wear", limit_label="available", source="geometry",
              consequence="the cone meets its stop before the lining is worn.",
              advise=(Vary("available_travel", "up"), Vary("wear_allowance", "down"), Vary("wedge_angle", "up"))),
        Check(id="engagement_force", check_class="function", title="Engagement force", demand="engagement_force", limit="available_force",
              unit="N", demand_label="required force", limit_label="available", source="002 eq. 15",
              consequence="the clutch slips under its torque; a lining of more friction needs less force.",
              advise=(Vary("wedge_angle", "down"), Vary("shoe_radius", "up"))),
        Check(id="slip_time", check_class="function", title="Slip time", demand="slip_time", limit="allowable_slip_time",
              unit="s", demand_label="slip", limit_label="allowed", source="input", needs=HEATED,
              consequence="the driven side comes too late into step; less driven_inertia or more torque shortens it."),
        Check(id="slip_share", check_class="function", title="Time between engagements",
              demand="slip_share", limit=1.0, unit="1", operator="<", needs=HEATED,
              demand_label="fraction of time in slip", limit_label="whole time", source="kinematics",
              consequence="the next engagement begins before this one is over ({slip_time}); less inertia or load, or more torque, "
              "makes it shorter.", advise=(Vary("engagements_per_hour", "down"),)),
        Check(id="lining_power_density", check_class="strength", title="Friction power on the lining", demand="lining_power_density",
              limit="allowable_power_density", unit="W/cm**2", needs=(*HEATED, "allowable_power_density"),
              demand_label="mean power per unit area", limit_label="allowed", source="this method",
              consequence="the lining wears and burns; less driven inertia makes less heat.",
              advise=(Vary("engagements_per_hour", "down"), Vary("shoe_width", "up"))),
        Check(id="pv", check_class="strength", title="Product of pressure and sliding speed",
              demand="pv", limit="allowable_pv", unit="MPa*m/s",
              needs=("speed", "allowable_pv"), demand_label="product at first contact", limit_label="allowed", source="this method",
              consequence="the lining glazes as it engages.",
              advise=(Vary("shoe_width", "up"), Vary("shoe_radius", "up"), ("shoe_radius", "shoe_width"), Vary("speed", "down"))),
        Check(id="temperature_rise", check_class="strength", title="Temperature of the lining", demand="lining_temperature_rise",
              limit="allowable_temperature_rise", unit="K", needs=(*HEATED, "allowable_temperature_rise"),
              demand_label="maximum temperature rise", limit_label="allowed", source="this method",
              consequence="the lining loses its friction; less driven inertia or better cooling helps, too.",
              advise=(Vary("shoe_width", "up"), Vary("engagements_per_hour", "down"))),
    ),
    figures=FIGURES,
    assumptions=(
        "The shoes are cylindrical, rigid and press evenly on the part of the circumference that they cover; friction between shoes and their "
        "axial stop and the springs that retract them are neglected.",
        "The coefficients of friction of the lining on the drum and of the cone under the shoes are two separate values, each the same at rest "
        "and in motion.",
        "The driving shaft keeps its speed; the driven side starts from rest, and the load torque is constant during slip. Without "
        "load_torque_at_engagement it is zero: the clutch engages while nothing is cut. A load increases the heat.",
        "All heat of an engagement flows into the drum, evenly over the surface that the shoes sweep; the small amount that the lining takes is "
        "neglected, so the temperature is on the safe side. The drum's wall is thicker than the penetration depth of the heat.",
        "Mean temperature: the drum dissipates the mean power through its cooled surface alone.",
    ),
    sources=(
        Source("002", "Loizyk V. V., Bryndas A. M., Shelonh N. M., Ternytskyi S. V. Analytical studies of drive mechanism parameters of "
               "flat cylinder die-cutting press. Lviv Polytechnic National University (in Ukrainian)."),
    ),
)  # fmt: skip
