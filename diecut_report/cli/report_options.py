"""What the options of a report take: formats, detail, mechanisms."""

from __future__ import annotations

import click

from diecut_report.errors import nearest
from diecut_report.languages.speech import say


def report_formats() -> tuple[str, ...]:
    """Return the formats of a report."""
    from diecut_report.pipeline import FORMATS

    return FORMATS


def detail_given(_: click.Context, __: click.Parameter, given: str | None) -> str | None:
    """Return the detail that is asked for; BadParameter where there is no such one."""
    from diecut_report.config.model import DETAILS

    if given is None or given in DETAILS:
        return given
    raise click.BadParameter(
        say(
            "{given} is not a detail{nearest}; known: {known}.",
            given=repr(given),
            nearest=nearest(given, DETAILS),
            known=", ".join(DETAILS),
        )
    )


def only_given(_: click.Context, __: click.Parameter, given: str | None) -> tuple[str, ...]:
    """Return the mechanisms that are asked for; BadParameter where none is named."""
    names = tuple(dict.fromkeys(part.strip() for part in (given or "").split(",") if part.strip()))
    if given is not None and not names:
        raise click.BadParameter(
            say("no mechanism is named; give names of the configuration, with commas: drive,clutch.")
        )
    return names
