"""Writes into a plugin's catalogues the texts that they lack, to be translated; what stands there already is left as it is."""

from __future__ import annotations

from collections.abc import Iterator
from io import BytesIO
from pathlib import Path

from babel.messages.catalog import Catalog
from babel.messages.pofile import write_po

from diecut_report.config.discovery import Origin
from diecut_report.errors import Problem, UserError
from diecut_report.files import write_all
from diecut_report.given_files import content
from diecut_report.languages import po_files
from diecut_report.languages.catalogues import SOURCE_LANGUAGE, file_beside, languages
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.testing.contract import ContractTest

LARGEST = 10_000_000  # bytes of a catalogue


def write_missing(test: ContractTest, origin: Origin) -> dict[Path, int]:
    """Write the entries that a plugin's catalogues lack; how many, by the file. UserError where the plugin is the program's own."""
    kind = test.mechanism.kind
    if origin.is_own:
        words = "{kind} comes with the program, whose catalogues are made by its own tool."
        raise UserError(Problem(Phrase(words, kind=kind)))
    found = {file: entries for file, entries in _missing(test, origin.file()) if len(entries)}
    write_all({file: _with(file, entries) for file, entries in found.items()}, keep=None)
    return {file: len(entries) for file, entries in found.items()}


def _missing(test: ContractTest, code: Path) -> Iterator[tuple[Path, Catalog]]:
    for language in languages():
        if language != SOURCE_LANGUAGE:
            file = file_beside(code, language)
            entries = po_files.empty(language, test.mechanism.kind, holder="the authors of the plugin")
            there = po_files.read(file, language) if file.is_file() else None
            for text, of in test.untranslated(language):
                if there is None or text not in there:
                    entries.add(text, auto_comments=[of])
            yield file, entries


def _with(file: Path, entries: Catalog) -> bytes:
    """The file with the entries at its end, or a new one with its head."""
    if not file.is_file():
        return po_files.written(entries)
    stream = BytesIO()
    write_po(stream, entries, width=po_files.WIDTH, omit_header=True)
    return content(file, LARGEST, phrase("a catalogue of texts")).rstrip(b"\n") + b"\n\n" + stream.getvalue()
