"""The keys of a study file, with the forms in which the values of a varied path may be given, and their JSON Schema for editors."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, create_model

from diecut_report.config.model import ConfigDocument
from diecut_report.config.schema import DRAFT, NUMBER, Schema, block_schema
from diecut_report.mechanism.inputs import Block, Quantity
from diecut_report.mechanism.names import Text
from diecut_report.study.definition.base_inputs import Input

DRAWN = ("latin_hypercube", "sobol")
DISTRIBUTIONS = {"uniform": ("low", "high"), "normal": ("mean", "sd"), "triangular": ("low", "mode", "high")}

Texts = Annotated[list[Annotated[str, Field(min_length=1)]], Field(default_factory=list)]


def _whole(description: str, symbol: str = "", **limits: Any) -> Quantity:
    return Quantity(symbol, "1", description, integer=True, **limits)


# fmt: off


class SampleForm(Block):
    """Declare how the variants are taken from what is varied."""

    method: Annotated[Literal["grid", "zip", "latin_hypercube", "sobol", "table"], Text(
        "grid: each value with each; zip: the first values together, the second together …; "
        "latin_hypercube, sobol: count variants spread over all; table: the rows of a file")]
    count: Annotated[int | None, _whole("Number of variants of latin_hypercube and sobol", "n", ge=1, le=1e12)] = None
    seed: Annotated[int | None, _whole("Seed of latin_hypercube and sobol; equal seeds give equal samples", ge=0, le=2**53)] = None
    indices: Annotated[bool, Text("For sobol: count groups of variants from which first and total Sobol indices follow")] = False
    file: Annotated[str | None, Text("For table: a CSV, Parquet or XLSX file with paths and units as heads, `PATH [rpm]`")] = None


class ObjectiveForm(Block):
    """Declare an output that is to be as small or as great as can be."""

    minimise: Annotated[str | None, Text("An output, such as cylinder.mass, that is to be small")] = None
    maximise: Annotated[str | None, Text("An output that is to be great")] = None


class OptimiseForm(Block):
    """Declare what `optimise` searches for, and how long."""

    objectives: Annotated[list[ObjectiveForm] | None, Text(
        "What is to be small or great: outputs, or varied inputs such as press.productivity; without it those of the study")] = None
    evaluations: Annotated[int, _whole("Machines that are tried", ge=1, le=1e8)] = 2000
    population: Annotated[int | None, _whole("Machines of a generation; without it a fortieth of all, 40 to 500", ge=4, le=1e5)] = None
    seed: Annotated[int, _whole("Seed of the search; equal seeds search alike", ge=0, le=2**53)] = 1
    passing: Annotated[bool, Text("Only machines of which no check fails")] = True
    points: Annotated[int, _whole("Points of the front that are listed, and calculated again one by one", ge=1, le=1000)] = 20


class TableForm(Block):
    """Declare the values of a column of a file."""

    table: Annotated[str, Text("A CSV, Parquet or XLSX file beside the study file"), Field(min_length=1)]
    column: Annotated[str | None, Text("The column; without it the one named as the path")] = None


class StudyDocument(Block):
    """Declare the whole study file; what is varied is judged path by path."""

    schema_version: Annotated[Literal[1], BeforeValidator(ConfigDocument.a_number)]
    base: Annotated[str, Text("The config that is varied, beside the study file"), Field(min_length=1)]
    sample: Annotated[SampleForm | None, Text("How the variants are taken; not needed beside optimise")] = None
    vary: Annotated[dict[str, Any], Text("For each varied path its values: a list, a range or a distribution"), Field(default_factory=dict)]
    constraints: Annotated[Texts, Text("What must hold between inputs, and of outputs; variants where it does not are dropped")]
    outputs: Annotated[list[str] | None, Text("The outputs to keep, such as drive.crank_torque_peak; without it all")] = None
    curves: Annotated[Texts, Text("The curves to keep; without it none")]
    objectives: Annotated[list[ObjectiveForm], Text("What is to be small or great"), Field(default_factory=list)]
    optimise: Annotated[OptimiseForm | None, Text("What the command optimise searches for in what is varied")] = None
    # judged as a whole where the sample is known: of each type of value two faults would be reported
    reports: Annotated[Any, Text("The variants that get a full report: none, failed, best N, all, or a list of numbers")] = None


# fmt: on


def value_form(asked: Input) -> type[Block]:
    """Return the form of one value of a list."""
    return create_model("One", __base__=Block, value=(asked.declared_as, ...))


def range_form(asked: Input) -> type[Block]:
    """Return the form of values from … to."""
    keys: dict[str, Any] = {
        "from": (asked.declared_as, ...),
        "to": (asked.declared_as, ...),
        "count": (Annotated[int | None, _whole("Number of values", ge=1, le=1e9)], None),
        "spacing": (Annotated[Literal["linear", "log"], Text("Equal steps, or equal ratios")], "linear"),
    }
    return create_model("Range", __base__=Block, **keys)


def distribution_form(asked: Input, law: str) -> type[Block]:
    """Return the form of a distribution with its limits; its standard deviation has the input's unit, but not its bounds."""
    assert isinstance(asked.meta, Quantity)
    keys: dict[str, Any] = {"low": asked.declared_as, "mode": asked.declared_as, "high": asked.declared_as}
    keys["mean"] = Annotated[float, replace(asked.meta, integer=False)]
    keys["sd"] = Annotated[float, Quantity("", asked.meta.unit, "Standard deviation", gt=0)]
    given: dict[str, Any] = {name: (keys[name], ...) for name in DISTRIBUTIONS[law]}
    if law == "normal":
        given |= dict.fromkeys(("low", "high"), (Annotated[float | None, *asked.metadata], None))
    forms = Annotated[Literal["uniform", "normal", "triangular"], Text("Form of the distribution")]
    given["distribution"] = (forms, ...)
    return create_model(law.capitalize(), __base__=Block, **given)


# --- JSON Schema (draft 2020-12) -------------------------------------------------------------------------------------

PATH = r"^(mechanisms\.[A-Za-z][A-Za-z0-9_-]*|press|machine|(shafts|meshes|chains|belts)\.\w+)(\.[\w-]+)+$"
OUTPUT: Schema = {"type": "string", "pattern": r"^[A-Za-z][A-Za-z0-9_-]*(\.\w+)+$"}
QUANTITY: Schema = {"anyOf": [{"type": "number"}, {"type": "string", "pattern": NUMBER}]}
OBJECTIVES: Schema = {
    "type": "array",
    "items": {
        "type": "object",
        "additionalProperties": False,
        "description": "An output.",
        "properties": {"minimise": OUTPUT, "maximise": OUTPUT},
        "minProperties": 1,
        "maxProperties": 1,
    },
}


def study_schema() -> Schema:
    """Return the schema of a study; whether its paths are there is known only with its base."""
    optimise = block_schema(OptimiseForm, refers=False)
    optimise["properties"]["objectives"] = OBJECTIVES | _described(OptimiseForm, "objectives")
    words = {"type": "string", "pattern": r"^(none|failed|all|best\s+[1-9]\d*)$"}
    numbers = {"type": "array", "items": {"type": "integer", "minimum": 0}}
    forms: dict[str, Schema] = {
        "schema_version": {"const": 1, "description": "Version of this form of the file."},
        "base": {"type": "string", "minLength": 1},
        "sample": block_schema(SampleForm, refers=False),
        "vary": _vary(),
        "constraints": {"type": "array", "items": {"type": "string"}},
        "outputs": {"type": "array", "items": OUTPUT},
        "curves": {"type": "array", "items": OUTPUT},
        "objectives": OBJECTIVES,
        "optimise": optimise,
        "reports": {"anyOf": [words, numbers, {"type": "null"}]},
    }
    keys = {name: form | _described(StudyDocument, name) for name, form in forms.items()}
    head = {"$schema": DRAFT, "title": "Study of variants for diecut-report"}
    searched: Schema = {"anyOf": [{"required": ["sample"]}, {"required": ["optimise"]}]}
    return head | _block(keys, ("schema_version", "base"), "A study: a base config and what varies in it.") | searched


def _described(form: type[Block], name: str) -> Schema:
    texts = [each.description for each in form.model_fields[name].metadata if isinstance(each, Text)]
    return {"description": f"{texts[0]}."} if texts else {}


def _block(keys: Schema, required: tuple[str, ...], description: str) -> Schema:
    described = {"description": description, "properties": keys, "required": list(required)}
    return {"type": "object", "additionalProperties": False} | described


def _vary() -> Schema:
    count = {"type": "integer", "minimum": 1, "description": "Number of values."}
    spread: Schema = {"from": QUANTITY, "to": QUANTITY, "spacing": {"enum": ["linear", "log"]}, "count": count}
    values = {"type": "array", "items": {"type": ["number", "string", "boolean"]}, "minItems": 1}
    forms = [values | {"description": "These values."}, _block(spread, ("from", "to"), "Values from … to.")]
    for law, required in DISTRIBUTIONS.items():
        keys = {"distribution": {"const": law}} | dict.fromkeys((*required, "low", "high"), QUANTITY)
        forms.append(_block(keys, ("distribution", *required), f"A {law} distribution with its limits."))
    forms.append(block_schema(TableForm, refers=False) | {"description": "The values of a column."})
    return {"type": "object", "propertyNames": {"pattern": PATH}, "additionalProperties": {"anyOf": forms}}
