"""Chapters on the V-belt, and formulas that belts share."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    Chapter,
    Vary,
    as_number,
    formula,
    inner,
    lookup,
    m,
    pi,
    pick,
    root,
    standard_series,
    standard_series_by,
    standard_table,
    value,
)
from diecut_report.mechanics import belt_path

# fmt: off

PULLEYS = standard_series("renard_r40_lengths")
LENGTHS = standard_series_by("iso_4184_lengths")
LARGEST_RATIO = 7.0
LARGEST_DEVIATION = 2.0  # of the output's speed, %
FASTEST_BELT = 30.0  # m/s
LEAST_WRAP = 120.0  # deg


@formula
def rim_speed(speed: Any, diameter: Any) -> Any:
    """Speed at the circumference."""
    return speed * diameter / 2


@formula
def length_factor(length: Any, reference: Any) -> Any:
    """Factor of the belt's length: a longer belt bends less often."""
    ratio = length / reference
    return np.where(ratio <= 1, ratio**0.18, ratio**0.15)


PAIR = {"small": "small_radius", "large": "large_radius"}
LARGEST: dict[str, str | float] = {"ratio": "vbelt_ratio", "largest": LARGEST_RATIO}
RATIO: dict[str, str | float] = LARGEST | {"distance": "vbelt.center_distance"}
RANGE: dict[str, str | float] = LARGEST | {
    "shortest": "shortest_belt",
    "length": "vbelt_length",
    "longest": "longest_belt",
}
DISTANCE = ("vbelt.center_distance",)
RATIO_TOO_GREAT = (
    f"leave the V-belt a ratio of {{vbelt_ratio}}, above the {LARGEST_RATIO:g} that one V-belt covers: from motor_speed = "
    "{motor_speed} to output_speed = {inputs.output_speed} it is {total_ratio}, of which the gears have {gear_ratio_total}"
)

vbelt = Chapter("V-belt",
    text="The belt length follows exactly from its two spans and two arcs. The nearest standard length corrects the centre distance. Radii are "
        "those of the datum line.")
vbelt.least_driver_diameter = (lookup(standard_table("vbelt_least_diameter"), by="vbelt.section", output=False), "d_min", "mm",
    "Minimum datum diameter of the section's pulleys", "ISO 4183")
vbelt.vbelt_speed = rim_speed.of(speed=m.shaft_1_speed, diameter=m.vbelt.driver_diameter), "v", "m/s", "Speed of the belt", "kinematics"
vbelt.small_radius = inner(np.minimum(m.vbelt.driver_diameter, m.driven_diameter) / 2), "r_1", "mm", "Radius of the smaller pulley"
vbelt.large_radius = inner(np.maximum(m.vbelt.driver_diameter, m.driven_diameter) / 2), "r_2", "mm", "Radius of the larger pulley"
vbelt.least_center_distance = inner(m.small_radius + m.large_radius), "a_min", "mm", "Centre distance at which the pulleys touch"
vbelt.shortest_belt = (lookup({name: series.values[0] for name, series in LENGTHS.items()}, by="vbelt.section", output=False), "L_min", "mm",
    "Shortest standard belt of the section", "ISO 4184")
vbelt.longest_belt = (lookup({name: series.values[-1] for name, series in LENGTHS.items()}, by="vbelt.section", output=False), "L_max", "mm",
    "Longest standard belt of the section", "ISO 4184")
vbelt.require("ratio_leaves_room", (m.vbelt_ratio <= 7.0) | (m.least_center_distance < m.vbelt.center_distance), key="gears",
    message=RATIO_TOO_GREAT, advise=("gears.driven_teeth",))
vbelt.require("driver_large_enough", m.least_driver_diameter <= m.vbelt.driver_diameter, key="vbelt.driver_diameter",
    message="is {vbelt.driver_diameter}, but a belt of section {vbelt.section} needs pulleys of {least_driver_diameter} or more: take a larger "
    "pulley or a smaller section", advise=(Vary("vbelt.driver_diameter", "up", PULLEYS),))
vbelt.require("pulleys_apart", (m.vbelt_ratio > 7.0) | (m.least_center_distance < m.vbelt.center_distance), key="vbelt.center_distance",
    message="is {vbelt.center_distance}, but pulleys of {vbelt.driver_diameter} and {driven_diameter} overlap up to {least_center_distance:up}",
    advise=DISTANCE)
vbelt.vbelt_length = (belt_path.open_belt_length.of(center_distance=m.vbelt.center_distance, small=m.small_radius, large=m.large_radius), "L_0",
    "mm", "Belt length at the wanted centre distance", "geometry")
vbelt.require("ratio_leaves_belt", (m.vbelt_ratio <= 7.0) | ((m.vbelt_length >= m.shortest_belt) & (m.vbelt_length <= m.longest_belt)), key="gears",
    message=RATIO_TOO_GREAT, advise=("gears.driven_teeth",))
vbelt.require("belt_exists", (m.vbelt_ratio > 7.0) | ((m.vbelt_length >= m.shortest_belt) & (m.vbelt_length <= m.longest_belt)),
    key="vbelt.center_distance",
    message="is {vbelt.center_distance}; that takes a belt of {vbelt_length}, but section {vbelt.section} has standard lengths of {shortest_belt} … "
    "{longest_belt}", advise=DISTANCE)
vbelt.vbelt_standard_length = (pick("nearest", of="vbelt_length", series=LENGTHS, by="vbelt.section"), "L", "mm", "Standard length of the belt",
    "ISO 4184")
vbelt.least_belt = (inner(belt_path.open_belt_length.of(center_distance=m.least_center_distance, small=m.small_radius, large=m.large_radius)), "L_t",
    "mm", "Belt length with the pulleys touching")
vbelt.require("standard_belt_fits", m.least_belt < m.vbelt_standard_length, key="vbelt.center_distance",
    message="is {vbelt.center_distance}; the nearest standard belt, {vbelt_standard_length} long, draws the pulleys into each other "
    "({least_belt:up} is the least)", advise=DISTANCE)
vbelt.center_distance = (root(belt_path.open_belt_length(m.center_distance, m.small_radius, m.large_radius) - m.vbelt_standard_length,
    low=m.least_center_distance, high=m.vbelt_standard_length / 2, left=belt_path.run_length.of(radius=m.small_radius, next_radius=m.large_radius),
    right=(m.vbelt_standard_length - pi * (m.large_radius + m.small_radius)) / 2 - (m.large_radius
    - m.small_radius) * np.arcsin((m.large_radius - m.small_radius) / m.center_distance)), "a", "mm",
    "Centre distance, corrected for the standard belt", "geometry")
vbelt.vbelt_wrap = belt_path.wrap_small.of(small=m.small_radius, large=m.large_radius), "β_1", "deg", "Wrap on the smaller pulley", "geometry"
vbelt.vbelt_wrap_large = inner(belt_path.wrap_large.of(wrap_small=m.vbelt_wrap)), "β_2", "deg", "Wrap on the larger pulley", "geometry"

REFERENCE_LENGTHS = {"SPZ": 1600, "SPA": 2500, "SPB": 3550, "SPC": 5600}  # mm
MASSES = {"SPZ": 0.07, "SPA": 0.12, "SPB": 0.20, "SPC": 0.37}  # kg/m
COUNT = "vbelt.count"
WITHOUT_COUNT: dict[str, Any] = {"lacks": ("power_per_belt", COUNT)}

count = Chapter("Number of belts",
    text="The manufacturer states the power of one belt for half a turn of wrap and the reference length. The belts must transmit the motor's rated "
        "power with the service factor.")
count.tension_ratio = np.exp(m.vbelt.groove_friction * as_number(m.vbelt_wrap)), "m", "1", "Ratio of tight-side to slack-side tension", "Euler"
count.wrap_factor = 1.25 * (1 - 5 ** (-m.vbelt_wrap / pi)), "c_1", "1", "Arc of contact factor", "ISO 5292"
count.reference_length = lookup(REFERENCE_LENGTHS, by="vbelt.section", output=False), "L_r", "mm", "Reference length of the section", "Optibelt"
count.length_factor = length_factor.of(length=m.vbelt_standard_length, reference=m.reference_length), "c_3", "1", "Belt length factor", "Optibelt"
count.vbelt_power = m.vbelt.service_factor * m.motor_power, "P_b", "kW", "Design power of the belts", "Optibelt"
count.vbelt_share = (inner(m.vbelt_power / (m.power_per_belt * m.wrap_factor * m.length_factor), needs=("power_per_belt",)), "z_P", "1",
    "Design power in terms of that of one belt", "Optibelt")
count.vbelt_count_needed = (value(np.maximum(1, np.ceil(m.vbelt_share)), whole=True, needs=("power_per_belt",)), "z_req", "1",
    "Required number of belts", "Optibelt")
count.vbelt_count = value(m[COUNT], whole=True, needs=(COUNT,)), "z", "1", "Number of belts: as given", "input"
count.vbelt_count = (value(m.vbelt_count_needed, whole=True, needs=("power_per_belt",), lacks=(COUNT,)), "z", "1",
    "Number of belts: the smallest sufficient number", "this method")

PULL: dict[str, str | float] = {"count": "vbelt_count", "mass_per_length": "vbelt_mass", "speed": "vbelt_speed"}
tensions = Chapter("Belt pull and shaft load",
    text="The belts transmit the motor's breakdown torque when it runs up or is overloaded, and must not slip then. The required static tension "
        "follows from the friction in their grooves: the ratio of the tensions of both sides is that of Euler's formula, and their mean is the "
        "static tension less the centrifugal force. At rest the whole tension loads the shafts.")
tensions.vbelt_peak_torque = (m.breakdown_ratio * m.motor_rated_torque, "M_1,max", "N*m", "Maximum torque of the motor, its breakdown torque",
    "IEC 60034-12")
tensions.vbelt_pull = (np.maximum(m.vbelt.service_factor * m.motor_power / m.vbelt_speed, 2 * m.vbelt_peak_torque / m.vbelt.driver_diameter), "F_u",
    "N", "Maximum effective pull, all belts together", "mechanics")
tensions.tight_tension = (m.vbelt_pull * m.tension_ratio / (m.tension_ratio - 1), "F_1", "N",
    "Tight-side tension, without the centrifugal component", "Euler")
tensions.slack_tension = m.vbelt_pull / (m.tension_ratio - 1), "F_2", "N", "Slack-side tension, without the centrifugal component", "Euler"
tensions.vbelt_mass = lookup(MASSES, by="vbelt.section", output=False), "q", "kg/m", "Mass of one belt from its length", "ISO 4184"
for known in (("power_per_belt",), (COUNT,)):
    lacks = (COUNT,) if known == ("power_per_belt",) else ()
    tensions.vbelt_tension_needed = (value(m.vbelt_pull * (m.tension_ratio + 1) / (2 * m.vbelt_count * (m.tension_ratio - 1)) + m.vbelt_mass
        * m.vbelt_speed**2, needs=known, lacks=lacks), "F_T,req", "N", "Required static tension of one belt", "GB/T 13575.1")
    tensions.vbelt_tension = (value(m.vbelt_tension_needed, needs=known, lacks=(*lacks, "vbelt.tension")), "F_T", "N",
        "Static tension of one belt: the required one", "this method")
    tensions.vbelt_tension = (value(m.vbelt.tension, needs=(*known, "vbelt.tension"), lacks=lacks), "F_T", "N",
        "Static tension of one belt: as given", "input")
    tensions.vbelt_slip_pull = (value(2 * m.vbelt_count * (m.vbelt_tension - m.vbelt_mass * m.vbelt_speed**2) * (m.tension_ratio - 1)
        / (m.tension_ratio + 1), needs=(*known, "vbelt.tension"), lacks=lacks), "F_slip", "N", "Effective pull at which the belts begin to slip",
        "Euler")
    tensions.shaft_load = (value(2 * m.vbelt_count * m.vbelt_tension * np.sin(m.vbelt_wrap / 2), needs=known, lacks=lacks), "F_s", "N",
        "Static load of the belts on the shafts of motor and flywheel", "statics")
tensions.shaft_load = (value((m.tight_tension + m.slack_tension) * np.sin(m.vbelt_wrap / 2), **WITHOUT_COUNT), "F_s", "N",
    "Static load of the belts on the shafts, without the centrifugal component if the number of belts is not known", "statics")
tensions.vbelt_bendings = 2 * m.vbelt_speed / m.vbelt_standard_length, "f_B", "1/s", "Belt bending frequency", "kinematics"
