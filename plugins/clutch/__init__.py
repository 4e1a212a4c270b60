"""Friction clutch with a wedge-spread ring of shoes (002 eq. 12–17)."""

from __future__ import annotations

from diecut_report.api import Check, ExampleBlock, Mechanism, Source, Vary, Wired, m
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
        Check("releases", "function", "Clutch releases by itself", m.wedge_friction, m.wedge_slope, operator="<",
              demand_label="friction coefficient f", limit_label="slope tan α",
              consequence="the wedge locks itself: without P_1 the clutch stays engaged, and the cone must be pulled out with "
              "{release_force}.", advise=(Vary("wedge_angle", "up"), Vary("wedge_friction", "down"))),
        Check("transmitted_torque", "function", "Torque that the clutch transmits", m.transmitted_torque_max, m.design_torque,
              only_with=("torque_curve",), demand_label="maximum over the cycle", limit_label="design torque", source="statics",
              consequence="the clutch slips in every cycle, and wears and heats; it is to be designed for the torque that passes it.",
              advise=(Vary("torque", "up"), Vary("service_factor", "up"))),
        Check("pressure", "strength", "Pressure on the lining", m.pressure, m.allowable_pressure, sized_unless=("shoe_width",),
              demand_label="pressure", consequence="the given shoes are too narrow.",
              advise=(Vary("shoe_width", "up"), Vary("shoe_radius", "up"), Vary("shoe_coverage", "up"))),
        Check("width_ratio", "practice", "Width of the shoes", m.width_ratio, 0.5, demand_label="ratio of width to diameter",
              consequence="so wide shoes do not bear evenly; of a lining of more friction they may be narrower.",
              advise=(Vary("shoe_radius", "up"), Vary("shoe_width", "down"), ("shoe_radius", "shoe_width"))),
        Check("axial_travel", "function", "Travel of the cone", m.axial_travel, m.available_travel, needs=("radial_gap", "available_travel"),
              demand_label="travel for gap and wear", limit_label="available", consequence="the cone meets its stop before the lining is worn.",
              advise=(Vary("available_travel", "up"), Vary("wear_allowance", "down"), Vary("wedge_angle", "up"))),
        Check("engagement_force", "function", "Engagement force", m.engagement_force, m.available_force, demand_label="required force",
              limit_label="available", source="002 eq. 15",
              consequence="the clutch slips under its torque; a lining of more friction needs less force.",
              advise=(Vary("wedge_angle", "down"), Vary("shoe_radius", "up"))),
        Check("slip_time", "function", "Slip time", m.slip_time, m.allowable_slip_time, demand_label="slip", source="input", needs=HEATED,
              consequence="the driven side comes too late into step; less driven_inertia or more torque shortens it."),
        Check("slip_share", "function", "Time between engagements", m.slip_share, 1.0, operator="<", needs=HEATED,
              demand_label="fraction of time in slip", limit_label="whole time",
              consequence="the next engagement begins before this one is over ({slip_time}); less inertia or load, or more torque, "
              "makes it shorter.", advise=(Vary("engagements_per_hour", "down"),)),
        Check("lining_power_density", "strength", "Friction power on the lining", m.lining_power_density, m.allowable_power_density,
              needs=(*HEATED, "allowable_power_density"), demand_label="mean power per unit area", source="this method",
              consequence="the lining wears and burns; less driven inertia makes less heat.",
              advise=(Vary("engagements_per_hour", "down"), Vary("shoe_width", "up"))),
        Check("pv", "strength", "Product of pressure and sliding speed", m.pv, m.allowable_pv, needs=("speed", "allowable_pv"),
              demand_label="product at first contact", consequence="the lining glazes as it engages.",
              advise=(Vary("shoe_width", "up"), Vary("shoe_radius", "up"), ("shoe_radius", "shoe_width"), Vary("speed", "down"))),
        Check("temperature_rise", "strength", "Temperature of the lining", m.lining_temperature_rise, m.allowable_temperature_rise,
              needs=(*HEATED, "allowable_temperature_rise"), demand_label="maximum temperature rise",
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
