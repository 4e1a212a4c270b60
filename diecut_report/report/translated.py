"""A results document in another language: the same places, numbers and keys, with the texts translated for print."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any

from diecut_report.languages.catalogues import SOURCE_LANGUAGE, Catalogues, built_in
from diecut_report.languages.tokens import worded
from diecut_report.languages.translation import Translator
from diecut_report.report.given_names import given_names
from diecut_report.report.i18n import Catalogue

Data = Mapping[str, Any]
Say = Callable[[str], str]
SAID = frozenset({"title", "summary", "assumptions", "error", "warnings", "description", "message", "demand_label", "limit_label", "method",
                  "words", "caption", "governing_title", "label", "touches", "lines", "by", "table", "series"})  # fmt: skip
"""Keys of results whose texts the report prints."""
NUMBERS = frozenset({"values", "left", "right", "breakpoints", "points", "outer", "holes", "intervals"})
DATE = re.compile(r"(\d{4})-(\d\d)-(\d\d)")


def translated(results: Data, catalogues: Catalogues) -> Data:
    """Return the results as they are printed in the language of the catalogues; English ones as they are."""
    if catalogues.language == SOURCE_LANGUAGE:
        return results
    for data in (*results["mechanisms"].values(), *results.get("comparisons", {}).values()):
        catalogues.of(data["kind"])
    words = Translator(catalogues, results.get("wordings", {}), Catalogue(catalogues.language)["decimal"])
    found = {**results, "project": _dated(results["project"])}
    for part in ("mechanisms", "comparisons"):
        if part in results:
            found[part] = {name: _mechanism(words, data, results).said(data) for name, data in results[part].items()}
    rest = _Mechanism(words, "")
    found["press"] = rest.of_press(results["press"])
    found |= {key: rest.walk(results[key]) for key in ("comparisons_left_out", "changes") if key in results}
    if "changes" in found:
        sides = {
            side: {**found["changes"][side], "date": _date(found["changes"][side]["date"])} for side in ("old", "new")
        }
        found["changes"] = {**found["changes"], **sides}
    return found


def figure_translated(
    figure: Data, curves: Data, kind: str, catalogues: Catalogues
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return a figure of a mechanism of this kind with the curves that it shows, in the language of the catalogues."""
    words = _Mechanism(Translator(catalogues, {}, Catalogue(catalogues.language)["decimal"]), kind)
    return words.drawn(figure), words.walk(curves)


def _dated(project: Data) -> Data:
    """The project with its dates as they are written in documents: 22.11.2026."""
    lines = [{**line, "date": _date(line.get("date"))} for line in project.get("revisions") or ()]
    return {**project, "date": _date(project.get("date"))} | ({"revisions": lines} if lines else {})


def _date(given: Any) -> Any:
    found = DATE.fullmatch(given) if isinstance(given, str) else None
    return ".".join(reversed(found.groups())) if found else given


def _mechanism(words: Translator, data: Data, results: Data) -> _Mechanism:
    """What says the texts of a mechanism, or of a comparison, whose sources are those of what it compares."""
    kinds = [results["mechanisms"][name]["kind"] for name in data.get("between", ())]
    home = kinds[-1] if kinds and all(map(built_in, kinds)) else data["kind"]
    return _Mechanism(words, data["kind"], given_names(data, results["mechanisms"]), home)


class _Mechanism:
    """Says the texts of one mechanism's results, but the names that its configuration gives; ``home`` is the kind of its sources."""

    def __init__(self, words: Translator, kind: str, names: frozenset[str] = frozenset(), home: str = "") -> None:
        self.words, self.kind, self.names, self.home = words, kind, names, home or kind

    def said(self, data: Data) -> Data:
        """The results of the mechanism."""
        own = {
            "inputs": {key: self._row(row) for key, row in data["inputs"].items()},
            "lists": {key: self.text(title) for key, title in data.get("lists", {}).items()},
            "figures": [self.drawn(figure) for figure in data.get("figures", ())],
            "sources": [
                {
                    "id": self.words.source(source["id"], self.home),
                    "citation": self.words.paper(source["citation"], self.home),
                }
                for source in data.get("sources", ())
            ],
        }
        return {**self.walk({key: part for key, part in data.items() if key not in own}), **own}

    def of_press(self, press: Data) -> Data:
        """The fields of the press."""
        return {**press, "fields": [self._row(row) for row in press["fields"]]}

    def text(self, text: str) -> str:
        """A text of the mechanism."""
        return self.words.said(text, self.kind)

    def _shown(self, text: str) -> str:
        """A value that is a text: the words of a choice, or a key in words; a name as it is."""
        if text in self.names:
            return text
        return self.words.known(worded(text), self.kind) or self.text(text)

    def _row(self, row: Data) -> Data:
        """An input, or a field of the press: what was typed and noted stands as it is."""
        display = {**row["display"], "text": self._shown(row["display"]["text"])}
        return {**row, "description": self.text(row["description"]), "display": display}

    def walk(self, data: Any) -> Any:
        """Any part of the results."""
        if isinstance(data, Mapping):
            return {key: self._part(key, part, data) for key, part in data.items()}
        return [self.walk(part) for part in data] if isinstance(data, list) else data

    def _part(self, key: str, part: Any, home: Data) -> Any:
        if key in NUMBERS:
            return self.walk(part) if isinstance(part, Mapping) else part
        if isinstance(part, str):
            return self._string(key, part)
        if key in SAID and isinstance(part, list):
            return [self.text(each) if isinstance(each, str) else self.walk(each) for each in part]
        if key == "rows" and "columns" in home:
            return [[self._shown(cell) if isinstance(cell, str) else cell for cell in row] for row in part]
        return self.walk(part)

    def _string(self, key: str, text: str) -> str:
        if key in SAID:
            return self.text(text)
        if key == "source":
            return self.words.source(text, self.home)
        if key == "citation":
            return self.words.paper(text, self.home)
        if key in ("text", "key", "column", "note", "table_rows", "part_name", "name"):
            return self._shown(text)
        return text

    def drawn(self, data: Any) -> Any:
        """A figure, or a part of it: whatever text is not translated has at least its numbers in the language's form."""
        if isinstance(data, Mapping):
            return {key: self._drawn_part(key, part) for key, part in data.items()}
        return [self.drawn(part) for part in data] if isinstance(data, list) else data

    def _drawn_part(self, key: str, part: Any) -> Any:
        if key in NUMBERS:
            return part
        if key not in SAID and key != "text":
            return self.drawn(part)
        if isinstance(part, str):
            return self._label(part)
        if isinstance(part, list):
            return [self._label(each) if isinstance(each, str) else self.drawn(each) for each in part]
        return self.drawn(part)

    def _label(self, text: str) -> str:
        """A text within a figure."""
        return text if text in self.names else self.words.numbers(self.text(text))
