"""Chapters on the V-belt: its geometry with a standard length, its tensions and their load on the shafts."""

from __future__ import annotations

from diecut_report.api import Chapter, Lookup, Pick, Require, Root, Value, Words, bind, standard_table
from diecut_report.mechanics import belt_path, common, triangle
from diecut_report.plugins.drive_train import advice, belts

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
               "shaft_1_speed")  # fmt: skip

VBELT = Chapter(
    "V-belt",
    text="The belt's length follows exactly from its two runs and two arcs. The nearest standard length corrects the distance of the "
    "shafts. Radii are those of the datum line.",
    steps=(
        Lookup(id="least_driver_diameter", symbol="d_min", unit="mm", description="Least datum diameter of the section's pulleys",
               source="ISO 4183", output=False, by="vbelt.section", table=standard_table("vbelt_least_diameter")),
        Value(id="vbelt_speed", symbol="v", unit="m/s", description="Speed of the belt", source="kinematics",
              formula=bind(belts.rim_speed, speed="shaft_1_speed", diameter="vbelt.driver_diameter")),
        Value(id="small_radius", symbol="r_1", unit="mm", description="Radius of the smaller pulley", output=False,
              formula=bind(belts.smaller_radius, driver_diameter="vbelt.driver_diameter")),
        Value(id="large_radius", symbol="r_2", unit="mm", description="Radius of the larger pulley", output=False,
              formula=bind(belts.larger_radius, driver_diameter="vbelt.driver_diameter")),
        Value(id="least_center_distance", symbol="a_min", unit="mm", description="Distance at which the pulleys touch", output=False,
              formula=bind(common.sum_of, first="small_radius", second="large_radius")),
        Lookup(id="shortest_belt", symbol="L_min", unit="mm", description="Shortest standard belt of the section", source="ISO 4184",
               output=False, by="vbelt.section", table={name: series.values[0] for name, series in advice.LENGTHS.items()}),
        Lookup(id="longest_belt", symbol="L_max", unit="mm", description="Longest standard belt of the section", source="ISO 4184",
               output=False, by="vbelt.section", table={name: series.values[-1] for name, series in advice.LENGTHS.items()}),
        Words(id="gears_advice", description="Which ratio the gears need", function=advice.gears_advice, output=False,
              takes=("total_ratio", "vbelt.driver_diameter", "vbelt.center_distance", "shortest_belt", "longest_belt")),
        Words(id="distance_advice", description="Which distances of the shafts suit the pulleys", function=advice.distance_advice,
              output=False, takes=("small_radius", "large_radius", "shortest_belt", "longest_belt")),
        Require(id="ratio_leaves_room", condition=bind(belts.ratio_leaves_room, least="least_center_distance", **RATIO), key="gears",
                message=RATIO_TOO_GREAT),
        Require(id="driver_large_enough",
                condition=bind(common.is_at_most, smaller="least_driver_diameter", greater="vbelt.driver_diameter"),
                key="vbelt.driver_diameter",
                message="is {vbelt.driver_diameter}, but a belt of section {vbelt.section} needs pulleys of {least_driver_diameter} or more: "
                "take a larger pulley or a smaller section"),
        Require(id="pulleys_apart", condition=bind(belts.has_room, least="least_center_distance", **RATIO), key="vbelt.center_distance",
                message="is {vbelt.center_distance}, but pulleys of {vbelt.driver_diameter} and {driven_diameter} overlap up to "
                "{least_center_distance:up}: {distance_advice}"),
        Value(id="vbelt_length", symbol="L_0", unit="mm", description="Length of the belt at the wanted distance of the shafts",
              source="geometry", formula=bind(belt_path.open_belt_length, center_distance="vbelt.center_distance", **PULLEYS)),
        Require(id="ratio_leaves_belt", condition=bind(belts.ratio_leaves_belt, **RANGE), key="gears", message=RATIO_TOO_GREAT),
        Require(id="belt_exists", condition=bind(belts.has_belt, **RANGE), key="vbelt.center_distance",
                message="is {vbelt.center_distance}; that takes a belt of {vbelt_length}, but section {vbelt.section} has standard lengths of "
                "{shortest_belt} … {longest_belt}: {distance_advice}"),
        Pick(id="vbelt_standard_length", symbol="L", unit="mm", description="Standard length of the belt", source="ISO 4184",
             of="vbelt_length", series=advice.LENGTHS, by="vbelt.section", rule="nearest"),
        Value(id="least_belt", symbol="L_t", unit="mm", description="Length of the belt with the pulleys touching", output=False,
              formula=bind(belt_path.open_belt_length, center_distance="least_center_distance", **PULLEYS)),
        Require(id="standard_belt_fits", condition=bind(common.is_below, smaller="least_belt", greater="vbelt_standard_length"),
                key="vbelt.center_distance",
                message="is {vbelt.center_distance}; the nearest standard belt, {vbelt_standard_length} long, draws the pulleys into each "
                "other ({least_belt:up} is the least): {distance_advice}"),
        Root(id="center_distance", symbol="a", unit="mm", description="Distance of the shafts, corrected for the standard belt",
             source="geometry", equation=bind(belts.length_left_over, belt="vbelt_standard_length", **PULLEYS),
             unknown="center_distance", low=bind(common.same, quantity="least_center_distance"),
             high=bind(common.half, quantity="vbelt_standard_length"),
             left=bind(belt_path.run_length, radius="small_radius", next_radius="large_radius"),
             right=bind(belts.run_left_by_arcs, belt="vbelt_standard_length", **PULLEYS)),
        Value(id="vbelt_wrap", symbol="β_1", unit="deg", description="Wrap on the smaller pulley", source="geometry",
              formula=bind(belt_path.wrap_small, **PULLEYS)),
        Value(id="vbelt_wrap_large", symbol="β_2", unit="deg", description="Wrap on the larger pulley", source="geometry", output=False,
              formula=bind(belt_path.wrap_large, wrap_small="vbelt_wrap")),
        Words(id="driver_advice", description="How the motor's pulley would meet the demanded speed", function=advice.driver_advice,
              output=False, takes=FOR_PULLEYS),
        Words(id="slower_belt_advice", description="How the motor's pulley would make the belt slower", function=advice.slower_belt_advice,
              output=False, takes=FOR_PULLEYS),
    ),
)  # fmt: skip

COUNT = Chapter(
    "Number of belts",
    needs=("power_per_belt",),
    absent="not calculated: power_per_belt is not given",
    steps=(
        Value(id="vbelt_count", whole=True, symbol="z", description="Number of belts, for the required power", source="this method",
              formula=bind(belts.count, power="power_required")),
    ),
)  # fmt: skip

TENSIONS = Chapter(
    "Pull of the belts and load on the shafts",
    text="The belts pull with the required power. They are tensioned as the friction in their grooves asks for, so the tensions of both "
    "sides are in the ratio of Euler's formula; the centrifugal force stretches the belts but does not load the shafts.",
    steps=(
        Value(id="vbelt_pull", symbol="F_u", unit="N", description="Effective pull, all belts together", source="mechanics",
              formula=bind(common.quotient, quantity="power_required", by="vbelt_speed")),
        Value(id="tension_ratio", symbol="m", description="Tension of the tight side to that of the slack side", source="Euler",
              formula=bind(belts.tension_ratio, groove_friction="vbelt.groove_friction", wrap="vbelt_wrap")),
        Value(id="tight_tension", symbol="F_1", unit="N", description="Tension of the tight side", source="Euler",
              formula=bind(belts.tight, pull="vbelt_pull")),
        Value(id="slack_tension", symbol="F_2", unit="N", description="Tension of the slack side", source="Euler",
              formula=bind(belts.slack, pull="vbelt_pull")),
        Value(id="shaft_load", symbol="F_s", unit="N", description="Load of the belts on the shafts of motor and flywheel",
              source="statics", formula=bind(triangle.third_side, one_side="tight_tension", other_side="slack_tension", enclosed="vbelt_wrap")),
    ),
)  # fmt: skip
