"""The pulleys of the toothed belt's list against the drive: whole teeth, driving pulley, the cylinder's pulley and its side."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    ByText,
    Chapter,
    Check,
    Clash,
    Lookup,
    Part,
    Total,
    Value,
    Words,
    arccos,
    as_number,
    bind,
    formula,
    told,
)
from diecut_report.mechanics import common

PULLEYS = "toothed_belt.pulleys"
PITCH = "toothed_belt.pitch"
NOT_WHOLE = 0.01  # of a tooth
FEWEST_IN_MESH = 6.0


@formula
def teeth_around(radius: Any, pitch: Any) -> Any:
    """Teeth that the circumference of a pulley has room for."""
    return as_number(2 * np.pi) * radius / pitch


@formula
def whole_radius(radius: Any, pitch: Any) -> Any:
    """Pitch radius of the nearest whole number of teeth, one at least."""
    return np.maximum(1, np.round(as_number(2 * np.pi) * radius / pitch)) * pitch / (2 * np.pi)


@formula
def teeth_apart(radius: Any, other: Any, pitch: Any) -> Any:
    """How far two pitch radii are apart, in teeth."""
    return as_number(2 * np.pi) * abs(radius - other) / pitch


@formula
def farthest(toothed: Any, difference: Any, greatest: Any) -> Any:
    """Above zero for the toothed pulleys whose difference is the greatest."""
    return np.minimum(toothed, difference - greatest + 1e-9)


@formula
def height_of_wrap(side: Any, direction: Any, wrap: Any) -> Any:
    """Height over the pulley's axis, in radii, of the middle of its wrap."""
    return -side * np.cos(direction + side * wrap / 2)


@formula
def angle_from_top(height: Any) -> Any:
    """Angle from the upper side."""
    return arccos(height)


@formula
def angle_from_bottom(height: Any) -> Any:
    """Angle from the lower side, that of the die."""
    return arccos(-height)


def next_marked(is_cylinder: Any) -> Any:
    """For the first of several marked pulleys the index of the second, else -1."""
    found = np.full(is_cylinder.shape, -1)
    for row, marked in zip(found, is_cylinder > 0, strict=True):
        first, second, *_ = [*np.flatnonzero(marked), -1, -1]
        if second >= 0:
            row[first] = second
    return found


def pitch_advice(pitch: float, fewest: float) -> str:
    """The pitch that puts enough teeth into mesh."""
    return f"a pitch of at most {told(pitch * fewest / FEWEST_IN_MESH, 'mm', up=False)}"


IS_MARKED = bind(common.is_positive, quantity="cylinder_pulley_there")

LISTED = Chapter(
    "Toothed belt: pulleys of the list",
    needs=("toothed_belt", PULLEYS),
    absent=f"not calculated: {PULLEYS} is not given",
    text="The first pulley of the list is the driving one; the one with role: cylinder is fixed to the cylinder (κ = 1, else −1). Teeth "
    "(τ = 1) have all pulleys inside the loop, and the cylinder's; any other outside pulley runs on the back of the belt and is smooth. "
    "The y axis points up, and the die lies below the cylinder: the belt passes over the cylinder's pulley with engagement: away, below "
    "it with engagement: die.",
    steps=(
        Value(id="pulley_teeth", symbol="n_z", description="Teeth of the circumference", source="geometry", digits=6, output=False,
              formula=bind(teeth_around, radius=f"{PULLEYS}.radius", pitch=PITCH)),
        Value(id="pulley_whole_radius", symbol="r_z", unit="mm", description="Pitch radius of the nearest whole number of teeth",
              source="geometry", digits=6, output=False, formula=bind(whole_radius, radius=f"{PULLEYS}.radius", pitch=PITCH)),
        Value(id="pulley_teeth_off", symbol="Δz", description="Difference in teeth", source="this method", output=False,
              formula=bind(teeth_apart, radius=f"{PULLEYS}.radius", other="pulley_whole_radius", pitch=PITCH)),
        Clash(id="one_cylinder_pulley", function=next_marked, takes=("is_cylinder_pulley",), key=f"{PULLEYS}",
              message="pulleys {part} and {other} both have role: cylinder, but one is fixed to the cylinder; give the others role: other"),
        Total(id="pulley_teeth_off_max", symbol="Δz_max", description="Greatest difference of the toothed pulleys", source="this method",
              output=False, of="pulley_teeth_off", operation="max", among="has_teeth"),
        Value(id="is_farthest", symbol="φ_z", description="Above 0: the pulley with this difference", output=False, source="this method",
              formula=bind(farthest, toothed="has_teeth", difference="pulley_teeth_off", greatest="pulley_teeth_off_max")),
        Total(id="farthest_radius", symbol="r_f", unit="mm", description="Its radius", digits=6, output=False, of=f"{PULLEYS}.radius",
              operation="min", among="is_farthest"),
        Total(id="farthest_teeth", symbol="n_f", description="Its teeth", digits=6, output=False, of="pulley_teeth", operation="min",
              among="is_farthest"),
        Total(id="farthest_whole_radius", symbol="r_zf", unit="mm", description="Its radius with whole teeth", digits=6, output=False,
              of="pulley_whole_radius", operation="min", among="is_farthest"),
        Part(id="first_radius", symbol="r_1st", unit="mm", description="Radius of the first pulley, which drives", digits=6, output=False,
             of=f"{PULLEYS}.radius", index=0),
        Value(id="driving_teeth_off", symbol="Δz_p", description="Difference of the first pulley from the driving one, in teeth",
              source="this method", output=False,
              formula=bind(teeth_apart, radius="first_radius", other="driving_pulley_pitch_radius", pitch=PITCH)),
        Value(id="driven_whole_radius", symbol="r_dz", unit="mm", description="Radius r_d with the nearest whole number of teeth", digits=6,
              source="geometry", output=False, formula=bind(whole_radius, radius="toothed_belt.driven_radius", pitch=PITCH)),
        Total(id="cylinder_pulley_there", symbol="κ_max", description="Whether the list has the cylinder's pulley: 1, else −1",
              output=False, of="is_cylinder_pulley", operation="max"),
        Total(id="cylinder_pulley_radius", symbol="r_c", unit="mm", description="Radius of the cylinder's pulley in the list", digits=6,
              output=False, of=f"{PULLEYS}.radius", operation="sum", among="is_cylinder_pulley"),
        Value(id="cylinder_teeth_off", symbol="Δz_d", description="Difference of it from r_d, in teeth", source="this method",
              output=False, exists=IS_MARKED,
              formula=bind(teeth_apart, radius="cylinder_pulley_radius", other="toothed_belt.driven_radius", pitch=PITCH)),
        Total(id="cylinder_pulley_side", symbol="σ_c", description="Side of the cylinder's pulley", output=False, of="pulley_side",
              operation="sum", among="is_cylinder_pulley"),
        Total(id="cylinder_direction_before", symbol="θ_c", unit="deg", description="Direction of the run before it", output=False,
              of="direction_before", operation="sum", among="is_cylinder_pulley"),
        Total(id="cylinder_wrap", symbol="α_c", unit="deg", description="Its wrap", output=False, of="wraps", operation="sum",
              among="is_cylinder_pulley"),
        Value(id="cylinder_wrap_height", symbol="h_c", description="Height of the middle of its wrap over the axis, to the radius",
              output=False, source="geometry", exists=IS_MARKED,
              formula=bind(height_of_wrap, side="cylinder_pulley_side", direction="cylinder_direction_before", wrap="cylinder_wrap")),
        Value(id="engagement_angle", symbol="γ", unit="deg", description="Angle of the wrap's middle from the side of engagement",
              source="geometry", output=False, exists=IS_MARKED,
              formula=ByText("toothed_belt.engagement", {"away": angle_from_top, "die": angle_from_bottom}, height="cylinder_wrap_height")),
        Words(id="pitch_advice", description="The pitch that puts enough teeth into mesh", function=pitch_advice, output=False,
              takes=(PITCH, "teeth_in_mesh_min")),
    ),
)  # fmt: skip

MARKS = (
    Lookup(id="is_cylinder_pulley", symbol="κ", description="Cylinder's pulley: 1, another one: −1", source="this method", output=False,
           by=f"{PULLEYS}.role", table={"cylinder": 1.0, "other": -1.0}),
    Value(id="has_teeth", symbol="τ", description="Pulley with teeth: 1, smooth: −1", source="this method", output=False,
          formula=bind(common.greater_of, first="pulley_side", second="is_cylinder_pulley")),
)  # fmt: skip

LISTED_CHECKS = (
    Check(id="teeth_in_mesh", title="Teeth in mesh", demand=FEWEST_IN_MESH, limit="teeth_in_mesh_min", unit="1", demand_label="required",
          limit_label="fewest of the toothed pulleys", source="practice",
          consequence="the belt's teeth shear or jump; {pitch_advice}, a larger pulley or an idler outside that adds wrap helps."),
    Check(id="belt_engagement", title="Side of the cylinder's pulley", demand="engagement_angle", limit=90.0, unit="deg", operator="<",
          demand_label="belt off the engaged side", limit_label="allowed", source="geometry",
          consequence="the pulleys lead the belt round the other side of the cylinder's pulley, so it runs at another speed than is "
          "calculated; change toothed_belt.engagement, or the places and sides of the pulleys (the die lies below, where y is less)."),
    Check(id="driving_pulley_listed", title="Driving pulley in the list", demand="driving_teeth_off", limit=NOT_WHOLE, unit="1",
          severity="warn", demand_label="difference in teeth", limit_label="accepted", source="this method",
          consequence="the belt's length is that of another driving pulley than the one calculated; give the first of "
          "toothed_belt.pulleys a radius of {driving_pulley_pitch_radius}, {driving_pulley_teeth} teeth."),
    Check(id="pulley_teeth_whole", title="Whole teeth of the pulleys", demand="pulley_teeth_off_max", limit=NOT_WHOLE, unit="1",
          severity="warn", demand_label="farthest from a whole number", limit_label="accepted", source="this method",
          consequence="the pulley of radius {farthest_radius} in toothed_belt.pulleys would have {farthest_teeth} teeth; give it a radius of "
          "{farthest_whole_radius}."),
    Check(id="cylinder_pulley_listed", title="The cylinder's pulley in the list", demand="cylinder_teeth_off", limit=NOT_WHOLE, unit="1",
          severity="warn", demand_label="difference in teeth", limit_label="accepted", source="this method",
          consequence="toothed_belt.driven_radius and the radius of the pulley with role: cylinder, {cylinder_pulley_radius}, are of one "
          "pulley; give both {driven_whole_radius}."),
)  # fmt: skip
