"""The form of the results of one mechanism, or of a comparison."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

# What the forms share: keys that are always there and keys that may be left out; numbers as they are printed.


Status = Literal["pass", "warn", "fail", "error", "skipped"]
CheckStatus = Literal["pass", "warn", "fail", "not_checked"]
CheckClass = Literal["function", "strength", "practice", "numerical"]
Basis = Literal["assumed", "given", "catalogue", "drawing", "standard", "measured"]
Value = float | int | bool | str
Tree = list[Any]  # an expression: [operation, operand, …], each operand a tree, too

ABSENT = object()


class ClosedKeys(BaseModel):
    """Declare a block that holds these keys and no others."""

    model_config = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False)


def always(words: str, alias: str | None = None) -> Any:
    """Return a key that is always there; ``alias`` where its name is a word of Python."""
    return Field(alias=alias, description=words)


def sometimes(words: str, alias: str | None = None) -> Any:
    """Return a key that is left out where it has nothing to say."""
    return Field(default=ABSENT, alias=alias, description=words)


class ShownKeys(ClosedKeys):
    """A number as it is printed."""

    text: str = always("The number as a neutral text (decimal point, `1.2e-05`), or words.")
    unit: str = always("The unit that it is printed in; `1` without one.")


class PlaceKeys(ClosedKeys):
    """A place of an abscissa."""

    symbol: str = always("The symbol of the abscissa.")
    text: str = always("The place, in the unit.")
    unit: str = always("The unit of the text.")
    value: float = sometimes("Of a result's extreme the place as it is calculated, SI.")


class PartOfListKeys(ClosedKeys):
    """Which of repeated parts a quantity is of."""

    family: str = always("The list in the configuration, or what names its parts.")
    index: int = always("Its place, counted from 0.")
    number: int = sometimes("The number in its name, where that holds one.")
    quantity: str = sometimes("What it is of each part.")


# The form of the printed calculation and of the figures.


TREE = 'as a tree: `[operation, operand, …]`, `["sym", name]`, `["qty", text, unit]`'


class ConversionKeys(ClosedKeys):
    """A quantity that goes into a formula in another unit than it is shown in."""

    symbol: str = always("Its symbol.")
    shown: ShownKeys = always("As it is shown.")
    converted: ShownKeys = always("As it goes in.")


class DefinitionKeys(ClosedKeys):
    """What a name in a formula stands for."""

    defined: Tree = always(f"The name with its arguments, {TREE}.")
    stands_for: Tree = always("What it stands for.", "as")


class StepKeys(ClosedKeys):
    """What all steps of a calculation have."""

    id: str = always("Its id, which is that of the quantity it gives.")
    symbol: str = always("The symbol of that quantity.")
    description: str = always("What it is.")
    source: str = always("Where the formula stands.")


class ResultingKeys(StepKeys):
    """What all steps with a result have."""

    result: ShownKeys = always("The result.")
    at: PlaceKeys = sometimes("Of a curve the place at which it is shown; of an extreme where it lies.")
    note: str = sometimes("What is to be known of it.")


class FormulaItemKeys(ResultingKeys):
    """A formula with the numbers in it."""

    type: Literal["formula"] = always("`formula`.")
    equation: Tree = always(f"The formula, {TREE}.")
    substituted: Tree | None = always("The same with numbers; null where there are none to put in.")
    table_rows: str = sometimes("Of a number between two rows of a table: these rows.")
    series: str = sometimes("The table that it is taken from.")
    bridge: ShownKeys = sometimes("The result in the unit that the numbers give, before it is converted.")
    conversions: list[ConversionKeys] = sometimes("Quantities that go in in another unit.")
    where: list[DefinitionKeys] = sometimes("What names in it stand for.")


class ChoiceItemKeys(ResultingKeys):
    """A branch that is taken, or whether a condition holds."""

    type: Literal["choice"] = always("`choice`.")
    words: str = always("Which branch, in words.")
    condition: Tree = sometimes("The condition that holds.")
    condition_substituted: Tree | None = sometimes("The same with numbers.")
    equation: Tree | None = always("The branch's formula; null where it gives a text.")
    substituted: Tree | None = always("The same with numbers.")
    bridge: ShownKeys = sometimes("The result in the unit that the numbers give, before it is converted.")
    conversions: list[ConversionKeys] = sometimes("Quantities that go in in another unit.")
    where: list[DefinitionKeys] = sometimes("What names in it stand for.")


class FoundItemKeys(ResultingKeys):
    """A number that is found, as the root of an equation."""

    type: Literal["found"] = always("`found`.")
    relation: Tree | None = always("The equation that it satisfies; null where it was found in another way.")
    method: str = always("How it was found.")
    chosen: Literal[True] = sometimes("It was chosen in the place of an input that may be given.")
    residual: ShownKeys = sometimes("How far from zero the equation is.")


class ReductionItemKeys(ResultingKeys):
    """What is taken of a curve or of repeated parts: an extreme, a mean, a sum, an integral."""

    type: Literal["reduction"] = always("`reduction`.")
    of: str = always("The symbol of what it is taken of.")
    operation: str = always(
        "What is taken: `max`, `abs_max`, `min`, `range`, `mean`, `rms`, `integral`, `sum`, `first`, `last`, `pick` …"
    )
    over: PlaceKeys = sometimes("Of an integral what it runs over, from 0 to this place.")
    method: str = always("How it was found.")
    residual: ShownKeys = sometimes("How far a proof by other means differs.")
    series: str = sometimes("The standard series that it is taken from.")


class LookupItemKeys(ResultingKeys):
    """A number taken from a row of a table, by the row's name or by a number that it has, or as it is given."""

    type: Literal["lookup"] = always("`lookup`.")
    by: str = always("What the row is taken by.")
    key: str = always("The row's name, or symbol and number; `as given` where the number is given.")
    table: str = always("The title of the table.")
    column: str = sometimes("The column of the table.")


class NoteItemKeys(StepKeys):
    """A sentence in place of a number."""

    type: Literal["note"] = always("`note`.")
    text: str = always("The sentence.")


class PrintedColumnKeys(ClosedKeys):
    """The head of a column of a printed table."""

    title: str = always("What it holds.")
    symbol: str = always("Its symbol; empty without one.")
    unit: str = always("The unit of its texts.")


class TableItemKeys(ClosedKeys):
    """A table."""

    type: Literal["table"] = always("`table`.")
    id: str = sometimes("The id of the quantity that it shows.")
    title: str = always("Its title.")
    columns: list[PrintedColumnKeys] = always("The heads of its columns.")
    rows: list[list[str]] = always("Its rows, as printed.")


Item = (
    FormulaItemKeys | ChoiceItemKeys | FoundItemKeys | ReductionItemKeys | LookupItemKeys | NoteItemKeys | TableItemKeys
)  # fmt: skip


class SectionKeys(ClosedKeys):
    """A part of the printed calculation."""

    title: str = always("Its title.")
    text: str = always("What stands below it.")
    items: list[Item] = always("Its steps, in their order.")
    shown: list[PlaceKeys] = sometimes("The places at which its curves are shown.")


class FigureKeys(ClosedKeys):
    """What all figures have."""

    id: str = always("Its id.")
    title: str = always("Its title.")
    caption: str = always("What is to be seen in it.")


class ShowingKeys(FigureKeys):
    """What all figures have that could be made."""

    shows: list[str] = always("The ids of the quantities that it shows.")


class PlotKeys(ShowingKeys):
    """Curves of the results over their abscissa."""

    type: Literal["plot"] = always("`plot`.")
    abscissa: str = always("The abscissa.")
    panels: list[dict[str, Any]] = always(
        "Its panels: title, unit, series (names of curves), levels, marks, spans; values in SI."
    )


class ChartKeys(ShowingKeys):
    """Lines that are not curves of the results."""

    type: Literal["chart"] = always("`chart`.")
    panels: list[dict[str, Any]] = always(
        "Its panels: title, unit, x, lines, fills, marks, levels, verticals; values in SI."
    )


class PolarKeys(ShowingKeys):
    """Curves about a pole."""

    type: Literal["polar"] = always("`polar`.")
    abscissa: str = always("The abscissa, an angle.")
    unit: str = always("The unit in which distances are shown.")
    series: list[dict[str, Any]] = always("Its curves, by name, with their labels.")
    range: list[float] = sometimes("From which distance to which it reaches.")


class BarsKeys(ShowingKeys):
    """Numbers side by side."""

    type: Literal["bars"] = always("`bars`.")
    groups: list[dict[str, Any]] = always("Its groups: label, unit, bars with label and value (SI).")


class DrawingKeys(ShowingKeys):
    """A drawing of the machine."""

    type: Literal["drawing"] = always("`drawing`.")
    unit: str = always("The unit of its dimensions; `1` where it is not to scale.")
    shapes: list[dict[str, Any]] = always("What is drawn, back to front: shape, role, places (SI).")
    schematic: bool = sometimes("true: it is not drawn to scale.")
    moving: dict[str, Any] = sometimes(
        "What moves in it: over which abscissa, at which places, the shapes; those that move with their numbers at each (`moves`)."
    )


class FailedFigureKeys(FigureKeys):
    """A figure that could not be made."""

    type: Literal["failed"] = always("`failed`.")
    error: str = always("Why.")


Figure = PlotKeys | ChartKeys | PolarKeys | BarsKeys | DrawingKeys | FailedFigureKeys


class SourceKeys(ClosedKeys):
    """A source of formulas or data."""

    id: str = always("What formulas call it.")
    citation: str = always("Its citation.")


class QuantityKeys(ClosedKeys):
    """What inputs and outputs have."""

    unit: str = always("The SI unit of the value, in ASCII that pint reads; `1` for pure numbers and texts.")
    symbol: str = always("Its symbol; empty without one.")
    description: str = always("What it is.")
    display: ShownKeys = always("As it is printed.")
    part: PartOfListKeys = sometimes("Of which of repeated parts it is.")


class InputKeys(QuantityKeys):
    """An input."""

    value: Value | list[str] = always("Its value, SI; of a curve and of what varies over a cycle words.")
    origin: Literal["given", "default", "reference", "expression"] = always("Where it comes from.")
    path: str = sometimes("The path that it refers to.")
    paths: list[str] = sometimes("The paths that its expression refers to.")
    text: str = sometimes("Its text as typed.")
    basis: Basis = sometimes("What it rests on; of a reference the weakest of all that it follows from.")
    note: str = sometimes("What the user notes of it.")


class OutputKeys(QuantityKeys):
    """An output, or an intermediate number. One that does not apply to this machine is left out."""

    value: Value = always("Its value, SI.")
    source: str = always("Where its formula stands.")
    source_symbol: str = sometimes("Its symbol in the source, where that is another.")
    key: bool = sometimes("true: it is one of the key results.")
    at: PlaceKeys = sometimes("Of an extreme where it lies.")
    list: str = sometimes("The list over whose parts it runs.")


class CurveKeys(ClosedKeys):
    """A curve at the samples of its abscissa; a place that stands twice is a jump, before and after it. Of an abscissa the samples."""

    unit: str = always("The SI unit of the values.")
    values: list[float] = always("The values, SI.")
    symbol: str = always("Its symbol.")
    description: str = always("What it is.")
    display_unit: str = always("The unit that it is printed in.")
    source: str = always("Where its formula stands.")
    source_symbol: str = sometimes("Its symbol in the source, where that is another.")
    abscissa: str = sometimes("The curve that it runs over; an abscissa has none.")
    breakpoints: list[float] = sometimes("Places of the abscissa at which it may jump, SI.")
    left: list[float] = sometimes("Its values just before the breakpoints.")
    right: list[float] = sometimes("Its values just after them.")
    is_spectrum: bool = sometimes("true: it is a line over numbers of a spectrum, not over a turn.")


class ShownIntervalKeys(ClosedKeys):
    """An interval as it is printed."""

    begin: str = always("Its begin.", "from")
    to: str = always("Its end.")
    length: str = always("Its length.")
    time: str = sometimes("Its time in ms, where the speed is known.")


class ShownPhaseKeys(ClosedKeys):
    """The intervals of a phase as they are printed."""

    unit: str = always("The unit of the texts.")
    intervals: list[ShownIntervalKeys] = always("The intervals.")


class PhaseKeys(ClosedKeys):
    """A phase."""

    role: str = always("What happens in it: `working`, `rest`, `moving`, `window`.")
    description: str = always("What it is.")
    abscissa: str = always("The abscissa it runs over.")
    period: float = always("The period of the abscissa, SI.")
    unit: str = always("The SI unit of the abscissa.")
    intervals: list[list[float]] = always("Its intervals, each `[begin, end]`, SI; an end may lie in the next period.")
    parts: list[str] = sometimes("The phases that it is nothing but together.")
    display: ShownPhaseKeys = always("As it is printed.")


class AbsentPhaseKeys(ClosedKeys):
    """A phase that this machine does not have."""

    description: str = always("What it is.")
    missing: list[str] = always("The keys that it needs and that are not given.")
    text: str = always("Why there is none, in words.")


class SidesKeys(ClosedKeys):
    """What a check holds against what, as it is printed."""

    demand_label: str = always("What the demand is called.")
    limit_label: str = always("What the limit is called.")
    demand_display: ShownKeys | None = always("The demand as it is printed.")
    limit_display: ShownKeys | None = always("The limit as it is printed.")
    margin_display: ShownKeys | None = always("The margin as it is printed.")


class CheckPartKeys(ClosedKeys):
    """A check of one of repeated parts; all but the status is left out where the part has nothing to compare."""

    status: CheckStatus | None = always("Its verdict; null where there is nothing to compare.")
    name: str = sometimes("The part's name.")
    demand: float = sometimes("What is needed, SI.")
    limit: float = sometimes("What is allowed, SI.")
    utilisation: float | None = sometimes("demand / limit; null where the limit is not above zero.")
    demand_label: str = sometimes("What the demand is called.")
    limit_label: str = sometimes("What the limit is called.")
    demand_display: ShownKeys = sometimes("The demand as it is printed.")
    limit_display: ShownKeys = sometimes("The limit as it is printed.")
    margin_display: ShownKeys = sometimes("The margin as it is printed.")


class CheckKeys(SidesKeys):
    """A check (docs/results.md tells what the verdicts mean)."""

    id: str = always("Its id.")
    title: str = always("Its title.")
    check_class: CheckClass = always("What it judges; `numerical` is a self-test of the calculation.", "class")
    status: CheckStatus = always("Its verdict.")
    demand: float | None = always("What is needed, SI; of several what governs.")
    limit: float | None = always("What is allowed, SI; null where it is not given.")
    operator: Literal["<", "<="] = always("How the demand must stand to the limit.")
    unit: str = always("The SI unit of both.")
    utilisation: float | None = always(
        "demand / limit (of a lower limit required / available); null where that says nothing."
    )
    source: str = always("Where the check comes from.")
    message: str = always("What was found, and what to do.")
    missing: list[str] = sometimes("The keys without which it is not made.")
    sized_to_limit: bool = sometimes("true: the program sized it to its limit, so that it shows no reserve.")
    presumed: bool = sometimes("true: it judges what the calculation presumes.")
    at: PlaceKeys = sometimes("Of a curve where it governs.")
    part: int = sometimes("Of repeated parts the one that governs, counted from 1.")
    part_name: str = sometimes("Its name.")
    parts: list[CheckPartKeys] = sometimes("All parts.")


class SelfTestCountKeys(ClosedKeys):
    """How many self-tests of the calculation there are."""

    passing: int = always("That hold.", "pass")
    fail: int = always("That do not.")


class CountKeys(ClosedKeys):
    """How many checks there are of each status."""

    passing: int = always("That hold.", "pass")
    warn: int = always("That warn.")
    fail: int = always("That do not hold.")
    not_checked: int = always("That are not made.")
    numerical: SelfTestCountKeys = always("The self-tests of the calculation.")


class WordsKeys(ClosedKeys):
    """A title with a text."""

    title: str = always("The title.")
    text: str = always("The text.")


class ErratumKeys(ClosedKeys):
    """A mistake of a source that touches this machine."""

    source: str = always("The source.")
    text: str = always("The mistake, and what is right.")
    touches: list[str] = always("What it touches.")


class ExportKeys(ClosedKeys):
    """A profile or a table that is written beside a report."""

    id: str = always("Its id, a part of the file's name.")
    title: str = always("Its title.")
    type: Literal["table", "profile"] = always("A table (CSV), or a profile (CSV and DXF).")
    abscissa: str = always("The abscissa of its columns.")
    columns: list[str] = always("The curves that are its columns.")
    error: str = sometimes("Why it could not be made.")


class ListingColumnKeys(ClosedKeys):
    """A column of a table of results."""

    id: str = always("Its id.")
    description: str = always("What it holds.")
    unit: str = always("The SI unit of its numbers.")


class ListingKeys(ClosedKeys):
    """A table of results that has as many rows as the machine gives."""

    description: str = always("What it is.")
    columns: list[ListingColumnKeys] = always("Its columns.")
    rows: list[list[float | str | None]] = always("Its rows: numbers (SI), texts, null where there is nothing.")
    taken: list[int] = sometimes("Which of its rows were taken, counted from 0.")


class MechanismKeys(ClosedKeys):
    """The results of a mechanism."""

    kind: str = always("Its kind.")
    title: str = always("What its kind is called.")
    plugin_version: str = always("The version of its plugin.")
    plugin_sha256: str = always("The SHA-256 of the plugin's code.")
    plugin_file: str = sometimes("The file of a plugin that is not the program's own.")
    plugin_check: Literal["passed", "failed"] = sometimes("Whether the formulas of such a plugin passed their check.")
    status: Status = always(
        "The worst of its checks; `error` where its plugin broke, `skipped` where it refers to one that did."
    )
    error: str = sometimes("Why it gives no results.")
    summary: str = always("What it calculates.")
    assumptions: list[str] = always("What is assumed, and where it holds.")
    sources: list[SourceKeys] = always("The sources of its formulas.")
    inputs: dict[str, InputKeys] = always("Its inputs by key; of a list's parts `gears.0.driver_teeth`.")
    lists: dict[str, str] = always("What its lists of repeated parts are, by their paths.")
    outputs: dict[str, OutputKeys] = always("Its outputs by id; of repeated parts each by its name.")
    values: dict[str, OutputKeys] = always("The numbers on the way to them by id.")
    curves: dict[str, CurveKeys] = always("Its curves, and the abscissae that they run over, by id.")
    listings: dict[str, ListingKeys] = sometimes("Its tables of results by id.")
    phases: dict[str, PhaseKeys] = always("Its phases by name.")
    phases_absent: dict[str, AbsentPhaseKeys] = always("Phases that its kind has and this machine has not.")
    checks: list[CheckKeys] = always("Its checks, and the self-tests of its calculation.")
    counts: CountKeys = always("How many of them there are.")
    warnings: list[str] = always("The messages of checks that warn.")
    sections: list[SectionKeys] = always("The printed calculation.")
    absent: list[WordsKeys] = always("What is not calculated, and why.")
    figures: list[Figure] = always("Its figures, as data.")
    exports: list[ExportKeys] = always("What is written beside a report.")
    errata: list[ErratumKeys] = always("Mistakes of its sources that touch this machine.")


class ComparisonKeys(MechanismKeys):
    """A comparison of mechanisms, in the form of a mechanism's results."""

    between: list[str] = always("The mechanisms that are compared.")
