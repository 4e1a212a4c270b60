"""The form of the results of one mechanism, or of a comparison."""

from __future__ import annotations

from typing import Literal

from diecut_report.results.form.keys import (
    Basis,
    CheckClass,
    CheckStatus,
    ClosedKeys,
    PartOfListKeys,
    PlaceKeys,
    ShownKeys,
    Status,
    Value,
    always,
    sometimes,
)
from diecut_report.results.form.printed import Figure, SectionKeys


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
