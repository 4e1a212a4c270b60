"""The toothed belt that rolls the cylinder: its speed, the driving pulley, its length over any layout of pulleys (002 eq. 7–11)."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    Block,
    ByText,
    Chapter,
    Check,
    Erratum,
    Quantity,
    Steps,
    Text,
    Vary,
    arccos,
    as_number,
    computed,
    formula,
    inner,
    lookup,
    m,
    neighbour,
    part,
    parts,
    pi,
    total,
    value,
)
from diecut_report.mechanics import belt_path
from diecut_report.plugins.drive_train.figures import TOOTHED_BELT_FIGURES

# fmt: off

PULLEYS = "toothed_belt.pulleys"
PITCH = "toothed_belt.pitch"
NOT_WHOLE = 0.01  # of a tooth
FEWEST_IN_MESH = 6.0


@formula
def whole_radius(radius: Any, pitch: Any) -> Any:
    """Pitch radius of the nearest whole number of teeth, one at least."""
    return np.maximum(1, np.round(as_number(2 * pi) * radius / pitch)) * pitch / (2 * pi)


@formula
def teeth_apart(radius: Any, other: Any, pitch: Any) -> Any:
    """How far two pitch radii are apart, in teeth."""
    return as_number(2 * pi) * abs(radius - other) / pitch


def next_marked(is_cylinder: Any) -> Any:
    """For the first of several marked pulleys the index of the second, else -1."""
    found = np.full(is_cylinder.shape, -1)
    for row, marked in zip(found, is_cylinder > 0, strict=True):
        first, second, *_ = [*np.flatnonzero(marked), -1, -1]
        if second >= 0:
            row[first] = second
    return found


OFF = ("pulley_teeth_off", "has_teeth")
FARTHEST = "of the toothed pulley that is farthest from a whole number of teeth"
UNPRINTED: Any = {"printed": False, "digits": 6, "output": False}  # for messages alone


def of_farthest(values: Any, off: Any, teeth: Any) -> Any:
    """Of each machine the value of the toothed pulley that is farthest from whole teeth."""
    farthest = np.argmax(np.where(teeth > 0, off, -1.0), axis=1)[:, None]
    return np.take_along_axis(np.broadcast_to(values, off.shape), farthest, axis=1)


def any_marked(is_cylinder: Any) -> Any:
    """Of each machine 1 where one of its pulleys is marked, else -1."""
    return is_cylinder.max(axis=1, keepdims=True)


IS_MARKED = m.cylinder_pulley_there > 0

listed = Chapter("Toothed belt: pulleys in the list",
    text="The first pulley of the list is the driving one; one may be fixed to the cylinder (κ = 1, otherwise −1). All pulleys inside the loop and "
        "the cylinder's pulley are toothed (τ = 1); any other outside pulley runs on the back of the belt and is smooth. The y axis points up, and "
        "the die lies below the cylinder: the belt passes over the cylinder's pulley where this engages away from the die, and below it where it "
        "engages on the die side.", needs=("toothed_belt", PULLEYS), absent=f"not calculated: {PULLEYS} is not given")
listed.pulley_teeth = (inner(as_number(2 * pi) * m[f"{PULLEYS}.radius"] / m[PITCH], digits=6), "n_z", "1", "Number of teeth of the circumference",
    "geometry")
listed.pulley_whole_radius = (inner(whole_radius.of(radius=m[f"{PULLEYS}.radius"], pitch=m[PITCH]), digits=6), "r_z", "mm",
    "Pitch radius of the nearest whole number of teeth", "geometry")
listed.pulley_teeth_off = (inner(teeth_apart.of(radius=m[f"{PULLEYS}.radius"], other=m.pulley_whole_radius, pitch=m[PITCH])), "Δz", "1",
    "Difference in teeth", "this method")
listed.clash("one_cylinder_pulley", next_marked, ("is_cylinder_pulley",), key=f"{PULLEYS}",
    message="pulleys {part} and {other} both have role: cylinder, but one is fixed to the cylinder; give the others role: other")
listed.pulley_teeth_off_max = (total("max", of="pulley_teeth_off", among="has_teeth", output=False), "Δz_max", "1",
    "Maximum difference of the toothed pulleys", "this method")
listed.farthest_radius = computed(of_farthest, (f"{PULLEYS}.radius", *OFF), FARTHEST, **UNPRINTED), "r_f", "mm", "Radius of the worst toothed pulley"
listed.farthest_teeth = (computed(of_farthest, ("pulley_teeth", *OFF), FARTHEST, **UNPRINTED), "n_f", "1",
    "Number of teeth of the worst toothed pulley")
listed.farthest_whole_radius = (computed(of_farthest, ("pulley_whole_radius", *OFF), FARTHEST, **UNPRINTED), "r_zf", "mm",
    "Radius of the worst toothed pulley with whole teeth")
listed.first_radius = part(of=f"{PULLEYS}.radius", index=0, digits=6, output=False), "r_1st", "mm", "Radius of the first pulley, which drives"
listed.driving_teeth_off = (inner(teeth_apart.of(radius=m.first_radius, other=m.driving_pulley_pitch_radius, pitch=m[PITCH])), "Δz_p", "1",
    "Difference of the first pulley from the driving one, in teeth", "this method")
listed.driven_whole_radius = (inner(whole_radius.of(radius=m.toothed_belt.driven_radius, pitch=m[PITCH]), digits=6), "r_dz", "mm",
    "Radius r_d with the nearest whole number of teeth", "geometry")
listed.cylinder_pulley_there = (computed(any_marked, ("is_cylinder_pulley",), "maximum mark of its pulleys", printed=False, output=False), "κ_max",
    "1", "Cylinder's pulley in the list: 1, otherwise −1")
listed.cylinder_pulley_radius = (total("sum", of=f"{PULLEYS}.radius", among="is_cylinder_pulley", digits=6, output=False), "r_c", "mm",
    "Radius of the cylinder's pulley in the list")
listed.cylinder_teeth_off = (inner(teeth_apart.of(radius=m.cylinder_pulley_radius, other=m.toothed_belt.driven_radius, pitch=m[PITCH]),
    exists=IS_MARKED), "Δz_d", "1", "Its difference from r_d, in teeth", "this method")
listed.cylinder_pulley_side = total("sum", of="pulley_side", among="is_cylinder_pulley", output=False), "σ_c", "1", "Side of the cylinder's pulley"
listed.cylinder_direction_before = (total("sum", of="direction_before", among="is_cylinder_pulley", output=False), "θ_c", "deg",
    "Direction of the span before it")
listed.cylinder_wrap = total("sum", of="wraps", among="is_cylinder_pulley", output=False), "α_c", "deg", "Its wrap"
listed.cylinder_wrap_height = (inner(-m.cylinder_pulley_side * np.cos(m.cylinder_direction_before + m.cylinder_pulley_side * m.cylinder_wrap / 2),
    exists=IS_MARKED), "h_c", "1", "Height of the middle of its wrap above the axis, relative to the radius", "geometry")
listed.engagement_angle = (inner(ByText("toothed_belt.engagement", {"away": arccos(m.cylinder_wrap_height),
    "die": arccos(-m.cylinder_wrap_height)}), exists=IS_MARKED), "γ", "deg",
    "Angle of the middle of the wrap from the side of engagement", "geometry")
MARKS = Steps()
MARKS.is_cylinder_pulley = (lookup({"cylinder": 1.0, "other": -1.0}, by=f"{PULLEYS}.role", output=False), "κ", "1",
    "Cylinder's pulley: 1, other pulleys: −1", "this method")
MARKS.has_teeth = inner(np.maximum(m.pulley_side, m.is_cylinder_pulley)), "τ", "1", "Pulley with teeth: 1, smooth: −1", "this method"

LISTED_CHECKS = (
    Check("teeth_in_mesh", "practice", "Teeth in mesh", FEWEST_IN_MESH, m.teeth_in_mesh_min, demand_label="required",
          limit_label="minimum of toothed pulleys", source="practice",
          consequence="the belt's teeth shear or jump; a larger pulley or an idler outside that adds wrap helps.", advise=(Vary(PITCH, "down"),)),
    Check("belt_engagement", "function", "Side of the cylinder's pulley", m.engagement_angle, 90.0, operator="<",
          demand_label="belt off the engaged side", limit_label="allowed",
          consequence="the pulleys lead the belt round the other side of the cylinder's pulley, so it runs at another speed than is "
          "calculated; change toothed_belt.engagement, or the places and sides of the pulleys (the die lies below, where y is less)."),
    Check("driving_pulley_listed", "function", "Driving pulley in the list", m.driving_teeth_off, NOT_WHOLE, demand_label="difference in teeth",
          consequence="the belt's length is that of another driving pulley than the one calculated; give the first of "
          "toothed_belt.pulleys a radius of {driving_pulley_pitch_radius}, {driving_pulley_teeth} teeth."),
    Check("pulley_teeth_whole", "function", "Whole teeth of the pulleys", m.pulley_teeth_off_max, NOT_WHOLE,
          demand_label="deviation from whole number",
          consequence="the pulley of radius {farthest_radius} in toothed_belt.pulleys would have {farthest_teeth} teeth; give it a radius of "
          "{farthest_whole_radius}."),
    Check("cylinder_pulley_listed", "function", "The cylinder's pulley in the list", m.cylinder_teeth_off, NOT_WHOLE,
          demand_label="difference in teeth",
          consequence="toothed_belt.driven_radius and the radius of the pulley with role: cylinder, {cylinder_pulley_radius}, are of one "
          "pulley; give both {driven_whole_radius}."),
)


class Pulley(Block):
    """A pulley of the toothed belt."""

    x = Quantity("x", "mm", "Position of the pulley's axis along x")
    y = Quantity("y", "mm", "Position of the pulley's axis along y, upwards; the die lies below the cylinder")
    radius = Quantity("r", "mm", "Radius to the belt's pitch line", gt=0)
    side = Text(
        "Side of the belt loop on which the pulley lies; outside means on the back of the belt: there the driving pulley or the cylinder's "
        "pulley needs a double-sided toothed belt",
        ("inside", "outside"))
    role = Text("Role of the pulley: marked as cylinder it is fixed to the cylinder, and compared with driven_radius and engagement",
        ("cylinder", "other"), default="other")


class ToothedBelt(Block):
    """The toothed belt between the main shaft and the cylinder in its carriage."""

    cylinder_radius = Quantity("R", "mm", "Radius of the cylinder, which rolls on the die", gt=0)
    driven_radius = Quantity("r_d", "mm", "Pitch radius of the pulley fixed to the cylinder", gt=0)
    cylinder_velocity = Quantity("V", "m/s", "Velocity of the carriage, normally cylinder_drive's velocity_max", gt=0)
    shaft_speed = Quantity("ω_p", "rpm", "Speed of the driving pulley's shaft, used as given, without the rounding of the train", gt=0)
    pitch = Quantity("p", "mm", "Pitch of the toothed belt", gt=0)
    engagement = Text(
        "Side of the cylinder's axis on which its pulley rolls on the belt: away from the die (the belt passes over the pulley, the "
        "die lying below), or the die's (it passes below)",
        ("away", "die"), default="away")
    pulleys = parts(Pulley,
        "Pulleys in the order in which the belt meets them, counter-clockwise, the driving pulley first; required for the length of the belt",
        optional=True)


def alone(x: Any) -> Any:
    """For a single pulley the index of itself, else -1 for each."""
    return np.zeros_like(x, dtype=int) if x.shape[1] == 1 else np.full(x.shape, -1)


PULLEY = PULLEYS + ".{index}"
PLACES = {"x": f"{PULLEYS}.x", "y": f"{PULLEYS}.y", "next_x": "next_pulley_x", "next_y": "next_pulley_y"}
RADII = {"radius": "signed_radius", "next_radius": "next_signed_radius"}
LAYOUT = (f"{PULLEYS}.x", f"{PULLEYS}.y", "signed_radius")

speed = Chapter("Toothed belt: speed and driving pulley",
    text="The carriage moves at V while the pulley fixed to the rolling cylinder turns with it: the belt is faster than the carriage by V·r_d/R on "
        "the side away from the die, and slower by as much on the die side.", needs=("toothed_belt",),
    absent="not calculated: toothed_belt is not given")
RADIUS_RATIO = m.toothed_belt.driven_radius / m.toothed_belt.cylinder_radius
speed.belt_speed = (ByText("toothed_belt.engagement", {"away": m.toothed_belt.cylinder_velocity * (1 + RADIUS_RATIO),
    "die": m.toothed_belt.cylinder_velocity * (1 - RADIUS_RATIO)}), "V_b", "m/s", "Speed of the toothed belt", "002 eq. 7–9")
speed.require("belt_moves", m.belt_speed > 0, key="toothed_belt.driven_radius",
    message="gives a belt speed of {belt_speed} with engagement: die; there the driven pulley must be smaller than the cylinder (or take "
    "engagement: away)")
speed.driving_pulley_radius = (value(m.belt_speed / m.toothed_belt.shaft_speed, digits=6), "r_p", "mm",
    "Pitch radius of the belt's driving pulley, before rounding", "002 eq. 10")
speed.driving_pulley_teeth = (value(np.round(as_number(2 * pi) * m.driving_pulley_radius / m.toothed_belt.pitch), whole=True), "z_p", "1",
    "Teeth of the belt's driving pulley, the nearest whole number", "this method")
speed.driving_pulley_pitch_radius = (value(m.driving_pulley_teeth * m.toothed_belt.pitch / (2 * pi), digits=6), "r_pz", "mm",
    "Pitch radius of the driving pulley with whole teeth", "geometry")
speed.require("pulley_has_teeth", m.driving_pulley_teeth >= 1, key="toothed_belt.pitch",
    message="is more than twice the circumference of the driving pulley, whose radius is {driving_pulley_radius}; take a smaller pitch or a slower "
    "shaft")
speed.driving_pulley_speed_error = (m.driving_pulley_teeth * m.toothed_belt.pitch * m.toothed_belt.shaft_speed / (2 * pi * m.belt_speed) - 1, "ε_b",
    "%", "Error of the belt speed due to whole teeth, at the given shaft_speed", "this method")

path = Chapter("Toothed belt: path over the pulleys",
    text="The belt runs counter-clockwise over the pulleys in their order, with inside ones on its left (σ = 1) and outside ones on its right (σ = "
        "−1). Each pulley is listed with the span behind it; a prime marks the next pulley. The 10⁻⁹ in the wrap prevents a rounding error below "
        "zero from counting as a full turn.", needs=("toothed_belt", PULLEYS), absent=f"not calculated: {PULLEYS} is not given")
path.clash("two_pulleys", alone, (f"{PULLEYS}.x",), key=PULLEYS, message="has one pulley; a belt needs at least two")
path.pulley_side = (lookup({"inside": 1.0, "outside": -1.0}, by=f"{PULLEYS}.side", output=False), "σ", "1",
    "Side of the pulley: inside 1, outside −1", "this method")
path.add(MARKS)
path.signed_radius = (inner(belt_path.signed.of(side=m.pulley_side, size=m[f"{PULLEYS}.radius"]), digits=6), "r_σ", "mm", "Radius, negative outside",
    "geometry")
path.next_pulley_x = neighbour(of=f"{PULLEYS}.x", digits=6, output=False), "x′", "mm", "Position of the next pulley along x"
path.next_pulley_y = neighbour(of=f"{PULLEYS}.y", digits=6, output=False), "y′", "mm", "Position of the next pulley along y"
path.next_signed_radius = neighbour(of="signed_radius", digits=6, output=False), "r_σ′", "mm", "The next pulley's radius, negative outside"
path.pulley_distance = (inner(belt_path.center_distance.of(x=m.toothed_belt.pulleys.x, y=m.toothed_belt.pulleys.y, next_x=m.next_pulley_x,
    next_y=m.next_pulley_y), digits=6), "d", "mm", "Distance to the next pulley", "geometry")
path.require("tangents", belt_path.has_tangent.of(center_distance=m.pulley_distance, radius=m.signed_radius, next_radius=m.next_signed_radius),
    key=PULLEY,
    message="pulleys {part} and {next} have no common tangent: their axes are only {pulley_distance} apart, so they touch or overlap, or one lies "
    "within the other; move them apart or make them smaller")
path.clash("toothed_pulleys_apart", belt_path.overlapping, LAYOUT, key=PULLEY,
    message="pulleys {part} and {other} overlap; move them apart or make them smaller")
path.clash("pulleys_counter_clockwise", belt_path.clockwise, LAYOUT, key=PULLEYS,
    message="pulleys {part} to {other} are listed clockwise, so the signed wraps do not sum to 360°; reverse their order, so that the belt meets "
        "them counter-clockwise")
path.straight_runs = (value(belt_path.run_length.of(center_distance=m.pulley_distance, radius=m.signed_radius, next_radius=m.next_signed_radius),
    digits=6), "l", "mm", "Span to the next pulley", "geometry")
path.run_direction = (inner(belt_path.run_direction.of(center_distance=m.pulley_distance, x=m.toothed_belt.pulleys.x, y=m.toothed_belt.pulleys.y,
    next_x=m.next_pulley_x, next_y=m.next_pulley_y, radius=m.signed_radius, next_radius=m.next_signed_radius)), "θ", "deg", "Direction of the span",
    "geometry")
path.direction_before = neighbour(of="run_direction", shift=-1, output=False), "θ_before", "deg", "Direction of the span before the pulley"
path.wraps = (value(belt_path.wrap.of(side=m.pulley_side, direction=m.run_direction), numbered="wraps.{}", first=0), "α", "deg",
    "Wrap of the pulley", "geometry")
path.signed_wraps = inner(belt_path.signed.of(side=m.pulley_side, size=m.wraps)), "σα", "deg", "Wrap, negative outside", "geometry"
path.signed_wraps_sum = total("sum", of="signed_wraps", output=False), "α_Σ", "deg", "Sum of the signed wraps: one turn"
path.belt_turns = (inner(belt_path.turns.of(sum_of_wraps=m.signed_wraps_sum)), "n_b", "1",
    "Revolutions of the belt's direction along its path: 1 in a loop", "geometry")
path.greatest_wrap = total("max", of="wraps", output=False), "α_max", "deg", "Maximum wrap"
path.require("one_turn", (m.belt_turns == 1) | (m.wraps < m.greatest_wrap), key=PULLEY,
    message="the signed wraps (inside +, outside −) do not sum to 360°, one turn of the belt, but to {belt_turns} turns: it would have to run "
    "{wraps} around pulley {part}, which it does not touch. Move pulley {part} against the belt or leave it out, change its side, or list the "
    "pulleys in the order in which the belt meets them")
path.clash("runs_apart", belt_path.crossing, LAYOUT, key=PULLEY,
    message="the straight runs behind pulleys {part} and {other} cross; move a pulley, or list them in the order in which the belt meets them")
path.clash("runs_clear", belt_path.pierced, LAYOUT, key=PULLEY,
    message="the straight run behind pulley {other} passes through pulley {part}; move one of them, or give pulley {part} its place in the order in "
        "which the belt meets the pulleys")

length = Chapter("Toothed belt: length and teeth in mesh", needs=("toothed_belt", PULLEYS), absent=f"not calculated: {PULLEYS} is not given")
length.belt_arcs = inner(m[f"{PULLEYS}.radius"] * m.wraps, digits=6), "s", "mm", "Arc length of the belt on the pulley", "geometry"
length.straight_length = total("sum", of="straight_runs", digits=6), "Σl", "mm", "Total length of the spans"
length.arc_length = total("sum", of="belt_arcs", digits=6), "Σs", "mm", "Total length of the arcs"
length.toothed_belt_length = (value(m.straight_length + m.arc_length, digits=7), "L_b", "mm", "Length of the toothed belt's path",
    "002 eq. 11, in general")
length.toothed_belt_teeth = (value(np.round(m.toothed_belt_length / m.toothed_belt.pitch), whole=True), "z_b", "1",
    "Number of teeth of the belt, the nearest whole number", "this method")
length.toothed_belt_take_up = (m.toothed_belt_teeth * m.toothed_belt.pitch - m.toothed_belt_length, "ΔL", "mm",
    "Difference of belt and path length: longer (+) or shorter (−); to be tensioned", "this method")
length.teeth_in_mesh = (m[f"{PULLEYS}.radius"] * as_number(m.wraps) / m.toothed_belt.pitch, "z_m", "1", "Number of teeth in mesh along the wrap",
    "this method")
length.teeth_in_mesh_inside = (total("min", of="teeth_in_mesh", among="has_teeth", output=False), "z_m,i", "1",
    "Minimum number of teeth in mesh of the toothed pulleys inside")
length.teeth_in_mesh_driving = (part(of="teeth_in_mesh", index=0, output=False), "z_m,1", "1",
    "Number of teeth in mesh of the first pulley, which drives")
length.teeth_in_mesh_min = (np.minimum(m.teeth_in_mesh_inside, m.teeth_in_mesh_driving), "z_m,min", "1",
    "Minimum number of teeth in mesh of the toothed pulleys", "this method")

TOOTHED_BELT = (speed, path, length, listed)

TOOTHED_BELT_CHECKS = LISTED_CHECKS

TOOTHED_BELT_ASSUMPTIONS = (
    "The toothed belt neither stretches nor sags, all pulleys lie in one plane, and radii refer to its pitch line, also at pulleys on the back "
    "of the belt. Outside pulleys are smooth, except the cylinder's.",
    "A loaded pulley outside the loop, the driving pulley or the cylinder's, needs a double-sided toothed belt.",
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
           "ToothedBelt"]
