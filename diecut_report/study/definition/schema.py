"""JSON Schema (draft 2020-12) of a study file, for editors."""

from __future__ import annotations

from diecut_report.config.schema import DRAFT, NUMBER, Schema, block_schema
from diecut_report.study.definition.sample import DISTRIBUTIONS, OptimiseForm, SampleForm, TableForm

PATH = r"^(mechanisms\.[A-Za-z][A-Za-z0-9_-]*|press)(\.\w+)+$"
OUTPUT = r"^[A-Za-z][A-Za-z0-9_-]*(\.\w+)+$"
QUANTITY: Schema = {"anyOf": [{"type": "number"}, {"type": "string", "pattern": NUMBER}]}
LIMITS = {"uniform": ("low", "high"), "normal": ("mean", "sd"), "triangular": ("low", "mode", "high")}


def study_schema() -> Schema:
    """Return schema of a study; whether its paths are there is known only with its base."""
    keys: Schema = {
        "schema_version": {"const": 1, "description": "Version of this form of the file."},
        "base": _text("The config that is varied, relative to the study."),
        "sample": block_schema(SampleForm, refers=False) | {"description": "How the variants are taken."},
        "vary": _vary(),
        "constraints": _list(
            {"type": "string"}, "What must hold between inputs, and of outputs; other variants are dropped."
        ),
        "outputs": _list(_output(), "The outputs to keep, such as drive.crank_torque_peak; without the key all."),
        "curves": _list(_output(), "The curves to keep; without the key none."),
        "objectives": _list(_objective(), "What is to be small or great."),
        "optimise": _optimise(),
        "reports": _reports(),
    }
    head = {"$schema": DRAFT, "title": "Study of variants for diecut-report"}
    searched: Schema = {"anyOf": [{"required": ["sample"]}, {"required": ["optimise"]}]}
    return head | _block(keys, ("schema_version", "base"), "A study: a base config and what varies in it.") | searched


def _text(description: str) -> Schema:
    return {"type": "string", "minLength": 1, "description": description}


def _list(items: Schema, description: str) -> Schema:
    return {"type": "array", "items": items, "description": description}


def _block(keys: Schema, required: tuple[str, ...], description: str) -> Schema:
    described = {"description": description, "properties": keys, "required": list(required)}
    return {"type": "object", "additionalProperties": False} | described


def _whole(least: int, description: str) -> Schema:
    return {"type": "integer", "minimum": least, "description": description}


def _vary() -> Schema:
    spread: Schema = {"spacing": {"enum": ["linear", "log"]}, "count": _whole(1, "Number of values.")}
    forms = [
        _list({"type": ["number", "string", "boolean"]}, "These values.") | {"minItems": 1},
        _block({"from": QUANTITY, "to": QUANTITY} | spread, ("from", "to"), "Values from … to."),
        *(_distribution(name) for name in DISTRIBUTIONS),
        block_schema(TableForm, refers=False) | {"description": "The values of a column."},
    ]
    paths = {"type": "object", "propertyNames": {"pattern": PATH}, "additionalProperties": {"anyOf": forms}}
    return paths | {"description": "For each varied path its values: a list, a range or a distribution."}


def _distribution(name: str) -> Schema:
    limits: Schema = dict.fromkeys(dict.fromkeys([*LIMITS[name], "low", "high"]), QUANTITY)
    given: Schema = {"distribution": {"const": name}}
    return _block(given | limits, ("distribution", *LIMITS[name]), f"A {name} distribution with its limits.")


def _output() -> Schema:
    return {"type": "string", "pattern": OUTPUT}


def _objective() -> Schema:
    keys: Schema = {"minimise": _output(), "maximise": _output()}
    return _block(keys, (), "An output.") | {"minProperties": 1, "maxProperties": 1}


def _optimise() -> Schema:
    found = block_schema(OptimiseForm, refers=False) | {
        "description": "What the command optimise searches for in what is varied."
    }
    told = "What is to be small or great: outputs, or varied inputs; without the key those of the study."
    return found | {"properties": found["properties"] | {"objectives": _list(_objective(), told)}}


def _reports() -> Schema:
    ids = {"type": "array", "items": {"type": "integer", "minimum": 0}}
    words = {"type": "string", "pattern": r"^(none|failed|all|best\s+[1-9]\d*)$"}
    return {"anyOf": [words, ids, {"type": "null"}], "description": "The variants that get a full report."}
