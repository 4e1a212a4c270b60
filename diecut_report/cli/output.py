"""What all commands of the command line share: their options, messages, and what goes to standard output."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, TypeVar

import click

from diecut_report.cli.progress import is_styled
from diecut_report.errors import Problem, UserError

PASSED, CHECK_FAILED, BAD_INPUT, PLUGIN_BROKE = 0, 1, 2, 3
INTERRUPTED, FAULT = 130, 70  # as shells and sysexits have it: Ctrl-C, a fault of the program itself
COLOURS = {"fail": "31", "error": "31", "skipped": "33", "warn": "33", "pass": "32"}

Command = TypeVar("Command", bound=Callable[..., Any])


def tell(lines: Iterable[str]) -> None:
    """Messages, on standard error."""
    for line in lines:
        click.echo(line, err=True)


def emit(text: str) -> bool:
    """What was asked for, on standard output; always UTF-8. Says whether the reader is still there."""
    if sys.stdout is None:
        raise UserError(Problem("Standard output is closed; name a file with -o."))
    left = memoryview(text.encode())
    try:
        while left:  # an unbuffered output may take less than all
            left = left[sys.stdout.buffer.write(left) :]
        sys.stdout.flush()
    except BrokenPipeError:  # the reader has seen enough
        _close_output()
        return False
    except OSError as error:
        from diecut_report.files import reason

        _close_output()
        raise UserError(Problem(f"Standard output cannot be written: {reason(error)}")) from error
    return True


def _close_output() -> None:
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # what is still buffered goes nowhere


def coloured(text: str, status: str) -> str:
    """The text in the status's colour where standard error is a terminal that wants colours."""
    return f"\x1b[{COLOURS[status]}m{text}\x1b[0m" if is_styled() else text


def common(command: Command) -> Command:
    """The options that every command has."""
    folders = click.option("--plugins", "folders", metavar="DIR", multiple=True, type=click.Path(path_type=Path),
                           help="A folder with plugins of your own; may be given several times.")  # fmt: skip
    quiet = click.option(
        "--quiet", is_flag=True, help="Show neither progress nor a summary; errors are reported all the same."
    )
    return folders(quiet(command))
