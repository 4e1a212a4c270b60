"""The calculation of the impression cylinder, chapter by chapter."""

from __future__ import annotations

from diecut_report.api import Case, Chapter, Choice, Require, Root, Value, bind
from diecut_report.mechanics import circular_segment as segment
from diecut_report.mechanics import common
from diecut_report.plugins.cylinder_sizing import formulas as f

SIZE = Chapter(
    "Radius",
    text="The unrolled circumference is the working length and the arc of the segment: 2πR = l_1 + l_2 (002 eq. 1). "
    "The closed form takes Huygens' arc; the adopted radius is judged by the exact one.",
    steps=(
        Value(id="segment_height_limit", symbol="h_lim", unit="mm", description="Segment height from which no radius exists",
              formula=f.segment_height_limit, output=False),
        Require(id="radius_exists", condition=bind(common.is_below, smaller="segment_height", greater="segment_height_limit"),
                key="segment_height",
                message="is {segment_height}, but no cylinder with a working length of {working_length} has a segment that high: "
                "h < l_1/π = {segment_height_limit} is needed; make the segment lower or the working length greater"),
        Value(id="radius_closed_form", symbol="R_cf", unit="mm", description="Radius by the closed form", source="002 eq. 6",
              formula=f.radius_closed_form, digits=6),
        Root(id="radius_exact", symbol="R_ex", unit="mm", description="Exact radius", source="002 eq. 1", digits=6,
             equation=bind(f.height_mismatch, radius="radius_exact"), unknown="radius_exact",
             low=bind(f.least_radius), high=bind(f.segment_height_limit),
             left=bind(f.beside_the_flat, radius="radius_exact"), right=bind(f.arc_of_segment, radius="radius_exact")),
        Value(id="radius_closed_form_error", symbol="e_cf", unit="%", description="Error of the closed form against the exact radius",
              formula=bind(f.relative_error, approximate="radius_closed_form", exact="radius_exact")),
        Value(id="closed_form_error_size", symbol="|e_cf|", unit="%", description="Size of that error", output=False,
              formula=bind(common.size_of, quantity="radius_closed_form_error")),
        Value(id="radius", symbol="R", unit="mm", description="Adopted radius: as given", needs=("radius",), source="input",
              formula=bind(common.same, quantity="inputs.radius")),
        Value(id="radius", symbol="R", unit="mm", description="Adopted radius: the exact one rounded up to the step",
              lacks=("radius",), formula=bind(common.rounded_up, quantity="radius_exact", step="radius_step")),
        Require(id="segment_below_radius", condition=bind(common.is_below, smaller="segment_height", greater="radius"),
                key="segment_height",
                message="is {segment_height}, but the segment must be lower than the radius: h < R = {radius}"),
        Require(id="bore_below_radius", condition=bind(common.is_below, smaller="bore_radius", greater="radius"), key="bore_radius",
                message="is {bore_radius}, but the bore must be narrower than the cylinder: 0 ≤ R_b < R = {radius}"),
    ),
)  # fmt: skip

FLAT = Chapter(
    "Segment and flat",
    text="All geometry uses the adopted radius.",
    steps=(
        Value(id="chord", symbol="c", unit="mm", description="Chord: width of the flat", source="002 eq. 3; 000 eq. 16",
              formula=bind(segment.chord, height="segment_height")),
        Value(id="half_angle", symbol="α", unit="deg", description="Half the central angle of the segment", output=False,
              formula=bind(segment.half_angle, height="segment_height")),
        Value(id="segment_angle", symbol="2α", unit="deg", description="Central angle of the segment",
              formula=bind(common.twice, quantity="half_angle")),
        Value(id="arc_length", symbol="l_2", unit="mm", description="Arc of the segment, exactly", source="002 eq. 1",
              formula=segment.arc_length),
        Value(id="arc_length_huygens", symbol="l_2H", unit="mm", description="Arc of the segment by Huygens",
              source="002 eq. 2, 4; 000 eq. 15", formula=bind(segment.arc_length_huygens, height="segment_height")),
        Value(id="segment_area", symbol="A", unit="mm**2", description="Area of the segment", source="000, before eq. 17",
              formula=segment.area),
        Value(id="centroid_distance", symbol="ρ", unit="mm", description="Distance of the segment's centroid from the axis",
              source="000 eq. 17", formula=bind(segment.centroid_distance, area="segment_area")),
        Value(id="flat_distance", symbol="d", unit="mm", description="Distance of the flat from the axis", output=False,
              formula=bind(common.difference, greater="radius", smaller="segment_height")),
        Value(id="wall_at_flat", symbol="w", unit="mm", description="Wall between bore and flat", formula=f.wall_at_flat),
        Choice(id="wall_verdict", symbol="w", description="What the wall is", output=False,
               cases=(Case("the bore breaks through the flat", "R_b ≥ R − h",
                           bind(common.is_at_most, smaller="flat_distance", greater="bore_radius")),
                      Case("the wall is closed, but thinner than required", "w < w_min",
                           bind(common.is_below, smaller="wall_at_flat", greater="min_wall")),
                      Case("the wall is thick enough", "w ≥ w_min"))),
        Value(id="bore_radius_limit", symbol="R_b,max", unit="mm", description="Bore radius that keeps the required wall",
              output=False, formula=f.bore_radius_limit),
        Value(id="cutting_arc_fraction", symbol="κ", description="Share of the circumference that is not flat",
              formula=f.round_share),
    ),
)  # fmt: skip

OVERLAP = Chapter(
    "Overlap of bore and segment",
    text="Where the bore reaches beyond the flat, bore and segment share a smaller segment of the bore's circle; "
    "it is taken away once only.",
    steps=(
        Choice(id="overlap_half_angle", symbol="α_b", unit="deg", description="Half the angle of the bore beyond the flat", output=False,
               cases=(Case(f.overlap_half_angle, "the bore breaks through the flat",
                           bind(common.is_below, smaller="flat_distance", greater="bore_radius")),
                      Case(bind(common.zero), "the bore stays behind the flat: no overlap"))),
        Value(id="overlap_chord", symbol="c_b", unit="mm", description="Width of the opening in the flat", output=False,
              formula=bind(segment.chord_of_angle, radius="bore_radius", half_angle="overlap_half_angle")),
        Value(id="overlap_area", symbol="A_b", unit="mm**2", description="Area of the overlap", output=False,
              formula=bind(segment.area, radius="bore_radius", half_angle="overlap_half_angle")),
    ),
)  # fmt: skip

MASS = Chapter(
    "Masses",
    steps=(
        Value(id="solid_mass", symbol="m′", unit="kg", description="Mass of the full cylinder", source="000 eq. 13, 17",
              formula=bind(f.disc_mass, length="generatrix_length")),
        Value(id="segment_mass", symbol="m_1", unit="kg", description="Mass of the segment", source="000 eq. 14",
              formula=bind(f.prism_mass, area="segment_area", length="generatrix_length")),
        Value(id="bore_mass", symbol="m_2", unit="kg", description="Mass that the bore takes away", source="000, after eq. 16",
              formula=bind(f.disc_mass, radius="bore_radius", length="generatrix_length")),
        Value(id="overlap_mass", symbol="m_12", unit="kg", description="Mass of the overlap", source="this method",
              formula=bind(f.prism_mass, area="overlap_area", length="generatrix_length")),
        Value(id="mass", symbol="m", unit="kg", description="Mass of the cylinder", source="000 eq. 13, overlap once only",
              formula=f.net_mass),
    ),
)  # fmt: skip

INERTIA = Chapter(
    "Moment of inertia and unbalance",
    text="The moment of inertia about the cylinder's axis is exact; the source's formula stands beside it for comparison.",
    steps=(
        Value(id="inertia_solid", symbol="I_s", unit="kg*m**2", description="Inertia of the full cylinder", output=False,
              formula=bind(f.disc_inertia, length="generatrix_length")),
        Value(id="segment_polar", symbol="J_1", unit="cm**4", description="Polar second moment of the segment about the axis", output=False,
              formula=bind(segment.polar_second_moment, distance="flat_distance")),
        Value(id="inertia_segment", symbol="I_1", unit="kg*m**2", description="Inertia of the segment", output=False,
              formula=bind(f.prism_inertia, polar_second_moment="segment_polar", length="generatrix_length")),
        Value(id="inertia_bore", symbol="I_2", unit="kg*m**2", description="Inertia that the bore takes away", output=False,
              formula=bind(f.disc_inertia, radius="bore_radius", length="generatrix_length")),
        Value(id="overlap_distance", symbol="d_b", unit="mm", description="Distance of the overlap's chord from the axis", output=False,
              formula=bind(f.foot, radius="bore_radius", half_angle="overlap_half_angle")),
        Value(id="overlap_polar", symbol="J_12", unit="cm**4", description="Polar second moment of the overlap about the axis", output=False,
              formula=bind(segment.polar_second_moment, radius="bore_radius", distance="overlap_distance",
                           half_angle="overlap_half_angle")),
        Value(id="inertia_overlap", symbol="I_12", unit="kg*m**2", description="Inertia of the overlap", output=False,
              formula=bind(f.prism_inertia, polar_second_moment="overlap_polar", length="generatrix_length")),
        Value(id="inertia", symbol="I", unit="kg*m**2", description="Moment of inertia of the cylinder about its axis",
              source="exact; 000 eq. 17 corrected",
              formula=bind(f.net_inertia, solid="inertia_solid", segment="inertia_segment", bore="inertia_bore",
                           overlap="inertia_overlap")),
        Value(id="inertia_source", symbol="I_000", unit="kg*m**2", description="The same by the source's formula", source="000 eq. 17",
              formula=f.inertia_source),
        Value(id="static_unbalance", symbol="me", unit="kg*m", description="Static unbalance", source="this method",
              formula=bind(f.static_unbalance, length="generatrix_length")),
        Value(id="center_of_mass_offset", symbol="e", unit="mm", description="Offset of the centre of mass, away from the flat",
              source="this method", formula=f.center_of_mass_offset),
    ),
)  # fmt: skip

BENDING = Chapter(
    "Bending under the line load",
    needs=("bearing_span",),
    absent="not calculated: bearing_span is not given",
    text="The section is weakest about one of its two principal axes, which lie parallel and square to the flat.",
    steps=(
        Require(id="span_over_generatrix", condition=bind(common.is_at_most, smaller="generatrix_length", greater="bearing_span"),
                key="bearing_span",
                message="is {bearing_span}, but the bearings stand outside the generatrix: at least {generatrix_length} is needed"),
        Value(id="segment_second_moment", symbol="I_x1", unit="cm**4", output=False,
              description="Second moment of the segment about the diameter parallel to the flat",
              formula=segment.second_moment_along_chord),
        Value(id="overlap_second_moment", symbol="I_x12", unit="cm**4", output=False, description="The same of the overlap",
              formula=bind(segment.second_moment_along_chord, radius="bore_radius", half_angle="overlap_half_angle")),
        Value(id="second_moment_parallel", symbol="I_x", unit="cm**4", output=False,
              description="Second moment about the centroid's axis parallel to the flat",
              formula=bind(f.second_moment_bending_flat, segment="segment_second_moment", overlap="overlap_second_moment",
                           length="generatrix_length", offset="center_of_mass_offset")),
        Value(id="second_moment_square", symbol="I_y", unit="cm**4", output=False,
              description="Second moment about the axis of symmetry, square to the flat",
              formula=bind(f.second_moment_across_flat, segment="segment_second_moment", overlap="overlap_second_moment",
                           length="generatrix_length")),
        Value(id="second_moment_min", symbol="I_min", unit="cm**4", description="Least second moment of the section",
              formula=bind(common.smaller_of, first="second_moment_parallel", second="second_moment_square")),
        Value(id="bearing_load", symbol="F_b", unit="kN", description="Load on each bearing from the line load",
              formula=bind(f.bearing_load, length="generatrix_length")),
        Value(id="bending_moment", symbol="M_b", unit="N*m", description="Greatest bending moment",
              formula=bind(f.bending_moment, length="generatrix_length", span="bearing_span")),
        Value(id="deflection", symbol="f", unit="mm", description="Bending deflection in the middle",
              formula=bind(f.deflection, length="generatrix_length", span="bearing_span", second_moment="second_moment_min")),
    ),
)  # fmt: skip

SECTIONS = (SIZE, FLAT, OVERLAP, MASS, INERTIA, BENDING)
