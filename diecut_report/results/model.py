"""The results of a press: one class for each noun, from which the results file, its schema and its reference page are made.

Numbers are SI. A key without a default is always there; any other is left out of the file where it has its default.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import Field, WithJsonSchema
from pydantic.json_schema import GenerateJsonSchema
from pydantic_core import core_schema

from diecut_report.results.figure_record import Point
from diecut_report.results.mechanism_record import CountRecord, MechanismRecord, QuantityRecord, ShownRecord
from diecut_report.results.record import (
    DRAFT,
    FORM_VERSION,
    SUFFIX,
    Basis,
    CheckClass,
    CheckStatus,
    ErrorText,
    Message,
    Name,
    OpenKind,
    Record,
    Schema,
    Status,
    Text,
    Texts,
    Value,
    Verdict,
    always,
    sometimes,
)

OPEN_BLOCK = WithJsonSchema({"additionalProperties": True, "type": "object"})  # form 2.0 tells no more of it


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
    """An assumed value that moves a governing check, as files before the three verdicts hold it."""

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


class OpenRecord(Record):
    """What is left open of a machine of which no check fails: without it the verdict would be `pass`."""

    what: OpenKind = always(
        "`assumed`, `default`: a value on which a check may depend; `not_rated`: parts without a calculation; `not_checked`; `warning`."
    )
    path: str = always(
        "The path of the input, of the check (`mechanisms.NAME.checks.ID`), or of the mechanism (`mechanisms.NAME`)."
    )
    owner: str = always("Who is to settle it; empty where nobody is named.")
    why: Message = always("Why it is open.")


class PartCountRecord(Record):
    """How many parts carry load, and how many of them are calculated."""

    carrying: int = always("Parts that carry load.")
    rated: int = always("Of these those of which each way to fail has a check that was made.")
    accepted: int = always("Those that somebody accepts without a rating, with a reason.")
    not_rated: int = always("All others.")


class SummaryRecord(CountRecord):
    """The verdict as numbers: how many checks of the machine there are, which governs, what the whole rests on."""

    governing: str | None = always("The check that governs, MECHANISM.ID; null where none is made.")
    conclusion: Message = sometimes("The first line on the machine: what fails, and what is left open.", "")
    verdict: Verdict | None = sometimes(
        "`fail`: a check does not hold, or a mechanism could not be calculated; `conditional`: something is open; `pass`. Files before it have none."
    )
    open: list[OpenRecord] = sometimes("What is open, each with its owner.", [])
    accepted: list[OpenRecord] = sometimes(
        "What of the parts is not rated, and is accepted: by its `owner`, for the reason that stands there.", []
    )
    tried: bool = sometimes(
        "Whether the values that are open were tried with others: those left may change a check.", False
    )
    parts: PartCountRecord | None = sometimes("The parts that carry load, where the parts of the machine are modelled.")
    assumed: list[str] = always("The paths of inputs whose basis is `assumed`.")
    moves: list[MoveRecord] = sometimes("Of files before the three verdicts; not written any more.", [])
    advice: FollowedAdviceRecord | None = sometimes(
        "Of a report: what comes of the advice of all failing checks together."
    )


class MovedBarRecord(Record):
    """An input that moves a number, and the number with it lowered and raised; null where the machine cannot exist."""

    name: str = always("The input.")
    unit: str = always("The unit of its values.")
    lowered: float = always("Its lower value.")
    raised: float = always("Its higher value.")
    low: float | None = always("The number with the lower value.")
    high: float | None = always("The number with the higher value.")


class TornadoRecord(Record):
    """What inputs do to a number, the greatest first; values are in the unit that they are read in."""

    name: str = always("The number.")
    unit: str = always("Its unit.")
    today: float = always("Its value without a change.")
    bars: list[MovedBarRecord] = always("The inputs that move it most.")
    more: int = always("How many more move it.")
    still: int = always("How many do not.")
    at_default: int = always("How many stand at their default and were not changed.")


class ScatterRecord(Record):
    """An input that scatters."""

    name: str = always("The input.")
    unit: str = always("The unit of its values.")
    value: float = always("Its value.")
    tolerance: float = always("How far it scatters to both sides.")


class ChanceRecord(Record):
    """How probable it is that a check holds, with the interval of Clopper and Pearson."""

    check: str = always("The check.")
    held: int = always("In how many machines it holds.")
    count: int = always("Of how many.")
    probability: float = always("The share of these.")
    low: float = always("The lower end of the interval.")
    high: float = always("Its upper end.")


class TolerancesRecord(Record):
    """What tolerances do to the checks."""

    distribution: Literal["normal", "uniform"] = always("How the inputs scatter.")
    seed: int = always("The seed of the draws.")
    count: int = always("How many machines were drawn.")
    inputs: list[ScatterRecord] = always("The inputs.")
    whole: ChanceRecord = always("That no check fails.")
    checks: list[ChanceRecord] = always("Of each check, the least probable first.")


class InfluenceRecord(Record):
    """What moves what, as the chapter on it tells."""

    by: float = always("Share by which each input is lowered and raised.")
    tornados: list[TornadoRecord] = always("The numbers that are looked at.")
    tolerances: TolerancesRecord | None = sometimes("What tolerances do.")


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


# The drive line: shafts with their parts and what joins them, each with what rates it. Lengths are metres.


PartKind = Literal[
    "bearing", "gear", "pulley", "sprocket", "flywheel", "clutch", "coupling", "brake", "crank", "rocker", "geneva_wheel", "cam", "load",
    "key", "pin", "pin_bearing",
]  # fmt: skip
Few = Field(max_length=60)  # of each list: no machine has more, and its drawing takes time for each
State = Literal["rated", "not_rated", "accepted", "none"]


class RatingRecord(Record):
    """What rates a part."""

    state: State = always(
        "`none`: there is nothing to rate, as of a motor's shaft, which is its maker's, or of a flywheel's rim."
    )
    calculation: str = sometimes("The mechanism of the results that rates it.", "")
    check: str = sometimes("The id of the check that governs it there.", "")


class ShaftSectionRecord(Record):
    """A section of a shaft, from its left end."""

    start: float = always("Where it begins.")
    end: float = always("Where it ends.")
    diameter: float = always("Its diameter.")
    bore: float = sometimes("Its bore.", 0.0)


class PlacedPartRecord(Record):
    """A part on a shaft, or a piece of it that is rated by itself: its key, its pin, the bearing on that."""

    name: str = always("What it is called: SHAFT.PART, with `.key`, `.pin`, `.pin.bearing` of a piece.")
    kind: PartKind = always("Its kind.")
    start: float = always("Where its hub, its ring, or itself begins, from the shaft's left end.")
    end: float = always("Where that ends.")
    seat: float = always("The diameter on which it sits, of a pin its own; 0 where it is not known.")
    radius: float = sometimes("Its pitch radius or outer one; of what sits beside the axis how far off it.", 0.0)
    outside: float = sometimes("The outside diameter of a bearing.", 0.0)
    width: float = sometimes("How wide its body is, where that is not as long as its hub.", 0.0)
    toothed: float = sometimes("Of a sector the part of its circumference that has teeth.", 1.0)
    slots: Annotated[int, Field(le=100)] = sometimes("The number of slots of a Geneva wheel.", 0)
    of: str = sometimes("The port of a mechanism that it stands for, MECHANISM.PORT.", "")
    rating: RatingRecord = always("What rates it.")


class MachineShaftRecord(Record):
    """A shaft with its parts."""

    name: str = always("Its name.")
    axis: Point | None = sometimes("Where its axis stands in the frame; null where that is not given.")
    left: float | None = sometimes("Where its left end stands along the axes; null where no join tells.")
    sections: Annotated[list[ShaftSectionRecord], Few] = always("Its sections from left to right; none of a motor's.")
    parts: Annotated[list[PlacedPartRecord], Field(max_length=160)] = always(
        "Its parts in the order of the file, each followed by its pieces."
    )
    rating: RatingRecord = always("What rates it.")


class JoinRecord(Record):
    """A mesh, a chain or a belt."""

    name: str = always("Its name.")
    kind: Literal["mesh", "chain", "belt"] = always("Its kind.")
    drivers: Annotated[list[str], Few] = always("The driving parts.")
    driven: Annotated[list[str], Few] = always("The driven parts; none where it drives a mechanism.")
    rating: RatingRecord = always("What rates it.")


class DriveLineRecord(Record):
    """The parts of the machine as they stand."""

    shafts: Annotated[list[MachineShaftRecord], Few] = always("The shafts in the order of the file.")
    joins: Annotated[list[JoinRecord], Few] = always("What joins them.")


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
    drive_line: DriveLineRecord | None = sometimes("Where the parts of the machine are modelled: how they stand.")
    influence: Annotated[InfluenceRecord, OPEN_BLOCK] | None = sometimes(
        "Of a report with `report: {influence: …}`: what moves what, as its chapter reports it."
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

    def tagged_union_schema(self, schema: core_schema.TaggedUnionSchema) -> Schema:
        """Return one of several blocks as any union: the blocks themselves tell which is meant."""
        return self.generate_inner(core_schema.union_schema(list(schema["choices"].values())))

    def default_schema(self, schema: core_schema.WithDefaultSchema) -> Schema:
        """Return the schema of the value, which is not null where null says nothing."""
        inner = schema["schema"]
        self.generate_inner(inner)  # what is not written says so here
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
    kept = {key: value for key, value in part.items() if not (key == "title" and isinstance(value, str))}
    found = {key.removesuffix(SUFFIX): _named(value) for key, value in kept.items()}
    if isinstance(found.get("$ref"), str):
        found["$ref"] = found["$ref"].removesuffix(SUFFIX)
    return found
