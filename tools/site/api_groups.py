"""Which page of the reference tells of which names of ``diecut_report.api``, and what is said of those that have no words of their own."""

from __future__ import annotations

from typing import NamedTuple


class Group(NamedTuple):
    """A page of the reference: its name, its title, what it is about, and the names in their order."""

    page: str
    title: str
    words: str
    names: tuple[str, ...]


GROUPS = (
    Group("mechanism", "A mechanism", "What a plugin's module declares: the mechanism as a whole, its chapters, checks, sources.", (
        "Mechanism", "Chapter", "Steps", "Step", "prefixed", "Check", "Vary", "AdviceWay", "Source", "Erratum", "Partner", "Comparison", "Port",
        "Profile", "CurveTable", "ExampleBlock", "Wired", "ForEach", "CONTRACT",
    )),
    Group("inputs", "Inputs", "What a user may give, as a pydantic model; validated values are SI.", (
        "Inputs", "Block", "Annotated", "Quantity", "InOtherUnit", "Text", "OneOf", "CurveInput", "Varying", "Extremes", "Curve", "PhaseInput",
        "MechanismInput", "FromPress", "FromTable", "POINTS",
    )),
    Group("formulas", "Formulas", "What computes, prints and is checked for its dimensions: a function.", (
        "formula", "Formula", "bind", "Bound", "Binding", "ByText", "Constant", "GRAVITY", "arccos", "as_number", "as_angle",
    )),
    Group("steps", "Numbers and conditions", "Steps that give a number or a text, or say what must hold.", (
        "Value", "Choice", "case", "Case", "Root", "Computed", "Refusal", "Require", "Words", "Fact",
    )),
    Group("curves", "Curves", "Steps that give a curve over an abscissa, or take a number of one.", (
        "Abscissa", "Breakpoints", "Reduction", "Derivative", "Accumulated", "Crossings", "FromCurve", "CurvePeriod", "MadeCurve", "Spectrum",
        "SpectrumLine",
    )),
    Group("parts", "Repeated parts", "Steps over a list of blocks: rows with a number for each part.", (
        "Total", "Neighbour", "Running", "Part", "Clash",
    )),
    Group("plain-code", "Plain code", "Objects that plain code makes once, and what several steps take of them.", (
        "Prepared", "ComputedCurve", "PartNames", "PartTable", "PartCurves", "ListedColumn", "Cell",
    )),
    Group("phases", "Phases", "When a mechanism does something, and how others take part in it.", ("Phase", "GivenPhase", "GivenMechanism")),
    Group("tables", "Tables and series", "Numbers of standards and of an author's own tables.", (
        "Lookup", "Interpolated", "Pick", "standard_table", "standard_series", "standard_series_by", "own_table", "own_series", "table_beside",
        "StandardTable", "StandardSeries", "StandardFault",
    )),
    Group("figures", "Figures", "Diagrams and drawings; [shapes and roles](drawings.md) has each shape and role as a picture.", (
        "Plot", "Panel", "Series", "Level", "Mark", "Span", "Polar", "Bars", "BarGroup", "Chart", "chart_panel", "line", "fill", "mark", "level",
        "vertical", "Drawing", "View", "Driven", "Grip", "Shape", "Point", "polyline", "region", "circle", "arc", "dimension", "radius_dimension",
        "label", "arrow", "box", "point", "rigid",
    )),
    Group("texts", "Texts and numbers", "Texts that code makes, and numbers in them.", (
        "Phrase", "phrase", "joined", "named", "worded", "told", "si", "outward", "below",
    )),
)  # fmt: skip

TOLD = {  # names without a docstring of their own
    "AdviceWay": "A way in which a check may be made to hold: an input that is changed alone, by its key or as a `Vary`, "
    "or several keys whose inputs are changed together in one proportion.",
    "Annotated": "Python's own `typing.Annotated`: joins the type of an input with what is declared of it.",
    "Binding": "What a step takes as its formula: a formula, one that is bound, or one that a text chooses.",
    "CONTRACT": "The number of the contract of this program; a module says by `CONTRACT = 1` for which it is written.",
    "Cell": "What stands in a cell of a listing: a number in SI, a text, or `None` where there is nothing.",
    "GRAVITY": "The standard acceleration of free fall, 9.80665 m/s², a `Constant`.",
    "POINTS": "The input with which curves are sampled, for `n_points: Annotated[int, POINTS] = 720`: "
    "it says how densely they are listed, no more. It has the symbol N: a quantity of yours needs another.",
    "Point": "A place in a drawing: across and upwards, in metres.",
    "Shape": "A shape of a drawing, or a panel of a chart, as plain data: made by the functions of this page.",
}
