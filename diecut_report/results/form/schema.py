"""The form of the results file as JSON Schema (draft 2020-12), generated from its types."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic.json_schema import GenerateJsonSchema
from pydantic_core import core_schema

from diecut_report.results.form.document import ResultsFileKeys
from diecut_report.results.form.version import FORM_VERSION

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
