"""The command that signs a report. A password comes from a prompt or from the environment, never from the command line."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from diecut_report.cli.exchange import HeldAgainst, previous_option, verified
from diecut_report.cli.output import PASSED, HelpfulCommand, common, tell
from diecut_report.cli.template import template_option
from diecut_report.cli.verification_lines import verification_lines
from diecut_report.config.discovery import Discovery
from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.languages.speech import say

if TYPE_CHECKING:
    from diecut_report.report.house_style import HouseStyle

PASSWORD = "DIECUT_REPORT_KEY_PASSWORD"  # the name of a variable of the environment
path_of = click.Path(path_type=Path)


@click.command(cls=HelpfulCommand)
@click.argument("report", metavar="REPORT.pdf", type=path_of)
@click.option(
    "--key", required=True, metavar="FILE", type=path_of, help="Your private key: PKCS #12 (.p12, .pfx) or PEM."
)
@click.option("--cert", metavar="FILE", type=path_of, help="Its certificate (PEM), where it is not in the same file.")
@click.option(
    "--field", metavar="NAME", help="prepared, checked, norm_checked or approved; needed where several are free."
)
@click.option("--reason", metavar="TEXT", help="Why you sign, as the signature tells it.")
@click.option("-o", "target", metavar="FILE", type=path_of, help="Write to another file (default: REPORT.pdf itself).")
@previous_option
@template_option
@common
def sign(
    report: Path, key: Path, cert: Path | None, field: str | None, reason: str | None, target: Path | None, previous: Path | None,
    house: HouseStyle | None, folders: tuple[Path, ...], quiet: bool,
) -> int:  # fmt: skip
    """Sign a report in one of its fields. What is there stays as it is, byte for byte, so that others can sign it too.

    It is verified before: a report that is not as this program makes it is not signed.
    The key's password is asked for, or taken from the variable DIECUT_REPORT_KEY_PASSWORD.
    """
    from diecut_report.exchange.signing import Signing
    from diecut_report.exchange.signing import sign as signed
    from diecut_report.exchange.signing_keys import signing_key

    out = target or report
    for given in filter(None, (key, cert)):
        if out.exists() and given.exists() and out.samefile(given):
            words = phrase("This is the key or its certificate; it would be written over. Choose another file with -o.")
            raise UserError(Problem(words, str(out)))
    found = signing_key(key, cert, _password)
    signed(
        Signing(report, out, field, reason),
        found,
        lambda words: None if quiet else tell([f"{out}: " + phrase(words)]),
        lambda: _require_as_made(report, HeldAgainst(house, previous), Discovery(folders), quiet),
    )
    return PASSED


def _require_as_made(report: Path, asked: HeldAgainst, discovery: Discovery, quiet: bool) -> None:
    carried, found = verified(report, asked, discovery, quiet)
    if not found.holds:
        faults = [line for line in verification_lines(carried, found) if line.startswith(("✗", " "))]
        words = phrase(
            "The report is not as this program makes it, and is not signed. What `diecut-report verify` finds:"
        )
        raise UserError([Problem(words, str(report)), *map(Problem, faults)])


def _password() -> bytes:
    given = os.environ.get(PASSWORD)
    if given is not None:
        return given.encode()
    if not sys.stdin or not sys.stdin.isatty():
        words = Phrase(
            "The key has a password. Set the variable {password}, or run the command on a terminal, which asks for it.",
            password=PASSWORD,
        )
        raise UserError(Problem(words))
    asked: str = click.prompt(say("Password of the key"), hide_input=True, err=True)
    return asked.encode()
