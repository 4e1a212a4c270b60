"""Chapters on what the edge reaches, and on the range of the cut."""

from __future__ import annotations

import numpy as np

from diecut_report.api import Chapter, Steps, bind, case
from diecut_report.mechanics import common
from diecut_report.plugins.circular_knife import formulas as f

# fmt: off

OWN = "this method"
PLACE = ("front_distance",)

reach = Chapter("Reach of the edge",
    text="The formulas are derived here. Of the source (001, third paper) only the first page survives: it gives the arrangement and its parameters "
        "r, R, δ, b and h, but no formulas; these are derived from that geometry. The shaft's axis is the origin; x runs along the counter-knife, "
        "depths point down, and the knife angle φ is measured clockwise from the direction of the cut to the edge's centre.")
reach.require("edge_round_shaft", lambda eccentricity, edge_radius: eccentricity < edge_radius, key="edge_radius",
    message="is {edge_radius}, but the edge must lie around the shaft: R > r = {eccentricity}; make the edge's radius greater or the eccentricity "
        "smaller")
reach.value("depth_least", "H_min", "mm", "Depth above which the edge leaves the counter-knife",
    lambda edge_radius, eccentricity: edge_radius - eccentricity, source=OWN, output=False)
reach.value("depth_greatest", "H_max", "mm", "Maximum depth of the edge", lambda edge_radius, eccentricity: edge_radius + eccentricity, source=OWN,
    output=False)
reach.require("edge_leaves", bind(f.is_clear_of, smaller="depth_least", greater="depth"), key="depth",
    message="is {depth}, but the edge would stay below the counter-knife over the whole turn: more than R − r = {depth_least:up} is needed; put the "
        "counter-knife lower, or make the edge's radius smaller or the eccentricity greater")
reach.require("edge_arrives", bind(f.is_clear_of, smaller="depth", greater="depth_greatest"), key="depth",
    message="is {depth}, but the edge never gets down to the counter-knife: less than R + r = {depth_greatest:down} is needed; put the "
        "counter-knife higher, or make the edge's radius or the eccentricity greater")
reach.require("board_below_axis", lambda thickness, depth: thickness < depth, key="thickness",
    message="is {thickness}, but the board's upper face would lie above the shaft's axis: h < H = {depth} is needed; take a thinner board or put "
        "the counter-knife lower")
reach.require("board_thick", lambda thickness, edge_radius: thickness >= 1e-06 * edge_radius, key="thickness",
    message="is {thickness}, but at least a millionth of the edge's radius R = {edge_radius} is needed; look at the unit of both")
reach.value("face_depth", "H_h", "mm", "Depth of the board's upper face", lambda depth, thickness: depth - thickness, source="geometry", output=False)
reach.value("reach_greatest", "x_max", "mm", "Maximum distance from the axis at which the edge still cuts",
    lambda edge_radius, eccentricity, depth: np.sqrt((edge_radius + eccentricity) ** 2 - depth**2), source=OWN)
reach.value("cut_end", "x_2", "mm", "Distance of the end of the cut from the axis", lambda front_distance, cut_length: front_distance + cut_length,
    source="geometry", output=False)
reach.require("reaches_board", bind(f.is_clear_of, smaller="front_distance", greater="reach_greatest"), key="front_distance",
    message="is {front_distance}, but the edge cannot reach the board: it cuts no further than √((R + r)² − H²) = {reach_greatest} from the axis; a "
        "higher counter-knife, a greater edge radius or a greater eccentricity reaches further", advise=PLACE)
reach.require("reaches_end", lambda cut_end, front_distance, reach_greatest, edge_radius:
        f.is_clear_of(cut_end, reach_greatest, edge_radius) | ~f.is_clear_of(front_distance, reach_greatest, edge_radius), key="cut_length",
    message="is {cut_length}, so that the cut ends b + L = {cut_end} from the axis, but the edge cannot reach that: it cuts no further than √((R + "
        "r)² − H²) = {reach_greatest}; a higher counter-knife, a greater edge radius or a greater eccentricity reaches further",
    advise=("cut_length", "front_distance"))
reach.value("lowest_at_face", "x_h", "mm", "Distance from the axis at which the edge's lowest point passes the board's upper face",
    bind(f.lowest_passes, depth="face_depth"), source=OWN, output=False)
reach.value("lowest_at_counter", "x_0", "mm", "The same distance at the counter-knife", bind(f.lowest_passes, depth="depth"), source=OWN,
    output=False)
reach.require("enters_face", lambda lowest_at_face, front_distance: lowest_at_face <= front_distance, key="front_distance",
    message="is {front_distance}, but the edge would come down on the board from above, {lowest_at_face} from the axis, and press it instead of "
        "shearing it from its front edge: b ≥ √(r² − (H − h − R)²) is needed", advise=PLACE)
reach.require("enters_counter", lambda lowest_at_counter, lowest_at_face, front_distance, edge_radius:
        f.is_clear_of(lowest_at_counter, front_distance, edge_radius) | (front_distance < lowest_at_face), key="front_distance",
    message="is {front_distance}, but the edge would meet the counter-knife behind the board's front edge, {lowest_at_counter} from the axis: b > "
        "√(r² − (H − R)²) is needed", advise=PLACE)


def _at_distance(name: str, symbol: str, description: str, distance: str) -> Steps:
    """The knife angle at which the cutting point is at a distance from the axis."""
    steps = Steps()
    steps.root(name, symbol, "deg", description, bind(f.past_centre, angle=name, distance=distance), low=lambda touch_angle: touch_angle,
        high=lambda return_angle: return_angle,
        left=bind(
            lambda angle, distance, eccentricity, depth: (distance - eccentricity * np.cos(angle)) ** 2 + (depth - eccentricity * np.sin(angle)) ** 2,
            angle=name, distance=distance), right=lambda edge_radius: edge_radius ** 2, source=OWN, unknown=name)
    return steps


shear_range = Chapter("Range of the cut",
    text="From φ_0, where the edge touches the counter-knife, to φ_r, where the line from the axis through the edge's centre passes the cutting "
        "point, this point only moves forward; the cut lies in between. The shear angle increases throughout, since cos τ = (H − r·sin φ)/R "
        "decreases there.")
shear_range.value("touch_angle", "φ_0", "deg", "Knife angle at which the edge touches the counter-knife",
    lambda depth, edge_radius, eccentricity: np.arcsin((depth - edge_radius) / eccentricity), source=OWN, output=False)
shear_range.value("return_angle", "φ_r", "deg", "Knife angle at which the cutting point reverses",
    lambda depth, edge_radius, eccentricity: np.arcsin(depth / (edge_radius + eccentricity)), source=OWN, output=False)
shear_range.add(_at_distance("angle_start", "φ_1", "Knife angle at the start of the cut", "front_distance"))
shear_range.add(_at_distance("angle_end", "φ_2", "Knife angle at the end of the cut", "cut_end"))
shear_range.value("cut_angle", "Δφ", "deg", "Angle of the cut", lambda angle_end, angle_start: angle_end - angle_start, source="kinematics")
shear_range.value("cut_time", "t", "ms", "Time of the cut", lambda cut_angle, speed: cut_angle / speed, source="kinematics")
shear_range.value("shear_angle_min", "τ_min", "deg", "Minimum shear angle: at the start of the cut", bind(f.edge_slope, angle="angle_start"),
    source=OWN)
shear_range.value("shear_angle_max", "τ_max", "deg", "Maximum shear angle: at the end of the cut", bind(f.edge_slope, angle="angle_end"), source=OWN)
shear_range.value("shear_angle_lower", "τ_a", "deg", "Minimum usual shear angle", lambda: 2 * np.pi / 180, source="practice", output=False)
shear_range.value("shear_angle_upper", "τ_b", "deg", "Maximum usual shear angle", lambda: 20 * np.pi / 180, source="practice", output=False)
for name, symbol, description, above, below in (
    ("shear_demand", "τ_d", "Governing side of the shear angle: the actual angle, or the required minimum", "shear_angle_max", "shear_angle_lower"),
    ("shear_limit", "τ_l", "Its limit: the allowed maximum, or the actual minimum", "shear_angle_upper", "shear_angle_min"),
):
    shear_range.choice(name, symbol, "deg", description,
        case(bind(common.same, quantity=above), "the maximum angle is closer to its limit",
            lambda shear_angle_max, shear_angle_upper, shear_angle_lower, shear_angle_min:
                shear_angle_max / shear_angle_upper >= shear_angle_lower / shear_angle_min),
        case(bind(common.same, quantity=below), "the minimum angle is closer to its limit"), output=False)
shear_range.value("expulsion_angle", "τ_f", "deg", "Shear angle from which the board is pushed out", lambda friction: 2 * np.arctan(friction),
    source="statics")

edge = Chapter("Edge",
    text="The edge meets the board first at its upper front edge, at φ_e, a little before the cutting point reaches the front edge. Positions on "
        "the edge are measured from the line shaft–centre, as seen from the edge's centre. The arc between ψ_1 and ψ_2 must be sharp; it is longer "
        "than the cut because the edge slides through the board. The point of the edge in the upper face reverses a little before the cutting point "
        "does.")
edge.value("corner_distance", "D", "mm", "Distance of the board's upper front edge from the axis",
    lambda front_distance, face_depth: np.sqrt(front_distance ** 2 + face_depth ** 2), source="geometry", output=False)
edge.value("angle_entry", "φ_e", "deg", "Knife angle at which the edge meets the board", bind(f.meeting_angle, corner="corner_distance"), source=OWN)
edge.value("edge_angle_first", "ψ_1", "deg", "Position on the edge of the point that meets the board first",
    bind(f.meeting_place, corner="corner_distance"), source=OWN)
edge.value("face_angle_end", "τ_h2", "deg", "Slope of the edge in the board's upper face at the end of the cut",
    bind(f.edge_slope, angle="angle_end", depth="face_depth"), source=OWN, output=False)
edge.value("edge_angle_last", "ψ_2", "deg", "Position on the edge of the point that cuts last",
    lambda angle_end, face_angle_end: np.pi / 2 - angle_end - face_angle_end, source=OWN)
edge.value("edge_length", "s", "mm", "Length of the edge that cuts",
    lambda edge_radius, edge_angle_first, edge_angle_last: edge_radius * (edge_angle_first - edge_angle_last), source=OWN)
edge.value("face_return_angle", "φ_rh", "deg", "Knife angle at which the point of the edge in the board's upper face reverses",
    lambda face_depth, edge_radius, eccentricity: np.arcsin(face_depth / (edge_radius + eccentricity)), source=OWN, output=False)
edge.value("used_sweep", "Δφ_2", "deg", "Rotation of the knife from touching the counter-knife to the end of the cut",
    lambda angle_end, touch_angle: angle_end - touch_angle, source="kinematics", output=False)
edge.value("usable_sweep", "Δφ_r", "deg", "Rotation up to which the edge moves forward throughout the thickness",
    lambda face_return_angle, touch_angle: face_return_angle - touch_angle, source="kinematics", output=False)
