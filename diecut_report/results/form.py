"""The form of the whole results file."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

from pydantic.json_schema import GenerateJsonSchema
from pydantic_core import core_schema

from diecut_report.results.form_mechanism import (
    Basis,
    ClosedKeys,
    ComparisonKeys,
    CountKeys,
    MechanismKeys,
    ShownKeys,
    Status,
    always,
    sometimes,
)


class ProgramKeys(ClosedKeys):
    """What calculated."""

    name: Literal["diecut-report"] = always("The program.")
    version: str = always("Its version.")
    source_sha256: str = always("The SHA-256 of its code.")
    libraries: dict[str, str] = always("Python, NumPy and SciPy with their versions.")
    extensions: dict[str, str] = sometimes("Extensions that were run, with the SHA-256 of their code.")


class MaterialsFileKeys(ClosedKeys):
    """A table of the user's own that the configuration names."""

    file: str = always("Its name.")
    sha256: str = always("Its SHA-256.")
    source_text: str = always("Its text.")


class LogoKeys(ClosedKeys):
    """The logo that the configuration names."""

    file: str = always("Its name.")
    sha256: str = always("Its SHA-256.")
    media_type: str = always("`image/png` or `image/svg+xml`.")
    base64: str = always("Its content.")


class CarriedConfigKeys(ClosedKeys):
    """A configuration with the files that it names."""

    file: str = always("The name of its file, without folders.")
    sha256: str = always("The SHA-256 of its file.")
    source_text: str = always("Its text.")
    materials: list[MaterialsFileKeys] = sometimes("The user's own tables that it names.")
    logo: LogoKeys = sometimes("The logo that it names.")


class ConfigKeys(CarriedConfigKeys):
    """The configuration that was calculated."""

    resolved: dict[str, Any] = always(
        "The configuration with every reference and default put in; its values are read back as exactly those that were calculated "
        "(`diecut-report schema` describes it)."
    )


class RevisionKeys(ClosedKeys):
    """A revision in the title block."""

    revision: str = always("Its mark.")
    date: str | None = always("Its date.")
    description: str = always("What changed.")
    by: str = always("Who made it.")


class ProjectKeys(ClosedKeys):
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
    revisions: list[RevisionKeys] = always("Revisions so far.")
    language: Literal["en", "uk"] = always("Language of the report; the results themselves are English.")


class ReportKeys(ClosedKeys):
    """How the report is made."""

    detail: Literal["brief", "standard", "full"] = always("How much it holds.")
    status: Literal["draft", "for check", "released"] = always("How far the document has come.")
    frame: Literal["plain", "iso7200", "dstu2104"] = always("Frame and title block of its sheets.")
    logo: str = sometimes("The file of the logo.")
    units: dict[str, str] = sometimes("Units in which quantities are shown, by dimension or by MECHANISM.QUANTITY.")
    influence: dict[str, Any] = sometimes("What the chapter about the influence of inputs is asked for.")
    only: list[str] = sometimes("The mechanisms that alone are shown.")
    template_sha256: str = sometimes("The SHA-256 of a firm's own templates.")


class PressFieldKeys(ClosedKeys):
    """A quantity of the press."""

    path: str = always("Its path, `press.productivity`.")
    description: str = always("What it is.")
    symbol: str = always("Its symbol; empty without one.")
    value: float = always("Its value, SI.")
    unit: str = always("The SI unit.")
    display: ShownKeys = always("As it is printed.")
    basis: Basis = always("What it rests on.")
    note: str = sometimes("What the user notes of it.")


class PressKeys(ClosedKeys):
    """The press."""

    name: str = always("Its name.")
    fields: list[PressFieldKeys] = always("What all mechanisms share.")


class GoverningKeys(ClosedKeys):
    """The check that governs."""

    mechanism: str = always("Its mechanism.")
    check: str = always("Its id.")


class MoveKeys(ClosedKeys):
    """An assumed value that moves a governing check."""

    path: str = always("Its path.")
    check: str = always("The check, MECHANISM.ID.")
    change: float | None = always("By how much its utilisation changes at most when the value changes by a tenth.")


class AdvisedChangeKeys(ClosedKeys):
    """A change that is advised."""

    path: str = always("The input.")
    value: str = always("Its value.")


class AdviceKeys(ClosedKeys):
    """What comes of the advice of all failing checks together."""

    changes: list[AdvisedChangeKeys] = always("The changes.")
    failing: list[str] = always("The checks that fail then.")
    error: str | None = always("Why there is no such machine; null where there is one.")


class SummaryKeys(CountKeys):
    """The verdict as numbers: how many checks of the machine there are, which governs, what the whole rests on."""

    governing: str | None = always("The check that governs, MECHANISM.ID; null where none is made.")
    conclusion: str = sometimes("The first line on the machine, in English: what fails, and what is left open.")
    assumed: list[str] = always("The paths of inputs whose basis is `assumed`.")
    moves: list[MoveKeys] = sometimes("Of a report: which assumed values move a governing check.")
    advice: AdviceKeys = sometimes("Of a report: what comes of the advice of all failing checks together.")


class LeftOutKeys(ClosedKeys):
    """Comparisons beyond the most that a configuration gets."""

    message: str = always("What to do to get one.")
    names: list[str] = always("Those that are left out.")


class WordingKeys(ClosedKeys):
    """How a text was made, so that it can be said in another language."""

    text: str = always("Its template, as it is translated.")
    values: dict[str, str | WordingKeys] = sometimes("What stands at its places.")
    one: str = sometimes("The form of one, of a text that goes with a number.")
    count: int = sometimes("That number.")


class ResultsFileKeys(ClosedKeys):
    """The results of a machine. Numbers are SI floats in their shortest exact form, never NaN or infinite; texts are English."""

    schema_version: Literal[1] = always("The first number of the version of this form.")
    form_version: str = always("The version of this form, such as `1.3`; results before 1.3 do not tell it.")
    program: ProgramKeys = always("What calculated.")
    config: ConfigKeys = always("The configuration that was calculated.")
    project: ProjectKeys = always("What the title block prints.")
    report: ReportKeys = always("How the report is made.")
    press: PressKeys = always("The press.")
    status: Status = always("The verdict: the worst of the mechanisms; `error` where one could not be calculated.")
    governing: GoverningKeys | None = always("The check that governs; null where none is made.")
    summary: SummaryKeys = always("The verdict as numbers.")
    mechanisms: dict[str, MechanismKeys] = always("The mechanisms by name, in the order of the configuration.")
    comparisons: dict[str, ComparisonKeys] = sometimes("Comparisons between mechanisms, by kind and mechanisms.")
    comparisons_left_out: LeftOutKeys = sometimes("Comparisons that are not made.")
    influence: dict[str, Any] = sometimes(
        "Of a report with `report: {influence: …}`: what moves what, as its chapter tells it."
    )
    changes: dict[str, Any] = sometimes(
        "Of a report with `--previous`: what changed (the form of `diff --format json`)."
    )
    former: CarriedConfigKeys = sometimes(
        "Of a report with `--previous`: the configuration of the former revision, from which `verify` calculates the changes again."
    )
    wordings: dict[str, WordingKeys] = always("How texts with numbers in them were made, by the texts.")


# The version of the form of the results file.


SCHEMA_VERSION = 1
"""It rises when a key changes its name or meaning, or is not written any more."""
FORM_VERSION = f"{SCHEMA_VERSION}.7"
"""Its second number rises with each addition: a key, a block, a word that a text may be; it begins at 0 with each new first number."""


# The form of the results file as JSON Schema (draft 2020-12), generated from its types.


Schema = dict[str, Any]
DRAFT = "https://json-schema.org/draft/2020-12/schema"
SUFFIX = "Keys"  # of the classes


class _WithoutDefaults(GenerateJsonSchema):
    """A key that may be left out has no default: where it is left out there is nothing."""

    def default_schema(self, schema: core_schema.WithDefaultSchema) -> Schema:
        """Return the schema of the value."""
        return self.generate_inner(schema["schema"])


def results_schema() -> Schema:
    """Return the JSON Schema of the results file."""
    made = ResultsFileKeys.model_json_schema(schema_generator=_WithoutDefaults)
    head = {
        "$schema": DRAFT,
        "$id": f"urn:diecut-report:results:{FORM_VERSION}",
        "title": "Results file of diecut-report",
    }
    return head | {key: value for key, value in _named(made).items() if key != "title"}


def _named(part: Any) -> Any:
    """A part of the schema with the names of its blocks as people know them, and without the titles that are made of names."""
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
