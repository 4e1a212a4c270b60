"""All that a plugin may import, with ``diecut_report.mechanics``, NumPy and SciPy."""

from typing import Annotated

from diecut_report.contract.checks import Check
from diecut_report.contract.figures import (
    BarGroup,
    Bars,
    Drawing,
    Level,
    Mark,
    Panel,
    Plot,
    Point,
    Polar,
    Series,
    Shape,
    Span,
    View,
    arc,
    circle,
    dimension,
    label,
    point,
    polyline,
    radius_dimension,
    region,
)
from diecut_report.contract.inputs import POINTS, Block, CurveInput, FromPress, Inputs, Quantity, Text
from diecut_report.contract.mechanism import Erratum, Mechanism, Source
from diecut_report.contract.steps import (
    Abscissa,
    Bound,
    Breakpoints,
    Case,
    Choice,
    Crossings,
    FromCurve,
    Pick,
    Reduction,
    Require,
    Root,
    Section,
    Step,
    Total,
    Value,
    bind,
    prefixed,
)
from diecut_report.expressions import GRAVITY, Constant, Formula, arccos, formula

__all__ = [
    "GRAVITY", "POINTS", "Abscissa", "Annotated", "BarGroup", "Bars", "Block", "Bound", "Breakpoints", "Case", "Check",
    "Choice", "Constant", "Crossings", "CurveInput", "Drawing", "Erratum", "Formula", "FromCurve", "FromPress", "Inputs",
    "Level", "Mark", "Mechanism", "Panel", "Pick", "Plot", "Point", "Polar", "Quantity", "Reduction", "Require", "Root",
    "Section", "Series", "Shape", "Source", "Span", "Step", "Text", "Total", "Value", "View", "arc", "arccos", "bind", "circle",
    "dimension", "formula", "label", "point", "polyline", "prefixed", "radius_dimension", "region",
]  # fmt: skip
