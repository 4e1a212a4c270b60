"""The fixed part of the press configuration: title block, press, sheet; and the file as a whole, before its mechanisms are known."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Field, field_validator

from diecut_report.config.yaml import KeyPath
from diecut_report.declaration.inputs import fault_of, of_input
from diecut_report.declaration.names import Fault
from diecut_report.errors import closest, nearest
from diecut_report.mechanism.inputs import Block, Quantity, fields, nested
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.names import FromPress, Text
from diecut_report.quantities.units import unit
from diecut_report.text.catalogues import known
from diecut_report.text.phrases import Phrase, phrase

PRESS = "press"  # the name of the press in references, beside those of the mechanisms
DETAILS = ("brief", "standard", "full")  # how much a report holds


class Revision(Block):
    """A line of the revision table."""

    revision: Annotated[str, Text("Mark of the revision")]
    date: Annotated[str | None, Text("Date as printed")] = None
    description: Annotated[str | None, Text("What was changed")] = None
    by: Annotated[str | None, Text("Who made the revision")] = None


class Project(Block):
    """What the title block prints."""

    title: Annotated[str, Text("Title of the document"), Field(min_length=1)]
    document_number: Annotated[str | None, Text("Number of the document")] = None
    revision: Annotated[str | None, Text("Mark of this revision")] = None
    date: Annotated[str | None, Text("Date as printed; if omitted, none is printed")] = None
    organisation: Annotated[str | None, Text("Organisation")] = None
    prepared_by: Annotated[str | None, Text("Who prepared the document")] = None
    checked_by: Annotated[str | None, Text("Who checked it")] = None
    norm_checked_by: Annotated[str | None, Text("Who checked it against the standards (norm control)")] = None
    approved_by: Annotated[str | None, Text("Who approved it")] = None
    department: Annotated[str | None, Text("Responsible department")] = None
    document_type: Annotated[str | None, Text("Type of the document; default: “Calculation”")] = None
    revisions: Annotated[list[Revision], Text("Revisions so far"), Field(default_factory=list)]
    language: Annotated[Literal["en", "uk"], Text("Language of the report"), AfterValidator(known)] = "en"

    @field_validator("*")
    @classmethod
    def without_reference(cls, given: Any) -> Any:
        """A text of the title block stands as it is."""
        if isinstance(given, str) and "${" in given:
            template = "is “{given}”; references stand in press and mechanisms, the title block takes plain text"
            raise ValueError(Phrase(template, given=given))
        return given


class InfluenceSettings(Block):
    """What a chapter on the influence of inputs tells."""

    of: Annotated[list[str], Text("Outputs and checks that are looked at; without them the checks that govern"),
                  Field(default_factory=list)]  # fmt: skip
    by: Annotated[float, Quantity("", "1", "Share by which each input is lowered and raised", gt=0, le=1)] = 0.1
    defaults: Annotated[bool, Text("Whether inputs that stand at their default are changed too")] = False
    tolerances: Annotated[Any, Text("Inputs that scatter, each with how far it does to both sides")] = None
    distribution: Annotated[Literal["normal", "uniform"], Text("How they scatter")] = "normal"
    count: Annotated[int, Quantity("", "1", "Machines that are drawn", ge=10, le=100_000, integer=True)] = 1000
    seed: Annotated[int, Quantity("", "1", "Equal seeds draw equal machines", ge=0, integer=True)] = 1

    @field_validator("tolerances")
    @classmethod
    def by_inputs(cls, given: Any) -> Any:
        """Sizes by the names of inputs."""
        sizes = {} if given is None else given
        if not isinstance(sizes, dict) or not all(isinstance(size, str | int | float) for size in sizes.values()):
            raise ValueError(phrase("must be written as keys and sizes, such as drive.crank_length: 0.1 mm"))
        return given


class ReportSettings(Block):
    """How the report is made."""

    detail: Annotated[Literal["brief", "standard", "full"], Text("How much the report holds")] = "standard"
    status: Annotated[Literal["draft", "for check", "released"], Text("How far the document has come")] = "draft"
    frame: Annotated[Literal["plain", "iso7200", "dstu2104"], Text("Frame and title block of the sheets")] = "plain"
    logo: Annotated[str | None, Text("File with the organisation's logo beside the configuration: PNG, SVG")] = None
    units: Annotated[Any, Text("Units in which quantities are shown, by dimension or by MECHANISM.QUANTITY")] = None
    influence: InfluenceSettings | None = None


class Sheet(Block):
    """The sheet of board."""

    length: Annotated[float | None, Quantity("L_s", "mm", "Length of the sheet", gt=0)] = None
    width: Annotated[float | None, Quantity("B_s", "mm", "Width of the sheet", gt=0)] = None
    thickness: Annotated[float | None, Quantity("Δ", "mm", "Thickness of the sheet", gt=0)] = None


class PressBlock(Block):
    """What all mechanisms of a press share."""

    name: Annotated[str, Text("Name of the press"), Field(min_length=1)]
    productivity: Annotated[float | None, Quantity("", "1/h", "Productivity in sheets", gt=0)] = None
    sheet: Sheet | None = None


class ConfigDocument(Block):
    """The whole file; the press and the mechanisms are validated one by one."""

    schema_version: Literal[1]
    project: Project
    report: Annotated[ReportSettings, Field(default_factory=ReportSettings)]
    press: dict[str, Any]
    mechanisms: Annotated[dict[str, Any], Field(min_length=1)]
    materials: Any = None  # names of files with tables of the user's own, which ``own_tables`` judges

    @field_validator("schema_version", mode="before")
    @classmethod
    def a_number(cls, given: Any) -> Any:
        """True equals 1 in Python, but is not a version."""
        if isinstance(given, bool | str):
            shown = f"“{given}”" if isinstance(given, str) else str(given).lower()
            raise ValueError(Phrase("is {shown}; the number 1 is needed, without quotes", shown=shown))
        return given


def written(key: str, data: Mapping[str, Any]) -> str:
    """Return a block's key as it is typed: a slip in it, which is told, hides nothing of what stands below."""
    strange = [name for name in data if name not in ConfigDocument.model_fields]
    return key if key in data else closest(key, strange) or key


# Defaults that inputs take from the press: each names a number that a press may give, of the input's kind.


NUMBERS = {f"press.{path}": meta for path, meta in fields(PressBlock) if isinstance(meta, Quantity)}


def faults(mechanism: Mechanism) -> Iterator[Fault]:
    """Yield the inputs with a default that the press can never give, and what the press of an example cannot be."""
    for path, meta in fields(mechanism.inputs):
        if isinstance(meta, Quantity) and meta.press is not None:
            for text in _wrong(meta, meta.press, _is_required(mechanism.inputs, path)):
                yield Fault(of_input(mechanism.inputs, path, mechanism.at), f"input {path}", text)
    example = mechanism.example
    for path, value in example.press.items() if example else ():
        number = NUMBERS.get(f"press.{path}")
        unknown = Phrase("is not a number of the press; it has {numbers}", numbers=", ".join(NUMBERS))
        refused = fault_of(number, value) if number else unknown
        if example and refused:
            yield Fault(example.at, f"example {example.name}", f"press {path} {refused}")


def _is_required(model: type[Block], path: str) -> bool:
    head, _, rest = path.partition(".")
    field = model.model_fields[head]
    inner = nested(field.annotation) if rest else None
    return _is_required(inner[0], rest) if inner else field.is_required()


def _wrong(meta: Quantity, press: FromPress, is_required: bool) -> Iterator[str]:
    if is_required:
        template = "must be given, so that {path} is never taken; write Annotated[float | None, …] = None"
        yield Phrase(template, path=press.path)
    given = NUMBERS.get(press.path)
    if given is None:
        known = ", ".join(NUMBERS)
        template = "takes {path}, which is not a number of the press{nearest}; it has {known}"
        yield Phrase(template, path=press.path, nearest=nearest(press.path, NUMBERS), known=known)
        return
    units = [meta.unit, *(other for _, other in meta.units)]
    if press.formula is None and all(unit(given.unit).kind != unit(other).kind for other in units):
        template = "in {unit} takes {path}, which is in {own}; name a formula between them: FromPress(…, formula)"
        yield Phrase(template, unit=meta.unit, path=press.path, own=given.unit)


# Plain data of a file: dicts, lists and scalars.


def texts(data: Any, key: KeyPath = ()) -> Iterator[tuple[KeyPath, str]]:
    """Every text in plain data, with its key path."""
    if isinstance(data, str):
        yield key, data
    elif isinstance(data, dict | list):
        for name, part in data.items() if isinstance(data, dict) else enumerate(data):
            yield from texts(part, (*key, name))
