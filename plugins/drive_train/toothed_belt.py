"""The toothed belt that rolls the cylinder: its speed, the driving pulley, its length over any layout of pulleys (002 eq. 7–11)."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from diecut_report.api import (
    Annotated,
    Block,
    ByText,
    Clash,
    Erratum,
    Lookup,
    Neighbour,
    Quantity,
    Require,
    Section,
    Text,
    Total,
    Value,
    bind,
    formula,
)
from diecut_report.mechanics import belt_path, common
from diecut_report.plugins.drive_train.belt_pulleys import LISTED, LISTED_CHECKS, MARKS, PULLEYS
from diecut_report.plugins.drive_train.toothed_belt_figure import TOOTHED_BELT_FIGURES


class Pulley(Block):
    """A pulley of the toothed belt."""

    x: Annotated[float, Quantity("x", "mm", "Place of the pulley's axis along x")]
    y: Annotated[
        float, Quantity("y", "mm", "Place of the pulley's axis along y, upwards; the die lies below the cylinder")
    ]
    radius: Annotated[float, Quantity("r", "mm", "Radius to the belt's pitch line", gt=0)]
    side: Annotated[
        Literal["inside", "outside"],
        Text(
            "Whether the pulley lies inside the belt's loop or outside it, on the belt's back; the driving or the cylinder's pulley "
            "outside carries load there and needs a belt toothed on both sides"
        ),
    ]
    role: Annotated[
        Literal["cylinder", "other"],
        Text(
            "Whether this is the pulley fixed to the cylinder; marked, it is compared with driven_radius and engagement"
        ),
    ] = "other"


class ToothedBelt(Block):
    """The toothed belt between the main shaft and the cylinder in its carriage."""

    cylinder_radius: Annotated[float, Quantity("R", "mm", "Radius of the cylinder, which rolls on the die", gt=0)]
    driven_radius: Annotated[
        float, Quantity("r_d", "mm", "Pitch radius of the pulley that is fixed to the cylinder", gt=0)
    ]
    cylinder_velocity: Annotated[
        float,
        Quantity("V", "m/s", "Velocity of the carriage, normally cylinder_drive's velocity_max", gt=0),
    ]
    shaft_speed: Annotated[
        float,
        Quantity(
            "ω_p",
            "rpm",
            "Speed of the driving pulley's shaft, taken as given, not as the train's rounding makes it",
            gt=0,
        ),
    ]
    pitch: Annotated[float, Quantity("p", "mm", "Pitch of the belt's teeth", gt=0)]
    engagement: Annotated[
        Literal["away", "die"],
        Text(
            "Side of the cylinder's axis on which its pulley rolls on the belt: away from the die (the belt passes over the pulley, the die "
            "lying below), or the die's (it passes below)"
        ),
    ] = "away"
    pulleys: Annotated[
        list[Pulley],
        Text(
            "Pulleys in the order in which the belt meets them, counter-clockwise, the driving pulley first; with them the belt's length"
        ),
    ] = []  # noqa: RUF012


@formula
def speed_away(velocity: Any, driven_radius: Any, cylinder_radius: Any) -> Any:
    """Speed of the belt on the side away from the die."""
    return velocity * (1 + driven_radius / cylinder_radius)


@formula
def speed_at_die(velocity: Any, driven_radius: Any, cylinder_radius: Any) -> Any:
    """Speed of the belt on the die's side of the axis."""
    return velocity * (1 - driven_radius / cylinder_radius)


@formula
def pulley_radius(belt_speed: Any, shaft_speed: Any) -> Any:
    """Pitch radius of a pulley that gives a speed of the belt."""
    return belt_speed / shaft_speed


@formula
def pulley_teeth(radius: Any, pitch: Any) -> Any:
    """Whole number of teeth nearest to a pitch radius."""
    return np.round(2 * np.pi * radius / pitch)


@formula
def radius_of_teeth(teeth: Any, pitch: Any) -> Any:
    """Pitch radius of a whole number of teeth."""
    return teeth * pitch / (2 * np.pi)


@formula
def has_teeth(teeth: Any) -> Any:
    """Whether there is a tooth at all."""
    return teeth >= 1


@formula
def speed_error(teeth: Any, pitch: Any, shaft_speed: Any, belt_speed: Any) -> Any:
    """Error of the belt's speed with a whole number of teeth on the driving pulley."""
    return teeth * pitch * shaft_speed / (2 * np.pi * belt_speed) - 1


@formula
def belt_teeth(length: Any, pitch: Any) -> Any:
    """Whole number of teeth nearest to a length of belt."""
    return np.round(length / pitch)


@formula
def take_up(teeth: Any, pitch: Any, length: Any) -> Any:
    """What a belt is longer than its path."""
    return teeth * pitch - length


@formula
def teeth_in_mesh(radius: Any, wrap: Any, pitch: Any) -> Any:
    """Teeth along the wrap of a pulley."""
    return radius * wrap / pitch


@formula
def is_loop_elsewhere(turns: Any, wrap: Any, greatest: Any) -> Any:
    """Whether the belt turns once, or it is not this pulley, with the greatest wrap, that shows that it does not."""
    return (turns == 1) | (wrap < greatest)


def alone(x: Any) -> Any:
    """For a single pulley the index of itself, else -1 for each."""
    return np.zeros_like(x, dtype=int) if x.shape[1] == 1 else np.full(x.shape, -1)


PULLEY = PULLEYS + ".{index}"
ROLLING = {
    "velocity": "toothed_belt.cylinder_velocity",
    "driven_radius": "toothed_belt.driven_radius",
    "cylinder_radius": "toothed_belt.cylinder_radius",
}
PLACES = {"x": f"{PULLEYS}.x", "y": f"{PULLEYS}.y", "next_x": "next_pulley_x", "next_y": "next_pulley_y"}
RADII = {"radius": "signed_radius", "next_radius": "next_signed_radius"}
LAYOUT = (f"{PULLEYS}.x", f"{PULLEYS}.y", "signed_radius")

SPEED = Section(
    "Toothed belt: speed and driving pulley",
    needs=("toothed_belt",),
    absent="not calculated: toothed_belt is not given",
    text="The carriage moves at V while the pulley fixed to the rolling cylinder turns with it: the belt runs faster than the carriage by "
    "V·r_d/R on the side away from the die, slower by as much on the die's side.",
    steps=(
        Value(id="belt_speed", symbol="V_b", unit="m/s", description="Speed of the toothed belt", source="002 eq. 7–9",
              formula=ByText("toothed_belt.engagement", {"away": speed_away, "die": speed_at_die}, **ROLLING)),
        Require(id="belt_moves", condition=bind(common.is_below, smaller=0, greater="belt_speed"), key="toothed_belt.driven_radius",
                message="gives a belt speed of {belt_speed} with engagement: die; there the driven pulley must be smaller than the "
                "cylinder (or take engagement: away)"),
        Value(id="driving_pulley_radius", symbol="r_p", unit="mm", description="Pitch radius of the belt's driving pulley, before rounding",
              source="002 eq. 10", digits=6, formula=bind(pulley_radius, shaft_speed="toothed_belt.shaft_speed")),
        Value(id="driving_pulley_teeth", whole=True, symbol="z_p", description="Teeth of the belt's driving pulley, the nearest whole number",
              source="this method", formula=bind(pulley_teeth, radius="driving_pulley_radius", pitch="toothed_belt.pitch")),
        Value(id="driving_pulley_pitch_radius", symbol="r_pz", unit="mm", description="Pitch radius of the driving pulley with whole teeth",
              source="geometry", digits=6, formula=bind(radius_of_teeth, teeth="driving_pulley_teeth", pitch="toothed_belt.pitch")),
        Require(id="pulley_has_teeth", condition=bind(has_teeth, teeth="driving_pulley_teeth"), key="toothed_belt.pitch",
                message="is more than twice the circumference of the driving pulley, whose radius is {driving_pulley_radius}; "
                "take a smaller pitch or a slower shaft"),
        Value(id="driving_pulley_speed_error", symbol="ε_b", unit="%", source="this method",
              description="Error of the belt's speed from whole teeth, at the given shaft_speed",
              formula=bind(speed_error, teeth="driving_pulley_teeth", pitch="toothed_belt.pitch", shaft_speed="toothed_belt.shaft_speed")),
    ),
)  # fmt: skip

PATH = Section(
    "Toothed belt: path over the pulleys",
    needs=("toothed_belt", PULLEYS),
    absent=f"not calculated: {PULLEYS} is not given",
    text="The belt runs counter-clockwise over the pulleys in their order, inside ones on its left (σ = 1), outside ones on its right "
    "(σ = −1). Each pulley stands with the straight run behind it; a prime marks the next pulley. The 10⁻⁹ in the wrap keeps a rounding "
    "below zero from counting as a full turn.",
    steps=(
        Clash(id="two_pulleys", function=alone, takes=(f"{PULLEYS}.x",), key=PULLEYS,
              message="has one pulley; a belt needs at least two"),
        Lookup(id="pulley_side", symbol="σ", description="Side of the pulley: inside 1, outside −1", source="this method", output=False,
               by=f"{PULLEYS}.side", table={"inside": 1.0, "outside": -1.0}),
        *MARKS,
        Value(id="signed_radius", symbol="r_σ", unit="mm", description="Radius, negative outside", output=False, source="geometry",
              formula=bind(belt_path.signed, side="pulley_side", size=f"{PULLEYS}.radius")),
        Neighbour(id="next_pulley_x", symbol="x′", unit="mm", description="The next pulley's place along x", output=False, of=f"{PULLEYS}.x"),
        Neighbour(id="next_pulley_y", symbol="y′", unit="mm", description="The next pulley's place along y", output=False, of=f"{PULLEYS}.y"),
        Neighbour(id="next_signed_radius", symbol="r_σ′", unit="mm", description="The next pulley's radius, negative outside", output=False,
                  of="signed_radius"),
        Value(id="pulley_distance", symbol="d", unit="mm", description="Distance to the next pulley", output=False, source="geometry",
              formula=bind(belt_path.center_distance, **PLACES)),
        Require(id="tangents", condition=bind(belt_path.has_tangent, center_distance="pulley_distance", **RADII), key=PULLEY,
                message="pulleys {part} and {next} have no common tangent: their axes are only {pulley_distance} apart, so they touch "
                "or overlap, or one lies within the other; move them apart or make them smaller"),
        Clash(id="toothed_pulleys_apart", function=belt_path.overlapping, takes=LAYOUT, key=PULLEY,
              message="pulleys {part} and {other} overlap; move them apart or make them smaller"),
        Clash(id="pulleys_counter_clockwise", function=belt_path.clockwise, takes=LAYOUT, key=PULLEYS,
              message="pulleys {part} to {other} are listed clockwise, so the signed wraps do not sum to 360°; reverse their order, so "
              "that the belt meets them counter-clockwise"),
        Value(id="straight_runs", symbol="l", unit="mm", description="Straight run to the next pulley", source="geometry",
              formula=bind(belt_path.run_length, center_distance="pulley_distance", **RADII)),
        Value(id="run_direction", symbol="θ", unit="deg", description="Direction of the run", source="geometry", output=False,
              formula=bind(belt_path.run_direction, center_distance="pulley_distance", **PLACES, **RADII)),
        Neighbour(id="direction_before", symbol="θ_before", unit="deg", description="Direction of the run before the pulley", output=False,
                  of="run_direction", shift=-1),
        Value(id="wraps", symbol="α", unit="deg", description="Wrap of the pulley", source="geometry", numbered="wraps.{}", first=0,
              formula=bind(belt_path.wrap, side="pulley_side", direction="run_direction")),
        Value(id="signed_wraps", symbol="σα", unit="deg", description="Wrap, negative outside", source="geometry", output=False,
              formula=bind(belt_path.signed, side="pulley_side", size="wraps")),
        Total(id="signed_wraps_sum", symbol="α_Σ", unit="deg", description="Sum of the signed wraps: one turn", output=False,
              of="signed_wraps", operation="sum"),
        Value(id="belt_turns", symbol="n_b", description="Turns of the belt's direction along its path: 1 in a loop", output=False,
              source="geometry", formula=bind(belt_path.turns, sum_of_wraps="signed_wraps_sum")),
        Total(id="greatest_wrap", symbol="α_max", unit="deg", description="Greatest wrap", output=False, of="wraps", operation="max"),
        Require(id="one_turn", condition=bind(is_loop_elsewhere, turns="belt_turns", wrap="wraps", greatest="greatest_wrap"), key=PULLEY,
                message="the signed wraps (inside +, outside −) do not sum to 360°, one turn of the belt, but to {belt_turns} turns: it "
                "would have to run {wraps} around pulley {part}, which it does not touch. Move pulley {part} against the belt or leave it "
                "out, change its side, or list the pulleys in the order in which the belt meets them"),
        Clash(id="runs_apart", function=belt_path.crossing, takes=LAYOUT, key=PULLEY,
              message="the straight runs behind pulleys {part} and {other} cross; move a pulley, or list them in the order in which the "
              "belt meets them"),
        Clash(id="runs_clear", function=belt_path.pierced, takes=LAYOUT, key=PULLEY,
              message="the straight run behind pulley {other} passes through pulley {part}; move one of them, or give pulley {part} its "
              "place in the order in which the belt meets the pulleys"),
    ),
)  # fmt: skip

LENGTH = Section(
    "Toothed belt: length and teeth in mesh",
    needs=("toothed_belt", PULLEYS),
    absent=f"not calculated: {PULLEYS} is not given",
    steps=(
        Value(id="belt_arcs", symbol="s", unit="mm", description="Belt on the pulley", source="geometry", output=False,
              formula=bind(belt_path.arc, radius=f"{PULLEYS}.radius", wrap="wraps")),
        Total(id="straight_length", symbol="Σl", unit="mm", description="All straight runs", digits=6, of="straight_runs", operation="sum"),
        Total(id="arc_length", symbol="Σs", unit="mm", description="All arcs", digits=6, of="belt_arcs", operation="sum"),
        Value(id="toothed_belt_length", symbol="L_b", unit="mm", description="Length of the toothed belt's path", digits=7,
              source="002 eq. 11, in general", formula=bind(common.sum_of, first="straight_length", second="arc_length")),
        Value(id="toothed_belt_teeth", whole=True, symbol="z_b", description="Teeth of the belt, the nearest whole number", source="this method",
              formula=bind(belt_teeth, length="toothed_belt_length", pitch="toothed_belt.pitch")),
        Value(id="toothed_belt_take_up", symbol="ΔL", unit="mm", description="Belt longer (+) or shorter (−) than the path: to be tensioned",
              source="this method",
              formula=bind(take_up, teeth="toothed_belt_teeth", pitch="toothed_belt.pitch", length="toothed_belt_length")),
        Value(id="teeth_in_mesh", symbol="z_m", description="Teeth along the wrap", source="this method",
              formula=bind(teeth_in_mesh, radius=f"{PULLEYS}.radius", wrap="wraps", pitch="toothed_belt.pitch")),
        Total(id="teeth_in_mesh_min", symbol="z_m,min", description="Least teeth in mesh of the toothed pulleys", of="teeth_in_mesh",
              operation="min", among="has_teeth"),
    ),
)  # fmt: skip

TOOTHED_BELT = (SPEED, PATH, LENGTH, LISTED)

TOOTHED_BELT_CHECKS = LISTED_CHECKS

TOOTHED_BELT_ASSUMPTIONS = (
    "The toothed belt neither stretches nor sags, all pulleys lie in one plane, and radii are to its pitch line, also at pulleys that the "
    "belt's back runs over. Outside pulleys are smooth, but for the cylinder's.",
    "A loaded pulley outside the loop, the driving or the cylinder's, needs a belt that is toothed on both sides.",
)

TOOTHED_BELT_ERRATA = (
    Erratum(
        "002",
        "Eq. 11 adds arcs and straight runs of one fixed layout, and its symbols cannot be read in the copy; here the path over any pulleys "
        "is solved by common tangents.",
        ("toothed_belt_length",),
    ),
)

__all__ = ["TOOTHED_BELT", "TOOTHED_BELT_ASSUMPTIONS", "TOOTHED_BELT_CHECKS", "TOOTHED_BELT_ERRATA", "TOOTHED_BELT_FIGURES", "Pulley",
           "ToothedBelt"]  # fmt: skip
