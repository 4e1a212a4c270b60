"""Formulas of the impression cylinder's sizing that are not geometry of the segment."""

from __future__ import annotations

from typing import Any

import numpy as np

from diecut_report.api import arccos, as_angle, as_number, formula
from diecut_report.mechanics.circular_segment import first_moment


@formula
def segment_height_limit(working_length: Any) -> Any:
    """Height of segment that no cylinder of this working length can have."""
    return working_length / np.pi


@formula
def radius_closed_form(working_length: Any, segment_height: Any) -> Any:
    """Radius with Huygens' arc; the other root of the quadratic gives a negative arc."""
    root = np.sqrt(12 * segment_height * (3 * segment_height + 3 * np.pi * working_length + np.pi**2 * segment_height))
    return (6 * segment_height + 3 * np.pi * working_length + root) / (6 * np.pi**2)


@formula
def least_radius(working_length: Any, segment_height: Any) -> Any:
    """Where the search for the radius begins: no segment higher than the radius, no negative arc."""
    return np.maximum(segment_height, working_length / (2 * np.pi))


@formula
def height_mismatch(radius: Any, working_length: Any, segment_height: Any) -> Any:
    """Height of the segment that the working length leaves on the circumference, less the given height."""
    return radius * (1 - np.cos(np.pi - as_angle(working_length / (2 * radius)))) - segment_height


@formula
def beside_the_flat(radius: Any, working_length: Any) -> Any:
    """What of the circumference is left beside the working length."""
    return 2 * np.pi * radius - working_length


@formula
def arc_of_segment(radius: Any, segment_height: Any) -> Any:
    """Arc of the segment, exactly."""
    return 2 * radius * arccos((radius - segment_height) / radius)


@formula
def relative_error(approximate: Any, exact: Any) -> Any:
    """Relative error of an approximation."""
    return approximate / exact - 1


@formula
def foot(radius: Any, half_angle: Any) -> Any:
    """Distance of a segment's chord from the circle's centre."""
    return radius * np.cos(half_angle)


@formula
def wall_at_flat(radius: Any, segment_height: Any, bore_radius: Any) -> Any:
    """Wall between bore and flat."""
    return radius - segment_height - bore_radius


@formula
def overlap_half_angle(flat_distance: Any, bore_radius: Any) -> Any:
    """Half the angle of the bore that lies beyond the flat."""
    return arccos(flat_distance / bore_radius)


@formula
def disc_mass(radius: Any, length: Any, density: Any) -> Any:
    """Mass of a full cylinder."""
    return as_number(np.pi) * radius**2 * length * density


@formula
def prism_mass(area: Any, length: Any, density: Any) -> Any:
    """Mass of a prism."""
    return area * length * density


@formula
def net_mass(solid_mass: Any, segment_mass: Any, bore_mass: Any, overlap_mass: Any) -> Any:
    """Mass of the cylinder without segment and bore, their overlap taken away once only."""
    return solid_mass - segment_mass - bore_mass + overlap_mass


@formula
def disc_inertia(radius: Any, length: Any, density: Any) -> Any:
    """Moment of inertia of a full cylinder about its axis."""
    return density * length * np.pi * radius**4 / 2


@formula
def prism_inertia(polar_second_moment: Any, length: Any, density: Any) -> Any:
    """Moment of inertia of a prism, from the polar second moment of its section."""
    return density * length * polar_second_moment


@formula
def net_inertia(solid: Any, segment: Any, bore: Any, overlap: Any) -> Any:
    """Moment of inertia without segment and bore, their overlap taken away once only."""
    return solid - segment - (bore - overlap)


@formula
def inertia_source(
    solid_mass: Any, bore_mass: Any, segment_mass: Any, radius: Any, bore_radius: Any, centroid_distance: Any
) -> Any:
    """Moment of inertia as the source has it: the segment as a point mass at its centroid."""
    return solid_mass * radius**2 / 2 - bore_mass * bore_radius**2 / 2 - segment_mass * centroid_distance**2


@formula
def static_unbalance(density: Any, length: Any, chord: Any, overlap_chord: Any) -> Any:
    """Mass times the offset of the centre of mass: the first moments of segment and overlap."""
    return density * length * (first_moment(chord) - first_moment(overlap_chord))


@formula
def center_of_mass_offset(static_unbalance: Any, mass: Any) -> Any:
    """Distance of the centre of mass from the axis, away from the flat."""
    return static_unbalance / mass


@formula
def round_share(half_angle: Any) -> Any:
    """Share of the circumference that is not flat."""
    return 1 - half_angle / np.pi


@formula
def bore_radius_limit(radius: Any, segment_height: Any, min_wall: Any) -> Any:
    """The bore that leaves the required wall."""
    return radius - segment_height - min_wall


@formula
def second_moment_about_axis(radius: Any, bore_radius: Any, segment: Any, overlap: Any) -> Any:
    """Second moment of the section about the cylinder's diameter that is parallel to the flat."""
    return np.pi * radius**4 / 4 - segment - (np.pi * bore_radius**4 / 4 - overlap)


@formula
def second_moment_bending_flat(
    radius: Any, bore_radius: Any, segment: Any, overlap: Any, mass: Any, density: Any, length: Any, offset: Any
) -> Any:
    """Second moment of the section about the axis through its centroid that is parallel to the flat."""
    about_axis = second_moment_about_axis(radius, bore_radius, segment, overlap)
    return about_axis - mass / (density * length) * offset**2


@formula
def second_moment_across_flat(
    inertia: Any, density: Any, length: Any, radius: Any, bore_radius: Any, segment: Any, overlap: Any
) -> Any:
    """Second moment of the section about its axis of symmetry: the polar one less that about the other diameter."""
    about_axis = second_moment_about_axis(radius, bore_radius, segment, overlap)
    return inertia / (density * length) - about_axis


@formula
def deflection(line_load: Any, length: Any, span: Any, elastic_modulus: Any, second_moment: Any) -> Any:
    """Deflection in the middle of a simply supported beam, loaded over ``length`` in the middle of its span."""
    return (
        line_load * length * (8 * span**3 - 4 * span * length**2 + length**3) / (384 * elastic_modulus * second_moment)
    )


@formula
def bending_moment(line_load: Any, length: Any, span: Any) -> Any:
    """Greatest bending moment of that beam."""
    return line_load * length * (2 * span - length) / 8


@formula
def bearing_load(line_load: Any, length: Any) -> Any:
    """Load on each of the two bearings."""
    return line_load * length / 2
