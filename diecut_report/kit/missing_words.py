"""Writes into a plugin's catalogues the texts that they lack, to be translated, and marks those that nothing says any more."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from diecut_report.config.discovery import Origin
from diecut_report.errors import Problem, UserError
from diecut_report.files import write_all
from diecut_report.given_files import content
from diecut_report.languages.catalogues import SOURCE_LANGUAGE, file_beside, languages
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.languages.po_files import ChangedCatalogue, changed
from diecut_report.testing.contract import ContractTest

LARGEST = 10_000_000  # bytes of a catalogue


def refuse_own(origin: Origin) -> None:
    """Refuse to write into catalogues of the program itself: UserError says why."""
    if origin.is_own:
        words = "{kind} comes with the program, whose catalogues are made by its own tool."
        raise UserError(Problem(Phrase(words, kind=origin.kind)))


def write_missing(test: ContractTest, origin: Origin) -> dict[Path, ChangedCatalogue]:
    """Write the entries that a plugin's catalogues lack, and mark those as obsolete that nothing says; what was changed, by the file."""
    found = {file: made for file, made in _changed(test, origin.file()) if made.added or made.obsolete}
    write_all({file: made.content for file, made in found.items()}, keep=None)
    return found


def _changed(test: ContractTest, code: Path) -> Iterator[tuple[Path, ChangedCatalogue]]:
    """Each catalogue as it is to be."""
    for language in languages():
        if language != SOURCE_LANGUAGE:
            file = file_beside(code, language)
            there = content(file, LARGEST, phrase("a catalogue of texts")) if file.is_file() else None
            words = test.words
            yield (
                file,
                changed(there, language, test.mechanism.kind, words.untranslated(language), words.unused(language)),
            )
