"""Figures of the impression cylinder."""

from __future__ import annotations

import numpy as np

from diecut_report.api import (
    BarGroup,
    Bars,
    Drawing,
    Point,
    Shape,
    View,
    circle,
    dimension,
    label,
    point,
    polyline,
    radius_dimension,
    region,
)

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
