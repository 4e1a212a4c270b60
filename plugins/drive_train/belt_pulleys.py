"""The pulleys of the toothed belt's list against the drive: whole teeth, driving pulley, the cylinder's pulley and its side."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import ByText, Chapter, Check, Steps, Vary, arccos, as_number, bind, formula
from diecut_report.mechanics import common

# fmt: off

PULLEYS = "toothed_belt.pulleys"
PITCH = "toothed_belt.pitch"
NOT_WHOLE = 0.01  # of a tooth
FEWEST_IN_MESH = 6.0


@formula
def whole_radius(radius: Any, pitch: Any) -> Any:
    """Pitch radius of the nearest whole number of teeth, one at least."""
    return np.maximum(1, np.round(as_number(2 * np.pi) * radius / pitch)) * pitch / (2 * np.pi)


@formula
def teeth_apart(radius: Any, other: Any, pitch: Any) -> Any:
    """How far two pitch radii are apart, in teeth."""
    return as_number(2 * np.pi) * abs(radius - other) / pitch






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


IS_MARKED = bind(common.is_positive, quantity="cylinder_pulley_there")

listed = Chapter("Toothed belt: pulleys in the list",
    text="The first pulley of the list is the driving one; one may be fixed to the cylinder (κ = 1, otherwise −1). All pulleys inside the loop and "
        "the cylinder's pulley are toothed (τ = 1); any other outside pulley runs on the back of the belt and is smooth. The y axis points up, and "
        "the die lies below the cylinder: the belt passes over the cylinder's pulley where this engages away from the die, and below it where it "
        "engages on the die side.", needs=("toothed_belt", PULLEYS), absent=f"not calculated: {PULLEYS} is not given")
listed.value("pulley_teeth", "n_z", "1", "Number of teeth of the circumference",
    bind(lambda radius, pitch: as_number(2 * np.pi) * radius / pitch, radius=f"{PULLEYS}.radius", pitch=PITCH), source="geometry", digits=6,
    output=False)
listed.value("pulley_whole_radius", "r_z", "mm", "Pitch radius of the nearest whole number of teeth",
    bind(whole_radius, radius=f"{PULLEYS}.radius", pitch=PITCH), source="geometry", digits=6, output=False)
listed.value("pulley_teeth_off", "Δz", "1", "Difference in teeth",
    bind(teeth_apart, radius=f"{PULLEYS}.radius", other="pulley_whole_radius", pitch=PITCH), source="this method", output=False)
listed.clash("one_cylinder_pulley", next_marked, ("is_cylinder_pulley",), key=f"{PULLEYS}",
    message="pulleys {part} and {other} both have role: cylinder, but one is fixed to the cylinder; give the others role: other")
listed.total("pulley_teeth_off_max", "Δz_max", "1", "Maximum difference of the toothed pulleys", "max", of="pulley_teeth_off", among="has_teeth",
    source="this method", output=False)
listed.computed("farthest_radius", "r_f", "mm", "Radius of the worst toothed pulley", of_farthest, (f"{PULLEYS}.radius", *OFF), FARTHEST, **UNPRINTED)
listed.computed("farthest_teeth", "n_f", "1", "Number of teeth of the worst toothed pulley", of_farthest, ("pulley_teeth", *OFF), FARTHEST,
    **UNPRINTED)
listed.computed("farthest_whole_radius", "r_zf", "mm", "Radius of the worst toothed pulley with whole teeth", of_farthest,
    ("pulley_whole_radius", *OFF), FARTHEST, **UNPRINTED)
listed.part("first_radius", "r_1st", "mm", "Radius of the first pulley, which drives", of=f"{PULLEYS}.radius", index=0, digits=6, output=False)
listed.value("driving_teeth_off", "Δz_p", "1", "Difference of the first pulley from the driving one, in teeth",
    bind(teeth_apart, radius="first_radius", other="driving_pulley_pitch_radius", pitch=PITCH), source="this method", output=False)
listed.value("driven_whole_radius", "r_dz", "mm", "Radius r_d with the nearest whole number of teeth",
    bind(whole_radius, radius="toothed_belt.driven_radius", pitch=PITCH), digits=6, source="geometry", output=False)
listed.computed("cylinder_pulley_there", "κ_max", "1", "Cylinder's pulley in the list: 1, otherwise −1", any_marked, ("is_cylinder_pulley",),
    "maximum mark of its pulleys", printed=False, output=False)
listed.total("cylinder_pulley_radius", "r_c", "mm", "Radius of the cylinder's pulley in the list", "sum", of=f"{PULLEYS}.radius",
    among="is_cylinder_pulley", digits=6, output=False)
listed.value("cylinder_teeth_off", "Δz_d", "1", "Its difference from r_d, in teeth",
    bind(teeth_apart, radius="cylinder_pulley_radius", other="toothed_belt.driven_radius", pitch=PITCH), source="this method", output=False,
    exists=IS_MARKED)
listed.total("cylinder_pulley_side", "σ_c", "1", "Side of the cylinder's pulley", "sum", of="pulley_side", among="is_cylinder_pulley", output=False)
listed.total("cylinder_direction_before", "θ_c", "deg", "Direction of the span before it", "sum", of="direction_before", among="is_cylinder_pulley",
    output=False)
listed.total("cylinder_wrap", "α_c", "deg", "Its wrap", "sum", of="wraps", among="is_cylinder_pulley", output=False)
listed.value("cylinder_wrap_height", "h_c", "1", "Height of the middle of its wrap above the axis, relative to the radius",
    lambda cylinder_pulley_side, cylinder_direction_before, cylinder_wrap:
        -cylinder_pulley_side * np.cos(cylinder_direction_before + cylinder_pulley_side * cylinder_wrap / 2), output=False, source="geometry",
    exists=IS_MARKED)
listed.value("engagement_angle", "γ", "deg", "Angle of the middle of the wrap from the side of engagement",
    ByText("toothed_belt.engagement", {"away": angle_from_top, "die": angle_from_bottom}, height="cylinder_wrap_height"), source="geometry",
    output=False, exists=IS_MARKED)
MARKS = Steps()
MARKS.lookup("is_cylinder_pulley", "κ", "1", "Cylinder's pulley: 1, other pulleys: −1", {"cylinder": 1.0, "other": -1.0}, by=f"{PULLEYS}.role",
    source="this method", output=False)
MARKS.value("has_teeth", "τ", "1", "Pulley with teeth: 1, smooth: −1",
    lambda pulley_side, is_cylinder_pulley: np.maximum(pulley_side, is_cylinder_pulley), source="this method", output=False)

LISTED_CHECKS = (
    Check(id="teeth_in_mesh", check_class="practice", title="Teeth in mesh",
          demand=FEWEST_IN_MESH, limit="teeth_in_mesh_min", unit="1", demand_label="required",
          limit_label="minimum of toothed pulleys", source="practice",
          consequence="the belt's teeth shear or jump; a larger pulley or an idler outside that adds wrap helps.",
          advise=(Vary(PITCH, "down"),)),
    Check(id="belt_engagement", check_class="function", title="Side of the cylinder's pulley",
          demand="engagement_angle", limit=90.0, unit="deg", operator="<",
          demand_label="belt off the engaged side", limit_label="allowed", source="geometry",
          consequence="the pulleys lead the belt round the other side of the cylinder's pulley, so it runs at another speed than is "
          "calculated; change toothed_belt.engagement, or the places and sides of the pulleys (the die lies below, where y is less)."),
    Check(id="driving_pulley_listed", check_class="function", title="Driving pulley in the list",
          demand="driving_teeth_off", limit=NOT_WHOLE, unit="1", demand_label="difference in teeth", limit_label="accepted", source="this method",
          consequence="the belt's length is that of another driving pulley than the one calculated; give the first of "
          "toothed_belt.pulleys a radius of {driving_pulley_pitch_radius}, {driving_pulley_teeth} teeth."),
    Check(id="pulley_teeth_whole", check_class="function", title="Whole teeth of the pulleys",
          demand="pulley_teeth_off_max", limit=NOT_WHOLE, unit="1",
          demand_label="deviation from whole number", limit_label="accepted", source="this method",
          consequence="the pulley of radius {farthest_radius} in toothed_belt.pulleys would have {farthest_teeth} teeth; give it a radius of "
          "{farthest_whole_radius}."),
    Check(id="cylinder_pulley_listed", check_class="function", title="The cylinder's pulley in the list",
          demand="cylinder_teeth_off", limit=NOT_WHOLE, unit="1", demand_label="difference in teeth", limit_label="accepted", source="this method",
          consequence="toothed_belt.driven_radius and the radius of the pulley with role: cylinder, {cylinder_pulley_radius}, are of one "
          "pulley; give both {driven_whole_radius}."),
)
