"""Papers that plugins call by a number of their own, by their place in the report's list of sources: 002 eq. 6 as [2] eq. 6."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from diecut_report.report.text import NUMBERS, SAID

Data = Mapping[str, Any]
PAPER = re.compile(r"\d{3}")
BRACKETS = re.compile(r"\((\[\d+\])\)")  # about the brackets of a number
CITING = SAID | {"source", "text", "note", "absent"}
"""Keys of results whose texts may name a source."""


def numbered(results: Data) -> Data:
    """Return the results with each paper named by its number in the list of sources, in brackets."""
    told = [results.get(part, {}) for part in ("mechanisms", "comparisons")]
    ids = {source["id"] for part in told for data in part.values() for source in data.get("sources", ())}
    papers = {id: f"[{number}]" for number, id in enumerate(sorted(filter(PAPER.fullmatch, ids)), 1)}
    if not papers:
        return results
    walk = _Numbered(papers)
    return {
        **results,
        **{key: walk.walk(results[key]) for key in ("mechanisms", "comparisons", "changes") if key in results},
    }


class _Numbered:
    """Names papers by their numbers, in whatever part of the results; what follows digits is no paper: 10 000 h."""

    def __init__(self, papers: Mapping[str, str]) -> None:
        self.papers = papers
        self.named = re.compile(
            rf"(?<![\w.,\u202f\u2009\u00a0−-])(?<!\d )(?:{'|'.join(papers)})(?![\w\u202f\u2009\u00a0]|\.\d)"
        )

    def walk(self, data: Any) -> Any:
        """Any part of the results."""
        if isinstance(data, Mapping):
            return {key: self._part(key, part) for key, part in data.items()}
        return [self.walk(part) for part in data] if isinstance(data, list) else data

    def _part(self, key: str, part: Any) -> Any:
        if key in NUMBERS:
            return part
        if key == "inputs":
            return self._inputs(part)
        if key == "sources":
            return [{**source, "id": self.papers.get(source["id"], source["id"])} for source in part]
        if key not in CITING:
            return self.walk(part)
        if isinstance(part, list):
            return [self._text(each) if isinstance(each, str) else self.walk(each) for each in part]
        return self._text(part) if isinstance(part, str) else self.walk(part)

    def _inputs(self, part: Any) -> Any:
        """Inputs of a mechanism by their names, or those that were changed: but for its description a line is the user's own."""
        if isinstance(part, Mapping):
            return dict(zip(part, self._inputs([*part.values()]), strict=True))
        return [{key: self._text(text) if key == "description" else text for key, text in row.items()} for row in part]

    def _text(self, text: str) -> str:
        return BRACKETS.sub(r"\1", self.named.sub(lambda found: self.papers[found[0]], text))
