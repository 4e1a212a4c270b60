"""What all commands of the command line share: their options, messages, and what goes to standard output."""

from __future__ import annotations

import ctypes
import inspect
import io
import os
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, redirect_stdout, suppress
from copy import copy
from pathlib import Path
from typing import Any, TypeVar
from unicodedata import category

import click

from diecut_report.cli.exit_codes import DONE, HEAD
from diecut_report.cli.language import language_option
from diecut_report.cli.progress import is_styled
from diecut_report.config.hidden_letters import INVISIBLE
from diecut_report.errors import TOLD, Problem, Unwritable
from diecut_report.languages.catalogues import SOURCE_LANGUAGE
from diecut_report.languages.phrases import Counted, Phrase, phrase
from diecut_report.languages.speech import know_all_plugins, said, say, say_counted, speak, spoken_language

PASSED, CHECK_FAILED, BAD_INPUT, PLUGIN_BROKE = 0, 1, 2, 3
INTERRUPTED, FAULT, UNWRITABLE = (
    130,
    70,
    74,
)  # as shells and sysexits have it: Ctrl-C, a fault of the program, of writing
COLOURS = {"fail": "31", "error": "31", "skipped": "33", "warn": "33", "not_checked": "36", "pass": "32"}
LETTERS, END = 2_000, 500  # of a message, and of its end where it is longer
# what may make a terminal do something, end a line, show a text as another one, or stand in it unseen
_ACTIVE = ("Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp")

Command = TypeVar("Command", bound=Callable[..., Any])


class Coloured(str):
    """A text with the escapes of its colour, which the program itself has put there."""

    __slots__ = ()


Line = str | tuple[str, ...]
"""A message: a text, or the parts of it, of which some are coloured."""


def tell(lines: Iterable[Line]) -> None:
    """Messages, on standard error, in the language that is spoken: each in a line of its own.

    It cannot leave its line but for lines that are indented.
    """
    for line in lines:
        click.echo("".join(map(_told, (line,) if isinstance(line, str) else line)), err=True)


def tell_written(paths: Iterable[Path]) -> None:
    """Which files were written."""
    tell(Phrase("written: {path}", path=in_line(str(path))) for path in paths)


def tell_problems(problems: Sequence[Problem]) -> None:
    """What is wrong with a file: the first problems, and how many more there are."""
    unreadable = know_all_plugins()  # of whose inputs the problems tell
    problems = [*problems, *(fault for fault in unreadable if fault not in problems)]
    tell(str(problem) for problem in problems[:TOLD])
    if len(problems) > TOLD:
        tell(
            [
                Counted(
                    len(problems) - TOLD,
                    "{n} more problem of the same run is not shown; fix these first.",
                    "{n} more problems of the same run are not shown; fix these first.",
                )
            ]
        )


def _told(text: str) -> str:
    return text if isinstance(text, Coloured) else re.sub(r"\n(?! )", "\n    ", shown(cut(said(text))))


def cut(text: str) -> str:
    """The text, without its middle where it is very long."""
    if len(text) <= LETTERS:
        return text
    left_out = len(text) - LETTERS
    middle = say_counted(left_out, "[…{n} more letter…]", "[…{n} more letters…]")
    return f"{text[: LETTERS - END]} {middle} {text[-END:]}"


def shown(text: str, kept: str = "\n\t") -> str:
    """The text with all that is active on a terminal, or invisible, as an escape, but for the ends of lines and tabs."""
    if text.isascii() and text.isprintable():
        return text
    return "".join(ascii(each)[1:-1] if each not in kept and _is_active(each) else each for each in text)


def _is_active(letter: str) -> bool:
    return category(letter) in _ACTIVE or INVISIBLE.match(letter) is not None


def in_line(text: str) -> str:
    """A text of others as it stands within one line: it can neither end the line nor change how the rest of it reads."""
    return shown(text, kept="")


def as_lines(lines: Iterable[str]) -> str:
    """A text of these lines, of which none can be made two, or be shown as another one, by the texts in it."""
    return "".join(f"{in_line(line)}\n" for line in lines)


def emit_lines(lines: Iterable[str]) -> bool:
    """What was asked for as lines."""
    return emit(as_lines(lines))


def emit(text: str) -> bool:
    """What was asked for, on standard output; always UTF-8. Says whether the reader is still there."""
    if sys.stdout is None:
        raise Unwritable(Problem(phrase("Standard output is closed; name a file with -o.")))
    left = memoryview((shown(text) if sys.stdout.isatty() else text).encode(errors="backslashreplace"))
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
        raise Unwritable(
            Problem(Phrase("Standard output cannot be written: {reason}", reason=reason(error)))
        ) from error
    return True


@contextmanager
def without_output() -> Iterator[None]:
    """Let what plugins write meanwhile go to standard error, also by a library or a process of theirs: it would spoil what is asked for.

    What the program itself writes there meanwhile (-o /dev/stdout) goes there too.
    """
    if sys.stdout is not None:
        sys.stdout.flush()
    kept = os.dup(1)
    try:
        os.dup2(2, 1)
        with redirect_stdout(sys.stderr):
            yield
    finally:
        with suppress(AttributeError):  # a system whose library does not tell what it holds back
            ctypes.CDLL(None).fflush(None)
        os.dup2(kept, 1)
        os.close(kept)


def _close_output() -> None:
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # what is still buffered goes nowhere


class Messages(io.TextIOWrapper):
    """Standard error that may be full or gone: what it does not take is lost, for there is nowhere to tell of it."""

    def write(self, text: str) -> int:
        """Write the text, or lose it."""
        try:
            return super().write(text)
        except OSError:
            self._lose()
            return len(text)

    def flush(self) -> None:
        """Write what is held back, or lose it."""
        try:
            super().flush()
        except OSError:
            self._lose()

    def _lose(self) -> None:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
        super().flush()


def open_streams() -> None:
    """Make standard error one that never fails, and occupy the places of closed streams, or the next file would get one."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.dup2(os.open(os.devnull, os.O_RDWR), number)
    encoding = getattr(sys.stderr, "encoding", None) or "utf-8"
    stream = open(2, "wb", closefd=False)  # noqa: SIM115 it stays open as long as the program runs
    sys.stderr = Messages(stream, encoding=encoding, errors="backslashreplace", line_buffering=True)


class SpokenFormatter(click.HelpFormatter):
    """Writes help in the language that is spoken."""

    def write_usage(self, prog: str, args: str = "", prefix: str | None = None) -> None:
        """Write how a command is called."""
        super().write_usage(prog, args, f"{say('Usage:')} " if prefix is None else prefix)

    def write_heading(self, heading: str) -> None:
        """Write the head of a block."""
        super().write_heading(say(heading))

    def write_text(self, text: str) -> None:
        """Write what a command does."""
        super().write_text(said(text))

    def write_dl(self, rows: Iterable[tuple[str, str]], col_max: int = 30, col_spacing: int = 2) -> None:
        """Write options or commands, each beside what it does."""
        super().write_dl([(name, _described(text)) for name, text in rows], col_max, col_spacing)


def _described(text: str) -> str:
    """What an option does; what click adds in brackets stands behind it."""
    words, bracket, more = text.partition("  [")
    return said(words) + bracket + (f"{say('required')}]" if more == "required]" else more)


class SpokenContext(click.Context):
    """Holds what a command is given, and writes its help in the language that is spoken."""

    formatter_class = SpokenFormatter


class HelpfulCommand(click.Command):
    """A command whose help goes the way of all that is asked for, and fails as that does."""

    context_class = SpokenContext

    def get_short_help_str(self, limit: int = 45) -> str:
        """What the command does, in a line of the list of commands."""
        spoken = copy(self)
        spoken.help = said(inspect.cleandoc(self.help or ""))
        return super(HelpfulCommand, spoken).get_short_help_str(limit)

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write with which codes it ends, where what it does has not told that."""
        if HEAD not in (self.help or ""):
            formatter.write_paragraph()
            formatter.write_text(self.epilog or DONE)

    def get_help_option(self, ctx: click.Context) -> click.Option | None:
        """The option --help."""
        option = super().get_help_option(ctx)
        if option is not None:
            option.callback = _help
        return option


class HelpfulGroup(HelpfulCommand, click.Group):
    """The commands, with the same help."""

    command_class = HelpfulCommand


def _help(context: click.Context, _: click.Parameter, asked: bool) -> None:
    if asked and not context.resilient_parsing:
        emit(f"{context.get_help()}\n")
        context.exit()


def coloured(text: str, status: str) -> str:
    """The text in the status's colour where standard error is a terminal that wants colours."""
    return Coloured(f"\x1b[{COLOURS[status]}m{text}\x1b[0m") if is_styled() else text


def _with_words(context: click.Context, _: click.Parameter, folders: tuple[Path, ...]) -> tuple[Path, ...]:
    """Let plugins of these folders speak by catalogues of their own."""
    if folders and spoken_language() != SOURCE_LANGUAGE and not context.resilient_parsing:
        from diecut_report.config.catalogues import spoken_catalogues  # with all plugins, which English does not need
        from diecut_report.config.discovery import Discovery

        speak(spoken_language(), spoken_catalogues(Discovery(folders)))
    return folders


def common(command: Command) -> Command:
    """The options that every command has."""
    folders = click.option("--plugins", "folders", metavar="DIR", multiple=True, type=click.Path(path_type=Path), callback=_with_words,
                           help="A folder with plugins: programs that run with your rights; may be given several times.")  # fmt: skip
    quiet = click.option(
        "--quiet", is_flag=True, help="Show neither progress nor a summary; errors are reported all the same."
    )
    return folders(quiet(language_option(command)))
