"""The option that chooses the language of a document."""

from __future__ import annotations

import click


def _language(_: click.Context, __: click.Parameter, given: str | None) -> str | None:
    from diecut_report.languages.catalogues import known

    try:
        return None if given is None else known(given)
    except ValueError as error:
        raise click.BadParameter(f"{error}") from None


language_option = click.option(
    "--language",
    metavar="LANGUAGE",
    callback=_language,
    help="Language of the report (en, uk), in place of the project's.",
)
