"""Makes the catalogues of the built-in plugins, keeping what is translated: ``python -m tools.make_catalogues``."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from babel.messages.catalog import Catalog

from diecut_report.config.plugins import Discovery
from diecut_report.declaration.code import code_texts, fixed_texts
from diecut_report.declaration.texts import DeclaredText, texts
from diecut_report.mechanism.mechanism import Mechanism
from diecut_report.testing.plugin_words import tables_of
from diecut_report.text import po_files
from diecut_report.text.catalogues import file_beside
from tools.program_texts import ProgramText, program_texts

ROOT = Path(__file__).parents[1]
LANGUAGES = ("uk",)
PLACEHOLDER = re.compile(r"\\\{[\w.]+(?::\w+)?\\\}")


def main() -> None:
    """Write all catalogues anew."""
    for language in LANGUAGES:
        for file, catalogue in catalogues(language):
            file.parent.mkdir(exist_ok=True)
            file.write_bytes(po_files.written(catalogue))
            print(file.relative_to(ROOT), len(catalogue))


def catalogues(language: str) -> Iterator[tuple[Path, Catalog]]:
    """Yield each catalogue as it is to be, with its file."""
    for file, project, found in wanted(language):
        yield file, updated(file, language, found, project)


def wanted(language: str) -> Iterator[tuple[Path, str, list[ProgramText]]]:
    """Yield for each catalogue its file, what it is of, and its texts: the program's, and those of its plugins."""
    discovery = Discovery()
    yield file_beside(ROOT / "diecut_report" / "__init__.py", language), "diecut-report", list(program_texts())
    for kind in discovery.origins:
        file = file_beside(ROOT / "plugins" / kind / "__init__.py", language)
        yield file, kind, [ProgramText(text, note=of) for text, of in plugin_texts(discovery.mechanism(kind))]


def plugin_texts(mechanism: Mechanism) -> list[DeclaredText]:
    """Return all texts of a plugin: those of its declarations, and those that its code makes."""
    declared = list(texts(mechanism))
    return [*declared, *made_by_code(ROOT / "plugins" / mechanism.kind, declared), *table_sources(mechanism)]


def table_sources(mechanism: Mechanism) -> Iterator[DeclaredText]:
    """Yield once where each table of the plugin's own comes from; those of the program it says itself."""
    tables = [table for _, step in mechanism.steps for table in tables_of(step)]
    for source in dict.fromkeys(source for table in tables for source in table.sources):
        yield DeclaredText(source, "source of a table")


def made_by_code(folder: Path, declared: list[DeclaredText]) -> Iterator[DeclaredText]:
    """Yield the texts in functions that are not declared."""
    known = {text for text, _ in declared}
    yield from (found for found in code_texts(folder) if found.text not in known)


def untranslatable(folder: Path, declared: list[DeclaredText]) -> Iterator[DeclaredText]:
    """Yield what a plugin's functions make of words and numbers without a phrase: neither declared, nor to be translated."""
    whole = "\n".join(text for text, _ in declared)
    for found in fixed_texts(folder):
        if not re.search(f"(?i){PLACEHOLDER.sub('.*', re.escape(found.text))}", whole):
            yield found


def updated(file: Path, language: str, found: list[ProgramText], project: str) -> Catalog:
    """Return the catalogue with these messages, the translations of the file kept."""
    template = po_files.empty(language, project)
    for each in found:
        id = (each.text, each.plural) if each.plural else each.text
        template.add(id, context=each.context, auto_comments=[each.note] if each.note else [])
    if not file.exists():
        return template
    old = po_files.read(file, language)
    for message in template:
        if message.id and (known := old.get(message.id, message.context)):
            message.string, message.flags = known.string, known.flags
    return template


if __name__ == "__main__":
    main()
