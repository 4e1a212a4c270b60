"""Inputs that are texts."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import Any

from pydantic import GetCoreSchemaHandler
from pydantic_core import CoreSchema, core_schema

from diecut_report.contract.place import placed
from diecut_report.errors import nearest


@dataclass(frozen=True)
class Text:
    """Declare an input that is a text, a choice or yes/no: its description (the annotation says what is allowed).

    ``options`` are the allowed texts where these are kept in a registry.
    """

    description: str
    symbol: str = ""
    options: Collection[str] = ()
    at: str = placed()

    def validate(self, given: str | None) -> str | None:
        """Return the text, if it is one of the options; ValueError with the known ones in words where it is not."""
        if given is None or given in self.options:
            return given
        raise ValueError(f"is “{given}”{nearest(given, self.options)}; allowed: {', '.join(self.options)}")

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        schema = handler(source)
        return core_schema.no_info_after_validator_function(self.validate, schema) if self.options else schema
