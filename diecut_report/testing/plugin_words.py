"""The words of a plugin in another language: which its catalogue lacks, which of it nothing says any more, and what stays as it is given."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from diecut_report.config.plugins import Discovery, catalogues_for
from diecut_report.declaration.code import code_texts, template
from diecut_report.declaration.texts import files_around, own_files, parsed, texts
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.mechanism.steps import Interpolated, Lookup, Pick
from diecut_report.standards.tables import StandardSeries, StandardTable
from diecut_report.text.catalogues import Catalogues, built_in

TABLES = (".csv", ".yaml", ".yml", ".json")
MAX_FILE_BYTES = 1_000_000  # bytes of a table that is looked through
IN_WORDS = re.compile(r"(?<![\w.])[a-z]{3,}")  # neither a standard's number nor an author's name alone


@dataclass(frozen=True)
class PluginWords:
    """Hold a plugin with what knows its catalogues."""

    mechanism: Mechanism
    discovery: Discovery

    def catalogues(self, language: str) -> Catalogues:
        """Return the catalogues of a language."""
        return catalogues_for(language, [], self.discovery)

    def untranslated(self, language: str) -> Iterator[tuple[str, str]]:
        """Yield the texts that neither the plugin's catalogue nor the program's has, each with what it is of."""
        known = self.catalogues(language)
        for text, of in self.said:
            if not any(catalogue.text(text) for catalogue in known.ahead(self.mechanism.kind)):
                yield text, of

    def unused(self, language: str) -> Iterator[str]:
        """Yield the texts of the plugin's own catalogue that stand nowhere in its files, and that the program does not say."""
        known = self.catalogues(language)
        own = known.of(self.mechanism.kind)
        constants, tables = self._written
        said = {*(text for text, _ in self.said), *self._sources, *known.program.english, *constants}
        yield from (text for text in (own.english if own else ()) if text not in said and text not in tables)

    def sources_as_given(self, language: str) -> list[str]:
        """Return the sources that are said in words, and stay so in a report: the plugin's catalogue does not have them as a whole."""
        own = self.catalogues(language).of(self.mechanism.kind)
        if built_in(self.mechanism.kind) is not None:
            return []
        return [text for text in self._sources if IN_WORDS.search(text) and not (own and own.text(text))]

    @cached_property
    def said(self) -> list[tuple[str, str]]:
        """Return the texts that a report shows, those of the code among them."""
        own = [found for file in own_files(self.mechanism) for found in code_texts(file)]
        return list(dict.fromkeys([*texts(self.mechanism), *own]))

    @cached_property
    def _sources(self) -> list[str]:
        steps = [step for _, step in self.mechanism.steps]
        tables = [each for step in steps for each in tables_of(step)]
        said = (*(step.source for step in steps), *(check.source for check in self.mechanism.checks))
        found = [*said, *(source for table in tables for source in table.sources)]
        return [text for text in dict.fromkeys(found) if text]

    @cached_property
    def _written(self) -> tuple[set[str], str]:
        """The texts in the code of the plugin and of what it may import, and what stands in the tables of its folder."""
        home = Path(self.mechanism.at.rpartition(":")[0]).parent
        code = {*files_around(self.mechanism), *home.glob("*.py")}
        found = home.rglob("*") if (home / "__init__.py").is_file() else home.glob("*")
        tables = (each for each in found if each.suffix in TABLES and each.is_file())
        small = (each for each in tables if each.stat().st_size < MAX_FILE_BYTES)
        constants = {text for file in code for text in _constants(parsed(file))}
        return constants, "\n".join(each.read_text("utf-8", "replace") for each in small)


def _constants(module: ast.Module) -> Iterator[str]:
    for node in ast.walk(module):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.value
        elif isinstance(node, ast.JoinedStr):
            yield template(node)


def tables_of(step: object) -> list[StandardTable | StandardSeries]:
    """Return the tables and series of a plugin's own that a step takes from."""
    match step:
        case Lookup(table=StandardTable() as table) | Interpolated(table=table):
            found: list[StandardTable | StandardSeries] = [table]
        case Pick(series=StandardSeries() as series):
            found = [series]
        case Pick(series=Mapping() as several):
            found = list(several.values())
        case _:
            found = []
    return [each for each in found if not each.is_of_the_program]
