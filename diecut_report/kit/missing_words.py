"""Writes into a plugin's catalogues the texts that they lack, to be translated; what stands there already is left as it is."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from diecut_report.config.discovery import Origin
from diecut_report.errors import Problem, UserError
from diecut_report.files import write_all
from diecut_report.given_files import content
from diecut_report.languages.catalogues import SOURCE_LANGUAGE, file_beside, languages
from diecut_report.languages.phrases import Phrase
from diecut_report.languages.po_files import added
from diecut_report.testing.contract import ContractTest

LARGEST = 10_000_000  # bytes of a catalogue


def write_missing(test: ContractTest, origin: Origin) -> dict[Path, int]:
    """Write the entries that a plugin's catalogues lack; how many, by the file. UserError where the plugin is the program's own."""
    if origin.is_own:
        words = "{kind} comes with the program, whose catalogues are made by its own tool."
        raise UserError(Problem(Phrase(words, kind=test.mechanism.kind)))
    found = {file: (text, count) for file, text, count in _added(test, origin.file()) if count}
    write_all({file: text for file, (text, _) in found.items()}, keep=None)
    return {file: count for file, (_, count) in found.items()}


def _added(test: ContractTest, code: Path) -> Iterator[tuple[Path, bytes, int]]:
    """Each catalogue with what it lacks, and how much that is."""
    for language in languages():
        if language != SOURCE_LANGUAGE:
            file = file_beside(code, language)
            there = content(file, LARGEST, "a catalogue of texts") if file.is_file() else None
            yield file, *added(there, language, test.mechanism.kind, test.untranslated(language))
