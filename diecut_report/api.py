"""All that a plugin may import, with ``diecut_report.mechanics``, NumPy and SciPy."""

from typing import Annotated

from diecut_report.contract.binding import Binding, Bound, ByText, bind
from diecut_report.contract.chapters import Chapter, Steps
from diecut_report.contract.charts import chart_panel, fill, level, line, mark, vertical
from diecut_report.contract.checks import Check
from diecut_report.contract.code_steps import ComputedCurve, Fact, PartCurves, PartNames, PartTable
from diecut_report.contract.figures import (
    BarGroup,
    Bars,
    Chart,
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
    arrow,
    box,
    circle,
    dimension,
    label,
    point,
    polyline,
    radius_dimension,
    region,
)
from diecut_report.contract.inputs import (
    POINTS,
    Block,
    CurveInput,
    FromPress,
    InOtherUnit,
    Inputs,
    OneOf,
    Quantity,
    Text,
)
from diecut_report.contract.listings import Cell, ListedColumn
from diecut_report.contract.mechanism import Comparison, CurveTable, Erratum, Mechanism, Partner, Profile, Source
from diecut_report.contract.options import case
from diecut_report.contract.part_steps import Interpolated, Lookup, Neighbour, Part, Pick, Running, Total
from diecut_report.contract.phase_inputs import GivenMechanism, GivenPhase, MechanismInput, PhaseInput
from diecut_report.contract.placeholders import Curve
from diecut_report.contract.refusal import Refusal
from diecut_report.contract.sections import prefixed
from diecut_report.contract.spectra import Spectrum, SpectrumLine
from diecut_report.contract.steps import (
    Abscissa,
    Accumulated,
    Breakpoints,
    Case,
    Choice,
    Clash,
    Computed,
    Crossings,
    CurvePeriod,
    Derivative,
    FromCurve,
    MadeCurve,
    Phase,
    Prepared,
    Reduction,
    Require,
    Root,
    Step,
    Value,
    Words,
)
from diecut_report.contract.varying import Extremes, Varying
from diecut_report.expressions import GRAVITY, Constant, Formula, arccos, as_angle, as_number, formula
from diecut_report.quantities.formatting import below, outward, si, told
from diecut_report.standards import (
    StandardFault,
    StandardSeries,
    StandardTable,
    own_series,
    own_table,
    standard_series,
    standard_series_by,
    standard_table,
    table_beside,
)

__all__ = [
    "GRAVITY", "POINTS", "Abscissa", "Accumulated", "Annotated", "BarGroup", "Bars", "Binding", "Block", "Bound", "Breakpoints", "ByText",
    "Case", "Cell", "Chapter", "Chart", "Check", "Choice", "Clash", "Comparison", "Computed", "ComputedCurve", "Constant", "Crossings",
    "Curve",
    "CurveInput", "CurvePeriod", "CurveTable", "Derivative", "Drawing", "Erratum", "Extremes", "Fact", "Formula",
    "FromCurve", "FromPress", "GivenMechanism",
    "GivenPhase", "InOtherUnit", "Inputs", "Interpolated", "Level", "ListedColumn", "Lookup", "MadeCurve", "Mark", "Mechanism", "MechanismInput",
    "Neighbour",
    "OneOf", "Panel", "Part", "PartCurves", "PartNames", "PartTable", "Partner", "Phase", "PhaseInput", "Pick", "Plot", "Point", "Polar", "Prepared",
    "Profile", "Quantity", "Reduction", "Refusal", "Require", "Root", "Running",
    "Series", "Shape", "Source", "Span", "Spectrum", "SpectrumLine", "StandardFault", "StandardSeries", "StandardTable", "Step", "Steps",
    "Text", "Total", "Value", "Varying", "View", "Words", "arc", "arccos", "arrow", "as_angle", "as_number", "below", "bind", "box", "case",
    "chart_panel", "circle", "dimension", "fill", "formula", "label", "level", "line", "mark", "outward", "own_series", "own_table",
    "point", "polyline", "prefixed", "radius_dimension", "region", "si", "standard_series", "standard_series_by", "standard_table",
    "table_beside", "told", "vertical",
]  # fmt: skip
