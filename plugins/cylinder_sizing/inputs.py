"""Inputs of the impression cylinder's sizing."""

from __future__ import annotations

from diecut_report.api import Annotated, Inputs, Quantity

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
