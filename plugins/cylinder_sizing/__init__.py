"""Impression cylinder: size, mass and inertia (002 eq. 1–6, 000 eq. 13–17)."""

from __future__ import annotations

from diecut_report.api import Check, Erratum, ExampleBlock, Mechanism, Source, Vary, m
from diecut_report.plugins.cylinder_sizing.calculation import CHAPTERS, FIGURES, CylinderSizing

EXAMPLE = ExampleBlock(
    "cylinder",
    {
        "working_length": "${press.sheet.width}",
        "segment_height": "40 mm",
        "generatrix_length": "${press.sheet.length}",
        "bore_radius": "60 mm",
        "bearing_span": {"value": "${press.sheet.length} + 160 mm", "basis": "assumed"},
        "allowable_deflection": "0.05 mm",
    },
)


MECHANISM = Mechanism(
    kind="cylinder_sizing",
    version="1.0",
    title="Impression cylinder: size, mass and inertia",
    summary="The hollow cylinder rolls over the flat die; a circular segment is cut away from it, so that the gripper carriages of the sheet "
            "conveyor pass under the flat while the cylinder dwells. From the sheet and the segment follow the radius, the mass, the inertia and "
            "the unbalance; the remaining wall at the flat is checked.",
    inputs=CylinderSizing,
    example=EXAMPLE,
    chapters=CHAPTERS,
    key_results=("radius", "mass", "inertia", "static_unbalance", "center_of_mass_offset", "wall_at_flat", "cutting_arc_fraction",
                 "deflection"),
    checks=(
        Check("wall_at_flat", "strength", "Wall between bore and flat", m.min_wall, m.wall_at_flat, demand_label="required wall",
            limit_label="wall at the flat", source="geometry", consequence="{wall_verdict}.", advise=("bore_radius", "segment_height")),
        Check("radius", "function", "Radius compared with the exact one", m.radius_exact, m.radius, limit_label="adopted radius",
            sized_unless=("radius",), consequence="the circumference beside the flat is shorter than the working length.",
            advise=(Vary("radius", "up"), Vary("segment_height", "down"))),
        Check("closed_form_error", "practice", "Error of the closed-form approximation", m.closed_form_error_size, 0.5,
            demand_label="closed form against exact", source="002 eq. 6", severity="warn",
            consequence="Huygens' arc is used beyond its range (segment height over radius above about 0.65); "
            "rely on the exact radius."),
        Check("deflection", "function", "Bending deflection", m.deflection, m.allowable_deflection, demand_label="deflection of a closed section",
            source="simply supported beam", needs=("bearing_span", "allowable_deflection"),
            consequence="the cut is lighter in the middle of the sheet than at its sides.",
            advise=(Vary("bearing_span", "down"), Vary("bore_radius", "down"), Vary("segment_height", "down"))),
        Check("closed_section", "strength", "Closed section, as assumed for bending", m.bore_radius, m.flat_distance, operator="<",
            demand_label="bore radius", source="strength of materials", only_with=("bearing_span",),
            consequence="a slot of {overlap_chord} along the flat opens the section: it twists about a shear centre outside itself and "
            "gives way in shear, so the calculated deflection does not hold and the true one is greater.", advise=("bore_radius", "segment_height")),
    ),
    figures=FIGURES,
    assumptions=(
        "The cylinder rolls without slip; the unrolled circumference beside the flat is the working length.",
        "The body is homogeneous and has a constant section along the generatrix; journals, keyways and the pinion are not included.",
        "Where the bore breaks through the flat, the overlap of bore and segment is subtracted only once.",
        "Bending: a simply supported beam with the line load over the generatrix in the middle of the span, about the weakest axis of the "
        "section, which is closed; shear deformation is neglected.",
    ),
    sources=(
        Source("000", "Topolnytskyi P. V., Shustykevych A. I., Kolomiiets A. B., Vatuliak Yu. V. Research of the drive parameters "
               "of the pressure cylinder of a flat-bed type die-cutting machine. 2024. "
               "doi: 10.32403/1998-6912-2024-2-69-140-150."),
        Source("002", "Loizyk V. V., Bryndas A. M., Shelonh N. M., Ternytskyi S. V. Analytical studies of drive mechanism parameters of "
               "flat cylinder die-cutting press. Lviv Polytechnic National University (in Ukrainian)."),
    ),
    errata=(
        Erratum("000", "The bore radius is stated as 80 mm, but all numbers of the paper use 70 mm.", ("bore_mass", "mass")),
        Erratum("000", "The printed inertia 0.973 kg·m² is 1.042 − 0.206 + 0.137: the segment's term was added, although eq. 17 "
                "subtracts it. By eq. 17 with the printed figures it is 0.698 kg·m²; with exact segment properties and the "
                "segment's own inertia 0.636 kg·m².", ("inertia", "inertia_source")),
        Erratum("000", "The chord 2√(0.04(0.21 − 0.04)) is 0.165 m, not 0.16 m; this makes the centroid distance 0.081 m instead of "
                "0.074 m. The printed factors of the segment's area give 4.72·10⁻³ m², not 4.6·10⁻³ m² (which is right).",
                ("chord", "centroid_distance", "segment_area")),
        Erratum("000", "With a radius of 105 mm, a segment of 40 mm and a bore radius of 70 mm the wall at the flat is −5 mm: the "
                "published bore breaks through the flat.", ("wall_at_flat",)),
    ),
)  # fmt: skip
