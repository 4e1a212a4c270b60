"""What all commands of the command line share: their options, messages, and what goes to standard output."""

from __future__ import annotations

import ctypes
import inspect
import io
import json
import os
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, redirect_stderr, redirect_stdout, suppress
from copy import copy
from pathlib import Path
from threading import Lock, Timer
from typing import TYPE_CHECKING, Any
from unicodedata import category

import click
from click.shell_completion import CompletionItem

from diecut_report.config.loader import Config, examined
from diecut_report.config.plugins import Discovery, spoken_catalogues
from diecut_report.config.yaml import INVISIBLE
from diecut_report.errors import MAX_SHOWN, PluginError, Problem, Unwritable, UserError
from diecut_report.files import reason, write_all
from diecut_report.mechanism.inputs import Quantity
from diecut_report.text.catalogues import SOURCE_LANGUAGE, UnknownLanguage, known, languages
from diecut_report.text.phrases import Counted, Phrase, phrase
from diecut_report.text.translation import know_all_plugins, said, say, say_counted, speak, spoken_language

if TYPE_CHECKING:
    from rich.status import Status


# What is being done, shown on a terminal that wants moving signs once it has taken longer than a second, elsewhere as a line now and then.


SECONDS_UNSHOWN = 1.0  # until it is shown
SECONDS_BETWEEN = 30.0  # of two lines, and before the first


def is_styled() -> bool:
    """Return whether standard error is a terminal that wants colours and moving signs (NO_COLOR, TERM=dumb)."""
    return sys.stderr.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"


class Progress:
    """Shows what is being done: on a terminal once it has taken longer than a second, elsewhere in a line every half a minute."""

    def __init__(self) -> None:
        self.doing, self.done, self.lock = "", is_quiet(), Lock()
        self.status: Status | None = None
        self.timer = self._timer()

    def __call__(self, doing: str) -> None:
        self.doing = said(doing)
        if self.status is not None:
            self.status.update(self.doing)

    def _timer(self) -> Timer:
        made = Timer(SECONDS_UNSHOWN, self._show) if is_styled() else Timer(SECONDS_BETWEEN, self._say)
        made.daemon = True
        return made

    def __enter__(self) -> Progress:
        if not self.done:
            self.timer.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.timer.cancel()
        with self.lock:
            self.done = True
            if self.status is not None:
                self.status.stop()

    def _show(self) -> None:
        from rich.console import Console

        with self.lock:
            if not self.done:
                self.status = Console(stderr=True).status(self.doing)
                self.status.start()

    def _say(self) -> None:
        with self.lock:
            if not self.done:
                with suppress(OSError, ValueError):  # nobody reads it any more
                    click.echo(f"{self.doing} …", err=True)
                self.timer = self._timer()
                self.timer.start()


HEAD = "Exit codes"
OF_PROGRAM = phrase(
    "Exit codes: 0 pass or conditional, 1 fail (with --strict also conditional), 2 bad input, 3 a plugin broke, "
    "74 what was asked for cannot be written, 130 Ctrl-C, 70 a fault of the program. The help of a command tells what they mean there."
)
OF_CHECKS = phrase(
    "Exit codes: 0 pass or conditional, 1 fail (with --strict also conditional), 2 bad input, 3 a plugin broke."
)
OF_FILES = phrase("Exit codes: 0 all are valid, 2 one is not, 3 a plugin broke.")
OF_STUDY = phrase(
    "Exit codes: 0 no check of a variant fails, 1 one fails (with --strict also where one warns or is not made) or no variant can exist, "
    "2 bad input, 3 a plugin broke, 130 stopped: what is finished is kept."
)
OF_PLUGIN = phrase("Exit codes: 0 the rules are kept, 1 one is broken, 2 bad input, 3 the plugin broke.")
DONE = phrase("Exit codes: 0 done, 2 bad input, 3 a plugin broke.")


# What a shell completes beside commands, options and files: kinds, mechanisms and inputs of the configuration that is named before.


def kinds(context: click.Context, _: click.Parameter, begun: str) -> list[CompletionItem]:
    """Complete the name of a kind, with its title where the shell shows that."""
    discovery = _discovery(context)
    return [CompletionItem(kind, help=_title(discovery, kind)) for kind in discovery.origins if kind.startswith(begun)]


def mechanisms(context: click.Context, _: click.Parameter, begun: str) -> list[str]:
    """Complete names of mechanisms, parted by commas."""
    before, comma, last = begun.rpartition(",")
    names = (name for config in _config(context) for name in config.kinds)
    return [f"{before}{comma}{name}" for name in names if name.startswith(last)]


def inputs(context: click.Context, _: click.Parameter, begun: str) -> list[str]:
    """Complete the path of an input that is a number: drive.crank_length."""
    return [path for config in _config(context) for path in _numbers(config) if path.startswith(begun)]


def one_of(known: Callable[[], Iterable[str]]) -> Callable[[click.Context, click.Parameter, str], list[str]]:
    """Return what completes one of these texts."""
    return lambda _context, _option, begun: [text for text in known() if text.startswith(begun)]


def _discovery(context: click.Context) -> Discovery:
    return context.params.get("discovery") or Discovery()


def _title(discovery: Discovery, kind: str) -> str | None:
    """The title of a kind; nothing where that would mean to run a plugin of another's, or where the plugin is broken."""
    with suppress(PluginError, LookupError):
        if discovery.origins[kind][0].is_own:
            return said(discovery.mechanism(kind).title, kind)
    return None


def _config(context: click.Context) -> Iterator[Config]:
    """The configuration that the command names before, as far as it can be read; nothing where it cannot."""
    # behind an option without its value, which is being typed, click has not made parameters of the words before
    given = [context.params.get("config"), *context.args]
    file = next((Path(path) for path in given if path and Path(path).is_file()), None)
    if file is None:
        return
    # what a shell completes is no place for messages
    with (
        open(os.devnull, "w") as nowhere,
        redirect_stdout(nowhere),
        redirect_stderr(sys.stderr),
        suppress(UserError, PluginError),
    ):
        yield examined(file, _discovery(context))[0]


def _numbers(config: Config) -> Iterator[str]:
    for name, instance in config.instances.items():
        for slot in instance.slots if instance else ():
            if isinstance(slot.meta, Quantity) and (slot.is_given or slot.value is not None):
                yield ".".join(map(str, (name, *slot.key)))


# The language of the command line: that of its messages, and the one that is asked for documents.


VARIABLE = "DIECUT_REPORT_LANGUAGE"
LOCALES = ("LC_ALL", "LC_MESSAGES", "LANG")  # as gettext has it: the first that is set
ASKED, QUIET = "diecut_report.language", "diecut_report.quiet"  # what is asked for beside the parameters of a command


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


PASSED, CHECK_FAILED, BAD_INPUT, PLUGIN_BROKE = 0, 1, 2, 3
# as shells and sysexits have it: Ctrl-C, a fault of the program, of writing
INTERRUPTED, FAULT, UNWRITABLE = 130, 70, 74
COLOURS = {"fail": "31", "error": "31", "skipped": "33", "warn": "33", "not_checked": "36", "pass": "32"}
MAX_MESSAGE, MESSAGE_END = 2_000, 500  # of a message, and of its end where it is longer
# what may make a terminal do something, end a line, show a text as another one, or stand in it unseen
_ACTIVE = ("Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp")


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
        click.echo("".join(map(_printable, (line,) if isinstance(line, str) else line)), err=True)


def is_quiet() -> bool:
    """Return whether ``--quiet`` asks for errors alone."""
    context = click.get_current_context(silent=True)
    return context is not None and QUIET in context.meta


def inform(lines: Iterable[Line]) -> None:
    """Tell what ``--quiet`` leaves out."""
    tell(() if is_quiet() else lines)


def tell_written(paths: Iterable[Path]) -> None:
    """Which files were written."""
    inform(Phrase("written: {path}", path=in_line(str(path))) for path in paths)


def tell_problems(problems: Sequence[Problem]) -> None:
    """What is wrong with a file: the first problems, and how many more there are."""
    unreadable = know_all_plugins()  # of whose inputs the problems tell
    problems = [*problems, *(fault for fault in unreadable if fault not in problems)]
    tell(str(problem) for problem in problems[:MAX_SHOWN])
    if (more := len(problems) - MAX_SHOWN) > 0:
        one = "{n} more problem of the same run is not shown; fix these first."
        tell([Counted(more, one, "{n} more problems of the same run are not shown; fix these first.")])


def _printable(text: str) -> str:
    return text if isinstance(text, Coloured) else re.sub(r"\n(?! )", "\n    ", shown(cut(said(text))))


def cut(text: str) -> str:
    """The text, without its middle where it is very long."""
    if len(text) <= MAX_MESSAGE:
        return text
    left_out = len(text) - MAX_MESSAGE
    middle = say_counted(left_out, "[…{n} more letter…]", "[…{n} more letters…]")
    return f"{text[: MAX_MESSAGE - MESSAGE_END]} {middle} {text[-MESSAGE_END:]}"


def shown(text: str, kept: str = "\n\t") -> str:
    """The text with all that is active on a terminal, or invisible, as an escape, but for the ends of lines and tabs."""
    if text.isascii() and text.isprintable():
        return text
    active = {each for each in {*text} - {*kept} if category(each) in _ACTIVE or INVISIBLE.match(each)}
    return "".join(ascii(each)[1:-1] if each in active else each for each in text)


def in_line(text: str) -> str:
    """A text of others as it stands within one line: it can neither end the line nor change how the rest of it reads."""
    return shown(text, kept="")


def as_lines(lines: Iterable[str]) -> str:
    """A text of these lines, of which none can be made two, or be shown as another one, by the texts in it."""
    return "".join(f"{in_line(line)}\n" for line in lines)


def emit_lines(lines: Iterable[str]) -> bool:
    """What was asked for as lines."""
    return emit(as_lines(lines))


def emit_json(data: Any) -> None:
    """What was asked for as JSON."""
    emit(as_json(data))


def as_json(data: Any, indent: int = 2) -> str:
    """Return plain data as JSON."""
    return json.dumps(data, indent=indent, ensure_ascii=False, allow_nan=False) + "\n"


def emit_or_write(text: str, target: Path | None, *keep: Path) -> None:
    """What was asked for: on standard output, or in the file that is named, which is none of those to keep."""
    if target is None:
        emit(text)
        return
    write_all({target: text.encode(errors="backslashreplace")}, keep, through=True)


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
        _close_output()
        template = "Standard output cannot be written: {reason}"
        raise Unwritable(Problem(Phrase(template, reason=reason(error)))) from error
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
    """A command with the options that all have, whose help goes the way of all that is asked for, and fails as that does."""

    context_class = SpokenContext

    def __init__(self, *given: Any, **more: Any) -> None:
        super().__init__(*given, **more)
        self.params += self.shared_options()

    def shared_options(self) -> list[click.Option]:
        """Return the options that every command has."""
        return [FOLDERS, QUIETLY, LANGUAGE]

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

    def shared_options(self) -> list[click.Option]:
        """Return the one option of all commands that may stand before them."""
        return [LANGUAGE]


def _help(context: click.Context, _: click.Parameter, asked: bool) -> None:
    if asked and not context.resilient_parsing:
        emit(f"{context.get_help()}\n")
        context.exit()


def coloured(text: str, status: str) -> str:
    """The text in the status's colour where standard error is a terminal that wants colours."""
    return Coloured(f"\x1b[{COLOURS[status]}m{text}\x1b[0m") if is_styled() else text


def _known(context: click.Context, _: click.Parameter, folders: tuple[Path, ...]) -> Discovery:
    """What knows the kinds of these folders, whose plugins speak by catalogues of their own."""
    discovery = Discovery(folders)
    # asks all plugins, which English does not need
    if folders and spoken_language() != SOURCE_LANGUAGE and not context.resilient_parsing:
        speak(spoken_language(), spoken_catalogues(discovery))
    return discovery


def _quiet(context: click.Context, _: click.Parameter, asked: bool) -> None:
    context.meta.update({QUIET: True} if asked else {})


FOLDERS = click.Option(
    ["--plugins", "discovery"], metavar="DIR", multiple=True, type=click.Path(path_type=Path), callback=_known,
    help="A folder with plugins (programs that run with your permissions); may be given several times.",
)  # fmt: skip
QUIETLY = click.Option(
    ["--quiet"], is_flag=True, expose_value=False, callback=_quiet,
    help="Show neither progress nor a summary; errors are still reported.",
)  # fmt: skip
LANGUAGE = click.Option(
    ["--language"], metavar="LANGUAGE", is_eager=True, expose_value=False, callback=_language, shell_complete=one_of(languages),
    help="Language of messages and documents (en, uk), overriding the environment and the project.",
)  # fmt: skip
