"""The calculation of the impression cylinder, chapter by chapter."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import (
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
    case,
    choice,
    circle,
    dimension,
    formula,
    inner,
    label,
    m,
    pi,
    point,
    polyline,
    radius_dimension,
    region,
    root,
    value,
)
from diecut_report.mechanics import circular_segment as segment
from diecut_report.mechanics import common

# fmt: off


class CylinderSizing(Inputs):
    """Keys of ``cylinder_sizing``."""

    working_length = Quantity("l_1", "mm", "Working length: the shorter side of the sheet format", gt=0)
    segment_height = Quantity("h", "mm", "Height of the segment that is cut away (below the radius)", gt=0)
    generatrix_length = Quantity("L", "mm", "Length of the cylinder's generatrix", gt=0)
    bore_radius = Quantity("R_b", "mm", "Radius of the bore (below the radius)", ge=0, default=0)
    density = Quantity("γ", "kg/m**3", "Density of the cylinder material", gt=0, default=7800)
    radius = Quantity("R", "mm", "Radius of the cylinder; if given, it is checked instead of sized", gt=0, optional=True)
    radius_step = Quantity("s_R", "mm", "Step to which the sized radius is rounded up", gt=0, default=0.5)
    min_wall = Quantity("w_min", "mm", "Minimum wall between bore and flat", ge=0, default=5)
    bearing_span = Quantity("a", "mm", "Span of the bearings (at least the generatrix); required for the bending", gt=0, optional=True)
    elastic_modulus = Quantity("E", "GPa", "Elastic modulus of the cylinder's material", gt=0, default=210)
    line_load = Quantity("q", "N/mm", "Line load on the generatrix: cutting and ejection (000)", ge=0, default=30)
    allowable_deflection = Quantity("[f]", "mm", "Allowable bending deflection", gt=0, optional=True)


size = Chapter("Radius",
    text="The unrolled circumference is the working length plus the arc of the segment: 2πR = l_1 + l_2 (002 eq. 1). The closed-form approximation "
        "uses Huygens' arc; the adopted radius is checked against the exact one.")


@formula
def radius_by_huygens(working_length: Any, segment_height: Any) -> Any:
    """Radius with Huygens' arc; the other root of the quadratic gives a negative arc."""
    root = np.sqrt(12 * segment_height * (3 * segment_height + 3 * pi * working_length + pi**2 * segment_height))
    return (6 * segment_height + 3 * pi * working_length + root) / (6 * pi**2)


size.segment_height_limit = inner(m.working_length / pi), "h_lim", "mm", "Segment height from which no radius exists"
size.require("radius_exists", m.segment_height < m.segment_height_limit, key="segment_height",
    message="is {segment_height}, but no cylinder with a working length of {working_length} has a segment that high: h < l_1/π = "
    "{segment_height_limit} is needed; make the segment lower or the working length greater")
size.radius_closed_form = value(radius_by_huygens, digits=6), "R_cf", "mm", "Radius by the closed-form approximation", "002 eq. 6"
size.radius_exact = (root(m.radius_exact * (1 - np.cos(pi - as_angle(m.working_length / (2 * m.radius_exact)))) - m.segment_height,
    low=np.maximum(m.segment_height, m.working_length / (2 * pi)), high=m.working_length / pi, left=2 * pi * m.radius_exact - m.working_length,
    right=2 * m.radius_exact * arccos((m.radius_exact - m.segment_height) / m.radius_exact), digits=6), "R_ex", "mm", "Exact radius", "002 eq. 1")
size.radius_closed_form_error = (m.radius_closed_form / m.radius_exact - 1, "e_cf", "%",
    "Error of the closed-form approximation against the exact radius")
size.closed_form_error_size = inner(abs(m.radius_closed_form_error)), "|e_cf|", "%", "Absolute value of this error"
size.radius = value(m.inputs.radius, needs=("radius",)), "R", "mm", "Adopted radius: as given", "input"
size.radius = (value(common.rounded_up.of(quantity=m.radius_exact, step=m.radius_step), lacks=("radius",)), "R", "mm",
    "Adopted radius: the exact one rounded up to the step")
size.require("segment_below_radius", m.segment_height < m.radius, key="segment_height",
    message="is {segment_height}, but the segment must be lower than the radius: h < R = {radius}")
size.require("bore_below_radius", m.bore_radius < m.radius, key="bore_radius",
    message="is {bore_radius}, but the bore must be narrower than the cylinder: 0 ≤ R_b < R = {radius}")


flat = Chapter("Segment and flat", text="All geometry uses the adopted radius.")
flat.chord = segment.chord.of(height=m.segment_height), "c", "mm", "Chord: width of the flat", "002 eq. 3; 000 eq. 16"
flat.half_angle = inner(segment.half_angle.of(height=m.segment_height)), "α", "deg", "Half the central angle of the segment"
flat.segment_angle = 2 * m.half_angle, "2α", "deg", "Central angle of the segment"
flat.arc_length = 2 * m.radius * m.half_angle, "l_2", "mm", "Arc of the segment, exactly", "002 eq. 1"
flat.arc_length_huygens = (segment.arc_length_huygens.of(height=m.segment_height), "l_2H", "mm", "Arc of the segment by Huygens",
    "002 eq. 2, 4; 000 eq. 15")
flat.segment_area = segment.area, "A", "mm**2", "Area of the segment", "000, before eq. 17"
flat.centroid_distance = m.chord**3 / (12 * m.segment_area), "ρ", "mm", "Distance of the segment's centroid from the axis", "000 eq. 17"
flat.flat_distance = inner(m.radius - m.segment_height), "d", "mm", "Distance of the flat from the axis"
flat.wall_at_flat = m.radius - m.segment_height - m.bore_radius, "w", "mm", "Wall between bore and flat"
flat.wall_verdict = (choice(case("the bore breaks through the flat", "the bore reaches the flat", m.flat_distance <= m.bore_radius),
    case("the wall is closed, but thinner than required", "the wall is less than the required one", m.wall_at_flat < m.min_wall),
    case("the wall is thick enough", "the wall is at least the required one"), output=False), "w", "1", "Condition of the wall")
flat.cutting_arc_fraction = 1 - m.half_angle / pi, "κ", "1", "Fraction of the circumference that is not flat"

overlap = Chapter("Overlap of bore and segment",
    text="Where the bore reaches beyond the flat, bore and segment share a smaller segment of the bore's circle; it is subtracted only once.")
overlap.overlap_half_angle = (choice(case(arccos(m.flat_distance / m.bore_radius), "the bore breaks through the flat",
    m.flat_distance < m.bore_radius), case(0, "the bore stays behind the flat: no overlap"), output=False), "α_b", "deg",
    "Half the angle of the bore beyond the flat")
overlap.overlap_chord = inner(2 * m.bore_radius * np.sin(m.overlap_half_angle)), "c_b", "mm", "Width of the opening in the flat"
overlap.overlap_area = inner(segment.area.of(radius=m.bore_radius, half_angle=m.overlap_half_angle)), "A_b", "mm**2", "Area of the overlap"

masses = Chapter("Masses")
masses.solid_mass = as_number(pi) * m.radius**2 * m.generatrix_length * m.density, "m′", "kg", "Mass of the full cylinder", "000 eq. 13, 17"
masses.segment_mass = m.segment_area * m.generatrix_length * m.density, "m_1", "kg", "Mass of the segment", "000 eq. 14"
masses.bore_mass = as_number(pi) * m.bore_radius**2 * m.generatrix_length * m.density, "m_2", "kg", "Mass removed by the bore", "000, after eq. 16"
masses.overlap_mass = m.overlap_area * m.generatrix_length * m.density, "m_12", "kg", "Mass of the overlap", "this method"
masses.mass = m.solid_mass - m.segment_mass - m.bore_mass + m.overlap_mass, "m", "kg", "Mass of the cylinder", "000 eq. 13, overlap once only"

inertia = Chapter("Moment of inertia and unbalance",
    text="The moment of inertia about the cylinder's axis is exact; the result of the source's formula is given for comparison.")
inertia.inertia_solid = inner(m.density * m.generatrix_length * pi * m.radius**4 / 2), "I_s", "kg*m**2", "Inertia of the full cylinder"
inertia.segment_polar = (inner(segment.polar_second_moment.of(distance=m.flat_distance)), "J_1", "cm**4",
    "Polar second moment of the segment about the axis")
inertia.inertia_segment = inner(m.density * m.generatrix_length * m.segment_polar), "I_1", "kg*m**2", "Inertia of the segment"
inertia.inertia_bore = inner(m.density * m.generatrix_length * pi * m.bore_radius**4 / 2), "I_2", "kg*m**2", "Inertia removed by the bore"
inertia.overlap_distance = inner(m.bore_radius * np.cos(m.overlap_half_angle)), "d_b", "mm", "Distance of the overlap's chord from the axis"
inertia.overlap_polar = (inner(segment.polar_second_moment.of(radius=m.bore_radius, distance=m.overlap_distance, half_angle=m.overlap_half_angle)),
    "J_12", "cm**4", "Polar second moment of the overlap about the axis")
inertia.inertia_overlap = inner(m.density * m.generatrix_length * m.overlap_polar), "I_12", "kg*m**2", "Inertia of the overlap"
inertia.inertia = (m.inertia_solid - m.inertia_segment - (m.inertia_bore - m.inertia_overlap), "I", "kg*m**2",
    "Moment of inertia of the cylinder about its axis", "exact; 000 eq. 17 corrected")
inertia.inertia_source = (m.solid_mass * m.radius**2 / 2 - m.bore_mass * m.bore_radius**2 / 2 - m.segment_mass * m.centroid_distance**2, "I_000",
    "kg*m**2", "The same by the source's formula", "000 eq. 17")
inertia.static_unbalance = (m.density * m.generatrix_length * (segment.first_moment(m.chord) - segment.first_moment(m.overlap_chord)), "me", "kg*m",
    "Static unbalance", "this method")
inertia.center_of_mass_offset = m.static_unbalance / m.mass, "e", "mm", "Offset of the centre of mass, away from the flat", "this method"


@formula
def second_moment_about_axis(radius: Any, bore_radius: Any, segment: Any, overlap: Any) -> Any:
    """Second moment of the section about the cylinder's diameter that is parallel to the flat."""
    return pi * radius**4 / 4 - segment - (pi * bore_radius**4 / 4 - overlap)


bending = Chapter("Bending under the line load", needs=("bearing_span",), absent="not calculated: bearing_span is not given",
    text="The section is weakest about one of its two principal axes, which are parallel and normal to the flat.")
bending.require("span_over_generatrix", m.generatrix_length <= m.bearing_span, key="bearing_span",
    message="is {bearing_span}, but the bearings stand outside the generatrix: at least {generatrix_length} is needed")
bending.segment_second_moment = (inner(segment.second_moment_along_chord), "I_x1", "cm**4",
    "Second moment of the segment about the diameter parallel to the flat")
bending.overlap_second_moment = (inner(segment.second_moment_along_chord.of(radius=m.bore_radius, half_angle=m.overlap_half_angle)), "I_x12",
    "cm**4", "Second moment of the overlap about the same diameter")
bending.second_moment_parallel = (inner(second_moment_about_axis(m.radius, m.bore_radius, m.segment_second_moment,
    m.overlap_second_moment) - m.mass / (m.density * m.generatrix_length) * m.center_of_mass_offset**2), "I_x", "cm**4",
    "Second moment about the centroid's axis parallel to the flat")
bending.second_moment_square = (inner(m.inertia / (m.density * m.generatrix_length) - second_moment_about_axis(m.radius, m.bore_radius,
    m.segment_second_moment, m.overlap_second_moment)), "I_y", "cm**4", "Second moment about the axis of symmetry, normal to the flat")
bending.second_moment_min = np.minimum(m.second_moment_parallel, m.second_moment_square), "I_min", "cm**4", "Minimum second moment of the section"
bending.bearing_load = m.line_load * m.generatrix_length / 2, "F_b", "kN", "Load on each bearing from the line load"
bending.bending_moment = m.line_load * m.generatrix_length * (2 * m.bearing_span - m.generatrix_length) / 8, "M_b", "N*m", "Maximum bending moment"
bending.deflection = (m.line_load * m.generatrix_length * (8 * m.bearing_span**3 - 4 * m.bearing_span * m.generatrix_length**2
    + m.generatrix_length**3) / (384 * m.elastic_modulus * m.second_moment_min), "f", "mm", "Bending deflection at mid-span, of a closed section")

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
        "cross_section",
        "Cross-section",
        "Section normal to the axis, to scale, with the flat over the die as in the dwell; dashed: the segment that is cut away. The "
        "cross marks the centre of mass.",
        build=cross_section,
    ),
    Bars(
        "breakdown",
        "Mass and inertia",
        "Contributions of the full cylinder, segment, bore and their overlap.",
        groups=(
            BarGroup(
                "Mass",
                "kg",
                bars=(
                    ("full cylinder", "solid_mass"),
                    ("segment", "-segment_mass"),
                    ("bore", "-bore_mass"),
                    ("overlap", "overlap_mass"),
                    ("cylinder", "mass"),
                ),
            ),
            BarGroup(
                "Moment of inertia",
                "kg*m**2",
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
