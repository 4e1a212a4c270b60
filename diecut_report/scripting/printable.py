"""Results as documents and notebooks are made of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from diecut_report import pipeline
from diecut_report.config.discovery import Discovery
from diecut_report.languages.catalogues import SOURCE_LANGUAGE
from diecut_report.report.context import Material

Data = dict[str, Any]


@dataclass(frozen=True, eq=False)
class Printable:
    """Hold results with what finds the words of their plugins; ``language`` is that of messages and documents, where one was asked for."""

    data: Data
    discovery: Discovery
    language: str | None

    @property
    def document_language(self) -> str:
        """Return the language of documents: the one that was asked for, else that of the project."""
        return self.language or str(self.data["project"].get("language") or SOURCE_LANGUAGE)

    def copied(self) -> Data:
        """Return the results in the language of documents, free to be asked for in another form."""
        data = {**self.data, **{key: dict(self.data[key]) for key in ("project", "report", "summary")}}
        data["project"]["language"] = self.document_language
        return data

    def material(self, detail: str, only: str = "") -> Material:
        """Return the parts of the report at a detail; ``only`` is the mechanism, or the comparison, that is shown."""
        data = self.copied()
        data["report"] |= {"detail": detail}
        if only in data["mechanisms"]:
            data["report"] |= {"only": [only]}
        elif only:
            data |= self._compared(only)
        return Material(data, pipeline.catalogues_of(data, self.discovery, ("html",)))

    def _compared(self, name: str) -> Data:
        """A comparison alone, and the mechanisms that it is between without what takes time to print."""
        comparison = self.data["comparisons"][name]
        bare: Data = {"figures": [], "sections": []}
        mechanisms = {each: self.data["mechanisms"][each] | bare for each in comparison["between"]}
        return {"mechanisms": mechanisms, "comparisons": {name: comparison}, "governing": None}
