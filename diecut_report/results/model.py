"""The results of a press: one class for each noun, from which the results file, its schema and its reference page are made.

Numbers are SI. A key without a default is always there; any other is left out of the file where it has its default.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from enum import Enum, auto
from functools import cache
from typing import Annotated, Any, Literal, Self, get_args, get_origin

from pydantic import BaseModel, ConfigDict, Field, GetCoreSchemaHandler, PrivateAttr, ValidationInfo
from pydantic.json_schema import GenerateJsonSchema
from pydantic_core import CoreSchema, core_schema

from diecut_report.text.phrases import Phrase, message_data, message_of

SCHEMA_VERSION = 1
"""The first number of the version of the contract; a script that knows it finds the names of the contract."""
FORM_VERSION = "2.0"
"""Its first number rises when a key changes its name or meaning, or is not written any more, its second with each addition."""
WORDINGS = "wordings"
"""In the context of reading a file of form 1: the texts with their templates and values, by the texts."""

Status = Literal["pass", "warn", "fail", "error", "skipped"]
CheckStatus = Literal["pass", "warn", "fail", "not_checked"]
CheckClass = Literal["function", "strength", "practice", "numerical"]
Basis = Literal["assumed", "given", "catalogue", "drawing", "standard", "measured"]
Value = float | int | bool | str
Texts = list[str]
Relation = Literal["at_least", "at_most", "equal", "between", "one_of"]
Name = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_-]*$", max_length=1000)]
Id = Annotated[str, Field(pattern=r"^[A-Za-z_][A-Za-z0-9_]*$", max_length=200)]
Tree = list[Any]  # an expression: [operation, operand, …], each operand a tree, too
TREE = 'as a tree: `[operation, operand, …]`, `["sym", name]`, `["qty", text, unit]`'

Schema = dict[str, Any]
DRAFT = "https://json-schema.org/draft/2020-12/schema"
SUFFIX = "Record"  # of the classes


class TextRole(Enum):
    """What a text is to a translator."""

    TEXT = auto()  # a sentence or a label
    WORD = auto()  # a value: a number, a choice by its key, or a name, which stands as it is
    SOURCE = auto()  # where a formula stands
    PAPER = auto()  # how a work is cited


Change = Callable[[TextRole, str], str]
"""What becomes of a text."""
Changer = Callable[[Any, Change], Any]


class Record(BaseModel):
    """Declare a block of the results that holds these keys and no others."""

    model_config = ConfigDict(
        extra="forbid", strict=True, allow_inf_nan=False, frozen=True, populate_by_name=True, hide_input_in_errors=True
    )

    def with_(self, **changes: Any) -> Self:
        """Return a copy with other values."""
        return self.model_copy(update=changes)

    def data(self) -> dict[str, Any]:
        """Return plain data, as the results file holds it."""
        return self.model_dump(by_alias=True, exclude_defaults=True)

    def with_texts(self, change: Change) -> Self:
        """Return a copy in which each text that is translated has become another one."""
        own = _text_fields(type(self))
        return self.with_(**{name: each(getattr(self, name), change) for name, each in own.items()}) if own else self


def always(meaning: str, alias: str | None = None) -> Any:
    """Return a key that is always there; ``alias`` where its name is a word of Python."""
    return Field(alias=alias, description=meaning)


def sometimes(meaning: str, default: Any = None) -> Any:
    """Return a key that is left out where it has nothing to report."""
    return Field(default=default, description=meaning)


class MessageRecord(Record):
    """A text with values in it, so that it can be given in another language."""

    template: str = always(
        "The text with places `{name}`, as it is translated; of a text that goes with a number its form."
    )
    values: dict[str, str | MessageRecord] = always("What stands at its places.")
    text: str = always("The English text: the template with its values.")
    one: str = sometimes("The form of one, of a text that goes with a number.", "")
    count: int = sometimes("That number.")


class _Translated:
    """Mark a text that is translated; ``is_message``: the file always holds how it was made, ``is_plain``: never."""

    def __init__(self, role: TextRole, *, is_message: bool = False, is_plain: bool = False) -> None:
        self.role, self.is_message, self.is_plain = role, is_message, is_plain

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        form: Any = MessageRecord if self.is_message else str if self.is_plain else str | MessageRecord
        return core_schema.with_info_plain_validator_function(
            self._read,
            serialization=core_schema.plain_serializer_function_ser_schema(self._written),
            json_schema_input_schema=handler.generate_schema(form),
        )

    def _read(self, given: Any, info: ValidationInfo) -> str:
        if isinstance(given, str):
            made: str = info.context[WORDINGS].get(given, given) if info.context else given
            return made
        return message_of(given)

    def _written(self, text: str) -> Any:
        is_made = isinstance(text, Phrase) and bool(text.values)
        return message_data(text) if self.is_message or (is_made and not self.is_plain) else str.__str__(text)


@cache
def _text_fields(model: type[Record]) -> dict[str, Changer]:
    """How the texts of each field of a class are changed; nothing of fields without any."""
    changers = {
        name: _changer(field.annotation, tuple(each for each in field.metadata if isinstance(each, _Translated)))
        for name, field in model.model_fields.items()
    }
    return {name: each for name, each in changers.items() if each is not None}


def _changer(form: Any, marks: tuple[Any, ...] = ()) -> Changer | None:
    """What changes the texts in a value of a type; None where it has none."""
    if found := [mark for mark in marks if isinstance(mark, _Translated)]:
        role = found[0].role
        return lambda value, change: change(role, value) if isinstance(value, str) and value else value
    args = get_args(form)
    if get_origin(form) is Annotated:
        return _changer(args[0], form.__metadata__)
    if isinstance(form, type) and issubclass(form, Record):
        return (lambda value, change: value.with_texts(change)) if _text_fields(form) else None
    inner = next(filter(None, map(_changer, args)), None)
    if inner is None:
        return None
    if get_origin(form) is list:
        return lambda value, change: [inner(each, change) for each in value]
    if get_origin(form) is dict:
        return lambda value, change: {key: inner(each, change) for key, each in value.items()}
    return lambda value, change: value if value is None else inner(value, change)  # of several types one


class _Drawn:
    """Mark data of figures, in which a text with values may stand at any place."""

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.with_info_before_validator_function(
            self._read, handler(source), serialization=core_schema.plain_serializer_function_ser_schema(self._written)
        )

    def _read(self, given: Any, info: ValidationInfo) -> Any:
        if isinstance(given, dict):
            if given.keys() >= {"template", "values", "text"}:
                return message_of(given)
            return {key: self._read(each, info) for key, each in given.items()}
        if isinstance(given, list):
            return [each if type(each) is float else self._read(each, info) for each in given]
        return info.context[WORDINGS].get(given, given) if info.context and isinstance(given, str) else given

    def _written(self, part: Any) -> Any:
        if isinstance(part, dict):
            return {key: self._written(each) for key, each in part.items()}
        if isinstance(part, list | tuple):
            return [each if type(each) is float else self._written(each) for each in part]
        if isinstance(part, Phrase):
            return message_data(part) if part.values else str.__str__(part)
        return part


Text = Annotated[str, _Translated(TextRole.TEXT)]
Message = Annotated[str, _Translated(TextRole.TEXT, is_message=True)]
ErrorText = Annotated[str, _Translated(TextRole.TEXT, is_plain=True)]
Word = Annotated[str, _Translated(TextRole.WORD)]
SourceText = Annotated[str, _Translated(TextRole.SOURCE)]
Paper = Annotated[str, _Translated(TextRole.PAPER)]
DrawnData = Annotated[dict[str, Any], _Drawn()]
DrawnList = Annotated[list[dict[str, Any]], _Drawn()]


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


class FigureRecord(Record):
    """A figure, as data; what its type does not have is left out. Values are SI."""

    type: Literal["plot", "chart", "polar", "bars", "drawing", "failed"] = always(
        "`plot`: curves over their abscissa; `chart`: other lines; `polar`: curves about a pole; `bars`: numbers side by side; "
        "`drawing`: of the machine; `failed`: it could not be made."
    )
    id: str = always("Its id.")
    title: Text = always("Its title.")
    caption: Text = always("What is to be seen in it.")
    shows: list[str] = sometimes("The ids of the quantities that it shows.", [])
    abscissa: str = sometimes("The abscissa of a plot or a polar plot.", "")
    panels: DrawnList = sometimes("Its panels: title, unit, and what is drawn in them.", [])
    unit: str = sometimes("The unit of distances and dimensions; `1` where a drawing is not to scale.", "")
    series: DrawnList = sometimes("The curves of a polar plot, by name, with their labels.", [])
    range: list[float | None] = sometimes("From which distance to which a polar plot reaches.", [])
    groups: DrawnList = sometimes("The groups of bars: label, unit, bars with label and value.", [])
    shapes: DrawnList = sometimes("What is drawn, back to front: shape, role, places.", [])
    schematic: bool = sometimes("true: it is not drawn to scale.", False)
    moving: DrawnData = sometimes(
        "What moves in it: over which abscissa, at which places, the shapes; those that move with their numbers at each (`moves`).",
        {},
    )
    error: ErrorText = sometimes("Why it could not be made.", "")


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


class ProgramRecord(Record):
    """What calculated."""

    name: Literal["diecut-report"] = always("The program.")
    version: str = always("Its version.")
    source_sha256: str = always("The SHA-256 of its code.")
    libraries: dict[str, str] = always("Python, NumPy and SciPy with their versions.")
    extensions: dict[str, str] = sometimes("Extensions that were run, with the SHA-256 of their code.", {})


class MaterialsFileRecord(Record):
    """A table of the user's own that the configuration names."""

    file: str = always("Its name.")
    sha256: str = always("Its SHA-256.")
    source_text: str = always("Its text.")


class LogoRecord(Record):
    """The logo that the configuration names."""

    file: str = always("Its name.")
    sha256: str = always("Its SHA-256.")
    media_type: str = always("`image/png` or `image/svg+xml`.")
    base64: str = always("Its content.")


class CarriedConfigRecord(Record):
    """A configuration with the files that it names."""

    file: str = always("The name of its file, without folders.")
    sha256: str = always("The SHA-256 of its file.")
    source_text: str = always("Its text.")
    materials: list[MaterialsFileRecord] = sometimes("The user's own tables that it names.", [])
    logo: LogoRecord | None = sometimes("The logo that it names.")


class ConfigRecord(CarriedConfigRecord):
    """The configuration that was calculated."""

    resolved: dict[str, Any] = always(
        "The configuration with every reference and default put in; its values are read back as exactly those that were calculated "
        "(`diecut-report schema` describes it)."
    )


class RevisionRecord(Record):
    """A revision in the title block."""

    revision: str = always("Its mark.")
    date: str | None = always("Its date.")
    description: str = always("What changed.")
    by: str = always("Who made it.")


class ProjectRecord(Record):
    """What the title block prints; empty where it is not given."""

    title: str = always("Title of the document.")
    document_number: str = always("Its number.")
    revision: str = always("Mark of this revision.")
    date: str | None = always("Its date, as it is to be printed.")
    organisation: str = always("Organisation.")
    prepared_by: str = always("Who prepared it.")
    checked_by: str = always("Who checked it.")
    norm_checked_by: str = always("Who checked it against the standards.")
    approved_by: str = always("Who approved it.")
    department: str = always("Responsible department.")
    document_type: str = always("Type of the document.")
    revisions: list[RevisionRecord] = always("Revisions so far.")
    language: Literal["en", "uk"] = always("Language of the report; the results themselves are English.")


class ReportRecord(Record):
    """How the report is made."""

    detail: Literal["brief", "standard", "full"] = always("How much it holds.")
    status: Literal["draft", "for check", "released"] = always("How far the document has come.")
    frame: Literal["plain", "iso7200", "dstu2104"] = always("Frame and title block of its sheets.")
    logo: str = sometimes("The file of the logo.", "")
    units: dict[str, str] = sometimes("Units in which quantities are shown, by dimension or by MECHANISM.QUANTITY.", {})
    influence: dict[str, Any] = sometimes("What the chapter about the influence of inputs is asked for.", {})
    only: list[str] = sometimes("The mechanisms that alone are shown.", [])
    template_sha256: str = sometimes("The SHA-256 of a firm's own templates.", "")


class PressRecord(Record):
    """The press."""

    name: str = always("Its name.")
    fields: list[QuantityRecord] = always("What all mechanisms share, each with its path `press.productivity`.")


class GoverningRecord(Record):
    """The check that governs."""

    mechanism: str = always("Its mechanism.")
    check: str = always("Its id.")

    def __str__(self) -> str:
        return f"{self.mechanism}.{self.check}"


class MoveRecord(Record):
    """An assumed value that moves a governing check."""

    path: str = always("Its path.")
    check: str = always("The check, MECHANISM.ID.")
    change: float | None = always("By how much its utilisation changes at most when the value changes by a tenth.")


class AdvisedChangeRecord(Record):
    """A change that is advised."""

    path: str = always("The input.")
    value: str = always("Its value.")


class FollowedAdviceRecord(Record):
    """What comes of the advice of all failing checks together."""

    changes: list[AdvisedChangeRecord] = always("The changes.")
    failing: list[str] = always("The checks that fail then.")
    error: ErrorText | None = always("Why there is no such machine; null where there is one.")


class SummaryRecord(CountRecord):
    """The verdict as numbers: how many checks of the machine there are, which governs, what the whole rests on."""

    governing: str | None = always("The check that governs, MECHANISM.ID; null where none is made.")
    conclusion: Message = sometimes("The first line on the machine: what fails, and what is left open.", "")
    assumed: list[str] = always("The paths of inputs whose basis is `assumed`.")
    moves: list[MoveRecord] = sometimes("Of a report: which assumed values move a governing check.", [])
    advice: FollowedAdviceRecord | None = sometimes(
        "Of a report: what comes of the advice of all failing checks together."
    )


class LeftOutRecord(Record):
    """Comparisons beyond the most that a configuration gets."""

    message: Message = always("What to do to get one.")
    names: list[str] = always("Those that are left out.")


class ChangedDocumentRecord(Record):
    """One side of a comparison of two results files."""

    title: str = always("Title of the document.")
    document_number: str = always("Its number.")
    revision: str = always("Its revision.")
    date: str = always("Its date.")
    file: str = always("The name of its configuration.")
    sha256: str = always("The SHA-256 of that.")
    press: str = always("The name of the press.")
    status: Status = always("The verdict.")
    checks: dict[str, int] = always("How many checks there are of each status.")
    governing: str = always("The check that governs, MECHANISM.ID; empty where none is made.")
    governing_title: Text = always("Its title.")


class ChangedTextRecord(Record):
    """What a mechanism was and is; empty where there is none."""

    name: str = always("Its name.")
    old: str = always("Its kind then.")
    new: str = always("Its kind now.")


class ChangedCodeRecord(Record):
    """A program or a plugin whose code is another one."""

    name: str = always("Its name.")
    old: list[str] = always("Version and SHA-256 then.")
    new: list[str] = always("Version and SHA-256 now.")


class CheckSideRecord(Record):
    """A check of one side."""

    status: CheckStatus = always("Its verdict.")
    utilisation: float | None = always("Its utilisation; null where that says nothing.")
    message: Message = always("What was found.")


class ChangedCheckRecord(Record):
    """A check that changed."""

    mechanism: str = always("Its mechanism.")
    id: str = always("Its id.")
    title: Text = always("Its title.")
    check_class: CheckClass = always("What it judges.", "class")
    old: CheckSideRecord | None = always("What it was; null where it is new.")
    new: CheckSideRecord | None = always("What it is; null where it is gone.")
    change: Literal["worse", "better", "added", "removed", "more used", "less used"] = always("What happened to it.")


class QuantitySideRecord(Record):
    """A quantity of one side."""

    value: Value | Texts = always("Its value, SI.")
    unit: str = always("The SI unit.")
    display: ShownRecord = always("As it is printed, with so many digits that both sides can be told apart.")
    basis: Basis | Literal[""] = sometimes("What it rests on.", "")


class ChangedQuantityRecord(Record):
    """An input or an output that changed."""

    path: str = always("Its path.")
    symbol: str = always("Its symbol.")
    description: Text = always("What it is.")
    old: QuantitySideRecord | None = always("What it was; null where it is new.")
    new: QuantitySideRecord | None = always("What it is; null where it is gone.")
    relative: float | None = always("The change as a share of the old value; null where there is none.")
    follows: str = always("The paths that an input follows by itself; empty where the user changed it.")
    key: bool = sometimes("true: it is one of the key results.", False)


class ChangesRecord(Record):
    """What changed between two results files, in each list the most important first."""

    schema_version: Literal[1] = always("The version of this form.")
    old: ChangedDocumentRecord = always("The former one.")
    new: ChangedDocumentRecord = always("This one.")
    mechanisms: list[ChangedTextRecord] = always("The mechanisms that came, went, or are of another kind.")
    checks: list[ChangedCheckRecord] = always("The checks that changed.")
    inputs: list[ChangedQuantityRecord] = always("The inputs that changed.")
    outputs: list[ChangedQuantityRecord] = always("The outputs that changed.")
    code: list[ChangedCodeRecord] = always("The program and the plugins whose code is another one.")


class ResultsRecord(Record):
    """The results of a machine. Numbers are SI floats in their shortest exact form, never NaN or infinite; texts are English."""

    schema_version: Literal[1] = always("The version of the contract that scripts rely on.")
    form_version: str = always("The version of this form, such as `2.0`.")
    program: ProgramRecord = always("What calculated.")
    config: ConfigRecord = always("The configuration that was calculated.")
    project: ProjectRecord = always("What the title block prints.")
    report: ReportRecord = always("How the report is made.")
    press: PressRecord = always("The press.")
    status: Status = always("The verdict: the worst of the mechanisms; `error` where one could not be calculated.")
    governing: GoverningRecord | None = always("The check that governs; null where none is made.")
    summary: SummaryRecord = always("The verdict as numbers.")
    mechanisms: dict[Name, MechanismRecord] = always("The mechanisms by name, in the order of the configuration.")
    comparisons: dict[Name, MechanismRecord] = sometimes("Comparisons between mechanisms, by kind and mechanisms.", {})
    comparisons_left_out: LeftOutRecord | None = sometimes("Comparisons that are not made.")
    influence: DrawnData = sometimes(
        "Of a report with `report: {influence: …}`: what moves what, as its chapter reports it.", {}
    )
    changes: ChangesRecord | None = sometimes(
        "Of a report with `--previous`: what changed (the form of `diff --format json`)."
    )
    former: CarriedConfigRecord | None = sometimes(
        "Of a report with `--previous`: the configuration of the former revision, from which `verify` calculates the changes again."
    )

    @property
    def calculated(self) -> Mapping[str, MechanismRecord]:
        """Return all that plugins gave: the mechanisms and the comparisons by name."""
        return {**self.mechanisms, **self.comparisons}


# The form as JSON Schema (draft 2020-12).


class _WithoutDefaults(GenerateJsonSchema):
    """A key that may be left out has no default: where it is left out there is nothing."""

    def default_schema(self, schema: core_schema.WithDefaultSchema) -> Schema:
        """Return the schema of the value, which is not null where null says nothing."""
        inner = schema["schema"]
        return self.generate_inner(inner["schema"] if inner["type"] == "nullable" else inner)


def results_schema() -> Schema:
    """Return the JSON Schema of the results file."""
    made = ResultsRecord.model_json_schema(schema_generator=_WithoutDefaults)
    head = {
        "$schema": DRAFT,
        "$id": f"urn:diecut-report:results:{FORM_VERSION}",
        "title": "Results file of diecut-report",
    }
    return head | {key: value for key, value in _named(made).items() if key != "title"}


def _named(part: Any) -> Any:
    """Return a part of the schema with the names of its blocks as people know them, and without the titles that are made of names."""
    if isinstance(part, list):
        return [_named(each) for each in part]
    if not isinstance(part, Mapping):
        return part
    found = {key.removesuffix(SUFFIX): _named(value) for key, value in part.items() if not _is_title(key, value)}
    if isinstance(found.get("$ref"), str):
        found["$ref"] = found["$ref"].removesuffix(SUFFIX)
    return found


def _is_title(key: str, value: Any) -> bool:
    return key == "title" and isinstance(value, str)
