"""Checks of the circular knife."""

from __future__ import annotations

from diecut_report.api import Check, Vary

PLACE = ("front_distance", Vary("cut_length", "down"), "eccentricity", "depth")

CHECKS = (
    Check(id="reach", check_class="function", title="Edge reaches the end of the cut", demand="cut_end", limit="reach_greatest", unit="mm",
        operator="<", demand_label="end of the cut from the axis", limit_label="maximum reach of the edge", source="geometry",
        consequence="the edge does not get to the end of the cut.", advise=PLACE),
    Check(id="shear_angle", check_class="practice", title="Shear angle between 2° and 20°", demand="shear_demand", limit="shear_limit", unit="deg",
        demand_label="maximum shear angle (or required minimum)", limit_label="allowed (or actual minimum)", source="practice",
        consequence="beyond 20° the travel is long and the board is pushed forward; below 2° the edge cuts nearly like a guillotine, with a high "
            "force.", advise=PLACE),
    Check(id="expulsion", check_class="function", title="Board is not pushed out", demand="shear_angle_max", limit="expulsion_angle", unit="deg",
        operator="<", demand_label="maximum shear angle", limit_label="twice the angle of friction", source="statics",
        consequence="edge and counter-knife push the board forward instead of cutting it, unless it is clamped.",
        advise=(*PLACE, Vary("friction", "up"))),
    Check(id="monotonic", check_class="function", title="Edge never reverses in the board", demand="used_sweep", limit="usable_sweep", unit="deg",
        demand_label="rotation up to the end of the cut", limit_label="rotation without reversal", source="geometry",
        consequence="before the cut ends, the edge runs back in the upper part of the board.", advise=PLACE),
    Check(id="entry", check_class="function", title="Edge meets the board from the front", demand="depth_least", limit="corner_distance", unit="mm",
        operator="<", demand_label="minimum distance of the edge from the axis, R − r", limit_label="board's upper front edge from the axis",
        source="geometry",
        consequence="over the whole turn this front edge is inside the edge's circle, so that the blade's end comes down on the board from above.",
        advise=("front_distance", "eccentricity", "depth")),
    Check(id="shear_resistance", check_class="practice", presumed=True, title="Shear resistance compared with the force of a rule",
        demand="rule_force", limit="guillotine_line_force", unit="N/mm", severity="warn", needs=("rule_force",),
        demand_label="required by a straight rule", limit_label="by the shear resistance", source="practice",
        consequence="force, torque and work are then calculated too small.", advise=(Vary("shear_resistance", "up"),)),
    Check(id="force", check_class="strength", title="Cutting force", demand="force_max", limit="allowable_force", unit="N",
        demand_label="maximum downward force", limit_label="allowed", source="input",
        consequence="knife or counter-knife bends; a thinner board takes less force.", advise=(Vary("front_distance", "up"), "eccentricity")),
    Check(id="torque", check_class="strength", title="Torque at the knife's shaft", demand="torque_max", limit="allowable_torque", unit="N*m",
        demand_label="maximum torque", limit_label="allowed", source="input",
        consequence="the knife's shaft and its drive are overloaded; less friction lowers it.", advise=(Vary("eccentricity", "down"),)),
)  # fmt: skip
