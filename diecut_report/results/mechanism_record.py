"""The results of one mechanism: its chapters, quantities, curves, phases and checks, one class for each noun.

Numbers are SI. A key without a default is always there; any other is left out of the file where it has its default.
"""

from __future__ import annotations

from typing import Literal, Self

from pydantic import PrivateAttr

from diecut_report.results.figure_record import FigureRecord
from diecut_report.results.record import (
    TREE,
    Basis,
    CheckClass,
    CheckStatus,
    ErrorText,
    Id,
    Message,
    Paper,
    Record,
    Relation,
    SourceText,
    Status,
    Text,
    Texts,
    Tree,
    Value,
    Word,
    always,
    sometimes,
)


class ShownRecord(Record):
    """A number as it is printed."""

    text: Word = always("The number as a neutral text (decimal point, `1.2e-05`), or words.")
    unit: str = always("The unit that it is printed in; `1` without one.")


class PlaceRecord(Record):
    """A place of an abscissa."""

    symbol: str = always("The symbol of the abscissa.")
    text: Word = always("The place, in the unit.")
    unit: str = always("The unit of the text.")
    value: float | None = sometimes("Of a result's extreme the place as it is calculated, SI.")


class PartRecord(Record):
    """Which of repeated parts a quantity is of."""

    family: str = always("The list in the configuration, or what names its parts.")
    index: int = always("Its place, counted from 0.")
    number: int | None = sometimes("The number in its name, where that holds one.")
    quantity: str = sometimes("What it is of each part.", "")


class _Marked(Record):
    """What a page of changes may mark."""

    _before: str = PrivateAttr("")

    @property
    def before(self) -> str:
        """Return what stood here in the former revision, in words; nothing where that is the same, or not asked for."""
        return self._before

    def marked(self, before: str) -> Self:
        """Return a copy that knows what stood here before."""
        made = self.model_copy()
        made._before = before
        return made


class QuantityRecord(_Marked):
    """An input, an output, or a number on the way to one. An output that does not apply to this machine is left out."""

    value: Value | Texts = always("Its value, SI; of an input that is a curve or varies over a cycle words.")
    unit: str = always("The SI unit of the value, in ASCII that pint reads; `1` for pure numbers and texts.")
    symbol: str = always("Its symbol; empty without one.")
    description: Text = always("What it is.")
    display: ShownRecord = always("As it is printed.")
    source: SourceText = sometimes("Of a result where its formula stands.", "")
    source_symbol: str = sometimes("Its symbol in the source, where that is another.", "")
    key: bool = sometimes("true: it is one of the key results.", False)
    at: PlaceRecord | None = sometimes("Of an extreme where it lies.")
    list: str = sometimes("Of a result the list over whose parts it runs.", "")
    part: PartRecord | None = sometimes("Of which of repeated parts it is.")
    origin: Literal["", "given", "default", "reference", "expression"] = sometimes(
        "Of an input where it comes from.", ""
    )
    path: str = sometimes("Of an input the path that it refers to; of a field of the press its own.", "")
    paths: Texts = sometimes("The paths that its expression refers to.", [])
    text: str = sometimes("Its text as typed.", "")
    basis: Basis | Literal[""] = sometimes(
        "What it rests on; of a reference the weakest of all that it follows from.", ""
    )
    note: str = sometimes("What the user notes of it.", "")


class CurveRecord(Record):
    """A curve at the samples of its abscissa; a place that stands twice is a jump, before and after it. Of an abscissa the samples."""

    unit: str = always("The SI unit of the values.")
    values: list[float] = always("The values, SI.")
    symbol: str = always("Its symbol.")
    description: Text = always("What it is.")
    display_unit: str = always("The unit that it is printed in.")
    source: SourceText = always("Where its formula stands.")
    source_symbol: str = sometimes("Its symbol in the source, where that is another.", "")
    abscissa: str = sometimes("The curve that it runs over; an abscissa has none.", "")
    breakpoints: list[float] = sometimes("Places of the abscissa at which it may jump, SI.", [])
    left: list[float] = sometimes("Its values just before the breakpoints.", [])
    right: list[float] = sometimes("Its values just after them.", [])
    is_spectrum: bool = sometimes("true: it is a line over numbers of a spectrum, not over a turn.", False)


class ShownIntervalRecord(Record):
    """An interval as it is printed."""

    begin: str = always("Its begin.", "from")
    to: str = always("Its end.")
    length: str = always("Its length.")
    time: str = sometimes("Its time in ms, where the speed is known.", "")


class ShownPhaseRecord(Record):
    """The intervals of a phase as they are printed."""

    unit: str = always("The unit of the texts.")
    intervals: list[ShownIntervalRecord] = always("The intervals.")


class PhaseRecord(Record):
    """A phase."""

    role: str = always("What happens in it: `working`, `rest`, `moving`, `window`.")
    description: Text = always("What it is.")
    abscissa: str = always("The abscissa it runs over.")
    period: float = always("The period of the abscissa, SI.")
    unit: str = always("The SI unit of the abscissa.")
    intervals: list[list[float]] = always("Its intervals, each `[begin, end]`, SI; an end may lie in the next period.")
    parts: list[str] = sometimes("The phases that it is nothing but together.", [])
    display: ShownPhaseRecord = always("As it is printed.")


class AbsentPhaseRecord(Record):
    """A phase that this machine does not have."""

    description: Text = always("What it is.")
    missing: list[str] = always("The keys that it needs and that are not given.")
    text: Message = always("Why there is none.")


class CheckPartRecord(Record):
    """A check of one of repeated parts; all but the status is left out where the part has nothing to compare."""

    status: CheckStatus | None = always("Its verdict; null where there is nothing to compare.")
    name: Word = sometimes("The part's name.", "")
    demand: float | None = sometimes("What is needed, SI.")
    limit: float | None = sometimes("What is allowed, SI.")
    utilisation: float | None = sometimes("demand / limit; left out where the limit is not above zero.")
    demand_label: Text = sometimes("What the demand is called.", "")
    limit_label: Text = sometimes("What the limit is called.", "")
    demand_display: ShownRecord | None = sometimes("The demand as it is printed.")
    limit_display: ShownRecord | None = sometimes("The limit as it is printed.")
    margin_display: ShownRecord | None = sometimes("The margin as it is printed.")


class KeyChangeRecord(Record):
    """A change that is advised."""

    key: str = always("The key, of a list's part by its path: `sections.0.diameter`.")
    relation: Relation = always("How the key must stand to the value.")
    value: Value | list[Value] = always("The value; two of them for `between`, some for `one_of`.")
    unit: str = always("The unit of the value, in which it may be typed; `1` without one.")
    mechanism: str = sometimes(
        "The mechanism of the key, where that is another one: the bearings of a shaft that grows.", ""
    )

    @property
    def told(self) -> str:
        """Return the key as it is told beside the check: with its mechanism where that is another one."""
        return f"{self.mechanism}.{self.key}" if self.mechanism else self.key


class CheckRecord(_Marked):
    """A check (docs/results.md explains the verdicts)."""

    id: str = always("Its id.")
    title: Text = always("Its title.")
    check_class: CheckClass = always("What it judges; `numerical` is a self-test of the calculation.", "class")
    status: CheckStatus = always("Its verdict.")
    demand: float | None = always("What is needed, SI; of several what governs.")
    limit: float | None = always("What is allowed, SI; null where it is not given.")
    operator: Literal["<", "<="] = always("How the demand must stand to the limit.")
    unit: str = always("The SI unit of both.")
    utilisation: float | None = always(
        "demand / limit (of a lower limit required / available); null where that says nothing."
    )
    source: SourceText = always("Where the check comes from.")
    message: Message = always("What was found, and what to do.")
    demand_label: Text = always("What the demand is called.")
    limit_label: Text = always("What the limit is called.")
    demand_display: ShownRecord | None = always("The demand as it is printed.")
    limit_display: ShownRecord | None = always("The limit as it is printed.")
    margin_display: ShownRecord | None = always("The margin as it is printed.")
    missing: list[str] = sometimes("The keys without which it is not made.", [])
    advice: list[list[KeyChangeRecord]] = sometimes(
        "Of a check that does not hold: changes with which it holds, each way by itself, each way a list of changes.",
        [],
    )
    at: PlaceRecord | None = sometimes("Of a curve where it governs.")
    part: int | None = sometimes("Of repeated parts the one that governs, counted from 1.")
    part_name: Word = sometimes("Its name.", "")
    parts: list[CheckPartRecord] = sometimes("All parts.", [])
    sized_to_limit: bool = sometimes("true: the program sized it to its limit, so that it shows no reserve.", False)
    presumed: bool = sometimes("true: it judges what the calculation presumes.", False)


class ConversionRecord(Record):
    """A quantity that goes into a formula in another unit than it is shown in."""

    symbol: str = always("Its symbol.")
    shown: ShownRecord = always("As it is shown.")
    converted: ShownRecord = always("As it goes in.")


class DefinitionRecord(Record):
    """What a name in a formula stands for."""

    defined: Tree = always(f"The name with its arguments, {TREE}.")
    stands_for: Tree = always("What it stands for.", "as")


class PrintedColumnRecord(Record):
    """The head of a column of a printed table."""

    title: Text = always("What it holds.")
    symbol: str = always("Its symbol; empty without one.")
    unit: str = always("The unit of its texts.")


class ItemRecord(_Marked):
    """A step of the printed calculation: what its type does not have is left out."""

    type: Literal["formula", "choice", "found", "reduction", "lookup", "note", "table"] = always(
        "`formula`: with the numbers in it; `choice`: a branch, or whether a condition holds; `found`: a number that satisfies an equation; "
        "`reduction`: what is taken of a curve or of repeated parts; `lookup`: a number out of a table; `note`: a sentence; `table`."
    )
    id: str = sometimes("Its id, which is that of the quantity it gives.", "")
    symbol: str = sometimes("The symbol of that quantity.", "")
    description: Text = sometimes("What it is.", "")
    source: SourceText = sometimes("Where the formula stands.", "")
    result: ShownRecord | None = sometimes("The result.")
    at: PlaceRecord | None = sometimes("Of a curve the place at which it is shown; of an extreme where it lies.")
    note: Text = sometimes("What is to be known of it.", "")
    equation: Tree | None = sometimes(f"The formula, {TREE}.")
    substituted: Tree | None = sometimes("The same with numbers, where there are some to put in.")
    table_rows: Word = sometimes("Of a number between two rows of a table: these rows.", "")
    series: Text = sometimes("The table or standard series that it is taken from.", "")
    bridge: ShownRecord | None = sometimes("The result in the unit that the numbers give, before it is converted.")
    conversions: list[ConversionRecord] = sometimes("Quantities that go in in another unit.", [])
    where: list[DefinitionRecord] = sometimes("What names in it stand for.", [])
    words: Text = sometimes("Of a choice which branch, in words.", "")
    condition: Tree | None = sometimes("The condition that holds.")
    condition_substituted: Tree | None = sometimes("The same with numbers.")
    relation: Tree | None = sometimes("The equation that a number satisfies that is found.")
    method: Text = sometimes("How it was found.", "")
    chosen: bool = sometimes("true: it was chosen in the place of an input that may be given.", False)
    residual: ShownRecord | None = sometimes("How far from zero the equation is, or a proof by other means differs.")
    of: str = sometimes("Of a reduction the symbol of what it is taken of.", "")
    operation: str = sometimes(
        "What is taken: `max`, `abs_max`, `min`, `range`, `mean`, `rms`, `integral`, `sum`, `first`, `last`, `pick` …",
        "",
    )
    over: PlaceRecord | None = sometimes("Of an integral what it runs over, from 0 to this place.")
    by: Text = sometimes("Of a lookup what the row is taken by.", "")
    key: Word = sometimes("The row's name, or symbol and number; `as given` where the number is given.", "")
    table: Text = sometimes("The title of the table.", "")
    column: Word = sometimes("The column of the table.", "")
    text: Message = sometimes("The sentence of a note.", "")
    title: Text = sometimes("The title of a table.", "")
    columns: list[PrintedColumnRecord] = sometimes("The heads of its columns.", [])
    rows: list[list[Word]] = sometimes("Its rows, as printed.", [])

    @property
    def outcome(self) -> ShownRecord:
        """Return the result of a step that has one, which all have but notes and tables."""
        assert self.result is not None, self.type
        return self.result


class SectionRecord(Record):
    """A part of the printed calculation."""

    title: Text = always("Its title.")
    text: Text = always("What stands below it.")
    items: list[ItemRecord] = always("Its steps, in their order.")
    shown: list[PlaceRecord] = sometimes("The places at which its curves are shown.", [])


class SourceRecord(Record):
    """A source of formulas or data."""

    id: SourceText = always("What formulas call it.")
    citation: Paper = always("Its citation.")


class SelfTestCountRecord(Record):
    """How many self-tests of the calculation there are."""

    passing: int = always("That hold.", "pass")
    fail: int = always("That do not.")


class CountRecord(Record):
    """How many checks there are of each status."""

    passing: int = always("That hold.", "pass")
    warn: int = always("That warn.")
    fail: int = always("That do not hold.")
    not_checked: int = always("That are not made.")
    numerical: SelfTestCountRecord = always("The self-tests of the calculation.")

    def of(self, status: str) -> int:
        """Return how many there are of a status."""
        return int(getattr(self, "passing" if status == "pass" else status))


class AbsentRecord(Record):
    """What is not calculated, and why."""

    title: Text = always("What it is.")
    text: Message = always("Why.")


class ErratumRecord(Record):
    """A mistake of a source that touches this machine."""

    source: SourceText = always("The source.")
    text: Text = always("The mistake, and what is right.")
    touches: list[Text] = always("What it touches.")


class ExportRecord(Record):
    """A profile or a table that is written beside a report."""

    id: Id = always("Its id, a part of the file's name.")
    title: Text = always("Its title.")
    type: Literal["table", "profile"] = always("A table (CSV), or a profile (CSV and DXF).")
    abscissa: str = always("The abscissa of its columns.")
    columns: list[str] = always("The curves that are its columns.")
    error: ErrorText = sometimes("Why it could not be made.", "")


class ListingColumnRecord(Record):
    """A column of a table of results."""

    id: str = always("Its id.")
    description: Text = always("What it holds.")
    unit: str = always("The SI unit of its numbers.")


class ListingRecord(Record):
    """A table of results that has as many rows as the machine gives."""

    description: Text = always("What it is.")
    columns: list[ListingColumnRecord] = always("Its columns.")
    rows: list[list[float | Word | None]] = always("Its rows: numbers (SI), texts, null where there is nothing.")
    taken: list[int] = sometimes("Which of its rows were taken, counted from 0.", [])


class MechanismRecord(Record):
    """The results of a mechanism."""

    kind: str = always("Its kind.")
    title: Text = always("What its kind is called.")
    part: str = sometimes("The part of the machine that it is made of: `shafts.crank`, `meshes.step_up`.", "")
    plugin_version: str = always("The version of its plugin.")
    plugin_sha256: str = always("The SHA-256 of the plugin's code.")
    plugin_file: str = sometimes("The file of a plugin that is not the program's own.", "")
    plugin_check: Literal["", "passed", "failed"] = sometimes(
        "Whether the formulas of such a plugin passed their check.", ""
    )
    status: Status = always(
        "The worst of its checks; `error` where its plugin broke, `skipped` where it refers to one that did."
    )
    error: ErrorText = sometimes("Why it gives no results.", "")
    summary: Text = always("What it calculates.")
    assumptions: list[Text] = always("What is assumed, and where it holds.")
    sources: list[SourceRecord] = always("The sources of its formulas.")
    inputs: dict[str, QuantityRecord] = always("Its inputs by key; of a list's parts `gears.0.driver_teeth`.")
    lists: dict[str, Text] = always("What its lists of repeated parts are, by their paths.")
    outputs: dict[str, QuantityRecord] = always("Its outputs by id; of repeated parts each by its name.")
    values: dict[str, QuantityRecord] = always("The numbers on the way to them by id.")
    listings: dict[str, ListingRecord] = sometimes("Its tables of results by id.", {})
    curves: dict[str, CurveRecord] = always("Its curves, and the abscissae that they run over, by id.")
    phases: dict[str, PhaseRecord] = always("Its phases by name.")
    phases_absent: dict[str, AbsentPhaseRecord] = always("Phases that its kind has and this machine has not.")
    checks: list[CheckRecord] = always("Its checks, and the self-tests of its calculation.")
    counts: CountRecord = always("How many of them there are.")
    warnings: list[Message] = always("The messages of checks that warn.")
    sections: list[SectionRecord] = always("The printed calculation.")
    absent: list[AbsentRecord] = always("What is not calculated, and why.")
    figures: list[FigureRecord] = always("Its figures, as data.")
    exports: list[ExportRecord] = always("What is written beside a report.")
    errata: list[ErratumRecord] = always("Mistakes of its sources that touch this machine.")
    between: list[str] = sometimes("Of a comparison the mechanisms that are compared.", [])

    @property
    def is_doubtful(self) -> bool:
        """Return whether the formulas of its plugin have faults."""
        return self.plugin_check == "failed"
