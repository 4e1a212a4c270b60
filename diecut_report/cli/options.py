"""What several commands are given: shared options, lists with commas, and the configuration, variant or standard input that is read."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from diecut_report.cli.output import inputs, tell
from diecut_report.config.loader import SHOWN, load_standard_input
from diecut_report.config.model import DETAILS
from diecut_report.config.plugins import Discovery
from diecut_report.config.yaml import Tree, as_text, parse
from diecut_report.errors import nearest, refusal
from diecut_report.text.phrases import Phrase, phrase
from diecut_report.text.translation import say

if TYPE_CHECKING:
    from diecut_report.press import Source
    from diecut_report.report.pages.firm_templates import HouseStyle

RESULTS = "study.json"  # what makes a folder one of a study's results
READ = "diecut_report.standard_input"
DASH = Path("-")
Given = TypeVar("Given", bound=Callable[..., Any])
path_of = click.Path(path_type=Path)


class OutputFile(click.Path):
    """A file that is written; ``-`` is standard output, as where none is named."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        found = super().convert(value, param, ctx)
        return None if found == DASH else found


output_file = OutputFile(path_type=Path)


# Options, and what reads their values.


def split(given: str, between: str = ",") -> list[str]:
    """Return the names of a list with commas."""
    return [part for part in map(str.strip, given.split(between)) if part]


def path_option(*names: str, help: str, metavar: str = "FILE", **more: Any) -> Callable[[Given], Given]:
    """Return an option that names a file or a folder."""
    return click.option(*names, metavar=metavar, type=path_of, help=help, **more)


def flag(*names: str, help: str) -> Callable[[Given], Given]:
    """Return an option that is given or not."""
    return click.option(*names, is_flag=True, help=help)


def count_option(*names: str, least: int, most: int | None = None, help: str, **more: Any) -> Callable[[Given], Given]:
    """Return an option that is a whole number."""
    return click.option(*names, metavar="N", type=click.IntRange(least, most), help=help, **more)


def input_option(*names: str, help: str, **more: Any) -> Callable[[Given], Given]:
    """Return an option that names an input of the configuration, which a shell completes."""
    return click.option(*names, help=help, shell_complete=inputs, **{"metavar": "INPUT", **more})


def form_option(*forms: str, help: str = "text (default) or json.") -> Callable[[Given], Given]:
    """Return the option of the form in which something is shown, the first where none is named."""
    return click.option("--format", "form", default=forms[0], type=click.Choice(forms), help=help)


def formats_option(
    known_formats: Callable[[], Sequence[str]], default: str, help: str, *, may_be_none: bool = False
) -> Callable[[Given], Given]:
    """Return the option of a list of formats: small letters, each once; BadParameter for another one, and for none.

    The known ones are asked for when the option is read, since what knows them may take long to import.
    """

    def read(_: click.Context, __: click.Parameter, given: str) -> list[str]:
        asked, known = list(dict.fromkeys(split(given.lower()))), known_formats()
        unknown = [part for part in asked if part not in known]
        if unknown or not (asked or may_be_none):
            named = {"given": repr(unknown[0]), "nearest": nearest(unknown[0], known)} if unknown else {}
            message = Phrase("{given} is not a format{nearest}", named) if unknown else phrase("no format is named")
            raise click.BadParameter(say("{words}; known: {known}.", words=message, known=", ".join(known)))
        return asked

    return click.option("--format", "formats", metavar="LIST", default=default, callback=read, help=help)


def report_formats() -> tuple[str, ...]:
    """Return the formats of a report."""
    from diecut_report.press import FORMATS

    return FORMATS


def read_detail(_: click.Context, __: click.Parameter, given: str | None) -> str | None:
    """Return the detail that is asked for; BadParameter where there is no such one."""
    if given is None or given in DETAILS:
        return given
    words, near = "{given} is not a detail{nearest}; known: {known}.", nearest(given, DETAILS)
    raise click.BadParameter(say(words, given=repr(given), nearest=near, known=", ".join(DETAILS)))


def names_option(*names: str, metavar: str, none: str, help: str, **more: Any) -> Callable[[Given], Given]:
    """Return the option of a list of names, each once; BadParameter, in the words ``none``, where the list is empty."""

    def read(_: click.Context, __: click.Parameter, given: str | None) -> tuple[str, ...]:
        found = tuple(dict.fromkeys(split(given or "")))
        if given is not None and not found:
            raise click.BadParameter(say(none))
        return found

    return click.option(*names, metavar=metavar, callback=read, help=help, **more)


def _read_template(_: click.Context, __: click.Parameter, given: Path | None) -> HouseStyle | None:
    if given is None:
        return None
    from diecut_report.firm_folder import house_style

    return house_style(given)


config_argument = click.argument("config", type=path_of)
target_option = click.option(
    "-o", "target", metavar="FILE", type=output_file, help="Write to a file instead of standard output."
)
here_option = path_option("-o", "folder", metavar="DIR", default=".", help="Where to write (default: here).")
study_folder_option = path_option(
    "-o", "folder", metavar="DIR", help="Where to write (default: the study's name, here)."
)
jobs_option = count_option("--jobs", least=1, help="Number of processes (default: one per core).")
dask_option = click.option(
    "--dask", metavar="ADDRESS", help="Calculate on the cluster of this Dask scheduler, such as tcp://host:8786."
)
strict_option = flag(
    "--strict",
    help="Exit with 1 also for a conditional verdict: something is assumed, at its default, not rated, not checked or warns.",
)
template_option = path_option(
    "--template", "house", metavar="DIR", callback=_read_template,
    help="A folder with templates of your own, which override blocks of HTML and PDF.",
)  # fmt: skip


# What a command reads.


def source(config: Path, discovery: Discovery) -> Source:
    """Return the configuration that a command names: its file, standard input for ``-``, or for DIR#ID that of a stored variant."""
    if config == DASH:
        return from_standard_input()
    if "#" not in str(config):
        return config
    from diecut_report.study.analysis.variant_config import variant_config, variant_named

    if (variant := variant_named(config)) is None:
        return config
    folder, number = variant

    def warn(words: str) -> None:
        tell([Phrase("warning: {words}", words=phrase(words))])

    return variant_config(folder, number, discovery, f"{folder.resolve().name}-{number}.yaml", warn)


def changeable_source(config: Path, discovery: Discovery) -> Source:
    """Return the same where values are written into its text: a stored variant is read again without its heading, which tells of others."""
    found = source(config, discovery)
    if config == DASH or not isinstance(found, Tree):
        return found
    own = parse(as_text(found.root), found.file)
    own.name = found.name
    return own


def from_standard_input() -> Tree:
    """Return what standard input holds; UserError where the command has read it already."""
    meta = click.get_current_context().meta
    if meta.get(READ):
        raise refusal("Standard input has already been read; give - only once, with files beside it.", SHOWN)
    meta[READ] = True
    return load_standard_input()


def results_folder(study: Path | None, folder: Path | None, resume: Path | None) -> Path:
    """Return the folder of a study's results; UsageError where it cannot be told."""
    if resume is not None and folder is not None:
        raise click.UsageError(say("--resume names the folder; omit -o."))
    if study is None and resume is None:
        raise click.UsageError(say("Name a study file, or a folder to continue with --resume DIR."))
    if study == DASH:
        raise click.UsageError(say("A study is read from a file, so that its run can be continued. Save it to one."))
    return resume or folder or Path(Path(str(study)).stem)
