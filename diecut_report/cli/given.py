"""What a command is given to read: a configuration, a variant of a study, or what standard input holds."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from diecut_report.cli.output import tell
from diecut_report.config.standard_input import SHOWN, load_standard_input
from diecut_report.config.yaml_tree import Tree
from diecut_report.errors import Problem, UserError
from diecut_report.languages.phrases import Phrase, phrase
from diecut_report.languages.speech import say

if TYPE_CHECKING:
    from diecut_report.config.discovery import Discovery
    from diecut_report.pipeline import Source

RESULTS = "study.json"  # what makes a folder one of a study's results
READ = "diecut_report.standard_input"
DASH = Path("-")


class OutputFile(click.Path):
    """A file that is written; ``-`` is standard output, as where none is named."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        found = super().convert(value, param, ctx)
        return None if found == DASH else found


output_file = OutputFile(path_type=Path)


def source(config: Path, discovery: Discovery) -> Source:
    """Return the configuration that a command names: its file, standard input for ``-``, or for DIR#ID that of a stored variant."""
    if config == DASH:
        return from_standard_input()
    folder, _, number = str(config).rpartition("#")
    if not folder or not number.isdigit() or os.path.exists(config) or not os.path.exists(Path(folder) / RESULTS):
        return config
    from diecut_report.study.analysis.variant_config import variant_config

    name = f"{Path(folder).resolve().name}-{number}.yaml"
    return variant_config(
        Path(folder),
        int(number),
        discovery,
        name,
        lambda words: tell([Phrase("warning: {words}", words=phrase(words))]),
    )


def changeable_source(config: Path, discovery: Discovery) -> Source:
    """Return the same where values are written into its text: that of a stored variant has its own places."""
    from diecut_report.config.yaml_values import in_its_own_text

    found = source(config, discovery)
    return in_its_own_text(found) if isinstance(found, Tree) and config != DASH else found


def from_standard_input() -> Tree:
    """Return what standard input holds; UserError where the command has read it already."""
    meta = click.get_current_context().meta
    if meta.get(READ):
        words = phrase("Standard input has been read already; give - once, and files beside it.")
        raise UserError(Problem(words, SHOWN))
    meta[READ] = True
    return load_standard_input()


def results_folder(study: Path | None, folder: Path | None, resume: Path | None) -> Path:
    """Return the folder of a study's results; UsageError where it cannot be told."""
    if resume is not None and folder is not None:
        raise click.UsageError(say("--resume names the folder; leave -o out."))
    if study is None and resume is None:
        raise click.UsageError(say("Name a study file, or a folder to continue with --resume DIR."))
    if study == DASH:
        raise click.UsageError(say("A study is read from a file, so that its run can be continued. Save it to one."))
    return resume or folder or Path(Path(str(study)).stem)
