"""The option ``--format`` of all commands: a list of formats, of which a command knows some."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import click

from diecut_report.errors import nearest
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.languages.speech import say

Taken = Callable[[click.Context, click.Parameter, str], list[str]]


def formats_of(known_formats: Callable[[], Sequence[str]], *, may_be_none: bool = False) -> Taken:
    """Return what takes the option: a list of formats, small letters, each once; BadParameter for another one, and for none.

    The known ones are asked for when the option is read, since what knows them may take long to import.
    """

    def taken(_: click.Context, __: click.Parameter, given: str) -> list[str]:
        asked = list(dict.fromkeys(part.strip().lower() for part in given.split(",") if part.strip()))
        known = known_formats()
        unknown = [part for part in asked if part not in known]
        if unknown or not (asked or may_be_none):
            named = {"given": repr(unknown[0]), "nearest": nearest(unknown[0], known)} if unknown else {}
            words = Phrase("{given} is not a format{nearest}", named) if unknown else phrase("no format is named")
            raise click.BadParameter(say("{words}; known: {known}.", words=words, known=", ".join(known)))
        return asked

    return taken
