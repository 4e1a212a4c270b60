"""The language of the command line: that of its messages, and the one that is asked for documents."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any, TypeVar

import click

from diecut_report.cli import completion
from diecut_report.errors import Problem, UserError
from diecut_report.languages.catalogues import SOURCE_LANGUAGE, UnknownLanguage, known, languages
from diecut_report.languages.phrases import Phrase
from diecut_report.languages.speech import say, speak

VARIABLE = "DIECUT_REPORT_LANGUAGE"
LOCALES = ("LC_ALL", "LC_MESSAGES", "LANG")  # as gettext has it: the first that is set
ASKED = "diecut_report.language"

Command = TypeVar("Command", bound=Callable[..., Any])


def of_environment() -> str:
    """Return the language of messages that the environment asks for; English where the program has no words of the system's.

    UserError where its own variable names a language that it does not have.
    """
    if own := os.environ.get(VARIABLE):
        try:
            return known(own)
        except UnknownLanguage as error:
            raise UserError(Problem(Phrase("The language {error}.", error=error), path=VARIABLE)) from None
    system = next(filter(None, map(os.environ.get, LOCALES)), "")
    found = system.partition("_")[0].partition(".")[0]
    return found if found in languages() else SOURCE_LANGUAGE


def asked_language() -> str | None:
    """Return what ``--language`` names; None where it is not given."""
    found: str | None = click.get_current_context().meta.get(ASKED)
    return found


def _language(context: click.Context, _: click.Parameter, given: str | None) -> None:
    if given is None:
        return
    try:
        context.meta[ASKED] = known(given)
    except UnknownLanguage as error:
        raise click.BadParameter(say("The language {error}.", error=error)) from None
    speak(given)


def language_option(command: Command) -> Command:
    """Give a command the option ``--language``, of which it need not know."""
    words = "Language of messages and documents (en, uk), in place of the environment's and the project's."
    option = click.option(
        "--language",
        metavar="LANGUAGE",
        is_eager=True,
        expose_value=False,
        callback=_language,
        help=words,
        shell_complete=completion.spoken,
    )
    return option(command)
