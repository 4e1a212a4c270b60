"""What goes wrong in a script, told in the language that it asked for."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

from diecut_report.errors import ConfigError, Problem, UnknownName, Unwritable, UserError
from diecut_report.languages.catalogues import SOURCE_LANGUAGE, UnknownLanguage, known, of_all_plugins
from diecut_report.languages.phrases import Phrase
from diecut_report.languages.speech import said, speaking


@contextmanager
def told_in(language: str | None, *, without_places: bool = False) -> Iterator[None]:
    """Let errors of a user leave as errors of a script, a ConfigError where they have no class of their own, in a language.

    ``without_places``: lines and columns are of a text that the user has not written, and are left out.
    """
    try:
        yield
    except UserError as error:
        own = type(error) if isinstance(error, UnknownName | Unwritable) else ConfigError
        raise own(_translated(error.problems, language or SOURCE_LANGUAGE, without_places)) from error.__cause__


def _translated(problems: tuple[Problem, ...], language: str, without_places: bool) -> Iterator[Problem]:
    with speaking(language, None if language == SOURCE_LANGUAGE else of_all_plugins(language)):
        for problem in problems:
            told = replace(problem, message=said(problem.message))
            yield replace(told, file="", line=None, column=None) if without_places else told


def known_language(language: str | None) -> str | None:
    """Return the language that is asked for; ConfigError where the program has no words of it."""
    try:
        return None if language is None else known(language)
    except UnknownLanguage as error:
        raise ConfigError(Problem(Phrase("The language {error}.", error=error), path="language")) from None
