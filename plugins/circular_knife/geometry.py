"""Chapters on what the edge reaches, and on the range of the cut."""

from __future__ import annotations

from diecut_report.api import Case, Chapter, Choice, Require, Root, Value, Words, bind
from diecut_report.mechanics import common
from diecut_report.plugins.circular_knife import advice
from diecut_report.plugins.circular_knife import formulas as f

OWN = "this method"

REACH = Chapter(
    "What the edge reaches",
    text="The formulas of this calculation are its own. Of the source (001, third paper) only the first page survives: it gives the arrangement "
    "and its parameters r, R, δ, b and h, not its formulas; these are derived here from that geometry. The shaft's axis is the origin; x runs "
    "along the counter-knife, depths point down, and the knife angle φ turns clockwise from the direction of the cut to the edge's centre.",
    steps=(
        Require(id="edge_round_shaft", condition=bind(common.is_below, smaller="eccentricity", greater="edge_radius"), key="edge_radius",
                message="is {edge_radius}, but the edge must lie around the shaft: R > r = {eccentricity}; make the edge's radius greater or the "
                "eccentricity smaller"),
        Value(id="depth_least", symbol="H_min", unit="mm", description="Depth that the counter-knife must exceed, else the edge never leaves it",
              source=OWN, output=False, formula=bind(common.difference, greater="edge_radius", smaller="eccentricity")),
        Value(id="depth_greatest", symbol="H_max", unit="mm", description="Greatest depth of the edge", source=OWN, output=False,
              formula=bind(common.sum_of, first="edge_radius", second="eccentricity")),
        Require(id="edge_leaves", condition=bind(f.is_clear_of, smaller="depth_least", greater="depth"), key="depth",
                message="is {depth}, but the edge would stay below the counter-knife over the whole turn: more than R − r = {depth_least:up} is "
                "needed; put the counter-knife lower, or make the edge's radius smaller or the eccentricity greater"),
        Require(id="edge_arrives", condition=bind(f.is_clear_of, smaller="depth", greater="depth_greatest"), key="depth",
                message="is {depth}, but the edge never gets down to the counter-knife: less than R + r = {depth_greatest:down} is needed; put "
                "the counter-knife higher, or make the edge's radius or the eccentricity greater"),
        Require(id="board_below_axis", condition=bind(common.is_below, smaller="thickness", greater="depth"), key="thickness",
                message="is {thickness}, but the board's upper face would lie above the shaft's axis: h < H = {depth} is needed; take a thinner "
                "board or put the counter-knife lower"),
        Require(id="board_thick", condition=bind(f.is_thick_enough), key="thickness",
                message="is {thickness}, but at least a millionth of the edge's radius R = {edge_radius} is needed; look at the unit of both"),
        Value(id="face_depth", symbol="H_h", unit="mm", description="Depth of the board's upper face", source="geometry", output=False,
              formula=bind(common.difference, greater="depth", smaller="thickness")),
        Value(id="reach_greatest", symbol="x_max", unit="mm", description="Greatest distance from the axis to which the edge cuts through",
              source=OWN, formula=f.reach),
        Value(id="cut_end", symbol="x_2", unit="mm", description="Distance of the cut's end from the axis", source="geometry", output=False,
              formula=bind(common.sum_of, first="front_distance", second="cut_length")),
        Words(id="reach_advice", function=advice.reach_advice, takes=advice.SIZES),
        Require(id="reaches_board", condition=bind(f.is_clear_of, smaller="front_distance", greater="reach_greatest"), key="front_distance",
                message="is {front_distance}, but the edge cannot reach the board: it cuts no further than √((R + r)² − H²) = {reach_greatest} "
                "from the axis; {reach_advice}. A higher counter-knife, a greater edge radius or a greater eccentricity reaches further"),
        Require(id="reaches_end", condition=bind(f.reaches_end), key="cut_length",
                message="is {cut_length}, so that the cut ends b + L = {cut_end} from the axis, but the edge cannot reach that: it cuts no "
                "further than √((R + r)² − H²) = {reach_greatest}; {reach_advice}. A higher counter-knife, a greater edge radius or a greater "
                "eccentricity reaches further"),
        Value(id="lowest_at_face", symbol="x_h", unit="mm", description="Distance from the axis at which the edge's lowest point passes the "
              "board's upper face",
              source=OWN, output=False, formula=bind(f.lowest_passes, depth="face_depth")),
        Value(id="lowest_at_counter", symbol="x_0", unit="mm", description="The same at the counter-knife", source=OWN, output=False,
              formula=bind(f.lowest_passes, depth="depth")),
        Words(id="entering_advice", function=advice.entering_advice, takes=advice.SIZES[:4]),
        Require(id="enters_face", condition=bind(common.is_at_most, smaller="lowest_at_face", greater="front_distance"), key="front_distance",
                message="is {front_distance}, but the edge would come down on the board from above, {lowest_at_face} from the axis, and press it "
                "instead of shearing it from its front edge: b ≥ √(r² − (H − h − R)²) is needed; {entering_advice}"),
        Require(id="enters_counter", condition=bind(f.enters_counter), key="front_distance",
                message="is {front_distance}, but the edge would meet the counter-knife behind the board's front edge, {lowest_at_counter} from "
                "the axis: b > √(r² − (H − R)²) is needed; {entering_advice}"),
    ),
)  # fmt: skip


def _at_distance(name: str, symbol: str, description: str, distance: str) -> Root:
    """The knife angle at which the cutting point is at a distance from the axis."""
    return Root(
        id=name,
        symbol=symbol,
        unit="deg",
        description=description,
        source=OWN,
        digits=6,
        equation=bind(f.past_centre, angle=name, distance=distance),
        unknown=name,
        low=bind(common.same, quantity="touch_angle"),
        high=bind(common.same, quantity="return_angle"),
        left=bind(f.from_centre_squared, angle=name, distance=distance),
        right=bind(f.squared, length="edge_radius"),
    )


RANGE = Chapter(
    "Range of the cut",
    text="From φ_0, where the edge touches the counter-knife, to φ_r, where the line from the axis through the edge's centre passes the cutting "
    "point, this point runs forward only; the cut lies in between. The shear angle grows all the way, as cos τ = (H − r·sin φ)/R falls there.",
    steps=(
        Value(id="touch_angle", symbol="φ_0", unit="deg", description="Knife angle at which the edge touches the counter-knife", source=OWN,
              output=False, formula=f.touching_angle),
        Value(id="return_angle", symbol="φ_r", unit="deg", description="Knife angle at which the cutting point turns back", source=OWN, output=False,
              formula=f.reversal_angle),
        _at_distance("angle_start", "φ_1", "Knife angle at the start of the cut", "front_distance"),
        _at_distance("angle_end", "φ_2", "Knife angle at the end of the cut", "cut_end"),
        Value(id="cut_angle", symbol="Δφ", unit="deg", description="Angle of the cut", source="kinematics",
              formula=bind(common.difference, greater="angle_end", smaller="angle_start")),
        Value(id="cut_time", symbol="t", unit="ms", description="Time of the cut", source="kinematics", formula=bind(f.elapsed, angle="cut_angle")),
        Value(id="shear_angle_min", symbol="τ_min", unit="deg", description="Least shear angle: at the start of the cut", source=OWN,
              formula=bind(f.edge_slope, angle="angle_start")),
        Value(id="shear_angle_max", symbol="τ_max", unit="deg", description="Greatest shear angle: at the end of the cut", source=OWN,
              formula=bind(f.edge_slope, angle="angle_end")),
        Words(id="shear_advice", function=advice.shear_advice, takes=("shear_angle_min", "shear_angle_max", *advice.SIZES)),
        Value(id="shear_angle_lower", symbol="τ_a", unit="deg", description="Least shear angle that is usual", source="practice", output=False,
              formula=f.least_shear_angle),
        Value(id="shear_angle_upper", symbol="τ_b", unit="deg", description="Greatest shear angle that is usual", source="practice", output=False,
              formula=f.greatest_shear_angle),
        *(Choice(id=name, symbol=symbol, unit="deg", description=description, output=False,
                 cases=(Case(bind(common.same, quantity=above), "the greatest angle comes nearer to its limit",
                             bind(f.upper_side_governs, greatest="shear_angle_max", upper="shear_angle_upper", lower="shear_angle_lower",
                                  least="shear_angle_min")),
                        Case(bind(common.same, quantity=below), "the least angle comes nearer to its limit")))
          for name, symbol, description, above, below in (
              ("shear_demand", "τ_d", "Governing side of the shear angle: what is there, or the least required", "shear_angle_max",
              "shear_angle_lower"),
              ("shear_limit", "τ_l", "Its limit: the greatest allowed, or the least there is", "shear_angle_upper", "shear_angle_min"))),
        Value(id="expulsion_angle", symbol="τ_f", unit="deg", description="Shear angle from which the board is pushed out", source="statics",
              formula=f.expulsion_angle),
        Words(id="expulsion_advice", function=advice.expulsion_advice, takes=("shear_angle_max", *advice.SIZES)),
    ),
)  # fmt: skip

EDGE = Chapter(
    "Edge",
    text="The edge meets the board first at its upper front edge, at φ_e, a little before the cutting point gets to the front edge. Places on the "
    "edge are counted from the line shaft–centre, as seen from the edge's centre. The arc between ψ_1 and ψ_2 must be sharp; it is longer than the "
    "cut, for the edge slides through the board. The edge's point in the upper face turns back a little before the cutting point does.",
    steps=(
        Value(id="corner_distance", symbol="D", unit="mm", description="Distance of the board's upper front edge from the axis", source="geometry",
              output=False, formula=bind(f.distance_of, along="front_distance", down="face_depth")),
        Value(id="angle_entry", symbol="φ_e", unit="deg", description="Knife angle at which the edge meets the board", source=OWN,
              formula=bind(f.meeting_angle, corner="corner_distance")),
        Value(id="edge_angle_first", symbol="ψ_1", unit="deg", description="Place on the edge that meets the board first", source=OWN,
              formula=bind(f.meeting_place, corner="corner_distance")),
        Value(id="face_angle_end", symbol="τ_h2", unit="deg", description="Slope of the edge in the board's upper face at the end of the cut",
              source=OWN, output=False, formula=bind(f.edge_slope, angle="angle_end", depth="face_depth")),
        Value(id="edge_angle_last", symbol="ψ_2", unit="deg", description="Place on the edge that cuts last", source=OWN,
              formula=bind(f.place_on_edge, angle="angle_end", edge_slope="face_angle_end")),
        Value(id="edge_length", symbol="s", unit="mm", description="Length of the edge that cuts", source=OWN,
              formula=bind(f.arc_between, first="edge_angle_first", last="edge_angle_last")),
        Value(id="face_return_angle", symbol="φ_rh", unit="deg", description="Knife angle at which the edge's point in the board's upper face "
              "turns back",
              source=OWN, output=False, formula=bind(f.reversal_angle, depth="face_depth")),
        Value(id="used_sweep", symbol="Δφ_2", unit="deg", description="Turn of the knife from touching the counter-knife to the end of the cut",
              source="kinematics", output=False, formula=bind(common.difference, greater="angle_end", smaller="touch_angle")),
        Value(id="usable_sweep", symbol="Δφ_r", unit="deg", description="Turn up to which the edge runs forward in the whole thickness",
              source="kinematics", output=False, formula=bind(common.difference, greater="face_return_angle", smaller="touch_angle")),
        Words(id="return_advice", function=advice.return_advice, takes=advice.SIZES),
    ),
)  # fmt: skip
