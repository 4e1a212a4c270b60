"""Checks of the circular knife."""

from __future__ import annotations

from diecut_report.api import Check

CHECKS = (
    Check(id="reach", title="Edge reaches the end of the cut", demand="cut_end", limit="reach_greatest", unit="mm", operator="<",
          demand_label="end of the cut from the axis", limit_label="greatest reach of the edge", source="geometry",
          consequence="the edge does not get to the end of the cut; shorten it, or put board or counter-knife nearer to the shaft."),
    Check(id="shear_angle", title="Shear angle between 2° and 20°", demand="shear_demand", limit="shear_limit", unit="deg",
          demand_label="greatest shear angle (or least required)", limit_label="allowed (or least there is)", source="practice",
          consequence="{shear_advice}"),
    Check(id="expulsion", title="Board is not pushed out", demand="shear_angle_max", limit="expulsion_angle", unit="deg", operator="<",
          demand_label="greatest shear angle", limit_label="twice the angle of friction", source="statics",
          consequence="edge and counter-knife push the board forward instead of cutting it; a shorter cut, a smaller front_distance or a smaller "
          "depth lowers the shear angle; otherwise the board must be clamped."),
    Check(id="monotonic", title="Edge never runs back in the board", demand="used_sweep", limit="usable_sweep", unit="deg",
          demand_label="turn of the knife up to the end of the cut", limit_label="turn up to where the edge runs back", source="geometry",
          consequence="before the cut ends, the edge runs back in the upper part of the board; a shorter cut, a smaller front_distance, or a "
          "greater edge radius or eccentricity helps."),
)  # fmt: skip
