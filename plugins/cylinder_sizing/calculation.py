"""The calculation of the impression cylinder, chapter by chapter."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
    Annotated,
    BarGroup,
    Bars,
    Chapter,
    Drawing,
    Inputs,
    Point,
    Quantity,
    Shape,
    View,
    arccos,
    as_angle,
    as_number,
    bind,
    case,
    circle,
    dimension,
    formula,
    label,
    pi,
    point,
    polyline,
    radius_dimension,
    region,
)
from diecut_report.mechanics import circular_segment as segment
from diecut_report.mechanics import common

# fmt: off


class CylinderSizing(Inputs):
    """Keys of ``cylinder_sizing``."""

    working_length: Annotated[float, Quantity("l_1", "mm", "Working length: the shorter side of the sheet format", gt=0)]
    segment_height: Annotated[float, Quantity("h", "mm", "Height of the segment that is cut away (below the radius)", gt=0)]
    generatrix_length: Annotated[float, Quantity("L", "mm", "Length of the cylinder's generatrix", gt=0)]
    bore_radius: Annotated[float, Quantity("R_b", "mm", "Radius of the bore (below the radius)", ge=0)] = 0
    density: Annotated[float, Quantity("γ", "kg/m**3", "Density of the cylinder material", gt=0)] = 7800
    radius: Annotated[float | None, Quantity("R", "mm", "Radius of the cylinder; if given, it is checked instead of sized", gt=0)] = None
    radius_step: Annotated[float, Quantity("s_R", "mm", "Step to which the sized radius is rounded up", gt=0)] = 0.5
    min_wall: Annotated[float, Quantity("w_min", "mm", "Minimum wall between bore and flat", ge=0)] = 5
    bearing_span: Annotated[float | None,
        Quantity("a", "mm", "Span of the bearings (at least the generatrix); required for the bending", gt=0)] = None
    elastic_modulus: Annotated[float, Quantity("E", "GPa", "Elastic modulus of the cylinder's material", gt=0)] = 210
    line_load: Annotated[float, Quantity("q", "N/mm", "Line load on the generatrix: cutting and ejection (000)", ge=0)] = 30
    allowable_deflection: Annotated[float | None, Quantity("[f]", "mm", "Allowable bending deflection", gt=0)] = None


size = Chapter("Radius",
    text="The unrolled circumference is the working length plus the arc of the segment: 2πR = l_1 + l_2 (002 eq. 1). The closed-form approximation "
        "uses Huygens' arc; the adopted radius is checked against the exact one.")


@formula
def radius_by_huygens(working_length: Any, segment_height: Any) -> Any:
    """Radius with Huygens' arc; the other root of the quadratic gives a negative arc."""
    root = np.sqrt(12 * segment_height * (3 * segment_height + 3 * pi * working_length + pi**2 * segment_height))
    return (6 * segment_height + 3 * pi * working_length + root) / (6 * pi**2)


size.value("segment_height_limit", "h_lim", "mm", "Segment height from which no radius exists", lambda working_length: working_length / pi,
    output=False)
size.require("radius_exists", lambda segment_height, segment_height_limit: segment_height < segment_height_limit, key="segment_height",
    message="is {segment_height}, but no cylinder with a working length of {working_length} has a segment that high: h < l_1/π = "
        "{segment_height_limit} is needed; make the segment lower or the working length greater")
size.value("radius_closed_form", "R_cf", "mm", "Radius by the closed-form approximation", radius_by_huygens, source="002 eq. 6", digits=6)
size.root("radius_exact", "R_ex", "mm", "Exact radius", lambda radius_exact, working_length, segment_height:
        radius_exact * (1 - np.cos(pi - as_angle(working_length / (2 * radius_exact)))) - segment_height,
    low=lambda working_length, segment_height: np.maximum(segment_height, working_length / (2 * pi)),
    high=lambda working_length: working_length / pi, left=lambda radius_exact, working_length: 2 * pi * radius_exact - working_length,
    right=lambda radius_exact, segment_height: 2 * radius_exact * arccos((radius_exact - segment_height) / radius_exact), source="002 eq. 1",
    digits=6)
size.value("radius_closed_form_error", "e_cf", "%", "Error of the closed-form approximation against the exact radius",
    lambda radius_closed_form, radius_exact: radius_closed_form / radius_exact - 1)
size.value("closed_form_error_size", "|e_cf|", "%", "Absolute value of this error", lambda radius_closed_form_error: abs(radius_closed_form_error),
    output=False)
size.value("radius", "R", "mm", "Adopted radius: as given", bind(common.same, quantity="inputs.radius"), needs=("radius",), source="input")
size.value("radius", "R", "mm", "Adopted radius: the exact one rounded up to the step",
    bind(common.rounded_up, quantity="radius_exact", step="radius_step"), lacks=("radius",))
size.require("segment_below_radius", lambda segment_height, radius: segment_height < radius, key="segment_height",
    message="is {segment_height}, but the segment must be lower than the radius: h < R = {radius}")
size.require("bore_below_radius", lambda bore_radius, radius: bore_radius < radius, key="bore_radius",
    message="is {bore_radius}, but the bore must be narrower than the cylinder: 0 ≤ R_b < R = {radius}")


flat = Chapter("Segment and flat", text="All geometry uses the adopted radius.")
flat.value("chord", "c", "mm", "Chord: width of the flat", bind(segment.chord, height="segment_height"), source="002 eq. 3; 000 eq. 16")
flat.value("half_angle", "α", "deg", "Half the central angle of the segment", bind(segment.half_angle, height="segment_height"), output=False)
flat.value("segment_angle", "2α", "deg", "Central angle of the segment", lambda half_angle: 2 * half_angle)
flat.value("arc_length", "l_2", "mm", "Arc of the segment, exactly", lambda radius, half_angle: 2 * radius * half_angle, source="002 eq. 1")
flat.value("arc_length_huygens", "l_2H", "mm", "Arc of the segment by Huygens", bind(segment.arc_length_huygens, height="segment_height"),
    source="002 eq. 2, 4; 000 eq. 15")
flat.value("segment_area", "A", "mm**2", "Area of the segment", segment.area, source="000, before eq. 17")
flat.value("centroid_distance", "ρ", "mm", "Distance of the segment's centroid from the axis",
    lambda chord, segment_area: chord**3 / (12 * segment_area), source="000 eq. 17")
flat.value("flat_distance", "d", "mm", "Distance of the flat from the axis", lambda radius, segment_height: radius - segment_height, output=False)
flat.value("wall_at_flat", "w", "mm", "Wall between bore and flat", lambda radius, segment_height, bore_radius: radius - segment_height - bore_radius)
flat.choice("wall_verdict", "w", "1", "Condition of the wall",
    case("the bore breaks through the flat", "the bore reaches the flat", lambda flat_distance, bore_radius: flat_distance <= bore_radius),
    case("the wall is closed, but thinner than required", "the wall is less than the required one",
        lambda wall_at_flat, min_wall: wall_at_flat < min_wall), case("the wall is thick enough", "the wall is at least the required one"),
    output=False)
flat.value("cutting_arc_fraction", "κ", "1", "Fraction of the circumference that is not flat", lambda half_angle: 1 - half_angle / pi)

overlap = Chapter("Overlap of bore and segment",
    text="Where the bore reaches beyond the flat, bore and segment share a smaller segment of the bore's circle; it is subtracted only once.")
overlap.choice("overlap_half_angle", "α_b", "deg", "Half the angle of the bore beyond the flat",
    case(lambda flat_distance, bore_radius: arccos(flat_distance / bore_radius), "the bore breaks through the flat",
        lambda flat_distance, bore_radius: flat_distance < bore_radius), case(lambda: 0, "the bore stays behind the flat: no overlap"), output=False)
overlap.value("overlap_chord", "c_b", "mm", "Width of the opening in the flat",
    lambda bore_radius, overlap_half_angle: 2 * bore_radius * np.sin(overlap_half_angle), output=False)
overlap.value("overlap_area", "A_b", "mm**2", "Area of the overlap", bind(segment.area, radius="bore_radius", half_angle="overlap_half_angle"),
    output=False)

masses = Chapter("Masses")
masses.value("solid_mass", "m′", "kg", "Mass of the full cylinder",
    lambda radius, generatrix_length, density: as_number(pi) * radius**2 * generatrix_length * density, source="000 eq. 13, 17")
masses.value("segment_mass", "m_1", "kg", "Mass of the segment",
    lambda segment_area, generatrix_length, density: segment_area * generatrix_length * density, source="000 eq. 14")
masses.value("bore_mass", "m_2", "kg", "Mass removed by the bore",
    lambda bore_radius, generatrix_length, density: as_number(pi) * bore_radius**2 * generatrix_length * density, source="000, after eq. 16")
masses.value("overlap_mass", "m_12", "kg", "Mass of the overlap",
    lambda overlap_area, generatrix_length, density: overlap_area * generatrix_length * density, source="this method")
masses.value("mass", "m", "kg", "Mass of the cylinder",
    lambda solid_mass, segment_mass, bore_mass, overlap_mass: solid_mass - segment_mass - bore_mass + overlap_mass,
    source="000 eq. 13, overlap once only")

inertia = Chapter("Moment of inertia and unbalance",
    text="The moment of inertia about the cylinder's axis is exact; the result of the source's formula is given for comparison.")
inertia.value("inertia_solid", "I_s", "kg*m**2", "Inertia of the full cylinder",
    lambda density, generatrix_length, radius: density * generatrix_length * pi * radius**4 / 2, output=False)
inertia.value("segment_polar", "J_1", "cm**4", "Polar second moment of the segment about the axis",
    bind(segment.polar_second_moment, distance="flat_distance"), output=False)
inertia.value("inertia_segment", "I_1", "kg*m**2", "Inertia of the segment",
    lambda density, generatrix_length, segment_polar: density * generatrix_length * segment_polar, output=False)
inertia.value("inertia_bore", "I_2", "kg*m**2", "Inertia removed by the bore",
    lambda density, generatrix_length, bore_radius: density * generatrix_length * pi * bore_radius**4 / 2, output=False)
inertia.value("overlap_distance", "d_b", "mm", "Distance of the overlap's chord from the axis",
    lambda bore_radius, overlap_half_angle: bore_radius * np.cos(overlap_half_angle), output=False)
inertia.value("overlap_polar", "J_12", "cm**4", "Polar second moment of the overlap about the axis",
    bind(segment.polar_second_moment, radius="bore_radius", distance="overlap_distance", half_angle="overlap_half_angle"), output=False)
inertia.value("inertia_overlap", "I_12", "kg*m**2", "Inertia of the overlap",
    lambda density, generatrix_length, overlap_polar: density * generatrix_length * overlap_polar, output=False)
inertia.value("inertia", "I", "kg*m**2", "Moment of inertia of the cylinder about its axis",
    lambda inertia_solid, inertia_segment, inertia_bore, inertia_overlap: inertia_solid - inertia_segment - (inertia_bore - inertia_overlap),
    source="exact; 000 eq. 17 corrected")
inertia.value("inertia_source", "I_000", "kg*m**2", "The same by the source's formula",
    lambda solid_mass, bore_mass, segment_mass, radius, bore_radius, centroid_distance:
        solid_mass * radius**2 / 2 - bore_mass * bore_radius**2 / 2 - segment_mass * centroid_distance**2, source="000 eq. 17")
inertia.value("static_unbalance", "me", "kg*m", "Static unbalance", lambda density, generatrix_length, chord, overlap_chord:
        density * generatrix_length * (segment.first_moment(chord) - segment.first_moment(overlap_chord)), source="this method")
inertia.value("center_of_mass_offset", "e", "mm", "Offset of the centre of mass, away from the flat",
    lambda static_unbalance, mass: static_unbalance / mass, source="this method")


@formula
def second_moment_about_axis(radius: Any, bore_radius: Any, segment: Any, overlap: Any) -> Any:
    """Second moment of the section about the cylinder's diameter that is parallel to the flat."""
    return pi * radius**4 / 4 - segment - (pi * bore_radius**4 / 4 - overlap)


bending = Chapter("Bending under the line load", needs=("bearing_span",), absent="not calculated: bearing_span is not given",
    text="The section is weakest about one of its two principal axes, which are parallel and normal to the flat.")
bending.require("span_over_generatrix", lambda generatrix_length, bearing_span: generatrix_length <= bearing_span, key="bearing_span",
    message="is {bearing_span}, but the bearings stand outside the generatrix: at least {generatrix_length} is needed")
bending.value("segment_second_moment", "I_x1", "cm**4", "Second moment of the segment about the diameter parallel to the flat",
    segment.second_moment_along_chord, output=False)
bending.value("overlap_second_moment", "I_x12", "cm**4", "Second moment of the overlap about the same diameter",
    bind(segment.second_moment_along_chord, radius="bore_radius", half_angle="overlap_half_angle"), output=False)
bending.value("second_moment_parallel", "I_x", "cm**4", "Second moment about the centroid's axis parallel to the flat",
    lambda radius, bore_radius, segment_second_moment, overlap_second_moment, mass, density, generatrix_length,
        center_of_mass_offset:
        second_moment_about_axis(radius, bore_radius, segment_second_moment, overlap_second_moment)
        - mass / (density * generatrix_length) * center_of_mass_offset**2, output=False)
bending.value("second_moment_square", "I_y", "cm**4", "Second moment about the axis of symmetry, normal to the flat",
    lambda inertia, density, generatrix_length, radius, bore_radius, segment_second_moment, overlap_second_moment:
        inertia / (density * generatrix_length) - second_moment_about_axis(radius, bore_radius, segment_second_moment, overlap_second_moment),
    output=False)
bending.value("second_moment_min", "I_min", "cm**4", "Minimum second moment of the section",
    lambda second_moment_parallel, second_moment_square: np.minimum(second_moment_parallel, second_moment_square))
bending.value("bearing_load", "F_b", "kN", "Load on each bearing from the line load",
    lambda line_load, generatrix_length: line_load * generatrix_length / 2)
bending.value("bending_moment", "M_b", "N*m", "Maximum bending moment",
    lambda line_load, generatrix_length, bearing_span: line_load * generatrix_length * (2 * bearing_span - generatrix_length) / 8)
bending.value("deflection", "f", "mm", "Bending deflection at mid-span, of a closed section",
    lambda line_load, generatrix_length, bearing_span, elastic_modulus, second_moment_min:
        line_load * generatrix_length * (8 * bearing_span**3 - 4 * bearing_span * generatrix_length**2 + generatrix_length**3)
        / (384 * elastic_modulus * second_moment_min))

CHAPTERS = (size, flat, overlap, masses, inertia, bending)


DOWN = -np.pi / 2  # the flat is drawn below, as it stands over the die in the dwell


def _arc(radius: float, start: float, end: float) -> list[Point]:
    angles = np.linspace(start, end, 121)
    return [(float(radius * np.cos(a)), float(radius * np.sin(a))) for a in angles]


def _section(view: View) -> Shape:
    """The cut section: closed bore, or a bore that opens into the flat."""
    half, bore, opening = view["half_angle"], view["bore_radius"], view["overlap_half_angle"]
    outer = _arc(view["radius"], DOWN + half, DOWN + 2 * np.pi - half)
    if bore > 0 and opening > 0:
        return region(outer + _arc(bore, DOWN + 2 * np.pi - opening, DOWN + opening))
    return region(outer, [_arc(bore, 0, 2 * np.pi)] if bore > 0 else [])


def cross_section(view: View) -> list[Shape]:
    """Section square to the axis, with flat, bore, centre of mass and dimensions."""
    radius, chord, flat, bore = view["radius"], view["chord"], view["flat_distance"], view["bore_radius"]
    reach = 1.25 * radius
    shapes = [
        _section(view),
        circle((0.0, 0.0), radius, "hidden"),
        polyline([(-reach, 0.0), (reach, 0.0)], "centerline"),
        polyline([(0.0, -reach), (0.0, reach)], "centerline"),
        polyline([(-1.35 * radius, -radius), (1.35 * radius, -radius)], "ground"),
        label((-1.34 * radius, -0.95 * radius), "die"),
        dimension((-chord / 2, -flat), (chord / 2, -flat), -(0.55 * radius), view.text("chord")),
        dimension((radius, -radius), (radius, -flat), -(0.35 * radius), view.text("segment_height")),
        radius_dimension((0.0, 0.0), radius, np.pi / 6, view.text("radius")),
        point((0.0, view["center_of_mass_offset"]), "mark", view.text("center_of_mass_offset")),
    ]
    return shapes + ([radius_dimension((0.0, 0.0), bore, 5 * np.pi / 6, view.text("bore_radius"))] if bore > 0 else [])


FIGURES = (
    Drawing(
        id="cross_section",
        title="Cross-section",
        caption="Section normal to the axis, to scale, with the flat over the die as in the dwell; dashed: the segment that is cut away. The "
        "cross marks the centre of mass.",
        build=cross_section,
    ),
    Bars(
        id="breakdown",
        title="Mass and inertia",
        caption="Contributions of the full cylinder, segment, bore and their overlap.",
        groups=(
            BarGroup(
                label="Mass",
                unit="kg",
                bars=(
                    ("full cylinder", "solid_mass"),
                    ("segment", "-segment_mass"),
                    ("bore", "-bore_mass"),
                    ("overlap", "overlap_mass"),
                    ("cylinder", "mass"),
                ),
            ),
            BarGroup(
                label="Moment of inertia",
                unit="kg*m**2",
                bars=(
                    ("full cylinder", "inertia_solid"),
                    ("segment", "-inertia_segment"),
                    ("bore", "-inertia_bore"),
                    ("overlap", "inertia_overlap"),
                    ("cylinder", "inertia"),
                ),
            ),
        ),
    ),
)
