"""All that a plugin may import, with ``diecut_report.mechanics``, NumPy and SciPy."""

from typing import Annotated

from diecut_report.formulas.formula import Formula, formula
from diecut_report.formulas.tree import GRAVITY, Constant, arccos, as_angle, as_number
from diecut_report.mechanism.chapters import Chapter, Steps, prefixed
from diecut_report.mechanism.checks import AdviceWay, Check, Refusal, Vary
from diecut_report.mechanism.curve_inputs import (
    CurveInput,
    FromTable,
    GivenMechanism,
    GivenPhase,
    InOtherUnit,
    MechanismInput,
    PhaseInput,
)
from diecut_report.mechanism.figures import (
    BarGroup,
    Bars,
    Chart,
    Drawing,
    Driven,
    Grip,
    Level,
    Mark,
    Panel,
    Plot,
    Point,
    Polar,
    Series,
    Shape,
    Span,
    Spectrum,
    SpectrumLine,
    View,
    arc,
    arrow,
    box,
    chart_panel,
    circle,
    dimension,
    fill,
    label,
    level,
    line,
    mark,
    point,
    polyline,
    radius_dimension,
    region,
    rigid,
    vertical,
)
from diecut_report.mechanism.inputs import POINTS, Block, Extremes, Inputs, Quantity, Varying
from diecut_report.mechanism.mechanism import (
    CONTRACT,
    Comparison,
    CurveTable,
    Erratum,
    ExampleBlock,
    ForEach,
    Mechanism,
    Partner,
    Port,
    Profile,
    Source,
    Wired,
)
from diecut_report.mechanism.names import Binding, Bound, ByText, Curve, FromPress, OneOf, Text, bind
from diecut_report.mechanism.steps import (
    Abscissa,
    Accumulated,
    Breakpoints,
    Case,
    Cell,
    Choice,
    Clash,
    Computed,
    ComputedCurve,
    Crossings,
    CurvePeriod,
    Derivative,
    Fact,
    FromCurve,
    Interpolated,
    ListedColumn,
    Lookup,
    MadeCurve,
    Neighbour,
    Part,
    PartCurves,
    PartNames,
    PartTable,
    Phase,
    Pick,
    Prepared,
    Reduction,
    Require,
    Root,
    Running,
    Step,
    Total,
    Value,
    Words,
    case,
)  # fmt: skip
from diecut_report.quantities.formatting import below, outward, si, told
from diecut_report.standards import standard_series, standard_series_by, standard_table
from diecut_report.standards.files import table_beside
from diecut_report.standards.tables import StandardFault, StandardSeries, StandardTable, own_series, own_table
from diecut_report.text.phrases import Phrase, joined, named, phrase, worded

__all__ = [
    "CONTRACT", "GRAVITY", "POINTS", "Abscissa", "Accumulated", "AdviceWay", "Annotated", "BarGroup", "Bars",
    "Binding", "Block", "Bound", "Breakpoints", "ByText", "Case", "Cell", "Chapter", "Chart", "Check", "Choice",
    "Clash", "Comparison", "Computed", "ComputedCurve", "Constant", "Crossings", "Curve", "CurveInput",
    "CurvePeriod", "CurveTable", "Derivative", "Drawing", "Driven", "Erratum", "ExampleBlock", "Extremes", "Fact",
    "ForEach", "Formula", "FromCurve", "FromPress", "FromTable", "GivenMechanism", "GivenPhase", "Grip",
    "InOtherUnit", "Inputs", "Interpolated", "Level", "ListedColumn", "Lookup", "MadeCurve", "Mark", "Mechanism",
    "MechanismInput", "Neighbour", "OneOf", "Panel", "Part", "PartCurves", "PartNames", "PartTable", "Partner",
    "Phase", "PhaseInput", "Phrase", "Pick", "Plot", "Point", "Polar", "Port", "Prepared", "Profile", "Quantity",
    "Reduction", "Refusal", "Require", "Root", "Running", "Series", "Shape", "Source", "Span", "Spectrum",
    "SpectrumLine", "StandardFault", "StandardSeries", "StandardTable", "Step", "Steps", "Text", "Total", "Value",
    "Vary", "Varying", "View", "Wired", "Words", "arc", "arccos", "arrow", "as_angle", "as_number", "below", "bind",
    "box", "case", "chart_panel", "circle", "dimension", "fill", "formula", "joined", "label", "level", "line",
    "mark", "named", "outward", "own_series", "own_table", "phrase", "point", "polyline", "prefixed",
    "radius_dimension", "region", "rigid", "si", "standard_series", "standard_series_by", "standard_table",
    "table_beside", "told", "vertical", "worded",
]  # fmt: skip
