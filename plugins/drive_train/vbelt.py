"""Chapters on the V-belt, and formulas that belts share."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    Chapter,
    Vary,
    as_number,
    bind,
    formula,
    pi,
    standard_series,
    standard_series_by,
    standard_table,
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
vbelt.lookup("least_driver_diameter", "d_min", "mm", "Minimum datum diameter of the section's pulleys", standard_table("vbelt_least_diameter"),
    by="vbelt.section", source="ISO 4183", output=False)
vbelt.value("vbelt_speed", "v", "m/s", "Speed of the belt", bind(rim_speed, speed="shaft_1_speed", diameter="vbelt.driver_diameter"),
    source="kinematics")
vbelt.value("small_radius", "r_1", "mm", "Radius of the smaller pulley",
    bind(lambda driver_diameter, driven_diameter: np.minimum(driver_diameter, driven_diameter) / 2, driver_diameter="vbelt.driver_diameter"),
    output=False)
vbelt.value("large_radius", "r_2", "mm", "Radius of the larger pulley",
    bind(lambda driver_diameter, driven_diameter: np.maximum(driver_diameter, driven_diameter) / 2, driver_diameter="vbelt.driver_diameter"),
    output=False)
vbelt.value("least_center_distance", "a_min", "mm", "Centre distance at which the pulleys touch",
    lambda small_radius, large_radius: small_radius + large_radius, output=False)
vbelt.lookup("shortest_belt", "L_min", "mm", "Shortest standard belt of the section",
    {name: series.values[0] for name, series in LENGTHS.items()}, by="vbelt.section", source="ISO 4184", output=False)
vbelt.lookup("longest_belt", "L_max", "mm", "Longest standard belt of the section",
    {name: series.values[-1] for name, series in LENGTHS.items()}, by="vbelt.section", source="ISO 4184", output=False)
vbelt.require("ratio_leaves_room", bind(lambda ratio, largest, least, distance: (ratio <= largest) | (least < distance),
    least="least_center_distance", **RATIO), key="gears", message=RATIO_TOO_GREAT,
    advise=("gears.driven_teeth",))
vbelt.require("driver_large_enough",
    bind(lambda least_driver_diameter, driver_diameter: least_driver_diameter <= driver_diameter, driver_diameter="vbelt.driver_diameter"),
    key="vbelt.driver_diameter",
    message="is {vbelt.driver_diameter}, but a belt of section {vbelt.section} needs pulleys of {least_driver_diameter} or more: take a larger "
        "pulley or a smaller section", advise=(Vary("vbelt.driver_diameter", "up", PULLEYS),))
vbelt.require("pulleys_apart", bind(lambda ratio, largest, least, distance: (ratio > largest) | (least < distance),
    least="least_center_distance", **RATIO), key="vbelt.center_distance",
    message="is {vbelt.center_distance}, but pulleys of {vbelt.driver_diameter} and {driven_diameter} overlap up to {least_center_distance:up}",
    advise=DISTANCE)
vbelt.value("vbelt_length", "L_0", "mm", "Belt length at the wanted centre distance",
    bind(belt_path.open_belt_length, center_distance="vbelt.center_distance", **PAIR), source="geometry")
vbelt.require("ratio_leaves_belt",
    bind(lambda ratio, largest, shortest, length, longest: (ratio <= largest) | ((length >= shortest) & (length <= longest)),
    **RANGE), key="gears", message=RATIO_TOO_GREAT, advise=("gears.driven_teeth",))
vbelt.require("belt_exists", bind(lambda ratio, largest, shortest, length, longest: (ratio > largest) | ((length >= shortest) & (length <= longest)),
    **RANGE), key="vbelt.center_distance",
    message="is {vbelt.center_distance}; that takes a belt of {vbelt_length}, but section {vbelt.section} has standard lengths of {shortest_belt} … "
        "{longest_belt}", advise=DISTANCE)
vbelt.pick("vbelt_standard_length", "L", "mm", "Standard length of the belt", "nearest", of="vbelt_length", series=LENGTHS, source="ISO 4184",
    by="vbelt.section")
vbelt.value("least_belt", "L_t", "mm", "Belt length with the pulleys touching",
    bind(belt_path.open_belt_length, center_distance="least_center_distance", **PAIR), output=False)
vbelt.require("standard_belt_fits", lambda least_belt, vbelt_standard_length: least_belt < vbelt_standard_length, key="vbelt.center_distance",
    message="is {vbelt.center_distance}; the nearest standard belt, {vbelt_standard_length} long, draws the pulleys into each other "
        "({least_belt:up} is the least)", advise=DISTANCE)
vbelt.root("center_distance", "a", "mm", "Centre distance, corrected for the standard belt",
    bind(lambda center_distance, small, large, belt: belt_path.open_belt_length(center_distance, small, large) - belt,
        belt="vbelt_standard_length", **PAIR), low=lambda least_center_distance: least_center_distance,
    high=lambda vbelt_standard_length: vbelt_standard_length / 2, left=bind(belt_path.run_length, radius="small_radius", next_radius="large_radius"),
    right=bind(lambda center_distance, small, large, belt:
            (belt - pi * (large + small)) / 2 - (large - small) * np.arcsin((large - small) / center_distance),
        belt="vbelt_standard_length", **PAIR), source="geometry")
vbelt.value("vbelt_wrap", "β_1", "deg", "Wrap on the smaller pulley", bind(belt_path.wrap_small, **PAIR), source="geometry")
vbelt.value("vbelt_wrap_large", "β_2", "deg", "Wrap on the larger pulley", bind(belt_path.wrap_large, wrap_small="vbelt_wrap"), source="geometry",
    output=False)

REFERENCE_LENGTHS = {"SPZ": 1600, "SPA": 2500, "SPB": 3550, "SPC": 5600}  # mm
MASSES = {"SPZ": 0.07, "SPA": 0.12, "SPB": 0.20, "SPC": 0.37}  # kg/m
COUNT = "vbelt.count"
WITHOUT_COUNT: dict[str, Any] = {"lacks": ("power_per_belt", COUNT)}

count = Chapter("Number of belts",
    text="The manufacturer states the power of one belt for half a turn of wrap and the reference length. The belts must transmit the motor's rated "
        "power with the service factor.")
count.value("tension_ratio", "m", "1", "Ratio of tight-side to slack-side tension",
    bind(lambda groove_friction, wrap: np.exp(groove_friction * as_number(wrap)),
        groove_friction="vbelt.groove_friction", wrap="vbelt_wrap"), source="Euler")
count.value("wrap_factor", "c_1", "1", "Arc of contact factor", lambda vbelt_wrap: 1.25 * (1 - 5 ** (-vbelt_wrap / pi)), source="ISO 5292")
count.lookup("reference_length", "L_r", "mm", "Reference length of the section", REFERENCE_LENGTHS, by="vbelt.section", source="Optibelt",
    output=False)
count.value("length_factor", "c_3", "1", "Belt length factor",
    bind(length_factor, length="vbelt_standard_length", reference="reference_length"), source="Optibelt")
count.value("vbelt_power", "P_b", "kW", "Design power of the belts",
    bind(lambda service_factor, motor_power: service_factor * motor_power, service_factor="vbelt.service_factor"), source="Optibelt")
count.value("vbelt_share", "z_P", "1", "Design power in terms of that of one belt", lambda vbelt_power, power_per_belt, wrap_factor, length_factor:
        vbelt_power / (power_per_belt * wrap_factor * length_factor), source="Optibelt", output=False, needs=("power_per_belt",))
count.value("vbelt_count_needed", "z_req", "1", "Required number of belts", lambda vbelt_share: np.maximum(1, np.ceil(vbelt_share)), whole=True,
    source="Optibelt", needs=("power_per_belt",))
count.value("vbelt_count", "z", "1", "Number of belts: as given", bind(lambda given: given, given=COUNT), whole=True, source="input", needs=(COUNT,))
count.value("vbelt_count", "z", "1", "Number of belts: the smallest sufficient number", lambda vbelt_count_needed: vbelt_count_needed, whole=True,
    source="this method", needs=("power_per_belt",), lacks=(COUNT,))

PULL: dict[str, str | float] = {"count": "vbelt_count", "mass_per_length": "vbelt_mass", "speed": "vbelt_speed"}
tensions = Chapter("Belt pull and shaft load",
    text="The belts transmit the motor's breakdown torque when it runs up or is overloaded, and must not slip then. The required static tension "
        "follows from the friction in their grooves: the ratio of the tensions of both sides is that of Euler's formula, and their mean is the "
        "static tension less the centrifugal force. At rest the whole tension loads the shafts.")
tensions.value("vbelt_peak_torque", "M_1,max", "N*m", "Maximum torque of the motor, its breakdown torque",
    lambda breakdown_ratio, motor_rated_torque: breakdown_ratio * motor_rated_torque, source="IEC 60034-12")
tensions.value("vbelt_pull", "F_u", "N", "Maximum effective pull, all belts together",
    bind(lambda service_factor, power, speed, torque, diameter: np.maximum(service_factor * power / speed, 2 * torque / diameter),
        service_factor="vbelt.service_factor", power="motor_power", speed="vbelt_speed", torque="vbelt_peak_torque",
        diameter="vbelt.driver_diameter"), source="mechanics")
tensions.value("tight_tension", "F_1", "N", "Tight-side tension, without the centrifugal component",
    lambda vbelt_pull, tension_ratio: vbelt_pull * tension_ratio / (tension_ratio - 1), source="Euler")
tensions.value("slack_tension", "F_2", "N", "Slack-side tension, without the centrifugal component",
    lambda vbelt_pull, tension_ratio: vbelt_pull / (tension_ratio - 1), source="Euler")
tensions.lookup("vbelt_mass", "q", "kg/m", "Mass of one belt from its length", MASSES, by="vbelt.section", source="ISO 4184", output=False)
for known in (("power_per_belt",), (COUNT,)):
    lacks = (COUNT,) if known == ("power_per_belt",) else ()
    tensions.value("vbelt_tension_needed", "F_T,req", "N", "Required static tension of one belt",
        bind(lambda pull, tension_ratio, count, mass_per_length, speed:
                pull * (tension_ratio + 1) / (2 * count * (tension_ratio - 1)) + mass_per_length * speed**2,
            pull="vbelt_pull", **PULL), source="GB/T 13575.1", needs=known, lacks=lacks)
    tensions.value("vbelt_tension", "F_T", "N", "Static tension of one belt: the required one", lambda vbelt_tension_needed: vbelt_tension_needed,
        source="this method", needs=known, lacks=(*lacks, "vbelt.tension"))
    tensions.value("vbelt_tension", "F_T", "N", "Static tension of one belt: as given", bind(lambda given: given, given="vbelt.tension"),
        source="input", needs=(*known, "vbelt.tension"), lacks=lacks)
    tensions.value("vbelt_slip_pull", "F_slip", "N", "Effective pull at which the belts begin to slip",
        bind(lambda tension, tension_ratio, count, mass_per_length, speed:
                2 * count * (tension - mass_per_length * speed**2) * (tension_ratio - 1) / (tension_ratio + 1),
            tension="vbelt_tension", **PULL), source="Euler", needs=(*known, "vbelt.tension"), lacks=lacks)
    tensions.value("shaft_load", "F_s", "N", "Static load of the belts on the shafts of motor and flywheel",
        lambda vbelt_count, vbelt_tension, vbelt_wrap: 2 * vbelt_count * vbelt_tension * np.sin(vbelt_wrap / 2), source="statics", needs=known,
        lacks=lacks)
tensions.value("shaft_load", "F_s", "N",
    "Static load of the belts on the shafts, without the centrifugal component if the number of belts is not known",
    lambda tight_tension, slack_tension, vbelt_wrap: (tight_tension + slack_tension) * np.sin(vbelt_wrap / 2), source="statics", **WITHOUT_COUNT)
tensions.value("vbelt_bendings", "f_B", "1/s", "Belt bending frequency",
    lambda vbelt_speed, vbelt_standard_length: 2 * vbelt_speed / vbelt_standard_length, source="kinematics")
