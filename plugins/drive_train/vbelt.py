"""Chapters on the V-belt: its geometry with a standard length, its tensions and their load on the shafts."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, bind, standard_table
from diecut_report.mechanics import belt_path, triangle
from diecut_report.plugins.drive_train import advice, belts

# fmt: off

PULLEYS = {"small": "small_radius", "large": "large_radius"}
LARGEST: dict[str, str | float] = {"ratio": "vbelt_ratio", "largest": advice.LARGEST_RATIO}
RATIO: dict[str, str | float] = LARGEST | {"distance": "vbelt.center_distance"}
RANGE: dict[str, str | float] = LARGEST | {
    "shortest": "shortest_belt",
    "length": "vbelt_length",
    "longest": "longest_belt",
}
RATIO_TOO_GREAT = (
    f"leave the V-belt a ratio of {{vbelt_ratio}}, above the {advice.LARGEST_RATIO:g} that one V-belt covers: from motor_speed = "
    "{motor_speed} to output_speed = {inputs.output_speed} it is {total_ratio}, of which the gears have {gear_ratio_total}; {gears_advice}"
)
FOR_PULLEYS = ("vbelt_ratio", "vbelt.driver_diameter", "least_driver_diameter", "vbelt.center_distance", "shortest_belt", "longest_belt",
               "shaft_1_speed")

vbelt_chapter = Chapter("V-belt",
                        text="The belt's length follows exactly from its two runs and two arcs. The nearest standard length corrects the distance "
                             "of the shafts. Radii are those of the datum line.")
vbelt_chapter.lookup("least_driver_diameter", "d_min", "mm", "Least datum diameter of the section's pulleys", standard_table("vbelt_least_diameter"),
                     by="vbelt.section", source="ISO 4183", output=False)
vbelt_chapter.value("vbelt_speed", "v", "m/s", "Speed of the belt", bind(belts.rim_speed, speed="shaft_1_speed", diameter="vbelt.driver_diameter"),
                    source="kinematics")
vbelt_chapter.value("small_radius", "r_1", "mm", "Radius of the smaller pulley",
                    bind(lambda driver_diameter, driven_diameter: np.minimum(driver_diameter, driven_diameter) / 2,
                         driver_diameter="vbelt.driver_diameter"), output=False)
vbelt_chapter.value("large_radius", "r_2", "mm", "Radius of the larger pulley",
                    bind(lambda driver_diameter, driven_diameter: np.maximum(driver_diameter, driven_diameter) / 2,
                         driver_diameter="vbelt.driver_diameter"), output=False)
vbelt_chapter.value("least_center_distance", "a_min", "mm", "Distance at which the pulleys touch",
                    lambda small_radius, large_radius: small_radius + large_radius, output=False)
vbelt_chapter.lookup("shortest_belt", "L_min", "mm", "Shortest standard belt of the section",
                     {name: series.values[0] for name, series in advice.LENGTHS.items()}, by="vbelt.section", source="ISO 4184", output=False)
vbelt_chapter.lookup("longest_belt", "L_max", "mm", "Longest standard belt of the section",
                     {name: series.values[-1] for name, series in advice.LENGTHS.items()}, by="vbelt.section", source="ISO 4184", output=False)
vbelt_chapter.words("gears_advice", advice.gears_advice,
                    ("total_ratio", "vbelt.driver_diameter", "vbelt.center_distance", "shortest_belt", "longest_belt"), output=False)
vbelt_chapter.words("distance_advice", advice.distance_advice, ("small_radius", "large_radius", "shortest_belt", "longest_belt"), output=False)
vbelt_chapter.require("ratio_leaves_room", bind(belts.ratio_leaves_room, least="least_center_distance", **RATIO), key="gears",
                      message=RATIO_TOO_GREAT)
vbelt_chapter.require("driver_large_enough",
                      bind(lambda least_driver_diameter, driver_diameter: least_driver_diameter <= driver_diameter,
                           driver_diameter="vbelt.driver_diameter"), key="vbelt.driver_diameter",
                      message="is {vbelt.driver_diameter}, but a belt of section {vbelt.section} needs pulleys of {least_driver_diameter} or more: "
                              "take a larger pulley or a smaller section")
vbelt_chapter.require("pulleys_apart", bind(belts.has_room, least="least_center_distance", **RATIO), key="vbelt.center_distance",
                      message="is {vbelt.center_distance}, but pulleys of {vbelt.driver_diameter} and {driven_diameter} overlap up to "
                              "{least_center_distance:up}: {distance_advice}")
vbelt_chapter.value("vbelt_length", "L_0", "mm", "Length of the belt at the wanted distance of the shafts",
                    bind(belt_path.open_belt_length, center_distance="vbelt.center_distance", **PULLEYS), source="geometry")
vbelt_chapter.require("ratio_leaves_belt", bind(belts.ratio_leaves_belt, **RANGE), key="gears", message=RATIO_TOO_GREAT)
vbelt_chapter.require("belt_exists", bind(belts.has_belt, **RANGE), key="vbelt.center_distance",
                      message="is {vbelt.center_distance}; that takes a belt of {vbelt_length}, but section {vbelt.section} has standard lengths "
                              "of {shortest_belt} … {longest_belt}: {distance_advice}")
vbelt_chapter.pick("vbelt_standard_length", "L", "mm", "Standard length of the belt", "nearest", of="vbelt_length", series=advice.LENGTHS,
                   source="ISO 4184", by="vbelt.section")
vbelt_chapter.value("least_belt", "L_t", "mm", "Length of the belt with the pulleys touching",
                    bind(belt_path.open_belt_length, center_distance="least_center_distance", **PULLEYS), output=False)
vbelt_chapter.require("standard_belt_fits", lambda least_belt, vbelt_standard_length: least_belt < vbelt_standard_length, key="vbelt.center_distance",
                      message="is {vbelt.center_distance}; the nearest standard belt, {vbelt_standard_length} long, draws the pulleys into each "
                              "other ({least_belt:up} is the least): {distance_advice}")
vbelt_chapter.root("center_distance", "a", "mm", "Distance of the shafts, corrected for the standard belt",
                   bind(belts.length_left_over, belt="vbelt_standard_length", **PULLEYS), low=lambda least_center_distance: least_center_distance,
                   high=lambda vbelt_standard_length: vbelt_standard_length / 2,
                   left=bind(belt_path.run_length, radius="small_radius", next_radius="large_radius"),
                   right=bind(belts.run_left_by_arcs, belt="vbelt_standard_length", **PULLEYS), source="geometry")
vbelt_chapter.value("vbelt_wrap", "β_1", "deg", "Wrap on the smaller pulley", bind(belt_path.wrap_small, **PULLEYS), source="geometry")
vbelt_chapter.value("vbelt_wrap_large", "β_2", "deg", "Wrap on the larger pulley", bind(belt_path.wrap_large, wrap_small="vbelt_wrap"),
                    source="geometry", output=False)
vbelt_chapter.words("driver_advice", advice.driver_advice, FOR_PULLEYS, output=False)
vbelt_chapter.words("slower_belt_advice", advice.slower_belt_advice, FOR_PULLEYS, output=False)

count = Chapter("Number of belts", needs=("power_per_belt",), absent="not calculated: power_per_belt is not given")
count.value("vbelt_count", "z", "1", "Number of belts, for the required power",
            lambda power_required, power_per_belt: np.maximum(1, np.ceil(power_required / power_per_belt)), whole=True, source="this method")

tensions = Chapter("Pull of the belts and load on the shafts",
                   text="The belts pull with the required power. They are tensioned as the friction in their grooves asks for, so the tensions of "
                        "both sides are in the ratio of Euler's formula; the centrifugal force stretches the belts but does not load the shafts.")
tensions.value("vbelt_pull", "F_u", "N", "Effective pull, all belts together", lambda power_required, vbelt_speed: power_required / vbelt_speed,
               source="mechanics")
tensions.value("tension_ratio", "m", "1", "Tension of the tight side to that of the slack side",
               bind(belts.tension_ratio, groove_friction="vbelt.groove_friction", wrap="vbelt_wrap"), source="Euler")
tensions.value("tight_tension", "F_1", "N", "Tension of the tight side",
               lambda vbelt_pull, tension_ratio: vbelt_pull * tension_ratio / (tension_ratio - 1), source="Euler")
tensions.value("slack_tension", "F_2", "N", "Tension of the slack side", lambda vbelt_pull, tension_ratio: vbelt_pull / (tension_ratio - 1),
               source="Euler")
tensions.value("shaft_load", "F_s", "N", "Load of the belts on the shafts of motor and flywheel",
               bind(triangle.third_side, one_side="tight_tension", other_side="slack_tension", enclosed="vbelt_wrap"), source="statics")
