"""The calculation of the circular knife: its inputs, its formulas, the geometry of the cut, its force and torque."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    Chapter,
    Inputs,
    Quantity,
    Steps,
    abscissa,
    case,
    choice,
    formula,
    inner,
    m,
    pi,
    reduction,
    root,
    samples,
    value,
)
from diecut_report.mechanics import circular_segment

# fmt: off


class CircularKnife(Inputs):
    """Keys of ``circular_knife``."""

    eccentricity = Quantity("r", "mm", "Eccentricity: distance of the edge's centre from the shaft's axis", gt=0)
    edge_radius = Quantity("R", "mm", "Radius of the edge about its centre (above the eccentricity)", gt=0)
    depth = Quantity("H", "mm", "Distance of the counter-knife from the shaft's axis, between R − r and R + r", gt=0)
    front_distance = Quantity("b", "mm", "Distance of the board's front edge from the shaft's axis, along the counter-knife", ge=0)
    thickness = Quantity("h", "mm", "Thickness of the board (below the depth)", gt=0)
    cut_length = Quantity("L", "mm", "Length of the cut, measured from the board's front edge", gt=0)
    sharpening_angle = Quantity("δ", "deg", "Sharpening angle of the edge", gt=0, lt=90)
    speed = Quantity("ω", "rpm", "Speed of the knife's shaft; one cut per revolution", gt=0)
    shear_resistance = Quantity("σ", "N/mm**2",
        "Shear resistance: shear stress on the full thickness where the edge enters, falling to zero where it has cut through", gt=0, default=10)
    rule_force = Quantity("q_a", "N/mm", "Force per unit length with which a straight rule cuts this board, for comparison with σ", gt=0,
        optional=True)
    friction = Quantity("f", "1", "Coefficient of friction of the board on edge and counter-knife", ge=0, default=0.3)
    allowable_force = Quantity("[F]", "N", "Allowable force on knife and counter-knife", gt=0, optional=True)
    allowable_torque = Quantity("[M]", "N*m", "Allowable torque at the knife's shaft", gt=0, optional=True)
    n_points = samples(720)


@formula
def lowest_passes(eccentricity: Any, depth: Any, edge_radius: Any) -> Any:
    """Distance from the axis at which the edge's lowest point passes a depth; zero where it never does."""
    return np.sqrt(eccentricity**2 - np.minimum((depth - edge_radius) ** 2, eccentricity**2))


@formula
def meeting_angle(eccentricity: Any, edge_radius: Any, corner: Any, front_distance: Any, face_depth: Any) -> Any:
    """Knife angle at which the edge meets a point: its direction less the angle at the axis, by the law of cosines."""
    cosine = (eccentricity**2 + corner**2 - edge_radius**2) / (2 * eccentricity * corner)
    return np.arctan2(face_depth, front_distance) - np.arccos(np.maximum(cosine, -1))


@formula
def meeting_place(eccentricity: Any, edge_radius: Any, corner: Any) -> Any:
    """Place on the edge that meets a point at a distance from the axis, by the law of cosines."""
    cosine = (corner**2 - eccentricity**2 - edge_radius**2) / (2 * eccentricity * edge_radius)
    return np.arccos(np.maximum(cosine, -1))


@formula
def past_centre(angle: Any, distance: Any, eccentricity: Any, depth: Any, edge_radius: Any) -> Any:
    """Zero where a point of the counter-knife lies on the edge: its way along the line axis–centre, by the law of cosines."""
    along = distance * np.cos(angle) + depth * np.sin(angle)
    return along - (distance**2 + (depth - edge_radius) * (depth + edge_radius) + eccentricity**2) / (2 * eccentricity)


@formula
def is_clear_of(smaller: Any, greater: Any, edge_radius: Any) -> Any:
    """Whether one distance is below another by more than a millionth of the edge's radius, or there is no other one at all."""
    return (smaller + 1e-6 * edge_radius < greater) | (greater != greater)


@formula
def edge_position(angle: Any, depth: Any, eccentricity: Any, edge_radius: Any) -> Any:
    """Distance from the axis at which the edge crosses a depth."""
    down = depth - eccentricity * np.sin(angle)
    return eccentricity * np.cos(angle) + np.sqrt(edge_radius**2 - down**2)


@formula
def edge_slope(angle: Any, depth: Any, eccentricity: Any, edge_radius: Any) -> Any:
    """Angle between edge and counter-knife where the edge crosses a depth."""
    down = depth - eccentricity * np.sin(angle)
    return np.arctan2(np.sqrt(edge_radius**2 - down**2), down)


@formula
def sliding_ratio(edge_radius: Any, eccentricity: Any, angle: Any, shear_angle: Any) -> Any:
    """Tangential to normal speed of the edge at the cutting point."""
    direction = angle + shear_angle
    return (edge_radius + eccentricity * np.sin(direction)) / (eccentricity * np.cos(direction))


@formula
def front_length(edge_radius: Any, face_angle: Any, shear_angle: Any) -> Any:
    """Length along the cut in which the board is partly cut through."""
    return edge_radius * (np.sin(face_angle) - np.sin(shear_angle))


@formula
def force(shear_resistance: Any, thickness: Any, front_length: Any, bow_area: Any) -> Any:
    """Shear stress times the area between the edge and the line square to the board through the cutting point."""
    return shear_resistance * (thickness * front_length / 2 + bow_area)


@formula
def friction_torque(
    friction: Any, force: Any, shear_angle: Any, edge_radius: Any, eccentricity: Any, angle: Any
) -> Any:
    """Torque of the friction along the edge: what presses on the edge times the way that the edge slides for each radian."""
    pressed = force / np.cos(shear_angle)
    return friction * pressed * (edge_radius + eccentricity * np.sin(angle + shear_angle))


OWN = "this method"
PLACE = ("front_distance",)

reach = Chapter("Reach of the edge",
    text="The formulas are derived here. Of the source (001, third paper) only the first page survives: it gives the arrangement and its parameters "
        "r, R, δ, b and h, but no formulas; these are derived from that geometry. The shaft's axis is the origin; x runs along the counter-knife, "
        "depths point down, and the knife angle φ is measured clockwise from the direction of the cut to the edge's centre.")
reach.require("edge_round_shaft", m.eccentricity < m.edge_radius, key="edge_radius",
    message="is {edge_radius}, but the edge must lie around the shaft: R > r = {eccentricity}; make the edge's radius greater or the eccentricity "
    "smaller")
reach.depth_least = inner(m.edge_radius - m.eccentricity), "H_min", "mm", "Depth above which the edge leaves the counter-knife", OWN
reach.depth_greatest = inner(m.edge_radius + m.eccentricity), "H_max", "mm", "Maximum depth of the edge", OWN
reach.require("edge_leaves", is_clear_of.of(smaller=m.depth_least, greater=m.depth), key="depth",
    message="is {depth}, but the edge would stay below the counter-knife over the whole turn: more than R − r = {depth_least:up} is needed; put the "
    "counter-knife lower, or make the edge's radius smaller or the eccentricity greater")
reach.require("edge_arrives", is_clear_of.of(smaller=m.depth, greater=m.depth_greatest), key="depth",
    message="is {depth}, but the edge never gets down to the counter-knife: less than R + r = {depth_greatest:down} is needed; put the "
    "counter-knife higher, or make the edge's radius or the eccentricity greater")
reach.require("board_below_axis", m.thickness < m.depth, key="thickness",
    message="is {thickness}, but the board's upper face would lie above the shaft's axis: h < H = {depth} is needed; take a thinner board or put "
    "the counter-knife lower")
reach.require("board_thick", m.thickness >= 1e-06 * m.edge_radius, key="thickness",
    message="is {thickness}, but at least a millionth of the edge's radius R = {edge_radius} is needed; look at the unit of both")
reach.face_depth = inner(m.depth - m.thickness), "H_h", "mm", "Depth of the board's upper face", "geometry"
reach.reach_greatest = (np.sqrt((m.edge_radius + m.eccentricity) ** 2 - m.depth**2), "x_max", "mm",
    "Maximum distance from the axis at which the edge still cuts", OWN)
reach.cut_end = inner(m.front_distance + m.cut_length), "x_2", "mm", "Distance of the end of the cut from the axis", "geometry"
reach.require("reaches_board", is_clear_of.of(smaller=m.front_distance, greater=m.reach_greatest), key="front_distance",
    message="is {front_distance}, but the edge cannot reach the board: it cuts no further than √((R + r)² − H²) = {reach_greatest} from the axis; a "
    "higher counter-knife, a greater edge radius or a greater eccentricity reaches further", advise=PLACE)
reach.require("reaches_end", is_clear_of(m.cut_end, m.reach_greatest, m.edge_radius) | ~is_clear_of(m.front_distance, m.reach_greatest,
    m.edge_radius), key="cut_length",
    message="is {cut_length}, so that the cut ends b + L = {cut_end} from the axis, but the edge cannot reach that: it cuts no further than √((R + "
    "r)² − H²) = {reach_greatest}; a higher counter-knife, a greater edge radius or a greater eccentricity reaches further",
    advise=("cut_length", "front_distance"))
reach.lowest_at_face = (inner(lowest_passes.of(depth=m.face_depth)), "x_h", "mm",
    "Distance from the axis at which the edge's lowest point passes the board's upper face", OWN)
reach.lowest_at_counter = inner(lowest_passes.of(depth=m.depth)), "x_0", "mm", "The same distance at the counter-knife", OWN
reach.require("enters_face", m.lowest_at_face <= m.front_distance, key="front_distance",
    message="is {front_distance}, but the edge would come down on the board from above, {lowest_at_face} from the axis, and press it instead of "
    "shearing it from its front edge: b ≥ √(r² − (H − h − R)²) is needed", advise=PLACE)
reach.require("enters_counter", is_clear_of(m.lowest_at_counter, m.front_distance, m.edge_radius) | (m.front_distance < m.lowest_at_face),
    key="front_distance",
    message="is {front_distance}, but the edge would meet the counter-knife behind the board's front edge, {lowest_at_counter} from the axis: b > "
    "√(r² − (H − R)²) is needed", advise=PLACE)


def _at_distance(chapter: Steps, name: str, symbol: str, description: str, distance: str) -> None:
    """The knife angle at which the cutting point is at a distance from the axis."""
    chapter[name] = (root(past_centre.of(angle=m[name], distance=m[distance]), low=m.touch_angle, high=m.return_angle,
        left=(m[distance] - m.eccentricity * np.cos(m[name])) ** 2 + (m.depth - m.eccentricity * np.sin(m[name])) ** 2, right=m.edge_radius ** 2,
        unknown=name), symbol, "deg", description, OWN)


shear_range = Chapter("Range of the cut",
    text="From φ_0, where the edge touches the counter-knife, to φ_r, where the line from the axis through the edge's centre passes the cutting "
        "point, this point only moves forward; the cut lies in between. The shear angle increases throughout, since cos τ = (H − r·sin φ)/R "
        "decreases there.")
shear_range.touch_angle = (inner(np.arcsin((m.depth - m.edge_radius) / m.eccentricity)), "φ_0", "deg",
    "Knife angle at which the edge touches the counter-knife", OWN)
shear_range.return_angle = (inner(np.arcsin(m.depth / (m.edge_radius + m.eccentricity))), "φ_r", "deg",
    "Knife angle at which the cutting point reverses", OWN)
_at_distance(shear_range, "angle_start", "φ_1", "Knife angle at the start of the cut", "front_distance")
_at_distance(shear_range, "angle_end", "φ_2", "Knife angle at the end of the cut", "cut_end")
shear_range.cut_angle = m.angle_end - m.angle_start, "Δφ", "deg", "Angle of the cut", "kinematics"
shear_range.cut_time = m.cut_angle / m.speed, "t", "ms", "Time of the cut", "kinematics"
shear_range.shear_angle_min = edge_slope.of(angle=m.angle_start), "τ_min", "deg", "Minimum shear angle: at the start of the cut", OWN
shear_range.shear_angle_max = edge_slope.of(angle=m.angle_end), "τ_max", "deg", "Maximum shear angle: at the end of the cut", OWN
shear_range.shear_angle_lower = inner(2 * pi / 180), "τ_a", "deg", "Minimum usual shear angle", "practice"
shear_range.shear_angle_upper = inner(20 * pi / 180), "τ_b", "deg", "Maximum usual shear angle", "practice"
for name, symbol, description, above, below in (
    ("shear_demand", "τ_d", "Governing side of the shear angle: the actual angle, or the required minimum", "shear_angle_max", "shear_angle_lower"),
    ("shear_limit", "τ_l", "Its limit: the allowed maximum, or the actual minimum", "shear_angle_upper", "shear_angle_min"),
):
    shear_range[name] = (choice(case(m[above], "the maximum angle is closer to its limit",
        m.shear_angle_max / m.shear_angle_upper >= m.shear_angle_lower / m.shear_angle_min),
        case(m[below], "the minimum angle is closer to its limit"), output=False), symbol, "deg", description)
shear_range.expulsion_angle = 2 * np.arctan(m.friction), "τ_f", "deg", "Shear angle from which the board is pushed out", "statics"

edge = Chapter("Edge",
    text="The edge meets the board first at its upper front edge, at φ_e, a little before the cutting point reaches the front edge. Positions on "
        "the edge are measured from the line shaft–centre, as seen from the edge's centre. The arc between ψ_1 and ψ_2 must be sharp; it is longer "
        "than the cut because the edge slides through the board. The point of the edge in the upper face reverses a little before the cutting point "
        "does.")
edge.corner_distance = (inner(np.sqrt(m.front_distance ** 2 + m.face_depth ** 2)), "D", "mm",
    "Distance of the board's upper front edge from the axis", "geometry")
edge.angle_entry = meeting_angle.of(corner=m.corner_distance), "φ_e", "deg", "Knife angle at which the edge meets the board", OWN
edge.edge_angle_first = meeting_place.of(corner=m.corner_distance), "ψ_1", "deg", "Position on the edge of the point that meets the board first", OWN
edge.face_angle_end = (inner(edge_slope.of(angle=m.angle_end, depth=m.face_depth)), "τ_h2", "deg",
    "Slope of the edge in the board's upper face at the end of the cut", OWN)
edge.edge_angle_last = pi / 2 - m.angle_end - m.face_angle_end, "ψ_2", "deg", "Position on the edge of the point that cuts last", OWN
edge.edge_length = m.edge_radius * (m.edge_angle_first - m.edge_angle_last), "s", "mm", "Length of the edge that cuts", OWN
edge.face_return_angle = (inner(np.arcsin(m.face_depth / (m.edge_radius + m.eccentricity))), "φ_rh", "deg",
    "Knife angle at which the point of the edge in the board's upper face reverses", OWN)
edge.used_sweep = (inner(m.angle_end - m.touch_angle), "Δφ_2", "deg", "Rotation of the knife from touching the counter-knife to the end of the cut",
    "kinematics")
edge.usable_sweep = (inner(m.face_return_angle - m.touch_angle), "Δφ_r", "deg",
    "Rotation up to which the edge moves forward throughout the thickness", "kinematics")


CUTTING = m.cutting == 1
INSIDE, OUTSIDE = "the knife is in its cut", "the knife is outside its cut"


def _in_cut(
    chapter: Steps,
    name: str, symbol: str, unit: str, description: str, formula: Any, *, source: str = OWN, output: bool = True
) -> None:
    """A curve that is zero outside the cut."""
    chapter[name] = choice(case(formula, INSIDE, CUTTING), case(0, OUTSIDE), output=output), symbol, unit, description, source


motion = Chapter("Motion over a revolution of the knife",
    text="The curves cover a full revolution, so that a drive can use them. Outside the cut, cutting point and shear angle stay as they are at its "
        "start; speed, sliding, force and torque are zero. At the cutting point the angle between the edge's normal and the direction of its centre "
        "is φ + τ: hence the speeds of the edge along itself, ω·(R + r·sin(φ + τ)), and normal to itself, ω·r·cos(φ + τ).")
motion.knife_angle = abscissa(2 * np.pi, shown_at="torque_max_at", speed="speed"), "φ", "deg", "Knife angle, one turn"
motion.phase("cutting", "working", "The knife cuts", "knife_angle", ("angle_start", "angle_end"))
motion.phase("free", "window", "The knife is off the board", "knife_angle", rest_of=("cutting",))
motion.parting_angle = (inner(m.touch_angle + np.sqrt((m.angle_start - m.touch_angle) * (m.angle_end - m.touch_angle))), "φ_s", "deg",
    "Knife angle that divides the cut for integration: with a flat edge the cut begins steeply", OWN)
motion.breakpoints("ends_of_cut", "knife_angle", "angle_start", "parting_angle", "angle_end")
motion.middle_angle = inner((m.angle_start + m.angle_end) / 2), "φ_m", "deg", "Knife angle in the middle of the cut", "kinematics"
motion.cutting = (choice(case(1, INSIDE, np.cos(m.knife_angle - m.middle_angle) >= np.cos(m.cut_angle / 2)), case(0, OUTSIDE), output=False,
    per_piece=True), "c", "1", "Knife in its cut (1) or not (0)")
motion.cut_place = (choice(case(m.knife_angle, INSIDE, CUTTING), case(m.angle_start, OUTSIDE), output=False), "φ_c", "deg",
    "Knife angle in the cut, or at its start")
motion.cut_position = edge_position.of(angle=m.cut_place), "x_c", "mm", "Distance of the cutting point from the axis", OWN
motion.shear_angle = edge_slope.of(angle=m.cut_place), "τ", "deg", "Shear angle between edge and counter-knife", OWN
_in_cut(motion, "cut_speed", "v_c", "m/s", "Speed of the cutting point along the counter-knife",
        m.speed * m.eccentricity * np.cos(m.cut_place + m.shear_angle) / np.sin(m.shear_angle), source="kinematics")
_in_cut(motion, "sliding_ratio", "k", "1", "Sliding ratio: speed of the edge along itself divided by its normal speed",
        sliding_ratio.of(angle=m.cut_place))
motion.cut_speed_max = reduction("max", of="cut_speed"), "v_c,max", "m/s", "Maximum speed of the cutting point", "kinematics"
motion.sliding_ratio_max = reduction("max", of="sliding_ratio"), "k_max", "1", "Maximum sliding ratio", OWN
motion.effective_sharpening_angle_min = (np.arctan(np.tan(m.sharpening_angle) * np.cos(np.arctan(m.sliding_ratio_max))), "δ_e", "deg",
    "Minimum effective sharpening angle, in the direction of motion", OWN)

forces = Chapter("Force and torque",
    text="Over the length a of the working front the board is partly cut through; the edge bows out of its chord by the area A_b. Each millimetre "
        "of the edge in the board carries σ times the thickness still to be cut, normal to the edge: σ·h where it enters, nothing where the board "
        "is cut through. Each unit of area cut therefore takes the work σ·h/2. The resultants of these loads are F_w downwards and F_h along the "
        "cut; the loads all point to the edge's centre, and their torque about the shaft is M_u. By virtual work, M_u·dφ is the sum of the loads "
        "times the distances by which they move the edge into the board, and F_w·dy the same if the knife sinks by dy. F_v uses the thickness "
        "already passed instead of that left. For a straight edge both are σ·h²/(2·tan τ); for this edge F_v is greater by 2·σ·A_b. The maximum "
        "force, the ratio to a guillotine and the friction are calculated with F_v, on the safe side; the work of cutting belongs to F_w. Both "
        "areas are integrals over the board's thickness, in closed form by the segment of the edge's arc.")
forces.face_angle = inner(edge_slope.of(angle=m.cut_place, depth=m.face_depth)), "τ_h", "deg", "Slope of the edge in the board's upper face", OWN
forces.front_half_angle = inner((m.face_angle - m.shear_angle) / 2), "α", "deg", "Half the angle of the working front", OWN
_in_cut(forces, "front_length", "a", "mm", "Length of the working front", front_length.of(), output=False)
forces.bow_area = (inner(circular_segment.area.of(radius=m.edge_radius, half_angle=m.front_half_angle)), "A_b", "mm**2",
    "Area between the working front and its chord", OWN)
_in_cut(forces, "force", "F_v", "N", "Downward force on the board", force.of(), source=OWN)
_in_cut(forces, "working_force", "F_w", "N", "Downward force by virtual work",
        m.shear_resistance * (m.thickness * m.front_length / 2 - m.bow_area),
        source="energy", output=False)
forces.thrust = m.shear_resistance * m.thickness**2 / 2, "F_h", "N", "Force along the cut by virtual work", "energy"
_in_cut(forces, "useful_torque", "M_u", "N*m", "Torque of cutting",
        m.eccentricity * (m.working_force * np.cos(m.cut_place) - m.thrust * np.sin(m.cut_place)), source="statics", output=False)
_in_cut(forces, "friction_torque", "M_f", "N*m", "Torque of friction", friction_torque.of(angle=m.cut_place), source=OWN)
forces.torque = m.useful_torque + m.friction_torque, "M", "N*m", "Torque at the knife's shaft", "statics"
forces.front_length_max = reduction("max", of="front_length"), "a_max", "mm", "Maximum length of the working front", OWN
forces.force_max = reduction("max", of="force"), "F_max", "N", "Maximum downward force on the board", OWN
forces.working_force_max = reduction("max", of="working_force"), "F_w,max", "N", "Maximum downward force by virtual work", "energy"
forces.torque_max = reduction("max", of="torque"), "M_max", "N*m", "Maximum torque at the knife's shaft", "statics"
forces.useful_work = reduction("integral", of="useful_torque"), "W_u", "J", "Work of cutting, from φ_1 to φ_2", "energy"
forces.work = reduction("integral", of="torque"), "W", "J", "Work of a cut, with friction", "energy"
forces.power_mean = m.work * m.speed / (2 * pi), "P_mean", "W", "Mean power over a revolution with one cut", "energy"
forces.power_peak = m.torque_max * m.speed, "P_max", "W", "Maximum power", "energy"

guillotine = Chapter("Comparison with a guillotine",
    text="A straight blade parallel to the counter-knife cuts the same length at once. Its work differs slightly from the work of cutting W_u: at "
        "φ_1 part of the board is already cut into, and at φ_2 the edge has cut into it beyond the end.")
guillotine.guillotine_force = m.shear_resistance * m.thickness * m.cut_length, "F_g", "N", "Force of a guillotine for the same length of cut", OWN
guillotine.guillotine_work = m.guillotine_force * m.thickness / 2, "W_g", "J", "Its work, without friction", "energy"
guillotine.guillotine_force_ratio = m.force_max / m.guillotine_force, "q_F", "1", "Ratio of the maximum force to that of a guillotine", OWN
guillotine.guillotine_line_force = m.shear_resistance * m.thickness, "q_σ", "N/mm", "Force of a straight cut per length, by the shear resistance", OWN
guillotine.resistance_by_rule = (value(m.rule_force / m.thickness, needs=("rule_force",)), "σ_q", "N/mm**2",
    "Shear resistance corresponding to the force of the rule", OWN)
