"""The form of the printed calculation and of the figures."""

from __future__ import annotations

from typing import Any, Literal

from diecut_report.results.form.keys import ClosedKeys, PlaceKeys, ShownKeys, Tree, always, sometimes

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
